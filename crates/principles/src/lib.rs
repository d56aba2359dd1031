//! What the variational principles say of a system.

pub mod energy;

use chetaev_mechanics::Claim;

/// The claims of this crate.
pub static CLAIMS: &[&dyn Claim] = &[&energy::EnergyIntegral];
