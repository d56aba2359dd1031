//! What does not move in expressions on a manifold: parameters, and functions of these.

use crate::motion::Motion;
use chetaev_mechanics::Manifold;
use chetaev_symbolic::factors::factored;
use chetaev_symbolic::{Expr, Node};

/// The parameters that occur in functions on a manifold or in what ties these, and the functions of parameters alone that are no
/// rational functions of them.
pub fn constants(motion: &Motion<'_>, manifold: &Manifold, outputs: &[Expr]) -> Vec<Expr> {
    let g = &motion.system.graph;
    let is_constant = |e: Expr| g.is_free_of(e, &|s| motion.moves(s));
    let mut roots = outputs.to_vec();
    roots.extend(manifold.solved.iter().map(|(_, e)| *e));
    roots.extend(manifold.implicit.iter().map(|(f, _)| *f));
    let mut found: Vec<Expr> = Vec::new();
    for e in g.reachable(&roots) {
        let is_letter = match g.node(e) {
            Node::Symbol(symbol) => !motion.moves(*symbol),
            Node::Pi | Node::Algebraic(_) => true,
            Node::Apply { .. } => is_constant(e),
            Node::Power { exponent, .. } => g.as_integer(*exponent).is_none() && is_constant(e),
            _ => false,
        };
        if is_letter && !found.contains(&e) {
            found.push(e);
        }
        for root in roots_of_constants(motion, manifold, e) {
            if !found.contains(&root) {
                found.push(root);
            }
        }
    }
    found.sort_by(|&a, &b| g.compare(a, b));
    found
}

/// The constants that a root of what moves contains on the manifold: `√(x'² + y'² + z'²)` contains `√(1 + a²)` where
/// `z' = a √(x'² + y'²)`.
fn roots_of_constants(motion: &Motion<'_>, manifold: &Manifold, e: Expr) -> Vec<Expr> {
    let g = &motion.system.graph;
    let is_constant = |e: Expr| g.is_free_of(e, &|s| motion.moves(s));
    let Node::Power { base, exponent } = g.node(e) else {
        return Vec::new();
    };
    if g.as_integer(*exponent).is_some() || !is_constant(*exponent) || is_constant(*base) {
        return Vec::new();
    }
    let solved: Vec<(Expr, Expr)> = manifold
        .solved
        .iter()
        .map(|&(s, value)| (g.symbol_expr(s), value))
        .collect();
    let Some(factored) = factored(g, g.substitute(*base, &solved)) else {
        return Vec::new();
    };
    let constant = factored.factors.iter().filter(|(f, _)| is_constant(*f));
    constant
        .filter(|(f, n)| n % 2 != 0 && g.as_integer(*f).is_none())
        .map(|&(f, _)| g.pow(f, *exponent))
        .collect()
}
