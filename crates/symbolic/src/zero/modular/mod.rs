//! The modular proof (T6 §6.3): a program is run at random points of random prime fields until the proven bound on the
//! probability that something non-zero vanished each time is small enough.
//!
//! The outputs form a matrix and the question is its generic rank; "all outputs are zero" is rank 0 of one row.
//!
//! # The bound
//! Let A be a minor of the outputs that is not zero in the ring of the program, with numerator of degree d and sum of
//! coefficients below 2^h (see [`size`](super::size)). Let M be the product of the degrees of the algebraic elements
//! whose independence is established; the norm of A to the polynomials has degree ≤ M d and height ≤ M h and is not
//! zero. For a random prime p in 2^61..2^62 and a random point,
//!
//! Pr\[vanishes\] ≤ (M h / 61) / #primes + 2 M d / 2^60.9,
//!
//! the first because a non-zero integer below 2^(M h) has at most M h/61 such prime divisors, the second by the lemma of
//! Schwartz and Zippel, the 2 for the points of circles. A point where a denominator vanishes or a radicand is no
//! square is drawn anew, at most T times; by the union bound this costs the factor T, whatever the share of points refused.
//!
//! # Radicals
//! Square roots ρ² = R are independent if each R is no square in the field of those before it. A point where R is
//! not a square although all earlier ones are shows just this. Roots for which no such point is seen are not taken as independent:
//! for them every combination of signs is tried at each point, which decides zero in the ring K\[ρ\]/(ρ² − R), a product of
//! fields, and needs no independence. Roots of proportional radicands are multiples of each other (see `related`).
//!
//! # Constraints
//! Dependent symbols of nonlinear constraints are adjoined (see [`tower`](super::tower)): the outputs are tested in the
//! ring of all solutions over the point, hence on every component. Roots whose radicands contain them are adjoined
//! too. The norm from the tower has at most its dimension times the degree; the leading coefficients, the
//! discriminants and the denominators add as much again.

pub(super) mod bound;
mod related;
mod suspects;

use std::collections::BTreeMap;

use super::evaluate::{Failure, Parametrization, Point, Run, Stop};
use super::program::Program;
use super::rank::{rank_over, Pivots};
use super::ring::Scalars;
use super::size::{Sizes, Weight};
use super::variety::Variety;
use crate::number::prime::random_prime;
use crate::number::prime_field::PrimeField;
use crate::number::random::Random;
use bound::{Bound, Norm};

/// How a modular proof is made.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plan {
    /// Seed of every random choice.
    pub(super) seed: u64,
    /// The bound to reach, as log2 of a probability.
    pub(super) error_bound_log2: f64,
    /// How circles are parametrized.
    pub(super) parametrization: Parametrization,
    /// At most so many operations are evaluated in all.
    pub(super) budget: u64,
    /// Rows of the matrix of outputs.
    pub(super) rows: usize,
    /// Its columns.
    pub(super) columns: usize,
}

/// What the trials showed.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Outcome {
    /// Ranks were found.
    Found(Finding),
    /// Every point is refused by a denominator that vanishes.
    Nowhere { samples: u32 },
    /// The constraints have no solutions over random points.
    Empty { samples: u32 },
    /// Nothing follows; why.
    Open { why: String },
}

/// The ranks seen. A rank seen is a lower bound without error: a minor that is not zero at a point is not zero.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Finding {
    /// Accepted points.
    pub(super) samples: u32,
    /// log2 of the probability that the rank is larger than `maximum` nevertheless; `None` if no bound is useful.
    pub(super) error_bound_log2: Option<f64>,
    /// The smallest rank over the components and the signs of dependent roots.
    pub(super) minimum: usize,
    /// The largest.
    pub(super) maximum: usize,
    /// How many solutions over one point have which rank.
    pub(super) parts: BTreeMap<usize, usize>,
    /// Independent rows and columns where the rank is largest.
    pub(super) pivots: Pivots,
    /// Large values taken as free generators.
    pub(super) cuts: usize,
    /// Why there is no bound.
    pub(super) why_no_bound: String,
    /// Radicals not known to be independent.
    pub(super) suspects: usize,
    /// Whether solutions were left out at which the constraints do not determine their symbols.
    pub(super) are_regular: bool,
}

/// Radicals not known to be independent: at most so many (2^d runs for each point).
const MOST_SUSPECTS: usize = 6;
/// More radicals than this are not sampled by rejection.
const MOST_RADICALS: u32 = 11;
/// Values beyond 2^CUT become generators when the bound is useless otherwise.
const CUT: f64 = 26.0;
/// Refusals by poles after which a program is called nowhere defined.
const POLES_FOR_NOWHERE: u32 = 6;
/// Over half the points of a prime field a quadratic constraint has no solution; over so many in a row, none at all.
const EMPTY_FOR_NONE: u32 = 40;
/// Trials where no bound is to be had: enough to see what is not zero.
const TRIALS_WITHOUT_BOUND: u32 = 3;

/// Finds the generic rank of the outputs.
pub(super) fn decide(program: &Program, plan: &Plan) -> Outcome {
    if program.chosen_radicals() > MOST_RADICALS {
        let why = format!(
            "{} radicals are too many to sample",
            program.chosen_radicals()
        );
        return Outcome::Open { why };
    }
    if let Some(q) = program
        .odd_roots
        .iter()
        .find(|q| program.order_of_unity.is_multiple_of(**q))
    {
        let why = format!("roots of degree {q} occur together with angles of a {q}-th of π");
        return Outcome::Open { why };
    }
    let variety =
        (!program.constraints.is_empty()).then(|| Variety::new(program, plan.rows, plan.columns));
    let coupled = variety.as_ref().and_then(Variety::coupled);
    let weights = bound::weights(program, coupled);
    let sizes = Sizes::of(program, &weights, None);
    let mut session = Session {
        program,
        plan,
        norm: Norm::of(program, coupled),
        weights,
        sizes,
        variety,
        suspects: Vec::new(),
        spent: 0,
        trial: 0,
    };
    session.find_suspects();
    if let Some(outcome) = session.with_related_roots() {
        return outcome;
    }
    if session.suspects.len() > MOST_SUSPECTS {
        let why = format!(
            "{} radicals are not known to be independent",
            session.suspects.len()
        );
        return Outcome::Open { why };
    }
    let outcome = session.trials();
    session.with_cuts(outcome)
}

struct Session<'p> {
    program: &'p Program,
    plan: &'p Plan,
    norm: Norm,
    weights: Vec<Weight>,
    sizes: Sizes,
    /// How the constraints are satisfied, if there are any.
    variety: Option<Variety<'p>>,
    /// Radicals whose independence of the earlier ones is not established.
    suspects: Vec<u32>,
    spent: u64,
    trial: u64,
}

/// What one point says: how many solutions over it have which rank.
#[derive(Clone, Debug, Default)]
pub(super) struct Parts {
    pub(super) ranks: BTreeMap<usize, usize>,
    pub(super) pivots: Pivots,
    /// Parts refused because a denominator vanishes.
    pub(super) poles: usize,
    /// Whether solutions are left out at which the constraints do not determine their symbols.
    pub(super) are_regular: bool,
}

impl Parts {
    pub(super) fn add(&mut self, dimension: usize, pivots: Pivots) {
        *self.ranks.entry(pivots.rows.len()).or_insert(0) += dimension;
        if pivots.rows.len() > self.pivots.rows.len() {
            self.pivots = pivots;
        }
    }

    fn absorb(&mut self, other: Parts) {
        for (rank, count) in other.ranks {
            *self.ranks.entry(rank).or_insert(0) += count;
        }
        if other.pivots.rows.len() > self.pivots.rows.len() {
            self.pivots = other.pivots;
        }
        self.poles += other.poles;
        self.are_regular |= other.are_regular;
    }
}

enum Trial {
    Accepted(Parts),
    Stopped(Outcome),
}

impl Session<'_> {
    fn bound(&self) -> Bound<'_> {
        Bound {
            program: self.program,
            plan: self.plan,
            sizes: &self.sizes,
            suspects: self.suspects.len(),
            norm: self.norm,
        }
    }

    fn trials(&mut self) -> Outcome {
        let (each, wanted) = match self.bound().for_one_trial() {
            Ok(each) => (
                Some(each),
                (self.plan.error_bound_log2 / each).ceil().max(1.0) as u32,
            ),
            Err(_) => (None, TRIALS_WITHOUT_BOUND),
        };
        let full = self.plan.rows.min(self.plan.columns);
        let mut finding = Finding {
            cuts: self.sizes.cuts.len(),
            why_no_bound: self.bound().for_one_trial().err().unwrap_or_default(),
            suspects: self.suspects.len(),
            ..Finding::default()
        };
        while finding.samples < wanted {
            let parts = match self.one_trial() {
                Trial::Accepted(parts) => parts,
                Trial::Stopped(outcome) => return outcome,
            };
            finding.samples += 1;
            finding.take(parts);
            if finding.minimum == full {
                break;
            }
        }
        finding.error_bound_log2 = each.map(|each| each * f64::from(finding.samples));
        Outcome::Found(finding)
    }

    /// Where no bound is useful: the same with values of huge degree taken as free generators. A rank can only be larger
    /// then, so a bound found for the same rank holds all the more.
    fn with_cuts(&mut self, outcome: Outcome) -> Outcome {
        let Outcome::Found(finding) = &outcome else {
            return outcome;
        };
        if finding.error_bound_log2.is_some()
            || finding.minimum == self.plan.rows.min(self.plan.columns)
        {
            return outcome;
        }
        self.sizes = Sizes::of(self.program, &self.weights, Some(CUT));
        if self.sizes.cuts.is_empty() {
            return outcome;
        }
        match self.trials() {
            Outcome::Found(freer)
                if freer.maximum == finding.maximum && freer.error_bound_log2.is_some() =>
            {
                Outcome::Found(Finding {
                    minimum: finding.minimum,
                    parts: finding.parts.clone(),
                    ..freer
                })
            }
            _ => outcome,
        }
    }

    /// Draws a prime and a point.
    fn draw(&self, random: &mut Random) -> Option<(PrimeField, Point)> {
        let program = self.program;
        let suits = |p: u64| {
            program
                .odd_roots
                .iter()
                .all(|q| !(p - 1).is_multiple_of(*q))
        };
        for _ in 0..16 {
            let p = random_prime(random, program.order_of_unity, 1 << 16, suits)?;
            let field = PrimeField::new(p)?;
            let point = Point::random(
                program,
                &field,
                random,
                &self.sizes.cuts,
                self.plan.parametrization,
            );
            if let Some(point) = point {
                return Some((field, point));
            }
        }
        None
    }

    /// Draws points until one is accepted, and tries every choice of signs there.
    fn one_trial(&mut self) -> Trial {
        let mut random = Random::stream(self.plan.seed, self.trial);
        self.trial += 1;
        let (mut poles, mut empty) = (0, 0);
        for _ in 0..self.bound().draws() {
            let Some((field, point)) = self.draw(&mut random) else {
                break;
            };
            let negative: Vec<bool> = (0..self.program.radicals)
                .map(|_| random.next_u64() & 1 == 1)
                .collect();
            match self.all_signs(&field, &point, negative) {
                Ok(parts) if parts.ranks.is_empty() && parts.poles > 0 => poles += 1,
                Ok(parts) if parts.ranks.is_empty() => empty += 1,
                Ok(parts) => return Trial::Accepted(parts),
                Err(Failure::Unsupported(why)) => return Trial::Stopped(Outcome::Open { why }),
                Err(Failure::Stop(_)) => {}
            }
            if self.spent > self.plan.budget {
                let why = "the budget of evaluations is used up".to_owned();
                return Trial::Stopped(Outcome::Open { why });
            }
            if poles >= POLES_FOR_NOWHERE {
                return Trial::Stopped(Outcome::Nowhere { samples: poles });
            }
            if empty >= EMPTY_FOR_NONE {
                return Trial::Stopped(Outcome::Empty { samples: empty });
            }
        }
        // All solutions of what is solved jointly are followed, in whatever field they lie.
        let is_coupled = self.variety.as_ref().and_then(Variety::coupled).is_some();
        if is_coupled && empty > 0 && poles == 0 {
            return Trial::Stopped(Outcome::Empty { samples: empty });
        }
        let why = "no random point of a finite field was found at which all the square roots that occur have values".to_owned();
        Trial::Stopped(Outcome::Open { why })
    }

    /// The parts over a point, for every choice of signs of the suspects.
    fn all_signs(
        &mut self,
        field: &PrimeField,
        point: &Point,
        mut negative: Vec<bool>,
    ) -> Result<Parts, Failure> {
        let mut all = Parts::default();
        for signs in 0..1_u32 << self.suspects.len() {
            for (bit, &suspect) in self.suspects.iter().enumerate() {
                negative[suspect as usize] = signs >> bit & 1 == 1;
            }
            match self.parts_at(field, point, &negative) {
                Ok(parts) => all.absorb(parts),
                Err(Failure::Stop(Stop::Pole(_))) => all.poles += 1,
                Err(failure) => return Err(failure),
            }
        }
        Ok(all)
    }

    fn parts_at(
        &mut self,
        field: &PrimeField,
        point: &Point,
        negative: &[bool],
    ) -> Result<Parts, Failure> {
        if let Some(variety) = &self.variety {
            // An operation in a tower costs about the square of its dimension.
            self.spent += 16 * self.program.operations.len() as u64;
            return variety.parts_at(field, point, negative);
        }
        let ring = Scalars {
            field: *field,
            negative,
        };
        let mut run = Run::new(self.program, point, Vec::new());
        let (prefix, end) = (self.program.prefix, self.program.operations.len());
        self.spent += prefix as u64;
        run.advance(&ring, prefix).map_err(Failure::Stop)?;
        self.spent += (end - prefix) as u64;
        run.advance(&ring, end).map_err(Failure::Stop)?;
        let outputs: Vec<_> = self
            .program
            .outputs
            .iter()
            .map(|&output| *run.get(output))
            .collect();
        let mut parts = Parts::default();
        // Over a field nothing stops the elimination.
        if let Some(pivots) = rank_over(&ring, self.plan.rows, self.plan.columns, &outputs) {
            parts.add(1, pivots);
        }
        Ok(parts)
    }
}

impl Finding {
    fn take(&mut self, parts: Parts) {
        let minimum = parts.ranks.keys().next().copied().unwrap_or(0);
        let maximum = parts.ranks.keys().next_back().copied().unwrap_or(0);
        self.are_regular |= parts.are_regular;
        // Generic ranks are the largest seen; a smaller one at some point is an accident.
        self.minimum = self.minimum.max(minimum);
        if maximum >= self.maximum {
            self.maximum = maximum;
            self.pivots = parts.pivots;
        }
        if self.parts.is_empty() || parts.ranks.len() >= self.parts.len() {
            self.parts = parts.ranks;
        }
    }
}
