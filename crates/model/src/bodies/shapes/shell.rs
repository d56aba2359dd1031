//! A thin spherical shell.

use super::kind::{Look, Outline, Shape};

pub(super) const SHELL: Shape = Shape {
    word: "shell",
    says: "a thin spherical shell",
    sizes: &["radius"],
    axis: 2,
    density: "kg/m^2",
    content: |a, s| {
        a.graph.mul(&[
            a.graph.integer(4),
            a.graph.pi(),
            a.graph.powi(s.lengths[0], 2),
        ])
    },
    moments: |a, s| [a.graph.mul(&[a.ratio(2, 3), a.graph.powi(s.lengths[0], 2)]); 3],
    outline: Outline::Sphere,
    look: Look::Ball,
};
