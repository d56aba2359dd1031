//! Routh's equations for all velocities as a first-order system in double-double arithmetic.

use super::functions::PreciseFunctions;
use super::start::{Newton, State};
use super::{rounded, DoubleDouble, Precise};
use crate::drift::Drift;
use crate::follow::{followed_values, Deviation};
use crate::functions::{failure, FunctionsError};
use crate::multiplier_flow::AWAY;
use crate::numeric::{NumericSystem, States};
use crate::observe::variables_of_rows;
use crate::row::RowLayout;
use crate::run::{RunSettings, Subject};
use crate::watch::Watch;
use chetaev_compile::PreciseTaylor;
use chetaev_integrate::double_double::PreciseSystem;
use chetaev_integrate::EvaluationFailure;

/// The constraints, by row of the terms, and the holonomic ones as stated.
pub(super) struct Constraints {
    functions: PreciseFunctions,
    r: usize,
}

impl Constraints {
    pub(super) fn new(subject: &Subject<'_>, precise: &Precise) -> Result<Self, FunctionsError> {
        let numbers = (subject.binding, &precise.parameters[..]);
        let (g, variables) = (&subject.system.graph, &subject.binding.variables);
        Ok(Constraints {
            functions: PreciseFunctions::new(g, numbers, variables, &subject.residuals())?,
            r: subject.numeric.r,
        })
    }

    fn values(&mut self, t: DoubleDouble, (q, v): (&[DoubleDouble], &[DoubleDouble])) -> Vec<f64> {
        match self.functions.evaluate(t, &[q, v]) {
            Ok(values) => rounded(values),
            Err(_) => Vec::new(),
        }
    }

    /// f by row; `None` where one has no value.
    pub(super) fn velocities(&mut self, t: DoubleDouble, state: &State) -> Option<Vec<f64>> {
        let mut values = self.values(t, (&state.0, &state.1));
        values.truncate(self.r);
        values.iter().all(|f| f.is_finite()).then_some(values)
    }

    /// φ of the holonomic constraints; `None` where one has no value.
    pub(super) fn positions(&mut self, t: DoubleDouble, state: &State) -> Option<Vec<f64>> {
        let values = self.values(t, (&state.0, &state.1));
        let values = values.get(self.r..)?.to_vec();
        values.iter().all(|f| f.is_finite()).then_some(values)
    }
}

/// What should keep its value.
struct Followed {
    /// Values, then sizes.
    functions: PreciseFunctions,
    initial: Vec<DoubleDouble>,
    deviations: Vec<Deviation>,
    last: Option<DoubleDouble>,
}

/// The system of a run.
pub(super) struct PreciseFlow {
    taylor: PreciseTaylor,
    /// a and λ at a state.
    reactions: PreciseFunctions,
    pub(super) layout: RowLayout,
    /// Number of positions.
    positions: usize,
    numeric: NumericSystem,
    constraints: Constraints,
    /// Residuals up to this part of the state are left; `None` where nothing is projected.
    bound: Option<f64>,
    pub(super) drift: Drift,
    followed: Option<Followed>,
    pub(super) watch: Watch,
    /// Functions of the events, over output rows.
    observers: Vec<PreciseFunctions>,
    inputs: Vec<DoubleDouble>,
    row: Vec<DoubleDouble>,
}

impl PreciseFlow {
    pub(super) fn new(
        subject: &Subject<'_>,
        settings: &RunSettings,
        precise: &Precise,
    ) -> Result<PreciseFlow, FunctionsError> {
        let numeric = subject.numeric.clone();
        let rows = &subject.start.chart.rows;
        let states = match settings.project {
            true => States::Admissible,
            false => States::All,
        };
        let mut taylor = PreciseTaylor::new(&numeric.rates_over(rows, states)?)?;
        taylor.prepare(&precise.parameters)?;
        let (system, binding) = (subject.system, subject.binding);
        let numbers = (binding, &precise.parameters[..]);
        let g = &system.graph;
        let known = numeric.reactions(rows)?;
        let of_rows = variables_of_rows(system, subject.terms, binding, &[]);
        let observer = |value| PreciseFunctions::new(g, numbers, &of_rows, &[value]);
        let observers: Result<_, _> = settings.events.iter().map(|e| observer(e.value)).collect();
        let layout = RowLayout::new(numeric.n, numeric.r).with_masses(numeric.masses.len());
        Ok(PreciseFlow {
            taylor,
            reactions: PreciseFunctions::new(g, numbers, &binding.variables, &known)?,
            positions: numeric.positions(),
            constraints: Constraints::new(subject, precise)?,
            bound: settings.project.then(|| super::run::bound(settings)),
            drift: Drift::new(&numeric),
            followed: None,
            watch: Watch::new(system, subject.terms, binding, subject.selection.rows.len())?,
            observers: observers?,
            inputs: Vec::new(),
            row: vec![DoubleDouble::ZERO; layout.len()],
            layout,
            numeric,
        })
    }

    /// The consistent start, from which everything is followed.
    pub(super) fn begin(
        &mut self,
        subject: &Subject<'_>,
        settings: &RunSettings,
        precise: &Precise,
    ) -> Result<Vec<DoubleDouble>, FunctionsError> {
        let (numeric, constraints) = (&mut self.numeric, &mut self.constraints);
        let state = super::start::start(numeric, constraints, subject.start, precise);
        if !settings.follow.is_empty() {
            let kept = [settings.follow.clone(), subject.residuals()].concat();
            let all = followed_values(subject.system, subject.binding, &kept);
            let numbers = (subject.binding, &precise.parameters[..]);
            let (g, variables) = (&subject.system.graph, &subject.binding.variables);
            let mut functions = PreciseFunctions::new(g, numbers, variables, &all)?;
            let at = functions.evaluate(precise.t_start, &[&state.0, &state.1]);
            let mut initial = at.map_or(Vec::new(), <[_]>::to_vec);
            initial.resize(all.len(), DoubleDouble::from(f64::NAN));
            self.followed = Some(Followed {
                deviations: vec![Deviation::default(); kept.len()],
                functions,
                initial,
                last: None,
            });
        }
        let y = [state.0, state.1].concat();
        self.look(precise.t_start, &y);
        Ok(y)
    }

    /// What became of the quantities followed.
    pub(super) fn deviations(&self, until_singular: bool) -> Vec<Deviation> {
        let followed = self.followed.as_ref();
        let all = followed.map_or(&[][..], |followed| &followed.deviations);
        all.iter().map(|own| own.finished(until_singular)).collect()
    }

    /// Takes the values at a state into account.
    fn look(&mut self, t: DoubleDouble, y: &[DoubleDouble]) {
        let doubles = rounded(y);
        let (q, v) = doubles.split_at(self.positions);
        self.watch.record(t.high(), q, v);
        let Some(followed) = &mut self.followed else {
            return;
        };
        let is_new = followed.last != Some(t);
        followed.last = Some(t);
        let Ok(values) = followed.functions.evaluate(t, &[y]) else {
            return;
        };
        let (values, sizes) = values.split_at(followed.deviations.len());
        let changes = values.iter().zip(&followed.initial);
        let all = followed.deviations.iter_mut().zip(sizes);
        for ((deviation, size), (&value, &initial)) in all.zip(changes) {
            let change = (value - initial).high();
            deviation.record(change, size.high(), (t.high(), is_new));
        }
    }

    /// Accelerations and multipliers.
    fn reactions(
        &mut self,
        t: DoubleDouble,
        y: &[DoubleDouble],
    ) -> Result<&[DoubleDouble], EvaluationFailure> {
        let found = self.reactions.evaluate(t, &[y])?;
        match found.iter().position(|value| !value.is_finite()) {
            Some(component) => Err(EvaluationFailure::NotFinite { component }),
            None => Ok(found),
        }
    }

    /// Accelerations in doubles; zero where they are not known.
    pub(super) fn accelerations(&mut self, t: DoubleDouble, y: &[DoubleDouble]) -> Vec<f64> {
        let n = self.numeric.n;
        match self.reactions(t, y) {
            Ok(found) => rounded(&found[..n]),
            Err(_) => vec![0.0; n],
        }
    }

    /// Number of quantities watched.
    fn own(&self) -> usize {
        self.watch.quantities.len()
    }
}

impl PreciseSystem for PreciseFlow {
    fn dimension(&self) -> usize {
        self.positions + self.numeric.n
    }

    fn expand(
        &mut self,
        t: DoubleDouble,
        y: &[DoubleDouble],
        order: usize,
        coefficients: &mut [DoubleDouble],
    ) -> Result<(), EvaluationFailure> {
        self.inputs.clear();
        self.inputs.push(t);
        self.inputs.extend_from_slice(y);
        self.taylor
            .expand(&self.inputs, order, coefficients)
            .map_err(failure)
    }

    fn accepted(&mut self, t: DoubleDouble, y: &mut [DoubleDouble]) -> bool {
        let (q, v) = y.split_at(self.positions);
        let mut state = (q.to_vec(), v.to_vec());
        let velocities = self.constraints.velocities(t, &state).unwrap_or_default();
        let positions = self.constraints.positions(t, &state).unwrap_or_default();
        self.drift.take(&velocities, &positions, t.high());
        let mut is_moved = false;
        if let Some(bound) = self.bound {
            let mut newton = Newton {
                numeric: &mut self.numeric,
                constraints: &mut self.constraints,
                t,
            };
            let all = newton.all();
            is_moved = newton.positions(&mut state, &all, bound);
            is_moved |= newton.velocities(&mut state, &all, bound);
        }
        if is_moved {
            y[..self.positions].copy_from_slice(&state.0);
            y[self.positions..].copy_from_slice(&state.1);
        }
        self.look(t, y);
        is_moved
    }

    fn output_dimension(&self) -> usize {
        self.layout.len()
    }

    fn output(
        &mut self,
        t: DoubleDouble,
        y: &[DoubleDouble],
        row: &mut [DoubleDouble],
    ) -> Result<(), EvaluationFailure> {
        row[..y.len()].copy_from_slice(y);
        row[y.len()..].copy_from_slice(self.reactions(t, y)?);
        Ok(())
    }

    fn switching(
        &mut self,
        index: usize,
        t: DoubleDouble,
        y: &[DoubleDouble],
    ) -> Result<DoubleDouble, EvaluationFailure> {
        if let Some(number) = index.checked_sub(self.own()) {
            let mut row = std::mem::take(&mut self.row);
            let made = self.output(t, y, &mut row);
            self.row = row;
            made?;
            return Ok(self.observers[number].evaluate(t, &[&self.row])?[0]);
        }
        let doubles = rounded(y);
        let (q, v) = doubles.split_at(self.positions);
        if !self.watch.is_near(index, t.high(), q, v) {
            return Ok(DoubleDouble::from(AWAY));
        }
        let a = self.accelerations(t, y);
        let rate = self.watch.switching(index, t.high(), q, v, &a)?;
        Ok(DoubleDouble::from(rate))
    }

    fn is_event(&mut self, index: usize, t: DoubleDouble, y: &[DoubleDouble]) -> bool {
        let doubles = rounded(y);
        let (q, v) = doubles.split_at(self.positions);
        index >= self.own() || self.watch.vanishes(index, t.high(), q, v)
    }
}
