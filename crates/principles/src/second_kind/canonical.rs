//! `second-kind.canonical#…`: the integral principles of the second kind in coordinates and momenta.

use super::{everywhere, requirements, Ends};
use crate::hamilton::phase::Phase;
use chetaev_mechanics::claims::formulation::{basis, derive, manifold};
use chetaev_mechanics::claims::{Claim, Context, Finding, Group};
use chetaev_mechanics::formulations::{reactions_by_momenta, DeriveError};
use chetaev_mechanics::linear::dot;
use chetaev_symbolic::verdict::Proof;
use chetaev_symbolic::{Expr, Symbol, Verdict};

/// `second-kind.canonical`.
#[derive(Clone, Copy, Debug)]
pub struct Canonical;

impl Claim for Canonical {
    fn id(&self) -> &'static str {
        "second-kind.canonical"
    }

    fn group(&self) -> Group {
        Group::Principles
    }

    fn title(&self) -> &'static str {
        "Hamilton's statement of the second kind gives the closed equations in (q, p)"
    }

    fn explanation(&self) -> &'static str {
        "∫(δ(Σ p Dq − H) + Σ Q δq) dt, less [Σ p δq] with free ends, or with δq = 0 (half-fixed) and also δp = 0 (fixed) at the ends; δp is \
         arbitrary, and δq obeys Chetaev's condition in momenta: with u(q, p, t) = f(q, ∂H/∂p, t) it is Σ ∂u/∂p [∂²H/∂p∂p]⁻¹ δq = 0. Using \
         ∂u/∂p alone would be wrong unless ∂²H/∂p∂p is a multiple of the identity. Results: Dq = ∂H/∂p, and Dp = −∂H/∂q + Q + Σ λ ∂u/∂p [∂²H/∂p∂p]⁻¹. \
         Decided are the coefficients of δp and δq, Chetaev's condition against ∂f/∂v, and the ends. \
         Example: two masses 1 and 2 with v₁ = v₂ have H = p₁²/2 + p₂²/4 and u = p₁ − p₂/2: ∂u/∂p [∂²H/∂p∂p]⁻¹ = \
         (1, −1), so δq₁ = δq₂; ∂u/∂p = (1, −1/2) alone would demand δq₂ = 2 δq₁, which is wrong."
    }

    fn requires(&self, _: Option<&str>) -> Vec<String> {
        let mut hypotheses = requirements();
        hypotheses.push("model.hessian-regular".into());
        hypotheses
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        match cx.terms.order > 1 {
            true => Vec::new(),
            false => Ends::ALL.map(|ends| Some(ends.word().to_string())).to_vec(),
        }
    }

    fn decide(&self, cx: &Context<'_>, subject: Option<&str>) -> Finding {
        let Some(ends) = Ends::of(subject) else {
            return Verdict::undecided("the ends are free, half-fixed or fixed").into();
        };
        let interior = cx.shared(|cx| Interior(interior(cx)));
        let mut verdict = match &interior.0 {
            Ok(verdict) => verdict.clone(),
            Err(problem) => return Verdict::from(problem).into(),
        };
        let (at_ends, words) = match ends {
            Ends::Free => (
                "the end term Σ p δq is subtracted, and D(δp) does not occur",
                "− [Σ p δq] = 0 with free ends",
            ),
            Ends::HalfFixed => (
                "δq = 0 there, and D(δp) does not occur",
                "= 0 with δq = 0 at the ends",
            ),
            Ends::Fixed => (
                "δq = 0 and δp = 0 there",
                "= 0 with δq = 0 and δp = 0 at the ends",
            ),
        };
        verdict = verdict.and(Verdict::Proved(Proof::structural("at the ends", at_ends)));
        let gives = match verdict {
            Verdict::Proved(_) => " gives Dq = ∂H/∂p and the equations of the momenta",
            _ => "",
        };
        verdict.prefix(&format!("δ∫(Σ p Dq − H) dt {words}{gives}"));
        verdict.into()
    }
}

/// What is the same for all ends.
struct Interior(Result<Verdict, DeriveError>);

fn interior(cx: &Context<'_>) -> Result<Verdict, DeriveError> {
    let (system, g) = (cx.system, &cx.system.graph);
    let phase = Phase::new(cx)?;
    let varied = phase.varied(cx);
    let symbols =
        |es: &[Expr]| -> Vec<Symbol> { es.iter().filter_map(|&e| g.as_symbol(e)).collect() };
    let gradient = |es: &[Expr]| g.gradient(varied, &symbols(es));
    // δp: Dq − ∂H/∂p; D(δq): p, which the end term takes away.
    let mut residuals: Vec<Expr> = gradient(&phase.momenta)
        .into_iter()
        .zip(phase.rates.iter().zip(&phase.legendre.by_momenta))
        .map(|(e, (&rate, &v))| g.add(&[e, g.neg(rate), v]))
        .collect();
    let moved = gradient(&phase.moved_displacements).into_iter();
    residuals.extend(
        moved
            .zip(&phase.legendre.momenta)
            .map(|(e, p)| g.sub(e, p.value)),
    );
    let coefficients = cx
        .prover
        .identity(system, &residuals, &phase.manifold(), super::FREE);
    // Chetaev's condition in momenta is that in velocities.
    let basis = basis(cx);
    let in_momenta = reactions_by_momenta(&basis, &phase.legendre)?.concat();
    let in_velocities = phase.legendre.restrict(system, &basis.jacobian().concat());
    let condition = super::differences(cx, &in_momenta, &in_velocities);
    let condition = match condition.is_empty() {
        true => everywhere(cx, &[g.zero()]),
        false => cx
            .prover
            .identity(system, &condition, &phase.manifold(), super::FREE),
    };
    // (∂/∂δq + Q − Dp)·B vanishes with the rates of the closed equations.
    let closed = derive(cx, "state-space-canonical")?;
    let forces = phase.legendre.restrict(system, &system.forces);
    let covector: Vec<Expr> = gradient(&phase.displacements)
        .into_iter()
        .zip(closed.rates())
        .zip(forces)
        .map(|((e, rate), force)| g.add(&[e, g.neg(rate), force]))
        .collect();
    let covector = closed.in_natural_state(system, &covector);
    let chart = basis.independent_velocities()?;
    let on_motion: Vec<Expr> = (0..chart.k())
        .map(|s| dot(g, &covector, &chart.column(s)))
        .collect();
    let on = "on the constraint manifold outside the singular set of the linear systems";
    let motion = cx.prover.identity(system, &on_motion, &manifold(cx), on);
    Ok(coefficients.and(condition).and(motion))
}
