//! Roots of related radicands: where `R_i = k² w² R_j` for a positive rational k and a product w of values known to be
//! positive, `√R_i = k w √R_j`.
//!
//! That two radicands are related is guessed from two points over one prime. The second root is then replaced, and
//! `R_i - k² w² R_j` becomes a further output: if all outputs are zero so is this one, and the replacement was right.

use dashu_base::Abs;
use rustc_hash::FxHashMap;

use super::super::evaluate::{Point, Run};
use super::super::program::{Operation, Program, Value};
use super::super::ring::Scalars;
use super::{decide, Outcome, Plan, Session};
use crate::number::prime_field::{PrimeField, Residue};
use crate::number::random::Random;
use crate::number::reconstruct;
use crate::rational::{self, Rational};

/// Points looked for before proportional radicands are given up.
const DRAWS: usize = 200;

/// Bits of numerator or denominator of a guessed factor; those of a fraction modulo a prime have up to 31.
const MOST_BITS: usize = 22;

/// Where the root of a radical stands, and its radicand.
#[derive(Clone, Copy, Debug)]
struct Root {
    radical: u32,
    place: Value,
    radicand: Value,
}

/// A root that is a multiple of an earlier one.
#[derive(Clone, Debug)]
struct Relation {
    root: Root,
    of: Root,
    factor: Rational,
    /// At most three positive values, which stand before the root.
    by: Vec<Value>,
}

/// The values of the prefix at a point.
type Values = Vec<Option<Residue>>;

impl Session<'_> {
    /// The outcome with suspects replaced by multiples of other roots, if all outputs are zero then.
    pub(super) fn with_related_roots(&self) -> Option<Outcome> {
        if self.suspects.is_empty() || self.variety.is_some() || self.plan.rows != 1 {
            return None;
        }
        let relations = self.relations()?;
        let program = replaced(self.program, &relations);
        let plan = Plan {
            columns: program.outputs.len(),
            ..*self.plan
        };
        match decide(&program, &plan) {
            Outcome::Found(finding) if finding.maximum == 0 => Some(Outcome::Found(finding)),
            _ => None,
        }
    }

    /// The relations that two points show; `None` where there are none.
    fn relations(&self) -> Option<Vec<Relation>> {
        let roots = roots(self.program);
        let mut random = Random::stream(self.plan.seed, u64::MAX - 1);
        let (field, first) = (0..DRAWS).find_map(|_| {
            let (field, point) = self.draw(&mut random)?;
            Some((field, self.prefix_at(&field, &point)?))
        })?;
        let second = (0..DRAWS).find_map(|_| {
            let point = Point::random(
                self.program,
                &field,
                &mut random,
                &self.sizes.cuts,
                self.plan.parametrization,
            )?;
            self.prefix_at(&field, &point)
        })?;
        let guess = Guess::new(field, first, second, &self.program.positive);
        let mut found: Vec<Relation> = Vec::new();
        for root in &roots {
            if !self.suspects.contains(&root.radical) {
                continue;
            }
            let earlier = roots.iter().filter(|of| of.place < root.place);
            found.extend(earlier.into_iter().find_map(|of| {
                match found.iter().any(|known| known.root.radical == of.radical) {
                    true => None,
                    false => guess.relation(*root, *of),
                }
            }));
        }
        (!found.is_empty()).then_some(found)
    }

    /// The values of the prefix at a point where all roots exist.
    fn prefix_at(&self, field: &PrimeField, point: &Point) -> Option<Values> {
        let negative = vec![false; self.program.radicals as usize];
        let ring = Scalars {
            field: *field,
            negative: &negative,
        };
        let mut run = Run::new(self.program, point, Vec::new());
        run.advance(&ring, self.program.prefix).ok()?;
        let scalar = |place: usize| match self.program.operations[place] {
            Operation::Matrix { .. } | Operation::Solve { .. } => None,
            _ => Some(*run.get(place as Value)),
        };
        Some((0..self.program.prefix).map(scalar).collect())
    }
}

/// What two points over one prime show.
struct Guess {
    field: PrimeField,
    first: Values,
    second: Values,
    /// Positive values, each with what it is multiplied with from the first point to the second, squared.
    changes: Vec<(Value, Residue)>,
    by_change: FxHashMap<u64, Value>,
}

impl Guess {
    fn new(field: PrimeField, first: Values, second: Values, positive: &[Value]) -> Guess {
        let mut guess = Guess {
            field,
            first,
            second,
            changes: Vec::new(),
            by_change: FxHashMap::default(),
        };
        for &value in positive {
            let Some(change) = guess.change(value) else {
                continue;
            };
            let square = field.mul(change, change);
            guess.changes.push((value, square));
            guess.by_change.entry(field.to_u64(square)).or_insert(value);
        }
        guess
    }

    fn change(&self, value: Value) -> Option<Residue> {
        let at = |values: &Values| values.get(value as usize).copied().flatten();
        Some(
            self.field
                .mul(at(&self.second)?, self.field.inv(at(&self.first)?)?),
        )
    }

    /// How the radicands are related, if the points show it.
    fn relation(&self, root: Root, of: Root) -> Option<Relation> {
        let field = &self.field;
        let change = field.mul(
            self.change(root.radicand)?,
            field.inv(self.change(of.radicand)?)?,
        );
        let before = |value: &Value| *value < root.place;
        let one = |change: Residue| {
            let value = self.by_change.get(&field.to_u64(change)).copied();
            value.filter(before)
        };
        let by = if change == field.one() {
            Vec::new()
        } else if let Some(value) = one(change) {
            vec![value]
        } else {
            self.changes.iter().find_map(|&(value, square)| {
                let other = one(field.mul(change, field.inv(square)?))?;
                before(&value).then(|| vec![value, other])
            })?
        };
        let (factor, constant) = self.factor(root, of, &by)?;
        let by = by.into_iter().chain(constant).collect();
        Some(Relation {
            root,
            of,
            factor,
            by,
        })
    }

    /// k of `√R_i = k w √R_j` with w the product of `by`; the root of a number may belong to it.
    fn factor(&self, root: Root, of: Root, by: &[Value]) -> Option<(Rational, Option<Value>)> {
        let field = &self.field;
        let at = |value: Value| self.first.get(value as usize).copied().flatten();
        let divided = |ratio: Residue, value: Value| {
            let inverse = field.inv(at(value)?)?;
            Some(field.mul(ratio, field.mul(inverse, inverse)))
        };
        let whole = field.mul(at(root.radicand)?, field.inv(at(of.radicand)?)?);
        let ratio = by
            .iter()
            .try_fold(whole, |ratio, &value| divided(ratio, value))?;
        let short = |ratio: Residue| {
            let factor = reconstruct::rational(field, field.sqrt(ratio)?)?.abs();
            // Most residues are some fraction of long numbers: only a short one is no accident.
            (rational::bit_length(&factor) <= MOST_BITS).then_some(factor)
        };
        if let Some(factor) = short(ratio) {
            return Some((factor, None));
        }
        let constants = self
            .changes
            .iter()
            .filter(|(_, square)| *square == field.one());
        constants
            .filter(|(value, _)| *value < root.place)
            .find_map(|&(value, _)| Some((short(divided(ratio, value)?)?, Some(value))))
    }
}

/// The chosen roots, which all stand in the prefix.
fn roots(program: &Program) -> Vec<Root> {
    let operations = program.operations.iter().enumerate();
    operations
        .filter_map(|(place, operation)| match operation {
            Operation::SquareRoot { radicand, radical } if !program.adjoined[*radical as usize] => {
                Some(Root {
                    radical: *radical,
                    place: place as Value,
                    radicand: *radicand,
                })
            }
            _ => None,
        })
        .collect()
}

fn replaced(program: &Program, relations: &[Relation]) -> Program {
    let mut program = program.clone();
    for relation in relations {
        let mut constant = |value: Rational| {
            program.constants.push(value);
            program.constants.len() as u32 - 1
        };
        let (factor, zero, one) = (
            constant(relation.factor.clone()),
            constant(Rational::ZERO),
            constant(Rational::ONE),
        );
        let square = constant(-(&relation.factor * &relation.factor));
        program.operations[relation.root.place as usize] = Operation::Product {
            coefficient: factor,
            factors: [&relation.by[..], &[relation.of.place]].concat().into(),
        };
        // It is no longer chosen.
        program.adjoined[relation.root.radical as usize] = true;
        let twice = [&relation.by[..], &relation.by[..]].concat();
        program.operations.push(Operation::Product {
            coefficient: one,
            factors: [&twice[..], &[relation.of.radicand]].concat().into(),
        });
        let multiple = program.operations.len() as Value - 1;
        program.operations.push(Operation::Sum {
            constant: zero,
            terms: Box::new([(relation.root.radicand, one), (multiple, square)]),
        });
        program.outputs.push(program.operations.len() as Value - 1);
    }
    program
}
