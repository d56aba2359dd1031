//! Constraints that no order solves one after the other, and constraints on angles: all of them together are solved for all that they
//! determine, over a random point of the rest.
//!
//! The dependent symbols, or the sines and cosines of those that stand in angles, are unknowns of polynomial equations over the prime
//! field. A Gröbner basis decides whether these have finitely many solutions; then all unknowns are polynomials in one element
//! θ, and the tower of the constraints has the equation of θ as its first level. There may be more constraints than symbols: the
//! solutions are those of all.

mod basis;
mod quotient;
mod unknowns;

use rustc_hash::FxHashMap;

use self::quotient::{solutions, NotSolved};
use self::unknowns::{as_scalar, Unknowns};
use super::evaluate::{Failure, Point, Run, Stop};
use super::program::{Generator, Operation, Program};
use super::ring::Ring;
use super::tower::{Element, Tower};
use crate::number::prime_field::{PrimeField, Residue};

/// What the constraints determine jointly.
#[derive(Clone, Debug)]
pub(super) struct Coupled {
    /// For each constraint, whether its symbol itself is an unknown.
    is_unknown: Vec<bool>,
    /// The circles of angles that are dependent symbols and occur as angles only.
    circles: Vec<u32>,
    /// The values that the constraints need.
    closure: Vec<bool>,
}

/// Values that are polynomials in the generator of all solutions, from the constant on.
#[derive(Clone, Debug)]
pub(super) struct Together {
    /// The monic equation of the generator without its leading 1.
    equation: Vec<Residue>,
    /// Whether solutions at which the constraints do not determine their symbols are left out.
    are_regular: bool,
    dependent: Vec<Vec<Residue>>,
    circles: Vec<(u32, Vec<Residue>, Vec<Residue>)>,
    roots: Vec<(u32, Vec<Residue>)>,
}

/// Values of what the constraints determine, in the tower.
pub(super) struct Values {
    pub(super) dependent: Vec<Element>,
    pub(super) circles: FxHashMap<u32, (Element, Element)>,
}

impl Coupled {
    /// What is to be solved jointly; `None` where each constraint in its turn gives its symbol.
    pub(super) fn of(program: &Program, is_in_order: bool) -> Option<Coupled> {
        let count = program.constraints.len();
        let mut closure = vec![false; program.operations.len()];
        for &constraint in &program.constraints {
            for (own, needed) in closure.iter_mut().zip(program.closure(constraint)) {
                *own |= needed;
            }
        }
        let mut is_unknown = vec![false; count];
        let mut turning = Vec::new();
        for (operation, _) in program
            .operations
            .iter()
            .zip(&closure)
            .filter(|(_, &own)| own)
        {
            match operation {
                Operation::Generator(index) => {
                    if let Generator::Dependent(k) = program.generators[*index as usize] {
                        is_unknown[k as usize] = true;
                    }
                }
                Operation::CircleCos(circle) | Operation::CircleSin(circle) => {
                    turning.push(*circle)
                }
                _ => {}
            }
        }
        turning.sort_unstable();
        turning.dedup();
        // Of a symbol that occurs both ways, x + sin x, the angle tells nothing by itself.
        turning.retain(|&circle| {
            let own = program.dependent_circles[circle as usize];
            own.is_some_and(|k| !is_unknown[k as usize])
        });
        let has_own = |k: usize| program.determines[k];
        let is_needed = !turning.is_empty() || !is_in_order || !(0..count).all(has_own);
        is_needed.then_some(Coupled {
            is_unknown,
            circles: turning,
            closure,
        })
    }

    /// All solutions over a point.
    pub(super) fn solve(
        &self,
        program: &Program,
        field: &PrimeField,
        point: &Point,
        negative: &[bool],
    ) -> Result<Option<Together>, Failure> {
        let ring = Unknowns::new(*field, negative, &program.adjoined);
        let free = |k: usize| {
            let is_it = |g: &Generator| matches!(g, Generator::Dependent(j) if *j as usize == k);
            let index = program.generators.iter().position(is_it).unwrap_or(0);
            ring.scalar(
                point
                    .generators
                    .get(index)
                    .copied()
                    .unwrap_or(Residue::ZERO),
            )
        };
        let own = self.is_unknown.iter().enumerate();
        let dependent: Vec<_> = own
            .map(|(k, &is_unknown)| if is_unknown { ring.unknown() } else { free(k) })
            .collect();
        let circles: FxHashMap<u32, _> = self.circles.iter().map(|&c| (c, ring.circle())).collect();
        let mut run = Run::new(program, point, dependent.clone()).with_circles(circles.clone());
        let end = run.advance_over(&ring, program.operations.len(), |value| self.closure[value]);
        let mut beside = Vec::new();
        for (k, &constraint) in program
            .constraints
            .iter()
            .enumerate()
            .filter(|_| end.is_ok())
        {
            let equation = run.get(constraint).clone();
            if program.determines[k] {
                ring.vanishes(equation)
            } else {
                beside.push(equation)
            }
        }
        if ring.is_unsupported() {
            let why = "the constraints have no polynomial equations that are short enough";
            return Err(Failure::Unsupported(why.to_owned()));
        }
        match end {
            Err(Stop::Pole(_)) => return Ok(None),
            Err(stop) => return Err(Failure::Stop(stop)),
            Ok(()) => {}
        }
        let (count, equations, roots) = ring.finished();
        let all = [&equations[..], &beside].concat();
        let found = match solutions(field, count, &all, &equations) {
            Ok(found) => found,
            Err(NotSolved::None) => return Ok(None),
            Err(NotSolved::Infinite) => {
                let why =
                    "the constraints do not determine all the symbols that they are solved for";
                return Err(Failure::Unsupported(why.to_owned()));
            }
            Err(NotSolved::TooLarge) => {
                let why = "the constraints together have too many solutions over a point";
                return Err(Failure::Unsupported(why.to_owned()));
            }
        };
        // Each of these is a number or one unknown.
        let value = |terms: &basis::Terms| match as_scalar(terms) {
            Some(scalar) => vec![scalar],
            None => {
                let own = |k: &usize| terms.first().is_some_and(|(p, _)| p.is_power_of(*k));
                let k = (0..count).find(own);
                k.and_then(|k| found.values.get(k).cloned())
                    .unwrap_or_default()
            }
        };
        Ok(Some(Together {
            dependent: dependent.iter().map(value).collect(),
            circles: self
                .circles
                .iter()
                .filter_map(|c| {
                    circles
                        .get(c)
                        .map(|(cos, sin)| (*c, value(cos), value(sin)))
                })
                .collect(),
            roots: roots
                .iter()
                .map(|(&radical, terms)| (radical, value(terms)))
                .collect(),
            are_regular: found.are_regular,
            equation: found.equation,
        }))
    }

    /// The number of circles with a dependent angle.
    pub(super) fn circles(&self) -> usize {
        self.circles.len()
    }
}

impl Together {
    /// Whether solutions are left out at which the constraints do not determine their symbols.
    pub(super) fn are_regular(&self) -> bool {
        self.are_regular
    }

    /// The values in a tower whose first level is the generator; `None` where the tower becomes too large.
    pub(super) fn values(&self, tower: &Tower<'_>) -> Option<Values> {
        let field = tower.field();
        let scalar = |&c: &Residue| tower.scalar(c);
        let mut equation: Vec<Element> = self.equation.iter().map(scalar).collect();
        equation.push(tower.scalar(field.one()));
        let generator = tower.adjoin(&equation)?;
        let value = |polynomial: &Vec<Residue>| {
            let highest_first = polynomial.iter().rev();
            highest_first.fold(Vec::new(), |sum, c| {
                let mut next = tower.mul(&sum, &generator);
                tower.add_scaled(&mut next, &tower.scalar(field.one()), *c);
                next
            })
        };
        for (radical, root) in &self.roots {
            tower.set_root(*radical, value(root));
        }
        Some(Values {
            dependent: self.dependent.iter().map(value).collect(),
            circles: self
                .circles
                .iter()
                .map(|(c, cos, sin)| (*c, (value(cos), value(sin))))
                .collect(),
        })
    }
}
