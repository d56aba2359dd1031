//! An identity that holds on some components of a constraint only: the constraint is factored and each factor asked by itself.

use super::decide::{decide_zero, ZeroTest};
use crate::graph::Graph;
use crate::node::{Expr, Symbol};
use crate::polynomial::normal_form::{normal_forms, Options};
use crate::polynomial::Budget;
use crate::verdict::{Counterexample, Proof, Verdict};

/// Room for the factorization of a constraint.
const BUDGET: Budget = Budget {
    terms: 2_000,
    degree: 60,
    bits: 2_000,
    work: 2_000_000,
};

/// Decides the question for each factor of the first constraint that has several; `None` if no constraint factors or a factor
/// remains undecided.
pub(super) fn by_factors(graph: &Graph, test: &ZeroTest<'_>) -> Option<Verdict> {
    let (index, factors) = test
        .implicit
        .iter()
        .enumerate()
        .find_map(|(index, (f, symbol))| {
            let factors = factors_with(graph, *f, *symbol)?;
            (factors.len() > 1).then_some((index, factors))
        })?;
    let mut proved: Vec<(Expr, Proof)> = Vec::new();
    let mut refuted: Vec<Counterexample> = Vec::new();
    for factor in factors {
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

/// The factors of a constraint that contain its symbol.
fn factors_with(graph: &Graph, f: Expr, symbol: Symbol) -> Option<Vec<Expr>> {
    let (field, values) = normal_forms(graph, &[f], &Options::display(BUDGET)).ok()?;
    let factorization = values.first()?.numerator().factorize(field.meter()).ok()?;
    let expressions = factorization
        .factors
        .iter()
        .map(|(factor, _)| field.polynomial_expression(factor));
    Some(
        expressions
            .filter(|&factor| graph.contains_any(factor, &[symbol]))
            .collect(),
    )
}
