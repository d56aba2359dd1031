//! Runs the laws: `cargo xtask laws`.

use chetaev_laws::arguments::{self, Arguments};
use chetaev_laws::{check, check_all, failures, table, times, Family, Outcome};
use std::io::{IsTerminal, Write};
use std::process::ExitCode;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let (text, status) = match arguments::parse(&words) {
        Ok(asked) if asked.help => (arguments::HELP.to_string(), 0),
        Ok(asked) => run(&asked),
        Err(slip) => {
            say(&mut std::io::stderr(), &format!("error: {slip}\n"));
            return ExitCode::from(2);
        }
    };
    say(&mut std::io::stdout(), &text);
    ExitCode::from(status)
}

/// A closed pipe is no reason to fail: the reader has seen what it wanted.
fn say(to: &mut dyn Write, text: &str) {
    let _ = to.write_all(text.as_bytes());
    let _ = to.flush();
}

fn run(asked: &Arguments) -> (String, u8) {
    let families: Vec<Family> = asked
        .families
        .iter()
        .filter_map(|name| Family::named(name))
        .collect();
    let outcomes = match asked.seed {
        Some(seed) => families.iter().map(|&f| check(f, seed)).collect(),
        None => many(&families, asked.count),
    };
    let mut text = match asked.seed {
        Some(_) => outcomes.iter().map(story).collect(),
        None => format!("{}\n{}", table(&outcomes), times(&outcomes)),
    };
    text.push_str(&failures(&outcomes));
    let holds = outcomes.iter().all(Outcome::holds);
    (text, u8::from(!holds))
}

fn many(families: &[Family], count: u64) -> Vec<Outcome> {
    let all = families.len() * count as usize;
    let finished = AtomicUsize::new(0);
    let shown = std::io::stderr().is_terminal();
    let done = |outcome: &Outcome, time: Duration| {
        let finished = finished.fetch_add(1, Ordering::Relaxed) + 1;
        if shown {
            let seconds = time.as_secs();
            let name = outcome.family.name();
            let line = format!("\r{finished} of {all} systems, {seconds} s ({name})    ");
            say(&mut std::io::stderr(), &line);
        }
    };
    let outcomes = check_all(families, count, &done);
    if shown {
        say(&mut std::io::stderr(), "\n");
    }
    outcomes
}

/// One system with the verdict of every law.
fn story(outcome: &Outcome) -> String {
    let mut text = format!("{}\n", outcome.text);
    for trial in &outcome.trials {
        let (word, seconds) = (trial.verdict.word(), trial.seconds);
        let title = trial.title();
        text.push_str(&format!("{title}: {word}, {seconds:.2} s\n"));
        for line in [&trial.about[..], trial.verdict.detail()] {
            if !line.is_empty() {
                text.push_str(&format!("    {line}\n"));
            }
        }
    }
    let (nodes, seconds) = (outcome.nodes, outcome.seconds);
    text.push_str(&format!("{nodes} nodes, {seconds:.2} s\n"));
    text
}
