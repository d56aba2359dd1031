//! Which back end runs a program: native code where the machine has it, the interpreter elsewhere.

use crate::evaluate::{BlockEvaluator, EvaluateFailure, Evaluator};
use crate::interpret::{BlockWorkspace, Interpreter, Workspace};
use crate::lanes::Lanes;
#[cfg(all(unix, target_arch = "x86_64"))]
use crate::native::Native;
use crate::program::Program;
use crate::verify::VerifyError;

/// The environment variable that, set to `interpreter`, turns native code off.
pub const VARIABLE: &str = "CHETAEV_BACKEND";

/// A program made ready by one of the back ends.
#[derive(Debug)]
#[non_exhaustive]
pub enum Backend {
    /// Reads instructions one by one.
    Interpreter(Box<Interpreter>),
    /// Runs machine code.
    #[cfg(all(unix, target_arch = "x86_64"))]
    Native(Box<Native>),
}

/// The fastest back end for `program` on this machine.
///
/// Results of back ends differ by rounding: over random programs every output by at most 10⁻¹³ of its size, or of 1 if
/// that is larger, and ten times what relative changes of 10⁻¹⁴ in the variables do (`tests/random_programs.rs`). The
/// environment variable [`VARIABLE`] turns native code off.
///
/// # Errors
/// [`VerifyError`] if the program is not well formed; one made by [`Lowering`](crate::Lowering) is.
pub fn backend(program: Program) -> Result<Backend, VerifyError> {
    let is_off = std::env::var_os(VARIABLE).is_some_and(|value| value == "interpreter");
    Backend::choose(program, !is_off)
}

impl Backend {
    /// The interpreter, on every machine.
    ///
    /// # Errors
    /// [`VerifyError`] if the program is not well formed.
    pub fn interpreter(program: Program) -> Result<Backend, VerifyError> {
        Backend::choose(program, false)
    }

    /// Native code if the machine has it and `is_native_allowed`, the interpreter otherwise.
    fn choose(program: Program, is_native_allowed: bool) -> Result<Backend, VerifyError> {
        #[cfg(all(unix, target_arch = "x86_64"))]
        if is_native_allowed {
            program.verify()?;
            if let Some(native) = Native::of_verified(&program) {
                return Ok(Backend::Native(Box::new(native)));
            }
        }
        let _ = is_native_allowed;
        Ok(Backend::Interpreter(Box::new(Interpreter::new(program)?)))
    }

    /// Whether machine code runs.
    pub fn is_native(&self) -> bool {
        !matches!(self, Backend::Interpreter(_))
    }

    fn evaluator(&self) -> &dyn Evaluator {
        match self {
            Backend::Interpreter(interpreter) => &**interpreter,
            #[cfg(all(unix, target_arch = "x86_64"))]
            Backend::Native(native) => &**native,
        }
    }

    fn block_evaluator(&self) -> &dyn BlockEvaluator {
        match self {
            Backend::Interpreter(interpreter) => &**interpreter,
            #[cfg(all(unix, target_arch = "x86_64"))]
            Backend::Native(native) => &**native,
        }
    }
}

impl Evaluator for Backend {
    fn program(&self) -> &Program {
        self.evaluator().program()
    }

    fn workspace(&self) -> Workspace {
        self.evaluator().workspace()
    }

    fn prepare(
        &self,
        parameters: &[f64],
        workspace: &mut Workspace,
    ) -> Result<(), EvaluateFailure> {
        self.evaluator().prepare(parameters, workspace)
    }

    fn evaluate_groups(
        &self,
        groups: usize,
        variables: &[f64],
        workspace: &mut Workspace,
        outputs: &mut [f64],
    ) -> Result<(), EvaluateFailure> {
        let evaluator = self.evaluator();
        evaluator.evaluate_groups(groups, variables, workspace, outputs)
    }
}

impl BlockEvaluator for Backend {
    fn block_workspace(&self) -> BlockWorkspace {
        self.block_evaluator().block_workspace()
    }

    fn prepare_block(
        &self,
        parameters: &[Lanes],
        workspace: &mut BlockWorkspace,
    ) -> Result<(), EvaluateFailure> {
        self.block_evaluator().prepare_block(parameters, workspace)
    }

    fn evaluate_block(
        &self,
        groups: usize,
        variables: &[Lanes],
        workspace: &mut BlockWorkspace,
        outputs: &mut [Lanes],
    ) -> Result<(), EvaluateFailure> {
        let evaluator = self.block_evaluator();
        evaluator.evaluate_block(groups, variables, workspace, outputs)
    }
}
