//! Integrals as a person writes them.

use super::motion::Motion;
use super::search::Integral;
use super::written::in_quasi_velocities;
use chetaev_mechanics::{Context, System};
use chetaev_symbolic::factors::factored;
use chetaev_symbolic::rational::content;
use chetaev_symbolic::simplify::{length, simplify, Options};
use chetaev_symbolic::{Expr, Graph, Node, Symbol, Verdict};

/// Larger expressions, in nodes, are shown as they are.
const READABLE: usize = 90;

/// Whether nothing but parameters occurs; what is shown may contain names of quasi-velocities.
pub(crate) fn is_constant(system: &System, e: Expr) -> bool {
    let g = &system.graph;
    let is_parameter = |s: Symbol| system.parameters.iter().any(|p| p.name == g.symbol_name(s));
    g.symbols_in(&[e]).into_iter().all(is_parameter)
}

/// An integral in the letters of its family, in velocities, or in the quasi-velocities that the model states, whichever is shortest:
/// letters may be related.
pub(super) fn shortest(cx: &Context<'_>, integral: &Integral) -> Expr {
    let g = &cx.system.graph;
    let [shown, value] = [integral.shown, integral.value].map(|e| readable(g, e));
    let mut all = vec![shown, value];
    if !cx.system.quasi_velocities.is_empty() {
        all.extend(in_quasi_velocities(cx, &[value]));
    }
    let shortest = all.into_iter().min_by_key(|&e| length(g, e));
    shortest.unwrap_or(shown)
}

/// The integral as it is on the constraints, in the velocities that these leave, where that is shorter, and proved: `x' y' (1 + x² + y²)` for `x' (y² y' - x y x' + y' + x z')` under z' = y x' + x y'.
pub(super) fn on_constraints(
    cx: &Context<'_>,
    motion: &Motion<'_>,
    integral: Integral,
) -> Integral {
    let g = &cx.system.graph;
    let solved = motion.manifold.solved.iter();
    let solved: Vec<(Expr, Expr)> = solved.map(|&(s, e)| (g.symbol_expr(s), e)).collect();
    if solved.is_empty() {
        return integral;
    }
    let own = readable(g, g.substitute(integral.value, &solved));
    let known = divisors(cx, &[integral.shown, integral.value]);
    let has_poles = divisors(cx, &[own]).iter().any(|e| !known.contains(e));
    if has_poles || length(g, own) >= length(g, integral.shown) {
        return integral;
    }
    match motion.is_integral(cx, own) {
        verdict @ Verdict::Proved(_) => Integral {
            value: own,
            shown: own,
            verdict,
            ..integral
        },
        _ => integral,
    }
}

/// What is divided by and moves.
fn divisors(cx: &Context<'_>, es: &[Expr]) -> Vec<Expr> {
    let g = &cx.system.graph;
    let parts = g.reachable(es).into_iter();
    let bases = parts.filter_map(|e| {
        let (base, exponent) = g.base_exponent(e);
        let is_whole = g.as_integer(exponent).is_some_and(|n| n > 0);
        (!is_whole && !is_constant(cx.system, base)).then_some(base)
    });
    bases.collect()
}

/// The integral divided by what all its terms share and nothing moves, as (1 + a²)^(3/2).
pub(super) fn without_constant_factor(cx: &Context<'_>, integral: Integral) -> Integral {
    let g = &cx.system.graph;
    let by = match g.node(integral.shown) {
        Node::Product {
            coefficient,
            factors,
        } => {
            let constant = factors.iter().copied();
            let constant: Vec<Expr> = constant.filter(|&f| is_constant(cx.system, f)).collect();
            g.mul(&[&[g.number(coefficient.clone())], &constant[..]].concat())
        }
        Node::Sum { terms, constant } => {
            let numbers = terms.iter().map(|(_, c)| c).chain([constant]);
            let number = g.number(content(numbers));
            let all: Vec<Expr> = terms.iter().map(|(term, _)| *term).collect();
            match g.is_zero(g.number(constant.clone())) {
                true => g.mul(&[number, common_parameters(cx.system, &all)]),
                false => number,
            }
        }
        _ => g.one(),
    };
    if g.is_one(by) {
        return without_first_minus(g, integral);
    }
    let divided = Integral {
        value: quotient(g, integral.value, by),
        shown: quotient(g, integral.shown, by),
        name: None,
        ..integral
    };
    without_first_minus(g, divided)
}

/// A sum divided term by term.
fn quotient(g: &Graph, e: Expr, by: Expr) -> Expr {
    let Node::Sum { terms, constant } = g.node(e) else {
        return g.div(e, by);
    };
    let own = terms.iter().map(|(term, c)| g.scale(c, g.div(*term, by)));
    let last = g.div(g.number(constant.clone()), by);
    g.add(&own.chain([last]).collect::<Vec<Expr>>())
}

/// The product of powers of parameters that is a factor of all terms: w of `w x' sin(w t) - w² x cos(w t)`.
fn common_parameters(system: &System, terms: &[Expr]) -> Expr {
    let g = &system.graph;
    let powers = |term: Expr| -> Vec<(Expr, i64)> {
        let factors = match g.node(term) {
            Node::Product { factors, .. } => factors.to_vec(),
            _ => vec![term],
        };
        let powers = factors.into_iter().map(|f| g.base_exponent(f));
        let whole = powers.filter_map(|(base, e)| Some((base, g.as_integer(e)?)));
        whole
            .filter(|(base, e)| *e > 0 && is_constant(system, *base))
            .collect()
    };
    let all: Vec<Vec<(Expr, i64)>> = terms.iter().map(|&term| powers(term)).collect();
    let Some((first, others)) = all.split_first() else {
        return g.one();
    };
    let least = |&(base, e): &(Expr, i64)| {
        let of = |own: &Vec<(Expr, i64)>| {
            let found = own.iter().find(|(other, _)| *other == base);
            found.map_or(0, |&(_, e)| e)
        };
        g.powi(base, others.iter().map(of).fold(e, i64::min))
    };
    g.mul(&first.iter().map(least).collect::<Vec<Expr>>())
}

/// The integral with a constant added for which its part without velocities is a power: `(1 + s x)^7/s` for
/// `x (7 + 21 s x + … + s⁶ x⁶)`, whose slope is `7 (1 + s x)^6`. Where that is shorter, and proved.
pub(super) fn with_power(cx: &Context<'_>, motion: &Motion<'_>, integral: Integral) -> Integral {
    let g = &cx.system.graph;
    let Some((rest, power)) = power_of_place(motion, integral.shown) else {
        return integral;
    };
    let more = g.sub(power, rest);
    let [value, shown] = [integral.value, integral.shown].map(|e| g.add(&[e, more]));
    if length(g, shown) >= length(g, integral.shown) {
        return integral;
    }
    match motion.is_integral(cx, value) {
        verdict @ Verdict::Proved(_) => Integral {
            value,
            shown,
            verdict,
            ..integral
        },
        _ => integral,
    }
}

/// The part of a sum that contains one coordinate and neither velocities nor the time, with the power of a linear function of that
/// coordinate that has the same slope.
fn power_of_place(motion: &Motion<'_>, e: Expr) -> Option<(Expr, Expr)> {
    let (system, g) = (motion.system, &motion.system.graph);
    let Node::Sum { terms, .. } = g.node(e) else {
        return None;
    };
    let places = system.coordinate_symbols();
    let is_of_place = |e: Expr| {
        let own = g.symbols_in(&[e]);
        let is_plain = |s: &Symbol| places.contains(s) || !motion.moves(*s);
        own.iter().all(is_plain) && own.iter().any(|s| places.contains(s))
    };
    let own = terms.iter().filter(|(term, _)| is_of_place(*term));
    let rest = g.add(
        &own.map(|(term, c)| g.scale(c, *term))
            .collect::<Vec<Expr>>(),
    );
    let symbols = g.symbols_in(&[rest]);
    let mut moving = symbols.into_iter().filter(|s| places.contains(s));
    let (Some(q), None) = (moving.next(), moving.next()) else {
        return None;
    };
    let slope = g.diff(rest, q);
    let all = factored(g, slope)?.factors;
    let mut with = all.iter().filter(|(f, _)| g.contains_any(*f, &[q]));
    let (Some(&(base, times)), None) = (with.next(), with.next()) else {
        return None;
    };
    let by = g.diff(base, q);
    if times < 2 || g.is_zero(by) || g.contains_any(by, &[q]) {
        return None;
    }
    let constant = g.div(slope, g.powi(base, times));
    let constant = simplify(g, constant, &Options::default());
    let over = g.mul(&[g.integer(times + 1), by]);
    let power = g.mul(&[constant, g.powi(base, times + 1), g.powi(over, -1)]);
    Some((rest, power))
}

/// The integral or its negative, whichever is not written with a minus in front.
fn without_first_minus(g: &Graph, integral: Integral) -> Integral {
    let negative = g.neg(integral.shown);
    let begins = |e: Expr| g.text(e).starts_with('-');
    match begins(integral.shown) && !begins(negative) {
        true => Integral {
            value: g.neg(integral.value),
            shown: negative,
            name: None,
            ..integral
        },
        false => integral,
    }
}

/// An expression as a person would write it, where that does not take long.
pub(crate) fn readable(g: &Graph, e: Expr) -> Expr {
    match g.reachable(&[e]).len() <= READABLE {
        true => simplify(g, e, &Options::default()),
        false => e,
    }
}
