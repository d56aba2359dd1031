//! `chetaev new`.

use super::error;
use crate::arguments::{Beginning, New as Arguments};
use crate::{files, terminal, DONE, INPUT};

const TEMPLATE: &str = include_str!("template.toml");
const BODIES: &str = include_str!("bodies.toml");
const FUNCTIONAL: &str = include_str!("functional.toml");

pub(crate) fn run(arguments: &Arguments) -> u8 {
    let path = arguments.folder.join("model.toml");
    if path.exists() {
        error(format!(
            "{} exists already; nothing was written",
            path.display()
        ));
        return INPUT;
    }
    let name = arguments
        .folder
        .file_name()
        .and_then(|n| n.to_str())
        .unwrap_or("my-system");
    let name = in_quotation_marks(name);
    let template = match arguments.from {
        Beginning::Bodies => BODIES,
        Beginning::Functional => FUNCTIONAL,
        Beginning::Lagrangian => TEMPLATE,
    };
    match files::write(&path, template.replace("MY-SYSTEM", &name).as_bytes()) {
        Ok(()) => {
            terminal::out(&format!(
                "wrote {}\ntry:  chetaev study {}\n",
                path.display(),
                path.display()
            ));
            DONE
        }
        Err(problem) => {
            error(problem);
            INPUT
        }
    }
}

/// The text as it stands between the quotation marks of a TOML string.
fn in_quotation_marks(name: &str) -> String {
    name.chars()
        .map(|c| match c {
            '"' => "\\\"".to_owned(),
            '\\' => "\\\\".to_owned(),
            c if c.is_control() => format!("\\u{:04X}", u32::from(c)),
            c => c.to_string(),
        })
        .collect()
}
