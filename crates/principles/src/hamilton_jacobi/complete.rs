//! A complete integral verified: substitution, non-degeneracy, Jacobi's theorem, and that its curves are motions.

use super::applicable::free;
use super::extremum::Extremum;
use chetaev_mechanics::characteristics::derive_along;
use chetaev_mechanics::claims::formulation::{derive, REFERENCE};
use chetaev_mechanics::claims::Context;
use chetaev_mechanics::formulations::DeriveError;
use chetaev_mechanics::linear::dot;
use chetaev_mechanics::system::CompleteIntegral;
use chetaev_symbolic::verdict::{Counterexample, Proof};
use chetaev_symbolic::{Expr, Symbol, Verdict};
use std::cmp::Ordering;

/// What is found of a complete integral.
#[derive(Clone, Debug)]
pub struct Checked {
    /// `S_t + H₁(q, S_q, t) = 0`; a constant added to S is no constant of a complete integral.
    pub equation: Verdict,
    /// `det ∂²S/∂q∂α` does not vanish identically.
    pub nondegenerate: Verdict,
    /// `D ∂S/∂α = 0` along `q' = ∂H₁/∂π`.
    pub theorem: Verdict,
    /// With the constants of motions put in, `q' = ∂H₁/∂π` satisfies constraints and equations of motion.
    pub motion: Verdict,
}

/// Checks `S = action + Σ ∫ g dq` with H₁. All derivatives of S that occur are in closed form: of a quadrature by its
/// coordinate the integrand, and ∂S/∂α by q or along a curve only.
///
/// # Errors
/// [`DeriveError`] when the equations of motion cannot be derived.
pub fn verified(
    cx: &Context<'_>,
    extremum: &Extremum,
    integral: &CompleteIntegral,
) -> Result<Checked, DeriveError> {
    let (system, g, n) = (cx.system, &cx.system.graph, cx.system.n());
    let time = g.intern_symbol("t", 0);
    let slopes = slopes(cx, integral);
    let by_time = g.diff(integral.action, time);
    let at = |e: Expr| extremum.at(cx, e, &slopes);
    let velocities: Vec<Expr> = extremum.velocities.iter().map(|&v| at(v)).collect();
    let on = "for all q, t and constants";
    let equation = g.add(&[by_time, at(extremum.hamiltonian)]);
    let equation = [("S_t + H₁(q, S_q, t)".to_string(), equation)];
    let equation = cx.prover.named_identity(system, &equation, &free(), on);
    let mixed = g.jacobian(&slopes, &integral.constants);
    let stated = integral.constants.len();
    let count = || {
        format!("a complete integral for {n} coordinates has {n} constants beside an additive one, and here the number is {stated}")
    };
    let nondegenerate = match stated.cmp(&n) {
        Ordering::Equal => cx
            .prover
            .nonsingular(system, &mixed, &free(), "det ∂²S/∂q∂α"),
        // The matrix has fewer columns than rows.
        Ordering::Less => Verdict::Refuted(Counterexample {
            point: Vec::new(),
            quantity: format!("{n}, less the rank of ∂²S/∂q∂α, at least"),
            residual: ((n - stated).to_string(), (n - stated).to_string()),
            detail: format!("{}: ∂²S/∂q∂α is degenerate everywhere", count()),
        }),
        Ordering::Greater => Verdict::undecided(count()),
    };
    let theorem: Vec<(String, Expr)> = integral
        .constants
        .iter()
        .enumerate()
        .map(|(j, &alpha)| {
            let along = dot(g, mixed.iter().map(|row| &row[j]), &velocities);
            let rate = g.add(&[g.diff(by_time, alpha), along]);
            (format!("the rate of ∂S/∂{}", g.symbol_text(alpha)), rate)
        })
        .collect();
    Ok(Checked {
        equation,
        nondegenerate,
        theorem: cx.prover.named_identity(system, &theorem, &free(), on),
        motion: motion(cx, integral, &velocities)?,
    })
}

/// S_q.
fn slopes(cx: &Context<'_>, integral: &CompleteIntegral) -> Vec<Expr> {
    let (system, g) = (cx.system, &cx.system.graph);
    let mut slopes = g.gradient(integral.action, &system.coordinate_symbols());
    for &(i, integrand) in &integral.quadratures {
        slopes[i] = g.add(&[slopes[i], integrand]);
    }
    slopes
}

/// The curves `q' = v(q, α, t)` with the constants of motions: `f = 0` and `Dv = a` of Routh's equations at that v.
fn motion(
    cx: &Context<'_>,
    integral: &CompleteIntegral,
    velocities: &[Expr],
) -> Result<Verdict, DeriveError> {
    let (system, g) = (cx.system, &cx.system.graph);
    let fixed: Vec<(Expr, Expr)> = integral
        .motion
        .iter()
        .map(|&(symbol, value)| (g.symbol_expr(symbol), value))
        .collect();
    let field = g.substitute_all(velocities, &fixed);
    let routh = derive(cx, REFERENCE)?;
    let pairs: Vec<(Expr, Expr)> = system
        .coordinates
        .iter()
        .map(|c| c.v)
        .zip(field.iter().copied())
        .collect();
    let expected = g.substitute_all(&routh.accelerations, &pairs);
    let none: [(Symbol, Expr); 0] = [];
    let moved = derive_along(system, &field, &field, g.one(), &none);
    let coordinates = system.coordinates.iter();
    let mut residuals: Vec<(String, Expr)> = coordinates
        .zip(moved.into_iter().zip(expected))
        .map(|(c, (a, b))| {
            let name = &c.name;
            let what = format!("the acceleration {name}'' of a curve less that of the motion");
            (what, g.sub(a, b))
        })
        .collect();
    let kept = g.substitute_all(&cx.terms.constraints, &pairs);
    let names = cx.terms.constraint_index.iter();
    let names = names.map(|&index| {
        format!(
            "the constraint `{}` on a curve",
            system.constraints[index].name
        )
    });
    residuals.extend(names.zip(kept));
    residuals.retain(|(_, e)| !g.is_zero(*e));
    let on = "for all q, t and constants";
    if residuals.is_empty() {
        let detail = "the accelerations of its curves are those of the motion by form";
        return Ok(Verdict::Proved(Proof::structural(on, detail)));
    }
    let verdict = cx.prover.named_identity(system, &residuals, &free(), on);
    Ok(match verdict {
        Verdict::Refuted(mut found) => {
            let hint = "not every curve it gives is a motion; state the constants that motions have as `motion = { … }`";
            found.detail = format!("{hint}: {}", found.detail);
            Verdict::Refuted(found)
        }
        other => other,
    })
}
