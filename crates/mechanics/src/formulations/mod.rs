//! Every formulation of the equations of motion, one file each. Adding one is a file and a line in [`FORMULATIONS`].

mod maggi;
mod routh;

pub use maggi::Maggi;
pub use routh::Routh;

use crate::card::Card;
use crate::characteristics::{Characteristics, CharacteristicsError, Selection};
use crate::equations::Equations;
use crate::system::System;
use crate::terms::MotionTerms;
use chetaev_symbolic::linear::SolveError;

/// Why a formulation gives no equations although its requirements hold.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum DeriveError {
    /// The velocities cannot be parametrized.
    #[error(transparent)]
    Characteristics(#[from] CharacteristicsError),
    /// The linear system for the accelerations is structurally singular.
    #[error("the accelerations are not determined: {0}")]
    Singular(#[from] SolveError),
}

/// What all formulations start from: the system, its terms, and the selected rows and dependent velocities.
#[derive(Debug)]
pub struct Basis<'a> {
    /// The system.
    pub system: &'a System,
    /// Its terms.
    pub terms: &'a MotionTerms,
    /// Independent constraints and dependent velocities.
    pub selection: &'a Selection,
    /// Characteristics the caller insists on; `None` leaves the choice to the formulation.
    pub characteristics: Option<Characteristics>,
}

/// One way of writing the equations of motion of a constrained system.
pub trait Formulation: Sync {
    /// What it is.
    fn card(&self) -> &'static Card;

    /// Derives the equations by the formulation's own rule.
    ///
    /// # Errors
    /// [`DeriveError`].
    fn equations(&self, basis: &Basis<'_>) -> Result<Equations, DeriveError>;
}

/// The registry.
pub static FORMULATIONS: &[&dyn Formulation] = &[&Routh, &Maggi];

/// The formulation called `name`.
pub fn formulation(name: &str) -> Option<&'static dyn Formulation> {
    FORMULATIONS.iter().copied().find(|f| f.card().name == name)
}
