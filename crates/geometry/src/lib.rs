//! What can be concluded about a system without integrating it: integrability, distributions.

pub mod cartan;
pub mod cartan_claim;
pub mod distribution;
pub mod integrability;
pub mod jacobi;
pub mod noether;

use chetaev_mechanics::Claim;

/// The claims of this crate.
pub static CLAIMS: &[&dyn Claim] = &[
    &integrability::ConstraintsIntegrable,
    &jacobi::FrameJacobi,
    &cartan_claim::Cartan,
    &noether::claims::FamilySearched,
    &noether::claims::FirstIntegral,
    &noether::claims::Killing,
    &noether::claims::Structure,
    &noether::claims::Contraction,
    &noether::claims::EmbeddedField,
    &noether::claims::Inverse,
];
