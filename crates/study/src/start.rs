//! What is known before a run: numbers, consistent initial data, settings.

use crate::error::StudyError;
use crate::options::StudyOptions;
use crate::precise;
use chetaev_integrate::double_double::LEAST_TOLERANCE;
use chetaev_integrate::Direction;
use chetaev_mechanics::characteristics::CharacteristicsError;
use chetaev_mechanics::system::{Assumption, Relation};
use chetaev_mechanics::{multiplicity, Basis, MotionTerms, Prepared, Selection, System};
use chetaev_model::model::{EventStated, Model, Output, StateKind as ModelState, Zero};
use chetaev_motion::factors::has_components;
use chetaev_motion::initial::jets::{jet_start, JetData};
use chetaev_motion::run::equal_times;
use chetaev_motion::{
    consistent_state, Binding, Component, ConsistentState, EventWatched, InitialData, InitialError,
    NumericSystem, RunSettings, StateKind, Subject,
};
use chetaev_symbolic::{rational, Expr, Graph, Symbol};
use std::sync::Arc;

/// Everything numeric that is known before the run.
pub(crate) struct Start {
    pub(crate) binding: Binding,
    pub(crate) numeric: NumericSystem,
    pub(crate) start: ConsistentState,
    pub(crate) data: InitialData,
}

/// Why a system is studied without a motion.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub(crate) enum NoMotion {
    /// Something has no value.
    #[error(
        "no motion was computed: no value for {names}; give values in the model or with --set"
    )]
    NoValue {
        /// Names in quotes.
        names: String,
    },
    /// Nobody stated where it begins.
    #[error("no motion was computed, as it would begin where all coordinates and velocities are zero: {0}; state [initial] data")]
    AtZero(InitialError),
    /// The constraints determine none.
    #[error(transparent)]
    Constraints(CharacteristicsError),
    /// Derivatives of higher order are not determined.
    #[error("no motion was computed: {0}")]
    Undetermined(StudyError),
}

/// The start, or why there is none although nothing is wrong: the model does not ask for a motion.
pub(crate) fn start_of_motion(
    model: &Model,
    system: &System,
    terms: &MotionTerms,
    options: &StudyOptions,
) -> Result<Result<Start, NoMotion>, StudyError> {
    let symbolic = system.parameters.iter().any(|p| p.value.is_none())
        || system.controls.iter().any(|u| u.law.is_none());
    if symbolic {
        let names = open_names(system);
        return match asks_for_motion(model) && options.motion {
            true => Err(StudyError::MissingValues { names }),
            false => Ok(Err(NoMotion::NoValue { names })),
        };
    }
    let binding = Binding::new(system)?;
    let mut numeric = NumericSystem::new(system, terms, &binding)?;
    let data = initial_data(model, system, options)?;
    match consistent_state(&mut numeric, &data) {
        Ok(start) => {
            check_assumptions(system, &start)?;
            Ok(Ok(Start {
                binding,
                numeric,
                start,
                data,
            }))
        }
        Err(problem) if !asks_for_motion(model) && is_regular_elsewhere(&mut numeric, &data) => {
            Ok(Err(NoMotion::AtZero(problem)))
        }
        Err(problem) => Err(problem.into()),
    }
}

/// Terms and selection of the system of a model, which has motions. Where no state is found at random that satisfies the constraints, as those
/// of a linkage that is overconstrained, the one from which the model starts says which of them are independent.
///
/// # Errors
/// [`CharacteristicsError`] where the constraints hold with multiplicity, and when no admissible state is found.
pub fn prepared(model: &Model, system: &System) -> Result<Prepared, CharacteristicsError> {
    let problem = match multiplicity::prepared(system) {
        Err(problem @ CharacteristicsError::NoAdmissibleState { .. }) => problem,
        found => return found,
    };
    let terms = MotionTerms::new(system);
    match start_of_motion(model, system, &terms, &StudyOptions::default()) {
        Ok(Ok(found)) if terms.order == 1 => Ok(Prepared {
            terms,
            selection: found.selection(),
            degenerate: None,
        }),
        _ => Err(problem),
    }
}

/// A system on the component of its constraints on which the motion of a model starts; as it is where no constraint is a product.
///
/// # Errors
/// [`StudyError`] where something has no value, or no state satisfies the constraints.
pub(crate) fn on_component(
    model: &Model,
    (system, prepared): (System, Prepared),
) -> Result<(System, Prepared), StudyError> {
    if !has_components(&system) {
        return Ok((system, prepared));
    }
    let options = StudyOptions::default();
    let Ok(found) = start_of_motion(model, &system, &prepared.terms, &options)? else {
        return Ok((system, prepared));
    };
    let subject = Subject {
        system: &system,
        terms: &prepared.terms,
        selection: &prepared.selection,
        binding: &found.binding,
        numeric: &found.numeric,
        start: &found.start,
        factors: &[],
    };
    let Some(component) = Component::of_start(&subject) else {
        return Ok((system, prepared));
    };
    let (system, terms, selection) = component.into_system();
    let prepared = Prepared {
        terms,
        selection,
        ..prepared
    };
    Ok((system, prepared))
}

impl Start {
    /// The constraints that are independent there, and velocities to solve them for.
    pub(crate) fn selection(&self) -> Selection {
        let chart = &self.start.chart;
        Selection {
            rows: chart.rows.clone(),
            dependent: chart.dependent.clone(),
        }
    }
}

/// Whether motions can begin at other states than the one that nobody asked for.
fn is_regular_elsewhere(numeric: &mut NumericSystem, data: &InitialData) -> bool {
    let spread = |i: usize, least: f64| least + 0.37 * ((i + 1) as f64).sin().abs();
    let elsewhere = InitialData {
        q: (0..data.q.len())
            .map(|i| match i < data.q_fixed.len() {
                true => spread(i, 0.4),
                // A mass with a law of its own has its initial value.
                false => data.q[i],
            })
            .collect(),
        v: (0..data.v.len()).map(|i| spread(i, 0.5)).collect(),
        project: true,
        ..data.clone()
    };
    consistent_state(numeric, &elsewhere).is_ok()
}

/// The consistent state from which the motion of a model starts.
#[derive(Clone, Debug, PartialEq)]
pub struct StartState {
    /// The time.
    pub t: f64,
    /// Coordinates, masses with a law of their own, velocities, in this order.
    pub state: Vec<(Symbol, f64)>,
    /// What the state has beside these where constraints are of order two and more: accelerations, multipliers.
    pub beyond: Vec<(Symbol, f64)>,
}

/// The state from which `simulate` starts a motion: what the model gives, with the rest from the constraints. Controls without a law do not
/// matter for it where no constraint contains them.
///
/// # Errors
/// [`StudyError`] where something has no value, or no state satisfies the constraints.
pub fn start_state(
    model: &Model,
    system: &System,
    chosen: (&MotionTerms, &Selection),
) -> Result<StartState, StudyError> {
    let own = without_open_controls(system, chosen.0);
    if system.parameters.iter().any(|p| p.value.is_none())
        || own.controls.iter().any(|u| u.law.is_none())
    {
        let names = open_names(&own);
        return Err(StudyError::MissingValues { names });
    }
    let options = StudyOptions::default();
    let binding = Binding::new(&own)?;
    let mut numeric = NumericSystem::new(&own, chosen.0, &binding)?;
    let data = initial_data(model, &own, &options)?;
    let start = consistent_state(&mut numeric, &data)?;
    let mut found = Start {
        binding,
        numeric,
        start,
        data,
    };
    if chosen.0.order > 1 {
        add_jets(model, &own, chosen, &mut found, &options)?;
    }
    let at = found.start;
    let values = at.q.iter().chain(&at.v).copied();
    Ok(StartState {
        t: at.t,
        state: found.binding.variables[1..]
            .iter()
            .copied()
            .zip(values)
            .collect(),
        beyond: at.jets.map(|jets| jets.values).unwrap_or_default(),
    })
}

/// The system with zero in the place of controls that have no law and that no constraint contains: they do not matter for a start.
pub(crate) fn without_open_controls(system: &System, terms: &MotionTerms) -> System {
    let mut own = system.clone();
    let g = &system.graph;
    let constrained = g.symbols_in(&terms.constraints);
    let acts = |name: &str| constrained.iter().any(|&s| g.symbol_name(s) == name);
    let open = own.controls.iter_mut().filter(|u| u.law.is_none());
    for control in open.filter(|u| !acts(&u.name)) {
        control.law = Some(g.zero());
    }
    own
}

/// Initial data or a time span say that a motion is wanted.
pub(crate) fn asks_for_motion(model: &Model) -> bool {
    let s = &model.simulation;
    !model.initial.values.is_empty() || s.t_end.is_some() || s.output.is_some()
}

/// Parameters and controls without a value, in quotes.
fn open_names(system: &System) -> String {
    let parameters = system.parameters.iter().filter(|p| p.value.is_none());
    let controls = system.controls.iter().filter(|u| u.law.is_none());
    let names: Vec<String> = parameters
        .map(|p| format!("`{}`", p.name))
        .chain(controls.map(|u| format!("the control `{}`", u.name)))
        .collect();
    names.join(", ")
}

/// The initial state lies where the model says that motions are.
fn check_assumptions(system: &System, start: &ConsistentState) -> Result<(), StudyError> {
    let g = &system.graph;
    let parameters = system.parameter_values();
    let value = |s| of_start(system, s, start);
    for assumption in &system.assumptions {
        let sides = g.substitute_all(&[assumption.left, assumption.right], &parameters);
        // What is free of the state has been compared by the model.
        if !g.symbols_in(&sides).is_empty() {
            check_assumption(g, assumption, &sides, &value)?;
        }
    }
    Ok(())
}

/// The assumption with these sides holds at the values given; sides that cannot be evaluated are not compared.
pub(crate) fn check_assumption(
    g: &Graph,
    assumption: &Assumption,
    sides: &[Expr],
    value: &dyn Fn(Symbol) -> Option<f64>,
) -> Result<(), StudyError> {
    match g.evaluate_f64(sides, value) {
        Ok(sides) if !holds(assumption.relation, sides[1] - sides[0]) => {
            Err(StudyError::Assumption {
                text: assumption.text.clone(),
                left: sides[0],
                right: sides[1],
            })
        }
        _ => Ok(()),
    }
}

/// The value of a symbol of a state.
pub(crate) fn of_start(system: &System, symbol: Symbol, start: &ConsistentState) -> Option<f64> {
    let g = &system.graph;
    let (name, order) = (g.symbol_name(symbol), g.symbol_order(symbol));
    match (system.coordinate_index(name), order) {
        (Some(i), 0) => Some(start.q[i]),
        (Some(i), 1) => Some(start.v[i]),
        (None, 0) if name == "t" => Some(start.t),
        (None, 0) => {
            let masses = system.masses.iter().zip(&start.q[system.n()..]);
            let mut own = masses.filter(|(m, _)| m.name == name);
            own.next().map(|(_, &value)| value)
        }
        _ => None,
    }
}

/// Whether right − left satisfies the relation, up to rounding for relations that are not strict.
pub(crate) fn holds(relation: Relation, difference: f64) -> bool {
    match relation {
        Relation::Less => difference > 0.0,
        Relation::LessOrEqual => difference >= -1e-12,
        Relation::NotEqual => difference != 0.0,
    }
}

/// The start has the rank that almost all admissible states have.
pub(crate) fn check_rank(start: &Start, generic: usize) -> Result<(), StudyError> {
    let rank = start.start.chart.rank();
    if rank >= generic {
        return Ok(());
    }
    let names: Vec<String> = start
        .numeric
        .constraints
        .iter()
        .map(|name| format!("`{name}`"))
        .collect();
    Err(StudyError::RankDeficient {
        names: names.join(", "),
        rank,
        generic,
    })
}

/// The value of an expression without moving symbols.
pub(crate) fn number(g: &Graph, e: Expr, values: &[(Expr, Expr)]) -> Option<f64> {
    let closed = g.substitute(e, values);
    let value = g.evaluate_f64(&[closed], &|_| None).ok()?[0];
    value.is_finite().then_some(value)
}

pub(crate) fn initial_data(
    model: &Model,
    system: &System,
    options: &StudyOptions,
) -> Result<InitialData, StudyError> {
    let n = system.n();
    let values = system.parameter_values();
    let g = &model.graph;
    let mut q = vec![0.0; n];
    q.extend(initial_masses(model, system)?);
    let mut data = InitialData {
        t: model
            .simulation
            .t_start
            .and_then(|t| number(g, t, &values))
            .unwrap_or(0.0),
        q,
        v: vec![0.0; n],
        q_fixed: vec![false; n],
        v_fixed: vec![false; n],
        project: options.project || model.initial.project,
    };
    for (&(i, order), given) in &model.initial.values {
        let name = || {
            format!(
                "{}{}",
                model.coordinates[i].name,
                "'".repeat(order as usize)
            )
        };
        let value = number(g, given.value, &values)
            .ok_or_else(|| StudyError::InitialValue { name: name() })?;
        match order {
            0 => (data.q[i], data.q_fixed[i]) = (value, !given.is_guess),
            1 => (data.v[i], data.v_fixed[i]) = (value, !given.is_guess),
            _ if system.order() > 1 && order <= system.order() => {}
            _ => return Err(StudyError::UnusedInitialValue { name: name() }),
        }
    }
    Ok(data)
}

/// What is known of the start beyond coordinates and velocities, for constraints of order two and more.
pub(crate) fn add_jets(
    model: &Model,
    system: &System,
    (terms, selection): (&MotionTerms, &Selection),
    start: &mut Start,
    options: &StudyOptions,
) -> Result<(), StudyError> {
    let (g, values) = (&model.graph, system.parameter_values());
    let mut data = JetData {
        branch: options.branch.or(model.initial.branch),
        project: start.data.project,
        ..JetData::default()
    };
    for (&(i, order), given) in model.initial.values.iter().filter(|((_, m), _)| *m > 1) {
        let symbol = g.intern_symbol(&model.coordinates[i].name, order);
        let value = number(g, given.value, &values).ok_or_else(|| StudyError::InitialValue {
            name: g.symbol_text(symbol),
        })?;
        data.given.push((symbol, value));
    }
    for own in &model.initial.extra {
        let symbol = g.intern_symbol(&own.name, own.order);
        let value = number(g, own.value, &values).ok_or_else(|| StudyError::InitialValue {
            name: g.symbol_text(symbol),
        })?;
        data.given.push((symbol, value));
    }
    let basis = Basis {
        system,
        terms,
        selection,
        characteristics: None,
    };
    let at = &start.start;
    let jets = jet_start(&basis, &start.binding, (at.t, &at.q, &at.v), &data)?;
    start.start.jets = Some(jets);
    Ok(())
}

/// The masses with a law of their own at the start.
fn initial_masses(model: &Model, system: &System) -> Result<Vec<f64>, StudyError> {
    let values = system.parameter_values();
    let start = |name: &str| {
        let initial = model.initial_mass(name)?;
        number(&model.graph, initial, &values)
    };
    let masses = system.masses.iter();
    masses
        .map(|m| {
            let name = m.name.clone();
            start(&m.name).ok_or(StudyError::InitialValue { name })
        })
        .collect()
}

/// Initial values of what is no coordinate, such as `kappa_NAME`.
pub(crate) fn own_values(model: &Model, system: &System) -> Result<Vec<(String, f64)>, StudyError> {
    let values = system.parameter_values();
    let extra = model.initial.extra.iter().filter(|own| own.order == 0);
    extra
        .map(|own| {
            let value = number(&model.graph, own.value, &values);
            let value = value.ok_or_else(|| StudyError::MissingValues {
                names: format!("what the initial value of `{}` is made of", own.name),
            })?;
            Ok((own.name.clone(), value))
        })
        .collect()
}

/// How the motion is computed: options, else the model, else the program decides.
pub(crate) fn settings(
    model: &Model,
    system: &System,
    t_start: f64,
    options: &StudyOptions,
) -> Result<RunSettings, StudyError> {
    let values = system.parameter_values();
    let g = &model.graph;
    let simulation = &model.simulation;
    let t_end = options
        .t_end
        .or_else(|| simulation.t_end.and_then(|t| number(g, t, &values)))
        .unwrap_or(t_start + 10.0);
    let mut settings = RunSettings::new(t_start, t_end);
    let stated = simulation.tolerance.as_ref().map(rational::to_f64);
    settings.tolerance = options.tolerance.or(stated).unwrap_or(1e-10);
    settings.absolute_tolerance = simulation
        .absolute_tolerance
        .as_ref()
        .map_or(settings.tolerance, rational::to_f64);
    settings.is_natural = simulation.absolute_tolerance.is_none();
    let is_precise = precise::is_asked(model, options);
    settings.method = match options.method.as_ref().or(simulation.method.as_ref()) {
        Some(method) => method_name(method),
        None if is_precise => "taylor".into(),
        None => settings.method,
    };
    if is_precise && settings.method != "taylor" {
        let method = settings.method;
        return Err(StudyError::PrecisionMethod { method });
    }
    let sharpest = match is_precise {
        true => LEAST_TOLERANCE,
        false => sharpest(&settings.method),
    };
    let tolerance = settings.tolerance;
    if !(sharpest..=LOOSEST).contains(&tolerance) {
        return Err(if is_precise {
            StudyError::PreciseTolerance {
                tolerance,
                sharpest,
            }
        } else {
            StudyError::Tolerance {
                tolerance,
                sharpest,
            }
        });
    }
    // An absolute tolerance has the unit of what it is for: no number is too small for it.
    let absolute = settings.absolute_tolerance;
    if !(absolute > 0.0 && absolute.is_finite()) {
        return Err(StudyError::AbsoluteTolerance);
    }
    let step = simulation.step.and_then(|h| number(g, h, &values));
    settings.step = options.step.or(step);
    if settings.step.is_some_and(|h| h <= 0.0 || !h.is_finite()) {
        return Err(StudyError::Step);
    }
    settings.times = output_times(model, &values, t_start, t_end)?;
    settings.crossings.clone_from(&simulation.crossings);
    settings.max_steps = simulation.max_steps.unwrap_or(settings.max_steps);
    settings.state = simulation.state.map(|state| match state {
        ModelState::Full => StateKind::Full,
        ModelState::Reduced => StateKind::Reduced,
    });
    settings.project = simulation.project.unwrap_or(true);
    settings.own = own_values(model, system)?;
    settings.events = model.events.iter().map(event).collect();
    settings.follow = vec![system.energy()];
    settings
        .follow
        .extend(model.integrals.iter().map(|i| i.value));
    if is_precise {
        let numbers = precise::precise(model, system, options, &settings)?;
        settings.precise = Some(Arc::new(numbers));
    }
    Ok(settings)
}

fn event(stated: &EventStated) -> EventWatched {
    EventWatched {
        name: stated.name.clone(),
        value: stated.value,
        direction: match stated.zero {
            Zero::Rising => Direction::Up,
            Zero::Falling => Direction::Down,
            Zero::Both => Direction::Both,
        },
        stops: stated.stops,
    }
}

/// Tolerances that double precision and the error bounds of the verdicts make sense of: the error estimate of a
/// Runge–Kutta method is a difference of nearly equal numbers, the terms of a series are not.
const SHARPEST: f64 = 2.3e-14;
const SHARPEST_OF_SERIES: f64 = 2.3e-16;
const LOOSEST: f64 = 0.1;

/// The sharpest tolerance of a method.
pub(crate) fn sharpest(method: &str) -> f64 {
    let needs_series = |m: &dyn chetaev_integrate::Method| m.card().needs_series;
    match chetaev_integrate::method(method).is_ok_and(needs_series) {
        true => SHARPEST_OF_SERIES,
        false => SHARPEST,
    }
}
/// More rows than these no longer fit what is done with them.
const MOST_ROWS: f64 = 1e6;

fn output_times(
    model: &Model,
    values: &[(Expr, Expr)],
    t_start: f64,
    t_end: f64,
) -> Result<Vec<f64>, StudyError> {
    let g = &model.graph;
    let rows = |rows: f64| match rows <= MOST_ROWS {
        true => Ok(()),
        false => Err(StudyError::TooManyRows {
            rows,
            most: MOST_ROWS,
        }),
    };
    match &model.simulation.output {
        Some(Output::Points(points)) => {
            rows(f64::from(*points))?;
            Ok(equal_times(t_start, t_end, *points))
        }
        Some(Output::Times(times)) => {
            let times: Vec<f64> = times.iter().filter_map(|&t| number(g, t, values)).collect();
            let forward = if t_end < t_start { -1.0 } else { 1.0 };
            let ordered = times.windows(2).all(|w| (w[1] - w[0]) * forward > 0.0);
            let (low, high) = (t_start.min(t_end), t_start.max(t_end));
            match times.iter().find(|&&t| t < low || t > high) {
                _ if !ordered => Err(StudyError::OutputOrder),
                Some(&t) => Err(StudyError::OutputTime { t, t_start, t_end }),
                None => Ok(times),
            }
        }
        Some(Output::Step(step)) => match number(g, *step, values) {
            Some(dt) if dt > 0.0 => {
                rows((t_end - t_start).abs() / dt)?;
                Ok(stepped_times(t_start, t_end, dt))
            }
            _ => Err(StudyError::OutputStep),
        },
        None => Ok(equal_times(t_start, t_end, 500)),
    }
}

/// `t_start + j dt`.
fn stepped_times(t_start: f64, t_end: f64, dt: f64) -> Vec<f64> {
    let count = ((t_end - t_start).abs() / dt + 1e-9).floor() as u32;
    let direction = if t_end < t_start { -dt } else { dt };
    (0..=count)
        .map(|j| t_start + f64::from(j) * direction)
        .collect()
}

/// Short names of methods as people write them.
fn method_name(name: &str) -> String {
    match name.to_ascii_lowercase().as_str() {
        "dop853" | "dormand-prince" => "dormand-prince-853".into(),
        "tsit5" | "tsitouras" => "tsitouras-5".into(),
        "rk4" => "runge-kutta-4".into(),
        other => other.into(),
    }
}
