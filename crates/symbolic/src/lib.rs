//! Exact expressions: an interned graph, its calculus, zero testing and printing; owns [`Verdict`].
//!
//! Nothing here knows mechanics: symbols carry a name and an order of differentiation, and that is all.
//!
//! - [`syntax`]: text to tree to expression, with diagnostics;
//! - [`graph`], [`construct`], [`mod@functions`], [`linear`]: the hash-consed graph and its canonical constructors;
//! - [`calculus`], [`substitute`], [`evaluate`]: derivatives, replacement, values in double precision;
//! - [`number`], [`polynomial`], [`matrix`], [`factors`], [`quadratic_factors`]: exact arithmetic, normal forms, factorization;
//! - [`common_zeros`], [`real_factors`], [`one_to_one`]: where functions vanish, written by simpler ones;
//! - [`zero`]: whether expressions vanish, on their own or on constraints: exact forms, modular proofs, refutation by balls;
//! - [`mod@simplify`], [`mod@print`]: formulas for reading; no proof rests on a simplification;
//! - [`verdict`]: what is known about a statement.

pub mod calculus;
pub mod common_zeros;
pub mod construct;
mod digest;
pub mod evaluate;
pub mod factors;
pub mod functions;
pub mod graph;
pub mod linear;
pub mod matrix;
pub mod meter;
pub mod node;
pub mod number;
pub mod one_to_one;
pub mod parallel;
pub mod polynomial;
pub mod print;
pub mod quadratic_factors;
pub mod rational;
pub mod real_factors;
pub mod simplify;
pub mod substitute;
pub mod syntax;
pub mod verdict;
pub mod zero;

pub use graph::Graph;
pub use node::{Expr, Function, Node, Symbol};
pub use rational::Rational;
pub use verdict::Verdict;
