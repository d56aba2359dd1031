//! `chetaev study`.

use super::explain::did_you_mean;
use super::{error, options, refuse, with_hooks};
use crate::arguments::Study as Arguments;
use crate::{files, terminal, INPUT};
use chetaev::model::Model;
use chetaev::study::summary::Style;
use chetaev::study::table::Table;
use chetaev::study::{
    page, record, registry, study, summary, ClaimSelection, Study, StudyError, StudyOptions,
};
use std::path::{Path, PathBuf};

pub(crate) fn run(arguments: &Arguments) -> u8 {
    if let Some(loaded) = files::functional(&arguments.model) {
        return super::functional::study(arguments, loaded);
    }
    let Some(read) = files::model(&arguments.model) else {
        return INPUT;
    };
    let Some(options) = asked(arguments, &read.model) else {
        return INPUT;
    };
    let folder = arguments
        .out
        .clone()
        .unwrap_or_else(|| files::default_folder(&arguments.model.model));
    let result = with_hooks(|hooks| {
        let study = study(read.model.clone(), options, hooks)?;
        (hooks.progress)("writing the report", None);
        let written = write_all(&study, &folder);
        Ok::<_, StudyError>((study, written))
    });
    let (study, written) = match result {
        Ok((study, Ok(written))) => (study, written),
        Ok((_, Err(problem))) => {
            error(problem);
            return INPUT;
        }
        Err(problem) => {
            refuse(&problem, &arguments.motion, &read);
            return INPUT;
        }
    };
    if arguments.json {
        terminal::out(&json(&study, &written));
    } else {
        let style = if terminal::colours() {
            Style::Ansi
        } else {
            Style::Plain
        };
        terminal::out(&summary::summary(&study, style));
        terminal::out(&format!(
            "\nreport: {}\n",
            folder.join("report.html").display()
        ));
    }
    study.outcome.exit_status()
}

/// The options on the command line; prints what is wrong with them.
fn asked(arguments: &Arguments, model: &Model) -> Option<StudyOptions> {
    let options = options(&arguments.motion, model)?;
    let claims = match &arguments.claims {
        None => ClaimSelection::all(),
        Some(text) => match ClaimSelection::parse(text, registry().claims()) {
            Ok(claims) => claims,
            Err(word) => {
                error(format!(
                    "--claims: `{word}` is neither a group (model, formulations, motion, principles, integrals) nor a claim{}",
                    did_you_mean(&word, registry().claims())
                ));
                return None;
            }
        },
    };
    Some(StudyOptions {
        budget: arguments.budget,
        claims,
        ..options
    })
}

fn json(study: &Study, files: &[String]) -> String {
    let record = record::record(study, files);
    // Serialising plain data to a string does not fail; an empty text would be visible.
    let mut text = serde_json::to_string_pretty(&record).unwrap_or_default();
    text.push('\n');
    text
}

/// Writes report.html, study.json and the trajectory; names of the data files.
pub(super) fn write_all(study: &Study, folder: &Path) -> Result<Vec<String>, String> {
    let mut names = Vec::new();
    if let Some(motion) = &study.motion {
        let table = Table::new(study, motion);
        files::write(&folder.join("trajectory.csv"), table.to_csv().as_bytes())?;
        let archive = table.to_npz().map_err(|e| e.to_string())?;
        files::write(&folder.join("trajectory.npz"), &archive)?;
        names.extend(["trajectory.csv".to_string(), "trajectory.npz".to_string()]);
        if let Some(events) = Table::events(study, motion) {
            files::write(&folder.join("events.csv"), events.as_bytes())?;
            names.push("events.csv".to_string());
        }
    }
    files::write(&folder.join("study.json"), json(study, &names).as_bytes())?;
    let html = page::page(study, Some(terminal::command()), &names);
    let report: PathBuf = folder.join("report.html");
    files::write(&report, html.as_bytes())?;
    Ok(names)
}
