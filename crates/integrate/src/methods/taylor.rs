//! The Taylor method of variable order and step.
//!
//! The coefficients come from the system ([`System::expand`]). With w_i the tolerated error of component i and
//! |x_[j]| = max_i |x_[j],i|/w_i, the step h of order p is the one at which the last two terms of the series are
//! negligible, |x_[p]| h^p ≤ e^(−2) and |x_[p−1]| h^(p−1) ≤ 1, with the safety factor exp(−0.7/(p − 1)). For w = ε max
//! |x| this is the rule of Jorba & Zou 2005, Exp. Math. 14, 3.2; weighing each component by itself keeps one that grows
//! without bound, such as an angle, from loosening the control of the others.
//!
//! The order is the one of least cost per time: h behaves as ε^(1/p), and a step costs p (p + c), dot products of mean
//! length p/2 and what is done once per order, whence p (2p + c) = L (p + c), L = −ln ε. Jorba & Zou's p = L/2 is c = 0.
//!
//! Coefficients may deceive: a series knows nothing of a corner ahead. So the derivative at the end of the step is
//! compared with that of the polynomial, and the step halved where they differ.

#![allow(clippy::needless_range_loop)] // What is done for every order has to be inlined, which iterators are not always.

use crate::control::{ErrorControl, Scale};
use crate::dense::{Basis, DenseStep};
use crate::method::{Attempt, Method, MethodCard, State, Stepper, StepperSettings};
use crate::problem::{EvaluationFailure, System};

/// Taylor series of variable order and step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TaylorMethod {
    card: MethodCard,
}

/// Taylor series of variable order and step, for systems that give their coefficients.
pub static TAYLOR: TaylorMethod = TaylorMethod {
    card: MethodCard {
        name: "taylor",
        title: "Taylor series of variable order and step",
        order: 0,
        dense_order: 0,
        adaptive: true,
        least_tolerance: f64::EPSILON,
        needs_series: true,
        source: "Jorba, Zou 2005, Exp. Math. 14",
    },
};

/// Orders taken, whatever the tolerance.
const LEAST: usize = 4;
const MOST: usize = 40;
/// Difference of the derivatives at the end of a step, times its length, in units of the tolerance.
const DEFECT: f64 = 10.0;
/// Rounding of the derivatives, which no step size reduces, in units of their size.
const ROUNDING: f64 = 1e4 * f64::EPSILON;
/// The next step may be longer than the last one's radius allowed by this factor.
const GROW: f64 = 10.0;

/// What is done once per order, in units of half a multiplication per instruction; measured on models of the gallery.
const PER_ORDER: f64 = 20.0;

/// The order for a relative tolerance.
fn order_for(tolerance: f64) -> usize {
    order_by(tolerance, PER_ORDER).clamp(LEAST, MOST)
}

/// The order p of least cost p (p + c) per step for a relative tolerance, without bounds.
pub(crate) fn order_by(tolerance: f64, c: f64) -> usize {
    let logarithm = -libm::log(tolerance);
    let surplus = logarithm - c;
    let order = (1.0 + (surplus + (surplus * surplus + 8.0 * logarithm * c).sqrt()) / 4.0).ceil();
    // A tolerance that is not a number gives the lowest order.
    order.max(0.0) as usize
}

/// The step at which the last two terms of a series that do not vanish are negligible, and the component that limits it;
/// `write_row` writes the coefficients of one order into `row`. Parity may null every second term; a solution all of whose upper
/// half vanishes is a polynomial, and its step infinite.
pub(crate) fn radius_of(
    order: usize,
    weights: &[f64],
    row: &mut [f64],
    write_row: &dyn Fn(usize, &mut [f64]),
) -> (f64, usize) {
    let (mut radius, mut limiting, mut seen) = (f64::INFINITY, 0, 0);
    for j in (order / 2 + 1..=order).rev() {
        let (mut norm, mut worst): (f64, usize) = (0.0, 0);
        write_row(j, row);
        for i in 0..weights.len() {
            let (c, w) = (row[i].abs(), weights[i]);
            if c > norm * w {
                (norm, worst) = (c / w, i);
            }
        }
        if norm == 0.0 {
            continue;
        }
        // The logarithm of the step.
        let allowed = if seen == 0 { -2.0 } else { 0.0 };
        let step = (allowed - libm::log(norm)) / j as f64;
        if step < radius {
            (radius, limiting) = (step, worst);
        }
        seen += 1;
        if seen == 2 {
            break;
        }
    }
    (libm::exp(radius - 0.7 / (order as f64 - 1.0)), limiting)
}

/// Components whose sums are formed side by side, in registers.
const BLOCK: usize = 4;

/// Σ_{j≥1} x_[j] h^j and its derivative of N components from `first` on; the rows are the coefficients of the orders from 1 on.
#[inline(always)]
fn horner<const N: usize>(rows: &[f64], n: usize, first: usize, h: f64) -> ([f64; N], [f64; N]) {
    let (mut sum, mut slope) = ([0.0; N], [0.0; N]);
    for row in rows.chunks_exact(n).rev() {
        let own = &row[first..first + N];
        for i in 0..N {
            slope[i] = sum[i] + h * slope[i];
            sum[i] = own[i] + h * sum[i];
        }
    }
    for i in 0..N {
        slope[i] = sum[i] + h * slope[i];
        sum[i] *= h;
    }
    (sum, slope)
}

/// The first number that is not finite.
fn not_finite(numbers: &[f64]) -> Option<usize> {
    // Zero where all are finite; side by side, so that no addition waits for the one before.
    let (blocks, rest) = numbers.as_chunks::<8>();
    let mut traces = [0.0; 8];
    for block in blocks {
        for i in 0..8 {
            traces[i] += 0.0 * block[i];
        }
    }
    let mut trace = 0.0;
    for x in traces.iter().chain(rest) {
        trace += 0.0 * x;
    }
    match trace == 0.0 {
        true => None,
        false => numbers.iter().position(|x| !x.is_finite()),
    }
}

impl Method for TaylorMethod {
    fn card(&self) -> &MethodCard {
        &self.card
    }

    fn order(&self, error: &ErrorControl) -> u32 {
        let tolerance = if error.rtol > 0.0 {
            error.rtol
        } else {
            error.atol
        };
        order_for(tolerance) as u32
    }

    fn stepper(&self, n: usize, settings: &StepperSettings) -> Box<dyn Stepper> {
        Box::new(Expansion {
            n,
            fixed: settings.fixed,
            compensated: settings.compensated,
            scale: Scale::new(&settings.error, n),
            relative: (0..n).map(|i| settings.error.of(i).0 > 0.0).collect(),
            weights: vec![0.0; n],
            coefficients: vec![0.0; n * (MOST + 1)],
            order: LEAST,
            asked: LEAST,
            radius: 0.0,
            worst: 0,
            is_fresh: false,
            is_weighed: false,
            is_taken: false,
            has_coefficients: false,
            end_at: None,
            end: vec![0.0; 2 * n],
            increment: vec![0.0; n],
            slope: vec![0.0; n],
            strictest: f64::NAN,
            h: 0.0,
            evaluations: 0,
        })
    }
}

/// Working storage of one run.
struct Expansion {
    n: usize,
    fixed: bool,
    compensated: bool,
    scale: Scale,
    /// Whether a component has a relative tolerance.
    relative: Vec<bool>,
    /// Tolerated errors at the start of the step.
    weights: Vec<f64>,
    /// x_[0], x_[1], … one after the other.
    coefficients: Vec<f64>,
    order: usize,
    /// The order chosen for the tolerance; coefficients that overflow make that of a step lower.
    asked: usize,
    /// The step that the coefficients allow; infinite where the solution is a polynomial of low degree.
    radius: f64,
    worst: usize,
    /// Whether the coefficients are those of the present start.
    is_fresh: bool,
    /// Whether the weights are those of the state at which the next expansion is made.
    is_weighed: bool,
    /// Whether the series of the next attempt was taken from elsewhere.
    is_taken: bool,
    /// Whether the coefficients of the present start are here, and not elsewhere.
    has_coefficients: bool,
    /// The length for which increment and slope were taken from elsewhere.
    end_at: Option<f64>,
    /// State and derivative at the end of the step.
    end: Vec<f64>,
    increment: Vec<f64>,
    /// The derivative of the polynomial at the end of the step.
    slope: Vec<f64>,
    /// The tolerance for which the order was chosen.
    strictest: f64,
    h: f64,
    evaluations: u64,
}

impl Expansion {
    fn expand(&mut self, system: &mut dyn System, from: &State) -> Result<(), EvaluationFailure> {
        (self.is_fresh, self.is_taken, self.end_at) = (false, false, None);
        if !std::mem::take(&mut self.is_weighed) {
            self.weigh(&from.y);
        }
        self.evaluations += 1;
        self.fetch(system, from)?;
        let coefficients = &self.coefficients[..(self.order + 1) * self.n];
        if let Some(place) = not_finite(coefficients) {
            // Close to a pole the high coefficients overflow while the step is still well determined by the others.
            let known = (place / self.n).saturating_sub(1);
            if known < LEAST {
                let component = place % self.n;
                return Err(EvaluationFailure::NotFinite { component });
            }
            self.order = known;
        }
        self.choose_radius();
        self.is_fresh = true;
        Ok(())
    }

    /// Asks for the coefficients.
    fn fetch(&mut self, system: &mut dyn System, from: &State) -> Result<(), EvaluationFailure> {
        let coefficients = &mut self.coefficients[..(self.order + 1) * self.n];
        let state = (&from.y[..], &from.carry[..]);
        system.expand(from.t.high, state, self.order, coefficients)?;
        self.has_coefficients = true;
        Ok(())
    }

    /// The same where the expansion was taken from elsewhere and more is needed than the end of the step. It counts once.
    fn fetch_missing(
        &mut self,
        system: &mut dyn System,
        from: &State,
    ) -> Result<(), EvaluationFailure> {
        match self.has_coefficients {
            true => Ok(()),
            false => self.fetch(system, from),
        }
    }

    /// Tolerated errors, and the order that the strictest of them asks for.
    fn weigh(&mut self, y: &[f64]) {
        let mut strictest: f64 = 1.0;
        for (i, &y) in y.iter().enumerate() {
            self.weights[i] = self.scale.of(i, y.abs());
            let size = if self.relative[i] {
                y.abs().max(1.0)
            } else {
                1.0
            };
            strictest = strictest.min(self.weights[i] / size);
        }
        if strictest != self.strictest {
            self.strictest = strictest;
            self.asked = order_for(strictest);
        }
        self.order = self.asked;
    }

    /// The radius by the coefficients that are here.
    fn choose_radius(&mut self) {
        let coefficients = std::mem::take(&mut self.coefficients);
        let n = self.n;
        self.choose_radius_by(&|j, row| row.copy_from_slice(&coefficients[j * n..(j + 1) * n]));
        self.coefficients = coefficients;
    }

    fn choose_radius_by(&mut self, write_row: &dyn Fn(usize, &mut [f64])) {
        let row = &mut self.end[..self.n];
        (self.radius, self.worst) = radius_of(self.order, &self.weights, row, write_row);
    }

    /// Σ_{j≥1} x_[j] h^j and its derivative, by Horner's scheme for both at once.
    fn sum(&mut self, h: f64) {
        let n = self.n;
        let rows = &self.coefficients[n..(self.order + 1) * n];
        let mut first = 0;
        while first + BLOCK <= n {
            let (sum, slope) = horner::<BLOCK>(rows, n, first, h);
            self.increment[first..first + BLOCK].copy_from_slice(&sum);
            self.slope[first..first + BLOCK].copy_from_slice(&slope);
            first += BLOCK;
        }
        while first < n {
            let ([sum], [slope]) = horner::<1>(rows, n, first, h);
            (self.increment[first], self.slope[first]) = (sum, slope);
            first += 1;
        }
    }

    /// The largest difference of the derivatives at the end, in units of what is tolerated, and its component.
    fn defect(
        &mut self,
        system: &mut dyn System,
        h: f64,
        to: &State,
    ) -> Result<(f64, usize), EvaluationFailure> {
        let n = self.n;
        self.evaluations += 1;
        system.expand(to.t.high, (&to.y, &to.carry), 1, &mut self.end)?;
        let rates = &self.end[n..];
        if let Some(component) = not_finite(rates) {
            return Err(EvaluationFailure::NotFinite { component });
        }
        let fastest = rates.iter().fold(0.0, |m: f64, rate| m.max(rate.abs()));
        let (mut largest, mut worst) = (0.0, 0);
        for i in 0..n {
            let (rate, slope) = (rates[i], self.slope[i]);
            let tolerated = self.scale.of(i, to.y[i].abs()).max(self.weights[i]);
            let gap = h.abs() * (rate - slope).abs();
            let defect = gap / (DEFECT * tolerated + h.abs() * ROUNDING * fastest);
            if defect > largest {
                (largest, worst) = (defect, i);
            }
        }
        Ok((largest, worst))
    }
}

impl Stepper for Expansion {
    fn start(
        &mut self,
        system: &mut dyn System,
        from: &State,
        _direction: f64,
        span: f64,
    ) -> Result<f64, EvaluationFailure> {
        self.expand(system, from)?;
        Ok(if self.fixed {
            0.0
        } else {
            self.radius.min(span)
        })
    }

    fn restart(&mut self, system: &mut dyn System, from: &State) -> Result<(), EvaluationFailure> {
        // A series taken from elsewhere is that of the state as it was changed.
        match std::mem::take(&mut self.is_taken) {
            true => Ok(()),
            false => self.expand(system, from),
        }
    }

    fn next_expansion(&mut self, from: &State, is_changed: bool) -> Option<usize> {
        if self.is_fresh && !is_changed {
            return None;
        }
        self.weigh(&from.y);
        self.is_weighed = true;
        Some(self.order)
    }

    fn take_series(&mut self, row: &dyn Fn(usize, &mut [f64])) {
        self.evaluations += 1;
        self.choose_radius_by(row);
        (self.is_weighed, self.has_coefficients, self.end_at) = (false, false, None);
        (self.is_fresh, self.is_taken) = (true, true);
    }

    fn limited(&self, from: &State, h: f64) -> f64 {
        match self.fixed {
            true => h,
            // The series is asked for at a float.
            false => from.t.to_float(h.abs().min(self.radius).copysign(h)),
        }
    }

    fn take_end(
        &mut self,
        (from, to): (&State, &mut State),
        h: f64,
        (increment, slope): (&[f64], &[f64]),
    ) {
        self.increment.copy_from_slice(increment);
        self.slope.copy_from_slice(slope);
        to.advance(self.compensated, from, h, &self.increment);
        self.end_at = Some(h);
    }

    fn attempt(
        &mut self,
        system: &mut dyn System,
        from: &State,
        h: f64,
        to: &mut State,
    ) -> Result<Attempt, EvaluationFailure> {
        if !self.is_fresh {
            self.expand(system, from)?;
        }
        self.is_taken = false;
        let h = self.limited(from, h);
        self.h = h;
        if self.end_at.take() != Some(h) {
            self.fetch_missing(system, from)?;
            self.sum(h);
            to.advance(self.compensated, from, h, &self.increment);
        }
        if let Some(component) = not_finite(&to.y) {
            return Err(EvaluationFailure::NotFinite { component });
        }
        let mut attempt = Attempt {
            accepted: true,
            h,
            next: h,
            error: 0.0,
            worst: self.worst,
            stiffness: None,
        };
        if self.fixed {
            return Ok(attempt);
        }
        let (defect, worst) = self.defect(system, h, to)?;
        attempt.error = defect;
        if defect > 1.0 {
            attempt.accepted = false;
            attempt.worst = worst;
            attempt.next = 0.5 * h;
        } else {
            attempt.next = (GROW * self.radius).copysign(h);
        }
        Ok(attempt)
    }

    fn failed(&mut self) {}

    fn dense(
        &mut self,
        system: &mut dyn System,
        from: &State,
        _to: &State,
        dense: &mut DenseStep,
    ) -> Result<(), EvaluationFailure> {
        self.fetch_missing(system, from)?;
        let filled = (self.order + 1) * self.n;
        dense.start = from.t;
        dense.h = self.h;
        dense.basis = Basis::Monomial;
        dense.coefficients.clear();
        dense
            .coefficients
            .extend_from_slice(&self.coefficients[..filled]);
        let mut power = 1.0;
        for (j, row) in dense.coefficients.chunks_mut(self.n.max(1)).enumerate() {
            if j > 0 {
                power *= self.h;
                row.iter_mut().for_each(|c| *c *= power);
            }
        }
        Ok(())
    }

    fn commit(&mut self) {
        self.is_fresh = false;
    }

    fn evaluations(&self) -> u64 {
        self.evaluations
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_order_follows_the_tolerance() {
        // p (2p + 20) = L (p + 20) for L = 36.84 and 20.72: p = 23.86 and 14.58, one more, rounded up.
        assert_eq!(order_for(1e-16), 25);
        assert_eq!(order_for(1e-9), 16);
        assert_eq!(order_for(0.5), LEAST);
        assert_eq!(order_for(0.0), MOST);
        assert_eq!(order_for(f64::NAN), LEAST);
    }
}
