//! Multipliers that the conditions leave free, in closed form: `κ' = Φ κ − λ` integrated along the motion.

use super::motion::Motion;
use chetaev_mechanics::claims::formulation::basis;
use chetaev_mechanics::claims::Context;
use chetaev_mechanics::equations::unused_name;
use chetaev_mechanics::System;
use chetaev_symbolic::{simplify, Expr, Graph, Node};

/// κ of one constraint with its constant of integration.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Integrated {
    /// κ as a function of the state, the time and the constant.
    pub(crate) value: Expr,
}

/// κ_l where its rate contains no multiplier and is a constant multiple of the rate of a function at hand: the roots in the
/// constraints, the momenta of the dependent velocities, velocities, coordinates and the time; or where
/// `D(κ + θ) = ∂L/∂q` is constant (T1 (13')).
pub(crate) fn integrated(cx: &Context<'_>, motion: &Motion, l: usize) -> Option<Integrated> {
    let (system, g) = (cx.system, &cx.system.graph);
    if motion.transport[l].iter().any(|&e| !g.is_zero(e)) {
        return None;
    }
    let rate = g.neg(motion.multipliers[l]);
    let constant = free_constant(system, g, basis(cx).constraint_names()[l]);
    if g.is_zero(rate) {
        return Some(Integrated { value: constant });
    }
    let mut moving = motion.state();
    moving.push(g.intern_symbol("t", 0));
    let simple = |e: Expr| simplify::simplify(g, e, &simplify::Options::default());
    for candidate in candidates(cx, motion, l) {
        let moved = motion.along(cx, candidate);
        let moved = simple(moved);
        if g.is_zero(moved) {
            continue;
        }
        let ratio = simple(g.div(rate, moved));
        if !g.contains_any(ratio, &moving) {
            let value = simple(g.add(&[g.mul(&[ratio, candidate]), constant]));
            return Some(Integrated { value });
        }
    }
    let theta = momentum(cx, motion, l)?;
    let rest = simple(g.add(&[rate, motion.along(cx, theta)]));
    let time = g.symbol("t", 0);
    let value = g.add(&[g.neg(theta), g.mul(&[rest, time]), constant]);
    (!g.contains_any(rest, &moving)).then(|| Integrated {
        value: simple(value),
    })
}

/// The constant of integration of κ of a constraint.
pub(crate) fn free_constant(system: &System, g: &Graph, constraint: &str) -> Expr {
    g.symbol(&unused_name(system, &format!("const_{constraint}")), 0)
}

/// Functions whose rates may be proportional to λ.
fn candidates(cx: &Context<'_>, motion: &Motion, l: usize) -> Vec<Expr> {
    let (system, g) = (cx.system, &cx.system.graph);
    let mut list: Vec<Expr> = g
        .reachable(&basis(cx).constraints())
        .into_iter()
        .filter(|&e| matches!(g.node(e), Node::Power { exponent, .. } if g.as_integer(*exponent).is_none()))
        .map(|e| motion.on_states(g, e))
        .collect();
    list.extend(momentum(cx, motion, l));
    list.extend(motion.speeds.iter().map(|&s| g.symbol_expr(s)));
    list.extend(system.coordinates.iter().map(|c| motion.on_states(g, c.v)));
    list.extend(system.coordinates.iter().map(|c| c.q));
    list.push(g.symbol("t", 0));
    list
}

/// θ of the dependent velocity of a constraint, divided by ∂f/∂v: the multiplier −κ of Suslov's form.
fn momentum(cx: &Context<'_>, motion: &Motion, l: usize) -> Option<Expr> {
    let (system, g) = (cx.system, &cx.system.graph);
    let d = *cx.selection.dependent.get(l)?;
    let slope = *basis(cx).jacobian().get(l)?.get(d)?;
    if g.is_zero(slope) {
        return None;
    }
    let theta = g.diff(system.lagrangian, system.coordinates[d].v_symbol);
    Some(motion.on_states(g, g.div(theta, slope)))
}
