//! Squares of sines and cosines by each other.

use crate::{Expr, Function, Graph, Node};

/// The squares of cosines by sines, or of sines by cosines.
pub fn by_square(g: &Graph, e: Expr, is_cosine: bool) -> Expr {
    let square = |e: Expr| -> Option<(Expr, Expr)> {
        let Node::Apply {
            function,
            arguments,
        } = g.node(e)
        else {
            return None;
        };
        let angle = *arguments.first()?;
        let other = match (function, is_cosine) {
            (Function::Cos, true) => g.sin(angle),
            (Function::Sin, false) => g.cos(angle),
            _ => return None,
        };
        Some((g.powi(e, 2), g.sub(g.one(), g.powi(other, 2))))
    };
    let squares: Vec<(Expr, Expr)> = g.reachable(&[e]).into_iter().filter_map(square).collect();
    match squares.is_empty() {
        true => e,
        false => g.substitute(e, &squares),
    }
}
