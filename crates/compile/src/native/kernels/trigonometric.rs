//! Sine and cosine of one angle.
//!
//! The angle is reduced by a multiple n of π/2 = P₁ + P₂ + P₃ (Cody and Waite 1980), with fused multiply-adds:
//! x − n P₁ is exact, the rounding error of subtracting n P₂ is computed exactly where the remainder is not much
//! smaller than n P₂, and P₃ goes into the tail. The polynomials are those of fdlibm (Sun Microsystems 1993,
//! `k_sin.c`, `k_cos.c`).

use super::{polynomial, ROUND};
use crate::native::assembler::{Bits, Float, Predicate};
use crate::native::call::Helper;
use crate::native::code::{Builder, Value, SIGN};
use std::f64::consts::FRAC_2_PI;

/// π/2 rounded to double, what is left of it rounded, and what is left then.
const P1: f64 = f64::from_bits(0x3FF9_21FB_5444_2D18);
const P2: f64 = f64::from_bits(0x3C91_A626_3314_5C07);
const P3: f64 = f64::from_bits(0xB91F_1976_B7ED_8FBC);

/// Largest multiple of π/2 that is subtracted; beyond, the rounding of x · 2/π would show in the polynomials.
const LARGEST: f64 = 67_108_864.0;

#[allow(clippy::excessive_precision)] // digits as in the source
const SINE: [f64; 6] = [
    1.666_666_666_666_663_243_48e-01,
    -8.333_333_333_322_489_461_24e-03,
    1.984_126_982_985_794_931_34e-04,
    -2.755_731_370_707_006_767_89e-06,
    2.505_076_025_340_686_341_95e-08,
    -1.589_690_995_211_550_102_21e-10,
];

#[allow(clippy::excessive_precision)] // digits as in the source
const COSINE: [f64; 6] = [
    4.166_666_666_666_660_190_37e-02,
    -1.388_888_888_887_410_957_49e-03,
    2.480_158_728_947_672_941_78e-05,
    -2.755_731_435_139_066_330_35e-07,
    2.087_572_321_298_174_827_90e-09,
    -1.135_964_755_778_819_482_65e-11,
];

/// Sine and cosine.
pub(crate) fn sin_cos(b: &mut Builder, x: Value) -> (Value, Value) {
    let reduced = reduce(b, x);
    let bad = is_bad(b, &reduced);
    let (sin, cos) = kernels(b, &reduced);
    let (sin, cos) = turn(b, reduced.shifted, sin, cos);
    let [sin, cos] = b.guard(Helper::SinCos, bad, x, [sin, cos]);
    (sin, cos)
}

/// x = n π/2 + y − tail.
struct Reduced {
    /// n in the low bits.
    shifted: Value,
    n: Value,
    y: Value,
    tail: Value,
}

fn reduce(b: &mut Builder, x: Value) -> Reduced {
    let (p1, p2, p3) = (b.constant(P1), b.constant(P2), b.constant(P3));
    let (two_by_pi, round) = (b.constant(FRAC_2_PI), b.constant(ROUND));
    let shifted = b.mul_add(x, two_by_pi, round);
    let n = b.sub(shifted, round);
    let first = b.neg_mul_add(n, p1, x);
    let y = b.neg_mul_add(n, p2, first);
    // The tail is subtracted in the end, so that −0 stays −0.
    let difference = b.sub(y, first);
    let lost = b.mul_add(n, p2, difference);
    let tail = b.mul_add(n, p3, lost);
    Reduced {
        shifted,
        n,
        y,
        tail,
    }
}

/// Where |y| < |n| P₂, so that cancellation may have cost digits, where |n| is too large, and for what is not a
/// finite number.
fn is_bad(b: &mut Builder, reduced: &Reduced) -> Value {
    let (p2, largest) = (b.constant(P2), b.constant(LARGEST * P2));
    let subtracted = b.mul(reduced.n, p2);
    let subtracted = b.abs(subtracted);
    let y = b.abs(reduced.y);
    // The minimum is its second operand if one is not a number.
    let allowed = b.float(Float::Min, largest, y);
    b.compare(Predicate::NotLessEqual, subtracted, allowed)
}

/// Sine and cosine of y − tail for |y| ≤ π/4.
fn kernels(b: &mut Builder, &Reduced { y, tail, .. }: &Reduced) -> (Value, Value) {
    let (half, one) = (b.constant(0.5), b.constant(1.0));
    let z = b.mul(y, y);
    let s = polynomial(b, z, &SINE);
    let c = polynomial(b, z, &COSINE);
    let w = b.mul(z, z);
    let half_y = b.mul(half, y);
    // y − (y z s + tail (1 − z/2))
    let half_z = b.mul(half_y, y);
    let turned = b.neg_mul_add(half_z, tail, tail);
    let cube = b.mul(z, y);
    let subtracted = b.mul_add(cube, s, turned);
    let sin = b.sub(y, subtracted);
    // 1 − y²/2 with its rounding error, z² c and the tail
    let leading = b.neg_mul_add(half_y, y, one);
    let difference = b.sub(one, leading);
    let lost = b.neg_mul_add(half_y, y, difference);
    let rest = b.mul_add(y, tail, lost);
    let rest = b.mul_add(w, c, rest);
    let cos = b.add(leading, rest);
    (sin, cos)
}

/// From the remainder to the angle: an odd n exchanges sine and cosine; bit 1 of n is the sign of the sine, bit 1
/// of n + 1 that of the cosine.
fn turn(b: &mut Builder, shifted: Value, sin: Value, cos: Value) -> (Value, Value) {
    let sign = b.constant_bits(SIGN);
    let odd = b.shift_left(shifted, 63);
    let upper = b.shift_left(shifted, 62);
    let either = b.bits(Bits::Xor, upper, odd);
    let sin_sign = b.bits(Bits::And, upper, sign);
    let cos_sign = b.bits(Bits::And, either, sign);
    let turned_sin = b.blend(sin, cos, odd);
    let turned_cos = b.blend(cos, sin, odd);
    (
        b.bits(Bits::Xor, turned_sin, sin_sign),
        b.bits(Bits::Xor, turned_cos, cos_sign),
    )
}
