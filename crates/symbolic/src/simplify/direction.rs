//! Pythagoras in both directions: other representatives of the same element of the field.

use std::collections::{BTreeMap, BTreeSet};

use dashu_int::IBig;

use crate::polynomial::normal_form::{Field, Pythagoras};
use crate::polynomial::{Monomial, Polynomial, RationalFunction, TooLarge};

/// How many representatives of a fraction are arranged.
const MOST_FRACTIONS: usize = 3;

/// Fractions equal to `f`: as reduced, by sines where that cancels or is shorter, with roots out of the denominator.
pub(super) fn fractions(field: &Field<'_>, f: &RationalFunction) -> Vec<RationalFunction> {
    let mut found = vec![f.clone()];
    let mut current = f.clone();
    for pair in field.pythagoras() {
        let Ok(Some(other)) = by_sine(field, &current, &pair) else {
            continue;
        };
        if size(&other) < size(&current) {
            current = other;
        } else if !found.contains(&other) {
            found.push(other);
        }
    }
    if !found.contains(&current) {
        found.push(current);
    }
    for generator in f.denominator().generators() {
        if let Some(Ok(Some(other))) = rationalized(field, f, generator) {
            if !found.contains(&other) {
                found.push(other);
            }
        }
    }
    // Arranging is the expensive step; a representative half as long again rarely wins.
    found.sort_by_key(size);
    let least = found.first().map_or(0, size);
    found.retain(|f| 2 * size(f) <= 3 * least);
    found.truncate(MOST_FRACTIONS);
    found
}

fn size(f: &RationalFunction) -> u64 {
    let weight = |p: &Polynomial| {
        p.terms()
            .iter()
            .map(|(m, _)| 2 + u64::from(m.degree()))
            .sum::<u64>()
    };
    weight(f.numerator()) + weight(f.denominator())
}

fn by_sine(
    field: &Field<'_>,
    f: &RationalFunction,
    pair: &Pythagoras,
) -> Result<Option<RationalFunction>, TooLarge> {
    if f.numerator().degree_in(pair.cosine) < 2 && f.denominator().degree_in(pair.cosine) < 2 {
        return Ok(None);
    }
    let n = field.by_sine(f.numerator(), pair)?;
    let d = field.by_sine(f.denominator(), pair)?;
    RationalFunction::new(n, d, field.meter())
}

/// `N/(A + B ρ) = N (A - B ρ)/(A² - B² ρ²)` for a root or sine ρ of order two.
fn rationalized(
    field: &Field<'_>,
    f: &RationalFunction,
    generator: usize,
) -> Option<Result<Option<RationalFunction>, TooLarge>> {
    let square = field.square_of(generator)?;
    let d = f.denominator();
    if d.degree_in(generator) != 1 || d.len() > 6 {
        return None;
    }
    let meter = field.meter();
    let conjugate = d.coefficient_in(generator, 0).sub(
        &d.coefficient_in(generator, 1)
            .mul(&Polynomial::generator(generator), meter)
            .ok()?,
    );
    let result = || {
        let (a, b) = (
            d.coefficient_in(generator, 0),
            d.coefficient_in(generator, 1),
        );
        let below = a
            .mul(&a, meter)?
            .sub(&b.mul(&b, meter)?.mul(square, meter)?);
        let above = f.numerator().mul(&conjugate, meter)?;
        field.quotient(above, below)
    };
    Some(result())
}

/// A representative of the polynomial with as few terms as shifting by multiples of `s² + c² - 1` (or
/// `c² - s² - 1`) finds.
pub(super) fn shortened(field: &Field<'_>, p: &Polynomial) -> Polynomial {
    let mut current = p.clone();
    for pair in field.pythagoras() {
        if current.degree_in(pair.cosine) >= 2 || current.degree_in(pair.sine) >= 2 {
            current = shifted(&current, &pair);
        }
    }
    current
}

fn shifted(p: &Polynomial, pair: &Pythagoras) -> Polynomial {
    let mut terms: BTreeMap<Monomial, IBig> = p.terms().iter().cloned().collect();
    let mut open: BTreeSet<Monomial> = terms.keys().flat_map(|m| corners(m, pair)).collect();
    // Each accepted shift removes a term, and opens a corner only where it changed a value, so this ends.
    while let Some(corner) = open.pop_last() {
        let Some(shift) = shift_at(&terms, corner, pair) else {
            continue;
        };
        for (monomial, change) in shift {
            open.extend(corners(&monomial, pair));
            let value = terms.remove(&monomial).unwrap_or(IBig::ZERO) + change;
            if !value.is_zero() {
                terms.insert(monomial, value);
            }
        }
    }
    Polynomial::from_terms(terms.into_iter().collect())
}

/// The corners m whose relation `(s² m, c² m, m)` contains the monomial.
fn corners(monomial: &Monomial, pair: &Pythagoras) -> impl Iterator<Item = Monomial> {
    let divided = |generator: usize| {
        let exponent = monomial.exponent(generator).checked_sub(2)?;
        Some(monomial.with_exponent(generator, exponent))
    };
    [
        Some(monomial.clone()),
        divided(pair.sine),
        divided(pair.cosine),
    ]
    .into_iter()
    .flatten()
}

type Shift = [(Monomial, IBig); 3];

/// The multiple of the relation at the corner that leaves fewer terms.
fn shift_at(
    terms: &BTreeMap<Monomial, IBig>,
    corner: Monomial,
    pair: &Pythagoras,
) -> Option<Shift> {
    let (s, c) = (pair.sine, pair.cosine);
    let value = |m: &Monomial| terms.get(m).cloned().unwrap_or(IBig::ZERO);
    let sine = corner.with_exponent(s, corner.exponent(s) + 2);
    let cosine = corner.with_exponent(c, corner.exponent(c) + 2);
    let (at_sine, at_cosine, at_corner) = (value(&sine), value(&cosine), value(&corner));
    // The relation is  a s² + c² - 1 = 0  with a = +1 for circular, and  a = -1, that is c² - s² - 1 = 0.
    let a = IBig::from(if pair.circular { 1 } else { -1 });
    let before = count(&[&at_sine, &at_cosine, &at_corner]);
    for t in [&at_sine * &a, at_cosine.clone(), -at_corner.clone()] {
        let (new_sine, new_cosine, new_corner) =
            (&at_sine - &t * &a, &at_cosine - &t, &at_corner + &t);
        if count(&[&new_sine, &new_cosine, &new_corner]) < before {
            return Some([(sine, -(&t * &a)), (cosine, -t.clone()), (corner, t)]);
        }
    }
    None
}

fn count(values: &[&IBig]) -> usize {
    values.iter().filter(|v| !v.is_zero()).count()
}

/// `sin = tan · cos`: the fraction with sines replaced, and the generator index that stands for the tangent.
pub(super) fn by_tangent(
    field: &Field<'_>,
    f: &RationalFunction,
    pair: &Pythagoras,
    tangent: usize,
) -> Option<RationalFunction> {
    let meter = field.meter();
    let value = Polynomial::generator(tangent)
        .mul(&Polynomial::generator(pair.cosine), meter)
        .ok()?;
    let n = f.numerator().substitute(pair.sine, &value, meter).ok()?;
    let d = f.denominator().substitute(pair.sine, &value, meter).ok()?;
    RationalFunction::new(n, d, meter).ok()?
}
