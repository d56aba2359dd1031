//! The observed order of a method on a model: pieces of the motion by fixed steps of decreasing size.
//!
//! The order is the limit of the slope of the error against the step. Long steps have not come to that limit and short ones
//! drown in rounding, so stretches of several lengths and places are tried until the slopes of neighbouring steps agree.
//! Where a motion crosses a corner of its equations the stretch across the corner is measured instead.

pub(crate) mod corners;

use crate::options::Hooks;
use chetaev_integrate::ErrorControl;
use chetaev_motion::{chart, ConsistentState, Run, RunSettings, StateKind, Subject};
pub use corners::Corner;

/// Observed order of convergence at fixed steps.
#[derive(Clone, Debug, PartialEq)]
pub struct Orders {
    /// Step sizes.
    pub steps: Vec<f64>,
    /// Errors on the stretch: root of the mean square over places and components, each relative to 1 + its size.
    pub errors: Vec<f64>,
    /// Slope of the errors where neighbouring slopes agree; across a corner, of all of them. None where they never agree.
    pub observed: Option<f64>,
    /// Largest difference of the slopes used; across a corner, twice the standard error of the slope.
    pub spread: f64,
    /// Nominal order.
    pub nominal: f64,
    /// The stretch of time measured.
    pub stretch: (f64, f64),
    /// Where the equations are not smooth on the stretch.
    pub corner: Option<Corner>,
    /// Stretches tried.
    pub tried: usize,
}

impl Orders {
    /// Whether the order falls short of the nominal one for a reason found in the equations themselves.
    pub fn falls_short(&self) -> bool {
        self.corner.is_some()
            && self
                .observed
                .is_some_and(|observed| observed + self.spread <= self.nominal - SHORT)
    }

    /// Whether the nominal order was reached.
    pub fn is_shown(&self) -> bool {
        self.observed
            .is_some_and(|observed| observed >= self.nominal - 2.0 * NEAR)
    }
}

/// Numbers of steps over a stretch, multiples of the number of places at which errors are taken.
const COUNTS: [u32; 6] = [4, 8, 12, 16, 24, 32];
/// Steps of the reference.
const REFERENCE: u32 = 64;
/// Places along a stretch where errors are taken: the error of one place may change sign.
const PLACES: u32 = 4;
/// Numbers of steps across a corner, and of their reference. The error depends on where the corner falls in a step, so that
/// only many halvings show a slope.
const HALVINGS: [u32; 6] = [8, 16, 32, 64, 128, 256];
const CORNER_REFERENCE: u32 = 2048;
/// Slopes that differ by more than this fraction of the nominal order do not show an order.
const REGULAR: f64 = 0.125;
/// Slopes needed side by side.
const SLOPES: usize = 3;
/// An observed order this near to the nominal one ends the search.
const NEAR: f64 = 0.5;
/// An order that is lower by this much falls short.
const SHORT: f64 = 1.5;
/// Errors outside of these bounds are rounding or have no order yet.
const ROUNDING: f64 = 2e-13;
const LARGE: f64 = 1e-2;
/// Most fixed steps spent on a system of up to [`SMALL`] coordinates; of larger ones fewer, as a step takes longer.
const MOST_STEPS: u32 = 8000;
const SMALL: usize = 8;
/// Lengths of stretches over that of 24 average steps of the run, in the order tried.
const LENGTHS: [f64; 12] = [
    1.0, 0.6, 0.36, 1.7, 0.2, 2.8, 0.1, 8.0, 0.05, 0.02, 30.0, 0.005,
];

/// The order of the method on this motion; `None` where no stretch can be integrated by fixed steps. All velocities are
/// integrated, so that charts do not matter.
pub(crate) fn observed_order(
    subject: &Subject<'_>,
    settings: &RunSettings,
    run: &Run,
    hooks: &mut Hooks<'_>,
) -> Option<Orders> {
    (hooks.progress)("measuring the order of the method", None);
    let span = run.t - subject.start.t;
    // Order is measured with the first-order form.
    if span == 0.0 || !span.is_finite() || subject.terms.order > 1 {
        return None;
    }
    let error = ErrorControl::uniform(settings.tolerance);
    let nominal =
        chetaev_integrate::method(&settings.method).map_or(8.0, |m| f64::from(m.order(&error)));
    let laboratory = Laboratory {
        subject,
        settings,
        run,
        nominal,
        average: span / run.statistics.steps.max(1) as f64,
    };
    match corners::first(subject.system, subject.terms, subject.binding, run) {
        Some(corner) => laboratory.across(corner),
        None => laboratory.search(),
    }
}

struct Laboratory<'a> {
    subject: &'a Subject<'a>,
    settings: &'a RunSettings,
    run: &'a Run,
    nominal: f64,
    /// Signed average step of the run.
    average: f64,
}

impl Laboratory<'_> {
    /// Stretches of several lengths at several places, until one shows the nominal order.
    fn search(&self) -> Option<Orders> {
        let rows = self.run.len();
        let mut places = vec![0, rows / 2, rows / 4, rows * 3 / 4];
        places.dedup();
        let mut best: Option<Orders> = None;
        let size = self.subject.start.q.len().div_ceil(SMALL).max(1) as u32;
        let mut left = MOST_STEPS / (size * size);
        let mut measured: Vec<(usize, f64)> = Vec::new();
        let mut tried = 0;
        let near = |o: &Orders| {
            o.observed
                .is_some_and(|order| (order - self.nominal).abs() <= NEAR)
        };
        // A short or slow motion shows no order before its end.
        let attempts = [false, true].into_iter().flat_map(|beyond| {
            let all = LENGTHS.iter().map(move |&length| (beyond, length));
            all.flat_map(|(beyond, length)| places.iter().map(move |&at| (beyond, length, at)))
        });
        for (beyond, length, place) in attempts {
            let Some((start, length)) = self.stretch(place, length, beyond) else {
                continue;
            };
            if measured.contains(&(place, length)) {
                continue;
            }
            measured.push((place, length));
            let Some(rest) = left.checked_sub(COUNTS.iter().sum::<u32>() + REFERENCE) else {
                break;
            };
            left = rest;
            let Some(found) = self.measure(&start, length) else {
                continue;
            };
            tried += 1;
            // Beyond the end nobody has looked for corners: a lower order says nothing there.
            let counts = !beyond || near(&found);
            if counts && best.as_ref().is_none_or(|b| better(&found, b)) {
                best = Some(found);
            }
            if best.as_ref().is_some_and(near) {
                break;
            }
        }
        best.map(|best| Orders { tried, ..best })
    }

    /// A start and the signed length of a stretch from it: within the run, or longer than what is left of it, where the run was finished.
    fn stretch(&self, place: usize, length: f64, beyond: bool) -> Option<(ConsistentState, f64)> {
        let start = self.start_at(place)?;
        let room = self.room(start.t);
        let wanted = (24.0 * self.average * length).abs();
        let span = (self.run.t - self.subject.start.t).abs();
        let own = if beyond {
            wanted
        } else {
            wanted.min(room.abs())
        };
        let is_new = !beyond || (self.run.ending.finished && wanted > room.abs());
        let is_long = own > 1e-9 * span.max(start.t.abs());
        (is_new && is_long).then(|| (start, own * self.average.signum()))
    }

    /// The time left after t, well before a singularity that has ended the run.
    fn room(&self, t: f64) -> f64 {
        let part = if self.run.ending.finished { 1.0 } else { 0.9 };
        part * (self.run.t - t)
    }

    /// The state of a row as a start.
    fn start_at(&self, row: usize) -> Option<ConsistentState> {
        if row == 0 {
            return Some(self.subject.start.clone());
        }
        let (values, layout) = (self.run.row(row), self.run.layout);
        let (q, v) = (
            values[layout.positions()].to_vec(),
            values[layout.v()].to_vec(),
        );
        let mut numeric = self.subject.numeric.clone();
        let t = self.run.times[row];
        numeric.evaluate(t, &q, &v).ok()?;
        let chart = chart::choose(
            numeric.jacobian(),
            (numeric.r, numeric.n),
            &numeric.mass_diagonal(),
            chart::Floor::Along(self.subject.start.chart.pivot),
        );
        let same = chart.rank() == self.subject.start.chart.rank();
        let start = self.subject.start.clone();
        same.then_some(ConsistentState {
            t,
            q,
            v,
            chart,
            ..start
        })
    }

    fn measure(&self, start: &ConsistentState, length: f64) -> Option<Orders> {
        let reference = self.states(start, length, REFERENCE, PLACES)?;
        let mut points = Vec::new();
        for count in COUNTS {
            let states = self.states(start, length, count, PLACES)?;
            points.push((
                (length / f64::from(count)).abs(),
                error(&self.run.scales, (&states, &reference)),
            ));
        }
        let (observed, spread) = settled(&points, self.nominal);
        Some(self.orders(
            points,
            (observed, spread),
            (start.t, start.t + length),
            None,
        ))
    }

    /// Errors at the end of a stretch with a corner inside, over many halvings of the step.
    fn across(&self, corner: Corner) -> Option<Orders> {
        let margin = 2.0 * self.average;
        let forward = margin.signum();
        let before = |t: f64| (corner.t - margin - t) * forward >= 0.0;
        let rows = self.run.times.iter().take_while(|&&t| before(t)).count();
        let start = self.start_at(rows.saturating_sub(1))?;
        let room = self.room(start.t).abs();
        let length = (corner.t + margin - start.t).abs().min(room) * forward;
        let reference = self.states(&start, length, CORNER_REFERENCE, 1)?;
        let mut points = Vec::new();
        for count in HALVINGS {
            let states = self.states(&start, length, count, 1)?;
            points.push((
                (length / f64::from(count)).abs(),
                error(&self.run.scales, (&states, &reference)),
            ));
        }
        let logs = logarithms(&points);
        let slope = (logs.len() + 1 >= HALVINGS.len()).then(|| line(&logs));
        let stretch = (start.t, start.t + length);
        let found = (
            slope.map(|s| s.0),
            slope.map_or(f64::INFINITY, |s| 2.0 * s.1),
        );
        Some(self.orders(points, found, stretch, Some(corner)))
    }

    /// (q, v) at equal parts of the stretch by `count` fixed steps; `None` when the run does not get there.
    fn states(
        &self,
        start: &ConsistentState,
        length: f64,
        count: u32,
        places: u32,
    ) -> Option<Vec<f64>> {
        let part = length / f64::from(places);
        let n = self.subject.numeric.positions();
        let mut here = start.clone();
        let mut states = Vec::new();
        for place in 1..=places {
            let end = start.t + f64::from(place) * part;
            let fixed = RunSettings {
                t_end: end,
                times: vec![end],
                state: Some(StateKind::Full),
                ..self.settings.clone()
            };
            let subject = Subject {
                start: &here,
                ..*self.subject
            };
            let state = subject.routh_fixed(&fixed, (length / f64::from(count)).abs())?;
            here.t = end;
            here.q.copy_from_slice(&state[..n]);
            here.v.copy_from_slice(&state[n..]);
            states.extend(state);
        }
        Some(states)
    }

    fn orders(
        &self,
        points: Vec<(f64, f64)>,
        (observed, spread): (Option<f64>, f64),
        stretch: (f64, f64),
        corner: Option<Corner>,
    ) -> Orders {
        let (steps, errors) = points.into_iter().unzip();
        Orders {
            steps,
            errors,
            observed,
            spread,
            nominal: self.nominal,
            stretch,
            corner,
            tried: 1,
        }
    }
}

/// Whether `a` shows an order more clearly than `b`: nearer to the nominal one, which smooth equations have in the limit.
fn better(a: &Orders, b: &Orders) -> bool {
    match (a.observed, b.observed) {
        (Some(x), Some(y)) => (x - a.nominal).abs() < (y - b.nominal).abs(),
        (seen, before) => seen.is_some() && before.is_none(),
    }
}

/// The distance of states, one after the other, each number over its natural size and its own.
fn error(scales: &[f64], (states, reference): (&[f64], &[f64])) -> f64 {
    let pairs = states.iter().zip(reference).enumerate();
    let natural = |i: usize| match scales.len() {
        0 => 1.0,
        width => scales[i % width],
    };
    let part = |(i, (a, b)): (usize, (&f64, &f64))| ((a - b) / (natural(i) + b.abs())).powi(2);
    let squares: f64 = pairs.map(part).sum();
    (squares / states.len().max(1) as f64).sqrt()
}

fn logarithms(points: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let usable = |&&(_, error): &&(f64, f64)| error > ROUNDING && error < LARGE;
    points
        .iter()
        .filter(usable)
        .map(|(h, error)| (h.ln(), error.ln()))
        .collect()
}

/// The slope where neighbouring slopes agree, and their spread: of the finest such steps, or of those nearest to the nominal
/// order, since rounding can look regular too.
fn settled(points: &[(f64, f64)], nominal: f64) -> (Option<f64>, f64) {
    let logs = logarithms(points);
    let mut found = (None, f64::INFINITY);
    for window in logs.windows(SLOPES + 1) {
        let slopes = window
            .windows(2)
            .map(|w| (w[0].1 - w[1].1) / (w[0].0 - w[1].0));
        let (least, most) = slopes.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), s| {
            (a.min(s), b.max(s))
        });
        let (slope, _) = line(window);
        let nearer = found
            .0
            .is_none_or(|x: f64| (slope - nominal).abs() <= (x - nominal).abs());
        if most - least <= REGULAR * nominal && nearer {
            found = (Some(slope), most - least);
        }
    }
    found
}

/// The slope of the straight line of least squares and its standard error.
fn line(points: &[(f64, f64)]) -> (f64, f64) {
    let n = points.len() as f64;
    let (mx, my) = points
        .iter()
        .fold((0.0, 0.0), |(x, y), p| (x + p.0 / n, y + p.1 / n));
    let (mut xy, mut xx) = (0.0, 0.0);
    for (x, y) in points {
        xy += (x - mx) * (y - my);
        xx += (x - mx) * (x - mx);
    }
    let slope = xy / xx;
    let rest: f64 = points
        .iter()
        .map(|(x, y)| (y - my - slope * (x - mx)).powi(2))
        .sum();
    (slope, (rest / (n - 2.0).max(1.0) / xx).sqrt())
}
