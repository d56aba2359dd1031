//! Sums, products, quotients and roots (Joldeș, Muller, Popescu 2017, algorithms 6 and 11; Hida, Li, Bailey 2001).

use crate::exact::{quick_two_sum, two_product, two_sum};
use crate::DoubleDouble;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

impl Neg for DoubleDouble {
    type Output = DoubleDouble;

    #[inline(always)]
    fn neg(self) -> DoubleDouble {
        DoubleDouble::of(-self.high, -self.low)
    }
}

impl Add for DoubleDouble {
    type Output = DoubleDouble;

    #[inline(always)]
    fn add(self, other: DoubleDouble) -> DoubleDouble {
        let (high, error) = two_sum(self.high, other.high);
        let (low, rest) = two_sum(self.low, other.low);
        let (high, middle) = quick_two_sum(high, error + low);
        let (high, low) = quick_two_sum(high, rest + middle);
        DoubleDouble::of(high, low)
    }
}

impl Sub for DoubleDouble {
    type Output = DoubleDouble;

    #[inline(always)]
    fn sub(self, other: DoubleDouble) -> DoubleDouble {
        self + -other
    }
}

impl Mul for DoubleDouble {
    type Output = DoubleDouble;

    #[inline(always)]
    fn mul(self, other: DoubleDouble) -> DoubleDouble {
        let (high, error) = two_product(self.high, other.high);
        let across = self.high * other.low + (self.low * other.high + self.low * other.low);
        let (high, low) = quick_two_sum(high, error + across);
        DoubleDouble::of(high, low)
    }
}

impl Mul<f64> for DoubleDouble {
    type Output = DoubleDouble;

    #[inline(always)]
    fn mul(self, other: f64) -> DoubleDouble {
        let (high, error) = two_product(self.high, other);
        let (high, low) = quick_two_sum(high, error + self.low * other);
        DoubleDouble::of(high, low)
    }
}

impl Div for DoubleDouble {
    type Output = DoubleDouble;

    /// Long division: three digits of 53 bits.
    #[inline]
    fn div(self, other: DoubleDouble) -> DoubleDouble {
        let first = self.high / other.high;
        let rest = self - other * first;
        let second = rest.high / other.high;
        let rest = rest - other * second;
        let third = rest.high / other.high;
        let (high, low) = quick_two_sum(first, second);
        DoubleDouble::of(high, low) + DoubleDouble::from(third)
    }
}

impl AddAssign for DoubleDouble {
    #[inline(always)]
    fn add_assign(&mut self, other: DoubleDouble) {
        *self = *self + other;
    }
}

impl SubAssign for DoubleDouble {
    #[inline(always)]
    fn sub_assign(&mut self, other: DoubleDouble) {
        *self = *self - other;
    }
}

impl DoubleDouble {
    /// √x; not a number below 0 (Karp, Markstein 1997).
    #[must_use]
    pub fn sqrt(self) -> DoubleDouble {
        if self.high == 0.0 {
            return DoubleDouble::ZERO;
        }
        if self.high < 0.0 || !self.is_finite() {
            return DoubleDouble::NAN;
        }
        // Away from where squares of the parts underflow.
        if self.high < 1e-200 {
            return self.scaled(2f64.powi(400)).sqrt().scaled(2f64.powi(-200));
        }
        let root = self.high.sqrt();
        let (square, error) = two_product(root, root);
        let rest = self - DoubleDouble::of(square, error);
        let (high, low) = quick_two_sum(root, rest.high / (2.0 * root));
        let near = DoubleDouble::of(high, low);
        // A step of Newton more: the first leaves half of the last digits.
        let rest = self - near * near;
        near + DoubleDouble::from(rest.high / (2.0 * root))
    }

    /// x^n by squaring, for the reciprocal where n < 0.
    #[must_use]
    pub fn powi(self, n: i32) -> DoubleDouble {
        let (mut result, mut square, mut rest) = (DoubleDouble::ONE, self, n.unsigned_abs());
        while rest > 0 {
            if rest % 2 == 1 {
                result = result * square;
            }
            square = square * square;
            rest /= 2;
        }
        match n < 0 {
            true => DoubleDouble::ONE / result,
            false => result,
        }
    }
}
