//! Families of objects: `link_{i}` stands for one object for each value of its indices.

use chetaev_symbolic::syntax::lower::Bindings;
use chetaev_symbolic::syntax::{
    lower, names, parse_expression, parse_range, Parsed, Resolution, Scope,
};
use chetaev_symbolic::{Expr, Graph};

use super::sections::word;
use crate::diagnostic::Diagnostic;
use crate::raw::{Kind, Raw, Table};
use crate::resolve::Override;
use crate::text::Text;

/// Most members of a family.
const MOST_MEMBERS: usize = 5_000;

/// Sizes and indices of a model, as numbers.
struct Numbers {
    graph: Graph,
    sizes: Bindings,
    /// Name, first and last value.
    indices: Vec<(String, [i64; 2])>,
}

/// Sizes alone have a meaning in an index.
struct Sizes<'n>(&'n Numbers);

impl Scope for Sizes<'_> {
    fn resolve(&self, name: &str, order: u32) -> Resolution {
        let own = self.0.sizes.iter().find(|(own, _)| own == name);
        match own {
            Some((_, value)) if order == 0 => Resolution::Known(self.0.graph.integer(*value)),
            _ => Resolution::Unknown,
        }
    }

    fn names(&self) -> Vec<String> {
        Vec::new()
    }
}

impl Numbers {
    /// What cannot be read here is reported where sizes and indices are declared.
    fn of(root: &Table, overrides: &[Override]) -> Numbers {
        let mut numbers = Numbers {
            graph: Graph::new(),
            sizes: Vec::new(),
            indices: Vec::new(),
        };
        for (key, raw) in entries(root, "sizes") {
            let name = names::normalized(&key.content);
            let mut outside = overrides.iter().rev();
            let outside = outside.find(|own| names::normalized(&own.name.content) == name);
            let text = outside.map(|own| &own.value).or(raw.expression());
            let value = text.and_then(|text| numbers.value(&text.content, &[]));
            numbers.sizes.extend(value.map(|value| (name, value)));
        }
        for (key, raw) in entries(root, "indices") {
            let ends = raw.expression().and_then(|text| {
                let parsed = parse_range(&text.content);
                let ends: Vec<i64> = parsed
                    .sides
                    .iter()
                    .filter_map(|side| numbers.integer(&parsed, *side, &[]))
                    .collect();
                <[i64; 2]>::try_from(ends).ok()
            });
            let name = names::normalized(&key.content);
            numbers.indices.extend(ends.map(|ends| (name, ends)));
        }
        numbers
    }

    fn integer(
        &self,
        parsed: &Parsed,
        side: chetaev_symbolic::syntax::NodeId,
        bindings: &[(String, i64)],
    ) -> Option<i64> {
        if parsed.has_errors() {
            return None;
        }
        let mut problems = Vec::new();
        let value: Expr = lower(
            &self.graph,
            &parsed.tree,
            side,
            &Sizes(self),
            bindings,
            &mut problems,
        )?;
        self.graph.as_integer(value)
    }

    fn value(&self, text: &str, bindings: &[(String, i64)]) -> Option<i64> {
        let parsed = parse_expression(text);
        self.integer(&parsed, parsed.root(), bindings)
    }

    /// All values of the indices in the braces of a key.
    fn bindings(&self, key: &str) -> Option<Vec<Bindings>> {
        let mut all: Vec<Bindings> = vec![Vec::new()];
        for (name, [first, last]) in &self.indices {
            if !braces(key).any(|part| tokens(part).any(|token| token == name)) {
                continue;
            }
            let count = usize::try_from(last - first + 1).unwrap_or(0);
            if all.len().saturating_mul(count) > MOST_MEMBERS {
                return None;
            }
            let longer = |bindings: &Bindings| {
                let bindings = bindings.clone();
                (*first..=*last).map(move |value| {
                    let mut longer = bindings.clone();
                    longer.push((name.clone(), value));
                    longer
                })
            };
            all = all.iter().flat_map(longer).collect();
        }
        Some(all)
    }

    /// A text with the values of its indices in it.
    fn instance(&self, text: &str, bindings: &Bindings) -> String {
        let mut out = String::with_capacity(text.len());
        let mut rest = text;
        while let Some(at) = rest.find('{') {
            let Some(end) = rest[at..].find('}').map(|end| at + end) else {
                break;
            };
            out.push_str(&self.bare(&rest[..at], bindings));
            match self.value(&rest[at + 1..end], bindings) {
                Some(value) => out.push_str(&value.to_string()),
                None => out.push_str(&rest[at..=end]),
            }
            rest = &rest[end + 1..];
        }
        out.push_str(&self.bare(rest, bindings));
        out
    }

    /// Indices that stand by themselves in an expression.
    fn bare(&self, text: &str, bindings: &Bindings) -> String {
        let mut out = String::with_capacity(text.len());
        let is_inner = |c: char| c.is_alphanumeric() || c == '_';
        let mut rest = text;
        while !rest.is_empty() {
            let end = rest.find(is_inner).unwrap_or(rest.len());
            out.push_str(&rest[..end]);
            rest = &rest[end..];
            let end = rest.find(|c| !is_inner(c)).unwrap_or(rest.len());
            let token = &rest[..end];
            // A name goes on before or after braces: `m_{i}` has no index that stands by itself.
            match bindings.iter().find(|(name, _)| name == token) {
                Some((_, value)) => out.push_str(&format!("({value})")),
                None => out.push_str(token),
            }
            rest = &rest[end..];
        }
        out
    }

    fn raw(&self, raw: &Raw, bindings: &Bindings) -> Raw {
        let kind = match &raw.kind {
            Kind::Text(text) => Kind::Text(self.text(text, bindings)),
            Kind::Array(items) => {
                Kind::Array(items.iter().map(|item| self.raw(item, bindings)).collect())
            }
            Kind::Table(table) => Kind::Table(Table {
                entries: table
                    .entries
                    .iter()
                    .map(|(key, raw)| match key.content.as_str() {
                        "description" => (key.clone(), raw.clone()),
                        _ => (key.clone(), self.raw(raw, bindings)),
                    })
                    .collect(),
            }),
            other => other.clone(),
        };
        Raw {
            place: raw.place,
            kind,
        }
    }

    /// A text that no index changes keeps the places of its letters.
    fn text(&self, text: &Text, bindings: &Bindings) -> Text {
        let content = self.instance(&text.content, bindings);
        if content == text.content {
            text.clone()
        } else {
            word(content, text.place)
        }
    }
}

fn entries<'r>(root: &'r Table, section: &str) -> impl Iterator<Item = &'r (Text, Raw)> {
    let table = root.get(section).and_then(Raw::table);
    table.into_iter().flat_map(|table| &table.entries)
}

fn braces(key: &str) -> impl Iterator<Item = &str> {
    key.split('{')
        .skip(1)
        .filter_map(|part| part.split('}').next())
}

fn tokens(text: &str) -> impl Iterator<Item = &str> {
    text.split(|c: char| !c.is_alphanumeric() && c != '_')
}

/// Replaces every family in some sections by its members.
pub(crate) fn expand(
    root: &mut Table,
    sections: &[&str],
    overrides: &[Override],
    problems: &mut Vec<Diagnostic>,
) {
    let has_families =
        |section: &&&str| entries(root, section).any(|(key, _)| key.content.contains('{'));
    if !sections.iter().any(|section| has_families(&section)) {
        return;
    }
    let numbers = Numbers::of(root, overrides);
    for section in sections {
        let Some(Kind::Table(table)) = root.get_mut(section).map(|raw| &mut raw.kind) else {
            continue;
        };
        let mut members = Vec::new();
        for (key, raw) in std::mem::take(&mut table.entries) {
            if !key.content.contains('{') {
                members.push((key, raw));
                continue;
            }
            match numbers.bindings(&key.content) {
                Some(all) => members.extend(all.iter().map(|bindings| {
                    let name = numbers.instance(&key.content, bindings);
                    (word(name, key.place), numbers.raw(&raw, bindings))
                })),
                None => {
                    let message = format!("a family has {MOST_MEMBERS} members at most");
                    problems.push(Diagnostic::error("too-large", key.place, message));
                }
            }
        }
        table.entries = members;
    }
}
