//! All claims of the product in one registry.

use crate::{motion_claims, witness};
use chetaev_mechanics::Registry;

/// The claims of all crates, in the order of the catalogue.
pub fn registry() -> Registry {
    Registry::new(&[
        chetaev_mechanics::claims::CLAIMS,
        chetaev_geometry::CLAIMS,
        chetaev_principles::CLAIMS,
        chetaev_stability::claims::CLAIMS,
        motion_claims::CLAIMS,
        witness::CLAIMS,
    ])
}
