//! Particles of variable mass: thrust, reactive forces, and the particle law (Meshchersky 1897; T2 §1).
//!
//! A particle of mass μ at ξ obeys `μ ξ'' = X + R + (reaction)`, where `R = μ' u` and u is the velocity of the matter that
//! leaves or arrives relative to the particle. In coordinates, with `ξ = ξ(q, t)`, this is `𝓛_s[T] = Q_s + Ψ_s + …` with
//! the reactive forces
//!
//! `Ψ_s = Σ { (R + μ' ξ')·∂ξ/∂q^s − ½ ξ'·ξ' ∂μ/∂q^s + D(½ ξ'·ξ' ∂μ/∂v^s) }` (T2 (3)).
//!
//! They are functions of (q, v, t) and of the masses where no mass contains velocities. Where one does, μ' contains
//! accelerations, and the equations are built from the particle law itself.

use crate::linear::dot;
use crate::particles;
use crate::system::{Particle, System, SystemError, Thrust};
use chetaev_symbolic::{Expr, Symbol};

/// The masses of a model that states its kinetic energy, as symbols in it.
#[derive(Clone, Debug)]
pub struct NamedMasses {
    /// T, or L where T is not stated, with the masses as symbols.
    pub inertia: Expr,
    /// Whether it is T.
    pub is_kinetic: bool,
    /// Symbols and values of the masses; a mass with a law of its own is its own value.
    pub masses: Vec<(Expr, Expr)>,
}

/// Whether an expression varies along the motion: with the time, the coordinates, controls or masses.
pub fn varies(system: &System, e: Expr) -> bool {
    let g = &system.graph;
    !g.is_free_of(e, &|s| {
        let name = g.symbol_name(s);
        name == "t" || system.moves(name)
    })
}

/// Whether a mass of the system varies: of a particle, or one with a law of its own.
pub fn any_varies(system: &System) -> bool {
    let mut particles = system.particles.iter();
    !system.masses.is_empty() || particles.any(|p| varies(system, p.mass))
}

/// Whether the mass of a particle varies, or a thrust on it is stated.
fn acts(system: &System, particle: &Particle) -> bool {
    matches!(particle.thrust, Thrust::Force(_)) || varies(system, particle.mass)
}

/// The first particle whose mass contains a velocity, with that velocity.
pub fn with_velocity(system: &System) -> Option<(&Particle, Symbol)> {
    system.particles.iter().find_map(|particle| {
        let symbol = first_symbol(system, particle.mass, &system.velocity_symbols())?;
        Some((particle, symbol))
    })
}

/// The first of `symbols` that occurs in `e`.
pub(crate) fn first_symbol(system: &System, e: Expr, symbols: &[Symbol]) -> Option<Symbol> {
    let g = &system.graph;
    let mut wanted = symbols.iter().copied();
    wanted.find(|&symbol| g.contains_any(e, &[symbol]))
}

/// R on the jet (q, v, a, t): the thrust on a particle, as many components as its position has.
pub fn thrust(system: &System, particle: &Particle) -> Vec<Expr> {
    let g = &system.graph;
    if let Thrust::Force(thrust) = &particle.thrust {
        return thrust.clone();
    }
    let rate = system.total_derivative(particle.mass);
    let ejected = ejection(system, particle).into_iter();
    ejected.map(|u| g.mul(&[rate, u])).collect()
}

/// X + R, the applied force and the thrust on a particle.
pub(crate) fn force_with_thrust(system: &System, particle: &Particle) -> Vec<Expr> {
    let thrust = thrust(system, particle).into_iter();
    let pairs = thrust.zip(&particle.force);
    pairs
        .map(|(thrust, &force)| system.graph.add(&[force, thrust]))
        .collect()
}

/// u, the velocity relative to the particle of the matter that it loses or gains; zero where the thrust itself is stated.
pub fn ejection(system: &System, particle: &Particle) -> Vec<Expr> {
    let g = &system.graph;
    match &particle.thrust {
        Thrust::Isotropic | Thrust::Force(_) => vec![g.zero(); particle.position.len()],
        Thrust::RelativeVelocity(velocity) => velocity.clone(),
        Thrust::AbsoluteVelocity(velocity) => {
            let own = particles::velocity(system, particle).into_iter();
            own.zip(velocity).map(|(own, &w)| g.sub(w, own)).collect()
        }
        Thrust::ExhaustSpeed(speed) => {
            let own = particles::velocity(system, particle);
            let size = g.sqrt(squared(system, &own));
            let along = |component| g.neg(g.div(g.mul(&[*speed, component]), size));
            own.into_iter().map(along).collect()
        }
    }
}

/// `ξ'·ξ'`.
pub(crate) fn squared(system: &System, vector: &[Expr]) -> Expr {
    let g = &system.graph;
    g.add(&vector.iter().map(|&e| g.powi(e, 2)).collect::<Vec<_>>())
}

/// The reactive forces Ψ_s of the particles on the jet (q, v, a, t) (T2 (3)), length n. Accelerations occur only where a
/// mass contains velocities.
pub fn reactive_forces(system: &System) -> Vec<Expr> {
    let g = &system.graph;
    let mut forces = vec![Vec::new(); system.n()];
    for particle in system.particles.iter().filter(|p| acts(system, p)) {
        let thrust = thrust(system, particle);
        let velocity = particles::velocity(system, particle);
        let rate = system.total_derivative(particle.mass);
        let exchanged: Vec<Expr> = thrust
            .iter()
            .zip(&velocity)
            .map(|(&thrust, &own)| g.add(&[thrust, g.mul(&[rate, own])]))
            .collect();
        let slopes = g.jacobian(&particle.position, &system.coordinate_symbols());
        let half = g.div(squared(system, &velocity), g.integer(2));
        let by_q = g.gradient(particle.mass, &system.coordinate_symbols());
        let by_v = g.gradient(particle.mass, &system.velocity_symbols());
        for (s, forces) in forces.iter_mut().enumerate() {
            forces.push(dot(g, &exchanged, slopes.iter().map(|row| &row[s])));
            forces.push(g.neg(g.mul(&[half, by_q[s]])));
            forces.push(system.total_derivative(g.mul(&[half, by_v[s]])));
        }
    }
    forces.iter().map(|parts| g.add(parts)).collect()
}

/// The particle law in coordinates, `Σ (μ ξ'' − X − R)·∂ξ/∂q^s` on the jet (q, v, a, t), length n.
pub fn particle_law(system: &System) -> Vec<Expr> {
    let g = &system.graph;
    let mut sums = vec![Vec::new(); system.n()];
    for particle in &system.particles {
        let unbalanced: Vec<Expr> = particles::velocity(system, particle)
            .into_iter()
            .zip(thrust(system, particle))
            .zip(&particle.force)
            .map(|((own, thrust), &force)| {
                let inertia = g.mul(&[particle.mass, system.total_derivative(own)]);
                g.add(&[inertia, g.neg(force), g.neg(thrust)])
            })
            .collect();
        let slopes = g.jacobian(&particle.position, &system.coordinate_symbols());
        for (s, sum) in sums.iter_mut().enumerate() {
            sum.push(dot(g, &unbalanced, slopes.iter().map(|row| &row[s])));
        }
    }
    sums.iter().map(|parts| g.add(parts)).collect()
}

/// The left sides of the equations of motion by the particle law, and by Lagrange's rule for what the model states beside
/// the particles.
pub(crate) fn left_sides(system: &System) -> Vec<Expr> {
    let g = &system.graph;
    let rest = g.sub(system.lagrangian, particles::kinetic_energy(system));
    let beside = system.left_sides_of(rest);
    let own = particles::own_forces(system);
    particle_law(system)
        .into_iter()
        .enumerate()
        .map(|(s, law)| {
            let further = g.sub(system.forces[s], own[s]);
            g.add(&[law, beside[s], g.neg(further)])
        })
        .collect()
}

/// Ψ_s of a model that states T, where nothing is said of the thrust: every mass changes isotropically, as if it were
/// constant while Lagrange's left sides are formed, `Ψ_s = Σ_a { M_a' ∂²T/∂M_a∂v^s − ∂T/∂M_a ∂M_a/∂q^s }`; length n.
///
/// # Errors
/// [`SystemError`] where the masses of the model leave open what is meant.
pub(crate) fn isotropic_change(
    system: &System,
    named: &NamedMasses,
) -> Result<Vec<Expr>, SystemError> {
    let g = &system.graph;
    let symbols: Vec<Symbol> = named
        .masses
        .iter()
        .filter_map(|(symbol, _)| g.as_symbol(*symbol))
        .collect();
    let by_mass = g.gradient(named.inertia, &symbols);
    let mixed = g.jacobian(&by_mass, &system.velocity_symbols());
    let mut forces = vec![Vec::new(); system.n()];
    for ((&(symbol, value), &slope), row) in named.masses.iter().zip(&by_mass).zip(&mixed) {
        if row.iter().all(|&e| g.is_zero(e)) {
            continue;
        }
        refuse_unclear(system, named, symbol, value)?;
        let rate = system.total_derivative(value);
        let by_q = g.gradient(value, &system.coordinate_symbols());
        for (s, forces) in forces.iter_mut().enumerate() {
            forces.push(g.mul(&[rate, row[s]]));
            forces.push(g.neg(g.mul(&[slope, by_q[s]])));
        }
    }
    let sums: Vec<Expr> = forces.iter().map(|parts| g.add(parts)).collect();
    Ok(g.substitute_all(&sums, &named.masses))
}

/// A mass that contains velocities needs the particle law; one that contains coordinates needs T apart from V.
fn refuse_unclear(
    system: &System,
    named: &NamedMasses,
    symbol: Expr,
    value: Expr,
) -> Result<(), SystemError> {
    let g = &system.graph;
    let mass = || g.text(symbol);
    let contains = |symbols: &[Symbol]| {
        first_symbol(system, value, symbols).map(|symbol| g.symbol_text(symbol))
    };
    if let Some(symbol) = contains(&system.velocity_symbols()) {
        let mass = mass();
        return Err(SystemError::MassWithVelocity { mass, symbol });
    }
    match contains(&system.coordinate_symbols()).filter(|_| !named.is_kinetic) {
        Some(symbol) => {
            let mass = mass();
            Err(SystemError::MassInLagrangian { mass, symbol })
        }
        None => Ok(()),
    }
}
