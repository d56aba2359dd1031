//! `chetaev verify --independent`: the checker of the folder `checker`, which shares no code with this program, run by Python.

use super::super::error;
use crate::{DONE, INPUT, UNMET};
use chetaev::checker::FILES;
use std::io;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// Exit status for what is asked of a Python.
const TOO_OLD: &str = "import sys; sys.exit(sys.version_info < (3, 11))";

/// Runs the checker on a record; its output is that of this process.
pub(super) fn run(record: &Path, json: bool) -> u8 {
    let Some(python) = python() else {
        error("`--independent` needs Python 3.11 or later, and neither `python3` nor `python` is one; without `--independent` the record is replayed by this program");
        return INPUT;
    };
    match in_a_folder(|folder| examine(python, folder, record, json)) {
        Ok(Some(0)) => DONE,
        Ok(Some(1)) => UNMET,
        Ok(_) => INPUT,
        Err(problem) => {
            error(format!("the checker cannot be run: {problem}"));
            INPUT
        }
    }
}

/// The name of a Python that is recent enough.
fn python() -> Option<&'static str> {
    ["python3", "python"].into_iter().find(|name| {
        let asked = Command::new(name)
            .args(["-I", "-c", TOO_OLD])
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .status();
        asked.is_ok_and(|status| status.success())
    })
}

fn examine(python: &str, folder: &Path, record: &Path, json: bool) -> io::Result<Option<i32>> {
    for (name, text) in FILES {
        std::fs::write(folder.join(name), text)?;
    }
    let mut command = Command::new(python);
    command
        .args(["-I", "-B"])
        .arg(folder.join("check_study.py"));
    // A name that begins with a dash is no option.
    command.arg(std::path::absolute(record)?);
    if json {
        command.arg("--json");
    }
    Ok(command.stdin(Stdio::null()).status()?.code())
}

/// Does something in a new folder of its own, and removes it.
fn in_a_folder<T>(work: impl FnOnce(&Path) -> io::Result<T>) -> io::Result<T> {
    let folder: PathBuf =
        std::env::temp_dir().join(format!("chetaev-checker-{}", std::process::id()));
    // A folder that is there already is another's: it is left alone, and the call fails.
    std::fs::create_dir(&folder)?;
    let done = std::fs::create_dir(folder.join("claims")).and_then(|()| work(&folder));
    let removed = std::fs::remove_dir_all(&folder);
    let done = done?;
    removed.map(|()| done)
}
