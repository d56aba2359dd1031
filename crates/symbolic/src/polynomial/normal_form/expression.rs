//! Back from rational functions to expressions.

use dashu_int::IBig;

use super::super::monomial::Monomial;
use super::super::rational_function::RationalFunction;
use super::super::sparse::Polynomial;
use super::field::Field;
use crate::rational::Rational;
use crate::Expr;

impl Field<'_> {
    /// The monomial as a product of powers of the generators' expressions.
    pub fn monomial_expression(&self, monomial: &Monomial) -> Expr {
        let powers: Vec<Expr> = monomial
            .iter()
            .map(|(generator, exponent)| {
                self.g
                    .powi(self.generators[generator].expr, i64::from(exponent))
            })
            .collect();
        self.g.mul(&powers)
    }

    /// The polynomial as an expanded sum.
    pub fn polynomial_expression(&self, p: &Polynomial) -> Expr {
        let term = |(monomial, coefficient): &(Monomial, IBig)| {
            let coefficient = Rational::from(coefficient.clone());
            self.g
                .scale(&coefficient, self.monomial_expression(monomial))
        };
        let terms: Vec<Expr> = p.terms().iter().map(term).collect();
        self.g.add(&terms)
    }

    /// The quotient of the expanded numerator by the expanded denominator.
    pub fn expression(&self, f: &RationalFunction) -> Expr {
        let numerator = self.polynomial_expression(f.numerator());
        let denominator = self.polynomial_expression(f.denominator());
        self.g.div(numerator, denominator)
    }
}
