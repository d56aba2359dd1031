//! Modular gcd by sparse interpolation.
//!
//! R. Zippel, Probabilistic algorithms for sparse polynomials (1979). The gcd g of two polynomials primitive in the
//! main generator is found through h = (γ / lc g) g, where γ is the gcd of the leading coefficients: its leading
//! coefficient is known, so images of h follow from univariate gcds modulo a prime. Generators are added one at a
//! time; the terms found so far (the skeleton) reduce each new value to linear Vandermonde systems.
//!
//! The result is only a candidate here; the caller divides. A wrong guess costs time, never truth.

use dashu_base::Sign;
use dashu_int::{IBig, UBig};

use super::budget::{Meter, TooLarge};
use super::monomial::Monomial;
use super::sparse::Polynomial;
use super::univariate::{self, random_unit};
use crate::number::prime_field::{PrimeField, Residue};
use crate::number::random::Random;

/// Two polynomials whose gcd is wanted, both primitive in the main generator.
pub(super) struct Problem<'a> {
    pub(super) a: &'a Polynomial,
    pub(super) b: &'a Polynomial,
    pub(super) main: usize,
    /// The other generators, with a bound for the degree of the gcd in each.
    pub(super) others: &'a [(usize, u16)],
    /// The gcd of the leading coefficients in the main generator.
    pub(super) gamma: &'a Polynomial,
}

/// Coefficients of the powers of the main generator; each a list of exponents of the others and a value.
type Skeleton = Vec<Vec<(Vec<u16>, Residue)>>;

/// A polynomial modulo p: degree in the main generator, coefficient, exponents of the others.
struct Reduced(Vec<(usize, Residue, Vec<u16>)>);

impl Reduced {
    fn new(field: &PrimeField, p: &Polynomial, problem: &Problem<'_>) -> Reduced {
        let term = |(m, c): &(Monomial, IBig)| {
            let others = problem.others.iter().map(|&(g, _)| m.exponent(g)).collect();
            (
                usize::from(m.exponent(problem.main)),
                field.from_integer(c),
                others,
            )
        };
        Reduced(p.terms().iter().map(term).collect())
    }

    /// The polynomial in the main generator, with the others replaced by the powers in the table.
    fn evaluate(&self, field: &PrimeField, powers: &[Vec<Residue>]) -> Vec<Residue> {
        let degree = self.0.iter().map(|t| t.0).max().unwrap_or(0);
        let mut values = vec![Residue::ZERO; degree + 1];
        for (main, coefficient, exponents) in &self.0 {
            let mut value = *coefficient;
            for (table, &e) in powers.iter().zip(exponents) {
                if e > 0 {
                    value = field.mul(value, table[usize::from(e)]);
                }
            }
            values[*main] = field.add(values[*main], value);
        }
        values
    }
}

/// A problem modulo one prime.
struct Images<'a> {
    problem: &'a Problem<'a>,
    field: PrimeField,
    a: Reduced,
    b: Reduced,
    gamma: Reduced,
    /// The largest exponent of each of the other generators in a, b, γ.
    degrees: Vec<u16>,
}

impl<'a> Images<'a> {
    fn new(problem: &'a Problem<'a>, field: PrimeField) -> Images<'a> {
        let reduced = |p| Reduced::new(&field, p, problem);
        let (a, b, gamma) = (
            reduced(problem.a),
            reduced(problem.b),
            reduced(problem.gamma),
        );
        let highest = |i: usize| {
            let exponents = a.0.iter().chain(&b.0).chain(&gamma.0).map(|t| t.2[i]);
            exponents.max().unwrap_or(0)
        };
        let degrees = (0..problem.others.len()).map(highest).collect();
        Images {
            problem,
            field,
            a,
            b,
            gamma,
            degrees,
        }
    }

    /// The image of h at a point, ascending; `None` when the point is unlucky.
    fn at(&self, point: &[Residue], meter: &Meter) -> Result<Option<Vec<Residue>>, TooLarge> {
        meter.spend((self.a.0.len() + self.b.0.len() + self.gamma.0.len()) as u64)?;
        let powers: Vec<Vec<Residue>> = point
            .iter()
            .zip(&self.degrees)
            .map(|(&x, &d)| power_table(&self.field, x, d))
            .collect();
        let gamma = self.gamma.evaluate(&self.field, &powers)[0];
        if gamma.is_zero() {
            return Ok(None);
        }
        let a = self.a.evaluate(&self.field, &powers);
        let b = self.b.evaluate(&self.field, &powers);
        meter.spend(a.len() as u64 * b.len() as u64)?;
        let mut image = univariate::gcd(&self.field, a, b);
        for c in &mut image {
            *c = self.field.mul(*c, gamma);
        }
        Ok(Some(image))
    }

    /// h modulo p, by adding one generator after another to its univariate image.
    fn interpolate(
        &self,
        random: &mut Random,
        meter: &Meter,
    ) -> Result<Option<Skeleton>, TooLarge> {
        let n = self.problem.others.len();
        let alpha: Vec<Residue> = (0..n).map(|_| random_unit(&self.field, random)).collect();
        let Some(base) = self.at(&alpha, meter)? else {
            return Ok(None);
        };
        let constant = |&c: &Residue| {
            if c.is_zero() {
                vec![]
            } else {
                vec![(vec![0; n], c)]
            }
        };
        let mut skeleton: Skeleton = base.iter().map(constant).collect();
        for j in 0..n {
            match self.add_generator(j, &skeleton, &alpha, random, meter)? {
                Some(larger) => skeleton = larger,
                None => return Ok(None),
            }
        }
        Ok(Some(skeleton))
    }

    fn add_generator(
        &self,
        j: usize,
        skeleton: &Skeleton,
        alpha: &[Residue],
        random: &mut Random,
        meter: &Meter,
    ) -> Result<Option<Skeleton>, TooLarge> {
        let degree =
            self.problem.others[j].1 + self.problem.gamma.degree_in(self.problem.others[j].0);
        let mut xs = vec![alpha[j]];
        let mut columns = vec![skeleton.clone()];
        for _ in 0..degree {
            let mut fixed = alpha.to_vec();
            fixed[j] = random_unit(&self.field, random);
            xs.push(fixed[j]);
            match self.fill(skeleton, j, &fixed, random, meter)? {
                Some(values) => columns.push(values),
                None => return Ok(None),
            }
        }
        let mut larger: Skeleton = vec![Vec::new(); skeleton.len()];
        for (k, terms) in skeleton.iter().enumerate() {
            for (i, (exponents, _)) in terms.iter().enumerate() {
                let ys: Vec<Residue> = columns.iter().map(|c| c[k][i].1).collect();
                meter.spend(ys.len() as u64 * ys.len() as u64)?;
                let Some(values) = univariate::interpolate(&self.field, &xs, &ys) else {
                    return Ok(None);
                };
                for (e, &value) in values.iter().enumerate().filter(|(_, v)| !v.is_zero()) {
                    let mut exponents = exponents.clone();
                    exponents[j] = e as u16;
                    larger[k].push((exponents, value));
                }
            }
        }
        Ok(Some(larger))
    }

    /// The values of the skeleton's coefficients when the generators from `j` on are fixed.
    fn fill(
        &self,
        skeleton: &Skeleton,
        j: usize,
        fixed: &[Residue],
        random: &mut Random,
        meter: &Meter,
    ) -> Result<Option<Skeleton>, TooLarge> {
        let field = &self.field;
        let count = skeleton.iter().map(Vec::len).max().unwrap_or(0);
        let base: Vec<Residue> = (0..j).map(|_| random_unit(field, random)).collect();
        let mut point = fixed.to_vec();
        point[..j].fill(field.one());
        let mut images = Vec::with_capacity(count);
        for _ in 0..count {
            for (x, &step) in point[..j].iter_mut().zip(&base) {
                *x = field.mul(*x, step);
            }
            match self.at(&point, meter)? {
                Some(image) if image.len() == skeleton.len() => images.push(image),
                _ => return Ok(None),
            }
        }
        let mut filled = Vec::with_capacity(skeleton.len());
        for (k, terms) in skeleton.iter().enumerate() {
            if terms.is_empty() && images.iter().any(|image| !image[k].is_zero()) {
                return Ok(None);
            }
            let node = |(e, _): &(Vec<u16>, Residue)| {
                base.iter().zip(e).fold(field.one(), |v, (&x, &e)| {
                    field.mul(v, field.pow(x, u64::from(e)))
                })
            };
            let nodes: Vec<Residue> = terms.iter().map(node).collect();
            let values: Vec<Residue> = images[..terms.len()].iter().map(|image| image[k]).collect();
            meter.spend(nodes.len() as u64 * nodes.len() as u64)?;
            let solution = univariate::solve_transposed_vandermonde(field, &nodes, &values);
            let Some(solution) = solution else {
                return Ok(None);
            };
            filled.push(
                terms
                    .iter()
                    .zip(solution)
                    .map(|((e, _), v)| (e.clone(), v))
                    .collect(),
            );
        }
        Ok(Some(filled))
    }
}

fn power_table(field: &PrimeField, x: Residue, degree: u16) -> Vec<Residue> {
    let mut table = vec![field.one()];
    for i in 0..usize::from(degree) {
        table.push(field.mul(table[i], x));
    }
    table
}

/// Calls `accept` with candidates for h until it returns a polynomial; `None` when the attempts are used up.
///
/// # Errors
/// [`TooLarge`] from the budget, or from `accept`.
pub(super) fn search(
    problem: &Problem<'_>,
    meter: &Meter,
    mut accept: impl FnMut(&Polynomial) -> Result<Option<Polynomial>, TooLarge>,
) -> Result<Option<Polynomial>, TooLarge> {
    const ATTEMPTS: usize = 6;
    let mut random = Random::new(0x5eed);
    let mut fields = (0..).map_while(|k| meter.field(k));
    let bits = problem.a.coefficient_bits()
        + problem.b.coefficient_bits()
        + problem.gamma.coefficient_bits();
    for _ in 0..ATTEMPTS {
        let Some(field) = fields.next() else { break };
        let images = Images::new(problem, field);
        let Some(skeleton) = images.interpolate(&mut random, meter)? else {
            continue;
        };
        let mut lift = Lift::new(skeleton.clone(), &images.field);
        for _ in 0..2 + bits / 60 {
            if let Some(found) = accept(&lift.polynomial(problem))? {
                return Ok(Some(found));
            }
            let Some(field) = fields.next() else { break };
            let next = Images::new(problem, field);
            let zero = vec![Residue::ZERO; problem.others.len()];
            let Some(image) = next.fill(&skeleton, zero.len(), &zero, &mut random, meter)? else {
                break;
            };
            lift.combine(&image, &next.field);
        }
    }
    Ok(None)
}

/// The coefficients of h modulo a growing product of primes.
struct Lift {
    modulus: UBig,
    terms: Vec<(usize, Vec<u16>, UBig)>,
}

impl Lift {
    fn new(skeleton: Skeleton, field: &PrimeField) -> Lift {
        let flat = skeleton.into_iter().enumerate().flat_map(|(k, terms)| {
            let lifted = move |(e, v)| (k, e, UBig::from(field.to_u64(v)));
            terms.into_iter().map(lifted).collect::<Vec<_>>()
        });
        Lift {
            modulus: UBig::from(field.modulus()),
            terms: flat.collect(),
        }
    }

    /// Chinese remainders: the values that agree with the old ones and with the image modulo the new prime.
    fn combine(&mut self, image: &Skeleton, field: &PrimeField) {
        let modulus = IBig::from(self.modulus.clone());
        let inverse = univariate::inverse(field, field.from_integer(&modulus));
        for ((_, _, value), (_, residue)) in self.terms.iter_mut().zip(image.iter().flatten()) {
            let old = field.from_integer(&IBig::from(value.clone()));
            let step = field.mul(field.sub(*residue, old), inverse);
            *value += &self.modulus * UBig::from(field.to_u64(step));
        }
        self.modulus *= UBig::from(field.modulus());
    }

    /// The polynomial with coefficients of least absolute value.
    fn polynomial(&self, problem: &Problem<'_>) -> Polynomial {
        let len = problem
            .others
            .iter()
            .map(|o| o.0)
            .chain([problem.main])
            .max()
            .unwrap_or(0)
            + 1;
        let half = &self.modulus >> 1;
        let term = |(k, exponents, value): &(usize, Vec<u16>, UBig)| {
            let mut all = vec![0; len];
            all[problem.main] = *k as u16;
            for (&(g, _), &e) in problem.others.iter().zip(exponents) {
                all[g] = e;
            }
            let value = if *value > half {
                IBig::from_parts(Sign::Negative, &self.modulus - value)
            } else {
                IBig::from(value.clone())
            };
            (Monomial::from_exponents(&all), value)
        };
        Polynomial::from_terms(self.terms.iter().map(term).collect())
    }
}
