//! Noticing that an explicit method is limited by stability.
//!
//! Source: Hairer & Wanner 1996, IV.2: if |eigenvalue|·h, estimated from two slopes at the end of the step, exceeds
//! the stability bound of the method in 15 of the last 20 steps, the problem is called stiff.

use std::collections::VecDeque;

/// What to do about a stiff problem.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StiffnessPolicy {
    /// Do not look.
    Off,
    /// Say so in a note.
    Note,
    /// Say so, and stop when the problem is found stiff after at least this many steps while the rest of the span
    /// needs more steps than were made.
    StopAfter(u64),
}

/// Steps remembered, and how many of them have to be beyond the bound.
const WINDOW: usize = 20;
const ENOUGH: usize = 15;

/// The last estimates of one run.
#[derive(Debug)]
pub(crate) struct Detector {
    recent: VecDeque<bool>,
    /// Whether the note was written.
    pub(crate) noted: bool,
}

impl Detector {
    pub(crate) fn new() -> Detector {
        Detector {
            recent: VecDeque::with_capacity(WINDOW + 1),
            noted: false,
        }
    }

    /// Adds the estimate of one step, |eigenvalue|·h over the stability bound, and says whether the problem is
    /// stiff now.
    ///
    /// A step-size control that is limited by stability hovers around the bound, hence the margin below 1.
    pub(crate) fn step(&mut self, ratio: Option<f64>) -> bool {
        if self.recent.len() == WINDOW {
            self.recent.pop_front();
        }
        self.recent.push_back(ratio.is_some_and(|r| r > 0.9));
        self.recent.iter().filter(|beyond| **beyond).count() >= ENOUGH
    }
}
