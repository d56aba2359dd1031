//! Expressions as source text; what is a local variable is written by its name.

use super::helpers::Helpers;
use super::language::Language;
use super::literal::{self, Literal};
use super::local::{self, Locals};
use super::power::{PowerForm, LONGEST_CHAIN};
use super::term::{self, Strength, Text};
use crate::node::{Expr, Function, Node, Symbol};
use crate::rational::{self, Rational};
use rustc_hash::FxHashMap;

/// A term with whether it is subtracted.
pub(super) type SignedText = (bool, Text);

/// Writes one expression after the other. The depth of its recursion is bounded, since every part that is not short
/// is a local variable.
pub(super) struct Writer<'a> {
    pub(super) locals: &'a Locals<'a>,
    pub(super) language: Language,
    pub(super) helpers: &'a mut Helpers,
    /// The names of symbols.
    pub(super) symbols: FxHashMap<Symbol, String>,
    /// The names of local variables, of matrices and of solutions.
    pub(super) names: FxHashMap<Expr, String>,
}

impl Writer<'_> {
    /// What is written where `e` is used.
    pub(super) fn value(&mut self, e: Expr) -> Text {
        match self.names.get(&e) {
            Some(name) => Text::atom(name.clone()),
            None => self.written_out(e),
        }
    }

    /// The text that computes `e`.
    pub(super) fn written_out(&mut self, e: Expr) -> Text {
        let locals = self.locals;
        match locals.g.node(e) {
            Node::Number(value) => self.number(value),
            Node::Pi => {
                self.helpers.pi = true;
                Text::atom("PI")
            }
            Node::Algebraic(own) => {
                let value = own.to_f64();
                signed((
                    value < 0.0,
                    Text::atom(format!("{:?}", value.abs())).literal(),
                ))
            }
            Node::Symbol(symbol) => {
                Text::atom(self.symbols.get(symbol).cloned().unwrap_or_default())
            }
            Node::Sum { constant, terms } => term::sum(&self.terms(constant, terms)),
            Node::Product {
                coefficient,
                factors,
            } => signed(self.product(coefficient, &locals.sorted_factors(factors))),
            Node::Power { .. } => signed(self.product(&Rational::ONE, &[e])),
            Node::Apply {
                function,
                arguments,
            } => self.application(*function, arguments),
            Node::Entry { of, index } => Text::atom(format!("{}[{index}]", self.value(*of).text)),
            // Statements of their own, known by their names.
            Node::Matrix { .. } | Node::Solve { .. } => Text::atom(""),
        }
    }

    fn number(&mut self, value: &Rational) -> Text {
        let text = match literal::magnitude(value, self.language) {
            Literal::Whole(text) => Text::atom(text).literal(),
            Literal::Quotient(p, q) => Text::new(format!("{p}/{q}"), Strength::Quotient).literal(),
        };
        signed((rational::is_negative(value), text))
    }

    /// The terms of a sum; the first is not subtracted if any is not.
    pub(super) fn terms(
        &mut self,
        constant: &Rational,
        terms: &[(Expr, Rational)],
    ) -> Vec<SignedText> {
        let sorted = self.locals.sorted_terms(terms);
        let mut out: Vec<SignedText> = Vec::with_capacity(terms.len() + 1);
        for (term, coefficient) in sorted {
            let scaled = match self.locals.g.node(term) {
                Node::Product {
                    coefficient: inner,
                    factors,
                } if !self.names.contains_key(&term) => {
                    let factors = self.locals.sorted_factors(factors);
                    self.product(&(coefficient * inner), &factors)
                }
                _ => self.product(coefficient, &[term]),
            };
            out.push(scaled);
        }
        if !constant.is_zero() {
            let magnitude = self.number(&rational::abs(constant));
            out.push((rational::is_negative(constant), magnitude));
        }
        if let Some(place) = out.iter().position(|(negative, _)| !negative) {
            out[..=place].rotate_right(1);
        }
        out
    }

    /// The product of a number and factors: its sign and its magnitude.
    fn product(&mut self, coefficient: &Rational, factors: &[Expr]) -> SignedText {
        let (above, below) = self.fraction(coefficient, factors);
        let magnitude = term::quotient(&above, &below);
        (rational::is_negative(coefficient), magnitude)
    }

    /// Numerator and denominator of the magnitude of a product.
    pub(super) fn fraction(
        &mut self,
        coefficient: &Rational,
        factors: &[Expr],
    ) -> (Vec<Text>, Vec<Text>) {
        let (mut above, mut below) = (Vec::new(), Vec::new());
        match literal::magnitude(coefficient, self.language) {
            Literal::Whole(one) if one == "1.0" => {}
            Literal::Whole(number) => above.push(Text::atom(number).literal()),
            Literal::Quotient(p, q) => {
                if p != "1.0" {
                    above.push(Text::atom(p).literal());
                }
                below.push(Text::atom(q).literal());
            }
        }
        for &factor in factors {
            let (is_inverse, text) = self.factor(factor);
            let side = if is_inverse { &mut below } else { &mut above };
            side.push(text);
        }
        (above, below)
    }

    /// A factor, or what to divide by instead.
    fn factor(&mut self, factor: Expr) -> (bool, Text) {
        match self.locals.g.node(factor) {
            Node::Power { base, exponent } if !self.names.contains_key(&factor) => {
                self.power(*base, *exponent)
            }
            Node::Apply {
                function,
                arguments,
            } if !self.names.contains_key(&factor) => match self.divisor(*function, arguments) {
                Some(divisor) => (true, divisor),
                None => (false, self.value(factor)),
            },
            _ => (false, self.value(factor)),
        }
    }

    /// `base ^ exponent`, or its reciprocal to divide by.
    fn power(&mut self, base: Expr, exponent: Expr) -> (bool, Text) {
        let Some(form) = PowerForm::new(self.locals.g, exponent) else {
            let exponent = self.value(exponent).text;
            let base = self.value(base);
            return (false, self.language.power(&base, &exponent));
        };
        let mut factors = Vec::new();
        match form.whole {
            0 => {}
            count @ 1..=LONGEST_CHAIN => {
                let base = self.value(base);
                factors.extend(std::iter::repeat_n(base, count as usize));
            }
            large => {
                let base = self.value(base);
                factors.push(self.whole_power(&base, large));
            }
        }
        if form.has_root {
            let known = self.locals.square_root(base);
            let known = known.filter(|root| self.names.contains_key(root));
            factors.push(match known {
                Some(root) => self.value(root),
                None => {
                    let base = self.value(base);
                    self.language.square_root(&base)
                }
            });
        }
        (form.is_inverse, term::product(&factors))
    }

    fn whole_power(&mut self, base: &Text, exponent: u32) -> Text {
        let name = match self.language {
            Language::C => {
                self.helpers.power = true;
                "chetaev_power"
            }
            Language::Rust => "powi",
        };
        self.language.call(name, base, Some(&exponent.to_string()))
    }

    /// What a secant, cosecant or cotangent is the reciprocal of.
    fn divisor(&mut self, function: Function, arguments: &[Expr]) -> Option<Text> {
        if let Some(known) = self.locals.divisor(function, arguments) {
            return Some(self.value(known));
        }
        let name = self.language.function(local::reciprocal(function)?)?;
        let argument = self.value(*arguments.first()?);
        Some(self.language.call(name, &argument, None))
    }

    fn application(&mut self, function: Function, arguments: &[Expr]) -> Text {
        if let Some(divisor) = self.divisor(function, arguments) {
            return term::quotient(&[], &[divisor]);
        }
        let mut arguments = arguments.iter().map(|&a| self.value(a));
        let first = arguments.next().unwrap_or_else(|| Text::atom("0.0"));
        let second = arguments.next();
        let second = second.as_ref().map(|text| text.text.as_str());
        match self.language.function(function) {
            Some(name) => self.language.call(name, &first, second),
            // The sign is the only function without a name that is no reciprocal.
            None => {
                self.helpers.sign = true;
                Text::atom(format!("chetaev_sign({})", first.text))
            }
        }
    }
}

/// The text with its sign.
pub(super) fn signed((negative, text): SignedText) -> Text {
    if negative {
        text.negative()
    } else {
        text
    }
}
