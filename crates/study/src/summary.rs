//! The summary for a terminal.

use crate::kept::{shortened as formula, Kept};
use crate::page::independent;
use crate::plain;
use crate::record::zero_word;
use crate::study::{Decided, Motion, Study};
use chetaev_mechanics::words;
use chetaev_mechanics::Group;
use chetaev_symbolic::Verdict;
use std::fmt::Write as _;

/// Colours of verdicts, or none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Style {
    /// No escape sequences.
    Plain,
    /// ANSI colours.
    Ansi,
}

/// The system, each claim with its verdict, the trajectory with its drift.
pub fn summary(study: &Study, style: Style) -> String {
    let mut text = String::new();
    heading(&mut text, study, style);
    text.push_str(&listing(study, &Group::ALL, style));
    trajectory(&mut text, study);
    for notice in &study.notices {
        let _ = writeln!(text, "note: {notice}");
    }
    text
}

pub(crate) fn bold(style: Style, words: &str) -> String {
    match style {
        Style::Plain => words.into(),
        Style::Ansi => format!("\u{1b}[1m{words}\u{1b}[0m"),
    }
}

fn heading(text: &mut String, study: &Study, style: Style) {
    let n = study.system.n();
    let kinds: Vec<String> = study
        .system
        .constraints
        .iter()
        .map(|c| {
            format!(
                "{} ({}{})",
                c.name,
                c.kind.word(),
                if c.rheonomic { ", rheonomic" } else { "" }
            )
        })
        .collect();
    let _ = writeln!(text, "{}", bold(style, &study.model.name));
    let names: Vec<&str> = study
        .system
        .coordinates
        .iter()
        .map(|c| c.name.as_str())
        .collect();
    let _ = writeln!(
        text,
        "  coordinates   n = {n}: {}",
        shortened(&names.join(", "), 80)
    );
    if kinds.is_empty() {
        let _ = writeln!(text, "  constraints   none");
    } else {
        let _ = writeln!(
            text,
            "  constraints   {}: {}",
            kinds.len(),
            shortened(&kinds.join(", "), 80)
        );
    }
    let k = if study.prepared.degenerate.is_some() {
        ""
    } else {
        "k = "
    };
    let _ = writeln!(text, "  freedom       {k}{}", independent(study));
    if !study.system.assumptions.is_empty() {
        let stated = study.system.assumption_texts();
        let _ = writeln!(
            text,
            "  assuming      {}",
            shortened(&stated.join(", "), 80)
        );
    }
}

fn shortened(text: &str, most: usize) -> String {
    if text.chars().count() <= most {
        return text.into();
    }
    let kept: String = text.chars().take(most - 1).collect();
    format!("{kept}…")
}

/// Each claim of some groups with its verdict and evidence.
pub fn listing(study: &Study, groups: &[Group], style: Style) -> String {
    let mut text = String::new();
    for &group in groups {
        let is_of = |d: &&Decided| d.group == group.word();
        let of_group: Vec<&Decided> = study.verdicts.iter().filter(is_of).collect();
        if of_group.is_empty() {
            continue;
        }
        let _ = writeln!(text, "\n{}", bold(style, group.word()));
        let ids = of_group.iter().map(|d| d.full_id().chars().count());
        let width = ids.max().unwrap_or(0);
        for decided in of_group {
            let word = decided.finding.verdict.word();
            let mark = if decided.is_as_expected() { " " } else { "!" };
            let (said, lines) = plain::listed(decided.finding.verdict.detail());
            let said = match &decided.finding.verdict {
                Verdict::Conditional { condition, .. } => format!("where {condition}: {said}"),
                _ => said,
            };
            let _ = writeln!(
                text,
                "{mark} {:<width$} {}  {}",
                decided.full_id(),
                coloured(style, word),
                for_width(style, &said)
            );
            for line in lines {
                let _ = writeln!(text, "    {}", for_width(style, &line));
            }
            if !decided.is_as_expected() {
                let _ = writeln!(
                    text,
                    "    the model expects: {}",
                    decided.expected.join(" or ")
                );
            }
        }
    }
    text
}

/// Evidence in one line on a terminal; whole where a file or a program reads it.
fn for_width(style: Style, text: &str) -> String {
    match style {
        Style::Ansi => shortened(text, 110),
        Style::Plain => text.into(),
    }
}

pub(crate) fn coloured(style: Style, word: &str) -> String {
    let padded = format!("{word:<14}");
    if style == Style::Plain {
        return padded;
    }
    let colour = match word {
        "proved" => 32,
        "numerical" => 36,
        "refuted" => 31,
        "conditional" => 33,
        _ => 90,
    };
    format!("\u{1b}[{colour}m{padded}\u{1b}[0m")
}

/// Events that are shown of each kind; all are in the record.
const SHOWN: usize = 3;

fn events(text: &mut String, motion: &Motion) {
    let run = &motion.evidence.run;
    for (number, stated) in motion.settings.events.iter().enumerate() {
        let met: Vec<_> = run.events.iter().filter(|e| e.event == number).collect();
        let shown = met.iter().take(SHOWN);
        let mut places: Vec<String> = shown
            .map(|met| {
                format!(
                    "{} at t = {}",
                    zero_word(met.kind),
                    words::precise_number(met.t)
                )
            })
            .collect();
        if met.len() > SHOWN {
            places.push(format!("… {} in all", met.len()));
        }
        let said = match places.is_empty() {
            true => "not met".into(),
            false => places.join(", "),
        };
        let _ = writeln!(text, "  event `{}`: {said}", stated.name);
    }
}

/// The integrals that were kept by projection: their changes above say nothing.
fn kept(text: &mut String, study: &Study, motion: &Motion) {
    let Some(kept) = Kept::of(motion) else { return };
    let all = kept.report.steps;
    for (number, integral, steps) in kept.integrals() {
        let _ = writeln!(
            text,
            "  kept by projection after {steps} of {all} steps: first integral {number}, {}",
            formula(&study.model.graph, integral.shown)
        );
    }
    let _ = writeln!(text, "  {}", kept.moves());
}

fn trajectory(text: &mut String, study: &Study) {
    let Some(motion) = &study.motion else { return };
    let evidence = &motion.evidence;
    let run = &evidence.run;
    let _ = writeln!(text, "\ntrajectory");
    let arithmetic = match motion.settings.precise {
        Some(_) => " in double-double",
        None => "",
    };
    let _ = writeln!(
        text,
        "  t = {} … {}  {} at {}: {} steps ({} rejected), {} evaluations, {} chart changes",
        motion.start.t,
        run.t,
        run.method,
        match motion.settings.step {
            Some(h) => format!("step {h}"),
            None => format!("tolerance {:e}{arithmetic}", motion.settings.tolerance),
        },
        run.statistics.steps,
        run.statistics.rejected,
        run.statistics.evaluations,
        run.statistics.chart_switches
    );
    if !run.ending.finished {
        let _ = writeln!(text, "  stopped early: {}", run.ending.reason);
    }
    events(text, motion);
    let constraint = evidence
        .residuals
        .iter()
        .fold(0.0, |m: f64, r| m.max(r.drift.value));
    let mut drifts = Vec::new();
    if !evidence.residuals.is_empty() {
        drifts.push(format!("constraints {constraint:.1e}"));
    }
    drifts.push(format!("energy {:.1e}", evidence.energy.drift.value));
    // What has no value somewhere on the way has no change either; its claim says where.
    let integrals = evidence.integrals.iter();
    let known = integrals.filter(|i| i.drift.value.is_finite());
    drifts.extend(known.map(|i| format!("integral `{}` {:.1e}", i.name, i.drift.value)));
    let _ = writeln!(text, "  largest change: {}", drifts.join(", "));
    kept(text, study, motion);
    let _ = match (evidence.global_error, motion.settings.step) {
        (Some(error), None) => writeln!(
            text,
            "  estimated global error {error:.1e} (second run at a tenth of the tolerance)"
        ),
        (Some(error), Some(_)) => writeln!(
            text,
            "  estimated global error {error:.1e} (second run at half the step)"
        ),
        (None, _) => match &evidence.unknown_error {
            Some(why) => writeln!(text, "  global error not estimated: {why}"),
            None => writeln!(text, "  global error not estimated"),
        },
    };
}
