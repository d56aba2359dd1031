//! The loop over the steps.

use super::events::{Events, Step};
use super::expansion::Series;
use super::{check, PreciseEvent, PreciseOptions, PreciseSolution, PreciseSystem};
use crate::collapse::Collapse;
use crate::integrate::Progress;
use crate::method::State;
use crate::problem::EvaluationFailure;
use crate::solution::{Statistics, Stop};
use crate::IntegrateError;
use chetaev_double_double::DoubleDouble;
use std::ops::ControlFlow;
use std::sync::atomic::Ordering;

/// Steps shorter than this part of the time cannot be made.
const SHORTEST: f64 = 16.0 * DoubleDouble::EPSILON;
/// A rest of the span up to this part longer than the step is made in one.
const NEARLY: f64 = 1.0 + 1e-12;

/// Integrates `system` over the span from the state `y`, forward or backward in time; `events` are zeros of the switching
/// functions of the system, by their number.
///
/// # Errors
/// [`IntegrateError`] if the question makes no sense: wrong lengths, values that are not finite, a tolerance below
/// [`LEAST_TOLERANCE`](super::LEAST_TOLERANCE), times out of order. Everything that happens later is a [`Stop`] in the solution.
pub fn integrate(
    system: &mut dyn PreciseSystem,
    span: (DoubleDouble, DoubleDouble),
    y: &[DoubleDouble],
    events: &[PreciseEvent],
    options: PreciseOptions<'_>,
) -> Result<PreciseSolution, IntegrateError> {
    let expected = system.dimension();
    if y.len() != expected {
        return Err(IntegrateError::Dimension {
            what: "the initial state",
            expected,
            found: y.len(),
        });
    }
    check(&options, span, y)?;
    let mut events = Events::new(events, &options);
    let mut running = Running {
        series: Series::new(expected),
        collapse: Collapse::new(span.0.high(), expected),
        to: vec![DoubleDouble::ZERO; expected],
        slope: vec![DoubleDouble::ZERO; expected],
        next: 0,
        solution: PreciseSolution {
            stop: Stop::Finished,
            t: span.0,
            state: y.to_vec(),
            times: Vec::new(),
            rows: Vec::new(),
            events: Vec::new(),
            notes: Vec::new(),
            statistics: Statistics::default(),
        },
        options,
        span,
    };
    running.go(system, &mut events);
    let mut solution = running.solution;
    solution.statistics.evaluations = running.series.evaluations;
    Ok(solution)
}

/// A run on the way.
struct Running<'o> {
    options: PreciseOptions<'o>,
    span: (DoubleDouble, DoubleDouble),
    series: Series,
    /// What tells a singularity of the motion from a tolerance out of reach.
    collapse: Collapse,
    /// State and derivative at the end of a step.
    to: Vec<DoubleDouble>,
    slope: Vec<DoubleDouble>,
    /// The next of the times asked for.
    next: usize,
    solution: PreciseSolution,
}

impl Running<'_> {
    fn go(&mut self, system: &mut dyn PreciseSystem, events: &mut Events<'_>) {
        let ended = match self.rows_here(system) {
            Ok(()) => self.steps(system, events),
            Err(stop) => stop,
        };
        self.solution.stop = ended;
        let is_known = self.solution.times.last() == Some(&self.solution.t);
        if ended != Stop::Finished && !is_known {
            // The state of an early end is kept where it has a row.
            let _ = self.row(system, self.solution.t, &self.solution.state.clone());
        }
    }

    fn steps(&mut self, system: &mut dyn PreciseSystem, events: &mut Events<'_>) -> Stop {
        while self.solution.t != self.span.1 {
            let t = self.solution.t.high();
            if self.solution.statistics.steps >= self.options.step_limit {
                let limit = self.options.step_limit;
                return Stop::StepLimit { t, limit };
            }
            if self.is_interrupted() {
                return Stop::Interrupted { t };
            }
            if let Err(stop) = self.step(system, events) {
                return stop;
            }
        }
        Stop::Finished
    }

    /// Whether the run is to end here; tells how far it has come.
    fn is_interrupted(&mut self) -> bool {
        let raised = |flag: &std::sync::atomic::AtomicBool| flag.load(Ordering::Relaxed);
        let progress = Progress {
            t: self.solution.t.high(),
            t_start: self.span.0.high(),
            t_end: self.span.1.high(),
            steps: self.solution.statistics.steps,
        };
        let is_broken = match &mut self.options.progress {
            Some(report) if progress.steps > 0 => report(progress) == ControlFlow::Break(()),
            _ => false,
        };
        is_broken || self.options.interrupt.is_some_and(raised)
    }

    /// One accepted step.
    fn step(
        &mut self,
        system: &mut dyn PreciseSystem,
        events: &mut Events<'_>,
    ) -> Result<(), Stop> {
        let (t, y) = (self.solution.t, self.solution.state.clone());
        let failed = |failure| stopped(t.high(), failure);
        self.series
            .expand(system, (t, &y), &self.options)
            .map_err(failed)?;
        let h = self.accepted_length(system)?;
        let mut end = t + h;
        if h == self.span.1 - t {
            end = self.span.1;
        }
        let mut reached = self.to.clone();
        let mut step = Step {
            system,
            t,
            h,
            is_last: end == self.span.1,
            series: &self.series,
            y: &mut self.to,
            slope: &mut self.slope,
        };
        let found = events.within(&mut step, &mut self.solution.notes);
        let stop = found.last().and_then(|(theta, record)| {
            let is_last = events.stops(record);
            is_last.then_some((*theta, record.t, record.index))
        });
        if let Some((theta, at, _)) = stop {
            end = at;
            self.series.at(h * theta, &mut reached, &mut self.slope);
        }
        self.rows_within(system, (t, end))?;
        self.solution
            .events
            .extend(found.into_iter().map(|(_, record)| record));
        self.solution.statistics.steps += 1;
        let changes = reached
            .iter()
            .zip(&y)
            .map(|(&to, &from)| (to - from).high());
        let (there, length) = (rounded(&reached), (end - t).high());
        self.collapse.changed((end.high(), &there), changes, length);
        if system.accepted(end, &mut reached) {
            self.solution.statistics.modifications += 1;
        }
        (self.solution.t, self.solution.state) = (end, reached);
        self.rows_here(system)?;
        match stop {
            Some((_, at, index)) => Err(Stop::Event {
                t: at.high(),
                index,
            }),
            None => Ok(()),
        }
    }

    /// The length of a step whose end is as the series says, which lies in `to` and `slope`.
    fn accepted_length(&mut self, system: &mut dyn PreciseSystem) -> Result<DoubleDouble, Stop> {
        let t = self.solution.t;
        let rest = self.span.1 - t;
        let mut size = self.options.step.unwrap_or(self.series.radius);
        self.collapse.rejected(self.series.worst);
        loop {
            let h = match size * NEARLY >= rest.high().abs() {
                true => rest,
                false => DoubleDouble::from(size.copysign(rest.high())),
            };
            let shortest = SHORTEST * t.high().abs().max(1e-12 * rest.high().abs());
            if h.high().abs() < shortest && h != rest {
                let now = State::exact(t.high(), &rounded(&self.solution.state));
                return Err(self.collapse.stop(&now, h.high()));
            }
            self.series.at(h, &mut self.to, &mut self.slope);
            if self.options.step.is_some() {
                return Ok(h);
            }
            let ends = (&self.to[..], &self.slope[..]);
            let at = (t + h, h.high());
            match self.series.defect(system, at, ends, &self.options) {
                Ok((defect, _)) if defect <= 1.0 => return Ok(h),
                Ok((_, component)) => {
                    self.solution.statistics.rejected += 1;
                    self.collapse.rejected(component);
                }
                Err(failure) => {
                    self.solution.statistics.failed += 1;
                    self.collapse.failed(failure);
                }
            }
            size = h.high().abs() / 2.0;
        }
    }

    /// Whether another time was asked for between here and `end`, or at it.
    fn is_due(&self, end: DoubleDouble, or_at_end: bool) -> Option<DoubleDouble> {
        let &time = self.options.times.get(self.next)?;
        let is_backward = self.span.1 < self.span.0;
        let is_before = if is_backward { time > end } else { time < end };
        (is_before || or_at_end && time == end).then_some(time)
    }

    /// The rows asked for inside a step.
    fn rows_within(
        &mut self,
        system: &mut dyn PreciseSystem,
        (start, end): (DoubleDouble, DoubleDouble),
    ) -> Result<(), Stop> {
        let mut y = self.to.clone();
        while let Some(time) = self.is_due(end, false) {
            self.series.at(time - start, &mut y, &mut self.slope);
            self.row(system, time, &y)?;
            self.next += 1;
        }
        Ok(())
    }

    /// The rows asked for at the present time.
    fn rows_here(&mut self, system: &mut dyn PreciseSystem) -> Result<(), Stop> {
        let (t, y) = (self.solution.t, self.solution.state.clone());
        while self.is_due(t, true).is_some() {
            self.row(system, t, &y)?;
            self.next += 1;
        }
        Ok(())
    }

    fn row(
        &mut self,
        system: &mut dyn PreciseSystem,
        t: DoubleDouble,
        y: &[DoubleDouble],
    ) -> Result<(), Stop> {
        let width = system.output_dimension();
        let start = self.solution.rows.len();
        self.solution.rows.resize(start + width, DoubleDouble::ZERO);
        let row = &mut self.solution.rows[start..];
        match system.output(t, y, row) {
            Ok(()) => {
                self.solution.times.push(t);
                Ok(())
            }
            Err(failure) => {
                self.solution.rows.truncate(start);
                Err(stopped(t.high(), failure))
            }
        }
    }
}

fn rounded(y: &[DoubleDouble]) -> Vec<f64> {
    y.iter().map(|y| y.high()).collect()
}

/// The end of a run for a failure that no shorter step avoids.
fn stopped(t: f64, failure: EvaluationFailure) -> Stop {
    match failure {
        EvaluationFailure::NotFinite { component } => Stop::NotFinite { t, component },
        failure => Stop::Singular { t, failure },
    }
}
