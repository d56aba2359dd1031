//! Encodes the x86-64 instructions that the emitter uses.
//!
//! Vector instructions have the VEX form, or the EVEX form where eight numbers or registers from 16 on take part
//! (Intel 64 and IA-32 Architectures Software Developer's Manual, volume 2, sections 2.3 and 2.7):
//! `dst ← op(src1, src2)` with `src2` a register or memory. The tests read every encoding back with a disassembler
//! that shares nothing with this file.

/// A vector register: ymm0 to ymm15, or zmm0 to zmm31 in the EVEX form. Its low part is the xmm register of the same
/// number.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(crate) struct Vector(pub(crate) u8);

/// The general registers in use. All may be overwritten by a callee, so a function that calls nothing saves nothing.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(crate) enum Gpr {
    Rax = 0,
    Rcx = 1,
    Rdx = 2,
    Rsi = 6,
    Rdi = 7,
    R8 = 8,
    R9 = 9,
    R10 = 10,
    R11 = 11,
}

/// A mask register, k1 to k7, with one bit for each number of a vector: k0 selects nothing.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(crate) struct Mask(pub(crate) u8);

/// An address: a register and a displacement.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(crate) struct Address {
    pub(crate) base: Gpr,
    pub(crate) offset: i32,
}

/// The operand that may be in memory.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(crate) enum Operand {
    Register(Vector),
    Memory(Address),
}

/// How many numbers an instruction works on.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(crate) enum Width {
    /// One number in the low part of a register.
    One,
    /// Four numbers.
    Four,
    /// Eight numbers, in the EVEX form.
    Eight,
}

impl Width {
    pub(crate) fn lanes(self) -> usize {
        match self {
            Width::One => 1,
            Width::Four => 4,
            Width::Eight => 8,
        }
    }
}

/// The mandatory prefix, as the VEX prefix counts them.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Prefix {
    P66 = 1,
    F3 = 2,
    F2 = 3,
}

/// The table of opcodes an instruction is in, as the VEX prefix counts them.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Map {
    M0F = 1,
    M0F38 = 2,
    M0F3A = 3,
}

/// What distinguishes one vector instruction from another.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct Opcode {
    pub(crate) prefix: Prefix,
    pub(crate) map: Map,
    pub(crate) w: bool,
    pub(crate) code: u8,
}

const fn opcode(prefix: Prefix, map: Map, w: bool, code: u8) -> Opcode {
    Opcode {
        prefix,
        map,
        w,
        code,
    }
}

/// The prefix of instructions on one number, or on whole registers of them.
fn numbers(width: Width) -> Prefix {
    match width {
        Width::One => Prefix::F2,
        Width::Four | Width::Eight => Prefix::P66,
    }
}

/// Bytes of the numbers that an instruction works on.
fn bytes(width: Width) -> i32 {
    8 * width.lanes() as i32
}

/// Bytes of the registers that instructions on whole registers work on.
fn register_bytes(width: Width) -> i32 {
    bytes(width).max(16)
}

/// Instructions on doubles that exist for one number and for a whole register.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(crate) enum Float {
    Add = 0x58,
    Mul = 0x59,
    Sub = 0x5C,
    Min = 0x5D,
    Div = 0x5E,
    Max = 0x5F,
    Sqrt = 0x51,
    Compare = 0xC2,
}

/// Instructions on whole registers, whatever is in them.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(crate) enum Bits {
    And = 0x54,
    Or = 0x56,
    Xor = 0x57,
    AddInteger = 0xD4,
    SubInteger = 0xFB,
    /// (low of `a`, low of `b`) in each half of the register.
    UnpackLow = 0x14,
    /// (high of `a`, high of `b`) in each half of the register.
    UnpackHigh = 0x15,
}

/// Signs of a fused multiply-add, as in the names of the instructions.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(crate) enum Sign {
    /// product + addend
    Add = 0x08,
    /// product − addend
    Sub = 0x0A,
    /// addend − product
    NegatedAdd = 0x0C,
}

/// Which operands of a fused multiply-add are multiplied; operand 1 is overwritten, operand 3 may be memory.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(crate) enum Order {
    /// 1 ← 1 · 3 + 2
    O132 = 0x90,
    /// 1 ← 2 · 1 + 3
    O213 = 0xA0,
    /// 1 ← 2 · 3 + 1
    O231 = 0xB0,
}

/// Predicates of comparisons. Those with `Not` hold if an operand is not a number.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(crate) enum Predicate {
    Less = 0x11,
    NotLessEqual = 0x06,
    NotLess = 0x05,
}

/// A place to jump to, known or not yet.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(crate) struct Label(usize);

/// When a jump is taken.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(crate) enum Condition {
    Always,
    Zero,
    NotZero,
}

/// Machine code under construction.
#[derive(Default, Debug)]
pub(crate) struct Assembler {
    bytes: Vec<u8>,
    /// By label: where it is.
    labels: Vec<Option<usize>>,
    /// Displacements of four bytes to fill in, with their label.
    fixes: Vec<(usize, Label)>,
}

impl Assembler {
    /// The code; `None` if a jump has no target or is too long.
    pub(crate) fn finish(mut self) -> Option<Vec<u8>> {
        for &(at, label) in &self.fixes {
            let target = self.labels[label.0]?;
            // Jumps count from the end of the displacement.
            let distance = i32::try_from(target as i64 - (at as i64 + 4)).ok()?;
            self.bytes[at..at + 4].copy_from_slice(&distance.to_le_bytes());
        }
        Some(self.bytes)
    }

    pub(crate) fn label(&mut self) -> Label {
        self.labels.push(None);
        Label(self.labels.len() - 1)
    }

    /// Puts a label here.
    pub(crate) fn bind(&mut self, label: Label) {
        self.labels[label.0] = Some(self.bytes.len());
    }

    fn byte(&mut self, byte: u8) {
        self.bytes.push(byte);
    }

    fn long(&mut self, value: i32) {
        self.bytes.extend_from_slice(&value.to_le_bytes());
    }

    /// ModRM and displacement: `reg`, and a register or an address. A short displacement counts in units.
    fn operands(&mut self, reg: u8, rm: Operand, unit: i32) {
        let reg = (reg & 7) << 3;
        match rm {
            Operand::Register(Vector(r)) => self.byte(0xC0 | reg | (r & 7)),
            // None of the base registers is one of those (rsp, r12; rbp, r13) that need another form.
            Operand::Memory(Address { base, offset }) => {
                let base = base as u8 & 7;
                let short = i8::try_from(offset / unit).ok();
                match short.filter(|_| offset % unit == 0) {
                    Some(0) => self.byte(reg | base),
                    Some(short) => {
                        self.byte(0x40 | reg | base);
                        self.byte(short as u8);
                    }
                    None => {
                        self.byte(0x80 | reg | base);
                        self.long(offset);
                    }
                }
            }
        }
    }

    /// A vector instruction on `reg`, `second` (stored inverted, so 0 means none) and `rm`, of which `read` bytes are
    /// read or written where it is memory.
    fn vector(
        &mut self,
        (opcode, read): (Opcode, i32),
        width: Width,
        reg: u8,
        second: u8,
        rm: Operand,
    ) {
        let is_high = matches!(rm, Operand::Register(Vector(16..)));
        if width == Width::Eight || reg >= 16 || second >= 16 || is_high {
            self.evex((opcode, read), width, (Mask(0), reg), second, rm);
        } else {
            self.vex(opcode, width, reg, second, rm);
        }
    }

    /// An EVEX instruction on numbers of 64 bits; the mask says which of `reg` are written, or selects.
    fn evex(
        &mut self,
        (opcode, read): (Opcode, i32),
        width: Width,
        (mask, reg): (Mask, u8),
        second: u8,
        rm: Operand,
    ) {
        // The five bits of registers; bit 4 of a register in `rm` is where that of an index would be.
        let (low, high) = match rm {
            Operand::Register(Vector(r)) => (r >> 3 & 1, r >> 4),
            Operand::Memory(address) => (address.base as u8 >> 3, 0),
        };
        let inverted = (reg >> 3 & 1) << 7 | high << 6 | low << 5 | (reg >> 4) << 4;
        self.byte(0x62);
        self.byte((!inverted & 0xF0) | opcode.map as u8);
        // W is 1 wherever numbers have 64 bits.
        self.byte(0x80 | (!second & 15) << 3 | 4 | opcode.prefix as u8);
        let length = match width {
            Width::One => 0,
            Width::Four => 0x20,
            Width::Eight => 0x40,
        };
        self.byte(length | (!second >> 4 & 1) << 3 | mask.0);
        self.byte(opcode.code);
        self.operands(reg, rm, read);
    }

    /// A VEX instruction.
    fn vex(&mut self, opcode: Opcode, width: Width, reg: u8, second: u8, rm: Operand) {
        let base = match rm {
            Operand::Register(Vector(r)) => r,
            Operand::Memory(address) => address.base as u8,
        };
        let long = if width == Width::Four { 4 } else { 0 };
        let tail = ((!second & 15) << 3) | long | opcode.prefix as u8;
        // R and B are stored inverted; X stays 1, no address has an index.
        let r = if reg < 8 { 0x80 } else { 0 };
        let b = if base < 8 { 0x20 } else { 0 };
        if opcode.map == Map::M0F && !opcode.w && b != 0 {
            self.byte(0xC5);
            self.byte(r | tail);
        } else {
            self.byte(0xC4);
            self.byte(r | 0x40 | b | opcode.map as u8);
            self.byte((u8::from(opcode.w) << 7) | tail);
        }
        self.byte(opcode.code);
        self.operands(reg, rm, 1);
    }

    /// `dst ← operation(a, b)`; the square root is that of `b`.
    pub(crate) fn float(&mut self, float: Float, width: Width, dst: Vector, a: Vector, b: Operand) {
        // The form for whole registers has no second source.
        let is_unary = float == Float::Sqrt && width != Width::One;
        let second = if is_unary { 0 } else { a.0 };
        let opcode = opcode(numbers(width), Map::M0F, false, float as u8);
        self.vector((opcode, bytes(width)), width, dst.0, second, b);
    }

    /// `dst ←` all bits one where the predicate holds, zero elsewhere.
    pub(crate) fn compare(
        &mut self,
        predicate: Predicate,
        width: Width,
        dst: Vector,
        a: Vector,
        b: Operand,
    ) {
        self.float(Float::Compare, width, dst, a, b);
        self.byte(predicate as u8);
    }

    pub(crate) fn bits(&mut self, bits: Bits, width: Width, dst: Vector, a: Vector, b: Operand) {
        let opcode = opcode(Prefix::P66, Map::M0F, false, bits as u8);
        self.vector((opcode, register_bytes(width)), width, dst.0, a.0, b);
    }

    /// Shifts each integer of 64 bits, filling with zeros.
    pub(crate) fn shift(&mut self, left: bool, bits: u8, width: Width, dst: Vector, a: Vector) {
        let opcode = opcode(Prefix::P66, Map::M0F, false, 0x73);
        let digit = if left { 6 } else { 2 };
        let operand = Operand::Register(a);
        self.vector((opcode, 1), width, digit, dst.0, operand);
        self.byte(bits);
    }

    pub(crate) fn fused(
        &mut self,
        (sign, order): (Sign, Order),
        width: Width,
        first: Vector,
        second: Vector,
        third: Operand,
    ) {
        // The form for one number follows that for a whole register.
        let single = u8::from(width == Width::One);
        let code = order as u8 + sign as u8 + single;
        let opcode = opcode(Prefix::P66, Map::M0F38, true, code);
        let what = (opcode, bytes(width));
        self.vector(what, width, first.0, second.0, third);
    }

    /// The bits of `dst` say where the predicate holds.
    pub(crate) fn compare_to_mask(
        &mut self,
        predicate: Predicate,
        width: Width,
        dst: Mask,
        a: Vector,
        b: Operand,
    ) {
        let opcode = opcode(numbers(width), Map::M0F, false, Float::Compare as u8);
        let what = (opcode, bytes(width));
        self.evex(what, width, (Mask(0), dst.0), a.0, b);
        self.byte(predicate as u8);
    }

    /// `dst ←` all bits one where those of the mask are one, zero elsewhere.
    pub(crate) fn spread(&mut self, width: Width, dst: Vector, from: Mask) {
        let opcode = opcode(Prefix::F3, Map::M0F38, true, 0x38);
        let operand = Operand::Register(Vector(from.0));
        self.evex((opcode, 1), width, (Mask(0), dst.0), 0, operand);
    }

    /// `dst ←` the sign bits of the numbers in a register.
    pub(crate) fn signs_to_mask(&mut self, width: Width, dst: Mask, from: Vector) {
        let opcode = opcode(Prefix::F3, Map::M0F38, true, 0x39);
        let operand = Operand::Register(from);
        self.evex((opcode, 1), width, (Mask(0), dst.0), 0, operand);
    }

    /// `dst ← b` where the bit of `mask` is one, `a` elsewhere.
    pub(crate) fn select(&mut self, width: Width, dst: Vector, a: Vector, b: Operand, mask: Mask) {
        let opcode = opcode(Prefix::P66, Map::M0F38, true, 0x65);
        let what = (opcode, register_bytes(width));
        self.evex(what, width, (mask, dst.0), a.0, b);
    }

    /// Sets the zero flag if no bit of an eight-bit mask is one.
    pub(crate) fn test_mask(&mut self, mask: Mask) {
        let opcode = opcode(Prefix::P66, Map::M0F, false, 0x98);
        let operand = Operand::Register(Vector(mask.0));
        self.vex(opcode, Width::One, mask.0, 0, operand);
    }

    /// The bits of an eight-bit mask.
    pub(crate) fn move_mask(&mut self, dst: Gpr, from: Mask) {
        let opcode = opcode(Prefix::P66, Map::M0F, false, 0x93);
        let operand = Operand::Register(Vector(from.0));
        self.vex(opcode, Width::One, dst as u8, 0, operand);
    }

    /// `dst ← b` where the sign bit of `mask` is set, `a` elsewhere.
    pub(crate) fn blend(&mut self, width: Width, dst: Vector, a: Vector, b: Operand, mask: Vector) {
        let opcode = opcode(Prefix::P66, Map::M0F3A, false, 0x4B);
        self.vex(opcode, width, dst.0, a.0, b);
        self.byte(mask.0 << 4);
    }

    /// `dst ← a` with its upper half replaced by the lower half of `b`.
    pub(crate) fn join(&mut self, dst: Vector, a: Vector, b: Vector) {
        let opcode = opcode(Prefix::P66, Map::M0F3A, false, 0x18);
        self.vex(opcode, Width::Four, dst.0, a.0, Operand::Register(b));
        self.byte(1);
    }

    /// The lower half of `dst ←` the upper half of `a`.
    pub(crate) fn upper_half(&mut self, dst: Vector, a: Vector) {
        let opcode = opcode(Prefix::P66, Map::M0F3A, false, 0x19);
        self.vex(opcode, Width::Four, a.0, 0, Operand::Register(dst));
        self.byte(1);
    }

    pub(crate) fn load(&mut self, width: Width, dst: Vector, from: Address) {
        let opcode = opcode(numbers(width), Map::M0F, false, 0x10);
        let what = (opcode, bytes(width));
        self.vector(what, width, dst.0, 0, Operand::Memory(from));
    }

    pub(crate) fn store(&mut self, width: Width, to: Address, from: Vector) {
        let opcode = opcode(numbers(width), Map::M0F, false, 0x11);
        let what = (opcode, bytes(width));
        self.vector(what, width, from.0, 0, Operand::Memory(to));
    }

    /// Copies a whole register.
    pub(crate) fn copy(&mut self, width: Width, dst: Vector, from: Vector) {
        let opcode = opcode(Prefix::P66, Map::M0F, false, 0x28);
        self.vector((opcode, 1), width, dst.0, 0, Operand::Register(from));
    }

    /// The sign bits of the numbers in a register, up to four.
    pub(crate) fn signs(&mut self, width: Width, dst: Gpr, from: Vector) {
        let opcode = opcode(Prefix::P66, Map::M0F, false, 0x50);
        self.vex(opcode, width, dst as u8, 0, Operand::Register(from));
    }

    /// Zeroes all but the lowest parts of registers 0 to 15, which code without VEX needs to run at full speed.
    pub(crate) fn zero_upper(&mut self) {
        self.bytes.extend_from_slice(&[0xC5, 0xF8, 0x77]);
    }

    fn rex(w: bool, reg: u8, rm: u8) -> u8 {
        0x40 | (u8::from(w) << 3) | ((reg >> 3) << 2) | (rm >> 3)
    }

    pub(crate) fn move_immediate(&mut self, dst: Gpr, value: u64) {
        let r = dst as u8;
        if let Ok(short) = u32::try_from(value) {
            // The upper half becomes zero.
            if r >= 8 {
                self.byte(Self::rex(false, 0, r));
            }
            self.byte(0xB8 | (r & 7));
            self.bytes.extend_from_slice(&short.to_le_bytes());
        } else {
            self.byte(Self::rex(true, 0, r));
            self.byte(0xB8 | (r & 7));
            self.bytes.extend_from_slice(&value.to_le_bytes());
        }
    }

    /// `dst ← dst and value`, in 32 bits; sets the zero flag.
    pub(crate) fn and_immediate(&mut self, dst: Gpr, value: i8) {
        self.byte(Self::rex(false, 0, dst as u8));
        self.byte(0x83);
        self.byte(0xE0 | (dst as u8 & 7));
        self.byte(value as u8);
    }

    /// `dst ← dst or from`, in 32 bits.
    pub(crate) fn or(&mut self, dst: Gpr, from: Gpr) {
        self.two(0x09, dst, from);
    }

    /// `dst ← from`, in 32 bits.
    pub(crate) fn move_register(&mut self, dst: Gpr, from: Gpr) {
        self.two(0x89, dst, from);
    }

    /// `dst ← 0`
    pub(crate) fn clear(&mut self, dst: Gpr) {
        self.two(0x31, dst, dst);
    }

    /// `dst ← dst + from`, in 64 bits.
    pub(crate) fn add_long(&mut self, dst: Gpr, from: Gpr) {
        self.two_of(true, 0x01, dst, from);
    }

    /// `dst ← from`, in 64 bits.
    pub(crate) fn move_long(&mut self, dst: Gpr, from: Gpr) {
        self.two_of(true, 0x89, dst, from);
    }

    fn two(&mut self, code: u8, dst: Gpr, from: Gpr) {
        self.two_of(false, code, dst, from);
    }

    fn two_of(&mut self, is_long: bool, code: u8, dst: Gpr, from: Gpr) {
        self.byte(Self::rex(is_long, from as u8, dst as u8));
        self.byte(code);
        self.byte(0xC0 | ((from as u8 & 7) << 3) | (dst as u8 & 7));
    }

    /// `dst ← dst − 1`, in 32 bits; sets the zero flag.
    pub(crate) fn decrement(&mut self, dst: Gpr) {
        self.byte(Self::rex(false, 0, dst as u8));
        self.byte(0xFF);
        self.byte(0xC8 | (dst as u8 & 7));
    }

    pub(crate) fn push(&mut self, r: Gpr) {
        self.byte(Self::rex(false, 0, r as u8));
        self.byte(0x50 | (r as u8 & 7));
    }

    pub(crate) fn pop(&mut self, r: Gpr) {
        self.byte(Self::rex(false, 0, r as u8));
        self.byte(0x58 | (r as u8 & 7));
    }

    pub(crate) fn jump(&mut self, condition: Condition, target: Label) {
        match condition {
            Condition::Always => self.byte(0xE9),
            Condition::Zero => self.bytes.extend_from_slice(&[0x0F, 0x84]),
            Condition::NotZero => self.bytes.extend_from_slice(&[0x0F, 0x85]),
        }
        self.fix(target);
    }

    /// Calls code of this buffer.
    pub(crate) fn call(&mut self, target: Label) {
        self.byte(0xE8);
        self.fix(target);
    }

    fn fix(&mut self, target: Label) {
        self.fixes.push((self.bytes.len(), target));
        self.long(0);
    }

    /// Calls the function whose address is in a register below r8.
    pub(crate) fn call_register(&mut self, r: Gpr) {
        self.bytes.extend_from_slice(&[0xFF, 0xD0 | (r as u8 & 7)]);
    }

    pub(crate) fn ret(&mut self) {
        self.byte(0xC3);
    }
}

#[cfg(test)]
mod tests;
