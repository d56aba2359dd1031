//! The exact way: rational normal forms, within a budget, and separation bounds of numbers.

use super::assumptions::Assumptions;
use super::separation::vanishes;
use super::signs::Signs;
use crate::graph::Graph;
use crate::node::{Expr, Node};
use crate::polynomial::normal_form::{normal_forms, NormalFormError, Options};
use crate::polynomial::Budget;

/// What the normal form says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Exact {
    /// Zero, exactly.
    Zero,
    /// Numbers that are zero though no form shows it, by a separation bound.
    Separated,
    /// A denominator vanishes identically.
    Undefined,
    /// Not zero in its field, or too large.
    Open,
}

/// Beyond this many nodes no normal form is tried: a modular proof is faster.
const MOST_NODES: usize = 500;
/// Room for small identities only: a few tens of milliseconds at most.
const BUDGET: Budget = Budget {
    terms: 4_000,
    degree: 400,
    bits: 4_000,
    work: 2_000_000,
};
/// At most so many expressions known to be positive are handed on.
const MOST_POSITIVE: usize = 200;

/// Are all residuals zero in the field of their generators, by exact arithmetic?
pub(super) fn decide(graph: &Graph, residuals: &[Expr], assumptions: &Assumptions) -> Exact {
    let nodes = graph.reachable(residuals);
    if nodes.len() > MOST_NODES {
        return Exact::Open;
    }
    let mut signs = Signs::new(graph, assumptions);
    let mut options = Options::proof(BUDGET);
    options.positive = nodes
        .into_iter()
        .filter(|&e| {
            let scalar = !matches!(
                graph.node(e),
                Node::Number(_) | Node::Matrix { .. } | Node::Solve { .. }
            );
            scalar && signs.sign(e).is_positive()
        })
        .take(MOST_POSITIVE)
        .collect();
    match normal_forms(graph, residuals, &options) {
        Ok((_, values)) if values.iter().all(|value| value.is_zero()) => Exact::Zero,
        Err(NormalFormError::Undefined) => Exact::Undefined,
        _ if residuals.iter().all(|&e| vanishes(graph, e) == Some(true)) => Exact::Separated,
        _ => Exact::Open,
    }
}
