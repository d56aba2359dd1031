//! `chetaev verify`.

mod independent;

use super::{error, with_hooks};
use crate::arguments::Verify as Arguments;
use crate::{terminal, DONE, INPUT, UNMET};
use chetaev::study::verify::{agrees, read, verify, Replay, Verified};

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
    let lines = read(text).and_then(|record| with_hooks(|hooks| verify(&record, hooks)));
    match lines {
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
        let data: Vec<serde_json::Value> = lines
            .iter()
            .map(|l| {
                let (result, detail) = words(&l.replay);
                serde_json::json!({"claim": l.claim, "recorded": l.recorded, "result": result, "detail": detail})
            })
            .collect();
        terminal::out(&format!(
            "{}\n",
            serde_json::to_string_pretty(&data).unwrap_or_default()
        ));
        return;
    }
    for line in lines {
        let (result, detail) = words(&line.replay);
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

fn words(replay: &Replay) -> (&'static str, String) {
    match replay {
        Replay::Confirmed => ("confirmed", String::new()),
        Replay::Open { tried } => ("open", tried.clone()),
        Replay::Differs { found, detail } => {
            ("DISAGREES", format!("replay finds {found}: {detail}"))
        }
        Replay::Numbers { what } => ("DISAGREES", what.clone()),
        Replay::Remark { what } => ("remark", what.clone()),
    }
}
