//! No motion at all.

use super::kind::{Axes, Joint};

pub(super) const FIXED: Joint = Joint {
    word: "fixed",
    axes: Axes::None,
    usual: "",
    motions: |_| Vec::new(),
};
