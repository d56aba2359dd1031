//! Series of four motions side by side: the machine code of `machine` with four numbers in the place of each.
//!
//! Every motion has the bits that it has alone: its sums are added up in the same parts, and the code for four does the same
//! operations in the same order. Motions do not see each other; one that has no series says so and leaves the others alone.

#![allow(clippy::needless_range_loop)] // As in `machine`.

use super::machine::Recurring;
use super::writer::{Layout, SCALARS};
use super::{Taylor, TaylorWorkspace, ABREAST};
use crate::evaluate::{EvaluateFailure, Evaluator};
use crate::frames::Frames;
use crate::interpret::{check_length, Workspace};
use crate::native::assembler::Width;
use crate::native::code::Code;
use crate::native::copy_factors_of;
use crate::native::machine::{flat, flat_mut, Data, Four, Machine};
use crate::native::polynomials::{are_finite, horner};
use crate::native::products::{STRIDE, ZERO};
use crate::program::Program;

/// What became of each motion.
type Outcomes = [Result<(), EvaluateFailure>; ABREAST];

/// The coefficients of orders 1 to `order` of a series.
fn row(series: &[Four], slot: u32, order: usize) -> &[Four] {
    &series[slot as usize * STRIDE + ZERO + 1..][..order]
}

/// Machine code for four motions.
#[derive(Debug)]
pub(super) struct FourCode {
    zero: Machine,
    orders: Machine,
}

impl FourCode {
    /// From the code of one order and the program of order 0; `None` where it cannot be placed.
    pub(super) fn of(code: Code, zero: &Program, layout: Layout) -> Option<FourCode> {
        let reach = layout.series - STRIDE + ZERO + 2;
        Some(FourCode {
            zero: Machine::of_four(zero)?,
            orders: Machine::of_code(code, Width::Four, ABREAST * layout.file, ABREAST * reach)?,
        })
    }
}

/// Storage for the series of four motions.
#[derive(Clone, Debug)]
pub(super) struct FourRunning {
    /// What a motion alone needs: the prologue, and order 0 where the code for four leaves a doubt.
    alone: Vec<(TaylorWorkspace, Workspace)>,
    /// Registers of order 0: what the prologue of its program gives.
    prologue: Vec<Four>,
    inputs: Vec<Four>,
    values: Vec<Four>,
    file: Vec<Four>,
    series: Vec<Four>,
    frames: [Frames; 2],
    /// Values of order 0 of one motion.
    single: Vec<f64>,
    zero: Vec<f64>,
    /// What became of order 0 at `inputs`, where it is known, and which places have a motion there.
    begun: Option<([bool; ABREAST], Outcomes)>,
    /// By variable but the first: what its series gives at a place, and the slope there.
    ends: Vec<[Four; 2]>,
}

impl Recurring {
    /// Storage for four motions of `taylor`; `None` where there is no code for them.
    pub(super) fn running_four(&self, taylor: &Taylor) -> Option<FourRunning> {
        let four = self.four()?;
        let alone = (taylor.workspace(0), self.zero.workspace());
        let values = self.zero.program().output_count();
        let registers = self.zero.program().layout.len();
        Some(FourRunning {
            alone: vec![alone; ABREAST],
            prologue: vec![Four::default(); registers],
            inputs: vec![Four::default(); self.given.len()],
            values: vec![Four::default(); values],
            file: vec![Four::default(); self.layout.file],
            series: vec![Four::default(); self.layout.series],
            frames: [four.zero.frames(), four.orders.frames()],
            single: vec![0.0; values],
            zero: vec![0.0; self.layout.registers],
            begun: None,
            ends: vec![[Four::default(); 2]; self.registers.len()],
        })
    }

    /// Sets the parameters of motion `lane`.
    pub(super) fn prepare_four(
        &self,
        (taylor, lane): (&Taylor, usize),
        parameters: &[f64],
        running: &mut FourRunning,
    ) -> Result<(), EvaluateFailure> {
        let four = self.four().ok_or(EvaluateFailure::NotPrepared)?;
        running.begun = None;
        let (workspace, zero) = &mut running.alone[lane];
        taylor.prepare(parameters, workspace)?;
        let known = &workspace.state.file[..self.body.start];
        for (four, &value) in running.file.iter_mut().zip(known) {
            four.0[lane] = value;
        }
        self.zero.prepare(parameters, zero)?;
        for (four, &value) in running.prologue.iter_mut().zip(&zero.state.file) {
            four.0[lane] = value;
        }
        copy_factors_of(&four.zero, (&zero.state, 0), &mut running.frames[0], lane);
        Ok(())
    }

    /// Order 0 of all motions, and what depends on it only; which have none.
    fn start_four(
        &self,
        taylor: &Taylor,
        motions: [Option<&[f64]>; ABREAST],
        running: &mut FourRunning,
    ) -> Result<Outcomes, EvaluateFailure> {
        // Places without a motion follow one that there is.
        let Some(first) = motions.iter().flatten().next() else {
            return Ok([Ok(()); ABREAST]);
        };
        let mut is_known = true;
        for (lane, motion) in motions.iter().enumerate() {
            let (inputs, motion) = (&mut running.inputs[..], motion.unwrap_or(first));
            for i in 0..inputs.len().min(motion.len()) {
                is_known &= inputs[i].0[lane].to_bits() == motion[i].to_bits();
                inputs[i].0[lane] = motion[i];
            }
        }
        // The ends of steps are asked for again as the starts of the next.
        let here = motions.map(|motion| motion.is_some());
        let covers = |there: &[bool; ABREAST]| (0..ABREAST).all(|lane| there[lane] | !here[lane]);
        if let Some((there, outcome)) = running.begun.take() {
            if is_known && covers(&there) {
                running.begun = Some((there, outcome));
                return Ok(outcome);
            }
        }
        let outcome = self.begin_four(taylor, motions, running)?;
        running.begun = Some((here, outcome));
        Ok(outcome)
    }

    /// The same at the inputs written.
    fn begin_four(
        &self,
        taylor: &Taylor,
        motions: [Option<&[f64]>; ABREAST],
        running: &mut FourRunning,
    ) -> Result<Outcomes, EvaluateFailure> {
        let four = self.four().ok_or(EvaluateFailure::NotPrepared)?;
        let mut outcome = motions.map(|_| Ok(()));
        let data = Data {
            variables: flat(&running.inputs),
            file: flat(&running.prologue),
            outputs: flat_mut(&mut running.values),
        };
        let frame = running.frames[0].frame(0);
        let doubtful = frame.and_then(|frame| four.zero.run(frame, 1, data));
        let doubtful = doubtful.ok_or(EvaluateFailure::NotPrepared)?;
        for lane in (0..ABREAST).filter(|&lane| doubtful >> lane & 1 != 0) {
            let Some(variables) = motions[lane] else {
                continue;
            };
            let (_, workspace) = &mut running.alone[lane];
            outcome[lane] = self
                .zero
                .evaluate(variables, workspace, &mut running.single);
            for (four, &value) in running.values.iter_mut().zip(&running.single) {
                four.0[lane] = value;
            }
        }
        let (body, inverses) = running.values.split_at(self.body.len());
        running.file[self.given.clone()].copy_from_slice(&running.inputs);
        running.file[self.body.clone()].copy_from_slice(body);
        running.file[self.layout.inverses..][..inverses.len()].copy_from_slice(inverses);
        if !taylor.recurrences.is_seeded() {
            self.seed_four(taylor, running, &mut outcome);
        }
        for (i, derived) in self.derived.iter().enumerate() {
            let value = derived.of(running.file[derived.register() as usize].0);
            running.file[self.layout.derived + i] = Four(value);
        }
        Ok(outcome)
    }

    /// Values of order 0 that no instruction computes, one motion after the other.
    fn seed_four(&self, taylor: &Taylor, running: &mut FourRunning, outcome: &mut Outcomes) {
        for (lane, outcome) in outcome.iter_mut().enumerate() {
            for (one, four) in running.zero.iter_mut().zip(&running.file) {
                *one = four.0[lane];
            }
            let seeded = taylor.recurrences.seed(&mut running.zero);
            *outcome = outcome.and(seeded);
            for (one, four) in running.zero.iter().zip(&mut running.file) {
                four.0[lane] = *one;
            }
        }
    }

    /// The series of motions up to `order`; the first variable is the time, and the outputs are the rates of the others.
    pub(super) fn expand_four(
        &self,
        taylor: &Taylor,
        motions: [Option<&[f64]>; ABREAST],
        order: usize,
        running: &mut FourRunning,
    ) -> Result<Outcomes, EvaluateFailure> {
        self.check(motions)?;
        if order > Recurring::most() {
            return Err(EvaluateFailure::NotPrepared);
        }
        let outcome = self.start_four(taylor, motions, running)?;
        let four = self.four().ok_or(EvaluateFailure::NotPrepared)?;
        let at = |slot: u32, j: usize| slot as usize * STRIDE + ZERO + j;
        running.series[at(self.variables[0], 1)] = Four([1.0; ABREAST]);
        for (&slot, &register) in self.variables[1..].iter().zip(&self.registers) {
            running.series[at(slot, 1)] = running.file[register as usize];
        }
        for j in 1..order {
            let sums = &mut running.file[self.layout.sums..];
            self.products.sum_four(j, &running.series, sums);
            let x = j as f64;
            let scalars: [f64; SCALARS] = [1.0 / x, x, 1.0 / (x + 1.0)];
            for i in 0..SCALARS {
                running.file[self.layout.scalars + i] = Four([scalars[i]; ABREAST]);
            }
            let data = Data {
                variables: &[],
                file: flat(&running.file),
                outputs: flat_mut(&mut running.series[j..]),
            };
            let frame = running.frames[1].frame(0);
            let done = frame.and_then(|frame| four.orders.run(frame, 1, data));
            done.ok_or(EvaluateFailure::NotPrepared)?;
        }
        Ok(outcome)
    }

    fn check(&self, motions: [Option<&[f64]>; ABREAST]) -> Result<(), EvaluateFailure> {
        let count = self.given.len();
        check_length("outputs", count, self.registers.len() + 1)?;
        let mut motions = motions.iter().flatten();
        motions.try_for_each(|motion| check_length("variables", count, motion.len()))
    }

    /// The rates of the variables but the first, of all motions; they are read by [`Recurring::rates_of`].
    pub(super) fn rates_four(
        &self,
        taylor: &Taylor,
        motions: [Option<&[f64]>; ABREAST],
        running: &mut FourRunning,
    ) -> Result<Outcomes, EvaluateFailure> {
        self.check(motions)?;
        self.start_four(taylor, motions, running)
    }

    /// The rates of motion `lane` after [`Recurring::rates_four`].
    pub(super) fn rates_of(&self, lane: usize, running: &FourRunning, rates: &mut [f64]) {
        for k in 0..rates.len().min(self.registers.len()) {
            rates[k] = running.file[self.registers[k] as usize].0[lane % ABREAST];
        }
    }

    /// Which motions have finite coefficients up to `order`.
    pub(super) fn finite_four(&self, order: usize, running: &FourRunning) -> [bool; ABREAST] {
        let rows = self.variables[1..].iter();
        are_finite(rows.map(|&slot| row(&running.series, slot, order)))
    }

    /// Sums the series at h of each motion.
    pub(super) fn sum_four(&self, order: usize, h: [f64; ABREAST], running: &mut FourRunning) {
        let FourRunning { series, ends, .. } = running;
        let own = &self.variables[1..];
        let rows = (own.len(), |k: usize| row(series, own[k], order));
        horner(rows, Four(h), |k, sum, slope| ends[k] = [sum, slope]);
    }

    /// What [`Recurring::sum_four`] found for motion `lane`: sums without order 0, and slopes.
    pub(super) fn ends_of(
        &self,
        lane: usize,
        running: &FourRunning,
        (sums, slopes): (&mut [f64], &mut [f64]),
    ) {
        let lane = lane % ABREAST;
        for k in 0..sums.len().min(slopes.len()).min(running.ends.len()) {
            let [sum, slope] = &running.ends[k];
            (sums[k], slopes[k]) = (sum.0[lane], slope.0[lane]);
        }
    }

    /// Writes the coefficients of one order of the variables but the first of motion `lane`.
    pub(super) fn order_of(&self, lane: usize, j: usize, running: &FourRunning, to: &mut [f64]) {
        let own = &self.variables[1..];
        for k in 0..to.len().min(own.len()) {
            to[k] = running.series[own[k] as usize * STRIDE + ZERO + j].0[lane % ABREAST];
        }
    }

    /// Writes the orders 1 to `order` of the variables but the first of motion `lane`, one order after the other, behind those
    /// of order 0.
    pub(super) fn coefficients_of(
        &self,
        lane: usize,
        order: usize,
        running: &FourRunning,
        coefficients: &mut [f64],
    ) {
        let (m, lane) = (self.registers.len(), lane % ABREAST);
        for (k, &slot) in self.variables[1..].iter().enumerate() {
            let from = slot as usize * STRIDE + ZERO + 1;
            let series = &running.series[from..from + order];
            let column = coefficients[m..].iter_mut().skip(k).step_by(m);
            for (to, coefficient) in column.zip(series) {
                *to = coefficient.0[lane];
            }
        }
    }
}
