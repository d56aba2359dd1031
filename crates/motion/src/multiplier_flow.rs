//! The motion by Routh's equations: the multiplier form solved numerically at every state.
//!
//! State (q, v), where masses with a law of their own stand behind the coordinates, projected on the constraints where
//! asked; or (q, v_i) with the dependent velocities from the constraints, which are then satisfied identically (affine
//! constraints only). The former measures the error of every velocity, the latter that of the v_i alone.

mod series;
mod watched;

use crate::accelerations::Accelerations;
use crate::along::FunctionAlong;
use crate::chart::{self, Chart, Floor, DEGRADED, HYSTERESIS};
use crate::crossing::{self, Track};
use crate::drift::Drift;
use crate::follow::{Deviation, Follow};
use crate::functions::{Functions, FunctionsError};
use crate::initial::ConsistentState;
use crate::keep::Keep;
use crate::leaving::Anchor;
use crate::numeric::{Completion, NumericSystem, States};
use crate::projection::Projection;
use crate::row::RowLayout;
use crate::series::RateSeries;
use crate::sticking::{self, Place, Sides, Sticking, STUCK};
use crate::watch::Watch;
use chetaev_integrate::{ChartChange, Control, EvaluationFailure, HaltReason, System};

/// Which variables are integrated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StateKind {
    /// (q, v).
    Full,
    /// (q, v_i).
    Reduced,
}

/// Routh's equations as a first-order system.
#[derive(Clone, Debug)]
pub struct MultiplierFlow {
    system: NumericSystem,
    kind: StateKind,
    chart: Chart,
    chart_number: u32,
    projection: Projection,
    q: Vec<f64>,
    v: Vec<f64>,
    accelerations: Accelerations,
    completion: Completion,
    /// Largest residuals found at accepted steps, before projection.
    pub drift: Drift,
    reference_gradient: Vec<f64>,
    /// Pivot of the chart at the last accepted state.
    accepted_pivot: f64,
    /// Quantities followed at accepted steps.
    pub follow: Option<Follow>,
    /// Integrals kept by projection.
    pub keep: Option<Keep>,
    anchor: Anchor,
    /// Quantities whose vanishing makes the equations singular.
    pub watch: Watch,
    /// Whether the watched quantity asked for last vanishes at the state interpolated there.
    zero_between: bool,
    /// Taylor recurrences of the rates of (q, v), with the constraint rows that they use and the states for which they are; made
    /// when first asked for.
    series: Option<((Vec<usize>, States), RateSeries)>,
    /// Accelerations without multipliers, with the constraint rows that they use, where there are such; made when first asked
    /// for.
    direct: Option<(Vec<usize>, Option<Functions>)>,
    /// By event its function along the motion, with the constraint rows that it uses; `None` inside where there is none.
    events: Vec<Option<(Vec<usize>, Option<FunctionAlong>)>>,
    /// Coefficients of (q, v).
    full: Vec<f64>,
    /// The state without whole turns of its angles.
    reduced: Vec<f64>,
    /// Follows the rank of the constraints, where it may fall.
    track: Option<Box<Track>>,
    /// Where it seems to fall.
    falls: Option<f64>,
    /// What was measured before the last step.
    before: (Vec<Deviation>, Option<Drift>),
    /// Time and state at which the accelerations were computed last, where nothing has changed since.
    solved: Option<f64>,
    solved_state: Vec<f64>,
}

/// A stage whose pivot fell below this fraction of its value where the step began rejects the step, where the chart only
/// serves to solve for the accelerations.
const UNUSABLE: f64 = 1e-3;
/// A projection that keeps integrals: time, q, v and the metric; true when it moved them.
type Way = fn(&mut Keep, f64, &mut [f64], &mut [f64], &[f64]) -> bool;
/// The rate of a watched quantity that is not near zero: negative as on the way there, so that its minimum is a zero of the rate.
pub(crate) const AWAY: f64 = -1e-12;
/// A gradient counts as vanished below this fraction of its largest length so far.
const VANISHED: f64 = 1e-8;

impl MultiplierFlow {
    /// The flow from a consistent state, without projection. `Reduced` falls back to `Full` for constraints nonlinear in the velocities.
    pub fn new(
        system: NumericSystem,
        start: &ConsistentState,
        kind: StateKind,
        watch: Watch,
    ) -> MultiplierFlow {
        let mut flow = MultiplierFlow::idle(system, watch);
        flow.begin(start, kind, Projection::NONE);
        flow
    }

    /// What is compiled, without a state.
    pub(crate) fn idle(system: NumericSystem, watch: Watch) -> MultiplierFlow {
        MultiplierFlow {
            follow: None,
            keep: None,
            anchor: Anchor::default(),
            q: Vec::new(),
            v: Vec::new(),
            chart: Chart {
                rows: Vec::new(),
                dependent: Vec::new(),
                independent: Vec::new(),
                pivot: 1.0,
                gap: f64::INFINITY,
            },
            chart_number: 0,
            drift: Drift::new(&system),
            reference_gradient: Vec::new(),
            accepted_pivot: 1.0,
            accelerations: Accelerations::default(),
            completion: Completion::default(),
            projection: Projection::NONE,
            kind: StateKind::Full,
            watch,
            zero_between: false,
            series: None,
            direct: None,
            events: Vec::new(),
            full: Vec::new(),
            reduced: Vec::new(),
            track: None,
            falls: None,
            before: (Vec::new(), None),
            solved: None,
            solved_state: Vec::new(),
            system,
        }
    }

    /// Begins at a consistent state. Nothing is left of the runs before but what was compiled: a run has the same bits
    /// whichever went before it.
    pub(crate) fn begin(
        &mut self,
        start: &ConsistentState,
        kind: StateKind,
        projection: Projection,
    ) {
        self.watch.begin(start.t, &start.q, &start.v);
        self.kind = match self.system.is_affine() {
            true => kind,
            false => StateKind::Full,
        };
        self.projection = match self.kind {
            StateKind::Full => projection,
            StateKind::Reduced => Projection::NONE,
        };
        self.q.clone_from(&start.q);
        self.v.clone_from(&start.v);
        self.chart.clone_from(&start.chart);
        self.chart_number = 0;
        self.accepted_pivot = start.chart.pivot;
        self.drift = Drift::new(&self.system);
        self.reference_gradient.clear();
        self.reference_gradient.resize(self.system.r, 0.0);
        self.accelerations = Accelerations::default();
        self.completion = Completion::default();
        self.anchor = Anchor::default();
        self.zero_between = false;
        self.solved = None;
        self.falls = None;
        if let Some(track) = &mut self.track {
            track.begin();
        }
        let at = (start.t, &start.q[..], &start.v[..]);
        if let Some(follow) = &mut self.follow {
            follow.begin(at);
        }
        if let Some(keep) = &mut self.keep {
            keep.begin(at);
        }
        self.settle(start.t);
        self.falls = self.rank_falls(start.t);
    }

    /// Follows the rank of the constraints, which is `rank` at almost all states.
    pub(crate) fn follow_rank(&mut self, rank: usize) {
        self.track = Some(Box::new(Track::new(self.system.clone(), rank)));
    }

    /// Where the rank of the constraints seems to fall, before the present (q, v) or soon after it.
    fn rank_falls(&mut self, t: f64) -> Option<f64> {
        self.track.as_ref()?;
        let known = self.solve_here(t);
        if known.is_err() {
            self.solved = None;
        }
        let unknown = vec![f64::NAN; self.system.n];
        let a = match known {
            Ok(()) => &self.accelerations.a,
            Err(_) => &unknown,
        };
        let at = (t, &self.q[..], &self.v[..], &a[..]);
        self.track.as_mut()?.record(at)
    }

    /// Sets other values of the parameters, in the order of the binding.
    ///
    /// # Errors
    /// [`FunctionsError::Prepare`].
    pub(crate) fn set_parameters(&mut self, values: &[f64]) -> Result<(), FunctionsError> {
        self.system.set_parameters(values)?;
        self.watch.set_parameters(values)?;
        if let Some(track) = &mut self.track {
            track.system_mut().set_parameters(values)?;
        }
        if let Some(follow) = &mut self.follow {
            follow.set_parameters(values)?;
        }
        if let Some(keep) = &mut self.keep {
            keep.set_parameters(values)?;
        }
        if let Some((_, series)) = &mut self.series {
            series.set_parameters(values)?;
        }
        if let Some((_, Some(direct))) = &mut self.direct {
            direct.set_parameters(values)?;
        }
        self.events.clear();
        Ok(())
    }

    /// The numeric system, to look for consistent states with.
    pub(crate) fn system_mut(&mut self) -> &mut NumericSystem {
        &mut self.system
    }

    /// Takes the present (q, v) for a state of the motion, from which the constraints do not jump.
    fn settle(&mut self, t: f64) {
        if self.system.r == 0 || self.system.evaluate(t, &self.q, &self.v).is_err() {
            return;
        }
        if !self.system.holonomic.is_empty() {
            let _ = self.system.evaluate_positions(t, &self.q, &self.v);
        }
        self.anchor.settle(&self.system, t, &self.q, &self.v);
    }

    /// The row of a constraint that lies apart from the last accepted state, at the state last evaluated.
    fn left(&mut self, t: f64) -> Option<usize> {
        let apart = match self.kind {
            StateKind::Full => self.anchor.left(&self.system, &self.v),
            StateKind::Reduced => self
                .anchor
                .left_velocity(&self.v, &self.chart.dependent)
                .map(|index| self.chart.rows[index]),
        };
        if apart.is_some() || self.system.holonomic.is_empty() {
            return apart;
        }
        self.system.evaluate_positions(t, &self.q, &self.v).ok()?;
        self.anchor.left_position(&self.system, &self.q)
    }

    /// The state vector of (q, v).
    pub fn pack(&self, q: &[f64], v: &[f64]) -> Vec<f64> {
        let mut y = q.to_vec();
        match self.kind {
            StateKind::Full => y.extend_from_slice(v),
            StateKind::Reduced => y.extend(self.chart.independent.iter().map(|&i| v[i])),
        }
        y
    }

    /// Layout of the rows.
    pub fn layout(&self) -> RowLayout {
        RowLayout::new(self.system.n, self.system.r).with_masses(self.system.masses.len())
    }

    /// Which variables are integrated.
    pub fn kind(&self) -> StateKind {
        self.kind
    }

    /// Smallest pivot of the present chart over its value when chosen, at the state y; 0 where it cannot be computed.
    pub fn pivot_ratio(&mut self, t: f64, y: &[f64]) -> f64 {
        if self.system.r == 0 {
            return 1.0;
        }
        if self.unpack(t, y).is_err() || self.system.evaluate(t, &self.q, &self.v).is_err() {
            return 0.0;
        }
        self.choose().pivot
    }

    /// The present chart.
    pub fn chart(&self) -> &Chart {
        &self.chart
    }

    /// The numeric system.
    pub fn system(&self) -> &NumericSystem {
        &self.system
    }

    fn unpack(&mut self, t: f64, y: &[f64]) -> Result<(), EvaluationFailure> {
        if self.solved == Some(t) && self.solved_state == y {
            return Ok(());
        }
        self.solved = None;
        let (positions, rest) = y.split_at(self.system.positions());
        self.q.copy_from_slice(positions);
        match self.kind {
            StateKind::Full => self.v.copy_from_slice(rest),
            StateKind::Reduced => {
                for (&i, &value) in self.chart.independent.iter().zip(rest) {
                    self.v[i] = value;
                }
                self.system.complete_velocities(
                    t,
                    &self.q,
                    &mut self.v,
                    &self.chart,
                    &mut self.completion,
                )?;
            }
        }
        Ok(())
    }

    fn evaluate(&mut self, t: f64, y: &[f64]) -> Result<(), EvaluationFailure> {
        // What is watched is asked for several times at one state.
        if self.solved == Some(t) && self.solved_state == y {
            return Ok(());
        }
        self.unpack(t, y)?;
        self.solve_here(t)?;
        self.remember(t, y);
        Ok(())
    }

    /// The accelerations at (q, v). Where all velocities are integrated the chart serves for this alone, and where it is bad
    /// another one is taken, for this state.
    fn solve_here(&mut self, t: f64) -> Result<(), EvaluationFailure> {
        self.system.evaluate(t, &self.q, &self.v)?;
        // In all velocities a chart only serves to solve. A step may pass a singular place of it, with rows to be written there.
        let is_poor = self.kind == StateKind::Full
            && self.system.r > 0
            && self.quality() < DEGRADED * self.chart.pivot;
        let here = is_poor.then(|| self.choose());
        let better = here.filter(|here| here.rows == self.chart.rows);
        let chart = better.as_ref().unwrap_or(&self.chart);
        Ok(self.accelerations.solve(&self.system, chart)?)
    }

    /// The accelerations are those at the state y.
    fn remember(&mut self, t: f64, y: &[f64]) {
        self.solved = Some(t);
        self.solved_state.clear();
        self.solved_state.extend_from_slice(y);
    }

    fn quality(&self) -> f64 {
        let (system, n) = (&self.system, self.system.n);
        let mass = system.mass();
        let weight = |i: usize| mass[i * n + i];
        chart::quality(&self.chart, system.jacobian(), n, weight)
    }

    /// The same without the weights of the masses: where inertias grow or vanish the chart is not to blame.
    fn geometric_quality(&self) -> f64 {
        chart::quality(&self.chart, self.system.jacobian(), self.system.n, |_| 1.0)
    }

    /// Chooses again at the state of the last evaluation of the constraints.
    fn choose(&self) -> Chart {
        let system = &self.system;
        chart::choose(
            system.jacobian(),
            (system.r, system.n),
            &system.mass_diagonal(),
            Floor::Along(self.chart.pivot),
        )
    }

    fn switch(&mut self, next: Chart, before: f64, y: &mut [f64]) -> Control {
        let change = ChartChange {
            from: self.chart_number,
            to: self.chart_number + 1,
            pivot_before: before,
            pivot_after: next.pivot,
        };
        self.chart_number += 1;
        self.solved = None;
        self.accepted_pivot = next.pivot;
        self.chart = next;
        let packed = self.pack(&self.q.clone(), &self.v.clone());
        y.copy_from_slice(&packed);
        Control::ChartSwitched(change)
    }

    /// The row whose gradient has vanished, if any, and the rank with it; keeps the largest length seen of each. A constraint that the
    /// others imply may lose its gradient: the rank is theirs.
    fn vanished_gradient(&mut self) -> Option<usize> {
        let (n, r) = (self.system.n, self.system.r);
        let mut gone: Option<usize> = None;
        let mut left = Vec::new();
        for row in 0..r {
            let gradient = &self.system.jacobian()[row * n..(row + 1) * n];
            let length = gradient.iter().map(|x| x * x).sum::<f64>().sqrt();
            self.reference_gradient[row] = self.reference_gradient[row].max(length);
            if length <= VANISHED * self.reference_gradient[row] {
                if left.is_empty() {
                    left = self.system.jacobian().to_vec();
                }
                left[row * n..(row + 1) * n].fill(0.0);
                gone = gone.or(Some(row));
            }
        }
        let row = gone?;
        let rest = chart::choose(
            &left,
            (r, n),
            &self.system.mass_diagonal(),
            Floor::Along(self.chart.pivot),
        );
        (rest.rank() < self.chart.rank()).then_some(row)
    }

    fn rank_drop(&self, to: usize, constraint: usize) -> Control {
        Control::Stop(HaltReason::RankDrop {
            from: self.chart.rank(),
            to,
            constraint,
        })
    }

    /// Moves an accepted state onto the constraints; true when y changed.
    fn project(&mut self, t: f64, y: &mut [f64]) -> bool {
        let moved = self
            .projection
            .apply(&mut self.system, t, &mut self.q, &mut self.v);
        if moved {
            self.solved = None;
            let (positions, rest) = y.split_at_mut(self.system.positions());
            positions.copy_from_slice(&self.q);
            rest.copy_from_slice(&self.v);
        }
        moved
    }

    /// Moves an accepted state onto the integrals to keep; true when y changed.
    fn bring_back(&mut self, t: f64, y: &mut [f64]) -> bool {
        if self.keep.is_none() || self.unpack(t, y).is_err() {
            return false;
        }
        let moved = self.move_by(t, Keep::bring_back);
        if moved {
            let packed = self.pack(&self.q, &self.v);
            y.copy_from_slice(&packed);
            // A chart that is about to be left gives the dependent velocities badly.
            if self.solve_here(t).is_ok() {
                self.remember(t, y);
            }
        }
        moved
    }

    /// The same for a state within a step, of which the accelerations are known: they are computed anew where it changes.
    fn bring_between(&mut self, t: f64) -> Result<(), EvaluationFailure> {
        if self.keep.is_none() || !self.move_by(t, Keep::bring_between) {
            return Ok(());
        }
        self.solve_here(t)
    }

    /// Moves (q, v), where the metric is known there; true when they changed.
    fn move_by(&mut self, t: f64, way: Way) -> bool {
        if self.system.evaluate(t, &self.q, &self.v).is_err() {
            return false;
        }
        let metric = self.system.metric();
        let (q, v) = (&mut self.q, &mut self.v);
        let moved = (self.keep.as_mut()).is_some_and(|keep| way(keep, t, q, v, &metric));
        if moved {
            self.solved = None;
        }
        moved
    }

    /// Records an accepted state, projects it and looks for a better chart.
    fn settle_and_choose(&mut self, t: f64, y: &mut [f64]) -> Control {
        if self.unpack(t, y).is_err() || self.system.evaluate(t, &self.q, &self.v).is_err() {
            return Control::Continue;
        }
        self.watch.record(t, &self.q, &self.v);
        if let Some(index) = self.watch.vanished() {
            return Control::Stop(HaltReason::Custom(index as u32));
        }
        if self.system.r == 0 {
            return Control::Continue;
        }
        if !self.system.holonomic.is_empty() {
            let _ = self.system.evaluate_positions(t, &self.q, &self.v);
        }
        if self.kind == StateKind::Full {
            if let Some(constraint) = self.anchor.left(&self.system, &self.v) {
                return Control::Stop(HaltReason::LeftConstraint { constraint });
            }
        }
        self.drift.record(&self.system, t);
        if let Some(row) = self.vanished_gradient() {
            return self.rank_drop(self.chart.rank().saturating_sub(1), row);
        }
        let unchanged = if self.project(t, y) {
            Control::StateModified
        } else {
            Control::Continue
        };
        let before = self.quality();
        self.accepted_pivot = before;
        if before >= DEGRADED * self.chart.pivot {
            return unchanged;
        }
        let next = self.choose();
        if next.rank() < self.chart.rank() {
            let missing = (0..self.system.r)
                .find(|row| !next.rows.contains(row))
                .unwrap_or(0);
            return self.rank_drop(next.rank(), missing);
        }
        if next.pivot < HYSTERESIS * before {
            return unchanged;
        }
        self.switch(next, before, y)
    }
}

impl Sides for MultiplierFlow {
    fn state(&mut self, t: f64, y: &[f64]) -> Option<Place<'_>> {
        self.evaluate(t, y).ok()?;
        Some((&self.q, &self.v, &self.accelerations.a[..]))
    }

    fn looks(&mut self) -> &mut Option<Sticking> {
        &mut self.watch.sticking
    }
}

impl System for MultiplierFlow {
    fn dimension(&self) -> usize {
        match self.kind {
            StateKind::Full => self.system.positions() + self.system.n,
            StateKind::Reduced => self.system.positions() + self.chart.independent.len(),
        }
    }

    fn derivative(&mut self, t: f64, y: &[f64], dy: &mut [f64]) -> Result<(), EvaluationFailure> {
        if self.direct_rates(t, y, dy) {
            return Ok(());
        }
        self.evaluate(t, y)?;
        if self.system.r > 0 {
            let least = match self.kind {
                StateKind::Full => UNUSABLE,
                StateKind::Reduced => chart::BLIND,
            };
            let ratio = self.quality() / self.accepted_pivot;
            if ratio < least && self.geometric_quality() < least {
                return Err(EvaluationFailure::PivotDegraded { ratio });
            }
        }
        if self.system.jumps {
            if let Some(constraint) = self.left(t) {
                return Err(EvaluationFailure::LeftConstraint { constraint });
            }
        }
        let (positions, rest) = dy.split_at_mut(self.system.positions());
        self.system.position_rates(t, &self.q, &self.v, positions)?;
        match self.kind {
            StateKind::Full => rest.copy_from_slice(&self.accelerations.a),
            StateKind::Reduced => {
                for (rate, &i) in rest.iter_mut().zip(&self.chart.independent) {
                    *rate = self.accelerations.a[i];
                }
            }
        }
        Ok(())
    }

    fn has_series(&self) -> bool {
        true
    }

    fn expand(
        &mut self,
        t: f64,
        (y, carry): (&[f64], &[f64]),
        order: usize,
        coefficients: &mut [f64],
    ) -> Result<(), EvaluationFailure> {
        let n = y.len();
        if self.kind == StateKind::Full && !self.system.jumps {
            let mut reduced = std::mem::take(&mut self.reduced);
            self.system.turns.reduce(y, carry, &mut reduced);
            let series = self.series();
            let outcome = series.and_then(|series| series.expand(t, &reduced, order, coefficients));
            self.reduced = reduced;
            coefficients[..n].copy_from_slice(y);
            return outcome;
        }
        let turns = &self.system.turns;
        let reduced = turns.center(self.system.jumps, (y, carry), coefficients);
        // Whether the chart can be used here and no constraint was left is seen on the way.
        self.derivative(t, &reduced, &mut coefficients[n..2 * n])?;
        if order < 2 {
            return Ok(());
        }
        self.expand_full(t, order)?;
        let positions = self.system.positions();
        let all = positions + self.system.n;
        let rows = coefficients
            .chunks_exact_mut(n)
            .zip(self.full.chunks_exact(all));
        for (own, full) in rows.skip(1) {
            let (q, v) = own.split_at_mut(positions);
            q.copy_from_slice(&full[..positions]);
            match self.kind {
                StateKind::Full => v.copy_from_slice(&full[positions..]),
                StateKind::Reduced => {
                    for (own, &i) in v.iter_mut().zip(&self.chart.independent) {
                        *own = full[positions + i];
                    }
                }
            }
        }
        Ok(())
    }

    fn accepted(&mut self, t: f64, y: &mut [f64]) -> Control {
        if self.track.is_some() {
            let followed = self.follow.as_ref();
            let deviations = followed.map_or(Vec::new(), |follow| follow.deviations.clone());
            self.before = (deviations, Some(self.drift.clone()));
        }
        let moved = self.bring_back(t, y);
        let control = match self.settle_and_choose(t, y) {
            Control::Continue if moved => Control::StateModified,
            other => other,
        };
        if matches!(control, Control::Stop(HaltReason::LeftConstraint { .. })) {
            return control;
        }
        if sticking::sticks(self, (t, y), &control) {
            return Control::Stop(HaltReason::Custom(STUCK));
        }
        if let Some(follow) = &mut self.follow {
            follow.record(t, &self.q, &self.v);
        }
        if self.kind == StateKind::Full || self.system.jumps {
            // The system was last evaluated at this state.
            self.anchor.settle(&self.system, t, &self.q, &self.v);
        }
        if self.track.is_some() && !matches!(control, Control::Stop(_)) {
            self.falls = self.rank_falls(t);
            if self.falls.is_some() {
                return Control::Stop(HaltReason::Custom(crossing::MET));
            }
        }
        control
    }

    fn repivot(&mut self, t: f64, y: &mut [f64]) -> Control {
        if self.unpack(t, y).is_err() || self.system.evaluate(t, &self.q, &self.v).is_err() {
            return Control::Continue;
        }
        let before = self.quality();
        let next = self.choose();
        if next.rank() == self.chart.rank()
            && next.pivot > before
            && next.dependent != self.chart.dependent
        {
            self.switch(next, before, y)
        } else {
            Control::Continue
        }
    }

    fn output_dimension(&self) -> usize {
        self.layout().len()
    }

    fn output(&mut self, t: f64, y: &[f64], row: &mut [f64]) -> Result<(), EvaluationFailure> {
        self.evaluate(t, y)?;
        self.bring_between(t)?;
        let layout = self.layout();
        layout.write(
            row,
            &self.q,
            &self.v,
            &self.accelerations.a,
            &self.accelerations.lambda,
        );
        Ok(())
    }

    fn switching(&mut self, index: usize, t: f64, y: &[f64]) -> Result<f64, EvaluationFailure> {
        // Zeros of the rate are no events away from those of the quantity, and there it takes no accelerations to say so.
        if self.unpack(t, y).is_ok() && !self.watch.is_near(index, t, &self.q, &self.v) {
            return Ok(AWAY);
        }
        // At the singularity itself there are no accelerations, and the last known ones are as good as any: the rate of what
        // vanishes there is zero.
        if let Err(failure) = self.evaluate(t, y) {
            if !self.watch.is_near(index, t, &self.q, &self.v) {
                return Err(failure);
            }
            self.accelerations.fill_unknown(self.system.n);
        }
        self.watch
            .switching(index, t, &self.q, &self.v, &self.accelerations.a)
    }

    fn is_event(&mut self, index: usize, t: f64, y: &[f64]) -> bool {
        if self.unpack(t, y).is_err() {
            self.zero_between = true;
            return true;
        }
        self.zero_between = self.watch.vanishes(index, t, &self.q, &self.v);
        self.watch.is_near(index, t, &self.q, &self.v)
    }

    fn factorizations(&self) -> u64 {
        self.accelerations.factorizations
    }
}
