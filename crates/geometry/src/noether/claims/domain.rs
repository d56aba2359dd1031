//! Whether a function that a model states has a value at some state.
//!
//! What a root, a logarithm or an inverse function demands of its argument is compared with the signs that the argument can have by
//! its structure and by what the model assumes. That decides only what is certain; else states are drawn.

use crate::measure::arguments_of_signs;
use crate::noether::motion::Motion;
use chetaev_mechanics::claims::Context;
use chetaev_mechanics::system::{Assumption, Relation};
use chetaev_mechanics::{prover, sample, System};
use chetaev_symbolic::zero::known_sign;
use chetaev_symbolic::{Expr, Function, Graph, Node, Verdict};

/// So many states are drawn.
const STATES: u64 = 24;

/// An expression that has to be positive, or not negative, for a part of a function to have a value.
#[derive(Clone, Copy, Debug)]
struct Demand {
    part: Expr,
    e: Expr,
    strict: bool,
}

/// The verdict on a function that has a value nowhere, by a demand that no state satisfies or by two that exclude each other.
pub(super) fn nowhere(cx: &Context<'_>, value: Expr) -> Option<Verdict> {
    let g = &cx.system.graph;
    let assumptions = prover::assumptions(cx.system);
    let fails = |e: Expr, strict: bool| {
        let sign = known_sign(g, e, &assumptions);
        sign.is_nonpositive() && (strict || sign.is_nonzero())
    };
    let demands = demands(g, value);
    let one = demands
        .iter()
        .find(|d| fails(d.e, d.strict))
        .map(|&d| vec![d]);
    let two = || {
        let pairs = demands.iter().enumerate();
        let mut pairs = pairs.flat_map(|(i, a)| demands[..i].iter().map(move |b| (*b, *a)));
        // A sum of what is not negative is not negative.
        let found = pairs.find(|(a, b)| fails(g.add(&[a.e, b.e]), a.strict || b.strict));
        found.map(|(a, b)| vec![a, b])
    };
    let failing: Vec<String> = one
        .or_else(two)?
        .iter()
        .map(|d| {
            let relation = if d.strict { ">" } else { ">=" };
            format!("{} needs {} {relation} 0", g.text(d.part), g.text(d.e))
        })
        .collect();
    Some(Verdict::not_applicable(
        "the function has a real value at some admissible state",
        format!("{}, which holds nowhere", failing.join(" and ")),
    ))
}

/// The verdict on a function that may be undefined, where it is so at all states that were drawn and none at which it is not zero could
/// be enclosed.
pub(super) fn undefined_at_samples(
    cx: &Context<'_>,
    motion: &Motion<'_>,
    value: Expr,
) -> Option<Verdict> {
    let (system, g) = (cx.system, &cx.system.graph);
    if demands(g, value).is_empty() {
        return None;
    }
    let mut drawn = 0;
    for number in 0..STATES {
        let seed = cx.prover.points_seed().wrapping_add(number);
        let Some(point) = sample::admissible_point(system, cx.terms, seed) else {
            continue;
        };
        // What occurs in the function alone, as the time may.
        let mut generator = sample::Generator::new(seed ^ 0x64_6f_6d);
        let mut all = point;
        for symbol in g.symbols_in(&[value]) {
            all.entry(symbol)
                .or_insert_with(|| generator.between(0.1, 2.0));
        }
        let values = g.evaluate_f64(&[value], &|s| all.get(&s).copied());
        if values.is_ok_and(|values| values.iter().all(|x| !x.is_nan())) {
            return None;
        }
        drawn += 1;
    }
    if let Some((defined, _)) = where_defined(cx, value) {
        let found = cx.prover.identity(&defined, &[value], &motion.manifold, "");
        if let Verdict::Refuted(_) = found {
            return None;
        }
    }
    let detail = format!("the function has no real value at any of {drawn} states that were drawn; whether it has one anywhere was not found out");
    (drawn > 0).then(|| Verdict::undecided(detail))
}

/// The system with all that a function demands and that is not known of it as assumptions, so that points at which it has no value are
/// none, and these in words; `None` where it demands nothing more.
pub(super) fn where_defined(cx: &Context<'_>, value: Expr) -> Option<(System, String)> {
    let g = &cx.system.graph;
    // A root has no rate where its argument vanishes.
    let mut open: Vec<Expr> = demands(g, value).iter().map(|demand| demand.e).collect();
    open.sort_unstable();
    open.dedup();
    let with = |more: &[Expr]| {
        let mut system = cx.system.clone();
        system.assumptions.extend(more.iter().map(|&e| Assumption {
            left: g.zero(),
            relation: Relation::Less,
            right: e,
            text: format!("{} > 0", g.text(e)),
        }));
        system
    };
    let mut place = 0;
    while let Some(&e) = open.get(place) {
        let others: Vec<Expr> = open.iter().copied().filter(|&other| other != e).collect();
        match known_sign(g, e, &prover::assumptions(&with(&others))).is_positive() {
            true => open = others,
            false => place += 1,
        }
    }
    let texts: Vec<String> = open.iter().map(|&e| format!("{} > 0", g.text(e))).collect();
    (!open.is_empty()).then(|| (with(&open), texts.join(" and ")))
}

/// What the parts of a function demand. Powers with a fraction as exponent are roots of what is not negative.
fn demands(g: &Graph, value: Expr) -> Vec<Demand> {
    let mut found = Vec::new();
    for part in g.reachable(&[value]) {
        let mut demand = |e: Expr, strict: bool| found.push(Demand { part, e, strict });
        let beside = |sign: i64, x: Expr| g.add(&[g.one(), g.mul(&[g.integer(sign), x])]);
        match g.node(part) {
            Node::Power { base, exponent } => match g.as_number(*exponent) {
                Some(number) if number.is_int() => {}
                Some(number) => demand(*base, *number < chetaev_symbolic::Rational::ZERO),
                None => demand(*base, true),
            },
            Node::Apply {
                function,
                arguments,
            } => match (function, &**arguments) {
                (Function::Log, &[x]) => demand(x, true),
                (Function::Acosh, &[x]) => demand(g.sub(x, g.one()), false),
                (Function::Asin | Function::Acos, &[x]) => {
                    [1, -1]
                        .into_iter()
                        .for_each(|sign| demand(beside(sign, x), false));
                }
                (Function::Atanh, &[x]) => {
                    [1, -1]
                        .into_iter()
                        .for_each(|sign| demand(beside(sign, x), true));
                }
                _ => {}
            },
            _ => {}
        }
    }
    found
}

/// At the zeros of which functions motions may jump, or end, on which a function keeps its value: velocities jump at zeros of what the
/// constraints or L take signs of, reactions where gradients of constraints or momenta jump, accelerations at zeros of velocities that forces
/// take signs of, where dry friction ends the motion.
pub fn corners_of_motions(cx: &Context<'_>, value: Expr) -> Vec<Expr> {
    let (system, g) = (cx.system, &cx.system.graph);
    let velocities = system.velocity_symbols();
    let mut all: Vec<Expr> = system.constraints.iter().map(|c| c.f).collect();
    all.extend([value, system.lagrangian]);
    all.extend(cx.terms.jacobian.concat());
    all.extend(g.gradient(system.lagrangian, &velocities));
    let of_forces = arguments_of_signs(g, &system.forces).into_iter();
    let of_forces = of_forces.filter(|&e| g.contains_any(e, &velocities));
    let mut own = arguments_of_signs(g, &all);
    own.extend(of_forces);
    own.sort_unstable();
    own.dedup();
    own
}

/// How long what is proved of a function holds, in words; `None` where nothing that it depends on jumps.
pub(super) fn lasting(cx: &Context<'_>, value: Expr) -> Option<String> {
    let g = &cx.system.graph;
    let own = corners_of_motions(cx, value).into_iter();
    let texts = own.map(|e| format!("{} keeps its sign", g.text(e)));
    let texts: Vec<String> = texts.collect();
    (!texts.is_empty()).then(|| texts.join(" and "))
}

/// Adds to where something is proved how long it holds.
pub(super) fn while_it_lasts(verdict: &mut Verdict, lasting: Option<&String>) {
    if let (Verdict::Proved(proof), Some(lasting)) = (verdict, lasting) {
        proof.on = format!("{}, while {lasting}", proof.on);
    }
}
