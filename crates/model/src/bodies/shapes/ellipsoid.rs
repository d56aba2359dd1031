//! A full ellipsoid, its semi-axes along the axes of the body.

use super::kind::{Look, Outline, Shape};

pub(super) const ELLIPSOID: Shape = Shape {
    word: "ellipsoid",
    says: "a full ellipsoid",
    sizes: &["semiaxes"],
    axis: 2,
    density: "kg/m^3",
    content: |a, s| {
        let volume = [a.ratio(4, 3), a.graph.pi()];
        a.graph.mul(&[volume.as_slice(), &s.lengths].concat())
    },
    moments: |a, s| {
        let squares = [0, 1, 2].map(|i| a.graph.powi(s.lengths[i], 2));
        [(1, 2), (2, 0), (0, 1)].map(|(i, j)| {
            a.graph
                .mul(&[a.ratio(1, 5), a.graph.add(&[squares[i], squares[j]])])
        })
    },
    outline: Outline::Ellipsoid,
    look: Look::Rings,
};
