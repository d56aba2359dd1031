//! Programs as the interpreters read them: runs of one operation, and the registers of each instruction.

use crate::program::{Binary, Fused, Instruction, Program, Register, Unary};
use chetaev_symbolic::Function;

/// What the instructions of a run do.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Operation {
    Add,
    Sub,
    Mul,
    Div,
    MulAdd,
    MulSub,
    NegMulAdd,
    Neg,
    Square,
    Sqrt,
    Pow,
    Atan2,
    SinCos,
    Function(Function),
    Factor,
    Solve,
}

/// The register written, and up to three that are read; the fourth is the second one written by
/// [`Operation::SinCos`].
pub(crate) type Operands = [u32; 4];

/// Instructions with the same operation, one after the other.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Run {
    pub(crate) operation: Operation,
    /// First of the operands; of a factorization or a solution, its index in the program.
    pub(crate) start: usize,
    /// End of the operands.
    pub(crate) end: usize,
}

/// A program and its runs.
#[derive(Clone, Debug)]
pub(crate) struct Code {
    pub(crate) program: Program,
    pub(crate) operands: Vec<Operands>,
    pub(crate) prologue: Vec<Run>,
    /// By group of outputs: what runs before it.
    pub(crate) groups: Vec<Vec<Run>>,
}

impl Code {
    /// The runs of a well formed program.
    pub(crate) fn of(program: Program) -> Code {
        let mut operands = Vec::with_capacity(program.prologue.len() + program.body.len());
        let prologue = runs(&program.prologue, &mut operands);
        let mut done = 0;
        let mut groups = Vec::with_capacity(program.outputs.len());
        for group in &program.outputs {
            groups.push(runs(&program.body[done..group.end], &mut operands));
            done = group.end;
        }
        Code {
            program,
            operands,
            prologue,
            groups,
        }
    }
}

fn runs(code: &[Instruction], operands: &mut Vec<Operands>) -> Vec<Run> {
    let mut runs: Vec<Run> = Vec::new();
    for &instruction in code {
        let (operation, registers) = match decode(instruction) {
            Decoded::Scalar(operation, registers) => (operation, registers),
            Decoded::System(operation, index) => {
                let start = index as usize;
                runs.push(Run {
                    operation,
                    start,
                    end: start,
                });
                continue;
            }
        };
        operands.push(registers);
        match runs.last_mut() {
            Some(run) if run.operation == operation => run.end = operands.len(),
            _ => runs.push(Run {
                operation,
                start: operands.len() - 1,
                end: operands.len(),
            }),
        }
    }
    runs
}

enum Decoded {
    Scalar(Operation, Operands),
    /// The index of a matrix or a system.
    System(Operation, u32),
}

fn decode(instruction: Instruction) -> Decoded {
    let scalar = |operation, registers: [Register; 4]| {
        Decoded::Scalar(operation, registers.map(|register| register.0))
    };
    match instruction {
        Instruction::Unary { operation, out, a } => {
            let operation = match operation {
                Unary::Neg => Operation::Neg,
                Unary::Square => Operation::Square,
                Unary::Sqrt => Operation::Sqrt,
                Unary::Function(function) => Operation::Function(function),
            };
            scalar(operation, [out, a, a, a])
        }
        Instruction::Binary {
            operation,
            out,
            a,
            b,
        } => {
            let operation = match operation {
                Binary::Add => Operation::Add,
                Binary::Sub => Operation::Sub,
                Binary::Mul => Operation::Mul,
                Binary::Div => Operation::Div,
                Binary::Pow => Operation::Pow,
                Binary::Atan2 => Operation::Atan2,
            };
            scalar(operation, [out, a, b, b])
        }
        Instruction::Fused {
            operation,
            out,
            a,
            b,
            c,
        } => {
            let operation = match operation {
                Fused::MulAdd => Operation::MulAdd,
                Fused::MulSub => Operation::MulSub,
                Fused::NegMulAdd => Operation::NegMulAdd,
            };
            scalar(operation, [out, a, b, c])
        }
        Instruction::SinCos { sin, cos, a } => scalar(Operation::SinCos, [sin, a, a, cos]),
        Instruction::Factor { matrix } => Decoded::System(Operation::Factor, matrix),
        Instruction::Solve { solve } => Decoded::System(Operation::Solve, solve),
    }
}
