//! Routh's equations for many starts and many values of the parameters: derived and compiled once.

use crate::course::Course;
use crate::follow::Follow;
use crate::functions::FunctionsError;
use crate::keep::Keep;
use crate::multiplier_flow::{MultiplierFlow, StateKind};
use crate::numeric::{NumericSystem, States};
use crate::projection::Projection;
use crate::run::{End, Looking, Run, RunError, RunSettings, Subject, Watcher};
use crate::scales::Scales;
use crate::series::{self, RateSeries};
use crate::stop;
use crate::watch::Watch;
use chetaev_compile::ABREAST;
use chetaev_integrate::method;
use std::sync::atomic::AtomicBool;

/// Routh's equations with all that a run of them needs, compiled; a copy for each thread.
///
/// A run from it has the bits of [`Subject::routh`], whichever runs went before.
#[derive(Clone, Debug)]
pub struct CompiledRouth {
    pub(crate) flow: MultiplierFlow,
    pub(crate) looking: Looking,
    /// Whether the method asks for Taylor series.
    needs_series: bool,
    /// The states at which rates will be asked for.
    states: States,
}

impl CompiledRouth {
    /// Sets other values of the parameters, in the order of the binding.
    ///
    /// # Errors
    /// [`FunctionsError::Prepare`] where they make a linear system singular.
    pub fn set_parameters(&mut self, values: &[f64]) -> Result<(), FunctionsError> {
        self.flow.set_parameters(values)?;
        let mut observers = self.looking.observers.iter_mut();
        observers.try_for_each(|observer| observer.set_parameters(values))
    }

    /// How many runs gain by going on in turns, since their series can be made side by side.
    pub fn abreast(&self) -> usize {
        if self.needs_series {
            ABREAST
        } else {
            1
        }
    }

    /// A copy for another run, which shares the machine code of series.
    #[must_use]
    pub fn copy(&mut self) -> CompiledRouth {
        match self.needs_series {
            true => self.flow.share_series(self.states),
            false => self.flow.share_accelerations(),
        }
        self.clone()
    }

    /// The numeric system with the present parameters, to look for consistent states with.
    pub fn numeric(&mut self) -> &mut NumericSystem {
        self.flow.system_mut()
    }
}

impl Subject<'_> {
    /// Compiles Routh's equations, the watch on their singular set, events, and what is followed and kept; the start of the
    /// subject does not matter.
    ///
    /// # Errors
    /// [`RunError`].
    pub fn compile_routh(&self, settings: &RunSettings) -> Result<CompiledRouth, RunError> {
        let watch = Watch::new(
            self.system,
            self.terms,
            self.binding,
            self.selection.rows.len(),
        )?;
        let mut flow = MultiplierFlow::idle(self.numeric.clone(), watch);
        if self.rank_may_fall() {
            flow.follow_rank(self.selection.rows.len());
        }
        let residuals = self.residuals();
        if !settings.follow.is_empty() {
            let followed = [settings.follow.clone(), residuals.clone()].concat();
            let variables = &self.binding.variables;
            let follow = Follow::compile(self.system, self.binding, variables, &followed)?;
            flow.follow = Some(follow);
        }
        if !settings.keep.is_empty() {
            let quantities = (&residuals[..], &settings.keep[..]);
            flow.keep = Some(Keep::new(self.system, self.binding, quantities)?);
        }
        Ok(CompiledRouth {
            flow,
            looking: self.looking(settings, &[])?,
            needs_series: method(&settings.method)?.card().needs_series,
            states: match self.variables(settings) == StateKind::Full && self.numeric.r > 0 {
                true => Projection::of(settings).states(),
                false => States::Admissible,
            },
        })
    }

    /// Which variables are integrated. Independent velocities alone hide the error of the others, which is larger by the
    /// inverse of a pivot where a step comes near a singular place of their chart; and a step of the Taylor method is so long
    /// that it may pass one, while the series of all velocities are known anyway. So all velocities are integrated, and
    /// constraints are kept by projection. Those that jump are followed in charts.
    pub(crate) fn variables(&self, settings: &RunSettings) -> StateKind {
        let has_series = method(&settings.method).is_ok_and(|method| method.card().needs_series);
        let needs_all = has_series || !settings.keep.is_empty();
        match settings.state {
            _ if needs_all && !self.numeric.jumps => StateKind::Full,
            Some(stated) => stated,
            None if self.numeric.jumps => StateKind::Reduced,
            None => StateKind::Full,
        }
    }

    /// Integrates Routh's equations.
    ///
    /// # Errors
    /// [`RunError`] when the run cannot begin; what happens later is in [`Run::ending`].
    pub fn routh(
        &self,
        settings: &RunSettings,
        watcher: &mut Watcher<'_>,
    ) -> Result<Run, RunError> {
        let mut compiled = self.compile_routh(settings)?;
        self.routh_by(&mut compiled, settings, watcher)
    }

    /// Integrates Routh's equations, compiled before with the same settings but for times, span, tolerances and steps.
    ///
    /// # Errors
    /// As [`routh`](Subject::routh).
    pub fn routh_by(
        &self,
        compiled: &mut CompiledRouth,
        settings: &RunSettings,
        watcher: &mut Watcher<'_>,
    ) -> Result<Run, RunError> {
        let mut course = self.begin_routh(compiled, settings, watcher.interrupt);
        while course.advance((self, compiled), settings, watcher)? {}
        Ok(course.finish((self, compiled), settings))
    }

    /// The same, to be made step by step: with the same subject, what is compiled and settings at every step.
    pub fn begin_routh<'o>(
        &self,
        compiled: &mut CompiledRouth,
        settings: &RunSettings,
        interrupt: Option<&'o AtomicBool>,
    ) -> RouthCourse<'o> {
        let flow = &mut compiled.flow;
        flow.begin(
            self.start,
            self.variables(settings),
            Projection::of(settings),
        );
        let y0 = flow.pack(&self.start.q, &self.start.v);
        compiled.looking.scales = match settings.is_natural && flow.kind() == StateKind::Full {
            // Members of an ensemble differ in their parameters, which the flow has, and the subject has not.
            true => Scales::new(self.start, flow.system(), settings.t_end).of_state(),
            false => Vec::new(),
        };
        let flow = &mut compiled.flow;
        let watched = flow.watch.wanted();
        RouthCourse(Course::new(watched, (self.start.t, y0), interrupt))
    }
}

/// A run and what is compiled for it.
type Lane<'s, 'o> = (&'s mut RouthCourse<'o>, &'s mut CompiledRouth);

/// Makes the Taylor series of several runs at once, and what the ends of their steps need of them. A run has the same bits with it and without.
#[derive(Clone, Debug, Default)]
pub struct SideBySide {
    own: Option<series::SideBySide>,
    /// Whether there is no machine code for several.
    is_impossible: bool,
}

impl SideBySide {
    /// Makes what the next steps of these runs ask for; places without a run are `None`.
    pub fn look_ahead<'s, 'o: 's>(
        &mut self,
        runs: impl Iterator<Item = Option<(&'s mut RouthCourse<'o>, &'s mut CompiledRouth)>>,
    ) {
        if self.is_impossible {
            return;
        }
        let mut lanes: [Option<Lane<'_, '_>>; ABREAST] = Default::default();
        for (lane, run) in lanes.iter_mut().zip(runs) {
            *lane = run;
        }
        let lie_here = self.expand(&mut lanes);
        if let Some(own) = &mut self.own {
            finish_steps(own, &mut lanes, lie_here);
        }
    }

    /// Makes the series that the next steps ask for, and says of which of them steps can be made side by side.
    fn expand(&mut self, lanes: &mut [Option<Lane<'_, '_>>; ABREAST]) -> [bool; ABREAST] {
        let nowhere = [false; ABREAST];
        let mut motions: [Option<&mut RateSeries>; ABREAST] = Default::default();
        for (motion, lane) in motions.iter_mut().zip(lanes) {
            *motion = lane.as_mut().and_then(|(course, compiled)| {
                let asked = course.0.next_expansion();
                compiled.flow.announce(asked)
            });
        }
        if self.own.is_none() {
            let Some(first) = motions.iter().flatten().next() else {
                return nowhere;
            };
            self.own = series::SideBySide::of(first);
            self.is_impossible = self.own.is_none();
        }
        match &mut self.own {
            Some(own) => own.make(motions.into_iter()),
            None => nowhere,
        }
    }
}

/// The steps of those runs whose series lie side by side: how long they are, where they end, and the rates there.
fn finish_steps(
    own: &mut series::SideBySide,
    lanes: &mut [Option<Lane<'_, '_>>; ABREAST],
    lie_here: [bool; ABREAST],
) {
    let mut steps = [None; ABREAST];
    for (number, lane) in lanes.iter_mut().enumerate() {
        let lane = lane.as_mut().filter(|_| lie_here[number]);
        let stepping = lane.and_then(|(course, _)| course.0.stepping());
        steps[number] = stepping
            .and_then(|stepping| stepping.take_series(&|order, to| own.row(number, order, to)));
    }
    if steps.iter().all(Option::is_none) {
        return;
    }
    own.sum(steps.map(|step| step.unwrap_or(0.0)));
    for (number, lane) in lanes.iter_mut().enumerate() {
        let (Some(h), Some((course, compiled))) = (steps[number], lane) else {
            continue;
        };
        if let Some(stepping) = course.0.stepping() {
            let (increments, slopes) = own.end(number);
            let end = stepping.take_end(h, increments, slopes);
            compiled.flow.announce(Some(end));
        }
    }
    own.rates(lanes.iter_mut().map(|lane| match lane {
        Some((_, compiled)) => compiled.flow.announced(),
        None => None,
    }));
}

/// A run of Routh's equations on the way.
pub struct RouthCourse<'o>(Course<'o>);

impl std::fmt::Debug for RouthCourse<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("RouthCourse")
    }
}

impl RouthCourse<'_> {
    /// Makes one step, or begins; false when the run has ended.
    ///
    /// # Errors
    /// [`RunError`] when the run cannot begin.
    pub fn advance(
        &mut self,
        (subject, compiled): (&Subject<'_>, &mut CompiledRouth),
        settings: &RunSettings,
        watcher: &mut Watcher<'_>,
    ) -> Result<bool, RunError> {
        let CompiledRouth { flow, looking, .. } = compiled;
        self.0
            .advance((subject, flow), settings, (looking, watcher))
    }

    /// The motion as far as it was computed.
    pub fn finish(
        self,
        (subject, compiled): (&Subject<'_>, &mut CompiledRouth),
        settings: &RunSettings,
    ) -> Run {
        let flow = &mut compiled.flow;
        let (pieces, end) = self.0.finish();
        let ending = match end {
            End::Vanished(ending) | End::Happened(ending) => ending,
            End::Stopped(stop, t, y) => {
                let pivot = flow.pivot_ratio(t, &y);
                let (kind, chart) = (flow.kind(), flow.chart());
                let names = stop::Names {
                    coordinates: &subject.numeric.coordinates,
                    constraints: &subject.numeric.constraints,
                    state: stop::component_names(subject.numeric, kind, chart),
                    unknowns: None,
                    matrix: None,
                };
                stop::ending(&stop, &names, pivot)
            }
        };
        let measured = flow.kind() == StateKind::Full || !subject.numeric.holonomic.is_empty();
        let drift = (subject.numeric.r > 0 && measured).then(|| flow.drift.clone());
        let kept = flow.keep.as_ref().map(|keep| keep.report().clone());
        let run = subject.collect(
            "routh",
            (flow.layout(), Vec::new()),
            settings,
            pieces,
            ending,
            (drift, flow.follow.as_ref()),
        );
        Run { kept, ..run }
    }
}
