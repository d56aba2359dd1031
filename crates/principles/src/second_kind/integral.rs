//! `second-kind.integral#…`: the integral principles with free, half-fixed and fixed ends.

use super::{differences, everywhere, requirements, Ends, StateCurve};
use chetaev_mechanics::claims::{Claim, Context, Finding, Group};
use chetaev_mechanics::formulations::DeriveError;
use chetaev_symbolic::verdict::Proof;
use chetaev_symbolic::Verdict;

/// `second-kind.integral`.
#[derive(Clone, Copy, Debug)]
pub struct Integral;

impl Claim for Integral {
    fn id(&self) -> &'static str {
        "second-kind.integral"
    }

    fn group(&self) -> Group {
        Group::Principles
    }

    fn title(&self) -> &'static str {
        "An integral principle of the second kind gives the closed equations of the state space"
    }

    fn explanation(&self) -> &'static str {
        "With Z = L + Σ (Dq − v) ∂L/∂v, δq virtual and δv arbitrary: `free`: ∫(δZ + Σ Q δq) dt − [Σ ∂L/∂v δq] = 0 with nothing asked \
         at the ends; `half-fixed`: ∫(δZ + Σ Q δq) dt = 0 with δq = 0 there; `fixed`: with δv = 0 there too. Each \
         is equivalent to f = 0, Dq = v and D(∂L/∂v) − ∂L/∂q − Q = Σ λ ∂f/∂v, for regular ∂²L/∂v∂v. The first variation is \
         integrated by parts: the coefficient of δv is W (Dq − v), that of δq vanishes on the motions for virtual δq, and what is left \
         at the ends is zero by the conditions asked. Free ends without the term [Σ ∂L/∂v δq] would leave the momenta there. \
         Example: L = (v² − q²)/2 has δZ = (Dq − v) δv − (Dv + q) δq + D(v δq): with δq = 0 at the ends the last \
         term goes, with free ends it has to be subtracted."
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
        decide(cx, ends).map_or_else(Finding::from, Finding::from)
    }
}

fn decide(cx: &Context<'_>, ends: Ends) -> Result<Verdict, DeriveError> {
    let curve = StateCurve::new(cx);
    let varied = curve.vary(cx, curve.density(cx));
    let reduced = curve.reduced(cx, &varied);
    let mut coefficients = differences(cx, &varied.by_velocities, &curve.kinematic(cx));
    coefficients.extend(differences(cx, &reduced, &curve.dynamic(cx)));
    let interior = everywhere(cx, &coefficients);
    let motion = curve.on_motion(cx, &reduced)?;
    let left = curve.end_terms(cx, &varied, ends, true);
    let at_ends = match left.is_empty() {
        true => Verdict::Proved(Proof::structural(
            "at the ends",
            "δq = 0 there, and D(δv) does not occur",
        )),
        false => everywhere(cx, &left),
    };
    let mut verdict = interior.and(motion).and(at_ends);
    let sentence = match ends {
        Ends::Free => "∫(δZ + Σ Q δq) dt − [Σ ∂L/∂v δq] = 0 with free ends",
        Ends::HalfFixed => "∫(δZ + Σ Q δq) dt = 0 with δq = 0 at the ends",
        Ends::Fixed => "∫(δZ + Σ Q δq) dt = 0 with δq = 0 and δv = 0 at the ends",
    };
    let gives = match verdict {
        Verdict::Proved(_) => " gives Dq = v and the equations of motion",
        _ => "",
    };
    verdict.prefix(&format!("{sentence}{gives}"));
    Ok(verdict)
}
