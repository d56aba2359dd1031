//! Why a question on linear equations has no answer.

use chetaev_mechanics::characteristics::CharacteristicsError;
use chetaev_mechanics::SystemError;
use chetaev_model::Diagnostics;
use chetaev_stability::descriptor::DescriptorError;
use chetaev_stability::linearization::LinearizationError;
use chetaev_stability::state_space::StateSpaceError;
use chetaev_stability::steady_set::SteadySetError;

/// Why there is no answer.
#[derive(Debug, thiserror::Error)]
pub enum StabilityError {
    /// The model is no system.
    #[error(transparent)]
    System(#[from] SystemError),
    /// No admissible state.
    #[error(transparent)]
    Characteristics(#[from] CharacteristicsError),
    /// No motion was named.
    #[error("the model names no steady motion: state one, as in\n\n[steady.upright]\n{example}\n\nor say --about rest or --about start{found}")]
    NoMotion {
        /// Lines of an example with the coordinates of the model.
        example: String,
        /// Those that were found, in words.
        found: String,
    },
    /// Several motions, and none was asked for.
    #[error("which steady motion? --about {}", names.join(" or --about "))]
    SeveralMotions {
        /// Their names.
        names: Vec<String>,
    },
    /// A name that the model does not have.
    #[error("the model names no steady motion `{name}`; known are {}{found}", known.join(", "))]
    UnknownMotion {
        /// The name asked for.
        name: String,
        /// Those that exist.
        known: Vec<String>,
        /// Those that were found, in words.
        found: String,
    },
    /// The values of a motion that was found are not known exactly.
    #[error("the motion {name} is known by enclosures of its values only: no closed form of them was found, and linear equations need exact values; `chetaev follow` takes it in numbers")]
    NoClosedForm {
        /// Its number.
        name: String,
    },
    /// Steady motions were not found.
    #[error(
        "{0}; a motion of which positions and velocities are known can be stated as [steady.NAME]"
    )]
    SteadySet(SteadySetError),
    /// A value for something that has none.
    #[error("--at {text}: {why}")]
    At {
        /// As it was given.
        text: String,
        /// What is wrong.
        why: String,
    },
    /// A parameter that the model does not have.
    #[error("`{name}` is no parameter of the model; its parameters are {}", known.join(", "))]
    UnknownParameter {
        /// The name asked for.
        name: String,
        /// Those that exist.
        known: Vec<String>,
    },
    /// Two ranges of one parameter.
    #[error("`{name}` is named twice: a map has two parameters, as in v=0:10,m=1:2")]
    SameParameter {
        /// The parameter.
        name: String,
    },
    /// A range that is none.
    #[error("`{text}` is no range: write NAME=FROM:TO with FROM below TO, as in v=0:10")]
    Range {
        /// As it was given.
        text: String,
    },
    /// Speeds that are no choice of independent ones.
    #[error("{text}: name {needed} speeds, velocities or functions linear in them, as in --speeds \"{example}\"")]
    Speeds {
        /// As it was given.
        text: String,
        /// k.
        needed: usize,
        /// Velocities that could be named.
        example: String,
    },
    /// An expression that could not be read.
    #[error("{0}")]
    Expression(Diagnostics),
    /// The motion is not steady, or not admissible.
    #[error(transparent)]
    Linearization(#[from] LinearizationError),
    /// The mass matrix is singular, or an output is no function of the variables.
    #[error(transparent)]
    StateSpace(#[from] StateSpaceError),
    /// There are no linear equations in all variables.
    #[error(transparent)]
    Descriptor(#[from] DescriptorError),
}

impl From<SteadySetError> for StabilityError {
    fn from(problem: SteadySetError) -> StabilityError {
        match problem {
            SteadySetError::System(problem) => StabilityError::Linearization(*problem),
            other => StabilityError::SteadySet(other),
        }
    }
}
