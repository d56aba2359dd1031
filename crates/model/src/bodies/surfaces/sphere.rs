//! A sphere about the origin of its frame.

use super::kind::Surface;

pub(super) const SPHERE: Surface = Surface {
    word: "sphere",
    away: |_, _, middle| middle,
};
