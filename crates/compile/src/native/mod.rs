//! Native code for x86-64 with AVX2 and FMA, or AVX-512.
//!
//! ```text
//! Program ──translate──▶ Code ──registers──▶ Steps ──emit──▶ bytes ──memory──▶ Pages
//!            │ kernels, linear, gather
//! ```
//!
//! One emitter makes the code for single states and for four or eight states side by side; the same operations in the
//! same order, so that a state has the same result alone and in a block. The prologue is interpreted: it runs once. A
//! state whose pivots leave a doubt is evaluated by the interpreter, so failures are the interpreter's own.
//!
//! Values differ from the interpreter's by fused multiply-adds, and by functions, whose greatest errors, measured
//! against correctly rounded values, are stated in [`Native`].

pub(crate) mod assembler;
mod call;
pub(crate) mod code;
mod dense;
mod emit;
mod gather;
mod kernels;
mod linear;
pub(crate) mod machine;
mod memory;
pub(crate) mod polynomials;
pub(crate) mod products;
mod registers;
mod translate;

use crate::decode;
use crate::evaluate::{BlockEvaluator, EvaluateFailure, Evaluator};
use crate::frames::Frames;
use crate::interpret::{BlockWorkspace, State, Workspace};
use crate::lanes::{Lanes, Word, LANES};
use crate::program::Program;
use crate::verify::VerifyError;
use assembler::Width;
use machine::{numbers, numbers_mut, Data, Machine};
use std::sync::OnceLock;

/// Runs a verified program as machine code.
///
/// Greatest errors of the functions, measured against enclosures (`tests/functions.rs`), in units in the last place:
/// sine and cosine 0.70, exponential 0.61, logarithm 0.75, square root 0.5, for arguments of every size; all other
/// functions are those of the standard library.
#[derive(Debug)]
pub struct Native {
    /// In the order of the program.
    code: decode::Code,
    single: Machine,
    /// By number of groups: how many outputs they have.
    counts: Vec<usize>,
    vectors: Vectors,
    /// Made when the first block is evaluated; `None` where it cannot be.
    block: OnceLock<Option<Machine>>,
}

/// Vector instructions, of which native code for blocks uses the widest.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
#[non_exhaustive]
pub enum Vectors {
    /// AVX2 and FMA: four states at a time.
    Avx2,
    /// AVX-512 (F, DQ, BW and VL): eight states at a time.
    Avx512,
}

impl Vectors {
    /// The widest that this processor has; `None` if it has none that native code uses.
    pub fn widest() -> Option<Vectors> {
        let all = [Vectors::Avx512, Vectors::Avx2];
        all.into_iter().find(|vectors| vectors.are_available())
    }

    /// Whether this processor has them.
    pub fn are_available(self) -> bool {
        match self {
            Vectors::Avx2 => is_available(),
            Vectors::Avx512 => {
                is_available()
                    && is_x86_feature_detected!("avx512f")
                    && is_x86_feature_detected!("avx512dq")
                    && is_x86_feature_detected!("avx512bw")
                    && is_x86_feature_detected!("avx512vl")
            }
        }
    }

    fn width(self) -> Width {
        match self {
            Vectors::Avx2 => Width::Four,
            Vectors::Avx512 => Width::Eight,
        }
    }
}

/// Whether this processor has the instructions that all native code uses.
pub(crate) fn is_available() -> bool {
    is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma")
}

/// Whether this processor has the instructions of code for so many states at a time.
fn can_run(width: Width) -> bool {
    match width {
        Width::One | Width::Four => Vectors::Avx2.are_available(),
        Width::Eight => Vectors::Avx512.are_available(),
    }
}

impl Native {
    /// Compiles `program` for the widest vectors of this processor; `None` where native code cannot run: the processor lacks AVX2 or FMA, or the system
    /// refuses pages for it.
    ///
    /// # Errors
    /// [`VerifyError`] if the program is not well formed; one made by [`Lowering`](crate::Lowering) is.
    pub fn new(program: Program) -> Result<Option<Native>, VerifyError> {
        program.verify()?;
        let widest = Vectors::widest();
        Ok(widest.and_then(|vectors| Native::of_verified(&program, vectors)))
    }

    /// The same with these vectors, to compare them; `None` also where the processor lacks them. All give the same
    /// results.
    ///
    /// # Errors
    /// As [`new`](Native::new).
    pub fn with_vectors(program: Program, vectors: Vectors) -> Result<Option<Native>, VerifyError> {
        program.verify()?;
        Ok(Native::of_verified(&program, vectors))
    }

    pub(crate) fn of_verified(program: &Program, vectors: Vectors) -> Option<Native> {
        if !vectors.are_available() {
            return None;
        }
        Some(Native {
            vectors,
            single: Machine::new(program, Width::One)?,
            counts: (0..=program.outputs.len())
                .map(|groups| program.output_count_of(groups))
                .collect(),
            block: OnceLock::new(),
            code: decode::Code::of(program.clone()),
        })
    }

    /// The vectors that code for blocks uses.
    pub fn vectors(&self) -> Vectors {
        self.vectors
    }

    /// Bytes of machine code for single states.
    pub fn code_size(&self) -> usize {
        self.single.bytes()
    }

    fn block(&self) -> Option<&Machine> {
        let make = || Machine::new(&self.code.program, self.vectors.width());
        self.block.get_or_init(make).as_ref()
    }
}

/// Gives the frames the factors of matrices that the prologue has factorized.
fn copy_factors<W: Word>(machine: &Machine, state: &State<W>, frames: &mut Frames) {
    for l in 0..W::LANES {
        copy_factors_of(machine, (state, l), frames, l);
    }
}

/// The same for state l of `state`, which is number `to` of those that the machine takes.
pub(crate) fn copy_factors_of<W: Word>(
    machine: &Machine,
    (state, l): (&State<W>, usize),
    frames: &mut Frames,
    to: usize,
) {
    let lanes = frames.lanes;
    let (run, lane) = (to / lanes, to % lanes);
    for &(matrix, cells) in machine.copied() {
        let factored = &state.factored[matrix];
        let (size, stride) = (factored.size(), dense::stride(factored.size()));
        let Some(frame) = frames.frame(run) else {
            continue;
        };
        let mut write = |cell: usize, value: f64| {
            let offset = cells + 8 * (cell * lanes + lane) as i32;
            frame.write(offset, std::iter::once(value));
        };
        for (i, value) in factored.factors(l).enumerate() {
            write(i / size * stride + i % size, value);
        }
        for (i, other) in dense::exchanges(&factored.rows(l)).into_iter().enumerate() {
            write(size * stride + size + i, other as f64);
        }
    }
}

impl Evaluator for Native {
    fn program(&self) -> &Program {
        &self.code.program
    }

    fn workspace(&self) -> Workspace {
        Workspace {
            state: State::new(&self.code.program),
            native: Some(self.single.frames()),
        }
    }

    fn prepare(
        &self,
        parameters: &[f64],
        workspace: &mut Workspace,
    ) -> Result<(), EvaluateFailure> {
        let Workspace { state, native } = workspace;
        let Some(native) = native else {
            return Err(EvaluateFailure::NotPrepared);
        };
        state.prepare(&self.code, parameters)?;
        state.is_prepared = state.failures.is_empty();
        copy_factors(&self.single, state, native);
        state.first_failure()
    }

    fn evaluate_groups(
        &self,
        groups: usize,
        variables: &[f64],
        workspace: &mut Workspace,
        outputs: &mut [f64],
    ) -> Result<(), EvaluateFailure> {
        let Workspace { state, native } = workspace;
        let groups = groups.min(self.counts.len() - 1);
        let fits = state.is_prepared
            && variables.len() == self.code.program.layout.variables
            && outputs.len() == self.counts[groups];
        let Some(native) = native.as_mut().filter(|_| fits) else {
            // Which it is need not be found out quickly.
            state.check(&self.code.program, groups, variables, outputs)?;
            return Err(EvaluateFailure::NotPrepared);
        };
        if groups == 0 {
            return Ok(());
        }
        let data = Data {
            variables,
            file: &state.file,
            outputs,
        };
        let frame = native.frame(0);
        let failed = frame.and_then(|frame| self.single.run(frame, groups, data));
        match failed {
            None => return Err(EvaluateFailure::NotPrepared),
            Some(0) => {
                native.interpreted = 0;
                return Ok(());
            }
            Some(_) => native.interpreted = 1,
        }
        state.evaluate(&self.code, groups, variables, outputs)?;
        state.first_failure()
    }
}

impl BlockEvaluator for Native {
    fn block_workspace(&self) -> BlockWorkspace {
        BlockWorkspace {
            state: State::new(&self.code.program),
            native: self.block().map(Machine::frames),
        }
    }

    fn prepare_block(
        &self,
        parameters: &[Lanes],
        workspace: &mut BlockWorkspace,
    ) -> Result<(), EvaluateFailure> {
        let BlockWorkspace { state, native } = workspace;
        state.prepare(&self.code, parameters)?;
        if let (Some(machine), Some(native)) = (self.block(), native) {
            copy_factors(machine, state, native);
        }
        Ok(())
    }

    fn evaluate_block(
        &self,
        groups: usize,
        variables: &[Lanes],
        workspace: &mut BlockWorkspace,
        outputs: &mut [Lanes],
    ) -> Result<(), EvaluateFailure> {
        let BlockWorkspace { state, native } = workspace;
        let program = &self.code.program;
        let groups = groups.min(program.outputs.len());
        state.check(program, groups, variables, outputs)?;
        let (Some(machine), Some(native)) = (self.block(), native) else {
            return state.evaluate(&self.code, groups, variables, outputs);
        };
        if groups == 0 {
            return Ok(());
        }
        let failed = run_block(machine, native, groups, state, variables, outputs)
            .ok_or(EvaluateFailure::NotPrepared)?;
        native.interpreted = failed;
        state.failures.truncate(state.lasting);
        if failed == 0 {
            return Ok(());
        }
        let has_failed = |l: usize| failed >> l & 1 != 0;
        state.compute(&self.code, groups, variables, outputs, |output, value| {
            for l in (0..LANES).filter(|&l| has_failed(l)) {
                output.set_lane(l, value.lane(l));
            }
        });
        let mut index = 0;
        state.failures.retain(|failure| {
            index += 1;
            index <= state.lasting || has_failed(failure.0)
        });
        Ok(())
    }
}

/// Runs all states of a block; the bits of those without a result.
fn run_block(
    machine: &Machine,
    native: &mut Frames,
    groups: usize,
    state: &State<Lanes>,
    variables: &[Lanes],
    outputs: &mut [Lanes],
) -> Option<u32> {
    let (variables, file) = (numbers(variables), numbers(&state.file));
    let outputs = numbers_mut(outputs);
    let mut failed = 0;
    for run in 0..LANES / machine.lanes() {
        let first = run * machine.lanes();
        let data = Data {
            variables: variables.get(first..).unwrap_or_default(),
            file: file.get(first..).unwrap_or_default(),
            outputs: outputs.get_mut(first..).unwrap_or_default(),
        };
        let bits = machine.run(native.frame(run)?, groups, data)?;
        native.keep(run);
        failed |= (bits as u32) << first;
    }
    Some(failed)
}
