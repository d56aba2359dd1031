//! The model file as a tree of values that know their places, before anything is given a meaning.

use std::collections::HashMap;

use chetaev_symbolic::syntax::Span;
use toml_edit::{Document, Item, TableLike, Value};

use crate::diagnostic::Diagnostic;
use crate::source::{Place, SourceId};
use crate::text::Text;

/// More mistakes in the TOML of one file than this are not looked for.
const MOST_SYNTAX_ERRORS: usize = 20;

/// A value.
#[derive(Clone, Debug)]
pub struct Raw {
    /// Where it is written.
    pub place: Place,
    /// What it is.
    pub kind: Kind,
}

/// What a value is.
#[derive(Clone, Debug)]
pub enum Kind {
    /// A text.
    Text(Text),
    /// A number exactly as it is written.
    Number(Text),
    /// `true` or `false`.
    Truth(bool),
    /// Several values.
    Array(Vec<Raw>),
    /// Keys with values.
    Table(Table),
    /// A date.
    Other,
}

impl Kind {
    /// The word for a kind of value.
    pub fn word(&self) -> &'static str {
        match self {
            Kind::Text(_) => "a text",
            Kind::Number(_) => "a number",
            Kind::Truth(_) => "true or false",
            Kind::Array(_) => "an array",
            Kind::Table(_) => "a table",
            Kind::Other => "a date",
        }
    }
}

impl Raw {
    /// The expression that the value is: a text, or a number as it is written.
    pub fn expression(&self) -> Option<&Text> {
        match &self.kind {
            Kind::Text(text) | Kind::Number(text) => Some(text),
            _ => None,
        }
    }

    /// The table that the value is.
    pub fn table(&self) -> Option<&Table> {
        match &self.kind {
            Kind::Table(table) => Some(table),
            _ => None,
        }
    }
}

/// Keys with values, in the order in which they are written.
#[derive(Clone, Debug, Default)]
pub struct Table {
    /// Each key with its value.
    pub entries: Vec<(Text, Raw)>,
}

impl Table {
    /// The value of a key.
    pub fn get(&self, key: &str) -> Option<&Raw> {
        self.entries
            .iter()
            .find(|(own, _)| own.content == key)
            .map(|(_, value)| value)
    }

    pub(crate) fn get_mut(&mut self, key: &str) -> Option<&mut Raw> {
        self.entries
            .iter_mut()
            .find(|(own, _)| own.content == key)
            .map(|(_, value)| value)
    }

    pub(crate) fn remove(&mut self, key: &str) -> Option<Raw> {
        let at = self
            .entries
            .iter()
            .position(|(own, _)| own.content == key)?;
        Some(self.entries.remove(at).1)
    }

    /// Lays another table over this one: tables are merged key by key, every other value is replaced.
    ///
    /// A plain value laid over a table that has a value of its own, as a parameter with its unit has, replaces that.
    pub(crate) fn overlay(&mut self, over: Table) {
        let own = self.entries.iter().enumerate();
        let mut places: HashMap<String, usize> =
            own.map(|(i, (key, _))| (key.content.clone(), i)).collect();
        for (key, value) in over.entries {
            match places.get(&key.content) {
                Some(&place) => self.entries[place].1.overlay(value),
                None => {
                    places.insert(key.content.clone(), self.entries.len());
                    self.entries.push((key, value));
                }
            }
        }
    }
}

impl Raw {
    fn overlay(&mut self, over: Raw) {
        match (&mut self.kind, over.kind) {
            (Kind::Table(own), Kind::Table(over)) => own.overlay(over),
            (Kind::Table(own), kind @ (Kind::Text(_) | Kind::Number(_))) => {
                let main = ["value", "equation", "expression"]
                    .into_iter()
                    .find(|key| own.get(key).is_some());
                match main.and_then(|key| own.get_mut(key)) {
                    Some(value) => {
                        *value = Raw {
                            place: over.place,
                            kind,
                        }
                    }
                    None => {
                        *self = Raw {
                            place: over.place,
                            kind,
                        }
                    }
                }
            }
            (own, kind) => {
                *own = kind;
                self.place = over.place;
            }
        }
    }
}

/// Reads a TOML text. All mistakes of its syntax are reported, each line with one left out in turn.
pub(crate) fn read(
    text: &str,
    source: SourceId,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<Table> {
    let mut remaining = text.to_owned();
    for _ in 0..MOST_SYNTAX_ERRORS {
        match Document::parse(remaining.as_str()) {
            Ok(document) if diagnostics.is_empty() => {
                let reader = Reader { text, source };
                return Some(reader.table(document.as_table()));
            }
            Ok(_) => return None,
            Err(error) => {
                let span = error.span().unwrap_or(0..0);
                let span = Span::new(floor(text, span.start), floor(text, span.end));
                let (diagnostic, blank) = match unclosed(&remaining, span.start, error.message()) {
                    Some(open) => (unclosed_error(source, open), Span::new(open, span.start)),
                    None => (syntax_error(text, source, span, error.message()), span),
                };
                diagnostics.push(diagnostic);
                if !blank_lines(&mut remaining, blank) {
                    return None;
                }
            }
        }
    }
    None
}

/// The bracket that was never closed, where this is what the parser stumbles over: it notices only in a later line.
fn unclosed(text: &str, at: usize, message: &str) -> Option<usize> {
    if !message.contains("array") && !message.contains("inline table") {
        return None;
    }
    let mut start = 0;
    let mut open = None;
    for line in text.get(..at)?.split_inclusive('\n') {
        let code = line.split('#').next().unwrap_or("");
        let count = |sign: char| code.matches(sign).count();
        let first = code.find(['[', '{']).filter(|_| code.contains('='));
        if count('[') > count(']') || count('{') > count('}') {
            // The first of several lines that go on: an array over many lines is opened in one of them only.
            open = first.map(|column| start + column).or(open);
        } else if count('[') < count(']') || count('{') < count('}') {
            open = None;
        }
        start += line.len();
    }
    open
}

fn unclosed_error(source: SourceId, open: usize) -> Diagnostic {
    let place = Place {
        source,
        span: Span::new(open, open + 1),
    };
    Diagnostic::error("toml-syntax", place, "this bracket is never closed").label("opened here")
}

/// Replaces the lines of a span by spaces, without the last one where the span ends at its beginning; false where
/// they are blank already.
fn blank_lines(text: &mut String, span: Span) -> bool {
    let bytes = text.as_bytes();
    let newline_before = |at: usize| {
        bytes[..at]
            .iter()
            .rposition(|byte| *byte == b'\n')
            .map_or(0, |newline| newline + 1)
    };
    let start = newline_before(span.start.min(bytes.len()));
    let mut last = span.end.min(bytes.len());
    if last > span.start && newline_before(last) == last && last > start {
        last -= 1;
    }
    let end = bytes[last..]
        .iter()
        .position(|byte| *byte == b'\n')
        .map_or(bytes.len(), |newline| last + newline);
    let blank: String = bytes[start..end]
        .iter()
        .map(|byte| if *byte == b'\n' { '\n' } else { ' ' })
        .collect();
    if text[start..end] == blank {
        return false;
    }
    text.replace_range(start..end, &blank);
    true
}

fn syntax_error(text: &str, source: SourceId, span: Span, message: &str) -> Diagnostic {
    let place = Place { source, span };
    let diagnostic = Diagnostic::error("toml-syntax", place, message.replace('\n', ": "));
    let start = text[..floor(text, span.start)]
        .rfind('\n')
        .map_or(0, |newline| newline + 1);
    let line = text[start..].lines().next().unwrap_or("");
    let key = line.split('=').next().unwrap_or("").trim();
    let quoted = key.starts_with(['"', '\'']) || key.starts_with('[');
    if line.contains('=') && !quoted && (key.contains(['\'', '′', '{', '^']) || !key.is_ascii()) {
        let at = Place {
            source,
            span: Span::new(
                start + line.find(key).unwrap_or(0),
                start + line.find(key).unwrap_or(0) + key.len(),
            ),
        };
        return diagnostic
            .hint("a key with primes, braces or Greek letters stands in quotation marks")
            .suggest(at, format!("\"{key}\""));
    }
    if let Some((at, point)) = decimal_comma(line) {
        let at = Place {
            source,
            span: Span::new(start + at.start, start + at.end),
        };
        return diagnostic
            .hint("the decimal sign is a point")
            .suggest(at, point);
    }
    let value = line.split_once('=').map_or("", |(_, value)| value.trim());
    if !value.is_empty() && !value.starts_with(['"', '\'', '[', '{']) && !value.contains('"') {
        let from = start + line.rfind(value).unwrap_or(0);
        let at = Place {
            source,
            span: Span::new(from, from + value.len()),
        };
        return diagnostic
            .hint("an expression stands in quotation marks")
            .suggest(at, format!("\"{value}\""));
    }
    diagnostic
}

/// A number with a comma in the place of its point, `1,5`, and the same with the point.
fn decimal_comma(line: &str) -> Option<(std::ops::Range<usize>, String)> {
    let (key, value) = line.split_once('=')?;
    let value = value.split('#').next()?;
    let own = value.trim();
    let (whole, digits) = own.split_once(',')?;
    let is_number = |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
    if !is_number(whole.trim_start_matches(['-', '+'])) || !is_number(digits) {
        return None;
    }
    let start = key.len() + 1 + value.find(own)?;
    Some((start..start + own.len(), format!("{whole}.{digits}")))
}

fn floor(text: &str, at: usize) -> usize {
    let mut at = at.min(text.len());
    while !text.is_char_boundary(at) {
        at -= 1;
    }
    at
}

struct Reader<'t> {
    text: &'t str,
    source: SourceId,
}

impl Reader<'_> {
    fn place(&self, span: Option<std::ops::Range<usize>>) -> Place {
        let span = span.unwrap_or(0..0);
        Place {
            source: self.source,
            span: Span::new(span.start, span.end),
        }
    }

    fn text(&self, content: &str, place: Place) -> Text {
        Text::of_toml(content, place.span.text(self.text), place)
    }

    /// A number in the digits of the file, so that `0.1` is a tenth; TOML's own notations are undone.
    fn number(&self, place: Place) -> Text {
        let written = place.span.text(self.text);
        let plain = written.replace('_', "");
        let based = [("0x", 16), ("0o", 8), ("0b", 2)]
            .into_iter()
            .find_map(|(mark, base)| i64::from_str_radix(plain.strip_prefix(mark)?, base).ok());
        match based {
            Some(value) => Text::of_toml(&value.to_string(), written, place),
            None if plain == written => Text::verbatim(plain, self.source, place.span.start),
            None => Text::of_toml(&plain, written, place),
        }
    }

    /// Depth is bounded: the TOML parser refuses nesting beyond its own limit.
    fn table(&self, table: &dyn TableLike) -> Table {
        let mut entries = Vec::new();
        for (name, item) in table.iter() {
            let key = table
                .get_key_value(name)
                .map(|(key, _)| self.place(key.span()))
                .unwrap_or_default();
            let key = if key.span.is_empty() {
                Place {
                    source: self.source,
                    ..self.place(item.span())
                }
            } else {
                key
            };
            if let Some(value) = self.item(item) {
                entries.push((self.text(name, key), value));
            }
        }
        Table { entries }
    }

    fn item(&self, item: &Item) -> Option<Raw> {
        let place = self.place(item.span());
        let kind = match item {
            Item::None => return None,
            Item::Value(value) => return Some(self.value(value)),
            Item::Table(table) => Kind::Table(self.table(table)),
            Item::ArrayOfTables(tables) => Kind::Array(
                tables
                    .iter()
                    .map(|table| Raw {
                        place: self.place(table.span()),
                        kind: Kind::Table(self.table(table)),
                    })
                    .collect(),
            ),
        };
        Some(Raw { place, kind })
    }

    fn value(&self, value: &Value) -> Raw {
        let place = self.place(value.span());
        let kind = match value {
            Value::String(string) => Kind::Text(self.text(string.value(), place)),
            Value::Integer(_) | Value::Float(_) => Kind::Number(self.number(place)),
            Value::Boolean(truth) => Kind::Truth(*truth.value()),
            Value::Datetime(_) => Kind::Other,
            Value::Array(array) => {
                Kind::Array(array.iter().map(|value| self.value(value)).collect())
            }
            Value::InlineTable(table) => Kind::Table(self.table(table)),
        };
        Raw { place, kind }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_line_with_a_mistake_is_reported() {
        let mut diagnostics = Vec::new();
        let text = "a = 1\nx' = 2\nb = = 3\nc = m*g\nd = 4\n";
        assert!(read(text, SourceId::default(), &mut diagnostics).is_none());
        diagnostics.sort_by_key(|diagnostic| diagnostic.place);
        let lines: Vec<usize> = diagnostics
            .iter()
            .map(|d| text[..d.place.span.start].matches('\n').count() + 1)
            .collect();
        assert_eq!(lines, [2, 3, 4]);
        assert_eq!(
            diagnostics[0]
                .suggestion
                .as_ref()
                .map(|s| s.replacement.as_str()),
            Some("\"x'\"")
        );
        assert_eq!(
            diagnostics[2]
                .suggestion
                .as_ref()
                .map(|s| s.replacement.as_str()),
            Some("\"m*g\"")
        );
    }

    #[test]
    fn an_unclosed_bracket_is_found_where_it_was_opened() {
        let mut diagnostics = Vec::new();
        let text = "a = [\"x\", \"y\"\n[b]\nm = 1,5\nk = { v = 1\nz = 2 pi\n";
        assert!(read(text, SourceId::default(), &mut diagnostics).is_none());
        diagnostics.sort_by_key(|diagnostic| diagnostic.place);
        let found: Vec<&str> = diagnostics
            .iter()
            .map(|d| text[d.place.span.start..].lines().next().unwrap_or(""))
            .collect();
        assert_eq!(found.len(), 4, "{found:?}");
        assert!(
            found[0].starts_with("[\"x\"") && found[2].starts_with("{ v"),
            "{found:?}"
        );
    }

    #[test]
    fn numbers_keep_their_digits() {
        let table = read(
            "a = 0.1\nb = 1_000.50e-3",
            SourceId::default(),
            &mut Vec::new(),
        )
        .unwrap();
        let digits = |key: &str| {
            table
                .get(key)
                .and_then(Raw::expression)
                .map(|text| text.content.clone())
        };
        assert_eq!(digits("a").as_deref(), Some("0.1"));
        assert_eq!(digits("b").as_deref(), Some("1000.50e-3"));
    }

    #[test]
    fn a_value_laid_over_a_parameter_keeps_its_unit() {
        let read = |text: &str| read(text, SourceId::default(), &mut Vec::new()).unwrap();
        let mut base = read("p = { value = 1, unit = \"m\" }\nq = 2");
        base.overlay(read("p = 3\nq = 4\nr = 5"));
        assert_eq!(
            base.get("p")
                .and_then(Raw::table)
                .and_then(|t| t.get("value"))
                .and_then(Raw::expression)
                .unwrap()
                .content,
            "3"
        );
        assert!(base
            .get("p")
            .and_then(Raw::table)
            .unwrap()
            .get("unit")
            .is_some());
        assert_eq!(
            base.get("q").and_then(Raw::expression).unwrap().content,
            "4"
        );
        assert_eq!(base.entries.len(), 3);
    }
}
