//! A model lowered to what its motion depends on: one model file with coordinates, L, Q and constraints, families and includes
//! expanded, particles, Rayleigh's function and units gone into them.
//!
//! Whoever checks a record needs to read no more than this text.

use chetaev_mechanics::system::Relation;
use chetaev_mechanics::System;
use chetaev_model::model::{MassLaw, Model};
use chetaev_symbolic::print::{Document, Format, Options, Parts};
use chetaev_symbolic::{Expr, Graph, Node};
use std::fmt::Write as _;

/// The lowered model as a model file; `None` where a mass contains velocities, since the equations then follow from the law of
/// the particles and from no Lagrangian.
pub fn flat(model: &Model, system: &System) -> Option<String> {
    let g = &system.graph;
    let accelerations: Vec<_> = system.coordinates.iter().map(|c| c.a_symbol).collect();
    if system
        .reactive_forces
        .iter()
        .any(|&force| g.contains_any(force, &accelerations))
    {
        return None;
    }
    let parts = Lowered::new(system);
    let mut text = String::new();
    line(&mut text, "name", &quoted(&system.name));
    let names = system.coordinates.iter().map(|c| quoted(&c.name));
    line(&mut text, "coordinates", &array(names));
    let assumed = system.assumptions.iter().map(|a| {
        let relation = match a.relation {
            Relation::Less => "<",
            Relation::LessOrEqual => "<=",
            Relation::NotEqual => "!=",
        };
        quoted(&format!(
            "{} {relation} {}",
            g.text(a.left),
            g.text(a.right)
        ))
    });
    line(&mut text, "assumptions", &array(assumed));
    parameters(&mut text, model);
    let controls = model.controls.iter().map(|u| {
        let law = u.law.map_or("{}".to_owned(), |law| quoted(&g.text(law)));
        (u.name.clone(), law)
    });
    table(&mut text, "controls", controls);
    let masses = model.masses.iter().filter_map(|m| match &m.law {
        MassLaw::Rate { initial, .. } => {
            let rate = model.mass_rate(&m.name)?;
            let (rate, initial) = (quoted(&g.text(rate)), quoted(&g.text(*initial)));
            Some((
                m.name.clone(),
                format!("{{ rate = {rate}, initial = {initial} }}"),
            ))
        }
        MassLaw::Value(_) => None,
    });
    table(&mut text, "masses", masses);
    let definitions = parts.text.definitions.iter().filter_map(|own| {
        let (name, value) = own.split_once(" = ")?;
        Some((name.to_owned(), quoted(value)))
    });
    table(&mut text, "define", definitions);
    for (heading, entries) in parts.tables() {
        table(&mut text, heading, entries.into_iter());
    }
    Some(text)
}

/// The expressions of a lowered model, printed together.
struct Lowered {
    /// For each statement its table and key.
    places: Vec<(&'static str, String)>,
    text: Parts,
}

impl Lowered {
    fn new(system: &System) -> Lowered {
        let g = &system.graph;
        let mut places = vec![("lagrangian", "L".to_owned())];
        let mut roots = vec![system.lagrangian];
        let mut add = |table, key: &str, e: Expr| {
            places.push((table, key.to_owned()));
            roots.push(e);
        };
        // Reactive forces are among the forces. Where masses with a law of their own stay names, they are stated apart.
        let apart = !system.masses.is_empty();
        for (i, c) in system.coordinates.iter().enumerate() {
            let (force, reactive) = (system.forces[i], system.reactive_forces[i]);
            let force = if apart { g.sub(force, reactive) } else { force };
            if !g.is_zero(force) {
                add("forces", &c.name, force);
            }
            if apart {
                add("reactive_forces", &c.name, reactive);
            }
        }
        for constraint in &system.constraints {
            add("constraints", &constraint.name, constraint.stated);
        }
        for u in &system.quasi_velocities {
            if !has_solve(g, u.definition) {
                add("quasi_velocities", &u.name, u.definition);
            }
        }
        let everywhere = |name: &str| !(system.integral_conditions.iter()).any(|c| c.0 == name);
        for (name, value) in &system.integrals {
            if everywhere(name) {
                add("integrals", name, *value);
            }
        }
        let text = Document::expressions(g, &roots, &options(system)).parts(Format::Text);
        Lowered { places, text }
    }

    /// The tables of a model file with their entries, in the order in which they begin.
    fn tables(&self) -> Vec<(&'static str, Vec<(String, String)>)> {
        let mut tables: Vec<(&'static str, Vec<(String, String)>)> = Vec::new();
        for ((heading, key), value) in self.places.iter().zip(&self.text.statements) {
            let value = match *heading {
                "constraints" => quoted(&format!("{value} = 0")),
                _ => quoted(value),
            };
            match tables.iter_mut().find(|(known, _)| known == heading) {
                Some((_, entries)) => entries.push((key.clone(), value)),
                None => tables.push((heading, vec![(key.clone(), value)])),
            }
        }
        tables
    }
}

/// How formulas of a record are printed: names that the system has are not given to shared parts.
pub(crate) fn options(system: &System) -> Options {
    let mut parameters: Vec<String> = system.parameters.iter().map(|p| p.name.clone()).collect();
    parameters.extend(system.quasi_velocities.iter().map(|u| u.name.clone()));
    parameters.extend(system.controls.iter().map(|u| u.name.clone()));
    Options {
        coordinates: system.coordinates.iter().map(|c| c.name.clone()).collect(),
        parameters,
        ..Options::default()
    }
}

/// Whether a linear system stands in an expression, which no text of one line gives.
fn has_solve(g: &Graph, e: Expr) -> bool {
    let mut nodes = g.reachable(&[e]).into_iter();
    nodes.any(|e| matches!(g.node(e), Node::Solve { .. }))
}

fn parameters(text: &mut String, model: &Model) {
    let g = &model.graph;
    let entries = model.parameters.iter().map(|p| {
        let stated = p.definition.or(p.value);
        let mut fields = Vec::new();
        fields.extend(stated.map(|e| format!("value = {}", quoted(&g.text(e)))));
        fields.extend(p.range.map(|(low, high)| {
            let ends = [low, high].map(|e| quoted(&g.text(e)));
            format!("range = {}", array(ends))
        }));
        (p.name.clone(), format!("{{ {} }}", fields.join(", ")))
    });
    table(text, "parameters", entries);
}

pub(crate) fn table(
    text: &mut String,
    heading: &str,
    entries: impl Iterator<Item = (String, String)>,
) {
    let entries: Vec<(String, String)> = entries.collect();
    if entries.is_empty() {
        return;
    }
    // Writing to a string cannot fail.
    let _ = writeln!(text, "\n[{heading}]");
    for (key, value) in entries {
        line(text, &quoted(&key), &value);
    }
}

pub(crate) fn line(text: &mut String, key: &str, value: &str) {
    let _ = writeln!(text, "{key} = {value}");
}

pub(crate) fn array(items: impl IntoIterator<Item = String>) -> String {
    let items: Vec<String> = items.into_iter().collect();
    format!("[{}]", items.join(", "))
}

/// A basic string of TOML.
pub(crate) fn quoted(text: &str) -> String {
    let mut out = String::with_capacity(text.len() + 2);
    out.push('"');
    for c in text.chars() {
        match c {
            '"' | '\\' => out.extend(['\\', c]),
            c if c.is_control() => {
                let _ = write!(out, "\\u{:04X}", u32::from(c));
            }
            c => out.push(c),
        }
    }
    out.push('"');
    out
}
