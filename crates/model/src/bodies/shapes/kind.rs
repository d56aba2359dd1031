//! What a shape is.

use chetaev_symbolic::Expr;

use crate::bodies::algebra::Algebra;

/// A homogeneous solid.
pub(crate) struct Shape {
    /// Its word in the model file.
    pub(crate) word: &'static str,
    /// What it is, for menus.
    pub(crate) says: &'static str,
    /// The keys of its sizes; the last is a list of three lengths for a box.
    pub(crate) sizes: &'static [&'static str],
    /// The axis of revolution where none is stated: 0, 1, 2.
    pub(crate) axis: usize,
    /// The unit of a density: of the volume, the surface or the line that carries the mass.
    pub(crate) density: &'static str,
    /// What the density is multiplied by.
    pub(crate) content: fn(&Algebra, &Sizes) -> Expr,
    /// Central moments about the axis and two directions across it, over the mass. Across and along are asked of `Sizes`.
    pub(crate) moments: fn(&Algebra, &Sizes) -> [Expr; 3],
    /// How it touches.
    pub(crate) outline: Outline,
    /// How it is drawn.
    pub(crate) look: Look,
}

/// The sizes of a solid, in the order of [`Shape::sizes`], and its axis.
pub(crate) struct Sizes {
    pub(crate) lengths: Vec<Expr>,
    pub(crate) axis: usize,
}

impl Sizes {
    /// The moments of a body of revolution.
    pub(crate) fn revolved(&self, across: Expr, along: Expr) -> [Expr; 3] {
        let mut moments = [across; 3];
        moments[self.axis] = along;
        moments
    }
}

/// How a shape touches.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Outline {
    /// By the lowest point of a thin rim about the axis; the first size is its radius.
    Rim,
    /// By the lowest point of a sphere; the first size is its radius.
    Sphere,
    /// By the lowest point of a torus about the axis; the sizes are the radius of its circle and that of its tube.
    Torus,
    /// By the lowest point of an ellipsoid; the sizes are its semi-axes.
    Ellipsoid,
    /// The mantle of a cylinder about the axis; the sizes are its radius and its length.
    Cylinder,
    /// The mantle of a cone whose tip the axis points to; the sizes are the radius of its base and its length.
    Cone,
    /// The mantle of a cone near its middle, the sizes are its radius there and what it gains along the axis.
    Tapered,
    /// What a contact states by an equation.
    Stated,
    /// A point.
    None,
}

impl Outline {
    /// The figure that touches, with its sizes about the centre of mass of the homogeneous solid, where solids differ from what they touch with.
    pub(crate) fn touching(self, a: &Algebra, sizes: Vec<Expr>) -> (Outline, Vec<Expr>) {
        match (self, sizes.as_slice()) {
            (Outline::Cylinder, [radius, ..]) => (Outline::Tapered, vec![*radius, a.graph.zero()]),
            // The centre of mass of a cone is a quarter of its height above the base.
            (Outline::Cone, [radius, length]) => {
                let middle = a.graph.mul(&[a.ratio(3, 4), *radius]);
                let taper = a.graph.neg(a.graph.div(*radius, *length));
                (Outline::Tapered, vec![middle, taper])
            }
            _ => (self, sizes),
        }
    }
}

/// How a shape is drawn.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Look {
    /// A wheel with a spoke; the first size is its radius.
    Wheel,
    /// A ball with a great circle; the first size is its radius.
    Ball,
    /// Three ellipses; the sizes are the semi-axes.
    Rings,
    /// A bar along the axis; the last size is its length.
    Bar,
    /// The edges of a box.
    Edges,
}
