//! A question asked of a model: run, compare, collect verdicts, render.
//!
//! [`study::study`] takes a resolved model through its claims and its motion; [`record`] writes `study.json`,
//! [`page`] the report, [`table`] the trajectory, [`summary`] the text for a terminal; [`verify`] replays a record.
//! Clocks, files and interruption come from outside.
//!
//! - [`study`](mod@study): the loop over the claims of [`registry`](mod@registry), with its budget; [`options`], [`error`];
//! - the run: [`motion_evidence`] (what a run tells), [`motion_claims`], [`method_order`], [`jumps`], [`witness`] (integrals of the
//!   principles over the motion), [`beside`] (the constrained extremum beside the motion);
//! - [`sweep`]: a model as an ensemble; [`steady`](mod@steady): all steady motions; [`stability`](mod@stability): linear equations about one; [`follow`](mod@follow): steady motions and orbits over a range of a parameter; [`sensitivity`](mod@sensitivity): derivatives of a motion; [`functional`]: summary, record
//!   and page of a functional of fields over space;
//! - for people: [`derivation`], [`board`](mod@board) (it step by step), [`written`] (equations in every notation), [`explanation`],
//!   [`overview`], [`story`], [`summary`], [`page`], [`picture`], [`typeset`]; for programs: [`record`] with the model lowered ([`flat`]) and
//!   the equations of every formulation ([`stated_equations`]), [`table`]; [`verify`].

mod axes;
pub mod beside;
pub mod board;
mod decimals;
pub mod derivation;
pub mod error;
mod expectations;
pub mod explanation;
pub mod flat;
pub mod follow;
pub mod free;
pub mod functional;
pub mod jumps;
mod kept;
mod layout;
pub mod method_order;
pub mod motion_claims;
pub mod motion_evidence;
mod notices;
pub mod options;
pub mod overview;
pub mod page;
pub mod picture;
mod placed;
mod plain;
mod precise;
mod preparation;
pub mod record;
pub mod registry;
pub mod sensitivity;
pub mod stability;
pub mod start;
pub mod state_space;
pub mod stated_equations;
pub mod steady;
pub mod story;
pub mod study;
pub mod summary;
pub mod sweep;
pub mod table;
pub mod typeset;
pub mod verify;
mod watch;
pub mod witness;
pub mod written;

pub use error::{StudyError, UnknownClaim};
pub use options::{ClaimSelection, Hooks, StudyOptions};
pub use placed::{diagnostics, placed};
pub use registry::registry;
pub use study::{check, study, study_telling, Decided, Motion, Outcome, Study};
pub use watch::{in_time, interruptible};
