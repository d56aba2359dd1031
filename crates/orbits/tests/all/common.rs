//! Mechanical systems by their texts, and numbers that are near.
#![allow(
    clippy::unwrap_used,
    clippy::excessive_precision,
    reason = "test code fails where it stands, and has the digits of its sources"
)]

use chetaev_mechanics::{Prepared, System};
use chetaev_model::{load, Model};
use chetaev_orbits::flow::Coordinates;
use chetaev_orbits::Flow;
use chetaev_symbolic::{Expr, Symbol};
use std::collections::BTreeMap;

fn model(text: &str) -> Model {
    let text = format!("name = \"case\"\n{text}");
    let loaded = load("case.toml", &text, &BTreeMap::new(), &[]);
    let found = loaded.model;
    found.unwrap_or_else(|| panic!("{}", loaded.diagnostics))
}

/// The flow of a model at a state, and the reading of its expressions.
pub(crate) fn flow(text: &str, state: &[(&str, f64)]) -> (Flow, impl Fn(&str) -> Expr) {
    let model = model(text);
    let system = System::from_model(&model).unwrap();
    let prepared = Prepared::new(&system).unwrap();
    let symbol = |name: &str| {
        let order = name.chars().filter(|c| *c == '\'').count();
        system
            .graph
            .intern_symbol(name.trim_end_matches('\''), order as u32)
    };
    let mut point: Vec<(Symbol, f64)> = state.iter().map(|(name, x)| (symbol(name), *x)).collect();
    let values = system.parameters.iter().filter_map(|p| {
        let value = system.graph.evaluate_f64(&[p.value?], &|_| None).ok()?[0];
        Some((system.graph.as_symbol(p.expr)?, value))
    });
    point.extend(values);
    let (terms, selection) = (&prepared.terms, &prepared.selection);
    let which = (Coordinates::NotIgnorable, &point[..]);
    let flow = Flow::of_system(&system, terms, selection, which).unwrap();
    (flow, move |text: &str| model.expression(text).unwrap())
}

pub(crate) fn is_close(found: f64, expected: f64, tolerance: f64) {
    let error = (found - expected).abs() / (1.0 + expected.abs());
    assert!(
        error <= tolerance,
        "{found} instead of {expected}: {error:e}"
    );
}

/// The model of a text, as a system.
pub(crate) fn system(text: &str) -> (System, Prepared) {
    let model = model(text);
    let system = System::from_model(&model).unwrap();
    let prepared = Prepared::new(&system).unwrap();
    (system, prepared)
}
