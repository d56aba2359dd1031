//! What vanishes along a steady motion, with the unknowns, and what must not vanish so that it says so.

use crate::charts::is_singular_at;
use crate::left_out::vanish_nowhere;
use crate::problem::LinearizationError;
use crate::real_values::corners;
use crate::reduction::{without, ClosedSystem, OperatingPoint, Speeds};
use crate::steady::{at_point, closed, controls};
use crate::steady_value::{fraction, SteadySetError, Value};
use chetaev_mechanics::constraint::ConstraintKind;
use chetaev_mechanics::system::Coordinate;
use chetaev_mechanics::{MotionTerms, Selection, SteadyMotion, System};
use chetaev_symbolic::matrix::determinant;
use chetaev_symbolic::polynomial::normal_form::normal_form;
use chetaev_symbolic::polynomial::Budget;
use chetaev_symbolic::zero::assumptions::Assumptions;
use chetaev_symbolic::zero::known_sign;
use chetaev_symbolic::{Expr, Function, Graph, Node, Symbol};
use std::cmp::Reverse;

/// A number for all symbols, to see whether a function has values.
const SOMEWHERE: f64 = 0.377;

/// More minors of the gradients of the constraints are not looked at.
const MINORS: usize = 200;

/// What is sought.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sought {
    /// Motions along which everything that the equations depend on is constant.
    SteadyMotions,
    /// Those without a velocity.
    Rest,
}

/// What is sought in one chart.
#[derive(Clone, Copy)]
pub(crate) struct Asked<'v> {
    pub(crate) sought: Sought,
    /// Values of parameters.
    pub(crate) values: &'v [(Expr, Expr)],
    /// Values of positions and velocities that are given.
    pub(crate) given: &'v [(Expr, Expr)],
    pub(crate) speeds: Speeds,
}

/// What vanishes along a steady motion.
pub(crate) struct Equations<'a> {
    system: &'a System,
    own: ClosedSystem,
    sought: Sought,
    values: Vec<(Expr, Expr)>,
    given: Vec<(Expr, Expr)>,
    /// Rates of coordinates, forces, finite and implicit constraints.
    pub(crate) vanishing: Vec<Expr>,
    /// The slopes of the velocities by the quasi-velocities: where one has no value these do not serve.
    pub(crate) slopes: Vec<Expr>,
    /// The slopes of constraints that are not affine by the velocities that they determine: where one vanishes they determine none.
    pub(crate) regular: Vec<Expr>,
    /// The unknowns with their names, those that are coordinates first.
    pub(crate) unknowns: Vec<(Symbol, String)>,
    /// The coordinates among them.
    pub(crate) coordinates: Vec<usize>,
}

impl<'a> Equations<'a> {
    pub(crate) fn new(
        system: &'a System,
        terms: &MotionTerms,
        selection: &Selection,
        asked: Asked<'_>,
    ) -> Result<Equations<'a>, SteadySetError> {
        let (g, values, given) = (&system.graph, asked.values, asked.given);
        let numbers = numbers(system);
        let operating = OperatingPoint {
            numbers: &numbers,
            open: &[],
        };
        let own = ClosedSystem::about(system, terms, selection, (asked.speeds, operating))?;
        let implicit = &own.characteristics.manifold.implicit;
        let mut vanishing = [own.rates.clone(), own.equations.force.clone()].concat();
        vanishing.extend(finite_constraints(&own, system, (terms, selection)));
        vanishing.extend(implicit.iter().map(|(e, _)| *e));
        let at_rest = match asked.sought {
            Sought::SteadyMotions => Vec::new(),
            Sought::Rest => {
                jumps_at_rest(g, &vanishing)?;
                vanishing.extend(&own.characteristics.velocities);
                own.speeds_at_rest(system)
            }
        };
        vanishing.extend(velocities_given(system, &own, given));
        let controls = controls(system, &vanishing);
        let replacements: [&[(Expr, Expr)]; 4] = [&controls, &at_rest, given, values];
        let vanishing = normal(g, vanishing, &replacements)?;
        let slopes = at_point(g, &own.characteristics.basis.concat(), &replacements);
        let regular = implicit.iter().map(|(e, symbol)| g.diff(*e, *symbol));
        let regular = regular.chain(independence(system, &own));
        let regular: Vec<Expr> = regular.chain(corners_of(system)).collect();
        let regular = at_point(g, &regular, &replacements);
        if g.any_contains_any(&vanishing, &[g.intern_symbol("t", 0)]) {
            return Err(LinearizationError::NotAutonomous.into());
        }
        let is_given = |j: usize| given.iter().any(|(e, _)| *e == system.coordinates[j].q);
        let is_unknown = |j: &usize| {
            let symbol = [system.coordinates[*j].q_symbol];
            let occurs = || g.any_contains_any(&vanishing, &symbol);
            !is_given(*j) && (own.coordinates.contains(j) || occurs())
        };
        let coordinates: Vec<usize> = (0..system.n()).filter(is_unknown).collect();
        let known: Vec<Expr> = at_rest.iter().map(|(speed, _)| *speed).collect();
        Ok(Equations {
            unknowns: unknowns(system, &own, (&coordinates, &known)),
            system,
            sought: asked.sought,
            values: values.to_vec(),
            given: given.to_vec(),
            vanishing,
            slopes: moving(g, slopes),
            regular,
            coordinates,
            own,
        })
    }

    /// Whether a minor of the gradients of the constraints, or the sum of the squares of all, is known to vanish nowhere, or all vanish together at
    /// no state.
    pub(crate) fn has_full_rank(&self, terms: &MotionTerms, selection: &Selection) -> bool {
        let (g, n) = (&self.system.graph, self.system.n());
        let rows = selection.rows.iter();
        let rows: Vec<Vec<Expr>> = rows.map(|&row| terms.jacobian[row].clone()).collect();
        let choices = choices(n, rows.len());
        if choices.len() > MINORS {
            return false;
        }
        let minor = |columns: &Vec<usize>| {
            let of_row = |row: &Vec<Expr>| columns.iter().map(|&j| row[j]).collect();
            let minor: Vec<Vec<Expr>> = rows.iter().map(of_row).collect();
            determinant(g, &minor)
        };
        let minors: Vec<Expr> = choices.iter().map(minor).collect();
        let minors = at_point(g, &minors, &[&self.values]);
        let squares: Vec<Expr> = minors.iter().map(|&e| g.powi(e, 2)).collect();
        let sum = closed(g, g.add(&squares));
        let is_nonzero = |&e: &Expr| known_sign(g, e, &Assumptions::new()).is_nonzero();
        rows.is_empty()
            || minors.iter().chain([&sum]).any(is_nonzero)
            || vanish_nowhere(self.system, &minors, &self.values)
    }

    /// Whether the mass matrix is singular along a motion.
    pub(crate) fn is_singular_along(&self, values: &[Value]) -> bool {
        let g = &self.system.graph;
        let exact = |value: &Value| match value {
            Value::Number { exact, .. } => *exact,
            Value::Function(e) => Some(*e),
            Value::Tied => None,
        };
        let symbols = self.unknowns.iter().map(|(s, _)| g.symbol_expr(*s));
        let pairs = symbols.zip(values);
        let pairs: Vec<(Expr, Expr)> = pairs.filter_map(|(s, v)| Some((s, exact(v)?))).collect();
        let known = [&self.given[..], &self.values].concat();
        is_singular_at(g, &self.own.equations.mass, [&pairs, &known])
    }

    pub(crate) fn speeds(&self) -> Vec<(String, Expr)> {
        if self.sought == Sought::Rest {
            return Vec::new();
        }
        let speeds = self.own.characteristics.parameters.iter();
        speeds.map(|p| (p.name.clone(), p.definition)).collect()
    }

    /// The coordinates that may be anywhere.
    pub(crate) fn others(&self) -> Vec<usize> {
        let all = 0..self.system.n();
        let is_open = |&j: &usize| !self.coordinates.contains(&j) && self.position(j).is_none();
        all.filter(is_open).collect()
    }

    /// The position of a coordinate that is given.
    fn position(&self, j: usize) -> Option<Expr> {
        let mut given = self.given.iter();
        let found = given.find(|(e, _)| *e == self.system.coordinates[j].q);
        found.map(|(_, value)| *value)
    }

    pub(crate) fn ignorable(&self) -> Vec<String> {
        let all = self.others().into_iter();
        all.map(|j| self.system.coordinates[j].name.clone())
            .collect()
    }

    /// The motion with these values of the unknowns. An ignorable coordinate on which velocities depend is put
    /// where they are finite.
    pub(crate) fn motion(&self, name: &str, values: &[Expr]) -> SteadyMotion {
        let (system, g) = (self.system, &self.system.graph);
        let pairs: Vec<(Expr, Expr)> = self
            .unknowns
            .iter()
            .zip(values)
            .map(|((symbol, _), &value)| (g.symbol_expr(*symbol), value))
            .collect();
        let ignorable = self.others();
        let directed = |j: &usize| {
            let own = [system.coordinates[*j].q_symbol];
            g.any_contains_any(&self.own.characteristics.velocities, &own)
        };
        let directed: Vec<usize> = ignorable.into_iter().filter(directed).collect();
        let velocities = &self.own.characteristics.velocities;
        let controls = controls(system, velocities);
        let half = g.mul(&[fraction(g, (1, 2)), g.pi()]);
        let at = |place: Expr| {
            let origin = directed.iter().map(|&j| (system.coordinates[j].q, place));
            let origin: Vec<(Expr, Expr)> = origin.collect();
            let lists = [&controls, &self.given, &self.values, &pairs, &origin];
            at_point(g, velocities, &lists.map(Vec::as_slice))
        };
        let is_finite = |es: &[Expr]| {
            let found = g.evaluate_f64(es, &|_| Some(SOMEWHERE));
            found.is_ok_and(|found| found.iter().all(|x| x.is_finite()))
        };
        // Euler's angles have no velocities at zero.
        let places = [g.zero(), half, g.one()].into_iter();
        let mut places = places.map(|place| (place, at(place)));
        let (place, velocities) = places
            .find(|(_, velocities)| is_finite(velocities))
            .unwrap_or_else(|| (g.zero(), at(g.zero())));
        let velocities = match self.sought {
            Sought::SteadyMotions => velocities,
            Sought::Rest => vec![g.zero(); system.n()],
        };
        let position = |j: usize| {
            let own = self.coordinates.iter().position(|&own| own == j);
            let origin = directed.contains(&j).then_some(place);
            own.map(|at| values[at])
                .or(origin)
                .or_else(|| self.position(j))
        };
        SteadyMotion {
            name: name.into(),
            positions: (0..system.n()).map(position).collect(),
            velocities: velocities.into_iter().map(Some).collect(),
            guesses: Vec::new(),
            over: None,
        }
    }
}

/// What vanishes where velocities are as they are given.
fn velocities_given(system: &System, own: &ClosedSystem, given: &[(Expr, Expr)]) -> Vec<Expr> {
    let g = &system.graph;
    let coordinates = system.coordinates.iter();
    let pairs = coordinates.zip(&own.characteristics.velocities);
    let difference = |(c, &velocity): (&Coordinate, &Expr)| {
        let found = given.iter().find(|(e, _)| *e == c.v)?;
        Some(g.sub(velocity, found.1))
    };
    pairs.filter_map(difference).collect()
}

/// The parameters with their values in numbers.
fn numbers(system: &System) -> Vec<(Symbol, f64)> {
    let g = &system.graph;
    let all = system.parameter_values().into_iter();
    all.filter_map(|(symbol, value)| {
        let number = g.evaluate_f64(&[value], &|_| None).ok()?[0];
        Some((g.as_symbol(symbol)?, number))
    })
    .collect()
}

/// The finite constraints that tie variables: one lets an ignorable coordinate follow, several tie the others by it.
fn finite_constraints(
    own: &ClosedSystem,
    system: &System,
    (terms, selection): (&MotionTerms, &Selection),
) -> Vec<Expr> {
    let g = &system.graph;
    let rows = selection.rows.iter();
    let constraints = rows.map(|&row| &system.constraints[terms.constraint_index[row]]);
    let finite = constraints.filter(|c| c.kind == ConstraintKind::Holonomic);
    let mut finite: Vec<Expr> = finite.map(|c| c.stated).collect();
    let follows = |symbol: &Symbol| {
        let holding = finite.iter().filter(|&&e| g.contains_any(e, &[*symbol]));
        holding.count() < 2
    };
    let ignorable = own.ignorable(system).into_iter();
    let ignorable = ignorable.map(|j| system.coordinates[j].q_symbol);
    let following: Vec<Symbol> = ignorable.filter(follows).collect();
    finite.retain(|&e| !g.contains_any(e, &following));
    finite
}

/// The unknowns with their names: these coordinates, quasi-velocities and dependent velocities, but those that are known.
fn unknowns(
    system: &System,
    own: &ClosedSystem,
    (coordinates, known): (&[usize], &[Expr]),
) -> Vec<(Symbol, String)> {
    let g = &system.graph;
    let coordinates = coordinates.iter().map(|&j| &system.coordinates[j]);
    let coordinates = coordinates.map(|c| (c.q_symbol, c.name.clone()));
    let speeds = own.characteristics.parameters.iter();
    let speeds = speeds.map(|p| (p.symbol, p.name.clone()));
    let implicit = own.characteristics.manifold.implicit.iter();
    let implicit = implicit.map(|(_, s)| (*s, g.symbol_text(*s)));
    let is_open = |(symbol, _): &(Symbol, String)| !known.contains(&g.symbol_expr(*symbol));
    coordinates
        .chain(speeds.chain(implicit).filter(is_open))
        .collect()
}

/// The choices of so many of the first n numbers.
pub(crate) fn choices(n: usize, count: usize) -> Vec<Vec<usize>> {
    if count == 0 {
        return vec![Vec::new()];
    }
    let mut all = Vec::new();
    for last in count..=n {
        for mut own in choices(last - 1, count - 1) {
            own.push(last - 1);
            all.push(own);
            if all.len() > MINORS {
                return all;
            }
        }
    }
    all
}

/// What may not vanish so that L and the constraints have derivatives, and forces no jump.
fn corners_of(system: &System) -> Vec<Expr> {
    let g = &system.graph;
    let constraints = system.constraints.iter();
    let differentiated: Vec<Expr> = constraints
        .flat_map(|own| [own.stated, own.f])
        .chain([system.lagrangian])
        .collect();
    let of_forces = corners(g, &system.forces).into_iter();
    let jumps = of_forces.filter(|(e, _)| {
        matches!(
            g.node(*e),
            Node::Apply {
                function: Function::Sign,
                ..
            }
        )
    });
    let all = corners(g, &differentiated).into_iter().chain(jumps);
    all.map(|(_, inside)| inside).collect()
}

/// The sum of the squares of the minors of the velocities by the quasi-velocities; none where it is a number, or where these are velocities themselves.
fn independence(system: &System, own: &ClosedSystem) -> Option<Expr> {
    let g = &system.graph;
    let basis = &own.characteristics.basis;
    let k = own.characteristics.k();
    let rows = choices(basis.len(), k);
    if k == 0 || rows.len() > MINORS {
        return None;
    }
    let minor = |rows: &Vec<usize>| {
        let rows: Vec<Vec<Expr>> = rows.iter().map(|&row| basis[row].clone()).collect();
        closed(g, determinant(g, &rows))
    };
    let minors: Vec<Expr> = rows.iter().map(minor).collect();
    let is_number = |&e: &Expr| g.as_number(e).is_some() && !g.is_zero(e);
    if minors.iter().any(is_number) {
        return None;
    }
    let squares = minors.into_iter().map(|e| g.powi(e, 2));
    let mut sum = closed(g, g.add(&squares.collect::<Vec<Expr>>()));
    // Coordinates on which nothing depends may be where it does not vanish.
    for j in own.ignorable(system) {
        let coordinate = &system.coordinates[j];
        if g.contains_any(sum, &[coordinate.q_symbol]) {
            sum = *without(g, &[sum], coordinate.q)?.first()?;
        }
    }
    g.as_number(sum).is_none().then_some(sum)
}

/// Forces that jump where a velocity vanishes, as dry friction does, hold a system at rest in more places than the equations have zeros.
fn jumps_at_rest(g: &Graph, vanishing: &[Expr]) -> Result<(), SteadySetError> {
    let is_jump = |e: &Expr| {
        let jumping = [Function::Sign, Function::Atan2];
        matches!(g.node(*e), Node::Apply { function, .. } if jumping.contains(function))
    };
    match g.reachable(vanishing).into_iter().find(is_jump) {
        Some(e) => Err(SteadySetError::NotPolynomial { what: g.text(e) }),
        None => Ok(()),
    }
}

/// The normal forms of expressions with these replacements, those left out that are zero. The largest is made first: where it is too large
/// that is known at once.
fn normal(
    g: &Graph,
    mut es: Vec<Expr>,
    replacements: &[&[(Expr, Expr)]],
) -> Result<Vec<Expr>, SteadySetError> {
    for list in replacements {
        es = g.substitute_all(&es, list);
    }
    let mut places: Vec<usize> = (0..es.len()).collect();
    places.sort_by_key(|&at| Reverse(g.reachable(&[es[at]]).len()));
    for at in places {
        es[at] = normal_form(g, es[at], &Budget::PROOF)?.to_expr();
    }
    es.retain(|&e| !g.is_zero(e));
    Ok(es)
}

/// The expressions that are no numbers.
fn moving(g: &Graph, es: Vec<Expr>) -> Vec<Expr> {
    es.into_iter()
        .filter(|&e| g.as_number(e).is_none())
        .collect()
}
