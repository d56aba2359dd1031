//! `chetaev new`.

use super::error;
use crate::arguments::New as Arguments;
use crate::{files, terminal, DONE, INPUT};

const TEMPLATE: &str = include_str!("template.toml");

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
    match files::write(&path, TEMPLATE.replace("MY-SYSTEM", name).as_bytes()) {
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
