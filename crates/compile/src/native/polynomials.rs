//! Polynomials of four states side by side: their values and slopes, and whether their coefficients are finite.
#![allow(unsafe_code)] // Instructions that not every processor has are used where they are known to be there.

use super::machine::Four;
use std::arch::x86_64::{
    __m256d, _mm256_add_pd, _mm256_loadu_pd, _mm256_mul_pd, _mm256_setzero_pd, _mm256_storeu_pd,
};

/// Polynomials at a time, so that one sum does not wait for the other.
const BLOCK: usize = 4;

/// Σ_{j≥1} c_j h^j and its derivative, for polynomials given by `rows` of coefficients from order 1 on, by Horner's scheme for both
/// at once, a product rounded before it is added; `found` is called with the number of each, the sum and the slope. Does nothing where the processor
/// lacks the instructions.
pub(crate) fn horner<'s>(
    (count, row): (usize, impl Fn(usize) -> &'s [Four]),
    h: Four,
    mut found: impl FnMut(usize, Four, Four),
) {
    if !super::is_available() {
        return;
    }
    for first in (0..count).step_by(BLOCK) {
        // The last rows are summed more than once where they do not fill a block.
        let rows: [&[Four]; BLOCK] = std::array::from_fn(|i| row((first + i).min(count - 1)));
        // SAFETY: the processor has the instructions.
        let (sums, slopes) = unsafe { block(rows, h) };
        for i in 0..BLOCK.min(count - first) {
            found(first + i, sums[i], slopes[i]);
        }
    }
}

#[target_feature(enable = "avx2")]
#[allow(clippy::needless_range_loop)]
fn block(rows: [&[Four]; BLOCK], h: Four) -> ([Four; BLOCK], [Four; BLOCK]) {
    let order = rows.iter().fold(usize::MAX, |m, row| m.min(row.len()));
    let rows = rows.map(|row| &row[..order]);
    let h = packed(&h);
    let (mut sum, mut slope) = ([_mm256_setzero_pd(); BLOCK], [_mm256_setzero_pd(); BLOCK]);
    for j in (0..order).rev() {
        for i in 0..BLOCK {
            slope[i] = sum_product(sum[i], h, slope[i]);
            sum[i] = sum_product(packed(&rows[i][j]), h, sum[i]);
        }
    }
    let (mut sums, mut slopes) = ([Four::default(); BLOCK], [Four::default(); BLOCK]);
    for i in 0..BLOCK {
        slopes[i] = unpacked(sum_product(sum[i], h, slope[i]));
        sums[i] = unpacked(_mm256_mul_pd(sum[i], h));
    }
    (sums, slopes)
}

/// a + b c, the product rounded.
#[target_feature(enable = "avx2")]
#[inline]
fn sum_product(a: __m256d, b: __m256d, c: __m256d) -> __m256d {
    _mm256_add_pd(a, _mm256_mul_pd(b, c))
}

#[target_feature(enable = "avx2")]
#[inline]
fn packed(four: &Four) -> __m256d {
    // SAFETY: four numbers.
    unsafe { _mm256_loadu_pd(four.0.as_ptr()) }
}

#[target_feature(enable = "avx2")]
#[inline]
fn unpacked(vector: __m256d) -> Four {
    let mut four = Four::default();
    // SAFETY: four numbers.
    unsafe { _mm256_storeu_pd(four.0.as_mut_ptr(), vector) };
    four
}

/// Which states have finite numbers only in all rows; none where the processor lacks the instructions.
pub(crate) fn are_finite<'s>(rows: impl Iterator<Item = &'s [Four]>) -> [bool; 4] {
    let mut trace = Four([if super::is_available() { 0.0 } else { f64::NAN }; 4]);
    if trace.0[0] == 0.0 {
        for row in rows {
            // SAFETY: the processor has the instructions.
            trace = unsafe { traced(row, trace) };
        }
    }
    trace.0.map(|trace| trace == 0.0)
}

/// Zero where all are finite: what is not spreads.
#[target_feature(enable = "avx2")]
#[allow(clippy::needless_range_loop)]
fn traced(row: &[Four], trace: Four) -> Four {
    let zero = _mm256_setzero_pd();
    let mut traces = [packed(&trace), zero, zero, zero];
    let (quads, rest) = row.as_chunks::<4>();
    for quad in quads {
        for i in 0..4 {
            traces[i] = sum_product(traces[i], zero, packed(&quad[i]));
        }
    }
    for i in 0..rest.len() {
        traces[i] = sum_product(traces[i], zero, packed(&rest[i]));
    }
    let (low, high) = (
        _mm256_add_pd(traces[0], traces[1]),
        _mm256_add_pd(traces[2], traces[3]),
    );
    unpacked(_mm256_add_pd(low, high))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_and_slopes_of_known_polynomials() {
        if !super::super::is_available() {
            return;
        }
        // x + 2 x² + 3 x³ times k in state l: small integers are exact.
        let rows: Vec<Vec<Four>> = (1..=5)
            .map(|k| {
                (1..=3)
                    .map(|j| Four([1.0, 2.0, 3.0, 4.0].map(|l| l * (k * j) as f64)))
                    .collect()
            })
            .collect();
        let h = [2.0, -1.0, 0.5, 0.0];
        let mut seen = 0;
        horner((rows.len(), |k| &rows[k][..]), Four(h), |k, sum, slope| {
            for (l, &x) in h.iter().enumerate() {
                let scale = ((l + 1) * (k + 1)) as f64;
                assert_eq!(sum.0[l], scale * (x + 2.0 * x * x + 3.0 * x * x * x));
                assert_eq!(slope.0[l], scale * (1.0 + 4.0 * x + 9.0 * x * x));
            }
            seen += 1;
        });
        assert_eq!(seen, 5);
    }

    #[test]
    fn what_is_not_finite_is_found_in_its_state() {
        if !super::super::is_available() {
            return;
        }
        for place in 0..5 {
            let mut row = vec![Four([1e300, -1.0, 0.0, 5e-324]); 5];
            row[place].0[2] = f64::INFINITY;
            row[place].0[3] = f64::NAN;
            let rows = [vec![Four::default(); 3], row];
            let found = are_finite(rows.iter().map(|row| &row[..]));
            assert_eq!(found, [true, true, false, false], "{place}");
        }
    }
}
