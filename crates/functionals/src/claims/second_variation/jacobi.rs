//! Jacobi's condition: numerically by a conjoined basis, and for one field by a function that proves it.
//!
//! The canonical equations of the second variation, `v' = P⁻¹ (w − Q v)`, `w' = R v + Qᵀ v'`, have a basis V, W of solutions with
//! v = 0 where the left end is held and w = B v where it is free. With P > 0 the second variation is positive if det V has no zero up to
//! the right end and the matrix W V⁻¹ + B is positive there for what is free; a zero before the right end makes it negative somewhere (W. T.
//! Reid, Sturmian Theory for Ordinary Differential Equations, 1980). For one field a function w > 0 with (P w')' < R w and the same
//! inequalities at free ends is a proof: then ∫ (P v'² + R v²) = ∫ P (v' − w' v/w)² + ∫ (R − (P w')'/w) v² + … (Jacobi 1837).

use super::form::Form;
use crate::signs::{on_interval, Sign};
use chetaev_integrate::{from_fn, integrate, Options};
use chetaev_symbolic::{meter, rational, Expr, Rational};
use std::cell::Cell;

/// Units of work for the coefficients at a place, and for a product in an elimination.
const COEFFICIENTS: u64 = 100;
const STEP: u64 = 10;

/// So many steps between which a change of sign is looked for.
const STEPS: usize = 256;

/// What a conjoined basis shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Shown {
    /// No zero of det V and a positive matrix at the right end, with the smallest number met relative to the largest.
    Positive,
    /// det V vanishes at this place inside.
    Conjugate(f64),
    /// Something vanishes at the right end as far as numbers tell.
    Degenerate,
    /// det V has no zero, and at the free right end a variation makes the form negative.
    NegativeAtEnd,
}

/// How near to zero a number is called zero.
const SMALL: f64 = 1e-8;
/// The same of a determinant at its minimum, which is of second order in the place.
const LEAST: f64 = 1e-12;

/// Numbers of a matrix of expressions at a place.
fn numbers(form: &Form<'_>, matrix: &[Vec<Expr>], x: f64) -> Option<Vec<Vec<f64>>> {
    let space = &*form.functional.space;
    let variable = space.graph.as_symbol(space.coordinates.first()?.expr);
    let row = |row: &Vec<Expr>| {
        let own = space
            .graph
            .evaluate_f64(row, &|s| (Some(s) == variable).then_some(x));
        own.ok().filter(|all| all.iter().all(|v| v.is_finite()))
    };
    matrix.iter().map(row).collect()
}

/// The solution of `a x = b` for the columns of b, by elimination.
fn solve(mut a: Vec<Vec<f64>>, mut b: Vec<Vec<f64>>) -> Option<Vec<Vec<f64>>> {
    let n = a.len();
    for k in 0..n {
        let best = (k..n).max_by(|&i, &j| a[i][k].abs().total_cmp(&a[j][k].abs()))?;
        a.swap(k, best);
        b.swap(k, best);
        let pivot = a[k][k];
        if pivot == 0.0 {
            return None;
        }
        for r in 0..n {
            let factor = a[r][k] / pivot;
            if r == k || factor == 0.0 {
                continue;
            }
            let (above, other) = (a[k].clone(), b[k].clone());
            a[r].iter_mut()
                .zip(&above)
                .for_each(|(v, o)| *v -= factor * o);
            b[r].iter_mut()
                .zip(&other)
                .for_each(|(v, o)| *v -= factor * o);
        }
    }
    for k in 0..n {
        let pivot = a[k][k];
        b[k].iter_mut().for_each(|v| *v /= pivot);
    }
    Some(b)
}

/// A determinant, relative to the product of the lengths of its rows.
fn relative_determinant(matrix: &[Vec<f64>]) -> f64 {
    let mut a = matrix.to_vec();
    for row in &mut a {
        let size = row.iter().map(|v| v * v).sum::<f64>().sqrt();
        if size == 0.0 {
            return 0.0;
        }
        row.iter_mut().for_each(|v| *v /= size);
    }
    determinant(a)
}

fn determinant(mut a: Vec<Vec<f64>>) -> f64 {
    let n = a.len();
    let mut value = 1.0;
    for k in 0..n {
        let best = (k..n)
            .max_by(|&i, &j| a[i][k].abs().total_cmp(&a[j][k].abs()))
            .unwrap_or(k);
        if best != k {
            a.swap(k, best);
            value = -value;
        }
        value *= a[k][k];
        if a[k][k] == 0.0 {
            return 0.0;
        }
        for r in k + 1..n {
            let factor = a[r][k] / a[k][k];
            let above = a[k].clone();
            a[r].iter_mut()
                .zip(&above)
                .for_each(|(v, o)| *v -= factor * o);
        }
    }
    value
}

/// The basis: V above W, each by rows.
type Basis = Vec<f64>;

struct Equations<'a, 'f> {
    form: &'a Form<'f>,
    /// What is taken off R.
    shift: f64,
}

impl Equations<'_, '_> {
    fn slope(&self, x: f64, y: &[f64]) -> Option<Basis> {
        let n = self.form.count();
        meter::spend(COEFFICIENTS + STEP * n.pow(3) as u64);
        let p = numbers(self.form, &self.form.p, x)?;
        let q = numbers(self.form, &self.form.q, x)?;
        let r = numbers(self.form, &self.form.r, x)?;
        let v = |a: usize, c: usize| y[a * n + c];
        let right: Vec<Vec<f64>> = (0..n)
            .map(|a| {
                let one =
                    |c: usize| y[(n + a) * n + c] - (0..n).map(|b| q[a][b] * v(b, c)).sum::<f64>();
                (0..n).map(one).collect()
            })
            .collect();
        let rate = solve(p, right)?;
        let mut own: Basis = rate.iter().flatten().copied().collect();
        for a in 0..n {
            own.extend((0..n).map(|c| {
                let of_values: f64 = (0..n).map(|b| r[a][b] * v(b, c)).sum();
                let of_rates: f64 = rate.iter().zip(&q).map(|(own, q)| q[a] * own[c]).sum();
                of_values + of_rates - self.shift * v(a, c)
            }));
        }
        Some(own)
    }

    fn between(&self, (from, to): (f64, f64), y: &[f64]) -> Option<Basis> {
        let dimension = y.len();
        // Coefficients without a value somewhere, as with a parameter that has none, give no basis.
        let is_defined = Cell::new(true);
        let mut system = from_fn(dimension, |x: f64, y: &[f64], dy: &mut [f64]| {
            match self.slope(x, y) {
                Some(own) => dy.copy_from_slice(&own),
                None => {
                    is_defined.set(false);
                    dy.fill(f64::NAN);
                }
            }
        });
        let run = integrate(
            &mut system,
            (from, to),
            y,
            &mut [],
            Options::tolerance(1e-12),
        );
        let last = run.ok()?.state;
        let is_there = is_defined.get() && last.iter().all(|v| v.is_finite());
        is_there.then_some(last)
    }

    /// The start at the left end.
    fn start(&self, lower: f64) -> Option<Basis> {
        let form = self.form;
        let n = form.count();
        let b = numbers(form, &form.ends[0].b, lower)?;
        let is_fixed = &form.ends[0].fixed;
        let mut own = vec![0.0; 2 * n * n];
        for c in 0..n {
            if is_fixed[c] {
                own[(n + c) * n + c] = 1.0;
                continue;
            }
            own[c * n + c] = 1.0;
            for a in (0..n).filter(|&a| !is_fixed[a]) {
                own[(n + a) * n + c] = b[a][c];
            }
        }
        Some(own)
    }
}

/// What a conjoined basis shows; `None` where the equations could not be integrated. Between steps its columns are made orthonormal, in units
/// in which V and W are of one size: then det V is small near its zeros only. A zero of even multiplicity shows as a minimum of |det V|.
pub(super) fn shown(form: &Form<'_>, (lower, upper): (f64, f64)) -> Option<Shown> {
    let scanned = Scanned {
        equations: Equations { form, shift: 0.0 },
        unit: 1.0 / (scale(form, (lower, upper))? * (upper - lower)),
        n: form.count(),
    };
    let place = |k: usize| lower + (upper - lower) * k as f64 / STEPS as f64;
    let at_end = |zero: f64| {
        if (zero - upper).abs() < SMALL * (upper - lower) {
            vanishing_at_the_end(form)
        } else {
            Shown::Conjugate(zero)
        }
    };
    let mut own = scanned.orthonormal(scanned.equations.start(lower)?);
    // The basis and the determinant before that.
    let mut before: Option<(Basis, f64)> = None;
    for k in 1..=STEPS {
        let next = scanned.after(&own, (place(k - 1), place(k)))?;
        let (here, there) = (scanned.determinant(&own), scanned.determinant(&next));
        if k == STEPS && there.abs() < SMALL {
            return Some(vanishing_at_the_end(form));
        }
        if here * there < 0.0 {
            let zero = scanned.change_of_sign(&own, (place(k - 1), place(k)))?;
            return Some(at_end(zero));
        }
        if let Some((first, value)) = &before {
            // Of equal ones none is a minimum.
            let least = value.abs().min(there.abs());
            if here.abs() <= least && here.abs() < value.abs().max(there.abs()) {
                let (zero, least) = scanned.minimum(first, (place(k - 2), place(k)))?;
                if least < LEAST {
                    return Some(at_end(zero));
                }
            }
        }
        before = Some((own, here));
        own = next;
    }
    at_the_end(form, &own, upper)
}

/// What a zero of det V at the right end shows: where all is free there, a field that vanishes at the end violates its natural condition, so
/// that the second variation, which is zero for it, is negative beside it.
fn vanishing_at_the_end(form: &Form<'_>) -> Shown {
    let is_held = form.ends[1].fixed.iter().any(|fixed| *fixed);
    if is_held {
        Shown::Degenerate
    } else {
        Shown::NegativeAtEnd
    }
}

/// A conjoined basis followed from the left end.
struct Scanned<'a, 'f> {
    equations: Equations<'a, 'f>,
    /// W in this unit is of the size of V.
    unit: f64,
    n: usize,
}

impl Scanned<'_, '_> {
    /// The basis at another place, orthonormal.
    fn after(&self, y: &[f64], (from, to): (f64, f64)) -> Option<Basis> {
        if to <= from {
            return Some(y.to_vec());
        }
        Some(self.orthonormal(self.equations.between((from, to), y)?))
    }

    /// The same solutions by orthonormal columns, made one after the other, so that the sign of det V stays.
    fn orthonormal(&self, mut y: Basis) -> Basis {
        let n = self.n;
        let weight = |row: usize| if row < n { 1.0 } else { self.unit * self.unit };
        for c in 0..n {
            for other in 0..c {
                let along: f64 = (0..2 * n)
                    .map(|row| weight(row) * y[row * n + c] * y[row * n + other])
                    .sum();
                for row in 0..2 * n {
                    y[row * n + c] -= along * y[row * n + other];
                }
            }
            let square: f64 = (0..2 * n)
                .map(|row| weight(row) * y[row * n + c].powi(2))
                .sum();
            let size = square.sqrt();
            if size > 0.0 {
                (0..2 * n).for_each(|row| y[row * n + c] /= size);
            }
        }
        y
    }

    fn determinant(&self, y: &[f64]) -> f64 {
        let n = self.n;
        determinant((0..n).map(|a| y[a * n..(a + 1) * n].to_vec()).collect())
    }

    /// Where det V changes its sign.
    fn change_of_sign(&self, y: &[f64], (from, to): (f64, f64)) -> Option<f64> {
        let value = |x: f64| Some(self.determinant(&self.after(y, (from, x))?));
        let (mut a, mut b) = (from, to);
        let end = value(b)?;
        for _ in 0..50 {
            let c = 0.5 * (a + b);
            if value(c)? * end > 0.0 {
                b = c;
            } else {
                a = c;
            }
        }
        Some(0.5 * (a + b))
    }

    /// Where |det V| is least, and its value there, by golden sections.
    fn minimum(&self, y: &[f64], (from, to): (f64, f64)) -> Option<(f64, f64)> {
        let value = |x: f64| Some(self.determinant(&self.after(y, (from, x))?).abs());
        let ratio = 0.5 * (5_f64.sqrt() - 1.0);
        let (mut a, mut b) = (from, to);
        for _ in 0..60 {
            let (left, right) = (b - ratio * (b - a), a + ratio * (b - a));
            if value(left)? < value(right)? {
                b = right;
            } else {
                a = left;
            }
        }
        let place = 0.5 * (a + b);
        Some((place, value(place)?))
    }
}

/// `W V⁻¹ + B` for the components that are free at the right end.
fn at_the_end(form: &Form<'_>, y: &[f64], upper: f64) -> Option<Shown> {
    let n = form.count();
    let free: Vec<usize> = (0..n).filter(|&a| !form.ends[1].fixed[a]).collect();
    if free.is_empty() {
        return Some(Shown::Positive);
    }
    let b = numbers(form, &form.ends[1].b, upper)?;
    // (W V⁻¹)ᵀ = V⁻ᵀ Wᵀ, and it is symmetric.
    let transposed = |from: usize| -> Vec<Vec<f64>> {
        (0..n)
            .map(|c| (0..n).map(|a| y[(from + a) * n + c]).collect())
            .collect()
    };
    let own = solve(transposed(0), transposed(n))?;
    let size = own.iter().flatten().fold(1.0_f64, |m, v| m.max(v.abs()));
    for count in 1..=free.len() {
        let minor: Vec<Vec<f64>> = free[..count]
            .iter()
            .map(|&a| free[..count].iter().map(|&c| own[a][c] + b[a][c]).collect())
            .collect();
        let value = match count {
            1 => minor[0][0] / size,
            _ => relative_determinant(&minor),
        };
        if value.abs() < SMALL {
            return Some(Shown::Degenerate);
        }
        if value < 0.0 {
            return Some(Shown::NegativeAtEnd);
        }
    }
    Some(Shown::Positive)
}

/// A polynomial w that proves the second variation of one field positive; the interval lies within the two places.
pub(super) fn certificate(form: &Form<'_>, (lower, upper): (&Rational, &Rational)) -> Option<Expr> {
    if form.count() != 1 {
        return None;
    }
    let ends = (rational::to_f64(lower), rational::to_f64(upper));
    let scale = scale(form, ends)?;
    let tries = [(1e-1, 10), (1e-2, 14), (1e-3, 16), (1e-5, 18), (1e-7, 20)];
    tries.into_iter().find_map(|(small, degree)| {
        let values = Guess {
            form,
            ends,
            shift: small * scale,
            start: small,
        }
        .polynomial(degree, lower, upper)?;
        proves(form, values, (lower, upper)).then_some(values)
    })
}

fn scale(form: &Form<'_>, (lower, upper): (f64, f64)) -> Option<f64> {
    let p = numbers(form, &form.p, 0.5 * (lower + upper))?[0][0].abs();
    Some(p / ((upper - lower) * (upper - lower)))
}

/// A function that satisfies the inequalities as far as numbers show.
struct Guess<'a, 'f> {
    form: &'a Form<'f>,
    ends: (f64, f64),
    shift: f64,
    start: f64,
}

impl Guess<'_, '_> {
    /// Interpolated at Chebyshev's points, with rational coefficients of powers of the place between −1 and 1.
    fn polynomial(&self, degree: usize, lower: &Rational, upper: &Rational) -> Option<Expr> {
        let (a, b) = self.ends;
        let equations = Equations {
            form: self.form,
            shift: self.shift,
        };
        let mut y = equations.start(a)?;
        let is_fixed = self.form.ends[0].fixed[0];
        if is_fixed {
            let p = numbers(self.form, &self.form.p, a)?[0][0];
            y[0] = self.start * (b - a) / p;
        } else {
            // Less than what the free end asks for.
            y[1] -= self.shift * (b - a);
        }
        let count = degree + 1;
        let angle = |k: usize| std::f64::consts::PI * (k as f64 + 0.5) / count as f64;
        let mut at: Vec<(f64, f64)> = Vec::new();
        let mut before = a;
        for k in (0..count).rev() {
            let t = angle(k).cos();
            let x = 0.5 * (a + b) + 0.5 * (b - a) * t;
            y = equations.between((before, x), &y)?;
            before = x;
            at.push((angle(k), y[0]));
        }
        let coefficient = |n: usize| {
            let sum: f64 = at
                .iter()
                .map(|(angle, value)| value * (n as f64 * angle).cos())
                .sum();
            sum * if n == 0 { 1.0 } else { 2.0 } / count as f64
        };
        let size = at.iter().fold(0.0_f64, |m, (_, v)| m.max(v.abs()));
        let space = &*self.form.functional.space;
        let g = &space.graph;
        let x = space.coordinates.first()?.expr;
        let length = upper - lower;
        let t = g.div(
            g.sub(
                g.mul(&[g.integer(2), x]),
                g.number(rational::sum(lower, upper)),
            ),
            g.number(length),
        );
        let powers = powers_of_chebyshev(count, |n| coefficient(n) / size);
        let terms = powers.iter().enumerate().map(|(n, &c)| {
            let c = dyadic(c)?;
            Some(g.mul(&[g.number(c), g.powi(t, n as i64)]))
        });
        Some(g.add(&terms.collect::<Option<Vec<_>>>()?))
    }
}

/// Coefficients of powers for `Σ c_n T_n`.
fn powers_of_chebyshev(count: usize, c: impl Fn(usize) -> f64) -> Vec<f64> {
    let mut sum = vec![0.0; count];
    let (mut before, mut own) = (vec![0.0; count], vec![0.0; count]);
    before[0] = 1.0;
    if count > 1 {
        own[1] = 1.0;
    }
    for n in 0..count {
        let polynomial = if n == 0 { &before } else { &own };
        let factor = c(n);
        sum.iter_mut()
            .zip(polynomial)
            .for_each(|(s, p)| *s += factor * p);
        if n > 0 {
            let mut next = vec![0.0; count];
            for k in 0..count {
                next[k] = if k > 0 { 2.0 * own[k - 1] } else { 0.0 } - before[k];
            }
            before = std::mem::replace(&mut own, next);
        }
    }
    sum
}

/// A number rounded to a multiple of 2^−40.
fn dyadic(value: f64) -> Option<Rational> {
    let scale = (1_u64 << 40) as f64;
    let scaled = (value * scale).round();
    (scaled.abs() < 9e15)
        .then(|| rational::ratio(scaled as i64, 1_i64 << 40))
        .flatten()
}

/// Whether the inequalities hold exactly.
fn proves(form: &Form<'_>, w: Expr, ends: (&Rational, &Rational)) -> bool {
    let space = &*form.functional.space;
    let g = &space.graph;
    let slope = space.total(w, 0);
    let (p, q, r) = (form.p[0][0], form.q[0][0], form.r[0][0]);
    let momentum = g.add(&[g.mul(&[p, slope]), g.mul(&[q, w])]);
    // R w + Q w' − (P w' + Q w)'.
    let surplus = g.sub(
        g.add(&[g.mul(&[r, w]), g.mul(&[q, slope])]),
        space.total(momentum, 0),
    );
    let is_positive = |e: Expr| on_interval(space, e, ends) == Sign::Positive;
    let at_end = |k: usize| {
        let end = &form.ends[k];
        if end.fixed[0] {
            return true;
        }
        let (place, sign) = if k == 0 {
            (form.interval.lower, -1)
        } else {
            (form.interval.upper, 1)
        };
        let Some(x) = space.coordinates.first().map(|c| c.expr) else {
            return false;
        };
        let through = g.mul(&[g.integer(sign), momentum]);
        let sum = g.add(&[through, g.mul(&[end.b[0][0], w])]);
        super::is_not_negative(space, g.substitute(sum, &[(x, place)]))
    };
    is_positive(w) && is_positive(surplus) && at_end(0) && at_end(1)
}
