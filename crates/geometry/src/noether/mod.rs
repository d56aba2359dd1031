//! First integrals: their search, their symmetries and generators (T3 §6–7).
//!
//! What is asked, in this order, and where it is decided:
//!
//! 1. *What occurs?* `occurring` collects the functions of (t, q) and of the velocities; [`letters`] are made of them.
//! 2. *Which functions are tried?* [`family`]: monomials in the letters; `automatic` grows families with the work allowed; `plain` are
//!    polynomials, `conjugate` those in the momenta; `powers` has exponents that are solved for, `eigenfunctions` exponentials of
//!    the time; [`ansatz`] is any other linear equation.
//! 3. *Which of them are constant on all motions?* [`search`]: X̄G = 0 on the constraint manifold ([`motion`]) as linear equations modulo a
//!    prime; `dependence` leaves out functions of others; `lift` and `algebraic` bring the solution back to parameters and roots.
//! 4. *For which parameters are there more?* [`special`] values and `critical` ones.
//! 5. *Are they integrals?* [`found`] proves each candidate, once for all claims; `shown`, `shorter` and `written` choose its form.
//! 6. *Which symmetry stands behind?* [`generator`] by the inverse theorem, [`killing`] fields and gauges, [`embedded`] Ω̄, [`reduced`]
//!    symmetries, `cyclic` velocities, `fixed` and [`moving`] directions and axes.
//! 7. *What is stated of them?* [`claims`], one file each.

mod automatic;
pub mod claims;
mod conjugate;
mod critical;
pub(crate) mod cyclic;
mod dependence;
mod eigenfunctions;
pub mod embedded;
pub mod family;
mod fixed;
pub mod found;
pub mod generator;
pub mod killing;
pub mod letters;
mod lifting;
pub mod moving;
pub(crate) mod occurring;
mod plain;
mod powers;
pub mod reduced;
pub mod search;
mod shorter;
pub(crate) mod shown;
pub mod special;
mod vectors;
mod written;

pub use chetaev_integrals::{ansatz, motion};
use chetaev_integrals::{constants, lift};
