//! Flows written as text.

#![allow(dead_code)] // each test file uses its part

use chetaev_integrals::flow::{Flow, Variable};
use chetaev_symbolic::syntax::{lower, parse_expression, Resolution, Scope};
use chetaev_symbolic::{Expr, Graph};

struct EveryName<'g>(&'g Graph);

impl Scope for EveryName<'_> {
    fn resolve(&self, name: &str, order: u32) -> Resolution {
        Resolution::Known(self.0.symbol(name, order))
    }
    fn names(&self) -> Vec<String> {
        Vec::new()
    }
}

pub(crate) fn expr(g: &Graph, text: &str) -> Expr {
    let parsed = parse_expression(text);
    let mut diagnostics = Vec::new();
    let e = lower(
        g,
        &parsed.tree,
        parsed.root(),
        &EveryName(g),
        &[],
        &mut diagnostics,
    );
    assert!(!parsed.has_errors() && diagnostics.is_empty(), "{text}");
    e.unwrap()
}

/// Variables with their rates; every other name is a constant.
pub(crate) fn flow<'g>(g: &'g Graph, rates: &[(&str, &str)]) -> Flow<'g> {
    let variables = rates.iter().map(|(name, rate)| Variable {
        symbol: g.intern_symbol(name, 0),
        rate: expr(g, rate),
    });
    Flow {
        graph: g,
        variables: variables.collect(),
    }
}
