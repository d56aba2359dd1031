//! The sets of states whose motions make the action stationary, as values: what a state is drawn from, with its κ.

use super::cases::{with_multipliers, Found, Leaf};
use super::closed_form::short;
use super::closure::Condition;
use super::motion::Motion;
use super::stationary::set_aside_unconfirmed;
use crate::words::listed;
use chetaev_mechanics::claims::Context;
use chetaev_symbolic::{Expr, Symbol};
use std::sync::Arc;

/// States whose motions make the action stationary.
#[derive(Clone, Debug)]
pub struct StationarySet {
    /// Symbols of the state with their values, free of all these symbols.
    pub solved: Vec<(Symbol, Expr)>,
    /// What vanishes exactly on the set, also at other turns of its angles.
    pub vanishing: Vec<Expr>,
    /// The conditions on κ there, each solved for one multiplier: its coefficient is 1, and zero in the others.
    pub conditions: Vec<Condition>,
    /// The place of the multiplier for which each condition is solved.
    pub pivots: Vec<usize>,
}

/// All sets found for a system.
#[derive(Clone, Debug)]
pub struct StationarySets {
    /// Independent speeds: with the coordinates they are the state.
    pub speeds: Vec<Symbol>,
    /// The velocities of the coordinates as functions of the state.
    pub velocities: Vec<Expr>,
    /// The sets whose equations are all solved.
    pub sets: Vec<StationarySet>,
    /// Of every set, solved or not, what vanishes on it.
    pub vanishing: Vec<Vec<Expr>>,
    /// Whether no other motion makes the action stationary, whatever the parameters are.
    pub complete: bool,
}

/// Found once for all that ask.
#[derive(Debug)]
pub(super) struct Sets(pub(super) Found);

/// The motions for which κ exists, confirmed by the zero test.
pub(super) fn found(cx: &Context<'_>, motion: &Motion) -> Arc<Sets> {
    cx.shared(|cx| {
        let mut found = with_multipliers(cx, motion);
        set_aside_unconfirmed(cx, motion, &mut found);
        Sets(found)
    })
}

impl StationarySets {
    /// The sets that `hamilton.stationary` states; `None` where the motion is not had in closed form, or they were not looked
    /// for.
    pub fn of(cx: &Context<'_>) -> Option<StationarySets> {
        cx.finding("hamilton.stationary");
        let motion = cx.known::<Result<Motion, String>>()?;
        let motion = motion.as_ref().as_ref().ok()?;
        let found = cx.known::<Sets>()?;
        let leaves = found.0.leaves.iter();
        let coordinates = cx.system.coordinates.iter();
        let rate = |symbol| motion.rate(&cx.system.graph, symbol);
        Some(StationarySets {
            speeds: motion.speeds.clone(),
            velocities: coordinates.map(|c| rate(c.q_symbol)).collect(),
            sets: leaves.clone().filter_map(|leaf| set(cx, leaf)).collect(),
            vanishing: leaves
                .map(|leaf| leaf.vanishing(&cx.system.graph))
                .collect(),
            complete: found.0.is_complete(),
        })
    }
}

/// Functions of (q, v, t) and the multipliers on each set of motions that make the action stationary without all of them doing so, where κ is determined
/// there, with the equations of the set; rest is left out.
pub(crate) fn on_sets(
    cx: &Context<'_>,
    functions: &[Expr],
    kappa: &[Expr],
) -> Vec<(String, Vec<Expr>)> {
    let g = &cx.system.graph;
    cx.finding("hamilton.stationary");
    let (Some(motion), Some(sets)) = (cx.known::<Result<Motion, String>>(), cx.known::<Sets>())
    else {
        return Vec::new();
    };
    let Ok(motion) = motion.as_ref() else {
        return Vec::new();
    };
    let on = |leaf: &Leaf| {
        let values: Option<Vec<Expr>> = leaf.kappa.iter().copied().collect();
        let pairs: Vec<(Expr, Expr)> = kappa.iter().copied().zip(values?).collect();
        let at = |&e: &Expr| {
            let e = motion.on_states(g, g.substitute(e, &pairs));
            short(g, g.substitute_all(&[e], &leaf.substitutions(g))[0])
        };
        Some((listed(&leaf.equations), functions.iter().map(at).collect()))
    };
    let moving = sets.0.leaves.iter().filter(|leaf| !leaf.at_rest);
    moving.filter_map(on).collect()
}

/// A set all of whose equations are solved.
fn set(cx: &Context<'_>, leaf: &Leaf) -> Option<StationarySet> {
    if !leaf.implicit.is_empty() || leaf.has_roots() {
        return None;
    }
    let solved = leaf.solved.iter();
    let solved: Option<Vec<(Symbol, Expr)>> = solved
        .map(|&(symbol, value)| Some((cx.system.graph.as_symbol(symbol)?, value)))
        .collect();
    let (pivots, conditions) = leaf.conditions().into_iter().unzip();
    Some(StationarySet {
        solved: solved?,
        vanishing: leaf.vanishing(&cx.system.graph),
        conditions,
        pivots,
    })
}
