//! Which back end runs a program: native code where the machine has it, the interpreter elsewhere.

use crate::evaluate::{BlockEvaluator, EvaluateFailure, Evaluator};
use crate::interpret::{BlockWorkspace, Interpreter, Workspace};
use crate::lanes::Lanes;
#[cfg(all(unix, target_arch = "x86_64"))]
use crate::native::{Native, Vectors};
use crate::program::Program;
use crate::verify::VerifyError;

/// The environment variable that, set to `interpreter`, turns native code off, and, set to `avx2`, keeps it from
/// wider vectors.
pub const VARIABLE: &str = "CHETAEV_BACKEND";

/// What [`VARIABLE`] may ask for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wish {
    /// Whatever is fastest: the variable is not set, or empty.
    Fastest,
    /// `interpreter`: no native code.
    Interpreter,
    /// `avx2`: no wider vectors.
    Avx2,
}

/// A value of [`VARIABLE`] that asks for nothing there is.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{VARIABLE}={value}: there is no such back end; it may be `interpreter` or `avx2`, or not set at all for the fastest")]
pub struct UnknownBackend {
    /// The value.
    pub value: String,
}

/// What [`VARIABLE`] asks for.
///
/// # Errors
/// [`UnknownBackend`]; [`backend`] then takes the fastest, so whoever reads commands of a user asks first.
pub fn wish() -> Result<Wish, UnknownBackend> {
    let value = std::env::var_os(VARIABLE).unwrap_or_default();
    match value.to_str() {
        Some("") => Ok(Wish::Fastest),
        Some("interpreter") => Ok(Wish::Interpreter),
        Some("avx2") => Ok(Wish::Avx2),
        _ => Err(UnknownBackend {
            value: value.to_string_lossy().into_owned(),
        }),
    }
}

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
/// Results of back ends differ by rounding. On every model of the gallery each rate differs by at most 64 units in the last
/// place, of the largest rate or of 1, and 64 for every unit by which it moves with the last places of the state
/// (`tests/series.rs` of the workspace; measured: 53 for the rattleback, below 20 for all others); over random programs every
/// output by at most 10⁻¹³ of its size, or of 1 if that is larger, and ten times what relative changes of 10⁻¹⁴ in the variables
/// do (`tests/random_programs.rs`). The environment variable [`VARIABLE`] turns native code off.
///
/// # Errors
/// [`VerifyError`] if the program is not well formed; one made by [`Lowering`](crate::Lowering) is.
pub fn backend(program: Program) -> Result<Backend, VerifyError> {
    let wish = wish().unwrap_or(Wish::Fastest);
    #[cfg(all(unix, target_arch = "x86_64"))]
    if let Some(widest) = Vectors::widest().filter(|_| wish != Wish::Interpreter) {
        let vectors = match wish {
            Wish::Avx2 => Vectors::Avx2,
            _ => widest,
        };
        return Backend::with_vectors(program, vectors);
    }
    let _ = wish;
    Backend::interpreter(program)
}

impl Backend {
    /// The interpreter, on every machine.
    ///
    /// # Errors
    /// [`VerifyError`] if the program is not well formed.
    pub fn interpreter(program: Program) -> Result<Backend, VerifyError> {
        Ok(Backend::Interpreter(Box::new(Interpreter::new(program)?)))
    }

    /// Native code with these vectors if the machine has them, the interpreter otherwise.
    ///
    /// # Errors
    /// [`VerifyError`] if the program is not well formed.
    #[cfg(all(unix, target_arch = "x86_64"))]
    pub fn with_vectors(program: Program, vectors: Vectors) -> Result<Backend, VerifyError> {
        program.verify()?;
        match Native::of_verified(&program, vectors) {
            Some(native) => Ok(Backend::Native(Box::new(native))),
            None => Backend::interpreter(program),
        }
    }

    /// Whether machine code runs.
    pub fn is_native(&self) -> bool {
        !matches!(self, Backend::Interpreter(_))
    }

    /// The vectors that machine code for blocks uses; `None` where none runs.
    #[cfg(all(unix, target_arch = "x86_64"))]
    pub fn vectors(&self) -> Option<Vectors> {
        match self {
            Backend::Interpreter(_) => None,
            Backend::Native(native) => Some(native.vectors()),
        }
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
