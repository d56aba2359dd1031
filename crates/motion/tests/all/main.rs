//! All integration tests of this package in one program, so that the package is linked once. A test is run by its module and name:
//! `cargo test -p chetaev-motion --test all MODULE::`.

#[allow(clippy::unwrap_used, reason = "test code fails where it stands")]
mod common;

mod closed_forms;
mod crossings;
mod direct;
mod double_double;
mod kept_integrals;
mod long_runs;
mod sticking;
