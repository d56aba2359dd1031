//! What a time-stepping method is to the rest of the crate.
//!
//! Nothing here assumes stages: a method is given a state and a proposed step, and answers with a step that it took
//! (perhaps a shorter or longer one, as a Taylor method does), whether it accepts it, and what it proposes next.

use crate::compensated::{add_increment, Time};
use crate::control::ErrorControl;
use crate::dense::DenseStep;
use crate::methods;
use crate::problem::{EvaluationFailure, System};
use crate::IntegrateError;

/// The public face of a method: plain data.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MethodCard {
    /// Name used in model files and in [`method`].
    pub name: &'static str,
    /// Full name for people.
    pub title: &'static str,
    /// Order of the solution at step ends; 0 where it follows from the tolerance ([`Method::order`]).
    pub order: u32,
    /// Order of the dense output: its error at interior points of a step is O(h^(dense_order + 1)); 0 where it is that
    /// of the step.
    pub dense_order: u32,
    /// Whether the method estimates its error, and so can choose its step size.
    pub adaptive: bool,
    /// Least relative tolerance that the error estimate resolves in double precision; 0 where there is no limit.
    pub least_tolerance: f64,
    /// Whether the method needs Taylor coefficients ([`System::expand`]).
    pub needs_series: bool,
    /// Where the method and its coefficients come from.
    pub source: &'static str,
}

/// A time-stepping method: its card, and a maker of the working storage for one run.
pub trait Method: Sync {
    /// The public face.
    fn card(&self) -> &MethodCard;

    /// Order of the solution at step ends under these tolerances.
    fn order(&self, error: &ErrorControl) -> u32 {
        let _ = error;
        self.card().order
    }

    /// Working storage for one run of a system of dimension n.
    fn stepper(&self, n: usize, settings: &StepperSettings) -> Box<dyn Stepper>;
}

/// What a stepper has to know of the options of a run.
#[derive(Debug, Clone, PartialEq)]
pub struct StepperSettings {
    /// Tolerances of the local error.
    pub error: ErrorControl,
    /// Steps are of the proposed size and always accepted.
    pub fixed: bool,
    /// Whether increments of the state are added with compensation.
    pub compensated: bool,
    /// Whether [`Attempt::stiffness`] is wanted.
    pub stiffness: bool,
}

/// Time and state at one end of a step; the state is y + carry, |carry| at most half an ulp of y.
#[derive(Debug, Clone, PartialEq)]
pub struct State {
    /// The time.
    pub t: Time,
    /// The state, rounded.
    pub y: Vec<f64>,
    /// What is lost by the rounding; zero without compensated summation.
    pub carry: Vec<f64>,
}

impl State {
    /// The state y at time t, exactly.
    pub fn exact(t: f64, y: &[f64]) -> State {
        State {
            t: Time::exact(t),
            y: y.to_vec(),
            carry: vec![0.0; y.len()],
        }
    }

    /// Sets `self` to `from` advanced by h in time and by `increment` in state.
    pub fn advance(&mut self, compensated: bool, from: &State, h: f64, increment: &[f64]) {
        self.t = from.t.plus(h);
        add_increment(
            compensated,
            (&from.y, &from.carry),
            increment,
            (&mut self.y, &mut self.carry),
        );
    }
}

/// Outcome of one attempted step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Attempt {
    /// Whether the error is within the tolerances.
    pub accepted: bool,
    /// Signed length of the step taken.
    pub h: f64,
    /// Signed length proposed for the next step, or for the next attempt after a rejection.
    pub next: f64,
    /// Estimated error in units of the tolerance.
    pub error: f64,
    /// Component with the largest error.
    pub worst: usize,
    /// Estimate of |eigenvalue|·h divided by the bound of the method's stability region, where it was wanted and
    /// the method has such a bound.
    pub stiffness: Option<f64>,
}

/// A method at work on one run.
///
/// Order of calls: [`start`](Stepper::start); then [`attempt`](Stepper::attempt) until one is accepted; then
/// [`dense`](Stepper::dense) if it is wanted; then [`commit`](Stepper::commit). When the state or the chart was
/// changed from outside, [`restart`](Stepper::restart) before the next attempt.
pub trait Stepper {
    /// Prepares for a run from `from` in the given direction (±1) over a span, and proposes the length (positive)
    /// of the first step; 0 where steps are fixed.
    ///
    /// # Errors
    /// The failure of an evaluation at the initial state.
    fn start(
        &mut self,
        system: &mut dyn System,
        from: &State,
        direction: f64,
        span: f64,
    ) -> Result<f64, EvaluationFailure>;

    /// Forgets everything that depends on the state or the chart, but not the memory of the step-size control.
    ///
    /// # Errors
    /// The failure of an evaluation at the state.
    fn restart(&mut self, system: &mut dyn System, from: &State) -> Result<(), EvaluationFailure>;

    /// The order of the expansion at `from` that the next attempt begins with, where it begins with one; `is_changed` where
    /// the state was changed since the last.
    fn next_expansion(&mut self, from: &State, is_changed: bool) -> Option<usize> {
        let _ = (from, is_changed);
        None
    }

    /// Takes that expansion, which was made elsewhere: `row` writes the coefficients of an order j ≥ 1, all of which are finite.
    /// The next attempt has the bits that it has otherwise.
    fn take_series(&mut self, row: &dyn Fn(usize, &mut [f64])) {
        let _ = row;
    }

    /// The signed length that an attempt of length `h` from a state has at first.
    fn limited(&self, from: &State, h: f64) -> f64 {
        let _ = from;
        h
    }

    /// Takes what the series taken before gives at the end of a step of length `h`, the length that the next attempt has: the
    /// increment `Σ_{j≥1} x_[j] h^j` and its derivative, by Horner's scheme for both at once, a product rounded before it is added.
    /// Writes the end into `to`, which that attempt finds there.
    fn take_end(&mut self, (from, to): (&State, &mut State), h: f64, end: (&[f64], &[f64])) {
        let _ = (from, to, h, end);
    }

    /// Attempts a step of signed length at most `h` from `from` and writes its end into `to`.
    ///
    /// # Errors
    /// The failure of an evaluation inside the step; the step counts as rejected.
    fn attempt(
        &mut self,
        system: &mut dyn System,
        from: &State,
        h: f64,
        to: &mut State,
    ) -> Result<Attempt, EvaluationFailure>;

    /// Tells the step-size control that the last step was given up for a reason other than its error.
    fn failed(&mut self);

    /// Writes the polynomial of the step last attempted, which was accepted and not yet committed.
    ///
    /// # Errors
    /// The failure of an evaluation made for it.
    fn dense(
        &mut self,
        system: &mut dyn System,
        from: &State,
        to: &State,
        dense: &mut DenseStep,
    ) -> Result<(), EvaluationFailure>;

    /// Makes the end of the step last attempted the start of the next.
    fn commit(&mut self);

    /// Number of evaluations of F so far.
    fn evaluations(&self) -> u64;
}

/// The method of the given name.
///
/// # Errors
/// [`IntegrateError::UnknownMethod`], with the names that exist.
pub fn method(name: &str) -> Result<&'static dyn Method, IntegrateError> {
    methods::METHODS
        .iter()
        .copied()
        .find(|m| m.card().name == name)
        .ok_or_else(|| IntegrateError::UnknownMethod {
            name: name.to_owned(),
            known: methods::METHODS
                .iter()
                .map(|m| m.card().name)
                .collect::<Vec<_>>()
                .join(", "),
        })
}
