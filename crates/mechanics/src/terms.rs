//! The terms every formulation of the first-order theory is built from.

use crate::mass;
use crate::system::System;
use chetaev_symbolic::{Expr, Symbol};

/// `W a - Jᵀ λ = b`, `J a = g` (theory 5.1 (1)), for all constraints of order one as stated.
#[derive(Clone, Debug)]
pub struct MotionTerms {
    /// W = ∂²L/∂v∂v, n × n, row by row. Where a mass contains velocities, the coefficients of the accelerations in the
    /// particle law, in general not symmetric (T2 §1).
    pub mass_matrix: Vec<Vec<Expr>>,
    /// b = ∂L/∂q + Q - L_vq v - L_vt, length n.
    pub force: Vec<Expr>,
    /// f, length r.
    pub constraints: Vec<Expr>,
    /// J = ∂f/∂v, r × n.
    pub jacobian: Vec<Vec<Expr>>,
    /// g = -f_q v - f_t, length r.
    pub constraint_rate: Vec<Expr>,
    /// For each row, the index of its constraint in the system.
    pub constraint_index: Vec<usize>,
}

impl MotionTerms {
    /// Derives the terms of a system.
    pub fn new(system: &System) -> MotionTerms {
        let g = &system.graph;
        let velocities = system.velocity_symbols();
        let (mass_matrix, force) = match mass::with_velocity(system) {
            None => of_lagrangian(system),
            Some(_) => of_particle_law(system),
        };
        let (constraint_index, constraints): (Vec<usize>, Vec<Expr>) = system
            .first_order_constraints()
            .map(|(l, c)| (l, c.f))
            .unzip();
        let jacobian = g.jacobian(&constraints, &velocities);
        let constraint_rate = freeze_accelerations(system, &constraints)
            .into_iter()
            .map(|rate| g.neg(rate))
            .collect();
        MotionTerms {
            mass_matrix,
            force,
            constraints,
            jacobian,
            constraint_rate,
            constraint_index,
        }
    }
}

/// W and b from L and the forces.
fn of_lagrangian(system: &System) -> (Vec<Vec<Expr>>, Vec<Expr>) {
    let g = &system.graph;
    let velocities = system.velocity_symbols();
    let momenta: Vec<Expr> = g.gradient(system.lagrangian, &velocities);
    let drift = freeze_accelerations(system, &momenta);
    let force = g
        .gradient(system.lagrangian, &system.coordinate_symbols())
        .into_iter()
        .enumerate()
        .map(|(i, slope)| g.add(&[slope, system.forces[i], g.neg(drift[i])]))
        .collect();
    (g.jacobian(&momenta, &velocities), force)
}

/// `M_eff` and b from the particle law, which is linear in the accelerations.
fn of_particle_law(system: &System) -> (Vec<Vec<Expr>>, Vec<Expr>) {
    let g = &system.graph;
    let lefts = system.motion_left_sides();
    let symbols: Vec<Symbol> = system.coordinates.iter().map(|c| c.a_symbol).collect();
    let at_rest: Vec<(Expr, Expr)> = system.coordinates.iter().map(|c| (c.a, g.zero())).collect();
    let force = g.substitute_all(&lefts, &at_rest).into_iter();
    (
        g.jacobian(&lefts, &symbols),
        force.map(|e| g.neg(e)).collect(),
    )
}

/// `Σ v ∂e/∂q + ∂e/∂t`: the total derivative without its acceleration terms.
pub fn freeze_accelerations(system: &System, es: &[Expr]) -> Vec<Expr> {
    let g = &system.graph;
    g.derive(es, &|s| {
        let (name, order) = (g.symbol_name(s), g.symbol_order(s));
        match system.coordinate_index(name) {
            Some(_) => (order == 0).then(|| g.symbol(name, 1)),
            None => system.prescribed_rate(s),
        }
    })
}
