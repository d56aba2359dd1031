//! Motions beside a motion: what a small change of the start or of a parameter makes of it, motions that repeat, and how they and the steady ones
//! go on when a parameter changes.
//!
//! 1. [`flow`]: the motion as a first-order system, in the fewest variables that are closed, or with all coordinates.
//! 2. [`variational`]: its first and second derivatives by initial values and parameters, by the Taylor series of the extended system.
//!    [`sensitivity`] asks it of coordinates and velocities by the names of the model, [`along`] of the linear equations along a motion.
//! 3. [`multipliers`]: the eigenvalues of the monodromy matrix, with those that are 1 by structure split off and named.
//! 4. [`solution`]: solutions near a guess and the families to which they belong. [`continuation`] follows them by pseudo-arclength (Keller
//!    1977), across the families; [`branch`] is what it finds, and what it asks of the equations: those of [`equilibria`] and [`periodic`].
//! 5. [`hopf`]: the first Lyapunov coefficient where a pair of eigenvalues passes the imaginary axis.
//! 6. [`mode`]: motions of the linear equations about a steady motion, in all coordinates; [`witness`]: motions that begin near it.
//!
//! All here is numerical: nothing is proved, and values are located to rounding.

pub mod along;
pub mod beginning;
pub mod branch;
pub mod continuation;
pub mod equilibria;
pub mod error;
pub mod flow;
pub mod hopf;
pub mod mode;
pub mod multipliers;
pub mod periodic;
pub mod sensitivity;
pub mod solution;
mod subspace;
pub mod units;
pub mod variational;
pub mod witness;

pub use error::OrbitError;
pub use flow::Flow;
