//! `chetaev simulate`.

use super::{error, options, refuse, with_hooks};
use crate::arguments::Simulate as Arguments;
use crate::{files, terminal, INPUT};
use chetaev::orbits::variational::Order;
use chetaev::study::sensitivity::{sensitivity, to_csv};
use chetaev::study::table::Table;
use chetaev::study::{overview, record, study, ClaimSelection, StudyOptions};

pub(crate) fn run(arguments: &Arguments) -> u8 {
    let Some(read) = files::model(&arguments.model) else {
        return INPUT;
    };
    let Some(motion) = options(&arguments.motion, &read.model) else {
        return INPUT;
    };
    let options = StudyOptions {
        claims: ClaimSelection::of_motion(),
        ..motion
    };
    let study = match with_hooks(|hooks| study(read.model.clone(), options, hooks)) {
        Ok(study) => study,
        Err(problem) => {
            return refuse(&problem, &arguments.motion, &read);
        }
    };
    let Some(motion) = &study.motion else {
        error(study.notices.join("\n"));
        return INPUT;
    };
    let folder = arguments
        .out
        .clone()
        .unwrap_or_else(|| files::default_folder(&arguments.model.model));
    let table = Table::new(&study, motion);
    let events = Table::events(&study, motion);
    let written = table
        .to_npz()
        .map_err(|e| e.to_string())
        .and_then(|archive| files::write(&folder.join("trajectory.npz"), &archive))
        .and_then(|()| files::write(&folder.join("trajectory.csv"), table.to_csv().as_bytes()))
        .and_then(|()| match &events {
            Some(events) => files::write(&folder.join("events.csv"), events.as_bytes()),
            None => Ok(()),
        });
    if let Err(problem) = written {
        error(problem);
        return INPUT;
    }
    let varied = match &arguments.sensitivity {
        None => None,
        Some(by) => match sensitivities(arguments, &read, (by, &table, &study.options)) {
            Ok(text) => Some(text),
            Err(status) => return status,
        },
    };
    if let Some(text) = &varied {
        let path = folder.join("sensitivity.csv");
        if let Err(problem) = files::write(&path, text.as_bytes()) {
            error(problem);
            return INPUT;
        }
    }
    if arguments.json {
        let mut names = vec!["trajectory.csv".to_string(), "trajectory.npz".to_string()];
        names.extend(events.map(|_| "events.csv".to_string()));
        names.extend(varied.map(|_| "sensitivity.csv".to_string()));
        let run = record::run(&study, &names);
        terminal::out(&serde_json::to_string_pretty(&run).unwrap_or_default());
        terminal::out("\n");
    } else {
        terminal::out(&overview::of_motion(&study, terminal::style()));
        terminal::out(&format!(
            "\ntrajectory: {}\n",
            folder.join("trajectory.csv").display()
        ));
        if varied.is_some() {
            let path = folder.join("sensitivity.csv");
            terminal::out(&format!("sensitivities: {}\n", path.display()));
        }
    }
    study.outcome.exit_status()
}

/// The derivatives of the motion at the times of its table; the exit status where there are none.
fn sensitivities(
    arguments: &Arguments,
    read: &files::Read,
    (by, table, options): (&str, &Table, &StudyOptions),
) -> Result<String, u8> {
    let order = if arguments.second {
        Order::Second
    } else {
        Order::First
    };
    let times = table.columns.first().cloned().unwrap_or_default();
    match sensitivity(&read.model, by, order, &times, options) {
        Ok(found) => Ok(to_csv(&found)),
        Err(problem) => Err(super::follow::refuse(read, problem)),
    }
}
