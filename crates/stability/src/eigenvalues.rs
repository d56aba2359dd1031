//! Eigenvalues in double precision.

use crate::singular::singular;
use nalgebra::linalg::balancing::balance_parlett_reinsch;
use nalgebra::{DMatrix, DVector, Schur};

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

/// Steps of the QR method for each eigenvalue: some two are usual.
const STEPS: usize = 30;
/// How often the QR method begins again.
const BEGINNINGS: usize = 40;

/// The eigenvalues of a square matrix, in no order. The double shifts of the QR method may go round without end where the spectrum is its own
/// mirror image, as that of a conservative system; one step with a shift that has nothing to do with the matrix leads out of such a cycle
/// (exceptional shifts: Martin, Peters and Wilkinson 1970, Numer. Math. 14; Batterson 1990 on the cycles).
///
/// The QR method is accurate to rounding of the largest entry, whatever the units of the variables: those are chosen first.
pub(crate) fn spectrum(matrix: &DMatrix<f64>) -> Option<Vec<Complex<f64>>> {
    let Balanced { matrix, unit, .. } = balanced(matrix);
    let (n, size) = (matrix.nrows(), matrix.norm());
    let mut own = matrix;
    for beginning in 1..=BEGINNINGS {
        if let Some(schur) = Schur::try_new(own.clone(), f64::EPSILON, STEPS * n) {
            let found = schur.complex_eigenvalues();
            return Some(found.iter().map(|l| *l * unit).collect());
        }
        let shift = DMatrix::identity(n, n) * (size * (0.75 * beginning as f64).sin());
        let (q, r) = (own - &shift).qr().unpack();
        own = r * q + shift;
    }
    None
}

/// A matrix in other units of its variables and of its eigenvalues: A = u D B D⁻¹, D diagonal.
#[derive(Clone, Debug)]
pub struct Balanced {
    /// B, of whose entries none is larger than 1 by much.
    pub matrix: DMatrix<f64>,
    /// The diagonal of D: a vector of B times D is one of A.
    pub scale: DVector<f64>,
    /// u.
    pub unit: f64,
}

/// A square matrix in units in which its rows are as large as its columns, powers of two (Parlett and Reinsch 1969).
pub fn balanced(matrix: &DMatrix<f64>) -> Balanced {
    let unit = power_of_two(matrix.amax());
    let mut own = matrix / unit;
    let scale = balance_parlett_reinsch(&mut own);
    Balanced {
        matrix: own,
        scale,
        unit,
    }
}

/// The power of two at or below a positive number; 1 for zero and for what is no number.
pub fn power_of_two(size: f64) -> f64 {
    let found = size.log2().floor().exp2();
    if found.is_normal() {
        found
    } else {
        1.0
    }
}

/// The eigenvalues of A, imaginary parts zero or positive and each once, at which the rank of `[λ − A, B]` is smaller than the number of rows to
/// rounding: the inputs do not reach their modes (Hautus 1969).
pub fn unreached(a: &[Vec<f64>], b: &[Vec<f64>]) -> Option<Vec<Complex<f64>>> {
    let n = a.len();
    let inputs = b.first().map_or(0, Vec::len);
    let a = DMatrix::from_row_iterator(n, n, a.iter().flatten().copied());
    let b = DMatrix::from_row_iterator(n, inputs, b.iter().flatten().copied());
    if n == 0 || !a.iter().chain(b.iter()).all(|x| x.is_finite()) {
        return None;
    }
    let own = balanced(&a);
    let mut b = DMatrix::from_fn(n, inputs, |r, c| b[(r, c)] / own.scale[r]);
    for mut column in b.column_iter_mut() {
        let size = column.norm();
        if size > 0.0 {
            column /= size;
        }
    }
    let distance = |l: &Complex<f64>| {
        let entry = |r: usize, c: usize| {
            let known = if c < n {
                -own.matrix[(r, c)]
            } else {
                b[(r, c - n)]
            };
            let shift = if r == c {
                *l / own.unit
            } else {
                Complex::new(0.0, 0.0)
            };
            shift + known
        };
        let found = singular(&DMatrix::from_fn(n, n + inputs, entry));
        // Filled up to a square, it has one more zero for each input.
        found.map_or(f64::NAN, |own| own.values[n - 1])
    };
    let mut all = spectrum(&a)?;
    all.retain(|l| l.im >= 0.0 && distance(l) < UNREACHED);
    all.sort_by(|a, b| a.re.total_cmp(&b.re).then(a.im.total_cmp(&b.im)));
    let size = own.unit * own.matrix.norm();
    all.dedup_by(|a, b| (*a - *b).norm() <= UNREACHED * size);
    Some(all)
}

/// A distance from lower rank below this, in units of the matrix, is rounding.
const UNREACHED: f64 = 1e-8;

/// A = E⁻¹F.
pub fn matrix(left: &[Vec<f64>], right: &[Vec<f64>]) -> Option<DMatrix<f64>> {
    let n = left.len();
    let of = |rows: &[Vec<f64>]| DMatrix::from_row_iterator(n, n, rows.iter().flatten().copied());
    let (mut e, mut f) = (of(left), of(right));
    if !e.iter().chain(f.iter()).all(|x| x.is_finite()) {
        return None;
    }
    // Pivots are compared in the units of the variables and of the equations in which the entries of E are at most 1.
    let columns: Vec<f64> = e.column_iter().map(|c| power_of_two(c.amax())).collect();
    for (mut column, unit) in e.column_iter_mut().zip(&columns) {
        column /= *unit;
    }
    for (mut row, mut other) in e.row_iter_mut().zip(f.row_iter_mut()) {
        let unit = power_of_two(row.amax());
        row /= unit;
        other /= unit;
    }
    let mut found = e.lu().solve(&f)?;
    for (mut row, unit) in found.row_iter_mut().zip(&columns) {
        row /= *unit;
    }
    found.iter().all(|x| x.is_finite()).then_some(found)
}

/// The mode of an eigenvalue: the vector z of length 1 for which `(λE − F) z` vanishes, to rounding in suitable units of the variables, its
/// largest entry real and positive.
pub fn mode(
    left: &[Vec<f64>],
    right: &[Vec<f64>],
    eigenvalue: Complex<f64>,
) -> Option<Vec<Complex<f64>>> {
    let Balanced {
        matrix,
        scale,
        unit,
    } = balanced(&matrix(left, right)?);
    let n = matrix.nrows();
    let entry = |r: usize, c: usize| {
        let own = Complex::new(-matrix[(r, c)], 0.0);
        if r == c {
            own + eigenvalue / unit
        } else {
            own
        }
    };
    let right = singular(&DMatrix::from_fn(n, n, entry))?.right;
    let smallest = right.column(n.checked_sub(1)?);
    let vector: Vec<Complex<f64>> = smallest.iter().zip(&scale).map(|(z, d)| z * *d).collect();
    let largest = vector.iter().max_by(|a, b| a.norm().total_cmp(&b.norm()))?;
    let length = vector.iter().map(|z| z.norm_sqr()).sum::<f64>().sqrt();
    let turn = largest.conj() / (largest.norm() * length);
    Some(vector.iter().map(|z| z * turn).collect())
}
