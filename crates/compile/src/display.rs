//! The text form of a program, for tests and for people.
//!
//! Registers are named by what they are: `c` constants, `p` parameters, `h` hoisted values, `x` variables, `t`
//! temporaries. Matrices are `A`, numbered.

use crate::program::{
    Binary, Exact, Factorization, Fused, Instruction, Layout, Program, Register, Unary,
};
use std::fmt::{Display, Formatter, Result};

impl Display for Program {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        for (i, constant) in self.constants.iter().enumerate() {
            match &constant.exact {
                Exact::Rational(value) => writeln!(f, "constant c{i} = {value}")?,
                Exact::Pi => writeln!(f, "constant c{i} = pi")?,
            }
        }
        for (i, name) in self.parameters.iter().enumerate() {
            writeln!(f, "parameter p{i} = {name}")?;
        }
        for (i, name) in self.variables.iter().enumerate() {
            writeln!(f, "variable x{i} = {name}")?;
        }
        writeln!(f, "prologue")?;
        for &instruction in &self.prologue {
            self.write(f, instruction)?;
        }
        writeln!(f, "body")?;
        let mut done = 0;
        for group in &self.outputs {
            for &instruction in self.body.get(done..group.end).unwrap_or_default() {
                self.write(f, instruction)?;
            }
            done = group.end;
            let registers = self.list(&group.registers);
            writeln!(f, "  output {} = {registers}", group.name)?;
        }
        Ok(())
    }
}

/// A register with the letter of its kind.
struct Named<'p>(&'p Layout, Register);

impl Display for Named<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let (layout, register) = (self.0, self.1.index());
        for (letter, range) in [
            ('c', 0..layout.constants),
            ('p', layout.parameter_range()),
            ('h', layout.hoisted_range()),
            ('x', layout.variable_range()),
        ] {
            if range.contains(&register) {
                return write!(f, "{letter}{}", register - range.start);
            }
        }
        write!(
            f,
            "t{}",
            register.saturating_sub(layout.temporary_range().start)
        )
    }
}

impl Program {
    fn name(&self, register: Register) -> Named<'_> {
        Named(&self.layout, register)
    }

    fn list(&self, registers: &[Register]) -> String {
        let names: Vec<String> = registers
            .iter()
            .map(|&r| self.name(r).to_string())
            .collect();
        names.join(" ")
    }

    fn write(&self, f: &mut Formatter<'_>, instruction: Instruction) -> Result {
        let name = |r| self.name(r);
        match instruction {
            Instruction::Unary { operation, out, a } => {
                let (out, a) = (name(out), name(a));
                match operation {
                    Unary::Neg => writeln!(f, "  {out} = -{a}"),
                    Unary::Square => writeln!(f, "  {out} = {a}^2"),
                    Unary::Sqrt => writeln!(f, "  {out} = sqrt {a}"),
                    Unary::Function(function) => writeln!(f, "  {out} = {} {a}", function.name()),
                }
            }
            Instruction::Binary {
                operation,
                out,
                a,
                b,
            } => {
                let (out, a, b) = (name(out), name(a), name(b));
                match operation {
                    Binary::Add => writeln!(f, "  {out} = {a} + {b}"),
                    Binary::Sub => writeln!(f, "  {out} = {a} - {b}"),
                    Binary::Mul => writeln!(f, "  {out} = {a} * {b}"),
                    Binary::Div => writeln!(f, "  {out} = {a} / {b}"),
                    Binary::Pow => writeln!(f, "  {out} = {a} ^ {b}"),
                    Binary::Atan2 => writeln!(f, "  {out} = atan2 {a} {b}"),
                }
            }
            Instruction::Fused {
                operation,
                out,
                a,
                b,
                c,
            } => {
                let (out, a, b, c) = (name(out), name(a), name(b), name(c));
                match operation {
                    Fused::MulAdd => writeln!(f, "  {out} = {a} * {b} + {c}"),
                    Fused::MulSub => writeln!(f, "  {out} = {a} * {b} - {c}"),
                    Fused::NegMulAdd => writeln!(f, "  {out} = {c} - {a} * {b}"),
                }
            }
            Instruction::SinCos { sin, cos, a } => {
                writeln!(f, "  {} {} = sincos {}", name(sin), name(cos), name(a))
            }
            Instruction::Factor { matrix } => self.write_factor(f, matrix),
            Instruction::Solve { solve } => self.write_solve(f, solve),
        }
    }

    fn write_factor(&self, f: &mut Formatter<'_>, index: u32) -> Result {
        let Some(matrix) = self.matrices.get(index as usize) else {
            return writeln!(f, "  A{index} = ?");
        };
        let method = match matrix.factorization {
            Factorization::Lu => "lu",
            Factorization::Ldlt => "ldlt",
        };
        let rows: Vec<String> = matrix
            .entries
            .chunks(matrix.size.max(1))
            .map(|row| self.list(row))
            .collect();
        writeln!(f, "  A{index} = {method} [{}]", rows.join("; "))
    }

    fn write_solve(&self, f: &mut Formatter<'_>, index: u32) -> Result {
        let Some(solve) = self.solves.get(index as usize) else {
            return writeln!(f, "  ? = solve {index}");
        };
        let (out, rhs) = (self.list(&solve.out), self.list(&solve.rhs));
        writeln!(f, "  {out} = solve A{} [{rhs}]", solve.matrix)
    }
}
