//! Antiderivatives of rational functions of a symbol, by partial fractions.

use super::{inverse_quadratic, tidy};
use chetaev_symbolic::factors::{coefficients, factored};
use chetaev_symbolic::matrix::inverse;
use chetaev_symbolic::quadratic_factors::linear_and_quadratic;
use chetaev_symbolic::{Expr, Function, Graph, Rational, Symbol};

/// The highest degree of a denominator.
const DEGREE: usize = 6;

/// The highest degree of a numerator.
const NUMERATOR: usize = 12;

/// A factor of a denominator, its coefficients ascending, with its multiplicity.
struct Factor {
    value: Expr,
    list: Vec<Expr>,
    times: i64,
}

/// Of a quotient of polynomials whose denominator has factors of the first and second degree.
pub(super) fn rational(g: &Graph, e: Expr, x: Symbol) -> Option<Expr> {
    let (above, factors) = quotient(g, e, x)?;
    let degree: usize = factors
        .iter()
        .map(|f| (f.list.len() - 1) * f.times as usize)
        .sum();
    if degree == 0 || degree > DEGREE || above.len() > NUMERATOR {
        return None;
    }
    let powers = factors.iter().map(|f| g.powi(f.value, f.times));
    let below = g.mul(&powers.collect::<Vec<Expr>>());
    let (whole, rest) = divided(g, above, &polynomial(g, below, x)?);
    let mut parts: Vec<Expr> = whole
        .iter()
        .zip(1..)
        .map(|(&c, n)| g.div(g.mul(&[c, g.powi(g.symbol_expr(x), n)]), g.integer(n)))
        .collect();
    let (mut terms, mut columns) = (Vec::new(), Vec::new());
    for factor in &factors {
        for (k, j) in
            (1..=factor.times).flat_map(|k| (0..factor.list.len() - 1).map(move |j| (k, j)))
        {
            let own = g.powi(g.symbol_expr(x), j as i64);
            let cleared = g.mul(&[below, own, g.powi(factor.value, -k)]);
            let mut column = polynomial(g, tidy(g, cleared), x)?;
            column.resize(degree, g.zero());
            columns.push(column);
            terms.push((factor, k, j));
        }
    }
    let rows: Vec<Vec<Expr>> = (0..degree)
        .map(|i| columns.iter().map(|column| column[i]).collect())
        .collect();
    for (row, (factor, k, j)) in inverse(g, &rows).ok()?.iter().zip(terms) {
        let products = row.iter().zip(&rest).map(|(&a, &b)| g.mul(&[a, b]));
        let c = tidy(g, g.add(&products.collect::<Vec<Expr>>()));
        if !g.is_zero(c) {
            parts.push(g.mul(&[c, simple(g, factor, k, j, x)?]));
        }
    }
    Some(g.add(&parts))
}

/// The numerator, its coefficients ascending, and the factors of the denominator.
fn quotient(g: &Graph, e: Expr, x: Symbol) -> Option<(Vec<Expr>, Vec<Factor>)> {
    let mut all = Vec::new();
    for (value, n) in factored(g, e)?.factors {
        if n >= 0 || !g.contains_any(value, &[x]) {
            continue;
        }
        for value in split(g, value, x)? {
            all.push(Factor {
                value,
                list: polynomial(g, value, x)?,
                times: -n,
            });
        }
    }
    if all.iter().any(|f| !(2..=3).contains(&f.list.len())) {
        return None;
    }
    let powers = all.iter().map(|f| g.powi(f.value, f.times));
    let cleared = g.mul(&[&[e], &powers.collect::<Vec<Expr>>()[..]].concat());
    Some((polynomial(g, tidy(g, cleared), x)?, all))
}

/// The factors of a square-free polynomial with numbers as coefficients; others as they are.
fn split(g: &Graph, e: Expr, x: Symbol) -> Option<Vec<Expr>> {
    let list = polynomial(g, e, x)?;
    let numbers = list.iter().map(|&c| g.as_number(c).cloned());
    let numbers: Option<Vec<Rational>> = numbers.collect();
    let Some(numbers) = numbers.filter(|own| own.len() > 3) else {
        return Some(vec![e]);
    };
    let found = linear_and_quadratic(&numbers);
    let degree: usize = found.iter().map(|own| own.len() - 1).sum();
    let expression = |own: Vec<Rational>| {
        let terms = own.into_iter().zip(0..);
        let terms = terms.map(|(c, n)| g.scale(&c, g.powi(g.symbol_expr(x), n)));
        g.add(&terms.collect::<Vec<Expr>>())
    };
    (degree + 1 == numbers.len()).then(|| found.into_iter().map(expression).collect())
}

/// The coefficients of a polynomial, ascending; `None` where it is none.
pub(super) fn polynomial(g: &Graph, e: Expr, x: Symbol) -> Option<Vec<Expr>> {
    let list = coefficients(g, e, x)?;
    if list.iter().any(|&c| g.contains_any(c, &[x])) {
        return None;
    }
    // Denominators without the symbol are left out of the coefficients.
    let own = list.iter().zip(0..);
    let terms = own.map(|(&c, n)| g.mul(&[c, g.powi(g.symbol_expr(x), n)]));
    let by = tidy(g, g.div(e, g.add(&terms.collect::<Vec<Expr>>())));
    (!g.contains_any(by, &[x])).then(|| {
        let scaled = list.iter().map(|&c| tidy(g, g.mul(&[c, by])));
        scaled.collect()
    })
}

/// Quotient and remainder.
fn divided(g: &Graph, above: Vec<Expr>, below: &[Expr]) -> (Vec<Expr>, Vec<Expr>) {
    let degree = below.len() - 1;
    let (mut rest, mut whole) = (above, Vec::new());
    while rest.len() > degree {
        let last = rest.pop().unwrap_or(g.zero());
        let c = tidy(g, g.div(last, below[degree]));
        let start = rest.len() - degree;
        for (i, &b) in below[..degree].iter().enumerate() {
            rest[start + i] = tidy(g, g.sub(rest[start + i], g.mul(&[c, b])));
        }
        whole.insert(0, c);
    }
    rest.resize(degree, g.zero());
    (whole, rest)
}

/// Of `x^j` over the k-th power of a factor.
fn simple(g: &Graph, factor: &Factor, k: i64, j: usize, x: Symbol) -> Option<Expr> {
    let log = g.apply(Function::Log, &[factor.value]);
    let lower = |n: i64| g.div(g.powi(factor.value, 1 - n), g.integer(1 - n));
    match (factor.list.as_slice(), j, k) {
        ([_, a], _, 1) => Some(g.div(log, *a)),
        ([_, a], _, _) => Some(g.div(lower(k), *a)),
        ([c, b, a], 0, _) => inverse_power(g, factor.value, (*a, *b, *c), k, x),
        // x = ((2 a x + b) - b)/(2 a).
        ([_, b, a], _, _) => {
            let own = if k == 1 { log } else { lower(k) };
            let other = g.mul(&[*b, simple(g, factor, k, 0, x)?]);
            let twice = g.mul(&[g.integer(2), *a]);
            Some(g.div(g.sub(own, other), twice))
        }
        _ => None,
    }
}

/// Of the inverse of a power of `a x² + b x + c`.
fn inverse_power(
    g: &Graph,
    q: Expr,
    (a, b, c): (Expr, Expr, Expr),
    k: i64,
    x: Symbol,
) -> Option<Expr> {
    if k == 1 {
        return inverse_quadratic(g, q, x);
    }
    let twice = g.mul(&[g.integer(2), a]);
    let four = g.mul(&[g.integer(4), a, c]);
    let by = g.mul(&[g.integer(k - 1), g.sub(four, g.powi(b, 2))]);
    let line = g.add(&[g.mul(&[twice, g.symbol_expr(x)]), b]);
    let own = g.mul(&[line, g.powi(q, 1 - k)]);
    let lower = inverse_power(g, q, (a, b, c), k - 1, x)?;
    let rest = g.mul(&[g.integer(2 * k - 3), twice, lower]);
    Some(g.div(g.add(&[own, rest]), by))
}
