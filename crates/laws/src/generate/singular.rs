//! Lagrangians whose Hessian by the velocities is singular everywhere, and constraints that make up for it, or do not.

use super::constraints::{self, Form};
use super::draw::Draw;
use super::lagrangian;
use chetaev_symbolic::Expr;

/// L and the constraints: T is degenerate in the directions `e_m - u` of some velocities m, which the constraints determine by
/// the others; now and then they do not, and then the accelerations are not unique.
pub(super) fn system(draw: &mut Draw<'_>) -> (Expr, Vec<Expr>) {
    let g = draw.g;
    let order = draw.shuffled();
    let n = order.len();
    let massless = if n > 2 && draw.one_in(3) { 2 } else { 1 };
    let (free, heavy) = order.split_at(massless.min(n - 1));
    let kinetic = kinetic(draw, heavy);
    let mut lagrangian = vec![kinetic, g.neg(lagrangian::potential(draw))];
    if draw.one_in(3) {
        lagrangian.push(lagrangian::gyroscopic(draw));
    }
    let lagrangian = g.add(&lagrangian);
    let rows = if draw.one_in(6) {
        unrelated(draw, heavy)
    } else {
        determining(draw, free, heavy)
    };
    tilted(draw, free, heavy, lagrangian, rows)
}

/// `½ Σ d v² + ½ c (u·v)²` in the velocities given.
fn kinetic(draw: &mut Draw<'_>, heavy: &[usize]) -> Expr {
    let g = draw.g;
    let mut parts = Vec::new();
    for &i in heavy {
        let weight = draw.positive();
        parts.push(g.scale(&weight, g.powi(draw.v(i), 2)));
    }
    let mixed: Vec<Expr> = heavy
        .iter()
        .map(|&i| {
            let factor = draw.function(1);
            g.mul(&[factor, draw.v(i)])
        })
        .collect();
    parts.push(g.powi(g.add(&mixed), 2));
    g.div(g.add(&parts), g.integer(2))
}

/// Each of the velocities `free` by those after it.
fn determining(draw: &mut Draw<'_>, free: &[usize], heavy: &[usize]) -> Vec<Expr> {
    let g = draw.g;
    let mut rows = Vec::new();
    for (l, &m) in free.iter().enumerate() {
        let pivot = draw.nowhere_zero();
        let mut parts = vec![g.mul(&[pivot, draw.v(m)])];
        for &i in free[l + 1..].iter().chain(heavy) {
            if i == heavy[0] || draw.one_in(2) {
                let slope = draw.function(1);
                let power = if draw.one_in(5) { 2 } else { 1 };
                parts.push(g.mul(&[slope, g.powi(draw.v(i), power)]));
            }
        }
        rows.push(g.add(&parts));
    }
    rows
}

/// A constraint on the heavy velocities alone: the others stay undetermined.
fn unrelated(draw: &mut Draw<'_>, heavy: &[usize]) -> Vec<Expr> {
    let g = draw.g;
    match heavy {
        [i, j, ..] => {
            let slope = draw.function(1);
            vec![g.sub(draw.v(*i), g.mul(&[slope, draw.v(*j)]))]
        }
        _ => constraints::linear(draw, 1, Form::Linear),
    }
}

/// Tilts the degenerate direction: heavy velocities v become v + u v_m in all but the potential part.
fn tilted(
    draw: &mut Draw<'_>,
    free: &[usize],
    heavy: &[usize],
    lagrangian: Expr,
    rows: Vec<Expr>,
) -> (Expr, Vec<Expr>) {
    if draw.one_in(2) {
        return (lagrangian, rows);
    }
    let g = draw.g;
    let slope = draw.function(1);
    let (v, m) = (draw.v(heavy[0]), draw.v(free[0]));
    let pair = [(v, g.add(&[v, g.mul(&[slope, m])]))];
    let rows = g.substitute_all(&rows, &pair);
    (g.substitute(lagrangian, &pair), rows)
}
