//! Sines and cosines of several angles of one state by one vector kernel.
//!
//! Straight-line code for single states leaves three of four lanes idle. Kernels of sine and cosine are the longest
//! parts of most programs, so angles that are known early enough are computed together: each with the operations,
//! and so with the bits, that it would have alone.

use super::assembler::{Bits, Width};
use super::code::{Builder, Op, Operation, Value};
use super::kernels;

/// Angles in one register.
const TOGETHER: usize = 4;
/// How many later angles are looked at for company.
const LOOKED_AT: usize = 16;
/// How many instructions may be moved forward to make an angle known.
const MOVED: usize = 24;

/// Replaces the angles in code for single states by kernels, gathering up to four for each.
pub(crate) fn expand(builder: &mut Builder) {
    let ops = builder.take_ops();
    let mut gathering = Gathering::new(builder, ops);
    for at in 0..gathering.ops.len() {
        if gathering.is_done[at] {
            continue;
        }
        match gathering.ops[at] {
            Op::Angle { .. } => gathering.angles(at),
            _ => gathering.emit(at),
        }
    }
}

struct Gathering<'b> {
    builder: &'b mut Builder,
    ops: Vec<Op>,
    is_done: Vec<bool>,
    /// By value: which of the operations computes it.
    producers: Vec<Option<usize>>,
    /// By value: what stands for it now.
    now: Vec<Value>,
}

impl<'b> Gathering<'b> {
    fn new(builder: &'b mut Builder, ops: Vec<Op>) -> Gathering<'b> {
        let count = builder.value_count();
        let mut producers = vec![None; count];
        for (at, op) in ops.iter().enumerate() {
            op.for_each_write(|v| producers[v.index()] = Some(at));
        }
        Gathering {
            builder,
            is_done: vec![false; ops.len()],
            ops,
            producers,
            now: (0..count).map(|v| Value(v as u32)).collect(),
        }
    }

    fn emit(&mut self, at: usize) {
        let now = &self.now;
        let op = self.ops[at].map_reads(|v| now[v.index()]);
        self.builder.push(op);
        self.is_done[at] = true;
    }

    /// The angle of an operation, and where its sine and its cosine are expected.
    fn angle(&self, at: usize) -> Option<[Value; 3]> {
        match self.ops[at] {
            Op::Angle { argument, sin, cos } => Some([argument, sin, cos]),
            _ => None,
        }
    }

    /// Computes an angle, with others that can be known now.
    fn angles(&mut self, at: usize) {
        let company = self.company(at);
        let mut angles: Vec<[Value; 3]> = Vec::with_capacity(TOGETHER);
        for (other, before) in company {
            before.into_iter().for_each(|op| self.emit(op));
            angles.extend(self.angle(other));
            self.is_done[other] = true;
        }
        let arguments: Vec<Value> = angles.iter().map(|a| self.now[a[0].index()]).collect();
        let results = sines_and_cosines(self.builder, &arguments);
        for ([_, sin, cos], result) in angles.into_iter().zip(results) {
            self.now[sin.index()] = result.0;
            self.now[cos.index()] = result.1;
        }
    }

    /// The angles computed with the one at `at`, itself first, each with what has to be computed before it.
    fn company(&self, at: usize) -> Vec<(usize, Vec<usize>)> {
        let mut company: Vec<(usize, Vec<usize>)> = vec![(at, Vec::new())];
        let mut looked_at = 0;
        for other in at + 1..self.ops.len() {
            let is_full = company.len() == TOGETHER || looked_at == LOOKED_AT;
            // What comes after may not be needed, or needs the call.
            let is_barrier = matches!(self.ops[other], Op::End | Op::Call { .. });
            if is_full || is_barrier {
                break;
            }
            if self.is_done[other] || !matches!(self.ops[other], Op::Angle { .. }) {
                continue;
            }
            looked_at += 1;
            if let Some(before) = self.missing(other) {
                let is_new = |op: &usize| company.iter().all(|(_, ops)| !ops.contains(op));
                let before = before.into_iter().filter(is_new).collect();
                company.push((other, before));
            }
        }
        company
    }

    /// Instructions not yet emitted that an operation needs, in order; `None` if they are many, or not simple.
    fn missing(&self, at: usize) -> Option<Vec<usize>> {
        let mut missing = Vec::new();
        let mut stack = vec![at];
        while let Some(op) = stack.pop() {
            let mut is_simple = true;
            self.ops[op].for_each_read(|v| {
                if let Some(producer) = self.producers[v.index()] {
                    if !self.is_done[producer] && !missing.contains(&producer) {
                        is_simple &= matches!(self.ops[producer], Op::Apply { .. });
                        missing.push(producer);
                        stack.push(producer);
                    }
                }
            });
            if !is_simple || missing.len() > MOVED {
                return None;
            }
        }
        missing.sort_unstable();
        Some(missing)
    }
}

/// Sine and cosine of up to four angles.
fn sines_and_cosines(b: &mut Builder, angles: &[Value]) -> Vec<(Value, Value)> {
    if let [angle] = *angles {
        return vec![kernels::sin_cos(b, angle)];
    }
    let pair = |b: &mut Builder, angles: &[Value]| {
        let (first, second) = (angles[0], angles[angles.len() - 1]);
        // Written as a vector, the upper half is zero.
        b.wide(Operation::Bits(Bits::UnpackLow), [first, second, first])
    };
    let mut packed = pair(b, &angles[..2]);
    if angles.len() > 2 {
        let upper = pair(b, &angles[2..]);
        packed = b.wide(Operation::Join, [packed, upper, packed]);
    }
    b.width = Width::Four;
    let (sin, cos) = kernels::sin_cos(b, packed);
    b.width = Width::One;
    let (sines, cosines) = (lanes(b, sin, angles.len()), lanes(b, cos, angles.len()));
    sines.into_iter().zip(cosines).collect()
}

/// The first lanes of a vector. The first of a register, or of its place in memory, is read where it is.
fn lanes(b: &mut Builder, vector: Value, count: usize) -> Vec<Value> {
    let second = |b: &mut Builder, v: Value| b.bits(Bits::UnpackHigh, v, v);
    let mut lanes = vec![vector, second(b, vector)];
    if count > 2 {
        let upper = b.upper_half(vector);
        lanes.push(upper);
        lanes.push(second(b, upper));
    }
    lanes.truncate(count);
    lanes
}
