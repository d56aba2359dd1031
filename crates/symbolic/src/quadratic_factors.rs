//! Factors of degree one and two of a polynomial in one variable with rational coefficients.
//!
//! Roots are found numerically (Durand 1960, Kerner 1966); a sum and a product of two of them that are near simple fractions are a
//! candidate, and exact division decides.

use crate::rational::{ratio, to_f64};
use crate::Rational;

/// Higher degrees are not looked at.
const DEGREE: usize = 12;

/// Denominators of candidates.
const DENOMINATOR: i64 = 10_000;

const ITERATIONS: usize = 400;

/// The monic factors of degree one and two, coefficients ascending, each once: those of degree one first. `coefficients` ascend too, the
/// polynomial is square-free.
pub fn linear_and_quadratic(coefficients: &[Rational]) -> Vec<Vec<Rational>> {
    let degree = coefficients.len().saturating_sub(1);
    let Some(lead) = coefficients.last().filter(|c| !c.is_zero()) else {
        return Vec::new();
    };
    if degree == 0 || degree > DEGREE {
        return Vec::new();
    }
    let mut rest: Vec<Rational> = coefficients.iter().map(|c| c / lead).collect();
    let roots = roots(&rest.iter().map(to_f64).collect::<Vec<f64>>());
    let linear = roots.iter().map(|&(re, _)| vec![-re]);
    let pairs = roots.iter().enumerate().flat_map(|(i, &(a, b))| {
        let others = roots[..i].iter();
        others.map(move |&(c, d)| vec![a * c - b * d, -(a + c)])
    });
    let mut found = Vec::new();
    for candidate in linear.chain(pairs) {
        let near: Option<Vec<Rational>> = candidate.into_iter().map(fraction).collect();
        let Some(mut factor) = near else { continue };
        factor.push(Rational::ONE);
        if let Some(quotient) = quotient(&rest, &factor) {
            rest = quotient;
            found.push(factor);
        }
    }
    found
}

/// The exact quotient by a monic polynomial.
fn quotient(a: &[Rational], by: &[Rational]) -> Option<Vec<Rational>> {
    let mut rest = a.to_vec();
    let steps = a.len().checked_sub(by.len())?;
    let mut quotient = vec![Rational::ZERO; steps + 1];
    for place in (0..=steps).rev() {
        let lead = rest[place + by.len() - 1].clone();
        for (i, c) in by.iter().enumerate() {
            rest[place + i] = rest[place + i].clone() - &lead * c;
        }
        quotient[place] = lead;
    }
    rest.iter().all(Rational::is_zero).then_some(quotient)
}

/// The simplest fraction near a number, by its continued fraction.
fn fraction(x: f64) -> Option<Rational> {
    let near = 1e-9 * x.abs().max(1.0);
    let (mut before, mut now) = ((0_i64, 1_i64), (1_i64, 0_i64));
    let mut rest = x;
    for _ in 0..20 {
        let whole = rest.floor();
        if whole.abs() > 1e9 {
            return None;
        }
        let step = |a: i64, b: i64| (whole as i64).checked_mul(b)?.checked_add(a);
        let next = (step(before.0, now.0)?, step(before.1, now.1)?);
        (before, now) = (now, next);
        if now.1 > DENOMINATOR {
            return None;
        }
        if (x - now.0 as f64 / now.1 as f64).abs() <= near {
            return ratio(now.0, now.1);
        }
        rest = 1.0 / (rest - whole);
    }
    None
}

/// All roots of a monic polynomial, as real and imaginary parts.
fn roots(monic: &[f64]) -> Vec<(f64, f64)> {
    let degree = monic.len() - 1;
    let size = 1.0 + monic.iter().fold(0.0_f64, |m, c| m.max(c.abs()));
    let times = |(a, b): (f64, f64), (c, d): (f64, f64)| (a * c - b * d, a * d + b * c);
    let over = |(a, b): (f64, f64), (c, d): (f64, f64)| {
        let square = c * c + d * d;
        ((a * c + b * d) / square, (b * c - a * d) / square)
    };
    // Points on a circle that is not symmetric about the real axis.
    let start = |i: usize| {
        let angle = 0.4 + std::f64::consts::TAU * i as f64 / degree as f64;
        let radius = size.powf(1.0 / degree as f64);
        (radius * angle.cos(), radius * angle.sin())
    };
    let mut found: Vec<(f64, f64)> = (0..degree).map(start).collect();
    for _ in 0..ITERATIONS {
        for i in 0..degree {
            let z = found[i];
            let value = monic.iter().rev().fold((0.0, 0.0), |sum, &c| {
                let (re, im) = times(sum, z);
                (re + c, im)
            });
            let others = found.iter().enumerate().filter(|(j, _)| *j != i);
            let product = others.fold((1.0, 0.0), |p, (_, &w)| times(p, (z.0 - w.0, z.1 - w.1)));
            let step = over(value, product);
            found[i] = (z.0 - step.0, z.1 - step.1);
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rational::integer;

    fn product(factors: &[&[Rational]]) -> Vec<Rational> {
        factors.iter().fold(vec![Rational::ONE], |all, factor| {
            let mut next = vec![Rational::ZERO; all.len() + factor.len() - 1];
            for (i, a) in all.iter().enumerate() {
                for (j, b) in factor.iter().enumerate() {
                    next[i + j] = next[i + j].clone() + a * b;
                }
            }
            next
        })
    }

    #[test]
    fn products_come_apart() {
        let of = |c: &[(i64, i64)]| -> Vec<Rational> {
            c.iter().map(|&(n, d)| ratio(n, d).unwrap()).collect()
        };
        let oscillators = [
            of(&[(1, 1), (1, 5), (1, 1)]),
            of(&[(3, 1), (1, 5), (1, 1)]),
            of(&[(-7, 3), (1, 1)]),
        ];
        let all = product(&oscillators.each_ref().map(|f| &f[..]));
        let found = linear_and_quadratic(&all);
        assert_eq!(found.len(), 3);
        assert!(oscillators.iter().all(|f| found.contains(f)));
    }

    #[test]
    fn what_has_none_gives_none() {
        // x³ - 2 is irreducible; so is x⁵ - x - 1.
        let cubic = [-2, 0, 0, 1].map(integer);
        let quintic = [-1, -1, 0, 0, 0, 1].map(integer);
        assert!(linear_and_quadratic(&cubic).is_empty());
        assert!(linear_and_quadratic(&quintic).is_empty());
    }
}
