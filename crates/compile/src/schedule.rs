//! Reorders a program so that equal operations follow each other.
//!
//! An interpreter that reads one instruction per state spends most of its time on mispredicted jumps; runs of one
//! operation need one jump each. The price is a larger register file, so blocks of states, which share the cost of
//! a jump, keep the order of the program. Reordering changes no value: every instruction reads what it read before.

use crate::allocate;
pub(crate) use crate::allocate::Group;
use crate::emit::Origin;
use crate::program::{Binary, Fused, Instruction, Program, Register, Unary};
use std::collections::VecDeque;

/// The same program in another order, with registers assigned anew; the program is well formed.
pub(crate) fn in_runs(program: &Program) -> Program {
    let Single {
        mut program,
        origins,
        groups,
    } = Single::of(program);
    let mut body = Vec::with_capacity(program.body.len());
    for group in &groups {
        let part = &program.body[body.len()..group.end];
        schedule(&program, part, &mut body);
    }
    program.body = body;
    allocate::place(program, origins, groups)
}

/// A program whose registers are written once each.
#[derive(Clone, Debug)]
pub(crate) struct Single {
    pub(crate) program: Program,
    pub(crate) origins: Vec<Origin>,
    pub(crate) groups: Vec<Group>,
}

impl Single {
    pub(crate) fn of(original: &Program) -> Single {
        let mut single = Single {
            program: original.clone(),
            origins: Vec::new(),
            groups: Vec::new(),
        };
        let layout = &original.layout;
        let mut now = vec![Register(0); layout.len()];
        let count = |n: usize| 0..n as u32;
        let inputs = count(layout.constants)
            .map(Origin::Constant)
            .chain(count(layout.parameters).map(Origin::Parameter));
        for (i, origin) in inputs.enumerate() {
            now[i] = single.register(origin);
        }
        for (i, k) in layout.variable_range().zip(0..) {
            now[i] = single.register(Origin::Variable(k));
        }
        for i in 0..original.prologue.len() {
            let instruction = single.rename(original.prologue[i], Origin::Prologue, &mut now);
            single.program.prologue[i] = instruction;
        }
        let mut done = 0;
        for group in &original.outputs {
            for i in done..group.end {
                let instruction = single.rename(original.body[i], Origin::Body, &mut now);
                single.program.body[i] = instruction;
            }
            done = group.end;
            single.groups.push(Group {
                name: group.name.clone(),
                registers: group.registers.iter().map(|r| now[r.index()]).collect(),
                end: group.end,
            });
        }
        single
    }

    fn register(&mut self, origin: Origin) -> Register {
        self.origins.push(origin);
        Register(self.origins.len() as u32 - 1)
    }

    /// The instruction on registers of its own; `now` says where the present values are.
    fn rename(
        &mut self,
        instruction: Instruction,
        origin: Origin,
        now: &mut [Register],
    ) -> Instruction {
        let mut written = Vec::new();
        let renamed = instruction.map(
            |read| now[read.index()],
            |out| {
                let fresh = self.register(origin);
                written.push((out, fresh));
                fresh
            },
        );
        for (out, fresh) in written {
            now[out.index()] = fresh;
        }
        match instruction {
            Instruction::Factor { matrix } => {
                let entries = &mut self.program.matrices[matrix as usize].entries;
                entries.iter_mut().for_each(|r| *r = now[r.index()]);
            }
            Instruction::Solve { solve } => {
                let index = solve as usize;
                let rhs = &mut self.program.solves[index].rhs;
                rhs.iter_mut().for_each(|r| *r = now[r.index()]);
                for i in 0..self.program.solves[index].out.len() {
                    let fresh = self.register(origin);
                    let out = &mut self.program.solves[index].out[i];
                    now[out.index()] = fresh;
                    *out = fresh;
                }
            }
            _ => {}
        }
        renamed
    }
}

/// Appends the instructions of `part` in an order that respects what they read: one operation as long as any
/// instruction of it is ready, then the operation with most instructions ready.
fn schedule(program: &Program, part: &[Instruction], body: &mut Vec<Instruction>) {
    let Dependencies {
        mut waiting,
        followers,
    } = Dependencies::of(program, part);
    let mut ready = vec![VecDeque::new(); OPERATIONS];
    for (i, &instruction) in part.iter().enumerate() {
        if waiting[i] == 0 {
            ready[operation(instruction)].push_back(i);
        }
    }
    let end = body.len() + part.len();
    while body.len() < end {
        // The first of the largest, so that the order is determined.
        let largest = (0..OPERATIONS).rev().max_by_key(|&kind| ready[kind].len());
        let Some(kind) = largest else { return };
        while let Some(i) = ready[kind].pop_front() {
            body.push(part[i]);
            for &follower in &followers[i] {
                waiting[follower] -= 1;
                if waiting[follower] == 0 {
                    ready[operation(part[follower])].push_back(follower);
                }
            }
        }
    }
}

/// Which instructions of a part wait for which.
struct Dependencies {
    /// By instruction: how many instructions it waits for.
    waiting: Vec<usize>,
    /// By instruction: which instructions wait for it.
    followers: Vec<Vec<usize>>,
}

impl Dependencies {
    fn of(program: &Program, part: &[Instruction]) -> Dependencies {
        let mut producers = std::collections::HashMap::new();
        let mut factors = std::collections::HashMap::new();
        let mut dependencies = Dependencies {
            waiting: vec![0; part.len()],
            followers: vec![Vec::new(); part.len()],
        };
        for (i, &instruction) in part.iter().enumerate() {
            program.for_each_read(instruction, |r| {
                if let Some(&producer) = producers.get(&r) {
                    dependencies.add(producer, i);
                }
            });
            match instruction {
                Instruction::Factor { matrix } => _ = factors.insert(matrix, i),
                Instruction::Solve { solve } => {
                    let matrix = program.solves[solve as usize].matrix;
                    if let Some(&factor) = factors.get(&matrix) {
                        dependencies.add(factor, i);
                    }
                }
                _ => {}
            }
            program.for_each_write(instruction, |r| _ = producers.insert(r, i));
        }
        dependencies
    }

    fn add(&mut self, first: usize, second: usize) {
        self.waiting[second] += 1;
        self.followers[first].push(second);
    }
}

const OPERATIONS: usize = 35;

/// A number for each operation. Systems come last: they are few, and by then most else is done.
fn operation(instruction: Instruction) -> usize {
    match instruction {
        Instruction::Fused { operation, .. } => match operation {
            Fused::MulAdd => 0,
            Fused::NegMulAdd => 1,
            Fused::MulSub => 2,
        },
        Instruction::Binary { operation, .. } => match operation {
            Binary::Mul => 3,
            Binary::Add => 4,
            Binary::Sub => 5,
            Binary::Div => 6,
            Binary::Pow => 7,
            Binary::Atan2 => 8,
        },
        Instruction::Unary { operation, .. } => match operation {
            Unary::Neg => 9,
            Unary::Square => 10,
            Unary::Sqrt => 11,
            Unary::Function(function) => 12 + function as usize,
        },
        Instruction::SinCos { .. } => 32,
        Instruction::Factor { .. } => 33,
        Instruction::Solve { .. } => 34,
    }
}
