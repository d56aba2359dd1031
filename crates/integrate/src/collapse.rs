//! Why the step size went to zero: a failing evaluation, a singularity of the motion, or a tolerance out of reach.

use crate::compensated::Time;
use crate::method::State;
use crate::problem::EvaluationFailure;
use crate::solution::Stop;

/// The present rate of change over the mean rate of the whole run, above which a collapse of the step size is put
/// down to a derivative that grows without bound.
const GROWTH: f64 = 1e4;

/// |y'|·(time to the singularity)/|y| above which y itself is taken to be unbounded: the exponent of a power law,
/// or 1/(number of e-foldings) of a logarithm; for a bounded y with an unbounded derivative it tends to zero.
const EXPONENT: f64 = 0.01;

/// What the steps of a run say about the way it may end.
#[derive(Debug)]
pub(crate) struct Collapse {
    start: Time,
    initial: Vec<f64>,
    /// Rate of change of each component over the last accepted step.
    rates: Vec<f64>,
    /// Lengths of the last two accepted steps.
    lengths: [f64; 2],
    /// Failure of the last attempt since the last accepted step.
    failure: Option<EvaluationFailure>,
    worst: usize,
}

impl Collapse {
    pub(crate) fn new(t0: f64, y0: &[f64]) -> Collapse {
        Collapse {
            start: Time::exact(t0),
            initial: y0.to_vec(),
            rates: vec![0.0; y0.len()],
            lengths: [0.0; 2],
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
        self.failure = None;
        self.lengths = [self.lengths[1], h];
        for (rate, (a, b)) in self.rates.iter_mut().zip(from.y.iter().zip(&to.y)) {
            *rate = (b - a) / h;
        }
    }

    /// The stop for a step that would have to be shorter than time resolves.
    pub(crate) fn stop(&self, now: &State, h: f64) -> Stop {
        let t = now.t.high;
        match self.failure {
            Some(EvaluationFailure::NotFinite { component }) => {
                return Stop::NotFinite { t, component }
            }
            Some(failure) => return Stop::Singular { t, failure },
            None => {}
        }
        let elapsed = -now.t.until(self.start.high);
        let growth = |i: usize| {
            let mean = ((now.y[i] - self.initial[i]) / elapsed).abs();
            if mean > 0.0 {
                self.rates[i].abs() / mean
            } else {
                0.0
            }
        };
        let mut component = 0;
        for i in 1..self.rates.len() {
            if growth(i) > growth(component) {
                component = i;
            }
        }
        if self.rates.is_empty() || growth(component) <= GROWTH {
            return Stop::StepTooSmall {
                t,
                component: self.worst,
                h,
            };
        }
        let singularity = self.singularity(now);
        let rate = self.rates[component];
        let y = now.y[component];
        let grows = rate * y * h.signum() > 0.0;
        let exponent = (rate * now.t.until(singularity) / y).abs();
        Stop::Divergence {
            t,
            singularity,
            component,
            unbounded: grows && exponent > EXPONENT,
        }
    }

    /// Limit of the step ends, if the steps shrink geometrically (Aitken's extrapolation).
    fn singularity(&self, now: &State) -> f64 {
        let [before, last] = self.lengths;
        let ahead = last * last / (before - last);
        // Steps that did not shrink: one more step is as good a guess as any at this resolution.
        let ahead = if ahead.is_finite() && ahead * last > 0.0 {
            ahead
        } else {
            last
        };
        now.t.plus(ahead).high
    }
}
