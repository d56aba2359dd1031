//! Zhu's closed equations in Hamilton's form: constraints and virtual displacements without velocities.
//!
//! `Dq^s = ∂H/∂p_s`, `Dp_s = −∂H/∂q^s + Q_s + Σ λ_l Σ_j ∂u^l/∂p_j [H_pp]⁻¹_js` with `u^l(q, p, t) = f^l(q, ∂H/∂p, t)`
//! (T1 (39), (40)). The reaction covector comes from u alone; that it is `∂f/∂v` is a test of the transform.

use super::canonical::{stated_equations, with_constraints, MultiplierFlow};
use super::legendre::Legendre;
use super::{Basis, DeriveError, Formulation};
use crate::card::{Card, Principle, Relation, Source};
use crate::equations::{Equations, Schema};
use chetaev_symbolic::Expr;

/// Zhu's closed equations in the space of (q, p).
#[derive(Clone, Copy, Debug)]
pub struct StateSpaceCanonical;

static CARD: Card = Card {
    name: "state-space-canonical",
    title: "Closed equations in the space of coordinates and momenta",
    statement: "The second-kind principle in Hamilton's form: the reactions are directed by the gradients of u(q, p, t) by the momenta and the inverse Hessian of H, without velocities.",
    principle: Principle::SecondKind,
    relation: Relation::Equivalent,
    requires: &["model.accelerations-unique", "model.hessian-regular", "model.masses-free-of-velocity"],
    identity: None,
    unknowns: "rates of coordinates and momenta and one multiplier for each independent constraint",
    highest_order: 1,
    sources: &[Source { key: "zhu1998", place: "Hamilton form of the second-kind principles; T1 (40)" }],
};

const SCHEMA: Schema = Schema {
    text: "Dq^s = ∂H/∂p_s, Dp_s = −∂H/∂q^s + Q_s + Σ_l λ_l Σ_j ∂u^l/∂p_j [H_pp]^{-1}_js",
    latex: r"D q^s = \frac{\partial H}{\partial p_s}, \quad D p_s = -\frac{\partial H}{\partial q^s} + Q_s + \sum_l \lambda_l \sum_j \frac{\partial u^l}{\partial p_j} \bigl[H_{pp}\bigr]^{-1}_{js}",
};

impl Formulation for StateSpaceCanonical {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn equations(&self, basis: &Basis<'_>) -> Result<Equations, DeriveError> {
        let legendre = Legendre::new(basis.system)?;
        let reactions = reactions(basis, &legendre)?;
        let flow = MultiplierFlow::new(basis, &legendre, &legendre.by_momenta, &reactions)?;
        let stated = stated_equations(basis, &legendre, &flow.free, &reactions);
        let equations = flow.into_equations(CARD.name, basis, &legendre).with_group(
            "equations of motion",
            Some(SCHEMA),
            stated,
        );
        Ok(with_constraints(basis, &legendre, equations))
    }
}

/// `Σ_j ∂u^l/∂p_j [H_pp]⁻¹_js` (T1 (40)), one covector per selected row.
pub fn reactions(basis: &Basis<'_>, legendre: &Legendre) -> Result<Vec<Vec<Expr>>, DeriveError> {
    let (system, g) = (basis.system, &basis.system.graph);
    let constraints = legendre.restrict(system, &basis.constraints());
    // H_pp is symmetric, so a row times its inverse is a solution with it.
    let hessian = legendre.jacobian(system, &legendre.by_momenta).concat();
    legendre
        .jacobian(system, &constraints)
        .iter()
        .map(|row| Ok(g.solve(&hessian, row)?))
        .collect()
}
