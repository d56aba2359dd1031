//! `chetaev principles`.

use super::study::{json, write_all, Written};
use super::{error, options, refuse, with_hooks};
use crate::arguments::Principles as Arguments;
use crate::{files, terminal, INPUT};
use chetaev::model::Model;
use chetaev::study::{beside, story, study, ClaimSelection, StudyError, StudyOptions};

pub(crate) fn run(arguments: &Arguments) -> u8 {
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
        let written = if arguments.compare {
            write_all(&study, &folder, hooks)
        } else {
            Ok(Written::default())
        };
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
        return study.outcome.exit_status();
    }
    let style = terminal::style();
    terminal::out(&if arguments.all {
        story::story(&study, style)
    } else {
        story::outline(&study, style)
    });
    if arguments.compare {
        terminal::out(&format!("\nreport: {}\n", written.report(&folder)));
    }
    if !arguments.all {
        terminal::out("\neach principle with its formulas and evidence: --all\n");
    }
    study.outcome.exit_status()
}

/// The options on the command line; prints what is wrong with them.
fn asked(arguments: &Arguments, model: &Model) -> Option<StudyOptions> {
    let options = options(&arguments.motion, model)?;
    let mut kappa: Vec<(String, f64)> = Vec::new();
    for given in &arguments.kappa {
        let Some((name, value)) = given.split_once('=') else {
            error(format!(
                "--kappa: `{given}` is no NAME=VALUE, as in kappa_blade=0.5"
            ));
            return None;
        };
        let name = name.trim();
        if !beside::is_multiplier(model, name) {
            let names = model.constraints.iter();
            let names: Vec<String> = names.map(|c| format!("kappa_{}", c.name)).collect();
            error(format!(
                "--kappa: `{name}` is no multiplier of the extremum; these are {}",
                names.join(", ")
            ));
            return None;
        }
        if kappa.iter().any(|(known, _)| known == name) {
            error(format!(
                "--kappa: `{name}` is given twice; it has one initial value"
            ));
            return None;
        }
        match model.constant_value("--kappa", value) {
            Ok(value) => kappa.push((name.to_owned(), value)),
            Err(problems) => {
                files::report(&problems);
                return None;
            }
        }
    }
    Some(StudyOptions {
        budget: arguments.budget,
        claims: ClaimSelection::of_principles(arguments.compare),
        motion: arguments.compare,
        extremum: arguments.compare.then_some(kappa),
        ..options
    })
}
