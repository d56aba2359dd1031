//! `[ritz]`: for which degrees, with which numbers, and against which values.

use super::Reader;
use crate::functional::{Functional, SpecialKind};
use crate::notation::Names;
use crate::ritz::{Asked, Point};
use chetaev_model::raw::{Raw, Table};
use chetaev_model::{Diagnostic, Text};
use chetaev_symbolic::{Expr, Rational};

/// Highest degree by one variable.
const HIGHEST: i64 = 12;

impl Reader<'_> {
    pub(super) fn ritz(&mut self, table: &Table, functional: &Functional) -> Option<Asked> {
        let section = self.section(table, "ritz")?;
        self.known_keys(section, &["degrees", "values", "points"], "[ritz]");
        let mut degrees = Vec::new();
        for text in section
            .get("degrees")
            .map(|raw| self.texts(raw, "degrees"))
            .unwrap_or_default()
        {
            match text.content.trim().parse::<i64>() {
                Ok(degree) if (0..=HIGHEST).contains(&degree) => degrees.push(degree as u32),
                _ => {
                    let message = format!("a degree is a whole number from 0 to {HIGHEST}");
                    self.push(Diagnostic::error("bad-size", text.place, message));
                }
            }
        }
        if degrees.is_empty() {
            degrees = vec![0, 1, 2, 3];
        }
        let mut values: Vec<(Expr, Expr)> = Vec::new();
        let given = section.get("values").and_then(Raw::table);
        for (key, raw) in given.iter().flat_map(|own| &own.entries) {
            let special = self.special(key, raw, functional, functional.scope.clone());
            let Some(SpecialKind::Symbols(pairs)) = special.map(|own| own.what) else {
                continue;
            };
            if pairs.iter().any(|(e, _)| is_varied(functional, *e)) {
                let message = format!("`{}` is varied: Ritz's method finds it", key.content);
                self.push(
                    Diagnostic::error("bad-special", key.place, message)
                        .hint("[ritz] values are those of parameters and data"),
                );
                continue;
            }
            values.extend(pairs);
        }
        let mut asked = Asked {
            degrees,
            values,
            points: Vec::new(),
        };
        let points = section.get("points").and_then(Raw::table);
        for (key, raw) in points.iter().flat_map(|own| &own.entries) {
            match raw.table() {
                Some(own) => {
                    let point = self.point(key, own, functional, &asked);
                    asked.points.extend(point);
                }
                None => self.wrong_kind(raw, &key.content, "a table"),
            }
        }
        Some(asked)
    }

    fn point(
        &mut self,
        key: &Text,
        table: &Table,
        functional: &Functional,
        asked: &Asked,
    ) -> Option<Point> {
        self.known_keys(table, &["field", "at", "value", "exact"], "a point");
        let scope = &functional.scope;
        let name = self.required(table, "field", "a point")?;
        let Some(component) = functional.space.component_named(&name.content) else {
            let message = format!("`{}` is not a component of a field", name.content);
            self.push(Diagnostic::error("unknown-name", name.place, message));
            return None;
        };
        let mut at = vec![Rational::ZERO; functional.space.coordinates.len()];
        let mut told = Vec::new();
        let places = table.get("at").and_then(Raw::table);
        for (variable, raw) in places.iter().flat_map(|own| &own.entries) {
            let axis = scope.coordinate(&variable.content);
            let value = self.text_of(raw, &variable.content).and_then(|text| {
                told.push(format!("{} = {}", variable.content, text.content));
                self.value_at(functional, asked, &text)
            });
            match (axis, value) {
                (Some(axis), Some(value)) => at[axis] = value,
                _ => {
                    let message = format!("`{}` has no place here", variable.content);
                    self.push(Diagnostic::error("unknown-name", variable.place, message));
                    return None;
                }
            }
        }
        if !is_inside(functional, asked, &at) {
            let message = "the point lies outside of the box of [domain] intervals";
            self.push(Diagnostic::error("bad-value", key.place, message));
            return None;
        }
        let text = self.required(table, "value", "a point")?;
        let value = self.value_at(functional, asked, &text)?;
        let exact = self.optional(table, "exact");
        Some(Point {
            written: format!("{}: {} at {}", key.content, name.content, told.join(", ")),
            component,
            at,
            value,
            is_exact: exact.is_none_or(|text| text.content != "false"),
        })
    }

    fn value_at(
        &mut self,
        functional: &Functional,
        asked: &Asked,
        text: &Text,
    ) -> Option<Rational> {
        let e = self.scalar(&functional.scope, text)?;
        let e = crate::ritz::with_values(functional, asked, e);
        let found = functional.space.graph.as_number(e).cloned();
        if found.is_none() {
            let message = format!(
                "`{}` is no rational number with the values of [ritz]",
                text.content
            );
            self.push(Diagnostic::error("bad-value", text.place, message));
        }
        found
    }

    /// The symmetries that are asked for.
    pub(super) fn symmetries(&mut self, table: &Table) -> Vec<String> {
        const WORDS: [&str; 3] = ["translations", "rotations", "scaling"];
        let Some(raw) = table.get("symmetries") else {
            return Vec::new();
        };
        let mut found = Vec::new();
        for text in self.texts(raw, "symmetries") {
            if WORDS.contains(&text.content.as_str()) {
                found.push(text.content);
                continue;
            }
            let message = format!("`{}` is no kind of symmetry", text.content);
            let diagnostic = Diagnostic::error("unknown-value", text.place, message);
            self.push(diagnostic.hint(format!("one of {}", WORDS.join(", "))));
        }
        found
    }
}

/// Whether a symbol is a field that is varied, or a derivative of one.
fn is_varied(functional: &Functional, e: Expr) -> bool {
    let space = &*functional.space;
    let jet = space.graph.as_symbol(e).and_then(|own| space.as_jet(own));
    jet.is_some_and(|jet| {
        let mut fields = functional.fields.iter();
        fields.any(|field| field.components.contains(&jet.component))
    })
}

/// Whether a point lies in the box; true where the ends of the box are no numbers.
fn is_inside(functional: &Functional, asked: &Asked, at: &[Rational]) -> bool {
    let space = &*functional.space;
    let end = |e: Expr| {
        let value = crate::ritz::with_values(functional, asked, e);
        space.graph.as_number(value).cloned()
    };
    functional.intervals.iter().all(|interval| {
        let own = at.get(interval.axis);
        let ends = (end(interval.lower), end(interval.upper));
        match (own, ends) {
            (Some(own), (Some(lower), Some(upper))) => (lower..=upper).contains(own),
            _ => true,
        }
    })
}
