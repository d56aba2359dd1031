//! The straight-line code of one order, and where it finds what it reads.

use super::build::Plan;
use super::recurrence::{Kind, Recurrence};
use crate::native::assembler::Width;
use crate::native::code::{Base, Builder, Code, Op, Place, Value};
use crate::native::products::{Products, STRIDE, ZERO};
use std::collections::HashMap;
use std::ops::Range;

/// Where what the code reads is.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Layout {
    /// Values of order 0 come first.
    pub(super) registers: usize,
    pub(super) sums: usize,
    pub(super) scalars: usize,
    pub(super) derived: usize,
    pub(super) inverses: usize,
    pub(super) file: usize,
    pub(super) series: usize,
}

/// Numbers that depend on the order only: 1/j, j and 1/(j + 1).
pub(super) const SCALARS: usize = 3;

/// What is computed of the values of order 0, once per expansion.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) enum Derived {
    /// 1/x
    Reciprocal(u32),
    /// 1/(2 x)
    Half(u32),
    /// The sign of x, 1 or −1.
    Sign(u32),
}

impl Derived {
    /// The register of x.
    #[inline]
    pub(super) fn register(self) -> u32 {
        match self {
            Derived::Reciprocal(register) | Derived::Half(register) | Derived::Sign(register) => {
                register
            }
        }
    }

    /// The numbers that belong to those of x, for several motions.
    #[inline]
    pub(super) fn of<const N: usize>(self, mut x: [f64; N]) -> [f64; N] {
        for x in &mut x {
            *x = match self {
                Derived::Reciprocal(_) => 1.0 / *x,
                Derived::Half(_) => 0.5 / *x,
                Derived::Sign(_) => x.signum(),
            };
        }
        x
    }
}

/// The matrices of the systems, each once.
pub(super) fn inverses(plan: &Plan) -> Vec<(usize, usize)> {
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
pub(super) struct Slots {
    pub(super) plain: Vec<u32>,
    weighted: Vec<u32>,
    /// Series 0 is nobody's, and zero.
    count: usize,
}

/// Writes the straight-line code. A value that is not there is zero at every order above 0.
struct Writer<'p> {
    plan: &'p Plan,
    builder: Builder,
    /// Bytes of a number of each state.
    number: i32,
    slots: Slots,
    layout: Layout,
    now: Vec<Option<Value>>,
    zero: Vec<Option<Value>>,
    pairs: Vec<[u32; 2]>,
    sums: HashMap<[u32; 2], Value>,
    /// Which sum is of which pair, once that is known.
    places: HashMap<[u32; 2], usize>,
    derived: Vec<Derived>,
    inverses: Vec<(usize, usize)>,
    scalars: [Value; SCALARS],
}

/// What was written.
pub(super) struct Written {
    pub(super) code: Code,
    /// The series whose products are to be summed.
    pub(super) products: Products,
    pub(super) derived: Vec<Derived>,
    pub(super) slots: Slots,
    pub(super) layout: Layout,
}

/// The code of a plan whose variables and outputs are the registers given; where there are as many outputs as variables but
/// the first, they are taken for the rates of the others.
pub(super) fn write(
    plan: &Plan,
    variables: &Range<usize>,
    outputs: &[u32],
    width: Width,
) -> Written {
    let written = |places| {
        let mut writer = Writer::new(plan, variables.clone(), outputs, width);
        writer.places = places;
        writer.variables(variables);
        for planned in &plan.planned {
            writer.recurrence(planned.kind, &planned.recurrence);
        }
        writer.feed(variables, outputs);
        writer
    };
    // Sums are numbered when all of them are known.
    let pairs = written(HashMap::new()).pairs;
    let products = Products::of(&pairs);
    let places = pairs.into_iter().zip(products.places().iter().copied());
    let mut writer = written(places.collect());
    writer.builder.push(Op::End);
    let mut layout = writer.layout;
    layout.series = (writer.slots.count + 1) * STRIDE;
    Written {
        code: writer.builder.finish(),
        products,
        derived: writer.derived,
        slots: writer.slots,
        layout,
    }
}

impl<'p> Writer<'p> {
    fn new(plan: &'p Plan, variables: Range<usize>, outputs: &[u32], width: Width) -> Writer<'p> {
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
        let mut builder = Builder::new(width);
        let number = 8 * width.lanes() as i32;
        let scalars =
            [0, 1, 2].map(|i| builder.at(Base::File, number * (layout.scalars + i) as i32));
        Writer {
            number,
            now: vec![None; plan.registers],
            zero: vec![None; plan.registers],
            pairs: Vec::new(),
            sums: HashMap::new(),
            places: HashMap::new(),
            derived: Vec::new(),
            builder,
            slots,
            layout,
            inverses,
            scalars,
            plan,
        }
    }

    fn place(&self, slot: u32, beyond: usize) -> Place {
        Place {
            base: Base::Outputs,
            offset: self.number * (slot as usize * STRIDE + ZERO + beyond) as i32,
        }
    }

    /// The order j of the variables is in their series.
    fn variables(&mut self, variables: &Range<usize>) {
        for register in variables.clone() {
            let Place { base, offset } = self.place(self.slots.plain[register], 0);
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
            let place = self.place(slot, 0);
            self.builder.store(weighted, place);
        }
    }

    fn write(&mut self, register: u32, value: Option<Value>) {
        let register = register as usize;
        self.now[register] = value;
        let Some(value) = value else { return };
        let slot = self.slots.plain[register];
        if slot > 0 {
            let place = self.place(slot, 0);
            self.builder.store(value, place);
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
                let place = self.place(self.slots.plain[variable], 1);
                self.builder.store(next, place);
            }
        }
    }

    fn now(&self, register: u32) -> Option<Value> {
        self.now[register as usize]
    }

    /// A value of order 0.
    fn zero(&mut self, register: u32) -> Value {
        let (builder, number) = (&mut self.builder, self.number);
        let zero = &mut self.zero[register as usize];
        *zero.get_or_insert_with(|| builder.at(Base::File, number * register as i32))
    }

    fn derived(&mut self, derived: Derived) -> Value {
        let known = self.derived.iter().position(|&own| own == derived);
        let index = known.unwrap_or_else(|| {
            self.derived.push(derived);
            self.derived.len() - 1
        });
        let offset = self.number * (self.layout.derived + index) as i32;
        self.builder.at(Base::File, offset)
    }

    /// Σ_{i=1..j−1} x_i y_{j−i} of two series.
    fn sum(&mut self, x: u32, y: u32) -> Value {
        let key = [x.min(y), x.max(y)];
        if let Some(&value) = self.sums.get(&key) {
            return value;
        }
        let place = self.places.get(&key).copied().unwrap_or(0);
        let offset = self.number * (self.layout.sums + place) as i32;
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
                let offset = self.number * (first + i * size + k) as i32;
                let entry = self.builder.at(Base::File, offset);
                totals[k % 2] = self.scale_add(rhs, entry, totals[k % 2]);
            }
            let x = self.add(totals[0], totals[1]);
            self.write(register, x);
        }
    }
}

/// Where everything is in the file; there are at most as many sums as recurrences need, and those that fill fours.
fn layout(plan: &Plan, inverses: &[(usize, usize)]) -> Layout {
    let entries = plan.systems.iter().map(|system| system.entries.len());
    let sums = 2 * plan.planned.len() + entries.sum::<usize>() + 8;
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
