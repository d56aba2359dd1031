//! Small dense linear algebra on rows: projections, null spaces, ranks.

use chetaev_motion::dense::Lu;

/// `a b` for a row-major matrix of so many columns.
pub(super) fn times(a: &[f64], columns: usize, b: &[f64]) -> Vec<f64> {
    let rows = a.chunks(columns.max(1));
    rows.map(|row| row.iter().zip(b).map(|(x, y)| x * y).sum())
        .collect()
}

/// `aᵀ b` for a row-major matrix of so many columns.
pub(super) fn transposed_times(a: &[f64], columns: usize, b: &[f64]) -> Vec<f64> {
    let mut sum = vec![0.0; columns];
    for (row, y) in a.chunks(columns.max(1)).zip(b) {
        for (s, x) in sum.iter_mut().zip(row) {
            *s += x * y;
        }
    }
    sum
}

/// `a aᵀ` of r rows.
pub(crate) fn gram(a: &[f64], r: usize, columns: usize) -> Vec<f64> {
    let mut product = vec![0.0; r * r];
    for i in 0..r {
        for j in 0..r {
            let (x, y) = (
                &a[i * columns..(i + 1) * columns],
                &a[j * columns..(j + 1) * columns],
            );
            product[i * r + j] = x.iter().zip(y).map(|(a, b)| a * b).sum();
        }
    }
    product
}

/// The solution of a square system; `None` where a pivot is negligible.
pub(super) fn solved(n: usize, a: &[f64], b: &[f64]) -> Option<Vec<f64>> {
    let mut lu = Lu::default();
    lu.factor(n, a).ok()?;
    let mut x = b.to_vec();
    lu.solve(&mut x);
    Some(x)
}

/// Gauss–Jordan with complete pivoting: the pivots (row, column) in order, largest first, and the reduced matrix. Pivots below
/// `threshold` times the first one count as zero.
fn reduced(a: &[f64], rows: usize, columns: usize, threshold: f64) -> (Vec<usize>, Vec<f64>) {
    let mut a = a.to_vec();
    let mut places: Vec<usize> = Vec::new();
    let mut first = 0.0_f64;
    for step in 0..rows.min(columns) {
        let open = (step..rows)
            .flat_map(|i| (0..columns).map(move |j| (i, j)))
            .filter(|(_, j)| !places.contains(j));
        let size = |&(i, j): &(usize, usize)| a[i * columns + j].abs();
        let Some((row, column)) = open.max_by(|x, y| size(x).total_cmp(&size(y))) else {
            break;
        };
        let pivot = a[row * columns + column];
        first = first.max(pivot.abs());
        if pivot == 0.0 || pivot.abs() <= threshold * first {
            break;
        }
        for j in 0..columns {
            a.swap(step * columns + j, row * columns + j);
        }
        for j in 0..columns {
            a[step * columns + j] /= pivot;
        }
        for i in (0..rows).filter(|&i| i != step) {
            let factor = a[i * columns + column];
            for j in 0..columns {
                a[i * columns + j] -= factor * a[step * columns + j];
            }
        }
        places.push(column);
    }
    (places, a)
}

/// Vectors that span the null space, each with one component 1.
pub(super) fn null_space(a: &[f64], rows: usize, columns: usize, threshold: f64) -> Vec<Vec<f64>> {
    let (places, reduced) = reduced(a, rows, columns, threshold);
    let free = (0..columns).filter(|j| !places.contains(j));
    free.map(|j| {
        let mut vector = vec![0.0; columns];
        vector[j] = 1.0;
        for (i, &place) in places.iter().enumerate() {
            vector[place] = -reduced[i * columns + j];
        }
        vector
    })
    .collect()
}

/// The determinant.
pub(crate) fn determinant(n: usize, a: &[f64]) -> f64 {
    let mut a = a.to_vec();
    let mut product = 1.0;
    for k in 0..n {
        let size = |&i: &usize| a[i * n + k].abs();
        let p = (k..n)
            .max_by(|x, y| size(x).total_cmp(&size(y)))
            .unwrap_or(k);
        let pivot = a[p * n + k];
        if pivot == 0.0 {
            return 0.0;
        }
        if p != k {
            product = -product;
            for j in 0..n {
                a.swap(k * n + j, p * n + j);
            }
        }
        product *= pivot;
        for i in k + 1..n {
            let factor = a[i * n + k] / pivot;
            for j in k..n {
                a[i * n + j] -= factor * a[k * n + j];
            }
        }
    }
    product
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn null_vectors_of_a_matrix_of_rank_two() {
        let a = [1.0, 2.0, 3.0, 4.0, 2.0, 4.0, 6.0, 8.0, 1.0, 0.0, 1.0, 0.0];
        let found = null_space(&a, 3, 4, 1e-10);
        assert_eq!(found.len(), 2);
        for vector in found {
            assert!(times(&a, 4, &vector).iter().all(|x| x.abs() < 1e-12));
        }
        assert!((determinant(2, &[0.0, 2.0, 3.0, 1.0]) + 6.0).abs() < 1e-12);
    }
}
