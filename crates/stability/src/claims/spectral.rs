//! No eigenvalue lies right of the axis.

use crate::about::{About, Said, Statement};
use crate::evidence::unstable;
use crate::hurwitz::Crossing;
use crate::question::Place;
use chetaev_symbolic::verdict::Counterexample;
use dashu_ratio::RBig;

/// `stability.spectral#j`: no eigenvalue lies right of the axis.
#[derive(Clone, Copy, Debug)]
pub struct Spectral;

impl Statement for Spectral {
    fn id(&self) -> &'static str {
        "stability.spectral"
    }

    fn title(&self) -> &'static str {
        "No eigenvalue of the linear equations about the steady motion lies right of the imaginary axis"
    }

    fn explanation(&self) -> &'static str {
        include_str!("spectral.md")
    }

    fn said(&self, about: &About<'_>, place: Place, _: Option<&RBig>) -> Said {
        match place {
            Place::Left if about.question.deciding(about.graph()).is_empty() => Said::Holds(
                "all eigenvalues are zeros of the family of steady motions; there is no other".into(),
            ),
            Place::Left => Said::Holds("Hurwitz's determinants are all positive".into()),
            Place::OnAxis => Said::Holds("the even factors of the characteristic polynomial have imaginary zeros only, by Hermite's and Biehler's theorem, and Hurwitz's determinants of all others are positive".into()),
            Place::Right => Said::Fails,
            Place::NotLeft => Said::Open("a Hurwitz determinant vanishes: eigenvalues lie on the axis, or are mirror images of each other".into()),
        }
    }

    fn at_border(&self, holds_beside: bool, _: Option<Crossing>) -> Option<bool> {
        // Eigenvalues are continuous: at the end of an interval in which none is right of the axis none is.
        holds_beside.then_some(true)
    }

    fn counterexample(&self, about: &About<'_>, _: Place, at: Option<&RBig>) -> Counterexample {
        unstable(about, at)
    }
}
