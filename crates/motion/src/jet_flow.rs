//! The motion under constraints of order m ≥ 2, and by characteristics that the user states: a formulation's equations
//! integrated in its own state, which holds derivatives of coordinates up to order m - 1, multipliers, and unknowns that no
//! formula gives (T2 §5).
//!
//! State (q, masses with a law of their own, variables). What vanishes along every motion, constraints of lower order,
//! equations that were differentiated and implicit equations, is measured at each step and brought back to zero where asked.

use crate::chart::{self, Chart, DEGRADED, HYSTERESIS};
use crate::follow::Follow;
use crate::formulation_flow::FlowError;
use crate::functions::Functions;
use crate::initial::jets::JetStart;
use crate::initial::ConsistentState;
use crate::least_norm::{identity, least_squares, least_step};
use crate::row::RowLayout;
use crate::run::WatchedFlow;
use crate::series::RateSeries;
use crate::watch::Watch;
use chetaev_integrate::{Control, EvaluationFailure, HaltReason, System as Flow};
use chetaev_mechanics::{Equations, Selection};
use chetaev_symbolic::Symbol;

mod parts;

pub use parts::Parts;
use parts::{with_time, Compiled};

/// Groups of the compiled motion, in order.
const VELOCITIES: usize = 0;
const RATES: usize = 1;
const HIGHER: usize = 2;
const MASSES: usize = 3;

/// A formulation's equations on a jet as a first-order system.
pub struct JetFlow<'a> {
    parts: Parts<'a>,
    current: Compiled,
    /// (t, q, …, q^(m)) → w and A, for the multipliers.
    reactions: Functions,
    is_chart: bool,
    project: bool,
    /// Quantities followed at accepted steps.
    pub follow: Option<Follow>,
    pub(crate) watch: Watch,
    zero_between: bool,
    settled: f64,
    rates: Vec<f64>,
}

impl std::fmt::Debug for JetFlow<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "JetFlow({})", self.parts.formulation.card().name)
    }
}

impl<'a> JetFlow<'a> {
    /// The flow and its state at the start.
    ///
    /// # Errors
    /// [`FlowError`].
    pub fn new(
        parts: Parts<'a>,
        selection: &Selection,
        start: &ConsistentState,
        jets: &JetStart,
        project: bool,
    ) -> Result<(JetFlow<'a>, Vec<f64>), FlowError> {
        let mut reactions = parts.reactions()?;
        let selection = parts.selection_at(&mut reactions, selection, start, jets);
        let (equations, current) = parts.compile(selection, 1.0)?;
        let mut flow = JetFlow {
            watch: parts.watch(&equations, &current)?,
            reactions,
            is_chart: equations.on_characteristics.is_some(),
            project,
            follow: None,
            zero_between: false,
            settled: start.t,
            rates: vec![0.0; current.symbols.len()],
            current,
            parts,
        };
        let y = flow.start(&equations, start, jets)?;
        if let Some(pivot) = flow.pivot(start.t, &y) {
            flow.current.pivot = pivot;
        }
        flow.watch.record(start.t, &y, &[]);
        Ok((flow, y))
    }

    /// The state from what is known of the start; parameters that the user's formulas introduce are solved for.
    fn start(
        &self,
        equations: &Equations,
        start: &ConsistentState,
        jets: &JetStart,
    ) -> Result<Vec<f64>, FlowError> {
        let system = self.parts.system;
        let mut known: Vec<(Symbol, f64)> = Vec::new();
        for (i, c) in system.coordinates.iter().enumerate() {
            known.push((c.q_symbol, start.q[i]));
            known.push((c.v_symbol, start.v[i]));
        }
        let masses = system.masses.iter().zip(&start.q[system.n()..]);
        known.extend(masses.map(|(m, &value)| (m.symbol, value)));
        known.extend(&jets.values);
        let symbols = &self.current.symbols;
        self.parts.at_start(equations, start.t, &known, symbols)
    }

    /// Layout of the rows: q, q', q'', multipliers, and derivatives of orders 3 to m.
    pub fn layout(&self) -> RowLayout {
        let (n, terms) = (self.parts.system.n(), self.parts.terms);
        let higher = terms.order.saturating_sub(2) as usize * n;
        RowLayout::new(n, terms.constraints.len())
            .with_masses(self.parts.system.masses.len())
            .with_own(higher + self.parameter_places().len())
    }

    /// Names of what a row ends with.
    pub fn own_names(&self) -> Vec<String> {
        let system = self.parts.system;
        let mut names = Vec::new();
        for order in 3..=self.parts.terms.order {
            let own = system.coordinates.iter();
            names.extend(own.map(|c| format!("{}{}", c.name, "'".repeat(order as usize))));
        }
        names.extend(
            self.parameter_places()
                .into_iter()
                .map(|i| self.current.names[i].clone()),
        );
        names
    }

    /// Places in the state of what is no derivative of a coordinate and no multiplier: parameters, derivatives of multipliers.
    fn parameter_places(&self) -> Vec<usize> {
        let (system, g) = (self.parts.system, &self.parts.system.graph);
        let symbols = self.current.symbols.iter().enumerate();
        symbols
            .filter(|(_, &s)| {
                let name = g.symbol_name(s);
                let is_mass = system.masses.iter().any(|m| m.symbol == s);
                // The multipliers themselves have places of their own in a row; their derivatives have none.
                let is_multiplier = name.starts_with("lambda_") && g.symbol_order(s) == 0;
                system.coordinate_index(name).is_none() && !is_mass && !is_multiplier
            })
            .map(|(i, _)| i)
            .collect()
    }

    /// Names of the variables of the state.
    pub fn names(&self) -> &[String] {
        &self.current.names
    }

    /// What the equations determine, in quotes.
    pub fn unknowns(&self) -> String {
        self.parts.unknowns()
    }

    /// The state symbols.
    pub fn symbols(&self) -> &[Symbol] {
        &self.current.symbols
    }

    fn evaluate(&mut self, t: f64, y: &[f64]) -> Result<(), EvaluationFailure> {
        self.current.motion.evaluate(t, &[y])
    }

    /// Masses with a law of their own, q, q', …, q^(m) at a state that was evaluated.
    fn jets(&self, y: &[f64]) -> Vec<f64> {
        let (n, masses) = (self.parts.system.n(), self.parts.system.masses.len());
        let motion = &self.current.motion;
        [
            &y[n..n + masses],
            &y[..n],
            motion.group(VELOCITIES),
            motion.group(HIGHER),
        ]
        .concat()
    }

    /// A at a state that was evaluated, r × n.
    fn gradient(&mut self, t: f64, y: &[f64]) -> Option<Vec<f64>> {
        let jets = self.jets(y);
        self.reactions.evaluate(t, &[&jets]).ok()?;
        Some(self.reactions.group(1).to_vec())
    }

    /// The multipliers by row: the least solution of `Aᵀ λ = w`.
    fn multipliers(&mut self, t: f64, y: &[f64]) -> Vec<f64> {
        let (n, r) = (self.parts.system.n(), self.parts.terms.constraints.len());
        let jets = self.jets(y);
        if self.reactions.evaluate(t, &[&jets]).is_err() {
            return vec![f64::NAN; r];
        }
        let (w, a) = (self.reactions.group(0), self.reactions.group(1));
        let selected = &self.current.selection.rows;
        let mut columns = vec![0.0; n * selected.len()];
        for (l, &row) in selected.iter().enumerate() {
            for i in 0..n {
                columns[i * selected.len() + l] = a[row * n + i];
            }
        }
        let all: Vec<usize> = (0..selected.len()).collect();
        let found = least_squares(&columns, w, selected.len(), &all);
        let mut lambda = vec![0.0; r];
        for (&row, value) in selected.iter().zip(found) {
            lambda[row] = value;
        }
        lambda
    }

    fn pivot(&mut self, t: f64, y: &[f64]) -> Option<f64> {
        if !self.is_chart || self.evaluate(t, y).is_err() {
            return None;
        }
        let a = self.gradient(t, y)?;
        let present = self.chart();
        Some(chart::quality(&present, &a, self.parts.system.n(), |_| 1.0))
    }

    fn chart(&self) -> Chart {
        Chart {
            rows: self.current.selection.rows.clone(),
            dependent: self.current.selection.dependent.clone(),
            independent: Vec::new(),
            pivot: self.current.pivot,
            gap: f64::INFINITY,
        }
    }

    /// The row of a state at which the equations are singular: what is no variable of the state is unknown there.
    fn singular_row(&self, y: &[f64], row: &mut [f64]) -> Option<()> {
        let (system, layout) = (self.parts.system, self.layout());
        let n = system.n();
        row.fill(f64::NAN);
        let value = |c: &str, order: u32| {
            let symbol = system.graph.intern_symbol(c, order);
            let place = self.current.symbols.iter().position(|s| *s == symbol)?;
            Some(y[place])
        };
        row[layout.positions()].copy_from_slice(&y[layout.positions()]);
        for (i, c) in system.coordinates.iter().enumerate() {
            row[layout.v().start + i] = value(&c.name, 1)?;
            for order in 2..self.parts.terms.order {
                let start = match order {
                    2 => layout.a().start,
                    _ => layout.own().start + (order as usize - 3) * n,
                };
                row[start + i] = value(&c.name, order)?;
            }
        }
        Some(())
    }

    /// Another choice of dependent derivatives where the present one degrades: the state is the same, in another order.
    fn rechoose(&mut self, t: f64, y: &mut [f64]) -> Control {
        let (n, r) = (self.parts.system.n(), self.parts.terms.constraints.len());
        let Some(before) = self
            .pivot(t, y)
            .filter(|&p| p < DEGRADED * self.current.pivot)
        else {
            return Control::Continue;
        };
        let Some(a) = self.gradient(t, y) else {
            return Control::Continue;
        };
        let next = chart::choose(&a, (r, n), &vec![1.0; n], chart::Floor::Along(1.0));
        if next.rank() < self.current.selection.rows.len() {
            return Control::Continue;
        }
        if next.pivot < HYSTERESIS * before || next.dependent == self.current.selection.dependent {
            return Control::Continue;
        }
        let selection = Selection {
            rows: next.rows.clone(),
            dependent: next.dependent.clone(),
        };
        let Ok((equations, entered)) = self.parts.compile(selection, next.pivot) else {
            return Control::Continue;
        };
        let Ok(watch) = self.parts.watch(&equations, &entered) else {
            return Control::Continue;
        };
        if watch.quantities != self.watch.quantities {
            return Control::Continue;
        }
        let place = |s: &Symbol| self.current.symbols.iter().position(|own| own == s);
        let places: Option<Vec<usize>> = entered.symbols.iter().map(place).collect();
        let Some(places) = places else {
            return Control::Continue;
        };
        let old = y.to_vec();
        y.iter_mut()
            .zip(&places)
            .for_each(|(y, &place)| *y = old[place]);
        self.current = entered;
        self.watch = watch;
        self.watch.record(t, y, &[]);
        Control::StateModified
    }

    /// Newton steps of least size on what must vanish, coordinates fixed unless nothing else helps; true when y changed.
    fn bring_back(&mut self, t: f64, y: &mut [f64]) -> bool {
        let n = self.parts.system.n();
        let movable: Vec<usize> = (n + self.parts.system.masses.len()..y.len()).collect();
        let mut changed = false;
        for _ in 0..6 {
            if self.current.invariants.evaluate(t, &[y]).is_err() {
                return changed;
            }
            let values = self.current.invariants.group(0);
            let scale = y.iter().fold(1e-300, |m: f64, x| m.max(x.abs()));
            if values.iter().all(|f| f.abs() <= 8.0 * f64::EPSILON * scale) {
                break;
            }
            let gradient = self.current.invariants.group(1);
            let step = least_step(gradient, values, y.len(), &movable, &identity(y.len()));
            if step
                .iter()
                .any(|d| !d.is_finite() || d.abs() > 1e-2 * (1.0 + scale))
            {
                return changed;
            }
            y.iter_mut().zip(&step).for_each(|(y, d)| *y -= d);
            changed = true;
        }
        changed
    }
}

impl Flow for JetFlow<'_> {
    fn dimension(&self) -> usize {
        self.current.symbols.len()
    }

    fn derivative(&mut self, t: f64, y: &[f64], dy: &mut [f64]) -> Result<(), EvaluationFailure> {
        self.evaluate(t, y)?;
        let motion = &self.current.motion;
        let (q, rest) = dy.split_at_mut(self.parts.system.n());
        let (masses, variables) = rest.split_at_mut(self.parts.system.masses.len());
        q.copy_from_slice(motion.group(VELOCITIES));
        masses.copy_from_slice(motion.group(MASSES));
        variables.copy_from_slice(motion.group(RATES));
        Ok(())
    }

    fn has_series(&self) -> bool {
        true
    }

    fn expand(
        &mut self,
        t: f64,
        (y, _): (&[f64], &[f64]),
        order: usize,
        coefficients: &mut [f64],
    ) -> Result<(), EvaluationFailure> {
        let n = y.len();
        coefficients[..n].copy_from_slice(y);
        self.derivative(t, y, &mut coefficients[n..2 * n])?;
        if order < 2 {
            return Ok(());
        }
        let (parts, current) = (self.parts, &mut self.current);
        if current.series.is_none() {
            let g = &parts.system.graph;
            let variables = with_time(g, &current.symbols);
            let series = RateSeries::new(g, parts.binding, &variables, &current.rates);
            current.series = series.ok();
        }
        match &mut current.series {
            Some(series) => series.expand(t, y, order, coefficients),
            None => Err(EvaluationFailure::NoSeries),
        }
    }

    fn accepted(&mut self, t: f64, y: &mut [f64]) -> Control {
        if self.evaluate(t, y).is_err() {
            return Control::Continue;
        }
        if let Some(follow) = &mut self.follow {
            follow.record(t, y, &[]);
        }
        let modified = self.project && self.bring_back(t, y);
        self.settled = t;
        let control = self.rechoose(t, y);
        self.watch.record(t, y, &[]);
        match (self.watch.vanished(), control) {
            (Some(index), _) => Control::Stop(HaltReason::Custom(index as u32)),
            (None, Control::Continue) if modified => Control::StateModified,
            (None, other) => other,
        }
    }

    fn repivot(&mut self, t: f64, y: &mut [f64]) -> Control {
        self.rechoose(t, y)
    }

    fn output_dimension(&self) -> usize {
        self.layout().len()
    }

    fn output(&mut self, t: f64, y: &[f64], row: &mut [f64]) -> Result<(), EvaluationFailure> {
        if let Err(failure) = self.evaluate(t, y) {
            return self.singular_row(y, row).ok_or(failure);
        }
        let (n, layout) = (self.parts.system.n(), self.layout());
        let lambda = self.multipliers(t, y);
        let motion = &self.current.motion;
        let (a, further) = motion.group(HIGHER).split_at(n);
        let positions = &y[..layout.positions().end];
        layout.write(row, positions, motion.group(VELOCITIES), a, &lambda);
        let parameters = self.parameter_places();
        let own = further
            .iter()
            .copied()
            .chain(parameters.into_iter().map(|i| y[i]));
        row[layout.own()]
            .iter_mut()
            .zip(own)
            .for_each(|(entry, x)| *entry = x);
        Ok(())
    }

    fn switching(&mut self, index: usize, t: f64, y: &[f64]) -> Result<f64, EvaluationFailure> {
        let mut rates = std::mem::take(&mut self.rates);
        let found = self.derivative(t, y, &mut rates);
        self.rates = rates;
        match found {
            Ok(()) => self.watch.switching(index, t, y, &[], &self.rates),
            Err(_) if self.watch.is_near(index, t, y, &[]) => Ok(0.0),
            Err(failure) => Err(failure),
        }
    }

    fn is_event(&mut self, index: usize, t: f64, y: &[f64]) -> bool {
        if self.evaluate(t, y).is_err() {
            self.zero_between = true;
            return true;
        }
        self.zero_between = self.watch.vanishes(index, t, y, &[]);
        self.watch.is_near(index, t, y, &[])
    }
}

impl WatchedFlow for JetFlow<'_> {
    fn vanishes(&mut self, index: usize, t: f64, y: &[f64]) -> bool {
        self.zero_between || self.evaluate(t, y).is_err() || self.watch.vanishes(index, t, y, &[])
    }

    fn lost_mass(&mut self, at: (f64, Option<f64>), y: &[f64]) -> Option<(usize, f64)> {
        let mut rates = std::mem::take(&mut self.rates);
        let found = self.derivative(at.0, y, &mut rates);
        self.rates = rates;
        found.ok()?;
        self.watch.lost_mass(at, y, &[], &self.rates)
    }

    fn settled(&self) -> f64 {
        self.settled
    }
}
