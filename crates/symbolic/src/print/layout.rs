//! From the graph to presentation trees: fractions gathered from negative powers, signs pulled out, square roots,
//! factors and terms in a person's order.

use super::formula::{Formula, Reference, Term};
use super::order::{Order, TermKey};
use super::share::Plan;
use crate::graph::Graph;
use crate::node::{Expr, Node};
use crate::rational::{self, Rational};

/// A term with its key and coefficient; no term for the constant.
type SortedTerm<'t> = (TermKey, Option<Expr>, &'t Rational);

/// Lays out one formula after the other; recursion is bounded by the plan.
pub(crate) struct Layout<'a> {
    pub(crate) g: &'a Graph,
    pub(crate) plan: &'a Plan,
    pub(crate) order: &'a Order<'a>,
    /// What the formulas laid out so far refer to, in the order of reading.
    pub(crate) references: Vec<Reference>,
    /// What is being defined, and therefore written out.
    pub(crate) defining: Option<Expr>,
}

impl Layout<'_> {
    /// The formula of `e`; what has a name is a reference.
    pub(crate) fn formula(&mut self, e: Expr) -> Formula {
        let (negative, value) = self.signed(e);
        Formula::signed(negative, value)
    }

    /// The formula of `e`, written out even if it has a name.
    pub(crate) fn definition(&mut self, e: Expr) -> Formula {
        self.defining = Some(e);
        let (negative, value) = self.written_out(e);
        self.defining = None;
        Formula::signed(negative, value)
    }

    fn is_named(&self, e: Expr) -> bool {
        self.plan.is_named(e) && self.defining != Some(e)
    }

    fn reference(&mut self, reference: Reference) -> Formula {
        self.references.push(reference);
        Formula::Reference(reference)
    }

    fn signed(&mut self, e: Expr) -> (bool, Formula) {
        if self.is_named(e) {
            (false, self.reference(Reference::Shared(e)))
        } else {
            self.written_out(e)
        }
    }

    fn written_out(&mut self, e: Expr) -> (bool, Formula) {
        let g = self.g;
        let formula = match g.node(e) {
            Node::Number(value) => return Formula::number(value),
            Node::Product {
                coefficient,
                factors,
            } => return self.product(coefficient, factors),
            Node::Power { .. } => return self.product(&Rational::ONE, &[e]),
            Node::Pi => Formula::Pi,
            Node::Algebraic(own) => Formula::Algebraic(own.clone()),
            Node::Symbol(symbol) => Formula::Symbol {
                name: g.symbol_name(*symbol).to_string(),
                order: g.symbol_order(*symbol),
            },
            Node::Sum { constant, terms } => self.sum(constant, terms, false),
            Node::Apply {
                function,
                arguments,
            } => Formula::Apply {
                function: *function,
                arguments: arguments.iter().map(|&a| self.formula(a)).collect(),
            },
            Node::Matrix {
                columns, entries, ..
            } => self.matrix(*columns as usize, entries),
            Node::Solve { rhs, .. } => Formula::Matrix {
                columns: 1,
                entries: (0..rhs.len() as u32)
                    .map(|index| self.reference(Reference::Unknown { solve: e, index }))
                    .collect(),
            },
            Node::Entry { of, index } => self.reference(Reference::Unknown {
                solve: *of,
                index: *index,
            }),
        };
        (false, formula)
    }

    pub(crate) fn matrix(&mut self, columns: usize, entries: &[Expr]) -> Formula {
        Formula::Matrix {
            columns,
            entries: entries.iter().map(|&e| self.formula(e)).collect(),
        }
    }

    fn sorted_terms<'t>(
        &self,
        constant: &'t Rational,
        terms: &'t [(Expr, Rational)],
    ) -> Vec<SortedTerm<'t>> {
        let mut sorted: Vec<SortedTerm<'t>> = terms
            .iter()
            .map(|(term, c)| (self.order.term_key(*term, self.plan), Some(*term), c))
            .collect();
        if !constant.is_zero() {
            sorted.push((TermKey::default(), None, constant));
        }
        sorted.sort_by(|a, b| a.0.cmp(&b.0));
        sorted
    }

    /// The sum, or its negative where `opposite`.
    fn sum(&mut self, constant: &Rational, terms: &[(Expr, Rational)], opposite: bool) -> Formula {
        let mut sorted = self.sorted_terms(constant, terms);
        let is_negative = |t: &SortedTerm| rational::is_negative(t.2) != opposite;
        // A sum that can begin without a minus does.
        if sorted.first().is_some_and(is_negative) {
            let better = sorted
                .iter()
                .position(|t| !is_negative(t) && sorted[0].0.is_exchangeable_with(&t.0));
            if let Some(place) = better {
                sorted[..=place].rotate_right(1);
            }
        }
        let terms = sorted
            .into_iter()
            .map(|(_, term, coefficient)| {
                // The sign first: whether a factor is written with the opposite sign depends on it.
                let coefficient = match opposite {
                    true => -coefficient,
                    false => coefficient.clone(),
                };
                let (negative, value) = match term {
                    Some(term) => self.scaled(&coefficient, term),
                    None => Formula::number(&coefficient),
                };
                Term { negative, value }
            })
            .collect();
        Formula::Sum(terms)
    }

    /// Whether `factor` is an odd power of a sum that reads better with the opposite sign, such as cos θ - 1.
    fn is_better_negated(&self, factor: Expr) -> bool {
        if self.is_named(factor) {
            return false;
        }
        let (base, exponent) = self.g.base_exponent(factor);
        let exponent = self.g.as_number(exponent).and_then(rational::to_i64);
        match self.g.node(base) {
            Node::Sum { constant, terms } if exponent.is_some_and(|n| n % 2 != 0) => {
                !self.is_named(base)
                    && self
                        .sorted_terms(constant, terms)
                        .first()
                        .is_some_and(|first| rational::is_negative(first.2))
            }
            _ => false,
        }
    }

    /// `coefficient · term`.
    fn scaled(&mut self, coefficient: &Rational, term: Expr) -> (bool, Formula) {
        match self.g.node(term) {
            Node::Product {
                coefficient: inner,
                factors,
            } if !self.is_named(term) => self.product(&(coefficient * inner), factors),
            _ => self.product(coefficient, &[term]),
        }
    }

    fn product(&mut self, coefficient: &Rational, factors: &[Expr]) -> (bool, Formula) {
        let mut sorted = factors.to_vec();
        sorted.sort_by_cached_key(|&factor| self.order.factor_key(factor, self.plan));
        let negative = rational::is_negative(coefficient);
        let flipped = sorted
            .iter()
            .copied()
            .find(|&factor| negative && self.is_better_negated(factor));
        let (above, below): (Vec<Expr>, Vec<Expr>) = sorted
            .into_iter()
            .partition(|&factor| !self.is_divisor(factor));
        let above: Vec<Formula> = above.into_iter().map(|f| self.factor(f, flipped)).collect();
        let below: Vec<Formula> = below.into_iter().map(|f| self.factor(f, flipped)).collect();
        let numerator = Formula::integer(rational::abs(coefficient).numerator());
        let denominator = Formula::integer(coefficient.denominator());
        let formula = if below.is_empty() && !coefficient.is_int() && leads_with_ratio(&above) {
            let ratio = Formula::Fraction(Box::new(numerator), Box::new(denominator));
            let mut all = vec![ratio];
            all.extend(above);
            Formula::product(all)
        } else {
            let top = with_number(numerator, above);
            let bottom = with_number(denominator, below);
            if bottom.is_digit("1") {
                top
            } else {
                Formula::Fraction(Box::new(top), Box::new(bottom))
            }
        };
        (negative != flipped.is_some(), formula)
    }

    fn is_divisor(&self, factor: Expr) -> bool {
        match self.g.node(factor) {
            Node::Power { exponent, .. } if !self.is_named(factor) => self
                .g
                .as_number(*exponent)
                .is_some_and(rational::is_negative),
            _ => false,
        }
    }

    /// A factor without the sign of its numeric exponent; the base of `flipped` is written with the opposite sign.
    fn factor(&mut self, factor: Expr, flipped: Option<Expr>) -> Formula {
        if self.is_named(factor) {
            return self.formula(factor);
        }
        let (base, exponent) = self.g.base_exponent(factor);
        let base = match self.g.node(base) {
            Node::Sum { constant, terms } if flipped == Some(factor) => {
                self.sum(constant, terms, true)
            }
            _ => self.formula(base),
        };
        self.power(base, exponent)
    }

    fn power(&mut self, base: Formula, exponent: Expr) -> Formula {
        let Some(n) = self.g.as_number(exponent) else {
            let exponent = self.formula(exponent);
            return Formula::Power(Box::new(base), Box::new(exponent));
        };
        let n = rational::abs(n);
        if n.is_one() {
            return base;
        }
        match u32::try_from(n.denominator()) {
            Ok(index) if index > 1 && n.numerator().is_one() => Formula::Root {
                index,
                radicand: Box::new(base),
            },
            _ => {
                let (_, exponent) = Formula::number(&n);
                Formula::Power(Box::new(base), Box::new(exponent))
            }
        }
    }
}

/// Whether a rational coefficient stands before the factors, ½ m v², and not under them, x/2 and √3 π/2.
fn leads_with_ratio(factors: &[Formula]) -> bool {
    let constant = |f: &Formula| match f {
        Formula::Pi | Formula::Algebraic(_) => true,
        Formula::Root { radicand, .. } => radicand.is_integer(),
        _ => false,
    };
    match factors {
        [] => false,
        [_] => false,
        _ => !factors.iter().all(constant),
    }
}

/// The product of a positive integer and factors; the integer 1 is left out where it can be.
fn with_number(number: Formula, factors: Vec<Formula>) -> Formula {
    if number.is_digit("1") {
        return Formula::product(factors);
    }
    let mut all = vec![number];
    all.extend(factors);
    Formula::product(all)
}
