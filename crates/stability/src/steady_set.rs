//! All steady motions of a system: the common zeros of what changes the variables of its smallest closed system.
//!
//! Sines and cosines of coordinates, and roots, are unknowns of their own with the relations that they satisfy, so that the equations are
//! polynomials; their zeros are a union of triangular systems, in which each equation determines one unknown by those before it. Where no unknown
//! is free the motions are isolated, and every real one is enclosed; else they are a family with the free unknowns as parameters. States of rest
//! are sought in the same way, with all velocities zero: fewer unknowns.

use crate::branch::{Branch, Chain};
use crate::charts::{is_assumed, is_singular_at, other_charts, union};
use crate::problem::LinearizationError;
use crate::real_values::corners;
use crate::reduction::{without, ClosedSystem, OperatingPoint, Speeds};
use crate::steady::{at_point, closed};
pub use crate::steady_motions::{Found, SteadySet};
use crate::steady_value::{fraction, Generators, Unknown};
pub use crate::steady_value::{SteadySetError, Value};
use chetaev_mechanics::constraint::{Constraint, ConstraintKind};
use chetaev_mechanics::{MotionTerms, Selection, SteadyMotion, System};
use chetaev_symbolic::common_zeros::{angles, needed_relations};
use chetaev_symbolic::factors::irreducible_factors;
use chetaev_symbolic::matrix::determinant;
use chetaev_symbolic::polynomial::normal_form::{normal_form, normal_forms, Field, Kind, Options};
use chetaev_symbolic::polynomial::{triangular_systems, Budget, Polynomial, TooLarge};
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

/// The steady motions of a system with these values of parameters; others stay symbols in general position.
///
/// # Errors
/// [`SteadySetError`] where they cannot all be found so.
pub fn steady_set(
    system: &System,
    terms: &MotionTerms,
    selection: &Selection,
    values: &[(Expr, Expr)],
) -> Result<SteadySet, SteadySetError> {
    all_of(Sought::SteadyMotions, (system, terms, selection), values)
}

/// The states of rest, or all steady motions.
///
/// # Errors
/// [`SteadySetError`] where they cannot all be found so.
pub fn all_of(
    sought: Sought,
    (system, terms, selection): (&System, &MotionTerms, &Selection),
    values: &[(Expr, Expr)],
) -> Result<SteadySet, SteadySetError> {
    if let Some(constraint) = system
        .constraints
        .iter()
        .find(|own| is_product(system, own))
    {
        return Err(SteadySetError::Product {
            constraint: constraint.name.clone(),
        });
    }
    let in_chart = |chart: &Selection, speeds| {
        let asked = Asked {
            sought,
            values,
            speeds,
        };
        in_chart(system, terms, chart, asked)
    };
    let mut set = in_chart(selection, Speeds::Suitable)?;
    for chart in other_charts(selection, choices(system.n(), selection.rows.len())) {
        if set.excluded.is_empty() {
            break;
        }
        let other = in_chart(&chart, Speeds::Independent);
        if let Some(other) = other.ok().filter(|other| other.ignorable == set.ignorable) {
            union(system, &mut set, &other);
        }
    }
    sort(&mut set.found);
    Ok(set)
}

/// Whether a constraint is a product, of which motions keep one factor or another at zero.
fn is_product(system: &System, constraint: &Constraint) -> bool {
    let g = &system.graph;
    let e = match constraint.kind {
        ConstraintKind::Holonomic => constraint.stated,
        _ => constraint.f,
    };
    let symbols = [system.coordinate_symbols(), system.velocity_symbols()].concat();
    irreducible_factors(g, e, &symbols).is_some_and(|all| all.len() > 1)
}

/// What is sought in one chart.
#[derive(Clone, Copy)]
struct Asked<'v> {
    sought: Sought,
    /// Values of parameters.
    values: &'v [(Expr, Expr)],
    speeds: Speeds,
}

/// The steady motions where the speeds of one choice serve.
fn in_chart(
    system: &System,
    terms: &MotionTerms,
    selection: &Selection,
    asked: Asked<'_>,
) -> Result<SteadySet, SteadySetError> {
    let g = &system.graph;
    let equations = Equations::new(system, terms, selection, asked)?;
    let symbols: Vec<Symbol> = equations.unknowns.iter().map(|(s, _)| *s).collect();
    let mut options = Options::proof(Budget::PROOF);
    let all = [
        equations.vanishing.clone(),
        equations.slopes.clone(),
        equations.regular.clone(),
    ]
    .concat();
    options.base_angles = angles(g, &all, &symbols);
    let (field, forms) = normal_forms(g, &all, &options)?;
    let vanishing = forms.iter().take(equations.vanishing.len());
    let numerators: Vec<Polynomial> = vanishing.map(|f| f.numerator().clone()).collect();
    let count = numerators.len();
    let mut denominators: Vec<Polynomial> = forms.iter().map(|f| f.denominator().clone()).collect();
    // By these was divided to solve constraints for dependent velocities.
    let regular = forms.iter().skip(count + equations.slopes.len());
    denominators.extend(regular.map(|f| f.numerator().clone()));
    let polynomials = [numerators, denominators.clone()].concat();
    let relations = needed_relations(&field, &polynomials)?;
    // What stands under a root alone is an unknown too.
    let related = [polynomials.clone(), relations.clone()].concat();
    let unknowns = unknowns(&field, &equations, &related)?;
    let order = order(&field, &unknowns, &related);
    let meter = field.meter();
    let vanishing = &polynomials[..count];
    let vanishing: Vec<Polynomial> = vanishing.iter().chain(&relations).cloned().collect();
    let chains = triangular_systems(&vanishing, &denominators, &order, meter)?;
    let anywhere = equations.others().into_iter();
    let anywhere: Vec<Symbol> = anywhere.map(|j| system.coordinates[j].q_symbol).collect();
    let mut found = Vec::new();
    for system_of_chain in &chains {
        let chain = Chain {
            system,
            field: &field,
            unknowns: &unknowns,
            order: &order,
            relations: &relations,
            equations: system_of_chain,
        };
        for branch in chain.branches()? {
            let own = found_of(&chain, &equations, branch);
            let is_assumed = is_assumed(system, &own, (asked.values, &anywhere));
            found.push(Found { is_assumed, ..own });
        }
    }
    distinct(&mut found);
    sort(&mut found);
    Ok(SteadySet {
        variables: unknowns.iter().map(|u| u.name.clone()).collect(),
        speeds: equations.speeds(),
        ignorable: equations.ignorable(),
        found,
        excluded: excluded(&field, &denominators, &symbols)?,
        has_full_rank: equations.has_full_rank(terms, selection),
    })
}

/// What vanishes along a steady motion.
struct Equations<'a> {
    system: &'a System,
    own: ClosedSystem,
    sought: Sought,
    values: Vec<(Expr, Expr)>,
    /// Rates of coordinates, forces, finite and implicit constraints.
    vanishing: Vec<Expr>,
    /// The slopes of the velocities by the quasi-velocities: where one has no value these do not serve.
    slopes: Vec<Expr>,
    /// The slopes of constraints that are not affine by the velocities that they determine: where one vanishes they determine none.
    regular: Vec<Expr>,
    /// The unknowns with their names, those that are coordinates first.
    unknowns: Vec<(Symbol, String)>,
    /// The coordinates among them.
    coordinates: Vec<usize>,
}

impl<'a> Equations<'a> {
    fn new(
        system: &'a System,
        terms: &MotionTerms,
        selection: &Selection,
        asked: Asked<'_>,
    ) -> Result<Equations<'a>, SteadySetError> {
        let (g, values) = (&system.graph, asked.values);
        let numbers = system.parameter_values().into_iter();
        let numbers = numbers.filter_map(|(symbol, value)| {
            let number = g.evaluate_f64(&[value], &|_| None).ok()?[0];
            Some((g.as_symbol(symbol)?, number))
        });
        let numbers: Vec<(Symbol, f64)> = numbers.collect();
        let operating = OperatingPoint {
            numbers: &numbers,
            open: &[],
        };
        let own = ClosedSystem::about(system, terms, selection, (asked.speeds, operating))?;
        let ignorable: Vec<Symbol> = own
            .ignorable(system)
            .into_iter()
            .map(|j| system.coordinates[j].q_symbol)
            .collect();
        let rows = selection.rows.iter();
        let constraints = rows.map(|&row| &system.constraints[terms.constraint_index[row]]);
        let finite = constraints.filter(|c| c.kind == ConstraintKind::Holonomic);
        let finite = finite.map(|c| c.stated);
        let implicit = own.characteristics.manifold.implicit.iter();
        let mut vanishing = [own.rates.clone(), own.equations.force.clone()].concat();
        // One constraint lets an ignorable coordinate follow; several tie the others by it.
        let finite: Vec<Expr> = finite.collect();
        let follows = |symbol: &Symbol| {
            let holding = finite.iter().filter(|&&e| g.contains_any(e, &[*symbol]));
            holding.count() < 2
        };
        let ignorable: Vec<Symbol> = ignorable.into_iter().filter(follows).collect();
        let kept = finite.iter().copied();
        let kept = kept.filter(|&e| !g.contains_any(e, &ignorable));
        vanishing.extend(kept);
        vanishing.extend(implicit.clone().map(|(e, _)| *e));
        let at_rest = match asked.sought {
            Sought::SteadyMotions => Vec::new(),
            Sought::Rest => {
                jumps_at_rest(g, &vanishing)?;
                vanishing.extend(&own.characteristics.velocities);
                own.speeds_at_rest(system)
            }
        };
        let controls = controls(system, &vanishing);
        let vanishing = normal(g, vanishing, &[&controls, &at_rest, values])?;
        // Where all minors vanish the quasi-velocities do not tell velocities apart.
        let slopes: Vec<Expr> = own.characteristics.basis.concat();
        let slopes = at_point(g, &slopes, &[&controls, &at_rest, values]);
        let regular = implicit.clone().map(|(e, symbol)| g.diff(*e, *symbol));
        let regular = regular.chain(independence(system, &own));
        let regular: Vec<Expr> = regular.chain(corners_of(system)).collect();
        let regular = at_point(g, &regular, &[&controls, &at_rest, values]);
        if g.any_contains_any(&vanishing, &[g.intern_symbol("t", 0)]) {
            return Err(LinearizationError::NotAutonomous.into());
        }
        let is_unknown = |j: &usize| {
            own.coordinates.contains(j)
                || g.any_contains_any(&vanishing, &[system.coordinates[*j].q_symbol])
        };
        let coordinates: Vec<usize> = (0..system.n()).filter(is_unknown).collect();
        let named = coordinates.iter().map(|&j| &system.coordinates[j]);
        let mut unknowns: Vec<(Symbol, String)> =
            named.map(|c| (c.q_symbol, c.name.clone())).collect();
        let is_free = |symbol: &Symbol| {
            let own = g.symbol_expr(*symbol);
            at_rest.iter().all(|(speed, _)| *speed != own)
        };
        let speeds = own.characteristics.parameters.iter();
        let speeds = speeds.map(|p| (p.symbol, p.name.clone()));
        let implicit = implicit.map(|(_, s)| (*s, g.symbol_text(*s)));
        unknowns.extend(speeds.chain(implicit).filter(|(symbol, _)| is_free(symbol)));
        Ok(Equations {
            system,
            sought: asked.sought,
            values: values.to_vec(),
            vanishing,
            slopes: moving(g, slopes),
            regular,
            unknowns,
            coordinates,
            own,
        })
    }

    /// Whether the sum of the squares of all minors of the gradients of the constraints is a number that is not zero.
    fn has_full_rank(&self, terms: &MotionTerms, selection: &Selection) -> bool {
        let (g, n) = (&self.system.graph, self.system.n());
        let rows = selection.rows.iter();
        let rows: Vec<Vec<Expr>> = rows.map(|&row| terms.jacobian[row].clone()).collect();
        let choices = choices(n, rows.len());
        if choices.len() > MINORS {
            return false;
        }
        let square = |columns: &Vec<usize>| {
            let of_row = |row: &Vec<Expr>| columns.iter().map(|&j| row[j]).collect();
            let minor: Vec<Vec<Expr>> = rows.iter().map(of_row).collect();
            g.powi(determinant(g, &minor), 2)
        };
        let squares: Vec<Expr> = choices.iter().map(square).collect();
        let sum = at_point(g, &[g.add(&squares)], &[&self.values]);
        rows.is_empty()
            || sum
                .iter()
                .all(|&e| g.as_number(e).is_some() && !g.is_zero(e))
    }

    /// Whether the mass matrix is singular along a motion.
    fn is_singular_along(&self, values: &[Value]) -> bool {
        let g = &self.system.graph;
        let exact = |value: &Value| match value {
            Value::Number { exact, .. } => *exact,
            Value::Function(e) => Some(*e),
            Value::Tied => None,
        };
        let symbols = self.unknowns.iter().map(|(s, _)| g.symbol_expr(*s));
        let pairs = symbols.zip(values);
        let pairs: Vec<(Expr, Expr)> = pairs.filter_map(|(s, v)| Some((s, exact(v)?))).collect();
        is_singular_at(g, &self.own.equations.mass, [&pairs, &self.values])
    }

    fn speeds(&self) -> Vec<(String, Expr)> {
        if self.sought == Sought::Rest {
            return Vec::new();
        }
        let speeds = self.own.characteristics.parameters.iter();
        speeds.map(|p| (p.name.clone(), p.definition)).collect()
    }

    /// The coordinates that may be anywhere.
    fn others(&self) -> Vec<usize> {
        let all = 0..self.system.n();
        all.filter(|j| !self.coordinates.contains(j)).collect()
    }

    fn ignorable(&self) -> Vec<String> {
        let all = self.others().into_iter();
        all.map(|j| self.system.coordinates[j].name.clone())
            .collect()
    }

    /// The motion with these values of the unknowns. An ignorable coordinate on which velocities depend is put
    /// where they are finite.
    fn motion(&self, name: &str, values: &[Expr]) -> SteadyMotion {
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
            at_point(g, velocities, &[&controls, &self.values, &pairs, &origin])
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
            own.map(|at| values[at]).or(origin)
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

/// Controls by their laws, and zero where a model states none.
fn controls(system: &System, es: &[Expr]) -> Vec<(Expr, Expr)> {
    let g = &system.graph;
    let of = |symbol: Symbol| {
        let name = g.symbol_name(symbol);
        let control = system.controls.iter().find(|c| c.name == name)?;
        let law = control.law.unwrap_or_else(|| g.zero());
        let rate = |e: Expr| g.total_derivative(e, &|_| false);
        let value = (0..g.symbol_order(symbol)).fold(law, |e, _| rate(e));
        Some((g.symbol_expr(symbol), value))
    };
    g.symbols_in(es).into_iter().filter_map(of).collect()
}

/// The choices of so many of the first n numbers.
fn choices(n: usize, count: usize) -> Vec<Vec<usize>> {
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

/// The unknowns with the generators that stand for them.
fn unknowns(
    field: &Field<'_>,
    equations: &Equations<'_>,
    polynomials: &[Polynomial],
) -> Result<Vec<Unknown>, SteadySetError> {
    let g = field.graph();
    let own: Vec<Symbol> = equations.unknowns.iter().map(|(s, _)| *s).collect();
    let occurs = |generator: usize| polynomials.iter().any(|p| p.degree_in(generator) > 0);
    let mut found: Vec<Unknown> = Vec::new();
    for (at, (symbol, name)) in equations.unknowns.iter().enumerate() {
        let plain = field.generator_of(g.symbol_expr(*symbol));
        let mut by = plain
            .filter(|&generator| occurs(generator))
            .map_or(Generators::None, Generators::Own);
        for pair in field.pythagoras().iter().filter(|pair| pair.circular) {
            if !occurs(pair.sine) && !occurs(pair.cosine) {
                continue;
            }
            let argument = field.argument_of(pair.sine);
            let Some(times) = argument.and_then(|e| multiple(g, e, *symbol)) else {
                continue;
            };
            if !matches!(by, Generators::None) {
                return Err(not_polynomial(field, pair.sine));
            }
            by = Generators::Angle {
                cosine: pair.cosine,
                sine: pair.sine,
                times,
            };
        }
        found.push(Unknown {
            symbol: *symbol,
            name: name.clone(),
            is_speed: at >= equations.coordinates.len(),
            by,
        });
    }
    let is_known = |generator: usize| {
        let own = &field.generators()[generator];
        let mut all = found.iter();
        let is_of = |u: &Unknown| match u.by {
            Generators::Own(own) => own == generator,
            Generators::Angle { cosine, sine, .. } => cosine == generator || sine == generator,
            Generators::None => false,
        };
        let is_root = matches!(own.kind, Kind::Absolute | Kind::Radical { .. });
        is_root || all.any(is_of)
    };
    let count = field.generators().len();
    let mut odd = (0..count).filter(|&at| occurs(at) && !is_known(at));
    let strange = odd.find(|&at| g.contains_any(field.generators()[at].expr, &own));
    match strange {
        Some(at) => Err(not_polynomial(field, at)),
        None => Ok(found),
    }
}

fn not_polynomial(field: &Field<'_>, generator: usize) -> SteadySetError {
    SteadySetError::NotPolynomial {
        what: field.graph().text(field.generators()[generator].expr),
    }
}

/// The rational number by which a symbol is multiplied to give an expression.
fn multiple(g: &Graph, e: Expr, symbol: Symbol) -> Option<(i64, i64)> {
    let slope = g.diff(e, symbol);
    let own = g.as_number(slope)?.clone();
    let rest = closed(g, g.sub(e, g.mul(&[slope, g.symbol_expr(symbol)])));
    if !g.is_zero(rest) || g.is_zero(slope) {
        return None;
    }
    let (above, below) = own.into_parts();
    Some((i64::try_from(above).ok()?, i64::try_from(below).ok()?))
}

/// The generators to be determined, those that are eliminated last first: numbers, then angles, coordinates, velocities (those of lower degree
/// are solved for first), roots.
fn order(field: &Field<'_>, unknowns: &[Unknown], polynomials: &[Polynomial]) -> Vec<usize> {
    let g = field.graph();
    let symbols: Vec<Symbol> = unknowns.iter().map(|u| u.symbol).collect();
    let depends = |at: usize| g.contains_any(field.generators()[at].expr, &symbols);
    let relations = field.relations().unwrap_or_default();
    let related = || relations.iter().map(|(generator, _)| *generator);
    let mut all: Vec<usize> = related().filter(|&at| !depends(at)).collect();
    for own in unknowns {
        if let Generators::Angle { cosine, sine, .. } = own.by {
            all.extend([cosine, sine]);
        }
    }
    let degree = |at: usize| polynomials.iter().map(|p| p.degree_in(at)).max();
    let plain = unknowns.iter().filter_map(|u| match u.by {
        Generators::Own(at) => Some((u.is_speed, std::cmp::Reverse(degree(at)), at)),
        _ => None,
    });
    let mut plain: Vec<_> = plain.collect();
    plain.sort_unstable();
    all.extend(plain.into_iter().map(|(_, _, at)| at));
    let roots: Vec<usize> = related()
        .filter(|&at| depends(at) && !all.contains(&at))
        .collect();
    all.extend(roots);
    all
}

/// The denominators in which unknowns occur.
fn excluded(
    field: &Field<'_>,
    denominators: &[Polynomial],
    symbols: &[Symbol],
) -> Result<Vec<Expr>, TooLarge> {
    let g = field.graph();
    let mut all = Vec::new();
    for p in denominators {
        for (factor, _) in p.factorize(field.meter())?.factors {
            let e = field.polynomial_expression(&factor);
            let is_nonzero = known_sign(g, closed(g, e), &Assumptions::new()).is_nonzero();
            if g.contains_any(e, symbols) && !is_nonzero && !all.contains(&e) {
                all.push(e);
            }
        }
    }
    Ok(all)
}

fn found_of(chain: &Chain<'_, '_>, equations: &Equations<'_>, branch: Branch) -> Found {
    let g = chain.field.graph();
    let values: Vec<Value> = chain.values(&branch);
    let exact = |value: &Value| match value {
        Value::Number { exact, .. } => *exact,
        Value::Function(e) => Some(*e),
        Value::Tied => None,
    };
    let all: Option<Vec<Expr>> = values.iter().map(exact).collect();
    Found {
        name: String::new(),
        motion: all.map(|all| equations.motion("", &all)),
        is_singular: equations.is_singular_along(&values),
        is_assumed: true,
        is_real: branch.free.is_empty() || chain.has_real_point(),
        equations: chain.open_equations(&branch),
        conditions: branch
            .conditions
            .iter()
            .map(|&e| closed(g, e))
            .filter(|&e| g.as_number(e).is_none())
            .collect(),
        free: branch.free,
        values,
    }
}

/// Single motions whose values are enclosed by the same small intervals are one: different branches of a root or an absolute value meet there.
fn distinct(found: &mut Vec<Found>) {
    let is_same = |a: &Found, b: &Found| {
        let mut pairs = a.values.iter().zip(&b.values);
        pairs.all(|pair| match pair {
            (Value::Number { ball: a, .. }, Value::Number { ball: b, .. }) => a.overlaps(b),
            _ => false,
        })
    };
    let mut at = 1;
    while at < found.len() {
        let is_single = found[at].dimension() == 0 && !found[at].values.is_empty();
        if is_single && found[..at].iter().any(|own| is_same(own, &found[at])) {
            found.remove(at);
        } else {
            at += 1;
        }
    }
}

/// Isolated motions first, by their values, then families by their dimension; each gets its number.
fn sort(found: &mut [Found]) {
    let key = |own: &Found| -> (usize, Vec<f64>) {
        let values = own.values.iter().map(|value| match value {
            Value::Number { ball, .. } => ball.to_f64(),
            _ => f64::INFINITY,
        });
        (own.dimension(), values.collect())
    };
    found.sort_by(|a, b| {
        let ((m, a), (n, b)) = (key(a), key(b));
        let pairs = a.iter().zip(&b).map(|(a, b)| a.total_cmp(b));
        m.cmp(&n)
            .then(pairs.fold(std::cmp::Ordering::Equal, std::cmp::Ordering::then))
    });
    for (at, own) in found.iter_mut().enumerate() {
        own.name = (at + 1).to_string();
        if let Some(motion) = &mut own.motion {
            motion.name = own.name.clone();
        }
    }
}
