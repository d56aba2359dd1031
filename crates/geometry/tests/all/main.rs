//! All integration tests of this package in one program, so that the package is linked once. A test is run by its module and name:
//! `cargo test -p chetaev-geometry --test all MODULE::`.

mod common;
mod components;
mod darboux;
mod densities;
mod examples;
mod families;
mod first_integrals;
mod frobenius;
mod generators;
mod kept_functions;
mod killing;
mod moving;
mod parts;
mod quadratures;
mod told;
