//! Encodes the x86-64 instructions that the emitter uses.
//!
//! Vector instructions have the VEX form (Intel 64 and IA-32 Architectures Software Developer's Manual, volume 2,
//! section 2.3): `dst ← op(src1, src2)` with `src2` a register or memory. The tests read every encoding back with a
//! disassembler that shares nothing with this file.

/// A vector register, ymm0 to ymm15; its low part is the xmm register of the same number.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(crate) struct Ymm(pub(crate) u8);

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

/// An address: a register and a displacement.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(crate) struct Address {
    pub(crate) base: Gpr,
    pub(crate) offset: i32,
}

/// The operand that may be in memory.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(crate) enum Operand {
    Register(Ymm),
    Memory(Address),
}

/// How many numbers an instruction works on.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(crate) enum Width {
    /// One number in the low part of a register.
    One,
    /// Four numbers.
    Four,
}

impl Width {
    pub(crate) fn lanes(self) -> usize {
        match self {
            Width::One => 1,
            Width::Four => 4,
        }
    }
}

/// The mandatory prefix, as the VEX prefix counts them.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Prefix {
    P66 = 1,
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

    /// ModRM and displacement: `reg`, and a register or an address.
    fn operands(&mut self, reg: u8, rm: Operand) {
        let reg = (reg & 7) << 3;
        match rm {
            Operand::Register(Ymm(r)) => self.byte(0xC0 | reg | (r & 7)),
            // None of the base registers is one of those (rsp, r12; rbp, r13) that need another form.
            Operand::Memory(Address { base, offset }) => {
                let base = base as u8 & 7;
                if offset == 0 {
                    self.byte(reg | base);
                } else if let Ok(short) = i8::try_from(offset) {
                    self.byte(0x40 | reg | base);
                    self.byte(short as u8);
                } else {
                    self.byte(0x80 | reg | base);
                    self.long(offset);
                }
            }
        }
    }

    /// A VEX instruction on `reg`, `second` (15 less what is stored, so 0 means none) and `rm`.
    fn vex(&mut self, opcode: Opcode, width: Width, reg: u8, second: u8, rm: Operand) {
        let base = match rm {
            Operand::Register(Ymm(r)) => r,
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
        self.operands(reg, rm);
    }

    /// `dst ← operation(a, b)`; the square root is that of `b`.
    pub(crate) fn float(&mut self, float: Float, width: Width, dst: Ymm, a: Ymm, b: Operand) {
        let prefix = match width {
            Width::One => Prefix::F2,
            Width::Four => Prefix::P66,
        };
        // The form for whole registers has no second source.
        let is_unary = float == Float::Sqrt && width == Width::Four;
        let second = if is_unary { 0 } else { a.0 };
        let opcode = opcode(prefix, Map::M0F, false, float as u8);
        self.vex(opcode, width, dst.0, second, b);
    }

    /// `dst ←` all bits one where the predicate holds, zero elsewhere.
    pub(crate) fn compare(
        &mut self,
        predicate: Predicate,
        width: Width,
        dst: Ymm,
        a: Ymm,
        b: Operand,
    ) {
        self.float(Float::Compare, width, dst, a, b);
        self.byte(predicate as u8);
    }

    pub(crate) fn bits(&mut self, bits: Bits, width: Width, dst: Ymm, a: Ymm, b: Operand) {
        let opcode = opcode(Prefix::P66, Map::M0F, false, bits as u8);
        self.vex(opcode, width, dst.0, a.0, b);
    }

    /// Shifts each integer of 64 bits, filling with zeros.
    pub(crate) fn shift(&mut self, left: bool, bits: u8, width: Width, dst: Ymm, a: Ymm) {
        let opcode = opcode(Prefix::P66, Map::M0F, false, 0x73);
        let digit = if left { 6 } else { 2 };
        self.vex(opcode, width, digit, dst.0, Operand::Register(a));
        self.byte(bits);
    }

    pub(crate) fn fused(
        &mut self,
        (sign, order): (Sign, Order),
        width: Width,
        first: Ymm,
        second: Ymm,
        third: Operand,
    ) {
        // The form for one number follows that for a whole register.
        let single = u8::from(width == Width::One);
        let code = order as u8 + sign as u8 + single;
        let opcode = opcode(Prefix::P66, Map::M0F38, true, code);
        self.vex(opcode, width, first.0, second.0, third);
    }

    /// `dst ← b` where the sign bit of `mask` is set, `a` elsewhere.
    pub(crate) fn blend(&mut self, width: Width, dst: Ymm, a: Ymm, b: Operand, mask: Ymm) {
        let opcode = opcode(Prefix::P66, Map::M0F3A, false, 0x4B);
        self.vex(opcode, width, dst.0, a.0, b);
        self.byte(mask.0 << 4);
    }

    /// `dst ← a` with its upper half replaced by the lower half of `b`.
    pub(crate) fn join(&mut self, dst: Ymm, a: Ymm, b: Ymm) {
        let opcode = opcode(Prefix::P66, Map::M0F3A, false, 0x18);
        self.vex(opcode, Width::Four, dst.0, a.0, Operand::Register(b));
        self.byte(1);
    }

    /// The lower half of `dst ←` the upper half of `a`.
    pub(crate) fn upper_half(&mut self, dst: Ymm, a: Ymm) {
        let opcode = opcode(Prefix::P66, Map::M0F3A, false, 0x19);
        self.vex(opcode, Width::Four, a.0, 0, Operand::Register(dst));
        self.byte(1);
    }

    pub(crate) fn load(&mut self, width: Width, dst: Ymm, from: Address) {
        let opcode = opcode(Self::move_prefix(width), Map::M0F, false, 0x10);
        self.vex(opcode, width, dst.0, 0, Operand::Memory(from));
    }

    pub(crate) fn store(&mut self, width: Width, to: Address, from: Ymm) {
        let opcode = opcode(Self::move_prefix(width), Map::M0F, false, 0x11);
        self.vex(opcode, width, from.0, 0, Operand::Memory(to));
    }

    fn move_prefix(width: Width) -> Prefix {
        match width {
            Width::One => Prefix::F2,
            Width::Four => Prefix::P66,
        }
    }

    /// Copies a whole register.
    pub(crate) fn copy(&mut self, width: Width, dst: Ymm, from: Ymm) {
        let opcode = opcode(Prefix::P66, Map::M0F, false, 0x28);
        self.vex(opcode, width, dst.0, 0, Operand::Register(from));
    }

    /// The sign bits of the numbers in a register.
    pub(crate) fn signs(&mut self, width: Width, dst: Gpr, from: Ymm) {
        let opcode = opcode(Prefix::P66, Map::M0F, false, 0x50);
        self.vex(opcode, width, dst as u8, 0, Operand::Register(from));
    }

    /// Zeroes the upper halves of all registers, which code without VEX needs to run at full speed.
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
mod tests {
    use super::*;
    use iced_x86::{Decoder, DecoderOptions, Formatter, NasmFormatter};

    /// What a disassembler reads, one instruction a line.
    fn read(assemble: impl FnOnce(&mut Assembler)) -> String {
        let mut assembler = Assembler::default();
        assemble(&mut assembler);
        let bytes = assembler.finish().unwrap();
        let mut formatter = NasmFormatter::new();
        formatter.options_mut().set_first_operand_char_index(0);
        formatter
            .options_mut()
            .set_space_after_operand_separator(true);
        let mut lines = Vec::new();
        for instruction in &mut Decoder::new(64, &bytes, DecoderOptions::NONE) {
            assert!(!instruction.is_invalid(), "{bytes:x?}");
            let mut line = String::new();
            formatter.format(&instruction, &mut line);
            lines.push(line);
        }
        lines.join("\n")
    }

    fn at(base: Gpr, offset: i32) -> Address {
        Address { base, offset }
    }

    const BASES: [(Gpr, &str); 5] = [
        (Gpr::Rdi, "rdi"),
        (Gpr::Rsi, "rsi"),
        (Gpr::Rdx, "rdx"),
        (Gpr::Rcx, "rcx"),
        (Gpr::R8, "r8"),
    ];

    /// Registers and addresses of every kind, and how a disassembler writes them.
    fn operands() -> Vec<(Operand, String, String)> {
        let mut operands = Vec::new();
        for r in 0..16 {
            let operand = Operand::Register(Ymm(r));
            operands.push((operand, format!("xmm{r}"), format!("ymm{r}")));
        }
        for (base, name) in BASES {
            for (offset, text) in [
                (0, ""),
                (127, "+7Fh"),
                (-128, "-80h"),
                (128, "+80h"),
                (0x1234, "+1234h"),
            ] {
                let operand = Operand::Memory(at(base, offset));
                let text = format!("[{name}{text}]");
                operands.push((operand, text.clone(), text));
            }
        }
        operands
    }

    #[test]
    fn arithmetic_reads_back_with_every_register_and_address() {
        let floats = [
            (Float::Add, "vadd"),
            (Float::Mul, "vmul"),
            (Float::Sub, "vsub"),
            (Float::Min, "vmin"),
            (Float::Div, "vdiv"),
            (Float::Max, "vmax"),
        ];
        for (operand, single, whole) in operands() {
            for (float, name) in floats {
                for (d, a) in [(0, 15), (15, 0), (7, 8), (8, 7)] {
                    let one = read(|x| x.float(float, Width::One, Ymm(d), Ymm(a), operand));
                    assert_eq!(one, format!("{name}sd xmm{d}, xmm{a}, {single}"));
                    let four = read(|x| x.float(float, Width::Four, Ymm(d), Ymm(a), operand));
                    assert_eq!(four, format!("{name}pd ymm{d}, ymm{a}, {whole}"));
                }
            }
            let root = read(|x| x.float(Float::Sqrt, Width::One, Ymm(9), Ymm(3), operand));
            assert_eq!(root, format!("vsqrtsd xmm9, xmm3, {single}"));
            let roots = read(|x| x.float(Float::Sqrt, Width::Four, Ymm(9), Ymm(3), operand));
            assert_eq!(roots, format!("vsqrtpd ymm9, {whole}"));
        }
    }

    #[test]
    fn operations_on_bits_read_back() {
        let all = [
            (Bits::And, "vandpd"),
            (Bits::Or, "vorpd"),
            (Bits::Xor, "vxorpd"),
            (Bits::AddInteger, "vpaddq"),
            (Bits::SubInteger, "vpsubq"),
            (Bits::UnpackLow, "vunpcklpd"),
            (Bits::UnpackHigh, "vunpckhpd"),
        ];
        for (operand, single, whole) in operands() {
            for (bits, name) in all {
                let one = read(|x| x.bits(bits, Width::One, Ymm(12), Ymm(5), operand));
                assert_eq!(one, format!("{name} xmm12, xmm5, {single}"));
                let four = read(|x| x.bits(bits, Width::Four, Ymm(12), Ymm(5), operand));
                assert_eq!(four, format!("{name} ymm12, ymm5, {whole}"));
            }
        }
        for (d, a) in [(1, 2), (9, 2), (2, 9), (10, 11)] {
            let shifts = read(|x| {
                x.shift(true, 62, Width::One, Ymm(d), Ymm(a));
                x.shift(false, 52, Width::Four, Ymm(d), Ymm(a));
            });
            let expected = format!("vpsllq xmm{d}, xmm{a}, 3Eh\nvpsrlq ymm{d}, ymm{a}, 34h");
            assert_eq!(shifts, expected);
        }
    }

    #[test]
    fn fused_operations_read_back_in_every_order() {
        for (operand, single, whole) in operands() {
            for (sign, name) in [
                (Sign::Add, "vfmadd"),
                (Sign::Sub, "vfmsub"),
                (Sign::NegatedAdd, "vfnmadd"),
            ] {
                for (order, digits) in [
                    (Order::O132, "132"),
                    (Order::O213, "213"),
                    (Order::O231, "231"),
                ] {
                    let what = (sign, order);
                    let one = read(|x| x.fused(what, Width::One, Ymm(4), Ymm(13), operand));
                    assert_eq!(one, format!("{name}{digits}sd xmm4, xmm13, {single}"));
                    let four = read(|x| x.fused(what, Width::Four, Ymm(13), Ymm(4), operand));
                    assert_eq!(four, format!("{name}{digits}pd ymm13, ymm4, {whole}"));
                }
            }
        }
    }

    #[test]
    fn comparisons_and_selections_read_back() {
        for (operand, single, whole) in operands() {
            for (predicate, name) in [
                (Predicate::Less, "lt_oq"),
                (Predicate::NotLess, "nlt_us"),
                (Predicate::NotLessEqual, "nle_us"),
            ] {
                let one = read(|x| x.compare(predicate, Width::One, Ymm(2), Ymm(14), operand));
                let (head, suffix) = one.split_once(' ').unwrap();
                assert_eq!(
                    suffix.split(", ").take(3).collect::<Vec<_>>(),
                    ["xmm2", "xmm14", &single]
                );
                assert!(head.contains(name.split('_').next().unwrap()), "{one}");
                let four = read(|x| x.compare(predicate, Width::Four, Ymm(2), Ymm(14), operand));
                assert!(four.contains(&format!("ymm2, ymm14, {whole}")), "{four}");
            }
            let blend = read(|x| x.blend(Width::Four, Ymm(1), Ymm(11), operand, Ymm(15)));
            assert_eq!(blend, format!("vblendvpd ymm1, ymm11, {whole}, ymm15"));
        }
    }

    #[test]
    fn moves_read_back() {
        for (base, name) in BASES {
            let text = read(|x| {
                x.load(Width::One, Ymm(11), at(base, 8));
                x.load(Width::Four, Ymm(3), at(base, 256));
                x.store(Width::One, at(base, 8), Ymm(3));
                x.store(Width::Four, at(base, 256), Ymm(11));
            });
            let expected = format!(
                "vmovsd xmm11, [{name}+8]\nvmovupd ymm3, [{name}+100h]\n\
                 vmovsd [{name}+8], xmm3\nvmovupd [{name}+100h], ymm11"
            );
            assert_eq!(text, expected);
        }
        let text = read(|x| {
            x.copy(Width::One, Ymm(1), Ymm(12));
            x.copy(Width::Four, Ymm(12), Ymm(1));
            x.signs(Width::One, Gpr::Rax, Ymm(9));
            x.signs(Width::Four, Gpr::Rax, Ymm(1));
            x.join(Ymm(3), Ymm(10), Ymm(11));
            x.upper_half(Ymm(10), Ymm(3));
            x.zero_upper();
        });
        let expected =
            "vmovapd xmm1, xmm12\nvmovapd ymm12, ymm1\nvmovmskpd eax, xmm9\nvmovmskpd eax, ymm1\n\
                        vinsertf128 ymm3, ymm10, xmm11, 1\nvextractf128 xmm10, ymm3, 1\nvzeroupper";
        assert_eq!(text, expected);
    }

    #[test]
    fn general_instructions_read_back() {
        let text = read(|x| {
            x.move_immediate(Gpr::Rax, 0x1234_5678_9ABC_DEF0);
            x.move_immediate(Gpr::Rsi, 77);
            x.move_immediate(Gpr::R8, 77);
            x.add_long(Gpr::Rdi, Gpr::R10);
            x.move_long(Gpr::Rsi, Gpr::R11);
            x.and_immediate(Gpr::Rax, 15);
            x.or(Gpr::R9, Gpr::Rax);
            x.move_register(Gpr::Rax, Gpr::R9);
            x.clear(Gpr::R9);
            x.decrement(Gpr::R8);
            x.push(Gpr::Rdi);
            x.pop(Gpr::R9);
            x.call_register(Gpr::Rax);
            x.ret();
        });
        let expected = "mov rax, 123456789ABCDEF0h\nmov esi, 4Dh\nmov r8d, 4Dh\nadd rdi, r10\nmov rsi, r11\nand eax, 0Fh\n\
                        or r9d, eax\nmov eax, r9d\nxor r9d, r9d\ndec r8d\npush rdi\npop r9\ncall rax\nret";
        assert_eq!(text, expected);
    }

    #[test]
    fn jumps_reach_their_labels() {
        let text = read(|x| {
            let (back, forward) = (x.label(), x.label());
            x.bind(back);
            x.jump(Condition::NotZero, forward);
            x.jump(Condition::Zero, back);
            x.jump(Condition::Always, back);
            x.call(forward);
            x.bind(forward);
            x.ret();
        });
        // Six bytes, six, five, five, then the forward label at 22.
        let expected = "jne near 0000000000000016h\nje near 0\njmp 0\ncall 0000000000000016h\nret";
        assert_eq!(text, expected);
        let mut open = Assembler::default();
        let label = open.label();
        open.call(label);
        assert_eq!(open.finish(), None);
    }
}
