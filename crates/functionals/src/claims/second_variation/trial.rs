//! Polynomials for which the second variation is negative, by exact integration.

use super::form::Form;
use crate::linear::System;
use crate::polynomial::{Domain, Polynomial};
use chetaev_symbolic::{rational, Expr, Rational};

/// Degrees of the polynomials by which the factors that vanish at the ends are multiplied.
const DEGREES: [u32; 4] = [0, 2, 6, 10];

/// A form with polynomials on a rational interval.
struct Trial {
    p: Vec<Vec<Polynomial>>,
    q: Vec<Vec<Polynomial>>,
    r: Vec<Vec<Polynomial>>,
    ends: [Vec<Vec<Polynomial>>; 2],
    places: [Rational; 2],
    domain: Domain,
}

/// A variation: one polynomial for each component.
type Variation = Vec<Polynomial>;

/// A negative value, where one is found between these places; they lie inside the interval, and where they are not its ends the variation
/// vanishes there.
pub(super) fn negative(
    form: &Form<'_>,
    places: &[Rational; 2],
    are_ends: [bool; 2],
) -> Option<Rational> {
    let trial = Trial::new(form, places)?;
    DEGREES.into_iter().find_map(|degree| {
        let base = trial.base(form, degree, are_ends);
        let matrix: Vec<Vec<Rational>> = base
            .iter()
            .map(|a| base.iter().map(|b| trial.value(a, b)).collect())
            .collect();
        let x = descending(matrix)?;
        let mut v = vec![Polynomial::default(); form.count()];
        for (own, coefficient) in base.iter().zip(&x) {
            for (sum, part) in v.iter_mut().zip(own) {
                sum.add(part, coefficient);
            }
        }
        let value = trial.value(&v, &v);
        rational::is_negative(&value).then_some(value)
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
        Some(Trial {
            p: of(&form.p)?,
            q: of(&form.q)?,
            r: of(&form.r)?,
            ends: [of(&form.ends[0].b)?, of(&form.ends[1].b)?],
            places: places.clone(),
            domain: Domain {
                intervals: vec![(0, lower, upper)],
                at: None,
            },
        })
    }

    fn base(&self, form: &Form<'_>, degree: u32, are_ends: [bool; 2]) -> Vec<Variation> {
        let one = rational::integer(1);
        let mut found = Vec::new();
        for component in 0..form.count() {
            let mut factor = Polynomial::constant(one.clone());
            for (at, end) in form.ends.iter().enumerate() {
                if end.fixed[component] || !are_ends[at] {
                    let mut line = Polynomial::monomial(vec![1], one.clone());
                    line.add(
                        &Polynomial::constant(self.places[at].clone()),
                        &rational::integer(-1),
                    );
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
        let one = rational::integer(1);
        let mut inside = Polynomial::default();
        let mut sum = Rational::ZERO;
        for (a, own) in v.iter().enumerate().filter(|(_, own)| !own.is_zero()) {
            for (b, other) in w.iter().enumerate().filter(|(_, other)| !other.is_zero()) {
                let (slope, other_slope) = (own.slope(0), other.slope(0));
                inside.add(&self.p[a][b].times(&slope).times(&other_slope), &one);
                inside.add(&self.q[a][b].times(&slope).times(other), &one);
                inside.add(&self.q[b][a].times(own).times(&other_slope), &one);
                inside.add(&self.r[a][b].times(own).times(other), &one);
                for (end, place) in self.ends.iter().zip(&self.places) {
                    let at = std::slice::from_ref(place);
                    let product = end[a][b].times(own).times(other).exact(at);
                    sum = rational::sum(&sum, &product);
                }
            }
        }
        rational::sum(&sum, &inside.integral(&self.domain))
    }
}

/// A vector with a negative value of the quadratic form, by completing squares.
fn descending(mut matrix: Vec<Vec<Rational>>) -> Option<Vec<Rational>> {
    let n = matrix.len();
    let original = matrix.clone();
    for k in 0..n {
        let pivot = matrix[k][k].clone();
        if rational::is_negative(&pivot) {
            // The first k components follow from the condition that their rows vanish.
            let mut block = System::new(k);
            for (r, row) in original.iter().enumerate().take(k) {
                for (c, value) in row.iter().enumerate().take(k) {
                    block.add(r, c, value);
                }
                block.add_right(r, &-row[k].clone());
            }
            let mut x = block.solution()?.values;
            x.push(rational::integer(1));
            x.resize(n, Rational::ZERO);
            return Some(x);
        }
        if pivot == Rational::ZERO {
            return None;
        }
        for r in k + 1..n {
            let factor = &matrix[r][k] / &pivot;
            let pivot_row = matrix[k].clone();
            for (own, above) in matrix[r].iter_mut().zip(&pivot_row).skip(k) {
                let term = rational::product(&factor, above);
                *own = &*own - &term;
            }
        }
    }
    None
}
