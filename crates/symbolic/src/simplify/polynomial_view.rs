//! Expressions as polynomials in chosen symbols: linear coefficients, homogeneous parts, degree of homogeneity.

use super::collect::polynomial_generators;
use super::{arranged, Written};
use crate::polynomial::normal_form::{
    normal_form, normal_forms, NormalFormError, Options as Reading,
};
use crate::polynomial::{Budget, Polynomial, RationalFunction};
use crate::rational::Rational;
use crate::{Expr, Graph};

/// `Σ coefficients_i · symbols_i + remainder`, all free of the symbols.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LinearForm {
    /// One coefficient for each symbol, in the given order.
    pub coefficients: Vec<Expr>,
    /// What is left when all symbols are zero.
    pub remainder: Expr,
}

/// The part of one degree in chosen symbols.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct HomogeneousPart {
    /// The total degree in the symbols.
    pub degree: u32,
    /// The part.
    pub value: Expr,
}

/// The expression as a polynomial of degree one in the symbols; `None` when it is not known to be one.
///
/// The expression may be written non-linearly, as long as the higher terms cancel in the normal form.
///
/// # Errors
/// [`NormalFormError`] when the normal form is too large or the expression nowhere defined.
pub fn linear_form(
    g: &Graph,
    e: Expr,
    symbols: &[Expr],
    budget: &Budget,
) -> Result<Option<LinearForm>, NormalFormError> {
    let Some((parts, value)) = parts(g, e, symbols, budget)? else {
        return Ok(None);
    };
    let mut form = LinearForm {
        coefficients: vec![g.zero(); symbols.len()],
        remainder: g.zero(),
    };
    for (monomial_expr, degree, coefficient) in parts {
        match degree {
            0 => form.remainder = coefficient,
            1 => match symbols.iter().position(|&s| s == monomial_expr) {
                Some(i) => form.coefficients[i] = coefficient,
                None => return Ok(None),
            },
            _ => return Ok(None),
        }
    }
    debug_assert!(!value.denominator().is_zero());
    Ok(Some(form))
}

/// The parts of each degree in the symbols, degrees ascending, zero parts left out; `None` when the expression is not
/// known to be a polynomial in them. For velocities these are L₀, L₁, L₂.
///
/// # Errors
/// [`NormalFormError`] when the normal form is too large or the expression nowhere defined.
pub fn homogeneous_parts(
    g: &Graph,
    e: Expr,
    symbols: &[Expr],
    budget: &Budget,
) -> Result<Option<Vec<HomogeneousPart>>, NormalFormError> {
    let (field, values) = normal_forms(g, &[e], &Reading::display(*budget))?;
    let Some(value) = values.into_iter().next() else {
        return Ok(None);
    };
    let Some(inside) = polynomial_generators(&field, &value, symbols) else {
        return Ok(None);
    };
    let mut by_degree: std::collections::BTreeMap<u32, Vec<_>> = Default::default();
    for (monomial, coefficient) in value.numerator().clone().terms().iter().cloned() {
        let degree = inside
            .iter()
            .map(|&i| u32::from(monomial.exponent(i)))
            .sum();
        by_degree
            .entry(degree)
            .or_default()
            .push((monomial, coefficient));
    }
    let written = Written::of(g, &[e]);
    let mut parts = Vec::new();
    for (degree, terms) in by_degree {
        let numerator = Polynomial::from_terms(terms);
        let quotient =
            RationalFunction::new(numerator, value.denominator().clone(), field.meter())?;
        let part = quotient.ok_or(NormalFormError::Undefined)?;
        let value = arranged(&field, written, &part).unwrap_or_else(|| field.expression(&part));
        parts.push(HomogeneousPart { degree, value });
    }
    Ok(Some(parts))
}

/// The degree d for which `Σ v ∂e/∂v = d e` holds identically (Euler); `None` when there is none, or when none could be
/// proved. An expression that is zero is homogeneous of every degree and gives 0.
///
/// # Errors
/// [`NormalFormError`] when the normal form is too large or the expression nowhere defined.
pub fn homogeneity(
    g: &Graph,
    e: Expr,
    symbols: &[Expr],
    budget: &Budget,
) -> Result<Option<Rational>, NormalFormError> {
    let handles: Vec<_> = symbols.iter().filter_map(|&s| g.as_symbol(s)).collect();
    let gradient = g.gradient(e, &handles);
    let products: Vec<Expr> = symbols
        .iter()
        .zip(gradient)
        .map(|(&v, slope)| g.mul(&[v, slope]))
        .collect();
    let euler = g.add(&products);
    if normal_form(g, e, budget)?.is_zero() {
        return Ok(Some(Rational::ZERO));
    }
    let ratio = normal_form(g, g.div(euler, e), budget)?;
    Ok(ratio.value().as_rational())
}

/// The monomials in the symbols, their degrees and coefficients, with the value they make up.
type Parts = (Vec<(Expr, u32, Expr)>, RationalFunction);

fn parts(
    g: &Graph,
    e: Expr,
    symbols: &[Expr],
    budget: &Budget,
) -> Result<Option<Parts>, NormalFormError> {
    let (field, values) = normal_forms(g, &[e], &Reading::display(*budget))?;
    let Some(value) = values.into_iter().next() else {
        return Ok(None);
    };
    let Some(inside) = polynomial_generators(&field, &value, symbols) else {
        return Ok(None);
    };
    let written = Written::of(g, &[e]);
    let mut found = Vec::new();
    for (monomial, coefficient) in value.numerator().coefficients(&inside) {
        let quotient =
            RationalFunction::new(coefficient, value.denominator().clone(), field.meter())?;
        let part = quotient.ok_or(NormalFormError::Undefined)?;
        let expr = arranged(&field, written, &part).unwrap_or_else(|| field.expression(&part));
        found.push((
            field.monomial_expression(&monomial),
            monomial.degree(),
            expr,
        ));
    }
    Ok(Some((found, value)))
}
