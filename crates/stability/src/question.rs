//! The question of stability as it is asked of a system: linear equations, their characteristic polynomial, and the ranges of one parameter in
//! which the eigenvalues that were not split off lie left of the axis, or on it.
//!
//! Where the characteristic polynomial is even, q(λ²), as that of a conservative or reversible system, no eigenvalue can be left of the axis
//! without its mirror image. All of them lie on the axis and are simple exactly where the zeros of q are real, negative and simple, hence
//! exactly where q(λ²) + λ q'(λ²) has all zeros left of the axis (Hermite 1856, Biehler 1879).

use crate::characteristic::Characteristic;
use crate::hurwitz::{determinants, ranges, Ranges};
use crate::linearization::{linearize, Linearization, LinearizationError};
use crate::real_roots::{sign_at, sign_of};
use chetaev_mechanics::{MotionTerms, Selection, SteadyMotion, System};
use chetaev_symbolic::factors::coefficients;
use chetaev_symbolic::number::ball::Precision;
use chetaev_symbolic::{Expr, Graph, Symbol};
use dashu_ratio::RBig;
use std::cmp::Ordering;

/// The linear equations about a motion with their polynomial.
#[derive(Clone, Debug)]
pub struct Question {
    /// The linear equations, with the values of all parameters but one.
    pub linear: Linearization,
    /// det(λE − F); `None` where it is too large.
    pub polynomial: Option<Characteristic>,
    /// The parameter that was left in.
    pub over: Option<Symbol>,
}

/// What the eigenvalues do inside of an interval.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// All lie left of the axis.
    Left,
    /// All lie on the axis, and are simple.
    OnAxis,
    /// At least one lies right of the axis.
    Right,
}

impl Question {
    /// The question about a motion, with one parameter left in.
    ///
    /// # Errors
    /// [`LinearizationError`].
    pub fn new(
        system: &System,
        terms: &MotionTerms,
        selection: &Selection,
        motion: &SteadyMotion,
        over: Option<Symbol>,
    ) -> Result<Question, LinearizationError> {
        let values = values_but(system, over);
        let linear = linearize(system, terms, selection, motion, &values)?;
        let polynomial = Characteristic::of(&system.graph, &linear);
        Ok(Question {
            linear,
            polynomial,
            over,
        })
    }

    /// Whether the polynomial is even.
    pub fn is_even(&self, g: &Graph) -> bool {
        let polynomial = self.polynomial.as_ref();
        polynomial.is_some_and(|p| {
            p.degree() > 0
                && p.coefficients
                    .iter()
                    .skip(1)
                    .step_by(2)
                    .all(|&e| g.is_zero(e))
        })
    }

    /// The polynomial whose zeros decide: itself, or q(λ²) + λ q'(λ²) where it is even.
    pub fn deciding(&self, g: &Graph) -> Option<Vec<Expr>> {
        let own = &self.polynomial.as_ref()?.coefficients;
        if !self.is_even(g) {
            return Some(own.clone());
        }
        let even: Vec<Expr> = own.iter().step_by(2).copied().collect();
        let slope = |i: usize| g.mul(&[g.integer(i as i64 + 1), even[i + 1]]);
        let mut found = Vec::new();
        for (i, &e) in even.iter().enumerate() {
            found.push(e);
            if i + 1 < even.len() {
                found.push(slope(i));
            }
        }
        Some(found)
    }

    /// What the eigenvalues do in an interval in which the deciding polynomial has, or has not, all zeros left of the axis.
    pub fn place(&self, g: &Graph, is_left: bool) -> Place {
        match (is_left, self.is_even(g)) {
            (true, false) => Place::Left,
            (true, true) => Place::OnAxis,
            (false, _) => Place::Right,
        }
    }

    /// Stability over a range of the parameter that was left in; `None` where that was not decided.
    pub fn ranges(&self, g: &Graph, low: &RBig, high: &RBig) -> Option<Ranges> {
        ranges(g, &self.deciding(g)?, self.over?, low, high)
    }

    /// A number beyond which, on both sides, nothing changes any more: Cauchy's bound of the zeros of all determinants.
    pub fn bound(&self, g: &Graph) -> Option<RBig> {
        let (symbol, deciding) = (self.over?, self.deciding(g)?);
        let all = determinants(g, &deciding, Ordering::Greater);
        let ends = [*deciding.first()?, *deciding.last()?];
        let bounds = all.iter().chain(&ends).map(|&e| cauchy_bound(g, e, symbol));
        bounds.collect::<Option<Vec<RBig>>>()?.into_iter().max()
    }

    /// The signs of Hurwitz's determinants of the deciding polynomial, at a value of the parameter that was left in, if one was.
    pub fn signs(&self, g: &Graph, at: Option<&RBig>) -> Option<Vec<Ordering>> {
        let value = self.over.zip(at);
        let sign = |e: Expr| match value {
            Some((symbol, at)) => sign_at(g, e, symbol, at),
            None => sign_of(g, e),
        };
        let deciding = self.deciding(g)?;
        let leading = sign(*deciding.last()?)?;
        let list = determinants(g, &deciding, leading).into_iter();
        list.map(sign).collect()
    }
}

/// The values of all parameters but one. Parameters whose definitions contain that one are put in by their definitions.
pub fn values_but(system: &System, over: Option<Symbol>) -> Vec<(Expr, Expr)> {
    let g = &system.graph;
    let all = system.parameter_values();
    let Some(over) = over else {
        return all;
    };
    let mut values: Vec<(Expr, Expr)> = Vec::new();
    for (symbol, value) in all {
        let definition = system
            .definitions
            .iter()
            .find(|(own, _)| *own == symbol)
            .map(|(_, e)| *e);
        let expanded = definition.map(|e| expanded(system, e));
        match expanded.filter(|&e| g.contains_any(e, &[over])) {
            Some(e) => values.push((symbol, with_values(system, e, over))),
            None if g.as_symbol(symbol) == Some(over) => {}
            None => values.push((symbol, value)),
        }
    }
    values
}

/// A definition with the definitions that it uses.
fn expanded(system: &System, e: Expr) -> Expr {
    let g = &system.graph;
    let mut e = e;
    for _ in 0..system.definitions.len() {
        let next = g.substitute(e, &system.definitions);
        if next == e {
            break;
        }
        e = next;
    }
    e
}

/// An expression of parameters with the values of all but one.
fn with_values(system: &System, e: Expr, over: Symbol) -> Expr {
    let g = &system.graph;
    let values: Vec<(Expr, Expr)> = system.parameter_values();
    let values: Vec<(Expr, Expr)> = values
        .into_iter()
        .filter(|(s, _)| g.as_symbol(*s) != Some(over))
        .collect();
    g.substitute(e, &values)
}

/// 1 + max |aᵢ/aₙ| as an integer (Cauchy 1829); `None` where `e` is no polynomial with numbers as coefficients.
fn cauchy_bound(g: &Graph, e: Expr, symbol: Symbol) -> Option<RBig> {
    let precision = Precision::new(128);
    let list = coefficients(g, e, symbol)?;
    let balls = g.enclose(&list, &precision, &|_| None).ok()?;
    let leading = balls.iter().rev().find(|b| b.excludes_zero())?;
    let mut bound = RBig::from(2);
    for own in &balls {
        let ratio = precision.abs(&precision.div(own, leading).ok()?);
        let above = RBig::from(2) + ratio.upper().to_rational()?;
        bound = bound.max(RBig::from(above.ceil()));
    }
    Some(bound)
}
