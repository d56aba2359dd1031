//! One run: settings, the trajectory as rows (q, v, a, λ), and why it ended, in words.

use crate::course::{Course, Pieces};
use crate::crossing::{self, Crossing, State, Track};
use crate::double_double::{Precise, PreciseRows};
use crate::factors::Factor;
use crate::follow::{Deviation, Follow};
use crate::formulation_flow::{FlowError, FormulationFlow};
use crate::happening::{self, EventWatched, Happened};
use crate::initial::jets::JetStart;
use crate::initial::ConsistentState;
use crate::jet_flow::{self, JetFlow};
use crate::keep::KeptReport;
use crate::multiplier_flow::{MultiplierFlow, StateKind};
use crate::numeric::{Binding, NumericSystem};
use crate::observe::Observer;
use crate::row::RowLayout;
use crate::scales::Scales;
use crate::sticking::Sticking;
use crate::stop::{self, Ending};
use crate::turns::outside_angles;
use crate::watch::{Watch, Watched};
use chetaev_integrate::{
    integrate, method, ChartChange, ErrorControl, IntegrateError, Note, Options, Output, Piece,
    Progress, Statistics, StiffnessPolicy, Stop,
};
use chetaev_mechanics::card::Relation;
use chetaev_mechanics::claims::formulation::REFERENCE;
use chetaev_mechanics::{Constraint, ConstraintKind, Formulation, MotionTerms, Selection, System};
use chetaev_symbolic::Expr;
use std::ops::ControlFlow;
use std::sync::atomic::AtomicBool;
use std::sync::Arc;

/// How a run is made.
#[derive(Clone, Debug, PartialEq)]
pub struct RunSettings {
    /// End of the run.
    pub t_end: f64,
    /// Relative tolerance.
    pub tolerance: f64,
    /// Absolute tolerance.
    pub absolute_tolerance: f64,
    /// Whether the absolute tolerance is in the natural sizes of coordinates and velocities ([`Scales`]), and not in their units.
    pub is_natural: bool,
    /// Fixed step size; required by methods without an error estimate, and taken with any method where given.
    pub step: Option<f64>,
    /// Name of the method.
    pub method: String,
    /// Times of the rows.
    pub times: Vec<f64>,
    /// Most steps.
    pub max_steps: u64,
    /// Variables of the multiplier form; `None` for those in which the error of a step is measured best: all velocities, or
    /// independent ones where constraints jump.
    pub state: Option<StateKind>,
    /// Whether a state of all velocities is projected on the constraints after each step that leaves them by more than a tenth
    /// of the tolerance.
    pub project: bool,
    /// Quantities in (t, q, v) whose deviation from their initial values is measured at every step, and with them those of
    /// the constraints; nothing is measured when empty.
    pub follow: Vec<Expr>,
    /// First integrals in (t, q, v) whose values are kept by projection after each step, in the multiplier form.
    pub keep: Vec<Expr>,
    /// Initial values of variables that coordinates and velocities do not determine, by name (`kappa_NAME`).
    pub own: Vec<(String, f64)>,
    /// Zeros to be found along the motion.
    pub events: Vec<EventWatched>,
    /// Where the motion is not determined because components of a constraint meet: functions that vanish on the component on which it goes
    /// on, one for each such place, with their texts.
    pub crossings: Vec<(String, Expr)>,
    /// The numbers of a run in double-double arithmetic, which say more than those above; `None` for a run in doubles.
    pub precise: Option<Arc<Precise>>,
}

impl RunSettings {
    /// 500 equal intervals, DOP853 at tolerance 1e-10, projected on the constraints.
    pub fn new(t_start: f64, t_end: f64) -> RunSettings {
        RunSettings {
            t_end,
            tolerance: 1e-10,
            absolute_tolerance: 1e-10,
            is_natural: false,
            step: None,
            method: "dormand-prince-853".into(),
            times: equal_times(t_start, t_end, 500),
            max_steps: 2_000_000,
            state: None,
            project: true,
            follow: Vec::new(),
            keep: Vec::new(),
            own: Vec::new(),
            events: Vec::new(),
            crossings: Vec::new(),
            precise: None,
        }
    }
}

/// `t_start + j (t_end - t_start)/intervals`, j = 0..=intervals, the last exactly `t_end`.
pub fn equal_times(t_start: f64, t_end: f64, intervals: u32) -> Vec<f64> {
    if intervals == 0 || t_start == t_end {
        return vec![t_start];
    }
    let mut times: Vec<f64> = (0..=intervals)
        .map(|j| t_start + f64::from(j) * ((t_end - t_start) / f64::from(intervals)))
        .collect();
    if let Some(last) = times.last_mut() {
        *last = t_end;
    }
    times
}

/// Interruption and progress of long runs.
#[derive(Default)]
pub struct Watcher<'a> {
    /// When it becomes true the run ends and keeps what it has.
    pub interrupt: Option<&'a AtomicBool>,
    /// Called after each step; breaking ends the run as an interruption.
    pub progress: Option<&'a mut dyn FnMut(Progress) -> ControlFlow<()>>,
}

impl std::fmt::Debug for Watcher<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("Watcher")
    }
}

/// A computed motion.
#[derive(Clone, Debug)]
pub struct Run {
    /// Name of the formulation integrated.
    pub formulation: &'static str,
    /// Name of the method.
    pub method: &'static str,
    /// Layout of the rows.
    pub layout: RowLayout,
    /// Names of the variables at the end of each row, those of the formulation alone.
    pub own: Vec<String>,
    /// Times of the rows.
    pub times: Vec<f64>,
    /// Rows (q, v, a, λ, own variables), one after the other.
    pub rows: Vec<f64>,
    /// Why it ended.
    pub ending: Ending,
    /// Last time reached.
    pub t: f64,
    /// Counts.
    pub statistics: Statistics,
    /// Changes of chart.
    pub chart_changes: Vec<(f64, ChartChange)>,
    /// Remarks.
    pub notes: Vec<Note>,
    /// What became of the integrals of [`RunSettings::keep`]; `None` where nothing was to be kept, or not in the multiplier form.
    pub kept: Option<KeptReport>,
    /// Largest violation of each constraint before projection; `None` when constraints hold by construction.
    pub drift: Option<crate::drift::Drift>,
    /// Deviations over all steps of the quantities of [`RunSettings::follow`] and of [`Subject::residuals`].
    pub followed: Vec<Deviation>,
    /// Whether the last row is the state where an early end was met, at a time that was not asked for.
    pub ends_between: bool,
    /// Events met, in the order of time along the run.
    pub events: Vec<Happened>,
    /// Times, rows and events with all their digits; `None` for a run in doubles.
    pub precise: Option<PreciseRows>,
    /// Places at which the rank of the constraints falls and the motion went on along the one branch of the constraint set that contains
    /// its velocity.
    pub crossings: Vec<Crossing>,
    /// Natural sizes of positions and velocities at the start, by which differences of runs are judged.
    pub scales: Vec<f64>,
}

/// How closely the time of a singularity is found, relative to the time.
const LOCATED: f64 = 64.0 * f64::EPSILON;

impl Run {
    /// Row number j.
    pub fn row(&self, j: usize) -> &[f64] {
        let width = self.layout.len();
        &self.rows[j * width..(j + 1) * width]
    }

    /// Number of rows.
    pub fn len(&self) -> usize {
        self.times.len()
    }

    /// Number of rows at times that were asked for.
    pub fn asked(&self) -> usize {
        self.len() - usize::from(self.ends_between)
    }

    /// Number of rows before the state at which the run ended early, whether or not its time was asked for: there a quantity
    /// may have no value, or one that says nothing. So it is at rows that rounding does not tell from it. All rows of a run that did
    /// not end early.
    pub fn regular(&self) -> usize {
        if self.ending.finished || self.ending.interrupted {
            return self.len();
        }
        let near = LOCATED * self.t.abs().max(1.0);
        let at_end = |t: &&f64| (**t - self.t).abs() <= near;
        let rows = self.times.iter().rev().take_while(at_end).count();
        self.len() - rows.max(usize::from(self.ends_between))
    }

    /// Whether there are no rows.
    pub fn is_empty(&self) -> bool {
        self.times.is_empty()
    }
}

/// Why a run cannot begin.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RunError {
    /// The integrator refuses the question.
    #[error(transparent)]
    Integrate(#[from] IntegrateError),
    /// The equations of a formulation cannot be integrated.
    #[error(transparent)]
    Flow(#[from] FlowError),
    /// The singular set cannot be watched.
    #[error(transparent)]
    Functions(#[from] crate::functions::FunctionsError),
    /// A tolerance that double precision cannot resolve beside the size of a quantity.
    #[error("the absolute tolerance {requested:e} for `{name}` cannot be met: at its size of the start double precision resolves {attainable:.1e}; raise `absolute_tolerance` to that, leave it out (then it follows from `tolerance`), or compute with `precision = \"double-double\"`")]
    Tolerance {
        /// The coordinate or velocity.
        name: String,
        /// As asked.
        requested: f64,
        /// The least that can be met.
        attainable: f64,
    },
    /// It is done in double precision only.
    #[error("double-double arithmetic is not for {what}: {fix}")]
    NotPrecise {
        /// What was asked for.
        what: String,
        /// What to do instead.
        fix: &'static str,
    },
}

/// A system of first order whose equations become singular where a watched quantity vanishes.
pub(crate) trait WatchedFlow: chetaev_integrate::System {
    /// Whether watched quantity `index` vanishes at the state y, where the integrator has found its minimum.
    fn vanishes(&mut self, index: usize, t: f64, y: &[f64]) -> bool;

    /// The watched mass that is about to vanish at the time and state y, or at a time at which the equations are singular,
    /// and when.
    fn lost_mass(&mut self, at: (f64, Option<f64>), y: &[f64]) -> Option<(usize, f64)>;

    /// The time of the last accepted state from which constraints are followed.
    fn settled(&self) -> f64;

    /// What follows the rank of the constraints, where it may fall.
    fn track(&mut self) -> Option<&mut Track> {
        None
    }

    /// Where the rank seems to fall, if that ended the last step.
    fn seems_to_fall(&mut self) -> Option<f64> {
        None
    }

    /// Forgets what was measured over the last step, which is made anew.
    fn forget_step(&mut self) {}

    /// Goes on from a state: the vector of it, in a chart that serves there.
    fn enter(&mut self, state: &State) -> Option<Vec<f64>> {
        let _ = state;
        None
    }

    /// The output row of a state with its accelerations and multipliers.
    fn row_of(&mut self, state: &State, a: &[f64], lambda: &[f64]) -> Option<Vec<f64>> {
        let _ = (state, a, lambda);
        None
    }

    /// What looks for where the motion sticks, where forces contain a sign.
    fn sticking(&mut self) -> Option<&mut Sticking> {
        None
    }

    /// Writes the Taylor coefficients of event number `event`, with the function `value` of an output row, along a piece of the
    /// motion; false where it has none, and it is sampled.
    fn event_series(
        &mut self,
        (event, value): (usize, Expr),
        piece: Piece<'_>,
        series: &mut [f64],
    ) -> bool {
        let _ = (event, value, piece, series);
        false
    }
}

/// What a run needs beside its flow, made once.
#[derive(Clone, Debug)]
pub(crate) struct Looking {
    /// Functions of the events, over output rows.
    pub(crate) observers: Vec<Observer>,
    /// The same as they are stated.
    pub(crate) values: Vec<Expr>,
    /// Coordinates whose errors are measured absolutely.
    cyclic: Vec<bool>,
    /// Natural sizes of the components of the state; empty where the absolute tolerance is in their units.
    pub(crate) scales: Vec<f64>,
}

impl Looking {
    /// The same for all components of a state.
    pub(crate) fn absolute(&self, dimension: usize) -> Vec<bool> {
        let mut absolute = self.cyclic.clone();
        absolute.resize(dimension, false);
        absolute
    }
}

/// How the last piece ended.
pub(crate) enum End {
    /// A watched quantity is zero.
    Vanished(Ending),
    /// The integrator stopped, at a time and state.
    Stopped(Stop, f64, Vec<f64>),
    /// An event of the model ends the run.
    Happened(Ending),
}

/// What a run needs to know of the system.
#[derive(Clone, Copy, Debug)]
pub struct Subject<'a> {
    /// The system.
    pub system: &'a System,
    /// Its terms.
    pub terms: &'a MotionTerms,
    /// Independent constraints and dependent velocities, or derivatives of order m.
    pub selection: &'a Selection,
    /// Values of parameters.
    pub binding: &'a Binding,
    /// Compiled functions.
    pub numeric: &'a NumericSystem,
    /// Where to start.
    pub start: &'a ConsistentState,
    /// The factors in the place of constraints that are products, on a component of them.
    pub factors: &'a [Factor],
}

impl Subject<'_> {
    /// Integrates to the end, piece by piece.
    fn watched<F: WatchedFlow>(
        &self,
        flow: &mut F,
        watched: Vec<Watched>,
        y0: Vec<f64>,
        settings: &RunSettings,
        (looking, watcher): (&mut Looking, &mut Watcher<'_>),
    ) -> Result<(Pieces, End), RunError> {
        let mut course = Course::new(watched, (self.start.t, y0), watcher.interrupt);
        while course.advance((self, &mut *flow), settings, (&mut *looking, &mut *watcher))? {}
        Ok(course.finish())
    }

    /// Integrates equations on a jet, for constraints of order two and more and for characteristics of the user.
    fn on_jets(
        &self,
        formulation: &'static dyn Formulation,
        settings: &RunSettings,
        watcher: &mut Watcher<'_>,
    ) -> Result<Run, RunError> {
        let parts = jet_flow::Parts {
            formulation,
            system: self.system,
            terms: self.terms,
            binding: self.binding,
        };
        let nothing = JetStart::default();
        let jets = self.start.jets.as_ref().unwrap_or(&nothing);
        let (mut flow, y0) =
            JetFlow::new(parts, self.selection, self.start, jets, settings.project)?;
        if !settings.follow.is_empty() {
            let kept = [settings.follow.clone(), self.residuals()].concat();
            let mut variables = vec![self.system.graph.intern_symbol("t", 0)];
            variables.extend(flow.symbols());
            let at = (self.start.t, &y0[..], &[][..]);
            flow.follow = Some(Follow::over(
                self.system,
                self.binding,
                &variables,
                &kept,
                at,
            )?);
        }
        let (watched, flow_names) = (flow.watch.quantities.clone(), flow.own_names());
        let mut looking = self.looking(settings, &flow_names)?;
        let (pieces, end) =
            self.watched(&mut flow, watched, y0, settings, (&mut looking, watcher))?;
        let constraints: Vec<String> = self.constraint_names();
        let ending = match end {
            End::Vanished(ending) | End::Happened(ending) => ending,
            End::Stopped(stop, ..) => {
                let names = stop::Names {
                    coordinates: &self.numeric.coordinates,
                    constraints: &constraints,
                    state: flow.names().to_vec(),
                    unknowns: Some(flow.unknowns()),
                    matrix: None,
                };
                stop::ending(&stop, &names, 1.0)
            }
        };
        let followed = flow.follow.take();
        let layout = (flow.layout(), flow.own_names());
        let name = formulation.card().name;
        Ok(self.collect(
            name,
            layout,
            settings,
            pieces,
            ending,
            (None, followed.as_ref()),
        ))
    }

    /// Whether the formulation is stated in parameters of the user that no formula gives from the velocities.
    fn is_parametrized(&self, formulation: &'static dyn Formulation) -> bool {
        let name = formulation.card().name;
        self.system.characteristics.is_some() && (name == "maggi" || name.starts_with("volterra"))
    }

    /// Whether the rank of the constraints is to be followed.
    pub(crate) fn rank_may_fall(&self) -> bool {
        crossing::may_fall(self.system, self.terms, self.selection)
    }

    /// Names of the constraints by row of the terms.
    pub(crate) fn constraint_names(&self) -> Vec<String> {
        let rows = self.terms.constraint_index.iter();
        rows.map(|&l| self.system.constraints[l].name.clone())
            .collect()
    }

    /// Integrates the equations of a formulation by themselves: Routh's with the linear system solved numerically at each
    /// state, every other in its own state with its equations compiled.
    ///
    /// # Errors
    /// [`RunError`].
    pub fn by(
        &self,
        formulation: &'static dyn Formulation,
        settings: &RunSettings,
        watcher: &mut Watcher<'_>,
    ) -> Result<Run, RunError> {
        if self.factors.is_empty() {
            self.integrated(formulation, settings, watcher)
        } else {
            self.on_component(formulation, settings, watcher)
        }
    }

    /// The same with the constraints as they are.
    pub(crate) fn integrated(
        &self,
        formulation: &'static dyn Formulation,
        settings: &RunSettings,
        watcher: &mut Watcher<'_>,
    ) -> Result<Run, RunError> {
        let name = formulation.card().name;
        if let Some(precise) = &settings.precise {
            return self.precisely(formulation, (settings, precise), watcher);
        }
        if self.terms.order > 1 || self.is_parametrized(formulation) {
            return self.on_jets(formulation, settings, watcher);
        }
        if name == REFERENCE {
            return self.routh(settings, watcher);
        }
        let of = (self.system, self.terms, self.binding);
        let numeric = self.numeric.clone();
        let mut flow = FormulationFlow::new(formulation, of, numeric, self.start, &settings.own)?;
        flow.follow = self.follow(settings)?;
        if self.rank_may_fall() && formulation.card().relation == Relation::Equivalent {
            flow.follow_rank();
        }
        let y0 = flow.start(self.start)?;
        let (watched, flow_names) = (flow.watch.quantities.clone(), flow.own_names());
        let mut looking = self.looking(settings, &flow_names)?;
        let scales = self.scales(settings);
        if settings.is_natural {
            looking.scales = flow.scales(self.start, &scales);
        }
        let (pieces, end) =
            self.watched(&mut flow, watched, y0, settings, (&mut looking, watcher))?;
        let ending = match end {
            End::Vanished(ending) | End::Happened(ending) => ending,
            End::Stopped(stop, ..) => {
                let mut state = self.numeric.coordinates.clone();
                state.extend_from_slice(&self.numeric.masses);
                state.extend_from_slice(flow.variables());
                let names = stop::Names {
                    coordinates: &self.numeric.coordinates,
                    constraints: &self.numeric.constraints,
                    state,
                    unknowns: None,
                    matrix: flow.matrix(),
                };
                stop::ending(&stop, &names, 1.0)
            }
        };
        let followed = flow.follow.take();
        let layout = (flow.layout(), flow.own_names());
        Ok(self.collect(
            name,
            layout,
            settings,
            pieces,
            ending,
            (None, followed.as_ref()),
        ))
    }

    /// What must vanish along the motion, with names: the constraints by row, then the holonomic ones as stated; with
    /// constraints of order two and more all as stated, then what the equations keep beside them.
    pub fn vanishing(&self) -> Vec<(String, Expr)> {
        let indices = self.terms.constraint_index.iter();
        let constraints: Vec<&Constraint> = indices.map(|&l| &self.system.constraints[l]).collect();
        let named = |c: &&Constraint, value: Expr| (c.name.clone(), value);
        if self.terms.order > 1 {
            let stated = constraints.iter().map(|c| named(c, c.stated));
            let kept = self
                .start
                .jets
                .iter()
                .flat_map(|jets| jets.conditions.clone());
            return stated.chain(kept).collect();
        }
        let rows = constraints.iter().zip(&self.terms.constraints);
        let holonomic = constraints
            .iter()
            .filter(|c| c.kind == ConstraintKind::Holonomic);
        rows.map(|(c, &f)| named(c, f))
            .chain(holonomic.map(|c| named(c, c.stated)))
            .collect()
    }

    /// The expressions of [`vanishing`](Subject::vanishing).
    pub fn residuals(&self) -> Vec<Expr> {
        self.vanishing()
            .into_iter()
            .map(|(_, value)| value)
            .collect()
    }

    /// The functions of the events, over output rows, and what the control of the steps must know.
    pub(crate) fn looking(
        &self,
        settings: &RunSettings,
        own_names: &[String],
    ) -> Result<Looking, RunError> {
        let of = |event: &EventWatched| {
            let (terms, value) = (self.terms, [event.value]);
            Observer::with_own(self.system, terms, self.binding, own_names, &value)
        };
        let observers: Result<Vec<Observer>, _> = settings.events.iter().map(of).collect();
        let series = method(&settings.method)?.card().needs_series;
        Ok(Looking {
            observers: observers?,
            values: settings.events.iter().map(|event| event.value).collect(),
            cyclic: self.cyclic(series),
            scales: Vec::new(),
        })
    }

    /// An error of the integrator with the name of the quantity in the place of its number in a state of coordinates and velocities.
    pub(crate) fn named(&self, problem: IntegrateError) -> RunError {
        let IntegrateError::ToleranceTooSmall {
            component,
            requested,
            attainable,
            ..
        } = problem
        else {
            return problem.into();
        };
        let (numeric, positions) = (self.numeric, self.numeric.positions());
        let places = numeric.coordinates.iter().chain(&numeric.masses).cloned();
        let speeds = numeric.coordinates.iter().map(|name| format!("{name}'"));
        match places.chain(speeds).nth(component) {
            Some(name) if component < positions + numeric.n => RunError::Tolerance {
                name,
                requested,
                attainable,
            },
            _ => problem.into(),
        }
    }

    /// Natural sizes at the start.
    pub(crate) fn scales(&self, settings: &RunSettings) -> Scales {
        Scales::new(self.start, self.numeric, settings.t_end)
    }

    fn follow(&self, settings: &RunSettings) -> Result<Option<Follow>, RunError> {
        if settings.follow.is_empty() {
            return Ok(None);
        }
        let start = (self.start.t, &self.start.q[..], &self.start.v[..]);
        let kept = [settings.follow.clone(), self.residuals()].concat();
        let follow = Follow::new(self.system, self.binding, &kept, start)?;
        Ok(Some(follow))
    }

    pub(crate) fn options<'o>(
        &self,
        settings: &RunSettings,
        t: f64,
        (absolute, scales): (Vec<bool>, &[f64]),
        interrupt: Option<&'o AtomicBool>,
    ) -> Result<Options<'o>, RunError> {
        let forward = settings.t_end >= self.start.t;
        let times = settings
            .times
            .iter()
            .copied()
            .filter(|&x| {
                if forward {
                    x > t || t == self.start.t && x >= t
                } else {
                    x < t || t == self.start.t && x <= t
                }
            })
            .collect();
        let mut options = match settings.step {
            Some(h) => Options::fixed_step(method(&settings.method)?, h),
            None => Options::tolerance(settings.tolerance),
        };
        options.method = method(&settings.method)?;
        options.error = ErrorControl {
            rtol: settings.tolerance,
            atol: settings.absolute_tolerance,
            atol_of: scales
                .iter()
                .map(|s| s * settings.absolute_tolerance)
                .collect(),
            absolute,
        };
        options.output = Output::Times(times);
        options.record_last = true;
        options.step_limit = settings.max_steps;
        options.stiffness = StiffnessPolicy::StopAfter(50_000);
        options.interrupt = interrupt;
        Ok(options)
    }

    /// Coordinates that occur nowhere in the equations, or where `angles` is asked for only inside trigonometric functions:
    /// a relative tolerance on them would grow blind.
    fn cyclic(&self, angles: bool) -> Vec<bool> {
        let g = &self.system.graph;
        let mut roots = self.terms.mass_matrix.concat();
        roots.extend(self.terms.jacobian.concat());
        roots.extend(&self.terms.force);
        roots.extend(&self.terms.constraint_rate);
        let present = match angles {
            true => outside_angles(g, &roots).0,
            false => g.symbols_in(&roots),
        };
        let coordinates = self.system.coordinates.iter();
        coordinates
            .map(|c| !present.contains(&c.q_symbol))
            .collect()
    }

    pub(crate) fn collect(
        &self,
        formulation: &'static str,
        (layout, own): (RowLayout, Vec<String>),
        settings: &RunSettings,
        pieces: Pieces,
        ending: Ending,
        (drift, followed): (Option<crate::drift::Drift>, Option<&Follow>),
    ) -> Run {
        let ended_early = !ending.finished && !ending.interrupted;
        let Pieces {
            solutions: pieces,
            watched,
            crossings,
        } = pieces;
        let mut run = Run {
            formulation,
            method: pieces.first().map_or("", |s| s.method),
            layout,
            own,
            times: Vec::new(),
            rows: Vec::new(),
            t: pieces.last().map_or(self.start.t, |s| s.t),
            ending,
            statistics: Statistics::default(),
            chart_changes: Vec::new(),
            notes: Vec::new(),
            kept: None,
            drift,
            followed: followed.map_or(Vec::new(), |f| f.finish(ended_early)),
            ends_between: false,
            events: Vec::new(),
            precise: None,
            crossings,
            scales: self.scales(settings).of_state(),
        };
        for piece in pieces {
            run.times.extend(&piece.times);
            run.rows.extend(&piece.rows);
            run.chart_changes.extend(&piece.chart_changes);
            run.notes.extend(happening::notes(&piece.notes, watched));
            run.events
                .extend(happening::happened(&piece.events, watched));
            add(&mut run.statistics, &piece.statistics);
        }
        let last = run.times.last();
        run.ends_between = last.is_some_and(|t| !settings.times.contains(t));
        run
    }
}

pub(crate) fn add(total: &mut Statistics, part: &Statistics) {
    total.steps += part.steps;
    total.rejected += part.rejected;
    total.failed += part.failed;
    total.evaluations += part.evaluations;
    total.factorizations += part.factorizations;
    total.chart_switches += part.chart_switches;
    total.modifications += part.modifications;
}

impl Subject<'_> {
    /// The final (q, v) of Routh's equations by fixed steps of magnitude h; `None` when the run does not get there.
    pub fn routh_fixed(&self, settings: &RunSettings, h: f64) -> Option<Vec<f64>> {
        let watch = Watch::new(
            self.system,
            self.terms,
            self.binding,
            self.selection.rows.len(),
        )
        .ok()?;
        let mut flow = MultiplierFlow::new(
            self.numeric.clone(),
            self.start,
            self.variables(settings),
            watch,
        );
        let y0 = flow.pack(&self.start.q, &self.start.v);
        let mut options = Options::fixed_step(method(&settings.method).ok()?, h);
        // The order of a series follows from the tolerance.
        options.error = ErrorControl::uniform(settings.tolerance);
        options.output = Output::End;
        options.step_limit = 10_000;
        let span = (self.start.t, settings.t_end);
        let solution = integrate(&mut flow, span, &y0, &mut [], options).ok()?;
        let layout = flow.layout();
        let row = solution.rows.get(..layout.v().end)?;
        (solution.stop == Stop::Finished).then(|| row.to_vec())
    }
}
