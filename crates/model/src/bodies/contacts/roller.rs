//! A wheel with rollers on its rim: no slip along the axis of the roller that touches, which stands at an angle to the axle.
//!
//! At 0 the wheel cannot slip sideways only, at a right angle not forwards only; mecanum wheels have 45 degrees.

use super::kind::{Contact, Statement};

pub(super) const ROLLER: Contact = Contact {
    word: "roller",
    statements: |a, touch| {
        let (cos, sin) = (a.graph.cos(touch.angle), a.graph.sin(touch.angle));
        let along = [
            a.graph.mul(&[cos, touch.side]),
            a.graph.mul(&[sin, touch.forward]),
        ];
        vec![Statement {
            suffix: "",
            vanishes: a.graph.add(&along),
            says: "does not slip along the axis of its roller",
        }]
    },
};
