//! A thin disc.

use super::kind::{Look, Outline, Shape};

pub(super) const DISC: Shape = Shape {
    word: "disc",
    says: "a thin disc",
    sizes: &["radius"],
    axis: 1,
    density: "kg/m^2",
    content: |a, s| a.graph.mul(&[a.graph.pi(), a.graph.powi(s.lengths[0], 2)]),
    moments: |a, s| {
        let square = a.graph.powi(s.lengths[0], 2);
        let of = |n| a.graph.mul(&[a.ratio(1, n), square]);
        s.revolved(of(4), of(2))
    },
    outline: Outline::Rim,
    look: Look::Wheel,
};
