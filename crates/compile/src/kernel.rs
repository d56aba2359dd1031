//! Sine and cosine of one angle, without branches, so that a block of states is computed by vector instructions.
//!
//! The angle is reduced by π/2 in three parts (Cody and Waite 1980) with a compensated remainder, the polynomials
//! are those of fdlibm (Sun Microsystems 1993, `k_sin.c`, `k_cos.c`). The error is below 1 ulp where the result
//! says that it may be used: for |x| ≤ 2²⁰ and not within 2⁻³⁰ of a multiple of π/2 other than 0. Elsewhere, and
//! for infinities, the library's functions are used.

use std::f64::consts::FRAC_2_PI;

/// Adding this rounds to an integer, which then stands in the low bits of the sum.
const ROUND: f64 = 6_755_399_441_055_744.0;
/// The first 33 bits of π/2; the product with an integer below 2²⁰ is exact.
const PIO2_1: f64 = f64::from_bits(0x3FF9_21FB_5440_0000);
/// The next 33 bits.
const PIO2_2: f64 = f64::from_bits(0x3DD0_B461_1A60_0000);
/// The rest.
const PIO2_2T: f64 = f64::from_bits(0x3BA3_198A_2E03_7073);
const LARGEST: f64 = 1_048_576.0;
const CLOSEST: f64 = 9.313_225_746_154_785e-10;

/// Sine, cosine, and whether they may be used.
#[inline(always)]
pub(crate) fn sin_cos_quick(x: f64) -> (f64, f64, bool) {
    let shifted = x * FRAC_2_PI + ROUND;
    let n = shifted - ROUND;
    let quadrant = shifted.to_bits();
    let first = x - n * PIO2_1;
    let w = n * PIO2_2;
    let r = first - w;
    let w = n * PIO2_2T - ((first - r) - w);
    let y = r - w;
    let tail = (r - y) - w;
    let (s, c) = (sin_kernel(y, tail), cos_kernel(y, tail));
    // An odd quadrant swaps sine and cosine; bit 1 is the sign of the sine, bit 1 of the next that of the cosine.
    let swap = (quadrant & 1).wrapping_neg();
    let (s, c) = (s.to_bits(), c.to_bits());
    let sin = (s & !swap) | (c & swap);
    let cos = (c & !swap) | (s & swap);
    let sin = sin ^ ((quadrant & 2) << 62);
    let cos = cos ^ ((quadrant.wrapping_add(1) & 2) << 62);
    let is_near_zero = (n == 0.0) | (y.abs() > CLOSEST);
    let is_good = (x.abs() <= LARGEST) & is_near_zero;
    (f64::from_bits(sin), f64::from_bits(cos), is_good)
}

/// sin(y + tail) for |y| ≤ π/4.
#[inline(always)]
#[allow(clippy::excessive_precision)] // digits as in the source
fn sin_kernel(y: f64, tail: f64) -> f64 {
    const S1: f64 = -1.666_666_666_666_663_243_48e-01;
    const S2: f64 = 8.333_333_333_322_489_461_24e-03;
    const S3: f64 = -1.984_126_982_985_794_931_34e-04;
    const S4: f64 = 2.755_731_370_707_006_767_89e-06;
    const S5: f64 = -2.505_076_025_340_686_341_95e-08;
    const S6: f64 = 1.589_690_995_211_550_102_21e-10;
    let z = y * y;
    let w = z * z;
    let r = S2 + z * (S3 + z * S4) + z * w * (S5 + z * S6);
    let v = z * y;
    y - ((z * (0.5 * tail - v * r) - tail) - v * S1)
}

/// cos(y + tail) for |y| ≤ π/4.
#[inline(always)]
#[allow(clippy::excessive_precision)] // digits as in the source
fn cos_kernel(y: f64, tail: f64) -> f64 {
    const C1: f64 = 4.166_666_666_666_660_190_37e-02;
    const C2: f64 = -1.388_888_888_887_410_957_49e-03;
    const C3: f64 = 2.480_158_728_947_672_941_78e-05;
    const C4: f64 = -2.755_731_435_139_066_330_35e-07;
    const C5: f64 = 2.087_572_321_298_174_827_90e-09;
    const C6: f64 = -1.135_964_755_778_819_482_65e-11;
    let z = y * y;
    let z2 = z * z;
    let r = z * (C1 + z * (C2 + z * C3)) + z2 * z2 * (C4 + z * (C5 + z * C6));
    let half = 0.5 * z;
    let w = 1.0 - half;
    w + (((1.0 - w) - half) + (z * r - y * tail))
}

/// Sine and cosine for every argument, with the same bits on every platform.
pub(crate) fn sin_cos_library(x: f64) -> (f64, f64) {
    libm::sincos(x)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Units in the last place between two numbers of the same sign.
    fn ulps(a: f64, b: f64) -> u64 {
        assert_eq!(a.is_sign_negative(), b.is_sign_negative(), "{a:e} {b:e}");
        a.to_bits().abs_diff(b.to_bits())
    }

    #[test]
    fn agrees_with_the_library_to_an_ulp() {
        let mut x = 1e-9;
        let mut used = 0;
        while x < 2e6 {
            for x in [x, -x] {
                let (sin, cos, is_good) = sin_cos_quick(x);
                if is_good {
                    used += 1;
                    assert!(ulps(sin, x.sin()) <= 1, "sin {x:e}");
                    assert!(ulps(cos, x.cos()) <= 1, "cos {x:e}");
                }
            }
            x *= 1.000_037;
        }
        assert!(used > 1_000_000);
    }

    #[test]
    fn hard_arguments_are_left_to_the_library() {
        use std::f64::consts::PI;
        for x in [PI, PI / 2.0, 1e5 * PI, 1e300, f64::NAN, f64::INFINITY] {
            assert!(!sin_cos_quick(x).2, "{x:e}");
        }
        let (sin, cos, is_good) = sin_cos_quick(-0.0);
        assert!(is_good && sin == 0.0 && sin.is_sign_negative() && cos == 1.0);
    }
}
