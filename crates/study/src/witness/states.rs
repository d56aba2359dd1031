//! Functions at states beside the rows of the run, and derivatives along variations by differences of these.

use super::samples::rows;
use chetaev_mechanics::Context;
use chetaev_motion::observe::Observer;
use chetaev_motion::row::RowLayout;
use chetaev_symbolic::Expr;

/// Varied states are so far away, in units of the extent of the motion.
const APART: f64 = 2e-4;

/// Compiled functions of (q, v, t).
#[derive(Clone)]
pub(super) struct States {
    observer: Observer,
    layout: RowLayout,
    times: Vec<f64>,
    rows: Vec<Vec<f64>>,
    /// The size of a variation.
    apart: f64,
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
        let far = |i: usize| {
            let start = rows[0][i];
            rows.iter()
                .fold(0.0_f64, |m, row| m.max((row[i] - start).abs()))
        };
        let extent = run.layout.q().map(far).fold(0.0, f64::max);
        Ok(States {
            observer,
            layout: run.layout,
            times: run.times[..count].to_vec(),
            rows,
            apart: APART * if extent > 0.0 { extent.min(1.0) } else { 1.0 },
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

    /// d/dε at ε = 0 of a function of ε, by differences of the fourth order.
    pub(super) fn derivative(
        &mut self,
        mut of: impl FnMut(&mut States, f64) -> Option<f64>,
    ) -> Option<f64> {
        let e = self.apart;
        let mut pair = |e: f64| Some(of(self, e)? - of(self, -e)?);
        let (near, far) = (pair(e)?, pair(2.0 * e)?);
        Some((8.0 * near - far) / (12.0 * e))
    }
}
