//! Even powers under roots.

use crate::zero::assumptions::Assumptions;
use crate::zero::known_sign;
use crate::{Expr, Graph, Node};

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
