//! A hinge: one angle about an axis.

use super::kind::{Axes, Joint, Motion};

pub(super) const REVOLUTE: Joint = Joint {
    word: "revolute",
    says: "a hinge: one angle about an axis",
    axes: Axes::One,
    usual: "z",
    motions: |axes| {
        let turn =
            |own: &super::kind::Direction| Motion::turn(own.axis, "").directed(own.is_backward);
        axes.iter().map(turn).collect()
    },
};
