//! `chetaev verify`.

mod independent;

use super::{error, interrupted, with_hooks};
use crate::arguments::Verify as Arguments;
use crate::files::checksum_of;
use crate::{terminal, DONE, INPUT, STOPPED, UNMET};
use chetaev::study::verify::{agrees, files, read, verify, Replay, Verified, VerifyError};
use chetaev::study::StudyError;
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
        let folder = arguments.record.parent().unwrap_or(Path::new(""));
        lines.extend(files(&record, &mut |name| checksum_of(&folder.join(name))));
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
