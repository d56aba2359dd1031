//! The exact normal form: an expression as a rational function of independent generators.
//!
//! Generators are the symbols, π, the sine and cosine of base angles, exponentials of base arguments, radicals,
//! absolute values, and every other function of anything else. Sines, radicals and absolute values are algebraic:
//! `s² = 1 - c²`, `ρ^q = R`, `α² = A²`; all others are free.
//!
//! **What it proves.** If the form is zero, the expression vanishes at every point where it is defined: each such point
//! maps the generators to values that satisfy all relations used. If the form is not zero, nothing is refuted, since
//! free generators may secretly be related (`log(x²)` and `2 log x`).
//!
//! Signs are never guessed. `√(x²)` is `|x|`; it becomes `x` only when `x` is among the
//! [positive](Options::positive) expressions, or is itself a radicand of an even root, which the expression's own
//! domain makes non-negative.

mod combination;
mod convert;
mod expression;
mod field;
mod radicals;
mod solve;
mod trigonometry;

use thiserror::Error;

use super::budget::{Budget, TooLarge};
use super::rational_function::RationalFunction;
use crate::{Expr, Graph};

pub use field::{Field, Generator, Kind, Pythagoras};

/// How an expression is read as a rational function.
#[derive(Clone, Debug)]
pub struct Options {
    /// Limits of all polynomials and of the work.
    pub budget: Budget,
    /// Expressions known to be positive; each saves absolute values.
    pub positive: Vec<Expr>,
    /// Whether sines and cosines of combinations of angles are expanded by the addition theorems. A proof needs this;
    /// a reader may prefer `cos(α - β)`.
    pub expand_angles: bool,
    /// Whether this is done with angles that are rational numbers too: a proof needs it, and sin 23 becomes a polynomial in sin 1 and cos 1. What
    /// is printed, or evaluated in floating point, is better without.
    pub expand_numbers: bool,
    /// Whether components of linear solves are worked out. A proof needs this; otherwise each is a generator.
    pub expand_solves: bool,
    /// Whether hyperbolic functions are written by exponentials. A proof needs this; otherwise they are kept as pairs
    /// with `sinh² = cosh² - 1`.
    pub expand_hyperbolic: bool,
    /// Whether squares are taken out of roots, with absolute values, and dependent roots expressed by each other. A
    /// proof needs this; otherwise a root is kept as it stands.
    pub split_roots: bool,
    /// Arguments of sines and cosines to be taken as base angles first, in this order.
    pub base_angles: Vec<Expr>,
}

impl Options {
    /// Everything expanded: the form decides whether an expression is zero in the field of the generators.
    pub fn proof(budget: Budget) -> Options {
        Options {
            budget,
            positive: Vec::new(),
            expand_angles: true,
            expand_numbers: true,
            expand_solves: true,
            expand_hyperbolic: true,
            split_roots: true,
            base_angles: Vec::new(),
        }
    }

    /// The same, with angles that are rational numbers kept as they are written.
    pub fn readable(budget: Budget) -> Options {
        Options {
            expand_numbers: false,
            ..Options::proof(budget)
        }
    }

    /// Functions kept as they are written.
    pub fn display(budget: Budget) -> Options {
        Options {
            expand_angles: false,
            expand_solves: false,
            expand_hyperbolic: false,
            split_roots: false,
            ..Options::proof(budget)
        }
    }
}

/// Why an expression has no normal form.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub enum NormalFormError {
    /// The budget does not suffice.
    #[error("the exact normal form is too large: {0}")]
    TooLarge(#[from] TooLarge),
    /// A denominator, or the determinant of a solve, vanishes identically.
    #[error("the expression is nowhere defined: a denominator vanishes identically")]
    Undefined,
}

/// The normal form of one expression, with the field it lives in.
#[derive(Clone, Debug)]
pub struct RationalForm<'g> {
    field: Field<'g>,
    value: RationalFunction,
}

impl<'g> RationalForm<'g> {
    /// Whether the expression is zero in the field of its generators, hence wherever it is defined.
    pub fn is_zero(&self) -> bool {
        self.value.is_zero()
    }

    /// The rational function, reduced by the relations of the field.
    pub fn value(&self) -> &RationalFunction {
        &self.value
    }

    /// The generators and their relations.
    pub fn field(&self) -> &Field<'g> {
        &self.field
    }

    /// The form as an expression, numerator and denominator expanded.
    pub fn to_expr(&self) -> Expr {
        self.field.expression(&self.value)
    }
}

/// The normal form of `e` within a budget; everything is expanded (see [`Options::proof`]).
///
/// # Errors
/// [`NormalFormError::TooLarge`] when the budget does not suffice, [`NormalFormError::Undefined`] when a denominator
/// vanishes identically.
///
/// ```
/// use chetaev_symbolic::polynomial::{normal_form::normal_form, Budget};
/// use chetaev_symbolic::Graph;
/// let g = Graph::new();
/// let x = g.symbol("x", 0);
/// let one = g.add(&[g.powi(g.sin(x), 2), g.powi(g.cos(x), 2)]);
/// assert!(normal_form(&g, g.sub(one, g.one()), &Budget::PROOF)?.is_zero());
/// # Ok::<(), chetaev_symbolic::polynomial::normal_form::NormalFormError>(())
/// ```
pub fn normal_form<'g>(
    g: &'g Graph,
    e: Expr,
    budget: &Budget,
) -> Result<RationalForm<'g>, NormalFormError> {
    let (field, mut values) = normal_forms(g, &[e], &Options::proof(*budget))?;
    let value = values.pop().unwrap_or_else(RationalFunction::zero);
    Ok(RationalForm { field, value })
}

/// The normal forms of several expressions in one field.
///
/// # Errors
/// As for [`normal_form`].
pub fn normal_forms<'g>(
    g: &'g Graph,
    es: &[Expr],
    options: &Options,
) -> Result<(Field<'g>, Vec<RationalFunction>), NormalFormError> {
    let mut field = Field::new(g, es, options.clone());
    loop {
        match field.convert(es) {
            Ok(values) => return Ok((field, values)),
            // A finer unit of an angle, exponent or root was needed; each restart at least doubles one of them, and
            // all restarts share one budget of work.
            Err(Stop::Refine) => field.restart(es),
            Err(Stop::TooLarge(limit)) => return Err(limit.into()),
            Err(Stop::Undefined) => return Err(NormalFormError::Undefined),
        }
    }
}

/// Why a conversion stops.
enum Stop {
    TooLarge(TooLarge),
    Undefined,
    Refine,
}

impl From<TooLarge> for Stop {
    fn from(limit: TooLarge) -> Stop {
        Stop::TooLarge(limit)
    }
}

#[cfg(test)]
pub(crate) mod tests;

#[cfg(test)]
mod soundness;
