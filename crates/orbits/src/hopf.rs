//! The first Lyapunov coefficient of a pair of eigenvalues on the imaginary axis (Kuznetsov 2004, § 5.4, (5.62)).
//!
//! `l₁ = Re c₁/ω`, `c₁ = ½ ⟨p, C(q, q, q̄) − 2 B(q, A⁻¹ B(q, q̄)) + B(q̄, (2iω − A)⁻¹ B(q, q))⟩` with `A q = iω q`, `Aᵀ p = −iω p`,
//! `⟨q, q⟩ = 1`, `⟨p, q⟩ = 1`; B and C are the second and third derivatives of f. They are taken along straight lines only, and polarized
//! (Kuznetsov 2004, § 10.2): the exact derivatives of f along a line stay small where those by all variables do not.
//!
//! Zeros beside the pair belong to a family of steady motions or to finite constraints. Where as many integrals F with independent gradients take
//! them out, the coefficient is that of the levels of these: `A h = −B(q, q̄)` is solved by h with `F' h = −F''(q, q̄)`, for motions
//! that stay on the level. In a family of one dimension without an integral oscillations drift along it instead: with `w' = (iω + α y) w + …` and
//! `y' = e |w|² + …` the sign of α e decides (Fiedler, Liebscher, Alexander 2000, J. Differential Equations 167).

use crate::flow::Flow;
use crate::multipliers::eigenvalues;
use crate::subspace::{kernel, least_squares, nullity};
use chetaev_stability::singular::singular;
use chetaev_symbolic::{Expr, Symbol};
use nalgebra::{Complex, DMatrix, DVector};

/// What decides whether the orbits that are born are stable.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FirstLyapunov {
    /// ω.
    pub frequency: f64,
    /// l₁, zero where it is so to rounding: it decides nothing then; negative, and stable orbits are born where the motion loses its stability; positive, and unstable ones vanish there.
    pub coefficient: f64,
}

/// Why there is no first Lyapunov coefficient.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum WithoutLyapunov {
    /// No pair.
    #[error(
        "the first Lyapunov coefficient was not computed: no pair of eigenvalues is imaginary"
    )]
    NoPair,
    /// A derivative has no value.
    #[error("the first Lyapunov coefficient was not computed: the equations have no explicit form with three derivatives there")]
    NoDerivatives,
    /// Zero, or twice the frequency, is an eigenvalue beside the pair.
    #[error("the first Lyapunov coefficient is not defined: zero, or twice the frequency, is an eigenvalue too")]
    Resonant,
    /// Zeros beside the pair that no integral takes out.
    #[error("the first Lyapunov coefficient is not defined: zero eigenvalues stand beside the pair ({zeros}), and integrals take out {levels} of them")]
    Zeros {
        /// How many.
        zeros: usize,
        /// How many integrals and finite constraints were found.
        levels: usize,
    },
    /// Several pairs at once.
    #[error("the first Lyapunov coefficient is not defined: several eigenvalues are on the axis at once")]
    Several,
    /// A family without an integral.
    #[error("the first Lyapunov coefficient is not defined: the motion belongs to a family of steady motions, and no integral that is known tells its members apart; oscillations drift along the family to where they {}", if *product > 0.0 { "grow: motions leave (Fiedler, Liebscher, Alexander)" } else { "die away (Fiedler, Liebscher, Alexander)" })]
    Drifts {
        /// α e.
        product: f64,
    },
}

type ComplexVector = DVector<Complex<f64>>;

/// f's derivatives along lines through a point.
struct Lines<'f> {
    flow: &'f Flow,
    directions: Vec<Symbol>,
    second: Vec<Expr>,
    third: Vec<Expr>,
    at: (&'f [f64], &'f [f64]),
}

impl<'f> Lines<'f> {
    fn new(flow: &'f Flow, at: (&'f [f64], &'f [f64])) -> Lines<'f> {
        let g = &flow.graph;
        // No name of a model contains a space.
        let symbol = |i: usize| g.intern_symbol(&format!("along line {i}"), 0);
        let directions: Vec<Symbol> = (0..flow.n()).map(symbol).collect();
        let moved = |s: Symbol| {
            let place = flow.variables.iter().position(|own| *own == s)?;
            Some(g.symbol_expr(directions[place]))
        };
        let first = g.derive(&flow.rates, &moved);
        let second = g.derive(&first, &moved);
        let third = g.derive(&second, &moved);
        Lines {
            flow,
            directions,
            second,
            third,
            at,
        }
    }

    fn value(&self, es: &[Expr], direction: &DVector<f64>) -> Option<DVector<f64>> {
        let place = |all: &[Symbol], s| all.iter().position(|own| *own == s);
        let value = |s: Symbol| {
            let variable = place(&self.flow.variables, s).map(|i| self.at.0[i]);
            let along = || place(&self.directions, s).map(|i| direction[i]);
            let parameter = || self.flow.place(s).map(|i| self.at.1[i]);
            variable.or_else(along).or_else(parameter)
        };
        let found = self.flow.graph.evaluate_f64(es, &value).ok()?;
        Some(DVector::from_vec(found))
    }

    /// B(a, b) by `4 B(a, b) = B(a + b, a + b) − B(a − b, a − b)`.
    fn twice(&self, a: &DVector<f64>, b: &DVector<f64>) -> Option<DVector<f64>> {
        let (sum, difference) = (a + b, a - b);
        Some((self.value(&self.second, &sum)? - self.value(&self.second, &difference)?) / 4.0)
    }

    /// C(a, a, b) by `6 C(a, a, b) = C(a + b)³ − C(a − b)³ − 2 C(b)³`.
    fn thrice(&self, a: &DVector<f64>, b: &DVector<f64>) -> Option<DVector<f64>> {
        let (sum, difference) = (a + b, a - b);
        let own = self.value(&self.third, b)?;
        let both = self.value(&self.third, &sum)? - self.value(&self.third, &difference)?;
        Some((both - own * 2.0) / 6.0)
    }

    /// B of complex vectors.
    fn complex(&self, u: &ComplexVector, w: &ComplexVector) -> Option<ComplexVector> {
        let (a, b) = (u.map(|z| z.re), u.map(|z| z.im));
        let (c, d) = (w.map(|z| z.re), w.map(|z| z.im));
        let real = self.twice(&a, &c)? - self.twice(&b, &d)?;
        let imaginary = self.twice(&a, &d)? + self.twice(&b, &c)?;
        Some(real.zip_map(&imaginary, Complex::new))
    }
}

/// The first Lyapunov coefficient of the pair nearest to the axis at a steady motion, on the levels of integrals where a family stands beside the
/// pair; `slopes` is ∂f/∂z there, and `family` the dimension of the family of steady motions to which it belongs. The flow is one in suitable
/// units; the coefficient is that for eigenvectors of unit length as the variables are.
///
/// # Errors
/// [`WithoutLyapunov`] where there is none.
pub fn first_lyapunov(
    flow: &Flow,
    at: (&[f64], &[f64]),
    (slopes, family): (&DMatrix<f64>, usize),
) -> Result<FirstLyapunov, WithoutLyapunov> {
    let pair = Pair::nearest(slopes)?;
    let lines = Lines::new(flow, at);
    let zeros = nullity(slopes, ZERO);
    let levels = Level::of(flow, at);
    if levels.len() < zeros {
        let is_line = zeros == 1 && family == 1 && levels.is_empty();
        let product = is_line.then(|| pair.drift(&lines)).flatten();
        return Err(match product.filter(|own| own.is_finite() && *own != 0.0) {
            Some(product) => WithoutLyapunov::Drifts { product },
            None => WithoutLyapunov::Zeros {
                zeros,
                levels: levels.len(),
            },
        });
    }
    let coefficient = pair.coefficient(&lines, &levels)?;
    let lengths = pair.q.iter().zip(&flow.units.scale);
    let square: f64 = lengths.map(|(q, s)| q.norm_sqr() * s * s).sum();
    Ok(FirstLyapunov {
        frequency: pair.frequency,
        coefficient: coefficient / square,
    })
}

/// Singular values below this part of the largest are zeros, in suitable units.
const ZERO: f64 = 1e-13;

/// Gradient and second derivatives of a function that is constant along motions.
struct Level {
    gradient: DVector<f64>,
    second: DMatrix<f64>,
}

impl Level {
    /// Finite constraints and integrals with independent gradients: those candidates whose rates vanish beside the motion.
    fn of(flow: &Flow, (z, parameters): (&[f64], &[f64])) -> Vec<Level> {
        let g = &flow.graph;
        let finite = flow.finite.iter().copied();
        let candidates = finite.chain(flow.conserved.iter().map(|own| own.1));
        let value = |es: &[Expr], z: &[f64]| {
            let value = flow.values_at(z, parameters);
            g.evaluate_f64(es, &value).ok()
        };
        let n = flow.n();
        let is_constant = |gradient: &[Expr]| {
            let beside = |k: usize| -> Option<bool> {
                let step = |i: usize| BESIDE * ((i * 7 + k * 3) as f64).sin();
                let point: Vec<f64> = (0..n)
                    .map(|i| z[i] + step(i) * (1.0 + z[i].abs()))
                    .collect();
                let (slopes, rates) = (value(gradient, &point)?, value(&flow.rates, &point)?);
                let terms: Vec<f64> = slopes.iter().zip(&rates).map(|(a, b)| a * b).collect();
                let size: f64 = terms.iter().map(|x| x.abs()).sum();
                Some(terms.iter().sum::<f64>().abs() <= CONSTANT * size)
            };
            (1..=3).all(|k| beside(k) == Some(true))
        };
        let mut found: Vec<Level> = Vec::new();
        for own in candidates {
            let by = g.gradient(own, &flow.variables);
            let second = g.jacobian(&by, &flow.variables).concat();
            let known = value(&by, z).zip(value(&second, z));
            let Some((gradient, second)) = known.filter(|_| is_constant(&by)) else {
                continue;
            };
            let level = Level {
                gradient: DVector::from_vec(gradient),
                second: DMatrix::from_row_slice(n, n, &second),
            };
            let rows: Vec<&Level> = found.iter().chain([&level]).collect();
            let unit = |own: &Level| own.gradient.norm().max(f64::MIN_POSITIVE);
            let columns =
                DMatrix::from_fn(n, rows.len(), |r, c| rows[c].gradient[r] / unit(rows[c]));
            // What is constant only by its gradient being zero cuts nothing.
            if nullity(&columns, INDEPENDENT) == 0 && level.gradient.norm() > 0.0 {
                found.push(level);
            }
        }
        found
    }
}

/// How far beside the motion rates are looked at, in parts of its size.
const BESIDE: f64 = 1e-2;
/// A rate below this part of its terms vanishes.
const CONSTANT: f64 = 1e-9;
/// A sum below this part of its terms is zero to rounding.
const ROUNDED: f64 = 1e-9;
/// Gradients nearer to each other depend on each other.
const INDEPENDENT: f64 = 1e-9;

/// Real parts below this part of the frequency are zero.
const ON_AXIS: f64 = 1e-12;
/// Where a place is not found to rounding, a pair that is so many times as far from the axis as the nearest one may be on it.
const AS_NEAR: f64 = 4.0;

/// Eigenvectors of the pair.
struct Pair<'a> {
    slopes: &'a DMatrix<f64>,
    frequency: f64,
    q: ComplexVector,
    p: ComplexVector,
}

/// Derivatives of f along a pair.
struct Along {
    /// C(q, q, q̄).
    cubic: ComplexVector,
    /// B(q, q̄).
    constant: DVector<f64>,
    /// B(q, q).
    doubled: ComplexVector,
}

impl Along {
    fn is_finite(&self) -> bool {
        let complex = self.cubic.iter().chain(&self.doubled);
        complex.clone().all(|z| z.is_finite()) && self.constant.iter().all(|x| x.is_finite())
    }
}

impl<'a> Pair<'a> {
    fn nearest(slopes: &'a DMatrix<f64>) -> Result<Pair<'a>, WithoutLyapunov> {
        let all = eigenvalues(slopes).unwrap_or_default();
        let pairs = all.iter().filter(|l| l.im > 0.0);
        let nearest = pairs
            .clone()
            .min_by(|a, b| a.re.abs().total_cmp(&b.re.abs()));
        let nearest = nearest.ok_or(WithoutLyapunov::NoPair)?;
        // Those that stand on the axis to rounding, or as near to it as the nearest one.
        let is_on_axis =
            |l: &&Complex<f64>| l.re.abs() <= (ON_AXIS * l.im).max(AS_NEAR * nearest.re.abs());
        if pairs.filter(is_on_axis).count() > 1 {
            return Err(WithoutLyapunov::Several);
        }
        let frequency = nearest.im;
        Pair::of(slopes, frequency).ok_or(WithoutLyapunov::NoPair)
    }

    fn of(slopes: &'a DMatrix<f64>, frequency: f64) -> Option<Pair<'a>> {
        let complex = slopes.map(|x| Complex::new(x, 0.0));
        let q = null_vector(&shifted(&complex, frequency))?;
        let p = null_vector(&shifted(&complex.transpose(), -frequency))?;
        // ⟨p, q⟩ = Σ p̄ q.
        let product = p.dotc(&q);
        Some(Pair {
            slopes,
            frequency,
            p: p / product.conj(),
            q,
        })
    }

    fn coefficient(&self, lines: &Lines<'_>, levels: &[Level]) -> Result<f64, WithoutLyapunov> {
        let along = self.along(lines);
        let own = along.filter(|own| own.is_finite());
        let own = own.ok_or(WithoutLyapunov::NoDerivatives)?;
        let q = &self.q;
        let (a, b) = (q.map(|z| z.re), q.map(|z| z.im));
        let constant = self.constant(levels, &own.constant, (&a, &b));
        let constant = constant.ok_or(WithoutLyapunov::Resonant)?;
        let constant = constant.map(|x| Complex::new(x, 0.0));
        let complex = self.slopes.map(|x| Complex::new(x, 0.0));
        let doubled = (-shifted(&complex, 2.0 * self.frequency)).lu();
        let doubled = doubled.solve(&own.doubled);
        let doubled = doubled.filter(|own| own.iter().all(|z| z.is_finite()));
        let doubled = doubled.ok_or(WithoutLyapunov::Resonant)?;
        let product = |u: &ComplexVector, w: &ComplexVector| {
            lines.complex(u, w).ok_or(WithoutLyapunov::NoDerivatives)
        };
        let parts = [
            own.cubic,
            product(q, &constant)? * Complex::new(2.0, 0.0),
            product(&q.conjugate(), &doubled)?,
        ];
        let terms = parts.iter().map(|own| self.p.dotc(own).re);
        let sum: f64 = terms.sum();
        let sizes = parts
            .iter()
            .map(|own| self.p.map(|z| z.norm()).dot(&own.map(|z| z.norm())));
        let size: f64 = sizes.sum();
        let sum = if sum.abs() <= ROUNDED * size {
            0.0
        } else {
            sum
        };
        Some(0.5 * sum / self.frequency)
            .filter(|own| own.is_finite())
            .ok_or(WithoutLyapunov::NoDerivatives)
    }

    /// Second and third derivatives along the pair; `None` where one has no value.
    fn along(&self, lines: &Lines<'_>) -> Option<Along> {
        let q = &self.q;
        let (a, b) = (q.map(|z| z.re), q.map(|z| z.im));
        let real = lines.value(&lines.third, &a)? + lines.thrice(&b, &a)?;
        let imaginary = lines.thrice(&a, &b)? + lines.value(&lines.third, &b)?;
        Some(Along {
            cubic: real.zip_map(&imaginary, Complex::new),
            constant: lines.complex(q, &q.conjugate())?.map(|z| z.re),
            doubled: lines.complex(q, q)?,
        })
    }

    /// h with `A h = −B(q, q̄)` on the levels.
    fn constant(
        &self,
        levels: &[Level],
        second: &DVector<f64>,
        (a, b): (&DVector<f64>, &DVector<f64>),
    ) -> Option<DVector<f64>> {
        let n = self.slopes.nrows();
        let mut matrix = self.slopes.clone().resize_vertically(n + levels.len(), 0.0);
        let mut right = (-second).resize_vertically(n + levels.len(), 0.0);
        let size = self.slopes.norm();
        for (at, own) in levels.iter().enumerate() {
            let weight = size / own.gradient.norm();
            matrix
                .row_mut(n + at)
                .copy_from(&(own.gradient.transpose() * weight));
            let bend = a.dot(&(&own.second * a)) + b.dot(&(&own.second * b));
            right[n + at] = -bend * weight;
        }
        let is_regular = nullity(&matrix, ZERO) == 0;
        is_regular.then(|| least_squares(&matrix, &right, ZERO))?
    }

    /// α e along a family of one dimension.
    fn drift(&self, lines: &Lines<'_>) -> Option<f64> {
        let tangent = kernel(self.slopes, 1)?.column(0).into_owned();
        let left = kernel(&self.slopes.transpose(), 1)?.column(0).into_owned();
        let along = tangent.map(|x| Complex::new(x, 0.0));
        let growth = self.p.dotc(&lines.complex(&self.q, &along)?).re;
        let second = lines.complex(&self.q, &self.q.conjugate())?.map(|z| z.re);
        Some(growth * left.dot(&second) / left.dot(&tangent))
    }
}

/// `A − iω`.
fn shifted(matrix: &DMatrix<Complex<f64>>, frequency: f64) -> DMatrix<Complex<f64>> {
    let n = matrix.nrows();
    matrix - DMatrix::identity(n, n) * Complex::new(0.0, frequency)
}

/// The vector of unit length that a matrix shrinks most.
fn null_vector(m: &DMatrix<Complex<f64>>) -> Option<ComplexVector> {
    let right = singular(m)?.right;
    let last = right.ncols().checked_sub(1)?;
    Some(right.column(last).into())
}
