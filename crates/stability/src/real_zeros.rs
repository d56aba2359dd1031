//! Real zeros of a polynomial whose coefficients are enclosed.
//!
//! They are isolated by bisection ([`isolation`](crate::isolation)). All zeros lie within Cauchy's bound.

use crate::isolation::{isolated, Enclosed, Look};
use chetaev_symbolic::number::ball::{Ball, BallError, Precision};
use dashu_ratio::RBig;
use std::cmp::Ordering;

/// At most so many intervals are looked at.
const INTERVALS: usize = 4_000;
/// Halvings of an interval that holds one zero.
const HALVINGS: usize = 160;

/// Enclosures of all real zeros of the polynomial with these coefficients, the constant first; `None` where their number was not decided, as
/// where the leading coefficient may vanish, or a zero may be multiple.
pub(crate) fn real_zeros(precision: &Precision, coefficients: &[Ball]) -> Option<Vec<Ball>> {
    let is_nothing = |ball: &&Ball| ball.is_exact() && ball.contains_zero();
    let zeros = coefficients.iter().take_while(is_nothing).count();
    let own = Polynomial {
        precision,
        coefficients: coefficients.get(zeros..)?,
    };
    if !own.coefficients.last()?.excludes_zero() || zeros > 1 {
        return None;
    }
    let mut found = match own.coefficients {
        [_] => Vec::new(),
        [b, a] => vec![precision.div(&b.neg(), a).ok()?],
        [c, b, a] => own.of_quadratic(a, b, c)?,
        _ => own.isolated()?,
    };
    if zeros == 1 {
        found.push(Ball::zero());
    }
    found.sort_by(|a, b| a.to_f64().total_cmp(&b.to_f64()));
    Some(found)
}

/// A polynomial.
struct Polynomial<'a> {
    precision: &'a Precision,
    /// The constant first, the last one not zero.
    coefficients: &'a [Ball],
}

impl Polynomial<'_> {
    fn of_quadratic(&self, a: &Ball, b: &Ball, c: &Ball) -> Option<Vec<Ball>> {
        let p = self.precision;
        let product = p.mul(a, c).ok()?.shift(2);
        let discriminant = p.sub(&p.mul(b, b).ok()?, &product).ok()?;
        match discriminant.sign()? {
            Ordering::Less => Some(Vec::new()),
            Ordering::Equal => Some(vec![p.div(&b.neg(), &a.shift(1)).ok()?]),
            Ordering::Greater => {
                let root = p.sqrt(&discriminant).ok()?;
                let of = |root: &Ball| p.div(&p.sub(root, b).ok()?, &a.shift(1)).ok();
                Some(vec![of(&root)?, of(&root.neg())?])
            }
        }
    }

    /// Value and derivative for all arguments in a ball.
    fn at(&self, x: &Ball) -> Result<(Ball, Ball), BallError> {
        let p = self.precision;
        let (mut value, mut slope) = (Ball::zero(), Ball::zero());
        for coefficient in self.coefficients.iter().rev() {
            slope = p.add(&p.mul(&slope, x)?, &value)?;
            value = p.add(&p.mul(&value, x)?, coefficient)?;
        }
        Ok((value, slope))
    }

    fn over(&self, low: &RBig, high: &RBig) -> Option<Ball> {
        let end = |at| self.precision.rational(at);
        self.precision.union(&end(low), &end(high)).ok()
    }

    /// A power of two beyond all zeros, on both sides.
    fn bound(&self) -> Option<RBig> {
        let (leading, rest) = self.coefficients.split_last()?;
        let ratio = |own: &Ball| Some(self.precision.div(own, leading).ok()?.log2_ceil());
        let sizes: Option<Vec<Option<i64>>> = rest.iter().map(ratio).collect();
        let largest = sizes?.into_iter().flatten().max().unwrap_or(0).max(0);
        Ball::integer(1).shift(largest + 1).to_rational()
    }

    fn isolated(&self) -> Option<Vec<Ball>> {
        let bound = self.bound()?;
        let found = isolated(self, &-bound.clone(), &bound, INTERVALS, HALVINGS)?;
        found
            .iter()
            .map(|own| self.over(&own.low, &own.high))
            .collect()
    }
}

impl Enclosed for Polynomial<'_> {
    fn sign(&self, at: &RBig) -> Option<Ordering> {
        let (value, _) = self.at(&self.precision.rational(at)).ok()?;
        value.sign()
    }

    fn between(&self, low: &RBig, high: &RBig) -> Look {
        let found = self.over(low, high).map(|over| self.at(&over));
        match found {
            Some(Ok((value, _))) if value.excludes_zero() => Look::Empty,
            Some(Ok((_, slope))) if slope.excludes_zero() => Look::Monotonic,
            _ => Look::Open,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn zeros(coefficients: &[i64]) -> Vec<f64> {
        let balls: Vec<Ball> = coefficients.iter().map(|&c| Ball::integer(c)).collect();
        let found = real_zeros(&Precision::new(256), &balls);
        let found = found.unwrap_or_else(|| panic!("{coefficients:?}"));
        found.iter().map(Ball::to_f64).collect()
    }

    /// x³ − 2 has one real zero, the cube root of two; (x² + 1)(x² − 2) the two square roots; x (x³ − x − 1) zero and the plastic number.
    #[test]
    fn all_real_zeros_are_enclosed() {
        let near = |found: Vec<f64>, expected: &[f64]| {
            assert_eq!(found.len(), expected.len(), "{found:?}");
            for (a, b) in found.iter().zip(expected) {
                assert!((a - b).abs() < 1e-15, "{found:?}");
            }
        };
        near(zeros(&[-2, 0, 0, 1]), &[2_f64.cbrt()]);
        let root = 2_f64.sqrt();
        near(zeros(&[-2, 0, -1, 0, 1]), &[-root, root]);
        near(zeros(&[0, -1, -1, 0, 1]), &[0.0, 1.324_717_957_244_746]);
        near(zeros(&[1, 0, 1]), &[]);
    }
}
