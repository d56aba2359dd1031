//! The motion about which is linearized: positions and velocities, exact in the parameters.
//!
//! Velocities that are not given follow from the constraints, which are affine in them at given positions; those that the
//! constraints leave free are zero. Positions of ignorable coordinates need not be given.

use crate::problem::LinearizationError;
use chetaev_mechanics::{MotionTerms, SteadyMotion, System};
use chetaev_symbolic::number::ball::{Ball, Precision};
use chetaev_symbolic::polynomial::normal_form::{normal_form, normal_forms, Options};
use chetaev_symbolic::polynomial::Budget;
use chetaev_symbolic::simplify;
use chetaev_symbolic::zero::separation::vanishes;
use chetaev_symbolic::{Expr, Graph, Node, Symbol};

/// A state with all velocities.
#[derive(Clone, Debug)]
pub(crate) struct State {
    /// Pairs of symbols and values, of the positions that are given and of all velocities.
    pub(crate) values: Vec<(Expr, Expr)>,
    /// Coordinates without a position.
    pub(crate) without_position: Vec<usize>,
}

/// Rest at these positions, length n.
pub fn rest(system: &System, name: &str, positions: Vec<Option<Expr>>) -> SteadyMotion {
    let zero = system.graph.zero();
    SteadyMotion {
        name: name.into(),
        positions,
        velocities: vec![Some(zero); system.n()],
        guesses: Vec::new(),
        over: None,
    }
}

/// The state of a motion with the velocities that the constraints of `rows` determine; `values` are those of parameters.
pub(crate) fn completed(
    motion: &SteadyMotion,
    system: &System,
    terms: &MotionTerms,
    rows: &[usize],
    values: &[(Expr, Expr)],
) -> Result<State, LinearizationError> {
    let g = &system.graph;
    let coordinates = system.coordinates.iter();
    let given = coordinates.clone().zip(&motion.positions);
    let mut state: Vec<(Expr, Expr)> = given
        .filter_map(|(c, position)| position.map(|position| (c.q, position)))
        .collect();
    let given = coordinates.clone().zip(&motion.velocities);
    state.extend(given.filter_map(|(c, v)| v.map(|v| (c.v, v))));
    let unknown = (0..system.n()).filter(|&j| motion.velocities[j].is_none());
    let symbols: Vec<Symbol> = unknown.map(|j| system.coordinates[j].v_symbol).collect();
    let constraints: Vec<Expr> = rows.iter().map(|&row| terms.constraints[row]).collect();
    let at = at_point(g, &constraints, &[&state, values]);
    let found = affine_solution(g, &at, &symbols);
    let found = found.ok_or_else(|| LinearizationError::VelocitiesNotDetermined {
        motion: motion.name.clone(),
    })?;
    state.extend(
        symbols
            .iter()
            .zip(found)
            .map(|(&s, value)| (g.symbol_expr(s), value)),
    );
    Ok(State {
        values: state,
        without_position: (0..system.n())
            .filter(|&j| motion.positions[j].is_none())
            .collect(),
    })
}

/// A place of a coordinate on which nothing depends, away from the singular places of angles.
pub(crate) const SOMEWHERE: f64 = 0.377;

/// All positions and velocities of a motion in numbers, with those of parameters; `values` are exact ones of parameters. Coordinates that the
/// motion leaves open are somewhere.
///
/// # Errors
/// [`LinearizationError`] where the constraints do not determine the velocities that are not given.
pub fn numbers(
    motion: &SteadyMotion,
    system: &System,
    terms: &MotionTerms,
    (rows, values): (&[usize], &[(Expr, Expr)]),
) -> Result<Vec<(Symbol, f64)>, LinearizationError> {
    let g = &system.graph;
    let state = completed(motion, system, terms, rows, values)?;
    let open = state.without_position.iter();
    let open = open.map(|&j| system.coordinates[j].q_symbol);
    let mut point: Vec<(Symbol, f64)> = open.map(|s| (s, SOMEWHERE)).collect();
    let number = |e: Expr, known: &[(Symbol, f64)]| {
        let e = g.substitute(e, values);
        let find = |s: Symbol| known.iter().find(|own| own.0 == s).map(|own| own.1);
        g.evaluate_f64(&[e], &find).ok().map(|found| found[0])
    };
    let somewhere = point.clone();
    let known = values.iter().chain(&state.values);
    point.extend(
        known.filter_map(|&(symbol, e)| Some((g.as_symbol(symbol)?, number(e, &somewhere)?))),
    );
    Ok(point)
}

/// Expressions at a point: the lists of replacements one after the other, then closed forms.
pub(crate) fn at_point(g: &Graph, es: &[Expr], replacements: &[&[(Expr, Expr)]]) -> Vec<Expr> {
    let mut es = es.to_vec();
    for list in replacements {
        es = g.substitute_all(&es, list);
    }
    es.into_iter().map(|e| closed(g, e)).collect()
}

/// Controls by their laws, and zero where a model states none.
pub(crate) fn controls(system: &System, es: &[Expr]) -> Vec<(Expr, Expr)> {
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

/// The exact normal form of an expression, so that what vanishes is zero by its form; as it is where that is too large.
pub(crate) fn closed(g: &Graph, e: Expr) -> Expr {
    if g.as_number(e).is_some() {
        return e;
    }
    let has_angles = has_angles_of_numbers(g, e);
    if has_angles && is_apart_from_zero(g, e) {
        return readable(g, e).unwrap_or(e);
    }
    let form = match normal_form(g, e, &Budget::PROOF) {
        Ok(form) if form.is_zero() => g.zero(),
        Ok(form) if has_angles => readable(g, e).unwrap_or_else(|| form.to_expr()),
        Ok(form) => form.to_expr(),
        Err(_) => simplify::simplify(g, e, &simplify::Options::default()),
    };
    // Numbers of several roots vanish by no form, as √2 + √3 − √(5 + 2√6) does.
    match vanishes(g, form) {
        Some(true) => g.zero(),
        _ => form,
    }
}

/// Whether a sine, or another function, of a number occurs.
fn has_angles_of_numbers(g: &Graph, e: Expr) -> bool {
    let is_of_number = |own: Expr| match g.node(own) {
        Node::Apply { arguments, .. } => arguments.iter().any(|own| g.as_number(*own).is_some()),
        _ => false,
    };
    g.reachable(&[e]).into_iter().any(is_of_number)
}

/// Whether a number is enclosed apart from zero.
fn is_apart_from_zero(g: &Graph, e: Expr) -> bool {
    let found = g.enclose(&[e], &Precision::new(128), &|_| None);
    found.is_ok_and(|all| all.iter().all(Ball::excludes_zero))
}

/// The form without multiples of angles that are numbers: `sin(23/15)` beside `sin(1/5)` would be a polynomial of degree 23. `None` where it is too
/// large.
fn readable(g: &Graph, e: Expr) -> Option<Expr> {
    let (field, values) = normal_forms(g, &[e], &Options::readable(Budget::PROOF)).ok()?;
    values.first().map(|own| field.expression(own))
}

/// A solution of equations that are affine in the unknowns, those that are free being zero; `None` where they are not affine or
/// contradict each other.
fn affine_solution(g: &Graph, equations: &[Expr], unknowns: &[Symbol]) -> Option<Vec<Expr>> {
    let matrix = g.jacobian(equations, unknowns);
    if g.any_contains_any(&matrix.concat(), unknowns) {
        return None;
    }
    let vanishing: Vec<(Expr, Expr)> = unknowns
        .iter()
        .map(|&s| (g.symbol_expr(s), g.zero()))
        .collect();
    let constant = g.substitute_all(equations, &vanishing);
    let right: Vec<Expr> = constant.into_iter().map(|c| g.neg(c)).collect();
    Some(solution(g, (&matrix, unknowns.len()), &right)?.values)
}

/// A solution of linear equations.
pub(crate) struct Solved {
    /// The unknowns, those that are free being zero.
    pub(crate) values: Vec<Expr>,
    /// What was divided by.
    pub(crate) divisors: Vec<Expr>,
}

/// A solution of `A x = b` with so many unknowns; `None` where there is none.
pub(crate) fn solution(
    g: &Graph,
    (matrix, count): (&[Vec<Expr>], usize),
    right: &[Expr],
) -> Option<Solved> {
    let mut rows: Vec<Vec<Expr>> = matrix
        .iter()
        .zip(right)
        .map(|(row, &b)| row.iter().chain([&b]).map(|&e| closed(g, e)).collect())
        .collect();
    let pivots = echelon(g, &mut rows, count);
    let is_contradiction = |row: &Vec<Expr>| !g.is_zero(row[count]);
    if rows[pivots.columns.len()..].iter().any(is_contradiction) {
        return None;
    }
    let mut values = vec![g.zero(); count];
    for (row, &column) in rows.iter().zip(&pivots.columns) {
        values[column] = row[count];
    }
    Some(Solved {
        values,
        divisors: pivots.values,
    })
}

/// What an elimination divided by.
#[derive(Clone, Debug, Default)]
pub(crate) struct Pivots {
    /// The columns of the pivots, one for each of the first rows.
    pub(crate) columns: Vec<usize>,
    /// Their values: the result holds where none of them vanishes.
    pub(crate) values: Vec<Expr>,
}

/// Brings rows of closed expressions to reduced echelon form in the first `columns`. A pivot is a number where there is one, since an
/// expression may vanish for some values of parameters.
pub(crate) fn echelon(g: &Graph, rows: &mut [Vec<Expr>], columns: usize) -> Pivots {
    let mut pivots = Pivots::default();
    while pivots.columns.len() < rows.len() {
        let done = pivots.columns.len();
        let places = (done..rows.len()).flat_map(|r| (0..columns).map(move |c| (r, c)));
        let nonzero = places.filter(|&(r, c)| !g.is_zero(rows[r][c]));
        let cost = |&(r, c): &(usize, usize)| {
            (
                g.as_number(rows[r][c]).is_none(),
                g.reachable(&[rows[r][c]]).len(),
            )
        };
        let Some((row, column)) = nonzero.min_by_key(cost) else {
            break;
        };
        rows.swap(done, row);
        let pivot = rows[done][column];
        rows[done] = rows[done]
            .iter()
            .map(|&e| closed(g, g.div(e, pivot)))
            .collect();
        let own = rows[done].clone();
        for (other, line) in rows.iter_mut().enumerate() {
            let factor = line[column];
            if other == done || g.is_zero(factor) {
                continue;
            }
            for (entry, &by) in line.iter_mut().zip(&own) {
                *entry = closed(g, g.sub(*entry, g.mul(&[factor, by])));
            }
        }
        pivots.columns.push(column);
        pivots.values.push(pivot);
    }
    pivots
}

/// The product of a matrix and a vector.
pub(crate) fn times(g: &Graph, rows: &[Vec<Expr>], x: &[Expr]) -> Vec<Expr> {
    let row = |row: &Vec<Expr>| {
        let terms = row.iter().zip(x).map(|(&a, &x)| g.mul(&[a, x]));
        closed(g, g.add(&terms.collect::<Vec<_>>()))
    };
    rows.iter().map(row).collect()
}

/// A basis of the vectors x with `A x = 0`, each with a one where all others have zero, and what was divided by.
pub(crate) fn kernel(g: &Graph, a: &[Vec<Expr>], columns: usize) -> (Vec<Vec<Expr>>, Vec<Expr>) {
    let mut rows = a.to_vec();
    let pivots = echelon(g, &mut rows, columns);
    let free = (0..columns).filter(|column| !pivots.columns.contains(column));
    let vector = |column: usize| {
        let mut vector = vec![g.zero(); columns];
        vector[column] = g.one();
        for (row, &pivot) in rows.iter().zip(&pivots.columns) {
            vector[pivot] = g.neg(row[column]);
        }
        vector
    };
    (free.map(vector).collect(), pivots.values)
}
