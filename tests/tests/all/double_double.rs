//! Motions in double-double arithmetic from the command line: digits, drift, and what is refused.
#![allow(clippy::unwrap_used, reason = "test code fails where it stands")]

use chetaev::compile::double_double::from_rational;
use chetaev::motion::DoubleDouble;
use chetaev::symbolic::{rational, Rational};
use chetaev_tests::places::{root, scratch};
use chetaev_tests::program::{run, text, Finished};
use std::path::PathBuf;

/// A decimal such as `-1.25e-3`, exactly.
fn decimal(word: &str) -> DoubleDouble {
    let (digits, exponent) = word.split_once('e').unwrap_or((word, "0"));
    let (whole, part) = digits.split_once('.').unwrap_or((digits, ""));
    let all: String = [whole, part].concat();
    let number: Rational = all.parse().unwrap();
    let shift = exponent.parse::<i64>().unwrap() - part.len() as i64;
    let power = rational::powi(&rational::integer(10), shift).unwrap();
    from_rational(&(number * power))
}

/// The column of a table, by its name.
fn column(csv: &str, name: &str) -> Vec<DoubleDouble> {
    let mut lines = csv.lines();
    let place = lines.next().unwrap().split(',').position(|own| own == name);
    let place = place.unwrap();
    lines
        .map(|line| decimal(line.split(',').nth(place).unwrap()))
        .collect()
}

fn model(name: &str, body: &str) -> PathBuf {
    let folder = scratch(&format!("double-double-{name}"));
    let path = folder.join("model.toml");
    std::fs::write(&path, body).unwrap();
    path
}

fn simulate(path: &std::path::Path, more: &[&str]) -> (Finished, PathBuf) {
    let out = path.parent().unwrap().join("out");
    let mut arguments = vec!["simulate", text(path), "--json", "--out", text(&out)];
    arguments.extend(more);
    (run(&arguments), out)
}

/// x'' = −k x, x(0) = 1: x = cos √k t.
const OSCILLATOR: &str = "
coordinates = [\"x\"]
lagrangian = \"1/2 x'^2 - 1/2 k x^2\"
[parameters]
k = 0.1
[initial]
x = 1
[simulation]
t_end = 0.7
output = 7
";

#[test]
fn decimals_of_the_model_are_exact() {
    let body = format!("{OSCILLATOR}precision = \"double-double\"\ntolerance = 1e-28\n");
    let path = model("oscillator", &body);
    let tenth = DoubleDouble::ONE / DoubleDouble::from(10.0);
    for (end, count) in [("0.7", 7.0), ("77/10", 77.0)] {
        let (ended, out) = simulate(&path, &["--t-end", end]);
        assert_eq!(ended.status, Some(0), "{}", ended.both());
        assert_eq!(ended.json()["precision"], "double-double");
        let csv = std::fs::read_to_string(out.join("trajectory.csv")).unwrap();
        let (times, xs) = (column(&csv, "t"), column(&csv, "x"));
        assert_eq!(times.len(), 8);
        for (j, (&t, &x)) in times.iter().zip(&xs).enumerate() {
            let expected = tenth * (count / 7.0) * j as f64;
            assert!((t - expected).abs().high() < 1e-30, "{t:?}");
            let error = (x - (tenth.sqrt() * expected).cos()).abs().high();
            assert!(error < 1e-29, "{end} {j}: {error:e}");
        }
    }
}

#[test]
fn the_rolling_disc_keeps_its_energy_to_25_digits() {
    let folder = scratch("double-double-disc");
    let path = root().join("gallery/falling-rolling-disc/model.toml");
    let out = folder.join("out");
    let ended = run(&[
        "simulate",
        text(&path),
        "--json",
        "--precision",
        "double-double",
        "--method",
        "taylor",
        "--tolerance",
        "1e-25",
        "--out",
        text(&out),
    ]);
    assert_eq!(ended.status, Some(0), "{}", ended.both());
    let record = ended.json();
    let drifts = record["drifts"].as_array().unwrap();
    assert!(drifts.len() >= 4, "{drifts:?}");
    for drift in drifts {
        let value = drift["value"].as_f64().unwrap();
        assert!(value < 1e-23, "{drift}");
    }
    // Rounding of doubles would show in the seventeenth digit.
    let csv = std::fs::read_to_string(out.join("trajectory.csv")).unwrap();
    let energy = column(&csv, "energy");
    let changes = energy.iter().map(|&e| (e - energy[0]).abs().high());
    let largest = changes.fold(0.0, f64::max);
    assert!(
        largest < 1e-23 && energy.iter().any(|e| e.low() != 0.0),
        "{largest:e}"
    );
}

#[test]
fn what_cannot_be_done_says_what_to_do() {
    let path = model("refused", OSCILLATOR);
    let said = |more: &[&str], words: &[&str]| {
        let (ended, _) = simulate(&path, more);
        assert_eq!(ended.status, Some(2), "{}", ended.both());
        for word in words {
            assert!(ended.err.contains(word), "{word}: {}", ended.both());
        }
    };
    said(
        &["--method", "taylor", "--tolerance", "1e-20"],
        &["out of range", "--precision double-double"],
    );
    let precise = ["--precision", "double-double"];
    said(
        &[&precise[..], &["--tolerance", "1e-30"]].concat(),
        &["1e-28"],
    );
    said(
        &[&precise[..], &["--method", "dop853"]].concat(),
        &["dormand-prince-853", "--method taylor"],
    );
    said(
        &[&precise[..], &["--formulation", "maggi"]].concat(),
        &["`maggi`", "leave the formulation out"],
    );
    said(&["--precision", "quadruple"], &["double-double"]);
    let sweep = run(&[
        "sweep",
        text(&path),
        "--vary",
        "k=1:2:3",
        "--precision",
        "double-double",
    ]);
    assert_eq!(sweep.status, Some(2), "{}", sweep.both());
    assert!(sweep.err.contains("sweep"), "{}", sweep.both());
}

#[test]
fn the_model_file_states_the_precision() {
    let with = |lines: &str| model("stated", &format!("{OSCILLATOR}{lines}"));
    let sharp = with("method = \"taylor\"\ntolerance = 1e-20\n");
    let (ended, _) = simulate(&sharp, &[]);
    assert_eq!(ended.status, Some(2), "{}", ended.both());
    assert!(
        ended.err.contains("`precision = \"double-double\"`"),
        "{}",
        ended.both()
    );
    let wrong = with("precision = \"double-duble\"\n");
    let (ended, _) = simulate(&wrong, &[]);
    assert!(
        ended.err.contains("did you mean \"double-double\"?"),
        "{}",
        ended.both()
    );
    let sharper = with("precision = \"double-double\"\ntolerance = 1e-29\n");
    let (ended, _) = simulate(&sharper, &[]);
    assert!(
        ended.err.contains("1e-28 (double-double arithmetic)"),
        "{}",
        ended.both()
    );
    // The command line has the last word.
    let back = with("precision = \"double-double\"\n");
    let (ended, _) = simulate(&back, &["--precision", "double"]);
    assert_eq!(ended.status, Some(0), "{}", ended.both());
    assert_eq!(ended.json()["precision"], "double");
}
