//! Exterior calculus on the jet space J¹ and on the constraint manifold: forms, fields, d, ∧, ⌟, Lie derivative, brackets, pull-back.
//!
//! Forms and fields have components in the basis {dt, dq, dv} of J¹, or {dt, dq, dη} of N with the (quasi-)velocities η of a chart;
//! a [`Coframe`] gives their components in any other basis, as {dt, θ, dη} with the contact forms θ. Coefficients are exact
//! expressions; nothing is simplified here, and identities hold up to the zero test.

mod coframe;
mod field;
mod form;
mod space;

pub use coframe::Coframe;
pub use field::Field;
pub use form::Form;
pub use space::Space;
