//! Numerical witness of the variational principles: integrals over a computed motion.
//!
//! Along the rows of the run, [`FirstVariation`] is that of each form of Hamilton's principle for random admissible variations,
//! [`Neighbours`] that of the action among curves that satisfy the constraints; from the variational equations follow the positions
//! reached, [`Reach`], and the conjugate times of the constrained extremum, [`Conjugate`]. `least_action` varies the actions at varied
//! times, `second_kind` positions and velocities independently, `operators` the velocities by relations δv = A(δq), and `other_time`
//! integrates the equations that principles give in other times. Nothing is proved here; everything is independent of the
//! proofs, as it uses numbers of the motion alone.

mod algebra;
mod claims;
mod common;
mod first;
mod kappa;
mod least_action;
mod linear;
mod neighbours;
mod of_quadratures;
mod of_stationary_action;
mod operators;
mod other_time;
mod quadratures;
mod refined;
mod samples;
mod second_kind;
mod states;
mod subset;
#[cfg(test)]
mod tests;
mod wave;
mod zeros;

pub(crate) use algebra::{determinant, gram};
pub use claims::CLAIMS;
pub use first::{FirstVariation, Form};
pub use linear::{Conjugate, Reach};
pub use neighbours::Neighbours;
pub use quadratures::Quadratures;
pub use refined::Refined;
pub(crate) use zeros::zeros;

use crate::motion_evidence::MotionEvidence;
use chetaev_mechanics::Context;
use std::sync::{Arc, Mutex, PoisonError};

/// What the integrals over the motion say, each computed when a claim first asks.
#[derive(Clone, Debug, Default)]
pub struct Witness {
    /// First variations of the forms.
    pub first: Vec<FirstVariation>,
    /// Of the action among admissible neighbours.
    pub neighbours: Option<Neighbours>,
    /// Conjugate times.
    pub conjugate: Option<Conjugate>,
    /// What the report draws against the step, in the order in which it was computed.
    pub shown: Vec<Shown>,
}

/// Which picture numbers belong to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Figure {
    /// Actions of curves beside the motion.
    Action,
    /// Principles of the second kind.
    SecondKind,
    /// Operators δv = A(δq).
    Operators,
    /// Equations in another time.
    OtherTime,
}

/// Numbers by the step, with their name.
#[derive(Clone, Debug)]
pub struct Shown {
    /// The picture.
    pub figure: Figure,
    /// The subject of the claim.
    pub subject: String,
    /// What was computed.
    pub name: String,
    /// The numbers.
    pub refined: Refined,
}

/// What is kept for the report.
#[derive(Default)]
struct Kept(Mutex<Vec<Shown>>);

/// Keeps numbers for the report.
fn show(cx: &Context<'_>, figure: Figure, (subject, name): (&str, &str), refined: Refined) {
    let kept = cx.shared(|_| Kept::default());
    let mut all = kept.0.lock().unwrap_or_else(PoisonError::into_inner);
    all.push(Shown {
        figure,
        subject: subject.into(),
        name: name.into(),
        refined,
    });
}

/// What is known of a computed motion.
fn evidence(cx: &Context<'_>) -> Option<Arc<MotionEvidence>> {
    cx.extension::<MotionEvidence>()
}

/// The claim on the action among admissible curves: in the context in which it is decided all witnesses are.
pub(crate) const STATIONARY: &str = "witness.stationary";

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
        shown: cx.known::<Kept>().map_or_else(Vec::new, |kept| {
            let all = kept.0.lock().unwrap_or_else(PoisonError::into_inner);
            all.clone()
        }),
    }
}
