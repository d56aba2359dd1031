//! The motion by the equations of a formulation: its own first-order system, derived and compiled; where its variables
//! belong to a chart of independent velocities, another chart is derived and compiled when the present one degrades.
//!
//! State (q, variables), where masses with a law of their own stand behind the coordinates. Relations between the variables (constraints that stay implicit, momenta that are no closed
//! functions of velocities) are brought back to zero after each step.

use crate::accelerations::Accelerations;
use crate::chart::{self, Chart, BLIND, DEGRADED, HYSTERESIS};
use crate::crossing::{self, State, Track};
use crate::dense::Lu;
use crate::follow::{Deviation, Follow};
use crate::functions::{Functions, FunctionsError};
use crate::initial::ConsistentState;
use crate::leaving::Anchor;
use crate::numeric::{Binding, NumericSystem};
use crate::row::RowLayout;
use crate::run::WatchedFlow;
use crate::scales::{power, Scales};
use crate::series::RateSeries;
use crate::sticking::{self, Place, Sides, Sticking, STUCK};
use crate::turns::Turns;
use crate::watch::Watch;
use chetaev_integrate::{ChartChange, Control, EvaluationFailure, HaltReason, System as Flow};
use chetaev_mechanics::card::Relation;
use chetaev_mechanics::formulations::DeriveError;
use chetaev_mechanics::{Basis, Equations, Formulation, MotionTerms, Selection, System};
use chetaev_symbolic::{Expr, Symbol};

/// Why the equations of a formulation cannot be integrated.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FlowError {
    /// The equations cannot be derived.
    #[error(transparent)]
    Derive(#[from] DeriveError),
    /// The equations cannot be compiled.
    #[error(transparent)]
    Functions(#[from] FunctionsError),
    /// The state has variables that coordinates and velocities do not determine.
    #[error("the state of `{formulation}` has data of its own: give {names} in [initial]")]
    MissingData {
        /// The formulation.
        formulation: &'static str,
        /// The variables without a value, in quotes.
        names: String,
    },
    /// A state of the start cannot be expressed in the variables of the formulation.
    #[error("at the initial state the variables of `{formulation}` have no finite value")]
    Start {
        /// The formulation.
        formulation: &'static str,
    },
    /// The equations do not determine the motion at the start.
    #[error("`{formulation}` cannot begin at the initial state: {matrix}, is singular there, so that the equations do not determine the motion; choose other initial data, {names} among them")]
    IrregularStart {
        /// The formulation.
        formulation: &'static str,
        /// What is singular.
        matrix: &'static str,
        /// The variables that are data of their own, in quotes.
        names: String,
    },
    /// The variables of the formulation do not give the velocities of the start back.
    #[error("the variables of `{formulation}` are singular at the initial state: they give {coordinate}' = {found:.6e} where it is {stated:.6e}; choose another formulation, other quasi-velocities or another initial state")]
    SingularStart {
        /// The formulation.
        formulation: &'static str,
        /// The coordinate whose velocity differs most.
        coordinate: String,
        /// Its velocity from the variables.
        found: f64,
        /// Its velocity at the start.
        stated: f64,
    },
}

/// The equations in one chart, compiled.
#[derive(Clone, Debug)]
struct ChartFunctions {
    selection: Selection,
    /// (t, q, variables) → velocities, accelerations, rates, multipliers by row, rates of masses.
    motion: Functions,
    /// (t, q, v) → variables; zero for those of its own.
    definitions: Functions,
    /// (t, q, variables) → relations, and their gradient by the variables they determine.
    relations: Option<Functions>,
    /// Places of those variables.
    determined: Vec<usize>,
    /// (t, q, variables) → a matrix that must be nonsingular.
    regular: Option<Functions>,
    pivot: f64,
    /// t and the state, and the rates of the state.
    state: Vec<Symbol>,
    rates: Vec<Expr>,
    /// Angles of which whole turns may be left out of the rates.
    turns: Turns,
    /// Taylor recurrences of the rates; made when first asked for.
    series: Option<RateSeries>,
}

/// A formulation as a first-order system.
pub struct FormulationFlow<'a> {
    formulation: &'static dyn Formulation,
    system: &'a System,
    terms: &'a MotionTerms,
    binding: &'a Binding,
    numeric: NumericSystem,
    current: ChartFunctions,
    charts: Vec<ChartFunctions>,
    /// Names of the variables.
    variables: Vec<String>,
    /// Values at the start of the variables that are data of their own, by place.
    own: Vec<(usize, f64)>,
    /// Places of the variables that are no velocities.
    apart: Vec<usize>,
    /// The reactions, where the formulation has no multipliers but is of the same motion.
    reactions: Option<(Accelerations, Chart)>,
    is_chart: bool,
    chart_number: u32,
    /// The chart's rows and velocities, with its pivot at the last accepted state.
    chart: Chart,
    q: Vec<f64>,
    v: Vec<f64>,
    anchor: Anchor,
    /// What makes the equations singular when it vanishes; functions of the whole state where the equations have a matrix of
    /// their own that must be nonsingular, else of (q, v).
    pub(crate) watch: Watch,
    /// That matrix, in words.
    matrix: Option<&'static str>,
    /// Whether the last minimum of a watched quantity was zero between two steps.
    zero_between: bool,
    /// Quantities followed at accepted steps.
    pub follow: Option<Follow>,
    /// Follows the rank of the constraints, where it may fall.
    track: Option<Box<Track>>,
    /// Where it seems to fall.
    falls: Option<f64>,
    /// What was measured before the last step.
    before: Vec<Deviation>,
}

impl std::fmt::Debug for FormulationFlow<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "FormulationFlow({})", self.formulation.card().name)
    }
}

/// Velocities that differ by more than this part of the largest are not the same.
const SAME: f64 = 1e-6;

impl<'a> FormulationFlow<'a> {
    /// The flow from a consistent state, in the chart of the start. `own` gives data that coordinates and velocities do not
    /// determine, by name.
    ///
    /// # Errors
    /// [`FlowError`].
    pub fn new(
        formulation: &'static dyn Formulation,
        (system, terms, binding): (&'a System, &'a MotionTerms, &'a Binding),
        numeric: NumericSystem,
        start: &ConsistentState,
        own: &[(String, f64)],
    ) -> Result<FormulationFlow<'a>, FlowError> {
        let selection = Selection {
            rows: start.chart.rows.clone(),
            dependent: start.chart.dependent.clone(),
        };
        let (equations, current) = compile(
            formulation,
            (system, terms, binding),
            selection,
            start.chart.pivot,
        )?;
        let mut flow = FormulationFlow {
            follow: None,
            track: None,
            falls: None,
            before: Vec::new(),
            watch: watch((system, terms, binding), &equations, start.chart.rank())?,
            matrix: equations.regular.as_ref().map(|regular| regular.name),
            zero_between: false,
            anchor: Anchor::default(),
            own: own_data(&equations, own)?,
            apart: (0..equations.variables.len())
                .filter(|&i| {
                    let symbol = equations.variables[i].symbol;
                    !system.coordinates.iter().any(|c| c.v_symbol == symbol)
                })
                .collect(),
            reactions: needs_reactions(formulation, &equations, &numeric)
                .then(|| (Accelerations::default(), start.chart.clone())),
            variables: equations.variables.iter().map(|x| x.name.clone()).collect(),
            is_chart: equations.is_chart,
            q: start.q.clone(),
            v: start.v.clone(),
            chart_number: 0,
            chart: start.chart.clone(),
            charts: Vec::new(),
            formulation,
            system,
            terms,
            binding,
            numeric,
            current,
        };
        flow.settle(start.t);
        Ok(flow)
    }

    /// Follows the rank of the constraints, which is that of the start at almost all states.
    pub(crate) fn follow_rank(&mut self) {
        let track = Track::new(self.numeric.clone(), self.chart.rank());
        self.track = self.own.is_empty().then(|| Box::new(track));
    }

    /// Where the rank of the constraints seems to fall, before the state last evaluated or soon after it.
    fn rank_falls(&mut self, t: f64) -> Option<f64> {
        let a = self.current.motion.group(1);
        let at = (t, &self.q[..], &self.v[..], a);
        self.track.as_mut()?.record(at)
    }

    /// Layout of the rows.
    pub fn layout(&self) -> RowLayout {
        RowLayout::new(self.numeric.n, self.numeric.r)
            .with_masses(self.numeric.masses.len())
            .with_own(self.apart.len())
    }

    /// Names of the variables at the end of a row.
    pub fn own_names(&self) -> Vec<String> {
        self.apart
            .iter()
            .map(|&i| self.variables[i].clone())
            .collect()
    }

    /// Names of the variables of the state beside the coordinates.
    pub fn variables(&self) -> &[String] {
        &self.variables
    }

    /// The state vector of (q, v) at time t.
    ///
    /// # Errors
    /// When a variable has no finite value.
    pub fn pack(&mut self, t: f64, q: &[f64], v: &[f64]) -> Result<Vec<f64>, EvaluationFailure> {
        self.current.definitions.evaluate(t, &[q, v])?;
        let mut y = q.to_vec();
        y.extend_from_slice(self.current.definitions.group(0));
        for &(place, value) in &self.own {
            y[q.len() + place] = value;
        }
        Ok(y)
    }

    /// Natural sizes of the components of the state: those of its variables with all velocities of their natural sizes.
    pub(crate) fn scales(&mut self, start: &ConsistentState, scales: &Scales) -> Vec<f64> {
        let mut all = scales.positions.clone();
        let own = match self.pack(start.t, &start.q, &scales.velocities) {
            Ok(y) => y[start.q.len()..].to_vec(),
            Err(_) => return Vec::new(),
        };
        all.extend(own.into_iter().map(|value| power(value.abs())));
        all
    }

    /// The state vector of the start, from which the velocities of the start must come back.
    ///
    /// # Errors
    /// [`FlowError::Start`] and [`FlowError::SingularStart`].
    pub fn start(&mut self, start: &ConsistentState) -> Result<Vec<f64>, FlowError> {
        let formulation = self.formulation.card().name;
        let y = self
            .pack(start.t, &start.q, &start.v)
            .map_err(|_| FlowError::Start { formulation })?;
        if let Some(matrix) = self.matrix.filter(|_| !self.is_regular(start.t, &y)) {
            let own = self.own.iter().map(|&(place, _)| &self.variables[place]);
            return Err(FlowError::IrregularStart {
                formulation,
                matrix,
                names: chetaev_mechanics::words::quoted(own),
            });
        }
        // What cannot be evaluated here stops the run at its first step, with its reason.
        if self.evaluate(start.t, &y).is_err() {
            return Ok(y);
        }
        let scale = start.v.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
        let gap = |i: usize| (self.v[i] - start.v[i]).abs();
        let worst = (0..self.numeric.n).max_by(|&i, &j| gap(i).total_cmp(&gap(j)));
        match worst.filter(|&i| gap(i) > SAME * scale) {
            None => Ok(y),
            Some(i) => Err(FlowError::SingularStart {
                formulation,
                coordinate: self.numeric.coordinates[i].clone(),
                found: self.v[i],
                stated: start.v[i],
            }),
        }
    }

    /// The matrix of the equations in words, where it is one of their own.
    pub fn matrix(&self) -> Option<&'static str> {
        self.matrix
    }

    /// Whether the matrix that must be nonsingular is so to rounding.
    fn is_regular(&mut self, t: f64, y: &[f64]) -> bool {
        let (positions, rest) = y.split_at(self.numeric.positions());
        let Some(matrix) = &mut self.current.regular else {
            return true;
        };
        if matrix.evaluate(t, &[positions, rest]).is_err() {
            return true;
        }
        let entries = matrix.group(0);
        let size = (0..=entries.len())
            .find(|k| k * k >= entries.len())
            .unwrap_or(0);
        Lu::default().factor(size, entries).is_ok()
    }

    /// The state as the watch takes it: in two pieces with the rates of all its variables, or (q, v, a).
    fn pieces<'y>(&'y self, y: &'y [f64]) -> (&'y [f64], &'y [f64], Vec<f64>) {
        if self.matrix.is_none() {
            return (&self.q, &self.v, self.current.motion.group(1).to_vec());
        }
        let (positions, rest) = y.split_at(self.numeric.positions());
        let motion = &self.current.motion;
        let rates = [motion.group(0), motion.group(4), motion.group(2)].concat();
        (positions, rest, rates)
    }

    fn evaluate(&mut self, t: f64, y: &[f64]) -> Result<(), EvaluationFailure> {
        let (positions, rest) = y.split_at(self.numeric.positions());
        self.current.motion.evaluate(t, &[positions, rest])?;
        self.q.copy_from_slice(positions);
        self.v.copy_from_slice(self.current.motion.group(0));
        Ok(())
    }

    /// Chooses a chart at (t, q, v) and enters it when it is better than `worst` by the hysteresis.
    fn rechoose(&mut self, t: f64, y: &mut [f64], factor: f64) -> Control {
        if !self.is_chart || self.numeric.r == 0 {
            return Control::Continue;
        }
        let (q, v) = (self.q.clone(), self.v.clone());
        if self.numeric.evaluate(t, &q, &v).is_err() {
            return Control::Continue;
        }
        let before = self.quality();
        self.chart.pivot = before;
        let (numeric, diagonal) = (&self.numeric, self.numeric.mass_diagonal());
        if factor > 1.0 && before >= DEGRADED * self.current.pivot {
            return Control::Continue;
        }
        let next = chart::choose(
            numeric.jacobian(),
            (numeric.r, numeric.n),
            &diagonal,
            chart::Floor::Along(self.current.pivot),
        );
        if next.rank() < self.chart.rank() {
            let constraint = (0..numeric.r)
                .find(|row| !next.rows.contains(row))
                .unwrap_or(0);
            return Control::Stop(HaltReason::RankDrop {
                from: self.chart.rank(),
                to: next.rank(),
                constraint,
            });
        }
        if next.pivot < factor * before || next.dependent == self.chart.dependent {
            return Control::Continue;
        }
        self.enter(t, y, next, before)
    }

    fn enter(&mut self, t: f64, y: &mut [f64], next: Chart, before: f64) -> Control {
        let selection = Selection {
            rows: next.rows.clone(),
            dependent: next.dependent.clone(),
        };
        let known = self.charts.iter().position(|c| c.selection == selection);
        let entered = match known {
            Some(index) => Ok(self.charts.swap_remove(index)),
            None => {
                let of = (self.system, self.terms, self.binding);
                compile(self.formulation, of, selection, next.pivot).map(|(_, compiled)| compiled)
            }
        };
        let Ok(mut entered) = entered else {
            return Control::Continue;
        };
        entered.pivot = next.pivot;
        let left = std::mem::replace(&mut self.current, entered);
        self.charts.push(left);
        let (q, v) = (self.q.clone(), self.v.clone());
        let packed = self.pack(t, &q, &v);
        // Where other dependent velocities stay implicit, the state has another size: the former chart goes on.
        let fits = |packed: &Vec<f64>| packed.len() == y.len();
        let Some(packed) = packed.ok().filter(fits) else {
            if let Some(former) = self.charts.pop() {
                let unfit = std::mem::replace(&mut self.current, former);
                self.charts.push(unfit);
            }
            return Control::Continue;
        };
        y.copy_from_slice(&packed);
        self.chart_number += 1;
        let pivot_after = next.pivot;
        self.chart = next;
        Control::ChartSwitched(ChartChange {
            from: self.chart_number - 1,
            to: self.chart_number,
            pivot_before: before,
            pivot_after,
        })
    }

    /// The smallest pivot of the present chart at the state last evaluated.
    fn quality(&self) -> f64 {
        let (numeric, n) = (&self.numeric, self.numeric.n);
        let weight = |i: usize| numeric.mass()[i * n + i];
        chart::quality(&self.chart, numeric.jacobian(), n, weight)
    }

    /// Whether the variables still give all velocities, at the state last evaluated, about as well as where the step began.
    fn sees_all(&mut self, t: f64) -> Result<(), EvaluationFailure> {
        let numeric = &mut self.numeric;
        if !self.is_chart || numeric.r == 0 || numeric.evaluate(t, &self.q, &self.v).is_err() {
            return Ok(());
        }
        let ratio = self.quality() / self.chart.pivot;
        // Where inertias grow or vanish the chart is not to blame.
        let numeric = &self.numeric;
        let geometric = || chart::quality(&self.chart, numeric.jacobian(), numeric.n, |_| 1.0);
        match ratio < BLIND && geometric() < BLIND {
            true => Err(EvaluationFailure::PivotDegraded { ratio }),
            false => Ok(()),
        }
    }

    /// Takes the present (q, v) for a state of the motion, from which constraints with jumps do not jump.
    fn settle(&mut self, t: f64) {
        if !self.numeric.jumps || self.numeric.evaluate(t, &self.q, &self.v).is_err() {
            return;
        }
        let _ = self.numeric.evaluate_positions(t, &self.q, &self.v);
        self.anchor.settle(&self.numeric, t, &self.q, &self.v);
    }

    /// The row of a constraint that lies apart from the last accepted state.
    fn left(&mut self, t: f64) -> Option<usize> {
        let by_construction = self.is_chart && self.current.relations.is_none();
        let apart = if !by_construction {
            self.numeric.evaluate(t, &self.q, &self.v).ok()?;
            self.anchor.left(&self.numeric, &self.v)
        } else {
            let selection = &self.current.selection;
            self.anchor
                .left_velocity(&self.v, &selection.dependent)
                .map(|index| selection.rows[index])
        };
        if apart.is_some() || self.numeric.holonomic.is_empty() {
            return apart;
        }
        self.numeric.evaluate_positions(t, &self.q, &self.v).ok()?;
        self.anchor.left_position(&self.numeric, &self.q)
    }

    /// Newton on the variables that relations determine; true when y changed.
    fn project(&mut self, t: f64, y: &mut [f64]) -> bool {
        let n = self.numeric.positions();
        let Some(relations) = &mut self.current.relations else {
            return false;
        };
        let places = &self.current.determined;
        let mut changed = false;
        for _ in 0..10 {
            if relations.evaluate(t, &[&y[..n], &y[n..]]).is_err() {
                return changed;
            }
            let scale: f64 = y[n..].iter().fold(1e-300, |m, x| m.max(x.abs()));
            let mut step = relations.group(0).to_vec();
            if step.iter().all(|f| f.abs() <= 8.0 * f64::EPSILON * scale) {
                break;
            }
            let mut lu = Lu::default();
            if lu.factor(places.len(), relations.group(1)).is_err() {
                return changed;
            }
            lu.solve(&mut step);
            for (&place, dx) in places.iter().zip(&step) {
                y[n + place] -= dx;
            }
            changed = true;
        }
        changed
    }
}

/// Whether the multipliers must be computed beside the formulation: it has none, and its motion is that of the system.
fn needs_reactions(
    formulation: &dyn Formulation,
    equations: &Equations,
    numeric: &NumericSystem,
) -> bool {
    numeric.r > 0
        && equations.multipliers.is_empty()
        && formulation.card().relation == Relation::Equivalent
}

fn watch(
    (system, terms, binding): (&System, &MotionTerms, &Binding),
    equations: &Equations,
    rank: usize,
) -> Result<Watch, FunctionsError> {
    match &equations.regular {
        Some(regular) if regular.rows.len() <= LARGEST_DETERMINANT => {
            let variables = state(system, equations);
            Watch::with_determinant((system, terms), binding, &variables, regular)
        }
        _ => Watch::new(system, terms, binding, rank),
    }
}

/// Determinants of larger matrices are not followed along a run: by cofactors they are too many.
const LARGEST_DETERMINANT: usize = 8;

/// t, q, masses with a law of their own and the variables of the formulation.
fn state(system: &System, equations: &Equations) -> Vec<Symbol> {
    let mut variables: Vec<Symbol> = vec![system.graph.intern_symbol("t", 0)];
    variables.extend(system.coordinate_symbols());
    variables.extend(system.masses.iter().map(|m| m.symbol));
    variables.extend(equations.variables.iter().map(|x| x.symbol));
    variables
}

/// Values of the variables without a definition, by place.
fn own_data(
    equations: &Equations,
    given: &[(String, f64)],
) -> Result<Vec<(usize, f64)>, FlowError> {
    let mut found = Vec::new();
    let mut missing = Vec::new();
    for (place, variable) in equations.variables.iter().enumerate() {
        if variable.definition.is_some() {
            continue;
        }
        match given.iter().find(|(name, _)| *name == variable.name) {
            Some((_, value)) => found.push((place, *value)),
            None => missing.push(&variable.name),
        }
    }
    match missing.is_empty() {
        true => Ok(found),
        false => Err(FlowError::MissingData {
            formulation: equations.formulation,
            names: chetaev_mechanics::words::quoted(missing),
        }),
    }
}

fn compile(
    formulation: &dyn Formulation,
    (system, terms, binding): (&System, &MotionTerms, &Binding),
    selection: Selection,
    pivot: f64,
) -> Result<(Equations, ChartFunctions), FlowError> {
    let basis = Basis {
        system,
        terms,
        selection: &selection,
        characteristics: None,
    };
    let equations = formulation.equations(&basis)?;
    let g = &system.graph;
    let variables = state(system, &equations);
    let groups = [
        ("velocities", equations.velocities.clone()),
        ("accelerations", equations.accelerations.clone()),
        ("rates", equations.rates()),
        ("multipliers", multipliers(&equations, terms, g.zero())),
        (
            "masses",
            equations.masses.iter().map(|(_, rate)| *rate).collect(),
        ),
    ];
    let definitions: Vec<Expr> = equations
        .variables
        .iter()
        .map(|x| x.definition.unwrap_or(g.zero()))
        .collect();
    let definitions = [("variables", definitions)];
    let (residuals, determined): (Vec<Expr>, Vec<Symbol>) =
        equations.relations.iter().copied().unzip();
    let gradient = g.jacobian(&residuals, &determined).concat();
    let is_tied = !residuals.is_empty();
    let relations = [("residuals", residuals), ("gradient", gradient)];
    let place = |symbol: &Symbol| equations.variables.iter().position(|x| x.symbol == *symbol);
    let compiled = ChartFunctions {
        motion: Functions::new(g, binding, &variables, &groups)?,
        definitions: Functions::new(g, binding, &binding.variables, &definitions)?,
        relations: is_tied
            .then(|| Functions::new(g, binding, &variables, &relations))
            .transpose()?,
        determined: determined.iter().filter_map(place).collect(),
        regular: equations
            .regular
            .as_ref()
            .map(|regular| {
                let groups = [("matrix", regular.rows.concat())];
                Functions::new(g, binding, &variables, &groups)
            })
            .transpose()?,
        selection,
        pivot,
        turns: Turns::of(g, &system.coordinate_symbols(), &rates_of_state(&equations)),
        rates: rates_of_state(&equations),
        state: variables,
        series: None,
    };
    Ok((equations, compiled))
}

/// The rates of coordinates, masses with a law of their own, and variables.
pub(crate) fn rates_of_state(equations: &Equations) -> Vec<Expr> {
    let mut rates = equations.velocities.clone();
    rates.extend(equations.masses.iter().map(|(_, rate)| *rate));
    rates.extend(equations.rates());
    rates
}

/// Multipliers by row of the terms; zero where the formulation has none.
fn multipliers(equations: &Equations, terms: &MotionTerms, zero: Expr) -> Vec<Expr> {
    let of = |l: &usize| equations.multipliers.iter().find(|(own, _)| own == l);
    let rows = terms.constraint_index.iter();
    rows.map(|l| of(l).map_or(zero, |(_, value)| *value))
        .collect()
}

impl Sides for FormulationFlow<'_> {
    fn state(&mut self, t: f64, y: &[f64]) -> Option<Place<'_>> {
        self.evaluate(t, y).ok()?;
        Some((&self.q, &self.v, self.current.motion.group(1)))
    }

    fn looks(&mut self) -> &mut Option<Sticking> {
        &mut self.watch.sticking
    }
}

impl Flow for FormulationFlow<'_> {
    fn dimension(&self) -> usize {
        self.numeric.positions() + self.variables.len()
    }

    fn derivative(&mut self, t: f64, y: &[f64], dy: &mut [f64]) -> Result<(), EvaluationFailure> {
        self.evaluate(t, y)?;
        self.sees_all(t)?;
        if self.numeric.jumps {
            if let Some(constraint) = self.left(t) {
                return Err(EvaluationFailure::LeftConstraint { constraint });
            }
        }
        let n = self.numeric.n;
        let (positions, rest) = dy.split_at_mut(self.numeric.positions());
        positions[..n].copy_from_slice(&self.v);
        positions[n..].copy_from_slice(self.current.motion.group(4));
        rest.copy_from_slice(self.current.motion.group(2));
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
        let turns = &self.current.turns;
        let reduced = turns.center(self.numeric.jumps, (y, carry), coefficients);
        if self.numeric.jumps || self.is_chart && self.numeric.r > 0 {
            // Whether a constraint was left, and whether the chart can be used here, is seen on the way.
            self.derivative(t, &reduced, &mut coefficients[n..2 * n])?;
        }
        let (g, binding, current) = (&self.system.graph, self.binding, &mut self.current);
        if current.series.is_none() {
            let series = RateSeries::new(g, binding, &current.state, &current.rates);
            current.series = series.ok();
        }
        match &mut current.series {
            Some(series) => {
                series.expand(t, &reduced, order, coefficients)?;
                coefficients[..n].copy_from_slice(y);
                Ok(())
            }
            None => Err(EvaluationFailure::NoSeries),
        }
    }

    fn accepted(&mut self, t: f64, y: &mut [f64]) -> Control {
        if self.evaluate(t, y).is_err() {
            return Control::Continue;
        }
        if let (Some(_), Some(follow)) = (&self.track, &self.follow) {
            self.before = follow.deviations.clone();
        }
        let modified = self.project(t, y) && self.evaluate(t, y).is_ok();
        let control = match self.rechoose(t, y, HYSTERESIS) {
            Control::Continue if modified => Control::StateModified,
            other => other,
        };
        if let Some(follow) = &mut self.follow {
            follow.record(t, &self.q, &self.v);
        }
        let (q, v, _) = self.pieces(y);
        let (q, v) = (q.to_vec(), v.to_vec());
        self.watch.record(t, &q, &v);
        self.settle(t);
        if sticking::sticks(self, (t, y), &control) {
            return Control::Stop(HaltReason::Custom(STUCK));
        }
        let vanished = self.watch.vanished();
        if self.track.is_some() && vanished.is_none() && !matches!(control, Control::Stop(_)) {
            let _ = self.evaluate(t, y);
            self.falls = self.rank_falls(t);
            if self.falls.is_some() {
                return Control::Stop(HaltReason::Custom(crossing::MET));
            }
        }
        match vanished {
            Some(index) => Control::Stop(HaltReason::Custom(index as u32)),
            None => control,
        }
    }

    fn repivot(&mut self, t: f64, y: &mut [f64]) -> Control {
        if self.evaluate(t, y).is_err() {
            return Control::Continue;
        }
        self.rechoose(t, y, 1.0)
    }

    fn output_dimension(&self) -> usize {
        self.layout().len()
    }

    fn output(&mut self, t: f64, y: &[f64], row: &mut [f64]) -> Result<(), EvaluationFailure> {
        self.evaluate(t, y)?;
        let layout = self.layout();
        let motion = &self.current.motion;
        layout.write(row, &self.q, &self.v, motion.group(1), motion.group(3));
        for (value, &place) in row[layout.own()].iter_mut().zip(&self.apart) {
            *value = y[self.numeric.positions() + place];
        }
        if let Some((accelerations, reference)) = &mut self.reactions {
            let system = &mut self.numeric;
            system.evaluate(t, &self.q, &self.v)?;
            *reference = chart::choose(
                system.jacobian(),
                (system.r, system.n),
                &system.mass_diagonal(),
                chart::Floor::Along(reference.pivot),
            );
            // Where the reactions have no value the row says so.
            match accelerations.solve(system, reference) {
                Ok(()) => row[layout.lambda()].copy_from_slice(&accelerations.lambda),
                Err(_) => row[layout.lambda()].fill(f64::NAN),
            }
        }
        Ok(())
    }

    fn switching(&mut self, index: usize, t: f64, y: &[f64]) -> Result<f64, EvaluationFailure> {
        // At the singularity itself there are no accelerations, and the rate of what vanishes there is zero.
        let failure = self.evaluate(t, y).err();
        let (q, v, a) = self.pieces(y);
        let (q, v) = (q.to_vec(), v.to_vec());
        match failure {
            None => self.watch.switching(index, t, &q, &v, &a),
            Some(_) if self.watch.is_near(index, t, &q, &v) => Ok(0.0),
            Some(failure) => Err(failure),
        }
    }

    fn is_event(&mut self, index: usize, t: f64, y: &[f64]) -> bool {
        if self.evaluate(t, y).is_err() {
            self.zero_between = true;
            return true;
        }
        let (q, v, _) = self.pieces(y);
        let (q, v) = (q.to_vec(), v.to_vec());
        self.zero_between = self.watch.vanishes(index, t, &q, &v);
        self.watch.is_near(index, t, &q, &v)
    }
}

impl WatchedFlow for FormulationFlow<'_> {
    fn vanishes(&mut self, index: usize, t: f64, y: &[f64]) -> bool {
        if self.zero_between || self.evaluate(t, y).is_err() {
            return true;
        }
        let (q, v, _) = self.pieces(y);
        let (q, v) = (q.to_vec(), v.to_vec());
        self.watch.vanishes(index, t, &q, &v)
    }

    fn lost_mass(&mut self, at: (f64, Option<f64>), y: &[f64]) -> Option<(usize, f64)> {
        self.evaluate(at.0, y).ok()?;
        let (q, v, a) = self.pieces(y);
        let (q, v) = (q.to_vec(), v.to_vec());
        self.watch.lost_mass(at, &q, &v, &a)
    }

    fn sticking(&mut self) -> Option<&mut Sticking> {
        self.watch.sticking.as_mut()
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
        let before = std::mem::take(&mut self.before);
        if let Some(follow) = self.follow.as_mut().filter(|_| !before.is_empty()) {
            follow.deviations = before;
        }
    }

    fn enter(&mut self, state: &State) -> Option<Vec<f64>> {
        self.q.copy_from_slice(&state.q);
        self.v.copy_from_slice(&state.v);
        let mut y = self.pack(state.t, &state.q, &state.v).ok()?;
        self.chart.pivot = self.current.pivot;
        // A better chart, where there is one: it changes the vector.
        let _ = self.rechoose(state.t, &mut y, 1.0);
        self.evaluate(state.t, &y).ok()?;
        if let Some(follow) = &mut self.follow {
            follow.record(state.t, &self.q, &self.v);
        }
        self.settle(state.t);
        if let Some(track) = &mut self.track {
            track.leave();
        }
        self.rank_falls(state.t);
        Some(y)
    }

    fn row_of(&mut self, state: &State, a: &[f64], lambda: &[f64]) -> Option<Vec<f64>> {
        let y = self.pack(state.t, &state.q, &state.v).ok()?;
        let layout = self.layout();
        let mut row = vec![0.0; layout.len()];
        layout.write(&mut row, &state.q, &state.v, a, lambda);
        for (value, &place) in row[layout.own()].iter_mut().zip(&self.apart) {
            *value = y[state.q.len() + place];
        }
        Some(row)
    }
}
