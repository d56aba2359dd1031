//! `cargo xtask checked`: studies the gallery and writes the ledger of what the independent checker confirms.

use crate::{cargo, err, out, refuse, status_of};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

const HELP: &str = "\
Studies every model of the gallery and writes docs/checked.md: what the checker in checker/ confirms. Needs Python 3.11.

Usage: cargo xtask checked
";

/// The claims that the checker looks at: none is about the motion, which is not computed.
const GROUPS: &str = "model,formulations,principles,integrals";

/// Runs the task: 1 where a claim is rejected or something cannot be run.
pub(crate) fn run(words: &[String]) -> u8 {
    match words.first().map(String::as_str) {
        None => {}
        Some("--help" | "-h") => {
            out(HELP);
            return 0;
        }
        Some(word) => return refuse(&format!("there is no option `{word}`\n\n{HELP}")),
    }
    match records().and_then(|folder| ledger(&folder)) {
        Ok(status) => status,
        Err(problem) => {
            err(&format!("error: {problem}\n"));
            1
        }
    }
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// The folder with a record for each model that can be studied.
fn records() -> Result<PathBuf, String> {
    let folder = root().join("target/checked");
    let models = std::fs::read_dir(root().join("gallery")).map_err(|e| e.to_string())?;
    for entry in models {
        let model = entry.map_err(|e| e.to_string())?.path().join("model.toml");
        let Some(name) = model.parent().and_then(Path::file_name) else {
            continue;
        };
        if !model.is_file() {
            continue;
        }
        let studied = cargo()
            .args([
                "run",
                "--quiet",
                "--release",
                "--package",
                "chetaev-cli",
                "--",
                "study",
            ])
            .arg(&model)
            .args(["--claims", GROUPS, "--out"])
            .arg(folder.join(name))
            .stdout(Stdio::null())
            .status();
        studied.map_err(|e| format!("cargo could not be started: {e}"))?;
    }
    Ok(folder)
}

/// Writes the page from the records.
fn ledger(folder: &Path) -> Result<u8, String> {
    let made = Command::new("python3")
        .arg("-B")
        .arg(root().join("checker/ledger.py"))
        .arg(folder)
        .stderr(Stdio::inherit())
        .output()
        .map_err(|e| format!("python3 could not be started: {e}"))?;
    if made.stdout.is_empty() {
        return Err("the ledger is empty".into());
    }
    std::fs::write(root().join("docs/checked.md"), &made.stdout).map_err(|e| e.to_string())?;
    Ok(status_of(made.status))
}
