//! `cargo xtask fuzz`: coverage-guided fuzzing of what reads texts, by libFuzzer on the nightly compiler that is there.

use crate::{err, out, refuse};
use std::path::Path;
use std::process::{Command, Stdio};

const HELP: &str = "\
Coverage-guided fuzzing

Usage: cargo xtask fuzz [--seconds N] [TARGET...]

  parse      any text is parsed, and what an expression prints is read as the same expression
  resolve    any text is a model or gives diagnostics
  zero       true identities are never refuted
  lower      programs are valid, and a state has the same bits alone and in a block
  record     any text is a record or an error

Without targets all of them run, each for N seconds (20). What is found new goes into fuzz/corpus, what fails into
fuzz/artifacts. The task needs a nightly compiler, which it does not install: where there is none, it says that nothing was run.
";

const TARGETS: [&str; 5] = ["parse", "resolve", "zero", "lower", "record"];

/// Megabytes a target may take; more is a failure.
const MEMORY: u32 = 2048;

/// Runs up to so many seconds are the same every time, so that a change is not refused by chance; longer ones are drawn anew.
const REPEATED: u32 = 60;

/// Seconds one input may take by the clock; more is a failure. A shared machine may stand still for some ten seconds, and what hangs
/// hangs longer.
const SLOWEST: u32 = 60;

/// Runs the task; the exit status is not zero where a target failed.
pub(crate) fn run(words: &[String]) -> u8 {
    let mut seconds = 20_u32;
    let mut targets: Vec<&str> = Vec::new();
    let mut words = words.iter();
    while let Some(word) = words.next() {
        match word.as_str() {
            "--help" | "-h" => {
                out(HELP);
                return 0;
            }
            "--seconds" => match words.next().and_then(|n| n.parse().ok()) {
                Some(n) => seconds = n,
                None => return refuse("`--seconds` takes a number"),
            },
            name => match TARGETS.iter().find(|own| **own == name) {
                Some(target) => targets.push(target),
                None => return refuse(&format!("there is no target `{name}`\n\n{HELP}")),
            },
        }
    }
    if targets.is_empty() {
        targets.extend(TARGETS);
    }
    let Some(compiler) = nightly() else {
        out("fuzz: skipped, there is no nightly compiler (rustup toolchain install nightly)\n");
        return 0;
    };
    if !has_cpp() {
        out("fuzz: skipped, there is no C++ compiler, which libFuzzer is built by\n");
        return 0;
    }
    fuzz(&compiler, &targets, seconds)
}

fn has_cpp() -> bool {
    let asked = Command::new("c++").arg("--version").output();
    asked.is_ok_and(|asked| asked.status.success())
}

/// The name of a nightly compiler that is there.
fn nightly() -> Option<String> {
    let listed = Command::new("rustup")
        .args(["toolchain", "list"])
        .output()
        .ok()?;
    let text = String::from_utf8(listed.stdout).ok()?;
    let line = text.lines().find(|line| line.starts_with("nightly"))?;
    line.split_whitespace().next().map(str::to_owned)
}

fn fuzz(compiler: &str, targets: &[&str], seconds: u32) -> u8 {
    if !built(compiler) {
        err("error: the targets could not be built\n");
        return 1;
    }
    let mut failed = 0;
    for target in targets {
        match run_target(target, seconds) {
            Ok(line) => out(&format!("fuzz {target}: {line}\n")),
            Err(problem) => {
                err(&format!("error: fuzz {target}: {problem}\n"));
                failed = 1;
            }
        }
    }
    failed
}

/// Builds the targets with counters of what is reached, which libFuzzer reads, and with the checks of debug builds.
fn built(compiler: &str) -> bool {
    let flags = "-Cpasses=sancov-module -Cllvm-args=-sanitizer-coverage-level=4 \
                 -Cllvm-args=-sanitizer-coverage-inline-8bit-counters -Cllvm-args=-sanitizer-coverage-pc-table \
                 -Cllvm-args=-sanitizer-coverage-trace-compares -Ccodegen-units=1 -Cdebug-assertions --cfg fuzzing";
    let built = Command::new("rustup")
        .args([
            "run",
            compiler,
            "cargo",
            "build",
            "--release",
            "--quiet",
            "--bins",
        ])
        .args(["--target", TRIPLE])
        .current_dir("fuzz")
        .env("RUSTFLAGS", flags)
        .env_remove("CARGO")
        .status();
    built.is_ok_and(|status| status.success())
}

/// With a target named the flags do not reach programs of the build itself.
const TRIPLE: &str = if cfg!(target_arch = "aarch64") {
    "aarch64-unknown-linux-gnu"
} else {
    "x86_64-unknown-linux-gnu"
};

/// The last line in which libFuzzer sums up, or the input that failed.
fn run_target(target: &str, seconds: u32) -> Result<String, String> {
    let corpus = format!("fuzz/corpus/{target}");
    let artifacts = format!("fuzz/artifacts/{target}/");
    for folder in [&corpus, &artifacts] {
        std::fs::create_dir_all(folder).map_err(|e| format!("{folder}: {e}"))?;
    }
    let program = Path::new("fuzz/target")
        .join(TRIPLE)
        .join("release")
        .join(target);
    let seeds = format!("fuzz/seeds/{target}");
    let finished = Command::new(program)
        .args([&corpus, &seeds])
        .arg(format!("-max_total_time={seconds}"))
        .arg(format!("-seed={}", u32::from(seconds <= REPEATED)))
        .arg(format!("-timeout={SLOWEST}"))
        .arg(format!("-rss_limit_mb={MEMORY}"))
        .arg(format!("-artifact_prefix={artifacts}"))
        .args(["-print_final_stats=1", "-dict=fuzz/words.dict"])
        .stdout(Stdio::null())
        .output()
        .map_err(|e| e.to_string())?;
    let told = String::from_utf8_lossy(&finished.stderr).into_owned();
    if finished.status.success() {
        let runs = told.lines().rev().find(|line| line.starts_with("Done "));
        return Ok(runs.unwrap_or("done").to_owned());
    }
    let from = told
        .find("panicked at")
        .or_else(|| told.find("ERROR: libFuzzer"));
    let shown: String = told[from.unwrap_or(0)..].chars().take(600).collect();
    Err(format!("{shown}\nthe input is in {artifacts}"))
}
