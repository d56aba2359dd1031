//! Eigenvalues of a monodromy matrix, or of linear equations with constant coefficients, without those that structure gives.
//!
//! An integral I of the motion makes ∇I a left eigenvector, and the direction along the orbit is a right one (Poincaré 1899, ch. IV). On the vectors
//! on which all ∇I vanish, modulo those directions, stands the matrix that is left: its eigenvalues are computed without the ill-conditioned
//! multiple eigenvalue that both together make.

use crate::error::OrbitError;
use crate::subspace::complement;
use chetaev_stability::singular::singular;
use nalgebra::{Complex, DMatrix, DVector};

/// Eigenvalues that decide, and what others are.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Spectrum {
    /// Those that structure does not give, ascending by real and then by imaginary part.
    pub values: Vec<Complex<f64>>,
    /// How far each of them may be from what it is.
    pub errors: Vec<f64>,
    /// Those that it does, each by what it belongs to; they are 0 of linear equations and 1 of a monodromy matrix.
    pub trivial: Vec<String>,
    /// How many further ones are zero along the whole curve: they are in no test of what passes, and decide all the same.
    pub zeros: usize,
}

impl Spectrum {
    /// The same with those that are zero along the whole curve among the values.
    pub(crate) fn completed(self) -> Spectrum {
        let zeros = vec![(Complex::new(0.0, 0.0), 0.0); self.zeros];
        let own = self.values.into_iter().zip(self.errors);
        let mut all: Vec<(Complex<f64>, f64)> = own.chain(zeros).collect();
        all.sort_by(|(a, _), (b, _)| a.re.total_cmp(&b.re).then(a.im.total_cmp(&b.im)));
        let (values, errors) = all.into_iter().unzip();
        Spectrum {
            values,
            errors,
            trivial: self.trivial,
            zeros: 0,
        }
    }
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
    let error = INTEGRATED * matrix.amax().max(1.0);
    Ok(Spectrum {
        errors: vec![error; values.len()],
        values,
        trivial: names.collect(),
        zeros: 0,
    })
}

/// What an integration through a period leaves open, in parts of the largest entry of the matrix.
const INTEGRATED: f64 = 1e-12;

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

/// Real parts between these parts of the largest eigenvalue are looked at: larger ones are no rounding, and smaller ones are.
const DOUBTFUL: std::ops::Range<f64> = 1e-14..1e-6;

/// How far the eigenvalues of a matrix may be from what was computed, where that decides on which side of the axis they lie: its rounding times the
/// condition of each, one over the product of its left and its right eigenvector of unit length (Wilkinson 1965, ch. 2).
pub fn errors(matrix: &DMatrix<f64>, values: &[Complex<f64>]) -> Vec<f64> {
    let size = values.iter().map(|l| l.norm()).fold(0.0, f64::max);
    let rounding = 4.0 * f64::EPSILON * matrix.norm();
    let complex = matrix.map(|x| Complex::new(x, 0.0));
    let n = matrix.nrows();
    let condition = |l: Complex<f64>| {
        let shifted = &complex - DMatrix::identity(n, n) * l;
        let found = singular(&shifted)?;
        let last = n.checked_sub(1)?;
        Some(
            found
                .left
                .column(last)
                .dotc(&found.right.column(last))
                .norm()
                .recip(),
        )
    };
    let error = |l: &Complex<f64>| {
        if DOUBTFUL.contains(&(l.re.abs() / size)) {
            rounding * condition(*l).unwrap_or(f64::INFINITY)
        } else {
            rounding.max(DOUBTFUL.start * size)
        }
    };
    values.iter().map(error).collect()
}
