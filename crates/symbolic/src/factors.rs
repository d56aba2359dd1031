//! Factors of the polynomial that an expression is in its generators.

use crate::graph::Graph;
use crate::node::{Expr, Symbol};
use crate::polynomial::normal_form::{normal_forms, Options};
use crate::polynomial::Budget;
use crate::rational::Rational;

/// Room for a factorization.
const BUDGET: Budget = Budget {
    terms: 2_000,
    degree: 60,
    bits: 2_000,
    work: 2_000_000,
};

/// The factors of the numerator of `e` in which one of `symbols` occurs, each with its multiplicity; `None` where `e` has
/// no normal form or the factorization is too large. Only a factorization into square-free, mutually prime parts is
/// promised, not one into irreducible ones.
pub fn factors(graph: &Graph, e: Expr, symbols: &[Symbol]) -> Option<Vec<(Expr, u32)>> {
    let (field, values) = normal_forms(graph, &[e], &Options::display(BUDGET)).ok()?;
    let factorization = values.first()?.numerator().factorize(field.meter()).ok()?;
    let list = factorization
        .factors
        .iter()
        .map(|(factor, power)| (field.polynomial_expression(factor), *power))
        .filter(|(factor, _)| graph.contains_any(*factor, symbols))
        .collect();
    Some(list)
}

/// A rational function as a number times powers of its factors.
#[derive(Clone, Debug)]
pub struct Factored {
    /// The number.
    pub coefficient: Rational,
    /// Square-free, mutually prime factors with their exponents, negative ones in the denominator.
    pub factors: Vec<(Expr, i64)>,
}

/// `e` over a common denominator, both sides factored as far as [`factors`] promises; `None` where that is too large.
pub fn factored(graph: &Graph, e: Expr) -> Option<Factored> {
    factored_within(graph, e, BUDGET)
}

/// As [`factored`], with room of choice.
pub(crate) fn factored_within(graph: &Graph, e: Expr, budget: Budget) -> Option<Factored> {
    let (field, values) = normal_forms(graph, &[e], &Options::display(budget)).ok()?;
    let value = values.first()?;
    let above = value.numerator().factorize(field.meter()).ok()?;
    let below = value.denominator().factorize(field.meter()).ok()?;
    let powers = |list: &[(crate::polynomial::Polynomial, u32)], sign: i64| -> Vec<(Expr, i64)> {
        let list = list.iter();
        list.map(|(f, n)| (field.polynomial_expression(f), sign * i64::from(*n)))
            .collect()
    };
    let mut all = powers(&above.factors, 1);
    all.extend(powers(&below.factors, -1));
    Some(Factored {
        coefficient: Rational::from(above.content) / Rational::from(below.content),
        factors: all,
    })
}
