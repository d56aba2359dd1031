//! Steady motions in numbers, near starts: where their equations cannot be solved exactly.
//!
//! Newton's method begins at the motions that the model names, at the initial state, at rest in the initial positions, and at places about the first of
//! these, the same ones at each call. What is found is a steady motion to rounding; that there are no others is not said.
//!
//! Where the velocities have poles by the independent ones, a zero of the equations is one of the choice of these, and is looked at once more with
//! those for which the constraints are best conditioned there. Where the mass matrix or the gradients of the constraints lose rank the equations
//! determine no accelerations, and nothing is said of stability.

use super::words::sentence;
use crate::decimals::{of_state, Decimals};
use crate::follow::text::where_eigenvalues_lie;
use crate::follow::{initial, of_motion, FollowError};
use crate::options::StudyOptions;
use crate::stability::motions;
use chetaev_mechanics::sample::Generator;
use chetaev_mechanics::system::Relation;
use chetaev_mechanics::{ConstraintKind, Prepared, Selection, System};
use chetaev_model::Model;
use chetaev_orbits::branch::Point;
use chetaev_orbits::equilibria::Equilibria;
use chetaev_orbits::flow::{Coordinates, Margins};
use chetaev_orbits::solution::solution;
use chetaev_orbits::units::Units;
use chetaev_orbits::{Flow, OrbitError};
use chetaev_stability::problem::LinearizationError;
use chetaev_stability::reduction::conditioned;
use chetaev_stability::singular::least_part_of;
use chetaev_stability::steady_set::SteadySetError;
use chetaev_symbolic::{Expr, Symbol};
use serde_json::json;
use std::f64::consts::{PI, TAU};
use std::fmt::Write as _;

/// Starts beside those that the model gives.
const STARTS: usize = 60;
/// How far from the first start they lie at most, in its own size, that of the units where it is zero; a tenth to ten times as far, as scales are not known.
const FAR: f64 = 4.0;
/// Motions that differ by less, in parts of their size, are one.
const SAME: f64 = 1e-6;

/// Steady motions that were found from starts.
#[derive(Debug)]
pub struct Search {
    /// Why they were not solved for exactly.
    pub why: SteadySetError,
    /// The variables.
    pub variables: Vec<String>,
    /// Coordinates on which nothing depends.
    pub ignorable: Vec<String>,
    /// How many starts were tried.
    pub starts: usize,
    /// The motions.
    pub found: Vec<Near>,
}

/// A steady motion to rounding.
#[derive(Debug)]
pub struct Near {
    /// Values of the variables, and eigenvalues.
    pub point: Point,
    /// The dimension of the family of steady motions to which it belongs.
    pub family: usize,
    /// The motion of the model from which it was found; none where it was found from another place.
    pub from: Option<String>,
    /// What loses its rank there, so that no accelerations are determined.
    pub singular: Option<Singular>,
}

impl Near {
    /// Whether another place is this one, or one of its kind that nobody named.
    fn covers(&self, other: &Near, units: &Units) -> bool {
        let is_kind = other.singular.is_some() || other.family > 0;
        let is_of_kind = self.singular == other.singular && self.family == other.family;
        let [own, of_other] = [self, other].map(|near| units.packed(&near.point.unknowns));
        is_same(&own, &of_other) || (other.from.is_none() && is_kind && is_of_kind)
    }
}

/// What loses its rank.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Singular {
    /// The mass matrix, as where angles are no coordinates.
    Mass,
    /// The gradients of the constraints.
    Gradients,
}

impl Singular {
    fn text(self) -> &'static str {
        match self {
            Singular::Mass => "the mass matrix is singular there, and the equations determine no accelerations",
            Singular::Gradients => "the gradients of the constraints depend on each other there, and nothing is said of its neighbours",
        }
    }
}

/// Steady motions near the starts of a model, and about them.
///
/// # Errors
/// [`FollowError`] where there are no explicit equations, or no start.
pub(super) fn search(
    model: &Model,
    (system, prepared): (&System, &Prepared),
    why: SteadySetError,
) -> Result<Search, FollowError> {
    let starts = starts(model, system, prepared)?;
    if let Some((name, _)) = starts
        .first()
        .filter(|_| are_singular(system, prepared, &starts))
    {
        let motion = name.clone();
        return Err(LinearizationError::Singular { motion }.into());
    }
    let charts = Charts {
        system,
        prepared,
        first: starts.first().map_or(&[][..], |own| &own.1),
    };
    let flow = charts.flow(&prepared.selection, charts.first)?;
    let of = |(name, point): &Start| Some((Some(name.clone()), flow.state(point).ok()?));
    let mut all: Vec<(Option<String>, Vec<f64>)> = starts.iter().filter_map(of).collect();
    let about = flow.state(charts.first)?;
    let units = flow.units_near(&about);
    let packed = units.packed(&about);
    let places = places_about(&flow, &packed);
    all.extend(places.map(|place| (None, units.unpacked(&place))));
    let found = charts.found(&flow, &units, &all)?;
    let ignorable = system.coordinates.iter();
    let ignorable = ignorable.filter(|c| !flow.variables.contains(&c.q_symbol));
    Ok(Search {
        why,
        ignorable: ignorable.map(|c| c.name.clone()).collect(),
        variables: flow.names.clone(),
        starts: all.len(),
        found,
    })
}

/// Whether the gradients of the constraints depend on each other at all starts that satisfy the finite constraints.
fn are_singular(system: &System, prepared: &Prepared, starts: &[Start]) -> bool {
    let (g, terms) = (&system.graph, &prepared.terms);
    let rows = &prepared.selection.rows;
    let gradients = rows.iter().flat_map(|&row| terms.jacobian[row].clone());
    let gradients: Vec<Expr> = gradients.map(|e| system.with_definitions(e)).collect();
    let constraints = rows
        .iter()
        .map(|&row| &system.constraints[terms.constraint_index[row]]);
    let finite = constraints.filter(|own| own.kind == ConstraintKind::Holonomic);
    let finite: Vec<Expr> = finite
        .map(|own| system.with_definitions(own.stated))
        .collect();
    let values = |es: &[Expr], (_, point): &Start| {
        let value = |s: Symbol| point.iter().find(|own| own.0 == s).map(|own| own.1);
        g.evaluate_f64(es, &value).ok()
    };
    let holds = |own: &&Start| {
        let found = values(&finite, own);
        found.is_some_and(|all| all.iter().all(|x| x.abs() < ADMISSIBLE))
    };
    let mut admissible = starts.iter().filter(holds).peekable();
    let is_singular = |own: &Start| {
        let found = values(&gradients, own);
        found.is_some_and(|own| least_part_of(rows.len(), &own) < AT_SINGULAR)
    };
    !rows.is_empty() && admissible.peek().is_some() && admissible.all(is_singular)
}

/// The largest residual of a finite constraint at a start.
const ADMISSIBLE: f64 = 1e-9;
/// A part of the gradients of constraints below this is none, as steps to where they depend on each other become slow; a mass matrix is quadratic in
/// such a distance.
const AT_SINGULAR: f64 = 1e-4;
/// Sides of an assumption that differ by less, in parts of the larger one, are equal to rounding.
const ROUNDING: f64 = 1e-9;
/// A slope of a velocity beyond this may be near a pole, and one beyond its square is.
const STEEP: f64 = 1e3;

/// What loses its rank at a place, in parts of what is usual: half of the starts are farther from it.
fn singular(own: Margins, usual: &[Margins]) -> Option<Singular> {
    let middle = |part: fn(&Margins) -> f64| {
        let mut all: Vec<f64> = usual.iter().map(part).collect();
        all.sort_by(f64::total_cmp);
        all.get(all.len() / 2).copied().unwrap_or(0.0)
    };
    let (mass, gradients) = (middle(|own| own.mass), middle(|own| own.gradients));
    if own.gradients < AT_SINGULAR * gradients {
        Some(Singular::Gradients)
    } else if own.mass < AT_SINGULAR * AT_SINGULAR * mass {
        Some(Singular::Mass)
    } else {
        None
    }
}

fn parameters(flow: &Flow) -> Vec<f64> {
    flow.parameters.iter().map(|own| own.1).collect()
}

/// The choices of independent velocities.
struct Charts<'a> {
    system: &'a System,
    prepared: &'a Prepared,
    /// Coordinates, velocities and parameters at the first start.
    first: &'a [(Symbol, f64)],
}

impl Charts<'_> {
    fn flow(&self, chart: &Selection, point: &[(Symbol, f64)]) -> Result<Flow, OrbitError> {
        let which = (Coordinates::NotIgnorable, point);
        Flow::of_system(self.system, &self.prepared.terms, chart, which)
    }

    /// The motions that are found from starts, each once; of families, and of places where something loses its rank, those that the model names
    /// and one more.
    fn found(
        &self,
        flow: &Flow,
        units: &Units,
        starts: &[(Option<String>, Vec<f64>)],
    ) -> Result<Vec<Near>, OrbitError> {
        let values = parameters(flow);
        let usual = starts.iter().map(|own| flow.margins(&own.1, &values));
        let usual: Vec<Margins> = usual.collect();
        let own = flow.in_units(units);
        let mut equations = Equilibria::new(&own, None)?;
        let mut found: Vec<Near> = Vec::new();
        for (from, start) in starts {
            let own = near(&mut equations, units, start);
            let settled = own.and_then(|own| self.settled(flow, own));
            let Some((mut point, family, margins)) = settled else {
                continue;
            };
            turned(flow, &mut point.unknowns);
            if !self.is_assumed(flow, &point.unknowns) {
                continue;
            }
            let own = Near {
                singular: singular(margins, &usual),
                from: from.clone(),
                family,
                point,
            };
            if !found.iter().any(|known| known.covers(&own, units)) {
                found.push(own);
            }
        }
        Ok(found)
    }

    /// Whether nothing that the model assumes fails at a state by more than rounding.
    fn is_assumed(&self, flow: &Flow, z: &[f64]) -> bool {
        let g = &self.system.graph;
        let place = self.at_rest(flow, z);
        let value = |s: Symbol| {
            let own = place.iter().find(|own| own.0 == s).map(|own| own.1);
            own.or_else(|| {
                flow.parameters
                    .iter()
                    .find(|own| own.0 == s)
                    .map(|own| own.1)
            })
        };
        self.system.assumptions.iter().all(|own| {
            let sides = [own.left, own.right].map(|e| self.system.with_definitions(e));
            let Ok(found) = g.evaluate_f64(&sides, &value) else {
                return true;
            };
            // An end of what is assumed may be met to rounding.
            let slack = ROUNDING * found.iter().map(|x| x.abs()).fold(0.0, f64::max);
            own.relation == Relation::NotEqual || found[0] <= found[1] + slack
        })
    }

    /// What was found with its margins; where the velocities have a pole, what is found near it by others. `None` where that is nothing.
    fn settled(
        &self,
        flow: &Flow,
        (point, family): (Point, usize),
    ) -> Option<(Point, usize, Margins)> {
        let margins = flow.margins(&point.unknowns, &parameters(flow));
        if margins.slope < STEEP {
            return Some((point, family, margins));
        }
        let place = self.at_rest(flow, &point.unknowns);
        let (terms, selection) = (&self.prepared.terms, &self.prepared.selection);
        let chart = conditioned(self.system, terms, selection, &place)?;
        let other = self.flow(&chart, &place).ok()?;
        let start = other.state(&place).ok()?;
        let units = other.units_near(&start);
        let own = other.in_units(&units);
        let mut equations = Equilibria::new(&own, None).ok()?;
        let (mut point, family) = near(&mut equations, &units, &start)?;
        let margins = other.margins(&point.unknowns, &parameters(&other));
        let place = self.at_rest(&other, &point.unknowns);
        point.unknowns = flow.state(&place).ok()?;
        let is_regular = margins.slope < STEEP * STEEP || margins.gradients < AT_SINGULAR;
        is_regular.then_some((point, family, margins))
    }

    /// The first start with the coordinates of a state, and its velocities where they have values.
    fn at_rest(&self, flow: &Flow, z: &[f64]) -> Vec<(Symbol, f64)> {
        let place = |s: Symbol| flow.variables.iter().position(|own| *own == s);
        let own = self
            .first
            .iter()
            .map(|&(s, value)| (s, place(s).map_or(value, |i| z[i])));
        let mut known: Vec<(Symbol, f64)> = own.collect();
        let value = |s: Symbol| {
            let variable = place(s).map(|i| z[i]);
            let other = || known.iter().find(|own| own.0 == s).map(|own| own.1);
            variable.or_else(other)
        };
        let velocities = flow.velocities.iter().map(|&e| {
            let found = flow.graph.evaluate_f64(&[e], &value).ok();
            let found = found.and_then(|all| all.first().copied());
            found.filter(|x| x.is_finite()).unwrap_or(0.0)
        });
        let velocities: Vec<f64> = velocities.collect();
        for (s, x) in self.system.velocity_symbols().into_iter().zip(velocities) {
            known.retain(|own| own.0 != s);
            known.push((s, x));
        }
        known
    }
}

/// The steady motion near a start, as it is, by equations in these units: what is small is decided in them, and not in those of the model.
fn near(equations: &mut Equilibria<'_>, units: &Units, start: &[f64]) -> Option<(Point, usize)> {
    let (point, family) = solution(equations, &units.packed(start), 0.0).ok()?;
    Some((point.restored(units, false), family))
}

/// The name of a motion with values of coordinates, velocities and parameters.
type Start = (String, Vec<(Symbol, f64)>);

/// The motions that the model names, its initial state, and rest in its initial positions; those of which numbers are known.
fn starts(model: &Model, system: &System, prepared: &Prepared) -> Result<Vec<Start>, FollowError> {
    let values = system.parameter_values();
    // Named motions are not sought.
    let none = || Err(SteadySetError::Undefined);
    let mut all = Vec::new();
    let names = system.steady.iter().map(|own| own.name.as_str());
    for name in names.chain(["rest"]) {
        let named = motions(model, system, Some(name), &none)?;
        for motion in &named {
            let point = of_motion(motion, system, prepared, &values);
            all.extend(point.ok().map(|point| (name.to_owned(), point)));
        }
    }
    let start = initial((model, system, prepared), &StudyOptions::default());
    match (start, all.is_empty()) {
        (Ok(point), _) => all.push(("start".into(), point)),
        (Err(problem), true) => return Err(problem),
        (Err(_), false) => {}
    }
    Ok(all)
}

/// Places about a state, both in units of the flow, the same ones at each call: angles anywhere.
fn places_about<'f>(flow: &'f Flow, about: &'f [f64]) -> impl Iterator<Item = Vec<f64>> + 'f {
    let mut generator = Generator::new(0x5eed_57ea);
    (0..STARTS).map(move |_| {
        let far = FAR * 10_f64.powf(generator.between(-1.0, 1.0));
        let pairs = about.iter().zip(&flow.is_turning);
        let place = pairs.map(|(x, is_turning)| {
            if *is_turning {
                return generator.between(-PI, PI);
            }
            let size = if *x == 0.0 { 1.0 } else { x.abs() };
            x + far * size * generator.between(-1.0, 1.0)
        });
        place.collect()
    })
}

/// Brings angles to the turn about zero.
fn turned(flow: &Flow, state: &mut [f64]) {
    for (x, is_turning) in state.iter_mut().zip(&flow.is_turning) {
        if *is_turning {
            *x -= TAU * (*x / TAU).round();
        }
    }
}

fn is_same(a: &[f64], b: &[f64]) -> bool {
    let mut pairs = a.iter().zip(b);
    pairs.all(|(x, y)| (x - y).abs() <= SAME * (1.0 + x.abs() + y.abs()))
}

impl Search {
    /// The motions in words.
    pub(super) fn text(&self, name: &str) -> String {
        let mut text = format!(
            "{name}: steady motions from {} starts, in numbers: nothing here is proved\n{}.\n\n",
            self.starts,
            sentence(&self.why.to_string())
        );
        for (at, own) in self.found.iter().enumerate() {
            let values = self.variables.iter().zip(&own.point.unknowns);
            let values: Vec<String> = values
                .map(|(name, x)| format!("{name} = {}", of_state(*x, 9)))
                .collect();
            let from = own
                .from
                .as_ref()
                .map_or(String::new(), |from| format!(", near `{from}`"));
            let _ = writeln!(text, "  {}  {}{from}", at + 1, values.join(", "));
            if let Some(singular) = own.singular {
                let _ = writeln!(text, "       {}", singular.text());
                continue;
            }
            if own.family > 0 {
                let _ = writeln!(text, "       one of a family of dimension {}", own.family);
            }
            let point = &own.point;
            let spectrum = &point.spectrum.values;
            let decimals = Decimals::of(spectrum.iter().map(|l| (l.re, l.im)));
            let known = spectrum.iter().zip(&point.spectrum.errors);
            let eigenvalues = known.map(|(l, &error)| decimals.known((l.re, l.im), error));
            let eigenvalues: Vec<String> = eigenvalues.collect();
            let _ = match eigenvalues.as_slice() {
                [] => writeln!(text, "       no eigenvalues but those that structure gives"),
                own => writeln!(
                    text,
                    "       eigenvalues {}: {}",
                    own.join("  "),
                    where_eigenvalues_lie(&point.spectrum)
                ),
            };
        }
        text.push_str(if self.found.is_empty() {
            "From none of the starts a steady motion was found, and there may be some.\n"
        } else {
            "\nThere may be others: state a guess as [steady.NAME], with values { guess = … }, and `chetaev follow` follows it over a parameter.\n"
        });
        if !self.ignorable.is_empty() {
            let _ = writeln!(text, "Nothing depends on {}.", self.ignorable.join(", "));
        }
        text
    }

    /// The motions as data.
    pub(super) fn json(&self, name: &str) -> serde_json::Value {
        let motion = |(at, own): (usize, &Near)| {
            let values = self.variables.iter().zip(&own.point.unknowns);
            let values = values.map(|(name, x)| json!({"name": name, "exact": null, "value": x}));
            let spectrum = &own.point.spectrum.values;
            let eigenvalues = spectrum.iter().map(|l| json!([l.re, l.im]));
            let is_regular = own.singular.is_none();
            json!({
                "name": (at + 1).to_string(),
                "near": own.from,
                "dimension": own.family,
                "free": [],
                "equations": [],
                "not_negative": [],
                "closed_form": false,
                "values": values.collect::<Vec<_>>(),
                "singular": own.singular.map(Singular::text),
                "eigenvalues": is_regular.then(|| eigenvalues.collect::<Vec<_>>()),
                "stability": is_regular.then(|| where_eigenvalues_lie(&own.point.spectrum)),
            })
        };
        json!({
            "system": name,
            "variables": self.variables,
            "speeds": [],
            "ignorable": self.ignorable,
            "complete": false,
            "evidence": "numerical",
            "why": self.why.to_string(),
            "starts": self.starts,
            "motions": self.found.iter().enumerate().map(motion).collect::<Vec<_>>(),
        })
    }
}
