//! An identity that holds on some components of a constraint only: the constraint is factored and each factor asked by itself.

use super::decide::{decide_zero, ZeroTest};
use crate::factors::factors;
use crate::graph::Graph;
use crate::node::Expr;
use crate::verdict::{Counterexample, Proof, Verdict};

/// Decides the question for each factor of the first constraint that has several; `None` if no constraint factors or a factor
/// remains undecided.
pub(super) fn by_factors(graph: &Graph, test: &ZeroTest<'_>) -> Option<Verdict> {
    let (index, factors) = test
        .implicit
        .iter()
        .enumerate()
        .find_map(|(index, (f, symbol))| {
            let factors = factors(graph, *f, &[*symbol])?;
            (factors.len() > 1).then_some((index, factors))
        })?;
    let mut proved: Vec<(Expr, Proof)> = Vec::new();
    let mut refuted: Vec<Counterexample> = Vec::new();
    for (factor, _) in factors {
        let mut implicit = test.implicit.to_vec();
        implicit[index].0 = factor;
        match decide_zero(
            graph,
            &ZeroTest {
                implicit: &implicit,
                ..*test
            },
        ) {
            Verdict::Proved(proof) => proved.push((factor, proof)),
            Verdict::Refuted(counterexample) => refuted.push(counterexample),
            Verdict::Conditional {
                counterexample: Some(counterexample),
                ..
            } => refuted.push(counterexample),
            _ => return None,
        }
    }
    let counterexample = refuted.into_iter().next()?;
    let condition = proved
        .iter()
        .map(|(factor, _)| format!("{} = 0", graph.text(*factor)))
        .collect::<Vec<_>>()
        .join(" or ");
    let (_, mut proof) = proved.into_iter().next()?;
    // The proof speaks of the variety of the one factor, which is a component of the whole.
    let domain = proof
        .on
        .trim_start_matches("on every component of the constraint manifold, ")
        .trim_start_matches("on the constraint manifold, ");
    proof.on = format!("on the component {condition} of the constraint, {domain}");
    Some(Verdict::Conditional {
        condition,
        proof,
        counterexample: Some(counterexample),
    })
}
