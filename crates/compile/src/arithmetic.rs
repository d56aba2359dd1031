//! Lowering of sums, products and powers.

use crate::emit::Emitter;
use crate::lower::{Fault, Lowerer};
use crate::pairs::Element;
use crate::program::{Binary, Fused, Register, Unary};
use chetaev_symbolic::{rational, Expr, Node, Rational};

/// Terms of a sum, or factors of a product, that are folded one after the other; longer ones are halved pairwise,
/// which keeps rounding and chains of dependent instructions short.
const RUN: usize = 8;

/// Larger exponents are left to the power function, whose error does not grow with the exponent.
const LARGEST_CHAIN: u64 = 64;

/// An exponent that needs products and at most one square root: `halves / 2`.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct Exponent {
    halves: i64,
}

impl Exponent {
    /// `None` where the power function is needed.
    pub(crate) fn of(exponent: &Rational) -> Option<Exponent> {
        let halves = rational::to_i64(&(exponent * rational::integer(2)))?;
        let fits = halves != 0 && halves.unsigned_abs() <= 2 * LARGEST_CHAIN;
        fits.then_some(Exponent { halves })
    }

    /// The positive exponent of the reciprocal; `None` if the exponent is positive already.
    pub(crate) fn reciprocal(self) -> Option<Exponent> {
        (self.halves < 0).then_some(Exponent {
            halves: -self.halves,
        })
    }
}

/// `± a · b`, or `± a`.
#[derive(Clone, Copy, Debug)]
struct Term {
    negative: bool,
    a: Register,
    b: Option<Register>,
}

impl Term {
    fn plain(a: Register) -> Term {
        Term {
            negative: false,
            a,
            b: None,
        }
    }
}

/// The factors of a product by when they are known and on which side of the fraction bar they stand.
#[derive(Default)]
struct Factors {
    static_above: Vec<Register>,
    static_below: Vec<Register>,
    above: Vec<Register>,
    below: Vec<Register>,
}

impl Lowerer<'_> {
    pub(crate) fn sum(
        &mut self,
        e: Expr,
        constant: &Rational,
        terms: &[(Expr, Rational)],
    ) -> Result<Register, Fault> {
        let mut hoisted = Vec::new();
        if !constant.is_zero() {
            hoisted.push(self.number_term(constant));
        }
        let whole = || vec![(0..terms.len() as u32).collect()];
        let parts: Vec<Vec<u32>> = self.sums.parts(e).map_or_else(whole, <[_]>::to_vec);
        let mut sum: Option<Register> = None;
        for (number, part) in parts.iter().enumerate() {
            let mut items = Vec::with_capacity(part.len() + 1);
            items.extend(sum.map(Term::plain));
            for &place in part {
                let (e, coefficient) = &terms[place as usize];
                let term = self.term(*e, coefficient)?;
                match self.is_static_term(term) {
                    true => hoisted.push(term),
                    false => items.push(term),
                }
            }
            if number + 1 == parts.len() {
                self.join_hoisted(&hoisted, &mut items);
            }
            sum = Some(self.emitter.sum(&items));
        }
        Ok(sum.unwrap_or_else(|| self.emitter.sum(&hoisted)))
    }

    /// Puts what depends on parameters only before the other terms of a sum, as one term.
    fn join_hoisted(&mut self, hoisted: &[Term], items: &mut Vec<Term>) {
        match hoisted {
            [] => {}
            _ if items.is_empty() => items.extend(hoisted),
            [single] => items.insert(0, *single),
            _ => {
                let a = self.emitter.sum(hoisted);
                items.insert(0, Term::plain(a));
            }
        }
    }

    fn is_static_term(&self, term: Term) -> bool {
        self.emitter.is_static(term.a) && term.b.is_none_or(|b| self.emitter.is_static(b))
    }

    fn number_term(&mut self, value: &Rational) -> Term {
        Term {
            negative: rational::is_negative(value),
            a: self.emitter.number(&rational::abs(value)),
            b: None,
        }
    }

    /// `coefficient · e` as a term of a sum.
    fn term(&mut self, e: Expr, coefficient: &Rational) -> Result<Term, Fault> {
        if self.is_inlined_product(e) {
            return self.product_term(e, coefficient, false);
        }
        let a = self.scalar(e)?;
        let negative = rational::is_negative(coefficient);
        let magnitude = rational::abs(coefficient);
        let b = if magnitude.is_one() {
            None
        } else {
            Some(self.emitter.number(&magnitude))
        };
        Ok(Term { negative, a, b })
    }

    pub(crate) fn product(&mut self, e: Expr) -> Result<Register, Fault> {
        let one = self.one.clone();
        let term = self.product_term(e, &one, true)?;
        Ok(self.emitter.sum(&[term]))
    }

    /// The product node `e` times `scale`. With `signed` the sign goes into the hoisted factor if there is one.
    fn product_term(&mut self, e: Expr, scale: &Rational, signed: bool) -> Result<Term, Fault> {
        let Node::Product {
            coefficient,
            factors: nodes,
        } = self.graph.node(e)
        else {
            return Err(Fault::Malformed);
        };
        let mut factors = Factors::default();
        for &node in nodes {
            self.sort_factor(node, &mut factors)?;
        }
        if let Some(elements) = self.pairs.of_product(e).map(<[u32]>::to_vec) {
            let registers = elements.iter().map(|&index| self.element(index));
            factors.above = registers.collect::<Result<_, Fault>>()?;
        }
        let coefficient = coefficient * scale;
        let mut negative = rational::is_negative(&coefficient);
        let magnitude = rational::abs(&coefficient);
        let has_static = !magnitude.is_one()
            || !factors.static_above.is_empty()
            || !factors.static_below.is_empty();
        let leading = if signed && has_static {
            negative = false;
            coefficient
        } else {
            magnitude
        };
        if !leading.is_one() {
            let number = self.emitter.number(&leading);
            factors.static_above.insert(0, number);
        }
        let (a, b) = self.assemble(&factors);
        Ok(Term { negative, a, b })
    }

    /// The register of an element of a product.
    fn element(&mut self, index: u32) -> Result<Register, Fault> {
        match self.pairs.element(index) {
            Element::Factor(e) => self.scalar(e),
            Element::Pair(a, b) => {
                let (a, b) = (self.element(a)?, self.element(b)?);
                Ok(self.emitter.mul(a, b))
            }
        }
    }

    fn sort_factor(&mut self, node: Expr, factors: &mut Factors) -> Result<(), Fault> {
        let (register, is_below) = match self.inlined_denominator(node) {
            Some((base, exponent)) => {
                let base = self.scalar(base)?;
                (self.emitter.power(base, exponent), true)
            }
            None => (self.scalar(node)?, false),
        };
        let list = match (self.emitter.is_static(register), is_below) {
            (true, false) => &mut factors.static_above,
            (true, true) => &mut factors.static_below,
            (false, false) => &mut factors.above,
            (false, true) => &mut factors.below,
        };
        list.push(register);
        Ok(())
    }

    /// The product as `a` or as `a · b` with the last multiplication left to the caller.
    fn assemble(&mut self, factors: &Factors) -> (Register, Option<Register>) {
        let hoisted = self.hoisted_factor(factors);
        let emitter = &mut self.emitter;
        if !factors.below.is_empty() {
            let mut above = factors.above.clone();
            above.extend(hoisted);
            let above = match emitter.product(&above) {
                Some(above) => above,
                None => emitter.number(&self.one),
            };
            let below = emitter.product(&factors.below).unwrap_or(above);
            return (emitter.binary(Binary::Div, above, below), None);
        }
        match (hoisted, &factors.above[..]) {
            (Some(hoisted), above) => match emitter.product(above) {
                Some(above) => (above, Some(hoisted)),
                None => (hoisted, None),
            },
            (None, [rest @ .., last]) => match emitter.product(rest) {
                Some(rest) => (rest, Some(*last)),
                None => (*last, None),
            },
            (None, []) => (emitter.number(&self.one), None),
        }
    }

    /// What of the product depends on parameters only; `None` if that is 1.
    fn hoisted_factor(&mut self, factors: &Factors) -> Option<Register> {
        let above = self.emitter.product(&factors.static_above);
        let Some(below) = self.emitter.product(&factors.static_below) else {
            return above;
        };
        let above = match above {
            Some(above) => above,
            None => self.emitter.number(&self.one),
        };
        Some(self.emitter.binary(Binary::Div, above, below))
    }

    pub(crate) fn power(&mut self, base: Expr, exponent: Expr) -> Result<Register, Fault> {
        let a = self.scalar(base)?;
        let Some(number) = self.graph.as_number(exponent) else {
            let b = self.scalar(exponent)?;
            return Ok(self.emitter.binary(Binary::Pow, a, b));
        };
        let Some(simple) = Exponent::of(number) else {
            let b = self.emitter.number(number);
            return Ok(self.emitter.binary(Binary::Pow, a, b));
        };
        let Some(below) = simple.reciprocal() else {
            return Ok(self.emitter.power(a, simple));
        };
        let below = self.emitter.power(a, below);
        let one = self.emitter.number(&self.one);
        Ok(self.emitter.binary(Binary::Div, one, below))
    }
}

impl Emitter {
    /// `base ^ exponent` for a positive exponent.
    fn power(&mut self, base: Register, exponent: Exponent) -> Register {
        let mut result = None;
        if exponent.halves % 2 != 0 {
            result = Some(self.unary(Unary::Sqrt, base));
        }
        let mut square = base;
        let mut rest = exponent.halves / 2;
        while rest > 0 {
            if rest % 2 != 0 {
                result = Some(match result {
                    Some(result) => self.mul(result, square),
                    None => square,
                });
            }
            rest /= 2;
            if rest > 0 {
                square = self.mul(square, square);
            }
        }
        result.unwrap_or(base)
    }

    /// The product of all in order, halved pairwise if long; `None` for none.
    fn product(&mut self, factors: &[Register]) -> Option<Register> {
        let mut runs: Vec<Register> = Vec::with_capacity(factors.len().div_ceil(RUN));
        for run in factors.chunks(RUN) {
            let product = run[1..].iter().fold(run[0], |a, &b| self.mul(a, b));
            runs.push(product);
        }
        self.combine(runs, Binary::Mul)
    }

    /// The sum of all in order, halved pairwise if long; there is at least one term.
    fn sum(&mut self, terms: &[Term]) -> Register {
        let runs: Vec<Register> = terms.chunks(RUN).map(|run| self.run(run)).collect();
        match self.combine(runs, Binary::Add) {
            Some(sum) => sum,
            None => self.number(&rational::integer(0)),
        }
    }

    fn combine(&mut self, mut runs: Vec<Register>, operation: Binary) -> Option<Register> {
        while runs.len() > 1 {
            runs = runs
                .chunks(2)
                .map(|pair| match *pair {
                    [a, b] => self.binary(operation, a, b),
                    _ => pair[0],
                })
                .collect();
        }
        runs.first().copied()
    }

    /// Folds a run of terms, from a term that needs no instruction of its own if there is one.
    fn run(&mut self, terms: &[Term]) -> Register {
        let plain = terms.iter().position(|t| !t.negative && t.b.is_none());
        if let Some(first) = plain {
            return self.fold(terms, &[first], terms[first].a);
        }
        let product = terms.iter().position(|t| !t.negative);
        let Some(first) = product else {
            let value = self.magnitude(terms[0]);
            let start = self.unary(Unary::Neg, value);
            return self.fold(terms, &[0], start);
        };
        let subtracted = terms.iter().position(|t| t.negative && t.b.is_none());
        if let (Some(second), Some(b)) = (subtracted, terms[first].b) {
            let start = self.fused(Fused::MulSub, terms[first].a, b, terms[second].a);
            return self.fold(terms, &[first, second], start);
        }
        let start = self.magnitude(terms[first]);
        self.fold(terms, &[first], start)
    }

    fn magnitude(&mut self, term: Term) -> Register {
        match term.b {
            Some(b) => self.mul(term.a, b),
            None => term.a,
        }
    }

    fn fold(&mut self, terms: &[Term], taken: &[usize], start: Register) -> Register {
        let mut sum = start;
        for (i, term) in terms.iter().enumerate() {
            if taken.contains(&i) {
                continue;
            }
            let known = match term.b {
                Some(b) => self.find_product(term.a, b),
                None => Some(term.a),
            };
            sum = match (known, term.b, term.negative) {
                (Some(value), _, false) => self.binary(Binary::Add, sum, value),
                (Some(value), _, true) => self.binary(Binary::Sub, sum, value),
                (None, Some(b), false) => self.fused(Fused::MulAdd, term.a, b, sum),
                (None, Some(b), true) => self.fused(Fused::NegMulAdd, term.a, b, sum),
                (None, None, _) => sum,
            };
        }
        sum
    }
}
