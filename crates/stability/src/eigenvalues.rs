//! Eigenvalues in double precision.

use crate::singular::singular;
use nalgebra::linalg::balancing::balance_parlett_reinsch;
use nalgebra::{DMatrix, DVector, Schur};

pub use nalgebra::Complex;

/// The eigenvalues of `E δz' = F δz`, E and F row by row, ascending by real and then by imaginary part; `None` where E is singular to
/// rounding or an entry is no number.
pub fn eigenvalues(left: &[Vec<f64>], right: &[Vec<f64>]) -> Option<Vec<Complex<f64>>> {
    as_known(left, right, &Known::default())
}

/// What is known exactly of eigenvalues that are computed.
#[derive(Clone, Debug, Default)]
pub struct Known {
    /// How many are zero.
    pub zeros: usize,
    /// Others that were enclosed, as often as they are eigenvalues.
    pub others: Vec<Complex<f64>>,
}

impl Known {
    /// Whether no eigenvalue of a system with so many variables is left to be computed.
    pub fn is_all_of(&self, variables: usize) -> bool {
        self.zeros + self.others.len() == variables
    }
}

/// The same where something is known exactly of them: zeros are so to the last digit, and of the others those nearest to known ones are these. An
/// eigenvalue of a chain of length k is computed to the k-th root of rounding alone.
pub fn as_known(left: &[Vec<f64>], right: &[Vec<f64>], known: &Known) -> Option<Vec<Complex<f64>>> {
    let zero = Complex::new(0.0, 0.0);
    let mut found = known.others.clone();
    if known.is_all_of(left.len()) {
        found.extend(vec![zero; known.zeros]);
    } else {
        let Balanced { matrix, unit, .. } = balanced(&matrix(left, right)?);
        let others = beside_zeros(&matrix, known.zeros)?;
        found.extend(vec![zero; matrix.nrows() - others.nrows()]);
        let mut others = spectrum(&(others * unit))?;
        for own in &known.others {
            let places = (0..others.len()).map(|at| (at, (others[at] - own).norm()));
            let nearest = places.min_by(|a, b| a.1.total_cmp(&b.1));
            nearest.map(|(at, _)| others.swap_remove(at));
        }
        found.extend(others);
    }
    found.sort_by(|a, b| a.re.total_cmp(&b.re).then(a.im.total_cmp(&b.im)));
    Some(found)
}

/// The zeros of a polynomial, the constant coefficient first: eigenvalues of its companion matrix. A leading coefficient zero leaves none.
pub fn zeros_of(coefficients: &[f64]) -> Option<Vec<Complex<f64>>> {
    let (leading, rest) = coefficients.split_last()?;
    let n = rest.len();
    let entry = |r: usize, c: usize| match (r, c) {
        (r, c) if c == n - 1 => -rest[r] / leading,
        (r, c) if r == c + 1 => 1.0,
        _ => 0.0,
    };
    let companion = DMatrix::from_fn(n, n, entry);
    let is_finite = companion.iter().all(|x| x.is_finite());
    let mut found = spectrum(&companion).filter(|_| is_finite)?;
    found.sort_by(|a, b| a.re.total_cmp(&b.re).then(a.im.total_cmp(&b.im)));
    Some(found)
}

/// A matrix on what is left beside so many of its zero eigenvalues: each has a left null vector, and what is orthogonal to that the matrix maps into
/// itself. So a zero is split off to rounding, where one of a chain of length k is computed to the k-th root of rounding.
pub fn beside_zeros(matrix: &DMatrix<f64>, zeros: usize) -> Option<DMatrix<f64>> {
    let mut own = matrix.clone();
    for _ in 0..zeros {
        let Some(count) = own.nrows().checked_sub(1) else {
            break;
        };
        let left = singular(&own)?.left;
        let range = left.columns(0, count);
        own = range.tr_mul(&(own * range));
    }
    Some(own)
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
    if matrix.is_empty() {
        return Some(Vec::new());
    }
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

/// An eigenvalue with modes that no input reaches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unreached {
    /// λ, its imaginary part zero or positive.
    pub eigenvalue: Complex<f64>,
    /// How many of its modes are not reached.
    pub count: usize,
    /// How many modes it has.
    pub modes: usize,
}

/// The eigenvalues of A, each once, at which the rank of `[λ − A, B]` is smaller than the number of rows to rounding: by as many dimensions the
/// inputs do not reach their modes (Hautus 1969).
pub fn unreached(a: &[Vec<f64>], b: &[Vec<f64>]) -> Option<Vec<Unreached>> {
    let n = a.len();
    let inputs = b.first().map_or(0, Vec::len);
    let a = DMatrix::from_row_iterator(n, n, a.iter().flatten().copied());
    let b = DMatrix::from_row_iterator(n, inputs, b.iter().flatten().copied());
    if n == 0 || !a.iter().chain(b.iter()).all(|x| x.is_finite()) {
        return None;
    }
    let own = balanced(&a);
    let size = Some(own.matrix.norm())
        .filter(|own| *own > 0.0)
        .unwrap_or(1.0);
    let mut b = DMatrix::from_fn(n, inputs, |r, c| b[(r, c)] / own.scale[r]);
    for mut column in b.column_iter_mut() {
        let length = column.norm();
        if length > 0.0 {
            column *= size / length;
        }
    }
    // By how much the rank of the first columns of [λ − A, B] is smaller than the number of rows.
    let lost = |l: &Complex<f64>, columns: usize| {
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
        let found = singular(&DMatrix::from_fn(n, columns, entry));
        // Filled up to a square, it has one more zero for each input.
        let values = found.map(|own| own.values).unwrap_or_default();
        values
            .iter()
            .take(n)
            .filter(|s| **s <= UNREACHED * size)
            .count()
    };
    let mut all = spectrum(&a)?;
    all.retain(|l| l.im >= 0.0 && lost(l, n + inputs) > 0);
    let all = distinct(&all, UNREACHED * size * own.unit).into_iter();
    let found = all.map(|(eigenvalue, _)| Unreached {
        eigenvalue,
        count: lost(&eigenvalue, n + inputs),
        modes: lost(&eigenvalue, n).max(1),
    });
    Some(found.collect())
}

/// Eigenvalues each once, with how many are the same to a distance; ascending.
pub fn distinct(all: &[Complex<f64>], distance: f64) -> Vec<(Complex<f64>, usize)> {
    let mut found: Vec<(Complex<f64>, usize)> = Vec::new();
    for own in all {
        match found
            .iter_mut()
            .find(|known| (known.0 - own).norm() <= distance)
        {
            Some(known) => known.1 += 1,
            None => found.push((*own, 1)),
        }
    }
    found.sort_by(|(a, _), (b, _)| a.re.total_cmp(&b.re).then(a.im.total_cmp(&b.im)));
    found
}

/// A distance from lower rank below this, in parts of the matrix, is rounding.
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

/// The modes of an eigenvalue, at most as many as its multiplicity: vectors z of length 1 for which `(λE − F) z` vanishes, to rounding in suitable
/// units of the variables, their largest entries real and positive. Of several each is zero where another one is largest.
pub fn modes(
    left: &[Vec<f64>],
    right: &[Vec<f64>],
    (eigenvalue, multiplicity): (Complex<f64>, usize),
) -> Option<Vec<Vec<Complex<f64>>>> {
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
    let found = singular(&DMatrix::from_fn(n, n, entry))?;
    let least = UNREACHED * matrix.norm();
    let vanishing = found.values.iter().filter(|s| **s <= least).count();
    let count = vanishing.clamp(1, multiplicity.max(1)).min(n);
    let mut basis = found.right.columns(n - count, count).into_owned();
    if count > 1 {
        separate(&mut basis);
    }
    let of = |column: usize| {
        let mut entries = basis.column(column).into_owned();
        // In other units what is rounding here may be large.
        let least = ROUNDED * entries.camax();
        for entry in entries.iter_mut().filter(|z| z.norm() < least) {
            *entry = Complex::new(0.0, 0.0);
        }
        let vector: Vec<Complex<f64>> = entries.iter().zip(&scale).map(|(z, d)| z * *d).collect();
        let largest = vector.iter().max_by(|a, b| a.norm().total_cmp(&b.norm()))?;
        let length = vector.iter().map(|z| z.norm_sqr()).sum::<f64>().sqrt();
        let turn = largest.conj() / (largest.norm() * length);
        Some(vector.iter().map(|z| z * turn).collect())
    };
    (0..count).map(of).collect()
}

/// An entry below this part of the largest is rounding.
const ROUNDED: f64 = 1e-13;

/// Another basis of the same space: each vector with a 1 where all others have a zero, in the order of these places.
fn separate(basis: &mut DMatrix<Complex<f64>>) {
    let (n, count) = basis.shape();
    let mut places: Vec<(usize, usize)> = Vec::new();
    for _ in 0..count {
        let is_free = |own: &(usize, usize)| places.iter().all(|p| p.0 != own.0 && p.1 != own.1);
        let entries = (0..n).flat_map(|r| (0..count).map(move |c| (r, c)));
        let size = |own: &(usize, usize)| basis[*own].norm();
        let Some(place) = entries
            .filter(is_free)
            .max_by(|a, b| size(a).total_cmp(&size(b)))
        else {
            return;
        };
        let pivot = basis[place];
        let own = basis.column(place.1) / pivot;
        for c in 0..count {
            let by = basis[(place.0, c)];
            let rest = if c == place.1 {
                own.clone()
            } else {
                basis.column(c) - &own * by
            };
            basis.set_column(c, &rest);
        }
        places.push(place);
    }
    places.sort_unstable();
    let order: Vec<usize> = places.iter().map(|own| own.1).collect();
    *basis = basis.select_columns(&order);
}
