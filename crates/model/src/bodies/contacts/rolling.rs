//! No slip in any direction.

use super::kind::{no_slip_forward, no_slip_sideways, Contact};

pub(super) const ROLLING: Contact = Contact {
    word: "rolling",
    says: "no slip",
    statements: |a, _| vec![no_slip_forward(a), no_slip_sideways(a)],
};
