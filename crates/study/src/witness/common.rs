//! What several witnesses need at the rows of the motion, compiled and evaluated once.

use super::refined::CLEARLY;
use super::samples::{rows, Samples};
use super::states::{States, APART};
use chetaev_mechanics::claims::formulation::basis;
use chetaev_mechanics::Context;
use chetaev_symbolic::Expr;
use std::sync::Arc;

/// Functions of the state along the motion.
pub(super) struct Common {
    samples: Samples,
    /// L at states beside the rows.
    pub(super) lagrangian: States,
    /// How many coordinates there are.
    pub(super) n: usize,
    /// How many independent constraints.
    pub(super) r: usize,
    /// Sizes of coordinates and velocities along the motion, which variations have.
    sizes: Vec<f64>,
    speeds: Vec<f64>,
}

/// The result, computed once.
struct Found(Result<Arc<Common>, String>);

/// The groups in their order.
const POSITIONS: usize = 0;
const VELOCITIES: usize = 1;
const ACCELERATIONS: usize = 2;
const MASS_RATES: usize = 3;
const SLOPES: usize = 4;
const FORCES: usize = 5;
const MOMENTA: usize = 6;
const JACOBIAN: usize = 7;
const MOVED_JACOBIAN: usize = 8;
const HESSIAN: usize = 9;
const MIXED: usize = 10;
const LAGRANGIAN: usize = 11;

/// How far a coordinate goes, but no farther than one where its natural size is one, as of angles; the natural size where it rests.
fn size(samples: &Samples, i: usize, natural: f64) -> f64 {
    let start = samples.at(POSITIONS, 0)[i];
    let far = (0..samples.times.len()).map(|row| (samples.at(POSITIONS, row)[i] - start).abs());
    let extent = far.fold(0.0, f64::max);
    if extent <= 0.0 {
        natural
    } else if natural == 1.0 {
        extent.min(1.0)
    } else {
        extent
    }
}

/// The largest velocities; of a coordinate that rests its size over the time.
fn speeds(samples: &Samples, sizes: &[f64]) -> Vec<f64> {
    let rows = samples.times.len();
    let length = (samples.times[rows - 1] - samples.times[0]).abs();
    let of = |(i, size): (usize, &f64)| {
        let all = (0..rows).map(|row| samples.at(VELOCITIES, row)[i].abs());
        let largest = all.fold(0.0, f64::max);
        if largest > 0.0 {
            largest
        } else {
            size / length
        }
    };
    sizes.iter().enumerate().map(of).collect()
}

impl Common {
    /// Along the computed motion.
    ///
    /// # Errors
    /// That there are no equally spaced rows.
    pub(super) fn of(cx: &Context<'_>) -> Result<Arc<Common>, String> {
        cx.shared(|cx| Found(Common::new(cx).map(Arc::new)))
            .0
            .clone()
    }

    fn new(cx: &Context<'_>) -> Result<Common, String> {
        let (system, g) = (cx.system, &cx.system.graph);
        let (q, v) = (system.coordinate_symbols(), system.velocity_symbols());
        let momenta = g.gradient(system.lagrangian, &v);
        let jacobian = basis(cx).jacobian().concat();
        let moved: Vec<Expr> = jacobian
            .iter()
            .map(|&e| system.total_derivative(e))
            .collect();
        let coordinates = system.coordinates.iter();
        let groups: [Vec<Expr>; 12] = [
            coordinates.clone().map(|c| c.q).collect(),
            coordinates.clone().map(|c| c.v).collect(),
            coordinates.map(|c| c.a).collect(),
            system.masses.iter().map(|m| m.rate).collect(),
            g.gradient(system.lagrangian, &q),
            system.forces.clone(),
            momenta.clone(),
            jacobian,
            moved,
            cx.terms.mass_matrix.concat(),
            g.jacobian(&momenta, &q).concat(),
            vec![system.lagrangian],
        ];
        let groups: Vec<&[Expr]> = groups.iter().map(Vec::as_slice).collect();
        let samples = Samples::new(cx, &groups)?;
        let evidence = rows(cx)?.0;
        let natural = |i: usize| evidence.rows().scales.get(i).copied().unwrap_or(1.0);
        let sizes: Vec<f64> = (0..system.n())
            .map(|i| size(&samples, i, natural(i)))
            .collect();
        Ok(Common {
            speeds: speeds(&samples, &sizes),
            sizes,
            n: system.n(),
            samples,
            lagrangian: States::new(cx, &[system.lagrangian])?,
            r: cx.selection.rows.len(),
        })
    }

    /// The times of the rows.
    pub(super) fn times(&self) -> &[f64] {
        &self.samples.times
    }

    /// q.
    pub(super) fn positions(&self, row: usize) -> &[f64] {
        self.samples.at(POSITIONS, row)
    }

    /// v.
    pub(super) fn velocities(&self, row: usize) -> &[f64] {
        self.samples.at(VELOCITIES, row)
    }

    /// a.
    pub(super) fn accelerations(&self, row: usize) -> &[f64] {
        self.samples.at(ACCELERATIONS, row)
    }

    /// The rates of masses with a law of their own.
    pub(super) fn mass_rates(&self, row: usize) -> &[f64] {
        self.samples.at(MASS_RATES, row)
    }

    /// ∂L/∂q.
    pub(super) fn slopes(&self, row: usize) -> &[f64] {
        self.samples.at(SLOPES, row)
    }

    /// Q.
    pub(super) fn forces(&self, row: usize) -> &[f64] {
        self.samples.at(FORCES, row)
    }

    /// p.
    pub(super) fn momenta(&self, row: usize) -> &[f64] {
        self.samples.at(MOMENTA, row)
    }

    /// ∂f/∂v, r × n.
    pub(super) fn jacobian(&self, row: usize) -> &[f64] {
        self.samples.at(JACOBIAN, row)
    }

    /// D(∂f/∂v), r × n.
    pub(super) fn moved_jacobian(&self, row: usize) -> &[f64] {
        self.samples.at(MOVED_JACOBIAN, row)
    }

    /// ∂²L/∂v∂v, n × n.
    pub(super) fn hessian(&self, row: usize) -> &[f64] {
        self.samples.at(HESSIAN, row)
    }

    /// ∂p/∂q, n × n.
    pub(super) fn mixed(&self, row: usize) -> &[f64] {
        self.samples.at(MIXED, row)
    }

    /// L.
    pub(super) fn lagrangian(&self, row: usize) -> f64 {
        self.samples.at(LAGRANGIAN, row)[0]
    }

    /// `H = Σ p v − L`.
    pub(super) fn energy(&self, row: usize) -> f64 {
        let pairs = self.momenta(row).iter().zip(self.velocities(row));
        pairs.map(|(p, v)| p * v).sum::<f64>() - self.lagrangian(row)
    }

    /// `Σ ∂H/∂v·v = v·W v`.
    pub(super) fn stretch(&self, row: usize) -> f64 {
        let velocities = self.velocities(row);
        let moved = super::algebra::times(self.hessian(row), self.n, velocities);
        moved.iter().zip(velocities).map(|(a, b)| a * b).sum()
    }

    /// The sizes of the coordinates.
    pub(super) fn sizes(&self) -> &[f64] {
        &self.sizes
    }

    /// The size of a velocity.
    pub(super) fn speed(&self, i: usize) -> f64 {
        self.speeds[i]
    }

    /// The shortest time in which a coordinate covers its size.
    pub(super) fn natural_time(&self) -> f64 {
        let times = self.sizes.iter().zip(&self.speeds).map(|(q, v)| q / v);
        times.fold(f64::INFINITY, f64::min)
    }

    /// What rounding may leave of the rate of L by differences, as the size of terms below which it shows nothing.
    pub(super) fn noise(&self, row: usize) -> f64 {
        let largest = self.lagrangian(row).abs() + self.energy(row).abs();
        largest * f64::EPSILON / (APART * CLEARLY)
    }

    /// δq and D(δq) of a free variation and its rate, both in units of the coordinates' sizes.
    pub(super) fn projected(&self, row: usize, of: &[(f64, f64)]) -> Option<(Vec<f64>, Vec<f64>)> {
        let sized = of.iter().zip(&self.sizes);
        let sized = sized.map(|(w, size)| (w.0 * size, w.1 * size));
        let (eta, rate): (Vec<f64>, Vec<f64>) = sized.unzip();
        let (jacobian, moved) = (self.jacobian(row), self.moved_jacobian(row));
        super::first::projection(self.r, self.n, jacobian, moved, &eta, &rate)
    }

    /// `Σ (L_q + Q) δq + p D(δq)`, and the sizes of its terms.
    pub(super) fn central(&self, row: usize, value: &[f64], moved: &[f64]) -> (f64, f64) {
        let forces = self.slopes(row).iter().zip(self.forces(row));
        let forces = forces.map(|(a, b)| a + b).zip(value);
        let by_value = forces.map(|(a, b)| a * b);
        let by_moved = self.momenta(row).iter().zip(moved).map(|(a, b)| a * b);
        by_value
            .chain(by_moved)
            .fold((0.0, 0.0), |sum, x| (sum.0 + x, sum.1 + x.abs()))
    }
}
