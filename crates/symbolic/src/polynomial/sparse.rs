//! The polynomial itself: construction, ring operations, derivative, evaluation, coefficients.

use std::fmt;

use dashu_base::{BitTest, Gcd, Sign};
use dashu_int::{IBig, UBig};
use hashbrown::HashMap;
use rustc_hash::FxBuildHasher;

use super::budget::{Meter, TooLarge};
use super::monomial::Monomial;

/// A polynomial with integer coefficients; its terms are stored in descending order, none is zero.
#[derive(Clone, PartialEq, Eq, Hash, Default)]
pub struct Polynomial {
    terms: Vec<(Monomial, IBig)>,
}

impl Polynomial {
    /// The polynomial 0.
    pub fn zero() -> Polynomial {
        Polynomial { terms: Vec::new() }
    }

    /// The polynomial 1.
    pub fn one() -> Polynomial {
        Polynomial::constant(IBig::ONE)
    }

    /// A constant.
    pub fn constant(value: impl Into<IBig>) -> Polynomial {
        Polynomial::term(Monomial::one(), value.into())
    }

    /// `coefficient * monomial`.
    pub fn term(monomial: Monomial, coefficient: IBig) -> Polynomial {
        if coefficient.is_zero() {
            return Polynomial::zero();
        }
        Polynomial {
            terms: vec![(monomial, coefficient)],
        }
    }

    /// A generator.
    pub fn generator(index: usize) -> Polynomial {
        Polynomial::term(Monomial::power(index, 1), IBig::ONE)
    }

    /// The sum of the given terms, in any order and with repetitions.
    pub fn from_terms(mut terms: Vec<(Monomial, IBig)>) -> Polynomial {
        terms.sort_by(|a, b| b.0.cmp(&a.0));
        let mut merged: Vec<(Monomial, IBig)> = Vec::with_capacity(terms.len());
        for (monomial, coefficient) in terms {
            match merged.last_mut() {
                Some(last) if last.0 == monomial => last.1 += coefficient,
                _ => merged.push((monomial, coefficient)),
            }
        }
        merged.retain(|(_, c)| !c.is_zero());
        Polynomial { terms: merged }
    }

    /// Terms already in descending order without zeros or repetitions.
    pub(super) fn from_sorted(terms: Vec<(Monomial, IBig)>) -> Polynomial {
        debug_assert!(terms.windows(2).all(|w| w[0].0 > w[1].0));
        debug_assert!(terms.iter().all(|(_, c)| !c.is_zero()));
        Polynomial { terms }
    }

    /// The terms in descending order.
    pub fn terms(&self) -> &[(Monomial, IBig)] {
        &self.terms
    }

    /// The number of terms.
    pub fn len(&self) -> usize {
        self.terms.len()
    }

    /// Whether this is the polynomial 0.
    pub fn is_zero(&self) -> bool {
        self.terms.is_empty()
    }

    /// Whether there are no terms; the same as [`is_zero`](Self::is_zero).
    pub fn is_empty(&self) -> bool {
        self.terms.is_empty()
    }

    /// Whether this is the polynomial 1.
    pub fn is_one(&self) -> bool {
        self.as_constant().is_some_and(|c| c.is_one())
    }

    /// The value of a non-zero constant polynomial.
    pub fn as_constant(&self) -> Option<&IBig> {
        match self.terms.as_slice() {
            [(monomial, coefficient)] if monomial.is_one() => Some(coefficient),
            _ => None,
        }
    }

    /// Whether no generator occurs.
    pub fn is_constant(&self) -> bool {
        self.degree() == 0
    }

    /// The total degree; 0 for the polynomial 0.
    pub fn degree(&self) -> u32 {
        self.terms.first().map_or(0, |(m, _)| m.degree())
    }

    /// The degree in one generator; 0 for the polynomial 0.
    pub fn degree_in(&self, generator: usize) -> u16 {
        self.terms
            .iter()
            .map(|(m, _)| m.exponent(generator))
            .max()
            .unwrap_or(0)
    }

    /// The term of highest order.
    pub fn leading_term(&self) -> Option<&(Monomial, IBig)> {
        self.terms.first()
    }

    /// Whether the leading coefficient is negative.
    pub fn is_negative(&self) -> bool {
        self.terms
            .first()
            .is_some_and(|(_, c)| c.sign() == Sign::Negative)
    }

    /// The generators that occur, ascending.
    pub fn generators(&self) -> Vec<usize> {
        let len = self
            .terms
            .iter()
            .map(|(m, _)| m.extent())
            .max()
            .unwrap_or(0);
        let mut occurs = vec![false; len];
        for (monomial, _) in &self.terms {
            for (generator, _) in monomial.iter() {
                occurs[generator] = true;
            }
        }
        (0..len).filter(|&i| occurs[i]).collect()
    }

    /// The sum.
    pub fn add(&self, other: &Polynomial) -> Polynomial {
        self.merge(other, false)
    }

    /// The difference.
    pub fn sub(&self, other: &Polynomial) -> Polynomial {
        self.merge(other, true)
    }

    fn merge(&self, other: &Polynomial, subtract: bool) -> Polynomial {
        let signed = |c: &IBig| if subtract { -c } else { c.clone() };
        let (a, b) = (&self.terms, &other.terms);
        let (mut i, mut j) = (0, 0);
        let mut terms = Vec::with_capacity(a.len() + b.len());
        while i < a.len() && j < b.len() {
            match a[i].0.cmp(&b[j].0) {
                std::cmp::Ordering::Greater => {
                    terms.push(a[i].clone());
                    i += 1;
                }
                std::cmp::Ordering::Less => {
                    terms.push((b[j].0.clone(), signed(&b[j].1)));
                    j += 1;
                }
                std::cmp::Ordering::Equal => {
                    let sum = if subtract {
                        &a[i].1 - &b[j].1
                    } else {
                        &a[i].1 + &b[j].1
                    };
                    if !sum.is_zero() {
                        terms.push((a[i].0.clone(), sum));
                    }
                    i += 1;
                    j += 1;
                }
            }
        }
        terms.extend_from_slice(&a[i..]);
        terms.extend(b[j..].iter().map(|(m, c)| (m.clone(), signed(c))));
        Polynomial { terms }
    }

    /// The negative.
    pub fn neg(&self) -> Polynomial {
        Polynomial {
            terms: self.terms.iter().map(|(m, c)| (m.clone(), -c)).collect(),
        }
    }

    /// The product with an integer.
    pub fn scale(&self, factor: &IBig) -> Polynomial {
        if factor.is_zero() {
            return Polynomial::zero();
        }
        Polynomial {
            terms: self
                .terms
                .iter()
                .map(|(m, c)| (m.clone(), c * factor))
                .collect(),
        }
    }

    /// The product.
    ///
    /// # Errors
    /// [`TooLarge`] when the product or the work for it exceeds the budget.
    pub fn mul(&self, other: &Polynomial, meter: &Meter) -> Result<Polynomial, TooLarge> {
        if self.is_zero() || other.is_zero() {
            return Ok(Polynomial::zero());
        }
        meter.check_degree(self.degree() + other.degree())?;
        // Long coefficients cost more: one step per product of a machine word with the longer factor.
        let words = 1 + (self.coefficient_bits().min(other.coefficient_bits()) / 64) as u64;
        meter.spend(words * self.len() as u64 * other.len() as u64)?;
        let (short, long) = if self.len() <= other.len() {
            (self, other)
        } else {
            (other, self)
        };
        let product = match short.terms.as_slice() {
            [(monomial, coefficient)] => long.mul_term(monomial, coefficient),
            _ => short.mul_terms(long, meter)?,
        };
        meter.check_bits(product.coefficient_bits())?;
        Ok(product)
    }

    // Order is preserved by multiplication with a monomial, so no sorting is needed.
    fn mul_term(&self, monomial: &Monomial, coefficient: &IBig) -> Polynomial {
        let term = |(m, c): &(Monomial, IBig)| (m.product(monomial), c * coefficient);
        Polynomial {
            terms: self.terms.iter().map(term).collect(),
        }
    }

    fn mul_terms(&self, long: &Polynomial, meter: &Meter) -> Result<Polynomial, TooLarge> {
        let mut sums: HashMap<Monomial, IBig, FxBuildHasher> = HashMap::default();
        sums.reserve(long.len() * 2);
        for (m1, c1) in &self.terms {
            for (m2, c2) in &long.terms {
                *sums.entry(m1.product(m2)).or_insert(IBig::ZERO) += c1 * c2;
            }
            meter.check_terms(sums.len() / 2)?;
        }
        let mut terms: Vec<_> = sums.into_iter().filter(|(_, c)| !c.is_zero()).collect();
        meter.check_terms(terms.len())?;
        terms.sort_unstable_by(|a, b| b.0.cmp(&a.0));
        Ok(Polynomial { terms })
    }

    /// The power with a natural exponent.
    ///
    /// # Errors
    /// [`TooLarge`] when the power or the work for it exceeds the budget.
    pub fn pow(&self, exponent: u32, meter: &Meter) -> Result<Polynomial, TooLarge> {
        if !self.is_constant() {
            let degree = u64::from(self.degree()) * u64::from(exponent);
            meter.check_degree(u32::try_from(degree).unwrap_or(u32::MAX))?;
        }
        // A power of a number is the one place where coefficients grow without the work count noticing.
        if self.coefficient_bits() > 1 {
            meter.check_bits((self.coefficient_bits() - 1).saturating_mul(exponent as usize))?;
        }
        let (mut result, mut square, mut rest) = (Polynomial::one(), self.clone(), exponent);
        while rest > 0 {
            if rest & 1 == 1 {
                result = result.mul(&square, meter)?;
            }
            rest >>= 1;
            if rest > 0 {
                square = square.mul(&square, meter)?;
            }
        }
        Ok(result)
    }

    /// The partial derivative by a generator.
    pub fn derivative(&self, generator: usize) -> Polynomial {
        let term = |(m, c): &(Monomial, IBig)| match m.exponent(generator) {
            0 => None,
            e => Some((m.with_exponent(generator, e - 1), c * IBig::from(e))),
        };
        Polynomial::from_terms(self.terms.iter().filter_map(term).collect())
    }

    /// The polynomial as one in a single generator: pairs of exponent and coefficient, exponents descending.
    pub fn coefficients_in(&self, generator: usize) -> Vec<(u16, Polynomial)> {
        let mut by_exponent: std::collections::BTreeMap<u16, Vec<(Monomial, IBig)>> =
            Default::default();
        for (monomial, coefficient) in &self.terms {
            let term = (monomial.with_exponent(generator, 0), coefficient.clone());
            by_exponent
                .entry(monomial.exponent(generator))
                .or_default()
                .push(term);
        }
        // Within one exponent of the generator the order of the rest is the order of the whole.
        let polynomial = |(e, terms)| (e, Polynomial { terms });
        by_exponent.into_iter().rev().map(polynomial).collect()
    }

    /// The polynomial as one in several generators: pairs of a monomial in these generators and its coefficient, which
    /// is free of them, in descending order.
    pub fn coefficients(&self, generators: &[usize]) -> Vec<(Monomial, Polynomial)> {
        let mut groups: std::collections::BTreeMap<Monomial, Vec<(Monomial, IBig)>> =
            Default::default();
        for (monomial, coefficient) in &self.terms {
            let (mut inside, mut outside) = (Monomial::one(), monomial.clone());
            for &generator in generators {
                let exponent = monomial.exponent(generator);
                if exponent != 0 {
                    inside = inside.with_exponent(generator, exponent);
                    outside = outside.with_exponent(generator, 0);
                }
            }
            let term = (outside, coefficient.clone());
            groups.entry(inside).or_default().push(term);
        }
        groups
            .into_iter()
            .rev()
            .map(|(m, terms)| (m, Polynomial::from_terms(terms)))
            .collect()
    }

    /// The coefficient of the highest power of a generator.
    pub fn leading_coefficient_in(&self, generator: usize) -> Polynomial {
        self.coefficient_in(generator, self.degree_in(generator))
    }

    /// The coefficient of one power of a generator.
    pub fn coefficient_in(&self, generator: usize, exponent: u16) -> Polynomial {
        let keep = |(m, _): &&(Monomial, IBig)| m.exponent(generator) == exponent;
        let term = |(m, c): &(Monomial, IBig)| (m.with_exponent(generator, 0), c.clone());
        Polynomial {
            terms: self.terms.iter().filter(keep).map(term).collect(),
        }
    }

    /// The value after replacing one generator by a polynomial.
    ///
    /// # Errors
    /// [`TooLarge`] when the result or the work for it exceeds the budget.
    pub fn substitute(
        &self,
        generator: usize,
        value: &Polynomial,
        meter: &Meter,
    ) -> Result<Polynomial, TooLarge> {
        let mut result = Polynomial::zero();
        let mut previous = None;
        // Horner's scheme over the exponents that occur.
        for (exponent, coefficient) in self.coefficients_in(generator) {
            if let Some(higher) = previous {
                let power = value.pow(u32::from(higher - exponent), meter)?;
                result = result.mul(&power, meter)?;
            }
            result = result.add(&coefficient);
            previous = Some(exponent);
        }
        match previous {
            Some(lowest) if lowest > 0 => result.mul(&value.pow(u32::from(lowest), meter)?, meter),
            _ => Ok(result),
        }
    }

    /// The value at integers; generators beyond the slice count as zero.
    pub fn evaluate(&self, point: &[IBig]) -> IBig {
        let value = |generator: usize| point.get(generator).cloned().unwrap_or(IBig::ZERO);
        let term = |(m, c): &(Monomial, IBig)| {
            m.iter()
                .fold(c.clone(), |v, (g, e)| v * value(g).pow(usize::from(e)))
        };
        self.terms
            .iter()
            .map(term)
            .fold(IBig::ZERO, |sum, v| sum + v)
    }

    /// The greatest common divisor of the coefficients; 0 for the polynomial 0.
    pub fn integer_content(&self) -> UBig {
        let mut content = UBig::ZERO;
        for (_, coefficient) in &self.terms {
            let magnitude = coefficient.clone().into_parts().1;
            content = if content.is_zero() {
                magnitude
            } else {
                content.gcd(magnitude)
            };
            if content.is_one() {
                break;
            }
        }
        content
    }

    /// The largest monomial that divides every term; 1 for the polynomial 0.
    pub fn monomial_content(&self) -> Monomial {
        let mut terms = self.terms.iter().map(|(m, _)| m);
        let Some(first) = terms.next() else {
            return Monomial::one();
        };
        let mut content = first.clone();
        for m in terms {
            if content.is_one() {
                break;
            }
            content = content.gcd(m);
        }
        content
    }

    /// The number of bits of the longest coefficient.
    pub fn coefficient_bits(&self) -> usize {
        self.terms
            .iter()
            .map(|(_, c)| c.bit_len())
            .max()
            .unwrap_or(0)
    }
}

impl fmt::Debug for Polynomial {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.is_zero() {
            return f.write_str("0");
        }
        for (i, (monomial, coefficient)) in self.terms.iter().enumerate() {
            f.write_str(if i == 0 { "" } else { " + " })?;
            write!(f, "{coefficient}*{monomial:?}")?;
        }
        Ok(())
    }
}
