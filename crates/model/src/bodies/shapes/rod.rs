//! A thin straight rod.

use super::kind::{Look, Outline, Shape};

pub(super) const ROD: Shape = Shape {
    word: "rod",
    says: "a thin straight rod",
    sizes: &["length"],
    axis: 0,
    density: "kg/m",
    content: |_, s| s.lengths[0],
    moments: |a, s| {
        let across = a
            .graph
            .mul(&[a.ratio(1, 12), a.graph.powi(s.lengths[0], 2)]);
        s.revolved(across, a.graph.zero())
    },
    outline: Outline::None,
    look: Look::Bar,
};
