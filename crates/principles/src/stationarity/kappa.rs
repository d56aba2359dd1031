//! Multipliers that the conditions leave free, in closed form: `κ' = Φ κ − λ` integrated along the motion.

use super::closed_form::{closed, short};
use super::motion::Motion;
use chetaev_mechanics::claims::formulation::basis;
use chetaev_mechanics::claims::Context;
use chetaev_mechanics::equations::unused_name;
use chetaev_mechanics::linear::dot;
use chetaev_mechanics::System;
use chetaev_symbolic::{simplify, Expr, Graph, Node, Symbol};

/// κ of the constraints in closed form along all motions, each with its constant of integration; `None` for those that are not
/// found.
pub(crate) fn integrated(cx: &Context<'_>, motion: &Motion) -> Vec<Option<Expr>> {
    let own = Rates {
        transport: motion.transport.clone(),
        multipliers: motion.multipliers.clone(),
    };
    let found = own.integrated(cx, motion);
    if found.iter().all(Option::is_some) {
        return found;
    }
    let solved = by_slopes(cx, motion).filter(|solved| solved.iter().all(Option::is_some));
    solved.unwrap_or(found)
}

/// Multipliers whose rates are `Φ κ − λ`.
struct Rates {
    /// Φ, row by row.
    transport: Vec<Vec<Expr>>,
    /// λ.
    multipliers: Vec<Expr>,
}

impl Rates {
    /// One multiplier after the other, each once all those are known that its rate contains.
    fn integrated(&self, cx: &Context<'_>, motion: &Motion) -> Vec<Option<Expr>> {
        let (system, g) = (cx.system, &cx.system.graph);
        let r = self.multipliers.len();
        let basis = basis(cx);
        let names = basis.constraint_names().into_iter();
        let constants: Vec<Expr> = names.map(|name| free_constant(system, g, name)).collect();
        let mut known: Vec<Option<Expr>> = vec![None; r];
        let next = |known: &[Option<Expr>]| {
            let mut unknown = (0..r).filter(|&l| known[l].is_none());
            unknown.find_map(|l| Some((l, self.one(cx, motion, (known, &constants), l)?)))
        };
        while let Some((l, value)) = next(&known) {
            known[l] = Some(value);
        }
        known
    }

    /// κ_l, from those that are known and their constants of integration.
    fn one(
        &self,
        cx: &Context<'_>,
        motion: &Motion,
        (known, constants): (&[Option<Expr>], &[Expr]),
        l: usize,
    ) -> Option<Expr> {
        let g = &cx.system.graph;
        let mut rate = vec![g.neg(self.multipliers[l])];
        for (m, &coefficient) in self.transport[l].iter().enumerate() {
            if !g.is_zero(coefficient) {
                rate.push(g.mul(&[coefficient, known[m]?]));
            }
        }
        let rate = g.add(&rate);
        let symbols: Vec<Symbol> = g.symbols_in(constants);
        let slopes = g.gradient(rate, &symbols);
        let free = |e: Expr| {
            let zeros: Vec<(Expr, Expr)> = constants.iter().map(|&c| (c, g.zero())).collect();
            g.substitute(e, &zeros)
        };
        // The rate is affine in the constants: what belongs to each is integrated by itself.
        let mut parts = vec![constants[l], antiderivative(cx, motion, l, free(rate))?];
        for (&symbol, slope) in symbols.iter().zip(slopes) {
            let weight = antiderivative(cx, motion, l, free(slope))?;
            parts.push(g.mul(&[g.symbol_expr(symbol), weight]));
        }
        Some(simple(g, g.add(&parts)))
    }
}

/// κ by the multipliers of f solved for the dependent velocities: `κ̂ = S κ` with `S_ml = ∂f^l/∂v_m` has
/// `κ̂' = (DS + S Φ) S⁻¹ κ̂ − S λ`, and S Φ = −DS where no f contains a dependent coordinate.
fn by_slopes(cx: &Context<'_>, motion: &Motion) -> Option<Vec<Option<Expr>>> {
    let g = &cx.system.graph;
    let (jacobian, r) = (basis(cx).jacobian(), motion.multipliers.len());
    let dependent = &cx.selection.dependent;
    let slopes: Vec<Vec<Expr>> = dependent
        .iter()
        .map(|&d| {
            let column = jacobian.iter();
            column.map(|row| motion.on_states(g, row[d])).collect()
        })
        .collect();
    if slopes.len() != r || slopes.iter().any(|row| row.len() != r) {
        return None;
    }
    let flat = slopes.concat();
    let unit = |m: usize| -> Vec<Expr> {
        let entry = |l: usize| if l == m { g.one() } else { g.zero() };
        (0..r).map(entry).collect()
    };
    let columns: Vec<Vec<Expr>> = (0..r)
        .map(|m| g.solve(&flat, &unit(m)).ok())
        .collect::<Option<_>>()?;
    let back = |l: usize, m: usize| columns[m][l];
    let turned = |m: usize, l: usize| {
        let carried = (0..r).map(|n| g.mul(&[slopes[m][n], motion.transport[n][l]]));
        let carried: Vec<Expr> = carried.collect();
        g.add(&[motion.along(cx, slopes[m][l]), g.add(&carried)])
    };
    let entry = |m: usize, l: usize| {
        let parts: Vec<Expr> = (0..r).map(|n| g.mul(&[turned(m, n), back(n, l)])).collect();
        closed(g, g.add(&parts)).ok()
    };
    let transport = (0..r).map(|m| (0..r).map(|l| entry(m, l)).collect());
    let multipliers = slopes.iter().map(|row| dot(g, row, &motion.multipliers));
    let solved = Rates {
        transport: transport.collect::<Option<_>>()?,
        multipliers: multipliers.map(|e| short(g, e)).collect(),
    };
    let known = solved.integrated(cx, motion);
    let value = |l: usize| {
        let mut parts = Vec::new();
        for (m, known) in known.iter().enumerate() {
            if !g.is_zero(back(l, m)) {
                parts.push(g.mul(&[back(l, m), (*known)?]));
            }
        }
        closed(g, g.add(&parts)).ok()
    };
    Some((0..r).map(value).collect())
}

/// A function whose rate along all motions is the given one: a constant multiple of a function at hand (the roots in the
/// constraints, the momenta of the dependent velocities, velocities, coordinates and the time), or of `θ` and the time, where
/// `D(κ + θ) = ∂L/∂q` is constant (T1 (13')).
fn antiderivative(cx: &Context<'_>, motion: &Motion, l: usize, rate: Expr) -> Option<Expr> {
    let g = &cx.system.graph;
    let rate = simple(g, rate);
    if g.is_zero(rate) {
        return Some(g.zero());
    }
    let mut moving = motion.state();
    moving.push(g.intern_symbol("t", 0));
    for candidate in candidates(cx, motion, l) {
        let moved = simple(g, motion.along(cx, candidate));
        if g.is_zero(moved) {
            continue;
        }
        let ratio = simple(g, g.div(rate, moved));
        if !g.contains_any(ratio, &moving) {
            return Some(g.mul(&[ratio, candidate]));
        }
    }
    let theta = momentum(cx, motion, l)?;
    let rest = simple(g, g.add(&[rate, motion.along(cx, theta)]));
    let value = g.add(&[g.neg(theta), g.mul(&[rest, g.symbol("t", 0)])]);
    (!g.contains_any(rest, &moving)).then_some(value)
}

fn simple(g: &Graph, e: Expr) -> Expr {
    simplify::simplify(g, e, &simplify::Options::default())
}

/// The constant of integration of κ of a constraint.
pub(crate) fn free_constant(system: &System, g: &Graph, constraint: &str) -> Expr {
    g.symbol(&unused_name(system, &format!("const_{constraint}")), 0)
}

/// Functions whose rates may be proportional to λ.
fn candidates(cx: &Context<'_>, motion: &Motion, l: usize) -> Vec<Expr> {
    let (system, g) = (cx.system, &cx.system.graph);
    let mut list: Vec<Expr> = g
        .reachable(&basis(cx).constraints())
        .into_iter()
        .filter(|&e| matches!(g.node(e), Node::Power { exponent, .. } if g.as_integer(*exponent).is_none()))
        .map(|e| motion.on_states(g, e))
        .collect();
    list.extend(momentum(cx, motion, l));
    list.extend(motion.speeds.iter().map(|&s| g.symbol_expr(s)));
    list.extend(system.coordinates.iter().map(|c| motion.on_states(g, c.v)));
    list.extend(system.coordinates.iter().map(|c| c.q));
    list.push(g.symbol("t", 0));
    list
}

/// θ of the dependent velocity of a constraint, divided by ∂f/∂v: the multiplier −κ of Suslov's form.
fn momentum(cx: &Context<'_>, motion: &Motion, l: usize) -> Option<Expr> {
    let (system, g) = (cx.system, &cx.system.graph);
    let d = *cx.selection.dependent.get(l)?;
    let slope = *basis(cx).jacobian().get(l)?.get(d)?;
    if g.is_zero(slope) {
        return None;
    }
    let theta = g.diff(system.lagrangian, system.coordinates[d].v_symbol);
    Some(motion.on_states(g, g.div(theta, slope)))
}
