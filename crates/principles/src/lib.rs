//! What the variational principles say of a system.

pub mod action;
pub mod chaplygin_multiplier;
pub mod coincidence;
pub mod energy;
pub mod hamilton;
pub mod hamilton_jacobi;
pub mod second_kind;
pub mod stationarity;
pub mod universal_relation;
pub mod variations;
mod words;

use chetaev_mechanics::Claim;

/// The claims of this crate.
pub static CLAIMS: &[&dyn Claim] = &[
    &coincidence::VakonomicCoincides,
    &variations::Hoelder,
    &variations::Suslov,
    &hamilton::Hoelder,
    &hamilton::Voronets,
    &hamilton::Suslov,
    &hamilton::HelmholtzPoincare,
    &hamilton::CentralIdentity,
    &hamilton::Constants,
    &hamilton::FormsEquivalent,
    &stationarity::Stationary,
    &stationarity::StationarySuslov,
    &hamilton::Kerner,
    &hamilton::Endpoints,
    &energy::EnergyIntegral,
    &action::Identity,
    &action::Lagrange,
    &action::Jacobi,
    &action::Parametric,
    &hamilton_jacobi::Applicable,
    &chaplygin_multiplier::Multiplier,
    &second_kind::Differential,
    &second_kind::DifferentialNewton,
    &second_kind::PointwiseIdentity,
    &second_kind::Integral,
    &second_kind::Canonical,
    &universal_relation::UniversalRelation,
];
