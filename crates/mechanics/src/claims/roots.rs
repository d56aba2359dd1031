//! Roots that are the same although their radicands are written differently.
//!
//! A formulation with a state of its own has the roots of the model as functions of that state: `√(p·W⁻²p)` for `√(v·v)`. With
//! the definition of p put in, the radicand equals that of the model as a function, not as a formula, and a proof that takes the
//! roots as unknowns could not tell that they are equal. Values at states suggest which radicands are the same up to a rational
//! factor; one is replaced by the other only where it is proved that they are.

use super::formulation::manifold;
use super::Context;
use crate::radicals::split_roots;
use crate::sample::{admissible_point, radicands, Point};
use chetaev_symbolic::rational::{ratio, to_i64};
use chetaev_symbolic::{Expr, Node, Rational, Verdict};

/// States at which radicands are compared.
const STATES: u64 = 3;

/// The largest denominator of a factor.
const DENOMINATORS: i64 = 100_000;

/// The expressions with the roots of the system wherever theirs are proved to be the same on the constraints.
pub(super) fn identified(cx: &Context<'_>, es: &[Expr]) -> Vec<Expr> {
    let (system, g) = (cx.system, &cx.system.graph);
    let known = stated_radicands(cx);
    let mut open = radicands(g, es);
    open.retain(|e| !known.contains(e));
    if known.is_empty() || open.is_empty() {
        return es.to_vec();
    }
    let states: Vec<Point> = (0..STATES)
        .filter_map(|seed| admissible_point(system, cx.terms, seed))
        .collect();
    let manifold = manifold(cx);
    let is_zero = |e: Expr| {
        let verdict = cx.prover.identity(system, &[e], &manifold, "");
        matches!(verdict, Verdict::Proved(_))
    };
    let mut pairs = Vec::new();
    for &radicand in &open {
        let same = known.iter().find_map(|&other| {
            let factors = factors(cx, &states, radicand, other).into_iter();
            let scaled = factors.map(|factor| g.scale(&factor, other));
            let mut proved = scaled.filter(|&scaled| is_zero(g.sub(radicand, scaled)));
            proved.next().map(|scaled| (radicand, scaled))
        });
        match same {
            Some(pair) => pairs.push(pair),
            None => pairs.extend(quotient(
                cx,
                &states,
                es,
                radicand,
                (&known, &open),
                &is_zero,
            )),
        }
    }
    g.substitute_all(es, &pairs)
}

/// The expressions with every root written by the factors of its radicand, where there are others than those of the model:
/// `√(m²c² + p²)` of the momenta of a relativistic particle is `m c²/√(c² − v²)`.
pub(super) fn split(cx: &Context<'_>, es: &[Expr]) -> Vec<Expr> {
    let g = &cx.system.graph;
    let known = stated_radicands(cx);
    let is_known = |e: &Expr| known.contains(e);
    match known.is_empty() || radicands(g, es).iter().all(is_known) {
        true => es.to_vec(),
        false => split_roots(cx.system, es),
    }
}

/// The radicands of the model.
fn stated_radicands(cx: &Context<'_>) -> Vec<Expr> {
    let mut stated = vec![cx.system.lagrangian];
    stated.extend(&cx.system.forces);
    stated.extend(&cx.terms.constraints);
    radicands(&cx.system.graph, &stated)
}

/// Powers of a radicand that is `c A/B`, A a radicand of the model and B one that occurs: with a real root of B they are
/// `c^e A^e B^-e`.
fn quotient(
    cx: &Context<'_>,
    states: &[Point],
    es: &[Expr],
    radicand: Expr,
    (known, open): (&[Expr], &[Expr]),
    is_zero: &dyn Fn(Expr) -> bool,
) -> Vec<(Expr, Expr)> {
    let g = &cx.system.graph;
    // Of `u = A/B` and `B = A/u` the longer one is replaced, so that no circle arises.
    let size = |e: Expr| g.reachable(&[e]).len();
    let below = known
        .iter()
        .chain(open)
        .filter(|&&b| size(b) < size(radicand));
    let found = below
        .flat_map(|&b| known.iter().map(move |&a| (a, b)))
        .filter(|(a, b)| a != b)
        .find_map(|(a, b)| {
            let product = g.mul(&[radicand, b]);
            let factors = factors(cx, states, product, a).into_iter();
            let above = factors.map(|factor| g.scale(&factor, a));
            let mut proved = above.filter(|&above| is_zero(g.sub(product, above)));
            proved.next().map(|above| (above, b))
        });
    let Some((above, b)) = found else {
        return Vec::new();
    };
    g.reachable(es)
        .into_iter()
        .filter_map(|e| match g.node(e) {
            Node::Power { base, exponent }
                if *base == radicand && g.as_integer(*exponent).is_none() =>
            {
                let top = g.pow(above, *exponent);
                Some((e, g.div(top, g.pow(b, *exponent))))
            }
            _ => None,
        })
        .collect()
}

/// Digits to which a quotient of radicands is taken for rational: all that rounding leaves, and where sums cancel fewer.
const AGREEMENTS: [f64; 2] = [1e-12, 1e-9];

/// Rationals c that may satisfy `a = c b` at every state.
fn factors(cx: &Context<'_>, states: &[Point], a: Expr, b: Expr) -> Vec<Rational> {
    let Some(common) = common_quotient(cx, states, a, b) else {
        return Vec::new();
    };
    let mut found: Vec<Rational> = AGREEMENTS
        .iter()
        .filter_map(|&agreement| rational(common, agreement))
        .collect();
    found.dedup();
    found
}

/// a/b, where it is positive and the same at all states.
fn common_quotient(cx: &Context<'_>, states: &[Point], a: Expr, b: Expr) -> Option<f64> {
    let g = &cx.system.graph;
    let mut common: Option<f64> = None;
    for state in states {
        let values = g.evaluate_f64(&[a, b], &|s| state.get(&s).copied()).ok()?;
        let quotient = values[0] / values[1];
        let first = *common.get_or_insert(quotient);
        if !quotient.is_finite() || (quotient - first).abs() > 1e-9 * first.abs() {
            return None;
        }
    }
    common.filter(|c| *c > 0.0)
}

/// The continued fraction of a number, up to its first convergent that agrees with it so far.
fn rational(x: f64, agreement: f64) -> Option<Rational> {
    let (mut before, mut last) = ((0_i64, 1_i64), (1_i64, 0_i64));
    let mut rest = x;
    while last.1 <= DENOMINATORS {
        let whole = rest.floor();
        if whole > 1e9 {
            return None;
        }
        let step = |a: i64, b: i64| (whole as i64).checked_mul(a)?.checked_add(b);
        let next = (step(last.0, before.0)?, step(last.1, before.1)?);
        (before, last) = (last, next);
        if (last.0 as f64 / last.1 as f64 - x).abs() <= agreement * x.abs() {
            let found = ratio(last.0, last.1)?;
            return (to_i64(&found) != Some(0)).then_some(found);
        }
        rest = 1.0 / (rest - whole);
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn factors_are_found_by_their_continued_fraction() {
        for (n, d) in [(1, 1), (3072, 1), (9, 16), (355, 113), (1, 61440)] {
            assert_eq!(rational(n as f64 / d as f64, 1e-12), ratio(n, d), "{n}/{d}");
        }
        assert_eq!(rational(std::f64::consts::SQRT_2, 1e-12), None);
        // Three digits lost to cancellation.
        assert_eq!(rational(16.0 + 3e-10, 1e-12), None);
        assert_eq!(rational(16.0 + 3e-10, 1e-9), ratio(16, 1));
    }
}
