//! Exponential, logarithm and power.

use crate::DoubleDouble;
use std::sync::LazyLock;

/// log 2 in three parts.
const LN2: [f64; 3] = [
    std::f64::consts::LN_2,
    2.3190468138462996e-17,
    5.707708438416212e-34,
];
/// The argument of the series is brought below 0.35 by the powers of 2, and below this part of it by squarings.
const SQUARINGS: i32 = 4;
/// Terms of the series of exp x − 1 for |x| ≤ 0.35/2⁴: the next one is below 2⁻¹²⁰ of the first.
const TERMS: usize = 16;

/// 1/n! for n up to 33.
pub(crate) static INVERSE_FACTORIALS: LazyLock<[DoubleDouble; 34]> = LazyLock::new(|| {
    let mut table = [DoubleDouble::ONE; 34];
    for n in 1..table.len() {
        table[n] = table[n - 1] / DoubleDouble::from(n as f64);
    }
    table
});

/// exp x − 1 for |x| ≤ 0.35, accurate relative to its value.
fn exp_minus_one_near_zero(x: DoubleDouble) -> DoubleDouble {
    let table = &*INVERSE_FACTORIALS;
    let x = x.scaled(2f64.powi(-SQUARINGS));
    let mut sum = DoubleDouble::ZERO;
    for n in (1..=TERMS).rev() {
        sum = (sum + table[n]) * x;
    }
    // (1 + s)² − 1 = 2 s + s²
    for _ in 0..SQUARINGS {
        sum = sum.scaled(2.0) + sum * sum;
    }
    sum
}

/// 2^k, for k beyond the exponents of doubles too.
fn scaled_by(x: DoubleDouble, k: i32) -> DoubleDouble {
    let half = k / 2;
    x.scaled(2f64.powi(half)).scaled(2f64.powi(k - half))
}

impl DoubleDouble {
    /// e^x
    #[must_use]
    pub fn exp(self) -> DoubleDouble {
        if self.high > 709.7 {
            return DoubleDouble::NAN;
        }
        if self.high < -745.2 {
            return DoubleDouble::ZERO;
        }
        let k = (self.high / LN2[0]).round();
        let parts = LN2.map(|part| DoubleDouble::from(part) * k);
        let rest = ((self - parts[0]) - parts[1]) - parts[2];
        let near_one = exp_minus_one_near_zero(rest) + DoubleDouble::ONE;
        scaled_by(near_one, k as i32)
    }

    /// e^x − 1, accurate relative to its value.
    #[must_use]
    pub fn exp_m1(self) -> DoubleDouble {
        match self.high.abs() <= 0.35 {
            true => exp_minus_one_near_zero(self),
            false => self.exp() - DoubleDouble::ONE,
        }
    }

    /// log x; not a number where x ≤ 0.
    #[must_use]
    pub fn ln(self) -> DoubleDouble {
        if self.high.is_nan() || self.high <= 0.0 {
            return DoubleDouble::NAN;
        }
        if self.high < f64::MIN_POSITIVE * 2f64.powi(110) {
            let shift = DoubleDouble::from(LN2[0]) * 400.0 + DoubleDouble::from(LN2[1]) * 400.0;
            return self.scaled(2f64.powi(400)).ln() - shift;
        }
        // x = 2^k m with m next to 1.
        let k = self.high.log2().round();
        let m = scaled_by(self, -(k as i32));
        // sinh (log m / 2) = (m − 1)/(2 √m), where nothing cancels that was not exact.
        let half = ((m - DoubleDouble::ONE) / m.sqrt().scaled(2.0)).asinh();
        let parts = LN2.map(|part| DoubleDouble::from(part) * k);
        half.scaled(2.0) + parts[2] + parts[1] + parts[0]
    }

    /// x^y: exp (y log x), for negative x where y is a whole number.
    #[must_use]
    pub fn powf(self, y: DoubleDouble) -> DoubleDouble {
        if y.high == 0.0 {
            return DoubleDouble::ONE;
        }
        if self.high == 0.0 {
            return match y.high > 0.0 {
                true => DoubleDouble::ZERO,
                false => DoubleDouble::NAN,
            };
        }
        let size = (y * self.abs().ln()).exp();
        if self.high > 0.0 {
            return size;
        }
        let is_whole = y.low == 0.0 && y.high.fract() == 0.0;
        match (is_whole, y.high % 2.0 == 0.0) {
            (true, true) => size,
            (true, false) => -size,
            _ => DoubleDouble::NAN,
        }
    }
}
