//! Exact division, pseudo-division, content and primitive part.

use std::collections::BTreeMap;

use dashu_base::{DivRem, Sign};
use dashu_int::{IBig, UBig};

use super::budget::{Meter, TooLarge};
use super::gcd;
use super::monomial::Monomial;
use super::sparse::Polynomial;

impl Polynomial {
    /// The quotient, when `divisor` divides this polynomial over ℤ; `None` otherwise, and for the divisor 0.
    ///
    /// # Errors
    /// [`TooLarge`] when the work exceeds the budget.
    pub fn exact_quotient(
        &self,
        divisor: &Polynomial,
        meter: &Meter,
    ) -> Result<Option<Polynomial>, TooLarge> {
        let Some((lead, lead_coefficient)) = divisor.leading_term() else {
            return Ok(None);
        };
        if self.is_zero() {
            return Ok(Some(Polynomial::zero()));
        }
        if divisor.len() == 1 {
            return Ok(self.quotient_by_term(lead, lead_coefficient));
        }
        if divisor
            .generators()
            .iter()
            .any(|&g| divisor.degree_in(g) > self.degree_in(g))
        {
            return Ok(None);
        }
        let mut rest: BTreeMap<Monomial, IBig> = self.terms().iter().cloned().collect();
        let mut quotient = Vec::new();
        while let Some((monomial, coefficient)) = rest.pop_last() {
            let Some(factor) = monomial.quotient(lead) else {
                return Ok(None);
            };
            let Some(scale) = divide(&coefficient, lead_coefficient) else {
                return Ok(None);
            };
            meter.spend(divisor.len() as u64)?;
            for (m, c) in &divisor.terms()[1..] {
                subtract(&mut rest, factor.product(m), c * &scale);
            }
            quotient.push((factor, scale));
            meter.check_terms(quotient.len().max(rest.len() / 2))?;
        }
        Ok(Some(Polynomial::from_sorted(quotient)))
    }

    fn quotient_by_term(&self, monomial: &Monomial, coefficient: &IBig) -> Option<Polynomial> {
        let term =
            |(m, c): &(Monomial, IBig)| Some((m.quotient(monomial)?, divide(c, coefficient)?));
        let terms: Option<Vec<_>> = self.terms().iter().map(term).collect();
        terms.map(Polynomial::from_sorted)
    }

    /// The quotient by an integer known to divide every coefficient; other coefficients are truncated.
    pub(super) fn divide_by_integer(&self, divisor: &IBig) -> Polynomial {
        let term = |(m, c): &(Monomial, IBig)| (m.clone(), c / divisor);
        Polynomial::from_terms(self.terms().iter().map(term).collect())
    }

    /// The quotient by a monomial known to divide every term; `None` when it does not.
    pub fn quotient_by_monomial(&self, monomial: &Monomial) -> Option<Polynomial> {
        self.quotient_by_term(monomial, &IBig::ONE)
    }

    /// The pseudo-remainder in one generator: r with lc^s self = q divisor + r and degree r < degree divisor, where lc
    /// is the leading coefficient of the divisor and s the number of division steps done (not more than needed).
    ///
    /// # Errors
    /// [`TooLarge`] when an intermediate polynomial or the work exceeds the budget.
    pub fn pseudo_remainder(
        &self,
        divisor: &Polynomial,
        generator: usize,
        meter: &Meter,
    ) -> Result<Polynomial, TooLarge> {
        let degree = divisor.degree_in(generator);
        let lead = divisor.leading_coefficient_in(generator);
        let tail = divisor.sub(&lead.mul(&power_of(generator, degree), meter)?);
        let mut rest = self.clone();
        while !rest.is_zero() && rest.degree_in(generator) >= degree {
            let shift = rest.degree_in(generator) - degree;
            let top = rest.leading_coefficient_in(generator);
            let below = rest.sub(&top.mul(&power_of(generator, shift + degree), meter)?);
            if divisor.is_zero() || degree == 0 {
                return Ok(Polynomial::zero());
            }
            let cancelled = top
                .mul(&power_of(generator, shift), meter)?
                .mul(&tail, meter)?;
            rest = below.mul(&lead, meter)?.sub(&cancelled);
        }
        Ok(rest)
    }

    /// The content in one generator: the greatest common divisor of the coefficients of its powers.
    ///
    /// # Errors
    /// [`TooLarge`] when the work exceeds the budget.
    pub fn content_in(&self, generator: usize, meter: &Meter) -> Result<Polynomial, TooLarge> {
        let mut coefficients: Vec<Polynomial> = self
            .coefficients_in(generator)
            .into_iter()
            .map(|(_, c)| c)
            .collect();
        // Short ones first: their gcd is cheap and soon 1.
        coefficients.sort_by_key(Polynomial::len);
        gcd::gcd_of(&coefficients, meter)
    }

    /// The polynomial divided by the greatest common divisor of its coefficients, with positive leading coefficient.
    pub fn primitive_part(&self) -> Polynomial {
        if self.is_zero() {
            return Polynomial::zero();
        }
        let content = self.signed_content();
        if content.is_one() {
            return self.clone();
        }
        self.divide_by_integer(&content)
    }

    /// The greatest common divisor of the coefficients with the sign of the leading coefficient.
    pub fn signed_content(&self) -> IBig {
        let sign = if self.is_negative() {
            Sign::Negative
        } else {
            Sign::Positive
        };
        IBig::from_parts(sign, self.integer_content())
    }
}

fn power_of(generator: usize, exponent: u16) -> Polynomial {
    Polynomial::term(Monomial::power(generator, exponent), IBig::ONE)
}

fn divide(a: &IBig, b: &IBig) -> Option<IBig> {
    let (quotient, remainder) = a.div_rem(b);
    remainder.is_zero().then_some(quotient)
}

fn subtract(rest: &mut BTreeMap<Monomial, IBig>, monomial: Monomial, value: IBig) {
    match rest.entry(monomial) {
        std::collections::btree_map::Entry::Vacant(place) => {
            place.insert(-value);
        }
        std::collections::btree_map::Entry::Occupied(mut place) => {
            *place.get_mut() -= value;
            if place.get().is_zero() {
                place.remove();
            }
        }
    }
}

/// The integer as a constant polynomial.
pub(super) fn natural(value: UBig) -> Polynomial {
    Polynomial::constant(IBig::from(value))
}
