//! Sizes, independent variables, fields, data and parameters.

use super::Reader;
use crate::functional::{Field, Interval, Parameter};
use crate::notation::Names;
use crate::space::{Component, Space};
use crate::tensors::{tuples, Scope, Shape, Tensor};
use chetaev_model::raw::{Kind, Raw, Table};
use chetaev_model::{Diagnostic, Place, Text};
use chetaev_symbolic::syntax::names::closest;
use chetaev_symbolic::Expr;
use std::collections::BTreeMap;

/// Most dimensions of space.
const MOST_DIMENSIONS: i64 = 3;

impl Reader<'_> {
    pub(super) fn sizes(&mut self, table: &Table) -> BTreeMap<String, i64> {
        let mut sizes = BTreeMap::new();
        let Some(section) = self.section(table, "sizes") else {
            return sizes;
        };
        for (key, raw) in &section.entries {
            let stated = self.text_of(raw, &key.content);
            if !self.is_free(key) {
                continue;
            }
            let text = self.override_of(&key.content).or(stated);
            let Some(text) = text else { continue };
            match text.content.trim().parse::<i64>() {
                Ok(value) if (0..=1000).contains(&value) => {
                    sizes.insert(key.content.clone(), value);
                }
                _ => {
                    let message =
                        format!("the size `{}` must be a whole number from 0", key.content);
                    self.push(Diagnostic::error("bad-size", text.place, message));
                }
            }
        }
        sizes
    }

    /// The independent variables: name, suffix, whether it is the time.
    fn variables(
        &mut self,
        table: &Table,
        place: Place,
        sizes: &BTreeMap<String, i64>,
    ) -> Option<Vec<(String, String, bool)>> {
        let Some(domain) = self.section(table, "domain") else {
            let message = "a functional needs its independent variables";
            self.push(
                Diagnostic::error("missing-section", place, message).hint(
                    "add [domain] with coordinates = [\"x\", \"y\"] or coordinates = \"x_i\"",
                ),
            );
            return None;
        };
        self.known_keys(
            domain,
            &["coordinates", "time", "intervals", "boundary"],
            "[domain]",
        );
        let Some(raw) = domain.get("coordinates") else {
            let place = table.get("domain").map_or(place, |raw| raw.place);
            self.push(
                Diagnostic::error("missing-key", place, "[domain] has no coordinates").hint(
                    "add coordinates = [\"x\", \"y\"], or coordinates = \"x_i\" with [sizes] d = 2",
                ),
            );
            return None;
        };
        let texts = self.texts(raw, "coordinates");
        let mut found = Vec::new();
        for text in &texts {
            match text.content.split_once('_') {
                Some((letter, "i")) => {
                    let stated = sizes.get("d").copied();
                    let d = stated.unwrap_or(0);
                    if !(1..=MOST_DIMENSIONS).contains(&d) {
                        let message = match stated {
                            Some(d) => format!("the size `d` must be 1, 2 or 3, and is {d}"),
                            // A size that is none was told where it stands.
                            None if self.has_size(table, "d") => return None,
                            None => format!(
                                "the size `d` of the coordinates `{}` is not stated",
                                text.content
                            ),
                        };
                        self.push(
                            Diagnostic::error("bad-size", self.place_of_size(table, raw), message)
                                .hint("state [sizes] d = 2, or give --set d=2"),
                        );
                        return None;
                    }
                    found.extend((1..=d).map(|i| (format!("{letter}_{i}"), i.to_string(), false)));
                }
                _ if !self.is_free(text) => return None,
                _ => found.push((text.content.clone(), text.content.clone(), false)),
            }
        }
        for (at, (name, ..)) in found.iter().enumerate() {
            if found[..at].iter().any(|(before, ..)| before == name) {
                let place = texts.get(at).map_or(raw.place, |text| text.place);
                self.is_twice(name, place);
                return None;
            }
        }
        let names: Vec<&str> = found.iter().map(|(name, ..)| name.as_str()).collect();
        if let Some(at) = (0..names.len()).find(|&at| is_made_of(names[at], names[at], &names)) {
            let place = texts.get(at).map_or(raw.place, |text| text.place);
            let message = format!(
                "`{}` is made of the names of other coordinates: derivatives by it would have two readings",
                names[at]
            );
            self.push(Diagnostic::error("bad-name", place, message).hint("choose another name"));
            return None;
        }
        if found.is_empty() || found.len() as i64 > MOST_DIMENSIONS {
            let message = format!(
                "space has one to {MOST_DIMENSIONS} dimensions, not {}",
                found.len()
            );
            self.push(Diagnostic::error("bad-size", raw.place, message));
            return None;
        }
        if let Some(time) = self.optional(domain, "time") {
            if !self.is_free(&time) {
                return None;
            }
            if found.iter().any(|(before, ..)| *before == time.content) {
                self.is_twice(&time.content, time.place);
                return None;
            }
            found.push((time.content.clone(), time.content, true));
        }
        Some(found)
    }

    fn has_size(&self, table: &Table, name: &str) -> bool {
        let sizes = table.get("sizes").and_then(Raw::table);
        sizes.is_some_and(|own| own.get(name).is_some())
            || self.overrides.iter().any(|(own, _)| own.content == name)
    }

    fn place_of_size(&self, table: &Table, otherwise: &Raw) -> Place {
        let over = self.overrides.iter().find(|(name, _)| name.content == "d");
        let stated = table
            .get("sizes")
            .and_then(Raw::table)
            .and_then(|s| s.get("d"));
        match (over, stated) {
            (Some((_, value)), _) => value.place,
            (None, Some(raw)) => raw.place,
            (None, None) => otherwise.place,
        }
    }

    pub(super) fn space(
        &mut self,
        table: &Table,
        place: Place,
        sizes: &BTreeMap<String, i64>,
    ) -> Option<Space> {
        Some(Space::new(&self.variables(table, place, sizes)?))
    }

    pub(super) fn same_domain(
        &mut self,
        table: &Table,
        sizes: &BTreeMap<String, i64>,
        space: &Space,
    ) -> Option<()> {
        let own = self.variables(table, Place::default(), sizes)?;
        let same = own.len() == space.coordinates.len()
            && own
                .iter()
                .zip(&space.coordinates)
                .all(|((name, _, _), known)| *name == known.name);
        if !same {
            let place = table
                .get("domain")
                .map_or(Place::default(), |raw| raw.place);
            let message =
                "this functional has other independent variables than the one that names it";
            self.push(Diagnostic::error("other-domain", place, message));
        }
        same.then_some(())
    }

    pub(super) fn intervals(&mut self, table: &Table, scope: &Scope) -> Vec<Interval> {
        let mut found = Vec::new();
        let Some(domain) = table.get("domain").and_then(Raw::table) else {
            return found;
        };
        let Some(section) = self.section(domain, "intervals") else {
            return found;
        };
        found.extend(self.intervals_of(section, scope));
        found
    }

    /// The intervals of a table: variable = [smaller end, larger end].
    pub(super) fn intervals_of(&mut self, section: &Table, scope: &Scope) -> Vec<Interval> {
        let mut found = Vec::new();
        for (key, raw) in &section.entries {
            let Some(axis) = scope.coordinate(&key.content) else {
                let message = format!("`{}` is not an independent variable", key.content);
                self.push(Diagnostic::error("unknown-name", key.place, message));
                continue;
            };
            let ends = self.texts(raw, &key.content);
            let values: Vec<Expr> = ends
                .iter()
                .filter_map(|end| self.scalar(scope, end))
                .collect();
            match values[..] {
                [lower, upper] => {
                    self.is_not_empty(scope, (lower, upper), raw);
                    found.push(Interval { axis, lower, upper });
                }
                _ => {
                    let message = "an interval has two ends";
                    self.push(Diagnostic::error("wrong-length", raw.place, message));
                }
            }
        }
        found
    }

    /// An interval whose ends are numbers has a length.
    fn is_not_empty(&mut self, scope: &Scope, (lower, upper): (Expr, Expr), raw: &Raw) {
        let g = &scope.space.graph;
        let length = g.sub(upper, lower);
        let sign = crate::signs::enclosure(&scope.space, length).map(|own| own.sign());
        let is_positive = match sign {
            // Parameters have no values.
            None => return,
            Some(Some(sign)) => sign == std::cmp::Ordering::Greater,
            Some(None) => !scope.space.vanish(&[length]),
        };
        if is_positive {
            return;
        }
        let (from, to) = (g.text(lower), g.text(upper));
        let message = format!("the interval from {from} to {to} has no positive length");
        self.push(
            Diagnostic::error("empty-interval", raw.place, message)
                .hint("the smaller end comes first; a parameter in it needs another value"),
        );
    }

    pub(super) fn shape(&mut self, text: &Text) -> Option<Shape> {
        let known = Shape::WORDS
            .into_iter()
            .find(|(word, _)| *word == text.content);
        if known.is_none() {
            let words = Shape::WORDS.map(|(word, _)| word);
            let message = format!("`{}` is no kind of tensor", text.content);
            let diagnostic = Diagnostic::error("unknown-value", text.place, message);
            self.push(match closest(&text.content, words) {
                Some(near) => diagnostic.hint(format!("did you mean \"{near}\"?")),
                None => diagnostic.hint(format!("one of {}", words.join(", "))),
            });
        }
        known.map(|(_, shape)| shape)
    }

    pub(super) fn fields(
        &mut self,
        table: &Table,
        section: &str,
        is_varied: bool,
        scope: &mut Scope,
    ) -> Vec<Field> {
        let mut found = Vec::new();
        let Some(entries) = self.section(table, section) else {
            return found;
        };
        for (key, raw) in &entries.entries {
            if let Some(own) = raw.table() {
                let known: &[&str] = if is_varied {
                    &["kind", "description", "on"]
                } else {
                    &["kind", "description", "on", "of"]
                };
                self.known_keys(own, known, if is_varied { "a field" } else { "data" });
            }
            let (kind, description) = self.described(raw, "kind");
            let on = raw.table().and_then(|table| self.optional(table, "on"));
            let shape = kind.and_then(|text| self.shape(&text));
            let Some(shape) = shape else { continue };
            if !self.is_new(scope, key, shape) {
                continue;
            }
            let of = raw.table().and_then(|own| own.get("of"));
            let constant_along = match of {
                Some(of) if !is_varied => self.without_variables(scope, of),
                _ => Vec::new(),
            };
            let kept = Kept {
                is_varied: is_varied && on.is_none(),
                is_of_boundary: on.is_some(),
                constant_along,
            };
            let components = declare(scope, &key.content, shape, &kept);
            let is_otherwise = |&component: &usize| {
                scope.space.component_at(component).constant_along != kept.constant_along
            };
            if components.iter().any(is_otherwise) {
                let message = format!(
                    "`{}` depends on other variables in another file: what two files call by one name is one thing",
                    key.content
                );
                self.push(Diagnostic::error("other-kind", key.place, message));
            }
            found.push(Field {
                name: key.content.clone(),
                shape,
                components,
                description,
                on: on.map(|text| text.content),
            });
        }
        found
    }

    /// The independent variables that `of` leaves out.
    fn without_variables(&mut self, scope: &Scope, of: &Raw) -> Vec<usize> {
        let coordinates = &scope.space.coordinates;
        let mut left: Vec<usize> = (0..coordinates.len()).collect();
        for text in self.texts(of, "of") {
            if let Some(axis) = scope.coordinate(&text.content) {
                left.retain(|own| *own != axis);
                continue;
            }
            let known: Vec<&str> = coordinates.iter().map(|own| own.name.as_str()).collect();
            let message = format!("`{}` is no independent variable", text.content);
            self.push(
                Diagnostic::error("unknown-name", text.place, message)
                    .hint(format!("these are {}", known.join(", "))),
            );
        }
        left
    }

    /// Whether neither the name nor that of a component stands for something already.
    fn is_new(&mut self, scope: &Scope, key: &Text, shape: Shape) -> bool {
        if !self.is_unknown(scope, &key.content, key.place) {
            return false;
        }
        let g = &scope.space.graph;
        let own = shape.components(scope.space.dimensions()).into_iter();
        let own: Vec<String> = own
            .map(|(indices, _)| component_name(&key.content, &indices))
            .collect();
        let of_space = own.iter().filter_map(|name| {
            let known = scope.space.component_named(name)?;
            let tensor = scope.space.component_at(known).tensor;
            (tensor != key.content).then(|| (name.clone(), tensor))
        });
        let of_scope = scope.tensors.iter().filter_map(|(name, tensor)| {
            let symbols = tensor.components.iter().filter_map(|&e| g.as_symbol(e));
            let mut names = symbols.map(|symbol| g.symbol_name(symbol).to_string());
            Some((names.find(|taken| own.contains(taken))?, name.clone()))
        });
        if let Some((taken, name)) = of_space.chain(of_scope).next() {
            let message = format!("`{taken}` is a component of `{name}` already");
            self.push(
                Diagnostic::error("declared-twice", key.place, message)
                    .hint("a name never means two things; choose another one"),
            );
            return false;
        }
        true
    }

    pub(super) fn parameters(&mut self, table: &Table, scope: &mut Scope) -> Vec<Parameter> {
        let mut found = Vec::new();
        let Some(section) = self.section(table, "parameters") else {
            return found;
        };
        for (key, raw) in &section.entries {
            let (value, description) = match &raw.kind {
                Kind::Table(own) => {
                    self.known_keys(own, &["kind", "value", "description"], "a parameter");
                    let description = self.optional(own, "description");
                    (
                        self.optional(own, "value"),
                        description.map_or(String::new(), |d| d.content),
                    )
                }
                _ => (self.text_of(raw, &key.content), String::new()),
            };
            let kind = raw.table().and_then(|own| self.optional(own, "kind"));
            let shape = kind
                .and_then(|text| self.shape(&text))
                .unwrap_or(Shape::Scalar);
            if !self.is_new(scope, key, shape) {
                continue;
            }
            let value = self.override_of(&key.content).or(value);
            let (value, refused) = match shape {
                Shape::Scalar => (value, None),
                _ => (None, value),
            };
            if let Some(text) = refused {
                let message = format!("`{}` is a tensor, and has no single value", key.content);
                self.push(Diagnostic::error("bad-value", text.place, message).hint(
                    "its components stand in formulas, or in `at` and [solutions] by their indices",
                ));
            }
            // Before the name is declared: a parameter is not stated by itself.
            let value = value.and_then(|text| self.scalar(scope, &text));
            constants(scope, &key.content, shape);
            if let (Some(value), Shape::Scalar, true) = (value, shape, self.puts_in_values) {
                place_holders(scope, &key.content, shape, &[value]);
            }
            found.push(Parameter {
                name: key.content.clone(),
                shape,
                value,
                description,
            });
        }
        found
    }
}

/// The kind of tensor that a function is applied to.
pub(super) fn shape_of(scope: &Scope, function: usize) -> Shape {
    match scope.space.function_at(function).rank {
        0 => Shape::Scalar,
        1 => Shape::Vector,
        _ => Shape::Symmetric,
    }
}

/// A tensor whose components are place-holders.
pub(super) fn place_holders(scope: &mut Scope, name: &str, shape: Shape, slots: &[Expr]) {
    let d = scope.space.dimensions();
    let own = shape.components(d);
    let components = tuples(shape.rank(), d)
        .into_iter()
        .filter_map(|tuple| {
            let wanted = shape.canonical(&tuple);
            let at = own.iter().position(|(indices, _)| *indices == wanted)?;
            slots.get(at).copied()
        })
        .collect();
    let rank = shape.rank();
    scope
        .tensors
        .insert(name.to_owned(), Tensor { rank, components });
}

/// `s_12`; the name alone for a scalar.
pub(super) fn component_name(name: &str, indices: &[usize]) -> String {
    if indices.is_empty() {
        name.to_owned()
    } else {
        let digits: String = indices.iter().map(|i| (i + 1).to_string()).collect();
        format!("{name}_{digits}")
    }
}

/// What all components of a tensor have in common.
struct Kept {
    is_varied: bool,
    is_of_boundary: bool,
    constant_along: Vec<usize>,
}

/// Declares the components of a field, and the tensor made of them.
fn declare(scope: &mut Scope, name: &str, shape: Shape, kept: &Kept) -> Vec<usize> {
    let d = scope.space.dimensions();
    let own: Vec<(Vec<usize>, usize)> = shape
        .components(d)
        .into_iter()
        .map(|(indices, multiplicity)| {
            let component = scope.space.component(Component {
                name: component_name(name, &indices),
                tensor: name.to_owned(),
                multiplicity,
                is_varied: kept.is_varied,
                is_of_boundary: kept.is_of_boundary,
                constant_along: kept.constant_along.clone(),
            });
            (indices, component)
        })
        .collect();
    let slots: Vec<Expr> = own.iter().map(|(_, c)| scope.space.jet(*c, &[])).collect();
    scope.shapes.insert(name.to_owned(), shape);
    place_holders(scope, name, shape, &slots);
    scope.space.name_arguments(&slots, name);
    own.into_iter().map(|(_, component)| component).collect()
}

/// Declares constants.
pub(super) fn constants(scope: &mut Scope, name: &str, shape: Shape) {
    let d = scope.space.dimensions();
    scope.shapes.insert(name.to_owned(), shape);
    let slots: Vec<Expr> = shape
        .components(d)
        .into_iter()
        .map(|(indices, _)| scope.space.graph.symbol(&component_name(name, &indices), 0))
        .collect();
    place_holders(scope, name, shape, &slots);
}

/// Whether a text is made of names one after the other, other than the one.
fn is_made_of(text: &str, one: &str, names: &[&str]) -> bool {
    let others = names.iter().filter(|name| **name != one);
    let mut rests = others.filter_map(|name| text.strip_prefix(name));
    rests.any(|rest| rest.is_empty() || is_made_of(rest, one, names))
}
