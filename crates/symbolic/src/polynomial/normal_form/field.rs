//! The generators of a normal form, their relations, and arithmetic modulo the relations.

use dashu_base::Sign;
use dashu_int::IBig;
use rustc_hash::FxHashMap;
use std::cmp::Ordering;

use super::super::budget::{Meter, TooLarge};
use super::super::monomial::Monomial;
use super::super::rational_function::RationalFunction;
use super::super::sparse::Polynomial;
use super::{Options, Stop};
use crate::number::ball::Precision;
use crate::{Expr, Graph, Node};

/// Bits of the enclosures that decide signs of numbers.
const BITS: usize = 256;

/// What a generator is, as far as its relations need to know.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A symbol, π, or a function about which nothing is known.
    Free,
    /// The sine of a base angle (or the hyperbolic sine); `partner` is the cosine.
    Sine {
        /// The generator of the cosine.
        partner: usize,
    },
    /// The cosine of a base angle (or the hyperbolic cosine); `partner` is the sine.
    Cosine {
        /// The generator of the sine.
        partner: usize,
    },
    /// A positive exponential.
    Exponential,
    /// A root of the given order.
    Radical {
        /// q in `ρ^q = R`.
        order: u16,
    },
    /// An absolute value.
    Absolute,
    /// A real algebraic integer: a power of it is a polynomial in it.
    Algebraic,
}

/// A generator: the expression it stands for and its kind.
#[derive(Clone, Debug)]
pub struct Generator {
    /// The expression.
    pub expr: Expr,
    /// The kind.
    pub kind: Kind,
}

/// `generator^order = value`, where the value contains only generators created before, and lower powers of an algebraic integer.
#[derive(Clone, Debug)]
pub(super) struct Relation {
    pub(super) generator: usize,
    pub(super) order: u16,
    pub(super) value: Polynomial,
}

/// Sine and cosine of one base angle, tied by `s² = 1 - c²`, or `s² = c² - 1` for the hyperbolic ones.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pythagoras {
    /// The generator of the sine.
    pub sine: usize,
    /// The generator of the cosine.
    pub cosine: usize,
    /// Whether these are the circular functions.
    pub circular: bool,
}

/// An element of a ℚ-basis of the arguments of sines, or of exponentials.
#[derive(Clone, Debug)]
pub(super) struct BaseArgument {
    pub(super) form: RationalFunction,
    /// The generators belong to the argument divided by this.
    pub(super) subdivision: i64,
    /// Sine and cosine, or twice the exponential.
    pub(super) generators: (usize, usize),
}

/// An even or odd root of a square-free polynomial or of a prime.
#[derive(Clone, Debug)]
pub(super) struct Radical {
    pub(super) radicand: Polynomial,
    pub(super) order: u16,
    pub(super) generator: usize,
}

/// Units found too coarse by earlier attempts, by order of creation.
#[derive(Clone, Debug, Default)]
pub(super) struct Hints {
    pub(super) angles: Vec<i64>,
    pub(super) hyperbolic: Vec<i64>,
    pub(super) exponentials: Vec<i64>,
    pub(super) radicals: Vec<u16>,
}

/// A field of rational functions in generators, modulo their relations.
#[derive(Clone, Debug)]
pub struct Field<'g> {
    pub(super) g: &'g Graph,
    pub(super) options: Options,
    pub(super) meter: Meter,
    pub(super) generators: Vec<Generator>,
    pub(super) index: FxHashMap<Expr, usize>,
    pub(super) relations: Vec<Relation>,
    pub(super) angles: Vec<BaseArgument>,
    pub(super) hyperbolic: Vec<BaseArgument>,
    pub(super) exponentials: Vec<BaseArgument>,
    pub(super) radicals: Vec<Radical>,
    pub(super) absolutes: Vec<(Polynomial, usize)>,
    /// Functions of one or two arguments that are generators, with the forms of their arguments.
    pub(super) opaque: Vec<(crate::Function, Vec<RationalFunction>, usize)>,
    /// Polynomials known to be non-negative.
    pub(super) nonnegative: Vec<Polynomial>,
    pub(super) hints: Hints,
}

impl<'g> Field<'g> {
    /// A field with the symbols of `es` as generators, ordered by name.
    pub(super) fn new(g: &'g Graph, es: &[Expr], options: Options) -> Field<'g> {
        let meter = Meter::new(options.budget);
        let mut field = Field {
            g,
            options,
            meter,
            generators: Vec::new(),
            index: FxHashMap::default(),
            relations: Vec::new(),
            angles: Vec::new(),
            hyperbolic: Vec::new(),
            exponentials: Vec::new(),
            radicals: Vec::new(),
            absolutes: Vec::new(),
            opaque: Vec::new(),
            nonnegative: Vec::new(),
            hints: Hints::default(),
        };
        field.add_symbols(es);
        field
    }

    /// Forgets everything but the hints and the work already done.
    pub(super) fn restart(&mut self, es: &[Expr]) {
        let (hints, meter) = (std::mem::take(&mut self.hints), self.meter.clone());
        *self = Field {
            hints,
            meter,
            ..Field::new(self.g, es, self.options.clone())
        };
    }

    fn add_symbols(&mut self, es: &[Expr]) {
        let mut roots = es.to_vec();
        roots.extend_from_slice(&self.options.positive);
        roots.extend_from_slice(&self.options.base_angles);
        for symbol in self.g.symbols_in(&roots) {
            self.add_generator(self.g.symbol_expr(symbol), Kind::Free);
        }
    }

    /// The generators, by index.
    pub fn generators(&self) -> &[Generator] {
        &self.generators
    }

    /// The generator that stands for an expression, if there is one.
    pub fn generator_of(&self, e: Expr) -> Option<usize> {
        self.index.get(&e).copied()
    }

    /// The graph of the expressions.
    pub fn graph(&self) -> &'g Graph {
        self.g
    }

    /// The meter on which all work in this field is counted.
    pub fn meter(&self) -> &Meter {
        &self.meter
    }

    /// The pairs of sine and cosine.
    pub fn pythagoras(&self) -> Vec<Pythagoras> {
        let pairs = |table: &[BaseArgument], circular| -> Vec<Pythagoras> {
            let pair = |a: &BaseArgument| Pythagoras {
                sine: a.generators.0,
                cosine: a.generators.1,
                circular,
            };
            table.iter().map(pair).collect()
        };
        let mut all = pairs(&self.angles, true);
        all.extend(pairs(&self.hyperbolic, false));
        all
    }

    /// The number of base angles.
    pub fn base_angle_count(&self) -> usize {
        self.angles.len()
    }

    /// Whether fractions of arguments of the expressions had to be taken as base angles.
    pub fn divides_angles(&self) -> bool {
        self.angles.iter().any(|a| a.subdivision > 1)
    }

    /// The value of the square of a generator that is algebraic of order two.
    pub fn square_of(&self, generator: usize) -> Option<&Polynomial> {
        let relation = self.relations.iter().find(|r| r.generator == generator)?;
        (relation.order == 2).then_some(&relation.value)
    }

    /// The polynomials that vanish by the relations, each with the generator that it determines by those created before.
    ///
    /// # Errors
    /// [`TooLarge`] when they exceed the budget.
    pub fn relations(&self) -> Result<Vec<(usize, Polynomial)>, TooLarge> {
        let relation = |r: &Relation| {
            let power = Polynomial::generator(r.generator).pow(u32::from(r.order), &self.meter)?;
            Ok((r.generator, power.sub(&r.value)))
        };
        self.relations.iter().map(relation).collect()
    }

    /// The argument of a generator that is a function of one argument.
    pub fn argument_of(&self, generator: usize) -> Option<Expr> {
        match self.g.node(self.generators.get(generator)?.expr) {
            Node::Apply { arguments, .. } => arguments.first().copied(),
            _ => None,
        }
    }

    /// numerator / denominator modulo the relations; `None` when the denominator vanishes.
    ///
    /// # Errors
    /// [`TooLarge`] when the result or the work for it exceeds the budget.
    pub fn quotient(
        &self,
        numerator: Polynomial,
        denominator: Polynomial,
    ) -> Result<Option<RationalFunction>, TooLarge> {
        match self.fraction(numerator, denominator) {
            Ok(f) => Ok(Some(f)),
            Err(Stop::TooLarge(limit)) => Err(limit),
            Err(Stop::Undefined | Stop::Refine) => Ok(None),
        }
    }

    /// The polynomial with even powers of a cosine replaced through the sine.
    ///
    /// # Errors
    /// [`TooLarge`] when the result or the work for it exceeds the budget.
    pub fn by_sine(&self, p: &Polynomial, pair: &Pythagoras) -> Result<Polynomial, TooLarge> {
        let s2 = Polynomial::generator(pair.sine).pow(2, &self.meter)?;
        let one = Polynomial::one();
        let c2 = if pair.circular {
            one.sub(&s2)
        } else {
            one.add(&s2)
        };
        let mut result = Polynomial::zero();
        for (exponent, coefficient) in p.coefficients_in(pair.cosine) {
            let even = c2.pow(u32::from(exponent / 2), &self.meter)?;
            let odd =
                Polynomial::generator(pair.cosine).pow(u32::from(exponent % 2), &self.meter)?;
            let part = coefficient
                .mul(&even, &self.meter)?
                .mul(&odd, &self.meter)?;
            result = result.add(&part);
        }
        Ok(result)
    }

    /// Elementary steps spent so far.
    pub fn spent(&self) -> u64 {
        self.meter.spent()
    }

    pub(super) fn add_generator(&mut self, expr: Expr, kind: Kind) -> usize {
        let generator = self.generators.len();
        self.generators.push(Generator { expr, kind });
        self.index.insert(expr, generator);
        generator
    }

    pub(super) fn relate(&mut self, generator: usize, order: u16, value: Polynomial) {
        self.relations.push(Relation {
            generator,
            order,
            value,
        });
    }

    /// The polynomial with every algebraic generator below the order of its relation.
    pub(super) fn reduce(&self, p: Polynomial) -> Result<Polynomial, Stop> {
        let mut p = p;
        for relation in self.relations.iter().rev() {
            // More than once where lower powers of the generator stand in its value.
            while p.degree_in(relation.generator) >= relation.order {
                p = self.reduce_by(&p, relation)?;
            }
        }
        Ok(p)
    }

    fn reduce_by(&self, p: &Polynomial, relation: &Relation) -> Result<Polynomial, Stop> {
        let (a, q) = (relation.generator, relation.order);
        // Coefficients by quotient of the exponent, then Horner's scheme in the value of a^q.
        let mut by_quotient: Vec<Polynomial> = Vec::new();
        for (exponent, coefficient) in p.coefficients_in(a) {
            let quotient = usize::from(exponent / q);
            if by_quotient.len() <= quotient {
                by_quotient.resize(quotient + 1, Polynomial::zero());
            }
            let power = Polynomial::term(Monomial::power(a, exponent % q), IBig::ONE);
            let part = coefficient.mul(&power, &self.meter)?;
            by_quotient[quotient] = by_quotient[quotient].add(&part);
        }
        let mut result = Polynomial::zero();
        for part in by_quotient.iter().rev() {
            result = result.mul(&relation.value, &self.meter)?.add(part);
        }
        Ok(result)
    }

    /// numerator / denominator modulo the relations, in lowest terms as far as polynomials show.
    pub(super) fn fraction(&self, n: Polynomial, d: Polynomial) -> Result<RationalFunction, Stop> {
        let (n, d) = (self.reduce(n)?, self.reduce(d)?);
        RationalFunction::new(n, d, &self.meter)?.ok_or(Stop::Undefined)
    }

    fn normalize(&self, f: RationalFunction) -> Result<RationalFunction, Stop> {
        let high = |p: &Polynomial| {
            self.relations
                .iter()
                .any(|r| p.degree_in(r.generator) >= r.order)
        };
        if high(f.numerator()) || high(f.denominator()) {
            return self.fraction(f.numerator().clone(), f.denominator().clone());
        }
        Ok(f)
    }

    pub(super) fn add(
        &self,
        a: &RationalFunction,
        b: &RationalFunction,
    ) -> Result<RationalFunction, Stop> {
        self.normalize(a.add(b, &self.meter)?)
    }

    pub(super) fn sub(
        &self,
        a: &RationalFunction,
        b: &RationalFunction,
    ) -> Result<RationalFunction, Stop> {
        self.normalize(a.sub(b, &self.meter)?)
    }

    pub(super) fn mul(
        &self,
        a: &RationalFunction,
        b: &RationalFunction,
    ) -> Result<RationalFunction, Stop> {
        self.normalize(a.mul(b, &self.meter)?)
    }

    pub(super) fn div(
        &self,
        a: &RationalFunction,
        b: &RationalFunction,
    ) -> Result<RationalFunction, Stop> {
        let quotient = a.div(b, &self.meter)?.ok_or(Stop::Undefined)?;
        self.normalize(quotient)
    }

    pub(super) fn pow(&self, a: &RationalFunction, n: i64) -> Result<RationalFunction, Stop> {
        let algebraic =
            |p: &Polynomial| self.relations.iter().any(|r| p.degree_in(r.generator) > 0);
        if n.unsigned_abs() <= 2 || !(algebraic(a.numerator()) || algebraic(a.denominator())) {
            return self.normalize(a.pow(n, &self.meter)?.ok_or(Stop::Undefined)?);
        }
        // Reducing after each squaring keeps powers of sines and radicals short.
        let (mut result, mut rest) = (RationalFunction::one(), n.unsigned_abs());
        let mut square = if n < 0 {
            a.reciprocal().ok_or(Stop::Undefined)?
        } else {
            a.clone()
        };
        loop {
            if rest & 1 == 1 {
                result = self.mul(&result, &square)?;
            }
            rest >>= 1;
            if rest == 0 {
                return Ok(result);
            }
            square = self.mul(&square, &square)?;
        }
    }

    /// The sum of many, grouped by denominator so that few gcds are needed.
    pub(super) fn sum(&self, parts: Vec<RationalFunction>) -> Result<RationalFunction, Stop> {
        let mut groups: Vec<(Polynomial, Polynomial)> = Vec::new();
        for part in parts {
            match groups.iter_mut().find(|(d, _)| d == part.denominator()) {
                Some((_, n)) => *n = n.add(part.numerator()),
                None => groups.push((part.denominator().clone(), part.numerator().clone())),
            }
        }
        groups.sort_by_key(|(d, _)| d.len());
        let mut total = RationalFunction::zero();
        for (d, n) in groups {
            let part = RationalFunction::new(n, d, &self.meter)?.ok_or(Stop::Undefined)?;
            total = total.add(&part, &self.meter)?;
        }
        self.normalize(total)
    }

    /// Whether two forms are equal as elements of the field.
    pub(super) fn equal(&self, a: &RationalFunction, b: &RationalFunction) -> Result<bool, Stop> {
        Ok(a == b || self.sub(a, b)?.is_zero())
    }

    /// A generator as a form.
    pub(super) fn generator(&self, index: usize) -> RationalFunction {
        Polynomial::generator(index).into()
    }

    /// Whether the polynomial is non-negative wherever the expression is defined, as far as signs of terms show.
    pub(super) fn is_nonnegative(&self, p: &Polynomial) -> bool {
        if self.nonnegative.contains(p) {
            return true;
        }
        let shows = p.terms().iter().all(|(monomial, coefficient)| {
            coefficient.sign() == Sign::Positive
                && monomial
                    .iter()
                    .all(|(g, e)| e % 2 == 0 || self.generator_is_nonnegative(g))
        });
        shows || self.number_is_nonnegative(p)
    }

    /// Whether a polynomial in algebraic integers, and other numbers, is enclosed above zero.
    fn number_is_nonnegative(&self, p: &Polynomial) -> bool {
        let generators = p.generators();
        let is_algebraic = |&g: &usize| self.generators[g].kind == Kind::Algebraic;
        let e = self.polynomial_expression(p);
        generators.iter().any(is_algebraic)
            && self.g.symbols_in(&[e]).is_empty()
            && self
                .g
                .enclose(&[e], &Precision::new(BITS), &|_| None)
                .is_ok_and(|found| found[0].sign() == Some(Ordering::Greater))
    }

    fn generator_is_nonnegative(&self, generator: usize) -> bool {
        match self.generators[generator].kind {
            Kind::Exponential | Kind::Absolute => true,
            Kind::Radical { order } => order % 2 == 0,
            _ => self.nonnegative.contains(&Polynomial::generator(generator)),
        }
    }
}
