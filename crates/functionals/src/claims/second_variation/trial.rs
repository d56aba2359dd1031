//! Polynomials for which the second variation is negative, by exact integration.

use super::form::Form;
use crate::polynomial::{Domain, Polynomial};
use crate::signs::{enclosure, on_interval, Sign};
use chetaev_symbolic::{meter, rational, Expr, Rational};
use std::cmp::Ordering;

/// Degrees of the polynomials by which the factors that vanish at the ends are multiplied.
const DEGREES: [u32; 4] = [0, 2, 6, 10];

/// Units of work for a product and a sum of rational numbers.
const STEP: u64 = 100;

/// A form with polynomials on a rational interval.
struct Trial {
    p: Vec<Vec<Polynomial>>,
    q: Vec<Vec<Polynomial>>,
    r: Vec<Vec<Polynomial>>,
    ends: [Vec<Vec<Polynomial>>; 2],
    places: [Rational; 2],
    /// Whether variations vanish at such a place because something is held at the end that lies beside it.
    are_cut: [bool; 2],
    domain: Domain,
}

/// A negative value of the form.
pub(super) struct Negative {
    /// Numbers below and above it.
    pub bounds: [f64; 2],
    /// The part of the interval outside of which the variation is zero.
    pub part: Option<[Rational; 2]>,
    /// The variation, a polynomial for each component.
    pub variation: Vec<Polynomial>,
}

/// A variation: one polynomial for each component.
type Variation = Vec<Polynomial>;

/// Whether the coefficients are polynomials with numbers, so that variations can be tried.
pub(super) fn is_exact(form: &Form<'_>) -> bool {
    let places = [Rational::ZERO, rational::integer(1)];
    Trial::new(form, &places).is_some()
}

/// So many halves one after the other are tried.
const HALVES: u32 = 40;

/// A negative value for a variation that vanishes outside of a part of the interval, where R − Q' is negative at a place in it: beside a small
/// P it has to be short, and no polynomial of low degree on the whole interval is.
pub(super) fn negative_on_part(form: &Form<'_>, places: &[Rational; 2]) -> Option<Negative> {
    let space = &*form.functional.space;
    let g = &space.graph;
    let [lower, upper] = places;
    let centre = |component: usize| {
        let slope = space.total(form.q[component][component], 0);
        let rest = g.sub(form.r[component][component], slope);
        match on_interval(space, rest, (lower, upper)) {
            Sign::Negative(x) => Some(x),
            _ => None,
        }
    };
    let centres: Vec<Rational> = (0..form.count()).filter_map(centre).collect();
    let length = upper - lower;
    (1..=HALVES).find_map(|n| {
        let half = length.clone() / rational::integer(1 << n);
        centres.iter().find_map(|x| {
            let part = [
                lower.clone().max(x - &half),
                upper.clone().min(rational::sum(x, &half)),
            ];
            let trial = Trial {
                are_cut: [true, true],
                ..Trial::new(form, &part)?
            };
            let (bounds, variation) = trial.negative(form, 0)?;
            Some(Negative {
                bounds,
                part: Some(part),
                variation,
            })
        })
    })
}

/// A negative value, where one is found, between two numbers. At an end that is held and no rational number the variation vanishes from a place
/// before on; one that is free is met by rational numbers first, and the value is then enclosed.
pub(super) fn negative(form: &Form<'_>, places: &[Rational; 2]) -> Option<Negative> {
    let trial = Trial::new(form, places)?;
    let mut degrees = DEGREES.into_iter();
    let (bounds, variation) = degrees.find_map(|degree| trial.negative(form, degree))?;
    Some(Negative {
        bounds,
        part: None,
        variation,
    })
}

impl Trial {
    fn new(form: &Form<'_>, places: &[Rational; 2]) -> Option<Trial> {
        let space = &*form.functional.space;
        let of = |matrix: &[Vec<Expr>]| -> Option<Vec<Vec<Polynomial>>> {
            let row = |row: &Vec<Expr>| row.iter().map(|&e| Polynomial::of(space, e)).collect();
            matrix.iter().map(row).collect()
        };
        let [lower, upper] = places.clone();
        let exact = [form.interval.lower, form.interval.upper];
        let is_cut = |at: usize| {
            let is_held = form.ends[at].fixed.iter().any(|fixed| *fixed);
            is_held && space.graph.as_number(exact[at]).is_none()
        };
        Some(Trial {
            p: of(&form.p)?,
            q: of(&form.q)?,
            r: of(&form.r)?,
            ends: [of(&form.ends[0].b)?, of(&form.ends[1].b)?],
            places: places.clone(),
            are_cut: [is_cut(0), is_cut(1)],
            domain: Domain {
                intervals: vec![(0, lower, upper)],
                at: None,
            },
        })
    }

    /// A negative value for polynomials of one degree, and these.
    fn negative(&self, form: &Form<'_>, degree: u32) -> Option<([f64; 2], Variation)> {
        let base = self.base(form, degree);
        let matrix: Vec<Vec<Rational>> = base
            .iter()
            .map(|a| base.iter().map(|b| self.value(a, b)).collect())
            .collect();
        let x = descending(matrix)?;
        let mut v = vec![Polynomial::default(); form.count()];
        for (own, coefficient) in base.iter().zip(&x) {
            for (sum, part) in v.iter_mut().zip(own) {
                sum.add(part, coefficient);
            }
        }
        Some((self.enclosed(form, &v)?, v))
    }

    fn base(&self, form: &Form<'_>, degree: u32) -> Vec<Variation> {
        let one = rational::integer(1);
        let mut found = Vec::new();
        for component in 0..form.count() {
            let mut factor = Polynomial::constant(one.clone());
            for (at, place) in self.places.iter().enumerate() {
                if form.ends[at].fixed[component] || self.are_cut[at] {
                    let mut line = Polynomial::monomial(vec![1], one.clone());
                    line.add(&Polynomial::constant(place.clone()), &rational::integer(-1));
                    factor = factor.times(&line);
                }
            }
            for n in 0..=degree {
                let mut own = vec![Polynomial::default(); form.count()];
                own[component] = factor.times(&Polynomial::monomial(vec![n], one.clone()));
                found.push(own);
            }
        }
        found
    }

    /// The bilinear form.
    fn value(&self, v: &[Polynomial], w: &[Polynomial]) -> Rational {
        let mut sum = self.inside(v, w).integral(&self.domain);
        for (at, place) in self.places.iter().enumerate() {
            let product = self.at_end(at, v, w).exact(std::slice::from_ref(place));
            sum = rational::sum(&sum, &product);
        }
        sum
    }

    /// What stands under the integral.
    fn inside(&self, v: &[Polynomial], w: &[Polynomial]) -> Polynomial {
        let one = rational::integer(1);
        let mut found = Polynomial::default();
        for (a, own) in v.iter().enumerate().filter(|(_, own)| !own.is_zero()) {
            for (b, other) in w.iter().enumerate().filter(|(_, other)| !other.is_zero()) {
                let (slope, other_slope) = (own.slope(0), other.slope(0));
                found.add(&self.p[a][b].times(&slope).times(&other_slope), &one);
                found.add(&self.q[a][b].times(&slope).times(other), &one);
                found.add(&self.q[b][a].times(own).times(&other_slope), &one);
                found.add(&self.r[a][b].times(own).times(other), &one);
            }
        }
        found
    }

    /// What is added at an end.
    fn at_end(&self, at: usize, v: &[Polynomial], w: &[Polynomial]) -> Polynomial {
        let mut found = Polynomial::default();
        for (own, row) in v.iter().zip(&self.ends[at]) {
            for (other, b) in w.iter().zip(row) {
                found.add(&b.times(own).times(other), &rational::integer(1));
            }
        }
        found
    }

    /// Numbers on both sides of the value of a variation, where it is negative; the variation is continued by zero from the places at which it
    /// is held.
    fn enclosed(&self, form: &Form<'_>, v: &[Polynomial]) -> Option<[f64; 2]> {
        let space = &*form.functional.space;
        let g = &space.graph;
        let x = space.coordinates.first()?.expr;
        let of = |polynomial: Polynomial, place: Expr| {
            g.substitute(polynomial.expr(space), &[(x, place)])
        };
        let exact = [form.interval.lower, form.interval.upper];
        let whole = self.inside(v, v).primitive(0);
        let mut terms = Vec::new();
        for (at, sign) in [(0, -1), (1, 1)] {
            let place = if self.are_cut[at] {
                g.number(self.places[at].clone())
            } else {
                exact[at]
            };
            terms.push(g.mul(&[g.integer(sign), of(whole.clone(), place)]));
            terms.push(of(self.at_end(at, v, v), place));
        }
        let found = enclosure(space, g.add(&terms))?;
        let is_negative = found.sign() == Some(Ordering::Less);
        is_negative.then(|| [found.lower().to_f64(), found.upper().to_f64()])
    }
}

/// A vector with a negative value of the quadratic form, by completing squares (J.-L. Lagrange 1759): the vectors of a base are made orthogonal to
/// those that have positive values, until one has a negative value, or two without value have one together.
fn descending(mut matrix: Vec<Vec<Rational>>) -> Option<Vec<Rational>> {
    let n = matrix.len();
    let unit = |k: usize| {
        (0..n)
            .map(|i| rational::integer(i64::from(i == k)))
            .collect()
    };
    let mut base: Vec<Vec<Rational>> = (0..n).map(unit).collect();
    let mut left: Vec<usize> = (0..n).collect();
    while !left.is_empty() {
        let value = |k: &usize| matrix[*k][*k].clone();
        if let Some(&k) = left.iter().find(|k| rational::is_negative(&value(k))) {
            return Some(base.swap_remove(k));
        }
        let Some(at) = left.iter().position(|k| value(k) != Rational::ZERO) else {
            return together(&matrix, &base, &left);
        };
        let k = left.remove(at);
        for &r in &left {
            meter::spend(STEP * n as u64);
            let factor = &matrix[r][k] / &matrix[k][k];
            if factor == Rational::ZERO {
                continue;
            }
            base[r] = combined(&base[r], &base[k], &-factor.clone());
            matrix[r] = combined(&matrix[r], &matrix[k], &-factor);
        }
    }
    None
}

/// Two vectors of which each has the value zero, and their sum or their difference a negative one.
fn together(
    matrix: &[Vec<Rational>],
    base: &[Vec<Rational>],
    left: &[usize],
) -> Option<Vec<Rational>> {
    let pairs = left.iter().flat_map(|&r| left.iter().map(move |&k| (r, k)));
    let mut pairs = pairs.filter(|(r, k)| matrix[*r][*k] != Rational::ZERO);
    let (r, k) = pairs.next()?;
    let is_negative = rational::is_negative(&matrix[r][k]);
    let sign = rational::integer(if is_negative { 1 } else { -1 });
    Some(combined(&base[r], &base[k], &sign))
}

/// `a + factor b`.
fn combined(a: &[Rational], b: &[Rational], factor: &Rational) -> Vec<Rational> {
    let term = |(x, y): (&Rational, &Rational)| rational::sum(x, &rational::product(factor, y));
    a.iter().zip(b).map(term).collect()
}
