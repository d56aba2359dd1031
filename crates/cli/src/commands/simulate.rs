//! `chetaev simulate`.

use super::{error, options, refuse, with_hooks};
use crate::arguments::Simulate as Arguments;
use crate::{files, terminal, INPUT};
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
        claims: ClaimSelection {
            words: ["motion.constraint-drift", "motion.integral-drift"]
                .map(String::from)
                .to_vec(),
        },
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
    if arguments.json {
        let mut names = vec!["trajectory.csv".to_string(), "trajectory.npz".to_string()];
        names.extend(events.map(|_| "events.csv".to_string()));
        let record = record::record(&study, &names);
        let mut trajectory = serde_json::json!(record.trajectory);
        if let Some(fields) = trajectory.as_object_mut() {
            fields.insert("notices".into(), record.notices.into());
        }
        terminal::out(&serde_json::to_string_pretty(&trajectory).unwrap_or_default());
        terminal::out("\n");
    } else {
        terminal::out(&overview::of_motion(&study, terminal::style()));
        terminal::out(&format!(
            "\ntrajectory: {}\n",
            folder.join("trajectory.csv").display()
        ));
    }
    study.outcome.exit_status()
}
