//! Subspaces in numbers: singular vectors, complements, least squares.

use chetaev_stability::singular::{singular, Singular};
use nalgebra::{DMatrix, DVector};

/// `m = u diag(s) vᵀ` with square u and v, s descending, for a matrix filled up with zeros to a square.
pub(crate) struct Decomposed {
    pub(crate) u: DMatrix<f64>,
    pub(crate) s: Vec<f64>,
    pub(crate) v: DMatrix<f64>,
}

/// The singular value decomposition; `None` where an entry is no number, or there is none.
pub(crate) fn decomposed(m: &DMatrix<f64>) -> Option<Decomposed> {
    let Singular {
        left,
        values,
        right,
    } = singular(m)?;
    let is_any = !values.is_empty();
    is_any.then_some(Decomposed {
        u: left,
        s: values,
        v: right,
    })
}

/// How many columns depend on the others: singular values below a part of the largest.
pub(crate) fn nullity(m: &DMatrix<f64>, part: f64) -> usize {
    let Some(found) = decomposed(m) else {
        return m.ncols();
    };
    let limit = part * found.s.first().copied().unwrap_or(0.0);
    let rank = found.s.iter().filter(|s| **s > limit).count();
    m.ncols() - rank.min(m.ncols())
}

/// The vectors of unit length that a matrix shrinks most, as columns.
pub(crate) fn kernel(m: &DMatrix<f64>, dimension: usize) -> Option<DMatrix<f64>> {
    let found = decomposed(m)?;
    let n = m.ncols();
    // Where rows are missing the columns were not filled up, and v is n × n; else vectors of the filling come last and are left out.
    let columns: Vec<usize> = (0..found.v.ncols())
        .filter(|&c| found.v.column(c).rows(0, n).norm() > 0.5)
        .collect();
    let last = columns.len().checked_sub(dimension)?;
    Some(found.v.select_columns(&columns[last..]).rows(0, n).into())
}

/// An orthonormal basis of what is orthogonal to some vectors of R^n, given as columns.
pub(crate) fn complement(n: usize, vectors: &DMatrix<f64>) -> DMatrix<f64> {
    if vectors.ncols() == 0 || n == 0 {
        return DMatrix::identity(n, n);
    }
    let rank = vectors.ncols() - nullity(vectors, 1e-9);
    match decomposed(vectors) {
        Some(found) => found
            .u
            .columns(rank, found.u.ncols() - rank)
            .rows(0, n)
            .into(),
        None => DMatrix::identity(n, n),
    }
}

/// The shortest x for which m x − b is shortest; singular values below a part of the largest count as zero.
pub(crate) fn least_squares(m: &DMatrix<f64>, b: &DVector<f64>, part: f64) -> Option<DVector<f64>> {
    let found = decomposed(m)?;
    let limit = part * found.s.first()?;
    let b = b.clone().resize_vertically(found.u.nrows(), 0.0);
    let mut along = found.u.tr_mul(&b);
    for (x, s) in along.iter_mut().zip(&found.s) {
        *x = if *s > limit { *x / s } else { 0.0 };
    }
    Some((found.v * along).rows(0, m.ncols()).into())
}

/// The x for which |m x − b|² + μ |x|² is smallest.
pub(crate) fn damped(m: &DMatrix<f64>, b: &DVector<f64>, mu: f64) -> Option<DVector<f64>> {
    let found = decomposed(m)?;
    let least = f64::EPSILON * found.s.first()?;
    let b = b.clone().resize_vertically(found.u.nrows(), 0.0);
    let mut along = found.u.tr_mul(&b);
    for (x, s) in along.iter_mut().zip(&found.s) {
        *x = if *s > least {
            *x * s / (s * s + mu)
        } else {
            0.0
        };
    }
    Some((found.v * along).rows(0, m.ncols()).into())
}
