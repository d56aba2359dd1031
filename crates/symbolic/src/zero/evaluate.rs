//! Running a program at a point of a ring over a prime field.

use crate::meter;
use rustc_hash::FxHashMap;

use super::program::{Operation, Program, Value};
use super::ring::{NoSquareRoot, Ring};
use crate::number::prime_field::{PrimeField, Residue};
use crate::number::random::Random;
use crate::rational::Rational;

/// Units of [`meter`] for an operation of a program.
const OPERATION: u64 = 4;

/// Values for everything that is free in a program.
#[derive(Clone, Debug)]
pub(super) struct Point {
    /// One residue for each generator (ignored for dependent symbols).
    pub(super) generators: Vec<Residue>,
    /// Cosine and sine for each circle.
    pub(super) circles: Vec<(Residue, Residue)>,
    /// The powers of a primitive root of unity; just 1 if none is needed.
    unity: Vec<Residue>,
    /// The constants of the program.
    constants: Vec<Residue>,
    /// Values taken as free generators.
    cuts: FxHashMap<Value, Residue>,
}

/// Why a run stopped before its end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Stop {
    /// A division by zero (or by a zero divisor), or a singular matrix.
    Pole(Value),
    /// The radicand of this radical is no square.
    NonSquare(u32),
    /// A radicand is zero, or an odd root does not exist or is not unique.
    NoRoot,
}

/// Why a point gives nothing.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Failure {
    /// The point is refused.
    Stop(Stop),
    /// No point can be used.
    Unsupported(String),
}

/// What the points are drawn with.
#[derive(Clone, Copy, Debug)]
pub(super) struct Parametrization {
    /// Circles as (1 − u²)/(1 + u²), 2u/(1 + u²), turned by the rational rotation of this parameter if there is one.
    pub(super) rotation: Option<(i64, i64)>,
}

impl Point {
    /// A random point; `None` when the prime divides the denominator of a constant.
    pub(super) fn random(
        program: &Program,
        field: &PrimeField,
        random: &mut Random,
        cuts: &[Value],
        parametrization: Parametrization,
    ) -> Option<Self> {
        let nonzero = |random: &mut Random| loop {
            let value = field.random(random);
            if !value.is_zero() {
                return value;
            }
        };
        let constants = program
            .constants
            .iter()
            .map(|c| field.from_rational(c))
            .collect::<Option<Vec<_>>>()?;
        let mut circles = Vec::with_capacity(program.circles as usize);
        for _ in 0..program.circles {
            circles.push(circle_point(field, random, parametrization)?);
        }
        let unity = match program.order_of_unity {
            0 | 1 => vec![field.one()],
            order => {
                let zeta = field.root_of_unity(order, random)?;
                let mut powers = vec![field.one()];
                for _ in 1..order {
                    powers.push(field.mul(powers[powers.len() - 1], zeta));
                }
                powers
            }
        };
        Some(Self {
            generators: program.generators.iter().map(|_| nonzero(random)).collect(),
            circles,
            unity,
            constants,
            cuts: cuts.iter().map(|&value| (value, nonzero(random))).collect(),
        })
    }

    /// Takes the root of unity of another point of the same field: the constants in which it occurs are then the same.
    pub(super) fn share_unity(&mut self, other: &Point) {
        self.unity.clone_from(&other.unity);
    }

    /// cos(2πk/N) = (ζ^k + ζ^(−k))/2.
    fn unity_cos(&self, field: &PrimeField, k: u64) -> Option<Residue> {
        let (up, down) = self.conjugate_powers(k);
        Some(field.mul(field.add(up, down), field.inv(field.from_u64(2))?))
    }

    /// sin(2πk/N) = (ζ^k − ζ^(−k))/(2i) with i = ζ^(N/4).
    fn unity_sin(&self, field: &PrimeField, k: u64) -> Option<Residue> {
        let (up, down) = self.conjugate_powers(k);
        let i = self.unity[self.unity.len() / 4];
        let divisor = field.mul(field.from_u64(2), i);
        Some(field.mul(field.sub(up, down), field.inv(divisor)?))
    }

    fn conjugate_powers(&self, k: u64) -> (Residue, Residue) {
        let order = self.unity.len();
        let k = k as usize % order;
        (self.unity[k], self.unity[(order - k) % order])
    }
}

/// A random point of the circle c² + s² = 1.
fn circle_point(
    field: &PrimeField,
    random: &mut Random,
    parametrization: Parametrization,
) -> Option<(Residue, Residue)> {
    let coordinates = |u: Residue| {
        let square = field.mul(u, u);
        let reciprocal = field.inv(field.add(field.one(), square))?;
        Some((
            field.mul(field.sub(field.one(), square), reciprocal),
            field.mul(field.add(u, u), reciprocal),
        ))
    };
    let point = (0..8).find_map(|_| coordinates(field.random(random)))?;
    let Some((numerator, denominator)) = parametrization.rotation else {
        return Some(point);
    };
    let turn = Rational::from_parts_signed(numerator.into(), denominator.max(1).into());
    let (c, s) = coordinates(field.from_rational(&turn)?)?;
    let cosine = field.sub(field.mul(point.0, c), field.mul(point.1, s));
    let sine = field.add(field.mul(point.0, s), field.mul(point.1, c));
    Some((cosine, sine))
}

/// A run in progress: the values found so far.
pub(super) struct Run<'p, R: Ring> {
    program: &'p Program,
    point: &'p Point,
    values: Vec<R::Element>,
    vectors: FxHashMap<Value, Vec<R::Element>>,
    factors: FxHashMap<Value, R::Factors>,
    /// Values of the dependent symbols.
    dependent: Vec<R::Element>,
    /// Cosine and sine of circles that are not those of the point.
    circles: FxHashMap<u32, (R::Element, R::Element)>,
}

impl<'p, R: Ring> Run<'p, R> {
    pub(super) fn new(program: &'p Program, point: &'p Point, dependent: Vec<R::Element>) -> Self {
        Self {
            program,
            point,
            values: Vec::with_capacity(program.operations.len()),
            vectors: FxHashMap::default(),
            factors: FxHashMap::default(),
            dependent,
            circles: FxHashMap::default(),
        }
    }

    /// The run with these cosines and sines in the place of those of the point.
    pub(super) fn with_circles(self, circles: FxHashMap<u32, (R::Element, R::Element)>) -> Self {
        Self { circles, ..self }
    }

    /// Runs up to, not including, operation `end`.
    pub(super) fn advance(&mut self, ring: &R, end: usize) -> Result<(), Stop> {
        self.advance_over(ring, end, |_| true)
    }

    /// The same, leaving out what is not wanted (and must not be used by what is).
    pub(super) fn advance_over(
        &mut self,
        ring: &R,
        end: usize,
        wanted: impl Fn(usize) -> bool,
    ) -> Result<(), Stop> {
        while self.values.len() < end {
            let value = self.values.len() as Value;
            meter::spend(OPERATION);
            let element = match self.point.cuts.get(&value) {
                Some(&cut) => ring.scalar(cut),
                None if wanted(value as usize) => self.step(ring, value)?,
                None => ring.scalar(Residue::ZERO),
            };
            self.values.push(element);
        }
        Ok(())
    }

    /// A value already computed.
    pub(super) fn get(&self, value: Value) -> &R::Element {
        &self.values[value as usize]
    }

    fn step(&mut self, ring: &R, value: Value) -> Result<R::Element, Stop> {
        let field = ring.field();
        let pole = Stop::Pole(value);
        let constant = |index: &u32| self.point.constants[*index as usize];
        let program = self.program;
        Ok(match &program.operations[value as usize] {
            Operation::Number(index) => ring.scalar(constant(index)),
            Operation::Generator(index) => self.generator(ring, *index),
            Operation::CircleCos(circle) => match self.circles.get(circle) {
                Some((cos, _)) => cos.clone(),
                None => ring.scalar(self.point.circles[*circle as usize].0),
            },
            Operation::CircleSin(circle) => match self.circles.get(circle) {
                Some((_, sin)) => sin.clone(),
                None => ring.scalar(self.point.circles[*circle as usize].1),
            },
            Operation::UnityCos(k) => ring.scalar(self.point.unity_cos(field, *k).ok_or(pole)?),
            Operation::UnitySin(k) => ring.scalar(self.point.unity_sin(field, *k).ok_or(pole)?),
            Operation::Sum {
                constant: start,
                terms,
            } => {
                let mut sum = ring.scalar(constant(start));
                for (term, coefficient) in terms {
                    ring.add_scaled(&mut sum, self.get(*term), constant(coefficient));
                }
                sum
            }
            Operation::Product {
                coefficient,
                factors,
            } => {
                let mut product = ring.scalar(constant(coefficient));
                for factor in factors {
                    product = ring.mul(&product, self.get(*factor));
                }
                product
            }
            Operation::Power { base, exponent } => {
                ring.power(self.get(*base), exponent).ok_or(pole)?
            }
            Operation::SquareRoot { radicand, radical } => ring
                .square_root(self.get(*radicand), *radical)
                .map_err(|reason| match reason {
                    NoSquareRoot::NonSquare => Stop::NonSquare(*radical),
                    NoSquareRoot::Exceptional => Stop::NoRoot,
                })?,
            Operation::OddRoot { radicand, degree } => ring
                .odd_root(self.get(*radicand), *degree)
                .ok_or(Stop::NoRoot)?,
            Operation::Matrix { size, entries } => {
                let matrix = entries
                    .iter()
                    .map(|entry| self.get(*entry).clone())
                    .collect();
                let factors = ring.factorize(*size as usize, matrix).ok_or(pole)?;
                self.factors.insert(value, factors);
                ring.scalar(Residue::ZERO)
            }
            Operation::Solve { matrix, rhs } => {
                let rhs: Vec<R::Element> = rhs.iter().map(|b| self.get(*b).clone()).collect();
                let factors = self.factors.get(matrix).ok_or(pole)?;
                let solution = ring.solve(factors, &rhs);
                self.vectors.insert(value, solution);
                ring.scalar(Residue::ZERO)
            }
            Operation::Entry { of, index } => self
                .vectors
                .get(of)
                .and_then(|vector| vector.get(*index as usize))
                .cloned()
                .ok_or(pole)?,
        })
    }

    fn generator(&self, ring: &R, index: u32) -> R::Element {
        use super::program::Generator;
        match self.program.generators[index as usize] {
            Generator::Dependent(constraint) => match self.dependent.get(constraint as usize) {
                Some(element) => element.clone(),
                None => ring.scalar(self.point.generators[index as usize]),
            },
            _ => ring.scalar(self.point.generators[index as usize]),
        }
    }
}
