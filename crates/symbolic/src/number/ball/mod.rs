//! Balls: midpoint and radius at any precision, every operation enclosing the exact result.
//!
//! A [`Ball`] is the set of reals within `radius` of `midpoint`; the result of an operation contains the operation's
//! value for *every* choice of arguments in the argument balls. The midpoint is an exact dyadic number on big integers and
//! the elementary functions are Taylor series evaluated *in balls* with their remainder added, so a bound never rests
//! on somebody's rounding claim: it is a consequence of integer arithmetic.
//!
//! Method: F. Johansson, "Arb: efficient arbitrary-precision midpoint-radius interval arithmetic", IEEE Trans. Comp. 66 (2017).
//!
//! A function asked outside of its domain gives [`BallError::Undefined`]; a ball that touches the edge of the
//! domain, where more precision may help, gives [`BallError::Uncertain`]. There is no NaN.

mod arithmetic;
mod elementary;
mod inverse;
mod linear;
mod magnitude;

pub use arithmetic::Precision;
pub use linear::solve;
pub use magnitude::Magnitude;

use std::cmp::Ordering;
use std::fmt;

use dashu_base::{BitTest, Sign};
use dashu_int::IBig;
use dashu_ratio::RBig;
use thiserror::Error;

/// Exponents beyond this are refused as [`BallError::TooLarge`], so that no shift can exhaust the memory.
const EXPONENT_LIMIT: i64 = 1 << 40;

/// Why an operation on balls has no enclosure.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub enum BallError {
    /// Every point of the argument lies outside of the function's real domain.
    #[error("{0} is not defined there")]
    Undefined(&'static str),
    /// The argument touches the edge of the domain (or a jump): a higher precision may decide.
    #[error("the enclosure is too wide to evaluate {0}")]
    Uncertain(&'static str),
    /// The value exceeds 2^(2^40) in size or needs an argument reduction of that length.
    #[error("{0} is too large to enclose")]
    TooLarge(&'static str),
}

/// A result that may fail to exist; see [`BallError`].
pub type BallResult = Result<Ball, BallError>;

/// The reals within `radius` of mantissa·2^exponent.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Ball {
    mantissa: IBig,
    exponent: i64,
    radius: Magnitude,
}

impl Ball {
    /// The single point 0.
    pub fn zero() -> Self {
        Self::integer(0)
    }

    /// The single point n.
    pub fn integer(n: i64) -> Self {
        Self {
            mantissa: IBig::from(n),
            exponent: 0,
            radius: Magnitude::ZERO,
        }
    }

    /// The single point mantissa·2^exponent.
    pub fn dyadic(mantissa: IBig, exponent: i64) -> Self {
        Self {
            mantissa,
            exponent,
            radius: Magnitude::ZERO,
        }
    }

    /// The exact value of a finite `f64`; `None` for NaN and infinities.
    pub fn from_f64(value: f64) -> Option<Self> {
        if !value.is_finite() {
            return None;
        }
        let bits = value.to_bits();
        let biased = (bits >> 52 & 0x7ff) as i64;
        let fraction = (bits & ((1 << 52) - 1)) as i64;
        let (magnitude, exponent) = if biased == 0 {
            (fraction, -1074)
        } else {
            (fraction | 1 << 52, biased - 1075)
        };
        let mantissa = IBig::from(if value.is_sign_negative() {
            -magnitude
        } else {
            magnitude
        });
        Some(Self::dyadic(mantissa, exponent))
    }

    /// The same midpoint with `extra` added to the radius.
    pub fn widened(mut self, extra: Magnitude) -> Self {
        self.radius = self.radius.plus(extra);
        self
    }

    /// The midpoint alone, as an exact ball.
    pub fn midpoint(&self) -> Self {
        Self {
            radius: Magnitude::ZERO,
            ..self.clone()
        }
    }

    /// The radius.
    pub fn radius(&self) -> Magnitude {
        self.radius
    }

    /// Is this a single point?
    pub fn is_exact(&self) -> bool {
        self.radius.is_zero()
    }

    /// An upper bound of |x| over the ball.
    pub fn magnitude(&self) -> Magnitude {
        Magnitude::of(&self.mantissa, self.exponent).plus(self.radius)
    }

    /// An exact ball not above any point of the ball (its lower end, but for numbers of very different size).
    pub fn lower(&self) -> Self {
        self.end(Sign::Negative)
    }

    /// An exact ball not below any point of the ball.
    pub fn upper(&self) -> Self {
        self.end(Sign::Positive)
    }

    fn end(&self, side: Sign) -> Self {
        /// Further apart than this, the smaller of midpoint and radius is rounded outwards instead of aligned.
        const FAR: i64 = 1 << 14;
        if self.is_exact() {
            return self.clone();
        }
        let (mut radius, mut exponent) = self.radius.parts();
        let mut midpoint = self.midpoint();
        if exponent < self.exponent - FAR {
            (radius, exponent) = (IBig::from(1), self.exponent - FAR);
        } else if exponent > self.exponent + FAR {
            (radius, exponent) = self.magnitude().plus(self.radius).parts();
            midpoint = Self::zero();
            midpoint.exponent = exponent;
        }
        let signed = if side == Sign::Negative {
            -radius
        } else {
            radius
        };
        midpoint.exact_add(&Self::dyadic(signed, exponent))
    }

    /// The sign of every point of the ball: `Less` (all negative), `Equal` (the point 0), `Greater`, or `None`
    /// when the ball contains 0 and something else.
    pub fn sign(&self) -> Option<Ordering> {
        if self.is_exact() && self.mantissa.is_zero() {
            return Some(Ordering::Equal);
        }
        if !self.excludes_zero() {
            return None;
        }
        Some(match self.mantissa.sign() {
            Sign::Positive => Ordering::Greater,
            Sign::Negative => Ordering::Less,
        })
    }

    /// Does no point of the ball equal 0?
    pub fn excludes_zero(&self) -> bool {
        let (radius, exponent) = self.radius.parts();
        compare_dyadic(&absolute(&self.mantissa), self.exponent, &radius, exponent)
            == Ordering::Greater
    }

    /// Is 0 in the ball?
    pub fn contains_zero(&self) -> bool {
        !self.excludes_zero()
    }

    /// Does the interior of `self` contain every point of `other`?
    pub fn contains_in_interior(&self, other: &Self) -> bool {
        self.lower().exact_cmp(&other.lower()) == Ordering::Less
            && other.upper().exact_cmp(&self.upper()) == Ordering::Less
    }

    /// Does the ball contain every point of `other`?
    pub fn contains(&self, other: &Self) -> bool {
        self.lower().exact_cmp(&other.lower()) != Ordering::Greater
            && other.upper().exact_cmp(&self.upper()) != Ordering::Greater
    }

    /// Do the two balls have a point in common?
    pub fn overlaps(&self, other: &Self) -> bool {
        self.lower().exact_cmp(&other.upper()) != Ordering::Greater
            && other.lower().exact_cmp(&self.upper()) != Ordering::Greater
    }

    /// Does the ball contain the rational number?
    pub fn contains_rational(&self, number: &RBig) -> bool {
        let below = |ball: Self| ball.to_rational().is_some_and(|end| &end <= number);
        let above = |ball: Self| ball.to_rational().is_some_and(|end| &end >= number);
        below(self.lower()) && above(self.upper())
    }

    /// The midpoint as an exact rational number; `None` if its exponent is too large to be written out.
    pub fn to_rational(&self) -> Option<RBig> {
        if self.exponent.unsigned_abs() > 1 << 20 {
            return None;
        }
        let shift = self.exponent.unsigned_abs() as usize;
        Some(if self.exponent >= 0 {
            RBig::from(&self.mantissa << shift)
        } else {
            RBig::from_parts_signed(self.mantissa.clone(), IBig::from(1) << shift)
        })
    }

    /// The midpoint, rounded; infinite beyond the range of `f64`.
    pub fn to_f64(&self) -> f64 {
        let excess = self.mantissa.bit_len().saturating_sub(64);
        let top = (&self.mantissa >> excess).to_f64().value();
        let exponent = self.exponent.saturating_add(excess as i64);
        // Two steps, because 2^exponent alone may overflow where the product does not.
        let half = (exponent / 2).clamp(-1000, 1000) as i32;
        let rest = (exponent - i64::from(half)).clamp(-1000, 1000) as i32;
        top * 2_f64.powi(half) * 2_f64.powi(rest)
    }

    /// The ends of the ball in decimal with `digits` significant digits, rounded outwards.
    pub fn to_decimal_interval(&self, digits: usize) -> (String, String) {
        (
            decimal(&self.lower(), digits, Sign::Negative),
            decimal(&self.upper(), digits, Sign::Positive),
        )
    }

    /// −x.
    pub fn neg(&self) -> Self {
        Self {
            mantissa: -&self.mantissa,
            ..self.clone()
        }
    }

    /// x·2^shift, exactly.
    pub fn shift(&self, shift: i64) -> Self {
        Self {
            mantissa: self.mantissa.clone(),
            exponent: self.exponent.saturating_add(shift),
            radius: self.radius.shift(shift),
        }
    }

    /// The exponent of the leading bit of an upper bound of |x|, `None` for the point 0.
    pub fn log2_ceil(&self) -> Option<i64> {
        self.magnitude().log2_ceil()
    }

    /// The exact sum, radii added. Only for numbers of comparable size.
    fn exact_add(&self, other: &Self) -> Self {
        let exponent = self.exponent.min(other.exponent);
        let align = |ball: &Self| &ball.mantissa << (ball.exponent - exponent) as usize;
        Self {
            mantissa: align(self) + align(other),
            exponent,
            radius: self.radius.plus(other.radius),
        }
    }

    fn exact_cmp(&self, other: &Self) -> Ordering {
        compare_dyadic(
            &self.mantissa,
            self.exponent,
            &other.mantissa,
            other.exponent,
        )
    }

    /// Rounds the midpoint to `bits` bits, adding the error to the radius.
    fn rounded(mut self, bits: usize) -> Self {
        let excess = self.mantissa.bit_len().saturating_sub(bits);
        if excess > 0 {
            let exact = self
                .mantissa
                .trailing_zeros()
                .is_some_and(|zeros| zeros >= excess);
            self.mantissa >>= excess;
            self.exponent = self.exponent.saturating_add(excess as i64);
            if !exact {
                self.radius = self.radius.plus(Magnitude::power_of_two(self.exponent));
            }
        }
        self
    }

    /// Refuses exponents out of range.
    fn checked(self, what: &'static str) -> BallResult {
        let top = self.exponent.saturating_add(self.mantissa.bit_len() as i64);
        let wide = self.radius.log2_ceil().unwrap_or(0);
        if top > EXPONENT_LIMIT || wide > EXPONENT_LIMIT {
            return Err(BallError::TooLarge(what));
        }
        if top < -EXPONENT_LIMIT && !self.mantissa.is_zero() {
            // A tiny number is enclosed by a ball around 0.
            let radius = self
                .magnitude()
                .plus(Magnitude::power_of_two(-EXPONENT_LIMIT));
            return Ok(Self {
                mantissa: IBig::ZERO,
                exponent: 0,
                radius,
            });
        }
        Ok(self)
    }
}

impl fmt::Display for Ball {
    /// `[lower, upper]` with ten significant digits, rounded outwards.
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (lower, upper) = self.to_decimal_interval(10);
        write!(formatter, "[{lower}, {upper}]")
    }
}

/// |n|.
fn absolute(n: &IBig) -> IBig {
    IBig::from(n.clone().into_parts().1)
}

/// Compares a·2^i with b·2^j without large shifts.
fn compare_dyadic(a: &IBig, i: i64, b: &IBig, j: i64) -> Ordering {
    let (sign_a, sign_b) = (signum(a), signum(b));
    if sign_a != sign_b || sign_a == 0 {
        return sign_a.cmp(&sign_b);
    }
    let (size_a, size_b) = (
        absolute(a).bit_len() as i64 + i,
        absolute(b).bit_len() as i64 + j,
    );
    if size_a != size_b {
        return if sign_a > 0 {
            size_a.cmp(&size_b)
        } else {
            size_b.cmp(&size_a)
        };
    }
    // Sizes agree, so the exponents differ by at most the difference of the lengths.
    let exponent = i.min(j);
    (a << (i - exponent) as usize).cmp(&(b << (j - exponent) as usize))
}

fn signum(n: &IBig) -> i8 {
    match (n.is_zero(), n.sign()) {
        (true, _) => 0,
        (false, Sign::Positive) => 1,
        (false, Sign::Negative) => -1,
    }
}

/// An exact ball in decimal scientific notation, rounded towards the infinity of sign `direction`.
fn decimal(value: &Ball, digits: usize, direction: Sign) -> String {
    let Some(number) = value.to_rational() else {
        let size = value
            .exponent
            .saturating_add(value.mantissa.bit_len() as i64);
        return format!(
            "{}2^{size}",
            if signum(&value.mantissa) < 0 { "-" } else { "" }
        );
    };
    if number.is_zero() {
        return "0".to_owned();
    }
    let negative = number.sign() == Sign::Negative;
    let away = (direction == Sign::Negative) == negative;
    let (numerator, denominator) = number.into_parts();
    let (_, numerator) = numerator.into_parts();
    let ten = IBig::from(10);
    let (numerator, denominator) = (IBig::from(numerator), IBig::from(denominator));
    let estimate =
        (numerator.bit_len() as f64 - denominator.bit_len() as f64) * std::f64::consts::LOG10_2;
    let mut exponent = estimate.floor() as i64 + 1;
    loop {
        // digits of |x|·10^(digits − 1 − exponent)
        let scale = digits as i64 - 1 - exponent;
        let power = ten.pow(scale.unsigned_abs() as usize);
        let (top, bottom) = if scale >= 0 {
            (&numerator * &power, denominator.clone())
        } else {
            (numerator.clone(), &denominator * &power)
        };
        let mut quotient = &top / &bottom;
        if away && &quotient * &bottom != top {
            quotient += IBig::from(1);
        }
        let text = quotient.to_string();
        if text.len() < digits {
            exponent -= 1;
        } else if text.len() > digits {
            exponent += 1;
        } else {
            return scientific(&text, exponent, negative);
        }
    }
}

fn scientific(digits: &str, exponent: i64, negative: bool) -> String {
    let sign = if negative { "-" } else { "" };
    let (head, tail) = digits.split_at(1);
    let tail = tail.trim_end_matches('0');
    let point = if tail.is_empty() {
        String::new()
    } else {
        format!(".{tail}")
    };
    if exponent == 0 {
        format!("{sign}{head}{point}")
    } else {
        format!("{sign}{head}{point}e{exponent}")
    }
}

#[cfg(test)]
mod tests;
