//! Integrals as a person writes them.

use super::search::Integral;
use chetaev_mechanics::{Context, System};
use chetaev_symbolic::simplify::{length, simplify, Options};
use chetaev_symbolic::{Expr, Graph, Node, Rational, Symbol};

/// Larger expressions, in nodes, are shown as they are.
const READABLE: usize = 90;

/// Whether nothing but parameters occurs; what is shown may contain names of quasi-velocities.
pub(crate) fn is_constant(system: &System, e: Expr) -> bool {
    let g = &system.graph;
    let is_parameter = |s: Symbol| system.parameters.iter().any(|p| p.name == g.symbol_name(s));
    g.symbols_in(&[e]).into_iter().all(is_parameter)
}

/// An integral in the letters of its family or in velocities, whichever is shorter: letters may be related.
pub(super) fn shortest(g: &Graph, integral: &Integral) -> Expr {
    let [shown, value] = [integral.shown, integral.value].map(|e| readable(g, e));
    match length(g, value) < length(g, shown) {
        true => value,
        false => shown,
    }
}

/// The integral divided by what all its terms share and nothing moves, as (1 + a²)^(3/2).
pub(super) fn without_constant_factor(cx: &Context<'_>, integral: Integral) -> Integral {
    let g = &cx.system.graph;
    let Node::Product {
        coefficient,
        factors,
    } = g.node(integral.shown)
    else {
        return without_first_minus(g, integral);
    };
    let constant = factors.iter().copied();
    let constant: Vec<Expr> = constant.filter(|&f| is_constant(cx.system, f)).collect();
    if constant.is_empty() && *coefficient == Rational::ONE {
        return without_first_minus(g, integral);
    }
    let by = g.mul(&[&[g.number(coefficient.clone())], &constant[..]].concat());
    let divided = Integral {
        value: g.div(integral.value, by),
        shown: g.div(integral.shown, by),
        name: None,
        ..integral
    };
    without_first_minus(g, divided)
}

/// The integral or its negative, whichever is not written with a minus in front.
fn without_first_minus(g: &Graph, integral: Integral) -> Integral {
    let negative = g.neg(integral.shown);
    let begins = |e: Expr| g.text(e).starts_with('-');
    match begins(integral.shown) && !begins(negative) {
        true => Integral {
            value: g.neg(integral.value),
            shown: negative,
            name: None,
            ..integral
        },
        false => integral,
    }
}

/// An expression as a person would write it, where that does not take long.
pub(crate) fn readable(g: &Graph, e: Expr) -> Expr {
    match g.reachable(&[e]).len() <= READABLE {
        true => simplify(g, e, &Options::default()),
        false => e,
    }
}
