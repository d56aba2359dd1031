//! What rounding leaves open in the outputs of a program: running error analysis.
//!
//! Every number carries a bound of its error; an operation passes on the errors of its operands and adds its own rounding
//! (Wilkinson 1986, SIAM News 19; Higham 2002, Accuracy and Stability of Numerical Algorithms, sec. 3.3). The bound of a sum
//! that cancels stays as large as its terms, so a value within its bound says nothing, whatever the units. Bounds are to first order
//! and not rounded outwards: they serve numerical decisions, not proofs.

use crate::double_double::from_rational;
use crate::program::{Binary, Constant, Exact, Fused, Instruction, Program, Register, Unary};
use chetaev_symbolic::evaluate::apply;
use chetaev_symbolic::rational::to_i64;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A number with a bound of its error.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Rounded {
    /// The value in double precision.
    pub value: f64,
    /// A bound of the distance to the exact value.
    pub error: f64,
}

/// Half a unit in the last place, relative.
const UNIT: f64 = f64::EPSILON / 2.0;

impl Rounded {
    /// A number that is exact.
    pub const fn exact(value: f64) -> Rounded {
        Rounded { value, error: 0.0 }
    }

    /// The double nearest to a number that is not known to be one.
    pub fn nearest(value: f64) -> Rounded {
        Rounded {
            value,
            error: UNIT * value.abs(),
        }
    }

    /// Whether it is zero as far as rounding tells: within `factor` times its bound. True for what is not a number.
    pub fn is_zero(self, factor: f64) -> bool {
        self.value.is_nan() || self.value.abs() <= factor * self.error
    }

    /// The size of the terms of which the value was made: its bound in units of rounding.
    pub fn size(self) -> f64 {
        self.value.abs().max(self.error / UNIT)
    }

    /// A result with the error that its operands bring, and its own rounding.
    fn with(value: f64, brought: f64) -> Rounded {
        Rounded {
            value,
            error: brought + UNIT * value.abs(),
        }
    }

    /// A function, by its values at the ends of what the argument may be.
    fn map(self, f: impl Fn(f64) -> f64) -> Rounded {
        let value = f(self.value);
        if self.error == 0.0 {
            return Rounded::with(value, 0.0);
        }
        let ends = [self.value - self.error, self.value + self.error].map(f);
        let apart = ends.map(|end| (end - value).abs());
        // Of an end outside the domain nothing is known, and the other says it all.
        Rounded::with(value, apart[0].max(apart[1]))
    }
}

impl Add for Rounded {
    type Output = Rounded;
    fn add(self, other: Rounded) -> Rounded {
        Rounded::with(self.value + other.value, self.error + other.error)
    }
}

impl Sub for Rounded {
    type Output = Rounded;
    fn sub(self, other: Rounded) -> Rounded {
        Rounded::with(self.value - other.value, self.error + other.error)
    }
}

impl Neg for Rounded {
    type Output = Rounded;
    fn neg(self) -> Rounded {
        Rounded {
            value: -self.value,
            ..self
        }
    }
}

impl Mul for Rounded {
    type Output = Rounded;
    fn mul(self, other: Rounded) -> Rounded {
        let brought = self.error * other.value.abs() + other.error * self.value.abs();
        Rounded::with(self.value * other.value, brought + self.error * other.error)
    }
}

impl Div for Rounded {
    type Output = Rounded;
    fn div(self, other: Rounded) -> Rounded {
        let value = self.value / other.value;
        let least = other.value.abs() - other.error;
        let brought = match least > 0.0 {
            true => (self.error + value.abs() * other.error) / least,
            false if self.error == 0.0 && other.error == 0.0 => 0.0,
            false => f64::INFINITY,
        };
        Rounded::with(value, brought)
    }
}

/// The outputs of a program, group by group, at these parameters and variables, each taken to be the double nearest to a number; `None`
/// where a linear system is singular.
pub fn rounding(program: &Program, parameters: &[f64], variables: &[f64]) -> Option<Vec<Rounded>> {
    let mut file = vec![Rounded::default(); program.layout.len()];
    for (register, constant) in file.iter_mut().zip(&program.constants) {
        *register = of_constant(constant);
    }
    for (range, values) in [
        (program.layout.parameter_range(), parameters),
        (program.layout.variable_range(), variables),
    ] {
        let given = values.iter().map(|&value| Rounded::nearest(value));
        file[range].iter_mut().zip(given).for_each(|(a, b)| *a = b);
    }
    let run = |instructions: &[Instruction], file: &mut Vec<Rounded>| {
        let mut all = instructions.iter();
        all.try_for_each(|&instruction| execute(program, instruction, file))
    };
    run(&program.prologue, &mut file)?;
    let (mut outputs, mut done) = (Vec::with_capacity(program.output_count()), 0);
    for group in &program.outputs {
        run(&program.body[done..group.end], &mut file)?;
        done = group.end;
        outputs.extend(
            group
                .registers
                .iter()
                .map(|register| file[register.index()]),
        );
    }
    Some(outputs)
}

fn of_constant(constant: &Constant) -> Rounded {
    let is_exact = match &constant.exact {
        Exact::Rational(exact) => {
            to_i64(exact).is_some_and(|n| n.unsigned_abs() < 1 << 53)
                || from_rational(exact).low() == 0.0
        }
        Exact::Pi => false,
    };
    if is_exact {
        Rounded::exact(constant.value)
    } else {
        Rounded::nearest(constant.value)
    }
}

/// Carries out one instruction; `None` where a linear system is singular.
fn execute(program: &Program, instruction: Instruction, file: &mut [Rounded]) -> Option<()> {
    let at = |file: &[Rounded], register: Register| file[register.index()];
    match instruction {
        Instruction::Unary { operation, out, a } => {
            file[out.index()] = unary(operation, at(file, a));
        }
        Instruction::Binary {
            operation,
            out,
            a,
            b,
        } => file[out.index()] = binary(operation, at(file, a), at(file, b)),
        Instruction::Fused {
            operation,
            out,
            a,
            b,
            c,
        } => {
            let (product, c) = (at(file, a) * at(file, b), at(file, c));
            file[out.index()] = match operation {
                Fused::MulAdd => product + c,
                Fused::MulSub => product - c,
                Fused::NegMulAdd => c - product,
            };
        }
        Instruction::SinCos { sin, cos, a } => {
            let angle = at(file, a);
            file[sin.index()] = angle.map(f64::sin);
            file[cos.index()] = angle.map(f64::cos);
        }
        Instruction::Factor { .. } => {}
        Instruction::Solve { solve } => {
            let solve = program.solves.get(solve as usize)?;
            let matrix = program.matrices.get(solve.matrix as usize)?;
            let entries: Vec<Rounded> = matrix.entries.iter().map(|&r| at(file, r)).collect();
            let right: Vec<Rounded> = solve.rhs.iter().map(|&r| at(file, r)).collect();
            let solution = solution(entries, right)?;
            for (out, x) in solve.out.iter().zip(solution) {
                file[out.index()] = x;
            }
        }
    }
    Some(())
}

fn unary(operation: Unary, a: Rounded) -> Rounded {
    match operation {
        Unary::Neg => -a,
        Unary::Square => a * a,
        Unary::Sqrt => a.map(f64::sqrt),
        Unary::Function(function) => a.map(|x| apply(function, x)),
    }
}

fn binary(operation: Binary, a: Rounded, b: Rounded) -> Rounded {
    let of_two = |f: fn(f64, f64) -> f64| {
        let first = a.map(|x| f(x, b.value));
        let second = b.map(|y| f(a.value, y));
        Rounded {
            value: first.value,
            error: first.error + second.error,
        }
    };
    match operation {
        Binary::Add => a + b,
        Binary::Sub => a - b,
        Binary::Mul => a * b,
        Binary::Div => a / b,
        Binary::Pow => of_two(libm::pow),
        Binary::Atan2 => of_two(libm::atan2),
    }
}

/// The solution of A x = b by elimination, the rows compared by their entries relative to their bounds.
fn solution(mut a: Vec<Rounded>, mut b: Vec<Rounded>) -> Option<Vec<Rounded>> {
    let n = b.len();
    for k in 0..n {
        let quality = |i: &usize| {
            let row = &a[i * n + k..i * n + n];
            row[0].value.abs() / row.iter().fold(0.0, |m: f64, x| m.max(x.value.abs()))
        };
        let best = (k..n).max_by(|i, j| quality(i).total_cmp(&quality(j)))?;
        if a[best * n + k].is_zero(1.0) {
            return None;
        }
        (0..n).for_each(|j| a.swap(k * n + j, best * n + j));
        b.swap(k, best);
        for i in k + 1..n {
            let factor = a[i * n + k] / a[k * n + k];
            for j in k + 1..n {
                a[i * n + j] = a[i * n + j] - factor * a[k * n + j];
            }
            b[i] = b[i] - factor * b[k];
        }
    }
    for i in (0..n).rev() {
        for j in i + 1..n {
            b[i] = b[i] - a[i * n + j] * b[j];
        }
        b[i] = b[i] / a[i * n + i];
    }
    Some(b)
}
