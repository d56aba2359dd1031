//! Theorems by which the stability of a motion itself is decided, one file each, in the order in which they are asked.
//!
//! A theorem is asked at a value of the parameter, or throughout an interval in which none of its [`functions`](Method::functions) changes its
//! sign. It answers only where all of its hypotheses are verified.

mod double_zero;
mod drift;
mod first_approximation;
mod higher_variation;
mod imaginary_pair;
mod integral_bundle;
mod linear_equations;
mod reversal;
mod zero_eigenvalue;

use crate::theorem::Method;

/// All of them.
pub(crate) static METHODS: &[&dyn Method] = &[
    &first_approximation::FirstApproximation,
    &integral_bundle::IntegralBundle,
    &higher_variation::HigherVariation,
    &reversal::Reversal,
    &zero_eigenvalue::ZeroEigenvalue,
    &double_zero::DoubleZero,
    &imaginary_pair::ImaginaryPair,
    &drift::Drift,
    &linear_equations::LinearEquations,
];
