//! Real zeros of functions of one parameter, enclosed: none is left out, and each interval holds exactly one.
//!
//! They are isolated by bisection with the mean value form ([`isolation`](crate::isolation)). Polynomials are split into square-free
//! factors first, so that zeros are simple.

use crate::isolation::{isolated, Enclosed, Look, Root};
use crate::steady::closed;
use chetaev_symbolic::factors::factors;
use chetaev_symbolic::number::ball::{Ball, Precision};
use chetaev_symbolic::{Expr, Graph, Symbol};
use dashu_ratio::RBig;
use std::cmp::Ordering;

/// Bits of the enclosures.
const BITS: usize = 256;
/// At most so many intervals are looked at for one function: some hundred serve a polynomial of degree 20.
const INTERVALS: usize = 40_000;
/// A zero is enclosed to 2^−64 of the range: more than double precision shows.
const REFINEMENTS: usize = 64;

/// A rational number as a person reads it, rounded to double precision.
pub fn decimal(value: &RBig) -> String {
    if value.is_int() {
        value.to_string()
    } else {
        format!("{}", value.to_f64().value())
    }
}

/// The zeros of `e` as a function of `symbol` in the closed interval from `low` to `high`, ascending. `None` where that was not decided:
/// other symbols occur, a zero is multiple and cannot be divided out, or the function is not defined everywhere there.
pub fn real_roots(
    g: &Graph,
    e: Expr,
    symbol: Symbol,
    low: &RBig,
    high: &RBig,
) -> Option<Vec<Root>> {
    let parts = match factors(g, e, &[symbol]) {
        Some(list) => list.into_iter().map(|(factor, _)| factor).collect(),
        None => vec![e],
    };
    let mut found = Vec::new();
    for part in parts {
        found.extend(Function::new(g, part, symbol).roots(low, high)?);
    }
    found.sort_by(|a, b| a.low.cmp(&b.low));
    found.dedup();
    Some(found)
}

/// The sign of `e` at a value of `symbol`; `None` where it is not decided.
pub fn sign_at(g: &Graph, e: Expr, symbol: Symbol, at: &RBig) -> Option<Ordering> {
    let value = (g.symbol_expr(symbol), g.number(at.clone()));
    sign_of(g, g.substitute(e, &[value]))
}

/// Decimal bounds of a number, at a value of a symbol if one is given; `None` where it is not enclosed.
pub(crate) fn bounds_at(
    g: &Graph,
    e: Expr,
    at: Option<(Symbol, &RBig)>,
) -> Option<(String, String)> {
    let value = at.map(|(symbol, at)| (g.symbol_expr(symbol), g.number(at.clone())));
    let e = value.map_or(e, |value| g.substitute(e, &[value]));
    let found = g
        .enclose(&[e], &Precision::new(BITS), &|_| None)
        .ok()?
        .pop()?;
    Some(found.to_decimal_interval(20))
}

/// The sign of `e` for all values of `symbol` in an enclosure; `None` where it is not one.
pub fn sign_over(g: &Graph, e: Expr, symbol: Symbol, root: &Root) -> Option<Ordering> {
    let over = ball(&root.low, &root.high);
    let value = |s: Symbol| (s == symbol).then(|| over.clone());
    let found = g.enclose(&[e], &Precision::new(BITS), &value).ok()?.pop()?;
    found.sign()
}

/// The sign of a number; `None` where it is not decided, or where a symbol occurs.
pub fn sign_of(g: &Graph, e: Expr) -> Option<Ordering> {
    let e = closed(g, e);
    if g.is_zero(e) {
        return Some(Ordering::Equal);
    }
    let ball = g
        .enclose(&[e], &Precision::new(BITS), &|_| None)
        .ok()?
        .pop()?;
    ball.sign()
}

/// A function with its derivative.
struct Function<'g> {
    graph: &'g Graph,
    value: Expr,
    slope: Expr,
    symbol: Symbol,
    precision: Precision,
}

impl Function<'_> {
    fn new(graph: &Graph, value: Expr, symbol: Symbol) -> Function<'_> {
        Function {
            graph,
            value,
            slope: graph.diff(value, symbol),
            symbol,
            precision: Precision::new(BITS),
        }
    }

    fn over(&self, e: Expr, interval: &Ball) -> Option<Ball> {
        let value = |s: Symbol| (s == self.symbol).then(|| interval.clone());
        self.graph
            .enclose(&[e], &self.precision, &value)
            .ok()?
            .pop()
    }

    /// The value over an interval by the mean value form.
    fn mean_value(&self, low: &RBig, high: &RBig, slope: &Ball) -> Option<Ball> {
        let middle = (low + high) / RBig::from(2);
        let own = self.over(self.value, &point(&middle))?;
        let width = self.precision.sub(&ball(low, high), &point(&middle)).ok()?;
        let change = self.precision.mul(slope, &width).ok()?;
        self.precision.add(&own, &change).ok()
    }

    fn roots(&self, low: &RBig, high: &RBig) -> Option<Vec<Root>> {
        let mut found: Vec<Root> = Vec::new();
        for end in [low, high] {
            if self.sign(end)? == Ordering::Equal {
                found.push(Root {
                    low: end.clone(),
                    high: end.clone(),
                });
            }
        }
        found.dedup();
        found.extend(isolated(self, low, high, INTERVALS, REFINEMENTS)?);
        Some(found)
    }
}

impl Enclosed for Function<'_> {
    fn sign(&self, at: &RBig) -> Option<Ordering> {
        sign_at(self.graph, self.value, self.symbol, at)
    }

    fn between(&self, low: &RBig, high: &RBig) -> Look {
        let over = ball(low, high);
        let slope = self.over(self.slope, &over);
        let mean = slope.as_ref();
        let mean = mean.and_then(|slope| self.mean_value(low, high, slope));
        let excludes = |value: Option<Ball>| value.is_some_and(|value| value.excludes_zero());
        if excludes(mean) || excludes(self.over(self.value, &over)) {
            return Look::Empty;
        }
        if excludes(slope) {
            return Look::Monotonic;
        }
        Look::Open
    }
}

fn point(at: &RBig) -> Ball {
    Precision::new(BITS).rational(at)
}

/// The smallest ball about the middle that holds an interval.
pub(crate) fn ball(low: &RBig, high: &RBig) -> Ball {
    let precision = Precision::new(BITS);
    let union = precision.union(&point(low), &point(high));
    union.unwrap_or_else(|_| point(low))
}
