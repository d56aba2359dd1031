//! Motions under constraints of order two and three: branches, data of the start beyond velocities, and where a run ends
//! (T2 §5, E3, E4, E4b and E5).
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    reason = "test code fails where it stands"
)]

mod branches;
mod determined;
mod initial;

use chetaev_tests::runs::{along, ended_text, Ask, Ended};

const ALL_FORMS: [&str; 4] = ["routh", "maggi", "volterra-first", "volterra-second"];

fn by(formulation: &'static str) -> Ask {
    Ask {
        claims: vec!["motion.constraint-drift"],
        formulation: Some(formulation),
        tolerance: Some(1e-12),
        ..Ask::default()
    }
}

fn run(text: &str) -> Ended {
    ended_text(text, &by("routh"))
}

/// Each expression equals its formula along the whole run, which reaches its end.
#[track_caller]
fn follows(ended: &Ended, forms: &[(&str, &str)]) {
    assert_eq!(ended.exit, 0, "{}", ended.text);
    keeps(ended, forms);
}

/// Each expression equals its formula as far as the run goes.
#[track_caller]
fn keeps(ended: &Ended, forms: &[(&str, &str)]) {
    let study = ended
        .study
        .as_ref()
        .unwrap_or_else(|| panic!("{}", ended.text));
    let run = &study.motion.as_ref().expect("a motion").evidence.run;
    for (expression, formula) in forms {
        let distance = along(study, run, &format!("({expression}) - ({formula})")).unwrap();
        assert!(distance.len() > 5, "{}", ended.text);
        let largest = distance.iter().fold(0.0, |m: f64, d| m.max(d.abs()));
        let finite = distance.iter().all(|d| d.is_finite());
        assert!(finite && largest < 1e-8, "{expression}: {largest:e}");
    }
}

#[track_caller]
fn says(ended: &Ended, words: &[&str]) {
    for word in words {
        assert!(ended.text.contains(word), "no `{word}` in: {}", ended.text);
    }
}

#[track_caller]
fn refused(text: &str, words: &[&str]) {
    let ended = run(text);
    assert_eq!(ended.exit, 2, "{}", ended.text);
    assert!(ended.study.is_none_or(|s| s.motion.is_none()));
    says(&run(text), words);
}

/// The run ends early, at this time and with these words.
#[track_caller]
fn stops(ended: &Ended, t: f64, words: &[&str]) {
    assert_eq!(ended.exit, 3, "{}", ended.text);
    says(ended, words);
    let motion = ended.study.as_ref().unwrap().motion.as_ref().unwrap();
    let at = motion.evidence.run.ending.t;
    assert!((at - t).abs() < 1e-3, "{at} instead of {t}: {}", ended.text);
}

/// Each expression equals its formula along the whole run in every form of the equations.
#[track_caller]
fn moves_in_every_form(text: &str, forms: &[(&str, &str)]) {
    for formulation in ALL_FORMS {
        follows(&ended_text(text, &by(formulation)), forms);
    }
}
