//! What a run asks of Routh's equations beside their rates: what vanishes, where the rank falls, where the motion sticks, events.

use super::{MultiplierFlow, StateKind};
use crate::along::FunctionAlong;
use crate::crossing::{State, Track};
use crate::run::WatchedFlow;
use crate::sticking::Sticking;
use chetaev_integrate::Piece;
use chetaev_symbolic::Expr;

impl WatchedFlow for MultiplierFlow {
    // The state that is interpolated at the minimum counts too: a step to the singularity itself evaluates the equations
    // where they have no value.
    fn vanishes(&mut self, index: usize, t: f64, y: &[f64]) -> bool {
        if self.zero_between || self.unpack(t, y).is_err() {
            return true;
        }
        self.watch.vanishes(index, t, &self.q, &self.v)
    }

    fn lost_mass(&mut self, at: (f64, Option<f64>), y: &[f64]) -> Option<(usize, f64)> {
        if self.evaluate(at.0, y).is_err() {
            self.accelerations.fill_unknown(self.system.n);
        }
        let (q, v) = (&self.q, &self.v);
        self.watch.lost_mass(at, q, v, &self.accelerations.a)
    }

    fn settled(&self) -> f64 {
        self.anchor.t
    }

    fn track(&mut self) -> Option<&mut Track> {
        self.track.as_deref_mut()
    }

    fn seems_to_fall(&mut self) -> Option<f64> {
        self.falls.take()
    }

    fn forget_step(&mut self) {
        let (deviations, drift) = std::mem::take(&mut self.before);
        if let Some(follow) = self.follow.as_mut().filter(|_| !deviations.is_empty()) {
            follow.deviations = deviations;
        }
        if let Some(drift) = drift {
            self.drift = drift;
        }
    }

    fn enter(&mut self, state: &State) -> Option<Vec<f64>> {
        self.q.copy_from_slice(&state.q);
        self.v.copy_from_slice(&state.v);
        self.solved = None;
        self.system.evaluate(state.t, &self.q, &self.v).ok()?;
        let next = self.choose();
        if next.rank() == self.chart.rank() {
            self.accepted_pivot = next.pivot;
            self.chart = next;
        }
        if let Some(follow) = &mut self.follow {
            follow.record(state.t, &self.q, &self.v);
        }
        self.watch.record(state.t, &self.q, &self.v);
        self.settle(state.t);
        if let Some(track) = &mut self.track {
            track.leave();
        }
        self.rank_falls(state.t);
        Some(self.pack(&state.q, &state.v))
    }

    fn row_of(&mut self, state: &State, a: &[f64], lambda: &[f64]) -> Option<Vec<f64>> {
        let layout = self.layout();
        let mut row = vec![0.0; layout.len()];
        layout.write(&mut row, &state.q, &state.v, a, lambda);
        Some(row)
    }

    fn sticking(&mut self) -> Option<&mut Sticking> {
        self.watch.sticking.as_mut()
    }

    fn event_series(
        &mut self,
        (event, value): (usize, Expr),
        piece: Piece<'_>,
        series: &mut [f64],
    ) -> bool {
        // Integrals that are kept move the rows between steps, and what jumps has no series across the jump.
        if self.kind != StateKind::Full || self.system.jumps || self.keep.is_some() {
            return false;
        }
        if self.events.len() <= event {
            self.events.resize(event + 1, None);
        }
        let rows = &self.chart.rows;
        let known = &mut self.events[event];
        if known.as_ref().is_none_or(|(own, _)| own != rows) {
            let order = series.len() - 1;
            let made = FunctionAlong::new(&self.system, rows, value, order);
            *known = Some((rows.clone(), made.ok()));
        }
        match known {
            Some((_, Some(function))) => function.expand(piece, series),
            _ => false,
        }
    }
}
