//! Random systems and the laws they must obey.
//!
//! A [`Family`] and a seed make one system, always the same ([`generate()`]). [`check`] holds it to every law of
//! [`laws`]: true statements must be *proved*, deliberately wrong equations must be *refuted*; anything else, also
//! `undecided` and `numerical`, is a failure and carries the seed and the model as text, so that anybody can repeat it.

pub mod arguments;
mod check;
pub mod generate;
pub mod laws;
mod summary;

pub use check::{check, check_all, Outcome};
pub use generate::{generate, Family, RandomSystem};
pub use laws::{Expected, Kind, Trial, CONTAINED};
pub use summary::{failures, table, times};
