//! A wheel with rollers on its rim: no slip along the axis of the roller that touches, which stands at an angle to the axle.
//!
//! At 0 the wheel cannot slip sideways only, at a right angle not forwards only; mecanum wheels have 45 degrees.

use super::kind::{Contact, Statement};

pub(super) const ROLLER: Contact = Contact {
    word: "roller",
    says: "a wheel with rollers on its rim, at an angle to the axle",
    statements: |a, angle| {
        vec![Statement {
            suffix: "",
            along: [a.graph.sin(angle), a.graph.cos(angle), a.graph.zero()],
            says: "does not slip along the axis of its roller",
        }]
    },
};
