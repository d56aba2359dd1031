//! What a theorem on stability is, and what it says.

use crate::about::About;
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
