//! Even powers under roots, and sums written over a root.

use super::{simplify_flat, Options};
use crate::zero::assumptions::Assumptions;
use crate::zero::known_sign;
use crate::{Expr, Graph, Node};

/// Larger expressions, in nodes, are not written over their roots, nor such with more roots.
const LARGEST: usize = 160;
const ROOTS: usize = 2;

/// Candidates `A + B/√R` for each root that occurs: `c²√(1 - u) + c² u/√(1 - u)` as `c²/√(1 - u)`, since A and B contain R by whole
/// powers only.
pub(super) fn over_roots(g: &Graph, e: Expr, options: &Options) -> Vec<Expr> {
    let parts = g.reachable(&[e]);
    if parts.len() > LARGEST {
        return Vec::new();
    }
    let is_half = |exponent: Expr| {
        let twice = g.as_integer(g.mul(&[exponent, g.integer(2)]));
        twice.is_some_and(|n| n % 2 != 0)
    };
    let mut roots: Vec<(Expr, Vec<Expr>)> = Vec::new();
    for &part in &parts {
        let Node::Power { base, exponent } = g.node(part) else {
            continue;
        };
        if !is_half(*exponent) {
            continue;
        }
        match roots.iter_mut().find(|(own, _)| own == base) {
            Some((_, powers)) => powers.push(part),
            None => roots.push((*base, vec![part])),
        }
    }
    // By a single power nothing is gained.
    roots.retain(|(_, powers)| powers.len() > 1);
    if roots.len() > ROOTS {
        return Vec::new();
    }
    let candidate = |(base, powers): &(Expr, Vec<Expr>)| {
        let root = g.sqrt(*base);
        let negative: Vec<(Expr, Expr)> = powers.iter().map(|&part| (part, g.neg(part))).collect();
        let other = g.substitute(e, &negative);
        // Where the root is gone after the first time its radicand is no letter any more.
        let half = |e: Expr| {
            let once = simplify_flat(g, g.div(e, g.integer(2)), options);
            simplify_flat(g, once, options)
        };
        let even = half(g.add(&[e, other]));
        let odd = half(g.mul(&[root, g.sub(e, other)]));
        g.add(&[even, g.div(odd, root)])
    };
    roots.iter().map(candidate).collect()
}

/// A root with the even powers before it whose bases are not negative by their form: `√((1 + y²)⁻² c)` as `√c/(1 + y²)`. Other bases
/// stay, as their absolute values would have to stand outside.
pub(super) fn outside_root(g: &Graph, e: Expr) -> Expr {
    let Node::Power { base, exponent } = g.node(e) else {
        return e;
    };
    if g.as_number(*exponent).is_none_or(|n| n.is_int()) {
        return e;
    }
    let (coefficient, factors) = match g.node(*base) {
        Node::Product {
            coefficient,
            factors,
        } => (g.number(coefficient.clone()), factors.to_vec()),
        _ => (g.one(), vec![*base]),
    };
    let none = Assumptions::new();
    let stands_outside = |&factor: &Expr| {
        let (inner, power) = g.base_exponent(factor);
        let is_even = g.as_integer(power).is_some_and(|m| m % 2 == 0);
        is_even && known_sign(g, inner, &none).is_nonnegative()
    };
    let (outside, inside): (Vec<Expr>, Vec<Expr>) = factors.into_iter().partition(stands_outside);
    if outside.is_empty() {
        return e;
    }
    let mut parts: Vec<Expr> = outside
        .into_iter()
        .map(|factor| {
            let (inner, power) = g.base_exponent(factor);
            g.pow(inner, g.mul(&[power, *exponent]))
        })
        .collect();
    parts.push(g.pow(g.mul(&[&inside[..], &[coefficient]].concat()), *exponent));
    g.mul(&parts)
}
