//! Tangents, cotangents, secants and cosecants by sines and cosines.

use crate::{Expr, Function, Graph, Node};

/// A tangent, cotangent, secant or cosecant as the quotient that it is of.
pub fn as_quotient(g: &Graph, e: Expr) -> Option<Expr> {
    let Node::Apply {
        function,
        arguments,
    } = g.node(e)
    else {
        return None;
    };
    let angle = *arguments.first()?;
    match function {
        Function::Tan => Some(g.div(g.sin(angle), g.cos(angle))),
        Function::Cot => Some(g.div(g.cos(angle), g.sin(angle))),
        Function::Sec => Some(g.div(g.one(), g.cos(angle))),
        Function::Csc => Some(g.div(g.one(), g.sin(angle))),
        _ => None,
    }
}

/// An expression with all of these as quotients, so that their poles are seen.
pub fn by_quotients(g: &Graph, e: Expr) -> Expr {
    let pair = |e: Expr| Some((e, as_quotient(g, e)?));
    let pairs: Vec<(Expr, Expr)> = g.reachable(&[e]).into_iter().filter_map(pair).collect();
    g.substitute(e, &pairs)
}
