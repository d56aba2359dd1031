//! Declarations: sizes, indices, coordinates, parameters, controls, with families expanded.

use chetaev_symbolic::print::StatedSymbol;
use chetaev_symbolic::syntax::ast::{NamePart, Node};
use chetaev_symbolic::syntax::lower::{expand_name, Bindings};
use chetaev_symbolic::syntax::{functions, names, parse_expression, parse_range};
use chetaev_symbolic::{Expr, Rational};

use super::formula::Expected;
use super::scope::{Context, ModelScope, Named, NamedKind};
use super::{start_of, Resolver};
use crate::diagnostic::Diagnostic;
use crate::model::{Control, Coordinate};
use crate::raw::{Kind, Raw, Table};
use crate::source::Place;
use crate::text::Text;
use crate::units::{parse_unit, Unit};

/// An index with its range, both ends included.
#[derive(Clone, Debug)]
pub(crate) struct Index {
    pub(crate) name: String,
    pub(crate) first: i64,
    pub(crate) last: i64,
}

/// One member of a family.
#[derive(Clone, Debug)]
pub(crate) struct Instance {
    pub(crate) name: String,
    pub(crate) order: u32,
    pub(crate) bindings: Bindings,
}

/// Where a control depends on the state.
const FEEDBACK: &str = "state feedback belongs to [forces]: a force there may depend on coordinates and velocities, and needs no control";

/// Most members of a family.
const MOST_INSTANCES: i128 = 5_000;

impl Resolver {
    // ---- sizes and indices

    pub(crate) fn declare_sizes(&mut self, root: &Table) {
        if let Some(table) = self.section(root, "sizes") {
            for (key, raw) in &table.entries {
                let name = names::normalized(&key.content);
                let outside = self.take_override(&name);
                let value = match outside {
                    Some(text) => self.integer(
                        &Raw {
                            place: text.place,
                            kind: Kind::Text(text),
                        },
                        "a size",
                    ),
                    None => self.integer(raw, "a size"),
                };
                if let (true, Some(value)) = (
                    self.declare(key, &name, NamedKind::Size(value.unwrap_or(1))),
                    value,
                ) {
                    self.sizes.push((name, value));
                }
            }
        }
        if let Some(table) = self.section(root, "indices") {
            for (key, raw) in &table.entries {
                let Some(text) = self.expression_text(raw, "the range of an index") else {
                    continue;
                };
                let name = names::normalized(&key.content);
                if functions::is_reserved(&name) {
                    self.reserved(key, &name, "an index");
                } else if let Some(named) = self.names.get(&name).copied() {
                    let message = format!(
                        "`{name}` is {} already, and cannot name an index too",
                        named.kind.word()
                    );
                    let diagnostic = Diagnostic::error("declared-twice", key.place, message);
                    self.push(diagnostic.related(named.place, "first here"));
                } else if let Some((first, last)) = self.range(&text) {
                    self.indices.push(Index { name, first, last });
                }
            }
        }
    }

    pub(crate) fn range(&mut self, text: &Text) -> Option<(i64, i64)> {
        let parsed = self.parse(text, parse_range);
        let [first, last] = *parsed.sides.as_slice() else {
            return None;
        };
        let mut ends = [0; 2];
        for (end, side) in ends.iter_mut().zip([first, last]) {
            let value = self.lower(text, &parsed, side, &Vec::new(), Context::number("a range"))?;
            let Some(whole) = self.graph.as_integer(value) else {
                let place = text.place_of(parsed.tree.span(side));
                self.push(Diagnostic::error(
                    "bad-range",
                    place,
                    "the ends of a range must be integers",
                ));
                return None;
            };
            *end = whole;
        }
        Some((ends[0], ends[1]))
    }

    // ---- names

    /// The members of the family that a key names; one for a plain name. Problems are reported, and give none.
    pub(crate) fn instances(&mut self, key: &Text, what: &str, extra: &[Index]) -> Vec<Instance> {
        let name = names::normalized(&key.content);
        if functions::is_reserved(&name) {
            self.reserved(key, &name, what);
            return Vec::new();
        }
        let parsed = parse_expression(&key.content);
        let Node::Name { parts, .. } = parsed.tree.node(parsed.root()) else {
            let message = format!("`{}` cannot be the name of {what}", key.content);
            self.push(Diagnostic::error("bad-name", key.place, message).hint(
                "names are made of Latin and Greek letters, digits and underscores, as in theta_1 or theta_{i}",
            ));
            return Vec::new();
        };
        if parsed.has_errors() {
            self.parse(key, parse_expression);
            return Vec::new();
        }
        let used: Vec<Index> = self.indices_in(&parsed, parts, extra);
        if !self.is_small_family(&used, key) {
            return Vec::new();
        }
        let scope = ModelScope {
            resolver: self,
            context: Context::number("an index"),
            wanted: Default::default(),
        };
        let mut found = Vec::new();
        let mut instances = Vec::new();
        for bindings in all_bindings(&used) {
            if let Some((name, order)) = expand_name(
                &self.graph,
                &parsed.tree,
                parsed.root(),
                &scope,
                &bindings,
                &mut found,
            ) {
                instances.push(Instance {
                    name,
                    order,
                    bindings,
                });
            }
        }
        for diagnostic in &found {
            let mut diagnostic = Diagnostic::of_expression(diagnostic, key);
            if diagnostic.code == "unknown-name" && diagnostic.hints.is_empty() {
                diagnostic = diagnostic
                    .hint("state the range of the index under [indices], as in i = \"1..n\"");
            }
            self.push(diagnostic);
        }
        instances
    }

    /// Whether the indices have few enough values together; else a diagnostic.
    pub(crate) fn is_small_family(&mut self, indices: &[Index], key: &Text) -> bool {
        let counts = indices
            .iter()
            .map(|index| (i128::from(index.last) - i128::from(index.first) + 1).max(0));
        let small = counts.fold(1, i128::saturating_mul) <= MOST_INSTANCES;
        if !small {
            let message = format!("a family has {MOST_INSTANCES} members at most");
            self.push(Diagnostic::error("too-large", key.place, message));
        }
        small
    }

    /// The declared indices that occur in an expression outside of its own sums.
    pub(crate) fn free_indices(&self, parsed: &chetaev_symbolic::syntax::Parsed) -> Vec<Index> {
        let bound = |name: &str| {
            parsed
                .tree
                .iter()
                .any(|(_, node)| matches!(node, Node::Sum { index, .. } if index == name))
        };
        let mut used: Vec<Index> = Vec::new();
        for (id, _) in parsed.tree.iter() {
            let Some((name, _)) = parsed.tree.plain_name(id) else {
                continue;
            };
            if bound(name) || used.iter().any(|own| own.name == name) {
                continue;
            }
            used.extend(
                self.indices
                    .iter()
                    .find(|index| index.name == name)
                    .cloned(),
            );
        }
        used
    }

    fn indices_in(
        &self,
        parsed: &chetaev_symbolic::syntax::Parsed,
        parts: &[NamePart],
        extra: &[Index],
    ) -> Vec<Index> {
        if parts.iter().all(|part| matches!(part, NamePart::Text(_))) {
            return Vec::new();
        }
        let root = parsed.root();
        let mut used: Vec<Index> = Vec::new();
        for (id, _) in parsed.tree.iter().filter(|(id, _)| *id != root) {
            let Some((name, _)) = parsed.tree.plain_name(id) else {
                continue;
            };
            let known = extra
                .iter()
                .chain(&self.indices)
                .find(|index| index.name == name);
            if let Some(index) = known.filter(|index| used.iter().all(|own| own.name != index.name))
            {
                used.push(index.clone());
            }
        }
        used
    }

    fn reserved(&mut self, key: &Text, name: &str, what: &str) {
        let is = match name {
            "t" => "is the time".to_owned(),
            "pi" => "is the number 3.14159…".to_owned(),
            "sum" => "is the sum over an index".to_owned(),
            _ => "is a function".to_owned(),
        };
        let message = format!("`{}` {is} and cannot name {what}", key.content);
        self.push(
            Diagnostic::error("reserved-name", key.place, message)
                .label("reserved")
                .hint("choose another name"),
        );
    }

    /// Declares a name; false where that is impossible, which is reported.
    pub(crate) fn declare(&mut self, key: &Text, name: &str, kind: NamedKind) -> bool {
        let what = kind.word();
        if functions::is_reserved(name) {
            self.reserved(key, name, what);
            return false;
        }
        let valid = !name.is_empty()
            && name
                .bytes()
                .all(|byte| byte.is_ascii_alphanumeric() || byte == b'_')
            && !name.as_bytes()[0].is_ascii_digit();
        if !valid {
            let message = format!("`{}` cannot be the name of {what}", key.content);
            self.push(
                Diagnostic::error("bad-name", key.place, message)
                    .hint("names are made of Latin letters, digits and underscores"),
            );
            return false;
        }
        for (prefix, meaning) in [
            ("lambda_", "the reactions of constraints"),
            ("kappa_", "the multipliers of the constrained extremum"),
        ] {
            if name.starts_with(prefix) {
                let message = format!("names that begin with `{prefix}` are those of {meaning}, and cannot name {what}");
                self.push(Diagnostic::error("reserved-name", key.place, message).label("reserved"));
                return false;
            }
        }
        if let Some(index) = self.indices.iter().find(|index| index.name == name) {
            let message = format!("`{}` is an index, and cannot name {what} too", index.name);
            self.push(Diagnostic::error("declared-twice", key.place, message));
            return false;
        }
        if let Some(earlier) = self.names.get(name).copied() {
            let message = format!(
                "`{name}` is {} already, and cannot name {what} too",
                earlier.kind.word()
            );
            self.push(
                Diagnostic::error("declared-twice", key.place, message)
                    .label("again here")
                    .related(earlier.place, "first here"),
            );
            return false;
        }
        self.names.insert(
            name.to_owned(),
            Named {
                kind,
                place: key.place,
            },
        );
        true
    }

    // ---- coordinates

    pub(crate) fn declare_coordinates(&mut self, root: &Table, file: Place) {
        let Some(raw) = root.get("coordinates") else {
            self.push(
                Diagnostic::error(
                    "missing-section",
                    start_of(file),
                    "the model has no coordinates",
                )
                .hint("add `coordinates = [\"x\", \"y\"]` at the top"),
            );
            return;
        };
        match &raw.kind {
            Kind::Array(items) => {
                for item in items {
                    match &item.kind {
                        Kind::Text(name) => self.declare_coordinate(name, None, String::new()),
                        _ => self.wrong_kind(item, "a coordinate", "a text, its name"),
                    }
                }
            }
            Kind::Table(table) => {
                for (key, raw) in &table.entries {
                    let before = self.diagnostics.len();
                    let (unit, description) = match &raw.kind {
                        Kind::Text(unit) => (self.unit(unit), String::new()),
                        Kind::Table(table) => {
                            let known = ["unit", "description", "latex"];
                            self.known_keys(table, &known, "of a coordinate");
                            self.symbol(key, table);
                            self.unit_and_description(table)
                        }
                        _ => {
                            self.wrong_kind(
                                raw,
                                "a coordinate",
                                "its unit as a text, or a table with `unit` and `description`",
                            );
                            (None, String::new())
                        }
                    };
                    self.excuse_unit(key, before);
                    self.declare_coordinate(key, unit, description);
                }
            }
            _ => self.wrong_kind(raw, "`coordinates`", "an array of names, or a table"),
        }
        if self.coordinates.is_empty() && self.diagnostics.is_empty() {
            self.push(Diagnostic::error(
                "missing-section",
                raw.place,
                "the model has no coordinates",
            ));
        }
    }

    fn declare_coordinate(&mut self, key: &Text, unit: Option<Unit>, description: String) {
        let unit = self.coherent(unit, key.place, "a coordinate");
        for instance in self.instances(key, "a coordinate", &[]) {
            if instance.order > 0 {
                let message = format!(
                    "`{}` is a derivative; coordinates are declared without primes",
                    key.content
                );
                self.push(Diagnostic::error("bad-name", key.place, message));
                return;
            }
            if self.declare(key, &instance.name, NamedKind::Coordinate) {
                let symbol = self.graph.symbol(&instance.name, 0);
                let description = description.clone();
                self.coordinates.push(Coordinate {
                    name: instance.name,
                    symbol,
                    unit: unit.clone(),
                    description,
                    place: key.place,
                });
            }
        }
    }

    // ---- units

    /// A unit without prefix; another one is reported, and none is left.
    pub(crate) fn coherent(
        &mut self,
        mut unit: Option<Unit>,
        place: Place,
        what: &str,
    ) -> Option<Unit> {
        if let Some(own) = unit.take_if(|unit| !unit.is_coherent()) {
            let message = format!(
                "{what} is measured in an SI unit without prefix, not in `{}`",
                own.text
            );
            let hint = if own.dimension.is_none() {
                "rad".to_owned()
            } else {
                own.dimension.to_string()
            };
            self.without_blame.push(place);
            self.push(
                Diagnostic::error("incoherent-unit", place, message)
                    .hint(format!("state it in {hint}")),
            );
        }
        unit
    }

    pub(crate) fn unit(&mut self, text: &Text) -> Option<Unit> {
        match parse_unit(&text.content) {
            Ok(unit) => Some(unit),
            Err(problems) => {
                for problem in &problems {
                    self.push(Diagnostic::of_expression(problem, text));
                }
                None
            }
        }
    }

    /// A quantity whose unit is wrong, as a diagnostic since `before` says, is not blamed for having none.
    pub(crate) fn excuse_unit(&mut self, key: &Text, before: usize) {
        if self.diagnostics.len() > before {
            self.without_blame.push(key.place);
        }
    }

    /// Keeps the symbol in LaTeX that is stated for a name.
    pub(crate) fn symbol(&mut self, key: &Text, table: &Table) {
        let Some(latex) = self.optional_text(table, "latex") else {
            return;
        };
        if key.content.contains('{') {
            let message = format!(
                "`{}` stands for several names, and one symbol does not",
                key.content
            );
            self.push(
                Diagnostic::error("bad-symbol", latex.place, message)
                    .hint("leave `latex` out: the members of a family are typeset by their names"),
            );
            return;
        }
        match StatedSymbol::read(&latex.content) {
            Ok(_) => {
                let name = names::normalized(&key.content);
                self.symbols.insert(name, latex.content.trim().to_owned());
            }
            Err(why) => {
                let message = format!("this symbol cannot be typeset: {why}");
                self.push(Diagnostic::error("bad-symbol", latex.place, message).hint(
                    "a symbol is made of letters, digits, Greek letters, accents, \\mathrm{word}, and sub- and superscripts: '\\dot\\theta', 'C_c'",
                ));
            }
        }
    }

    pub(crate) fn unit_and_description(&mut self, table: &Table) -> (Option<Unit>, String) {
        let unit = self
            .optional_text(table, "unit")
            .and_then(|text| self.unit(&text));
        let description = self
            .optional_text(table, "description")
            .map_or_else(String::new, |text| text.content.trim().to_owned());
        (unit, description)
    }

    /// A value given in a unit, in SI base units.
    pub(crate) fn in_base_units(&self, value: Expr, unit: Option<&Unit>) -> Expr {
        match unit {
            Some(unit) if !unit.is_coherent() => {
                let scaled = self.graph.scale(&unit.factor, value);
                let pi = self
                    .graph
                    .pow(self.graph.pi(), self.graph.number(Rational::from(unit.pi)));
                self.graph.mul(&[scaled, pi])
            }
            _ => value,
        }
    }

    // ---- controls

    pub(crate) fn declare_controls(&mut self, root: &Table) {
        let Some(table) = self.section(root, "controls") else {
            return;
        };
        for (key, raw) in &table.entries {
            let before = self.diagnostics.len();
            let (unit, description) = match &raw.kind {
                Kind::Table(table) => {
                    let known = ["value", "unit", "description", "latex"];
                    self.known_keys(table, &known, "of a control");
                    self.symbol(key, table);
                    self.unit_and_description(table)
                }
                _ => (None, String::new()),
            };
            self.excuse_unit(key, before);
            for instance in self.instances(key, "a control", &[]) {
                if instance.order > 0 {
                    let message = format!(
                        "`{}` is a derivative; controls are declared without primes",
                        key.content
                    );
                    self.push(Diagnostic::error("bad-name", key.place, message));
                    break;
                }
                if self.declare(key, &instance.name, NamedKind::Control) {
                    let symbol = self.graph.symbol(&instance.name, 0);
                    let (unit, description) = (unit.clone(), description.clone());
                    self.controls.push(Control {
                        name: instance.name,
                        symbol,
                        law: None,
                        unit,
                        description,
                        place: key.place,
                    });
                }
            }
        }
    }

    pub(crate) fn resolve_controls(&mut self, root: &Table) {
        let Some(table) = root.get("controls").and_then(Raw::table) else {
            return;
        };
        for (key, raw) in &table.entries {
            let value = match &raw.kind {
                Kind::Table(table) => table.get("value"),
                _ => Some(raw),
            };
            let Some(value) = value else { continue };
            let Some(text) = self.expression_text(value, "a control") else {
                continue;
            };
            for instance in self.instances_again(key) {
                let Some(at) = self
                    .controls
                    .iter()
                    .position(|control| control.name == instance.name)
                else {
                    continue;
                };
                let expected = Expected::Quantity(instance.name.clone(), 0);
                let law = self.expression(
                    &text,
                    &instance.bindings,
                    Context {
                        hint: FEEDBACK,
                        ..Context::time("a control")
                    },
                    expected,
                );
                self.controls[at].law = law;
            }
        }
    }

    /// The members of a family whose key was looked at before: problems have been reported then.
    pub(crate) fn instances_again(&mut self, key: &Text) -> Vec<Instance> {
        let before = self.diagnostics.len();
        let instances = self.instances(key, "", &[]);
        self.diagnostics.truncate(before);
        instances
    }

    // ---- overrides

    pub(crate) fn take_override(&mut self, name: &str) -> Option<Text> {
        let mut found = None;
        for own in self
            .overrides
            .iter_mut()
            .filter(|own| names::normalized(&own.name.content) == name)
        {
            own.used = true;
            found = Some(own.value.clone());
        }
        found
    }

    pub(crate) fn unused_overrides(&mut self) {
        let unused: Vec<Text> = self
            .overrides
            .iter()
            .filter(|own| !own.used)
            .map(|own| own.name.clone())
            .collect();
        let known: Vec<String> = self
            .parameters
            .iter()
            .map(|parameter| parameter.name.clone())
            .chain(self.sizes.iter().map(|size| size.0.clone()))
            .collect();
        for name in unused {
            let mut diagnostic = Diagnostic::error(
                "unknown-parameter",
                name.place,
                format!("the model has no parameter or size `{}`", name.content),
            );
            diagnostic = match names::closest(
                &names::normalized(&name.content),
                known.iter().map(String::as_str),
            ) {
                Some(near) => diagnostic
                    .hint(format!("did you mean `{near}`?"))
                    .suggest(name.place, near),
                None if known.is_empty() => diagnostic.hint("it has none at all"),
                None => diagnostic.hint(format!("it has {}", known.join(", "))),
            };
            self.push(diagnostic);
        }
    }
}

/// All combinations of the values of some indices, the last one fastest; a single empty one for no index.
pub(crate) fn all_bindings(indices: &[Index]) -> Vec<Bindings> {
    let mut all: Vec<Bindings> = vec![Vec::new()];
    for index in indices {
        all = all
            .iter()
            .flat_map(|bindings| {
                (index.first..=index.last).map(|value| {
                    let mut longer = bindings.clone();
                    longer.push((index.name.clone(), value));
                    longer
                })
            })
            .collect();
    }
    all
}
