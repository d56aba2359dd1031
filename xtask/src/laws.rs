//! `cargo xtask laws`: builds the laws with optimization and runs them.

use crate::{cargo, err, laws_arguments, out, refuse, status_of};

/// Runs the task; the exit status is that of the laws.
pub(crate) fn run(words: &[String]) -> u8 {
    match laws_arguments::parse(words) {
        Err(slip) => return refuse(&slip),
        Ok(asked) if asked.help => {
            out(laws_arguments::HELP);
            return 0;
        }
        Ok(_) => {}
    }
    let started = cargo()
        .args([
            "run",
            "--quiet",
            "--release",
            "--package",
            "chetaev-laws",
            "--",
        ])
        .args(words)
        .status();
    match started {
        Ok(status) => status_of(status),
        Err(problem) => {
            err(&format!("error: cargo could not be started: {problem}\n"));
            1
        }
    }
}
