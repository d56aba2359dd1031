//! All integration tests of this package in one program, so that the package is linked once. A test is run by its module and name:
//! `cargo test -p chetaev-study --test all MODULE::`.

mod components;
mod integrals_along;
mod linear;
mod multiplicity;
mod steady;
mod steps;
mod titles;
