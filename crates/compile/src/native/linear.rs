//! Linear systems, written out up to measured sizes, L D Lᵀ and pivoted L U, and by calls beyond.
//!
//! Where a pivot leaves a doubt, the state is marked as failed; the interpreter then evaluates it, pivots, and
//! reports what there is to report. The quick path stays short, and failures are the interpreter's own.

use super::assembler::{Float, Predicate};
use super::call::Helper;
use super::code::{Builder, Value};
use super::dense;
use crate::frames::Pivots;
use crate::program::{Factorization, Matrix};

/// Up to this size L D Lᵀ is written out. Measured with dense matrices on a machine with other work, written out
/// against called: 0.07 and 0.4 µs at size 8, 0.7 and 1.6 at 20, 2.7 to 3.9 and 4.2 at 32, 5.1 to 8.7 and 7.5 at 40, where
/// the code has 168 kB.
pub(crate) const UNROLLED: usize = 32;

/// Up to this size L U is written out; rows are exchanged by selecting, so its length grows quickly. Measured, written
/// out against called: 20 and 83 ns at size 2, 145 and 246 at 7, 232 and 300 at 8, 353 and 364 at 9, 476 and 441 at 10.
pub(crate) const UNROLLED_WITH_PIVOTS: usize = 8;

/// A factorized matrix, as code sees it.
#[derive(Clone, Debug)]
pub(crate) enum Factored {
    /// L below the diagonal, row by row, and the reciprocals of the pivots.
    Unrolled {
        size: usize,
        lower: Vec<Value>,
        reciprocals: Vec<Value>,
    },
    /// L below the diagonal and U above it, as rows, and the reciprocals of the pivots.
    Exchanged {
        rows: Vec<Vec<Value>>,
        reciprocals: Vec<Value>,
        exchanges: Vec<Exchange>,
    },
    /// In cells of the frame.
    Called { size: usize, cells: i32 },
}

/// Two rows that are exchanged where the mask says so.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Exchange {
    upper: usize,
    lower: usize,
    mask: Value,
}

impl Exchange {
    /// The entries of the two rows after the exchange.
    fn apply(&self, b: &mut Builder, upper: Value, lower: Value) -> (Value, Value) {
        if upper == lower || (b.is_zero(upper) && b.is_zero(lower)) {
            return (upper, lower);
        }
        let new_upper = b.blend(upper, lower, self.mask);
        (new_upper, b.blend(lower, upper, self.mask))
    }
}

/// Factorizes a matrix with these entries.
pub(crate) fn factor(b: &mut Builder, matrix: &Matrix, entries: &[Value]) -> (Factored, Pivots) {
    let size = matrix.size;
    if matrix.factorization == Factorization::Ldlt && size <= UNROLLED {
        return unrolled(b, size, entries);
    }
    if matrix.factorization == Factorization::Lu && size <= UNROLLED_WITH_PIVOTS {
        return exchanged(b, size, entries);
    }
    let cells = b.unknown_cells(dense::cells(size));
    for (i, &entry) in entries.iter().enumerate() {
        let index = i / size * dense::stride(size) + i % size;
        b.store(entry, b.cell(cells, index));
    }
    let helper = Helper::Factor {
        size: size as u16,
        factorization: matrix.factorization,
    };
    b.push(super::code::Op::Call { helper, cells });
    let pivots = Pivots {
        cells: b.cell(cells, size * dense::stride(size)).offset,
        size,
    };
    (Factored::Called { size, cells }, pivots)
}

/// The position of the entry (i, j), i > j, among those below the diagonal.
fn below(i: usize, j: usize) -> usize {
    i * (i - 1) / 2 + j
}

/// A = L D Lᵀ, row by row; entries that are zero in every state take no part.
fn unrolled(b: &mut Builder, size: usize, entries: &[Value]) -> (Factored, Pivots) {
    let zero = b.constant(0.0);
    let one = b.constant(1.0);
    let mut lower: Vec<Value> = Vec::with_capacity(size * size / 2);
    let mut reciprocals: Vec<Value> = Vec::with_capacity(size);
    let mut pivots: Vec<Value> = Vec::with_capacity(size);
    let stored = b.unknown_cells(size);
    for i in 0..size {
        // The row of D Lᵀ transposed: what is left of the entries before the division by the pivots.
        let mut scaled: Vec<Value> = Vec::with_capacity(i);
        for j in 0..i {
            let factors = (0..j).map(|k| (scaled[k], lower[below(j, k)]));
            let entry = subtract_products(b, entries[i * size + j], factors);
            scaled.push(entry);
        }
        let row: Vec<Value> = (0..i)
            .map(|j| {
                if b.is_zero(scaled[j]) {
                    zero
                } else {
                    b.mul(scaled[j], reciprocals[j])
                }
            })
            .collect();
        let factors = (0..i).map(|k| (scaled[k], row[k]));
        let pivot = subtract_products(b, entries[i * size + i], factors);
        b.store(pivot, b.cell(stored, i));
        pivots.push(pivot);
        reciprocals.push(b.float(Float::Div, one, pivot));
        lower.extend(row);
    }
    check(b, &pivots, dense::NEGLIGIBLE * size as f64);
    let factored = Factored::Unrolled {
        size,
        lower,
        reciprocals,
    };
    (
        factored,
        Pivots {
            cells: stored,
            size,
        },
    )
}

/// P A = L U. Each row below takes the place of the pivot's if its entry is larger, so the largest ends up there.
fn exchanged(b: &mut Builder, size: usize, entries: &[Value]) -> (Factored, Pivots) {
    let one = b.constant(1.0);
    let stored = b.unknown_cells(size);
    let mut rows: Vec<Vec<Value>> = entries.chunks(size).map(<[Value]>::to_vec).collect();
    let mut exchanges = Vec::new();
    let mut reciprocals = Vec::with_capacity(size);
    let mut magnitudes = Vec::with_capacity(size);
    for k in 0..size {
        for i in k + 1..size {
            if !b.is_zero(rows[i][k]) {
                exchanges.push(exchange(b, &mut rows, k, i));
            }
        }
        let pivot = rows[k][k];
        b.store(pivot, b.cell(stored, k));
        magnitudes.push(b.abs(pivot));
        let reciprocal = b.float(Float::Div, one, pivot);
        reciprocals.push(reciprocal);
        let (done, below) = rows.split_at_mut(k + 1);
        for row in below {
            if b.is_zero(row[k]) {
                continue;
            }
            row[k] = b.mul(row[k], reciprocal);
            for j in k + 1..size {
                row[j] = subtract_products(b, row[j], std::iter::once((row[k], done[k][j])));
            }
        }
    }
    check(b, &magnitudes, dense::UNSUSPICIOUS);
    let factored = Factored::Exchanged {
        rows,
        reciprocals,
        exchanges,
    };
    let pivots = Pivots {
        cells: stored,
        size,
    };
    (factored, pivots)
}

/// Exchanges rows k and i where the entry of row i in column k is larger.
fn exchange(b: &mut Builder, rows: &mut [Vec<Value>], k: usize, i: usize) -> Exchange {
    let (upper, lower) = (b.abs(rows[k][k]), b.abs(rows[i][k]));
    let exchange = Exchange {
        upper: k,
        lower: i,
        mask: b.compare(Predicate::Less, upper, lower),
    };
    let (above, below) = rows.split_at_mut(i);
    for (upper, lower) in above[k].iter_mut().zip(&mut below[0]) {
        (*upper, *lower) = exchange.apply(b, *upper, *lower);
    }
    exchange
}

/// `start − Σ a b`, without the products that are zero.
fn subtract_products(
    b: &mut Builder,
    start: Value,
    products: impl Iterator<Item = (Value, Value)>,
) -> Value {
    let mut sum = start;
    for (x, y) in products {
        if !b.is_zero(x) && !b.is_zero(y) {
            sum = b.neg_mul_add(x, y, sum);
        }
    }
    sum
}

/// Marks states in which a pivot is not well above zero: `threshold` times the sum, which is not a number, or
/// infinite, if a pivot is.
fn check(b: &mut Builder, pivots: &[Value], threshold: f64) {
    let threshold = b.constant(threshold);
    let (mut least, mut sum) = (pivots[0], pivots[0]);
    for &pivot in &pivots[1..] {
        least = b.float(Float::Min, least, pivot);
        sum = b.add(sum, pivot);
    }
    let bound = b.mul(threshold, sum);
    // Not: bound < least, so that what is not a number fails.
    let bad = b.compare(Predicate::NotLess, bound, least);
    b.fail(bad);
}

/// Solves for a right-hand side.
pub(crate) fn solve(b: &mut Builder, factored: &Factored, rhs: &[Value]) -> Vec<Value> {
    match factored {
        Factored::Called { size, cells } => solve_called(b, *size, *cells, rhs),
        Factored::Unrolled {
            size,
            lower,
            reciprocals,
        } => solve_unrolled(b, *size, lower, reciprocals, rhs),
        Factored::Exchanged {
            rows,
            reciprocals,
            exchanges,
        } => solve_exchanged(b, rows, reciprocals, exchanges, rhs),
    }
}

fn solve_called(b: &mut Builder, size: usize, matrix: i32, rhs: &[Value]) -> Vec<Value> {
    let cells = b.cells(size);
    for (i, &value) in rhs.iter().enumerate() {
        b.store(value, b.cell(cells, i));
    }
    let helper = Helper::Solve {
        size: size as u16,
        distance: matrix - cells,
    };
    b.push(super::code::Op::Call { helper, cells });
    let places: Vec<_> = (0..size).map(|i| b.cell(cells, i)).collect();
    let values = places.into_iter().map(|p| b.at(p.base, p.offset));
    values.collect()
}

fn solve_unrolled(
    b: &mut Builder,
    size: usize,
    lower: &[Value],
    reciprocals: &[Value],
    rhs: &[Value],
) -> Vec<Value> {
    let mut x: Vec<Value> = Vec::with_capacity(size);
    for i in 0..size {
        let factors = (0..i).map(|k| (lower[below(i, k)], x[k]));
        let value = subtract_products(b, rhs[i], factors);
        x.push(value);
    }
    for (x, &reciprocal) in x.iter_mut().zip(reciprocals) {
        if !b.is_zero(*x) {
            *x = b.mul(*x, reciprocal);
        }
    }
    // The unknown found last is needed last.
    for i in (0..size).rev() {
        let factors = (i + 1..size).rev().map(|k| (lower[below(k, i)], x[k]));
        x[i] = subtract_products(b, x[i], factors);
    }
    x
}

fn solve_exchanged(
    b: &mut Builder,
    rows: &[Vec<Value>],
    reciprocals: &[Value],
    exchanges: &[Exchange],
    rhs: &[Value],
) -> Vec<Value> {
    let mut x = rhs.to_vec();
    for exchange in exchanges {
        let (upper, lower) = (exchange.upper, exchange.lower);
        (x[upper], x[lower]) = exchange.apply(b, x[upper], x[lower]);
    }
    for i in 1..rows.len() {
        let factors = (0..i).map(|k| (rows[i][k], x[k]));
        x[i] = subtract_products(b, x[i], factors);
    }
    for i in (0..rows.len()).rev() {
        let factors = (i + 1..rows.len()).rev().map(|k| (rows[i][k], x[k]));
        let rest = subtract_products(b, x[i], factors);
        x[i] = b.mul(rest, reciprocals[i]);
    }
    x
}
