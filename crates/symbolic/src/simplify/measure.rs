//! How long an expression is on paper.

use rustc_hash::FxHashMap;

use crate::rational;
use crate::{Expr, Graph, Node, Rational};

/// Longer parts all count the same, so that sums cannot overflow.
const LONGEST: u64 = u64::MAX / 8;
/// A name with a subscript.
const NAME: u64 = 2;

/// The approximate number of signs that a person reads, shared parts counted as often as they are printed.
///
/// Symbols count one sign and one for each prime or subscript, a function name one, because it is read as one;
/// parentheses and operators count as they are printed. Saturates instead of overflowing.
pub fn length(g: &Graph, e: Expr) -> u64 {
    Lengths::default().of(g, e)
}

/// The [`length`] with a name for each component of a solution of a linear system, which is stated but once.
pub(super) fn written_length(g: &Graph, e: Expr) -> u64 {
    Lengths::written().of(g, e)
}

/// Lengths already computed, of every node met; for one graph.
#[derive(Clone, Debug, Default)]
pub struct Lengths {
    known: FxHashMap<Expr, u64>,
    /// Whether components of solutions count as the names they are printed by.
    named: bool,
}

impl Lengths {
    pub(super) fn written() -> Lengths {
        Lengths {
            named: true,
            ..Lengths::default()
        }
    }

    /// The [`length`]; costs time in proportion to the nodes not met before.
    pub fn of(&mut self, g: &Graph, e: Expr) -> u64 {
        if let Some(&known) = self.known.get(&e) {
            return known;
        }
        let mut stack = vec![(e, false)];
        while let Some((node, children_done)) = stack.pop() {
            if self.known.contains_key(&node) {
                continue;
            }
            if self.named && matches!(g.node(node), Node::Entry { .. }) {
                self.known.insert(node, NAME);
                continue;
            }
            if children_done {
                let value = node_length(g, node, &self.known);
                self.known.insert(node, value);
            } else {
                stack.push((node, true));
                g.node(node)
                    .for_each_child(|child| stack.push((child, false)));
            }
        }
        self.known.get(&e).copied().unwrap_or(0)
    }
}

fn node_length(g: &Graph, e: Expr, known: &FxHashMap<Expr, u64>) -> u64 {
    let of = |e: &Expr| known.get(e).copied().unwrap_or(0).min(LONGEST);
    match g.node(e) {
        Node::Number(value) => number_length(value),
        Node::Pi | Node::Algebraic(_) => 1,
        Node::Symbol(symbol) => {
            let subscript = u64::from(g.symbol_name(*symbol).contains('_'));
            1 + subscript + u64::from(g.symbol_order(*symbol))
        }
        Node::Sum { constant, terms } => {
            let mut total: u64 = if constant.is_zero() {
                0
            } else {
                3 + number_length(constant)
            };
            for (term, coefficient) in terms.iter() {
                total = total.saturating_add(3 + of(term) + coefficient_length(coefficient));
            }
            total.saturating_sub(3)
        }
        Node::Product {
            coefficient,
            factors,
        } => {
            let mut total = coefficient_length(coefficient);
            let mut below = 0u64;
            for factor in factors.iter() {
                let bracket = if matches!(g.node(*factor), Node::Sum { .. }) {
                    2
                } else {
                    0
                };
                total = total.saturating_add(1 + of(factor) + bracket);
                below += u64::from(is_reciprocal(g, *factor));
            }
            // One bar for all that is below; the reciprocal of each was counted with its own.
            total
                .saturating_sub(1)
                .saturating_sub(2 * below.saturating_sub(1))
        }
        Node::Power { base, exponent } => {
            let bracket = if matches!(
                g.node(*base),
                Node::Symbol(_) | Node::Apply { .. } | Node::Pi | Node::Algebraic(_)
            ) {
                0
            } else {
                2
            };
            let exponent_length = match g.as_number(*exponent) {
                Some(n) => power_length(n, bracket),
                None => 3 + bracket + of(exponent),
            };
            of(base).saturating_add(exponent_length)
        }
        Node::Apply { arguments, .. } => arguments.iter().fold(1u64, |sum, a| {
            let bracket = if matches!(g.node(*a), Node::Symbol(_)) {
                0
            } else {
                2
            };
            sum.saturating_add(of(a) + bracket)
        }),
        Node::Matrix { entries, .. } => entries
            .iter()
            .fold(2, |sum: u64, a| sum.saturating_add(of(a) + 1)),
        Node::Solve { matrix, rhs } => rhs.iter().fold(of(matrix).saturating_add(10), |sum, b| {
            sum.saturating_add(of(b) + 1)
        }),
        Node::Entry { of: solve, .. } => of(solve).saturating_add(3),
    }
}

fn is_reciprocal(g: &Graph, e: Expr) -> bool {
    let exponent = g.base_exponent(e).1;
    g.as_number(exponent).is_some_and(rational::is_negative)
}

/// Exponent, brackets and fraction bar around a base.
fn power_length(n: &Rational, bracket: u64) -> u64 {
    let magnitude = rational::abs(n);
    let bar = if rational::is_negative(n) { 3 } else { 0 };
    let half = (&magnitude * rational::integer(2)).is_one();
    if magnitude.is_one() {
        bar + bracket
    } else if half {
        bar + 2
    } else {
        bar + bracket + 1 + number_length(&magnitude)
    }
}

fn number_length(value: &Rational) -> u64 {
    let digits = |text: String| text.len() as u64;
    let denominator = if value.is_int() {
        0
    } else {
        1 + digits(value.denominator().to_string())
    };
    digits(value.numerator().to_string()) + denominator
}

fn coefficient_length(value: &Rational) -> u64 {
    if value.is_one() {
        0
    } else if (-value.clone()).is_one() {
        1
    } else {
        number_length(value) + 1
    }
}
