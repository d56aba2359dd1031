//! `chetaev check`.

use super::with_hooks;
use crate::arguments::Check as Arguments;
use crate::{files, terminal, DONE, INPUT};
use chetaev::mechanics::words::counted;
use chetaev::model::Model;
use chetaev::study::{check, diagnostics};

pub(crate) fn run(arguments: &Arguments) -> u8 {
    if let Some(loaded) = files::functional(&arguments.model) {
        return super::functional::check(&loaded, arguments.json);
    }
    let Some((model, mut found)) = files::load(&arguments.model) else {
        return INPUT;
    };
    if let Some(model) = &model {
        found.list.extend(model.unused.iter().cloned());
        if let Err(problem) = with_hooks(|hooks| check(model, hooks)) {
            found.list.extend(diagnostics(&problem, model));
        }
    }
    if arguments.json {
        let text = serde_json::to_string_pretty(&found.to_data()).unwrap_or_default();
        terminal::out(&format!("{text}\n"));
    } else {
        files::report(&found);
    }
    match model {
        Some(_) if arguments.lowered && !found.has_errors() => {
            match files::lowered(&arguments.model) {
                Some(text) => {
                    terminal::out(&text);
                    DONE
                }
                None => INPUT,
            }
        }
        Some(model) if !found.has_errors() => {
            if !arguments.json {
                terminal::out(&summary(&model));
            }
            DONE
        }
        _ => INPUT,
    }
}

fn summary(model: &Model) -> String {
    let counts = [
        counted(model.coordinates.len(), "coordinate", "coordinates"),
        counted(model.constraints.len(), "constraint", "constraints"),
        counted(model.parameters.len(), "parameter", "parameters"),
    ];
    format!("{}: {}: no errors\n", model.name, counts.join(", "))
}
