//! `noether.inverse#NAME`: an integral that the model states is one, and its generator.

use super::domain::{nowhere, undefined_at_samples};
use super::parts::{parts, Part};
use super::{generator_formulas, on_manifold, requirements};
use crate::integrability::on_its_own;
use crate::noether::embedded::Embedded;
use crate::noether::generator::Generator;
use crate::noether::motion::Motion;
use crate::noether::shown::readable;
use chetaev_mechanics::claims::{Claim, Context, Finding, Formula, Group};
use chetaev_mechanics::Manifold;
use chetaev_symbolic::verdict::Proof;
use chetaev_symbolic::{Expr, Function, Graph, Node, Verdict};

/// `noether.inverse#NAME`.
#[derive(Clone, Copy, Debug)]
pub struct Inverse;

impl Claim for Inverse {
    fn id(&self) -> &'static str {
        "noether.inverse"
    }

    fn group(&self) -> Group {
        Group::Integrals
    }

    fn title(&self) -> &'static str {
        "An integral of the model is a first integral, with its symmetry"
    }

    fn explanation(&self) -> &'static str {
        "A function G stated under [integrals] keeps its value along every motion: X̄G = 0 on the constraint manifold. If so, the inverse of \
         Noether's theorem gives its field: χ = -W̄⁻¹ ∂G, here with δ = 0, and the gauge g = G + p χ; the Killing-type equations are \
         proved for them. `conditional` says that it is one for parameters as the model defines them by others, not for \
         independent ones, or for the values that it states, or as long as the function does not jump, or on the part of the states that the model states with `on`, which is proved to be invariant, or on one component of constraints that are products, or on one side of the corners of constraints; `refuted` comes with an admissible state at which the rate of G is not zero; \
         `not-applicable` says that G has no real value at any state."
    }

    fn requires(&self, _: Option<&str>) -> Vec<String> {
        requirements()
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        let stated = cx.system.integrals.iter();
        stated.map(|(name, _)| Some(name.clone())).collect()
    }

    fn decide(&self, cx: &Context<'_>, subject: Option<&str>) -> Finding {
        let mut stated = cx.system.integrals.iter();
        let Some((_, value)) = stated.find(|(name, _)| Some(name.as_str()) == subject) else {
            return Verdict::undecided("the model states no integral of this name").into();
        };
        if let Some(foreign) = beside_state(cx, *value) {
            let detail = format!("`{foreign}` occurs in it, which is not of (t, q, v)");
            return Verdict::not_applicable("the function is one of the state", detail).into();
        }
        if let Some(verdict) = nowhere(cx, *value).or_else(|| undefined_at_samples(cx, *value)) {
            return verdict.into();
        }
        let motion = match Motion::of(cx) {
            Ok(motion) => motion,
            Err(why) => return Verdict::undecided(why).into(),
        };
        let verdict = match motion.is_integral(cx, *value) {
            Verdict::Proved(proof) => match trivial(cx, &motion, *value, &proof) {
                Some(verdict) => return verdict.into(),
                None => Verdict::Proved(proof),
            },
            other => match on_part(cx, &motion, subject, *value).or_else(|| on_sides(cx, *value)) {
                Some(verdict) => verdict,
                None => match by_definitions(cx, &motion, *value)
                    .or_else(|| by_values(cx, &motion, *value))
                {
                    Some(verdict) => verdict,
                    None => match on_positions(cx, &motion, *value) {
                        // Its field is one of the motion on the positions only, which the embedded equations do not know.
                        Some(verdict) => return verdict.into(),
                        None => other,
                    },
                },
            },
        };
        if matches!(
            verdict,
            Verdict::Conditional { .. } | Verdict::NotApplicable { .. }
        ) {
            return verdict.into();
        }
        if !matches!(verdict, Verdict::Proved(_)) {
            let words = match verdict {
                Verdict::Refuted(_) => "it changes on motions: its rate does not vanish",
                _ => "whether the rate of the function vanishes on motions",
            };
            return verdict.prefixed(words).into();
        }
        let (killing, formulas) = symmetry(cx, *value);
        let verdict = verdict
            .prefixed("it keeps its value on every motion")
            .and(killing);
        Finding { verdict, formulas }
    }
}

/// The verdict where the model says on which part of the states it holds: the part is invariant, and the rate vanishes there.
fn on_part(
    cx: &Context<'_>,
    motion: &Motion<'_>,
    name: Option<&str>,
    value: Expr,
) -> Option<Verdict> {
    let g = &cx.system.graph;
    let stated = cx.system.integral_conditions.iter();
    let own: Vec<_> = stated
        .filter(|(integral, ..)| Some(integral.as_str()) == name)
        .collect();
    if own.is_empty() {
        return None;
    }
    let conditions: Vec<Expr> = own.iter().map(|(_, l, r, _)| g.sub(*l, *r)).collect();
    let texts: Vec<&str> = own.iter().map(|(.., text)| text.as_str()).collect();
    let condition = texts.join(", ");
    let watched = [&[value], &conditions[..]].concat();
    let verdict = match on_all_parts(cx, motion, &watched, &conditions) {
        Ok(verdict) => verdict,
        Err(why) => return Some(Verdict::undecided(why)),
    };
    Some(match verdict {
        None => Verdict::not_applicable(
            format!("there are states with {condition}"),
            format!("no admissible state at which the constraints are regular satisfies {condition}"),
        ),
        Some(Verdict::Proved(mut proof)) => {
            proof.detail = format!(
                "motions that begin with {condition} stay there, and it keeps its value on them; {}",
                proof.detail
            );
            Verdict::Conditional {
                condition,
                proof,
                counterexample: None,
            }
        }
        Some(other) => other.prefixed(
            "whether states as stated with `on` stay such, and the rate of the function vanishes there",
        ),
    })
}

/// The verdict where constraints have corners and the function keeps its value on some of their sides only.
fn on_sides(cx: &Context<'_>, value: Expr) -> Option<Verdict> {
    let (mut proofs, mut found) = (Vec::new(), None);
    for side in cx.system.sides() {
        let decided = on_its_own(cx, &side.system, |own| {
            Some(Motion::of(own).ok()?.is_integral(own, value))
        });
        match decided.flatten()? {
            Verdict::Proved(proof) => proofs.push((side.condition?, proof)),
            Verdict::Refuted(counterexample) => found = Some(counterexample),
            _ => return None,
        }
    }
    let texts: Vec<&str> = proofs.iter().map(|(text, _)| text.as_str()).collect();
    let condition = texts.join(" or ");
    let (_, mut proof) = proofs.pop()?;
    proof.detail = format!(
        "the constraints have corners, and it keeps its value as long as {condition}; {}",
        proof.detail
    );
    Some(Verdict::Conditional {
        condition: format!("{condition}, as long as the motion stays there"),
        proof,
        counterexample: found,
    })
}

/// The verdict on the states that satisfy the holonomic constraints, not only their derivatives.
fn on_positions(cx: &Context<'_>, motion: &Motion<'_>, value: Expr) -> Option<Verdict> {
    if cx.system.fixed_functions().is_empty() {
        return None;
    }
    let verdict = on_all_parts(cx, motion, &[value], &[]).ok()??;
    Some(match verdict {
        Verdict::Proved(proof) => Verdict::Proved(proof)
            .prefixed("it keeps its value on motions that satisfy the holonomic constraints themselves, not only their derivatives"),
        other => other.prefixed("whether the rate of the function vanishes on motions"),
    })
}

/// Whether the rates of functions vanish on all parts of the states with these conditions; `None` where there is no part.
fn on_all_parts(
    cx: &Context<'_>,
    motion: &Motion<'_>,
    watched: &[Expr],
    conditions: &[Expr],
) -> Result<Option<Verdict>, String> {
    let system = cx.system;
    let resolved = |e: Expr| system.with_definitions(e);
    let rates: Vec<Expr> = motion
        .derivatives(watched)
        .into_iter()
        .map(resolved)
        .collect();
    let on = match conditions.is_empty() {
        true => "on the constraint manifold with the holonomic constraints themselves",
        false => "on this part of the constraint manifold",
    };
    let decided: Vec<(Part, Verdict)> = parts(cx, motion, conditions, &resolved)?
        .into_iter()
        .map(|part| {
            let verdict = cx.prover.identity(system, &rates, &part.manifold, on);
            (part, verdict)
        })
        .collect();
    let holds = |(_, verdict): &&(Part, Verdict)| matches!(verdict, Verdict::Proved(_));
    let proved: Vec<&(Part, Verdict)> = decided.iter().filter(holds).collect();
    let refuted = decided.iter().find_map(|(_, verdict)| match verdict {
        Verdict::Refuted(found) => Some(found.clone()),
        _ => None,
    });
    let some = proved.iter().find_map(|(_, verdict)| match verdict {
        Verdict::Proved(proof) => Some(proof.clone()),
        _ => None,
    });
    // With conditions it is the whole of what is stated that has to stay such.
    if let (Some(proof), Some(found), true) = (some, refuted, conditions.is_empty()) {
        let places: Vec<String> = proved.iter().map(|(p, _)| p.chosen.join(", ")).collect();
        return Ok(Some(Verdict::Conditional {
            condition: places.join(" or "),
            proof,
            counterexample: Some(found),
        }));
    }
    Ok(decided
        .into_iter()
        .map(|(_, verdict)| verdict)
        .reduce(Verdict::and))
}

/// The verdict on a function that says nothing of the motion, or that jumps where it is not smooth.
fn trivial(cx: &Context<'_>, motion: &Motion<'_>, value: Expr, proof: &Proof) -> Option<Verdict> {
    let (system, g) = (cx.system, &cx.system.graph);
    if g.is_free_of(value, &|s| motion.moves(s)) {
        let proof = Verdict::Proved(proof.clone());
        return Some(proof.prefixed("trivial, as the function is a constant"));
    }
    let vanishes = |es: &[Expr], manifold: &Manifold, on: &str| {
        let verdict = cx.prover.identity(system, es, manifold, on);
        matches!(verdict, Verdict::Proved(_))
    };
    if let Some((constant, where_it_is)) = constant(cx, motion, value) {
        let proof = Verdict::Proved(proof.clone());
        let what = format!("trivial, as the function is the constant {constant}{where_it_is}");
        return Some(proof.prefixed(&what));
    }
    if vanishes(&[value], &motion.manifold, "on the constraint manifold") {
        let proof = Verdict::Proved(proof.clone());
        return Some(proof.prefixed("trivial, as the function vanishes on the constraints"));
    }
    let symbols = g.symbols_in(&[value]);
    let moving = symbols.into_iter().filter(|&s| motion.moves(s));
    let slopes: Vec<Expr> = moving.map(|s| g.diff(value, s)).collect();
    let is_locally_constant = vanishes(&slopes, &Manifold::default(), "everywhere");
    let jumps = jumps(g, motion, value);
    if !is_locally_constant && jumps.is_empty() {
        return None;
    }
    let what = match (is_locally_constant, jumps.is_empty()) {
        (true, _) => "trivial, as the function is constant on each part of its domain",
        (false, _) => "it keeps its value on motions where it is smooth",
    };
    let condition = match jumps.is_empty() {
        true => "as long as the motion stays in one part of the domain of the function".to_owned(),
        false => format!("as long as {} does not jump", jumps.join(", ")),
    };
    let mut proof = proof.clone();
    proof.detail = format!("{what}; {}", proof.detail);
    Some(Verdict::Conditional {
        condition,
        proof,
        counterexample: None,
    })
}

/// The constant that a function is everywhere, or on the constraints, which the text after it says: its value where all that moves is 0,
/// 1, or different numbers.
fn constant(cx: &Context<'_>, motion: &Motion<'_>, value: Expr) -> Option<(String, &'static str)> {
    let (system, g) = (cx.system, &cx.system.graph);
    let solved = motion.manifold.solved.iter();
    let solved: Vec<(Expr, Expr)> = solved.map(|&(s, e)| (g.symbol_expr(s), e)).collect();
    let on_constraints = g.substitute(value, &solved);
    let moving = |e: Expr| -> Vec<Expr> {
        let own = g.symbols_in(&[e]).into_iter();
        own.filter(|&s| motion.moves(s))
            .map(|s| g.symbol_expr(s))
            .collect()
    };
    let nowhere = Manifold::default();
    for (function, manifold, on) in [
        (value, &nowhere, ""),
        (on_constraints, &motion.manifold, " on the constraints"),
    ] {
        let own = moving(function);
        let starts: [fn(usize) -> i64; 3] = [|_| 0, |_| 1, |i| 2 + i as i64];
        for start in starts {
            let at = own
                .iter()
                .enumerate()
                .map(|(i, &s)| (s, g.integer(start(i))));
            let at: Vec<(Expr, Expr)> = at.collect();
            let number = g.substitute(function, &at);
            let is_number = g.evaluate_f64(&[number], &|_| Some(1.3));
            let is_number = is_number.is_ok_and(|v| v.iter().all(|x| x.is_finite()));
            let defect = g.sub(value, number);
            let verdict = || cx.prover.identity(system, &[defect], manifold, "");
            if is_number && !g.is_zero(number) && matches!(verdict(), Verdict::Proved(_)) {
                return Some((g.text(readable(g, number)), on));
            }
        }
    }
    None
}

/// The parts of a function that jump: signs, and angles of two arguments.
fn jumps(g: &Graph, motion: &Motion<'_>, value: Expr) -> Vec<String> {
    let jumps = |e: &Expr| match g.node(*e) {
        Node::Apply { function, .. } => {
            matches!(function, Function::Sign | Function::Atan2)
                && !g.is_free_of(*e, &|s| motion.moves(s))
        }
        _ => false,
    };
    let all = g.reachable(&[value]).into_iter();
    all.filter(jumps).map(|e| g.text(e)).collect()
}

/// The verdict where it holds for parameters as the model defines them by others, and not for independent ones.
fn by_definitions(cx: &Context<'_>, motion: &Motion<'_>, value: Expr) -> Option<Verdict> {
    let definitions = &cx.system.definitions;
    // Definitions may use each other, in as many steps as there are definitions at most.
    for_parameters(cx, motion, value, definitions, definitions.len(), "defines")
}

/// The verdict where it holds for the values that the model states, and not for independent parameters.
fn by_values(cx: &Context<'_>, motion: &Motion<'_>, value: Expr) -> Option<Verdict> {
    let (g, parameters) = (&cx.system.graph, cx.system.parameters.iter());
    let stated = parameters.filter_map(|p| Some((p.expr, p.value?)));
    let values: Vec<(Expr, Expr)> = stated
        .filter(|(_, value)| g.symbols_in(&[*value]).is_empty())
        .collect();
    let mut found = for_parameters(cx, motion, value, &values, 1, "states")?;
    // The condition names no more than it takes.
    let mut needed = values;
    let mut place = 0;
    while needed.len() <= MOST_VALUES && place < needed.len() {
        let mut fewer = needed.clone();
        fewer.remove(place);
        match for_parameters(cx, motion, value, &fewer, 1, "states") {
            Some(verdict) => (found, needed) = (verdict, fewer),
            None => place += 1,
        }
    }
    let proportional = (0..needed.len()).filter(|_| needed.len() <= MOST_VALUES);
    let by_ratio = proportional
        .filter_map(|base| multiples(g, &needed, base))
        .find_map(|given| for_parameters(cx, motion, value, &given, 1, "states"));
    Some(by_ratio.unwrap_or(found))
}

/// The values stated, those that do not vanish as multiples of one of them, which itself is left free.
fn multiples(g: &Graph, values: &[(Expr, Expr)], base: usize) -> Option<Vec<(Expr, Expr)>> {
    let (own, unit) = values[base];
    let number = |e: Expr| g.as_number(e).is_some() && !g.is_zero(e);
    let others = values.iter().enumerate().filter(|(i, _)| *i != base);
    let tied = others.map(|(_, &(parameter, value))| match number(value) {
        true => (parameter, g.mul(&[g.div(value, unit), own])),
        false => (parameter, value),
    });
    let tied: Vec<(Expr, Expr)> = tied.collect();
    (number(unit) && !tied.is_empty()).then_some(tied)
}

/// Of more parameters it is not asked which values are needed.
const MOST_VALUES: usize = 12;

/// The verdict where it holds once parameters are replaced, which is done so many times.
fn for_parameters(
    cx: &Context<'_>,
    motion: &Motion<'_>,
    value: Expr,
    given: &[(Expr, Expr)],
    steps: usize,
    verb: &str,
) -> Option<Verdict> {
    let (system, g) = (cx.system, &cx.system.graph);
    if given.is_empty() {
        return None;
    }
    let resolved = |e: Expr| (0..steps).fold(e, |e, _| g.substitute(e, given));
    let general = *motion.derivatives(&[value]).first()?;
    let manifold = Manifold {
        solved: motion
            .manifold
            .solved
            .iter()
            .map(|&(s, e)| (s, resolved(e)))
            .collect(),
        implicit: motion
            .manifold
            .implicit
            .iter()
            .map(|&(f, s)| (resolved(f), s))
            .collect(),
    };
    let on = format!("on the constraint manifold, for parameters as the model {verb} them");
    let rate = resolved(general);
    let Verdict::Proved(mut proof) = cx.prover.identity(system, &[rate], &manifold, &on) else {
        return None;
    };
    let occurring = g.symbols_in(&[general, value]);
    let used = given
        .iter()
        .filter(|(symbol, _)| g.as_symbol(*symbol).is_some_and(|s| occurring.contains(&s)));
    let conditions: Vec<String> = used
        .map(|&(symbol, e)| format!("{} = {}", g.text(symbol), g.text(e)))
        .collect();
    proof.detail = format!(
        "it keeps its value on motions for parameters as the model {verb} them; {}",
        proof.detail
    );
    Some(Verdict::Conditional {
        condition: conditions.join(", "),
        proof,
        counterexample: None,
    })
}

/// The Killing-type equations for the generator of an integral, and its formulas.
fn symmetry(cx: &Context<'_>, value: Expr) -> (Verdict, Vec<Formula>) {
    let g = &cx.system.graph;
    let n = match Embedded::of(cx) {
        Ok(n) => n,
        Err(why) => return (Verdict::undecided(why), Vec::new()),
    };
    let generator = match Generator::of(&n, value, g.zero()) {
        Ok(generator) => generator,
        Err(problem) => return (Verdict::undecided(problem.to_string()), Vec::new()),
    };
    let mut residuals = generator.killing_speeds(&n);
    residuals.push(generator.killing_drift(&n));
    let verdict = on_manifold(cx, &n, &residuals)
        .prefixed("the Killing-type equations hold for its symmetry");
    (verdict, generator_formulas(&n, &generator))
}

/// What occurs in a function beside the state (t, q, v) and parameters: an acceleration, a reaction.
fn beside_state(cx: &Context<'_>, e: Expr) -> Option<String> {
    let g = &cx.system.graph;
    let known = |name: &str| {
        name == "t" || cx.system.moves(name) || cx.system.parameters.iter().any(|p| p.name == name)
    };
    let mut symbols = g.symbols_in(&[e]).into_iter();
    let foreign = symbols.find(|&s| !known(g.symbol_name(s)) || g.symbol_order(s) >= 2)?;
    Some(g.text(g.symbol_expr(foreign)))
}
