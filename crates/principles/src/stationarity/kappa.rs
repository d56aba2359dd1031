//! Multipliers that the conditions leave free, in closed form: `κ' = Φ κ − λ` integrated along the motion.

mod modulo;
mod momenta;

use self::modulo::Ties;
use self::momenta::of_momenta;
use super::cases::Leaf;
use super::closed_form::{closed, short};
use super::closure::{Closure, Condition};
use super::motion::Motion;
use chetaev_mechanics::claims::formulation::{basis, derive, manifold, REFERENCE};
use chetaev_mechanics::claims::Context;
use chetaev_mechanics::equations::unused_name;
use chetaev_mechanics::formulations::DeriveError;
use chetaev_mechanics::linear::dot;
use chetaev_mechanics::System;
use chetaev_symbolic::factors::factored;
use chetaev_symbolic::matrix::inverse;
use chetaev_symbolic::{simplify, Expr, Graph, Node, Symbol, Verdict};

/// Of longer functions no normal form is made, and no combination of momenta is looked for.
const LONGEST: u64 = 400;

/// κ of the constraints in closed form along all motions, those that the conditions leave free each with its constant of integration;
/// `None` for those that are not found. All were proved to make the motions extremals, where all are found.
pub(crate) fn integrated(
    cx: &Context<'_>,
    motion: &Motion,
    closure: &Closure,
) -> Vec<Option<Expr>> {
    let Some(place) = Place::with_conditions(cx, motion, closure) else {
        return vec![None; motion.multipliers.len()];
    };
    let found = along(cx, motion, &place);
    let values: Option<Vec<Expr>> = found.iter().copied().collect();
    match values.is_none_or(|values| are_extremals(cx, motion, &values)) {
        true => found,
        false => vec![None; found.len()],
    }
}

/// Whether κ, functions of the state of the motion and the time, satisfy (12) and (13) on all states.
fn are_extremals(cx: &Context<'_>, motion: &Motion, kappa: &[Expr]) -> bool {
    let residuals = residuals(cx, motion, kappa);
    let verdict = cx.prover.identity(cx.system, &residuals, &manifold(cx), "");
    matches!(verdict, Verdict::Proved(_))
}

/// `κ' − Φ κ + λ` and the left sides of (12).
fn residuals(cx: &Context<'_>, motion: &Motion, kappa: &[Expr]) -> Vec<Expr> {
    let g = &cx.system.graph;
    let demanded = motion.transport.iter().zip(&motion.multipliers);
    let rates = kappa.iter().zip(demanded).map(|(&value, (row, &lambda))| {
        let demanded = g.sub(dot(g, row, kappa), lambda);
        g.sub(motion.along(cx, value), demanded)
    });
    let conditions = motion.conditions.iter().map(|row| dot(g, row, kappa));
    rates.chain(conditions).collect()
}

/// `D(p + Σ κ ∂f/∂v) − ∂L/∂q − Σ κ ∂f/∂q` along the motion, for κ as functions of (q, v, t).
///
/// # Errors
/// [`DeriveError`] where the equations of motion are not derived.
pub(crate) fn extremal_residuals(
    cx: &Context<'_>,
    kappa: &[Expr],
) -> Result<Vec<Expr>, DeriveError> {
    let (system, g) = (cx.system, &cx.system.graph);
    let routh = derive(cx, REFERENCE)?;
    let coordinates = system.coordinates.iter().map(|c| c.a);
    let motion: Vec<(Expr, Expr)> = coordinates.zip(routh.accelerations).collect();
    let basis = basis(cx);
    let momenta = g.gradient(system.lagrangian, &system.velocity_symbols());
    let slopes = g.gradient(system.lagrangian, &system.coordinate_symbols());
    let by_velocities = basis.jacobian();
    let by_coordinates = g.jacobian(&basis.constraints(), &system.coordinate_symbols());
    let with = |own: Expr, rows: &[Vec<Expr>], i: usize| {
        let terms = kappa.iter().zip(rows);
        let parts = terms.map(|(&k, row)| g.mul(&[k, row[i]]));
        g.add(&parts.chain([own]).collect::<Vec<Expr>>())
    };
    let residual = |i: usize| {
        let moved = system.total_derivative(with(momenta[i], &by_velocities, i));
        let slope = with(slopes[i], &by_coordinates, i);
        g.sub(g.substitute(moved, &motion), slope)
    };
    Ok((0..system.n()).map(residual).collect())
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
    let residuals = residuals(cx, motion, kappa).into_iter();
    residuals
        .map(|e| place.restricted(g, e))
        .all(|e| g.is_zero(e))
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
    /// Constraints that stay implicit.
    ties: Ties,
}

impl Place {
    fn anywhere(cx: &Context<'_>, motion: &Motion) -> Place {
        let mut moving = motion.state();
        moving.push(cx.system.graph.intern_symbol("t", 0));
        Place {
            values: Vec::new(),
            moving,
            tied: Vec::new(),
            ties: Ties::new(cx, motion),
        }
    }

    /// Along all motions, where conditions tie some multipliers to the others; `None` where these are not had in closed form.
    fn with_conditions(cx: &Context<'_>, motion: &Motion, closure: &Closure) -> Option<Place> {
        let g = &cx.system.graph;
        let mut place = Place::anywhere(cx, motion);
        for (l, condition) in closure.solved(cx).ok()? {
            let on = |e: Expr| closed(g, motion.on_states(g, e)).ok();
            let coefficients = condition.coefficients.into_iter().map(on);
            place.tied.push((
                l,
                Condition {
                    coefficients: coefficients.collect::<Option<_>>()?,
                    right: on(condition.right)?,
                },
            ));
        }
        Some(place)
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
        self.ties.reduced(g, g.substitute(e, &self.values))
    }

    /// An equal function on the states, simplified; by its normal form where it then contains nothing that moves.
    fn simple(&self, g: &Graph, e: Expr) -> Expr {
        let e = simple(g, self.ties.reduced(g, e));
        if self.rests(g, e) || simplify::length(g, e) > LONGEST {
            return e;
        }
        let product = factored(g, e).map(|parts| {
            let powers = parts.factors.iter().map(|&(f, n)| g.powi(f, n));
            let powers: Vec<Expr> = powers.collect();
            g.scale(&parts.coefficient, g.mul(&powers))
        });
        product.filter(|&e| self.rests(g, e)).unwrap_or(e)
    }

    /// Whether a function contains nothing that moves.
    fn rests(&self, g: &Graph, e: Expr) -> bool {
        !g.contains_any(e, &self.moving)
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
        let own = self.transport[l][l];
        // κ = μ c with μ' = Φ_ll μ.
        let factor = match g.is_zero(own) {
            true => g.one(),
            false => integrating_factor((cx, motion, place), own)?,
        };
        let mut rate = vec![g.neg(self.multipliers[l])];
        for (m, &coefficient) in self.transport[l].iter().enumerate() {
            if m != l && !g.is_zero(coefficient) {
                rate.push(g.mul(&[coefficient, known[m]?]));
            }
        }
        let rate = place.restricted(g, g.div(g.add(&rate), factor));
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
        Some(place.simple(g, g.mul(&[factor, g.add(&parts)])))
    }
}

/// μ with `μ' = a μ`: a power of one of the functions at hand.
fn integrating_factor(
    (cx, motion, place): (&Context<'_>, &Motion, &Place),
    a: Expr,
) -> Option<Expr> {
    let g = &cx.system.graph;
    // Dependent velocities do not vanish as easily as others.
    let dependent = cx.selection.dependent.iter();
    let dependent = dependent.map(|&d| motion.on_states(g, cx.system.coordinates[d].v));
    let mut all: Vec<Expr> = dependent.collect();
    all.extend(candidates(cx, motion, None));
    all.into_iter().find_map(|candidate| {
        let candidate = place.restricted(g, candidate);
        let moved = place.simple(g, place.restricted(g, motion.along(cx, candidate)));
        if g.is_zero(moved) {
            return None;
        }
        let power = place.simple(g, g.div(g.mul(&[a, candidate]), moved));
        place.rests(g, power).then(|| g.pow(candidate, power))
    })
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
        let value = closed(g, g.substitute(g.add(&parts), &place.values)).ok()?;
        Some(place.simple(g, value))
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
/// `D(κ + θ) = ∂L/∂q` is constant (T1 (13')); or a polynomial in the time, where the rate or its own rate is constant along the motions.
/// Also a combination of momenta and coordinates, and of a sum what belongs to each term.
fn antiderivative(
    (cx, motion, place): (&Context<'_>, &Motion, &Place),
    theta: Option<Expr>,
    rate: Expr,
) -> Option<Expr> {
    let g = &cx.system.graph;
    let rate = place.simple(g, rate);
    let whole = of_one_function((cx, motion, place), theta, rate);
    let whole = whole.or_else(|| of_momenta((cx, motion, place), rate));
    whole.or_else(|| {
        let Node::Sum { constant, terms } = g.node(rate) else {
            return None;
        };
        let number = g.scale(constant, g.one());
        let terms = terms.iter().map(|(e, c)| g.scale(c, *e)).chain([number]);
        let parts = terms.map(|e| of_one_function((cx, motion, place), None, e));
        Some(g.add(&parts.collect::<Option<Vec<Expr>>>()?))
    })
}

/// [`antiderivative`] of what is not taken apart.
fn of_one_function(
    (cx, motion, place): (&Context<'_>, &Motion, &Place),
    theta: Option<Expr>,
    rate: Expr,
) -> Option<Expr> {
    let g = &cx.system.graph;
    if g.is_zero(rate) {
        return Some(g.zero());
    }
    let moved = |e: Expr| place.simple(g, place.restricted(g, motion.along(cx, e)));
    for candidate in candidates(cx, motion, theta) {
        let candidate = place.restricted(g, candidate);
        let moved = moved(candidate);
        if g.is_zero(moved) {
            continue;
        }
        let ratio = place.simple(g, g.div(rate, moved));
        if place.rests(g, ratio) {
            return Some(g.mul(&[ratio, candidate]));
        }
    }
    let time = g.symbol("t", 0);
    if let Some(theta) = theta {
        let rest = place.simple(g, g.add(&[rate, moved(theta)]));
        if place.rests(g, rest) {
            return Some(g.add(&[g.neg(theta), g.mul(&[rest, time])]));
        }
    }
    // D(R t − ½ R' t²) = R + R' t − R' t, where R'' = 0.
    let second = moved(rate);
    let half = g.div(g.mul(&[second, time, time]), g.integer(2));
    g.is_zero(moved(second))
        .then(|| g.sub(g.mul(&[rate, time]), half))
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
