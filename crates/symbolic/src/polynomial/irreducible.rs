//! Irreducible factors over the rational numbers of polynomials in several generators.
//!
//! At random values of all generators but one a polynomial becomes one in that generator over a prime field; its factors there are
//! gathered into two coprime halves, these are lifted to power series in the others (Hensel's lemma, degree by degree), and
//! a division over the integers decides (D. R. Musser, J. ACM 22, 1975; P. S. Wang, Math. Comp. 32, 1978). A true factor is found whenever its
//! coefficients fit the prime, which is checked beforehand, or in one generator a power of it ([`p_adic`]); so what is not taken apart is
//! irreducible.

use std::collections::BTreeMap;

use dashu_base::BitTest;
use dashu_int::IBig;

use super::budget::{Meter, TooLarge};
use super::monomial::Monomial;
use super::p_adic;
use super::sparse::Polynomial;
use super::univariate::trim;
use crate::number::modular_polynomial::{factors, inverse_modulo, product, quotient_and_remainder};
use crate::number::prime_field::{PrimeField, Residue};
use crate::number::random::Random;

/// How many random points are tried for one at which there are few factors.
const POINTS: usize = 12;

/// More coefficients of power series are not computed.
const COEFFICIENTS: usize = 20_000;

/// Residues of the prime are integers of fewer bits.
const BITS_OF_PRIME: usize = 61;

/// More factors at a point are not gathered in all ways.
const MOST_FACTORS: usize = 12;

impl Polynomial {
    /// The irreducible factors over the rational numbers with their multiplicities, each primitive with positive leading coefficient.
    ///
    /// # Errors
    /// [`TooLarge`] when the work exceeds the budget, or coefficients are too long.
    pub fn irreducible_factors(&self, meter: &Meter) -> Result<Vec<(Polynomial, u32)>, TooLarge> {
        let mut found = Vec::new();
        for (factor, multiplicity) in self.factorize(meter)?.factors {
            let mut open = vec![factor];
            while let Some(p) = open.pop() {
                match two_factors(&p, meter)? {
                    Some(pair) => open.extend(pair),
                    None => found.push((p, multiplicity)),
                }
            }
        }
        found.sort_by(|(a, _), (b, _)| {
            let key = |p: &Polynomial| (p.degree(), p.len());
            key(a).cmp(&key(b)).then_with(|| b.terms().cmp(a.terms()))
        });
        Ok(found)
    }
}

/// Two factors of a square-free polynomial that is primitive in each of its generators; `None` where it is irreducible.
fn two_factors(p: &Polynomial, meter: &Meter) -> Result<Option<[Polynomial; 2]>, TooLarge> {
    let generators = p.generators();
    let degree = |g: usize| (p.degree_in(g), p.leading_coefficient_in(g).degree());
    let Some(&main) = generators.iter().min_by_key(|&&g| degree(g)) else {
        return Ok(None);
    };
    if p.degree_in(main) < 2 {
        return Ok(None);
    }
    let Some(field) = meter.field(0) else {
        return Ok(None);
    };
    let bits = bits_of_factors(p, main);
    let others: Vec<usize> = generators.into_iter().filter(|&g| g != main).collect();
    let mut random = Random::new(0x5eed);
    let mut best: Option<(Vec<Residue>, Vec<Vec<Residue>>)> = None;
    for _ in 0..POINTS {
        let point: Vec<Residue> = others.iter().map(|_| field.random(&mut random)).collect();
        let at = series(p, main, &others, &point, &field, 0);
        let Some(own) = at.first().and_then(|at| factors(&field, at, &mut random)) else {
            continue;
        };
        // A factor of the polynomial is one at the point, as the leading coefficient does not vanish there.
        let is_full = at
            .first()
            .is_some_and(|at| at.len() == usize::from(p.degree_in(main)) + 1);
        if is_full
            && best
                .as_ref()
                .is_none_or(|(_, least)| own.len() < least.len())
        {
            best = Some((point, own));
        }
        if best.as_ref().is_some_and(|(_, own)| own.len() == 1) {
            return Ok(None);
        }
    }
    let Some((point, own)) = best.filter(|(_, own)| own.len() <= MOST_FACTORS) else {
        return Err(TooLarge::Degree {
            limit: MOST_FACTORS as u32,
        });
    };
    let lifting = Halves::new(p, main, others, (point, bits), field, meter)?;
    // Each way to gather them in two halves once: the first factor belongs to the first half.
    for choice in 0..(1_usize << (own.len() - 1)) - 1 {
        let is_first = |i: usize| i == 0 || choice >> (i - 1) & 1 == 1;
        let half = |first: bool| {
            let places = (0..own.len()).filter(|&i| is_first(i) == first);
            places.fold(vec![field.one()], |all, i| product(&field, &all, &own[i]))
        };
        let Some(candidate) = lifting.factor(&half(true), &half(false), meter)? else {
            continue;
        };
        if let Some(other) = p.exact_quotient(&candidate, meter)? {
            return Ok(Some([candidate, with_positive_lead(other)]));
        }
    }
    Ok(None)
}

fn with_positive_lead(p: Polynomial) -> Polynomial {
    match p.is_negative() {
        true => p.neg(),
        false => p,
    }
}

/// How two coprime halves at a point become a factor.
enum Halves {
    /// By series in the other generators.
    Series(Lifting),
    /// By powers of the prime: there are no others.
    Numbers(p_adic::Lifting),
}

impl Halves {
    /// # Errors
    /// [`TooLarge`] where coefficients might not fit, or series have too many.
    fn new(
        p: &Polynomial,
        main: usize,
        others: Vec<usize>,
        (point, bits): (Vec<Residue>, usize),
        field: PrimeField,
        meter: &Meter,
    ) -> Result<Halves, TooLarge> {
        if !others.is_empty() {
            if bits >= BITS_OF_PRIME {
                meter.check_bits(usize::MAX)?;
            }
            let lifting = Lifting::new(p, main, others, (point, bits), field, meter)?;
            return Ok(Halves::Series(lifting));
        }
        meter.check_bits(bits)?;
        let lifting = p_adic::Lifting::new(p, main, bits, field);
        lifting
            .map(Halves::Numbers)
            .ok_or(TooLarge::Bits { limit: bits })
    }

    fn factor(
        &self,
        first: &Dense,
        second: &Dense,
        meter: &Meter,
    ) -> Result<Option<Polynomial>, TooLarge> {
        match self {
            Halves::Series(lifting) => lifting.factor(first, second, meter),
            Halves::Numbers(lifting) => lifting.factor(first, second, meter),
        }
    }
}

/// How many bits the coefficients of a factor times a factor of the leading coefficient may have: at most `2^(Σ d_i)` times the norm of a polynomial
/// of the degrees d_i that it divides, here the product with the leading coefficient (K. Mahler, J. London Math. Soc. 37, 1962).
fn bits_of_factors(p: &Polynomial, main: usize) -> usize {
    let lead = p.leading_coefficient_in(main);
    let degrees = |p: &Polynomial| -> usize {
        let generators = p.generators().into_iter();
        generators.map(|g| usize::from(p.degree_in(g))).sum()
    };
    let norm = |p: &Polynomial| p.coefficient_bits() + p.len().ilog2() as usize + 1;
    degrees(p) + degrees(&lead) + norm(p) + norm(&lead)
}

/// Coefficients in one generator, ascending.
type Dense = Vec<Residue>;

/// A power series in the other generators about a point, up to a total degree: a coefficient for each monomial, by degree.
type Series = Vec<Dense>;

/// What lifting from a point needs.
struct Lifting {
    field: PrimeField,
    main: usize,
    others: Vec<usize>,
    point: Vec<Residue>,
    /// Longer coefficients belong to no factor.
    bits: usize,
    /// Monomials in the others, the lower degrees first, and where each stands.
    monomials: Vec<Vec<u16>>,
    places: BTreeMap<Vec<u16>, usize>,
    /// The polynomial over its leading coefficient, and that coefficient.
    monic: Series,
    lead: Series,
}

impl Lifting {
    fn new(
        p: &Polynomial,
        main: usize,
        others: Vec<usize>,
        (point, bits): (Vec<Residue>, usize),
        field: PrimeField,
        meter: &Meter,
    ) -> Result<Lifting, TooLarge> {
        let lead = p.leading_coefficient_in(main);
        let terms = p.terms().iter();
        let degree = terms
            .map(|(m, _)| m.degree() - u32::from(m.exponent(main)))
            .max();
        let degree = degree.unwrap_or(0) + lead.degree();
        let monomials = monomials(others.len(), degree as usize).ok_or(TooLarge::Terms {
            limit: COEFFICIENTS,
        })?;
        let places = monomials.iter().cloned().zip(0..).collect();
        let mut lifting = Lifting {
            monic: Vec::new(),
            lead: series(&lead, main, &others, &point, &field, degree as usize),
            field,
            main,
            others,
            point,
            bits,
            monomials,
            places,
        };
        let all = series(
            p,
            main,
            &lifting.others,
            &lifting.point,
            &field,
            degree as usize,
        );
        lifting.monic = lifting.divided(&all, meter)?;
        Ok(lifting)
    }

    /// Where the product of two monomials stands, if it is not cut off.
    fn product_place(&self, i: usize, j: usize) -> Option<usize> {
        let pairs = self.monomials[i].iter().zip(&self.monomials[j]);
        let sum: Vec<u16> = pairs.map(|(a, b)| a + b).collect();
        self.places.get(&sum).copied()
    }

    /// `sum += factor a b`.
    fn add_product(&self, sum: &mut Dense, (a, b): (&Dense, &Dense), factor: Residue) {
        let own = product(&self.field, a, b);
        if sum.len() < own.len() {
            sum.resize(own.len(), Residue::ZERO);
        }
        for (s, c) in sum.iter_mut().zip(own) {
            *s = self.field.add(*s, self.field.mul(factor, c));
        }
    }

    /// Over the leading coefficient, which is a unit.
    fn divided(&self, all: &Series, meter: &Meter) -> Result<Series, TooLarge> {
        let field = &self.field;
        let unit = self.lead[0].first().and_then(|&c| field.inv(c));
        let unit = unit.unwrap_or(Residue::ZERO);
        let minus_one = field.neg(field.one());
        let mut rest = all.clone();
        let mut quotient: Series = vec![Vec::new(); all.len()];
        for place in 0..all.len() {
            let mut own: Dense = rest[place].iter().map(|&c| field.mul(c, unit)).collect();
            trim(&mut own);
            for (j, lead) in self.lead.iter().enumerate().skip(1) {
                if lead.is_empty() || own.is_empty() {
                    continue;
                }
                meter.spend(own.len() as u64)?;
                if let Some(target) = self.product_place(place, j) {
                    self.add_product(&mut rest[target], (&own, lead), minus_one);
                }
            }
            quotient[place] = own;
        }
        Ok(quotient)
    }

    /// The polynomial whose values at the point are the first half times a number, if the halves belong to one.
    fn factor(
        &self,
        first: &Dense,
        second: &Dense,
        meter: &Meter,
    ) -> Result<Option<Polynomial>, TooLarge> {
        let field = &self.field;
        // s first + t second = 1.
        let Some(t) = inverse_modulo(field, second, first) else {
            return Ok(None);
        };
        let Some(s) = inverse_modulo(field, first, second) else {
            return Ok(None);
        };
        let minus_one = field.neg(field.one());
        let count = self.monomials.len();
        let (mut g, mut h): (Series, Series) = (vec![Vec::new(); count], vec![Vec::new(); count]);
        (g[0], h[0]) = (first.clone(), second.clone());
        // What is left of the polynomial when the products of what is known are taken off.
        let mut rest = self.monic.clone();
        for place in 1..count {
            let mut error = std::mem::take(&mut rest[place]);
            trim(&mut error);
            if error.is_empty() {
                continue;
            }
            let remainder = |a: &Dense, modulus: &Dense| {
                quotient_and_remainder(field, product(field, &error, a), modulus).map(|(_, r)| r)
            };
            let (Some(own_g), Some(own_h)) = (remainder(&t, first), remainder(&s, second)) else {
                return Ok(None);
            };
            for (j, other) in h.iter().enumerate().take(place).skip(1) {
                self.take_off(&mut rest, (place, &own_g), (j, other), meter)?;
            }
            for (j, other) in g.iter().enumerate().take(place).skip(1) {
                self.take_off(&mut rest, (place, &own_h), (j, other), meter)?;
            }
            if let Some(square) = self.product_place(place, place) {
                self.add_product(&mut rest[square], (&own_g, &own_h), minus_one);
            }
            (g[place], h[place]) = (own_g, own_h);
        }
        self.read(&g, meter)
    }

    fn take_off(
        &self,
        rest: &mut Series,
        (i, a): (usize, &Dense),
        (j, b): (usize, &Dense),
        meter: &Meter,
    ) -> Result<(), TooLarge> {
        if a.is_empty() || b.is_empty() {
            return Ok(());
        }
        meter.spend((a.len() * b.len()) as u64)?;
        if let Some(target) = self.product_place(i, j) {
            let minus_one = self.field.neg(self.field.one());
            self.add_product(&mut rest[target], (a, b), minus_one);
        }
        Ok(())
    }

    /// The primitive part of a monic series times the leading coefficient, as a polynomial.
    fn read(&self, monic: &Series, meter: &Meter) -> Result<Option<Polynomial>, TooLarge> {
        let field = &self.field;
        let mut all: Series = vec![Vec::new(); monic.len()];
        for (i, a) in monic.iter().enumerate().filter(|(_, a)| !a.is_empty()) {
            for (j, lead) in self.lead.iter().enumerate().filter(|(_, c)| !c.is_empty()) {
                meter.spend(a.len() as u64)?;
                if let Some(target) = self.product_place(i, j) {
                    self.add_product(&mut all[target], (a, lead), field.one());
                }
            }
        }
        // Back from the point: y = (y - a) + a is put in for one generator after the other.
        let mut terms: BTreeMap<Vec<u16>, Dense> = BTreeMap::new();
        for (place, own) in all
            .into_iter()
            .enumerate()
            .filter(|(_, own)| !own.is_empty())
        {
            terms.insert(self.monomials[place].clone(), own);
        }
        for (k, &a) in self.point.iter().enumerate() {
            terms = self.shifted(&terms, (k, field.neg(a)), meter)?;
        }
        let mut read = Vec::new();
        for (exponents, own) in &terms {
            for (e, &c) in own.iter().enumerate().filter(|(_, c)| !c.is_zero()) {
                let c = symmetric(field, c);
                if c.bit_len() > self.bits {
                    return Ok(None);
                }
                let mut powers = vec![(self.main, e as u16)];
                powers.extend(self.others.iter().copied().zip(exponents.iter().copied()));
                let size = powers.iter().map(|(g, _)| g + 1).max().unwrap_or(0);
                let mut full = vec![0_u16; size];
                for (g, e) in powers {
                    full[g] = e;
                }
                read.push((Monomial::from_exponents(&full), c));
            }
        }
        let polynomial = Polynomial::from_terms(read);
        meter.check_terms(polynomial.len())?;
        if polynomial.is_zero() {
            return Ok(None);
        }
        let (_, factor) = polynomial.split_content_in(self.main, meter)?;
        Ok(Some(with_positive_lead(factor.primitive_part())))
    }

    /// With `y + a` in the place of the k-th generator y.
    fn shifted(
        &self,
        terms: &BTreeMap<Vec<u16>, Dense>,
        (k, a): (usize, Residue),
        meter: &Meter,
    ) -> Result<BTreeMap<Vec<u16>, Dense>, TooLarge> {
        let field = &self.field;
        let mut moved: BTreeMap<Vec<u16>, Dense> = BTreeMap::new();
        for (exponents, own) in terms {
            let top = exponents[k];
            let (mut binomial, mut power) = (field.one(), field.one());
            // C(e, j) a^j y^(e - j)
            for j in 0..=top {
                meter.spend(own.len() as u64)?;
                let mut target = exponents.clone();
                target[k] = top - j;
                let factor = field.mul(binomial, power);
                let sum = moved.entry(target).or_default();
                self.add_product(sum, (own, &vec![field.one()]), factor);
                power = field.mul(power, a);
                let up = field.from_u64(u64::from(top - j));
                let down = field.inv(field.from_u64(u64::from(j) + 1));
                binomial = field.mul(binomial, field.mul(up, down.unwrap_or(Residue::ZERO)));
            }
        }
        for own in moved.values_mut() {
            trim(own);
        }
        moved.retain(|_, own| !own.is_empty());
        Ok(moved)
    }
}

/// The representative nearest to zero.
fn symmetric(field: &PrimeField, c: Residue) -> IBig {
    let value = field.to_u64(c);
    match value > field.modulus() / 2 {
        true => IBig::from(value) - IBig::from(field.modulus()),
        false => IBig::from(value),
    }
}

/// All monomials in so many generators up to a total degree, the lower degrees first; `None` where there are too many.
fn monomials(generators: usize, degree: usize) -> Option<Vec<Vec<u16>>> {
    let mut all: Vec<Vec<u16>> = vec![vec![0; generators]];
    let mut before = all.clone();
    for _ in 0..degree {
        let mut next: Vec<Vec<u16>> = Vec::new();
        for monomial in &before {
            // Exponents grow from the last generator used on, so that each monomial comes once.
            let from = monomial.iter().rposition(|&e| e > 0).unwrap_or(0);
            for k in from..generators {
                let mut own = monomial.clone();
                own[k] += 1;
                next.push(own);
            }
        }
        all.extend(next.iter().cloned());
        if all.len() > COEFFICIENTS {
            return None;
        }
        before = next;
    }
    Some(all)
}

/// A polynomial as a series about a point, in the order of [`monomials`].
fn series(
    p: &Polynomial,
    main: usize,
    others: &[usize],
    point: &[Residue],
    field: &PrimeField,
    degree: usize,
) -> Series {
    let Some(list) = monomials(others.len(), degree) else {
        return Vec::new();
    };
    let places: BTreeMap<&[u16], usize> = list.iter().map(Vec::as_slice).zip(0..).collect();
    let mut all: Series = vec![Vec::new(); list.len()];
    for (monomial, c) in p.terms() {
        // Π (y_k + a_k)^(e_k), one generator after the other.
        let mut expanded = vec![(vec![0_u16; others.len()], field.from_integer(c))];
        for (k, (&g, &a)) in others.iter().zip(point).enumerate() {
            for _ in 0..monomial.exponent(g) {
                expanded = times_shifted(field, expanded, (k, a), degree);
            }
        }
        let exponent = usize::from(monomial.exponent(main));
        for (exponents, c) in expanded {
            let Some(&place) = places.get(exponents.as_slice()) else {
                continue;
            };
            let own = &mut all[place];
            if own.len() <= exponent {
                own.resize(exponent + 1, Residue::ZERO);
            }
            own[exponent] = field.add(own[exponent], c);
        }
    }
    all.iter_mut().for_each(trim);
    all
}

/// Terms times `y_k + a`, without those of too high a degree.
fn times_shifted(
    field: &PrimeField,
    terms: Vec<(Vec<u16>, Residue)>,
    (k, a): (usize, Residue),
    degree: usize,
) -> Vec<(Vec<u16>, Residue)> {
    let mut product: BTreeMap<Vec<u16>, Residue> = BTreeMap::new();
    let mut add = |exponents: Vec<u16>, c: Residue| {
        let sum = product.entry(exponents).or_insert(Residue::ZERO);
        *sum = field.add(*sum, c);
    };
    for (exponents, c) in terms {
        if exponents.iter().map(|&e| usize::from(e)).sum::<usize>() < degree {
            let mut higher = exponents.clone();
            higher[k] += 1;
            add(higher, c);
        }
        add(exponents, field.mul(c, a));
    }
    product.into_iter().collect()
}
