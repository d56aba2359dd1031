//! Where the rank of the constraints falls along a motion: sheets of the constraint set cross there, or touch.
//!
//! One policy for all methods, charts, formulations and tolerances. The motion up to the place is followed on its sheet in the
//! smallest number of variables (`path`), in which it is as smooth there as anywhere. At the place the tangent cone of the
//! constraint set is looked at: with J the gradients of the constraints by the velocities, K the null space of J, W that of Jᵀ, and J'
//! the rate of J along the motion, a displacement u in K belongs to the cone only if `Wᵀ J' u = 0` to first order beside the
//! velocity. Where `Wᵀ J' K` has full rank the velocity lies on exactly one branch of the cone, and simply: the implicit
//! function theorem for `J(s u)/s` gives one sheet with this tangent, and the motion goes on along it. Otherwise it is not determined,
//! and the run ends. (For finite constraints `Wᵀ J' u` is the second fundamental form Σ w ∂²φ(v, u).)

mod branches;
mod nodes;
mod path;
mod spectrum;

pub(crate) use path::{Path, State};

use crate::accelerations::Accelerations;
use crate::chart;
use crate::numeric::NumericSystem;
use chetaev_mechanics::{MotionTerms, Selection, System};
use spectrum::{gram, Spectrum};
use std::collections::VecDeque;

/// A passage through a place where the rank falls.
#[derive(Clone, Debug, PartialEq)]
pub struct Crossing {
    /// The time.
    pub t: f64,
    /// The rank elsewhere and there.
    pub rank: (usize, usize),
    /// The component on which it went on, where that was asked for and not determined.
    pub onto: Option<String>,
}

/// Why the motion does not go on: a place, and a sentence.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Undetermined {
    pub(crate) t: f64,
    pub(crate) reason: String,
}

/// What became of the motion near a place where the rank seemed to fall.
#[derive(Clone, Debug)]
pub(crate) enum Passage {
    /// It was followed to the end of the last path; `crossing` is where the rank fell, if it did.
    Passed {
        paths: Vec<Path>,
        crossing: Option<Crossing>,
    },
    /// It is not determined beyond.
    Ended { paths: Vec<Path>, why: Undetermined },
    /// Nothing was found out.
    Unknown,
}

/// A state from which the motion may be followed anew, with the measure of the rank there.
#[derive(Clone, Debug)]
struct Known {
    state: State,
    a: Vec<f64>,
    measure: f64,
}

/// Follows the rank of the constraints along a motion.
#[derive(Clone, Debug)]
pub(crate) struct Track {
    system: NumericSystem,
    rank: usize,
    /// Largest length of each gradient so far.
    lengths: Vec<f64>,
    /// Largest measure so far.
    largest: f64,
    known: VecDeque<Known>,
    /// Not to be tried again before the measure has been large.
    is_quiet: bool,
}

/// The reason of a halt where the rank seems to fall.
pub(crate) const MET: u32 = u32::MAX - 1;

/// So many states are kept, thinned out where steps are short.
const KEPT: usize = 256;
/// A measure below this part of the largest one is looked at (the measure is a square).
const NEAR: f64 = 2.5e-3;
/// One that falls below this is met before its least value.
const AHEAD: f64 = 1e-4;
/// Paths begin where the measure is at least one of these parts of the largest one.
const FAR: [f64; 3] = [4e-2, 0.15, 1e-2];
/// Below this part it may be zero.
const ZERO: f64 = 1e-11;
/// Reactions have no digits left below this part.
const UNDETERMINED: f64 = 1e-13;
/// Places between two states at which the measure is looked at: beside the ends they show whether it rises or falls there.
const LOOKS: [f64; 5] = [1e-4, 0.25, 0.5, 0.75, 1.0 - 1e-4];
/// Where a path of the accuracy asked for is not found, one of this is.
const ROUGH: f64 = 1e-9;
/// Tries to come closer.
const TRIES: usize = 40;

/// Whether the rank of the selected constraints may fall, as far as the form of their gradients says: not where each of the rows
/// has a number (or a parameter) in a column in which those that are left have nothing.
pub(crate) fn may_fall(system: &System, terms: &MotionTerms, selection: &Selection) -> bool {
    let g = &system.graph;
    let (all, rank) = (terms.constraints.len(), selection.rows.len());
    let is_finite = |l: &usize| system.constraints[*l].order == 0;
    // The gradient of one constraint in the velocities is watched by itself.
    let is_watched = all == 1 && !terms.constraint_index.iter().any(is_finite);
    if terms.order != 1 || rank == 0 || is_watched {
        return false;
    }
    let moves = |s| system.moves(g.symbol_name(s)) || g.symbol_name(s) == "t";
    let mut rows = selection.rows.clone();
    let mut columns: Vec<usize> = (0..system.n()).collect();
    loop {
        let found = columns.iter().find_map(|&j| {
            let entries = || rows.iter().filter(|&&i| !g.is_zero(terms.jacobian[i][j]));
            let row = *entries().next()?;
            let fixed = g.is_free_of(terms.jacobian[row][j], &moves);
            (fixed && entries().count() == 1).then_some((row, j))
        });
        match found {
            Some((row, j)) => {
                rows.retain(|&i| i != row);
                columns.retain(|&i| i != j);
            }
            None => return !rows.is_empty(),
        }
    }
}

impl Track {
    pub(crate) fn new(system: NumericSystem, rank: usize) -> Track {
        Track {
            lengths: vec![0.0; system.r],
            system,
            rank,
            largest: 0.0,
            known: VecDeque::new(),
            is_quiet: false,
        }
    }

    /// Forgets the motion followed so far.
    pub(crate) fn begin(&mut self) {
        self.lengths.fill(0.0);
        self.largest = 0.0;
        self.known.clear();
        self.is_quiet = false;
    }

    /// Goes on from another state than the last one.
    pub(crate) fn leave(&mut self) {
        self.known.clear();
    }

    pub(crate) fn system_mut(&mut self) -> &mut NumericSystem {
        &mut self.system
    }

    /// Takes an accepted state into account. The time at which the rank seems to fall, before this state or soon after it.
    pub(crate) fn record(&mut self, (t, q, v, a): (f64, &[f64], &[f64], &[f64])) -> Option<f64> {
        let state = State {
            t,
            q: q.to_vec(),
            v: v.to_vec(),
        };
        let measure = self.measure_at(&state)?;
        self.largest = self.largest.max(measure);
        let now = Known {
            state,
            a: a.to_vec(),
            measure,
        };
        let found = match self.known.back().cloned() {
            Some(before) => self.between(&before, &now),
            None => None,
        };
        if measure >= FAR[0] * self.largest {
            self.is_quiet = false;
        }
        self.known.push_back(now);
        if self.known.len() > KEPT {
            // Short steps: every other state reaches as far back.
            let mut place = 0;
            self.known.retain(|_| {
                place += 1;
                place % 2 == 0 || place > KEPT
            });
        }
        found
    }

    /// The time of the least measure between two states, or soon after them, if it is small.
    fn between(&mut self, before: &Known, now: &Known) -> Option<f64> {
        let h = now.state.t - before.state.t;
        let near = NEAR * self.largest;
        let mut values = vec![(0.0, before.measure)];
        for theta in LOOKS {
            let between = interpolated(before, now, theta);
            values.push((theta, self.measure_at(&between)?));
        }
        values.push((1.0, now.measure));
        for three in 1..values.len() - 1 {
            let [a, b, c] = [three - 1, three, three + 1].map(|i| values[i]);
            if b.1 > a.1 || b.1 > c.1 {
                continue;
            }
            let (theta, value) = self.refined(before, now, [a.0, c.0])?;
            if value <= near {
                return Some(before.state.t + theta * h);
            }
        }
        // On the way down: where the square root of the measure would be zero.
        let (theta, earlier) = values[values.len() - 2];
        let falls = now.measure < AHEAD * self.largest && now.measure < earlier;
        if !falls || self.is_quiet {
            return None;
        }
        let (a, b) = (earlier.sqrt(), now.measure.sqrt());
        Some(now.state.t + (1.0 - theta) * h * b / (a - b).max(1e-3 * a))
    }

    /// The least measure between two places of a step, by golden sections.
    fn refined(&mut self, before: &Known, now: &Known, ends: [f64; 2]) -> Option<(f64, f64)> {
        let mut failed = false;
        let found = golden(ends, 40, |theta| {
            let state = interpolated(before, now, theta);
            self.measure_at(&state).unwrap_or_else(|| {
                failed = true;
                f64::INFINITY
            })
        });
        (!failed).then_some(found)
    }

    /// The gradients at a state: rows over their largest lengths, columns over the roots of the inertias.
    fn scaled(&mut self, at: &State) -> Option<Vec<f64>> {
        let system = &mut self.system;
        system.evaluate(at.t, &at.q, &at.v).ok()?;
        let n = system.n;
        let mut rows = system.jacobian().to_vec();
        for j in 0..n {
            let scale = chart::scale(system.mass()[j * n + j]);
            rows.iter_mut().skip(j).step_by(n).for_each(|x| *x /= scale);
        }
        for (row, known) in rows.chunks_mut(n.max(1)).zip(&mut self.lengths) {
            let length = row.iter().map(|x| x * x).sum::<f64>().sqrt();
            *known = known.max(length);
            if *known > 0.0 {
                row.iter_mut().for_each(|x| *x /= *known);
            }
        }
        Some(rows)
    }

    /// Half the harmonic mean, so to speak, of the squares of the singular values that a matrix of this rank has: zero where one of them is.
    fn measure_at(&mut self, at: &State) -> Option<f64> {
        let rows = self.scaled(at)?;
        let (n, r, rank) = (self.system.n, self.system.r, self.rank);
        let matrix = gram(&rows, n);
        if r == rank {
            return Some(1.0 / trace_of_inverse(&matrix, r));
        }
        let values = Spectrum::of(matrix, r).values;
        let sum: f64 = values[r - rank..].iter().map(|x| 1.0 / x.max(0.0)).sum();
        Some(1.0 / sum)
    }

    /// Where the rank seems to fall next, where a run has ended on the way down.
    pub(crate) fn ahead(&self) -> Option<f64> {
        let (now, before) = (self.known.back()?, self.known.iter().rev().nth(1)?);
        let falls = now.measure < FAR[0] * self.largest && now.measure < before.measure;
        let (a, b) = (before.measure.sqrt(), now.measure.sqrt());
        let h = now.state.t - before.state.t;
        (falls && !self.is_quiet).then(|| now.state.t + h * b / (a - b).max(1e-3 * a))
    }

    /// The multipliers by constraint row at a state: not numbers where the rank is nearly lost, as they are not determined there.
    pub(crate) fn reactions(&mut self, at: &State) -> Vec<f64> {
        let unknown = vec![f64::NAN; self.system.r];
        let is_near = self
            .measure_at(at)
            .is_none_or(|m| m <= UNDETERMINED * self.largest);
        if is_near {
            return unknown;
        }
        let system = &self.system;
        let chart = chart::choose(
            system.jacobian(),
            (system.r, system.n),
            &system.mass_diagonal(),
            chart::Floor::Along(1.0),
        );
        let mut accelerations = Accelerations::default();
        match accelerations.solve(system, &chart) {
            Ok(()) => accelerations.lambda,
            Err(_) => unknown,
        }
    }

    /// Follows the motion from the last state far from the place, across it where it goes on; from states farther and nearer, and less
    /// sharply, where that fails: a chart may serve from one and not from another, and near the place rounding may forbid the sharpest.
    pub(crate) fn pass(&mut self, guess: f64, accuracy: f64) -> (f64, Passage) {
        for accuracy in [accuracy, ROUGH.max(accuracy)] {
            for part in FAR {
                let Some(from) = self.last_far(guess, part * self.largest) else {
                    continue;
                };
                let start = from.t;
                match self.follow(from, guess, accuracy) {
                    Passage::Unknown => {}
                    found => return (start, found),
                }
            }
        }
        self.is_quiet = true;
        (guess, Passage::Unknown)
    }

    /// The last state before a time at which the measure is at least so large.
    fn last_far(&self, before: f64, measure: f64) -> Option<State> {
        let direction = self.direction();
        let mut earlier = self.known.iter().rev();
        let found = earlier
            .find(|known| (before - known.state.t) * direction > 0.0 && known.measure >= measure);
        found.map(|known| known.state.clone())
    }

    fn direction(&self) -> f64 {
        match (self.known.front(), self.known.back()) {
            (Some(a), Some(b)) if b.state.t < a.state.t => -1.0,
            _ => 1.0,
        }
    }

    fn follow(&mut self, mut at: State, mut place: f64, accuracy: f64) -> Passage {
        let mut paths = Vec::new();
        for _ in 0..TRIES {
            let h = 2.0 * (place - at.t);
            if h == 0.0 {
                break;
            }
            let Some(path) = Path::new(&mut self.system, &at, h, accuracy) else {
                // Closer first.
                match Path::new(&mut self.system, &at, 0.25 * h, accuracy) {
                    Some(path) => {
                        at = path.end();
                        paths.push(path);
                    }
                    None => break,
                }
                continue;
            };
            let Some((theta, least)) = self.least(&path) else {
                break;
            };
            let is_inside = (0.02..0.98).contains(&theta);
            if is_inside && (theta - 0.5).abs() > 0.04 {
                place = path.start + theta * h;
                continue;
            }
            if theta >= 0.98 {
                // The place lies further on.
                let before = self.measure_at(&path.at(0.9)).unwrap_or(0.0);
                let (a, b) = (before.sqrt(), least.sqrt());
                place = path.end().t + 0.1 * h * b / (a - b).max(0.05 * a).max(f64::MIN_POSITIVE);
                continue;
            }
            paths.push(path);
            if !is_inside || least > ZERO * self.largest {
                self.is_quiet = true;
                return Passage::Passed {
                    paths,
                    crossing: None,
                };
            }
            return self.judged(paths, theta);
        }
        self.is_quiet = true;
        self.stuck(&at, paths)
    }

    /// The place of the least measure along a path, and its value.
    fn least(&mut self, path: &Path) -> Option<(f64, f64)> {
        const PARTS: usize = 24;
        let theta = |k: usize| k as f64 / PARTS as f64;
        let values: Option<Vec<f64>> = (0..=PARTS)
            .map(|k| self.measure_at(&path.at(theta(k))))
            .collect();
        let values = values?;
        let k = (0..=PARTS).min_by(|&i, &j| values[i].total_cmp(&values[j]))?;
        if k == 0 || k == PARTS {
            return Some((theta(k), values[k]));
        }
        let mut failed = false;
        let found = golden([theta(k - 1), theta(k + 1)], 60, |x| {
            self.measure_at(&path.at(x)).unwrap_or_else(|| {
                failed = true;
                f64::INFINITY
            })
        });
        (!failed).then_some(found)
    }
}

/// The sum of the inverse eigenvalues of a positive definite matrix, by Cholesky's factorization; infinite where it is singular.
fn trace_of_inverse(a: &[f64], n: usize) -> f64 {
    let mut l = vec![0.0; n * n];
    for i in 0..n {
        for j in 0..=i {
            let known: f64 = (0..j).map(|k| l[i * n + k] * l[j * n + k]).sum();
            let rest = a[i * n + j] - known;
            if i == j {
                if rest.is_nan() || rest <= 0.0 {
                    return f64::INFINITY;
                }
                l[i * n + i] = rest.sqrt();
            } else {
                l[i * n + j] = rest / l[j * n + j];
            }
        }
    }
    let mut sum = 0.0;
    let mut column = vec![0.0; n];
    for j in 0..n {
        for i in j..n {
            let known: f64 = (j..i).map(|k| l[i * n + k] * column[k]).sum();
            let unit = if i == j { 1.0 } else { 0.0 };
            column[i] = (unit - known) / l[i * n + i];
            sum += column[i] * column[i];
        }
    }
    sum
}

/// The quintic through two states with their velocities and accelerations, with its slope as the velocity; the cubic where an
/// acceleration is not known.
fn interpolated(a: &Known, b: &Known, x: f64) -> State {
    let h = b.state.t - a.state.t;
    let is_known = |known: &Known| known.a.iter().all(|a| a.is_finite());
    let both = is_known(a) && is_known(b);
    let one = |i: usize| {
        let (q0, q1) = (a.state.q[i], b.state.q[i]);
        let speed = |known: &Known| known.state.v.get(i).copied().unwrap_or((q1 - q0) / h) * h;
        let (v0, v1) = (speed(a), speed(b));
        let bent = |known: &Known| known.a.get(i).copied().unwrap_or(0.0) * h * h;
        if !both {
            let (c2, c3) = (3.0 * (q1 - q0) - 2.0 * v0 - v1, 2.0 * (q0 - q1) + v0 + v1);
            let value = q0 + x * (v0 + x * (c2 + x * c3));
            return (value, (v0 + x * (2.0 * c2 + x * 3.0 * c3)) / h);
        }
        let (a0, a1) = (bent(a), bent(b));
        let (d, dv, da) = (q1 - q0 - v0 - 0.5 * a0, v1 - v0 - a0, a1 - a0);
        let c3 = 10.0 * d - 4.0 * dv + 0.5 * da;
        let c4 = -15.0 * d + 7.0 * dv - da;
        let c5 = 6.0 * d - 3.0 * dv + 0.5 * da;
        let value = q0 + x * (v0 + x * (0.5 * a0 + x * (c3 + x * (c4 + x * c5))));
        let slope = v0 + x * (a0 + x * (3.0 * c3 + x * (4.0 * c4 + x * 5.0 * c5)));
        (value, slope / h)
    };
    let (q, v): (Vec<f64>, Vec<f64>) = (0..a.state.q.len()).map(one).unzip();
    State {
        t: a.state.t + x * h,
        v: v[..a.state.v.len()].to_vec(),
        q,
    }
}

/// The least value of a function between two places, by golden sections.
fn golden(
    [mut low, mut high]: [f64; 2],
    steps: usize,
    mut f: impl FnMut(f64) -> f64,
) -> (f64, f64) {
    let ratio = 0.5 * (5.0_f64.sqrt() - 1.0);
    let inner = |low: f64, high: f64| (high - ratio * (high - low), low + ratio * (high - low));
    let (mut a, mut b) = inner(low, high);
    let (mut fa, mut fb) = (f(a), f(b));
    for _ in 0..steps {
        if fa < fb {
            (high, b, fb) = (b, a, fa);
            a = inner(low, high).0;
            fa = f(a);
        } else {
            (low, a, fa) = (a, b, fb);
            b = inner(low, high).1;
            fb = f(b);
        }
    }
    if fa < fb {
        (a, fa)
    } else {
        (b, fb)
    }
}
