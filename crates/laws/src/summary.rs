//! Outcomes in words and figures.

use crate::check::Outcome;
use crate::generate::Family;
use crate::laws::{Expected, Kind, Trial};
use chetaev_symbolic::Verdict;
use std::collections::BTreeMap;
use std::fmt::Write;

/// One line for each family and a total, then the hypotheses that failed.
pub fn table(outcomes: &[Outcome]) -> String {
    let mut text = format!(
        "{:<24}{:>8}{:>12}{:>12}{:>12}{:>10}{:>12}{:>10}{:>7}{:>9}{:>9}{:>9}{:>9}\n",
        "family",
        "systems",
        "equal",
        "identities",
        "not-applic.",
        "pairs",
        "refuted",
        "undecided",
        "wrong",
        "median",
        "longest",
        "slowest",
        "seconds"
    );
    for family in Family::ALL {
        let of: Vec<&Outcome> = outcomes.iter().filter(|o| o.family == family).collect();
        if !of.is_empty() {
            line(&mut text, family.name(), &of);
        }
    }
    line(&mut text, "all", &outcomes.iter().collect::<Vec<_>>());
    text.push_str(
        "equal: formulations proved equal to Routh's; refuted: wrong equations; undecided: `undecided` or `numerical`; wrong: any\n\
         other verdict than expected, and systems that could not be built; median and longest: seconds of one proof of equality;\n\
         slowest: seconds of one system; seconds: of one processor\n",
    );
    for (hypothesis, count) in failing(outcomes) {
        let _ = writeln!(text, "not applicable for {hypothesis}: {count}");
    }
    text
}

fn line(text: &mut String, name: &str, outcomes: &[&Outcome]) {
    let trials: Vec<&Trial> = outcomes.iter().flat_map(|o| &o.trials).collect();
    let share = |kind: Kind, expected: Expected| {
        let asked = || {
            trials
                .iter()
                .filter(|t| t.kind == kind && t.expected == expected)
        };
        let got = asked().filter(|t| t.holds()).count();
        format!("{got}/{}", asked().count())
    };
    let not_applicable = trials
        .iter()
        .filter(|t| t.expected == Expected::NotApplicable && t.holds())
        .count();
    let failed = || trials.iter().filter(|t| !t.holds());
    let undecided = failed().filter(|t| is_open(&t.verdict)).count();
    let unbuilt = outcomes.iter().filter(|o| o.problem.is_some()).count();
    let wrong = failed().count() - undecided + unbuilt;
    let mut proofs: Vec<f64> = trials
        .iter()
        .filter(|t| t.kind == Kind::Formulation && t.expected == Expected::Proved)
        .map(|t| t.seconds)
        .collect();
    proofs.sort_by(f64::total_cmp);
    let median = proofs.get(proofs.len() / 2).copied().unwrap_or(0.0);
    let longest = proofs.last().copied().unwrap_or(0.0);
    let seconds: f64 = outcomes.iter().map(|o| o.seconds).sum();
    let slowest = outcomes.iter().fold(0.0_f64, |m, o| m.max(o.seconds));
    // Writing to a string cannot fail.
    let _ = writeln!(
        text,
        "{name:<24}{:>8}{:>12}{:>12}{not_applicable:>12}{:>10}{:>12}{undecided:>10}{wrong:>7}{median:>9.3}{longest:>9.2}{slowest:>9.2}{seconds:>9.1}",
        outcomes.len(),
        share(Kind::Formulation, Expected::Proved),
        share(Kind::Identity, Expected::Proved),
        share(Kind::Pair, Expected::Proved),
        share(Kind::Mutant, Expected::Refuted),
    );
}

fn is_open(verdict: &Verdict) -> bool {
    matches!(verdict, Verdict::Undecided { .. } | Verdict::Numerical(_))
}

/// How often which hypothesis was named.
fn failing(outcomes: &[Outcome]) -> BTreeMap<String, usize> {
    let mut found = BTreeMap::new();
    for trial in outcomes.iter().flat_map(|o| &o.trials) {
        if let Verdict::NotApplicable { hypothesis, .. } = &trial.verdict {
            *found.entry(format!("`{hypothesis}`")).or_insert(0) += 1;
        }
    }
    found
}

/// Seconds by law, the longest first.
pub fn times(outcomes: &[Outcome]) -> String {
    let mut by_law: BTreeMap<&str, f64> = BTreeMap::new();
    for trial in outcomes.iter().flat_map(|o| &o.trials) {
        *by_law.entry(trial.law).or_insert(0.0) += trial.seconds;
    }
    let mut laws: Vec<(&str, f64)> = by_law.into_iter().collect();
    laws.sort_by(|a, b| b.1.total_cmp(&a.1));
    let mut text = String::new();
    for (law, seconds) in laws {
        let _ = writeln!(text, "{seconds:>9.1} s  {law}");
    }
    text
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
                "  {}: {}, expected {}\n    {}",
                trial.title(),
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
