//! Dense linear algebra over a prime field: one factorization serves every right-hand side.

use super::prime_field::{PrimeField, Residue};
use crate::meter;

/// The factors P A = L U of a nonsingular square matrix.
#[derive(Clone, Debug)]
pub struct Factorization {
    size: usize,
    /// L below the diagonal (its ones are not stored), U above it; row-major, rows permuted.
    factors: Vec<Residue>,
    /// Reciprocals of the pivots.
    pivots: Vec<Residue>,
    /// Row i of the factors is row `permutation[i]` of A.
    permutation: Vec<usize>,
}

/// Factorizes the row-major `size` × `size` matrix; `None` if it is singular.
pub fn factorize(
    field: &PrimeField,
    size: usize,
    mut matrix: Vec<Residue>,
) -> Option<Factorization> {
    if matrix.len() != size * size {
        return None;
    }
    let mut permutation: Vec<usize> = (0..size).collect();
    let mut pivots = Vec::with_capacity(size);
    for column in 0..size {
        let pivot = (column..size).find(|&row| !matrix[row * size + column].is_zero())?;
        swap_rows(&mut matrix, size, pivot, column);
        permutation.swap(pivot, column);
        let reciprocal = field.inv(matrix[column * size + column])?;
        pivots.push(reciprocal);
        eliminate(field, &mut matrix, size, column, column, reciprocal);
    }
    Some(Factorization {
        size,
        factors: matrix,
        pivots,
        permutation,
    })
}

impl Factorization {
    /// The solution of A x = b; `b` has as many entries as A has rows.
    pub fn solve(&self, field: &PrimeField, rhs: &[Residue]) -> Vec<Residue> {
        let n = self.size;
        let mut x: Vec<Residue> = self.permutation.iter().map(|&row| rhs[row]).collect();
        for row in 0..n {
            for column in 0..row {
                x[row] = field.sub(x[row], field.mul(self.factors[row * n + column], x[column]));
            }
        }
        for row in (0..n).rev() {
            for column in row + 1..n {
                x[row] = field.sub(x[row], field.mul(self.factors[row * n + column], x[column]));
            }
            x[row] = field.mul(x[row], self.pivots[row]);
        }
        x
    }
}

/// The rank of a row-major `rows` × `columns` matrix.
pub fn rank(field: &PrimeField, rows: usize, columns: usize, matrix: &[Residue]) -> usize {
    let mut work = matrix.to_vec();
    let mut rank = 0;
    for column in 0..columns {
        let Some(pivot) = (rank..rows).find(|&row| !work[row * columns + column].is_zero()) else {
            continue;
        };
        swap_rows(&mut work, columns, pivot, rank);
        let Some(reciprocal) = field.inv(work[rank * columns + column]) else {
            continue;
        };
        eliminate(field, &mut work, columns, rank, column, reciprocal);
        rank += 1;
    }
    rank
}

/// The determinant of the row-major `size` × `size` matrix.
pub fn determinant(field: &PrimeField, size: usize, mut matrix: Vec<Residue>) -> Residue {
    let mut product = field.one();
    for column in 0..size {
        let found = (column..size).find(|&row| !matrix[row * size + column].is_zero());
        let pivot = found.map(|row| (row, matrix[row * size + column]));
        let reciprocal = pivot.and_then(|(_, entry)| field.inv(entry));
        let (Some((row, entry)), Some(reciprocal)) = (pivot, reciprocal) else {
            return Residue::ZERO;
        };
        product = field.mul(product, entry);
        if row != column {
            product = field.neg(product);
        }
        swap_rows(&mut matrix, size, row, column);
        eliminate(field, &mut matrix, size, column, column, reciprocal);
    }
    product
}

/// The null space of a matrix in the echelon form that is unique: each vector belongs to a column that depends on those to
/// its left, has a one there and its other entries at columns that do not.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NullSpace {
    /// Columns that do not depend on those to their left, ascending.
    pub pivots: Vec<usize>,
    /// For each other column, ascending: the column, and the entries at the pivots to its left that are not zero.
    pub vectors: Vec<(usize, Vec<(usize, Residue)>)>,
}

impl NullSpace {
    /// Whether some of the columns depend on each other: columns that are no pivots are combinations of pivots, and a combination of those
    /// among them must need no pivot outside.
    pub fn depends_within(&self, field: &PrimeField, is_inside: impl Fn(usize) -> bool) -> bool {
        let own = self.vectors.iter().filter(|(column, _)| is_inside(*column));
        let own: Vec<&Vec<(usize, Residue)>> = own.map(|(_, entries)| entries).collect();
        let entry = |entries: &[(usize, Residue)], pivot: usize| {
            let found = entries.iter().find(|(column, _)| *column == pivot);
            found.map_or(Residue::ZERO, |&(_, value)| value)
        };
        let outside = self.pivots.iter().filter(|&&pivot| !is_inside(pivot));
        let rows = outside.flat_map(|&pivot| own.iter().map(move |own| entry(own, pivot)));
        let rows = rows.collect();
        !null_space(field, own.len(), rows).vectors.is_empty()
    }
}

/// Rows in echelon form, in the order of their first columns, each with a one there.
struct Echelon {
    columns: usize,
    pivots: Vec<usize>,
    rows: Vec<Vec<Residue>>,
}

impl Echelon {
    /// Adds what a row has that the others do not span. Of four rows at a time the multiples are found in the columns of their pivots, so
    /// that the other entries take one reduction for four products.
    fn insert(&mut self, field: &PrimeField, mut row: Vec<Residue>) {
        for (pivots, rows) in self.pivots.chunks(4).zip(self.rows.chunks(4)) {
            let mut factors = [Residue::ZERO; 4];
            for (k, &pivot) in pivots.iter().enumerate() {
                let known = factors[..k].iter().zip(rows);
                let terms = known.map(|(&factor, own)| field.mul(factor, own[pivot]));
                let value = terms.fold(row[pivot], |sum, term| field.add(sum, term));
                factors[k] = field.neg(value);
            }
            if factors.iter().all(|factor| factor.is_zero()) {
                continue;
            }
            let first = pivots[0];
            meter::spend(2 * (self.columns - first) as u64);
            let target = &mut row[first..];
            if let [a, b, c, d] = rows {
                let (a, b) = (&a[first..], &b[first..]);
                let (c, d) = (&c[first..], &d[first..]);
                for ((((x, &a), &b), &c), &d) in target.iter_mut().zip(a).zip(b).zip(c).zip(d) {
                    *x = field.add(*x, field.sum_of_products(factors, [a, b, c, d]));
                }
            } else {
                for (&factor, own) in factors.iter().zip(rows) {
                    for (x, &own) in target.iter_mut().zip(&own[first..]) {
                        *x = field.add(*x, field.mul(factor, own));
                    }
                }
            }
        }
        let Some(pivot) = (0..self.columns).find(|&column| !row[column].is_zero()) else {
            return;
        };
        let Some(reciprocal) = field.inv(row[pivot]) else {
            return;
        };
        for entry in &mut row[pivot..] {
            *entry = field.mul(*entry, reciprocal);
        }
        let place = self.pivots.partition_point(|&other| other < pivot);
        self.pivots.insert(place, pivot);
        self.rows.insert(place, row);
    }
}

/// The null space of a row-major matrix with `columns` columns, of which columns to the left are preferred as pivots: the first columns of
/// rows in echelon form are the same whatever the order of the rows.
pub fn null_space(field: &PrimeField, columns: usize, matrix: Vec<Residue>) -> NullSpace {
    let mut echelon = Echelon {
        columns,
        pivots: Vec::new(),
        rows: Vec::new(),
    };
    for row in matrix.chunks_exact(columns.max(1)) {
        if echelon.pivots.len() == columns {
            break;
        }
        echelon.insert(field, row.to_vec());
    }
    let Echelon { pivots, rows, .. } = echelon;
    let mut is_pivot = vec![false; columns];
    pivots.iter().for_each(|&column| is_pivot[column] = true);
    let vectors = (0..columns)
        .filter(|&column| !is_pivot[column])
        .map(|column| (column, back_substituted(field, &rows, &pivots, column)))
        .collect();
    NullSpace { pivots, vectors }
}

/// The vector with a one at `free` that rows in echelon form annul.
fn back_substituted(
    field: &PrimeField,
    rows: &[Vec<Residue>],
    pivots: &[usize],
    free: usize,
) -> Vec<(usize, Residue)> {
    let mut known: Vec<(usize, Residue)> = vec![(free, field.one())];
    for (row, &pivot) in rows.iter().zip(pivots).rev() {
        if pivot > free {
            continue;
        }
        let sum = known.iter().fold(Residue::ZERO, |sum, &(column, x)| {
            field.add(sum, field.mul(row[column], x))
        });
        if !sum.is_zero() {
            known.push((pivot, field.neg(sum)));
        }
    }
    known.remove(0);
    known.reverse();
    known
}

/// Clears `column` below `row`, leaving the multipliers in its place.
fn eliminate(
    field: &PrimeField,
    matrix: &mut [Residue],
    width: usize,
    row: usize,
    column: usize,
    reciprocal: Residue,
) {
    let (above, below) = matrix.split_at_mut((row + 1) * width);
    let pivot_row = &above[row * width..];
    for target in below.chunks_exact_mut(width) {
        if target[column].is_zero() {
            continue;
        }
        let factor = field.mul(target[column], reciprocal);
        target[column] = factor;
        meter::spend((width - column) as u64);
        for (entry, &pivot_entry) in target[column + 1..]
            .iter_mut()
            .zip(&pivot_row[column + 1..])
        {
            *entry = field.sub(*entry, field.mul(factor, pivot_entry));
        }
    }
}

fn swap_rows(matrix: &mut [Residue], width: usize, a: usize, b: usize) {
    if a != b {
        let (low, high) = (a.min(b), a.max(b));
        let (first, second) = matrix.split_at_mut(high * width);
        first[low * width..(low + 1) * width].swap_with_slice(&mut second[..width]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::random::Random;

    fn field() -> PrimeField {
        PrimeField::new((1 << 61) - 1).unwrap()
    }

    fn random_matrix(field: &PrimeField, entries: usize, seed: u64) -> Vec<Residue> {
        let mut random = Random::new(seed);
        (0..entries).map(|_| field.random(&mut random)).collect()
    }

    /// Rows in any order, more of them than the rank, and ranks that are no multiples of the rows taken at a time.
    #[test]
    fn null_spaces_do_not_depend_on_the_order_of_rows() {
        let (field, rows, columns) = (field(), 40, 24);
        for inner in [1, 4, 7, 13, 24] {
            let a = random_matrix(&field, rows * inner, 5);
            let b = random_matrix(&field, inner * columns, 6);
            let entry = |row: usize, column: usize| {
                let terms =
                    (0..inner).map(|k| field.mul(a[row * inner + k], b[k * columns + column]));
                terms.fold(Residue::ZERO, |sum, term| field.add(sum, term))
            };
            let row = |row: usize| (0..columns).map(move |column| entry(row, column));
            let space = null_space(&field, columns, (0..rows).flat_map(row).collect());
            let reversed = (0..rows).rev().flat_map(row).collect();
            assert_eq!(space, null_space(&field, columns, reversed));
            assert_eq!(space.pivots, (0..inner).collect::<Vec<usize>>());
            assert_eq!(space.vectors.len(), columns - inner);
            for (free, entries) in &space.vectors {
                for i in 0..rows {
                    let terms = entries.iter().map(|&(j, x)| field.mul(entry(i, j), x));
                    let sum = terms.fold(entry(i, *free), |sum, term| field.add(sum, term));
                    assert!(sum.is_zero(), "rank {inner}, column {free}");
                }
            }
        }
    }

    /// Every set of columns of a matrix of rank 4 against the elimination of these alone.
    #[test]
    fn sets_of_columns_depend_on_each_other() {
        let (field, rows, columns) = (field(), 12, 8);
        let a = random_matrix(&field, rows * 4, 3);
        // Columns 2 and 5 are combinations of 0 and 1, column 6 is column 3, column 7 is any.
        let (zero, one) = (Residue::ZERO, field.one());
        let two = field.from_u64(2);
        let of = [
            [one, zero, zero, zero],
            [zero, one, zero, zero],
            [one, two, zero, zero],
            [zero, zero, one, zero],
            [zero, zero, zero, one],
            [two, one, zero, zero],
            [zero, zero, one, zero],
            [two, one, one, two],
        ];
        let entry = |row: usize, column: usize| {
            let terms = (0..4).map(|k| field.mul(a[row * 4 + k], of[column][k]));
            terms.fold(Residue::ZERO, |sum, term| field.add(sum, term))
        };
        let part = |set: &[usize]| -> Vec<Residue> {
            let row = |row| set.iter().map(move |&column| entry(row, column));
            (0..rows).flat_map(row).collect()
        };
        let all = null_space(&field, columns, part(&[0, 1, 2, 3, 4, 5, 6, 7]));
        for chosen in 0..1_usize << columns {
            let is_inside = |column: usize| chosen >> column & 1 == 1;
            let set: Vec<usize> = (0..columns).filter(|&c| is_inside(c)).collect();
            let alone = null_space(&field, set.len(), part(&set));
            let depends = all.depends_within(&field, is_inside);
            assert_eq!(depends, !alone.vectors.is_empty(), "{set:?}");
        }
    }

    #[test]
    fn solutions_satisfy_their_equations() {
        let field = field();
        for size in [1, 2, 5, 40, 200] {
            let mut matrix = random_matrix(&field, size * size, size as u64);
            matrix[0] = Residue::ZERO; // forces a row exchange
            if size == 1 {
                matrix[0] = field.from_u64(7);
            }
            let rhs = random_matrix(&field, size, 99);
            let solution = factorize(&field, size, matrix.clone())
                .unwrap()
                .solve(&field, &rhs);
            for row in 0..size {
                let sum = (0..size).fold(Residue::ZERO, |sum, column| {
                    field.add(
                        sum,
                        field.mul(matrix[row * size + column], solution[column]),
                    )
                });
                assert_eq!(sum, rhs[row]);
            }
        }
    }

    #[test]
    fn singular_matrices_are_refused_and_ranks_counted() {
        let field = field();
        let entries: Vec<Residue> = [1, 2, 3, 4, 5, 6, 7, 8, 9]
            .iter()
            .map(|&n| field.from_u64(n))
            .collect();
        assert!(factorize(&field, 3, entries.clone()).is_none());
        assert_eq!(rank(&field, 3, 3, &entries), 2);
        assert_eq!(rank(&field, 2, 3, &entries[..6]), 2);
        assert_eq!(rank(&field, 3, 3, &[Residue::ZERO; 9]), 0);
        assert!(
            factorize(&field, 2, vec![Residue::ZERO; 3]).is_none(),
            "not square"
        );
    }

    #[test]
    fn determinants_count_row_exchanges() {
        let field = field();
        let of = |size: usize, entries: &[i64]| {
            let matrix = entries.iter().map(|&n| field.from_i64(n)).collect();
            determinant(&field, size, matrix)
        };
        assert_eq!(of(2, &[0, 2, 3, 5]), field.from_i64(-6));
        assert_eq!(of(3, &[2, 0, 1, 1, 3, -1, 0, 5, 4]), field.from_i64(39));
        assert_eq!(of(2, &[1, 2, 2, 4]), Residue::ZERO);
    }

    #[test]
    fn null_vectors_belong_to_dependent_columns_and_use_pivots_to_their_left() {
        let field = field();
        // Columns a, 2a, b, a + 3b, c with a = (1, 1, 0, 2), b = (0, 1, 5, 1), c = (0, 0, 1, 1).
        let rows = [
            [1, 2, 0, 1, 0],
            [1, 2, 1, 4, 0],
            [0, 0, 5, 15, 1],
            [2, 4, 1, 5, 1],
        ];
        let matrix = rows.concat().iter().map(|&n| field.from_u64(n)).collect();
        let found = null_space(&field, 5, matrix);
        let number = |n| field.from_i64(n);
        assert_eq!(found.pivots, [0, 2, 4]);
        assert_eq!(
            found.vectors,
            [
                (1, vec![(0, number(-2))]),
                (3, vec![(0, number(-1)), (2, number(-3))]),
            ]
        );
    }

    #[test]
    fn rank_of_a_product_of_thin_matrices() {
        let field = field();
        let (left, right) = (
            random_matrix(&field, 8 * 3, 1),
            random_matrix(&field, 3 * 6, 2),
        );
        let mut product = Vec::new();
        for row in 0..8 {
            for column in 0..6 {
                product.push((0..3).fold(Residue::ZERO, |sum, k| {
                    field.add(sum, field.mul(left[row * 3 + k], right[k * 6 + column]))
                }));
            }
        }
        assert_eq!(rank(&field, 8, 6, &product), 3);
    }
}
