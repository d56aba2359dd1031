//! Masses that vary, and thrust.

use super::draw::Draw;
use chetaev_mechanics::system::{Particle, Thrust};
use chetaev_symbolic::Expr;

/// Gives most particles a mass that varies and a thrust; the laws of the masses that have their own, by name.
pub(super) fn vary(
    draw: &mut Draw<'_>,
    particles: &mut [Particle],
    velocities: bool,
) -> Vec<(String, Expr)> {
    let mut laws = Vec::new();
    for (number, particle) in particles.iter_mut().enumerate() {
        // The first one always, so that every system has a mass that varies.
        if number > 0 && draw.one_in(3) {
            continue;
        }
        particle.mass = match number == 0 && velocities {
            true => of_velocity(draw, particle.mass),
            false => mass(draw, particle.mass, &mut laws),
        };
        particle.thrust = thrust(draw, particle.position.len());
    }
    laws
}

/// A positive function of t and q, or a mass with a law of its own and what does not change with it.
fn mass(draw: &mut Draw<'_>, constant: Expr, laws: &mut Vec<(String, Expr)>) -> Expr {
    let g = draw.g;
    let i = draw.index(draw.n());
    let varying = match draw.between(0, 4) {
        0 => g.powi(draw.t(), 2),
        1 => g.exp(draw.t()),
        2 => g.powi(draw.q(i), 2),
        _ => own_law(draw, laws),
    };
    let scale = draw.positive();
    g.add(&[constant, g.scale(&scale, varying)])
}

/// A new mass with its law.
fn own_law(draw: &mut Draw<'_>, laws: &mut Vec<(String, Expr)>) -> Expr {
    let g = draw.g;
    let name = format!("M_{}", laws.len() + 1);
    let mass = g.symbol(&name, 0);
    let (i, scale) = (draw.index(draw.n()), draw.coefficient());
    let rate = match draw.between(0, 3) {
        0 => mass,
        1 => g.add(&[g.mul(&[mass, draw.q(i)]), draw.t()]),
        2 => g.mul(&[mass, draw.v(i)]),
        _ => g.add(&[g.powi(draw.v(i), 2), mass]),
    };
    laws.push((name, g.scale(&scale, rate)));
    mass
}

/// A positive function that contains velocities.
fn of_velocity(draw: &mut Draw<'_>, constant: Expr) -> Expr {
    let g = draw.g;
    let (i, j) = (draw.index(draw.n()), draw.index(draw.n()));
    let scale = draw.positive();
    let square = match draw.between(0, 2) {
        0 => draw.v(i),
        1 => g.add(&[draw.v(i), draw.q(j)]),
        _ => g.mul(&[draw.v(i), draw.q(j)]),
    };
    g.add(&[constant, g.scale(&scale, g.powi(square, 2))])
}

/// Any mode; against the velocity now and then only, as its root is costly.
fn thrust(draw: &mut Draw<'_>, components: usize) -> Thrust {
    let vector = |draw: &mut Draw<'_>| -> Vec<Expr> {
        (0..components)
            .map(|_| {
                let i = draw.index(draw.n());
                let scale = draw.coefficient();
                match draw.between(0, 3) {
                    0 => draw.function(1),
                    1 => draw.g.scale(&scale, draw.v(i)),
                    _ => draw.g.number(scale),
                }
            })
            .collect()
    };
    match draw.between(0, 8) {
        0 => Thrust::Isotropic,
        1 => {
            let speed = draw.positive();
            Thrust::ExhaustSpeed(draw.g.number(speed))
        }
        2 | 3 => Thrust::Force(vector(draw)),
        4 | 5 => Thrust::AbsoluteVelocity(vector(draw)),
        _ => Thrust::RelativeVelocity(vector(draw)),
    }
}
