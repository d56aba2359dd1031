//! Darboux polynomials modulo a prime, by points of the extactic hypersurface.
//!
//! A polynomial P in the letters with `X P = K P` vanishes along the whole orbit through each of its zeros. For members m_j the
//! matrix of `X^i m_j(z)` then has P among its null vectors. At a general point its null vectors are those combinations that
//! vanish along every orbit through it, as `G - G(z)` of first integrals G; its rank r drops on `P = 0`. So its minors of r rows
//! vanish there: they are multiples of all Darboux polynomials among the members (the extactic polynomial: Pereira, Ann. Inst.
//! Fourier 51 (2001); Chèze, J. Complexity 27 (2011)). On a random line two minors, found by interpolation, have as their greatest
//! common divisor what Darboux polynomials leave on the line, and its roots are points at which these are read off. What remains
//! of the divisor when the polynomials found are taken out tells whether some were missed.

use crate::orbit::{Exponents, Orbits};
use chetaev_symbolic::number::modular_matrix::{determinant, null_space};
use chetaev_symbolic::number::modular_polynomial::{
    gcd, interpolated, quotient_and_remainder, roots,
};
use chetaev_symbolic::number::prime_field::{PrimeField, Residue};
use chetaev_symbolic::number::random::Random;

/// More derivatives than the rank asks for: a polynomial that only touches the orbit so closely is none that contains it.
const SURPLUS: usize = 4;

/// At most so many lines: each has a root of a given factor with a probability of one half at least.
const LINES: usize = 8;

/// Products for a root of a polynomial in one variable, over its squared degree: x^p takes 62 squarings and as many remainders.
const ROOT: u64 = 124;

/// How many other zeros a space of polynomials is compared at.
const OTHERS: usize = 12;

/// Coefficients of products of powers of the letters.
pub(crate) type Polynomial = Vec<(Exponents, Residue)>;

/// A Darboux polynomial with its cofactor, as coefficients of members and of monomials.
#[derive(Clone, Debug)]
pub(crate) struct Pair {
    /// The coefficients of P, the last of which is 1.
    pub(crate) polynomial: Polynomial,
    /// The coefficients of its cofactor for D X.
    pub(crate) cofactor: Polynomial,
}

/// What was found at one degree.
#[derive(Clone, Debug)]
pub(crate) struct Found {
    pub(crate) pairs: Vec<Pair>,
    /// Whether nothing of the divisor on the last line was left over.
    pub(crate) exhausted: bool,
    /// Counted products.
    pub(crate) work: u64,
}

/// The search at one specialization among the polynomials of one degree.
#[derive(Debug)]
pub(crate) struct Extactic<'a, 'f> {
    orbits: &'a Orbits<'f>,
    exponents: Vec<Exponents>,
    /// The monomials of the members.
    members: Vec<usize>,
    /// How many monomials members and rates are made of.
    count: usize,
    /// Monomials that a cofactor may consist of.
    cofactor: Vec<(Exponents, usize)>,
    rank: usize,
    /// Members that are independent along general orbits.
    columns: Vec<usize>,
    free: Vec<usize>,
    degree: usize,
}

/// A line in the space of the letters.
struct Line {
    start: Vec<Residue>,
    direction: Vec<Residue>,
}

impl Line {
    fn at(&self, field: &PrimeField, s: Residue) -> Vec<Residue> {
        let pairs = self.start.iter().zip(&self.direction);
        pairs
            .map(|(&x, &d)| field.add(x, field.mul(s, d)))
            .collect()
    }
}

/// Combinations of members that vanish along the orbit through a point.
type Space = Vec<Vec<Residue>>;

impl<'a, 'f> Extactic<'a, 'f> {
    /// Prepares the search among these members, simple ones first; `None` where there is no point, or no letter to vary.
    pub(crate) fn new(
        orbits: &'a mut Orbits<'f>,
        exponents: Vec<Exponents>,
        cofactor: Vec<Exponents>,
        random: &mut Random,
    ) -> Option<Extactic<'a, 'f>> {
        let free = orbits.free();
        let degree = orbits.degree_in(&free) - 1;
        let members: Vec<usize> = exponents.iter().map(|e| orbits.monomial(e)).collect();
        let count = orbits.count();
        let cofactor = cofactor.into_iter().map(|e| {
            let place = orbits.monomial(&e);
            (e, place)
        });
        let mut own = Extactic {
            cofactor: cofactor.collect(),
            orbits,
            exponents,
            members,
            count,
            rank: 0,
            columns: Vec::new(),
            free,
            degree,
        };
        if own.free.is_empty() {
            return None;
        }
        let point = own.orbits.point(random)?;
        let matrix = own.matrix(&point, own.members.len() + SURPLUS);
        let space = null_space(own.field(), own.members.len(), matrix.concat());
        own.rank = space.pivots.len();
        own.columns = space.pivots;
        Some(own)
    }

    fn field(&self) -> &PrimeField {
        &self.orbits.at.field
    }

    /// How many points of a line determine a minor.
    fn points(&self) -> usize {
        let own = self.columns.iter().map(|&j| {
            let places = self.free.iter();
            places
                .map(|&place| usize::from(self.exponents[j][place]))
                .sum::<usize>()
        });
        own.sum::<usize>() + self.degree * (self.rank * (self.rank + 1) / 2 + 1) + 1
    }

    /// Counted products of a line.
    pub(crate) fn work(&self) -> u64 {
        let rank = self.rank as u64 + 1;
        let series = self.count as u64 * rank * rank / 2;
        self.points() as u64 * (series + rank * rank * rank)
    }

    /// `(D X)^i m_j / i!` at a point, row by row.
    fn matrix(&self, point: &[Residue], rows: usize) -> Vec<Vec<Residue>> {
        let series = self.orbits.series(point, rows, self.count);
        let row = |i: usize| self.members.iter().map(|&m| series[m][i]).collect();
        (0..rows).map(row).collect()
    }

    /// The polynomials that vanish on orbits through points of lines where the rank drops, Darboux polynomials modulo the prime. Zeros
    /// of those that are `known` are left out.
    pub(crate) fn search(
        &self,
        known: &[Polynomial],
        allowed: u64,
        random: &mut Random,
    ) -> Option<Found> {
        let mut work = 0;
        let mut pairs: Vec<Pair> = self.integrals(random)?;
        let mut points: Vec<(usize, Vec<Residue>)> = Vec::new();
        for number in 0..LINES {
            if number > 0 && work + self.work() > allowed {
                break;
            }
            let line = self.line(random)?;
            let mut divisor = self.divisor(&line);
            for own in known
                .iter()
                .chain(pairs.iter().map(|pair| &pair.polynomial))
            {
                divisor = self.without(&line, divisor, own)?;
            }
            let zeros = roots(self.field(), &divisor, random);
            work += self.work();
            work += ROOT * (divisor.len() as u64).pow(2) * (1 + zeros.len() as u64);
            points.extend(
                zeros
                    .iter()
                    .map(|&root| (number, line.at(self.field(), root))),
            );
            for (seed, point) in points.iter().filter(|(own, _)| *own == number) {
                let vanishes =
                    |pair: &Pair| combination(self.field(), &pair.polynomial, point).is_zero();
                if pairs.iter().any(vanishes) {
                    continue;
                }
                for candidate in self.through(point, *seed, &points, random) {
                    let found = self.pairs(&candidate, random).unwrap_or_default();
                    let is_found = !found.is_empty();
                    for pair in found {
                        if !pairs.iter().any(|p| p.polynomial == pair.polynomial) {
                            divisor = self.without(&line, divisor, &pair.polynomial)?;
                            pairs.push(pair);
                        }
                    }
                    if is_found {
                        break;
                    }
                }
            }
            if divisor.len() <= 1 {
                return Some(Found {
                    pairs,
                    exhausted: true,
                    work,
                });
            }
        }
        Some(Found {
            pairs,
            exhausted: false,
            work,
        })
    }

    fn line(&self, random: &mut Random) -> Option<Line> {
        let start = self.orbits.point(random)?;
        let mut direction = vec![Residue::ZERO; start.len()];
        for &place in &self.free {
            direction[place] = self.field().random(random);
        }
        Some(Line { start, direction })
    }

    /// The greatest common divisor of two minors on a line.
    fn divisor(&self, line: &Line) -> Vec<Residue> {
        let field = self.field();
        let (mut first, mut second) = (Vec::new(), Vec::new());
        for s in 0..self.points() as u64 {
            let s = field.from_u64(s);
            let mut rows = self.matrix(&line.at(field, s), self.rank + 1);
            let minor = |rows: &[Vec<Residue>]| {
                let own = rows
                    .iter()
                    .flat_map(|row| self.columns.iter().map(|&j| row[j]));
                determinant(field, self.rank, own.collect())
            };
            first.push((s, minor(&rows[..self.rank])));
            rows.swap(self.rank - 1, self.rank);
            second.push((s, minor(&rows[..self.rank])));
        }
        let (_, first) = interpolated(field, &first);
        let (_, second) = interpolated(field, &second);
        gcd(field, first, second)
    }

    /// Polynomials that vanish on the orbit through a point: the simplest one, and the simplest one of those that vanish on orbits through
    /// other zeros too, as far as more do than by chance.
    fn through(
        &self,
        point: &[Residue],
        line: usize,
        points: &[(usize, Vec<Residue>)],
        random: &mut Random,
    ) -> Vec<Vec<Residue>> {
        let generic = self.members.len() - self.rank;
        let rows = self.members.len() + SURPLUS;
        let mut space = self.vanishing(point, rows);
        if space.len() <= generic {
            return Vec::new();
        }
        let first = |space: &Space| echelon(self.field(), space.clone()).into_iter().next();
        let mut candidates: Vec<Vec<Residue>> = Vec::new();
        candidates.extend(first(&space).filter(|_| generic == 0 || space.len() == 1));
        if space.len() == 1 {
            return candidates;
        }
        let others = points.iter().rev().filter(|(other, _)| *other != line);
        for (_, at) in others.take(OTHERS) {
            let next = self.also_at(&space, at, rows);
            let Some(general) = self.orbits.point(random) else {
                break;
            };
            if next.len() > self.also_at(&space, &general, rows).len() {
                space = next;
            }
            if space.len() == 1 {
                break;
            }
        }
        candidates.extend(first(&space));
        candidates
    }

    fn vanishing(&self, point: &[Residue], rows: usize) -> Space {
        let count = self.members.len();
        let space = null_space(self.field(), count, self.matrix(point, rows).concat());
        let dense = space.vectors.into_iter().map(|(free, rest)| {
            let mut own = vec![Residue::ZERO; count];
            rest.into_iter().for_each(|(i, c)| own[i] = c);
            own[free] = self.field().one();
            own
        });
        dense.collect()
    }

    /// Those of a space that vanish on the orbit through a further point too.
    fn also_at(&self, space: &Space, point: &[Residue], rows: usize) -> Space {
        let field = self.field();
        let matrix = self.matrix(point, rows);
        let products = matrix.iter().flat_map(|row| {
            space
                .iter()
                .map(|own| dot(field, row, own))
                .collect::<Vec<Residue>>()
        });
        let weights = null_space(field, space.len(), products.collect());
        let combined = weights.vectors.into_iter().map(|(free, rest)| {
            let mut own = space[free].clone();
            for (i, c) in rest {
                for (x, &y) in own.iter_mut().zip(&space[i]) {
                    *x = field.add(*x, field.mul(c, y));
                }
            }
            own
        });
        combined.collect()
    }

    /// The polynomials with the cofactor of a candidate; none where it is no Darboux polynomial.
    fn pairs(&self, candidate: &[Residue], random: &mut Random) -> Option<Vec<Pair>> {
        let cofactor = self.cofactor_of(candidate, random)?;
        self.with_cofactor(cofactor, random)
    }

    /// The polynomials without cofactor that are no constants: first integrals.
    fn integrals(&self, random: &mut Random) -> Option<Vec<Pair>> {
        let mut found = self.with_cofactor(Vec::new(), random)?;
        found.retain(|pair| {
            pair.polynomial.len() > 1 || pair.polynomial[0].0.iter().any(|&e| e > 0)
        });
        for pair in &mut found {
            pair.polynomial.retain(|(e, _)| e.iter().any(|&e| e > 0));
        }
        Some(found)
    }

    /// K with `D X P = K P`.
    fn cofactor_of(
        &self,
        candidate: &[Residue],
        random: &mut Random,
    ) -> Option<Vec<(Exponents, Residue)>> {
        let field = self.field();
        let columns = self.cofactor.len() + 1;
        let mut matrix = Vec::new();
        for _ in 0..columns + SURPLUS {
            let series = self
                .orbits
                .series(&self.orbits.point(random)?, 2, self.orbits.count());
            let along = |k: usize| {
                let own = self.members.iter().map(|&m| series[m][k]);
                dot(field, &own.collect::<Vec<Residue>>(), candidate)
            };
            let value = along(0);
            matrix.extend(
                self.cofactor
                    .iter()
                    .map(|(_, m)| field.mul(value, series[*m][0])),
            );
            matrix.push(field.neg(along(1)));
        }
        let space = null_space(field, columns, matrix);
        let (_, rest) = space
            .vectors
            .into_iter()
            .find(|(free, _)| *free + 1 == columns)?;
        Some(
            rest.into_iter()
                .map(|(i, c)| (self.cofactor[i].0.clone(), c))
                .collect(),
        )
    }

    /// A basis of the members' combinations with a cofactor.
    fn with_cofactor(
        &self,
        cofactor: Vec<(Exponents, Residue)>,
        random: &mut Random,
    ) -> Option<Vec<Pair>> {
        let field = self.field();
        let of = |e: &Exponents| {
            self.cofactor
                .iter()
                .find(|(own, _)| own == e)
                .map(|(_, m)| *m)
        };
        let terms: Vec<(usize, Residue)> = cofactor
            .iter()
            .filter_map(|(e, c)| Some((of(e)?, *c)))
            .collect();
        let mut matrix = Vec::new();
        for _ in 0..self.members.len() + SURPLUS {
            let series = self
                .orbits
                .series(&self.orbits.point(random)?, 2, self.orbits.count());
            let k = terms.iter().fold(Residue::ZERO, |sum, &(m, c)| {
                field.add(sum, field.mul(c, series[m][0]))
            });
            let own = self.members.iter();
            matrix.extend(own.map(|&m| field.sub(series[m][1], field.mul(k, series[m][0]))));
        }
        let space = null_space(field, self.members.len(), matrix);
        let pairs = space.vectors.into_iter().map(|(free, rest)| Pair {
            polynomial: rest
                .into_iter()
                .chain([(free, field.one())])
                .map(|(i, c)| (self.exponents[i].clone(), c))
                .collect(),
            cofactor: cofactor.clone(),
        });
        Some(pairs.collect())
    }

    /// A polynomial on a line without the zeros of another one.
    fn without(
        &self,
        line: &Line,
        divisor: Vec<Residue>,
        own: &Polynomial,
    ) -> Option<Vec<Residue>> {
        let field = self.field();
        let mut rest = divisor;
        let degrees = own
            .iter()
            .map(|(e, _)| e.iter().map(|&e| u64::from(e)).sum());
        let highest: u64 = degrees.max().unwrap_or(0);
        let values = (0..=highest).map(|s| {
            let s = field.from_u64(s);
            (s, combination(field, own, &line.at(field, s)))
        });
        let (_, own) = interpolated(field, &values.collect::<Vec<_>>());
        while rest.len() > 1 {
            let common = gcd(field, rest.clone(), own.clone());
            if common.len() <= 1 {
                break;
            }
            rest = quotient_and_remainder(field, rest, &common)?.0;
        }
        Some(rest)
    }
}

fn combination(field: &PrimeField, terms: &[(Exponents, Residue)], point: &[Residue]) -> Residue {
    terms.iter().fold(Residue::ZERO, |sum, (exponents, c)| {
        let powers = exponents.iter().zip(point);
        let term = powers.fold(*c, |product, (&e, &x)| {
            field.mul(product, field.pow(x, u64::from(e)))
        });
        field.add(sum, term)
    })
}

fn dot(field: &PrimeField, a: &[Residue], b: &[Residue]) -> Residue {
    a.iter().zip(b).fold(Residue::ZERO, |sum, (&x, &y)| {
        field.add(sum, field.mul(x, y))
    })
}

/// A basis of the same space in which vectors end at different places, early ones first.
fn echelon(field: &PrimeField, space: Space) -> Space {
    let mut rows: Vec<Vec<Residue>> = space;
    let mut done: Space = Vec::new();
    let width = rows.first().map_or(0, Vec::len);
    for column in (0..width).rev() {
        let Some(place) = rows.iter().position(|row| !row[column].is_zero()) else {
            continue;
        };
        let pivot = rows.swap_remove(place);
        let Some(over) = field.inv(pivot[column]) else {
            continue;
        };
        let pivot: Vec<Residue> = pivot.into_iter().map(|x| field.mul(x, over)).collect();
        for row in &mut rows {
            let factor = row[column];
            for (x, &y) in row.iter_mut().zip(&pivot) {
                *x = field.sub(*x, field.mul(factor, y));
            }
        }
        done.push(pivot);
    }
    done.reverse();
    done
}
