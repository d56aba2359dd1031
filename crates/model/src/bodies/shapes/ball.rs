//! A full ball.

use super::kind::{Look, Outline, Shape};

pub(super) const BALL: Shape = Shape {
    word: "ball",
    says: "a full ball",
    sizes: &["radius"],
    axis: 2,
    density: "kg/m^3",
    content: |a, s| {
        a.graph
            .mul(&[a.ratio(4, 3), a.graph.pi(), a.graph.powi(s.lengths[0], 3)])
    },
    moments: |a, s| [a.graph.mul(&[a.ratio(2, 5), a.graph.powi(s.lengths[0], 2)]); 3],
    outline: Outline::Sphere,
    look: Look::Ball,
};
