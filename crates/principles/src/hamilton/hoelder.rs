//! `hamilton.hoelder`: `∫(δL + Σ Q δq) dt = 0` with `δv = D(δq)`.

use super::{requirements, Form};
use crate::variations::{Displacements, Rule, Variation};
use chetaev_mechanics::claims::{Claim, Context, Finding, Group};

/// `hamilton.hoelder`.
#[derive(Clone, Copy, Debug)]
pub struct Hoelder;

static FORM: Form = Form {
    whose: "Hölder's",
    gives: "maggi",
    equations: "Maggi's equations, and with multipliers Routh's",
    integrand,
    told: super::told::hoelder,
};

/// δL by Hölder's rule (T1 §3).
pub fn integrand(d: &Displacements<'_>) -> Variation {
    d.of_lagrangian(Rule::Hoelder)
}

impl Claim for Hoelder {
    fn id(&self) -> &'static str {
        "hamilton.hoelder"
    }

    fn group(&self) -> Group {
        Group::Principles
    }

    fn title(&self) -> &'static str {
        "Hamilton's principle in Hölder's form"
    }

    fn explanation(&self) -> &'static str {
        "∫(δL + Σ Q δq) dt = 0 for all virtual displacements that vanish at the ends, with δv = D(δq) for all velocities. The varied \
         curves violate the constraints in general, so this is not stationarity of the action among admissible curves, \
         see hamilton.stationary. The integrand is built by the rule, integrated by parts, and its local equations are \
         compared with Maggi's for all accelerations, and with the accelerations of Routh's equations. Controls u(t) in the constraints \
         are functions of the time and not varied. Example: a particle z' = y x' with L = (x'² + y'² + z'²)/2 and δz = y δx: \
         the integrand is x' D(δx) + y' D(δy) + z' D(y δx), which gives x'' + y z'' = 0 and y'' = 0. \
         At y = x' = y' = 1 these are x'' = −1/2, z'' = 1/2, y'' = 0."
    }

    fn requires(&self, _: Option<&str>) -> Vec<String> {
        requirements()
    }

    fn decide(&self, cx: &Context<'_>, _: Option<&str>) -> Finding {
        FORM.decide(cx)
    }
}
