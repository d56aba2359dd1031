//! What is integrated: a first-order system y' = F(t, y) with the hooks that a mechanical system needs.
//!
//! A closure is enough to test a method ([`from_fn`], [`try_from_fn`]). A mechanical system implements
//! [`System`] in full: it may refuse an evaluation with a typed reason, project the state onto its constraints
//! after a step, change its independent velocities between steps (never inside one), and stop the run.

/// Why a right-hand side, an output or an event function could not be evaluated.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum EvaluationFailure {
    /// The linear system that gives the accelerations has no unique solution here.
    #[error("the linear solve meets pivot {pivot:e} in position {index}, below {threshold:e}")]
    Singular {
        /// Position of the pivot in the order of elimination.
        index: usize,
        /// The pivot found.
        pivot: f64,
        /// The magnitude below which a pivot counts as zero.
        threshold: f64,
    },
    /// The present choice of independent velocities has become too ill-conditioned to be trusted inside a step:
    /// the step is rejected and [`System::repivot`] is called at its start.
    #[error(
        "the pivot of the present chart fell to {ratio:e} of its value when the chart was chosen"
    )]
    PivotDegraded {
        /// Present smallest pivot divided by its value right after the last choice of chart.
        ratio: f64,
    },
    /// A component of the result is infinite or not a number.
    #[error("component {component} is not finite")]
    NotFinite {
        /// Index of the first component that is not finite.
        component: usize,
    },
    /// A constraint that held at the start of the step is violated by a jump: a branch of it has ended in between.
    #[error("constraint {constraint} jumps away from the motion")]
    LeftConstraint {
        /// Number of the constraint.
        constraint: usize,
    },
    /// An operation has no Taylor series where a step begins (a root, a logarithm or a quotient at 0, a sign, …).
    #[error("`{operation}` has no Taylor series at {argument:e}")]
    NotAnalytic {
        /// The operation.
        operation: &'static str,
        /// Its argument, or what must not vanish.
        argument: f64,
    },
    /// The system cannot give Taylor coefficients at all.
    #[error("the system gives no Taylor coefficients")]
    NoSeries,
    /// An elementary function was evaluated outside of its domain (log or sqrt of a negative number, x/0, …).
    #[error("operation {operation} is evaluated outside of its domain")]
    Domain {
        /// Number by which the caller knows the operation; it has no meaning here.
        operation: usize,
    },
}

/// Why a hook of the system ends the run. The numbers are the caller's; they have no meaning here.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum HaltReason {
    /// The rank of the constraints falls: no good choice of independent velocities exists.
    RankDrop {
        /// Rank before.
        from: usize,
        /// Rank now.
        to: usize,
        /// Number of the constraint whose gradient vanishes or becomes dependent.
        constraint: usize,
    },
    /// Constraints that were consistent contradict each other now.
    Contradiction {
        /// Number of the constraint whose residual does not vanish.
        constraint: usize,
    },
    /// A constraint that held at the start of the last step is violated by a jump at its end.
    LeftConstraint {
        /// Number of the constraint.
        constraint: usize,
    },
    /// Anything else, by the caller's own code.
    Custom(u32),
}

/// A change of the chart (the choice of independent velocities) between two steps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ChartChange {
    /// Number of the chart left.
    pub from: u32,
    /// Number of the chart entered.
    pub to: u32,
    /// Smallest pivot of the chart left, at the place of the change.
    pub pivot_before: f64,
    /// Smallest pivot of the chart entered, at the same place.
    pub pivot_after: f64,
}

/// What a hook did to the state.
#[derive(Debug, Clone, Copy, PartialEq)]
#[must_use]
pub enum Control {
    /// Nothing; stage values of the step just made stay valid.
    Continue,
    /// The hook changed y (a projection); the derivative at the start of the next step is computed anew.
    StateModified,
    /// The hook changed the chart and, where the state is in chart velocities, y with it.
    ChartSwitched(ChartChange),
    /// The run ends at this state.
    Stop(HaltReason),
}

/// A piece of a motion within one step: for −1 ≤ s ≤ 1 the time is `t + length s` and the state Σ_j c_j s^j.
#[derive(Clone, Copy, Debug)]
pub struct Piece<'a> {
    /// Time at the middle.
    pub t: f64,
    /// Half of its duration.
    pub length: f64,
    /// Number of components of the state.
    pub dimension: usize,
    /// All components of c₀, then all of c₁, and so on.
    pub coefficients: &'a [f64],
}

/// A first-order system y' = F(t, y) of fixed dimension.
///
/// The integrator calls the hooks in this order for every accepted step from t to t + h: event functions and
/// outputs strictly inside the step (on its dense output, in the chart of the step), then [`System::accepted`] at
/// its end, then the output at its end. All stages of one step are evaluated in one chart.
pub trait System {
    /// Number of components of y.
    fn dimension(&self) -> usize;

    /// Writes F(t, y) into `dy`; both slices have [`System::dimension`] components.
    ///
    /// # Errors
    /// The reason why F has no value at (t, y), or should not be used there. The step is then rejected.
    fn derivative(&mut self, t: f64, y: &[f64], dy: &mut [f64]) -> Result<(), EvaluationFailure>;

    /// Whether [`System::expand`] gives Taylor coefficients.
    fn has_series(&self) -> bool {
        false
    }

    /// Writes the normalized Taylor coefficients of the solution through (t, y + carry): `coefficients[j * n + i]` is
    /// y_i⁽ʲ⁾/j! for j = 0 … order, n the dimension; those of order 0 are y. Used by the Taylor method; order 1 is F.
    ///
    /// The carry, what the rounding of y leaves out, matters where y is an angle of many turns: sines see its absolute
    /// error. It may be passed over.
    ///
    /// # Errors
    /// The reason why there is no such series, by default [`EvaluationFailure::NoSeries`].
    fn expand(
        &mut self,
        t: f64,
        (y, carry): (&[f64], &[f64]),
        order: usize,
        coefficients: &mut [f64],
    ) -> Result<(), EvaluationFailure> {
        let _ = (t, y, carry, order, coefficients);
        Err(EvaluationFailure::NoSeries)
    }

    /// Called once after each accepted step, at its end. May project y or choose another chart.
    fn accepted(&mut self, t: f64, y: &mut [f64]) -> Control {
        let _ = (t, y);
        Control::Continue
    }

    /// Called at the start (t, y) of a step that was rejected because an evaluation failed with
    /// [`EvaluationFailure::PivotDegraded`] or [`EvaluationFailure::Singular`], at most once per starting point.
    /// May choose another chart; the step is then tried again with the same size. With [`Control::Continue`] the
    /// step is shortened.
    fn repivot(&mut self, t: f64, y: &mut [f64]) -> Control {
        let _ = (t, y);
        Control::Continue
    }

    /// Number of components of an output row; by default the dimension.
    fn output_dimension(&self) -> usize {
        self.dimension()
    }

    /// Writes the row that is recorded for the state y at time t, for instance coordinates, all velocities and
    /// multipliers from a state in chart velocities. By default the state itself.
    ///
    /// # Errors
    /// The reason why the row has no value; the run stops there.
    fn output(&mut self, t: f64, y: &[f64], row: &mut [f64]) -> Result<(), EvaluationFailure> {
        let _ = t;
        row.copy_from_slice(y);
        Ok(())
    }

    /// Value of switching function number `index` of the system, for events that need more than y (a contact
    /// force, say). Used by [`Event::of_system`](crate::Event::of_system).
    ///
    /// # Errors
    /// The reason why it has no value; by default there are no switching functions.
    fn switching(&mut self, index: usize, t: f64, y: &[f64]) -> Result<f64, EvaluationFailure> {
        let _ = (t, y);
        Err(EvaluationFailure::Domain { operation: index })
    }

    /// Writes the Taylor coefficients in s of switching function number `index` along a piece of the motion, orders 0 to
    /// `series.len() - 1`; false where it has none. With them no zero is missed that the series shows.
    fn switching_series(&mut self, index: usize, piece: Piece<'_>, series: &mut [f64]) -> bool {
        let _ = (index, piece, series);
        false
    }

    /// Whether a zero of switching function number `index` of the system near (t, y) is an event at all, asked before it is
    /// located exactly. For functions that have many zeros of which few matter (minima of a distance, say).
    fn is_event(&mut self, index: usize, t: f64, y: &[f64]) -> bool {
        let _ = (index, t, y);
        true
    }

    /// Number of factorizations made so far, for the statistics.
    fn factorizations(&self) -> u64 {
        0
    }
}

/// A [`System`] made of a function; see [`from_fn`] and [`try_from_fn`].
#[derive(Debug, Clone)]
pub struct FromFn<F> {
    dimension: usize,
    function: F,
}

/// The system y' = F(t, y) of the given dimension, where `function(t, y, dy)` writes F into `dy`.
///
/// ```
/// use chetaev_integrate::{from_fn, integrate, Options, Stop};
/// let mut oscillator = from_fn(2, |_t, y: &[f64], dy: &mut [f64]| {
///     dy[0] = y[1];
///     dy[1] = -y[0];
/// });
/// let run = integrate(&mut oscillator, (0.0, 1.0), &[1.0, 0.0], &mut [], Options::tolerance(1e-10))?;
/// assert_eq!(run.stop, Stop::Finished);
/// assert!((run.state[0] - 1f64.cos()).abs() < 1e-9);
/// # Ok::<(), chetaev_integrate::IntegrateError>(())
/// ```
pub fn from_fn<F>(dimension: usize, function: F) -> FromFn<Infallible<F>>
where
    F: FnMut(f64, &[f64], &mut [f64]),
{
    FromFn {
        dimension,
        function: Infallible(function),
    }
}

/// As [`from_fn`], for a function that can refuse an evaluation.
pub fn try_from_fn<F>(dimension: usize, function: F) -> FromFn<F>
where
    F: FnMut(f64, &[f64], &mut [f64]) -> Result<(), EvaluationFailure>,
{
    FromFn {
        dimension,
        function,
    }
}

/// A function that never refuses an evaluation; made by [`from_fn`].
#[derive(Debug, Clone)]
pub struct Infallible<F>(F);

/// What a [`FromFn`] evaluates.
pub trait Slope {
    /// Writes F(t, y) into `dy`.
    ///
    /// # Errors
    /// The reason why F has no value at (t, y).
    fn slope(&mut self, t: f64, y: &[f64], dy: &mut [f64]) -> Result<(), EvaluationFailure>;
}

impl<F: FnMut(f64, &[f64], &mut [f64])> Slope for Infallible<F> {
    fn slope(&mut self, t: f64, y: &[f64], dy: &mut [f64]) -> Result<(), EvaluationFailure> {
        (self.0)(t, y, dy);
        Ok(())
    }
}

impl<F> Slope for F
where
    F: FnMut(f64, &[f64], &mut [f64]) -> Result<(), EvaluationFailure>,
{
    fn slope(&mut self, t: f64, y: &[f64], dy: &mut [f64]) -> Result<(), EvaluationFailure> {
        self(t, y, dy)
    }
}

impl<S: Slope> System for FromFn<S> {
    fn dimension(&self) -> usize {
        self.dimension
    }

    fn derivative(&mut self, t: f64, y: &[f64], dy: &mut [f64]) -> Result<(), EvaluationFailure> {
        self.function.slope(t, y, dy)
    }
}
