//! Eigenvalues in double precision.

use nalgebra::{Complex, DMatrix};

/// The eigenvalues of `E δz' = F δz`, E and F row by row, ascending by real and then by imaginary part; `None` where E is singular to
/// rounding or an entry is no number.
pub fn eigenvalues(left: &[Vec<f64>], right: &[Vec<f64>]) -> Option<Vec<Complex<f64>>> {
    let matrix = matrix(left, right)?;
    if matrix.nrows() == 0 {
        return Some(Vec::new());
    }
    let mut found: Vec<Complex<f64>> = matrix.complex_eigenvalues().iter().copied().collect();
    found.sort_by(|a, b| a.re.total_cmp(&b.re).then(a.im.total_cmp(&b.im)));
    Some(found)
}

/// A = E⁻¹F.
pub fn matrix(left: &[Vec<f64>], right: &[Vec<f64>]) -> Option<DMatrix<f64>> {
    let n = left.len();
    let of = |rows: &[Vec<f64>]| DMatrix::from_row_iterator(n, n, rows.iter().flatten().copied());
    let (e, f) = (of(left), of(right));
    let is_finite = e.iter().chain(f.iter()).all(|x| x.is_finite());
    is_finite.then(|| e.lu().solve(&f)).flatten()
}
