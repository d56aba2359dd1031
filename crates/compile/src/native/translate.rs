//! From the body of a program to straight-line code.

use super::assembler::{Float, Width};
use super::call::Helper;
use super::code::{Base, Builder, Code, Op, Value};
use super::dense;
use super::kernels;
use super::linear::{self, Factored};
use crate::frames::Pivots;
use crate::lanes::LANES;
use crate::program::{Binary, Fused, Instruction, OutputGroup, Program, Register, Solve, Unary};
use chetaev_symbolic::Function;
use std::collections::HashMap;

/// The code of a program's body, and where it keeps what others have to find.
#[derive(Debug)]
pub(crate) struct Translated {
    pub(crate) code: Code,
    /// By matrix: where its pivots are; `None` for those of the prologue.
    pub(crate) pivots: Vec<Option<Pivots>>,
    /// Matrices that the prologue factorizes and the body solves with: index, and the cells for the factors.
    pub(crate) copied: Vec<(usize, i32)>,
}

/// Translates the body for one state, or for states side by side,
/// whose numbers are `stride` bytes apart.
pub(crate) fn translate(program: &Program, width: Width, stride: i32) -> Translated {
    let mut translator = Translator {
        program,
        stride,
        builder: Builder::new(width),
        now: vec![None; program.layout.len()],
        factored: vec![None; program.matrices.len()],
        pivots: vec![None; program.matrices.len()],
        copied: Vec::new(),
    };
    let mut done = 0;
    let mut slot = 0;
    for group in &program.outputs {
        translator.group(done, group, slot);
        done = group.end;
        slot += group.registers.len();
    }
    Translated {
        code: translator.builder.finish(),
        pivots: translator.pivots,
        copied: translator.copied,
    }
}

/// Bytes from one number of a state to the next, in blocks of all lanes where there are several.
pub(crate) fn stride(width: Width) -> i32 {
    match width {
        Width::One => 8,
        Width::Four | Width::Eight => 8 * LANES as i32,
    }
}

struct Translator<'p> {
    program: &'p Program,
    stride: i32,
    builder: Builder,
    /// By register: its present value.
    now: Vec<Option<Value>>,
    /// By matrix.
    factored: Vec<Option<Factored>>,
    pivots: Vec<Option<Pivots>>,
    copied: Vec<(usize, i32)>,
}

/// By register: the instruction that writes it last within a group.
type Writers = HashMap<Register, usize>;
/// By instruction: the outputs that are ready after it.
type Ready = HashMap<usize, Vec<(Register, usize)>>;

impl Translator<'_> {
    /// The instructions of a group; every output is written as soon as it is known.
    fn group(&mut self, start: usize, group: &OutputGroup, first_slot: usize) {
        let (ready, known) = self.outputs(start, group, first_slot);
        for (register, slot) in known {
            self.output(register, slot);
        }
        let program = self.program;
        for (at, &instruction) in program.body.iter().enumerate().take(group.end).skip(start) {
            self.instruction(instruction);
            for &(register, slot) in ready.get(&at).into_iter().flatten() {
                self.output(register, slot);
            }
        }
        self.builder.push(Op::End);
    }

    /// The outputs of a group by the instruction that makes them ready, and those that are ready before.
    fn outputs(
        &self,
        start: usize,
        group: &OutputGroup,
        first_slot: usize,
    ) -> (Ready, Vec<(Register, usize)>) {
        let mut writers = Writers::new();
        for at in start..group.end {
            let instruction = self.program.body[at];
            self.program
                .for_each_write(instruction, |r| _ = writers.insert(r, at));
        }
        let mut ready = Ready::new();
        let mut known = Vec::new();
        for (i, &register) in group.registers.iter().enumerate() {
            let output = (register, first_slot + i);
            match writers.get(&register) {
                Some(&at) => ready.entry(at).or_default().push(output),
                None => known.push(output),
            }
        }
        (ready, known)
    }

    fn output(&mut self, register: Register, slot: usize) {
        let value = self.read(register);
        let offset = slot as i32 * self.stride;
        let to = super::code::Place {
            base: Base::Outputs,
            offset,
        };
        self.builder.store(value, to);
    }

    /// The present value of a register.
    fn read(&mut self, register: Register) -> Value {
        let index = register.index();
        if let Some(value) = self.now[index] {
            return value;
        }
        let layout = &self.program.layout;
        let variables = layout.variable_range();
        let stride = self.stride;
        let value = match self.program.constants.get(index) {
            Some(constant) => self.builder.constant(constant.value),
            None if variables.contains(&index) => {
                let offset = (index - variables.start) as i32 * stride;
                self.builder.at(Base::Variables, offset)
            }
            None => self.builder.at(Base::File, index as i32 * stride),
        };
        self.now[index] = Some(value);
        value
    }

    fn write(&mut self, register: Register, value: Value) {
        self.now[register.index()] = Some(value);
    }

    fn instruction(&mut self, instruction: Instruction) {
        match instruction {
            Instruction::Unary { operation, out, a } => {
                let a = self.read(a);
                let value = unary(&mut self.builder, operation, a);
                self.write(out, value);
            }
            Instruction::Binary {
                operation,
                out,
                a,
                b,
            } => {
                let (a, b) = (self.read(a), self.read(b));
                let value = binary(&mut self.builder, operation, a, b);
                self.write(out, value);
            }
            Instruction::Fused {
                operation,
                out,
                a,
                b,
                c,
            } => {
                let (a, b, c) = (self.read(a), self.read(b), self.read(c));
                let builder = &mut self.builder;
                let value = match operation {
                    Fused::MulAdd => builder.mul_add(a, b, c),
                    Fused::MulSub => builder.mul_sub(a, b, c),
                    Fused::NegMulAdd => builder.neg_mul_add(a, b, c),
                };
                self.write(out, value);
            }
            Instruction::SinCos { sin, cos, a } => {
                let a = self.read(a);
                let values = self.builder.sin_cos(a);
                self.write(sin, values.0);
                self.write(cos, values.1);
            }
            Instruction::Factor { matrix } => self.factor(matrix as usize),
            Instruction::Solve { solve } => {
                let program = self.program;
                self.solve(&program.solves[solve as usize]);
            }
        }
    }

    fn factor(&mut self, index: usize) {
        let matrix = &self.program.matrices[index];
        let entries: Vec<Value> = matrix.entries.iter().map(|&r| self.read(r)).collect();
        let (factored, pivots) = linear::factor(&mut self.builder, matrix, &entries);
        self.factored[index] = Some(factored);
        self.pivots[index] = Some(pivots);
    }

    fn solve(&mut self, solve: &Solve) {
        let rhs: Vec<Value> = solve.rhs.iter().map(|&r| self.read(r)).collect();
        let index = solve.matrix as usize;
        let factored = match self.factored[index].take() {
            Some(factored) => factored,
            None => self.factored_before(index),
        };
        let x = linear::solve(&mut self.builder, &factored, &rhs);
        self.factored[index] = Some(factored);
        for (&out, x) in solve.out.iter().zip(x) {
            self.write(out, x);
        }
    }

    /// A matrix of the prologue, whose factors are copied into the frame.
    fn factored_before(&mut self, index: usize) -> Factored {
        let size = self.program.matrices[index].size;
        let cells = self.builder.cells(dense::cells(size));
        self.copied.push((index, cells));
        Factored::Called { size, cells }
    }
}

fn unary(b: &mut Builder, operation: Unary, a: Value) -> Value {
    match operation {
        Unary::Neg => b.neg(a),
        Unary::Square => b.mul(a, a),
        Unary::Sqrt => b.sqrt(a),
        Unary::Function(Function::Sin) => b.sin_cos(a).0,
        Unary::Function(Function::Cos) => b.sin_cos(a).1,
        Unary::Function(Function::Exp) => kernels::exp(b, a),
        Unary::Function(Function::Log) => kernels::log(b, a),
        Unary::Function(Function::Abs) => b.abs(a),
        Unary::Function(Function::Sign) => kernels::sign(b, a),
        Unary::Function(function) => b.call(Helper::Function(function), &[a], 1)[0],
    }
}

fn binary(b: &mut Builder, operation: Binary, x: Value, y: Value) -> Value {
    match operation {
        Binary::Add => b.add(x, y),
        Binary::Sub => b.sub(x, y),
        Binary::Mul => b.mul(x, y),
        Binary::Div => b.float(Float::Div, x, y),
        Binary::Pow => b.call(Helper::Pow, &[x, y], 1)[0],
        Binary::Atan2 => b.call(Helper::Atan2, &[x, y], 1)[0],
    }
}
