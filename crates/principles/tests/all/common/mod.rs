//! Systems written as text, and numbers from them.

#![allow(clippy::unwrap_used)] // a panic is how a test fails

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

/// A system as text; every name that is no coordinate is a parameter.
pub(crate) struct Text {
    pub(crate) coordinates: &'static str,
    pub(crate) lagrangian: &'static str,
    pub(crate) forces: &'static [(&'static str, &'static str)],
    pub(crate) constraints: &'static [(&'static str, &'static str)],
}

pub(crate) fn system(text: &Text) -> System {
    let graph = Arc::new(Graph::new());
    let pairs = |stated: &[(&str, &str)]| -> Vec<(String, Expr)> {
        stated
            .iter()
            .map(|(name, e)| (name.to_string(), expr(&graph, e)))
            .collect()
    };
    let parts = SystemParts {
        name: "test".into(),
        coordinates: text
            .coordinates
            .split_whitespace()
            .map(String::from)
            .collect(),
        lagrangian: Some(expr(&graph, text.lagrangian)),
        forces: pairs(text.forces),
        constraints: pairs(text.constraints),
        ..SystemParts::default()
    };
    System::new(graph, parts).unwrap()
}

/// The finding of `id#subject` with the claims of mechanics and of this crate.
pub(crate) fn finding(system: &System, full: &str) -> Arc<Finding> {
    let prepared = Prepared::new(system).unwrap();
    let registry = Registry::new(&[
        chetaev_mechanics::claims::CLAIMS,
        chetaev_principles::CLAIMS,
    ]);
    let cx = Context::new(
        system,
        &prepared.terms,
        &prepared.selection,
        &registry,
        Prover::default(),
    );
    cx.finding(full)
}

/// A state on the constraint manifold.
pub(crate) fn admissible(system: &System, prepared: &Prepared, seed: u64) -> Point {
    sample::admissible_point(system, &prepared.terms, seed).unwrap()
}

pub(crate) fn values(g: &Graph, es: &[Expr], point: &Point) -> Vec<f64> {
    let value = |s: Symbol| point.get(&s).copied();
    g.evaluate_f64(es, &value).unwrap()
}

/// Systems of T1 §0.
pub(crate) mod worked {
    use super::Text;

    pub(crate) const fn text(
        coordinates: &'static str,
        lagrangian: &'static str,
        constraints: &'static [(&'static str, &'static str)],
    ) -> Text {
        Text {
            coordinates,
            lagrangian,
            forces: &[],
            constraints,
        }
    }

    /// S1, on an incline.
    pub(crate) const SKATE: Text = text(
        "x y phi",
        "m/2 (x'^2 + y'^2) + J/2 phi'^2 + m G x",
        &[("blade", "x' sin(phi) - y' cos(phi)")],
    );
    /// S1, level.
    pub(crate) const LEVEL_SKATE: Text = text(
        "x y phi",
        "m/2 (x'^2 + y'^2) + J/2 phi'^2",
        &[("blade", "x' sin(phi) - y' cos(phi)")],
    );
    /// S2.
    pub(crate) const DISC: Text = text(
        "theta phi x y",
        "I/2 theta'^2 + J/2 phi'^2 + m/2 (x'^2 + y'^2)",
        &[
            ("rolling_x", "x' - R cos(phi) theta'"),
            ("rolling_y", "y' - R sin(phi) theta'"),
        ],
    );
    /// S3.
    pub(crate) const CONE: Text = text(
        "x y z",
        "m/2 (x'^2 + y'^2 + z'^2) - m g z",
        &[("cone", "z' - a sqrt(x'^2 + y'^2)")],
    );
    /// S4.
    pub(crate) const PARTICLE: Text =
        text("x y z", "1/2 (x'^2 + y'^2 + z'^2)", &[("c", "z' - y x'")]);
    /// Holonomic in disguise.
    pub(crate) const INTEGRABLE: Text = text(
        "x y z",
        "m/2 (x'^2 + y'^2 + z'^2) - m g z",
        &[("c", "z' - y x' - x y'")],
    );
}

/// Looks at a system with the claims of mechanics and of this crate.
pub(crate) fn with_context<T>(system: &System, look: impl FnOnce(&Context<'_>) -> T) -> T {
    let prepared = Prepared::new(system).unwrap();
    let registry = Registry::new(&[
        chetaev_mechanics::claims::CLAIMS,
        chetaev_principles::CLAIMS,
    ]);
    let (terms, selection) = (&prepared.terms, &prepared.selection);
    let cx = Context::new(system, terms, selection, &registry, Prover::default());
    look(&cx)
}
