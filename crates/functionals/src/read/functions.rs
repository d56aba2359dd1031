//! Constitutive functions: what a file declares, their values and gradients, and which are those that another file has declared before.

use super::declare::{place_holders, shape_of};
use super::Reader;
use crate::functional::Constitutive;
use crate::notation::free_letters;
use crate::space::Function;
use crate::tensors::{Scope, Shape};
use chetaev_model::raw::{Raw, Table};
use chetaev_model::{Diagnostic, Place, Text};
use chetaev_symbolic::{Expr, Verdict};
use std::collections::{BTreeMap, BTreeSet};

const KEYS: &[&str] = &[
    "of",
    "value",
    "gradient",
    "argument",
    "conjugate",
    "description",
];

impl Reader<'_> {
    pub(super) fn functions(&mut self, table: &Table, scope: &mut Scope) -> Vec<Constitutive> {
        let Some(section) = self.section(table, "functions") else {
            return Vec::new();
        };
        let others = others(section, table, scope);
        let mut found = Vec::new();
        for (key, raw) in &section.entries {
            let is_other = others.contains(&key.content);
            found.extend(self.function((key, raw), (table, is_other), scope));
        }
        for own in &found {
            let Some(name) = &own.conjugate else { continue };
            if let Some(wrong) = no_pair(own, &found) {
                let place = section
                    .get(&own.name)
                    .map_or(Place::default(), |raw| raw.place);
                self.push(
                    Diagnostic::error("bad-conjugate", place, wrong)
                        .hint("two functions are conjugates of each other: A names B, and B names A or nothing"),
                );
                continue;
            }
            match scope.function_named(name) {
                Some(other) => scope.space.conjugate(own.function, other),
                None => {
                    let raw = section.get(&own.name);
                    let place = raw.map_or(Place::default(), |raw| raw.place);
                    let message =
                        format!("the conjugate `{name}` of `{}` is not declared", own.name);
                    self.push(Diagnostic::error("unknown-name", place, message));
                }
            }
        }
        found
    }

    /// A function that is declared; one that is another than that of the same name in the space has a name of its own there.
    fn function(
        &mut self,
        (key, raw): (&Text, &Raw),
        (table, is_other): (&Table, bool),
        scope: &mut Scope,
    ) -> Option<Constitutive> {
        if let Some(own) = raw.table() {
            self.known_keys(own, KEYS, "a function");
        }
        let (kind, description) = self.described(raw, "of");
        if !self.is_unknown(scope, &key.content, key.place) {
            return None;
        }
        let shape = self.shape_of_argument(key, &kind?)?;
        let components = shape.components(scope.space.dimensions()).into_iter();
        let name = if is_other {
            let of = table.get("name").and_then(Raw::expression);
            let of = of.map_or("the other", |text| text.content.as_str());
            scope.space.unused_function_name(&key.content, of)
        } else {
            key.content.clone()
        };
        let written = written(raw, table, &scope.sizes);
        let is_any = written.is_none();
        let function = scope.space.function(Function {
            name,
            rank: shape.rank(),
            multiplicities: components.map(|(_, m)| m).collect(),
            conjugate: None,
            written,
        });
        if is_any {
            scope.any.insert(function);
        }
        scope.functions.insert(key.content.clone(), function);
        let mut text = |key: &str| Some(self.optional(raw.table()?, key)?.content);
        Some(Constitutive {
            name: key.content.clone(),
            function,
            value: text("value"),
            gradient: text("gradient"),
            conjugate: text("conjugate"),
            description,
        })
    }

    /// Of what a function may be.
    fn shape_of_argument(&mut self, key: &Text, kind: &Text) -> Option<Shape> {
        let shape = self.shape(kind)?;
        let is_usual = matches!(shape, Shape::Scalar | Shape::Vector | Shape::Symmetric);
        if !is_usual {
            let message = format!(
                "`{}` is a function of a scalar, a vector or a symmetric tensor",
                key.content
            );
            self.push(Diagnostic::error("bad-kind", kind.place, message));
        }
        is_usual.then_some(shape)
    }

    /// Values and gradients of functions, which may use everything else.
    pub(super) fn function_rules(
        &mut self,
        table: &Table,
        scope: &mut Scope,
        all: &[Constitutive],
    ) {
        let Some(section) = table.get("functions").and_then(Raw::table) else {
            return;
        };
        for own in all {
            let Some(entry) = section.get(&own.name).and_then(Raw::table) else {
                continue;
            };
            let argument = self.optional(entry, "argument");
            let name = argument.map_or_else(|| "X".to_owned(), |text| text.content);
            let slots = scope.space.slots(own.function);
            let shape = shape_of(scope, own.function);
            let before = scope.tensors.get(&name).cloned();
            place_holders(scope, &name, shape, &slots);
            if let Some(value) = self
                .optional(entry, "value")
                .and_then(|t| self.scalar(scope, &t))
            {
                scope.space.state_body(own.function, value);
            }
            if let Some(text) = self.optional(entry, "gradient") {
                if let Some(node) = self.node(scope, &text, None) {
                    let letters = free_letters(&node);
                    let d = scope.space.dimensions();
                    let values = shape.components(d).into_iter().map(|(indices, _)| {
                        let places = letters.iter().copied().zip(indices).collect();
                        scope.value(&node, &places)
                    });
                    let values: Vec<Expr> = values.collect();
                    self.is_gradient(scope, own, &values, &text);
                    scope.space.state_gradient(own.function, values);
                }
            }
            match before {
                Some(tensor) => scope.tensors.insert(name, tensor),
                None => scope.tensors.remove(&name),
            };
        }
        for own in all {
            scope.space.state_conjugate(own.function);
        }
    }

    /// A stated gradient is that of the stated value; without one its slopes are symmetric, so that it is the gradient of something.
    fn is_gradient(&mut self, scope: &Scope, own: &Constitutive, values: &[Expr], text: &Text) {
        let space = &*scope.space;
        let g = &space.graph;
        let slots = space.slots(own.function);
        let is_refuted = |e: Expr| matches!(space.vanishing(&[e], true), Verdict::Refuted(_));
        // With other functions in it, it is a condition on these.
        let is_free = |e: Expr| space.functions_in(e).is_empty();
        for (k, &value) in values.iter().enumerate() {
            let of_value = space.body(own.function, &[k], &slots);
            if of_value.is_some_and(|e| is_refuted(g.sub(e, value))) {
                let message = format!("this is not the gradient of the value of `{}`", own.name);
                self.push(
                    Diagnostic::error("bad-gradient", text.place, message)
                        .hint("leave `gradient` out: it is computed from the value"),
                );
                return;
            }
        }
        let multiplicities = space.function_at(own.function).multiplicities;
        let slope = |of: usize, by: usize| {
            let symbol = g.as_symbol(slots[by]);
            let own = space.derive(values[of], &|s| (Some(s) == symbol).then_some(g.one()));
            g.mul(&[g.integer(multiplicities[of]), own])
        };
        for k in 0..values.len() {
            for l in 0..k {
                let difference = g.sub(slope(k, l), slope(l, k));
                if is_free(difference) && is_refuted(difference) {
                    let message = format!(
                        "this is the gradient of no function: its slopes are not symmetric, so that `{}` does not exist",
                        own.name
                    );
                    let mut diagnostic = Diagnostic::error("bad-gradient", text.place, message);
                    let has_others = g
                        .symbols_in(&[difference])
                        .into_iter()
                        .any(|s| !slots.contains(&g.symbol_expr(s)));
                    if has_others {
                        diagnostic = diagnostic.hint("for some values of the parameters they are: constants c_ijkl of the kind \"elastic\" are symmetric in their pairs");
                    }
                    self.push(diagnostic);
                    return;
                }
            }
        }
    }
}

/// Why two functions are no pair: one is its own conjugate, or the other has another one.
fn no_pair(own: &Constitutive, all: &[Constitutive]) -> Option<String> {
    let name = own.conjugate.as_ref()?;
    if *name == own.name {
        return Some(format!("`{name}` is stated as its own conjugate"));
    }
    let other = all.iter().find(|other| other.name == *name)?;
    let back = other.conjugate.as_ref().filter(|back| **back != own.name)?;
    Some(format!(
        "`{name}` is stated as the conjugate of `{}`, and its own is `{back}`",
        own.name
    ))
}

/// How a function is stated, as it is written, with what the names in it mean; nothing where it may be any.
fn written(raw: &Raw, table: &Table, sizes: &BTreeMap<String, i64>) -> Option<String> {
    let own = raw.table()?;
    let text = |key: &str| Some(own.get(key)?.expression()?.content.clone());
    let (value, gradient) = (text("value"), text("gradient"));
    let mut open: Vec<String> = [&value, &gradient].into_iter().flatten().cloned().collect();
    if open.is_empty() {
        return None;
    }
    let mut meanings: BTreeMap<String, String> = BTreeMap::new();
    while let Some(text) = open.pop() {
        for name in text.split(|sign: char| !sign.is_alphanumeric()) {
            if meanings.contains_key(name) {
                continue;
            }
            let meaning = match sizes.get(name) {
                Some(size) => size.to_string(),
                None => match meaning_of(name, table) {
                    Some(meaning) => meaning,
                    None => continue,
                },
            };
            open.push(meaning.clone());
            meanings.insert(name.to_owned(), meaning);
        }
    }
    let argument = text("argument");
    Some(format!("{argument:?} {value:?} {gradient:?} {meanings:?}"))
}

/// What a file states of a parameter or a definition, as it is written.
fn meaning_of(name: &str, table: &Table) -> Option<String> {
    let is_own = |key: &Text| key.content.split('_').next() == Some(name);
    let sections = ["parameters", "define"].into_iter();
    let sections = sections.filter_map(|section| table.get(section)?.table());
    let mut entries = sections.flat_map(|own| &own.entries);
    let (key, raw) = entries.find(|(key, _)| is_own(key))?;
    let all = match raw.table() {
        Some(own) => own
            .entries
            .iter()
            .map(|(key, raw)| (key.content.as_str(), raw))
            .collect(),
        None => vec![("value", raw)],
    };
    let all = all.into_iter().filter(|(key, _)| *key != "description");
    let texts = all.filter_map(|(key, raw)| Some(format!("{key} {}", raw.expression()?.content)));
    Some(format!(
        "{} {}",
        key.content,
        texts.collect::<Vec<_>>().join(" ")
    ))
}

/// The functions of a file that are others than those of the same name that the space has already. A function is that of the space where it
/// is stated as there, by functions that are, or left open, and where its conjugate, if it has one, is the conjugate there.
fn others(section: &Table, table: &Table, scope: &Scope) -> BTreeSet<String> {
    let space = &scope.space;
    let name_of_conjugate = |at: usize| {
        let other = space.function_at(at).conjugate?;
        Some(space.function_at(other).name)
    };
    let text = |raw: &Raw, key: &str| {
        let own = raw.table()?.get(key)?.expression()?;
        Some(own.content.clone())
    };
    let conjugate_here = |key: &str, raw: &Raw| {
        let by_other = section.entries.iter().find_map(|(other, raw)| {
            let own = text(raw, "conjugate")?;
            (own == key).then(|| other.content.clone())
        });
        text(raw, "conjugate").or(by_other)
    };
    let is_other = |key: &Text, raw: &Raw, found: &BTreeSet<String>| {
        let Some(known) = space.function_named(&key.content) else {
            return true;
        };
        let own = written(raw, table, &scope.sizes);
        let is_stated_otherwise = own.is_some() && space.function_at(known).written != own;
        let conjugate = conjugate_here(&key.content, raw);
        let has_other_conjugate = conjugate.as_ref().is_some_and(|conjugate| {
            found.contains(conjugate) || name_of_conjugate(known).as_ref() != Some(conjugate)
        });
        let texts = [text(raw, "value"), text(raw, "gradient")];
        let is_by_other = texts.iter().flatten().any(|text| {
            let mut names = text.split(|sign: char| !sign.is_alphanumeric());
            names.any(|name| found.contains(name))
        });
        is_stated_otherwise || has_other_conjugate || is_by_other
    };
    let mut found = BTreeSet::new();
    loop {
        let mut all = section.entries.iter();
        let next =
            all.find(|(key, raw)| !found.contains(&key.content) && is_other(key, raw, &found));
        match next {
            Some((key, _)) => found.insert(key.content.clone()),
            // What the space does not have gets its own name.
            None => {
                found.retain(|name| space.function_named(name).is_some());
                return found;
            }
        };
    }
}
