//! Zeros of switching functions within a step, on its series.

use super::expansion::Series;
use super::{PreciseEvent, PreciseEventRecord, PreciseSystem};
use crate::event::{Direction, EventKind};
use crate::problem::EvaluationFailure;
use crate::sampling::{refine, NODES};
use crate::solution::Note;
use chetaev_double_double::DoubleDouble;

/// Steps of a search for a zero: each at least halves the interval, and 106 bits are wanted.
const MOST: usize = 220;
/// Steps of a search for a minimum, each by the golden ratio.
const MINIMUM: usize = 70;
/// What of the largest value seen counts as zero at the start of a run, and where a function touches zero.
const ZERO: f64 = 1e-28;

/// The events of a run.
pub(super) struct Events<'e> {
    stated: &'e [PreciseEvent],
    /// The largest value of each function seen.
    largest: Vec<f64>,
    points: Vec<(f64, f64)>,
    is_first: bool,
}

/// A step: where it begins, its length, its series, and storage for a state.
pub(super) struct Step<'s> {
    pub(super) system: &'s mut dyn PreciseSystem,
    pub(super) t: DoubleDouble,
    pub(super) h: DoubleDouble,
    pub(super) series: &'s Series,
    pub(super) y: &'s mut [DoubleDouble],
    pub(super) slope: &'s mut [DoubleDouble],
}

impl Step<'_> {
    /// The switching function at the part θ of the step.
    fn value(
        &mut self,
        index: usize,
        theta: DoubleDouble,
    ) -> Result<DoubleDouble, EvaluationFailure> {
        let after = self.h * theta;
        self.series.at(after, self.y, self.slope);
        let value = self.system.switching(index, self.t + after, self.y)?;
        match value.is_finite() {
            true => Ok(value),
            false => Err(EvaluationFailure::NotFinite { component: 0 }),
        }
    }

    /// Whether the system takes a zero for an event.
    fn is_event(&mut self, index: usize, theta: DoubleDouble) -> bool {
        let after = self.h * theta;
        self.series.at(after, self.y, self.slope);
        self.system.is_event(index, self.t + after, self.y)
    }

    fn record(
        &mut self,
        index: usize,
        theta: DoubleDouble,
        kind: EventKind,
    ) -> Result<PreciseEventRecord, EvaluationFailure> {
        let after = self.h * theta;
        self.series.at(after, self.y, self.slope);
        let t = self.t + after;
        let mut row = vec![DoubleDouble::ZERO; self.system.output_dimension()];
        self.system.output(t, self.y, &mut row)?;
        Ok(PreciseEventRecord {
            t,
            index,
            kind,
            row,
        })
    }

    /// The zero between two places with values of different signs, by false position in Illinois' form (Dowell, Jarratt 1971)
    /// with a bisection where that is slow.
    fn zero(
        &mut self,
        index: usize,
        mut a: (DoubleDouble, DoubleDouble),
        mut b: (DoubleDouble, DoubleDouble),
    ) -> Result<DoubleDouble, EvaluationFailure> {
        let mut last_side = 0;
        for count in 0..MOST {
            let width = b.0 - a.0;
            if b.1.high() == 0.0 || width.high() <= 2.0 * DoubleDouble::EPSILON {
                break;
            }
            let place = match count % 4 {
                3 => a.0 + width.scaled(0.5),
                _ => a.0 + width * (a.1 / (a.1 - b.1)),
            };
            let value = self.value(index, place)?;
            let is_left = (value.high() < 0.0) == (a.1.high() < 0.0) && value.high() != 0.0;
            if is_left {
                a = (place, value);
                if last_side == -1 {
                    b.1 = b.1.scaled(0.5);
                }
                last_side = -1;
            } else {
                b = (place, value);
                if last_side == 1 {
                    a.1 = a.1.scaled(0.5);
                }
                last_side = 1;
            }
        }
        Ok(b.0)
    }

    /// Where |value| is least between two places, by the golden section, and the value.
    fn least(
        &mut self,
        index: usize,
        (mut a, mut b): (f64, f64),
    ) -> Result<(f64, f64), EvaluationFailure> {
        const RATIO: f64 = 0.618_033_988_749_894_8;
        let mut best = (a, f64::INFINITY);
        let mut size = |step: &mut Self, theta: f64| -> Result<f64, EvaluationFailure> {
            let value = step.value(index, DoubleDouble::from(theta))?.high();
            if value.abs() < best.1.abs() {
                best = (theta, value);
            }
            Ok(value.abs())
        };
        let (mut c, mut d) = (b - RATIO * (b - a), a + RATIO * (b - a));
        let (mut at_c, mut at_d) = (size(self, c)?, size(self, d)?);
        for _ in 0..MINIMUM {
            if at_c < at_d {
                (b, d, at_d) = (d, c, at_c);
                c = b - RATIO * (b - a);
                at_c = size(self, c)?;
            } else {
                (a, c, at_c) = (c, d, at_d);
                d = a + RATIO * (b - a);
                at_d = size(self, d)?;
            }
        }
        Ok(best)
    }
}

impl<'e> Events<'e> {
    pub(super) fn new(stated: &'e [PreciseEvent]) -> Events<'e> {
        Events {
            largest: vec![0.0; stated.len()],
            points: Vec::new(),
            stated,
            is_first: true,
        }
    }

    /// The zeros within a step in the order of time, with the part of the step at which each lies, up to the first that ends the run;
    /// remarks on those that could not be looked for.
    pub(super) fn within(
        &mut self,
        step: &mut Step<'_>,
        notes: &mut Vec<Note>,
    ) -> Vec<(DoubleDouble, PreciseEventRecord)> {
        let mut found = Vec::new();
        for index in 0..self.stated.len() {
            let before = found.len();
            if let Err(failure) = self.of(index, step, &mut found, notes) {
                found.truncate(before);
                let (t, event) = (step.t.high(), index);
                let known = |note: &Note| matches!(note, Note::EventUnknown { event: e, .. } if *e == index);
                if !notes.iter().any(known) {
                    notes.push(Note::EventUnknown { t, event, failure });
                }
            }
        }
        self.is_first = false;
        found.sort_by(|a, b| a.0.partial_cmp(&b.0).unwrap_or(std::cmp::Ordering::Equal));
        if let Some(last) = found.iter().position(|(_, record)| self.stops(record)) {
            found.truncate(last + 1);
        }
        found
    }

    /// Whether the run ends there.
    pub(super) fn stops(&self, record: &PreciseEventRecord) -> bool {
        self.stated[record.index].stops && record.kind != EventKind::Grazing
    }

    /// The zeros of one function.
    fn of(
        &mut self,
        index: usize,
        step: &mut Step<'_>,
        found: &mut Vec<(DoubleDouble, PreciseEventRecord)>,
        notes: &mut Vec<Note>,
    ) -> Result<(), EvaluationFailure> {
        let mut nodes = [0.0; NODES.len()];
        for (value, node) in nodes.iter_mut().zip(NODES) {
            *value = step.value(index, DoubleDouble::from(node))?.high();
        }
        let seen = nodes.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        self.largest[index] = self.largest[index].max(seen);
        let floor = ZERO * self.largest[index];
        // A zero at the initial time does not count.
        if self.is_first && nodes[0].abs() <= floor {
            nodes[0] = 0.0;
        }
        let mut points = std::mem::take(&mut self.points);
        let sampled = refine(&mut points, &nodes, self.largest[index], |theta| {
            let value = step.value(index, DoubleDouble::from(theta));
            value.map(DoubleDouble::high)
        });
        let outcome = sampled.and_then(|is_shown| {
            let known =
                |note: &Note| matches!(note, Note::EventUnresolved { event, .. } if *event == index);
            if !is_shown && !notes.iter().any(known) {
                let (t, event) = (step.t.high(), index);
                notes.push(Note::EventUnresolved { t, event });
            }
            self.crossings(index, step, &points, found, notes)
        });
        self.points = points;
        outcome
    }

    fn crossings(
        &self,
        index: usize,
        step: &mut Step<'_>,
        points: &[(f64, f64)],
        found: &mut Vec<(DoubleDouble, PreciseEventRecord)>,
        notes: &mut Vec<Note>,
    ) -> Result<(), EvaluationFailure> {
        let floor = ZERO * self.largest[index];
        for (k, pair) in points.windows(2).enumerate() {
            self.crossing(index, step, (pair[0], pair[1]), found)?;
            let Some(&next) = points.get(k + 2) else {
                continue;
            };
            let (a, b) = (pair[0], pair[1]);
            let same = a.1 * b.1 > 0.0 && b.1 * next.1 > 0.0;
            let (before, size, after) = (a.1.abs(), b.1.abs(), next.1.abs());
            // A function that is constant there has no minimum.
            if !(same && size <= before.min(after) && size < before.max(after)) {
                continue;
            }
            let least = step.least(index, (a.0, next.0))?;
            if least.1 * b.1 < 0.0 {
                self.crossing(index, step, (a, least), found)?;
                self.crossing(index, step, (least, next), found)?;
            } else if least.1.abs() <= floor {
                let theta = DoubleDouble::from(least.0);
                let record = step.record(index, theta, EventKind::Grazing)?;
                let (t, event) = (record.t.high(), index);
                notes.push(Note::Grazing { t, event });
                found.push((theta, record));
            }
        }
        Ok(())
    }

    /// The crossing between two places, if there is one of the direction asked for.
    fn crossing(
        &self,
        index: usize,
        step: &mut Step<'_>,
        (a, b): ((f64, f64), (f64, f64)),
        found: &mut Vec<(DoubleDouble, PreciseEventRecord)>,
    ) -> Result<(), EvaluationFailure> {
        if a.1 == 0.0 || a.1 * b.1 > 0.0 {
            return Ok(());
        }
        let kind = match a.1 < 0.0 {
            true => EventKind::Up,
            false => EventKind::Down,
        };
        let is_wanted = match self.stated[index].direction {
            Direction::Both => true,
            Direction::Up => kind == EventKind::Up,
            Direction::Down => kind == EventKind::Down,
        };
        if is_wanted {
            let (left, right) = (DoubleDouble::from(a.0), DoubleDouble::from(b.0));
            let ends = (step.value(index, left)?, step.value(index, right)?);
            let theta = step.zero(index, (left, ends.0), (right, ends.1))?;
            if step.is_event(index, theta) {
                found.push((theta, step.record(index, theta, kind)?));
            }
        }
        Ok(())
    }
}
