//! A smooth contact: the body stays on the plane, and nothing else is asked.

use super::kind::Contact;

pub(super) const SLIDING: Contact = Contact {
    word: "sliding",
    statements: |_, _| Vec::new(),
};
