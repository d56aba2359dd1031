//! `noether.contraction#j`: Ȳ ⌟ Ω̄ = dG in every component, for a first integral that was found.

use super::{of_generator, of_subject, of_subject_there, requirements, subjects};
use crate::noether::generator::Generator;
use crate::noether::search::Integral;
use chetaev_mechanics::claims::{Claim, Context, Finding, Group};

/// `noether.contraction#j`.
#[derive(Clone, Copy, Debug)]
pub struct Contraction;

impl Claim for Contraction {
    fn id(&self) -> &'static str {
        "noether.contraction"
    }

    fn group(&self) -> Group {
        Group::Integrals
    }

    fn title(&self) -> &'static str {
        "The field of a first integral contracts the 2-form to dG"
    }

    fn explanation(&self) -> &'static str {
        "On the fields that annihilate the constraints the dynamical 2-form Ω̄ has rank 2k, and a function G is a first integral exactly when some field Ȳ has Ȳ ⌟ Ω̄ = dG; Ȳ is unique up to multiples of the motion. Every component of Ȳ ⌟ Ω̄ - dG, along dt, along the contact forms and along the velocities, is proved to vanish."
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
    let statement = "the symmetry, contracted with the dynamical 2-form, gives the differential in every component";
    of_generator(cx, integral, statement, Generator::contraction)
}
