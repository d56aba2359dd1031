//! For which values of parameters expressions are real numbers: what stands under roots, in logarithms and in inverse functions of angles.

use chetaev_mechanics::system::Relation;
use chetaev_symbolic::factors::factored;
use chetaev_symbolic::node::{Function, Node};
use chetaev_symbolic::{Expr, Graph};
use std::cmp::Ordering;

/// A function with how it is to compare with zero.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Condition {
    pub(crate) function: Expr,
    pub(crate) relation: Relation,
}

impl Condition {
    /// Whether it holds where the function has this sign.
    pub(crate) fn holds(&self, sign: Ordering) -> bool {
        match self.relation {
            Relation::Less => sign == Ordering::Less,
            Relation::LessOrEqual => sign != Ordering::Greater,
            Relation::NotEqual => sign != Ordering::Equal,
        }
    }

    /// `1 - W^2 <= 0`.
    pub(crate) fn text(&self, g: &Graph) -> String {
        let sign = match self.relation {
            Relation::Less => "<",
            Relation::LessOrEqual => "<=",
            Relation::NotEqual => "!=",
        };
        format!("{} {sign} 0", g.text(self.function))
    }

    /// The same of functions without denominators: a function changes its sign at its poles too, and has none there.
    pub(crate) fn without_poles(&self, g: &Graph) -> Vec<Condition> {
        let Some(parts) = factored(g, self.function) else {
            return vec![self.clone()];
        };
        let power = |(e, n): &(Expr, i64)| g.powi(*e, n.abs());
        let mut all = vec![g.number(parts.coefficient.clone())];
        all.extend(parts.factors.iter().map(power));
        let below = parts.factors.iter().filter(|(_, n)| *n < 0);
        let below = below.map(|(e, _)| Condition {
            function: *e,
            relation: Relation::NotEqual,
        });
        let own = Condition {
            function: g.mul(&all),
            relation: self.relation,
        };
        below.chain([own]).collect()
    }
}

/// What must hold for expressions to be real.
pub(crate) fn conditions(g: &Graph, es: &[Expr]) -> Vec<Condition> {
    let parts = g.reachable(es);
    parts.into_iter().filter_map(|e| condition(g, e)).collect()
}

/// What must hold for an expression to be real where its arguments are.
fn condition(g: &Graph, e: Expr) -> Option<Condition> {
    let [less, at_most] = [Relation::Less, Relation::LessOrEqual];
    let (function, relation) = match g.node(e) {
        Node::Power { base, exponent } => {
            let number = g.as_number(*exponent);
            if let Some(n) = number.filter(|n| n.denominator().is_one()) {
                // At a pole there is no number.
                let is_negative = *n < chetaev_symbolic::Rational::ZERO;
                return is_negative.then_some(Condition {
                    function: *base,
                    relation: Relation::NotEqual,
                });
            }
            let is_positive = number.is_some_and(|n| *n > chetaev_symbolic::Rational::ZERO);
            (g.neg(*base), if is_positive { at_most } else { less })
        }
        Node::Apply {
            function,
            arguments,
        } => {
            let own = *arguments.first()?;
            let beyond_one = || g.sub(g.powi(own, 2), g.one());
            match function {
                Function::Asin | Function::Acos => (beyond_one(), at_most),
                Function::Atanh => (beyond_one(), less),
                Function::Acosh => (g.sub(g.one(), own), at_most),
                Function::Log => (g.neg(own), less),
                _ => return None,
            }
        }
        _ => return None,
    };
    Some(Condition { function, relation })
}

/// Where expressions have a corner or a jump: zeros of what stands under absolute values, signs, and roots that are no square's.
pub(crate) fn corners(g: &Graph, es: &[Expr]) -> Vec<(Expr, Expr)> {
    let corner = |e: Expr| match g.node(e) {
        Node::Power { base, exponent } => {
            let number = g.as_number(*exponent)?;
            (!number.denominator().is_one()).then_some((e, *base))
        }
        Node::Apply {
            function: Function::Abs | Function::Sign,
            arguments,
        } => Some((e, *arguments.first()?)),
        Node::Apply {
            function: Function::Asin | Function::Acos,
            arguments,
        } => {
            let own = *arguments.first()?;
            Some((e, g.sub(g.powi(own, 2), g.one())))
        }
        _ => None,
    };
    g.reachable(es).into_iter().filter_map(corner).collect()
}
