//! `model.metric-positive`: whether the kinetic metric of Jacobi's principle is positive on the admissible velocities.

use super::{Claim, Context, Finding, Group};
use crate::characteristics::Manifold;
use crate::claims::formulation::manifold;
use crate::formulations::stated_apart;
use crate::linear::dot;
use crate::prover::{located, Prover};
use crate::quadratic_forms::{nonnegative, positive_in_linear_forms};
use crate::system::System;
use chetaev_symbolic::verdict::{Counterexample, Proof};
use chetaev_symbolic::{Expr, Verdict};

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
    let at_rest: Vec<(Expr, Expr)> = velocities.iter().map(|&v| (v, g.zero())).collect();
    let rows = cx.terms.mass_matrix.iter();
    let momenta: Vec<Expr> = rows
        .map(|row| dot(g, &g.substitute_all(row, &at_rest), &velocities))
        .collect();
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
