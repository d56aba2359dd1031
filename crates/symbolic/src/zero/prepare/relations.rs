//! Rational relations between the monomials of arguments: y/(1 + x) and x y/(1 + x) have the sum y, so that of the
//! exponentials of the three only two are generators.
//!
//! The monomials are brought to normal form; over a common denominator a relation with rational coefficients is one
//! between the vectors of coefficients of their numerators. What is found holds exactly; relations that are missed can
//! only make a proof impossible.

use std::collections::{BTreeMap, BTreeSet};

use rustc_hash::FxHashMap;

use super::super::expand::{linear_form, LinearForm};
use super::Builder;
use crate::node::{Expr, Function, Node};
use crate::polynomial::normal_form::{normal_forms, Options};
use crate::polynomial::{Budget, Meter, Monomial, Polynomial, RationalFunction};
use crate::rational::Rational;

/// Relations are looked for among at most so many monomials,
const MOST_MONOMIALS: usize = 24;
/// with at most so many nodes in all.
const MOST_NODES: usize = 500;
/// A few milliseconds at most.
const BUDGET: Budget = Budget {
    terms: 2_000,
    degree: 200,
    bits: 2_000,
    work: 500_000,
};

/// Monomials that are combinations of others.
pub(super) type Relations = FxHashMap<Expr, LinearForm>;

impl Builder<'_> {
    /// Finds the relations among the arguments of angles and exponentials below the roots.
    pub(super) fn relate(&mut self, roots: &[Expr]) {
        let graph = self.graph;
        let mut monomials: BTreeSet<Expr> = BTreeSet::new();
        for e in graph.reachable(roots) {
            let Node::Apply {
                function,
                arguments,
            } = graph.node(e)
            else {
                continue;
            };
            if let (true, Some(&x)) = (takes_a_form(*function), arguments.first()) {
                monomials.extend(linear_form(graph, x).terms.into_keys());
            }
        }
        // Logarithms and inverse functions have rules of their own.
        monomials.retain(|&m| !matches!(graph.node(m), Node::Apply { .. } | Node::Pi));
        let (mut plain, rest): (Vec<Expr>, Vec<Expr>) =
            monomials.into_iter().partition(|&m| self.is_polynomial(m));
        if rest.is_empty() || plain.len() + rest.len() > MOST_MONOMIALS {
            return;
        }
        // Plain ones first: the others are expressed by them where they can be.
        plain.push(graph.one());
        plain.extend(rest);
        if graph.reachable(&plain).len() <= MOST_NODES {
            self.relations = self.relations_among(&plain).unwrap_or_default();
        }
    }

    /// `e` as a combination of monomials between which no relation is known.
    pub(super) fn reduced_form(&self, e: Expr) -> LinearForm {
        let form = linear_form(self.graph, e);
        let mut reduced = LinearForm {
            constant: form.constant,
            ..LinearForm::default()
        };
        for (monomial, coefficient) in form.terms {
            match self.relations.get(&monomial) {
                None => reduced.add(monomial, coefficient),
                Some(combination) => {
                    reduced.constant += &combination.constant * &coefficient;
                    for (other, factor) in &combination.terms {
                        reduced.add(*other, factor * &coefficient);
                    }
                }
            }
        }
        reduced
            .terms
            .retain(|_, coefficient| !coefficient.is_zero());
        reduced
    }

    fn is_polynomial(&self, monomial: Expr) -> bool {
        self.graph.as_symbol(monomial).is_some() || self.is_monomial_in_symbols(monomial)
    }

    /// Elimination of the monomials in their order; `None` where the normal forms are too large.
    fn relations_among(&self, monomials: &[Expr]) -> Option<Relations> {
        let options = Options::proof(BUDGET);
        let (_, values) = normal_forms(self.graph, monomials, &options).ok()?;
        let numerators = over_common_denominator(&values)?;
        let mut basis: Vec<Reduced> = Vec::new();
        let mut relations = Relations::default();
        for (place, numerator) in numerators.iter().enumerate() {
            let mut next = Reduced {
                vector: vector(numerator),
                combination: BTreeMap::from([(place, Rational::ONE)]),
            };
            for known in &basis {
                next.eliminate(known);
            }
            if next.vector.is_empty() {
                relations.insert(monomials[place], self.solved(&next, monomials, place));
            } else {
                basis.push(next);
            }
        }
        Some(relations)
    }

    /// The monomial at `place` from a combination that vanishes, in which its coefficient is one.
    fn solved(&self, vanishing: &Reduced, monomials: &[Expr], place: usize) -> LinearForm {
        let mut form = LinearForm::default();
        for (&other, coefficient) in &vanishing.combination {
            if other == place {
                continue;
            }
            if monomials[other] == self.graph.one() {
                form.constant -= coefficient;
            } else {
                form.add(monomials[other], -coefficient);
            }
        }
        form
    }
}

fn takes_a_form(function: Function) -> bool {
    matches!(
        function,
        Function::Sin
            | Function::Cos
            | Function::Tan
            | Function::Cot
            | Function::Sec
            | Function::Csc
            | Function::Exp
            | Function::Sinh
            | Function::Cosh
            | Function::Tanh
    )
}

/// A vector that is a combination of those of the monomials.
struct Reduced {
    vector: BTreeMap<Monomial, Rational>,
    /// Coefficients of the monomials by their places; those eliminated are combinations of earlier ones.
    combination: BTreeMap<usize, Rational>,
}

impl Reduced {
    /// Removes the first entry of `known` from the vector.
    fn eliminate(&mut self, known: &Reduced) {
        let Some((pivot, divisor)) = known.vector.first_key_value() else {
            return;
        };
        let Some(factor) = self.vector.get(pivot).map(|entry| entry / divisor) else {
            return;
        };
        subtract(&mut self.vector, &known.vector, &factor);
        subtract(&mut self.combination, &known.combination, &factor);
    }
}

fn subtract<K: Ord + Clone>(
    a: &mut BTreeMap<K, Rational>,
    b: &BTreeMap<K, Rational>,
    factor: &Rational,
) {
    for (key, value) in b {
        let entry = a.entry(key.clone()).or_insert(Rational::ZERO);
        *entry -= value * factor;
        if entry.is_zero() {
            a.remove(key);
        }
    }
}

fn vector(polynomial: &Polynomial) -> BTreeMap<Monomial, Rational> {
    let terms = polynomial.terms().iter();
    terms
        .map(|(monomial, c)| (monomial.clone(), Rational::from(c.clone())))
        .collect()
}

/// The numerators over the least common denominator; `None` where they are too large.
fn over_common_denominator(values: &[RationalFunction]) -> Option<Vec<Polynomial>> {
    let meter = Meter::new(BUDGET);
    let mut common = Polynomial::one();
    for value in values {
        common = common.lcm(value.denominator(), &meter).ok()?;
    }
    values
        .iter()
        .map(|value| {
            let cofactor = common.exact_quotient(value.denominator(), &meter).ok()??;
            value.numerator().mul(&cofactor, &meter).ok()
        })
        .collect()
}
