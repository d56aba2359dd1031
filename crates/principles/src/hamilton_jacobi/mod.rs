//! The generalized method of Hamilton and Jacobi (T1 §6.1; Rumyantsev 1982).
//!
//! The constrained extremum for `L + Σ κ f` has the momenta `π = p + Σ κ ∂f/∂v` and the Hamiltonian `H₁ = Σ π v − L`; its
//! solutions are the characteristics of `S_t + H₁(q, S_q, t) = 0`. They are motions of the nonholonomic system exactly where
//! Hamilton's principle is one of stationary action, with the κ found there; r of the 2n constants of a complete integral are
//! fixed by that.

mod applicable;
mod complete;
mod elementary;
mod extremum;
mod separation;

pub use applicable::{momenta_on_motions, Applicable};
pub use complete::{verified, Checked};
pub use elementary::{elementary, Antiderivative};
pub use extremum::Extremum;
pub use separation::{levi_civita, separated};
