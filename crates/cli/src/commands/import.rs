//! `chetaev import`.

use super::error;
use crate::arguments::Import as Arguments;
use crate::{files, terminal, DONE, INPUT};
use chetaev::import::{import, ImportError};
use std::io::Read as _;
use std::path::{Path, PathBuf};

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

/// Why no model is made.
enum Unmade {
    /// The description cannot be read.
    Unread(PathBuf, std::io::Error),
    /// It describes no robot.
    Refused(PathBuf, Box<ImportError>),
    /// There is a file in the place of the model.
    Exists(PathBuf),
    /// The model cannot be written, in the words of who tried.
    Unwritten(String),
}

impl std::fmt::Display for Unmade {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Unmade::Unread(path, problem) => {
                write!(f, "{} cannot be read: {problem}", path.display())
            }
            Unmade::Refused(path, problem) => write!(f, "{}: {problem}", path.display()),
            Unmade::Exists(path) => {
                write!(f, "{} exists already; nothing was written", path.display())
            }
            Unmade::Unwritten(problem) => f.write_str(problem),
        }
    }
}

/// The text of a description, up to the size that the importer takes.
fn text_of(path: &Path) -> std::io::Result<String> {
    let mut text = String::new();
    std::fs::File::open(path)?
        .take(MOST)
        .read_to_string(&mut text)?;
    Ok(text)
}

fn imported(arguments: &Arguments) -> Result<(), Unmade> {
    let path = &arguments.description;
    let shown = path.display();
    let text = text_of(path).map_err(|problem| Unmade::Unread(path.clone(), problem))?;
    let found =
        import(&text).map_err(|problem| Unmade::Refused(path.clone(), Box::new(problem)))?;
    for note in &found.notes {
        terminal::err(&format!("{shown}:{}: {}", note.line, note.message));
    }
    let Some(out) = &arguments.out else {
        terminal::out(&found.text);
        return Ok(());
    };
    if out.exists() {
        return Err(Unmade::Exists(out.clone()));
    }
    files::write(out, found.text.as_bytes()).map_err(Unmade::Unwritten)?;
    terminal::out(&format!(
        "wrote {}\ntry:  chetaev check {}\n",
        out.display(),
        out.display()
    ));
    Ok(())
}
