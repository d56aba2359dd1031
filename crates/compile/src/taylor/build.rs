//! From instructions to recurrences: what varies, what is stored, and the order of work.

use super::functions::{Auxiliary, Condition, Demand};
use super::recurrence::{Keep, Kind, Order, Recurrence, KINDS};
use super::solve::Linear;
use super::Series;
use crate::emit::Origin;
use crate::evaluate::EvaluateFailure;
use crate::program::{Binary, Fused, Instruction, Register, Unary};
use crate::scalar::Scalar;
use crate::schedule::Single;
use std::collections::VecDeque;

/// The recurrences of a program, in runs of one kind.
#[derive(Clone, Debug, Default)]
pub(super) struct Recurrences {
    /// How many series are stored.
    pub(super) slots: usize,
    /// By register: whether the value depends on constants and parameters only.
    pub(super) is_constant: Vec<bool>,
    auxiliaries: Vec<(u32, Auxiliary, u32, u32)>,
    conditions: Vec<Condition>,
    /// Values whose series are stored.
    kept: Vec<(u32, Keep)>,
    /// Those of them that are variables, which no recurrence stores.
    inputs: Vec<(u32, Keep)>,
    list: Vec<Recurrence>,
    /// Kind, and the recurrences of a run; of a system, its number.
    runs: Vec<(Kind, usize, usize)>,
    systems: Vec<Linear>,
}

impl Recurrences {
    /// The recurrences of a program in single-assignment form, and how many registers there are.
    pub(super) fn of(single: &Single) -> (Recurrences, usize) {
        Builder::filled(single).finish()
    }

    /// Whether no value of order 0 is computed by other means than instructions, and no series may fail to exist.
    #[cfg_attr(not(all(unix, target_arch = "x86_64")), allow(dead_code))]
    pub(super) fn is_seeded(&self) -> bool {
        self.auxiliaries.is_empty() && self.conditions.is_empty()
    }

    /// Values of order 0 that no instruction computes, and whether all series exist.
    pub(super) fn seed<S: Scalar>(&self, zero: &mut [S]) -> Result<(), EvaluateFailure> {
        for &(out, auxiliary, a, b) in &self.auxiliaries {
            zero[out as usize] = auxiliary.value(zero[a as usize], zero[b as usize]);
        }
        let mut conditions = self.conditions.iter();
        conditions
            .try_for_each(|condition| condition.check(zero[condition.register as usize].rounded()))
    }

    /// Stores order 0 of all series.
    pub(super) fn keep_all<S: Scalar>(&self, zero: &[S], series: &mut Series<S>) {
        for &(register, keep) in &self.kept {
            keep.store(series, 0, zero[register as usize]);
        }
    }

    /// The next order, from that of the variables; `solve` takes the number of a matrix factorized at order 0, a right-hand side
    /// and the place of the solution.
    pub(super) fn advance<S: Scalar>(
        &self,
        mut order: Order<'_, S>,
        solve: &impl Fn(usize, &[S], &mut [S]),
        scratch: &mut [S],
    ) {
        for &(register, keep) in &self.inputs {
            let value = order.now[register as usize];
            keep.store(order.series, order.j, value);
        }
        for &(kind, start, end) in &self.runs {
            if kind == Kind::Solve {
                self.systems[start].run(&mut order, solve, scratch);
            } else {
                order.run(kind, &self.list[start..end]);
            }
        }
    }

    /// Numbers of recurrences with and without dot products.
    pub(super) fn counts(&self) -> (usize, usize) {
        let mut counts = (0, 0);
        for &(kind, start, end) in &self.runs {
            match kind {
                Kind::Solve => counts.0 += self.systems[start].entries.len(),
                kind if kind.is_linear() => counts.1 += end - start,
                _ => counts.0 += end - start,
            }
        }
        counts
    }
}

/// A recurrence before its place in the order of work is known.
pub(super) struct Planned {
    pub(super) kind: Kind,
    pub(super) recurrence: Recurrence,
    /// Values of the same order that it reads.
    reads: Vec<u32>,
}

/// The recurrences in the order of the program: each comes after those of the same order that it reads.
#[cfg_attr(not(all(unix, target_arch = "x86_64")), allow(dead_code))]
pub(super) struct Plan {
    /// How many registers there are.
    pub(super) registers: usize,
    /// By register.
    pub(super) keep: Vec<Keep>,
    /// By slot: the register whose series is stored there.
    pub(super) owners: Vec<u32>,
    pub(super) planned: Vec<Planned>,
    pub(super) systems: Vec<Linear>,
}

impl Plan {
    /// The plan of a program in single-assignment form.
    #[cfg_attr(not(all(unix, target_arch = "x86_64")), allow(dead_code))]
    pub(super) fn of(single: &Single) -> Plan {
        let mut builder = Builder::filled(single);
        builder.settle();
        let mut owners = vec![builder.zero; builder.slots as usize];
        for (register, keep) in builder.keep.iter().enumerate() {
            for slot in [keep.forward, keep.reverse, keep.weighted] {
                if slot > 0 {
                    owners[slot as usize] = register as u32;
                }
            }
        }
        Plan {
            registers: builder.is_constant.len(),
            keep: builder.keep,
            owners,
            planned: builder.planned,
            systems: builder.systems,
        }
    }
}

/// The recurrences under construction.
pub(super) struct Builder<'s> {
    single: &'s Single,
    /// Reads as 0 at every order above 0.
    pub(super) zero: u32,
    is_constant: Vec<bool>,
    keep: Vec<Keep>,
    slots: u32,
    auxiliaries: Vec<(u32, Auxiliary, u32, u32)>,
    conditions: Vec<Condition>,
    planned: Vec<Planned>,
    systems: Vec<Linear>,
}

impl<'s> Builder<'s> {
    fn new(single: &'s Single) -> Builder<'s> {
        let moves = |origin: &Origin| matches!(origin, Origin::Variable(_) | Origin::Body);
        let mut is_constant: Vec<bool> = single.origins.iter().map(|o| !moves(o)).collect();
        let zero = is_constant.len() as u32;
        // Its value at order 0 is 0 too, since nothing writes it.
        is_constant.push(false);
        Builder {
            single,
            zero,
            keep: vec![Keep::default(); is_constant.len()],
            is_constant,
            // Slot 0 takes what nobody reads.
            slots: 1,
            auxiliaries: Vec::new(),
            conditions: Vec::new(),
            planned: Vec::new(),
            systems: Vec::new(),
        }
    }

    /// With the recurrences of all instructions.
    fn filled(single: &'s Single) -> Builder<'s> {
        let mut builder = Builder::new(single);
        for &instruction in &single.program.body {
            builder.instruction(instruction);
        }
        builder
    }

    pub(super) fn is_constant(&self, register: u32) -> bool {
        self.is_constant[register as usize]
    }

    /// The register that stands for a term above order 0.
    fn term(&self, register: u32) -> u32 {
        if self.is_constant(register) {
            self.zero
        } else {
            register
        }
    }

    fn slot(slots: &mut u32, slot: &mut u32) -> u32 {
        if *slot == 0 {
            *slot = *slots;
            *slots += 1;
        }
        *slot
    }

    /// The series of a value, stored forward.
    pub(super) fn forward(&mut self, register: u32) -> u32 {
        let keep = &mut self.keep[register as usize];
        Self::slot(&mut self.slots, &mut keep.forward)
    }

    /// The series of a value, stored in reverse.
    pub(super) fn reverse(&mut self, register: u32) -> u32 {
        let keep = &mut self.keep[register as usize];
        Self::slot(&mut self.slots, &mut keep.reverse)
    }

    /// The series of a value, each coefficient times its order.
    pub(super) fn weighted(&mut self, register: u32) -> u32 {
        let keep = &mut self.keep[register as usize];
        Self::slot(&mut self.slots, &mut keep.weighted)
    }

    /// The two series of a product, so that few new ones are stored.
    fn factors(&mut self, a: u32, b: u32) -> (u32, u32) {
        let missing = |forward: u32, reverse: u32| {
            let (f, r) = (self.keep[forward as usize], self.keep[reverse as usize]);
            u8::from(f.forward == 0) + u8::from(r.reverse == 0)
        };
        let (a, b) = match missing(b, a) < missing(a, b) {
            true => (b, a),
            false => (a, b),
        };
        (self.forward(a), self.reverse(b))
    }

    /// A new value computed from a and b.
    pub(super) fn auxiliary(&mut self, auxiliary: Auxiliary, a: u32, b: u32) -> u32 {
        let register = self.is_constant.len() as u32;
        self.is_constant
            .push(self.is_constant(a) && self.is_constant(b));
        self.keep.push(Keep::default());
        self.auxiliaries.push((register, auxiliary, a, b));
        register
    }

    pub(super) fn demand(&mut self, register: u32, operation: &'static str, demands: Demand) {
        self.conditions.push(Condition {
            register,
            operation,
            demands,
        });
    }

    pub(super) fn push(&mut self, kind: Kind, out: u32, operands: [u32; 5], reads: &[u32]) {
        self.planned.push(Planned {
            kind,
            recurrence: Recurrence {
                out,
                operands,
                keep: Keep::default(),
            },
            reads: reads.to_vec(),
        });
    }

    fn instruction(&mut self, instruction: Instruction) {
        match instruction {
            Instruction::Unary { operation, out, a } => self.unary(operation, out.0, a.0),
            Instruction::Binary {
                operation,
                out,
                a,
                b,
            } => self.binary(operation, out.0, (a.0, b.0)),
            Instruction::Fused {
                operation,
                out,
                a,
                b,
                c,
            } => self.fused(operation, out.0, (a.0, b.0), c.0),
            Instruction::SinCos { sin, cos, a } => match self.is_constant(a.0) {
                true => {
                    self.push(Kind::Clear, sin.0, [0; 5], &[]);
                    self.push(Kind::Clear, cos.0, [0; 5], &[]);
                }
                false => self.pair((sin.0, cos.0), a.0, Kind::NegIntegral),
            },
            Instruction::Factor { .. } => {}
            Instruction::Solve { solve } => self.solve(solve as usize),
        }
    }

    fn unary(&mut self, operation: Unary, out: u32, a: u32) {
        if self.is_constant(a) {
            self.push(Kind::Clear, out, [0; 5], &[]);
            return;
        }
        match operation {
            Unary::Neg => self.push(Kind::Neg, out, [a, 0, 0, 0, 0], &[a]),
            Unary::Square => self.square(out, a),
            Unary::Sqrt => {
                self.demand(a, "sqrt", Demand::Positive);
                self.root(out, a);
            }
            Unary::Function(function) => self.function(function, out, a),
        }
    }

    fn binary(&mut self, operation: Binary, out: u32, (a, b): (u32, u32)) {
        if self.is_constant(a) && self.is_constant(b) {
            self.push(Kind::Clear, out, [0; 5], &[]);
            return;
        }
        let (x, y) = (self.term(a), self.term(b));
        match operation {
            Binary::Add => self.push(Kind::Add, out, [x, y, 0, 0, 0], &[x, y]),
            Binary::Sub => self.push(Kind::Sub, out, [x, y, 0, 0, 0], &[x, y]),
            Binary::Mul => match (self.is_constant(a), self.is_constant(b)) {
                (false, true) => self.push(Kind::Scale, out, [a, b, 0, 0, 0], &[a]),
                (true, _) => self.push(Kind::Scale, out, [b, a, 0, 0, 0], &[b]),
                _ if a == b => self.square(out, a),
                _ => {
                    let (f, r) = self.factors(a, b);
                    self.push(Kind::Convolve, out, [f, r, 0, 0, 0], &[a, b]);
                }
            },
            Binary::Div if self.is_constant(b) => {
                self.push(Kind::DivideConstant, out, [a, b, 0, 0, 0], &[a]);
            }
            Binary::Div => {
                self.demand(b, "division", Demand::NotZero);
                let divisor = self.forward(b);
                self.reverse(out);
                self.push(Kind::Divide, out, [x, divisor, 0, b, 0], &[x, b]);
            }
            Binary::Pow => self.power(out, a, b),
            Binary::Atan2 => self.angle(out, a, b),
        }
    }

    /// A product and a sum.
    fn fused(&mut self, operation: Fused, out: u32, (a, b): (u32, u32), c: u32) {
        let c = self.term(c);
        let (a, b) = match self.is_constant(a) {
            true => (b, a),
            false => (a, b),
        };
        if self.is_constant(a) {
            let kind = match operation {
                Fused::MulSub => Kind::Neg,
                _ => Kind::Add,
            };
            self.push(kind, out, [c, self.zero, 0, 0, 0], &[c]);
        } else if self.is_constant(b) {
            let kind = match operation {
                Fused::MulAdd => Kind::ScaleAdd,
                Fused::MulSub => Kind::ScaleSub,
                Fused::NegMulAdd => Kind::NegScaleAdd,
            };
            self.push(kind, out, [a, b, c, 0, 0], &[a, c]);
        } else {
            let kind = match operation {
                Fused::MulAdd => Kind::ConvolveAdd,
                Fused::MulSub => Kind::ConvolveSub,
                Fused::NegMulAdd => Kind::NegConvolveAdd,
            };
            let (f, r) = self.factors(a, b);
            self.push(kind, out, [f, r, c, 0, 0], &[a, b, c]);
        }
    }

    /// A system: its series are those of the entries that vary and of the unknowns of their columns.
    fn solve(&mut self, index: usize) {
        let solve = &self.single.program.solves[index];
        let matrix = &self.single.program.matrices[solve.matrix as usize];
        let rhs: Vec<u32> = solve.rhs.iter().map(|r| self.term(r.0)).collect();
        let mut system = Linear::of(solve, rhs);
        let mut reads = system.rhs.clone();
        for (place, &Register(entry)) in matrix.entries.iter().enumerate() {
            if self.is_constant(entry) {
                continue;
            }
            let (row, column) = (place / matrix.size, place % matrix.size);
            let (entry_series, unknown) = (self.forward(entry), self.reverse(solve.out[column].0));
            system.entries.push((row as u32, entry_series, unknown));
            reads.push(entry);
        }
        let number = self.systems.len() as u32;
        self.systems.push(system);
        self.push(Kind::Solve, self.zero, [number, 0, 0, 0, 0], &reads);
    }

    /// Tells the recurrences where the series of their results are stored.
    fn settle(&mut self) {
        for planned in &mut self.planned {
            planned.recurrence.keep = self.keep[planned.recurrence.out as usize];
        }
        for system in &mut self.systems {
            for (register, keep) in &mut system.out {
                *keep = self.keep[*register as usize];
            }
        }
    }

    fn finish(mut self) -> (Recurrences, usize) {
        self.settle();
        let stored = |register: u32| (register, self.keep[register as usize]);
        let is_stored = |keep: Keep| keep.forward + keep.reverse + keep.weighted > 0;
        let registers = self.is_constant.len();
        let kept: Vec<(u32, Keep)> = (0..registers as u32)
            .map(stored)
            .filter(|&(_, keep)| is_stored(keep))
            .collect();
        let is_input = |register: u32| {
            let origin = self.single.origins.get(register as usize);
            matches!(origin, Some(Origin::Variable(_)))
        };
        let inputs = kept.iter().copied().filter(|&(r, _)| is_input(r)).collect();
        let (list, runs) = in_runs(&self.planned, &self.systems);
        let recurrences = Recurrences {
            slots: self.slots as usize,
            is_constant: self.is_constant,
            auxiliaries: self.auxiliaries,
            conditions: self.conditions,
            kept,
            inputs,
            list,
            runs,
            systems: self.systems,
        };
        (recurrences, registers)
    }
}

/// Runs of one kind as long as any recurrence of it is ready, then the kind of which most are; a mispredicted jump for
/// each recurrence would cost more than most of them.
fn in_runs(
    planned: &[Planned],
    systems: &[Linear],
) -> (Vec<Recurrence>, Vec<(Kind, usize, usize)>) {
    let (mut waiting, followers) = dependencies(planned, systems);
    let mut ready = vec![VecDeque::new(); KINDS];
    for (i, own) in planned.iter().enumerate() {
        if waiting[i] == 0 {
            ready[own.kind as usize].push_back(i);
        }
    }
    let mut list = Vec::with_capacity(planned.len());
    let mut runs = Vec::new();
    loop {
        // The first of the largest, so that the order is determined; systems wait for all else.
        let largest = (0..KINDS - 1).rev().max_by_key(|&kind| ready[kind].len());
        let largest = largest.filter(|&kind| !ready[kind].is_empty());
        let kind = largest.unwrap_or(KINDS - 1);
        if ready[kind].is_empty() {
            return (list, runs);
        }
        let start = list.len();
        while let Some(i) = ready[kind].pop_front() {
            let own = &planned[i];
            if own.kind == Kind::Solve {
                let number = own.recurrence.operands[0] as usize;
                runs.push((Kind::Solve, number, number));
            } else {
                list.push(own.recurrence);
            }
            for &follower in &followers[i] {
                waiting[follower] -= 1;
                if waiting[follower] == 0 {
                    ready[planned[follower].kind as usize].push_back(follower);
                }
            }
        }
        if let Some(own) = planned.iter().find(|own| own.kind as usize == kind) {
            if own.kind != Kind::Solve {
                runs.push((own.kind, start, list.len()));
            }
        }
    }
}

/// By recurrence: how many others it waits for, and which wait for it.
fn dependencies(planned: &[Planned], systems: &[Linear]) -> (Vec<usize>, Vec<Vec<usize>>) {
    let mut producers = std::collections::BTreeMap::new();
    for (i, own) in planned.iter().enumerate() {
        if own.kind == Kind::Solve {
            let system = &systems[own.recurrence.operands[0] as usize];
            producers.extend(system.out.iter().map(|&(register, _)| (register, i)));
        } else {
            producers.insert(own.recurrence.out, i);
        }
    }
    let mut waiting = vec![0; planned.len()];
    let mut followers = vec![Vec::new(); planned.len()];
    for (i, own) in planned.iter().enumerate() {
        for producer in own.reads.iter().filter_map(|r| producers.get(r)) {
            waiting[i] += 1;
            followers[*producer].push(i);
        }
    }
    (waiting, followers)
}
