//! Accelerations and multipliers of the multiplier form at a state (T5 §5.1 (2)).
//!
//! With `B` spanning ker J and `J a* = g`: `a = a* + B c`, `(Bᵀ M B) c = Bᵀ (b - M a*)`. The matrix is symmetric unless a mass
//! contains velocities.

use crate::chart::{heaviness, Chart};
use crate::dense::{Lu, SmallPivot, Symmetric};
use crate::numeric::NumericSystem;
use chetaev_integrate::EvaluationFailure;

/// Workspace and results of one solve.
#[derive(Clone, Debug, Default)]
pub struct Accelerations {
    /// a, length n.
    pub a: Vec<f64>,
    /// λ by constraint row; zero for the rows the chart leaves out.
    pub lambda: Vec<f64>,
    /// Number of factorizations made.
    pub factorizations: u64,
    dependent: Lu,
    reduced: Symmetric,
    /// In the place of `reduced` where M is not symmetric.
    general: Lu,
    block: Vec<f64>,
    weights: Vec<f64>,
    /// B restricted to dependent rows: ρ × k.
    slope: Vec<f64>,
    column: Vec<f64>,
    matrix: Vec<f64>,
    /// M B, n × k.
    mass_basis: Vec<f64>,
    rhs: Vec<f64>,
}

/// The failure of a chart or of the reduced mass matrix.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SolveFailure {
    /// The dependent velocities cannot be solved for in this chart.
    Chart(SmallPivot),
    /// `Bᵀ M B` is singular: some admissible direction has no inertia.
    Inertia(SmallPivot),
}

impl From<SolveFailure> for EvaluationFailure {
    fn from(failure: SolveFailure) -> EvaluationFailure {
        match failure {
            SolveFailure::Chart(pivot) => EvaluationFailure::PivotDegraded {
                ratio: pivot.pivot.abs(),
            },
            SolveFailure::Inertia(pivot) => EvaluationFailure::Singular {
                index: pivot.index,
                pivot: pivot.pivot,
                threshold: pivot.threshold,
            },
        }
    }
}

impl Accelerations {
    /// Solves at the state where `system` was last evaluated.
    ///
    /// # Errors
    /// [`SolveFailure`].
    pub fn solve(&mut self, system: &NumericSystem, chart: &Chart) -> Result<(), SolveFailure> {
        let n = system.n;
        self.factor_dependent(system, chart)
            .map_err(SolveFailure::Chart)?;
        self.particular(system, chart);
        self.project_mass(system, chart);
        let k = chart.independent.len();
        self.factorizations += 1;
        self.factor_reduced(system, chart)
            .map_err(SolveFailure::Inertia)?;
        let mut c = std::mem::take(&mut self.rhs);
        match system.is_symmetric {
            true => self.reduced.solve(&mut c),
            false => self.general.solve(&mut c),
        }
        for (sigma, &i) in chart.independent.iter().enumerate() {
            self.a[i] += c[sigma];
        }
        for (l, &d) in chart.dependent.iter().enumerate() {
            let sum: f64 = (0..k)
                .map(|sigma| self.slope[l * k + sigma] * c[sigma])
                .sum();
            self.a[d] += sum;
        }
        self.rhs = c;
        self.multipliers(system, chart, n);
        Ok(())
    }

    /// Replaces accelerations that are not known after a failed solve by zero.
    pub(crate) fn fill_unknown(&mut self, n: usize) {
        self.a.resize(n, 0.0);
        for a in self.a.iter_mut().filter(|a| !a.is_finite()) {
            *a = 0.0;
        }
    }

    /// Factors `J_d` and forms `B_d = -J_d⁻¹ J_i`.
    fn factor_dependent(
        &mut self,
        system: &NumericSystem,
        chart: &Chart,
    ) -> Result<(), SmallPivot> {
        let (n, jacobian) = (system.n, system.jacobian());
        let (rank, k) = (chart.rows.len(), chart.independent.len());
        self.block.clear();
        for &row in &chart.rows {
            self.block
                .extend(chart.dependent.iter().map(|&d| jacobian[row * n + d]));
        }
        if rank > 0 {
            self.factorizations += 1;
            self.weigh_rows(system, chart);
            let weights = &self.weights;
            self.dependent.factor_weighted(rank, &self.block, weights)?;
        }
        self.slope.clear();
        self.slope.resize(rank * k, 0.0);
        self.column.resize(rank, 0.0);
        for (sigma, &i) in chart.independent.iter().enumerate() {
            for (entry, &row) in self.column.iter_mut().zip(&chart.rows) {
                *entry = -jacobian[row * n + i];
            }
            if rank > 0 {
                self.dependent.solve(&mut self.column);
            }
            for l in 0..rank {
                self.slope[l * k + sigma] = self.column[l];
            }
        }
        Ok(())
    }

    /// The lengths of the rows of J in the metric of the masses, where there are several to compare.
    fn weigh_rows(&mut self, system: &NumericSystem, chart: &Chart) {
        let n = system.n;
        self.weights.clear();
        if let [_] = chart.rows[..] {
            return self.weights.push(1.0);
        }
        let mass = system.mass();
        for &row in &chart.rows {
            let entries = system.jacobian()[row * n..(row + 1) * n].iter();
            let weighed = entries
                .enumerate()
                .map(|(j, x)| x * x / heaviness(mass[j * n + j]));
            self.weights.push(weighed.sum::<f64>().sqrt());
        }
    }

    /// a* with independent components zero.
    fn particular(&mut self, system: &NumericSystem, chart: &Chart) {
        self.a.clear();
        self.a.resize(system.n, 0.0);
        for (entry, &row) in self.column.iter_mut().zip(&chart.rows) {
            *entry = system.rate()[row];
        }
        if !chart.rows.is_empty() {
            self.dependent.solve(&mut self.column);
        }
        for (&d, &value) in chart.dependent.iter().zip(&self.column) {
            self.a[d] = value;
        }
    }

    /// `Bᵀ M B` and `Bᵀ (b - M a*)`.
    fn project_mass(&mut self, system: &NumericSystem, chart: &Chart) {
        let (n, mass) = (system.n, system.mass());
        let k = chart.independent.len();
        if is_free(system, chart) {
            self.rhs.clear();
            self.rhs.extend_from_slice(system.force());
            return;
        }
        self.mass_basis.clear();
        self.mass_basis.resize(n * k, 0.0);
        for i in 0..n {
            for (sigma, &j) in chart.independent.iter().enumerate() {
                let mut value = mass[i * n + j];
                for (l, &d) in chart.dependent.iter().enumerate() {
                    value += mass[i * n + d] * self.slope[l * k + sigma];
                }
                self.mass_basis[i * k + sigma] = value;
            }
        }
        self.matrix.clear();
        self.matrix.resize(k * k, 0.0);
        self.rhs.clear();
        self.rhs.resize(k, 0.0);
        for (sigma, &i) in chart.independent.iter().enumerate() {
            for tau in 0..k {
                let mut value = self.mass_basis[i * k + tau];
                for (l, &d) in chart.dependent.iter().enumerate() {
                    value += self.slope[l * k + sigma] * self.mass_basis[d * k + tau];
                }
                self.matrix[sigma * k + tau] = value;
            }
            let mut value = self.unbalanced(system, i);
            for (l, &d) in chart.dependent.iter().enumerate() {
                value += self.slope[l * k + sigma] * self.unbalanced(system, d);
            }
            self.rhs[sigma] = value;
        }
    }

    fn factor_reduced(&mut self, system: &NumericSystem, chart: &Chart) -> Result<(), SmallPivot> {
        if !system.is_symmetric {
            if is_free(system, chart) {
                self.matrix.clear();
                self.matrix.extend_from_slice(system.mass());
            }
            return self.general.factor(chart.independent.len(), &self.matrix);
        }
        if !is_free(system, chart) {
            return self.reduced.factor(chart.independent.len(), &self.matrix);
        }
        let factored = self
            .reduced
            .factor_within(system.n, system.mass(), system.mass_envelope());
        if factored.is_err() {
            self.matrix.clear();
            self.matrix.extend_from_slice(system.mass());
        }
        factored
    }

    /// `(b - M a)_i` with the present a.
    fn unbalanced(&self, system: &NumericSystem, i: usize) -> f64 {
        let n = system.n;
        let inertia: f64 = (0..n).map(|j| system.mass()[i * n + j] * self.a[j]).sum();
        system.force()[i] - inertia
    }

    /// `J_dᵀ λ = (M a - b)_d` on the rows of the chart.
    fn multipliers(&mut self, system: &NumericSystem, chart: &Chart, n: usize) {
        debug_assert_eq!(n, self.a.len());
        self.lambda.clear();
        self.lambda.resize(system.r, 0.0);
        if chart.rows.is_empty() {
            return;
        }
        for l in 0..chart.dependent.len() {
            self.column[l] = -self.unbalanced(system, chart.dependent[l]);
        }
        self.dependent.solve_transposed(&mut self.column);
        for (&row, &value) in chart.rows.iter().zip(&self.column) {
            self.lambda[row] = value;
        }
    }

    /// The direction that has no inertia when the reduced mass matrix is singular: a null vector of `Bᵀ M B` mapped to
    /// the coordinates, or `None` when none stands out.
    pub fn inertia_null_vector(&self, chart: &Chart, n: usize) -> Option<Vec<f64>> {
        let k = chart.independent.len();
        let c = null_vector(&self.matrix, k)?;
        let mut direction = vec![0.0; n];
        for (sigma, &i) in chart.independent.iter().enumerate() {
            direction[i] = c[sigma];
        }
        for (l, &d) in chart.dependent.iter().enumerate() {
            direction[d] = (0..k)
                .map(|sigma| self.slope[l * k + sigma] * c[sigma])
                .sum();
        }
        Some(direction)
    }
}

/// Whether all velocities are independent: then `Bᵀ M B` is M, which needs no copy, and a* = 0.
fn is_free(system: &NumericSystem, chart: &Chart) -> bool {
    chart.dependent.is_empty() && chart.independent.iter().copied().eq(0..system.n)
}

/// A unit null vector by complete pivoting; `None` for a regular matrix.
fn null_vector(matrix: &[f64], k: usize) -> Option<Vec<f64>> {
    // By the diagonal all entries become numbers of one kind.
    let size = |i: usize| match matrix[i * k + i].abs() {
        size if size > 0.0 && size.is_finite() => size.sqrt(),
        _ => 1.0,
    };
    let mut a: Vec<f64> = (0..k * k)
        .map(|place| matrix[place] / (size(place / k) * size(place % k)))
        .collect();
    let mut columns: Vec<usize> = (0..k).collect();
    let largest = a.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    for s in 0..k {
        let mut best = (s, s, 0.0f64);
        for i in s..k {
            for (j, &c) in columns.iter().enumerate().skip(s) {
                if a[i * k + c].abs() > best.2 {
                    best = (i, j, a[i * k + c].abs());
                }
            }
        }
        if best.2 <= 1e-12 * largest.max(f64::MIN_POSITIVE) {
            let mut direction = back_substitute(&a, &columns, s, k);
            (direction.iter_mut().enumerate()).for_each(|(i, x)| *x /= size(i));
            let largest = direction.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
            direction.iter_mut().for_each(|x| *x /= largest);
            return Some(direction);
        }
        for c in 0..k {
            a.swap(s * k + c, best.0 * k + c);
        }
        columns.swap(s, best.1);
        for i in s + 1..k {
            let factor = a[i * k + columns[s]] / a[s * k + columns[s]];
            for &c in &columns[s..] {
                a[i * k + c] -= factor * a[s * k + c];
            }
        }
    }
    None
}

fn back_substitute(a: &[f64], columns: &[usize], rank: usize, k: usize) -> Vec<f64> {
    let mut x = vec![0.0; k];
    x[columns[rank]] = 1.0;
    for s in (0..rank).rev() {
        let sum: f64 = columns[s + 1..].iter().map(|&c| a[s * k + c] * x[c]).sum();
        x[columns[s]] = -sum / a[s * k + columns[s]];
    }
    let length = x.iter().map(|v| v * v).sum::<f64>().sqrt();
    x.iter_mut().for_each(|v| *v /= length);
    x
}
