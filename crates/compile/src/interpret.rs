//! The interpreters: the reference for every other back end, and the one that runs everywhere.
//!
//! One loop serves single states and blocks; in a block each instruction is applied to
//! [`LANES`](crate::LANES) states before the next is read, so that the cost of reading it is shared.

use crate::decode::{decode, Step};
use crate::evaluate::{BlockEvaluator, EvaluateFailure, Evaluator, PivotRange};
use crate::factor::{Factored, Fault};
use crate::kernel;
use crate::lanes::{Lanes, Word};
use crate::program::Program;
use crate::verify::VerifyError;
use chetaev_symbolic::evaluate::apply;
use chetaev_symbolic::Function;

/// Runs a verified program by reading its instructions one by one.
#[derive(Clone, Debug)]
pub struct Interpreter {
    program: Program,
    prologue: Vec<Step>,
    body: Vec<Step>,
}

impl Interpreter {
    /// An interpreter of `program`.
    ///
    /// # Errors
    /// [`VerifyError`] if the program is not well formed; one made by [`Lowering`](crate::Lowering) is.
    pub fn new(program: Program) -> Result<Interpreter, VerifyError> {
        program.verify()?;
        Ok(Interpreter {
            prologue: decode(&program.prologue),
            body: decode(&program.body),
            program,
        })
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
        state.prepare(&self.program, &self.prologue, parameters)?;
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
        state.evaluate((&self.program, &self.body), groups, variables, outputs)?;
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
        workspace
            .0
            .prepare(&self.program, &self.prologue, parameters)
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
            .evaluate((&self.program, &self.body), groups, variables, outputs)
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

    fn prepare(
        &mut self,
        program: &Program,
        code: &[Step],
        parameters: &[W],
    ) -> Result<(), EvaluateFailure> {
        check_length("parameters", program.layout.parameters, parameters.len())?;
        self.check_shape(program)?;
        self.failures.clear();
        self.file[program.layout.parameter_range()].copy_from_slice(parameters);
        self.run(program, code);
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
        (program, code): (&Program, &[Step]),
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
            if !self.run(program, &code[done..group.end]) {
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
    fn run(&mut self, program: &Program, code: &[Step]) -> bool {
        let mut rest = code;
        // Linear systems need the whole state; what lies between them needs the register file only.
        loop {
            rest = run_scalar(&mut self.file, rest);
            match rest.split_first() {
                Some((Step::Factor(matrix), after)) => {
                    self.factor(program, *matrix as usize);
                    if W::LANES == 1 && !self.failures.is_empty() {
                        return false;
                    }
                    rest = after;
                }
                Some((Step::Solve(solve), after)) => {
                    self.solve(program, *solve as usize);
                    rest = after;
                }
                _ => return true,
            }
        }
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

/// Runs instructions up to the next linear system; returns what is left.
fn run_scalar<'c, W: Word>(file: &mut [W], code: &'c [Step]) -> &'c [Step] {
    let place = |register: u32| register as usize;
    for (i, step) in code.iter().enumerate() {
        match *step {
            Step::Add(out, a, b) => W::binary(file, place(out), place(a), place(b), |a, b| a + b),
            Step::Sub(out, a, b) => W::binary(file, place(out), place(a), place(b), |a, b| a - b),
            Step::Mul(out, a, b) => W::binary(file, place(out), place(a), place(b), |a, b| a * b),
            Step::Div(out, a, b) => W::binary(file, place(out), place(a), place(b), |a, b| a / b),
            Step::MulAdd(out, a, b, c) => {
                let abc = (place(a), place(b), place(c));
                W::ternary(file, place(out), abc, |a, b, c| a * b + c);
            }
            Step::MulSub(out, a, b, c) => {
                let abc = (place(a), place(b), place(c));
                W::ternary(file, place(out), abc, |a, b, c| a * b - c);
            }
            Step::NegMulAdd(out, a, b, c) => {
                let abc = (place(a), place(b), place(c));
                W::ternary(file, place(out), abc, |a, b, c| c - a * b);
            }
            Step::Neg(out, a) => W::unary(file, place(out), place(a), |a| -a),
            Step::Square(out, a) => W::unary(file, place(out), place(a), |a| a * a),
            Step::Sqrt(out, a) => W::unary(file, place(out), place(a), f64::sqrt),
            Step::Pow(out, a, b) => power(file, place(out), place(a), place(b)),
            Step::Atan2(out, a, b) => angle(file, place(out), place(a), place(b)),
            Step::SinCos(sin, cos, a) => sin_cos(file, place(sin), place(cos), place(a)),
            Step::Sin(out, a) => sin(file, place(out), place(a)),
            Step::Cos(out, a) => cos(file, place(out), place(a)),
            Step::Function(function, out, a) => elementary(file, function, place(out), place(a)),
            Step::Factor(_) | Step::Solve(_) => return &code[i..],
        }
    }
    &[]
}

// Out of line, so that the loop above stays small.

#[inline(never)]
fn power<W: Word>(file: &mut [W], out: usize, a: usize, b: usize) {
    W::binary(file, out, a, b, f64::powf);
}

#[inline(never)]
fn angle<W: Word>(file: &mut [W], out: usize, a: usize, b: usize) {
    W::binary(file, out, a, b, f64::atan2);
}

#[inline(never)]
fn elementary<W: Word>(file: &mut [W], function: Function, out: usize, a: usize) {
    W::unary(file, out, a, |a| apply(function, a));
}

#[inline(never)]
fn sin_cos<W: Word>(file: &mut [W], sin: usize, cos: usize, a: usize) {
    let (quick, slow) = (kernel::sin_cos_quick, kernel::sin_cos_library);
    W::pair(file, (sin, cos), a, quick, slow);
}

#[inline(never)]
fn sin<W: Word>(file: &mut [W], out: usize, a: usize) {
    let quick = |a| {
        let (sin, _, is_good) = kernel::sin_cos_quick(a);
        (sin, is_good)
    };
    W::guarded(file, out, a, quick, f64::sin);
}

#[inline(never)]
fn cos<W: Word>(file: &mut [W], out: usize, a: usize) {
    let quick = |a| {
        let (_, cos, is_good) = kernel::sin_cos_quick(a);
        (cos, is_good)
    };
    W::guarded(file, out, a, quick, f64::cos);
}
