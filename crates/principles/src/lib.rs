//! What the variational principles say of a system (T1).
//!
//! - [`variations`]: δf and δv by the rules of Hölder and of Suslov; [`hamilton`]: four forms of Hamilton's principle;
//! - [`stationarity`]: on which motions the action is stationary among admissible curves (closure of the conditions on κ, T1 §4.3);
//!   [`coincidence`]: the constrained extremum beside the motion;
//! - [`action`]: least action at varied times, Jacobi's principle; [`energy`]: the power balance;
//! - [`second_kind`], [`universal_relation`]: the principles of the second, first and intermediate kind (T1 §7);
//! - [`chaplygin_multiplier`]: Chaplygin's reducing multiplier; [`hamilton_jacobi`]: the generalized method of Hamilton and Jacobi.

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
