//! Singular values and vectors in double precision, by one-sided rotations (Hestenes 1958, J. SIAM 6): columns are turned in pairs until all are
//! orthogonal. Their lengths are the singular values, small ones too to rounding of themselves where the columns are scaled
//! (Demmel and Veselić 1992, SIAM J. Matrix Anal. Appl. 13).
//!
//! The method of nalgebra (bidiagonal matrices, Golub and Kahan) gives vectors that are none of the matrix in about one of a hundred matrices of
//! lower rank, as of `[[a, a], [b, b]]`: a rotation is skipped where an entry of the diagonal vanishes.

use nalgebra::{ComplexField, DMatrix, DVector};

/// `m = u diag(s) v*` with square u and v and s descending, for a matrix filled up with zeros to a square.
#[derive(Clone, Debug)]
pub struct Singular<T: ComplexField<RealField = f64>> {
    /// u, unitary.
    pub left: DMatrix<T>,
    /// s.
    pub values: Vec<f64>,
    /// v, unitary.
    pub right: DMatrix<T>,
}

/// Passes over all pairs of columns: some six are usual.
const PASSES: usize = 60;
/// Columns are orthogonal to rounding where their cosine is smaller.
const ORTHOGONAL: f64 = 4.0 * f64::EPSILON;
/// Columns below this part of the largest entry are zero: what is left of a column that depends on others, turned once more.
const ZERO: f64 = f64::EPSILON * f64::EPSILON;

/// The singular values and vectors; `None` where an entry is no number.
pub fn singular<T: ComplexField<RealField = f64>>(m: &DMatrix<T>) -> Option<Singular<T>> {
    let n = m.nrows().max(m.ncols());
    if m.iter().any(|x| !x.clone().abs().is_finite()) {
        return None;
    }
    let unit = m.camax();
    let unit = if unit.is_normal() { unit } else { 1.0 };
    let mut columns = m.clone().resize(n, n, T::zero()).unscale(unit);
    let mut right = DMatrix::identity(n, n);
    for _ in 0..PASSES {
        if !turned(&mut columns, &mut right) {
            return Some(sorted(&columns, &right, unit));
        }
    }
    None
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

/// The same of a matrix that is given row by row.
pub fn least_part_of(rows: usize, entries: &[f64]) -> f64 {
    let columns = entries.len() / rows.max(1);
    least_part(&DMatrix::from_row_slice(rows, columns, entries))
}

/// One pass; whether a pair was turned.
fn turned<T: ComplexField<RealField = f64>>(
    columns: &mut DMatrix<T>,
    right: &mut DMatrix<T>,
) -> bool {
    let mut is_turned = false;
    for p in 0..columns.ncols() {
        for q in p + 1..columns.ncols() {
            let (a, b) = (columns.column(p).norm(), columns.column(q).norm());
            let product = columns.column(p).dotc(&columns.column(q));
            let size = product.clone().abs();
            // The least column keeps its place in the order of sizes, so that columns that vanish are no longer turned.
            if a.min(b) < ZERO || size <= ORTHOGONAL * a * b {
                continue;
            }
            is_turned = true;
            let zeta = (b - a) * (b + a) / (2.0 * size);
            let tangent = zeta.signum() / (zeta.abs() + zeta.hypot(1.0));
            let cosine = 1.0 / tangent.hypot(1.0);
            let sine = product.unscale(size).scale(cosine * tangent);
            turn(columns, (p, q), (cosine, &sine));
            turn(right, (p, q), (cosine, &sine));
        }
    }
    is_turned
}

/// `(a, b) ↦ (c a − s̄ b, s a + c b)` of two columns.
fn turn<T: ComplexField<RealField = f64>>(
    m: &mut DMatrix<T>,
    (p, q): (usize, usize),
    (cosine, sine): (f64, &T),
) {
    for r in 0..m.nrows() {
        let (a, b) = (m[(r, p)].clone(), m[(r, q)].clone());
        m[(r, p)] = a.clone().scale(cosine) - b.clone() * sine.clone().conjugate();
        m[(r, q)] = a * sine.clone() + b.scale(cosine);
    }
}

/// Orthogonal columns as vectors of length 1 with their lengths, descending.
fn sorted<T: ComplexField<RealField = f64>>(
    columns: &DMatrix<T>,
    right: &DMatrix<T>,
    unit: f64,
) -> Singular<T> {
    let n = columns.ncols();
    let lengths: Vec<f64> = columns.column_iter().map(|own| own.norm()).collect();
    let mut order: Vec<usize> = (0..n).collect();
    order.sort_by(|&a, &b| lengths[b].total_cmp(&lengths[a]));
    let mut left = DMatrix::zeros(n, n);
    for (place, &own) in order.iter().enumerate() {
        let vector = if lengths[own] < ZERO {
            beside(&left.columns(0, place).into())
        } else {
            columns.column(own).unscale(lengths[own])
        };
        left.set_column(place, &vector);
    }
    Singular {
        left,
        values: order.iter().map(|&own| lengths[own] * unit).collect(),
        right: right.select_columns(&order),
    }
}

/// A vector of length 1 that is orthogonal to orthonormal ones: the axis of which they leave most, twice without what is along them
/// (Daniel, Gragg, Kaufman and Stewart 1976).
fn beside<T: ComplexField<RealField = f64>>(known: &DMatrix<T>) -> DVector<T> {
    let n = known.nrows();
    let rows = known.row_iter().map(|row| row.norm());
    let axis = rows.enumerate().min_by(|a, b| a.1.total_cmp(&b.1));
    let mut own = DVector::zeros(n);
    own[axis.map_or(0, |found| found.0)] = T::one();
    for _ in 0..2 {
        own -= known * known.ad_mul(&own);
        own.normalize_mut();
    }
    own
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

    /// Small singular values to rounding of themselves: 1, 10⁻¹⁰⁰ of columns that are nearly parallel.
    #[test]
    fn small_values_are_found() {
        let m = DMatrix::from_row_slice(2, 2, &[1.0, 1e-100, 1.0, -1e-100]);
        let found = singular(&m).map(|own| own.values).unwrap_or_default();
        let root = 2.0_f64.sqrt();
        assert!((found[0] - root).abs() < 1e-15, "{found:?}");
        assert!((found[1] / 1e-100 - root).abs() < 1e-14, "{found:?}");
    }
}
