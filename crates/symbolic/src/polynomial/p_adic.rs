//! Hensel's lifting of two coprime factors of a polynomial in one generator from a prime to its powers.
//!
//! Where `p = lead · g h` modulo a prime with `s g + t h = 1`, there are factors modulo each of its powers, one digit after the other
//! (H. Zassenhaus, J. Number Theory 1, 1969). With a power beyond twice the longest coefficient a factor has, its coefficients are
//! those nearest to zero.

use dashu_base::BitTest;
use dashu_int::IBig;

use super::budget::{Meter, TooLarge};
use super::monomial::Monomial;
use super::sparse::Polynomial;
use crate::number::modular_polynomial::{inverse_modulo, product, quotient_and_remainder};
use crate::number::prime_field::{PrimeField, Residue};

/// What lifting needs.
pub(super) struct Lifting {
    field: PrimeField,
    generator: usize,
    /// The powers of the prime from the first on; the last one is beyond twice the longest coefficient.
    powers: Vec<IBig>,
    lead: IBig,
    /// The polynomial over its leading coefficient modulo the last power, the constant first.
    monic: Vec<IBig>,
}

impl Lifting {
    /// For factors of a polynomial in this generator alone whose coefficients, times a factor of the leading one, have so many bits at most.
    /// `None` where the prime divides the leading coefficient.
    pub(super) fn new(
        p: &Polynomial,
        generator: usize,
        bits: usize,
        field: PrimeField,
    ) -> Option<Lifting> {
        let prime = IBig::from(field.modulus());
        let mut powers = vec![prime.clone()];
        while powers.last()?.bit_len() < bits + 2 {
            powers.push(powers.last()? * &prime);
        }
        let mut dense = vec![IBig::ZERO; usize::from(p.degree_in(generator)) + 1];
        for (monomial, c) in p.terms() {
            dense[usize::from(monomial.exponent(generator))] = c.clone();
        }
        let lead = dense.last()?.clone();
        let last = powers.last()?;
        let unit = inverse(&lead, &field, last)?;
        let monic = dense.iter().map(|c| reduced(c * &unit, last)).collect();
        Some(Lifting {
            field,
            generator,
            powers,
            lead,
            monic,
        })
    }

    /// The polynomial that is the first half modulo the prime times a number, if the halves belong to one.
    pub(super) fn factor(
        &self,
        first: &[Residue],
        second: &[Residue],
        meter: &Meter,
    ) -> Result<Option<Polynomial>, TooLarge> {
        let field = &self.field;
        let (Some(t), Some(s)) = (
            inverse_modulo(field, second, first),
            inverse_modulo(field, first, second),
        ) else {
            return Ok(None);
        };
        let integers = |a: &[Residue]| -> Vec<IBig> {
            a.iter().map(|&c| IBig::from(field.to_u64(c))).collect()
        };
        let (mut g, mut h) = (integers(first), integers(second));
        for power in &self.powers[..self.powers.len() - 1] {
            meter.spend((g.len() * h.len() * (1 + power.bit_len() / 64)) as u64)?;
            let error = self.error((&g, &h), power);
            let digit = |by: &[Residue], modulus: &[Residue]| {
                let all = product(field, &error, by);
                quotient_and_remainder(field, all, modulus).map(|(_, rest)| rest)
            };
            let (Some(of_g), Some(of_h)) = (digit(&t, first), digit(&s, second)) else {
                return Ok(None);
            };
            for (own, digits) in [(&mut g, of_g), (&mut h, of_h)] {
                for (c, digit) in own.iter_mut().zip(integers(&digits)) {
                    *c += digit * power;
                }
            }
        }
        self.read(&g, meter)
    }

    /// `(monic − g h) / power` modulo the prime.
    fn error(&self, (g, h): (&[IBig], &[IBig]), power: &IBig) -> Vec<Residue> {
        let mut rest = self.monic.clone();
        for (i, a) in g.iter().enumerate() {
            for (j, b) in h.iter().enumerate() {
                rest[i + j] -= a * b;
            }
        }
        let digits = rest.into_iter().map(|c| c / power);
        digits.map(|c| self.field.from_integer(&c)).collect()
    }

    /// The primitive part of a monic factor times the leading coefficient.
    fn read(&self, g: &[IBig], meter: &Meter) -> Result<Option<Polynomial>, TooLarge> {
        let Some(last) = self.powers.last() else {
            return Ok(None);
        };
        let terms = g.iter().enumerate().map(|(e, c)| {
            let c = reduced(c * &self.lead, last);
            let nearest = if &c + &c > *last { c - last } else { c };
            let mut exponents = vec![0_u16; self.generator + 1];
            exponents[self.generator] = e as u16;
            (Monomial::from_exponents(&exponents), nearest)
        });
        let polynomial = Polynomial::from_terms(terms.collect());
        meter.check_bits(polynomial.coefficient_bits())?;
        Ok((!polynomial.is_zero()).then(|| polynomial.primitive_part()))
    }
}

/// The representative from zero on.
fn reduced(c: IBig, modulus: &IBig) -> IBig {
    let rest = c % modulus;
    if rest < IBig::ZERO {
        rest + modulus
    } else {
        rest
    }
}

/// 1/a modulo a power of the prime, by Newton's method; `None` where the prime divides a.
fn inverse(a: &IBig, field: &PrimeField, power: &IBig) -> Option<IBig> {
    let start = field.inv(field.from_integer(a))?;
    let mut own = IBig::from(field.to_u64(start));
    loop {
        let error = reduced(IBig::ONE - a * &own, power);
        if error == IBig::ZERO {
            return Some(own);
        }
        own = reduced(&own + &own * error, power);
    }
}
