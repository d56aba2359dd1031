//! The page on errors of programs says what the models beside it show.
#![allow(clippy::expect_used, reason = "test code fails where it stands")]

use chetaev_tests::places::{root, scratch};
use chetaev_tests::program::{run, text};
use std::path::Path;

/// One entry: its model, and what the page states beside it that can be computed.
fn entries() -> Vec<(String, String)> {
    let page = std::fs::read_to_string(root().join("docs/book/audit.md")).expect("the page");
    let entries = page.split("\n### ").skip(1);
    let model = |entry: &str| {
        let (_, line) = entry.split_once("- Model: `").expect("a model");
        line.split('`').next().expect("its name").to_owned()
    };
    entries
        .map(|entry| (model(entry), entry.to_owned()))
        .collect()
}

fn path(model: &str) -> String {
    format!("docs/book/audit/{model}")
}

#[test]
fn every_model_has_an_entry() {
    let named: Vec<String> = entries().into_iter().map(|(model, _)| model).collect();
    let models = std::fs::read_dir(root().join("docs/book/audit")).expect("the folder");
    let mut count = 0;
    for model in models.filter_map(Result::ok) {
        let name = model.file_name().to_string_lossy().into_owned();
        assert!(named.contains(&name), "{name} has no entry");
        count += 1;
    }
    assert_eq!(count, named.len());
}

#[test]
fn equations_of_programs_are_refuted_and_ours_proved() {
    for (model, _) in entries() {
        if model == "slipping-start.toml" {
            continue;
        }
        let out = scratch(&format!("audit-{}", model.trim_end_matches(".toml")));
        let arguments = ["study", &path(&model), "--claims", "equations.stated"];
        let told = run(&[&arguments[..], &["--out", text(&out)]].concat());
        // Every verdict is the one that the model expects.
        assert_eq!(told.status, Some(0), "{model}: {}", told.both());
        let record = std::fs::read_to_string(out.join("study.json")).expect("a record");
        let record: serde_json::Value = serde_json::from_str(&record).expect("JSON");
        let words = record["verdicts"].as_array().expect("verdicts").iter();
        let words: Vec<&str> = words.filter_map(|v| v["verdict"].as_str()).collect();
        assert_eq!(
            words.iter().filter(|w| **w == "proved").count(),
            1,
            "{model}"
        );
        assert_eq!(
            words.iter().filter(|w| **w == "refuted").count(),
            1,
            "{model}"
        );
    }
}

/// 2/3 and 2/(3 · 0.3): what an impulse at the point of contact leaves of 1 m/s, with the moment of inertia m r²/2.
#[test]
fn a_start_that_slips_is_refused_with_the_nearest_that_rolls() {
    let out = scratch("audit-slipping");
    let model = path("slipping-start.toml");
    assert!(root().join(Path::new(&model)).exists());
    let told = run(&["study", &model, "--out", text(&out)]);
    assert_ne!(told.status, Some(0));
    for words in ["0.66666", "2.22222", "--project"] {
        assert!(told.both().contains(words), "{}", told.both());
    }
    let told = run(&["simulate", &model, "--project", "--out", text(&out)]);
    assert_eq!(told.status, Some(0), "{}", told.both());
    assert!(told.both().contains("0.66666"), "{}", told.both());
}
