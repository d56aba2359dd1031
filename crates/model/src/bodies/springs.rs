//! Springs, between bodies along a line or in a joint.

use chetaev_symbolic::Expr;

/// A stiffness with the value of the coordinate at which a spring is at rest.
pub(crate) struct Spring {
    pub(crate) stiffness: Expr,
    pub(crate) rest: Option<Expr>,
}
