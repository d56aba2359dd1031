//! From instructions on registers to bytes.
//!
//! A function takes, as the System V convention has it, the frame in rdi, the variables in rsi, the register file
//! of the prologue in rdx, the outputs in rcx and the number of groups in r8, and returns the states without a
//! result as bits, which it gathers in r9. It calls nothing unless a function is called for, so it saves nothing.

use super::assembler::{
    Address, Assembler, Condition, Gpr, Label, Mask, Operand, Predicate, Vector, Width,
};
use super::call::Helper;
use super::code::{Base, Operation, Place, SAVED, SCRATCH, SCRATCH_CELL};
use super::registers::{registers, Spot, Step};

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
        uses_upper: width != Width::One,
        masks: Masks::default(),
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
    masks: Masks,
}

/// What the mask registers hold: eight states are compared and selected by them.
#[derive(Default)]
struct Masks {
    /// By mask register: the vector register whose sign bits it has.
    signs: [Option<Vector>; 7],
    /// The one that is given away next.
    next: usize,
}

impl Masks {
    /// A mask register for the sign bits of `vector`.
    fn take(&mut self, vector: Vector) -> Mask {
        self.forget(vector);
        let taken = self.next;
        self.signs[taken] = Some(vector);
        self.next = (taken + 1) % self.signs.len();
        Mask(taken as u8 + 1)
    }

    /// The mask register that has the sign bits of `vector`.
    fn of(&self, vector: Vector) -> Option<Mask> {
        let found = self.signs.iter().position(|&held| held == Some(vector));
        found.map(|k| Mask(k as u8 + 1))
    }

    /// A register has been overwritten.
    fn forget(&mut self, vector: Vector) {
        let is_held = |held: &&mut Option<Vector>| **held == Some(vector);
        self.signs
            .iter_mut()
            .filter(is_held)
            .for_each(|held| *held = None);
    }

    /// A function has been called, or may have been.
    fn clear(&mut self) {
        self.signs = [None; 7];
    }
}

/// A guard whose slow path is yet to be written.
struct Guard {
    slow: Helper,
    width: Width,
    bad: Vector,
    argument: Vector,
    results: [Option<Vector>; 2],
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
                self.masks.forget(to);
                x.load(width, to, address(from));
            }
            Step::Copy { width, to, from } => {
                self.masks.forget(to);
                x.copy(width, to, from);
            }
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
            } => {
                self.masks.forget(first);
                x.fused((sign, order), width, first, second, operand(third));
            }
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
                self.masks.clear();
                self.call(helper, cells, self.width, call);
                // States without a result; none but for matrices.
                self.assembler.or(Gpr::R9, Gpr::Rax);
            }
            Step::Fail { width, bad } => {
                if width == Width::Eight {
                    let mask = self.signs(width, bad);
                    self.assembler.move_mask(Gpr::Rax, mask);
                } else {
                    x.signs(width, Gpr::Rax, bad);
                    x.and_immediate(Gpr::Rax, all(width));
                }
                self.assembler.or(Gpr::R9, Gpr::Rax);
            }
            Step::End => {
                x.decrement(Gpr::R8);
                x.jump(Condition::Zero, self.exit);
            }
        }
    }

    fn apply(
        &mut self,
        operation: Operation,
        width: Width,
        (out, a, b, c): (Vector, Vector, Spot, Vector),
    ) {
        if width == Width::Eight {
            match operation {
                Operation::Compare(predicate) => {
                    return self.compare(predicate, width, (out, a, b))
                }
                Operation::Blend => return self.select(width, (out, a, b, c)),
                _ => {}
            }
        }
        self.masks.forget(out);
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

    /// The mask register with the sign bits of a register.
    fn signs(&mut self, width: Width, vector: Vector) -> Mask {
        if let Some(mask) = self.masks.of(vector) {
            return mask;
        }
        let mask = self.masks.take(vector);
        self.assembler.signs_to_mask(width, mask, vector);
        mask
    }

    /// The result is kept as a mask too, which is what selections and guards need of it.
    fn compare(&mut self, predicate: Predicate, width: Width, (out, a, b): (Vector, Vector, Spot)) {
        let mask = self.masks.take(out);
        let x = &mut self.assembler;
        x.compare_to_mask(predicate, width, mask, a, operand(b));
        x.spread(width, out, mask);
    }

    fn select(&mut self, width: Width, (out, a, b, mask): (Vector, Vector, Spot, Vector)) {
        let mask = self.signs(width, mask);
        self.masks.forget(out);
        self.assembler.select(width, out, a, operand(b), mask);
    }

    /// Leaves for the slow path where the mask is set.
    fn guard(&mut self, guard: Guard) {
        if guard.width == Width::Eight {
            let mask = self.signs(guard.width, guard.bad);
            self.assembler.test_mask(mask);
            self.masks.clear();
        } else {
            let x = &mut self.assembler;
            x.signs(guard.width, Gpr::Rax, guard.bad);
            x.and_immediate(Gpr::Rax, all(guard.width));
        }
        let x = &mut self.assembler;
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
        // Whole registers, also in code for single states, whose angles may share them.
        let (whole, count) = match self.width {
            Width::One | Width::Four => (Width::Four, registers(self.width) as u8),
            Width::Eight => (Width::Eight, registers(self.width) as u8),
        };
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
            offset: SAVED + SCRATCH_CELL * i32::from(r),
        };
        (0..count).for_each(|r| x.store(whole, saved(r), Vector(r)));
        KEPT.iter().for_each(|&r| x.push(r));
        x.add_long(Gpr::Rdi, Gpr::R10);
        x.move_long(Gpr::Rsi, Gpr::R11);
        x.zero_upper();
        x.call_register(Gpr::Rax);
        KEPT.iter().rev().for_each(|&r| x.pop(r));
        (0..count).for_each(|r| x.load(whole, Vector(r), saved(r)));
        x.ret();
    }
}

/// One bit for each number.
fn all(width: Width) -> i8 {
    match width {
        Width::One => 1,
        Width::Four => 15,
        // All bits of the byte.
        Width::Eight => -1,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::native::code::{Builder, Value};
    use crate::native::registers::allocate;
    use iced_x86::{Decoder, DecoderOptions, Mnemonic};

    const VARIABLES: Base = Base::Variables;

    /// What a disassembler reads of code for eight states, in front of its slow paths.
    fn mnemonics(write: impl FnOnce(&mut Builder, [Value; 3]) -> Value) -> Vec<Mnemonic> {
        let mut b = Builder::new(Width::Eight);
        let given = [0, 256, 512].map(|offset| b.at(VARIABLES, offset));
        let value = write(&mut b, given);
        let base = Base::Outputs;
        b.store(value, Place { base, offset: 0 });
        let steps = allocate(&b.finish(), Width::Eight).steps;
        let bytes = emit(&steps, Width::Eight).unwrap();
        let decoder = Decoder::new(64, &bytes, DecoderOptions::NONE);
        let mnemonics = decoder
            .into_iter()
            .map(|instruction| instruction.mnemonic());
        mnemonics.take_while(|&m| m != Mnemonic::Ret).collect()
    }

    fn count(mnemonics: &[Mnemonic], mnemonic: Mnemonic) -> usize {
        mnemonics.iter().filter(|&&m| m == mnemonic).count()
    }

    #[test]
    fn a_comparison_is_selected_by_without_being_read_back() {
        let found = mnemonics(|b, [x, y, z]| {
            let mask = b.compare(Predicate::Less, x, y);
            let first = b.blend(x, z, mask);
            let second = b.blend(y, z, mask);
            b.add(first, second)
        });
        assert_eq!(count(&found, Mnemonic::Vpmovq2m), 0, "{found:?}");
        assert_eq!(count(&found, Mnemonic::Vblendmpd), 2, "{found:?}");
    }

    #[test]
    fn sign_bits_are_read_once_until_a_function_may_have_been_called() {
        let found = mnemonics(|b, [x, y, z]| {
            let first = b.blend(x, y, z);
            let second = b.blend(y, x, z);
            let product = b.mul(first, second);
            let [quick] = b.guard(Helper::Log, x, product, [second]);
            b.blend(product, quick, z)
        });
        // z, x for the guard, and z again.
        assert_eq!(count(&found, Mnemonic::Vpmovq2m), 3, "{found:?}");
        assert_eq!(count(&found, Mnemonic::Kortestb), 1, "{found:?}");
    }

    #[test]
    fn a_mask_is_forgotten_when_its_register_is_written() {
        let found = mnemonics(|b, [x, y, z]| {
            let first = b.compare(Predicate::Less, x, y);
            // The comparison dies here, and its register is taken.
            let second = b.bits(crate::native::assembler::Bits::Xor, first, z);
            b.blend(x, y, second)
        });
        assert_eq!(count(&found, Mnemonic::Vpmovq2m), 1, "{found:?}");
    }
}
