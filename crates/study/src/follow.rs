//! Steady motions and periodic orbits over a range of a parameter: `chetaev follow`.
//!
//! Everything here is numerical; [`crate::stability`] proves where it can.
#![allow(
    clippy::result_large_err,
    reason = "an error is made once, and told at once"
)]

mod plot;
pub(crate) mod text;

pub(crate) use text::hopf;

use crate::options::StudyOptions;
use crate::stability::{motions, range, Range, StabilityError};
use crate::start;
use crate::start::initial_data;
use crate::StudyError;
use chetaev_mechanics::characteristics::CharacteristicsError;
use chetaev_mechanics::{Prepared, SteadyMotion, System, SystemError};
use chetaev_model::Model;
use chetaev_motion::{consistent_state, Binding, NumericError, NumericSystem};
use chetaev_orbits::branch::{Branch, End, Equations, Point};
use chetaev_orbits::continuation::{self, Pace};
use chetaev_orbits::equilibria::Equilibria;
use chetaev_orbits::flow::Coordinates;
use chetaev_orbits::periodic::{arrival, period_guess, Shooting};
use chetaev_orbits::solution::solution;
use chetaev_orbits::{Flow, OrbitError};
use chetaev_stability::guess::near;
use chetaev_stability::problem::LinearizationError;
use chetaev_stability::steady::numbers;
use chetaev_stability::steady_set::steady_set;
use chetaev_symbolic::{Expr, Symbol};
use std::borrow::Cow;

/// What is followed.
#[derive(Clone, Copy, Debug, Default)]
pub struct Wanted<'a> {
    /// A motion that the model names, the number of one that was found, `rest` or `start`; for orbits a state near them.
    pub about: Option<&'a str>,
    /// `NAME=FROM:TO`; without it only the motion at the values of the model is found.
    pub over: Option<&'a str>,
    /// Whether periodic orbits are followed, and not steady motions.
    pub orbit: bool,
    /// The period, or a guess of it where the equations do not contain the time.
    pub period: Option<&'a str>,
    /// At most so many points on each side of the start.
    pub points: Option<usize>,
    /// The longest step along the curve, the range and the size of the state being of length 1.
    pub step: Option<f64>,
}

/// Why nothing was followed.
#[derive(Debug, thiserror::Error)]
pub enum FollowError {
    /// The model is no system.
    #[error(transparent)]
    System(#[from] SystemError),
    /// No admissible state.
    #[error(transparent)]
    Characteristics(#[from] CharacteristicsError),
    /// Which motion, or which range.
    #[error(transparent)]
    Which(#[from] StabilityError),
    /// The velocities of the motion.
    #[error(transparent)]
    Motion(#[from] LinearizationError),
    /// No start.
    #[error(transparent)]
    Start(#[from] StudyError),
    /// A number is missing.
    #[error(transparent)]
    Numeric(#[from] NumericError),
    /// The motion was not followed.
    #[error(transparent)]
    Orbit(#[from] OrbitError),
    /// A motion that goes on along other components of the constraints.
    #[error("the linear equations are those along one component of the constraints; leave `crossings` out of [simulation], and end the run where components meet")]
    Crossings,
    /// Constraints that are not on velocities.
    #[error("{what} are computed for constraints on velocities; this system has constraints of order {order}")]
    HigherOrder {
        /// What was asked for.
        what: &'static str,
        /// m.
        order: u32,
    },
    /// A step that is none.
    #[error("a step along the curve lies between 0 and 1, of which 1 is the whole range; {step} does not")]
    Step {
        /// What was given.
        step: f64,
    },
    /// A parameter on which the equations do not depend.
    #[error("`{name}` does not occur in the equations of motion: where it names the members of a family of steady motions, `chetaev stability --over {name}=...` says from which on they are stable")]
    OfFamily {
        /// The parameter.
        name: String,
    },
}

/// What was followed.
#[derive(Debug)]
pub struct Followed {
    /// The name of the model.
    pub name: String,
    /// The name of the motion at which it began.
    pub about: String,
    /// Names of the variables; of orbits those of their starts.
    pub variables: Vec<String>,
    /// What variables are that are neither coordinates nor velocities.
    pub defined: Vec<String>,
    /// Coordinates on which nothing depends.
    pub ignorable: Vec<String>,
    /// Whether it is a curve of orbits.
    pub is_orbit: bool,
    /// The period at each point, of orbits.
    pub periods: Vec<f64>,
    /// The range, where there is one.
    pub range: Option<Range>,
    /// The curve, or one point.
    pub branch: Branch,
}

/// A motion over a range of a parameter.
///
/// # Errors
/// [`FollowError`].
pub fn follow(model: &Model, wanted: &Wanted<'_>) -> Result<Followed, FollowError> {
    let mut system = System::from_model(model)?;
    let zero = system.graph.zero();
    for control in &mut system.controls {
        control.law.get_or_insert(zero);
    }
    let prepared = start::prepared(model, &system)?;
    if wanted.orbit {
        on_velocities(&prepared, "periodic orbits")?;
    }
    let range = wanted.over.map(|text| range(model, text)).transpose()?;
    let (about, point) = state(model, &system, &prepared, wanted)?;
    let (terms, selection) = (&prepared.terms, &prepared.selection);
    let own = Begun {
        model,
        system: &system,
        about,
        range,
        point,
    };
    let kept = Coordinates::NotIgnorable;
    let flow = Flow::of_system(&system, terms, selection, (kept, &own.point[..]))?;
    match own.follow(&flow, wanted) {
        // The independent velocities of the start do not serve all along the orbit.
        Err(FollowError::Orbit(OrbitError::EndsEarly { .. })) => {
            let flow = Flow::in_all_velocities(&system, terms, selection, kept)?;
            own.follow(&flow, wanted)
        }
        other => other,
    }
}

/// Refuses constraints of order two and more.
pub(crate) fn on_velocities(prepared: &Prepared, what: &'static str) -> Result<(), FollowError> {
    let order = prepared.terms.order;
    if order > 1 {
        return Err(FollowError::HigherOrder { what, order });
    }
    Ok(())
}

/// What is followed from where.
struct Begun<'a> {
    model: &'a Model,
    system: &'a System,
    about: String,
    range: Option<Range>,
    /// Coordinates, velocities and parameters.
    point: Vec<(Symbol, f64)>,
}

impl Begun<'_> {
    fn follow(&self, flow: &Flow, wanted: &Wanted<'_>) -> Result<Followed, FollowError> {
        let (model, system, range) = (self.model, self.system, self.range.as_ref());
        let parameter = range.map(|own| parameter(flow, own)).transpose()?;
        let period = wanted.period.map(|text| model.expression(text));
        let period = period.transpose().map_err(StabilityError::Expression)?;
        let period = period.map(|e| system.with_definitions(e));
        let start = flow.state(&self.point)?;
        let span = (range, pace(wanted)?);
        let units = flow.units_near(&start);
        let (own, start) = (flow.in_units(&units), units.packed(&start));
        let found = if wanted.orbit {
            orbits(&own, &start, (parameter, period), (model, system), span)
        } else {
            steady_motions(&own, &start, parameter, span).map(|found| (found, Vec::new()))
        };
        let (branch, periods) = found.map_err(|problem| match problem {
            FollowError::Orbit(problem) => units.restored_error(problem).into(),
            other => other,
        })?;
        let branch = branch.restored(&units, wanted.orbit);
        let symbols = system.coordinates.iter();
        let ignorable = symbols.filter(|c| !flow.variables.contains(&c.q_symbol));
        Ok(Followed {
            ignorable: ignorable.map(|c| c.name.clone()).collect(),
            defined: flow.defined(),
            name: system.name.clone(),
            about: self.about.clone(),
            variables: flow.names.clone(),
            is_orbit: wanted.orbit,
            periods,
            range: self.range.clone(),
            branch,
        })
    }
}

/// How far and how finely.
fn pace(wanted: &Wanted<'_>) -> Result<Pace, FollowError> {
    let usual = Pace::default();
    let step = wanted.step.unwrap_or(usual.step);
    if !(step > 0.0 && step <= 1.0) {
        return Err(FollowError::Step { step });
    }
    Ok(Pace {
        points: wanted.points.unwrap_or(usual.points),
        step,
    })
}

/// The parameter of a range, which must occur in the equations.
fn parameter(flow: &Flow, range: &Range) -> Result<Symbol, FollowError> {
    let name = range.name.clone();
    if flow.place(range.symbol).is_none() {
        let known = flow.parameters.iter();
        let known = known.map(|own| flow.graph.symbol_text(own.0)).collect();
        return Err(StabilityError::UnknownParameter { name, known }.into());
    }
    let all = [flow.rates.clone(), flow.finite.clone()].concat();
    if flow.graph.any_contains_any(&all, &[range.symbol]) {
        Ok(range.symbol)
    } else {
        Err(FollowError::OfFamily { name })
    }
}

/// Coordinates, velocities and parameters in numbers where the curve begins, with the name of the motion.
fn state(
    model: &Model,
    system: &System,
    prepared: &Prepared,
    wanted: &Wanted<'_>,
) -> Result<(String, Vec<(Symbol, f64)>), FollowError> {
    let values = system.parameter_values();
    let (terms, selection) = (&prepared.terms, &prepared.selection);
    let found = || steady_set(system, terms, selection, &values);
    // An orbit is not steady: it begins at the start where no motion is named.
    let about = match wanted.about {
        None if wanted.orbit => Some("start"),
        about => about,
    };
    let all = motions(model, system, about, &found)?;
    let Some(motion) = all.first() else {
        return Err(StabilityError::SeveralMotions { names: Vec::new() }.into());
    };
    if motion.name == "start" {
        let of = (model, system, prepared);
        return Ok((motion.name.clone(), initial(of, &StudyOptions::default())?));
    }
    // A guess that leads to no motion exactly is one for Newton's method.
    let meant = near(system, terms, selection, (motion, &values));
    let meant = meant.unwrap_or(Cow::Borrowed(motion));
    let point = of_motion(&meant, system, prepared, &values)?;
    Ok((motion.name.clone(), point))
}

/// A motion that is stated, in numbers.
pub(crate) fn of_motion(
    motion: &SteadyMotion,
    system: &System,
    prepared: &Prepared,
    values: &[(Expr, Expr)],
) -> Result<Vec<(Symbol, f64)>, FollowError> {
    let rows = (&prepared.selection.rows[..], values);
    Ok(numbers(motion, system, &prepared.terms, rows)?)
}

/// The consistent initial state.
pub(crate) fn initial(
    (model, system, prepared): (&Model, &System, &Prepared),
    options: &StudyOptions,
) -> Result<Vec<(Symbol, f64)>, FollowError> {
    let data = initial_data(model, system, options)?;
    let binding = Binding::new(system)?;
    let mut numeric = NumericSystem::new(system, &prepared.terms, &binding)?;
    let start = consistent_state(&mut numeric, &data).map_err(StudyError::from)?;
    let positions = system.coordinate_symbols().into_iter().zip(start.q);
    let velocities = system.velocity_symbols().into_iter().zip(start.v);
    let all = positions.chain(velocities).chain(binding.parameters);
    Ok(all.collect())
}

fn steady_motions(
    flow: &Flow,
    start: &[f64],
    parameter: Option<Symbol>,
    (range, pace): (Option<&Range>, Pace),
) -> Result<Branch, FollowError> {
    let mut equations = Equilibria::new(flow, parameter)?;
    let p = parameter.and_then(|s| flow.place(s));
    let p = p.map_or(0.0, |place| flow.parameters[place].1);
    curve(&mut equations, (start, p), range, pace)
}

/// Periodic orbits with their periods: near the start, or else near where the motion from it arrives, as it does at orbits that attract.
fn orbits(
    flow: &Flow,
    start: &[f64],
    (parameter, period): (Option<Symbol>, Option<Expr>),
    (model, system): (&Model, &System),
    (range, pace): (Option<&Range>, Pace),
) -> Result<(Branch, Vec<f64>), FollowError> {
    let mut equations = Shooting::new(flow, parameter, period)?;
    let value = |s: Symbol| flow.place(s).map(|place| flow.parameters[place].1);
    let rate = flow.units.rate;
    let given = match period {
        Some(e) => Some(guess(flow, e)? * rate),
        None => None,
    };
    let p = parameter.and_then(value).unwrap_or(0.0);
    let end = crate::start::settings(model, system, 0.0, &StudyOptions::default())?.t_end * rate;
    let mut near = |start: &[f64]| {
        let guess = given.map_or_else(|| period_guess(flow, start, end), Ok)?;
        let unknowns = equations.unknowns(start, guess);
        curve(&mut equations, (&unknowns, p), range, pace)
    };
    let found = match near(start) {
        Err(FollowError::Orbit(first)) if flow.is_autonomous() => {
            let arrived = arrival(flow, start, end);
            let other = arrived.map_err(FollowError::from);
            other.and_then(|state| near(&state)).map_err(|_| first)?
        }
        other => other?,
    };
    let period = |own: &Point| equations.period(&own.unknowns, own.parameter);
    let periods: Result<Vec<(f64, f64)>, OrbitError> = found.points.iter().map(period).collect();
    let periods = periods?.into_iter().map(|own| own.0 / rate);
    Ok((found, periods.collect()))
}

/// The value of a period.
fn guess(flow: &Flow, period: Expr) -> Result<f64, OrbitError> {
    let value = |s: Symbol| flow.place(s).map(|place| flow.parameters[place].1);
    let found = flow.graph.evaluate_f64(&[period], &value);
    found.map(|own| own[0]).map_err(|_| OrbitError::NoValue {
        name: "the period".into(),
    })
}

/// A curve over a range, or one point.
fn curve(
    equations: &mut dyn Equations,
    (start, p): (&[f64], f64),
    range: Option<&Range>,
    pace: Pace,
) -> Result<Branch, FollowError> {
    match range {
        Some(range) => {
            let ends = (range.low.to_f64().value(), range.high.to_f64().value());
            Ok(continuation::follow(equations, (start, p), ends, pace)?)
        }
        None => {
            let (point, family) = solution(equations, start, p)?;
            Ok(Branch {
                points: vec![point],
                special: Vec::new(),
                family,
                ends: [End::Points; 2],
            })
        }
    }
}
