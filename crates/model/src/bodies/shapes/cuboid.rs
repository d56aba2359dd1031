//! A full box, its edges along the axes of the body.

use super::kind::{Look, Outline, Shape};

pub(super) const BOX: Shape = Shape {
    word: "box",
    says: "a full box",
    sizes: &["size"],
    axis: 2,
    density: "kg/m^3",
    content: |a, s| a.graph.mul(&s.lengths),
    moments: |a, s| {
        let squares = [0, 1, 2].map(|i| a.graph.powi(s.lengths[i], 2));
        [(1, 2), (2, 0), (0, 1)].map(|(i, j)| {
            a.graph
                .mul(&[a.ratio(1, 12), a.graph.add(&[squares[i], squares[j]])])
        })
    },
    outline: Outline::None,
    look: Look::Edges,
};
