//! Explicit Runge–Kutta methods as data: one engine for every tableau.
//!
//! Notation: F_i stage slopes, i = 0 … s−1; F_s the slope at the end of the step (the first of the next one);
//! F_(s+1), … extra slopes for the dense output only. The dense polynomial is the alternating form of Hairer,
//! Nørsett, Wanner 1993, II.6: the first four coefficients are the Hermite data of the step, the rest are
//! h Σ_i d_i F_i with weights of the tableau.

use crate::control::{initial_step, Controller, Scale};
use crate::dense::{Basis, DenseStep};
use crate::method::{Attempt, Method, MethodCard, State, Stepper, StepperSettings};
use crate::problem::{EvaluationFailure, System};

/// A row of coefficients by the index of the slope that they multiply; absent ones are zero.
pub type Row = &'static [(usize, f64)];

/// How the error of a step is estimated from its slopes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ErrorEstimate {
    /// No estimate: only fixed steps.
    None,
    /// Difference e of the solution and an embedded one of lower order, given as weights of the slopes.
    Embedded(Row),
    /// Two estimates of orders 5 and 3, combined as |h|·e₅²/√(e₅² + 0.01·e₃²) (Hairer, Nørsett, Wanner 1993, II.10).
    FiveThree {
        /// Weights of e₅.
        five: Row,
        /// Weights of e₃.
        three: Row,
    },
}

/// The coefficients of an explicit Runge–Kutta method.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tableau {
    /// Abscissas of all slopes, stages first, then the end of the step (1), then extra ones.
    pub c: &'static [f64],
    /// Rows of A for the stages 0 … s−1; row 0 is empty.
    pub a: &'static [Row],
    /// Weights of the solution.
    pub b: Row,
    /// Error estimate.
    pub error: ErrorEstimate,
    /// The error behaves as h^q.
    pub q: f64,
    /// Rows of the extra slopes, which may use F_s.
    pub extra: &'static [Row],
    /// Weights of the dense coefficients beyond the Hermite data, for slopes of all kinds.
    pub dense: &'static [Row],
    /// Largest |z| on the negative real axis inside the stability region; the last stage has abscissa 1.
    pub stability_bound: f64,
}

/// An explicit Runge–Kutta method: its card and its coefficients.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ExplicitRungeKutta {
    /// The public face.
    pub card: MethodCard,
    /// The coefficients.
    pub tableau: Tableau,
}

impl Method for ExplicitRungeKutta {
    fn card(&self) -> &MethodCard {
        &self.card
    }

    fn stepper(&self, n: usize, settings: &StepperSettings) -> Box<dyn Stepper> {
        Box::new(Runner::new(self.tableau, n, settings))
    }
}

/// Working storage of one run.
struct Runner {
    tableau: Tableau,
    n: usize,
    fixed: bool,
    compensated: bool,
    detect_stiffness: bool,
    scale: Scale,
    controller: Controller,
    /// All slopes, one after the other.
    slopes: Vec<f64>,
    /// Argument of the stage being evaluated.
    argument: Vec<f64>,
    /// Argument of the last stage, for the stiffness estimate.
    last_argument: Vec<f64>,
    increment: Vec<f64>,
    work: Vec<f64>,
    /// Signed length of the step last attempted.
    h: f64,
    evaluations: u64,
}

impl Runner {
    fn new(tableau: Tableau, n: usize, settings: &StepperSettings) -> Runner {
        Runner {
            tableau,
            n,
            fixed: settings.fixed,
            compensated: settings.compensated,
            detect_stiffness: settings.stiffness,
            scale: Scale::new(&settings.error, n),
            controller: Controller::new(tableau.q),
            slopes: vec![0.0; n * tableau.c.len()],
            argument: vec![0.0; n],
            last_argument: vec![0.0; n],
            increment: vec![0.0; n],
            work: vec![0.0; n],
            h: 0.0,
            evaluations: 0,
        }
    }

    fn stages(&self) -> usize {
        self.tableau.a.len()
    }

    fn slope(&self, i: usize) -> &[f64] {
        &self.slopes[i * self.n..(i + 1) * self.n]
    }

    /// Evaluates slope `i` at the end of `to`.
    fn evaluate_end(
        &mut self,
        system: &mut dyn System,
        to: &State,
    ) -> Result<(), EvaluationFailure> {
        let s = self.stages();
        self.evaluations += 1;
        system.derivative(
            to.t.high,
            &to.y,
            &mut self.slopes[s * self.n..(s + 1) * self.n],
        )
    }

    /// Evaluates slope `i` at abscissa c_i and argument y + h Σ_j row_j F_j.
    fn evaluate(
        &mut self,
        system: &mut dyn System,
        (from, h): (&State, f64),
        (i, row): (usize, Row),
    ) -> Result<(), EvaluationFailure> {
        weighted_sum(h, row, &self.slopes, &mut self.argument);
        for (a, y) in self.argument.iter_mut().zip(&from.y) {
            *a += y;
        }
        self.evaluations += 1;
        let t = from.t.plus(self.tableau.c[i] * h).high;
        let n = self.n;
        system.derivative(t, &self.argument, &mut self.slopes[i * n..(i + 1) * n])
    }

    /// Estimated error in units of the tolerance, and the component with the largest one.
    fn error(&mut self, h: f64, from: &State, to: &State) -> (f64, usize) {
        match self.tableau.error {
            ErrorEstimate::None => (0.0, 0),
            ErrorEstimate::Embedded(row) => {
                weighted_sum(h, row, &self.slopes, &mut self.work);
                let (square, worst) = self.mean_square(from, to);
                (square.sqrt(), worst)
            }
            ErrorEstimate::FiveThree { five, three } => {
                weighted_sum(h, three, &self.slopes, &mut self.work);
                let (e3, _) = self.mean_square(from, to);
                weighted_sum(h, five, &self.slopes, &mut self.work);
                let (e5, worst) = self.mean_square(from, to);
                let denominator = e5 + 0.01 * e3;
                let error = if denominator == 0.0 {
                    0.0
                } else {
                    e5 / denominator.sqrt()
                };
                (error, worst)
            }
        }
    }

    /// Mean of the squares of `work` over the tolerances, and the index of the largest.
    fn mean_square(&self, from: &State, to: &State) -> (f64, usize) {
        let (mut sum, mut worst, mut largest) = (0.0, 0, -1.0);
        for i in 0..self.n {
            let scale = self.scale.of(i, from.y[i].abs().max(to.y[i].abs()));
            let square = (self.work[i] / scale).powi(2);
            sum += square;
            if square > largest {
                (worst, largest) = (i, square);
            }
        }
        (sum / self.n.max(1) as f64, worst)
    }

    /// |F_s − F_(s−1)| h/|y_new − argument of stage s−1| over the stability bound: both slopes are taken at the end
    /// of the step (Hairer & Wanner 1996, IV.2).
    fn stiffness(&self, h: f64, to: &State) -> Option<f64> {
        let s = self.stages();
        let (mut slopes, mut arguments) = (0.0, 0.0);
        for i in 0..self.n {
            slopes += (self.slope(s)[i] - self.slope(s - 1)[i]).powi(2);
            arguments += (to.y[i] - self.last_argument[i]).powi(2);
        }
        (arguments > 0.0)
            .then(|| h.abs() * (slopes / arguments).sqrt() / self.tableau.stability_bound)
    }

    /// Whether the estimate uses F_s, which then has to be evaluated before the step is judged.
    fn error_uses_end(&self) -> bool {
        let s = self.stages();
        match self.tableau.error {
            ErrorEstimate::Embedded(row) => row.iter().any(|(i, _)| *i == s),
            _ => false,
        }
    }
}

/// Writes h Σ_j row_j F_j into `sum`, four components at a time so that their sums stay in registers. Every
/// component is summed in the order of the row, whatever its place.
fn weighted_sum(h: f64, row: Row, slopes: &[f64], sum: &mut [f64]) {
    let n = sum.len();
    let mut blocks = sum.chunks_exact_mut(4);
    let mut base = 0;
    for block in &mut blocks {
        let mut total = [0.0; 4];
        for (j, weight) in row {
            let start = j * n + base;
            for (t, f) in total.iter_mut().zip(&slopes[start..start + 4]) {
                *t += weight * f;
            }
        }
        for (s, t) in block.iter_mut().zip(total) {
            *s = h * t;
        }
        base += 4;
    }
    for s in blocks.into_remainder() {
        let mut total = 0.0;
        for (j, weight) in row {
            total += weight * slopes[j * n + base];
        }
        *s = h * total;
        base += 1;
    }
}

fn first_not_finite(values: &[f64]) -> Option<usize> {
    values.iter().position(|v| !v.is_finite())
}

fn check_finite(values: &[f64]) -> Result<(), EvaluationFailure> {
    match first_not_finite(values) {
        None => Ok(()),
        Some(component) => Err(EvaluationFailure::NotFinite { component }),
    }
}

impl Stepper for Runner {
    fn start(
        &mut self,
        system: &mut dyn System,
        from: &State,
        direction: f64,
        span: f64,
    ) -> Result<f64, EvaluationFailure> {
        self.restart(system, from)?;
        if self.fixed {
            return Ok(0.0);
        }
        self.evaluations += 1;
        Ok(initial_step(
            system,
            &self.scale,
            (from.t, &from.y, &self.slopes[..self.n]),
            (self.tableau.q, direction, span),
            (&mut self.argument, &mut self.work),
        ))
    }

    fn restart(&mut self, system: &mut dyn System, from: &State) -> Result<(), EvaluationFailure> {
        self.evaluations += 1;
        system.derivative(from.t.high, &from.y, &mut self.slopes[..self.n])?;
        check_finite(&self.slopes[..self.n])
    }

    fn attempt(
        &mut self,
        system: &mut dyn System,
        from: &State,
        h: f64,
        to: &mut State,
    ) -> Result<Attempt, EvaluationFailure> {
        let s = self.stages();
        self.h = h;
        for i in 1..s {
            self.evaluate(system, (from, h), (i, self.tableau.a[i]))?;
        }
        if self.detect_stiffness {
            self.last_argument.copy_from_slice(&self.argument);
        }
        weighted_sum(h, self.tableau.b, &self.slopes, &mut self.increment);
        to.advance(self.compensated, from, h, &self.increment);
        check_finite(&to.y)?;
        let end_first = self.error_uses_end();
        if end_first {
            self.evaluate_end(system, to)?;
        }
        let (error, worst) = self.error(h, from, to);
        if error.is_nan() {
            return Err(EvaluationFailure::NotFinite { component: worst });
        }
        let accepted = self.fixed || error <= 1.0;
        let mut stiffness = None;
        if accepted {
            if !end_first {
                self.evaluate_end(system, to)?;
            }
            check_finite(self.slope(s))?;
            if self.detect_stiffness {
                stiffness = self.stiffness(h, to);
            }
        }
        let factor = match (self.fixed, accepted) {
            (true, _) => 1.0,
            (false, true) => self.controller.accepted(error),
            (false, false) => self.controller.rejected(error),
        };
        Ok(Attempt {
            accepted,
            h,
            next: h * factor,
            error,
            worst,
            stiffness,
        })
    }

    fn failed(&mut self) {
        self.controller.failed();
    }

    fn dense(
        &mut self,
        system: &mut dyn System,
        from: &State,
        to: &State,
        dense: &mut DenseStep,
    ) -> Result<(), EvaluationFailure> {
        let (n, s, h) = (self.n, self.stages(), self.h);
        for (k, row) in self.tableau.extra.iter().enumerate() {
            self.evaluate(system, (from, h), (s + 1 + k, row))?;
            check_finite(self.slope(s + 1 + k))?;
        }
        dense.start = from.t;
        dense.h = h;
        dense.basis = Basis::Alternating;
        let coefficients = &mut dense.coefficients;
        coefficients.resize((4 + self.tableau.dense.len()) * n, 0.0);
        for i in 0..n {
            let difference = (to.y[i] - from.y[i]) + (to.carry[i] - from.carry[i]);
            let bend = h * self.slopes[i] - difference;
            coefficients[i] = from.y[i];
            coefficients[n + i] = difference;
            coefficients[2 * n + i] = bend;
            coefficients[3 * n + i] = difference - h * self.slopes[s * n + i] - bend;
        }
        for (k, row) in self.tableau.dense.iter().enumerate() {
            let target = &mut coefficients[(4 + k) * n..(5 + k) * n];
            weighted_sum(h, row, &self.slopes, target);
        }
        Ok(())
    }

    fn commit(&mut self) {
        let (n, s) = (self.n, self.stages());
        self.slopes.copy_within(s * n..(s + 1) * n, 0);
    }

    fn evaluations(&self) -> u64 {
        self.evaluations
    }
}
