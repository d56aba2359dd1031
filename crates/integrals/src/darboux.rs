//! Darboux pairs of a flow: polynomials P in the functions that occur with `X P = K P`, from small families to larger ones.
//!
//! They are found modulo a prime at random constants (`extactic`). Coefficients that are rational functions of the
//! constants are found from their values elsewhere (`continuation`); two polynomials whose coefficients are conjugate,
//! `A ± √Δ B`, are found as a pair. Nothing found here is believed: whoever uses a pair proves what it is for.

use crate::continuation::{reciprocal, times, value_at_one, Continuation, Series};
use crate::extactic::{Extactic, Pair, Polynomial};
use crate::flow::Flow;
use crate::lift::{cleared, entries, expression, Sample, Source};
use crate::orbit::{Exponents, Orbits, Specialization};
use crate::polynomial_field::PolynomialField;
use chetaev_symbolic::number::prime_field::{PrimeField, Residue};
use chetaev_symbolic::number::random::Random;
use chetaev_symbolic::polynomial::{Budget, Meter, RationalFunction};
use chetaev_symbolic::{Expr, Graph};
use rustc_hash::FxHashMap;

/// How large the search is.
#[derive(Clone, Copy, Debug)]
pub struct Work {
    /// Counted products of residues, for all parts of the variables together: some 10⁸ take a second.
    pub products: u64,
    /// The highest degree in the letters.
    pub degree: u32,
}

impl Default for Work {
    fn default() -> Work {
        Work {
            products: 60_000_000,
            degree: 6,
        }
    }
}

/// A polynomial with a cofactor.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Darboux {
    /// A polynomial whose coefficients are rational functions of the constants.
    One(Expr),
    /// Two, `A + √Δ B` and `A - √Δ B`.
    Conjugate {
        /// A.
        first: Expr,
        /// B.
        second: Expr,
        /// Δ, a constant that is not seen to be a square.
        square: Expr,
    },
}

/// A family that was searched.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Family {
    /// The letters.
    pub letters: Vec<Expr>,
    /// The degree of the polynomials in them.
    pub degree: u32,
    /// Whether all zeros of the extactic polynomial that were seen are explained by what was found.
    pub exhausted: bool,
}

/// What was found.
#[derive(Clone, Debug, Default)]
pub struct Pairs {
    /// The polynomials, simple ones first.
    pub found: Vec<Darboux>,
    /// Polynomials with cofactor zero: first integrals.
    pub integrals: Vec<Expr>,
    /// The families, in the order in which they were searched.
    pub families: Vec<Family>,
    /// How many were seen whose coefficients were not found.
    pub open: usize,
}

/// The Darboux pairs of a flow, part by closed part, degree by degree, until the work is done.
#[must_use]
pub fn pairs(flow: &Flow<'_>, work: Work, seed: u64) -> Pairs {
    let mut all = Pairs::default();
    let mut random = Random::stream(seed, 0x64_61_72);
    let Some(field) = Specialization::field(&mut random) else {
        return all;
    };
    let mut known = Known {
        field,
        constants: FxHashMap::default(),
        polynomials: Vec::new(),
    };
    let mut left = work.products;
    let mut without: Vec<Vec<usize>> = Vec::new();
    for part in flow.closed_parts() {
        // What contains a part whose rates are too large has such rates itself.
        if without
            .iter()
            .any(|own| own.iter().all(|i| part.contains(i)))
        {
            continue;
        }
        let own = flow.on(&part);
        let Ok(field) = PolynomialField::of(&own) else {
            without.push(part);
            continue;
        };
        let search = Search {
            flow: &own,
            field: &field,
            degree: work.degree,
        };
        // Larger parts get a half of what smaller ones leave.
        left -= search.run(&mut all, &mut known, left / 2, &mut random);
    }
    all
}

/// What was found in smaller parts, modulo the prime.
struct Known {
    field: PrimeField,
    constants: FxHashMap<Expr, Residue>,
    polynomials: Vec<ByLetters>,
}

/// Powers of letters, each by what it stands for.
type Powers = Vec<(Expr, u8)>;

/// A polynomial whose letters are named, so that it may be read in the letters of another part.
type ByLetters = Vec<(Powers, Residue)>;

struct Search<'a> {
    flow: &'a Flow<'a>,
    field: &'a PolynomialField,
    degree: u32,
}

impl Search<'_> {
    /// Searches degree by degree with so much work, and returns how much was done.
    fn run(&self, all: &mut Pairs, before: &mut Known, work: u64, random: &mut Random) -> u64 {
        let g = self.flow.graph;
        let letters = self.field.moving();
        self.poles(g, all);
        let (field, constants) = (before.field, &mut before.constants);
        let Some(at) = Specialization::extended(self.field, field, constants, random) else {
            return 0;
        };
        let mut known: Vec<Polynomial> = before
            .polynomials
            .iter()
            .filter_map(|own| self.in_letters(own))
            .collect();
        let orbits = Orbits::new(self.field, at);
        let mut done = 0;
        for degree in 1..=self.degree {
            let Some(members) = self.members(degree) else {
                break;
            };
            let mut own = orbits.clone();
            let everywhere: Vec<usize> = (0..letters.len()).collect();
            let highest = orbits.degree_in(&everywhere) as u32 - 1;
            let Some(cofactor) = self.members(highest.max(1)) else {
                break;
            };
            let Some(extactic) = Extactic::new(&mut own, members, cofactor, random) else {
                break;
            };
            if done + extactic.work() > work {
                break;
            }
            let Some(found) = extactic.search(&known, work - done, random) else {
                break;
            };
            done += found.work;
            all.families.push(Family {
                letters: letters
                    .iter()
                    .map(|&i| self.field.letters[i].value)
                    .collect(),
                degree,
                exhausted: found.exhausted,
            });
            let new = found.pairs.into_iter();
            let new: Vec<Pair> = new.filter(|p| !known.contains(&p.polynomial)).collect();
            for pair in &new {
                known.push(pair.polynomial.clone());
                before.polynomials.push(self.by_letters(&pair.polynomial));
            }
            self.lift(g, &orbits, &new, all, random);
        }
        done.min(work)
    }

    /// A polynomial of another part in the letters of this one; `None` where it contains others.
    fn in_letters(&self, own: &[(Powers, Residue)]) -> Option<Polynomial> {
        let letters = self.field.moving();
        let place = |e: Expr| {
            letters
                .iter()
                .position(|&i| self.field.letters[i].value == e)
        };
        let terms = own.iter().map(|(powers, c)| {
            let mut exponents = vec![0; letters.len()];
            for &(letter, e) in powers {
                exponents[place(letter)?] = e;
            }
            Some((exponents, *c))
        });
        terms.collect()
    }

    fn by_letters(&self, own: &Polynomial) -> ByLetters {
        let letters = self.field.moving();
        let powers = |exponents: &Exponents| {
            let own = letters.iter().zip(exponents).filter(|(_, &e)| e > 0);
            own.map(|(&i, &e)| (self.field.letters[i].value, e))
                .collect()
        };
        own.iter().map(|(e, c)| (powers(e), *c)).collect()
    }

    /// Factors of the common denominator of the rates: `D X F = (D/F) (X F) F` makes each a Darboux polynomial of the field `D X`.
    fn poles(&self, g: &Graph, all: &mut Pairs) {
        let meter = Meter::new(POLES);
        let Ok(factors) = self.field.denominator.irreducible_factors(&meter) else {
            return;
        };
        let letters: Vec<Expr> = self.field.letters.iter().map(|l| l.value).collect();
        for (factor, _) in factors {
            let found = Darboux::One(expression(g, &factor, &letters));
            let moves = factor
                .generators()
                .iter()
                .any(|&i| self.field.letters[i].moves);
            if moves && !all.found.contains(&found) {
                all.found.push(found);
            }
        }
    }

    /// Monomials of up to a degree in the letters, simple ones first; `None` where there are too many.
    fn members(&self, degree: u32) -> Option<Vec<Exponents>> {
        let letters = self.field.moving();
        let mut all: Vec<Exponents> = vec![vec![0; letters.len()]];
        for (place, &i) in letters.iter().enumerate() {
            let most = self.field.highest_power(i).unwrap_or(degree).min(degree);
            let before = std::mem::take(&mut all);
            for own in before {
                let used: u32 = own.iter().map(|&e| u32::from(e)).sum();
                for e in 0..=most.min(degree - used) {
                    let mut next = own.clone();
                    next[place] = u8::try_from(e).ok()?;
                    all.push(next);
                }
            }
            if all.len() > MEMBERS {
                return None;
            }
        }
        let total = |e: &Exponents| e.iter().map(|&e| u32::from(e)).sum::<u32>();
        all.sort_by(|a, b| total(a).cmp(&total(b)).then_with(|| b.cmp(a)));
        Some(all)
    }

    /// Adds what was found at one degree with its coefficients as functions of the constants.
    fn lift(
        &self,
        g: &Graph,
        orbits: &Orbits<'_>,
        new: &[Pair],
        all: &mut Pairs,
        random: &mut Random,
    ) {
        let started: Vec<Option<Continuation<'_>>> = new
            .iter()
            .map(|pair| Continuation::new(self.field, orbits, pair, random))
            .collect();
        let mut open: Vec<usize> = Vec::new();
        for (place, start) in started.iter().enumerate() {
            let found = start.as_ref().and_then(|start| {
                let lifted = self.lifted(orbits, Kind::One(start), random)?;
                Some(Darboux::One(self.expression(g, &new[place], &lifted)))
            });
            match found {
                Some(Darboux::One(e)) if new[place].cofactor.is_empty() => {
                    if !all.integrals.contains(&e) {
                        all.integrals.push(e);
                    }
                }
                Some(found) if !all.found.contains(&found) => all.found.push(found),
                Some(_) => {}
                None => open.push(place),
            }
        }
        while let Some(place) = open.pop() {
            let found = open.iter().copied().find_map(|other| {
                let pair = self.conjugate(g, orbits, (new, &started), [place, other], random)?;
                Some((other, pair))
            });
            match found {
                Some((other, pair)) => {
                    open.retain(|&i| i != other);
                    if !all.found.contains(&pair) {
                        all.found.push(pair);
                    }
                }
                None => all.open += 1,
            }
        }
    }

    /// Two polynomials as conjugates.
    fn conjugate(
        &self,
        g: &Graph,
        orbits: &Orbits<'_>,
        (new, started): (&[Pair], &[Option<Continuation<'_>>]),
        [one, other]: [usize; 2],
        random: &mut Random,
    ) -> Option<Darboux> {
        let monomials = |pair: &Pair| -> Vec<Exponents> {
            pair.polynomial.iter().map(|(e, _)| e.clone()).collect()
        };
        if monomials(&new[one]) != monomials(&new[other]) {
            return None;
        }
        let (first, second) = (started[one].as_ref()?, started[other].as_ref()?);
        let lifted = self.lifted(orbits, Kind::Conjugate(first, second), random)?;
        let count = new[one].polynomial.len();
        let (halves, square) = lifted.split_at(2 * count);
        let (a, b) = halves.split_at(count);
        let values = self.constant_values();
        let square = cleared(square)?;
        let square = g.div(
            expression(g, square.get(1)?, &values),
            expression(g, square.first()?, &values),
        );
        // `B ± A/√Δ` is the same pair: that whose real part begins with the simpler member is written.
        let begins = |own: &[RationalFunction]| own.iter().position(|c| !c.is_zero());
        let (a_begins, b_begins) = (begins(a), begins(b));
        let (a, b) = (
            self.combined(g, &new[one], a),
            self.combined(g, &new[one], b),
        );
        let (first, second) = if b_begins < a_begins {
            (b, g.div(a, g.neg(square)))
        } else {
            (a, b)
        };
        Some(Darboux::Conjugate {
            first,
            second,
            square,
        })
    }

    fn lifted(
        &self,
        orbits: &Orbits<'_>,
        kind: Kind<'_>,
        random: &mut Random,
    ) -> Option<Vec<RationalFunction>> {
        let mut source = Values {
            field: orbits.at.field,
            constants: self.field.constants(),
            last: orbits.at.constants.clone(),
            random: random.clone(),
            kind,
        };
        let count = source.entries(&orbits.at.constants)?.len();
        random.next_u64();
        entries(&mut source, count)
    }

    /// P without denominators in its coefficients.
    fn expression(&self, g: &Graph, pair: &Pair, coefficients: &[RationalFunction]) -> Expr {
        // The entry of the leading member is 1.
        let rest = &coefficients[..coefficients.len() - 1];
        let values = self.constant_values();
        let Some(polynomials) = cleared(rest) else {
            return self.combined(g, pair, coefficients);
        };
        let (leading, others) = (pair.polynomial.len() - 1, 0..pair.polynomial.len() - 1);
        let places = std::iter::once(leading).chain(others);
        let terms = places.zip(&polynomials).map(|(place, polynomial)| {
            g.mul(&[
                expression(g, polynomial, &values),
                self.monomial(g, &pair.polynomial[place].0),
            ])
        });
        g.add(&terms.collect::<Vec<Expr>>())
    }

    fn constant_values(&self) -> Vec<Expr> {
        let own = self.field.constants();
        own.iter().map(|&i| self.field.letters[i].value).collect()
    }

    fn combined(&self, g: &Graph, pair: &Pair, coefficients: &[RationalFunction]) -> Expr {
        let values = self.constant_values();
        let terms = pair.polynomial.iter().zip(coefficients).map(|((e, _), c)| {
            g.mul(&[
                g.div(
                    expression(g, c.numerator(), &values),
                    expression(g, c.denominator(), &values),
                ),
                self.monomial(g, e),
            ])
        });
        g.add(&terms.collect::<Vec<Expr>>())
    }

    fn monomial(&self, g: &Graph, exponents: &Exponents) -> Expr {
        let letters = self.field.moving();
        let powers = letters.iter().zip(exponents);
        let powers = powers.map(|(&i, &e)| g.powi(self.field.letters[i].value, i64::from(e)));
        g.mul(&powers.collect::<Vec<Expr>>())
    }
}

/// Room for the factors of a denominator.
const POLES: Budget = Budget {
    terms: 2_000,
    degree: 60,
    bits: 2_000,
    work: 2_000_000,
};

/// More members are too many.
const MEMBERS: usize = 250;

/// What coefficients are asked for.
#[derive(Clone, Copy)]
enum Kind<'a> {
    /// Those of P.
    One(&'a Continuation<'a>),
    /// Those of A and B, and Δ, of `A ± √Δ B`.
    Conjugate(&'a Continuation<'a>, &'a Continuation<'a>),
}

/// The coefficients at chosen constants.
struct Values<'a> {
    field: PrimeField,
    constants: Vec<usize>,
    last: Vec<Residue>,
    random: Random,
    kind: Kind<'a>,
}

impl Values<'_> {
    fn entries(&self, constants: &[Residue]) -> Option<Vec<Residue>> {
        let field = &self.field;
        let series = match self.kind {
            Kind::One(own) => own.towards(constants),
            Kind::Conjugate(own, other) => {
                conjugates(field, &own.towards(constants), &other.towards(constants))?
            }
        };
        series.iter().map(|s| value_at_one(field, s)).collect()
    }

    fn at(&mut self, constants: Vec<Residue>) -> Option<Sample> {
        let own = self.entries(&constants)?;
        Some(Sample {
            parameters: self.constants.iter().map(|&i| constants[i]).collect(),
            entries: own,
        })
    }
}

/// A, B and Δ: half the sum, and half the difference over its first coefficient that is not zero, whose square is Δ.
fn conjugates(field: &PrimeField, one: &[Series], other: &[Series]) -> Option<Vec<Series>> {
    let half = field.inv(field.from_u64(2))?;
    let combine = |sign: bool| -> Vec<Series> {
        let pairs = one.iter().zip(other);
        pairs
            .map(|(a, b)| {
                let own = a.iter().zip(b).map(|(&x, &y)| {
                    let sum = if sign {
                        field.add(x, y)
                    } else {
                        field.sub(x, y)
                    };
                    field.mul(half, sum)
                });
                own.collect()
            })
            .collect()
    };
    let (mut all, differences) = (combine(true), combine(false));
    let first = differences
        .iter()
        .find(|s| s.iter().any(|x| !x.is_zero()))?;
    let over = reciprocal(field, first)?;
    all.extend(differences.iter().map(|s| times(field, s, &over)));
    all.push(times(field, first, first));
    Some(all)
}

impl Source for Values<'_> {
    fn field(&self) -> PrimeField {
        self.field
    }

    fn sample(&mut self) -> Option<Sample> {
        for &i in &self.constants.clone() {
            self.last[i] = self.field.random(&mut self.random);
        }
        self.at(self.last.clone())
    }

    fn varied(&mut self, parameter: usize) -> Option<Sample> {
        let mut constants = self.last.clone();
        constants[self.constants[parameter]] = self.field.random(&mut self.random);
        self.at(constants)
    }
}
