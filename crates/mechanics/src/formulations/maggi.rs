//! Maggi's equations.
//!
//! `Σ_s ( D(∂L/∂v^s) - ∂L/∂q^s - Q_s ) ∂v^s/∂P_σ = 0`, σ = 1..k, for a parametrization `v = φ(q, P, t)` of the
//! admissible velocities (T2 (7) with m = 1). With `a = Dφ` they are k linear equations for P'.

use super::{Basis, DeriveError, Formulation};
use crate::card::{Card, Principle, Relation, Source};
use crate::characteristics::Characteristics;
use crate::equations::{Equation, Equations, NamedExpr, Schema};
use crate::order::determined::in_characteristics;
use crate::system::System;
use chetaev_symbolic::Expr;

/// Maggi's equations for independent velocities or the user's quasi-velocities.
#[derive(Clone, Copy, Debug)]
pub struct Maggi;

static CARD: Card = Card {
    name: "maggi",
    title: "Maggi's equations",
    statement: "Lagrange's left sides contracted with a basis of virtual displacements: as many equations as degrees of freedom in velocity, without multipliers.",
    principle: Principle::DalembertLagrangeChetaev,
    relation: Relation::Equivalent,
    requires: &["model.accelerations-unique", "order.characteristics"],
    identity: None,
    unknowns: "rates of the k kinematic parameters",
    highest_order: u32::MAX,
    sources: &[
        Source { key: "maggi1896", place: "§§ 1–5" },
        Source { key: "qiao-volterra", place: "(6)–(7)" },
    ],
};

const SCHEMA: Schema = Schema {
    text: "Σ_s ( D(∂L/∂v^s) − ∂L/∂q^s − Q_s ) ∂v^s/∂P_σ = 0",
    latex: r"\sum_s \Bigl( \frac{d}{dt}\frac{\partial L}{\partial \dot q^s} - \frac{\partial L}{\partial q^s} - Q_s \Bigr) \frac{\partial \dot q^s}{\partial P_\sigma} = 0",
};

/// Of constraints of order m, T2 (7).
const HIGHER_ORDER: Schema = Schema {
    text: "Σ_s ( D(∂L/∂v^s) − ∂L/∂q^s − Q_s − Ψ_s ) ∂q^s(m)/∂P_σ = 0",
    latex: r"\sum_s \Bigl( \frac{d}{dt}\frac{\partial L}{\partial \dot q^s} - \frac{\partial L}{\partial q^s} - Q_s - \Psi_s \Bigr) \frac{\partial q^{s(m)}}{\partial P_\sigma} = 0",
};

impl Formulation for Maggi {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn equations(&self, basis: &Basis<'_>) -> Result<Equations, DeriveError> {
        let (system, characteristics) = (basis.system, basis.kinematic_characteristics()?);
        let zero = system.graph.zero();
        let motion: Vec<Equation> = characteristics
            .parameters
            .iter()
            .zip(left_sides(system, &characteristics))
            .map(|(p, left)| Equation {
                label: p.name.clone(),
                left,
                right: zero,
            })
            .collect();
        let schema = match characteristics.order {
            1 => SCHEMA,
            _ => HIGHER_ORDER,
        };
        Ok(
            in_characteristics(CARD.name, basis, &characteristics, &motion)?
                .with_group("equations of motion", Some(schema), motion)
                .with_group("kinematics", None, basis.kinematics(&characteristics))
                .with_objects(virtual_basis(system, &characteristics)),
        )
    }
}

/// `Σ_s ( D(∂L/∂v^s) - ∂L/∂q^s - Q_s ) B_sσ` on the jet (t, q, P, P'), σ = 1..k: what all forms with kinematic
/// characteristics must equal identically (T2 §3).
pub(crate) fn left_sides(system: &System, characteristics: &Characteristics) -> Vec<Expr> {
    let on_jet = characteristics.on_jet(system, &system.motion_left_sides());
    characteristics.contract(system, &on_jet)
}

/// The entries of B that do not vanish.
pub(crate) fn virtual_basis(system: &System, characteristics: &Characteristics) -> Vec<NamedExpr> {
    let mut objects = Vec::new();
    for (c, row) in characteristics.jets.iter().zip(&characteristics.basis) {
        for (p, &value) in characteristics.parameters.iter().zip(row) {
            if !system.graph.is_zero(value) {
                let (s, sigma) = (&c.name, super::bare(&p.name));
                let highest = system.graph.symbol_text(c.v_symbol);
                let meaning = format!("∂{highest}/∂({})", p.name);
                let object = NamedExpr::new(format!("B_{s}_{sigma}"), value, meaning);
                objects.push(object.with_indices("B", &[s], &[sigma]));
            }
        }
    }
    objects
}
