//! Factorization and solution of systems too large to be written out, for one state, or four or eight side by side.
//!
//! The storage is that of the interpreter ([`crate::factor`]): L below the diagonal, reciprocals of the pivots on
//! it, U = D Lᵀ above it; then the pivots, then for each row the one it was exchanged with. Every entry is
//! updated in the same order whatever the number of lanes, so that results do not depend on it.
//!
//! Loops run over indices: iterators of the standard library are not compiled for the processor's vectors.
#![allow(clippy::needless_range_loop)]

use super::call::add_product;

/// How many cells a matrix and its factors take.
pub(crate) fn cells(size: usize) -> usize {
    size * stride(size) + 2 * size
}

/// Cells from one row to the next: vectors of four may reach beyond the end of a row, where nothing counts.
pub(crate) fn stride(size: usize) -> usize {
    size + VECTOR - 1
}

const VECTOR: usize = 4;

/// A pivot of L D Lᵀ has to be above this, times the sum of all pivots and the size. The interpreter compares with
/// the largest pivot, which is less: what passes here passes there.
pub(crate) const NEGLIGIBLE: f64 = 10.0 * f64::EPSILON;

/// Pivots of L U whose ratio is above this need no closer look.
pub(crate) const UNSUSPICIOUS: f64 = 1e-8;

/// Factorizes in place; the bits of the result are the lanes that need a closer look, which is the interpreter's.
#[target_feature(enable = "avx2,fma")]
pub(crate) fn factor<const W: usize>(size: usize, is_definite: bool, cells: &mut [f64]) -> u64 {
    let (cells, _) = cells.as_chunks_mut::<W>();
    let width = stride(size);
    let (factors, rest) = cells.split_at_mut(size * width);
    let (pivots, exchanges) = rest.split_at_mut(size);
    for i in 0..size {
        exchanges[i] = [i as f64; W];
    }
    for k in 0..size {
        if is_definite {
            for i in k + 1..size {
                factors[k * width + i] = factors[i * width + k];
            }
            eliminate(size, k, factors, pivots, |i| i + 1);
        } else {
            exchange_rows(size, k, factors, exchanges);
            eliminate(size, k, factors, pivots, |_| size);
        }
    }
    let mut doubtful = 0;
    for l in 0..W {
        doubtful |= u64::from(!is_sound(is_definite, pivots, l)) << l;
    }
    doubtful
}

/// Whether the pivots leave no doubt.
fn is_sound<const W: usize>(is_definite: bool, pivots: &[[f64; W]], l: usize) -> bool {
    let mut least = f64::INFINITY;
    let mut sum = 0.0;
    for pivot in pivots {
        let pivot = if is_definite {
            pivot[l]
        } else {
            pivot[l].abs()
        };
        least = least.min(pivot);
        sum += pivot;
    }
    if is_definite {
        least > NEGLIGIBLE * pivots.len() as f64 * sum
    } else {
        least > UNSUSPICIOUS * sum && sum.is_finite()
    }
}

/// Subtracts multiples of row k from the rows i below, up to column `end(i)`.
#[target_feature(enable = "avx2,fma")]
fn eliminate<const W: usize>(
    n: usize,
    k: usize,
    factors: &mut [[f64; W]],
    pivots: &mut [[f64; W]],
    end: impl Fn(usize) -> usize,
) {
    let width = stride(n);
    let (done, below) = factors.split_at_mut((k + 1) * width);
    let pivot_row = &mut done[k * width..];
    pivots[k] = pivot_row[k];
    let mut reciprocal = [0.0; W];
    for l in 0..W {
        reciprocal[l] = 1.0 / pivots[k][l];
    }
    pivot_row[k] = reciprocal;
    for i in k + 1..n {
        let row = &mut below[(i - k - 1) * width..][..width];
        let mut multiplier = row[k];
        for l in 0..W {
            multiplier[l] *= reciprocal[l];
        }
        row[k] = multiplier;
        let vectors = (end(i) - k - 1) * W;
        let vectors = vectors.div_ceil(VECTOR);
        subtract_row(vectors, &mut row[k + 1..], &multiplier, &pivot_row[k + 1..]);
    }
}

/// `row − multiplier · pivot_row`, over a number of vectors.
#[inline]
#[target_feature(enable = "avx2,fma")]
fn subtract_row<const W: usize>(
    vectors: usize,
    row: &mut [[f64; W]],
    multiplier: &[f64; W],
    pivot_row: &[[f64; W]],
) {
    // Of eight states, every other vector has the upper four.
    let mut wide = [[0.0; VECTOR]; 2];
    for l in 0..2 * VECTOR {
        wide[l / VECTOR][l % VECTOR] = -multiplier[l % W];
    }
    let (row, _) = row.as_flattened_mut().as_chunks_mut::<VECTOR>();
    let (pivot_row, _) = pivot_row.as_flattened().as_chunks::<VECTOR>();
    let (row, pivot_row) = (&mut row[..vectors], &pivot_row[..vectors]);
    for j in 0..vectors {
        add_product(&mut row[j], &wide[j % 2], &pivot_row[j]);
    }
}

/// Brings the largest entry of column k, at or below the diagonal, to the diagonal, in each lane by itself.
fn exchange_rows<const W: usize>(
    n: usize,
    k: usize,
    factors: &mut [[f64; W]],
    exchanges: &mut [[f64; W]],
) {
    let width = stride(n);
    for l in 0..W {
        let mut pivot = k;
        let mut largest = factors[k * width + k][l].abs();
        for i in k + 1..n {
            let magnitude = factors[i * width + k][l].abs();
            if magnitude > largest {
                (pivot, largest) = (i, magnitude);
            }
        }
        if pivot == k {
            continue;
        }
        let (upper, lower) = factors.split_at_mut(pivot * width);
        let (above, below) = (&mut upper[k * width..][..n], &mut lower[..n]);
        for j in 0..n {
            (above[j][l], below[j][l]) = (below[j][l], above[j][l]);
        }
        exchanges[k][l] = pivot as f64;
    }
}

/// Solves with a factorized matrix; `x` is the right-hand side first.
#[target_feature(enable = "avx2,fma")]
pub(crate) fn solve<const W: usize>(n: usize, cells: &[f64], x: &mut [f64]) {
    let (cells, _) = cells.as_chunks::<W>();
    let width = stride(n);
    let (factors, rest) = cells.split_at(n * width);
    let exchanges = &rest[n..];
    let (x, _) = x.as_chunks_mut::<W>();
    exchange(exchanges, x);
    // What is known is subtracted from all that is not: many updates at once that do not wait for each other.
    for k in 0..n {
        let known = x[k];
        // Unit vectors begin with zeros.
        if known == [0.0; W] {
            continue;
        }
        for i in k + 1..n {
            subtract(&mut x[i], &factors[i * width + k], &known);
        }
    }
    for k in (0..n).rev() {
        for l in 0..W {
            x[k][l] *= factors[k * width + k][l];
        }
        let known = x[k];
        for i in 0..k {
            subtract(&mut x[i], &factors[i * width + k], &known);
        }
    }
}

#[inline]
#[target_feature(enable = "avx2,fma")]
fn subtract<const W: usize>(x: &mut [f64; W], a: &[f64; W], b: &[f64; W]) {
    for l in 0..W {
        x[l] = (-a[l]).mul_add(b[l], x[l]);
    }
}

/// Exchanges entries as rows were exchanged, in each lane by itself.
fn exchange<const W: usize>(exchanges: &[[f64; W]], x: &mut [[f64; W]]) {
    for k in 0..x.len() {
        for l in 0..W {
            // Always an index, but a panic in native code would end the process.
            let other = (exchanges[k][l] as usize).min(x.len() - 1);
            (x[k][l], x[other][l]) = (x[other][l], x[k][l]);
        }
    }
}

/// The exchanges that bring row `rows[i]` to place i, for every i.
pub(crate) fn exchanges(rows: &[usize]) -> Vec<usize> {
    let mut now: Vec<usize> = (0..rows.len()).collect();
    (0..rows.len())
        .map(|i| {
            let at = now.iter().position(|row| *row == rows[i]).unwrap_or(i);
            now.swap(i, at);
            at
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_brought_to_their_places_by_exchanges() {
        let rows = [3, 1, 0, 5, 4, 2];
        let exchanges: Vec<[f64; 1]> = exchanges(&rows).iter().map(|&i| [i as f64]).collect();
        let mut x = [0, 10, 20, 30, 40, 50].map(|i| [f64::from(i)]);
        exchange(&exchanges, &mut x);
        assert_eq!(x, [30, 10, 0, 50, 40, 20].map(|i| [f64::from(i)]));
    }
}
