//! A system with numbers for its parameters: mass matrix, forces and constraints as compiled functions.

use crate::chart::Chart;
use crate::dense::Lu;
use crate::functions::{Functions, FunctionsError};
use crate::reduced::Bordered;
use crate::scales::angles;
use crate::series::{self, RateSeries};
use crate::turns::Turns;
use chetaev_compile::rounding::Rounded;
use chetaev_compile::Program;
use chetaev_integrate::EvaluationFailure;
use chetaev_mechanics::{reduced_equations, ConstraintKind, MotionTerms, System};
use chetaev_symbolic::{Expr, Function, Graph, Node, Symbol};
use std::sync::{Arc, OnceLock};

/// Why a system has no numeric form.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum NumericError {
    /// A parameter without a value.
    #[error("parameter `{0}` has no value; give it one in the model or with `--set {0}=…`")]
    NoValue(String),
    /// A parameter whose value is not a finite number.
    #[error("the value of parameter `{0}` is not a finite number")]
    NotFinite(String),
    /// A control without a law.
    #[error("control `{0}` has no law u(t), so the motion cannot be computed")]
    NoControlLaw(String),
    /// The functions cannot be compiled.
    #[error(transparent)]
    Functions(#[from] FunctionsError),
}

/// `M a - Jᵀ λ = b`, `J a = g`, `f = 0` and the holonomic `φ = 0` as numeric functions of (t, q, v). Wherever positions q are
/// taken, the masses with a law of their own stand behind the coordinates.
#[derive(Clone, Debug)]
pub struct NumericSystem {
    /// Number of coordinates.
    pub n: usize,
    /// Number of constraint rows, redundant ones included.
    pub r: usize,
    /// Names of the coordinates.
    pub coordinates: Vec<String>,
    /// Names of the masses with a law of their own.
    pub masses: Vec<String>,
    /// Whether the mass matrix is symmetric, as it is unless a mass contains velocities.
    pub is_symmetric: bool,
    /// Names of the constraints, by row.
    pub constraints: Vec<String>,
    /// Rows that are affine in the velocities.
    pub affine: Vec<bool>,
    /// Rows of the holonomic constraints.
    pub holonomic: Vec<usize>,
    /// Which velocities occur in the constraints.
    pub constrained_velocities: Vec<bool>,
    /// Which coordinates occur in the holonomic constraints.
    pub constrained_positions: Vec<bool>,
    /// Whether the holonomic constraints are linear in the coordinates.
    pub is_flat: bool,
    /// Whether a constraint contains a function with a jump: an angle with its cut, or a sign.
    pub jumps: bool,
    /// Whether constraints of order two and more are left out here, which also determine accelerations.
    pub is_part: bool,
    /// Angles on which the velocity constraints depend.
    pub(crate) directing: Vec<bool>,
    /// Coordinates that stand in the argument of a function without dimension.
    pub(crate) angles: Vec<bool>,
    mass_envelope: Vec<usize>,
    dynamics: Functions,
    kinematics: Functions,
    positions: Functions,
    rates: Functions,
    /// Angles of which whole turns may be left out.
    pub(crate) turns: Turns,
    source: Arc<Source>,
    /// Values of the parameters, where they are others than those of the binding.
    values: Option<Vec<f64>>,
}

/// At which states rates of the motion are wanted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum States {
    /// Those that satisfy the constraints to rounding. Rates by quasi-velocities are the motion's there; next to them they let
    /// a violation grow.
    Admissible,
    /// Any: the rates keep the values of the constraints, whatever they are.
    All,
}

/// The expressions behind the functions, for the Taylor series of the motion.
#[derive(Debug)]
struct Source {
    system: System,
    binding: Binding,
    terms: MotionTerms,
    velocities: Vec<Symbol>,
    mass_rates: Vec<Expr>,
    /// Accelerations by quasi-velocities without singular places, for the constraint rows first asked for.
    regular: OnceLock<(Vec<usize>, Option<Vec<Expr>>)>,
}

impl Source {
    /// The equations for accelerations and multipliers, with these independent rows of J.
    fn bordered(&self, rows: &[usize]) -> Bordered<'_> {
        let terms = &self.terms;
        let jacobian = rows.iter().map(|&row| terms.jacobian[row].clone());
        Bordered {
            g: &self.system.graph,
            mass: terms.mass_matrix.clone(),
            force: terms.force.clone(),
            jacobian: jacobian.collect(),
            rate: rows.iter().map(|&row| terms.constraint_rate[row]).collect(),
        }
    }

    fn accelerations(&self, rows: &[usize]) -> Option<Vec<Expr>> {
        let make = || reduced_equations::accelerations(&self.system, &self.terms, rows);
        let (known, found) = self.regular.get_or_init(|| (rows.to_vec(), make()));
        match known == rows {
            true => found.clone(),
            false => make(),
        }
    }
}

/// Groups of the dynamics program, in order.
const MASS: usize = 0;
const FORCE: usize = 1;
const JACOBIAN: usize = 2;
const RATE: usize = 3;
const RESIDUAL: usize = 4;

/// How symbols become numbers: parameter values, and control laws in the place of controls.
#[derive(Clone, Debug)]
pub struct Binding {
    /// Symbols and values of the parameters.
    pub parameters: Vec<(Symbol, f64)>,
    /// Substitution of controls and their derivatives by their laws, and of what else is a function of time and parameters.
    pub controls: Vec<(Expr, Expr)>,
    /// The variables (t, q, masses with a law of their own, v) in this order.
    pub variables: Vec<Symbol>,
}

impl Binding {
    /// Values of all parameters and laws of all controls of a system.
    ///
    /// # Errors
    /// [`NumericError`] for what has no value.
    pub fn new(system: &System) -> Result<Binding, NumericError> {
        let g = &system.graph;
        let mut parameters = Vec::new();
        for parameter in &system.parameters {
            let name = || parameter.name.clone();
            let value = parameter
                .value
                .ok_or_else(|| NumericError::NoValue(name()))?;
            let number = g
                .evaluate_f64(&[value], &|_| None)
                .map_err(|_| NumericError::NoValue(name()))?[0];
            if !number.is_finite() {
                return Err(NumericError::NotFinite(name()));
            }
            parameters.push((g.intern_symbol(&parameter.name, 0), number));
        }
        Ok(Binding {
            parameters,
            controls: control_laws(system)?,
            variables: variables(g, system),
        })
    }

    /// The same where some parameters follow from others, each with what it is in terms of free ones: they are computed from these, and have no
    /// values of their own.
    pub fn with_following(mut self, g: &Graph, following: &[(Expr, Expr)]) -> Binding {
        let follows = |s: Symbol| following.iter().any(|own| g.as_symbol(own.0) == Some(s));
        self.parameters.retain(|own| !follows(own.0));
        for law in &mut self.controls {
            law.1 = g.substitute(law.1, following);
        }
        self.controls.extend_from_slice(following);
        self
    }
}

fn variables(g: &Graph, system: &System) -> Vec<Symbol> {
    let mut variables = vec![g.intern_symbol("t", 0)];
    variables.extend(system.coordinate_symbols());
    variables.extend(system.masses.iter().map(|m| m.symbol));
    variables.extend(system.velocity_symbols());
    variables
}

/// u, u', u'', … replaced by the law and its derivatives, as far as they occur.
fn control_laws(system: &System) -> Result<Vec<(Expr, Expr)>, NumericError> {
    let g = &system.graph;
    let mut pairs = Vec::new();
    for control in &system.controls {
        let mut law = control
            .law
            .ok_or_else(|| NumericError::NoControlLaw(control.name.clone()))?;
        // Three derivatives: accelerations of constraints that contain u' need u''.
        for order in 0..4 {
            pairs.push((g.symbol(&control.name, order), law));
            law = g.total_derivative(law, &|_| false);
        }
    }
    Ok(pairs)
}

impl NumericSystem {
    /// Compiles the functions of a system. Beside constraints of higher order only those of order one are taken, as conditions on
    /// coordinates and velocities.
    ///
    /// # Errors
    /// [`NumericError`].
    pub fn new(
        system: &System,
        terms: &MotionTerms,
        binding: &Binding,
    ) -> Result<NumericSystem, NumericError> {
        let lower = (terms.order > 1).then(|| MotionTerms::of_order(system, 1));
        let is_part = lower.is_some();
        let terms = lower.unwrap_or_else(|| terms.clone());
        let g = &system.graph;
        let constraint = |row: usize| &system.constraints[terms.constraint_index[row]];
        let r = terms.constraints.len();
        let holonomic: Vec<usize> = (0..r)
            .filter(|&row| constraint(row).kind == ConstraintKind::Holonomic)
            .collect();
        let stated: Vec<Expr> = holonomic
            .iter()
            .map(|&row| constraint(row).stated)
            .collect();
        let gradient = g.jacobian(&stated, &system.coordinate_symbols()).concat();
        let angles = angles(system, &terms);
        let groups = [
            ("mass", terms.mass_matrix.concat()),
            ("force", terms.force.clone()),
            ("jacobian", terms.jacobian.concat()),
            ("rate", terms.constraint_rate.clone()),
            ("residual", terms.constraints.clone()),
        ];
        Ok(NumericSystem {
            n: system.n(),
            r,
            coordinates: system.coordinates.iter().map(|c| c.name.clone()).collect(),
            masses: system.masses.iter().map(|m| m.name.clone()).collect(),
            is_symmetric: chetaev_mechanics::mass::with_velocity(system).is_none(),
            constraints: (0..r).map(|row| constraint(row).name.clone()).collect(),
            affine: (0..r)
                .map(|row| constraint(row).is_affine_in_velocities())
                .collect(),
            holonomic,
            constrained_velocities: occurring(g, &terms.jacobian.concat(), system.n()),
            constrained_positions: occurring(g, &gradient, system.n()),
            is_flat: {
                let present = g.symbols_in(&gradient);
                let mut coordinates = system.coordinate_symbols().into_iter();
                !coordinates.any(|q| present.contains(&q))
            },
            jumps: has_jumps(g, &[terms.constraints.clone(), stated.clone()].concat()),
            is_part,
            directing: {
                let present = g.symbols_in(&terms.constraints);
                let all = system.coordinate_symbols().into_iter().zip(&angles);
                all.map(|(q, is)| *is && present.contains(&q)).collect()
            },
            angles,
            mass_envelope: envelope(g, &terms.mass_matrix),
            dynamics: Functions::new(g, binding, &binding.variables, &groups)?,
            kinematics: Functions::new(g, binding, &binding.variables, &groups[2..5])?,
            positions: Functions::new(
                g,
                binding,
                &binding.variables,
                &[("position", stated), ("gradient", gradient)],
            )?,
            rates: Functions::new(
                g,
                binding,
                &binding.variables,
                &[("rate", system.masses.iter().map(|m| m.rate).collect())],
            )?,
            turns: Turns::of(
                g,
                &system.coordinate_symbols(),
                &moving_parts(system, &terms),
            ),
            source: Arc::new(Source {
                system: system.clone(),
                regular: OnceLock::new(),
                binding: binding.clone(),
                velocities: system.velocity_symbols(),
                mass_rates: system.masses.iter().map(|m| m.rate).collect(),
                terms,
            }),
            values: None,
        })
    }

    /// The rates of (q, masses with a law of their own, v) by their Taylor recurrences.
    ///
    /// # Errors
    /// [`FunctionsError`].
    pub(crate) fn series(
        &self,
        rows: &[usize],
        states: States,
    ) -> Result<RateSeries, FunctionsError> {
        let binding = &self.source.binding;
        let parameters = binding.parameters.iter().map(|own| own.1).collect();
        let mut series = RateSeries::of(&self.rates_over(rows, states)?, parameters)?;
        if let Some(values) = &self.values {
            series.set_parameters(values)?;
        }
        Ok(series)
    }

    /// The program whose outputs are the rates of (q, masses with a law of their own, v) and whose variables are (t, q, masses,
    /// v), with the parameters in the order of the binding; `rows` are independent rows of J. The matrix of its linear
    /// system is factorized once for each expansion (T5 §5.4 (3)).
    ///
    /// # Errors
    /// [`FunctionsError`].
    pub fn rates_program(&self, rows: &[usize]) -> Result<Program, FunctionsError> {
        self.rates_over(rows, States::Admissible)
    }

    /// The same for the states that occur.
    ///
    /// # Errors
    /// [`FunctionsError`].
    pub(crate) fn rates_over(
        &self,
        rows: &[usize],
        states: States,
    ) -> Result<Program, FunctionsError> {
        let Source {
            system,
            binding,
            velocities,
            mass_rates,
            ..
        } = &*self.source;
        let g = &system.graph;
        let bordered = self.source.bordered(rows);
        let program = |accelerations: Vec<Expr>| {
            let velocities = velocities.iter().map(|&v| g.symbol_expr(v));
            let rates: Vec<Expr> = velocities
                .chain(mass_rates.iter().copied())
                .chain(accelerations)
                .collect();
            series::program(g, binding, &binding.variables, &rates)
        };
        let stated = program(bordered.solve()?)?;
        let shortest = match states {
            States::Admissible => self.source.accelerations(rows),
            States::All => None,
        };
        let accelerations = match shortest {
            Some(found) => found,
            None => match bordered.eliminated() {
                Some(Ok(found)) => found,
                _ => return Ok(stated),
            },
        };
        let eliminated = program(accelerations)?;
        Ok(match series::cost(&eliminated)? < series::cost(&stated)? {
            true => eliminated,
            false => stated,
        })
    }

    /// The accelerations, then the multipliers by constraint row, as functions of (t, q, masses, v); `rows` are independent rows of J,
    /// and the multipliers of the others are zero.
    ///
    /// # Errors
    /// [`FunctionsError::Singular`].
    pub(crate) fn reactions(&self, rows: &[usize]) -> Result<Vec<Expr>, FunctionsError> {
        let mut all = self.source.bordered(rows).unknowns()?;
        let own = all.split_off(self.n);
        let zero = self.source.system.graph.zero();
        all.resize(self.n + self.r, zero);
        for (&row, multiplier) in rows.iter().zip(own) {
            all[self.n + row] = multiplier;
        }
        Ok(all)
    }

    /// The accelerations as compiled functions of (t, q, masses, v), by quasi-velocities without singular places; `None` where none
    /// are found.
    pub(crate) fn accelerations(&self, rows: &[usize]) -> Option<Functions> {
        let Source {
            system, binding, ..
        } = &*self.source;
        let groups = [("accelerations", self.source.accelerations(rows)?)];
        let made = Functions::new(&system.graph, binding, &binding.variables, &groups);
        let mut made = made.ok()?;
        if let Some(values) = &self.values {
            made.set_parameters(values).ok()?;
        }
        Some(made)
    }

    /// The system, and the values of its parameters in the order of the binding where others were set.
    pub(crate) fn stated(&self) -> (&System, &Binding, Option<&[f64]>) {
        let Source {
            system, binding, ..
        } = &*self.source;
        (system, binding, self.values.as_deref())
    }

    /// Sets other values of the parameters, in the order of the binding. What was derived and compiled stays.
    ///
    /// # Errors
    /// [`FunctionsError::Prepare`].
    pub fn set_parameters(&mut self, values: &[f64]) -> Result<(), FunctionsError> {
        for functions in [
            &mut self.dynamics,
            &mut self.kinematics,
            &mut self.positions,
            &mut self.rates,
        ] {
            functions.set_parameters(values)?;
        }
        self.values = Some(values.to_vec());
        Ok(())
    }

    /// Whether the equations run as machine code.
    pub fn is_native(&self) -> bool {
        self.dynamics.is_native()
    }

    /// Evaluates everything at (t, q, v); read the results with the accessors.
    ///
    /// # Errors
    /// When a value is not finite.
    pub fn evaluate(&mut self, t: f64, q: &[f64], v: &[f64]) -> Result<(), EvaluationFailure> {
        self.dynamics.evaluate(t, &[q, v])
    }

    /// For affine constraints: the dependent velocities of `chart` from the independent ones, written into `v`.
    ///
    /// # Errors
    /// When a value is not finite or the chart is singular here.
    pub fn complete_velocities(
        &mut self,
        t: f64,
        q: &[f64],
        v: &mut [f64],
        chart: &Chart,
        workspace: &mut Completion,
    ) -> Result<(), EvaluationFailure> {
        for &d in &chart.dependent {
            v[d] = 0.0;
        }
        self.kinematics.evaluate(t, &[q, v])?;
        workspace.complete(
            self.n,
            self.kinematics.group(0),
            self.kinematics.group(2),
            v,
            chart,
        )
    }

    /// Evaluates the holonomic constraints at (t, q).
    ///
    /// # Errors
    /// When a value is not finite.
    pub fn evaluate_positions(
        &mut self,
        t: f64,
        q: &[f64],
        v: &[f64],
    ) -> Result<(), EvaluationFailure> {
        self.positions.evaluate(t, &[q, v])
    }

    /// The length of a vector of positions: coordinates, and masses with a law of their own.
    pub fn positions(&self) -> usize {
        self.n + self.masses.len()
    }

    /// The rates of the positions: v, and those of the masses by their laws.
    ///
    /// # Errors
    /// When a value is not finite.
    pub fn position_rates(
        &mut self,
        t: f64,
        q: &[f64],
        v: &[f64],
        rates: &mut [f64],
    ) -> Result<(), EvaluationFailure> {
        rates[..self.n].copy_from_slice(v);
        if !self.masses.is_empty() {
            self.rates.evaluate(t, &[q, v])?;
            rates[self.n..].copy_from_slice(self.rates.group(0));
        }
        Ok(())
    }

    /// J and f at the state last evaluated, with what rounding leaves open in them; without bounds where there are none.
    pub(crate) fn rounded(&self) -> RoundedConstraints {
        RoundedConstraints::of(&self.dynamics, (JACOBIAN, RESIDUAL))
    }

    /// The same for ∂φ/∂q and φ of the holonomic constraints.
    pub(crate) fn rounded_positions(&self) -> RoundedConstraints {
        RoundedConstraints::of(&self.positions, (1, 0))
    }

    /// M as a metric: its symmetric part.
    pub fn metric(&self) -> Vec<f64> {
        let (n, mass) = (self.n, self.mass());
        if self.is_symmetric {
            return mass.to_vec();
        }
        let entry = |k: usize| (mass[k] + mass[k % n * n + k / n]) / 2.0;
        (0..n * n).map(entry).collect()
    }

    /// M, n × n.
    pub fn mass(&self) -> &[f64] {
        self.dynamics.group(MASS)
    }

    /// For each row of M the first column that is not zero identically, at most the diagonal.
    pub fn mass_envelope(&self) -> &[usize] {
        &self.mass_envelope
    }

    /// b, length n.
    pub fn force(&self) -> &[f64] {
        self.dynamics.group(FORCE)
    }

    /// J, r × n.
    pub fn jacobian(&self) -> &[f64] {
        self.dynamics.group(JACOBIAN)
    }

    /// g, length r.
    pub fn rate(&self) -> &[f64] {
        self.dynamics.group(RATE)
    }

    /// f, length r.
    pub fn residual(&self) -> &[f64] {
        self.dynamics.group(RESIDUAL)
    }

    /// φ, one per holonomic constraint.
    pub fn position_residual(&self) -> &[f64] {
        self.positions.group(0)
    }

    /// ∂φ/∂q, row by row.
    pub fn position_gradient(&self) -> &[f64] {
        self.positions.group(1)
    }

    /// The diagonal of M.
    pub fn mass_diagonal(&self) -> Vec<f64> {
        (0..self.n).map(|i| self.mass()[i * self.n + i]).collect()
    }

    /// Whether all constraints are affine in the velocities.
    pub fn is_affine(&self) -> bool {
        self.affine.iter().all(|&a| a)
    }
}

/// Constraints at a state, with what rounding leaves open in them.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct RoundedConstraints {
    /// Gradients, row by row.
    pub(crate) gradient: Vec<Rounded>,
    /// Residuals.
    pub(crate) residual: Vec<Rounded>,
}

impl RoundedConstraints {
    fn of(functions: &Functions, (gradient, residual): (usize, usize)) -> RoundedConstraints {
        // Without constraints nothing is asked.
        let bounded = if functions.range(residual).is_empty() {
            None
        } else {
            functions.rounded()
        };
        let group = |index: usize| match &bounded {
            Some(all) => all[functions.range(index)].to_vec(),
            None => {
                let values = functions.group(index).iter();
                values.map(|&value| Rounded::nearest(value)).collect()
            }
        };
        RoundedConstraints {
            gradient: group(gradient),
            residual: group(residual),
        }
    }

    /// Whether all residuals vanish to `factor` times what rounding leaves open in them.
    pub(crate) fn are_met(&self, factor: f64) -> bool {
        self.residual.iter().all(|f| f.is_zero(factor))
    }
}

/// Everything on which the motion depends.
fn moving_parts(system: &System, terms: &MotionTerms) -> Vec<Expr> {
    let mut parts = terms.mass_matrix.concat();
    parts.extend(terms.jacobian.concat());
    parts.extend(&terms.force);
    parts.extend(&terms.constraint_rate);
    parts.extend(&terms.constraints);
    parts.extend(system.masses.iter().map(|m| m.rate));
    parts
}

/// The columns of a matrix with rows of length n that do not vanish identically.
fn occurring(g: &Graph, matrix: &[Expr], n: usize) -> Vec<bool> {
    (0..n)
        .map(|i| matrix.iter().skip(i).step_by(n).any(|&e| !g.is_zero(e)))
        .collect()
}

fn has_jumps(g: &Graph, expressions: &[Expr]) -> bool {
    g.reachable(expressions).into_iter().any(|e| {
        matches!(
            g.node(e),
            Node::Apply {
                function: Function::Atan2 | Function::Sign,
                ..
            }
        )
    })
}

fn envelope(g: &Graph, mass_matrix: &[Vec<Expr>]) -> Vec<usize> {
    let first = |(i, row): (usize, &Vec<Expr>)| {
        row.iter().take(i).position(|&e| !g.is_zero(e)).unwrap_or(i)
    };
    mass_matrix.iter().enumerate().map(first).collect()
}

/// Workspace of [`NumericSystem::complete_velocities`].
#[derive(Clone, Debug, Default)]
pub struct Completion {
    lu: Lu,
    block: Vec<f64>,
    column: Vec<f64>,
}

impl Completion {
    fn complete(
        &mut self,
        n: usize,
        jacobian: &[f64],
        residual: &[f64],
        v: &mut [f64],
        chart: &Chart,
    ) -> Result<(), EvaluationFailure> {
        if chart.rows.is_empty() {
            return Ok(());
        }
        self.block.clear();
        self.column.clear();
        for &row in &chart.rows {
            self.block
                .extend(chart.dependent.iter().map(|&d| jacobian[row * n + d]));
            self.column.push(-residual[row]);
        }
        self.lu
            .factor(chart.rows.len(), &self.block)
            .map_err(|pivot| EvaluationFailure::PivotDegraded {
                ratio: pivot.pivot.abs(),
            })?;
        self.lu.solve(&mut self.column);
        for (&d, &value) in chart.dependent.iter().zip(&self.column) {
            v[d] = value;
        }
        Ok(())
    }
}
