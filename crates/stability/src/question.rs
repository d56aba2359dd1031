//! The question of stability as it is asked of a system: linear equations, their characteristic polynomial, and the ranges of one parameter in
//! which the eigenvalues that were not split off lie left of the axis, or on it.

use crate::admissible_values::{AdmissibleValues, Reality};
use crate::characteristic::Characteristic;
use crate::complex_zeros::zeros;
use crate::eigenvalues::{Complex, Known};
use crate::enclosure::is_right_of_axis_at;
use crate::expansion::Expansion;
use crate::hurwitz::{determinants, ranges, ranges_within, Deciding, Ranges, Region, Side};
use crate::isolation::Root;
use crate::linearization::{Linearization, LinearizationError};
pub use crate::parameter_values::{
    general_parameters, stated_functions, values_at, values_but, values_but_these,
};
pub use crate::real_roots::bound_of;
use crate::real_roots::{real_roots, sign_at, sign_of};
use crate::spectrum::Spectrum;
use chetaev_mechanics::{MotionTerms, Selection, SteadyMotion, System};
use chetaev_symbolic::{Expr, Graph, Symbol};
use dashu_ratio::RBig;
use std::cmp::Ordering;
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

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
    /// Stability over ranges that were asked for: several claims ask for the same.
    known: Arc<Mutex<BTreeMap<Asked, Option<Ranges>>>>,
}

/// A range of the parameter, and the power of two to which its boundaries are enclosed.
type Asked = (RBig, RBig, usize);

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
            known: Arc::default(),
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

    /// What is known exactly of the eigenvalues at these values of the parameters: how many are zero, and where the zeros
    /// of its factors lie.
    pub fn known(&self, g: &Graph, values: &[(Expr, Expr)]) -> Known {
        let Some(polynomial) = &self.polynomial else {
            return Known {
                zeros: self.linear.family,
                others: Vec::new(),
            };
        };
        let there = polynomial.at(g, values);
        let is_same = there.coefficients == polynomial.coefficients;
        let spectrum = if is_same {
            self.spectrum.clone()
        } else {
            Spectrum::of(g, &there)
        };
        let mut others = Vec::new();
        for (factor, power) in spectrum.factors {
            for (re, im) in zeros(g, &factor).unwrap_or_default() {
                others.extend(vec![Complex::new(re, im); power as usize]);
            }
        }
        Known {
            zeros: there.zeros + there.further_zeros,
            others,
        }
    }

    /// What the eigenvalues do throughout a region of the parameter.
    pub fn place_in(&self, region: &Region) -> Place {
        self.place_of(match (region.is_left, region.is_decided) {
            (true, _) => Side::Left,
            (false, true) => Side::Right,
            (false, false) => Side::Opposite,
        })
    }

    /// The same where all deciding polynomials have all their zeros left of the axis.
    pub fn place_of_left(&self) -> Place {
        self.place_of(Side::Left)
    }

    /// What the eigenvalues do where the zeros of the deciding polynomials lie so.
    fn place_of(&self, side: Side) -> Place {
        let is_strict = self.spectrum.paired.is_none()
            && self
                .polynomial
                .as_ref()
                .is_none_or(|own| own.further_zeros == 0);
        match side {
            Side::Left if is_strict => Place::Left,
            Side::Left => Place::OnAxis,
            Side::Opposite => Place::NotLeft,
            Side::Right => Place::Right,
        }
    }

    /// Stability over a range of the parameter that was left in; `None` where that was not decided.
    pub fn ranges(&self, g: &Graph, low: &RBig, high: &RBig) -> Option<Ranges> {
        let leading = *self.polynomial.as_ref()?.coefficients.last()?;
        ranges(g, &self.deciding(g), leading, self.over?, low, high)
    }

    /// The same with boundaries enclosed to a power of two.
    pub(crate) fn ranges_within(
        &self,
        g: &Graph,
        (low, high): (&RBig, &RBig),
        halvings: usize,
    ) -> Option<Ranges> {
        let asked = (low.clone(), high.clone(), halvings);
        let mut known = self.known.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(found) = known.get(&asked) {
            return found.clone();
        }
        let leading = *self.polynomial.as_ref()?.coefficients.last()?;
        let deciding = self.deciding(g);
        let found = ranges_within(g, (&deciding, leading), self.over?, (low, high), halvings);
        known.insert(asked, found.clone());
        found
    }

    /// Where in an interval of the parameter that was left in the motion begins or ceases to be real, or to be as the model assumes; none where
    /// that was not decided.
    pub fn ends_of_motion(&self, about: &Expansion<'_>, low: &RBig, high: &RBig) -> Vec<Root> {
        let g = &about.system.graph;
        let all = self.conditions_of(about).into_iter();
        let ends = all.flat_map(|(symbol, own)| {
            let of = move |e| real_roots(g, e, symbol, low, high).unwrap_or_default();
            own.functions().into_iter().flat_map(of)
        });
        ends.collect()
    }

    /// Whether the motion is proved not to be real, or not to be as the model assumes, at a value of the parameter that was left in.
    pub fn is_absent(&self, about: &Expansion<'_>, at: &RBig) -> bool {
        let g = &about.system.graph;
        let all = self.conditions_of(about);
        all.iter()
            .any(|(_, own)| own.contains(g, at) == Some(false))
    }

    /// The same at a value that is enclosed, a zero of one of the functions of the boundaries.
    pub fn is_absent_in(&self, about: &Expansion<'_>, root: &Root) -> bool {
        let g = &about.system.graph;
        let functions = self.boundary_functions(g);
        let all = self.conditions_of(about);
        all.iter()
            .any(|(_, own)| own.contains_root(g, root, &functions) == Some(false))
    }

    /// For which values of the parameter that was left in the motion is real, and for which it is as the model assumes.
    fn conditions_of(&self, about: &Expansion<'_>) -> Vec<(Symbol, AdmissibleValues)> {
        let of = |symbol: Symbol| {
            let Reality { real, assumed } =
                AdmissibleValues::reality(about.system, &about.found, symbol);
            [(symbol, real), (symbol, assumed)]
        };
        self.over.into_iter().flat_map(of).collect()
    }

    /// Whether an eigenvalue is proved to lie right of the axis at the value of the parameter in an enclosure.
    pub fn is_unstable_at(&self, g: &Graph, root: &Root) -> bool {
        let factors = self.spectrum.factors.iter().map(|(f, _)| f.clone());
        let factors: Vec<_> = factors.collect();
        self.over
            .is_some_and(|symbol| is_right_of_axis_at(g, &factors, (symbol, root)))
    }

    /// A number beyond which, on both sides, nothing changes any more: twice Cauchy's bound of the zeros of all determinants.
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

    /// What the eigenvalues do at these values of all parameters that were left in; `None` where that was not decided.
    pub fn place_with(&self, g: &Graph, values: &[(Expr, Expr)]) -> Option<Place> {
        let polynomial = self.polynomial.as_ref()?.at(g, values);
        let there = Question {
            spectrum: Spectrum::of(g, &polynomial),
            polynomial: Some(polynomial),
            linear: self.linear.clone(),
            over: None,
            known: Arc::default(),
        };
        there.place_at(g, None)
    }

    /// What the eigenvalues do, at a value of the parameter that was left in, if one was; `None` where that was not decided.
    pub fn place_at(&self, g: &Graph, at: Option<&RBig>) -> Option<Place> {
        let sign = |e: Expr| self.sign(g, e, at);
        if self.is_mass_singular()
            || sign(*self.polynomial.as_ref()?.coefficients.last()?)? == Ordering::Equal
        {
            return None;
        }
        let mut found = Side::Left;
        for own in self.deciding(g) {
            let leading = sign(*own.coefficients.last()?)?;
            let list = determinants(g, &own.coefficients).into_iter().map(sign);
            let list: Vec<Ordering> = list.collect::<Option<_>>()?;
            found = found.max(Side::of(&[vec![leading], list].concat()));
        }
        Some(self.place_of(found))
    }

    /// Whether the masses are singular, whatever the parameter: fewer eigenvalues are finite than there are variables.
    pub fn is_mass_singular(&self) -> bool {
        let size = self.linear.variables.len();
        self.polynomial
            .as_ref()
            .is_some_and(|own| own.degree() + own.zeros + own.further_zeros < size)
    }

    /// The sign of an expression of the parameter that was left in, at a value of it.
    pub fn sign(&self, g: &Graph, e: Expr, at: Option<&RBig>) -> Option<Ordering> {
        match self.over.zip(at) {
            Some((symbol, at)) => sign_at(g, e, symbol, at),
            None => sign_of(g, e),
        }
    }
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
