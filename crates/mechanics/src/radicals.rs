//! Roots written by the factors of their radicands, so that the same root has one form.
//!
//! `√(m²c² + p²)` with `p = m v/√(1 − v²/c²)` is `m c²/√(c² − v²)` for m > 0. A root is taken of each factor that is not
//! negative by its form or by the model's assumptions; what else is in the radicand stays together, as no sign is known of
//! its parts.

use crate::system::{Relation, System};
use chetaev_symbolic::factors::{factored, Factored};
use chetaev_symbolic::rational::{abs, integer, is_negative, Rational};
use chetaev_symbolic::{Expr, Graph, Node};

/// Roots within roots are followed so deep.
const DEPTH: usize = 4;

/// Expressions with the same values where all roots are real.
pub(crate) fn split_roots(system: &System, es: &[Expr]) -> Vec<Expr> {
    let g = &system.graph;
    let positive = positive_symbols(system);
    let mut current = es.to_vec();
    for _ in 0..DEPTH {
        let pairs: Vec<(Expr, Expr)> = g
            .reachable(&current)
            .into_iter()
            .filter_map(|e| Some((e, split(g, e, &positive)?)))
            .filter(|(e, split)| e != split)
            .collect();
        if pairs.is_empty() {
            break;
        }
        current = g.substitute_all(&current, &pairs);
    }
    current
}

/// The symbols that the model assumes to be positive.
fn positive_symbols(system: &System) -> Vec<Expr> {
    let g = &system.graph;
    let assumptions = system.assumptions.iter();
    assumptions
        .filter(|a| a.relation == Relation::Less && g.is_zero(a.left))
        .filter(|a| g.as_symbol(a.right).is_some())
        .map(|a| a.right)
        .collect()
}

/// A root by the factors of its radicand; `None` for what is no root, or cannot be factored.
fn split(g: &Graph, e: Expr, positive: &[Expr]) -> Option<Expr> {
    let Node::Power { base, exponent } = g.node(e) else {
        return None;
    };
    let power = g.as_number(*exponent).filter(|r| !r.is_int())?;
    let Factored {
        coefficient,
        factors,
    } = factored(g, *base)?;
    let raised = |f: Expr, n: i64| g.pow(f, g.number(integer(n) * power));
    let (known, rest): (Vec<_>, Vec<_>) = factors
        .iter()
        .partition(|(f, _)| is_nonnegative(g, *f, positive));
    let mut parts: Vec<Expr> = known.iter().map(|&&(f, n)| raised(f, n)).collect();
    parts.push(g.pow(g.number(abs(&coefficient)), *exponent));
    let sign = if is_negative(&coefficient) { -1 } else { 1 };
    parts.push(match rest[..] {
        [] => g.pow(g.integer(sign), *exponent),
        // An odd power that is not negative is one of something that is not negative.
        [&(f, n)] if n % 2 != 0 => raised(g.scale(&Rational::from(sign), f), n),
        _ => {
            let rest: Vec<Expr> = rest.iter().map(|&&(f, n)| g.powi(f, n)).collect();
            let product = g.scale(&Rational::from(sign), g.mul(&rest));
            g.pow(product, *exponent)
        }
    });
    Some(g.mul(&parts))
}

/// Whether a polynomial is not negative by its form: positive coefficients, and squares or positive symbols in every term.
fn is_nonnegative(g: &Graph, e: Expr, positive: &[Expr]) -> bool {
    let all = |es: &[Expr]| es.iter().all(|&e| is_nonnegative(g, e, positive));
    match g.node(e) {
        Node::Number(value) => !is_negative(value),
        Node::Power { base, exponent } => {
            let is_even = g.as_integer(*exponent).is_some_and(|n| n % 2 == 0);
            let is_root = g.as_number(*exponent).is_some_and(|r| !r.is_int());
            is_even || is_root || is_nonnegative(g, *base, positive)
        }
        Node::Product {
            coefficient,
            factors,
        } => !is_negative(coefficient) && all(factors),
        Node::Sum { constant, terms } => {
            let mut terms = terms.iter();
            !is_negative(constant)
                && terms.all(|(e, coefficient)| {
                    !is_negative(coefficient) && is_nonnegative(g, *e, positive)
                })
        }
        _ => positive.contains(&e),
    }
}
