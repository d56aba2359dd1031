//! Evaluation at the state of a counterexample with as many digits as it takes: where cosh(40) stands beside 1, double
//! precision keeps no digit of a difference, and the twelve digits printed of a dependent velocity are not enough.

use super::{Sampled, Subject};
use chetaev_mechanics::sample::Point;
use chetaev_symbolic::number::ball::{self, Ball, Precision};
use chetaev_symbolic::verdict::PointValue;
use chetaev_symbolic::{Expr, Graph, Symbol};
use std::collections::BTreeMap;

/// Precisions tried.
const BITS: [usize; 3] = [512, 4096, 16384];
/// Each step of Newton's iteration doubles the digits; twelve of them are known.
const STEPS: usize = 14;
/// Bits of the printed digits that must not be moved.
const PRINTED: i64 = 30;

/// A state: exact independent data, dependent data as printed, and a value for everything else.
pub(super) struct State<'a> {
    pub(super) subject: &'a Subject<'a>,
    pub(super) point: &'a [PointValue],
    pub(super) other: f64,
}

impl State<'_> {
    /// The largest |left − right|, as mantissa and decimal exponent, at the admissible state with these independent data
    /// and this close to the dependent ones; `None` where no precision tells it from zero, or no such state is found.
    pub(super) fn largest_difference(&self, left: &[Expr], right: &[Expr]) -> Option<(f64, i64)> {
        let g = &self.subject.cx.system.graph;
        let all: Vec<Expr> = left.iter().chain(right).copied().collect();
        BITS.iter().find_map(|&bits| {
            let precision = Precision::new(bits);
            let point = self.refined(&precision)?;
            let value = |s: Symbol| Some(self.value(g, &point, s));
            let balls = g.enclose(&all, &precision, &value).ok()?;
            let (left, right) = balls.split_at(left.len());
            let differences: Option<Vec<Ball>> = left
                .iter()
                .zip(right)
                .map(|(a, b)| precision.sub(a, b).ok())
                .collect();
            differences?
                .iter()
                .filter(|difference| difference.excludes_zero())
                .filter_map(|difference| scientific(&difference.to_decimal_interval(10).0))
                .max_by(|a, b| (a.1.cmp(&b.1)).then(a.0.total_cmp(&b.0)))
        })
    }

    fn value(&self, g: &Graph, point: &BTreeMap<String, Ball>, symbol: Symbol) -> Ball {
        let stated = point.get(&*g.symbol_text(symbol)).cloned();
        stated
            .or_else(|| Ball::from_f64(self.other))
            .unwrap_or_else(Ball::zero)
    }

    /// The data, the dependent ones brought onto the constraints by Newton's iteration; `None` where it leaves them.
    fn refined(&self, precision: &Precision) -> Option<BTreeMap<String, Ball>> {
        let (cx, mut point) = (self.subject.cx, BTreeMap::new());
        let g = &cx.system.graph;
        let mut unknowns = Vec::new();
        for value in self.point {
            let ball = match (&value.exact, &value.enclosure) {
                (Some(exact), _) => precision.rational(exact),
                (None, Some((lower, _))) => {
                    unknowns.push(value.name.clone());
                    Ball::from_f64(lower.parse().ok()?)?
                }
                (None, None) => continue,
            };
            point.insert(value.name.clone(), ball);
        }
        let velocities = cx.system.velocity_symbols();
        let symbols: Vec<Symbol> = velocities
            .into_iter()
            .filter(|&s| unknowns.iter().any(|name| **name == *g.symbol_text(s)))
            .collect();
        let rows = cx.selection.rows.iter();
        let f: Vec<Expr> = rows.map(|&row| cx.terms.constraints[row]).collect();
        if symbols.len() != f.len() {
            return None;
        }
        let jacobian = g.jacobian(&f, &symbols).concat();
        for _ in 0..STEPS {
            let value = |s: Symbol| Some(self.value(g, &point, s));
            let step = newton_step(g, precision, (&f, &jacobian), &value)?;
            for (&symbol, step) in symbols.iter().zip(&step) {
                let old = self.value(g, &point, symbol);
                let size = old.log2_ceil().unwrap_or(0).max(-PRINTED);
                if step.log2_ceil().is_some_and(|s| s > size - PRINTED) {
                    return None;
                }
                let new = precision.sub(&old, step).ok()?.midpoint();
                point.insert(g.symbol_text(symbol).to_string(), new);
            }
        }
        Some(point)
    }
}

/// J⁻¹ f, by which Newton's iteration lessens the unknowns of f = 0.
fn newton_step(
    g: &Graph,
    precision: &Precision,
    (f, jacobian): (&[Expr], &[Expr]),
    value: &dyn Fn(Symbol) -> Option<Ball>,
) -> Option<Vec<Ball>> {
    let middle = |balls: Vec<Ball>| balls.iter().map(Ball::midpoint).collect::<Vec<_>>();
    let right = middle(g.enclose(f, precision, value).ok()?);
    let matrix = middle(g.enclose(jacobian, precision, value).ok()?);
    ball::solve(precision, f.len(), matrix, &[right])
        .ok()?
        .pop()
}

/// The largest share of |left − right| in 1 + |left| + |right| at a state whose dependent velocities are brought onto the constraints,
/// with digits enough that rounding is none; `None` where it cannot be evaluated.
pub(super) fn share_of_difference(
    subject: &Sampled<'_>,
    left: &[Expr],
    right: &[Expr],
    state: &Point,
) -> Option<f64> {
    let (cx, precision) = (subject.cx, Precision::new(BITS[0]));
    let g = &cx.system.graph;
    let rows = subject.natural.rows.iter();
    let f: Vec<Expr> = rows.map(|&row| cx.terms.constraints[row]).collect();
    let dependent = subject.natural.dependent.iter();
    let unknowns: Vec<Symbol> = dependent
        .map(|&d| cx.system.coordinates[d].v_symbol)
        .collect();
    let jacobian = g.jacobian(&f, &unknowns).concat();
    let mut found: BTreeMap<Symbol, Ball> = BTreeMap::new();
    for (&symbol, &value) in state {
        found.insert(symbol, Ball::from_f64(value)?);
    }
    let steps = if f.is_empty() { 0 } else { STEPS };
    for _ in 0..steps {
        let value = |s: Symbol| found.get(&s).cloned();
        let step = newton_step(g, &precision, (&f, &jacobian), &value)?;
        for (symbol, step) in unknowns.iter().zip(&step) {
            let new = precision.sub(found.get(symbol)?, step).ok()?.midpoint();
            found.insert(*symbol, new);
        }
    }
    let all: Vec<Expr> = left.iter().chain(right).copied().collect();
    let values = g
        .enclose(&all, &precision, &|s| found.get(&s).cloned())
        .ok()?;
    let (left, right) = values.split_at(left.len());
    let mut largest = 0.0_f64;
    for (a, b) in left.iter().zip(right) {
        let difference = precision.sub(a, b).ok()?.to_f64().abs();
        largest = largest.max(difference / (1.0 + a.to_f64().abs() + b.to_f64().abs()));
    }
    Some(largest)
}

/// The absolute value of a decimal number as mantissa below ten and exponent, as it may lie beyond double precision.
pub(super) fn scientific(text: &str) -> Option<(f64, i64)> {
    let (mantissa, exponent) = text.split_once('e').unwrap_or((text, "0"));
    let (mut mantissa, mut exponent) = (
        mantissa.parse::<f64>().ok()?.abs(),
        exponent.parse::<i64>().ok()?,
    );
    while mantissa >= 10.0 && mantissa.is_finite() {
        (mantissa, exponent) = (mantissa / 10.0, exponent + 1);
    }
    while mantissa < 1.0 && mantissa > 0.0 {
        (mantissa, exponent) = (mantissa * 10.0, exponent - 1);
    }
    mantissa.is_finite().then_some((mantissa, exponent))
}

/// Whether |a| is at least `share` of |b|, both of them not zero.
pub(super) fn reaches(a: (f64, i64), b: (f64, i64), share: f64) -> bool {
    let exponents = (a.1 - b.1).clamp(-300, 300) as i32;
    a.0 * 10_f64.powi(exponents) >= share * b.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_beyond_double_precision() {
        assert_eq!(scientific("-2.5e4000"), Some((2.5, 4000)));
        assert_eq!(scientific("-250"), Some((2.5, 2)));
        assert_eq!(scientific("0.25"), Some((2.5, -1)));
        assert!(reaches((2.5, 4000), (2.5, 4000), 0.999));
        assert!(!reaches((2.5, 3999), (2.5, 4000), 0.999));
        assert!(reaches((1.0, 4000), (2.5, -4000), 0.999));
    }
}
