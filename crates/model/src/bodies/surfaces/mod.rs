//! Curved surfaces on which balls roll and slide: for each, where the middle of a ball may be, and the unit normal there.

mod cylinder;
mod kind;
mod sphere;

pub(crate) use kind::{Figure, Surface};

/// Surfaces whose middle moves on a surface of the same kind; a new one is a file and a line here.
pub(crate) const SURFACES: &[&Surface] = &[&sphere::SPHERE, &cylinder::CYLINDER];
