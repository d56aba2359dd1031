//! Linearization about steady motions, and what follows for their stability.
//!
//! A steady motion is one along which everything that the equations of motion depend on is constant; ignorable coordinates run on
//! uniformly. What is asked, in this order, and where it is decided:
//!
//! 1. *Which motion?* [`steady`]: positions and velocities, completed by the constraints; [`expansion`] checks them, exactly, and expands
//!    functions about them, by their `growth` beside it where they have corners; `real_values` says where they are real numbers; [`problem`] says why that cannot be.
//! 2. *On which variables do the equations depend?* [`reduction`]: the smallest closed system of coordinates and quasi-velocities.
//! 3. *What are the linear equations?* [`linearization`]: `E δz' = F δz`, exact in the parameters, on the tangent space of the finite
//!    constraints, with the family of steady motions; [`state_space`] and [`parts`] write them as others do, [`descriptor`] in all variables.
//! 4. *Which eigenvalues?* [`characteristic`]: det(λE − F), with the zeros of the family split off; [`spectrum`]: its factors, those that are
//!    their own mirror images apart; [`multiplicity`]: their Jordan chains; [`eigenvalues`] and [`singular`] in double precision,
//!    `complex_zeros` all of them enclosed where the polynomial is known, [`enclosure`] one that is proved.
//! 5. *Are they left of the axis?* [`hurwitz`]: Hurwitz's determinants over a range of one parameter, with boundaries enclosed by
//!    [`real_roots`], those of functions with square roots by their `norm`; [`question`] puts it together; `about` keeps what is derived of a motion once, and `decision` decides a statement on it over the range of a parameter.
//! 6. *Is the motion itself stable?* [`integrals`] up to the second order, and [`bundle`]: their combinations as Lyapunov functions;
//!    the theorems that are asked stand in `methods`, a file for each; those that need more than the linear equations expand them in
//!    `neighbourhood`, on the `levels` of integrals, and reduce them to one equation in `branching`, that of a `critical` direction.
//!    [`witness`]: runs beside it as a witness where nothing is decided.
//! 7. *Which motions are steady?* [`steady_set`]: all of them, where their equations (`steady_equations`) are polynomials in the unknowns, their sines and roots, real ones only (`semidefinite`),
//!    in as many `charts` of independent velocities as that takes;
//!    [`guess`]: the one that is meant by guesses.
//! 8. *What is stated?* [`claims`], each for all values of the parameter of the motion.

mod about;
pub mod admissible_values;
mod branch;
mod branching;
pub mod bundle;
pub mod characteristic;
mod charts;
pub mod claims;
mod complex_zeros;
mod critical;
mod decision;
pub mod descriptor;
pub mod eigenvalues;
pub mod enclosure;
mod evidence;
mod exact_zeros;
pub mod expansion;
mod family;
mod growth;
pub mod guess;
pub mod hurwitz;
pub mod integrals;
pub mod isolation;
mod left_out;
mod levels;
pub mod linearization;
mod lines;
mod methods;
pub mod multiplicity;
mod neighbourhood;
mod norm;
mod parameter_values;
pub mod parts;
pub mod problem;
pub mod question;
pub mod real_roots;
mod real_values;
mod real_zeros;
pub mod reduction;
mod semidefinite;
pub mod singular;
pub mod spectrum;
pub mod state_space;
pub mod steady;
mod steady_equations;
mod steady_motions;
pub mod steady_set;
mod steady_value;
mod theorem;
pub mod witness;
