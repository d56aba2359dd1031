//! The recurrences as machine code.
//!
//! A coefficient of order j is linear in the others of that order: w = x y has w_j = x_0 y_j + x_j y_0 + Σ_{i=1..j−1} x_i
//! y_{j−i}. The sums contain no coefficient of order j, so all of them are computed first, side by side ([`Products`]);
//! the rest is one piece of straight-line code, the same for every order, whose values are at most a few additions away
//! from each other. Divisors, and the inverses of the matrices, are those of order 0: reciprocals once per expansion.
//!
//! Series are stored one after the other, [`STRIDE`] numbers each, and the code is called with the address of order j of
//! the first one. With states side by side everything stays but the address of a number.

use super::build::{Plan, Recurrences};
use super::recurrence::{Kind, Recurrence};
use super::zero::{self, Zero};
use crate::evaluate::{EvaluateFailure, Evaluator};
use crate::frames::Frames;
use crate::interpret::Workspace;
use crate::native::assembler::Width;
use crate::native::code::{Base, Builder, Op, Place, Value};
use crate::native::machine::{Data, Machine};
use crate::native::products::{Products, MOST, STRIDE, ZERO};
use crate::native::Native;
use crate::schedule::Single;
use std::collections::HashMap;
use std::ops::Range;
use std::sync::Arc;

/// Systems up to this size are solved by the inverse of their matrix.
const LARGEST: usize = 24;

/// The recurrences of a program as machine code.
#[derive(Clone, Debug)]
pub(super) struct Recurring {
    /// Order 0.
    zero: Arc<Native>,
    /// The registers that order 0 writes, after those of constants, parameters and variables and of the prologue.
    body: Range<usize>,
    machine: Arc<Machine>,
    products: Products,
    derived: Vec<Derived>,
    layout: Layout,
    /// Registers of the variables.
    given: Range<usize>,
    /// By variable and by output: the number of the series.
    variables: Vec<u32>,
    outputs: Vec<u32>,
    /// By output: its register.
    registers: Vec<u32>,
}

/// Where what the code reads is.
#[derive(Clone, Copy, Debug, Default)]
struct Layout {
    /// Values of order 0 come first.
    registers: usize,
    sums: usize,
    scalars: usize,
    derived: usize,
    inverses: usize,
    file: usize,
    series: usize,
}

/// Numbers that depend on the order only: 1/j, j and 1/(j + 1).
const SCALARS: usize = 3;

/// What is computed of the values of order 0, once per expansion.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
enum Derived {
    /// 1/x
    Reciprocal(u32),
    /// 1/(2 x)
    Half(u32),
    /// The sign of x, 1 or −1.
    Sign(u32),
}

impl Derived {
    fn value(self, zero: &[f64]) -> f64 {
        match self {
            Derived::Reciprocal(register) => 1.0 / zero[register as usize],
            Derived::Half(register) => 0.5 / zero[register as usize],
            Derived::Sign(register) => zero[register as usize].signum(),
        }
    }
}

/// Storage for one expansion at a time.
#[derive(Clone, Debug)]
pub(super) struct Running {
    file: Vec<f64>,
    series: Vec<f64>,
    frames: Frames,
    /// Of order 0.
    workspace: Workspace,
    /// What order 0 gives: registers, then inverses.
    values: Vec<f64>,
    /// The variables of order 0, where it is known.
    at: Vec<f64>,
    is_known: bool,
    /// Whether a series may contain what the next expansion must not find: what is not finite, or coefficients of a variable
    /// that is no motion.
    is_stained: bool,
}

impl Recurring {
    /// Machine code of a program in single-assignment form with outputs in the registers given; `None` where there is none.
    pub(super) fn of(single: &Single, outputs: &[u32]) -> Option<Recurring> {
        let plan = &Plan::of(single);
        if plan.systems.iter().any(|system| system.rhs.len() > LARGEST) {
            return None;
        }
        let variables = zero::variables(single);
        let Zero { program, body } = zero::program(single, &inverses(plan));
        let mut writer = Writer::new(plan, variables.clone(), outputs);
        writer.variables(&variables);
        for planned in &plan.planned {
            writer.recurrence(planned.kind, &planned.recurrence);
        }
        writer.feed(&variables, outputs);
        writer.builder.push(Op::End);
        let Writer {
            builder,
            pairs,
            derived,
            slots,
            mut layout,
            ..
        } = writer;
        let products = Products::of(&pairs);
        if products.len() > layout.scalars - layout.sums {
            return None;
        }
        layout.series = (slots.count + 1) * STRIDE;
        let machine = Machine::of_code(
            builder.finish(),
            Width::One,
            layout.file,
            layout.series - STRIDE + ZERO + 2,
        )?;
        Some(Recurring {
            zero: Arc::new(Native::of_verified(&program)?),
            body,
            machine: Arc::new(machine),
            products,
            derived,
            layout,
            given: variables.clone(),
            variables: variables.map(|r| slots.plain[r]).collect(),
            outputs: outputs.iter().map(|&r| slots.plain[r as usize]).collect(),
            registers: outputs.to_vec(),
        })
    }

    /// The highest order that has room.
    pub(super) fn most() -> usize {
        MOST
    }

    /// Bytes of machine code.
    pub(super) fn bytes(&self) -> usize {
        self.machine.bytes()
    }

    pub(super) fn running(&self) -> Running {
        Running {
            file: vec![0.0; self.layout.file],
            series: vec![0.0; self.layout.series],
            frames: self.machine.frames(),
            workspace: self.zero.workspace(),
            values: vec![0.0; self.zero.program().output_count()],
            at: vec![0.0; self.given.len()],
            is_known: false,
            is_stained: false,
        }
    }

    /// Sets the parameters; `registers` are those of constants, parameters and prologue.
    pub(super) fn prepare(
        &self,
        parameters: &[f64],
        registers: &[f64],
        running: &mut Running,
    ) -> Result<(), EvaluateFailure> {
        running.is_known = false;
        running.file[..self.body.start].copy_from_slice(&registers[..self.body.start]);
        self.zero.prepare(parameters, &mut running.workspace)
    }

    /// Order 0, and what depends on it only.
    pub(super) fn start(
        &self,
        recurrences: &Recurrences,
        variables: &[f64],
        running: &mut Running,
    ) -> Result<(), EvaluateFailure> {
        let Running {
            file,
            series,
            workspace,
            values,
            at,
            is_known,
            is_stained,
            ..
        } = running;
        if *is_stained {
            series.fill(0.0);
            *is_stained = false;
        }
        // The end of a step is asked for again as the start of the next.
        let same = |(a, b): (&f64, &f64)| a.to_bits() == b.to_bits();
        if *is_known && variables.iter().zip(&*at).all(same) {
            return Ok(());
        }
        *is_known = false;
        self.zero.evaluate(variables, workspace, values)?;
        let (zero, rest) = file.split_at_mut(self.layout.registers);
        let (body, inverses) = values.split_at(self.body.len());
        zero[self.given.clone()].copy_from_slice(variables);
        zero[self.body.clone()].copy_from_slice(body);
        rest[self.layout.inverses - self.layout.registers..].copy_from_slice(inverses);
        recurrences.seed(zero)?;
        let derived = &mut rest[self.layout.derived - self.layout.registers..];
        for (to, derived) in derived.iter_mut().zip(&self.derived) {
            *to = derived.value(zero);
        }
        at.copy_from_slice(variables);
        *is_known = true;
        Ok(())
    }

    /// Order 0 of an output.
    pub(super) fn first(&self, index: usize, running: &Running) -> f64 {
        running.file[self.registers[index] as usize]
    }

    /// Order j of everything, from that of the variables.
    pub(super) fn advance(
        &self,
        j: usize,
        variables: &[f64],
        running: &mut Running,
    ) -> Result<(), EvaluateFailure> {
        running.is_stained = true;
        for (&slot, &value) in self.variables.iter().zip(variables) {
            running.series[slot as usize * STRIDE + ZERO + j] = value;
        }
        self.run(j, running)
    }

    fn run(&self, j: usize, running: &mut Running) -> Result<(), EvaluateFailure> {
        let Running {
            file,
            series,
            frames,
            ..
        } = running;
        self.products.sum(j, series, &mut file[self.layout.sums..]);
        let order = j as f64;
        file[self.layout.scalars..][..SCALARS].copy_from_slice(&[
            1.0 / order,
            order,
            1.0 / (order + 1.0),
        ]);
        let data = Data {
            variables: &[],
            file,
            outputs: &mut series[j..],
        };
        let frame = frames.frame(0);
        let failed = frame.and_then(|frame| self.machine.run(frame, 1, data));
        match failed {
            Some(_) => Ok(()),
            None => Err(EvaluateFailure::NotPrepared),
        }
    }

    /// Order j ≥ 1 of an output.
    #[inline]
    pub(super) fn output(&self, index: usize, j: usize, running: &Running) -> f64 {
        running.series[self.outputs[index] as usize * STRIDE + ZERO + j]
    }

    /// Writes the orders 0 to `order` of all variables but the first, which is the time and whose rate is 1; the outputs are
    /// the rates of the others.
    pub(super) fn expand(
        &self,
        variables: &[f64],
        order: usize,
        running: &mut Running,
        coefficients: &mut [f64],
    ) -> Result<(), EvaluateFailure> {
        let own = &self.variables[1..];
        let at = |slot: u32, j: usize| slot as usize * STRIDE + ZERO + j;
        running.series[at(self.variables[0], 1)] = 1.0;
        for (&slot, &register) in own.iter().zip(&self.registers) {
            running.series[at(slot, 1)] = running.file[register as usize];
        }
        for j in 1..order {
            self.run(j, running)?;
        }
        let m = own.len();
        coefficients[..m].copy_from_slice(&variables[1..]);
        // Zero where all are finite: what is not spreads to all values that are computed of it.
        let mut trace = 0.0;
        for (j, row) in (1..=order).zip(coefficients.chunks_exact_mut(m.max(1)).skip(1)) {
            for (to, &slot) in row.iter_mut().zip(own) {
                *to = running.series[at(slot, j)];
                trace += 0.0 * *to;
            }
        }
        running.is_stained = trace != 0.0;
        Ok(())
    }
}

/// The matrices of the systems, each once.
fn inverses(plan: &Plan) -> Vec<(usize, usize)> {
    let mut found: Vec<(usize, usize)> = Vec::new();
    for system in &plan.systems {
        let entry = (system.matrix, system.rhs.len());
        if !found.contains(&entry) {
            found.push(entry);
        }
    }
    found
}

/// Numbers of series by register; 0 where there is none.
struct Slots {
    plain: Vec<u32>,
    weighted: Vec<u32>,
    /// Series 0 is nobody's, and zero.
    count: usize,
}

/// Writes the straight-line code. A value that is not there is zero at every order above 0.
struct Writer<'p> {
    plan: &'p Plan,
    builder: Builder,
    slots: Slots,
    layout: Layout,
    now: Vec<Option<Value>>,
    zero: Vec<Option<Value>>,
    pairs: Vec<[u32; 2]>,
    sums: HashMap<[u32; 2], Value>,
    derived: Vec<Derived>,
    inverses: Vec<(usize, usize)>,
    scalars: [Value; SCALARS],
}

impl<'p> Writer<'p> {
    fn new(plan: &'p Plan, variables: Range<usize>, outputs: &[u32]) -> Writer<'p> {
        let mut slots = Slots {
            plain: vec![0; plan.registers],
            weighted: vec![0; plan.registers],
            count: 1,
        };
        let mut number = |slot: &mut u32| {
            if *slot == 0 {
                *slot = slots.count as u32;
                slots.count += 1;
            }
        };
        for register in variables {
            number(&mut slots.plain[register]);
        }
        for (register, keep) in plan.keep.iter().enumerate() {
            if keep.forward + keep.reverse > 0 {
                number(&mut slots.plain[register]);
            }
            if keep.weighted > 0 {
                number(&mut slots.weighted[register]);
            }
        }
        for &register in outputs {
            number(&mut slots.plain[register as usize]);
        }
        let inverses = inverses(plan);
        let layout = layout(plan, &inverses);
        let mut builder = Builder::new(Width::One);
        let scalars = [0, 1, 2].map(|i| builder.at(Base::File, 8 * (layout.scalars + i) as i32));
        Writer {
            now: vec![None; plan.registers],
            zero: vec![None; plan.registers],
            pairs: Vec::new(),
            sums: HashMap::new(),
            derived: Vec::new(),
            builder,
            slots,
            layout,
            inverses,
            scalars,
            plan,
        }
    }

    fn place(slot: u32, beyond: usize) -> Place {
        Place {
            base: Base::Outputs,
            offset: 8 * (slot as usize * STRIDE + ZERO + beyond) as i32,
        }
    }

    /// The order j of the variables is in their series.
    fn variables(&mut self, variables: &Range<usize>) {
        for register in variables.clone() {
            let Place { base, offset } = Self::place(self.slots.plain[register], 0);
            let value = self.builder.at(base, offset);
            self.now[register] = Some(value);
            self.weigh(register, value);
        }
    }

    /// Stores the value times its order, where this is wanted.
    fn weigh(&mut self, register: usize, value: Value) {
        let slot = self.slots.weighted[register];
        if slot > 0 {
            let weighted = self.builder.mul(value, self.scalars[1]);
            self.builder.store(weighted, Self::place(slot, 0));
        }
    }

    fn write(&mut self, register: u32, value: Option<Value>) {
        let register = register as usize;
        self.now[register] = value;
        let Some(value) = value else { return };
        let slot = self.slots.plain[register];
        if slot > 0 {
            self.builder.store(value, Self::place(slot, 0));
        }
        self.weigh(register, value);
    }

    /// The rates are the next order of the variables, times j + 1.
    fn feed(&mut self, variables: &Range<usize>, outputs: &[u32]) {
        if variables.len() != outputs.len() + 1 {
            return;
        }
        for (variable, &output) in variables.clone().skip(1).zip(outputs) {
            if let Some(rate) = self.now[output as usize] {
                let next = self.builder.mul(rate, self.scalars[2]);
                let place = Self::place(self.slots.plain[variable], 1);
                self.builder.store(next, place);
            }
        }
    }

    fn now(&self, register: u32) -> Option<Value> {
        self.now[register as usize]
    }

    /// A value of order 0.
    fn zero(&mut self, register: u32) -> Value {
        let builder = &mut self.builder;
        let zero = &mut self.zero[register as usize];
        *zero.get_or_insert_with(|| builder.at(Base::File, 8 * register as i32))
    }

    fn derived(&mut self, derived: Derived) -> Value {
        let known = self.derived.iter().position(|&own| own == derived);
        let index = known.unwrap_or_else(|| {
            self.derived.push(derived);
            self.derived.len() - 1
        });
        let offset = 8 * (self.layout.derived + index) as i32;
        self.builder.at(Base::File, offset)
    }

    /// Σ_{i=1..j−1} x_i y_{j−i} of two series.
    fn sum(&mut self, x: u32, y: u32) -> Value {
        let key = [x.min(y), x.max(y)];
        if let Some(&value) = self.sums.get(&key) {
            return value;
        }
        let offset = 8 * (self.layout.sums + self.pairs.len()) as i32;
        self.pairs.push(key);
        let value = self.builder.at(Base::File, offset);
        self.sums.insert(key, value);
        value
    }

    /// Whose series a slot of the plan is.
    fn owner(&self, slot: u32) -> u32 {
        self.plan.owners[slot as usize]
    }

    fn add(&mut self, a: Option<Value>, b: Option<Value>) -> Option<Value> {
        match (a, b) {
            (Some(a), Some(b)) => Some(self.builder.add(a, b)),
            (a, b) => a.or(b),
        }
    }

    fn sub(&mut self, a: Option<Value>, b: Option<Value>) -> Option<Value> {
        match (a, b) {
            (Some(a), Some(b)) => Some(self.builder.sub(a, b)),
            (a, None) => a,
            (None, Some(b)) => Some(self.builder.neg(b)),
        }
    }

    fn scale(&mut self, a: Option<Value>, factor: Value) -> Option<Value> {
        a.map(|a| self.builder.mul(a, factor))
    }

    /// a · factor + c
    fn scale_add(&mut self, a: Option<Value>, factor: Value, c: Option<Value>) -> Option<Value> {
        match (a, c) {
            (Some(a), Some(c)) => Some(self.builder.mul_add(a, factor, c)),
            (None, c) => c,
            (a, None) => self.scale(a, factor),
        }
    }

    /// c − a · factor
    fn less(&mut self, c: Option<Value>, a: Option<Value>, factor: Value) -> Option<Value> {
        match (a, c) {
            (Some(a), Some(c)) => Some(self.builder.neg_mul_add(a, factor, c)),
            (None, c) => c,
            (a, None) => {
                let scaled = self.scale(a, factor);
                self.sub(None, scaled)
            }
        }
    }

    /// Order j of x y, less what `sum` is of it.
    fn product(&mut self, (x, y): (u32, u32), sum: Option<Value>) -> Option<Value> {
        let (x_zero, y_zero) = (self.zero(x), self.zero(y));
        let (x, y) = (self.now(x), self.now(y));
        let partial = self.scale_add(x, y_zero, sum);
        self.scale_add(y, x_zero, partial)
    }

    /// Σ_{i=0..j} x_i y_{j−i} of two slots of the plan.
    fn convolution(&mut self, a: u32, b: u32) -> Option<Value> {
        let (x, y) = (self.owner(a), self.owner(b));
        let (first, second) = (self.slots.plain[x as usize], self.slots.plain[y as usize]);
        let sum = self.sum(first, second);
        self.product((x, y), Some(sum))
    }

    /// (1/j) Σ_{i=1..j−1} i x_i y_{j−i}, of a slot stored with its orders and of another.
    fn mean(&mut self, a: u32, b: u32) -> Option<Value> {
        let (x, y) = (self.owner(a), self.owner(b));
        let weighted = self.slots.weighted[x as usize];
        let sum = self.sum(weighted, self.slots.plain[y as usize]);
        Some(self.builder.mul(sum, self.scalars[0]))
    }

    /// (1/j) Σ_{i=1..j} i x_i y_{j−i}
    fn integral(&mut self, a: u32, b: u32) -> Option<Value> {
        let (x, y) = (self.owner(a), self.owner(b));
        let mean = self.mean(a, b);
        let start = self.zero(y);
        self.scale_add(self.now(x), start, mean)
    }

    fn recurrence(&mut self, kind: Kind, recurrence: &Recurrence) {
        let [a, b, c, d, _] = recurrence.operands;
        let value = match kind {
            Kind::Add => self.add(self.now(a), self.now(b)),
            Kind::Sub => self.sub(self.now(a), self.now(b)),
            Kind::Neg => self.sub(None, self.now(a)),
            Kind::Scale => {
                let factor = self.zero(b);
                self.scale(self.now(a), factor)
            }
            Kind::ScaleAdd => {
                let factor = self.zero(b);
                self.scale_add(self.now(a), factor, self.now(c))
            }
            Kind::ScaleSub => {
                let factor = self.zero(b);
                let scaled = self.scale(self.now(a), factor);
                self.sub(scaled, self.now(c))
            }
            Kind::NegScaleAdd => {
                let factor = self.zero(b);
                self.less(self.now(c), self.now(a), factor)
            }
            Kind::Convolve | Kind::Square => self.convolution(a, b),
            Kind::ConvolveAdd => {
                let product = self.convolution(a, b);
                self.add(product, self.now(c))
            }
            Kind::ConvolveSub => {
                let product = self.convolution(a, b);
                self.sub(product, self.now(c))
            }
            Kind::NegConvolveAdd => {
                let product = self.convolution(a, b);
                self.sub(self.now(c), product)
            }
            Kind::DivideConstant => {
                let factor = self.derived(Derived::Reciprocal(b));
                self.scale(self.now(a), factor)
            }
            Kind::Signed => {
                let sign = self.derived(Derived::Sign(b));
                self.scale(self.now(a), sign)
            }
            Kind::Integral => self.integral(a, b),
            Kind::NegIntegral => {
                let integral = self.integral(a, b);
                self.sub(None, integral)
            }
            Kind::Complement => {
                let integral = self.integral(a, b);
                self.sub(self.now(c), integral)
            }
            Kind::Rotation => {
                let (first, second) = (self.integral(a, b), self.integral(c, d));
                self.sub(first, second)
            }
            Kind::Divide | Kind::Root | Kind::Quotient | Kind::Power => {
                self.implicit(kind, recurrence)
            }
            Kind::Clear => None,
            Kind::Solve => {
                self.solve(a as usize);
                return;
            }
        };
        self.write(recurrence.out, value);
    }

    /// Those whose sums contain lower orders of the result.
    fn implicit(&mut self, kind: Kind, recurrence: &Recurrence) -> Option<Value> {
        let out = recurrence.out;
        let [a, b, c, d, e] = recurrence.operands;
        let own = self.slots.plain[out as usize];
        match kind {
            Kind::Divide => {
                let divisor = self.owner(b);
                let sum = self.sum(self.slots.plain[divisor as usize], own);
                let start = self.zero(out);
                let rest = self.less(self.now(a), self.now(divisor), start);
                let rest = self.sub(rest, Some(sum));
                let reciprocal = self.derived(Derived::Reciprocal(d));
                self.scale(rest, reciprocal)
            }
            Kind::Root => {
                let sum = self.sum(own, own);
                let rest = self.sub(self.now(a), Some(sum));
                let half = self.derived(Derived::Half(d));
                self.scale(rest, half)
            }
            Kind::Quotient => {
                let slope = self.slots.plain[self.owner(c) as usize];
                let sum = self.sum(self.slots.weighted[out as usize], slope);
                let rest = self.less(self.now(a), Some(sum), self.scalars[0]);
                let reciprocal = self.derived(Derived::Reciprocal(d));
                self.scale(rest, reciprocal)
            }
            _ => {
                // (e (x_j w_0 + Σ i x_i w_{j−i}/j) − Σ i w_i x_{j−i}/j)/x_0
                let x = self.owner(a);
                let weighted = self.slots.weighted[x as usize];
                let sum = self.sum(weighted, own);
                let mean = self.builder.mul(sum, self.scalars[0]);
                let start = self.zero(out);
                let integral = self.scale_add(self.now(x), start, Some(mean));
                let exponent = self.zero(e);
                let first = self.scale(integral, exponent);
                let base = self.slots.plain[self.owner(b) as usize];
                let sum = self.sum(self.slots.weighted[out as usize], base);
                let rest = self.less(first, Some(sum), self.scalars[0]);
                let reciprocal = self.derived(Derived::Reciprocal(c));
                self.scale(rest, reciprocal)
            }
        }
    }

    /// A_0 x_j = b_j − Σ_{i=1..j} A_i x_{j−i}, by the inverse of A_0.
    fn solve(&mut self, number: usize) {
        let plan = self.plan;
        let system = &plan.systems[number];
        let size = system.rhs.len();
        let mut rhs: Vec<Option<Value>> = system.rhs.iter().map(|&r| self.now(r)).collect();
        for &(row, entry, unknown) in &system.entries {
            let (entry, unknown) = (self.owner(entry), self.owner(unknown));
            let plain = &self.slots.plain;
            let (first, second) = (plain[entry as usize], plain[unknown as usize]);
            let sum = self.sum(first, second);
            let start = self.zero(unknown);
            let row = &mut rhs[row as usize];
            let rest = std::mem::take(row);
            let rest = self.sub(rest, Some(sum));
            *row = self.less(rest, self.now(entry), start);
        }
        let mut first = self.layout.inverses;
        for &(matrix, size) in &self.inverses {
            if matrix == system.matrix {
                break;
            }
            first += size * size;
        }
        for (i, &(register, _)) in system.out.iter().enumerate() {
            // Two sums that do not wait for each other.
            let mut totals = [None; 2];
            for (k, &rhs) in rhs.iter().enumerate().filter(|(_, rhs)| rhs.is_some()) {
                let offset = 8 * (first + i * size + k) as i32;
                let entry = self.builder.at(Base::File, offset);
                totals[k % 2] = self.scale_add(rhs, entry, totals[k % 2]);
            }
            let x = self.add(totals[0], totals[1]);
            self.write(register, x);
        }
    }
}

/// Where everything is in the file; there are at most as many sums as recurrences need.
fn layout(plan: &Plan, inverses: &[(usize, usize)]) -> Layout {
    let entries = plan.systems.iter().map(|system| system.entries.len());
    let sums = 2 * plan.planned.len() + entries.sum::<usize>() + 4;
    let derived = 2 * plan.planned.len();
    let mut layout = Layout {
        registers: plan.registers,
        sums: plan.registers,
        ..Layout::default()
    };
    layout.scalars = layout.sums + sums;
    layout.derived = layout.scalars + SCALARS;
    layout.inverses = layout.derived + derived;
    layout.file = layout.inverses + inverses.iter().map(|(_, size)| size * size).sum::<usize>();
    layout
}
