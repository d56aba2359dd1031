//! First integrals, invariant densities and multipliers of a motion, by one idea.
mod algebraic;
pub mod ansatz;
pub mod constants;
mod continuation;
pub mod darboux;
mod extactic;
pub mod factors;
pub mod flow;
pub mod lift;
pub mod motion;
mod orbit;
mod polynomial_field;
pub mod unknowns;
