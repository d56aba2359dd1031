//! Functions that say nothing of the motion, and functions that jump.

use super::parts::{parts, Part};
use crate::noether::motion::Motion;
use crate::noether::shown::readable;
use chetaev_mechanics::claims::Context;
use chetaev_mechanics::{prover, Manifold};
use chetaev_symbolic::verdict::Proof;
use chetaev_symbolic::zero::known_sign;
use chetaev_symbolic::{Expr, Function, Node, Rational, Verdict};

/// The verdict on a function that says nothing of the motion.
pub(super) fn trivial(
    cx: &Context<'_>,
    motion: &Motion<'_>,
    value: Expr,
    proof: &Proof,
) -> Option<Verdict> {
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
    if vanishes(&slopes, &Manifold::default(), "everywhere") {
        let mut proof = proof.clone();
        proof.detail = format!(
            "trivial, as the function is constant on each part of its domain; {}",
            proof.detail
        );
        // What jumps is named by `with_jumps`.
        let condition = match jumps(cx, motion, value).is_empty() {
            true => "as long as the motion stays in one part of the domain of the function",
            false => return Some(Verdict::Proved(proof)),
        };
        return Some(Verdict::Conditional {
            condition: condition.to_owned(),
            proof,
            counterexample: None,
        });
    }
    is_fixed(cx, motion, value).then(|| {
        let proof = Verdict::Proved(proof.clone());
        proof.prefixed("trivial, as the constraints fix the value of the function")
    })
}

/// Whether the constraints fix a function, the holonomic ones themselves too: on all parts of the states its differential depends on
/// theirs.
pub(super) fn is_fixed(cx: &Context<'_>, motion: &Motion<'_>, value: Expr) -> bool {
    let (system, g) = (cx.system, &cx.system.graph);
    let mut functions = system.fixed_functions();
    if functions.is_empty() {
        return false;
    }
    functions.extend(&cx.terms.constraints);
    functions.push(value);
    let functions: Vec<Expr> = functions
        .into_iter()
        .map(|e| system.with_definitions(e))
        .collect();
    let mut symbols = g.symbols_in(&functions);
    symbols.retain(|&s| motion.moves(s));
    let rows: Vec<Vec<Expr>> = functions.iter().map(|&e| g.gradient(e, &symbols)).collect();
    let without = &rows[..rows.len() - 1];
    let depends = |part: &Part| {
        let (Ok(own), Ok(all)) = (
            cx.prover.rank(system, without, &part.manifold),
            cx.prover.rank(system, &rows, &part.manifold),
        ) else {
            return false;
        };
        let is_proved = |verdict: &Verdict| matches!(verdict, Verdict::Proved(_));
        is_proved(&own.at_least) && is_proved(&all.at_most) && own.minimum == all.maximum
    };
    let all = parts(cx, motion, &[], &|e| system.with_definitions(e));
    all.is_ok_and(|all| !all.is_empty() && all.iter().all(depends))
}

/// A verdict on a function that jumps holds between the jumps.
pub(super) fn with_jumps(verdict: Verdict, jumps: &[String]) -> Verdict {
    if jumps.is_empty() {
        return verdict;
    }
    let between = format!("as long as {} does not jump", jumps.join(", "));
    match verdict {
        Verdict::Proved(proof) => Verdict::Conditional {
            condition: between,
            proof,
            counterexample: None,
        },
        Verdict::Conditional {
            condition,
            proof,
            counterexample,
        } => Verdict::Conditional {
            condition: format!("{condition}, {between}"),
            proof,
            counterexample,
        },
        other => other,
    }
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

/// The parts of a function that jump: signs, angles of two arguments, and inverse tangents of what has poles.
pub(super) fn jumps(cx: &Context<'_>, motion: &Motion<'_>, value: Expr) -> Vec<String> {
    let g = &cx.system.graph;
    let assumptions = prover::assumptions(cx.system);
    let sign = |e: Expr| known_sign(g, e, &assumptions);
    let moves = |e: Expr| !g.is_free_of(e, &|s| motion.moves(s));
    let has_pole = |e: Expr| {
        g.reachable(&[e])
            .into_iter()
            .any(|part| match g.node(part) {
                Node::Power { base, exponent } => {
                    let negative = g.as_number(*exponent).is_some_and(|n| *n < Rational::ZERO);
                    negative && moves(*base) && !sign(*base).is_nonzero()
                }
                Node::Apply { function, .. } => matches!(
                    function,
                    Function::Tan | Function::Cot | Function::Sec | Function::Csc
                ),
                _ => false,
            })
    };
    let jumps = |e: &Expr| match g.node(*e) {
        Node::Apply {
            function,
            arguments,
        } => {
            let may_jump = match (function, &**arguments) {
                (Function::Sign, &[x]) => !sign(x).is_nonzero(),
                // The cut is where the second argument is negative.
                (Function::Atan2, &[_, x]) => !sign(x).is_positive(),
                (Function::Atan | Function::Tanh, &[x]) => has_pole(x),
                _ => false,
            };
            may_jump && moves(*e)
        }
        _ => false,
    };
    let all = g.reachable(&[value]).into_iter();
    all.filter(jumps).map(|e| g.text(e)).collect()
}
