//! Events along a motion: zeros of expressions in (t, q, v, a, λ), found on the dense output of whatever flow runs.

use crate::observe::Observer;
use crate::run::WatchedFlow;
use chetaev_integrate::{
    Control, Direction, EvaluationFailure, Event, EventKind, EventRecord, Note, Piece, System,
};
use chetaev_symbolic::Expr;

/// A function whose zeros are events.
#[derive(Clone, Debug, PartialEq)]
pub struct EventWatched {
    /// Its name.
    pub name: String,
    /// The function, of t, q, v, a, `lambda_NAME`, variables of the formulation and parameters.
    pub value: Expr,
    /// Which zeros count.
    pub direction: Direction,
    /// Whether the run ends at the first.
    pub stops: bool,
}

/// A zero that was met.
#[derive(Clone, Debug, PartialEq)]
pub struct Happened {
    /// Number of the event.
    pub event: usize,
    /// Time.
    pub t: f64,
    /// How the function passed zero, or that it touched it.
    pub kind: EventKind,
    /// The output row there.
    pub row: Vec<f64>,
}

/// A flow with the events of a model behind its own switching functions.
pub(crate) struct WithEvents<'f, F> {
    pub(crate) flow: &'f mut F,
    /// Number of the flow's own switching functions.
    pub(crate) own: usize,
    /// One for each event, since a value that does not exist belongs to one only.
    pub(crate) observers: &'f mut [Observer],
    /// Their functions.
    pub(crate) values: &'f [Expr],
    pub(crate) row: &'f mut Vec<f64>,
    /// For each of the flow's own switching functions the minimum that was looked at last, where it is not zero.
    pub(crate) passed: &'f [Option<Passed>],
}

/// A minimum of a watched quantity that was passed: a state that projection moves back by rounding is behind it all the same.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Passed {
    from: f64,
    /// Signed time for which the rate counts as positive.
    length: f64,
}

impl Passed {
    /// One that was met at time t, after `before`. One met again at once is left behind by a longer time.
    pub(crate) fn at(t: f64, forward: bool, before: Option<Passed>) -> Passed {
        let again = before.filter(|before| before.just_left(t));
        let least = 64.0 * f64::EPSILON * t.abs().max(f64::MIN_POSITIVE);
        let length = again.map_or(least, |before| 16.0 * before.length.abs());
        Passed {
            from: t,
            length: if forward { length } else { -length },
        }
    }

    fn covers(&self, t: f64) -> bool {
        (0.0..=1.0).contains(&((t - self.from) / self.length))
    }

    /// Whether t comes so soon after that the minimum is the same one.
    fn just_left(&self, t: f64) -> bool {
        (0.0..=2.0).contains(&((t - self.from) / self.length))
    }
}

/// The events as the integrator takes them: those of the flow first.
pub(crate) fn events<'e>(own: usize, stated: &[EventWatched]) -> Vec<Event<'e>> {
    let watched = (0..own).map(|index| Event::of_system(index).direction(Direction::Up).terminal());
    let further = stated.iter().enumerate().map(|(k, event)| {
        let found = Event::of_system(own + k).direction(event.direction);
        match event.stops {
            true => found.terminal(),
            false => found,
        }
    });
    watched.chain(further).collect()
}

/// What the integrator recorded of the events behind the flow's own.
pub(crate) fn happened(records: &[EventRecord], own: usize) -> Vec<Happened> {
    let of_model = records.iter().filter(|record| record.index >= own);
    of_model
        .map(|record| Happened {
            event: record.index - own,
            t: record.t,
            kind: record.kind,
            row: record.row.clone(),
        })
        .collect()
}

/// What the integrator noted, with the numbers of the model's events; of the flow's own there is nothing to say.
pub(crate) fn notes(noted: &[Note], own: usize) -> Vec<Note> {
    let of_model = |note: &Note| {
        let mut note = *note;
        match &mut note {
            Note::Grazing { event, .. }
            | Note::EventUnresolved { event, .. }
            | Note::EventUnknown { event, .. } => *event = event.checked_sub(own)?,
            _ => {}
        }
        Some(note)
    };
    noted.iter().filter_map(of_model).collect()
}

impl<F: WatchedFlow> System for WithEvents<'_, F> {
    fn dimension(&self) -> usize {
        self.flow.dimension()
    }

    fn derivative(&mut self, t: f64, y: &[f64], dy: &mut [f64]) -> Result<(), EvaluationFailure> {
        self.flow.derivative(t, y, dy)
    }

    fn has_series(&self) -> bool {
        self.flow.has_series()
    }

    fn expand(
        &mut self,
        t: f64,
        state: (&[f64], &[f64]),
        order: usize,
        coefficients: &mut [f64],
    ) -> Result<(), EvaluationFailure> {
        self.flow.expand(t, state, order, coefficients)
    }

    fn accepted(&mut self, t: f64, y: &mut [f64]) -> Control {
        self.flow.accepted(t, y)
    }

    fn repivot(&mut self, t: f64, y: &mut [f64]) -> Control {
        self.flow.repivot(t, y)
    }

    fn output_dimension(&self) -> usize {
        self.flow.output_dimension()
    }

    fn output(&mut self, t: f64, y: &[f64], row: &mut [f64]) -> Result<(), EvaluationFailure> {
        self.flow.output(t, y, row)
    }

    fn switching(&mut self, index: usize, t: f64, y: &[f64]) -> Result<f64, EvaluationFailure> {
        let Some(number) = index.checked_sub(self.own) else {
            let rate = self.flow.switching(index, t, y)?;
            let is_passed = self.passed[index].is_some_and(|passed| passed.covers(t));
            return Ok(if is_passed { rate.abs() } else { rate });
        };
        self.row.resize(self.flow.output_dimension(), 0.0);
        self.flow.output(t, y, self.row)?;
        let value = self.observers[number].value(t, self.row);
        match value.is_finite() {
            true => Ok(value),
            false => Err(EvaluationFailure::NotFinite { component: 0 }),
        }
    }

    fn switching_series(&mut self, index: usize, piece: Piece<'_>, series: &mut [f64]) -> bool {
        let Some(number) = index.checked_sub(self.own) else {
            return false;
        };
        let event = (number, self.values[number]);
        self.flow.event_series(event, piece, series)
    }

    fn is_event(&mut self, index: usize, t: f64, y: &[f64]) -> bool {
        index >= self.own || self.flow.is_event(index, t, y)
    }

    fn factorizations(&self) -> u64 {
        self.flow.factorizations()
    }
}
