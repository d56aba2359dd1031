//! A tree of values as a TOML text again: every section under its heading, one entry a line.

use toml_edit::{Array, DocumentMut, InlineTable, Item, Value};

use crate::raw::{Kind, Raw, Table};

/// The text of a file; what is no table stands before the first heading.
pub(crate) fn text(table: &Table) -> String {
    let mut document = DocumentMut::new();
    let is_section = |raw: &Raw| raw.table().is_some();
    for (key, raw) in table.entries.iter().filter(|(_, raw)| !is_section(raw)) {
        document.insert(&key.content, Item::Value(value(raw)));
    }
    for (key, raw) in &table.entries {
        let Some(section) = raw.table() else { continue };
        let mut own = toml_edit::Table::new();
        for (key, raw) in &section.entries {
            own.insert(&key.content, Item::Value(value(raw)));
        }
        document.insert(&key.content, Item::Table(own));
    }
    document.to_string()
}

/// The nesting of a file is bounded by the parser that read it.
fn value(raw: &Raw) -> Value {
    match &raw.kind {
        Kind::Text(text) => Value::from(text.content.as_str()),
        Kind::Number(text) => {
            let number = text.content.parse::<Value>();
            number.unwrap_or_else(|_| Value::from(text.content.as_str()))
        }
        Kind::Truth(truth) => Value::from(*truth),
        Kind::Array(items) => Value::Array(items.iter().map(value).collect::<Array>()),
        Kind::Table(table) => {
            let entries = table.entries.iter();
            let entries = entries.map(|(key, raw)| (key.content.as_str(), value(raw)));
            Value::InlineTable(entries.collect::<InlineTable>())
        }
        Kind::Other => Value::from(""),
    }
}
