//! All integration tests of this package in one program, so that the package is linked once.
#![allow(clippy::unwrap_used, reason = "test code fails where it stands")]

mod classical;
mod curved;
mod mutants;
mod reference;
mod table;
