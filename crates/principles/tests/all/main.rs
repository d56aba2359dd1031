//! All integration tests of this package in one program, so that the package is linked once. A test is run by its module and name:
//! `cargo test -p chetaev-principles --test all MODULE::`.

mod acceptance;
mod action;
mod chaplygin_multiplier;
mod coincidence;
mod common;
mod controls;
mod energy;
mod hamilton;
mod hamilton_jacobi;
mod map;
mod second_kind;
mod stated;
mod stationary;
mod variations;
