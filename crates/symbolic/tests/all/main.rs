//! All integration tests of this package in one program, so that the package is linked once. A test is run by its module and name:
//! `cargo test -p chetaev-symbolic --test all MODULE::`.

mod algebraic;
mod code;
mod million;
