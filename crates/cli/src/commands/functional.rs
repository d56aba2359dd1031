//! What `study` and `check` do with a functional of fields over space.

use super::error;
use super::explain::nearest;
use crate::arguments::Study as Arguments;
use crate::{files, terminal, DONE, INPUT, UNMET};
use chetaev::functionals::claims::CLAIMS;
use chetaev::functionals::{self, Loaded, Study};
use chetaev::study::functional::{page, record, summary};
use std::path::Path;
use std::time::Instant;

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
    let json = json(&study, &words);
    if let Err(problem) = write_all(&study, &json, &folder) {
        error(problem);
        return INPUT;
    }
    if arguments.json {
        terminal::out(&json);
    } else {
        terminal::out(&summary(&study, terminal::style()));
        terminal::out(&format!(
            "\nreport: {}\n",
            folder.join("report.html").display()
        ));
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

fn json(study: &Study, words: &[String]) -> String {
    // Serialising plain data to a string does not fail; an empty text would be visible.
    let mut text = serde_json::to_string_pretty(&record(study, words)).unwrap_or_default();
    text.push('\n');
    text
}

fn write_all(study: &Study, json: &str, folder: &Path) -> Result<(), String> {
    files::write(&folder.join("study.json"), json.as_bytes())?;
    let html = page(study, Some(terminal::command()));
    files::write(&folder.join("report.html"), html.as_bytes())
}
