//! Systems of few terms: of these, unlike of those with functions everywhere, some motions make the action stationary and others
//! do not.

use super::draw::Draw;
use super::named;
use chetaev_mechanics::SystemParts;
use chetaev_symbolic::Expr;

/// L of constant masses with a potential of one term, and one constraint of two or three terms, some of them affine,
/// quadratic or with the time.
pub(super) fn system(draw: &mut Draw<'_>, masses: &[Expr]) -> SystemParts {
    let g = draw.g;
    let mut parts: Vec<Expr> = (0..draw.n())
        .map(|i| {
            let weight = masses.get(i).copied().unwrap_or(g.one());
            let half = g.div(weight, g.integer(2));
            g.mul(&[half, g.powi(draw.v(i), 2)])
        })
        .collect();
    if draw.one_in(2) {
        let place = draw.index(draw.n());
        let power = 1 + draw.index(2) as i64;
        let strength = draw.coefficient();
        parts.push(g.scale(&strength, g.powi(draw.q(place), power)));
    }
    let row = constraint(draw);
    SystemParts {
        lagrangian: Some(g.add(&parts)),
        constraints: named(vec![row]),
        ..SystemParts::default()
    }
}

/// The last velocity by one or two others.
fn constraint(draw: &mut Draw<'_>) -> Expr {
    let (g, last) = (draw.g, draw.n() - 1);
    let mut parts = vec![draw.v(last)];
    for _ in 0..1 + draw.index(2) {
        let (i, j) = (draw.index(last), draw.index(draw.n()));
        let weight = match draw.index(5) {
            0 => g.sin(draw.q(j)),
            1 => g.powi(draw.q(j), 2),
            2 => draw.t(),
            _ => draw.q(j),
        };
        let power = match draw.one_in(6) {
            true => 2,
            false => 1,
        };
        let strength = draw.coefficient();
        parts.push(g.scale(&strength, g.mul(&[weight, g.powi(draw.v(i), power)])));
    }
    if draw.one_in(4) {
        parts.push(g.number(draw.coefficient()));
    }
    g.add(&parts)
}
