//! The bound on the probability of error of one trial.

use super::super::coupling::Coupled;
use super::super::program::{Operation, Program};
use super::super::size::{Sizes, Weight, SLACK};
use super::Plan;
use crate::number::prime::LOG2_PRIME_COUNT;

/// Beyond this log2 of the degree no bound is attempted (T6 §6.3).
const LARGEST_LOG2_DEGREE: f64 = 40.0;
/// A trial that errs with a larger probability than 2^this is useless.
const WORST_TRIAL: f64 = -4.0;
/// log2 of 4 times the largest dimension of a tower: norms over it, its leading coefficients and discriminants.
const LOG2_TOWER: f64 = 8.0;

/// What the bound is made of.
pub(super) struct Bound<'s> {
    pub(super) program: &'s Program,
    pub(super) plan: &'s Plan,
    pub(super) sizes: &'s Sizes,
    pub(super) suspects: usize,
    pub(super) norm: Norm,
}

/// What norms over the solutions of the constraints cost.
#[derive(Clone, Copy, Debug, Default)]
pub(in crate::zero) struct Norm {
    /// log2 of the factor of degrees and heights.
    pub(in crate::zero) log2: f64,
    /// What is added to heights before.
    pub(in crate::zero) height: f64,
}

impl Norm {
    /// Of constraints solved one after the other: the tower is no larger than it may be. Of constraints solved jointly: by É. Bézout's
    /// theorem the hypersurface of the data over which an output of degree d vanishes at a solution has at most the degree d Π d_i, d_i
    /// the degrees of the equations, and by its arithmetic form at most the height Π d_i (h + d Σ h_i + d m log2(m + 1)) for m equations
    /// (T. Krick, L. M. Pardo and M. Sombra, Duke Math. J. 109, 2001); discriminants and denominators add as much as in a tower.
    pub(in crate::zero) fn of(program: &Program, coupled: Option<&Coupled>) -> Norm {
        if program.constraints.is_empty() {
            return Norm::default();
        }
        let Some(coupled) = coupled else {
            return Norm {
                log2: LOG2_TOWER,
                height: 0.0,
            };
        };
        let sizes = Sizes::of(program, &weights(program, Some(coupled)), None);
        let adjoined = program.adjoined.iter().filter(|&&own| own).count();
        let quadratic = (coupled.circles() + adjoined) as f64;
        let (mut log2, mut height) = (LOG2_TOWER + quadratic, 2.0 * quadratic);
        for &constraint in &program.constraints {
            let (size, divisor) = (sizes.get(constraint), sizes.denominator(constraint));
            log2 += (size.degree + divisor.degree).max(1.0).log2();
            height += size.height + divisor.height;
        }
        let count = program.constraints.len() as f64 + quadratic;
        Norm {
            log2,
            height: height + count * (count + 1.0).log2(),
        }
    }
}

impl Bound<'_> {
    /// Degree and height of any minor of the outputs, with everything divided by: rows are cleared of denominators, and a
    /// minor is a sum of products of one entry of each row.
    pub(super) fn worst(&self) -> (f64, f64) {
        let rows = self.program.outputs.chunks(self.plan.columns.max(1));
        let widen = if self.plan.rows > 1 {
            (self.plan.columns.max(1) as f64).log2()
        } else {
            0.0
        };
        let (degree, height) = rows.fold((0.0, 0.0), |(degree, height), row| {
            let worst = row.iter().fold((0.0_f64, 0.0_f64), |(d, h), &output| {
                let (size, denominator) = (self.sizes.get(output), self.sizes.denominator(output));
                // Other entries of the row bring their denominators along.
                let count = if self.plan.rows > 1 {
                    row.len() as f64
                } else {
                    1.0
                };
                (
                    d.max(size.degree + count * denominator.degree),
                    h.max(size.height + count * denominator.height),
                )
            });
            (degree + worst.0, height + worst.1 + widen)
        });
        (degree.max(1.0), height.max(1.0))
    }

    /// log2 of M.
    fn multiplicity(&self) -> f64 {
        let squares = f64::from(self.program.chosen_radicals()) - self.suspects as f64;
        let odd = |operation: &Operation| match operation {
            Operation::OddRoot { degree, .. } => (*degree as f64).log2(),
            _ => 0.0,
        };
        let odd: f64 = self.program.operations.iter().map(odd).sum();
        squares + odd + (self.program.order_of_unity as f64).log2() + self.norm.log2
    }

    /// log2 of the number of primes the choice is made from, rounded down.
    fn log2_primes(&self) -> f64 {
        // φ(N) ≤ N classes; in each of them more than half of the expected number (M. A. Bennett, G. Martin, K. O'Bryant
        // and A. Rechnitzer, Illinois J. Math. 62, 2018); each odd root excludes at most half.
        let classes = match self.program.order_of_unity {
            0..=2 => 0.0,
            order => (order as f64).log2() + 1.0,
        };
        LOG2_PRIME_COUNT - classes - 2.0 * self.program.odd_roots.len() as f64
    }

    /// T, the largest number of points drawn for one trial.
    pub(super) fn draws(&self) -> u32 {
        let radicals = self.program.chosen_radicals();
        16 << (radicals + u32::from(radicals > 0))
    }

    /// log2 of the probability that one trial errs, or why that is not useful.
    pub(super) fn for_one_trial(&self) -> Result<f64, String> {
        let (degree, height) = self.worst();
        let height = height + degree * self.norm.height;
        let m = self.multiplicity().exp2() * SLACK;
        let prime = m * height / 61.0 / self.log2_primes().exp2();
        let point = 2.0 * m * degree / 60.9_f64.exp2();
        let bound = f64::from(self.draws()).log2() + (prime + point).log2();
        if bound.is_nan() || bound > WORST_TRIAL || degree.log2() > LARGEST_LOG2_DEGREE {
            return Err(format!(
                "no useful bound on the probability of error: log2 of the degree {:.0}, of the height {:.0}",
                degree.log2(),
                height.log2()
            ));
        }
        Ok(bound)
    }
}

/// Degrees and heights of the constraints, each as coefficients of the equation of its symbol.
pub(in crate::zero) fn weights(program: &Program, coupled: Option<&Coupled>) -> Vec<Weight> {
    let mut weights = vec![
        Weight {
            degree: 1.0,
            height: 0.0
        };
        program.constraints.len()
    ];
    // What is solved for jointly is a variable like others (see `Norm`).
    if coupled.is_some() {
        return weights;
    }
    // Roots over the symbol: the equation is the norm of the constraint.
    let adjoined = program
        .adjoined
        .iter()
        .filter(|&&adjoined| adjoined)
        .count()
        .min(3);
    let norm = f64::from(1_u32 << adjoined);
    for (k, &constraint) in program.constraints.iter().enumerate() {
        let sizes = Sizes::of(program, &weights, None);
        let (size, denominator) = (sizes.get(constraint), sizes.denominator(constraint));
        weights[k] = Weight {
            degree: norm * (size.degree + denominator.degree),
            height: norm * (size.height + denominator.height + 1.0),
        };
    }
    weights
}
