//! The loop of a run: attempt, locate events, record, commit, call the hooks.
//!
//! The system and the events are handed in at every call, so that several runs may go on in turns. Inside, an early end is
//! `Err(Stop)`, so that `?` leads out of the loop; [`Stepping::advance`] keeps it.

use std::ops::ControlFlow;
use std::sync::atomic::Ordering;

use crate::collapse::Collapse;
use crate::compensated::Time;
use crate::control::least_step;
use crate::crowd::Crowd;
use crate::dense::{DenseStep, Trajectory};
use crate::event::Event;
use crate::integrate::{Options, Progress, StepSize};
use crate::locate::Locator;
use crate::method::{Attempt, State, Stepper};
use crate::output::Schedule;
use crate::problem::{Control, EvaluationFailure, System};
use crate::solution::{Note, Solution, Statistics, Stop};
use crate::stiffness::{Detector, StiffnessPolicy};

/// Failed attempts are repeated with a step shorter by this factor.
const RETRY: f64 = 0.25;

/// A series that a run asks its system for ([`System::expand`]).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Expansion<'s> {
    /// The time.
    pub t: f64,
    /// The state, rounded.
    pub y: &'s [f64],
    /// What the rounding leaves out.
    pub carry: &'s [f64],
    /// The highest order.
    pub order: usize,
    /// Whether all its coefficients will be asked for, and not only what the end of the step needs.
    pub is_whole: bool,
}

/// One run at work, step by step, always of the same system and events. All storage is made before the first step; later only
/// rows, events and notes grow.
pub struct Stepping<'o> {
    /// Why the run ended, once it has; `None` as well before the method was started.
    stop: Option<Stop>,
    begun: bool,
    has_events: bool,
    options: Options<'o>,
    schedule: Schedule,
    span: (f64, f64),
    direction: f64,
    stepper: Box<dyn Stepper>,
    locator: Locator,
    /// Start of the present step.
    now: State,
    /// End of the present step.
    next: State,
    dense: DenseStep,
    /// Whether `dense` holds the polynomial of the step from `now` to `next`.
    dense_ready: bool,
    /// Signed length of the next attempt.
    h: f64,
    /// The state was changed from outside: the stepper has to restart.
    changed: bool,
    /// Whether the system was already asked for another chart at this starting point.
    repivoted: bool,
    collapse: Collapse,
    crowd: Crowd,
    /// Time when the steps were last seen to get on.
    got_on: Time,
    detector: Detector,
    point: Vec<f64>,
    before_hook: Vec<f64>,
    factorizations_before: u64,
    solution: Solution,
}

/// Where the rounding of the time is more than this part of a step, steps end at floats: forces are asked for at floats only.
const LATE: f64 = 1e-10;
/// So many accepted steps must get on by more than this part of the span: at that rate the rest would take 10¹¹.
const CREEPING_STEPS: u64 = 100_000;
const CREEPING: f64 = 1e-6;

impl std::fmt::Debug for Stepping<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Stepping")
            .field("now", &self.now)
            .field("stop", &self.stop)
            .finish_non_exhaustive()
    }
}

impl<'o> Stepping<'o> {
    pub(crate) fn checked(
        system: &dyn System,
        span: (f64, f64),
        y0: &[f64],
        events: &mut [Event<'_>],
        options: Options<'o>,
        schedule: Schedule,
    ) -> Self {
        let n = y0.len();
        let method = options.method;
        let width = system.output_dimension();
        for event in events.iter_mut() {
            event.count = 0;
        }
        Stepping {
            stop: None,
            begun: false,
            has_events: !events.is_empty(),
            direction: if span.1 < span.0 { -1.0 } else { 1.0 },
            stepper: method.stepper(n, &options.settings()),
            locator: Locator::new(n, events.len(), &options),
            now: State::exact(span.0, y0),
            next: State::exact(span.0, y0),
            dense: DenseStep::new(n),
            dense_ready: false,
            h: 0.0,
            changed: false,
            repivoted: false,
            collapse: Collapse::new(span.0, n),
            crowd: Crowd::new(events.len()),
            got_on: Time::exact(span.0),
            detector: Detector::new(),
            point: vec![0.0; n],
            before_hook: vec![0.0; n],
            factorizations_before: system.factorizations(),
            solution: Solution {
                method: method.card().name,
                stop: Stop::Finished,
                t: span.0,
                state: y0.to_vec(),
                times: Vec::new(),
                width,
                rows: Vec::new(),
                events: Vec::new(),
                chart_changes: Vec::new(),
                notes: Vec::new(),
                statistics: Statistics::default(),
                trajectory: options.keep_trajectory.then(|| Trajectory::new(n)),
            },
            options,
            schedule,
            span,
        }
    }

    /// Prepares the method at the first call, and makes one accepted step at every later one; false when the run has ended.
    pub fn advance(&mut self, system: &mut dyn System, events: &mut [Event<'_>]) -> bool {
        if self.stop.is_none() {
            let outcome = match std::mem::replace(&mut self.begun, true) {
                false => self.begin(system),
                true => self.step(system, events),
            };
            self.stop = outcome.err();
        }
        self.stop.is_none()
    }

    /// The solution as far as the run has come; an interruption where it has not ended.
    pub fn finish(mut self, system: &mut dyn System) -> Solution {
        let t = self.now.t.high;
        let stop = self.stop.take().unwrap_or(Stop::Interrupted { t });
        self.close(system, stop)
    }

    /// How far the run has come.
    pub fn progress(&self) -> Progress {
        Progress {
            t: self.now.t.high,
            t_start: self.span.0,
            t_end: self.span.1,
            steps: self.solution.statistics.steps,
        }
    }

    /// The expansion that the next call of [`advance`](Stepping::advance) asks the system for first, where it is known that
    /// one is.
    pub fn next_expansion(&mut self) -> Option<Expansion<'_>> {
        if self.stop.is_some() {
            return None;
        }
        let order = self.stepper.next_expansion(&self.now, self.changed)?;
        Some(Expansion {
            t: self.now.t.high,
            y: &self.now.y,
            carry: &self.now.carry,
            order,
            is_whole: self.has_events || self.options.keep_trajectory || self.dense_ready,
        })
    }

    /// Takes the expansion announced by [`next_expansion`](Stepping::next_expansion), which was made elsewhere: `row` writes the
    /// coefficients of an order j ≥ 1, all of which are finite. The signed length of the step that comes next, where there is one.
    ///
    /// What is taken has to be what the system would give, to the bit; then so is the run.
    pub fn take_series(&mut self, row: &dyn Fn(usize, &mut [f64])) -> Option<f64> {
        self.stepper.take_series(row);
        let (h, _) = self.choose_step().ok()?;
        Some(self.stepper.limited(&self.now, h))
    }

    /// Takes what that series gives at the end of the step of length `h`: the increment of the state and the derivative. The
    /// expansion of order 1, at that end, which is asked for next.
    pub fn take_end(&mut self, h: f64, increment: &[f64], slope: &[f64]) -> Expansion<'_> {
        let states = (&self.now, &mut self.next);
        self.stepper.take_end(states, h, (increment, slope));
        Expansion {
            t: self.next.t.high,
            y: &self.next.y,
            carry: &self.next.carry,
            order: 1,
            is_whole: true,
        }
    }

    /// Records the initial state and prepares the method.
    fn begin(&mut self, system: &mut dyn System) -> Result<(), Stop> {
        if self.schedule.with_first() {
            self.record_state(system, false)?;
        } else {
            self.record_scheduled_here(system)?;
        }
        let span = (self.span.1 - self.span.0).abs();
        if span == 0.0 {
            return Err(Stop::Finished);
        }
        let first = loop {
            let start = self.stepper.start(system, &self.now, self.direction, span);
            match start {
                Ok(first) => break first,
                Err(failure) if self.repivot(system, &failure)? => self.changed = false,
                Err(failure) => return Err(self.failed_at_state(failure)),
            }
        };
        self.h = self.direction
            * match self.options.step {
                StepSize::Fixed(h) => h,
                StepSize::Adaptive { first: given, .. } => given.unwrap_or(first),
            };
        Ok(())
    }

    /// Makes one accepted step.
    fn step(&mut self, system: &mut dyn System, events: &mut [Event<'_>]) -> Result<(), Stop> {
        self.check_limits()?;
        if self.changed {
            self.changed = false;
            if let Err(failure) = self.stepper.restart(system, &self.now) {
                return Err(self.failed_at_state(failure));
            }
        }
        let attempt = self.attempt_until_accepted(system)?;
        let ended_by = self.locate_events(system, events)?;
        let step = (self.now.t.high, self.now.t.until(self.next.t.high));
        let crowd = if self.has_events {
            self.crowd.after(step, &self.solution.events)
        } else {
            None
        };
        self.record_inside(system)?;
        self.commit(&attempt, ended_by.is_some());
        self.call_accepted_hook(system, ended_by)?;
        self.record_end(system)?;
        if let Some(stop) = ended_by {
            return Err(stop);
        }
        if let Some((index, count)) = crowd {
            let t = self.now.t.high;
            return Err(Stop::Crowd { t, index, count });
        }
        if self.now.t.high == self.span.1 {
            return Err(Stop::Finished);
        }
        self.watch_stiffness(&attempt)
    }

    fn check_limits(&mut self) -> Result<(), Stop> {
        let progress = self.progress();
        let Progress { t, steps, .. } = progress;
        let raised = self
            .options
            .interrupt
            .is_some_and(|flag| flag.load(Ordering::Relaxed));
        let broken = match &mut self.options.progress {
            Some(callback) if steps > 0 => callback(progress) == ControlFlow::Break(()),
            _ => false,
        };
        if raised || broken {
            return Err(Stop::Interrupted { t });
        }
        if steps >= self.options.step_limit {
            return Err(Stop::StepLimit {
                t,
                limit: self.options.step_limit,
            });
        }
        self.check_progress(steps)
    }

    /// Steps that stay just above what the time resolves do not end by themselves, as those that rounding cuts short before
    /// a singularity.
    fn check_progress(&mut self, steps: u64) -> Result<(), Stop> {
        if steps == 0
            || !steps.is_multiple_of(CREEPING_STEPS)
            || matches!(self.options.step, StepSize::Fixed(_))
        {
            return Ok(());
        }
        let way = self.got_on.until(self.now.t.high).abs();
        self.got_on = self.now.t;
        match way < CREEPING * (self.span.1 - self.span.0).abs() {
            true => Err(self.collapse.stop(&self.now, self.h)),
            false => Ok(()),
        }
    }

    /// Signed length of the next attempt, and whether it ends the span.
    fn choose_step(&self) -> Result<(f64, bool), Stop> {
        let remaining = self.now.t.until(self.span.1);
        let most = match self.options.step {
            StepSize::Adaptive {
                most: Some(most), ..
            } => most,
            _ => f64::INFINITY,
        };
        let h = self.direction * self.h.abs().min(most);
        // A last step of less than a hundredth is merged with the one before it; fixed steps only absorb rounding.
        let stretch = match self.options.step {
            StepSize::Fixed(_) => 1.0 + 1e-9,
            StepSize::Adaptive { .. } => 1.01,
        };
        if stretch * h.abs() >= remaining.abs() && remaining.abs() <= stretch * most {
            return Ok((remaining, true));
        }
        let span = (self.span.1 - self.span.0).abs();
        if h.abs() < least_step(self.now.t.high, span) {
            return Err(self.collapse.stop(&self.now, h));
        }
        let is_late = f64::EPSILON * self.now.t.high.abs() > LATE * h.abs();
        match self.options.step {
            StepSize::Adaptive { .. } if is_late => Ok((self.now.t.to_float(h), false)),
            _ => Ok((h, false)),
        }
    }

    fn attempt_until_accepted(&mut self, system: &mut dyn System) -> Result<Attempt, Stop> {
        loop {
            let (h, last) = self.choose_step()?;
            self.dense_ready = false;
            match self.stepper.attempt(system, &self.now, h, &mut self.next) {
                Err(failure) => self.recover(system, h, failure)?,
                Ok(attempt) if !attempt.accepted => {
                    self.solution.statistics.rejected += 1;
                    self.collapse.rejected(attempt.worst);
                    self.h = attempt.next;
                }
                Ok(attempt) => {
                    if last && attempt.h == h {
                        self.next.t = Time::exact(self.span.1);
                    }
                    match self.prepare_dense(system) {
                        Ok(()) => return Ok(attempt),
                        Err(failure) => self.recover(system, h, failure)?,
                    }
                }
            }
        }
    }

    /// Makes the polynomial of the step if anybody will ask for it.
    fn prepare_dense(&mut self, system: &mut dyn System) -> Result<(), EvaluationFailure> {
        let inside = self
            .schedule
            .next()
            .is_some_and(|s| (self.next.t.high - s) * self.direction > 0.0);
        if inside || self.options.keep_trajectory || self.has_events {
            self.stepper
                .dense(system, &self.now, &self.next, &mut self.dense)?;
            self.dense_ready = true;
        }
        Ok(())
    }

    /// After a failed evaluation inside a step of length h: another chart at its start, or a shorter step.
    fn recover(
        &mut self,
        system: &mut dyn System,
        h: f64,
        failure: EvaluationFailure,
    ) -> Result<(), Stop> {
        self.solution.statistics.failed += 1;
        self.stepper.failed();
        self.collapse.failed(failure);
        if self.repivot(system, &failure)? {
            self.changed = false;
            return self
                .stepper
                .restart(system, &self.now)
                .map_err(|failure| self.failed_at_state(failure));
        }
        if matches!(self.options.step, StepSize::Fixed(_)) {
            return Err(self.failed_at_state(failure));
        }
        self.h = h * RETRY;
        Ok(())
    }

    /// Asks the system for another chart, at most once per starting point; says whether anything was changed.
    fn repivot(
        &mut self,
        system: &mut dyn System,
        failure: &EvaluationFailure,
    ) -> Result<bool, Stop> {
        let curable = matches!(
            failure,
            EvaluationFailure::PivotDegraded { .. } | EvaluationFailure::Singular { .. }
        );
        if self.repivoted || !curable {
            return Ok(false);
        }
        self.repivoted = true;
        self.before_hook.copy_from_slice(&self.now.y);
        let control = system.repivot(self.now.t.high, &mut self.now.y);
        self.apply(control)?;
        Ok(self.changed)
    }

    /// The stop for an evaluation that fails at the very state where the run stands.
    fn failed_at_state(&self, failure: EvaluationFailure) -> Stop {
        let t = self.now.t.high;
        match failure {
            EvaluationFailure::NotFinite { component } => Stop::NotFinite { t, component },
            failure => Stop::Singular { t, failure },
        }
    }

    /// Finds the events of the step. A terminal one cuts the step: `next` is then the state at the event.
    fn locate_events(
        &mut self,
        system: &mut dyn System,
        events: &mut [Event<'_>],
    ) -> Result<Option<Stop>, Stop> {
        if events.is_empty() {
            return Ok(None);
        }
        self.locator.locate(
            system,
            events,
            (&self.now, &mut self.next, &self.dense),
            self.span.1,
            &mut self.solution,
        )
    }

    /// Records the scheduled times strictly inside the step.
    fn record_inside(&mut self, system: &mut dyn System) -> Result<(), Stop> {
        while let Some(s) = self.schedule.next() {
            if (self.next.t.high - s) * self.direction <= 0.0 || !self.dense_ready {
                break;
            }
            let mut point = std::mem::take(&mut self.point);
            self.dense.at(s, &mut point);
            let outcome = self.record(system, s, &point);
            self.point = point;
            outcome?;
            self.schedule.advance();
        }
        Ok(())
    }

    /// Makes `next` the present state.
    fn commit(&mut self, attempt: &Attempt, cut: bool) {
        if let Some(trajectory) = &mut self.solution.trajectory {
            let switches = u32::try_from(self.solution.chart_changes.len()).unwrap_or(u32::MAX);
            trajectory.push(&self.dense, self.next.t.high, switches);
        }
        let step = self.now.t.until(self.next.t.high);
        self.collapse.accepted(&self.now, &self.next, step);
        std::mem::swap(&mut self.now, &mut self.next);
        self.solution.statistics.steps += 1;
        self.h = attempt.next;
        self.repivoted = false;
        if cut {
            self.changed = true;
        } else {
            self.stepper.commit();
        }
    }

    fn call_accepted_hook(
        &mut self,
        system: &mut dyn System,
        ended_by: Option<Stop>,
    ) -> Result<(), Stop> {
        self.before_hook.copy_from_slice(&self.now.y);
        let control = system.accepted(self.now.t.high, &mut self.now.y);
        match self.apply(control) {
            // A terminal event at the same state takes precedence over the hook.
            Err(_) if ended_by.is_some() => Ok(()),
            outcome => outcome,
        }
    }

    /// Carries out what a hook reports, after it may have changed `now.y` from `before_hook`.
    fn apply(&mut self, control: Control) -> Result<(), Stop> {
        let t = self.now.t.high;
        match control {
            Control::Continue => return Ok(()),
            Control::StateModified => self.solution.statistics.modifications += 1,
            Control::ChartSwitched(change) => {
                self.solution.statistics.chart_switches += 1;
                self.solution.chart_changes.push((t, change));
            }
            Control::Stop(reason) => return Err(Stop::Halted { t, reason }),
        }
        self.changed = true;
        // A component that the hook left alone keeps its compensation.
        for i in 0..self.now.y.len() {
            if self.now.y[i].to_bits() != self.before_hook[i].to_bits() {
                self.now.carry[i] = 0.0;
            }
        }
        Ok(())
    }

    /// Records the end of a step where it was asked for.
    fn record_end(&mut self, system: &mut dyn System) -> Result<(), Stop> {
        if self.schedule.every_step() {
            self.record_state(system, false)
        } else {
            self.record_scheduled_here(system)
        }
    }

    /// Records the present state once for each scheduled time that equals the present one.
    fn record_scheduled_here(&mut self, system: &mut dyn System) -> Result<(), Stop> {
        while self.schedule.next() == Some(self.now.t.high) {
            self.record_state(system, false)?;
            self.schedule.advance();
        }
        Ok(())
    }

    fn record_state(&mut self, system: &mut dyn System, unless_recorded: bool) -> Result<(), Stop> {
        if unless_recorded && self.solution.times.last() == Some(&self.now.t.high) {
            return Ok(());
        }
        let y = std::mem::take(&mut self.now.y);
        let outcome = self.record(system, self.now.t.high, &y);
        self.now.y = y;
        outcome
    }

    fn record(&mut self, system: &mut dyn System, t: f64, y: &[f64]) -> Result<(), Stop> {
        let start = self.solution.rows.len();
        self.solution.rows.resize(start + self.solution.width, 0.0);
        let outcome = system.output(t, y, &mut self.solution.rows[start..]);
        match outcome {
            Ok(()) => {
                self.solution.times.push(t);
                Ok(())
            }
            Err(failure) => {
                self.solution.rows.truncate(start);
                Err(Stop::Singular { t, failure })
            }
        }
    }

    fn watch_stiffness(&mut self, attempt: &Attempt) -> Result<(), Stop> {
        // Without an estimate no step was ever beyond the bound.
        let is_off = self.options.stiffness == StiffnessPolicy::Off;
        if is_off || attempt.stiffness.is_none() || !self.detector.step(attempt.stiffness) {
            return Ok(());
        }
        let t = self.now.t.high;
        let steps = self.solution.statistics.steps;
        let steps_ahead = (self.now.t.until(self.span.1) / attempt.h).abs().ceil();
        if !self.detector.noted {
            self.detector.noted = true;
            self.solution.notes.push(Note::Stiff {
                t,
                stability: attempt.stiffness.unwrap_or(1.0),
                h: attempt.h.abs(),
                steps_ahead,
            });
        }
        match self.options.stiffness {
            StiffnessPolicy::StopAfter(budget) if steps >= budget && steps_ahead > steps as f64 => {
                Err(Stop::Stiff {
                    t,
                    steps,
                    steps_ahead,
                })
            }
            _ => Ok(()),
        }
    }

    fn close(mut self, system: &mut dyn System, stop: Stop) -> Solution {
        let early = self.options.record_last && stop != Stop::Finished;
        if self.schedule.with_last() || early {
            // The output may fail where the run failed; the state itself is kept in any case.
            let _ = self.record_state(system, true);
        }
        let statistics = &mut self.solution.statistics;
        statistics.evaluations = self.stepper.evaluations() + self.locator.evaluations();
        statistics.factorizations = system.factorizations() - self.factorizations_before;
        self.solution.t = self.now.t.high;
        self.solution.state.copy_from_slice(&self.now.y);
        self.solution.stop = stop;
        self.solution
    }
}
