//! Kept functions as a person writes them: any function of a kept one is kept, so the plainest is taken.

use super::primitive::{expanded, tidy};
use chetaev_mechanics::prover::assumptions;
use chetaev_mechanics::System;
use chetaev_symbolic::rational::{content, is_negative};
use chetaev_symbolic::zero::known_sign;
use chetaev_symbolic::{Expr, Function, Graph, Node, Rational, Symbol};

/// The most functions that are taken away from around a kept one.
const AROUND: usize = 8;

/// A kept function as a person writes it: without logarithms where its exponential has none, without fractions, constant terms and constant
/// factors, not within a function of one argument, and not with a minus in front.
pub(super) fn presented(system: &System, e: Expr) -> Expr {
    let g = &system.graph;
    let e = bare(system, tidy(g, plain(system, e)));
    let e = match without_logarithms(system, e) {
        Some(whole) => bare(system, tidy(g, whole)),
        None => e,
    };
    let scaled = match g.node(e) {
        Node::Sum { terms, .. } => {
            let unit = content(terms.iter().map(|(_, c)| c));
            let own = terms
                .iter()
                .map(|(term, c)| g.scale(&(c.clone() / unit.clone()), *term));
            bare(system, tidy(g, g.add(&own.collect::<Vec<Expr>>())))
        }
        _ => e,
    };
    match g.text(scaled).starts_with('-') {
        true => g.neg(scaled),
        false => scaled,
    }
}

/// Without roots of squares and absolute values of what has a known sign, and without arctangents of tangents.
fn plain(system: &System, e: Expr) -> Expr {
    let (g, stated) = (&system.graph, assumptions(system));
    let signed = |inner: Expr| {
        let sign = known_sign(g, inner, &stated);
        match (sign.is_nonnegative(), sign.is_nonpositive()) {
            (true, _) => Some(inner),
            (_, true) => Some(g.neg(inner)),
            _ => None,
        }
    };
    let pair = |e: Expr| match g.node(e) {
        Node::Power { base, exponent } => {
            let (inner, even) = g.base_exponent(*base);
            let is_even = g.as_integer(even).is_some_and(|n| n % 2 == 0);
            let own = is_even.then(|| signed(inner))??;
            Some((e, g.pow(own, g.mul(&[even, *exponent]))))
        }
        Node::Apply {
            function,
            arguments,
        } => match (function, g.node(arguments[0])) {
            (Function::Abs, _) => Some((e, signed(arguments[0])?)),
            (
                Function::Atan,
                Node::Apply {
                    function: Function::Tan,
                    arguments,
                },
            ) => Some((e, arguments[0])),
            _ => None,
        },
        _ => None,
    };
    let pairs: Vec<(Expr, Expr)> = g.reachable(&[e]).into_iter().filter_map(pair).collect();
    g.substitute(e, &pairs)
}

/// What a function is a function of: without powers, functions of one argument, constant factors and constant terms around it.
pub(super) fn bare(system: &System, e: Expr) -> Expr {
    let mut e = e;
    for _ in 0..AROUND {
        match within(system, e) {
            Some(inner) => e = inner,
            None => break,
        }
    }
    e
}

fn within(system: &System, e: Expr) -> Option<Expr> {
    let g = &system.graph;
    match g.node(e) {
        Node::Apply {
            function,
            arguments,
        } => match arguments.as_ref() {
            [inner] if !matches!(function, Function::Abs | Function::Sign) => Some(*inner),
            _ => None,
        },
        Node::Power { base, exponent } => is_fixed(system, *exponent).then_some(*base),
        Node::Sum { terms, constant } => {
            let moving = terms.iter().filter(|(term, _)| !is_fixed(system, *term));
            let moving: Vec<Expr> = moving.map(|(term, c)| g.scale(c, *term)).collect();
            let has_less = moving.len() < terms.len() || *constant != Rational::from(0);
            (has_less && !moving.is_empty()).then(|| g.add(&moving))
        }
        Node::Product {
            factors,
            coefficient,
        } => {
            let moving = factors.iter().filter(|&&f| !is_fixed(system, f));
            let moving: Vec<Expr> = moving.copied().collect();
            let has_less = moving.len() < factors.len() || *coefficient != Rational::ONE;
            match has_less && !moving.is_empty() {
                true => Some(g.mul(&moving)),
                false => root(g, &moving),
            }
        }
        _ => None,
    }
}

/// The product of which one of powers is a power.
fn root(g: &Graph, factors: &[Expr]) -> Option<Expr> {
    let pairs = factors.iter().map(|&f| g.base_exponent(f));
    let numbers = pairs.map(|(base, n)| Some((base, g.as_number(n)?.clone())));
    let numbers: Vec<(Expr, Rational)> = numbers.collect::<Option<_>>()?;
    let has_exponential = numbers.iter().any(|(base, _)| is_exponential(g, *base));
    let mut unit = content(numbers.iter().map(|(_, n)| n));
    if numbers.iter().all(|(_, n)| is_negative(n)) {
        unit = -unit;
    }
    let by = |(base, n): &(Expr, Rational)| g.pow(*base, g.number(n.clone() / unit.clone()));
    (unit != Rational::ONE && !has_exponential)
        .then(|| g.mul(&numbers.iter().map(by).collect::<Vec<Expr>>()))
}

fn is_exponential(g: &Graph, e: Expr) -> bool {
    matches!(
        g.node(e),
        Node::Apply {
            function: Function::Exp,
            ..
        }
    )
}

/// The exponential of a sum in which logarithms have constant coefficients with rational ratios.
fn without_logarithms(system: &System, e: Expr) -> Option<Expr> {
    let g = &system.graph;
    let all = parts(g, expanded(g, e));
    let logs = all.iter().filter_map(|&part| logarithm(g, part));
    let logs: Vec<Expr> = logs.map(|(_, c)| c).collect();
    let first = *logs.first()?;
    if !logs.iter().all(|&c| is_fixed(system, c)) {
        return None;
    }
    let ratios = logs.iter().map(|&c| g.as_number(g.div(c, first)).cloned());
    let ratios: Vec<Rational> = ratios.collect::<Option<_>>()?;
    let unit = g.mul(&[g.number(content(ratios.iter())), first]);
    let scaled = all.iter().map(|&part| g.div(part, unit));
    Some(exponential(g, g.add(&scaled.collect::<Vec<Expr>>())))
}

/// Whether neither places nor the time occur.
pub(super) fn is_fixed(system: &System, e: Expr) -> bool {
    let g = &system.graph;
    g.is_free_of(e, &|s: Symbol| {
        g.symbol_name(s) == "t" || system.moves(g.symbol_name(s))
    })
}

/// The parts of a sum.
pub(super) fn parts(g: &Graph, e: Expr) -> Vec<Expr> {
    match g.node(e) {
        Node::Sum { constant, terms } => {
            let own = terms.iter().map(|(term, c)| g.scale(c, *term));
            own.chain([g.number(constant.clone())]).collect()
        }
        _ => vec![e],
    }
}

/// The argument of a logarithm and what it is multiplied by.
fn logarithm(g: &Graph, e: Expr) -> Option<(Expr, Expr)> {
    let is_log = |f: Expr| match g.node(f) {
        Node::Apply {
            function: Function::Log,
            arguments,
        } => Some(arguments[0]),
        _ => None,
    };
    let factors = match g.node(e) {
        Node::Product { factors, .. } => factors.to_vec(),
        _ => vec![e],
    };
    let mut own = factors.iter().filter_map(|&f| Some((f, is_log(f)?)));
    let (log, argument) = own.next()?;
    Some((argument, g.div(e, log)))
}

/// `exp e`, logarithms in e as powers.
pub(super) fn exponential(g: &Graph, e: Expr) -> Expr {
    let (mut factors, mut rest) = (Vec::new(), Vec::new());
    for part in parts(g, expanded(g, e)) {
        match logarithm(g, part) {
            Some((argument, c)) => factors.push(g.pow(argument, c)),
            None => rest.push(part),
        }
    }
    factors.push(g.exp(g.add(&rest)));
    g.mul(&factors)
}
