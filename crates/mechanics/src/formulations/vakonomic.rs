//! The constrained extremum (Lagrange's problem, "vakonomic" equations).
//!
//! `δ∫(L + Σ κ_l f^l) dt = 0` with f = 0:
//! `D(∂L/∂vⁱ) − ∂L/∂qⁱ = Σ κ_l E_i[f^l] − Σ κ'_l ∂f^l/∂vⁱ` (T1 (11)). The state is (q, v, κ); where `W + Σ κ f_vv` bordered
//! by f_v is nonsingular the equations give q'' and κ'. They are not equivalent to the equations of motion in general:
//! κ(0) are r constants more.

use super::{Basis, DeriveError, Formulation};
use crate::card::{Card, Principle, Relation, Source};
use crate::equations::unused_name;
use crate::equations::{Equation, Equations, NamedExpr, RegularMatrix, Schema, StateVariable};
use crate::terms::freeze_accelerations;
use chetaev_symbolic::{Expr, Symbol};

/// The constrained extremum.
#[derive(Clone, Copy, Debug)]
pub struct Vakonomic;

static CARD: Card = Card {
    name: "vakonomic",
    title: "Equations of the constrained extremum",
    statement: "Euler's equations of the action with the constraints as side conditions and multipliers κ(t): another system, whose solutions may contain the motions.",
    principle: Principle::Vakonomic,
    relation: Relation::Coincidence,
    requires: &["model.forces-absent", "model.constrained-extremum-regular", "model.masses-of-time"],
    identity: None,
    unknowns: "accelerations of all coordinates and the rates of the multipliers κ",
    highest_order: 1,
    sources: &[
        Source { key: "rumyantsev1982", place: "the problem of Lagrange" },
        Source { key: "arnold2006", place: "ch. 1 § 4" },
    ],
};

const SCHEMA: Schema = Schema {
    text: "D(∂L/∂v^i) − ∂L/∂q^i = Σ_l κ_l (∂f^l/∂q^i − D ∂f^l/∂v^i) − Σ_l κ'_l ∂f^l/∂v^i",
    latex: r"\frac{d}{dt}\frac{\partial L}{\partial \dot q^i} - \frac{\partial L}{\partial q^i} = \sum_l \kappa_l \Bigl( \frac{\partial f^l}{\partial q^i} - \frac{d}{dt}\frac{\partial f^l}{\partial \dot q^i} \Bigr) - \sum_l \dot\kappa_l \frac{\partial f^l}{\partial \dot q^i}",
};

impl Formulation for Vakonomic {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn equations(&self, basis: &Basis<'_>) -> Result<Equations, DeriveError> {
        let (system, g) = (basis.system, &basis.system.graph);
        let (accelerations, rates) = solve(basis)?;
        let mut equations = Equations::in_velocities(CARD.name, system, accelerations);
        let names = kappa_names(basis);
        equations.regular = Some(RegularMatrix {
            name: "the matrix of W + Σ κ ∂²f/∂v∂v bordered by ∂f/∂v, regularity R5 of the constrained extremum",
            rows: extremum_matrix(basis),
        });
        equations
            .variables
            .extend(names.iter().zip(rates).map(|(name, rate)| StateVariable {
                name: name.clone(),
                value: g.symbol(name, 0),
                symbol: g.intern_symbol(name, 0),
                rate,
                definition: None,
            }));
        Ok(equations
            .with_group(
                "equations of the extremum",
                Some(SCHEMA),
                stated_equations(basis),
            )
            .with_group("constraints", None, basis.constraint_equations())
            .with_objects(extremal_objects(basis)))
    }
}

fn kappa_names(basis: &Basis<'_>) -> Vec<String> {
    let names = basis.constraint_names().into_iter();
    names
        .map(|name| unused_name(basis.system, &format!("kappa_{name}")))
        .collect()
}

/// The symbols `kappa_NAME` of the selected rows.
pub fn kappa_symbols(basis: &Basis<'_>) -> Vec<Expr> {
    let names = kappa_names(basis);
    names
        .iter()
        .map(|name| basis.system.graph.symbol(name, 0))
        .collect()
}

/// `L + Σ κ_l f^l`.
fn augmented(basis: &Basis<'_>) -> Expr {
    let g = &basis.system.graph;
    let mut parts = vec![basis.system.lagrangian];
    for (kappa, f) in kappa_symbols(basis).into_iter().zip(basis.constraints()) {
        parts.push(g.mul(&[kappa, f]));
    }
    g.add(&parts)
}

/// `W + Σ κ_l f^l_vv` bordered by f_v, (n + r) × (n + r), with free κ.
pub fn extremum_matrix(basis: &Basis<'_>) -> Vec<Vec<Expr>> {
    let (system, g) = (basis.system, &basis.system.graph);
    let velocities: Vec<Symbol> = system.velocity_symbols();
    let momenta = g.gradient(augmented(basis), &velocities);
    let jacobian = basis.jacobian();
    let mut matrix = g.jacobian(&momenta, &velocities);
    for (i, row) in matrix.iter_mut().enumerate() {
        row.extend(jacobian.iter().map(|gradient| gradient[i]));
    }
    let r = jacobian.len();
    matrix.extend(jacobian.into_iter().map(|mut row| {
        row.extend(std::iter::repeat_n(g.zero(), r));
        row
    }));
    matrix
}

/// `(W + Σ κ f_vv) a + f_vᵀ κ' = F_q − F_vq v − F_vt` at frozen κ, `F = L + Σ κ f`, and `f_v a = −f_q v − f_t`.
fn solve(basis: &Basis<'_>) -> Result<(Vec<Expr>, Vec<Expr>), DeriveError> {
    let (system, g) = (basis.system, &basis.system.graph);
    let augmented = augmented(basis);
    let momenta = g.gradient(augmented, &system.velocity_symbols());
    let slopes = g.gradient(augmented, &system.coordinate_symbols());
    let mut right: Vec<Expr> = freeze_accelerations(system, &momenta)
        .into_iter()
        .zip(slopes)
        .map(|(moved, slope)| g.sub(slope, moved))
        .collect();
    let rows = basis.selection.rows.iter();
    right.extend(rows.map(|&row| basis.terms.constraint_rate[row]));
    let mut solution = g.solve(&extremum_matrix(basis).concat(), &right)?;
    let rates = solution.split_off(system.n());
    Ok((solution, rates))
}

/// (11), with κ' as symbols.
fn stated_equations(basis: &Basis<'_>) -> Vec<Equation> {
    let (system, g) = (basis.system, &basis.system.graph);
    let (constraints, jacobian) = (basis.constraints(), basis.jacobian());
    let coordinates = system.coordinate_symbols();
    let slopes = g.jacobian(&constraints, &coordinates);
    let kappas = kappa_names(basis);
    system
        .lagrange_left_sides()
        .into_iter()
        .enumerate()
        .map(|(i, left)| {
            let mut right = Vec::new();
            for (l, name) in kappas.iter().enumerate() {
                let moved = system.total_derivative(jacobian[l][i]);
                let euler = g.sub(slopes[l][i], moved);
                right.push(g.mul(&[g.symbol(name, 0), euler]));
                right.push(g.neg(g.mul(&[g.symbol(name, 1), jacobian[l][i]])));
            }
            Equation {
                label: system.coordinates[i].name.clone(),
                left,
                right: g.add(&right),
            }
        })
        .collect()
}

/// `π_i = p_i + Σ κ_l ∂f^l/∂vⁱ` and `H1 = Σ π_i vⁱ − L` (T1 (23), (24)) as functions of (q, v, κ, t).
fn extremal_objects(basis: &Basis<'_>) -> Vec<NamedExpr> {
    let (system, g) = (basis.system, &basis.system.graph);
    let momenta = g.gradient(augmented(basis), &system.velocity_symbols());
    let mut parts = vec![g.neg(system.lagrangian)];
    let mut objects = Vec::new();
    for (c, momentum) in system.coordinates.iter().zip(momenta) {
        parts.push(g.mul(&[momentum, c.v]));
        let name = unused_name(system, &format!("pi_{}", c.name));
        objects.push(NamedExpr::new(name, momentum, "momentum of the extremum"));
    }
    objects.push(NamedExpr::new(
        unused_name(system, "H1"),
        g.add(&parts),
        "Hamiltonian of the extremum as a function of (q, v, κ, t)",
    ));
    objects
}
