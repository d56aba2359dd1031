//! κ of a motion that lies on one of the sets on which the action is stationary.

use super::samples::Samples;
use chetaev_mechanics::Context;
use chetaev_principles::stationarity::{StationarySet, StationarySets};
use chetaev_symbolic::Expr;

/// A set is left by a motion that differs from it by more, in its own units.
const ON: f64 = 1e-8;

/// κ as functions of (q, v) on the set that the computed motion lies on.
///
/// # Errors
/// That it lies on none, or that κ is not unique there.
pub(super) fn multipliers(cx: &Context<'_>) -> Result<Vec<Expr>, String> {
    let sets = StationarySets::of(cx).ok_or("the sets of stationary motions are not known")?;
    let own = sets.sets.iter().filter(|set| is_of_velocities(cx, set));
    let mut lies = own.filter(|set| lies_on(cx, set) == Ok(true));
    let none = "the computed motion lies on none of those sets on which the action is stationary that are solved for coordinates and velocities";
    let set = lies.next().ok_or(none)?;
    let (g, r) = (&cx.system.graph, cx.selection.rows.len());
    (0..r)
        .map(|l| {
            let place = set.pivots.iter().position(|&pivot| pivot == l);
            let condition = place.map(|place| &set.conditions[place]);
            let determined = condition.filter(|condition| {
                let others = condition.coefficients.iter().enumerate();
                others.filter(|(m, _)| *m != l).all(|(_, &e)| g.is_zero(e))
            });
            determined.map(|condition| condition.right)
        })
        .collect::<Option<Vec<Expr>>>()
        .ok_or_else(|| "κ is not unique; an index belongs to a κ, not to the curve".into())
}

/// Whether the set is stated in coordinates and velocities of the system alone.
fn is_of_velocities(cx: &Context<'_>, set: &StationarySet) -> bool {
    let (system, g) = (cx.system, &cx.system.graph);
    let mut known = system.coordinate_symbols();
    known.extend(system.velocity_symbols());
    known.push(g.intern_symbol("t", 0));
    known.extend(system.parameters.iter().filter_map(|p| g.as_symbol(p.expr)));
    let values = set.solved.iter().map(|&(_, value)| value);
    let right = set.conditions.iter().map(|condition| condition.right);
    let all: Vec<Expr> = values.chain(right).collect();
    set.solved.iter().all(|(s, _)| known.contains(s))
        && g.symbols_in(&all).iter().all(|s| known.contains(s))
}

fn lies_on(cx: &Context<'_>, set: &StationarySet) -> Result<bool, String> {
    let g = &cx.system.graph;
    let solved = set.solved.iter();
    let residuals: Vec<Expr> = solved
        .map(|&(symbol, value)| g.sub(g.symbol_expr(symbol), value))
        .collect();
    let samples = Samples::new(cx, &[&residuals])?;
    let rows = 0..samples.times.len();
    let small = |row: usize| samples.at(0, row).iter().all(|x| x.abs() <= ON);
    Ok(rows.into_iter().all(small))
}
