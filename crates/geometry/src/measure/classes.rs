//! Classes of systems for which the conditions on brackets are those of the literature, where they are established.

use super::excluded::{rest, vanishes};
use super::Flow;
use chetaev_mechanics::Context;
use chetaev_symbolic::{Expr, Verdict};

/// The class with its sources, in words to append to a verdict; none for a system of neither.
pub(super) fn sources(cx: &Context<'_>, flow: &Flow<'_>) -> &'static str {
    if flow.chart.k() > 0 && is_quadratic_without_coordinates(cx, flow) {
        return "; the rates of the velocities η contain no coordinates and are homogeneous quadratic, as those of left-invariant constraints on a group (Suslov's problem), for which this is the condition of Kozlov (1988) and Jovanović (1998)";
    }
    match cx.finding("model.chaplygin").verdict {
        Verdict::Proved(_) if !cx.system.constraints.is_empty() => {
            "; the system is one of Chaplygin's (`model.chaplygin`), for which this is the condition of Stanchenko (1989) and of Cantrijn, Cortés, de León and Martín de Diego (2002)"
        }
        _ => "",
    }
}

/// The form of the Euler-Poincaré-Suslov equations.
fn is_quadratic_without_coordinates(cx: &Context<'_>, flow: &Flow<'_>) -> bool {
    let (system, g) = (cx.system, &cx.system.graph);
    if !flow.autonomous || !flow.masses.is_empty() || system.constraints.is_empty() {
        return false;
    }
    let own = flow.symbols();
    let by_places = system.coordinate_symbols().into_iter();
    let slopes = by_places.flat_map(|s| flow.rates.iter().map(move |&e| g.diff(e, s)));
    if !slopes
        .collect::<Vec<Expr>>()
        .into_iter()
        .all(|e| vanishes(cx, e))
    {
        return false;
    }
    // Euler's theorem, and nothing of lower degree.
    let euler = flow.rates.iter().map(|&e| {
        let parts = flow.chart.parameters.iter().zip(&own);
        let mut parts: Vec<Expr> = parts
            .map(|(p, &s)| g.mul(&[p.value, g.diff(e, s)]))
            .collect();
        parts.push(g.mul(&[g.integer(-2), e]));
        g.add(&parts)
    });
    let state = rest(flow, system);
    let is_defined = g.substitute_all(&flow.rates, &state);
    euler
        .collect::<Vec<Expr>>()
        .into_iter()
        .all(|e| vanishes(cx, e))
        && is_defined.into_iter().all(|e| vanishes(cx, e))
}
