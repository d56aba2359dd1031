//! All steady motions of a model: `chetaev steady`; those near starts, in numbers, where their equations cannot be solved exactly.
#![allow(
    clippy::result_large_err,
    reason = "an error is made once, and told at once"
)]

mod search;
pub(crate) mod words;

pub use search::{Near, Search, Singular};

use crate::follow::FollowError;
use crate::stability::error::StabilityError;
use crate::start;
use chetaev_mechanics::{SteadyMotion, System};
use chetaev_model::Model;
use chetaev_stability::question::{general_parameters, stated_functions};
use chetaev_stability::steady_set::{steady_set, Found, SteadySet, SteadySetError, Value};
use chetaev_symbolic::Graph;
use serde_json::json;
use std::fmt::Write as _;

/// The steady motions of a system.
#[derive(Debug)]
pub struct Steady {
    /// The system.
    pub system: System,
    /// Which.
    pub motions: Motions,
    /// Whether parameters stayed symbols, or have no value, so that they are in general position.
    pub is_symbolic: bool,
}

/// Steady motions that were found.
#[derive(Debug)]
pub enum Motions {
    /// All of them, exactly.
    All(Box<SteadySet>),
    /// Some, in numbers.
    Near(Box<Search>),
}

/// The steady motions of a model for the values of its parameters, or for values in general position. Where the equations for the values are not
/// solved exactly those near starts are sought in numbers.
///
/// # Errors
/// [`FollowError`].
pub fn steady(model: &Model, is_symbolic: bool) -> Result<Steady, FollowError> {
    let system = System::from_model(model)?;
    let prepared = start::prepared(model, &system)?;
    let values = if is_symbolic {
        Vec::new()
    } else {
        system.parameter_values()
    };
    let found = steady_set(&system, &prepared.terms, &prepared.selection, &values);
    let motions = match found {
        Ok(set) => Motions::All(Box::new(set)),
        // Without a closed system there is nothing to search in.
        Err(why) if is_symbolic || matches!(why, SteadySetError::System(_)) => {
            return Err(StabilityError::from(why).into());
        }
        Err(why) => Motions::Near(Box::new(search::search(model, (&system, &prepared), why)?)),
    };
    let general = general_parameters(&system, &stated_functions(&system));
    Ok(Steady {
        motions,
        is_symbolic: is_symbolic || !general.is_empty(),
        system,
    })
}

impl Steady {
    /// The motions in words.
    pub fn text(&self) -> String {
        match &self.motions {
            Motions::All(set) => self.text_of_all(set),
            Motions::Near(search) => search.text(&self.system.name),
        }
    }

    fn text_of_all(&self, set: &SteadySet) -> String {
        let g = &self.system.graph;
        let mut text = format!("{}: motions along which ", self.system.name);
        let _ = match set.ignorable.as_slice() {
            [] => writeln!(text, "{} are constant", set.variables.join(", ")),
            own => writeln!(
                text,
                "{} are constant; nothing depends on {}",
                set.variables.join(", "),
                own.join(", ")
            ),
        };
        let coordinates = &self.system.coordinates;
        let is_velocity = |name: &str| coordinates.iter().any(|c| format!("{}'", c.name) == name);
        let named = |name: &String| !is_velocity(name);
        let of_names = set.speeds.iter().filter(|(name, _)| named(name));
        for (name, definition) in of_names {
            let _ = writeln!(text, "  {name} = {}", g.text(*definition));
        }
        text.push('\n');
        text.extend(set.found.iter().map(|own| words::paragraph(g, set, own)));
        text.push('\n');
        let _ = writeln!(text, "{}", self.completeness(set));
        for clause in set.left_out(g) {
            let _ = writeln!(text, "{}.", words::sentence(&clause));
        }
        text
    }

    fn completeness(&self, set: &SteadySet) -> String {
        let general = if self.is_symbolic {
            " for parameters in general position"
        } else {
            ""
        };
        let said = match (set.found.is_empty(), set.is_complete()) {
            (true, false) => "None was found where nothing is left out",
            (true, true) if !set.poles.is_empty() => {
                "None was found where the equations are defined"
            }
            (true, true) => "There are none",
            (false, false) => "These are all where nothing is left out",
            (false, true) => "These are all",
        };
        let others = if self.is_symbolic {
            " For special values there may be others."
        } else {
            ""
        };
        format!("{said}{general}: the equations are polynomial in the variables, their sines and cosines, and were solved exactly.{others}")
    }

    /// The motions as data.
    pub fn json(&self) -> serde_json::Value {
        match &self.motions {
            Motions::All(set) => self.json_of_all(set),
            Motions::Near(search) => search.json(&self.system.name),
        }
    }

    fn json_of_all(&self, set: &SteadySet) -> serde_json::Value {
        let g = &self.system.graph;
        let text = |e: &chetaev_symbolic::Expr| g.text(*e);
        // Algebraic numbers have no notation in models: they are given by their enclosures.
        let formula = |e: &chetaev_symbolic::Expr| (!g.holds_algebraic(*e)).then(|| g.text(*e));
        let texts = |all: &[chetaev_symbolic::Expr]| all.iter().map(text).collect::<Vec<_>>();
        let motion = |own: &Found| {
            let values = set.variables.iter().zip(&own.values);
            let values = values.map(|(name, value)| match value {
                Value::Number { exact, ball } => {
                    let (low, high) = ball.to_decimal_interval(20);
                    json!({"name": name, "exact": exact.as_ref().and_then(formula), "value": ball.to_f64(), "enclosure": [low, high]})
                }
                Value::Function(e) => json!({"name": name, "exact": text(e)}),
                Value::Tied => json!({"name": name}),
            });
            let velocities = own.motion.iter().flat_map(|motion| {
                let velocities = self.system.coordinates.iter().zip(&motion.velocities);
                velocities.filter_map(|(c, v)| {
                    Some(json!({"name": format!("{}'", c.name), "exact": formula(v.as_ref()?)?}))
                })
            });
            json!({
                "name": own.name,
                "dimension": own.dimension(),
                "free": own.free.iter().map(|(e, _)| text(e)).collect::<Vec<_>>(),
                "values": values.collect::<Vec<_>>(),
                "velocities": velocities.collect::<Vec<_>>(),
                "equations": texts(&own.equations),
                "not_negative": texts(&own.conditions),
                "real": own.is_real,
                "singular_mass": own.is_singular,
                "assumed": own.is_assumed,
                "closed_form": own.motion.as_ref().is_some_and(|motion| is_closed(g, motion)),
            })
        };
        json!({
            "system": self.system.name,
            "variables": set.variables,
            "speeds": set.speeds.iter().map(|(name, e)| json!({"name": name, "definition": text(e)})).collect::<Vec<_>>(),
            "ignorable": set.ignorable,
            "complete": set.is_complete(),
            "general_position": self.is_symbolic,
            "full_rank": set.has_full_rank,
            "excluded": texts(&[set.poles.clone(), set.excluded.clone()].concat()),
            "motions": set.found.iter().map(motion).collect::<Vec<_>>(),
        })
    }
}

/// Whether all values of a motion have a closed form.
fn is_closed(g: &Graph, motion: &SteadyMotion) -> bool {
    let mut values = motion.positions.iter().chain(&motion.velocities).flatten();
    values.all(|&e| !g.holds_algebraic(e))
}
