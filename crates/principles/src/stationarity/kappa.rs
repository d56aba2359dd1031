//! Multipliers that the conditions leave free, in closed form: `κ' = Φ κ − λ` integrated along the motion.

use super::cases::Leaf;
use super::closed_form::{closed, short};
use super::closure::Condition;
use super::motion::Motion;
use chetaev_mechanics::claims::formulation::basis;
use chetaev_mechanics::claims::Context;
use chetaev_mechanics::equations::unused_name;
use chetaev_mechanics::linear::dot;
use chetaev_mechanics::System;
use chetaev_symbolic::matrix::inverse;
use chetaev_symbolic::{simplify, Expr, Graph, Node, Symbol};

/// κ of the constraints in closed form along all motions, each with its constant of integration; `None` for those that are not
/// found.
pub(crate) fn integrated(cx: &Context<'_>, motion: &Motion) -> Vec<Option<Expr>> {
    along(cx, motion, &Place::anywhere(cx, motion))
}

/// The same along the motions of a set. Multipliers that the conditions there tie to free ones are given by these.
pub(crate) fn integrated_on(cx: &Context<'_>, motion: &Motion, leaf: &Leaf) -> Vec<Option<Expr>> {
    let found = along(cx, motion, &Place::on(cx, motion, leaf));
    let values: Option<Vec<Expr>> = found.iter().copied().collect();
    match values.is_none_or(|values| solves(cx, motion, leaf, &values)) {
        true => found,
        false => vec![None; found.len()],
    }
}

/// Whether κ satisfies (12) and (13) on a set.
fn solves(cx: &Context<'_>, motion: &Motion, leaf: &Leaf, kappa: &[Expr]) -> bool {
    let g = &cx.system.graph;
    let place = Place::on(cx, motion, leaf);
    let demanded = motion.transport.iter().zip(&motion.multipliers);
    let rates = kappa.iter().zip(demanded).map(|(&value, (row, &lambda))| {
        let demanded = g.sub(dot(g, row, kappa), lambda);
        g.sub(motion.along(cx, value), demanded)
    });
    let conditions = motion.conditions.iter().map(|row| dot(g, row, kappa));
    let mut residuals = rates.chain(conditions);
    residuals.all(|e| g.is_zero(place.restricted(g, e)))
}

fn along(cx: &Context<'_>, motion: &Motion, place: &Place) -> Vec<Option<Expr>> {
    let own = place.rates(cx, motion);
    let found = place.tied(cx, own.integrated(cx, motion, place));
    if found.iter().all(Option::is_some) {
        return found;
    }
    let solved = by_slopes(cx, motion, place).filter(|solved| solved.iter().all(Option::is_some));
    solved.unwrap_or(found)
}

/// Where κ is integrated: along all motions, or along those of a set.
struct Place {
    /// What holds there, as pairs to be substituted.
    values: Vec<(Expr, Expr)>,
    /// The symbols that move, the time among them.
    moving: Vec<Symbol>,
    /// Multipliers given by others: κ = right − Σ coefficient κ.
    tied: Vec<(usize, Condition)>,
}

impl Place {
    fn anywhere(cx: &Context<'_>, motion: &Motion) -> Place {
        let mut moving = motion.state();
        moving.push(cx.system.graph.intern_symbol("t", 0));
        Place {
            values: Vec::new(),
            moving,
            tied: Vec::new(),
        }
    }

    fn on(cx: &Context<'_>, motion: &Motion, leaf: &Leaf) -> Place {
        let g = &cx.system.graph;
        let mut place = Place::anywhere(cx, motion);
        place.values = leaf.substitutions(g);
        place.tied = leaf.conditions();
        let rests = |s: &Symbol| {
            let rate = motion.rates.iter().find(|(symbol, _)| symbol == s);
            rate.is_some_and(|&(_, rate)| g.is_zero(place.restricted(g, rate)))
        };
        let resting: Vec<Symbol> = place.moving.iter().copied().filter(rests).collect();
        place.moving.retain(|s| !resting.contains(s));
        place
    }

    fn restricted(&self, g: &Graph, e: Expr) -> Expr {
        short(g, g.substitute(e, &self.values))
    }

    /// The rates of the multipliers that are free, with what they contain of the others.
    fn rates(&self, cx: &Context<'_>, motion: &Motion) -> Rates {
        let g = &cx.system.graph;
        let r = motion.multipliers.len();
        let given = |m: usize| self.tied.iter().find(|(l, _)| *l == m);
        let transport = |row: &Vec<Expr>, l: usize| {
            let mut parts = Vec::new();
            for (m, &coefficient) in row.iter().enumerate() {
                match given(m) {
                    Some((_, condition)) if l != m => {
                        let tie = condition.coefficients[l];
                        parts.push(g.neg(g.mul(&[coefficient, tie])));
                    }
                    None if l == m => parts.push(coefficient),
                    _ => {}
                }
            }
            self.restricted(g, g.add(&parts))
        };
        let multiplier = |row: &Vec<Expr>, lambda: Expr| {
            let known = self.tied.iter();
            let known = known.map(|(m, condition)| g.neg(g.mul(&[row[*m], condition.right])));
            let all: Vec<Expr> = std::iter::once(lambda).chain(known).collect();
            self.restricted(g, g.add(&all))
        };
        let rows = motion.transport.iter();
        let momenta = (0..r).map(|l| self.momentum((cx, motion), l, true));
        Rates {
            transport: rows
                .clone()
                .map(|row| (0..r).map(|l| transport(row, l)).collect())
                .collect(),
            multipliers: rows
                .zip(&motion.multipliers)
                .map(|(row, &lambda)| multiplier(row, lambda))
                .collect(),
            momenta: momenta.collect(),
            free: (0..r).filter(|&l| given(l).is_none()).collect(),
        }
    }

    /// θ of the dependent velocity of a constraint: the multiplier −κ of Suslov's form, divided by ∂f/∂v for that of f as it is written.
    fn momentum(
        &self,
        (cx, motion): (&Context<'_>, &Motion),
        l: usize,
        divided: bool,
    ) -> Option<Expr> {
        let (system, g) = (cx.system, &cx.system.graph);
        let d = *cx.selection.dependent.get(l)?;
        let slope = *basis(cx).jacobian().get(l)?.get(d)?;
        let slope = self.restricted(g, motion.on_states(g, slope));
        if g.is_zero(slope) {
            return None;
        }
        let theta = g.diff(system.lagrangian, system.coordinates[d].v_symbol);
        let theta = self.restricted(g, motion.on_states(g, theta));
        Some(match divided {
            true => short(g, g.div(theta, slope)),
            false => theta,
        })
    }

    /// With the multipliers that are given by free ones.
    fn tied(&self, cx: &Context<'_>, mut found: Vec<Option<Expr>>) -> Vec<Option<Expr>> {
        let g = &cx.system.graph;
        for (l, condition) in &self.tied {
            let others = condition.coefficients.iter().zip(&found).enumerate();
            let others = others.filter(|(m, (c, _))| m != l && !g.is_zero(**c));
            let parts = others.map(|(_, (&c, value))| Some(g.neg(g.mul(&[c, (*value)?]))));
            let parts: Option<Vec<Expr>> = parts.collect();
            let value = parts.map(|mut parts| {
                parts.push(condition.right);
                simple(g, self.restricted(g, g.add(&parts)))
            });
            found[*l] = value;
        }
        found
    }
}

/// Multipliers whose rates are `Φ κ − λ`.
struct Rates {
    /// Φ, row by row.
    transport: Vec<Vec<Expr>>,
    /// λ.
    multipliers: Vec<Expr>,
    /// Momenta whose rates may differ by a constant from those of −κ.
    momenta: Vec<Option<Expr>>,
    /// The places of the multipliers that are integrated.
    free: Vec<usize>,
}

impl Rates {
    /// One multiplier after the other, each once all those are known that its rate contains.
    fn integrated(&self, cx: &Context<'_>, motion: &Motion, place: &Place) -> Vec<Option<Expr>> {
        let (system, g) = (cx.system, &cx.system.graph);
        let r = self.multipliers.len();
        let basis = basis(cx);
        let names = basis.constraint_names().into_iter();
        let constants: Vec<Expr> = names.map(|name| free_constant(system, g, name)).collect();
        let mut known: Vec<Option<Expr>> = vec![None; r];
        let next = |known: &[Option<Expr>]| {
            let mut unknown = self.free.iter().filter(|&&l| known[l].is_none());
            unknown.find_map(|&l| {
                let value = self.one((cx, motion, place), (known, &constants), l)?;
                Some((l, value))
            })
        };
        while let Some((l, value)) = next(&known) {
            known[l] = Some(value);
        }
        known
    }

    /// κ_l, from those that are known and their constants of integration.
    fn one(
        &self,
        (cx, motion, place): (&Context<'_>, &Motion, &Place),
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
        let momentum = self.momenta[l];
        let of = |rate: Expr| antiderivative((cx, motion, place), momentum, rate);
        let mut parts = vec![constants[l], of(free(rate))?];
        for (&symbol, slope) in symbols.iter().zip(slopes) {
            let weight = of(free(slope))?;
            parts.push(g.mul(&[g.symbol_expr(symbol), weight]));
        }
        Some(simple(g, g.add(&parts)))
    }
}

/// κ by the multipliers of f solved for the dependent velocities: `κ̂ = S κ` with `S_ml = ∂f^l/∂v_m` has
/// `κ̂' = (DS + S Φ) S⁻¹ κ̂ − S λ`, and S Φ = −DS where no f contains a dependent coordinate.
fn by_slopes(cx: &Context<'_>, motion: &Motion, place: &Place) -> Option<Vec<Option<Expr>>> {
    let g = &cx.system.graph;
    if !place.tied.is_empty() {
        return None;
    }
    let slopes = slopes(cx, motion)?;
    let (back, r) = (inverse(g, &slopes).ok()?, slopes.len());
    let turned = |m: usize, l: usize| {
        let column = motion.transport.iter().map(|row| &row[l]);
        g.add(&[motion.along(cx, slopes[m][l]), dot(g, &slopes[m], column)])
    };
    let entry = |m: usize, l: usize| {
        let parts: Vec<Expr> = (0..r).map(|n| g.mul(&[turned(m, n), back[n][l]])).collect();
        closed(g, g.substitute(g.add(&parts), &place.values)).ok()
    };
    let transport = (0..r).map(|m| (0..r).map(|l| entry(m, l)).collect());
    let multipliers = slopes.iter().map(|row| dot(g, row, &motion.multipliers));
    let solved = Rates {
        transport: transport.collect::<Option<_>>()?,
        multipliers: multipliers.map(|e| place.restricted(g, e)).collect(),
        momenta: (0..r)
            .map(|l| place.momentum((cx, motion), l, false))
            .collect(),
        free: (0..r).collect(),
    };
    let known = solved.integrated(cx, motion, place);
    let value = |row: &Vec<Expr>| {
        let used = row
            .iter()
            .zip(&known)
            .filter(|(&weight, _)| !g.is_zero(weight));
        let parts = used.map(|(&weight, known)| Some(g.mul(&[weight, (*known)?])));
        let parts: Vec<Expr> = parts.collect::<Option<_>>()?;
        closed(g, g.substitute(g.add(&parts), &place.values)).ok()
    };
    Some(back.iter().map(value).collect())
}

/// S, row by row; `None` where there are not as many dependent velocities as constraints.
fn slopes(cx: &Context<'_>, motion: &Motion) -> Option<Vec<Vec<Expr>>> {
    let (g, jacobian) = (&cx.system.graph, basis(cx).jacobian());
    let r = motion.multipliers.len();
    let dependent = &cx.selection.dependent;
    if dependent.len() != r || jacobian.len() != r {
        return None;
    }
    let row = |&d: &usize| {
        let column = jacobian.iter();
        column.map(|row| motion.on_states(g, row[d])).collect()
    };
    Some(dependent.iter().map(row).collect())
}

/// A function whose rate along all motions is the given one: a constant multiple of a function at hand (the roots in the
/// constraints, the momenta of the dependent velocities, velocities, coordinates and the time), or of `θ` and the time, where
/// `D(κ + θ) = ∂L/∂q` is constant (T1 (13')).
fn antiderivative(
    (cx, motion, place): (&Context<'_>, &Motion, &Place),
    theta: Option<Expr>,
    rate: Expr,
) -> Option<Expr> {
    let g = &cx.system.graph;
    let rate = simple(g, rate);
    if g.is_zero(rate) {
        return Some(g.zero());
    }
    let moved = |e: Expr| simple(g, place.restricted(g, motion.along(cx, e)));
    for candidate in candidates(cx, motion, theta) {
        let candidate = place.restricted(g, candidate);
        let moved = moved(candidate);
        if g.is_zero(moved) {
            continue;
        }
        let ratio = simple(g, g.div(rate, moved));
        if !g.contains_any(ratio, &place.moving) {
            return Some(g.mul(&[ratio, candidate]));
        }
    }
    let theta = theta?;
    let rest = simple(g, g.add(&[rate, moved(theta)]));
    let value = g.add(&[g.neg(theta), g.mul(&[rest, g.symbol("t", 0)])]);
    (!g.contains_any(rest, &place.moving)).then_some(value)
}

fn simple(g: &Graph, e: Expr) -> Expr {
    simplify::simplify(g, e, &simplify::Options::default())
}

/// The constant of integration of κ of a constraint.
pub(crate) fn free_constant(system: &System, g: &Graph, constraint: &str) -> Expr {
    g.symbol(&unused_name(system, &format!("const_{constraint}")), 0)
}

/// Functions whose rates may be proportional to λ.
fn candidates(cx: &Context<'_>, motion: &Motion, theta: Option<Expr>) -> Vec<Expr> {
    let (system, g) = (cx.system, &cx.system.graph);
    let mut list: Vec<Expr> = g
        .reachable(&basis(cx).constraints())
        .into_iter()
        .filter(|&e| matches!(g.node(e), Node::Power { exponent, .. } if g.as_integer(*exponent).is_none()))
        .map(|e| motion.on_states(g, e))
        .collect();
    list.extend(theta);
    list.extend(motion.speeds.iter().map(|&s| g.symbol_expr(s)));
    list.extend(system.coordinates.iter().map(|c| motion.on_states(g, c.v)));
    list.extend(system.coordinates.iter().map(|c| c.q));
    list.push(g.symbol("t", 0));
    list
}
