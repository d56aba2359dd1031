//! `action.lagrange`: Lagrange's principle of least action at fixed energy (T1 §5.3).
//!
//! On motions, for Δq virtual and every Δt, `Δ(Σ p v) + Σ p v D(Δt) − D(Σ p Δq) = ΔH`: with ΔH = 0 and Δq = 0 at the ends,
//! `Δ∫Σ p v dt = 0`. Δq is free and virtual, which is legal where the actual velocity is virtual, `∂f/∂v·v = 0`; the isoenergetic
//! condition ΔH = 0 is then an equation for D(Δt).

use super::{as_stationary, identity::on_motions, Asynchronous};
use crate::energy::reaction_speed;
use crate::words::formula;
use chetaev_mechanics::claims::formulation::manifold;
use chetaev_mechanics::claims::{Claim, Context, Finding, Formula, Group};
use chetaev_mechanics::formulations::DeriveError;
use chetaev_mechanics::linear::dot;
use chetaev_mechanics::Manifold;
use chetaev_symbolic::{Expr, Verdict};

/// `action.lagrange`.
#[derive(Clone, Copy, Debug)]
pub struct Lagrange;

impl Claim for Lagrange {
    fn id(&self) -> &'static str {
        "action.lagrange"
    }

    fn group(&self) -> Group {
        Group::Principles
    }

    fn title(&self) -> &'static str {
        "Least action in Lagrange's form"
    }

    fn explanation(&self) -> &'static str {
        "Where the energy H is an integral because L is free of the time, Q = 0 and ∂f/∂v·v = 0 on the constraints, a motion is compared with curves of the same \
         energy, ΔH = 0, with the same end positions but free end times: Δ∫Σ p v dt = 0 (for L = T − V: Δ∫2T dt = 0; terms of L linear in the \
         velocities stay under the integral). Δq is free and virtual; ΔH = 0 is a linear equation for D(Δt), whose coefficient Σ ∂H/∂v·v must not vanish. \
         Decided is the identity Δ(Σ p v) + Σ p v D(Δt) − D(Σ p Δq) = ΔH − Σ (Dp − ∂L/∂q) Δq on every curve, and that the last sum vanishes on the motions. \
         As for Hamilton's principle this is stationary action among admissible curves only where multipliers κ exist (hamilton.stationary). \
         Example: a particle z' = y x' with Δq = (a, b, y a), a and b any functions that vanish at the ends. \
         With L = (x'² + y'² + z'²)/2 then D(Δt) = (x' a' + y' b' + z' (y a)')/(x'² + y'² + z'²); where all \
         velocities and y are 1 and a' = 3, a = b' = 0 that is 2."
    }

    fn requires(&self, _: Option<&str>) -> Vec<String> {
        [
            "model.accelerations-unique",
            "model.forces-absent",
            "model.lagrangian-autonomous",
            "model.masses-free-of-velocity",
        ]
        .map(String::from)
        .to_vec()
    }

    fn decide(&self, cx: &Context<'_>, _: Option<&str>) -> Finding {
        if let Some(obstacle) = obstacle(cx) {
            return obstacle.into();
        }
        decide(cx).unwrap_or_else(Finding::from)
    }
}

/// Why the actual velocity is not virtual, T1 (17), or why D(Δt) is not determined by ΔH = 0.
fn obstacle(cx: &Context<'_>) -> Option<Verdict> {
    for &row in &cx.selection.rows {
        let name = &cx.system.constraints[cx.terms.constraint_index[row]].name;
        let speed = reaction_speed(cx, row);
        let on = "on the constraint manifold";
        let named = [(format!("∂f/∂v·v of `{name}`"), speed)];
        let verdict = cx
            .prover
            .named_identity(cx.system, &named, &manifold(cx), on);
        match verdict {
            Verdict::Proved(_) => {}
            Verdict::Refuted(found) => {
                let detail = format!("the actual velocity is no virtual displacement, as ∂f/∂v·v does not vanish for `{name}`: {}", found.detail);
                return Some(Verdict::not_applicable(
                    "model.constraints-homogeneous",
                    detail,
                ));
            }
            other => return Some(other.prefixed(&format!("∂f/∂v·v of `{name}`"))),
        }
    }
    let stretch = stretch(cx);
    match cx.prover.identity(cx.system, &[stretch], &manifold(cx), "") {
        Verdict::Proved(_) => Some(Verdict::not_applicable(
            "model.hessian-regular",
            "Σ ∂H/∂v·v vanishes identically, so that ΔH = 0 does not determine Δt",
        )),
        _ => None,
    }
}

/// `Σ ∂H/∂v·v`, the coefficient of D(Δt) in ΔH.
fn stretch(cx: &Context<'_>) -> Expr {
    let (system, g) = (cx.system, &cx.system.graph);
    let slopes = g.gradient(system.energy(), &system.velocity_symbols());
    dot(g, &slopes, system.coordinates.iter().map(|c| &c.v))
}

/// `Δ(Σ p v) + Σ p v D(Δt) − D(Σ p Δq) − ΔH + Σ (Dp − ∂L/∂q) Δq`, and the integrand `Σ p v`.
pub(super) fn residual(cx: &Context<'_>, varied: &Asynchronous<'_>) -> (Expr, Expr) {
    let (system, g) = (cx.system, &cx.system.graph);
    let momenta = g.gradient(system.lagrangian, &system.velocity_symbols());
    let integrand = dot(g, &momenta, system.coordinates.iter().map(|c| &c.v));
    let ends = dot(g, &momenta, &varied.coordinates());
    let residual = g.add(&[
        varied.vary(integrand),
        g.mul(&[integrand, varied.time_rate]),
        g.neg(varied.derivative(ends)),
        g.neg(varied.vary(system.energy())),
        dot(g, &system.lagrange_left_sides(), &varied.coordinates()),
    ]);
    (residual, integrand)
}

fn decide(cx: &Context<'_>) -> Result<Finding, DeriveError> {
    let varied = Asynchronous::total(cx.system);
    let (residual, integrand) = residual(cx, &varied);
    let on = "for all curves, all Δq and every Δt";
    let identity = cx
        .prover
        .identity(cx.system, &[residual], &Manifold::default(), on);
    let mut verdict = identity.and(on_motions(cx)?);
    let sentence = match &verdict {
        Verdict::Proved(_) => format!(
            "Δ∫Σ p v dt = 0 at fixed energy on every motion, Δq virtual and zero at the ends; {}",
            as_stationary(cx, "Lagrange's principle")
        ),
        _ => "Δ∫Σ p v dt at fixed energy".into(),
    };
    verdict.prefix(&sentence);
    let formulas: Vec<Option<Formula>> = vec![
        formula(cx, "the integrand Σ p v", None, integrand),
        formula(
            cx,
            "D(Δt) by ΔH = 0",
            Some(varied.time_rate),
            isoenergetic(cx, &varied),
        ),
    ];
    Ok(Finding {
        verdict,
        formulas: formulas.into_iter().flatten().collect(),
    })
}

/// D(Δt) from ΔH = 0.
fn isoenergetic(cx: &Context<'_>, varied: &Asynchronous<'_>) -> Expr {
    let (system, g) = (cx.system, &cx.system.graph);
    let change = varied.vary(system.energy());
    let at_rate_zero = g.substitute(change, &[(varied.time_rate, g.zero())]);
    g.div(at_rate_zero, stretch(cx))
}
