//! Definitions that nothing uses are left out.

use std::collections::{BTreeMap, BTreeSet};

use super::objects::Kept;
use super::sections::Written;
use crate::raw::{Kind, Raw, Table};

/// Leaves out the written definitions that neither the written sections nor the user's own text names. Those that the objects name
/// are put aside with them.
pub(crate) fn prune(written: &mut Written, own: &Table, kept: &mut Kept) {
    let mut used: BTreeSet<String> = BTreeSet::new();
    words_of_table(own, &mut used);
    let tables = [
        &written.parameters,
        &written.constraints,
        &written.forces,
        &written.events,
        &written.sensors,
    ];
    for table in tables {
        words_of_table(table, &mut used);
    }
    let lists = [&written.assumptions, &written.elements, &written.power];
    for raw in lists.into_iter().flatten() {
        words_of(raw, &mut used);
    }
    for terms in [&written.kinetic, &written.potential, &written.dissipation] {
        terms.iter().for_each(|term| words(term, &mut used));
    }
    let defined: BTreeMap<String, Raw> = written
        .define
        .entries
        .iter()
        .map(|(key, raw)| (key.content.clone(), raw.clone()))
        .collect();
    close(&mut used, &defined);
    let mut named: BTreeSet<String> = BTreeSet::new();
    kept.texts().for_each(|text| words(text, &mut named));
    close(&mut named, &defined);
    let (used_ones, others) = std::mem::take(&mut written.define.entries)
        .into_iter()
        .partition(|(key, _)| used.contains(&key.content));
    written.define.entries = used_ones;
    kept.define.entries = others;
    kept.define
        .entries
        .retain(|(key, _)| named.contains(&key.content));
}

/// The sections whose formulas may name what bodies bring with them.
const FORMULAS: &[&str] = &[
    "frames",
    "joints",
    "contacts",
    "forces",
    "sensors",
    "define",
    "lagrangian",
    "constraints",
    "integrals",
    "events",
    "initial",
];

/// Whether a name occurs in the formulas of a model.
pub(crate) fn is_named(own: &Table, name: &str) -> bool {
    let mut used = BTreeSet::new();
    let sections = FORMULAS.iter().filter_map(|section| own.get(section));
    sections.for_each(|raw| words_of(raw, &mut used));
    used.contains(name)
}

/// Adds what the definitions of the names contain.
fn close(used: &mut BTreeSet<String>, defined: &BTreeMap<String, Raw>) {
    let mut open: Vec<String> = used.iter().cloned().collect();
    while let Some(name) = open.pop() {
        let Some(raw) = defined.get(&name) else {
            continue;
        };
        let mut inner = BTreeSet::new();
        words_of(raw, &mut inner);
        open.extend(inner.into_iter().filter(|word| used.insert(word.clone())));
    }
}

fn words_of_table(table: &Table, used: &mut BTreeSet<String>) {
    for (key, raw) in &table.entries {
        words(&key.content, used);
        words_of(raw, used);
    }
}

/// The nesting of TOML is bounded by its parser.
fn words_of(raw: &Raw, used: &mut BTreeSet<String>) {
    match &raw.kind {
        Kind::Text(text) => words(&text.content, used),
        Kind::Array(items) => items.iter().for_each(|item| words_of(item, used)),
        Kind::Table(table) => words_of_table(table, used),
        _ => {}
    }
}

fn words(text: &str, used: &mut BTreeSet<String>) {
    let parts = text.split(|c: char| !c.is_alphanumeric() && c != '_');
    used.extend(parts.filter(|part| !part.is_empty()).map(str::to_owned));
}
