//! When Hamilton's principle is one of stationary action (T1 §4).
//!
//! Standing hypothesis: all active forces are in L. A motion makes `∫L dt` stationary among admissible curves exactly where
//! there are multipliers κ(t) with `Σ κ E[f]·δq = 0` for virtual δq (12) and `κ' = ρ − λ` (13). [`Closure`] decides whether this
//! is so for every motion; where it is not, `cases` finds the motions for which it is, by the same differentiation, with a
//! distinction of cases wherever a coefficient may vanish.

mod cases;
mod closed_form;
mod closure;
mod exceptions;
mod kappa;
mod motion;
mod sets;
mod stationary;
mod suslov;

pub(crate) use closed_form::{short as by_sines, zero_of};
pub use closure::{Closure, Condition, Transport};
pub(crate) use exceptions::Exceptions;
pub(crate) use kappa::{extremal_residuals, free_constant};
pub(crate) use sets::on_sets;
pub use sets::{StationarySet, StationarySets};
pub(crate) use stationary::every_motion;
pub use stationary::Stationary;
pub(crate) use stationary::{of_parameters, NoneBut};
pub use suslov::StationarySuslov;
