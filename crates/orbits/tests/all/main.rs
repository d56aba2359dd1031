//! All integration tests of this package in one program, so that the package is linked once. A test is run by its module and name:
//! `cargo test -p chetaev-orbits --test all MODULE::`.

mod equations;
mod random;
mod systems;

use chetaev_orbits::branch::Pace;

/// At most so many points on each side of the start, in steps of the usual length.
fn points(points: usize) -> Pace {
    Pace {
        points,
        ..Pace::default()
    }
}
