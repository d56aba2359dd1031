//! Exact integrals of polynomials over a box and its faces.

use crate::functional::{Interval, Side};
use crate::space::Space;
use chetaev_symbolic::factors::factored;
use chetaev_symbolic::{rational, Expr, Function, Node};

/// Highest degree by one variable.
const HIGHEST_DEGREE: usize = 40;

/// The coefficients of the powers of an independent variable; `None` where the expression is no polynomial in it.
pub fn coefficients(space: &Space, e: Expr, axis: usize) -> Option<Vec<Expr>> {
    let g = &space.graph;
    let variable = space.coordinates.get(axis)?.expr;
    let symbol = g.as_symbol(variable)?;
    if !is_analytic(space, e, variable) {
        return None;
    }
    let one = g.one();
    let mut found = Vec::new();
    let mut slope = without_removable_poles(space, e, variable)?;
    let mut factorial = rational::integer(1);
    for k in 0..=HIGHEST_DEGREE {
        if g.is_zero(slope) || (k > 2 && space.vanish(&[slope])) {
            return Some(found);
        }
        if k > 0 {
            factorial = rational::product(&factorial, &rational::integer(k as i64));
        }
        let at_zero = g.substitute(slope, &[(variable, g.zero())]);
        found.push(g.div(at_zero, g.number(factorial.clone())));
        slope = g
            .derive(&[slope], &|own| (own == symbol).then_some(one))
            .swap_remove(0);
    }
    None
}

/// The expression over its common denominator, `r (1/r + r)` as `1 + r²`; `None` where the variable is left in the denominator.
fn without_removable_poles(space: &Space, e: Expr, variable: Expr) -> Option<Expr> {
    let g = &space.graph;
    let symbol = g.as_symbol(variable)?;
    let has_pole = g.reachable(&[e]).into_iter().any(|own| match g.node(own) {
        Node::Power { exponent, .. } => {
            let is_negative = g.as_number(*exponent).is_some_and(rational::is_negative);
            is_negative && g.contains_any(own, &[symbol])
        }
        _ => false,
    });
    if !has_pole {
        return Some(e);
    }
    let own = factored(g, e)?;
    let is_below = |(factor, power): &(Expr, i64)| *power < 0 && g.contains_any(*factor, &[symbol]);
    if own.factors.iter().any(is_below) {
        return None;
    }
    let factors = own.factors.iter();
    let mut factors: Vec<Expr> = factors.map(|&(factor, n)| g.powi(factor, n)).collect();
    factors.push(g.number(own.coefficient));
    Some(g.mul(&factors))
}

/// Whether an expression is given by the Taylor series that its derivatives are of: |x| and roots are so on each side of their zeros only.
fn is_analytic(space: &Space, e: Expr, variable: Expr) -> bool {
    let g = &space.graph;
    let Some(symbol) = g.as_symbol(variable) else {
        return false;
    };
    g.reachable(&[e]).into_iter().all(|own| {
        let is_piecewise = match g.node(own) {
            Node::Apply { function, .. } => matches!(function, Function::Abs | Function::Sign),
            Node::Power { exponent, .. } => g.as_number(*exponent).is_none_or(|n| !n.is_int()),
            _ => false,
        };
        !is_piecewise || !g.contains_any(own, &[symbol])
    })
}

/// The integral by one variable.
pub fn along(space: &Space, e: Expr, interval: &Interval) -> Option<Expr> {
    let g = &space.graph;
    let own = coefficients(space, e, interval.axis)?;
    let terms: Vec<Expr> = own
        .into_iter()
        .enumerate()
        .map(|(k, c)| {
            let n = k as i64 + 1;
            let difference = g.sub(g.powi(interval.upper, n), g.powi(interval.lower, n));
            g.div(g.mul(&[c, difference]), g.integer(n))
        })
        .collect();
    Some(g.add(&terms))
}

/// The integral over the box.
pub fn over_box(space: &Space, e: Expr, intervals: &[Interval]) -> Option<Expr> {
    intervals
        .iter()
        .try_fold(e, |e, interval| along(space, e, interval))
}

/// The integral over a face of the box.
pub fn over_face(space: &Space, e: Expr, side: &Side, intervals: &[Interval]) -> Option<Expr> {
    let Side::Flat { axis, at, .. } = side else {
        return None;
    };
    let on = space
        .graph
        .substitute(e, &[(space.coordinates.get(*axis)?.expr, *at)]);
    let others = intervals.iter().filter(|own| own.axis != *axis);
    others
        .cloned()
        .try_fold(on, |e, interval| along(space, e, &interval))
}
