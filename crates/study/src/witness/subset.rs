//! κ of a motion that lies on one of the sets on which the action is stationary.

use super::kappa::Unknown;
use super::samples::Samples;
use chetaev_mechanics::Context;
use chetaev_principles::stationarity::{StationarySet, StationarySets};
use chetaev_symbolic::{Expr, Symbol};

/// A set is left by a motion that differs from it by more, in its own units.
const ON: f64 = 1e-8;

/// κ as functions of (q, v) on the set that the computed motion lies on.
///
/// # Errors
/// That it lies on none, or that κ is not unique there.
pub(super) fn multipliers(cx: &Context<'_>) -> Result<Vec<Expr>, Unknown> {
    let other = |why: &str| Unknown::Other(why.into());
    let sets = StationarySets::of(cx)
        .ok_or_else(|| other("the sets of stationary motions are not known"))?;
    let speeds = speeds(cx, &sets).unwrap_or_default();
    let known = known(cx, &speeds);
    let own = sets.sets.iter().filter(|set| is_known(cx, set, &known));
    let mut lies = own.filter(|set| lies_on(cx, set, &speeds) == Ok(true));
    let none = "the computed motion lies on none of those sets on which the action is stationary that are solved for coordinates, velocities and speeds";
    let set = lies.next().ok_or_else(|| other(none))?;
    let (g, r) = (&cx.system.graph, cx.selection.rows.len());
    (0..r)
        .map(|l| {
            let place = set.pivots.iter().position(|&pivot| pivot == l);
            let condition = place.map(|place| &set.conditions[place]);
            let determined = condition.filter(|condition| {
                let others = condition.coefficients.iter().enumerate();
                others.filter(|(m, _)| *m != l).all(|(_, &e)| g.is_zero(e))
            });
            determined.map(|condition| g.substitute(condition.right, &speeds))
        })
        .collect::<Option<Vec<Expr>>>()
        .ok_or_else(|| {
            let why = "κ is not unique there, and the motion an abnormal extremal too (ν₀ = 0); an index belongs to a κ, not to the curve";
            Unknown::Free(why.into())
        })
}

/// The speeds that are no velocities of coordinates, as functions of (q, v): where v is affine in the speeds u, v = A u + b, these
/// are `(Aᵀ A)⁻¹ Aᵀ (v − b)`.
fn speeds(cx: &Context<'_>, sets: &StationarySets) -> Option<Vec<(Expr, Expr)>> {
    let (system, g) = (cx.system, &cx.system.graph);
    let own = system.velocity_symbols();
    let other = |s: &&Symbol| !own.contains(s);
    if sets.speeds.iter().filter(other).count() == 0 {
        return Some(Vec::new());
    }
    let slopes = g.jacobian(&sets.velocities, &sets.speeds);
    if g.any_contains_any(&slopes.concat(), &sets.speeds) {
        return None;
    }
    let at_rest: Vec<(Expr, Expr)> = sets
        .speeds
        .iter()
        .map(|&s| (g.symbol_expr(s), g.zero()))
        .collect();
    let rest = g.substitute_all(&sets.velocities, &at_rest);
    let k = sets.speeds.len();
    let product = |s: usize, with: &dyn Fn(usize) -> Expr| {
        let terms = (0..system.n()).map(|i| g.mul(&[slopes[i][s], with(i)]));
        g.add(&terms.collect::<Vec<Expr>>())
    };
    let entries = (0..k).flat_map(|s| (0..k).map(move |t| (s, t)));
    let gram: Vec<Expr> = entries
        .map(|(s, t)| product(s, &|i| slopes[i][t]))
        .collect();
    let moving = |i: usize| g.sub(system.coordinates[i].v, rest[i]);
    let right: Vec<Expr> = (0..k).map(|s| product(s, &moving)).collect();
    let values = g.solve(&gram, &right).ok()?;
    let pairs = sets.speeds.iter().zip(values);
    let pairs = pairs.filter(|(s, _)| !own.contains(s));
    Some(pairs.map(|(&s, value)| (g.symbol_expr(s), value)).collect())
}

/// What is known along a motion: coordinates, velocities, speeds, the time and parameters.
fn known(cx: &Context<'_>, speeds: &[(Expr, Expr)]) -> Vec<Symbol> {
    let (system, g) = (cx.system, &cx.system.graph);
    let mut known = system.coordinate_symbols();
    known.extend(system.velocity_symbols());
    known.push(g.intern_symbol("t", 0));
    known.extend(system.parameters.iter().filter_map(|p| g.as_symbol(p.expr)));
    known.extend(speeds.iter().filter_map(|&(s, _)| g.as_symbol(s)));
    known
}

/// Whether the set is stated in what is known alone.
fn is_known(cx: &Context<'_>, set: &StationarySet, known: &[Symbol]) -> bool {
    let g = &cx.system.graph;
    let values = set.solved.iter().map(|&(_, value)| value);
    let right = set.conditions.iter().map(|condition| condition.right);
    let all: Vec<Expr> = values.chain(right).collect();
    set.solved.iter().all(|(s, _)| known.contains(s))
        && g.symbols_in(&all).iter().all(|s| known.contains(s))
}

fn lies_on(cx: &Context<'_>, set: &StationarySet, speeds: &[(Expr, Expr)]) -> Result<bool, String> {
    let residuals = cx.system.graph.substitute_all(&set.vanishing, speeds);
    let samples = Samples::new(cx, &[&residuals])?;
    let rows = 0..samples.times.len();
    let small = |row: usize| samples.at(0, row).iter().all(|x| x.abs() <= ON);
    Ok(rows.into_iter().all(small))
}
