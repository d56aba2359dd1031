//! Real zeros of functions of one parameter, enclosed: none is left out, and each interval holds exactly one.
//!
//! They are isolated by bisection with the mean value form ([`isolation`](crate::isolation)). Polynomials are split into square-free
//! factors first, so that zeros are simple; a function with square roots vanishes where its `norm` does, if at all.

use crate::isolation::{isolated, Enclosed, Look, Root};
use crate::norm::Norm;
use crate::real_values::{conditions, Condition};
use crate::steady::closed;
use chetaev_mechanics::system::Relation;
use chetaev_symbolic::factors::{coefficients, factors, remainder};
use chetaev_symbolic::number::ball::{Ball, Precision};
use chetaev_symbolic::{Expr, Graph, Node, Symbol};
use dashu_ratio::RBig;
use std::cmp::Ordering;

/// Bits of the enclosures.
const BITS: usize = 256;
/// The same where algebraic numbers occur.
const MORE: [usize; 2] = [1_024, 4_096];
/// At most so many intervals are looked at for one function: some hundred serve a polynomial of degree 20.
const INTERVALS: usize = 40_000;
/// A zero is enclosed to 2^−64 of itself: more than double precision shows.
pub(crate) const USUAL: usize = 64;
/// The same where enclosures to [`USUAL`] overlap.
pub(crate) const FINE: usize = 240;

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
    let zeros = zeros_of_factors(g, e, symbol, (low, high), USUAL)?;
    Some(zeros.into_iter().map(|own| own.root).collect())
}

/// A zero of a factor.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Zero {
    pub(crate) root: Root,
    /// Factors of one function have no zero in common.
    pub(crate) factor: Expr,
}

/// Whether enclosures of zeros of different factors overlap: they may hold one zero, or two.
pub(crate) fn overlap(zeros: &[Zero]) -> bool {
    let mut zeros: Vec<&Zero> = zeros.iter().collect();
    zeros.sort_by(|a, b| a.root.low.cmp(&b.root.low));
    zeros.windows(2).any(|pair| {
        matches!(pair, [a, b] if a.factor != b.factor && a.root.low != a.root.high && b.root.low <= a.root.high)
    })
}

/// The same with enclosures to a power of two, and with the factors.
pub(crate) fn zeros_of_factors(
    g: &Graph,
    e: Expr,
    symbol: Symbol,
    (low, high): (&RBig, &RBig),
    halvings: usize,
) -> Option<Vec<Zero>> {
    let parts = match factors(g, e, &[symbol]) {
        Some(list) => list.into_iter().map(|(factor, _)| factor).collect(),
        None => vec![e],
    };
    let mut found = Vec::new();
    for factor in parts {
        let roots = match (low >= &RBig::ZERO).then(|| in_its_root(g, factor, symbol)) {
            Some(Some(own)) => own.roots((low, high), halvings)?,
            _ => match Norm::of(g, factor, symbol) {
                Some(norm) => roots_by_norm(g, &norm, symbol, (low, high), halvings)?,
                None => Function::new(g, factor, symbol).roots(low, high, halvings)?,
            },
        };
        found.extend(roots.into_iter().map(|root| Zero { root, factor }));
    }
    // A factor may vanish where another one is not real.
    let needed = conditions(g, &[e]);
    let fails = |own: &Condition, zero: &Zero| {
        let sign = sign_over(g, own.function, symbol, &zero.root);
        own.relation != Relation::NotEqual && sign.is_some_and(|sign| !own.holds(sign))
    };
    found.retain(|zero| !needed.iter().any(|own| fails(own, zero)));
    found.sort_by(|a, b| a.root.low.cmp(&b.root.low));
    found.dedup();
    Some(found)
}

/// The zeros of a function with square roots are among those of its norm.
fn roots_by_norm(
    g: &Graph,
    norm: &Norm,
    symbol: Symbol,
    (low, high): (&RBig, &RBig),
    halvings: usize,
) -> Option<Vec<Root>> {
    let zeros = zeros_of_factors(g, norm.value, symbol, (low, high), halvings)?;
    let of_function = |zero: Zero| {
        let vanishes = vanishes(g, norm, symbol, &zero);
        vanishes.map(|own| own.then_some(zero.root))
    };
    let found: Vec<Option<Root>> = zeros.into_iter().map(of_function).collect::<Option<_>>()?;
    Some(found.into_iter().flatten().collect())
}

/// Whether a function vanishes at a zero of its norm; `None` where that was not decided.
fn vanishes(g: &Graph, norm: &Norm, symbol: Symbol, zero: &Zero) -> Option<bool> {
    let Root { low, high } = &zero.root;
    let sign = |e: Expr| sign_over(g, e, symbol, &zero.root);
    if sign(norm.radicand) == Some(Ordering::Less) {
        return Some(false);
    }
    if low == high {
        return Some(sign_at(g, norm.function, symbol, low)? == Ordering::Equal);
    }
    let rest = remainder(g, norm.radicand, zero.factor, symbol);
    if rest.is_some_and(|rest| g.is_zero(rest)) {
        return Some(true);
    }
    match (sign(norm.function), sign(norm.conjugate)) {
        (Some(Ordering::Less | Ordering::Greater), _) => Some(false),
        (_, Some(Ordering::Less | Ordering::Greater)) => Some(true),
        _ => None,
    }
}

/// A function of a number that is not negative, in which roots of it occur, as one of the root r with p = r^k: where p^(1/2) has no slope, at
/// zero, r has one.
struct InItsRoot<'g> {
    graph: &'g Graph,
    value: Expr,
    root: Symbol,
    k: isize,
}

/// `None` where no root of the number itself occurs.
fn in_its_root(g: &Graph, e: Expr, symbol: Symbol) -> Option<InItsRoot<'_>> {
    let own = g.symbol_expr(symbol);
    let powers = g
        .reachable(&[e])
        .into_iter()
        .filter_map(|part| match g.node(part) {
            Node::Power { base, exponent } if *base == own => {
                let exponent = g.as_number(*exponent)?;
                Some((part, exponent.clone()))
            }
            _ => None,
        });
    let powers: Vec<(Expr, RBig)> = powers.collect();
    let parts = powers
        .iter()
        .map(|own| isize::try_from(own.1.denominator()).ok());
    let parts: Vec<isize> = parts.collect::<Option<_>>()?;
    let serves = |k: &isize| parts.iter().all(|part| k % part == 0);
    let k = (1..=LARGEST_ROOT).find(serves).filter(|&k| k > 1)?;
    // No name of a model contains a space.
    let root = g.intern_symbol(&format!("root of {}", g.symbol_text(symbol)), 0);
    let power = |exponent: &RBig| {
        let exponent = exponent * RBig::from(k);
        g.pow(g.symbol_expr(root), g.number(exponent))
    };
    let mut pairs: Vec<(Expr, Expr)> = powers.iter().map(|(e, n)| (*e, power(n))).collect();
    pairs.push((own, power(&RBig::ONE)));
    let value = g.substitute_all(&[e], &pairs)[0];
    Some(InItsRoot {
        graph: g,
        value,
        root,
        k,
    })
}

/// Higher roots are not looked at.
const LARGEST_ROOT: isize = 12;

impl InItsRoot<'_> {
    fn roots(&self, (low, high): (&RBig, &RBig), halvings: usize) -> Option<Vec<Root>> {
        let power = |at: &RBig| at.pow(self.k);
        // The range of the root, rounded outwards.
        let mut upper = RBig::ONE;
        while &power(&upper) < high {
            upper *= RBig::from(2);
        }
        let zeros = zeros_of_factors(
            self.graph,
            self.value,
            self.root,
            (&RBig::ZERO, &upper),
            halvings,
        )?;
        let roots = zeros.into_iter().map(|own| Root {
            low: power(&own.root.low),
            high: power(&own.root.high),
        });
        let inside = |own: &Root| &own.high >= low && &own.low <= high;
        Some(roots.filter(inside).collect())
    }
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
    // Powers of an algebraic number stand with long coefficients, and cancel.
    let more: &[usize] = if g.holds_algebraic(e) { &MORE } else { &[] };
    let sign = |bits: usize| {
        let found = g.enclose(&[e], &Precision::new(bits), &|_| None).ok()?;
        found.first()?.sign()
    };
    [BITS].iter().chain(more).find_map(|&bits| sign(bits))
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

    fn roots(&self, low: &RBig, high: &RBig, halvings: usize) -> Option<Vec<Root>> {
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
        found.extend(isolated(self, low, high, INTERVALS, halvings)?);
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

/// A number beyond which, on both sides, none of these functions of a parameter vanishes, and well before which none does, so that there is
/// room for samples; `None` where one is no polynomial, with square roots in it or not.
pub fn bound_of(g: &Graph, es: &[Expr], symbol: Symbol) -> Option<RBig> {
    let bounds = es.iter().map(|&e| cauchy_bound(g, e, symbol));
    let largest = bounds.collect::<Option<Vec<RBig>>>()?.into_iter().max();
    largest.map(|bound| bound * RBig::from(2))
}

/// 1 + max |aᵢ/aₙ| as an integer (Cauchy 1829), of the norm where square roots occur; `None` where `e` is no polynomial with numbers as coefficients.
fn cauchy_bound(g: &Graph, e: Expr, symbol: Symbol) -> Option<RBig> {
    let precision = Precision::new(128);
    let Some(list) = coefficients(g, e, symbol) else {
        return cauchy_bound(g, Norm::of(g, e, symbol)?.value, symbol);
    };
    let balls = g.enclose(&list, &precision, &|_| None).ok()?;
    let leading = balls.last().filter(|b| b.excludes_zero())?;
    let mut bound = RBig::from(2);
    for own in &balls {
        let ratio = precision.abs(&precision.div(own, leading).ok()?);
        let above = RBig::from(2) + ratio.upper().to_rational()?;
        bound = bound.max(RBig::from(above.ceil()));
    }
    Some(bound)
}
