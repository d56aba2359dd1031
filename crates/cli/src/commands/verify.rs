//! `chetaev verify`.

mod independent;

use super::{error, interrupted, with_hooks};
use crate::arguments::Verify as Arguments;
use crate::files::checksum_of;
use crate::{terminal, DONE, INPUT, STOPPED, UNMET};
use chetaev::study::record::{Record, WrittenRecord};
use chetaev::study::verify::{agrees, read, verify, Replay, Verified, VerifyError};
use chetaev::study::StudyError;
use std::ffi::OsStr;
use std::path::Path;

pub(crate) fn run(arguments: &Arguments) -> u8 {
    if arguments.independent {
        return independent::run(&arguments.record, arguments.json);
    }
    let text = match std::fs::read_to_string(&arguments.record) {
        Ok(text) => text,
        Err(problem) => {
            error(format!(
                "{} cannot be read: {problem}",
                arguments.record.display()
            ));
            return INPUT;
        }
    };
    let text = text.strip_prefix('\u{feff}').unwrap_or(&text);
    let budget = arguments.budget;
    let lines = read(text).and_then(|record| {
        let mut lines = with_hooks(|hooks| verify(&record, budget, hooks))?;
        lines.extend(files(&record, &arguments.record));
        Ok(lines)
    });
    match lines {
        Ok(_) if interrupted() => {
            error("interrupted; nothing is verified");
            STOPPED
        }
        Err(VerifyError::Study(StudyError::Interrupted)) => {
            error("interrupted; nothing is verified");
            STOPPED
        }
        Ok(lines) => {
            report(&lines, arguments.json);
            if agrees(&lines) {
                DONE
            } else {
                UNMET
            }
        }
        Err(problem) => {
            error(problem);
            INPUT
        }
    }
}

/// The files beside the record are those that were written with it.
fn files(record: &Record, path: &Path) -> Vec<Verified> {
    let folder = path.parent().unwrap_or(Path::new(""));
    let line = |file: &WrittenRecord| {
        // A record may come from anybody; it names files beside itself only.
        let is_plain = Path::new(&file.name).file_name() == Some(OsStr::new(&file.name));
        let found = is_plain
            .then(|| checksum_of(&folder.join(&file.name)))
            .flatten();
        let replay = match found {
            _ if !is_plain => Replay::Differs {
                found: "no file name".into(),
                detail: "files of a record lie beside it".into(),
            },
            None => Replay::Remark {
                what: "it is not beside the record, or cannot be read".into(),
            },
            Some(found) if found == file.sha256 => Replay::Confirmed,
            Some(found) => Replay::Differs {
                found,
                detail: "the content is not what was written with this record".into(),
            },
        };
        Verified {
            claim: file.name.clone(),
            recorded: "sha256".into(),
            replay,
        }
    };
    record.files.iter().map(line).collect()
}

fn report(lines: &[Verified], json: bool) {
    if json {
        let data: Vec<serde_json::Value> = lines.iter().map(Verified::to_json).collect();
        terminal::out(&format!(
            "{}\n",
            serde_json::to_string_pretty(&data).unwrap_or_default()
        ));
        return;
    }
    for line in lines {
        let (result, detail) = line.replay.words();
        terminal::out(&format!(
            "{result:<10} {:<36} {:<14} {detail}\n",
            line.claim, line.recorded
        ));
    }
    let confirmed = lines
        .iter()
        .filter(|l| l.replay == Replay::Confirmed)
        .count();
    terminal::out(&format!("{confirmed} of {} confirmed\n", lines.len()));
}
