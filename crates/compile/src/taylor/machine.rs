//! The recurrences as machine code.
//!
//! A coefficient of order j is linear in the others of that order: w = x y has w_j = x_0 y_j + x_j y_0 + Σ_{i=1..j−1} x_i
//! y_{j−i}. The sums contain no coefficient of order j, so all of them are computed first, side by side ([`Products`]);
//! the rest is one piece of straight-line code, the same for every order, whose values are at most a few additions away
//! from each other. Divisors, and the inverses of the matrices, are those of order 0: reciprocals once per expansion.
//!
//! Series are stored one after the other, [`STRIDE`] numbers each, and the code is called with the address of order j of
//! the first one.
//!
//! Loops run over indices, since what is done at every order has to be inlined. With states side by side everything stays but the address of a number.

#![allow(clippy::needless_range_loop)]

use super::abreast::FourCode;
pub(super) use super::abreast::FourRunning;
use super::build::{Plan, Recurrences};
use super::writer::{self, inverses, Derived, Layout, Written, SCALARS};
use super::zero::{self, Zero};
use crate::evaluate::{EvaluateFailure, Evaluator};
use crate::frames::Frames;
use crate::interpret::Workspace;
use crate::native::assembler::Width;
use crate::native::machine::{Data, Machine};
use crate::native::products::{Products, MOST, STRIDE, ZERO};
use crate::native::{Native, Vectors};
use crate::schedule::Single;
use std::ops::Range;
use std::sync::{Arc, OnceLock};

/// Systems up to this size are solved by the inverse of their matrix.
const LARGEST: usize = 24;

/// The recurrences of a program as machine code.
#[derive(Clone, Debug)]
pub(super) struct Recurring {
    /// Order 0.
    pub(super) zero: Arc<Native>,
    /// The registers that order 0 writes, after those of constants, parameters and variables and of the prologue.
    pub(super) body: Range<usize>,
    machine: Arc<Machine>,
    pub(super) products: Products,
    pub(super) derived: Vec<Derived>,
    pub(super) layout: Layout,
    /// Registers of the variables.
    pub(super) given: Range<usize>,
    /// By variable and by output: the number of the series.
    pub(super) variables: Vec<u32>,
    outputs: Vec<u32>,
    /// By output: its register.
    pub(super) registers: Vec<u32>,
    /// The program, of which the code for four motions side by side is made when first asked for.
    source: Arc<Single>,
    four: Arc<OnceLock<Option<FourCode>>>,
}

/// Storage for one expansion at a time.
#[derive(Clone, Debug)]
pub(super) struct Running {
    file: Vec<f64>,
    series: Vec<f64>,
    frames: Frames,
    /// Of order 0.
    workspace: Workspace,
    /// What order 0 gives: registers, then inverses.
    values: Vec<f64>,
    /// The variables of order 0, where it is known.
    at: Vec<f64>,
    is_known: bool,
    /// Whether a series may contain what the next expansion must not find: what is not finite, or coefficients of a variable
    /// that is no motion.
    is_stained: bool,
}

impl Recurring {
    /// Machine code of a program in single-assignment form with outputs in the registers given; `None` where there is none.
    pub(super) fn of(single: &Single, outputs: &[u32]) -> Option<Recurring> {
        let plan = &Plan::of(single);
        if plan.systems.iter().any(|system| system.rhs.len() > LARGEST) {
            return None;
        }
        let variables = zero::variables(single);
        let Zero { program, body } = zero::program(single, &inverses(plan));
        let Written {
            code,
            products,
            derived,
            slots,
            layout,
        } = writer::write(plan, &variables, outputs, Width::One);
        if products.len() > layout.scalars - layout.sums {
            return None;
        }
        let reach = layout.series - STRIDE + ZERO + 2;
        let machine = Machine::of_code(code, Width::One, layout.file, reach)?;
        Some(Recurring {
            zero: Arc::new(Native::of_verified(&program, Vectors::Avx2)?),
            body,
            machine: Arc::new(machine),
            products,
            derived,
            layout,
            given: variables.clone(),
            variables: variables.map(|r| slots.plain[r]).collect(),
            outputs: outputs.iter().map(|&r| slots.plain[r as usize]).collect(),
            registers: outputs.to_vec(),
            source: Arc::new(single.clone()),
            four: Arc::default(),
        })
    }

    /// The code for four motions side by side; `None` where it cannot be made.
    pub(super) fn four(&self) -> Option<&FourCode> {
        let make = || {
            let plan = &Plan::of(&self.source);
            let code = writer::write(plan, &self.given, &self.registers, Width::Four).code;
            FourCode::of(code, self.zero.program(), self.layout)
        };
        self.four.get_or_init(make).as_ref()
    }

    /// Whether this is a copy of the other, or the other of this.
    pub(super) fn is_same(&self, other: &Recurring) -> bool {
        Arc::ptr_eq(&self.machine, &other.machine)
    }

    /// The highest order that has room.
    pub(super) fn most() -> usize {
        MOST
    }

    /// Bytes of machine code.
    pub(super) fn bytes(&self) -> usize {
        self.machine.bytes()
    }

    pub(super) fn running(&self) -> Running {
        Running {
            file: vec![0.0; self.layout.file],
            series: vec![0.0; self.layout.series],
            frames: self.machine.frames(),
            workspace: self.zero.workspace(),
            values: vec![0.0; self.zero.program().output_count()],
            at: vec![0.0; self.given.len()],
            is_known: false,
            is_stained: false,
        }
    }

    /// Sets the parameters; `registers` are those of constants, parameters and prologue.
    pub(super) fn prepare(
        &self,
        parameters: &[f64],
        registers: &[f64],
        running: &mut Running,
    ) -> Result<(), EvaluateFailure> {
        running.is_known = false;
        running.file[..self.body.start].copy_from_slice(&registers[..self.body.start]);
        self.zero.prepare(parameters, &mut running.workspace)
    }

    /// Order 0, and what depends on it only.
    pub(super) fn start(
        &self,
        recurrences: &Recurrences,
        variables: &[f64],
        running: &mut Running,
    ) -> Result<(), EvaluateFailure> {
        let Running {
            file,
            series,
            workspace,
            values,
            at,
            is_known,
            is_stained,
            ..
        } = running;
        if *is_stained {
            series.fill(0.0);
            *is_stained = false;
        }
        // The end of a step is asked for again as the start of the next.
        if *is_known && is_same(variables, at) {
            return Ok(());
        }
        *is_known = false;
        self.zero.evaluate(variables, workspace, values)?;
        let (zero, rest) = file.split_at_mut(self.layout.registers);
        let (body, inverses) = values.split_at(self.body.len());
        zero[self.given.clone()].copy_from_slice(variables);
        zero[self.body.clone()].copy_from_slice(body);
        rest[self.layout.inverses - self.layout.registers..].copy_from_slice(inverses);
        recurrences.seed(zero)?;
        let derived = &mut rest[self.layout.derived - self.layout.registers..];
        for (to, derived) in derived.iter_mut().zip(&self.derived) {
            [*to] = derived.of([zero[derived.register() as usize]]);
        }
        at.copy_from_slice(variables);
        *is_known = true;
        Ok(())
    }

    /// Order 0 of an output.
    pub(super) fn first(&self, index: usize, running: &Running) -> f64 {
        running.file[self.registers[index] as usize]
    }

    /// Order j of everything, from that of the variables.
    pub(super) fn advance(
        &self,
        j: usize,
        variables: &[f64],
        running: &mut Running,
    ) -> Result<(), EvaluateFailure> {
        running.is_stained = true;
        for (&slot, &value) in self.variables.iter().zip(variables) {
            running.series[slot as usize * STRIDE + ZERO + j] = value;
        }
        self.run(j, running)
    }

    fn run(&self, j: usize, running: &mut Running) -> Result<(), EvaluateFailure> {
        let Running {
            file,
            series,
            frames,
            ..
        } = running;
        self.products.sum(j, series, &mut file[self.layout.sums..]);
        let order = j as f64;
        // As an array: to copy so few numbers would be a call.
        if let Some(to) = file[self.layout.scalars..].first_chunk_mut::<SCALARS>() {
            *to = [1.0 / order, order, 1.0 / (order + 1.0)];
        }
        let data = Data {
            variables: &[],
            file,
            outputs: &mut series[j..],
        };
        let frame = frames.frame(0);
        let failed = frame.and_then(|frame| self.machine.run(frame, 1, data));
        match failed {
            Some(_) => Ok(()),
            None => Err(EvaluateFailure::NotPrepared),
        }
    }

    /// Order j ≥ 1 of an output.
    #[inline]
    pub(super) fn output(&self, index: usize, j: usize, running: &Running) -> f64 {
        running.series[self.outputs[index] as usize * STRIDE + ZERO + j]
    }

    /// Writes the orders 0 to `order` of all variables but the first, which is the time and whose rate is 1; the outputs are
    /// the rates of the others.
    pub(super) fn expand(
        &self,
        variables: &[f64],
        order: usize,
        running: &mut Running,
        coefficients: &mut [f64],
    ) -> Result<(), EvaluateFailure> {
        let own = &self.variables[1..];
        let at = |slot: u32, j: usize| slot as usize * STRIDE + ZERO + j;
        running.series[at(self.variables[0], 1)] = 1.0;
        for (&slot, &register) in own.iter().zip(&self.registers) {
            running.series[at(slot, 1)] = running.file[register as usize];
        }
        for j in 1..order {
            self.run(j, running)?;
        }
        let m = own.len();
        coefficients[..m].copy_from_slice(&variables[1..]);
        let row = |slot: u32| &running.series[at(slot, 1)..][..order];
        let (fours, rest) = own.as_chunks::<4>();
        for (i, &slots) in fours.iter().enumerate() {
            columns(slots.map(row), &mut coefficients[m..], (m, 4 * i));
        }
        for (i, &slot) in rest.iter().enumerate() {
            columns(
                [row(slot)],
                &mut coefficients[m..],
                (m, 4 * fours.len() + i),
            );
        }
        // Zero where all are finite: what is not spreads to all values that are computed of it. Side by side, so that no
        // addition waits for the one before.
        let (blocks, rest) = coefficients.as_chunks::<8>();
        let mut traces = [0.0; 8];
        for block in blocks {
            for i in 0..8 {
                traces[i] += 0.0 * block[i];
            }
        }
        let mut trace = 0.0;
        for x in traces.iter().chain(rest) {
            trace += 0.0 * x;
        }
        running.is_stained = trace != 0.0;
        Ok(())
    }
}

/// Writes series of one length as columns from the first one given on, into a matrix with so many of them.
#[inline]
fn columns<const N: usize>(
    series: [&[f64]; N],
    matrix: &mut [f64],
    (count, first): (usize, usize),
) {
    for (j, row) in matrix.chunks_exact_mut(count).enumerate() {
        let to = &mut row[first..first + N];
        for i in 0..N {
            to[i] = series[i][j];
        }
    }
}

/// Whether the bits are the same, of slices of one length.
fn is_same(a: &[f64], b: &[f64]) -> bool {
    let n = a.len().min(b.len());
    (0..n).all(|i| a[i].to_bits() == b[i].to_bits())
}
