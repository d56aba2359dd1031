//! A thin ring, all mass on the rim.

use super::kind::{Look, Outline, Shape};

pub(super) const RING: Shape = Shape {
    word: "ring",
    says: "a thin ring",
    sizes: &["radius"],
    axis: 1,
    density: "kg/m",
    content: |a, s| {
        a.graph
            .mul(&[a.graph.integer(2), a.graph.pi(), s.lengths[0]])
    },
    moments: |a, s| {
        let square = a.graph.powi(s.lengths[0], 2);
        s.revolved(a.graph.mul(&[a.ratio(1, 2), square]), square)
    },
    outline: Outline::Rim,
    look: Look::Wheel,
};
