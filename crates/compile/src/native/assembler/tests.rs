//! What is emitted, read back by a disassembler.

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
        let operand = Operand::Register(Vector(r));
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
                let one = read(|x| x.float(float, Width::One, Vector(d), Vector(a), operand));
                assert_eq!(one, format!("{name}sd xmm{d}, xmm{a}, {single}"));
                let four = read(|x| x.float(float, Width::Four, Vector(d), Vector(a), operand));
                assert_eq!(four, format!("{name}pd ymm{d}, ymm{a}, {whole}"));
            }
        }
        let root = read(|x| x.float(Float::Sqrt, Width::One, Vector(9), Vector(3), operand));
        assert_eq!(root, format!("vsqrtsd xmm9, xmm3, {single}"));
        let roots = read(|x| x.float(Float::Sqrt, Width::Four, Vector(9), Vector(3), operand));
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
            let one = read(|x| x.bits(bits, Width::One, Vector(12), Vector(5), operand));
            assert_eq!(one, format!("{name} xmm12, xmm5, {single}"));
            let four = read(|x| x.bits(bits, Width::Four, Vector(12), Vector(5), operand));
            assert_eq!(four, format!("{name} ymm12, ymm5, {whole}"));
        }
    }
    for (d, a) in [(1, 2), (9, 2), (2, 9), (10, 11)] {
        let shifts = read(|x| {
            x.shift(true, 62, Width::One, Vector(d), Vector(a));
            x.shift(false, 52, Width::Four, Vector(d), Vector(a));
        });
        let expected = format!("vpsllq xmm{d}, xmm{a}, 3Eh\nvpsrlq ymm{d}, ymm{a}, 34h");
        assert_eq!(shifts, expected);
    }
}

/// The kinds of fused operations, and how a disassembler begins their names.
fn fused() -> Vec<((Sign, Order), String)> {
    let signs = [
        (Sign::Add, "vfmadd"),
        (Sign::Sub, "vfmsub"),
        (Sign::NegatedAdd, "vfnmadd"),
    ];
    let orders = [
        (Order::O132, "132"),
        (Order::O213, "213"),
        (Order::O231, "231"),
    ];
    let all = signs.into_iter().flat_map(|(sign, name)| {
        orders.map(|(order, digits)| ((sign, order), format!("{name}{digits}")))
    });
    all.collect()
}

#[test]
fn fused_operations_read_back_in_every_order() {
    for (operand, single, whole) in operands() {
        for (what, name) in fused() {
            let one = read(|x| x.fused(what, Width::One, Vector(4), Vector(13), operand));
            assert_eq!(one, format!("{name}sd xmm4, xmm13, {single}"));
            let four = read(|x| x.fused(what, Width::Four, Vector(13), Vector(4), operand));
            assert_eq!(four, format!("{name}pd ymm13, ymm4, {whole}"));
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
            let one = read(|x| x.compare(predicate, Width::One, Vector(2), Vector(14), operand));
            let (head, suffix) = one.split_once(' ').unwrap();
            assert_eq!(
                suffix.split(", ").take(3).collect::<Vec<_>>(),
                ["xmm2", "xmm14", &single]
            );
            assert!(head.contains(name.split('_').next().unwrap()), "{one}");
            let four = read(|x| x.compare(predicate, Width::Four, Vector(2), Vector(14), operand));
            assert!(four.contains(&format!("ymm2, ymm14, {whole}")), "{four}");
        }
        let blend = read(|x| x.blend(Width::Four, Vector(1), Vector(11), operand, Vector(15)));
        assert_eq!(blend, format!("vblendvpd ymm1, ymm11, {whole}, ymm15"));
    }
}

#[test]
fn moves_read_back() {
    for (base, name) in BASES {
        let text = read(|x| {
            x.load(Width::One, Vector(11), at(base, 8));
            x.load(Width::Four, Vector(3), at(base, 256));
            x.store(Width::One, at(base, 8), Vector(3));
            x.store(Width::Four, at(base, 256), Vector(11));
        });
        let expected = format!(
            "vmovsd xmm11, [{name}+8]\nvmovupd ymm3, [{name}+100h]\n\
             vmovsd [{name}+8], xmm3\nvmovupd [{name}+100h], ymm11"
        );
        assert_eq!(text, expected);
    }
    let text = read(|x| {
        x.copy(Width::One, Vector(1), Vector(12));
        x.copy(Width::Four, Vector(12), Vector(1));
        x.signs(Width::One, Gpr::Rax, Vector(9));
        x.signs(Width::Four, Gpr::Rax, Vector(1));
        x.join(Vector(3), Vector(10), Vector(11));
        x.upper_half(Vector(10), Vector(3));
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

/// The offset of a short displacement that counts in units, those beyond, and one that is no multiple.
const OFFSETS: [(i32, &str, usize); 7] = [
    (0, "", 0),
    (64, "+40h", 1),
    (127 * 64, "+1FC0h", 1),
    (-128 * 64, "-2000h", 1),
    (128 * 64, "+2000h", 4),
    (-129 * 64, "-2040h", 4),
    (72, "+48h", 4),
];

/// Operands of eight numbers, how a disassembler writes them, and the bytes of their displacements.
fn wide_operands() -> Vec<(Operand, String, usize)> {
    let registers = (0..32).map(|r| (Operand::Register(Vector(r)), format!("zmm{r}"), 0));
    let memory = BASES.into_iter().flat_map(|(base, name)| {
        OFFSETS.map(|(offset, text, length)| {
            let operand = Operand::Memory(at(base, offset));
            (operand, format!("[{name}{text}]"), length)
        })
    });
    registers.chain(memory).collect()
}

/// Pairs of registers in which every bit of a number differs once.
const PAIRS: [(u8, u8); 6] = [(0, 31), (31, 0), (7, 24), (8, 23), (16, 15), (21, 10)];

#[test]
fn eight_numbers_read_back_with_every_register_and_address() {
    let floats = [
        (Float::Add, "vaddpd"),
        (Float::Mul, "vmulpd"),
        (Float::Sub, "vsubpd"),
        (Float::Min, "vminpd"),
        (Float::Div, "vdivpd"),
        (Float::Max, "vmaxpd"),
    ];
    let all = [
        (Bits::And, "vandpd"),
        (Bits::Or, "vorpd"),
        (Bits::Xor, "vxorpd"),
        (Bits::AddInteger, "vpaddq"),
        (Bits::SubInteger, "vpsubq"),
    ];
    for (operand, text, _) in wide_operands() {
        for (d, a) in PAIRS {
            for (float, name) in floats {
                let eight = (Width::Eight, Vector(d), Vector(a));
                let line = read(|x| x.float(float, eight.0, eight.1, eight.2, operand));
                assert_eq!(line, format!("{name} zmm{d}, zmm{a}, {text}"));
            }
            for (bits, name) in all {
                let line = read(|x| x.bits(bits, Width::Eight, Vector(d), Vector(a), operand));
                assert_eq!(line, format!("{name} zmm{d}, zmm{a}, {text}"));
            }
            let root = read(|x| x.float(Float::Sqrt, Width::Eight, Vector(d), Vector(a), operand));
            assert_eq!(root, format!("vsqrtpd zmm{d}, {text}"));
        }
    }
}

#[test]
fn fused_operations_on_eight_numbers_read_back_in_every_order() {
    for (operand, text, _) in wide_operands() {
        for (what, name) in fused() {
            for (first, second) in PAIRS {
                let (a, b) = (Vector(first), Vector(second));
                let line = read(|x| x.fused(what, Width::Eight, a, b, operand));
                assert_eq!(line, format!("{name}pd zmm{first}, zmm{second}, {text}"));
            }
        }
    }
}

#[test]
fn masks_read_back() {
    for (operand, text, _) in wide_operands() {
        for k in 1..8 {
            for (predicate, name) in [
                (Predicate::Less, "lt_oq"),
                (Predicate::NotLess, "nlt"),
                (Predicate::NotLessEqual, "nle"),
            ] {
                let line = read(|x| {
                    let a = Vector(20 + k);
                    x.compare_to_mask(predicate, Width::Eight, Mask(k), a, operand);
                });
                let expected = format!("vcmp{name}pd k{k}, zmm{}, {text}", 20 + k);
                assert_eq!(line, expected);
            }
            for (d, a) in PAIRS {
                let mask = Mask(k);
                let line = read(|x| x.select(Width::Eight, Vector(d), Vector(a), operand, mask));
                // The disassembler writes the mask after what is written.
                let expected = format!("vblendmpd zmm{d}{{k{k}}}, zmm{a}, {text}");
                assert_eq!(line, expected);
            }
        }
    }
    for k in 1..8 {
        for r in [0, 7, 8, 15, 16, 31] {
            let lines = read(|x| {
                x.spread(Width::Eight, Vector(r), Mask(k));
                x.signs_to_mask(Width::Eight, Mask(k), Vector(r));
                x.test_mask(Mask(k));
                x.move_mask(Gpr::Rax, Mask(k));
                x.move_mask(Gpr::R9, Mask(k));
            });
            let expected = format!(
                "vpmovm2q zmm{r}, k{k}\nvpmovq2m k{k}, zmm{r}\nkortestb k{k}, k{k}\n\
                 kmovb eax, k{k}\nkmovb r9d, k{k}"
            );
            assert_eq!(lines, expected);
        }
    }
}

#[test]
fn moves_and_shifts_of_eight_numbers_read_back() {
    for (base, name) in BASES {
        for (offset, text, length) in OFFSETS {
            for r in [0, 7, 8, 15, 16, 31] {
                let mut assembler = Assembler::default();
                assembler.load(Width::Eight, Vector(r), at(base, offset));
                // Prefix, opcode and operands, and as few bytes for the displacement as there may be.
                assert_eq!(assembler.finish().unwrap().len(), 6 + length);
                let lines = read(|x| {
                    x.load(Width::Eight, Vector(r), at(base, offset));
                    x.store(Width::Eight, at(base, offset), Vector(r));
                });
                let place = format!("[{name}{text}]");
                let expected = format!("vmovupd zmm{r}, {place}\nvmovupd {place}, zmm{r}");
                assert_eq!(lines, expected);
            }
        }
    }
    for (d, a) in PAIRS {
        let lines = read(|x| {
            x.copy(Width::Eight, Vector(d), Vector(a));
            x.shift(true, 62, Width::Eight, Vector(d), Vector(a));
            x.shift(false, 52, Width::Eight, Vector(d), Vector(a));
        });
        let expected = format!(
            "vmovapd zmm{d}, zmm{a}\nvpsllq zmm{d}, zmm{a}, 3Eh\nvpsrlq zmm{d}, zmm{a}, 34h"
        );
        assert_eq!(lines, expected);
    }
}

#[test]
fn narrow_instructions_reach_registers_beyond_the_first_sixteen() {
    let memory = |offset| Operand::Memory(at(Gpr::Rdi, offset));
    let lines = read(|x| {
        x.float(Float::Add, Width::One, Vector(17), Vector(2), memory(24));
        x.float(Float::Mul, Width::Four, Vector(3), Vector(30), memory(96));
        let high = Operand::Register(Vector(25));
        x.fused(
            (Sign::Add, Order::O231),
            Width::One,
            Vector(1),
            Vector(2),
            high,
        );
        x.bits(Bits::Xor, Width::One, Vector(16), Vector(16), memory(48));
        x.store(Width::One, at(Gpr::Rcx, 40), Vector(31));
    });
    let expected = "vaddsd xmm17, xmm2, [rdi+18h]\nvmulpd ymm3, ymm30, [rdi+60h]\n\
                    vfmadd231sd xmm1, xmm2, xmm25\nvxorpd xmm16, xmm16, [rdi+30h]\n\
                    vmovsd [rcx+28h], xmm31";
    assert_eq!(lines, expected);
}
