//! One model through its claims and its motion.

use crate::motion_claims::MotionEvidence;
use crate::options::{Hooks, StudyOptions};
use crate::registry::registry;
use chetaev_integrate::Progress;
use chetaev_mechanics::characteristics::{CharacteristicsError, Selection};
use chetaev_mechanics::claims::full_id;
use chetaev_mechanics::{Context, Finding, Group, Prepared, Prover, System, SystemError};
use chetaev_model::model::{Model, Output, StateKind as ModelState};
use chetaev_motion::run::equal_times;
use chetaev_motion::{
    consistent_state, Binding, ConsistentState, InitialData, InitialError, NumericError,
    NumericSystem, Run, RunError, RunSettings, StateKind, Subject, Watcher,
};
use chetaev_symbolic::{rational, Expr, Graph, Verdict};
use std::ops::ControlFlow;
use std::sync::Arc;

/// A claim with its verdict.
#[derive(Clone, Debug)]
pub struct Decided {
    /// Id without subject.
    pub claim: &'static str,
    /// Subject.
    pub subject: Option<String>,
    /// Title for people.
    pub title: &'static str,
    /// Group.
    pub group: Group,
    /// Hypotheses.
    pub requires: Vec<String>,
    /// Verdict and formulas.
    pub finding: Arc<Finding>,
    /// Seconds spent.
    pub seconds: f64,
    /// Verdicts the model accepts, if it expects any.
    pub expected: Vec<String>,
}

impl Decided {
    /// `id#subject`.
    pub fn full_id(&self) -> String {
        full_id(self.claim, self.subject.as_deref())
    }

    /// Whether the model's expectation is met; true when it has none.
    pub fn is_as_expected(&self) -> bool {
        self.expected.is_empty()
            || self
                .expected
                .iter()
                .any(|w| w == self.finding.verdict.word())
    }
}

/// A computed motion with what is known about it.
#[derive(Debug)]
pub struct Motion {
    /// The start.
    pub start: ConsistentState,
    /// How it was run.
    pub settings: RunSettings,
    /// Parameter values.
    pub binding: Binding,
    /// The trajectory and its evidence.
    pub evidence: Arc<MotionEvidence>,
}

/// The result of a study.
#[derive(Debug)]
pub struct Study {
    /// The model.
    pub model: Model,
    /// The system.
    pub system: System,
    /// Terms and selection.
    pub prepared: Prepared,
    /// Verdicts in the order decided.
    pub verdicts: Vec<Decided>,
    /// The motion, when one was computed.
    pub motion: Option<Motion>,
    /// Things a reader must know: redundant constraints, why there is no motion, …
    pub notices: Vec<String>,
    /// How it ended.
    pub outcome: Outcome,
    /// Options used.
    pub options: StudyOptions,
}

/// How a study ended; the exit status of the command line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// Everything as asked.
    Done,
    /// A declared expectation is not met.
    Unmet,
    /// The run stopped early or was interrupted.
    Stopped,
}

impl Outcome {
    /// The documented exit status.
    pub fn exit_status(self) -> u8 {
        match self {
            Outcome::Done => 0,
            Outcome::Unmet => 1,
            Outcome::Stopped => 3,
        }
    }
}

/// The input is wrong; exit status 2.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StudyError {
    /// No system.
    #[error(transparent)]
    System(#[from] SystemError),
    /// No characteristics.
    #[error(transparent)]
    Characteristics(#[from] CharacteristicsError),
    /// Numbers are missing.
    #[error(transparent)]
    Numeric(#[from] NumericError),
    /// The initial state cannot be used.
    #[error(transparent)]
    Initial(#[from] InitialError),
    /// The run cannot begin.
    #[error(transparent)]
    Run(#[from] RunError),
    /// An initial value is not a number.
    #[error("the initial value of `{name}` is not a finite number")]
    InitialValue {
        /// Name with primes.
        name: String,
    },
    /// A formulation that cannot be integrated.
    #[error("there is no formulation `{name}` to integrate; choose one of {known}")]
    UnknownFormulation {
        /// As given.
        name: String,
        /// Names.
        known: String,
    },
    /// Initial data of a kind the first-order theory has no use for.
    #[error("the initial value of `{name}` is not used: a first-order system is determined by coordinates and velocities")]
    UnusedInitialValue {
        /// Name with primes.
        name: String,
    },
}

/// Formulations that can be integrated by themselves.
pub const INTEGRABLE: &[&str] = &["routh", "maggi"];

/// Takes a model through its claims and its motion.
///
/// # Errors
/// [`StudyError`] when the input is wrong in a way that leaves nothing to study.
pub fn study(
    model: Model,
    options: StudyOptions,
    hooks: &mut Hooks<'_>,
) -> Result<Study, StudyError> {
    let system = System::from_model(&model)?;
    (hooks.progress)("deriving", None);
    let terms = chetaev_mechanics::MotionTerms::new(&system);
    let numeric = start_of_motion(&model, &system, &terms, &options)?;
    let selection = match chetaev_mechanics::characteristics::select(&system, &terms) {
        Ok(selection) => selection,
        Err(error) => match &numeric {
            Some(n) => Selection {
                rows: n.start.chart.rows.clone(),
                dependent: n.start.chart.dependent.clone(),
            },
            None => return Err(error.into()),
        },
    };
    let prepared = Prepared { terms, selection };
    let mut notices = notices(&model, &system, numeric.as_ref());
    let known = registry();
    let wants_motion = options.motion && options.claims.wants_group(Group::Motion, known.claims());
    let motion = match numeric {
        Some(numeric) if wants_motion => Some(compute(
            &model, &system, &prepared, numeric, &options, hooks,
        )?),
        Some(_) => None,
        None => {
            notices.push(no_motion(&model, &system));
            None
        }
    };
    let verdicts = decide(&model, &system, &prepared, motion.as_ref(), &options, hooks);
    let outcome = outcome(&model, &verdicts, motion.as_ref());
    Ok(Study {
        model,
        system,
        prepared,
        verdicts,
        motion,
        notices,
        outcome,
        options,
    })
}

/// Everything numeric that is known before the run.
struct Start {
    binding: Binding,
    numeric: NumericSystem,
    start: ConsistentState,
    data: InitialData,
}

fn start_of_motion(
    model: &Model,
    system: &System,
    terms: &chetaev_mechanics::MotionTerms,
    options: &StudyOptions,
) -> Result<Option<Start>, StudyError> {
    let symbolic = system.parameters.iter().any(|p| p.value.is_none())
        || system.controls.iter().any(|u| u.law.is_none());
    let higher = system.constraints.iter().any(|c| c.order > 1);
    if symbolic || higher {
        return Ok(None);
    }
    let binding = Binding::new(system)?;
    let mut numeric = NumericSystem::new(system, terms, &binding)?;
    let data = initial_data(model, system, options)?;
    let start = consistent_state(&mut numeric, &data)?;
    Ok(Some(Start {
        binding,
        numeric,
        start,
        data,
    }))
}

fn no_motion(model: &Model, system: &System) -> String {
    if let Some(c) = system.constraints.iter().find(|c| c.order > 1) {
        return format!(
            "no motion was computed: constraint `{}` is of order {}; constraints of higher order are classified, their dynamics is not built in yet",
            c.name, c.order
        );
    }
    let open: Vec<&str> = model
        .parameters
        .iter()
        .filter(|p| p.value.is_none())
        .map(|p| p.name.as_str())
        .collect();
    if open.is_empty() {
        "no motion was computed: a control has no law".into()
    } else {
        format!(
            "no motion was computed: no value for {}; give values in the model or with --set",
            open.join(", ")
        )
    }
}

fn notices(model: &Model, system: &System, start: Option<&Start>) -> Vec<String> {
    let mut notices = Vec::new();
    for constraint in &system.constraints {
        if constraint.order == 0 {
            notices.push(format!(
                "constraint `{}` contains no velocities: it is taken as holonomic, {} is kept on the initial level and differentiated once for the reaction",
                constraint.name,
                model.graph.text(constraint.stated)
            ));
        }
    }
    let Some(start) = start else { return notices };
    if !start.start.redundant.is_empty() {
        let names: Vec<String> = start
            .start
            .redundant
            .iter()
            .map(|n| format!("`{n}`"))
            .collect();
        notices.push(format!(
            "redundant constraints: {} depend{} on the others at the initial state (rank {} of {}); motion and reactions are unique, the single multipliers are not, and those of the constraints left out are given as zero",
            names.join(", "),
            if names.len() == 1 { "s" } else { "" },
            start.start.chart.rank(),
            start.numeric.r,
        ));
    }
    let free: Vec<String> = start
        .start
        .completed
        .iter()
        .map(|(name, value)| format!("{name} = {value}"))
        .collect();
    if !free.is_empty() {
        let how = if start.data.project {
            "projected on"
        } else {
            "completed from"
        };
        notices.push(format!(
            "initial data {how} the constraints: {}",
            free.join(", ")
        ));
    }
    notices
}

/// The value of an expression without moving symbols.
pub(crate) fn number(g: &Graph, e: Expr, values: &[(Expr, Expr)]) -> Option<f64> {
    let closed = g.substitute(e, values);
    let value = g.evaluate_f64(&[closed], &|_| None).ok()?[0];
    value.is_finite().then_some(value)
}

fn initial_data(
    model: &Model,
    system: &System,
    options: &StudyOptions,
) -> Result<InitialData, StudyError> {
    let n = system.n();
    let values = system.parameter_values();
    let g = &model.graph;
    let mut data = InitialData {
        t: model
            .simulation
            .t_start
            .and_then(|t| number(g, t, &values))
            .unwrap_or(0.0),
        q: vec![0.0; n],
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
            0 => (data.q[i], data.q_fixed[i]) = (value, true),
            1 => (data.v[i], data.v_fixed[i]) = (value, true),
            _ => return Err(StudyError::UnusedInitialValue { name: name() }),
        }
    }
    Ok(data)
}

fn settings(model: &Model, system: &System, t_start: f64, options: &StudyOptions) -> RunSettings {
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
    if let Some(method) = options.method.as_ref().or(simulation.method.as_ref()) {
        settings.method = method_name(method);
    }
    settings.times = match &simulation.output {
        Some(Output::Points(points)) => equal_times(t_start, t_end, *points),
        Some(Output::Times(times)) => times
            .iter()
            .filter_map(|&t| number(g, t, &values))
            .filter(|&t| (t >= t_start && t <= t_end) || (t <= t_start && t >= t_end))
            .collect(),
        Some(Output::Step(step)) => match number(g, *step, &values) {
            Some(dt) if dt > 0.0 => stepped_times(t_start, t_end, dt),
            _ => equal_times(t_start, t_end, 500),
        },
        None => equal_times(t_start, t_end, 500),
    };
    settings.max_steps = simulation.max_steps.unwrap_or(settings.max_steps);
    settings.state = match simulation.state {
        Some(ModelState::Full) => StateKind::Full,
        _ => StateKind::Reduced,
    };
    settings.project = simulation.project.unwrap_or(true);
    settings
}

/// `t_start + j dt`, at most a million of them.
fn stepped_times(t_start: f64, t_end: f64, dt: f64) -> Vec<f64> {
    let count = ((t_end - t_start).abs() / dt + 1e-9).floor().min(1e6) as u32;
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

fn compute(
    model: &Model,
    system: &System,
    prepared: &Prepared,
    numeric: Start,
    options: &StudyOptions,
    hooks: &mut Hooks<'_>,
) -> Result<Motion, StudyError> {
    let settings = settings(model, system, numeric.start.t, options);
    let subject = Subject {
        system,
        terms: &prepared.terms,
        binding: &numeric.binding,
        numeric: &numeric.numeric,
        start: &numeric.start,
    };
    let name = options.formulation.as_deref().unwrap_or("routh");
    if !INTEGRABLE.contains(&name) {
        return Err(StudyError::UnknownFormulation {
            name: name.into(),
            known: INTEGRABLE.join(", "),
        });
    }
    let run = integrate(&subject, name, &settings, "integrating", hooks)?;
    let other = if name == "routh" { "maggi" } else { "routh" };
    let reached = RunSettings {
        t_end: last_time(&run, settings.t_end),
        times: run.times.clone(),
        ..settings.clone()
    };
    let comparison = integrate(
        &subject,
        other,
        &reached,
        "integrating the other form",
        hooks,
    )
    .ok();
    let finer = if options.global_error {
        let tolerance = (settings.tolerance / 10.0).max(3e-14);
        let finer = RunSettings {
            tolerance,
            absolute_tolerance: tolerance,
            ..reached.clone()
        };
        integrate(&subject, name, &finer, "estimating the global error", hooks).ok()
    } else {
        None
    };
    let orders = crate::motion_claims::observed_order(&subject, &settings, &run, hooks);
    let evidence = MotionEvidence::new(model, &subject, run, comparison, finer, orders, &settings)?;
    Ok(Motion {
        start: numeric.start,
        binding: numeric.binding,
        evidence: Arc::new(evidence),
        settings,
    })
}

/// Comparisons are made up to the last row when a run ended early.
fn last_time(run: &Run, t_end: f64) -> f64 {
    if run.ending.finished {
        t_end
    } else {
        run.times.last().copied().unwrap_or(t_end)
    }
}

pub(crate) fn integrate(
    subject: &Subject<'_>,
    name: &str,
    settings: &RunSettings,
    what: &str,
    hooks: &mut Hooks<'_>,
) -> Result<Run, RunError> {
    let progress = &mut *hooks.progress;
    let mut report = |p: Progress| {
        let span = p.t_end - p.t_start;
        if p.steps.is_multiple_of(256) && span != 0.0 {
            progress(what, Some((p.t - p.t_start) / span));
        }
        ControlFlow::Continue(())
    };
    let mut watcher = Watcher {
        interrupt: hooks.interrupt,
        progress: Some(&mut report),
    };
    match name {
        "maggi" => subject.maggi(settings, &mut watcher),
        _ => subject.routh(settings, &mut watcher),
    }
}

fn decide(
    model: &Model,
    system: &System,
    prepared: &Prepared,
    motion: Option<&Motion>,
    options: &StudyOptions,
    hooks: &mut Hooks<'_>,
) -> Vec<Decided> {
    let known = registry();
    let mut prover = Prover {
        replay: options.replay,
        ..Prover::default()
    };
    if let Some(seed) = options.seed {
        prover.seed = seed;
    }
    let mut cx = Context::new(system, &prepared.terms, &prepared.selection, &known, prover);
    if let Some(motion) = motion {
        cx = cx.with(Arc::clone(&motion.evidence));
    }
    let began = (hooks.clock)();
    let mut verdicts = Vec::new();
    for group in Group::ALL {
        for claim in known.claims().iter().filter(|c| c.group() == group) {
            for subject in claim.subjects(&cx) {
                let full = full_id(claim.id(), subject.as_deref());
                if !options.claims.wants(*claim, &full) {
                    continue;
                }
                (hooks.progress)(&full, None);
                let start = (hooks.clock)();
                let finding = if start - began > options.budget {
                    let tried = format!(
                        "the time budget of {} s was spent before this claim",
                        options.budget
                    );
                    Arc::new(Finding::from(Verdict::undecided(tried)))
                } else {
                    cx.finding(&full)
                };
                verdicts.push(Decided {
                    claim: claim.id(),
                    title: claim.title(),
                    group,
                    requires: claim.requires(subject.as_deref()),
                    finding,
                    seconds: (hooks.clock)() - start,
                    expected: expected(model, claim.id(), subject.as_deref()),
                    subject,
                });
            }
        }
    }
    verdicts
}

fn expected(model: &Model, claim: &str, subject: Option<&str>) -> Vec<String> {
    model
        .expect
        .verdicts
        .iter()
        .filter(|e| e.claim == claim && (e.subject.is_none() || e.subject.as_deref() == subject))
        .flat_map(|e| e.verdicts.iter().cloned())
        .collect()
}

fn outcome(model: &Model, verdicts: &[Decided], motion: Option<&Motion>) -> Outcome {
    if let Some(motion) = motion {
        let ending = &motion.evidence.run.ending;
        if !ending.finished && !stop_is_expected(model, motion) {
            return Outcome::Stopped;
        }
        let awaited = model.expect.stop.is_some() && ending.finished;
        if awaited {
            return Outcome::Unmet;
        }
    }
    if verdicts.iter().all(Decided::is_as_expected) {
        Outcome::Done
    } else {
        Outcome::Unmet
    }
}

/// Whether the model declares the stop that happened.
pub fn stop_is_expected(model: &Model, motion: &Motion) -> bool {
    let ending = &motion.evidence.run.ending;
    let Some(stop) = &model.expect.stop else {
        return false;
    };
    if ending.finished || ending.interrupted {
        return false;
    }
    let values: Vec<(Expr, Expr)> = model.parameter_values();
    let near = match stop.at.and_then(|t| number(&model.graph, t, &values)) {
        Some(at) => (ending.t - at).abs() <= 1e-2 * (1.0 + at.abs()),
        None => true,
    };
    near && ending.reason.contains(&stop.reason)
}
