//! Functions at states beside the rows of the run, and derivatives along variations by differences of these.

use super::samples::rows;
use chetaev_mechanics::Context;
use chetaev_motion::observe::Observer;
use chetaev_motion::row::RowLayout;
use chetaev_symbolic::Expr;

/// Varied states are so far away at first, in units of the variation.
const FARTHEST: f64 = 1e-3;
/// Each next pair of states is nearer by this factor.
const NEARER: f64 = 4.0;
/// So many pairs are taken: near the speed of light, or near a collision, only the last stand within what is smooth.
const PAIRS: usize = 5;
/// So far apart are states of which rounding leaves enough for a derivative of the size of its terms.
pub(super) const APART: f64 = 2e-4;

/// Compiled functions of (q, v, t).
#[derive(Clone)]
pub(super) struct States {
    observer: Observer,
    layout: RowLayout,
    times: Vec<f64>,
    rows: Vec<Vec<f64>>,
}

/// A variation of a state: Δq, Δv, Δt and what masses with a law of their own change by.
#[derive(Clone, Debug, Default)]
pub(super) struct Change {
    pub(super) coordinates: Vec<f64>,
    pub(super) velocities: Vec<f64>,
    pub(super) masses: Vec<f64>,
    pub(super) time: f64,
}

impl States {
    /// Compiles functions of (q, v, t).
    ///
    /// # Errors
    /// That there are no equally spaced rows, or that something is no function of the state.
    pub(super) fn new(cx: &Context<'_>, functions: &[Expr]) -> Result<States, String> {
        let (evidence, count) = rows(cx)?;
        let run = evidence.rows();
        let observer = Observer::new(cx.system, cx.terms, &evidence.binding, functions)
            .map_err(|problem| problem.to_string())?;
        let rows: Vec<Vec<f64>> = (0..count).map(|j| run.row(j).to_vec()).collect();
        Ok(States {
            observer,
            layout: run.layout,
            times: run.times[..count].to_vec(),
            rows,
        })
    }

    /// Values at a row moved by so many times a variation.
    pub(super) fn at(&mut self, row: usize, times: f64, change: &Change) -> Vec<f64> {
        let mut state = self.rows[row].clone();
        let parts = [
            (self.layout.q(), &change.coordinates),
            (self.layout.masses(), &change.masses),
            (self.layout.v(), &change.velocities),
        ];
        for (range, part) in parts {
            for (x, by) in state[range].iter_mut().zip(part) {
                *x += times * by;
            }
        }
        self.observer
            .at(self.times[row] + times * change.time, &state)
    }

    /// d/dε at ε = 0 of a function of ε: central differences of shrinking steps, extrapolated, of which the entry is taken that
    /// differs least from its neighbours (Ridders 1982, Advances in Engineering Software 4, 75–76). Nothing where the function has
    /// no values for the smallest steps.
    pub(super) fn derivative(
        &mut self,
        mut of: impl FnMut(&mut States, f64) -> Option<f64>,
    ) -> Option<f64> {
        let mut best: Option<(f64, f64)> = None;
        let mut last: Vec<f64> = Vec::new();
        let mut step = FARTHEST;
        for _ in 0..PAIRS {
            let pair = of(self, step).zip(of(self, -step));
            last = match pair {
                Some((ahead, behind)) => {
                    extrapolated((ahead - behind) / (2.0 * step), &last, &mut best)
                }
                None => Vec::new(),
            };
            step /= NEARER;
        }
        best.map(|(value, _)| value)
    }
}

/// The next row of Neville's scheme over central differences; the value with the smallest error so far is kept.
fn extrapolated(central: f64, last: &[f64], best: &mut Option<(f64, f64)>) -> Vec<f64> {
    let mut row = vec![central];
    let mut weight = 1.0;
    for (j, &coarser) in last.iter().enumerate() {
        weight *= NEARER * NEARER;
        let value = row[j] + (row[j] - coarser) / (weight - 1.0);
        let error = (value - row[j]).abs().max((value - coarser).abs());
        if best.is_none_or(|(_, least)| error < least) {
            *best = Some((value, error));
        }
        row.push(value);
    }
    row
}
