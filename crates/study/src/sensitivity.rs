//! Sensitivities of a motion to parameters and initial values: `chetaev simulate --sensitivity`; the linear equations along it: `chetaev linearize
//! --along`.
#![allow(
    clippy::result_large_err,
    reason = "an error is made once, and told at once"
)]

use crate::follow::{initial, on_velocities, FollowError};
use crate::options::StudyOptions;
use crate::start;
use crate::start::{initial_data, settings};
use chetaev_integrate::Output;
use chetaev_mechanics::{Prepared, System};
use chetaev_model::Model;
use chetaev_orbits::along::{along, Along};
use chetaev_orbits::beginning::Beginning;
use chetaev_orbits::flow::Coordinates;
use chetaev_orbits::sensitivity::{sensitivities, Sensitivities};
use chetaev_orbits::variational::Order;
use chetaev_orbits::{Flow, OrbitError};
use serde_json::{json, Value};
use std::fmt::Write as _;

/// The system of a model on the component of its constraints on which the motion starts, to answer what was asked.
fn of_motion(model: &Model, what: &'static str) -> Result<(System, Prepared), FollowError> {
    let system = System::from_model(model)?;
    let prepared = start::prepared(model, &system)?;
    on_velocities(&prepared, what)?;
    if !model.simulation.crossings.is_empty() {
        return Err(FollowError::Crossings);
    }
    Ok(start::on_component(model, (system, prepared))?)
}

/// The sensitivities of the motion of a model to the parameters and initial values named in a text, separated by commas, at these times.
///
/// # Errors
/// [`FollowError`].
pub fn sensitivity(
    model: &Model,
    by: &str,
    order: Order,
    times: &[f64],
    options: &StudyOptions,
) -> Result<Sensitivities, FollowError> {
    let (system, prepared) = of_motion(model, "sensitivities")?;
    let data = initial_data(model, &system, options)?;
    let is_fixed = |s| {
        let place = |all: Vec<_>| all.iter().position(|own| *own == s);
        let position = place(system.coordinate_symbols()).map(|i| data.q_fixed[i]);
        position.or_else(|| place(system.velocity_symbols()).map(|i| data.v_fixed[i]))
    };
    let start = system.start.iter().copied();
    let (given, guessed) = start.partition(|(s, _)| is_fixed(*s) == Some(true));
    let beginning = Beginning {
        t: data.t,
        point: initial((model, &system, &prepared), options)?,
        given,
        guessed,
        project: data.project,
    };
    let names: Vec<String> = by.split(',').map(|name| name.trim().to_owned()).collect();
    let end = times.last().copied().unwrap_or(data.t);
    Ok(sensitivities(
        &system,
        (&prepared.terms, &prepared.selection),
        &beginning,
        (&names, order),
        (end, Output::Times(times.to_vec())),
    )?)
}

/// Comma-separated values with a header line.
pub fn to_csv(found: &Sensitivities) -> String {
    let mut text = format!("t,{}\n", found.columns().join(","));
    for (t, row) in &found.rows {
        let _ = write!(text, "{t:?}");
        for x in row {
            let _ = write!(text, ",{x:?}");
        }
        text.push('\n');
    }
    text
}

/// The linear equations along the motion of a model.
#[derive(Debug)]
pub struct AlongMotion {
    /// The name of the model.
    pub name: String,
    /// Names of the variables.
    pub variables: Vec<String>,
    /// What those are that are neither coordinates nor velocities.
    pub defined: Vec<String>,
    /// One for each time.
    pub rows: Vec<Along>,
}

/// Rows where nothing else is said.
const ROWS: f64 = 10.0;

/// The linear equations along the motion from the initial state, at eleven times.
///
/// # Errors
/// [`FollowError`].
pub fn along_motion(model: &Model) -> Result<AlongMotion, FollowError> {
    let (system, prepared) = of_motion(model, "linear equations along a motion")?;
    let options = StudyOptions::default();
    let data = initial_data(model, &system, &options)?;
    let point = initial((model, &system, &prepared), &options)?;
    let t = data.t;
    let end = settings(model, &system, t, &options)?.t_end;
    let of_flow = |flow: Flow| -> Result<AlongMotion, OrbitError> {
        let start = flow.state(&point)?;
        let output = Output::Every((end - t).abs() / ROWS);
        Ok(AlongMotion {
            rows: along(&flow, &start, (t, end), output)?,
            name: system.name.clone(),
            defined: flow.defined(),
            variables: flow.names,
        })
    };
    let (terms, selection) = (&prepared.terms, &prepared.selection);
    let all = Coordinates::NotIgnorable;
    let flow = Flow::of_system(&system, terms, selection, (all, &point[..]))?;
    match of_flow(flow) {
        // The independent velocities of the start do not serve to the end.
        Err(OrbitError::EndsEarly { .. }) => {
            let flow = Flow::in_all_velocities(&system, terms, selection, all)?;
            Ok(of_flow(flow)?)
        }
        other => Ok(other?),
    }
}

impl AlongMotion {
    /// State, matrix and exponents at each time.
    pub fn text(&self) -> String {
        let mut text = format!(
            "{}: z' = A(t) z along the motion with z = ({})\n",
            self.name,
            self.variables.join(", ")
        );
        for defined in &self.defined {
            let _ = writeln!(text, "{defined}");
        }
        let left_out = self.rows.first();
        let left_out = left_out.map_or(0, |own| own.admitted.nrows() - own.admitted.ncols());
        if left_out > 0 {
            let _ = writeln!(
                text,
                "Finite constraints bind these variables; exponents are those of the {} directions that are admissible.",
                self.variables.len() - left_out
            );
        }
        let start = self.rows.first().map_or(0.0, |own| own.t);
        for own in &self.rows {
            let state: Vec<String> = own.state.iter().map(|x| format!("{x:.6}")).collect();
            let _ = writeln!(text, "\nt = {}: z = ({})", own.t, state.join(", "));
            for row in own.matrix.row_iter() {
                let row: Vec<String> = row.iter().map(|x| format!("{x:14.6}")).collect();
                let _ = writeln!(text, "  {}", row.join(" "));
            }
            if let Some(exponents) = own.exponents(start) {
                let list: Vec<String> = exponents.iter().map(|x| format!("{x:.6}")).collect();
                let _ = writeln!(text, "  exponents from the start on: {}", list.join(", "));
            }
        }
        text
    }

    /// The same as JSON.
    pub fn json(&self) -> Value {
        let start = self.rows.first().map_or(0.0, |own| own.t);
        let rows = self.rows.iter().map(|own| {
            let matrix = |m: &dyn Fn(usize, usize) -> f64| -> Vec<Vec<f64>> {
                let n = self.variables.len();
                (0..n).map(|r| (0..n).map(|c| m(r, c)).collect()).collect()
            };
            json!({
                "t": own.t,
                "state": own.state,
                "A": matrix(&|r, c| own.matrix[(r, c)]),
                "transition": matrix(&|r, c| own.transition[(r, c)]),
                "exponents": own.exponents(start),
            })
        });
        json!({"system": self.name, "variables": self.variables, "rows": rows.collect::<Vec<_>>()})
    }
}
