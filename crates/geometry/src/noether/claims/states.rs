//! Functions that are integrals on a part of the states: where the model says so, on positions that satisfy the holonomic constraints
//! themselves, and on one side of the corners of constraints.

use super::parts::{parts, Part};
use super::symmetry::{symmetry, symmetry_on, with_symmetry, Symmetry};
use super::trivial::is_fixed;
use crate::integrability::on_its_own;
use crate::noether::motion::Motion;
use chetaev_mechanics::claims::{Context, Finding, Formula};
use chetaev_symbolic::verdict::Proof;
use chetaev_symbolic::{Expr, Verdict};

/// Functions with their names.
type Named = Vec<(String, Expr)>;

/// The verdict where the model says on which part of the states it holds: the rate vanishes there, and the part is invariant.
pub(super) fn on_part(
    cx: &Context<'_>,
    motion: &Motion<'_>,
    name: Option<&str>,
    value: Expr,
) -> Option<Finding> {
    let g = &cx.system.graph;
    let stated = cx.system.integral_conditions.iter();
    let own: Vec<_> = stated
        .filter(|(integral, ..)| Some(integral.as_str()) == name)
        .collect();
    if own.is_empty() {
        return None;
    }
    let conditions: Named = own
        .iter()
        .map(|(_, left, right, text)| (format!("`{text}`"), g.sub(*left, *right)))
        .collect();
    let texts: Vec<&str> = own.iter().map(|(.., text)| text.as_str()).collect();
    Some(
        on_stated(cx, motion, value, &conditions, &texts.join(", "))
            .unwrap_or_else(|why| Verdict::undecided(why).into()),
    )
}

/// The same for given conditions.
fn on_stated(
    cx: &Context<'_>,
    motion: &Motion<'_>,
    value: Expr,
    conditions: &Named,
    condition: &str,
) -> Result<Finding, String> {
    let equations: Vec<Expr> = conditions.iter().map(|(_, e)| *e).collect();
    let all = resolved_parts(cx, motion, &equations)?;
    let on = "on this part of the constraint manifold";
    let rate = motion.derivatives(&[value]);
    let changes = vec![("its rate".to_owned(), rate[0])];
    let Some(kept) = vanish(cx, &all, &changes, on) else {
        return Ok(Verdict::not_applicable(
            format!("there are states with {condition}"),
            format!(
                "no admissible state at which the constraints are regular satisfies {condition}"
            ),
        )
        .into());
    };
    let proof = match kept {
        Verdict::Proved(proof) => proof,
        Verdict::Refuted(_) => {
            let sentence = format!("it changes on motions that begin with {condition}");
            return Ok(kept.prefixed(&sentence).into());
        }
        other => {
            let sentence = format!("whether its rate vanishes with {condition}");
            return Ok(other.prefixed(&sentence).into());
        }
    };
    let rates = motion.derivatives(&equations);
    let names = conditions
        .iter()
        .map(|(text, _)| format!("the rate of left minus right side of {text}"));
    let rates: Named = names.zip(rates).collect();
    match vanish(cx, &all, &rates, on) {
        Some(Verdict::Proved(invariant)) => {
            let detail = format!(
                "motions that begin with {condition} stay there, and it keeps its value on them"
            );
            let both = Verdict::Proved(proof).and(Verdict::Proved(invariant));
            let verdict = conditional(both.prefixed(&detail), condition.to_owned());
            Ok(with_symmetry(verdict, symmetry_on(cx, value, &all)))
        }
        Some(left) => Ok(later(cx, motion, &all, rate[0], condition)
            .unwrap_or_else(|| not_invariant(left, condition))
            .into()),
        None => Err(format!("no states with {condition} were found")),
    }
}

/// A proof for a subset of the states.
fn conditional(verdict: Verdict, condition: String) -> Verdict {
    match verdict {
        Verdict::Proved(proof) => Verdict::Conditional {
            condition,
            proof,
            counterexample: None,
        },
        other => other,
    }
}

/// Motions leave the part on which the rate of a function vanishes; the refutation where a higher derivative does not vanish there.
fn later(
    cx: &Context<'_>,
    motion: &Motion<'_>,
    all: &[Part],
    rate: Expr,
    condition: &str,
) -> Option<Verdict> {
    let mut derivative = rate;
    for order in ["second", "third"] {
        derivative = *motion.derivatives(&[derivative]).first()?;
        let name = format!("its {order} derivative in time");
        let on = "on this part of the constraint manifold";
        let verdict = vanish(cx, all, &vec![(name, derivative)], on)?;
        match verdict {
            Verdict::Refuted(_) => {
                let sentence = format!("it changes on motions that begin with {condition}, which do not stay there: its rate vanishes with {condition} alone");
                return Some(verdict.prefixed(&sentence));
            }
            Verdict::Proved(_) => {}
            _ => return None,
        }
    }
    None
}

/// The verdict where the rate vanishes on a part that is not seen to be invariant.
fn not_invariant(verdict: Verdict, condition: &str) -> Verdict {
    match verdict {
        Verdict::Refuted(found) => Verdict::not_applicable(
            format!("motions that begin with {condition} stay there"),
            format!(
                "its rate vanishes with {condition}, but motions leave these states: {}",
                found.detail
            ),
        ),
        other => other.prefixed(&format!(
            "its rate vanishes with {condition}; whether motions that begin there stay there"
        )),
    }
}

/// The verdict where constraints have corners and the function keeps its value on some of their sides only.
pub(super) fn on_sides(cx: &Context<'_>, value: Expr) -> Option<Finding> {
    let (mut kept, mut counterexample) = (Vec::new(), None);
    for side in cx.system.sides() {
        let decided = on_its_own(cx, &side.system, |own| {
            let verdict = Motion::of(own).ok()?.is_integral(own, value);
            let symmetry = matches!(verdict, Verdict::Proved(_)).then(|| symmetry(own, value));
            Some((verdict, symmetry))
        });
        match decided.flatten()? {
            (Verdict::Proved(proof), symmetry) => kept.push((side.condition?, proof, symmetry)),
            (Verdict::Refuted(found), _) => counterexample = Some(found),
            _ => return None,
        }
    }
    let texts: Vec<&str> = kept.iter().map(|(text, ..)| text.as_str()).collect();
    let condition = texts.join(" or ");
    let formulas = on_each_side(&kept);
    let (_, mut proof, _) = kept.pop()?;
    proof.detail = format!(
        "the constraints have corners, and it keeps its value as long as {condition}; {}",
        proof.detail
    );
    Some(Finding {
        verdict: Verdict::Conditional {
            condition: format!("{condition}, as long as the motion stays there"),
            proof,
            counterexample,
        },
        formulas,
    })
}

/// The generators on sides of corners, where their equations are proved; with the side where there are several.
fn on_each_side(kept: &[(String, Proof, Option<Symmetry>)]) -> Vec<Formula> {
    let mut formulas = Vec::new();
    for (side, _, symmetry) in kept {
        let Some((Verdict::Proved(_), own)) = symmetry else {
            continue;
        };
        formulas.extend(own.iter().map(|formula| Formula {
            caption: match kept.len() {
                1 => formula.caption.clone(),
                _ => format!("{}, where {side}", formula.caption),
            },
            ..formula.clone()
        }));
    }
    formulas
}

/// The verdict on the states that satisfy the holonomic constraints, not only their derivatives; `None` where there are none.
pub(super) fn on_positions(cx: &Context<'_>, motion: &Motion<'_>, value: Expr) -> Option<Finding> {
    let (verdict, kept) = rates_on_positions(cx, motion, &[value])?;
    Some(match verdict {
        Verdict::Proved(_) if is_fixed(cx, motion, value) => verdict
            .prefixed("trivial, as the constraints fix the value of the function")
            .into(),
        Verdict::Proved(_) => {
            let verdict = verdict.prefixed("it keeps its value on motions that satisfy the holonomic constraints themselves, not only their derivatives");
            with_symmetry(verdict, symmetry_on(cx, value, &kept))
        }
        Verdict::Refuted(_) => verdict.prefixed("it changes on motions").into(),
        Verdict::Conditional { .. } => {
            let verdict = verdict.prefixed("it keeps its value on these motions alone");
            with_symmetry(verdict, symmetry_on(cx, value, &kept))
        }
        other => other
            .prefixed("whether the rate of the function vanishes on motions")
            .into(),
    })
}

/// Whether functions keep their values on the states that satisfy the holonomic constraints themselves: where these have parts and
/// that is so on some, `conditional`; and on which parts. `None` where there are no such constraints, or no such states were found.
pub(super) fn rates_on_positions(
    cx: &Context<'_>,
    motion: &Motion<'_>,
    values: &[Expr],
) -> Option<(Verdict, Vec<Part>)> {
    if cx.system.fixed_functions().is_empty() {
        return None;
    }
    let all = resolved_parts(cx, motion, &[]).ok()?;
    let g = &cx.system.graph;
    let name = |&e: &Expr| match values.len() {
        1 => "its rate".to_owned(),
        _ => format!("the rate of {}", g.text(e)),
    };
    let rates = motion.derivatives(values);
    let rates: Named = values.iter().map(name).zip(rates).collect();
    let on = "on the constraint manifold with the holonomic constraints themselves";
    let each: Vec<(Part, Verdict)> = all
        .into_iter()
        .map(|part| {
            let verdict = on_one(cx, &part, &rates, on);
            (part, verdict)
        })
        .collect();
    let (proved, others): (Vec<_>, Vec<_>) = each
        .into_iter()
        .partition(|(_, verdict)| matches!(verdict, Verdict::Proved(_)));
    let (kept, proofs): (Vec<Part>, Vec<Verdict>) = proved.into_iter().unzip();
    let places: Vec<String> = kept.iter().map(|p| p.chosen.join(", ")).collect();
    let others = others.into_iter().map(|(_, verdict)| verdict);
    let verdict = match (
        proofs.into_iter().reduce(Verdict::and),
        others.reduce(Verdict::and),
    ) {
        (Some(Verdict::Proved(proof)), Some(Verdict::Refuted(found))) => Verdict::Conditional {
            condition: places.join(" or "),
            proof,
            counterexample: Some(found),
        },
        (proved, others) => others.or(proved)?,
    };
    Some((verdict, kept))
}

/// The parts of the states with these conditions, with parameters as the model defines them.
fn resolved_parts(
    cx: &Context<'_>,
    motion: &Motion<'_>,
    conditions: &[Expr],
) -> Result<Vec<Part>, String> {
    parts(cx, motion, conditions, &|e| cx.system.with_definitions(e))
}

/// Whether functions vanish on all parts; `None` where there is no part.
fn vanish(cx: &Context<'_>, all: &[Part], functions: &Named, on: &str) -> Option<Verdict> {
    let each = all.iter().map(|part| on_one(cx, part, functions, on));
    each.reduce(Verdict::and)
}

fn on_one(cx: &Context<'_>, part: &Part, functions: &Named, on: &str) -> Verdict {
    let system = cx.system;
    let resolved: Named = functions
        .iter()
        .map(|(name, e)| (name.clone(), system.with_definitions(*e)))
        .collect();
    cx.prover
        .named_identity(system, &resolved, &part.manifold, on)
}
