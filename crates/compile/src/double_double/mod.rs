//! Programs in double-double arithmetic: about 31 digits.
//!
//! The instructions are those of every other back end; constants are rounded to double-double from their exact values, not
//! from their doubles, and linear systems are solved by L D Lᵀ or L U in the same arithmetic. Interpreted on every machine.

mod convert;
mod evaluate;
mod linear;

pub use chetaev_double_double::DoubleDouble;
pub use convert::{decimal, from_rational, to_rational};
pub use evaluate::PreciseProgram;
pub(crate) use evaluate::{outputs_of, Values};
