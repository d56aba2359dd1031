//! `cargo xtask test`: all tests of the workspace, with what they need, and one line over all of them.

use crate::summary::Summary;
use crate::{browser, cargo, err, out, refuse, status_of};
use std::io::{BufRead, BufReader, Write};
use std::process::{ExitStatus, Stdio};

const HELP: &str = "\
All tests of the workspace

Usage: cargo xtask test

Looks for Chromium or Chrome, which the tests of the report need: the program that the environment variable CHROMIUM
names, else one in PATH. Where there is none, it is installed by apt-get if that is possible and allowed. Then every test
runs, also after a failure, and the last line sums them up. The exit status is cargo's.

  --help    this text
";

/// Runs the task; the exit status is cargo's.
pub(crate) fn run(words: &[String]) -> u8 {
    match words {
        [] => {}
        [word] if word == "--help" || word == "-h" => {
            out(HELP);
            return 0;
        }
        [word, ..] => {
            return refuse(&format!(
                "unknown argument `{word}`; `cargo xtask test` takes none"
            ))
        }
    }
    if let Err(problem) = browser::ensure() {
        err(&format!("error: {problem}\n"));
        return 1;
    }
    match tests() {
        Ok((status, mut summary)) => {
            summary.failed_elsewhere |= !status.success();
            out(&format!("\n{summary}\n"));
            status_of(status)
        }
        Err(problem) => {
            err(&format!("error: cargo could not be run: {problem}\n"));
            1
        }
    }
}

/// Runs cargo, shows everything it prints as it comes, and adds up the results.
fn tests() -> std::io::Result<(ExitStatus, Summary)> {
    let mut child = cargo()
        .args(["test", "--workspace", "--no-fail-fast"])
        .stdout(Stdio::piped())
        .spawn()?;
    let mut summary = Summary::default();
    if let Some(stdout) = child.stdout.take() {
        let mut reader = BufReader::new(stdout);
        let mut line = Vec::new();
        let mut shown = std::io::stdout();
        // Output need not be text: a test may print any bytes.
        while reader.read_until(b'\n', &mut line)? > 0 {
            let _ = shown.write_all(&line);
            let _ = shown.flush();
            summary.read(&String::from_utf8_lossy(&line));
            line.clear();
        }
    }
    Ok((child.wait()?, summary))
}
