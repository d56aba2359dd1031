//! Equations solved for a symbol that stands in one place, and numbers that tell whether something depends on a symbol.
//!
//! Nothing rests on them: whoever uses one proves what follows from it.

use chetaev_mechanics::sample::Generator;
use chetaev_symbolic::factors::{coefficients, factored};
use chetaev_symbolic::{Expr, Function, Graph, Node, Symbol};
use std::collections::BTreeMap;

/// So many functions stand around the symbol at most.
const DEPTH: usize = 12;

/// Points at which expressions are compared.
const POINTS: u64 = 3;

/// The symbol for which an expression takes a value, where it occurs in one place within functions that have an inverse.
pub(super) fn solved(g: &Graph, e: Expr, x: Symbol, value: Expr) -> Option<Expr> {
    let (mut e, mut value) = (e, value);
    for _ in 0..DEPTH {
        if g.as_symbol(e) == Some(x) {
            return Some(value);
        }
        (e, value) = match peeled(g, e, x, value) {
            Some(next) => next,
            None => return of_first_degree(g, g.sub(e, value), x),
        };
    }
    None
}

/// The zero of an expression whose numerator is of the first degree.
fn of_first_degree(g: &Graph, e: Expr, x: Symbol) -> Option<Expr> {
    match coefficients(g, e, x)?.as_slice() {
        [c, b] if !g.contains_any(*b, &[x]) => Some(g.neg(g.div(*c, *b))),
        _ => None,
    }
}

/// What stands in an expression around the part with the symbol brought to the other side.
fn peeled(g: &Graph, e: Expr, x: Symbol, value: Expr) -> Option<(Expr, Expr)> {
    let only = |mut with: Vec<Expr>| match with.len() {
        1 => with.pop(),
        _ => None,
    };
    match g.node(e) {
        Node::Sum { terms, .. } => {
            let with = terms.iter().filter(|(term, _)| g.contains_any(*term, &[x]));
            let own = only(with.map(|(term, c)| g.scale(c, *term)).collect())?;
            Some((own, g.sub(value, g.sub(e, own))))
        }
        Node::Product { factors, .. } => {
            let with = factors.iter().filter(|&&f| g.contains_any(f, &[x]));
            let own = only(with.copied().collect())?;
            Some((own, g.div(value, g.div(e, own))))
        }
        Node::Power { base, exponent } if !g.contains_any(*exponent, &[x]) => {
            Some((*base, g.pow(value, g.div(g.one(), *exponent))))
        }
        Node::Apply {
            function,
            arguments,
        } => {
            let inverse = inverse(*function)?;
            Some((*arguments.first()?, g.apply(inverse, &[value])))
        }
        _ => None,
    }
}

fn inverse(function: Function) -> Option<Function> {
    use Function::{Acos, Asin, Asinh, Atan, Atanh, Cos, Exp, Log, Sin, Sinh, Tan, Tanh};
    Some(match function {
        Exp => Log,
        Log => Exp,
        Sin => Asin,
        Asin => Sin,
        Cos => Acos,
        Acos => Cos,
        Tan => Atan,
        Atan => Tan,
        Sinh => Asinh,
        Asinh => Sinh,
        Tanh => Atanh,
        Atanh => Tanh,
        _ => return None,
    })
}

/// Whether an expression has the same value at points that differ in these symbols alone, by numbers; not where it has none there.
pub(super) fn is_independent(g: &Graph, e: Expr, symbols: &[Symbol]) -> bool {
    let all = g.symbols_in(&[e]);
    let value = |point: &BTreeMap<Symbol, f64>| {
        let at = g.evaluate_f64(&[e], &|s| point.get(&s).copied());
        at.ok().map(|v| v[0]).filter(|v| v.is_finite())
    };
    let mut compared = 0;
    for seed in 0..4 * POINTS {
        let mut generator = Generator::new(seed);
        let mut draw = || generator.between(0.2, 1.2);
        let mut point: BTreeMap<Symbol, f64> = all.iter().map(|&s| (s, draw())).collect();
        let first = value(&point);
        for symbol in symbols {
            point.insert(*symbol, draw());
        }
        let (Some(first), Some(second)) = (first, value(&point)) else {
            continue;
        };
        if (first - second).abs() > 1e-7 * (1.0 + first.abs()) {
            return false;
        }
        compared += 1;
        if compared == POINTS {
            break;
        }
    }
    compared > 0
}

/// Whether an expression has a value that is not zero somewhere.
pub(super) fn has_value(g: &Graph, e: Expr) -> bool {
    (0..4 * POINTS).any(|seed| {
        let mut generator = Generator::new(seed);
        let symbols = g.symbols_in(&[e]).into_iter();
        let point: BTreeMap<Symbol, f64> =
            symbols.map(|s| (s, generator.between(0.2, 1.2))).collect();
        let at = g.evaluate_f64(&[e], &|s| point.get(&s).copied());
        at.is_ok_and(|v| v[0].is_finite() && v[0].abs() > 1e-9)
    })
}

/// A root, of squares without a sign: for what is even in it.
pub(super) fn root(g: &Graph, e: Expr) -> Expr {
    let Some(parts) = factored(g, e) else {
        return g.sqrt(e);
    };
    let odd = parts.factors.iter().filter(|(_, n)| n % 2 != 0);
    let odd = odd
        .map(|(f, _)| *f)
        .chain([g.number(parts.coefficient.clone())]);
    let halves = parts
        .factors
        .iter()
        .map(|&(f, n)| g.powi(f, n.div_euclid(2)));
    let inside = g.sqrt(g.mul(&odd.collect::<Vec<Expr>>()));
    g.mul(&halves.chain([inside]).collect::<Vec<Expr>>())
}
