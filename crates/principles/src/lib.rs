//! What the variational principles say of a system.

pub mod coincidence;
pub mod energy;

use chetaev_mechanics::Claim;

/// The claims of this crate.
pub static CLAIMS: &[&dyn Claim] = &[&coincidence::VakonomicCoincides, &energy::EnergyIntegral];
