//! `cargo xtask test`: all tests of the workspace, with what they need, and one line over all of them.

use crate::extent::{commit, Extent, ALL, PARTS, VARIABLE};
use crate::summary::Summary;
use crate::{browser, cargo, err, out, python, refuse, status_of};
use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{ExitStatus, Stdio};

const HELP: &str = "\
All tests of the workspace

Usage: cargo xtask test [--full]

Looks for Chromium or Chrome, which the tests of the report need: the program that the environment variable CHROMIUM
names, else one in PATH. Where there is none, it is installed by apt-get if that is possible and allowed. Then every test
runs, also after a failure, those of the Python package last (`cargo xtask python`), and the last line sums up those of Rust. The
exit status is cargo's, or that of the Python tests.

What is long is taken by fifths: the replays of the gallery, and the random systems of the laws (ten of fifty of each family).
Which fifth follows from the commit that is checked out and is said at the start; the
environment variable CHETAEV_TESTS, a number from 0 to 4, takes another.

  --full    all of it, and more: all replays, five hundred systems of each family, five thousand mutated models
  --help    this text
";

/// Runs the task; the exit status is cargo's.
pub(crate) fn run(words: &[String]) -> u8 {
    let mut asked = std::env::var(VARIABLE).ok();
    for word in words {
        match word.as_str() {
            "--help" | "-h" => {
                out(HELP);
                return 0;
            }
            "--full" => asked = Some(ALL.to_owned()),
            _ => {
                return refuse(&format!(
                    "unknown argument `{word}`; `cargo xtask test` takes `--full`"
                ))
            }
        }
    }
    let (extent, why) = match extent(asked) {
        Ok(found) => found,
        Err(slip) => return refuse(&slip),
    };
    if let Err(problem) = browser::ensure() {
        err(&format!("error: {problem}\n"));
        return 1;
    }
    out(&format!("{why}\n"));
    let extent = match extent {
        Extent::Full => ALL.to_owned(),
        Extent::Part(part) => part.to_string(),
    };
    match tests(&extent) {
        Ok((status, mut summary)) => {
            summary.failed_elsewhere |= !status.success();
            let of_python = python::after_tests(&extent);
            summary.failed_elsewhere |= of_python != 0;
            out(&format!("\n{summary}\n"));
            status_of(status).max(of_python)
        }
        Err(problem) => {
            err(&format!("error: cargo could not be run: {problem}\n"));
            1
        }
    }
}

/// What the tests take, and a line that says so: as asked, otherwise by the commit.
fn extent(asked: Option<String>) -> Result<(Extent, String), String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let last = PARTS - 1;
    let extent = match &asked {
        Some(value) => Extent::named(value).ok_or_else(|| {
            format!("{VARIABLE} is `{value}`, neither `{ALL}` nor a number from 0 to {last}")
        })?,
        None => Extent::of_run(&root),
    };
    let why = match (asked, commit(&root)) {
        (None, Some(commit)) => format!("by commit {commit}"),
        (None, None) => "as there is no commit".to_owned(),
        (Some(_), _) => "as asked".to_owned(),
    };
    let line = match extent {
        Extent::Full => "The long tests are taken in full.".to_owned(),
        Extent::Part(part) => format!(
            "Of the long tests part {part} of 0 to {last} is taken, {why}; {VARIABLE}={part} takes it again, `--full` all."
        ),
    };
    Ok((extent, line))
}

/// Runs cargo, shows everything it prints as it comes, and adds up the results.
fn tests(extent: &str) -> std::io::Result<(ExitStatus, Summary)> {
    let mut child = cargo()
        .args(["test", "--workspace", "--no-fail-fast"])
        .env(VARIABLE, extent)
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_taken_is_said_with_how_to_take_it_again() {
        let (extent, line) = super::extent(Some("3".into())).unwrap();
        assert_eq!(extent, Extent::Part(3));
        assert!(
            line.contains("part 3") && line.contains("CHETAEV_TESTS=3"),
            "{line}"
        );
        let (extent, _) = super::extent(Some("full".into())).unwrap();
        assert_eq!(extent, Extent::Full);
        assert!(super::extent(Some("5".into())).is_err());
    }
}
