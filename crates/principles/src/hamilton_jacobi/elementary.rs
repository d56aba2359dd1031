//! Integrals of the quadratures of a separated complete integral, where they are elementary.

use super::applicable::free;
use chetaev_mechanics::claims::Context;
use chetaev_mechanics::equations::unused_name;
use chetaev_mechanics::prover::assumptions;
use chetaev_symbolic::factors::factored;
use chetaev_symbolic::zero::known_sign;
use chetaev_symbolic::{simplify, Expr, Function, Node, Symbol, Verdict};

/// A function whose derivative was proved to be the integrand.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Antiderivative {
    /// The function.
    pub value: Expr,
    /// What is positive where the function is real, and not known to be so.
    pub positive: Vec<Expr>,
}

impl Antiderivative {
    fn everywhere(value: Expr) -> Antiderivative {
        Antiderivative {
            value,
            positive: Vec::new(),
        }
    }
}

/// `∫ e dq` for `e = a + b √X` and `e = a + b √X/q`, a and b free of q and X a polynomial in q of the second degree at most; √X/q may be written
/// as one root, `√(A + B/q + C/q²)`. Several functions, one for each sign of a coefficient, where that is not known and the coefficient
/// can have it; none where the integral is not of this family. The derivative of each is proved to be e, by exact arithmetic.
///
/// Source: I. S. Gradshteyn, I. M. Ryzhik, Table of Integrals, Series, and Products, 2.26, with arc tangents in the place of arc
/// sines and the root as it is written in e.
pub fn elementary(cx: &Context<'_>, e: Expr, q: Symbol) -> Vec<Antiderivative> {
    let g = &cx.system.graph;
    let derived = |found: &Antiderivative| {
        let residual = g.sub(g.diff(found.value, q), e);
        let verdict = cx.prover.identity(cx.system, &[residual], &free(), "");
        matches!(verdict, Verdict::Proved(_))
    };
    let mut found = candidates(cx, e, q).unwrap_or_default();
    found.retain(derived);
    found
}

fn candidates(cx: &Context<'_>, e: Expr, q: Symbol) -> Option<Vec<Antiderivative>> {
    let (system, g) = (cx.system, &cx.system.graph);
    let coordinate = g.symbol_expr(q);
    let roots = roots(cx, e, q);
    let &[root] = roots.as_slice() else {
        let value = g.mul(&[e, coordinate]);
        let constant = roots.is_empty() && !g.contains_any(e, &[q]);
        return constant.then(|| vec![Antiderivative::everywhere(value)]);
    };
    let name = unused_name(system, "root");
    let (own, symbol) = (g.symbol(&name, 0), g.intern_symbol(&name, 0));
    let linear = g.substitute(e, &[(root, own)]);
    let factor = simple(cx, g.diff(linear, symbol));
    let rest = g.substitute(linear, &[(own, g.zero())]);
    let Node::Power { base, .. } = g.node(root) else {
        return None;
    };
    let of_root = of_root(cx, factor, *base, q)?;
    if g.any_contains_any(&[rest], &[q, symbol]) {
        return None;
    }
    let with = |found: Antiderivative| Antiderivative {
        value: g.add(&[g.mul(&[rest, coordinate]), found.value]),
        ..found
    };
    Some(of_root.into_iter().map(with).collect())
}

fn simple(cx: &Context<'_>, e: Expr) -> Expr {
    simplify::simplify(&cx.system.graph, e, &simplify::Options::default())
}

/// Square roots that contain q.
fn roots(cx: &Context<'_>, e: Expr, q: Symbol) -> Vec<Expr> {
    let g = &cx.system.graph;
    let half = g.div(g.one(), g.integer(2));
    let is_root =
        |e: &Expr| matches!(g.node(*e), Node::Power { exponent, .. } if *exponent == half);
    let all = g.reachable(&[e]).into_iter();
    all.filter(is_root)
        .filter(|&root| g.contains_any(root, &[q]))
        .collect()
}

/// A function whose square is e: a product where e is seen to be a square, whatever its sign.
fn root_of(cx: &Context<'_>, e: Expr) -> Expr {
    let g = &cx.system.graph;
    let halved = factored(g, e).and_then(|parts| {
        let halved = |&(f, n): &(Expr, i64)| (n % 2 == 0).then(|| g.powi(f, n / 2));
        let product: Option<Vec<Expr>> = parts.factors.iter().map(halved).collect();
        let number = g.scale(&parts.coefficient, g.one());
        Some(g.mul(&[g.sqrt(number), g.mul(&product?)]))
    });
    halved.unwrap_or_else(|| simple(cx, g.sqrt(e)))
}

/// `A + B q + C q²` with its square root as the integrand has it.
struct Quadratic {
    coefficients: [Expr; 3],
    /// √X, up to a sign that does not change.
    root: Expr,
    q: Expr,
}

impl Quadratic {
    fn new(cx: &Context<'_>, e: Expr, root: Expr, symbol: Symbol) -> Option<Quadratic> {
        let (g, q) = (&cx.system.graph, cx.system.graph.symbol_expr(symbol));
        let e = simple(cx, e);
        let at_zero = |e: Expr| simple(cx, g.substitute(e, &[(q, g.zero())]));
        let first = simple(cx, g.diff(e, symbol));
        let second = simple(cx, g.diff(first, symbol));
        if g.contains_any(second, &[symbol]) {
            return None;
        }
        let c = simple(cx, g.div(second, g.integer(2)));
        let b = simple(cx, g.sub(first, g.mul(&[second, q])));
        let a = simple(cx, g.sub(e, g.add(&[g.mul(&[b, q]), g.mul(&[c, q, q])])));
        let coefficients = match g.any_contains_any(&[a, b], &[symbol]) {
            // The difference may not be seen to cancel; the values at zero are the same.
            true => [at_zero(e), at_zero(first), c],
            false => [a, b, c],
        };
        Some(Quadratic {
            coefficients,
            root,
            q,
        })
    }
}

/// `∫ factor √R dq` for a factor that is free of q, or so but for 1/q, and R or R q² of the second degree.
fn of_root(
    cx: &Context<'_>,
    factor: Expr,
    radicand: Expr,
    q: Symbol,
) -> Option<Vec<Antiderivative>> {
    let g = &cx.system.graph;
    let (at, root) = (g.symbol_expr(q), g.sqrt(radicand));
    let times = |weight: Expr, list: Vec<Antiderivative>| {
        let scaled = |found: Antiderivative| Antiderivative {
            value: g.mul(&[weight, found.value]),
            ..found
        };
        list.into_iter().map(scaled).collect()
    };
    let over = simple(cx, g.mul(&[factor, at]));
    let is_free = |e: Expr| !g.contains_any(e, &[q]);
    if is_free(factor) {
        if let Some(x) = Quadratic::new(cx, radicand, root, q) {
            return Some(times(factor, x.integral(cx)?));
        }
        // √R = √X/q, up to the sign of q.
        let cleared = g.mul(&[radicand, at, at]);
        let x = Quadratic::new(cx, cleared, g.mul(&[root, at]), q)?;
        return Some(times(factor, x.integral_over_q(cx)?));
    }
    if !is_free(over) {
        return None;
    }
    let x = Quadratic::new(cx, radicand, root, q)?;
    Some(times(over, x.integral_over_q(cx)?))
}

impl Quadratic {
    /// `2 C q + B`.
    fn slope(&self, cx: &Context<'_>) -> Expr {
        let (g, [_, b, c]) = (&cx.system.graph, self.coefficients);
        g.add(&[g.mul(&[g.integer(2), c, self.q]), b])
    }

    /// `∫ √X dq`.
    fn integral(&self, cx: &Context<'_>) -> Option<Vec<Antiderivative>> {
        let (g, [a, b, c]) = (&cx.system.graph, self.coefficients);
        let number = |n: i64| g.integer(n);
        if g.is_zero(c) {
            let cube = g.powi(self.root, 3);
            let value = || g.div(g.mul(&[number(2), cube]), g.mul(&[number(3), b]));
            return (!g.is_zero(b)).then(|| vec![Antiderivative::everywhere(value())]);
        }
        let discriminant = g.sub(g.mul(&[b, b]), g.mul(&[number(4), a, c]));
        let weight = g.div(discriminant, g.mul(&[number(8), c]));
        let algebraic = g.div(g.mul(&[self.slope(cx), self.root]), g.mul(&[number(4), c]));
        let with = |found: Antiderivative| Antiderivative {
            value: g.sub(algebraic, g.mul(&[weight, found.value])),
            ..found
        };
        Some(self.inverse(cx).into_iter().map(with).collect())
    }

    /// `∫ √X/q dq = √X + B/2 ∫ dq/√X + A ∫ dq/(q √X)`.
    fn integral_over_q(&self, cx: &Context<'_>) -> Option<Vec<Antiderivative>> {
        let (g, [_, b, c]) = (&cx.system.graph, self.coefficients);
        let half = g.div(b, g.integer(2));
        // ∫ dq/√(A + B q) = 2 √X/B.
        let by_slope = match (g.is_zero(b), g.is_zero(c)) {
            (true, _) => vec![Antiderivative::everywhere(g.zero())],
            (_, true) => vec![Antiderivative::everywhere(
                g.div(g.mul(&[g.integer(2), self.root]), b),
            )],
            _ => self.inverse(cx),
        };
        let at_zero = self.inverse_over_q(cx);
        let pairs = at_zero
            .iter()
            .flat_map(|a| by_slope.iter().map(move |b| (a, b)));
        let sum = |(own, other): (&Antiderivative, &Antiderivative)| Antiderivative {
            value: g.add(&[self.root, own.value, g.mul(&[half, other.value])]),
            positive: [own.positive.clone(), other.positive.clone()].concat(),
        };
        let found: Vec<Antiderivative> = pairs.map(sum).collect();
        (!found.is_empty()).then_some(found)
    }

    /// `A ∫ dq/(q √X)`: `−s atan((B q + 2 A)/(2 s √X))` with s² = −A for A < 0, `−s ln((2 A + B q + 2 s √X)/q)` with s² = A for A > 0;
    /// either sign of s gives the same.
    fn inverse_over_q(&self, cx: &Context<'_>) -> Vec<Antiderivative> {
        let (g, [a, b, _]) = (&cx.system.graph, self.coefficients);
        if g.is_zero(a) {
            return vec![Antiderivative::everywhere(g.zero())];
        }
        let above = g.add(&[g.mul(&[b, self.q]), g.mul(&[g.integer(2), a])]);
        let arc = || {
            let s = root_of(cx, g.neg(a));
            let tangent = g.div(above, g.mul(&[g.integer(2), s, self.root]));
            g.neg(g.mul(&[s, g.apply(Function::Atan, &[tangent])]))
        };
        let logarithm = || {
            let s = root_of(cx, a);
            let argument = g.add(&[above, g.mul(&[g.integer(2), s, self.root])]);
            let argument = g.div(argument, self.q);
            g.neg(g.mul(&[s, g.apply(Function::Log, &[argument])]))
        };
        by_sign(cx, a, &arc, &logarithm)
    }

    /// `∫ dq/√X` for C ≠ 0: a logarithm for C > 0, an arc tangent, which contains no further root as the arc sine does, for C < 0.
    fn inverse(&self, cx: &Context<'_>) -> Vec<Antiderivative> {
        let (g, [_, _, c]) = (&cx.system.graph, self.coefficients);
        let (slope, two) = (self.slope(cx), g.integer(2));
        let opposite = g.neg(c);
        let logarithm = || {
            let lead = g.sqrt(c);
            let argument = g.add(&[g.mul(&[two, lead, self.root]), slope]);
            g.div(g.apply(Function::Log, &[argument]), lead)
        };
        let arc = || {
            let lead = g.sqrt(opposite);
            let tangent = g.div(g.neg(slope), g.mul(&[two, lead, self.root]));
            g.div(g.apply(Function::Atan, &[tangent]), lead)
        };
        by_sign(cx, c, &arc, &logarithm)
    }
}

/// A function for a negative coefficient and one for a positive: that of the sign which the coefficient has, or both with what is
/// positive there. One that is real for no values of the parameters is left out.
fn by_sign(
    cx: &Context<'_>,
    coefficient: Expr,
    negative: &dyn Fn() -> Expr,
    positive: &dyn Fn() -> Expr,
) -> Vec<Antiderivative> {
    let g = &cx.system.graph;
    let opposite = g.neg(coefficient);
    let sign = |e: Expr| known_sign(g, e, &assumptions(cx.system));
    let of = |value: &dyn Fn() -> Expr, own: Expr, other: Expr| {
        // A coefficient that is no less than zero, and is zero for particular values, has been taken not to vanish.
        let is_free = sign(own).is_nonnegative() || sign(other).is_nonpositive();
        let condition = (!is_free).then(|| simple(cx, own));
        let never = sign(own).is_nonpositive() || sign(other).is_nonnegative();
        (!never).then(|| Antiderivative {
            value: value(),
            positive: condition.into_iter().collect(),
        })
    };
    let both = [
        of(negative, opposite, coefficient),
        of(positive, coefficient, opposite),
    ];
    both.into_iter().flatten().collect()
}
