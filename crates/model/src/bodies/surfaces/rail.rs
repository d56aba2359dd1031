//! A straight rail: a line along an axis of its frame, or a rod about it where it has a radius.

use super::kind::{Form, Surface};

pub(super) const RAIL: Surface = Surface {
    word: "rail",
    form: Form::Line,
};
