//! What can be concluded about a system without integrating it: integrability, distributions.

pub mod cartan;
pub mod distribution;
pub mod integrability;

use chetaev_mechanics::Claim;

/// The claims of this crate.
pub static CLAIMS: &[&dyn Claim] = &[&integrability::ConstraintsIntegrable];
