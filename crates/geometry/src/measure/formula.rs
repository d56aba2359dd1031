//! Densities as a person writes them: without constant factors, positive where states are looked at, in as few angles and with as
//! little under roots as possible.

use super::{products, Flow};
use crate::noether::shown::readable;
use chetaev_mechanics::prover::assumptions;
use chetaev_mechanics::system::Coordinate;
use chetaev_mechanics::{sample, Context};
use chetaev_symbolic::simplify::{by_square, length};
use chetaev_symbolic::zero::known_sign;
use chetaev_symbolic::{Expr, Function, Graph, Node, Verdict};

/// The states at which the sign of a density is looked at, and where their draws begin.
const SAMPLES: u64 = 8;
const SEED: u64 = 0x64_65_6e;

/// The density divided by constants; its negative where it is negative at all sampled states.
pub(super) fn plain(cx: &Context<'_>, flow: &Flow<'_>, density: Expr) -> Expr {
    let g = &cx.system.graph;
    let without = without_constants(flow, in_differences(cx, flow, density));
    let outside = outside_roots(g, without);
    // Outside a root the sign of a base counts, which is one for all states where it has to be.
    match signs(cx, outside) {
        Some(true) => outside,
        Some(false) => g.neg(outside),
        None => match signs(cx, without) {
            Some(false) => g.neg(without),
            Some(true) => without,
            // A root of a product whose constant factor is negative.
            None => match values(cx, without).iter().any(|v| v.is_nan()) {
                true => density,
                false => without,
            },
        },
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

/// Where a density may be zero or infinite: the bases of its factors that are not seen to be of one sign.
#[derive(Clone, Debug, Default)]
pub struct Edges {
    /// Where the velocities η do not determine the motion or its mass matrix is singular: there the chart ends.
    pub of_chart: Vec<Expr>,
    /// Where the motion goes on: there the density ends.
    pub of_density: Vec<Expr>,
}

impl Edges {
    /// The equations of some edges, and what holds off them.
    pub(super) fn texts(g: &Graph, edges: &[Expr], relation: &str, join: &str) -> String {
        let texts = edges.iter().map(|&e| format!("{} {relation} 0", g.text(e)));
        texts.collect::<Vec<String>>().join(join)
    }
}

/// A density with the absolute values of what it changes its sign with.
pub(super) fn positive_beyond(g: &Graph, density: Expr, edges: &Edges) -> Expr {
    let factors = match g.node(density) {
        Node::Product { factors, .. } => factors.to_vec(),
        _ => vec![density],
    };
    let real = factors.into_iter().map(|factor| {
        let (base, exponent) = g.base_exponent(factor);
        let is_odd = g.as_integer(exponent).is_some_and(|n| n % 2 != 0);
        match is_odd && edges.of_density.contains(&base) {
            true => g.pow(g.abs(base), exponent),
            false => factor,
        }
    });
    g.mul(&real.collect::<Vec<Expr>>())
}

/// The edges of the domain of a density.
pub(super) fn edges(cx: &Context<'_>, flow: &Flow<'_>, density: Expr) -> Edges {
    let g = &cx.system.graph;
    let factors = match g.node(density) {
        Node::Product { factors, .. } => factors.to_vec(),
        _ => vec![density],
    };
    let mut moving = cx.system.coordinate_symbols();
    moving.extend(cx.system.velocity_symbols());
    moving.extend(flow.symbols());
    let bases = factors.into_iter().map(|factor| {
        let base = g.base_exponent(factor).0;
        match g.node(base) {
            Node::Apply {
                function: Function::Abs,
                arguments,
            } => arguments[0],
            _ => base,
        }
    });
    let vanishes = |&base: &Expr| {
        let is_exponential = matches!(
            g.node(base),
            Node::Apply {
                function: Function::Exp,
                ..
            }
        );
        !is_exponential && g.any_contains_any(&[base], &moving) && !is_of_one_sign(cx, base)
    };
    let bases: Vec<Expr> = bases.filter(vanishes).collect();
    let singular = match bases.is_empty() {
        true => Vec::new(),
        false => products::singular(cx, flow),
    };
    let is_of_chart = |&base: &Expr| {
        let own = products::factors_of(g, base, &moving);
        !own.is_empty()
            && own
                .iter()
                .all(|f| singular.contains(f) || singular.contains(&g.neg(*f)))
    };
    let (of_chart, of_density) = bases.into_iter().partition(is_of_chart);
    Edges {
        of_chart,
        of_density,
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

/// Whether an expression is seen to be nowhere negative, under the assumptions or for the values of the parameters; a composed one also
/// where it is positive at all sampled states: factors of det W̄ keep their signs where the mass matrix is regular.
fn is_of_one_sign(cx: &Context<'_>, e: Expr) -> bool {
    let g = &cx.system.graph;
    if matches!(g.node(e), Node::Sum { .. }) && signs(cx, e) == Some(true) {
        return true;
    }
    let stated = assumptions(cx.system);
    let valued = g.substitute(e, &cx.system.parameter_values());
    let forms = [e, valued].into_iter();
    let mut forms = forms.flat_map(|e| [e, by_square(g, e, true), by_square(g, e, false)]);
    forms.any(|e| known_sign(g, e, &stated).is_nonnegative())
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
