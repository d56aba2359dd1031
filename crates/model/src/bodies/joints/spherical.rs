//! A ball joint: three Euler angles.

use super::kind::{turns, Axes, Joint};

pub(super) const SPHERICAL: Joint = Joint {
    word: "spherical",
    axes: Axes::Sequence(3),
    usual: "zxz",
    motions: turns,
};
