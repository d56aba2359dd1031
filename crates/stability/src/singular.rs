//! Singular values and vectors in double precision, by the eigenvectors of a Hermitian matrix: `[[0, m], [m*, 0]]` has the eigenvalues ±s with the
//! vectors (u, ±v) (C. Jordan 1874; H. Wielandt), and loses no digits as m* m does.
//!
//! nalgebra's own method for singular values (bidiagonal matrices, Golub and Kahan 1965) gives vectors that are none of the matrix in about one of
//! a hundred matrices of lower rank, as of `[[a, a], [b, b]]`; its eigenvectors of Hermitian matrices are right.

use nalgebra::{ComplexField, DMatrix, SymmetricEigen};

/// `m = u diag(s) v*` with square u and v and s descending, for a matrix filled up with zeros to a square; the vectors of what was filled up come
/// last, each by itself. What is rounding of the largest s is 0.
#[derive(Clone, Debug)]
pub struct Singular<T: ComplexField<RealField = f64>> {
    /// u, unitary.
    pub left: DMatrix<T>,
    /// s.
    pub values: Vec<f64>,
    /// v, unitary.
    pub right: DMatrix<T>,
}

/// Steps of the method for each eigenvalue.
const STEPS: usize = 1_000;
/// Values below this part of the largest, for each row, are rounding.
const ROUNDED: f64 = 4.0 * f64::EPSILON;

/// The singular values and vectors; `None` where an entry is no number.
pub fn singular<T: ComplexField<RealField = f64>>(m: &DMatrix<T>) -> Option<Singular<T>> {
    let n = m.nrows().max(m.ncols());
    if m.iter().any(|x| !x.clone().abs().is_finite()) {
        return None;
    }
    let unit = m.camax();
    let unit = if unit.is_normal() { unit } else { 1.0 };
    let (rows, columns) = m.shape();
    let whole = m.clone().unscale(unit);
    let mut both = DMatrix::zeros(rows + columns, rows + columns);
    both.view_mut((0, rows), (rows, columns)).copy_from(&whole);
    both.view_mut((rows, 0), (columns, rows))
        .copy_from(&whole.adjoint());
    let found = SymmetricEigen::try_new(both, f64::EPSILON, STEPS * (n + 1))?;
    let mut order: Vec<usize> = (0..rows + columns).collect();
    order.sort_by(|&a, &b| found.eigenvalues[b].total_cmp(&found.eigenvalues[a]));
    let largest = order.first().map_or(0.0, |&at| found.eigenvalues[at]);
    let least = ROUNDED * n as f64 * largest;
    let positive = |at: &&usize| found.eigenvalues[**at] > least;
    let order: Vec<usize> = order
        .iter()
        .take(rows.min(columns))
        .filter(positive)
        .copied()
        .collect();
    let mut values: Vec<f64> = order
        .iter()
        .map(|&at| found.eigenvalues[at] * unit)
        .collect();
    values.resize(n, 0.0);
    let vectors = found.eigenvectors.select_columns(&order);
    Some(Singular {
        left: filled(&completed(&vectors.rows(0, rows).into_owned()), n),
        right: filled(&completed(&vectors.rows(rows, columns).into_owned()), n),
        values,
    })
}

/// A unitary matrix with the vectors of the rows or columns that were filled up behind it.
fn filled<T: ComplexField<RealField = f64>>(own: &DMatrix<T>, n: usize) -> DMatrix<T> {
    let mut found = DMatrix::identity(n, n);
    found.view_mut((0, 0), own.shape()).copy_from(own);
    found
}

/// The smallest singular value in parts of the largest, 0 where rows depend on each other, or columns where these are fewer; 0 for no matrix of
/// numbers.
pub fn least_part(m: &DMatrix<f64>) -> f64 {
    let found = singular(m).map(|own| own.values).unwrap_or_default();
    let count = m.nrows().min(m.ncols());
    let ends = found.first().zip(found[..count.min(found.len())].last());
    ends.filter(|own| *own.0 > 0.0)
        .map_or(0.0, |(first, last)| last / first)
}

/// The smallest singular value, 0 where rows depend on each other, or columns where these are fewer; 0 for no matrix of numbers.
pub fn least(m: &DMatrix<f64>) -> f64 {
    let found = singular(m).map(|own| own.values).unwrap_or_default();
    let count = m.nrows().min(m.ncols()).min(found.len());
    found[..count].last().copied().unwrap_or(0.0)
}

/// [`least_part`] of a matrix that is given row by row.
pub fn least_part_of(rows: usize, entries: &[f64]) -> f64 {
    let columns = entries.len() / rows.max(1);
    least_part(&DMatrix::from_row_slice(rows, columns, entries))
}

/// Orthogonal columns made of length 1, with others beside them to a unitary matrix: by the orthonormal factor of what they make with columns
/// that have nothing to do with them.
fn completed<T: ComplexField<RealField = f64>>(known: &DMatrix<T>) -> DMatrix<T> {
    let (n, count) = known.shape();
    let entry = |r: usize, c: usize| {
        if c < count {
            known[(r, c)].clone()
        } else {
            T::from_real(((r * n + c + 1) as f64 * 1.37).sin())
        }
    };
    let mut found = DMatrix::from_fn(n, n, entry).qr().q();
    for c in 0..count {
        let column = known.column(c);
        found.set_column(c, &column.unscale(column.norm()));
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Complex;

    /// How far the product is from the matrix, and the vectors from unitary ones.
    fn error<T: ComplexField<RealField = f64>>(m: &DMatrix<T>) -> f64 {
        let Some(found) = singular(m) else {
            panic!("{m}");
        };
        let n = found.values.len();
        let s = DMatrix::from_fn(n, n, |r, c| {
            T::from_real(if r == c { found.values[r] } else { 0.0 })
        });
        let square = m.clone().resize(n, n, T::zero());
        let product = &found.left * s * found.right.adjoint();
        let unitary = |u: &DMatrix<T>| (u.ad_mul(u) - DMatrix::<T>::identity(n, n)).camax();
        assert!(found.values.is_sorted_by(|a, b| a >= b), "{m}");
        ((square - product).camax() / m.camax().max(f64::MIN_POSITIVE))
            .max(unitary(&found.left))
            .max(unitary(&found.right))
    }

    /// Every matrix is the product, whatever its rank, its shape and the sizes of its entries: what the equations of steady motions give has
    /// zeros, equal columns, and rounding in the place of zeros.
    #[test]
    fn every_matrix_is_the_product() {
        let mut state = 12345_u64;
        let mut random = || {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        for round in 0..4000 {
            let (rows, columns) = (1 + (random() * 6.0) as usize, 1 + (random() * 6.0) as usize);
            let mut m = DMatrix::from_fn(rows, columns, |_, _| match random() {
                x if x < 0.5 => 0.0,
                x if x < 0.7 => 1.0,
                x if x < 0.8 => random() * 10_f64.powf(-15.0 - 25.0 * random()),
                _ => 2.0 * random() - 1.0,
            });
            if round % 3 == 0 {
                let first = m.column(0).clone_owned();
                m.set_column(columns - 1, &first);
            }
            assert!(error(&m) < 1e-14, "{m} {}", error(&m));
            let phase = m.map(|x| Complex::new(0.0, 3.0 * x).exp() * x);
            assert!(error(&phase) < 1e-14, "{phase} {}", error(&phase));
        }
    }

    /// A kernel of columns is one of columns alone, however many rows there are beside.
    #[test]
    fn what_was_filled_up_stays_apart() {
        let m = DMatrix::from_row_slice(
            5,
            3,
            &[
                1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0,
            ],
        );
        let Some(found) = singular(&m) else {
            panic!("{m}");
        };
        for column in 1..3 {
            let own: nalgebra::DVector<f64> = found.right.column(column).into();
            assert!(
                (own.rows(0, 3).norm() - 1.0).abs() < 1e-15,
                "{}",
                found.right
            );
        }
        assert!(error(&m) < 1e-14);
    }
}
