//! The largest violation of each constraint over a run, before any projection.

use crate::numeric::NumericSystem;

/// A largest absolute value and when it occurred.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Extreme {
    /// The largest absolute value.
    pub value: f64,
    /// The time of it.
    pub t: f64,
}

impl Extreme {
    /// Takes a new value into account.
    pub fn record(&mut self, value: f64, t: f64) {
        if value.abs() > self.value {
            *self = Extreme {
                value: value.abs(),
                t,
            };
        }
    }
}

/// Takes one value of each into account; over indices, since it is done at every step.
fn record(extremes: &mut [Extreme], values: &[f64], t: f64) {
    for i in 0..extremes.len().min(values.len()) {
        extremes[i].record(values[i], t);
    }
}

/// Drift of every constraint row and of every holonomic constraint.
#[derive(Clone, Debug, PartialEq)]
pub struct Drift {
    /// |f| by row.
    pub velocity: Vec<Extreme>,
    /// |φ| of the holonomic constraints.
    pub position: Vec<Extreme>,
    /// Steps looked at.
    pub steps: u64,
}

impl Drift {
    /// Nothing recorded yet.
    pub fn new(system: &NumericSystem) -> Drift {
        Drift {
            velocity: vec![Extreme::default(); system.r],
            position: vec![Extreme::default(); system.holonomic.len()],
            steps: 0,
        }
    }

    /// Records the residuals of the last evaluation.
    pub fn record(&mut self, system: &NumericSystem, t: f64) {
        self.take(system.residual(), system.position_residual(), t);
    }

    /// Records residuals by row, and those of the holonomic constraints.
    pub(crate) fn take(&mut self, velocities: &[f64], positions: &[f64], t: f64) {
        self.steps += 1;
        record(&mut self.velocity, velocities, t);
        record(&mut self.position, positions, t);
    }

    /// Adds what was recorded further on.
    pub(crate) fn go_on(&mut self, further: &Drift) {
        self.steps += further.steps;
        let own = self.velocity.iter_mut().chain(&mut self.position);
        let further = further.velocity.iter().chain(&further.position);
        own.zip(further)
            .for_each(|(own, further)| own.record(further.value, further.t));
    }

    /// The largest of all.
    pub fn largest(&self) -> f64 {
        self.velocity
            .iter()
            .chain(&self.position)
            .fold(0.0, |m, e| m.max(e.value))
    }
}
