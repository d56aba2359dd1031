//! A polynomial field modulo a prime with constants at random values, and power series of its orbits.

use crate::polynomial_field::{PolynomialField, Tie};
use chetaev_symbolic::number::prime::random_prime;
use chetaev_symbolic::number::prime_field::{PrimeField, Residue};
use chetaev_symbolic::number::random::Random;
use chetaev_symbolic::polynomial::Polynomial;
use chetaev_symbolic::Expr;
use rustc_hash::FxHashMap;

/// A prime, and values of all constants.
#[derive(Clone, Debug)]
pub(crate) struct Specialization {
    pub(crate) field: PrimeField,
    /// By letter; zero for letters that move.
    pub(crate) constants: Vec<Residue>,
}

/// How often values are drawn until all roots of constants exist.
const TRIALS: usize = 60;

/// How many numbers are tried until one is prime.
const ATTEMPTS: u32 = 4_000;

impl Specialization {
    /// A random prime field.
    pub(crate) fn field(random: &mut Random) -> Option<PrimeField> {
        // Modulo these primes −1, 2 and 3 are squares, so that the simplest conjugate factors are found apart.
        PrimeField::new(random_prime(random, 24, ATTEMPTS, |_| true)?)
    }

    /// The constants that have `known` values with these, the others at random; `None` where a root of constants does not exist.
    pub(crate) fn extended(
        own: &PolynomialField,
        field: PrimeField,
        known: &mut FxHashMap<Expr, Residue>,
        random: &mut Random,
    ) -> Option<Specialization> {
        let mut constants = vec![Residue::ZERO; own.letters.len()];
        for i in own.constants() {
            match known.get(&own.letters[i].value) {
                Some(&value) => constants[i] = value,
                None => fill(own, &field, &mut constants, i, random)?,
            }
        }
        for i in own.constants() {
            known.insert(own.letters[i].value, constants[i]);
        }
        Some(Specialization { field, constants })
    }
}

/// Gives the letter of this number a value that its relation allows; `None` where there is none.
fn fill(
    own: &PolynomialField,
    field: &PrimeField,
    values: &mut [Residue],
    i: usize,
    random: &mut Random,
) -> Option<()> {
    match &own.letters[i].tie {
        Tie::Free => values[i] = field.random(random),
        Tie::Root(square) => values[i] = field.sqrt(value(field, square, values))?,
        Tie::Circle {
            partner,
            is_sine,
            circular,
        } => {
            let tau = field.random(random);
            let square = field.mul(tau, tau);
            let square = if *circular { square } else { field.neg(square) };
            let below = field.inv(field.add(field.one(), square))?;
            let cosine = field.mul(field.sub(field.one(), square), below);
            let sine = field.mul(field.add(tau, tau), below);
            let both = if *is_sine {
                (sine, cosine)
            } else {
                (cosine, sine)
            };
            (values[i], values[*partner]) = both;
        }
    }
    Some(())
}

/// The value of a polynomial in the letters.
pub(crate) fn value(field: &PrimeField, polynomial: &Polynomial, values: &[Residue]) -> Residue {
    let terms = polynomial.terms().iter();
    terms.fold(Residue::ZERO, |sum, (monomial, c)| {
        let start = field.from_integer(c);
        let term = monomial.iter().fold(start, |product, (letter, e)| {
            field.mul(product, field.pow(values[letter], u64::from(e)))
        });
        field.add(sum, term)
    })
}

/// A product of powers of moving letters, as exponents by place in [`Orbits::letters`].
pub(crate) type Exponents = Vec<u8>;

/// The field at one specialization: rates as combinations of monomials, each of which is another one times a letter.
#[derive(Clone, Debug)]
pub(crate) struct Orbits<'f> {
    own: &'f PolynomialField,
    pub(crate) at: Specialization,
    /// The moving letters, by their numbers in the field.
    pub(crate) letters: Vec<usize>,
    /// Monomial 0 is 1; each other is `monomials[parent] · letter`.
    monomials: Vec<(usize, usize)>,
    index: FxHashMap<Exponents, usize>,
    rates: Vec<Vec<(usize, Residue)>>,
}

impl<'f> Orbits<'f> {
    pub(crate) fn new(own: &'f PolynomialField, at: Specialization) -> Orbits<'f> {
        let letters = own.moving();
        let mut orbits = Orbits {
            own,
            index: FxHashMap::default(),
            monomials: vec![(0, 0)],
            rates: Vec::new(),
            letters,
            at,
        };
        orbits.index.insert(vec![0; orbits.letters.len()], 0);
        for i in orbits.letters.clone() {
            let rate = orbits.specialized(&own.rates[i]);
            orbits.rates.push(rate);
        }
        orbits
    }

    /// A polynomial as a combination of monomials.
    fn specialized(&mut self, polynomial: &Polynomial) -> Vec<(usize, Residue)> {
        let field = self.at.field;
        let mut terms: FxHashMap<usize, Residue> = FxHashMap::default();
        for (monomial, c) in polynomial.terms() {
            let mut coefficient = field.from_integer(c);
            let mut exponents = vec![0; self.letters.len()];
            for (letter, e) in monomial.iter() {
                match self.letters.iter().position(|&l| l == letter) {
                    Some(place) => exponents[place] = u8::try_from(e).unwrap_or(u8::MAX),
                    None => {
                        let power = field.pow(self.at.constants[letter], u64::from(e));
                        coefficient = field.mul(coefficient, power);
                    }
                }
            }
            let place = self.monomial(&exponents);
            let sum = terms.entry(place).or_insert(Residue::ZERO);
            *sum = field.add(*sum, coefficient);
        }
        let mut terms: Vec<(usize, Residue)> = terms.into_iter().collect();
        terms.sort_unstable_by_key(|&(place, _)| place);
        terms
    }

    /// The number of a monomial, which is added with what it is a product of.
    pub(crate) fn monomial(&mut self, exponents: &Exponents) -> usize {
        if let Some(&place) = self.index.get(exponents) {
            return place;
        }
        let letter = exponents.iter().position(|&e| e > 0).unwrap_or(0);
        let mut less = exponents.clone();
        less[letter] = less[letter].saturating_sub(1);
        let parent = self.monomial(&less);
        self.monomials.push((parent, letter));
        self.index
            .insert(exponents.clone(), self.monomials.len() - 1);
        self.monomials.len() - 1
    }

    /// How many monomials there are.
    pub(crate) fn count(&self) -> usize {
        self.monomials.len()
    }

    /// Values of the moving letters at a random point; `None` where a root was found at none.
    pub(crate) fn point(&self, random: &mut Random) -> Option<Vec<Residue>> {
        (0..TRIALS).find_map(|_| {
            let mut values = self.at.constants.clone();
            for &i in &self.letters {
                fill(self.own, &self.at.field, &mut values, i, random)?;
            }
            Some(self.letters.iter().map(|&i| values[i]).collect())
        })
    }

    /// The places of letters that may take any value whatever the others have.
    pub(crate) fn free(&self) -> Vec<usize> {
        let is_under_root = |i: usize| {
            self.own.letters.iter().any(|letter| match &letter.tie {
                Tie::Root(square) => square.degree_in(i) > 0,
                _ => false,
            })
        };
        let places = 0..self.letters.len();
        places
            .filter(|&place| {
                let i = self.letters[place];
                self.own.letters[i].tie == Tie::Free && !is_under_root(i)
            })
            .collect()
    }

    /// The highest degree of the rates in some letters, 1 at least.
    pub(crate) fn degree_in(&self, places: &[usize]) -> usize {
        let degree = |exponents: &Exponents| -> usize {
            places
                .iter()
                .map(|&place| usize::from(exponents[place]))
                .sum()
        };
        let mut highest = 1;
        for (exponents, place) in sorted(&self.index) {
            let occurs = self.rates.iter().flatten().any(|(own, _)| *own == place);
            if occurs {
                highest = highest.max(degree(exponents));
            }
        }
        highest
    }

    /// The coefficients below order `order` of the first `count` monomials along the orbit through a point: coefficient k is `(D X)^k m / k!`.
    pub(crate) fn series(
        &self,
        point: &[Residue],
        order: usize,
        count: usize,
    ) -> Vec<Vec<Residue>> {
        let field = &self.at.field;
        let mut all = vec![vec![Residue::ZERO; order]; count];
        let mut letters = vec![vec![Residue::ZERO; order]; point.len()];
        for (own, &x) in letters.iter_mut().zip(point) {
            own[0] = x;
        }
        all[0][0] = field.one();
        for k in 0..order {
            for (place, &(parent, letter)) in self.monomials[..count].iter().enumerate().skip(1) {
                let (own, x) = (&all[parent], &letters[letter]);
                let sum = (0..=k).fold(Residue::ZERO, |sum, j| {
                    field.add(sum, field.mul(own[j], x[k - j]))
                });
                all[place][k] = sum;
            }
            let Some(over) = field.inv(field.from_u64(k as u64 + 1)) else {
                break;
            };
            if k + 1 < order {
                for (own, rate) in letters.iter_mut().zip(&self.rates) {
                    let sum = rate.iter().fold(Residue::ZERO, |sum, &(place, c)| {
                        field.add(sum, field.mul(c, all[place][k]))
                    });
                    own[k + 1] = field.mul(sum, over);
                }
            }
        }
        all
    }
}

fn sorted(index: &FxHashMap<Exponents, usize>) -> Vec<(&Exponents, usize)> {
    let mut all: Vec<(&Exponents, usize)> = index.iter().map(|(e, &place)| (e, place)).collect();
    all.sort_unstable_by_key(|&(_, place)| place);
    all
}
