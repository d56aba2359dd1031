//! Real zeros of a polynomial whose coefficients are enclosed.
//!
//! An interval over which the polynomial is enclosed away from zero holds no zero; one over which the derivative is, and at whose ends the signs
//! differ, exactly one (Moore 1966). All zeros lie within Cauchy's bound.

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
    let own = Enclosed {
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
struct Enclosed<'a> {
    precision: &'a Precision,
    /// The constant first, the last one not zero.
    coefficients: &'a [Ball],
}

impl Enclosed<'_> {
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

    fn sign(&self, at: &RBig) -> Option<Ordering> {
        let (value, _) = self.at(&self.precision.rational(at)).ok()?;
        value.sign().filter(|sign| *sign != Ordering::Equal)
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
        let (mut open, mut found) = (vec![(-bound.clone(), bound)], Vec::new());
        let mut looked = 0;
        while let Some((a, b)) = open.pop() {
            looked += 1;
            if looked > INTERVALS {
                return None;
            }
            let (value, slope) = self.at(&self.over(&a, &b)?).ok()?;
            if value.excludes_zero() {
                continue;
            }
            if slope.excludes_zero() {
                let (left, right) = (self.sign(&a)?, self.sign(&b)?);
                if left != right {
                    found.push(self.refined(a, b, left)?);
                }
                continue;
            }
            let middle = self.between(&a, &b)?;
            open.push((a, middle.clone()));
            open.push((middle, b));
        }
        Some(found)
    }

    /// A place near the middle at which the sign is known.
    fn between(&self, a: &RBig, b: &RBig) -> Option<RBig> {
        let at = |part: u8| a + (b - a) * RBig::from(part) / RBig::from(64_u8);
        let mut places = [32, 31, 35, 27].into_iter().map(at);
        places.find(|place| self.sign(place).is_some())
    }

    /// The only zero between two places with different signs, `left` being that of the lower one.
    fn refined(&self, mut a: RBig, mut b: RBig, left: Ordering) -> Option<Ball> {
        for _ in 0..HALVINGS {
            let Some(middle) = self.between(&a, &b) else {
                break;
            };
            if self.sign(&middle)? == left {
                a = middle;
            } else {
                b = middle;
            }
        }
        self.over(&a, &b)
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
