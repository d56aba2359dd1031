//! Exact expressions: an interned graph, its calculus, zero testing and printing; owns [`Verdict`](verdict::Verdict).
//!
//! Nothing here knows mechanics: symbols carry a name and an order of differentiation, and that is all.

pub mod number;
pub mod polynomial;
pub mod print;
pub mod syntax;
pub mod zero;
