//! Solutions that a model states: fields in closed form, on a box.

use super::declare::constants;
use super::Reader;
use crate::functional::{Functional, Interval, Side, Solution};
use crate::notation::{parse, Names};
use crate::tensors::{Scope, Shape};
use chetaev_model::raw::{Raw, Table};
use chetaev_model::{Diagnostic, Text};
use chetaev_symbolic::Expr;

const KEYS: &[&str] = &[
    "description",
    "when",
    "parameters",
    "intervals",
    "pieces",
    "fields",
    "value",
];

impl Reader<'_> {
    /// The solutions that hold for the sizes at hand.
    pub(super) fn solutions(&mut self, table: &Table, functional: &Functional) -> Vec<Solution> {
        let Some(section) = self.section(table, "solutions") else {
            return Vec::new();
        };
        let mut found = Vec::new();
        for (key, raw) in &section.entries {
            match raw.table() {
                Some(own) => found.extend(self.solution(key, own, functional)),
                None => self.wrong_kind(raw, &key.content, "a table"),
            }
        }
        found
    }

    fn solution(&mut self, key: &Text, table: &Table, functional: &Functional) -> Option<Solution> {
        self.known_keys(table, KEYS, "a solution");
        if !self.is_asked(table, functional) {
            return None;
        }
        let mut scope = functional.scope.clone();
        let names = match table.get("parameters") {
            Some(raw) => self.texts(raw, "parameters"),
            None => Vec::new(),
        };
        for name in &names {
            if scope.rank(&name.content).is_some() {
                let message = format!("`{}` is declared already", name.content);
                self.push(Diagnostic::error("declared-twice", name.place, message));
                return None;
            }
            constants(&mut scope, &name.content, Shape::Scalar);
        }
        let intervals = match table.get("intervals") {
            Some(_) => self.intervals_in(table, &scope),
            None => functional.intervals.clone(),
        };
        let pieces = self.places(table, &scope, &intervals, functional);
        let mut values = Vec::new();
        for (name, raw) in table
            .get("fields")
            .and_then(Raw::table)
            .iter()
            .flat_map(|own| &own.entries)
        {
            if is_known(functional, name) {
                values.extend(self.special(name, raw, functional, scope.clone()));
            }
        }
        let value = match self.optional(table, "value") {
            Some(text) => Some((text.content.clone(), self.scalar(&scope, &text)?)),
            None => None,
        };
        let description = self.optional(table, "description");
        Some(Solution {
            name: key.content.clone(),
            description: description.map_or(String::new(), |text| text.content),
            parameters: names.into_iter().map(|text| text.content).collect(),
            values,
            intervals,
            pieces,
            value,
        })
    }

    /// Whether the sizes are those under `when`.
    fn is_asked(&mut self, table: &Table, functional: &Functional) -> bool {
        let Some(when) = self.section(table, "when") else {
            return true;
        };
        when.entries.iter().all(|(key, raw)| {
            let stated = raw.expression().map(|text| text.content.trim().to_owned());
            let own = functional.scope.sizes.get(&key.content);
            own.map(i64::to_string) == stated
        })
    }

    /// Where the pieces of the boundary lie: as stated here, or for the functional.
    fn places(
        &mut self,
        table: &Table,
        scope: &Scope,
        intervals: &[Interval],
        functional: &Functional,
    ) -> Vec<(String, Side)> {
        let Some(section) = self.section(table, "pieces") else {
            let own = functional.pieces.iter();
            return own.map(|p| (p.name.clone(), p.side.clone())).collect();
        };
        let mut found = Vec::new();
        for (key, raw) in &section.entries {
            if functional.piece(&key.content).is_none() {
                let message = format!("`{}` is not a piece of the boundary", key.content);
                self.push(Diagnostic::error("unknown-piece", key.place, message));
                continue;
            }
            let side = self
                .text_of(raw, &key.content)
                .and_then(|text| self.side(scope, &text, intervals));
            found.extend(side.map(|side| (key.content.clone(), side)));
        }
        found
    }

    fn intervals_in(&mut self, table: &Table, scope: &Scope) -> Vec<Interval> {
        let Some(section) = self.section(table, "intervals") else {
            return Vec::new();
        };
        self.intervals_of(section, scope)
    }
}

/// A value for a field that this functional does not have is none of its.
fn is_known(functional: &Functional, name: &Text) -> bool {
    if let Some((function, _)) = name.content.split_once('(') {
        return functional.space.function_named(function.trim()).is_some();
    }
    let mut problems = Vec::new();
    parse(&name.content, &functional.scope, &mut problems);
    let is_symbol = |e: &Expr| functional.space.graph.as_symbol(*e).is_some();
    let head = name.content.split(['_', ',']).next().unwrap_or("");
    let is_definition = functional.scope.definitions.contains_key(head);
    let own = functional.scope.tensors.get(head);
    problems.is_empty() && !is_definition && own.is_some_and(|t| t.components.iter().all(is_symbol))
}
