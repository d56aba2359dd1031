//! The sign of an expression, inferred from assumptions and from structure.
//!
//! Facts come from three places: the model's assumptions; the domain of the expression under test (where √x or log x
//! is part of an identity, the identity is claimed only where x ≥ 0 or x > 0); and structure (even powers, sums of
//! positive terms, exponentials, bounded functions). Inference goes upwards through the graph once, without recursion.

use rustc_hash::FxHashMap;

use super::assumptions::{as_pi_number, Assumptions, SignSet};
use crate::graph::Graph;
use crate::node::{Expr, Function, Node};
use crate::rational::{self, Rational};

/// Bounds longer than this are dropped: they would cost more than they are worth.
const LONGEST_BOUND: usize = 256;

/// A closed interval that may be unbounded.
type Range = (Option<Rational>, Option<Rational>);

#[derive(Clone, Debug)]
struct Known {
    sign: SignSet,
    range: Range,
}

/// Sign inference over one graph; remembers what it found.
#[derive(Debug)]
pub(super) struct Signs<'g> {
    graph: &'g Graph,
    facts: FxHashMap<Expr, SignSet>,
    ranges: FxHashMap<Expr, Range>,
    /// Bounds of symbols as a + bπ: lower, upper.
    angles: FxHashMap<Expr, [Option<(Rational, Rational)>; 2]>,
    known: FxHashMap<Expr, Known>,
}

impl<'g> Signs<'g> {
    pub(super) fn new(graph: &'g Graph, assumptions: &Assumptions) -> Self {
        let mut signs = Self {
            graph,
            facts: FxHashMap::default(),
            ranges: FxHashMap::default(),
            angles: FxHashMap::default(),
            known: FxHashMap::default(),
        };
        for assumption in assumptions.list() {
            let difference = graph.sub(assumption.left, assumption.right);
            signs.learn(difference, assumption.relation.signs());
            signs.learn_bounds(
                assumption.left,
                assumption.relation.signs(),
                assumption.right,
            );
            signs.learn_bounds(
                assumption.right,
                assumption.relation.signs().negated(),
                assumption.left,
            );
        }
        signs
    }

    /// Adds the fact that `e` has a sign of the set. Call before the first question.
    pub(super) fn learn(&mut self, e: Expr, signs: SignSet) {
        for (expression, signs) in [(e, signs), (self.graph.neg(e), signs.negated())] {
            let fact = self.facts.entry(expression).or_insert(SignSet::ANY);
            *fact = fact.and(signs);
            // c·x has the sign of x for c > 0.
            if let Node::Product {
                coefficient,
                factors,
            } = self.graph.node(expression)
            {
                if !rational::is_negative(coefficient) && !coefficient.is_one() {
                    let monic = self.graph.mul(factors);
                    let fact = self.facts.entry(monic).or_insert(SignSet::ANY);
                    *fact = fact.and(signs);
                }
            }
        }
    }

    /// `bounded − bound` has the given signs: is that a bound by a number?
    fn learn_bounds(&mut self, bounded: Expr, signs: SignSet, bound: Expr) {
        if let Some(number) = self.graph.as_number(bound) {
            let range = self.ranges.entry(bounded).or_insert((None, None));
            if signs.is_nonnegative() {
                range.0 = Some(number.clone());
            } else if signs.is_nonpositive() {
                range.1 = Some(number.clone());
            }
        }
        if let Some(angle) = as_pi_number(self.graph, bound) {
            let bounds = self.angles.entry(bounded).or_default();
            if signs.is_nonnegative() {
                bounds[0] = Some(angle);
            } else if signs.is_nonpositive() {
                bounds[1] = Some(angle);
            }
        }
    }

    /// The signs `e` can have.
    pub(super) fn sign(&mut self, e: Expr) -> SignSet {
        let mut stack = vec![e];
        while let Some(&top) = stack.last() {
            if self.known.contains_key(&top) {
                stack.pop();
                continue;
            }
            let before = stack.len();
            self.graph.node(top).for_each_child(|child| {
                if !self.known.contains_key(&child) {
                    stack.push(child);
                }
            });
            if stack.len() == before {
                let known = self.infer(top);
                self.known.insert(top, known);
                stack.pop();
            }
        }
        self.known.get(&e).map_or(SignSet::ANY, |known| known.sign)
    }

    fn infer(&self, e: Expr) -> Known {
        let mut known = self.structure(e);
        if let Some((low, high)) = self.ranges.get(&e) {
            known.range.0 = known.range.0.take().max(low.clone());
            known.range.1 = match (known.range.1.take(), high.clone()) {
                (Some(a), Some(b)) => Some(a.min(b)),
                (a, b) => a.or(b),
            };
        }
        if let Some(fact) = self.facts.get(&e) {
            known.sign = known.sign.and(*fact);
        }
        known.sign = known.sign.and(sign_of_range(&known.range));
        let too_long = |bound: &Option<Rational>| {
            bound
                .as_ref()
                .is_some_and(|b| rational::bit_length(b) > LONGEST_BOUND)
        };
        if too_long(&known.range.0) {
            known.range.0 = None;
        }
        if too_long(&known.range.1) {
            known.range.1 = None;
        }
        known
    }

    fn child(&self, e: Expr) -> Known {
        self.known.get(&e).cloned().unwrap_or(Known {
            sign: SignSet::ANY,
            range: (None, None),
        })
    }

    fn structure(&self, e: Expr) -> Known {
        let unbounded = |sign: SignSet| Known {
            sign,
            range: (None, None),
        };
        match self.graph.node(e) {
            Node::Number(value) => Known {
                sign: sign_of(value),
                range: (Some(value.clone()), Some(value.clone())),
            },
            Node::Pi => Known {
                sign: SignSet::POSITIVE,
                range: (rational::ratio(333, 106), rational::ratio(22, 7)),
            },
            Node::Algebraic(own) => {
                let (low, high) = own.bounds();
                Known {
                    sign: sign_of(low),
                    range: (Some(low.clone()), Some(high.clone())),
                }
            }
            Node::Sum { constant, terms } => self.sum(constant, terms),
            Node::Product {
                coefficient,
                factors,
            } => {
                let start = sign_of(coefficient);
                unbounded(
                    factors
                        .iter()
                        .fold(start, |sign, &f| sign.product(self.child(f).sign)),
                )
            }
            Node::Power { base, exponent } => self.power(*base, *exponent),
            Node::Apply {
                function,
                arguments,
            } => self.apply(*function, arguments),
            Node::Symbol(_) | Node::Matrix { .. } | Node::Solve { .. } | Node::Entry { .. } => {
                unbounded(SignSet::ANY)
            }
        }
    }

    fn sum(&self, constant: &Rational, terms: &[(Expr, Rational)]) -> Known {
        let mut sign = sign_of(constant);
        let (mut low, mut high) = (Some(constant.clone()), Some(constant.clone()));
        for (term, coefficient) in terms {
            let known = self.child(*term);
            sign = sign.sum(known.sign.product(sign_of(coefficient)));
            let (a, b) = if rational::is_negative(coefficient) {
                (known.range.1, known.range.0)
            } else {
                known.range
            };
            low = low.zip(a).map(|(sum, bound)| sum + bound * coefficient);
            high = high.zip(b).map(|(sum, bound)| sum + bound * coefficient);
        }
        Known {
            sign,
            range: (low, high),
        }
    }

    fn power(&self, base: Expr, exponent: Expr) -> Known {
        let known = self.child(base);
        let Some(exponent) = self.graph.as_number(exponent) else {
            // x^y is defined for x > 0 only.
            return Known {
                sign: SignSet::POSITIVE,
                range: (None, None),
            };
        };
        let negative = rational::is_negative(exponent);
        if !exponent.is_int() {
            let sign = if negative {
                SignSet::POSITIVE
            } else {
                SignSet::POSITIVE.or(SignSet::ZERO)
            };
            let sign = if known.sign.is_positive() {
                SignSet::POSITIVE
            } else {
                sign
            };
            return Known {
                sign,
                range: (None, None),
            };
        }
        let even = exponent.numerator().trailing_zeros() != Some(0);
        let sign = known.sign.power(even, negative);
        let within_one = known.range.0.is_some_and(|low| low >= Rational::NEG_ONE)
            && known.range.1.is_some_and(|high| high <= Rational::ONE);
        let range = match (within_one && !negative, even) {
            (true, true) => (Some(Rational::ZERO), Some(Rational::ONE)),
            (true, false) => (Some(Rational::NEG_ONE), Some(Rational::ONE)),
            _ => (None, None),
        };
        Known { sign, range }
    }

    fn apply(&self, function: Function, arguments: &[Expr]) -> Known {
        let Some(&argument) = arguments.first() else {
            return Known {
                sign: SignSet::ANY,
                range: (None, None),
            };
        };
        let inner = self.child(argument);
        let unit: Range = (Some(Rational::NEG_ONE), Some(Rational::ONE));
        let (sign, range) = match function {
            Function::Exp => (SignSet::POSITIVE, (None, None)),
            Function::Cosh => (SignSet::POSITIVE, (Some(Rational::ONE), None)),
            Function::Abs => (inner.sign.power(true, false), (None, None)),
            Function::Acos | Function::Acosh => (SignSet::POSITIVE.or(SignSet::ZERO), (None, None)),
            Function::Sinh
            | Function::Asin
            | Function::Atan
            | Function::Asinh
            | Function::Atanh => (inner.sign, (None, None)),
            Function::Tanh | Function::Sign => (inner.sign, unit),
            Function::Sin => (self.sine_sign(argument, false), unit),
            Function::Cos => (self.sine_sign(argument, true), unit),
            Function::Tan => (
                self.sine_sign(argument, false)
                    .product(self.sine_sign(argument, true)),
                (None, None),
            ),
            _ => (SignSet::ANY, (None, None)),
        };
        Known { sign, range }
    }

    /// The sign of sin x, or of cos x = sin(x + π/2), from bounds of the one symbol in x = r·θ + a + bπ.
    fn sine_sign(&self, argument: Expr, quarter: bool) -> SignSet {
        let Some([low, high]) = self.angle_bounds(argument) else {
            return SignSet::ANY;
        };
        let shift = |(a, b): (Rational, Rational)| {
            let half = if quarter {
                rational::ratio(1, 2).unwrap_or(Rational::ZERO)
            } else {
                Rational::ZERO
            };
            (a, b + half)
        };
        let (low, high) = (shift(low), shift(high));
        // In [0, π] the sine is not negative, in [−π, 0] not positive; open ends are settled by the range facts.
        for (from, sign) in [
            (-2, SignSet::POSITIVE),
            (-1, SignSet::NEGATIVE),
            (0, SignSet::POSITIVE),
            (1, SignSet::NEGATIVE),
        ] {
            let start = (Rational::ZERO, rational::integer(from));
            let end = (Rational::ZERO, rational::integer(from + 1));
            if compare_pi(&start, &low).is_le() && compare_pi(&high, &end).is_le() {
                let strict = compare_pi(&start, &low).is_lt() && compare_pi(&high, &end).is_lt();
                let open = strict || self.open_bounds(argument);
                return if open { sign } else { sign.or(SignSet::ZERO) };
            }
        }
        SignSet::ANY
    }

    /// Are both bounds of the symbol in the argument strict?
    fn open_bounds(&self, argument: Expr) -> bool {
        let Some((symbol, ..)) = self.one_symbol(argument) else {
            return false;
        };
        let Some([Some(low), Some(high)]) = self.angles.get(&symbol) else {
            return false;
        };
        [low, high].into_iter().all(|(a, b)| {
            let bound = self.graph.add(&[
                self.graph.number(a.clone()),
                self.graph.scale(b, self.graph.pi()),
            ]);
            let difference = self.graph.sub(symbol, bound);
            self.facts
                .get(&difference)
                .is_some_and(|signs| signs.is_nonzero())
        })
    }

    fn angle_bounds(&self, argument: Expr) -> Option<[(Rational, Rational); 2]> {
        let (symbol, factor, shift) = self.one_symbol(argument)?;
        let [Some(low), Some(high)] = self.angles.get(&symbol)? else {
            return None;
        };
        let image =
            |(a, b): &(Rational, Rational)| (a * &factor + &shift.0, b * &factor + &shift.1);
        let (low, high) = (image(low), image(high));
        Some(if rational::is_negative(&factor) {
            [high, low]
        } else {
            [low, high]
        })
    }

    /// Reads x = factor·symbol + (a + bπ).
    fn one_symbol(&self, x: Expr) -> Option<(Expr, Rational, (Rational, Rational))> {
        let zero = (Rational::ZERO, Rational::ZERO);
        match self.graph.node(x) {
            Node::Symbol(_) => Some((x, Rational::ONE, zero)),
            Node::Product {
                coefficient,
                factors,
            } => match **factors {
                [only] if self.graph.as_symbol(only).is_some() => {
                    Some((only, coefficient.clone(), zero))
                }
                _ => None,
            },
            Node::Sum { constant, terms } => {
                let mut shift = (constant.clone(), Rational::ZERO);
                let mut symbol = None;
                for (term, coefficient) in terms.iter() {
                    match self.graph.node(*term) {
                        Node::Pi => shift.1 = coefficient.clone(),
                        Node::Symbol(_) if symbol.is_none() => {
                            symbol = Some((*term, coefficient.clone()))
                        }
                        _ => return None,
                    }
                }
                symbol.map(|(symbol, coefficient)| (symbol, coefficient, shift))
            }
            _ => None,
        }
    }
}

/// Compares a + bπ with c + dπ; equal only if a = c and b = d, since π is irrational.
fn compare_pi(x: &(Rational, Rational), y: &(Rational, Rational)) -> std::cmp::Ordering {
    let (rest, multiple) = (&x.0 - &y.0, &x.1 - &y.1);
    // π lies between 103993/33102 and 355/113 (Archimedes' and Metius' convergents refined).
    let bounds = [rational::ratio(103_993, 33_102), rational::ratio(355, 113)];
    let values: Vec<Rational> = bounds
        .into_iter()
        .flatten()
        .map(|pi| &rest + &multiple * pi)
        .collect();
    let negative = values
        .iter()
        .filter(|value| rational::is_negative(value))
        .count();
    let zero = rest.is_zero() && multiple.is_zero();
    match (zero, negative) {
        (true, _) => std::cmp::Ordering::Equal,
        (false, 0) => std::cmp::Ordering::Greater,
        // Undecided comparisons are called Greater both ways, which claims no containment.
        (false, 1) => std::cmp::Ordering::Greater,
        (false, _) => std::cmp::Ordering::Less,
    }
}

fn sign_of(value: &Rational) -> SignSet {
    SignSet::of(if value.is_zero() {
        0
    } else if rational::is_negative(value) {
        -1
    } else {
        1
    })
}

fn sign_of_range((low, high): &Range) -> SignSet {
    let mut sign = SignSet::ANY;
    if let Some(low) = low {
        if !rational::is_negative(low) {
            sign = sign.and(SignSet::POSITIVE.or(SignSet::ZERO));
        }
        if !rational::is_negative(low) && !low.is_zero() {
            sign = sign.and(SignSet::POSITIVE);
        }
    }
    if let Some(high) = high {
        if rational::is_negative(high) {
            sign = sign.and(SignSet::NEGATIVE);
        } else if high.is_zero() {
            sign = sign.and(SignSet::NEGATIVE.or(SignSet::ZERO));
        }
    }
    sign
}

#[cfg(test)]
mod tests {
    use super::super::assumptions::Relation;
    use super::*;

    #[test]
    fn signs_follow_from_assumptions_and_structure() {
        let g = Graph::new();
        let [m, r, x, theta] = ["m", "r", "x", "theta"].map(|name| g.symbol(name, 0));
        let mut assumptions = Assumptions::new();
        assumptions
            .positive(&g, m)
            .assume(r, Relation::Less, g.integer(-2));
        assumptions
            .assume(g.zero(), Relation::Less, theta)
            .assume(theta, Relation::Less, g.pi());
        let mut signs = Signs::new(&g, &assumptions);
        let half = rational::ratio(1, 2).unwrap();
        let positive = [
            m,
            g.add(&[m, g.powi(x, 2)]),
            g.mul(&[m, g.powi(r, 2)]),
            g.neg(g.add(&[r, g.one()])),
            g.exp(x),
            g.sin(theta),
            g.sin(g.scale(&half, theta)),
            g.cos(g.scale(&half, theta)),
            g.sub(g.integer(2), g.sin(x)),
            g.add(&[g.powi(g.sin(x), 2), m]),
            g.sqrt(m),
        ];
        for e in positive {
            assert!(signs.sign(e).is_positive(), "{:?}", g.node(e));
        }
        assert!(signs.sign(g.mul(&[m, r])) == SignSet::NEGATIVE);
        assert!(signs
            .sign(g.sub(g.one(), g.powi(g.cos(x), 2)))
            .is_nonnegative());
        assert!(signs.sign(g.add(&[g.one(), g.cos(x)])).is_nonnegative());
        for unknown in [
            x,
            g.sin(x),
            g.cos(theta),
            g.sub(m, x),
            g.sin(g.add(&[theta, g.one()])),
        ] {
            assert_eq!(signs.sign(unknown), SignSet::ANY, "{:?}", g.node(unknown));
        }
    }
}
