//! The series of one step: its order, the step that it allows, and its sums.

use super::{PreciseOptions, PreciseSystem};
use crate::methods::{order_by, radius_of};
use crate::problem::EvaluationFailure;
use chetaev_double_double::DoubleDouble;

/// Orders taken, whatever the tolerance.
const LEAST: usize = 4;
const MOST: usize = 80;
/// What is done once per order, in units of half a multiplication per instruction: little, since products are twenty times as dear as in
/// doubles.
const PER_ORDER: f64 = 4.0;
/// Difference of the derivatives at the end of a step, times its length, in units of the tolerance.
const DEFECT: f64 = 10.0;
/// Rounding of the derivatives, which no step size reduces, in units of their size.
const ROUNDING: f64 = 1e4 * DoubleDouble::EPSILON;

/// The series through the start of a step.
pub(super) struct Series {
    n: usize,
    order: usize,
    /// Tolerated errors at the start of the step.
    weights: Vec<f64>,
    /// y_[0], y_[1], … one after the other.
    coefficients: Vec<DoubleDouble>,
    /// The step that the coefficients allow.
    pub(super) radius: f64,
    /// The component that limits it.
    pub(super) worst: usize,
    rates: Vec<DoubleDouble>,
    /// Coefficients of one order, in doubles.
    row: Vec<f64>,
    pub(super) evaluations: u64,
}

impl Series {
    pub(super) fn new(n: usize) -> Series {
        Series {
            n,
            order: LEAST,
            weights: vec![0.0; n],
            coefficients: Vec::new(),
            radius: 0.0,
            worst: 0,
            rates: vec![DoubleDouble::ZERO; 2 * n],
            row: vec![0.0; n],
            evaluations: 0,
        }
    }

    /// The series through (t, y).
    pub(super) fn expand(
        &mut self,
        system: &mut dyn PreciseSystem,
        (t, y): (DoubleDouble, &[DoubleDouble]),
        options: &PreciseOptions<'_>,
    ) -> Result<(), EvaluationFailure> {
        let n = self.n;
        let mut strictest: f64 = 1.0;
        for (i, y) in y.iter().enumerate() {
            let size = y.high().abs();
            self.weights[i] = options.tolerated(i, size);
            let measure = if options.is_relative(i) {
                size.max(1.0)
            } else {
                1.0
            };
            strictest = strictest.min(self.weights[i] / measure);
        }
        self.order = order_by(strictest, PER_ORDER).clamp(LEAST, MOST);
        self.coefficients
            .resize((self.order + 1) * n, DoubleDouble::ZERO);
        self.evaluations += 1;
        system.expand(t, y, self.order, &mut self.coefficients)?;
        if let Some(place) = self.coefficients.iter().position(|c| !c.is_finite()) {
            // Close to a pole the high coefficients overflow while the step is well determined by the others.
            let known = (place / n).saturating_sub(1);
            if known < LEAST {
                let component = place % n;
                return Err(EvaluationFailure::NotFinite { component });
            }
            self.order = known;
            self.coefficients.truncate((known + 1) * n);
        }
        let coefficients = &self.coefficients;
        let write_row = |j: usize, row: &mut [f64]| {
            let own = &coefficients[j * n..(j + 1) * n];
            row.iter_mut().zip(own).for_each(|(x, c)| *x = c.high());
        };
        let (order, row) = (self.order, &mut self.row[..]);
        (self.radius, self.worst) = radius_of(order, &self.weights, row, &write_row);
        Ok(())
    }

    /// The state and its derivative at the time h after the start.
    pub(super) fn at(&self, h: DoubleDouble, y: &mut [DoubleDouble], slope: &mut [DoubleDouble]) {
        let n = self.n;
        for i in 0..n {
            let (mut sum, mut derivative) = (DoubleDouble::ZERO, DoubleDouble::ZERO);
            for j in (1..=self.order).rev() {
                derivative = sum + h * derivative;
                sum = self.coefficients[j * n + i] + h * sum;
            }
            slope[i] = sum + h * derivative;
            y[i] = self.coefficients[i] + h * sum;
        }
    }

    /// The largest difference of the derivatives at the end, in units of what is tolerated, and its component.
    pub(super) fn defect(
        &mut self,
        system: &mut dyn PreciseSystem,
        (t, h): (DoubleDouble, f64),
        (y, slope): (&[DoubleDouble], &[DoubleDouble]),
        options: &PreciseOptions<'_>,
    ) -> Result<(f64, usize), EvaluationFailure> {
        let n = self.n;
        self.evaluations += 1;
        system.expand(t, y, 1, &mut self.rates)?;
        let rates = &self.rates[n..];
        if let Some(component) = rates.iter().position(|rate| !rate.is_finite()) {
            return Err(EvaluationFailure::NotFinite { component });
        }
        let sizes = rates.iter().map(|rate| rate.high().abs());
        let fastest = sizes.fold(0.0, f64::max);
        let (mut largest, mut worst) = (0.0, 0);
        for i in 0..n {
            let tolerated = options.tolerated(i, y[i].high().abs()).max(self.weights[i]);
            let gap = h.abs() * (rates[i] - slope[i]).high().abs();
            let defect = gap / (DEFECT * tolerated + h.abs() * ROUNDING * fastest);
            if defect > largest {
                (largest, worst) = (defect, i);
            }
        }
        Ok((largest, worst))
    }
}
