//! Positions and velocities back on the constraints, by steps of least kinetic norm (T5 §5.6).

use crate::chart::heaviness;
use crate::least_norm::least_step;
use crate::numeric::{NumericSystem, States};
use crate::run::RunSettings;

/// A projection on the constraints after a step.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Projection {
    /// Residuals up to this part of the velocities (or positions) are left; `None` where nothing is projected.
    bound: Option<f64>,
}

/// What rounding leaves of a residual, as a part of the velocities, where coordinates are of order one. An angle of many turns
/// is rounded to less; a projection on what the constraints are there would let the reactions do work.
const ROUNDED: f64 = 8.0 * f64::EPSILON;
/// Residuals far below the tolerance do no harm, since the motion keeps the values of the constraints; each projection
/// restarts the method and rounds the state.
const HARMLESS: f64 = 0.1;
/// Newton steps at most.
const MOST: usize = 10;

impl Projection {
    /// No projection.
    pub(crate) const NONE: Projection = Projection { bound: None };

    /// The projection of a run.
    pub(crate) fn of(settings: &RunSettings) -> Projection {
        let tolerance = match settings.step {
            Some(_) => 0.0,
            // Relative, as the bound is.
            None => settings.tolerance,
        };
        let bound = (HARMLESS * tolerance).max(ROUNDED);
        Projection {
            bound: settings.project.then_some(bound),
        }
    }

    /// The states at which rates are asked for: what is not brought back strays.
    pub(crate) fn states(self) -> States {
        match self.bound {
            Some(_) => States::Admissible,
            None => States::All,
        }
    }

    /// Moves (q, v), the state at which the system was last evaluated at time t; true when they changed. Nothing is moved where the
    /// equations have no value.
    pub(crate) fn apply(
        self,
        system: &mut NumericSystem,
        t: f64,
        q: &mut [f64],
        v: &mut [f64],
    ) -> bool {
        let Some(bound) = self.bound else {
            return false;
        };
        let positions = positions(system, t, (q, v), bound);
        velocities(system, t, (q, v), (bound, positions)) || positions
    }
}

/// Newton on the holonomic constraints.
fn positions(
    system: &mut NumericSystem,
    t: f64,
    (q, v): (&mut [f64], &[f64]),
    mut bound: f64,
) -> bool {
    if system.holonomic.is_empty() {
        return false;
    }
    let (n, mut changed) = (system.n, false);
    for _ in 0..MOST {
        let known = system.evaluate_positions(t, q, v);
        let of = |system: &NumericSystem| {
            let rows = (system.position_residual(), system.position_gradient());
            is_small(rows, q, system, bound)
        };
        if known.is_err() || of(system) {
            break;
        }
        // The metric is that of the last evaluation, at the state from which the projection starts.
        let (gradient, residual) = (system.position_gradient(), system.position_residual());
        let step = least_step(gradient, residual, n, &all(n), &system.metric());
        q.iter_mut().zip(&step).for_each(|(q, dq)| *q -= dq);
        (changed, bound) = (true, ROUNDED);
    }
    changed
}

/// Newton on the velocity constraints, which takes one step where they are affine. They are evaluated first where the positions
/// have moved.
fn velocities(
    system: &mut NumericSystem,
    t: f64,
    (q, v): (&[f64], &mut [f64]),
    (bound, mut has_moved): (f64, bool),
) -> bool {
    let directing = q.iter().zip(&system.directing).filter(|(_, &is)| is);
    let rounded = ROUNDED * directing.fold(1.0, |m: f64, (q, _)| m.max(q.abs()));
    let mut bound = bound.max(rounded);
    let (n, mut changed) = (system.n, false);
    let most = if system.is_affine() { 1 } else { MOST };
    for _ in 0..most {
        let is_unknown = has_moved && system.evaluate(t, q, v).is_err();
        let rows = (system.residual(), system.jacobian());
        if is_unknown || is_small(rows, v, system, bound) {
            break;
        }
        has_moved = true;
        let (jacobian, residual) = (system.jacobian(), system.residual());
        let step = least_step(jacobian, residual, n, &all(n), &system.metric());
        v.iter_mut().zip(&step).for_each(|(v, dv)| *v -= dv);
        (changed, bound) = (true, rounded);
    }
    changed
}

/// Whether residuals are small beside what the whole of x could make of them, in the metric of the masses: the length of the gradient times
/// that of x.
fn is_small(
    (residual, gradient): (&[f64], &[f64]),
    x: &[f64],
    system: &NumericSystem,
    bound: f64,
) -> bool {
    let (n, mass) = (system.n, system.mass());
    let weight = |j: usize| heaviness(mass[j * n + j]);
    let square: f64 = (0..n).map(|j| weight(j) * x[j] * x[j]).sum();
    let rows = gradient.chunks(n.max(1)).zip(residual);
    let mut all = rows.map(|(row, f)| {
        let length: f64 = (0..n).map(|j| row[j] * row[j] / weight(j)).sum();
        f.abs() <= bound * (length * square).sqrt()
    });
    all.all(|is_small| is_small)
}

fn all(n: usize) -> Vec<usize> {
    (0..n).collect()
}
