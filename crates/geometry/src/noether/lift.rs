//! From classes modulo a prime to functions of the parameters.
//!
//! An entry c of a null vector is a rational function of the parameters, N/D. Its values at random parameters modulo p give the
//! linear equations `N - c D = 0` for the coefficients of N and D; the least degree at which they have a solution
//! gives the reduced fraction. Its coefficients are rational numbers, found from their classes. Nothing found here is believed:
//! the integral built of it is proved or dropped.

use chetaev_symbolic::number::modular_matrix::null_space;
use chetaev_symbolic::number::prime_field::{PrimeField, Residue};
use chetaev_symbolic::number::reconstruct::rational;
use chetaev_symbolic::polynomial::{Budget, Meter, Monomial, Polynomial, RationalFunction};
use chetaev_symbolic::{Expr, Graph, Rational};

/// The most unknowns of one fit.
const UNKNOWNS: usize = 420;

/// The highest degree tried.
const DEGREE: u32 = 12;

/// Room for the arithmetic of coefficients.
const BUDGET: Budget = Budget {
    terms: 2_000,
    degree: 80,
    bits: 4_000,
    work: 20_000_000,
};

/// A null vector at one choice of parameters.
#[derive(Clone, Debug)]
pub(super) struct Sample {
    /// The values of the parameters.
    pub(super) parameters: Vec<Residue>,
    /// The entries.
    pub(super) entries: Vec<Residue>,
}

/// Where samples come from.
pub(super) trait Source {
    /// The prime field of all samples.
    fn field(&self) -> PrimeField;
    /// One more sample at random parameters.
    fn sample(&mut self) -> Option<Sample>;
    /// A sample that differs from the first in the parameter of this number only; `None` where that cannot be arranged.
    fn varied(&mut self, parameter: usize) -> Option<Sample>;
}

/// The entries as functions of the parameters; `None` when some entry is none of moderate degree.
pub(super) fn entries(source: &mut dyn Source, count: usize) -> Option<Vec<RationalFunction>> {
    let meter = Meter::new(BUDGET);
    let field = source.field();
    let mut samples = vec![source.sample()?];
    let parameters = samples[0].parameters.len();
    let varied: Vec<Option<Sample>> = (0..parameters).map(|p| source.varied(p)).collect();
    (0..count)
        .map(|entry| {
            let used: Vec<usize> = (0..parameters)
                .filter(|&p| match &varied[p] {
                    Some(sample) => sample.entries[entry] != samples[0].entries[entry],
                    None => true,
                })
                .collect();
            let fit = Fit { field, entry, used };
            (0..=DEGREE).find_map(|degree| fit.of_degree(degree, source, &mut samples, &meter))
        })
        .collect()
}

struct Fit {
    field: PrimeField,
    entry: usize,
    used: Vec<usize>,
}

impl Fit {
    fn of_degree(
        &self,
        degree: u32,
        source: &mut dyn Source,
        samples: &mut Vec<Sample>,
        meter: &Meter,
    ) -> Option<RationalFunction> {
        let monomials = exponents(self.used.len(), degree);
        let unknowns = 2 * monomials.len();
        if unknowns > UNKNOWNS || (degree > 0 && self.used.is_empty()) {
            return None;
        }
        while samples.len() < unknowns + 3 {
            samples.push(source.sample()?);
        }
        let rows = samples[..unknowns + 3].iter();
        let matrix: Vec<Residue> = rows.flat_map(|s| self.row(&monomials, s)).collect();
        let space = null_space(&self.field, unknowns, matrix);
        let values = self.values(&monomials, &samples[0]);
        space.vectors.iter().find_map(|(free, rest)| {
            let mut coefficients = vec![Residue::ZERO; unknowns];
            coefficients[*free] = self.field.one();
            rest.iter().for_each(|&(i, c)| coefficients[i] = c);
            let (below, above) = coefficients.split_at(monomials.len());
            // Where letters are related, as r² (1 + a²) = 1, a denominator of them may vanish without being zero.
            let terms = below.iter().zip(&values);
            let denominator = terms.fold(Residue::ZERO, |sum, (&c, &value)| {
                self.field.add(sum, self.field.mul(c, value))
            });
            match denominator.is_zero() {
                true => None,
                false => self.fraction(&monomials, above, below, meter),
            }
        })
    }

    fn values(&self, monomials: &[Vec<u32>], sample: &Sample) -> Vec<Residue> {
        let field = &self.field;
        let value = |exponents: &Vec<u32>| {
            let powers = self.used.iter().zip(exponents);
            powers.fold(field.one(), |product, (&p, &e)| {
                field.mul(product, field.pow(sample.parameters[p], u64::from(e)))
            })
        };
        monomials.iter().map(value).collect()
    }

    /// `-c` times the monomials of D, then those of N.
    fn row(&self, monomials: &[Vec<u32>], sample: &Sample) -> Vec<Residue> {
        let field = &self.field;
        let values = self.values(monomials, sample);
        let negative = field.neg(sample.entries[self.entry]);
        let below = values.iter().map(|&v| field.mul(negative, v));
        below.chain(values.iter().copied()).collect()
    }

    fn fraction(
        &self,
        monomials: &[Vec<u32>],
        above: &[Residue],
        below: &[Residue],
        meter: &Meter,
    ) -> Option<RationalFunction> {
        let numerator = self.polynomial(monomials, above, meter)?;
        let denominator = self.polynomial(monomials, below, meter)?;
        numerator.div(&denominator, meter).ok()?
    }

    fn polynomial(
        &self,
        monomials: &[Vec<u32>],
        coefficients: &[Residue],
        meter: &Meter,
    ) -> Option<RationalFunction> {
        let mut sum = RationalFunction::zero();
        for (exponents, &class) in monomials.iter().zip(coefficients) {
            if class.is_zero() {
                continue;
            }
            let number: Rational = rational(&self.field, class)?;
            let mut powers = vec![0_u16; self.used.iter().max().map_or(0, |&p| p + 1)];
            for (&p, &e) in self.used.iter().zip(exponents) {
                powers[p] = u16::try_from(e).ok()?;
            }
            let monomial = Polynomial::term(Monomial::from_exponents(&powers), 1.into());
            let term = RationalFunction::constant(&number);
            let term = term.mul(&RationalFunction::from(monomial), meter).ok()?;
            sum = sum.add(&term, meter).ok()?;
        }
        Some(sum)
    }
}

/// Exponents of the monomials up to a degree in so many letters.
fn exponents(letters: usize, degree: u32) -> Vec<Vec<u32>> {
    let mut found = vec![Vec::new()];
    for _ in 0..letters {
        found = found
            .into_iter()
            .flat_map(|start: Vec<u32>| {
                let left = degree - start.iter().sum::<u32>();
                (0..=left).map(move |e| {
                    let mut next = start.clone();
                    next.push(e);
                    next
                })
            })
            .collect();
    }
    found
}

/// The entries, a one in front, as polynomials without common factor.
pub(super) fn cleared(entries: &[RationalFunction]) -> Option<Vec<Polynomial>> {
    let meter = Meter::new(BUDGET);
    let mut common = Polynomial::one();
    for entry in entries {
        common = common.lcm(entry.denominator(), &meter).ok()?;
    }
    let mut all = vec![common.clone()];
    for entry in entries {
        let factor = common.exact_quotient(entry.denominator(), &meter).ok()??;
        all.push(entry.numerator().mul(&factor, &meter).ok()?);
    }
    let mut content = Polynomial::zero();
    for polynomial in &all {
        content = content.gcd(polynomial, &meter).ok()?;
    }
    let divide = |p: &Polynomial| p.exact_quotient(&content, &meter).ok().flatten();
    all.iter().map(divide).collect()
}

/// A polynomial in these letters as an expression.
pub(super) fn expression(g: &Graph, polynomial: &Polynomial, letters: &[Expr]) -> Expr {
    let terms: Vec<Expr> = polynomial
        .terms()
        .iter()
        .map(|(monomial, coefficient)| {
            let mut factors = vec![g.number(Rational::from(coefficient.clone()))];
            factors.extend(
                monomial
                    .iter()
                    .map(|(letter, exponent)| g.powi(letters[letter], i64::from(exponent))),
            );
            g.mul(&factors)
        })
        .collect();
    g.add(&terms)
}
