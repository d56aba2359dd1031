//! Factors of the polynomial that an expression is in its generators.

use crate::graph::Graph;
use crate::node::{Expr, Node, Symbol};
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
    factors_within(graph, e, symbols, BUDGET)
}

/// As [`factors`], with another budget: many expressions are asked, and most of them are no products.
pub fn factors_within(
    graph: &Graph,
    e: Expr,
    symbols: &[Symbol],
    budget: Budget,
) -> Option<Vec<(Expr, u32)>> {
    let (field, values) = normal_forms(graph, &[e], &Options::display(budget)).ok()?;
    let factorization = values.first()?.numerator().factorize(field.meter()).ok()?;
    let list = factorization
        .factors
        .iter()
        .map(|(factor, power)| (field.polynomial_expression(factor), *power))
        .filter(|(factor, _)| graph.contains_any(*factor, symbols))
        .collect();
    Some(list)
}

/// As [`factors`], each of them irreducible over the rational numbers as a polynomial in its generators; as those are where a
/// factor is too large to be taken apart further.
pub fn irreducible_factors(graph: &Graph, e: Expr, symbols: &[Symbol]) -> Option<Vec<(Expr, u32)>> {
    let (field, values) = normal_forms(graph, &[e], &Options::display(BUDGET)).ok()?;
    let numerator = values.first()?.numerator();
    let list = match numerator.irreducible_factors(field.meter()) {
        Ok(list) => list,
        Err(_) => return factors(graph, e, symbols),
    };
    let list = list.iter();
    let list = list.map(|(factor, power)| (field.polynomial_expression(factor), *power));
    Some(
        list.filter(|(factor, _)| graph.contains_any(*factor, symbols))
            .collect(),
    )
}

/// `e` over `by`, with their common factors cancelled; `None` where they are too large.
pub fn quotient(graph: &Graph, e: Expr, by: Expr) -> Option<Expr> {
    let whole = graph.div(e, by);
    let (field, values) = normal_forms(graph, &[whole], &Options::display(BUDGET)).ok()?;
    let value = values.first()?;
    let above = field.polynomial_expression(value.numerator());
    Some(graph.div(above, field.polynomial_expression(value.denominator())))
}

/// The remainder of the numerator of `e` in the division by the numerator of `by`, both as polynomials in `symbol`, up to factors that
/// divide the leading coefficient of `by`: where that does not vanish and `by` does, the remainder vanishes exactly where `e` does.
/// `None` where they are no polynomials in it, or too large.
pub fn remainder(graph: &Graph, e: Expr, by: Expr, symbol: Symbol) -> Option<Expr> {
    if !is_polynomial_in(graph, &[e, by], symbol) {
        return None;
    }
    let (field, values) = normal_forms(graph, &[e, by], &Options::display(BUDGET)).ok()?;
    let [e, by] = values.as_slice() else {
        return None;
    };
    let generator = field.generator_of(graph.symbol_expr(symbol))?;
    let (e, by) = (e.numerator(), by.numerator());
    let rest = e.pseudo_remainder(by, generator, field.meter()).ok()?;
    Some(field.polynomial_expression(&rest))
}

/// The coefficients of the numerator of `e` as a polynomial in `symbol`, the constant first; `None` where it is none, or too large.
pub fn coefficients(graph: &Graph, e: Expr, symbol: Symbol) -> Option<Vec<Expr>> {
    if !is_polynomial_in(graph, &[e], symbol) {
        return None;
    }
    let (field, values) = normal_forms(graph, &[e], &Options::display(BUDGET)).ok()?;
    let numerator = values.first()?.numerator();
    let Some(generator) = field.generator_of(graph.symbol_expr(symbol)) else {
        return Some(vec![field.polynomial_expression(numerator)]);
    };
    let degree = numerator.degree_in(generator);
    let coefficient = |n| field.polynomial_expression(&numerator.coefficient_in(generator, n));
    Some((0..=degree).map(coefficient).collect())
}

/// Whether a symbol stands in no function and under no root.
fn is_polynomial_in(graph: &Graph, es: &[Expr], symbol: Symbol) -> bool {
    graph.reachable(es).into_iter().all(|e| {
        let is_plain = match graph.node(e) {
            Node::Apply { .. } | Node::Matrix { .. } => false,
            Node::Power { exponent, .. } => graph.as_integer(*exponent).is_some(),
            _ => true,
        };
        is_plain || !graph.contains_any(e, &[symbol])
    })
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
