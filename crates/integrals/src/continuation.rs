//! A Darboux pair at other values of the constants, by continuation from where it was found.
//!
//! At fixed points z the equations `X P(z) = K(z) P(z)` are bilinear in the coefficients of P and K. Along a line in the space of the
//! constants, `c_0 + ε (c_1 - c_0)`, their solution is a power series in ε, found order by order with the Jacobian of the start; its
//! coefficients are rational functions of ε where those of P are rational functions of the constants (Padé), and these have values
//! at ε = 1.

use crate::extactic::Pair;
use crate::orbit::{value, Exponents, Orbits};
use crate::polynomial_field::PolynomialField;
use chetaev_symbolic::number::modular_matrix::{factorize, null_space, Factorization};
use chetaev_symbolic::number::modular_polynomial::{product, quotient_and_remainder, value as at};
use chetaev_symbolic::number::prime_field::{PrimeField, Residue};
use chetaev_symbolic::number::random::Random;
use chetaev_symbolic::polynomial::Polynomial;

/// The order of the series: enough for fractions of degree twelve.
const ORDER: usize = 28;

/// More equations than unknowns.
const SURPLUS: usize = 4;

/// How many coefficients more than unknowns a fraction needs to be believed.
const SPARE: usize = 3;

/// A series in ε.
pub(crate) type Series = Vec<Residue>;

/// A pair with its equations at fixed points.
#[derive(Debug)]
pub(crate) struct Continuation<'a> {
    own: &'a PolynomialField,
    orbits: &'a Orbits<'a>,
    pair: Pair,
    points: Vec<Vec<Residue>>,
    /// The equations that determine the unknowns.
    chosen: Vec<usize>,
    jacobian: Factorization,
}

/// What enters the equation at one point.
struct Equation {
    /// `D X m` of the members of P as series.
    rates: Vec<Series>,
    members: Vec<Residue>,
    cofactor: Vec<Residue>,
}

impl<'a> Continuation<'a> {
    /// `None` where the pair is not isolated, or constants are related.
    pub(crate) fn new(
        own: &'a PolynomialField,
        orbits: &'a Orbits<'a>,
        pair: &Pair,
        random: &mut Random,
    ) -> Option<Continuation<'a>> {
        if own.binds_constants() {
            return None;
        }
        let unknowns = pair.polynomial.len() - 1 + pair.cofactor.len();
        let points: Option<Vec<Vec<Residue>>> = (0..unknowns + SURPLUS)
            .map(|_| orbits.point(random))
            .collect();
        let points = points?;
        let field = &orbits.at.field;
        let still = vec![Residue::ZERO; own.letters.len()];
        let rows: Vec<Vec<Residue>> = points
            .iter()
            .map(|z| {
                let equation = equation(own, orbits, pair, z, &still);
                let dot = |a: &[Residue], b: &[(Exponents, Residue)]| {
                    a.iter().zip(b).fold(Residue::ZERO, |sum, (&x, (_, c))| {
                        field.add(sum, field.mul(x, *c))
                    })
                };
                let k = dot(&equation.cofactor, &pair.cofactor);
                let p = dot(&equation.members, &pair.polynomial);
                let last = pair.polynomial.len() - 1;
                let by_polynomial = (0..last)
                    .map(|j| field.sub(equation.rates[j][0], field.mul(k, equation.members[j])));
                let by_cofactor = equation
                    .cofactor
                    .iter()
                    .map(|&m| field.neg(field.mul(m, p)));
                by_polynomial.chain(by_cofactor).collect()
            })
            .collect();
        let transposed = (0..unknowns).flat_map(|j| rows.iter().map(move |row| row[j]));
        let chosen = null_space(field, rows.len(), transposed.collect()).pivots;
        if chosen.len() != unknowns {
            return None;
        }
        let square = chosen.iter().flat_map(|&i| rows[i].clone());
        let jacobian = factorize(field, unknowns, square.collect())?;
        Some(Continuation {
            own,
            orbits,
            pair: pair.clone(),
            points,
            chosen,
            jacobian,
        })
    }

    /// The coefficients of P as series towards other constants, the last one being 1.
    pub(crate) fn towards(&self, constants: &[Residue]) -> Vec<Series> {
        let field = &self.orbits.at.field;
        let start = self.orbits.at.constants.iter().zip(constants);
        let direction: Vec<Residue> = start.map(|(&a, &b)| field.sub(b, a)).collect();
        let equations: Vec<Equation> = self
            .chosen
            .iter()
            .map(|&i| {
                equation(
                    self.own,
                    self.orbits,
                    &self.pair,
                    &self.points[i],
                    &direction,
                )
            })
            .collect();
        let start = |terms: &[(Exponents, Residue)]| -> Vec<Series> {
            terms.iter().map(|(_, c)| vec![*c]).collect()
        };
        let mut polynomial = start(&self.pair.polynomial);
        let mut cofactor = start(&self.pair.cofactor);
        let last = polynomial.len() - 1;
        let mut values: Vec<[Series; 2]> = equations
            .iter()
            .map(|equation| {
                [
                    vec![total(field, &polynomial, &equation.members, 0)],
                    vec![total(field, &cofactor, &equation.cofactor, 0)],
                ]
            })
            .collect();
        for order in 1..ORDER {
            let all = polynomial.iter_mut().chain(&mut cofactor);
            all.chain(values.iter_mut().flatten())
                .for_each(|s| s.push(Residue::ZERO));
            let pairs = equations.iter().zip(&values);
            let residuals: Vec<Residue> = pairs
                .map(|(equation, [p, k])| {
                    let rates = polynomial.iter().zip(&equation.rates);
                    let product = coefficient(field, k, p, order);
                    rates.fold(product, |sum, (own, rate)| {
                        field.sub(sum, coefficient(field, own, rate, order))
                    })
                })
                .collect();
            let step = self.jacobian.solve(field, &residuals);
            let (by_polynomial, by_cofactor) = step.split_at(last);
            let own = polynomial[..last].iter_mut().zip(by_polynomial);
            own.for_each(|(s, &x)| s[order] = x);
            let own = cofactor.iter_mut().zip(by_cofactor);
            own.for_each(|(s, &x)| s[order] = x);
            for (equation, [p, k]) in equations.iter().zip(&mut values) {
                p[order] = total(field, &polynomial, &equation.members, order);
                k[order] = total(field, &cofactor, &equation.cofactor, order);
            }
        }
        polynomial
    }
}

/// The coefficient of one order in a combination of series.
fn total(field: &PrimeField, terms: &[Series], weights: &[Residue], order: usize) -> Residue {
    terms
        .iter()
        .zip(weights)
        .fold(Residue::ZERO, |sum, (s, &w)| {
            field.add(sum, field.mul(s[order], w))
        })
}

/// The coefficient of one order in a product of series.
fn coefficient(field: &PrimeField, a: &[Residue], b: &[Residue], order: usize) -> Residue {
    let own = b.iter().take(order + 1).enumerate();
    own.fold(Residue::ZERO, |sum, (i, &y)| match a.get(order - i) {
        Some(&x) => field.add(sum, field.mul(x, y)),
        None => sum,
    })
}

fn equation(
    own: &PolynomialField,
    orbits: &Orbits<'_>,
    pair: &Pair,
    point: &[Residue],
    direction: &[Residue],
) -> Equation {
    let field = &orbits.at.field;
    let mut values = orbits.at.constants.clone();
    for (&i, &x) in orbits.letters.iter().zip(point) {
        values[i] = x;
    }
    let rates: Vec<Series> = orbits
        .letters
        .iter()
        .map(|&i| along(field, &own.rates[i], &values, direction))
        .collect();
    let power = |exponents: &Exponents| {
        exponents
            .iter()
            .zip(point)
            .fold(field.one(), |product, (&e, &x)| {
                field.mul(product, field.pow(x, u64::from(e)))
            })
    };
    let rate = |exponents: &Exponents| -> Series {
        let mut sum: Series = vec![Residue::ZERO];
        for (place, &e) in exponents.iter().enumerate().filter(|(_, &e)| e > 0) {
            let mut less = exponents.clone();
            less[place] -= 1;
            let slope = field.mul(field.from_u64(u64::from(e)), power(&less));
            sum.resize(sum.len().max(rates[place].len()), Residue::ZERO);
            for (x, &r) in sum.iter_mut().zip(&rates[place]) {
                *x = field.add(*x, field.mul(slope, r));
            }
        }
        sum
    };
    Equation {
        rates: pair.polynomial.iter().map(|(e, _)| rate(e)).collect(),
        members: pair.polynomial.iter().map(|(e, _)| power(e)).collect(),
        cofactor: pair.cofactor.iter().map(|(e, _)| power(e)).collect(),
    }
}

/// A polynomial along a line of the constants, as a series that ends.
fn along(
    field: &PrimeField,
    polynomial: &Polynomial,
    values: &[Residue],
    direction: &[Residue],
) -> Series {
    let degree = polynomial.degree() as usize;
    let is_still = direction.iter().all(|d| d.is_zero());
    if is_still {
        return vec![value(field, polynomial, values)];
    }
    let mut sum = vec![Residue::ZERO; degree + 1];
    for (monomial, c) in polynomial.terms() {
        let mut term = vec![field.from_integer(c)];
        for (letter, e) in monomial.iter() {
            for _ in 0..e {
                term = product(field, &term, &[values[letter], direction[letter]]);
            }
        }
        for (x, y) in sum.iter_mut().zip(term) {
            *x = field.add(*x, y);
        }
    }
    sum
}

/// The product of two series.
pub(crate) fn times(field: &PrimeField, a: &[Residue], b: &[Residue]) -> Series {
    (0..a.len()).map(|k| coefficient(field, a, b, k)).collect()
}

/// `1/a`; `None` where a begins with zero.
pub(crate) fn reciprocal(field: &PrimeField, a: &[Residue]) -> Option<Series> {
    let first = field.inv(*a.first()?)?;
    let mut found: Series = vec![first];
    for k in 1..a.len() {
        let sum = (1..=k).fold(Residue::ZERO, |sum, i| {
            field.add(sum, field.mul(a[i], found[k - i]))
        });
        found.push(field.neg(field.mul(first, sum)));
    }
    Some(found)
}

/// The value at 1 of the rational function that a series is the beginning of; `None` where no fraction of so low a degree has it
/// that coefficients are left over.
pub(crate) fn value_at_one(field: &PrimeField, series: &[Residue]) -> Option<Residue> {
    let mut modulus = vec![Residue::ZERO; series.len()];
    modulus.push(field.one());
    let mut rest = series.to_vec();
    while rest.last().is_some_and(|x| x.is_zero()) {
        rest.pop();
    }
    if rest.is_empty() {
        return Some(Residue::ZERO);
    }
    let (mut r, mut next_r) = (modulus, rest);
    let (mut t, mut next_t): (Series, Series) = (Vec::new(), vec![field.one()]);
    let mut best: Option<(usize, Series, Series)> = None;
    while !next_r.is_empty() {
        let degrees = next_r.len() + next_t.len();
        if best.as_ref().is_none_or(|(least, _, _)| degrees < *least) {
            best = Some((degrees, next_r.clone(), next_t.clone()));
        }
        let (quotient, remainder) = quotient_and_remainder(field, r, &next_r)?;
        let mut new_t = product(field, &quotient, &next_t);
        new_t.resize(new_t.len().max(t.len()), Residue::ZERO);
        for (i, x) in new_t.iter_mut().enumerate() {
            *x = field.sub(t.get(i).copied().unwrap_or(Residue::ZERO), *x);
        }
        while new_t.last().is_some_and(|x| x.is_zero()) {
            new_t.pop();
        }
        (r, next_r) = (next_r, remainder);
        (t, next_t) = (next_t, new_t);
    }
    let (degrees, above, below) = best?;
    if degrees + SPARE > series.len() + 1 {
        return None;
    }
    let below = field.inv(at(field, &below, field.one()))?;
    Some(field.mul(at(field, &above, field.one()), below))
}
