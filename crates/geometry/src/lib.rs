//! What can be concluded about a system without integrating it: integrability, first integrals, invariant measures.
//!
//! - [`exterior`], [`cartan`]: exterior calculus and Cartan forms (T3 §2); [`jacobi`]: structure coefficients of frames;
//! - [`integrability`]: Frobenius' condition, and what integrable constraints keep; [`distribution`], [`flag`], [`growth`]: what a
//!   distribution generates;
//! - [`noether`]: first integrals, where they are searched and how they are proved, symmetries, the inverse theorem;
//! - [`measure`]: invariant measures; [`liouville`]: the count of Euler and Jacobi.

pub mod cartan;
pub mod cartan_claim;
pub mod distribution;
pub mod exterior;
pub mod flag;
pub mod growth;
pub mod integrability;
pub mod jacobi;
pub mod liouville;
pub mod measure;
pub mod noether;
mod parameters;

use chetaev_mechanics::Claim;

/// The claims of this crate.
pub static CLAIMS: &[&dyn Claim] = &[
    &integrability::ConstraintsIntegrable,
    &jacobi::FrameJacobi,
    &cartan_claim::Cartan,
    &noether::claims::FamilySearched,
    &noether::claims::FirstIntegral,
    &noether::claims::IntegralOfForm,
    &noether::claims::Killing,
    &noether::claims::Structure,
    &noether::claims::Contraction,
    &noether::claims::EmbeddedField,
    &noether::claims::Inverse,
    &noether::claims::ReducedSymmetry,
    &noether::claims::MovingAxis,
    &noether::claims::MovingDirection,
    &growth::Growth,
    &measure::InvariantMeasure,
    &liouville::Liouville,
];
