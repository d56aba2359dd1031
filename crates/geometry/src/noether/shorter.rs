//! An integral with products of two others added that make it shorter.

use super::motion::Motion;
use super::search::Integral;
use super::shown::{is_constant, readable, without_constant_factor};
use chetaev_mechanics::Context;
use chetaev_symbolic::simplify::length;
use chetaev_symbolic::{Expr, Symbol, Verdict};

/// The most sums that are looked at for one integral.
const TRIALS: usize = 40;

/// `G + c G_i G_j` for the products of integrals that are given, where that is shorter and proved; c is such that one term of second
/// degree cancels.
pub(super) fn shorter(
    cx: &Context<'_>,
    motion: &Motion<'_>,
    integral: Integral,
    others: &[Integral],
) -> Integral {
    let g = &cx.system.graph;
    let mut best = integral;
    let mut trials = 0;
    for (i, first) in others.iter().enumerate() {
        for second in &others[..=i] {
            let product = |a: Expr, b: Expr| g.mul(&[a, b]);
            let shown = product(first.shown, second.shown);
            let value = product(first.value, second.value);
            for factor in cancelling(cx, best.shown, shown) {
                trials += 1;
                if trials > TRIALS {
                    return best;
                }
                let with = |e: Expr, more: Expr| g.add(&[e, g.mul(&[factor, more])]);
                let sum = Integral {
                    value: with(best.value, value),
                    shown: readable(g, with(best.shown, shown)),
                    ..best.clone()
                };
                let sum = without_constant_factor(cx, sum);
                if length(g, sum.shown) < length(g, best.shown) {
                    let verdict = motion.is_integral(cx, sum.value);
                    if matches!(verdict, Verdict::Proved(_)) {
                        best = Integral { verdict, ..sum };
                    }
                }
            }
        }
    }
    best
}

/// The constants c for which a second derivative of `e + c product` vanishes that is a constant for both.
fn cancelling(cx: &Context<'_>, e: Expr, product: Expr) -> Vec<Expr> {
    let g = &cx.system.graph;
    let is_moving = |s: &Symbol| !is_constant(cx.system, g.symbol_expr(*s));
    let own = g.symbols_in(&[e]).into_iter().filter(is_moving);
    let own: Vec<Symbol> = own.collect();
    let mut found: Vec<Expr> = Vec::new();
    for (i, &a) in own.iter().enumerate() {
        let slopes = [e, product].map(|f| g.diff(f, a));
        for &b in &own[..=i] {
            let [of_e, of_product] = slopes.map(|f| readable(g, g.diff(f, b)));
            let are_constant = [of_e, of_product]
                .iter()
                .all(|&c| !g.is_zero(c) && is_constant(cx.system, c));
            if are_constant {
                let factor = readable(g, g.neg(g.div(of_e, of_product)));
                if !found.contains(&factor) {
                    found.push(factor);
                }
            }
        }
    }
    found
}
