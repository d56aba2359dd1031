//! Definitions, densities, boundary pieces and equations.

use super::living::Living;
use super::Reader;
use crate::functional::{
    names_in, place_of, Definition, Equation, Field, Functional, Interval, Piece, Role, Side,
};
use crate::notation::{check, free_letters, parse, parse_sides, Index};
use crate::space::pairs;
use crate::tensors::{tuples, Scope, Tensor};
use chetaev_model::raw::{Kind, Raw, Table};
use chetaev_model::{name_of_path, Diagnostic, Place, Text};
use chetaev_symbolic::syntax::names::closest;
use chetaev_symbolic::zero::assumptions::{Assumption, Relation};
use chetaev_symbolic::Expr;
use std::collections::BTreeMap;

impl Reader<'_> {
    pub(super) fn stated(
        &mut self,
        table: &Table,
        place: Place,
        mut scope: Scope,
    ) -> Option<Functional> {
        builtin(&mut scope);
        let before = self.problems.len();
        let parameters = self.parameters(table, &mut scope);
        let data = self.fields(table, "data", false, &mut scope);
        let fields = self.fields(table, "fields", true, &mut scope);
        if fields.is_empty() && !self.has_refused_names(before) {
            let message = "a functional needs fields that are varied";
            self.push(
                Diagnostic::error("missing-section", place, message)
                    .hint("add [fields] with, for example, u = \"vector\""),
            );
        }
        let functions = self.functions(table, &mut scope);
        if self.has_refused_names(before) {
            return None;
        }
        let definitions = self.definitions(table, &mut scope);
        if self.has_refused_names(before) {
            return None;
        }
        self.function_rules(table, &mut scope, &functions);
        let assumptions = self.assumptions(table, &scope);
        let intervals = self.intervals(table, &scope);
        inside(&scope, &intervals);
        let Some(text) = self.optional(table, "density") else {
            let message = "a functional needs its density";
            self.push(
                Diagnostic::error("missing-key", place, message)
                    .hint("add density = \"…\" above the first section"),
            );
            return None;
        };
        let density = self.scalar_tree(&scope, &text);
        if let Some((_, density)) = density {
            self.without_normal(&scope, density, &text);
        }
        let pieces = self.pieces(table, &scope, &intervals);
        let living = Living::of(&scope, &data, &fields, &pieces);
        self.pieces_exist(table, &living, &pieces);
        self.fixed_are_fields(table, &data, &pieces);
        if let Some((_, density)) = density {
            self.lives_there(&living, &[density], None, &text);
        }
        self.boundary_lives(table, &living, &pieces);
        let equations = self.equations(table, &scope, &pieces, &living);
        let symmetries = self.symmetries(table);
        let name = match self.optional(table, "name") {
            Some(name) => name.content,
            None => name_of_path(&self.sources.get(place.source).name),
        };
        let level = self.optional(table, "level");
        let description = self.optional(table, "description");
        let sources = match table.get("source") {
            Some(raw) => self.texts(raw, "source"),
            None => Vec::new(),
        };
        let of = |text: Option<Text>| text.map_or(String::new(), |text| text.content);
        let (tree, density) = density?;
        Some(Functional {
            name,
            level: level.map(|text| text.content),
            description: of(description),
            sources: sources.into_iter().map(|text| text.content).collect(),
            space: scope.space.clone(),
            scope,
            intervals,
            fields,
            data,
            parameters,
            functions,
            definitions,
            assumptions,
            density,
            tree,
            written: text.content,
            pieces,
            equations,
            symmetries,
        })
    }

    /// Definitions in any order: each is read as soon as all names in it are known.
    fn definitions(&mut self, table: &Table, scope: &mut Scope) -> Vec<Definition> {
        let mut found = Vec::new();
        let Some(section) = self.section(table, "define") else {
            return found;
        };
        let mut pending: Vec<(Text, Text, String)> = Vec::new();
        let functions = table.get("functions").and_then(Raw::table);
        for (key, raw) in &section.entries {
            if functions.is_some_and(|own| own.get(head_of(key)).is_some()) {
                self.is_twice(head_of(key), key.place);
                continue;
            }
            if let Some(own) = raw.table() {
                self.known_keys(own, &["value", "description"], "a definition");
            }
            let (value, description) = self.described(raw, "value");
            if let Some(value) = value {
                pending.push((key.clone(), value, description));
            }
        }
        loop {
            let before = pending.len();
            let mut waiting = Vec::new();
            for (key, value, description) in pending {
                let mut problems = Vec::new();
                parse(&value.content, scope, &mut problems);
                if problems.iter().any(|d| d.code == "unknown-name") {
                    waiting.push((key, value, description));
                    continue;
                }
                self.definition(scope, &key, &value);
                found.push(Definition {
                    name: key.content,
                    written: value.content,
                    description,
                });
            }
            pending = waiting;
            if pending.is_empty() || pending.len() == before {
                break;
            }
        }
        self.undefined(scope, &pending);
        found
    }

    /// Definitions in which names stay unknown: those of each other, or of nothing.
    fn undefined(&mut self, scope: &Scope, pending: &[(Text, Text, String)]) {
        let heads: Vec<&str> = pending.iter().map(|(key, ..)| head_of(key)).collect();
        let is_head = |name: &str| heads.contains(&name);
        for (key, value, _) in pending {
            let mut problems = Vec::new();
            parse(&value.content, scope, &mut problems);
            let unknown = problems.iter().filter(|d| d.code == "unknown-name");
            let names = unknown.filter_map(|d| value.content.get(d.span.start..d.span.end));
            let of_others =
                |written: &str| is_head(written.split(['_', ',', '(']).next().unwrap_or(""));
            if names.clone().count() > 0 && names.clone().all(of_others) {
                let message = format!(
                    "`{}` is defined by itself, or by definitions that use it",
                    key.content
                );
                self.push(
                    Diagnostic::error("recursive-definition", value.place, message).hint(
                        "a definition is an abbreviation: what it uses is defined without it",
                    ),
                );
            } else {
                self.add(value, &problems);
            }
        }
    }

    fn definition(&mut self, scope: &mut Scope, key: &Text, value: &Text) {
        let (name, letters) = match key.content.rsplit_once('_') {
            Some((name, letters)) if letters.chars().all(|c| c.is_ascii_lowercase()) => {
                (name.to_owned(), letters.chars().collect())
            }
            _ => (key.content.clone(), Vec::new()),
        };
        if !self.is_unknown(scope, &name, key.place) {
            return;
        }
        let Some(node) = self.node(scope, value, Some(&letters)) else {
            return;
        };
        let components = scope.components(&node, &letters);
        let d = scope.space.dimensions();
        if letters.len() == 2 {
            let tensor = Tensor {
                rank: 2,
                components: components.clone(),
            };
            let own: Vec<Expr> = pairs(d)
                .into_iter()
                .filter_map(|(i, j)| tensor.at(&[i, j], d))
                .collect();
            scope.space.name_arguments(&own, &name);
        }
        let rank = letters.len();
        scope.definitions.insert(name.clone(), (letters, node));
        scope.tensors.insert(name, Tensor { rank, components });
    }

    fn without_normal(&mut self, scope: &Scope, e: Expr, text: &Text) {
        let occurring = scope.space.symbols_in(&[e]);
        if occurring.iter().any(|&s| scope.space.is_of_surface(s)) {
            let message = "the normal n and the curvature have a meaning on the boundary only";
            self.push(Diagnostic::error("normal-inside", text.place, message));
        }
    }

    fn pieces(&mut self, table: &Table, scope: &Scope, intervals: &[Interval]) -> Vec<Piece> {
        let domain = table.get("domain").and_then(Raw::table);
        let declared = match domain.and_then(|own| own.get("boundary")) {
            Some(raw) => self.texts(raw, "boundary"),
            None => Vec::new(),
        };
        let mut found: Vec<Piece> = Vec::new();
        let section = self.section(table, "boundary");
        for (key, raw) in section.iter().flat_map(|own| &own.entries) {
            if let Some(piece) = self.piece(scope, key, raw, intervals, &declared) {
                found.push(piece);
            }
        }
        self.missing_pieces(table, scope, intervals, &declared, &found);
        let unsaid = declared.iter().filter(|name| {
            let mut all = found.iter();
            !all.any(|own| own.name == name.content)
        });
        let unsaid: Vec<Piece> = unsaid.map(|name| nothing_on(scope, name)).collect();
        found.extend(unsaid);
        found
    }

    fn piece(
        &mut self,
        scope: &Scope,
        key: &Text,
        raw: &Raw,
        intervals: &[Interval],
        declared: &[Text],
    ) -> Option<Piece> {
        let own = raw.table();
        if let Some(own) = own {
            self.known_keys(
                own,
                &["density", "at", "fixed", "description"],
                "a piece of the boundary",
            );
        }
        let text = match own {
            Some(own) => self.optional(own, "density"),
            None => self.text_of(raw, "density"),
        };
        let at = own.and_then(|own| self.optional(own, "at"));
        let is_declared = declared.iter().any(|name| name.content == key.content);
        let side = match (at, is_declared) {
            (Some(at), _) => self.side(scope, &at, intervals)?,
            (None, true) => Side::Curved,
            (None, false) if !intervals.is_empty() => self.side(scope, key, intervals)?,
            (None, false) => {
                let message = format!("`{}` is not a piece of the boundary", key.content);
                let diagnostic = Diagnostic::error("unknown-piece", key.place, message);
                let names = declared.iter().map(|name| name.content.as_str());
                let near = closest(&key.content, names);
                self.push(match near {
                    Some(near) => diagnostic
                        .hint(format!("did you mean `{near}`?"))
                        .suggest(key.place, near),
                    None => diagnostic
                        .hint("[domain] boundary = [\"S_u\", \"S_s\"] declares the pieces"),
                });
                return None;
            }
        };
        // A piece with a mistake in its density is still a piece.
        let own_density = text.as_ref().and_then(|text| self.scalar_tree(scope, text));
        let (tree, density) = match own_density {
            Some((tree, density)) => (Some(tree), density),
            None => (None, scope.space.graph.zero()),
        };
        let density = on_side(scope, &side, density);
        let fixed = match own.and_then(|own| own.get("fixed")) {
            Some(raw) => self.fixed(scope, raw),
            None => Vec::new(),
        };
        Some(Piece {
            name: key.content.clone(),
            side,
            density,
            tree,
            written: text.map_or_else(|| "0".to_owned(), |text| text.content),
            fixed,
        })
    }

    /// `x = a` as a face of the box.
    pub(super) fn side(
        &mut self,
        scope: &Scope,
        text: &Text,
        intervals: &[Interval],
    ) -> Option<Side> {
        let mut found = Vec::new();
        let sides = parse_sides(&text.content, scope, &mut found);
        if !self.add(text, &found) {
            return None;
        }
        let g = &scope.space.graph;
        let values = sides.and_then(|(left, right)| {
            let places = BTreeMap::new();
            Some((scope.value(&left, &places), scope.value(&right?, &places)))
        });
        for interval in intervals {
            let own = scope.space.coordinates[interval.axis].expr;
            if let Some((left, right)) = values {
                for (at, is_upper) in [(interval.lower, false), (interval.upper, true)] {
                    if left == own && g.is_zero(g.sub(right, at)) {
                        let axis = interval.axis;
                        return Some(Side::Flat { axis, is_upper, at });
                    }
                }
            }
        }
        let message = format!(
            "`{}` is not a face of the box in [domain] intervals",
            text.content
        );
        self.push(Diagnostic::error("unknown-piece", text.place, message));
        None
    }

    /// Components that are given on a piece; `w,n` gives the normal derivative.
    fn fixed(&mut self, scope: &Scope, raw: &Raw) -> Vec<(usize, bool)> {
        let mut found = Vec::new();
        for text in self.texts(raw, "fixed") {
            let (name, is_normal) = match text.content.strip_suffix(",n") {
                Some(name) => (name, true),
                None => (text.content.as_str(), false),
            };
            let head = name.split('_').next().unwrap_or(name);
            let is_definition = scope.definitions.contains_key(head);
            let own = scope.tensors.get(name).map(|own| own.components.clone());
            let own = own
                .or_else(|| component_named(scope, name))
                .filter(|_| !is_definition);
            let Some(own) = own else {
                let message = if is_definition {
                    format!("`{name}` is a definition, not a field: `fixed` names the fields that are given")
                } else {
                    format!("`{name}` is not a field")
                };
                let diagnostic = Diagnostic::error("unknown-name", text.place, message);
                let of_field = name.split_once(',').map(|(field, _)| field);
                let of_field = of_field.filter(|field| scope.tensors.contains_key(*field));
                self.push(match of_field {
                    Some(field) => diagnostic.hint(format!(
                        "\"{field}\" gives its values, and with them the derivatives along the piece; \"{field},n\" the one along the normal"
                    )),
                    None => diagnostic,
                });
                continue;
            };
            let jets = scope.space.jets_in(&own);
            let given = jets.into_iter().map(|jet| (jet.component, is_normal));
            let given: Vec<(usize, bool)> = given.collect();
            if given.iter().any(|own| found.contains(own)) {
                self.is_twice(&text.content, text.place);
            }
            found.extend(given);
        }
        found
    }

    /// What is given on a piece is a field: data are given everywhere.
    fn fixed_are_fields(&mut self, table: &Table, data: &[Field], pieces: &[Piece]) {
        let section = table.get("boundary").and_then(Raw::table);
        for piece in pieces {
            let is_fixed = |own: &&Field| {
                let mut all = piece.fixed.iter();
                all.any(|(component, _)| own.components.contains(component))
            };
            let Some(own) = data.iter().find(is_fixed) else {
                continue;
            };
            let entry = section.and_then(|own| own.get(&piece.name)?.table()?.get("fixed"));
            let place = entry.map_or(Place::default(), |raw| raw.place);
            let message = format!(
                "`{}` is data, which are given everywhere; `fixed` names fields that are not varied on {}",
                own.name, piece.name
            );
            self.push(
                Diagnostic::error("bad-fixed", place, message)
                    .hint("u for the values of a field, \"u,n\" for its normal derivative"),
            );
        }
    }

    /// Every declared piece and every face of the box must be spoken of: what is forgotten would be free.
    fn missing_pieces(
        &mut self,
        table: &Table,
        scope: &Scope,
        intervals: &[Interval],
        declared: &[Text],
        found: &[Piece],
    ) {
        let place = table.get("boundary").map(|raw| raw.place);
        let place = place
            .or(table.get("domain").map(|raw| raw.place))
            .unwrap_or_default();
        let section = table.get("boundary").and_then(Raw::table);
        for (at, name) in declared.iter().enumerate() {
            if declared[..at].iter().any(|own| own.content == name.content) {
                self.is_twice(&name.content, name.place);
                continue;
            }
            // What is wrong with what is said has been told.
            let is_said = section.is_some_and(|own| own.get(&name.content).is_some());
            if !is_said && found.iter().all(|piece| piece.name != name.content) {
                let message = format!(
                    "nothing is said of the piece `{}` of the boundary",
                    name.content
                );
                self.push(
                    Diagnostic::error("missing-piece", name.place, message).hint(format!(
                        "add [boundary] {} = \"0\" where it is free, or {{ fixed = [\"u\"] }}",
                        name.content
                    )),
                );
            }
        }
        let g = &scope.space.graph;
        for interval in intervals {
            let coordinate = &scope.space.coordinates[interval.axis];
            if coordinate.is_time {
                continue;
            }
            for (own, end) in [(false, interval.lower), (true, interval.upper)] {
                let is_there = found.iter().any(|piece| {
                    matches!(piece.side, Side::Flat { axis, is_upper, .. } if axis == interval.axis && is_upper == own)
                });
                if !is_there {
                    let face = format!("{} = {}", coordinate.name, g.text(end));
                    let message = format!("nothing is said of the face {face} of the box");
                    self.push(
                        Diagnostic::error("missing-piece", place, message).hint(format!(
                            "add [boundary] \"{face}\" = \"0\" where it is free"
                        )),
                    );
                }
            }
        }
    }

    fn equations(
        &mut self,
        table: &Table,
        scope: &Scope,
        pieces: &[Piece],
        living: &Living<'_>,
    ) -> Vec<Equation> {
        let mut found = Vec::new();
        let imposed = table.get("imposed").map(|raw| self.texts(raw, "imposed"));
        let yields = table.get("yields").map(|raw| self.texts(raw, "yields"));
        let (imposed, yields) = (imposed.unwrap_or_default(), yields.unwrap_or_default());
        self.said_once(&imposed, &yields);
        let solvable = table.get("solvable").map(|raw| self.texts(raw, "solvable"));
        let solvable = solvable.unwrap_or_default();
        self.imposed_too(&solvable, &imposed);
        let section = self.section(table, "equations");
        let entries = section.map_or(&[][..], |own| &own.entries);
        for (key, raw) in entries {
            let role = match &key.content {
                label if imposed.iter().any(|text| text.content == *label) => Role::Imposed,
                label if yields.iter().any(|text| text.content == *label) => Role::Yielded,
                _ => Role::Other,
            };
            let mut own = self.equation(table, scope, pieces, (key, raw), role);
            if let Some(own) = &mut own {
                own.is_solvable = solvable.iter().any(|text| text.content == own.label);
                self.equation_lives(table, living, own, raw);
            }
            found.extend(own);
        }
        for text in imposed.iter().chain(&yields).chain(&solvable) {
            if entries.iter().all(|(key, _)| key.content != text.content) {
                let message = format!("there is no equation `{}`", text.content);
                self.push(
                    Diagnostic::error("unknown-equation", text.place, message)
                        .hint("[equations] states them"),
                );
            }
        }
        self.multiplied(table, &imposed, entries);
        found
    }

    /// Only of an equation that is imposed it matters whether it is solvable.
    fn imposed_too(&mut self, solvable: &[Text], imposed: &[Text]) {
        for text in solvable {
            if !imposed.iter().any(|own| own.content == text.content) {
                let label = &text.content;
                let message = format!("`{label}` stands under `solvable`, and is not imposed");
                let hint = format!("add \"{label}\" to `imposed`, or take it out of `solvable`");
                let own = Diagnostic::error("unused-solvable", text.place, message);
                self.push(own.hint(hint));
            }
        }
    }

    /// A multiplier is that of an equation, and of one that is imposed.
    fn multiplied(&mut self, table: &Table, imposed: &[Text], entries: &[(Text, Raw)]) {
        let section = self.section(table, "multipliers");
        for (key, _) in section.map_or(&[][..], |own| &own.entries) {
            let label = &key.content;
            let is_own = |text: &Text| text.content == *label;
            let known = entries.iter().map(|(key, _)| key);
            let diagnostic = if !known.clone().any(is_own) {
                let message = format!("there is no equation `{label}`");
                let unknown = Diagnostic::error("unknown-equation", key.place, message);
                match closest(label, known.map(|text| text.content.as_str())) {
                    Some(near) => unknown
                        .hint(format!("did you mean `{near}`?"))
                        .suggest(key.place, near),
                    None => unknown.hint("[equations] states them"),
                }
            } else if !imposed.iter().any(is_own) {
                let message = format!("`{label}` has a multiplier, and is not imposed");
                Diagnostic::error("unused-multiplier", key.place, message).hint(format!(
                    "add \"{label}\" to `imposed`, or take the multiplier out"
                ))
            } else {
                continue;
            };
            self.push(diagnostic);
        }
    }

    /// An equation is imposed, or claimed to follow, and is named once.
    fn said_once(&mut self, imposed: &[Text], yields: &[Text]) {
        let all = imposed
            .iter()
            .map(|text| (text, "imposed"))
            .chain(yields.iter().map(|text| (text, "yields")));
        let all: Vec<(&Text, &str)> = all.collect();
        for (at, (text, list)) in all.iter().enumerate() {
            let same = |(other, _): &&(&Text, &str)| other.content == text.content;
            let Some((_, before)) = all[..at].iter().find(same) else {
                continue;
            };
            let label = &text.content;
            let (message, hint) = if before == list {
                (
                    format!("`{label}` stands twice under `{list}`"),
                    "name it once",
                )
            } else {
                (
                    format!("`{label}` stands under `imposed` and under `yields`"),
                    "what is imposed holds beforehand, and is not what follows: take it out of one of the two",
                )
            };
            self.push(Diagnostic::error("declared-twice", text.place, message).hint(hint));
        }
    }

    fn equation(
        &mut self,
        table: &Table,
        scope: &Scope,
        pieces: &[Piece],
        (key, raw): (&Text, &Raw),
        role: Role,
    ) -> Option<Equation> {
        let own = raw.table();
        if let Some(own) = own {
            self.known_keys(own, &["equation", "on", "title"], "an equation");
        }
        let text = match own {
            Some(own) => self.optional(own, "equation"),
            None => self.text_of(raw, "equation"),
        }?;
        let on = own.and_then(|own| self.optional(own, "on"));
        let title = own.and_then(|own| self.optional(own, "title"));
        // A statement about fields that this functional does not have is none of its.
        if role == Role::Other {
            let mut problems = Vec::new();
            parse_sides(&text.content, scope, &mut problems);
            if problems.iter().any(|d| d.code == "unknown-name") {
                return None;
            }
        }
        let (residuals, letters) = self.residuals(scope, &text)?;
        let here = match &on {
            Some(on) => self.meeting(scope, pieces, on)?,
            None => Vec::new(),
        };
        let on_all = |e: Expr| here.iter().fold(e, |e, own| on_side(scope, &own.side, e));
        let residuals = residuals.into_iter().map(on_all).collect();
        let names: Vec<&str> = here.iter().map(|own| own.name.as_str()).collect();
        let multiplier = self.multiplier(table, scope, &key.content, &letters);
        Some(Equation {
            label: key.content.clone(),
            written: text.content.clone(),
            title: title.map_or(String::new(), |text| text.content),
            on: on.map(|_| place_of(&names)),
            residuals,
            role,
            is_solvable: false,
            multiplier,
            place: text.place,
        })
    }

    /// The piece that `on` names, or several that meet, in the order in which the boundary has them.
    fn meeting<'p>(
        &mut self,
        scope: &Scope,
        pieces: &'p [Piece],
        on: &Text,
    ) -> Option<Vec<&'p Piece>> {
        let names = names_in(&on.content);
        if let Some(name) = names
            .iter()
            .find(|name| !pieces.iter().any(|own| own.name == **name))
        {
            let message = format!("`{name}` is not a piece of the boundary");
            self.push(Diagnostic::error("unknown-piece", on.place, message));
            return None;
        }
        let here: Vec<&Piece> = pieces
            .iter()
            .filter(|own| names.contains(&own.name.as_str()))
            .collect();
        let is_flat = |own: &Piece| matches!(own.side, Side::Flat { .. });
        let mut pairs = here
            .iter()
            .enumerate()
            .flat_map(|(at, one)| here[at + 1..].iter().map(move |other| (one, other)));
        let apart = pairs.find(|(one, other)| is_flat(one) && is_flat(other) && !one.meets(other));
        let dimensions = scope.space.dimensions();
        let message = match apart {
            _ if here.len() < names.len() => "a piece is named twice".to_owned(),
            Some((one, other)) => format!("`{}` and `{}` do not meet", one.name, other.name),
            None if here.len() > dimensions => format!(
                "{} pieces do not meet in {dimensions} dimensions",
                here.len()
            ),
            None => return Some(here),
        };
        let hint = "an equation that holds on several pieces is stated on each of them; with commas it holds where they meet only";
        self.push(Diagnostic::error("no-meeting", on.place, message).hint(hint));
        None
    }

    fn multiplier(
        &mut self,
        table: &Table,
        scope: &Scope,
        label: &str,
        letters: &[char],
    ) -> Option<(String, Vec<Expr>)> {
        let section = table.get("multipliers").and_then(Raw::table)?;
        let raw = section.get(label)?;
        let text = self.text_of(raw, label)?;
        let node = self.node(scope, &text, None)?;
        let own = free_letters(&node);
        if own.len() != letters.len() {
            let message = format!(
                "the multiplier of `{label}` has {} free indices, and the equation {}",
                own.len(),
                letters.len()
            );
            self.push(Diagnostic::error("index-mismatch", text.place, message));
            return None;
        }
        Some((text.content, scope.components(&node, &own)))
    }

    pub(super) fn expected(&mut self, table: &Table) -> Vec<(String, Vec<String>)> {
        let mut found = Vec::new();
        let Some(section) = self.section(table, "expect") else {
            return found;
        };
        for (key, raw) in &section.entries {
            let words = match &raw.kind {
                Kind::Table(_) => {
                    self.wrong_kind(raw, &key.content, "a verdict");
                    continue;
                }
                _ => self.texts(raw, &key.content),
            };
            found.push((
                key.content.clone(),
                words.into_iter().map(|w| w.content).collect(),
            ));
        }
        found
    }
}

/// Every place is inside of the box.
fn inside(scope: &Scope, intervals: &[Interval]) {
    for own in intervals {
        let place = scope.space.coordinates[own.axis].expr;
        for (left, right) in [
            (own.lower, own.upper),
            (own.lower, place),
            (place, own.upper),
        ] {
            let relation = Relation::Less;
            scope.space.assume(Assumption {
                left,
                relation,
                right,
            });
        }
    }
}

/// The component of a field or of data that a name with indices is: `u_1`, `s_12`.
fn component_named(scope: &Scope, name: &str) -> Option<Vec<Expr>> {
    let mut problems = Vec::new();
    let node = parse(name, scope, &mut problems)?;
    let crate::notation::Kind::Atom(atom) = &node.kind else {
        return None;
    };
    let is_plain = atom.derivatives.is_empty() && atom.argument.is_none() && atom.primes == 0;
    let is_place = |own: &Index| matches!(own, Index::Place(_));
    let is_component = is_plain && !atom.indices.is_empty() && atom.indices.iter().all(is_place);
    check(&node, &[], scope, &mut problems);
    (is_component && problems.is_empty()).then(|| scope.components(&node, &[]))
}

/// The name of what is defined, without its letters.
fn head_of(key: &Text) -> &str {
    key.content
        .rsplit_once('_')
        .map_or(key.content.as_str(), |own| own.0)
}

/// A piece of which nothing is said.
fn nothing_on(scope: &Scope, name: &Text) -> Piece {
    Piece {
        name: name.content.clone(),
        side: Side::Curved,
        density: scope.space.graph.zero(),
        tree: None,
        written: "0".to_owned(),
        fixed: Vec::new(),
    }
}

/// What holds on a piece: on a face of a box the normal is known, and the variable across it.
pub(crate) fn on_side(scope: &Scope, side: &Side, e: Expr) -> Expr {
    let Side::Flat { axis, is_upper, at } = side else {
        return e;
    };
    let g = &scope.space.graph;
    let symbols = scope.space.normals();
    let e = scope.space.at(scope.space.on_plane(e), *axis, *at);
    scope.space.replace(e, &|symbol| {
        let at = symbols.iter().position(|&n| n == symbol)?;
        Some(match (at == *axis, is_upper) {
            (true, true) => g.one(),
            (true, false) => g.integer(-1),
            (false, _) => g.zero(),
        })
    })
}

/// The unit tensor, the permutation symbol, the normal, the curvature and the place.
fn builtin(scope: &mut Scope) {
    let g = &scope.space.graph;
    let d = scope.space.dimensions();
    let truth = |holds: bool| if holds { g.one() } else { g.zero() };
    let unit = tuples(2, d).iter().map(|t| truth(t[0] == t[1])).collect();
    let curvature = tuples(2, d)
        .iter()
        .map(|t| scope.space.curvature(t[0], t[1]))
        .collect();
    let permutation = tuples(d, d).iter().map(|t| g.integer(sign(t))).collect();
    let own = [
        ("delta", 2, unit),
        ("epsilon", d, permutation),
        ("n", 1, scope.space.normal()),
        (crate::boundary::CURVATURE, 2, curvature),
    ];
    for (name, rank, components) in own {
        scope
            .tensors
            .insert(name.into(), Tensor { rank, components });
    }
    let family = scope
        .space
        .coordinates
        .first()
        .and_then(|c| c.name.strip_suffix("_1"));
    if let Some(letter) = family.map(str::to_owned) {
        let components = scope
            .space
            .coordinates
            .iter()
            .take(d)
            .map(|c| c.expr)
            .collect();
        scope.tensors.insert(
            letter,
            Tensor {
                rank: 1,
                components,
            },
        );
    }
}

/// The sign of a permutation; 0 where two are equal.
fn sign(tuple: &[usize]) -> i64 {
    let mut sign = 1;
    for i in 0..tuple.len() {
        for j in i + 1..tuple.len() {
            sign *= (tuple[j] as i64 - tuple[i] as i64).signum();
        }
    }
    sign
}
