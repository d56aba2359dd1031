//! Roots of proportional radicands: where `R_i = k² R_j` for a positive rational k, `√R_i = k √R_j`.
//!
//! That two radicands are proportional is guessed from two points over one prime. The second root is then replaced, and
//! `R_i - k² R_j` becomes a further output: if all outputs are zero so is this one, and the replacement was right.

use dashu_base::Abs;

use super::super::evaluate::{Point, Run};
use super::super::program::{Operation, Program, Value};
use super::super::ring::Scalars;
use super::{decide, Outcome, Plan, Session};
use crate::number::prime_field::PrimeField;
use crate::number::random::Random;
use crate::number::reconstruct;
use crate::rational::Rational;

/// Points looked for before proportional radicands are given up.
const DRAWS: usize = 200;

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
}

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
            Some((field, self.radicands(&field, &point, &roots)?))
        })?;
        let second = (0..DRAWS).find_map(|_| {
            let point = Point::random(
                self.program,
                &field,
                &mut random,
                &self.sizes.cuts,
                self.plan.parametrization,
            )?;
            self.radicands(&field, &point, &roots)
        })?;
        let mut found: Vec<Relation> = Vec::new();
        for (i, root) in roots.iter().enumerate() {
            if !self.suspects.contains(&root.radical) {
                continue;
            }
            let earlier = roots
                .iter()
                .enumerate()
                .filter(|(_, of)| of.place < root.place);
            found.extend(earlier.into_iter().find_map(|(j, of)| {
                if found.iter().any(|known| known.root.radical == of.radical) {
                    return None;
                }
                let ratio = |values: &[_]| -> Option<_> {
                    Some(field.mul(values[i], field.inv(values[j])?))
                };
                let common = ratio(&first).filter(|&r| Some(r) == ratio(&second))?;
                let factor = reconstruct::rational(&field, field.sqrt(common)?)?.abs();
                Some(Relation {
                    root: *root,
                    of: *of,
                    factor,
                })
            }));
        }
        (!found.is_empty()).then_some(found)
    }

    /// The radicands at a point where all roots exist.
    fn radicands(
        &self,
        field: &PrimeField,
        point: &Point,
        roots: &[Root],
    ) -> Option<Vec<crate::number::prime_field::Residue>> {
        let negative = vec![false; self.program.radicals as usize];
        let ring = Scalars {
            field: *field,
            negative: &negative,
        };
        let mut run = Run::new(self.program, point, Vec::new());
        run.advance(&ring, self.program.prefix).ok()?;
        Some(roots.iter().map(|root| *run.get(root.radicand)).collect())
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
            factors: Box::new([relation.of.place]),
        };
        // It is no longer chosen.
        program.adjoined[relation.root.radical as usize] = true;
        program.operations.push(Operation::Sum {
            constant: zero,
            terms: Box::new([
                (relation.root.radicand, one),
                (relation.of.radicand, square),
            ]),
        });
        program.outputs.push(program.operations.len() as Value - 1);
    }
    program
}
