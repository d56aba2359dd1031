//! The presentation tree: what is on the page, decided once for all printers.
//!
//! Its depth is bounded by [`share`](super::share), so printers may recurse on it.

use crate::node::{Expr, Function};
use crate::number::algebraic::AlgebraicInteger;
use crate::rational::{self, Rational};
use dashu_base::UnsignedAbs;
use dashu_int::IBig;

/// How tightly a formula holds together, from weakest to strongest.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(crate) enum Strength {
    Sum,
    Sign,
    Product,
    Power,
    Atom,
}

/// A summand with its sign taken out.
#[derive(Clone, Debug)]
pub(crate) struct Term {
    pub(crate) negative: bool,
    pub(crate) value: Formula,
}

impl Term {
    /// What stands before the term at this place of a sum.
    pub(crate) fn sign(&self, place: usize) -> &'static str {
        match (place, self.negative) {
            (0, false) => "",
            (0, true) => "-",
            (_, false) => " + ",
            (_, true) => " - ",
        }
    }
}

/// A formula as it is written.
#[derive(Clone, Debug)]
pub(crate) enum Formula {
    /// A non-negative integer, in decimal digits.
    Integer(String),
    Pi,
    /// A real zero of a polynomial.
    Algebraic(Box<AlgebraicInteger>),
    /// A name of the model or of a definition, with its number of primes.
    Symbol {
        name: String,
        order: u32,
    },
    /// Something that a definition names; replaced by its name in a finished document.
    Reference(Reference),
    Sum(Vec<Term>),
    /// At least two factors; none is a sign, a product or a fraction, except a numeric fraction in front.
    Product(Vec<Formula>),
    Fraction(Box<Formula>, Box<Formula>),
    Negative(Box<Formula>),
    Power(Box<Formula>, Box<Formula>),
    Root {
        index: u32,
        radicand: Box<Formula>,
    },
    Apply {
        function: Function,
        arguments: Vec<Formula>,
    },
    Matrix {
        columns: usize,
        entries: Vec<Formula>,
    },
}

/// What a definition names.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(crate) enum Reference {
    /// An intermediate result.
    Shared(Expr),
    /// A component of the solution of a linear system.
    Unknown { solve: Expr, index: u32 },
}

impl Formula {
    pub(crate) fn integer(digits: impl ToString) -> Formula {
        Formula::Integer(digits.to_string())
    }

    pub(crate) fn one() -> Formula {
        Formula::integer(1)
    }

    pub(crate) fn symbol(name: &str) -> Formula {
        Formula::Symbol {
            name: name.to_string(),
            order: 0,
        }
    }

    /// Sign and absolute value of a number.
    pub(crate) fn number(value: &Rational) -> (bool, Formula) {
        let magnitude = Formula::integer(value.numerator().unsigned_abs());
        let formula = if value.is_int() {
            magnitude
        } else {
            let below = Formula::integer(value.denominator());
            Formula::Fraction(Box::new(magnitude), Box::new(below))
        };
        (rational::is_negative(value), formula)
    }

    /// The polynomial of an algebraic integer, in x.
    pub(crate) fn polynomial(own: &AlgebraicInteger) -> Formula {
        let term = |(n, c): (usize, &IBig)| {
            let (negative, number) = Formula::number(&Rational::from(c.clone()));
            let x = || Formula::symbol("x");
            let power = match n {
                0 => {
                    return Term {
                        negative,
                        value: number,
                    }
                }
                1 => x(),
                _ => Formula::Power(Box::new(x()), Box::new(Formula::integer(n))),
            };
            let value = if number.is_digit("1") {
                power
            } else {
                Formula::Product(vec![number, power])
            };
            Term { negative, value }
        };
        let list = own.polynomial();
        let all = list.iter().enumerate().rev();
        Formula::Sum(all.filter(|(_, c)| **c != IBig::ZERO).map(term).collect())
    }

    pub(crate) fn signed(negative: bool, value: Formula) -> Formula {
        if negative {
            Formula::Negative(Box::new(value))
        } else {
            value
        }
    }

    /// The product of formulas that are no products themselves; 1 for none. Roots of integers are one root of their product, as √2 √5 is √10.
    pub(crate) fn product(factors: Vec<Formula>) -> Formula {
        let mut factors = joined_roots(factors);
        match factors.len() {
            0 => Formula::one(),
            1 => factors.swap_remove(0),
            _ => Formula::Product(factors),
        }
    }

    pub(crate) fn is_digit(&self, digits: &str) -> bool {
        matches!(self, Formula::Integer(own) if own == digits)
    }

    pub(crate) fn is_integer(&self) -> bool {
        matches!(self, Formula::Integer(_))
    }

    /// A fraction of two integers.
    pub(crate) fn is_ratio(&self) -> bool {
        matches!(self, Formula::Fraction(top, bottom) if top.is_integer() && bottom.is_integer())
    }

    /// A fraction that can be written on one line without parentheses, such as x²/2.
    pub(crate) fn is_flat_fraction(&self) -> bool {
        match self {
            Formula::Fraction(top, bottom) => {
                top.strength() >= Strength::Product
                    && bottom.strength() >= Strength::Power
                    && !top.is_tall()
                    && !bottom.is_tall()
            }
            _ => false,
        }
    }

    pub(crate) fn strength(&self) -> Strength {
        match self {
            Formula::Sum(_) => Strength::Sum,
            Formula::Negative(_) => Strength::Sign,
            Formula::Product(_) | Formula::Fraction(..) => Strength::Product,
            Formula::Power(..) => Strength::Power,
            _ => Strength::Atom,
        }
    }

    /// Whether it is higher than a line of text, so that its parentheses have to grow.
    pub(crate) fn is_tall(&self) -> bool {
        match self {
            Formula::Fraction(..) | Formula::Matrix { .. } => true,
            Formula::Integer(_)
            | Formula::Pi
            | Formula::Algebraic(_)
            | Formula::Symbol { .. }
            | Formula::Reference(_) => false,
            Formula::Sum(terms) => terms.iter().any(|term| term.value.is_tall()),
            Formula::Product(factors) => factors.iter().any(Formula::is_tall),
            Formula::Negative(inner)
            | Formula::Power(inner, _)
            | Formula::Root {
                radicand: inner, ..
            } => inner.is_tall(),
            Formula::Apply { arguments, .. } => arguments.iter().any(Formula::is_tall),
        }
    }

    /// The first sign on the line is a digit.
    pub(crate) fn begins_with_digit(&self) -> bool {
        match self {
            Formula::Integer(_) => true,
            Formula::Product(factors) => factors.first().is_some_and(Formula::begins_with_digit),
            Formula::Fraction(top, _) => top.begins_with_digit(),
            Formula::Power(base, _) => base.begins_with_digit(),
            Formula::Root { index, radicand } => *index != 2 && radicand.begins_with_digit(),
            _ => false,
        }
    }

    /// `self · factor`, with sign, keeping the form of products and fractions.
    pub(crate) fn times(self, factor: Formula) -> (bool, Formula) {
        match self {
            Formula::Negative(inner) => {
                let (negative, value) = inner.times(factor);
                (!negative, value)
            }
            one if one.is_digit("1") => (false, factor),
            Formula::Product(mut factors) => {
                factors.push(factor);
                (false, Formula::Product(factors))
            }
            Formula::Fraction(top, bottom) if !bottom.is_integer() => {
                let (negative, top) = top.times(factor);
                (negative, Formula::Fraction(Box::new(top), bottom))
            }
            other => (false, Formula::Product(vec![other, factor])),
        }
    }

    /// Replaces every reference.
    pub(crate) fn resolve(&mut self, name: &dyn Fn(Reference) -> String) {
        match self {
            Formula::Reference(reference) => *self = Formula::symbol(&name(*reference)),
            Formula::Integer(_) | Formula::Pi | Formula::Algebraic(_) | Formula::Symbol { .. } => {}
            Formula::Sum(terms) => terms.iter_mut().for_each(|term| term.value.resolve(name)),
            Formula::Fraction(a, b) | Formula::Power(a, b) => {
                a.resolve(name);
                b.resolve(name);
            }
            Formula::Negative(inner)
            | Formula::Root {
                radicand: inner, ..
            } => inner.resolve(name),
            Formula::Product(parts)
            | Formula::Apply {
                arguments: parts, ..
            }
            | Formula::Matrix { entries: parts, .. } => {
                parts.iter_mut().for_each(|part| part.resolve(name));
            }
        }
    }
}

/// Factors, those that are roots of integers of one order as one.
fn joined_roots(factors: Vec<Formula>) -> Vec<Formula> {
    let mut joined: Vec<Formula> = Vec::new();
    for own in factors {
        let place = joined
            .iter()
            .position(|known| of_roots(known, &own).is_some());
        match place.and_then(|at| Some((at, of_roots(&joined[at], &own)?))) {
            Some((at, root)) => joined[at] = root,
            None => joined.push(own),
        }
    }
    joined
}

/// The product of two roots of integers of one order; `None` for other factors.
fn of_roots(a: &Formula, b: &Formula) -> Option<Formula> {
    let parts = |own: &Formula| match own {
        Formula::Root { index, radicand } => match &**radicand {
            Formula::Integer(digits) => Some((*index, digits.parse::<IBig>().ok()?)),
            _ => None,
        },
        _ => None,
    };
    let ((index, a), (other, b)) = (parts(a)?, parts(b)?);
    (index == other).then(|| Formula::Root {
        index,
        radicand: Box::new(Formula::integer(a * b)),
    })
}
