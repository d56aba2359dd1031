//! `chetaev import`.

use super::error;
use crate::arguments::Import as Arguments;
use crate::{files, terminal, DONE, INPUT};
use chetaev::import::import;
use std::io::Read as _;

/// More than this is not read: so much the importer refuses by itself.
const MOST: u64 = 32 << 20;

pub(crate) fn run(arguments: &Arguments) -> u8 {
    match imported(arguments) {
        Ok(()) => DONE,
        Err(problem) => {
            error(problem);
            INPUT
        }
    }
}

fn imported(arguments: &Arguments) -> Result<(), String> {
    let shown = arguments.description.display();
    let describe = |problem: std::io::Error| format!("{shown} cannot be read: {problem}");
    let file = std::fs::File::open(&arguments.description).map_err(describe)?;
    let mut text = String::new();
    file.take(MOST)
        .read_to_string(&mut text)
        .map_err(describe)?;
    let found = import(&text).map_err(|problem| format!("{shown}: {problem}"))?;
    for note in &found.notes {
        terminal::err(&format!("{shown}:{}: {}", note.line, note.message));
    }
    let Some(out) = &arguments.out else {
        terminal::out(&found.text);
        return Ok(());
    };
    if out.exists() {
        return Err(format!(
            "{} exists already; nothing was written",
            out.display()
        ));
    }
    files::write(out, found.text.as_bytes())?;
    terminal::out(&format!(
        "wrote {}\ntry:  chetaev check {}\n",
        out.display(),
        out.display()
    ));
    Ok(())
}
