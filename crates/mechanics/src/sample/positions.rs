//! Sample positions on the set where the finite constraints hold.

use super::{values, Generator, Point};
use crate::system::{Relation, System};
use crate::terms::MotionTerms;
use chetaev_symbolic::{Expr, Symbol};

/// The finite constraints with their gradients by the coordinates.
pub(super) struct Finite {
    symbols: Vec<Symbol>,
    /// φ, then ∂φ/∂q row by row.
    roots: Vec<Expr>,
    count: usize,
}

/// Steps at most; far from the set they are short, and near it their error is squared.
const STEPS: usize = 80;
/// From such a residual on so many steps are enough at a regular place.
const CLOSE: f64 = 1e-3;
const FAST: usize = 9;

impl Finite {
    /// Those of the terms; `None` where there are none.
    pub(super) fn of(system: &System, terms: &MotionTerms) -> Option<Finite> {
        let stated = terms
            .constraint_index
            .iter()
            .map(|&l| &system.constraints[l]);
        let finite: Vec<Expr> = stated.filter(|c| c.order == 0).map(|c| c.stated).collect();
        if finite.is_empty() {
            return None;
        }
        let symbols = system.coordinate_symbols();
        let gradient = system.graph.jacobian(&finite, &symbols).concat();
        Some(Finite {
            symbols,
            count: finite.len(),
            roots: [finite, gradient].concat(),
        })
    }

    /// Moves the coordinates of a point onto the set: steps of Levenberg and Marquardt, whose damping vanishes with the residual, so that
    /// they converge fast also where more constraints are stated than the set needs (N. Yamashita, M. Fukushima, Computing Suppl. 15 (2001)
    /// 239). False where they do not get there, or leave what the model assumes.
    pub(super) fn reach(&self, system: &System, point: &mut Point) -> bool {
        let n = self.symbols.len();
        let Some(mut now) = values(system, &self.roots, point) else {
            return false;
        };
        let size = |values: &[f64]| {
            values[..self.count]
                .iter()
                .map(|x| x * x)
                .sum::<f64>()
                .sqrt()
        };
        let (mut weight, mut close) = (1.0, 0);
        for _ in 0..STEPS {
            let own = size(&now);
            close += usize::from(own < CLOSE);
            // Where the steps only halve the error the place is singular, and known to half the digits.
            if !own.is_finite() || close > FAST {
                return false;
            }
            if own <= 4.0 * f64::EPSILON {
                break;
            }
            let (f, gradient) = now.split_at(self.count);
            let step = damped_step(gradient, f, n, weight * own);
            let mut next = point.clone();
            for (symbol, dx) in self.symbols.iter().zip(&step) {
                next.entry(*symbol).and_modify(|x| *x -= dx);
            }
            let found = values(system, &self.roots, &next).filter(|found| size(found) < own);
            match found {
                Some(found) => {
                    (*point, now) = (next, found);
                    weight = (0.3 * weight).max(1e-3);
                }
                // Rounding keeps the residual from becoming smaller.
                None if own <= 1e-13 => break,
                None if weight > 1e12 => return false,
                None => weight *= 8.0,
            }
        }
        size(&now) <= 1e-12 && is_assumed(system, point)
    }

    /// Moves the coordinates of a point by about a part `reach`, at random, and back onto the set.
    pub(super) fn neighbour(
        &self,
        system: &System,
        point: &Point,
        reach: f64,
        generator: &mut Generator,
    ) -> Option<Point> {
        let mut next = point.clone();
        for symbol in &self.symbols {
            let by = generator.between(-reach, reach);
            next.entry(*symbol)
                .and_modify(|x| *x += by * (1.0 + x.abs()));
        }
        self.reach(system, &mut next).then_some(next)
    }
}

/// `Gᵀ (G Gᵀ + μ)⁻¹ f`.
fn damped_step(gradient: &[f64], f: &[f64], n: usize, mu: f64) -> Vec<f64> {
    let r = f.len();
    let rows: Vec<&[f64]> = gradient.chunks(n.max(1)).collect();
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
    let mut l = vec![0.0; r * r];
    let mut z = f.to_vec();
    let scale = (0..r).fold(mu, |m: f64, i| m.max(dot(rows[i], rows[i])));
    for i in 0..r {
        for j in 0..=i {
            let known: f64 = (0..j).map(|k| l[i * r + k] * l[j * r + k]).sum();
            let damping = if i == j { mu } else { 0.0 };
            let rest = dot(rows[i], rows[j]) + damping - known;
            l[i * r + j] = match i == j {
                // What is left of a dependent row is rounding: it takes no part.
                true if rest <= 1e-15 * scale => f64::INFINITY,
                true => rest.sqrt(),
                false => rest / l[j * r + j],
            };
        }
    }
    for i in 0..r {
        let known: f64 = (0..i).map(|k| l[i * r + k] * z[k]).sum();
        z[i] = (z[i] - known) / l[i * r + i];
    }
    for i in (0..r).rev() {
        let known: f64 = (i + 1..r)
            .filter(|&k| l[k * r + k].is_finite())
            .map(|k| l[k * r + i] * z[k])
            .sum();
        z[i] = (z[i] - known) / l[i * r + i];
    }
    let column = |j: usize| rows.iter().zip(&z).map(|(row, z)| row[j] * z).sum();
    (0..n).map(column).collect()
}

/// Whether a point satisfies the assumptions of the model that can be evaluated there.
fn is_assumed(system: &System, point: &Point) -> bool {
    system.assumptions.iter().all(|assumption| {
        let sides = values(system, &[assumption.left, assumption.right], point);
        let Some(difference) = sides.map(|sides| sides[1] - sides[0]) else {
            return true;
        };
        match assumption.relation {
            Relation::Less => difference > 0.0,
            Relation::LessOrEqual => difference >= 0.0,
            Relation::NotEqual => difference != 0.0,
        }
    })
}
