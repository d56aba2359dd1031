//! Sums and products of doubles without error: the result rounded, and what the rounding left out.

/// a + b, for numbers of any size (Knuth 1969).
#[inline(always)]
pub(crate) fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let b_virtual = sum - a;
    let a_virtual = sum - b_virtual;
    (sum, (a - a_virtual) + (b - b_virtual))
}

/// a + b where |a| ≥ |b| or a = 0 (Dekker 1971).
#[inline(always)]
pub(crate) fn quick_two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    (sum, b - (sum - a))
}

/// a · b. Without a fused multiply-add in the target the factors are halved (Veltkamp 1968, Dekker 1971), which is inlined
/// where the function of the library would be called; both give the same bits where nothing overflows.
#[inline(always)]
pub(crate) fn two_product(a: f64, b: f64) -> (f64, f64) {
    let product = a * b;
    if cfg!(target_feature = "fma") {
        return (product, a.mul_add(b, -product));
    }
    let ((a1, a2), (b1, b2)) = (halves(a), halves(b));
    (product, ((a1 * b1 - product) + a1 * b2 + a2 * b1) + a2 * b2)
}

/// a as a sum of two numbers of 26 bits.
#[inline(always)]
fn halves(a: f64) -> (f64, f64) {
    let shifted = 134_217_729.0 * a;
    let upper = shifted - (shifted - a);
    (upper, a - upper)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_is_lost() {
        let (a, b) = (1.0 + 2f64.powi(-52), 1.0 - 2f64.powi(-53));
        // (1 + 2⁻⁵²)(1 − 2⁻⁵³) = 1 + 2⁻⁵³ − 2⁻¹⁰⁵, by hand: to the nearest double 1, and the rest.
        let (product, error) = two_product(a, b);
        assert_eq!(product, 1.0);
        assert_eq!(error, 2f64.powi(-53) - 2f64.powi(-105));
        assert_eq!(two_product(a, b).1, a.mul_add(b, -product));
        assert_eq!(two_sum(1.0, 2f64.powi(-80)), (1.0, 2f64.powi(-80)));
        assert_eq!(two_sum(2f64.powi(-80), 1.0), (1.0, 2f64.powi(-80)));
        assert_eq!(quick_two_sum(1.0, 2f64.powi(-80)), (1.0, 2f64.powi(-80)));
    }
}
