//! Why the step size went to zero: a failing evaluation, a singularity of the motion, or a tolerance out of reach.

use crate::compensated::Time;
use crate::method::State;
use crate::problem::EvaluationFailure;
use crate::solution::Stop;

/// The present rate of change over the mean speed of the whole run, above which a collapse of the step size is put
/// down to a derivative that grows without bound.
const GROWTH: f64 = 1e4;

/// Growth of the rate of change of a component between two marks of its way into a singularity.
const MARK: f64 = 16.0;

/// A component at the time when its rate of change had grown by another factor [`MARK`].
///
/// Near a power law y ~ δ^(−a), δ the time to the singularity, marks are at δ in geometric progression, and the
/// changes of y from mark to mark have the ratio 16^(a/(a+1)): 1 for a logarithm, less if y stays bounded.
#[derive(Debug, Clone, Copy, Default)]
struct Mark {
    t: f64,
    y: f64,
    rate: f64,
}

/// What the steps of a run say about the way it may end.
#[derive(Debug)]
pub(crate) struct Collapse {
    start: Time,
    /// Total variation of each component so far.
    variation: Vec<f64>,
    /// Rate of change of each component over the last accepted step.
    rates: Vec<f64>,
    /// The last three marks of each component.
    marks: Vec<[Mark; 3]>,
    /// Failure of the last attempt since the last accepted step.
    failure: Option<EvaluationFailure>,
    worst: usize,
}

impl Collapse {
    pub(crate) fn new(t0: f64, n: usize) -> Collapse {
        Collapse {
            start: Time::exact(t0),
            variation: vec![0.0; n],
            rates: vec![0.0; n],
            marks: vec![[Mark::default(); 3]; n],
            failure: None,
            worst: 0,
        }
    }

    pub(crate) fn rejected(&mut self, worst: usize) {
        self.worst = worst;
        self.failure = None;
    }

    pub(crate) fn failed(&mut self, failure: EvaluationFailure) {
        self.failure = Some(failure);
    }

    pub(crate) fn accepted(&mut self, from: &State, to: &State, h: f64) {
        let changes = to.y.iter().zip(&from.y);
        self.changed((to.t.high, &to.y), changes.map(|(to, from)| to - from), h);
    }

    /// The same by the changes of the components over a step of length h to (t, y).
    pub(crate) fn changed(
        &mut self,
        (t, y): (f64, &[f64]),
        changes: impl Iterator<Item = f64>,
        h: f64,
    ) {
        self.failure = None;
        for (i, change) in changes.enumerate() {
            let rate = change / h;
            self.rates[i] = rate;
            self.variation[i] += change.abs();
            let [_, second, last] = self.marks[i];
            if rate.abs() > MARK * last.rate {
                let mark = Mark {
                    t,
                    y: y[i],
                    rate: rate.abs(),
                };
                self.marks[i] = [second, last, mark];
            }
        }
    }

    /// Present rate of change of component i over its mean speed.
    fn growth(&self, i: usize, now: &State) -> f64 {
        let mean = self.variation[i] / now.t.until(self.start.high).abs();
        if mean > 0.0 {
            self.rates[i].abs() / mean
        } else {
            0.0
        }
    }

    /// The stop for a step h that would have to be shorter than time resolves.
    pub(crate) fn stop(&self, now: &State, h: f64) -> Stop {
        let t = now.t.high;
        match self.failure {
            Some(EvaluationFailure::NotFinite { component }) => {
                return Stop::NotFinite { t, component }
            }
            Some(failure) => return Stop::Singular { t, failure },
            None => {}
        }
        let mut component = 0;
        for i in 1..self.rates.len() {
            if self.growth(i, now) > self.growth(component, now) {
                component = i;
            }
        }
        if self.rates.is_empty() || self.growth(component, now) <= GROWTH {
            return Stop::StepTooSmall {
                t,
                component: self.worst,
                h,
            };
        }
        let [first, second, last] = self.marks[component];
        let grows = self.rates[component] * now.y[component] * h.signum() > 0.0;
        Stop::Divergence {
            t,
            singularity: singularity(now, [first.t, second.t, last.t], h.signum()),
            component,
            unbounded: grows && (last.y - second.y).abs() > 0.5 * (second.y - first.y).abs(),
        }
    }
}

/// Limit of times in geometric progression (Aitken's extrapolation), which cannot lie before the present time.
fn singularity(now: &State, [first, second, last]: [f64; 3], direction: f64) -> f64 {
    let (before, after) = (second - first, last - second);
    let limit = last + after * after / (before - after);
    if (limit - now.t.high) * direction > 0.0 {
        limit
    } else {
        now.t.high
    }
}
