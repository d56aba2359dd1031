//! Relations to other functionals, each read from its own file onto the same symbols.

use super::declare::{constants, place_holders, shape_of};
use super::living::Living;
use super::names::written_out;
use super::Reader;
use crate::functional::{Functional, Missing, Relation, Release, Special, SpecialKind};
use crate::notation::{free_letters, parse, Names};
use crate::space::Space;
use crate::tensors::Scope;
use chetaev_model::raw::{Raw, Table};
use chetaev_model::{joined, tables, Diagnostic, Place, Text};
use chetaev_symbolic::syntax::Span;
use chetaev_symbolic::Expr;
use std::collections::BTreeMap;
use std::rc::Rc;

impl Reader<'_> {
    pub(super) fn relations(&mut self, table: &Table, functional: &Functional) -> Vec<Relation> {
        let mut found = Vec::new();
        found.extend(self.duality(table, functional));
        found.extend(self.descent(table, functional));
        let Some(section) = self.section(table, "degenerations") else {
            return found;
        };
        for (key, raw) in &section.entries {
            match raw.table() {
                Some(own) => found.extend(self.degeneration(key, own, (table, functional))),
                None => self.wrong_kind(raw, &key.content, "a table"),
            }
        }
        found
    }

    /// The functional itself on symbols that it shares with nothing but one other, with the values that it states; what is to be said of its
    /// file has been said.
    fn beside(&mut self, table: &Table, functional: &Functional) -> Option<Functional> {
        let told = self.problems.len();
        let space = Rc::new(functional.space.beside());
        let own = self.valued(table, Place::default(), &space);
        self.problems.truncate(told);
        own
    }

    /// A functional on symbols that are there, with the values that its file states.
    fn valued(&mut self, table: &Table, place: Place, space: &Rc<Space>) -> Option<Functional> {
        let before = std::mem::replace(&mut self.puts_in_values, true);
        let found = self.functional(table, place, Some(space));
        self.puts_in_values = before;
        found
    }

    /// The other functional of a relation; why it is not there for the values that are stated here; nothing where its
    /// file has mistakes.
    fn other(
        &mut self,
        named: &Text,
        functional: &Functional,
        (claim, name): (&'static str, Option<&Text>),
    ) -> Result<Functional, Option<Missing>> {
        let told = self.problems.len();
        let found = self.read_other(named, functional);
        let is_of_values =
            |d: &Diagnostic| ["division-by-zero", "false-assumption"].contains(&d.code);
        let new = &self.problems[told..];
        let Some(first) = new.first().filter(|_| new.iter().all(is_of_values)) else {
            return found.ok_or(None);
        };
        let why = first.message.clone();
        self.problems.truncate(told);
        Err(Some(Missing {
            claim,
            name: name.map(|own| own.content.clone()),
            other: named.content.clone(),
            why,
        }))
    }

    fn read_other(&mut self, named: &Text, functional: &Functional) -> Option<Functional> {
        let path = joined(&self.text.path, &named.content);
        let text = match self.files.read(&path) {
            Ok(text) => text,
            Err(reason) => {
                let message = format!("`{path}` cannot be read: {reason}");
                self.push(Diagnostic::error(
                    "unreadable-include",
                    named.place,
                    message,
                ));
                return None;
            }
        };
        let overrides = self.text.overrides.clone();
        let sources = std::mem::take(&mut self.sources);
        let read = tables(&path, &text, self.files, &overrides, sources);
        self.sources = read.sources;
        self.problems.extend(read.diagnostics);
        self.keep(read.text.includes, path, text);
        let place = Place {
            source: read.source,
            span: Span::new(0, 1),
        };
        let table = written_out(read.table?);
        let assumed = functional.space.assumptions();
        let other = self.valued(&table, place, &functional.space);
        // What is proved of both is proved under what this file assumes.
        functional.space.assume_only(assumed);
        let other = other?;
        self.are_of_one_kind(named, functional, &other)
            .then_some(other)
    }

    /// Whether names that two files share mean things of one kind; else it is said.
    fn are_of_one_kind(&mut self, named: &Text, own: &Functional, other: &Functional) -> bool {
        let kind = |functional: &Functional, name: &str| {
            let fields = functional.fields.iter().chain(&functional.data);
            let field = fields
                .into_iter()
                .find(|field| field.name == name)
                .map(|field| (false, field.shape));
            let mut parameters = functional.parameters.iter();
            let parameter = parameters.find(|p| p.name == name);
            field.or(parameter.map(|p| (true, p.shape)))
        };
        let names = other.fields.iter().chain(&other.data).map(|f| &f.name);
        let names = names.chain(other.parameters.iter().map(|p| &p.name));
        // Components of parameters have names of their own in each shape.
        let is_otherwise = |name: &&String| match (kind(own, name), kind(other, name)) {
            (Some((true, _)), Some((true, _))) => false,
            (Some(here), there) => Some(here) != there,
            (None, _) => false,
        };
        let Some(name) = names.into_iter().find(is_otherwise) else {
            return true;
        };
        let message = format!(
            "`{name}` is of another kind in `{}`: what two files call by one name is one thing",
            named.content
        );
        self.push(Diagnostic::error("other-kind", named.place, message));
        false
    }

    pub(super) fn required(&mut self, table: &Table, key: &str, what: &str) -> Option<Text> {
        let found = self.optional(table, key);
        if found.is_none() {
            let place = table
                .entries
                .first()
                .map_or(Place::default(), |(key, _)| key.place);
            let message = format!("{what} needs `{key}`");
            self.push(Diagnostic::error("missing-key", place, message));
        }
        found
    }

    fn duality(&mut self, table: &Table, functional: &Functional) -> Option<Relation> {
        let section = self.section(table, "duality")?;
        self.known_keys(section, &["with", "flux"], "[duality]");
        let with = self.required(section, "with", "[duality]")?;
        let own = self.beside(table, functional)?;
        let other = match self.other(&with, &own, ("functional.duality", None)) {
            Ok(other) => other,
            Err(missing) => return missing.map(Relation::Without),
        };
        // Where the dual has more fields the flux is one of these.
        let functional = if has_more_fields(&other, &own) {
            &other
        } else {
            &own
        };
        let flux = self.optional(section, "flux").and_then(|text| {
            let node = self.node(&functional.scope, &text, None)?;
            let letters = free_letters(&node);
            let components = functional.scope.components(&node, &letters);
            // With one variable of space a vector has one component.
            let is_alone = functional.scope.space.dimensions() == 1 && letters.is_empty();
            if letters.len() != 1 && !is_alone {
                let message = "the flux is a vector: one index is free";
                self.push(Diagnostic::error("index-mismatch", text.place, message));
            }
            let living = Living::of(
                &functional.scope,
                &functional.data,
                &functional.fields,
                &functional.pieces,
            );
            self.lives_there(&living, &components, None, &text);
            Some((text.content, components))
        });
        let own = Box::new(own);
        Some(Relation::Duality { own, other, flux })
    }

    fn descent(&mut self, table: &Table, functional: &Functional) -> Option<Relation> {
        let section = self.section(table, "descent")?;
        self.known_keys(
            section,
            &["from", "imposing", "released", "multiplier"],
            "[descent]",
        );
        let from = self.required(section, "from", "[descent]")?;
        let own = self.beside(table, functional)?;
        let other = match self.other(&from, &own, ("functional.descent", None)) {
            Ok(other) => other,
            Err(missing) => return missing.map(Relation::Without),
        };
        let imposed = match section.get("imposing") {
            Some(raw) => self.texts(raw, "imposing"),
            None => Vec::new(),
        };
        for text in &imposed {
            if other.equations.iter().all(|e| e.label != text.content) {
                let message = format!("`{}` has no equation `{}`", from.content, text.content);
                self.push(Diagnostic::error("unknown-equation", text.place, message));
            }
        }
        let imposed = imposed.into_iter().map(|text| text.content).collect();
        let release = self.release(section, &other);
        Some(Relation::Descent {
            own: Box::new(own),
            other,
            imposed,
            release,
        })
    }

    /// `released` and `multiplier`, in the names of the level above.
    fn release(&mut self, section: &Table, above: &Functional) -> Option<Release> {
        let released = self.optional(section, "released");
        let multiplier = match released {
            Some(_) => self.required(section, "multiplier", "what is released"),
            None => self.optional(section, "multiplier"),
        }?;
        let tree = match &released {
            Some(text) => Some(self.node(&above.scope, text, Some(&[]))?),
            None => None,
        };
        let density = tree
            .as_ref()
            .map(|tree| above.scope.value(tree, &BTreeMap::new()));
        let node = self.node(&above.scope, &multiplier, None)?;
        let mut letters = free_letters(&node);
        letters.sort_unstable();
        Some(Release {
            density,
            tree,
            multiplier: above.scope.components(&node, &letters),
            written: multiplier.content,
        })
    }

    fn degeneration(
        &mut self,
        key: &Text,
        table: &Table,
        (model, functional): (&Table, &Functional),
    ) -> Option<Relation> {
        self.known_keys(table, &["becomes", "at"], "a degeneration");
        let becomes = self.required(table, "becomes", "a degeneration")?;
        let at = table.get("at").and_then(Raw::table);
        let entries = at.map_or(&[][..], |own| &own.entries);
        let is_size = |(name, _): &&(Text, Raw)| functional.scope.sizes.contains_key(&name.content);
        let (sizes, rest): (Vec<_>, Vec<_>) = entries.iter().partition(is_size);
        let mut values = Vec::new();
        let mut special = Vec::new();
        for (name, raw) in sizes {
            let text = self.text_of(raw, &name.content)?;
            values.push(Special {
                written: format!("{} = {}", name.content, text.content),
                what: SpecialKind::Size,
            });
            special.push((name.clone(), text));
        }
        let own = if special.is_empty() {
            self.beside(model, functional)?
        } else {
            self.with_sizes(special, (model, functional))?
        };
        let other = match self.other(&becomes, &own, ("functional.degeneration", Some(key))) {
            Ok(other) => other,
            Err(missing) => return missing.map(Relation::Without),
        };
        let of = &own;
        for (name, raw) in rest {
            // On the right the names mean what they mean for the other functional.
            let mut scope = of.scope.clone();
            scope.tensors.extend(other.scope.tensors.clone());
            values.extend(self.special(name, raw, of, scope));
        }
        Some(Relation::Degeneration {
            name: key.content.clone(),
            own: Box::new(own),
            other,
            values,
        })
    }

    /// The functional with other sizes, on the same symbols.
    fn with_sizes(
        &mut self,
        special: Vec<(Text, Text)>,
        (model, functional): (&Table, &Functional),
    ) -> Option<Functional> {
        let is_asked =
            |(own, _): &(Text, Text)| special.iter().any(|(name, _)| name.content == own.content);
        let before = self.overrides.clone();
        self.overrides.retain(|own| !is_asked(own));
        self.overrides.extend(special.iter().cloned());
        let place = special.first().map_or(Place::default(), |own| own.0.place);
        let space = Rc::new(functional.space.beside());
        let found = self.valued(model, place, &space);
        self.overrides = before;
        found
    }

    /// `beta = "0"`, `beta_ijkl = "…"`, `"A(X)" = "…"`; the right side may use the names of `scope`.
    pub(super) fn special(
        &mut self,
        key: &Text,
        raw: &Raw,
        functional: &Functional,
        mut scope: Scope,
    ) -> Option<Special> {
        let text = self.text_of(raw, &key.content)?;
        let written = format!("{} = {}", key.content, text.content);
        if let Some((name, argument)) = key.content.split_once('(') {
            let function = scope.function_named(name.trim());
            let Some(function) = function else {
                let message = format!("`{name}` is not a constitutive function");
                self.push(Diagnostic::error("unknown-name", key.place, message));
                return None;
            };
            let slots = scope.space.slots(function);
            let shape = shape_of(&scope, function);
            place_holders(
                &mut scope,
                argument.trim_end_matches(')').trim(),
                shape,
                &slots,
            );
            let value = self.scalar(&scope, &text)?;
            let what = SpecialKind::Function { function, value };
            return Some(Special { written, what });
        }
        let mut problems = Vec::new();
        let left = parse(&key.content, &functional.scope, &mut problems);
        if !self.add(key, &problems) {
            return None;
        }
        let left = left?;
        let letters = free_letters(&left);
        let right = self.node(&scope, &text, Some(&letters))?;
        let g = &scope.space.graph;
        // A parameter whose value is stated is still the one that is meant.
        let mut general = functional.scope.clone();
        for parameter in functional.parameters.iter().filter(|p| p.value.is_some()) {
            constants(&mut general, &parameter.name, parameter.shape);
        }
        let left = general.components(&left, &letters);
        let right = scope.components(&right, &letters);
        let mut pairs: BTreeMap<_, _> = BTreeMap::new();
        for (l, r) in left.into_iter().zip(right) {
            if g.as_symbol(l).is_none() || scope.coordinate(&key.content).is_some() {
                let message = "only parameters and fields have special values";
                self.push(Diagnostic::error("bad-special", key.place, message));
                return None;
            }
            pairs.insert(l, r);
        }
        let varying = pairs
            .iter()
            .find_map(|(&l, &r)| Some((l, varying(functional, l, r)?)));
        if let Some((own, axis)) = varying {
            let name = &functional.space.coordinates[axis].name;
            let own = g.text(own);
            let message = format!("`{own}` does not depend on {name}, and this value of it does");
            self.push(
                Diagnostic::error("bad-special", text.place, message).hint(
                    "a parameter is a number; data depend on all variables, or on those that `of` names",
                ),
            );
            return None;
        }
        let what = SpecialKind::Symbols(pairs.into_iter().collect());
        Some(Special { written, what })
    }
}

/// A variable on which a value depends, and what it is the value of does not.
fn varying(functional: &Functional, own: Expr, value: Expr) -> Option<usize> {
    let space = &*functional.space;
    let component = space
        .as_jet(space.graph.as_symbol(own)?)
        .map(|jet| jet.component);
    let varies = |axis: usize| component.is_some_and(|own| space.varies_along(own, axis));
    let mut axes = (0..space.coordinates.len()).filter(|&axis| !varies(axis));
    axes.find(|&axis| !space.vanish(&[space.total(value, axis)]))
}

/// Whether a functional has all fields of another one in the interior, and more.
fn has_more_fields(one: &Functional, other: &Functional) -> bool {
    let has = |of: &Functional, name: &str| of.interior().any(|own| own.name == name);
    let mut all = other.interior();
    all.all(|own| has(one, &own.name)) && one.interior().any(|own| !has(other, &own.name))
}
