//! `noether.reduced-symmetry#j`: Z f is a first integral for a symmetry Z of the reduced 2-form.

use super::states::rates_on_positions;
use super::{requirements, the_same_there};
use crate::noether::motion::Motion;
use crate::noether::reduced::{candidates, symmetries, Symmetry};
use crate::noether::shown::readable;
use chetaev_mechanics::claims::{Claim, Context, Finding, Formula, Group};
use chetaev_symbolic::{Expr, Verdict};
use std::sync::Arc;

/// `noether.reduced-symmetry#j`.
#[derive(Clone, Copy, Debug)]
pub struct ReducedSymmetry;

struct Shared(Result<Vec<Symmetry>, String>);

fn shared(cx: &Context<'_>) -> Arc<Shared> {
    cx.shared(|cx| Shared(symmetries(cx)))
}

impl Claim for ReducedSymmetry {
    fn id(&self) -> &'static str {
        "noether.reduced-symmetry"
    }

    fn group(&self) -> Group {
        Group::Integrals
    }

    fn title(&self) -> &'static str {
        "A symmetry of the reduced 2-form makes an integral of the constraints"
    }

    fn explanation(&self) -> &'static str {
        "Off the constraints the forces may be chosen: let them be extended so that every constraint function f keeps its value at all states. If a field Z is then a symmetry of the 2-form Ω̃ = dΘ(L) + E θ∧dt of the unconstrained system with these forces, Z f is a first integral, as Z carries motions into motions (Zhao, proposition 4). Whether Z is a symmetry depends on the extension, which is searched: for Z = ∂/∂q along a coordinate that L and the forces do not contain, among polynomials of the second degree in the velocities. Where constraints are holonomic Z f is asked on the positions that they allow, not on others. The reaction λ ∂f/∂v itself is an extension of that kind for few systems only; for the sled it is not."
    }

    fn requires(&self, _: Option<&str>) -> Vec<String> {
        let mut all = requirements();
        all.push("model.hessian-regular".into());
        all
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        let claim = cx.registry().find(self.id());
        let obstacle = claim.is_none_or(|claim| cx.obstacle(claim, None).is_some());
        if obstacle || cx.is_out_of_time() || candidates(cx).is_empty() {
            return Vec::new();
        }
        let count = candidates(cx).len();
        (1..=count).map(|j| Some(j.to_string())).collect()
    }

    fn decide_there(
        &self,
        cx: &Context<'_>,
        subject: Option<&str>,
        there: &Context<'_>,
    ) -> Finding {
        the_same_there((cx, there), (self, subject))
    }

    fn decide(&self, cx: &Context<'_>, subject: Option<&str>) -> Finding {
        let shared = shared(cx);
        let all = match &shared.0 {
            Ok(all) => all,
            Err(why) => return Verdict::undecided(why.clone()).into(),
        };
        let number = subject.and_then(|s| s.parse::<usize>().ok()).unwrap_or(0);
        match number.checked_sub(1).and_then(|i| all.get(i)) {
            Some(symmetry) => integral(cx, symmetry),
            None => Verdict::undecided("there is no such coordinate").into(),
        }
    }
}

fn integral(cx: &Context<'_>, symmetry: &Symmetry) -> Finding {
    let (system, g) = (cx.system, &cx.system.graph);
    let motion = match Motion::of(cx) {
        Ok(motion) => motion,
        Err(why) => return Verdict::undecided(why).into(),
    };
    let name = &system.coordinates[symmetry.coordinate].name;
    let values: Vec<_> = symmetry.integrals.iter().map(|(_, e)| *e).collect();
    let kept = kept(cx, &motion, &values);
    let shown: Vec<String> = values.iter().map(|&e| g.text(readable(g, e))).collect();
    let of_holonomic = match system.fixed_functions().is_empty() {
        true => "",
        false => " (f the derivative of a holonomic constraint)",
    };
    let shown = format!("{}{of_holonomic}", shown.join(", "));
    let (extension, verdict) = match &symmetry.extension {
        Ok(found) => found,
        Err(searched) => {
            let moves = format!("for Z = ∂/∂{name}, Z f = {shown}");
            return match kept {
                Verdict::Refuted(_) => kept.prefixed(&format!(
                    "{moves} does not keep its value on motions, so no extension of the forces that keeps f as it is written makes Z a symmetry"
                )),
                // Not on all components of the constraints.
                Verdict::Conditional {
                    condition,
                    counterexample: Some(found),
                    ..
                } => Verdict::Refuted(found).prefixed(&format!(
                    "{moves} keeps its value with {condition} alone, so no extension of the forces that keeps f as it is written makes Z a symmetry"
                )),
                Verdict::Proved(_) => Verdict::undecided(format!(
                    "{moves} keeps its value on motions, but {searched}: whether Z is a symmetry is open"
                )),
                _ => Verdict::undecided(format!(
                    "{moves}: {searched}, and whether it keeps its value was not decided: {}",
                    kept.detail()
                )),
            }
            .into();
        }
    };
    let sentence = format!("Z = ∂/∂{name} is a symmetry of the reduced 2-form with the forces extended as stated, so that Z f = {shown} keeps its value");
    let mut formulas: Vec<Formula> = symmetry
        .integrals
        .iter()
        .map(|(constraint, e)| Formula {
            caption: format!("Z f of `{constraint}`"),
            left: None,
            right: readable(g, *e),
        })
        .collect();
    let components = system.coordinates.iter().zip(extension);
    formulas.extend(components.map(|(c, &e)| Formula {
        caption: format!("the force along {}, extended to all states", c.name),
        left: None,
        right: e,
    }));
    Finding {
        verdict: verdict.clone().and(kept).prefixed(&sentence),
        formulas,
    }
}

/// Whether functions keep their values on motions, which satisfy the holonomic constraints themselves.
fn kept(cx: &Context<'_>, motion: &Motion<'_>, values: &[Expr]) -> Verdict {
    if !cx.system.fixed_functions().is_empty() {
        return match rates_on_positions(cx, motion, values) {
            Some((verdict, _)) => verdict,
            None => Verdict::undecided("the positions that the constraints allow were not found"),
        };
    }
    let g = &cx.system.graph;
    let rates = motion.derivatives(values);
    let named = values.iter().zip(rates);
    let named: Vec<(String, Expr)> = named
        .map(|(&e, rate)| (format!("the rate of {}", g.text(readable(g, e))), rate))
        .collect();
    let on = "on the constraint manifold";
    cx.prover
        .named_identity(cx.system, &named, &motion.manifold, on)
}
