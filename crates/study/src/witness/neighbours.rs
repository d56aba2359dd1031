//! The first variation of the action among neighbours that satisfy the constraints, along the computed motion.
//!
//! Admissible to first order are η with `f_q η + fᵥ η' = 0`, here `η' = ξ − fᵥᵀ G⁻¹ (fᵥ ξ + f_q η)` with any ξ(t): a linear
//! differential equation, integrated by the rule of Runge and Kutta over two rows. Of several that start with η = 0 combinations
//! also end so. Where the motion makes the action stationary `∫(L_q η + p η') dt` vanishes for all of them.

use super::algebra::{gram, null_space, solved, times, transposed_times};
use super::common::Common;
use super::refined::SEED;
use super::samples::{Samples, LEAST};
use super::wave::Wave;
use chetaev_mechanics::claims::formulation::basis;
use chetaev_mechanics::sample::Generator;
use chetaev_mechanics::Context;
use chetaev_symbolic::Expr;
use std::ops::Range;

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

/// L_q, p, f_v and f_q by row, of which some are taken.
struct Along {
    samples: Samples,
    /// The natural sizes of the coordinates.
    sizes: Vec<f64>,
    n: usize,
    r: usize,
    first: usize,
    count: usize,
}

/// Variations that start with η = 0, with two steps, and combinations of them that also end so.
pub(super) struct Admissible {
    along: Along,
    fine: Vec<Variation>,
    coarse: Vec<Variation>,
    combinations: Vec<Vec<f64>>,
    others: Vec<Vec<f64>>,
}

/// What stands under an integral at a row for η and η'.
pub(super) type Integrand<'a> = dyn FnMut(usize, &[f64], &[f64]) -> Option<f64> + 'a;

fn compute(cx: &Context<'_>) -> Result<Neighbours, String> {
    let admissible = Admissible::new(cx, None)?;
    let samples = &admissible.along.samples;
    admissible.changes(&mut |row, eta, rate| {
        let terms = samples.at(0, row).iter().zip(eta);
        let terms = terms.chain(samples.at(1, row).iter().zip(rate));
        Some(terms.map(|(a, b)| a * b).sum())
    })
}

impl Admissible {
    /// Over a range of rows, or all.
    pub(super) fn new(cx: &Context<'_>, rows: Option<Range<usize>>) -> Result<Admissible, String> {
        let along = Along::new(cx, rows)?;
        let n = along.n;
        let mut generator = Generator::new(SEED);
        let controls: Vec<Vec<Wave>> = (0..n + BEYOND)
            .map(|_| (0..n).map(|_| Wave::free(&mut generator)).collect())
            .collect();
        let of = |stride| -> Result<Vec<Variation>, String> {
            controls
                .iter()
                .map(|xi| along.variation(xi, stride))
                .collect()
        };
        let (fine, coarse) = (of(1)?, of(2)?);
        let ends = |found: &[Variation]| -> Vec<f64> {
            let size = |i: usize| along.sizes[i];
            let row = |i: usize| found.iter().map(move |v| v.end[i] / size(i));
            (0..n).flat_map(row).collect()
        };
        let combinations = null_space(&ends(&fine), n, controls.len(), DEPENDENT);
        let others = null_space(&ends(&coarse), n, controls.len(), DEPENDENT);
        if combinations.len() != others.len() || combinations.is_empty() {
            return Err("the end values of the variations are too nearly dependent".into());
        }
        Ok(Admissible {
            along,
            fine,
            coarse,
            combinations,
            others,
        })
    }

    /// The integrals of the combinations, over the sizes of the terms of what is combined.
    pub(super) fn changes(&self, integrand: &mut Integrand<'_>) -> Result<Neighbours, String> {
        let mut values = Vec::new();
        for (weights, others) in self.combinations.iter().zip(&self.others) {
            let fine = self.relative(1, (&self.fine, weights), integrand)?;
            let coarse = self.relative(2, (&self.coarse, others), integrand)?;
            values.push((fine, coarse));
        }
        let largest = |part: fn(&(f64, f64)) -> f64| values.iter().map(part).fold(0.0, f64::max);
        let (first, count) = (self.along.first, self.along.count);
        let times = &self.along.samples.times;
        Ok(Neighbours {
            change: largest(|v| v.0.abs()),
            error: largest(|v| (v.0 - v.1).abs()),
            variations: self.combinations.len() as u32,
            interval: (times[first], times[first + count]),
        })
    }

    /// Simpson's rule on the nodes of one combination. The sizes are those of the variations that are combined, one by one.
    fn relative(
        &self,
        stride: usize,
        (found, weights): (&[Variation], &[f64]),
        integrand: &mut Integrand<'_>,
    ) -> Result<f64, String> {
        let failed = || "the integrand has no value at a row".to_string();
        let nodes = found[0].path.len();
        let n = self.along.n;
        let (mut value, mut scale) = (0.0, 0.0);
        for node in 0..nodes {
            let row = self.along.first + 2 * stride * node;
            let weight = match node {
                0 => 1.0,
                _ if node == nodes - 1 => 1.0,
                _ if node % 2 == 1 => 4.0,
                _ => 2.0,
            };
            let mut sum = (vec![0.0; n], vec![0.0; n]);
            for (variation, w) in found.iter().zip(weights) {
                let (eta, rate) = &variation.path[node];
                for i in 0..n {
                    sum.0[i] += w * eta[i];
                    sum.1[i] += w * rate[i];
                }
            }
            for (variation, w) in found.iter().zip(weights) {
                let (eta, rate) = &variation.path[node];
                scale += weight * w.abs() * self.along.size(row, eta, rate);
            }
            value += weight * integrand(row, &sum.0, &sum.1).ok_or_else(failed)?;
        }
        match (value / scale).is_finite() {
            true => Ok(value / scale),
            false if scale == 0.0 => Ok(0.0),
            false => Err(failed()),
        }
    }
}

/// A variation that starts with η = 0.
struct Variation {
    end: Vec<f64>,
    /// η and η' at the nodes.
    path: Vec<(Vec<f64>, Vec<f64>)>,
}

impl Along {
    fn new(cx: &Context<'_>, rows: Option<Range<usize>>) -> Result<Along, String> {
        let (system, g) = (cx.system, &cx.system.graph);
        let slopes = g.gradient(system.lagrangian, &system.coordinate_symbols());
        let momenta = g.gradient(system.lagrangian, &system.velocity_symbols());
        let basis = basis(cx);
        let jacobian = basis.jacobian().concat();
        let by_coordinates: Vec<Expr> = g
            .jacobian(&basis.constraints(), &system.coordinate_symbols())
            .concat();
        let samples = Samples::new(cx, &[&slopes, &momenta, &jacobian, &by_coordinates])?;
        let rows = rows.unwrap_or(0..samples.times.len());
        let count = rows.len().saturating_sub(1) / 8 * 8;
        if count < LEAST {
            return Err("there are too few output times".into());
        }
        Ok(Along {
            sizes: Common::of(cx)?.sizes().to_vec(),
            samples,
            n: system.n(),
            r: cx.selection.rows.len(),
            first: rows.start,
            count,
        })
    }

    /// `Σ|L_q η| + |p η'|` at a row.
    fn size(&self, row: usize, eta: &[f64], rate: &[f64]) -> f64 {
        let terms = self.samples.at(0, row).iter().zip(eta);
        let terms = terms.chain(self.samples.at(1, row).iter().zip(rate));
        terms.map(|(a, b)| (a * b).abs()).sum()
    }

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

    /// Steps over 2·stride rows.
    fn variation(&self, xi: &[Wave], stride: usize) -> Result<Variation, String> {
        let (times, first, count) = (&self.samples.times, self.first, self.count);
        let length = times[first + count] - times[first];
        let control = |row: usize| -> Vec<f64> {
            let share = (row - first) as f64 / count as f64;
            let sizes = xi.iter().zip(&self.sizes);
            sizes
                .map(|(w, size)| w.at(share, length).0 * size / length)
                .collect()
        };
        let failed = || "the gradients of the constraints are dependent at a row".to_string();
        let rate = |row: usize, eta: &[f64]| self.rate(row, &control(row), eta).ok_or_else(failed);
        let mut eta = vec![0.0; self.n];
        let mut path = Vec::new();
        let intervals = count / (2 * stride);
        for step in 0..=intervals {
            let row = first + 2 * stride * step;
            let slope = rate(row, &eta)?;
            path.push((eta.clone(), slope.clone()));
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
        match eta.iter().all(|x| x.is_finite()) {
            true => Ok(Variation { end: eta, path }),
            false => Err("the integrand has no value at a row".into()),
        }
    }
}
