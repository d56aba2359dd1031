//! The Hamiltonian of the constrained extremum.

use chetaev_mechanics::claims::formulation::basis;
use chetaev_mechanics::claims::Context;
use chetaev_mechanics::equations::unused_name;
use chetaev_mechanics::linear::dot;
use chetaev_mechanics::System;
use chetaev_symbolic::{Expr, Symbol};

/// `π_i = p_i + Σ κ_l ∂f^l/∂vⁱ`, `f = 0` solved for (v, κ), and `H₁ = Σ π v − L` (T1 (23), (24)), where that is linear.
#[derive(Clone, Debug)]
pub struct Extremum {
    /// The symbols π of the coordinates.
    pub symbols: Vec<Symbol>,
    /// They as expressions.
    pub momenta: Vec<Expr>,
    /// v as functions of (q, π, t).
    pub velocities: Vec<Expr>,
    /// κ of the selected constraints as functions of (q, π, t).
    pub kappa: Vec<Expr>,
    /// H₁(q, π, t).
    pub hamiltonian: Expr,
}

/// Names for π, one for each coordinate.
pub(super) fn names(system: &System) -> Vec<String> {
    let coordinates = system.coordinates.iter();
    coordinates
        .map(|c| unused_name(system, &format!("pi_{}", c.name)))
        .collect()
}

impl Extremum {
    /// Solves for (v, κ) where L is quadratic in the velocities and the constraints are affine in them, with a bordered matrix
    /// that is nonsingular by form; `None` else.
    pub fn new(cx: &Context<'_>) -> Option<Extremum> {
        let (system, g, n) = (cx.system, &cx.system.graph, cx.system.n());
        let basis = basis(cx);
        let (constraints, jacobian) = (basis.constraints(), basis.jacobian());
        let speeds = system.velocity_symbols();
        let moves = |rows: &[Vec<Expr>]| g.any_contains_any(&rows.concat(), &speeds);
        if moves(&cx.terms.mass_matrix) || moves(&jacobian) {
            return None;
        }
        let names = names(system);
        let momenta: Vec<Expr> = names.iter().map(|name| g.symbol(name, 0)).collect();
        let at_rest: Vec<(Expr, Expr)> =
            system.coordinates.iter().map(|c| (c.v, g.zero())).collect();
        let linear = g.substitute_all(&g.gradient(system.lagrangian, &speeds), &at_rest);
        let pairs = momenta.iter().zip(&linear);
        let mut right: Vec<Expr> = pairs.map(|(&p, &a)| g.sub(p, a)).collect();
        let offsets = g.substitute_all(&constraints, &at_rest);
        right.extend(offsets.into_iter().map(|f| g.neg(f)));
        let mut matrix = cx.terms.mass_matrix.clone();
        for (i, row) in matrix.iter_mut().enumerate() {
            row.extend(jacobian.iter().map(|gradient| gradient[i]));
        }
        let r = jacobian.len();
        matrix.extend(jacobian.into_iter().map(|mut row| {
            row.extend(std::iter::repeat_n(g.zero(), r));
            row
        }));
        let mut velocities = g.solve(&matrix.concat(), &right).ok()?;
        let kappa = velocities.split_off(n);
        let values: Vec<(Expr, Expr)> = system
            .coordinates
            .iter()
            .zip(&velocities)
            .map(|(c, &v)| (c.v, v))
            .collect();
        // Σ π v − L = ½ Σ (π − L₁) v − L₀ would need f homogeneous; this holds for affine f too.
        let hamiltonian = g.sub(
            dot(g, &momenta, &velocities),
            g.substitute(system.lagrangian, &values),
        );
        Some(Extremum {
            symbols: names.iter().map(|name| g.intern_symbol(name, 0)).collect(),
            momenta,
            velocities,
            kappa,
            hamiltonian,
        })
    }

    /// A function of (q, π, t) at given π.
    pub fn at(&self, cx: &Context<'_>, e: Expr, momenta: &[Expr]) -> Expr {
        let pairs = self.momenta.iter().copied().zip(momenta.iter().copied());
        cx.system
            .graph
            .substitute(e, &pairs.collect::<Vec<(Expr, Expr)>>())
    }
}
