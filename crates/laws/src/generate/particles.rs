//! Random systems of particles: positions as functions of the coordinates, or Cartesian coordinates with holonomic constraints.

use super::draw::Draw;
use chetaev_mechanics::system::{Particle, Thrust};
use chetaev_symbolic::{Expr, Graph};

/// The particles and holonomic constraints between their coordinates.
pub(super) struct Particles {
    pub(super) particles: Vec<Particle>,
    pub(super) holonomic: Vec<Expr>,
}

/// Particles whose positions have a Jacobian of rank n everywhere; where they are Cartesian there may be a surface.
pub(super) fn particles(draw: &mut Draw<'_>, masses: &[Expr]) -> Particles {
    let cartesian = draw.one_in(2);
    let n = draw.n();
    let mut left: Vec<Expr> = (0..n)
        .map(|i| {
            if cartesian {
                draw.q(i)
            } else {
                component(draw, i)
            }
        })
        .collect();
    let mut particles = Vec::new();
    while !left.is_empty() {
        let size = left.len().min(1 + draw.index(3));
        let mut position: Vec<Expr> = left.drain(..size).collect();
        if !cartesian && position.len() < 3 && draw.one_in(2) {
            position.push(draw.function(1));
        }
        particles.push(particle(draw, particles.len(), position, masses));
    }
    let holonomic = match cartesian && n > 2 && draw.one_in(2) {
        true => vec![surface(draw)],
        false => Vec::new(),
    };
    Particles {
        particles,
        holonomic,
    }
}

fn particle(draw: &mut Draw<'_>, number: usize, position: Vec<Expr>, masses: &[Expr]) -> Particle {
    let g = draw.g;
    let mass = match masses.get(number) {
        Some(&mass) => mass,
        None => {
            let value = draw.positive();
            g.number(value)
        }
    };
    let force = position
        .iter()
        .map(|_| {
            let i = draw.index(draw.n());
            let scale = draw.coefficient();
            match draw.between(0, 3) {
                0 => draw.function(1),
                1 => g.scale(&scale, draw.v(i)),
                _ => g.zero(),
            }
        })
        .collect();
    Particle {
        name: format!("a_{}", number + 1),
        mass,
        position,
        force,
        thrust: Thrust::default(),
    }
}

/// `q_i` plus a function of one later coordinate, sometimes of the time.
fn component(draw: &mut Draw<'_>, i: usize) -> Expr {
    let (g, q) = (draw.g, draw.q(i));
    let mut parts = vec![q];
    if i + 1 < draw.n() {
        let later = i + 1 + draw.index(draw.n() - i - 1);
        let wave = match draw.between(0, 2) {
            0 => g.powi(draw.q(later), 2),
            1 => g.sin(draw.q(later)),
            _ => g.cos(draw.q(later)),
        };
        let scale = draw.coefficient();
        parts.push(g.scale(&scale, wave));
    }
    if draw.one_in(5) {
        parts.push(g.sin(draw.t()));
    }
    g.add(&parts)
}

/// `q_1 = F(q_2, …)`, or an ellipsoid.
fn surface(draw: &mut Draw<'_>) -> Expr {
    let g = draw.g;
    if draw.one_in(2) {
        let shape = draw.function(2);
        let rest = g.substitute(shape, &[(draw.q(0), g.zero())]);
        return g.sub(draw.q(0), g.add(&[rest, draw.q(1)]));
    }
    let mut squares: Vec<Expr> = (0..draw.n())
        .map(|i| {
            let weight = draw.positive();
            g.scale(&weight, g.powi(draw.q(i), 2))
        })
        .collect();
    squares.push(g.integer(-4));
    g.add(&squares)
}

/// `Σ ½ m r'·r'`.
pub(super) fn kinetic(g: &Graph, names: &[String], particles: &[Particle]) -> Expr {
    let moves = |name: &str| names.iter().any(|n| n == name);
    let mut parts = Vec::new();
    for particle in particles {
        for &r in &particle.position {
            let rate = g.total_derivative(r, &moves);
            parts.push(g.div(g.mul(&[particle.mass, rate, rate]), g.integer(2)));
        }
    }
    g.add(&parts)
}
