//! `action.identity`: the general identity of asynchronous variations on a motion (T1 (18)).
//!
//! `Δ∫L dt + ∫Σ Q δq dt = [−H Δt + Σ p Δq]` for every Δt and all virtual δq. Its integrand,
//! `ΔL + L D(Δt) + Σ Q δq − D(−H Δt + Σ p Δq)`, equals `Σ (Q − D p + ∂L/∂q) δq` on every curve.

use super::Asynchronous;
use crate::variations::Displacements;
use crate::words::formula;
use chetaev_mechanics::claims::{Claim, Context, Finding, Group};
use chetaev_mechanics::formulations::DeriveError;
use chetaev_mechanics::linear::dot;
use chetaev_mechanics::Manifold;
use chetaev_symbolic::{Expr, Verdict};

/// `action.identity`.
#[derive(Clone, Copy, Debug)]
pub struct Identity;

impl Claim for Identity {
    fn id(&self) -> &'static str {
        "action.identity"
    }

    fn group(&self) -> Group {
        Group::Principles
    }

    fn title(&self) -> &'static str {
        "The action at varied times changes by its end terms"
    }

    fn explanation(&self) -> &'static str {
        "A state at t is compared with one at t + Δt, Δt any function of the time: Δq = δq + v Δt, Δv = D(Δq) − v D(Δt), Δg = δg + (Dg) Δt. \
         On a motion, for all virtual δq and every Δt, Δ∫L dt + ∫Σ Q δq dt = [−H Δt + Σ p Δq], H = Σ p v − L. Δt takes no part: the integrand \
         ΔL + L D(Δt) + Σ Q δq − D(−H Δt + Σ p Δq) equals Σ (Q − Dp + ∂L/∂q) δq on every curve, identically, which is computed first; \
         then it vanishes on the motions, as δq is virtual. All principles of least action are special choices of Δt: Δt = 0 gives Hamilton's, \
         ΔH = 0 Lagrange's. Example: a free particle, L = v²/2, has ΔL + L D(Δt) = v D(Δq) − (v²/2) D(Δt)."
    }

    fn requires(&self, _: Option<&str>) -> Vec<String> {
        vec![
            "model.accelerations-unique".into(),
            "model.masses-free-of-velocity".into(),
        ]
    }

    fn decide(&self, cx: &Context<'_>, _: Option<&str>) -> Finding {
        decide(cx).unwrap_or_else(Finding::from)
    }
}

/// The integrand of the identity without `Σ (Q − Dp + ∂L/∂q) δq`, which vanishes for all curves; and its end terms.
pub(super) fn residual(cx: &Context<'_>, varied: &Asynchronous<'_>) -> (Expr, Expr) {
    let (system, g) = (cx.system, &cx.system.graph);
    let momenta = g.gradient(system.lagrangian, &system.velocity_symbols());
    let ends = g.add(&[
        g.neg(g.mul(&[system.energy(), varied.time])),
        dot(g, &momenta, &varied.coordinates()),
    ]);
    let residual = g.add(&[
        varied.vary(system.lagrangian),
        g.mul(&[system.lagrangian, varied.time_rate]),
        g.neg(varied.derivative(ends)),
        dot(g, &system.lagrange_left_sides(), &varied.displacements),
    ]);
    (residual, ends)
}

/// `(Q − Dp + ∂L/∂q)·B` vanishes on the motions.
pub(super) fn on_motions(cx: &Context<'_>) -> Result<Verdict, DeriveError> {
    let (system, g) = (cx.system, &cx.system.graph);
    let d = Displacements::new(cx)?;
    let pairs = system.forces.iter().zip(system.lagrange_left_sides());
    let covector: Vec<Expr> = pairs.map(|(&force, left)| g.sub(force, left)).collect();
    let covector = d.chart.on_jet(system, &covector);
    let covector = d.chart.contract(system, &covector);
    crate::hamilton::holds_on_motions(cx, &d, &covector)
}

fn decide(cx: &Context<'_>) -> Result<Finding, DeriveError> {
    let varied = Asynchronous::new(cx.system);
    let (residual, ends) = residual(cx, &varied);
    let on = "for all curves, all δq and every Δt";
    let identity = cx
        .prover
        .identity(cx.system, &[residual], &Manifold::default(), on);
    let mut verdict = identity.and(on_motions(cx)?);
    let unforced = cx.system.forces.iter().all(|&q| cx.system.graph.is_zero(q));
    let work = if unforced { "" } else { " + ∫Σ Q δq dt" };
    let sentence = match &verdict {
        Verdict::Proved(_) => {
            format!(
                "Δ∫L dt{work} = [−H Δt + Σ p Δq] on every motion, for all virtual δq and every Δt"
            )
        }
        _ => format!("Δ∫L dt{work} against [−H Δt + Σ p Δq]"),
    };
    verdict.prefix(&sentence);
    let caption = "the end terms −H Δt + Σ p Δq, with Δq = δq + v Δt";
    Ok(Finding {
        verdict,
        formulas: formula(cx, caption, None, ends).into_iter().collect(),
    })
}
