//! Systems with a known first integral: a symmetric system in simple coordinates, pushed through a random change of coordinates
//! and described in a random frame.

use super::constraints::{self, Form};
use super::draw::{Draw, Kind};
use super::{change, frames, named};
use chetaev_mechanics::SystemParts;
use chetaev_symbolic::{Expr, Graph};

/// In the simple coordinates x.
struct Plain {
    lagrangian: Expr,
    rows: Vec<Expr>,
    integral: Expr,
}

/// A system that states its integral.
pub(super) fn system(draw: &mut Draw<'_>, masses: &[Expr]) -> SystemParts {
    let names = (1..=draw.n()).map(|i| format!("x_{i}")).collect();
    let names = std::mem::replace(&mut draw.names, names);
    let plain = match draw.between(0, 2) {
        0 if draw.n() > 3 => moment(draw, masses),
        0 | 1 => momentum(draw, masses),
        _ => part_of_energy(draw, masses),
    };
    let simple = std::mem::replace(&mut draw.names, names);
    let pushed = pushed(draw, &simple, &plain);
    SystemParts {
        lagrangian: Some(pushed.lagrangian),
        constraints: named(pushed.rows),
        integrals: vec![("known".into(), pushed.integral)],
        quasi_velocities: frames::unimodular(draw),
        ..SystemParts::default()
    }
}

/// The last coordinate occurs nowhere and its velocity in no constraint: its momentum is kept.
fn momentum(draw: &mut Draw<'_>, masses: &[Expr]) -> Plain {
    let (g, last) = (draw.g, draw.n() - 1);
    let v = draw.v(last);
    let weight = draw.positive();
    let (rest, slope, other, shift) = among(draw, last, |draw| {
        let other = draw.v(draw.n() - 1);
        (block(draw, masses), slope(draw), other, slope(draw))
    });
    let mixed = g.add(&[v, g.mul(&[slope, other])]);
    let mut parts = vec![rest.lagrangian, g.scale(&weight, g.powi(mixed, 2))];
    if draw.one_in(2) {
        parts.push(g.mul(&[shift, v]));
    }
    let lagrangian = g.add(&parts);
    Plain {
        lagrangian,
        rows: rest.rows,
        integral: derivative(g, lagrangian, &draw.names[last]),
    }
}

/// The last two coordinates turn: their moment of momentum is kept.
fn moment(draw: &mut Draw<'_>, masses: &[Expr]) -> Plain {
    let (g, n) = (draw.g, draw.n());
    let (x, y) = (draw.q(n - 2), draw.q(n - 1));
    let (u, v) = (draw.v(n - 2), draw.v(n - 1));
    let (rest, weight, spring) = among(draw, n - 2, |draw| {
        let weight = match draw.kind {
            Kind::Polynomial => g.number(draw.positive()),
            Kind::Trigonometric => draw.nowhere_zero(),
        };
        (block(draw, masses), weight, slope(draw))
    });
    let square = |a, b| g.add(&[g.powi(a, 2), g.powi(b, 2)]);
    let turning = g.sub(
        g.div(g.mul(&[weight, square(u, v)]), g.integer(2)),
        g.mul(&[spring, square(x, y)]),
    );
    let area = g.sub(g.mul(&[x, v]), g.mul(&[y, u]));
    Plain {
        lagrangian: g.add(&[rest.lagrangian, turning]),
        rows: rest.rows,
        integral: g.mul(&[weight, area]),
    }
}

/// The last coordinate moves by itself: its energy is kept.
fn part_of_energy(draw: &mut Draw<'_>, masses: &[Expr]) -> Plain {
    let (g, last) = (draw.g, draw.n() - 1);
    let (x, v) = (draw.q(last), draw.v(last));
    let rest = among(draw, last, |draw| block(draw, masses));
    let weight = draw.positive();
    let kinetic = g.scale(&weight, g.powi(v, 2));
    let depth = draw.coefficient();
    let potential = match draw.kind {
        Kind::Polynomial => g.powi(x, draw.between(1, 2)),
        Kind::Trigonometric => g.cos(x),
    };
    let potential = g.scale(&depth, potential);
    Plain {
        lagrangian: g.add(&[rest.lagrangian, kinetic, g.neg(potential)]),
        rows: rest.rows,
        integral: g.add(&[kinetic, potential]),
    }
}

/// Draws something that contains the first `count` coordinates only.
fn among<T>(draw: &mut Draw<'_>, count: usize, make: impl FnOnce(&mut Draw<'_>) -> T) -> T {
    let fewer = draw.names[..count].to_vec();
    let names = std::mem::replace(&mut draw.names, fewer);
    let visible = std::mem::replace(&mut draw.visible, (0..count).collect());
    let made = make(draw);
    (draw.names, draw.visible) = (names, visible);
    made
}

/// A constrained system without integrals of its own, except by chance.
fn block(draw: &mut Draw<'_>, masses: &[Expr]) -> Plain {
    let g = draw.g;
    let mut parts = Vec::new();
    for i in 0..draw.n() {
        let weight = match masses.get(i) {
            Some(&mass) => mass,
            None => g.number(draw.positive()),
        };
        let slope = slope(draw);
        let square = g.powi(draw.v(i), 2);
        parts.push(g.div(g.mul(&[weight, square]), g.integer(2)));
        parts.push(slope);
    }
    let form = match draw.between(0, 2) {
        0 => Form::Rheonomic,
        _ => Form::Linear,
    };
    let rows = match draw.one_in(5) {
        true => constraints::nonlinear(draw),
        false => constraints::linear(draw, 1, form),
    };
    Plain {
        lagrangian: g.add(&parts),
        rows,
        integral: g.zero(),
    }
}

/// A small function of the coordinates: after the change it is still one of low degree.
fn slope(draw: &mut Draw<'_>) -> Expr {
    let g = draw.g;
    let scale = draw.coefficient();
    let place = draw.index(draw.n());
    let x = draw.q(place);
    g.scale(
        &scale,
        match draw.kind {
            Kind::Polynomial => x,
            Kind::Trigonometric => g.sin(x),
        },
    )
}

/// ∂e/∂v by the name of the coordinate.
fn derivative(g: &Graph, e: Expr, name: &str) -> Expr {
    g.diff(e, g.intern_symbol(name, 1))
}

/// The system in the coordinates of `draw`, x = Φ(q, t).
fn pushed(draw: &mut Draw<'_>, simple: &[String], plain: &Plain) -> Plain {
    let g = draw.g;
    let q: Vec<Expr> = (0..draw.n()).map(|i| draw.q(i)).collect();
    let t = draw.one_in(5).then(|| draw.t());
    let straight = draw.kind == Kind::Trigonometric || draw.n() > 3;
    let x = change(g, &mut draw.random, &q, t, straight);
    let moves = |name: &str| draw.names.iter().any(|q| q == name);
    let pairs: Vec<(Expr, Expr)> = simple
        .iter()
        .zip(&x)
        .flat_map(|(name, &x)| {
            let rate = g.total_derivative(x, &moves);
            [(g.symbol(name, 0), x), (g.symbol(name, 1), rate)]
        })
        .collect();
    Plain {
        lagrangian: g.substitute(plain.lagrangian, &pairs),
        rows: g.substitute_all(&plain.rows, &pairs),
        integral: g.substitute(plain.integral, &pairs),
    }
}
