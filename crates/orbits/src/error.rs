//! Why there is no answer.

use chetaev_integrate::{IntegrateError, Stop};
use chetaev_motion::functions::FunctionsError;
use chetaev_stability::problem::LinearizationError;

/// Why a motion was not followed.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum OrbitError {
    /// The system has no closed equations of first order.
    #[error(transparent)]
    Closed(Box<LinearizationError>),
    /// A symbol in the equations has no value.
    #[error("`{name}` has no value; give it one in the model or with --set {name}=…")]
    NoValue {
        /// The symbol.
        name: String,
    },
    /// Velocities that stay implicit.
    #[error("the constraints are not affine in the velocities, and the equations are not in explicit form")]
    Implicit,
    /// The mass matrix is singular.
    #[error("the mass matrix is singular for all states")]
    Singular,
    /// The equations cannot be compiled.
    #[error(transparent)]
    Functions(#[from] FunctionsError),
    /// The run could not begin.
    #[error(transparent)]
    Integrate(#[from] IntegrateError),
    /// The run ended early.
    #[error("the motion ends at t = {t} before t = {end}: {}", why(stop))]
    EndsEarly {
        /// Where it ended.
        t: f64,
        /// Where it should have ended.
        end: f64,
        /// Why.
        stop: Stop,
    },
    /// Newton's method did not converge.
    #[error("no {what} was found near the guess: after {steps} steps of Newton's method the residual is {residual:.3e}")]
    NotConverged {
        /// What was searched.
        what: &'static str,
        /// Steps made.
        steps: usize,
        /// The largest residual.
        residual: f64,
    },
    /// No return to the neighbourhood of the start.
    #[error("the motion does not come back near its start before t = {end}; give a guess of the period with --period")]
    NoReturn {
        /// How far was looked.
        end: f64,
    },
    /// What was found does not move.
    #[error(
        "what was found near the guess is a steady motion and no orbit; begin farther from it"
    )]
    Steady,
    /// Equations that contain the time and no period.
    #[error("the equations contain the time, and a period must be given: --period \"2 pi/omega\"")]
    PeriodMissing,
    /// Equations that contain the time and do not repeat after a period.
    #[error(
        "the equations contain the time, and do not repeat after {period}: {}",
        repeats(own)
    )]
    NotRepeated {
        /// The period that was given.
        period: f64,
        /// The periods of the functions of the time, where all are periodic.
        own: Vec<f64>,
    },
    /// Equations that contain the time, where steady motions are asked for.
    #[error("the equations contain the time, and have no steady motions in general; --orbit with --period follows periodic ones")]
    NotAutonomous,
    /// Equations without a value, or without derivatives, at a state.
    #[error("the equations, or their derivatives, have no value at a state that was met, as sqrt(x^2 + y^2) has no derivative where it vanishes: {0}")]
    NoEvaluation(#[from] chetaev_integrate::EvaluationFailure),
    /// Initial data that constraints do not determine.
    #[error("the initial state does not follow from what is given: state {names} in [initial] too, so that it can be varied")]
    NotDetermined {
        /// What is missing.
        names: String,
    },
    /// Initial data that fulfil the constraints for some values of the parameters alone.
    #[error("what is given at the start fulfils the constraints for these values alone, and a change of them contradicts it: give fewer initial data or state them by the parameters, or set `project = true`, which moves them to the nearest state that is admissible")]
    GivenForValuesAlone,
    /// A name by which nothing can be varied.
    #[error("`{name}` is neither a parameter with a value of its own nor a given initial value; these are {}", known.join(", "))]
    UnknownVariation {
        /// The name asked for.
        name: String,
        /// Those that exist.
        known: Vec<String>,
    },
    /// Eigenvalues were not found.
    #[error("the eigenvalues of a matrix were not found")]
    NoEigenvalues,
}

impl From<LinearizationError> for OrbitError {
    fn from(problem: LinearizationError) -> OrbitError {
        OrbitError::Closed(Box::new(problem))
    }
}

/// Which periods are possible, in words.
fn repeats(own: &[f64]) -> String {
    let texts: Vec<String> = own.iter().map(f64::to_string).collect();
    match &texts[..] {
        [] => "no period of theirs is known, and there may be none".to_owned(),
        [one] => format!("a period is a whole multiple of {one}, after which they do"),
        all => format!(
            "a period is a whole multiple of {}, those of their functions of the time",
            all.join(" and of ")
        ),
    }
}

/// Why a run ended, in words.
fn why(stop: &Stop) -> String {
    match stop {
        Stop::Divergence { singularity, .. } => {
            format!("a rate grows without bound towards t = {singularity}")
        }
        Stop::Singular { .. } | Stop::NotFinite { .. } => {
            "the equations have no finite value there".to_owned()
        }
        Stop::StepTooSmall { .. } => {
            "the tolerance cannot be met however short the step".to_owned()
        }
        Stop::Interrupted { .. } => "it was interrupted".to_owned(),
        _ => "the equations could not be integrated further".to_owned(),
    }
}
