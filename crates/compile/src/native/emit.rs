//! From instructions on registers to bytes.
//!
//! A function takes, as the System V convention has it, the frame in rdi, the variables in rsi, the register file
//! of the prologue in rdx, the outputs in rcx and the number of groups in r8, and returns the states without a
//! result as bits, which it gathers in r9. It calls nothing unless a function is called for, so it saves nothing.

use super::assembler::{Address, Assembler, Condition, Gpr, Label, Operand, Width, Ymm};
use super::call::Helper;
use super::code::{Base, Operation, Place, SAVED, SCRATCH, SCRATCH_CELL};
use super::registers::{Spot, Step};

/// The bytes of a function; `None` if it is too long for its jumps.
pub(crate) fn emit(steps: &[Step], width: Width) -> Option<Vec<u8>> {
    let mut assembler = Assembler::default();
    let labels = [(); 3].map(|()| assembler.label());
    let [exit, call, call_saving] = labels;
    let mut emitter = Emitter {
        assembler,
        width,
        exit,
        call,
        call_saving,
        guards: Vec::new(),
        uses_upper: width == Width::Four,
    };
    emitter.assembler.clear(Gpr::R9);
    for step in steps {
        emitter.step(step);
    }
    emitter.end();
    emitter.slow_paths();
    emitter.subroutines();
    emitter.assembler.finish()
}

struct Emitter {
    assembler: Assembler,
    /// Of the states.
    width: Width,
    exit: Label,
    call: Label,
    call_saving: Label,
    guards: Vec<Guard>,
    uses_upper: bool,
}

/// A guard whose slow path is yet to be written.
struct Guard {
    slow: Helper,
    width: Width,
    bad: Ymm,
    argument: Ymm,
    results: [Option<Ymm>; 2],
    entry: Label,
    back: Label,
}

fn address(place: Place) -> Address {
    let base = match place.base {
        Base::Frame => Gpr::Rdi,
        Base::Variables => Gpr::Rsi,
        Base::File => Gpr::Rdx,
        Base::Outputs => Gpr::Rcx,
    };
    Address {
        base,
        offset: place.offset,
    }
}

fn operand(spot: Spot) -> Operand {
    match spot {
        Spot::Register(register) => Operand::Register(register),
        Spot::Memory(place) => Operand::Memory(address(place)),
    }
}

/// The scratch cells: argument, two results, mask.
fn scratch(cell: i32) -> Address {
    Address {
        base: Gpr::Rdi,
        offset: SCRATCH + cell * SCRATCH_CELL,
    }
}

impl Emitter {
    fn step(&mut self, step: &Step) {
        let x = &mut self.assembler;
        match *step {
            Step::Load { width, to, from } => {
                self.uses_upper |= width == Width::Four;
                x.load(width, to, address(from));
            }
            Step::Copy { width, to, from } => x.copy(width, to, from),
            Step::Store { width, to, from } => x.store(width, address(to), from),
            Step::Apply {
                operation,
                width,
                out,
                a,
                b,
                c,
            } => {
                self.uses_upper |= width == Width::Four || operation == Operation::Join;
                self.apply(operation, width, (out, a, b, c));
            }
            Step::Fused {
                sign,
                order,
                width,
                first,
                second,
                third,
            } => x.fused((sign, order), width, first, second, operand(third)),
            Step::Guard {
                slow,
                width,
                bad,
                argument,
                results,
            } => {
                let (entry, back) = (x.label(), x.label());
                self.guard(Guard {
                    slow,
                    width,
                    bad,
                    argument,
                    results,
                    entry,
                    back,
                });
            }
            Step::Call { helper, cells } => {
                let call = self.call;
                self.call(helper, cells, self.width, call);
                // States without a result; none but for matrices.
                self.assembler.or(Gpr::R9, Gpr::Rax);
            }
            Step::Fail { width, bad } => {
                x.signs(width, Gpr::Rax, bad);
                x.and_immediate(Gpr::Rax, all(width));
                x.or(Gpr::R9, Gpr::Rax);
            }
            Step::End => {
                x.decrement(Gpr::R8);
                x.jump(Condition::Zero, self.exit);
            }
        }
    }

    fn apply(&mut self, operation: Operation, width: Width, (out, a, b, c): (Ymm, Ymm, Spot, Ymm)) {
        let x = &mut self.assembler;
        let b_operand = operand(b);
        match operation {
            Operation::Float(float) => x.float(float, width, out, a, b_operand),
            Operation::Bits(bits) => x.bits(bits, width, out, a, b_operand),
            Operation::Compare(predicate) => x.compare(predicate, width, out, a, b_operand),
            Operation::Shift { left, bits } => x.shift(left, bits, width, out, a),
            Operation::Blend => x.blend(width, out, a, b_operand, c),
            Operation::Join => {
                if let Spot::Register(b) = b {
                    x.join(out, a, b);
                }
            }
            Operation::UpperHalf => x.upper_half(out, a),
            // Written by `Step::Fused`.
            Operation::Fused(_) => {}
        }
    }

    /// Leaves for the slow path where the mask is set.
    fn guard(&mut self, guard: Guard) {
        let x = &mut self.assembler;
        x.signs(guard.width, Gpr::Rax, guard.bad);
        x.and_immediate(Gpr::Rax, all(guard.width));
        x.jump(Condition::NotZero, guard.entry);
        x.bind(guard.back);
        self.guards.push(guard);
    }

    /// Calls a function on cells of the frame, through one of the subroutines.
    fn call(&mut self, helper: Helper, cells: i32, width: Width, subroutine: Label) {
        let x = &mut self.assembler;
        x.move_immediate(Gpr::Rax, helper.address());
        x.move_immediate(Gpr::R10, cells as u64);
        x.move_immediate(Gpr::R11, helper.detail(width));
        x.call(subroutine);
    }

    fn end(&mut self) {
        let x = &mut self.assembler;
        x.bind(self.exit);
        x.move_register(Gpr::Rax, Gpr::R9);
        if self.uses_upper {
            x.zero_upper();
        }
        x.ret();
    }

    /// What happens where a guard finds an argument that the quick way does not cover.
    fn slow_paths(&mut self) {
        for guard in std::mem::take(&mut self.guards) {
            let Guard {
                slow,
                width,
                bad,
                argument,
                results,
                entry,
                back,
            } = guard;
            self.assembler.bind(entry);
            self.assembler.store(width, scratch(0), argument);
            for (cell, result) in (1..).zip(results) {
                if let Some(result) = result {
                    self.assembler.store(width, scratch(cell), result);
                }
            }
            self.assembler.store(width, scratch(3), bad);
            let subroutine = self.call_saving;
            self.call(slow, SCRATCH, width, subroutine);
            for (cell, result) in (1..).zip(results) {
                if let Some(result) = result {
                    self.assembler.load(width, result, scratch(cell));
                }
            }
            self.assembler.jump(Condition::Always, back);
        }
    }

    /// Calls rax with the cells at r10 and the detail in r11; the second saves all vector registers around it.
    fn subroutines(&mut self) {
        const KEPT: [Gpr; 6] = [Gpr::Rdi, Gpr::Rsi, Gpr::Rdx, Gpr::Rcx, Gpr::R8, Gpr::R9];
        let x = &mut self.assembler;
        x.bind(self.call);
        // With the two return addresses, six registers leave the stack aligned to sixteen bytes.
        KEPT.iter().for_each(|&r| x.push(r));
        x.add_long(Gpr::Rdi, Gpr::R10);
        x.move_long(Gpr::Rsi, Gpr::R11);
        x.zero_upper();
        x.call_register(Gpr::Rax);
        KEPT.iter().rev().for_each(|&r| x.pop(r));
        x.ret();

        x.bind(self.call_saving);
        let saved = |r: u8| Address {
            base: Gpr::Rdi,
            offset: SAVED + 32 * i32::from(r),
        };
        (0..16).for_each(|r| x.store(Width::Four, saved(r), Ymm(r)));
        KEPT.iter().for_each(|&r| x.push(r));
        x.add_long(Gpr::Rdi, Gpr::R10);
        x.move_long(Gpr::Rsi, Gpr::R11);
        x.zero_upper();
        x.call_register(Gpr::Rax);
        KEPT.iter().rev().for_each(|&r| x.pop(r));
        (0..16).for_each(|r| x.load(Width::Four, Ymm(r), saved(r)));
        x.ret();
    }
}

/// One bit for each number.
fn all(width: Width) -> i8 {
    match width {
        Width::One => 1,
        Width::Four => 15,
    }
}
