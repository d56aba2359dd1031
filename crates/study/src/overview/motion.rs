//! The computed motion and its accuracy.

use crate::kept::Kept;
use crate::layout::hanging;
use crate::record::zero_word;
use crate::study::{Motion, Study};
use crate::summary::{bold, Style};
use chetaev_mechanics::words;
use chetaev_symbolic::Verdict;
use std::fmt::Write as _;

/// The motion: how it was computed, how accurate it is, what happened on the way.
pub(super) fn lines(study: &Study, style: Style) -> String {
    let Some(motion) = &study.motion else {
        return String::new();
    };
    let mut text = format!("\n{}\n", bold(style, "Motion"));
    text.push_str(&hanging("  ", &computed(motion)));
    if !motion.evidence.run.ending.finished {
        let words = format!("stopped early: {}", motion.evidence.run.ending.reason);
        text.push_str(&hanging("  ", &words));
    }
    let changes = changes(study, motion);
    if !changes.is_empty() {
        let words = format!("largest change: {}", changes.join(", "));
        text.push_str(&hanging("  ", &words));
    }
    for event in events(motion) {
        text.push_str(&hanging("  ", &event));
    }
    if let Some(kept) = Kept::of(motion) {
        let numbers: Vec<String> = kept.integrals().map(|(n, ..)| n.to_string()).collect();
        let words = format!(
            "kept by projection: first integrals {}; {}",
            numbers.join(", "),
            kept.moves()
        );
        text.push_str(&hanging("  ", &words));
    }
    text
}

/// From when to when, by which method, with which error.
fn computed(motion: &Motion) -> String {
    let run = &motion.evidence.run;
    let arithmetic = match motion.settings.precise {
        Some(_) => " in double-double arithmetic",
        None => "",
    };
    let asked = match motion.settings.step {
        Some(h) => format!("step {h}"),
        None => format!("tolerance {:e}{arithmetic}", motion.settings.tolerance),
    };
    let error = match (motion.evidence.global_error, &motion.evidence.unknown_error) {
        (Some(error), _) => format!("estimated global error {error:.1e}"),
        (None, Some(why)) => format!("global error not estimated: {why}"),
        (None, None) => "global error not estimated".into(),
    };
    format!(
        "t = {} … {} by {} at {asked}, {} steps; {error}",
        motion.start.t, run.t, run.method, run.statistics.steps
    )
}

/// By how much changed what should be constant.
fn changes(study: &Study, motion: &Motion) -> Vec<String> {
    let evidence = &motion.evidence;
    let residuals = evidence.residuals.iter().map(|r| r.drift.value);
    let mut drifts = Vec::new();
    if let Some(largest) = residuals.reduce(f64::max) {
        drifts.push(format!("constraints {largest:.1e}"));
    }
    let judged = study.verdicts.iter();
    let mut judged = judged.filter(|d| d.claim == "motion.energy-drift");
    // An energy that is not conserved changes, and does not drift.
    let is_lost = judged.any(|d| matches!(d.finding.verdict, Verdict::NotApplicable { .. }));
    if !is_lost {
        drifts.push(format!("energy {:.1e}", evidence.energy.drift.value));
    }
    // What has no value somewhere on the way has no change either; its claim says where.
    let stated = evidence.integrals.iter();
    let stated = stated.filter(|i| i.drift.value.is_finite() && i.name != "energy");
    drifts.extend(stated.map(|i| format!("{} {:.1e}", i.name, i.drift.value)));
    drifts
}

/// Zeros that are shown of each event; all are in the record.
const SHOWN: usize = 3;

fn events(motion: &Motion) -> Vec<String> {
    let run = &motion.evidence.run;
    let stated = motion.settings.events.iter().enumerate();
    stated
        .map(|(number, stated)| {
            let met: Vec<_> = run.events.iter().filter(|e| e.event == number).collect();
            let mut text = format!("event {}: ", stated.name);
            if met.is_empty() {
                text.push_str("not met");
            }
            for (place, met) in met.iter().take(SHOWN).enumerate() {
                let comma = if place == 0 { "" } else { ", " };
                let _ = write!(
                    text,
                    "{comma}{} at t = {}",
                    zero_word(met.kind),
                    words::number(met.t)
                );
            }
            if met.len() > SHOWN {
                let _ = write!(text, ", … {} in all", met.len());
            }
            text
        })
        .collect()
}
