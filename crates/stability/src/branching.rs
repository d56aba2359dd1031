//! Reduction to one equation along a curve (Lyapunov 1906, Schmidt 1908).
//!
//! `Ψ(y) = 0` with `Ψ(0) = 0` and a Jacobian with one null vector n. Along the curve `y = n x + y₂ x² + …` all equations are solved but one, which
//! is projected by a left null vector w: its first coefficient that is not zero, `w Ψ(y(x)) = c xᵐ + …`, decides how solutions branch, how a motion on
//! the centre manifold begins, and whether a function has a minimum. That of order j needs the curve to order j − 1 only.

use crate::neighbourhood::coefficients_at;
use crate::steady::{closed, solution};
use chetaev_symbolic::{Expr, Graph};

/// Terms of higher order are not looked at.
pub(crate) const HIGHEST: usize = 7;

/// Equations about a solution.
pub(crate) struct Branching<'a> {
    pub(crate) graph: &'a Graph,
    /// Ψ at deviations of the unknowns.
    pub(crate) equations: &'a dyn Fn(&[Expr]) -> Vec<Expr>,
    /// Its Jacobian at zero.
    pub(crate) jacobian: &'a [Vec<Expr>],
    /// n.
    pub(crate) direction: &'a [Expr],
    /// w.
    pub(crate) weights: &'a [Expr],
}

/// The first term that is not zero.
#[derive(Clone, Debug)]
pub(crate) struct Leading {
    /// m.
    pub(crate) order: usize,
    /// c.
    pub(crate) coefficient: Expr,
    /// What was divided by.
    pub(crate) nonzero: Vec<Expr>,
}

impl Branching<'_> {
    /// The first term; `None` where all are zero up to the highest order, or the equations were not solved.
    pub(crate) fn leading(&self) -> Option<Leading> {
        let g = self.graph;
        // No name of a model contains a space.
        let symbol = g.intern_symbol("along branch", 0);
        let step = g.symbol_expr(symbol);
        let times = |&e: &Expr| g.mul(&[e, step]);
        let mut curve: Vec<Expr> = self.direction.iter().map(times).collect();
        let mut nonzero = Vec::new();
        for order in 2..=HIGHEST {
            let residual = coefficients_at(g, &(self.equations)(&curve), symbol, order);
            let terms = self.weights.iter().zip(&residual);
            let terms: Vec<Expr> = terms.map(|(&w, &r)| g.mul(&[w, r])).collect();
            let coefficient = closed(g, g.add(&terms));
            if !g.is_zero(coefficient) {
                return Some(Leading {
                    order,
                    coefficient,
                    nonzero,
                });
            }
            let right: Vec<Expr> = residual.iter().map(|&r| g.neg(r)).collect();
            let found = solution(g, (self.jacobian, curve.len()), &right)?;
            nonzero.extend(found.divisors);
            let power = g.powi(step, order as i64);
            let longer = |(&known, &y): (&Expr, &Expr)| g.add(&[known, g.mul(&[y, power])]);
            curve = curve.iter().zip(&found.values).map(longer).collect();
        }
        None
    }
}
