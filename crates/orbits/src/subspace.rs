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
    let largest = decomposed(m).and_then(|found| found.s.first().copied());
    nullity_below(m, part * largest.unwrap_or(0.0))
}

/// The same for singular values below a limit.
pub(crate) fn nullity_below(m: &DMatrix<f64>, limit: f64) -> usize {
    if m.is_empty() {
        return m.ncols();
    }
    let values = decomposed(m).map(|found| found.s).unwrap_or_default();
    let rank = values.iter().filter(|s| **s > limit).count();
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

/// A matrix with scaled rows and columns, so that ranks do not depend on units.
pub(crate) struct Equilibrated {
    matrix: DMatrix<f64>,
    rows: Vec<f64>,
    columns: Vec<f64>,
    found: Decomposed,
}

/// Each round halves the exponents of the scales that are left.
const ROUNDS: usize = 12;

impl Equilibrated {
    /// With scales for which the largest entries of all rows and columns are about one (Ruiz 2001); `None` where an entry is no number.
    pub(crate) fn new(m: &DMatrix<f64>) -> Option<Equilibrated> {
        let mut matrix = m.clone();
        let (mut rows, mut columns) = (vec![1.0; m.nrows()], vec![1.0; m.ncols()]);
        let scale = |largest: f64| {
            if largest > 0.0 {
                largest.sqrt().recip()
            } else {
                1.0
            }
        };
        for _ in 0..ROUNDS {
            let by_row: Vec<f64> = matrix.row_iter().map(|own| scale(own.amax())).collect();
            let by_column: Vec<f64> = matrix.column_iter().map(|own| scale(own.amax())).collect();
            matrix = DMatrix::from_fn(m.nrows(), m.ncols(), |i, k| {
                matrix[(i, k)] * by_row[i] * by_column[k]
            });
            rows.iter_mut().zip(&by_row).for_each(|(x, y)| *x *= y);
            columns
                .iter_mut()
                .zip(&by_column)
                .for_each(|(x, y)| *x *= y);
        }
        Equilibrated::scaled(m, rows, columns)
    }

    /// With these scales of rows and columns.
    pub(crate) fn scaled(
        m: &DMatrix<f64>,
        rows: Vec<f64>,
        columns: Vec<f64>,
    ) -> Option<Equilibrated> {
        let entry = |i: usize, k: usize| m[(i, k)] * rows[i] * columns[k];
        let matrix = DMatrix::from_fn(m.nrows(), m.ncols(), entry);
        // Where there is no unknown there is nothing to decompose.
        let found = if matrix.is_empty() {
            Decomposed {
                u: DMatrix::zeros(m.nrows(), m.ncols()),
                s: Vec::new(),
                v: DMatrix::zeros(m.ncols(), m.ncols()),
            }
        } else {
            decomposed(&matrix)?
        };
        Some(Equilibrated {
            matrix,
            rows,
            columns,
            found,
        })
    }

    fn limit(&self, part: f64) -> f64 {
        part * self.found.s.first().copied().unwrap_or(0.0)
    }

    /// Columns that take part in what the matrix maps to zero: singular values below a part of the largest.
    pub(crate) fn undetermined(&self, part: f64) -> Vec<usize> {
        let found = &self.found;
        let is_loose = |i: &usize| {
            let mut directions = found.s.iter().zip(found.v.column_iter());
            directions.any(|(s, v)| *s <= self.limit(part) && v[*i].abs() > 1e-6)
        };
        (0..self.columns.len()).filter(is_loose).collect()
    }

    /// An x for which m x − b is shortest.
    pub(crate) fn solve(&self, b: &DVector<f64>, part: f64) -> DVector<f64> {
        let scaled = DVector::from_fn(self.rows.len(), |i, _| b[i] * self.rows[i]);
        let scaled = scaled.resize_vertically(self.found.u.nrows(), 0.0);
        let mut along = self.found.u.tr_mul(&scaled);
        for (x, s) in along.iter_mut().zip(&self.found.s) {
            *x = if *s > self.limit(part) { *x / s } else { 0.0 };
        }
        let found = &self.found.v * along;
        DVector::from_fn(self.columns.len(), |i, _| found[i] * self.columns[i])
    }

    /// Whether m x = b, within a part of the terms.
    pub(crate) fn is_solved(&self, x: &DVector<f64>, b: &DVector<f64>, part: f64) -> bool {
        let scaled = DVector::from_fn(x.len(), |i, _| x[i] / self.columns[i]);
        let rest = |i: usize| {
            let wanted = b[i] * self.rows[i];
            let terms = self.matrix.row(i).transpose().component_mul(&scaled);
            let size = terms
                .iter()
                .fold(wanted.abs(), |sum, term| sum + term.abs());
            ((terms.sum() - wanted).abs(), size)
        };
        let rests: Vec<(f64, f64)> = (0..self.rows.len()).map(rest).collect();
        let largest = rests.iter().fold(0.0, |most: f64, own| most.max(own.1));
        // Terms that are nothing but rounding are not compared.
        rests
            .iter()
            .all(|&(rest, size)| rest <= part * size || rest <= 1e-12 * largest)
    }
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
