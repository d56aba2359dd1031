//! Gauss's principle and the explicit formula of Udwadia and Kalaba.
//!
//! Among the accelerations with `J a = g` the motion makes `Z = ½ (a - α)ᵀ W (a - α)` stationary, α = W⁻¹ b (T1 (50)); with
//! W singular, `½ aᵀ W a - aᵀ b`. Explicitly `a = α + W⁻¹ Jᵀ ( J W⁻¹ Jᵀ )⁻¹ ( g - J α )` (T1 (51), Udwadia and Kalaba 1992).

use super::lagrange_dalembert::VirtualDisplacements;
use super::voronets::natural;
use super::{Basis, DeriveError, Formulation};
use crate::card::{Card, Principle, Relation, Source};
use crate::equations::{Equation, Equations, NamedExpr, Schema};
use crate::linear::dot;
use crate::prover::Prover;
use crate::system::System;
use chetaev_symbolic::{Expr, Verdict};

mod least;

pub use least::{kind, Kind};

/// Gauss's principle.
#[derive(Clone, Copy, Debug)]
pub struct Gauss;

static CARD: Card = Card {
    name: "gauss",
    title: "Gauss's principle of least constraint",
    statement: "Among the accelerations that the constraints allow at a state, those of the motion make the deviation from the free ones stationary, least where the mass matrix is positive on the virtual displacements.",
    principle: Principle::Gauss,
    relation: Relation::Equivalent,
    requires: &["model.accelerations-unique", "model.masses-free-of-velocity"],
    identity: None,
    unknowns: "accelerations of all coordinates",
    highest_order: 1,
    sources: &[
        Source { key: "gauss1829", place: "the principle; T1 (50)" },
        Source { key: "udwadia-kalaba1992", place: "the explicit formula; T1 (51)" },
    ],
};

const STATIONARY: Schema = Schema {
    text: "δZ = Σ_ij ( W_ij a^j − b_i ) δa^i = 0 where Σ_i ∂f^l/∂v^i δa^i = 0",
    latex: r"\delta Z = \sum_{ij} \bigl( W_{ij} \ddot q^j - b_i \bigr) \delta \ddot q^i = 0, \quad \sum_i \frac{\partial f^l}{\partial \dot q^i} \delta \ddot q^i = 0",
};

const EXPLICIT: Schema = Schema {
    text: "a = α + W⁻¹ Jᵀ λ,  λ = ( J W⁻¹ Jᵀ )⁻¹ ( g − J α ),  α = W⁻¹ b",
    latex: r"\ddot q = \alpha + W^{-1} J^{\mathsf T} \lambda, \quad \lambda = \bigl( J W^{-1} J^{\mathsf T} \bigr)^{-1} ( g - J \alpha ), \quad \alpha = W^{-1} b",
};

impl Formulation for Gauss {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn equations(&self, basis: &Basis<'_>) -> Result<Equations, DeriveError> {
        let displacements = VirtualDisplacements::new(basis)?;
        let motion = stationarity(basis, &displacements);
        let mut equations = match is_regular(basis) {
            true => explicit(basis)?,
            false => {
                let mut equations = stationary(basis, &displacements)?;
                equations.relations = displacements.relations(basis.system, &basis.constraints());
                // The basis degenerates where the dependent displacements cannot be solved for; another one then serves.
                equations.is_chart = !basis.selection.rows.is_empty();
                equations
            }
        };
        let objects = super::routh::multiplier_objects(basis, &values(&equations));
        equations = equations
            .with_group("stationarity", Some(STATIONARY), motion)
            .with_group(
                "constraints on the accelerations",
                None,
                rates_of_constraints(basis),
            )
            .with_group("constraints", None, basis.constraint_equations())
            .with_objects(objects);
        Ok(equations)
    }
}

fn values(equations: &Equations) -> Vec<Expr> {
    equations
        .multipliers
        .iter()
        .map(|&(_, value)| value)
        .collect()
}

/// Whether W is nonsingular on the constraint manifold. Then `J W⁻¹ Jᵀ` is so too, since the accelerations are unique.
fn is_regular(basis: &Basis<'_>) -> bool {
    let manifold = natural(basis).map(|c| c.manifold).unwrap_or_default();
    let (system, matrix) = (basis.system, &basis.terms.mass_matrix);
    let verdict = Prover::default().nonsingular(system, matrix, &manifold, "det ∂²L/∂v∂v");
    matches!(verdict, Verdict::Proved(_))
}

/// `α = W⁻¹ b`, the columns of `W⁻¹ Jᵀ`, and λ; W is solved with, never inverted.
struct Response {
    free: Vec<Expr>,
    columns: Vec<Vec<Expr>>,
    lambdas: Vec<Expr>,
    /// ½ λᵀ ( g - J α ), the value of Z on the motion.
    value: Expr,
}

impl Response {
    fn new(basis: &Basis<'_>) -> Result<Response, DeriveError> {
        let (terms, g) = (basis.terms, &basis.system.graph);
        let matrix = terms.mass_matrix.concat();
        let free = g.solve(&matrix, &terms.force)?;
        let jacobian = basis.jacobian();
        let columns = jacobian
            .iter()
            .map(|row| g.solve(&matrix, row))
            .collect::<Result<Vec<_>, _>>()?;
        let defects: Vec<Expr> = jacobian
            .iter()
            .zip(&basis.selection.rows)
            .map(|(row, &l)| g.sub(terms.constraint_rate[l], dot(g, row, &free)))
            .collect();
        let compliance: Vec<Expr> = jacobian
            .iter()
            .flat_map(|row| columns.iter().map(move |column| dot(g, row, column)))
            .collect();
        let lambdas = match defects.is_empty() {
            true => Vec::new(),
            false => g.solve(&compliance, &defects)?,
        };
        Ok(Response {
            value: g.div(dot(g, &lambdas, &defects), g.integer(2)),
            free,
            columns,
            lambdas,
        })
    }

    /// `α + W⁻¹ Jᵀ λ` for given multipliers.
    fn accelerations(&self, system: &System, multipliers: &[Expr]) -> Vec<Expr> {
        let g = &system.graph;
        let components = self.free.iter().enumerate();
        components
            .map(|(i, &alpha)| {
                let row = self.columns.iter().map(|column| &column[i]);
                g.add(&[alpha, dot(g, row, multipliers)])
            })
            .collect()
    }
}

/// The formula of Udwadia and Kalaba.
fn explicit(basis: &Basis<'_>) -> Result<Equations, DeriveError> {
    let (system, response) = (basis.system, Response::new(basis)?);
    let accelerations = response.accelerations(system, &response.lambdas);
    let stated: Vec<Equation> = system
        .coordinates
        .iter()
        .zip(response.accelerations(system, &basis.lambda_symbols()))
        .map(|(c, right)| Equation {
            label: c.name.clone(),
            left: c.a,
            right,
        })
        .collect();
    let mut objects = deviation(basis, &response.free);
    let free = system.coordinates.iter().zip(&response.free);
    objects.extend(free.map(|(c, &value)| {
        let meaning = format!("acceleration of {} without the constraints", c.name);
        NamedExpr::new(format!("alpha_{}", c.name), value, meaning)
    }));
    objects.push(NamedExpr::new(
        "Z_motion",
        response.value,
        "value of Z on the motion",
    ));
    let mut equations = Equations::in_velocities(CARD.name, system, accelerations)
        .with_group("equations of motion", Some(EXPLICIT), stated)
        .with_objects(objects);
    let multipliers = basis.constraint_indices().into_iter().zip(response.lambdas);
    equations.multipliers = multipliers.collect();
    Ok(equations)
}

/// W is written out up to this number of coordinates.
const SHORT: usize = 4;

/// `Z = ½ (a - α)ᵀ W (a - α)` as a function of the accelerations, for few coordinates.
fn deviation(basis: &Basis<'_>, free: &[Expr]) -> Vec<NamedExpr> {
    let (system, g) = (basis.system, &basis.system.graph);
    if system.n() > SHORT {
        return Vec::new();
    }
    let apart: Vec<Expr> = system
        .coordinates
        .iter()
        .zip(free)
        .map(|(c, &alpha)| g.sub(c.a, alpha))
        .collect();
    let rows = basis.terms.mass_matrix.iter();
    let momenta: Vec<Expr> = rows.map(|row| dot(g, row, &apart)).collect();
    let value = g.div(dot(g, &apart, &momenta), g.integer(2));
    vec![NamedExpr::new(
        "Z",
        value,
        "Gauss's function of the accelerations",
    )]
}

/// `Bᵀ ( W a - b ) = 0`, `J a = g`: the stationary point where W is singular.
fn stationary(
    basis: &Basis<'_>,
    displacements: &VirtualDisplacements,
) -> Result<Equations, DeriveError> {
    let (system, terms, g) = (basis.system, basis.terms, &basis.system.graph);
    let (mut matrix, mut right) = (Vec::new(), Vec::new());
    for column in &displacements.columns {
        matrix.extend(terms.mass_matrix.iter().map(|row| dot(g, row, column)));
        right.push(dot(g, column, &terms.force));
    }
    for &row in &basis.selection.rows {
        matrix.extend(&terms.jacobian[row]);
        right.push(terms.constraint_rate[row]);
    }
    let accelerations = g.solve(&matrix, &right)?;
    let multipliers = reactions(basis, displacements, &accelerations)?;
    Ok(Equations::in_velocities(CARD.name, system, accelerations)
        .with_objects(deviation_without_inverse(basis))
        .with_multipliers(basis.constraint_indices(), multipliers))
}

/// `Z_0 = ½ aᵀ W a - aᵀ b`, which is Z without a term free of the accelerations and exists where W is singular too.
fn deviation_without_inverse(basis: &Basis<'_>) -> Option<NamedExpr> {
    let (system, terms, g) = (basis.system, basis.terms, &basis.system.graph);
    let free: Vec<Expr> = system.coordinates.iter().map(|c| c.a).collect();
    let rows = terms.mass_matrix.iter();
    let inertia: Vec<Expr> = rows.map(|row| dot(g, row, &free)).collect();
    let half = g.div(dot(g, &free, &inertia), g.integer(2));
    let value = g.sub(half, dot(g, &free, &terms.force));
    let meaning = "Gauss's function of the accelerations, up to a term free of them";
    (system.n() <= SHORT).then(|| NamedExpr::new("Z_0", value, meaning))
}

/// λ from the rows of `W a - b = Jᵀ λ` of the dependent coordinates.
fn reactions(
    basis: &Basis<'_>,
    displacements: &VirtualDisplacements,
    accelerations: &[Expr],
) -> Result<Vec<Expr>, DeriveError> {
    let (terms, g) = (basis.terms, &basis.system.graph);
    if displacements.dependent.is_empty() {
        return Ok(Vec::new());
    }
    let jacobian = basis.jacobian();
    let (mut matrix, mut right) = (Vec::new(), Vec::new());
    for &d in &displacements.dependent {
        matrix.extend(jacobian.iter().map(|row| row[d]));
        let inertia = dot(g, &terms.mass_matrix[d], accelerations);
        right.push(g.sub(inertia, terms.force[d]));
    }
    Ok(g.solve(&matrix, &right)?)
}

/// `Bᵀ ( W a - b ) = 0` as the principle states it.
fn stationarity(basis: &Basis<'_>, displacements: &VirtualDisplacements) -> Vec<Equation> {
    let (system, terms, g) = (basis.system, basis.terms, &basis.system.graph);
    let accelerations: Vec<Expr> = system.coordinates.iter().map(|c| c.a).collect();
    let residuals: Vec<Expr> = terms
        .mass_matrix
        .iter()
        .zip(&terms.force)
        .map(|(row, &force)| g.sub(dot(g, row, &accelerations), force))
        .collect();
    displacements
        .independent
        .iter()
        .zip(displacements.contract(system, &residuals))
        .map(|(&s, left)| Equation {
            label: system.coordinates[s].name.clone(),
            left,
            right: g.zero(),
        })
        .collect()
}

/// `J a = g`.
fn rates_of_constraints(basis: &Basis<'_>) -> Vec<Equation> {
    let (system, terms, g) = (basis.system, basis.terms, &basis.system.graph);
    let accelerations: Vec<Expr> = system.coordinates.iter().map(|c| c.a).collect();
    basis
        .selection
        .rows
        .iter()
        .zip(basis.constraint_names())
        .map(|(&row, name)| Equation {
            label: name.to_string(),
            left: dot(g, &terms.jacobian[row], &accelerations),
            right: terms.constraint_rate[row],
        })
        .collect()
}
