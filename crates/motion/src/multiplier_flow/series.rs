//! Routh's equations by their Taylor series: in all velocities or in independent ones, alone or beside other runs.

use super::{MultiplierFlow, StateKind};
use crate::numeric::States;
use crate::series::RateSeries;
use chetaev_integrate::{EvaluationFailure, Expansion};

impl MultiplierFlow {
    /// The states at which rates are asked for: where nothing brings them back to the constraints they stray.
    fn states(&self) -> States {
        if self.kind == StateKind::Full && self.system.r > 0 {
            self.projection.states()
        } else {
            States::Admissible
        }
    }

    /// The recurrences of (q, v) with the constraint rows of the present chart.
    pub(super) fn series(&mut self) -> Result<&mut RateSeries, EvaluationFailure> {
        let (rows, states) = (&self.chart.rows, self.states());
        // What is there stays where it is: it is large, and asked for several times in a step.
        let is_known = |(known, of): &(Vec<usize>, States)| known == rows && *of == states;
        if self.series.as_ref().is_none_or(|(key, _)| !is_known(key)) {
            let series = self.system.series(rows, states);
            let series = series.map_err(|_| EvaluationFailure::NoSeries)?;
            self.series = Some(((rows.clone(), states), series));
        }
        let made = self.series.as_mut().map(|(_, series)| series);
        made.ok_or(EvaluationFailure::NoSeries)
    }

    /// Makes the accelerations without multipliers, so that copies of this flow share them.
    pub(crate) fn share_accelerations(&mut self) {
        if self.direct.is_none() {
            let rows: Vec<usize> = (0..self.system.r).collect();
            let found = self.system.accelerations(&rows);
            self.direct = Some((rows, found));
        }
    }

    /// The rates of (q, v) by accelerations without multipliers; false where there are none, or have no value here: the
    /// multiplier form then says why.
    pub(super) fn direct_rates(&mut self, t: f64, y: &[f64], dy: &mut [f64]) -> bool {
        if self.kind != StateKind::Full || self.system.jumps || self.states() == States::All {
            return false;
        }
        let rows = &self.chart.rows;
        if self.direct.as_ref().is_none_or(|(known, _)| known != rows) {
            self.direct = Some((rows.clone(), self.system.accelerations(rows)));
        }
        let Some((_, Some(direct))) = &mut self.direct else {
            return false;
        };
        let (q, v) = y.split_at(self.system.positions());
        if direct.evaluate(t, &[q, v]).is_err() {
            return false;
        }
        let (positions, rest) = dy.split_at_mut(q.len());
        positions.copy_from_slice(v);
        rest.copy_from_slice(direct.group(0));
        true
    }

    /// Makes the series of the chart that most motions have, so that copies of this flow share them.
    pub(crate) fn share_series(&mut self, states: States) {
        if self.series.is_none() {
            let rows: Vec<usize> = (0..self.system.r).collect();
            let made = self.system.series(&rows, states).ok();
            self.series = made.map(|series| ((rows, states), series));
        }
    }

    /// Says which series will be asked for next; these are given, as far as they are known.
    pub(crate) fn announce(&mut self, asked: Option<Expansion<'_>>) -> Option<&mut RateSeries> {
        if self.kind == StateKind::Full && !self.system.jumps {
            if let Some(asked) = asked {
                let mut reduced = std::mem::take(&mut self.reduced);
                let turns = &self.system.turns;
                turns.reduce(asked.y, asked.carry, &mut reduced);
                let series = self.series().ok()?;
                series.announce(asked.t, &reduced, (asked.order, asked.is_whole));
                self.reduced = reduced;
            }
        }
        self.announced()
    }

    /// The series that were announced.
    pub(crate) fn announced(&mut self) -> Option<&mut RateSeries> {
        self.series.as_mut().map(|(_, series)| series)
    }

    /// The coefficients of (q, v) at the state last evaluated, whatever the chart.
    pub(super) fn expand_full(&mut self, t: f64, order: usize) -> Result<(), EvaluationFailure> {
        let state = [&self.q[..], &self.v].concat();
        let mut full = std::mem::take(&mut self.full);
        full.resize((order + 1) * state.len(), 0.0);
        let outcome = self
            .series()
            .map(|series| series.expand(t, &state, order, &mut full));
        self.full = full;
        outcome?
    }
}
