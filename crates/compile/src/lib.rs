//! Expressions to numeric functions: the flat program, its interpreter, and native code.
//!
//! ```text
//! graph ──Lowering──▶ Program ──┬─ Interpreter ─┬─▶ Evaluator       one state per call
//!                               └─── Native ────┴─▶ BlockEvaluator  32 states per call
//! ```
//!
//! [`Lowering`] turns expressions of a [`Graph`](chetaev_symbolic::Graph) into a [`Program`], a register tape of plain data with named groups of
//! outputs. Common subexpressions are computed once, what depends on parameters only is computed once per set of
//! parameters, and linear systems stay structured: one factorization per matrix, shared by all right-hand sides.
//! [`Interpreter`] runs a program through the traits [`Evaluator`] and [`BlockEvaluator`], without allocating;
//! [`Native`](crate::backend()) does so as machine code where the processor has the instructions. [`backend()`] chooses.
//! [`Taylor`] computes Taylor coefficients along a motion by the recurrences of the same instructions. [`PreciseProgram`] and
//! [`PreciseTaylor`] do so in double-double arithmetic. Nothing here knows mechanics.
//!
//! ```
//! use chetaev_compile::{Evaluator, Interpreter, Lowering};
//! use chetaev_symbolic::Graph;
//!
//! let g = Graph::new();
//! let (x, m) = (g.intern_symbol("x", 0), g.intern_symbol("m", 0));
//! let energy = g.div(g.powi(g.symbol_expr(x), 2), g.symbol_expr(m));
//! let program = Lowering::new(&g)
//!     .variables(&[x])
//!     .parameters(&[m])
//!     .output("energy", &[energy])
//!     .lower()?;
//! let interpreter = Interpreter::new(program)?;
//! let mut workspace = interpreter.workspace();
//! interpreter.prepare(&[2.0], &mut workspace)?;
//! let mut energy = [0.0];
//! interpreter.evaluate(&[3.0], &mut workspace, &mut energy)?;
//! assert_eq!(energy, [4.5]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod allocate;
mod arithmetic;
mod backend;
mod decode;
mod display;
pub mod double_double;
mod emit;
pub mod evaluate;
mod factor;
mod frames;
mod horner;
pub mod interpret;
mod kernel;
mod lanes;
pub mod lower;
#[cfg(all(unix, target_arch = "x86_64"))]
pub mod native;
mod pairs;
pub mod program;
pub mod rounding;
mod scalar;
mod schedule;
mod sums;
pub mod taylor;
pub mod verify;

pub use backend::{backend, wish, Backend, UnknownBackend, Wish, VARIABLE};
pub use double_double::PreciseProgram;
pub use evaluate::{BlockEvaluator, EvaluateFailure, Evaluator};
pub use interpret::{BlockWorkspace, Interpreter, Workspace};
pub use lanes::{Lanes, LANES};
pub use lower::{LowerError, Lowering};
#[cfg(all(unix, target_arch = "x86_64"))]
pub use native::{Native, Vectors};
pub use program::Program;
pub use taylor::{Abreast, PreciseTaylor, Taylor, TaylorWorkspace, ABREAST};
pub use verify::VerifyError;
