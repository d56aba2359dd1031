//! What bodies, joints and contacts there are, for forms and menus.

use super::contacts::CONTACTS;
use super::joints::{Axes, JOINTS};
use super::shapes::SHAPES;

/// A kind of solid, joint or contact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ObjectKind {
    /// Its word under `shape` or `type`.
    pub word: &'static str,
    /// What it is.
    pub says: &'static str,
    /// The keys of its own: the sizes of a solid, the axes of a joint.
    pub keys: &'static [&'static str],
    /// What the only key is where it is left out; empty where it must be stated.
    pub usual: &'static str,
}

/// The solids: their sizes are lengths, and lists of three lengths for `size` and `semiaxes`.
pub fn solids() -> Vec<ObjectKind> {
    let kinds = SHAPES.iter();
    let kinds = kinds.map(|own| ObjectKind {
        word: own.word,
        says: own.says,
        keys: own.sizes,
        usual: "",
    });
    kinds.collect()
}

/// The joints: an `axis`, a `sequence` of axes, or neither.
pub fn joints() -> Vec<ObjectKind> {
    let kinds = JOINTS.iter();
    let kinds = kinds.map(|own| ObjectKind {
        word: own.word,
        says: own.says,
        keys: match own.axes {
            Axes::None => &[],
            Axes::One => &["axis"],
            Axes::Sequence(_) => &["sequence"],
        },
        usual: own.usual,
    });
    kinds.collect()
}

/// The contacts with a plane.
pub fn contacts() -> Vec<ObjectKind> {
    let kinds = CONTACTS.iter();
    let kinds = kinds.map(|own| ObjectKind {
        word: own.word,
        says: own.says,
        keys: &[],
        usual: "",
    });
    kinds.collect()
}
