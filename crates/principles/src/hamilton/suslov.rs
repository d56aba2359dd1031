//! `hamilton.suslov`: `∫(δL + Σ θ A δq + Σ Q δq) dt = 0` with δf = 0.

use super::{requirements, Form};
use crate::variations::{Displacements, Rule, Variation};
use chetaev_mechanics::claims::{Claim, Context, Finding, Group};

/// `hamilton.suslov`.
#[derive(Clone, Copy, Debug)]
pub struct Suslov;

static FORM: Form = Form {
    whose: "Suslov's",
    gives: "voronets",
    equations: "Voronets' equations",
    integrand,
    told: super::told::suslov,
};

/// `δL + Σ θ_l A^l_s δ_s` by Suslov's rule (T1 §3).
pub fn integrand(d: &Displacements<'_>) -> Variation {
    d.sum(&d.of_lagrangian(Rule::Suslov), &d.gyroscopic())
}

/// δL by Suslov's rule alone: the integrand with its terms `Σ θ A δq` dropped.
pub fn without_terms(d: &Displacements<'_>) -> Variation {
    d.of_lagrangian(Rule::Suslov)
}

impl Claim for Suslov {
    fn id(&self) -> &'static str {
        "hamilton.suslov"
    }

    fn group(&self) -> Group {
        Group::Principles
    }

    fn title(&self) -> &'static str {
        "Hamilton's principle in Suslov's form"
    }

    fn explanation(&self) -> &'static str {
        "∫(δL + Σ θ A δq + Σ Q δq) dt = 0, where the varied states obey the constraints, δf = 0, and therefore δv_d = D(δq_d) − Σ A δq \
         is not the rate of δq_d. θ are the momenta of the dependent velocities, A the curvature coefficients of the constraints. The \
         integrand is built by this rule, integrated by parts, and compared with Voronets' equations for all \
         accelerations, and with the motion. Whether the terms θ A vanish is hamilton.stationary-suslov. Example: z' = y x' \
         has A_x = y', A_y = −x' and θ = y x', so the integrand contains y x' (y' δx − x' δy). \
         At y = x' = 1 these terms are y' δx − δy; without them there would be y'' = y x'² = 1 instead of y'' = 0."
    }

    fn requires(&self, _: Option<&str>) -> Vec<String> {
        requirements()
    }

    fn decide(&self, cx: &Context<'_>, _: Option<&str>) -> Finding {
        FORM.decide(cx)
    }
}
