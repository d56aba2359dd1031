//! Values of the parameters of a system, with some of them left in.

use chetaev_mechanics::system::Parameter;
use chetaev_mechanics::System;
use chetaev_symbolic::{Expr, Symbol};

/// The values of all parameters but one. Parameters whose definitions contain that one are put in by their definitions.
pub fn values_but(system: &System, over: Option<Symbol>) -> Vec<(Expr, Expr)> {
    values_but_these(system, over.as_slice())
}

/// The values of all parameters but some. Parameters whose definitions contain one of these are put in by their definitions.
pub fn values_but_these(system: &System, over: &[Symbol]) -> Vec<(Expr, Expr)> {
    let g = &system.graph;
    let all = system.parameter_values();
    if over.is_empty() {
        return all;
    }
    let mut values: Vec<(Expr, Expr)> = Vec::new();
    for (symbol, value) in all {
        let definition = system
            .definitions
            .iter()
            .find(|(own, _)| *own == symbol)
            .map(|(_, e)| *e);
        let expanded = definition.map(|e| expanded(system, e));
        match expanded.filter(|&e| g.contains_any(e, over)) {
            Some(e) => values.push((symbol, with_values(system, e, over))),
            None if g.as_symbol(symbol).is_some_and(|s| over.contains(&s)) => {}
            None => values.push((symbol, value)),
        }
    }
    values
}

/// A definition with the definitions that it uses.
fn expanded(system: &System, e: Expr) -> Expr {
    let g = &system.graph;
    let mut e = e;
    for _ in 0..system.definitions.len() {
        let next = g.substitute(e, &system.definitions);
        if next == e {
            break;
        }
        e = next;
    }
    e
}

/// The values of all parameters with a value for one of them, and with what follows for those that are defined by it.
pub fn values_at(system: &System, over: Symbol, at: Expr) -> Vec<(Expr, Expr)> {
    let g = &system.graph;
    let own = (g.symbol_expr(over), at);
    let others = values_but(system, Some(over)).into_iter();
    let others = others.map(|(symbol, value)| (symbol, g.substitute(value, &[own])));
    others.chain([own]).collect()
}

/// An expression of parameters with the values of all but some.
fn with_values(system: &System, e: Expr, over: &[Symbol]) -> Expr {
    let g = &system.graph;
    let values: Vec<(Expr, Expr)> = system.parameter_values();
    let values: Vec<(Expr, Expr)> = values
        .into_iter()
        .filter(|(s, _)| !g.as_symbol(*s).is_some_and(|s| over.contains(&s)))
        .collect();
    g.substitute(e, &values)
}

/// The names of the parameters without a value that occur in functions: what is said by these speaks of general values of them.
pub fn general_parameters(system: &System, functions: &[Expr]) -> Vec<String> {
    let g = &system.graph;
    let is_open = |own: &&Parameter| {
        let symbol = g.as_symbol(own.expr);
        own.value.is_none() && symbol.is_some_and(|s| g.any_contains_any(functions, &[s]))
    };
    let open = system.parameters.iter().filter(is_open);
    open.map(|own| own.name.clone()).collect()
}

/// For which values of the parameters something is said, given those that are general.
pub(crate) fn for_which(general: &[String]) -> String {
    match general {
        [] => "for the values of the parameters that are stated".into(),
        names => format!(
            "for general values of {}, others as stated; special values are not asked",
            names.join(", ")
        ),
    }
}

/// What is said, with the parameters of which it is said in general.
pub(crate) fn of_general(said: String, general: &[String]) -> String {
    match general {
        [] => said,
        names => format!("{said}; {}", for_which(names)),
    }
}

/// What a model states of motions: L, forces, constraints and laws of controls, with the definitions that they use.
pub fn stated_functions(system: &System) -> Vec<Expr> {
    let constraints = system.constraints.iter().map(|own| own.stated);
    let laws = system.controls.iter().filter_map(|own| own.law);
    let all = std::iter::once(system.lagrangian)
        .chain(system.forces.iter().copied())
        .chain(constraints)
        .chain(laws);
    all.map(|e| system.with_definitions(e)).collect()
}
