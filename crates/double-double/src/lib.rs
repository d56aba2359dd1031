//! Numbers of about 31 digits: unevaluated sums of two doubles.
//!
//! A [`DoubleDouble`] is `high + low` with |low| at most half a unit in the last place of `high`, so that rounding is by
//! at most 2⁻¹⁰⁴ for each operation (sums, products, quotients, roots) and the exponents are those of doubles. The
//! elementary functions are accurate to some 2⁻¹⁰⁰ of their value; sine and cosine to 2⁻¹⁰⁴ absolutely, for angles up to
//! 2⁵⁰.
//!
//! Operations are those of Dekker 1971 (Numer. Math. 18, exact products), Knuth 1969 (exact sums), Hida, Li, Bailey 2001
//! (double-double functions) and Joldeș, Muller, Popescu 2017 (ACM TOMS 44, sums and products with proved bounds).
//! What overflows, or has no value, is not a number: infinities are not kept.
//!
//! ```
//! use chetaev_double_double::DoubleDouble;
//!
//! let tenth = DoubleDouble::from(1.0) / DoubleDouble::from(10.0);
//! assert_eq!(tenth.high(), 0.1);
//! // What a double leaves out of 1/10.
//! assert_eq!(tenth.low(), -5.551115123125783e-18);
//! ```

mod arithmetic;
mod exact;
mod exponential;
mod hyperbolic;
mod trigonometric;

/// An unevaluated sum of two doubles.
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
pub struct DoubleDouble {
    high: f64,
    low: f64,
}

impl DoubleDouble {
    /// 0
    pub const ZERO: DoubleDouble = DoubleDouble::of(0.0, 0.0);
    /// 1
    pub const ONE: DoubleDouble = DoubleDouble::of(1.0, 0.0);
    /// π
    pub const PI: DoubleDouble = DoubleDouble::of(std::f64::consts::PI, 1.2246467991473532e-16);
    /// The unit of rounding, 2⁻¹⁰⁴: operations are exact up to this part of their value.
    pub const EPSILON: f64 = 4.930380657631324e-32;

    /// Where the parts do not overlap.
    const fn of(high: f64, low: f64) -> DoubleDouble {
        DoubleDouble { high, low }
    }

    /// The sum of two doubles.
    #[inline]
    pub fn new(a: f64, b: f64) -> DoubleDouble {
        let (high, low) = exact::two_sum(a, b);
        DoubleDouble { high, low }
    }

    /// The nearest double.
    #[inline]
    pub const fn high(self) -> f64 {
        self.high
    }

    /// What the nearest double leaves out.
    #[inline]
    pub const fn low(self) -> f64 {
        self.low
    }

    /// Whether it is a number.
    #[inline]
    pub fn is_finite(self) -> bool {
        self.high.is_finite() && self.low.is_finite()
    }

    /// Its size.
    #[inline]
    #[must_use]
    pub fn abs(self) -> DoubleDouble {
        match self.high < 0.0 {
            true => -self,
            false => self,
        }
    }

    /// 1 with its sign, as [`f64::signum`] has it.
    #[inline]
    pub fn signum(self) -> f64 {
        self.high.signum()
    }

    /// The product with a power of two, which is exact but for underflow.
    #[inline]
    #[must_use]
    pub fn scaled(self, power_of_two: f64) -> DoubleDouble {
        DoubleDouble::of(self.high * power_of_two, self.low * power_of_two)
    }

    /// Not a number.
    const NAN: DoubleDouble = DoubleDouble::of(f64::NAN, f64::NAN);
}

impl From<f64> for DoubleDouble {
    #[inline]
    fn from(value: f64) -> DoubleDouble {
        DoubleDouble::of(value, 0.0)
    }
}
