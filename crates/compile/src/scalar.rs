//! The numbers that the recurrences compute with: doubles, or sums of two.

use chetaev_double_double::DoubleDouble;
use chetaev_symbolic::{evaluate, Function};
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

/// A kind of number.
pub(crate) trait Scalar:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
{
    /// 0
    const ZERO: Self;

    /// The number of this double.
    fn of(value: f64) -> Self;

    /// The nearest double.
    fn rounded(self) -> f64;

    /// 1 with the sign of the number.
    fn signum(self) -> Self;

    /// √x
    fn sqrt(self) -> Self;

    /// A function of one argument.
    fn apply(function: Function, x: Self) -> Self;
}

impl Scalar for f64 {
    const ZERO: f64 = 0.0;

    #[inline(always)]
    fn of(value: f64) -> f64 {
        value
    }

    #[inline(always)]
    fn rounded(self) -> f64 {
        self
    }

    #[inline(always)]
    fn signum(self) -> f64 {
        f64::signum(self)
    }

    #[inline(always)]
    fn sqrt(self) -> f64 {
        f64::sqrt(self)
    }

    fn apply(function: Function, x: f64) -> f64 {
        evaluate::apply(function, x)
    }
}

impl Scalar for DoubleDouble {
    const ZERO: DoubleDouble = DoubleDouble::ZERO;

    #[inline(always)]
    fn of(value: f64) -> DoubleDouble {
        DoubleDouble::from(value)
    }

    #[inline(always)]
    fn rounded(self) -> f64 {
        self.high()
    }

    #[inline(always)]
    fn signum(self) -> DoubleDouble {
        DoubleDouble::from(DoubleDouble::signum(self))
    }

    #[inline(always)]
    fn sqrt(self) -> DoubleDouble {
        DoubleDouble::sqrt(self)
    }

    fn apply(function: Function, x: DoubleDouble) -> DoubleDouble {
        use Function::*;
        let one = DoubleDouble::ONE;
        let quotient = |(sin, cos): (DoubleDouble, DoubleDouble)| sin / cos;
        match function {
            Sin => x.sin(),
            Cos => x.cos(),
            Tan => quotient(x.sin_cos()),
            Cot => one / quotient(x.sin_cos()),
            Sec => one / x.cos(),
            Csc => one / x.sin(),
            Asin => x.asin(),
            Acos => x.acos(),
            Atan => x.atan(),
            Sinh => x.sinh(),
            Cosh => x.cosh(),
            Tanh => x.tanh(),
            Asinh => x.asinh(),
            Acosh => x.acosh(),
            Atanh => x.atanh(),
            Exp => x.exp(),
            Log => x.ln(),
            Abs => x.abs(),
            // As of doubles: 0 where the number is 0, or none.
            Sign => DoubleDouble::from(evaluate::apply(Sign, x.high())),
            Atan2 => DoubleDouble::from(f64::NAN),
        }
    }
}
