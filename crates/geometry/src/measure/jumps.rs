//! Where the rates jump: a density kept on both sides of s = 0 is kept across only where its flux is the same from both sides.
//!
//! For a continuous positive N that flux is N X̄s, so X̄s must not jump. For a force sign(x) it does not, as x' is the same on both sides;
//! for dry friction sign(x') it does: motions reach x' = 0 from both sides and stay there, and no volume is kept.

use super::{Flow, Measure};
use chetaev_mechanics::claims::Context;
use chetaev_symbolic::verdict::Counterexample;
use chetaev_symbolic::{Expr, Function, Graph, Node, Symbol, Verdict};

/// A function at whose zeros its own rate jumps, with a state where it does, if one was found.
struct Jump {
    at: Expr,
    found: Option<Counterexample>,
}

/// What is proved beside jumps is conditional.
pub(super) fn limited(cx: &Context<'_>, flow: &Flow<'_>, measure: Measure) -> Measure {
    let is_proved = |v: &Verdict| matches!(v, Verdict::Proved(_));
    if !is_proved(&measure.verdict) && !measure.kept.as_ref().is_some_and(is_proved) {
        return measure;
    }
    let jumps = jumps(cx, flow);
    Measure {
        verdict: beside(cx, &jumps, measure.verdict),
        kept: measure.kept.map(|kept| beside(cx, &jumps, kept)),
        ..measure
    }
}

/// A verdict beside all jumps.
pub(super) fn beside_all(cx: &Context<'_>, flow: &Flow<'_>, verdict: Verdict) -> Verdict {
    match verdict {
        Verdict::Proved(_) => beside(cx, &jumps(cx, flow), verdict),
        other => other,
    }
}

fn beside(cx: &Context<'_>, jumps: &[Jump], verdict: Verdict) -> Verdict {
    let (Verdict::Proved(mut proof), false) = (verdict.clone(), jumps.is_empty()) else {
        return verdict;
    };
    let g = &cx.system.graph;
    let all = |relation: &str, join: &str| {
        let texts = jumps
            .iter()
            .map(|j| format!("{} {relation} 0", g.text(j.at)));
        texts.collect::<Vec<String>>().join(join)
    };
    let does = match jumps.iter().all(|j| j.found.is_some()) {
        true => "jumps",
        false => "may jump",
    };
    proof.detail.push_str(&format!(
        "; where {} the rate of what vanishes there {does}, so that the flux of a continuous density differs on the two sides: motions may run into these states from both, and no such measure is kept across",
        all("=", " or ")
    ));
    Verdict::Conditional {
        condition: all("≠", " and "),
        proof,
        counterexample: jumps.iter().find_map(|j| j.found.clone()),
    }
}

fn jumps(cx: &Context<'_>, flow: &Flow<'_>) -> Vec<Jump> {
    let of_rates = arguments_of_signs(&cx.system.graph, &flow.field()).into_iter();
    let mut all: Vec<Jump> = of_rates.filter_map(|at| jump(cx, flow, at)).collect();
    // Where L or a constraint jumps, velocities do.
    let mut stated: Vec<Expr> = cx.system.constraints.iter().map(|c| c.f).collect();
    stated.push(cx.system.lagrangian);
    for at in arguments_of_signs(&cx.system.graph, &stated) {
        if all.iter().all(|jump| jump.at != at) {
            all.push(Jump { at, found: None });
        }
    }
    all
}

/// What signs are taken of in expressions.
pub(crate) fn arguments_of_signs(g: &Graph, es: &[Expr]) -> Vec<Expr> {
    let signs = g.reachable(es).into_iter();
    let arguments = signs.filter_map(|e| match g.node(e) {
        Node::Apply {
            function: Function::Sign,
            arguments,
        } => Some(arguments[0]),
        _ => None,
    });
    arguments.collect()
}

fn jump(cx: &Context<'_>, flow: &Flow<'_>, at: Expr) -> Option<Jump> {
    let (system, g) = (cx.system, &cx.system.graph);
    let rate = flow.rates_of(system, &[at])[0];
    let sign = g.apply(Function::Sign, &[at]);
    let on = |side: i64| g.substitute(rate, &[(sign, g.integer(side))]);
    let jump = g.sub(on(1), on(-1));
    if g.is_zero(jump) {
        return None;
    }
    let mut manifold = flow.chart.manifold.clone();
    let own = g.symbols_in(&[at]).into_iter();
    let moving = own.filter(|&s| flow.motion.moves(s) || flow.symbols().contains(&s));
    // A symbol in which the edge has a slope determines it.
    let is_steep = |s: &Symbol| !g.is_zero(g.diff(at, *s));
    manifold
        .implicit
        .extend(moving.last().filter(is_steep).map(|s| (at, s)));
    match cx.prover.identity(system, &[jump], &manifold, "") {
        Verdict::Proved(_) => None,
        Verdict::Refuted(mut found) => {
            found.detail = format!("the jump of the rate of {}: {}", g.text(at), found.detail);
            Some(Jump {
                at,
                found: Some(found),
            })
        }
        _ => Some(Jump { at, found: None }),
    }
}
