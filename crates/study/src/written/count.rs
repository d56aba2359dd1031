//! How many operations the equations of a formulation have as they are printed.

use crate::derivation::{options_of, Derivation};
use chetaev_mechanics::formulations::reduced_form::DEFINITIONS;
use chetaev_mechanics::System;
use chetaev_symbolic::print::{Document, Operations};
use chetaev_symbolic::Expr;

/// The operations of the equations and of the names that they share; definitions of quasi-velocities and intermediate objects are not
/// counted.
pub(crate) fn operations(system: &System, one: &Derivation) -> Operations {
    let groups = one.groups.iter();
    let pairs: Vec<(Expr, Expr)> = groups
        .filter(|group| group.title != DEFINITIONS)
        .flat_map(|group| group.pairs.iter().copied())
        .collect();
    let options = options_of(system, one);
    Document::equations(&system.graph, &pairs, &options).operations()
}

/// A line for a terminal.
pub(super) fn line(system: &System, one: &Derivation) -> String {
    let found = operations(system, one);
    format!(
        "{}: {} operations: {} + and −, {} ×, {} ÷, {} powers, {} roots, {} functions\n",
        one.card.name,
        found.total(),
        found.sums,
        found.products,
        found.quotients,
        found.powers,
        found.roots,
        found.functions
    )
}
