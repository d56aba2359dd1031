//! What a person sees first of a study: the system in a line, its equations of motion, what was found, the motion.

mod equations;
pub mod found;
mod motion;

use crate::layout::hanging;
use crate::page::independent;
use crate::study::Study;
use crate::summary::{bold, coloured, Style};
use chetaev_mechanics::words::counted;
use found::{found, Found};
use std::fmt::Write as _;

/// The system, its equations of motion, what was found and the motion, in some 25 lines.
pub fn overview(study: &Study, style: Style) -> String {
    let mut text = heading(study, style);
    let _ = writeln!(text, "\n{}", bold(style, "Equations of motion"));
    text.push_str(&equations::lines(study));
    let found = found(study);
    if !found.is_empty() {
        let _ = writeln!(text, "\n{}", bold(style, "What was found"));
        for one in &found {
            text.push_str(&of_subject(one));
        }
    }
    text.push_str(&unmet(study, style));
    text.push_str(&motion::lines(study, style));
    text.push_str(&notices(study));
    text
}

/// The system and its motion alone.
pub fn of_motion(study: &Study, style: Style) -> String {
    let mut text = heading(study, style);
    text.push_str(&unmet(study, style));
    text.push_str(&motion::lines(study, style));
    text.push_str(&notices(study));
    text
}

/// The name, the coordinates and the constraints.
fn heading(study: &Study, style: Style) -> String {
    let system = &study.system;
    let names: Vec<&str> = (system.coordinates.iter().map(|c| c.name.as_str())).collect();
    let mut parts = vec![format!(
        "{} {}",
        counted(names.len(), "coordinate", "coordinates"),
        listed(&names)
    )];
    if system.constraints.is_empty() {
        parts.push("no constraints".into());
    } else {
        let kinds: Vec<String> = (system.constraints.iter())
            .map(|c| {
                let time = if c.rheonomic { ", with the time" } else { "" };
                format!("{} ({}{time})", c.name, c.kind.word())
            })
            .collect();
        let kinds: Vec<&str> = kinds.iter().map(String::as_str).collect();
        parts.push(format!(
            "{} {}",
            counted(kinds.len(), "constraint", "constraints"),
            listed(&kinds)
        ));
    }
    parts.push(independent(study));
    let mut text = format!("{}\n", bold(style, &study.model.name));
    text.push_str(&hanging("  ", &parts.join("; ")));
    text
}

/// More names than these are counted.
const LISTED: usize = 8;

fn listed(names: &[&str]) -> String {
    match names.len() {
        n if n > LISTED => format!("{}, …", names[..LISTED].join(", ")),
        _ => names.join(", "),
    }
}

/// Characters before what was found of a subject.
const SUBJECT: usize = 15;

fn of_subject(found: &Found) -> String {
    let mut first = format!("  {:<13}", found.subject);
    let mut text = String::new();
    for sentence in &found.sentences {
        text.push_str(&hanging(&first, sentence));
        first = " ".repeat(SUBJECT);
    }
    text
}

/// Verdicts that the model expects otherwise: nobody may overlook them.
fn unmet(study: &Study, style: Style) -> String {
    let mut text = String::new();
    for decided in study.verdicts.iter().filter(|d| !d.is_as_expected()) {
        let words = format!(
            "{} {}, the model expects: {}",
            decided.full_id(),
            coloured(style, decided.finding.verdict.word()).trim_end(),
            decided.expected.join(" or ")
        );
        text.push_str(&hanging("! ", &words));
    }
    text
}

/// What a reader must know.
fn notices(study: &Study) -> String {
    let notices = study.notices.iter();
    notices.map(|notice| hanging("note: ", notice)).collect()
}
