//! Search for the zeros of switching functions inside one step (theory: sample the dense output as closely as the function
//! asks for, bracket, refine, repeat the step exactly to the zero).
//!
//! The side of zero on which a switching function was last seen is remembered from step to step, so that a zero
//! that falls on the end of a step is found once and only once whatever the rounding.

use crate::compensated::Time;
use crate::dense::{Basis, DenseStep};
use crate::event::{Direction, Event, EventKind, EventRecord};
use crate::integrate::{Options, StepSize};
use crate::isolate::{Followed, Isolator};
use crate::method::{Method, State, Stepper, StepperSettings};
use crate::problem::{EvaluationFailure, Piece, System};
use crate::roots::{bracketed_zero, minimum};
use crate::sampling::{
    at_places, dips, early_size, ends_on_touch, ends_on_zero, is_pole, refine, Samples, NEAR, NODES,
};
use crate::solution::{Note, Solution, Stop};

/// Zeros closer than this many units in the last place of t are one.
const SAME: f64 = 10.0;

/// How far behind the start of a step its motion is followed, in units of the step.
const CLOSE_BEHIND: f64 = 0.1;

/// Part of a bracket at which a function is looked at beside the zero, to tell it from a pole.
const APART: f64 = 1e-9;

/// What is remembered of one switching function between steps.
#[derive(Debug, Clone, Copy)]
struct Memory {
    /// Sign last seen, 0 while it is unknown.
    side: f64,
    /// Largest magnitude seen.
    scale: f64,
    last_zero: f64,
    /// Time and value at the place before the end of the last step: a dip may lie at the end itself.
    before: Option<(f64, f64)>,
    /// Its values are unknown at present; the note was written.
    unknown: bool,
    /// It runs faster than it can be followed; the note was written.
    unresolved: bool,
}

/// A zero found in the present step.
#[derive(Debug, Clone, Copy)]
struct Candidate {
    theta: f64,
    index: usize,
    kind: EventKind,
}

/// Working storage of the search.
pub(crate) struct Locator {
    method: &'static dyn Method,
    settings: StepperSettings,
    /// Makes the steps that end at an event; created with the first event.
    stepper: Option<Box<dyn Stepper>>,
    /// Relative accuracy of the trajectory, below which a touch and a crossing cannot be told apart.
    resolution: f64,
    memories: Vec<Memory>,
    /// Values at the nodes of each switching function, or why there are none.
    samples: Vec<Result<Samples, EvaluationFailure>>,
    /// Places and values of the function searched.
    points: Vec<(f64, f64)>,
    isolator: Isolator,
    /// Places that tell its zeros apart.
    places: Vec<f64>,
    candidates: Vec<Candidate>,
    y: Vec<f64>,
    /// State at the event being refined.
    state: State,
}

/// One step, as the search sees it.
#[derive(Clone, Copy)]
struct Step<'a> {
    now: &'a State,
    dense: &'a DenseStep,
    /// End of the step; exactly the end of the span in the last one.
    end: Time,
    last: bool,
}

impl Step<'_> {
    fn time(&self, theta: f64) -> f64 {
        if theta == 1.0 {
            self.end.high
        } else {
            self.now.t.plus(theta * self.dense.h).high
        }
    }

    /// One unit in the last place of t, in units of the step.
    fn ulp(&self) -> f64 {
        f64::EPSILON * self.end.high.abs().max(self.now.t.high.abs()) / self.dense.h.abs()
    }
}

/// A switching function along one step.
struct Along<'s, 'e> {
    system: &'s mut dyn System,
    event: &'s mut Event<'e>,
    step: Step<'s>,
    y: &'s mut Vec<f64>,
}

impl Followed for Along<'_, '_> {
    fn series(&mut self, piece: Piece<'_>, series: &mut [f64]) -> bool {
        self.event.series(self.system, piece, series)
    }

    fn value(&mut self, theta: f64) -> Result<f64, EvaluationFailure> {
        self.step.dense.at_theta(theta, self.y);
        let t = self.step.time(theta);
        self.event.value(self.system, t, self.y)
    }
}

impl Locator {
    pub(crate) fn new(n: usize, events: usize, options: &Options<'_>) -> Locator {
        let mut settings = options.settings();
        settings.fixed = true;
        settings.stiffness = false;
        let resolution = match options.step {
            StepSize::Fixed(_) => 1e-10,
            StepSize::Adaptive { .. } => 10.0 * options.error.rtol + 100.0 * f64::EPSILON,
        };
        let memory = Memory {
            side: 0.0,
            scale: 0.0,
            last_zero: f64::NAN,
            before: None,
            unknown: false,
            unresolved: false,
        };
        Locator {
            method: options.method,
            settings,
            stepper: None,
            resolution,
            memories: vec![memory; events],
            samples: vec![Ok([0.0; NODES.len()]); events],
            points: Vec::new(),
            isolator: Isolator::default(),
            places: Vec::new(),
            candidates: Vec::new(),
            y: vec![0.0; n],
            state: State::exact(0.0, &vec![0.0; n]),
        }
    }

    /// Evaluations made for steps that end at an event.
    pub(crate) fn evaluations(&self) -> u64 {
        self.stepper.as_ref().map_or(0, |s| s.evaluations())
    }

    /// Finds and records the zeros in the step from `now` to `next`; a terminal one becomes the new `next`, and its
    /// stop is returned.
    pub(crate) fn locate(
        &mut self,
        system: &mut dyn System,
        events: &mut [Event<'_>],
        (now, next, dense): (&State, &mut State, &DenseStep),
        t_end: f64,
        solution: &mut Solution,
    ) -> Result<Option<Stop>, Stop> {
        let step = Step {
            now,
            dense,
            end: next.t,
            last: next.t.high == t_end,
        };
        self.candidates.clear();
        self.sample(system, events, step);
        for (index, event) in events.iter_mut().enumerate() {
            match self.search(system, event, index, step) {
                Ok(shown) => self.note_resolution(index, shown, step, solution),
                Err(failure) => self.forget(index, step, failure, solution),
            }
        }
        let order =
            |a: &Candidate, b: &Candidate| a.theta.total_cmp(&b.theta).then(a.index.cmp(&b.index));
        self.candidates.sort_by(order);
        let mut restarted = false;
        let mut stop: Option<(f64, Stop)> = None;
        for c in 0..self.candidates.len() {
            let candidate = self.candidates[c];
            let event = &mut events[candidate.index];
            if !counts(event.direction, candidate.kind) {
                continue;
            }
            step.dense.at_theta(candidate.theta, &mut self.y);
            if !event.matters(system, step.time(candidate.theta), &self.y) {
                continue;
            }
            match stop {
                // What happens at the same time as the end is recorded, in whatever order they are stated.
                Some((theta, _)) if candidate.theta > theta + SAME * step.ulp() => break,
                Some(_) => {}
                None => self.refine(system, event, (step, next), candidate, &mut restarted),
            }
            if self.record(system, candidate, solution)? {
                event.count += 1;
                if event.count == event.stop_at && stop.is_none() {
                    next.clone_from(&self.state);
                    let (t, index) = (next.t.high, candidate.index);
                    stop = Some((candidate.theta, Stop::Event { t, index }));
                }
            }
        }
        Ok(stop.map(|(_, stop)| stop))
    }

    /// Values at the nodes, all functions at one node after the other: a system that computes several of them from the
    /// same state may remember it.
    fn sample(&mut self, system: &mut dyn System, events: &mut [Event<'_>], step: Step<'_>) {
        self.samples.fill(Ok([0.0; NODES.len()]));
        for (i, theta) in NODES.into_iter().enumerate() {
            step.dense.at_theta(theta, &mut self.y);
            let t = step.time(theta);
            for (event, samples) in events.iter_mut().zip(&mut self.samples) {
                if let Ok(values) = samples {
                    match event.value(system, t, &self.y) {
                        Ok(value) => values[i] = value,
                        Err(failure) => *samples = Err(failure),
                    }
                }
            }
        }
    }

    /// A switching function has no value in this step: what was known of its side is worthless.
    fn forget(
        &mut self,
        index: usize,
        step: Step<'_>,
        failure: EvaluationFailure,
        solution: &mut Solution,
    ) {
        let memory = &mut self.memories[index];
        memory.side = 0.0;
        memory.before = None;
        if !memory.unknown {
            memory.unknown = true;
            solution.notes.push(Note::EventUnknown {
                t: step.now.t.high,
                event: index,
                failure,
            });
        }
        self.candidates.retain(|c| c.index != index);
    }

    /// Says once that a function runs faster than it can be followed.
    fn note_resolution(
        &mut self,
        index: usize,
        shown: bool,
        step: Step<'_>,
        solution: &mut Solution,
    ) {
        let memory = &mut self.memories[index];
        memory.unknown = false;
        if !shown && !memory.unresolved {
            memory.unresolved = true;
            let t = step.now.t.high;
            solution
                .notes
                .push(Note::EventUnresolved { t, event: index });
        }
    }

    /// Finds the zeros of one switching function and updates what is remembered of it; says whether none can be missed
    /// between the places at which it was looked at.
    fn search(
        &mut self,
        system: &mut dyn System,
        event: &mut Event<'_>,
        index: usize,
        step: Step<'_>,
    ) -> Result<bool, EvaluationFailure> {
        let samples = self.samples[index]?;
        let mut along = Along {
            system,
            event,
            step,
            y: &mut self.y,
        };
        let largest = self.memories[index].scale;
        let (isolator, places) = (&mut self.isolator, &mut self.places);
        let largest_here = samples.iter().fold(largest, |m, v| m.max(v.abs()));
        let sizes = (&samples, largest, self.resolution * largest_here);
        let shown = match isolator.places(step.dense, sizes, &mut along, places)? {
            Some(shown) => {
                let looked = (&self.places[..], largest);
                at_places(&mut self.points, &samples, looked, |x| along.value(x))?;
                shown
            }
            None => refine(&mut self.points, &samples, largest, |x| along.value(x))?,
        };
        let mut scan = Scan {
            value: |x: f64| along.value(x),
            step,
            index,
            memory: self.memories[index],
            candidates: &mut self.candidates,
        };
        scan.run(&mut self.points, self.resolution)?;
        self.memories[index] = scan.memory;
        Ok(shown)
    }

    /// Writes the state at the candidate into `self.state`: by a step exactly to it and one Newton correction, since
    /// the dense output is of lower order than the step; by the dense output where that fails.
    fn refine(
        &mut self,
        system: &mut dyn System,
        event: &mut Event<'_>,
        (step, next): (Step<'_>, &State),
        candidate: Candidate,
        restarted: &mut bool,
    ) {
        let theta = candidate.theta;
        if theta >= 1.0 {
            self.state.clone_from(next);
            return;
        }
        step.dense.at_theta(theta, &mut self.state.y);
        self.state.carry.fill(0.0);
        self.state.t = step.now.t.plus(theta * step.dense.h);
        // A polynomial that is the solution itself needs no step to the zero.
        let is_solution = step.dense.basis == Basis::Monomial;
        if candidate.kind == EventKind::Grazing || theta <= 0.0 || is_solution {
            return;
        }
        let (n, method, settings) = (self.y.len(), self.method, &self.settings);
        let stepper = self
            .stepper
            .get_or_insert_with(|| method.stepper(n, settings));
        if !*restarted && stepper.restart(system, step.now).is_err() {
            return;
        }
        *restarted = true;
        let mut trial = step.now.clone();
        let h = theta * step.dense.h;
        if stepper.attempt(system, step.now, h, &mut trial).is_err() {
            return;
        }
        self.state.clone_from(&trial);
        // The slope of the switching function only scales a correction that is small already.
        let d = NEAR.min(theta);
        let mut value = |x: f64, y: &mut Vec<f64>| {
            step.dense.at_theta(x, y);
            event.value(system, step.time(x), y)
        };
        let (Ok(before), Ok(after)) =
            (value(theta - d, &mut self.y), value(theta + d, &mut self.y))
        else {
            return;
        };
        let Ok(residual) = event.value(system, trial.t.high, &trial.y) else {
            return;
        };
        let correction = -residual * 2.0 * d * step.dense.h / (after - before);
        let small = correction.abs() <= 1e-3 * step.dense.h.abs();
        let corrected = small
            && stepper
                .attempt(system, step.now, h + correction, &mut trial)
                .is_ok();
        // At a jump the correction means nothing.
        let left = event.value(system, trial.t.high, &trial.y);
        if corrected && left.is_ok_and(|left| left.abs() < residual.abs()) {
            self.state.clone_from(&trial);
        }
    }

    /// Records the event at `self.state`; says whether it counts as a crossing.
    fn record(
        &mut self,
        system: &mut dyn System,
        candidate: Candidate,
        solution: &mut Solution,
    ) -> Result<bool, Stop> {
        let t = self.state.t.high;
        let mut row = vec![0.0; solution.width];
        if let Err(failure) = system.output(t, &self.state.y, &mut row) {
            return Err(Stop::Singular { t, failure });
        }
        let Candidate { index, kind, .. } = candidate;
        solution.events.push(EventRecord {
            t,
            index,
            kind,
            row,
        });
        if kind == EventKind::Grazing {
            solution.notes.push(Note::Grazing { t, event: index });
        }
        Ok(kind != EventKind::Grazing)
    }
}

/// The search for the zeros of one switching function, given as a function of the scaled time.
struct Scan<'s, F> {
    value: F,
    step: Step<'s>,
    index: usize,
    memory: Memory,
    candidates: &'s mut Vec<Candidate>,
}

impl<F> Scan<'_, F>
where
    F: FnMut(f64) -> Result<f64, EvaluationFailure>,
{
    /// Goes through the step sample by sample; dips of less than `resolution` times the largest value are touches.
    fn run(
        &mut self,
        points: &mut Vec<(f64, f64)>,
        resolution: f64,
    ) -> Result<(), EvaluationFailure> {
        self.find_side(points);
        let before = self.memory.before.take();
        if let [.., (theta, value), _] = points[..] {
            self.memory.before = Some((self.step.time(theta), value));
        }
        if self.memory.side == 0.0 {
            return Ok(());
        }
        let touch = resolution * self.memory.scale;
        let mut from = 0;
        if let Some(point) = before.and_then(|before| self.behind(before)) {
            points.insert(0, point);
            from = 1;
        }
        // `from` is the last place at which the function was on the present side.
        for i in from + 1..points.len() {
            if points[i].1 * self.memory.side < 0.0 {
                self.cross(points[from], points[i])?;
            } else if i >= 2 && dips(&points[i - 2..=i], self.memory.side) {
                self.dip([points[i - 2], points[i]], touch)?;
            }
            if points[i].1 != 0.0 {
                from = i;
            }
        }
        self.at_end(points)
    }

    /// The last place of the step before, where it lies so close that the motion of this step serves there.
    fn behind(&self, (t, value): (f64, f64)) -> Option<(f64, f64)> {
        let theta = (t - self.step.now.t.high) / self.step.dense.h;
        (-CLOSE_BEHIND..0.0)
            .contains(&theta)
            .then_some((theta, value))
    }

    /// A zero at the end of the run counts.
    fn at_end(&mut self, points: &[(f64, f64)]) -> Result<(), EvaluationFailure> {
        let [.., (place, before), (_, end)] = *points else {
            return Ok(());
        };
        let slack = SAME * self.step.ulp();
        if !self.step.last || !ends_on_zero(end, (1.0 - place, before), slack) {
            return Ok(());
        }
        let nearly = [(self.value)(1.0 - NEAR)?, (self.value)(1.0 - 2.0 * NEAR)?];
        match ends_on_touch(nearly) {
            true => self.add(1.0, EventKind::Grazing),
            false => self.add_crossing(1.0),
        }
        Ok(())
    }

    /// Finds out the side if it is unknown.
    fn find_side(&mut self, points: &mut [(f64, f64)]) {
        let largest = points.iter().fold(0.0, |m: f64, (_, v)| m.max(v.abs()));
        self.memory.scale = self.memory.scale.max(largest);
        if self.memory.side == 0.0 {
            // A value that is zero up to rounding at the start says nothing about the side.
            let noise = 100.0 * f64::EPSILON * early_size(points);
            if let Some((_, v)) = points.iter().find(|(_, v)| v.abs() > noise) {
                self.memory.side = v.signum();
            }
            for (_, v) in points.iter_mut().take_while(|(_, v)| v.abs() <= noise) {
                *v = 0.0;
            }
        }
    }

    /// Refines a zero between a sample on the present side and one on the other.
    fn cross(&mut self, (a, fa): (f64, f64), (b, fb): (f64, f64)) -> Result<(), EvaluationFailure> {
        // The first sample may be on the other side already: a zero on the end of the last step, by rounding.
        let fa = if fa * self.memory.side > 0.0 {
            fa
        } else {
            self.memory.side * f64::MIN_POSITIVE
        };
        let theta = bracketed_zero(&mut self.value, (a, fa), (b, fb), 4.0 * self.step.ulp())?;
        let apart = (APART * (b - a)).max(8.0 * self.step.ulp());
        let near = |place: f64| (self.value)(place).unwrap_or(f64::INFINITY);
        match is_pole(theta, apart, near) {
            true => self.memory.side = -self.memory.side,
            false => self.add_crossing(theta),
        }
        Ok(())
    }

    /// Looks into a dip towards zero between two samples: two zeros, a touch, or nothing.
    fn dip(&mut self, edges: [(f64, f64); 2], touch: f64) -> Result<(), EvaluationFailure> {
        let side = self.memory.side;
        let height = |theta: f64| (self.value)(theta).map(|v| side * v);
        let (theta, least) = minimum(height, edges[0].0, edges[1].0)?;
        if least < -touch {
            self.cross(edges[0], (theta, side * least))?;
            self.cross((theta, side * least), edges[1])?;
        } else if least <= touch {
            self.add(theta, EventKind::Grazing);
        }
        Ok(())
    }

    /// Notes a zero; what lies behind the start of the step is at its start.
    fn add(&mut self, theta: f64, kind: EventKind) {
        self.candidates.push(Candidate {
            theta: theta.max(0.0),
            index: self.index,
            kind,
        });
    }

    /// Notes a change of side at θ, unless it is the last zero once more.
    fn add_crossing(&mut self, theta: f64) {
        let (step, memory) = (self.step, &mut self.memory);
        let t = step.time(theta);
        let kind = if memory.side < 0.0 {
            EventKind::Up
        } else {
            EventKind::Down
        };
        memory.side = -memory.side;
        let again = (t - memory.last_zero).abs() <= SAME * step.ulp() * step.dense.h.abs();
        memory.last_zero = t;
        if !again {
            self.add(theta, kind);
        }
    }
}

/// Whether a zero of this kind is wanted. Grazing ones are always reported.
fn counts(direction: Direction, kind: EventKind) -> bool {
    match (direction, kind) {
        (Direction::Both, _) | (_, EventKind::Grazing) => true,
        (Direction::Up, kind) => kind == EventKind::Up,
        (Direction::Down, kind) => kind == EventKind::Down,
    }
}
