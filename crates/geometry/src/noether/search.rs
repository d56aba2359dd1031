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

use super::family::{Family, Letter, Member};
use super::lift::{self, Sample};
use super::motion::{draw_with_points, redraw_with_points, Motion, DRAWS};
use chetaev_mechanics::{Context, Manifold};
use chetaev_symbolic::factors::factored;
use chetaev_symbolic::number::modular_matrix::{null_space, NullSpace};
use chetaev_symbolic::number::prime_field::{PrimeField, Residue};
use chetaev_symbolic::number::random::Random;
use chetaev_symbolic::zero::points::{Draw, Points};
use chetaev_symbolic::{Expr, Graph, Node, Rational, Symbol, Verdict};

/// More points than members.
const SURPLUS: usize = 10;

/// The bound on the probability of error that is wanted, as log2.
const WANTED_LOG2: f64 = -104.0;

/// At most so many draws of prime and parameters beside the first.
const MOST_DRAWS: usize = 6;

/// The letters and parameters of a system at points of N.
#[derive(Debug)]
pub struct Table<'a> {
    motion: &'a Motion<'a>,
    letters: Vec<Letter>,
    points: Points,
    /// Parameters and constant functions of them.
    parameters: Vec<Expr>,
    directions: usize,
    /// How many functions of the place the constraints fix.
    fixed: usize,
    seed: u64,
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
struct At {
    values: Vec<Residue>,
    /// `X̄x/x` of each letter x.
    rates: Vec<Residue>,
    parameters: Vec<Residue>,
    /// Derivatives along N of the letters, then of the functions that the constraints fix.
    gradients: Vec<Residue>,
}

impl<'a> Table<'a> {
    /// Prepares letters for evaluation.
    ///
    /// # Errors
    /// A sentence that says why they cannot be evaluated.
    pub fn new(motion: &'a Motion<'a>, letters: &[Letter], seed: u64) -> Result<Table<'a>, String> {
        let values: Vec<Expr> = letters.iter().map(|l| l.value).collect();
        let rates = motion.derivatives(&values);
        let gradients = motion.gradients(&values);
        let mut outputs = values;
        outputs.extend(rates);
        let parameters = constants(motion, &motion.manifold, &outputs);
        outputs.extend(&parameters);
        outputs.extend(gradients.concat());
        let fixed = motion.gradients(&motion.system.fixed_functions());
        outputs.extend(fixed.concat());
        Ok(Table {
            points: motion.points(&outputs)?,
            directions: gradients.first().map_or(0, Vec::len),
            fixed: fixed.len(),
            letters: letters.to_vec(),
            parameters,
            motion,
            seed,
        })
    }

    fn at(&self, draw: &Draw, random: &mut Random) -> Option<At> {
        let count = self.letters.len();
        (0..20).find_map(|_| {
            let outputs = self.points.at(draw, random)?;
            let (values, rest) = outputs.split_at(count);
            let (rates, rest) = rest.split_at(count);
            let (parameters, gradients) = rest.split_at(self.parameters.len());
            let inverses: Option<Vec<Residue>> =
                values.iter().map(|&x| draw.field.inv(x)).collect();
            let relative = rates.iter().zip(inverses?);
            Some(At {
                rates: relative.map(|(&rate, i)| draw.field.mul(rate, i)).collect(),
                values: values.to_vec(),
                parameters: parameters.to_vec(),
                gradients: gradients.to_vec(),
            })
        })
    }

    /// The value of a member and of X̄ of it.
    fn member(&self, field: &PrimeField, at: &At, member: &Member) -> (Residue, Residue) {
        let mut value = field.one();
        let mut rate = Residue::ZERO;
        for &(letter, exponent) in member {
            let x = at.values[letter];
            let power = field.pow(x, u64::from(exponent.unsigned_abs()));
            let power = match exponent < 0 {
                true => field.inv(power).unwrap_or(Residue::ZERO),
                false => power,
            };
            value = field.mul(value, power);
            let times = field.from_i64(i64::from(exponent));
            rate = field.add(rate, field.mul(times, at.rates[letter]));
        }
        (value, field.mul(value, rate))
    }

    fn draw(&self, number: usize) -> Option<(Draw, Random)> {
        let mut random = Random::stream(self.seed, number as u64);
        let draw = draw_with_points(&self.points, &mut random)?;
        Some((draw, random))
    }

    /// The null space of a family: found at one draw; its relations are looked at again at others.
    ///
    /// # Errors
    /// A sentence that says why there is none.
    pub fn space(&self, family: &Family) -> Result<Space, String> {
        let none = "no points of the constraint manifold were found over a prime field";
        let (integrals, supports) = self.vectors(family).ok_or(none)?;
        let size = supports.iter().map(Vec::len).max().unwrap_or(1);
        let degree = family.members.iter().map(degree).max().unwrap_or(0);
        let once = self.points.miss_log2(self.letters.len(), degree, size)
            + ((supports.len().max(1) * DRAWS) as f64).log2();
        let draws = (WANTED_LOG2 / once).ceil().clamp(1.0, MOST_DRAWS as f64) as usize;
        for number in 1..=draws {
            if !self
                .are_relations(family, &supports, size, number)
                .ok_or(none)?
            {
                return Err(
                    "what vanished at the points of one draw does not at those of another".into(),
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

    /// The null vectors of the first draw that are integrals, and the members of each relation, the leading one last.
    fn vectors(&self, family: &Family) -> Option<(Vec<Vector>, Vec<Vec<usize>>)> {
        let (draw, mut random) = self.draw(0)?;
        self.vectors_at(family, &draw, &mut random)
    }

    fn vectors_at(
        &self,
        family: &Family,
        draw: &Draw,
        random: &mut Random,
    ) -> Option<(Vec<Vector>, Vec<Vec<usize>>)> {
        let field = &draw.field;
        let members = &family.members[1..];
        let mut matrix = Vec::with_capacity(members.len() * (members.len() + SURPLUS));
        for _ in 0..members.len() + SURPLUS {
            let at = self.at(draw, random)?;
            matrix.extend(members.iter().map(|m| self.member(field, &at, m).1));
        }
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
        let mut rows: Vec<Vec<Residue>> = Vec::new();
        for _ in 0..size + 1 + SURPLUS {
            let at = self.at(&draw, &mut random)?;
            let members = family.members.iter();
            rows.push(members.map(|m| self.member(field, &at, m).0).collect());
        }
        let is_dependent = |support: &Vec<usize>| {
            let columns: Vec<usize> = std::iter::once(0).chain(support.iter().copied()).collect();
            let matrix = rows[..columns.len() + SURPLUS].iter();
            let matrix = matrix.flat_map(|row| columns.iter().map(|&c| row[c]));
            !null_space(field, columns.len(), matrix.collect())
                .vectors
                .is_empty()
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

    /// Which of the candidates are functionally independent of those before them: the rank of their derivatives along N, at a
    /// point of the first draw.
    pub fn independent(&self, candidates: &[(&Family, &[(usize, Residue)])]) -> Option<Vec<usize>> {
        let (draw, _) = self.draw(0)?;
        self.independent_at(&draw, candidates)
    }

    fn independent_at(
        &self,
        draw: &Draw,
        candidates: &[(&Family, &[(usize, Residue)])],
    ) -> Option<Vec<usize>> {
        // Another stream than that of the null space.
        let mut random = Random::stream(self.seed, 1 << 20);
        let field = &draw.field;
        let at = self.at(draw, &mut random)?;
        let letters = self.letters.len();
        let fixed = at.gradients[letters * self.directions..].chunks(self.directions.max(1));
        let mut columns: Vec<Vec<Residue>> = fixed.map(<[Residue]>::to_vec).collect();
        columns.extend(
            candidates
                .iter()
                .map(|(family, vector)| self.gradient(field, &at, family, vector)),
        );
        let rows = (0..self.directions).flat_map(|d| columns.iter().map(move |column| column[d]));
        let pivots = null_space(field, columns.len(), rows.collect()).pivots;
        let own = pivots.into_iter().filter_map(|i| i.checked_sub(self.fixed));
        Some(own.collect())
    }

    /// How many of the candidates are new functions, constants aside, beside the first of them at the places `independent`: as
    /// (products of these, others).
    pub fn others(
        &self,
        candidates: &[(&Family, &[(usize, Residue)])],
        independent: &[usize],
    ) -> Option<(usize, usize)> {
        let (draw, _) = self.draw(0)?;
        let mut random = Random::stream(self.seed, 1 << 22);
        let field = &draw.field;
        let pairs = independent.len() * (independent.len() + 1) / 2;
        let columns = 1 + independent.len() + pairs + candidates.len();
        let mut matrix = Vec::with_capacity(columns * (columns + SURPLUS));
        for _ in 0..columns + SURPLUS {
            let at = self.at(&draw, &mut random)?;
            let value = |(family, vector): &(&Family, &[(usize, Residue)])| {
                vector.iter().fold(Residue::ZERO, |sum, &(member, c)| {
                    let (value, _) = self.member(field, &at, &family.members[member]);
                    field.add(sum, field.mul(c, value))
                })
            };
            let values: Vec<Residue> = candidates.iter().map(value).collect();
            let first: Vec<Residue> = independent.iter().map(|&i| values[i]).collect();
            matrix.push(field.one());
            matrix.extend(&first);
            for (i, &a) in first.iter().enumerate() {
                matrix.extend(first[..=i].iter().map(|&b| field.mul(a, b)));
            }
            matrix.extend(values);
        }
        self.counted(field, columns, matrix, independent.len(), pairs)
    }

    /// Of columns 1, G_i, G_i G_j and candidates: how many candidates are new beside the G_i, by products or otherwise.
    fn counted(
        &self,
        field: &PrimeField,
        columns: usize,
        matrix: Vec<Residue>,
        first: usize,
        pairs: usize,
    ) -> Option<(usize, usize)> {
        let known = 1 + first + pairs;
        let pivots = null_space(field, columns, matrix.clone()).pivots;
        let others = pivots.iter().filter(|&&i| i >= known).count();
        let kept: Vec<usize> = (0..=first).chain(known..columns).collect();
        let rows = matrix.chunks(columns);
        let without: Vec<Residue> = rows.flat_map(|row| kept.iter().map(|&i| row[i])).collect();
        let pivots = null_space(field, kept.len(), without).pivots;
        let new = pivots.iter().filter(|&&i| i > first).count();
        Some((new.checked_sub(others)?, others))
    }

    fn gradient(
        &self,
        field: &PrimeField,
        at: &At,
        family: &Family,
        vector: &[(usize, Residue)],
    ) -> Vec<Residue> {
        // ∂G = Σ_x (Σ_ν c_ν φ_ν e_ν(x)/x) ∂x.
        let mut slopes = vec![Residue::ZERO; self.letters.len()];
        for &(member, c) in vector {
            let (value, _) = self.member(field, at, &family.members[member]);
            let weighted = field.mul(c, value);
            for &(letter, exponent) in &family.members[member] {
                let times = field.mul(weighted, field.from_i64(i64::from(exponent)));
                let inverse = field.inv(at.values[letter]).unwrap_or(Residue::ZERO);
                slopes[letter] = field.add(slopes[letter], field.mul(times, inverse));
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

    /// An integral with its coefficients as functions of the parameters: as (value, shown); `None` where they are none of
    /// moderate degree.
    pub fn lifted(&self, family: &Family, vector: &[(usize, Residue)]) -> Option<(Expr, Expr)> {
        self.lifted_on(family, vector, None)
    }

    fn lifted_on(
        &self,
        family: &Family,
        vector: &[(usize, Residue)],
        tie: Option<&Tie>,
    ) -> Option<(Expr, Expr)> {
        let g = &self.motion.system.graph;
        let (&(leading, _), rest) = vector.split_last()?;
        let support: Vec<usize> = rest.iter().map(|&(member, _)| member).collect();
        let (draw, random) = self.draw(0)?;
        let mut source = Restricted {
            table: self,
            family,
            leading,
            support: &support,
            draw,
            random,
            tie,
        };
        let entries = match support.is_empty() {
            true => Vec::new(),
            false => lift::entries(&mut source, support.len())?,
        };
        let polynomials = lift::cleared(&entries)?;
        let members = std::iter::once(leading).chain(support);
        let (mut value, mut shown) = (Vec::new(), Vec::new());
        for (member, polynomial) in members.zip(&polynomials) {
            let coefficient = lift::expression(g, polynomial, &self.parameters);
            let member = &family.members[member];
            let system = self.motion.system;
            value.push(g.mul(&[coefficient, family.expression(system, member, false)]));
            shown.push(g.mul(&[coefficient, family.expression(system, member, true)]));
        }
        Some((g.add(&value), g.add(&shown)))
    }

    /// Lifts and proves an integral; `None` where that fails.
    pub fn proved(
        &self,
        cx: &Context<'_>,
        family: &Family,
        vector: &[(usize, Residue)],
    ) -> Option<Integral> {
        let (value, shown) = self.lifted(family, vector)?;
        let verdict = self.motion.is_integral(cx, value);
        matches!(verdict, Verdict::Proved(_)).then_some(Integral {
            value,
            shown,
            verdict,
            independent: true,
            name: None,
        })
    }
}

/// The degree of a member in the letters.
fn degree(member: &Member) -> u32 {
    let exponents = member.iter().map(|(_, e)| u32::from(e.unsigned_abs()));
    exponents.sum()
}

/// The linear system of one integral, restricted to the members it uses.
struct Restricted<'a> {
    table: &'a Table<'a>,
    family: &'a Family,
    leading: usize,
    support: &'a [usize],
    draw: Draw,
    random: Random,
    tie: Option<&'a Tie>,
}

/// Special values of parameters.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Tie {
    /// A parameter equals another one.
    Equal(Symbol, Symbol),
    /// A parameter is zero.
    Zero(Symbol),
    /// Parameters have these values.
    Values(Vec<(Symbol, Rational)>),
}

impl Tie {
    /// The parameters with what they are.
    pub fn pairs(&self, g: &Graph) -> Vec<(Expr, Expr)> {
        match self {
            Tie::Equal(parameter, other) => {
                vec![(g.symbol_expr(*parameter), g.symbol_expr(*other))]
            }
            Tie::Zero(parameter) => vec![(g.symbol_expr(*parameter), g.zero())],
            Tie::Values(values) => values
                .iter()
                .map(|(s, value)| (g.symbol_expr(*s), g.number(value.clone())))
                .collect(),
        }
    }
}

/// What a family has more of at a special value of a parameter.
#[derive(Clone, Debug)]
pub struct Special {
    /// The special value.
    pub tie: Tie,
    /// The further integrals, as they are shown, none of them a function of simpler ones; of those that exist for all values
    /// some may be functions of them.
    pub integrals: Vec<Expr>,
}

impl Table<'_> {
    fn tied(&self, draw: &Draw, tie: &Tie) -> Option<Draw> {
        let values = match tie {
            Tie::Equal(parameter, other) => vec![(*parameter, self.points.value(draw, *other)?)],
            Tie::Zero(parameter) => vec![(*parameter, Residue::ZERO)],
            Tie::Values(values) => values
                .iter()
                .map(|(s, value)| Some((*s, draw.field.from_rational(value)?)))
                .collect::<Option<Vec<_>>>()?,
        };
        let mut tied = draw.clone();
        self.points.set(&mut tied, &values);
        Some(tied)
    }

    /// The parameters that the motion contains as symbols of their own.
    pub fn free_parameters(&self) -> Vec<Symbol> {
        let g = &self.motion.system.graph;
        let symbols = self.parameters.iter().filter_map(|&e| g.as_symbol(e));
        let (draw, _) = match self.draw(0) {
            Some(draw) => draw,
            None => return Vec::new(),
        };
        symbols
            .filter(|&s| self.points.value(&draw, s).is_some())
            .collect()
    }

    /// What a family has more of at special values of the parameters, each integral proved there.
    pub fn special(&self, cx: &Context<'_>, family: &Family, ties: &[Tie]) -> Vec<Special> {
        let Some((general, _)) = self.vectors(family) else {
            return Vec::new();
        };
        let leading = |v: &Vector| v.last().map(|&(member, _)| member);
        let usual: Vec<Option<usize>> = general.iter().map(leading).collect();
        let mut found: Vec<Special> = Vec::new();
        for tie in ties {
            let Some((draw, mut random)) = self.draw(0) else {
                continue;
            };
            let Some(draw) = self.tied(&draw, tie) else {
                continue;
            };
            let Some((vectors, _)) = self.vectors_at(family, &draw, &mut random) else {
                continue;
            };
            if vectors.len() <= general.len() {
                continue;
            }
            let candidates: Vec<(&Family, &[(usize, Residue)])> =
                vectors.iter().map(|v| (family, &v[..])).collect();
            let independent = self.independent_at(&draw, &candidates).unwrap_or_default();
            let integrals: Vec<Expr> = independent
                .iter()
                .filter(|&&i| !usual.contains(&leading(&vectors[i])))
                .filter_map(|&i| self.proved_on(cx, family, &vectors[i], tie))
                .collect();
            if !integrals.is_empty() {
                found.push(Special {
                    tie: tie.clone(),
                    integrals,
                });
            }
        }
        found
    }

    /// An integral at a special value, lifted and proved there.
    fn proved_on(
        &self,
        cx: &Context<'_>,
        family: &Family,
        vector: &[(usize, Residue)],
        tie: &Tie,
    ) -> Option<Expr> {
        let (system, g) = (self.motion.system, &self.motion.system.graph);
        let (value, shown) = self.lifted_on(family, vector, Some(tie))?;
        let pairs = tie.pairs(g);
        let replaced = |e: Expr| g.substitute(e, &pairs);
        let manifold = &self.motion.manifold;
        let manifold = Manifold {
            solved: manifold
                .solved
                .iter()
                .map(|&(s, e)| (s, replaced(e)))
                .collect(),
            implicit: manifold
                .implicit
                .iter()
                .map(|&(f, s)| (replaced(f), s))
                .collect(),
        };
        let rate: Vec<Expr> = self
            .motion
            .derivatives(&[value])
            .into_iter()
            .map(replaced)
            .collect();
        let verdict = cx
            .prover
            .identity(system, &rate, &manifold, "at a special value");
        matches!(verdict, Verdict::Proved(_)).then(|| replaced(shown))
    }
}

impl Restricted<'_> {
    fn solve(&mut self, draw: &Draw) -> Option<Sample> {
        let field = draw.field;
        let columns = self.support.len() + 1;
        let mut matrix = Vec::new();
        let mut parameters = Vec::new();
        for _ in 0..columns + 2 {
            let at = self.table.at(draw, &mut self.random)?;
            let members = self.support.iter().chain([&self.leading]);
            matrix.extend(
                members.map(|&m| self.table.member(&field, &at, &self.family.members[m]).1),
            );
            parameters = at.parameters;
        }
        let space = null_space(&field, columns, matrix);
        let (_, rest) = space
            .vectors
            .iter()
            .find(|(free, _)| *free == columns - 1)?;
        if space.vectors.len() != 1 {
            return None;
        }
        let mut entries = vec![Residue::ZERO; self.support.len()];
        rest.iter().for_each(|&(i, c)| entries[i] = c);
        Some(Sample {
            parameters,
            entries,
        })
    }
}

impl lift::Source for Restricted<'_> {
    fn field(&self) -> PrimeField {
        self.draw.field
    }

    fn sample(&mut self) -> Option<Sample> {
        let draw = match self.table.parameters.is_empty() {
            true => self.draw.clone(),
            false => redraw_with_points(&self.table.points, &self.draw, &mut self.random)?,
        };
        let draw = match self.tie {
            Some(tie) => self.table.tied(&draw, tie)?,
            None => draw,
        };
        // The first sample is the one that others are compared with.
        self.draw = draw.clone();
        self.solve(&draw)
    }

    fn varied(&mut self, parameter: usize) -> Option<Sample> {
        let g = &self.table.motion.system.graph;
        let symbol: Symbol = g.as_symbol(self.table.parameters[parameter])?;
        let mut draw = self.draw.clone();
        let value = self.draw.field.random(&mut self.random);
        self.table.points.set(&mut draw, &[(symbol, value)]);
        match self.tie {
            // The other follows, so what depends on either is seen to depend on this one.
            Some(tie) => {
                let draw = self.table.tied(&draw, tie)?;
                self.solve(&draw)
            }
            None => self.solve(&draw),
        }
    }
}

/// The parameters that occur in functions on a manifold or in what ties these, and the functions of parameters alone that are no
/// rational functions of them.
pub(super) fn constants(motion: &Motion<'_>, manifold: &Manifold, outputs: &[Expr]) -> Vec<Expr> {
    let g = &motion.system.graph;
    let is_constant = |e: Expr| g.is_free_of(e, &|s| motion.moves(s));
    let mut roots = outputs.to_vec();
    roots.extend(manifold.solved.iter().map(|(_, e)| *e));
    roots.extend(manifold.implicit.iter().map(|(f, _)| *f));
    let mut found: Vec<Expr> = Vec::new();
    for e in g.reachable(&roots) {
        let is_letter = match g.node(e) {
            Node::Symbol(symbol) => !motion.moves(*symbol),
            Node::Pi => true,
            Node::Apply { .. } => is_constant(e),
            Node::Power { exponent, .. } => g.as_integer(*exponent).is_none() && is_constant(e),
            _ => false,
        };
        if is_letter && !found.contains(&e) {
            found.push(e);
        }
        for root in roots_of_constants(motion, manifold, e) {
            if !found.contains(&root) {
                found.push(root);
            }
        }
    }
    found.sort_by(|&a, &b| g.compare(a, b));
    found
}

/// The constants that a root of what moves contains on the manifold: `√(x'² + y'² + z'²)` contains `√(1 + a²)` where
/// `z' = a √(x'² + y'²)`.
fn roots_of_constants(motion: &Motion<'_>, manifold: &Manifold, e: Expr) -> Vec<Expr> {
    let g = &motion.system.graph;
    let is_constant = |e: Expr| g.is_free_of(e, &|s| motion.moves(s));
    let Node::Power { base, exponent } = g.node(e) else {
        return Vec::new();
    };
    if g.as_integer(*exponent).is_some() || !is_constant(*exponent) || is_constant(*base) {
        return Vec::new();
    }
    let solved: Vec<(Expr, Expr)> = manifold
        .solved
        .iter()
        .map(|&(s, value)| (g.symbol_expr(s), value))
        .collect();
    let Some(factored) = factored(g, g.substitute(*base, &solved)) else {
        return Vec::new();
    };
    let constant = factored.factors.iter().filter(|(f, _)| is_constant(*f));
    constant
        .filter(|(f, n)| n % 2 != 0 && g.as_integer(*f).is_none())
        .map(|&(f, _)| g.pow(f, *exponent))
        .collect()
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
