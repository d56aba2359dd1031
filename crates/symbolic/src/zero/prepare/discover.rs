//! The first pass: which fractions of angles and exponents occur, and where the expressions are defined at all.

use dashu_base::Gcd;
use rustc_hash::FxHashSet;

use super::super::assumptions::SignSet;
use super::Builder;
use crate::node::{Expr, Function, Node};
use crate::rational::{self, Rational};

/// Denominators beyond this are not taken into a common denominator: the angle is then a generator of its own.
const LARGEST_PART: u64 = 5040;
/// The largest order of unity used; the count of primes in arithmetic progressions is proved up to 1200.
const LARGEST_ORDER: u64 = 1200;

impl Builder<'_> {
    /// Visits everything below the roots, including what functions are lowered to.
    pub(super) fn discover(&mut self, roots: &[Expr]) {
        let mut seen: FxHashSet<Expr> = roots.iter().copied().collect();
        let mut stack = roots.to_vec();
        while let Some(e) = stack.pop() {
            for child in self.visit(e) {
                if seen.insert(child) {
                    stack.push(child);
                }
            }
        }
    }

    /// Notes what `e` needs and returns what to visit next.
    fn visit(&mut self, e: Expr) -> Vec<Expr> {
        let graph = self.graph;
        let mut next = Vec::new();
        graph.node(e).for_each_child(|child| next.push(child));
        match graph.node(e) {
            Node::Power { base, exponent } => match graph.as_number(*exponent) {
                Some(r) if r.is_int() => {}
                Some(r) => {
                    let positive = rational::is_negative(r);
                    self.require(*base, positive, "a fractional power");
                }
                None => {
                    self.require(*base, true, "a power with a symbolic exponent");
                    next.push(self.lower(e));
                }
            },
            Node::Apply {
                function,
                arguments,
            } => {
                let Some(&x) = arguments.first() else {
                    return next;
                };
                match function {
                    Function::Sin
                    | Function::Cos
                    | Function::Tan
                    | Function::Cot
                    | Function::Sec
                    | Function::Csc => {
                        self.note_angle(x);
                    }
                    Function::Exp | Function::Sinh | Function::Cosh | Function::Tanh => {
                        self.note_exponent(x)
                    }
                    Function::Log => self.require(x, true, "a logarithm"),
                    Function::Acos | Function::Asinh | Function::Acosh | Function::Atanh => {
                        next.push(self.lower(e))
                    }
                    _ => {}
                }
            }
            _ => {}
        }
        next
    }

    /// The expressions are defined only where `e` ≥ 0 (or > 0); what is not known by itself becomes a condition.
    fn require(&mut self, e: Expr, strict: bool, because: &str) {
        if self.graph.as_number(e).is_some() {
            return;
        }
        let signs = if strict {
            SignSet::POSITIVE
        } else {
            SignSet::POSITIVE.or(SignSet::ZERO)
        };
        self.signs.learn(e, signs);
        let known = self.plain.sign(e);
        if if strict {
            known.is_positive()
        } else {
            known.is_nonnegative()
        } {
            return;
        }
        let relation = if strict { ">" } else { ">=" };
        self.state_condition(e, relation, because);
    }

    /// Where `e` is zero its sign is neither 1 nor −1: that set is left out.
    pub(super) fn exclude_zero(&mut self, e: Expr) {
        self.state_condition(e, "!=", "a sign");
    }

    fn state_condition(&mut self, e: Expr, relation: &str, because: &str) {
        let text = self.graph.text(e);
        let condition = if text.len() <= 80 && !text.contains('\n') {
            format!("{text} {relation} 0")
        } else {
            format!("the argument of {because} {relation} 0")
        };
        if !self.program.conditions.contains(&condition) {
            self.program.conditions.push(condition);
        }
    }

    fn note_angle(&mut self, x: Expr) {
        for (monomial, coefficient) in self.form(x).terms {
            if monomial == self.graph.pi() {
                self.note_turn(&coefficient);
            } else {
                note(self.angle_parts.entry(monomial).or_insert(1), &coefficient);
            }
        }
        let constant = self.form(x).constant;
        note(
            self.angle_parts.entry(self.graph.one()).or_insert(1),
            &constant,
        );
    }

    /// An angle r·π with the denominator b of r: cos and sin need roots of unity of order 2b, and i.
    fn note_turn(&mut self, multiple: &Rational) {
        let Ok(denominator) = u64::try_from(multiple.denominator()) else {
            return;
        };
        if denominator <= 2 || denominator > LARGEST_ORDER {
            return;
        }
        let order = lcm(self.program.order_of_unity, lcm(4, 2 * denominator));
        if order <= LARGEST_ORDER {
            self.program.order_of_unity = order;
        }
    }

    fn note_exponent(&mut self, x: Expr) {
        let form = self.form(x);
        for (monomial, coefficient) in form.terms {
            note(
                self.exponent_parts.entry(monomial).or_insert(1),
                &coefficient,
            );
        }
        note(
            self.exponent_parts.entry(self.graph.one()).or_insert(1),
            &form.constant,
        );
    }
}

fn note(parts: &mut u64, coefficient: &Rational) {
    if let Ok(denominator) = u64::try_from(coefficient.denominator()) {
        let common = if denominator <= LARGEST_PART {
            lcm(*parts, denominator)
        } else {
            *parts
        };
        if common <= LARGEST_PART {
            *parts = common;
        }
    }
}

fn lcm(a: u64, b: u64) -> u64 {
    a / a.gcd(b) * b
}
