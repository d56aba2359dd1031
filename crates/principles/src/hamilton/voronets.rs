//! `hamilton.voronets`: `∫(δL* + Σ θ (δv_d − δφ) + Σ Q δq) dt = 0` with `δv = D(δq)`.

use super::{by_dependent_momenta, requirements, Form};
use crate::variations::{Displacements, Rule, Variation};
use chetaev_mechanics::claims::{Claim, Context, Finding, Group};

/// `hamilton.voronets`.
#[derive(Clone, Copy, Debug)]
pub struct Voronets;

static FORM: Form = Form {
    whose: "Voronets'",
    gives: "voronets",
    equations: "Voronets' equations",
    integrand,
    told: super::told::voronets,
};

/// `δL* + Σ θ (δv_d − δφ)` by Hölder's rule, from the restricted Lagrangian (T1 §3).
pub fn integrand(d: &Displacements<'_>) -> Variation {
    let restricted = d.vary(&[d.restricted_lagrangian()]).swap_remove(0);
    let curves = by_dependent_momenta(d, &d.velocities(Rule::Hoelder));
    let states = by_dependent_momenta(d, &d.velocities(Rule::Suslov));
    d.sum(&restricted, &d.difference(&curves, &states))
}

impl Claim for Voronets {
    fn id(&self) -> &'static str {
        "hamilton.voronets"
    }

    fn group(&self) -> Group {
        Group::Principles
    }

    fn title(&self) -> &'static str {
        "Hamilton's principle in Voronets' form"
    }

    fn explanation(&self) -> &'static str {
        "∫(δL* + Σ θ (δv_d − δφ) + Σ Q δq) dt = 0 with δv = D(δq): L* is the Lagrangian with the dependent velocities v_d = φ \
         eliminated, θ their momenta ∂L/∂v_d from the full Lagrangian. The second term repairs what the elimination loses, as varied curves \
         do not obey v_d = φ. Its local equations are compared with Voronets' for all accelerations, and with the motion. \
         Without the second term there would be Lagrange's equations for L*, which are wrong. Example: z' = y x', L* = \
         ((1 + y²) x'² + y'²)/2, θ = y x', δz' − δφ = y' δx − x' δy. \
         The motion has (1 + y²) x'' + y x' y' = 0 and y'' = 0, at y = x' = y' = 1 x'' = −1/2 and y'' = 0; \
         Lagrange's equations for L* would give x'' = −1 and y'' = 1 there."
    }

    fn requires(&self, _: Option<&str>) -> Vec<String> {
        requirements()
    }

    fn decide(&self, cx: &Context<'_>, _: Option<&str>) -> Finding {
        FORM.decide(cx)
    }
}
