//! Where a density may end: its zeros and poles, the poles and jumps of functions in it, and where the variables end.
//!
//! `ρ = N²/(det W det W̄)` is a function of the states, whatever variables describe them, as densities and determinants change by the
//! same Jacobians. Where the mass matrices are regular in some variables N is smooth and positive in these exactly where ρ is.

use super::formula::{factors_by_form, is_nowhere_zero};
use super::{products, Flow};
use chetaev_mechanics::sample::{self, Generator, Point};
use chetaev_mechanics::system::Relation;
use chetaev_mechanics::{Context, Manifold, System};
use chetaev_symbolic::zero::assumptions::Assumptions;
use chetaev_symbolic::zero::known_sign;
use chetaev_symbolic::{Expr, Function, Graph, Node, Symbol, Verdict};

/// Zeros are looked for from so many places, in so many steps, up to this size, and met to this.
const STARTS: usize = 24;
const STEPS: usize = 60;
const FAR: f64 = 1e3;
const MET: f64 = 1e-12;
const SEED: u64 = 0x65_64_67;

/// Where a density may end. What is assumed excludes none of these.
#[derive(Clone, Debug, Default)]
pub struct Edges {
    /// Where N is zero or infinite and ρ is not: there the variables end, or the motion is not determined.
    pub of_chart: Vec<Expr>,
    /// Where N is zero or infinite, and ρ may be: there the density ends.
    pub of_density: Vec<Expr>,
    /// Where a function in N has a pole or jumps.
    pub of_formula: Vec<Expr>,
    /// Where N may be neither zero nor infinite and the motion is not determined.
    pub of_masses: Vec<Expr>,
    /// Where the variables end, in which N may be neither zero nor infinite, and the motion is determined: in others N is zero or infinite.
    pub of_variables: Vec<Expr>,
}

impl Edges {
    /// The equations of some edges, and what holds off them.
    pub(super) fn texts(g: &Graph, edges: &[Expr], relation: &str, join: &str) -> String {
        let texts = edges.iter().map(|&e| format!("{} {relation} 0", g.text(e)));
        texts.collect::<Vec<String>>().join(join)
    }

    /// Every edge.
    pub(super) fn all(&self) -> Vec<Expr> {
        let own = [&self.of_chart[..], &self.of_density[..]];
        let others = [&self.of_formula[..], &self.of_masses, &self.of_variables];
        [own.concat(), others.concat()].concat()
    }

    /// Whether the density itself ends somewhere, whatever the variables.
    pub(super) fn ends(&self) -> bool {
        let all = [&self.of_density, &self.of_formula, &self.of_variables];
        all.iter().any(|edges| !edges.is_empty())
    }
}

/// The edges of the domain of a density.
pub(super) fn edges(cx: &Context<'_>, flow: &Flow<'_>, density: Expr) -> Edges {
    let g = &cx.system.graph;
    let own = Ends::of(cx, flow, density, factors_by_form(g, density));
    let Some(masses) = flow.masses_of_states(cx) else {
        return Edges {
            of_density: own.of_powers,
            of_formula: own.of_functions,
            ..Edges::default()
        };
    };
    let ratio = g.mul(&[g.powi(density, 2), g.powi(masses, -1)]);
    let of_states = match is_fixed(cx, flow, ratio) {
        true => Vec::new(),
        false => {
            let parts = products::quotient(g, ratio).into_iter();
            let parts = parts.flat_map(|part| factors_by_form(g, part)).collect();
            let found = Ends::of(cx, flow, ratio, parts);
            // Masses that jump, as the constraints do, are regular on both sides.
            let signs = g.reachable(&[ratio]).into_iter();
            let signs: Vec<Expr> = signs.filter_map(|e| sign_of(g, e)).collect();
            let functions = found.of_functions.into_iter();
            let functions: Vec<Expr> = functions.filter(|e| !signs.contains(e)).collect();
            [found.of_powers, functions].concat()
        }
    };
    let meet = |a: Expr, b: Expr| is_zero_where(cx, a, b) || is_zero_where(cx, b, a);
    // A function of one variable vanishes at places, as 1 - cos x at some of those of sin x; of more it may do so nowhere.
    let is_of_one = |e: Expr| moving(flow, e).len() == 1;
    let ends_at = |h: Expr, e: Expr| is_zero_where(cx, h, e) || is_of_one(h) && meet(h, e);
    let ends_there = |edge: &Expr| of_states.iter().any(|&h| ends_at(h, *edge));
    let (of_density, of_chart): (Vec<Expr>, Vec<Expr>) =
        own.of_powers.into_iter().partition(ends_there);
    let named = [&of_density[..], &own.of_functions].concat();
    let of_masses = of_states.into_iter().filter(|&h| {
        let is_named = named.iter().any(|&edge| meet(h, edge));
        !is_named && may_vanish(cx, flow, h)
    });
    let (of_variables, of_masses) = of_masses.partition(|&h| is_determined(cx, flow, h));
    Edges {
        of_masses,
        of_variables,
        of_chart: of_chart
            .into_iter()
            .filter(|&edge| may_vanish(cx, flow, edge))
            .collect(),
        of_density,
        of_formula: own.of_functions,
    }
}

/// Whether nothing that moves changes a function on the constraint manifold; one that its letters hide is not seen by its form.
fn is_fixed(cx: &Context<'_>, flow: &Flow<'_>, e: Expr) -> bool {
    let g = &cx.system.graph;
    let moving = moving(flow, e).into_iter();
    let slopes: Vec<Expr> = moving.map(|s| g.diff(e, s)).collect();
    flow.chart.implicit().next().is_none()
        && matches!(
            cx.prover
                .identity(cx.system, &slopes, &flow.chart.manifold, ""),
            Verdict::Proved(_)
        )
}

/// What moves in an expression.
fn moving(flow: &Flow<'_>, e: Expr) -> Vec<Symbol> {
    let own = flow.motion.system.graph.symbols_in(&[e]).into_iter();
    let speeds = flow.symbols();
    own.filter(|&s| flow.motion.moves(s) || speeds.contains(&s))
        .collect()
}

/// Whether a function may vanish wherever another one does.
fn is_zero_where(cx: &Context<'_>, e: Expr, edge: Expr) -> bool {
    let (system, g) = (cx.system, &cx.system.graph);
    if e == edge {
        return true;
    }
    let steep = g.symbols_in(&[edge]).into_iter();
    let mut steep = steep.filter(|&s| !g.is_zero(g.diff(edge, s)) && g.contains_any(e, &[s]));
    let Some(symbol) = steep.next_back() else {
        return false;
    };
    let manifold = Manifold {
        solved: Vec::new(),
        implicit: vec![(edge, symbol)],
    };
    !matches!(
        cx.prover.identity(system, &[e], &manifold, ""),
        Verdict::Refuted(_)
    )
}

/// Where an expression may be zero, infinite or not smooth.
struct Ends {
    /// Zeros of what powers are taken of.
    of_powers: Vec<Expr>,
    /// Zeros of what functions are infinite or jump at.
    of_functions: Vec<Expr>,
}

impl Ends {
    /// Of a product of powers, those that are not seen to keep their signs.
    fn of(cx: &Context<'_>, flow: &Flow<'_>, e: Expr, powers: Vec<Expr>) -> Ends {
        let g = &cx.system.graph;
        let moving = moving(flow, e);
        let add = |found: &mut Vec<Expr>, e: Expr| {
            let e = without_absolute_value(g, e);
            let is_one = g.contains_any(e, &moving) && !is_nowhere_zero(cx, e);
            let known = |f: &Expr| *f == e || *f == g.neg(e);
            if is_one && !found.iter().any(known) {
                found.push(e);
            }
        };
        let (mut of_powers, mut of_functions) = (Vec::new(), Vec::new());
        let bases = powers.into_iter().map(|e| g.base_exponent(e).0);
        let bases: Vec<Expr> = bases.map(|e| without_absolute_value(g, e)).collect();
        for &base in &bases {
            for part in products::quotient(g, base) {
                add(&mut of_powers, g.base_exponent(part).0);
            }
        }
        for inner in g.reachable(&bases) {
            if let Some(edge) = singular_where(g, inner) {
                add(&mut of_functions, edge);
            }
        }
        of_functions.retain(|e| !of_powers.contains(e) && !of_powers.contains(&g.neg(*e)));
        Ends {
            of_powers,
            of_functions,
        }
    }
}

/// What a power or a function is not smooth at the zeros of.
fn singular_where(g: &Graph, e: Expr) -> Option<Expr> {
    match g.node(e) {
        Node::Power { base, exponent } => {
            (!known_sign(g, *exponent, &Assumptions::new()).is_nonnegative()).then_some(*base)
        }
        Node::Apply {
            function,
            arguments,
        } => match function {
            Function::Log | Function::Sign | Function::Atan2 => Some(arguments[0]),
            Function::Tan | Function::Sec => Some(g.cos(arguments[0])),
            Function::Cot | Function::Csc => Some(g.sin(arguments[0])),
            _ => None,
        },
        _ => None,
    }
}

/// What a sign is taken of.
fn sign_of(g: &Graph, e: Expr) -> Option<Expr> {
    match g.node(e) {
        Node::Apply {
            function: Function::Sign,
            arguments,
        } => Some(arguments[0]),
        _ => None,
    }
}

/// Whether the motion is determined where a function vanishes, at a state that was found there: W bordered by the gradients of the
/// constraints, `(W fᵥᵀ; fᵥ 0)`, is regular whatever variables describe the states.
fn is_determined(cx: &Context<'_>, flow: &Flow<'_>, edge: Expr) -> bool {
    let (system, g) = (cx.system, &cx.system.graph);
    let (n, r) = (system.n(), cx.terms.constraints.len());
    let at = |es: &[Expr], point: &Point| {
        let values = g.evaluate_f64(es, &|s| point.get(&s).copied()).ok();
        values.filter(|values| values.iter().all(|x| x.is_finite()))
    };
    let bordered: Vec<Expr> = (0..n + r)
        .flat_map(|i| (0..n + r).map(move |j| (i.min(j), i.max(j))))
        .map(|(i, j)| match (i < n, j < n) {
            (true, true) => cx.terms.mass_matrix[i][j],
            (true, false) => cx.terms.jacobian[j - n][i],
            _ => g.zero(),
        })
        .collect();
    let own = states(flow, system);
    let together = |e: Expr| -> Vec<Expr> {
        let gradient = g.gradient(e, &own);
        std::iter::once(e).chain(gradient).collect()
    };
    let mut all: Vec<Vec<Expr>> = cx.terms.constraints.iter().map(|&f| together(f)).collect();
    all.push(together(edge));
    (0..STARTS as u64).any(|number| {
        let seed = SEED.wrapping_add(number);
        let Some(mut point) = sample::admissible_point(system, cx.terms, seed) else {
            return false;
        };
        let is_led = (0..STEPS).all(|_| all.iter().all(|f| is_stepped(g, f, &own, &mut point)));
        if !is_led {
            return false;
        }
        let left: Vec<Expr> = all.iter().map(|f| f[0]).collect();
        let is_there = at(&left, &point).is_some_and(|f| f.iter().all(|x| x.abs() < MET.sqrt()));
        is_there
            && at(&bordered, &point).is_some_and(|entries| {
                let rows = entries.chunks(n + r).map(sample::scaled);
                sample::least_pivot(rows.collect()) > MET.sqrt()
            })
    })
}

/// One of Newton's steps along the gradient; `all` are the function and its derivatives by `own`. Whether they have values there.
fn is_stepped(g: &Graph, all: &[Expr], own: &[Symbol], point: &mut Point) -> bool {
    let Ok(found) = g.evaluate_f64(all, &|s| point.get(&s).copied()) else {
        return false;
    };
    let (value, slopes) = (found[0], &found[1..]);
    let square: f64 = slopes.iter().map(|d| d * d).sum();
    if value != 0.0 {
        for (s, d) in own.iter().zip(slopes) {
            point.entry(*s).and_modify(|x| *x -= value / square * d);
        }
    }
    found.iter().all(|x| x.is_finite())
}

/// All coordinates and velocities.
fn states(flow: &Flow<'_>, system: &System) -> Vec<Symbol> {
    let coordinates = system.coordinate_symbols().into_iter();
    let all = coordinates.chain(system.velocity_symbols());
    all.filter(|&s| flow.motion.moves(s)).collect()
}

fn without_absolute_value(g: &Graph, e: Expr) -> Expr {
    match g.node(e) {
        Node::Apply {
            function: Function::Abs,
            arguments,
        } => arguments[0],
        _ => e,
    }
}

/// Whether a function is seen to vanish at a place that the assumptions allow, for the values of the parameters that the model states: a
/// sum is led there by steps along its gradient.
fn may_vanish(cx: &Context<'_>, flow: &Flow<'_>, e: Expr) -> bool {
    let (system, g) = (cx.system, &cx.system.graph);
    if !matches!(g.node(e), Node::Sum { .. }) {
        return true;
    }
    let own = moving(flow, e);
    let e = g.substitute(e, &system.parameter_values());
    let all: Vec<Expr> = std::iter::once(e).chain(g.gradient(e, &own)).collect();
    let Some(others) = sample::admissible_point(system, cx.terms, SEED) else {
        return true;
    };
    let mut generator = Generator::new(SEED);
    (0..STARTS).any(|_| {
        let mut point = others.clone();
        point.extend(own.iter().map(|&s| (s, generator.between(-4.0, 4.0))));
        is_led_to_zero(g, &all, &own, &mut point) && is_allowed(cx, &point)
    })
}

/// Newton's iteration along the gradient; `all` are the function and its derivatives by `own`.
fn is_led_to_zero(g: &Graph, all: &[Expr], own: &[Symbol], point: &mut Point) -> bool {
    for _ in 0..STEPS {
        let Ok(found) = g.evaluate_f64(all, &|s| point.get(&s).copied()) else {
            return false;
        };
        let (value, slopes) = (found[0], &found[1..]);
        let square: f64 = slopes.iter().map(|d| d * d).sum();
        if value.abs() < MET {
            return true;
        }
        let step = value / square;
        for (s, d) in own.iter().zip(slopes) {
            point.entry(*s).and_modify(|x| *x -= step * d);
        }
        if !own.iter().all(|s| point[s].abs() < FAR) {
            return false;
        }
    }
    false
}

/// Whether what is assumed of what moves holds at a point, as far as it has values there; masses are positive.
fn is_allowed(cx: &Context<'_>, point: &Point) -> bool {
    let (system, g) = (cx.system, &cx.system.graph);
    let values = system.parameter_values();
    let holds = |a: &chetaev_mechanics::system::Assumption| {
        let difference = g.substitute(g.sub(a.right, a.left), &values);
        let found = g.evaluate_f64(&[difference], &|s| point.get(&s).copied());
        let Some(d) = found.ok().and_then(|found| found.first().copied()) else {
            return true;
        };
        match a.relation {
            Relation::NotEqual => d.abs() > MET.sqrt(),
            Relation::Less => d > MET.sqrt(),
            Relation::LessOrEqual => d > -MET.sqrt(),
        }
    };
    let is_there = |s: Symbol| point.get(&s).is_none_or(|&m| m > 0.0);
    system.assumptions.iter().all(holds) && system.masses.iter().all(|m| is_there(m.symbol))
}
