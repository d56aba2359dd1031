//! What a kind of surface is.

use chetaev_symbolic::Expr;

use crate::bodies::algebra::{Algebra, Vector};

/// A surface with its sizes.
pub(crate) struct Figure {
    /// Its radius.
    pub(crate) radius: Expr,
    /// Its axis, where it has one.
    pub(crate) axis: usize,
    /// Whether it is touched from inside.
    pub(crate) is_inside: bool,
}

impl Figure {
    /// The radius on which the middle of a ball moves: R − r inside, R + r outside.
    pub(crate) fn reach(&self, a: &Algebra, ball: Expr) -> Expr {
        if self.is_inside {
            a.graph.sub(self.radius, ball)
        } else {
            a.graph.add(&[self.radius, ball])
        }
    }

    /// How high a point is over the surface that has `reach` for its radius: half of (c² − ρ²)/ρ has the unit normal as its gradient where it vanishes.
    pub(crate) fn height(&self, a: &Algebra, away: Vector, reach: Expr) -> Expr {
        let excess = a.graph.sub(a.dot(away, away), a.graph.powi(reach, 2));
        let height = a
            .graph
            .div(excess, a.graph.mul(&[a.graph.integer(2), reach]));
        if self.is_inside {
            a.graph.neg(height)
        } else {
            height
        }
    }

    /// A vector that points away from the middle of the surface, as one towards the ball.
    pub(crate) fn towards(&self, a: &Algebra, outward: Vector) -> Vector {
        if self.is_inside {
            a.minus(a.zero(), outward)
        } else {
            outward
        }
    }
}

/// A kind of surface.
pub(crate) struct Surface {
    /// Its word in the model file.
    pub(crate) word: &'static str,
    pub(crate) form: Form,
}

/// What a surface is made of.
#[derive(Clone, Copy)]
pub(crate) enum Form {
    /// All points at one distance from a middle or an axis: the part of the vector from there that is as long as the radius.
    Round(Away),
    /// A line.
    Line,
}

/// The part of a vector that points away from the middle or the axis of a surface.
pub(crate) type Away = fn(&Algebra, &Figure, Vector) -> Vector;
