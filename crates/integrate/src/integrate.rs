//! Options of a run, and its entry point.

use std::ops::ControlFlow;
use std::sync::atomic::AtomicBool;

use crate::control::ErrorControl;
use crate::event::Event;
use crate::method::{Method, StepperSettings};
use crate::methods::DORMAND_PRINCE_853;
use crate::output::Schedule;
use crate::problem::System;
use crate::solution::Solution;
use crate::stepping::Stepping;
use crate::stiffness::StiffnessPolicy;
use crate::IntegrateError;

/// Which states are recorded as rows. Except with [`Output::Times`], the last state of the run is always recorded,
/// also when the run ends early.
#[derive(Debug, Clone, PartialEq)]
pub enum Output {
    /// Only the last state.
    End,
    /// The initial state and the end of every accepted step.
    Steps,
    /// The times t0 + j·dt, computed as such and not accumulated; dt > 0 also for a run backward in time.
    Every(f64),
    /// These times, in the order of the run and within its span.
    Times(Vec<f64>),
}

/// How long the steps are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum StepSize {
    /// Chosen by the method so that the error estimate stays within the tolerances.
    Adaptive {
        /// Magnitude of the first step; `None` for an automatic choice.
        first: Option<f64>,
        /// Largest magnitude; `None` for no limit but the span.
        most: Option<f64>,
    },
    /// All of this magnitude, except the last.
    Fixed(f64),
}

/// How far a run has come; given to [`Options::progress`] after each step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Progress {
    /// Present time.
    pub t: f64,
    /// Start of the span.
    pub t_start: f64,
    /// End of the span.
    pub t_end: f64,
    /// Accepted steps so far.
    pub steps: u64,
}

/// Options of a run; start from [`Options::tolerance`] or [`Options::fixed_step`] and change fields.
pub struct Options<'a> {
    /// The method.
    pub method: &'static dyn Method,
    /// Tolerances of the local error.
    pub error: ErrorControl,
    /// Step sizes.
    pub step: StepSize,
    /// What is recorded.
    pub output: Output,
    /// Whether a run that ends before the end of its span records the state it has reached although its time was not asked
    /// for.
    pub record_last: bool,
    /// Whether the polynomials of all steps are kept ([`Solution::trajectory`]); memory grows with the steps.
    pub keep_trajectory: bool,
    /// Most accepted steps.
    pub step_limit: u64,
    /// What to do about stiffness.
    pub stiffness: StiffnessPolicy,
    /// Whether increments of the state are summed with compensation.
    pub compensated: bool,
    /// When this becomes true, the run ends after the present step and keeps what it has.
    pub interrupt: Option<&'a AtomicBool>,
    /// Called after each step; [`ControlFlow::Break`] ends the run as an interruption.
    pub progress: Option<&'a mut dyn FnMut(Progress) -> ControlFlow<()>>,
}

impl std::fmt::Debug for Options<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Options")
            .field("method", &self.method.card().name)
            .field("error", &self.error)
            .field("step", &self.step)
            .field("output", &self.output)
            .finish_non_exhaustive()
    }
}

impl<'a> Options<'a> {
    /// Order 8, adaptive steps with this relative and absolute tolerance, rows at every step, compensated sums, a
    /// limit of ten million steps, and a stop when the problem is found stiff after 100 000 steps.
    pub fn tolerance(tolerance: f64) -> Options<'a> {
        Options {
            method: &DORMAND_PRINCE_853,
            error: ErrorControl::uniform(tolerance),
            step: StepSize::Adaptive {
                first: None,
                most: None,
            },
            output: Output::Steps,
            record_last: false,
            keep_trajectory: false,
            step_limit: 10_000_000,
            stiffness: StiffnessPolicy::StopAfter(100_000),
            compensated: true,
            interrupt: None,
            progress: None,
        }
    }

    /// The same with steps of fixed magnitude h and no error control.
    pub fn fixed_step(method: &'static dyn Method, h: f64) -> Options<'a> {
        Options {
            method,
            step: StepSize::Fixed(h),
            ..Options::tolerance(1e-6)
        }
    }

    /// The same with another method.
    #[must_use]
    pub fn method(mut self, method: &'static dyn Method) -> Options<'a> {
        self.method = method;
        self
    }

    /// The same with another choice of rows.
    #[must_use]
    pub fn output(mut self, output: Output) -> Options<'a> {
        self.output = output;
        self
    }

    /// The same options once more, without the progress callback, for another run such as
    /// [`global_error`](crate::global_error()).
    pub fn again(&self) -> Options<'a> {
        Options {
            method: self.method,
            error: self.error.clone(),
            step: self.step,
            output: self.output.clone(),
            record_last: self.record_last,
            keep_trajectory: self.keep_trajectory,
            step_limit: self.step_limit,
            stiffness: self.stiffness,
            compensated: self.compensated,
            interrupt: self.interrupt,
            progress: None,
        }
    }

    pub(crate) fn settings(&self) -> StepperSettings {
        StepperSettings {
            error: self.error.clone(),
            fixed: matches!(self.step, StepSize::Fixed(_)),
            compensated: self.compensated,
            stiffness: self.stiffness != StiffnessPolicy::Off,
        }
    }

    fn check(&self, (t0, t_end): (f64, f64), y0: &[f64]) -> Result<(), IntegrateError> {
        if !(t0.is_finite() && t_end.is_finite() && (t_end - t0).is_finite()) {
            return Err(IntegrateError::InvalidSpan {
                start: t0,
                end: t_end,
            });
        }
        if let Some(component) = y0.iter().position(|y| !y.is_finite()) {
            return Err(IntegrateError::InitialNotFinite { component });
        }
        let card = self.method.card();
        let (what, sizes) = match self.step {
            StepSize::Fixed(h) => ("the step size", [Some(h), None]),
            StepSize::Adaptive { first, most } => {
                if !card.adaptive {
                    return Err(IntegrateError::FixedStepRequired { method: card.name });
                }
                self.error.check(card, y0)?;
                ("a limit of the step size", [first, most])
            }
        };
        for found in sizes.into_iter().flatten() {
            if !(found > 0.0 && found.is_finite()) {
                return Err(IntegrateError::InvalidInterval { what, found });
            }
        }
        Ok(())
    }
}

/// Integrates `system` over the span (t0, t_end) from the state `y0`.
///
/// The span may run backward (t_end < t0) or be empty. The events are numbered by their position in `events`.
///
/// # Errors
/// [`IntegrateError`] if the question makes no sense or asks for what the method cannot give: wrong lengths, values
/// that are not finite, tolerances that are negative or below 100 units of relative rounding for Runge–Kutta
/// methods (theory: the error estimate is a difference of nearly equal numbers; the Taylor method goes down to the
/// rounding of one operation), a method that needs Taylor coefficients of a system without. Everything that happens later is a
/// [`Stop`](crate::Stop) in the solution.
pub fn integrate(
    system: &mut dyn System,
    span: (f64, f64),
    y0: &[f64],
    events: &mut [Event<'_>],
    options: Options<'_>,
) -> Result<Solution, IntegrateError> {
    let mut stepping = Stepping::new(system, span, y0, events, options)?;
    while stepping.advance(system, events) {}
    Ok(stepping.finish(system))
}

impl<'o> Stepping<'o> {
    /// A run that [`integrate`] would make, to be made step by step; `events` are the same at every step.
    ///
    /// # Errors
    /// As [`integrate`].
    pub fn new(
        system: &dyn System,
        span: (f64, f64),
        y0: &[f64],
        events: &mut [Event<'_>],
        options: Options<'o>,
    ) -> Result<Stepping<'o>, IntegrateError> {
        let expected = system.dimension();
        if y0.len() != expected {
            return Err(IntegrateError::Dimension {
                what: "the initial state",
                expected,
                found: y0.len(),
            });
        }
        options.check(span, y0)?;
        let card = options.method.card();
        if card.needs_series && !system.has_series() {
            return Err(IntegrateError::NoSeries { method: card.name });
        }
        let schedule = Schedule::new(&options.output, span)?;
        Ok(Stepping::checked(
            system, span, y0, events, options, schedule,
        ))
    }
}
