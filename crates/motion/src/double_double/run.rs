//! A run in double-double arithmetic, and why it ended.

use super::flow::PreciseFlow;
use super::start::ROUNDED;
use super::{rounded, Precise, PreciseRows};
use crate::course::Pieces;
use crate::multiplier_flow::StateKind;
use crate::run::{Run, RunError, RunSettings, Subject, Watcher};
use crate::stop::{self, Ending};
use chetaev_integrate::double_double::{
    integrate, PreciseEvent, PreciseOptions, PreciseSolution, LEAST_TOLERANCE,
};
use chetaev_integrate::{method, Direction, EventRecord, IntegrateError, Solution, Stop};
use chetaev_mechanics::claims::formulation::REFERENCE;
use chetaev_mechanics::Formulation;

/// Residuals far below the tolerance do no harm; each projection rounds the state.
const HARMLESS: f64 = 0.1;

/// The part of the state up to which residuals are left.
pub(super) fn bound(settings: &RunSettings) -> f64 {
    let tolerance = match settings.step {
        Some(_) => 0.0,
        None => settings.tolerance.min(settings.absolute_tolerance),
    };
    (HARMLESS * tolerance).max(ROUNDED)
}

fn refused(what: String, fix: &'static str) -> RunError {
    RunError::NotPrecise { what, fix }
}

impl Subject<'_> {
    /// Integrates Routh's equations for all velocities in double-double arithmetic.
    ///
    /// # Errors
    /// [`RunError`]; [`RunError::NotPrecise`] for what is done in doubles only.
    pub(crate) fn precisely(
        &self,
        formulation: &'static dyn Formulation,
        (settings, precise): (&RunSettings, &Precise),
        watcher: &mut Watcher<'_>,
    ) -> Result<Run, RunError> {
        self.check_precise(formulation, settings)?;
        let mut flow = PreciseFlow::new(self, settings, precise)?;
        let y = flow.begin(self, settings, precise)?;
        let own = flow.watch.quantities.len();
        let events = events(own, settings);
        let looking = self.looking(settings, &[])?;
        let options = PreciseOptions {
            rtol: settings.tolerance,
            atol: settings.absolute_tolerance,
            absolute: looking.absolute(y.len()),
            step: settings.step,
            times: precise.times.clone(),
            step_limit: settings.max_steps,
            interrupt: watcher.interrupt,
            progress: watcher.progress.as_mut().map(|report| &mut **report as _),
        };
        let span = (precise.t_start, precise.t_end);
        let solution = integrate(&mut flow, span, &y, &events, options)?;
        let ending = self.precise_ending(&solution, &mut flow, settings);
        Ok(self.precise_run(solution, &flow, (settings, precise), (own, ending)))
    }

    /// Refuses what is integrated in doubles only.
    fn check_precise(
        &self,
        formulation: &'static dyn Formulation,
        settings: &RunSettings,
    ) -> Result<(), RunError> {
        let name = formulation.card().name;
        let card = method(&settings.method)?.card();
        if !card.needs_series {
            let what = format!("the method `{}`", card.name);
            return Err(refused(what, "take the method `taylor`"));
        }
        if name != REFERENCE {
            let what = format!("the formulation `{name}`");
            return Err(refused(
                what,
                "leave the formulation out, which takes `routh`",
            ));
        }
        if self.terms.order > 1 {
            let what = "a system with constraints of order two or more".to_string();
            return Err(refused(what, "leave the precision out"));
        }
        if self.numeric.jumps {
            let what = "a constraint that jumps (atan2, sign, abs)".to_string();
            return Err(refused(
                what,
                "state it without the jump, or leave the precision out",
            ));
        }
        if !settings.keep.is_empty() {
            let what = "keeping integrals by projection".to_string();
            return Err(refused(what, "leave `keep_integrals` out"));
        }
        let requested = settings.tolerance.min(settings.absolute_tolerance);
        match requested < LEAST_TOLERANCE {
            true => Err(IntegrateError::PreciseToleranceTooSmall { requested }.into()),
            false => Ok(()),
        }
    }

    /// Why the run ended, in words.
    fn precise_ending(
        &self,
        solution: &PreciseSolution,
        flow: &mut PreciseFlow,
        settings: &RunSettings,
    ) -> Ending {
        let (watched, constraints) = (flow.watch.quantities.clone(), &self.numeric.constraints);
        let stop = &solution.stop;
        match *stop {
            Stop::Event { index, t } => match index.checked_sub(watched.len()) {
                Some(number) => return stop::happened(&settings.events[number].name, t),
                None => return stop::vanished(&watched[index], t, constraints),
            },
            Stop::Singular { t, .. }
            | Stop::NotFinite { t, .. }
            | Stop::StepTooSmall { t, .. }
            | Stop::Divergence { singularity: t, .. } => {
                let a = flow.accelerations(solution.t, &solution.state);
                let y = rounded(&solution.state);
                let (q, v) = y.split_at(self.numeric.positions());
                if let Some((index, t)) = flow.watch.lost_mass((t, Some(t)), q, v, &a) {
                    return stop::vanished(&watched[index], t, constraints);
                }
            }
            _ => {}
        }
        let chart = &self.start.chart;
        let names = stop::Names {
            coordinates: &self.numeric.coordinates,
            constraints,
            state: stop::component_names(self.numeric, StateKind::Full, chart),
            unknowns: None,
            matrix: None,
        };
        stop::ending(stop, &names, 1.0)
    }

    fn precise_run(
        &self,
        solution: PreciseSolution,
        flow: &PreciseFlow,
        (settings, precise): (&RunSettings, &Precise),
        (own, ending): (usize, Ending),
    ) -> Run {
        let followed = flow.deviations(!ending.finished && !ending.interrupted);
        let drift = (self.numeric.r > 0).then(|| flow.drift.clone());
        let piece = in_doubles(&solution, flow.layout.len());
        let layout = (flow.layout, Vec::new());
        let pieces = Pieces {
            solutions: vec![piece],
            watched: own,
            crossings: Vec::new(),
        };
        let run = self.collect(REFERENCE, layout, settings, pieces, ending, (drift, None));
        let met = solution.events.into_iter().filter(|met| met.index >= own);
        let rows = PreciseRows {
            parameters: precise.parameters.clone(),
            t: solution.t,
            times: solution.times,
            rows: solution.rows,
            events: met.map(|met| (met.t, met.row)).collect(),
        };
        Run {
            followed,
            precise: Some(rows),
            ..run
        }
    }
}

/// The events as the integrator takes them: what is watched first.
fn events(own: usize, settings: &RunSettings) -> Vec<PreciseEvent> {
    let watched = (0..own).map(|_| PreciseEvent {
        direction: Direction::Up,
        stops: true,
    });
    let stated = settings.events.iter().map(|event| PreciseEvent {
        direction: event.direction,
        stops: event.stops,
    });
    watched.chain(stated).collect()
}

/// The nearest doubles.
fn in_doubles(solution: &PreciseSolution, width: usize) -> Solution {
    let record = |met: &chetaev_integrate::double_double::PreciseEventRecord| EventRecord {
        t: met.t.high(),
        index: met.index,
        kind: met.kind,
        row: rounded(&met.row),
    };
    Solution {
        method: "taylor",
        stop: solution.stop,
        t: solution.t.high(),
        state: rounded(&solution.state),
        times: rounded(&solution.times),
        width,
        rows: rounded(&solution.rows),
        events: solution.events.iter().map(record).collect(),
        chart_changes: Vec::new(),
        notes: solution.notes.clone(),
        statistics: solution.statistics,
        trajectory: None,
    }
}
