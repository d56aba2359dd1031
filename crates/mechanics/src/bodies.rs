//! What rigid bodies give to a system: their motion, the rates of momentum and of moment of momentum, and whether they and the
//! particles carry its whole inertia.
//!
//! Vectors are given along the axes of the ground. In the axes of a body, which turn with Ω and in which its inertia J is constant,
//! the moment of momentum `Jω` changes at the rate `J ω̊ + Ω × Jω`, ω̊ the derivative of the components of ω
//! (E. T. Whittaker, Analytical Dynamics, 1937, §§ 62, 69).

use crate::mass;
use crate::particles;
use crate::prover::{assumptions, Prover};
use crate::quadratic_forms::is_nonnegative_by_minors;
use crate::system::System;
use chetaev_model::mechanism::{Body, Mechanism, Vector};
use chetaev_symbolic::matrix::determinant;
use chetaev_symbolic::verdict::Proof;
use chetaev_symbolic::zero::known_sign;
use chetaev_symbolic::{Expr, Graph, Verdict};

/// a·b.
pub fn dot(g: &Graph, a: Vector, b: Vector) -> Expr {
    let terms: Vec<Expr> = (0..3).map(|i| g.mul(&[a[i], b[i]])).collect();
    g.add(&terms)
}

/// a × b.
pub fn cross(g: &Graph, a: Vector, b: Vector) -> Vector {
    std::array::from_fn(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        g.sub(g.mul(&[a[j], b[k]]), g.mul(&[a[k], b[j]]))
    })
}

/// a + b.
pub fn plus(g: &Graph, a: Vector, b: Vector) -> Vector {
    std::array::from_fn(|i| g.add(&[a[i], b[i]]))
}

/// a − b.
pub fn minus(g: &Graph, a: Vector, b: Vector) -> Vector {
    std::array::from_fn(|i| g.sub(a[i], b[i]))
}

/// M v.
pub fn image(g: &Graph, matrix: &[Vector; 3], v: Vector) -> Vector {
    matrix.map(|row| dot(g, row, v))
}

/// Velocities of a body as functions of (q, v, t).
#[derive(Clone, Copy, Debug)]
pub struct Velocities {
    /// The velocity of the centre of mass, along the axes of the ground.
    pub center: Vector,
    /// The angular velocity along the axes of the body.
    pub omega: Vector,
    /// The angular velocity of these axes, along them.
    pub turning: Vector,
}

/// The velocities of a body: that of the centre is the derivative of its place.
pub fn velocities(system: &System, body: &Body) -> Velocities {
    Velocities {
        center: body.center.map(|r| system.total_derivative(r)),
        omega: body.omega,
        turning: body.turning,
    }
}

/// Half of `m v² + ω·Jω`, summed over the bodies.
pub fn kinetic_energy(system: &System, mechanism: &Mechanism) -> Expr {
    let g = &system.graph;
    let half = g.div(g.one(), g.integer(2));
    let energies = mechanism.bodies.iter().map(|body| {
        let moved = g.mul(&[body.mass, dot(g, body.velocity, body.velocity)]);
        let turned = dot(g, body.omega, image(g, &body.inertia, body.omega));
        g.mul(&[half, g.add(&[moved, turned])])
    });
    g.add(&energies.collect::<Vec<_>>())
}

/// Whether the kinetic energy is that of the bodies and particles, so that forms that are built from them apply.
pub fn carry_inertia(system: &System, prover: &Prover) -> Verdict {
    const ID: &str = "model.bodies";
    let Some(mechanism) = &system.mechanism else {
        return Verdict::not_applicable(ID, "the model states no bodies");
    };
    if let Some(own) = mechanism.beside {
        let reason = format!(
            "the model states `{own}` beside its bodies, to which no force on a body corresponds"
        );
        return Verdict::not_applicable(ID, reason);
    }
    if !system.masses.is_empty()
        || !system.mass_functions.is_empty()
        || mass::with_velocity(system).is_some()
    {
        return Verdict::not_applicable(ID, "masses vary beside the bodies");
    }
    let (g, Some(kinetic)) = (&system.graph, system.kinetic) else {
        return Verdict::not_applicable(ID, "no body has a mass that moves");
    };
    let own = kinetic_energy(system, mechanism);
    let residual = g.sub(kinetic, g.add(&[own, particles::kinetic_energy(system)]));
    let on = "identically in q, v, t";
    if g.is_zero(residual) {
        let detail = "the kinetic energy is the sum of ½ m v² + ½ ω·Jω of the bodies and of ½ m v² of the particles";
        return Verdict::Proved(Proof::structural(on, detail));
    }
    let name = "T − Σ (½ m v² + ½ ω·Jω)".to_owned();
    prover.named_identity(system, &[(name, residual)], &Default::default(), on)
}

/// The mechanism, where [`carry_inertia`] is proved.
pub fn sufficient(system: &System) -> Option<&Mechanism> {
    let mechanism = system.mechanism.as_ref()?;
    let verdict = carry_inertia(system, &Prover::default());
    matches!(verdict, Verdict::Proved(_)).then_some(mechanism)
}

/// The generalized forces that are neither weights of bodies nor forces on particles: those of coordinates, and of springs; length n.
pub fn further_forces(system: &System, mechanism: &Mechanism) -> Vec<Expr> {
    let g = &system.graph;
    let slopes = g.gradient(mechanism.potential, &system.coordinate_symbols());
    let own = particles::own_forces(system);
    let pairs = system.forces.iter().zip(own).zip(slopes);
    pairs
        .map(|((&force, own), slope)| g.add(&[force, g.neg(own), g.neg(slope)]))
        .collect()
}

/// Whether the kinetic energy is a sum of squares: no mass and no inertia of a body or particle is negative. An inertia
/// `J = tr(P) 1 − P` is none where no principal minor of the second moments P is.
pub fn has_positive_energies(system: &System, values: &[(Expr, Expr)]) -> bool {
    let Some(mechanism) = sufficient(system) else {
        return false;
    };
    let (g, assumptions) = (&system.graph, assumptions(system));
    let is_positive =
        |e: Expr| known_sign(g, g.substitute(e, values), &assumptions).is_nonnegative();
    let particles = system.particles.iter().all(|own| is_positive(own.mass));
    particles
        && mechanism.bodies.iter().all(|body| {
            let inertia = body
                .inertia
                .map(|row| row.map(|e| g.substitute(e, values)).to_vec());
            let is_inertia = is_nonnegative_by_minors(system, &inertia)
                || minors(g, &second_moments(g, &body.inertia))
                    .into_iter()
                    .all(is_positive);
            is_positive(body.mass) && is_inertia
        })
}

/// `½ tr(J) 1 − J`.
fn second_moments(g: &Graph, inertia: &[Vector; 3]) -> [Vector; 3] {
    let trace = g.add(&[inertia[0][0], inertia[1][1], inertia[2][2]]);
    let half = g.div(trace, g.integer(2));
    std::array::from_fn(|i| {
        std::array::from_fn(|j| {
            if i == j {
                g.sub(half, inertia[i][j])
            } else {
                g.neg(inertia[i][j])
            }
        })
    })
}

/// All principal minors.
fn minors(g: &Graph, matrix: &[Vector; 3]) -> Vec<Expr> {
    let subsets: [&[usize]; 7] = [&[0], &[1], &[2], &[0, 1], &[0, 2], &[1, 2], &[0, 1, 2]];
    let minor = |own: &&[usize]| {
        let row = |&i: &usize| own.iter().map(|&j| matrix[i][j]).collect();
        let rows: Vec<Vec<Expr>> = own.iter().map(row).collect();
        determinant(g, &rows)
    };
    subsets.iter().map(minor).collect()
}
