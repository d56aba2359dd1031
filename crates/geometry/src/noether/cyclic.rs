//! Cyclic independent velocities: those whose momenta are first integrals because nothing drives them.
//!
//! In the embedded equations `X̄(p_i) = N_i + A^j (∂_jC^α_i) L_α` (T3 (10)) the right side of a cyclic η^i vanishes on N: neither L̄, nor
//! brackets of the fields, nor forces act along Y_i. Of coordinates that do not occur this is Lagrange's case; for quasi-velocities
//! and under constraints the coordinates may occur all the same.

use super::embedded::{dot, Embedded};
use super::motion::Motion;
use chetaev_mechanics::Context;
use chetaev_symbolic::{Expr, Verdict};

/// The numbers of the cyclic independent velocities.
///
/// # Errors
/// A sentence that says why the motion is not known.
pub(crate) fn cyclic(cx: &Context<'_>, n: &Embedded<'_>) -> Result<Vec<usize>, String> {
    let g = &cx.system.graph;
    let chart = &n.embedding.chart;
    let definitions: Vec<Expr> = chart.parameters.iter().map(|p| p.definition).collect();
    let rates = chart.restrict(cx.system, &Motion::of(cx)?.derivatives(&definitions));
    let driven = |i: usize| g.add(&[n.right[i], dot(g, &rates, &n.turning[i])]);
    let moves = |i: usize| n.hessian[i].iter().any(|&e| !g.is_zero(e));
    let vanishes = |i: usize| {
        let verdict = cx
            .prover
            .identity(cx.system, &[driven(i)], n.manifold(), "");
        matches!(verdict, Verdict::Proved(_))
    };
    Ok((0..n.k()).filter(|&i| moves(i) && vanishes(i)).collect())
}
