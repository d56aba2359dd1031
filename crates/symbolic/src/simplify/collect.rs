//! Equations ordered by accelerations, then velocities.

use super::arrange::Arranger;
use super::measure::length;
use super::{simplify, Options, Written};
use crate::polynomial::normal_form::{normal_forms, Field, Options as Reading};
use crate::polynomial::{Polynomial, RationalFunction};
use crate::{Expr, Graph};

/// The expression as a sum over the first group (accelerations, say), each with its simplified coefficient, plus a rest
/// that is ordered by the second group, and so on. Groups in which the expression is not polynomial are left alone.
///
/// Returns the [simplified](simplify) expression instead when that is shorter by a third, as where a factor common to
/// all terms comes out, and the input when nothing shorter than it was found.
pub fn collect(g: &Graph, e: Expr, groups: &[&[Expr]], options: &Options) -> Expr {
    let simple = simplify(g, e, options);
    let Some(collected) = collected(g, simple, groups, options) else {
        return simple;
    };
    let (long, short) = (length(g, collected), length(g, simple));
    if long > length(g, e) || 3 * short < 2 * long {
        simple
    } else {
        collected
    }
}

/// [`collect`] for several expressions.
pub fn collect_all(g: &Graph, es: &[Expr], groups: &[&[Expr]], options: &Options) -> Vec<Expr> {
    es.iter().map(|&e| collect(g, e, groups, options)).collect()
}

fn collected(g: &Graph, e: Expr, groups: &[&[Expr]], options: &Options) -> Option<Expr> {
    if g.reachable(&[e]).len() > options.max_nodes {
        return None;
    }
    let (field, values) = normal_forms(g, &[e], &Reading::display(options.budget)).ok()?;
    let arranger = Arranger::new(&field, Written::of(g, &[e]));
    let mut rest = values.into_iter().next()?;
    let mut parts = Vec::new();
    for (level, group) in groups.iter().enumerate() {
        let Some(inside) = polynomial_generators(&field, &rest, group) else {
            continue;
        };
        if inside.is_empty() {
            continue;
        }
        if level + 1 == groups.len() {
            // Velocities: the arrangement of the whole rest finds shared factors that term by term would be lost.
            break;
        }
        let mut free = RationalFunction::zero();
        for (monomial, coefficient) in rest.numerator().coefficients(&inside) {
            let part =
                RationalFunction::new(coefficient, rest.denominator().clone(), field.meter())
                    .ok()??;
            if monomial.is_one() {
                free = part;
            } else {
                let factor = field.monomial_expression(&monomial);
                parts.push(arranger.fraction_times(&part, factor)?);
            }
        }
        rest = free;
    }
    if !rest.is_zero() {
        parts.push(arranger.fraction(&rest)?);
    }
    Some(g.add(&parts))
}

/// The generators of the group, when the value is a polynomial in them: they occur neither below the bar nor inside
/// other generators.
pub(super) fn polynomial_generators(
    field: &Field<'_>,
    value: &RationalFunction,
    group: &[Expr],
) -> Option<Vec<usize>> {
    let g = field.graph();
    let symbols: Vec<_> = group.iter().filter_map(|&e| g.as_symbol(e)).collect();
    let mut inside: Vec<usize> = Vec::with_capacity(group.len());
    for &e in group {
        // Named twice, a generator would be divided out twice.
        if let Some(i) = field.generator_of(e).filter(|i| !inside.contains(i)) {
            inside.push(i);
        }
    }
    let occurs = |p: &Polynomial, generator: usize| p.degree_in(generator) > 0;
    for (i, generator) in field.generators().iter().enumerate() {
        if inside.contains(&i) {
            if occurs(value.denominator(), i) {
                return None;
            }
        } else if (occurs(value.numerator(), i) || occurs(value.denominator(), i))
            && g.contains_any(generator.expr, &symbols)
        {
            return None;
        }
    }
    Some(
        inside
            .into_iter()
            .filter(|&i| occurs(value.numerator(), i))
            .collect(),
    )
}
