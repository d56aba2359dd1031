//! The first variation of the action among neighbours that satisfy the constraints, along the computed motion.
//!
//! Admissible to first order are η with `f_q η + fᵥ η' = 0`, here `η' = ξ − fᵥᵀ G⁻¹ (fᵥ ξ + f_q η)` with any ξ(t): a linear
//! differential equation, integrated by the rule of Runge and Kutta over two rows. Of several that start with η = 0 combinations
//! also end so. Where the motion makes the action stationary `∫(L_q η + p η') dt` vanishes for all of them.

use super::algebra::{gram, null_space, solved, times, transposed_times};
use super::first::SEED;
use super::samples::{Samples, LEAST};
use super::wave::Wave;
use chetaev_mechanics::claims::formulation::basis;
use chetaev_mechanics::sample::Generator;
use chetaev_mechanics::Context;
use chetaev_symbolic::Expr;

/// What was found.
#[derive(Clone, Debug)]
pub struct Neighbours {
    /// The largest `|∫(L_q η + p η') dt|/∫ Σ|terms| dt`.
    pub change: f64,
    /// The largest change of such a number when the steps are doubled.
    pub error: f64,
    /// How many independent admissible variations were combined.
    pub variations: u32,
    /// The interval.
    pub interval: (f64, f64),
}

/// The result, computed once.
pub(super) struct Found(pub(super) Result<Neighbours, String>);

/// Combinations that vanish at both ends, beyond those that the ends take.
const BEYOND: usize = 3;
/// End values below this part of the largest are dependent.
const DEPENDENT: f64 = 1e-7;
/// More coordinates are too many for these integrations.
pub(super) const COORDINATES: usize = 12;

/// The neighbours of the computed motion.
pub(super) fn of(cx: &Context<'_>) -> Result<Neighbours, String> {
    cx.shared(|cx| Found(compute(cx))).0.clone()
}

/// L_q, p, f_v and f_q by row.
struct Along {
    samples: Samples,
    n: usize,
    r: usize,
}

fn compute(cx: &Context<'_>) -> Result<Neighbours, String> {
    let (system, g, n) = (cx.system, &cx.system.graph, cx.system.n());
    let slopes = g.gradient(system.lagrangian, &system.coordinate_symbols());
    let momenta = g.gradient(system.lagrangian, &system.velocity_symbols());
    let basis = basis(cx);
    let jacobian = basis.jacobian().concat();
    let by_coordinates: Vec<Expr> = g
        .jacobian(&basis.constraints(), &system.coordinate_symbols())
        .concat();
    let samples = Samples::new(cx, &[&slopes, &momenta, &jacobian, &by_coordinates])?;
    let r = cx.selection.rows.len();
    let along = Along { samples, n, r };
    let count = along.samples.intervals(8);
    if count < LEAST {
        return Err("there are too few output times".into());
    }
    let mut generator = Generator::new(SEED);
    let controls: Vec<Vec<Wave>> = (0..n + BEYOND)
        .map(|_| (0..n).map(|_| Wave::free(&mut generator)).collect())
        .collect();
    let of = |stride| -> Result<Vec<Variation>, String> {
        controls
            .iter()
            .map(|xi| along.variation(xi, count, stride))
            .collect()
    };
    let (fine, coarse) = (of(1)?, of(2)?);
    let ends = |found: &[Variation]| -> Vec<f64> {
        let row = |i: usize| found.iter().map(move |v| v.end[i]);
        (0..n).flat_map(row).collect()
    };
    let combinations = null_space(&ends(&fine), n, controls.len(), DEPENDENT);
    let others = null_space(&ends(&coarse), n, controls.len(), DEPENDENT);
    if combinations.len() != others.len() || combinations.is_empty() {
        return Err("the end values of the variations are too nearly dependent".into());
    }
    let relative = |found: &[Variation], weights: &[f64]| -> f64 {
        let sum = |part: fn(&Variation) -> f64| -> f64 {
            found.iter().zip(weights).map(|(v, w)| part(v) * w).sum()
        };
        let scale = found.iter().zip(weights);
        let scale: f64 = scale.map(|(v, w)| (v.size * w).abs()).sum();
        if scale == 0.0 {
            0.0
        } else {
            sum(|v| v.action) / scale
        }
    };
    let values = combinations.iter().zip(&others);
    let values: Vec<(f64, f64)> = values
        .map(|(a, b)| (relative(&fine, a), relative(&coarse, b)))
        .collect();
    let largest = |part: fn(&(f64, f64)) -> f64| values.iter().map(part).fold(0.0, f64::max);
    let times = &along.samples.times;
    Ok(Neighbours {
        change: largest(|v| v.0.abs()),
        error: largest(|v| (v.0 - v.1).abs()),
        variations: combinations.len() as u32,
        interval: (times[0], times[count]),
    })
}

/// A variation that starts with η = 0.
struct Variation {
    end: Vec<f64>,
    /// `∫(L_q η + p η') dt`.
    action: f64,
    /// `∫ Σ|terms| dt`.
    size: f64,
}

impl Along {
    /// η' at a row.
    fn rate(&self, row: usize, xi: &[f64], eta: &[f64]) -> Option<Vec<f64>> {
        let (n, r) = (self.n, self.r);
        if r == 0 {
            return Some(xi.to_vec());
        }
        let jacobian = self.samples.at(2, row);
        let right: Vec<f64> = times(jacobian, n, xi)
            .into_iter()
            .zip(times(self.samples.at(3, row), n, eta))
            .map(|(a, b)| a + b)
            .collect();
        let z = solved(r, &gram(jacobian, r, n), &right)?;
        let back = transposed_times(jacobian, n, &z);
        Some(xi.iter().zip(back).map(|(a, b)| a - b).collect())
    }

    /// Steps over 2·stride rows, and Simpson's rule on their ends with step 2·stride rows.
    fn variation(&self, xi: &[Wave], count: usize, stride: usize) -> Result<Variation, String> {
        let times = &self.samples.times;
        let length = times[count] - times[0];
        let control = |row: usize| -> Vec<f64> {
            let share = row as f64 / count as f64;
            xi.iter().map(|w| w.at(share, length).0).collect()
        };
        let failed = || "the gradients of the constraints are dependent at a row".to_string();
        let rate = |row: usize, eta: &[f64]| self.rate(row, &control(row), eta).ok_or_else(failed);
        let mut eta = vec![0.0; self.n];
        let (mut action, mut size) = (0.0, 0.0);
        let intervals = count / (2 * stride);
        for step in 0..=intervals {
            let row = 2 * stride * step;
            let slope = rate(row, &eta)?;
            let terms = self.samples.at(0, row).iter().zip(&eta);
            let terms = terms.chain(self.samples.at(1, row).iter().zip(&slope));
            let (value, absolute) = terms.fold((0.0, 0.0), |(value, absolute), (a, b)| {
                (value + a * b, absolute + (a * b).abs())
            });
            let weight = match step {
                0 => 1.0,
                _ if step == intervals => 1.0,
                _ if step % 2 == 1 => 4.0,
                _ => 2.0,
            };
            let weight = weight * length / (3.0 * intervals as f64);
            action += weight * value;
            size += weight.abs() * absolute;
            if step < intervals {
                let h = 2.0 * stride as f64 * length / count as f64;
                let (middle, next) = (row + stride, row + 2 * stride);
                let moved = |k: &[f64], by: f64| -> Vec<f64> {
                    eta.iter().zip(k).map(|(x, y)| x + by * y).collect()
                };
                let k2 = rate(middle, &moved(&slope, h / 2.0))?;
                let k3 = rate(middle, &moved(&k2, h / 2.0))?;
                let k4 = rate(next, &moved(&k3, h))?;
                eta = (0..self.n)
                    .map(|i| eta[i] + h / 6.0 * (slope[i] + 2.0 * (k2[i] + k3[i]) + k4[i]))
                    .collect();
            }
        }
        let is_finite = action.is_finite() && eta.iter().all(|x| x.is_finite());
        match is_finite {
            true => Ok(Variation {
                end: eta,
                action,
                size,
            }),
            false => Err("the integrand has no value at a row".into()),
        }
    }
}
