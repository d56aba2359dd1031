//! Solutions that a model states: fields in closed form, on a box.

use super::declare::constants;
use super::Reader;
use crate::functional::{Functional, Interval, Side, Solution, Special, SpecialKind};
use crate::notation::{parse, Names};
use crate::tensors::{Scope, Shape};
use chetaev_model::raw::{Raw, Table};
use chetaev_model::{Diagnostic, Place, Text};
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
        self.all_fields_stated(key, functional, &values);
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
            has_pieces: table.get("pieces").is_some(),
            value,
        })
    }

    /// A solution states every field.
    fn all_fields_stated(&mut self, key: &Text, functional: &Functional, values: &[Special]) {
        let space = &*functional.space;
        let stated = |component: &usize| {
            let own = space.jet(*component, &[]);
            let mut pairs = values.iter().flat_map(|special| match &special.what {
                SpecialKind::Symbols(pairs) => pairs.as_slice(),
                SpecialKind::Size | SpecialKind::Function { .. } => &[],
            });
            pairs.any(|(left, _)| *left == own)
        };
        let mut fields = functional.fields.iter();
        let Some(field) = fields.find(|field| !field.components.iter().all(stated)) else {
            return;
        };
        let name = &field.name;
        let message = format!(
            "the solution `{}` does not state the field `{name}`",
            key.content
        );
        let hint = format!("add {name} = \"…\" to [solutions.{}.fields]", key.content);
        self.push(Diagnostic::error("missing-key", key.place, message).hint(hint));
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
        let mut found: Vec<(String, Side)> = Vec::new();
        for (key, raw) in &section.entries {
            if functional.piece(&key.content).is_none() {
                let message = format!("`{}` is not a piece of the boundary", key.content);
                self.push(Diagnostic::error("unknown-piece", key.place, message));
                continue;
            }
            for text in self.texts(raw, &key.content) {
                let Some(side) = self.side(scope, &text, intervals) else {
                    return found;
                };
                if let Some((other, _)) = found.iter().find(|(_, own)| *own == side) {
                    let message = format!("`{}` is a face of `{other}` already", text.content);
                    self.push(
                        Diagnostic::error("declared-twice", text.place, message).hint(
                            "a face of the box is one piece of the boundary, or a part of it",
                        ),
                    );
                }
                found.push((key.content.clone(), side));
            }
        }
        self.unplaced_pieces(table, section, functional);
        self.uncovered_faces(table, scope, intervals, &found);
        found
    }

    /// Every piece of the boundary is spoken of, those too that no face of this box is.
    fn unplaced_pieces(&mut self, table: &Table, section: &Table, functional: &Functional) {
        let place = table
            .get("pieces")
            .map_or(Place::default(), |raw| raw.place);
        for piece in &functional.pieces {
            if section.get(&piece.name).is_some() {
                continue;
            }
            let message = format!("where `{}` lies is not stated", piece.name);
            self.push(Diagnostic::error("missing-piece", place, message).hint(format!(
                "add {0} = \"x = 0\", with the face that it is, {0} = [\"x = 0\", \"y = 0\"] for several, or {0} = [] for none",
                piece.name
            )));
        }
    }

    /// Every face of the box is a piece of the boundary.
    fn uncovered_faces(
        &mut self,
        table: &Table,
        scope: &Scope,
        intervals: &[Interval],
        found: &[(String, Side)],
    ) {
        let place = table
            .get("pieces")
            .map_or(Place::default(), |raw| raw.place);
        let g = &scope.space.graph;
        for interval in intervals {
            let coordinate = &scope.space.coordinates[interval.axis];
            for (own, end) in [(false, interval.lower), (true, interval.upper)] {
                let is_here = |side: &Side| matches!(side, Side::Flat { axis, is_upper, .. } if *axis == interval.axis && *is_upper == own);
                if coordinate.is_time || found.iter().any(|(_, side)| is_here(side)) {
                    continue;
                }
                let face = format!("{} = {}", coordinate.name, g.text(end));
                let message = format!("the face {face} of the box is no piece of the boundary");
                self.push(
                    Diagnostic::error("missing-piece", place, message)
                        .hint("each face of the box belongs to one piece; a piece may have several: [\"x = 0\", \"y = 0\"]"),
                );
            }
        }
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
        return functional.scope.function_named(function.trim()).is_some();
    }
    let mut problems = Vec::new();
    parse(&name.content, &functional.scope, &mut problems);
    let is_symbol = |e: &Expr| functional.space.graph.as_symbol(*e).is_some();
    let head = name.content.split(['_', ',']).next().unwrap_or("");
    let is_definition = functional.scope.definitions.contains_key(head);
    let own = functional.scope.tensors.get(head);
    problems.is_empty() && !is_definition && own.is_some_and(|t| t.components.iter().all(is_symbol))
}
