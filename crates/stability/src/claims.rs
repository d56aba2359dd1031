//! Claims on steady motions: which there are, and the stability of those that a model names; the subject is the name of the motion.
//!
//! Where one parameter occurs in the motion and not in the equations of the system, as the speed of a bicycle, the verdict speaks of
//! all its values: it is proved, refuted, or conditional on the ranges. Else it speaks of the values that the model states.

mod asymptotic;
mod critical;
mod linear;
mod nonlinear;
mod sets;
mod spectral;
mod stated;

pub use asymptotic::Asymptotic;
pub use critical::Critical;
pub use linear::Linear;
pub use nonlinear::Nonlinear;
pub use sets::{StatesOfRest, SteadyMotions};
pub use spectral::Spectral;
pub use stated::Stated;

use crate::about::Statement;
use crate::decision::verdict;
use crate::evidence::{motions, requires};
use chetaev_mechanics::claims::{Claim, Context, Finding, Group};

/// A statement on the stability of every steady motion, as a claim.
#[derive(Clone, Copy, Debug)]
struct OnStability<S>(S);

impl<S: Statement + Sync> Claim for OnStability<S> {
    fn id(&self) -> &'static str {
        self.0.id()
    }

    fn group(&self) -> Group {
        Group::Stability
    }

    fn title(&self) -> &'static str {
        self.0.title()
    }

    fn explanation(&self) -> &'static str {
        self.0.explanation()
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        motions(cx)
    }

    fn requires(&self, subject: Option<&str>) -> Vec<String> {
        requires(subject)
    }

    fn decide(&self, cx: &Context<'_>, subject: Option<&str>) -> Finding {
        verdict(cx, subject, &self.0).into()
    }
}

/// The claims of this crate.
pub static CLAIMS: &[&dyn Claim] = &[
    &StatesOfRest,
    &SteadyMotions,
    &Stated,
    &OnStability(Asymptotic),
    &OnStability(Spectral),
    &OnStability(Linear),
    &OnStability(Nonlinear),
    &Critical,
];
