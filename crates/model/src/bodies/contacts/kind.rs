//! What a kind of contact is.

use chetaev_symbolic::Expr;

use crate::bodies::algebra::Algebra;

/// A statement of a contact: the end of the constraint's name, what vanishes, and a word about it.
pub(crate) struct Statement {
    pub(crate) suffix: &'static str,
    /// What vanishes: so much of the velocity of the touching point against the plane along the rim or the blade, of that across it,
    /// and of the angular velocity about the normal.
    pub(crate) along: [Expr; 3],
    pub(crate) says: &'static str,
}

/// A kind of contact.
pub(crate) struct Contact {
    /// Its word in the model file.
    pub(crate) word: &'static str,
    /// What it is, for menus.
    pub(crate) says: &'static str,
    /// What it says; with the angle that the user states, for rollers: from the axle towards the rim.
    pub(crate) statements: fn(&Algebra, Expr) -> Vec<Statement>,
}

/// No motion along the rim.
pub(super) fn no_slip_forward(a: &Algebra) -> Statement {
    Statement {
        suffix: "_forward",
        along: a.unit(0),
        says: "does not slip forwards",
    }
}

/// No motion across the rim.
pub(super) fn no_slip_sideways(a: &Algebra) -> Statement {
    Statement {
        suffix: "_side",
        along: a.unit(1),
        says: "does not slip sideways",
    }
}
