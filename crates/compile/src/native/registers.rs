//! Puts the values of straight-line code into the vector registers: sixteen, or 32 where states go eight at a time.
//!
//! One pass from the first instruction to the last. When no register is free, the value whose next use is farthest
//! makes room (Belady 1966); a value that is also in memory (a constant, an input, one spilled before) goes for
//! nothing, so it goes a little earlier than one that has to be stored. A value in memory is loaded only if it is
//! used again before what it would displace; otherwise the instruction reads it from memory.

use super::assembler::{Bits, Order, Sign, Vector, Width};
use super::call::Helper;
use super::code::{Base, Code, Op, Operation, Place, Value};

/// Where an operand is.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Spot {
    Register(Vector),
    Memory(Place),
}

/// An instruction on registers and memory.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Step {
    Load {
        width: Width,
        to: Vector,
        from: Place,
    },
    Copy {
        width: Width,
        to: Vector,
        from: Vector,
    },
    Store {
        width: Width,
        to: Place,
        from: Vector,
    },
    /// An operation with a target of its own.
    Apply {
        operation: Operation,
        width: Width,
        out: Vector,
        a: Vector,
        b: Spot,
        /// The third operand of a blend.
        c: Vector,
    },
    /// A fused multiply-add overwrites its first operand.
    Fused {
        sign: Sign,
        order: Order,
        width: Width,
        first: Vector,
        second: Vector,
        third: Spot,
    },
    Guard {
        slow: Helper,
        width: Width,
        bad: Vector,
        argument: Vector,
        results: [Option<Vector>; 2],
    },
    Call {
        helper: Helper,
        cells: i32,
    },
    Fail {
        width: Width,
        bad: Vector,
    },
    End,
}

/// Instructions on registers, and the bytes of frame they use.
#[derive(Clone, Debug)]
pub(crate) struct Allocated {
    pub(crate) steps: Vec<Step>,
    pub(crate) frame: i32,
}

/// Assigns registers to the values of `code`, which is for so many states at a time.
pub(crate) fn allocate(code: &Code, width: Width) -> Allocated {
    let mut allocator = Allocator::new(code, registers(width));
    for (at, op) in code.ops.iter().enumerate() {
        allocator.place(at, op);
    }
    Allocated {
        steps: allocator.steps,
        frame: allocator.frame,
    }
}

/// How many registers there are for code of a width.
pub(crate) fn registers(width: Width) -> usize {
    match width {
        Width::One | Width::Four => 16,
        Width::Eight => MOST_REGISTERS,
    }
}

/// The most there are.
pub(crate) const MOST_REGISTERS: usize = 32;
/// A value that has to be stored is kept until its next use is so many times farther than that of one in memory.
const STORE_COST: usize = 2;
const NEVER: u32 = u32::MAX;

/// Positions at which each value is read, ascending.
struct Uses {
    /// Of all values one after the other.
    positions: Vec<u32>,
    /// By value: where its next position is, and where its positions end.
    ranges: Vec<(u32, u32)>,
}

impl Uses {
    fn of(code: &Code) -> Uses {
        let mut counts = vec![0u32; code.values.len()];
        for op in &code.ops {
            op.for_each_read(|v| counts[v.index()] += 1);
        }
        let mut ranges = Vec::with_capacity(counts.len());
        let mut start = 0;
        for &count in &counts {
            ranges.push((start, start));
            start += count;
        }
        let mut positions = vec![0; start as usize];
        for (at, op) in code.ops.iter().enumerate() {
            op.for_each_read(|v| {
                let end = &mut ranges[v.index()].1;
                positions[*end as usize] = at as u32;
                *end += 1;
            });
        }
        Uses { positions, ranges }
    }

    /// The first position that has not been passed.
    fn next(&self, value: Value) -> u32 {
        let (next, end) = self.ranges[value.index()];
        if next < end {
            self.positions[next as usize]
        } else {
            NEVER
        }
    }

    fn pass(&mut self, value: Value, at: usize) {
        let (next, end) = &mut self.ranges[value.index()];
        while next < end && self.positions[*next as usize] as usize <= at {
            *next += 1;
        }
    }
}

/// Whether the operation reads sixteen bytes for one number; only the frame has room after every number.
fn reads_beyond(operation: Operation) -> bool {
    !matches!(
        operation,
        Operation::Float(_) | Operation::Compare(_) | Operation::Fused(_)
    )
}

struct Allocator<'c> {
    code: &'c Code,
    uses: Uses,
    steps: Vec<Step>,
    /// By register: what it holds.
    held: Vec<Option<Value>>,
    /// By value: its register.
    register: Vec<Option<Vector>>,
    /// By value: where it is in memory.
    memory: Vec<Option<Place>>,
    /// Free places for spilled values, by their width.
    free: [Vec<Place>; 3],
    frame: i32,
    /// Registers that the present instruction needs.
    locked: [bool; MOST_REGISTERS],
    at: usize,
}

impl<'c> Allocator<'c> {
    fn new(code: &'c Code, registers: usize) -> Allocator<'c> {
        Allocator {
            code,
            uses: Uses::of(code),
            steps: Vec::with_capacity(code.ops.len() * 5 / 4),
            held: vec![None; registers],
            register: vec![None; code.values.len()],
            memory: code.values.iter().map(|info| info.home).collect(),
            free: [Vec::new(), Vec::new(), Vec::new()],
            frame: code.frame,
            locked: [false; MOST_REGISTERS],
            at: 0,
        }
    }

    fn place(&mut self, at: usize, op: &Op) {
        self.at = at;
        self.locked = [false; MOST_REGISTERS];
        match *op {
            Op::Apply {
                operation: Operation::Fused(sign),
                width,
                out,
                operands,
            } => self.fused(sign, width, out, operands),
            Op::Apply {
                operation,
                width,
                out,
                operands,
            } => self.apply(operation, width, out, operands),
            Op::Guard { .. } => self.guard(op),
            Op::Store { width, value, to } => {
                let from = self.read(value);
                self.steps.push(Step::Store { width, to, from });
                self.pass(op);
            }
            Op::Call { helper, cells } => {
                self.spill_all();
                self.steps.push(Step::Call { helper, cells });
            }
            Op::Fail { width, bad } => {
                let bad = self.read(bad);
                self.steps.push(Step::Fail { width, bad });
                self.pass(op);
            }
            // `Builder::finish` has written their kernels.
            Op::Angle { .. } => debug_assert!(false, "an angle without a kernel"),
            Op::End => self.steps.push(Step::End),
        }
    }

    fn width(&self, value: Value) -> Width {
        self.code.values[value.index()].width
    }

    /// The register of a value, loaded if need be, and locked.
    fn read(&mut self, value: Value) -> Vector {
        let register = match self.register[value.index()] {
            Some(register) => register,
            None => {
                let to = self.take();
                self.load(value, to);
                self.hold(value, to);
                to
            }
        };
        self.locked[register.0 as usize] = true;
        register
    }

    fn load(&mut self, value: Value, to: Vector) {
        if let Some(from) = self.memory[value.index()] {
            let width = self.width(value);
            self.steps.push(Step::Load { width, to, from });
        } else {
            debug_assert!(false, "a value is read before it is computed");
        }
    }

    fn hold(&mut self, value: Value, register: Vector) {
        self.held[register.0 as usize] = Some(value);
        self.register[value.index()] = Some(register);
    }

    /// Where an operand that may be in memory is read, locked if in a register.
    fn operand(&mut self, operation: Operation, width: Width, value: Value) -> Spot {
        if self.register[value.index()].is_some() {
            return Spot::Register(self.read(value));
        }
        let Some(place) = self.memory[value.index()] else {
            return Spot::Register(self.read(value));
        };
        let is_readable =
            width != Width::One || place.base == Base::Frame || !reads_beyond(operation);
        if is_readable && !self.is_worth_loading(value) {
            return Spot::Memory(place);
        }
        Spot::Register(self.read(value))
    }

    /// Whether a value is used again before what it would displace.
    fn is_worth_loading(&self, value: Value) -> bool {
        let next = self.next_after(value);
        if next == NEVER {
            return false;
        }
        let mut is_worth = false;
        for r in 0..self.held.len() {
            match self.held[r] {
                None => return true,
                Some(_) if self.locked[r] => {}
                Some(held) => {
                    let is_clean = self.memory[held.index()].is_some();
                    is_worth |= is_clean && self.uses.next(held) > next;
                }
            }
        }
        is_worth
    }

    /// The first use after the present instruction.
    fn next_after(&self, value: Value) -> u32 {
        let (next, end) = self.uses.ranges[value.index()];
        let positions = &self.uses.positions[next as usize..end as usize];
        let later = positions.iter().find(|&&p| p as usize > self.at);
        later.copied().unwrap_or(NEVER)
    }

    /// A free register, made free if there is none.
    fn take(&mut self) -> Vector {
        if let Some(r) = (0..self.held.len()).find(|&r| self.held[r].is_none() && !self.locked[r]) {
            return Vector(r as u8);
        }
        let mut best = (0, 0);
        for r in 0..self.held.len() {
            let Some(value) = self.held[r] else { continue };
            if self.locked[r] {
                continue;
            }
            let distance = (self.uses.next(value) as usize).saturating_sub(self.at) + 1;
            let is_clean = self.memory[value.index()].is_some();
            let score = distance * if is_clean { STORE_COST } else { 1 };
            if score > best.0 {
                best = (score, r);
            }
        }
        self.evict(best.1);
        Vector(best.1 as u8)
    }

    /// Empties a register; its value goes to memory unless it is there.
    fn evict(&mut self, r: usize) {
        let Some(value) = self.held[r].take() else {
            return;
        };
        self.register[value.index()] = None;
        if self.memory[value.index()].is_none() && self.uses.next(value) != NEVER {
            let width = self.width(value);
            let to = self.slot(width);
            let from = Vector(r as u8);
            self.steps.push(Step::Store { width, to, from });
            self.memory[value.index()] = Some(to);
        }
    }

    fn slot(&mut self, width: Width) -> Place {
        if let Some(place) = self.free[width as usize].pop() {
            return place;
        }
        let size = width.lanes() as i32 * 8;
        // Aligned to their size, so that none crosses a cache line.
        let offset = (self.frame + size - 1) / size * size;
        self.frame = offset + size;
        Place {
            base: Base::Frame,
            offset,
        }
    }

    fn spill_all(&mut self) {
        for r in 0..self.held.len() {
            self.evict(r);
        }
    }

    /// After an instruction has been written: values that are not used again give back register and place.
    ///
    /// Not before, for a place given back may be written by the next spill, and the instruction may still have
    /// to read it.
    fn pass(&mut self, op: &Op) {
        op.for_each_read(|value| {
            self.uses.pass(value, self.at);
            if self.uses.next(value) != NEVER {
                return;
            }
            if let Some(register) = self.register[value.index()].take() {
                self.held[register.0 as usize] = None;
            }
            self.give_back(value);
        });
    }

    fn give_back(&mut self, value: Value) {
        let info = self.code.values[value.index()];
        if info.home.is_some() {
            return;
        }
        if let Some(place) = self.memory[value.index()].take() {
            self.free[info.width as usize].push(place);
        }
    }

    /// Registers of operands that die here, which the result may take.
    fn dying(&self, value: Value) -> Option<Vector> {
        let register = self.register[value.index()]?;
        (self.next_after(value) == NEVER).then_some(register)
    }

    fn apply(&mut self, operation: Operation, width: Width, out: Value, operands: [Value; 3]) {
        let [mut a, mut b, c] = operands;
        let arity = operation.arity();
        let is_held = |v: Value| self.register[v.index()].is_some();
        if operation.is_commutative() && !is_held(a) && is_held(b) {
            (a, b) = (b, a);
        }
        // What is in a register already is locked before anything is loaded.
        for &value in &operands[..arity] {
            if let Some(register) = self.register[value.index()] {
                self.locked[register.0 as usize] = true;
            }
        }
        let a_register = self.read(a);
        let is_vector_half = matches!(
            operation,
            Operation::Join | Operation::Bits(Bits::UnpackLow | Bits::UnpackHigh)
        );
        let takes_memory = arity >= 2 && !is_vector_half;
        let b_spot = if takes_memory {
            self.operand(operation, width, b)
        } else if arity >= 2 {
            Spot::Register(self.read(b))
        } else {
            Spot::Register(a_register)
        };
        let c_register = if arity == 3 { self.read(c) } else { a_register };
        let reused = operands[..arity].iter().find_map(|&v| self.dying(v));
        let target = match reused {
            Some(register) => register,
            None => self.take(),
        };
        self.steps.push(Step::Apply {
            operation,
            width,
            out: target,
            a: a_register,
            b: b_spot,
            c: c_register,
        });
        self.define(&operands[..arity], out, target);
    }

    /// Passes the operands, then puts the result into `target`.
    fn define(&mut self, operands: &[Value], out: Value, target: Vector) {
        for &value in operands {
            self.uses.pass(value, self.at);
            if self.uses.next(value) == NEVER {
                if let Some(register) = self.register[value.index()].take() {
                    self.held[register.0 as usize] = None;
                }
                self.give_back(value);
            }
        }
        self.hold(out, target);
    }

    fn fused(&mut self, sign: Sign, width: Width, out: Value, [a, b, c]: [Value; 3]) {
        for value in [a, b, c] {
            if let Some(register) = self.register[value.index()] {
                self.locked[register.0 as usize] = true;
            }
        }
        let (a, b) = self.arrange(a, b);
        let overwritten = self.overwritten(a, b, c);
        let operation = Operation::Fused(sign);
        // Of the two operands that stay, at most one is read from memory.
        let (order, second, third) = if overwritten == c {
            (Order::O231, a, b)
        } else if overwritten == a {
            let is_memory = |v: Value| self.register[v.index()].is_none();
            if is_memory(b) && !is_memory(c) {
                (Order::O132, c, b)
            } else {
                (Order::O213, b, c)
            }
        } else if self.register[a.index()].is_none() && self.register[c.index()].is_some() {
            (Order::O132, c, a)
        } else {
            (Order::O213, a, c)
        };
        let second = self.read(second);
        let third = self.operand(operation, width, third);
        let first = self.target(overwritten);
        self.steps.push(Step::Fused {
            sign,
            order,
            width,
            first,
            second,
            third,
        });
        self.define(&[a, b, c], out, first);
    }

    /// The factors, with one that is in a register first.
    fn arrange(&self, a: Value, b: Value) -> (Value, Value) {
        if self.register[a.index()].is_none() && self.register[b.index()].is_some() {
            (b, a)
        } else {
            (a, b)
        }
    }

    /// Which operand is overwritten: one that dies in a register, else one in memory, which has to be loaded
    /// anyway, else the addend.
    fn overwritten(&self, a: Value, b: Value, c: Value) -> Value {
        for value in [c, a, b] {
            let others = [a, b, c].into_iter().filter(|&v| v == value).count();
            if others == 1 && self.dying(value).is_some() {
                return value;
            }
        }
        for value in [c, b, a] {
            if self.register[value.index()].is_none() {
                return value;
            }
        }
        c
    }

    /// A register with the value of an operand, free to be overwritten.
    fn target(&mut self, value: Value) -> Vector {
        let Some(from) = self.register[value.index()] else {
            let to = self.take();
            self.locked[to.0 as usize] = true;
            self.load(value, to);
            return to;
        };
        if self.next_after(value) == NEVER {
            return from;
        }
        let to = self.take();
        let width = self.width(value);
        self.steps.push(Step::Copy { width, to, from });
        to
    }

    fn guard(&mut self, op: &Op) {
        let Op::Guard {
            slow,
            width,
            bad,
            argument,
            quick,
            out,
        } = *op
        else {
            return;
        };
        let bad = self.read(bad);
        let argument = self.read(argument);
        let results = quick.map(|value| value.map(|value| self.read(value)));
        debug_assert!(quick.iter().flatten().all(|&v| self.next_after(v) == NEVER));
        self.steps.push(Step::Guard {
            slow,
            width,
            bad,
            argument,
            results,
        });
        self.pass(op);
        // The results stay where the quick ones were, which nothing else reads.
        for (out, register) in out.into_iter().zip(results) {
            if let (Some(out), Some(register)) = (out, register) {
                self.hold(out, register);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::native::assembler::Float;
    use crate::native::code::{Builder, SCRATCH_END};
    use std::collections::HashMap;

    /// What a place or a register holds, told by how it was computed: two contents are equal if they are computed in
    /// the same way from the same inputs.
    type Content = u64;

    fn mix(parts: &[u64]) -> Content {
        parts.iter().fold(0x9E37_79B9_7F4A_7C15, |hash, &part| {
            (hash ^ part)
                .wrapping_mul(0xFF51_AFD7_ED55_8CCD)
                .rotate_left(29)
        })
    }

    fn kind(operation: Operation) -> u64 {
        let text = format!("{operation:?}");
        mix(&text.bytes().map(u64::from).collect::<Vec<u64>>())
    }

    fn of_place(place: Place) -> Content {
        mix(&[place.base as u64, place.offset as u64])
    }

    /// A product and a sum; factors may be exchanged.
    fn fused(sign: Sign, a: Content, b: Content, c: Content) -> Content {
        mix(&[kind(Operation::Fused(sign)), a.min(b), a.max(b), c])
    }

    fn applied(operation: Operation, operands: &[Content]) -> Content {
        match *operands {
            [a, b] if operation.is_commutative() => mix(&[kind(operation), a.min(b), a.max(b)]),
            _ => mix(&[&[kind(operation)], operands].concat()),
        }
    }

    /// What code stores, as it is written.
    fn stored_by_code(code: &Code) -> Vec<(Place, Content)> {
        let home = |v: usize| code.values[v].home.map_or(0, of_place);
        let mut contents: Vec<Content> = (0..code.values.len()).map(home).collect();
        let mut stored = Vec::new();
        for op in &code.ops {
            match *op {
                Op::Apply {
                    operation,
                    out,
                    operands,
                    ..
                } => {
                    let operands = operands.map(|v| contents[v.index()]);
                    contents[out.index()] = match operation {
                        Operation::Fused(sign) => {
                            fused(sign, operands[0], operands[1], operands[2])
                        }
                        _ => applied(operation, &operands[..operation.arity()]),
                    };
                }
                Op::Guard {
                    bad,
                    argument,
                    quick,
                    out,
                    ..
                } => {
                    let (bad, argument) = (contents[bad.index()], contents[argument.index()]);
                    for (quick, out) in quick.into_iter().zip(out) {
                        if let (Some(quick), Some(out)) = (quick, out) {
                            let quick = contents[quick.index()];
                            contents[out.index()] = mix(&[bad, argument, quick]);
                        }
                    }
                }
                Op::Store { value, to, .. } => stored.push((to, contents[value.index()])),
                _ => {}
            }
        }
        stored
    }

    /// What instructions on registers store outside of the places for spilled values.
    fn stored_by_steps(code: &Code, steps: &[Step]) -> Vec<(Place, Content)> {
        let mut registers = [0; MOST_REGISTERS];
        let mut memory: HashMap<Place, Content> = HashMap::new();
        let mut stored = Vec::new();
        for step in steps {
            let at = |place: Place| memory.get(&place).copied().unwrap_or(of_place(place));
            let register = |r: Vector| registers[r.0 as usize];
            let read = |spot: Spot| match spot {
                Spot::Register(r) => register(r),
                Spot::Memory(place) => at(place),
            };
            match *step {
                Step::Load { to, from, .. } => registers[to.0 as usize] = at(from),
                Step::Copy { to, from, .. } => registers[to.0 as usize] = register(from),
                Step::Store { to, from, .. } => {
                    let content = register(from);
                    let is_spilled = to.base == Base::Frame && to.offset >= code.frame;
                    if is_spilled {
                        memory.insert(to, content);
                    } else {
                        stored.push((to, content));
                    }
                }
                Step::Apply {
                    operation,
                    width,
                    out,
                    a,
                    b,
                    c,
                } => {
                    let is_beyond = width == Width::One && reads_beyond(operation);
                    assert!(!is_beyond || !matches!(b, Spot::Memory(p) if p.base != Base::Frame));
                    let operands = [register(a), read(b), register(c)];
                    registers[out.0 as usize] = applied(operation, &operands[..operation.arity()]);
                }
                Step::Fused {
                    sign,
                    order,
                    first,
                    second,
                    third,
                    ..
                } => {
                    let (one, two, three) = (register(first), register(second), read(third));
                    registers[first.0 as usize] = match order {
                        Order::O132 => fused(sign, one, three, two),
                        Order::O213 => fused(sign, two, one, three),
                        Order::O231 => fused(sign, two, three, one),
                    };
                }
                Step::Guard {
                    bad,
                    argument,
                    results,
                    ..
                } => {
                    let (bad, argument) = (register(bad), register(argument));
                    for result in results.into_iter().flatten() {
                        let quick = registers[result.0 as usize];
                        registers[result.0 as usize] = mix(&[bad, argument, quick]);
                    }
                }
                // Nothing in a register outlives a call.
                Step::Call { .. } => registers = [0; MOST_REGISTERS],
                Step::Fail { .. } | Step::End => {}
            }
        }
        stored
    }

    /// Code with many values alive at once, used again at random, with calls and guards among them.
    fn sample(seed: u64, size: usize, width: Width) -> Code {
        let mut state = seed.wrapping_mul(2_862_933_555_777_941_757) + 3_037_000_493;
        let mut below = |n: usize| {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) as usize % n
        };
        let mut b = Builder::new(width);
        let mut pool: Vec<Value> = (0..6).map(|i| b.at(Base::Variables, 256 * i)).collect();
        pool.extend((0..4).map(|i| b.constant(f64::from(i))));
        for i in 0..size {
            // Mostly recent values, some old ones.
            let mut pick = |pool: &[Value]| {
                let reach = if below(3) == 0 {
                    pool.len()
                } else {
                    40.min(pool.len())
                };
                pool[pool.len() - 1 - below(reach)]
            };
            let (x, y, z) = (pick(&pool), pick(&pool), pick(&pool));
            let value = match below(12) {
                0 => b.add(x, y),
                1 => b.sub(x, y),
                2 => b.mul(x, x),
                3 => b.mul_add(x, y, z),
                4 => b.mul_sub(x, x, z),
                5 => b.neg_mul_add(x, y, x),
                6 => b.float(Float::Div, x, y),
                7 => b.bits(Bits::And, x, y),
                8 => b.blend(x, y, z),
                9 => b.shift_left(x, 3),
                10 => {
                    let quick = [b.add(x, y), b.sub(x, y)];
                    b.guard(Helper::SinCos, z, x, quick)[below(2)]
                }
                _ if i % 50 == 0 => b.call(Helper::Pow, &[x, y], 1)[0],
                _ => b.sqrt(x),
            };
            pool.push(value);
            if i % 7 == 0 {
                let offset = i as i32 * 256;
                let base = Base::Outputs;
                b.store(value, Place { base, offset });
            }
        }
        b.finish()
    }

    #[test]
    fn large_code_that_spills_computes_what_was_written() {
        for seed in 0..30 {
            for width in [Width::One, Width::Four, Width::Eight] {
                let code = sample(seed, 3_000, width);
                let allocated = allocate(&code, width);
                let expected = stored_by_code(&code);
                assert_eq!(
                    stored_by_steps(&code, &allocated.steps),
                    expected,
                    "seed {seed}"
                );
                let spilled = allocated.frame - code.frame;
                assert!(
                    spilled > 40 * 8,
                    "seed {seed} hardly spills: {spilled} bytes"
                );
            }
        }
    }

    #[test]
    fn places_of_values_no_longer_needed_are_used_again() {
        let frame = |size| {
            let code = sample(5, size, Width::Four);
            let allocated = allocate(&code, Width::Four);
            allocated.frame - code.frame
        };
        // What is picked at random among all stays alive; most is picked among recent values, and dies.
        assert!(frame(20_000) < 20_000 * 32 / 2);
    }

    #[test]
    fn code_that_fits_into_registers_does_not_spill() {
        let mut b = Builder::new(Width::One);
        let x = b.at(Base::Variables, 0);
        let y = b.at(Base::Variables, 8);
        let mut sum = b.mul(x, y);
        for _ in 0..100 {
            let square = b.mul(sum, sum);
            sum = b.mul_add(square, x, y);
        }
        let to = Place {
            base: Base::Outputs,
            offset: 0,
        };
        b.store(sum, to);
        let code = b.finish();
        let allocated = allocate(&code, Width::One);
        assert_eq!((code.frame, allocated.frame), (SCRATCH_END, SCRATCH_END));
        let loads = |step: &&Step| matches!(step, Step::Load { .. });
        assert_eq!(allocated.steps.iter().filter(loads).count(), 2);
    }
}
