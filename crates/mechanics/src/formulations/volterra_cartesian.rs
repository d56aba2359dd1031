//! Volterra's equations in Cartesian coordinates, where the positions of the particles are the coordinates.
//!
//! First form `D ∂T/∂P_σ - Σ_i μ_i ξ_i' D(∂ξ_i'/∂P_σ) = Ẽ_σ`, second form with `∂/∂π_σ` (T2 (V1), (V2) with m = 1). They hold
//! for `T = ½ Σ μ_i ξ_i'²` only: the first form has no term for a kinetic energy that depends on the coordinates.

use super::volterra::{Form, Volterra};
use super::{Basis, DeriveError, Formulation, Identity};
use crate::card::{Card, Principle, Relation, Source};
use crate::equations::{Equations, Schema};

/// Volterra's equations, first form, in the Cartesian coordinates of particles.
#[derive(Clone, Copy, Debug)]
pub struct VolterraFirstCartesian;

static CARD_FIRST: Card = Card {
    name: "volterra-first-cartesian",
    title: "Volterra's equations, first form, Cartesian",
    statement: "Rates of the momenta along kinematic characteristics of particles in Cartesian coordinates, corrected by the turning of the virtual displacements.",
    principle: Principle::DalembertLagrangeChetaev,
    relation: Relation::Equivalent,
    requires: &["model.accelerations-unique", "model.particles", "model.cartesian-coordinates", "model.masses-of-time"],
    identity: Some("Volterra's left sides minus forces are Maggi's on the whole jet (t, q, P, P')"),
    unknowns: "rates of the k kinematic characteristics",
    highest_order: u32::MAX,
    sources: &[
        Source { key: "volterra1898", place: "§§ 1–2" },
        Source { key: "qiao-volterra", place: "(2.14)" },
    ],
};

const SCHEMA_FIRST: Schema = Schema {
    text: "D ∂T/∂P_σ − Σ_i μ_i ξ_i' D(∂ξ_i'/∂P_σ) = Ẽ_σ + Ψ̃_σ",
    latex: r"\frac{d}{dt}\frac{\partial T}{\partial P_\sigma} - \sum_i \mu_i \dot\xi_i \frac{d}{dt}\frac{\partial \dot\xi_i}{\partial P_\sigma} = \tilde E_\sigma + \tilde\Psi_\sigma",
};

/// Of constraints of order m, T2 (V1).
const HIGHER_FIRST: Schema = Schema {
    text: "D ∂T^(m−1)/∂P_σ − Σ_i μ_i ξ_i' D(∂ξ_i(m)/∂P_σ) = Ẽ_σ + Ψ̃_σ",
    latex: r"\frac{d}{dt}\frac{\partial T^{(m-1)}}{\partial P_\sigma} - \sum_i \mu_i \dot\xi_i \frac{d}{dt}\frac{\partial \xi_i^{(m)}}{\partial P_\sigma} = \tilde E_\sigma + \tilde\Psi_\sigma",
};

impl Formulation for VolterraFirstCartesian {
    fn card(&self) -> &'static Card {
        &CARD_FIRST
    }

    fn equations(&self, basis: &Basis<'_>) -> Result<Equations, DeriveError> {
        let of = (CARD_FIRST.name, [SCHEMA_FIRST, HIGHER_FIRST], Form::First);
        Volterra::cartesian(basis)?.equations(of, basis)
    }

    fn identities(&self, basis: &Basis<'_>) -> Result<Vec<Identity>, DeriveError> {
        Ok(Volterra::cartesian(basis)?.identities(Form::First))
    }

    fn special_identities(&self, basis: &Basis<'_>) -> Result<Vec<Identity>, DeriveError> {
        Ok(Volterra::cartesian(basis)?.special_identities(Form::First))
    }
}

/// Volterra's equations, second form, in the Cartesian coordinates of particles.
#[derive(Clone, Copy, Debug)]
pub struct VolterraSecondCartesian;

static CARD_SECOND: Card = Card {
    name: "volterra-second-cartesian",
    title: "Volterra's equations, second form, Cartesian",
    statement: "Lagrange's equations in quasi-coordinates for particles in Cartesian coordinates, corrected by the brackets of the virtual displacements with the motion.",
    principle: Principle::DalembertLagrangeChetaev,
    relation: Relation::Equivalent,
    requires: &["model.accelerations-unique", "model.particles", "model.cartesian-coordinates", "model.masses-of-time"],
    identity: Some("Volterra's left sides minus forces are Maggi's on the whole jet (t, q, P, P')"),
    unknowns: "rates of the k kinematic characteristics",
    highest_order: u32::MAX,
    sources: &[
        Source { key: "volterra1898", place: "§§ 1–2" },
        Source { key: "qiao-volterra", place: "(2.21)" },
    ],
};

const SCHEMA_SECOND: Schema = Schema {
    text: "D ∂T/∂P_σ − ∂T/∂π_σ − Σ_i μ_i ξ_i' ( D(∂ξ_i'/∂P_σ) − ∂ξ_i'/∂π_σ ) = Ẽ_σ + Ψ̃_σ",
    latex: r"\frac{d}{dt}\frac{\partial T}{\partial P_\sigma} - \frac{\partial T}{\partial \pi_\sigma} - \sum_i \mu_i \dot\xi_i \Bigl( \frac{d}{dt}\frac{\partial \dot\xi_i}{\partial P_\sigma} - \frac{\partial \dot\xi_i}{\partial \pi_\sigma} \Bigr) = \tilde E_\sigma + \tilde\Psi_\sigma",
};

/// Of constraints of order m, T2 (V2).
const HIGHER_SECOND: Schema = Schema {
    text: "m D ∂T^(m−1)/∂P_σ − ∂T^(m−1)/∂π_σ − Σ_i μ_i ξ_i' ( m D(∂ξ_i(m)/∂P_σ) − ∂ξ_i(m)/∂π_σ ) = Ẽ_σ + Ψ̃_σ",
    latex: r"m \frac{d}{dt}\frac{\partial T^{(m-1)}}{\partial P_\sigma} - \frac{\partial T^{(m-1)}}{\partial \pi_\sigma} - \sum_i \mu_i \dot\xi_i \Bigl( m \frac{d}{dt}\frac{\partial \xi_i^{(m)}}{\partial P_\sigma} - \frac{\partial \xi_i^{(m)}}{\partial \pi_\sigma} \Bigr) = \tilde E_\sigma + \tilde\Psi_\sigma",
};

impl Formulation for VolterraSecondCartesian {
    fn card(&self) -> &'static Card {
        &CARD_SECOND
    }

    fn equations(&self, basis: &Basis<'_>) -> Result<Equations, DeriveError> {
        let of = (
            CARD_SECOND.name,
            [SCHEMA_SECOND, HIGHER_SECOND],
            Form::Second,
        );
        Volterra::cartesian(basis)?.equations(of, basis)
    }

    fn identities(&self, basis: &Basis<'_>) -> Result<Vec<Identity>, DeriveError> {
        Ok(Volterra::cartesian(basis)?.identities(Form::Second))
    }

    fn special_identities(&self, basis: &Basis<'_>) -> Result<Vec<Identity>, DeriveError> {
        Ok(Volterra::cartesian(basis)?.special_identities(Form::Second))
    }
}
