//! `chetaev linearize` and `chetaev stability`.
#![allow(
    clippy::result_large_err,
    reason = "an error is made once, and told at once"
)]

use super::{error, with_progress};
use crate::arguments::{Linearize, Stability as Arguments};
use crate::{files, terminal, DONE, INPUT};
use chetaev::study::stability::{stability, Stability, StabilityError};

pub(crate) fn linearize(arguments: &Linearize) -> u8 {
    let about = arguments.about.as_deref();
    answer(&arguments.model, about, None, |found| {
        if arguments.json {
            json(found)
        } else {
            found.linear_text()
        }
    })
}

pub(crate) fn run(arguments: &Arguments) -> u8 {
    let (about, over) = (arguments.about.as_deref(), arguments.over.as_deref());
    answer(&arguments.model, about, over, |found| {
        if arguments.json {
            json(found)
        } else {
            found.ranges_text()
        }
    })
}

fn json(found: &Stability) -> String {
    let text = serde_json::to_string_pretty(&found.json()).unwrap_or_default();
    format!("{text}\n")
}

fn answer(
    model: &crate::arguments::ModelArguments,
    about: Option<&str>,
    over: Option<&str>,
    written: impl FnOnce(&Stability) -> String,
) -> u8 {
    let Some(read) = files::model(model) else {
        return INPUT;
    };
    let found = with_progress(|line| {
        line.show("linear equations", None);
        stability(&read.model, about, over)
    });
    match found {
        Ok(found) => {
            terminal::out(&written(&found));
            DONE
        }
        Err(StabilityError::System(problem)) => {
            read.refuse(problem);
            INPUT
        }
        Err(problem) => {
            error(problem);
            INPUT
        }
    }
}
