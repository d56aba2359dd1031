//! Order 0: the program with all its values as outputs, and the inverses of the matrices of its systems.

use crate::allocate::{self, Group};
use crate::emit::Origin;
use crate::program::{Constant, Exact, Instruction, Program, Register, Solve};
use crate::schedule::Single;
use chetaev_symbolic::rational::{integer, to_f64};
use std::ops::Range;

/// The program of order 0.
pub(super) struct Zero {
    /// Its outputs are the registers computed by the body, then the inverses, row by row.
    pub(super) program: Program,
    /// The registers computed by the body.
    pub(super) body: Range<usize>,
}

/// The registers of the variables.
pub(super) fn variables(single: &Single) -> Range<usize> {
    let layout = &single.program.layout;
    let start = layout.constants + layout.parameters;
    start..start + layout.variables
}

/// The program of order 0 that goes with `single`, with the inverses of matrices of the sizes given.
pub(super) fn program(single: &Single, inverses: &[(usize, usize)]) -> Zero {
    let mut program = single.program.clone();
    let mut origins = single.origins.clone();
    // Registers of the body were numbered last.
    let start = origins.iter().position(|&origin| origin == Origin::Body);
    let body = start.unwrap_or(origins.len())..origins.len();
    let mut registers: Vec<Register> = body.clone().map(|r| Register(r as u32)).collect();
    let unit = [0, 1].map(|n| constant(n, &mut program, &mut origins));
    for &(matrix, size) in inverses {
        let first = origins.len();
        for column in 0..size {
            let rhs = (0..size).map(|row| unit[usize::from(row == column)]);
            program.solves.push(Solve {
                matrix: matrix as u32,
                rhs: rhs.collect(),
                out: (0..size)
                    .map(|i| Register((first + column * size + i) as u32))
                    .collect(),
            });
            let solve = program.solves.len() as u32 - 1;
            program.body.push(Instruction::Solve { solve });
        }
        origins.resize(first + size * size, Origin::Body);
        let entry = |k: usize| Register((first + k % size * size + k / size) as u32);
        registers.extend((0..size * size).map(entry));
    }
    let end = program.body.len();
    let groups = vec![Group {
        name: "values".into(),
        registers,
        end,
    }];
    Zero {
        program: allocate::place(program, origins, groups),
        body,
    }
}

/// A register with an integer in it.
fn constant(n: i64, program: &mut Program, origins: &mut Vec<Origin>) -> Register {
    let exact = integer(n);
    let constant = Constant {
        value: to_f64(&exact),
        exact: Exact::Rational(exact),
    };
    program.constants.push(constant);
    program.layout.constants += 1;
    origins.push(Origin::Constant(program.constants.len() as u32 - 1));
    Register(origins.len() as u32 - 1)
}
