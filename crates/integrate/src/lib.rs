//! Time stepping of numeric functions; never sees a symbol.
//!
//! [`integrate()`] runs a [`System`] y' = F(t, y) from one time to another with a [`Method`] of the registry and
//! returns a [`Solution`]: rows at the times asked for, events, statistics, notes, and the reason why the run ended.
//! Ending early (an event, a singular state, a step limit, an interruption) is a value, [`Stop`], and keeps what the
//! run has; an [`IntegrateError`] means that the run could not begin.
//!
//! - [`problem`]: what is integrated, and the hooks of a mechanical system (projection, change of chart, halt);
//! - [`mod@method`] and [`methods`]: what a method is, and the methods (Runge–Kutta ones, and Taylor series for systems
//!   that give their coefficients);
//! - [`control`]: error norms, tolerances, step-size control;
//! - [`dense`]: the polynomial of each step; [`event`]: zero crossings located on it;
//! - [`solution`]: results; [`mod@integrate`]: options and the loop;
//! - [`double_double`]: the Taylor method with about 31 digits;
//! - [`mod@global_error`]: a second run at a tenth of the tolerance.
//!
//! Everything is deterministic: no clock, no threads, no global state, fixed orders of summation.

mod collapse;
pub mod compensated;
pub mod control;
mod crowd;
pub mod dense;
pub mod double_double;
mod error;
pub mod event;
pub mod global_error;
pub mod integrate;
mod isolate;
mod locate;
pub mod method;
pub mod methods;
mod output;
pub mod problem;
mod roots;
mod sampling;
pub mod solution;
pub mod stepping;
pub mod stiffness;

pub use control::ErrorControl;
pub use dense::Trajectory;
pub use error::IntegrateError;
pub use event::{Direction, Event, EventKind, EventRecord};
pub use global_error::{global_error, GlobalError};
pub use integrate::{integrate, Options, Output, Progress, StepSize};
pub use method::{method, Method, MethodCard};
pub use problem::{
    from_fn, try_from_fn, ChartChange, Control, EvaluationFailure, HaltReason, Piece, System,
};
pub use solution::{Note, Solution, Statistics, Stop};
pub use stepping::{Expansion, Stepping};
pub use stiffness::StiffnessPolicy;
