//! What is touched beside planes: for each what it is made of.

mod cylinder;
mod kind;
mod rail;
mod sphere;

pub(crate) use kind::{Away, Figure, Form, Surface};

/// Every surface that has a word; a new one is a file and a line here.
pub(crate) const SURFACES: &[&Surface] = &[&sphere::SPHERE, &cylinder::CYLINDER, &rail::RAIL];
