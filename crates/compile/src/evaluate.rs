//! What every back end offers: evaluation of a program for one state, and for a block of states.

use crate::interpret::{BlockWorkspace, Workspace};
use crate::lanes::Lanes;
use crate::program::Program;

/// Why a program has no value at a state.
///
/// Undefined elementary operations are no failures: they give NaN or infinity, as they do in the graph.
#[derive(Clone, Copy, PartialEq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum EvaluateFailure {
    /// A linear system has no unique solution within rounding.
    #[error("matrix {matrix} is singular: pivot {pivot} is {value:e}, below {threshold:e}; the pivots lie between {smallest:e} and {largest:e}")]
    Singular {
        /// Index in [`Program::matrices`].
        matrix: usize,
        /// Which unknown's pivot counts as zero.
        pivot: usize,
        /// That pivot.
        value: f64,
        /// The magnitude up to which it counts as zero.
        threshold: f64,
        /// Smallest magnitude among the pivots found.
        smallest: f64,
        /// Largest magnitude among the pivots found.
        largest: f64,
    },
    /// An entry of a matrix is infinite or not a number, or its elimination overflows.
    #[error("matrix {matrix} has an entry that is not finite")]
    NotFinite {
        /// Index in [`Program::matrices`].
        matrix: usize,
    },
    /// A slice has the wrong length.
    #[error("{what}: expected {expected} values, found {found}")]
    Length {
        /// Which slice.
        what: &'static str,
        /// Length needed.
        expected: usize,
        /// Length given.
        found: usize,
    },
    /// An operation has no Taylor series at its argument; only of [`Taylor`](crate::Taylor).
    #[error("`{operation}` has no Taylor series at {argument:e}")]
    NotAnalytic {
        /// The operation.
        operation: &'static str,
        /// Its argument, or what must not vanish.
        argument: f64,
    },
    /// The workspace was not prepared with parameters, or belongs to another program.
    #[error("the workspace is not prepared for this program")]
    NotPrepared,
}

/// Smallest and largest magnitude of the pivots of a factorized matrix.
///
/// Their ratio is a cheap indicator of how close a matrix is to a singular one.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct PivotRange {
    /// Smallest magnitude.
    pub smallest: f64,
    /// Largest magnitude.
    pub largest: f64,
}

/// Evaluates a program for one state at a time, without allocating.
pub trait Evaluator: Send + Sync {
    /// The program.
    fn program(&self) -> &Program;

    /// Storage for evaluations, one for each thread.
    fn workspace(&self) -> Workspace;

    /// Runs the prologue for a set of parameters; needed before the first evaluation, also without parameters.
    ///
    /// # Errors
    /// [`EvaluateFailure`] for a wrong length, and for a singular matrix that depends on parameters only.
    fn prepare(&self, parameters: &[f64], workspace: &mut Workspace)
        -> Result<(), EvaluateFailure>;

    /// Writes the first `groups` groups of outputs at the state `variables`, one after the other.
    ///
    /// Only what these groups need is computed; `outputs` has
    /// [`output_count_of(groups)`](Program::output_count_of) values.
    ///
    /// # Errors
    /// [`EvaluateFailure`]; the contents of `outputs` are then unspecified.
    fn evaluate_groups(
        &self,
        groups: usize,
        variables: &[f64],
        workspace: &mut Workspace,
        outputs: &mut [f64],
    ) -> Result<(), EvaluateFailure>;

    /// Writes all outputs at the state `variables`, group by group.
    ///
    /// # Errors
    /// [`EvaluateFailure`]; the contents of `outputs` are then unspecified.
    fn evaluate(
        &self,
        variables: &[f64],
        workspace: &mut Workspace,
        outputs: &mut [f64],
    ) -> Result<(), EvaluateFailure> {
        self.evaluate_groups(self.program().outputs.len(), variables, workspace, outputs)
    }
}

/// Evaluates a program for many states at once, without allocating; see [`LANES`](crate::LANES).
///
/// For every state the values are bit for bit those of the [`Evaluator`] of the same back end.
pub trait BlockEvaluator: Send + Sync {
    /// Storage for evaluations, one for each thread.
    fn block_workspace(&self) -> BlockWorkspace;

    /// Runs the prologue; every state of the block has its own set of parameters.
    ///
    /// A state whose prologue fails is listed in [`BlockWorkspace::failures`] after every evaluation.
    ///
    /// # Errors
    /// [`EvaluateFailure::Length`].
    fn prepare_block(
        &self,
        parameters: &[Lanes],
        workspace: &mut BlockWorkspace,
    ) -> Result<(), EvaluateFailure>;

    /// Writes the first `groups` groups of outputs at the states `variables`.
    ///
    /// States with a singular system are listed in [`BlockWorkspace::failures`]; their outputs are unspecified and
    /// do not influence the others. Fill unused states with copies of a used one.
    ///
    /// # Errors
    /// [`EvaluateFailure::Length`] and [`EvaluateFailure::NotPrepared`].
    fn evaluate_block(
        &self,
        groups: usize,
        variables: &[Lanes],
        workspace: &mut BlockWorkspace,
        outputs: &mut [Lanes],
    ) -> Result<(), EvaluateFailure>;
}
