//! When no smooth positive density is kept at all, whatever it contains besides the time.
//!
//! For a motion X̄ free of the time and a density N(q, η), smooth and positive, `X̄ N + N div X̄ = 0`.
//!
//! 1. Where X̄ vanishes the divergence vanishes. Along a steady motion, on which angles turn uniformly and nothing else changes,
//!    ln N stays bounded; where the divergence is constant on it, it is zero.
//! 2. Let rest be admissible and the rates of η have neither terms without η nor linear ones, as for homogeneous quadratic ones.
//!    With N = N₀(q) + O(η) and div X̄ = d_i η^i + O(η²), the terms linear in η are `Y_i N₀ + d_i N₀ = 0`, whatever N: the
//!    density at rest is a function of the coordinates with prescribed derivatives along the admissible fields. That is the
//!    argument by which the conditions of Kozlov (1988) and others on densities of the coordinates decide on all of them.

use super::{classes, closed, dissipated, states, Flow, CONTRADICTION};
use crate::flag::{horizontal, Directed};
use chetaev_mechanics::system::Relation;
use chetaev_mechanics::{sample, Context, System};
use chetaev_symbolic::{Expr, Function, Graph, Node, Verdict};

/// States are given by values for the symbols that are not free there.
pub(super) type State = Vec<(Expr, Expr)>;

/// A refutation of all smooth positive densities free of the time.
pub(super) fn excluded(cx: &Context<'_>, flow: &Flow<'_>) -> Option<Verdict> {
    match flow.autonomous {
        true => at_states(cx, flow).or_else(|| linear_at_rest(cx, flow)),
        false => None,
    }
}

/// A refutation by the divergence at states of rest or on steady motions alone, which formulas of densities cannot tell: they
/// may be infinite there.
pub(super) fn at_states(cx: &Context<'_>, flow: &Flow<'_>) -> Option<Verdict> {
    let look = || match flow.autonomous {
        true => at_rest(cx, flow)
            .or_else(|| steady(cx, flow))
            .or_else(|| states::refuted(cx, flow))
            .or_else(|| dissipated::refuted(cx, flow)),
        false => None,
    };
    flow.at_states.get_or_init(look).clone()
}

/// η = 0, anywhere.
pub(super) fn rest(flow: &Flow<'_>, system: &System) -> State {
    let own = flow.chart.parameters.iter();
    own.map(|p| (p.value, system.graph.zero())).collect()
}

/// Whether rest is admissible everywhere and kept, all that is looked at being smooth there.
fn stays_at_rest(cx: &Context<'_>, flow: &Flow<'_>) -> bool {
    let (system, g) = (cx.system, &cx.system.graph);
    let state = rest(flow, system);
    let mut all = [&flow.chart.velocities[..], &flow.rates[..]].concat();
    all.extend(flow.masses.iter().map(|(_, rate)| *rate));
    let vanish = g.substitute_all(&all, &state);
    let mut moving = system.velocity_symbols();
    moving.extend(flow.symbols());
    let assumed = system.assumptions.iter();
    let sides: Vec<Expr> = assumed.flat_map(|a| [a.left, a.right]).collect();
    flow.chart.implicit().next().is_none()
        && !g.any_contains_any(&sides, &moving)
        && is_smooth(cx, flow, &state)
        && vanish.into_iter().all(|e| vanishes(cx, e))
}

/// All states at rest are kept, and the divergence is not zero there.
fn at_rest(cx: &Context<'_>, flow: &Flow<'_>) -> Option<Verdict> {
    let system = cx.system;
    if !stays_at_rest(cx, flow) {
        return None;
    }
    let divergence = system
        .graph
        .substitute(flow.divergence, &rest(flow, system));
    does_not_vanish(
        cx,
        flow,
        divergence,
        "the system may stay at rest, and the divergence of the motion is not zero there",
    )
}

/// The accelerations at rest have no part linear in the velocities, and what the divergence asks of the density there contradicts
/// the brackets of the admissible fields.
fn linear_at_rest(cx: &Context<'_>, flow: &Flow<'_>) -> Option<Verdict> {
    let fields = fields_at_rest(cx, flow)?;
    match closed(cx, flow, &fields).err().map(|verdict| *verdict) {
        Some(Verdict::Refuted(mut found)) => {
            // What contradicts stands first there.
            let residual = found.detail.strip_prefix(CONTRADICTION);
            found.detail = format!(
                "{CONTRADICTION}; as rest is admissible and the accelerations have neither terms without velocities nor terms \
                 linear in them there, no other smooth positive density exists either: the terms linear in the velocities of \
                 its equation are those for the density at rest{}{}",
                residual.unwrap_or_default(),
                classes::sources(cx, flow)
            );
            Some(Verdict::Refuted(found))
        }
        _ => None,
    }
}

/// The admissible fields with the derivatives of the logarithm of a density at rest along them, where every smooth positive
/// density has these.
pub(super) fn fields_at_rest(cx: &Context<'_>, flow: &Flow<'_>) -> Option<Vec<Directed>> {
    let (system, g) = (cx.system, &cx.system.graph);
    let (mut fields, _) = horizontal(system, &flow.chart).ok()?;
    if !flow.autonomous || !stays_at_rest(cx, flow) {
        return None;
    }
    let state = rest(flow, system);
    let slope = |e: Expr, i: usize| {
        let slope = g.diff(e, flow.chart.parameters[i].symbol);
        g.substitute(slope, &state)
    };
    for (i, field) in fields.iter_mut().enumerate() {
        if !flow.rates.iter().all(|&rate| vanishes(cx, slope(rate, i))) {
            return None;
        }
        let masses = flow.masses.iter();
        field.place.extend(masses.map(|&(_, rate)| slope(rate, i)));
        field.value = g.neg(slope(flow.divergence, i));
    }
    Some(fields)
}

/// At the origin of the coordinates: a motion at rest or with one velocity, on which at most angles turn.
fn steady(cx: &Context<'_>, flow: &Flow<'_>) -> Option<Verdict> {
    let choices = std::iter::once(None).chain((0..flow.chart.k()).map(Some));
    choices
        .into_iter()
        .find_map(|one| steady_with(cx, flow, one))
}

fn steady_with(cx: &Context<'_>, flow: &Flow<'_>, one: Option<usize>) -> Option<Verdict> {
    let (system, g) = (cx.system, &cx.system.graph);
    if flow.chart.implicit().next().is_some() {
        return None;
    }
    let own = flow.chart.parameters.iter().enumerate();
    let speeds: State = own
        .map(|(i, p)| (p.value, if Some(i) == one { g.one() } else { g.zero() }))
        .collect();
    // Which coordinates move there: angles only, and these stay free.
    let all_at = |turning: &[usize]| -> State {
        let places = system.coordinates.iter().enumerate();
        let fixed = places.filter(|(j, _)| !turning.contains(j));
        speeds
            .iter()
            .copied()
            .chain(fixed.map(|(_, c)| (c.q, g.zero())))
            .collect()
    };
    if !is_smooth(cx, flow, &all_at(&[])) {
        return None;
    }
    let velocities = g.substitute_all(&flow.chart.velocities, &all_at(&[]));
    let turning: Vec<usize> = (0..system.n())
        .filter(|&j| !vanishes(cx, velocities[j]))
        .collect();
    let is_angle = |&j: &usize| system.angles.contains(&system.coordinates[j].name);
    let state = all_at(&turning);
    if !turning.iter().all(is_angle) || !is_smooth(cx, flow, &state) || !is_assumed(cx, &state) {
        return None;
    }
    let velocities = g.substitute_all(&flow.chart.velocities, &state);
    let kept = |j: usize| match turning.contains(&j) {
        true => is_constant(cx, velocities[j]),
        false => vanishes(cx, velocities[j]),
    };
    let mut rates = flow.rates.clone();
    rates.extend(flow.masses.iter().map(|(_, rate)| *rate));
    let rates = g.substitute_all(&rates, &state);
    let divergence = g.substitute(flow.divergence, &state);
    let is_steady = (0..system.n()).all(kept) && rates.into_iter().all(|e| vanishes(cx, e));
    if !is_steady || !is_constant(cx, divergence) {
        return None;
    }
    let (moving, angles) = match one {
        Some(i) => (
            format!("with {} alone", flow.chart.parameters[i].name),
            true,
        ),
        None => ("at rest".to_owned(), false),
    };
    let why = match angles {
        true => ", where at most angles turn",
        false => "",
    };
    let sentence = format!(
        "the motion {moving} at the origin of the coordinates is steady{why}, and the divergence of the motion is constant and not zero on it"
    );
    does_not_vanish(cx, flow, divergence, &sentence)
}

/// A refutation where an expression is not zero.
fn does_not_vanish(cx: &Context<'_>, flow: &Flow<'_>, e: Expr, sentence: &str) -> Option<Verdict> {
    let nowhere = chetaev_mechanics::Manifold::default();
    let valued = cx.system.graph.substitute(e, &cx.system.parameter_values());
    let as_stated = cx.prover.identity(cx.system, &[valued], &nowhere, "");
    flow.refuted_as_stated
        .set(matches!(as_stated, Verdict::Refuted(_)));
    match cx.prover.identity(cx.system, &[e], &nowhere, "") {
        Verdict::Refuted(mut found) => {
            found.detail = format!(
                "{sentence}: no smooth positive density free of the time exists there; {}",
                found.detail
            );
            Some(Verdict::Refuted(found))
        }
        _ => None,
    }
}

pub(super) fn vanishes(cx: &Context<'_>, e: Expr) -> bool {
    let nowhere = chetaev_mechanics::Manifold::default();
    cx.system.graph.is_zero(e)
        || matches!(
            cx.prover.identity(cx.system, &[e], &nowhere, ""),
            Verdict::Proved(_)
        )
}

/// Whether an expression does not depend on coordinates.
pub(super) fn is_constant(cx: &Context<'_>, e: Expr) -> bool {
    let masses = cx.system.masses.iter().map(|m| m.symbol);
    let mut own = cx.system.coordinate_symbols().into_iter().chain(masses);
    own.all(|s| vanishes(cx, cx.system.graph.diff(e, s)))
}

/// Whether the state satisfies what the model assumes of its variables, for its values of the parameters.
pub(super) fn is_assumed(cx: &Context<'_>, state: &State) -> bool {
    let (system, g) = (cx.system, &cx.system.graph);
    let moves = |e: Expr| !g.is_free_of(e, &|s| system.moves(g.symbol_name(s)));
    let values = system.parameter_values();
    system.assumptions.iter().all(|a| {
        let difference = g.sub(a.right, a.left);
        if !moves(difference) {
            return true;
        }
        let at = g.substitute(g.substitute(difference, state), &values);
        let Ok(found) = g.evaluate_f64(&[at], &|_| None) else {
            return false;
        };
        let d = found.first().copied().unwrap_or(f64::NAN);
        match a.relation {
            Relation::NotEqual => d != 0.0,
            Relation::Less | Relation::LessOrEqual => d > 0.0,
        }
    })
}

/// Bases below this are taken for zero.
pub(super) const TINY: f64 = 1e-9;

/// Whether the motion is smooth at a state, by its form: no roots, poles or corners there.
fn is_smooth(cx: &Context<'_>, flow: &Flow<'_>, state: &State) -> bool {
    let mut all = [&flow.chart.velocities[..], &flow.rates[..]].concat();
    all.extend(flow.masses.iter().map(|(_, rate)| *rate));
    all.push(flow.divergence);
    let bases = smooth_bases(&cx.system.graph, &all, false);
    values_at(cx, state, &bases).is_some_and(|v| v.iter().all(|v| v.abs() > TINY))
        && values_at(cx, state, &all).is_some_and(|v| v.iter().all(|v| v.is_finite()))
}

/// What expressions are smooth away from the zeros of; `with_corners` that of absolute values is left out.
pub(super) fn smooth_bases(g: &Graph, all: &[Expr], with_corners: bool) -> Vec<Expr> {
    let mut bases = Vec::new();
    for e in g.reachable(all) {
        match g.node(e) {
            Node::Power { base, exponent } if g.as_integer(*exponent).is_none_or(|n| n < 0) => {
                bases.push(*base);
            }
            Node::Apply {
                function: Function::Sin | Function::Cos | Function::Exp | Function::Atan,
                ..
            } => {}
            Node::Apply {
                function: Function::Abs,
                ..
            } if with_corners => {}
            Node::Apply { arguments, .. } => bases.extend(arguments.iter().copied()),
            _ => {}
        }
    }
    bases
}

/// The values of expressions at a state, with what is free there as in an admissible one.
pub(super) fn values_at(cx: &Context<'_>, state: &State, es: &[Expr]) -> Option<Vec<f64>> {
    let (system, g) = (cx.system, &cx.system.graph);
    let point = sample::admissible_point(system, cx.terms, 0x6d_65_61)?;
    let at = g.substitute_all(es, state);
    g.evaluate_f64(&at, &|s| point.get(&s).copied()).ok()
}
