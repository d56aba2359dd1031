//! All integration tests of this package in one program, so that the package is linked once. A test is run by its module and name:
//! `cargo test -p chetaev-orbits --test all MODULE::`.

mod common;
mod curves;
mod equations;
mod modes;
mod periodic;
mod random;
mod sensitivities;

use chetaev_orbits::continuation::Pace;

/// At most so many points on each side of the start, in steps of the usual length.
fn points(points: usize) -> Pace {
    Pace {
        points,
        ..Pace::default()
    }
}
