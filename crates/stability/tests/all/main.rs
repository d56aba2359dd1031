//! All integration tests of this package in one program, so that the package is linked once. A test is run by its module and name:
//! `cargo test -p chetaev-stability --test all MODULE::`.

mod algebraic;
mod borders;
mod chains;
mod common;
mod corners;
mod descriptor;
mod reference;
mod spectra;
mod state_space;
mod steady_set;
mod theorems;
mod values;
mod verdicts;
