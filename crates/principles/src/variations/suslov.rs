//! `variation.suslov`: varied states that satisfy the constraints.

use super::{Displacements, Rule, Variation};
use crate::words::formula;
use chetaev_mechanics::claims::formulation::basis;
use chetaev_mechanics::claims::{once_where, Claim, Context, Finding, Formula, Group};
use chetaev_mechanics::formulations::DeriveError;
use chetaev_symbolic::verdict::Proof;
use chetaev_symbolic::{Expr, Verdict};

/// `variation.suslov`.
#[derive(Clone, Copy, Debug)]
pub struct Suslov;

impl Claim for Suslov {
    fn id(&self) -> &'static str {
        "variation.suslov"
    }

    fn group(&self) -> Group {
        Group::Principles
    }

    fn title(&self) -> &'static str {
        "Varied states satisfy the constraints to first order (Suslov's rule)"
    }

    fn explanation(&self) -> &'static str {
        "Suslov's rule: δv = D(δq) for the independent velocities, and δf = 0, so that the dependent ones vary by δv_d = δφ = \
         D(δq_d) − Σ A δq with the curvature coefficients A of the constraints. Proved is that δf = 0 for these variations, with \
         A computed from D(∂φ/∂v) − ∂φ/∂q − (∂φ/∂q_d)(∂φ/∂v). The detail says whether δv is also the rate of δq: only \
         where A = 0, that is for integrable constraints, are varied states those of varied curves. Example: a skate with x and φ independent, \
         y' = tan φ x', has δy' = D(δy) − (φ' δx − x' δφ)/cos² φ."
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        once_where(cx.terms.order <= 1)
    }

    fn decide(&self, cx: &Context<'_>, _: Option<&str>) -> Finding {
        decide(cx).unwrap_or_else(Finding::from)
    }
}

fn decide(cx: &Context<'_>) -> Result<Finding, DeriveError> {
    if cx.selection.rows.is_empty() {
        let detail = "there are no constraints, and Suslov's rule is Hölder's";
        return Ok(Verdict::Proved(Proof::structural("everywhere", detail)).into());
    }
    let d = Displacements::new(cx)?;
    let by_curvature = velocities(cx, &d);
    let on = "at all admissible states, for all accelerations and virtual displacements";
    let residuals = varied_constraints(cx, &d, &by_curvature);
    let mut verdict = cx.prover.identity(cx.system, &residuals, d.manifold(), on);
    let sentence = match &verdict {
        Verdict::Proved(_) => format!("δf = 0 by Suslov's rule; {}", compared(cx, &d)),
        _ => "δf by Suslov's rule".into(),
    };
    verdict.prefix(&sentence);
    Ok(Finding {
        verdict,
        formulas: formulas(cx, &d),
    })
}

/// δv with `D(δq_d) − Σ A δq` for the dependent velocities.
fn velocities(cx: &Context<'_>, d: &Displacements<'_>) -> Vec<Variation> {
    let g = &cx.system.graph;
    let mut varied = d.velocities(Rule::Hoelder);
    for (&l, row) in d.chart.dependent.iter().zip(d.curvature()) {
        for (value, a) in varied[l].value.iter_mut().zip(row) {
            *value = g.sub(*value, a);
        }
    }
    varied
}

/// The coefficients of `Σ f_q δq + f_v δv`.
fn varied_constraints(
    cx: &Context<'_>,
    d: &Displacements<'_>,
    velocities: &[Variation],
) -> Vec<Expr> {
    let (system, g) = (cx.system, &cx.system.graph);
    let basis = basis(cx);
    let slopes = g.jacobian(&basis.constraints(), &system.coordinate_symbols());
    let displacements = d.displacements();
    let mut residuals = Vec::new();
    for (jacobian, slopes) in basis.jacobian().iter().zip(slopes) {
        let by_velocities = d.combination(&d.chart.restrict(system, jacobian), velocities);
        let by_displacements = d.combination(&d.chart.restrict(system, &slopes), &displacements);
        let varied = d.sum(&by_velocities, &by_displacements);
        residuals.extend(varied.value);
        residuals.extend(varied.rate);
    }
    residuals
}

/// Whether δv is the rate of δq.
fn compared(cx: &Context<'_>, d: &Displacements<'_>) -> String {
    let curvature = d.curvature().concat();
    match cx.prover.identity(cx.system, &curvature, d.manifold(), "") {
        Verdict::Proved(_) => {
            "A = 0, so δv = D(δq) and Suslov's varied states are those of varied curves".into()
        }
        Verdict::Refuted(_) => {
            "A ≠ 0, so δv is not the rate of δq and the varied states belong to no varied curve"
                .into()
        }
        _ => "whether A = 0 was not decided".to_string(),
    }
}

/// δv of the dependent velocities.
fn formulas(cx: &Context<'_>, d: &Displacements<'_>) -> Vec<Formula> {
    let varied = d.velocities(Rule::Suslov);
    let dependent = d.chart.dependent.iter();
    dependent
        .filter_map(|&i| {
            let name = &cx.system.coordinates[i].name;
            formula(
                cx,
                format!("δ{name}' by Suslov's rule"),
                None,
                d.written(&varied[i]),
            )
        })
        .collect()
}
