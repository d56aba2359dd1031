//! The flat program: a register tape as plain data.
//!
//! A [`Program`] has no closures and no pointers: every back end (the interpreters here, native code, the
//! Taylor recurrences) reads the same instructions. All values live in one file of registers, laid out as
//!
//! ```text
//! constants | parameters | hoisted | variables | temporaries
//! ```
//!
//! The *prologue* runs once per set of parameters and fills the hoisted registers; the *body* runs once per state.
//! Linear systems stay structured: [`Instruction::Factor`] factorizes a matrix into storage of its own, which is
//! not part of the register file, and every [`Instruction::Solve`] reuses it.

use chetaev_symbolic::{Function, Rational};
use std::ops::Range;

/// Index into the register file of a [`Program`].
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub struct Register(pub(crate) u32);

impl Register {
    /// Position in the register file.
    #[inline(always)]
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// Where the value of a constant comes from.
#[derive(Clone, PartialEq, Debug)]
pub enum Exact {
    /// A rational number.
    Rational(Rational),
    /// The constant π.
    Pi,
}

/// A constant of a program.
#[derive(Clone, PartialEq, Debug)]
pub struct Constant {
    /// The exact value.
    pub exact: Exact,
    /// The nearest double.
    pub value: f64,
}

/// An operation on one register.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Unary {
    /// `−a`
    Neg,
    /// `a · a`
    Square,
    /// `√a`
    Sqrt,
    /// A function of one argument; `tan`, `cot`, `sec` and `csc` do not occur, they are lowered to quotients.
    Function(Function),
}

/// An operation on two registers.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Binary {
    /// `a + b`
    Add,
    /// `a − b`
    Sub,
    /// `a · b`
    Mul,
    /// `a / b`
    Div,
    /// `a ^ b`, where b is neither an integer nor a half-integer known in advance
    Pow,
    /// The angle of the point (x, y) = (b, a)
    Atan2,
}

/// A product and a sum in one instruction.
///
/// The interpreters round twice, first the product, then the sum; a back end with a fused multiply-add may round
/// once.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Fused {
    /// `a · b + c`
    MulAdd,
    /// `a · b − c`
    MulSub,
    /// `c − a · b`
    NegMulAdd,
}

/// One instruction. `out`, `sin` and `cos` are written, the other registers are read; a register that is written
/// may be one of those read.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[allow(missing_docs)]
pub enum Instruction {
    /// An operation on one register.
    Unary {
        operation: Unary,
        out: Register,
        a: Register,
    },
    /// An operation on two registers.
    Binary {
        operation: Binary,
        out: Register,
        a: Register,
        b: Register,
    },
    /// A product and a sum.
    Fused {
        operation: Fused,
        out: Register,
        a: Register,
        b: Register,
        c: Register,
    },
    /// Sine and cosine of one angle `a`.
    SinCos {
        sin: Register,
        cos: Register,
        a: Register,
    },
    /// Factorizes the matrix with this index in [`Program::matrices`].
    Factor { matrix: u32 },
    /// Solves the system with this index in [`Program::solves`], whose matrix has been factorized before.
    Solve { solve: u32 },
}

/// How a matrix is factorized.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Factorization {
    /// P A = L U with partial pivoting.
    Lu,
    /// A = L D Lᵀ without pivoting, for a symmetric matrix assumed positive definite; where a pivot shows that it
    /// is not, P A = L U takes over, state by state.
    Ldlt,
}

/// A square matrix that is factorized.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Matrix {
    /// Number of rows and columns.
    pub size: usize,
    /// `size²` registers, row by row.
    pub entries: Vec<Register>,
    /// How it is factorized.
    pub factorization: Factorization,
    /// What the matrix is called in failures; empty if the caller gave no name.
    pub name: String,
}

/// A linear system A x = b.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Solve {
    /// Index of A in [`Program::matrices`].
    pub matrix: u32,
    /// The registers of b.
    pub rhs: Vec<Register>,
    /// The registers that receive x.
    pub out: Vec<Register>,
}

/// A named group of outputs.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct OutputGroup {
    /// The name given by the caller.
    pub name: String,
    /// The registers that hold the values after `end` instructions of the body.
    pub registers: Vec<Register>,
    /// How many instructions of the body have to run before the registers are read.
    pub end: usize,
}

/// How many registers of each kind a program has; they follow each other in this order.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Layout {
    /// Constants, first in the register file.
    pub constants: usize,
    /// Parameters.
    pub parameters: usize,
    /// Values that depend on constants and parameters only, and that the body reads.
    pub hoisted: usize,
    /// Variables.
    pub variables: usize,
    /// Registers reused during the prologue and the body.
    pub temporaries: usize,
}

impl Layout {
    /// Registers of the parameters.
    pub fn parameter_range(&self) -> Range<usize> {
        self.constants..self.constants + self.parameters
    }

    /// Registers filled by the prologue for the body.
    pub fn hoisted_range(&self) -> Range<usize> {
        let start = self.constants + self.parameters;
        start..start + self.hoisted
    }

    /// Registers of the variables.
    pub fn variable_range(&self) -> Range<usize> {
        let start = self.hoisted_range().end;
        start..start + self.variables
    }

    /// Registers reused during a run.
    pub fn temporary_range(&self) -> Range<usize> {
        let start = self.variable_range().end;
        start..start + self.temporaries
    }

    /// Length of the register file.
    pub fn len(&self) -> usize {
        self.temporary_range().end
    }

    /// Whether there is no register at all.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// A flat program: named outputs as functions of variables and parameters.
///
/// Made by [`Lowering`](crate::Lowering). A program built from its parts is checked by
/// [`Program::verify`](crate::Program::verify) before an interpreter accepts it.
#[derive(Clone, PartialEq, Debug)]
pub struct Program {
    /// Names of the variables, in the order of their slots.
    pub variables: Vec<String>,
    /// Names of the parameters, in the order of their slots.
    pub parameters: Vec<String>,
    /// The constants, in the order of their registers.
    pub constants: Vec<Constant>,
    /// Number of registers of each kind.
    pub layout: Layout,
    /// Instructions that run once per set of parameters.
    pub prologue: Vec<Instruction>,
    /// Instructions that run once per state.
    pub body: Vec<Instruction>,
    /// Matrices that are factorized.
    pub matrices: Vec<Matrix>,
    /// Linear systems.
    pub solves: Vec<Solve>,
    /// Groups of outputs in the order given by the caller; `end` does not decrease.
    pub outputs: Vec<OutputGroup>,
}

impl Program {
    /// Number of output values of all groups together.
    pub fn output_count(&self) -> usize {
        self.output_count_of(self.outputs.len())
    }

    /// Number of output values of the first `groups` groups.
    pub fn output_count_of(&self, groups: usize) -> usize {
        self.outputs
            .iter()
            .take(groups)
            .map(|group| group.registers.len())
            .sum()
    }

    /// Index of the group `name` and the range of its values among all outputs.
    pub fn group(&self, name: &str) -> Option<(usize, Range<usize>)> {
        let index = self.outputs.iter().position(|group| group.name == name)?;
        let start = self.output_count_of(index);
        Some((index, start..start + self.outputs[index].registers.len()))
    }

    /// Calls `visit` for every register that `instruction` reads.
    pub fn for_each_read(&self, instruction: Instruction, mut visit: impl FnMut(Register)) {
        match instruction {
            Instruction::Factor { matrix } => {
                let matrix = self.matrices.get(matrix as usize);
                matrix
                    .into_iter()
                    .flat_map(|m| &m.entries)
                    .for_each(|&r| visit(r));
            }
            Instruction::Solve { solve } => {
                let solve = self.solves.get(solve as usize);
                solve
                    .into_iter()
                    .flat_map(|s| &s.rhs)
                    .for_each(|&r| visit(r));
            }
            _ => {
                let _ = instruction.map(
                    |read| {
                        visit(read);
                        read
                    },
                    |written| written,
                );
            }
        }
    }

    /// Calls `visit` for every register that `instruction` writes.
    pub fn for_each_write(&self, instruction: Instruction, mut visit: impl FnMut(Register)) {
        match instruction {
            Instruction::Solve { solve } => {
                let solve = self.solves.get(solve as usize);
                solve
                    .into_iter()
                    .flat_map(|s| &s.out)
                    .for_each(|&r| visit(r));
            }
            _ => {
                let _ = instruction.map(
                    |read| read,
                    |written| {
                        visit(written);
                        written
                    },
                );
            }
        }
    }
}

impl Instruction {
    /// The same instruction on other registers: `read` is applied to those it reads, in order, then `write` to
    /// those it writes. The registers of matrices and systems are not part of the instruction.
    #[must_use]
    pub fn map(
        self,
        mut read: impl FnMut(Register) -> Register,
        mut write: impl FnMut(Register) -> Register,
    ) -> Instruction {
        match self {
            Instruction::Unary { operation, out, a } => {
                let a = read(a);
                let out = write(out);
                Instruction::Unary { operation, out, a }
            }
            Instruction::Binary {
                operation,
                out,
                a,
                b,
            } => {
                let (a, b) = (read(a), read(b));
                let out = write(out);
                Instruction::Binary {
                    operation,
                    out,
                    a,
                    b,
                }
            }
            Instruction::Fused {
                operation,
                out,
                a,
                b,
                c,
            } => {
                let (a, b, c) = (read(a), read(b), read(c));
                let out = write(out);
                Instruction::Fused {
                    operation,
                    out,
                    a,
                    b,
                    c,
                }
            }
            Instruction::SinCos { sin, cos, a } => {
                let a = read(a);
                let (sin, cos) = (write(sin), write(cos));
                Instruction::SinCos { sin, cos, a }
            }
            Instruction::Factor { .. } | Instruction::Solve { .. } => self,
        }
    }
}
