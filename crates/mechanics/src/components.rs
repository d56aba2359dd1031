//! Components of constraints that are products: `(z' - x') (y' - 1) = 0` holds where one of the factors vanishes.
//!
//! A chart that gives a dependent velocity by the others covers the components in whose factor that velocity occurs; where
//! another factor vanishes, the equation says nothing of it.

use crate::selection::Selection;
use crate::system::System;
use crate::terms::MotionTerms;
use chetaev_symbolic::factors::factors;
use chetaev_symbolic::{Expr, Symbol};

/// The factors of a constraint function in which velocities of the highest order occur, where there are several.
pub(crate) fn factors_of(system: &System, terms: &MotionTerms, row: usize) -> Vec<Expr> {
    let velocities: Vec<Symbol> = terms.jets.iter().map(|c| c.v_symbol).collect();
    let g = &system.graph;
    let gradient = &terms.jacobian[row];
    // What is affine in them has one such factor.
    if !g.any_contains_any(gradient, &velocities) {
        return Vec::new();
    }
    let list = factors(g, terms.constraints[row], &velocities).unwrap_or_default();
    match list.len() {
        0 | 1 => Vec::new(),
        _ => list.into_iter().map(|(factor, _)| factor).collect(),
    }
}

/// The components that the independent velocities of a selection describe, as equations, where they leave others out:
/// `y' = z' + x` of `(y' - z' - x) z' = 0` solved for y'.
pub fn covered(system: &System, terms: &MotionTerms, selection: &Selection) -> Option<String> {
    let g = &system.graph;
    let rows = selection.rows.iter().zip(&selection.dependent);
    let covered: Vec<String> = rows
        .filter_map(|(&row, &dependent)| {
            let all = factors_of(system, terms, row);
            let own = terms.jets.get(dependent)?.v_symbol;
            let with = all.iter().filter(|&&f| g.contains_any(f, &[own]));
            let with: Vec<String> = with.map(|&f| format!("{} = 0", g.text(f))).collect();
            (with.len() < all.len()).then(|| with.join(" or "))
        })
        .collect();
    (!covered.is_empty()).then(|| covered.join(", "))
}
