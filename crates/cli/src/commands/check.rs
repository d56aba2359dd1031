//! `chetaev check`.

use super::error;
use crate::arguments::Check as Arguments;
use crate::{files, terminal, DONE, INPUT};
use chetaev::mechanics::System;
use chetaev::model::Style;

pub(crate) fn run(arguments: &Arguments) -> u8 {
    let Some((model, diagnostics)) = files::load(&arguments.model) else {
        return INPUT;
    };
    let system = model.as_ref().map(System::from_model);
    if arguments.json {
        let text = serde_json::to_string_pretty(&diagnostics.to_data()).unwrap_or_default();
        terminal::out(&format!("{text}\n"));
    } else if !diagnostics.list.is_empty() {
        let style = if terminal::error_colours() {
            Style::Ansi
        } else {
            Style::Plain
        };
        terminal::err(&diagnostics.render(style));
    }
    match (model, system) {
        (Some(model), Some(Ok(system))) => {
            if !arguments.json {
                let counts = [
                    counted(system.n(), "coordinate"),
                    counted(system.constraints.len(), "constraint"),
                    counted(system.parameters.len(), "parameter"),
                ];
                let counts = counts.join(", ");
                terminal::out(&format!("{}: {counts}: no errors\n", model.name));
            }
            DONE
        }
        (_, Some(Err(problem))) => {
            error(problem);
            INPUT
        }
        _ => INPUT,
    }
}

/// "no constraints", "1 constraint", "2 constraints".
fn counted(count: usize, one: &str) -> String {
    match count {
        0 => format!("no {one}s"),
        1 => format!("1 {one}"),
        count => format!("{count} {one}s"),
    }
}
