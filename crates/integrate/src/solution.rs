//! What a run returns.

use crate::dense::Trajectory;
use crate::event::EventRecord;
use crate::problem::{ChartChange, EvaluationFailure, HaltReason};

/// Why a run ended. All times are the time of the last state that is kept.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Stop {
    /// The end of the span was reached.
    Finished,
    /// A terminal event happened; the record is the last of [`Solution::events`].
    Event {
        /// Time of the event.
        t: f64,
        /// Number of the event in the list given.
        index: usize,
    },
    /// The equations have no solution beyond this state: evaluations fail however short the step.
    Singular {
        /// Time.
        t: f64,
        /// The failure that the shortest step met.
        failure: EvaluationFailure,
    },
    /// A hook of the system ended the run.
    Halted {
        /// Time.
        t: f64,
        /// Reason given by the hook.
        reason: HaltReason,
    },
    /// The derivative grows without bound: the steps shrink geometrically towards a singularity in finite time.
    Divergence {
        /// Time of the last state.
        t: f64,
        /// Estimated time of the singularity, extrapolated from the last steps.
        singularity: f64,
        /// Component whose derivative has grown the most in units of its tolerance.
        component: usize,
        /// Whether that component itself grows without bound, and not only its derivative.
        unbounded: bool,
    },
    /// The tolerance cannot be met: the step fell below 16 units in the last place of t.
    StepTooSmall {
        /// Time.
        t: f64,
        /// Component with the largest error.
        component: usize,
        /// The step that would have been tried.
        h: f64,
    },
    /// A component is infinite or not a number however short the step.
    NotFinite {
        /// Time.
        t: f64,
        /// The component.
        component: usize,
    },
    /// Zeros of one function repeat without end, one or more in each of many very short steps: the motion grazes zero or chatters across
    /// it.
    Crowd {
        /// Time.
        t: f64,
        /// Number of the event in the list given.
        index: usize,
        /// In how many steps in a row it was met.
        count: u64,
    },
    /// The number of steps reached its limit.
    StepLimit {
        /// Time.
        t: f64,
        /// The limit.
        limit: u64,
    },
    /// The interrupt flag was raised.
    Interrupted {
        /// Time.
        t: f64,
    },
    /// The problem is stiff and the budget of steps for it is used up.
    Stiff {
        /// Time.
        t: f64,
        /// Steps made.
        steps: u64,
        /// Steps that the rest of the span would need at the present step size.
        steps_ahead: f64,
    },
}

/// Something worth saying about a run that did not end it.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Note {
    /// The step size was limited by stability, not by accuracy; an implicit method would need far fewer steps.
    Stiff {
        /// Time at which it was first noticed.
        t: f64,
        /// Estimated |eigenvalue|·h over the stability bound of the method.
        stability: f64,
        /// Step size there.
        h: f64,
        /// Steps that the rest of the span needs at the present step size.
        steps_ahead: f64,
    },
    /// An event function touched zero (or nearly so) without a clear crossing; it is recorded as grazing.
    Grazing {
        /// Time.
        t: f64,
        /// Number of the event.
        event: usize,
    },
    /// An event function runs faster than thousands of samples in one step show, or consists of rounding; crossings may
    /// have been missed from here on.
    EventUnresolved {
        /// Time.
        t: f64,
        /// Number of the event.
        event: usize,
    },
    /// An event function could not be evaluated inside a step; crossings there are unknown.
    EventUnknown {
        /// Time.
        t: f64,
        /// Number of the event.
        event: usize,
        /// The reason.
        failure: EvaluationFailure,
    },
}

/// Counts of one run.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Statistics {
    /// Accepted steps.
    pub steps: u64,
    /// Attempts rejected because of their error.
    pub rejected: u64,
    /// Attempts given up because an evaluation failed.
    pub failed: u64,
    /// Evaluations of F, those for events and dense output included.
    pub evaluations: u64,
    /// Factorizations made by the system during the run.
    pub factorizations: u64,
    /// Changes of chart.
    pub chart_switches: u64,
    /// States changed by a hook (projections).
    pub modifications: u64,
}

/// A trajectory with everything known about how it was made.
#[derive(Debug, Clone, PartialEq)]
pub struct Solution {
    /// Name of the method.
    pub method: &'static str,
    /// Why the run ended.
    pub stop: Stop,
    /// Time of the last state.
    pub t: f64,
    /// The last state, in the chart then in use.
    pub state: Vec<f64>,
    /// Times of the rows.
    pub times: Vec<f64>,
    /// Number of components of a row.
    pub width: usize,
    /// The rows, one after the other.
    pub rows: Vec<f64>,
    /// Events in the order of time along the run.
    pub events: Vec<EventRecord>,
    /// Changes of chart with their times.
    pub chart_changes: Vec<(f64, ChartChange)>,
    /// Remarks.
    pub notes: Vec<Note>,
    /// Counts.
    pub statistics: Statistics,
    /// The polynomials of all steps, if they were asked for.
    pub trajectory: Option<Trajectory>,
}

impl Solution {
    /// Number of rows.
    pub fn len(&self) -> usize {
        self.times.len()
    }

    /// Whether there are no rows.
    pub fn is_empty(&self) -> bool {
        self.times.is_empty()
    }

    /// Row number j.
    pub fn row(&self, j: usize) -> &[f64] {
        &self.rows[j * self.width..(j + 1) * self.width]
    }

    /// Component i of all rows.
    pub fn column(&self, i: usize) -> impl Iterator<Item = f64> + '_ {
        (0..self.len()).map(move |j| self.rows[j * self.width + i])
    }
}
