//! Numbers: prime fields for modular proofs, balls for verified enclosures, and the deterministic generator both draw from.
//!
//! Exact rationals are [`dashu_ratio::RBig`] throughout the crate. Floating-point numbers appear here only as *bounds*
//! (degrees, heights, starting guesses), never as values a proof rests on.

pub mod algebraic;
pub mod ball;
pub mod characteristic_polynomial;
pub mod modular_matrix;
pub mod modular_polynomial;
pub mod prime;
pub mod prime_field;
pub mod random;
pub mod reconstruct;
pub mod sturm;
