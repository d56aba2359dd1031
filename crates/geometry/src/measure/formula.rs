//! Densities as a person writes them: without constant factors, positive where states are looked at.

use super::Flow;
use chetaev_mechanics::{sample, Context};
use chetaev_symbolic::{Expr, Node};

/// The states at which the sign of a density is looked at, and where their draws begin.
const SAMPLES: u64 = 8;
const SEED: u64 = 0x64_65_6e;

/// The density divided by constants; its negative where it is negative at all sampled states.
pub(super) fn plain(cx: &Context<'_>, flow: &Flow<'_>, density: Expr) -> Expr {
    let g = &cx.system.graph;
    let without = without_constants(flow, density);
    let points =
        (0..SAMPLES).filter_map(|i| sample::admissible_point(cx.system, cx.terms, SEED + i));
    let values = points.filter_map(|point| {
        let found = g.evaluate_f64(&[without], &|s| point.get(&s).copied()).ok();
        found.and_then(|values| values.first().copied())
    });
    let values: Vec<f64> = values.collect();
    // A root of a product whose constant factor is negative.
    if values.iter().any(|v| v.is_nan()) {
        return density;
    }
    match !values.is_empty() && values.iter().all(|&v| v < 0.0) {
        true => g.neg(without),
        false => without,
    }
}

/// The factors that do not move, of a product or of all terms of a sum; roots of products included.
fn without_constants(flow: &Flow<'_>, e: Expr) -> Expr {
    let g = &flow.motion.system.graph;
    let own = flow.symbols();
    let is_constant = |e: Expr| g.is_free_of(e, &|s| flow.motion.moves(s) || own.contains(&s));
    if is_constant(e) {
        return g.one();
    }
    match g.node(e) {
        Node::Product { factors, .. } => {
            let moving = factors.iter().copied().filter(|&f| !is_constant(f));
            let plain: Vec<Expr> = moving.map(|f| without_constants(flow, f)).collect();
            g.mul(&plain)
        }
        Node::Power { base, exponent } if is_constant(*exponent) => {
            g.pow(without_constants(flow, *base), *exponent)
        }
        Node::Sum { terms, constant } => {
            let constants = |e: Expr| -> Vec<Expr> {
                match g.node(e) {
                    Node::Product { factors, .. } => factors
                        .iter()
                        .copied()
                        .filter(|&f| is_constant(f))
                        .collect(),
                    _ if is_constant(e) => vec![e],
                    _ => Vec::new(),
                }
            };
            let shared = terms
                .iter()
                .map(|&(e, _)| constants(e))
                .reduce(|a, b| a.into_iter().filter(|f| b.contains(f)).collect());
            let shared = shared.filter(|_| constant.is_zero()).unwrap_or_default();
            let divided = terms.iter().map(|(term, c)| {
                let reciprocals = shared.iter().map(|&f| g.powi(f, -1));
                let parts: Vec<Expr> = [g.number(c.clone()), *term]
                    .into_iter()
                    .chain(reciprocals)
                    .collect();
                g.mul(&parts)
            });
            match shared.is_empty() {
                true => e,
                false => g.add(&divided.collect::<Vec<Expr>>()),
            }
        }
        _ => e,
    }
}
