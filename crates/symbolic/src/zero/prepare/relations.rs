//! Rational relations between arguments: y/(1 + x) and x y/(1 + x) have the sum y, so that of the exponentials of the three only two
//! are generators.
//!
//! An argument is a combination of monomials in symbols, and of one *remainder*, which is what else there is. Multiplicative relations
//! between exponentials are the linear relations between arguments over the rationals, so that remainders need not be taken apart. They
//! are brought to normal form; over a common denominator a relation with rational coefficients is one between the vectors of
//! coefficients of the numerators. What is found holds exactly; relations that are missed can only make a proof impossible.

use std::collections::{BTreeMap, BTreeSet};

use rustc_hash::FxHashMap;

use super::super::expand::{linear_form, LinearForm};
use super::Builder;
use crate::node::{Expr, Function, Node};
use crate::polynomial::normal_form::{normal_forms, Options};
use crate::polynomial::{Budget, Monomial, Polynomial};
use crate::rational::Rational;

/// Relations are looked for among at most so many monomials and remainders,
const MOST_UNITS: usize = 24;
/// with at most so many nodes in all.
const MOST_NODES: usize = 500;
/// A few milliseconds at most.
const BUDGET: Budget = Budget {
    terms: 2_000,
    degree: 200,
    bits: 2_000,
    work: 500_000,
};

/// Which monomials and remainders are combinations of others; nothing where it was not looked for.
pub(super) type Relations = Option<FxHashMap<Expr, LinearForm>>;

/// What remains of an argument without its monomials in symbols: coefficient·unit.
struct Remainder {
    unit: Expr,
    coefficient: Rational,
}

impl Builder<'_> {
    /// Finds the relations among the arguments of angles and exponentials below the roots.
    pub(super) fn relate(&mut self, roots: &[Expr]) {
        let graph = self.graph;
        let (mut plain, mut units) = (BTreeSet::new(), BTreeSet::new());
        for e in graph.reachable(roots) {
            let Node::Apply {
                function,
                arguments,
            } = graph.node(e)
            else {
                continue;
            };
            if let (true, Some(&x)) = (takes_a_form(*function), arguments.first()) {
                let (own, remainder) = self.parted(linear_form(graph, x));
                plain.extend(own.terms.into_keys().filter(|&m| !self.has_own_rule(m)));
                units.extend(remainder.map(|r| r.unit));
            }
        }
        if units.is_empty() || plain.len() + units.len() > MOST_UNITS {
            return;
        }
        // Monomials first: remainders are expressed by them where they can be.
        let all: Vec<Expr> = plain
            .into_iter()
            .chain([graph.one()])
            .chain(units)
            .collect();
        if graph.reachable(&all).len() <= MOST_NODES {
            self.relations = self.relations_among(&all);
        }
    }

    /// `e` as a combination of monomials and remainders between which no relation is known.
    pub(super) fn reduced_form(&self, e: Expr) -> LinearForm {
        let form = linear_form(self.graph, e);
        let Some(relations) = &self.relations else {
            return form;
        };
        let (mut reduced, remainder) = self.parted(form);
        if let Some(Remainder { unit, coefficient }) = remainder {
            match relations.get(&unit) {
                None => reduced.add(unit, coefficient),
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

    /// The form without what is no monomial in symbols, and that, with one as its leading coefficient.
    fn parted(&self, form: LinearForm) -> (LinearForm, Option<Remainder>) {
        let (own, rest): (BTreeMap<_, _>, BTreeMap<_, _>) = form
            .terms
            .into_iter()
            .partition(|&(m, _)| self.has_own_rule(m) || self.is_polynomial(m));
        let own = LinearForm {
            terms: own,
            constant: form.constant,
        };
        let remainder = rest.first_key_value().map(|(_, leading)| {
            let terms: Vec<Expr> = rest
                .iter()
                .map(|(&m, c)| self.graph.scale(&(c / leading), m))
                .collect();
            Remainder {
                unit: self.graph.add(&terms),
                coefficient: leading.clone(),
            }
        });
        (own, remainder)
    }

    /// Logarithms, inverse functions and π have rules of their own.
    fn has_own_rule(&self, monomial: Expr) -> bool {
        matches!(self.graph.node(monomial), Node::Apply { .. } | Node::Pi)
    }

    fn is_polynomial(&self, monomial: Expr) -> bool {
        self.graph.as_symbol(monomial).is_some() || self.is_monomial_in_symbols(monomial)
    }

    /// Elimination of the monomials in their order; `None` where the normal forms are too large.
    fn relations_among(&self, monomials: &[Expr]) -> Relations {
        let options = Options::proof(BUDGET);
        let (field, values) = normal_forms(self.graph, monomials, &options).ok()?;
        let numerators = field.over_common_denominator(&values)?;
        let mut basis: Vec<Reduced> = Vec::new();
        let mut relations = FxHashMap::default();
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
