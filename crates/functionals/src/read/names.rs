//! Names with Greek letters, as keys of a file: they are written out, as expressions write them out.

use chetaev_model::raw::{Kind, Raw, Table};
use chetaev_symbolic::syntax::names::normalized;

/// Sections whose keys are names.
const NAMED: &[&str] = &[
    "sizes",
    "fields",
    "data",
    "parameters",
    "functions",
    "define",
];

/// Sections with names in tables of theirs.
const WITH_NAMES: &[&str] = &[
    "domain",
    "boundary",
    "solutions",
    "degenerations",
    "symmetries",
    "ritz",
];

/// Keys of which the value is a name or a list of names.
const VALUES: &[&str] = &["coordinates", "time", "fixed"];

/// The table of a file with `γ` as `gamma` in the names that it declares, and where it names them outside of expressions.
pub(super) fn written_out(mut table: Table) -> Table {
    for (key, raw) in &mut table.entries {
        let Kind::Table(section) = &mut raw.kind else {
            continue;
        };
        if NAMED.contains(&key.content.as_str()) {
            for (name, _) in &mut section.entries {
                name.content = normalized(&name.content);
            }
        } else if WITH_NAMES.contains(&key.content.as_str()) {
            section
                .entries
                .iter_mut()
                .for_each(|(key, raw)| inside(&key.content, raw));
        }
    }
    table
}

/// The names in a value of a section.
fn inside(key: &str, raw: &mut Raw) {
    match &mut raw.kind {
        Kind::Text(text) if VALUES.contains(&key) => text.content = normalized(&text.content),
        Kind::Array(items) if VALUES.contains(&key) => {
            items.iter_mut().for_each(|item| inside(key, item));
        }
        // Pieces of the boundary are named as the user names them.
        Kind::Table(table) if key != "pieces" => {
            for (own, raw) in &mut table.entries {
                inside(&own.content, raw);
                own.content = normalized(&own.content);
            }
        }
        _ => {}
    }
}
