//! `chetaev follow`.
#![allow(
    clippy::result_large_err,
    reason = "an error is made once, and told at once"
)]

use super::{error, with_progress};
use crate::arguments::Follow as Arguments;
use crate::{files, terminal, DONE, INPUT};
use chetaev::study::follow::{follow, FollowError, Wanted};

pub(crate) fn run(arguments: &Arguments) -> u8 {
    let Some(read) = files::model(&arguments.model) else {
        return INPUT;
    };
    let wanted = Wanted {
        about: arguments.about.as_deref(),
        over: arguments.over.as_deref(),
        orbit: arguments.orbit,
        period: arguments.period.as_deref(),
        points: Some(arguments.points),
        step: Some(arguments.step),
    };
    let found = with_progress(|line| {
        line.show("following", None);
        follow(&read.model, &wanted)
    });
    let picture = found.as_ref().ok().and_then(|found| found.picture());
    if let Some((path, picture)) = arguments.plot.as_ref().zip(picture) {
        if let Err(problem) = files::write(path, picture.as_bytes()) {
            error(problem);
            return INPUT;
        }
    }
    match found {
        Ok(found) if arguments.json => {
            let text = serde_json::to_string_pretty(&found.json()).unwrap_or_default();
            terminal::out(&format!("{text}\n"));
            DONE
        }
        Ok(found) => {
            terminal::out(&found.text());
            DONE
        }
        Err(problem) => refuse(&read, problem),
    }
}

/// Tells why there is no answer, at the lines of the model where it is one of the model.
pub(super) fn refuse(read: &files::Read, problem: FollowError) -> u8 {
    match problem {
        FollowError::System(problem) => read.refuse(problem),
        other => error(other),
    }
    INPUT
}
