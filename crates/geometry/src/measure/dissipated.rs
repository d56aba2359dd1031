//! Rest at which the energy is least and near which it is lost: no positive density is kept there, whatever it contains.
//!
//! Let E have a positive definite second derivative at a state of rest, and let `X̄E ≤ 0`, analytic and not the zero function. Small
//! neighbourhoods K = {E ≤ ε} are compact, and motions stay in them. Were `N dq dη` kept, with N continuous and positive, the image of
//! K after a time would have the measure of K, and so be K, as what it leaves of K is open there. Then the states with E = ε
//! would come from states with E = ε, and X̄E would vanish on all of them, for all small ε: everywhere. Where `X̄E ≥ 0` the same holds
//! backwards.

use super::excluded::{is_assumed, rest, smooth_bases, values_at, vanishes, State, TINY};
use super::formula::{is_nowhere_zero, is_of_one_sign};
use super::jumps::arguments_of_signs;
use super::{products, Flow};
use chetaev_mechanics::{Context, Manifold};
use chetaev_symbolic::matrix::determinant;
use chetaev_symbolic::simplify::{simplify, Options};
use chetaev_symbolic::zero::assumptions::Assumptions;
use chetaev_symbolic::zero::known_sign;
use chetaev_symbolic::{Expr, Function, Node, Symbol, Verdict};

/// A refutation at rest at the origin of the coordinates, for the values that the model states of its parameters.
pub(super) fn refuted(cx: &Context<'_>, flow: &Flow<'_>) -> Option<Verdict> {
    let (system, g) = (cx.system, &cx.system.graph);
    if flow.chart.implicit().next().is_some() || !flow.masses.is_empty() {
        return None;
    }
    let mut state = rest(flow, system);
    state.extend(system.coordinates.iter().map(|c| (c.q, g.zero())));
    let energy = flow.chart.restrict(system, &[system.energy()])[0];
    let rate = products::shorter(
        g,
        simplify(g, flow.rates_of(system, &[energy])[0], &Options::default()),
    );
    let loses = is_of_one_sign(cx, g.neg(rate)) || is_of_one_sign(cx, rate);
    let is_at_rest = || {
        let at = g.substitute_all(&flow.field(), &state);
        is_assumed(cx, &state)
            && is_regular(cx, flow, &state)
            && at.into_iter().all(|e| vanishes(cx, e))
    };
    if !loses
        || !is_analytic(cx, flow, rate)
        || !is_at_rest()
        || !is_least(cx, flow, energy, &state)
    {
        return None;
    }
    let valued = g.substitute(rate, &system.parameter_values());
    match cx
        .prover
        .identity(system, &[valued], &Manifold::default(), "")
    {
        Verdict::Refuted(mut found) => {
            flow.refuted_as_stated.set(true);
            "the rate of the energy".clone_into(&mut found.quantity);
            let g = &system.graph;
            let values = system.parameter_values();
            let occurs = |&(p, _): &(Expr, Expr)| {
                let symbol = g.as_symbol(p);
                symbol.is_some_and(|s| g.any_contains_any(&[rate, energy], &[s]))
            };
            let stated = match values.iter().any(occurs) {
                true => "for the values that the model states of its parameters ",
                false => "",
            };
            found.detail = format!(
                "{stated}the energy has a strict minimum at rest at the origin of the coordinates, by its second derivative, and its rate keeps one sign and is not zero: motions carry small neighbourhoods of that state, bounded by levels of the energy, into smaller ones, forwards or backwards, so no positive density free of the time is kept there; for the rate of the energy {}",
                found.detail
            );
            Some(Verdict::Refuted(found))
        }
        _ => None,
    }
}

/// Whether the motion is determined by its state nearby: without jumps, and away from poles and roots.
fn is_regular(cx: &Context<'_>, flow: &Flow<'_>, state: &State) -> bool {
    let field = flow.field();
    let bases = smooth_bases(&cx.system.graph, &field, true);
    arguments_of_signs(&cx.system.graph, &field).is_empty()
        && values_at(cx, state, &bases).is_some_and(|v| v.iter().all(|v| v.abs() > TINY))
        && values_at(cx, state, &field).is_some_and(|v| v.iter().all(|v| v.is_finite()))
}

/// Whether a function is analytic everywhere, but for absolute values of velocities: where it is not zero for velocities with certain
/// signs, it is not the zero function on these near any state either.
fn is_analytic(cx: &Context<'_>, flow: &Flow<'_>, e: Expr) -> bool {
    let g = &cx.system.graph;
    let own = flow.symbols();
    let is_velocity = |e: Expr| g.as_symbol(e).is_some_and(|s| own.contains(&s));
    g.reachable(&[e]).into_iter().all(|e| match g.node(e) {
        Node::Power { base, exponent } => {
            let is_whole = g.as_integer(*exponent).is_some_and(|n| n >= 0);
            is_whole || is_nowhere_zero(cx, *base) && is_of_one_sign(cx, *base)
        }
        Node::Apply {
            function,
            arguments,
        } => match function {
            Function::Sin | Function::Cos | Function::Exp | Function::Atan => true,
            Function::Abs => is_velocity(arguments[0]),
            _ => false,
        },
        Node::Solve { .. } | Node::Matrix { .. } => false,
        _ => true,
    })
}

/// Whether a function has no slopes at a state, and a second derivative that is positive by its leading minors.
fn is_least(cx: &Context<'_>, flow: &Flow<'_>, energy: Expr, state: &State) -> bool {
    let (system, g) = (cx.system, &cx.system.graph);
    let own: Vec<Symbol> = system
        .coordinate_symbols()
        .into_iter()
        .chain(flow.symbols())
        .collect();
    let values = system.parameter_values();
    let at = |es: &[Expr]| g.substitute_all(&g.substitute_all(es, state), &values);
    let slopes = g.gradient(energy, &own);
    let is_flat = at(&slopes).into_iter().all(|e| vanishes(cx, e));
    let assumed = chetaev_mechanics::prover::assumptions(system);
    let is_positive = |e: Expr, list: &Assumptions| known_sign(g, e, list).is_positive();
    is_flat && {
        let rows: Vec<Vec<Expr>> = slopes.iter().map(|&e| at(&g.gradient(e, &own))).collect();
        (1..=own.len()).all(|size| {
            let minor: Vec<Vec<Expr>> = rows[..size].iter().map(|r| r[..size].to_vec()).collect();
            is_positive(determinant(g, &minor), &assumed)
        })
    }
}
