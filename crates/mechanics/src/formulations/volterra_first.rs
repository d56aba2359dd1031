//! Volterra's equations in the first form, generalized coordinates.
//!
//! `D ∂T̃/∂P_σ - Σ_s p_s D B_sσ - Σ_s (∂T/∂q^s) B_sσ = Ẽ_σ`, σ = 1..k: T2 (V1q) with m = 1. The partial derivatives of T are
//! taken before the velocities are replaced, those of T̃ after.

use super::volterra::{Form, Volterra};
use super::{Basis, DeriveError, Formulation, Identity};
use crate::card::{Card, Principle, Relation, Source};
use crate::equations::{Equations, Schema};

/// Volterra's equations, first form.
#[derive(Clone, Copy, Debug)]
pub struct VolterraFirst;

static CARD: Card = Card {
    name: "volterra-first",
    title: "Volterra's equations, first form",
    statement: "Rates of the momenta along kinematic characteristics, corrected by the turning of the virtual displacements and by the slope of the unrestricted kinetic energy.",
    principle: Principle::DalembertLagrangeChetaev,
    relation: Relation::Equivalent,
    requires: &["model.accelerations-unique", "order.characteristics", "model.masses-free-of-velocity"],
    identity: Some("Volterra's left sides minus forces are Maggi's on the whole jet (t, q, P, P')"),
    unknowns: "rates of the k kinematic characteristics",
    highest_order: u32::MAX,
    sources: &[
        Source { key: "volterra1898", place: "§§ 1–2" },
        Source { key: "qiao-volterra", place: "(3.20)" },
    ],
};

const SCHEMA: Schema = Schema {
    text: "D ∂T̃/∂P_σ − Σ_s p_s D(∂v^s/∂P_σ) − Σ_s ∂T/∂q^s ∂v^s/∂P_σ = Ẽ_σ + Ψ̃_σ",
    latex: r"\frac{d}{dt}\frac{\partial \tilde T}{\partial P_\sigma} - \sum_s p_s \frac{d}{dt}\frac{\partial \dot q^s}{\partial P_\sigma} - \sum_s \frac{\partial T}{\partial q^s}\frac{\partial \dot q^s}{\partial P_\sigma} = \tilde E_\sigma + \tilde\Psi_\sigma",
};

/// Of constraints of order m, T2 (V1q).
const HIGHER_ORDER: Schema = Schema {
    text:
        "m D ∂T̃/∂P_σ − m Σ_s p_s D(∂q^s(m)/∂P_σ) − Σ_s ∂T^(m−1)/∂q^s(m−1) ∂q^s(m)/∂P_σ = Ẽ_σ + Ψ̃_σ",
    latex: r"m \frac{d}{dt}\frac{\partial \tilde T^{(m-1)}}{\partial P_\sigma} - m \sum_s p_s \frac{d}{dt}\frac{\partial q^{s(m)}}{\partial P_\sigma} - \sum_s \frac{\partial T^{(m-1)}}{\partial q^{s(m-1)}}\frac{\partial q^{s(m)}}{\partial P_\sigma} = \tilde E_\sigma + \tilde\Psi_\sigma",
};

impl Formulation for VolterraFirst {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn equations(&self, basis: &Basis<'_>) -> Result<Equations, DeriveError> {
        let of = (CARD.name, [SCHEMA, HIGHER_ORDER], Form::First);
        Volterra::generalized(basis)?.equations(of, basis)
    }

    fn identities(&self, basis: &Basis<'_>) -> Result<Vec<Identity>, DeriveError> {
        Ok(Volterra::generalized(basis)?.identities(Form::First))
    }

    fn special_identities(&self, basis: &Basis<'_>) -> Result<Vec<Identity>, DeriveError> {
        Ok(Volterra::generalized(basis)?.special_identities(Form::First))
    }
}
