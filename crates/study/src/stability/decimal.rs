//! Exact expressions in decimals: long polynomials as a person reads them, and algebraic numbers, which have no notation in models.

use crate::decimals::real;
use chetaev_symbolic::factors::coefficients;
use chetaev_symbolic::number::ball::{Ball, Precision};
use chetaev_symbolic::{Expr, Graph, Symbol};

/// Bits of the coefficients: exact ones may be sums that cancel.
const BITS: usize = 256;
/// Bits of a number, one after the other until all its digits are known.
const CANCELLING: [usize; 3] = [128, 512, 2048];
/// Digits of a coefficient.
const DIGITS: usize = 8;
/// Larger whole numbers are written with a power of ten.
const WHOLE: f64 = 1e8;

/// The powers of some symbols, and what they are multiplied by.
type Term = (Vec<usize>, f64);

/// A polynomial in symbols with decimal coefficients, the highest powers first; `None` where it is none.
pub(super) fn decimal_polynomial(g: &Graph, e: Expr, symbols: &[Symbol]) -> Option<String> {
    Some(written(g, symbols, &terms(g, e, symbols)?))
}

/// A polynomial with the same zeros, the smallest of its coefficients between 1 and 10: so all have as many digits as are printed.
pub(super) fn same_zeros(g: &Graph, e: Expr, symbols: &[Symbol]) -> Option<String> {
    let mut terms = terms(g, e, symbols)?;
    let sizes = terms.iter().map(|own| own.1.abs());
    let unit = 10_f64.powf(sizes.fold(f64::INFINITY, f64::min).log10().floor());
    for own in &mut terms {
        own.1 /= unit;
    }
    unit.is_normal().then(|| written(g, symbols, &terms))
}

fn written(g: &Graph, symbols: &[Symbol], terms: &[Term]) -> String {
    let names: Vec<String> = symbols.iter().map(|&s| g.symbol_text(s)).collect();
    let term = |(powers, value): &Term| {
        let powers = names.iter().zip(powers);
        let powers = powers.filter(|(_, power)| **power > 0);
        let powers = powers.map(|(name, power)| match power {
            1 => format!(" {name}"),
            power => format!(" {name}^{power}"),
        });
        let powers: String = powers.collect();
        match powers.strip_prefix(' ') {
            Some(own) if *value == 1.0 => own.to_owned(),
            Some(own) if *value == -1.0 => format!("-{own}"),
            _ => format!("{}{powers}", coefficient(*value)),
        }
    };
    let mut terms: Vec<&Term> = terms.iter().collect();
    terms.sort_by(|a, b| b.0.cmp(&a.0));
    let terms: Vec<String> = terms.into_iter().map(term).collect();
    terms.join(" + ").replace("+ -", "- ")
}

/// Whole numbers as they are.
fn coefficient(value: f64) -> String {
    if value.fract() == 0.0 && value.abs() < WHOLE {
        format!("{value}")
    } else {
        real(value, DIGITS)
    }
}

/// By Taylor's formula at zero, which is exact.
fn terms(g: &Graph, e: Expr, symbols: &[Symbol]) -> Option<Vec<Term>> {
    let Some((&symbol, others)) = symbols.split_first() else {
        let found = g.enclose(&[e], &Precision::new(BITS), &|_| None).ok()?;
        let value = found.first()?.to_f64();
        let is_nothing = value == 0.0;
        return Some(if is_nothing {
            Vec::new()
        } else {
            vec![(Vec::new(), value)]
        });
    };
    let degree = coefficients(g, e, symbol)?.len() - 1;
    let (mut derivative, mut factorial) = (e, 1.0);
    let mut found = Vec::new();
    for power in 0..=degree {
        let at_zero = g.substitute(derivative, &[(g.symbol_expr(symbol), g.zero())]);
        for (powers, value) in terms(g, at_zero, others)? {
            found.push(([vec![power], powers].concat(), value / factorial));
        }
        derivative = g.diff(derivative, symbol);
        factorial *= (power + 1) as f64;
    }
    // What is left of a quotient is no polynomial.
    let rest = g.evaluate_f64(&[derivative], &|_| Some(1.0)).ok()?[0];
    found.reverse();
    (rest == 0.0).then_some(found)
}

/// A number rounded, with all digits also where large parts cancel; symbols have the values given.
pub(super) fn value(g: &Graph, e: Expr, of: &dyn Fn(Symbol) -> Option<f64>) -> Option<f64> {
    let enclosed = |symbol: Symbol| Ball::from_f64(of(symbol)?);
    let found = CANCELLING.iter().find_map(|&bits| {
        let found = g.enclose(&[e], &Precision::new(bits), &enclosed).ok()?;
        let own = &found[0];
        let sizes = own.radius().log2_ceil().zip(own.magnitude().log2_ceil());
        let is_known = sizes.is_none_or(|(radius, size)| radius < size - 56);
        is_known.then(|| own.to_f64())
    });
    found.or_else(|| g.evaluate_f64(&[e], of).ok()?.first().copied())
}

/// An expression in the notation of models, where algebraic numbers have none: these are in decimals.
pub(super) fn notation(g: &Graph, e: Expr) -> String {
    let rounded = || decimal_polynomial(g, e, &g.symbols_in(&[e]));
    let value = || Some(value(g, e, &|_| None)?.to_string());
    let found = g.holds_algebraic(e).then(|| value().or_else(rounded));
    found.flatten().unwrap_or_else(|| g.text(e))
}

/// Decimal bounds of a number that stands for an algebraic one; `None` for others.
pub(super) fn enclosure(g: &Graph, e: Expr) -> Option<(String, String)> {
    if !g.holds_algebraic(e) {
        return None;
    }
    let found = g.enclose(&[e], &Precision::new(BITS), &|_| None).ok()?;
    Some(found.first()?.to_decimal_interval(20))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ones_and_whole_numbers_have_no_decimals() {
        let g = Graph::new();
        let [x, y] = ["x", "y"].map(|name| g.intern_symbol(name, 0));
        let [a, b] = [x, y].map(|s| g.symbol_expr(s));
        let half = g.sqrt(g.integer(2));
        let e = g.add(&[
            g.powi(a, 2),
            g.mul(&[g.integer(-1), a, b]),
            g.mul(&[g.integer(12), b]),
            g.mul(&[half, a]),
            g.one(),
        ]);
        let text = decimal_polynomial(&g, e, &[x, y]);
        let expected = "x^2 - x y + 1.41421356 x + 12 y + 1";
        assert_eq!(text.as_deref(), Some(expected));
    }
}
