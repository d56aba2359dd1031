//! No slip in any direction.

use super::kind::{no_slip_forward, no_slip_sideways, Contact};

pub(super) const ROLLING: Contact = Contact {
    word: "rolling",
    statements: |_, touch| vec![no_slip_forward(touch), no_slip_sideways(touch)],
};
