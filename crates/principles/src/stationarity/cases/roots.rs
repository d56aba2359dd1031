//! Equations with a square root of what moves, `y' √(x'² + y'²) + g = 0`: they give the root by what else occurs, and the square of
//! that is an equation without it.

use super::{Case, Found, Search};
use crate::stationarity::closed_form::short;
use chetaev_mechanics::equations::unused_name;
use chetaev_mechanics::prover::assumptions;
use chetaev_symbolic::factors::coefficients;
use chetaev_symbolic::zero::known_sign;
use chetaev_symbolic::{rational, Expr, Graph, Node};

/// A root that is given by an equation.
#[derive(Clone, Debug)]
pub(super) struct Root {
    radicand: Expr,
    /// The root without it.
    value: Expr,
    /// The equation, as it was found.
    pub(super) equation: Expr,
    /// What vanishes since the square of the value is the radicand.
    pub(super) squared: Expr,
}

impl Root {
    /// With the odd powers of the root by its value.
    pub(super) fn replaced(&self, g: &Graph, e: Expr) -> Expr {
        with_root(g, e, self.radicand, self.value)
    }

    /// With a symbol by its value.
    pub(super) fn substitute(&mut self, g: &Graph, pair: &[(Expr, Expr)]) {
        for e in [&mut self.radicand, &mut self.value] {
            *e = short(g, g.substitute(*e, pair));
        }
    }
}

/// Twice the exponent, where it is half an odd number.
fn odd_halves(g: &Graph, exponent: Expr) -> Option<i64> {
    let twice = rational::to_i64(&(g.as_number(exponent)? * rational::integer(2)))?;
    (twice % 2 != 0).then_some(twice)
}

fn with_root(g: &Graph, e: Expr, radicand: Expr, value: Expr) -> Expr {
    let powers = g
        .reachable(&[e])
        .into_iter()
        .filter_map(|e| match g.node(e) {
            Node::Power { base, exponent } if *base == radicand => {
                Some((e, g.powi(value, odd_halves(g, *exponent)?)))
            }
            _ => None,
        });
    let powers: Vec<(Expr, Expr)> = powers.collect();
    g.substitute(e, &powers)
}

impl Search<'_, '_> {
    /// The cases that an equation affine in a root gives; `None` for others.
    pub(super) fn where_root(
        &self,
        found: &mut Found,
        case: &Case,
        factor: Expr,
    ) -> Option<Vec<Case>> {
        let g = self.g;
        let mut reached = g.reachable(&[factor]).into_iter();
        let radicand = reached.find_map(|e| match g.node(e) {
            Node::Power { base, exponent } if g.contains_any(*base, &self.state) => {
                odd_halves(g, *exponent).map(|_| *base)
            }
            _ => None,
        })?;
        let name = unused_name(self.cx.system, "root");
        let written = with_root(g, factor, radicand, g.symbol(&name, 0));
        let list = coefficients(g, written, g.intern_symbol(&name, 0))?;
        let &[c, b] = list.as_slice() else {
            return None;
        };
        let vanishing = self.vanishing_factors(case, b)?;
        let mut cases = Vec::new();
        if !vanishing.is_empty() {
            cases.extend(self.require_all(found, case.clone(), &[b, c]));
        }
        let value = short(g, g.neg(g.div(c, b)));
        if known_sign(g, value, &assumptions(self.cx.system)).is_nonpositive() {
            return Some(cases);
        }
        let squared = g.sub(g.powi(c, 2), g.mul(&[g.powi(b, 2), radicand]));
        let mut off = case.clone();
        off.nonzero.extend(vanishing);
        off.roots.push(Root {
            radicand,
            value,
            equation: factor,
            squared,
        });
        cases.extend(self.require(found, &off, squared));
        Some(cases)
    }
}
