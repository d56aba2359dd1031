//! What particles give to a system: kinetic energy, forces, and whether they carry its whole inertia.

use crate::characteristics::Manifold;
use crate::mass;
use crate::prover::Prover;
use crate::system::{Particle, System};
use crate::terms::freeze_accelerations;
use chetaev_symbolic::verdict::Proof;
use chetaev_symbolic::{Expr, Graph, Symbol, Verdict};

/// The velocities r' of a particle, one per component of its position, as functions of (q, v, t).
pub fn velocity(system: &System, particle: &Particle) -> Vec<Expr> {
    let components = particle.position.iter();
    components.map(|&r| system.total_derivative(r)).collect()
}

/// `Σ_a ½ m_a r_a'·r_a'`; zero without particles.
pub fn kinetic_energy(system: &System) -> Expr {
    let g = &system.graph;
    let half = g.div(g.one(), g.integer(2));
    let energies = system.particles.iter().map(|particle| {
        let squared = mass::squared(system, &velocity(system, particle));
        g.mul(&[half, particle.mass, squared])
    });
    g.add(&energies.collect::<Vec<_>>())
}

/// The generalized forces `Σ_a F_a · ∂r_a/∂q^i` of the particles' applied forces, length n.
pub fn applied_forces(system: &System) -> Vec<Expr> {
    generalized_forces(
        &system.graph,
        &system.coordinate_symbols(),
        &system.particles,
    )
}

/// `Σ_a F_a · ∂r_a/∂q^i` for each coordinate.
pub(crate) fn generalized_forces(
    g: &Graph,
    coordinates: &[Symbol],
    particles: &[Particle],
) -> Vec<Expr> {
    let mut parts: Vec<Vec<Expr>> = vec![Vec::new(); coordinates.len()];
    for particle in particles {
        let slopes = g.jacobian(&particle.position, coordinates);
        for (row, &component) in slopes.iter().zip(&particle.force) {
            for (parts, &slope) in parts.iter_mut().zip(row) {
                parts.push(g.mul(&[component, slope]));
            }
        }
    }
    parts.iter().map(|parts| g.add(parts)).collect()
}

/// The generalized forces beside those of the particles, as functions of (q, v, t), length n: what the Lagrangian contains
/// beyond the particles' kinetic energy, `E_i[L - T]`, and the part of Q that is neither their applied nor their reactive
/// forces. They contain no accelerations where the particles carry the whole inertia ([`carry_inertia`]) and no mass contains
/// velocities.
pub fn further_forces(system: &System) -> Vec<Expr> {
    let g = &system.graph;
    let rest = g.sub(system.lagrangian, kinetic_energy(system));
    let drift = freeze_accelerations(system, &g.gradient(rest, &system.velocity_symbols()));
    g.gradient(rest, &system.coordinate_symbols())
        .into_iter()
        .zip(drift)
        .zip(system.forces.iter().zip(own_forces(system)))
        .map(|((slope, drift), (&force, own))| g.add(&[slope, g.neg(drift), force, g.neg(own)]))
        .collect()
}

/// The applied and reactive forces of the particles, as far as they are contained in the forces of the system.
pub fn own_forces(system: &System) -> Vec<Expr> {
    let applied = applied_forces(system);
    if mass::with_velocity(system).is_some() {
        return applied;
    }
    let reactive = mass::reactive_forces(system).into_iter();
    let pairs = applied.into_iter().zip(reactive);
    pairs.map(|(a, b)| system.graph.add(&[a, b])).collect()
}

/// Whether the particles carry the whole inertia: `∂²(L - T)/∂v∂v ≡ 0` for their kinetic energy T. Without particles it is
/// not applicable.
pub fn carry_inertia(system: &System, prover: &Prover) -> Verdict {
    if system.particles.is_empty() {
        return no_particles();
    }
    let (g, velocities) = (&system.graph, system.velocity_symbols());
    let rest = g.sub(system.lagrangian, kinetic_energy(system));
    let hessian = g.jacobian(&g.gradient(rest, &velocities), &velocities);
    let name = |i: usize, j: usize| {
        let (a, b) = (&system.coordinates[i].name, &system.coordinates[j].name);
        format!("∂²(L − Σ ½ m r'·r')/∂{a}'∂{b}'")
    };
    let residuals: Vec<(String, Expr)> = hessian
        .iter()
        .enumerate()
        .flat_map(|(i, row)| row.iter().enumerate().map(move |(j, &e)| (name(i, j), e)))
        .filter(|(_, e)| !g.is_zero(*e))
        .collect();
    if residuals.is_empty() {
        let detail = "the Lagrangian is the kinetic energy of the particles and terms at most linear in the velocities";
        return Verdict::Proved(Proof::structural("identically in q, v, t", detail));
    }
    prover.named_identity(
        system,
        &residuals,
        &Manifold::default(),
        "identically in q, v, t",
    )
}

/// Whether the formulas for particles apply: [`carry_inertia`] is proved.
pub fn suffice(system: &System) -> bool {
    matches!(
        carry_inertia(system, &Prover::default()),
        Verdict::Proved(_)
    )
}

/// The verdict on claims about particles for a model that states none.
pub(crate) fn no_particles() -> Verdict {
    Verdict::not_applicable("model.particles", "the model states no particles")
}

/// The mass that belongs to each coordinate, where the components of the particles' positions are the coordinates, each
/// exactly once.
pub fn coordinate_masses(system: &System) -> Option<Vec<Expr>> {
    let mut masses = vec![None; system.n()];
    for particle in &system.particles {
        for &component in &particle.position {
            let place = system.coordinates.iter().position(|c| c.q == component)?;
            if masses[place].replace(particle.mass).is_some() {
                return None;
            }
        }
    }
    masses.into_iter().collect()
}
