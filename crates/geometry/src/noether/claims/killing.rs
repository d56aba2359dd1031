//! `noether.killing#j`: the Killing-type equations, for a first integral that was found.

use super::{of_generator, of_subject, of_subject_there, requirements, subjects};
use crate::noether::search::Integral;
use chetaev_mechanics::claims::{Claim, Context, Finding, Group};

/// `noether.killing#j`.
#[derive(Clone, Copy, Debug)]
pub struct Killing;

impl Claim for Killing {
    fn id(&self) -> &'static str {
        "noether.killing"
    }

    fn group(&self) -> Group {
        Group::Integrals
    }

    fn title(&self) -> &'static str {
        "The Killing-type equations hold for the field of a first integral"
    }

    fn explanation(&self) -> &'static str {
        "The field (δ, ξ) and the gauge g of a first integral satisfy the Killing-type equations of Noether's theorem for constrained systems: one for each independent velocity and one along the motion with velocities frozen. They contain no accelerations. δ = 1 for the energy and δ = 0 for other integrals; ξ = -W̄⁻¹ ∂G + η δ."
    }

    fn requires(&self, _: Option<&str>) -> Vec<String> {
        requirements()
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        subjects(cx)
    }

    fn decide(&self, cx: &Context<'_>, subject: Option<&str>) -> Finding {
        of_subject(cx, subject, decide)
    }

    fn decide_there(
        &self,
        cx: &Context<'_>,
        subject: Option<&str>,
        there: &Context<'_>,
    ) -> Finding {
        of_subject_there((cx, there), (self, subject), decide)
    }
}

fn decide(cx: &Context<'_>, integral: &Integral) -> Finding {
    of_generator(
        cx,
        integral,
        "the Killing-type equations",
        |generator, n| {
            let mut residuals = generator.killing_speeds(n);
            residuals.push(generator.killing_drift(n));
            residuals
        },
    )
}
