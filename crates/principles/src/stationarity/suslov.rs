//! `hamilton.stationary-suslov`: whether Suslov's form is `∫δL dt = 0`.

use super::cases::where_zero;
use super::motion::Motion;
use super::stationary::{
    alternatives, legend, moving_first, not_followed, only, place, requirements,
    set_aside_unconfirmed,
};
use crate::variations::Displacements;
use crate::words::{conditional, for_general_controls, formula, listed};
use chetaev_mechanics::claims::formulation::basis;
use chetaev_mechanics::claims::{once_where, Claim, Context, Finding, Formula, Group};
use chetaev_mechanics::formulations::DeriveError;
use chetaev_mechanics::prover::assumptions;
use chetaev_symbolic::factors::factors;
use chetaev_symbolic::matrix::determinant;
use chetaev_symbolic::verdict::Proof;
use chetaev_symbolic::zero::known_sign;
use chetaev_symbolic::{Expr, Graph, Verdict};

/// `hamilton.stationary-suslov`.
#[derive(Clone, Copy, Debug)]
pub struct StationarySuslov;

impl Claim for StationarySuslov {
    fn id(&self) -> &'static str {
        "hamilton.stationary-suslov"
    }

    fn group(&self) -> Group {
        Group::Principles
    }

    fn title(&self) -> &'static str {
        "Suslov's form of Hamilton's principle is ∫δL dt = 0"
    }

    fn explanation(&self) -> &'static str {
        "Suslov's form ∫(δL + Σ θ A δq) dt = 0 becomes ∫δL dt = 0, with δf = 0, where its further terms vanish: Σ_l θ_l A^l_s = 0 for \
         all s, with the momenta θ of the dependent velocities and the curvature coefficients A of the constraints. It is the condition of \
         stationarity with κ = −θ; for Chaplygin systems it suffices, for others also ∂L*/∂q_d = 0 along the motion is \
         needed, so it neither implies hamilton.stationary in general nor follows from it; and it depends on which velocities are called dependent. `proved`: identically, or on all motions; `conditional`: \
         on the motions stated, rest among them; `refuted`: on no motion that was found but rest. Example: for a rolling disc θ A vanishes although A does not; for z' = y x' it is y x' (y', −x'). \
         At y = x' = y' = 1 that is (1, −1), so this motion does not satisfy the condition."
    }

    fn requires(&self, _: Option<&str>) -> Vec<String> {
        requirements()
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        once_where(cx.terms.order <= 1)
    }

    fn decide(&self, cx: &Context<'_>, _: Option<&str>) -> Finding {
        decide(cx).unwrap_or_else(Finding::from)
    }
}

fn decide(cx: &Context<'_>) -> Result<Finding, DeriveError> {
    let d = Displacements::new(cx)?;
    let terms = d.gyroscopic().value;
    let formulas: Vec<Formula> = d
        .chart
        .independent
        .iter()
        .zip(&terms)
        .filter_map(|(&i, &e)| {
            let name = &cx.system.coordinates[i].name;
            formula(cx, format!("Σ θ A of δ{name}"), None, e)
        })
        .collect();
    let on = "at all admissible states, for all accelerations";
    let mut verdict = cx.prover.identity(cx.system, &terms, d.manifold(), on);
    let sentence = match &verdict {
        Verdict::Proved(_) => {
            "Σ θ A = 0 identically: Suslov's form is ∫δL dt = 0 for all admissible curves"
        }
        Verdict::Refuted(_) => return on_motions(cx, &d, &terms, formulas),
        _ => "the terms Σ θ A of Suslov's form",
    };
    verdict.prefix(sentence);
    Ok(Finding { verdict, formulas })
}

fn on_motions(
    cx: &Context<'_>,
    d: &Displacements<'_>,
    terms: &[Expr],
    formulas: Vec<Formula>,
) -> Result<Finding, DeriveError> {
    let terms = d.on_motion(cx, terms)?;
    let on = "on every motion";
    let names = d.chart.independent.iter();
    let names = names.map(|&i| format!("Σ θ A of δ{}", cx.system.coordinates[i].name));
    let named: Vec<(String, Expr)> = names.zip(terms.iter().copied()).collect();
    let mut verdict = cx
        .prover
        .named_identity(cx.system, &named, d.manifold(), on);
    match &verdict {
        Verdict::Proved(_) => verdict.prefix("Σ θ A = 0 on every motion, though not for all accelerations: Suslov's form is ∫δL dt = 0",
        ),
        Verdict::Refuted(_) => return Ok(on_subsets(cx, &terms, verdict, formulas)),
        _ => verdict.prefix("the terms Σ θ A of Suslov's form"),
    }
    Ok(Finding { verdict, formulas })
}

/// The motions on which Σ θ A vanishes although it does not on all.
fn on_subsets(
    cx: &Context<'_>,
    terms: &[Expr],
    mut refuted: Verdict,
    formulas: Vec<Formula>,
) -> Finding {
    let g = &cx.system.graph;
    let motion = Motion::of(cx);
    let motion = match &*motion {
        Ok(motion) => motion,
        Err(why) => {
            let sentence = format!(
                "Σ θ A does not vanish on every motion; on which it does was not found: {why}"
            );
            refuted.prefix(&sentence);
            return Finding {
                verdict: refuted,
                formulas,
            };
        }
    };
    let terms: Vec<Expr> = terms.iter().map(|&e| motion.on_states(g, e)).collect();
    let slopes = slopes(cx, motion);
    let mut found = where_zero(cx, motion, &terms, &slopes);
    set_aside_unconfirmed(cx, motion, &mut found);
    let open = format!("{}{}", for_general_controls(cx), not_followed(&found));
    let all = moving_first(&found);
    if all.first().is_none_or(|leaf| leaf.at_rest) {
        let rest = match all.as_slice() {
            [] => String::new(),
            rest => format!("; it does at rest where {}", alternatives(rest)),
        };
        refuted.prefix(&format!(
            "Σ θ A does not vanish on every motion{rest}{open}"
        ));
        return Finding {
            verdict: refuted,
            formulas,
        };
    }
    let stated = format!(
        "{}{}{}",
        alternatives(&all),
        legend(cx, motion),
        with_dependent(g, &slopes)
    );
    let condition = format!("{stated}{open}");
    let how = "the terms were differentiated along the motion in every case, exactly";
    let proof = Proof::exact(place(cx, motion), how);
    let mut verdict = conditional(condition, proof, refuted);
    verdict.prefix(&format!(
        "Σ θ A = 0 on motions {}where {stated}{open}",
        only(&found)
    ));
    Finding { verdict, formulas }
}

/// Where the terms have no value, as the dependent velocities are divided by zero.
fn with_dependent(g: &Graph, slopes: &[Expr]) -> String {
    let slopes: Vec<String> = slopes
        .iter()
        .map(|&e| format!("{} ≠ 0", g.text(e)))
        .collect();
    if slopes.is_empty() {
        String::new()
    } else {
        format!(
            " (with {}, as the constraints are solved for the dependent velocities)",
            listed(&slopes)
        )
    }
}

/// By what the dependent velocities are divided.
fn slopes(cx: &Context<'_>, motion: &Motion) -> Vec<Expr> {
    if motion.implicit.is_empty() {
        motion.dependent_poles.clone()
    } else {
        slopes_that_vanish(cx)
    }
}

/// Factors of the determinant of ∂f/∂v on the dependent velocities, of constraints that are not solved for these.
fn slopes_that_vanish(cx: &Context<'_>) -> Vec<Expr> {
    let (system, g) = (cx.system, &cx.system.graph);
    let jacobian = basis(cx).jacobian();
    let columns = |row: &Vec<Expr>| cx.selection.dependent.iter().map(|&d| row[d]).collect();
    let block: Vec<Vec<Expr>> = jacobian.iter().map(columns).collect();
    let known = assumptions(system);
    let list = factors(g, determinant(g, &block), &system.velocity_symbols()).unwrap_or_default();
    let list = list.into_iter().map(|(factor, _)| factor);
    list.filter(|&e| !known_sign(g, e, &known).is_nonzero())
        .collect()
}
