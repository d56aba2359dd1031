//! Exact factorization and null space of small matrices of expressions.
//!
//! Entries are simplified as they arise, and whether a pivot vanishes identically is decided by the zero test, so a pivot
//! that only looks different from zero is not divided by. For large systems, where nothing may be expanded, there is
//! [`solve`](crate::Graph::solve), which keeps the system as a node.

use crate::linear::SolveError;
use crate::simplify::{length, simplify, simplify_all, Options};
use crate::zero::assumptions::Assumptions;
use crate::zero::{decide_zero, ZeroTest};
use crate::{Expr, Graph, Verdict};

/// `A = L D Lᵀ` with L unit lower triangular and D diagonal.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Ldlt {
    /// L, row by row, n × n, with ones on the diagonal and zeros above.
    pub lower: Vec<Vec<Expr>>,
    /// The diagonal of D.
    pub diagonal: Vec<Expr>,
}

/// Why a matrix has no such factorization, or none was found.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum MatrixError {
    /// The rows have different lengths, or their number does not fit.
    #[error("the entries do not form the matrix asked for")]
    Shape,
    /// A matrix that must be symmetric is not, or could not be shown to be.
    #[error("the matrix is not symmetric: entries ({row}, {column}) and ({column}, {row}) differ")]
    NotSymmetric {
        /// Row, from 0.
        row: usize,
        /// Column, from 0.
        column: usize,
    },
    /// A leading minor vanishes identically: there is no factorization without exchanges.
    #[error("the pivot {index} vanishes identically: the leading minor of size {} is singular", index + 1)]
    ZeroPivot {
        /// From 0.
        index: usize,
    },
    /// Whether an entry vanishes could not be decided.
    #[error("whether an entry of the elimination vanishes could not be decided: {why}")]
    Undecided {
        /// What was tried.
        why: String,
    },
}

/// Factors a symmetric matrix without exchanges (G. H. Golub, C. F. Van Loan, *Matrix Computations*, 4th ed., 2013, § 4.1.2).
///
/// # Errors
/// [`MatrixError`]; a symmetric matrix with a singular leading minor has no such factorization.
pub fn ldlt(g: &Graph, a: &[Vec<Expr>]) -> Result<Ldlt, MatrixError> {
    let n = a.len();
    if a.iter().any(|row| row.len() != n) {
        return Err(MatrixError::Shape);
    }
    for (row, entries) in a.iter().enumerate() {
        for (column, &entry) in entries.iter().enumerate().take(row) {
            if !vanishes(g, g.sub(entry, a[column][row]))? {
                return Err(MatrixError::NotSymmetric { row, column });
            }
        }
    }
    let mut lower = vec![vec![g.zero(); n]; n];
    let mut diagonal: Vec<Expr> = Vec::with_capacity(n);
    for j in 0..n {
        let of = |i: usize, lower: &[Vec<Expr>], diagonal: &[Expr]| {
            let mut parts = vec![a[i][j]];
            parts.extend((0..j).map(|k| g.neg(g.mul(&[lower[i][k], diagonal[k], lower[j][k]]))));
            readable(g, g.add(&parts))
        };
        let pivot = of(j, &lower, &diagonal);
        if vanishes(g, pivot)? {
            return Err(MatrixError::ZeroPivot { index: j });
        }
        lower[j][j] = g.one();
        for i in j + 1..n {
            lower[i][j] = readable(g, g.div(of(i, &lower, &diagonal), pivot));
        }
        diagonal.push(pivot);
    }
    Ok(Ldlt { lower, diagonal })
}

/// A basis of the vectors x with `A x = 0`, by reduction to echelon form; each has a one where all others have zero. Valid
/// where no pivot vanishes, which is almost everywhere.
///
/// # Errors
/// [`MatrixError::Shape`], [`MatrixError::Undecided`].
pub fn null_space(
    g: &Graph,
    a: &[Vec<Expr>],
    columns: usize,
) -> Result<Vec<Vec<Expr>>, MatrixError> {
    if a.iter().any(|row| row.len() != columns) {
        return Err(MatrixError::Shape);
    }
    let mut rows = a.to_vec();
    let mut pivots: Vec<usize> = Vec::new();
    for column in 0..columns {
        let from = pivots.len();
        let Some(found) = shortest_pivot(g, &rows, from, column)? else {
            continue;
        };
        rows.swap(from, found);
        let pivot = rows[from][column];
        for entry in &mut rows[from] {
            *entry = readable(g, g.div(*entry, pivot));
        }
        let pivot_row = rows[from].clone();
        for (i, row) in rows.iter_mut().enumerate() {
            let factor = row[column];
            if i == from || g.is_zero(factor) {
                continue;
            }
            for (entry, &above) in row.iter_mut().zip(&pivot_row) {
                *entry = readable(g, g.sub(*entry, g.mul(&[factor, above])));
            }
        }
        pivots.push(column);
    }
    let free = (0..columns).filter(|column| !pivots.contains(column));
    Ok(free
        .map(|column| {
            let mut vector = vec![g.zero(); columns];
            vector[column] = g.one();
            for (row, &pivot) in rows.iter().zip(&pivots) {
                vector[pivot] = g.neg(row[column]);
            }
            vector
        })
        .collect())
}

/// The row, from `from` on, with the shortest entry in the column that does not vanish identically.
fn shortest_pivot(
    g: &Graph,
    rows: &[Vec<Expr>],
    from: usize,
    column: usize,
) -> Result<Option<usize>, MatrixError> {
    let mut candidates: Vec<usize> = (from..rows.len()).collect();
    candidates.sort_by_key(|&i| g.reachable(&[rows[i][column]]).len());
    for i in candidates {
        if !vanishes(g, rows[i][column])? {
            return Ok(Some(i));
        }
    }
    Ok(None)
}

fn readable(g: &Graph, e: Expr) -> Expr {
    simplify(g, e, &Options::default())
}

fn vanishes(g: &Graph, e: Expr) -> Result<bool, MatrixError> {
    if g.is_zero(e) || g.as_number(e).is_some() {
        return Ok(g.is_zero(e));
    }
    match decide_zero(g, &ZeroTest::everywhere(&[e], &Assumptions::new())) {
        Verdict::Proved(_) => Ok(true),
        Verdict::Refuted(_) => Ok(false),
        other => Err(MatrixError::Undecided {
            why: other.detail().to_owned(),
        }),
    }
}

/// The determinant of a square matrix by cofactors along the rows, each minor formed once: 2ⁿ of them, so for small n only.
pub fn determinant(g: &Graph, matrix: &[Vec<Expr>]) -> Expr {
    let n = matrix.len();
    // The minor of the last rows in the columns of a bit set; as many rows as columns.
    let mut minors = vec![g.one(); 1 << n];
    for columns in 1..1_usize << n {
        let row = n - columns.count_ones() as usize;
        let mut terms = Vec::new();
        for (position, column) in (0..n).filter(|c| columns >> c & 1 == 1).enumerate() {
            let minor = minors[columns & !(1 << column)];
            let term = g.mul(&[matrix[row][column], minor]);
            terms.push(if position % 2 == 0 { term } else { g.neg(term) });
        }
        minors[columns] = g.add(&terms);
    }
    minors[(1 << n) - 1]
}

/// Matrices of more rows are not inverted in closed form.
const LARGEST_CLOSED: usize = 6;
/// Longest determinant, and longest entry, of an inverse in closed form.
const LONGEST_CLOSED: u64 = 120;

/// The inverse of a square matrix: by cofactors where the determinant and the entries are short, as those of a rotation
/// are, else by linear solves.
///
/// # Errors
/// A matrix that is singular by its form.
pub fn inverse(g: &Graph, matrix: &[Vec<Expr>]) -> Result<Vec<Vec<Expr>>, SolveError> {
    let n = matrix.len();
    if let Some(closed) = (n <= LARGEST_CLOSED)
        .then(|| cofactors(g, matrix))
        .flatten()
    {
        return Ok(closed);
    }
    let flat = matrix.concat();
    let mut rows = vec![vec![g.zero(); n]; n];
    for u in 0..n {
        let mut unit = vec![g.zero(); n];
        unit[u] = g.one();
        for (s, entry) in g.solve(&flat, &unit)?.into_iter().enumerate() {
            rows[s][u] = entry;
        }
    }
    Ok(rows)
}

/// The inverse by cofactors; `None` where it is long, or the determinant vanishes by its form.
fn cofactors(g: &Graph, matrix: &[Vec<Expr>]) -> Option<Vec<Vec<Expr>>> {
    let n = matrix.len();
    let options = Options::default();
    let whole = simplify(g, determinant(g, matrix), &options);
    if g.is_zero(whole) || length(g, whole) > LONGEST_CLOSED {
        return None;
    }
    let minor = |row: usize, column: usize| -> Vec<Vec<Expr>> {
        let rows = matrix.iter().enumerate().filter(|(i, _)| *i != row);
        let kept = |line: &Vec<Expr>| [&line[..column], &line[column + 1..]].concat();
        rows.map(|(_, line)| kept(line)).collect()
    };
    let entry = |s: usize, u: usize| {
        let cofactor = determinant(g, &minor(u, s));
        let signed = if (s + u).is_multiple_of(2) {
            cofactor
        } else {
            g.neg(cofactor)
        };
        g.div(signed, whole)
    };
    let entries: Vec<Expr> = (0..n * n)
        .map(|place| entry(place / n, place % n))
        .collect();
    let simple = simplify_all(g, &entries, &options);
    let short = simple.iter().all(|&e| length(g, e) <= LONGEST_CLOSED);
    short.then(|| simple.chunks(n.max(1)).map(<[Expr]>::to_vec).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::polynomial::normal_form::tests::read;

    fn matrix(g: &Graph, rows: &[&[&str]]) -> Vec<Vec<Expr>> {
        rows.iter()
            .map(|row| row.iter().map(|text| read(g, text)).collect())
            .collect()
    }

    fn assert_zero(g: &Graph, e: Expr) {
        assert!(vanishes(g, e).unwrap(), "{}", g.text(e));
    }

    fn product(g: &Graph, f: &Ldlt, i: usize, j: usize) -> Expr {
        let parts: Vec<Expr> = (0..f.diagonal.len())
            .map(|k| g.mul(&[f.lower[i][k], f.diagonal[k], f.lower[j][k]]))
            .collect();
        g.add(&parts)
    }

    #[test]
    fn a_mass_matrix_is_its_factors_again() {
        let g = Graph::new();
        let a = matrix(
            &g,
            &[
                &["m + M", "m*l*cos(theta)", "0"],
                &["m*l*cos(theta)", "m*l^2 + J", "J"],
                &["0", "J", "J"],
            ],
        );
        let factors = ldlt(&g, &a).unwrap();
        for (i, row) in a.iter().enumerate() {
            for (j, &entry) in row.iter().enumerate() {
                assert_zero(&g, g.sub(entry, product(&g, &factors, i, j)));
            }
        }
        let expected = read(&g, "m*l^2 + J - m^2*l^2*cos(theta)^2/(m + M)");
        assert_zero(&g, g.sub(factors.diagonal[1], expected));
    }

    /// Pivots of the Hilbert matrix: det H_k / det H_(k-1) = 1, 1/12, 1/180, 1/2800 (D. Hilbert 1894).
    #[test]
    fn pivots_of_the_hilbert_matrix() {
        let g = Graph::new();
        let entry = |i: usize, j: usize| g.div(g.one(), g.integer((i + j + 1) as i64));
        let a: Vec<Vec<Expr>> = (0..4)
            .map(|i| (0..4).map(|j| entry(i, j)).collect())
            .collect();
        let pivots = ldlt(&g, &a).unwrap().diagonal;
        let expected: Vec<Expr> = [1, 12, 180, 2800]
            .iter()
            .map(|&n| g.div(g.one(), g.integer(n)))
            .collect();
        assert_eq!(pivots, expected);
    }

    #[test]
    fn a_pivot_that_vanishes_in_disguise_is_named() {
        let g = Graph::new();
        let a = matrix(&g, &[&["sin(x)^2 + cos(x)^2 - 1", "1"], &["1", "2"]]);
        assert_eq!(ldlt(&g, &a), Err(MatrixError::ZeroPivot { index: 0 }));
        let a = matrix(&g, &[&["1", "x"], &["y", "2"]]);
        assert_eq!(
            ldlt(&g, &a),
            Err(MatrixError::NotSymmetric { row: 1, column: 0 })
        );
        assert_eq!(ldlt(&g, &[vec![g.one()], vec![]]), Err(MatrixError::Shape));
    }

    #[test]
    fn null_space_of_rolling_constraints() {
        let g = Graph::new();
        // Rolling disc: x' = R cos(phi) theta', y' = R sin(phi) theta'; and their redundant combination.
        let a = matrix(
            &g,
            &[
                &["1", "0", "-R*cos(phi)", "0"],
                &["0", "1", "-R*sin(phi)", "0"],
                &["cos(phi)", "sin(phi)", "-R", "0"],
            ],
        );
        let basis = null_space(&g, &a, 4).unwrap();
        assert_eq!(basis.len(), 2);
        for vector in &basis {
            for row in &a {
                let parts: Vec<Expr> = row
                    .iter()
                    .zip(vector)
                    .map(|(&a, &x)| g.mul(&[a, x]))
                    .collect();
                assert_zero(&g, g.add(&parts));
            }
        }
        assert_eq!(null_space(&g, &[], 2).unwrap().len(), 2);
        let regular = matrix(&g, &[&["cos(x)", "-sin(x)"], &["sin(x)", "cos(x)"]]);
        assert!(null_space(&g, &regular, 2).unwrap().is_empty());
    }

    /// Vandermonde's determinant is the product of the differences.
    #[test]
    fn determinants_of_vandermonde() {
        let g = Graph::new();
        let rows: Vec<Vec<Expr>> = ["a", "b", "c", "d"]
            .iter()
            .map(|name| {
                let x = g.symbol(name, 0);
                (0..4).map(|power| g.powi(x, power)).collect()
            })
            .collect();
        let product = read(&g, "(b - a) (c - a) (d - a) (c - b) (d - b) (d - c)");
        assert_zero(&g, g.sub(determinant(&g, &rows), product));
        assert_eq!(determinant(&g, &[]), g.one());
    }

    #[test]
    fn the_inverse_of_a_rotation_is_written_out() {
        let g = Graph::new();
        let m = matrix(
            &g,
            &[
                &["sin(psi)/sin(theta)", "cos(psi)/sin(theta)", "0"],
                &["cos(psi)", "-sin(psi)", "0"],
                &[
                    "-cos(theta) sin(psi)/sin(theta)",
                    "-cos(theta) cos(psi)/sin(theta)",
                    "1",
                ],
            ],
        );
        let expected = matrix(
            &g,
            &[
                &["sin(theta) sin(psi)", "cos(psi)", "0"],
                &["sin(theta) cos(psi)", "-sin(psi)", "0"],
                &["cos(theta)", "0", "1"],
            ],
        );
        assert_eq!(inverse(&g, &m).unwrap(), expected);
    }

    #[test]
    fn an_inverse_times_its_matrix_is_one() {
        let g = Graph::new();
        for rows in [
            vec![vec!["a", "b"], vec!["c", "d"]],
            vec![
                vec!["1", "x", "0"],
                vec!["0", "1", "y"],
                vec!["z", "0", "1"],
            ],
            vec![
                vec!["exp(t)", "1"],
                vec!["1", "x + y + z + sqrt(1 + x^2) cos(y)"],
            ],
        ] {
            let rows: Vec<&[&str]> = rows.iter().map(|row| &row[..]).collect();
            let m = matrix(&g, &rows);
            let inverse = inverse(&g, &m).unwrap();
            for (i, row) in inverse.iter().enumerate() {
                for j in 0..m.len() {
                    let parts: Vec<Expr> =
                        (0..m.len()).map(|k| g.mul(&[row[k], m[k][j]])).collect();
                    let unit = if i == j { g.one() } else { g.zero() };
                    assert_zero(&g, g.sub(g.add(&parts), unit));
                }
            }
        }
        let singular = matrix(&g, &[&["x", "y"], &["0", "0"]]);
        assert!(inverse(&g, &singular).is_err());
    }
}
