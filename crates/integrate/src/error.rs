//! Errors of the question: what makes a run impossible to begin. A run that ends early is no error but a
//! [`Stop`](crate::Stop).

/// Why a run could not begin.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum IntegrateError {
    /// A slice does not have one entry per component.
    #[error("{what} has {found} components, the system has {expected}")]
    Dimension {
        /// Which slice.
        what: &'static str,
        /// The dimension of the system.
        expected: usize,
        /// The length found.
        found: usize,
    },
    /// A tolerance is negative, not a number, or both tolerances of a component vanish.
    #[error("the tolerances of component {component} (relative {rtol:e}, absolute {atol:e}) are not usable")]
    InvalidTolerance {
        /// The component.
        component: usize,
        /// Its relative tolerance.
        rtol: f64,
        /// Its absolute tolerance.
        atol: f64,
    },
    /// The tolerance is below what the error estimate of the method resolves in double precision.
    #[error(
        "tolerance {requested:e} for component {component} is below {attainable:e}, \
         the least that method {method} can control in double precision"
    )]
    ToleranceTooSmall {
        /// Name of the method.
        method: &'static str,
        /// The component.
        component: usize,
        /// The tolerance asked for.
        requested: f64,
        /// The least tolerance that is accepted in its place.
        attainable: f64,
    },
    /// The tolerance is below what double-double arithmetic resolves.
    #[error("tolerance {requested:e} is below 1e-28, the least in double-double arithmetic")]
    PreciseToleranceTooSmall {
        /// The tolerance asked for.
        requested: f64,
    },
    /// An initial value is infinite or not a number.
    #[error("initial value {component} is not finite")]
    InitialNotFinite {
        /// The component.
        component: usize,
    },
    /// The time span has an end that is infinite or not a number.
    #[error("the time span from {start} to {end} is not finite")]
    InvalidSpan {
        /// Start of the span.
        start: f64,
        /// End of the span.
        end: f64,
    },
    /// An output time lies outside the span, is not a number, or goes back against the direction of the run.
    #[error("output time number {index}, {time}, is outside the span or out of order")]
    InvalidOutputTime {
        /// Its position in the list.
        index: usize,
        /// Its value.
        time: f64,
    },
    /// The output interval or a step size is not a positive number, or gives more rows than can be stored.
    #[error("{what} must be positive, finite and not too small for the span, found {found}")]
    InvalidInterval {
        /// Which quantity.
        what: &'static str,
        /// Its value.
        found: f64,
    },
    /// The method has no error estimate and was asked to choose its step size.
    #[error("method {method} has no error estimate: give it a fixed step size")]
    FixedStepRequired {
        /// Name of the method.
        method: &'static str,
    },
    /// The method needs Taylor coefficients, which the system does not give.
    #[error("method {method} needs Taylor coefficients, which the system does not give; choose another method")]
    NoSeries {
        /// Name of the method.
        method: &'static str,
    },
    /// There is no method of this name.
    #[error("there is no method `{name}`; known are {known}")]
    UnknownMethod {
        /// The name asked for.
        name: String,
        /// The names of the registry, separated by commas.
        known: String,
    },
}
