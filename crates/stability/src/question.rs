//! The question of stability as it is asked of a system: linear equations, their characteristic polynomial, and the ranges of one parameter in
//! which the eigenvalues that were not split off lie left of the axis, or on it.

use crate::characteristic::Characteristic;
use crate::expansion::Expansion;
use crate::hurwitz::{are_positive, determinants, ranges, Deciding, Ranges};
use crate::linearization::{Linearization, LinearizationError};
use crate::real_roots::{sign_at, sign_of};
use crate::spectrum::Spectrum;
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
    /// The factors of it.
    pub spectrum: Spectrum,
    /// The parameter that was left in.
    pub over: Option<Symbol>,
}

/// What the eigenvalues do inside of an interval.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// All lie left of the axis, but the zeros of the family.
    Left,
    /// None lies right of the axis, and those on it, but zero, are simple zeros of the factors.
    OnAxis,
    /// At least one lies right of the axis.
    Right,
    /// One lies on the axis or right of it: two are opposite, and where they lie was not decided.
    NotLeft,
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
        let about = Expansion::new(system, terms, selection, motion, &values)?;
        Ok(Question::about(&about, over))
    }

    /// The question about a motion that was found to be steady.
    pub fn about(about: &Expansion<'_>, over: Option<Symbol>) -> Question {
        let g = &about.system.graph;
        let linear = about.linear();
        let polynomial = Characteristic::of(g, &linear);
        let spectrum = polynomial.as_ref().map(|own| Spectrum::of(g, own));
        Question {
            linear,
            polynomial,
            spectrum: spectrum.unwrap_or_default(),
            over,
        }
    }

    /// The polynomials whose zeros decide.
    pub fn deciding(&self, g: &Graph) -> Vec<Deciding> {
        self.spectrum.deciding(g)
    }

    /// How many eigenvalues are zero whatever the parameters, those of the family included.
    pub fn zeros(&self) -> usize {
        let polynomial = self.polynomial.as_ref();
        polynomial.map_or(0, |own| own.zeros + own.further_zeros)
    }

    /// What the eigenvalues do where the deciding polynomials have, or have not, all zeros left of the axis.
    pub fn place(&self, is_left: bool) -> Place {
        let is_strict = self.spectrum.paired.is_none()
            && self
                .polynomial
                .as_ref()
                .is_none_or(|own| own.further_zeros == 0);
        match (is_left, is_strict) {
            (true, true) => Place::Left,
            (true, false) => Place::OnAxis,
            (false, _) => Place::Right,
        }
    }

    /// Stability over a range of the parameter that was left in; `None` where that was not decided.
    pub fn ranges(&self, g: &Graph, low: &RBig, high: &RBig) -> Option<Ranges> {
        let leading = *self.polynomial.as_ref()?.coefficients.last()?;
        ranges(g, &self.deciding(g), leading, self.over?, low, high)
    }

    /// A number beyond which, on both sides, nothing changes any more: Cauchy's bound of the zeros of all determinants.
    pub fn bound(&self, g: &Graph) -> Option<RBig> {
        self.polynomial.as_ref()?;
        bound_of(g, &self.boundary_functions(g), self.over?)
    }

    /// The functions of the parameter that was left in at whose zeros eigenvalues may pass the axis, or go to infinity.
    pub(crate) fn boundary_functions(&self, g: &Graph) -> Vec<Expr> {
        let polynomial = self.polynomial.iter();
        let mut all: Vec<Expr> = polynomial
            .filter_map(|own| own.coefficients.last().copied())
            .collect();
        for own in self.deciding(g) {
            all.extend(determinants(g, &own.coefficients));
            all.extend(own.coefficients.first());
            all.extend(own.coefficients.last());
        }
        all
    }

    /// What the eigenvalues do, at a value of the parameter that was left in, if one was; `None` where that was not decided.
    pub fn place_at(&self, g: &Graph, at: Option<&RBig>) -> Option<Place> {
        let sign = |e: Expr| self.sign(g, e, at);
        if sign(*self.polynomial.as_ref()?.coefficients.last()?)? == Ordering::Equal {
            return None;
        }
        let (mut is_left, mut is_apart_everywhere) = (true, true);
        for own in self.deciding(g) {
            let leading = sign(*own.coefficients.last()?)?;
            let list: Option<Vec<Ordering>> = determinants(g, &own.coefficients)
                .into_iter()
                .map(sign)
                .collect();
            let list = list?;
            let signs = [vec![leading], list.clone()].concat();
            if are_positive(&signs) {
                continue;
            }
            // Where two zeros are opposite, or one is zero, they may lie on the axis.
            let is_apart = |at: usize| list.get(at).is_none_or(|s| *s != Ordering::Equal);
            if !list.len().checked_sub(2).is_none_or(is_apart) || !is_apart(list.len() - 1) {
                is_apart_everywhere = false;
            }
            is_left = false;
        }
        Some(if is_apart_everywhere {
            self.place(is_left)
        } else {
            Place::NotLeft
        })
    }

    /// The sign of an expression of the parameter that was left in, at a value of it.
    pub fn sign(&self, g: &Graph, e: Expr, at: Option<&RBig>) -> Option<Ordering> {
        match self.over.zip(at) {
            Some((symbol, at)) => sign_at(g, e, symbol, at),
            None => sign_of(g, e),
        }
    }
}

/// A number beyond which, on both sides, none of these functions of a parameter vanishes; `None` where one is no polynomial.
pub fn bound_of(g: &Graph, es: &[Expr], symbol: Symbol) -> Option<RBig> {
    let bounds = es.iter().map(|&e| cauchy_bound(g, e, symbol));
    bounds.collect::<Option<Vec<RBig>>>()?.into_iter().max()
}

/// The parameter over whose values a motion is judged: the one that the model names for it, else the one that occurs in the motion and not in
/// the equations of the system, where there is exactly one.
pub fn parameter_of_motion(system: &System, motion: &SteadyMotion) -> Option<Symbol> {
    if motion.over.is_some() {
        return motion.over;
    }
    let g = &system.graph;
    let given: Vec<_> = motion
        .positions
        .iter()
        .chain(&motion.velocities)
        .flatten()
        .copied()
        .collect();
    let mut equations = vec![system.lagrangian];
    equations.extend(&system.forces);
    equations.extend(system.constraints.iter().map(|c| c.stated));
    equations.extend(system.definitions.iter().map(|(_, e)| *e));
    equations.extend(system.controls.iter().filter_map(|c| c.law));
    let used = g.symbols_in(&equations);
    let of_motion = g.symbols_in(&given).into_iter();
    let mut free = of_motion.filter(|s| !used.contains(s));
    free.next().filter(|_| free.next().is_none())
}

/// The values of all parameters but one. Parameters whose definitions contain that one are put in by their definitions.
pub fn values_but(system: &System, over: Option<Symbol>) -> Vec<(Expr, Expr)> {
    values_but_these(system, over.as_slice())
}

/// The values of all parameters but some. Parameters whose definitions contain one of these are put in by their definitions.
pub fn values_but_these(system: &System, over: &[Symbol]) -> Vec<(Expr, Expr)> {
    let g = &system.graph;
    let all = system.parameter_values();
    if over.is_empty() {
        return all;
    }
    let mut values: Vec<(Expr, Expr)> = Vec::new();
    for (symbol, value) in all {
        let definition = system
            .definitions
            .iter()
            .find(|(own, _)| *own == symbol)
            .map(|(_, e)| *e);
        let expanded = definition.map(|e| expanded(system, e));
        match expanded.filter(|&e| g.contains_any(e, over)) {
            Some(e) => values.push((symbol, with_values(system, e, over))),
            None if g.as_symbol(symbol).is_some_and(|s| over.contains(&s)) => {}
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

/// The values of all parameters with a value for one of them, and with what follows for those that are defined by it.
pub fn values_at(system: &System, over: Symbol, at: Expr) -> Vec<(Expr, Expr)> {
    let g = &system.graph;
    let own = (g.symbol_expr(over), at);
    let others = values_but(system, Some(over)).into_iter();
    let others = others.map(|(symbol, value)| (symbol, g.substitute(value, &[own])));
    others.chain([own]).collect()
}

/// An expression of parameters with the values of all but some.
fn with_values(system: &System, e: Expr, over: &[Symbol]) -> Expr {
    let g = &system.graph;
    let values: Vec<(Expr, Expr)> = system.parameter_values();
    let values: Vec<(Expr, Expr)> = values
        .into_iter()
        .filter(|(s, _)| !g.as_symbol(*s).is_some_and(|s| over.contains(&s)))
        .collect();
    g.substitute(e, &values)
}

/// 1 + max |aᵢ/aₙ| as an integer (Cauchy 1829); `None` where `e` is no polynomial with numbers as coefficients.
fn cauchy_bound(g: &Graph, e: Expr, symbol: Symbol) -> Option<RBig> {
    let precision = Precision::new(128);
    let list = coefficients(g, e, symbol)?;
    let balls = g.enclose(&list, &precision, &|_| None).ok()?;
    let leading = balls.last().filter(|b| b.excludes_zero())?;
    let mut bound = RBig::from(2);
    for own in &balls {
        let ratio = precision.abs(&precision.div(own, leading).ok()?);
        let above = RBig::from(2) + ratio.upper().to_rational()?;
        bound = bound.max(RBig::from(above.ceil()));
    }
    Some(bound)
}
