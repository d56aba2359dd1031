//! Eigenvalues in double precision.

use nalgebra::{DMatrix, Schur};

pub use nalgebra::Complex;

/// The eigenvalues of `E δz' = F δz`, E and F row by row, ascending by real and then by imaginary part; `None` where E is singular to
/// rounding or an entry is no number.
pub fn eigenvalues(left: &[Vec<f64>], right: &[Vec<f64>]) -> Option<Vec<Complex<f64>>> {
    let matrix = matrix(left, right)?;
    if matrix.nrows() == 0 {
        return Some(Vec::new());
    }
    let mut found = spectrum(&matrix)?;
    found.sort_by(|a, b| a.re.total_cmp(&b.re).then(a.im.total_cmp(&b.im)));
    Some(found)
}

/// Steps of the QR method for one matrix: some two for each eigenvalue are usual.
const STEPS: usize = 1_000;

/// The eigenvalues of a square matrix, in no order. The double shifts of the QR method may go round without end where the spectrum is its own
/// mirror image, as that of a conservative system; the same matrix plus a multiple of the unit matrix has another.
pub(crate) fn spectrum(matrix: &DMatrix<f64>) -> Option<Vec<Complex<f64>>> {
    let n = matrix.nrows();
    let size = matrix.norm();
    [0.0, 0.37, -0.61].into_iter().find_map(|part| {
        let shift = part * size;
        let moved = matrix + DMatrix::identity(n, n) * shift;
        let schur = Schur::try_new(moved, f64::EPSILON, STEPS)?;
        let found = schur.complex_eigenvalues();
        Some(found.iter().map(|l| *l - shift).collect())
    })
}

/// A = E⁻¹F.
pub fn matrix(left: &[Vec<f64>], right: &[Vec<f64>]) -> Option<DMatrix<f64>> {
    let n = left.len();
    let of = |rows: &[Vec<f64>]| DMatrix::from_row_iterator(n, n, rows.iter().flatten().copied());
    let (e, f) = (of(left), of(right));
    let is_finite = e.iter().chain(f.iter()).all(|x| x.is_finite());
    is_finite.then(|| e.lu().solve(&f)).flatten()
}

/// The mode of an eigenvalue: the vector z of length 1 for which `(λE − F) z` is smallest, its largest entry real and positive.
pub fn mode(
    left: &[Vec<f64>],
    right: &[Vec<f64>],
    eigenvalue: Complex<f64>,
) -> Option<Vec<Complex<f64>>> {
    let matrix = matrix(left, right)?;
    let n = matrix.nrows();
    let entry = |r: usize, c: usize| {
        let own = Complex::new(-matrix[(r, c)], 0.0);
        if r == c {
            own + eigenvalue
        } else {
            own
        }
    };
    let decomposed = DMatrix::from_fn(n, n, entry).try_svd(false, true, f64::EPSILON, 0)?;
    let smallest = decomposed
        .singular_values
        .iter()
        .enumerate()
        .min_by(|a, b| a.1.total_cmp(b.1))?
        .0;
    let rows = decomposed.v_t?;
    let vector: Vec<Complex<f64>> = rows.row(smallest).iter().map(|z| z.conj()).collect();
    let largest = vector.iter().max_by(|a, b| a.norm().total_cmp(&b.norm()))?;
    let turn = largest.conj() / largest.norm();
    Some(vector.iter().map(|z| z * turn).collect())
}
