//! Whether a motion leaves a constraint by a jump: a constraint may end at the branch cut of an angle, where its value jumps
//! while its derivatives, and with them the equations of motion, go on.

use crate::least_norm::norm;
use crate::numeric::NumericSystem;

/// Residuals and velocities at the last accepted state, from which those of a step differ by little if they are continuous.
#[derive(Clone, Debug, Default)]
pub(crate) struct Anchor {
    /// Time of the state.
    pub(crate) t: f64,
    residual: Vec<f64>,
    position: Vec<f64>,
    v: Vec<f64>,
    /// Largest velocity and largest coordinate so far.
    speed: f64,
    reach: f64,
}

/// A residual has jumped when the constraint has moved away by this fraction of the velocities (or coordinates).
const JUMP: f64 = 0.5;
/// Small velocities are measured by this fraction of the largest so far.
const SMALL: f64 = 1e-3;
/// Velocities below this are none.
const NONE: f64 = 1e-9;

impl Anchor {
    /// Takes the state at which `system` was last evaluated for an accepted one.
    pub(crate) fn settle(&mut self, system: &NumericSystem, t: f64, q: &[f64], v: &[f64]) {
        self.t = t;
        copy(&mut self.residual, system.residual());
        copy(&mut self.position, system.position_residual());
        copy(&mut self.v, v);
        self.speed = self.speed.max(largest(v));
        self.reach = self.reach.max(largest(q));
    }

    /// The row whose velocity constraint at the state last evaluated lies apart from the anchor.
    pub(crate) fn left(&self, system: &NumericSystem, v: &[f64]) -> Option<usize> {
        let size = largest(v).max(SMALL * self.speed) + NONE;
        let (jacobian, residual) = (system.jacobian(), system.residual());
        let apart = |row: usize, n: usize| {
            let gradient = &jacobian[row * n..(row + 1) * n];
            let jump = (residual[row] - self.residual[row]).abs();
            // The largest entry says it mostly, without a root.
            jump > JUMP * largest(gradient) * size && jump > JUMP * norm(gradient) * size
        };
        (0..self.residual.len().min(system.r)).find(|&row| apart(row, system.n))
    }

    /// The row whose holonomic constraint at the position last evaluated lies apart from the anchor.
    pub(crate) fn left_position(&self, system: &NumericSystem, q: &[f64]) -> Option<usize> {
        let size = largest(q).max(self.reach) + NONE;
        let apart = |index: usize, n: usize| {
            let gradient = norm(&system.position_gradient()[index * n..(index + 1) * n]);
            let jump = (system.position_residual()[index] - self.position[index]).abs();
            jump > JUMP * gradient * size
        };
        (0..self.position.len().min(system.holonomic.len()))
            .find(|&index| apart(index, system.n))
            .map(|index| system.holonomic[index])
    }

    /// Whether a dependent velocity, solved for from the constraints, lies apart from the anchor.
    pub(crate) fn left_velocity(&self, v: &[f64], dependent: &[usize]) -> Option<usize> {
        let size = largest(v).max(largest(&self.v)).max(SMALL * self.speed) + NONE;
        let apart = |d: usize| (v[d] - self.v[d]).abs() > JUMP * size;
        dependent.iter().position(|&d| d < self.v.len() && apart(d))
    }
}

fn copy(to: &mut Vec<f64>, from: &[f64]) {
    to.clear();
    to.extend_from_slice(from);
}

fn largest(x: &[f64]) -> f64 {
    x.iter().fold(0.0, |m: f64, x| m.max(x.abs()))
}
