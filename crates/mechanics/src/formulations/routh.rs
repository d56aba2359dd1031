//! Routh's equations with multipliers under Chetaev's condition.
//!
//! `D(∂L/∂vⁱ) - ∂L/∂qⁱ = Qᵢ + Σ λ_l ∂f^l/∂vⁱ`, `f^l = 0` (T1 (2)); with `f` differentiated once this is the bordered
//! linear system `W a - Jᵀ λ = b`, `J a = g` for (a, λ), which needs only that it is regular, not that W is.

use super::{Basis, DeriveError, Formulation};
use crate::card::{Card, Principle, Source};
use crate::equations::{Equation, EquationGroup, Equations, NamedExpr};
use chetaev_symbolic::Expr;

/// Multipliers, Routh–Chetaev.
#[derive(Clone, Copy, Debug)]
pub struct Routh;

static CARD: Card = Card {
    name: "routh",
    title: "Routh's equations with multipliers",
    statement: "Lagrange's equations of all coordinates with the reactions λ ∂f/∂q' of the constraints on the right.",
    principle: Principle::DalembertLagrangeChetaev,
    requires: &["model.accelerations-unique"],
    unknowns: "accelerations of all coordinates and one multiplier for each independent constraint",
    sources: &[
        Source { key: "routh1905", place: "ch. IV" },
        Source { key: "chetaev1932", place: "§§1–3" },
        Source { key: "rumyantsev1982", place: "(1.3)" },
    ],
};

impl Formulation for Routh {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn equations(&self, basis: &Basis<'_>) -> Result<Equations, DeriveError> {
        let (accelerations, values) = solve(basis)?;
        let (system, terms) = (basis.system, basis.terms);
        let multipliers: Vec<(usize, Expr)> = basis
            .selection
            .rows
            .iter()
            .zip(values)
            .map(|(&row, value)| (terms.constraint_index[row], value))
            .collect();
        let objects = multipliers
            .iter()
            .map(|(l, value)| NamedExpr {
                name: format!("lambda_{}", system.constraints[*l].name),
                value: *value,
                meaning: format!("multiplier of `{}`", system.constraints[*l].name),
            })
            .collect();
        Ok(Equations {
            formulation: CARD.name,
            groups: stated_equations(basis),
            objects,
            characteristics: None,
            accelerations,
            rates: Vec::new(),
            multipliers,
        })
    }
}

/// The bordered system, solved as one node: accelerations, then multipliers of the selected rows.
fn solve(basis: &Basis<'_>) -> Result<(Vec<Expr>, Vec<Expr>), DeriveError> {
    let (system, terms) = (basis.system, basis.terms);
    let g = &system.graph;
    let (n, rows) = (system.n(), &basis.selection.rows);
    let size = n + rows.len();
    let mut matrix = vec![g.zero(); size * size];
    let mut rhs = terms.force.clone();
    for i in 0..n {
        for j in 0..n {
            matrix[i * size + j] = terms.mass_matrix[i][j];
        }
    }
    for (l, &row) in rows.iter().enumerate() {
        for j in 0..n {
            matrix[(n + l) * size + j] = terms.jacobian[row][j];
            matrix[j * size + n + l] = g.neg(terms.jacobian[row][j]);
        }
        rhs.push(terms.constraint_rate[row]);
    }
    let mut solution = g.solve(&matrix, &rhs)?;
    let multipliers = solution.split_off(n);
    Ok((solution, multipliers))
}

fn stated_equations(basis: &Basis<'_>) -> Vec<EquationGroup> {
    let (system, terms) = (basis.system, basis.terms);
    let g = &system.graph;
    let left_sides = system.lagrange_left_sides();
    let motion = system
        .coordinates
        .iter()
        .enumerate()
        .map(|(i, c)| {
            let mut right = vec![system.forces[i]];
            for &row in &basis.selection.rows {
                let name = &system.constraints[terms.constraint_index[row]].name;
                let lambda = g.symbol(&format!("lambda_{name}"), 0);
                right.push(g.mul(&[lambda, terms.jacobian[row][i]]));
            }
            Equation {
                label: c.name.clone(),
                left: left_sides[i],
                right: g.add(&right),
            }
        })
        .collect();
    let constraints = basis
        .selection
        .rows
        .iter()
        .map(|&row| {
            let constraint = &system.constraints[terms.constraint_index[row]];
            Equation {
                label: constraint.name.clone(),
                left: constraint.stated,
                right: g.zero(),
            }
        })
        .collect();
    vec![
        EquationGroup {
            title: "equations of motion".into(),
            equations: motion,
        },
        EquationGroup {
            title: "constraints".into(),
            equations: constraints,
        },
    ]
}
