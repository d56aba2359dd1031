//! All integration tests of this package in one program, so that the package is linked once. A test is run by its module and name:
//! `cargo test -p chetaev-compile --test all MODULE::`.

mod abreast;
mod back_ends;
mod double_double;
mod functions;
mod random_programs;
mod taylor;
