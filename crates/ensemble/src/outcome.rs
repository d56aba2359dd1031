//! What is kept of one trajectory.

use chetaev_motion::{ConsistentState, Run, RunSettings};

/// Why a trajectory ended, as a number in a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StopCode {
    /// The end of the time span was reached: 0.
    End,
    /// It ended early, for the reason given: 1.
    Early,
    /// It could not begin, for the reason given: 2.
    NotStarted,
    /// An event of the model ended it: 10 and the number of the event.
    Event(usize),
}

impl StopCode {
    /// The number.
    pub fn number(self) -> i64 {
        match self {
            StopCode::End => 0,
            StopCode::Early => 1,
            StopCode::NotStarted => 2,
            StopCode::Event(index) => 10 + index as i64,
        }
    }

    /// Whether the trajectory has no proper end.
    pub fn is_failure(self) -> bool {
        matches!(self, StopCode::Early | StopCode::NotStarted)
    }
}

/// How often an event happened, and when first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seen {
    /// How often.
    pub count: u64,
    /// Time of the first; NaN where there was none.
    pub first: f64,
}

/// What is kept of one trajectory. Numbers that do not exist are NaN.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// Why it ended.
    pub stop: StopCode,
    /// The reason in words, where it ended early or did not begin.
    pub reason: Option<String>,
    /// (q, masses with a law of their own, v) at the start, made consistent.
    pub start: Vec<f64>,
    /// The same at the end.
    pub end: Vec<f64>,
    /// Start time.
    pub t_start: f64,
    /// Time of the state at the end.
    pub t: f64,
    /// Time of the stop: that of the end, or the extrapolated time of a singularity.
    pub t_stop: f64,
    /// Accepted steps.
    pub steps: u64,
    /// Rejected steps.
    pub rejected: u64,
    /// Largest deviation of energy and stated integrals from their values at the start, over all steps.
    pub drift: Vec<f64>,
    /// Largest residual of all constraints over all steps.
    pub constraint_drift: f64,
    /// By event of the model.
    pub events: Vec<Seen>,
    /// Times of the samples and the state at each, one after the other.
    pub samples: Vec<f64>,
}

/// How many numbers of each kind an outcome has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shape {
    /// Of a state (q, masses with a law of their own, v).
    pub state: usize,
    /// Energy and stated integrals.
    pub kept: usize,
    /// Events of the model.
    pub events: usize,
    /// Samples along the trajectory.
    pub samples: usize,
}

impl Outcome {
    /// A trajectory that did not begin.
    pub fn not_started(shape: Shape, reason: String) -> Outcome {
        Outcome {
            stop: StopCode::NotStarted,
            reason: Some(reason),
            start: vec![f64::NAN; shape.state],
            end: vec![f64::NAN; shape.state],
            t_start: f64::NAN,
            t: f64::NAN,
            t_stop: f64::NAN,
            steps: 0,
            rejected: 0,
            drift: vec![f64::NAN; shape.kept],
            constraint_drift: f64::NAN,
            events: vec![NEVER; shape.events],
            samples: vec![f64::NAN; shape.samples * (1 + shape.state)],
        }
    }

    /// How many numbers it holds, about.
    pub(crate) fn numbers(&self) -> usize {
        let own = 16 + 2 * self.events.len() + self.drift.len();
        own + self.start.len() + self.end.len() + self.samples.len()
    }

    /// What is kept of a run from `start` with these settings, whose times are those of the samples, or the end alone.
    pub fn of(run: &Run, start: &ConsistentState, settings: &RunSettings, shape: Shape) -> Outcome {
        let state = [&start.q[..], &start.v[..]].concat();
        let last = run.len().checked_sub(1);
        let end = last.map_or_else(|| state.clone(), |j| state_of(run, j).to_vec());
        let t = last.map_or(start.t, |j| run.times[j]);
        let stop = stop_of(run, settings);
        let failed = stop.is_failure();
        let deviation = |i: usize| run.followed.get(i).map_or(f64::NAN, |d| d.drift.value);
        let residuals = run.followed.iter().skip(shape.kept);
        let largest = residuals.fold(0.0, |m: f64, d| m.max(d.drift.value));
        Outcome {
            stop,
            reason: failed.then(|| run.ending.reason.clone()),
            t_start: start.t,
            t,
            t_stop: match run.ending.t.is_finite() {
                true => run.ending.t,
                false => run.t,
            },
            steps: run.statistics.steps,
            rejected: run.statistics.rejected + run.statistics.failed,
            drift: (0..shape.kept).map(deviation).collect(),
            constraint_drift: run
                .drift
                .as_ref()
                .map_or(largest, |d| largest.max(d.largest())),
            events: (0..shape.events).map(|k| seen(run, k)).collect(),
            samples: samples(run, settings, shape),
            start: state,
            end,
        }
    }
}

const NEVER: Seen = Seen {
    count: 0,
    first: f64::NAN,
};

/// (q, masses, v) of a row.
fn state_of(run: &Run, j: usize) -> &[f64] {
    &run.row(j)[..run.layout.v().end]
}

fn stop_of(run: &Run, settings: &RunSettings) -> StopCode {
    if !run.ending.finished {
        return StopCode::Early;
    }
    match run.events.last() {
        Some(met) if settings.events[met.event].stops && met.t == run.t => {
            StopCode::Event(met.event)
        }
        _ => StopCode::End,
    }
}

fn seen(run: &Run, event: usize) -> Seen {
    let mut met = run.events.iter().filter(|met| met.event == event);
    match met.next() {
        None => NEVER,
        Some(first) => Seen {
            count: 1 + met.count() as u64,
            first: first.t,
        },
    }
}

/// The rows at the times asked for; NaN beyond the end of a run that ended early.
fn samples(run: &Run, settings: &RunSettings, shape: Shape) -> Vec<f64> {
    if shape.samples == 0 {
        return Vec::new();
    }
    let mut samples = Vec::with_capacity(shape.samples * (1 + shape.state));
    for (j, &t) in settings.times.iter().enumerate() {
        samples.push(t);
        match j < run.asked() && run.times[j] == t {
            true => samples.extend_from_slice(state_of(run, j)),
            false => samples.extend(std::iter::repeat_n(f64::NAN, shape.state)),
        }
    }
    samples
}
