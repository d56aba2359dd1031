//! A sphere about the origin of its frame.

use super::kind::{Form, Surface};

pub(super) const SPHERE: Surface = Surface {
    word: "sphere",
    form: Form::Round(|_, _, middle| middle),
};
