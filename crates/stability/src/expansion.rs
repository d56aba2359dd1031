//! A motion in its system: the smallest closed system of variables, and the values of expressions and of their derivatives at the motion.

use crate::admissible_values::not_real;
use crate::growth::{flattened, Flat};
use crate::guess::near;
use crate::problem::LinearizationError;
use crate::real_roots::sign_of;
use crate::real_values::Condition;
use crate::reduction::{ClosedSystem, OperatingPoint, Speeds};
use crate::singular::least_part;
use crate::steady::{at_point, closed, completed, controls, echelon, solution, State, SOMEWHERE};
use chetaev_mechanics::characteristics::Direction;
use chetaev_mechanics::constraint::ConstraintKind;
use chetaev_mechanics::prover::assumptions;
use chetaev_mechanics::system::Assumption;
use chetaev_mechanics::{MotionTerms, Selection, SteadyMotion, System};
use chetaev_symbolic::number::ball::Precision;
use chetaev_symbolic::simplify::{simplify, Options};
use chetaev_symbolic::zero::{decide_zero, ZeroTest};
use chetaev_symbolic::{rational, Expr, Graph, Node, Symbol, Verdict};
use nalgebra::DMatrix;
use std::cmp::Ordering;

/// What is linearized about what.
pub struct Expansion<'a> {
    /// The system.
    pub system: &'a System,
    pub(crate) terms: &'a MotionTerms,
    pub(crate) selection: &'a Selection,
    /// The smallest closed system of variables.
    pub own: ClosedSystem,
    /// The motion.
    pub motion: &'a SteadyMotion,
    /// The motion with what was found in the place of guesses.
    pub found: SteadyMotion,
    state: State,
    /// Values of the parameters that are put in.
    pub(crate) values: Vec<(Expr, Expr)>,
}

impl<'a> Expansion<'a> {
    /// The expansion about `motion` in suitable speeds. `values` are the values of parameters that are put in, others stay as they are.
    ///
    /// # Errors
    /// [`LinearizationError`].
    pub fn new(
        system: &'a System,
        terms: &'a MotionTerms,
        selection: &'a Selection,
        motion: &'a SteadyMotion,
        values: &[(Expr, Expr)],
    ) -> Result<Expansion<'a>, LinearizationError> {
        Expansion::in_speeds(system, terms, selection, motion, (values, Speeds::Suitable))
    }

    /// The same in speeds of choice.
    ///
    /// # Errors
    /// [`LinearizationError`].
    pub fn in_speeds(
        system: &'a System,
        terms: &'a MotionTerms,
        selection: &'a Selection,
        motion: &'a SteadyMotion,
        (values, speeds): (&[(Expr, Expr)], Speeds),
    ) -> Result<Expansion<'a>, LinearizationError> {
        let g = &system.graph;
        if let Some(divisor) = zero_divisor(system, values) {
            return Err(LinearizationError::NotDefined {
                divisor: g.text(divisor),
            });
        }
        let found = near(system, terms, selection, (motion, values))?;
        let stated = found.positions.iter().chain(&found.velocities);
        let stated: Vec<Expr> = stated.flatten().copied().collect();
        let stated = g.substitute_all(&stated, values);
        if let Some(value) = not_real(g, &stated) {
            return Err(LinearizationError::NotReal {
                motion: motion.name.clone(),
                value: g.text(value),
            });
        }
        let state = completed(&found, system, terms, &selection.rows, values)?;
        let numbers = point(system, &state, values);
        let rows = selection.rows.iter();
        let gradients: Vec<Expr> = rows.flat_map(|&row| terms.jacobian[row].clone()).collect();
        let is_first_order = terms.order == 1;
        if is_first_order && is_singular(system, &gradients, &[&state.values, values], &numbers) {
            return Err(LinearizationError::Singular {
                motion: motion.name.clone(),
            });
        }
        let operating = OperatingPoint {
            numbers: &numbers,
            open: &state.without_position,
        };
        let about = Expansion {
            system,
            terms,
            selection,
            own: ClosedSystem::about(system, terms, selection, (speeds, operating))?,
            motion,
            found: found.into_owned(),
            state,
            values: values.to_vec(),
        };
        about.check_autonomous()?;
        about.check_positions()?;
        about.check_assumed()?;
        about.check_smooth()?;
        about.check_constraints()?;
        about.check_steady()?;
        Ok(about)
    }

    pub(crate) fn graph(&self) -> &Graph {
        &self.system.graph
    }

    /// Expressions at the motion.
    pub(crate) fn at(&self, es: &[Expr]) -> Vec<Expr> {
        at_point(
            self.graph(),
            es,
            &[
                &self.speeds_at(),
                &self.state.values,
                &self.controls(es),
                &self.values,
            ],
        )
    }

    /// The quasi-velocities by their definitions.
    fn speeds_at(&self) -> Vec<(Expr, Expr)> {
        let speeds = self.own.characteristics.parameters.iter();
        let other = speeds.filter(|p| p.value != p.definition);
        other.map(|p| (p.value, p.definition)).collect()
    }

    /// Controls by their laws, and zero where a model states none.
    pub(crate) fn controls(&self, es: &[Expr]) -> Vec<(Expr, Expr)> {
        controls(self.system, es)
    }

    /// Whether the mass matrix is regular at some state, with what has no value put somewhere: as angles are coordinates but at places.
    pub(crate) fn has_regular_mass_somewhere(&self) -> bool {
        let (g, mass) = (self.graph(), &self.own.equations.mass);
        let stated = self.system.parameter_values();
        let entries = g.substitute_all(&mass.concat(), &self.values);
        let entries = g.substitute_all(&entries, &stated);
        let values = g.evaluate_f64(&entries, &|_| Some(SOMEWHERE));
        let values = values.unwrap_or_default();
        let is_known = !values.is_empty() && values.iter().all(|x| x.is_finite());
        is_known && least_part(&DMatrix::from_row_slice(mass.len(), mass.len(), &values)) > CLOSE
    }

    fn check_autonomous(&self) -> Result<(), LinearizationError> {
        let g = self.graph();
        let entries = [self.own.equations.entries(), self.own.rates.clone()].concat();
        let entries = g.substitute_all(&entries, &self.controls(&entries));
        if g.any_contains_any(&entries, &[g.intern_symbol("t", 0)]) {
            Err(LinearizationError::NotAutonomous)
        } else {
            Ok(())
        }
    }

    fn check_positions(&self) -> Result<(), LinearizationError> {
        let missing = &self.state.without_position;
        match self.own.coordinates.iter().find(|j| missing.contains(j)) {
            None => Ok(()),
            Some(&j) => Err(LinearizationError::PositionMissing {
                motion: self.motion.name.clone(),
                coordinate: self.system.coordinates[j].name.clone(),
            }),
        }
    }

    /// What is assumed of coordinates and velocities holds along the motion, or is not known not to.
    fn check_assumed(&self) -> Result<(), LinearizationError> {
        let (g, system) = (self.graph(), self.system);
        let of_state = [system.coordinate_symbols(), system.velocity_symbols()].concat();
        let assumed = system.assumptions.iter();
        let assumed = assumed.filter(|own| g.any_contains_any(&[own.left, own.right], &of_state));
        let fails = |own: &&Assumption| {
            let value = closed(g, self.at(&[g.sub(own.left, own.right)])[0]);
            let sign = sign_of(g, value).filter(|_| g.symbols_in(&[value]).is_empty());
            let condition = Condition {
                function: value,
                relation: own.relation,
            };
            sign.is_some_and(|sign| !condition.holds(sign))
        };
        match assumed.clone().find(fails) {
            None => Ok(()),
            Some(own) => Err(LinearizationError::NotAssumed {
                motion: self.motion.name.clone(),
                assumption: own.text.clone(),
                enclosure: enclosure(g, self.at(&[g.sub(own.left, own.right)])[0]),
            }),
        }
    }

    /// Linear equations are those of functions that have derivatives.
    fn check_smooth(&self) -> Result<(), LinearizationError> {
        let g = self.graph();
        let system = self.system;
        let mut stated = [self.own.equations.entries(), self.own.rates.clone()].concat();
        stated.extend(self.terms.constraints.iter().copied());
        stated.extend(system.constraints.iter().map(|own| own.stated));
        let stated = g.substitute_all(&stated, &self.controls(&stated));
        match self.flat(&stated, 1).corner {
            None => Ok(()),
            Some(corner) => Err(LinearizationError::NotSmooth {
                motion: self.motion.name.clone(),
                corner: g.text(corner),
            }),
        }
    }

    /// Functions without what is smaller beside the motion than the terms of their expansion to an order.
    pub(crate) fn flat(&self, es: &[Expr], order: i64) -> Flat {
        flattened(self.graph(), es, order, &|e| self.vanishes(e))
    }

    /// Whether the equations have a corner at the motion, though they have linear ones.
    pub(crate) fn has_corner(&self) -> bool {
        let equations = &self.own.equations;
        let all = [self.own.rates.clone(), equations.entries()].concat();
        let all = self.graph().substitute_all(&all, &self.controls(&all));
        self.flat(&all, 1).had_corner
    }

    /// Whether a function vanishes at the motion; `None` where that is not known. What depends on parameters vanishes where it does for all.
    pub(crate) fn vanishes(&self, e: Expr) -> Option<bool> {
        let g = self.graph();
        let value = closed(g, self.at(&[e])[0]);
        if g.is_zero(value) || !g.symbols_in(&[value]).is_empty() {
            return Some(g.is_zero(value));
        }
        sign_of(g, value).map(|sign| sign == Ordering::Equal)
    }

    fn check_constraints(&self) -> Result<(), LinearizationError> {
        let g = self.graph();
        // One finite constraint lets a coordinate follow whose position is not given; several tie the others by it.
        let finite = self.system.constraints.iter();
        let finite = finite.filter(|own| own.kind == ConstraintKind::Holonomic);
        let finite: Vec<Expr> = finite.map(|own| own.stated).collect();
        for &j in &self.state.without_position {
            let coordinate = &self.system.coordinates[j];
            let holding = finite
                .iter()
                .filter(|&&e| g.contains_any(e, &[coordinate.q_symbol]));
            if holding.count() > 1 {
                return Err(LinearizationError::PositionMissing {
                    motion: self.motion.name.clone(),
                    coordinate: coordinate.name.clone(),
                });
            }
        }
        // Constraints that follow from others hold with them, but where only the derivative of a finite one is among these.
        for row in 0..self.terms.constraints.len() {
            let constraint = &self.system.constraints[self.terms.constraint_index[row]];
            let of_positions = match constraint.kind {
                ConstraintKind::Holonomic => Some(constraint.stated),
                _ => None,
            };
            let residuals = [Some(self.terms.constraints[row]), of_positions];
            let residuals: Vec<Expr> = residuals.into_iter().flatten().collect();
            // A position that is not given is that of an ignorable coordinate, and nothing is said of it.
            let known = |e: &Expr| {
                let free = &self.state.without_position;
                let mut free = free.iter().map(|&j| self.system.coordinates[j].q_symbol);
                free.all(|s| !g.contains_any(*e, &[s]))
            };
            let values = self.at(&residuals);
            if let Some(&residual) = values.iter().filter(|e| known(e)).find(|&&e| !g.is_zero(e)) {
                return Err(LinearizationError::NotAdmissible {
                    motion: self.motion.name.clone(),
                    constraint: constraint.name.clone(),
                    residual: g.text(residual),
                    enclosure: enclosure(g, residual),
                });
            }
        }
        Ok(())
    }

    fn check_steady(&self) -> Result<(), LinearizationError> {
        let g = self.graph();
        let of_coordinates = self
            .own
            .coordinates
            .iter()
            .map(|&j| &self.system.coordinates[j].name);
        let of_speeds = self.own.characteristics.parameters.iter().map(|p| &p.name);
        let force = self.at(&self.own.equations.force);
        let speeds = if force.iter().all(|&e| g.is_zero(e)) {
            force
        } else {
            // What the speeds change by is the force divided by the mass, where that is regular.
            let mass = self.at_rows(&self.own.equations.mass);
            let solved = solution(g, (&mass, force.len()), &force);
            solved.map_or(force, |own| own.values)
        };
        let rates = self.at(&self.own.rates).into_iter().chain(speeds);
        let mut moving = of_coordinates
            .chain(of_speeds)
            .zip(rates)
            .filter(|(_, rate)| !is_proved_zero(self.system, *rate));
        match moving.next() {
            None => Ok(()),
            // A number that is zero, and is not seen to be.
            Some((name, rate))
                if enclosure(g, rate).is_none() && g.symbols_in(&[rate]).is_empty() =>
            {
                Err(LinearizationError::Open {
                    motion: self.motion.name.clone(),
                    quantity: name.clone(),
                    rate: g.text(rate),
                })
            }
            Some((name, rate)) => Err(LinearizationError::NotSteady {
                motion: self.motion.name.clone(),
                quantity: name.clone(),
                rate: g.text(rate),
                enclosure: enclosure(g, rate),
            }),
        }
    }

    /// The coordinates that run uniformly, on which nothing depends, with their rates: these contain no coordinate that moves. None where constraints
    /// stay implicit, so that rates are not known as functions.
    pub fn running(&self) -> Vec<(String, Expr)> {
        let (g, c) = (self.graph(), &self.own.characteristics);
        if !c.manifold.implicit.is_empty() {
            return Vec::new();
        }
        let coordinates = &self.system.coordinates;
        let rate = |j: usize| {
            (
                j,
                simplify(g, self.at(&[c.velocities[j]])[0], &Options::default()),
            )
        };
        let ignorable = self.own.ignorable(self.system).into_iter();
        let moving: Vec<(usize, Expr)> = ignorable
            .map(rate)
            .filter(|(_, rate)| !g.is_zero(*rate))
            .collect();
        let symbols = moving.iter().map(|&(j, _)| coordinates[j].q_symbol);
        let symbols: Vec<Symbol> = symbols.collect();
        let uniform = moving
            .iter()
            .filter(|(j, _)| !g.contains_any(c.velocities[*j], &symbols));
        uniform
            .map(|&(j, rate)| (coordinates[j].name.clone(), rate))
            .collect()
    }

    /// Positions that are known, and all velocities, by name: their values at the motion.
    pub fn values_of_motion(&self) -> Vec<(String, Expr)> {
        let g = self.graph();
        let all = self.state.values.iter();
        all.map(|&(symbol, value)| (g.text(symbol), self.at(&[value])[0]))
            .collect()
    }

    /// The direction along a coordinate.
    pub(crate) fn unit(&self, j: usize) -> Direction {
        let g = self.graph();
        let zero = g.zero();
        let mut coordinates = vec![zero; self.system.n()];
        coordinates[j] = g.one();
        Direction {
            time: zero,
            coordinates,
            parameters: vec![zero; self.own.characteristics.k()],
        }
    }

    /// The derivatives of the rates and of b by the coordinates that are not ignorable and by P, at the motion.
    pub(crate) fn slopes(&self) -> Vec<Vec<Expr>> {
        let c = &self.own.characteristics;
        let g = self.graph();
        let rates = [self.own.rates.clone(), self.own.equations.force.clone()].concat();
        let rates = self.flat(&rates, 1).functions;
        let rates = g.substitute_all(&rates, &self.values);
        if c.manifold.implicit.is_empty() {
            return self.at_rows(&g.jacobian(&rates, &self.variables()));
        }
        let by_coordinates = self
            .own
            .coordinates
            .iter()
            .map(|&j| c.along(self.system, &rates, &self.unit(j)));
        let columns: Vec<Vec<Expr>> = by_coordinates.collect();
        let by_speeds = c.by_parameters(self.system, &rates);
        let rows = by_speeds.iter().enumerate().map(|(row, own)| {
            let of_coordinates = columns.iter().map(|column| column[row]);
            of_coordinates.chain(own.iter().copied()).collect()
        });
        self.at_rows(&rows.collect::<Vec<_>>())
    }

    /// The entries of a matrix at the motion, all in one pass: they share most of what they are made of.
    pub(crate) fn at_rows(&self, rows: &[Vec<Expr>]) -> Vec<Vec<Expr>> {
        let mut values = self.at(&rows.concat()).into_iter();
        let row = |row: &Vec<Expr>| values.by_ref().take(row.len()).collect();
        rows.iter().map(row).collect()
    }

    /// The variables: the coordinates that are not ignorable, then the quasi-velocities.
    pub(crate) fn variables(&self) -> Vec<Symbol> {
        let coordinates = self.own.coordinates.iter();
        let coordinates = coordinates.map(|&j| self.system.coordinates[j].q_symbol);
        let speeds = self.own.characteristics.parameters.iter();
        coordinates.chain(speeds.map(|p| p.symbol)).collect()
    }

    /// The name of the variable at a place.
    pub(crate) fn name_of(&self, place: usize, symbol: Symbol) -> String {
        let speed = place.checked_sub(self.own.coordinates.len());
        match speed.and_then(|at| self.own.characteristics.parameters.get(at)) {
            Some(speed) => speed.name.clone(),
            None => self.graph().symbol_text(symbol),
        }
    }

    /// The finite constraints without ignorable coordinates. One that contains an ignorable coordinate only says where that is.
    pub(crate) fn finite(&self) -> Vec<Expr> {
        let g = self.graph();
        let coordinates = &self.system.coordinates;
        let ignorable = self.own.ignorable(self.system);
        let ignorable: Vec<Symbol> = ignorable.iter().map(|&j| coordinates[j].q_symbol).collect();
        let rows = self.selection.rows.iter();
        let constraints =
            rows.map(|&row| &self.system.constraints[self.terms.constraint_index[row]]);
        let finite = constraints.filter(|c| c.kind == ConstraintKind::Holonomic);
        let finite = finite.map(|c| c.stated);
        finite.filter(|&e| !g.contains_any(e, &ignorable)).collect()
    }
}

/// Values of the symbols of a state in numbers, for choices that only make results better or worse conditioned.
fn point(system: &System, state: &State, values: &[(Expr, Expr)]) -> Vec<(Symbol, f64)> {
    let g = &system.graph;
    let stated = system.parameter_values();
    let number = |e: Expr| {
        let e = g.substitute_all(&[g.substitute(e, values)], &stated)[0];
        g.evaluate_f64(&[e], &|_| None).ok().map(|found| found[0])
    };
    let known = state.values.iter().chain(values).chain(&stated);
    let known = known.filter_map(|&(symbol, value)| Some((g.as_symbol(symbol)?, number(value)?)));
    known.collect()
}

/// Whether gradients of constraints, one row of n entries after the other, depend on each other where these values are put in: singular values say
/// where that may be, and exact elimination whether it is.
fn is_singular(
    system: &System,
    gradients: &[Expr],
    values: &[&[(Expr, Expr)]],
    numbers: &[(Symbol, f64)],
) -> bool {
    let (g, n) = (&system.graph, system.n());
    let known = |s: Symbol| numbers.iter().find(|(own, _)| *own == s).map(|own| own.1);
    let entries = g.evaluate_f64(gradients, &|s| known(s).or(Some(SOMEWHERE)));
    let entries = entries.unwrap_or_default();
    if entries.is_empty() || !entries.iter().all(|x| x.is_finite()) {
        return false;
    }
    let count = gradients.len() / n;
    if least_part(&DMatrix::from_row_slice(count, n, &entries)) > CLOSE {
        return false;
    }
    let exact = at_point(g, gradients, values);
    let mut exact: Vec<Vec<Expr>> = exact.chunks(n).map(<[Expr]>::to_vec).collect();
    echelon(g, &mut exact, n).columns.len() < count
}

/// A singular value below this part of the largest may be zero.
const CLOSE: f64 = 1e-9;

/// Whether an expression is proved to vanish, by its form or by the exact test for zero.
fn is_proved_zero(system: &System, e: Expr) -> bool {
    let g = &system.graph;
    if g.is_zero(e) || enclosure(g, e).is_some() {
        return g.is_zero(e);
    }
    let assumptions = assumptions(system);
    let es = [e];
    let test = ZeroTest::everywhere(&es, &assumptions);
    matches!(decide_zero(g, &test), Verdict::Proved(_))
}

/// Bounds of a number, with 20 digits.
fn enclosure(g: &Graph, e: Expr) -> Option<(String, String)> {
    let ball = g
        .enclose(&[e], &Precision::new(128), &|_| None)
        .ok()?
        .pop()?;
    ball.excludes_zero().then(|| ball.to_decimal_interval(20))
}

/// What the model divides by and is zero for these values of the parameters, whatever the motion.
fn zero_divisor(system: &System, values: &[(Expr, Expr)]) -> Option<Expr> {
    let g = &system.graph;
    let mut stated = vec![system.lagrangian];
    stated.extend(&system.forces);
    stated.extend(system.constraints.iter().map(|own| own.stated));
    let divisor = |e: Expr| match g.node(e) {
        Node::Power { base, exponent } => {
            let is_below = g.as_number(*exponent).is_some_and(rational::is_negative);
            is_below.then_some(*base)
        }
        _ => None,
    };
    let mut divisors = g.reachable(&stated).into_iter().filter_map(divisor);
    divisors.find(|&base| g.is_zero(closed(g, g.substitute(base, values))))
}
