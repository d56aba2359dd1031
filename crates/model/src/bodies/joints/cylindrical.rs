//! A slide that may turn: a length along and an angle about one axis.

use super::kind::{Axes, Joint, Motion};

pub(super) const CYLINDRICAL: Joint = Joint {
    word: "cylindrical",
    says: "a slide that may turn: a length and an angle about one axis",
    axes: Axes::One,
    usual: "z",
    motions: |axes| {
        let both = |own: &super::kind::Direction| {
            [
                Motion::slide(own.axis, "shift"),
                Motion::turn(own.axis, "angle"),
            ]
            .map(|motion| motion.directed(own.is_backward))
        };
        axes.iter().flat_map(both).collect()
    },
};
