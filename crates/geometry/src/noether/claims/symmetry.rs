//! The symmetry of a function where it is an integral: everywhere, for some parameters, or on a part of the states.

use super::parts::Part;
use super::{generator_formulas, on_manifold};
use crate::noether::embedded::Embedded;
use crate::noether::generator::Generator;
use chetaev_mechanics::claims::{Context, Finding, Formula};
use chetaev_mechanics::Manifold;
use chetaev_symbolic::{Expr, Verdict};

/// The verdict on the Killing-type equations, and the generator as formulas.
pub(super) type Symmetry = (Verdict, Vec<Formula>);

/// The generator of a function with δ = 0, and left minus right sides of the Killing-type equations for it.
fn generated<'a>(
    cx: &Context<'a>,
    value: Expr,
) -> Result<(Embedded<'a>, Generator, Vec<Expr>), String> {
    let n = Embedded::of(cx)?;
    let zero = cx.system.graph.zero();
    let generator = Generator::of(&n, value, zero).map_err(|problem| problem.to_string())?;
    let mut residuals = generator.killing_speeds(&n);
    residuals.push(generator.killing_drift(&n));
    Ok((n, generator, residuals))
}

/// The symmetry of a function that is an integral on every motion.
pub(super) fn symmetry(cx: &Context<'_>, value: Expr) -> Symmetry {
    let (n, generator, residuals) = match generated(cx, value) {
        Ok(parts) => parts,
        Err(why) => return (Verdict::undecided(why), Vec::new()),
    };
    let verdict = on_manifold(cx, &n, &residuals);
    (verdict, generator_formulas(cx, &n, &generator))
}

/// The symmetry of a function that is an integral once parameters are replaced.
pub(super) fn symmetry_for(
    cx: &Context<'_>,
    value: Expr,
    resolved: &dyn Fn(Expr) -> Expr,
) -> Option<Symmetry> {
    let (n, generator, residuals) = generated(cx, value).ok()?;
    let residuals: Vec<Expr> = residuals.into_iter().map(resolved).collect();
    let manifold = with_values(n.manifold(), resolved);
    let verdict = cx
        .prover
        .identity(cx.system, &residuals, &manifold, "for these parameters");
    let generator = Generator {
        xi: generator.xi.into_iter().map(resolved).collect(),
        zeta: generator.zeta.into_iter().map(resolved).collect(),
        gauge: resolved(generator.gauge),
        ..generator
    };
    Some((verdict, generator_formulas(cx, &n, &generator)))
}

/// A manifold with parameters replaced.
pub(super) fn with_values(manifold: &Manifold, resolved: &dyn Fn(Expr) -> Expr) -> Manifold {
    let solved = manifold.solved.iter().map(|&(s, e)| (s, resolved(e)));
    let implicit = manifold.implicit.iter().map(|&(f, s)| (resolved(f), s));
    Manifold {
        solved: solved.collect(),
        implicit: implicit.collect(),
    }
}

/// The symmetry of a function that is an integral on parts of the states: its field is tangent to them, as the parts are invariant.
pub(super) fn symmetry_on(cx: &Context<'_>, value: Expr, all: &[Part]) -> Option<Symmetry> {
    let (n, generator, residuals) = generated(cx, value).ok()?;
    let g = &cx.system.graph;
    // Parts are given in (t, q, v), the equations in the quasi-velocities of the chart.
    let speeds = n.embedding.chart.parameters.iter();
    let pairs: Vec<(Expr, Expr)> = speeds.map(|p| (p.value, p.definition)).collect();
    let residuals: Vec<Expr> = g
        .substitute_all(&residuals, &pairs)
        .into_iter()
        .map(|e| cx.system.with_definitions(e))
        .collect();
    let on = "on this part of the constraint manifold";
    let each = all.iter().map(|part| {
        cx.prover
            .identity(cx.system, &residuals, &part.manifold, on)
    });
    let verdict = each.reduce(Verdict::and)?;
    Some((verdict, generator_formulas(cx, &n, &generator)))
}

/// A verdict that holds under a condition, with the symmetry where its equations are proved there.
pub(super) fn with_symmetry(verdict: Verdict, symmetry: Option<Symmetry>) -> Finding {
    let (killing, formulas) = match symmetry {
        Some((killing @ (Verdict::Proved(_) | Verdict::Conditional { .. }), formulas)) => {
            (killing, formulas)
        }
        _ => return verdict.into(),
    };
    let killing = match killing {
        Verdict::Conditional { proof, .. } => Verdict::Proved(proof),
        other => other,
    };
    let killing = killing.prefixed("the Killing-type equations hold there for its symmetry");
    let verdict = match verdict {
        Verdict::Conditional {
            condition,
            proof,
            counterexample,
        } => match Verdict::Proved(proof).and(killing) {
            Verdict::Proved(proof) => Verdict::Conditional {
                condition,
                proof,
                counterexample,
            },
            other => other,
        },
        other => other.and(killing),
    };
    Finding { verdict, formulas }
}
