//! A ball joint: three Euler angles.

use super::kind::{turns, Axes, Joint};

pub(super) const SPHERICAL: Joint = Joint {
    word: "spherical",
    says: "a ball joint: three Euler angles",
    axes: Axes::Sequence(3),
    usual: "zxz",
    motions: turns,
};
