//! The terms every formulation of the first-order theory is built from.

use crate::system::System;
use chetaev_symbolic::Expr;

/// `W a - Jᵀ λ = b`, `J a = g` (theory 5.1 (1)), for all constraints of order one as stated.
#[derive(Clone, Debug)]
pub struct MotionTerms {
    /// W = ∂²L/∂v∂v, n × n, row by row.
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
        let momenta: Vec<Expr> = g.gradient(system.lagrangian, &velocities);
        let mass_matrix = g.jacobian(&momenta, &velocities);
        let drift = freeze_accelerations(system, &momenta);
        let force = g
            .gradient(system.lagrangian, &system.coordinate_symbols())
            .into_iter()
            .enumerate()
            .map(|(i, slope)| g.add(&[slope, system.forces[i], g.neg(drift[i])]))
            .collect();
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

/// `Σ v ∂e/∂q + ∂e/∂t`: the total derivative without its acceleration terms.
pub fn freeze_accelerations(system: &System, es: &[Expr]) -> Vec<Expr> {
    let g = &system.graph;
    let one = g.one();
    g.derive(es, &|s| {
        let (name, order) = (g.symbol_name(s), g.symbol_order(s));
        if name == "t" && order == 0 {
            Some(one)
        } else if system.coordinate_index(name).is_some() {
            (order == 0).then(|| g.symbol(name, 1))
        } else if system.moves(name) {
            Some(g.symbol(name, order + 1))
        } else {
            None
        }
    })
}
