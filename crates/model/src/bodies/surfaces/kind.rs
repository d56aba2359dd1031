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
    /// The part of the vector from its middle that is as long as the radius: from a point to the surface's middle or axis.
    pub(crate) away: fn(&Algebra, &Figure, Vector) -> Vector,
}
