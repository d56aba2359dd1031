//! Sine, cosine, and the angles of points.

use crate::exponential::INVERSE_FACTORIALS;
use crate::DoubleDouble;

/// π/2 in three parts.
const HALF_PI: [f64; 3] = [
    std::f64::consts::FRAC_PI_2,
    6.123233995736766e-17,
    -1.4973849048591698e-33,
];
/// Angles beyond are not brought back to the first turn: their last digit is more than 10⁻¹⁷ anyway.
const LARGEST: f64 = 1_125_899_906_842_624.0;
/// The last power in the series for |x| ≤ π/4: the next term is below 2⁻¹¹⁰ of the value.
const LAST: usize = 29;

/// The angle less k quarter turns, and k modulo 4.
fn reduced(x: DoubleDouble) -> (DoubleDouble, usize) {
    let k = (x.high / HALF_PI[0]).round();
    let parts = HALF_PI.map(|part| DoubleDouble::from(part) * k);
    let rest = ((x - parts[0]) - parts[1]) - parts[2];
    (rest, k.rem_euclid(4.0) as usize)
}

/// Σ over n = first, first + 2, … of ± x^(n − first) / n!.
fn alternating(square: DoubleDouble, first: usize) -> DoubleDouble {
    let table = &*INVERSE_FACTORIALS;
    let mut sum = DoubleDouble::ZERO;
    let mut n = first + (LAST - first) / 2 * 2;
    loop {
        sum = table[n] - sum * square;
        if n == first {
            return sum;
        }
        n -= 2;
    }
}

impl DoubleDouble {
    /// Sine and cosine; not numbers for angles beyond 2⁵⁰.
    pub fn sin_cos(self) -> (DoubleDouble, DoubleDouble) {
        if self.high.is_nan() || self.high.abs() > LARGEST {
            return (DoubleDouble::NAN, DoubleDouble::NAN);
        }
        let (rest, quarter) = reduced(self);
        let square = rest * rest;
        let sin = rest * alternating(square, 1);
        let cos = DoubleDouble::ONE - square * alternating(square, 2);
        match quarter {
            0 => (sin, cos),
            1 => (cos, -sin),
            2 => (-sin, -cos),
            _ => (-cos, sin),
        }
    }

    /// Sine.
    #[must_use]
    pub fn sin(self) -> DoubleDouble {
        self.sin_cos().0
    }

    /// Cosine.
    #[must_use]
    pub fn cos(self) -> DoubleDouble {
        self.sin_cos().1
    }

    /// The angle of the point (x, y), where `self` is y; at the origin that of [`f64::atan2`].
    #[must_use]
    pub fn atan2(self, x: DoubleDouble) -> DoubleDouble {
        let largest = self.high.abs().max(x.high.abs());
        if largest == 0.0 {
            return DoubleDouble::from(self.high.atan2(x.high));
        }
        // Squares must neither overflow nor underflow.
        let scale = 2f64.powi(-(largest.log2().round().clamp(-1000.0, 1000.0) as i32));
        let (x, y) = (x.scaled(scale), self.scaled(scale));
        let (angle, radius) = (y.high.atan2(x.high), (x * x + y * y).sqrt());
        let (sin, cos) = DoubleDouble::from(angle).sin_cos();
        // The sine of what is missing, which is so small that it is its sine.
        let missing = (y * cos - x * sin) / radius;
        DoubleDouble::from(angle) + missing
    }

    /// The angle with this tangent.
    #[must_use]
    pub fn atan(self) -> DoubleDouble {
        self.atan2(DoubleDouble::ONE)
    }

    /// The angle with this sine; not a number beyond ±1.
    #[must_use]
    pub fn asin(self) -> DoubleDouble {
        self.atan2(self.complement())
    }

    /// The angle with this cosine; not a number beyond ±1.
    #[must_use]
    pub fn acos(self) -> DoubleDouble {
        self.complement().atan2(self)
    }

    /// √(1 − x²)
    fn complement(self) -> DoubleDouble {
        ((DoubleDouble::ONE - self) * (DoubleDouble::ONE + self)).sqrt()
    }
}
