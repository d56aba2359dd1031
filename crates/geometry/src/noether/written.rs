//! Functions of the state as they are written: in the quasi-velocities that the model states, the energy by the terms of L.

use super::family::Letter;
use super::letters::definitions;
use chetaev_mechanics::{Context, Frame, System};
use chetaev_symbolic::{simplify, Expr, Graph, Node, Symbol};
use std::collections::BTreeMap;

/// The energy as it is shown, or made of the terms of L as these are stated, in the quasi-velocities that the model states where their
/// definitions occur in it; whichever is shortest.
pub(super) fn as_stated(cx: &Context<'_>, shown: Expr) -> Expr {
    let (system, g) = (cx.system, &cx.system.graph);
    let terms = termwise_energy(system);
    let named = match Frame::stated(system, cx.terms, cx.selection) {
        Some(Ok((frame, _))) => {
            let own = definitions(system, &frame).into_iter();
            // A sum stands with either sign before it, and with one of them under a square.
            let signs = |l: Letter| [(l.value, l.shown), (g.neg(l.value), g.neg(l.shown))];
            let pairs: Vec<(Expr, Expr)> = own.flat_map(signs).collect();
            g.substitute(terms, &pairs)
        }
        _ => terms,
    };
    let all = [shown, terms, named];
    let shortest = all.into_iter().min_by_key(|&e| simplify::length(g, e));
    shortest.unwrap_or(shown)
}

/// `Σ pᵢ vⁱ - L`, term by term: `(d - 1) f` for each term f of L that is homogeneous of degree d in the velocities by its form, so that a
/// kinetic energy stands there as it is stated.
fn termwise_energy(system: &System) -> Expr {
    let g = &system.graph;
    let terms: Vec<Expr> = match g.node(system.lagrangian) {
        Node::Sum { terms, constant } => {
            let own = terms.iter().map(|(e, c)| g.scale(c, *e));
            own.chain([g.number(constant.clone())]).collect()
        }
        _ => vec![system.lagrangian],
    };
    let velocities = system.velocity_symbols();
    let energy = |f: Expr| match degree(g, f, &velocities) {
        Some(d) => g.mul(&[g.integer(d - 1), f]),
        None => {
            let slopes = g.gradient(f, &velocities);
            let pairs = slopes.into_iter().zip(&system.coordinates);
            let powers = pairs.map(|(slope, c)| g.mul(&[slope, c.v]));
            g.add(&powers.chain([g.neg(f)]).collect::<Vec<Expr>>())
        }
    };
    g.add(&terms.into_iter().map(energy).collect::<Vec<Expr>>())
}

/// The degree in the velocities of what is homogeneous in them by its form.
pub(super) fn degree(g: &Graph, e: Expr, velocities: &[Symbol]) -> Option<i64> {
    if !g.contains_any(e, velocities) {
        return Some(0);
    }
    // Ascending handles are a topological order: what an expression is made of comes before it.
    let mut known: BTreeMap<Expr, Option<i64>> = BTreeMap::new();
    for part in g.reachable(&[e]) {
        let of = |e: &Expr| known.get(e).copied().flatten();
        let own = match g.node(part) {
            _ if !g.contains_any(part, velocities) => Some(0),
            Node::Symbol(_) => Some(1),
            Node::Product { factors, .. } => factors.iter().map(of).sum::<Option<i64>>(),
            Node::Power { base, exponent } => {
                g.as_integer(*exponent).and_then(|n| Some(n * of(base)?))
            }
            Node::Sum { terms, constant } => {
                let first = terms.first().and_then(|(e, _)| of(e));
                let alike = terms.iter().all(|(e, _)| of(e) == first);
                first.filter(|&d| alike && (d == 0 || constant.is_zero()))
            }
            _ => None,
        };
        known.insert(part, own);
    }
    known.get(&e).copied().flatten()
}

/// Larger functions, in nodes, are not rewritten in quasi-velocities.
const REWRITTEN: usize = 400;

/// Functions of the state as they are shown: in the quasi-velocities that the model states where that is not longer.
pub(super) fn in_quasi_velocities(cx: &Context<'_>, values: &[Expr]) -> Vec<Expr> {
    let (system, g) = (cx.system, &cx.system.graph);
    let as_they_are = || values.to_vec();
    let Some(Ok((frame, _))) = Frame::stated(system, cx.terms, cx.selection) else {
        return as_they_are();
    };
    let is_adapted = |s: usize| frame.adapted.iter().any(|&(_, speed)| speed == s);
    let speeds = frame.speeds.iter().enumerate();
    let speeds: Vec<Expr> = speeds
        .map(|(s, speed)| if is_adapted(s) { g.zero() } else { speed.value })
        .collect();
    let velocities = frame.velocities(system, &speeds);
    let own = system.coordinates.iter().map(|c| c.v);
    let pairs: Vec<(Expr, Expr)> = own.zip(velocities).collect();
    let shorter = |value: Expr| {
        let rewritten = g.substitute(value, &pairs);
        if g.reachable(&[rewritten]).len() > REWRITTEN {
            return value;
        }
        let rewritten = simplify::simplify(g, rewritten, &simplify::Options::default());
        match simplify::length(g, rewritten) <= simplify::length(g, value) {
            true => rewritten,
            false => value,
        }
    };
    values.iter().map(|&value| shorter(value)).collect()
}
