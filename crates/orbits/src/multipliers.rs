//! Eigenvalues of a monodromy matrix, or of linear equations with constant coefficients, without those that structure gives.
//!
//! An integral I of the motion makes ∇I a left eigenvector, and the direction along the orbit is a right one (Poincaré 1899, ch. IV). On the vectors
//! on which all ∇I vanish, modulo those directions, stands the matrix that is left: its eigenvalues are computed without the ill-conditioned
//! multiple eigenvalue that both together make.

use crate::error::OrbitError;
use crate::subspace::complement;
use nalgebra::{Complex, DMatrix, DVector};

/// Eigenvalues that decide, and what others are.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Spectrum {
    /// Those that structure does not give, ascending by real and then by imaginary part.
    pub values: Vec<Complex<f64>>,
    /// Those that it does, each by what it belongs to; they are 0 of linear equations and 1 of a monodromy matrix.
    pub trivial: Vec<String>,
}

/// A direction with what it belongs to.
pub type Named = (String, DVector<f64>);

/// The eigenvalues of a matrix without those of left and of right eigenvectors, which have the eigenvalue that is trivial.
///
/// # Errors
/// [`OrbitError::NoEigenvalues`].
pub fn split(
    matrix: &DMatrix<f64>,
    left: &[Named],
    right: &[Named],
) -> Result<Spectrum, OrbitError> {
    let n = matrix.nrows();
    let left = independent(left);
    let kept = complement(n, &columns(n, &left));
    let inside: Vec<Named> = right
        .iter()
        .map(|(name, vector)| (name.clone(), kept.tr_mul(vector)))
        .collect();
    let inside = independent(&inside);
    let on_kept = kept.tr_mul(&(matrix * &kept));
    let modulo = complement(kept.ncols(), &columns(kept.ncols(), &inside));
    let values = eigenvalues(&modulo.tr_mul(&(on_kept * &modulo)))?;
    let names = inside.into_iter().chain(left).map(|(name, _)| name);
    Ok(Spectrum {
        values,
        trivial: names.collect(),
    })
}

/// A vector counts as dependent on others where less than this part of it is left.
const DEPENDENT: f64 = 1e-7;

/// Those that do not depend on the ones before them.
fn independent(all: &[Named]) -> Vec<Named> {
    let mut basis: Vec<DVector<f64>> = Vec::new();
    let mut kept = Vec::new();
    for (name, vector) in all {
        let size = vector.norm();
        let mut rest = vector.clone();
        for own in &basis {
            rest -= own * own.dot(&rest);
        }
        if rest.norm() > DEPENDENT * size && size > 0.0 {
            basis.push(rest.normalize());
            kept.push((name.clone(), vector.normalize()));
        }
    }
    kept
}

fn columns(n: usize, all: &[Named]) -> DMatrix<f64> {
    DMatrix::from_fn(n, all.len(), |r, c| all[c].1[r])
}

/// The eigenvalues of a matrix, ascending by real and then by imaginary part.
///
/// # Errors
/// [`OrbitError::NoEigenvalues`].
pub fn eigenvalues(matrix: &DMatrix<f64>) -> Result<Vec<Complex<f64>>, OrbitError> {
    let n = matrix.nrows();
    let rows = |m: &DMatrix<f64>| -> Vec<Vec<f64>> {
        (0..n).map(|r| m.row(r).iter().copied().collect()).collect()
    };
    chetaev_stability::eigenvalues::eigenvalues(&rows(&DMatrix::identity(n, n)), &rows(matrix))
        .ok_or(OrbitError::NoEigenvalues)
}
