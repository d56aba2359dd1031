//! A slide: one length along an axis.

use super::kind::{Axes, Joint, Motion};

pub(super) const PRISMATIC: Joint = Joint {
    word: "prismatic",
    says: "a slide: one length along an axis",
    axes: Axes::One,
    usual: "x",
    motions: |axes| {
        let slide =
            |own: &super::kind::Direction| Motion::slide(own.axis, "").directed(own.is_backward);
        axes.iter().map(slide).collect()
    },
};
