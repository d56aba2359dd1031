//! Random Lagrangians and forces; the Hessian by the velocities is positive definite by construction.

use super::draw::Draw;
use chetaev_symbolic::{Expr, Function};

/// `T = ½ Σ dᵢ vᵢ² + ½ Σ c (u·v)²` with constants `dᵢ, c > 0` and functions u of the coordinates: W = diag d + Σ c u uᵀ.
///
/// `masses` are parameters assumed positive that stand for the first `dᵢ`.
pub(super) fn kinetic(draw: &mut Draw<'_>, masses: &[Expr]) -> Expr {
    let g = draw.g;
    let mut parts = Vec::new();
    for i in 0..draw.n() {
        let weight = match masses.get(i) {
            Some(&mass) => mass,
            None => {
                let value = draw.positive();
                g.number(value)
            }
        };
        parts.push(g.mul(&[weight, g.powi(draw.v(i), 2)]));
    }
    for _ in 0..1 + draw.index(2) {
        let direction = direction(draw);
        let scale = draw.positive();
        parts.push(g.scale(&scale, g.powi(direction, 2)));
    }
    g.div(g.add(&parts), g.integer(2))
}

/// `u·v` with two or three components, one of them a function of the coordinates.
fn direction(draw: &mut Draw<'_>) -> Expr {
    let g = draw.g;
    let order = draw.shuffled();
    let count = order.len().min(2 + draw.index(2));
    let parts: Vec<Expr> = order[..count]
        .iter()
        .enumerate()
        .map(|(position, &i)| {
            let factor = if position == 0 || draw.one_in(3) {
                draw.function(2)
            } else {
                let value = draw.coefficient();
                g.number(value)
            };
            g.mul(&[factor, draw.v(i)])
        })
        .collect();
    g.add(&parts)
}

/// V, a function of the coordinates.
pub(super) fn potential(draw: &mut Draw<'_>) -> Expr {
    draw.function(3)
}

/// Terms linear in the velocities, gyroscopic where they are no total derivative.
pub(super) fn gyroscopic(draw: &mut Draw<'_>) -> Expr {
    let i = draw.index(draw.n());
    let factor = draw.function(2);
    draw.g.mul(&[factor, draw.v(i)])
}

/// A term that depends on the time: a moved potential, or a velocity relative to something that moves.
pub(super) fn moving(draw: &mut Draw<'_>) -> Expr {
    let (g, t) = (draw.g, draw.t());
    let i = draw.index(draw.n());
    let factor = draw.function(1);
    match draw.between(0, 2) {
        0 => g.mul(&[t, factor]),
        1 => {
            let q = draw.visible[i % draw.visible.len()];
            g.mul(&[g.cos(t), draw.q(q)])
        }
        _ => g.mul(&[g.add(&[t, factor]), draw.v(i)]),
    }
}

/// A convex, not quadratic function of the velocities, so that the Hessian stays positive definite.
pub(super) fn convex(draw: &mut Draw<'_>) -> Expr {
    let g = draw.g;
    let i = draw.index(draw.n());
    let j = draw.other(&[i]);
    let (vi, vj) = (draw.v(i), draw.v(j));
    let squares = g.add(&[g.powi(vi, 2), g.powi(vj, 2)]);
    let scale = draw.positive();
    let e = match draw.between(0, 5) {
        0 => g.powi(vi, 4),
        1 => g.powi(squares, 2),
        2 => {
            let mixed = direction(draw);
            g.powi(mixed, 4)
        }
        3 => {
            let weight = draw.nowhere_zero();
            g.mul(&[weight, g.powi(vi, 4)])
        }
        4 => g.apply(Function::Cosh, &[vi]),
        _ => g.sqrt(g.add(&[g.one(), squares])),
    };
    g.scale(&scale, e)
}

/// Generalized forces by coordinate: dissipation, circulatory and driven ones.
pub(super) fn forces(draw: &mut Draw<'_>, driven: bool) -> Vec<(String, Expr)> {
    let g = draw.g;
    let mut forces = Vec::new();
    for i in 0..draw.n() {
        if !draw.one_in(3) {
            continue;
        }
        let j = draw.index(draw.n());
        let scale = draw.coefficient();
        let value = match draw.between(0, 3) {
            0 => g.scale(&-draw.positive(), draw.v(i)),
            1 => draw.function(2),
            2 if driven => g.sin(draw.t()),
            2 => g.mul(&[draw.v(j), draw.v(j), draw.v(i)]),
            _ => {
                let factor = draw.function(1);
                g.mul(&[factor, draw.v(j)])
            }
        };
        forces.push((draw.names[i].clone(), g.scale(&scale, value)));
    }
    forces
}
