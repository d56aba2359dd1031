//! Expressions as people write them: lexer, syntax tree with spans, parser, lowering to the graph.
//!
//! Parsing is total: every text gives a tree and a list of diagnostics, and a part that could not be read is
//! [`ast::Node::Error`]. Nothing here recurses on the text, so a hundred thousand nested parentheses are only slow
//! to read.
//!
//! # The language
//!
//! | written | read as |
//! |---|---|
//! | `x'`, `x''`, `x′`, `x″` | first and second derivative with respect to the time |
//! | `theta`, `θ`, `q_1`, `q₁`, `theta_{i-1}` | names; Greek letters are their names, braces hold integer indices |
//! | `0.1`, `1e-3`, `2/3` | exact rational numbers |
//! | `2 m x'^2`, `a (x+1)` | implicit products, with the precedence of `*`, associating to the left |
//! | `1/2 m x'^2` | (1/2)·m·(x')² |
//! | `-x^2` | −(x²) |
//! | `a^b^c`, `a**b**c` | a^(b^c) |
//! | `sin^2(x)` | (sin x)²; only for a positive integer written in digits |
//! | `sum(i = 1..n, body)` | the sum over the integers 1, 2, …, n, both ends included |
//! | `left = right`, `0 < a <= b` | equations and chains of comparisons |
//!
//! From strongest to weakest: primes; powers; the sign; products and quotients; sums; comparisons.

pub mod ast;
pub mod diagnostic;
pub mod functions;
pub mod lexer;
pub mod lower;
pub mod names;
pub mod parse;
pub mod span;
mod unknown;

#[cfg(test)]
mod tests;

pub use ast::{NodeId, Relation, Tree};
pub use diagnostic::{Diagnostic, Severity, Suggestion};
pub use functions::Builtin;
pub use lower::{lower, Resolution, Scope};
pub use parse::{parse_equation, parse_expression, parse_range, parse_relation, Parsed};
pub use span::Span;
