//! `second-kind.differential`: Lagrange's statement of Zhu's differential principle.

use super::{everywhere, kinematics_that_follow, requirements, StateCurve};
use chetaev_mechanics::claims::formulation::derive;
use chetaev_mechanics::claims::{once_where, Claim, Context, Finding, Group};
use chetaev_mechanics::formulations::DeriveError;
use chetaev_mechanics::linear::dot;
use chetaev_symbolic::{Expr, Verdict};

/// `second-kind.differential`.
#[derive(Clone, Copy, Debug)]
pub struct Differential;

impl Claim for Differential {
    fn id(&self) -> &'static str {
        "second-kind.differential"
    }

    fn group(&self) -> Group {
        Group::Principles
    }

    fn title(&self) -> &'static str {
        "q and v varied independently: Dq = v and the equations of motion follow"
    }

    fn explanation(&self) -> &'static str {
        "Zhu's differential principle: Σ (∂L/∂q + Q − D(∂L/∂v)) δq + Σ (Dq − v) δ(∂L/∂v) = 0 along a curve (q(t), v(t)) in state \
         space, for all δv and all virtual δq, with f(q, v, t) = 0. Its coefficient of δv is W (Dq − v) with W = ∂²L/∂v∂v, so Dq = v where \
         W is regular; then the coefficient of δq gives the equations of motion. Where W is singular the kinematic law does \
         not follow, and what of it does is stated: L = (v₁ + v₂)²/2 gives D(q₁ + q₂) = v₁ + v₂ only. \
         Example: an oscillator, L = (v² − q²)/2: (−q − Dv) δq + (Dq − v) δv = 0 for all δq and δv, so Dq = v and \
         Dv = −q."
    }

    fn requires(&self, _: Option<&str>) -> Vec<String> {
        requirements()
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        once_where(cx.terms.order <= 1)
    }

    fn decide(&self, cx: &Context<'_>, _: Option<&str>) -> Finding {
        let curve = StateCurve::new(cx);
        match cx.finding("model.hessian-regular").verdict {
            Verdict::Refuted(_) => {
                let detail = format!(
                    "∂²L/∂v∂v is singular, and {}",
                    kinematics_that_follow(cx, &curve)
                );
                Verdict::not_applicable("model.hessian-regular", detail).into()
            }
            _ => decide(cx, &curve).map_or_else(Finding::from, Finding::from),
        }
    }
}

fn decide(cx: &Context<'_>, curve: &StateCurve) -> Result<Verdict, DeriveError> {
    let g = &cx.system.graph;
    let coefficients = everywhere(cx, &of_momenta(cx, curve));
    let equations = derive(cx, "state-space")?;
    let law: Vec<_> = equations
        .velocities
        .iter()
        .zip(&cx.system.coordinates)
        .map(|(&rate, c)| g.sub(rate, c.v))
        .collect();
    let law = everywhere(cx, &law);
    let motion = curve.on_motion(cx, &curve.dynamic(cx))?;
    let mut verdict = coefficients.and(law).and(motion);
    if matches!(verdict, Verdict::Proved(_)) {
        verdict.prefix("the coefficients of δv are W (Dq − v), so Dq = v; then those of virtual δq are the equations of motion");
    }
    Ok(verdict)
}

/// `Σ (Dq − v) δ(∂L/∂v)` less its coefficients as stated: those of δv are W (Dq − v), those of δq the mixed terms of
/// [`StateCurve::dynamic`].
fn of_momenta(cx: &Context<'_>, curve: &StateCurve) -> Vec<Expr> {
    let (system, g) = (cx.system, &cx.system.graph);
    let momenta = g.gradient(system.lagrangian, &system.velocity_symbols());
    let lag = curve.lag(cx);
    let weighted: Vec<_> = momenta.iter().map(|&p| curve.vary(cx, p)).collect();
    let sum = |j: usize, part: fn(&super::StateVariation) -> &Vec<Expr>| {
        dot(g, &lag, weighted.iter().map(|w| &part(w)[j]))
    };
    let n = system.n();
    let by_velocities: Vec<Expr> = (0..n).map(|j| sum(j, |w| &w.by_velocities)).collect();
    let by_displacements: Vec<Expr> = (0..n).map(|j| sum(j, |w| &w.by_displacements)).collect();
    let mut residuals = super::differences(cx, &by_velocities, &curve.kinematic(cx));
    residuals.extend(super::differences(cx, &by_displacements, &curve.mixed(cx)));
    residuals
}
