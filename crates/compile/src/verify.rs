//! Checks that a program is well formed. The properties:
//!
//! - the layout counts constants, parameters and variables as they are;
//! - every register is inside the register file and is written before it is read;
//! - the prologue writes hoisted registers and temporaries, the body writes temporaries only, and reads no
//!   temporary that only the prologue has written;
//! - every instruction refers to a matrix or system that exists; matrices have `size² > 0` entries, systems as many
//!   right-hand sides and results as their matrix has rows; a matrix is factorized once, before it is used;
//! - `tan`, `cot`, `sec`, `csc` and `atan2` do not occur as functions of one argument;
//! - groups of outputs end in order, and read registers that are written by then.
//!
//! The interpreters rely on them for indexing, never for memory safety.

use crate::program::{Instruction, OutputGroup, Program, Register, Unary};
use chetaev_symbolic::Function;

/// Why a program is not well formed.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum VerifyError {
    /// The layout contradicts the lists of constants, parameters or variables.
    #[error("the layout has {expected} {what}, the program {found}")]
    Layout {
        /// Which of them.
        what: &'static str,
        /// Number in the layout.
        expected: usize,
        /// Number in the program.
        found: usize,
    },
    /// A register is outside of the register file.
    #[error("register {register} does not exist ({place})")]
    OutOfRange {
        /// The register.
        register: usize,
        /// Where it is used.
        place: Place,
    },
    /// A register is read before it is written.
    #[error("register {register} is read before it is written ({place})")]
    Undefined {
        /// The register.
        register: usize,
        /// Where it is read.
        place: Place,
    },
    /// A register is written that must not be.
    #[error("register {register} must not be written ({place})")]
    ReadOnly {
        /// The register.
        register: usize,
        /// Where it is written.
        place: Place,
    },
    /// A matrix or system does not exist, or has inconsistent sizes.
    #[error("a linear system does not exist or has inconsistent sizes ({0})")]
    System(Place),
    /// A system is solved before its matrix is factorized, or a matrix is factorized twice.
    #[error("a matrix is used before it is factorized, or factorized twice ({0})")]
    FactorOrder(Place),
    /// A function that has to be lowered to other instructions.
    #[error("`{}` is not an instruction ({place})", .function.name())]
    NotAnInstruction {
        /// The function.
        function: Function,
        /// Where it occurs.
        place: Place,
    },
    /// A group of outputs ends before the one before it, or after the body.
    #[error("the outputs `{0}` are not in the order of the body")]
    GroupOrder(String),
}

/// A place in a program.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Place {
    /// An instruction of the prologue.
    Prologue(usize),
    /// An instruction of the body.
    Body(usize),
    /// A group of outputs.
    Output(usize),
}

impl std::fmt::Display for Place {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Place::Prologue(i) => write!(f, "instruction {i} of the prologue"),
            Place::Body(i) => write!(f, "instruction {i} of the body"),
            Place::Output(i) => write!(f, "group {i} of the outputs"),
        }
    }
}

impl Program {
    /// Checks the properties listed in [`verify`](crate::verify).
    ///
    /// # Errors
    /// The first violation found.
    pub fn verify(&self) -> Result<(), VerifyError> {
        self.verify_layout()?;
        let mut checker = Checker {
            program: self,
            is_defined: vec![false; self.layout.len()],
            is_factorized: vec![false; self.matrices.len()],
        };
        checker.define(0..self.layout.constants);
        checker.define(self.layout.parameter_range());
        for (i, &instruction) in self.prologue.iter().enumerate() {
            checker.check(instruction, Place::Prologue(i))?;
        }
        checker.define(self.layout.variable_range());
        checker.is_defined[self.layout.temporary_range()].fill(false);
        let mut done = 0;
        for (g, group) in self.outputs.iter().enumerate() {
            let part = self.part(done, group)?;
            for (i, &instruction) in part.iter().enumerate() {
                checker.check(instruction, Place::Body(done + i))?;
            }
            done = group.end;
            for &r in &group.registers {
                checker.check_read(r, Place::Output(g))?;
            }
        }
        Ok(())
    }

    fn part(&self, start: usize, group: &OutputGroup) -> Result<&[Instruction], VerifyError> {
        let part = self.body.get(start..group.end);
        part.ok_or_else(|| VerifyError::GroupOrder(group.name.clone()))
    }

    fn verify_layout(&self) -> Result<(), VerifyError> {
        let layout = &self.layout;
        for (what, expected, found) in [
            ("constants", layout.constants, self.constants.len()),
            ("parameters", layout.parameters, self.parameters.len()),
            ("variables", layout.variables, self.variables.len()),
        ] {
            if expected != found {
                return Err(VerifyError::Layout {
                    what,
                    expected,
                    found,
                });
            }
        }
        Ok(())
    }
}

struct Checker<'p> {
    program: &'p Program,
    is_defined: Vec<bool>,
    is_factorized: Vec<bool>,
}

impl Checker<'_> {
    fn define(&mut self, registers: std::ops::Range<usize>) {
        self.is_defined[registers].fill(true);
    }

    fn check(&mut self, instruction: Instruction, place: Place) -> Result<(), VerifyError> {
        self.check_kind(instruction, place)?;
        let mut result = Ok(());
        self.program.for_each_read(instruction, |r| {
            if result.is_ok() {
                result = self.check_read(r, place);
            }
        });
        let program = self.program;
        program.for_each_write(instruction, |r| {
            if result.is_ok() {
                result = self.check_write(r, place);
            }
        });
        result
    }

    fn check_kind(&mut self, instruction: Instruction, place: Place) -> Result<(), VerifyError> {
        match instruction {
            Instruction::Unary {
                operation: Unary::Function(function),
                ..
            } => {
                use Function::{Atan2, Cot, Csc, Sec, Tan};
                if matches!(function, Tan | Cot | Sec | Csc | Atan2) {
                    return Err(VerifyError::NotAnInstruction { function, place });
                }
            }
            Instruction::Factor { matrix } => {
                let matrices = &self.program.matrices;
                let size = matrices
                    .get(matrix as usize)
                    .map(|m| (m.size, m.entries.len()));
                if !size.is_some_and(|(n, entries)| n > 0 && n.checked_mul(n) == Some(entries)) {
                    return Err(VerifyError::System(place));
                }
                if std::mem::replace(&mut self.is_factorized[matrix as usize], true) {
                    return Err(VerifyError::FactorOrder(place));
                }
            }
            Instruction::Solve { solve } => self.check_solve(solve as usize, place)?,
            _ => {}
        }
        Ok(())
    }

    fn check_solve(&self, solve: usize, place: Place) -> Result<(), VerifyError> {
        let Some(solve) = self.program.solves.get(solve) else {
            return Err(VerifyError::System(place));
        };
        let Some(matrix) = self.program.matrices.get(solve.matrix as usize) else {
            return Err(VerifyError::System(place));
        };
        if solve.rhs.len() != matrix.size || solve.out.len() != matrix.size {
            return Err(VerifyError::System(place));
        }
        if !self.is_factorized[solve.matrix as usize] {
            return Err(VerifyError::FactorOrder(place));
        }
        Ok(())
    }

    fn check_read(&self, r: Register, place: Place) -> Result<(), VerifyError> {
        let register = r.index();
        match self.is_defined.get(register) {
            Some(true) => Ok(()),
            Some(false) => Err(VerifyError::Undefined { register, place }),
            None => Err(VerifyError::OutOfRange { register, place }),
        }
    }

    fn check_write(&mut self, r: Register, place: Place) -> Result<(), VerifyError> {
        let register = r.index();
        let layout = &self.program.layout;
        let is_hoisted = layout.hoisted_range().contains(&register);
        let is_temporary = layout.temporary_range().contains(&register);
        if register >= self.is_defined.len() {
            return Err(VerifyError::OutOfRange { register, place });
        }
        let is_writable = is_temporary || (is_hoisted && matches!(place, Place::Prologue(_)));
        if !is_writable {
            return Err(VerifyError::ReadOnly { register, place });
        }
        self.is_defined[register] = true;
        Ok(())
    }
}
