//! All integration tests of this package in one program, so that the package is linked once. A test is run by its module and name:
//! `cargo test -p chetaev-integrate --test all MODULE::`.

mod accuracy;
mod common;
mod double_double;
mod events;
mod hooks;
mod order_conditions;
mod stops;
mod taylor;
