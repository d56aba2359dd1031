//! Whether something is left out where equations are not defined: not where the functions that a model states have no value, as there are no states
//! of the system, and not where no constraint is satisfied.

use crate::real_roots::{bound_of, real_roots};
use crate::real_values::conditions;
use crate::steady::{at_point, closed};
use chetaev_mechanics::system::Relation;
use chetaev_mechanics::System;
use chetaev_symbolic::common_zeros::real_common_zeros;
use chetaev_symbolic::factors::irreducible_factors;
use chetaev_symbolic::polynomial::Budget;
use chetaev_symbolic::rational::is_negative;
use chetaev_symbolic::zero::assumptions::Assumptions;
use chetaev_symbolic::{Expr, Function, Graph, Node, Rational, Symbol};

/// Whether functions vanish together at no real state that satisfies the constraints.
pub(crate) fn vanish_nowhere(system: &System, functions: &[Expr], values: &[(Expr, Expr)]) -> bool {
    let g = &system.graph;
    let functions = functions.iter().flat_map(|&e| vanishing_together(g, e));
    let functions: Vec<Expr> = functions.collect();
    if functions.iter().any(|&e| has_no_real_zero(g, e)) {
        return true;
    }
    let symbols = [system.coordinate_symbols(), system.velocity_symbols()].concat();
    let constraints = system.constraints.iter().filter(|own| own.order <= 1);
    let constraints: Vec<Expr> = constraints.map(|own| own.stated).collect();
    let all = [functions, at_point(g, &constraints, &[values])].concat();
    let found = real_common_zeros(g, &all, &symbols, (&Assumptions::new(), BUDGET));
    found.is_some_and(|parts| parts.is_empty())
}

/// What vanishes where a function does: where it is a sum of squares that is written as one, all that is squared.
fn vanishing_together(g: &Graph, e: Expr) -> Vec<Expr> {
    let base = |own: Expr| match g.node(own) {
        Node::Power { base, exponent } => {
            let is_even = g.as_integer(*exponent).is_some_and(|n| n > 0 && n % 2 == 0);
            is_even.then_some(*base)
        }
        _ => None,
    };
    let bases: Option<Vec<Expr>> = match g.node(e) {
        Node::Sum { constant, terms } if constant.is_zero() => {
            let of = |(own, coefficient): &(Expr, Rational)| {
                base(*own).filter(|_| !is_negative(coefficient))
            };
            terms.iter().map(of).collect()
        }
        _ => base(e).map(|own| vec![own]),
    };
    match bases {
        Some(all) => {
            let all = all.into_iter();
            all.flat_map(|own| vanishing_together(g, own)).collect()
        }
        None => vec![e],
    }
}

/// Whether a function of one variable has no real zero.
fn has_no_real_zero(g: &Graph, e: Expr) -> bool {
    let roots = |symbol: Symbol| {
        let bound = bound_of(g, &[e], symbol)?;
        real_roots(g, e, symbol, &-bound.clone(), &bound)
    };
    match g.symbols_in(&[e])[..] {
        [symbol] => roots(symbol).is_some_and(|own| own.is_empty()),
        _ => false,
    }
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
