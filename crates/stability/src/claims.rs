//! Claims on the stability of the steady motions that a model names; the subject is the name of the motion.
//!
//! Where one parameter occurs in the motion and not in the equations of the system, as the speed of a bicycle, the verdict speaks of
//! all its values: it is proved, refuted, or conditional on the ranges. Else it speaks of the values that the model states.

mod asymptotic;
mod critical;
mod linear;
mod nonlinear;
mod spectral;
mod stated;

pub use asymptotic::Asymptotic;
pub use critical::Critical;
pub use linear::Linear;
pub use nonlinear::Nonlinear;
pub use spectral::Spectral;
pub use stated::Stated;

use chetaev_mechanics::claims::Claim;

/// The claims of this crate.
pub static CLAIMS: &[&dyn Claim] = &[
    &Stated,
    &Asymptotic,
    &Spectral,
    &Linear,
    &Nonlinear,
    &Critical,
];
