//! Antiderivatives of sines and cosines: products as sums, and powers in denominators.

use super::rational::rational;
use super::{slope, termwise, tidy, Depth};
use chetaev_symbolic::{Expr, Function, Graph, Node, Rational, Symbol};

/// The highest power of a function.
const POWER: i64 = 8;

/// Products of sines and cosines of linear functions as sums of such.
pub(super) fn circular(g: &Graph, own: &[Expr], x: Symbol, depth: Depth<'_>) -> Option<Expr> {
    let mut sum: Vec<(Rational, bool, Expr)> = vec![(Rational::ONE, false, g.zero())];
    let mut count = 0;
    for &factor in own {
        let (base, exponent) = g.base_exponent(factor);
        let n = g.as_integer(exponent).filter(|n| (1..=8).contains(n))?;
        let Node::Apply {
            function,
            arguments,
        } = g.node(base)
        else {
            return None;
        };
        let is_sine = match function {
            Function::Sin => true,
            Function::Cos => false,
            _ => return None,
        };
        slope(g, arguments[0], x)?;
        for _ in 0..n {
            count += 1;
            sum = sum
                .into_iter()
                .flat_map(|own| times(g, own, (is_sine, arguments[0])))
                .collect();
        }
    }
    if !(2..=8).contains(&count) {
        return None;
    }
    let terms: Vec<Expr> = sum
        .into_iter()
        .map(|(c, is_sine, u)| {
            let own = if is_sine { g.sin(u) } else { g.cos(u) };
            g.scale(&c, own)
        })
        .collect();
    termwise(g, g.add(&terms), x, depth.deeper()?)
}

/// A sine or cosine times another as two.
fn times(
    g: &Graph,
    (c, is_sine, u): (Rational, bool, Expr),
    (by_sine, w): (bool, Expr),
) -> [(Rational, bool, Expr); 2] {
    let half = c / Rational::from(2);
    let (plus, minus) = (g.add(&[u, w]), g.sub(u, w));
    match (is_sine, by_sine) {
        (false, false) => [(half.clone(), false, plus), (half, false, minus)],
        (true, true) => [(-half.clone(), false, plus), (half, false, minus)],
        (true, false) => [(half.clone(), true, plus), (half, true, minus)],
        (false, true) => [(half.clone(), true, plus), (-half, true, minus)],
    }
}

/// `∫ exp(a x) sin(b x)` and with a cosine.
pub(super) fn exponential_circular(g: &Graph, own: &[Expr], x: Symbol) -> Option<Expr> {
    let [a, b] = own else {
        return None;
    };
    let argument = |e: Expr, wanted: &[Function]| match g.node(e) {
        Node::Apply {
            function,
            arguments,
        } if wanted.contains(function) => Some((*function, arguments[0])),
        _ => None,
    };
    let circles = [Function::Sin, Function::Cos];
    let pair =
        |e: Expr, other: Expr| Some((argument(e, &[Function::Exp])?, argument(other, &circles)?));
    let ((_, u), (function, w)) = pair(*a, *b).or_else(|| pair(*b, *a))?;
    let (p, q) = (slope(g, u, x)?, slope(g, w, x)?);
    let (sin, cos) = (g.sin(w), g.cos(w));
    let inner = match function {
        Function::Sin => g.sub(g.mul(&[p, sin]), g.mul(&[q, cos])),
        _ => g.add(&[g.mul(&[p, cos]), g.mul(&[q, sin])]),
    };
    let by = g.add(&[g.powi(p, 2), g.powi(q, 2)]);
    Some(g.div(g.mul(&[g.exp(u), inner]), by))
}

/// Of whole powers of sines, cosines, tangents and their hyperbolic counterparts, each from that two lower or higher.
pub(super) fn of_power(g: &Graph, function: Function, u: Expr, power: i64) -> Option<Expr> {
    use Function::{Cos, Cosh, Cot, Sin, Sinh, Tan, Tanh};
    let f = |function: Function| g.apply(function, &[u]);
    let log = |e: Expr| g.apply(Function::Log, &[e]);
    let over = |a: Expr, b: Expr| g.div(a, b);
    if power.abs() > POWER {
        return None;
    }
    Some(match (function, power) {
        (Cos, -1) => log(g.add(&[over(g.one(), f(Cos)), f(Tan)])),
        (Sin, -1) => log(over(g.sub(g.one(), f(Cos)), f(Sin))),
        (Cosh, -1) => g.apply(Function::Atan, &[f(Sinh)]),
        (Sinh, -1) => log(over(g.sub(f(Cosh), g.one()), f(Sinh))),
        (Cos, -2) => f(Tan),
        (Sin, -2) => g.neg(f(Cot)),
        (Cosh, -2) => f(Tanh),
        (Sinh, -2) => g.neg(over(f(Cosh), f(Sinh))),
        (Cos | Sin | Cosh | Sinh, ..=-3) => {
            // (other f^(1-n))' for the n-th power below the line.
            let n = -power;
            let other = match function {
                Cos => f(Sin),
                Sin => g.neg(f(Cos)),
                Cosh => f(Sinh),
                _ => g.neg(f(Cosh)),
            };
            let own = g.mul(&[other, g.powi(f(function), 1 - n)]);
            let lower = of_power(g, function, u, power + 2)?;
            let sign = if function == Sinh { -1 } else { 1 };
            let rest = g.mul(&[g.integer(sign * (n - 2)), lower]);
            over(g.add(&[own, rest]), g.integer(n - 1))
        }
        (Tan | Tanh, 2..) => {
            let own = over(g.powi(f(function), power - 1), g.integer(power - 1));
            let lower = match power {
                2 => u,
                3 if function == Tan => g.neg(log(f(Cos))),
                3 => log(f(Cosh)),
                _ => of_power(g, function, u, power - 2)?,
            };
            match function {
                Tan => g.sub(own, lower),
                _ => g.sub(lower, own),
            }
        }
        _ => return None,
    })
}

/// Of a rational function of the sine and cosine of one linear function, by the tangent of its half.
pub(super) fn by_half_angle(g: &Graph, e: Expr, x: Symbol) -> Option<Expr> {
    let mut angle = None;
    let mut inside = Vec::new();
    for part in g.reachable(&[e]) {
        if let Node::Apply {
            function,
            arguments,
        } = g.node(part)
        {
            if !g.contains_any(part, &[x]) {
                continue;
            }
            let is_plain = matches!(function, Function::Sin | Function::Cos);
            if !is_plain || *angle.get_or_insert(arguments[0]) != arguments[0] {
                return None;
            }
            inside.push((part, *function));
        }
    }
    let u = angle?;
    let by = slope(g, u, x)?;
    let half = g.symbol("part[half]", 0);
    let square = g.add(&[g.one(), g.powi(half, 2)]);
    let pairs: Vec<(Expr, Expr)> = inside
        .into_iter()
        .map(|(part, function)| match function {
            Function::Sin => (part, g.div(g.mul(&[g.integer(2), half]), square)),
            _ => (part, g.div(g.sub(g.integer(2), square), square)),
        })
        .collect();
    let inner = g.substitute(e, &pairs);
    if g.contains_any(inner, &[x]) {
        return None;
    }
    let scaled = g.div(g.mul(&[g.integer(2), inner]), g.mul(&[square, by]));
    let found = rational(g, tidy(g, scaled), g.as_symbol(half)?)?;
    let tangent = g.apply(Function::Tan, &[g.div(u, g.integer(2))]);
    Some(g.substitute(found, &[(half, tangent)]))
}
