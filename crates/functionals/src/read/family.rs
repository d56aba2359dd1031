//! The family that a functional belongs to: what the files of the others state, without studying them.

use super::Reader;
use crate::functional::{statement, Relative};
use chetaev_model::raw::{Raw, Table};
use chetaev_model::{joined, tables, Diagnostic, Sources, Text};

impl Reader<'_> {
    /// The members of the family in the order of the list.
    pub(super) fn family(&mut self, table: &Table) -> Vec<Relative> {
        let Some(raw) = table.get("family") else {
            return Vec::new();
        };
        let named = self.texts(raw, "family");
        let found = named.iter().filter_map(|file| self.relative(file));
        found.collect()
    }

    fn relative(&mut self, named: &Text) -> Option<Relative> {
        let path = joined(&self.text.path, &named.content);
        let text = match self.files.read(&path) {
            Ok(text) => text,
            Err(reason) => {
                let message = format!("`{path}` cannot be read: {reason}");
                let diagnostic = Diagnostic::error("unreadable-include", named.place, message);
                self.push(diagnostic);
                return None;
            }
        };
        let read = tables(&path, &text, self.files, &[], Sources::default());
        self.keep(read.text.includes, path, text);
        let own = read.table?;
        let text = |key: &str| {
            own.get(key)
                .and_then(Raw::expression)
                .map(|t| t.content.clone())
        };
        Some(Relative {
            name: text("name").unwrap_or_default(),
            level: text("level"),
            density: text("density").unwrap_or_default(),
            fields: fields(&own),
            imposed: self.labels(&own, "imposed"),
            yields: self.labels(&own, "yields"),
            equations: equations(&own),
        })
    }

    fn labels(&mut self, table: &Table, key: &str) -> Vec<String> {
        let found = table.get(key).map(|raw| self.texts(raw, key));
        found
            .into_iter()
            .flatten()
            .map(|text| text.content)
            .collect()
    }

    /// Keeps texts that were read, so that the functional can be read again from them.
    pub(super) fn keep(&mut self, includes: Vec<(String, String)>, path: String, text: String) {
        for (path, text) in includes.into_iter().chain([(path, text)]) {
            if self.text.includes.iter().all(|(own, _)| *own != path) {
                self.text.includes.push((path, text));
            }
        }
    }
}

fn equations(table: &Table) -> Vec<(String, String)> {
    let section = table.get("equations").and_then(Raw::table);
    let entries = section.iter().flat_map(|own| &own.entries);
    let stated = entries.filter_map(|(key, raw)| {
        let own = raw.table();
        let text = |key: &str| own?.get(key)?.expression().map(|t| t.content.clone());
        let written = match own {
            Some(_) => text("equation")?,
            None => raw.expression()?.content.clone(),
        };
        let statement = statement(&written, text("on").as_deref());
        Some((key.content.clone(), statement))
    });
    stated.collect()
}

fn fields(table: &Table) -> Vec<String> {
    let section = table.get("fields").and_then(Raw::table);
    let entries = section.iter().flat_map(|own| &own.entries);
    entries
        .map(|(key, raw)| {
            let on = raw
                .table()
                .and_then(|own| own.get("on"))
                .and_then(Raw::expression);
            match on {
                Some(on) => format!("{} on {}", key.content, on.content),
                None => key.content.clone(),
            }
        })
        .collect()
}
