//! A smooth contact: the body stays on the plane, and nothing else is asked.

use super::kind::Contact;

pub(super) const SLIDING: Contact = Contact {
    word: "sliding",
    says: "the body stays on the plane and may slip",
    statements: |_, _| Vec::new(),
};
