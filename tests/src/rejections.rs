//! Models that must be refused, stopped or warned about.

use crate::cases::{Expectation, Rejection};
use crate::checks::{close, stops};
use crate::runs::{along, ended, Ask, Ended};
use crate::words;

/// What is not as published.
///
/// # Errors
/// In words.
pub fn check(rejection: &Rejection) -> Result<(), String> {
    let expect = &rejection.expect;
    match (expect.outcome.as_str(), &expect.at) {
        ("stop", Some(at)) => stops(
            &rejection.statement,
            at.parse().map_err(|_| "time")?,
            expect.exit,
            &expect.contains,
            expect.vanishing.as_deref().unwrap_or("0"),
            expect.tol_abs.unwrap_or(1e-3),
        )?,
        _ => message(rejection, expect)?,
    }
    projected(rejection)
}

/// Exit status and words; an error leaves no motion, a warning a complete one.
fn message(rejection: &Rejection, expect: &Expectation) -> Result<(), String> {
    let ask = Ask {
        formulation: rejection.statement.formulation(),
        ..Ask::default()
    };
    let ended = ended(rejection.statement.model(&[], false), &ask);
    let finished = ended
        .study
        .as_ref()
        .and_then(|study| study.motion.as_ref())
        .is_some_and(|motion| motion.evidence.run.ending.finished);
    if ended.exit != expect.exit || finished != (expect.exit == 0) {
        return Err(format!(
            "exit {} instead of {}: {}",
            ended.exit, expect.exit, ended.text
        ));
    }
    let missing = words::missing(&ended.text, expect.contains.iter().map(String::as_str));
    if missing.is_empty() {
        Ok(())
    } else {
        Err(format!("does not say {missing:?}: {}", ended.text))
    }
}

/// The same model with a projected start.
fn projected(rejection: &Rejection) -> Result<(), String> {
    let Some(expected) = &rejection.with_projection else {
        return Ok(());
    };
    let ask = Ask {
        times: vec![0.0],
        ..Ask::default()
    };
    let Ended { exit, text, study } = ended(rejection.statement.model(&[], true), &ask);
    let study = study.ok_or(text)?;
    if exit != expected.exit {
        return Err(format!(
            "with projection: exit {exit} instead of {}",
            expected.exit
        ));
    }
    let run = &study.motion.as_ref().ok_or("no motion")?.evidence.run;
    for item in &expected.state {
        let value = along(&study, run, &item.value)?[0];
        close(
            "projected",
            0.0,
            along(&study, run, &item.name)?[0],
            value,
            1e-12,
        )?;
    }
    Ok(())
}
