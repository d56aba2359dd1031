//! The modular proof (theory 6.3): a program is run at random points of random prime fields until the proven bound on the
//! probability that a non-zero program vanished each time is small enough.
//!
//! # The bound
//! Let A be the numerator of an output that is not zero in the ring of the program, of degree d and with the sum of its
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
//! fields, and needs no independence.
//!
//! # Constraints
//! Dependent symbols of nonlinear constraints are adjoined (see [`tower`](super::tower)): the outputs are tested in the ring of all solutions
//! over the point, hence on every component. Roots whose radicands contain them are adjoined too. The norm from the
//! tower has at most its dimension times the degree; the leading coefficients, the discriminants and the denominators add as much again.

use super::evaluate::{Parametrization, Point, Run, Stop};
use super::program::{Operation, Program, Value};
use super::ring::{Ring, Scalars};
use super::size::{Sizes, Weight, SLACK};
use super::variety::{Failure, Parts, Variety};
use crate::number::prime::{random_prime, LOG2_PRIME_COUNT};
use crate::number::prime_field::PrimeField;
use crate::number::random::Random;

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
}

/// What the trials showed.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Outcome {
    /// Zero, with log2 of the bound on the probability of error.
    Zero {
        error_bound_log2: f64,
        samples: u32,
        cuts: usize,
    },
    /// Not zero in the field: exact. `everywhere` unless some combination of signs of roots vanished.
    NonZero { samples: u32 },
    /// Zero for some choices of the roots only.
    Branches { samples: u32, what: String },
    /// Every point is refused by a denominator that vanishes.
    Nowhere { samples: u32 },
    /// Nothing follows; why.
    Open { why: String, vanished: u32 },
}

/// Radicals not known to be independent: at most so many (2^d runs for each point).
const MOST_SUSPECTS: usize = 6;
/// More radicals than this are not sampled by rejection.
const MOST_RADICALS: u32 = 11;
/// Beyond this log2 of the degree no bound is attempted (theory 6.3).
const LARGEST_LOG2_DEGREE: f64 = 40.0;
/// Values beyond 2^CUT become generators when the bound is useless otherwise.
const CUT: f64 = 26.0;
/// log2 of 4 times the largest dimension of a tower: norms over it, its leading coefficients and discriminants.
const LOG2_TOWER: f64 = 8.0;
/// Refusals by poles after which a program is called nowhere defined.
const POLES_FOR_NOWHERE: u32 = 6;

/// Decides whether all outputs of the program are zero.
pub(super) fn decide(program: &Program, plan: &Plan) -> Outcome {
    if program.radicals > MOST_RADICALS {
        let why = format!(
            "{} independent radicals are too many to sample",
            program.radicals
        );
        return Outcome::Open { why, vanished: 0 };
    }
    if let Some(q) = program
        .odd_roots
        .iter()
        .find(|q| program.order_of_unity.is_multiple_of(**q))
    {
        let why = format!("roots of degree {q} occur together with angles of a {q}-th of π");
        return Outcome::Open { why, vanished: 0 };
    }
    let weights = weights(program);
    let sizes = Sizes::of(program, &weights, None);
    let variety = (!program.constraints.is_empty()).then(|| Variety::new(program));
    let mut session = Session {
        program,
        plan,
        weights,
        sizes,
        variety,
        suspects: Vec::new(),
        spent: 0,
        trial: 0,
        parts: (0, 0),
    };
    session.find_suspects();
    if session.suspects.len() > MOST_SUSPECTS {
        let why = format!(
            "{} radicals are not known to be independent",
            session.suspects.len()
        );
        return Outcome::Open { why, vanished: 0 };
    }
    match session.trials() {
        Outcome::Open { why, vanished } => session
            .with_cuts()
            .unwrap_or(Outcome::Open { why, vanished }),
        decided => decided,
    }
}

/// Degrees and heights of the constraints, each as coefficients of the equation of its symbol.
fn weights(program: &Program) -> Vec<Weight> {
    let mut weights = vec![
        Weight {
            degree: 1.0,
            height: 0.0
        };
        program.constraints.len()
    ];
    // Roots over the symbol: the equation is the norm of the constraint.
    let adjoined = program
        .adjoined
        .iter()
        .filter(|&&adjoined| adjoined)
        .count()
        .min(3);
    let norm = f64::from(1_u32 << adjoined);
    for (k, &constraint) in program.constraints.iter().enumerate() {
        let sizes = Sizes::of(program, &weights, None);
        let (size, denominator) = (sizes.get(constraint), sizes.denominator(constraint));
        weights[k] = Weight {
            degree: norm * (size.degree + denominator.degree),
            height: norm * (size.height + denominator.height + 1.0),
        };
    }
    weights
}

struct Session<'p> {
    program: &'p Program,
    plan: &'p Plan,
    weights: Vec<Weight>,
    sizes: Sizes,
    /// How the constraints are satisfied, if there are any.
    variety: Option<Variety<'p>>,
    /// Dimensions of the parts of the variety where the outputs vanished and where not, at the last mixed point.
    parts: (usize, usize),
    /// Radicals whose independence of the earlier ones is not established.
    suspects: Vec<u32>,
    spent: u64,
    trial: u64,
}

/// What one accepted point says.
enum Trial {
    Zero,
    NonZero,
    Mixed,
    Refused { poles: u32 },
    OutOfBudget,
    Unsupported(String),
}

impl Session<'_> {
    /// The largest degree and height of the outputs, each with everything divided by.
    fn worst(&self) -> (f64, f64) {
        self.program
            .outputs
            .iter()
            .fold((1.0_f64, 1.0_f64), |(degree, height), &output| {
                let (size, denominator) = (self.sizes.get(output), self.sizes.denominator(output));
                (
                    degree.max(size.degree + denominator.degree),
                    height.max(size.height + denominator.height),
                )
            })
    }

    /// log2 of M.
    fn multiplicity(&self) -> f64 {
        let squares = f64::from(self.program.chosen_radicals()) - self.suspects.len() as f64;
        let odd = |operation: &Operation| match operation {
            Operation::OddRoot { degree, .. } => (*degree as f64).log2(),
            _ => 0.0,
        };
        let odd: f64 = self.program.operations.iter().map(odd).sum();
        let tower = if self.variety.is_some() {
            LOG2_TOWER
        } else {
            0.0
        };
        squares + odd + (self.program.order_of_unity as f64).log2() + tower
    }

    /// log2 of the number of primes the choice is made from, rounded down.
    fn log2_primes(&self) -> f64 {
        // φ(N) ≤ N classes; in each of them more than half of the expected number (M. A. Bennett, G. Martin, K. O'Bryant
        // and A. Rechnitzer, Illinois J. Math. 62, 2018); each odd root excludes at most half.
        let classes = match self.program.order_of_unity {
            0..=2 => 0.0,
            order => (order as f64).log2() + 1.0,
        };
        LOG2_PRIME_COUNT - classes - 2.0 * self.program.odd_roots.len() as f64
    }

    /// T, the largest number of points drawn for one trial.
    fn draws(&self) -> u32 {
        let radicals = self.program.chosen_radicals();
        16 << (radicals + u32::from(radicals > 0))
    }

    /// log2 of the probability that one trial errs.
    fn trial_bound(&self) -> f64 {
        let (degree, height) = self.worst();
        let m = self.multiplicity().exp2() * SLACK;
        let prime = m * height / 61.0 / self.log2_primes().exp2();
        let point = 2.0 * m * degree / 60.9_f64.exp2();
        f64::from(self.draws()).log2() + (prime + point).log2()
    }

    fn trials(&mut self) -> Outcome {
        let bound = self.trial_bound();
        let useless = bound > -4.0 || self.worst().0.log2() > LARGEST_LOG2_DEGREE;
        let wanted = if useless {
            3
        } else {
            (self.plan.error_bound_log2 / bound).ceil().max(1.0) as u32
        };
        let (mut zeros, mut mixed) = (0, 0);
        for sample in 1..=wanted {
            match self.one_trial() {
                Trial::Zero => zeros += 1,
                Trial::Mixed => mixed += 1,
                Trial::NonZero => return Outcome::NonZero { samples: sample },
                Trial::Refused { poles } if poles >= POLES_FOR_NOWHERE => {
                    return Outcome::Nowhere { samples: poles }
                }
                Trial::Refused { .. } => {
                    let why = "no point was found where all radicands are squares".to_owned();
                    return Outcome::Open {
                        why,
                        vanished: zeros,
                    };
                }
                Trial::Unsupported(why) => {
                    return Outcome::Open {
                        why,
                        vanished: zeros,
                    }
                }
                Trial::OutOfBudget => {
                    let why = "the budget of evaluations is used up".to_owned();
                    return Outcome::Open {
                        why,
                        vanished: zeros,
                    };
                }
            }
        }
        if mixed > 0 {
            let what = format!(
                "zero for some signs of {} dependent radicals and not for others",
                self.suspects.len()
            );
            return Outcome::Branches {
                samples: wanted,
                what,
            };
        }
        if useless {
            let (degree, height) = self.worst();
            let why = format!(
                "no useful bound on the probability of error: log2 of the degree {:.0}, of the height {:.0}",
                degree.log2(),
                height.log2()
            );
            return Outcome::Open {
                why,
                vanished: zeros,
            };
        }
        let cuts = self.sizes.cuts.len();
        Outcome::Zero {
            error_bound_log2: bound * f64::from(wanted),
            samples: wanted,
            cuts,
        }
    }

    fn describe_branches(&self) -> String {
        if self.variety.is_none() {
            let count = self.suspects.len();
            return format!("zero for some signs of {count} dependent radicals and not for others");
        }
        let (vanishing, other) = self.parts;
        format!(
            "zero on some components of the constraints only: of the {} solutions for the dependent symbols at a point, \
             {vanishing} make it vanish",
            vanishing + other
        )
    }

    /// The same with values of huge degree taken as free generators: zero then is zero all the more.
    fn with_cuts(&mut self) -> Option<Outcome> {
        self.sizes = Sizes::of(self.program, &self.weights, Some(CUT));
        if self.sizes.cuts.is_empty() {
            return None;
        }
        match self.trials() {
            zero @ Outcome::Zero { .. } => Some(zero),
            _ => None,
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
            if let Some(point) = Point::random(
                program,
                &field,
                random,
                &self.sizes.cuts,
                self.plan.parametrization,
            ) {
                return Some((field, point));
            }
        }
        None
    }

    /// Draws points until one is accepted, and tries every choice of signs there.
    fn one_trial(&mut self) -> Trial {
        let mut random = Random::stream(self.plan.seed, self.trial);
        self.trial += 1;
        let mut poles = 0;
        for _ in 0..self.draws() {
            let Some((field, point)) = self.draw(&mut random) else {
                break;
            };
            let mut negative: Vec<bool> = (0..self.program.radicals)
                .map(|_| random.next_u64() & 1 == 1)
                .collect();
            let (mut zeros, mut others, mut refused) = (0, 0, 0);
            for signs in 0..1_u32 << self.suspects.len() {
                for (bit, &suspect) in self.suspects.iter().enumerate() {
                    negative[suspect as usize] = signs >> bit & 1 == 1;
                }
                match self.parts_at(&field, &point, &negative) {
                    Ok(parts) => {
                        zeros += parts.vanishing;
                        others += parts.other;
                        refused += usize::from(parts.vanishing + parts.other == 0);
                    }
                    Err(Failure::Stop(Stop::Pole(_))) => refused += 1,
                    Err(Failure::Stop(_)) => {
                        (zeros, others, refused) = (0, 0, 0);
                        break;
                    }
                    Err(Failure::Unsupported(why)) => return Trial::Unsupported(why),
                }
                if self.spent > self.plan.budget {
                    return Trial::OutOfBudget;
                }
            }
            match (zeros, others) {
                (0, 0) => poles += u32::from(refused > 0),
                (_, 0) => return Trial::Zero,
                (0, _) => return Trial::NonZero,
                (vanishing, other) => {
                    self.parts = (vanishing, other);
                    return Trial::Mixed;
                }
            }
            if poles >= POLES_FOR_NOWHERE {
                break;
            }
        }
        Trial::Refused { poles }
    }

    /// Where over the point do all outputs vanish?
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
        let vanishing = self
            .vanishes(field, point, negative)
            .map_err(Failure::Stop)?;
        Ok(Parts {
            vanishing: usize::from(vanishing),
            other: usize::from(!vanishing),
        })
    }

    /// Do all outputs vanish at the point?
    fn vanishes(
        &mut self,
        field: &PrimeField,
        point: &Point,
        negative: &[bool],
    ) -> Result<bool, Stop> {
        let ring = Scalars {
            field: *field,
            negative,
        };
        let mut run = Run::new(self.program, point, Vec::new());
        let stopped = run.advance(&ring, self.program.prefix);
        self.spent += self.program.prefix as u64;
        stopped?;
        let stopped = run.advance(&ring, self.program.operations.len());
        self.spent += (self.program.operations.len() - self.program.prefix) as u64;
        stopped?;
        Ok(self
            .program
            .outputs
            .iter()
            .all(|&output: &Value| ring.is_zero(run.get(output))))
    }

    /// Looks for each radical for points where it is the first to have no root.
    fn find_suspects(&mut self) {
        let radicals = self.program.radicals as usize;
        let chosen = self.program.chosen_radicals();
        if chosen == 0 {
            return;
        }
        // A wrong witness needs a zero of the denominator of a square root of the radicand; k of them are as
        // unlikely as k failures of a trial with the degree of the whole program.
        let (degree, _) = self.worst();
        let each = (60.0 - degree.log2() - f64::from(chosen)).max(10.0);
        let needed = (-self.plan.error_bound_log2 / each).ceil().max(2.0) as u32;
        let mut seen = vec![0_u32; radicals];
        let attempts = (8 * needed) << chosen;
        let mut random = Random::stream(self.plan.seed, u64::MAX);
        for _ in 0..attempts {
            let done = |(count, &adjoined): (&u32, &bool)| adjoined || *count >= needed;
            if seen.iter().zip(&self.program.adjoined).all(done)
                || self.spent > self.plan.budget / 4
            {
                break;
            }
            let Some((field, point)) = self.draw(&mut random) else {
                break;
            };
            let negative: Vec<bool> = (0..radicals).map(|_| random.next_u64() & 1 == 1).collect();
            let ring = Scalars {
                field,
                negative: &negative,
            };
            let mut run = Run::new(self.program, &point, Vec::new());
            self.spent += self.program.prefix as u64;
            if let Err(Stop::NonSquare(radical)) = run.advance(&ring, self.program.prefix) {
                seen[radical as usize] += 1;
            }
        }
        let open = |(count, &adjoined): (&u32, &bool)| !adjoined && *count < needed;
        let suspects: Vec<bool> = seen.iter().zip(&self.program.adjoined).map(open).collect();
        self.suspects = self.spread(suspects);
    }

    /// A radical whose radicand depends on a suspect is a suspect too: its witnesses were seen for one sign only.
    fn spread(&self, mut suspects: Vec<bool>) -> Vec<u32> {
        let mut tainted = vec![false; self.program.operations.len()];
        for (value, operation) in self.program.operations.iter().enumerate() {
            let mut below = false;
            operation.for_each_operand(|operand| below |= tainted[operand as usize]);
            if let Operation::SquareRoot { radical, .. } = operation {
                suspects[*radical as usize] |= below && !self.program.adjoined[*radical as usize];
                below |= suspects[*radical as usize];
            }
            tainted[value] = below;
        }
        (0..suspects.len() as u32)
            .filter(|&radical| suspects[radical as usize])
            .collect()
    }
}
