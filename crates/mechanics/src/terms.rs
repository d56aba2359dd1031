//! The terms every formulation is built from.

use crate::mass;
use crate::memo::Memo;
use crate::order::lifting;
use crate::system::{Coordinate, System};
use chetaev_symbolic::linear::SolveError;
use chetaev_symbolic::{Expr, Symbol};

/// `W a - Jᵀ λ = b` for constraints of one order m, and for m = 1 `J a = g` (T5 §5.1 (1)).
///
/// Constraints of different orders are brought to the highest one by total derivatives (T2 §2), which change neither J nor
/// the equations of motion.
#[derive(Clone, Debug)]
pub struct MotionTerms {
    /// m, the order of the constraints.
    pub order: u32,
    /// The coordinates with q^(m-1), q^(m), q^(m+1) in the places of q, v, a: what the constraints are conditions on.
    pub jets: Vec<Coordinate>,
    /// W = ∂²L/∂v∂v, n × n, row by row. Where a mass contains velocities, the coefficients of the accelerations in the
    /// particle law, in general not symmetric (T2 §1).
    pub mass_matrix: Vec<Vec<Expr>>,
    /// b = ∂L/∂q + Q - L_vq v - L_vt, length n.
    pub force: Vec<Expr>,
    /// f, length r.
    pub constraints: Vec<Expr>,
    /// J = ∂f/∂q^(m), r × n.
    pub jacobian: Vec<Vec<Expr>>,
    /// g, what of -D f is free of q^(m+1); for m = 1 it is -f_q v - f_t. Length r.
    pub constraint_rate: Vec<Expr>,
    /// Whether f is affine in q^(m), by its form; length r.
    pub affine: Vec<bool>,
    /// For each row, the index of its constraint in the system.
    pub constraint_index: Vec<usize>,
    /// What was computed of the system and these terms.
    pub memo: Memo,
}

impl MotionTerms {
    /// Derives the terms of a system, its constraints lifted to the highest order among them.
    pub fn new(system: &System) -> MotionTerms {
        MotionTerms::of_order(system, system.order())
    }

    /// The terms with the constraints of orders up to m only, lifted to m.
    pub fn of_order(system: &System, order: u32) -> MotionTerms {
        let g = &system.graph;
        let (mass_matrix, force) = match mass::with_velocity(system) {
            None => of_lagrangian(system),
            Some(_) => of_particle_law(system),
        };
        let stated = system.constraints.iter().enumerate();
        let (constraint_index, constraints): (Vec<usize>, Vec<Expr>) = stated
            .filter(|(_, c)| c.order <= order)
            .map(|(l, c)| (l, lifting::lifted(system, c, order)))
            .unzip();
        let names = system.coordinates.iter().map(|c| &c.name);
        let jets: Vec<Coordinate> = names
            .map(|name| Coordinate::derivative(g, name, order - 1))
            .collect();
        let highest: Vec<Symbol> = jets.iter().map(|c| c.v_symbol).collect();
        let jacobian = g.jacobian(&constraints, &highest);
        let is_affine = |row: &Vec<Expr>| !g.any_contains_any(row, &highest);
        let rates = freeze_derivatives(system, &constraints, order);
        MotionTerms {
            memo: Memo::default(),
            affine: jacobian.iter().map(is_affine).collect(),
            constraint_rate: rates.into_iter().map(|rate| g.neg(rate)).collect(),
            order,
            jets,
            mass_matrix,
            force,
            constraints,
            jacobian,
            constraint_index,
        }
    }

    /// The bordered system `W a − Jᵀ λ = b`, `J a = g` solved as one node, with the constraints of `rows`: accelerations, then multipliers of these
    /// (E. J. Routh, Dynamics of a System of Rigid Bodies, 1905). It needs only that it is regular, not that W is.
    ///
    /// # Errors
    /// [`SolveError`] where it is singular.
    pub fn solved(
        &self,
        system: &System,
        rows: &[usize],
    ) -> Result<(Vec<Expr>, Vec<Expr>), SolveError> {
        let (g, n) = (&system.graph, system.n());
        let size = n + rows.len();
        let mut matrix = vec![g.zero(); size * size];
        let mut right = self.force.clone();
        for i in 0..n {
            matrix[i * size..i * size + n].copy_from_slice(&self.mass_matrix[i]);
        }
        for (l, &row) in rows.iter().enumerate() {
            for j in 0..n {
                matrix[(n + l) * size + j] = self.jacobian[row][j];
                matrix[j * size + n + l] = g.neg(self.jacobian[row][j]);
            }
            right.push(self.constraint_rate[row]);
        }
        let mut found = g.solve(&matrix, &right)?;
        let multipliers = found.split_off(n);
        Ok((found, multipliers))
    }
}

/// W and b from L and the forces.
fn of_lagrangian(system: &System) -> (Vec<Vec<Expr>>, Vec<Expr>) {
    let g = &system.graph;
    let velocities = system.velocity_symbols();
    let momenta: Vec<Expr> = g.gradient(system.lagrangian, &velocities);
    let force = force(system, system.lagrangian, &momenta);
    (g.jacobian(&momenta, &velocities), force)
}

/// b of a part of the Lagrangian with these momenta, and of the forces.
pub(crate) fn force(system: &System, part: Expr, momenta: &[Expr]) -> Vec<Expr> {
    let g = &system.graph;
    let drift = freeze_accelerations(system, momenta);
    g.gradient(part, &system.coordinate_symbols())
        .into_iter()
        .enumerate()
        .map(|(i, slope)| g.add(&[slope, system.forces[i], g.neg(drift[i])]))
        .collect()
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
    freeze_derivatives(system, es, 1)
}

/// The total derivative with the derivatives of order m and more frozen.
fn freeze_derivatives(system: &System, es: &[Expr], m: u32) -> Vec<Expr> {
    let g = &system.graph;
    g.derive(es, &|s| {
        let (name, order) = (g.symbol_name(s), g.symbol_order(s));
        match system.coordinate_index(name) {
            Some(_) => (order < m).then(|| g.symbol(name, order + 1)),
            None => system.prescribed_rate(s),
        }
    })
}
