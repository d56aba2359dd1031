//! One model through its claims and its motion.

use crate::beside::{self, Beside};
use crate::derivation::check_applies;
use crate::error::StudyError;
use crate::expectations::{check_expectations, contradictions, expected, outcome, unmatched};
use crate::method_order::observed_order;
use crate::motion_claims::METHOD_ORDER;
use crate::motion_evidence::{FoundIntegrals, MotionEvidence, Searched};
use crate::notices::{
    component, events_not_followed, integrals_not_kept, left_assumptions, negative_masses, notices,
    rank_falls, stiffness, unused_crossings, unused_multipliers,
};
use crate::options::{Hooks, StudyOptions};
use crate::preparation::{prepare, wrong_characteristics};
use crate::record;
use crate::registry::registry;
use crate::start::{asks_for_motion, of_start, settings, sharpest, Start};
use crate::watch::{ending, in_time, interruptible, is_interrupted, watched};
use crate::witness::{self, Witness};
use chetaev_geometry::noether::claims::FAMILY;
use chetaev_geometry::noether::found::{found, is_function_of};
use chetaev_geometry::noether::search::Integral;
use chetaev_integrate::double_double::LEAST_TOLERANCE;
use chetaev_integrate::Progress;
use chetaev_mechanics::claims::formulation::REFERENCE;
use chetaev_mechanics::claims::full_id;
use chetaev_mechanics::claims::model::ConstraintsIndependent;
use chetaev_mechanics::claims::strata::{Grounds, Strata};
pub use chetaev_mechanics::claims::Decided;
use chetaev_mechanics::components::covered;
use chetaev_mechanics::formulations::{Maggi, Routh};
use chetaev_mechanics::{
    formulation, Claim, Context, Finding, Formulation, Group, Prepared, Prover, Registry, System,
    FORMULATIONS,
};
use chetaev_model::model::Model;
use chetaev_motion::follow::vanishes;
use chetaev_motion::run::equal_times;
use chetaev_motion::{
    Binding, Component, ConsistentState, Precise, Run, RunError, RunSettings, Subject, Watcher,
};
use chetaev_orbits::witness::perturbed_runs;
use chetaev_stability::witness::RunsBeside;
use chetaev_symbolic::meter::{within, Stopped, Work, UNITS_PER_SECOND};
use chetaev_symbolic::{Expr, Verdict};
use std::ops::ControlFlow;
use std::sync::Arc;

/// A computed motion with what is known about it.
#[derive(Debug)]
pub struct Motion {
    /// The start.
    pub start: ConsistentState,
    /// The component of constraints that are products on which it was computed, by equations.
    pub component: Option<String>,
    /// How it was run.
    pub settings: RunSettings,
    /// Parameter values.
    pub binding: Binding,
    /// The trajectory and its evidence.
    pub evidence: Arc<MotionEvidence>,
    /// First integrals that were found, along the trajectory.
    pub found: FoundIntegrals,
    /// What integrals over the motion say of the variational principles.
    pub witness: Witness,
    /// The constrained extremum from the same state, or why there is none; `None` where it was not asked for.
    pub beside: Option<Result<Beside, String>>,
}

impl Motion {
    /// The constrained extremum from the same state, where it was computed.
    pub fn extremum(&self) -> Option<&Beside> {
        self.beside.as_ref()?.as_ref().ok()
    }
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
    /// Units of work that the claims took.
    pub work: u64,
}

/// How a study ended; the exit status of the command line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// Everything as asked.
    Done,
    /// A declared expectation is not met, or a witness refutes what is stated.
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

/// Everything that [`study`] finds wrong before it begins: expectations, constraints that contradict each other, values
/// that a motion needs, an initial state that cannot be used.
///
/// # Errors
/// The first problem.
pub fn check(model: &Model, hooks: &mut Hooks<'_>) -> Result<(), StudyError> {
    let options = StudyOptions::default();
    check_expectations(model, &registry())?;
    let (system, prepared, start) = prepare(model, &options, hooks)?;
    prepared.has_motions()?;
    if let Some(detail) = wrong_characteristics(&system, &prepared) {
        return Err(StudyError::WrongCharacteristics { detail });
    }
    match start {
        Ok(start) if asks_for_motion(model) => {
            let settings = settings(model, &system, start.start.t, &options)?;
            check_step(&settings)
        }
        _ => Ok(()),
    }
}

/// A method without an estimate of its error needs a step.
fn check_step(settings: &RunSettings) -> Result<(), StudyError> {
    let method = chetaev_integrate::method(&settings.method).map_err(RunError::from)?;
    if method.card().adaptive || settings.step.is_some() {
        Ok(())
    } else {
        Err(StudyError::StepMissing {
            method: settings.method.clone(),
        })
    }
}

/// Takes a model through its claims and its motion.
///
/// # Errors
/// [`StudyError`] when the input is wrong in a way that leaves nothing to study.
pub fn study(
    model: Model,
    options: StudyOptions,
    hooks: &mut Hooks<'_>,
) -> Result<Study, StudyError> {
    study_telling(model, options, hooks, &mut |_| {})
}

/// [`study`](study()), where `told` hears of each claim when it is decided.
///
/// # Errors
/// [`StudyError`] when the input is wrong in a way that leaves nothing to study.
pub fn study_telling(
    model: Model,
    options: StudyOptions,
    hooks: &mut Hooks<'_>,
    told: &mut dyn FnMut(&Decided),
) -> Result<Study, StudyError> {
    let known = registry();
    let began = interruptible(hooks, |hooks| {
        check_expectations(&model, &known)?;
        let (system, prepared, numeric) = prepare(&model, &options, hooks)?;
        if !options.claims.wants_claim(&ConstraintsIndependent) {
            prepared.has_motions()?;
        }
        let mut notices = notices(&model, &system, &prepared, numeric.as_ref().ok(), &options);
        if let Some(detail) = wrong_characteristics(&system, &prepared) {
            notices.push(format!(
                "{detail}; Maggi's and Volterra's equations are not derived by them"
            ));
        }
        Ok::<_, StudyError>((system, prepared, numeric, notices))
    });
    let (system, prepared, numeric, mut notices) = began.unwrap_or(Err(StudyError::Interrupted))?;
    let start = numeric.as_ref().ok().map(|numeric| numeric.start.clone());
    let asks = options.claims.wants_group(Group::Motion, known.claims());
    let wants_motion = options.motion && (asks || options.claims.names_witness());
    let motion = match numeric {
        Ok(numeric) if wants_motion => {
            let motion = compute(&model, &system, &prepared, numeric, &options, hooks)?;
            if motion.is_none() {
                notices.push("interrupted before the motion was computed".into());
            }
            motion
        }
        Ok(_) => None,
        Err(why) => {
            notices.push(why.to_string());
            None
        }
    };
    if let Some(motion) = &motion {
        let of_motion = in_time(hooks, GRACE, || {
            let mut notices = left_assumptions(&system, &prepared, motion);
            notices.extend(events_not_followed(&model, motion));
            notices.extend(stiffness(motion));
            notices.extend(integrals_not_kept(&model, motion, &options));
            notices.extend(negative_masses(&system, &prepared, motion));
            notices.extend(component(motion));
            notices.extend(unused_crossings(motion));
            notices.extend(rank_falls(&system, &prepared, motion));
            notices
        });
        notices.extend(of_motion.unwrap_or_default());
    }
    let known_motion = KnownMotion {
        start: start.as_ref(),
        motion: motion.as_ref(),
    };
    let work = Work::of_seconds(options.budget);
    let (verdicts, found, witness) = decide(
        &model,
        &system,
        &prepared,
        known_motion,
        (&options, &work),
        hooks,
        told,
    );
    let mut motion = motion;
    if let Some(motion) = &mut motion {
        motion.found = found.map_or_else(FoundIntegrals::default, |found| (*found).clone());
        motion.witness = witness;
    }
    notices.extend(unused_multipliers(
        &model,
        &prepared,
        &options,
        motion.as_ref(),
    ));
    let mut unmatched = unmatched(&model, &verdicts, &options);
    unmatched.extend(options.claims.without_subject(&verdicts));
    let outcome = match outcome(&model, &verdicts, motion.as_ref()) {
        _ if is_interrupted(hooks) => Outcome::Stopped,
        Outcome::Done if !unmatched.is_empty() => Outcome::Unmet,
        Outcome::Done if prepared.degenerate.is_some() && options.motion => Outcome::Unmet,
        outcome => outcome,
    };
    if is_interrupted(hooks) {
        let open = |d: &&Decided| matches!(d.finding.verdict, Verdict::Undecided { .. });
        let open = verdicts.iter().filter(open).count();
        notices.push(format!(
            "interrupted: {open} of {} claims are undecided, and what was computed is kept",
            verdicts.len()
        ));
    }
    notices.extend(contradictions(&verdicts));
    notices.extend(unmatched);
    notices.extend(options.claims.without_witness(&verdicts));
    Ok(Study {
        model,
        system,
        prepared,
        verdicts,
        motion,
        notices,
        outcome,
        options,
        work: work.spent(),
    })
}

fn compute(
    model: &Model,
    system: &System,
    prepared: &Prepared,
    numeric: Start,
    options: &StudyOptions,
    hooks: &mut Hooks<'_>,
) -> Result<Option<Motion>, StudyError> {
    let settings = settings(model, system, numeric.start.t, options)?;
    check_step(&settings)?;
    let subject = Subject {
        system,
        terms: &prepared.terms,
        selection: &prepared.selection,
        binding: &numeric.binding,
        numeric: &numeric.numeric,
        start: &numeric.start,
        factors: &[],
    };
    // Double-double arithmetic is for constraints as they are stated.
    let component = match settings.precise {
        None => Component::of_start(&subject),
        Some(_) => None,
    };
    let stated = subject;
    let subject = match &component {
        Some(component) => component.subject(&numeric.binding),
        None => subject,
    };
    let name = options.formulation.as_deref().unwrap_or("routh");
    let Some(formulation) = formulation(name) else {
        return Err(StudyError::UnknownFormulation {
            name: name.into(),
            known: known_formulations(),
        });
    };
    let known = registry();
    let (terms, selection) = (&prepared.terms, &prepared.selection);
    let cx = Context::new(system, terms, selection, &known, Prover::default());
    let before = interruptible(hooks, |hooks| {
        check_applies(&cx, formulation.card())?;
        let start = &numeric.start;
        Ok::<_, StudyError>(searched(model, (system, prepared), start, options, hooks))
    });
    let Ok(searched) = before else {
        return Ok(None);
    };
    let searched = searched?;
    let keep = searched.to_keep.clone();
    let settings = RunSettings { keep, ..settings };
    let run = ending(hooks, |hooks| {
        integrate(&subject, formulation, &settings, "integrating", hooks)
    });
    let Ok(run) = run else {
        return Ok(None);
    };
    let run = run?;
    let other: &'static dyn Formulation = if name == REFERENCE { &Maggi } else { &Routh };
    let along = |numbers: &Arc<Precise>| {
        let rows = run.precise.as_ref()?;
        Some(Arc::new(numbers.along(rows)))
    };
    let reached = RunSettings {
        t_end: last_time(&run, settings.t_end),
        times: run.times.clone(),
        events: Vec::new(),
        precise: settings.precise.as_ref().and_then(along),
        ..settings.clone()
    };
    // Equations are compared, and so by runs that no projection leads to kept integrals.
    let unprojected = RunSettings {
        keep: Vec::new(),
        ..in_doubles(reached.clone())
    };
    let what = "integrating the other form";
    let comparison = interruptible(hooks, |hooks| {
        check_applies(&cx, other.card()).ok()?;
        integrate(&subject, other, &unprojected, what, hooks).ok()
    });
    let comparison = comparison.ok().flatten();
    let plain = match (&comparison, settings.keep.is_empty()) {
        (Some(_), false) => {
            let what = "integrating without projection";
            let again = interruptible(hooks, |hooks| {
                integrate(&subject, formulation, &unprojected, what, hooks).ok()
            });
            again.ok().flatten()
        }
        _ => None,
    };
    let finer = if options.global_error && !run.ending.interrupted {
        let sharpest = match settings.precise {
            Some(_) => LEAST_TOLERANCE,
            None => sharpest(&settings.method),
        };
        let tolerance = (settings.tolerance / 10.0).max(1.3 * sharpest);
        let finer = RunSettings {
            tolerance,
            absolute_tolerance: tolerance,
            step: settings.step.map(|h| h / 2.0),
            ..reached.clone()
        };
        let what = "estimating the global error";
        let finer = interruptible(hooks, |hooks| {
            integrate(&subject, formulation, &finer, what, hooks).ok()
        });
        // One that ended early says nothing of the error at the end.
        let finer = finer.ok().flatten();
        finer.filter(|finer| !finer.ending.interrupted)
    } else {
        None
    };
    let is_order = |c: &&&dyn Claim| c.id() == METHOD_ORDER;
    let order = known.claims().iter().find(is_order);
    let wants_order = order.is_some_and(|c| options.claims.wants_claim(*c));
    let orders = match settings.precise {
        None if wants_order => {
            let found = interruptible(hooks, |hooks| {
                observed_order(&subject, &settings, &run, hooks)
            });
            found.ok().flatten()
        }
        _ => None,
    };
    // A motion that goes on along another component leaves the factors of the first.
    let has_changed = run.crossings.iter().any(|crossing| crossing.onto.is_some());
    let measured = if has_changed { &stated } else { &subject };
    let mut evidence =
        MotionEvidence::new(model, measured, run, comparison, finer, orders, &settings)?;
    if !settings.keep.is_empty() {
        evidence.compare_with(plain.as_ref());
    }
    evidence.keep(searched);
    let is_witness = |c: &&dyn Claim| c.id().starts_with("witness");
    let mut witnesses = known.claims().iter().filter(|c| is_witness(c));
    if prepared.terms.order == 1 && witnesses.any(|c| options.claims.wants_claim(*c)) {
        let run = &evidence.run;
        let found = interruptible(hooks, |hooks| {
            dense(&subject, formulation, run, &settings, hooks)
        });
        evidence.dense = found.ok().flatten();
    }
    let beside = options.extremum.as_ref().map(|given| {
        let reached = in_doubles(reached);
        let found = interruptible(hooks, |hooks| {
            beside::of(&cx, &subject, &evidence.run, &reached, given, hooks)
        });
        found.unwrap_or_else(|_| Err("interrupted before it was computed".into()))
    });
    Ok(Some(Motion {
        beside,
        component: component.as_ref().map(Component::in_words),
        start: numeric.start,
        binding: numeric.binding,
        evidence: Arc::new(evidence),
        found: FoundIntegrals::default(),
        witness: Witness::default(),
        settings,
    }))
}

/// The same run in doubles, with a tolerance that they can meet; other settings are left as they are.
fn in_doubles(settings: RunSettings) -> RunSettings {
    if settings.precise.is_none() {
        return settings;
    }
    let least = 1.3 * sharpest(&settings.method);
    RunSettings {
        tolerance: settings.tolerance.max(least),
        absolute_tolerance: settings.absolute_tolerance.max(least),
        precise: None,
        ..settings
    }
}

/// Rows of the run for quadratures, and how many of them lie within a step of the method on average.
const DENSE_ROWS: u32 = 768;
const ROWS_OF_STEP: f64 = 4.0;

/// The beginning of a run again, at rows closer than its steps.
fn dense(
    subject: &Subject<'_>,
    formulation: &'static dyn Formulation,
    run: &Run,
    settings: &RunSettings,
    hooks: &mut Hooks<'_>,
) -> Option<Run> {
    let start = subject.start.t;
    let length = run.t - start;
    let steps = (run.statistics.steps as f64).max(1.0);
    let share = f64::from(DENSE_ROWS) / (ROWS_OF_STEP * steps);
    // A run that ended early ended where its equations are singular.
    let most = if run.ending.finished { 1.0 } else { 0.9 };
    let t_end = start + length * share.min(most);
    let settings = RunSettings {
        t_end,
        times: equal_times(start, t_end, DENSE_ROWS),
        ..in_doubles(settings.clone())
    };
    let what = "integrating for quadratures";
    integrate(subject, formulation, &settings, what, hooks).ok()
}

/// Whether first integrals are to be kept.
pub(crate) fn keeps(model: &Model, options: &StudyOptions) -> bool {
    options.keep_integrals || model.simulation.keep_integrals == Some(true)
}

/// The prover of a study.
fn proving(options: &StudyOptions) -> Prover {
    let usual = Prover::default();
    Prover {
        replay: options.replay,
        seed: options.seed.unwrap_or(usual.seed),
        ..usual
    }
}

/// What is found before a run whose integrals are to be kept: by the search of the claims, on the component on which the motion starts.
/// An integral on one component is none on another, and a projection on its values would lead away from the motion.
fn searched(
    model: &Model,
    (system, prepared): (&System, &Prepared),
    start: &ConsistentState,
    options: &StudyOptions,
    hooks: &mut Hooks<'_>,
) -> Searched {
    if !keeps(model, options) {
        return Searched::default();
    }
    let known = registry();
    let grounds = Grounds::new(system, prepared, &|on, list| {
        vanish_at_start(on, start, list)
    });
    let strata = strata(&grounds, &known, options, None);
    let Some(family) = known.find(FAMILY) else {
        return Searched::default();
    };
    let cx = strata.context(family);
    let integrals = kept(model, cx, options, hooks);
    let to_keep = movable(system, &integrals);
    let mut functions = vec![system.energy()];
    functions.extend(model.integrals.iter().map(|i| i.value));
    functions.retain(|&value| !to_keep.is_empty() && is_function_of(cx, &to_keep, value));
    Searched {
        integrals,
        to_keep,
        functions,
    }
}

/// The first integrals to keep, where that is asked for: those that are found.
pub(crate) fn kept(
    model: &Model,
    cx: &Context<'_>,
    options: &StudyOptions,
    hooks: &mut Hooks<'_>,
) -> Vec<Integral> {
    if !keeps(model, options) {
        return Vec::new();
    }
    (hooks.progress)("searching first integrals", None);
    match found(cx).as_ref() {
        Ok(found) => found.integrals.clone(),
        Err(_) => Vec::new(),
    }
}

/// The integrals that a projection can keep: a change of coordinates and velocities changes nothing in one of the time and of
/// masses with a law of their own.
pub(crate) fn movable(system: &System, integrals: &[Integral]) -> Vec<Expr> {
    let symbols = [system.coordinate_symbols(), system.velocity_symbols()].concat();
    let values = integrals.iter().map(|integral| integral.value);
    values
        .filter(|&value| system.graph.contains_any(value, &symbols))
        .collect()
}

/// Comparisons are made up to the last row when a run ended early.
fn last_time(run: &Run, t_end: f64) -> f64 {
    if run.ending.finished && run.t == t_end {
        t_end
    } else {
        run.times.last().copied().unwrap_or(t_end)
    }
}

pub(crate) fn integrate(
    subject: &Subject<'_>,
    formulation: &'static dyn Formulation,
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
    subject.by(formulation, settings, &mut watcher)
}

pub(crate) fn known_formulations() -> String {
    let names: Vec<&str> = FORMULATIONS.iter().map(|f| f.card().name).collect();
    names.join(", ")
}

/// Whether no one choice of independent velocities describes all components of the constraints, or a holonomic one is a product.
pub(crate) fn components_are_apart(system: &System, prepared: &Prepared) -> bool {
    covered(system, &prepared.terms, &prepared.selection).is_some() || system.has_positions_apart()
}

/// Where the claims of a study are asked, with the motion, where there is one.
fn strata<'a>(
    grounds: &'a Grounds<'a>,
    known: &'a Registry,
    options: &'a StudyOptions,
    motion: Option<&'a Motion>,
) -> Strata<'a> {
    let with = move |cx: Context<'a>| {
        let cx = cx.allowing(options.work());
        let cx = cx.with(Arc::new(RunsBeside(perturbed_runs)));
        match motion {
            Some(motion) => cx.with(Arc::clone(&motion.evidence)),
            None => cx,
        }
    };
    Strata::new(grounds, known, move || proving(options), with)
}

/// What is known of a motion when claims are decided.
#[derive(Clone, Copy)]
struct KnownMotion<'a> {
    /// Where it starts, computed or not.
    start: Option<&'a ConsistentState>,
    /// The motion, where it was computed.
    motion: Option<&'a Motion>,
}

/// The hypotheses but those that are nothing to ask of this system, as how masses vary where none does.
fn hypotheses(strata: &Strata<'_>, known: &Registry, mut requires: Vec<String>) -> Vec<String> {
    let is_asked = |id: &String| match known.find(id) {
        Some(claim) => !claim.subjects(strata.context(claim)).is_empty(),
        None => true,
    };
    requires.retain(is_asked);
    requires
}

/// Whether functions of the state vanish where the motion starts, beside their terms.
fn vanish_at_start(system: &System, start: &ConsistentState, functions: &[Expr]) -> Option<bool> {
    let g = &system.graph;
    let functions = g.substitute_all(functions, &system.parameter_values());
    let value = |symbol| of_start(system, symbol, start);
    let mut all = functions.into_iter().map(|e| vanishes(g, e, &value));
    all.try_fold(true, |all, own| Some(all & own?))
}

fn decide(
    model: &Model,
    system: &System,
    prepared: &Prepared,
    KnownMotion { start, motion }: KnownMotion<'_>,
    (options, work): (&StudyOptions, &Arc<Work>),
    hooks: &mut Hooks<'_>,
    told: &mut dyn FnMut(&Decided),
) -> (Vec<Decided>, Option<Arc<FoundIntegrals>>, Witness) {
    let known = registry();
    let grounds = Grounds::new(system, prepared, &|on, list| {
        vanish_at_start(on, start?, list)
    });
    let strata = strata(&grounds, &known, options, motion);
    let deadline = (hooks.clock)() + LATE * options.budget;
    let verdicts = watched(hooks, work, Some(deadline), |hooks| {
        decide_all(&strata, &known, model, (options, work), hooks, told)
    });
    let of_run = known
        .find(witness::STATIONARY)
        .map(|claim| strata.context(claim));
    let found = of_run.and_then(|cx| cx.known::<FoundIntegrals>());
    let witnessed = of_run.map(witness::computed).unwrap_or_default();
    (verdicts, found, witnessed)
}

/// Seconds for what is said of a motion after an interruption.
const GRACE: f64 = 0.05;

/// What takes so many times the time of its work is stopped.
const LATE: f64 = 2.0;

/// Decides every claim that is wanted, as far as the work suffices.
fn decide_all(
    strata: &Strata<'_>,
    known: &Registry,
    model: &Model,
    (options, work): (&StudyOptions, &Arc<Work>),
    hooks: &mut Hooks<'_>,
    told: &mut dyn FnMut(&Decided),
) -> Vec<Decided> {
    let mut verdicts = Vec::new();
    let of = |group: Group| known.claims().iter().filter(move |c| c.group() == group);
    // Claims about the motion are asked once more: which integrals a search finds is known after it only.
    let groups = Group::ALL.into_iter().chain([Group::Motion]);
    for claim in groups.flat_map(of) {
        if work.is_spent() || work.stopped().is_some() {
            strata.spend_time();
        }
        if !options.claims.wants_claim(*claim) {
            continue;
        }
        let subjects = within(work, || claim.subjects(strata.context(*claim)));
        // What subjects there are was not found in time: the claim itself stands for them.
        for subject in subjects.unwrap_or_else(|_| vec![None]) {
            let full = full_id(claim.id(), subject.as_deref());
            let is_decided = verdicts.iter().any(|d: &Decided| d.full_id() == full);
            if is_decided || !options.claims.wants(*claim, &full) {
                continue;
            }
            (hooks.progress)(&full, None);
            let start = (hooks.clock)();
            let finding = within(work, || {
                Arc::new(strata.finding(*claim, subject.as_deref()))
            })
            .unwrap_or_else(|stopped| {
                strata.abandon();
                strata.spend_time();
                Arc::new(Finding::from(stopped_verdict(stopped, options.budget)))
            });
            let decided = Decided {
                claim: claim.id(),
                title: claim.title_of(subject.as_deref()),
                group: claim.group().word(),
                requires: hypotheses(strata, known, claim.requires(subject.as_deref())),
                finding,
                seconds: (hooks.clock)() - start,
                expected: expected(model, claim.id(), subject.as_deref()),
                subject,
            };
            told(&decided);
            verdicts.push(decided);
        }
    }
    // Where they follow each other is the order of the groups.
    let place = |d: &Decided| Group::ALL.iter().position(|g| g.word() == d.group);
    verdicts.sort_by_key(place);
    verdicts
}

/// What is known of a claim that was stopped.
fn stopped_verdict(stopped: Stopped, budget: f64) -> Verdict {
    Verdict::undecided(match stopped {
        Stopped::Spent => format!(
            "the work of the budget was spent ({budget} s at {UNITS_PER_SECOND:e} units per second); a larger --budget decides more"
        ),
        Stopped::Late => format!(
            "{}the claims took more than {LATE} times the {budget} s of their budget on this machine",
            record::LATE
        ),
        Stopped::Interrupted => format!("{}before this claim was decided", record::INTERRUPTED),
    })
}
