//! The direct search for first integrals (T3 §7): `G = Σ c_ν φ_ν` with `X̄G = 0` on the constraint manifold N.
//!
//! At points of N over a prime field, with the parameters at random values, the equations `Σ c_ν X̄φ_ν = 0` are linear with
//! known coefficients. Their null space modulo p has three parts: the constant, relations (combinations that vanish on
//! N, as `s² + c² - 1`), and first integrals; values at further points tell them apart. Each integral has a leading member and
//! uses only members before it; its coefficients are lifted to functions of the parameters, and what is lifted is proved by
//! the zero test, never believed.
//!
//! **What is certain.** Columns of X̄φ independent at some points are independent, so the members that are pivots contribute no
//! integral, without error. A combination called a relation might be none: only at unlucky draws, hence several of them.

use super::constants::constants;
use super::family::{Family, Letter, Member};
use super::motion::{draw_with_points, Motion, DRAWS, NO_POINTS};
use chetaev_mechanics::Context;
use chetaev_symbolic::number::modular_matrix::{null_space, NullSpace};
use chetaev_symbolic::number::prime_field::{PrimeField, Residue};
use chetaev_symbolic::number::random::Random;
use chetaev_symbolic::parallel::in_parallel;
use chetaev_symbolic::zero::points::{Draw, Points};
use chetaev_symbolic::{Expr, Verdict};

/// More points than members.
pub(super) const SURPLUS: usize = 10;

/// The bound on the probability of error that is wanted, as log2.
const WANTED_LOG2: f64 = -105.0;

/// At most so many draws of prime and parameters beside the first.
const MOST_DRAWS: usize = 8;

/// The letters and parameters of a system at points of N.
#[derive(Debug)]
pub struct Table<'a> {
    pub(super) motion: &'a Motion<'a>,
    pub(super) letters: Vec<Letter>,
    pub(super) points: Points,
    /// Parameters and constant functions of them.
    pub(super) parameters: Vec<Expr>,
    pub(super) directions: usize,
    /// How many functions what is found is told apart from: those of the place that the constraints fix, and others that are known.
    pub(super) fixed: usize,
    /// The degrees of these in the velocities.
    pub(super) degrees: Vec<u32>,
    pub(super) seed: u64,
}

/// A family with its null space modulo p.
#[derive(Clone, Debug)]
pub struct Space {
    /// The integrals, modulo the prime of the first draw.
    pub integrals: Vec<Vector>,
    /// Members that are combinations of those before them on N.
    pub relations: Vec<usize>,
    /// log2 of a bound on the probability that one of them is none.
    pub error_bound_log2: f64,
    /// At how many draws of primes and parameters they were looked at.
    pub draws: u32,
}

/// A combination of members: pairs (member, coefficient), the leading member, of coefficient 1, last.
pub type Vector = Vec<(usize, Residue)>;

/// A first integral that was found.
#[derive(Clone, Debug)]
pub struct Integral {
    /// G as a function of (t, q, v).
    pub value: Expr,
    /// G as it is shown.
    pub shown: Expr,
    /// `X̄G = 0` on N.
    pub verdict: Verdict,
    /// Whether no function of those before it.
    pub independent: bool,
    /// What it is known as: the energy, a momentum, an integral of the model.
    pub name: Option<String>,
}

/// A value of all letters at one point.
pub(super) struct At {
    pub(super) values: Vec<Residue>,
    /// `1/x` of each letter x; 0 of those that vanish, which special values of parameters may make of a momentum.
    pub(super) inverses: Vec<Residue>,
    /// `X̄x` of each letter x.
    pub(super) rates: Vec<Residue>,
    pub(super) parameters: Vec<Residue>,
    /// Derivatives along N of the letters, then of the functions that the constraints fix.
    pub(super) gradients: Vec<Residue>,
}

impl At {
    /// A power of a letter x, and its derivative by x.
    pub(super) fn power(
        &self,
        field: &PrimeField,
        letter: usize,
        exponent: i8,
    ) -> (Residue, Residue) {
        let (x, inverse) = (self.values[letter], self.inverses[letter]);
        if exponent == 1 {
            return (x, field.one());
        }
        let count = u64::from(exponent.unsigned_abs());
        let (power, less) = match exponent < 0 {
            true => {
                let power = field.pow(inverse, count);
                (power, field.mul(power, inverse))
            }
            false => {
                let less = field.pow(x, count.saturating_sub(1));
                (field.mul(less, x), less)
            }
        };
        (power, field.mul(field.from_i64(i64::from(exponent)), less))
    }

    /// Whether no letter vanishes of which a member contains a negative power.
    fn defines(&self, members: &[Member]) -> bool {
        let is_zero = |letter: usize| self.values[letter].is_zero();
        let mut own = members.iter().flatten();
        !own.any(|&(letter, exponent)| exponent < 0 && is_zero(letter))
    }
}

impl<'a> Table<'a> {
    /// Prepares letters for evaluation.
    ///
    /// # Errors
    /// A sentence that says why they cannot be evaluated.
    pub fn new(motion: &'a Motion<'a>, letters: &[Letter], seed: u64) -> Result<Table<'a>, String> {
        Table::beside(motion, letters, seed, &[])
    }

    /// The same, for what is independent of further functions of (t, q, v) that are `known`.
    ///
    /// # Errors
    /// A sentence that says why they cannot be evaluated.
    pub fn beside(
        motion: &'a Motion<'a>,
        letters: &[Letter],
        seed: u64,
        known: &[Expr],
    ) -> Result<Table<'a>, String> {
        let values: Vec<Expr> = letters.iter().map(|l| l.value).collect();
        let rates = motion.derivatives(&values);
        let gradients = motion.gradients(&values);
        let mut outputs = values;
        outputs.extend(rates);
        let parameters = constants(motion, &motion.manifold, &outputs);
        outputs.extend(&parameters);
        outputs.extend(gradients.concat());
        let mut fixed = motion.system.fixed_functions();
        fixed.extend(known);
        let degrees = fixed.iter().map(|&e| degree_of(motion, e)).collect();
        let fixed = motion.gradients(&fixed);
        outputs.extend(fixed.concat());
        Ok(Table {
            points: motion.points(&outputs)?,
            directions: gradients.first().map_or(0, Vec::len),
            fixed: fixed.len(),
            degrees,
            letters: letters.to_vec(),
            parameters,
            motion,
            seed,
        })
    }

    pub(super) fn at(&self, draw: &Draw, random: &mut Random) -> Option<At> {
        let count = self.letters.len();
        let outputs = self.points.at(draw, random)?;
        let (values, rest) = outputs.split_at(count);
        let (rates, rest) = rest.split_at(count);
        let (parameters, gradients) = rest.split_at(self.parameters.len());
        let inverse = |&x: &Residue| draw.field.inv(x).unwrap_or(Residue::ZERO);
        Some(At {
            inverses: values.iter().map(inverse).collect(),
            rates: rates.to_vec(),
            values: values.to_vec(),
            parameters: parameters.to_vec(),
            gradients: gradients.to_vec(),
        })
    }

    /// The value of a member and of X̄ of it.
    pub(super) fn member(
        &self,
        field: &PrimeField,
        at: &At,
        member: &Member,
    ) -> (Residue, Residue) {
        let mut value = field.one();
        let mut rate = Residue::ZERO;
        for &(letter, exponent) in member {
            let (power, slope) = at.power(field, letter, exponent);
            let own = field.mul(slope, at.rates[letter]);
            rate = field.add(field.mul(rate, power), field.mul(value, own));
            value = field.mul(value, power);
        }
        (value, rate)
    }

    pub(super) fn draw(&self, number: usize) -> Option<(Draw, Random)> {
        let mut random = Random::stream(self.seed, number as u64);
        let draw = draw_with_points(&self.points, &mut random)?;
        Some((draw, random))
    }

    /// The null space of a family: found at one draw; its relations are looked at again at others.
    ///
    /// # Errors
    /// A sentence that says why there is none.
    pub fn space(&self, family: &Family) -> Result<Space, String> {
        let (integrals, supports) = self.vectors(family).ok_or(NO_POINTS)?;
        let size = supports.iter().map(Vec::len).max().unwrap_or(1);
        let degree = family.members.iter().map(degree).max().unwrap_or(0);
        let once = self.points.miss_log2(self.letters.len(), degree, size)
            + ((supports.len().max(1) * DRAWS) as f64).log2();
        let draws = (WANTED_LOG2 / once).ceil().clamp(1.0, MOST_DRAWS as f64) as usize;
        for number in 1..=draws {
            if !self
                .are_relations(family, &supports, size, number)
                .ok_or(NO_POINTS)?
            {
                return Err(
                    "what vanished at some random states does not at others: the constraints may have several components".into(),
                );
            }
        }
        Ok(Space {
            integrals,
            relations: supports.iter().filter_map(|s| s.last().copied()).collect(),
            error_bound_log2: (once * draws as f64).min(0.0),
            draws: draws as u32,
        })
    }

    /// The null spaces of several families, in parallel; each is the same as alone.
    ///
    /// # Errors
    /// A sentence that says why one of them is not known.
    pub(super) fn spaces(&self, families: &[Family]) -> Result<Vec<Space>, String> {
        let spaces = in_parallel(families.len(), |i| self.space(&families[i]));
        spaces.into_iter().collect()
    }

    /// The null vectors of the first draw that are integrals, and the members of each relation, the leading one last.
    pub(super) fn vectors(&self, family: &Family) -> Option<(Vec<Vector>, Vec<Vec<usize>>)> {
        let (draw, mut random) = self.draw(0)?;
        self.vectors_at(family, &draw, &mut random)
    }

    pub(super) fn vectors_at(
        &self,
        family: &Family,
        draw: &Draw,
        random: &mut Random,
    ) -> Option<(Vec<Vector>, Vec<Vec<usize>>)> {
        let field = &draw.field;
        let members = &family.members[1..];
        let matrix = self.rows(draw, random, members, members.len() + SURPLUS)?;
        let found = null_space(field, members.len(), matrix);
        // Members count from the constant on.
        let vectors: Vec<Vector> = found
            .vectors
            .into_iter()
            .map(|(leading, rest)| {
                let all = rest.into_iter().chain([(leading, field.one())]);
                all.map(|(i, c)| (i + 1, c)).collect()
            })
            .collect();
        let functions = self.nonconstant(family, &vectors, draw, random)?;
        // A vector that is no new function differs from a relation by integrals before it.
        let relations = functions.vectors.iter().map(|(own, rest)| {
            let all = rest.iter().map(|&(i, _)| i).chain([*own]);
            let mut members: Vec<usize> = all
                .flat_map(|i| vectors[i].iter().map(|&(member, _)| member))
                .collect();
            members.sort_unstable();
            members.dedup();
            members
        });
        let relations = relations.collect();
        let integrals = functions.pivots.iter().map(|&i| vectors[i].clone());
        Some((integrals.collect(), relations))
    }

    /// X̄ of the members at so many points, row by row.
    pub(super) fn rows(
        &self,
        draw: &Draw,
        random: &mut Random,
        members: &[Member],
        points: usize,
    ) -> Option<Vec<Residue>> {
        let mut rows = Vec::with_capacity(members.len() * points);
        for _ in 0..points {
            let at = self.at(draw, random)?;
            if !at.defines(members) {
                return None;
            }
            let rates = members.iter().map(|m| self.member(&draw.field, &at, m).1);
            rows.extend(rates);
        }
        Some(rows)
    }

    /// Whether the members of each list are linearly dependent, the constant among them, at the points of a further draw.
    fn are_relations(
        &self,
        family: &Family,
        supports: &[Vec<usize>],
        size: usize,
        number: usize,
    ) -> Option<bool> {
        if supports.is_empty() {
            return Some(true);
        }
        let (draw, mut random) = self.draw(number)?;
        let field = &draw.field;
        // The constant is a member too.
        let mut used: Vec<usize> = supports.concat();
        used.push(0);
        used.sort_unstable();
        used.dedup();
        let mut matrix = Vec::with_capacity(used.len() * (size + 1 + SURPLUS));
        for _ in 0..size + 1 + SURPLUS {
            let at = self.at(&draw, &mut random)?;
            let members = used.iter().map(|&m| &family.members[m]);
            matrix.extend(members.map(|m| self.member(field, &at, m).0));
        }
        // One elimination for all.
        let all = null_space(field, used.len(), matrix);
        let is_dependent = |support: &Vec<usize>| {
            all.depends_within(field, |place| {
                used[place] == 0 || support.contains(&used[place])
            })
        };
        Some(supports.iter().all(is_dependent))
    }

    /// Which combinations are independent of those before them and of the constants, as functions on N.
    fn nonconstant(
        &self,
        family: &Family,
        vectors: &[Vector],
        draw: &Draw,
        random: &mut Random,
    ) -> Option<NullSpace> {
        let field = &draw.field;
        let mut rows: Vec<Vec<Residue>> = Vec::new();
        for _ in 0..vectors.len() + 6 {
            let at = self.at(draw, random)?;
            let values: Vec<Residue> = family
                .members
                .iter()
                .map(|m| self.member(field, &at, m).0)
                .collect();
            let combined = vectors.iter().map(|vector| {
                vector.iter().fold(Residue::ZERO, |sum, &(member, c)| {
                    field.add(sum, field.mul(c, values[member]))
                })
            });
            rows.push(combined.collect());
        }
        let (first, rest) = rows.split_first()?;
        let differences = rest
            .iter()
            .flat_map(|row| row.iter().zip(first).map(|(&a, &b)| field.sub(a, b)));
        Some(null_space(field, vectors.len(), differences.collect()))
    }
}

/// No degree is looked for beyond this one; what is no polynomial in the velocities has it too.
const DEGREE: u32 = 4;

/// The degree of a function in the velocities, by its form.
pub(super) fn degree_of(motion: &Motion<'_>, e: Expr) -> u32 {
    let g = &motion.system.graph;
    let velocities = motion.system.velocity_symbols();
    let mut slopes = vec![e];
    for degree in 0..DEGREE {
        slopes.retain(|&e| g.contains_any(e, &velocities));
        if slopes.is_empty() {
            return degree;
        }
        let all = slopes.iter().flat_map(|&e| g.gradient(e, &velocities));
        slopes = all.collect();
        slopes.sort_unstable();
        slopes.dedup();
    }
    DEGREE
}

/// The degree of a member in the letters.
fn degree(member: &Member) -> u32 {
    let exponents = member.iter().map(|(_, e)| u32::from(e.unsigned_abs()));
    exponents.sum()
}

/// All first integrals of one family.
#[derive(Clone, Debug)]
pub struct Exhausted {
    /// How many there are, constants and multiples of the constraints not counted.
    pub dimension: usize,
    /// The integrals, simple ones first, with what each needs of those before it; those that could not be lifted or proved are
    /// missing.
    pub integrals: Vec<Integral>,
    /// Members that are combinations of others on N.
    pub relations: usize,
    /// log2 of a bound on the probability that the dimension is larger.
    pub error_bound_log2: f64,
}

/// Finds all first integrals of a family and proves them.
///
/// # Errors
/// A sentence that says why the search could not be made.
pub fn exhaust(
    cx: &Context<'_>,
    motion: &Motion<'_>,
    family: &Family,
) -> Result<Exhausted, String> {
    let table = Table::new(motion, &family.letters, cx.prover.points_seed())?;
    let space = table.space(family)?;
    let candidates: Vec<(&Family, &[(usize, Residue)])> = space
        .integrals
        .iter()
        .map(|vector| (family, &vector[..]))
        .collect();
    let independent = table.independent(&candidates).unwrap_or_default();
    let integrals = candidates
        .iter()
        .enumerate()
        .filter_map(|(i, (_, vector))| {
            let integral = table.proved(cx, family, vector)?;
            Some(Integral {
                independent: independent.contains(&i),
                ..integral
            })
        });
    Ok(Exhausted {
        dimension: space.integrals.len(),
        integrals: integrals.collect(),
        relations: space.relations.len(),
        error_bound_log2: space.error_bound_log2,
    })
}

impl Table<'_> {
    /// Whether X̄ of a member vanishes on N, by what is seen at points of the first draws: its coefficient 1 if so. What is proved
    /// is decided later.
    pub fn rate_vanishes(&self, family: &Family, place: usize) -> Option<Residue> {
        for number in 0..2 {
            let (draw, mut random) = self.draw(number)?;
            for _ in 0..3 {
                let at = self.at(&draw, &mut random)?;
                let (_, rate) = self.member(&draw.field, &at, &family.members[place]);
                if !rate.is_zero() {
                    return None;
                }
            }
        }
        // One is represented differently in each field; combinations belong to the first draw.
        self.draw(0).map(|(draw, _)| draw.field.one())
    }
}
