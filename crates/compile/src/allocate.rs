//! Assigns places in the register file to the registers of the single-assignment form, by a linear scan.
//!
//! A temporary is free again after the last instruction, or group of outputs, that reads it; the place freed last
//! is used first, which keeps the working set small.

use crate::emit::{Emitter, Origin};
use crate::program::{Instruction, Layout, OutputGroup, Program, Register};

/// A group of outputs in single-assignment form.
#[derive(Clone, Debug)]
pub(crate) struct Group {
    pub(crate) name: String,
    pub(crate) registers: Vec<Register>,
    /// How many instructions of the body come before.
    pub(crate) end: usize,
}

/// No place yet.
const NOWHERE: Register = Register(u32::MAX);

/// What happens one after the other.
#[derive(Clone, Copy)]
enum Step {
    Run(Instruction),
    Output(usize),
}

struct Allocation {
    origins: Vec<Origin>,
    /// By register of the single-assignment form.
    places: Vec<Register>,
    /// By register: the last step that reads it, counted from 1; 0 if none does.
    last_read: Vec<usize>,
    /// First temporary place.
    base: usize,
    temporaries: usize,
    free: Vec<Register>,
}

pub(crate) fn allocate(
    emitter: Emitter,
    variables: Vec<String>,
    parameters: Vec<String>,
    groups: Vec<Group>,
) -> Program {
    let layout = Layout {
        constants: emitter.constants.len(),
        parameters: parameters.len(),
        variables: variables.len(),
        ..Layout::default()
    };
    let program = Program {
        variables,
        parameters,
        constants: emitter.constants,
        layout,
        prologue: emitter.prologue,
        body: emitter.body,
        matrices: emitter.matrices,
        solves: emitter.solves,
        outputs: Vec::new(),
    };
    place(program, emitter.origins, groups)
}

/// The program in single-assignment form, with places; the layout counts its constants, parameters and variables.
pub(crate) fn place(mut program: Program, origins: Vec<Origin>, groups: Vec<Group>) -> Program {
    let mut allocation = Allocation {
        places: vec![NOWHERE; origins.len()],
        last_read: vec![0; origins.len()],
        origins,
        base: 0,
        temporaries: 0,
        free: Vec::new(),
    };
    allocation.place_permanently(&mut program, &groups);
    allocation.place_temporarily(&program, &steps(&program, &groups), &groups);
    allocation.rename(&mut program, groups);
    program
}

/// Prologue, body and groups of outputs in the order in which they happen.
fn steps(program: &Program, groups: &[Group]) -> Vec<Step> {
    let (prologue, body) = (&program.prologue, &program.body);
    let mut steps = Vec::with_capacity(prologue.len() + body.len() + groups.len());
    steps.extend(prologue.iter().map(|&instruction| Step::Run(instruction)));
    let mut done = 0;
    for (g, group) in groups.iter().enumerate() {
        let part = &body[done..group.end];
        steps.extend(part.iter().map(|&instruction| Step::Run(instruction)));
        steps.push(Step::Output(g));
        done = group.end;
    }
    steps
}

impl Allocation {
    /// Places for constants, parameters and variables, and for what the body reads of the prologue.
    fn place_permanently(&mut self, program: &mut Program, groups: &[Group]) {
        let mut is_hoisted = vec![false; self.origins.len()];
        let mut mark = |r: Register| {
            is_hoisted[r.index()] = self.origins[r.index()] == Origin::Prologue;
        };
        for &instruction in &program.body {
            program.for_each_read(instruction, &mut mark);
        }
        let outputs = groups.iter().flat_map(|group| &group.registers);
        outputs.for_each(|&r| mark(r));
        program.layout.hoisted = is_hoisted.iter().filter(|&&hoisted| hoisted).count();
        let layout = program.layout;
        let mut hoisted = layout.hoisted_range();
        for (i, &origin) in self.origins.iter().enumerate() {
            let place = match origin {
                Origin::Constant(k) => Some(k as usize),
                Origin::Parameter(k) => Some(layout.parameter_range().start + k as usize),
                Origin::Variable(k) => Some(layout.variable_range().start + k as usize),
                Origin::Prologue if is_hoisted[i] => hoisted.next(),
                Origin::Prologue | Origin::Body => None,
            };
            self.places[i] = place.map_or(NOWHERE, |place| Register(place as u32));
        }
        self.base = layout.temporary_range().start;
    }

    /// Places for everything else.
    fn place_temporarily(&mut self, program: &Program, steps: &[Step], groups: &[Group]) {
        for (i, &step) in steps.iter().enumerate() {
            for_each_read(program, groups, step, |r| self.last_read[r.index()] = i + 1);
        }
        for (i, &step) in steps.iter().enumerate() {
            for_each_read(program, groups, step, |r| {
                if self.last_read[r.index()] == i + 1 {
                    self.release(r);
                }
            });
            let Step::Run(instruction) = step else {
                continue;
            };
            program.for_each_write(instruction, |r| {
                if self.places[r.index()] == NOWHERE {
                    self.places[r.index()] = self.take();
                }
            });
            program.for_each_write(instruction, |r| {
                if self.last_read[r.index()] == 0 {
                    self.release(r);
                }
            });
        }
    }

    fn take(&mut self) -> Register {
        self.free.pop().unwrap_or_else(|| {
            self.temporaries += 1;
            Register((self.base + self.temporaries - 1) as u32)
        })
    }

    /// Frees the place of a temporary, once.
    fn release(&mut self, r: Register) {
        let place = self.places[r.index()];
        if place.index() >= self.base {
            self.free.push(place);
        }
        self.last_read[r.index()] = usize::MAX;
    }

    /// Replaces every register of the single-assignment form by its place.
    fn rename(self, program: &mut Program, groups: Vec<Group>) {
        program.layout.temporaries = self.temporaries;
        let place = |r: Register| self.places[r.index()];
        let rename = |registers: &mut Vec<Register>| {
            registers.iter_mut().for_each(|r| *r = place(*r));
        };
        let code = program.prologue.iter_mut().chain(&mut program.body);
        code.for_each(|instruction| *instruction = instruction.map(place, place));
        program
            .matrices
            .iter_mut()
            .for_each(|m| rename(&mut m.entries));
        for solve in &mut program.solves {
            rename(&mut solve.rhs);
            rename(&mut solve.out);
        }
        program.outputs = groups
            .into_iter()
            .map(|mut group| {
                rename(&mut group.registers);
                OutputGroup {
                    name: group.name,
                    registers: group.registers,
                    end: group.end,
                }
            })
            .collect();
    }
}

fn for_each_read(program: &Program, groups: &[Group], step: Step, visit: impl FnMut(Register)) {
    match step {
        Step::Run(instruction) => program.for_each_read(instruction, visit),
        Step::Output(g) => groups[g].registers.iter().copied().for_each(visit),
    }
}
