//! Rational functions: quotients of two polynomials in lowest terms.

use dashu_base::Sign;
use dashu_int::IBig;

use super::budget::{Meter, TooLarge};
use super::sparse::Polynomial;
use crate::rational::Rational;

/// numerator / denominator over ℤ, coprime, the denominator not zero and with positive leading coefficient.
///
/// Equal rational functions have equal representations.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RationalFunction {
    numerator: Polynomial,
    denominator: Polynomial,
}

impl RationalFunction {
    /// The constant 0.
    pub fn zero() -> RationalFunction {
        Polynomial::zero().into()
    }

    /// The constant 1.
    pub fn one() -> RationalFunction {
        Polynomial::one().into()
    }

    /// A rational constant.
    pub fn constant(value: &Rational) -> RationalFunction {
        RationalFunction {
            numerator: Polynomial::constant(value.numerator().clone()),
            denominator: Polynomial::constant(IBig::from(value.denominator().clone())),
        }
    }

    /// The quotient in lowest terms; `None` when the denominator is zero.
    ///
    /// # Errors
    /// [`TooLarge`] when the work exceeds the budget.
    pub fn new(
        numerator: Polynomial,
        denominator: Polynomial,
        meter: &Meter,
    ) -> Result<Option<RationalFunction>, TooLarge> {
        if denominator.is_zero() {
            return Ok(None);
        }
        if numerator.is_zero() {
            return Ok(Some(RationalFunction::zero()));
        }
        let common = numerator.gcd(&denominator, meter)?;
        let numerator = cancel(numerator, &common, meter)?;
        let denominator = cancel(denominator, &common, meter)?;
        Ok(Some(RationalFunction::coprime(numerator, denominator)))
    }

    /// A quotient already in lowest terms, up to the sign.
    fn coprime(numerator: Polynomial, denominator: Polynomial) -> RationalFunction {
        if denominator.is_negative() {
            return RationalFunction {
                numerator: numerator.neg(),
                denominator: denominator.neg(),
            };
        }
        RationalFunction {
            numerator,
            denominator,
        }
    }

    /// The numerator.
    pub fn numerator(&self) -> &Polynomial {
        &self.numerator
    }

    /// The denominator; 1 for a polynomial.
    pub fn denominator(&self) -> &Polynomial {
        &self.denominator
    }

    /// Whether this is the constant 0.
    pub fn is_zero(&self) -> bool {
        self.numerator.is_zero()
    }

    /// The value of a constant.
    pub fn as_rational(&self) -> Option<Rational> {
        if self.is_zero() {
            return Some(Rational::ZERO);
        }
        let (n, d) = (
            self.numerator.as_constant()?,
            self.denominator.as_constant()?,
        );
        Some(Rational::from_parts_signed(n.clone(), d.clone()))
    }

    /// The negative.
    pub fn neg(&self) -> RationalFunction {
        RationalFunction {
            numerator: self.numerator.neg(),
            denominator: self.denominator.clone(),
        }
    }

    /// The sum.
    ///
    /// # Errors
    /// [`TooLarge`] when the result or the work for it exceeds the budget.
    pub fn add(
        &self,
        other: &RationalFunction,
        meter: &Meter,
    ) -> Result<RationalFunction, TooLarge> {
        let (a, b) = (self, other);
        if a.denominator == b.denominator {
            let numerator = a.numerator.add(&b.numerator);
            let common = numerator.gcd(&a.denominator, meter)?;
            let denominator = cancel(a.denominator.clone(), &common, meter)?;
            return Ok(RationalFunction::coprime(
                cancel(numerator, &common, meter)?,
                denominator,
            ));
        }
        // P. Henrici, A subroutine for computations with rational numbers (1956): only the gcd of the denominators can
        // survive into the gcd of the sum.
        let common = a.denominator.gcd(&b.denominator, meter)?;
        let (da, db) = (
            cancel(a.denominator.clone(), &common, meter)?,
            cancel(b.denominator.clone(), &common, meter)?,
        );
        let numerator = a
            .numerator
            .mul(&db, meter)?
            .add(&b.numerator.mul(&da, meter)?);
        if numerator.is_zero() {
            return Ok(RationalFunction::zero());
        }
        let rest = numerator.gcd(&common, meter)?;
        let denominator = da
            .mul(&db, meter)?
            .mul(&cancel(common, &rest, meter)?, meter)?;
        Ok(RationalFunction::coprime(
            cancel(numerator, &rest, meter)?,
            denominator,
        ))
    }

    /// The difference.
    ///
    /// # Errors
    /// [`TooLarge`] when the result or the work for it exceeds the budget.
    pub fn sub(
        &self,
        other: &RationalFunction,
        meter: &Meter,
    ) -> Result<RationalFunction, TooLarge> {
        self.add(&other.neg(), meter)
    }

    /// The product.
    ///
    /// # Errors
    /// [`TooLarge`] when the result or the work for it exceeds the budget.
    pub fn mul(
        &self,
        other: &RationalFunction,
        meter: &Meter,
    ) -> Result<RationalFunction, TooLarge> {
        if self.is_zero() || other.is_zero() {
            return Ok(RationalFunction::zero());
        }
        let first = self.numerator.gcd(&other.denominator, meter)?;
        let second = other.numerator.gcd(&self.denominator, meter)?;
        let n1 = cancel(self.numerator.clone(), &first, meter)?;
        let n2 = cancel(other.numerator.clone(), &second, meter)?;
        let d1 = cancel(self.denominator.clone(), &second, meter)?;
        let d2 = cancel(other.denominator.clone(), &first, meter)?;
        Ok(RationalFunction::coprime(
            n1.mul(&n2, meter)?,
            d1.mul(&d2, meter)?,
        ))
    }

    /// The reciprocal; `None` for 0.
    pub fn reciprocal(&self) -> Option<RationalFunction> {
        if self.is_zero() {
            return None;
        }
        Some(RationalFunction::coprime(
            self.denominator.clone(),
            self.numerator.clone(),
        ))
    }

    /// The quotient; `None` when the divisor is 0.
    ///
    /// # Errors
    /// [`TooLarge`] when the result or the work for it exceeds the budget.
    pub fn div(
        &self,
        other: &RationalFunction,
        meter: &Meter,
    ) -> Result<Option<RationalFunction>, TooLarge> {
        match other.reciprocal() {
            Some(inverse) => self.mul(&inverse, meter).map(Some),
            None => Ok(None),
        }
    }

    /// The power with an integer exponent; `None` for a negative power of 0.
    ///
    /// # Errors
    /// [`TooLarge`] when the result or the work for it exceeds the budget.
    pub fn pow(&self, exponent: i64, meter: &Meter) -> Result<Option<RationalFunction>, TooLarge> {
        let base = if exponent < 0 {
            self.reciprocal()
        } else {
            Some(self.clone())
        };
        let Some(base) = base else { return Ok(None) };
        // An exponent beyond u32 exceeds every degree, and a constant base needs one only when it is ±1 or 0.
        let exponent = u32::try_from(exponent.unsigned_abs());
        let exponent = exponent.map_err(|_| TooLarge::Degree {
            limit: meter.budget().degree,
        })?;
        let numerator = base.numerator.pow(exponent, meter)?;
        let denominator = base.denominator.pow(exponent, meter)?;
        Ok(Some(RationalFunction {
            numerator,
            denominator,
        }))
    }

    /// The partial derivative by a generator.
    ///
    /// # Errors
    /// [`TooLarge`] when the result or the work for it exceeds the budget.
    pub fn derivative(
        &self,
        generator: usize,
        meter: &Meter,
    ) -> Result<RationalFunction, TooLarge> {
        let (n, d) = (&self.numerator, &self.denominator);
        let slope = n
            .derivative(generator)
            .mul(d, meter)?
            .sub(&n.mul(&d.derivative(generator), meter)?);
        let square = d.mul(d, meter)?;
        Ok(RationalFunction::new(slope, square, meter)?.unwrap_or_else(RationalFunction::zero))
    }

    /// The sign of the leading coefficient of the numerator is negative.
    pub fn is_negative(&self) -> bool {
        self.numerator
            .leading_term()
            .is_some_and(|(_, c)| c.sign() == Sign::Negative)
    }
}

impl From<Polynomial> for RationalFunction {
    fn from(numerator: Polynomial) -> RationalFunction {
        RationalFunction {
            numerator,
            denominator: Polynomial::one(),
        }
    }
}

/// The quotient by a known divisor.
fn cancel(p: Polynomial, divisor: &Polynomial, meter: &Meter) -> Result<Polynomial, TooLarge> {
    if divisor.is_one() {
        return Ok(p);
    }
    let quotient = p.exact_quotient(divisor, meter)?;
    Ok(quotient.unwrap_or(p))
}
