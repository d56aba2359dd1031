//! `noether.structure#j`: the structure equations, for a first integral that was found.

use super::{of_generator, of_subject, of_subject_there, requirements, subjects};
use crate::noether::search::Integral;
use chetaev_mechanics::claims::{Claim, Context, Finding, Group};

/// `noether.structure#j`.
#[derive(Clone, Copy, Debug)]
pub struct Structure;

impl Claim for Structure {
    fn id(&self) -> &'static str {
        "noether.structure"
    }

    fn group(&self) -> Group {
        Group::Integrals
    }

    fn title(&self) -> &'static str {
        "The structure equations hold for the field of a first integral"
    }

    fn explanation(&self) -> &'static str {
        "The condition of Noether's theorem evaluated on the basis of fields on the constraint manifold gives one equation for each ∂/∂η (the first of the Killing-type equations), one for each field Y_i, from which the components ζ along the velocities are found, and one for Y_0. All of them hold for the field and the gauge of a first integral."
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
    of_generator(cx, integral, "the structure equations", |generator, n| {
        let mut residuals = generator.killing_speeds(n);
        residuals.extend(generator.along_fields(n));
        residuals.push(generator.along_time(n));
        residuals
    })
}
