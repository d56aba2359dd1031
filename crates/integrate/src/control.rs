//! Error norms and the choice of the step size.

use crate::compensated::Time;
use crate::method::MethodCard;
use crate::problem::{EvaluationFailure, System};
use crate::IntegrateError;
use libm::pow;

/// Tolerances of the local error.
///
/// A component with error e counts as e / (atol + rtol·max(|y|, |y_new|)), or e / atol where it is marked as
/// [`absolute`](ErrorControl::absolute); the step is accepted if the root of the mean square over the
/// components is at most 1 (Hairer, Nørsett, Wanner 1993, II.4 (4.11)).
#[derive(Debug, Clone, PartialEq)]
pub struct ErrorControl {
    /// Relative tolerance.
    pub rtol: f64,
    /// Absolute tolerance, used where [`atol_of`](ErrorControl::atol_of) is empty; in the units of the component.
    pub atol: f64,
    /// Absolute tolerance per component; empty, or one entry per component.
    pub atol_of: Vec<f64>,
    /// Components controlled by their absolute tolerance alone: cyclic coordinates and angles, which grow without
    /// bound and would make a relative control blind. Empty, or one entry per component.
    pub absolute: Vec<bool>,
}

impl ErrorControl {
    /// The same relative and absolute tolerance for every component.
    pub fn uniform(tolerance: f64) -> ErrorControl {
        ErrorControl {
            rtol: tolerance,
            atol: tolerance,
            atol_of: Vec::new(),
            absolute: Vec::new(),
        }
    }

    /// The same control with all tolerances multiplied by `factor`.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> ErrorControl {
        ErrorControl {
            rtol: self.rtol * factor,
            atol: self.atol * factor,
            atol_of: self.atol_of.iter().map(|a| a * factor).collect(),
            absolute: self.absolute.clone(),
        }
    }

    /// Relative and absolute tolerance of component i.
    pub fn of(&self, i: usize) -> (f64, f64) {
        let atol = self.atol_of.get(i).copied().unwrap_or(self.atol);
        let absolute = self.absolute.get(i).copied().unwrap_or(false);
        (if absolute { 0.0 } else { self.rtol }, atol)
    }

    /// Checks lengths and signs, and that no tolerance is below the least of the method relative to the initial values.
    pub(crate) fn check(&self, card: &MethodCard, y0: &[f64]) -> Result<(), IntegrateError> {
        let (method, least) = (card.name, card.least_tolerance);
        let expected = y0.len();
        for (what, found) in [
            ("the list of absolute tolerances", self.atol_of.len()),
            ("the list of absolute components", self.absolute.len()),
        ] {
            if found != 0 && found != expected {
                return Err(IntegrateError::Dimension {
                    what,
                    expected,
                    found,
                });
            }
        }
        for (component, y) in y0.iter().enumerate() {
            let (rtol, atol) = self.of(component);
            let usable = rtol >= 0.0 && atol >= 0.0 && rtol + atol > 0.0;
            if !usable || !rtol.is_finite() || !atol.is_finite() {
                return Err(IntegrateError::InvalidTolerance {
                    component,
                    rtol,
                    atol,
                });
            }
            // A purely absolute tolerance has to be resolved at the size of the initial value. Slopes do not
            // depend on a cyclic component: only the rounding of its own value counts, and the terms of a series are
            // known whatever it is.
            let cyclic = self.absolute.get(component).copied().unwrap_or(false);
            let (requested, attainable) = if rtol > 0.0 {
                (rtol, least)
            } else if cyclic {
                let rounding = match card.needs_series {
                    true => 0.0,
                    false => y.abs() * least.min(2.0 * f64::EPSILON),
                };
                (atol, rounding)
            } else {
                (atol, y.abs() * least)
            };
            if requested < attainable {
                return Err(IntegrateError::ToleranceTooSmall {
                    method,
                    component,
                    requested,
                    attainable,
                });
            }
        }
        Ok(())
    }
}

/// The tolerances of an [`ErrorControl`] spread over the components, for use in every step.
#[derive(Debug, Clone)]
pub struct Scale {
    tolerances: Vec<(f64, f64)>,
}

impl Scale {
    /// The scale of `control` for a system of dimension n.
    pub fn new(control: &ErrorControl, n: usize) -> Scale {
        Scale {
            tolerances: (0..n).map(|i| control.of(i)).collect(),
        }
    }

    /// The tolerated error of component i when its magnitude is at most `magnitude`.
    #[inline]
    pub fn of(&self, i: usize, magnitude: f64) -> f64 {
        let (rtol, atol) = self.tolerances[i];
        // A component that is exactly zero under a purely relative tolerance must not divide by zero.
        (atol + rtol * magnitude).max(f64::MIN_POSITIVE)
    }

    /// Root of the mean square of v_i / scale_i, with scale at the magnitudes of y.
    pub fn norm(&self, v: &[f64], y: &[f64]) -> f64 {
        let sum: f64 = (0..v.len())
            .map(|i| (v[i] / self.of(i, y[i].abs())).powi(2))
            .sum();
        (sum / v.len().max(1) as f64).sqrt()
    }
}

/// Proportional-integral control of the step size.
///
/// h_new = h·clip(s·err_n^(−α)·err_(n−1)^β, 0.2, 5) with s = 0.9, α = 0.7/q, β = 0.4/q, q the order of the error
/// estimate plus one; no increase after a rejection. Source: Gustafsson 1991; Hairer & Wanner 1996, IV.2.
#[derive(Debug, Clone)]
pub struct Controller {
    alpha: f64,
    beta: f64,
    previous_error: f64,
    after_rejection: bool,
}

/// Errors below this do not count as smaller: a step that is exact by accident must not decide the next ones.
const ERROR_FLOOR: f64 = 1e-4;
const SAFETY: f64 = 0.9;
const SHRINK: f64 = 0.2;
const GROW: f64 = 5.0;

impl Controller {
    /// A controller for an error that behaves as h^q.
    pub fn new(q: f64) -> Controller {
        Controller {
            alpha: 0.7 / q,
            beta: 0.4 / q,
            previous_error: 1.0,
            after_rejection: false,
        }
    }

    /// Factor for the next step after one with this error was accepted.
    pub fn accepted(&mut self, error: f64) -> f64 {
        let raw = SAFETY
            * pow(error.max(1e-10), -self.alpha)
            * pow(self.previous_error.max(ERROR_FLOOR), self.beta);
        let most = if self.after_rejection { 1.0 } else { GROW };
        self.previous_error = error.max(ERROR_FLOOR);
        self.after_rejection = false;
        raw.clamp(SHRINK, most)
    }

    /// Factor for the next attempt after one with this error was rejected.
    pub fn rejected(&mut self, error: f64) -> f64 {
        self.after_rejection = true;
        // One power of the error estimate, without memory: the past step says nothing about this failure.
        let raw = SAFETY * pow(error, -self.alpha / 0.7);
        if raw.is_finite() {
            raw.clamp(SHRINK, SAFETY)
        } else {
            SHRINK
        }
    }

    /// Records that a step failed for another reason, so that the next accepted one does not increase the size.
    pub fn failed(&mut self) {
        self.after_rejection = true;
    }
}

/// The part of the span that is tried where nothing tells a first step.
const SHORT: f64 = 1e-7;

/// Magnitude of a first step, for a method whose error behaves as h^q.
///
/// Source: Hairer, Nørsett, Wanner 1993, II.4 (algorithm "starting step size"). `f0` is F(t, y); `work` are two
/// slices of the dimension that are overwritten. Makes one evaluation; a failure of it only shortens the step.
pub fn initial_step(
    system: &mut dyn System,
    scale: &Scale,
    (t, y, f0): (Time, &[f64], &[f64]),
    (q, direction, span): (f64, f64, f64),
    (y1, f1): (&mut [f64], &mut [f64]),
) -> f64 {
    let d0 = scale.norm(y, y);
    let d1 = scale.norm(f0, y);
    // Times are compared with the span: it is the only one that is known.
    let mut h0 = if d0 < 1e-5 || d1 * span < 1e-5 {
        SHORT * span
    } else {
        (0.01 * d0 / d1).min(span)
    };
    if !h0.is_finite() || h0 <= 0.0 {
        h0 = SHORT * span;
    }
    for _ in 0..20 {
        for i in 0..y.len() {
            y1[i] = y[i] + direction * h0 * f0[i];
        }
        let result: Result<(), EvaluationFailure> =
            system.derivative(t.plus(direction * h0).high, y1, f1);
        if result.is_ok() && f1.iter().all(|f| f.is_finite()) {
            break;
        }
        h0 *= 0.1;
        f1.copy_from_slice(f0);
    }
    for i in 0..y.len() {
        y1[i] = f1[i] - f0[i];
    }
    let d2 = scale.norm(y1, y) / h0;
    // In units of the time in which the state changes by itself, so that it does not depend on those of time.
    let unit = 100.0 * h0;
    let steepest = (d1 * unit).max(d2 * unit * unit);
    let h1 = if steepest <= 1e-15 {
        (h0 * 1e-3).max(SHORT * span)
    } else {
        unit * pow(0.01 / steepest, 1.0 / q)
    };
    (100.0 * h0).min(h1).min(span)
}

/// The least step that still advances the time: 16 units in the last place of t, or, near t = 0, an amount that is
/// negligible against the span.
pub(crate) fn least_step(t: f64, span: f64) -> f64 {
    let ulp = f64::EPSILON * t.abs();
    16.0 * ulp
        .max(f64::EPSILON * f64::EPSILON * span)
        .max(f64::MIN_POSITIVE)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_controller_follows_its_formula() {
        let mut controller = Controller::new(8.0);
        // err^(−0.7/8)·previous^(0.4/8), times 0.9.
        assert_eq!(controller.accepted(1.0), 0.9);
        assert!((controller.accepted(0.1) - 0.9 * 10f64.powf(0.7 / 8.0)).abs() < 1e-15);
        assert!((controller.accepted(1.0) - 0.9 * 10f64.powf(-0.4 / 8.0)).abs() < 1e-15);
        assert_eq!(Controller::new(5.0).accepted(0.0), GROW);
    }

    #[test]
    fn rejections_shrink_and_forbid_growth_once() {
        let mut controller = Controller::new(5.0);
        assert!((controller.rejected(2.0) - 0.9 * 2f64.powf(-0.2)).abs() < 1e-15);
        assert_eq!(controller.rejected(1e30), SHRINK);
        assert_eq!(controller.rejected(f64::INFINITY), SHRINK);
        assert_eq!(controller.accepted(1e-6), 1.0);
        assert!(controller.accepted(1e-6) > 1.5);
        controller.failed();
        assert_eq!(controller.accepted(1e-6), 1.0);
    }

    #[test]
    fn the_least_step_is_relative_to_the_time() {
        assert_eq!(least_step(1.0, 10.0), 16.0 * f64::EPSILON);
        assert!(least_step(0.0, 10.0) < 1e-29 && least_step(0.0, 10.0) > 0.0);
    }
}
