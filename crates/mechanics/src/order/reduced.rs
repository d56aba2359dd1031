//! The equations of motion without multipliers: what the independent derivatives obey once the multipliers are taken from
//! the dependent ones.

use super::determined::balance_condition;
use super::highest_derivative;
use crate::equations::NamedExpr;
use crate::formulations::Basis;
use crate::linear::dot;
use chetaev_symbolic::linear::SolveError;
use chetaev_symbolic::{Expr, Symbol};

/// `w_i - Σ_l λ_l A^l_i` for the independent i, with λ from the equations of the dependent ones, as functions on the jet of
/// coordinates; length k.
///
/// # Errors
/// [`SolveError`] where the dependent part of A is singular by its form.
pub fn without_multipliers(basis: &Basis<'_>) -> Result<Vec<Expr>, SolveError> {
    let (system, g) = (basis.system, &basis.system.graph);
    let (w, rows) = (system.motion_left_sides(), basis.jacobian());
    let dependent = &basis.selection.dependent;
    let matrix: Vec<Expr> = dependent
        .iter()
        .flat_map(|&d| rows.iter().map(move |row| row[d]))
        .collect();
    let right: Vec<Expr> = dependent.iter().map(|&d| w[d]).collect();
    let multipliers = match rows.is_empty() {
        true => Vec::new(),
        false => g.solve(&matrix, &right)?,
    };
    let independent = basis.selection.independent(system.n()).into_iter();
    Ok(independent
        .map(|i| {
            let column: Vec<Expr> = rows.iter().map(|row| row[i]).collect();
            g.sub(w[i], dot(g, &multipliers, &column))
        })
        .collect())
}

/// What a motion keeps, as functions of the derivatives of coordinates and of the multipliers themselves: conditions that
/// contain derivatives of multipliers are replaced by derivatives of the equations without multipliers.
pub fn observable_conditions(basis: &Basis<'_>, conditions: &[NamedExpr]) -> Vec<NamedExpr> {
    let (system, g, m) = (basis.system, &basis.system.graph, basis.terms.order);
    let derivatives: Vec<Symbol> = (1..m)
        .flat_map(|order| {
            let names = basis.multiplier_names().into_iter();
            names.map(move |name| g.intern_symbol(&name, order))
        })
        .collect();
    let observable = conditions.iter();
    let mut found: Vec<NamedExpr> = observable
        .filter(|c| !g.contains_any(c.value, &derivatives))
        .cloned()
        .collect();
    if found.len() == conditions.len() {
        return found;
    }
    let Ok(reduced) = without_multipliers(basis) else {
        return found;
    };
    let independent = basis.selection.independent(system.n());
    for (i, equation) in independent.into_iter().zip(reduced) {
        let own = highest_derivative(system, &[equation]).unwrap_or(0);
        let mut value = equation;
        for times in 1..m.saturating_sub(own) {
            value = system.total_derivative(value);
            let label = format!("{} without multipliers", system.coordinates[i].name);
            found.push(balance_condition(&label, times, value));
        }
    }
    found
}
