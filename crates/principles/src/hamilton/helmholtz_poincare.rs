//! `hamilton.helmholtz-poincare`: `∫(δ(Σ p q' − H) + Σ Q δq) dt = 0` with δp free and δq virtual.

use super::phase::Phase;
use super::requirements;
use chetaev_mechanics::claims::formulation::{basis, derive, manifold};
use chetaev_mechanics::claims::{Claim, Context, Finding, Group};
use chetaev_mechanics::formulations::DeriveError;
use chetaev_mechanics::linear::dot;
use chetaev_mechanics::Equations;
use chetaev_symbolic::{Expr, Symbol, Verdict};

/// `hamilton.helmholtz-poincare`.
#[derive(Clone, Copy, Debug)]
pub struct HelmholtzPoincare;

impl Claim for HelmholtzPoincare {
    fn id(&self) -> &'static str {
        "hamilton.helmholtz-poincare"
    }

    fn group(&self) -> Group {
        Group::Principles
    }

    fn title(&self) -> &'static str {
        "Hamilton's principle in the form of Helmholtz and Poincaré"
    }

    fn explanation(&self) -> &'static str {
        "∫(δ(Σ p q' − H) + Σ Q δq) dt = 0 for curves (q(t), p(t)) in phase space: δp is free inside, δq virtual and zero at the ends. The \
         free δp give q' = ∂H/∂p, the virtual δq give (p' + ∂H/∂q − Q)·δq = 0, and with the constraints these are the \
         canonical equations with multipliers p' = −∂H/∂q + Q + Σ λ ∂f/∂v. Decided are both: the coefficients of δp and δq, and \
         that the local equations vanish on the canonical equations and on the motion. Neighbouring curves violate the constraints; \
         only the end momenta need satisfy them. Example: z' = y x' has H = (p_x² + p_y² + p_z²)/2, and the principle gives \
         q' = p, p_x' + y p_z' = 0, p_y' = 0."
    }

    fn requires(&self, _: Option<&str>) -> Vec<String> {
        let mut hypotheses = requirements();
        hypotheses.push("model.hessian-regular".into());
        hypotheses
    }

    fn decide(&self, cx: &Context<'_>, _: Option<&str>) -> Finding {
        decide(cx).unwrap_or_else(Finding::from)
    }
}

fn decide(cx: &Context<'_>) -> Result<Finding, DeriveError> {
    let (system, g) = (cx.system, &cx.system.graph);
    let phase = Phase::new(cx)?;
    let canonical = derive(cx, "canonical")?;
    let varied = phase.varied(cx);
    // The coefficients of δp are Dq − ∂H/∂p.
    let symbols =
        |es: &[Expr]| -> Vec<Symbol> { es.iter().filter_map(|&e| g.as_symbol(e)).collect() };
    let by_momenta = g.gradient(varied, &symbols(&phase.momenta));
    let kinematic = g.gradient(phase.kinematic(cx), &symbols(&phase.momenta));
    let pairs = by_momenta.into_iter().zip(kinematic);
    let lag: Vec<Expr> = pairs.map(|(a, b)| g.sub(a, b)).collect();
    let kinematics = cx.prover.identity(
        system,
        &lag,
        &phase.manifold(),
        "for all curves in phase space",
    );
    let motion = on_motion(
        cx,
        &phase,
        &canonical,
        g.gradient(varied, &symbols(&phase.displacements)),
    )?;
    let mut verdict = kinematics.and(motion);
    let sentence = match &verdict {
        Verdict::Proved(_) => {
            "the free δp give q' = ∂H/∂p, the virtual δq the canonical equations with multipliers, and the form holds on every motion"
        }
        _ => "the form of Helmholtz and Poincaré",
    };
    verdict.prefix(sentence);
    Ok(Finding {
        verdict,
        formulas: super::told::helmholtz_poincare(cx, &phase),
    })
}

/// `(∂/∂δq − Dp + Q)·B` with the rates of the canonical equations, as functions of (q, v, t).
fn on_motion(
    cx: &Context<'_>,
    phase: &Phase,
    canonical: &Equations,
    by_displacements: Vec<Expr>,
) -> Result<Verdict, DeriveError> {
    let (system, g) = (cx.system, &cx.system.graph);
    let forces = phase.legendre.restrict(system, &system.forces);
    let rates = canonical.rates();
    let covector: Vec<Expr> = by_displacements
        .into_iter()
        .zip(rates)
        .zip(forces)
        .map(|((e, rate), force)| g.add(&[e, g.neg(rate), force]))
        .collect();
    let covector = canonical.in_natural_state(system, &covector);
    let chart = basis(cx).independent_velocities()?;
    let mut residuals: Vec<Expr> = (0..chart.k())
        .map(|s| dot(g, &covector, &chart.column(s)))
        .collect();
    residuals.extend(canonical.velocity_residuals(system));
    Ok(cx
        .prover
        .identity(system, &residuals, &manifold(cx), super::ON_MOTIONS))
}
