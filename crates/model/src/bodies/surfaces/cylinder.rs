//! A cylinder about an axis of its frame.

use super::kind::Surface;

pub(super) const CYLINDER: Surface = Surface {
    word: "cylinder",
    away: |a, figure, middle| {
        let mut away = middle;
        away[figure.axis] = a.graph.zero();
        away
    },
};
