//! The set on which a system lives, for questions about its motion: all constraints hold, positions included; and numbers there.

use super::formulation::manifold;
use super::Context;
use crate::characteristics::Manifold;
use crate::constraint::ConstraintKind;
use crate::positions;
use crate::sample::radicands;
use crate::system::System;
use chetaev_symbolic::factors::factored;
use chetaev_symbolic::simplify::{closed_form, length, Options};
use chetaev_symbolic::verdict::{Counterexample, PointValue, Proof};
use chetaev_symbolic::{Expr, Function, Graph, Node, Symbol, Verdict};
use std::collections::BTreeMap;

/// Admissible velocities at positions that satisfy the holonomic constraints; each of these determines the coordinate whose
/// velocity its derivative determines.
pub fn constraint_set(cx: &Context<'_>) -> Manifold {
    let (system, g) = (cx.system, &cx.system.graph);
    let mut set = manifold(cx);
    let stated = cx.terms.constraint_index.iter().enumerate();
    let is_finite =
        |(_, l): &(usize, &usize)| system.constraints[**l].kind == ConstraintKind::Holonomic;
    let finite: Vec<usize> = stated.filter(is_finite).map(|(row, _)| row).collect();
    // One that is left out as its derivative follows from other constraints restricts the positions all the same.
    let is_left_out = |row: &usize| !cx.selection.rows.contains(row);
    if finite.len() > 1 || finite.iter().any(is_left_out) {
        let positions = cx.shared(|_| positions::of(system, cx.terms, cx.selection));
        return positions.joined(&set);
    }
    let pairs = cx.selection.rows.iter().zip(&cx.selection.dependent);
    for (&row, &dependent) in pairs {
        let constraint = &system.constraints[cx.terms.constraint_index[row]];
        if constraint.kind != ConstraintKind::Holonomic {
            continue;
        }
        let coordinate = &system.coordinates[dependent];
        let (stated, symbol) = (constraint.stated, coordinate.q_symbol);
        let slope = g.diff(stated, symbol);
        if g.as_number(slope).is_some() {
            let rest = g.substitute(stated, &[(coordinate.q, g.zero())]);
            let value = g.neg(g.div(rest, slope));
            set.solved.push((symbol, value));
        } else {
            set.implicit.push((stated, symbol))
        }
    }
    set
}

/// Decides whether functions with names vanish on the constraint set: wherever the velocities are admissible, whatever the constants
/// of the holonomic constraints, or at the positions stated.
pub fn vanish(cx: &Context<'_>, residuals: &[(String, Expr)], values: &[(Expr, Expr)]) -> Verdict {
    let g = &cx.system.graph;
    let residuals: Vec<(String, Expr)> = residuals
        .iter()
        .map(|(name, e)| (name.clone(), g.substitute(*e, values)))
        .collect();
    let on = if cx.terms.constraints.is_empty() {
        "everywhere outside the singular set of the mass matrix"
    } else {
        "on the constraint set outside the singular set of the linear systems"
    };
    let decide = |manifold: &Manifold, residuals: &[(String, Expr)]| {
        let manifold = manifold.substituted(g, values);
        cx.prover
            .named_identity(cx.system, residuals, &manifold, on)
    };
    let (wide, set) = (manifold(cx), constraint_set(cx));
    let is_wide =
        (set.solved.len(), set.implicit.len()) == (wide.solved.len(), wide.implicit.len());
    match decide(&wide, &residuals) {
        verdict if is_wide => verdict,
        Verdict::Proved(proof) => Verdict::Proved(proof),
        _ => decide(&set, &with_constant_radicands(cx, &residuals)),
    }
}

/// Radicands that a holonomic constraint makes constant, as x² + y² where it is l², are written as these constants: their roots have
/// one sign then.
fn with_constant_radicands(cx: &Context<'_>, residuals: &[(String, Expr)]) -> Vec<(String, Expr)> {
    let (system, g) = (cx.system, &cx.system.graph);
    let moves = |s: Symbol| system.moves(g.symbol_name(s));
    let (names, es): (Vec<String>, Vec<Expr>) = residuals.iter().cloned().unzip();
    let holonomic = system.constraints.iter();
    let holonomic = holonomic.filter(|c| c.kind == ConstraintKind::Holonomic);
    let stated: Vec<Expr> = holonomic.map(|c| c.stated).collect();
    let es = g.substitute_all(&es, &of_polar_angles(g, &es));
    let constant = |base: Expr| {
        let forms = stated
            .iter()
            .flat_map(|&f| [g.sub(base, f), g.add(&[base, f])]);
        let mut forms = forms.filter(|&e| g.is_free_of(e, &moves));
        Some((base, forms.next()?))
    };
    let radicands = radicands(g, &es).into_iter();
    let constants: Vec<(Expr, Expr)> = radicands.filter_map(constant).collect();
    names
        .into_iter()
        .zip(g.substitute_all(&es, &constants))
        .collect()
}

/// Sines and cosines of polar angles, with the radius written out.
fn of_polar_angles(g: &Graph, es: &[Expr]) -> Vec<(Expr, Expr)> {
    let applied = |e: Expr| match g.node(e) {
        Node::Apply {
            function,
            arguments,
        } => Some((*function, arguments.to_vec())),
        _ => None,
    };
    let written = |e: Expr| {
        let (function, arguments) = applied(e)?;
        let (Function::Atan2, sides) = applied(*arguments.first()?)? else {
            return None;
        };
        let [across, along] = sides[..] else {
            return None;
        };
        let radius = g.sqrt(g.add(&[g.powi(across, 2), g.powi(along, 2)]));
        match function {
            Function::Sin => Some((e, g.div(across, radius))),
            Function::Cos => Some((e, g.div(along, radius))),
            _ => None,
        }
    };
    g.reachable(es).into_iter().filter_map(written).collect()
}

/// Whether functions with names vanish on the constraint set: for general parameters, with those that the model defines by others or
/// states to be zero, or for all values that it states. `what` says what it means that they do.
pub fn hold(cx: &Context<'_>, residuals: &[(String, Expr)], what: &str) -> Verdict {
    let (system, g) = (cx.system, &cx.system.graph);
    let general = vanish(cx, residuals, &[]);
    let Verdict::Refuted(found) = general else {
        return general;
    };
    if system.has_varying_masses() {
        return Verdict::Refuted(found);
    }
    let es: Vec<Expr> = residuals.iter().map(|(_, e)| *e).collect();
    let occurring = g.reachable(&es);
    let texts = |values: &[(Expr, Expr)]| {
        let own = values.iter().filter(|(s, _)| occurring.contains(s));
        let texts = own.map(|&(s, e)| format!("{} = {}", g.text(s), g.text(e)));
        texts.collect::<Vec<String>>().join(", ")
    };
    let stated = system.stated_values();
    if !stated.is_empty() {
        if let Verdict::Proved(proof) = vanish(cx, residuals, &stated) {
            let sentence = format!("with {}, as the model states it", texts(&stated));
            return Verdict::Proved(proof).prefixed(&sentence);
        }
    }
    let values = system.parameter_values();
    if !values.is_empty() {
        if let Verdict::Proved(proof) = vanish(cx, residuals, &values) {
            let detail = format!(
                "for the values that the model states, {what}; for other parameters not; {}",
                proof.detail
            );
            return Verdict::Conditional {
                condition: condition(cx, residuals, &values).unwrap_or_else(|| texts(&values)),
                proof: Proof { detail, ..proof },
                counterexample: Some(found),
            };
        }
    }
    Verdict::Refuted(found)
}

/// An equation of the parameters that makes all residuals vanish, and that the values stated satisfy.
fn condition(
    cx: &Context<'_>,
    residuals: &[(String, Expr)],
    values: &[(Expr, Expr)],
) -> Option<String> {
    let (system, g) = (cx.system, &cx.system.graph);
    let moves = |s: Symbol| system.moves(g.symbol_name(s)) || g.symbol_name(s) == "t";
    let mut conditions: Vec<String> = Vec::new();
    for (_, residual) in residuals {
        let e = short(cx, *residual)?;
        if g.is_zero(e) {
            continue;
        }
        let parts = factored(g, e)?;
        let vanishing = parts.factors.iter().find(|(f, power)| {
            *power > 0 && g.is_free_of(*f, &moves) && g.is_zero(g.substitute(*f, values))
        });
        let text = format!("{} = 0", g.text(vanishing?.0));
        if !conditions.contains(&text) {
            conditions.push(text);
        }
    }
    Some(conditions.join(", "))
}

/// A function of the state on the constraint set in short form, without linear systems.
pub fn short(cx: &Context<'_>, e: Expr) -> Option<Expr> {
    let g = &cx.system.graph;
    let options = Options::default();
    let solved = constraint_set(cx).solved.into_iter();
    let solved: Vec<(Expr, Expr)> = solved.map(|(s, e)| (g.symbol_expr(s), e)).collect();
    let candidates = [e, g.substitute(e, &solved)].into_iter();
    let forms = candidates.filter_map(|e| closed_form(g, e, &options));
    forms.min_by_key(|&e| length(g, e))
}

/// The state of a counterexample in numbers, completed by what the model states of parameters and by 1 where that is nothing;
/// `None` where it does not satisfy the constraints then.
#[derive(Clone, Debug)]
pub struct State<'a> {
    system: &'a System,
    set: Manifold,
    values: BTreeMap<Symbol, f64>,
}

impl<'a> State<'a> {
    /// The state at which something was refuted.
    pub fn of(cx: &Context<'a>, found: &Counterexample) -> Option<State<'a>> {
        let (system, g) = (cx.system, &cx.system.graph);
        let mut values = BTreeMap::new();
        for point in &found.point {
            let (name, order) = name_and_order(&point.name);
            values.insert(g.intern_symbol(name, order), number(point)?);
        }
        for parameter in &system.parameters {
            let known = parameter.value.and_then(|value| {
                let found = g.evaluate_f64(&[value], &|_| None).ok()?;
                found.first().copied()
            });
            if let Some(symbol) = g.as_symbol(parameter.expr) {
                values.entry(symbol).or_insert(known.unwrap_or(1.0));
            }
        }
        let state = State {
            system,
            set: constraint_set(cx),
            values,
        };
        let tied: Vec<Expr> = state.set.implicit.iter().map(|(f, _)| *f).collect();
        let residuals = state.evaluate(&tied)?;
        residuals.iter().all(|x| x.abs() < 1e-6).then_some(state)
    }

    /// Functions of the state.
    pub fn evaluate(&self, es: &[Expr]) -> Option<Vec<f64>> {
        let g = &self.system.graph;
        let solved: Vec<(Expr, Expr)> = self
            .set
            .solved
            .iter()
            .map(|&(symbol, e)| (g.symbol_expr(symbol), e))
            .collect();
        // What is solved for may contain others that are.
        let es = (0..2).fold(es.to_vec(), |es, _| g.substitute_all(&es, &solved));
        let value = |s: Symbol| Some(self.values.get(&s).copied().unwrap_or(1.0));
        let found = g.evaluate_f64(&es, &value).ok()?;
        found.iter().all(|x| x.is_finite()).then_some(found)
    }
}

fn name_and_order(text: &str) -> (&str, u32) {
    let name = text.trim_end_matches('\'');
    (name, (text.len() - name.len()) as u32)
}

fn number(point: &PointValue) -> Option<f64> {
    if let Some(exact) = &point.exact {
        let text = exact.to_string();
        return match text.split_once('/') {
            Some((p, q)) => Some(p.parse::<f64>().ok()? / q.parse::<f64>().ok()?),
            None => text.parse().ok(),
        };
    }
    let (low, high) = point.enclosure.as_ref()?;
    Some((low.parse::<f64>().ok()? + high.parse::<f64>().ok()?) / 2.0)
}
