//! `chetaev study`.

use super::{error, options, refuse, with_hooks};
use crate::arguments::Study as Arguments;
use crate::{files, terminal, INPUT};
use chetaev::mechanics::Group;
use chetaev::model::Model;
use chetaev::study::explanation::did_you_mean;
use chetaev::study::record::WrittenRecord;
use chetaev::study::table::Table;
use chetaev::study::{
    in_time, overview, page, record, registry, study, summary, ClaimSelection, Hooks, Study,
    StudyError, StudyOptions,
};
use std::path::Path;

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
        let written = write_all(&study, &folder, hooks);
        Ok::<_, StudyError>((study, written))
    });
    let (study, written) = match result {
        Ok((study, Ok(written))) => (study, written),
        Ok((_, Err(problem))) => {
            error(problem);
            return INPUT;
        }
        Err(problem) => {
            return refuse(&problem, &arguments.motion, &read);
        }
    };
    if arguments.json {
        terminal::out(&json(&study, &written));
    } else {
        terminal::out(&told(arguments, &study));
        terminal::out(&format!("\nreport: {}\n", written.report(&folder)));
        if is_brief(arguments) {
            terminal::out(&format!(
                "all {} claims with their evidence: --all; some of them: --show formulations\n",
                study.verdicts.len()
            ));
        }
    }
    study.outcome.exit_status()
}

/// Whether what was found is told, and not listed.
fn is_brief(arguments: &Arguments) -> bool {
    !arguments.all && arguments.show.is_empty() && arguments.claims.is_none()
}

/// What was found; every claim that was asked for by name, or is to be shown.
fn told(arguments: &Arguments, study: &Study) -> String {
    let style = terminal::style();
    if is_brief(arguments) {
        return overview::overview(study, style);
    }
    if arguments.show.is_empty() {
        return summary::summary(study, style);
    }
    let is_shown = |group: &Group| arguments.show.iter().any(|word| word == group.word());
    let groups: Vec<Group> = Group::ALL.into_iter().filter(is_shown).collect();
    let listed = summary::listing(study, &groups, style);
    listed.trim_start().to_owned()
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
                    "--claims: `{word}` is neither a group (model, formulations, motion, principles, integrals, stability) nor a claim{}",
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

/// The record, with the files that were written beside it.
pub(super) fn json(study: &Study, written: &Written) -> String {
    let mut record = record::record(study, &written.data);
    record.files.clone_from(&written.files);
    // Serialising plain data to a string does not fail; an empty text would be visible.
    let mut text = serde_json::to_string_pretty(&record).unwrap_or_default();
    text.push('\n');
    text
}

/// What was written beside the record.
#[derive(Default)]
pub(super) struct Written {
    /// Names of the data files.
    data: Vec<String>,
    /// All files with their checksums.
    files: Vec<WrittenRecord>,
}

impl Written {
    fn file(&mut self, folder: &Path, name: &str, content: &[u8]) -> Result<(), String> {
        files::write(&folder.join(name), content)?;
        self.files.push(WrittenRecord {
            name: name.to_owned(),
            sha256: files::checksum(content),
        });
        Ok(())
    }

    /// Where the page is, or why there is none.
    pub(super) fn report(&self, folder: &Path) -> String {
        if self.files.iter().any(|file| file.name == REPORT) {
            folder.join(REPORT).display().to_string()
        } else {
            "not written, as the study was interrupted".to_owned()
        }
    }
}

/// Seconds that the page may take after an interruption.
const GRACE: f64 = 0.15;

/// Writes the trajectory and report.html, and study.json last: it has the checksums of the others, so that what does not belong
/// together is seen.
pub(super) fn write_all(
    study: &Study,
    folder: &Path,
    hooks: &mut Hooks<'_>,
) -> Result<Written, String> {
    let mut written = Written::default();
    if let Some(motion) = &study.motion {
        let table = Table::new(study, motion);
        written.file(folder, "trajectory.csv", table.to_csv().as_bytes())?;
        let archive = table.to_npz().map_err(|e| e.to_string())?;
        written.file(folder, "trajectory.npz", &archive)?;
        written
            .data
            .extend(["trajectory.csv".to_string(), "trajectory.npz".to_string()]);
        if let Some(events) = Table::events(study, motion) {
            written.file(folder, "events.csv", events.as_bytes())?;
            written.data.push("events.csv".to_string());
        }
    }
    let html = in_time(hooks, GRACE, || {
        page::page(study, Some(terminal::command()), &written.data)
    });
    if let Some(html) = html {
        written.file(folder, REPORT, html.as_bytes())?;
    }
    files::write(&folder.join("study.json"), json(study, &written).as_bytes())?;
    Ok(written)
}

/// The page.
const REPORT: &str = "report.html";
