//! Theorems by which the stability of a motion itself is decided, one file each, in the order in which they are asked.
//!
//! A theorem is asked at a value of the parameter, or throughout an interval in which none of its [`functions`](Method::functions) changes its
//! sign. It answers only where all of its hypotheses are verified.

mod drift;
mod first_approximation;
mod higher_variation;
mod imaginary_pair;
mod integral_bundle;
mod reversal;
mod zero_eigenvalue;

use crate::decision::About;
use crate::hurwitz::Boundary;
use crate::question::Place;
use chetaev_symbolic::Expr;
use dashu_ratio::RBig;

/// What a theorem says of a motion.
#[derive(Clone, Debug)]
pub(crate) enum Answer {
    /// It is stable, and by what.
    Stable(String),
    /// It is unstable.
    Unstable(Instability),
    /// The hypotheses hold, and the theorem decides nothing all the same; why.
    Open(String),
    /// The hypotheses do not hold.
    NotApplicable,
}

/// A number that is not zero and shows that a motion is unstable.
#[derive(Clone, Debug, Default)]
pub(crate) struct Instability {
    /// What the number is.
    pub(crate) quantity: String,
    /// Its bounds.
    pub(crate) bounds: (String, String),
    /// By what the motion is unstable.
    pub(crate) why: String,
}

/// A theorem on stability.
pub(crate) trait Method: Sync {
    /// Functions of the parameter that was left in at whose zeros the answer may change.
    fn functions(&self, _: &About<'_>) -> Vec<Expr> {
        Vec::new()
    }

    /// What it says where the eigenvalues lie so.
    fn answer(&self, about: &About<'_>, place: Place, at: Option<&RBig>) -> Answer;

    /// What it says at the value of the parameter in the enclosure of a boundary.
    fn at_boundary(&self, _: &About<'_>, _: &Boundary) -> Answer {
        Answer::NotApplicable
    }
}

/// All of them.
pub(crate) static METHODS: &[&dyn Method] = &[
    &first_approximation::FirstApproximation,
    &integral_bundle::IntegralBundle,
    &higher_variation::HigherVariation,
    &reversal::Reversal,
    &zero_eigenvalue::ZeroEigenvalue,
    &imaginary_pair::ImaginaryPair,
    &drift::Drift,
];
