//! No motion at all.

use super::kind::{Axes, Joint};

pub(super) const FIXED: Joint = Joint {
    word: "fixed",
    says: "no motion",
    axes: Axes::None,
    usual: "",
    motions: |_| Vec::new(),
};
