//! Events: zero crossings of switching functions, located on the dense output of each step.

use crate::problem::{EvaluationFailure, Piece, System};

/// Which crossings count.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Direction {
    /// From negative to positive along the run.
    Up,
    /// From positive to negative along the run.
    Down,
    /// Both.
    Both,
}

/// A function of time and state.
type StateFunction<'a> = Box<dyn FnMut(f64, &[f64]) -> f64 + 'a>;

/// How the value of a switching function is found.
enum Switching<'a> {
    Function(StateFunction<'a>),
    OfSystem(usize),
}

/// A switching function e(t, y), whose zeros along the motion are located.
///
/// A zero at the initial time does not count; one at the final time does.
pub struct Event<'a> {
    switching: Switching<'a>,
    pub(crate) direction: Direction,
    /// The run ends at the crossing of this number; 0 for never.
    pub(crate) stop_at: u64,
    pub(crate) count: u64,
}

impl std::fmt::Debug for Event<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Event")
            .field("direction", &self.direction)
            .field("stop_at", &self.stop_at)
            .finish_non_exhaustive()
    }
}

impl<'a> Event<'a> {
    /// Records every zero of a function of time and state.
    pub fn new(function: impl FnMut(f64, &[f64]) -> f64 + 'a) -> Event<'a> {
        Event::with(Switching::Function(Box::new(function)))
    }

    /// Records every zero of switching function `index` of the system ([`System::switching`]).
    pub fn of_system(index: usize) -> Event<'a> {
        Event::with(Switching::OfSystem(index))
    }

    fn with(switching: Switching<'a>) -> Event<'a> {
        Event {
            switching,
            direction: Direction::Both,
            stop_at: 0,
            count: 0,
        }
    }

    /// Counts crossings of one direction only.
    #[must_use]
    pub fn direction(mut self, direction: Direction) -> Event<'a> {
        self.direction = direction;
        self
    }

    /// Ends the run at the first crossing.
    #[must_use]
    pub fn terminal(self) -> Event<'a> {
        self.terminal_after(1)
    }

    /// Ends the run at the crossing of this number, counted from 1.
    #[must_use]
    pub fn terminal_after(mut self, number: u64) -> Event<'a> {
        self.stop_at = number;
        self
    }

    /// Whether a zero near (t, y) matters.
    pub(crate) fn matters(&self, system: &mut dyn System, t: f64, y: &[f64]) -> bool {
        match self.switching {
            Switching::Function(_) => true,
            Switching::OfSystem(index) => system.is_event(index, t, y),
        }
    }

    /// Taylor coefficients along a piece of the motion; false where there are none.
    pub(crate) fn series(
        &self,
        system: &mut dyn System,
        piece: Piece<'_>,
        series: &mut [f64],
    ) -> bool {
        match self.switching {
            Switching::Function(_) => false,
            Switching::OfSystem(index) => system.switching_series(index, piece, series),
        }
    }

    pub(crate) fn value(
        &mut self,
        system: &mut dyn System,
        t: f64,
        y: &[f64],
    ) -> Result<f64, EvaluationFailure> {
        let value = match &mut self.switching {
            Switching::Function(function) => function(t, y),
            Switching::OfSystem(index) => system.switching(*index, t, y)?,
        };
        if value.is_nan() {
            return Err(EvaluationFailure::NotFinite { component: 0 });
        }
        Ok(value)
    }
}

/// What kind of zero was found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EventKind {
    /// The function changes sign from negative to positive along the run.
    Up,
    /// The function changes sign from positive to negative along the run.
    Down,
    /// The function touches zero to within the tolerances, without a crossing that they can resolve. It neither
    /// counts as a crossing nor stops the run.
    Grazing,
}

/// One zero of one switching function.
#[derive(Debug, Clone, PartialEq)]
pub struct EventRecord {
    /// Time of the zero.
    pub t: f64,
    /// Number of the event in the list given.
    pub index: usize,
    /// Kind of zero.
    pub kind: EventKind,
    /// The output row there.
    pub row: Vec<f64>,
}
