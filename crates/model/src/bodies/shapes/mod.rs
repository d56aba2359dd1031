//! Homogeneous solids: sizes, mass from density, central moments of inertia, and how they touch and look.

mod ball;
mod cone;
mod cuboid;
mod cylinder;
mod disc;
mod ellipsoid;
mod kind;
mod ring;
mod rod;
mod shell;
mod torus;

pub(crate) use kind::{Look, Outline, Shape, Sizes};

/// Every shape; a new one is a file and a line here.
pub(crate) const SHAPES: &[&Shape] = &[
    &disc::DISC,
    &ring::RING,
    &ball::BALL,
    &shell::SHELL,
    &cylinder::CYLINDER,
    &cuboid::BOX,
    &rod::ROD,
    &cone::CONE,
    &torus::TORUS,
    &ellipsoid::ELLIPSOID,
];
