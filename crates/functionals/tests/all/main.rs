//! All integration tests of this package in one program, so that the package is linked once.
#![allow(clippy::unwrap_used, reason = "test code fails where it stands")]

mod bar;
mod classical;
mod conjugates;
mod curved;
mod examples;
mod indexed;
mod methods;
mod mutants;
mod names;
mod noether;
mod printed;
mod reference;
mod table;
mod values;
