//! Antiderivatives in one variable: of polynomials, powers, sines, cosines and exponentials of linear functions, products of these, of
//! rational functions, of roots of quadratic polynomials, and what a substitution makes one of them.
//!
//! Nothing rests on them: whoever uses one proves what follows from it.

mod circular;
mod rational;
mod roots;

use circular::{by_half_angle, circular, exponential_circular, of_power};
use rational::rational;
use roots::with_root;

use super::presented::exponential;
use super::solved::{root, solved};
use chetaev_symbolic::rational::content;
use chetaev_symbolic::simplify::{simplify, Options};
use chetaev_symbolic::{Expr, Function, Graph, Node, Symbol};
use std::cell::Cell;

/// So many substitutions and partial integrations stand inside each other at most.
const DEPTH: usize = 5;

/// So many parts are tried for a substitution.
const PARTS: usize = 12;

/// Functions whose derivatives are plainer.
const INNER: [Function; 7] = [
    Function::Log,
    Function::Atan,
    Function::Asin,
    Function::Acos,
    Function::Asinh,
    Function::Acosh,
    Function::Atanh,
];

/// The most substitutions and partial integrations for one antiderivative.
const WORK: usize = 150;

/// How many of them may still stand inside each other, and be tried.
#[derive(Clone, Copy)]
struct Depth<'a> {
    left: usize,
    work: &'a Cell<usize>,
}

impl Depth<'_> {
    fn deeper(self) -> Option<Self> {
        self.work.set(self.work.get().checked_sub(1)?);
        let left = self.left.checked_sub(1)?;
        Some(Depth { left, ..self })
    }
}

/// The most terms of a product multiplied out.
const TERMS: usize = 120;

/// Larger expressions, in nodes, are not looked at.
const NODES: usize = 300;

/// An expression as short as it is made here; larger ones as they are.
pub(super) fn tidy(g: &Graph, e: Expr) -> Expr {
    match g.reachable(&[e]).len() <= NODES {
        true => simplify(g, e, &Options::default()),
        false => e,
    }
}

/// A function with this derivative by `x`; `None` where none was found.
pub(super) fn primitive(g: &Graph, e: Expr, x: Symbol) -> Option<Expr> {
    let work = Cell::new(WORK);
    let depth = Depth {
        left: DEPTH,
        work: &work,
    };
    of(g, e, x, depth)
}

fn of(g: &Graph, e: Expr, x: Symbol, depth: Depth<'_>) -> Option<Expr> {
    if !g.contains_any(e, &[x]) {
        return Some(g.mul(&[e, g.symbol_expr(x)]));
    }
    if depth.left == 0 || g.reachable(&[e]).len() > NODES {
        return None;
    }
    termwise(g, expanded(g, e), x, depth)
        .or_else(|| by_substitution(g, e, x, depth))
        .or_else(|| {
            let short = Some(tidy(g, e)).filter(|&short| short != e)?;
            of(g, short, x, depth.deeper()?)
        })
}

fn termwise(g: &Graph, e: Expr, x: Symbol, depth: Depth<'_>) -> Option<Expr> {
    let Node::Sum { constant, terms } = g.node(e) else {
        return of_product(g, e, x, depth);
    };
    let mut parts = vec![g.scale(constant, g.symbol_expr(x))];
    for (term, c) in terms.iter() {
        parts.push(g.scale(c, of_product(g, *term, x, depth)?));
    }
    Some(g.add(&parts))
}

/// Products of sums multiplied out, where that is short.
pub(super) fn expanded(g: &Graph, e: Expr) -> Expr {
    let terms = terms_of(g, e);
    match terms {
        Some(terms) => g.add(&terms),
        None => e,
    }
}

fn terms_of(g: &Graph, e: Expr) -> Option<Vec<Expr>> {
    match g.node(e) {
        Node::Sum { constant, terms } => {
            let mut all = vec![g.number(constant.clone())];
            for (term, c) in terms.iter() {
                all.extend(terms_of(g, *term)?.into_iter().map(|t| g.scale(c, t)));
            }
            (all.len() <= TERMS).then_some(all)
        }
        Node::Product {
            coefficient,
            factors,
        } => {
            let start = vec![g.number(coefficient.clone())];
            factors.iter().try_fold(start, |all, &factor| {
                multiplied(g, &all, &terms_of(g, factor)?)
            })
        }
        Node::Power { base, exponent } => match g.as_integer(*exponent) {
            Some(n @ 2..=6) if matches!(g.node(*base), Node::Sum { .. }) => {
                let own = terms_of(g, *base)?;
                (1..n).try_fold(own.clone(), |all, _| multiplied(g, &all, &own))
            }
            _ => Some(vec![e]),
        },
        _ => Some(vec![e]),
    }
}

fn multiplied(g: &Graph, a: &[Expr], b: &[Expr]) -> Option<Vec<Expr>> {
    let pairs = a
        .iter()
        .flat_map(|&x| b.iter().map(move |&y| g.mul(&[x, y])));
    (a.len() * b.len() <= TERMS).then(|| pairs.collect())
}

/// Of a product: what `x` is not in stands before the integral.
fn of_product(g: &Graph, e: Expr, x: Symbol, depth: Depth<'_>) -> Option<Expr> {
    let factors = match g.node(e) {
        Node::Product {
            coefficient,
            factors,
        } => {
            let mut all = factors.to_vec();
            all.push(g.number(coefficient.clone()));
            all
        }
        _ => vec![e],
    };
    let (own, free): (Vec<Expr>, Vec<Expr>) =
        factors.into_iter().partition(|&f| g.contains_any(f, &[x]));
    let found = match own.as_slice() {
        [] => Some(g.symbol_expr(x)),
        [one] => of_factor(g, *one, x),
        _ => None,
    };
    let whole = g.mul(&own);
    let found = found
        .or_else(|| circular(g, &own, x, depth))
        .or_else(|| with_root(g, &own, x))
        .or_else(|| by_parts(g, &own, x, depth))
        .or_else(|| exponential_circular(g, &own, x))
        .or_else(|| rational(g, whole, x))
        .or_else(|| by_substitution(g, whole, x, depth))
        .or_else(|| by_half_angle(g, whole, x))?;
    Some(g.mul(&[g.mul(&free), found]))
}

/// The slope of a linear function of `x`.
fn slope(g: &Graph, u: Expr, x: Symbol) -> Option<Expr> {
    let by = g.diff(u, x);
    let by = if g.contains_any(by, &[x]) {
        tidy(g, by)
    } else {
        by
    };
    (!g.contains_any(by, &[x]) && !g.is_zero(by)).then_some(by)
}

/// Of a power or a function of a linear function of `x`.
fn of_factor(g: &Graph, e: Expr, x: Symbol) -> Option<Expr> {
    if let Node::Apply {
        function,
        arguments,
    } = g.node(e)
    {
        let u = *arguments.first()?;
        let by = slope(g, u, x)?;
        return Some(g.div(of_function(g, *function, u)?, by));
    }
    let (u, n) = g.base_exponent(e);
    if g.contains_any(n, &[x]) {
        let by = slope(g, n, x)?;
        return (!g.contains_any(u, &[x]))
            .then(|| g.div(e, g.mul(&[by, g.apply(Function::Log, &[u])])));
    }
    if let Some(by) = slope(g, u, x) {
        let minus_one = g.as_integer(n) == Some(-1);
        g.as_number(n)?;
        let next = g.add(&[n, g.one()]);
        return Some(match minus_one {
            true => g.div(g.apply(Function::Log, &[u]), by),
            false => g.div(g.pow(u, next), g.mul(&[next, by])),
        });
    }
    if let (
        Node::Apply {
            function,
            arguments,
        },
        Some(power),
    ) = (g.node(u), g.as_integer(n))
    {
        let by = slope(g, *arguments.first()?, x)?;
        return Some(g.div(of_power(g, *function, arguments[0], power)?, by));
    }
    match g.as_integer(n) {
        Some(-1) => inverse_quadratic(g, u, x),
        _ => None,
    }
}

fn of_function(g: &Graph, function: Function, u: Expr) -> Option<Expr> {
    let log = |e: Expr| g.apply(Function::Log, &[e]);
    Some(match function {
        Function::Sin => g.neg(g.cos(u)),
        Function::Cos => g.sin(u),
        Function::Exp => g.exp(u),
        Function::Sinh => g.apply(Function::Cosh, &[u]),
        Function::Cosh => g.apply(Function::Sinh, &[u]),
        Function::Tan => g.neg(log(g.cos(u))),
        Function::Cot => log(g.sin(u)),
        Function::Tanh => log(g.apply(Function::Cosh, &[u])),
        Function::Log => g.sub(g.mul(&[u, log(u)]), u),
        Function::Atan => {
            let square = g.add(&[g.one(), g.powi(u, 2)]);
            let half = g.div(log(square), g.integer(2));
            g.sub(g.mul(&[u, g.apply(Function::Atan, &[u])]), half)
        }
        _ => return None,
    })
}

/// Of `1/(a x² + b x + c)` with numbers in the discriminant, or `b = 0` and an arctangent.
fn inverse_quadratic(g: &Graph, u: Expr, x: Symbol) -> Option<Expr> {
    let twice = tidy(g, g.diff(g.diff(u, x), x));
    if g.contains_any(twice, &[x]) || g.is_zero(twice) {
        return None;
    }
    let at = |e: Expr| tidy(g, g.substitute(e, &[(g.symbol_expr(x), g.zero())]));
    let (b, c) = (at(g.diff(u, x)), at(u));
    // 4 a c - b²
    let four = g.mul(&[g.integer(2), twice, c]);
    let determinant = tidy(g, g.sub(four, g.powi(b, 2)));
    let line = g.add(&[g.mul(&[twice, g.symbol_expr(x)]), b]);
    let is_negative = g
        .as_number(determinant)
        .is_some_and(chetaev_symbolic::rational::is_negative);
    if g.is_zero(determinant) {
        return Some(g.div(g.integer(-2), line));
    }
    if is_negative {
        let root = g.sqrt(g.neg(determinant));
        let inside = |sign: i64| {
            let own = g.add(&[line, g.mul(&[g.integer(sign), root])]);
            g.apply(Function::Log, &[primitive_part(g, tidy(g, own))])
        };
        let (above, below) = (inside(-1), inside(1));
        return Some(g.div(g.sub(above, below), root));
    }
    let root = root(g, determinant);
    let angle = g.apply(Function::Atan, &[g.div(line, root)]);
    Some(g.div(g.mul(&[g.integer(2), angle]), root))
}

/// A sum without the number that its terms share.
fn primitive_part(g: &Graph, e: Expr) -> Expr {
    match g.node(e) {
        Node::Sum { terms, constant } => {
            let numbers = terms.iter().map(|(_, c)| c).chain([constant]);
            g.div(e, g.number(content(numbers)))
        }
        _ => e,
    }
}

/// `∫ p f = p F - ∫ p' F` for powers p of x, and `∫ p ln u = P ln u - ∫ P u'/u`.
fn by_parts(g: &Graph, own: &[Expr], x: Symbol, depth: Depth<'_>) -> Option<Expr> {
    let depth = depth.deeper()?;
    let is_power = |&&f: &&Expr| {
        let (base, n) = g.base_exponent(f);
        g.as_symbol(base) == Some(x) && g.as_integer(n).is_some_and(|n| n > 0)
    };
    let is_inner =
        |&&f: &&Expr| matches!(g.node(f), Node::Apply { function, .. } if INNER.contains(function));
    let (stays, rest): (Expr, Vec<Expr>) = match own.iter().find(is_inner) {
        Some(&f) => (f, own.iter().copied().filter(|&e| e != f).collect()),
        None => {
            let &f = own.iter().find(is_power)?;
            (f, own.iter().copied().filter(|&e| e != f).collect())
        }
    };
    let integrated = of(g, g.mul(&rest), x, depth)?;
    let left = tidy(g, g.mul(&[g.diff(stays, x), integrated]));
    Some(g.sub(g.mul(&[stays, integrated]), of(g, left, x, depth)?))
}

/// `∫ h(u) u' dx = ∫ h du` for a part u of the expression, or x by u where that can be solved.
fn by_substitution(g: &Graph, e: Expr, x: Symbol, depth: Depth<'_>) -> Option<Expr> {
    let depth = depth.deeper()?;
    let own = g.symbol_expr(x);
    let fresh = g.symbol(&format!("part[{}]", depth.left), 0);
    let new = g.as_symbol(fresh)?;
    let parts = g.reachable(&[e]).into_iter().rev();
    let inner = parts.filter(|&u| u != e && u != own && g.contains_any(u, &[x]));
    let inner: Vec<Expr> = inner.take(PARTS).collect();
    let as_function = |&u: &Expr| {
        let by = g.diff(u, x);
        let rest = g.div(e, by);
        // Simplified it may be written by another function.
        let all = [rest, tidy(g, rest)].into_iter();
        let mut all = all.map(|own| g.substitute(own, &[(u, fresh)]));
        let rest = all.find(|&own| !g.contains_any(own, &[x]))?;
        let found = of(g, rest, new, depth).filter(|_| !g.is_zero(by));
        found.map(|own| g.substitute(own, &[(fresh, u)]))
    };
    let as_inverse = |&u: &Expr| {
        let value = solved(g, u, x, fresh).filter(|_| is_plain(g, u, x))?;
        let rest = g.substitute(e, &[(u, fresh)]);
        let rest = g.substitute(rest, &[(own, value)]);
        let whole = g.mul(&[rest, g.diff(value, new)]);
        let whole = tidy(g, with_powers(g, whole));
        let found = of(g, whole, new, depth)?;
        Some(g.substitute(found, &[(fresh, u)]))
    };
    let found = inner.iter().find_map(as_function);
    // Not deeper: a substitution within another one of this kind leads back.
    let is_outer = depth.left + 2 >= DEPTH;
    let whole = powers_in(g, &inner, x).into_iter().chain(inner);
    found.or_else(|| is_outer.then(|| whole.into_iter().find_map(|u| as_inverse(&u)))?)
}

/// Whether an exponential, a logarithm or a power is the outermost function of x, and no sine or the like is within.
fn is_plain(g: &Graph, u: Expr, x: Symbol) -> bool {
    let is_function = |e: Expr| match g.node(e) {
        Node::Apply { function, .. } => matches!(function, Function::Exp | Function::Log),
        _ => true,
    };
    let within = g.reachable(&[u]).into_iter();
    let mut within = within.filter(|&e| g.contains_any(e, &[x]));
    within.all(is_function) && matches!(g.node(u), Node::Apply { .. } | Node::Power { .. })
}

/// The square and the cube of x, where powers of these occur.
fn powers_in(g: &Graph, parts: &[Expr], x: Symbol) -> Vec<Expr> {
    let own = g.symbol_expr(x);
    let exponents = parts.iter().map(|&e| g.base_exponent(e));
    let exponents = exponents.filter(|&(base, _)| base == own);
    let exponents: Vec<i64> = exponents.filter_map(|(_, n)| g.as_integer(n)).collect();
    let occurs = |&k: &i64| exponents.iter().any(|n| n % k == 0 && n.abs() > k);
    [2, 3]
        .into_iter()
        .filter(occurs)
        .map(|k| g.powi(own, k))
        .collect()
}

/// Exponentials of logarithms as powers.
fn with_powers(g: &Graph, e: Expr) -> Expr {
    let pairs = g.reachable(&[e]).into_iter().filter_map(|part| {
        let Node::Apply {
            function: Function::Exp,
            arguments,
        } = g.node(part)
        else {
            return None;
        };
        Some((part, exponential(g, arguments[0])))
    });
    g.substitute(e, &pairs.collect::<Vec<_>>())
}

#[cfg(test)]
mod tests {
    use super::{primitive, tidy};
    use chetaev_symbolic::{Expr, Function, Graph};

    /// Each integrand by hand; the derivative of what is found is compared with it at a point.
    #[test]
    fn derivatives_of_what_is_found_are_what_was_given() {
        let g = Graph::new();
        let (x, k) = (g.symbol("x", 0), g.symbol("k", 0));
        let symbol = g.intern_symbol("x", 0);
        let f = |function, e: Expr| g.apply(function, &[e]);
        let square = g.powi(x, 2);
        let given = [
            g.powi(x, 9),
            g.powi(x, -1),
            g.mul(&[x, g.exp(g.mul(&[k, x]))]),
            g.mul(&[g.powi(g.sin(x), 3), g.powi(g.cos(x), 2)]),
            g.powi(g.cos(x), 4),
            g.mul(&[g.exp(x), g.sin(g.mul(&[k, x]))]),
            f(Function::Tanh, x),
            g.powi(g.sub(square, g.one()), -1),
            g.powi(g.add(&[square, x, g.one()]), -1),
            g.mul(&[x, g.powi(g.add(&[square, g.one()]), -1)]),
            g.mul(&[x, g.exp(square)]),
            g.mul(&[x, f(Function::Log, x)]),
            g.mul(&[x, g.sqrt(g.add(&[square, k]))]),
            g.mul(&[x, x, f(Function::Sinh, x)]),
            g.powi(g.add(&[square, g.one()]), -2),
            g.mul(&[g.powi(x, 5), g.powi(g.sub(g.powi(x, 3), g.integer(8)), -1)]),
            g.mul(&[x, x, g.powi(g.sub(x, k), -3)]),
            g.powi(g.sub(g.integer(4), square), -1),
            g.pow(g.sub(g.integer(4), square), g.div(g.one(), g.integer(-2))),
            g.mul(&[g.powi(x, 4), g.sqrt(g.add(&[square, x, k]))]),
            g.pow(g.add(&[square, k]), g.div(g.integer(-3), g.integer(2))),
            g.powi(g.cos(x), -3),
            g.powi(g.sin(x), -4),
            g.powi(f(Function::Sinh, x), -3),
            g.powi(f(Function::Cosh, x), -3),
            g.powi(f(Function::Tan, x), 5),
            g.powi(f(Function::Tanh, x), 4),
            g.powi(g.add(&[g.integer(2), g.cos(x)]), -1),
            g.div(g.powi(g.sin(x), 2), g.cos(x)),
        ];
        for e in given {
            let found = primitive(&g, e, symbol);
            let found = found.unwrap_or_else(|| panic!("nothing was found for {}", g.text(e)));
            let rest = tidy(&g, g.sub(g.diff(found, symbol), e));
            let at = |s| if s == symbol { Some(1.7) } else { Some(0.6) };
            let value = g.evaluate_f64(&[rest], &at).map(|v| v[0]);
            assert!(value.is_ok_and(|v| v.abs() < 1e-9), "{}", g.text(e));
        }
    }

    /// exp(x²) has no elementary antiderivative.
    #[test]
    fn nothing_is_said_where_nothing_is_found() {
        let g = Graph::new();
        let x = g.symbol("x", 0);
        let symbol = g.intern_symbol("x", 0);
        assert!(primitive(&g, g.exp(g.powi(x, 2)), symbol).is_none());
    }
}
