//! `chetaev steady`, `chetaev linearize` and `chetaev stability`.
#![allow(
    clippy::result_large_err,
    reason = "an error is made once, and told at once"
)]

use super::{error, with_progress};
use crate::arguments::{Linearize, Stability as Arguments, Steady};
use crate::{files, terminal, DONE, INPUT};
use chetaev::study::sensitivity::along_motion;
use chetaev::study::stability::map::map;
use chetaev::study::stability::{stability, Stability, StabilityError, Wanted};
use chetaev::study::steady::steady;
use std::path::Path;

pub(crate) fn linearize(arguments: &Linearize) -> u8 {
    if arguments.along {
        return along(arguments);
    }
    let wanted = Wanted {
        about: arguments.about.as_deref(),
        at: arguments.at.as_deref(),
        speeds: arguments.speeds.as_deref(),
        outputs: arguments.outputs.as_deref(),
        symbolic: arguments.symbolic,
        numbers: arguments.numbers,
        all: arguments.all,
        over: None,
        work: None,
    };
    answer(&arguments.model, &wanted, |found| {
        if let Some(path) = &arguments.save {
            return saved(found, path);
        }
        Ok(if arguments.json {
            json(found)
        } else {
            found.linear_text()
        })
    })
}

/// The linear equations along the motion from the initial state.
fn along(arguments: &Linearize) -> u8 {
    let Some(read) = files::model(&arguments.model) else {
        return INPUT;
    };
    match along_motion(&read.model) {
        Ok(found) => {
            terminal::out(&if arguments.json {
                pretty(&found.json())
            } else {
                found.text()
            });
            DONE
        }
        Err(problem) => super::follow::refuse(&read, problem),
    }
}

/// Writes the linear equations in the format that the end of the name says.
fn saved(found: &Stability, path: &Path) -> std::io::Result<String> {
    let content = match path.extension().and_then(|end| end.to_str()) {
        Some("npz") => found.matrices().to_npz()?,
        Some("mat") => found.matrices().to_mat(),
        Some("py") => found.matrices().to_python().into_bytes(),
        Some("tex") => found.latex().into_bytes(),
        Some("json") => json(found).into_bytes(),
        Some("txt") => found.linear_text().into_bytes(),
        _ => return Err(std::io::Error::other(format!("{}: the end of the name says the format: .npz (NumPy), .mat (MATLAB), .py (python-control), .tex, .json or .txt", path.display()))),
    };
    files::write(path, &content).map_err(std::io::Error::other)?;
    Ok(String::new())
}

pub(crate) fn run(arguments: &Arguments) -> u8 {
    let wanted = Wanted {
        about: arguments.about.as_deref(),
        at: arguments.at.as_deref(),
        over: arguments.over.as_deref(),
        ..Wanted::default()
    };
    if wanted.over.is_some_and(|text| text.contains(',')) {
        return over_two(arguments, &wanted);
    }
    answer(&arguments.model, &wanted, |found| {
        if let Some((path, picture)) = arguments.plot.as_ref().zip(found.picture()) {
            files::write(path, picture.as_bytes()).map_err(std::io::Error::other)?;
        }
        Ok(if arguments.json {
            json(found)
        } else {
            found.ranges_text()
        })
    })
}

/// The map over two parameters.
fn over_two(arguments: &Arguments, wanted: &Wanted<'_>) -> u8 {
    let Some(read) = files::model(&arguments.model) else {
        return INPUT;
    };
    let found = with_progress(|line| {
        let what = "map of stability";
        line.show(what, None);
        map(&read.model, wanted, &mut |part| line.show(what, Some(part)))
    });
    let found = match found {
        Ok(found) => found,
        Err(problem) => return refuse(&read, problem),
    };
    if let Some(path) = &arguments.plot {
        if let Err(problem) = files::write(path, found.picture().as_bytes()) {
            error(problem);
            return INPUT;
        }
    }
    terminal::out(&if arguments.json {
        pretty(&found.json())
    } else {
        found.text()
    });
    DONE
}

fn json(found: &Stability) -> String {
    pretty(&found.json())
}

fn pretty(value: &serde_json::Value) -> String {
    let text = serde_json::to_string_pretty(value).unwrap_or_default();
    format!("{text}\n")
}

pub(crate) fn find(arguments: &Steady) -> u8 {
    let Some(read) = files::model(&arguments.model) else {
        return INPUT;
    };
    let found = with_progress(|line| {
        line.show("steady motions", None);
        steady(&read.model, arguments.symbolic)
    });
    match found {
        Ok(found) => {
            terminal::out(&if arguments.json {
                pretty(&found.json())
            } else {
                found.text()
            });
            DONE
        }
        Err(problem) => super::follow::refuse(&read, problem),
    }
}

fn answer(
    model: &crate::arguments::ModelArguments,
    wanted: &Wanted<'_>,
    written: impl FnOnce(&Stability) -> std::io::Result<String>,
) -> u8 {
    let Some(read) = files::model(model) else {
        return INPUT;
    };
    let found = with_progress(|line| {
        line.show("linear equations", None);
        stability(&read.model, wanted)
    });
    match found.as_ref().map(written) {
        Ok(Ok(text)) => {
            terminal::out(&text);
            return DONE;
        }
        Ok(Err(problem)) => {
            error(problem);
            return INPUT;
        }
        Err(_) => {}
    }
    match found {
        Ok(_) => DONE,
        Err(problem) => refuse(&read, problem),
    }
}

/// Tells why there is no answer, at the lines of the model where it is one of the model.
fn refuse(read: &files::Read, problem: StabilityError) -> u8 {
    match problem {
        StabilityError::System(problem) => read.refuse(problem),
        other => error(other),
    }
    INPUT
}
