//! Outcomes in words and figures.

use crate::check::Outcome;
use crate::generate::Family;
use crate::laws::Expected;
use std::fmt::Write;

/// One line for each family, and a total.
pub fn table(outcomes: &[Outcome]) -> String {
    let mut text = format!(
        "{:<24}{:>8}{:>14}{:>16}{:>10}{:>10}{:>10}{:>9}\n",
        "family", "systems", "proved", "wrong refuted", "failures", "seconds", "slowest", "largest"
    );
    for family in Family::ALL {
        let of: Vec<&Outcome> = outcomes.iter().filter(|o| o.family == family).collect();
        if !of.is_empty() {
            line(&mut text, family.name(), &of);
        }
    }
    line(&mut text, "all", &outcomes.iter().collect::<Vec<_>>());
    text.push_str(
        "seconds: of one processor; slowest: seconds of one system; largest: nodes of a difference proved zero\n",
    );
    text
}

fn line(text: &mut String, name: &str, outcomes: &[&Outcome]) {
    let tally = |expected| {
        let (asked, got) = outcomes
            .iter()
            .map(|o| o.tally(expected))
            .fold((0, 0), |a, b| (a.0 + b.0, a.1 + b.1));
        format!("{got}/{asked}")
    };
    let seconds: f64 = outcomes.iter().map(|o| o.seconds).sum();
    let slowest = outcomes.iter().fold(0.0_f64, |m, o| m.max(o.seconds));
    let largest = outcomes.iter().map(|o| o.nodes).max().unwrap_or(0);
    let failures = outcomes.iter().filter(|o| !o.holds()).count();
    // Writing to a string cannot fail.
    let _ = writeln!(
        text,
        "{name:<24}{:>8}{:>14}{:>16}{failures:>10}{seconds:>10.1}{slowest:>10.2}{largest:>9}",
        outcomes.len(),
        tally(Expected::Proved),
        tally(Expected::Refuted),
    );
}

/// Every failure with its model and the command that repeats it; empty when there is none.
pub fn failures(outcomes: &[Outcome]) -> String {
    let mut text = String::new();
    for outcome in outcomes.iter().filter(|o| !o.holds()) {
        let (name, seed) = (outcome.family.name(), outcome.seed);
        let _ = writeln!(text, "\ncargo xtask laws --family {name} --seed {seed}");
        if let Some(problem) = &outcome.problem {
            let _ = writeln!(text, "  no system: {problem}");
        }
        for trial in outcome.failed() {
            let _ = writeln!(
                text,
                "  {} {}: {}, expected {}\n    {}",
                trial.formulation,
                trial.law,
                trial.verdict.word(),
                trial.expected.word(),
                trial.verdict.detail()
            );
            if !trial.about.is_empty() {
                let _ = writeln!(text, "    {}", trial.about);
            }
        }
        for line in outcome.text.lines() {
            let _ = writeln!(text, "    | {line}");
        }
    }
    text
}
