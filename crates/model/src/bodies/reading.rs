//! Readers of keys, words, numbers and vectors of an object.

use chetaev_symbolic::syntax::ast::Node;
use chetaev_symbolic::syntax::{lower, names, parse_expression, Resolution, Scope};
use chetaev_symbolic::{Expr, Graph};

use super::algebra::{Turn, Vector};
use super::lowering::{FrameId, Lowering, Step};
use super::sections::{text, word};
use crate::diagnostic::Diagnostic;
use crate::raw::{Kind, Raw, Table};
use crate::source::Place;
use crate::text::Text;
use crate::units::{parse_unit, quantity, Unit};

/// An object while it is being read: its name, its table, and what it is, for messages.
#[derive(Clone, Copy)]
pub(crate) struct Object<'t> {
    pub(crate) what: &'static str,
    pub(crate) key: &'t Text,
    pub(crate) place: Place,
    pub(crate) table: &'t Table,
}

impl<'t> Object<'t> {
    /// Its name.
    pub(crate) fn name(&self) -> &'t str {
        &self.key.content
    }

    /// "the body `frame`".
    pub(crate) fn words(&self) -> String {
        format!("the {} `{}`", self.what, self.key.content)
    }

    pub(crate) fn get(&self, key: &str) -> Option<&'t Raw> {
        self.table.get(key)
    }

    /// The name of a number under a key.
    pub(crate) fn slot(&self, key: &str, unit: &'static str) -> Slot {
        Slot {
            name: format!("{}_{key}", self.key.content),
            unit,
            about: format!("{key} of {}", self.words()).replace('_', " "),
        }
    }
}

/// What a number is called, and the SI unit that it is in where none is stated.
#[derive(Clone, Debug)]
pub(crate) struct Slot {
    pub(crate) name: String,
    pub(crate) unit: &'static str,
    pub(crate) about: String,
}

impl Slot {
    pub(crate) fn component(&self, end: &str) -> Slot {
        Slot {
            name: format!("{}_{end}", self.name),
            about: format!("{}, {end}", self.about),
            unit: self.unit,
        }
    }
}

/// Every name is the symbol of that name.
struct Symbols<'g>(&'g Graph);

impl Scope for Symbols<'_> {
    fn resolve(&self, name: &str, order: u32) -> Resolution {
        Resolution::Known(self.0.symbol(name, order))
    }

    fn names(&self) -> Vec<String> {
        Vec::new()
    }
}

/// Whether a number is written as zero.
fn is_zero(text: &str) -> bool {
    let digits = text.split(['e', 'E']).next().unwrap_or(text);
    digits.contains('0') && !digits.contains(|c: char| ('1'..='9').contains(&c))
}

impl<'r> Lowering<'r> {
    // ---- keys

    /// The objects of a section.
    pub(crate) fn objects(&mut self, section: &str, what: &'static str) -> Vec<Object<'r>> {
        let root = self.root;
        let Some(raw) = root.get(section) else {
            return Vec::new();
        };
        let Some(table) = raw.table() else {
            self.wrong_kind(raw, &format!("`{section}`"), "a table");
            return Vec::new();
        };
        let mut all = Vec::new();
        for (key, raw) in &table.entries {
            let is_name = !key.content.is_empty()
                && key
                    .content
                    .bytes()
                    .all(|b| b.is_ascii_alphanumeric() || b == b'_')
                && !key.content.as_bytes()[0].is_ascii_digit();
            if !is_name {
                let message = format!("`{}` cannot be the name of a {what}", key.content);
                self.problems.push(
                    Diagnostic::error("bad-name", key.place, message)
                        .hint("names are made of Latin letters, digits and underscores"),
                );
                continue;
            }
            match raw.table() {
                Some(table) => all.push(Object {
                    what,
                    key,
                    place: key.place,
                    table,
                }),
                None => self.wrong_kind(raw, &format!("the {what} `{}`", key.content), "a table"),
            }
        }
        all
    }

    /// The objects among the entries of a section: those of some kind.
    pub(crate) fn objects_where(
        &mut self,
        section: &str,
        what: &'static str,
        is_own: fn(&Raw) -> bool,
    ) -> Vec<Object<'r>> {
        let root = self.root;
        let all = root.get(section).and_then(Raw::table);
        let own = all.into_iter().flat_map(|all| &all.entries);
        own.filter(|(_, raw)| is_own(raw))
            .filter_map(|(key, raw)| {
                Some(Object {
                    what,
                    key,
                    place: key.place,
                    table: raw.table()?,
                })
            })
            .collect()
    }

    pub(crate) fn wrong_kind(&mut self, raw: &Raw, what: &str, wanted: &str) {
        let message = format!("{what} must be {wanted}, not {}", raw.kind.word());
        self.error("wrong-kind", raw.place, message);
    }

    /// Reports the keys of an object that nobody knows.
    pub(crate) fn known_keys(&mut self, object: &Object<'_>, known: &[&str]) {
        for (key, _) in &object.table.entries {
            if known.contains(&key.content.as_str()) {
                continue;
            }
            let message = format!("`{}` is no key of {}", key.content, object.words());
            let problem = Diagnostic::error("unknown-key", key.place, message).label("not known");
            let near = names::closest(&key.content, known.iter().copied());
            self.problems.push(match near {
                Some(near) => problem
                    .hint(format!("did you mean `{near}`?"))
                    .suggest(key.place, near),
                None => problem.hint(format!("known keys: {}", known.join(", "))),
            });
        }
    }

    /// A text under a key.
    pub(crate) fn word(&mut self, object: &Object<'r>, key: &str) -> Option<&'r Text> {
        let raw = object.get(key)?;
        match &raw.kind {
            Kind::Text(text) => Some(text),
            _ => {
                self.wrong_kind(raw, &format!("`{key}` of {}", object.words()), "a text");
                None
            }
        }
    }

    /// One of several words; another one is reported with the nearest.
    pub(crate) fn choice<'k, T>(
        &mut self,
        object: &Object<'r>,
        key: &str,
        kinds: &[&'k T],
        word: fn(&'k T) -> &'static str,
    ) -> Option<&'k T> {
        let text = self.word(object, key)?;
        let found = kinds.iter().find(|kind| word(kind) == text.content);
        if found.is_none() {
            let words: Vec<&str> = kinds.iter().map(|kind| word(kind)).collect();
            self.no_such_word(text, key, &words);
        }
        found.copied()
    }

    pub(crate) fn no_such_word(&mut self, text: &Text, key: &str, words: &[&str]) {
        let message = format!("`{}` is no value of `{key}`", text.content);
        let problem = Diagnostic::error("unknown-value", text.place, message);
        let near = names::closest(&text.content, words.iter().copied());
        self.problems.push(match near {
            Some(near) => problem
                .hint(format!("did you mean \"{near}\"?"))
                .suggest(text.place, format!("\"{near}\"")),
            None => problem.hint(format!("one of {}", words.join(", "))),
        });
    }

    /// An axis written as `x`, `y`, `z`, with a minus sign where it is meant backwards.
    pub(crate) fn axis_of(&mut self, text: &Text) -> Option<(usize, bool)> {
        let written = text.content.trim();
        let (letter, is_backward) = match written.strip_prefix('-') {
            Some(letter) => (letter.trim(), true),
            None => (written, false),
        };
        let axis = ["x", "y", "z"].iter().position(|own| *own == letter);
        if axis.is_none() {
            let message = format!("`{written}` is no axis");
            let hint = "an axis is \"x\", \"y\" or \"z\", with a minus sign before it where it is meant backwards; other directions are made by `tilt`";
            self.problems
                .push(Diagnostic::error("unknown-value", text.place, message).hint(hint));
        }
        axis.map(|axis| (axis, is_backward))
    }

    // ---- numbers

    /// A constant: a number becomes a parameter of the slot's name, an expression of parameters stands for itself.
    pub(crate) fn number(&mut self, slot: &Slot, raw: &Raw) -> Option<Expr> {
        let key = (slot.name.clone(), raw.place);
        if let Some(known) = self.read.get(&key) {
            return Some(*known);
        }
        let value = self.number_anew(slot, raw)?;
        self.read.insert(key, value);
        Some(value)
    }

    fn number_anew(&mut self, slot: &Slot, raw: &Raw) -> Option<Expr> {
        match &raw.kind {
            Kind::Number(number) if is_zero(&number.content) => Some(self.algebra.graph.zero()),
            Kind::Number(_) => {
                Some(self.parameter(slot, raw, vec![(word("value", raw.place), raw.clone())]))
            }
            Kind::Text(own) => self.number_of_text(slot, own, raw),
            Kind::Table(table) => Some(self.parameter(slot, raw, table.entries.clone())),
            _ => {
                self.wrong_kind(raw, &slot.about, "a number");
                None
            }
        }
    }

    fn number_of_text(&mut self, slot: &Slot, own: &Text, raw: &Raw) -> Option<Expr> {
        if let Some((number, unit, read)) = quantity(&own.content) {
            return self.measured(slot, own, [number, unit], &read);
        }
        if let Some(value) = self.of_parameters(own) {
            return Some(value);
        }
        Some(self.parameter(slot, raw, vec![(word("value", raw.place), raw.clone())]))
    }

    /// `85 kg`. Where the unit is also the name of something, nobody can know what is meant.
    fn measured(&mut self, slot: &Slot, own: &Text, parts: [&str; 2], read: &Unit) -> Option<Expr> {
        let [number, unit] = parts;
        let wanted = parse_unit(slot.unit).ok();
        let fits = wanted.is_some_and(|wanted| wanted.dimension == read.dimension);
        if self.taken.contains(&names::normalized(unit)) {
            let message = format!("`{unit}` is a unit and a name of this model");
            let hint = format!("write {{ value = {number}, unit = \"{unit}\" }} for the unit, or \"{number}*{unit}\" for the product");
            self.problems
                .push(Diagnostic::error("ambiguous", own.place, message).hint(hint));
            return None;
        }
        if !fits {
            let message = format!(
                "the {} is measured in {}, not in {unit}",
                slot.about, slot.unit
            );
            self.error("wrong-dimension", own.place, message);
            return None;
        }
        let at = own.content.find(number).unwrap_or(0);
        let value = Raw {
            place: own.place,
            kind: Kind::Number(own.part(at, number)),
        };
        let entries = vec![
            (word("value", own.place), value),
            (word("unit", own.place), text(unit, own.place)),
        ];
        let raw = Raw {
            place: own.place,
            kind: Kind::Text(own.clone()),
        };
        Some(self.parameter(slot, &raw, entries))
    }

    /// An expression in which every name is the symbol of that name.
    pub(crate) fn read_symbols(&mut self, own: &Text) -> Option<Expr> {
        let parsed = parse_expression(&own.content);
        let graph = &self.algebra.graph;
        let mut problems = Vec::new();
        let value = lower(
            graph,
            &parsed.tree,
            parsed.root(),
            &Symbols(graph),
            &[],
            &mut problems,
        );
        if parsed.has_errors() || !problems.is_empty() || value.is_none() {
            let all = parsed.diagnostics.iter().chain(&problems);
            let found: Vec<Diagnostic> = all
                .map(|own_problem| Diagnostic::of_expression(own_problem, own))
                .collect();
            self.problems.extend(found);
            return None;
        }
        value
    }

    /// An expression in which parameters occur, and nothing else has a name.
    fn of_parameters(&mut self, own: &Text) -> Option<Expr> {
        let parsed = parse_expression(&own.content);
        if parsed.has_errors() {
            return None;
        }
        let mut found = 0;
        for (id, node) in parsed.tree.iter() {
            if !matches!(node, Node::Name { .. }) {
                continue;
            }
            match parsed.tree.plain_name(id) {
                Some(("pi", 0)) => {}
                Some((name, 0)) if self.parameters.contains(&names::normalized(name)) => found += 1,
                _ => return None,
            }
        }
        let scope = Symbols(&self.algebra.graph);
        let root = parsed.root();
        let mut problems = Vec::new();
        let value = lower(
            &self.algebra.graph,
            &parsed.tree,
            root,
            &scope,
            &[],
            &mut problems,
        )?;
        (found > 0 && problems.is_empty()).then_some(value)
    }

    fn parameter(&mut self, slot: &Slot, raw: &Raw, mut entries: Vec<(Text, Raw)>) -> Expr {
        let has =
            |entries: &[(Text, Raw)], key: &str| entries.iter().any(|(own, _)| own.content == key);
        if self.has_units && !has(&entries, "unit") {
            entries.push((word("unit", raw.place), text(slot.unit, raw.place)));
        }
        if !has(&entries, "description") {
            let about = text(slot.about.clone(), raw.place);
            entries.push((word("description", raw.place), about));
        }
        let value = Raw {
            place: raw.place,
            kind: Kind::Table(Table { entries }),
        };
        let key = word(slot.name.clone(), raw.place);
        self.written.parameters.entries.push((key, value));
        let name = names::normalized(&slot.name);
        self.parameters.insert(name.clone());
        self.taken.insert(name.clone());
        self.algebra.symbol(&name)
    }

    /// A function of the coordinates and the time; a number is a parameter, other expressions become definitions.
    pub(crate) fn function(&mut self, slot: &Slot, raw: &Raw) -> Option<Expr> {
        let Kind::Text(own) = &raw.kind else {
            return self.number(slot, raw);
        };
        let has_name = {
            let parsed = parse_expression(&own.content);
            let mut nodes = parsed.tree.iter();
            nodes.any(|(id, node)| {
                matches!(node, Node::Name { .. }) && parsed.tree.plain_name(id) != Some(("pi", 0))
            })
        };
        if !has_name || quantity(&own.content).is_some() {
            return self.number(slot, raw);
        }
        if let Some(value) = self.of_parameters(own) {
            return Some(value);
        }
        let value = Raw {
            place: raw.place,
            kind: raw.kind.clone(),
        };
        Some(self.define(&slot.name, value, true))
    }

    /// Three components.
    pub(crate) fn vector(
        &mut self,
        object: &Object<'_>,
        key: &str,
        unit: &'static str,
        is_function: bool,
    ) -> Option<Vector> {
        let Some(raw) = object.get(key) else {
            return Some(self.algebra.zero());
        };
        let slot = object.slot(key, unit);
        self.vector_of(&slot, raw, is_function)
    }

    pub(crate) fn vector_of(
        &mut self,
        slot: &Slot,
        raw: &Raw,
        is_function: bool,
    ) -> Option<Vector> {
        let items = match &raw.kind {
            Kind::Array(items) if items.len() == 3 => items,
            Kind::Array(items) => {
                let message = format!("the {} has 3 components, not {}", slot.about, items.len());
                self.error("wrong-length", raw.place, message);
                return None;
            }
            _ => {
                self.wrong_kind(
                    raw,
                    &format!("the {}", slot.about),
                    "an array of 3 components",
                );
                return None;
            }
        };
        let mut all = self.algebra.zero();
        let mut is_whole = true;
        for ((own, item), end) in all.iter_mut().zip(items).zip(["x", "y", "z"]) {
            let slot = slot.component(end);
            let read = if is_function {
                self.function(&slot, item)
            } else {
                self.number(&slot, item)
            };
            is_whole &= read.is_some();
            *own = read.unwrap_or(*own);
        }
        is_whole.then_some(all)
    }

    /// Turns about coordinate axes, one after the other: `{ z = "alpha", x = 0.1 }`, or an array of such tables.
    pub(crate) fn turns(&mut self, object: &Object<'_>, key: &str, is_function: bool) -> Vec<Turn> {
        let Some(raw) = object.get(key) else {
            return Vec::new();
        };
        let tables: Vec<&Raw> = match &raw.kind {
            Kind::Array(items) => items.iter().collect(),
            _ => vec![raw],
        };
        let several = tables.len() > 1;
        let mut turns = Vec::new();
        for (number, raw) in tables.into_iter().enumerate() {
            let Some(table) = raw.table() else {
                let what = format!("`{key}` of {}", object.words());
                self.wrong_kind(
                    raw,
                    &what,
                    "a table of angles by axis, as in { y = \"18 deg\" }",
                );
                continue;
            };
            for (axis, raw) in &table.entries {
                let Some((index, is_backward)) = self.axis_of(axis) else {
                    continue;
                };
                let end = if several {
                    format!("{key}_{}_{}", number + 1, axis.content)
                } else {
                    format!("{key}_{}", axis.content)
                };
                let slot = object.slot(&end.replace('-', ""), "rad");
                let read = if is_function {
                    self.function(&slot, raw)
                } else {
                    self.number(&slot, raw)
                };
                let signed = |angle| {
                    if is_backward {
                        self.algebra.graph.neg(angle)
                    } else {
                        angle
                    }
                };
                turns.extend(read.map(|angle| Turn {
                    axis: index,
                    angle: signed(angle),
                }));
            }
        }
        turns
    }

    /// The frame after turns.
    pub(crate) fn turned(
        &mut self,
        from: FrameId,
        turns: &[Turn],
        name: &str,
        place: Place,
    ) -> FrameId {
        turns.iter().fold(from, |at, turn| {
            self.step(at, Step::Turn(*turn), name, place)
        })
    }

    /// The frame after the same turns backwards.
    pub(crate) fn turned_back(
        &mut self,
        from: FrameId,
        turns: &[Turn],
        name: &str,
        place: Place,
    ) -> FrameId {
        turns.iter().rev().fold(from, |at, turn| {
            let angle = self.algebra.graph.neg(turn.angle);
            let back = Turn { angle, ..*turn };
            self.step(at, Step::Turn(back), name, place)
        })
    }
}
