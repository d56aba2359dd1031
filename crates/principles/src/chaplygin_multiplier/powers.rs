//! N as a product of real powers of factors, and of an exponential, from d ln N.

use crate::stationarity::{by_sines, zero_of};
use chetaev_mechanics::claims::Context;
use chetaev_mechanics::equations::unused_name;
use chetaev_mechanics::linear::dot;
use chetaev_mechanics::prover::assumptions;
use chetaev_symbolic::factors::factored;
use chetaev_symbolic::simplify::by_square;
use chetaev_symbolic::zero::known_sign;
use chetaev_symbolic::{Expr, Graph, Symbol};

/// N with the conditions under which it is real and positive, up to the sign.
pub(super) struct Product {
    /// N.
    pub(super) value: Expr,
    /// "y ≠ 0", "1 - y^2 > 0": none where N is positive at all positions.
    pub(super) conditions: Vec<String>,
}

/// A product of powers of the factors that occur in a form and in a determinant, times the exponential of a polynomial, whose
/// logarithmic differential is the form.
pub(super) fn integrated(
    cx: &Context<'_>,
    form: &[Expr],
    determinant: Expr,
    coordinates: &[Symbol],
) -> Option<Product> {
    let g = &cx.system.graph;
    let mut candidates: Vec<Expr> = Vec::new();
    for &e in form.iter().chain([&determinant]) {
        let parts = factored(g, by_sines(g, e)).map(|f| f.factors);
        for (factor, _) in parts.unwrap_or_default() {
            if g.contains_any(factor, coordinates) && !candidates.contains(&factor) {
                candidates.push(factor);
            }
        }
    }
    let mut rest = form.to_vec();
    let mut powers = Vec::new();
    // A factor that is not irreducible may hide a pole until others are taken away, so each is asked again after a success.
    let fitting = |rest: &[Expr], candidates: &[Expr]| {
        let mut all = candidates.iter().enumerate();
        all.find_map(|(place, &factor)| Some((place, exponent(g, rest, factor, coordinates)?)))
    };
    while let Some((place, exponent)) = fitting(&rest, &candidates) {
        let factor = candidates.remove(place);
        for (left, &q) in rest.iter_mut().zip(coordinates) {
            let slope = g.div(g.diff(factor, q), factor);
            *left = by_sines(g, g.sub(*left, g.mul(&[exponent, slope])));
        }
        powers.push((factor, exponent));
    }
    let exponential = g.exp(potential(cx, &rest, coordinates)?);
    let powers = powers.into_iter().map(|(f, n)| real(cx, f, n, coordinates));
    let (mut powers, conditions): (Vec<Expr>, Vec<Option<String>>) = powers.unzip();
    powers.push(exponential);
    Some(Product {
        value: g.mul(&powers),
        conditions: conditions.into_iter().flatten().collect(),
    })
}

/// The polynomial of which a closed form is the differential, `∫₀¹ Σ q_s form_s(τ q) dτ`; `None` where the form is no polynomial.
fn potential(cx: &Context<'_>, form: &[Expr], coordinates: &[Symbol]) -> Option<Expr> {
    let g = &cx.system.graph;
    let has_poles = |e: Expr| {
        let factors = factored(g, e).map(|parts| parts.factors);
        factors.is_none_or(|list| {
            let below = list.iter().filter(|(_, power)| *power < 0);
            below
                .into_iter()
                .any(|(f, _)| g.contains_any(*f, coordinates))
        })
    };
    if form.iter().any(|&e| has_poles(e)) {
        return None;
    }
    let name = unused_name(cx.system, "tau");
    let (tau, own) = (g.symbol(&name, 0), g.intern_symbol(&name, 0));
    let at: Vec<Expr> = coordinates.iter().map(|&q| g.symbol_expr(q)).collect();
    let scaled: Vec<(Expr, Expr)> = at.iter().map(|&q| (q, g.mul(&[tau, q]))).collect();
    let simple = |e: Expr| by_sines(g, e);
    // The Taylor coefficients in τ: a polynomial has so many that do not vanish.
    let mut derivative = simple(dot(g, &at, &g.substitute_all(form, &scaled)));
    let mut terms = Vec::new();
    let mut factorial = 1;
    for order in 0..=DEGREE {
        if g.is_zero(derivative) {
            return Some(g.add(&terms));
        }
        let value = g.substitute(derivative, &[(tau, g.zero())]);
        terms.push(g.div(value, g.integer(factorial * (order + 1))));
        factorial *= order + 1;
        derivative = simple(g.diff(derivative, own));
    }
    None
}

/// The exponent of a factor in N: the residue of what is left where the factor vanishes, or the ratio of what is left to
/// d ln(factor) where that is constant.
fn exponent(g: &Graph, rest: &[Expr], factor: Expr, coordinates: &[Symbol]) -> Option<Expr> {
    let is_constant = |e: Expr| !g.contains_any(e, coordinates) && !g.is_zero(e);
    rest.iter().zip(coordinates).find_map(|(&left, &q)| {
        let slope = g.diff(factor, q);
        if g.is_zero(slope) {
            return None;
        }
        let ratio = by_sines(g, g.div(g.mul(&[left, factor]), slope));
        if is_constant(ratio) {
            return Some(ratio);
        }
        let zero = [zero_of(g, factor, coordinates)?];
        let has_pole = factored(g, ratio)?
            .factors
            .iter()
            .any(|&(pole, n)| n < 0 && g.is_zero(g.substitute(pole, &zero)));
        let residue = (!has_pole).then(|| g.substitute(ratio, &zero))?;
        let residue = by_sines(g, residue);
        is_constant(residue).then_some(residue)
    })
}

/// A power on its real branch, and where it is positive up to the sign: N is unique up to a constant factor, so that the opposite
/// of a factor serves as well.
fn real(
    cx: &Context<'_>,
    factor: Expr,
    exponent: Expr,
    coordinates: &[Symbol],
) -> (Expr, Option<String>) {
    let g = &cx.system.graph;
    let stated = assumptions(cx.system);
    let opposite = by_sines(g, g.neg(factor));
    let forms = [factor, opposite].into_iter();
    let mut forms = forms.flat_map(|e| [e, by_square(g, e, true), by_square(g, e, false)]);
    if let Some(positive) = forms.find(|&e| known_sign(g, e, &stated).is_positive()) {
        return (g.pow(positive, exponent), None);
    }
    if g.as_number(exponent).is_some_and(|n| n.is_int()) {
        let condition = format!("{} ≠ 0", g.text(factor));
        return (g.pow(factor, exponent), Some(condition));
    }
    let base = match is_negative(cx, factor, coordinates) {
        true => opposite,
        false => factor,
    };
    let condition = format!("{} > 0", g.text(base));
    (g.pow(base, exponent), Some(condition))
}

/// Whether a factor is negative at the first simple position where it does not vanish, for the values of the parameters that the
/// model states: which branch is written, no proof.
fn is_negative(cx: &Context<'_>, factor: Expr, coordinates: &[Symbol]) -> bool {
    let g = &cx.system.graph;
    let known = g.substitute(factor, &cx.system.parameter_values());
    let at = |x: f64| {
        let value = |s: Symbol| Some(if coordinates.contains(&s) { x } else { 1.0 });
        let values = g.evaluate_f64(&[known], &value).ok()?;
        values
            .first()
            .copied()
            .filter(|x| x.is_finite() && x.abs() > 1e-9)
    };
    POSITIONS.into_iter().find_map(at).is_some_and(|x| x < 0.0)
}

/// Values of the coordinates that are tried.
const POSITIONS: [f64; 4] = [0.0, 0.5, 1.0, 2.0];

/// Polynomials of a higher degree are not looked for in ln N.
const DEGREE: i64 = 8;
