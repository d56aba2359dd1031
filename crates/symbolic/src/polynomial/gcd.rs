//! The greatest common divisor of polynomials over ℤ.
//!
//! Cheap reductions come first: integer and monomial contents, generators that occur on one side only, and degree
//! bounds from univariate images modulo a prime, which settle coprime pairs (the usual case) at once. The rest is
//! found by [sparse interpolation](super::zippel) and verified by division, so a result is always exact.

use dashu_base::Gcd;
use dashu_int::IBig;

use super::budget::{Meter, TooLarge};
use super::division::natural;
use super::monomial::Monomial;
use super::sparse::Polynomial;
use super::{univariate, zippel};
use crate::number::prime_field::{PrimeField, Residue};
use crate::number::random::Random;

impl Polynomial {
    /// The greatest common divisor over ℤ, content included, with positive leading coefficient; 0 for two zeros.
    ///
    /// # Errors
    /// [`TooLarge`] when the work exceeds the budget.
    pub fn gcd(&self, other: &Polynomial, meter: &Meter) -> Result<Polynomial, TooLarge> {
        if self.is_zero() || other.is_zero() {
            let sum = self.add(other);
            return Ok(if sum.is_negative() { sum.neg() } else { sum });
        }
        let integer = self.integer_content().gcd(other.integer_content());
        if self.is_constant() || other.is_constant() {
            return Ok(Polynomial::term(Monomial::one(), IBig::from(integer)));
        }
        let monomial = self.monomial_content().gcd(&other.monomial_content());
        let content = Polynomial::term(monomial, IBig::from(integer));
        if self.len() == 1 || other.len() == 1 {
            return Ok(content);
        }
        let (a, b) = (strip(self), strip(other));
        if a.is_constant() || b.is_constant() {
            return Ok(content);
        }
        content.mul(&gcd_stripped(&a, &b, meter)?, meter)
    }
}

/// The greatest common divisor of several polynomials; 0 for none.
///
/// # Errors
/// [`TooLarge`] when the work exceeds the budget.
pub(super) fn gcd_of(polynomials: &[Polynomial], meter: &Meter) -> Result<Polynomial, TooLarge> {
    let mut result = Polynomial::zero();
    for polynomial in polynomials {
        if result.is_one() {
            break;
        }
        // Once the gcd is reached every further polynomial is a multiple of it.
        if polynomial.exact_quotient(&result, meter)?.is_none() {
            result = result.gcd(polynomial, meter)?;
        }
    }
    Ok(result)
}

/// Without integer and monomial content.
fn strip(p: &Polynomial) -> Polynomial {
    let monomial = p.monomial_content();
    let rest = if monomial.is_one() {
        None
    } else {
        p.quotient_by_monomial(&monomial)
    };
    rest.as_ref().unwrap_or(p).primitive_part()
}

/// The gcd of two polynomials that are not constant and have neither integer nor monomial content.
fn gcd_stripped(a: &Polynomial, b: &Polynomial, meter: &Meter) -> Result<Polynomial, TooLarge> {
    if a == b {
        return Ok(a.clone());
    }
    let (in_a, in_b) = (a.generators(), b.generators());
    let only = |mine: &[usize], theirs: &[usize]| -> Vec<usize> {
        mine.iter()
            .copied()
            .filter(|g| theirs.binary_search(g).is_err())
            .collect()
    };
    let (only_a, only_b) = (only(&in_a, &in_b), only(&in_b, &in_a));
    if !only_a.is_empty() || !only_b.is_empty() {
        return gcd_of_coefficients(a, &only_a, b, &only_b, meter);
    }
    let bounds = degree_bounds(a, b, &in_a, meter)?;
    let absent: Vec<usize> = bounds
        .iter()
        .filter(|&&(_, d)| d == 0)
        .map(|&(g, _)| g)
        .collect();
    if absent.len() == bounds.len() {
        return Ok(Polynomial::one());
    }
    if !absent.is_empty() {
        return gcd_of_coefficients(a, &absent, b, &absent, meter);
    }
    for (small, large) in [(a, b), (b, a)] {
        let full = bounds.iter().all(|&(g, d)| d == small.degree_in(g));
        if full && large.exact_quotient(small, meter)?.is_some() {
            return Ok(small.clone());
        }
    }
    gcd_dense(a, b, &bounds, meter)
}

/// The gcd when it is known to be free of the given generators: then it divides every coefficient.
fn gcd_of_coefficients(
    a: &Polynomial,
    free_a: &[usize],
    b: &Polynomial,
    free_b: &[usize],
    meter: &Meter,
) -> Result<Polynomial, TooLarge> {
    let mut parts: Vec<Polynomial> = a.coefficients(free_a).into_iter().map(|(_, c)| c).collect();
    parts.extend(b.coefficients(free_b).into_iter().map(|(_, c)| c));
    parts.sort_by_key(Polynomial::len);
    gcd_of(&parts, meter)
}

/// Bounds for the degree of the gcd in each generator, rigorous: where the leading coefficient of `a` or of `b` does not
/// vanish, the degree of the image of the gcd does not drop, and the image divides the gcd of the images.
fn degree_bounds(
    a: &Polynomial,
    b: &Polynomial,
    generators: &[usize],
    meter: &Meter,
) -> Result<Vec<(usize, u16)>, TooLarge> {
    meter.spend(((a.len() + b.len()) * generators.len()) as u64)?;
    let least = |g: usize| a.degree_in(g).min(b.degree_in(g));
    let Some(field) = meter.field(0) else {
        return Ok(generators.iter().map(|&g| (g, least(g))).collect());
    };
    let mut random = Random::new(0xb0a7);
    let size = generators.last().map_or(0, |g| g + 1);
    let point: Vec<Residue> = (0..size)
        .map(|_| univariate::random_unit(&field, &mut random))
        .collect();
    let (values_a, values_b) = (
        term_values(a, &field, &point),
        term_values(b, &field, &point),
    );
    let bound = |&g: &usize| {
        let inverse = univariate::inverse(&field, point[g]);
        let image_a = image_in(a, g, &values_a, &field, inverse);
        let image_b = image_in(b, g, &values_b, &field, inverse);
        let vanishes = |image: &[Residue]| image.last() == Some(&Residue::ZERO);
        if vanishes(&image_a) && vanishes(&image_b) {
            return (g, least(g));
        }
        let degree = univariate::gcd(&field, image_a, image_b)
            .len()
            .saturating_sub(1);
        (g, least(g).min(degree as u16))
    };
    Ok(generators.iter().map(bound).collect())
}

fn term_values(p: &Polynomial, field: &PrimeField, point: &[Residue]) -> Vec<Residue> {
    let value = |(m, c): &(Monomial, IBig)| {
        let power = |v, (g, e): (usize, u16)| field.mul(v, field.pow(point[g], u64::from(e)));
        m.iter().fold(field.from_integer(c), power)
    };
    p.terms().iter().map(value).collect()
}

/// The image with every generator but one replaced by its value, from the values of the terms.
fn image_in(
    p: &Polynomial,
    g: usize,
    values: &[Residue],
    field: &PrimeField,
    inverse: Residue,
) -> Vec<Residue> {
    let mut image = vec![Residue::ZERO; usize::from(p.degree_in(g)) + 1];
    for ((m, _), &value) in p.terms().iter().zip(values) {
        let e = m.exponent(g);
        let coefficient = field.mul(value, field.pow(inverse, u64::from(e)));
        image[usize::from(e)] = field.add(image[usize::from(e)], coefficient);
    }
    image
}

/// The gcd of two polynomials in the same generators, which probably all occur in it.
fn gcd_dense(
    a: &Polynomial,
    b: &Polynomial,
    bounds: &[(usize, u16)],
    meter: &Meter,
) -> Result<Polynomial, TooLarge> {
    // Short leading coefficients keep γ, and with it the polynomial to be interpolated, short.
    let cost = |&(g, _): &(usize, u16)| {
        a.leading_coefficient_in(g).len() + b.leading_coefficient_in(g).len()
    };
    let Some(&(main, _)) = bounds.iter().min_by_key(|bound| cost(bound)) else {
        return Ok(Polynomial::one());
    };
    let others: Vec<(usize, u16)> = bounds.iter().copied().filter(|&(g, _)| g != main).collect();
    let (content_a, a) = split_content(a, main, meter)?;
    let (content_b, b) = split_content(b, main, meter)?;
    let content = content_a.gcd(&content_b, meter)?;
    let gamma = a
        .leading_coefficient_in(main)
        .gcd(&b.leading_coefficient_in(main), meter)?;
    let problem = zippel::Problem {
        a: &a,
        b: &b,
        main,
        others: &others,
        gamma: &gamma,
    };
    let accept = |h: &Polynomial| {
        let (_, g) = split_content(h, main, meter)?;
        let divides =
            a.exact_quotient(&g, meter)?.is_some() && b.exact_quotient(&g, meter)?.is_some();
        Ok(divides.then_some(g))
    };
    match zippel::search(&problem, meter, accept)? {
        Some(g) => content.mul(&g.primitive_part(), meter),
        // Every attempt hit an unlucky prime or point, which happens only on inputs beyond any reasonable budget.
        None => Err(TooLarge::Work {
            limit: meter.budget().work,
        }),
    }
}

fn split_content(
    p: &Polynomial,
    generator: usize,
    meter: &Meter,
) -> Result<(Polynomial, Polynomial), TooLarge> {
    let content = p.content_in(generator, meter)?;
    if content.is_one() {
        return Ok((content, p.clone()));
    }
    // The content divides by construction.
    let part = p
        .exact_quotient(&content, meter)?
        .unwrap_or_else(|| p.clone());
    Ok((content, part))
}

impl Polynomial {
    /// The content in one generator and the polynomial divided by it.
    pub(super) fn split_content_in(
        &self,
        generator: usize,
        meter: &Meter,
    ) -> Result<(Polynomial, Polynomial), TooLarge> {
        split_content(self, generator, meter)
    }

    /// The least common multiple, with positive leading coefficient; 0 when one argument is.
    ///
    /// # Errors
    /// [`TooLarge`] when the work exceeds the budget.
    pub fn lcm(&self, other: &Polynomial, meter: &Meter) -> Result<Polynomial, TooLarge> {
        if self.is_zero() || other.is_zero() {
            return Ok(Polynomial::zero());
        }
        let gcd = self.gcd(other, meter)?;
        let cofactor = other
            .exact_quotient(&gcd, meter)?
            .unwrap_or_else(|| natural(1u8.into()));
        let lcm = self.mul(&cofactor, meter)?;
        Ok(if lcm.is_negative() { lcm.neg() } else { lcm })
    }
}
