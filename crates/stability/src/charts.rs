//! Steady motions where the speeds of one choice do not serve: another choice of independent velocities sees them.
//!
//! Independent velocities are coordinates of the directions that the constraints allow; where a minor of the gradients of the constraints vanishes the
//! velocities by them have poles. Each choice is a chart, and the motions of all charts together are all motions.

use crate::admissible_values::place_of;
use crate::real_roots::sign_of;
use crate::steady::closed;
use crate::steady_motions::{Found, SteadySet};
use crate::steady_value::{precision, Value};
use chetaev_mechanics::system::{Assumption, Relation};
use chetaev_mechanics::{Selection, System};
use chetaev_symbolic::matrix::determinant;
use chetaev_symbolic::number::ball::Ball;
use chetaev_symbolic::{Expr, Graph, Symbol};
use std::cmp::Ordering;

/// More choices are not tried.
const CHARTS: usize = 6;

/// The other choices of dependent velocities.
pub(crate) fn other_charts(selection: &Selection, choices: Vec<Vec<usize>>) -> Vec<Selection> {
    let others = choices
        .into_iter()
        .filter(|own| *own != selection.dependent);
    let chart = |dependent: Vec<usize>| Selection {
        rows: selection.rows.clone(),
        dependent,
    };
    others.map(chart).take(CHARTS).collect()
}

/// A set of motions with those of another chart where its own equations are not defined; the set as it was where one of these cannot be written in
/// its variables.
pub(crate) fn union(system: &System, own: &mut SteadySet, other: &SteadySet) {
    let g = &system.graph;
    let mut unseen = Vec::new();
    for found in &other.found {
        let Some(at) = values_along(system, found) else {
            if is_seen(g, own, (other, found)) {
                continue;
            }
            return;
        };
        let vanishes = |&e: &Expr| {
            let value = closed(g, g.substitute(e, &along(system, own, &at)));
            g.is_zero(value)
        };
        if own.excluded.iter().any(vanishes) {
            match in_variables(system, own, found, &at) {
                Some(found) => unseen.push(found),
                None => return,
            }
        }
    }
    own.found.extend(unseen);
    // Nothing is said where a function of each chart vanishes.
    let mut both = Vec::new();
    for &a in &own.excluded {
        for &b in &other.excluded {
            let own = if a == b {
                a
            } else {
                g.add(&[g.powi(a, 2), g.powi(b, 2)])
            };
            if !both.contains(&own) {
                both.push(own);
            }
        }
    }
    own.excluded = both;
}

/// Whether a single motion without closed form lies where a chart serves: none of what was divided by vanishes in its enclosure.
fn is_seen(g: &Graph, own: &SteadySet, (other, found): (&SteadySet, &Found)) -> bool {
    let value = |s: Symbol| {
        let name = g.symbol_text(s);
        let at = other.variables.iter().position(|own| *own == name)?;
        match found.values.get(at)? {
            Value::Number { ball, .. } => Some(ball.clone()),
            _ => None,
        }
    };
    let enclosed = g.enclose(&own.excluded, &precision(), &value);
    enclosed.is_ok_and(|all| all.iter().all(Ball::excludes_zero))
}

/// Positions and velocities of a motion.
fn values_along(system: &System, found: &Found) -> Option<Vec<(Expr, Expr)>> {
    Some(place_of(system, found.motion.as_ref()?))
}

/// The same with the speeds of a set.
fn along(system: &System, own: &SteadySet, at: &[(Expr, Expr)]) -> Vec<(Expr, Expr)> {
    let g = &system.graph;
    let speeds = own.speeds.iter().map(|(name, definition)| {
        let value = closed(g, g.substitute(*definition, at));
        (g.symbol(name, 0), value)
    });
    at.iter().copied().chain(speeds).collect()
}

/// A motion of another chart in the variables of a set.
fn in_variables(
    system: &System,
    own: &SteadySet,
    found: &Found,
    at: &[(Expr, Expr)],
) -> Option<Found> {
    let g = &system.graph;
    let all = own.variables.iter().map(|name| -> Option<Value> {
        let coordinate = system.coordinates.iter().find(|c| c.name == *name);
        let speed = || own.speeds.iter().find(|(speed, _)| speed == name);
        let velocity = || {
            let mut all = system.coordinates.iter();
            all.find(|c| name.strip_suffix('\'') == Some(c.name.as_str()))
        };
        let e = coordinate
            .map(|c| c.q)
            .or_else(|| speed().map(|own| own.1))
            .or_else(|| velocity().map(|c| c.v))?;
        let value = closed(g, g.substitute(e, at));
        if !found.free.is_empty() {
            return Some(Value::Function(value));
        }
        let ball = g.enclose(&[value], &precision(), &|_| None).ok()?.pop()?;
        Some(Value::Number {
            exact: Some(value),
            ball,
        })
    });
    let values: Vec<Value> = all.collect::<Option<_>>()?;
    let free = found.free.iter().map(|&(symbol, _)| {
        let is_own = |value: &Value| matches!(value, Value::Function(e) if *e == symbol);
        Some((symbol, values.iter().position(is_own)?))
    });
    Some(Found {
        free: free.collect::<Option<_>>()?,
        values,
        ..found.clone()
    })
}

/// Whether a matrix is singular at these values of unknowns and of parameters.
pub(crate) fn is_singular_at(g: &Graph, rows: &[Vec<Expr>], lists: [&[(Expr, Expr)]; 2]) -> bool {
    let [unknowns, values] = lists;
    let put = |&e: &Expr| closed(g, g.substitute(g.substitute(e, unknowns), values));
    let rows: Vec<Vec<Expr>> = rows
        .iter()
        .map(|row| row.iter().map(put).collect())
        .collect();
    !rows.is_empty() && g.is_zero(closed(g, determinant(g, &rows)))
}

/// Whether nothing that the model assumes is proved not to hold along a motion. What is assumed of coordinates that may be anywhere is no
/// condition on it.
pub(crate) fn is_assumed(
    system: &System,
    found: &Found,
    (values, anywhere): (&[(Expr, Expr)], &[Symbol]),
) -> bool {
    let g = &system.graph;
    let at = values_along(system, found).unwrap_or_default();
    let fails = |sign: Ordering, relation: Relation| match relation {
        Relation::Less => sign != Ordering::Less,
        Relation::LessOrEqual => sign == Ordering::Greater,
        Relation::NotEqual => sign == Ordering::Equal,
    };
    let is_of_motion = |own: &&Assumption| !g.any_contains_any(&[own.left, own.right], anywhere);
    let mut all = system.assumptions.iter().filter(is_of_motion);
    !all.any(|own| {
        let e = g.substitute(g.sub(own.left, own.right), &at);
        let e = closed(g, g.substitute(e, values));
        let is_number = g.symbols_in(&[e]).is_empty();
        is_number && sign_of(g, e).is_some_and(|sign| fails(sign, own.relation))
    })
}
