//! The interpreters: the reference for every other back end, and the one that runs everywhere.
//!
//! One loop serves single states and blocks; in a block each instruction is applied to
//! [`LANES`](crate::LANES) states before the next is read, so that the cost of reading it is shared.

use crate::evaluate::{BlockEvaluator, EvaluateFailure, Evaluator, PivotRange};
use crate::factor::{Factored, Fault};
use crate::kernel;
use crate::lanes::{Lanes, Word};
use crate::program::{Binary, Fused, Instruction, Program, Unary};
use crate::verify::VerifyError;
use chetaev_symbolic::evaluate::apply;
use chetaev_symbolic::Function;

/// Runs a verified program by reading its instructions one by one.
#[derive(Clone, Debug)]
pub struct Interpreter {
    program: Program,
}

impl Interpreter {
    /// An interpreter of `program`.
    ///
    /// # Errors
    /// [`VerifyError`] if the program is not well formed; one made by [`Lowering`](crate::Lowering) is.
    pub fn new(program: Program) -> Result<Interpreter, VerifyError> {
        program.verify()?;
        Ok(Interpreter { program })
    }
}

#[derive(Clone, Debug)]
struct State<W> {
    file: Vec<W>,
    factored: Vec<Factored<W>>,
    /// A solution on its way from a matrix to the register file.
    solution: Vec<W>,
    failures: Vec<(usize, EvaluateFailure)>,
    /// How many failures are of the prologue.
    lasting: usize,
    is_prepared: bool,
}

/// Storage for the evaluation of single states.
#[derive(Clone, Debug)]
pub struct Workspace(State<f64>);

/// Storage for the evaluation of blocks of states.
#[derive(Clone, Debug)]
pub struct BlockWorkspace(State<Lanes>);

impl Workspace {
    /// The pivots of a matrix (an index in [`Program::matrices`]) in the last evaluation that factorized it.
    pub fn pivots(&self, matrix: usize) -> Option<PivotRange> {
        let factored = self.0.factored.get(matrix)?;
        Some(factored.range(0))
    }
}

impl BlockWorkspace {
    /// The states that have no value in the last evaluation, with the first reason of each.
    pub fn failures(&self) -> &[(usize, EvaluateFailure)] {
        &self.0.failures
    }

    /// The pivots of a matrix in one state, in the last evaluation that factorized it.
    pub fn pivots(&self, matrix: usize, state: usize) -> Option<PivotRange> {
        let factored = self.0.factored.get(matrix)?;
        (state < Lanes::LANES).then(|| factored.range(state))
    }
}

impl Evaluator for Interpreter {
    fn program(&self) -> &Program {
        &self.program
    }

    fn workspace(&self) -> Workspace {
        Workspace(State::new(&self.program))
    }

    fn prepare(
        &self,
        parameters: &[f64],
        workspace: &mut Workspace,
    ) -> Result<(), EvaluateFailure> {
        let state = &mut workspace.0;
        state.prepare(&self.program, parameters)?;
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
        let state = &mut workspace.0;
        state.evaluate(&self.program, groups, variables, outputs)?;
        state.first_failure()
    }
}

impl BlockEvaluator for Interpreter {
    fn block_workspace(&self) -> BlockWorkspace {
        BlockWorkspace(State::new(&self.program))
    }

    fn prepare_block(
        &self,
        parameters: &[Lanes],
        workspace: &mut BlockWorkspace,
    ) -> Result<(), EvaluateFailure> {
        workspace.0.prepare(&self.program, parameters)
    }

    fn evaluate_block(
        &self,
        groups: usize,
        variables: &[Lanes],
        workspace: &mut BlockWorkspace,
        outputs: &mut [Lanes],
    ) -> Result<(), EvaluateFailure> {
        workspace
            .0
            .evaluate(&self.program, groups, variables, outputs)
    }
}

fn check_length(what: &'static str, expected: usize, found: usize) -> Result<(), EvaluateFailure> {
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
    fn new(program: &Program) -> State<W> {
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

    fn first_failure(&self) -> Result<(), EvaluateFailure> {
        match self.failures.first() {
            Some(&(_, failure)) => Err(failure),
            None => Ok(()),
        }
    }

    fn prepare(&mut self, program: &Program, parameters: &[W]) -> Result<(), EvaluateFailure> {
        check_length("parameters", program.layout.parameters, parameters.len())?;
        self.check_shape(program)?;
        self.failures.clear();
        self.file[program.layout.parameter_range()].copy_from_slice(parameters);
        self.run(program, &program.prologue);
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

    fn evaluate(
        &mut self,
        program: &Program,
        groups: usize,
        variables: &[W],
        outputs: &mut [W],
    ) -> Result<(), EvaluateFailure> {
        check_length("variables", program.layout.variables, variables.len())?;
        check_length("outputs", program.output_count_of(groups), outputs.len())?;
        self.check_shape(program)?;
        if !self.is_prepared {
            return Err(EvaluateFailure::NotPrepared);
        }
        self.failures.truncate(self.lasting);
        self.file[program.layout.variable_range()].copy_from_slice(variables);
        let mut outputs = outputs.iter_mut();
        let mut done = 0;
        for group in program.outputs.iter().take(groups) {
            if !self.run(program, &program.body[done..group.end]) {
                return Ok(());
            }
            done = group.end;
            for (register, output) in group.registers.iter().zip(&mut outputs) {
                *output = self.file[register.index()];
            }
        }
        Ok(())
    }

    /// Runs instructions in order; `false` when no state is left that could go on.
    fn run(&mut self, program: &Program, code: &[Instruction]) -> bool {
        for &instruction in code {
            match instruction {
                Instruction::Unary { operation, out, a } => {
                    unary(&mut self.file, operation, out.index(), a.index());
                }
                Instruction::Binary {
                    operation,
                    out,
                    a,
                    b,
                } => binary(
                    &mut self.file,
                    operation,
                    out.index(),
                    (a.index(), b.index()),
                ),
                Instruction::Fused {
                    operation,
                    out,
                    a,
                    b,
                    c,
                } => {
                    let operands = (a.index(), b.index(), c.index());
                    fused(&mut self.file, operation, out.index(), operands);
                }
                Instruction::SinCos { sin, cos, a } => W::pair(
                    &mut self.file,
                    (sin.index(), cos.index()),
                    a.index(),
                    kernel::sin_cos_quick,
                    kernel::sin_cos_library,
                ),
                Instruction::Factor { matrix } => {
                    self.factor(program, matrix as usize);
                    if W::LANES == 1 && !self.failures.is_empty() {
                        return false;
                    }
                }
                Instruction::Solve { solve } => self.solve(program, solve as usize),
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

#[inline(always)]
fn unary<W: Word>(file: &mut [W], operation: Unary, out: usize, a: usize) {
    match operation {
        Unary::Neg => W::unary(file, out, a, |a| -a),
        Unary::Square => W::unary(file, out, a, |a| a * a),
        Unary::Sqrt => W::unary(file, out, a, f64::sqrt),
        Unary::Function(Function::Sin) => {
            let quick = |a| {
                let (sin, _, is_good) = kernel::sin_cos_quick(a);
                (sin, is_good)
            };
            W::guarded(file, out, a, quick, f64::sin);
        }
        Unary::Function(Function::Cos) => {
            let quick = |a| {
                let (_, cos, is_good) = kernel::sin_cos_quick(a);
                (cos, is_good)
            };
            W::guarded(file, out, a, quick, f64::cos);
        }
        Unary::Function(function) => W::unary(file, out, a, |a| apply(function, a)),
    }
}

#[inline(always)]
fn binary<W: Word>(file: &mut [W], operation: Binary, out: usize, ab: (usize, usize)) {
    match operation {
        Binary::Add => W::binary(file, out, ab, |a, b| a + b),
        Binary::Sub => W::binary(file, out, ab, |a, b| a - b),
        Binary::Mul => W::binary(file, out, ab, |a, b| a * b),
        Binary::Div => W::binary(file, out, ab, |a, b| a / b),
        Binary::Pow => W::binary(file, out, ab, f64::powf),
        Binary::Atan2 => W::binary(file, out, ab, f64::atan2),
    }
}

#[inline(always)]
fn fused<W: Word>(file: &mut [W], operation: Fused, out: usize, abc: (usize, usize, usize)) {
    match operation {
        Fused::MulAdd => W::ternary(file, out, abc, |a, b, c| a * b + c),
        Fused::MulSub => W::ternary(file, out, abc, |a, b, c| a * b - c),
        Fused::NegMulAdd => W::ternary(file, out, abc, |a, b, c| c - a * b),
    }
}
