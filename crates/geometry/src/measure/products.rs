//! Densities that are products of powers, `N = Π F_i^{e_i} exp(Σ c_j h_j)`: for given F_i and h_j their exponents enter
//! `Z ln N = Σ e_i Z F_i / F_i + Σ c_j Z h_j = -div X̄` linearly, so they are solved for, not guessed.
//!
//! The bases F are factors of det W̄, of the denominators of the divergence, and of the functions that occur. A polynomial in sines
//! and cosines has several factorizations, as `s² = (1 - c)(1 + c)`: it is factored as it is, in cosines, and in sines.

use super::flow::Flow;
use super::{angles, formula};
use crate::noether::ansatz::Ansatz;
use crate::noether::family::coefficients;
use crate::noether::shown::readable;
use chetaev_integrals::factors::factors as darboux;
use chetaev_mechanics::Context;
use chetaev_symbolic::factors::{factored, factors};
use chetaev_symbolic::simplify::length;
use chetaev_symbolic::{Expr, Function, Graph, Node, Symbol, Verdict};

/// The most bases, and the most functions in the exponential.
const BASES: usize = 40;
const EXPONENTS: usize = 60;

/// Larger expressions, in nodes, are not factored.
const FACTORED: usize = 4_000;

/// A density of this form that is kept, with the proof; of functions that return to their values after a turn of these `angles`.
pub(super) fn density(
    cx: &Context<'_>,
    flow: &Flow<'_>,
    angles: &[usize],
) -> Option<(Expr, Verdict)> {
    of_bases(cx, flow, angles, bases(cx, flow))
}

/// A density that contains velocities: a product of powers of Darboux polynomials too, `X̄ F = K F`. It may be zero or infinite where
/// one of these vanishes.
pub(super) fn density_with_velocities(
    cx: &Context<'_>,
    flow: &Flow<'_>,
) -> Option<(Expr, Verdict)> {
    let darboux = darboux(cx, &flow.motion);
    let own = flow.chart.restrict(cx.system, &darboux.bases);
    let own = own.into_iter().filter(|&e| flow.is_wanted(e));
    let mut all = bases(cx, flow);
    let plain = all.len();
    all.extend(own.map(|e| formula::positive(cx, e)));
    (all.len() > plain).then(|| of_bases(cx, flow, &[], all))?
}

/// A density that is a product of powers of these functions.
fn of_bases(
    cx: &Context<'_>,
    flow: &Flow<'_>,
    angles: &[usize],
    mut bases: Vec<Expr>,
) -> Option<(Expr, Verdict)> {
    let (system, g) = (cx.system, &cx.system.graph);
    let mut exponents = exponents(cx, flow);
    let returns = |e: &Expr| angles.iter().all(|&j| angles::returns(cx, *e, j));
    bases.retain(returns);
    exponents.retain(returns);
    let all = [&bases[..], &exponents[..]].concat();
    let rates = flow.rates_of(system, &all);
    let mut columns: Vec<Vec<Expr>> = Vec::new();
    for (i, &rate) in rates.iter().enumerate() {
        columns.push(vec![match bases.get(i) {
            Some(&base) => g.div(rate, base),
            None => rate,
        }]);
    }
    columns.push(vec![flow.divergence]);
    let (manifold, own) = (&flow.chart.manifold, flow.symbols());
    let seed = cx.prover.points_seed();
    let ansatz = Ansatz::new(&flow.motion, &columns, manifold, &own, seed).ok()?;
    // With the common denominator that was cleared.
    let found = ansatz.with_last()?;
    let (&last, found) = found.split_last()?;
    let power = |c: Expr| readable(g, g.div(c, last));
    let (powers, rest) = found.split_at(bases.len());
    let mut parts: Vec<Expr> = bases
        .iter()
        .zip(powers)
        .map(|(&base, &e)| g.pow(base, power(e)))
        .collect();
    let rest = exponents.iter().zip(rest).filter(|(_, &c)| !g.is_zero(c));
    let rest: Vec<Expr> = rest.map(|(&h, &c)| g.mul(&[power(c), h])).collect();
    parts.push(g.exp(g.add(&rest)));
    let density = formula::plain(cx, flow, g.mul(&parts));
    let mut verdict = by_logarithm(cx, flow, density);
    let real = formula::on_both_sides(cx, density);
    match &mut verdict {
        Verdict::Proved(proof) if real != density => proof.detail.push_str(
            "; the absolute value of a base has the same logarithmic derivative on either side of its zeros",
        ),
        Verdict::Proved(_) => {}
        _ => return None,
    }
    Some((real, verdict))
}

/// Whether a product of powers is kept, by the rate of its logarithm.
fn by_logarithm(cx: &Context<'_>, flow: &Flow<'_>, density: Expr) -> Verdict {
    let g = &cx.system.graph;
    let defect = g.add(&[logarithmic_rate(flow, density), flow.divergence]);
    let on = match is_polynomial(g, density) {
        true => "on the constraint manifold",
        false => {
            "on the constraint manifold, where no base of a negative or broken power in the density vanishes"
        }
    };
    cx.prover
        .identity(cx.system, &[defect], &flow.chart.manifold, on)
}

/// The proof by its logarithm that a product with roots is kept: nothing is said there of what is under these.
pub(super) fn proved(cx: &Context<'_>, flow: &Flow<'_>, density: Expr) -> Option<Verdict> {
    let g = &cx.system.graph;
    let is_root = |&e: &Expr| {
        let (base, exponent) = g.base_exponent(e);
        g.as_integer(exponent).is_none() && !g.is_free_of(base, &|s| flow.motion.moves(s))
    };
    if !formula::factors_by_form(g, density).iter().any(is_root) {
        return None;
    }
    let verdict = by_logarithm(cx, flow, density);
    matches!(verdict, Verdict::Proved(_)).then_some(verdict)
}

/// Whether no power in the density is negative or broken.
fn is_polynomial(g: &Graph, density: Expr) -> bool {
    g.reachable(&[density]).iter().all(|&e| match g.node(e) {
        Node::Power { exponent, .. } => g.as_integer(*exponent).is_some_and(|n| n >= 0),
        _ => true,
    })
}

/// `Z ln N`, factor by factor: a rational function also where N has broken powers.
fn logarithmic_rate(flow: &Flow<'_>, density: Expr) -> Expr {
    let system = flow.motion.system;
    let g = &system.graph;
    let own = match g.node(density) {
        Node::Product { factors, .. } => factors.to_vec(),
        _ => vec![density],
    };
    let rates = own.into_iter().map(|factor| {
        let (base, exponent) = g.base_exponent(factor);
        if let Node::Apply {
            function: Function::Exp,
            arguments,
        } = g.node(base)
        {
            let rate = flow.rates_of(system, &arguments[..1])[0];
            return g.mul(&[exponent, rate]);
        }
        // What is inside a root counts as a product again.
        let inner = match g.node(base) {
            Node::Product { .. } => logarithmic_rate(flow, base),
            _ => g.div(flow.rates_of(system, &[base])[0], base),
        };
        g.mul(&[exponent, inner])
    });
    g.add(&rates.collect::<Vec<Expr>>())
}

/// What densities are products of powers of: functions of the coordinates, and of the time where the motion contains it.
fn bases(cx: &Context<'_>, flow: &Flow<'_>) -> Vec<Expr> {
    let g = &cx.system.graph;
    let own = flow.symbols();
    let moving: Vec<Symbol> = cx
        .system
        .coordinate_symbols()
        .into_iter()
        .chain(g.as_symbol(g.symbol("t", 0)))
        .chain(flow.masses.iter().map(|(mass, _)| *mass))
        .collect();
    let mut found: Vec<Expr> = Vec::new();
    let mut add = |e: Expr| {
        let is_one = g.contains_any(e, &moving) && !g.contains_any(e, &own) && flow.is_wanted(e);
        if is_one && !found.contains(&e) {
            found.push(e);
        }
    };
    for letter in flow.letters(cx, flow.autonomous) {
        add(formula::positive(
            cx,
            g.base_exponent(letter.letter.value).0,
        ));
    }
    let mut products: Vec<Expr> = flow.determinant(cx).into_iter().collect();
    // What drives states to its zeros.
    let drift = flow.chart.velocities.iter();
    products.extend(
        drift
            .map(|&e| flow.at(cx.system, e, None))
            .filter(|&e| !g.is_zero(e)),
    );
    let below = factored(g, flow.divergence).map(|f| f.factors);
    let below = below.unwrap_or_default().into_iter();
    products.extend(below.filter(|(_, n)| *n < 0).map(|(f, _)| f));
    for product in products {
        if g.reachable(&[product]).len() <= FACTORED {
            for (factor, _) in all_factors(g, product, &moving) {
                add(formula::positive(cx, factor));
            }
        }
    }
    found.truncate(BASES);
    found
}

/// The powers that an expression is a product of once it is over a common denominator; itself where that is not found.
pub(super) fn quotient(g: &Graph, e: Expr) -> Vec<Expr> {
    let is_simple = matches!(g.node(e), Node::Symbol(_) | Node::Apply { .. });
    if is_simple || g.reachable(&[e]).len() > FACTORED {
        return vec![e];
    }
    match factored(g, e) {
        Some(found) if !found.factors.is_empty() => {
            let powers = found.factors.into_iter();
            powers.map(|(base, n)| g.powi(base, n)).collect()
        }
        _ => vec![e],
    }
}

/// Sums, and those of which powers are taken in a product, as the products of their factors over a common denominator, where that is
/// shorter.
pub(super) fn shorter(g: &Graph, e: Expr) -> Expr {
    match g.node(e) {
        Node::Sum { .. } if g.reachable(&[e]).len() <= FACTORED => {
            let product = readable(g, g.mul(&quotient(g, e)));
            match length(g, product) < length(g, e) {
                true => product,
                false => e,
            }
        }
        Node::Product {
            coefficient,
            factors,
        } => {
            let own = factors.iter().map(|&factor| shorter(g, factor));
            let number = g.number(coefficient.clone());
            g.mul(&own.chain([number]).collect::<Vec<Expr>>())
        }
        Node::Power { base, exponent } => g.pow(shorter(g, *base), *exponent),
        _ => e,
    }
}

/// Factors of a function as it is, as a polynomial in cosines, and as one in sines.
fn all_factors(g: &Graph, e: Expr, moving: &[Symbol]) -> Vec<(Expr, u32)> {
    let mut found = factors(g, e, moving).unwrap_or_default();
    for function in [Function::Cos, Function::Sin] {
        let pairs = replaced(g, e, function);
        if pairs.is_empty() {
            continue;
        }
        let letters: Vec<Symbol> = pairs.iter().filter_map(|p| g.as_symbol(p.letter)).collect();
        let there: Vec<(Expr, Expr)> = pairs
            .iter()
            .flat_map(|p| [(p.kept, p.letter), (p.other, p.root)])
            .collect();
        let back: Vec<(Expr, Expr)> = pairs
            .iter()
            .flat_map(|p| [(p.letter, p.kept), (p.root, p.other)])
            .collect();
        let own = factors(g, g.substitute(e, &there), &[moving, &letters[..]].concat());
        let own = own.unwrap_or_default().into_iter();
        found.extend(own.map(|(f, n)| (g.substitute(f, &back), n)));
    }
    found
}

/// The sine and the cosine of an argument, one of them as a letter of which the other is a root.
struct Replaced {
    kept: Expr,
    other: Expr,
    letter: Expr,
    root: Expr,
}

/// The arguments of sines and cosines in an expression, with the function that is kept.
fn replaced(g: &Graph, e: Expr, kept: Function) -> Vec<Replaced> {
    let mut arguments: Vec<Expr> = Vec::new();
    for part in g.reachable(&[e]) {
        if let Node::Apply {
            function: Function::Sin | Function::Cos,
            arguments: own,
        } = g.node(part)
        {
            if !arguments.contains(&own[0]) {
                arguments.push(own[0]);
            }
        }
    }
    let pair = |(i, argument): (usize, Expr)| {
        let both = [g.cos(argument), g.sin(argument)];
        let [kept, other] = match kept {
            Function::Cos => both,
            _ => [both[1], both[0]],
        };
        // No name of a model contains a bracket.
        let letter = g.symbol(&format!("kept[{i}]"), 0);
        let root = g.sqrt(g.sub(g.one(), g.powi(letter, 2)));
        Replaced {
            kept,
            other,
            letter,
            root,
        }
    };
    arguments.into_iter().enumerate().map(pair).collect()
}

/// Functions of which the logarithm of a density may be a combination: products of up to two that occur.
fn exponents(cx: &Context<'_>, flow: &Flow<'_>) -> Vec<Expr> {
    let g = &cx.system.graph;
    let mut letters = flow.letters(cx, flow.autonomous);
    // A mass does not vanish.
    let masses: Vec<Symbol> = flow.masses.iter().map(|(mass, _)| *mass).collect();
    for own in &mut letters {
        let mass = g.as_symbol(own.letter.value);
        let is_mass = mass.is_some_and(|s| masses.contains(&s));
        own.exponents.0 = if is_mass { -1 } else { 0 };
    }
    let value = |member: &[(usize, i8)]| {
        let powers = member.iter();
        let powers = powers.map(|&(l, e)| g.powi(letters[l].letter.value, i64::from(e)));
        g.mul(&powers.collect::<Vec<_>>())
    };
    let members = coefficients(&letters, 0, 2);
    let members = members.iter().map(|(_, member)| value(member));
    members.filter(|&e| !g.is_one(e)).take(EXPONENTS).collect()
}
