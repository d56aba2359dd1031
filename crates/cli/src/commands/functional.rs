//! What `study` and `check` do with a functional of fields over space.

use super::error;
use crate::arguments::{Notation, Study as Arguments};
use crate::{files, terminal, DONE, INPUT, UNMET};
use chetaev::functionals::{self, Loaded, Study};
use chetaev::study::functional::{derivation, is_selected, page, record, selected, summary};
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
    let words = match selected(arguments.claims.as_deref().unwrap_or("")) {
        Ok(words) => words,
        Err(problem) => {
            error(format!("--claims: {problem}"));
            return INPUT;
        }
    };
    let folder = arguments
        .out
        .clone()
        .unwrap_or_else(|| files::default_folder(&arguments.model.model));
    let start = Instant::now();
    let wants = |id: &str| is_selected(&words, id);
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
