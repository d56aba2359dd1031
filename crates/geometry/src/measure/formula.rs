//! Densities as a person writes them: without constant factors, positive where states are looked at, in as few angles and with as
//! little under roots as possible.

use super::{products, Flow};
use crate::noether::shown::readable;
use chetaev_mechanics::claims::formulation::basis;
use chetaev_mechanics::prover::assumptions;
use chetaev_mechanics::system::Coordinate;
use chetaev_mechanics::{sample, Context};
use chetaev_symbolic::factors::factored;
use chetaev_symbolic::simplify::{by_square, length};
use chetaev_symbolic::zero::assumptions::{Assumptions, SignSet};
use chetaev_symbolic::zero::known_sign;
use chetaev_symbolic::{Expr, Function, Graph, Node, Verdict};

/// The states at which the sign of a density is looked at, and where their draws begin.
const SAMPLES: u64 = 8;
const SEED: u64 = 0x64_65_6e;

/// The density divided by constants; its negative where it is negative at all sampled states.
pub(super) fn plain(cx: &Context<'_>, flow: &Flow<'_>, density: Expr) -> Expr {
    let g = &cx.system.graph;
    let without = without_constants(flow, in_differences(cx, flow, density));
    let without = without_constants(flow, products::shorter(g, without));
    let outside = outside_roots(g, without);
    let outside = without_constants(flow, with_one_base(flow, outside));
    // Outside a root the sign of a base counts, which is one for all states where it has to be.
    let found = positive_where_real(cx, outside, density);
    let found = found.or_else(|| positive_where_real(cx, without, density));
    // Without a constant factor that is negative and under a root nothing may be real.
    found.unwrap_or(match values(cx, without).iter().any(|v| v.is_nan()) {
        true => density,
        false => without,
    })
}

/// The function or its negative, whichever is positive at all sampled states where another one is real.
fn positive_where_real(cx: &Context<'_>, e: Expr, density: Expr) -> Option<Expr> {
    let both = values(cx, e).into_iter().zip(values(cx, density));
    let own: Vec<f64> = both.filter(|(_, d)| !d.is_nan()).map(|(v, _)| v).collect();
    match own.first()? {
        _ if own.iter().all(|&v| v > 0.0) => Some(e),
        _ if own.iter().all(|&v| v < 0.0) => Some(cx.system.graph.neg(e)),
        _ => None,
    }
}

/// The function or its negative, whichever is positive at all sampled states, where one is.
pub(super) fn positive(cx: &Context<'_>, e: Expr) -> Expr {
    match signs(cx, e) {
        Some(false) => cx.system.graph.neg(e),
        _ => e,
    }
}

/// A product of powers with the absolute values of bases that may be negative under exponents that are not whole: `|y|^k` is real and
/// positive on both sides of y = 0. Bases under such exponents in the model itself are left: the model ends where they change sign.
pub(crate) fn on_both_sides(cx: &Context<'_>, density: Expr) -> Expr {
    let g = &cx.system.graph;
    let factors = match g.node(density) {
        Node::Product { factors, .. } => factors.to_vec(),
        _ => vec![density],
    };
    let broken = bases_of_broken_powers(cx);
    let real = factors.into_iter().map(|factor| {
        let (base, exponent) = g.base_exponent(factor);
        let is_whole = g.as_number(exponent).is_some_and(|n| n.is_int());
        match is_whole || broken.contains(&base) || is_of_one_sign(cx, base) {
            true => factor,
            false => g.pow(g.abs(base), exponent),
        }
    });
    g.mul(&real.collect::<Vec<Expr>>())
}

/// A density with the absolute values of what it may change its sign with.
pub(super) fn positive_beyond(cx: &Context<'_>, density: Expr) -> Expr {
    let g = &cx.system.graph;
    let real = factors_by_form(g, density).into_iter().map(|factor| {
        let (base, exponent) = g.base_exponent(factor);
        let is_odd = g.as_integer(exponent).is_some_and(|n| n % 2 != 0);
        let is_function = matches!(
            g.node(base),
            Node::Apply {
                function: Function::Exp | Function::Abs,
                ..
            }
        );
        match is_odd && !is_function && !is_of_one_sign(cx, base) {
            true => g.pow(g.abs(base), exponent),
            false => factor,
        }
    });
    g.mul(&real.collect::<Vec<Expr>>())
}

pub(super) fn factors_by_form(g: &Graph, e: Expr) -> Vec<Expr> {
    match g.node(e) {
        Node::Product { factors, .. } => factors.to_vec(),
        _ => vec![e],
    }
}

/// Bases of powers that are not whole in what the model states.
fn bases_of_broken_powers(cx: &Context<'_>) -> Vec<Expr> {
    let (system, g) = (cx.system, &cx.system.graph);
    let mut stated = vec![system.lagrangian];
    stated.extend(system.constraints.iter().map(|c| c.f));
    stated.extend(&system.forces);
    let powers = g.reachable(&stated).into_iter().filter_map(|e| {
        let (base, exponent) = g.base_exponent(e);
        let is_whole = g.as_number(exponent).is_some_and(|n| n.is_int());
        (!is_whole).then_some(base)
    });
    powers.collect()
}

/// Whether an expression is seen to be nowhere negative, under the assumptions or for the values of the parameters.
pub(super) fn is_of_one_sign(cx: &Context<'_>, e: Expr) -> bool {
    forms(cx, e).any(|sign| sign.is_nonnegative())
}

/// Whether an expression is seen to vanish nowhere, under the assumptions or for the values of the parameters.
pub(super) fn is_nowhere_zero(cx: &Context<'_>, e: Expr) -> bool {
    let g = &cx.system.graph;
    let is_one = |e: Expr| forms(cx, e).any(|sign| sign.is_nonzero());
    // Over the common denominator what is assumed may be seen.
    let parts = || products::quotient(g, e);
    is_one(e)
        || parts()
            .into_iter()
            .all(|part| is_one(g.base_exponent(part).0))
}

/// What a model assumes of velocities, in the independent ones.
fn on_manifold(cx: &Context<'_>) -> Option<Assumptions> {
    let (system, g) = (cx.system, &cx.system.graph);
    let stated = assumptions(system);
    let sides: Vec<Expr> = stated
        .list()
        .iter()
        .flat_map(|a| [a.left, a.right])
        .collect();
    if !g.any_contains_any(&sides, &system.velocity_symbols()) {
        return None;
    }
    let chart = basis(cx).characteristics().ok()?;
    let mut list = Assumptions::new();
    for a in stated.list() {
        let both = chart.restrict(system, &[a.left, a.right]);
        list.assume(readable(g, both[0]), a.relation, readable(g, both[1]));
    }
    Some(list)
}

/// What its forms tell of the sign of an expression.
fn forms<'c>(cx: &'c Context<'_>, e: Expr) -> impl Iterator<Item = SignSet> + 'c {
    let g = &cx.system.graph;
    let mut stated = assumptions(cx.system);
    // A motion ends where a mass does.
    for mass in &cx.system.masses {
        stated.positive(g, g.symbol_expr(mass.symbol));
    }
    let values = cx.system.parameter_values();
    let mut both = vec![(e, stated.clone()), (g.substitute(e, &values), stated)];
    if let Some(on_manifold) = on_manifold(cx) {
        both.push((e, on_manifold));
    }
    both.into_iter().flat_map(move |(e, stated)| {
        let forms = [e, by_square(g, e, true), by_square(g, e, false)];
        forms.map(|e| known_sign(g, e, &stated))
    })
}

/// Whether an expression has no value at any sampled state, for the values of the parameters.
pub(super) fn is_undefined(cx: &Context<'_>, e: Expr) -> bool {
    !values(cx, e).iter().any(|v| v.is_finite() && *v != 0.0)
}

/// Whether an expression is positive, or negative, at all sampled states.
fn signs(cx: &Context<'_>, e: Expr) -> Option<bool> {
    let values = values(cx, e);
    let all = |holds: fn(f64) -> bool| !values.is_empty() && values.iter().all(|&v| holds(v));
    match (all(|v| v > 0.0), all(|v| v < 0.0)) {
        (true, _) => Some(true),
        (_, true) => Some(false),
        _ => None,
    }
}

fn values(cx: &Context<'_>, e: Expr) -> Vec<f64> {
    let g = &cx.system.graph;
    // States are sampled in the velocities of the coordinates.
    let quasi = cx.system.quasi_velocities.iter();
    let definitions: Vec<(Expr, Expr)> = quasi
        .map(|own| (g.symbol(&own.name, 0), own.definition))
        .collect();
    let e = g.substitute(e, &definitions);
    let points =
        (0..SAMPLES).filter_map(|i| sample::admissible_point(cx.system, cx.terms, SEED + i));
    let values = points.filter_map(|point| {
        let found = g.evaluate_f64(&[e], &|s| point.get(&s).copied()).ok();
        found.and_then(|values| values.first().copied())
    });
    values.collect()
}

/// A function of two coordinates that depends on their sum or difference only, written in it.
fn in_differences(cx: &Context<'_>, flow: &Flow<'_>, density: Expr) -> Expr {
    let (system, g) = (cx.system, &cx.system.graph);
    let own: Vec<&Coordinate> = system
        .coordinates
        .iter()
        .filter(|c| g.contains_any(density, &[c.q_symbol]))
        .collect();
    let [first, second] = own[..] else {
        return density;
    };
    let slopes = [first, second].map(|c| g.diff(density, c.q_symbol));
    let is_kept = |along: Expr| {
        let manifold = &flow.chart.manifold;
        let verdict = cx.prover.identity(system, &[along], manifold, "");
        matches!(verdict, Verdict::Proved(_))
    };
    // Where it does not change as both grow it depends on the difference.
    let combination = match slopes {
        [a, b] if is_kept(g.add(&[a, b])) => g.sub(first.q, second.q),
        [a, b] if is_kept(g.sub(a, b)) => g.add(&[first.q, second.q]),
        _ => return density,
    };
    let at_zero = readable(g, g.substitute(density, &[(second.q, g.zero())]));
    let written = g.substitute(at_zero, &[(first.q, combination)]);
    match length(g, written) < length(g, density) {
        true => written,
        false => density,
    }
}

/// Even powers under square roots stand outside: `√(a/b²)` as `√a/b`.
fn outside_roots(g: &Graph, e: Expr) -> Expr {
    match g.node(e) {
        Node::Product {
            coefficient,
            factors,
        } => {
            let factors = factors.iter().map(|&factor| outside_root(g, factor));
            let coefficient = g.number(coefficient.clone());
            g.mul(&factors.chain([coefficient]).collect::<Vec<Expr>>())
        }
        _ => outside_root(g, e),
    }
}

fn outside_root(g: &Graph, root: Expr) -> Expr {
    let (base, exponent) = g.base_exponent(root);
    let twice = g.as_integer(g.mul(&[exponent, g.integer(2)]));
    let (
        Node::Product {
            coefficient,
            factors,
        },
        Some(twice),
    ) = (g.node(base), twice.filter(|n| n % 2 != 0))
    else {
        return root;
    };
    let mut inside = vec![g.number(coefficient.clone())];
    let mut outside = Vec::new();
    for &factor in factors.iter() {
        let (own, power) = g.base_exponent(factor);
        match g.as_integer(power).filter(|n| n % 2 == 0) {
            Some(power) => outside.push(g.powi(own, power / 2 * twice)),
            None => inside.push(factor),
        }
    }
    outside.push(g.pow(g.mul(&inside), exponent));
    g.mul(&outside)
}

/// A product in which bases under whole exponents that are constant multiples of others are these, up to a constant factor.
fn with_one_base(flow: &Flow<'_>, e: Expr) -> Expr {
    let (g, own) = (&flow.motion.system.graph, flow.symbols());
    let factors = factors_by_form(g, e);
    let moves = |e: Expr| !g.is_free_of(e, &|s| flow.motion.moves(s) || own.contains(&s));
    let powers: Vec<(Expr, Expr)> = factors.iter().map(|&f| g.base_exponent(f)).collect();
    let is_sum = |e: Expr| matches!(g.node(e), Node::Sum { .. });
    let is_whole = |exponent: Expr| g.as_integer(exponent).is_some();
    let mut found: Vec<(Expr, Expr)> = Vec::new();
    let (whole, broken): (Vec<_>, Vec<_>) = powers.into_iter().partition(|p| is_whole(p.1));
    found.extend(broken);
    for (base, exponent) in whole {
        let is_multiple = |other: Expr| {
            let ratio = factored(g, g.div(base, other));
            ratio.is_some_and(|r| !r.factors.iter().any(|(f, _)| moves(*f)))
        };
        let mut others = found.iter_mut();
        let other = others.find(|(other, power)| {
            !is_whole(*power) && is_sum(base) && is_sum(*other) && is_multiple(*other)
        });
        match other {
            Some((_, power)) => *power = g.add(&[*power, exponent]),
            None => found.push((base, exponent)),
        }
    }
    let parts = found.into_iter().map(|(base, e)| g.pow(base, e));
    g.mul(&parts.collect::<Vec<Expr>>())
}

/// The factors that do not move, of a product or of all terms of a sum; roots of products included.
fn without_constants(flow: &Flow<'_>, e: Expr) -> Expr {
    let g = &flow.motion.system.graph;
    let own = flow.symbols();
    let is_constant = |e: Expr| g.is_free_of(e, &|s| flow.motion.moves(s) || own.contains(&s));
    if is_constant(e) {
        return g.one();
    }
    match g.node(e) {
        Node::Product { factors, .. } => {
            let moving = factors.iter().copied().filter(|&f| !is_constant(f));
            let plain: Vec<Expr> = moving.map(|f| without_constants(flow, f)).collect();
            g.mul(&plain)
        }
        Node::Power { base, exponent } if is_constant(*exponent) => {
            g.pow(without_constants(flow, *base), *exponent)
        }
        Node::Sum { terms, constant } => {
            let constants = |e: Expr| -> Vec<Expr> {
                match g.node(e) {
                    Node::Product { factors, .. } => factors
                        .iter()
                        .copied()
                        .filter(|&f| is_constant(f))
                        .collect(),
                    _ if is_constant(e) => vec![e],
                    _ => Vec::new(),
                }
            };
            let shared = terms
                .iter()
                .map(|&(e, _)| constants(e))
                .reduce(|a, b| a.into_iter().filter(|f| b.contains(f)).collect());
            let shared = shared.filter(|_| constant.is_zero()).unwrap_or_default();
            let divided = terms.iter().map(|(term, c)| {
                let reciprocals = shared.iter().map(|&f| g.powi(f, -1));
                let parts: Vec<Expr> = [g.number(c.clone()), *term]
                    .into_iter()
                    .chain(reciprocals)
                    .collect();
                g.mul(&parts)
            });
            match shared.is_empty() {
                true => e,
                false => g.add(&divided.collect::<Vec<Expr>>()),
            }
        }
        _ => e,
    }
}
