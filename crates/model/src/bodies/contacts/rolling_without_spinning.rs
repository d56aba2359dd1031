//! No slip, and no turning about the normal.

use super::kind::{no_slip_forward, no_slip_sideways, Contact, Statement};

pub(super) const ROLLING_WITHOUT_SPINNING: Contact = Contact {
    word: "rolling-without-spinning",
    says: "no slip, and no turning about the normal",
    statements: |a, _| {
        let spin = Statement {
            suffix: "_spin",
            along: a.unit(2),
            says: "does not turn about the normal",
        };
        vec![no_slip_forward(a), no_slip_sideways(a), spin]
    },
};
