//! Sparse multivariate polynomials over the integers, their greatest common divisors and factors, and rational
//! functions.
//!
//! Generators are plain indices `0, 1, 2, …`; what a generator means (a symbol, a sine, a radical) is decided by the
//! [normal form](normal_form) that uses them. Rational coefficients live in [`RationalFunction`], whose denominator
//! takes the common denominator, so the polynomials themselves stay over ℤ and every gcd is exact.
//!
//! Everything whose cost can grow beyond the size of its input takes a [`Meter`], counts its work on it and stops with
//! [`TooLarge`]. The count depends on the input alone, never on a clock, so the same input always stops at the same
//! place.

mod budget;
mod division;
mod factor;
mod gcd;
mod irreducible;
mod monomial;
pub mod normal_form;
mod p_adic;
mod rational_function;
mod sparse;
mod triangular;
mod univariate;
mod zippel;

pub use budget::{Budget, Meter, TooLarge};
pub use factor::Factorization;
pub use monomial::Monomial;
pub use rational_function::RationalFunction;
pub use sparse::Polynomial;
pub use triangular::{triangular_systems, TriangularSystem, Vanish};

#[cfg(test)]
mod tests;
