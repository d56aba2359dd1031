//! Factorization and solution of systems too large to be written out, for one state or four side by side.
//!
//! The storage is that of the interpreter ([`crate::factor`]): L below the diagonal, reciprocals of the pivots on
//! it, U = D Lᵀ above it; then the pivots, then for each row of the factors its row in the matrix. Every entry is
//! updated in the same order whatever the number of lanes, so that results do not depend on it.

/// How many cells a matrix and its factors take.
pub(crate) fn cells(size: usize) -> usize {
    size * size + 2 * size
}

/// A pivot of L D Lᵀ has to be above this, times the sum of all pivots and the size. The interpreter compares with
/// the largest pivot, which is less: what passes here passes there.
pub(crate) const NEGLIGIBLE: f64 = 10.0 * f64::EPSILON;

/// Pivots of L U whose ratio is above this need no closer look.
const UNSUSPICIOUS: f64 = 1e-8;

/// Factorizes in place; the bits of the result are the lanes that need a closer look, which is the interpreter's.
#[target_feature(enable = "avx2,fma")]
pub(crate) fn factor<const W: usize>(size: usize, is_definite: bool, cells: &mut [f64]) -> u64 {
    let (cells, _) = cells.as_chunks_mut::<W>();
    let (factors, rest) = cells.split_at_mut(size * size);
    let (pivots, rows) = rest.split_at_mut(size);
    for (i, row) in rows.iter_mut().enumerate() {
        *row = [i as f64; W];
    }
    for k in 0..size {
        if is_definite {
            for i in k + 1..size {
                factors[k * size + i] = factors[i * size + k];
            }
            eliminate(size, k, factors, pivots, |i| i + 1);
        } else {
            exchange_rows(size, k, factors, rows);
            eliminate(size, k, factors, pivots, |_| size);
        }
    }
    (0..W)
        .filter(|&l| !is_sound(is_definite, pivots, l))
        .fold(0, |bits, l| bits | 1 << l)
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
    let (done, below) = factors.split_at_mut((k + 1) * n);
    let (pivot, pivot_row) = done[k * n + k..].split_at_mut(1);
    pivots[k] = pivot[0];
    let mut reciprocal = [0.0; W];
    for l in 0..W {
        reciprocal[l] = 1.0 / pivot[0][l];
    }
    pivot[0] = reciprocal;
    for (i, row) in below.chunks_exact_mut(n).enumerate() {
        let (left, right) = row[..end(k + 1 + i)].split_at_mut(k + 1);
        let mut multiplier = left[k];
        for l in 0..W {
            multiplier[l] *= reciprocal[l];
        }
        left[k] = multiplier;
        // Closures of the standard library would not be compiled for the processor's fused operations.
        for (a, u) in right.iter_mut().zip(&*pivot_row) {
            for l in 0..W {
                a[l] = (-multiplier[l]).mul_add(u[l], a[l]);
            }
        }
    }
}

/// Brings the largest entry of column k, at or below the diagonal, to the diagonal, in each lane by itself.
fn exchange_rows<const W: usize>(
    n: usize,
    k: usize,
    factors: &mut [[f64; W]],
    rows: &mut [[f64; W]],
) {
    for l in 0..W {
        let mut pivot = k;
        let mut largest = factors[k * n + k][l].abs();
        for i in k + 1..n {
            let magnitude = factors[i * n + k][l].abs();
            if magnitude > largest {
                (pivot, largest) = (i, magnitude);
            }
        }
        if pivot == k {
            continue;
        }
        let (upper, lower) = factors.split_at_mut(pivot * n);
        for (above, below) in upper[k * n..(k + 1) * n].iter_mut().zip(&mut lower[..n]) {
            std::mem::swap(&mut above[l], &mut below[l]);
        }
        let moved = rows[k][l];
        rows[k][l] = rows[pivot][l];
        rows[pivot][l] = moved;
    }
}

/// Solves with a factorized matrix; `x` is the right-hand side first.
#[target_feature(enable = "avx2,fma")]
pub(crate) fn solve<const W: usize>(n: usize, cells: &[f64], x: &mut [f64]) {
    let (cells, _) = cells.as_chunks::<W>();
    let (factors, rest) = cells.split_at(n * n);
    let rows = &rest[n..];
    let (x, _) = x.as_chunks_mut::<W>();
    permute(rows, x);
    for i in 1..n {
        let (known, rest) = x.split_at_mut(i);
        for (lower, known) in factors[i * n..].iter().zip(&*known) {
            subtract(&mut rest[0], lower, known);
        }
    }
    for i in (0..n).rev() {
        let (rest, known) = x.split_at_mut(i + 1);
        let row = &factors[i * n + i..(i + 1) * n];
        for (upper, known) in row[1..].iter().zip(&*known) {
            subtract(&mut rest[i], upper, known);
        }
        for l in 0..W {
            rest[i][l] *= row[0][l];
        }
    }
}

#[target_feature(enable = "avx2,fma")]
fn subtract<const W: usize>(x: &mut [f64; W], a: &[f64; W], b: &[f64; W]) {
    for l in 0..W {
        x[l] = (-a[l]).mul_add(b[l], x[l]);
    }
}

/// Puts entry `rows[i]` of `x` first to place i, in each lane by itself, without storage: along each cycle of the
/// permutation, found by its least element.
fn permute<const W: usize>(rows: &[[f64; W]], x: &mut [[f64; W]]) {
    for l in 0..W {
        let source = |i: usize| rows[i][l] as usize;
        for start in 0..rows.len() {
            let mut other = source(start);
            while other > start {
                other = source(other);
            }
            if other < start || source(start) == start {
                continue;
            }
            let first = x[start][l];
            let mut i = start;
            while source(i) != start {
                x[i][l] = x[source(i)][l];
                i = source(i);
            }
            x[i][l] = first;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn permutations_are_applied_along_their_cycles() {
        let rows = [3, 1, 0, 5, 4, 2].map(|i| [f64::from(i)]);
        let mut x = [0, 10, 20, 30, 40, 50].map(|i| [f64::from(i)]);
        permute(&rows, &mut x);
        assert_eq!(x, [30, 10, 0, 50, 40, 20].map(|i| [f64::from(i)]));
    }
}
