//! Dense output: the polynomial that a method attaches to each accepted step.

use crate::compensated::Time;

/// How the coefficients of a step's polynomial are to be read; θ = (s − t)/h runs from 0 to 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Basis {
    /// c₀ + θ(c₁ + (1−θ)(c₂ + θ(c₃ + (1−θ)(…)))), which meets both ends of the step without rounding
    /// (Hairer, Nørsett, Wanner 1993, II.6).
    Alternating,
    /// c₀ + θ(c₁ + θ(c₂ + …)), the Taylor polynomial in the scaled time.
    Monomial,
}

/// The polynomial of one step.
#[derive(Debug, Clone, PartialEq)]
pub struct DenseStep {
    /// Start of the step.
    pub start: Time,
    /// Signed length of the step.
    pub h: f64,
    /// Meaning of the coefficients.
    pub basis: Basis,
    /// Number of components.
    pub dimension: usize,
    /// Coefficients, all components of c₀ first, then all of c₁, and so on.
    pub coefficients: Vec<f64>,
}

impl DenseStep {
    /// An empty polynomial, to be filled by a method.
    pub fn new(dimension: usize) -> DenseStep {
        DenseStep {
            start: Time::exact(0.0),
            h: 0.0,
            basis: Basis::Alternating,
            dimension,
            coefficients: Vec::new(),
        }
    }

    /// The scaled time θ of time s.
    pub fn theta(&self, s: f64) -> f64 {
        self.start.until(s) / self.h
    }

    /// End of the step.
    pub fn end(&self) -> Time {
        self.start.plus(self.h)
    }

    /// Writes the state at scaled time θ into `y`.
    pub fn at_theta(&self, theta: f64, y: &mut [f64]) {
        let view = DenseView {
            basis: self.basis,
            dimension: self.dimension,
            coefficients: &self.coefficients,
        };
        view.at_theta(theta, y);
    }

    /// Writes the state at time s into `y`.
    pub fn at(&self, s: f64, y: &mut [f64]) {
        self.at_theta(self.theta(s), y);
    }
}

/// Borrowed coefficients of one polynomial.
struct DenseView<'a> {
    basis: Basis,
    dimension: usize,
    coefficients: &'a [f64],
}

impl DenseView<'_> {
    fn at_theta(&self, theta: f64, y: &mut [f64]) {
        let n = self.dimension;
        if n == 0 {
            return;
        }
        let degree = (self.coefficients.len() / n).saturating_sub(1);
        y.copy_from_slice(&self.coefficients[degree * n..(degree + 1) * n]);
        for j in (0..degree).rev() {
            // The factor between c_j and the bracket that starts with c_(j+1).
            let factor = match self.basis {
                Basis::Alternating if j % 2 == 1 => 1.0 - theta,
                _ => theta,
            };
            let lower = &self.coefficients[j * n..(j + 1) * n];
            for (value, c) in y.iter_mut().zip(lower) {
                *value = c + factor * *value;
            }
        }
    }
}

/// The polynomials of all steps of a run, kept on request.
///
/// The state is the one that the system integrates, in the chart of the step; [`Trajectory::chart_epoch`] counts
/// the changes of chart before it.
#[derive(Debug, Clone, PartialEq)]
pub struct Trajectory {
    dimension: usize,
    basis: Basis,
    starts: Vec<Time>,
    lengths: Vec<f64>,
    /// Time where the run stands; a terminal event cuts the last step.
    end: f64,
    epochs: Vec<u32>,
    /// Where the coefficients of each step end.
    ends: Vec<usize>,
    coefficients: Vec<f64>,
}

impl Trajectory {
    pub(crate) fn new(dimension: usize) -> Trajectory {
        Trajectory {
            dimension,
            basis: Basis::Alternating,
            starts: Vec::new(),
            lengths: Vec::new(),
            end: 0.0,
            epochs: Vec::new(),
            ends: Vec::new(),
            coefficients: Vec::new(),
        }
    }

    pub(crate) fn push(&mut self, step: &DenseStep, end: f64, epoch: u32) {
        self.end = end;
        self.basis = step.basis;
        self.starts.push(step.start);
        self.lengths.push(step.h);
        self.epochs.push(epoch);
        self.coefficients.extend_from_slice(&step.coefficients);
        self.ends.push(self.coefficients.len());
    }

    /// Whether time s lies within the run.
    pub fn covers(&self, s: f64) -> bool {
        self.starts.first().is_some_and(|first| {
            (first.high..=self.end).contains(&s) || (self.end..=first.high).contains(&s)
        })
    }

    /// Number of steps.
    pub fn len(&self) -> usize {
        self.starts.len()
    }

    /// Whether no step was made.
    pub fn is_empty(&self) -> bool {
        self.starts.is_empty()
    }

    /// Index of the step that contains time s, or `None` outside of the run.
    pub fn step_at(&self, s: f64) -> Option<usize> {
        if !self.covers(s) {
            return None;
        }
        let forward = self.lengths[0] > 0.0;
        let after = self.starts.partition_point(|t| {
            if forward {
                t.until(s) >= 0.0
            } else {
                t.until(s) <= 0.0
            }
        });
        Some(after.saturating_sub(1))
    }

    /// Number of changes of chart before the step of this index.
    pub fn chart_epoch(&self, step: usize) -> u32 {
        self.epochs[step]
    }

    /// Writes the state at time s into `y` and says which step it came from; `None` outside of the run.
    pub fn at(&self, s: f64, y: &mut [f64]) -> Option<usize> {
        let step = self.step_at(s)?;
        let start = step.checked_sub(1).map_or(0, |before| self.ends[before]);
        let view = DenseView {
            basis: self.basis,
            dimension: self.dimension,
            coefficients: &self.coefficients[start..self.ends[step]],
        };
        view.at_theta(self.starts[step].until(s) / self.lengths[step], y);
        Some(step)
    }
}
