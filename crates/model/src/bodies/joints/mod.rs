//! Joints: which motions of the child against the parent each kind allows.

mod cylindrical;
mod fixed;
mod free;
mod kind;
mod planar;
mod prismatic;
mod revolute;
mod spherical;
mod universal;

pub(crate) use kind::{Axes, Direction, Freedom, Joint, Motion};

/// Every joint; a new one is a file and a line here.
pub(crate) const JOINTS: &[&Joint] = &[
    &fixed::FIXED,
    &revolute::REVOLUTE,
    &prismatic::PRISMATIC,
    &cylindrical::CYLINDRICAL,
    &universal::UNIVERSAL,
    &spherical::SPHERICAL,
    &planar::PLANAR,
    &free::FREE,
];
