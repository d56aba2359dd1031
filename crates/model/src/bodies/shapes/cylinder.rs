//! A full cylinder.

use super::kind::{Look, Outline, Shape};

pub(super) const CYLINDER: Shape = Shape {
    word: "cylinder",
    says: "a full cylinder",
    sizes: &["radius", "length"],
    axis: 2,
    density: "kg/m^3",
    content: |a, s| {
        a.graph
            .mul(&[a.graph.pi(), a.graph.powi(s.lengths[0], 2), s.lengths[1]])
    },
    moments: |a, s| {
        let [r, l] = [0, 1].map(|i| a.graph.powi(s.lengths[i], 2));
        let of = |n, e| a.graph.mul(&[a.ratio(1, n), e]);
        s.revolved(a.graph.add(&[of(4, r), of(12, l)]), of(2, r))
    },
    outline: Outline::Cylinder,
    look: Look::Bar,
};
