//! The linear equations about a steady motion, `E δz' = F δz`, exact in the parameters.
//!
//! With `q' = φ(q, P)` and `M P' = b` a steady motion has φ = 0 for the coordinates that are not ignorable and b = 0, so that
//! `δq' = φ_q δq + φ_P δP` and `M δP' = b_q δq + b_P δP`, M at the motion. Finite constraints h(q) = 0 are kept by these equations, and
//! `h_q δq = 0` takes the dependent coordinates out of them.

use crate::reduction::ClosedSystem;
use crate::steady::{at_point, closed, completed, echelon, State};
use chetaev_mechanics::characteristics::{CharacteristicsError, Direction};
use chetaev_mechanics::constraint::ConstraintKind;
use chetaev_mechanics::prover::assumptions;
use chetaev_mechanics::{MotionTerms, Selection, SteadyMotion, System};
use chetaev_symbolic::number::ball::Precision;
use chetaev_symbolic::zero::{decide_zero, ZeroTest};
use chetaev_symbolic::{Expr, Graph, Symbol, Verdict};

/// Why there is no linearization.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum LinearizationError {
    /// Constraints of higher order.
    #[error("steady motions are defined for constraints on velocities; this system has constraints of order {order}")]
    OrderTooHigh {
        /// m.
        order: u32,
    },
    /// A mass changes.
    #[error("a mass of this system changes along the motion, so that no motion is steady")]
    MassesMove,
    /// The time occurs.
    #[error("the equations contain the time explicitly, so that no motion is steady")]
    NotAutonomous,
    /// No independent velocities.
    #[error(transparent)]
    Characteristics(#[from] CharacteristicsError),
    /// The position of a coordinate on which the equations depend is missing.
    #[error("the motion `{motion}` does not say where `{coordinate}` is, and the equations of motion depend on it")]
    PositionMissing {
        /// The motion.
        motion: String,
        /// The coordinate.
        coordinate: String,
    },
    /// The velocities that are not given cannot be solved for.
    #[error("the constraints do not allow the velocities of the motion `{motion}`")]
    VelocitiesNotDetermined {
        /// The motion.
        motion: String,
    },
    /// A finite constraint does not hold.
    #[error("the motion `{motion}` is not admissible: the constraint `{constraint}` is off by {residual}")]
    NotAdmissible {
        /// The motion.
        motion: String,
        /// The constraint.
        constraint: String,
        /// Left side minus right side.
        residual: String,
        /// Lower and upper bound of it, where it is a number.
        enclosure: Option<(String, String)>,
    },
    /// Something changes that should be constant.
    #[error("the motion `{motion}` is not steady: {quantity} has the rate {rate}")]
    NotSteady {
        /// The motion.
        motion: String,
        /// A coordinate or a quasi-velocity.
        quantity: String,
        /// Its rate (for quasi-velocities the force that changes it).
        rate: String,
        /// Lower and upper bound of it, where it is a number.
        enclosure: Option<(String, String)>,
    },
}

/// A variable of the linear equations.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Variable {
    /// The deviation of a coordinate.
    Coordinate(usize),
    /// The deviation of quasi-velocity σ.
    Speed(usize),
}

/// Linear equations about a steady motion.
#[derive(Clone, Debug)]
pub struct Linearization {
    /// The variables: independent coordinates that are not ignorable, then the quasi-velocities.
    pub variables: Vec<Variable>,
    /// Their names, in the same order.
    pub names: Vec<String>,
    /// The quasi-velocities as functions of the velocities, by name.
    pub speeds: Vec<(String, Expr)>,
    /// E, row by row.
    pub left: Vec<Vec<Expr>>,
    /// F, row by row.
    pub right: Vec<Vec<Expr>>,
    /// Coordinates on which nothing depends.
    pub ignorable: Vec<String>,
    /// Coordinates that finite constraints determine, each with its deviation by the variables.
    pub dependent: Vec<(String, Vec<Expr>)>,
    /// The dimension of the family of steady motions through this one that was proved.
    pub family: usize,
}

/// The linear equations about `motion`. `values` are the values of parameters that are put in, others stay as they are.
///
/// # Errors
/// [`LinearizationError`].
pub fn linearize(
    system: &System,
    terms: &MotionTerms,
    selection: &Selection,
    motion: &SteadyMotion,
    values: &[(Expr, Expr)],
) -> Result<Linearization, LinearizationError> {
    let own = ClosedSystem::new(system, terms, selection)?;
    let state = completed(motion, system, terms, &selection.rows, values)?;
    let about = About {
        system,
        terms,
        selection,
        own,
        motion,
        state,
        values,
    };
    about.check_autonomous()?;
    about.check_positions()?;
    about.check_constraints()?;
    about.check_steady()?;
    Ok(about.linear())
}

/// What is linearized about what.
struct About<'a> {
    system: &'a System,
    terms: &'a MotionTerms,
    selection: &'a Selection,
    own: ClosedSystem,
    motion: &'a SteadyMotion,
    state: State,
    values: &'a [(Expr, Expr)],
}

impl About<'_> {
    fn graph(&self) -> &Graph {
        &self.system.graph
    }

    /// Expressions at the motion.
    fn at(&self, es: &[Expr]) -> Vec<Expr> {
        at_point(
            self.graph(),
            es,
            &[
                &self.speeds_at(),
                &self.state.values,
                &self.controls(es),
                self.values,
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
    fn controls(&self, es: &[Expr]) -> Vec<(Expr, Expr)> {
        let g = self.graph();
        let occurring = g.symbols_in(es);
        let of = |symbol: Symbol| {
            let name = g.symbol_name(symbol);
            let control = self.system.controls.iter().find(|c| c.name == name)?;
            let law = control.law.unwrap_or_else(|| g.zero());
            let rate = |e: Expr| g.total_derivative(e, &|_| false);
            let value = (0..g.symbol_order(symbol)).fold(law, |e, _| rate(e));
            Some((g.symbol_expr(symbol), value))
        };
        occurring.into_iter().filter_map(of).collect()
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

    fn check_constraints(&self) -> Result<(), LinearizationError> {
        let g = self.graph();
        for &row in &self.selection.rows {
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
        let rates = [self.own.rates.clone(), self.own.equations.force.clone()].concat();
        let moving = of_coordinates.chain(of_speeds).zip(self.at(&rates));
        let mut moving = moving.filter(|(_, rate)| !g.is_zero(*rate));
        match moving.next() {
            None => Ok(()),
            Some((name, rate)) => Err(LinearizationError::NotSteady {
                motion: self.motion.name.clone(),
                quantity: name.clone(),
                rate: g.text(rate),
                enclosure: enclosure(g, rate),
            }),
        }
    }

    fn linear(&self) -> Linearization {
        let g = self.graph();
        let (places, k) = (&self.own.coordinates, self.own.characteristics.k());
        let right = self.slopes();
        let mass: Vec<Vec<Expr>> = self
            .own
            .equations
            .mass
            .iter()
            .map(|row| self.at(row))
            .collect();
        let tangent = self.tangent();
        // The coordinates that stay variables, by their place among those that are not ignorable.
        let is_dependent = |at: &usize| tangent.iter().any(|(own, _)| own == at);
        let kept: Vec<usize> = (0..places.len()).filter(|at| !is_dependent(at)).collect();
        let rows = kept.iter().copied().chain(places.len()..places.len() + k);
        let column_of = |row: &[Expr], at: usize| {
            let through = tangent
                .iter()
                .map(|(own, slopes)| g.mul(&[row[*own], slopes[at]]));
            let all: Vec<Expr> = std::iter::once(row[at]).chain(through).collect();
            closed(g, g.add(&all))
        };
        let reduced = |row: &[Expr]| -> Vec<Expr> {
            let of_kept = kept.iter().map(|&at| column_of(row, at));
            of_kept.chain(row[places.len()..].iter().copied()).collect()
        };
        let size = kept.len() + k;
        let mut left = vec![vec![g.zero(); size]; size];
        for (at, row) in left.iter_mut().enumerate() {
            match at.checked_sub(kept.len()) {
                None => row[at] = g.one(),
                Some(s) => row[kept.len()..].copy_from_slice(&mass[s]),
            }
        }
        let name_of = |at: usize| self.system.coordinates[places[at]].name.clone();
        let speeds = &self.own.characteristics.parameters;
        let mut found = Linearization {
            variables: kept
                .iter()
                .map(|&at| Variable::Coordinate(places[at]))
                .chain((0..k).map(Variable::Speed))
                .collect(),
            names: kept
                .iter()
                .map(|&at| name_of(at))
                .chain(speeds.iter().map(|p| p.name.clone()))
                .collect(),
            speeds: speeds
                .iter()
                .map(|p| (p.name.clone(), p.definition))
                .collect(),
            left,
            right: rows.map(|row| reduced(&right[row])).collect(),
            ignorable: self
                .own
                .ignorable(self.system)
                .into_iter()
                .map(|j| self.system.coordinates[j].name.clone())
                .collect(),
            dependent: tangent
                .iter()
                .map(|(own, slopes)| {
                    let of_kept = kept.iter().map(|&at| slopes[at]);
                    (name_of(*own), of_kept.collect())
                })
                .collect(),
            family: 0,
        };
        found.family = self.family(&right);
        found
    }

    /// The derivatives of the rates and of b by the coordinates that are not ignorable and by P, at the motion.
    fn slopes(&self) -> Vec<Vec<Expr>> {
        let g = self.graph();
        let c = &self.own.characteristics;
        let rates = [self.own.rates.clone(), self.own.equations.force.clone()].concat();
        let unit = |j: usize| {
            let zero = g.zero();
            let mut coordinates = vec![zero; self.system.n()];
            coordinates[j] = g.one();
            Direction {
                time: zero,
                coordinates,
                parameters: vec![zero; c.k()],
            }
        };
        let by_coordinates = self
            .own
            .coordinates
            .iter()
            .map(|&j| c.along(self.system, &rates, &unit(j)));
        let columns: Vec<Vec<Expr>> = by_coordinates.map(|column| self.at(&column)).collect();
        let by_speeds: Vec<Vec<Expr>> = c.by_parameters(self.system, &rates);
        let rows = by_speeds.iter().enumerate().map(|(row, own)| {
            let of_coordinates = columns.iter().map(|column| column[row]);
            of_coordinates.chain(self.at(own)).collect()
        });
        rows.collect()
    }

    /// The coordinates that finite constraints determine, by their places among those that are not ignorable, each with the slopes of
    /// its deviation by the others.
    fn tangent(&self) -> Vec<(usize, Vec<Expr>)> {
        let g = self.graph();
        let rows = self.selection.rows.iter();
        let constraints =
            rows.map(|&row| &self.system.constraints[self.terms.constraint_index[row]]);
        let finite = constraints.filter(|c| c.kind == ConstraintKind::Holonomic);
        let ignorable = self.own.ignorable(self.system);
        let order: Vec<usize> = ignorable
            .iter()
            .chain(&self.own.coordinates)
            .copied()
            .collect();
        let mut gradients: Vec<Vec<Expr>> = finite
            .map(|c| {
                let gradient = g.gradient(c.stated, &self.system.coordinate_symbols());
                let gradient = self.at(&gradient);
                order.iter().map(|&j| gradient[j]).collect()
            })
            .collect();
        // Ignorable coordinates are solved for first: what is left restricts the others.
        let solved = echelon(g, &mut gradients, ignorable.len()).len();
        let mut rest: Vec<Vec<Expr>> = gradients[solved..]
            .iter()
            .map(|row| row[ignorable.len()..].to_vec())
            .collect();
        let count = self.own.coordinates.len();
        let preferred = self.dependent_last(&mut rest);
        let pivots = echelon(g, &mut rest, count);
        let place = |at: usize| preferred[at];
        pivots
            .iter()
            .zip(&rest)
            .map(|(&pivot, row)| {
                let mut slopes = vec![g.zero(); count];
                for (at, &e) in row
                    .iter()
                    .enumerate()
                    .filter(|(at, _)| !pivots.contains(at))
                {
                    slopes[place(at)] = g.neg(e);
                }
                (place(pivot), slopes)
            })
            .collect()
    }

    /// Orders the columns so that coordinates with dependent velocities are solved for where they can be; the places of the columns.
    fn dependent_last(&self, rows: &mut [Vec<Expr>]) -> Vec<usize> {
        let is_dependent = |at: &usize| {
            self.selection
                .dependent
                .contains(&self.own.coordinates[*at])
        };
        let mut order: Vec<usize> = (0..self.own.coordinates.len()).collect();
        order.sort_by_key(|at| !is_dependent(at));
        for row in rows {
            *row = order.iter().map(|&at| row[at]).collect();
        }
        order
    }

    /// The dimension of the family of steady motions through this one, where it was proved.
    ///
    /// Equations with independent gradients at the motion are a manifold there (implicit function theorem); where the others vanish
    /// on the solutions of these, that manifold consists of steady motions. Its dimension is the number of variables less these equations.
    fn family(&self, slopes: &[Vec<Expr>]) -> usize {
        let g = self.graph();
        let coordinates = self
            .own
            .coordinates
            .iter()
            .map(|&j| self.system.coordinates[j].q_symbol);
        let speeds = self.own.characteristics.parameters.iter().map(|p| p.symbol);
        let variables: Vec<Symbol> = coordinates.chain(speeds).collect();
        let mut equations: Vec<(Expr, Vec<Expr>)> = self.finite_equations();
        let moving = [self.own.rates.clone(), self.own.equations.force.clone()].concat();
        equations.extend(moving.iter().copied().zip(slopes.iter().cloned()));
        let values = |e: Expr| g.substitute(g.substitute(e, &self.controls(&[e])), self.values);
        let mut equations: Vec<(Expr, Vec<Expr>)> = equations
            .into_iter()
            .map(|(e, row)| (values(e), row))
            .collect();
        equations.sort_by_key(|(e, _)| g.reachable(&[*e]).len());
        let rows: Vec<Vec<Expr>> = equations.iter().map(|(_, row)| row.clone()).collect();
        let pivots = independent_rows(g, &rows);
        let chosen: Vec<(Expr, Symbol)> = pivots
            .iter()
            .map(|&(row, column)| (equations[row].0, variables[column]))
            .collect();
        let is_chosen = |row: &usize| pivots.iter().any(|(own, _)| own == row);
        let others: Vec<Expr> = (0..equations.len())
            .filter(|row| !is_chosen(row))
            .map(|row| equations[row].0)
            .collect();
        let dimension = variables.len() - pivots.len();
        if dimension == 0 || vanish_on(self.system, &others, &chosen) {
            dimension
        } else {
            0
        }
    }

    /// The finite constraints without ignorable coordinates, each with its gradient by the variables at the motion. One that
    /// contains an ignorable coordinate only says where that is.
    fn finite_equations(&self) -> Vec<(Expr, Vec<Expr>)> {
        let g = self.graph();
        let coordinates = &self.system.coordinates;
        let ignorable: Vec<Symbol> = self
            .own
            .ignorable(self.system)
            .iter()
            .map(|&j| coordinates[j].q_symbol)
            .collect();
        let rows = self.selection.rows.iter();
        let constraints =
            rows.map(|&row| &self.system.constraints[self.terms.constraint_index[row]]);
        let finite = constraints.filter(|c| {
            c.kind == ConstraintKind::Holonomic && !g.contains_any(c.stated, &ignorable)
        });
        let symbols: Vec<Symbol> = self
            .own
            .coordinates
            .iter()
            .map(|&j| coordinates[j].q_symbol)
            .collect();
        let gradient = |e: Expr| {
            let of_coordinates = self.at(&g.gradient(e, &symbols));
            let of_speeds = vec![g.zero(); self.own.characteristics.k()];
            [of_coordinates, of_speeds].concat()
        };
        finite.map(|c| (c.stated, gradient(c.stated))).collect()
    }
}

/// The first rows that are independent of those before them, each with a column that it can be solved for.
fn independent_rows(g: &Graph, rows: &[Vec<Expr>]) -> Vec<(usize, usize)> {
    let mut kept: Vec<(usize, usize, Vec<Expr>)> = Vec::new();
    for (place, row) in rows.iter().enumerate() {
        let mut row = row.clone();
        for (_, column, by) in &kept {
            let factor = row[*column];
            if !g.is_zero(factor) {
                let less =
                    |(&own, &by): (&Expr, &Expr)| closed(g, g.sub(own, g.mul(&[factor, by])));
                row = row.iter().zip(by).map(less).collect();
            }
        }
        let nonzero = (0..row.len()).filter(|&c| !g.is_zero(row[c]));
        let cost = |&c: &usize| (g.as_number(row[c]).is_none(), g.reachable(&[row[c]]).len());
        if let Some(column) = nonzero.min_by_key(cost) {
            let pivot = row[column];
            let own = row.iter().map(|&e| closed(g, g.div(e, pivot))).collect();
            kept.push((place, column, own));
        }
    }
    kept.into_iter()
        .map(|(place, column, _)| (place, column))
        .collect()
}

/// Whether expressions are proved to vanish where equations hold, each given with the symbol that it determines.
///
/// An equation that is affine in its symbol with a number as coefficient is solved and put into all others first.
fn vanish_on(system: &System, es: &[Expr], equations: &[(Expr, Symbol)]) -> bool {
    let g = &system.graph;
    let (mut es, mut open) = (es.to_vec(), equations.to_vec());
    let solvable = |(e, symbol): &(Expr, Symbol)| {
        let slope = g.diff(*e, *symbol);
        let is_number = g.as_number(slope).is_some() && !g.is_zero(slope);
        is_number.then(|| {
            let own = g.symbol_expr(*symbol);
            (own, g.sub(own, g.div(*e, slope)))
        })
    };
    while let Some((place, solution)) = open
        .iter()
        .enumerate()
        .find_map(|(place, own)| Some((place, solvable(own)?)))
    {
        open.remove(place);
        let into = |e: Expr| g.substitute(e, &[solution]);
        es = es.into_iter().map(into).collect();
        open = open
            .into_iter()
            .map(|(e, symbol)| (into(e), symbol))
            .collect();
    }
    if es.iter().all(|&e| g.is_zero(e)) {
        return true;
    }
    let assumptions = assumptions(system);
    let test = ZeroTest {
        residuals: &es,
        solved: &[],
        implicit: &open,
        assumptions: &assumptions,
        options: chetaev_symbolic::zero::Options::default(),
    };
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
