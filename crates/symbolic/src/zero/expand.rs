//! Arguments as rational combinations of monomials: `x (y + 1) + pi/3` is x·y + x + ⅓·π.

use std::collections::BTreeMap;

use crate::graph::Graph;
use crate::node::{Expr, Node};
use crate::rational::{self, Rational};

/// More terms than this are not multiplied out; the product then counts as a monomial by itself.
const MOST_TERMS: usize = 256;
/// Higher powers of sums are not multiplied out.
const HIGHEST_POWER: i64 = 6;

/// Σ coefficient · monomial + constant.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct LinearForm {
    /// Monomials without numerical coefficient.
    pub(super) terms: BTreeMap<Expr, Rational>,
    /// The rational constant.
    pub(super) constant: Rational,
}

/// Multiplies out `e` as far as it stays small, and collects it.
pub(super) fn linear_form(graph: &Graph, e: Expr) -> LinearForm {
    let mut form = LinearForm::default();
    let mut work = vec![(e, Rational::ONE)];
    let mut budget = MOST_TERMS;
    while let Some((term, factor)) = work.pop() {
        match graph.node(term) {
            Node::Number(value) => form.constant += value * factor,
            Node::Sum { constant, terms } => {
                form.constant += constant * &factor;
                budget = budget.saturating_sub(terms.len());
                work.extend(terms.iter().map(|(t, c)| (*t, c * &factor)));
            }
            Node::Product {
                coefficient,
                factors,
            } => {
                let factor = factor * coefficient;
                match split(graph, factors).filter(|_| budget > 0) {
                    Some(products) => {
                        budget = budget.saturating_sub(products.len());
                        work.extend(products.into_iter().map(|(t, c)| (t, c * &factor)));
                    }
                    None => form.add(graph.mul(factors), factor),
                }
            }
            Node::Power { .. } => match split(graph, &[term]).filter(|_| budget > 0) {
                Some(products) => {
                    budget = budget.saturating_sub(products.len());
                    work.extend(products.into_iter().map(|(t, c)| (t, c * &factor)));
                }
                None => form.add(term, factor),
            },
            _ => form.add(term, factor),
        }
    }
    form.terms.retain(|_, coefficient| !coefficient.is_zero());
    form
}

impl LinearForm {
    /// Adds a multiple of a monomial.
    pub(super) fn add(&mut self, monomial: Expr, coefficient: Rational) {
        *self.terms.entry(monomial).or_insert(Rational::ZERO) += coefficient;
    }
}

/// Distributes the first sum among the factors over the rest; `None` if there is none.
fn split(graph: &Graph, factors: &[Expr]) -> Option<Vec<(Expr, Rational)>> {
    let (position, sum, power) = factors.iter().enumerate().find_map(|(i, &factor)| {
        let (base, exponent) = graph.base_exponent(factor);
        let power = graph.as_number(exponent).and_then(rational::to_i64)?;
        let is_sum = matches!(graph.node(base), Node::Sum { .. });
        (is_sum && (1..=HIGHEST_POWER).contains(&power)).then_some((i, base, power))
    })?;
    let Node::Sum { constant, terms } = graph.node(sum) else {
        return None;
    };
    let mut rest: Vec<Expr> = factors.to_vec();
    rest[position] = graph.powi(sum, power - 1);
    let rest = graph.mul(&rest);
    let mut products: Vec<(Expr, Rational)> = terms
        .iter()
        .map(|(term, coefficient)| (graph.mul(&[rest, *term]), coefficient.clone()))
        .collect();
    if !constant.is_zero() {
        products.push((rest, constant.clone()));
    }
    Some(products)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_polynomials_have_equal_forms() {
        let g = Graph::new();
        let [x, y] = ["x", "y"].map(|name| g.symbol(name, 0));
        let square = g.powi(g.add(&[x, y]), 3);
        let direct = g.add(&[
            g.powi(x, 3),
            g.mul(&[g.integer(3), g.powi(x, 2), y]),
            g.mul(&[g.integer(3), x, g.powi(y, 2)]),
            g.powi(y, 3),
        ]);
        assert_eq!(linear_form(&g, square), linear_form(&g, direct));
        let shifted = linear_form(&g, g.mul(&[x, g.add(&[y, g.integer(1)])]));
        assert_eq!(shifted.terms.len(), 2);
        assert!(linear_form(&g, g.sub(square, square)).terms.is_empty());
    }

    #[test]
    fn large_products_are_left_alone() {
        let g = Graph::new();
        let sum = g.add(
            &(0..40)
                .map(|i| g.symbol(&format!("x_{i}"), 0))
                .collect::<Vec<_>>(),
        );
        let form = linear_form(&g, g.powi(sum, 6));
        assert!(form.terms.len() < 4 * MOST_TERMS);
    }
}
