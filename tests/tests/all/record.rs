//! `study.json` follows its schema, the schema is strict, and the page about it explains every field.
#![allow(clippy::expect_used, reason = "test code fails where it stands")]

use chetaev_tests::functional::PUT_IN;
use chetaev_tests::places::{root, scratch};
use chetaev_tests::program::{run, text};
use chetaev_tests::schema::{schema, Schema};
use chetaev_tests::studied::verdicts;
use serde_json::{json, Value};
use std::collections::BTreeSet;
use std::sync::OnceLock;

/// Records made by options, with every kind of content; those of the gallery are looked at where it is studied.
fn records() -> Vec<(String, Value)> {
    let mut records: Vec<(String, Value)> = Vec::new();
    let folder = scratch("record-options");
    let skate = "gallery/skate-level/model.toml";
    let turns: [&[&str]; 6] = [
        &["--set", "W=0.3", "--set", "m = 2/3"],
        &["--claims", "model,energy.integral", "--budget", "5"],
        &[
            "--t-end",
            "1",
            "--tolerance",
            "1e-8",
            "--method",
            "tsit5",
            "--formulation",
            "maggi",
        ],
        &["--budget", "0"],
        &[
            "--t-end",
            "1",
            "--precision",
            "double-double",
            "--claims",
            "motion",
        ],
        &["--t-end", "1", "--keep-integrals", "--claims", "motion"],
    ];
    for (i, options) in turns.into_iter().enumerate() {
        let out = folder.join(i.to_string());
        let arguments = [&["study", skate, "--out", text(&out), "--json"], options].concat();
        let finished = run(&arguments);
        records.push((format!("skate {options:?}"), finished.json()));
    }
    let out = folder.join("branch");
    let branched = [
        "study",
        "gallery/fixed-acceleration/model.toml",
        "--branch",
        "2",
        "--out",
        text(&out),
        "--json",
    ];
    records.push(("a branch that was asked for".into(), run(&branched).json()));
    let symbolic = folder.join("symbolic.toml");
    let model = "name = \"symbolic\"\ncoordinates = [\"x\", \"y\"]\nparameters = [\"m\"]\nlagrangian = \"m (x'^2 + y'^2)/2\"\nconstraints = { c = \"x' = y y'\" }\n";
    std::fs::write(&symbolic, model).expect("a model");
    let out = folder.join("symbolic");
    let finished = run(&["study", text(&symbolic), "--out", text(&out), "--json"]);
    records.push(("a symbolic model".into(), finished.json()));
    for model in [
        "gallery/elasticity/pc/model.toml",
        "gallery/elasticity/p4p/model.toml",
    ] {
        let finished = run(&["study", model, "--out", text(&out), "--json"]);
        records.push((model.into(), finished.json()));
    }
    let put_in = folder.join("put-in.toml");
    std::fs::write(&put_in, PUT_IN).expect("a model");
    let finished = run(&["study", text(&put_in), "--out", text(&out), "--json"]);
    records.push((
        "a functional of which something is put in".into(),
        finished.json(),
    ));
    records
}

#[test]
fn records_follow_the_schema() {
    let schema = Schema::read();
    let mut words: BTreeSet<String> = BTreeSet::new();
    let mut failures = Vec::new();
    for (name, record) in records() {
        if let Some(problem) = schema.problem(&record) {
            failures.push(format!("{name}: {problem}"));
        }
        words.extend(verdicts(&record).iter().map(|v| v["verdict"].to_string()));
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
    // A schema is tested only by what it has seen.
    for word in [
        "proved",
        "numerical",
        "refuted",
        "not-applicable",
        "undecided",
    ] {
        assert!(
            words.contains(&format!("\"{word}\"")),
            "no record is {word}"
        );
    }
}

fn record() -> Value {
    static RECORD: OnceLock<Value> = OnceLock::new();
    let study = || {
        let out = scratch("record-one");
        let model = "gallery/sphere-on-turntable/model.toml";
        run(&["study", model, "--out", text(&out), "--json"]).json()
    };
    RECORD.get_or_init(study).clone()
}

/// Position of the first verdict with this word.
fn of_word(record: &Value, word: &str) -> String {
    let position = verdicts(record).iter().position(|v| v["verdict"] == word);
    format!(
        "/verdicts/{}",
        position.unwrap_or_else(|| panic!("no verdict is {word}"))
    )
}

#[test]
fn broken_documents_do_not_validate() {
    let schema = Schema::read();
    let good = record();
    assert_eq!(schema.problem(&good), None);
    let proved = of_word(&good, "proved");
    let numerical = of_word(&good, "numerical");
    let refuted = of_word(&good, "refuted");
    let idle = of_word(&good, "not-applicable");
    let replaced: Vec<(String, Value)> = vec![
        ("/schema".into(), json!("chetaev-study-2")),
        ("/chetaev".into(), json!(1)),
        ("/model/text".into(), json!("")),
        ("/verdicts".into(), json!({})),
        (format!("{proved}/verdict"), json!("true")),
        (format!("{proved}/verdict"), json!("numerical")),
        (format!("{proved}/claim"), json!("model.hessian-regular#1")),
        (format!("{proved}/claim"), json!("Hessian")),
        (format!("{proved}/method"), json!(null)),
        (format!("{proved}/method"), json!("certain")),
        (format!("{proved}/method"), json!("modular")),
        (format!("{proved}/on"), json!(null)),
        (format!("{proved}/error_bound"), json!("2^-99")),
        (format!("{proved}/error_bound"), json!("2^-120")),
        (format!("{proved}/seconds"), json!(-1)),
        (format!("{proved}/detail"), json!("")),
        (format!("{proved}/expected"), json!(["yes"])),
        (format!("{numerical}/residual"), json!(null)),
        (format!("{numerical}/residual"), json!(-1e-9)),
        (format!("{numerical}/samples"), json!(1.5)),
        (format!("{numerical}/method"), json!("exact")),
        (format!("{refuted}/counterexample"), json!(null)),
        (format!("{refuted}/counterexample/residual"), json!(["1"])),
        (
            format!("{refuted}/counterexample/residual"),
            json!(["1", "2", "3"]),
        ),
        (format!("{refuted}/counterexample/residual/0"), json!(1)),
        (
            format!("{refuted}/counterexample/point/0/exact"),
            json!("0.5"),
        ),
        (
            format!("{refuted}/counterexample/point/0/exact"),
            json!("1/0"),
        ),
        (
            format!("{refuted}/counterexample/point/0/exact"),
            json!(null),
        ),
        (format!("{idle}/condition"), json!(null)),
        (format!("{idle}/condition"), json!("it is raining")),
        ("/trajectory/rows".into(), json!(-1)),
        ("/trajectory/finished".into(), json!("yes")),
        ("/trajectory/initial/0/value".into(), json!("0")),
        ("/trajectory/files".into(), json!(["../etc"])),
        ("/options/tolerance".into(), json!(0)),
        ("/options/claims".into(), json!("all")),
    ];
    for (place, value) in replaced {
        let mut document = good.clone();
        let Some(target) = document.pointer_mut(&place) else {
            panic!("{place} is not in the record");
        };
        *target = value.clone();
        assert!(
            schema.problem(&document).is_some(),
            "{place} = {value} is accepted"
        );
    }
}

#[test]
fn no_field_may_be_missing_and_none_added() {
    let schema = Schema::read();
    let good = record();
    let mut places = vec![
        String::new(),
        "/model".into(),
        "/trajectory".into(),
        "/options".into(),
    ];
    places.push("/trajectory/final/0".into());
    for word in ["proved", "numerical", "refuted", "not-applicable"] {
        places.push(of_word(&good, word));
    }
    places.push(format!("{}/counterexample", of_word(&good, "refuted")));
    places.push(format!(
        "{}/counterexample/point/0",
        of_word(&good, "refuted")
    ));
    for place in places {
        let object = good
            .pointer(&place)
            .and_then(Value::as_object)
            .expect("an object");
        for key in object.keys() {
            let mut document = good.clone();
            let object = document.pointer_mut(&place).and_then(Value::as_object_mut);
            object.expect("an object").remove(key);
            assert!(
                schema.problem(&document).is_some(),
                "{place}/{key} may be missing"
            );
        }
        let mut document = good.clone();
        let object = document.pointer_mut(&place).and_then(Value::as_object_mut);
        object.expect("an object").insert("more".into(), json!(1));
        assert!(schema.problem(&document).is_some(), "{place} may have more");
    }
}

/// Names of all properties in the schema.
fn properties(schema: &Value, found: &mut BTreeSet<String>) {
    match schema {
        Value::Object(object) => {
            if let Some(Value::Object(named)) = object.get("properties") {
                found.extend(named.keys().cloned());
            }
            object.values().for_each(|value| properties(value, found));
        }
        Value::Array(list) => list.iter().for_each(|value| properties(value, found)),
        _ => {}
    }
}

#[test]
fn the_page_explains_every_field() {
    let page = std::fs::read_to_string(root().join("docs/study-json.md")).expect("the page");
    let mut names = BTreeSet::new();
    properties(&schema(), &mut names);
    assert!(names.len() > 50);
    let explained: BTreeSet<&str> = page
        .lines()
        .filter_map(|line| line.strip_prefix("| `")?.split_once('|'))
        .flat_map(|(cell, _)| cell.split('`'))
        .collect();
    let absent: Vec<&String> = names
        .iter()
        .filter(|n| !explained.contains(n.as_str()))
        .collect();
    assert!(
        absent.is_empty(),
        "docs/study-json.md does not explain {absent:?}"
    );
}
