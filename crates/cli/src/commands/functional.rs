//! What `study` and `check` do with a functional of fields over space.

use super::error;
use crate::arguments::{Notation, Study as Arguments};
use crate::{files, terminal, DONE, INPUT, UNMET};
use chetaev::functionals::claims::CLAIMS;
use chetaev::functionals::{self, Loaded, Study};
use chetaev::study::explanation::nearest;
use chetaev::study::functional::{derivation, page, record, summary};
use chetaev::study::record::WrittenRecord;
use std::path::Path;
use std::time::Instant;

/// The file name of the report.
const REPORT: &str = "report.html";

/// Studies a functional that was read.
pub(super) fn study(arguments: &Arguments, loaded: Loaded) -> u8 {
    files::report(&loaded.diagnostics);
    let Some(problem) = loaded.problem else {
        return INPUT;
    };
    let Some(words) = asked(arguments) else {
        return INPUT;
    };
    let folder = arguments
        .out
        .clone()
        .unwrap_or_else(|| files::default_folder(&arguments.model.model));
    let start = Instant::now();
    let wants = |id: &str| {
        words.is_empty()
            || words
                .iter()
                .any(|w| w == id || id.starts_with(&format!("{w}.")))
    };
    let study = functionals::study(problem, &wants, &|| start.elapsed().as_secs_f64());
    let json = match write_all(&study, &words, &folder) {
        Ok(json) => json,
        Err(problem) => {
            error(problem);
            return INPUT;
        }
    };
    if arguments.json {
        terminal::out(&json);
    } else {
        terminal::out(&summary(&study, terminal::style()));
        terminal::out(&format!("\nreport: {}\n", folder.join(REPORT).display()));
    }
    if study.is_as_expected() {
        DONE
    } else {
        UNMET
    }
}

/// Checks a functional that was read.
pub(super) fn check(loaded: &Loaded, as_json: bool) -> u8 {
    if as_json {
        let text = serde_json::to_string_pretty(&loaded.diagnostics.to_data()).unwrap_or_default();
        terminal::out(&format!("{text}\n"));
    } else {
        files::report(&loaded.diagnostics);
    }
    let Some(problem) = &loaded.problem else {
        return INPUT;
    };
    if !as_json {
        let own = &problem.functional;
        terminal::out(&format!(
            "{}: a functional of {}: no errors\n",
            own.name,
            own.fields
                .iter()
                .map(|f| f.name.as_str())
                .collect::<Vec<_>>()
                .join(", ")
        ));
    }
    DONE
}

/// Claims that were asked for, by id; empty for all. Prints what is wrong with them.
fn asked(arguments: &Arguments) -> Option<Vec<String>> {
    let text = arguments.claims.as_deref().unwrap_or("");
    let words: Vec<String> = text
        .split(',')
        .map(str::trim)
        .filter(|w| !w.is_empty())
        .map(str::to_owned)
        .collect();
    let ids = || CLAIMS.iter().map(|c| c.id());
    let unknown = words
        .iter()
        .find(|w| *w != "functional" && ids().all(|id| id != w.as_str()));
    match unknown {
        None => Some(words),
        Some(word) => {
            error(format!(
                "--claims: `{word}` is neither the group functional nor a claim about functionals{}",
                nearest(word, ids())
            ));
            None
        }
    }
}

fn json(study: &Study, words: &[String], files: &[WrittenRecord]) -> String {
    // Serialising plain data to a string does not fail; an empty text would be visible.
    let mut text = serde_json::to_string_pretty(&record(study, words, files)).unwrap_or_default();
    text.push('\n');
    text
}

/// Writes the report, then the record with its checksum; gives the record.
fn write_all(study: &Study, words: &[String], folder: &Path) -> Result<String, String> {
    let html = page(study, Some(terminal::command()));
    files::write(&folder.join(REPORT), html.as_bytes())?;
    let report = WrittenRecord {
        name: REPORT.into(),
        sha256: files::checksum(html.as_bytes()),
    };
    let json = json(study, words, &[report]);
    files::write(&folder.join("study.json"), json.as_bytes())?;
    Ok(json)
}

/// Prints the equations of a functional that was read, in one notation.
pub(super) fn derive(notation: Notation, loaded: Loaded) -> u8 {
    files::report(&loaded.diagnostics);
    let Some(problem) = loaded.problem else {
        return INPUT;
    };
    let Some(format) = chetaev::study::written::Notation::from(notation).format() else {
        error("code is made of equations of motion; a functional has field equations: text, latex, mathml, sympy or json");
        return INPUT;
    };
    match derivation(&problem.functional, format) {
        Ok(text) => {
            terminal::out(&text);
            DONE
        }
        Err(problem) => {
            error(problem);
            INPUT
        }
    }
}
