//! Steady motions in numbers, near starts: where their equations cannot be solved exactly.
//!
//! Newton's method begins at the motions that the model names, at the initial state, at rest in the initial positions, and at places about the first of
//! these, the same ones at each call. What is found is a steady motion to rounding; that there are no others is not said.

use super::words::sentence;
use crate::decimals::Decimals;
use crate::follow::text::{plain, where_eigenvalues_lie};
use crate::follow::{initial, of_motion, FollowError};
use crate::stability::motions;
use chetaev_mechanics::sample::Generator;
use chetaev_mechanics::{Prepared, System};
use chetaev_model::Model;
use chetaev_orbits::branch::{solution, Point};
use chetaev_orbits::equilibria::Equilibria;
use chetaev_orbits::flow::Coordinates;
use chetaev_orbits::Flow;
use chetaev_stability::steady_set::SteadySetError;
use chetaev_symbolic::Symbol;
use serde_json::json;
use std::f64::consts::{PI, TAU};
use std::fmt::Write as _;

/// Starts beside those that the model gives.
const STARTS: usize = 60;
/// How far from the first start they lie at most, in its own size, 1 where that is zero; a tenth to ten times as far, as scales are not known.
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
    let (terms, selection) = (&prepared.terms, &prepared.selection);
    let first = starts.first().map_or(&[][..], |own| &own.1);
    let which = (Coordinates::NotIgnorable, first);
    let flow = Flow::of_system(system, terms, selection, which)?;
    let of = |(name, point): &Start| Some((Some(name.clone()), flow.state(point).ok()?));
    let mut all: Vec<(Option<String>, Vec<f64>)> = starts.iter().filter_map(of).collect();
    let about = flow.state(first)?;
    all.extend(places_about(&flow, &about).map(|place| (None, place)));
    let mut equations = Equilibria::new(&flow, None)?;
    let mut found: Vec<Near> = Vec::new();
    for (from, start) in &all {
        let Ok((mut point, family)) = solution(&mut equations, start, 0.0) else {
            continue;
        };
        turned(&flow, &mut point.unknowns);
        let is_known = |own: &Near| {
            is_same(&own.point.unknowns, &point.unknowns)
                || (from.is_none() && family > 0 && own.family == family)
        };
        if !found.iter().any(is_known) {
            found.push(Near {
                point,
                family,
                from: from.clone(),
            });
        }
    }
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
    let start = initial(model, system, prepared);
    match (start, all.is_empty()) {
        (Ok(point), _) => all.push(("start".into(), point)),
        (Err(problem), true) => return Err(problem),
        (Err(_), false) => {}
    }
    Ok(all)
}

/// Places about a state, the same ones at each call: angles anywhere.
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
                .map(|(name, x)| format!("{name} = {:.9}", plain(*x)))
                .collect();
            let from = own
                .from
                .as_ref()
                .map_or(String::new(), |from| format!(", near `{from}`"));
            let _ = writeln!(text, "  {}  {}{from}", at + 1, values.join(", "));
            if own.family > 0 {
                let _ = writeln!(text, "       one of a family of dimension {}", own.family);
            }
            let spectrum = &own.point.spectrum.values;
            let decimals = Decimals::of(spectrum.iter().map(|l| (l.re, l.im)));
            let eigenvalues = spectrum.iter().map(|l| decimals.complex((l.re, l.im)));
            let eigenvalues: Vec<String> = eigenvalues.collect();
            let _ = match eigenvalues.as_slice() {
                [] => writeln!(text, "       no eigenvalues but those that structure gives"),
                own => writeln!(
                    text,
                    "       eigenvalues {}: {}",
                    own.join("  "),
                    where_eigenvalues_lie(spectrum)
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
            json!({
                "name": (at + 1).to_string(),
                "near": own.from,
                "dimension": own.family,
                "free": [],
                "equations": [],
                "not_negative": [],
                "closed_form": false,
                "values": values.collect::<Vec<_>>(),
                "eigenvalues": eigenvalues.collect::<Vec<_>>(),
                "stability": where_eigenvalues_lie(spectrum),
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
