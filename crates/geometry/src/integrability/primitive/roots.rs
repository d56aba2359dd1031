//! Antiderivatives of polynomials times odd powers of the root of a quadratic polynomial.

use super::rational::polynomial;
use super::tidy;
use chetaev_symbolic::{Expr, Function, Graph, Node, Symbol};

/// The highest degree of the polynomial.
const DEGREE: usize = 10;

/// Of a product of `q^(n/2)` with odd n and a polynomial. `∫ P/√q = Q √q + λ ∫ 1/√q`, with the coefficients of Q from the highest one on.
pub(super) fn with_root(g: &Graph, own: &[Expr], x: Symbol) -> Option<Expr> {
    let half = |&e: &Expr| {
        let (q, exponent) = g.base_exponent(e);
        let n = g.as_integer(g.mul(&[exponent, g.integer(2)]))?;
        (n % 2 != 0 && g.contains_any(q, &[x])).then_some((e, q, n))
    };
    let (root, q, n) = own.iter().find_map(half)?;
    let list = polynomial(g, q, x)?;
    let &[c, b, a] = list.as_slice() else {
        return None;
    };
    let others: Vec<Expr> = own.iter().copied().filter(|&e| e != root).collect();
    if n == -3 && others.is_empty() {
        let line = g.add(&[g.mul(&[g.integer(2), a, g.symbol_expr(x)]), b]);
        let four = g.mul(&[g.integer(4), a, c]);
        let by = g.mul(&[g.sub(four, g.powi(b, 2)), g.sqrt(q)]);
        return Some(g.div(g.mul(&[g.integer(2), line]), by));
    }
    if n < -1 {
        return None;
    }
    let whole = g.mul(&[&others[..], &[g.powi(q, (n + 1) / 2)]].concat());
    let mut p = polynomial(g, whole, x)?;
    if p.len() > DEGREE + 1 {
        return None;
    }
    let mut found = Vec::new();
    while p.len() > 1 {
        let k = p.len() as i64 - 1;
        let top = p.pop()?;
        let by = tidy(g, g.div(top, g.mul(&[a, g.integer(k)])));
        found.push(g.mul(&[by, g.powi(g.symbol_expr(x), k - 1)]));
        // (x^(k-1) √q)' √q = (k - 1) x^(k-2) q + x^(k-1) q'/2.
        let less = |e: Expr, c: Expr, n: i64, d: i64| {
            let own = g.div(g.mul(&[by, c, g.integer(n)]), g.integer(d));
            tidy(g, g.sub(e, own))
        };
        let place = p.len() - 1;
        p[place] = less(p[place], b, 2 * k - 1, 2);
        if place > 0 {
            p[place - 1] = less(p[place - 1], c, k - 1, 1);
        }
    }
    let rest = g.mul(&[*p.first()?, inverse_root(g, q, (a, b, c), x)]);
    Some(g.add(&[g.mul(&[g.add(&found), g.sqrt(q)]), rest]))
}

/// Of `1/√(a x² + b x + c)`: an arcsine where a is written as something negative, else a logarithm.
fn inverse_root(g: &Graph, q: Expr, (a, b, c): (Expr, Expr, Expr), x: Symbol) -> Expr {
    let line = g.add(&[g.mul(&[g.integer(2), a, g.symbol_expr(x)]), b]);
    if is_written_negative(g, a) {
        let four = g.mul(&[g.integer(4), a, c]);
        let width = g.sqrt(tidy(g, g.sub(g.powi(b, 2), four)));
        let angle = g.apply(Function::Asin, &[g.div(g.neg(line), width)]);
        return g.div(angle, g.sqrt(g.neg(a)));
    }
    let root = g.sqrt(a);
    let twice = g.mul(&[g.integer(2), root, g.sqrt(q)]);
    g.div(g.apply(Function::Log, &[g.add(&[twice, line])]), root)
}

fn is_written_negative(g: &Graph, e: Expr) -> bool {
    let number = match g.node(e) {
        Node::Product { coefficient, .. } => Some(coefficient),
        _ => g.as_number(e),
    };
    number.is_some_and(chetaev_symbolic::rational::is_negative)
}
