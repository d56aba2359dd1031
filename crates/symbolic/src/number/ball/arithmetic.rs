//! The field operations, integer powers and square roots of balls at a given precision.

use std::cmp::Ordering;

use dashu_base::{BitTest, Sign, SquareRoot};
use dashu_int::IBig;
use dashu_ratio::RBig;

use super::{absolute, Ball, BallError, BallResult, Magnitude};

/// The number of bits kept of midpoints.
///
/// Every operation on balls is a method of it: `precision.mul(&a, &b)`.
#[derive(Clone, Debug)]
pub struct Precision {
    bits: usize,
}

impl Precision {
    /// Midpoints of `bits` bits (at least 16).
    pub fn new(bits: usize) -> Self {
        Self { bits: bits.max(16) }
    }

    /// The number of bits kept.
    pub fn bits(&self) -> usize {
        self.bits
    }

    /// The enclosure of a rational number.
    pub fn rational(&self, number: &RBig) -> Ball {
        let numerator = Ball::dyadic(number.numerator().clone(), 0);
        if number.is_int() {
            return numerator.rounded(self.bits);
        }
        self.quotient(number.numerator(), number.denominator().as_ibig(), 0)
    }

    /// numerator/denominator·2^exponent for a denominator > 0.
    fn quotient(&self, numerator: &IBig, denominator: &IBig, exponent: i64) -> Ball {
        let (long, short) = (denominator.bit_len(), absolute(numerator).bit_len());
        let shift = (self.bits + 2 + long).saturating_sub(short);
        let scaled = numerator << shift;
        let quotient = &scaled / denominator;
        let exact = &quotient * denominator == scaled;
        let exponent = exponent.saturating_sub(shift as i64);
        let ball = Ball::dyadic(quotient, exponent);
        let ball = if exact {
            ball
        } else {
            ball.widened(Magnitude::power_of_two(exponent))
        };
        ball.rounded(self.bits)
    }

    /// x + y.
    pub fn add(&self, x: &Ball, y: &Ball) -> BallResult {
        let (low, high) = if x.exponent <= y.exponent {
            (x, y)
        } else {
            (y, x)
        };
        if low.mantissa.is_zero() || high.mantissa.is_zero() {
            let kept = if low.mantissa.is_zero() { high } else { low };
            let radius = low.radius.plus(high.radius);
            return Ball {
                radius,
                ..kept.clone()
            }
            .rounded(self.bits)
            .checked("a sum");
        }
        let gap = high.exponent - low.exponent;
        let reach = (2 * self.bits + absolute(&low.mantissa).bit_len()) as i64;
        let sum = if gap > reach {
            // `low` is below the last bit that will be kept.
            high.clone().widened(low.magnitude())
        } else {
            high.exact_add(low)
        };
        sum.rounded(self.bits).checked("a sum")
    }

    /// x − y.
    pub fn sub(&self, x: &Ball, y: &Ball) -> BallResult {
        self.add(x, &y.neg())
    }

    /// x·y.
    pub fn mul(&self, x: &Ball, y: &Ball) -> BallResult {
        let radius = if x.is_exact() && y.is_exact() {
            Magnitude::ZERO
        } else {
            // |xy − x₀y₀| ≤ |x₀| r_y + |y₀| r_x + r_x r_y
            let (a, b) = (x.midpoint().magnitude(), y.midpoint().magnitude());
            a.times(y.radius)
                .plus(b.times(x.radius))
                .plus(x.radius.times(y.radius))
        };
        let product = Ball {
            mantissa: &x.mantissa * &y.mantissa,
            exponent: x.exponent.saturating_add(y.exponent),
            radius,
        };
        product.rounded(self.bits).checked("a product")
    }

    /// x/y.
    pub fn div(&self, x: &Ball, y: &Ball) -> BallResult {
        match y.sign() {
            Some(Ordering::Equal) => return Err(BallError::Undefined("a division by zero")),
            None => return Err(BallError::Uncertain("a quotient")),
            Some(_) => {}
        }
        let negative = y.mantissa.sign() == Sign::Negative;
        let (numerator, denominator) = if negative {
            (-&x.mantissa, -&y.mantissa)
        } else {
            (x.mantissa.clone(), y.mantissa.clone())
        };
        let center = self.quotient(
            &numerator,
            &denominator,
            x.exponent.saturating_sub(y.exponent),
        );
        if x.is_exact() && y.is_exact() {
            return center.checked("a quotient");
        }
        // |x/y − x₀/y₀| ≤ (r_x + |x₀/y₀| r_y) / |y|, where |y| ≥ a lower bound taken from the end nearest to 0.
        let least = if negative { y.upper().neg() } else { y.lower() };
        let reciprocal = reciprocal_bound(&least);
        let error = x
            .radius
            .plus(center.magnitude().times(y.radius))
            .times(reciprocal);
        center.widened(error).checked("a quotient")
    }

    /// x^n for an integer n; x^0 = 1.
    pub fn powi(&self, x: &Ball, n: &IBig) -> BallResult {
        if n.sign() == Sign::Negative {
            let inverse = self.div(&Ball::integer(1), x)?;
            return self.powi(&inverse, &-n);
        }
        if n.bit_len() > 64 && x.magnitude() != Magnitude::ZERO && *x != Ball::integer(1) {
            return Err(BallError::TooLarge("a power"));
        }
        if n.bit_len() > 0 && !n.bit(0) && x.sign().is_none() {
            // An even power of a ball around 0 is [0, max|x|^n].
            let (mantissa, exponent) = x.magnitude().parts();
            let top = self.powi(&Ball::dyadic(mantissa, exponent), n)?;
            return Ok(self.abs(&Ball::zero().widened(top.magnitude())));
        }
        let mut result = Ball::integer(1);
        for bit in (0..n.bit_len()).rev() {
            result = self.mul(&result, &result)?;
            if n.bit(bit) {
                result = self.mul(&result, x)?;
            }
        }
        Ok(result)
    }

    /// |x|, a ball without negative points (its midpoint not below its radius) when x is around 0.
    pub fn abs(&self, x: &Ball) -> Ball {
        match x.sign() {
            Some(Ordering::Less) => x.neg(),
            Some(_) => x.clone(),
            None => {
                // [0, b] has its midpoint and its radius at b/2.
                let half = x.magnitude().shift(-1);
                let (mantissa, exponent) = half.parts();
                Ball {
                    mantissa,
                    exponent,
                    radius: half,
                }
            }
        }
    }

    /// The square root.
    pub fn sqrt(&self, x: &Ball) -> BallResult {
        match x.sign() {
            Some(Ordering::Less) => {
                return Err(BallError::Undefined("a square root of a negative number"))
            }
            Some(Ordering::Equal) => return Ok(Ball::zero()),
            Some(Ordering::Greater) => {}
            None if x.lower().mantissa.is_zero() => {
                // [0, b] goes to [0, √b].
                let top = self.sqrt(&x.upper())?;
                let bound = top.magnitude();
                return Ok(self.abs(&Ball::zero().widened(bound)));
            }
            None => return Err(BallError::Uncertain("a square root")),
        }
        let center = self.sqrt_exact(&x.mantissa, x.exponent);
        if x.is_exact() {
            return Ok(center);
        }
        // |√x − √x₀| = |x − x₀| / (√x + √x₀) ≤ r / √x₀
        let error = x.radius.times(reciprocal_bound(&center.lower()));
        center.widened(error).checked("a square root")
    }

    /// √(mantissa·2^exponent) for mantissa > 0.
    fn sqrt_exact(&self, mantissa: &IBig, exponent: i64) -> Ball {
        let length = absolute(mantissa).bit_len();
        let mut shift = (2 * self.bits + 4).saturating_sub(length) as i64;
        if (exponent - shift) % 2 != 0 {
            shift += 1;
        }
        let (_, scaled) = (mantissa << shift as usize).into_parts();
        let root = IBig::from(scaled.sqrt());
        let exact = &root * &root == IBig::from(scaled);
        let exponent = (exponent - shift) / 2;
        let ball = Ball::dyadic(root, exponent);
        let ball = if exact {
            ball
        } else {
            ball.widened(Magnitude::power_of_two(exponent))
        };
        ball.rounded(self.bits)
    }

    /// A ball containing both balls.
    pub fn union(&self, x: &Ball, y: &Ball) -> BallResult {
        let middle = self.add(x, y)?.shift(-1).midpoint();
        let reach = |ball: &Ball| {
            self.sub(ball, &middle)
                .map(|difference| difference.magnitude())
        };
        let radius = reach(x)?.max(reach(y)?);
        Ok(middle.widened(radius))
    }
}

/// An upper bound of 1/x for an exact x > 0.
pub(super) fn reciprocal_bound(x: &Ball) -> Magnitude {
    let (_, natural) = x.mantissa.clone().into_parts();
    // 1/(m·2^e) ≤ 1/(top·2^(e + s)) for top = ⌊m/2^s⌋.
    let excess = natural.bit_len().saturating_sub(40);
    let top = u64::try_from(&(natural >> excess)).unwrap_or(1).max(1);
    let numerator = u64::MAX >> 1;
    Magnitude::of(
        &IBig::from(numerator / top + 1),
        (-63_i64)
            .saturating_sub(x.exponent)
            .saturating_sub(excess as i64),
    )
}
