//! Canonical equations with multipliers.
//!
//! `q'ⁱ = ∂H/∂pᵢ`, `p'ᵢ = −∂H/∂qⁱ + Qᵢ + Σ λ_l ∂f^l/∂vⁱ` at `v = ∂H/∂p` (T1 (10)). The multipliers follow from
//! `D u = 0` for `u(q, p, t) = f(q, ∂H/∂p, t)`, which is linear in λ.

use super::legendre::{Legendre, PhaseDirection};
use super::routh::multiplier_objects;
use super::{Basis, DeriveError, Formulation};
use crate::card::{Card, Principle, Relation, Source};
use crate::equations::{Equation, Equations, Schema};
use crate::system::System;
use chetaev_symbolic::Expr;

/// The heading of `p = ∂L/∂v` where no closed inverse was found.
pub(crate) const IMPLICIT: &str = "momenta, of which the velocities are implicit functions";

/// Canonical equations with multipliers.
#[derive(Clone, Copy, Debug)]
pub struct Canonical;

static CARD: Card = Card {
    name: "canonical",
    title: "Canonical equations with multipliers",
    statement: "Hamilton's equations for coordinates and momenta with the reactions λ ∂f/∂q' in the equations of the momenta.",
    principle: Principle::Hamilton,
    relation: Relation::Equivalent,
    requires: &["model.accelerations-unique", "model.hessian-regular", "model.masses-free-of-velocity"],
    identity: None,
    unknowns: "rates of the momenta of all coordinates and one multiplier for each independent constraint",
    highest_order: 1,
    sources: &[Source { key: "rumyantsev1982", place: "canonical equations with multipliers; T1 (10)" }],
};

const SCHEMA: Schema = Schema {
    text: "q'^i = ∂H/∂p_i, p'_i = −∂H/∂q^i + Q_i + Σ_l λ_l ∂f^l/∂v^i",
    latex: r"\dot q^i = \frac{\partial H}{\partial p_i}, \quad \dot p_i = -\frac{\partial H}{\partial q^i} + Q_i + \sum_l \lambda_l \frac{\partial f^l}{\partial v^i}",
};

impl Formulation for Canonical {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn equations(&self, basis: &Basis<'_>) -> Result<Equations, DeriveError> {
        let system = basis.system;
        let legendre = Legendre::new(system)?;
        let reactions = reactions(basis, &legendre);
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

/// The gradients `∂f^l/∂v` as functions of (q, p, t), one covector per selected row.
pub(crate) fn reactions(basis: &Basis<'_>, legendre: &Legendre) -> Vec<Vec<Expr>> {
    let n = basis.system.n();
    legendre
        .restrict(basis.system, &basis.jacobian().concat())
        .chunks(n)
        .map(<[Expr]>::to_vec)
        .collect()
}

/// A flow on phase space, `p' = free + Σ λ_l reaction^l` with the λ that keep `u(q, p, t) = 0`.
pub(crate) struct MultiplierFlow {
    /// q'.
    pub(crate) velocities: Vec<Expr>,
    /// `−∂H/∂q + Q`.
    pub(crate) free: Vec<Expr>,
    /// λ of the selected rows.
    pub(crate) multipliers: Vec<Expr>,
    /// p'.
    pub(crate) momenta: Vec<Expr>,
}

impl MultiplierFlow {
    /// Finds λ from `D u = 0`, `u = f(q, ∂H/∂p, t)`.
    ///
    /// # Errors
    /// [`DeriveError::Singular`] where λ is not determined by the form of the equations.
    pub(crate) fn new(
        basis: &Basis<'_>,
        legendre: &Legendre,
        velocities: &[Expr],
        reactions: &[Vec<Expr>],
    ) -> Result<MultiplierFlow, DeriveError> {
        let (system, g) = (basis.system, &basis.system.graph);
        let free: Vec<Expr> = legendre
            .restrict(system, &system.forces)
            .into_iter()
            .zip(&legendre.by_coordinates)
            .map(|(force, &slope)| g.sub(force, slope))
            .collect();
        let constraints = legendre.restrict(system, &basis.constraints());
        let drift = PhaseDirection {
            time: g.one(),
            coordinates: velocities.to_vec(),
            momenta: free.clone(),
        };
        let right: Vec<Expr> = legendre
            .along(system, &constraints, &drift)
            .into_iter()
            .map(|e| g.neg(e))
            .collect();
        let columns: Vec<Vec<Expr>> = reactions
            .iter()
            .map(|row| legendre.momentum_direction(system, row))
            .map(|direction| legendre.along(system, &constraints, &direction))
            .collect();
        let matrix: Vec<Expr> = (0..constraints.len())
            .flat_map(|l| columns.iter().map(move |column| column[l]))
            .collect();
        let multipliers = g.solve(&matrix, &right)?;
        let momenta = with_reactions(system, &free, reactions, &multipliers);
        Ok(MultiplierFlow {
            velocities: velocities.to_vec(),
            free,
            multipliers,
            momenta,
        })
    }

    /// The equations with the state (q, p), without groups.
    pub(crate) fn into_equations(
        self,
        name: &'static str,
        basis: &Basis<'_>,
        legendre: &Legendre,
    ) -> Equations {
        let system = basis.system;
        let variables = legendre.state(system, &self.velocities, &self.momenta);
        let mut equations = Equations::in_state(name, system, variables, self.velocities)
            .with_objects(legendre.objects(system))
            .with_objects(multiplier_objects(basis, &self.multipliers));
        equations.relations = legendre.relations(system);
        let indices = basis.constraint_indices().into_iter();
        equations.multipliers = indices.zip(self.multipliers).collect();
        equations
    }
}

/// `free + Σ λ_l reaction^l`.
pub(crate) fn with_reactions(
    system: &System,
    free: &[Expr],
    reactions: &[Vec<Expr>],
    multipliers: &[Expr],
) -> Vec<Expr> {
    let g = &system.graph;
    free.iter()
        .enumerate()
        .map(|(i, &free)| {
            let mut parts = vec![free];
            for (row, &lambda) in reactions.iter().zip(multipliers) {
                if !g.is_zero(row[i]) {
                    parts.push(g.mul(&[lambda, row[i]]));
                }
            }
            g.add(&parts)
        })
        .collect()
}

/// `q' = ∂H/∂p`, `p' = free + Σ λ reaction` with the multipliers as symbols.
pub(crate) fn stated_equations(
    basis: &Basis<'_>,
    legendre: &Legendre,
    free: &[Expr],
    reactions: &[Vec<Expr>],
) -> Vec<Equation> {
    let system = basis.system;
    let right = with_reactions(system, free, reactions, &basis.lambda_symbols());
    let kinematics = system
        .coordinates
        .iter()
        .zip(&legendre.by_momenta)
        .filter(|(c, v)| c.v != **v)
        .map(|(c, &v)| Equation {
            label: c.name.clone(),
            left: c.v,
            right: v,
        });
    let momenta = legendre
        .momenta
        .iter()
        .zip(right)
        .map(|(p, right)| Equation {
            label: p.name.clone(),
            left: p.rate,
            right,
        });
    kinematics.chain(momenta).collect()
}

/// Adds the groups of the momenta and of the constraints `u(q, p, t) = 0`.
pub(crate) fn with_constraints(
    basis: &Basis<'_>,
    legendre: &Legendre,
    mut equations: Equations,
) -> Equations {
    if !legendre.is_explicit {
        equations = equations.with_group(IMPLICIT, None, legendre.momentum_equations());
    }
    let constraints = legendre.restrict(basis.system, &basis.constraints());
    let stated = basis.constraints_as(&constraints);
    equations.with_group("constraints", None, stated)
}
