//! Which values of a parameter the model admits: what it assumes, along the motion and with the values of the other parameters, and those for
//! which the motion and what the model states of forces and constraints are real.

use crate::isolation::Root;
use crate::parameter_values::values_but;
use crate::real_roots::{bound_of, real_roots, sign_at, sign_over};
use crate::real_values::{conditions, Condition};
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
    conditions: Vec<Condition>,
}

/// Values of a parameter for which the model makes sense, and what it assumes in addition or leaves out.
pub(crate) struct Reality {
    /// Where all values are real.
    pub(crate) real: AdmissibleValues,
    /// What is assumed.
    pub(crate) assumed: AdmissibleValues,
}

impl Reality {
    /// In words where the model is real, where it is not for all values that are assumed; `None` where it is, or that was not decided.
    pub(crate) fn restriction(&self, g: &Graph) -> Option<String> {
        let functions = [self.real.functions(), self.assumed.functions()].concat();
        if self.real.conditions.is_empty() {
            return None;
        }
        let symbol = self.real.symbol;
        let is_everywhere = || -> Option<bool> {
            let bound = bound_of(g, &functions, symbol)?;
            let low = -bound.clone();
            let mut roots = Vec::new();
            for &e in &functions {
                roots.extend(real_roots(g, e, symbol, &low, &bound)?);
            }
            roots.sort_by(|a, b| a.low.cmp(&b.low));
            let lows = std::iter::once(&low).chain(roots.iter().map(|r| &r.high));
            let highs = roots.iter().map(|r| &r.low).chain([&bound]);
            for (a, b) in lows.zip(highs).filter(|(a, b)| a < b) {
                let sample = (a + b) / RBig::from(2);
                let is_assumed = self.assumed.contains(g, &sample)?;
                if is_assumed && !self.real.contains(g, &sample)? {
                    return Some(false);
                }
            }
            Some(true)
        };
        if is_everywhere() == Some(true) {
            return None;
        }
        let text = |own: &Condition| {
            let sign = match own.relation {
                Relation::Less => "<",
                Relation::LessOrEqual => "<=",
                Relation::NotEqual => "!=",
            };
            format!("{} {sign} 0", g.text(own.function))
        };
        let all: Vec<String> = self.real.conditions.iter().map(text).collect();
        Some(all.join(" and "))
    }
}

impl AdmissibleValues {
    /// The assumptions in which nothing but this parameter is left, and where all values are real.
    pub(crate) fn new(system: &System, motion: &SteadyMotion, symbol: Symbol) -> AdmissibleValues {
        let Reality { real, assumed } = AdmissibleValues::reality(system, motion, symbol);
        AdmissibleValues {
            symbol,
            conditions: [assumed.conditions, real.conditions].concat(),
        }
    }

    /// The same apart.
    pub(crate) fn reality(system: &System, motion: &SteadyMotion, symbol: Symbol) -> Reality {
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
        let of_parameter = |all: Vec<Condition>| -> AdmissibleValues {
            let is_own = |own: &Condition| g.symbols_in(&[own.function]).into_iter().eq([symbol]);
            let put = |own: Condition| Condition {
                function: at(own.function),
                ..own
            };
            let all = all.into_iter().map(put).filter(is_own);
            let parts = all.flat_map(|own| own.without_poles(g)).filter(is_own);
            AdmissibleValues {
                symbol,
                conditions: parts.collect(),
            }
        };
        let all = system.assumptions.iter();
        let assumed = all.map(|own| Condition {
            function: g.sub(own.left, own.right),
            relation: own.relation,
        });
        let mut stated: Vec<Expr> = place.iter().map(|(_, value)| *value).collect();
        stated.extend(values.iter().map(|(_, value)| *value));
        stated.push(system.lagrangian);
        stated.extend(&system.forces);
        stated.extend(system.constraints.iter().map(|own| own.stated));
        Reality {
            real: of_parameter(conditions(g, &stated)),
            assumed: of_parameter(assumed.collect()),
        }
    }

    /// The functions at whose zeros something that is assumed begins or ceases to hold.
    pub(crate) fn functions(&self) -> Vec<Expr> {
        self.conditions.iter().map(|own| own.function).collect()
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
        let mut open = self
            .conditions
            .iter()
            .filter(|own| sign(own.function).is_none());
        let is_of_one = open.next().is_some() && open.next().is_none();
        let is_of_no_other = || others.iter().all(|&e| sign(e).is_some());
        let is_own = is_of_one && is_of_no_other();
        self.all(|e| sign(e).or_else(|| is_own.then_some(Ordering::Equal)))
    }

    fn all(&self, sign: impl Fn(Expr) -> Option<Ordering>) -> Option<bool> {
        let holds = |own: &Condition| Some(own.holds(sign(own.function)?));
        let found: Vec<Option<bool>> = self.conditions.iter().map(holds).collect();
        if found.contains(&Some(false)) {
            return Some(false);
        }
        let all: Option<Vec<bool>> = found.into_iter().collect();
        all.map(|_| true)
    }
}
