//! Small dense linear systems in double-double arithmetic: L D Lᵀ for symmetric positive definite matrices, else L U with
//! partial pivoting, as `factor` has them for doubles.

use crate::evaluate::EvaluateFailure;
use crate::factor::{range, uncertainty};
use crate::program::Factorization;
use chetaev_double_double::DoubleDouble;

/// A pivot below this, times size · ε, times its uncertainty, counts as zero.
const SAFETY: f64 = 10.0;

/// A factorized matrix: L below the diagonal, the pivots on it, U above it.
#[derive(Clone, Debug)]
pub(crate) struct Factors {
    size: usize,
    factors: Vec<DoubleDouble>,
    /// For each row of the factors its row in the matrix.
    rows: Vec<usize>,
}

impl Factors {
    pub(crate) fn new(size: usize) -> Factors {
        Factors {
            size,
            factors: vec![DoubleDouble::ZERO; size * size],
            rows: (0..size).collect(),
        }
    }

    /// Factorizes the matrix with these entries, whose number is for failures.
    pub(crate) fn factorize(
        &mut self,
        entries: &[DoubleDouble],
        factorization: Factorization,
        matrix: usize,
    ) -> Result<(), EvaluateFailure> {
        if entries.iter().any(|entry| !entry.is_finite()) {
            return Err(EvaluateFailure::NotFinite { matrix });
        }
        self.reset(entries);
        if factorization == Factorization::Ldlt {
            self.mirror();
            self.eliminate(false);
            if self.is_definite() {
                return Ok(());
            }
            self.reset(entries);
        }
        self.eliminate(true);
        self.check(matrix)
    }

    fn reset(&mut self, entries: &[DoubleDouble]) {
        self.factors.copy_from_slice(entries);
        self.rows = (0..self.size).collect();
    }

    /// Of a symmetric matrix the diagonal and what is below it are read.
    fn mirror(&mut self) {
        let n = self.size;
        for i in 0..n {
            for j in i + 1..n {
                self.factors[i * n + j] = self.factors[j * n + i];
            }
        }
    }

    fn eliminate(&mut self, is_pivoting: bool) {
        let n = self.size;
        for k in 0..n {
            if is_pivoting {
                self.exchange(k);
            }
            let pivot = self.factors[k * n + k];
            for i in k + 1..n {
                let lower = self.factors[i * n + k] / pivot;
                self.factors[i * n + k] = lower;
                for j in k + 1..n {
                    let upper = self.factors[k * n + j];
                    self.factors[i * n + j] -= lower * upper;
                }
            }
        }
    }

    /// Brings the largest entry of what is left of column k to the diagonal.
    fn exchange(&mut self, k: usize) {
        let n = self.size;
        let size = |i: usize| self.factors[i * n + k].high().abs();
        let best = (k..n).fold(k, |best, i| if size(i) > size(best) { i } else { best });
        if best != k {
            self.rows.swap(k, best);
            for j in 0..n {
                self.factors.swap(k * n + j, best * n + j);
            }
        }
    }

    fn pivots(&self) -> impl Iterator<Item = f64> + '_ {
        (0..self.size).map(|k| self.factors[k * self.size + k].high())
    }

    fn is_definite(&self) -> bool {
        let found = range(self.pivots());
        let threshold = SAFETY * self.size as f64 * DoubleDouble::EPSILON * found.largest;
        let are_positive = self.pivots().all(|pivot| pivot > 0.0);
        are_positive && found.largest.is_finite() && found.smallest > threshold
    }

    /// A pivot counts as zero that rounding does not tell from zero.
    fn check(&self, matrix: usize) -> Result<(), EvaluateFailure> {
        let n = self.size;
        let factor = |i: usize, j: usize| self.factors[i * n + j].high();
        for (k, value) in self.pivots().enumerate() {
            let unit = SAFETY * n as f64 * DoubleDouble::EPSILON;
            let threshold = unit * uncertainty(k, factor, |m| factor(m, m));
            if value.abs() <= threshold {
                let found = range(self.pivots());
                return Err(EvaluateFailure::Singular {
                    matrix,
                    pivot: k,
                    value,
                    threshold,
                    smallest: found.smallest,
                    largest: found.largest,
                });
            }
            if !value.is_finite() {
                return Err(EvaluateFailure::NotFinite { matrix });
            }
        }
        Ok(())
    }

    /// Solves A x = b.
    pub(crate) fn solve(&self, b: &[DoubleDouble], x: &mut [DoubleDouble]) {
        let n = self.size;
        for (x, &row) in x.iter_mut().zip(&self.rows) {
            *x = b[row];
        }
        for i in 1..n {
            for j in 0..i {
                let known = x[j];
                x[i] -= self.factors[i * n + j] * known;
            }
        }
        for i in (0..n).rev() {
            for j in i + 1..n {
                let known = x[j];
                x[i] -= self.factors[i * n + j] * known;
            }
            x[i] = x[i] / self.factors[i * n + i];
        }
    }
}
