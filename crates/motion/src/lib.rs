//! Numerical motion of a system: charts, consistent initial data, projection, reactions, drift.
//!
//! Knows numbers and systems, nothing of files or reports. [`run::Subject`] integrates one formulation;
//! [`observe`] evaluates expressions along the rows; [`double_double`] does both with about 31 digits.
//!
//! - the start: [`initial`] (consistent data, branches of the highest derivatives);
//! - what is integrated: [`multiplier_flow`] (Routh, solved at each state), [`formulation_flow`] (any other form in its own state),
//!   [`jet_flow`] (constraints of order two and more), on [`numeric`] terms, with [`chart`]s of independent velocities;
//! - on the way: [`watch`] (what makes the equations singular), [`crossing`] (where the rank of the constraints falls), [`component`] (constraints that are products, and where their components meet), [`happening`] (events), [`follow`] (what is conserved), [`drift`],
//!   [`keep`] (projection on integrals), [`stop`] (why a run ended);
//! - many runs: [`repeat`] (compiled once, for many starts and parameters).

pub mod accelerations;
mod along;
pub mod chart;
pub mod component;
mod course;
pub mod crossing;
pub mod dense;
pub mod double_double;
pub mod drift;
pub mod factors;
pub mod follow;
pub mod formulation_flow;
pub mod functions;
pub mod happening;
pub mod initial;
pub mod jet_flow;
pub mod keep;
mod least_norm;
mod leaving;
mod meeting;
pub mod multiplier_flow;
mod nearest;
pub mod numeric;
pub mod observe;
mod positive;
mod projection;
mod reduced;
pub mod repeat;
pub mod row;
pub mod run;
pub mod scales;
pub mod series;
mod sticking;
pub mod stop;
pub mod turns;
pub mod watch;

pub use component::Component;
pub use double_double::{DoubleDouble, Precise, PreciseRows};
pub use happening::{EventWatched, Happened};
pub use initial::{consistent_state, ConsistentState, InitialData, InitialError};
pub use least_norm::least_squares;
pub use multiplier_flow::StateKind;
pub use numeric::{Binding, NumericError, NumericSystem};
pub use repeat::{CompiledRouth, RouthCourse, SideBySide};
pub use row::RowLayout;
pub use run::{Run, RunError, RunSettings, Subject, Watcher};
