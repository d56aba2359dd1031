//! House tasks: `cargo xtask test`, `cargo xtask laws`, `cargo xtask measure`,
//! `cargo xtask lines`, `cargo xtask fuzz`, `cargo xtask python`, `cargo xtask checked`, `cargo xtask web`, `cargo xtask book`, `cargo xtask bench`.

mod bench;
mod book;
mod browser;
mod checked;
// A test and a figure of the house, by the same rules.
#[path = "../../tests/src/citations.rs"]
#[allow(dead_code, unreachable_pub, reason = "public where the tests are")]
mod citations;
// The tests and the task that runs them agree on what is long.
#[path = "../../tests/src/extent.rs"]
#[allow(dead_code, unreachable_pub, reason = "public where the tests are")]
mod extent;
mod fuzz;
mod laws;
// The arguments of the laws are read here too, so that a slip is refused before anything is built.
#[path = "../../crates/laws/src/arguments.rs"]
#[allow(unreachable_pub, reason = "public in its own crate")]
mod laws_arguments;
mod lines;
// A test and a figure of the house, by the same rules.
#[path = "../../tests/src/lines.rs"]
#[allow(dead_code, unreachable_pub, reason = "public where the tests are")]
mod lines_of_models;
mod measure;
mod python;
mod stub;
mod summary;
mod test;
mod web;

use std::io::Write;
use std::process::ExitCode;

const HELP: &str = "\
House tasks

Usage: cargo xtask <TASK> [ARGUMENTS]

  test      all tests of the workspace; installs what they need
  laws      random systems and the laws they must obey
  measure   figures of the house: lines, circles of imports, errors that are texts, citations
  lines     how many lines the models of bodies have
  fuzz      coverage-guided fuzzing of what reads texts
  checked   what the independent checker confirms of the gallery, as a page
  python    the Python package in a virtual environment, and its tests
  book      the book as pages for a browser, made by mdBook
  web       the playground in the browser, and its tests
  bench     the benchmark, and the page of the book made of it
  help      this text

`cargo xtask <TASK> --help` says more.
";

/// The arguments are wrong.
const USAGE: u8 = 2;

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let (task, rest) = match words.split_first() {
        Some((task, rest)) => (task.as_str(), rest),
        None => ("help", &[][..]),
    };
    let status = match task {
        "test" => test::run(rest),
        "laws" => laws::run(rest),
        "measure" => measure::run(rest),
        "lines" => lines::run(rest),
        "fuzz" => fuzz::run(rest),
        "python" => python::run(rest),
        "web" => web::run(rest),
        "bench" => bench::run(rest),
        "book" => book::run(rest),
        "checked" => checked::run(rest),
        "help" | "--help" | "-h" => {
            out(HELP);
            0
        }
        _ => refuse(&format!("there is no task `{task}`\n\n{HELP}")),
    };
    ExitCode::from(status)
}

/// Prints to standard output. A closed pipe is no reason to fail.
fn out(text: &str) {
    let mut stdout = std::io::stdout();
    let _ = stdout.write_all(text.as_bytes());
    let _ = stdout.flush();
}

/// Prints to standard error.
fn err(text: &str) {
    let _ = std::io::stderr().write_all(text.as_bytes());
}

/// Says what is wrong with the arguments.
fn refuse(problem: &str) -> u8 {
    err(&format!("error: {}\n", problem.trim_end()));
    USAGE
}

/// The exit status of a command as one of ours; ended by a signal counts as failed.
fn status_of(status: std::process::ExitStatus) -> u8 {
    match status.code() {
        Some(code) => u8::try_from(code).unwrap_or(1),
        None => 1,
    }
}

/// Cargo itself, the one that runs this task.
fn cargo() -> std::process::Command {
    std::process::Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()))
}
