//! No motion across: a skate, a sled, the wheel of a cart whose own turning does not matter.

use super::kind::{no_slip_sideways, Contact, Statement};

pub(super) const BLADE: Contact = Contact {
    word: "blade",
    says: "no motion across: a skate, a sled, a wheel whose own turning does not matter",
    statements: |a, _| {
        vec![Statement {
            suffix: "",
            ..no_slip_sideways(a)
        }]
    },
};
