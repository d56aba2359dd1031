//! Partial factorisation: contents, square-free parts, and quadratics with a square discriminant.
//!
//! This finds the factors that formulas of mechanics show (common masses and lengths, squares, `x² - y²`). Factors may
//! remain reducible when they have degree three or more in each of their generators.

use dashu_base::{Sign, SquareRootRem};
use dashu_int::IBig;

use super::budget::{Meter, TooLarge};
use super::monomial::Monomial;
use super::sparse::Polynomial;

/// An integer and pairwise coprime, square-free, non-constant polynomials with their multiplicities.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Factorization {
    /// The integer factor, with the sign of the polynomial; 0 for the polynomial 0.
    pub content: IBig,
    /// Factors, each primitive with positive leading coefficient, ordered by degree, length and terms.
    pub factors: Vec<(Polynomial, u32)>,
}

impl Polynomial {
    /// The factors that can be found by greatest common divisors and square roots alone.
    ///
    /// # Errors
    /// [`TooLarge`] when the work exceeds the budget.
    pub fn factorize(&self, meter: &Meter) -> Result<Factorization, TooLarge> {
        if self.is_zero() {
            return Ok(Factorization {
                content: IBig::ZERO,
                factors: Vec::new(),
            });
        }
        let content = self.signed_content();
        let monomial = self.monomial_content();
        let mut factors: Vec<(Polynomial, u32)> = monomial
            .iter()
            .map(|(g, e)| (Polynomial::generator(g), u32::from(e)))
            .collect();
        let rest = self.divide_by_integer(&content);
        let rest = rest.quotient_by_monomial(&monomial).unwrap_or(rest);
        for part in split_contents(&rest, meter)? {
            for (factor, multiplicity) in square_free(&part, meter)? {
                let irreducible = split_quadratic(factor, meter)?;
                factors.extend(irreducible.into_iter().map(|f| (f, multiplicity)));
            }
        }
        // Each gcd is normalised to a positive leading coefficient, so the signs of the parts multiply to one.
        let key = |p: &Polynomial| (p.degree(), p.len());
        factors
            .sort_by(|(a, _), (b, _)| key(a).cmp(&key(b)).then_with(|| b.terms().cmp(a.terms())));
        Ok(Factorization { content, factors })
    }

    /// The square root, when this is the square of a polynomial; the root has a positive leading coefficient.
    ///
    /// # Errors
    /// [`TooLarge`] when the work exceeds the budget.
    pub fn square_root(&self, meter: &Meter) -> Result<Option<Polynomial>, TooLarge> {
        let Some((lead, coefficient)) = self.leading_term() else {
            return Ok(Some(Polynomial::zero()));
        };
        let (Some(lead), Some(top)) = (monomial_root(lead), integer_root(coefficient)) else {
            return Ok(None);
        };
        let double = &top * IBig::from(2);
        let mut root = Polynomial::term(lead.clone(), top);
        let mut rest = self.sub(&root.mul(&root, meter)?);
        while let Some((monomial, coefficient)) = rest.leading_term() {
            let Some(next) = monomial.quotient(&lead) else {
                return Ok(None);
            };
            let (scale, remainder) = dashu_base::DivRem::div_rem(coefficient, &double);
            // A root's next term is below all earlier ones; a higher one means the remainder cannot vanish.
            if !remainder.is_zero() || root.terms().last().is_some_and(|(m, _)| next >= *m) {
                return Ok(None);
            }
            let term = Polynomial::term(next, scale);
            let twice = root.scale(&IBig::from(2)).add(&term);
            rest = rest.sub(&twice.mul(&term, meter)?);
            root = root.add(&term);
            meter.check_terms(root.len())?;
        }
        Ok(Some(root))
    }
}

fn monomial_root(m: &Monomial) -> Option<Monomial> {
    let even = m.exponents().iter().all(|e| e % 2 == 0);
    even.then(|| Monomial::from_exponents(&m.exponents().iter().map(|e| e / 2).collect::<Vec<_>>()))
}

fn integer_root(c: &IBig) -> Option<IBig> {
    let (sign, magnitude) = c.clone().into_parts();
    let (root, remainder) = magnitude.sqrt_rem();
    (sign == Sign::Positive && remainder.is_zero()).then(|| IBig::from(root))
}

/// Factors whose content in each of their generators is 1.
fn split_contents(p: &Polynomial, meter: &Meter) -> Result<Vec<Polynomial>, TooLarge> {
    let mut done = Vec::new();
    let mut open = vec![p.clone()];
    while let Some(part) = open.pop() {
        if part.is_constant() {
            continue;
        }
        // A x + B is its content times an irreducible polynomial.
        if let Some(generator) = linear_generator(&part) {
            let (content, rest) = part.split_content_in(generator, meter)?;
            done.push(rest);
            open.push(content);
            continue;
        }
        let mut split = None;
        for generator in part.generators() {
            let (content, rest) = part.split_content_in(generator, meter)?;
            if !content.is_constant() {
                split = Some((content, rest));
                break;
            }
        }
        match split {
            Some((content, rest)) => open.extend([rest, content]),
            None => done.push(part),
        }
    }
    Ok(done)
}

/// A generator that occurs to the first power at most, of those the one in the fewest terms.
fn linear_generator(p: &Polynomial) -> Option<usize> {
    let linear = p.generators().into_iter().filter(|&g| p.degree_in(g) == 1);
    let count = |g: usize| p.terms().iter().filter(|(m, _)| m.exponent(g) > 0).count();
    linear.min_by_key(|&g| count(g))
}

/// Square-free factors of a polynomial that is primitive in each of its generators.
///
/// D. Y. Y. Yun, On square-free decomposition algorithms (1976).
fn square_free(p: &Polynomial, meter: &Meter) -> Result<Vec<(Polynomial, u32)>, TooLarge> {
    let generators = p.generators();
    let Some(&main) = generators.iter().min_by_key(|&&g| p.degree_in(g)) else {
        return Ok(Vec::new());
    };
    if p.degree_in(main) == 1 {
        return Ok(vec![(p.clone(), 1)]);
    }
    let derivative = p.derivative(main);
    let common = p.gcd(&derivative, meter)?;
    if common.is_constant() {
        return Ok(vec![(p.clone(), 1)]);
    }
    let quotient = |a: &Polynomial, b: &Polynomial| -> Result<Polynomial, TooLarge> {
        // Divisors here are gcds, so the division is exact.
        Ok(a.exact_quotient(b, meter)?.unwrap_or_else(|| a.clone()))
    };
    let mut part = quotient(p, &common)?;
    let mut slope = quotient(&derivative, &common)?.sub(&part.derivative(main));
    let mut factors = Vec::new();
    let mut multiplicity = 1;
    while !part.is_constant() {
        let factor = part.gcd(&slope, meter)?;
        part = quotient(&part, &factor)?;
        slope = quotient(&slope, &factor)?.sub(&part.derivative(main));
        if !factor.is_constant() {
            factors.push((factor, multiplicity));
        }
        multiplicity += 1;
    }
    Ok(factors)
}

/// The two factors of a primitive polynomial of degree two in some generator, when its discriminant is a square there.
fn split_quadratic(p: Polynomial, meter: &Meter) -> Result<Vec<Polynomial>, TooLarge> {
    let generators = p.generators();
    if generators.iter().any(|&g| p.degree_in(g) == 1) {
        return Ok(vec![p]);
    }
    for g in generators.into_iter().filter(|&g| p.degree_in(g) == 2) {
        let [a, b, c] = [2, 1, 0].map(|e| p.coefficient_in(g, e));
        let discriminant = b
            .mul(&b, meter)?
            .sub(&a.mul(&c, meter)?.scale(&IBig::from(4)));
        let Some(root) = discriminant.square_root(meter)? else {
            return Ok(vec![p]);
        };
        // 2 a x + b - √D vanishes at one of the roots; its primitive part is the factor.
        let linear = a
            .scale(&IBig::from(2))
            .mul(&Polynomial::generator(g), meter)?
            .add(&b)
            .sub(&root);
        let (_, factor) = linear.split_content_in(g, meter)?;
        let factor = factor.primitive_part();
        if let Some(other) = p.exact_quotient(&factor, meter)? {
            return Ok(vec![factor, other]);
        }
    }
    Ok(vec![p])
}
