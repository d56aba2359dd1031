//! What a kind of contact is.

use chetaev_symbolic::Expr;

use crate::bodies::algebra::Algebra;

/// Velocities at the point where a body touches a plane, against the plane.
#[derive(Clone, Copy)]
pub(crate) struct Touch {
    /// Of the touching point of the body, along the rim or the blade.
    pub(crate) forward: Expr,
    /// Of the same point across it, in the plane.
    pub(crate) side: Expr,
    /// The angular velocity of the body about the normal.
    pub(crate) spin: Expr,
    /// The angle that the user states, for rollers: from the axle towards the rim.
    pub(crate) angle: Expr,
}

/// A statement of a contact: the end of the constraint's name, what vanishes, and a word about it.
pub(crate) struct Statement {
    pub(crate) suffix: &'static str,
    pub(crate) vanishes: Expr,
    pub(crate) says: &'static str,
}

/// A kind of contact.
pub(crate) struct Contact {
    /// Its word in the model file.
    pub(crate) word: &'static str,
    /// What it says.
    pub(crate) statements: fn(&Algebra, &Touch) -> Vec<Statement>,
}

/// No motion along the rim.
pub(super) fn no_slip_forward(touch: &Touch) -> Statement {
    Statement {
        suffix: "_forward",
        vanishes: touch.forward,
        says: "does not slip forwards",
    }
}

/// No motion across the rim.
pub(super) fn no_slip_sideways(touch: &Touch) -> Statement {
    Statement {
        suffix: "_side",
        vanishes: touch.side,
        says: "does not slip sideways",
    }
}
