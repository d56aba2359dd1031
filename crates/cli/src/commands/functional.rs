//! What `study` and `check` do with a functional of fields over space.

use super::{error, with_hooks};
use crate::arguments::{Notation, Study as Arguments};
use crate::{files, terminal, DONE, INPUT, STOPPED, UNMET};
use chetaev::functionals::{Loaded, Study};
use chetaev::study::functional::{
    derivation, is_selected, page, record, selected, studied, summary,
};
use chetaev::study::record::WrittenRecord;
use chetaev::study::{in_time, Hooks};
use std::path::Path;

/// Seconds that the page, and the summary, may take after an interruption.
const GRACE: f64 = 0.1;

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
    let wants = |id: &str| is_selected(&words, id);
    let done = with_hooks(|hooks| {
        let study = studied(problem, &wants, arguments.budget, hooks);
        (hooks.progress)("writing the report", None);
        let written = write_all(&study, &words, &folder, hooks);
        let told = if arguments.json {
            Some(String::new())
        } else {
            in_time(hooks, GRACE, || summary(&study, terminal::style()))
        };
        (study, written, told)
    });
    let (study, written, told) = done;
    let written = match written {
        Ok(written) => written,
        Err(problem) => {
            error(problem);
            return INPUT;
        }
    };
    if arguments.json {
        terminal::out(&written.json);
    } else {
        terminal::out(&told.unwrap_or_default());
        let report = if written.has_report {
            folder.join(REPORT).display().to_string()
        } else {
            "not written, as the study was interrupted".to_owned()
        };
        terminal::out(&format!("\nreport: {report}\n"));
    }
    if study.is_interrupted {
        STOPPED
    } else if study.is_as_expected() {
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

/// The record, and whether there is a report beside it.
struct Written {
    json: String,
    has_report: bool,
}

/// Writes the report, then the record with its checksum.
fn write_all(
    study: &Study,
    words: &[String],
    folder: &Path,
    hooks: &mut Hooks<'_>,
) -> Result<Written, String> {
    let mut all = Vec::new();
    let html = in_time(hooks, GRACE, || page(study, Some(terminal::command())));
    if let Some(html) = html {
        files::write(&folder.join(REPORT), html.as_bytes())?;
        all.push(WrittenRecord {
            name: REPORT.into(),
            sha256: files::checksum(html.as_bytes()),
        });
    }
    let json = json(study, words, &all);
    files::write(&folder.join("study.json"), json.as_bytes())?;
    Ok(Written {
        json,
        has_report: !all.is_empty(),
    })
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
