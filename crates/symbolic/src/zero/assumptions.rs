//! What a model assumes of its symbols: `m > 0`, `0 < theta < pi`. Proofs use it and are printed with it.

use std::cmp::Ordering;

use crate::graph::Graph;
use crate::node::{Expr, Node};

/// How the two sides of an assumption compare.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Relation {
    /// left < right
    Less,
    /// left ≤ right
    LessOrEqual,
    /// left > right
    Greater,
    /// left ≥ right
    GreaterOrEqual,
    /// left ≠ right
    NotEqual,
}

impl Relation {
    /// The sign as people write it.
    pub fn symbol(self) -> &'static str {
        match self {
            Relation::Less => "<",
            Relation::LessOrEqual => "<=",
            Relation::Greater => ">",
            Relation::GreaterOrEqual => ">=",
            Relation::NotEqual => "!=",
        }
    }

    /// Is the relation true when left compares to right as `ordering` says?
    pub fn holds(self, ordering: Ordering) -> bool {
        match self {
            Relation::Less => ordering == Ordering::Less,
            Relation::LessOrEqual => ordering != Ordering::Greater,
            Relation::Greater => ordering == Ordering::Greater,
            Relation::GreaterOrEqual => ordering != Ordering::Less,
            Relation::NotEqual => ordering != Ordering::Equal,
        }
    }

    /// The signs left − right may have.
    pub(crate) fn signs(self) -> SignSet {
        match self {
            Relation::Less => SignSet::NEGATIVE,
            Relation::LessOrEqual => SignSet::NEGATIVE.or(SignSet::ZERO),
            Relation::Greater => SignSet::POSITIVE,
            Relation::GreaterOrEqual => SignSet::POSITIVE.or(SignSet::ZERO),
            Relation::NotEqual => SignSet::POSITIVE.or(SignSet::NEGATIVE),
        }
    }
}

/// Whether a comparison with zero is false for all signs that are possible.
pub fn is_contradicted(relation: Relation, sign: SignSet) -> bool {
    relation.signs().0 & sign.0 == 0
}

/// Whether a comparison with zero is true for all signs that are possible.
pub fn is_implied(relation: Relation, sign: SignSet) -> bool {
    sign.0 & !relation.signs().0 == 0
}

/// One assumption, `left relation right`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Assumption {
    /// Left side.
    pub left: Expr,
    /// The comparison.
    pub relation: Relation,
    /// Right side.
    pub right: Expr,
}

/// The assumptions of a model. The empty set is the default: nothing is known.
#[derive(Clone, Debug, Default)]
pub struct Assumptions {
    list: Vec<Assumption>,
}

impl Assumptions {
    /// No assumptions.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds `left relation right`.
    pub fn assume(&mut self, left: Expr, relation: Relation, right: Expr) -> &mut Self {
        self.list.push(Assumption {
            left,
            relation,
            right,
        });
        self
    }

    /// Adds `e > 0`.
    pub fn positive(&mut self, graph: &Graph, e: Expr) -> &mut Self {
        self.assume(e, Relation::Greater, graph.zero())
    }

    /// Every assumption, in the order given.
    pub fn list(&self) -> &[Assumption] {
        &self.list
    }
}

/// A set of signs, never empty in a consistent model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SignSet(u8);

impl SignSet {
    /// Negative.
    pub const NEGATIVE: Self = Self(1);
    /// Zero.
    pub const ZERO: Self = Self(2);
    /// Positive.
    pub const POSITIVE: Self = Self(4);
    /// Nothing known.
    pub const ANY: Self = Self(7);

    /// Both sets together.
    pub fn or(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// What both sets allow; [`SignSet::ANY`] if they contradict each other, so that contradictory assumptions prove nothing.
    pub fn and(self, other: Self) -> Self {
        match self.0 & other.0 {
            0 => Self::ANY,
            both => Self(both),
        }
    }

    fn allows(self, other: Self) -> bool {
        self.0 & other.0 != 0
    }

    /// Never negative.
    pub fn is_nonnegative(self) -> bool {
        !self.allows(Self::NEGATIVE)
    }

    /// Never positive.
    pub fn is_nonpositive(self) -> bool {
        !self.allows(Self::POSITIVE)
    }

    /// Always positive.
    pub fn is_positive(self) -> bool {
        self == Self::POSITIVE
    }

    /// Never zero.
    pub fn is_nonzero(self) -> bool {
        !self.allows(Self::ZERO)
    }

    /// The signs of −x.
    #[must_use]
    pub fn negated(self) -> Self {
        self.map(|sign| -sign)
    }

    /// The signs of x + y.
    pub fn sum(self, other: Self) -> Self {
        self.combine(other, |a, b| match (a, b) {
            (0, s) | (s, 0) => Self::of(s),
            (a, b) if a == b => Self::of(a),
            _ => Self::ANY,
        })
    }

    /// The signs of x·y.
    pub fn product(self, other: Self) -> Self {
        self.combine(other, |a, b| Self::of(a * b))
    }

    /// The signs of x^n for an integer n; of n only parity and sign matter. Zero has no negative power.
    pub fn power(self, even: bool, negative: bool) -> Self {
        let base = if negative {
            Self(self.0 & !Self::ZERO.0)
        } else {
            self
        };
        let result = if even {
            base.map(|sign| sign * sign)
        } else {
            base
        };
        if result.0 == 0 {
            Self::ANY
        } else {
            result
        }
    }

    /// The set of one sign, given as a number.
    pub fn of(sign: i8) -> Self {
        match sign {
            0 => Self::ZERO,
            s if s > 0 => Self::POSITIVE,
            _ => Self::NEGATIVE,
        }
    }

    fn members(self) -> impl Iterator<Item = i8> {
        [-1, 0, 1]
            .into_iter()
            .filter(move |&sign| self.allows(Self::of(sign)))
    }

    fn map(self, image: impl Fn(i8) -> i8) -> Self {
        Self(
            self.members()
                .fold(0, |set, sign| set | Self::of(image(sign)).0),
        )
    }

    fn combine(self, other: Self, image: impl Fn(i8, i8) -> Self) -> Self {
        let mut set = 0;
        for a in self.members() {
            for b in other.members() {
                set |= image(a, b).0;
            }
        }
        Self(set)
    }
}

/// a + b·π with rational a and b: what bounds of angles are.
pub(super) fn as_pi_number(graph: &Graph, e: Expr) -> Option<(crate::Rational, crate::Rational)> {
    use crate::Rational;
    if let Some(number) = graph.as_number(e) {
        return Some((number.clone(), Rational::ZERO));
    }
    if let Some(multiple) = graph.multiple_of_pi(e) {
        return Some((Rational::ZERO, multiple));
    }
    match graph.node(e) {
        Node::Sum { constant, terms } => match &**terms {
            [(term, coefficient)] if matches!(graph.node(*term), Node::Pi) => {
                Some((constant.clone(), coefficient.clone()))
            }
            _ => None,
        },
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every rule against all representative values.
    #[test]
    fn rules_agree_with_numbers() {
        let sets: Vec<SignSet> = (1..8).map(SignSet).collect();
        let values = |set: SignSet| {
            set.members()
                .flat_map(|s| [i64::from(s), 3 * i64::from(s)])
                .collect::<Vec<_>>()
        };
        for &a in &sets {
            for &b in &sets {
                let (mut sums, mut products) = (0, 0);
                for x in values(a) {
                    for y in values(b) {
                        sums |= SignSet::of((x + y).signum() as i8).0;
                        products |= SignSet::of((x * y).signum() as i8).0;
                    }
                }
                assert_eq!(a.sum(b).0, sums);
                assert_eq!(a.product(b).0, products);
            }
        }
        assert_eq!(
            SignSet::ANY.power(true, false),
            SignSet::POSITIVE.or(SignSet::ZERO)
        );
        assert_eq!(SignSet::ANY.power(true, true), SignSet::POSITIVE);
        assert_eq!(SignSet::POSITIVE.and(SignSet::NEGATIVE), SignSet::ANY);
    }
}
