//! What stands in the equations of steady motion, and the values that are found.

use crate::problem::LinearizationError;
use chetaev_symbolic::number::ball::{Ball, Precision};
use chetaev_symbolic::polynomial::normal_form::NormalFormError;
use chetaev_symbolic::polynomial::TooLarge;
use chetaev_symbolic::{Expr, Graph, Rational, Symbol};

/// Bits of the enclosures.
pub(crate) const BITS: usize = 256;

/// Why the steady motions were not all found.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SteadySetError {
    /// There is no closed system.
    #[error(transparent)]
    System(Box<LinearizationError>),
    /// Something that is neither polynomial nor a sine, cosine or root of an unknown.
    #[error("the equations of steady motion are not polynomial in the unknowns and their sines and cosines: they contain {what}")]
    NotPolynomial {
        /// It.
        what: String,
    },
    /// A constraint with components.
    #[error("the constraint `{constraint}` is a product, and on which of its factors a motion lies is not asked here: state the factor as the constraint")]
    Product {
        /// The constraint.
        constraint: String,
    },
    /// They have no value.
    #[error("the equations are not defined there, whatever the positions: a denominator vanishes")]
    Undefined,
    /// The equations are too large.
    #[error("the equations of steady motion are too large to be solved exactly: {0}")]
    Form(NormalFormError),
    /// Their solution is.
    #[error("the equations of steady motion are too large to be solved exactly: {0}")]
    TooLarge(#[from] TooLarge),
    /// A number that may be zero.
    #[error("whether {number} is zero was not decided")]
    Undecided {
        /// The number.
        number: String,
    },
    /// The real zeros of a polynomial were not told apart.
    #[error("the real zeros of {polynomial} were not enclosed one by one")]
    NotEnclosed {
        /// The polynomial.
        polynomial: String,
    },
}

impl From<NormalFormError> for SteadySetError {
    fn from(problem: NormalFormError) -> SteadySetError {
        match problem {
            NormalFormError::Undefined => SteadySetError::Undefined,
            other => SteadySetError::Form(other),
        }
    }
}

impl From<LinearizationError> for SteadySetError {
    fn from(problem: LinearizationError) -> SteadySetError {
        SteadySetError::System(Box::new(problem))
    }
}

/// The value of a variable.
#[derive(Clone, Debug)]
pub enum Value {
    /// A number.
    Number {
        /// Exact: in closed form, where its equation is linear or quadratic, else as an algebraic number where its equation has rational coefficients.
        exact: Option<Expr>,
        /// Enclosed.
        ball: Ball,
    },
    /// A function of the parameters of the family, and of the system.
    Function(Expr),
    /// Tied to others by an equation.
    Tied,
}

/// An unknown of the closed system.
#[derive(Clone, Debug)]
pub(crate) struct Unknown {
    pub(crate) symbol: Symbol,
    pub(crate) name: String,
    pub(crate) is_speed: bool,
    /// The generators by which it is determined.
    pub(crate) by: Generators,
}

/// What stands for an unknown in the polynomials.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Generators {
    /// Itself.
    Own(usize),
    /// Cosine and sine of so many times it.
    Angle {
        cosine: usize,
        sine: usize,
        /// Numerator and denominator.
        times: (i64, i64),
    },
    /// None: it does not occur.
    None,
}

/// A rational number as an expression.
pub(crate) fn fraction(g: &Graph, (above, below): (i64, i64)) -> Expr {
    g.number(Rational::from_parts_signed(above.into(), below.into()))
}

/// The precision of the enclosures.
pub(crate) fn precision() -> Precision {
    Precision::new(BITS)
}
