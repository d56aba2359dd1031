//! Systems written as text, and numbers from them.

#![allow(clippy::unwrap_used)] // a panic is how a test fails

use chetaev_geometry::noether::motion::Motion;
use chetaev_mechanics::claims::strata::{Grounds, Strata};
use chetaev_mechanics::claims::{Context, Finding};
use chetaev_mechanics::sample::{self, Point};
use chetaev_mechanics::{Prepared, Prover, Registry, System, SystemParts};
use chetaev_symbolic::syntax::{lower, parse_expression, Resolution, Scope};
use chetaev_symbolic::{Expr, Graph, Symbol};
use std::sync::Arc;

struct EveryName<'g>(&'g Graph);

impl Scope for EveryName<'_> {
    fn resolve(&self, name: &str, order: u32) -> Resolution {
        Resolution::Known(self.0.symbol(name, order))
    }
    fn names(&self) -> Vec<String> {
        Vec::new()
    }
}

pub(crate) fn expr(g: &Graph, text: &str) -> Expr {
    let parsed = parse_expression(text);
    let mut diagnostics = Vec::new();
    let scope = EveryName(g);
    let e = lower(
        g,
        &parsed.tree,
        parsed.root(),
        &scope,
        &[],
        &mut diagnostics,
    );
    assert!(!parsed.has_errors() && diagnostics.is_empty(), "{text}");
    e.unwrap()
}

/// Constraints as (name, f); every other name is a parameter.
pub(crate) fn system(coordinates: &str, lagrangian: &str, constraints: &[(&str, &str)]) -> System {
    let graph = Arc::new(Graph::new());
    let parts = SystemParts {
        name: "test".into(),
        coordinates: coordinates.split_whitespace().map(String::from).collect(),
        lagrangian: Some(expr(&graph, lagrangian)),
        constraints: constraints
            .iter()
            .map(|(name, f)| (name.to_string(), expr(&graph, f)))
            .collect(),
        ..SystemParts::default()
    };
    System::new(graph, parts).unwrap()
}

/// Unit masses in space under constraints.
pub(crate) fn in_space(constraints: &[(&str, &str)]) -> System {
    system("x y z", "(x'^2 + y'^2 + z'^2)/2", constraints)
}

/// The same with quasi-velocities and forces, by name.
pub(crate) fn framed(
    coordinates: &str,
    lagrangian: &str,
    constraints: &[(&str, &str)],
    speeds: &[(&str, &str)],
    forces: &[(&str, &str)],
) -> System {
    let graph = Arc::new(Graph::new());
    let named = |list: &[(&str, &str)]| -> Vec<(String, Expr)> {
        let pairs = list.iter();
        pairs
            .map(|(name, e)| (name.to_string(), expr(&graph, e)))
            .collect()
    };
    let parts = SystemParts {
        name: "test".into(),
        coordinates: coordinates.split_whitespace().map(String::from).collect(),
        lagrangian: Some(expr(&graph, lagrangian)),
        constraints: named(constraints),
        quasi_velocities: named(speeds),
        forces: named(forces),
        ..SystemParts::default()
    };
    System::new(graph, parts).unwrap()
}

/// What `ask` makes of a system with the claims of mechanics and of this crate.
pub(crate) fn with_context<T>(system: &System, ask: impl FnOnce(&Context<'_>) -> T) -> T {
    let prepared = Prepared::new(system).unwrap();
    let registry = Registry::new(&[chetaev_mechanics::claims::CLAIMS, chetaev_geometry::CLAIMS]);
    let (terms, selection) = (&prepared.terms, &prepared.selection);
    let cx = Context::new(system, terms, selection, &registry, Prover::default());
    ask(&cx)
}

/// The same with the motion X̄.
pub(crate) fn with_motion<T>(
    system: &System,
    ask: impl FnOnce(&Context<'_>, &Motion<'_>) -> T,
) -> T {
    with_context(system, |cx| ask(cx, &Motion::of(cx).unwrap()))
}

/// The finding of `id#subject`.
pub(crate) fn finding(system: &System, full: &str) -> Arc<Finding> {
    with_context(system, |cx| cx.finding(full))
}

/// The same on all parts on which the claim is asked.
pub(crate) fn asked(system: &System, full: &str) -> Finding {
    let registry = Registry::new(&[chetaev_mechanics::claims::CLAIMS, chetaev_geometry::CLAIMS]);
    let prepared = Prepared::new(system).unwrap();
    let grounds = Grounds::new(system, &prepared, &|_, _| None);
    let strata = Strata::new(&grounds, &registry, Prover::default, |cx| cx);
    let (id, subject) = full
        .split_once('#')
        .map_or((full, None), |(id, s)| (id, Some(s)));
    strata.finding(registry.find(id).unwrap(), subject)
}

/// A state on the constraint manifold.
pub(crate) fn admissible(system: &System, prepared: &Prepared, seed: u64) -> Point {
    sample::admissible_point(system, &prepared.terms, seed).unwrap()
}

/// An arbitrary state, the same for the same symbols and seed.
pub(crate) fn anywhere(g: &Graph, es: &[Expr], seed: u64) -> Point {
    let mut generator = sample::Generator::new(seed);
    g.symbols_in(es)
        .into_iter()
        .map(|s| (s, generator.between(0.3, 1.4)))
        .collect()
}

pub(crate) fn values(g: &Graph, es: &[Expr], point: &Point) -> Vec<f64> {
    let value = |s: Symbol| point.get(&s).copied();
    g.evaluate_f64(es, &value).unwrap()
}

pub(crate) fn largest(values: &[f64]) -> f64 {
    assert!(values.iter().all(|x| x.is_finite()), "{values:?}");
    values.iter().fold(0.0, |m: f64, x| m.max(x.abs()))
}
