//! The interpreters: the reference for every other back end, and the one that runs everywhere.
//!
//! One loop serves single states and blocks; in a block each instruction is applied to
//! [`LANES`](crate::LANES) states before the next is read, so that the cost of reading it is shared.

use crate::decode::{Code, Operands, Operation, Run};
use crate::evaluate::{BlockEvaluator, EvaluateFailure, Evaluator, PivotRange};
use crate::factor::{Factored, Fault};
use crate::frames::Frames;
use crate::kernel;
use crate::lanes::{Lanes, Word};
use crate::program::Program;
use crate::schedule;
use crate::verify::VerifyError;
use chetaev_symbolic::evaluate::apply;
use chetaev_symbolic::Function;

/// Runs a verified program by reading its instructions one by one.
#[derive(Clone, Debug)]
pub struct Interpreter {
    program: Program,
    /// For single states: in an order that suits the processor's prediction of jumps.
    single: Code,
    /// For blocks: in the order of the program, which needs the fewest registers.
    block: Code,
}

impl Interpreter {
    /// An interpreter of `program`.
    ///
    /// # Errors
    /// [`VerifyError`] if the program is not well formed; one made by [`Lowering`](crate::Lowering) is.
    pub fn new(program: Program) -> Result<Interpreter, VerifyError> {
        program.verify()?;
        Ok(Interpreter {
            single: Code::of(schedule::in_runs(&program)),
            block: Code::of(program.clone()),
            program,
        })
    }
}

#[derive(Clone, Debug)]
pub(crate) struct State<W> {
    pub(crate) file: Vec<W>,
    pub(crate) factored: Vec<Factored<W>>,
    /// A solution on its way from a matrix to the register file.
    solution: Vec<W>,
    pub(crate) failures: Vec<(usize, EvaluateFailure)>,
    /// How many failures are of the prologue.
    pub(crate) lasting: usize,
    pub(crate) is_prepared: bool,
}

/// Storage for the evaluation of single states, by the back end that made it.
#[derive(Clone, Debug)]
pub struct Workspace {
    pub(crate) state: State<f64>,
    /// What native code needs beside it.
    pub(crate) native: Option<Frames>,
}

/// Storage for the evaluation of blocks of states, by the back end that made it.
#[derive(Clone, Debug)]
pub struct BlockWorkspace {
    pub(crate) state: State<Lanes>,
    /// What native code needs beside it.
    pub(crate) native: Option<Frames>,
}

impl Workspace {
    /// The pivots of a matrix (an index in [`Program::matrices`]) in the last evaluation that factorized it.
    pub fn pivots(&self, matrix: usize) -> Option<PivotRange> {
        let native = self.native.as_ref();
        if let Some(range) = native.and_then(|native| native.pivots(matrix, 0)) {
            return Some(range);
        }
        let factored = self.state.factored.get(matrix)?;
        Some(factored.range(0))
    }

    fn interpreted(&mut self) -> Result<&mut State<f64>, EvaluateFailure> {
        match self.native {
            None => Ok(&mut self.state),
            Some(_) => Err(EvaluateFailure::NotPrepared),
        }
    }
}

impl BlockWorkspace {
    /// The states that have no value in the last evaluation, with the first reason of each.
    pub fn failures(&self) -> &[(usize, EvaluateFailure)] {
        &self.state.failures
    }

    /// The pivots of a matrix in one state, in the last evaluation that factorized it.
    pub fn pivots(&self, matrix: usize, state: usize) -> Option<PivotRange> {
        let factored = self.state.factored.get(matrix)?;
        if state >= Lanes::LANES {
            return None;
        }
        let native = self.native.as_ref();
        let range = native.and_then(|native| native.pivots(matrix, state));
        Some(range.unwrap_or_else(|| factored.range(state)))
    }
}

impl Evaluator for Interpreter {
    fn program(&self) -> &Program {
        &self.program
    }

    fn workspace(&self) -> Workspace {
        Workspace {
            state: State::new(&self.single.program),
            native: None,
        }
    }

    fn prepare(
        &self,
        parameters: &[f64],
        workspace: &mut Workspace,
    ) -> Result<(), EvaluateFailure> {
        let state = workspace.interpreted()?;
        state.prepare(&self.single, parameters)?;
        state.is_prepared = state.failures.is_empty();
        state.first_failure()
    }

    fn evaluate_groups(
        &self,
        groups: usize,
        variables: &[f64],
        workspace: &mut Workspace,
        outputs: &mut [f64],
    ) -> Result<(), EvaluateFailure> {
        let state = workspace.interpreted()?;
        state.evaluate(&self.single, groups, variables, outputs)?;
        state.first_failure()
    }
}

impl BlockEvaluator for Interpreter {
    fn block_workspace(&self) -> BlockWorkspace {
        BlockWorkspace {
            state: State::new(&self.block.program),
            native: None,
        }
    }

    fn prepare_block(
        &self,
        parameters: &[Lanes],
        workspace: &mut BlockWorkspace,
    ) -> Result<(), EvaluateFailure> {
        workspace.state.prepare(&self.block, parameters)
    }

    fn evaluate_block(
        &self,
        groups: usize,
        variables: &[Lanes],
        workspace: &mut BlockWorkspace,
        outputs: &mut [Lanes],
    ) -> Result<(), EvaluateFailure> {
        let state = &mut workspace.state;
        state.evaluate(&self.block, groups, variables, outputs)
    }
}

pub(crate) fn check_length(
    what: &'static str,
    expected: usize,
    found: usize,
) -> Result<(), EvaluateFailure> {
    if expected == found {
        return Ok(());
    }
    Err(EvaluateFailure::Length {
        what,
        expected,
        found,
    })
}

impl<W: Word> State<W> {
    pub(crate) fn new(program: &Program) -> State<W> {
        let mut file = vec![W::default(); program.layout.len()];
        for (register, constant) in file.iter_mut().zip(&program.constants) {
            *register = W::splat(constant.value);
        }
        let sizes = || program.matrices.iter().map(|matrix| matrix.size);
        State {
            file,
            factored: sizes().map(Factored::new).collect(),
            solution: vec![W::default(); sizes().max().unwrap_or(0)],
            failures: Vec::with_capacity(W::LANES),
            lasting: 0,
            is_prepared: false,
        }
    }

    pub(crate) fn first_failure(&self) -> Result<(), EvaluateFailure> {
        match self.failures.first() {
            Some(&(_, failure)) => Err(failure),
            None => Ok(()),
        }
    }

    pub(crate) fn prepare(&mut self, code: &Code, parameters: &[W]) -> Result<(), EvaluateFailure> {
        let layout = &code.program.layout;
        check_length("parameters", layout.parameters, parameters.len())?;
        self.check_shape(&code.program)?;
        self.failures.clear();
        self.file[layout.parameter_range()].copy_from_slice(parameters);
        self.run(code, &code.prologue);
        self.lasting = self.failures.len();
        self.is_prepared = true;
        Ok(())
    }

    fn check_shape(&self, program: &Program) -> Result<(), EvaluateFailure> {
        let fits = self.file.len() == program.layout.len()
            && self.factored.len() == program.matrices.len();
        if fits {
            Ok(())
        } else {
            Err(EvaluateFailure::NotPrepared)
        }
    }

    /// Whether an evaluation at these variables can begin.
    pub(crate) fn check_variables(
        &self,
        program: &Program,
        variables: &[W],
    ) -> Result<(), EvaluateFailure> {
        check_length("variables", program.layout.variables, variables.len())?;
        self.check_shape(program)?;
        match self.is_prepared {
            true => Ok(()),
            false => Err(EvaluateFailure::NotPrepared),
        }
    }

    /// Whether an evaluation with these arguments can begin.
    pub(crate) fn check(
        &self,
        program: &Program,
        groups: usize,
        variables: &[W],
        outputs: &[W],
    ) -> Result<(), EvaluateFailure> {
        check_length("variables", program.layout.variables, variables.len())?;
        check_length("outputs", program.output_count_of(groups), outputs.len())?;
        self.check_variables(program, variables)
    }

    pub(crate) fn evaluate(
        &mut self,
        code: &Code,
        groups: usize,
        variables: &[W],
        outputs: &mut [W],
    ) -> Result<(), EvaluateFailure> {
        self.check(&code.program, groups, variables, outputs)?;
        self.compute(code, groups, variables, outputs, |output, value| {
            *output = value;
        });
        Ok(())
    }

    /// Evaluates arguments that have been checked; `write` receives every output and its value.
    pub(crate) fn compute(
        &mut self,
        code: &Code,
        groups: usize,
        variables: &[W],
        outputs: &mut [W],
        write: impl Fn(&mut W, W),
    ) {
        let program = &code.program;
        self.failures.truncate(self.lasting);
        self.file[program.layout.variable_range()].copy_from_slice(variables);
        let mut outputs = outputs.iter_mut();
        for (group, runs) in program.outputs.iter().zip(&code.groups).take(groups) {
            if !self.run(code, runs) {
                return;
            }
            for (register, output) in group.registers.iter().zip(&mut outputs) {
                write(output, self.file[register.index()]);
            }
        }
    }

    /// Runs instructions in order; `false` when no state is left that could go on.
    fn run(&mut self, code: &Code, runs: &[Run]) -> bool {
        for run in runs {
            match run.operation {
                Operation::Factor => {
                    self.factor(&code.program, run.start);
                    if W::LANES == 1 && !self.failures.is_empty() {
                        return false;
                    }
                }
                Operation::Solve => self.solve(&code.program, run.start),
                operation => {
                    let operands = &code.operands[run.start..run.end];
                    execute(&mut self.file, operation, operands);
                }
            }
        }
        true
    }

    fn factor(&mut self, program: &Program, index: usize) {
        let matrix = &program.matrices[index];
        let factored = &mut self.factored[index];
        for (given, entry) in factored.given_mut().iter_mut().zip(&matrix.entries) {
            *given = self.file[entry.index()];
        }
        let failures = &mut self.failures;
        let mut report = |state, fault| {
            if failures.iter().all(|failure| failure.0 != state) {
                failures.push((state, failure(index, fault)));
            }
        };
        factored.factorize(matrix.factorization, &mut report);
    }

    fn solve(&mut self, program: &Program, index: usize) {
        let solve = &program.solves[index];
        let factored = &self.factored[solve.matrix as usize];
        let solution = &mut self.solution[..solve.rhs.len()];
        factored.solve(|i, l| self.file[solve.rhs[i].index()].lane(l), solution);
        for (out, x) in solve.out.iter().zip(solution) {
            self.file[out.index()] = *x;
        }
    }
}

fn failure(matrix: usize, fault: Fault) -> EvaluateFailure {
    match fault {
        Fault::NotFinite => EvaluateFailure::NotFinite { matrix },
        Fault::Singular {
            pivot,
            value,
            threshold,
            range,
        } => EvaluateFailure::Singular {
            matrix,
            pivot,
            value,
            threshold,
            smallest: range.smallest,
            largest: range.largest,
        },
    }
}

/// Applies one operation to registers, for one instruction after the other.
fn execute<W: Word>(file: &mut [W], operation: Operation, operands: &[Operands]) {
    match operation {
        Operation::Add => binary(file, operands, |a, b| a + b),
        Operation::Sub => binary(file, operands, |a, b| a - b),
        Operation::Mul => binary(file, operands, |a, b| a * b),
        Operation::Div => binary(file, operands, |a, b| a / b),
        Operation::MulAdd => ternary(file, operands, |a, b, c| a * b + c),
        Operation::MulSub => ternary(file, operands, |a, b, c| a * b - c),
        Operation::NegMulAdd => ternary(file, operands, |a, b, c| c - a * b),
        Operation::Neg => unary(file, operands, |a| -a),
        Operation::Square => unary(file, operands, |a| a * a),
        Operation::Sqrt => unary(file, operands, f64::sqrt),
        Operation::Pow => binary(file, operands, libm::pow),
        Operation::Atan2 => binary(file, operands, libm::atan2),
        Operation::SinCos => sin_cos(file, operands),
        Operation::Function(Function::Sin) => sin(file, operands),
        Operation::Function(Function::Cos) => cos(file, operands),
        Operation::Function(function) => unary(file, operands, |a| apply(function, a)),
        Operation::Factor | Operation::Solve => {}
    }
}

#[inline(always)]
fn unary<W: Word>(file: &mut [W], operands: &[Operands], f: impl Fn(f64) -> f64 + Copy) {
    for &[out, a, _, _] in operands {
        W::unary(file, out as usize, a as usize, f);
    }
}

#[inline(always)]
fn binary<W: Word>(file: &mut [W], operands: &[Operands], f: impl Fn(f64, f64) -> f64 + Copy) {
    for &[out, a, b, _] in operands {
        W::binary(file, out as usize, a as usize, b as usize, f);
    }
}

#[inline(always)]
fn ternary<W: Word>(
    file: &mut [W],
    operands: &[Operands],
    f: impl Fn(f64, f64, f64) -> f64 + Copy,
) {
    for &[out, a, b, c] in operands {
        W::ternary(file, out as usize, (a as usize, b as usize, c as usize), f);
    }
}

fn sin_cos<W: Word>(file: &mut [W], operands: &[Operands]) {
    let (quick, slow) = (kernel::sin_cos_quick, kernel::sin_cos_library);
    for &[sin, a, _, cos] in operands {
        W::pair(file, (sin as usize, cos as usize), a as usize, quick, slow);
    }
}

fn sin<W: Word>(file: &mut [W], operands: &[Operands]) {
    let quick = |a| {
        let (sin, _, is_good) = kernel::sin_cos_quick(a);
        (sin, is_good)
    };
    for &[out, a, _, _] in operands {
        W::guarded(file, out as usize, a as usize, quick, f64::sin);
    }
}

fn cos<W: Word>(file: &mut [W], operands: &[Operands]) {
    let quick = |a| {
        let (_, cos, is_good) = kernel::sin_cos_quick(a);
        (cos, is_good)
    };
    for &[out, a, _, _] in operands {
        W::guarded(file, out as usize, a as usize, quick, f64::cos);
    }
}
