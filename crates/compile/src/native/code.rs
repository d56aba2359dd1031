//! Straight-line code between the program and the machine: every value is computed once, by one instruction of the
//! processor, and lives wherever [`registers`](super::registers) puts it.
//!
//! Kernels of functions and unrolled factorizations are written out here, so that their values compete for
//! registers with everything around them.

use super::assembler::{Bits, Float, Predicate, Sign, Width};
use super::registers::MOST_REGISTERS;
use crate::native::call::Helper;
use std::collections::HashMap;

/// A value, computed once.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(crate) struct Value(pub(crate) u32);

impl Value {
    pub(crate) fn index(self) -> usize {
        self.0 as usize
    }
}

/// What an address counts from.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(crate) enum Base {
    /// Storage of one's own: constants, spilled values, arguments of calls.
    Frame,
    /// The state given.
    Variables,
    /// The register file of the prologue: parameters and what depends on them only.
    File,
    /// Where outputs are written.
    Outputs,
}

/// A place in memory.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(crate) struct Place {
    pub(crate) base: Base,
    /// In bytes.
    pub(crate) offset: i32,
}

/// An operation of the processor on registers.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(crate) enum Operation {
    /// On two operands; the square root, on one, twice.
    Float(Float),
    Bits(Bits),
    Compare(Predicate),
    Shift {
        left: bool,
        bits: u8,
    },
    /// `± a · b ± c`
    Fused(Sign),
    /// `b` where the sign bit of `c` is set, `a` elsewhere.
    Blend,
    /// The lower halves of `a` and `b`.
    Join,
    /// The upper half of `a`.
    UpperHalf,
}

impl Operation {
    /// How many operands.
    pub(crate) fn arity(self) -> usize {
        match self {
            Operation::Float(Float::Sqrt) | Operation::Shift { .. } | Operation::UpperHalf => 1,
            Operation::Float(_) | Operation::Bits(_) | Operation::Compare(_) | Operation::Join => 2,
            Operation::Fused(_) | Operation::Blend => 3,
        }
    }

    /// Whether the operands may be exchanged.
    pub(crate) fn is_commutative(self) -> bool {
        matches!(
            self,
            Operation::Float(Float::Add | Float::Mul)
                | Operation::Bits(Bits::And | Bits::Or | Bits::Xor | Bits::AddInteger)
        )
    }
}

/// One step of straight-line code.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Op {
    Apply {
        operation: Operation,
        width: Width,
        out: Value,
        /// As many as the operation has; the others repeat the first.
        operands: [Value; 3],
    },
    /// Sine and cosine, until [`gather`](super::gather) writes their kernel.
    Angle {
        argument: Value,
        sin: Value,
        cos: Value,
    },
    /// Replaces the quick results by those of `slow` where the sign bit of `bad` is set.
    Guard {
        slow: Helper,
        width: Width,
        bad: Value,
        argument: Value,
        quick: [Option<Value>; 2],
        out: [Option<Value>; 2],
    },
    Store {
        width: Width,
        value: Value,
        to: Place,
    },
    /// Calls a function of this crate on cells of the frame. Its results are values at home in cells.
    Call { helper: Helper, cells: i32 },
    /// The states where the sign bit of `bad` is set have no result.
    Fail { width: Width, bad: Value },
    /// The end of a group of outputs.
    End,
}

impl Op {
    /// Calls `visit` for every value read, equal ones more than once.
    pub(crate) fn for_each_read(&self, mut visit: impl FnMut(Value)) {
        match self {
            Op::Apply {
                operation,
                operands,
                ..
            } => operands[..operation.arity()].iter().for_each(|&v| visit(v)),
            Op::Guard {
                bad,
                argument,
                quick,
                ..
            } => {
                visit(*bad);
                visit(*argument);
                quick.iter().flatten().for_each(|&v| visit(v));
            }
            Op::Angle { argument, .. } => visit(*argument),
            Op::Store { value, .. } => visit(*value),
            Op::Fail { bad, .. } => visit(*bad),
            Op::Call { .. } | Op::End => {}
        }
    }

    /// Calls `visit` for every value computed.
    pub(crate) fn for_each_write(&self, mut visit: impl FnMut(Value)) {
        match self {
            Op::Apply { out, .. } => visit(*out),
            Op::Angle { sin, cos, .. } => [*sin, *cos].into_iter().for_each(visit),
            Op::Guard { out, .. } => out.iter().flatten().for_each(|&v| visit(v)),
            Op::Store { .. } | Op::Call { .. } | Op::Fail { .. } | Op::End => {}
        }
    }

    /// The same on other values read.
    pub(crate) fn map_reads(mut self, read: impl Fn(Value) -> Value) -> Op {
        match &mut self {
            Op::Apply { operands, .. } => *operands = operands.map(read),
            Op::Angle { argument, .. } => *argument = read(*argument),
            Op::Guard {
                bad,
                argument,
                quick,
                ..
            } => {
                *bad = read(*bad);
                *argument = read(*argument);
                *quick = quick.map(|value| value.map(&read));
            }
            Op::Store { value, .. } => *value = read(*value),
            Op::Fail { bad, .. } => *bad = read(*bad),
            Op::Call { .. } | Op::End => {}
        }
        self
    }
}

/// What is known of a value.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct Info {
    pub(crate) width: Width,
    /// Where it is in memory without being stored.
    pub(crate) home: Option<Place>,
    /// The bits of a constant.
    pub(crate) constant: Option<u64>,
}

/// Straight-line code, and what its frame holds.
#[derive(Clone, Debug)]
pub(crate) struct Code {
    pub(crate) ops: Vec<Op>,
    /// By value.
    pub(crate) values: Vec<Info>,
    /// Contents of the frame at the start: offset, bits, and how many copies.
    pub(crate) initial: Vec<(i32, u64, usize)>,
    /// Bytes of the frame in use.
    pub(crate) frame: i32,
}

/// Writes straight-line code.
#[derive(Debug)]
pub(crate) struct Builder {
    code: Code,
    constants: HashMap<(u64, Width), Value>,
    has_angles: bool,
    /// The width of what is being written; differs from that of the code where several values of one state share
    /// a register.
    pub(crate) width: Width,
}

impl Builder {
    pub(crate) fn new(width: Width) -> Builder {
        Builder {
            code: Code {
                ops: Vec::new(),
                values: Vec::new(),
                initial: Vec::new(),
                frame: SCRATCH_END,
            },
            constants: HashMap::new(),
            has_angles: false,
            width,
        }
    }

    /// The code, without what nothing needs.
    pub(crate) fn finish(mut self) -> Code {
        if self.has_angles {
            super::gather::expand(&mut self);
        }
        self.code.drop_unused();
        self.code
    }

    /// Takes what has been written, to write it anew.
    pub(crate) fn take_ops(&mut self) -> Vec<Op> {
        std::mem::take(&mut self.code.ops)
    }

    pub(crate) fn value_count(&self) -> usize {
        self.code.values.len()
    }

    /// Sine and cosine; in code for single states the kernel is written last, for several angles at once.
    pub(crate) fn sin_cos(&mut self, argument: Value) -> (Value, Value) {
        if self.width != Width::One {
            return super::kernels::sin_cos(self, argument);
        }
        let (sin, cos) = (self.value(None, None), self.value(None, None));
        self.push(Op::Angle { argument, sin, cos });
        self.has_angles = true;
        (sin, cos)
    }

    fn value(&mut self, home: Option<Place>, constant: Option<u64>) -> Value {
        let value = Value(self.code.values.len() as u32);
        self.code.values.push(Info {
            width: self.width,
            home,
            constant,
        });
        value
    }

    /// Room in the frame for `count` values, at an offset.
    pub(crate) fn cells(&mut self, count: usize) -> i32 {
        let size = self.width.lanes() as i32 * 8;
        // Aligned to their size, so that none crosses a cache line.
        let offset = (self.code.frame + size - 1) / size * size;
        self.code.frame = offset + count as i32 * size;
        offset
    }

    /// Room for `count` values that are not a number until they are written.
    pub(crate) fn unknown_cells(&mut self, count: usize) -> i32 {
        let offset = self.cells(count);
        let copies = count * self.width.lanes();
        self.code.initial.push((offset, f64::NAN.to_bits(), copies));
        offset
    }

    /// A value in memory.
    pub(crate) fn at(&mut self, base: Base, offset: i32) -> Value {
        self.value(Some(Place { base, offset }), None)
    }

    /// A cell of the frame as a place.
    pub(crate) fn cell(&self, cells: i32, index: usize) -> Place {
        Place {
            base: Base::Frame,
            offset: cells + (index * self.width.lanes() * 8) as i32,
        }
    }

    pub(crate) fn constant(&mut self, value: f64) -> Value {
        self.constant_bits(value.to_bits())
    }

    pub(crate) fn constant_bits(&mut self, bits: u64) -> Value {
        if let Some(&value) = self.constants.get(&(bits, self.width)) {
            return value;
        }
        let offset = self.cells(1);
        let place = self.cell(offset, 0);
        self.code.initial.push((offset, bits, self.width.lanes()));
        let value = self.value(Some(place), Some(bits));
        self.constants.insert((bits, self.width), value);
        value
    }

    /// Whether a value is the constant zero.
    pub(crate) fn is_zero(&self, value: Value) -> bool {
        let constant = self.code.values[value.index()].constant;
        constant.is_some_and(|bits| f64::from_bits(bits) == 0.0)
    }

    pub(crate) fn push(&mut self, op: Op) {
        self.code.ops.push(op);
    }

    fn apply(&mut self, operation: Operation, operands: [Value; 3]) -> Value {
        let out = self.value(None, None);
        self.push(Op::Apply {
            operation,
            width: self.width,
            out,
            operands,
        });
        out
    }

    pub(crate) fn float(&mut self, float: Float, a: Value, b: Value) -> Value {
        self.apply(Operation::Float(float), [a, b, a])
    }

    pub(crate) fn add(&mut self, a: Value, b: Value) -> Value {
        self.float(Float::Add, a, b)
    }

    pub(crate) fn sub(&mut self, a: Value, b: Value) -> Value {
        self.float(Float::Sub, a, b)
    }

    pub(crate) fn mul(&mut self, a: Value, b: Value) -> Value {
        self.float(Float::Mul, a, b)
    }

    pub(crate) fn bits(&mut self, bits: Bits, a: Value, b: Value) -> Value {
        self.apply(Operation::Bits(bits), [a, b, a])
    }

    pub(crate) fn compare(&mut self, predicate: Predicate, a: Value, b: Value) -> Value {
        self.apply(Operation::Compare(predicate), [a, b, a])
    }

    pub(crate) fn shift_left(&mut self, a: Value, bits: u8) -> Value {
        self.apply(Operation::Shift { left: true, bits }, [a; 3])
    }

    pub(crate) fn shift_right(&mut self, a: Value, bits: u8) -> Value {
        self.apply(Operation::Shift { left: false, bits }, [a; 3])
    }

    /// `a · b + c`
    pub(crate) fn mul_add(&mut self, a: Value, b: Value, c: Value) -> Value {
        self.apply(Operation::Fused(Sign::Add), [a, b, c])
    }

    /// `a · b − c`
    pub(crate) fn mul_sub(&mut self, a: Value, b: Value, c: Value) -> Value {
        self.apply(Operation::Fused(Sign::Sub), [a, b, c])
    }

    /// `c − a · b`
    pub(crate) fn neg_mul_add(&mut self, a: Value, b: Value, c: Value) -> Value {
        self.apply(Operation::Fused(Sign::NegatedAdd), [a, b, c])
    }

    /// `b` where the sign bit of `mask` is set, `a` elsewhere.
    pub(crate) fn blend(&mut self, a: Value, b: Value, mask: Value) -> Value {
        self.apply(Operation::Blend, [a, b, mask])
    }

    /// An operation on halves of registers, or whose result fills a register though it works on one half.
    pub(crate) fn wide(&mut self, operation: Operation, operands: [Value; 3]) -> Value {
        let narrow = std::mem::replace(&mut self.width, Width::Four);
        let out = self.value(None, None);
        self.width = narrow;
        self.push(Op::Apply {
            operation,
            width: narrow,
            out,
            operands,
        });
        out
    }

    /// The upper half of `a`.
    pub(crate) fn upper_half(&mut self, a: Value) -> Value {
        self.wide(Operation::UpperHalf, [a; 3])
    }

    pub(crate) fn sqrt(&mut self, a: Value) -> Value {
        self.float(Float::Sqrt, a, a)
    }

    pub(crate) fn abs(&mut self, a: Value) -> Value {
        let mask = self.constant_bits(!SIGN);
        self.bits(Bits::And, a, mask)
    }

    pub(crate) fn neg(&mut self, a: Value) -> Value {
        let mask = self.constant_bits(SIGN);
        self.bits(Bits::Xor, a, mask)
    }

    /// The quick results, or those of `slow` where the sign bit of `bad` is set.
    pub(crate) fn guard<const N: usize>(
        &mut self,
        slow: Helper,
        bad: Value,
        argument: Value,
        quick: [Value; N],
    ) -> [Value; N] {
        let outs: [Value; N] = std::array::from_fn(|_| self.value(None, None));
        let pair = |values: &[Value]| [values.first().copied(), values.get(1).copied()];
        self.push(Op::Guard {
            slow,
            width: self.width,
            bad,
            argument,
            quick: pair(&quick),
            out: pair(&outs),
        });
        outs
    }

    pub(crate) fn store(&mut self, value: Value, to: Place) {
        self.push(Op::Store {
            width: self.width,
            value,
            to,
        });
    }

    pub(crate) fn fail(&mut self, bad: Value) {
        self.push(Op::Fail {
            width: self.width,
            bad,
        });
    }

    /// Calls `helper` on `arguments` in cells that begin where its results do; the results.
    pub(crate) fn call(
        &mut self,
        helper: Helper,
        arguments: &[Value],
        results: usize,
    ) -> Vec<Value> {
        let cells = self.cells(arguments.len().max(results));
        for (i, &argument) in arguments.iter().enumerate() {
            self.store(argument, self.cell(cells, i));
        }
        self.push(Op::Call { helper, cells });
        (0..results)
            .map(|i| {
                let place = self.cell(cells, i);
                self.at(place.base, place.offset)
            })
            .collect()
    }
}

/// The sign bit of a double.
pub(crate) const SIGN: u64 = 1 << 63;

/// The frame begins with the argument, two results and the mask of a guard, whose function is called with all
/// vector registers saved after them.
pub(crate) const SCRATCH: i32 = 0;
/// Bytes of one of the scratch cells, and of a register saved: the widest.
pub(crate) const SCRATCH_CELL: i32 = 64;
/// Where vector registers are saved.
pub(crate) const SAVED: i32 = 4 * SCRATCH_CELL;
/// The first byte after both.
pub(crate) const SCRATCH_END: i32 = SAVED + MOST_REGISTERS as i32 * SCRATCH_CELL;

impl Code {
    /// Removes what no store, call or failure needs.
    fn drop_unused(&mut self) {
        let mut is_used = vec![false; self.values.len()];
        let mut kept = Vec::with_capacity(self.ops.len());
        for &op in self.ops.iter().rev() {
            let mut op = op;
            let is_needed = match &mut op {
                Op::Apply { out, .. } => is_used[out.index()],
                Op::Angle { sin, cos, .. } => is_used[sin.index()] || is_used[cos.index()],
                Op::Guard { quick, out, .. } => {
                    for (quick, out) in quick.iter_mut().zip(out.iter_mut()) {
                        if out.is_some_and(|out| !is_used[out.index()]) {
                            (*quick, *out) = (None, None);
                        }
                    }
                    out.iter().any(Option::is_some)
                }
                Op::Store { .. } | Op::Call { .. } | Op::Fail { .. } | Op::End => true,
            };
            if is_needed {
                op.for_each_read(|v| is_used[v.index()] = true);
                kept.push(op);
            }
        }
        kept.reverse();
        self.ops = kept;
    }
}
