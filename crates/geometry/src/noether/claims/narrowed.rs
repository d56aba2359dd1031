//! Stated integrals that are none of the system and are of a narrower one: for stated laws or values, on a component of the constraints.

use crate::integrability::components::components;
use crate::integrability::on_its_own;
use crate::noether::motion::Motion;
use chetaev_mechanics::claims::{Context, Finding};
use chetaev_mechanics::System;
use chetaev_symbolic::{Expr, Verdict};

/// The verdict on the integral of this name in another system, under a condition, said in `words` first; `None` where it is none there.
pub(super) fn in_system(
    cx: &Context<'_>,
    name: Option<&str>,
    system: &System,
    (narrower, words): (&str, &str),
) -> Option<Finding> {
    let found = kept_in(cx, name, system, narrower)?;
    Some(Finding {
        verdict: found.verdict.prefixed(words),
        formulas: found.formulas,
    })
}

fn kept_in(
    cx: &Context<'_>,
    name: Option<&str>,
    system: &System,
    narrower: &str,
) -> Option<Finding> {
    let claim = format!("noether.inverse#{}", name?);
    let found = on_its_own(cx, system, |own| Finding::clone(&own.finding(&claim)))?;
    let (condition, proof) = match found.verdict {
        Verdict::Proved(proof) => (narrower.to_owned(), proof),
        Verdict::Conditional {
            condition, proof, ..
        } => (format!("{narrower}, {condition}"), proof),
        _ => return None,
    };
    let verdict = Verdict::Conditional {
        condition,
        proof,
        counterexample: None,
    };
    Some(Finding {
        verdict,
        formulas: found.formulas,
    })
}

/// Where the values that the model states matter, on the part that it states too.
pub(super) fn by_values_on_part(
    cx: &Context<'_>,
    motion: &Motion<'_>,
    name: Option<&str>,
    value: Expr,
) -> Option<Finding> {
    let (system, g) = (cx.system, &cx.system.graph);
    let conditions = system.integral_conditions.iter();
    let own = conditions.filter(|(integral, ..)| Some(integral.as_str()) == name);
    let sides = own.flat_map(|(_, left, right, _)| [*left, *right]);
    let mut all: Vec<Expr> = sides.chain([value]).collect();
    all.extend(motion.derivatives(&all.clone()));
    all.extend(cx.terms.constraints.iter().chain([&system.lagrangian]));
    let occurring = g.symbols_in(&all);
    let mut values = system.parameter_values();
    values.retain(|&(p, _)| g.as_symbol(p).is_some_and(|s| occurring.contains(&s)));
    if values.is_empty() {
        return None;
    }
    let narrower = system.with_parameters(&values)?;
    let texts = values.iter();
    let texts = texts.map(|&(p, value)| format!("{} = {}", g.text(p), g.text(value)));
    let texts: Vec<String> = texts.collect();
    let words = "it keeps its value for parameters as the model states them, not for all others";
    in_system(cx, name, &narrower, (&texts.join(", "), words))
}

/// Where it is an integral on some of the components of the constraints.
pub(super) fn on_components(cx: &Context<'_>, name: Option<&str>) -> Option<Finding> {
    let all = components(cx);
    if all.len() < 2 {
        return None;
    }
    let found = all.iter().filter_map(|on| {
        let condition = on.condition.as_ref()?;
        let own = kept_in(cx, name, &on.system, condition)?;
        Some((condition.as_str(), own))
    });
    let found: Vec<(&str, Finding)> = found.collect();
    let conditions: Vec<&str> = found.iter().map(|(condition, _)| *condition).collect();
    let together = conditions.join(" or ");
    let which = match conditions.len() == all.len() {
        true => "whichever it is",
        false => "not on all of them",
    };
    let words = format!(
        "it keeps its value as long as the motion stays on one component of the constraints, {which}"
    );
    let (_, mut first) = found.into_iter().next()?;
    first.verdict.prefix(&words);
    if let Verdict::Conditional {
        condition, proof, ..
    } = &mut first.verdict
    {
        proof.on = format!("on the component {together}, {}", proof.on);
        if conditions.len() > 1 {
            *condition = together;
        }
    }
    Some(first)
}
