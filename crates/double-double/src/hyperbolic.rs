//! Hyperbolic functions and their inverses.

use crate::DoubleDouble;

impl DoubleDouble {
    /// Hyperbolic sine.
    #[must_use]
    pub fn sinh(self) -> DoubleDouble {
        let e = self.abs().exp_m1();
        let size = (e + e / (e + DoubleDouble::ONE)).scaled(0.5);
        match self.high < 0.0 {
            true => -size,
            false => size,
        }
    }

    /// Hyperbolic cosine.
    #[must_use]
    pub fn cosh(self) -> DoubleDouble {
        let e = self.abs().exp();
        (e + DoubleDouble::ONE / e).scaled(0.5)
    }

    /// Hyperbolic tangent.
    #[must_use]
    pub fn tanh(self) -> DoubleDouble {
        // 1 − 2 e^(−2·37) is 1 to 2⁻¹⁰⁶.
        if self.high.abs() > 37.0 {
            return DoubleDouble::from(self.high.signum());
        }
        let e = self.scaled(2.0).exp_m1();
        e / (e + DoubleDouble::from(2.0))
    }

    /// The inverse of the hyperbolic sine: one step of Newton from the double.
    #[must_use]
    pub fn asinh(self) -> DoubleDouble {
        let size = self.abs();
        if size.high > 1e16 {
            // log (x + √(x² + 1)) = log 2x to 2⁻¹⁰⁶.
            let large = size.ln() + DoubleDouble::from(2.0).ln();
            return match self.high < 0.0 {
                true => -large,
                false => large,
            };
        }
        let near = match self.high.abs() < 1e-5 {
            // The library's is a difference there on some platforms.
            true => DoubleDouble::from(self.high * (1.0 - self.high * self.high / 6.0)),
            false => DoubleDouble::from(self.high.asinh()),
        };
        let step = |near: DoubleDouble| near + (self - near.sinh()) / near.cosh();
        // The second leaves nothing of what the first double was wrong by.
        step(step(near))
    }

    /// The inverse of the hyperbolic cosine on x ≥ 1; not a number below.
    #[must_use]
    pub fn acosh(self) -> DoubleDouble {
        match self.high > 1e16 {
            true => self.asinh(),
            false => ((self - DoubleDouble::ONE) * (self + DoubleDouble::ONE))
                .sqrt()
                .asinh(),
        }
    }

    /// The inverse of the hyperbolic tangent on |x| < 1; not a number elsewhere.
    #[must_use]
    pub fn atanh(self) -> DoubleDouble {
        let under = (DoubleDouble::ONE - self) * (DoubleDouble::ONE + self);
        match under.high > 0.0 {
            true => (self / under.sqrt()).asinh(),
            false => DoubleDouble::NAN,
        }
    }
}
