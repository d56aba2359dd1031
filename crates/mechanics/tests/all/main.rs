//! All integration tests of this package in one program, so that the package is linked once. A test is run by its module and name:
//! `cargo test -p chetaev-mechanics --test all MODULE::`.

mod bodies;
mod closed_forms;
mod constraint_set;
mod formulations;
mod mechanisms;
mod multiplicity;
mod stated;
mod surfaces;
mod touching;
mod twins;
