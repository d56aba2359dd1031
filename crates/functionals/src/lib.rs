//! Functionals of fields over space: what they are stationary for, proved against stated equations.
//!
//! A model file with `kind = "functional"` states fields, a density and densities on pieces of the boundary ([`read`]). Out come
//! the Euler equations and the natural conditions ([`variation`]), and verdicts of the claims in [`claims`]: whether these are the
//! stated equations, whether a functional becomes another one for special values or under one more equation, whether two are dual.
//! Theory: T4.
//!
//! * [`notation`]: index notation, its tree and the summation convention.
//! * [`space`]: jets of fields, total derivatives, constitutive functions with Legendre conjugates.
//! * `conjugation`: whether functions stated as Legendre conjugates are so.
//! * [`boundary`]: the normal and the curvature of a piece, and the distance from it.
//! * [`tensors`]: what names mean; index notation in components.
//! * [`functional`]: a functional as plain data.
//! * [`elimination`]: equations solved for jets, one group after the other, and what follows from them.
//! * [`integral`]: exact integrals of polynomials.
//! * [`polynomial`], [`ritz`], `ritz_base`, `linear`: polynomials with rational coefficients, Ritz's method, its base, and linear equations.
//! * [`signs`]: the sign of a function on an interval.
//! * `smoothness`: where densities and fields are smooth.
//! * [`study`](mod@study): all claims about one model file.

pub mod boundary;
pub mod claims;
mod conjugation;
pub mod elimination;
pub mod functional;
pub mod integral;
mod linear;
pub mod notation;
pub mod polynomial;
pub mod read;
pub mod ritz;
mod ritz_base;
pub mod signs;
mod smoothness;
pub mod space;
pub mod study;
pub mod tensors;
pub mod variation;

pub use functional::{Functional, Problem};
pub use read::{load, Loaded};
pub use study::{study, study_at, Decided, Pace, Study};
