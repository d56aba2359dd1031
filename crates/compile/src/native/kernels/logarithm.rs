//! The natural logarithm, by ln x = k ln 2 + ln(1 + f) with √½ ≤ 1 + f < √2, as in fdlibm (Sun Microsystems 1993,
//! `e_log.c`). Zero, negative, infinite and subnormal arguments are left to the library.

use super::polynomial;
use crate::native::assembler::{Bits, Float, Predicate};
use crate::native::call::Helper;
use crate::native::code::{Builder, Value};

/// The upper 33 bits of ln 2, and the rest.
const LN2_HIGH: f64 = f64::from_bits(0x3FE6_2E42_FEE0_0000);
const LN2_LOW: f64 = f64::from_bits(0x3DEA_39EF_3579_3C76);

#[allow(clippy::excessive_precision)] // digits as in the source
const COEFFICIENTS: [f64; 7] = [
    6.666_666_666_666_735_130e-01,
    3.999_999_999_940_941_908e-01,
    2.857_142_874_366_239_149e-01,
    2.222_219_843_214_978_396e-01,
    1.818_357_216_161_805_012e-01,
    1.531_383_769_920_937_332e-01,
    1.479_819_860_511_658_591e-01,
];

/// ln x
pub(crate) fn log(b: &mut Builder, x: Value) -> Value {
    let (k, f) = split(b, x);
    let (one_half, two) = (b.constant(0.5), b.constant(2.0));
    let (high, low) = (b.constant(LN2_HIGH), b.constant(LN2_LOW));
    let below = b.add(two, f);
    let s = b.float(Float::Div, f, below);
    let z = b.mul(s, s);
    let r = polynomial(b, z, &COEFFICIENTS);
    let half_f = b.mul(one_half, f);
    let half_square = b.mul(half_f, f);
    let sum = b.mul_add(z, r, half_square);
    let small = b.mul(k, low);
    let inner = b.mul_add(s, sum, small);
    let inner = b.sub(half_square, inner);
    let subtracted = b.sub(inner, f);
    let quick = b.mul_sub(k, high, subtracted);
    let (least, largest) = (b.constant(f64::MIN_POSITIVE), b.constant(f64::MAX));
    let too_small = b.compare(Predicate::NotLessEqual, least, x);
    let too_large = b.compare(Predicate::NotLessEqual, x, largest);
    let bad = b.bits(Bits::Or, too_small, too_large);
    let [log] = b.guard(Helper::Log, bad, x, [quick]);
    log
}

/// k and f of x = 2ᵏ (1 + f).
fn split(b: &mut Builder, x: Value) -> (Value, Value) {
    // Subtracting the bits of √½ and adding those of 1 makes the exponent of the sum k, biased.
    let root_half = b.constant_bits(0x3FE6_A09E_667F_3BCD);
    let one_bits = b.constant(1.0);
    let exponent_bits = b.constant_bits(0xFFF0_0000_0000_0000);
    let offset = b.bits(Bits::SubInteger, x, root_half);
    let biased = b.bits(Bits::AddInteger, offset, one_bits);
    let biased = b.shift_right(biased, 52);
    // As the low bits of 2⁵², an integer is a double.
    let two_52 = b.constant(4_503_599_627_370_496.0);
    let shift = b.constant(4_503_599_627_370_496.0 + 1023.0);
    let k = b.bits(Bits::Or, biased, two_52);
    let k = b.sub(k, shift);
    let exponent = b.bits(Bits::And, offset, exponent_bits);
    let mantissa = b.bits(Bits::SubInteger, x, exponent);
    let f = b.sub(mantissa, one_bits);
    (k, f)
}
