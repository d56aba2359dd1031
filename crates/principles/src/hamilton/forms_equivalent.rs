//! `hamilton.forms-equivalent`: how the integrands of the four forms differ.

use super::phase::Phase;
use super::{hoelder, requirements, suslov, voronets};
use crate::variations::{Displacements, Variation};
use crate::words::formula;
use chetaev_mechanics::claims::{Claim, Context, Finding, Formula, Group};
use chetaev_mechanics::formulations::DeriveError;
use chetaev_mechanics::linear::dot;
use chetaev_symbolic::{Expr, Verdict};

/// `hamilton.forms-equivalent`.
#[derive(Clone, Copy, Debug)]
pub struct FormsEquivalent;

impl Claim for FormsEquivalent {
    fn id(&self) -> &'static str {
        "hamilton.forms-equivalent"
    }

    fn group(&self) -> Group {
        Group::Principles
    }

    fn title(&self) -> &'static str {
        "The integrands of Hölder's, Voronets' and Suslov's forms are one function"
    }

    fn explanation(&self) -> &'static str {
        "For the same virtual displacements, each form with its own rule for δv inserted: Hölder's, Voronets' and Suslov's integrands \
         are equal identically, for all accelerations; no total derivative and no equation of motion is needed. That of \
         Helmholtz and Poincaré differs from them by exactly Σ δp (q' − ∂H/∂p), which is no total derivative and vanishes where \
         q' = ∂H/∂p. The differences are computed and shown. Where ∂²L/∂v∂v is singular there is no H, and the three others are compared. \
         Example: z' = y x' at y = x' = y' = 1 with δx = 1 and δy = D(δx) = D(δy) = 0: Hölder's integrand x' D(δx) \
         + y' D(δy) + z' D(y δx) is z' y' δx = 1; in Voronets' and Suslov's forms δL* is 0, and θ (y' δx − x' δy) \
         is 1."
    }

    fn requires(&self, _: Option<&str>) -> Vec<String> {
        requirements()
    }

    fn decide(&self, cx: &Context<'_>, _: Option<&str>) -> Finding {
        decide(cx).unwrap_or_else(Finding::from)
    }
}

fn decide(cx: &Context<'_>) -> Result<Finding, DeriveError> {
    let g = &cx.system.graph;
    let d = Displacements::new(cx)?;
    let forms = [
        hoelder::integrand(&d),
        voronets::integrand(&d),
        suslov::integrand(&d),
    ];
    let differences = [
        (
            "Voronets' integrand minus Hölder's",
            d.difference(&forms[1], &forms[0]),
        ),
        (
            "Suslov's integrand minus Hölder's",
            d.difference(&forms[2], &forms[0]),
        ),
    ];
    let entries = |v: &Variation| [v.value.clone(), v.rate.clone()].concat();
    let residuals: Vec<Expr> = differences.iter().flat_map(|(_, v)| entries(v)).collect();
    let on = "for all accelerations and virtual displacements";
    let mut verdict = cx.prover.identity(cx.system, &residuals, d.manifold(), on);
    let mut formulas: Vec<Formula> = differences
        .iter()
        .filter_map(|(caption, v)| formula(cx, *caption, None, d.written(v)))
        .collect();
    let without_hamiltonian = matches!(
        cx.finding("model.hessian-regular").verdict,
        Verdict::Refuted(_)
    );
    let fourth = if without_hamiltonian {
        "; there is no form of Helmholtz and Poincaré, as ∂²L/∂v∂v is singular"
    } else {
        let (of_phase, difference) = in_phase_space(cx)?;
        verdict = verdict.and(of_phase);
        let caption = "integrand of Helmholtz and Poincaré minus the others, with Dq for q'";
        formulas.extend(formula(cx, caption, None, difference));
        "; that of Helmholtz and Poincaré differs by Σ δp (q' − ∂H/∂p)"
    };
    let sentence = match &verdict {
        Verdict::Proved(_) => {
            format!("the integrands of Hölder, Voronets and Suslov are equal identically{fourth}")
        }
        _ => "the integrands of the forms compared".into(),
    };
    verdict.prefix(&sentence);
    let zero = |f: &Formula| g.is_zero(f.right);
    // 0 is worth showing: it is the statement.
    formulas.sort_by_key(|f| !zero(f));
    Ok(Finding { verdict, formulas })
}

/// `δ(Σ p Dq − H) − Σ (L_q δq + p D(δq)) − Σ δp (Dq − ∂H/∂p)` vanishes, with L_q at v = ∂H/∂p; and the last sum.
fn in_phase_space(cx: &Context<'_>) -> Result<(Verdict, Expr), DeriveError> {
    let (system, g) = (cx.system, &cx.system.graph);
    let phase = Phase::new(cx)?;
    let slopes = g.gradient(system.lagrangian, &system.coordinate_symbols());
    let slopes = phase.legendre.restrict(system, &slopes);
    let values: Vec<Expr> = phase.legendre.momenta.iter().map(|p| p.value).collect();
    let difference = phase.kinematic(cx);
    let residual = g.add(&[
        phase.varied(cx),
        g.neg(dot(g, &slopes, &phase.displacements)),
        g.neg(dot(g, &values, &phase.moved_displacements)),
        g.neg(difference),
    ]);
    let on = "for all curves in phase space and their variations";
    let verdict = cx
        .prover
        .identity(system, &[residual], &phase.manifold(), on);
    Ok((verdict, difference))
}
