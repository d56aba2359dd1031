//! Volterra's equations in the second form, generalized coordinates.
//!
//! `D ∂T̃/∂P_σ - ∂T̃/∂π_σ - Σ_s p_s ( D B_sσ - ∂q'^s/∂π_σ ) = Ẽ_σ`, σ = 1..k: T2 (V2q) with m = 1, where
//! `∂/∂π_σ = Σ_s B_sσ ∂/∂q^s` keeps the characteristics P fixed.

use super::volterra::{Form, Volterra};
use super::{Basis, DeriveError, Formulation, Identity};
use crate::card::{Card, Principle, Relation, Source};
use crate::equations::{Equations, Schema};

/// Volterra's equations, second form.
#[derive(Clone, Copy, Debug)]
pub struct VolterraSecond;

static CARD: Card = Card {
    name: "volterra-second",
    title: "Volterra's equations, second form",
    statement: "Lagrange's equations in quasi-coordinates for the restricted kinetic energy, corrected by the brackets of the virtual displacements with the motion.",
    principle: Principle::DalembertLagrangeChetaev,
    relation: Relation::Equivalent,
    requires: &["model.accelerations-unique", "order.characteristics", "model.masses-free-of-velocity"],
    identity: Some("Volterra's left sides minus forces are Maggi's on the whole jet (t, q, P, P')"),
    unknowns: "rates of the k kinematic characteristics",
    highest_order: u32::MAX,
    sources: &[
        Source { key: "volterra1898", place: "§§ 1–2" },
        Source { key: "qiao-volterra", place: "(3.29)" },
    ],
};

const SCHEMA: Schema = Schema {
    text: "D ∂T̃/∂P_σ − ∂T̃/∂π_σ − Σ_s p_s ( D(∂v^s/∂P_σ) − ∂v^s/∂π_σ ) = Ẽ_σ + Ψ̃_σ",
    latex: r"\frac{d}{dt}\frac{\partial \tilde T}{\partial P_\sigma} - \frac{\partial \tilde T}{\partial \pi_\sigma} - \sum_s p_s \Bigl( \frac{d}{dt}\frac{\partial \dot q^s}{\partial P_\sigma} - \frac{\partial \dot q^s}{\partial \pi_\sigma} \Bigr) = \tilde E_\sigma + \tilde\Psi_\sigma",
};

/// Of constraints of order m, T2 (V2q).
const HIGHER_ORDER: Schema = Schema {
    text: "m D ∂T̃/∂P_σ − ∂T̃/∂π_σ − Σ_s p_s ( m D(∂q^s(m)/∂P_σ) − ∂q^s(m)/∂π_σ ) = Ẽ_σ + Ψ̃_σ",
    latex: r"m \frac{d}{dt}\frac{\partial \tilde T^{(m-1)}}{\partial P_\sigma} - \frac{\partial \tilde T^{(m-1)}}{\partial \pi_\sigma} - \sum_s p_s \Bigl( m \frac{d}{dt}\frac{\partial q^{s(m)}}{\partial P_\sigma} - \frac{\partial q^{s(m)}}{\partial \pi_\sigma} \Bigr) = \tilde E_\sigma + \tilde\Psi_\sigma",
};

impl Formulation for VolterraSecond {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn equations(&self, basis: &Basis<'_>) -> Result<Equations, DeriveError> {
        let of = (CARD.name, [SCHEMA, HIGHER_ORDER], Form::Second);
        Volterra::generalized(basis)?.equations(of, basis)
    }

    fn identities(&self, basis: &Basis<'_>) -> Result<Vec<Identity>, DeriveError> {
        Ok(Volterra::generalized(basis)?.identities(Form::Second))
    }

    fn special_identities(&self, basis: &Basis<'_>) -> Result<Vec<Identity>, DeriveError> {
        Ok(Volterra::generalized(basis)?.special_identities(Form::Second))
    }
}
