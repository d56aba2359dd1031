//! Factors of the polynomial that an expression is in its generators.

use crate::graph::Graph;
use crate::node::{Expr, Symbol};
use crate::polynomial::normal_form::{normal_forms, Options};
use crate::polynomial::Budget;

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
