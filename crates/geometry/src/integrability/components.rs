//! Frobenius' condition on each component of constraints that are products, and which components there are.

use super::{answered, on_its_own, Strength};
use chetaev_mechanics::components::{covered, distinct, Stratum};
use chetaev_mechanics::Context;
use chetaev_symbolic::Verdict;

/// Whether no one choice of independent velocities describes all components.
pub(crate) fn are_apart(cx: &Context<'_>) -> bool {
    covered(cx.system, cx.terms, cx.selection).is_some()
}

/// The components of constraints that are products or functions of simpler ones.
pub(crate) fn components(cx: &Context<'_>) -> Vec<Stratum> {
    let all = distinct(cx.system, &cx.prover).into_iter();
    all.map(|(on, _)| on).collect()
}

/// The condition on each component by itself; `None` where there is one.
pub(super) fn on_components(cx: &Context<'_>) -> Option<Verdict> {
    let all = components(cx);
    if all.len() < 2 && !are_apart(cx) {
        return None;
    }
    if all.is_empty() {
        let tried = "no one velocity can be solved for on all components of the constraints, and these are too many to be looked at one by one";
        return Some(Verdict::undecided(tried));
    }
    let open = || Verdict::undecided("it has no independent velocities");
    let decided = all.into_iter().map(|on| {
        let own = on_its_own(cx, &on.system, |own| answered(own, Strength::Weak).verdict);
        (
            on.condition.unwrap_or(on.sentence),
            own.unwrap_or_else(open),
        )
    });
    Some(together(decided.collect()))
}

/// One verdict for all components: where it holds on some and not on others these are the condition.
fn together(all: Vec<(String, Verdict)>) -> Verdict {
    let said = all.iter().map(|(place, verdict)| {
        let word = match verdict {
            Verdict::Proved(_) => "integrable",
            Verdict::Refuted(_) => "not integrable",
            Verdict::Conditional { .. } => "integrable under a condition",
            _ => "not decided",
        };
        format!("on the component {place} {word}: {}", verdict.detail())
    });
    let sentence = said.collect::<Vec<String>>().join("; ");
    let is_refuted = |(_, verdict): &(String, Verdict)| matches!(verdict, Verdict::Refuted(_));
    let (refuted, others): (Vec<_>, Vec<_>) = all.into_iter().partition(is_refuted);
    let places = others.iter().map(|(place, verdict)| match verdict {
        Verdict::Conditional { condition, .. } => format!("{place} and {condition}"),
        _ => place.clone(),
    });
    let places = places.collect::<Vec<String>>().join(" or ");
    let on_others = others
        .into_iter()
        .map(|(_, verdict)| verdict)
        .reduce(Verdict::and);
    let first = refuted.into_iter().map(|(_, verdict)| verdict).next();
    let verdict = match (on_others, first) {
        (None, Some(refuted)) => refuted,
        (Some(Verdict::Proved(proof)), Some(Verdict::Refuted(found))) => Verdict::Conditional {
            condition: places,
            proof,
            counterexample: Some(found),
        },
        (Some(Verdict::Conditional { proof, .. }), found) => Verdict::Conditional {
            condition: places,
            proof,
            counterexample: match found {
                Some(Verdict::Refuted(found)) => Some(found),
                _ => None,
            },
        },
        (Some(other), _) => other,
        (None, None) => Verdict::undecided("there are no components"),
    };
    with_detail(verdict, sentence)
}

fn with_detail(mut verdict: Verdict, sentence: String) -> Verdict {
    match &mut verdict {
        Verdict::Proved(proof) | Verdict::Conditional { proof, .. } => proof.detail = sentence,
        Verdict::Refuted(found) => found.detail = sentence,
        Verdict::Undecided { tried } => *tried = sentence,
        _ => verdict.prefix(&sentence),
    }
    verdict
}
