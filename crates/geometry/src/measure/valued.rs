//! What is decided for arbitrary parameters, at the values that the model states.
//!
//! A refutation gives one choice of parameters, and a density may have poles in them, as exp(x'/(a - b)) at a = b. Where the stated
//! values decide otherwise than others do, the verdict is conditional on them.

use super::{decided, formula, jumps, Flow, Measure};
use crate::integrability::on_its_own;
use chetaev_mechanics::claims::Context;
use chetaev_symbolic::{Expr, Verdict};

/// The measure with a verdict that the stated values do not contradict.
pub(super) fn as_stated(cx: &Context<'_>, flow: &Flow<'_>, measure: Measure) -> Measure {
    let is_open = match &measure.verdict {
        Verdict::Refuted(_) => !flow.refuted_as_stated.get(),
        Verdict::Proved(_) | Verdict::Conditional { .. } => measure
            .density
            .is_none_or(|density| formula::is_undefined(cx, density)),
        _ => false,
    };
    let values = stated(cx, flow);
    if !is_open || values.is_empty() || cx.is_out_of_time() {
        return measure;
    }
    match at_values(cx) {
        Some(valued) => joined(cx, &values, measure, valued),
        None => measure,
    }
}

/// The values of parameters in the motion.
fn stated(cx: &Context<'_>, flow: &Flow<'_>) -> Vec<(Expr, Expr)> {
    let occurring = cx.system.graph.reachable(&flow.field());
    let values = cx.system.parameter_values().into_iter();
    values.filter(|(p, _)| occurring.contains(p)).collect()
}

/// What is known for the stated values.
fn at_values(cx: &Context<'_>) -> Option<Measure> {
    let found = with_values(cx, |cx| {
        let flow = Flow::of(cx).ok()?;
        Some(jumps::limited(cx, &flow, decided(cx, &flow)))
    });
    found?
}

/// The answer for the values that the model states of parameters in the motion, with these as a text; none where it states none.
pub(crate) fn at_stated_values<T>(
    cx: &Context<'_>,
    ask: impl FnOnce(&Context<'_>) -> T,
) -> Option<(String, T)> {
    let values = stated(cx, &Flow::of(cx).ok()?);
    if values.is_empty() {
        return None;
    }
    Some((texts(cx, &values), with_values(cx, ask)?))
}

fn with_values<T>(cx: &Context<'_>, ask: impl FnOnce(&Context<'_>) -> T) -> Option<T> {
    on_its_own(cx, &cx.system.for_parameter_values()?, ask)
}

/// Equations of values.
fn texts(cx: &Context<'_>, values: &[(Expr, Expr)]) -> String {
    let g = &cx.system.graph;
    let texts = values
        .iter()
        .map(|&(p, value)| format!("{} = {}", g.text(p), g.text(value)));
    texts.collect::<Vec<String>>().join(", ")
}

fn joined(cx: &Context<'_>, values: &[(Expr, Expr)], general: Measure, valued: Measure) -> Measure {
    let texts = texts(cx, values);
    match (general.verdict.clone(), valued.verdict.clone()) {
        (
            Verdict::Refuted(found),
            Verdict::Proved(mut proof) | Verdict::Conditional { mut proof, .. },
        ) => {
            proof.detail.push_str(&format!(
                "; so it is for the values that the model states, and not for arbitrary ones: {}",
                found.detail
            ));
            let condition = match &valued.verdict {
                Verdict::Conditional { condition, .. } => format!("{texts}, where {condition}"),
                _ => texts,
            };
            Measure {
                verdict: Verdict::Conditional {
                    condition,
                    proof,
                    counterexample: Some(found),
                },
                as_stated: true,
                ..valued
            }
        }
        (
            Verdict::Proved(mut proof) | Verdict::Conditional { mut proof, .. },
            Verdict::Refuted(found),
        ) => {
            proof.detail.push_str(&format!(
                "; so it is for almost all values of the parameters, and not for {texts}, as the model states them: {}",
                found.detail
            ));
            Measure {
                verdict: Verdict::Conditional {
                    condition: format!("not {texts}"),
                    proof,
                    counterexample: Some(found),
                },
                kept: None,
                ..general
            }
        }
        (Verdict::Refuted(mut found), Verdict::Undecided { tried }) => {
            found.detail.push_str(&format!(
                "; for {texts}, as the model states them, it is not decided: {tried}"
            ));
            Measure {
                verdict: Verdict::Refuted(found),
                ..general
            }
        }
        (Verdict::Proved(mut proof), Verdict::Undecided { tried }) => {
            proof.detail.push_str(&format!(
                "; so it is for almost all values of the parameters, and not decided for {texts}, as the model states them: {tried}"
            ));
            Measure {
                verdict: Verdict::Conditional {
                    condition: format!(
                        "values of the parameters other than some that may include {texts}"
                    ),
                    proof,
                    counterexample: None,
                },
                ..general
            }
        }
        _ => general,
    }
}
