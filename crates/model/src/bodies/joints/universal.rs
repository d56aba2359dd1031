//! Hooke's joint: two angles about axes that meet, the first fixed in the parent, the second in the child.

use super::kind::{turns, Axes, Joint};

pub(super) const UNIVERSAL: Joint = Joint {
    word: "universal",
    says: "Hooke's joint: two angles about axes that meet",
    axes: Axes::Sequence(2),
    usual: "xy",
    motions: turns,
};
