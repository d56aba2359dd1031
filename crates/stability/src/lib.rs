//! Linearization about steady motions, and what follows for their stability.
//!
//! A steady motion is one along which everything that the equations of motion depend on is constant; ignorable coordinates run on
//! uniformly. What is asked, in this order, and where it is decided:
//!
//! 1. *Which motion?* [`steady`]: positions and velocities, completed by the constraints and checked, exactly.
//! 2. *On which variables do the equations depend?* [`reduction`]: the smallest closed system of coordinates and quasi-velocities.
//! 3. *What are the linear equations?* [`linearization`]: `E δz' = F δz`, exact in the parameters, on the tangent space of the finite
//!    constraints.
//! 4. *Which eigenvalues?* [`characteristic`]: det(λE − F), with the zeros of the family of steady motions split off; [`eigenvalues`] in
//!    double precision.
//! 5. *Are they left of the axis?* [`hurwitz`]: Hurwitz's determinants, at a value or over a range of one parameter, with boundaries
//!    enclosed by [`real_roots`]; [`question`] puts it together, and for even polynomials asks whether all are imaginary and simple.
//! 6. *What is stated?* [`claims`].

pub mod characteristic;
pub mod claims;
pub mod eigenvalues;
pub mod hurwitz;
pub mod linearization;
pub mod question;
pub mod real_roots;
pub mod reduction;
pub mod steady;
