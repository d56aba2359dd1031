//! The version of the model format that a file names: `chetaev = "1"`.

use crate::diagnostic::Diagnostic;
use crate::raw::{Raw, Table};

/// The version that this library reads. Files without the key are read as this version.
pub const FORMAT: &str = "1";

/// The key.
const KEY: &str = "chetaev";

/// Takes the version out of a file; what is wrong with it, where it is not one that can be read.
pub(crate) fn taken(table: &mut Table) -> Option<Diagnostic> {
    let stated = table.remove(KEY)?;
    match stated.expression().map(|text| text.content.trim()) {
        Some(FORMAT) => None,
        Some(other) => Some(unknown(&stated, other)),
        None => {
            let message = format!(
                "`{KEY}` must be a version of the model format, not {}",
                stated.kind.word()
            );
            Some(Diagnostic::error("wrong-kind", stated.place, message).hint(hint()))
        }
    }
}

fn unknown(stated: &Raw, other: &str) -> Diagnostic {
    let message = format!("`{other}` is not a version of the model format that this program reads");
    Diagnostic::error("unknown-format", stated.place, message)
        .hint(hint())
        .suggest(stated.place, format!("\"{FORMAT}\""))
}

fn hint() -> String {
    format!("this program reads `{KEY} = \"{FORMAT}\"`; a file of a later version needs a later program, and a file without the key is read as version {FORMAT}")
}
