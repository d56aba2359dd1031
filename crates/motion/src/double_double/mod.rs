//! Motions in double-double arithmetic: about 31 digits, for tolerances down to 10⁻²⁸.
//!
//! Parameters, initial values and times reach the run as [`Precise`] numbers, never through doubles. Routh's equations for all
//! velocities are integrated by their Taylor series; the consistent start, projections, drift, integrals, events and rows are
//! evaluated in the same arithmetic. What is only a direction, such as the Jacobian in a step of Newton, is taken in doubles.

mod flow;
mod functions;
mod observe;
mod run;
mod start;

use chetaev_compile::Lowering;
use chetaev_symbolic::{Expr, Graph};

pub use chetaev_compile::double_double::{decimal, DoubleDouble};
pub use observe::along;

/// The numbers of a run to double-double.
#[derive(Clone, Debug, PartialEq)]
pub struct Precise {
    /// Values of the parameters, in the order of the binding.
    pub parameters: Vec<DoubleDouble>,
    /// Start time.
    pub t_start: DoubleDouble,
    /// End of the run.
    pub t_end: DoubleDouble,
    /// Times of the rows.
    pub times: Vec<DoubleDouble>,
    /// Values of the coordinates, where they are given, and behind them those of the masses with a law of their own.
    pub q: Vec<Option<DoubleDouble>>,
    /// Values of the velocities, where they are given.
    pub v: Vec<Option<DoubleDouble>>,
}

impl Precise {
    /// The same numbers for a run over the rows of another one, as far as that came.
    #[must_use]
    pub fn along(&self, rows: &PreciseRows) -> Precise {
        Precise {
            t_end: rows.t,
            times: rows.times.clone(),
            ..self.clone()
        }
    }
}

/// A run in double-double; the rows of [`Run`](crate::Run) are its nearest doubles.
#[derive(Clone, Debug, PartialEq)]
pub struct PreciseRows {
    /// Values of the parameters, in the order of the binding.
    pub parameters: Vec<DoubleDouble>,
    /// Last time reached.
    pub t: DoubleDouble,
    /// Times of the rows.
    pub times: Vec<DoubleDouble>,
    /// Rows, one after the other.
    pub rows: Vec<DoubleDouble>,
    /// Times and rows of the events, as they stand in [`Run::events`](crate::Run::events).
    pub events: Vec<(DoubleDouble, Vec<DoubleDouble>)>,
}

/// The value of an expression without symbols; `None` where it has none.
pub fn number(g: &Graph, e: Expr) -> Option<DoubleDouble> {
    let program = Lowering::new(g).output("value", &[e]).lower().ok()?;
    let mut made = chetaev_compile::PreciseProgram::new(&program).ok()?;
    made.prepare(&[]).ok()?;
    let value = *made.evaluate(&[]).ok()?.first()?;
    value.is_finite().then_some(value)
}

fn rounded(values: &[DoubleDouble]) -> Vec<f64> {
    values.iter().map(|value| value.high()).collect()
}
