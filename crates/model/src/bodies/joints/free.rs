//! Free motion: three lengths and three angles.

use super::kind::{turns, Axes, Joint, Motion};

pub(super) const FREE: Joint = Joint {
    word: "free",
    says: "three lengths and three angles",
    axes: Axes::Sequence(3),
    usual: "zxy",
    motions: |axes| {
        let slides = [(0, "x"), (1, "y"), (2, "z")].map(|(axis, word)| Motion::slide(axis, word));
        slides.into_iter().chain(turns(axes)).collect()
    },
};
