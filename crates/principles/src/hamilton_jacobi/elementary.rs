//! Integrals of the quadratures of a separated complete integral, where they are elementary.

use super::applicable::free;
use chetaev_mechanics::claims::Context;
use chetaev_mechanics::equations::unused_name;
use chetaev_mechanics::prover::assumptions;
use chetaev_symbolic::zero::known_sign;
use chetaev_symbolic::{simplify, Expr, Function, Node, Symbol, Verdict};

/// `∫ e dq` for `e = a + b √R`, a and b free of q and R a polynomial in q of the second degree at most, whose leading coefficient
/// has a known sign. The derivative of what is returned is proved to be e.
pub fn elementary(cx: &Context<'_>, e: Expr, q: Symbol) -> Option<Expr> {
    let (system, g) = (cx.system, &cx.system.graph);
    let coordinate = g.symbol_expr(q);
    let integral = match roots(cx, e, q).as_slice() {
        [] if !g.contains_any(e, &[q]) => g.mul(&[e, coordinate]),
        [root] => {
            let name = unused_name(system, "root");
            let (own, symbol) = (g.symbol(&name, 0), g.intern_symbol(&name, 0));
            let linear = g.substitute(e, &[(*root, own)]);
            let factor = g.diff(linear, symbol);
            let rest = g.substitute(linear, &[(own, g.zero())]);
            if g.any_contains_any(&[factor, rest], &[q, symbol]) {
                return None;
            }
            let Node::Power { base, .. } = g.node(*root) else {
                return None;
            };
            let of_root = of_root(cx, *base, q)?;
            g.add(&[g.mul(&[rest, coordinate]), g.mul(&[factor, of_root])])
        }
        _ => return None,
    };
    let residual = g.sub(g.diff(integral, q), e);
    let verdict = cx.prover.identity(system, &[residual], &free(), "");
    matches!(verdict, Verdict::Proved(_)).then_some(integral)
}

/// Square roots that contain q.
fn roots(cx: &Context<'_>, e: Expr, q: Symbol) -> Vec<Expr> {
    let g = &cx.system.graph;
    let half = g.div(g.one(), g.integer(2));
    let is_root =
        |e: &Expr| matches!(g.node(*e), Node::Power { exponent, .. } if *exponent == half);
    let all = g.reachable(&[e]).into_iter();
    all.filter(is_root)
        .filter(|&root| g.contains_any(root, &[q]))
        .collect()
}

/// `∫ √(A + B q + C q²) dq`.
fn of_root(cx: &Context<'_>, radicand: Expr, q: Symbol) -> Option<Expr> {
    let g = &cx.system.graph;
    let number = |n: i64| g.integer(n);
    let simple = |e: Expr| simplify::simplify(g, e, &simplify::Options::default());
    let at_zero = |e: Expr| simple(g.substitute(e, &[(g.symbol_expr(q), g.zero())]));
    let first = g.diff(radicand, q);
    let second = simple(g.diff(first, q));
    if g.contains_any(second, &[q]) {
        return None;
    }
    let (a, b) = (at_zero(radicand), at_zero(first));
    let c = simple(g.div(second, number(2)));
    let root = g.sqrt(radicand);
    if g.is_zero(c) {
        let cube = g.mul(&[radicand, root]);
        return (!g.is_zero(b)).then(|| g.div(g.mul(&[number(2), cube]), g.mul(&[number(3), b])));
    }
    let slope = g.add(&[g.mul(&[number(2), c, g.symbol_expr(q)]), b]);
    let discriminant = g.sub(g.mul(&[b, b]), g.mul(&[number(4), a, c]));
    let sign = known_sign(g, c, &assumptions(cx.system));
    // ∫ dq/√R.
    let inverse = if sign.is_positive() {
        let lead = g.sqrt(c);
        let argument = g.add(&[g.mul(&[number(2), lead, root]), slope]);
        g.div(g.apply(Function::Log, &[argument]), lead)
    } else if known_sign(g, g.neg(c), &assumptions(cx.system)).is_positive() {
        // The arc tangent contains no further root, as the arc sine does.
        let lead = g.sqrt(g.neg(c));
        let tangent = g.div(g.neg(slope), g.mul(&[number(2), lead, root]));
        g.div(g.apply(Function::Atan, &[tangent]), lead)
    } else {
        return None;
    };
    let weight = g.div(discriminant, g.mul(&[number(8), c]));
    Some(g.sub(
        g.div(g.mul(&[slope, root]), g.mul(&[number(4), c])),
        g.mul(&[weight, inverse]),
    ))
}
