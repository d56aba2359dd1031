//! From classes modulo a prime to functions of the parameters.
//!
//! An entry c of a null vector is a rational function of the parameters, N/D. Its values where one parameter changes and the others
//! stay give the degrees of N and D in each; these leave few monomials, so that there may be many parameters. Its values at random
//! parameters modulo p give the linear equations `N - c D = 0` for the coefficients of N and D; the least degree at which they have a
//! solution gives the reduced fraction. Its coefficients are rational numbers, found from their classes. Nothing found here is
//! believed: the integral built of it is proved or dropped.

use crate::algebraic::combination;
use chetaev_symbolic::number::modular_matrix::null_space;
use chetaev_symbolic::number::prime_field::{PrimeField, Residue};
use chetaev_symbolic::number::reconstruct::rational;
use chetaev_symbolic::polynomial::{Budget, Meter, Monomial, Polynomial, RationalFunction};
use chetaev_symbolic::{Expr, Graph, Node, Rational};

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
pub struct Sample {
    /// The values of the parameters.
    pub parameters: Vec<Residue>,
    /// The entries.
    pub entries: Vec<Residue>,
}

/// Where samples come from.
pub trait Source {
    /// The prime field of all samples.
    fn field(&self) -> PrimeField;
    /// One more sample at random parameters.
    fn sample(&mut self) -> Option<Sample>;
    /// A sample that differs from the last one of [`sample`](Source::sample) in the parameter of this number only; `None` where that
    /// cannot be arranged.
    fn varied(&mut self, parameter: usize) -> Option<Sample>;
    /// Which parameters are no parameters, but roots of rational numbers, as √3, with the number of their different powers.
    fn roots(&self) -> Vec<(usize, u32)> {
        Vec::new()
    }
}

/// The roots of rational numbers among the parameters, with the number of different powers of each.
pub fn roots_of_numbers(g: &Graph, parameters: &[Expr]) -> Vec<(usize, u32)> {
    let powers = |e: Expr| match g.node(e) {
        Node::Power { base, exponent } if g.as_number(*base).is_some() => {
            u32::try_from(g.as_number(*exponent)?.denominator().clone()).ok()
        }
        _ => None,
    };
    let own = parameters.iter().enumerate();
    own.filter_map(|(p, &e)| Some((p, powers(e)?))).collect()
}

/// One more sample in which the roots of numbers have the same values as in the first one.
fn alike(source: &mut dyn Source, first: &Sample, roots: &[Vec<u32>]) -> Option<Sample> {
    const TRIALS: usize = 40;
    let occurs = |p: usize| roots.iter().any(|r| r.get(p).is_some_and(|&e| e > 0));
    let is_alike = |s: &Sample| {
        let mut own = (0..s.parameters.len()).filter(|&p| occurs(p));
        own.all(|p| s.parameters[p] == first.parameters[p])
    };
    (0..TRIALS).find_map(|_| source.sample().filter(is_alike))
}

/// Exponents of the products of powers of the roots of numbers, 1 first.
fn products_of_roots(roots: &[(usize, u32)], parameters: usize) -> Vec<Vec<u32>> {
    let mut products = vec![vec![0; parameters]];
    for &(p, powers) in roots {
        let before = products.clone();
        for e in 1..powers {
            products.extend(before.iter().cloned().map(|mut exponents| {
                exponents[p] = e;
                exponents
            }));
        }
    }
    products
}

/// The entries as functions of the parameters; `None` when some entry is none of moderate degree.
pub fn entries(source: &mut dyn Source, count: usize) -> Option<Vec<RationalFunction>> {
    let meter = Meter::new(BUDGET);
    let field = source.field();
    let first = source.sample()?;
    let parameters = 0..first.parameters.len();
    let numbers = source.roots();
    let roots = products_of_roots(&numbers, first.parameters.len());
    let lines: Vec<Vec<Degrees>> = parameters
        .clone()
        .map(|p| match numbers.iter().any(|&(root, _)| root == p) {
            true => vec![Degrees::Are(0, 0); count],
            false => line(source, &first, p),
        })
        .collect();
    let mut samples = vec![first];
    (0..count)
        .map(|entry| {
            let used = parameters.clone().filter(|&p| !lines[p][entry].is_zero());
            let used: Vec<usize> = used.collect();
            let degrees = used.iter().map(|&p| lines[p][entry]).collect();
            let fit = Fit {
                field,
                entry,
                used,
                degrees,
                roots: &roots,
            };
            fit.least(source, &mut samples, &meter).or_else(|| {
                // Where letters are related, as r² (1 + a²) = 1, degrees along a line may not be those of the fraction.
                let is_bounded = fit.degrees.iter().any(|&d| d != Degrees::Any);
                let any = fit.of_any_degrees();
                is_bounded.then(|| any.least(source, &mut samples, &meter))?
            })
        })
        .collect()
}

/// The degrees of the numerator and the denominator of a fraction in one parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Degrees {
    /// These.
    Are(u32, u32),
    /// Not known.
    Any,
}

impl Degrees {
    /// Whether the parameter does not occur.
    fn is_zero(self) -> bool {
        self == Degrees::Are(0, 0)
    }

    /// The degree in the numerator, or in the denominator; at most a total degree.
    fn most(self, is_above: bool, total: u32) -> u32 {
        match self {
            Degrees::Are(above, below) => (if is_above { above } else { below }).min(total),
            Degrees::Any => total,
        }
    }
}

/// The degrees of each entry in one parameter, from the values where that one changes.
fn line(source: &mut dyn Source, first: &Sample, parameter: usize) -> Vec<Degrees> {
    let field = source.field();
    let mut samples = vec![first.clone()];
    let mut found = vec![Degrees::Any; first.entries.len()];
    for degree in 0..=DEGREE {
        let wanted = if degree == 0 {
            2
        } else {
            2 * degree as usize + 3
        };
        while samples.len() < wanted {
            match source.varied(parameter) {
                Some(sample) => samples.push(sample),
                None => return found,
            }
        }
        for (entry, degrees) in found.iter_mut().enumerate() {
            if *degrees == Degrees::Any {
                *degrees = along(&field, &samples, (parameter, entry), degree);
            }
        }
        if !found.contains(&Degrees::Any) {
            break;
        }
    }
    found
}

/// The degrees of an entry as a fraction of degree up to `degree` in one parameter, which is the least possible one.
fn along(
    field: &PrimeField,
    samples: &[Sample],
    (parameter, entry): (usize, usize),
    degree: u32,
) -> Degrees {
    let value = |s: &Sample| s.entries[entry];
    if degree == 0 {
        let is_same = samples.iter().all(|s| value(s) == value(&samples[0]));
        return if is_same {
            Degrees::Are(0, 0)
        } else {
            Degrees::Any
        };
    }
    let size = degree as usize + 1;
    let rows = samples.iter().flat_map(|s| {
        let powers = (0..=degree).map(|e| field.pow(s.parameters[parameter], u64::from(e)));
        let powers: Vec<Residue> = powers.collect();
        let negative = field.neg(value(s));
        let below = powers.iter().map(|&x| field.mul(negative, x));
        below.chain(powers.clone()).collect::<Vec<Residue>>()
    });
    let space = null_space(field, 2 * size, rows.collect());
    let Some((free, rest)) = space.vectors.first() else {
        return Degrees::Any;
    };
    let places = rest.iter().filter(|(_, c)| !c.is_zero());
    let places: Vec<usize> = places.map(|&(i, _)| i).chain([*free]).collect();
    let most = |of: &dyn Fn(usize) -> Option<usize>| {
        let degrees = places.iter().filter_map(|&i| of(i));
        degrees.max().unwrap_or(0) as u32
    };
    let above = most(&|i| i.checked_sub(size));
    let below = most(&|i| (i < size).then_some(i));
    Degrees::Are(above, below)
}

/// The monomials that a numerator and a denominator may contain.
struct Monomials {
    below: Vec<Vec<u32>>,
    above: Vec<Vec<u32>>,
}

impl Monomials {
    fn count(&self) -> usize {
        self.below.len() + self.above.len()
    }
}

struct Fit<'r> {
    field: PrimeField,
    entry: usize,
    used: Vec<usize>,
    /// In each parameter used.
    degrees: Vec<Degrees>,
    /// Exponents of the products of powers of the roots of numbers of which coefficients are combinations; 1 alone where there are none.
    roots: &'r [Vec<u32>],
}

impl Fit<'_> {
    fn of_any_degrees(&self) -> Fit<'_> {
        Fit {
            used: self.used.clone(),
            degrees: vec![Degrees::Any; self.used.len()],
            ..*self
        }
    }

    /// The fraction, of least degree.
    fn least(
        &self,
        source: &mut dyn Source,
        samples: &mut Vec<Sample>,
        meter: &Meter,
    ) -> Option<RationalFunction> {
        let most = |is_above: bool| {
            let own = self.degrees.iter();
            own.map(|d| d.most(is_above, DEGREE)).sum::<u32>()
        };
        let last = match self.degrees.contains(&Degrees::Any) {
            true => DEGREE.min(most(true).max(most(false))),
            false => most(true).max(most(false)),
        };
        for degree in 0..=last {
            let monomials = self.monomials(degree);
            if monomials.count() > UNKNOWNS {
                return None;
            }
            let found = self.of_degree(&monomials, source, samples, meter);
            if found.is_some() {
                return found;
            }
        }
        None
    }

    fn monomials(&self, degree: u32) -> Monomials {
        let of = |is_above| {
            let most = self.degrees.iter().map(|d| d.most(is_above, degree));
            exponents(&most.collect::<Vec<u32>>(), degree)
        };
        Monomials {
            below: of(false),
            above: of(true),
        }
    }

    fn of_degree(
        &self,
        monomials: &Monomials,
        source: &mut dyn Source,
        samples: &mut Vec<Sample>,
        meter: &Meter,
    ) -> Option<RationalFunction> {
        let unknowns = monomials.count();
        while samples.len() < unknowns + 3 {
            let next = alike(source, &samples[0], self.roots)?;
            samples.push(next);
        }
        let rows = samples[..unknowns + 3].iter();
        let matrix: Vec<Residue> = rows.flat_map(|s| self.row(monomials, s)).collect();
        let space = null_space(&self.field, unknowns, matrix);
        let values = self.values(&monomials.below, &samples[0]);
        space.vectors.iter().find_map(|(free, rest)| {
            let mut coefficients = vec![Residue::ZERO; unknowns];
            coefficients[*free] = self.field.one();
            rest.iter().for_each(|&(i, c)| coefficients[i] = c);
            let (below, above) = coefficients.split_at(monomials.below.len());
            // Where letters are related, as r² (1 + a²) = 1, a denominator of them may vanish without being zero.
            let terms = below.iter().zip(&values);
            let denominator = terms.fold(Residue::ZERO, |sum, (&c, &value)| {
                self.field.add(sum, self.field.mul(c, value))
            });
            match denominator.is_zero() {
                true => None,
                false => self.fraction(monomials, (above, below), &samples[0], meter),
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
    fn row(&self, monomials: &Monomials, sample: &Sample) -> Vec<Residue> {
        let field = &self.field;
        let negative = field.neg(sample.entries[self.entry]);
        let below = self.values(&monomials.below, sample);
        let below = below.into_iter().map(|v| field.mul(negative, v));
        below.chain(self.values(&monomials.above, sample)).collect()
    }

    fn fraction(
        &self,
        monomials: &Monomials,
        (above, below): (&[Residue], &[Residue]),
        sample: &Sample,
        meter: &Meter,
    ) -> Option<RationalFunction> {
        let numerator = self.polynomial(&monomials.above, above, sample, meter)?;
        let denominator = self.polynomial(&monomials.below, below, sample, meter)?;
        numerator.div(&denominator, meter).ok()?
    }

    fn polynomial(
        &self,
        monomials: &[Vec<u32>],
        coefficients: &[Residue],
        sample: &Sample,
        meter: &Meter,
    ) -> Option<RationalFunction> {
        let mut sum = RationalFunction::zero();
        for (exponents, &class) in monomials.iter().zip(coefficients) {
            if class.is_zero() {
                continue;
            }
            let mut powers = vec![0; sample.parameters.len()];
            for (&p, &e) in self.used.iter().zip(exponents) {
                powers[p] = e;
            }
            for (number, root) in self.number(class, sample)? {
                let both = powers.iter().zip(root).map(|(a, b)| u16::try_from(a + b));
                let both: Vec<u16> = both.collect::<Result<_, _>>().ok()?;
                let monomial = Polynomial::term(Monomial::from_exponents(&both), 1.into());
                let term = RationalFunction::constant(&number);
                let term = term.mul(&RationalFunction::from(monomial), meter).ok()?;
                sum = sum.add(&term, meter).ok()?;
            }
        }
        Some(sum)
    }

    /// A number from its class: rational coefficients of products of roots of numbers.
    fn number(&self, class: Residue, sample: &Sample) -> Option<Vec<(Rational, &[u32])>> {
        let [_, _, ..] = self.roots else {
            let number = rational(&self.field, class)?;
            return Some(vec![(number, self.roots.first()?)]);
        };
        let field = &self.field;
        let value = |exponents: &Vec<u32>| {
            let powers = exponents.iter().zip(&sample.parameters);
            powers.fold(field.one(), |product, (&e, &x)| {
                field.mul(product, field.pow(x, u64::from(e)))
            })
        };
        let values: Vec<Residue> = self.roots.iter().map(value).collect();
        let found = combination(field, class, &values)?.into_iter();
        let pairs = found.zip(self.roots.iter().map(Vec::as_slice));
        Some(pairs.filter(|(number, _)| !number.is_zero()).collect())
    }
}

/// Exponents of the monomials up to a degree, with at most these in each letter.
fn exponents(most: &[u32], degree: u32) -> Vec<Vec<u32>> {
    let mut found = vec![Vec::new()];
    for &most in most {
        found = found
            .into_iter()
            .flat_map(|start: Vec<u32>| {
                let left = degree - start.iter().sum::<u32>();
                (0..=left.min(most)).map(move |e| {
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
pub fn cleared(entries: &[RationalFunction]) -> Option<Vec<Polynomial>> {
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
pub fn expression(g: &Graph, polynomial: &Polynomial, letters: &[Expr]) -> Expr {
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

#[cfg(test)]
mod tests {
    use super::*;
    use chetaev_symbolic::number::random::Random;

    /// Samples of given functions of the parameters.
    struct Functions {
        field: PrimeField,
        random: Random,
        last: Vec<Residue>,
        all: fn(&PrimeField, &[Residue]) -> Vec<Residue>,
        taken: usize,
    }

    impl Functions {
        fn at(&mut self, parameters: Vec<Residue>) -> Option<Sample> {
            self.taken += 1;
            Some(Sample {
                entries: (self.all)(&self.field, &parameters),
                parameters,
            })
        }
    }

    impl Source for Functions {
        fn field(&self) -> PrimeField {
            self.field
        }

        fn sample(&mut self) -> Option<Sample> {
            let count = self.last.len();
            self.last = (0..count)
                .map(|_| self.field.random(&mut self.random))
                .collect();
            self.at(self.last.clone())
        }

        fn varied(&mut self, parameter: usize) -> Option<Sample> {
            let mut parameters = self.last.clone();
            parameters[parameter] = self.field.random(&mut self.random);
            self.at(parameters)
        }
    }

    fn lifted(
        parameters: usize,
        all: fn(&PrimeField, &[Residue]) -> Vec<Residue>,
    ) -> (Vec<RationalFunction>, usize) {
        let field = PrimeField::new((1 << 61) - 1).expect("a prime");
        let mut source = Functions {
            field,
            random: Random::new(7),
            last: vec![Residue::ZERO; parameters],
            all,
            taken: 0,
        };
        let count = (source.all)(&field, &vec![field.one(); parameters]).len();
        let found = entries(&mut source, count).expect("fractions of moderate degree");
        (found, source.taken)
    }

    /// The coefficient of the time for a ball on an incline, `m r² g s/(I + m r²)`, of degrees 5 and 3 in five parameters: 462 monomials
    /// of this degree and less would be too many.
    #[test]
    fn many_parameters() {
        let (found, taken) = lifted(5, |field, p| {
            let [m, r, g, s, i] = p else {
                return Vec::new();
            };
            let inertia = field.mul(*m, field.mul(*r, *r));
            let above = field.mul(inertia, field.mul(*g, *s));
            let below = field.inv(field.add(*i, inertia));
            vec![field.mul(above, below.unwrap_or(Residue::ZERO)), *s]
        });
        let meter = Meter::new(BUDGET);
        let term = |exponents: &[u16]| {
            let monomial = Monomial::from_exponents(exponents);
            RationalFunction::from(Polynomial::term(monomial, 1.into()))
        };
        let inertia = term(&[1, 2]);
        let below = term(&[0, 0, 0, 0, 1]).add(&inertia, &meter).expect("a sum");
        let above = term(&[1, 2, 1, 1]);
        let wanted = above.div(&below, &meter).expect("small");
        assert_eq!(Some(&found[0]), wanted.as_ref());
        assert_eq!(found[1], term(&[0, 0, 0, 1]));
        assert!(taken < 100, "{taken} samples");
    }

    /// `(a + b)⁵/(a - 2 b)` and a number.
    #[test]
    fn powers_and_numbers() {
        let (found, _) = lifted(2, |field, p| {
            let [a, b] = p else { return Vec::new() };
            let below = field.sub(*a, field.add(*b, *b));
            let below = field.inv(below).unwrap_or(Residue::ZERO);
            let above = field.pow(field.add(*a, *b), 5);
            let seven = field.from_i64(7);
            vec![field.mul(above, below), seven]
        });
        assert_eq!(found[0].numerator().terms().len(), 6);
        assert_eq!(found[0].denominator().terms().len(), 2);
        assert_eq!(found[1], RationalFunction::constant(&7.into()));
    }
}
