//! Separation of variables in the coordinates given: the conditions of Levi-Civita (1904) on H₁, and a complete integral by one
//! quadrature where all coordinates but one are cyclic.

use super::applicable::{checked, free, multipliers, no_closed_form};
use super::extremum::Extremum;
use chetaev_mechanics::claims::formulation::{basis, manifold};
use chetaev_mechanics::claims::{Context, Finding};
use chetaev_mechanics::equations::unused_name;
use chetaev_mechanics::formulations::DeriveError;
use chetaev_mechanics::linear::dot;
use chetaev_mechanics::system::CompleteIntegral;
use chetaev_symbolic::{Expr, Symbol, Verdict};

/// Larger H₁, in nodes, are not differentiated twice.
const LARGEST: usize = 2_000;

/// For each pair i < j, what vanishes where `H₁(q, S_q) = E` separates additively in the coordinates:
/// `Hⁱ Hʲ H_ij − Hⁱ H_j H_iʲ − H_i Hʲ Hⁱ_j + H_i H_j Hⁱʲ`, with lower indices for ∂/∂q, upper ones for ∂/∂π.
pub fn levi_civita(cx: &Context<'_>, extremum: &Extremum) -> Vec<Expr> {
    let (system, g, n) = (cx.system, &cx.system.graph, cx.system.n());
    let coordinates = system.coordinate_symbols();
    let lower = g.gradient(extremum.hamiltonian, &coordinates);
    let upper = g.gradient(extremum.hamiltonian, &extremum.symbols);
    let mut conditions = Vec::new();
    for i in 0..n {
        for j in i + 1..n {
            let (q, p) = (coordinates[j], extremum.symbols[j]);
            let second = |e: Expr, s: Symbol| g.diff(e, s);
            conditions.push(g.add(&[
                g.mul(&[upper[i], upper[j], second(lower[i], q)]),
                g.neg(g.mul(&[upper[i], lower[j], second(lower[i], p)])),
                g.neg(g.mul(&[lower[i], upper[j], second(upper[i], q)])),
                g.mul(&[lower[i], lower[j], second(upper[i], p)]),
            ]));
        }
    }
    conditions
}

pub(super) fn decide(cx: &Context<'_>) -> Result<Finding, DeriveError> {
    let g = &cx.system.graph;
    let Some(extremum) = Extremum::new(cx) else {
        return Ok(no_closed_form(cx).into());
    };
    if g.reachable(&[extremum.hamiltonian]).len() > LARGEST {
        return Ok(Verdict::undecided("H₁ is too large for the conditions of Levi-Civita").into());
    }
    if let Some(integral) = separated(cx, &extremum) {
        let what = "H₁ depends on one coordinate at most; separated by that, S is";
        let found = checked(cx, &extremum, &integral, what)?;
        if matches!(found.verdict, Verdict::Proved(_)) {
            return Ok(found);
        }
    }
    let conditions = levi_civita(cx, &extremum);
    let on = "for all q and π";
    let mut verdict = cx.prover.identity(cx.system, &conditions, &free(), on);
    let sentence = match &verdict {
        Verdict::Proved(_) => {
            "S_t + H₁ = 0 separates in these coordinates, S = −E t + Σ S_i(q_i): the conditions of Levi-Civita hold"
        }
        Verdict::Refuted(_) => {
            "S_t + H₁ = 0 does not separate in these coordinates; it may in others"
        }
        _ => "the conditions of Levi-Civita on H₁",
    };
    verdict.prefix(sentence);
    Ok(verdict.into())
}

/// The complete integral `S = −E t + Σ α q + ∫π dq` where all coordinates but one, or all, are cyclic in H₁.
pub fn separated(cx: &Context<'_>, extremum: &Extremum) -> Option<CompleteIntegral> {
    let (system, g) = (cx.system, &cx.system.graph);
    let coordinates = system.coordinate_symbols();
    let time = g.intern_symbol("t", 0);
    let occurs = |s: Symbol| g.contains_any(extremum.hamiltonian, &[s]);
    let essential: Vec<usize> = (0..system.n())
        .filter(|&i| occurs(coordinates[i]))
        .collect();
    if essential.len() > 1 || occurs(time) {
        return None;
    }
    // Where every coordinate is cyclic, the last one gives its constant to E.
    let own = essential.first().copied().unwrap_or(system.n() - 1);
    let energy = g.intern_symbol(&unused_name(system, "E"), 0);
    let mut constants = vec![energy];
    let mut momenta = extremum.momenta.clone();
    let mut parts = vec![g.neg(g.mul(&[g.symbol_expr(energy), g.symbol_expr(time)]))];
    let mut cyclic = Vec::new();
    for (i, c) in system
        .coordinates
        .iter()
        .enumerate()
        .filter(|(i, _)| *i != own)
    {
        let alpha = g.intern_symbol(&unused_name(system, &format!("alpha_{}", c.name)), 0);
        constants.push(alpha);
        cyclic.push((i, alpha));
        momenta[i] = g.symbol_expr(alpha);
        parts.push(g.mul(&[momenta[i], c.q]));
    }
    let momentum = momentum(cx, extremum, own, &momenta, energy)?;
    Some(CompleteIntegral {
        action: g.add(&parts),
        constants,
        quadratures: vec![(own, momentum)],
        motion: on_motions(cx, &cyclic),
    })
}

/// π of the one coordinate from `H₁ = E`, a quadratic equation, with the positive root.
fn momentum(
    cx: &Context<'_>,
    extremum: &Extremum,
    own: usize,
    momenta: &[Expr],
    energy: Symbol,
) -> Option<Expr> {
    let g = &cx.system.graph;
    let symbol = extremum.symbols[own];
    let of = extremum.at(cx, extremum.hamiltonian, momenta);
    let of = g.sub(of, g.symbol_expr(energy));
    let zero = [(extremum.momenta[own], g.zero())];
    let slope = g.diff(of, symbol);
    let curvature = g.diff(slope, symbol);
    if g.contains_any(curvature, &[symbol]) || g.is_zero(curvature) {
        return None;
    }
    let (rest, slope) = (g.substitute(of, &zero), g.substitute(slope, &zero));
    let (rest, slope, curvature) = (short(cx, rest), short(cx, slope), short(cx, curvature));
    // ½ c π² + b π + a = 0.
    let radicand = g.sub(
        g.mul(&[slope, slope]),
        g.mul(&[g.integer(2), curvature, rest]),
    );
    Some(g.div(g.sub(g.sqrt(short(cx, radicand)), slope), curvature))
}

fn short(cx: &Context<'_>, e: Expr) -> Expr {
    crate::stationarity::by_sines(&cx.system.graph, e)
}

/// The cyclic momenta that are zero on all motions: `p + Σ κ ∂f/∂v` with the κ of the motions.
fn on_motions(cx: &Context<'_>, cyclic: &[(usize, Symbol)]) -> Vec<(Symbol, Expr)> {
    let (system, g) = (cx.system, &cx.system.graph);
    let Some(kappa) = multipliers(cx).filter(|kappa| !kappa.is_empty()) else {
        return Vec::new();
    };
    let momenta = g.gradient(system.lagrangian, &system.velocity_symbols());
    let jacobian = basis(cx).jacobian();
    let vanishes = |i: usize| {
        let reaction = dot(g, &kappa, jacobian.iter().map(|row| &row[i]));
        let momentum = [g.add(&[momenta[i], reaction])];
        let verdict = cx.prover.identity(system, &momentum, &manifold(cx), "");
        matches!(verdict, Verdict::Proved(_))
    };
    let zero = cyclic.iter().filter(|(i, _)| vanishes(*i));
    zero.map(|&(_, alpha)| (alpha, g.zero())).collect()
}
