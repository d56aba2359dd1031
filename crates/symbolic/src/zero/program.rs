//! The expressions under test as a straight-line program over the field of T6 §6.1.
//!
//! Values are numbered; an operation uses smaller numbers only. Every operation is algebraic over the
//! generators, so a program can be run in any ring that offers values for the generators and roots for the radicals.

use dashu_int::IBig;

use crate::node::Expr;
use crate::rational::Rational;

/// The number of a value of a [`Program`].
pub(super) type Value = u32;

/// The number of a rational constant of a [`Program`].
pub(super) type Constant = u32;

/// One operation.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Operation {
    /// A rational number.
    Number(Constant),
    /// A free generator.
    Generator(u32),
    /// The cosine of the unit angle of a circle: (1 − u²)/(1 + u²).
    CircleCos(u32),
    /// Its sine: 2u/(1 + u²).
    CircleSin(u32),
    /// cos(2πk/N), where N is the program's order of unity.
    UnityCos(u64),
    /// sin(2πk/N); needs 4 | N.
    UnitySin(u64),
    /// constant + Σ coefficient·value.
    Sum {
        constant: Constant,
        terms: Box<[(Value, Constant)]>,
    },
    /// coefficient·Π value.
    Product {
        coefficient: Constant,
        factors: Box<[Value]>,
    },
    /// value^exponent, for an integer exponent of either sign.
    Power { base: Value, exponent: IBig },
    /// A square root of the value: radical number `radical`.
    SquareRoot { radicand: Value, radical: u32 },
    /// The q-th root for an odd prime power q, unique in the prime fields used.
    OddRoot { radicand: Value, degree: u64 },
    /// The vector A^{−1} b; the value itself is a vector and used by [`Operation::Entry`] only.
    Solve { matrix: Value, rhs: Box<[Value]> },
    /// A square matrix, row by row; used by [`Operation::Solve`] only.
    Matrix { size: u32, entries: Box<[Value]> },
    /// A component of a solve.
    Entry { of: Value, index: u32 },
}

impl Operation {
    /// Calls `visit` for each value used.
    pub(super) fn for_each_operand(&self, mut visit: impl FnMut(Value)) {
        match self {
            Self::Number(_)
            | Self::Generator(_)
            | Self::CircleCos(_)
            | Self::CircleSin(_)
            | Self::UnityCos(_)
            | Self::UnitySin(_) => {}
            Self::Sum { terms, .. } => terms.iter().for_each(|(value, _)| visit(*value)),
            Self::Product { factors, .. } => factors.iter().for_each(|value| visit(*value)),
            Self::Power { base, .. } => visit(*base),
            Self::SquareRoot { radicand, .. } | Self::OddRoot { radicand, .. } => visit(*radicand),
            Self::Solve { matrix, rhs } => {
                visit(*matrix);
                rhs.iter().for_each(|value| visit(*value));
            }
            Self::Matrix { entries, .. } => entries.iter().for_each(|value| visit(*value)),
            Self::Entry { of, .. } => visit(*of),
        }
    }

    /// Renumbers the values used.
    fn map_operands(&mut self, image: impl Fn(Value) -> Value) {
        match self {
            Self::Number(_)
            | Self::Generator(_)
            | Self::CircleCos(_)
            | Self::CircleSin(_)
            | Self::UnityCos(_)
            | Self::UnitySin(_) => {}
            Self::Sum { terms, .. } => terms
                .iter_mut()
                .for_each(|(value, _)| *value = image(*value)),
            Self::Product { factors, .. } => {
                factors.iter_mut().for_each(|value| *value = image(*value))
            }
            Self::Power { base, .. } => *base = image(*base),
            Self::SquareRoot { radicand, .. } | Self::OddRoot { radicand, .. } => {
                *radicand = image(*radicand)
            }
            Self::Solve { matrix, rhs } => {
                *matrix = image(*matrix);
                rhs.iter_mut().for_each(|value| *value = image(*value));
            }
            Self::Matrix { entries, .. } => {
                entries.iter_mut().for_each(|value| *value = image(*value))
            }
            Self::Entry { of, .. } => *of = image(*of),
        }
    }
}

/// What a free generator stands for.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Generator {
    /// A symbol of the model, drawn freely.
    Symbol(crate::node::Symbol),
    /// A symbol determined by a nonlinear constraint: the number of the constraint.
    Dependent(u32),
    /// A transcendental element, described for people; `independent` if it is known to be algebraically independent of
    /// all the others (T6 §6.1: zero in the field proves; non-zero refutes only where this is known).
    Transcendental {
        text: String,
        independent: bool,
        /// What it is, or, for an exponential, what its argument is a multiple of.
        of: Expr,
    },
}

/// A straight-line program with what is needed to choose points for it.
#[derive(Clone, Debug, Default)]
pub(super) struct Program {
    /// The operations; operation i computes value i.
    pub(super) operations: Vec<Operation>,
    /// The rational constants, each once.
    pub(super) constants: Vec<Rational>,
    /// The values under test.
    pub(super) outputs: Vec<Value>,
    /// The nonlinear constraints: for each its left side, to be zero.
    pub(super) constraints: Vec<Value>,
    /// What the generators are.
    pub(super) generators: Vec<Generator>,
    /// Number of circles, one for each base angle.
    pub(super) circles: u32,
    /// What the base angles are multiples of, one for each circle.
    pub(super) circle_angles: Vec<Expr>,
    /// For each circle whose base angle is a multiple of a dependent symbol, the number of its constraint.
    pub(super) dependent_circles: Vec<Option<u32>>,
    /// For each constraint, whether it determines a symbol of its own; others hold besides.
    pub(super) determines: Vec<bool>,
    /// Number of square roots.
    pub(super) radicals: u32,
    /// Which of them depend on dependent symbols: these are adjoined to the tower of the constraints, not chosen.
    pub(super) adjoined: Vec<bool>,
    /// The order N of the root of unity needed for cosines of rational multiples of π; 1 if there are none.
    pub(super) order_of_unity: u64,
    /// The primes q of odd roots.
    pub(super) odd_roots: Vec<u64>,
    /// The first so many operations suffice for all radicands that depend on no dependent symbol.
    pub(super) prefix: usize,
    /// Values known to be positive wherever the expressions are defined.
    pub(super) positive: Vec<Value>,
    /// Conditions under which the program represents the expressions, for people: `x >= 0, because of sqrt(x)`.
    pub(super) conditions: Vec<String>,
    /// Are all generators known to be algebraically independent, so that non-zero in the field means non-zero?
    pub(super) faithful: bool,
}

impl Program {
    /// Whether no dependent symbol occurs both by itself and as an angle: x and sin x are independent of each other, and a constraint that
    /// contains both is no polynomial equation.
    pub(super) fn angles_stand_alone(&self) -> bool {
        let mut turning = self.dependent_circles.iter().flatten();
        turning.all(|&k| {
            let is_it = |g: &Generator| matches!(g, Generator::Dependent(j) if *j == k);
            !self.generators.iter().any(is_it)
        })
    }

    /// Drops what the outputs do not need and moves what the radicands need to the front.
    pub(super) fn arranged(mut self) -> Self {
        let count = self.operations.len();
        let mut needed = vec![false; count];
        self.outputs
            .iter()
            .chain(&self.constraints)
            .for_each(|&output| needed[output as usize] = true);
        let tainted = self.tainted();
        self.adjoined = vec![false; self.radicals as usize];
        for (operation, &tainted) in self.operations.iter().zip(&tainted) {
            if let Operation::SquareRoot { radical, .. } = operation {
                self.adjoined[*radical as usize] = tainted;
            }
        }
        let mut early = vec![false; count];
        for i in (0..count).rev() {
            if !needed[i] {
                continue;
            }
            if matches!(self.operations[i], Operation::SquareRoot { .. }) && !tainted[i] {
                early[i] = true;
            }
            let is_early = early[i];
            self.operations[i].for_each_operand(|operand| {
                needed[operand as usize] = true;
                early[operand as usize] |= is_early;
            });
        }
        let order = |wanted: bool| {
            (0..count)
                .filter(|&i| needed[i] && early[i] == wanted)
                .collect::<Vec<_>>()
        };
        let mut sequence = order(true);
        self.prefix = sequence.len();
        sequence.extend(order(false));
        self.reorder(&sequence);
        self
    }

    /// The program without outputs: what the constraints need, at the same points.
    pub(super) fn of_constraints(&self) -> Self {
        let mut own = self.clone();
        own.outputs.clear();
        own.arranged()
    }

    /// Which values depend on a dependent symbol.
    fn tainted(&self) -> Vec<bool> {
        let mut tainted: Vec<bool> = Vec::with_capacity(self.operations.len());
        for operation in &self.operations {
            let mut below = match operation {
                Operation::Generator(index) => {
                    matches!(self.generators[*index as usize], Generator::Dependent(_))
                }
                Operation::CircleCos(circle) | Operation::CircleSin(circle) => {
                    self.dependent_circles[*circle as usize].is_some()
                }
                _ => false,
            };
            operation.for_each_operand(|operand| below |= tainted[operand as usize]);
            tainted.push(below);
        }
        tainted
    }

    /// Which values a value needs, itself included.
    pub(super) fn closure(&self, value: Value) -> Vec<bool> {
        let mut needed = vec![false; self.operations.len()];
        needed[value as usize] = true;
        for i in (0..=value as usize).rev() {
            if needed[i] {
                self.operations[i].for_each_operand(|operand| needed[operand as usize] = true);
            }
        }
        needed
    }

    /// The number of radicals whose roots are chosen.
    pub(super) fn chosen_radicals(&self) -> u32 {
        self.adjoined.iter().filter(|&&adjoined| !adjoined).count() as u32
    }

    fn reorder(&mut self, sequence: &[usize]) {
        let mut position = vec![0; self.operations.len()];
        for (new, &old) in sequence.iter().enumerate() {
            position[old] = new as Value;
        }
        let mut old: Vec<Option<Operation>> = std::mem::take(&mut self.operations)
            .into_iter()
            .map(Some)
            .collect();
        for &index in sequence {
            if let Some(mut operation) = old[index].take() {
                operation.map_operands(|value| position[value as usize]);
                self.operations.push(operation);
            }
        }
        let kept: rustc_hash::FxHashSet<usize> = sequence.iter().copied().collect();
        self.positive
            .retain(|&value| kept.contains(&(value as usize)));
        let renumber = |value: &mut Value| *value = position[*value as usize];
        self.positive.iter_mut().for_each(renumber);
        self.outputs.iter_mut().for_each(renumber);
        self.constraints.iter_mut().for_each(renumber);
    }
}
