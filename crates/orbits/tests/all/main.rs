//! All integration tests of this package in one program, so that the package is linked once. A test is run by its module and name:
//! `cargo test -p chetaev-orbits --test all MODULE::`.

mod equations;
mod random;
mod systems;
