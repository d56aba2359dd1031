//! What belongs to the expansion of functions that have corners: how fast they grow beside a motion.
//!
//! At a distance r from the motion `|x'| x'` is O(r²) and `sqrt(x'² + y'²) x'` too, so that both have the linear part 0 (Fréchet's derivative),
//! though one has a corner in its second derivative and the other in a factor. An expression is given an exponent d with `e = O(r^d)`: that of a
//! product is the sum of those of its factors, and that of a sum the least. Where d is greater than k the expression is no part of the
//! expansion to the order k, which is then that of what is left; where a corner is left there is no such expansion.

use crate::real_values::corners;
use chetaev_symbolic::node::{Function, Node};
use chetaev_symbolic::substitute::SolveCache;
use chetaev_symbolic::{Expr, Graph, Rational};
use std::collections::{BTreeMap, BTreeSet};

/// Functions beside a motion.
pub(crate) struct Growth<'a> {
    g: &'a Graph,
    /// Whether a function is known to vanish at the motion, or known not to; `None` where neither is known.
    vanishes: &'a dyn Fn(Expr) -> Option<bool>,
    /// What contains a corner at the motion.
    cornered: BTreeSet<Expr>,
    known: BTreeMap<Expr, Option<Rational>>,
    flat: BTreeMap<(Expr, Rational), Expr>,
}

/// Functions without corners at the motion where these are small enough.
pub(crate) struct Flat {
    pub(crate) functions: Vec<Expr>,
    /// Whether there was a corner.
    pub(crate) had_corner: bool,
    /// A corner that is left.
    pub(crate) corner: Option<Expr>,
}

/// `es` without what is smaller than any multiple of r to the power `order`.
pub(crate) fn flattened(
    g: &Graph,
    es: &[Expr],
    order: i64,
    vanishes: &dyn Fn(Expr) -> Option<bool>,
) -> Flat {
    let at_motion = |e: &(Expr, Expr)| vanishes(e.1) != Some(false);
    let own: BTreeSet<Expr> = corners(g, es)
        .into_iter()
        .filter(at_motion)
        .map(|(corner, _)| corner)
        .collect();
    let mut cornered = own.clone();
    if !own.is_empty() {
        // Children come before their parents.
        for e in g.reachable(es) {
            let mut is_above = false;
            g.node(e)
                .for_each_child(|c| is_above |= cornered.contains(&c));
            if is_above {
                cornered.insert(e);
            }
        }
    }
    let mut growth = Growth {
        g,
        vanishes,
        cornered,
        known: BTreeMap::new(),
        flat: BTreeMap::new(),
    };
    let order = Rational::from(order);
    let functions: Vec<Expr> = es.iter().map(|&e| growth.flatten(e, &order)).collect();
    let left = g.reachable(&functions);
    let corner = left.into_iter().find(|e| own.contains(e));
    Flat {
        functions,
        had_corner: !own.is_empty(),
        corner,
    }
}

impl Growth<'_> {
    /// The function without what grows faster than r to the power `order`; what has a corner or a pole stays as it is.
    fn flatten(&mut self, e: Expr, order: &Rational) -> Expr {
        if !self.cornered.contains(&e) {
            return e;
        }
        let key = (e, order.clone());
        if let Some(&found) = self.flat.get(&key) {
            return found;
        }
        let g = self.g;
        let is_higher = self.exponent(e).is_some_and(|d| d > *order);
        let found = match g.node(e) {
            _ if is_higher => g.zero(),
            Node::Product {
                coefficient,
                factors,
            } => self.flat_product(coefficient, factors, order).unwrap_or(e),
            _ if self.is_smooth_outside(e) => {
                let mut child = |c: Expr| self.flatten(c, order);
                g.rebuild(e, &mut child, &mut SolveCache::default())
            }
            _ => e,
        };
        self.flat.insert(key, found);
        found
    }

    /// A factor is needed to an order that is lower by the exponents of the others: of `x' exp(−|x'|)` to the first order, `exp(0)`.
    fn flat_product(
        &mut self,
        coefficient: &Rational,
        factors: &[Expr],
        order: &Rational,
    ) -> Option<Expr> {
        let exponents: Option<Vec<Rational>> = factors.iter().map(|&e| self.exponent(e)).collect();
        let exponents = exponents?;
        let sum = exponents.iter().fold(Rational::ZERO, |sum, d| sum + d);
        let mut parts = vec![self.g.number(coefficient.clone())];
        for (&factor, own) in factors.iter().zip(exponents) {
            parts.push(self.flatten(factor, &(order - (&sum - own))));
        }
        Some(self.g.mul(&parts))
    }

    /// Whether the function itself has derivatives where its arguments are.
    fn is_smooth_outside(&self, e: Expr) -> bool {
        let g = self.g;
        let is_apart = |e: Expr| (self.vanishes)(e) == Some(false);
        match g.node(e) {
            Node::Sum { .. } => true,
            Node::Power { base, exponent } => match g.as_number(*exponent) {
                Some(n) if n.denominator().is_one() && *n > Rational::ZERO => true,
                Some(_) => is_apart(*base),
                None => false,
            },
            Node::Apply { function, .. } => {
                use Function::{Atan, Cos, Cosh, Exp, Sin, Sinh, Tanh};
                matches!(function, Sin | Cos | Sinh | Cosh | Tanh | Exp | Atan)
            }
            _ => false,
        }
    }

    /// d with `e = O(r^d)`; `None` where none is known that is not negative.
    fn exponent(&mut self, e: Expr) -> Option<Rational> {
        if let Some(found) = self.known.get(&e) {
            return found.clone();
        }
        let found = if self.cornered.contains(&e) {
            self.exponent_at_corner(e)
        } else {
            self.exponent_of_smooth(e)
        };
        self.known.insert(e, found.clone());
        found
    }

    /// 1 for each factor that vanishes at the motion. A function without a corner has no pole there, but for negative powers of what vanishes.
    fn exponent_of_smooth(&mut self, e: Expr) -> Option<Rational> {
        match self.g.node(e) {
            Node::Product { factors, .. } => self.sum_of(factors),
            Node::Sum { constant, terms } if *constant == Rational::ZERO => {
                let terms: Vec<Expr> = terms.iter().map(|(e, _)| *e).collect();
                let least = self.least_of(&terms)?;
                Some(least.max(self.simple(e)?))
            }
            Node::Power { base, exponent } => self.exponent_of_power(*base, *exponent),
            _ => self.simple(e),
        }
    }

    /// 1 for what vanishes; none where there is no value, as at a pole.
    fn simple(&self, e: Expr) -> Option<Rational> {
        let vanishes = (self.vanishes)(e)?;
        Some(if vanishes {
            Rational::ONE
        } else {
            Rational::ZERO
        })
    }

    fn exponent_at_corner(&mut self, e: Expr) -> Option<Rational> {
        use Function::{Abs, Asinh, Atan, Cos, Cosh, Exp, Sin, Sinh, Tanh};
        match self.g.node(e) {
            Node::Product { factors, .. } => self.sum_of(factors),
            Node::Sum { constant, terms } if *constant == Rational::ZERO => {
                let terms: Vec<Expr> = terms.iter().map(|(e, _)| *e).collect();
                self.least_of(&terms)
            }
            Node::Sum { terms, .. } => {
                let terms: Vec<Expr> = terms.iter().map(|(e, _)| *e).collect();
                self.least_of(&terms).map(|_| Rational::ZERO)
            }
            Node::Power { base, exponent } => self.exponent_of_power(*base, *exponent),
            Node::Apply {
                function: Abs | Sin | Sinh | Tanh | Atan | Asinh,
                arguments,
            } => self.exponent(*arguments.first()?),
            Node::Apply {
                function: Cos | Cosh | Exp,
                arguments,
            } => self.exponent(*arguments.first()?).map(|_| Rational::ZERO),
            // A sign jumps, and is continuous only beside a factor that vanishes with it.
            _ => None,
        }
    }

    fn exponent_of_power(&mut self, base: Expr, exponent: Expr) -> Option<Rational> {
        let n = self.g.as_number(exponent)?.clone();
        if n > Rational::ZERO {
            return self.exponent(base).map(|d| d * n);
        }
        // A pole where the base vanishes.
        let is_apart = !self.cornered.contains(&base) && (self.vanishes)(base) == Some(false);
        is_apart.then_some(Rational::ZERO)
    }

    fn least_of(&mut self, terms: &[Expr]) -> Option<Rational> {
        let all: Option<Vec<Rational>> = terms.iter().map(|&e| self.exponent(e)).collect();
        all?.into_iter().min()
    }

    /// The sum of the exponents of factors; `sign(f)` counts nothing beside a power of f or of |f|.
    fn sum_of(&mut self, factors: &[Expr]) -> Option<Rational> {
        let mut sum = Rational::ZERO;
        for &factor in factors {
            let is_continuous = self
                .under_sign(factor)
                .is_some_and(|inside| factors.iter().any(|&own| self.vanishes_with(own, inside)));
            if !is_continuous {
                sum += self.exponent(factor)?;
            }
        }
        Some(sum)
    }

    /// f of `sign(f)`.
    fn under_sign(&self, e: Expr) -> Option<Expr> {
        match self.g.node(e) {
            Node::Apply {
                function: Function::Sign,
                arguments,
            } => arguments.first().copied(),
            _ => None,
        }
    }

    /// Whether an expression is a positive power of f or of |f|.
    fn vanishes_with(&self, e: Expr, f: Expr) -> bool {
        let g = self.g;
        match g.node(e) {
            _ if e == f || e == g.abs(f) => true,
            Node::Power { base, exponent } => {
                let is_positive = g.as_number(*exponent).is_some_and(|n| *n > Rational::ZERO);
                is_positive && (*base == f || *base == g.abs(f))
            }
            _ => false,
        }
    }
}
