//! Newton's statement of the principle of the second kind, for systems of particles.
//!
//! `Σ_a (F_a + R_a − m_a Du_a)·δr_a + Σ_a m_a (Dr_a − u_a)·δu_a = 0` for virtual δr and arbitrary δu (Zhu; T1 (32)), where in
//! coordinates `r = r(q, t)`, `u = ∂r/∂t + Σ ∂r/∂q^s v^s`, `δr = Σ ∂r/∂q^s δq^s` and
//! `δu = Σ ∂r/∂q^s δv^s + Σ ∂u/∂q^s δq^s`; R is the thrust where masses vary.

use super::StateJet;
use crate::linear::dot;
use crate::mass;
use crate::particles;
use crate::system::System;
use chetaev_symbolic::Expr;

/// The coefficients of the principle, each of length n.
pub(super) struct Coefficients {
    /// Of δv^s.
    pub(super) velocities: Vec<Expr>,
    /// Of −δq^s.
    pub(super) coordinates: Vec<Expr>,
}

/// Whether the statement applies: the particles carry the whole inertia, and no mass contains coordinates or velocities,
/// along which it would change otherwise than by D.
pub(super) fn applies(system: &System) -> bool {
    let mut symbols = system.coordinate_symbols();
    symbols.extend(system.velocity_symbols());
    let mut particles = system.particles.iter();
    particles.all(|p| mass::first_symbol(system, p.mass, &symbols).is_none())
        && particles::suffice(system)
}

/// `Σ m (Dr − u)·∂r/∂q^s` and `Σ (m Du − F − R)·∂r/∂q^s − Σ m (Dr − u)·∂u/∂q^s`, with what the Lagrangian and the forces contain
/// beside the particles as in Lagrange's statement.
pub(super) fn of_particles(system: &System, jet: &StateJet) -> Coefficients {
    let (g, symbols) = (&system.graph, system.coordinate_symbols());
    let beside = g.sub(system.lagrangian, particles::kinetic_energy(system));
    let own = particles::own_forces(system).into_iter();
    let forces: Vec<Expr> = own
        .zip(&system.forces)
        .map(|(own, &whole)| g.sub(whole, own))
        .collect();
    let mut sum = of_lagrangian(system, jet, beside, &forces);
    for particle in &system.particles {
        let velocity = particles::velocity(system, particle);
        let moved = jet.derive(system, &particle.position);
        let accelerated = jet.derive(system, &velocity);
        let slopes = g.jacobian(&particle.position, &symbols);
        let turned = g.jacobian(&velocity, &symbols);
        let thrust = mass::thrust(system, particle);
        for (i, &u) in velocity.iter().enumerate() {
            let gap = g.mul(&[particle.mass, g.sub(moved[i], u)]);
            let inertia = g.mul(&[particle.mass, accelerated[i]]);
            let unbalanced = g.add(&[inertia, g.neg(particle.force[i]), g.neg(thrust[i])]);
            for s in 0..system.n() {
                let (of_v, of_q) = (&mut sum.velocities[s], &mut sum.coordinates[s]);
                *of_v = g.add(&[*of_v, g.mul(&[gap, slopes[i][s]])]);
                let turning = g.neg(g.mul(&[gap, turned[i][s]]));
                *of_q = g.add(&[*of_q, g.mul(&[unbalanced, slopes[i][s]]), turning]);
            }
        }
    }
    sum
}

/// `Σ_j L_{v^s v^j} (Dq^j − v^j)` and `D(∂L/∂v^s) − ∂L/∂q^s − Q_s − Σ_j (Dq^j − v^j) L_{v^j q^s}` (T1 (34)).
pub(super) fn of_lagrangian(
    system: &System,
    jet: &StateJet,
    lagrangian: Expr,
    forces: &[Expr],
) -> Coefficients {
    let g = &system.graph;
    let momenta = g.gradient(lagrangian, &system.velocity_symbols());
    let slopes = g.gradient(lagrangian, &system.coordinate_symbols());
    let hessian = g.jacobian(&momenta, &system.velocity_symbols());
    let mixed = g.jacobian(&momenta, &system.coordinate_symbols());
    let pairs = jet.coordinates.iter().zip(&system.coordinates);
    let gap: Vec<Expr> = pairs.map(|(&rate, c)| g.sub(rate, c.v)).collect();
    let rates = jet.derive(system, &momenta);
    let coordinate = |s: usize| {
        let turning = dot(g, mixed.iter().map(|row| &row[s]), &gap);
        g.add(&[rates[s], g.neg(slopes[s]), g.neg(forces[s]), g.neg(turning)])
    };
    Coefficients {
        velocities: hessian.iter().map(|row| dot(g, row, &gap)).collect(),
        coordinates: (0..system.n()).map(coordinate).collect(),
    }
}

/// The differences of the two statements, and of the generalized relations `D(∂r/∂q^s) = ∂u/∂q^s + Σ_j (Dq^j − v^j)
/// ∂²r/∂q^s∂q^j` of Lagrange (T1 (33)): zero for all curves.
pub(super) fn residuals(system: &System, jet: &StateJet) -> (Vec<Expr>, Vec<Expr>) {
    let (g, symbols) = (&system.graph, system.coordinate_symbols());
    let newton = of_particles(system, jet);
    let lagrange = of_lagrangian(system, jet, system.lagrangian, &system.forces);
    let pairs = newton.velocities.iter().zip(&lagrange.velocities);
    let further = newton.coordinates.iter().zip(&lagrange.coordinates);
    let statements = pairs.chain(further).map(|(&a, &b)| g.sub(a, b)).collect();
    let pairs = jet.coordinates.iter().zip(&system.coordinates);
    let gap: Vec<Expr> = pairs.map(|(&rate, c)| g.sub(rate, c.v)).collect();
    let mut relations = Vec::new();
    for particle in &system.particles {
        let slopes = g.jacobian(&particle.position, &symbols);
        let turned = g.jacobian(&particles::velocity(system, particle), &symbols);
        for (row, turned) in slopes.iter().zip(turned) {
            let second = g.jacobian(row, &symbols);
            let moved = jet.derive(system, row);
            for (s, moved) in moved.into_iter().enumerate() {
                let right = g.add(&[turned[s], dot(g, &second[s], &gap)]);
                relations.push(g.sub(moved, right));
            }
        }
    }
    (statements, relations)
}
