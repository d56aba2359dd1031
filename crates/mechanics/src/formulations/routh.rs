//! Routh's equations with multipliers under Chetaev's condition.
//!
//! `D(∂L/∂vⁱ) - ∂L/∂qⁱ = Qᵢ + Σ λ_l ∂f^l/∂vⁱ`, `f^l = 0` (T1 (2)); with `f` differentiated once this is the bordered
//! linear system `W a - Jᵀ λ = b`, `J a = g` for (a, λ), which needs only that it is regular, not that W is.

use super::{Basis, DeriveError, Formulation};
use crate::card::{Card, Principle, Relation, Source};
use crate::equations::{Equation, Equations, NamedExpr, Schema};
use crate::mass;
use crate::order::determined;
use chetaev_symbolic::Expr;

/// Multipliers, Routh–Chetaev.
#[derive(Clone, Copy, Debug)]
pub struct Routh;

static CARD: Card = Card {
    name: "routh",
    title: "Routh's equations with multipliers",
    statement: "Lagrange's equations of all coordinates with the reactions λ ∂f/∂q' of the constraints on the right.",
    principle: Principle::DalembertLagrangeChetaev,
    relation: Relation::Reference,
    requires: &["model.accelerations-unique"],
    identity: None,
    unknowns: "accelerations of all coordinates and one multiplier for each independent constraint",
    highest_order: u32::MAX,
    sources: &[
        Source { key: "routh1905", place: "ch. IV" },
        Source { key: "chetaev1932", place: "§§1–3" },
        Source { key: "rumyantsev1982", place: "(1.3)" },
    ],
};

const SCHEMA: Schema = Schema {
    text: "D(∂L/∂v^i) − ∂L/∂q^i = Q_i + Σ_l λ_l ∂f^l/∂v^i",
    latex: r"\frac{d}{dt}\frac{\partial L}{\partial \dot q^i} - \frac{\partial L}{\partial q^i} = Q_i + \sum_l \lambda_l \frac{\partial f^l}{\partial \dot q^i}",
};

/// With reactive forces.
const VARIABLE_MASS: Schema = Schema {
    text: "D(∂L/∂v^i) − ∂L/∂q^i = Q_i + Ψ_i + Σ_l λ_l ∂f^l/∂v^i",
    latex: r"\frac{d}{dt}\frac{\partial L}{\partial \dot q^i} - \frac{\partial L}{\partial q^i} = Q_i + \Psi_i + \sum_l \lambda_l \frac{\partial f^l}{\partial \dot q^i}",
};

/// Where a mass contains velocities.
const PARTICLES: Schema = Schema {
    text: "Σ_a (m_a r_a'' − F_a − R_a)·∂r_a/∂q^i − … = Σ_l λ_l ∂f^l/∂v^i",
    latex: r"\sum_a (m_a \ddot r_a - F_a - R_a) \cdot \frac{\partial r_a}{\partial q^i} - \dots = \sum_l \lambda_l \frac{\partial f^l}{\partial \dot q^i}",
};

/// Of constraints of order m, T2 (5).
const HIGHER_ORDER: Schema = Schema {
    text: "D(∂L/∂v^i) − ∂L/∂q^i = Q_i + Ψ_i + Σ_l λ_l ∂f^l/∂q^i(m)",
    latex: r"\frac{d}{dt}\frac{\partial L}{\partial \dot q^i} - \frac{\partial L}{\partial q^i} = Q_i + \Psi_i + \sum_l \lambda_l \frac{\partial f^l}{\partial q^{i(m)}}",
};

impl Formulation for Routh {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn equations(&self, basis: &Basis<'_>) -> Result<Equations, DeriveError> {
        if basis.terms.order > 1 {
            let determined = determined::with_multipliers(basis);
            let equations = determined::on_jets(CARD.name, basis, &determined)?;
            return Ok(equations
                .with_group(
                    "equations of motion",
                    Some(HIGHER_ORDER),
                    stated_equations(basis),
                )
                .with_group("constraints", None, basis.constraint_equations())
                .with_objects(reactive_objects(basis)));
        }
        let (accelerations, values) = solve(basis)?;
        let mut objects = multiplier_objects(basis, &values);
        objects.extend(reactive_objects(basis));
        let equations = Equations::in_velocities(CARD.name, basis.system, accelerations)
            .with_group(
                "equations of motion",
                Some(schema(basis)),
                stated_equations(basis),
            )
            .with_group("constraints", None, basis.constraint_equations())
            .with_objects(objects);
        Ok(equations.with_multipliers(basis.constraint_indices(), values))
    }
}

/// The multipliers as named objects.
pub(crate) fn multiplier_objects(basis: &Basis<'_>, values: &[Expr]) -> Vec<NamedExpr> {
    basis
        .constraint_names()
        .into_iter()
        .zip(values)
        .map(|(name, &value)| {
            NamedExpr::new(
                format!("lambda_{name}"),
                value,
                format!("multiplier of `{name}`"),
            )
        })
        .collect()
}

/// The reactive forces that do not vanish.
fn reactive_objects(basis: &Basis<'_>) -> Vec<NamedExpr> {
    let system = basis.system;
    let forces = system.coordinates.iter().zip(&system.reactive_forces);
    forces
        .filter(|(_, &force)| !system.graph.is_zero(force))
        .map(|(c, &force)| {
            let meaning = format!("reactive force along `{}`", c.name);
            NamedExpr::new(format!("Psi_{}", c.name), force, meaning)
        })
        .collect()
}

/// Accelerations and multipliers of the constraints of a basis.
pub(crate) fn solve(basis: &Basis<'_>) -> Result<(Vec<Expr>, Vec<Expr>), DeriveError> {
    Ok(basis.terms.solved(basis.system, &basis.selection.rows)?)
}

fn stated_equations(basis: &Basis<'_>) -> Vec<Equation> {
    let system = basis.system;
    if mass::with_velocity(system).is_some() {
        let lefts = system.motion_left_sides();
        return Equation::of_coordinates(system, lefts, basis.reactions());
    }
    let lefts = system.lagrange_left_sides();
    Equation::of_coordinates(system, lefts, basis.forces_with_reactions())
}

/// The general form of the equations as they are built.
fn schema(basis: &Basis<'_>) -> Schema {
    let (system, g) = (basis.system, &basis.system.graph);
    match mass::with_velocity(system) {
        Some(_) => PARTICLES,
        None if system.reactive_forces.iter().all(|&e| g.is_zero(e)) => SCHEMA,
        None => VARIABLE_MASS,
    }
}
