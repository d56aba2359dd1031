//! Builds the tape in single-assignment form: every register is written once, equal instructions are one.
//!
//! Registers are numbered in the order of their creation here; [`allocate`](crate::allocate) assigns places.

use crate::program::{
    Binary, Constant, Exact, Factorization, Fused, Instruction, Matrix, Register, Solve, Unary,
};
use chetaev_symbolic::{rational, Rational};
use std::collections::HashMap;
use std::hash::{BuildHasherDefault, Hasher};

/// A fast hash for small keys of integers; the tables that use it are never iterated.
#[derive(Default)]
struct KeyHasher(u64);

impl Hasher for KeyHasher {
    fn finish(&self) -> u64 {
        self.0.rotate_left(26)
    }
    fn write(&mut self, bytes: &[u8]) {
        bytes.iter().for_each(|&b| self.write_u64(u64::from(b)));
    }
    fn write_u64(&mut self, word: u64) {
        self.0 = (self.0.rotate_left(5) ^ word).wrapping_mul(0xf135_7aea_2e62_a9c5);
    }
    fn write_u32(&mut self, word: u32) {
        self.write_u64(u64::from(word));
    }
    fn write_u8(&mut self, word: u8) {
        self.write_u64(u64::from(word));
    }
    fn write_isize(&mut self, word: isize) {
        self.write_u64(word as u64);
    }
}

/// Stands for the registers written, in the keys of the table of instructions.
const WRITTEN: Register = Register(u32::MAX);

/// What a register of the single-assignment form is.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Origin {
    Constant(u32),
    Parameter(u32),
    Variable(u32),
    /// Computed from constants and parameters only.
    Prologue,
    /// Computed from variables.
    Body,
}

/// The tape under construction.
#[derive(Default)]
pub(crate) struct Emitter {
    pub(crate) origins: Vec<Origin>,
    pub(crate) constants: Vec<Constant>,
    pub(crate) prologue: Vec<Instruction>,
    pub(crate) body: Vec<Instruction>,
    pub(crate) matrices: Vec<Matrix>,
    pub(crate) solves: Vec<Solve>,
    rationals: HashMap<Rational, Register, BuildHasherDefault<KeyHasher>>,
    pi: Option<Register>,
    table: HashMap<Instruction, Register, BuildHasherDefault<KeyHasher>>,
}

impl Emitter {
    pub(crate) fn register(&mut self, origin: Origin) -> Register {
        // Registers stay below 2³² because handles of the graph do, by a wide margin.
        let register = Register(self.origins.len() as u32);
        self.origins.push(origin);
        register
    }

    /// Whether the value depends on constants and parameters only.
    pub(crate) fn is_static(&self, register: Register) -> bool {
        matches!(
            self.origins[register.index()],
            Origin::Constant(_) | Origin::Parameter(_) | Origin::Prologue
        )
    }

    pub(crate) fn number(&mut self, value: &Rational) -> Register {
        if let Some(&register) = self.rationals.get(value) {
            return register;
        }
        let register = self.constant(Constant {
            exact: Exact::Rational(value.clone()),
            value: rational::to_f64(value),
        });
        self.rationals.insert(value.clone(), register);
        register
    }

    pub(crate) fn pi(&mut self) -> Register {
        if let Some(register) = self.pi {
            return register;
        }
        let register = self.constant(Constant {
            exact: Exact::Pi,
            value: std::f64::consts::PI,
        });
        self.pi = Some(register);
        register
    }

    fn constant(&mut self, constant: Constant) -> Register {
        let register = self.register(Origin::Constant(self.constants.len() as u32));
        self.constants.push(constant);
        register
    }

    /// Appends to the prologue if everything read is static, to the body otherwise.
    fn place(&mut self, is_static: bool, instruction: Instruction) {
        if is_static {
            self.prologue.push(instruction);
        } else {
            self.body.push(instruction);
        }
    }

    fn origin(is_static: bool) -> Origin {
        if is_static {
            Origin::Prologue
        } else {
            Origin::Body
        }
    }

    /// The register of an instruction whose `out` is [`WRITTEN`]; emits it unless an equal one exists.
    fn emit(&mut self, key: Instruction) -> Register {
        if let Some(&register) = self.table.get(&key) {
            return register;
        }
        let mut is_static = true;
        let _ = key.map(
            |read| {
                is_static &= self.is_static(read);
                read
            },
            |written| written,
        );
        let out = self.register(Self::origin(is_static));
        self.place(is_static, key.map(|read| read, |_| out));
        self.table.insert(key, out);
        out
    }

    pub(crate) fn unary(&mut self, operation: Unary, a: Register) -> Register {
        self.emit(Instruction::Unary {
            operation,
            out: WRITTEN,
            a,
        })
    }

    pub(crate) fn binary(&mut self, operation: Binary, a: Register, b: Register) -> Register {
        self.emit(binary_key(operation, a, b))
    }

    pub(crate) fn mul(&mut self, a: Register, b: Register) -> Register {
        self.emit(product_key(a, b))
    }

    /// The product if it has been emitted already.
    pub(crate) fn find_product(&self, a: Register, b: Register) -> Option<Register> {
        self.table.get(&product_key(a, b)).copied()
    }

    pub(crate) fn fused(
        &mut self,
        operation: Fused,
        a: Register,
        b: Register,
        c: Register,
    ) -> Register {
        let (a, b) = (a.min(b), a.max(b));
        self.emit(Instruction::Fused {
            operation,
            out: WRITTEN,
            a,
            b,
            c,
        })
    }

    /// Sine and cosine of `a`, both needed.
    pub(crate) fn sin_cos(&mut self, a: Register) -> (Register, Register) {
        let key = Instruction::SinCos {
            sin: WRITTEN,
            cos: WRITTEN,
            a,
        };
        if let Some(&sin) = self.table.get(&key) {
            return (sin, Register(sin.0 + 1));
        }
        let is_static = self.is_static(a);
        let sin = self.register(Self::origin(is_static));
        let cos = self.register(Self::origin(is_static));
        self.place(is_static, Instruction::SinCos { sin, cos, a });
        self.table.insert(key, sin);
        (sin, cos)
    }

    /// Factorizes a matrix; the index is used by [`Emitter::solve`].
    pub(crate) fn factor(
        &mut self,
        entries: Vec<Register>,
        size: usize,
        factorization: Factorization,
        name: String,
    ) -> u32 {
        let is_static = entries.iter().all(|&e| self.is_static(e));
        let matrix = self.matrices.len() as u32;
        self.matrices.push(Matrix {
            size,
            entries,
            factorization,
            name,
        });
        self.place(is_static, Instruction::Factor { matrix });
        matrix
    }

    /// Solves with a factorized matrix; the index is that of the system.
    pub(crate) fn solve(&mut self, matrix: u32, rhs: Vec<Register>) -> u32 {
        let entries = &self.matrices[matrix as usize].entries;
        let is_static = entries.iter().chain(&rhs).all(|&e| self.is_static(e));
        let out = (0..rhs.len())
            .map(|_| self.register(Self::origin(is_static)))
            .collect();
        let solve = self.solves.len() as u32;
        self.solves.push(Solve { matrix, rhs, out });
        self.place(is_static, Instruction::Solve { solve });
        solve
    }
}

fn binary_key(operation: Binary, a: Register, b: Register) -> Instruction {
    let (a, b) = match operation {
        Binary::Add | Binary::Mul => (a.min(b), a.max(b)),
        _ => (a, b),
    };
    Instruction::Binary {
        operation,
        out: WRITTEN,
        a,
        b,
    }
}

fn product_key(a: Register, b: Register) -> Instruction {
    if a == b {
        Instruction::Unary {
            operation: Unary::Square,
            out: WRITTEN,
            a,
        }
    } else {
        binary_key(Binary::Mul, a, b)
    }
}
