//! What touches, and what is known of a contact.

use chetaev_symbolic::{Expr, Symbol};

use super::algebra::{Algebra, Vector};
use super::lowering::FrameId;
use super::shapes::Outline;

/// What touches: its figure, and where its middle is in the axes of its body.
pub(crate) struct Figure {
    pub(crate) outline: Outline,
    /// The axle of a rim, the direction of a blade.
    pub(crate) axis: usize,
    /// Radius, radii, or semi-axes; of a cone its radius in the middle and what it gains along the axis.
    pub(crate) lengths: Vec<Expr>,
    pub(crate) middle: Vector,
    /// A function that is negative within the body, and the symbols of its three variables.
    pub(crate) stated: Option<(Expr, [Symbol; 3])>,
}

impl Figure {
    pub(crate) fn radius(&self) -> Expr {
        self.lengths[0]
    }

    /// Whether a turn about an axis leaves it as it looks.
    pub(crate) fn is_turned_into_itself(&self, axis: usize) -> bool {
        match self.outline {
            Outline::Rim | Outline::Torus | Outline::Tapered => axis == self.axis,
            Outline::Sphere => true,
            _ => false,
        }
    }

    /// A function of a point, counted from the middle, that vanishes on the figure with `more` laid around it, and grows
    /// outwards; of a sphere and a torus with the gradient 1. Nothing for a line or a point, and where what lies around is no such figure.
    pub(crate) fn outside(&self, a: &Algebra, at: Vector, more: Option<Expr>) -> Option<Expr> {
        let graph = &a.graph;
        let square = |e| graph.powi(e, 2);
        let more_or_none = more.unwrap_or(graph.zero());
        let halved = |excess, size| graph.div(excess, graph.mul(&[graph.integer(2), size]));
        let mut across = at;
        across[self.axis] = graph.zero();
        let along = at[self.axis];
        let tube = |tube: Expr| {
            let off = graph.sub(graph.sqrt(a.dot(across, across)), self.radius());
            let excess = graph.sub(graph.add(&[square(off), square(along)]), square(tube));
            halved(excess, tube)
        };
        Some(match self.outline {
            Outline::Sphere => {
                let reach = graph.add(&[self.radius(), more_or_none]);
                halved(graph.sub(a.dot(at, at), square(reach)), reach)
            }
            Outline::Torus => tube(graph.add(&[*self.lengths.get(1)?, more_or_none])),
            Outline::Rim => tube(more?),
            Outline::Tapered => {
                let taper = *self.lengths.get(1)?;
                let slant = graph.sqrt(graph.add(&[graph.one(), square(taper)]));
                let gained = graph.mul(&[taper, along]);
                let around = graph.mul(&[slant, more_or_none]);
                let reach = graph.add(&[self.radius(), gained, around]);
                let excess = graph.sub(a.dot(across, across), square(reach));
                halved(excess, self.radius())
            }
            Outline::Ellipsoid if more.is_none() => {
                let parts = at.iter().zip(&self.lengths);
                let squares = parts.map(|(e, own)| square(graph.div(*e, *own)));
                let all: Vec<Expr> = squares.chain([graph.integer(-1)]).collect();
                graph.mul(&[a.ratio(1, 2), self.radius(), graph.add(&all)])
            }
            Outline::Stated if more.is_none() => {
                let (value, variables) = self.stated?;
                let variables = variables.map(|own| graph.symbol_expr(own));
                let pairs: Vec<(Expr, Expr)> = variables.into_iter().zip(at).collect();
                graph.substitute(value, &pairs)
            }
            _ => return None,
        })
    }
}

/// What a body does at the point where it touches a surface, against that surface.
pub(crate) struct Found {
    /// The velocity of its touching point along the rim or the blade, that across it in the plane, and the angular velocity about
    /// the normal.
    pub(crate) velocities: [Expr; 3],
    /// The height of its lowest point over a plane.
    pub(crate) height: Expr,
    /// In which axes the following are given.
    pub(crate) axes: FrameId,
    /// The touching point.
    pub(crate) point: Vector,
    /// Unit vectors along, across and normal.
    pub(crate) directions: [Vector; 3],
}

/// What vanishes, with the end of its name, and the force and torque of its reaction at the point that touches, along the axes of [`Found`].
pub(crate) struct Held {
    pub(crate) end: &'static str,
    pub(crate) vanishes: Expr,
    pub(crate) force: Vector,
    pub(crate) torque: Vector,
}

/// A contact with a curved surface.
pub(crate) struct Curved {
    pub(crate) found: Found,
    pub(crate) held: Vec<Held>,
}
