//! What is wrong with the input of a study.

use crate::derivation::NotDerived;
use chetaev_mechanics::characteristics::CharacteristicsError;
use chetaev_mechanics::SystemError;
use chetaev_model::Place;
use chetaev_motion::initial::jets::JetError;
use chetaev_motion::{InitialError, NumericError, RunError};

/// The input is wrong; exit status 2.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StudyError {
    /// It was interrupted before there was anything to keep.
    #[error("interrupted before anything was computed")]
    Interrupted,
    /// No system.
    #[error(transparent)]
    System(#[from] SystemError),
    /// No characteristics.
    #[error(transparent)]
    Characteristics(#[from] CharacteristicsError),
    /// Numbers are missing.
    #[error(transparent)]
    Numeric(#[from] NumericError),
    /// The initial state cannot be used.
    #[error(transparent)]
    Initial(#[from] InitialError),
    /// The run cannot begin.
    #[error(transparent)]
    Run(#[from] RunError),
    /// An initial value is not a number.
    #[error("the initial value of `{name}` is not a finite number")]
    InitialValue {
        /// Name with primes.
        name: String,
    },
    /// A formulation that cannot be integrated.
    #[error("there is no formulation `{name}` to integrate; choose one of {known}")]
    UnknownFormulation {
        /// As given.
        name: String,
        /// Names.
        known: String,
    },
    /// A formulation whose requirements this system does not meet.
    #[error("the equations cannot be integrated in this form: {0}")]
    NotDerived(#[from] NotDerived),
    /// A motion is asked for, but something has no value.
    #[error("no value for {names}: the model states initial data or a time span, so a motion is wanted; give a value in the model or with --set NAME=VALUE, or leave [initial] and [simulation] out to derive only")]
    MissingValues {
        /// Names in quotes.
        names: String,
    },
    /// The constraints have less than their rank at the start.
    #[error("the constraints {names} are rank-deficient at the initial state: their rank is {rank} there and {generic} at almost all admissible states, so the reactions and the motion are not determined; start elsewhere")]
    RankDeficient {
        /// Names in quotes.
        names: String,
        /// Rank at the start.
        rank: usize,
        /// Rank elsewhere.
        generic: usize,
    },
    /// The start contradicts an assumption.
    #[error("the initial state contradicts the assumption `{text}`: the left side is {left}, the right side {right}; what is proved under it would say nothing of this motion")]
    Assumption {
        /// As written.
        text: String,
        /// Left side.
        left: f64,
        /// Right side.
        right: f64,
    },
    /// Constraints of order two and more that leave the motion open everywhere.
    #[error("constraints and equations of motion do not determine the motion at any state: {detail} (claim order.determined)")]
    Undetermined {
        /// What is singular, and how that was found.
        detail: String,
    },
    /// Formulas of the model that violate its constraints.
    #[error("{detail}; correct [characteristics] (claim order.characteristics)")]
    WrongCharacteristics {
        /// What is violated.
        detail: String,
    },
    /// A tolerance out of range.
    #[error("the tolerance {tolerance:e} is out of range: it must lie between {sharpest:e} (double precision) and 0.1; method `taylor` goes down to 2.3e-16, and with `--precision double-double` to 1e-28")]
    Tolerance {
        /// As given.
        tolerance: f64,
        /// The sharpest one of the method.
        sharpest: f64,
    },
    /// An absolute tolerance that is none.
    #[error("the absolute tolerance must be a positive number, in the units of coordinates and velocities")]
    AbsoluteTolerance,
    /// A tolerance out of range in double-double arithmetic.
    #[error("the tolerance {tolerance:e} is out of range: it must lie between {sharpest:e} (double-double arithmetic) and 0.1")]
    PreciseTolerance {
        /// As given.
        tolerance: f64,
        /// The sharpest one.
        sharpest: f64,
    },
    /// A method that has no double-double arithmetic.
    #[error("`{method}` runs in double precision only: double-double arithmetic needs `method = \"taylor\"` in [simulation] or --method taylor")]
    PrecisionMethod {
        /// The method.
        method: String,
    },
    /// A sweep in double-double arithmetic.
    #[error("a sweep runs in double precision only: leave `precision = \"double-double\"` out of [simulation], or pass --precision double; single motions are computed with it by `simulate` and `study`")]
    PreciseSweep,
    /// Integrals to be kept along motions that may be on different components of the constraints.
    #[error("first integrals cannot be kept in this sweep: {constraints} holds on several components, each of which has first integrals of its own; state the factor that vanishes along the motions as the constraint, or leave --keep-integrals out")]
    KeptOnComponents {
        /// The constraints that may have several.
        constraints: String,
    },
    /// A fixed step that is not positive.
    #[error("the fixed step must be a positive number")]
    Step,
    /// A method without error estimate and no step.
    #[error("`{method}` has no error estimate: give it a fixed step, `step = 0.01` in [simulation] or --step 0.01")]
    StepMissing {
        /// The method.
        method: String,
    },
    /// Too many rows.
    #[error(
        "`output` asks for {rows:.0} rows; at most {most:.0} are written, choose a larger step"
    )]
    TooManyRows {
        /// Asked for.
        rows: f64,
        /// Allowed.
        most: f64,
    },
    /// An output time outside the run.
    #[error("the output time {t} lies outside the run from {t_start} to {t_end}")]
    OutputTime {
        /// As given.
        t: f64,
        /// Start of the run.
        t_start: f64,
        /// End of the run.
        t_end: f64,
    },
    /// Output times that do not follow each other.
    #[error("the output times must follow each other in the direction of the run")]
    OutputOrder,
    /// An output step that is not positive.
    #[error("the output step must be a positive number")]
    OutputStep,
    /// Expectations about claims that do not exist, all of them.
    #[error("{}; `chetaev explain` lists all claims", sentences(claims))]
    UnknownClaims {
        /// In the order of the file.
        claims: Vec<UnknownClaim>,
    },
    /// There is nothing to integrate.
    #[error("{why}")]
    NoMotion {
        /// Why, in a sentence.
        why: String,
    },
    /// Initial data beyond coordinates and velocities.
    #[error(transparent)]
    Jets(#[from] JetError),
    /// Initial data of a kind the first-order theory has no use for.
    #[error("the initial value of `{name}` is not used: a first-order system is determined by coordinates and velocities")]
    UnusedInitialValue {
        /// Name with primes.
        name: String,
    },
}

/// An expectation about a claim that does not exist.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "[expect] names the claim `{claim}`, which does not exist{}",
    suggestion(near)
)]
pub struct UnknownClaim {
    /// As written.
    pub claim: String,
    /// The nearest one.
    pub near: Option<&'static str>,
    /// Where it is written.
    pub place: Place,
}

fn suggestion(near: &Option<&'static str>) -> String {
    near.map_or(String::new(), |near| format!("; did you mean `{near}`?"))
}

fn sentences(claims: &[UnknownClaim]) -> String {
    let each: Vec<String> = claims.iter().map(UnknownClaim::to_string).collect();
    each.join("; ")
}
