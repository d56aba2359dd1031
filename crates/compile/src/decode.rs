//! Instructions as the interpreters read them: one flat enumeration, so that each costs one indirect jump.

use crate::program::{Binary, Fused, Instruction, Unary};
use chetaev_symbolic::Function;

/// `out`, then the registers read.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Step {
    Add(u32, u32, u32),
    Sub(u32, u32, u32),
    Mul(u32, u32, u32),
    Div(u32, u32, u32),
    MulAdd(u32, u32, u32, u32),
    MulSub(u32, u32, u32, u32),
    NegMulAdd(u32, u32, u32, u32),
    Neg(u32, u32),
    Square(u32, u32),
    Sqrt(u32, u32),
    Pow(u32, u32, u32),
    Atan2(u32, u32, u32),
    /// Sine, cosine, angle.
    SinCos(u32, u32, u32),
    Sin(u32, u32),
    Cos(u32, u32),
    Function(Function, u32, u32),
    Factor(u32),
    Solve(u32),
}

pub(crate) fn decode(code: &[Instruction]) -> Vec<Step> {
    code.iter().map(|&instruction| step(instruction)).collect()
}

fn step(instruction: Instruction) -> Step {
    match instruction {
        Instruction::Unary { operation, out, a } => {
            let (out, a) = (out.0, a.0);
            match operation {
                Unary::Neg => Step::Neg(out, a),
                Unary::Square => Step::Square(out, a),
                Unary::Sqrt => Step::Sqrt(out, a),
                Unary::Function(Function::Sin) => Step::Sin(out, a),
                Unary::Function(Function::Cos) => Step::Cos(out, a),
                Unary::Function(function) => Step::Function(function, out, a),
            }
        }
        Instruction::Binary {
            operation,
            out,
            a,
            b,
        } => {
            let (out, a, b) = (out.0, a.0, b.0);
            match operation {
                Binary::Add => Step::Add(out, a, b),
                Binary::Sub => Step::Sub(out, a, b),
                Binary::Mul => Step::Mul(out, a, b),
                Binary::Div => Step::Div(out, a, b),
                Binary::Pow => Step::Pow(out, a, b),
                Binary::Atan2 => Step::Atan2(out, a, b),
            }
        }
        Instruction::Fused {
            operation,
            out,
            a,
            b,
            c,
        } => {
            let (out, a, b, c) = (out.0, a.0, b.0, c.0);
            match operation {
                Fused::MulAdd => Step::MulAdd(out, a, b, c),
                Fused::MulSub => Step::MulSub(out, a, b, c),
                Fused::NegMulAdd => Step::NegMulAdd(out, a, b, c),
            }
        }
        Instruction::SinCos { sin, cos, a } => Step::SinCos(sin.0, cos.0, a.0),
        Instruction::Factor { matrix } => Step::Factor(matrix),
        Instruction::Solve { solve } => Step::Solve(solve),
    }
}
