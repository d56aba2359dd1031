//! A cylinder about an axis of its frame.

use super::kind::{Form, Surface};

pub(super) const CYLINDER: Surface = Surface {
    word: "cylinder",
    form: Form::Round(|a, figure, middle| {
        let mut away = middle;
        away[figure.axis] = a.graph.zero();
        away
    }),
};
