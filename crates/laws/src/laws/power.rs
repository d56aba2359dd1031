//! The power of all forces is the rate of the energy.

use super::{Expected, Kind, Subject, Trial};
use chetaev_symbolic::Expr;

/// `DH = Σ (Qᵢ + Ψᵢ) vⁱ - ∂L/∂t + Σ λ_l Σ vⁱ ∂f^l/∂vⁱ` with `H = Σ pᵢ vⁱ - L`, on the motion by Routh's equations.
pub(super) fn balance(subject: &Subject<'_>) -> Option<Trial> {
    let (cx, system) = (subject.cx, subject.cx.system);
    let g = &system.graph;
    let motion: Vec<(Expr, Expr)> = system
        .coordinates
        .iter()
        .zip(&subject.routh.accelerations)
        .map(|(c, &a)| (c.a, a))
        .collect();
    let rate = g.substitute(system.total_derivative(system.energy()), &motion);
    let mut power = vec![g.neg(system.time_derivative(system.lagrangian))];
    let forces = g.substitute_all(&system.all_forces(), &motion);
    for (c, &force) in system.coordinates.iter().zip(&forces) {
        power.push(g.mul(&[force, c.v]));
    }
    for &(l, lambda) in &subject.routh.multipliers {
        let f = system.constraints[l].f;
        for c in &system.coordinates {
            power.push(g.mul(&[lambda, g.diff(f, c.v_symbol), c.v]));
        }
    }
    let residual = g.sub(rate, g.add(&power));
    let residual = subject.natural.restrict(system, &[residual]);
    let on = "on the motions of the constrained system";
    Some(Trial {
        kind: Kind::Other,
        formulation: "",
        law: "the energy changes by the power",
        about: String::new(),
        expected: Expected::Proved,
        verdict: cx
            .prover
            .identity(system, &residual, &subject.natural.manifold, on),
        seconds: 0.0,
    })
}
