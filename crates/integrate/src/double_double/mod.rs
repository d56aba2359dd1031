//! The Taylor method in double-double arithmetic: tolerances down to 10⁻²⁸.
//!
//! Order and step are chosen by the rule of [`methods::TAYLOR`](crate::methods::TAYLOR); the state, the time, the sums of the
//! series and the times of rows and events are double-double. A system gives its coefficients in the same arithmetic
//! ([`PreciseSystem::expand`]).
//!
//! ```
//! use chetaev_double_double::DoubleDouble;
//! use chetaev_integrate::double_double::{integrate, PreciseOptions, PreciseSystem};
//! use chetaev_integrate::EvaluationFailure;
//!
//! /// y' = y
//! struct Growth;
//!
//! impl PreciseSystem for Growth {
//!     fn dimension(&self) -> usize {
//!         1
//!     }
//!
//!     fn expand(
//!         &mut self,
//!         _t: DoubleDouble,
//!         y: &[DoubleDouble],
//!         order: usize,
//!         coefficients: &mut [DoubleDouble],
//!     ) -> Result<(), EvaluationFailure> {
//!         coefficients[0] = y[0];
//!         for j in 1..=order {
//!             coefficients[j] = coefficients[j - 1] / DoubleDouble::from(j as f64);
//!         }
//!         Ok(())
//!     }
//! }
//!
//! let (zero, one) = (DoubleDouble::ZERO, DoubleDouble::ONE);
//! let run = integrate(&mut Growth, (zero, one), &[one], &[], PreciseOptions::tolerance(1e-28))?;
//! let error = run.state[0] - one.exp();
//! assert!(error.abs().high() < 1e-28);
//! # Ok::<(), chetaev_integrate::IntegrateError>(())
//! ```

mod events;
mod expansion;
mod run;

use crate::event::{Direction, EventKind};
use crate::integrate::Progress;
use crate::problem::EvaluationFailure;
use crate::solution::{Note, Statistics, Stop};
use crate::IntegrateError;
use chetaev_double_double::DoubleDouble;
use std::ops::ControlFlow;
use std::sync::atomic::AtomicBool;

pub use run::integrate;

/// The least relative tolerance.
pub const LEAST_TOLERANCE: f64 = 1e-28;

/// A first-order system y' = F(t, y) that gives its Taylor coefficients in double-double arithmetic.
pub trait PreciseSystem {
    /// Number of components of y.
    fn dimension(&self) -> usize;

    /// Writes the normalized coefficients y⁽ʲ⁾/j! of the solution through (t, y), j = 0 … order, one order after the other.
    ///
    /// # Errors
    /// The reason why there is no such series.
    fn expand(
        &mut self,
        t: DoubleDouble,
        y: &[DoubleDouble],
        order: usize,
        coefficients: &mut [DoubleDouble],
    ) -> Result<(), EvaluationFailure>;

    /// Called once after each accepted step, at its end. Whether it changed y.
    fn accepted(&mut self, t: DoubleDouble, y: &mut [DoubleDouble]) -> bool {
        let _ = (t, y);
        false
    }

    /// Number of components of an output row; by default the dimension.
    fn output_dimension(&self) -> usize {
        self.dimension()
    }

    /// Writes the row that is recorded for the state y at time t; by default the state itself.
    ///
    /// # Errors
    /// The reason why the row has no value; the run stops there.
    fn output(
        &mut self,
        t: DoubleDouble,
        y: &[DoubleDouble],
        row: &mut [DoubleDouble],
    ) -> Result<(), EvaluationFailure> {
        let _ = t;
        row.copy_from_slice(y);
        Ok(())
    }

    /// Value of switching function number `index`, whose zeros are events.
    ///
    /// # Errors
    /// The reason why it has no value; by default there are no switching functions.
    fn switching(
        &mut self,
        index: usize,
        t: DoubleDouble,
        y: &[DoubleDouble],
    ) -> Result<DoubleDouble, EvaluationFailure> {
        let _ = (t, y);
        Err(EvaluationFailure::Domain { operation: index })
    }

    /// Whether a zero of switching function number `index` at (t, y) is an event at all.
    fn is_event(&mut self, index: usize, t: DoubleDouble, y: &[DoubleDouble]) -> bool {
        let _ = (index, t, y);
        true
    }
}

/// Which zeros of a switching function of the system are looked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PreciseEvent {
    /// Which crossings count.
    pub direction: Direction,
    /// Whether the first one ends the run.
    pub stops: bool,
}

/// One zero of one switching function.
#[derive(Clone, Debug, PartialEq)]
pub struct PreciseEventRecord {
    /// Time of the zero.
    pub t: DoubleDouble,
    /// Number of the event.
    pub index: usize,
    /// Kind of zero.
    pub kind: EventKind,
    /// Output row there.
    pub row: Vec<DoubleDouble>,
}

/// Options of a run.
pub struct PreciseOptions<'a> {
    /// Relative tolerance.
    pub rtol: f64,
    /// Absolute tolerance.
    pub atol: f64,
    /// Components measured absolutely; none where empty.
    pub absolute: Vec<bool>,
    /// Steps of this size without control of the error.
    pub step: Option<f64>,
    /// Times of the rows, in the direction of the run.
    pub times: Vec<DoubleDouble>,
    /// Most accepted steps.
    pub step_limit: u64,
    /// When this becomes true, the run ends after the present step and keeps what it has.
    pub interrupt: Option<&'a AtomicBool>,
    /// Called after each step; [`ControlFlow::Break`] ends the run as an interruption.
    pub progress: Option<&'a mut dyn FnMut(Progress) -> ControlFlow<()>>,
}

impl PreciseOptions<'_> {
    /// The same relative and absolute tolerance, no rows, a limit of ten million steps.
    pub fn tolerance(tolerance: f64) -> Self {
        PreciseOptions {
            rtol: tolerance,
            atol: tolerance,
            absolute: Vec::new(),
            step: None,
            times: Vec::new(),
            step_limit: 10_000_000,
            interrupt: None,
            progress: None,
        }
    }

    /// The tolerated error of component i of this size.
    fn tolerated(&self, i: usize, size: f64) -> f64 {
        let relative = if self.is_relative(i) {
            self.rtol * size
        } else {
            0.0
        };
        (self.atol + relative).max(f64::MIN_POSITIVE)
    }

    fn is_relative(&self, i: usize) -> bool {
        let is_absolute = self.absolute.get(i).copied().unwrap_or(false);
        self.rtol > 0.0 && !is_absolute
    }
}

impl std::fmt::Debug for PreciseOptions<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("PreciseOptions")
            .field("rtol", &self.rtol)
            .field("atol", &self.atol)
            .field("step", &self.step)
            .finish_non_exhaustive()
    }
}

/// A trajectory in double-double arithmetic.
#[derive(Clone, Debug, PartialEq)]
pub struct PreciseSolution {
    /// Why the run ended.
    pub stop: Stop,
    /// Time of the last state.
    pub t: DoubleDouble,
    /// The last state.
    pub state: Vec<DoubleDouble>,
    /// Times of the rows; behind those asked for that of an early end.
    pub times: Vec<DoubleDouble>,
    /// The rows, one after the other.
    pub rows: Vec<DoubleDouble>,
    /// Events in the order of time along the run.
    pub events: Vec<PreciseEventRecord>,
    /// Remarks.
    pub notes: Vec<Note>,
    /// Counts.
    pub statistics: Statistics,
}

fn check(
    options: &PreciseOptions<'_>,
    (start, end): (DoubleDouble, DoubleDouble),
    y: &[DoubleDouble],
) -> Result<(), IntegrateError> {
    if !(start.is_finite() && end.is_finite()) {
        let (start, end) = (start.high(), end.high());
        return Err(IntegrateError::InvalidSpan { start, end });
    }
    if let Some(component) = y.iter().position(|y| !y.is_finite()) {
        return Err(IntegrateError::InitialNotFinite { component });
    }
    let (rtol, atol) = (options.rtol, options.atol);
    if !(rtol.is_finite() && atol.is_finite() && rtol >= 0.0 && atol >= 0.0 && rtol + atol > 0.0) {
        let component = 0;
        return Err(IntegrateError::InvalidTolerance {
            component,
            rtol,
            atol,
        });
    }
    let requested = if rtol > 0.0 { rtol } else { atol };
    if requested < LEAST_TOLERANCE {
        return Err(IntegrateError::PreciseToleranceTooSmall { requested });
    }
    if let Some(found) = options.step.filter(|h| !(*h > 0.0 && h.is_finite())) {
        let what = "the step size";
        return Err(IntegrateError::InvalidInterval { what, found });
    }
    let is_backward = end < start;
    let mut last = start;
    for (index, &time) in options.times.iter().enumerate() {
        let is_in_order = match is_backward {
            true => time <= last && time >= end,
            false => time >= last && time <= end,
        };
        if !is_in_order {
            let time = time.high();
            return Err(IntegrateError::InvalidOutputTime { index, time });
        }
        last = time;
    }
    Ok(())
}
