//! Our accelerations are those of the references: 60 digits from the Lagrangian itself, with which every hand form agrees.
#![allow(clippy::expect_used, reason = "test code fails where it stands")]

use chetaev_bench::prepare;
use chetaev_bench::question::Question;
use serde_json::{json, Value};

const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");

fn references() -> Value {
    let text = std::fs::read_to_string(format!("{ROOT}/bench/reference.json"));
    serde_json::from_str(&text.expect("bench/reference.json")).expect("JSON")
}

fn question(item: &str, system: &str, variant: &str, reference: &Value) -> Question {
    let asked = json!({
        "item": item, "system": system, "variant": variant, "root": ROOT, "tolerance": 1e-12,
        "states": reference["states"], "start": reference["start"], "t_end": reference["t_end"],
    });
    Question::read(&asked).expect("a question")
}

fn rows(value: &Value) -> Vec<Vec<f64>> {
    serde_json::from_value(value.clone()).expect("rows of numbers")
}

/// Largest |x − y| over the largest |y| of the row, or 1.
fn deviation(found: &[Vec<f64>], expected: &[Vec<f64>]) -> f64 {
    assert_eq!(found.len(), expected.len());
    let mut worst = 0.0_f64;
    for (x, y) in found.iter().zip(expected) {
        assert_eq!(x.len(), y.len());
        let scale = y.iter().fold(1.0_f64, |m, y| m.max(y.abs()));
        let off = x.iter().zip(y).map(|(x, y)| (x - y).abs() / scale);
        worst = off.fold(worst, f64::max);
    }
    worst
}

/// The velocity of a link is that of the link before it and a little more, and so are its derivatives (Featherstone 1983): twice as
/// many links cost twice as much.
#[test]
fn a_chain_costs_like_its_length() {
    let references = references();
    let instructions = |links: usize| {
        let system = format!("snake-{links}");
        let reference = &references[&system];
        let asked = question("rhs", &system, "reduced", reference);
        let ready = prepare(&asked).unwrap_or_else(|e| panic!("{system}: {e}"));
        let off = deviation(&rows(&ready.answer), &rows(&reference["accelerations"]));
        assert!(off < 1e-12, "{system}: off by {off:e}");
        ready.info["instructions"].as_f64().expect("a number")
    };
    let [eight, sixteen, thirty_two] = [8, 16, 32].map(instructions);
    for growth in [sixteen / eight, thirty_two / sixteen] {
        assert!(growth < 2.25, "{eight}, {sixteen}, {thirty_two}");
    }
}

#[test]
fn accelerations_are_those_of_the_references() {
    let references = references();
    let systems = [
        "sleigh",
        "disc",
        "rattleback",
        "appell-hamel",
        "bicycle",
        "snake-2",
        "snake-8",
    ];
    for system in systems {
        let reference = &references[system];
        for variant in ["flow", "boltzmann-hamel"] {
            let asked = question("rhs", system, variant, reference);
            let ready = prepare(&asked).unwrap_or_else(|e| panic!("{system}, {variant}: {e}"));
            let off = deviation(&rows(&ready.answer), &rows(&reference["accelerations"]));
            assert!(off < 1e-12, "{system}, {variant}: off by {off:e}");
        }
    }
}

#[test]
fn a_state_off_the_reference_is_seen() {
    let references = references();
    let mut other = references["disc"].clone();
    let speed = other["states"][0][9].as_f64().expect("a number");
    other["states"][0][9] = json!(speed + 1e-3);
    let ready = prepare(&question("rhs", "disc", "flow", &other)).expect("the disc");
    let off = deviation(
        &rows(&ready.answer),
        &rows(&references["disc"]["accelerations"]),
    );
    assert!(off > 1e-6, "{off:e}");
}

#[test]
fn trajectories_end_where_the_references_end() {
    let references = references();
    for system in ["sleigh", "snake-2", "appell-hamel"] {
        let reference = &references[system];
        let ready = prepare(&question("trajectory", system, "taylor", reference));
        let ready = ready.unwrap_or_else(|e| panic!("{system}: {e}"));
        let off = deviation(
            &rows(&ready.answer),
            &[rows(&json!([reference["end"]]))[0].clone()],
        );
        assert!(off < 1e-9, "{system}: off by {off:e}");
    }
}

#[test]
fn questions_are_answered_line_by_line() {
    let reference = &references()["sleigh"];
    let asked = json!({
        "do": "prepare", "item": "derive", "system": "sleigh", "variant": "flow", "root": ROOT,
        "states": reference["states"],
    });
    let input = format!("{asked}\n{{\"do\": \"measure\"}}\nnonsense\n");
    let mut output = Vec::new();
    chetaev_bench::serve(input.as_bytes(), &mut output).expect("streams in memory");
    let output = String::from_utf8(output).expect("text");
    let answers: Vec<Value> = output
        .lines()
        .map(|line| serde_json::from_str(line).expect("JSON"))
        .collect();
    assert_eq!(answers.len(), 3);
    assert!(answers.iter().all(|a| a["ok"] == true), "{output}");
    let seconds = answers[1]["seconds"].as_f64().expect("seconds");
    assert!(seconds > 0.0 && seconds < 60.0, "{seconds}");
    let off = deviation(
        &rows(&answers[1]["answer"]),
        &rows(&reference["accelerations"])[..1],
    );
    assert!(off < 1e-12, "{off:e}");
}

#[test]
fn what_does_not_exist_is_refused() {
    for (item, system, variant) in [
        ("rhs", "unicycle", "flow"),
        ("dance", "disc", "flow"),
        ("rhs", "sleigh", "newton"),
    ] {
        let asked = question(item, system, variant, &references()["sleigh"]);
        assert!(prepare(&asked).is_err(), "{item} {system} {variant}");
    }
    assert!(Question::read(&json!({"item": "rhs"})).is_err());
}
