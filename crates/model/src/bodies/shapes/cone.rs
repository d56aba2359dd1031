//! A full circular cone.

use super::kind::{Look, Outline, Shape};

pub(super) const CONE: Shape = Shape {
    word: "cone",
    says: "a full circular cone",
    sizes: &["radius", "length"],
    axis: 2,
    density: "kg/m^3",
    content: |a, s| {
        a.graph.mul(&[
            a.ratio(1, 3),
            a.graph.pi(),
            a.graph.powi(s.lengths[0], 2),
            s.lengths[1],
        ])
    },
    moments: |a, s| {
        let [r, l] = [0, 1].map(|i| a.graph.powi(s.lengths[i], 2));
        let of = |n, d, e| a.graph.mul(&[a.ratio(n, d), e]);
        s.revolved(a.graph.add(&[of(3, 20, r), of(3, 80, l)]), of(3, 10, r))
    },
    outline: Outline::Cone,
    look: Look::Bar,
};
