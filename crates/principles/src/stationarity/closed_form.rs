//! Expressions as they can be looked at: without linear solves, with sines and cosines.

use chetaev_mechanics::linear::dot;
use chetaev_symbolic::{simplify, Expr, Function, Graph, Node, Symbol};

/// Longer closed forms of one function are not looked for.
const LONGEST: u64 = 1_200;

/// Of expressions of more nodes no closed form is looked for.
const LARGEST: usize = 250;
const NOT_SHORT: &str = "the motion has no short closed form";

/// An expression written with sines and cosines, and simplified with linear solves worked out.
pub(crate) fn short(g: &Graph, e: Expr) -> Expr {
    let options = simplify::Options {
        max_closed_form: LONGEST,
        ..simplify::Options::default()
    };
    let simple = simplify::simplify(g, e, &options);
    let quotients: Vec<(Expr, Expr)> = g
        .reachable(&[simple])
        .into_iter()
        .filter_map(|e| Some((e, as_quotient(g, e)?)))
        .collect();
    match quotients.is_empty() {
        true => simple,
        false => simplify::simplify(g, g.substitute(simple, &quotients), &options),
    }
}

/// [`short`], where no linear solve is left.
pub(crate) fn closed(g: &Graph, e: Expr) -> Result<Expr, String> {
    if g.reachable(&[e]).len() > LARGEST {
        return Err(NOT_SHORT.into());
    }
    let e = short(g, e);
    let is_solve = |e: Expr| matches!(g.node(e), Node::Matrix { .. });
    match g.reachable(&[e]).into_iter().any(is_solve) {
        true => Err(NOT_SHORT.into()),
        false => Ok(e),
    }
}

/// `J Jᵀ`, row by row.
pub(crate) fn gram(g: &Graph, jacobian: &[Vec<Expr>]) -> Vec<Expr> {
    let rows = jacobian.iter();
    rows.flat_map(|a| jacobian.iter().map(move |b| dot(g, a, b)))
        .collect()
}

/// A value of a coordinate at which a sine, a cosine or an affine function of it vanishes.
pub(crate) fn zero_of(g: &Graph, factor: Expr, coordinates: &[Symbol]) -> Option<(Expr, Expr)> {
    let occurring = g.symbols_in(&[factor]);
    let &symbol = coordinates.iter().find(|s| occurring.contains(s))?;
    let coordinate = g.symbol_expr(symbol);
    let affine = |e: Expr, value: Expr| {
        let slope = g.diff(e, symbol);
        let rest = g.substitute(e, &[(coordinate, g.zero())]);
        let free = !g.contains_any(slope, &[symbol]) && !g.is_zero(slope);
        free.then(|| (coordinate, g.div(g.sub(value, rest), slope)))
    };
    match g.node(factor) {
        Node::Apply {
            function: Function::Sin,
            arguments,
        } => affine(arguments[0], g.zero()),
        Node::Apply {
            function: Function::Cos,
            arguments,
        } => affine(arguments[0], g.div(g.pi(), g.integer(2))),
        _ => affine(factor, g.zero()),
    }
}

/// tan, cot, sec, csc by sine and cosine, and sin acos x as √(1 − x²).
fn as_quotient(g: &Graph, e: Expr) -> Option<Expr> {
    root_of_inverse(g, e).or_else(|| simplify::as_quotient(g, e))
}

fn root_of_inverse(g: &Graph, e: Expr) -> Option<Expr> {
    let applied = |e: Expr| match g.node(e) {
        Node::Apply {
            function,
            arguments,
        } => Some((*function, *arguments.first()?)),
        _ => None,
    };
    let (outer, angle) = applied(e)?;
    let (inner, x) = applied(angle)?;
    match (outer, inner) {
        (Function::Sin, Function::Acos) | (Function::Cos, Function::Asin) => {
            Some(g.sqrt(g.sub(g.one(), g.powi(x, 2))))
        }
        _ => None,
    }
}
