//! Whether a motion and an extremal of the action from the same state are one curve: both are integrated in double precision,
//! and `hamilton.stationary` must say the same.
//!
//! κ(0) is taken in two ways, from the conditions of the closure and as that with which the accelerations differ least; where the
//! nearer of both curves leaves the motion, the action is not stationary for it.

use super::{Expected, Kind, Subject, Trial};
use chetaev_integrate::{integrate, try_from_fn, EvaluationFailure, Options};
use chetaev_mechanics::claims::formulation::derive;
use chetaev_mechanics::sample::Point;
use chetaev_principles::stationarity::Closure;
use chetaev_symbolic::verdict::{Counterexample, Proof};
use chetaev_symbolic::{Expr, Symbol, Verdict};

const STATIONARY: &str = "hamilton.stationary";
/// How long both are followed.
const DURATION: f64 = 0.3;
/// From so many states.
const STATES: usize = 3;
/// Local error.
const TOLERANCE: f64 = 1e-11;
/// At most so many steps.
const STEPS: u64 = 200;
/// Curves that are nearer, relative to their size, are one; farther they are two.
pub(super) const ONE: f64 = 1e-8;
pub(super) const TWO: f64 = 1e-6;
/// What is added to a matrix so that free multipliers stay small.
const RIDGE: f64 = 1e-12;

/// The trial, where the curves are clearly one or clearly two.
pub(super) fn integrated(subject: &Subject<'_>) -> Option<Trial> {
    let cx = subject.cx;
    if !cx.system.masses.is_empty() || subject.natural.dependent.is_empty() {
        return None;
    }
    let curves = Curves::new(subject)?;
    let states = subject.states.iter().take(STATES);
    // At one state both may be one by chance, as where nothing moves.
    let gap = states.fold(None, |worst: Option<f64>, state| {
        match curves.nearest_gap(subject, state) {
            Some(nearest) => Some(worst.map_or(nearest, |worst| worst.max(nearest))),
            None => worst,
        }
    })?;
    let expected = match gap {
        gap if gap < ONE => Expected::Proved,
        gap if gap > TWO => Expected::Refuted,
        _ => return None,
    };
    let word = cx.finding(STATIONARY).verdict.word();
    let detail = format!("`{STATIONARY}` is {word}; the curves are {gap:.1e} apart");
    let verdict = match word {
        "proved" => Verdict::Proved(Proof::structural("for this verdict", detail)),
        // A state drawn at random is on no invariant subset.
        "refuted" | "conditional" => Verdict::Refuted(Counterexample {
            point: Vec::new(),
            quantity: "distance of motion and extremal".into(),
            residual: (format!("{gap:e}"), format!("{gap:e}")),
            detail,
        }),
        _ => Verdict::undecided(detail),
    };
    Some(Trial {
        kind: Kind::Other,
        law: "stationary where motion and extremal are one curve",
        formulation: "",
        about: String::new(),
        expected,
        verdict,
        seconds: 0.0,
    })
}

/// Both systems of equations.
pub(super) struct Curves<'a> {
    subject: &'a Subject<'a>,
    /// q, v.
    state: Vec<Symbol>,
    /// κ.
    multipliers: Vec<Symbol>,
    motion: Vec<Expr>,
    /// q'' and κ'.
    extremum: Vec<Expr>,
}

impl<'a> Curves<'a> {
    pub(super) fn new(subject: &'a Subject<'a>) -> Option<Curves<'a>> {
        let cx = subject.cx;
        let regular = ["model.forces-absent", "model.constrained-extremum-regular"];
        let holds = |id: &str| matches!(cx.finding(id).verdict, Verdict::Proved(_));
        if !regular.iter().all(|id| holds(id)) {
            return None;
        }
        let extremum = derive(cx, "vakonomic").ok()?;
        let own = extremum.variables.iter().filter(|x| x.definition.is_none());
        let (multipliers, rates): (Vec<Symbol>, Vec<Expr>) =
            own.map(|x| (x.symbol, x.rate)).unzip();
        let coordinates = &cx.system.coordinates;
        Some(Curves {
            subject,
            state: coordinates
                .iter()
                .map(|c| c.q_symbol)
                .chain(coordinates.iter().map(|c| c.v_symbol))
                .collect(),
            multipliers,
            motion: subject.routh.accelerations.clone(),
            extremum: extremum.accelerations.into_iter().chain(rates).collect(),
        })
    }

    fn at(&self, es: &[Expr], start: &Point, t: f64, y: &[f64]) -> Option<Vec<f64>> {
        let g = &self.subject.cx.system.graph;
        let time = g.intern_symbol("t", 0);
        let symbols = || self.state.iter().chain(&self.multipliers);
        let value = |s: Symbol| match symbols().position(|&own| own == s) {
            Some(place) => y.get(place).copied(),
            None if s == time => Some(t),
            None => start.get(&s).copied(),
        };
        let values = g.evaluate_f64(es, &value).ok()?;
        values.iter().all(|x| x.is_finite()).then_some(values)
    }

    fn time(&self, start: &Point) -> f64 {
        let time = self.subject.cx.system.graph.intern_symbol("t", 0);
        start.get(&time).copied().unwrap_or(0.0)
    }

    fn begin(&self, start: &Point) -> Option<Vec<f64>> {
        self.state.iter().map(|s| start.get(s).copied()).collect()
    }

    /// How far the motion and the extremal with κ(0) are apart at the end, relative to their size.
    pub(super) fn gap(&self, start: &Point, kappa: &[f64]) -> Option<f64> {
        let motion = self.follow(start, None)?;
        let extremal = self.follow(start, Some(kappa))?;
        let size = motion.iter().fold(1.0_f64, |m, x| m.max(x.abs()));
        let pairs = motion.iter().zip(&extremal);
        Some(pairs.fold(0.0_f64, |m, (a, b)| m.max((a - b).abs())) / size)
    }

    /// The gap to the nearer of the extremals with κ(0) by the conditions and by the accelerations.
    pub(super) fn nearest_gap(&self, subject: &Subject<'_>, start: &Point) -> Option<f64> {
        let multipliers = self.multipliers(subject, start).into_iter();
        let gaps = multipliers.filter_map(|kappa| self.gap(start, &kappa));
        gaps.min_by(f64::total_cmp)
    }

    /// (q, v) at the end of the motion, or of the extremal with κ(0).
    fn follow(&self, start: &Point, kappa: Option<&[f64]>) -> Option<Vec<f64>> {
        let n = self.state.len() / 2;
        let mut y0 = self.begin(start)?;
        y0.extend(kappa.into_iter().flatten());
        let outputs = if kappa.is_some() {
            &self.extremum
        } else {
            &self.motion
        };
        let domain = EvaluationFailure::Domain { operation: 0 };
        let mut flow = try_from_fn(y0.len(), |t: f64, y: &[f64], rate: &mut [f64]| {
            let values = self.at(outputs, start, t, y).ok_or(domain)?;
            rate[..n].copy_from_slice(&y[n..2 * n]);
            rate[n..].copy_from_slice(&values);
            Ok(())
        });
        let mut options = Options::tolerance(TOLERANCE);
        options.step_limit = STEPS;
        let t0 = self.time(start);
        let t1 = t0 + DURATION;
        let solution = integrate(&mut flow, (t0, t1), &y0, &mut [], options).ok()?;
        let mut state = solution.state;
        state.truncate(2 * n);
        (solution.t == t1 && state.iter().all(|x| x.abs() < 1e3)).then_some(state)
    }

    /// κ(0) by the conditions of the closure, and by the accelerations.
    fn multipliers(&self, subject: &Subject<'_>, start: &Point) -> Vec<Vec<f64>> {
        let r = self.multipliers.len();
        let mut found = Vec::new();
        let closure = Closure::of(subject.cx);
        if let Ok(closure) = closure.as_ref() {
            let rows: Vec<Vec<Expr>> = closure
                .conditions
                .iter()
                .map(|c| c.coefficients.iter().copied().chain([c.right]).collect())
                .collect();
            let y = self.begin(start);
            let values = y.and_then(|y| self.at(&rows.concat(), start, self.time(start), &y));
            let values = values.unwrap_or_default();
            let rows = values.chunks(r + 1).map(|row| (row[..r].to_vec(), row[r]));
            found.extend(least_squares(&rows.collect::<Vec<_>>(), r));
        }
        found.extend(self.nearest(start));
        found
    }

    /// κ with which the accelerations differ least, by two steps of Gauss and Newton from zero.
    fn nearest(&self, start: &Point) -> Option<Vec<f64>> {
        let (n, r) = (self.state.len() / 2, self.multipliers.len());
        let (y, t) = (self.begin(start)?, self.time(start));
        let accelerations = self.at(&self.motion, start, t, &y)?;
        let extremum = self.extremum[..n].to_vec();
        let g = &self.subject.cx.system.graph;
        let slopes = g.jacobian(&extremum, &self.multipliers).concat();
        let mut kappa = vec![0.1; r];
        for _ in 0..4 {
            let with: Vec<f64> = y.iter().chain(&kappa).copied().collect();
            let values = self.at(&extremum, start, t, &with)?;
            let slopes = self.at(&slopes, start, t, &with)?;
            let rows: Vec<(Vec<f64>, f64)> = (0..n)
                .map(|i| {
                    (
                        slopes[i * r..(i + 1) * r].to_vec(),
                        accelerations[i] - values[i],
                    )
                })
                .collect();
            let step = least_squares(&rows, r)?;
            kappa.iter_mut().zip(step).for_each(|(k, s)| *k += s);
        }
        Some(kappa)
    }
}

/// The solution of least squares of `rows · x = right`, with a little of |x|² against directions that are free.
fn least_squares(rows: &[(Vec<f64>, f64)], r: usize) -> Option<Vec<f64>> {
    let mut matrix = vec![vec![0.0; r + 1]; r];
    for (row, right) in rows {
        for i in 0..r {
            for j in 0..r {
                matrix[i][j] += row[i] * row[j];
            }
            matrix[i][r] += row[i] * right;
        }
    }
    for (i, row) in matrix.iter_mut().enumerate() {
        row[i] += RIDGE;
    }
    for step in 0..r {
        let size = |i: &usize| matrix[*i][step].abs();
        let best = (step..r).max_by(|a, b| size(a).total_cmp(&size(b)))?;
        matrix.swap(step, best);
        let pivot = matrix[step].clone();
        if pivot[step] == 0.0 {
            return None;
        }
        for (i, row) in matrix.iter_mut().enumerate() {
            if i != step {
                let factor = row[step] / pivot[step];
                row.iter_mut()
                    .zip(&pivot)
                    .for_each(|(x, p)| *x -= factor * p);
            }
        }
    }
    Some((0..r).map(|i| matrix[i][r] / matrix[i][i]).collect())
}
