//! Lagrange's equations in the quasi-velocities of a frame, without the coefficients of the brackets of its fields.
//!
//! `D(∂L̃/∂η^s) - X_s L̃ = Q·X_s + Σ_l λ_l ∂f̃^l/∂η^s` lacks the terms with Γ of Poincaré's and Chetaev's equations (T3 §1).
//! Where these vanish, as for a frame of coordinate fields, the equations are right and must be proved.

use super::numbers::{differ, Size};
use super::{Expected, Kind, Subject, Trial};
use chetaev_mechanics::characteristics::derive_along;
use chetaev_mechanics::equations::StateVariable;
use chetaev_mechanics::{Equations, Frame};
use chetaev_symbolic::{Expr, Symbol, Verdict};

/// The trial; `None` for the natural frame.
pub(super) fn without_brackets(subject: &Subject<'_>) -> Option<Trial> {
    let cx = subject.cx;
    let (frame, _) = Frame::adapted(cx.system, cx.terms, cx.selection).ok()?;
    if frame.is_natural(cx.system) || chetaev_mechanics::mass::with_velocity(cx.system).is_some() {
        return None;
    }
    let wrong = equations(subject, &frame)?;
    let accelerations = wrong.in_natural_state(cx.system, &wrong.accelerations);
    let seen = differ(subject, &accelerations, &subject.routh.accelerations);
    let (expected, kind, about) = match seen {
        Size::Zero => (Expected::Proved, Kind::Other, "the terms with Γ vanish"),
        _ => (
            Expected::Refuted,
            Kind::Mutant,
            "the terms with Γ are missing",
        ),
    };
    let verdict = match seen {
        Size::Unclear => Verdict::undecided("numbers cannot tell the terms with Γ from zero"),
        _ => subject.compared(&wrong),
    };
    Some(Trial {
        kind,
        formulation: "poincare-chetaev",
        law: "Lagrange's equations in quasi-velocities",
        about: about.to_string(),
        expected,
        verdict,
        seconds: 0.0,
    })
}

/// η' and λ from the equations without Γ and from Df̃ = 0.
fn equations(subject: &Subject<'_>, frame: &Frame) -> Option<Equations> {
    let (system, rows) = (subject.cx.system, &subject.cx.selection.rows);
    let (g, n) = (&system.graph, system.n());
    let speeds: Vec<Expr> = frame.speeds.iter().map(|s| s.value).collect();
    let symbols: Vec<Symbol> = frame.speeds.iter().map(|s| s.symbol).collect();
    let velocities = frame.velocities(system, &speeds);
    let pairs: Vec<(Expr, Expr)> = system
        .coordinates
        .iter()
        .zip(&velocities)
        .map(|(c, &v)| (c.v, v))
        .collect();
    let mut stated = vec![system.lagrangian];
    stated.extend(rows.iter().map(|&row| subject.cx.terms.constraints[row]));
    stated.extend(&system.forces);
    let stated = g.substitute_all(&stated, &pairs);
    let (lagrangian, constraints) = (stated[0], &stated[1..=rows.len()]);
    let forces = &stated[1 + rows.len()..];
    let momenta = g.gradient(lagrangian, &symbols);
    let drift = derive_along(system, &momenta, &velocities, g.one(), &[]);
    let inertia = g.jacobian(&momenta, &symbols);
    let slopes = g.jacobian(constraints, &symbols);
    let r = rows.len();
    let (mut matrix, mut right) = (Vec::new(), Vec::new());
    for s in 0..n {
        matrix.extend(&inertia[s]);
        matrix.extend(slopes.iter().map(|row| g.neg(row[s])));
        let field = &frame.fields[s];
        let mut parts = derive_along(system, &[lagrangian], field, g.zero(), &[]);
        parts.push(g.neg(drift[s]));
        parts.extend(
            field
                .iter()
                .zip(forces)
                .map(|(&x, &force)| g.mul(&[x, force])),
        );
        right.push(g.add(&parts));
    }
    for row in &slopes {
        matrix.extend(row);
        matrix.extend(vec![g.zero(); r]);
    }
    let rates = derive_along(system, constraints, &velocities, g.one(), &[]);
    right.extend(rates.into_iter().map(|e| g.neg(e)));
    let solution = g.solve(&matrix, &right).ok()?;
    let variables = frame
        .speeds
        .iter()
        .zip(solution)
        .map(|(speed, rate)| StateVariable {
            name: speed.name.clone(),
            value: speed.value,
            symbol: speed.symbol,
            rate,
            definition: Some(speed.definition),
        })
        .collect();
    let name = "poincare-chetaev";
    Some(Equations::in_state(name, system, variables, velocities))
}
