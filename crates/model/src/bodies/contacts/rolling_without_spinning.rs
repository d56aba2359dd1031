//! No slip, and no turning about the normal.

use super::kind::{no_slip_forward, no_slip_sideways, Contact, Statement};

pub(super) const ROLLING_WITHOUT_SPINNING: Contact = Contact {
    word: "rolling-without-spinning",
    statements: |_, touch| {
        let spin = Statement {
            suffix: "_spin",
            vanishes: touch.spin,
            says: "does not turn about the normal",
        };
        vec![no_slip_forward(touch), no_slip_sideways(touch), spin]
    },
};
