//! Numerical witness of the variational principles: integrals over a computed motion.
//!
//! Along the rows of the run, [`FirstVariation`] is that of each form of Hamilton's principle for random admissible variations,
//! [`Neighbours`] that of the action among curves that satisfy the constraints; from the variational equations follow the positions
//! reached, [`Reach`], and the conjugate times of the constrained extremum, [`Conjugate`]. Nothing is proved here; everything is
//! independent of the proofs, as it uses numbers of the motion alone.

mod algebra;
mod claims;
mod first;
mod linear;
mod neighbours;
mod of_quadratures;
mod quadratures;
mod samples;
mod subset;
mod wave;
mod zeros;

pub use claims::CLAIMS;
pub use first::{FirstVariation, Form};
pub use linear::{Conjugate, Reach};
pub use neighbours::Neighbours;
pub use quadratures::Quadratures;

use crate::motion_evidence::MotionEvidence;
use chetaev_mechanics::Context;
use std::sync::Arc;

/// What the integrals over the motion say, each computed when a claim first asks.
#[derive(Clone, Debug, Default)]
pub struct Witness {
    /// First variations of the forms.
    pub first: Vec<FirstVariation>,
    /// Of the action among admissible neighbours.
    pub neighbours: Option<Neighbours>,
    /// Conjugate times.
    pub conjugate: Option<Conjugate>,
}

/// What is known of a computed motion.
fn evidence(cx: &Context<'_>) -> Option<Arc<MotionEvidence>> {
    cx.extension::<MotionEvidence>()
}

/// What claims have computed, for the report.
pub fn computed(cx: &Context<'_>) -> Witness {
    Witness {
        first: first::known(cx),
        neighbours: cx
            .known::<neighbours::Found>()
            .and_then(|found| found.0.clone().ok()),
        conjugate: cx
            .known::<linear::FoundConjugate>()
            .and_then(|found| found.0.clone().ok()),
    }
}
