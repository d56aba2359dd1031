//! An estimate of the global error by a second run at a tenth of the tolerance.
//!
//! The tolerance bounds the error of each step, not that of the trajectory (theory: it may grow along the run). For
//! a method whose global error is proportional to the tolerance, the difference of two runs at tolerances τ and τ/10
//! is nine tenths of the error of the first; the estimate divides by that, so that it errs upwards when the second
//! run is better than proportional. It is an estimate, no bound: a chaotic motion, or one where both runs share an
//! error of the equations, is not caught by it.

use crate::integrate::{integrate, Options, Output, StepSize};
use crate::problem::System;
use crate::solution::{Solution, Stop};
use crate::IntegrateError;

/// Estimated error of one component of the output rows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ComponentError {
    /// Largest estimated error over the output times, in the units of the component.
    pub largest: f64,
    /// Time where it occurs.
    pub at: f64,
    /// Largest magnitude of the component over the output times.
    pub magnitude: f64,
}

impl ComponentError {
    /// The error relative to the larger of the component's magnitude and 1.
    pub fn scaled(&self) -> f64 {
        self.largest / self.magnitude.max(1.0)
    }
}

/// Estimated error of a trajectory.
#[derive(Debug, Clone, PartialEq)]
pub struct GlobalError {
    /// Per component of the output rows.
    pub components: Vec<ComponentError>,
    /// Factor by which the error of the second run is expected to be smaller: 10, less near the limit of the method,
    /// 0.1 where the second run had to be a coarser one, 2^p for fixed steps.
    pub ratio: f64,
    /// Last time at which both runs have a row.
    pub until: f64,
    /// Number of rows compared.
    pub rows: usize,
    /// Why the second run ended; the comparison is partial unless it is finished.
    pub stop: Stop,
}

impl GlobalError {
    /// Largest [scaled](ComponentError::scaled) error of all components.
    pub fn largest_scaled(&self) -> f64 {
        self.components
            .iter()
            .map(ComponentError::scaled)
            .fold(0.0, f64::max)
    }
}

/// Repeats a run with tolerances a tenth of those of `options`, and compares at the output times of `solution`.
///
/// `system` must be in the state (chart included) in which the first run found it; `options` are those of the first
/// run, their output and events aside: the second run is made over the span of `solution`, without events.
/// Where a tenth is below what the method resolves, the least tolerance is used, and where that is not at least a
/// factor 2 smaller, a tolerance ten times larger; the estimate is scaled accordingly.
///
/// A run of fixed steps is repeated with half the step, which for a method of order p makes the error 2^p times
/// smaller.
///
/// # Errors
/// As [`integrate()`].
pub fn global_error(
    system: &mut dyn System,
    (t0, y0): (f64, &[f64]),
    solution: &Solution,
    mut options: Options<'_>,
) -> Result<GlobalError, IntegrateError> {
    let ratio = match options.step {
        StepSize::Fixed(h) => {
            options.step = StepSize::Fixed(h / 2.0);
            libm::exp2(f64::from(options.method.order(&options.error)))
        }
        StepSize::Adaptive { .. } => {
            let ratio = tolerance_ratio(&options, y0);
            options.error = options.error.scaled(1.0 / ratio);
            ratio
        }
    };
    options.output = Output::Times(solution.times.clone());
    options.keep_trajectory = false;
    let second = integrate(system, (t0, solution.t), y0, &mut [], options)?;
    Ok(compare(solution, &second, ratio))
}

/// The largest of the usable factors up to 10 between the tolerances, or 1/10.
fn tolerance_ratio(options: &Options<'_>, y0: &[f64]) -> f64 {
    let least = options.method.card().least_tolerance;
    let room = (0..y0.len())
        .map(|i| match options.error.of(i) {
            (rtol, _) if rtol > 0.0 => rtol / least,
            (_, atol) => atol / (least * y0[i].abs()),
        })
        .fold(f64::INFINITY, f64::min);
    // A hair less than the room, so that rounding does not put the second run below the limit.
    let ratio = (room * (1.0 - 1e-12)).min(10.0);
    if ratio >= 2.0 {
        ratio
    } else {
        0.1
    }
}

/// The estimate from two runs with rows at the same times, `second` at tolerances smaller by `ratio`.
pub fn compare(first: &Solution, second: &Solution, ratio: f64) -> GlobalError {
    let rows = first
        .times
        .iter()
        .zip(&second.times)
        .take_while(|(a, b)| a == b)
        .count();
    // |first − second| = |1 − 1/ratio|·error of the first, for errors proportional to the tolerance.
    let share = (1.0 - 1.0 / ratio).abs();
    let components = (0..first.width)
        .map(|i| {
            let mut error = ComponentError {
                largest: 0.0,
                at: first.times.first().copied().unwrap_or(0.0),
                magnitude: 0.0,
            };
            for j in 0..rows {
                let (a, b) = (first.row(j)[i], second.row(j)[i]);
                let difference = (a - b).abs() / share;
                error.magnitude = error.magnitude.max(a.abs());
                if difference > error.largest {
                    (error.largest, error.at) = (difference, first.times[j]);
                }
            }
            error
        })
        .collect();
    GlobalError {
        components,
        ratio,
        until: rows.checked_sub(1).map_or(first.t, |j| first.times[j]),
        rows,
        stop: second.stop,
    }
}
