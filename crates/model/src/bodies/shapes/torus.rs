//! A full torus: a tyre. `radius` is that of the circle in the middle of its tube, `tube` that of the tube.

use super::kind::{Look, Outline, Shape};

pub(super) const TORUS: Shape = Shape {
    word: "torus",
    says: "a full torus: a tyre",
    sizes: &["radius", "tube"],
    axis: 1,
    density: "kg/m^3",
    content: |a, s| {
        let square = a.graph.powi(s.lengths[1], 2);
        let pi = a.graph.powi(a.graph.pi(), 2);
        a.graph.mul(&[a.graph.integer(2), pi, s.lengths[0], square])
    },
    moments: |a, s| {
        let [r, t] = [0, 1].map(|i| a.graph.powi(s.lengths[i], 2));
        let of = |n, d, e| a.graph.mul(&[a.ratio(n, d), e]);
        s.revolved(
            a.graph.add(&[of(1, 2, r), of(5, 8, t)]),
            a.graph.add(&[r, of(3, 4, t)]),
        )
    },
    outline: Outline::Torus,
    look: Look::Wheel,
};
