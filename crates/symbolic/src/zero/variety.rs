//! Points of the constraints: over a random point of the independent data, the ring of all solutions for the dependent symbols.

use super::coupling::{Coupled, Together, Values};
use super::evaluate::{Failure, Point, Run, Stop};
use super::modular::Parts;
use super::polynomials::Polynomials;
use super::program::{Generator, Program};
use super::rank::{rank_over, Pivots};
use super::ring::Ring;
use super::tower::{Element, Split, Tower};
use crate::number::prime_field::PrimeField;

/// At most so many parts are followed at one point.
const MOST_PARTS: usize = 128;

/// The constraints of a program, in the order in which they are solved.
#[derive(Debug)]
pub(super) struct Variety<'p> {
    program: &'p Program,
    /// For each constraint, the values it needs.
    closures: Vec<Vec<bool>>,
    /// What is solved for jointly, where no order solves it.
    coupled: Option<Coupled>,
    /// The shape of the matrix of outputs.
    rows: usize,
    columns: usize,
}

/// What one tower gives for the dependent symbols.
pub(super) enum Solution {
    Dependent(Values),
    Split(Split),
    /// Nothing at this point.
    None,
}

/// What one tower says.
enum Part {
    /// The rank of the outputs, at so many solutions.
    Rank(usize, Pivots),
    /// A solution of the equations, but not of the constraints.
    Elsewhere,
    /// A denominator vanishes.
    Pole,
    Split(Split),
}

impl<'p> Variety<'p> {
    pub(super) fn new(program: &'p Program, rows: usize, columns: usize) -> Self {
        let closures = program
            .constraints
            .iter()
            .map(|&constraint| program.closure(constraint))
            .collect();
        let mut variety = Self {
            program,
            closures,
            coupled: None,
            rows,
            columns,
        };
        let mut own = variety.closures.iter().enumerate();
        let is_in_order = !own.any(|(k, closure)| variety.uses_later(k, closure));
        variety.coupled = Coupled::of(program, is_in_order);
        variety
    }

    /// What is solved for jointly.
    pub(super) fn coupled(&self) -> Option<&Coupled> {
        self.coupled.as_ref()
    }

    /// All solutions over a point of what is solved for jointly: `Ok(None)` where there is nothing of that kind.
    fn together(
        &self,
        field: &PrimeField,
        point: &Point,
        negative: &[bool],
    ) -> Result<Option<Option<Together>>, Failure> {
        let coupled = self.coupled.as_ref();
        let solve = |own: &Coupled| own.solve(self.program, field, point, negative);
        coupled.map(solve).transpose()
    }

    /// Follows every part of the variety over the point.
    pub(super) fn parts_at(
        &self,
        field: &PrimeField,
        point: &Point,
        negative: &[bool],
    ) -> Result<Parts, Failure> {
        let mut parts = Parts::default();
        let together = match self.together(field, point, negative)? {
            Some(None) => return Ok(parts),
            Some(together) => together,
            None => None,
        };
        parts.are_regular = together.as_ref().is_some_and(Together::are_regular);
        let mut stack: Vec<Vec<Option<Vec<Element>>>> = vec![Vec::new()];
        let mut followed = 0;
        while let Some(prescribed) = stack.pop() {
            followed += 1;
            if followed > MOST_PARTS {
                return Err(Failure::Unsupported(
                    "the constraints have too many components".to_owned(),
                ));
            }
            let tower = Tower::new(*field, negative, &prescribed).adjoining(&self.program.adjoined);
            match self.part(&tower, point, together.as_ref())? {
                Part::Rank(dimension, pivots) => parts.add(dimension, pivots),
                Part::Elsewhere => {}
                Part::Pole => parts.poles += 1,
                Part::Split(Split { level, factors }) => {
                    for factor in factors {
                        let mut next = tower.equations(level);
                        next.push(Some(factor));
                        stack.push(next);
                    }
                }
            }
        }
        Ok(parts)
    }

    /// The dependent symbols at the solutions that one tower stands for.
    pub(super) fn solutions(
        &self,
        tower: &Tower<'_>,
        point: &Point,
        negative: &[bool],
    ) -> Solution {
        let together = match self.together(tower.field(), point, negative) {
            Ok(Some(None)) | Err(_) => return Solution::None,
            Ok(together) => together.flatten(),
        };
        match self.solve(tower, point, together.as_ref()) {
            Ok(Ok(values)) => Solution::Dependent(values),
            Ok(Err(Part::Split(split))) => Solution::Split(split),
            _ => Solution::None,
        }
    }

    fn part(
        &self,
        tower: &Tower<'_>,
        point: &Point,
        together: Option<&Together>,
    ) -> Result<Part, Failure> {
        let outputs = match self.evaluated(tower, point, together)? {
            Ok(outputs) => outputs,
            Err(part) => return Ok(part),
        };
        Ok(match rank_over(tower, self.rows, self.columns, &outputs) {
            Some(pivots) => Part::Rank(tower.dimension(), pivots),
            None => tower.split().map_or(Part::Pole, Part::Split),
        })
    }

    fn evaluated(
        &self,
        tower: &Tower<'_>,
        point: &Point,
        together: Option<&Together>,
    ) -> Result<Result<Vec<Element>, Part>, Failure> {
        let values = match self.solve(tower, point, together)? {
            Ok(values) => values,
            Err(part) => return Ok(Err(part)),
        };
        let run = Run::new(self.program, point, values.dependent);
        let mut run = run.with_circles(values.circles);
        if let Err(stop) = run.advance(tower, self.program.operations.len()) {
            return stopped(tower, stop).map(Err);
        }
        for &constraint in &self.program.constraints {
            if let Some(part) = off_constraint(tower, run.get(constraint)) {
                return Ok(Err(part));
            }
        }
        let outputs = self
            .program
            .outputs
            .iter()
            .map(|&output| run.get(output).clone())
            .collect();
        Ok(Ok(outputs))
    }

    /// What the constraints determine as elements of the tower.
    fn solve(
        &self,
        tower: &Tower<'_>,
        point: &Point,
        together: Option<&Together>,
    ) -> Result<Result<Values, Part>, Failure> {
        match together {
            Some(together) => match together.values(tower) {
                Some(values) => Ok(Ok(values)),
                None => stopped(tower, Stop::NoRoot).map(Err),
            },
            None => {
                let found = self.one_after_the_other(tower, point)?;
                Ok(found.map(|dependent| Values {
                    dependent,
                    circles: Default::default(),
                }))
            }
        }
    }

    /// The dependent symbols as elements of the tower, each from its own constraint.
    fn one_after_the_other(
        &self,
        tower: &Tower<'_>,
        point: &Point,
    ) -> Result<Result<Vec<Element>, Part>, Failure> {
        let mut dependent: Vec<Element> = Vec::new();
        for (k, closure) in self.closures.iter().enumerate() {
            let constraint = self.program.constraints[k];
            let ring = Polynomials::new(tower);
            let mut values: Vec<_> = dependent
                .iter()
                .map(|element| ring.constant(element.clone()))
                .collect();
            values.push(ring.symbol());
            let mut run = Run::new(self.program, point, values);
            let result = run.advance_over(&ring, constraint as usize + 1, |value| closure[value]);
            if ring.is_unsupported() {
                let why = "a nonlinear constraint has no polynomial equation for its symbol";
                return Err(Failure::Unsupported(why.to_owned()));
            }
            if let Err(stop) = result {
                return stopped(tower, stop).map(Err);
            }
            let equation = ring.equation(run.get(constraint));
            match equation.len() {
                // The constraint holds for every value of the symbol.
                0 => dependent.push(tower.scalar(point.generators[self.generator_of(k)])),
                1 => {
                    return Ok(Err(
                        off_constraint(tower, &equation[0]).unwrap_or(Part::Elsewhere)
                    ))
                }
                _ => match tower.adjoin(&equation) {
                    Some(x) => dependent.push(x),
                    None => return stopped(tower, Stop::NoRoot).map(Err),
                },
            }
        }
        Ok(Ok(dependent))
    }

    fn uses_later(&self, k: usize, closure: &[bool]) -> bool {
        self.program.operations.iter().zip(closure).any(|(operation, &needed)| match operation {
            super::program::Operation::Generator(index) if needed => {
                matches!(self.program.generators[*index as usize], Generator::Dependent(j) if j as usize > k)
            }
            _ => false,
        })
    }

    fn generator_of(&self, k: usize) -> usize {
        let is_it = |generator: &Generator| matches!(generator, Generator::Dependent(j) if *j as usize == k);
        self.program.generators.iter().position(is_it).unwrap_or(0)
    }
}

/// What a stop in a tower means: it falls apart, is too large, or the point is refused.
fn stopped(tower: &Tower<'_>, stop: Stop) -> Result<Part, Failure> {
    if tower.is_too_large() {
        let why = "the constraints have too many solutions over a point";
        return Err(Failure::Unsupported(why.to_owned()));
    }
    match (tower.split(), stop) {
        (Some(split), _) => Ok(Part::Split(split)),
        (None, Stop::Pole(_)) => Ok(Part::Pole),
        (None, other) => Err(Failure::Stop(other)),
    }
}

/// `None` if the constraint holds; otherwise the part has no solutions of it, or falls apart.
fn off_constraint(tower: &Tower<'_>, constraint: &Element) -> Option<Part> {
    if tower.is_zero(constraint) {
        return None;
    }
    if tower.invert(constraint).is_some() {
        return Some(Part::Elsewhere);
    }
    Some(tower.split().map_or(Part::Elsewhere, Part::Split))
}
