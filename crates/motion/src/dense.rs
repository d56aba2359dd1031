//! Small dense linear algebra in place, without allocation: LU with partial pivoting and LDLᵀ.

/// Why a matrix cannot be used.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SmallPivot {
    /// Position in the order of elimination.
    pub index: usize,
    /// The pivot found.
    pub pivot: f64,
    /// The size below which it counts as zero.
    pub threshold: f64,
}

/// `c₀ n ε`, the part of its terms below which a pivot counts as zero (T5 §5.1, c₀ = 10).
fn negligible(n: usize) -> f64 {
    10.0 * n.max(1) as f64 * f64::EPSILON
}

/// Pivots whose ratio is above this need no closer look: rounding leaves pivots near ε.
const UNSUSPICIOUS: f64 = 1e-8;

/// An LU factorization with row interchanges of an n × n matrix kept by rows.
#[derive(Clone, Debug, Default)]
pub struct Lu {
    n: usize,
    a: Vec<f64>,
    order: Vec<usize>,
    weights: Vec<f64>,
    scratch: Vec<f64>,
}

impl Lu {
    /// Factors `a` (n × n, row by row).
    ///
    /// # Errors
    /// [`SmallPivot`] when a pivot is negligible against the terms of which elimination made it, whatever the units of rows
    /// and columns.
    pub fn factor(&mut self, n: usize, a: &[f64]) -> Result<(), SmallPivot> {
        let largest = |row: &[f64]| row.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
        let mut weights = std::mem::take(&mut self.weights);
        weights.clear();
        weights.extend(a.chunks(n.max(1)).map(largest));
        let factored = self.factor_weighted(n, a, &weights);
        self.weights = weights;
        factored
    }

    /// The same with the size of each row, by which rows are compared for pivots.
    ///
    /// # Errors
    /// [`SmallPivot`].
    pub fn factor_weighted(
        &mut self,
        n: usize,
        a: &[f64],
        weights: &[f64],
    ) -> Result<(), SmallPivot> {
        self.n = n;
        self.a.clear();
        self.a.extend_from_slice(a);
        self.order.clear();
        self.order.extend(0..n);
        let (mut smallest, mut largest) = (f64::INFINITY, 0.0_f64);
        for k in 0..n {
            let part = |i: usize| self.a[i * n + k].abs() / weights[self.order[i]];
            let p = (k..n)
                .max_by(|&i, &j| part(i).total_cmp(&part(j)))
                .unwrap_or(k);
            let pivot = self.a[p * n + k];
            if pivot.is_nan() || pivot == 0.0 {
                let threshold = 0.0;
                return Err(SmallPivot {
                    index: k,
                    pivot,
                    threshold,
                });
            }
            smallest = smallest.min(pivot.abs());
            largest = largest.max(pivot.abs());
            if p != k {
                for j in 0..n {
                    self.a.swap(k * n + j, p * n + j);
                }
                self.order.swap(k, p);
            }
            for i in k + 1..n {
                let factor = self.a[i * n + k] / pivot;
                self.a[i * n + k] = factor;
                if factor != 0.0 {
                    for j in k + 1..n {
                        self.a[i * n + j] -= factor * self.a[k * n + j];
                    }
                }
            }
        }
        if smallest > UNSUSPICIOUS * largest {
            Ok(())
        } else {
            self.check(a)
        }
    }

    /// Compares the pivots with the sums of the sizes of their terms.
    fn check(&self, given: &[f64]) -> Result<(), SmallPivot> {
        let n = self.n;
        let rows = self.order.iter().map(|&i| &given[i * n..(i + 1) * n]);
        let mut sizes: Vec<f64> = rows.flatten().map(|x| x.abs()).collect();
        for k in 0..n {
            let (pivot, threshold) = (self.a[k * n + k], negligible(n) * sizes[k * n + k]);
            if pivot.abs() <= threshold {
                return Err(SmallPivot {
                    index: k,
                    pivot,
                    threshold,
                });
            }
            for i in k + 1..n {
                let factor = self.a[i * n + k].abs();
                for j in k + 1..n {
                    sizes[i * n + j] += factor * sizes[k * n + j];
                }
            }
        }
        Ok(())
    }

    /// Replaces `b` by the solution of `A x = b`.
    pub fn solve(&mut self, b: &mut [f64]) {
        let n = self.n;
        self.scratch.clear();
        self.scratch.extend(self.order.iter().map(|&i| b[i]));
        b.copy_from_slice(&self.scratch);
        for i in 1..n {
            let sum: f64 = (0..i).map(|j| self.a[i * n + j] * b[j]).sum();
            b[i] -= sum;
        }
        for i in (0..n).rev() {
            let sum: f64 = (i + 1..n).map(|j| self.a[i * n + j] * b[j]).sum();
            b[i] = (b[i] - sum) / self.a[i * n + i];
        }
    }

    /// Replaces `b` by the solution of `Aᵀ x = b`.
    pub fn solve_transposed(&mut self, b: &mut [f64]) {
        let n = self.n;
        for i in 0..n {
            let sum: f64 = (0..i).map(|j| self.a[j * n + i] * b[j]).sum();
            b[i] = (b[i] - sum) / self.a[i * n + i];
        }
        for i in (0..n).rev() {
            let sum: f64 = (i + 1..n).map(|j| self.a[j * n + i] * b[j]).sum();
            b[i] -= sum;
        }
        self.scratch.clear();
        self.scratch.resize(n, 0.0);
        for (i, &place) in self.order.iter().enumerate() {
            self.scratch[place] = b[i];
        }
        b.copy_from_slice(&self.scratch);
    }
}

/// A symmetric solve: LDLᵀ without pivoting while the pivots are positive, LU otherwise (T5 §5.1).
///
/// What lies left of the first entry of a row of the matrix is zero in L too (the envelope; A. George, J. Liu, Computer
/// Solution of Large Sparse Positive Definite Systems, 1981, ch. 4) and is passed over: free coordinates cost little.
#[derive(Clone, Debug, Default)]
pub struct Symmetric {
    n: usize,
    /// L below the diagonal and D on it, row by row; what lies outside the envelope is not used.
    l: Vec<f64>,
    /// The column of the first entry of each row.
    first: Vec<usize>,
    /// The rows below the diagonal that reach column j are `below[start[j]..start[j + 1]]`, ascending.
    start: Vec<usize>,
    below: Vec<usize>,
    scan: Vec<usize>,
    definite: bool,
    lu: Lu,
}

impl Symmetric {
    /// Factors the symmetric matrix `a` (n × n, row by row).
    ///
    /// # Errors
    /// [`SmallPivot`] when the matrix is numerically singular.
    pub fn factor(&mut self, n: usize, a: &[f64]) -> Result<(), SmallPivot> {
        let first = |i: usize| {
            let row = &a[i * n..i * n + i];
            row.iter().position(|&x| x != 0.0).unwrap_or(i)
        };
        let mut scan = std::mem::take(&mut self.scan);
        scan.clear();
        scan.extend((0..n).map(first));
        let factored = self.factor_within(n, a, &scan);
        self.scan = scan;
        factored
    }

    /// [`factor`](Self::factor) where the entries of row i left of column `first[i]` are known to be zero.
    ///
    /// # Errors
    /// [`SmallPivot`] when the matrix is numerically singular.
    pub fn factor_within(
        &mut self,
        n: usize,
        a: &[f64],
        first: &[usize],
    ) -> Result<(), SmallPivot> {
        self.n = n;
        if self.first != first {
            self.enter(first);
        }
        self.definite = self.factor_definite(a);
        if self.definite {
            Ok(())
        } else {
            self.lu.factor(n, a)
        }
    }

    fn enter(&mut self, first: &[usize]) {
        self.first.clear();
        self.first.extend_from_slice(first);
        let mut columns = vec![Vec::new(); first.len()];
        for (i, &from) in first.iter().enumerate() {
            for column in &mut columns[from..i] {
                column.push(i);
            }
        }
        self.start.clear();
        self.start.push(0);
        self.below.clear();
        for column in columns {
            self.below.extend(column);
            self.start.push(self.below.len());
        }
    }

    fn factor_definite(&mut self, a: &[f64]) -> bool {
        let n = self.n;
        self.l.resize(n * n, 0.0);
        for (i, &from) in self.first.iter().enumerate() {
            let row = i * n + from..i * n + i + 1;
            self.l[row.clone()].copy_from_slice(&a[row]);
        }
        for j in 0..n {
            let from = self.first[j];
            let mut d = self.l[j * n + j];
            for m in from..j {
                d -= self.l[j * n + m] * self.l[j * n + m] * self.l[m * n + m];
            }
            // The terms of a pivot of a definite matrix add up to its diagonal entry.
            if d.is_nan() || d <= negligible(n) * a[j * n + j] {
                return false;
            }
            self.l[j * n + j] = d;
            for &i in &self.below[self.start[j]..self.start[j + 1]] {
                let mut value = a[i * n + j];
                for m in from.max(self.first[i])..j {
                    value -= self.l[i * n + m] * self.l[j * n + m] * self.l[m * n + m];
                }
                self.l[i * n + j] = value / d;
            }
        }
        true
    }

    /// Replaces `b` by the solution.
    pub fn solve(&mut self, b: &mut [f64]) {
        if !self.definite {
            self.lu.solve(b);
            return;
        }
        let n = self.n;
        for i in 1..n {
            let sum: f64 = (self.first[i]..i).map(|j| self.l[i * n + j] * b[j]).sum();
            b[i] -= sum;
        }
        for (i, value) in b.iter_mut().enumerate().take(n) {
            *value /= self.l[i * n + i];
        }
        for i in (0..n).rev() {
            let below = &self.below[self.start[i]..self.start[i + 1]];
            let sum: f64 = below.iter().map(|&j| self.l[j * n + i] * b[j]).sum();
            b[i] -= sum;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn random(seed: u64, count: usize) -> Vec<f64> {
        let mut generator = chetaev_mechanics::sample::Generator::new(seed);
        (0..count).map(|_| generator.between(-1.0, 1.0)).collect()
    }

    #[test]
    fn solutions_satisfy_their_systems() {
        for n in 1..9 {
            let a = random(n as u64, n * n);
            let b = random(100 + n as u64, n);
            let mut lu = Lu::default();
            lu.factor(n, &a).unwrap();
            let mut x = b.clone();
            lu.solve(&mut x);
            let mut y = b.clone();
            lu.solve_transposed(&mut y);
            for i in 0..n {
                let row: f64 = (0..n).map(|j| a[i * n + j] * x[j]).sum();
                let column: f64 = (0..n).map(|j| a[j * n + i] * y[j]).sum();
                assert!((row - b[i]).abs() < 1e-11 && (column - b[i]).abs() < 1e-11);
            }
        }
    }

    #[test]
    fn definite_and_indefinite_symmetric_systems() {
        for (matrix, definite) in [
            ([2.0, 1.0, 1.0, 3.0], true),
            ([0.0, 1.0, 1.0, 0.0], false),
            ([1.0, 2.0, 2.0, 1.0], false),
        ] {
            let mut symmetric = Symmetric::default();
            symmetric.factor(2, &matrix).unwrap();
            assert_eq!(symmetric.definite, definite);
            let mut x = [1.0, -2.0];
            symmetric.solve(&mut x);
            assert!((matrix[0] * x[0] + matrix[1] * x[1] - 1.0).abs() < 1e-14);
            assert!((matrix[2] * x[0] + matrix[3] * x[1] + 2.0).abs() < 1e-14);
        }
        assert!(Symmetric::default()
            .factor(2, &[1.0, 1.0, 1.0, 1.0])
            .is_err());
    }

    #[test]
    fn a_sparse_definite_matrix_is_solved_after_a_full_one() {
        // Entries left over from the full matrix must not be read: its envelope is larger.
        let n = 6;
        let mut symmetric = Symmetric::default();
        let full: Vec<f64> = (0..n * n)
            .map(|p| if p / n == p % n { 9.0 } else { 1.0 })
            .collect();
        symmetric.factor(n, &full).unwrap();
        let mut arrow = vec![0.0; n * n];
        for i in 0..n {
            arrow[i * n + i] = 2.0 + i as f64;
        }
        for (i, j) in [(4, 1), (5, 3), (2, 1)] {
            arrow[i * n + j] = 0.5;
            arrow[j * n + i] = 0.5;
        }
        symmetric.factor(n, &arrow).unwrap();
        let b = random(7, n);
        let mut x = b.clone();
        symmetric.solve(&mut x);
        for i in 0..n {
            let row: f64 = (0..n).map(|j| arrow[i * n + j] * x[j]).sum();
            assert!((row - b[i]).abs() < 1e-14);
        }
    }
}
