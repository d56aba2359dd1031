//! All values of a program at a state.

use super::convert::from_rational;
use super::linear::Factors;
use crate::evaluate::EvaluateFailure;
use crate::interpret::check_length;
use crate::program::{Binary, Exact, Fused, Instruction, Program, Unary};
use crate::scalar::Scalar;
use crate::schedule::Single;
use crate::verify::VerifyError;
use chetaev_double_double::DoubleDouble;

/// A program in double-double arithmetic, with its values.
///
/// ```
/// use chetaev_compile::double_double::{from_rational, DoubleDouble, PreciseProgram};
/// use chetaev_compile::Lowering;
/// use chetaev_symbolic::{rational, Graph};
///
/// let g = Graph::new();
/// let x = g.intern_symbol("x", 0);
/// let tenth = rational::ratio(1, 10).expect("not over 0");
/// let program = Lowering::new(&g)
///     .variables(&[x])
///     .output("scaled", &[g.scale(&tenth, g.symbol_expr(x))])
///     .lower()?;
/// let mut scaled = PreciseProgram::new(&program)?;
/// scaled.prepare(&[])?;
/// let value = scaled.evaluate(&[DoubleDouble::from(3.0)])?[0];
/// // 3/10 to 31 digits.
/// let expected = from_rational(&rational::ratio(3, 10).expect("not over 0"));
/// assert!((value - expected).abs().high() < 1e-31);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct PreciseProgram {
    values: Values,
    outputs: Vec<u32>,
    found: Vec<DoubleDouble>,
}

impl PreciseProgram {
    /// The program in double-double arithmetic.
    ///
    /// # Errors
    /// [`VerifyError`] if the program is not well formed.
    pub fn new(program: &Program) -> Result<PreciseProgram, VerifyError> {
        program.verify()?;
        let single = Single::of(program);
        let outputs = outputs_of(&single);
        let registers = single.origins.len();
        Ok(PreciseProgram {
            found: Vec::with_capacity(outputs.len()),
            values: Values::new(single, registers),
            outputs,
        })
    }

    /// Sets the parameters; needed before the first evaluation, also without parameters.
    ///
    /// # Errors
    /// [`EvaluateFailure`] for a wrong length, and for a singular matrix that depends on parameters only.
    pub fn prepare(&mut self, parameters: &[DoubleDouble]) -> Result<(), EvaluateFailure> {
        self.values.prepare(parameters)
    }

    /// The values of all outputs, group after group; what has no value is not a number.
    ///
    /// # Errors
    /// [`EvaluateFailure`] for a wrong length, for a singular matrix, and before [`prepare`](PreciseProgram::prepare).
    pub fn evaluate(
        &mut self,
        variables: &[DoubleDouble],
    ) -> Result<&[DoubleDouble], EvaluateFailure> {
        self.values.evaluate(variables)?;
        let file = &self.values.file;
        self.found.clear();
        self.found
            .extend(self.outputs.iter().map(|&register| file[register as usize]));
        Ok(&self.found)
    }
}

/// The registers of the outputs of all groups.
pub(crate) fn outputs_of(single: &Single) -> Vec<u32> {
    let groups = single.groups.iter().flat_map(|group| &group.registers);
    groups.map(|register| register.0).collect()
}

/// The values of all registers of a program in single-assignment form, and its factorized matrices.
#[derive(Clone, Debug)]
pub(crate) struct Values {
    program: Program,
    pub(crate) file: Vec<DoubleDouble>,
    pub(crate) factored: Vec<Factors>,
    is_prepared: bool,
    /// Entries of a matrix, or a right-hand side.
    given: Vec<DoubleDouble>,
    solution: Vec<DoubleDouble>,
}

impl Values {
    /// With so many registers, those of the program first.
    pub(crate) fn new(single: Single, registers: usize) -> Values {
        let program = single.program;
        let mut file = vec![DoubleDouble::ZERO; registers];
        for (value, constant) in file.iter_mut().zip(&program.constants) {
            *value = match &constant.exact {
                Exact::Rational(exact) => from_rational(exact),
                Exact::Pi => DoubleDouble::PI,
            };
        }
        let sizes = program.matrices.iter().map(|matrix| matrix.size);
        Values {
            factored: sizes.map(Factors::new).collect(),
            file,
            program,
            is_prepared: false,
            given: Vec::new(),
            solution: Vec::new(),
        }
    }

    pub(crate) fn prepare(&mut self, parameters: &[DoubleDouble]) -> Result<(), EvaluateFailure> {
        let layout = self.program.layout;
        check_length("parameters", layout.parameters, parameters.len())?;
        self.is_prepared = false;
        self.file[layout.parameter_range()].copy_from_slice(parameters);
        for i in 0..self.program.prologue.len() {
            self.run(self.program.prologue[i])?;
        }
        self.is_prepared = true;
        Ok(())
    }

    pub(crate) fn evaluate(&mut self, variables: &[DoubleDouble]) -> Result<(), EvaluateFailure> {
        let layout = self.program.layout;
        check_length("variables", layout.variables, variables.len())?;
        if !self.is_prepared {
            return Err(EvaluateFailure::NotPrepared);
        }
        // In single-assignment form the variables follow the parameters.
        let start = layout.parameter_range().end;
        self.file[start..start + variables.len()].copy_from_slice(variables);
        for i in 0..self.program.body.len() {
            self.run(self.program.body[i])?;
        }
        Ok(())
    }

    fn run(&mut self, instruction: Instruction) -> Result<(), EvaluateFailure> {
        let file = &mut self.file;
        match instruction {
            Instruction::Unary { operation, out, a } => {
                let a = file[a.index()];
                file[out.index()] = match operation {
                    Unary::Neg => -a,
                    Unary::Square => a * a,
                    Unary::Sqrt => a.sqrt(),
                    Unary::Function(function) => DoubleDouble::apply(function, a),
                };
            }
            Instruction::Binary {
                operation,
                out,
                a,
                b,
            } => {
                let (a, b) = (file[a.index()], file[b.index()]);
                file[out.index()] = match operation {
                    Binary::Add => a + b,
                    Binary::Sub => a - b,
                    Binary::Mul => a * b,
                    Binary::Div => a / b,
                    Binary::Pow => a.powf(b),
                    Binary::Atan2 => a.atan2(b),
                };
            }
            Instruction::Fused {
                operation,
                out,
                a,
                b,
                c,
            } => {
                let (product, c) = (file[a.index()] * file[b.index()], file[c.index()]);
                file[out.index()] = match operation {
                    Fused::MulAdd => product + c,
                    Fused::MulSub => product - c,
                    Fused::NegMulAdd => c - product,
                };
            }
            Instruction::SinCos { sin, cos, a } => {
                let pair = file[a.index()].sin_cos();
                (file[sin.index()], file[cos.index()]) = pair;
            }
            Instruction::Factor { matrix } => return self.factor(matrix as usize),
            Instruction::Solve { solve } => self.solve(solve as usize),
        }
        Ok(())
    }

    fn factor(&mut self, index: usize) -> Result<(), EvaluateFailure> {
        let matrix = &self.program.matrices[index];
        let entries = matrix.entries.iter().map(|entry| self.file[entry.index()]);
        self.given.clear();
        self.given.extend(entries);
        self.factored[index].factorize(&self.given, matrix.factorization, index)
    }

    fn solve(&mut self, index: usize) {
        let solve = &self.program.solves[index];
        let right = solve.rhs.iter().map(|entry| self.file[entry.index()]);
        self.given.clear();
        self.given.extend(right);
        self.solution.resize(self.given.len(), DoubleDouble::ZERO);
        self.factored[solve.matrix as usize].solve(&self.given, &mut self.solution);
        for (out, &value) in solve.out.iter().zip(&self.solution) {
            self.file[out.index()] = value;
        }
    }
}
