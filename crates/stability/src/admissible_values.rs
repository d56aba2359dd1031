//! Which values of a parameter the model admits: what it assumes, along the motion and with the values of the other parameters.

use crate::isolation::Root;
use crate::question::{bound_of, values_but};
use crate::real_roots::{real_roots, sign_at, sign_over};
use crate::steady::closed;
use chetaev_mechanics::system::Relation;
use chetaev_mechanics::{SteadyMotion, System};
use chetaev_symbolic::{Expr, Graph, Symbol};
use dashu_ratio::RBig;
use std::cmp::Ordering;

/// What is assumed of one parameter.
#[derive(Clone, Debug)]
pub(crate) struct AdmissibleValues {
    symbol: Symbol,
    /// Functions of the parameter with how they are to compare with zero.
    conditions: Vec<(Expr, Relation)>,
}

impl AdmissibleValues {
    /// The assumptions in which nothing but this parameter is left.
    pub(crate) fn new(system: &System, motion: &SteadyMotion, symbol: Symbol) -> AdmissibleValues {
        let g = &system.graph;
        let values = values_but(system, Some(symbol));
        let coordinates = system.coordinates.iter();
        let positions = coordinates.clone().map(|own| own.q).zip(&motion.positions);
        let velocities = coordinates.map(|own| own.v).zip(&motion.velocities);
        let stated = positions.chain(velocities);
        let place: Vec<(Expr, Expr)> = stated
            .filter_map(|(own, value)| value.map(|value| (own, value)))
            .collect();
        let at = |e: Expr| closed(g, g.substitute(g.substitute(e, &place), &values));
        let all = system.assumptions.iter();
        let own = all.map(|own| (at(g.sub(own.left, own.right)), own.relation));
        let conditions = own
            .filter(|(e, _)| g.symbols_in(&[*e]).into_iter().eq([symbol]))
            .collect();
        AdmissibleValues { symbol, conditions }
    }

    /// The functions at whose zeros something that is assumed begins or ceases to hold.
    pub(crate) fn functions(&self) -> Vec<Expr> {
        self.conditions.iter().map(|(e, _)| *e).collect()
    }

    /// Where something that is assumed begins or ceases to hold; `None` where that was not decided.
    pub(crate) fn ends(&self, g: &Graph) -> Option<Vec<Root>> {
        let of = |e: Expr| {
            let bound = bound_of(g, &[e], self.symbol)?;
            real_roots(g, e, self.symbol, &-bound.clone(), &bound)
        };
        let all: Option<Vec<Vec<Root>>> = self.functions().into_iter().map(of).collect();
        Some(all?.concat())
    }

    /// Whether a value satisfies everything; `None` where that was not decided.
    pub(crate) fn contains(&self, g: &Graph, at: &RBig) -> Option<bool> {
        self.all(|e| sign_at(g, e, self.symbol, at))
    }

    /// Whether the value that an interval encloses satisfies everything; `None` where that was not decided. It is a zero of one of the
    /// [`functions`](AdmissibleValues::functions) or of these others.
    pub(crate) fn contains_root(&self, g: &Graph, root: &Root, others: &[Expr]) -> Option<bool> {
        if root.low == root.high {
            return self.contains(g, &root.low);
        }
        let sign = |e: Expr| sign_over(g, e, self.symbol, root);
        let mut open = self.conditions.iter().filter(|(e, _)| sign(*e).is_none());
        let is_of_one = open.next().is_some() && open.next().is_none();
        let is_of_no_other = || others.iter().all(|&e| sign(e).is_some());
        let is_own = is_of_one && is_of_no_other();
        self.all(|e| sign(e).or_else(|| is_own.then_some(Ordering::Equal)))
    }

    fn all(&self, sign: impl Fn(Expr) -> Option<Ordering>) -> Option<bool> {
        let holds = |(e, relation): &(Expr, Relation)| {
            let sign = sign(*e)?;
            Some(match relation {
                Relation::Less => sign == Ordering::Less,
                Relation::LessOrEqual => sign != Ordering::Greater,
                Relation::NotEqual => sign != Ordering::Equal,
            })
        };
        let found: Vec<Option<bool>> = self.conditions.iter().map(holds).collect();
        if found.contains(&Some(false)) {
            return Some(false);
        }
        let all: Option<Vec<bool>> = found.into_iter().collect();
        all.map(|_| true)
    }
}
