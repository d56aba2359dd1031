//! The initial state of a motion as a function of parameters and of what is given.
//!
//! What is given is a function of parameters, and the rest follows: it fulfils the constraints and is, among all that do, nearest in the kinetic
//! metric to what is given and guessed (T5 §5.10). With `s` that point, M the metric and φ the constraints, the state x and the multipliers λ obey
//! `M (x − s) + φ_xᵀ λ = 0`, `φ = 0`: the derivatives of x contain the curvature of the constraints, by λ. With these equations as
//! `R(u, p) = 0`, `R_u u_a = −R_a`, and `R_u u_ab` is minus the second derivative of R without u_ab.

use crate::error::OrbitError;
use crate::flow::{plain, Flow};
use crate::subspace::Equilibrated;
use crate::variational::{derivatives, Extended, Symbols, Variational};
use chetaev_mechanics::{ConstraintKind, MotionTerms, Selection, System};
use chetaev_symbolic::{Expr, Graph, Symbol};
use nalgebra::{DMatrix, DVector};

/// Where a motion begins.
#[derive(Clone, Debug)]
pub struct Beginning {
    /// The time.
    pub t: f64,
    /// Coordinates and velocities with their values.
    pub point: Vec<(Symbol, f64)>,
    /// Those that are given, as functions of the parameters.
    pub given: Vec<(Symbol, Expr)>,
    /// Those from which a search begins, as functions of the parameters; what is neither given nor guessed is zero there.
    pub guessed: Vec<(Symbol, Expr)>,
    /// Whether what is given may be moved by the constraints.
    pub project: bool,
}

/// The equations of the initial state.
pub(crate) struct Start<'a> {
    pub(crate) system: &'a System,
    pub(crate) flow: &'a Flow,
    pub(crate) terms: &'a MotionTerms,
    pub(crate) selection: &'a Selection,
    pub(crate) beginning: &'a Beginning,
}

/// Singular values below this part of the largest are none.
const UNDETERMINED: f64 = 1e-9;
/// A state is nearest, and equations that vary have a solution, within this part of their terms.
const FULFILLED: f64 = 1e-6;

/// Positions or velocities: what is moved, and by which constraints.
struct Block {
    unknowns: Vec<Symbol>,
    constraints: Vec<Expr>,
    /// Symbols of the multipliers, one for each constraint where the state is the nearest one.
    multipliers: Vec<Symbol>,
    /// Those of the unknowns that may be moved.
    movable: Vec<Symbol>,
    /// M at the point `s`, for the movable unknowns.
    metric: Vec<Vec<Expr>>,
}

impl Start<'_> {
    /// What a variable is given or guessed to be.
    fn aim(&self, s: Symbol) -> Expr {
        let both = self.beginning.given.iter().chain(&self.beginning.guessed);
        let mut own = both.filter(|(own, _)| *own == s);
        own.next().map_or(self.system.graph.zero(), |own| own.1)
    }

    fn is_given(&self, s: Symbol) -> bool {
        self.beginning.given.iter().any(|own| own.0 == s)
    }

    fn numbers(&self) -> Numbers<'_> {
        Numbers {
            g: &self.system.graph,
            known: [self.beginning.point.clone(), self.flow.parameters.clone()].concat(),
            t: (self.flow.time(), self.beginning.t),
        }
    }

    fn positions(&self) -> Block {
        let system = self.system;
        let rows = self.selection.rows.iter();
        let stated = rows.map(|&row| &system.constraints[self.terms.constraint_index[row]]);
        let finite = stated.filter(|own| own.kind == ConstraintKind::Holonomic);
        let constraints: Vec<Expr> = finite.map(|own| own.stated).collect();
        let both = [system.coordinate_symbols(), system.velocity_symbols()].concat();
        self.block("position", system.coordinate_symbols(), &constraints, &both)
    }

    fn velocities(&self) -> Block {
        let rows = self.selection.rows.iter();
        let constraints: Vec<Expr> = rows.map(|&row| self.terms.constraints[row]).collect();
        let unknowns = self.system.velocity_symbols();
        self.block("velocity", unknowns.clone(), &constraints, &unknowns)
    }

    /// The metric is taken where those of `at` are what they are aimed at.
    fn block(
        &self,
        name: &str,
        unknowns: Vec<Symbol>,
        constraints: &[Expr],
        at: &[Symbol],
    ) -> Block {
        let g = &self.system.graph;
        let constraints = plain(self.system, constraints);
        let moves_data = self.beginning.project && unknowns.iter().any(|&s| self.is_given(s));
        let free = |s: &&Symbol| self.beginning.project || !self.is_given(**s);
        let gradient = g.jacobian(&constraints, &unknowns).concat();
        let is_affine = !g.any_contains_any(&gradient, &unknowns);
        let is_nearest = !constraints.is_empty() && (moves_data || is_affine);
        // Where a search among curved constraints ends is no function of where it begins: there constraints have to determine the state.
        let movable: Vec<Symbol> = if is_nearest {
            unknowns.iter().filter(free).copied().collect()
        } else {
            Vec::new()
        };
        let rows = 0..if is_nearest { constraints.len() } else { 0 };
        let multiplier = |row| g.intern_symbol(&format!("multiplier of {name} {row}"), 0);
        let mut block = Block {
            multipliers: rows.map(multiplier).collect(),
            constraints,
            unknowns,
            movable,
            metric: Vec::new(),
        };
        block.metric = self.metric(&block, at);
        block
    }

    /// The symmetric part of M for the movable unknowns, or the identity where that has no positive value.
    fn metric(&self, block: &Block, at: &[Symbol]) -> Vec<Vec<Expr>> {
        let (g, terms) = (&self.system.graph, self.terms);
        let place = |s: &Symbol| block.unknowns.iter().position(|own| own == s);
        let places: Vec<usize> = block.movable.iter().filter_map(place).collect();
        let aims: Vec<(Expr, Expr)> = at
            .iter()
            .map(|&s| (g.symbol_expr(s), self.aim(s)))
            .collect();
        let half = g.pow(g.integer(2), g.integer(-1));
        let mass = |i: usize, k: usize| terms.mass_matrix[i][k];
        let entry = |i: usize, k: usize| {
            if mass(i, k) == mass(k, i) {
                mass(i, k)
            } else {
                g.mul(&[half, g.add(&[mass(i, k), mass(k, i)])])
            }
        };
        let entries: Vec<Expr> = places
            .iter()
            .flat_map(|&i| places.iter().map(move |&k| (i, k)))
            .map(|(i, k)| entry(i, k))
            .collect();
        let entries = g.substitute_all(&plain(self.system, &entries), &aims);
        let n = places.len();
        let values = self.numbers().values(&entries);
        let is_positive = values.is_ok_and(|own| DMatrix::from_vec(n, n, own).cholesky().is_some());
        let identity = |i: usize, k: usize| if i == k { g.one() } else { g.zero() };
        (0..n)
            .map(|i| {
                let of = |k: usize| {
                    if is_positive {
                        entries[i * n + k]
                    } else {
                        identity(i, k)
                    }
                };
                (0..n).map(of).collect()
            })
            .collect()
    }

    /// Whether no constraint contains an unknown, and no step in the kinetic metric towards the constraints moves it.
    fn is_apart(&self, block: &Block, s: Symbol) -> bool {
        let g = &self.system.graph;
        let is_contained = |s: Symbol| g.any_contains_any(&block.constraints, &[s]);
        let place = |s: Symbol| block.unknowns.iter().position(|own| *own == s);
        let is_coupled = |other: &Symbol| match (place(s), place(*other)) {
            (Some(i), Some(k)) => !g.is_zero(self.terms.mass_matrix[i][k]),
            _ => false,
        };
        let unknowns = block.unknowns.iter();
        let mut searched = unknowns.filter(|own| !self.is_given(**own) && is_contained(**own));
        !is_contained(s) && !searched.any(is_coupled)
    }

    /// Those of the unknowns that are what they are aimed at.
    fn fixed(&self, block: &Block) -> Vec<Symbol> {
        let stays = |s: &&Symbol| {
            !block.movable.contains(s) && (self.is_given(**s) || self.is_apart(block, **s))
        };
        block.unknowns.iter().filter(stays).copied().collect()
    }

    /// R of a block: that the state is nearest, and the constraints.
    fn equations(&self, block: &Block) -> Vec<Expr> {
        let g = &self.system.graph;
        let away = |s: Symbol| g.sub(g.symbol_expr(s), self.aim(s));
        let gradient = g.jacobian(&block.constraints, &block.movable);
        let nearest = block.metric.iter().enumerate().map(|(i, row)| {
            let masses = row.iter().zip(&block.movable);
            let masses = masses.map(|(&m, &s)| g.mul(&[m, away(s)]));
            let forces = block.multipliers.iter().zip(&gradient);
            let forces = forces.map(|(&m, row)| g.mul(&[g.symbol_expr(m), row[i]]));
            g.add(&masses.chain(forces).collect::<Vec<_>>())
        });
        let constraints = block.constraints.iter().copied();
        plain(self.system, &nearest.chain(constraints).collect::<Vec<_>>())
    }

    /// The multipliers at the start.
    fn set_multipliers(&self, block: &Block, numbers: &mut Numbers) -> Result<(), OrbitError> {
        let g = &self.system.graph;
        if block.multipliers.is_empty() {
            return Ok(());
        }
        let aims: Vec<Expr> = block.movable.iter().map(|&s| self.aim(s)).collect();
        let aims = numbers.values(&aims)?;
        let here: Vec<Expr> = block.movable.iter().map(|&s| g.symbol_expr(s)).collect();
        let here = numbers.values(&here)?;
        let n = here.len();
        let metric = DMatrix::from_vec(n, n, numbers.values(&block.metric.concat())?);
        let away = DVector::from_iterator(n, here.iter().zip(&aims).map(|(x, s)| x - s));
        let gradient = g.jacobian(&block.constraints, &block.movable).concat();
        let gradient = numbers.values(&plain(self.system, &gradient))?;
        let across = DMatrix::from_vec(n, block.multipliers.len(), gradient);
        let force = -&metric * away;
        let root = |i: usize| metric[(i, i)].sqrt();
        let across = DMatrix::from_fn(n, across.ncols(), |i, k| across[(i, k)] / root(i));
        let force = DVector::from_fn(n, |i, _| force[i] / root(i));
        let balanced = Equilibrated::new(&across).ok_or(OrbitError::NoEigenvalues)?;
        let found = balanced.solve(&force, UNDETERMINED);
        let rest = across * &found - force;
        let size = (0..n).map(|i| root(i) * here[i].abs().max(aims[i].abs()));
        let size = size.fold(0.0, f64::max);
        let is_nearest = rest.iter().all(|rest| rest.abs() <= FULFILLED * size);
        if !is_nearest {
            return Err(self.not_determined(&block.movable));
        }
        numbers.set(&block.multipliers, found.as_slice());
        Ok(())
    }

    fn not_determined(&self, symbols: &[Symbol]) -> OrbitError {
        let g = &self.system.graph;
        let names = symbols.iter().map(|&s| g.symbol_text(s));
        let names = names.collect::<Vec<_>>().join(", ");
        OrbitError::NotDetermined { names }
    }

    /// The matrix of the equations of a block by `unknowns` and multipliers, in units in which the metric has ones on its diagonal.
    fn matrix(
        &self,
        block: &Block,
        unknowns: &[Symbol],
        (equations, numbers): (&[Expr], &Numbers),
    ) -> Result<Equilibrated, OrbitError> {
        let g = &self.system.graph;
        let all = [unknowns, &block.multipliers].concat();
        let values = numbers.values(&g.jacobian(equations, &all).concat())?;
        let matrix = DMatrix::from_row_slice(equations.len(), all.len(), &values);
        if block.multipliers.is_empty() {
            return Equilibrated::new(&matrix).ok_or(OrbitError::NoEigenvalues);
        }
        let n = unknowns.len();
        let masses: Vec<Expr> = (0..n).map(|i| block.metric[i][i]).collect();
        let masses = numbers.values(&masses)?;
        let mut scales: Vec<f64> = masses.iter().map(|m| m.sqrt().recip()).collect();
        for row in n..equations.len() {
            let along = (0..n).map(|i| (matrix[(row, i)] * scales[i]).abs());
            let largest = along.fold(0.0, f64::max);
            scales.push(if largest > 0.0 { largest.recip() } else { 1.0 });
        }
        Equilibrated::scaled(&matrix, scales.clone(), scales).ok_or(OrbitError::NoEigenvalues)
    }

    /// Sets the derivatives of the unknowns of a block; those of its positions come before those of its velocities.
    fn vary(
        &self,
        block: &Block,
        of: (&[Symbol], &Symbols),
        (motion, numbers): (&Variational, &mut Numbers),
    ) -> Result<(), OrbitError> {
        let g = &self.system.graph;
        let fixed = self.fixed(block);
        let unknowns = block.unknowns.iter().filter(|s| !fixed.contains(s));
        let unknowns: Vec<Symbol> = unknowns.copied().collect();
        let equations = self.equations(block);
        self.set_multipliers(block, numbers)?;
        let matrix = self.matrix(block, &unknowns, (&equations, numbers))?;
        let loose = matrix.undetermined(UNDETERMINED).into_iter();
        let loose: Vec<Symbol> = loose.filter_map(|i| unknowns.get(i).copied()).collect();
        if !loose.is_empty() {
            return Err(self.not_determined(&loose));
        }
        let aims: Vec<Expr> = fixed.iter().map(|&s| self.aim(s)).collect();
        let both = (&motion.columns[..], &motion.pairs[..]);
        let of_aims = derivatives(g, &plain(self.system, &aims), of, both);
        let of_equations = derivatives(g, &equations, of, both);
        let solved = [&unknowns[..], &block.multipliers].concat();
        let place = |s: &Symbol| of.0.iter().position(|own| own == s);
        let own = |symbols: &[Symbol], wanted: &[Symbol]| -> Vec<Symbol> {
            let places = wanted.iter().filter_map(place);
            places.map(|i| symbols[i]).collect()
        };
        let first = of.1.first.iter().zip(of_aims.0.iter().zip(&of_equations.0));
        let second =
            of.1.second
                .iter()
                .zip(of_aims.1.iter().zip(&of_equations.1));
        for (symbols, (aims, rows)) in first.chain(second) {
            numbers.set(&own(symbols, &fixed), &numbers.values(aims)?);
            let symbols = own(symbols, &solved);
            // Without the derivative itself, which is a factor of the matrix.
            numbers.set(&symbols, &vec![0.0; symbols.len()]);
            let rest = -DVector::from_vec(numbers.values(rows)?);
            let found = matrix.solve(&rest, UNDETERMINED);
            if !matrix.is_solved(&found, &rest, FULFILLED) {
                return Err(OrbitError::GivenForValuesAlone);
            }
            numbers.set(&symbols, found.as_slice());
        }
        Ok(())
    }

    /// The extended state at the start.
    pub(crate) fn varied(&self, motion: &Variational) -> Result<Extended, OrbitError> {
        let g = &self.system.graph;
        let blocks = [self.positions(), self.velocities()];
        let of_state = blocks.iter().flat_map(|own| &own.unknowns);
        let others = blocks.iter().flat_map(|own| &own.multipliers);
        let unknowns: Vec<Symbol> = of_state.chain(others).copied().collect();
        let count = motion.columns.len();
        let symbols = Symbols::new(g, ("initial", unknowns.len()), count, &motion.pairs);
        let of = (&unknowns[..], &symbols);
        let mut numbers = self.numbers();
        for block in &blocks {
            self.vary(block, of, (motion, &mut numbers))?;
        }
        let both = (&motion.columns[..], &motion.pairs[..]);
        let (first, second) = derivatives(g, &self.flow.definitions, of, both);
        let n = self.flow.n();
        let first = numbers.values(&first.concat())?;
        let second = numbers.values(&second.concat())?;
        Ok(Extended {
            state: self.flow.state(&self.beginning.point)?,
            first: DMatrix::from_column_slice(n, count, &first),
            second: DMatrix::from_column_slice(n, motion.pairs.len(), &second),
        })
    }
}

/// Values of symbols.
struct Numbers<'a> {
    g: &'a Graph,
    known: Vec<(Symbol, f64)>,
    t: (Symbol, f64),
}

impl Numbers<'_> {
    fn set(&mut self, symbols: &[Symbol], values: &[f64]) {
        self.known.retain(|(s, _)| !symbols.contains(s));
        self.known
            .extend(symbols.iter().copied().zip(values.iter().copied()));
    }

    fn values(&self, es: &[Expr]) -> Result<Vec<f64>, OrbitError> {
        let value = |s: Symbol| {
            let mut all = self.known.iter().chain([&self.t]);
            // What is added to initial values is zero.
            all.find(|(own, _)| *own == s)
                .map_or(Some(0.0), |own| Some(own.1))
        };
        let found = self.g.evaluate_f64(es, &value);
        found.map_err(|_| OrbitError::NoValue {
            name: "the initial state".into(),
        })
    }
}
