//! All transversal eigenvalues lie left of the axis.

use crate::about::{About, Said, Statement};
use crate::evidence::{counted, unstable};
use crate::hurwitz::Crossing;
use crate::multiplicity::defects;
use crate::question::Place;
use chetaev_symbolic::verdict::Counterexample;
use dashu_ratio::RBig;

/// `stability.asymptotic#j`: all transversal eigenvalues lie left of the axis.
#[derive(Clone, Copy, Debug)]
pub struct Asymptotic;

impl Statement for Asymptotic {
    fn id(&self) -> &'static str {
        "stability.asymptotic"
    }

    fn title(&self) -> &'static str {
        "All eigenvalues of the linear equations about the steady motion, but the zeros of its family, lie left of the imaginary axis"
    }

    fn explanation(&self) -> &'static str {
        include_str!("asymptotic.md")
    }

    fn said(&self, about: &About<'_>, place: Place, _: Option<&RBig>) -> Said {
        let question = &about.question;
        let further = question
            .polynomial
            .as_ref()
            .map_or(0, |own| own.further_zeros);
        match place {
            Place::Left if question.deciding(about.graph()).is_empty() => Said::Holds(
                "all eigenvalues are zeros of the family of steady motions; there is no other".into(),
            ),
            Place::Left => Said::Holds("Hurwitz's determinants are all positive".into()),
            Place::OnAxis if question.spectrum.paired.is_none() && further > 0 && !is_chain(about) => Said::Open(
                "an eigenvalue is zero and belongs to no family of steady motions that was found: the linear equations decide nothing".into(),
            ),
            _ => Said::Fails,
        }
    }

    fn at_border(&self, holds_beside: bool, crossing: Option<Crossing>) -> Option<bool> {
        match crossing {
            None => holds_beside.then_some(true),
            Some(Crossing::Pair | Crossing::Pairs | Crossing::Collision) => Some(false),
            // A zero may be that of a family that is there for this value alone.
            Some(
                Crossing::Zero
                | Crossing::ZeroTouching
                | Crossing::Infinity
                | Crossing::Singular
                | Crossing::Touching,
            ) => None,
        }
    }

    fn counterexample(&self, about: &About<'_>, place: Place, at: Option<&RBig>) -> Counterexample {
        let paired = about.question.spectrum.paired.as_ref();
        let motion = "the linear equations about the steady motion";
        match place {
            Place::Right => unstable(about, at),
            Place::NotLeft => counted(
                "the number of pairs of opposite eigenvalues is at least",
                1,
                format!("{motion} have an eigenvalue on the axis, or two that are mirror images of each other"),
            ),
            _ if paired.is_none() => counted(
                "the number of zero eigenvalues beside those of the family is",
                1,
                format!("{motion} have the eigenvalue 0 more often than it has eigenvectors, which the family of steady motions cannot exceed"),
            ),
            _ => counted(
                "the number of eigenvalues on the imaginary axis, but zero",
                paired.map_or(0, |own| own.len() - 1),
                format!("{motion} have eigenvalues on the axis, which are their own mirror images"),
            ),
        }
    }
}

/// Whether zero has fewer eigenvectors than its multiplicity: a family of steady motions has no more dimensions than these.
fn is_chain(about: &About<'_>) -> bool {
    let found = defects(about.graph(), &about.question, None).unwrap_or_default();
    found.iter().any(|own| own.factor.is_none())
}
