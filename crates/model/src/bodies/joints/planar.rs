//! Motion in a plane: two lengths, and an angle about the normal.

use super::kind::{Axes, Joint, Motion};

pub(super) const PLANAR: Joint = Joint {
    word: "planar",
    says: "two lengths, and an angle about the normal",
    axes: Axes::One,
    usual: "z",
    motions: |axes| {
        const WORDS: [&str; 3] = ["x", "y", "z"];
        let all = |own: &super::kind::Direction| {
            let slides = [0, 1, 2].into_iter().filter(|axis| *axis != own.axis);
            let turn = Motion::turn(own.axis, "angle").directed(own.is_backward);
            slides
                .map(|axis| Motion::slide(axis, WORDS[axis]))
                .chain([turn])
                .collect::<Vec<_>>()
        };
        axes.iter().flat_map(all).collect()
    },
};
