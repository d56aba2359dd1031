//! The exponential function for every argument, by e^x = 2ⁿ e^y with |y| ≤ (ln 2)/2.
//!
//! No argument needs the library: large ones are limited to where the result is infinite or zero anyway, and 2ⁿ is
//! applied in two halves, so that results below the normal numbers are rounded as they should be.

use super::{polynomial, ROUND};
use crate::native::assembler::{Bits, Float};
use crate::native::code::{Builder, Value};
use std::f64::consts::{LN_2, LOG2_E};

/// What ln 2 is more than its double.
const LN_2_REST: f64 = f64::from_bits(0x3C7A_BC9E_3B39_803F);

/// e^x is infinite above and zero below these.
const LARGEST: f64 = 710.0;
const LEAST: f64 = -746.0;

/// 1/2!, 1/3!, …, 1/13!; the next term is below 2⁻⁵⁷ in the interval.
const COEFFICIENTS: [f64; 12] = [
    1.0 / 2.0,
    1.0 / 6.0,
    1.0 / 24.0,
    1.0 / 120.0,
    1.0 / 720.0,
    1.0 / 5_040.0,
    1.0 / 40_320.0,
    1.0 / 362_880.0,
    1.0 / 3_628_800.0,
    1.0 / 39_916_800.0,
    1.0 / 479_001_600.0,
    1.0 / 6_227_020_800.0,
];

/// e^x
pub(crate) fn exp(b: &mut Builder, x: Value) -> Value {
    let (largest, least) = (b.constant(LARGEST), b.constant(LEAST));
    // Minimum and maximum are their second operand if one is not a number.
    let x = b.float(Float::Min, largest, x);
    let x = b.float(Float::Max, least, x);
    let (log2e, round) = (b.constant(LOG2_E), b.constant(ROUND));
    let shifted = b.mul_add(x, log2e, round);
    let n = b.sub(shifted, round);
    let mantissa = mantissa(b, x, n);
    scale(b, mantissa, n)
}

/// e^(x − n ln 2)
fn mantissa(b: &mut Builder, x: Value, n: Value) -> Value {
    let (ln2, rest, one) = (b.constant(LN_2), b.constant(LN_2_REST), b.constant(1.0));
    // Exact, as for the sine; so is what rounding loses next.
    let first = b.neg_mul_add(n, ln2, x);
    let y = b.neg_mul_add(n, rest, first);
    let difference = b.sub(y, first);
    let lost = b.mul_add(n, rest, difference);
    let q = polynomial(b, y, &COEFFICIENTS);
    let square = b.mul(y, y);
    let leading = b.add(one, y);
    let difference = b.sub(one, leading);
    let tail = b.add(difference, y);
    let tail = b.sub(tail, lost);
    let tail = b.mul_add(square, q, tail);
    b.add(leading, tail)
}

/// `x · 2ⁿ`, rounded once.
fn scale(b: &mut Builder, x: Value, n: Value) -> Value {
    let (half, round) = (b.constant(0.5), b.constant(ROUND));
    let bias = b.constant_bits(1023);
    let first = b.mul_add(n, half, round);
    let first_half = b.sub(first, round);
    let second_half = b.sub(n, first_half);
    let second = b.add(second_half, round);
    let mut x = x;
    for shifted in [first, second] {
        // The integer in the low bits becomes the exponent; what is above it is shifted out.
        let exponent = b.bits(Bits::AddInteger, shifted, bias);
        let power = b.shift_left(exponent, 52);
        x = b.mul(x, power);
    }
    x
}
