//! Whether something is left out where equations are not defined: not where the functions that a model states have no value, as there are no states
//! of the system, and not where no constraint is satisfied.

use crate::real_values::conditions;
use crate::steady::{at_point, closed};
use chetaev_mechanics::system::Relation;
use chetaev_mechanics::System;
use chetaev_symbolic::common_zeros::real_common_zeros;
use chetaev_symbolic::factors::irreducible_factors;
use chetaev_symbolic::polynomial::Budget;
use chetaev_symbolic::zero::assumptions::Assumptions;
use chetaev_symbolic::{Expr, Function, Graph, Node, Symbol};

/// Whether functions vanish together at no real state that satisfies the constraints.
pub(crate) fn vanish_nowhere(system: &System, functions: &[Expr], values: &[(Expr, Expr)]) -> bool {
    let g = &system.graph;
    let symbols = [system.coordinate_symbols(), system.velocity_symbols()].concat();
    let constraints = system.constraints.iter().filter(|own| own.order <= 1);
    let constraints: Vec<Expr> = constraints.map(|own| own.stated).collect();
    let all = [functions.to_vec(), at_point(g, &constraints, &[values])].concat();
    let found = real_common_zeros(g, &all, &symbols, (&Assumptions::new(), BUDGET));
    found.is_some_and(|parts| parts.is_empty())
}

/// It is asked of sets that were found within little work.
const BUDGET: Budget = Budget {
    work: 5_000_000,
    ..Budget::PROOF
};

/// Whether L, a force or a constraint has no value where a function of the state vanishes.
pub(crate) fn is_pole(system: &System, e: Expr, values: &[(Expr, Expr)]) -> bool {
    let g = &system.graph;
    let symbols = [system.coordinate_symbols(), system.velocity_symbols()].concat();
    poles(system, values).into_iter().any(|pole| {
        factors_of(g, pole, &symbols)
            .into_iter()
            .any(|own| is_multiple(g, own, e))
    })
}

/// Functions at whose zeros something that is stated has no value.
fn poles(system: &System, values: &[(Expr, Expr)]) -> Vec<Expr> {
    let g = &system.graph;
    let constraints = system.constraints.iter().map(|own| own.stated);
    let stated: Vec<Expr> = std::iter::once(system.lagrangian)
        .chain(system.forces.iter().copied())
        .chain(constraints)
        .collect();
    let stated = at_point(g, &stated, &[values]);
    let conditions = conditions(g, &stated).into_iter();
    let strict = conditions.filter(|own| own.relation != Relation::LessOrEqual);
    let tangents = g.reachable(&stated).into_iter();
    let tangents = tangents.filter_map(|e| match g.node(e) {
        Node::Apply {
            function: Function::Tan,
            arguments,
        } => Some(g.apply(Function::Cos, &[*arguments.first()?])),
        _ => None,
    });
    strict.map(|own| own.function).chain(tangents).collect()
}

fn factors_of(g: &Graph, e: Expr, symbols: &[Symbol]) -> Vec<Expr> {
    let all = irreducible_factors(g, e, symbols);
    all.map_or_else(
        || vec![e],
        |all| all.into_iter().map(|(own, _)| own).collect(),
    )
}

/// Whether two functions vanish together because one is a multiple of the other by a number, without roots.
fn is_multiple(g: &Graph, a: Expr, b: Expr) -> bool {
    let ratio = g.div(without_root(g, a), without_root(g, b));
    g.as_number(closed(g, ratio)).is_some()
}

/// A function that vanishes where another does: what stands under its root.
fn without_root(g: &Graph, e: Expr) -> Expr {
    match g.node(e) {
        Node::Power { base, exponent } => {
            let number = g.as_number(*exponent);
            let is_root = number.is_some_and(|own| !chetaev_symbolic::rational::is_negative(own));
            if is_root {
                without_root(g, *base)
            } else {
                e
            }
        }
        _ => e,
    }
}
