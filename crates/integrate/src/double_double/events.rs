//! Zeros of switching functions within a step, on its series.

use super::expansion::Series;
use super::{PreciseEvent, PreciseEventRecord, PreciseOptions, PreciseSystem};
use crate::event::{Direction, EventKind};
use crate::problem::EvaluationFailure;
use crate::sampling::{
    dips, early_size, ends_on_touch, ends_on_zero, is_pole, refine, NEAR, NODES,
};
use crate::solution::Note;
use chetaev_double_double::DoubleDouble;

/// Steps of a search for a zero: each at least halves the interval, and 106 bits are wanted.
const MOST: usize = 220;
/// Steps of a search for a minimum, each by the golden ratio.
const MINIMUM: usize = 70;
/// What of the largest value seen counts as zero at the start of a run.
const ZERO: f64 = 1e-28;
/// Accuracy of a run with steps of fixed size, which is not known.
const FIXED: f64 = 1e-10;
/// Zeros closer than this many units in the last place of t are one.
const SAME: f64 = 1e3;
/// How far behind the start of a step its motion is followed, in units of the step.
const CLOSE_BEHIND: f64 = 0.1;
/// Part of a bracket at which a function is looked at beside the zero, to tell it from a pole.
const APART: f64 = 1e-9;

/// What is remembered of one switching function between steps.
#[derive(Clone, Copy)]
struct Memory {
    /// Sign last seen, 0 while it is unknown: a zero at the end of a step is found once whatever the rounding.
    side: f64,
    /// Largest magnitude seen.
    largest: f64,
    last_zero: Option<DoubleDouble>,
    /// Time and value at the place before the end of the last step: a dip may lie at the end itself.
    before: Option<(DoubleDouble, f64)>,
}

/// The events of a run.
pub(super) struct Events<'e> {
    stated: &'e [PreciseEvent],
    memories: Vec<Memory>,
    points: Vec<(f64, f64)>,
    /// Part of the largest value below which a touch and a crossing cannot be told apart.
    resolution: f64,
}

/// A step: where it begins, its length, its series, and storage for a state.
pub(super) struct Step<'s> {
    pub(super) system: &'s mut dyn PreciseSystem,
    pub(super) t: DoubleDouble,
    pub(super) h: DoubleDouble,
    /// Whether the span ends with it.
    pub(super) is_last: bool,
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

    /// Where side · value is least between two places, by the golden section, and that least. The values keep their sign: with
    /// two zeros in between the magnitude has two minima.
    fn least(
        &mut self,
        (index, side): (usize, f64),
        (mut a, mut b): (f64, f64),
    ) -> Result<(f64, f64), EvaluationFailure> {
        const RATIO: f64 = 0.618_033_988_749_894_8;
        let mut best = (a, f64::INFINITY);
        let mut height = |step: &mut Self, theta: f64| -> Result<f64, EvaluationFailure> {
            let height = side * step.value(index, DoubleDouble::from(theta))?.high();
            if height < best.1 {
                best = (theta, height);
            }
            Ok(height)
        };
        let (mut c, mut d) = (b - RATIO * (b - a), a + RATIO * (b - a));
        let (mut at_c, mut at_d) = (height(self, c)?, height(self, d)?);
        for _ in 0..MINIMUM {
            if at_c < at_d {
                (b, d, at_d) = (d, c, at_c);
                c = b - RATIO * (b - a);
                at_c = height(self, c)?;
            } else {
                (a, c, at_c) = (c, d, at_d);
                d = a + RATIO * (b - a);
                at_d = height(self, d)?;
            }
        }
        Ok(best)
    }
}

impl<'e> Events<'e> {
    pub(super) fn new(stated: &'e [PreciseEvent], options: &PreciseOptions<'_>) -> Events<'e> {
        let memory = Memory {
            side: 0.0,
            largest: 0.0,
            last_zero: None,
            before: None,
        };
        Events {
            memories: vec![memory; stated.len()],
            points: Vec::new(),
            stated,
            resolution: match options.step {
                Some(_) => FIXED,
                None => 10.0 * options.rtol + 100.0 * DoubleDouble::EPSILON,
            },
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
                // What was known of its side is worthless.
                (self.memories[index].side, self.memories[index].before) = (0.0, None);
                let (t, event) = (step.t.high(), index);
                let known = |note: &Note| matches!(note, Note::EventUnknown { event: e, .. } if *e == index);
                if !notes.iter().any(known) {
                    notes.push(Note::EventUnknown { t, event, failure });
                }
            }
        }
        found.sort_by(|a, b| a.0.partial_cmp(&b.0).unwrap_or(std::cmp::Ordering::Equal));
        if let Some(last) = found.iter().position(|(_, record)| self.stops(record)) {
            // What happens at the same time as the end is recorded, in whatever order they are stated.
            let near =
                SAME * DoubleDouble::EPSILON * (step.t.high() / step.h.high()).abs().max(1.0);
            let end = found[last].0 + DoubleDouble::from(near);
            found.retain(|(theta, _)| *theta <= end);
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
        let memory = &mut self.memories[index];
        memory.largest = nodes.iter().fold(memory.largest, |m, v| m.max(v.abs()));
        let largest = memory.largest;
        let mut points = std::mem::take(&mut self.points);
        let sampled = refine(&mut points, &nodes, largest, |theta| {
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
            self.crossings(index, step, &mut points, found, notes)
        });
        self.points = points;
        outcome
    }

    /// Goes through the step place by place, from the side on which the function was last.
    fn crossings(
        &mut self,
        index: usize,
        step: &mut Step<'_>,
        points: &mut Vec<(f64, f64)>,
        found: &mut Vec<(DoubleDouble, PreciseEventRecord)>,
        notes: &mut Vec<Note>,
    ) -> Result<(), EvaluationFailure> {
        self.memories[index].find_side(points);
        let touch = self.resolution * self.memories[index].largest;
        // Last place at which the function was on the present side.
        let mut from = usize::from(self.memories[index].look_behind(step, points));
        for i in from + 1..points.len() {
            let side = self.memories[index].side;
            if side == 0.0 {
                break;
            }
            if points[i].1 * side < 0.0 {
                self.crossing(index, step, (points[from], points[i]), found)?;
            } else if i >= 2 && dips(&points[i - 2..=i], side) {
                let (before, after) = (points[i - 2], points[i]);
                let (theta, least) = step.least((index, side), (before.0, after.0))?;
                let there = (theta, side * least);
                if least < -touch {
                    self.crossing(index, step, (before, there), found)?;
                    self.crossing(index, step, (there, after), found)?;
                } else if least <= touch && step.is_event(index, DoubleDouble::from(theta)) {
                    touch_at(index, step, theta.max(0.0), (found, notes))?;
                }
            }
            if points[i].1 != 0.0 {
                from = i;
            }
        }
        self.at_end(index, step, points, (found, notes))
    }

    /// A zero at the end of the run counts.
    fn at_end(
        &mut self,
        index: usize,
        step: &mut Step<'_>,
        points: &[(f64, f64)],
        (found, notes): Found<'_>,
    ) -> Result<(), EvaluationFailure> {
        let [.., (place, before), (_, end)] = *points else {
            return Ok(());
        };
        let slack = SAME * DoubleDouble::EPSILON * (step.t.high() / step.h.high()).abs().max(1.0);
        let is_on_zero = ends_on_zero(end, (1.0 - place, before), slack);
        if !step.is_last || self.memories[index].side == 0.0 || !is_on_zero {
            return Ok(());
        }
        let mut nearly = [0.0; 2];
        for (value, place) in nearly.iter_mut().zip([1.0 - NEAR, 1.0 - 2.0 * NEAR]) {
            *value = step.value(index, DoubleDouble::from(place))?.high();
        }
        match ends_on_touch(nearly) && step.is_event(index, DoubleDouble::ONE) {
            true => touch_at(index, step, 1.0, (found, notes)),
            false => self.change(index, step, DoubleDouble::ONE, found),
        }
    }

    /// The crossing between a place on the present side and one on the other.
    fn crossing(
        &mut self,
        index: usize,
        step: &mut Step<'_>,
        (a, b): ((f64, f64), (f64, f64)),
        found: &mut Vec<(DoubleDouble, PreciseEventRecord)>,
    ) -> Result<(), EvaluationFailure> {
        let (left, right) = (DoubleDouble::from(a.0), DoubleDouble::from(b.0));
        let (before, after) = (step.value(index, left)?, step.value(index, right)?);
        // The first place may be on the other side already: a zero at the end of the last step, by rounding.
        let is_before = before.high() * self.memories[index].side > 0.0;
        let theta = match is_before {
            true => step.zero(index, (left, before), (right, after))?,
            false => left,
        };
        let near = |place: f64| {
            let value = step.value(index, DoubleDouble::from(place));
            value.map_or(f64::INFINITY, DoubleDouble::high)
        };
        if is_pole(theta.high(), APART * (b.0 - a.0), near) {
            self.memories[index].side *= -1.0;
            return Ok(());
        }
        self.change(index, step, theta, found)
    }

    /// The function changes its side there; an event if it is of the direction asked for.
    fn change(
        &mut self,
        index: usize,
        step: &mut Step<'_>,
        theta: DoubleDouble,
        found: &mut Vec<(DoubleDouble, PreciseEventRecord)>,
    ) -> Result<(), EvaluationFailure> {
        let memory = &mut self.memories[index];
        let kind = match memory.side < 0.0 {
            true => EventKind::Up,
            false => EventKind::Down,
        };
        memory.side = -memory.side;
        let t = step.t + step.h * theta;
        let near = SAME * DoubleDouble::EPSILON * t.high().abs().max(step.h.high().abs());
        let is_again = |last: DoubleDouble| (t - last).abs().high() <= near;
        if memory.last_zero.replace(t).is_some_and(is_again) {
            return Ok(());
        }
        let is_wanted = match self.stated[index].direction {
            Direction::Both => true,
            Direction::Up => kind == EventKind::Up,
            Direction::Down => kind == EventKind::Down,
        };
        if is_wanted && step.is_event(index, theta) {
            found.push((theta, step.record(index, theta, kind)?));
        }
        Ok(())
    }
}

/// Zeros found, with the part of the step at which each lies, and remarks.
type Found<'a> = (
    &'a mut Vec<(DoubleDouble, PreciseEventRecord)>,
    &'a mut Vec<Note>,
);

/// Records a touch.
fn touch_at(
    index: usize,
    step: &mut Step<'_>,
    theta: f64,
    (found, notes): Found<'_>,
) -> Result<(), EvaluationFailure> {
    let theta = DoubleDouble::from(theta);
    let record = step.record(index, theta, EventKind::Grazing)?;
    let (t, event) = (record.t.high(), index);
    notes.push(Note::Grazing { t, event });
    found.push((theta, record));
    Ok(())
}

impl Memory {
    /// Puts the last place of the step before first, where it lies so close that the motion of this step serves there, and
    /// remembers that of this step; says whether it did.
    fn look_behind(&mut self, step: &Step<'_>, points: &mut Vec<(f64, f64)>) -> bool {
        let before = self.before.take();
        if let [.., (theta, value), _] = points[..] {
            self.before = Some((step.t + step.h * DoubleDouble::from(theta), value));
        }
        let behind = before.map(|(t, value)| ((t - step.t).high() / step.h.high(), value));
        match behind.filter(|(theta, _)| (-CLOSE_BEHIND..0.0).contains(theta)) {
            Some(point) => {
                points.insert(0, point);
                true
            }
            None => false,
        }
    }

    /// Finds out the side if it is unknown: a value that is zero up to rounding at the start says nothing of it.
    fn find_side(&mut self, points: &mut [(f64, f64)]) {
        if self.side != 0.0 {
            return;
        }
        let noise = ZERO * early_size(points);
        if let Some((_, value)) = points.iter().find(|(_, value)| value.abs() > noise) {
            self.side = value.signum();
        }
        for (_, value) in points
            .iter_mut()
            .take_while(|(_, value)| value.abs() <= noise)
        {
            *value = 0.0;
        }
    }
}
