//! Which integrals of families are functions of others, by their derivatives and values modulo p.

use super::family::{Family, Member};
use super::search::{degree_of, At, Table, SURPLUS};
use chetaev_symbolic::number::modular_matrix::null_space;
use chetaev_symbolic::number::prime_field::{PrimeField, Residue};
use chetaev_symbolic::number::random::Random;
use chetaev_symbolic::zero::points::Draw;

/// Of columns 1 and G_i, G_i G_j, and of candidates: how many candidates are new beside the first, by products or otherwise, and which
/// products are combinations of candidates.
fn told_apart(
    field: &PrimeField,
    first: &[Vec<Residue>],
    squares: &[Vec<Residue>],
    candidates: &[Vec<Residue>],
    pairs: &[(usize, usize)],
) -> Dependent {
    let rank = |columns: &[&[Vec<Residue>]]| independent_columns(field, &columns.concat()).len();
    let (plain, with_squares) = (first.len(), rank(&[first, squares]));
    let space = rank(&[first, candidates]);
    let whole = rank(&[first, squares, candidates]);
    let others = whole - with_squares;
    let second_degree = (space - plain).saturating_sub(others);
    let is_combination = |place: &usize| {
        second_degree > 0 && rank(&[first, candidates, &squares[*place..=*place]]) == space
    };
    let products = (0..pairs.len()).filter(is_combination);
    Dependent {
        second_degree,
        others,
        products: products.map(|place| pairs[place]).collect(),
    }
}

/// Which columns are independent of those before them: the pivots of the matrix with these columns.
fn independent_columns(field: &PrimeField, columns: &[Vec<Residue>]) -> Vec<usize> {
    let height = columns.first().map_or(0, Vec::len);
    let rows = (0..height).flat_map(|d| columns.iter().map(move |column| column[d]));
    null_space(field, columns.len(), rows.collect()).pivots
}

/// What families contain beside integrals `G_1, G_2, …` that are independent: new functions of these, constants aside.
#[derive(Clone, Debug, Default)]
pub struct Dependent {
    /// How many are of second degree in them.
    pub second_degree: usize,
    /// How many are others.
    pub others: usize,
    /// The products `G_i G_j`, i ≤ j, that are combinations of what the families contain.
    pub products: Vec<(usize, usize)>,
}

impl Table<'_> {
    /// The derivatives along N of the known functions, a column each.
    fn known_columns(&self, at: &At) -> Vec<Vec<Residue>> {
        let known =
            at.gradients[self.letters.len() * self.directions..].chunks(self.directions.max(1));
        known.map(<[Residue]>::to_vec).collect()
    }

    /// Which of the candidates are functionally independent of those before them: the rank of their derivatives along N, at a
    /// point of the first draw.
    pub fn independent(&self, candidates: &[(&Family, &[(usize, Residue)])]) -> Option<Vec<usize>> {
        let (draw, _) = self.draw(0)?;
        self.independent_at(&draw, candidates)
    }

    pub(super) fn independent_at(
        &self,
        draw: &Draw,
        candidates: &[(&Family, &[(usize, Residue)])],
    ) -> Option<Vec<usize>> {
        // Another stream than that of the null space.
        let mut random = Random::stream(self.seed, 1 << 20);
        let field = &draw.field;
        let at = self.at(draw, &mut random)?;
        let mut columns = self.known_columns(&at);
        columns.extend(
            candidates
                .iter()
                .map(|(family, vector)| self.gradient(field, &at, family, vector)),
        );
        let pivots = independent_columns(field, &columns);
        let own = pivots.into_iter().filter_map(|i| i.checked_sub(self.fixed));
        Some(own.collect())
    }

    /// Which of the candidates are, at a draw, functionally independent of those before them and of the known functions that are of no
    /// higher degree in the velocities: new ones, or simpler ones than known.
    pub(super) fn new_or_simpler(
        &self,
        draw: &Draw,
        candidates: &[(&Family, &[(usize, Residue)])],
    ) -> Option<Vec<usize>> {
        let mut random = Random::stream(self.seed, 1 << 20);
        let at = self.at(draw, &mut random)?;
        let known = self.known_columns(&at).into_iter().enumerate();
        let known = known.map(|(i, column)| ((self.degrees[i], 0), None, column));
        let own = candidates.iter().enumerate().map(|(i, (family, vector))| {
            let degrees = vector
                .iter()
                .map(|&(m, _)| self.degree_of(&family.members[m]));
            let column = self.gradient(&draw.field, &at, family, vector);
            ((degrees.max().unwrap_or(0), 1), Some(i), column)
        });
        let mut all: Vec<_> = known.chain(own).collect();
        all.sort_by_key(|(order, ..)| *order);
        let (places, columns): (Vec<Option<usize>>, Vec<Vec<Residue>>) = all
            .into_iter()
            .map(|(_, place, column)| (place, column))
            .unzip();
        let pivots = independent_columns(&draw.field, &columns);
        Some(pivots.into_iter().filter_map(|i| places[i]).collect())
    }

    /// The degree of a member in the velocities.
    fn degree_of(&self, member: &Member) -> u32 {
        let degrees = member.iter().map(|&(letter, exponent)| {
            let own = degree_of(self.motion, self.letters[letter].value);
            own * u32::from(exponent.unsigned_abs())
        });
        degrees.sum()
    }

    /// What the candidates are beside the first of them at the places `independent`.
    pub fn others(
        &self,
        candidates: &[(&Family, &[(usize, Residue)])],
        independent: &[usize],
    ) -> Option<Dependent> {
        let (draw, _) = self.draw(0)?;
        let mut random = Random::stream(self.seed, 1 << 22);
        let field = &draw.field;
        let pairs: Vec<(usize, usize)> = (0..independent.len())
            .flat_map(|j| (0..=j).map(move |i| (i, j)))
            .collect();
        let height = 1 + independent.len() + pairs.len() + candidates.len() + SURPLUS;
        let mut of_candidates = Vec::with_capacity(height);
        for _ in 0..height {
            let at = self.at(&draw, &mut random)?;
            let value = |(family, vector): &(&Family, &[(usize, Residue)])| {
                vector.iter().fold(Residue::ZERO, |sum, &(member, c)| {
                    let (value, _) = self.member(field, &at, &family.members[member]);
                    field.add(sum, field.mul(c, value))
                })
            };
            of_candidates.push(candidates.iter().map(value).collect::<Vec<Residue>>());
        }
        let column = |value: &dyn Fn(&[Residue]) -> Residue| {
            of_candidates
                .iter()
                .map(|row| value(row))
                .collect::<Vec<Residue>>()
        };
        let mut first = vec![column(&|_| field.one())];
        first.extend(independent.iter().map(|&i| column(&|row| row[i])));
        let squares = pairs
            .iter()
            .map(|&(i, j)| column(&|row| field.mul(row[independent[i]], row[independent[j]])));
        let squares: Vec<Vec<Residue>> = squares.collect();
        let all: Vec<Vec<Residue>> = (0..candidates.len())
            .map(|i| column(&|row| row[i]))
            .collect();
        Some(told_apart(field, &first, &squares, &all, &pairs))
    }

    fn gradient(
        &self,
        field: &PrimeField,
        at: &At,
        family: &Family,
        vector: &[(usize, Residue)],
    ) -> Vec<Residue> {
        // ∂G = Σ_x (Σ_ν c_ν ∂φ_ν/∂x) ∂x.
        let mut slopes = vec![Residue::ZERO; self.letters.len()];
        for &(member, c) in vector {
            let own = &family.members[member];
            for (place, &(letter, exponent)) in own.iter().enumerate() {
                let (_, mut slope) = at.power(field, letter, exponent);
                for &(other, power) in own[..place].iter().chain(&own[place + 1..]) {
                    slope = field.mul(slope, at.power(field, other, power).0);
                }
                slopes[letter] = field.add(slopes[letter], field.mul(c, slope));
            }
        }
        let along = |direction: usize| {
            let mut sum = Residue::ZERO;
            for (letter, &slope) in slopes.iter().enumerate() {
                let own = at.gradients[letter * self.directions + direction];
                sum = field.add(sum, field.mul(slope, own));
            }
            sum
        };
        (0..self.directions).map(along).collect()
    }
}
