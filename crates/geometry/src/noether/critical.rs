//! Values of one parameter at which a family may contain more integrals.
//!
//! The columns X̄φ that are independent in general make a square matrix at as many points of N. With the points and all other
//! parameters at random values modulo p its determinant is a rational function of the one parameter, and it vanishes where the
//! rank falls, hence wherever there are more integrals. Of its roots those are candidates that are rational multiples of
//! products of powers of the others, or sums of two of these; whoever asks searches there again, and proves what is found.

use super::family::{Family, Member};
use super::search::{Table, SURPLUS};
use super::special::{Term, Tie};
use chetaev_symbolic::number::modular_matrix::{determinant, null_space};
use chetaev_symbolic::number::modular_polynomial::{fraction, roots};
use chetaev_symbolic::number::prime_field::{PrimeField, Residue};
use chetaev_symbolic::number::random::Random;
use chetaev_symbolic::number::reconstruct::rational;
use chetaev_symbolic::zero::points::Draw;
use chetaev_symbolic::{Rational, Symbol};
use rustc_hash::FxHashMap;

/// The most values of the determinant.
const VALUES: usize = 400;

/// Numerators and denominators of the factors that are recognized.
const HEIGHT: u64 = 1000;

/// The highest power of another parameter that is recognized.
const POWER: i8 = 2;

/// A product of powers with its value in a draw.
type Product = (Vec<(Symbol, i8)>, Residue);

impl Table<'_> {
    /// Whether what the table contains is rational at its points, in all parameters.
    pub(super) fn are_rational(&self) -> bool {
        self.points.are_rational()
    }

    /// Candidates for values of a parameter where the family contains more integrals, in terms of the others, while a `tie` holds; `None` where they were
    /// not found within the work left, counted in multiplications.
    pub(super) fn critical(
        &self,
        family: &Family,
        tie: Option<&Tie>,
        parameter: Symbol,
        others: &[Symbol],
        work: &mut u64,
    ) -> Option<Vec<Tie>> {
        if !self.are_rational() {
            return None;
        }
        let drawn = |number: usize| {
            let (draw, random) = self.draw(number)?;
            let draw = tie.map_or(Some(draw.clone()), |tie| self.tied(&draw, tie))?;
            Some((draw, random))
        };
        let (draw, mut random) = drawn(0)?;
        let all = &family.members[1..];
        let rows = self.rows(&draw, &mut random, all, all.len() + SURPLUS)?;
        let pivots = null_space(&draw.field, all.len(), rows).pivots;
        let members: Vec<Member> = pivots.into_iter().map(|i| all[i].clone()).collect();
        let (draw, random) = drawn(1)?;
        let numerator = self.numerator(&draw, &random, &members, parameter, work)?;
        let mut random = Random::stream(self.seed, 1 << 24);
        let found = roots(&draw.field, &numerator, &mut random);
        // An even function has both signs of each root, and the parameter occurs as its square only.
        let is_even = [0, 1].iter().any(|&odd| {
            let mut of_parity = numerator.iter().skip(odd).step_by(2);
            of_parity.all(|c| c.is_zero())
        });
        let products = self.products(&draw, others);
        let ties = found.into_iter().filter_map(|root| {
            let terms = recognized(&draw.field, root, &products)?;
            let is_negative = terms.iter().all(|t| t.coefficient < Rational::ZERO);
            let is_left_out = terms.is_empty() || (is_even && is_negative);
            (!is_left_out).then(|| written(parameter, terms))
        });
        Some(ties.collect())
    }

    /// The numerator of the determinant as a polynomial in the parameter.
    fn numerator(
        &self,
        draw: &Draw,
        random: &Random,
        members: &[Member],
        parameter: Symbol,
        work: &mut u64,
    ) -> Option<Vec<Residue>> {
        let (field, size) = (&draw.field, members.len());
        let cost = (size * size * size / 3 + size * self.points.cost()) as u64;
        let mut places = Random::stream(self.seed, 1 << 25);
        let mut values = Vec::new();
        let mut next = 12;
        while next <= VALUES {
            while values.len() < next {
                *work = work.checked_sub(cost)?;
                let place = field.random(&mut places);
                let mut draw = draw.clone();
                self.points.set(&mut draw, &[(parameter, place)]);
                // The same random numbers are the same points.
                let rows = self.rows(&draw, &mut random.clone(), members, size)?;
                values.push((place, determinant(field, size, rows)));
            }
            if let Some((numerator, _)) = fraction(field, &values) {
                return Some(numerator);
            }
            next *= 2;
        }
        None
    }

    /// One, products of powers of one or two parameters, simple ones first, and products and quotients of three.
    fn products(&self, draw: &Draw, others: &[Symbol]) -> Vec<Product> {
        let field = &draw.field;
        let power = |(s, e): (Symbol, i8)| {
            let value = self.points.value(draw, s)?;
            let power = field.pow(value, u64::from(e.unsigned_abs()));
            let value = if e < 0 { field.inv(power)? } else { power };
            Some((vec![(s, e)], value))
        };
        let exponents: Vec<i8> = (1..=POWER).flat_map(|e| [e, -e]).collect();
        let single: Vec<Product> = exponents
            .iter()
            .flat_map(|&e| others.iter().map(move |&s| (s, e)))
            .filter_map(power)
            .collect();
        let mut all: Vec<Product> = vec![(Vec::new(), field.one())];
        all.extend(single.iter().cloned());
        for (i, (powers, value)) in single.iter().enumerate() {
            for (more, other) in &single[..i] {
                if powers[0].0 != more[0].0 {
                    all.push(([&more[..], powers].concat(), field.mul(*value, *other)));
                }
            }
        }
        let plain = all
            .iter()
            .filter(|(powers, _)| powers.len() == 2 && powers.iter().all(|(_, e)| e.abs() == 1));
        let plain: Vec<Product> = plain.cloned().collect();
        for (powers, value) in plain {
            let position = |s: Symbol| others.iter().position(|&own| own == s);
            let last = powers.iter().filter_map(|&(s, _)| position(s)).max();
            let after = single
                .iter()
                .filter(|(more, _)| more[0].1.abs() == 1 && position(more[0].0) > last);
            for (more, other) in after {
                all.push(([&powers[..], more].concat(), field.mul(value, *other)));
            }
        }
        all
    }
}

/// A root as a rational multiple of a product, or as a sum of two parameters with simple factors; empty for zero.
fn recognized(field: &PrimeField, root: Residue, products: &[Product]) -> Option<Vec<Term>> {
    if root.is_zero() {
        return Some(Vec::new());
    }
    let term = |rest: Residue, (powers, value): &Product| {
        let coefficient = small(field, field.mul(rest, field.inv(*value)?))?;
        Some(Term {
            coefficient,
            powers: powers.clone(),
        })
    };
    if let Some(own) = products.iter().find_map(|product| term(root, product)) {
        return Some(vec![own]);
    }
    let is_linear = |(powers, _): &&Product| matches!(&powers[..], [(_, 1)]);
    let linear: Vec<&Product> = products.iter().filter(is_linear).collect();
    let factors = [(1, 1_u64), (-1, 1), (2, 1), (-2, 1), (1, 2), (-1, 2)];
    let factors = factors.map(|(n, d)| Rational::from_parts(n.into(), d.into()));
    let of_linear = linear.iter().enumerate().find_map(|(i, (powers, value))| {
        factors.iter().find_map(|factor| {
            let own = field.mul(field.from_rational(factor)?, *value);
            let rest = field.sub(root, own);
            let other = linear[..i].iter().find_map(|product| term(rest, product))?;
            let own = Term {
                coefficient: factor.clone(),
                powers: powers.clone(),
            };
            Some(vec![other, own])
        })
    });
    of_linear.or_else(|| sum_of_products(field, root, products, &factors))
}

/// The most products with factors of which two are added.
const SUMMANDS: usize = 4000;

/// A root as a sum of two products with the factors given, as in I2 = I1 + I13²/I1.
fn sum_of_products(
    field: &PrimeField,
    root: Residue,
    products: &[Product],
    factors: &[Rational],
) -> Option<Vec<Term>> {
    let short = products
        .iter()
        .enumerate()
        .filter(|(_, (powers, _))| powers.len() <= 2);
    let short: Vec<(usize, &Product)> = short.collect();
    if short.len() * factors.len() > SUMMANDS {
        return None;
    }
    let with_factor = |&(place, (_, value)): &(usize, &Product)| {
        let own = factors.iter().enumerate();
        let own = own.filter_map(|(i, factor)| {
            let value = field.mul(field.from_rational(factor)?, *value);
            Some((value, (place, i)))
        });
        own.collect::<Vec<_>>()
    };
    let all: Vec<(Residue, (usize, usize))> = short.iter().flat_map(with_factor).collect();
    let known: FxHashMap<Residue, (usize, usize)> = all.iter().rev().copied().collect();
    let term = |(place, factor): (usize, usize)| Term {
        coefficient: factors[factor].clone(),
        powers: products[place].0.clone(),
    };
    all.iter().find_map(|&(value, own)| {
        let other = *known.get(&field.sub(root, value))?;
        Some(vec![term(own), term(other)])
    })
}

/// A parameter as a multiple of another one, by a factor of at least one; other ties as they are.
fn written(parameter: Symbol, terms: Vec<Term>) -> Tie {
    let [term] = &terms[..] else {
        return Tie::Is(parameter, terms);
    };
    let one = Rational::ONE;
    let is_below_one = term.coefficient < one && -term.coefficient.clone() < one;
    match term.powers[..] {
        [(other, 1)] if is_below_one => Tie::Is(
            other,
            vec![Term {
                coefficient: one / term.coefficient.clone(),
                powers: vec![(parameter, 1)],
            }],
        ),
        _ => Tie::Is(parameter, terms),
    }
}

/// The rational number of a class, where its numerator and denominator are small.
fn small(field: &PrimeField, class: Residue) -> Option<Rational> {
    let most = || Rational::from(HEIGHT);
    let number = rational(field, class)?;
    let numerator = Rational::from(number.numerator().clone());
    let denominator = Rational::from(number.denominator().clone());
    let is_small = numerator <= most() && -numerator <= most() && denominator <= most();
    is_small.then_some(number)
}
