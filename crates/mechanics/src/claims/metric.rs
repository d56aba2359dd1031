//! `model.metric-positive`: whether the kinetic metric of Jacobi's principle is positive on the admissible velocities.

use super::{Claim, Context, Finding, Group};
use crate::bodies;
use crate::characteristics::{Characteristics, Manifold};
use crate::claims::formulation::manifold;
use crate::formulations::stated_apart;
use crate::linear::dot;
use crate::prover::{located, Prover};
use crate::quadratic_forms::{is_nonnegative_by_minors, nonnegative, positive_in_linear_forms};
use crate::system::System;
use chetaev_symbolic::verdict::{Counterexample, Proof};
use chetaev_symbolic::{Expr, Symbol, Verdict};

/// The claim.
#[derive(Clone, Copy, Debug)]
pub struct MetricPositive;

/// Field operations for the sign.
const BUDGET: u64 = 20_000_000;

const ON: &str = "at every admissible state";

impl Claim for MetricPositive {
    fn id(&self) -> &'static str {
        "model.metric-positive"
    }

    fn group(&self) -> Group {
        Group::Model
    }

    fn title(&self) -> &'static str {
        "The part of the Lagrangian quadratic in the velocities is positive on the admissible velocities"
    }

    fn explanation(&self) -> &'static str {
        "Jacobi's principle measures paths by √(2F), F = L₂ = ½ vᵀ W v, and needs F > 0 along them; by the energy integral \
         that is h + L₀ > 0. Refuted: F is positive at no admissible velocity, so that no path has a length. Conditional: at \
         some velocities it is, at others not."
    }

    fn requires(&self, _: Option<&str>) -> Vec<String> {
        vec![
            "model.accelerations-unique".into(),
            "model.lagrangian-quadratic".into(),
        ]
    }

    fn decide(&self, cx: &Context<'_>, _: Option<&str>) -> Finding {
        let (system, g) = (cx.system, &cx.system.graph);
        for (values, when) in [
            (Vec::new(), ""),
            (
                system.parameter_values(),
                "for the values of the parameters ",
            ),
        ] {
            if bodies::has_positive_energies(system, &values) {
                let on = located("wherever both sides are defined", ON, system);
                let detail = format!("{when}the kinetic energy is the sum of ½ m v² + ½ ω·Jω of bodies and particles, and none of these is negative");
                return Verdict::Proved(Proof::structural(on, detail)).into();
            }
        }
        if let Some(kinetic) = stated_apart(system).map(|(kinetic, _)| kinetic) {
            let valued = g.substitute(kinetic, &system.parameter_values());
            let detail = "the kinetic energy is a quadratic form that is nowhere negative by its leading minors";
            let found = [(kinetic, ""), (valued, "for the values of the parameters ")];
            for (form, values) in found {
                if positive_in_linear_forms(system, form).is_some() {
                    let on = located("wherever both sides are defined", ON, system);
                    let proof = Proof::structural(on, format!("{values}{detail}"));
                    return Verdict::Proved(proof).into();
                }
            }
        }
        if let Some(proof) = by_minors(cx) {
            return Verdict::Proved(proof).into();
        }
        let metric = metric(cx);
        let prover = Prover {
            budget: cx.prover.budget.min(BUDGET),
            ..cx.prover.clone()
        };
        let manifold = manifold(cx);
        let general = by_signs(system, &prover, &manifold, metric);
        let values = system.parameter_values();
        if matches!(general, Verdict::Proved(_)) || values.is_empty() {
            return general.into();
        }
        let substituted = manifold.substituted(g, &values);
        let mut valued = by_signs(system, &prover, &substituted, g.substitute(metric, &values));
        match valued {
            Verdict::Conditional { .. } => general.into(),
            _ => {
                valued.prefix("for the values of the parameters");
                valued.into()
            }
        }
    }
}

/// Sylvester's criterion for the mass matrix, or for `BᵀWB` on the admissible velocities `v = B P`; for general values of the parameters or
/// for those stated.
fn by_minors(cx: &Context<'_>) -> Option<Proof> {
    let (system, g) = (cx.system, &cx.system.graph);
    let values = system.parameter_values();
    let whole = at_rest(cx);
    let restricted =
        restricted(cx, &whole).map(|m| (m, "the mass matrix on the admissible velocities"));
    let matrices = std::iter::once((whole, "the mass matrix")).chain(restricted);
    for (matrix, what) in matrices {
        let valued = |row: &Vec<Expr>| g.substitute_all(row, &values);
        let valued: Vec<Vec<Expr>> = matrix.iter().map(valued).collect();
        for (matrix, when) in [(matrix, ""), (valued, "for the values of the parameters ")] {
            if is_nonnegative_by_minors(system, &matrix) {
                let on = located("wherever both sides are defined", ON, system);
                let detail = format!("{when}{what} is nowhere negative by its leading minors (Sylvester's criterion)");
                return Some(Proof::structural(on, detail));
            }
        }
    }
    None
}

/// `BᵀWB` where the admissible velocities are `v = B P`, B free of velocities.
fn restricted(cx: &Context<'_>, mass: &[Vec<Expr>]) -> Option<Vec<Vec<Expr>>> {
    let (system, g) = (cx.system, &cx.system.graph);
    let chart = Characteristics::independent_velocities(system, cx.terms, cx.selection).ok()?;
    let own: Vec<Symbol> = chart.parameters.iter().map(|p| p.symbol).collect();
    let all = [&system.velocity_symbols()[..], &own[..]].concat();
    let pairs: Vec<(Expr, Expr)> = chart
        .parameters
        .iter()
        .map(|p| (p.value, g.zero()))
        .collect();
    let is_homogeneous = |&phi: &Expr| g.is_zero(g.substitute(phi, &pairs));
    let is_linear = !g.any_contains_any(&chart.basis.concat(), &all);
    if chart.order > 1 || !is_linear || !chart.velocities.iter().all(is_homogeneous) {
        return None;
    }
    let columns: Vec<Vec<Expr>> = (0..chart.k())
        .map(|i| chart.basis.iter().map(|row| row[i]).collect())
        .collect();
    let image =
        |column: &Vec<Expr>| -> Vec<Expr> { mass.iter().map(|row| dot(g, row, column)).collect() };
    let images: Vec<Vec<Expr>> = columns.iter().map(image).collect();
    let row = |a: &Vec<Expr>| images.iter().map(|b| dot(g, a, b)).collect();
    Some(columns.iter().map(row).collect())
}

/// W at rest, which is W for the Lagrangians in question.
fn at_rest(cx: &Context<'_>) -> Vec<Vec<Expr>> {
    let (system, g) = (cx.system, &cx.system.graph);
    let own = system.coordinates.iter();
    let at_rest: Vec<(Expr, Expr)> = own.map(|c| (c.v, g.zero())).collect();
    let rows = cx.terms.mass_matrix.iter();
    rows.map(|row| g.substitute_all(row, &at_rest)).collect()
}

/// The signs that F takes on the manifold.
fn by_signs(system: &System, prover: &Prover, manifold: &Manifold, metric: Expr) -> Verdict {
    let sign = |e: Expr| nonnegative(system, prover, manifold, e, ON);
    let positive = sign(metric);
    let Some(below) = point(&positive) else {
        return positive;
    };
    match sign(system.graph.neg(metric)) {
        Verdict::Proved(proof) => Verdict::Refuted(Counterexample {
            quantity: "|F| − F".into(),
            detail: format!(
                "F = ½ vᵀ W v is positive at no admissible velocity ({})",
                proof.detail
            ),
            ..below
        }),
        other => match point(&other) {
            Some(above) => Verdict::Conditional {
                condition: "F = ½ vᵀ W v > 0".into(),
                proof: Proof::exact(
                    ON,
                    format!(
                        "F takes both signs; it is positive at a state: {}",
                        above.detail
                    ),
                ),
                counterexample: Some(Counterexample {
                    quantity: "|F| − F".into(),
                    ..below
                }),
            },
            None => other,
        },
    }
}

/// ½ vᵀ W v.
fn metric(cx: &Context<'_>) -> Expr {
    let (system, g) = (cx.system, &cx.system.graph);
    let velocities: Vec<Expr> = system.coordinates.iter().map(|c| c.v).collect();
    let rows = at_rest(cx);
    let momenta: Vec<Expr> = rows.iter().map(|row| dot(g, row, &velocities)).collect();
    g.div(dot(g, &velocities, &momenta), g.integer(2))
}

/// The state at which something is not so.
fn point(verdict: &Verdict) -> Option<Counterexample> {
    match verdict {
        Verdict::Refuted(found)
        | Verdict::Conditional {
            counterexample: Some(found),
            ..
        } => Some(found.clone()),
        _ => None,
    }
}
