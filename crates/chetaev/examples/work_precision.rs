//! Work against error of the methods on models of the gallery:
//! `cargo run --release -p chetaev --example work_precision -- [MODEL.toml …]`.
//!
//! Times are the least of several rounds of the whole run, in which the methods take turns. Errors are those of all
//! coordinates and velocities at the end, each over 1 + its size, against Maggi's equations by series at the sharpest
//! tolerance; what that run differs by from Routh's equations at the same tolerance is shown too.
#![allow(clippy::print_stdout, clippy::unwrap_used, clippy::expect_used)] // A program for people to read from.

use chetaev::mechanics::{formulation, Formulation};
use chetaev::model::{load, Files, Style};
use chetaev::motion::{NumericSystem, Run, RunSettings, Subject, Watcher};
use chetaev::study::{registry, study, ClaimSelection, Hooks, Study, StudyOptions};
use std::time::Instant;

struct Disk;

impl Files for Disk {
    fn read(&self, path: &str) -> Result<String, String> {
        std::fs::read_to_string(path).map_err(|e| e.to_string())
    }
}

/// A model, overrides, and how long it runs.
type Case = (&'static str, &'static [(&'static str, &'static str)], f64);

const USUAL: [Case; 5] = [
    ("gallery/falling-rolling-disc/model.toml", &[], 100.0),
    ("gallery/rattleback/model.toml", &[], 20.0),
    ("gallery/chaplygin-sleigh/model.toml", &[], 100.0),
    ("gallery/trailer/model.toml", &[("n", "3")], 30.0),
    ("gallery/trailer/model.toml", &[("n", "8")], 30.0),
];

const ROUNDS: usize = 5;

fn main() {
    let asked: Vec<String> = std::env::args().skip(1).collect();
    if asked.is_empty() {
        for (path, overrides, t_end) in USUAL {
            measure(path, overrides, t_end);
        }
    }
    for path in &asked {
        measure(path, &[], 20.0);
    }
}

/// The model with its start; the motion itself is of no matter here.
fn studied(path: &str, overrides: &[(&str, &str)]) -> Study {
    let text = std::fs::read_to_string(path).expect("the model file");
    let overrides: Vec<(String, String)> = overrides
        .iter()
        .map(|&(name, value)| (name.into(), value.into()))
        .collect();
    let (model, _) = load(path, &text, &Disk, &overrides)
        .into_result()
        .map_err(|d| d.render(Style::Plain))
        .expect("a model without mistakes");
    let options = StudyOptions {
        claims: ClaimSelection::parse("motion.energy-drift", registry().claims()).expect("a claim"),
        t_end: Some(0.01),
        global_error: false,
        ..StudyOptions::default()
    };
    let mut hooks = Hooks {
        clock: &|| 0.0,
        interrupt: None,
        progress: &mut |_, _| {},
    };
    study(model, options, &mut hooks).expect("a start")
}

fn measure(path: &str, overrides: &[(&str, &str)], t_end: f64) {
    let study = studied(path, overrides);
    let motion = study.motion.as_ref().expect("a motion");
    let (system, prepared) = (&study.system, &study.prepared);
    let numeric = NumericSystem::new(system, &prepared.terms, &motion.binding).unwrap();
    let subject = Subject {
        system,
        terms: &prepared.terms,
        selection: &prepared.selection,
        binding: &motion.binding,
        numeric: &numeric,
        start: &motion.start,
        factors: &[],
    };
    println!("{path} {overrides:?} to t = {t_end}");
    let settings = |method: &str, tolerance: f64| RunSettings {
        method: method.into(),
        tolerance,
        absolute_tolerance: tolerance,
        times: vec![t_end],
        max_steps: 10_000_000,
        ..RunSettings::new(motion.start.t, t_end)
    };
    let maggi = formulation("maggi").expect("Maggi's equations");
    let routh = formulation("routh").expect("Routh's equations");
    let by = |own: &'static dyn Formulation, settings: &RunSettings| {
        subject.by(own, settings, &mut Watcher::default()).unwrap()
    };
    let reference = by(maggi, &settings("taylor", 2.3e-16));
    let other = by(routh, &settings("taylor", 2.3e-16));
    println!("  reference: differs by {:.1e}", error(&other, &reference));
    for tolerance in [1e-6, 1e-9, 1e-12, 3e-14, 1e-15] {
        let mut cases = Vec::new();
        for name in ["dormand-prince-853", "taylor"] {
            if tolerance >= 2.3e-14 || name == "taylor" {
                cases.push((name, routh, f64::INFINITY, None));
                cases.push((name, maggi, f64::INFINITY, None));
            }
        }
        for _ in 0..ROUNDS {
            for (name, own, least, run) in &mut cases {
                let settings = settings(name, tolerance);
                let begin = Instant::now();
                let found = by(*own, &settings);
                *least = least.min(begin.elapsed().as_secs_f64());
                *run = Some(found);
            }
        }
        for (name, own, least, run) in cases {
            let run = run.expect("a run");
            let steps = run.statistics.steps;
            println!(
                "  {tolerance:.0e} {name:18} {:6} error {:8.1e} {:9.3} ms {steps:7} steps {:6.2} µs/step {} switches",
                own.card().name,
                error(&run, &reference),
                1e3 * least,
                1e6 * least / steps as f64,
                run.statistics.chart_switches,
            );
        }
    }
}

/// The largest relative difference of coordinates and velocities at the end.
fn error(run: &Run, reference: &Run) -> f64 {
    let state = |run: &Run| -> Vec<f64> {
        let row = run.row(run.len() - 1);
        row[..run.layout.v().end].to_vec()
    };
    state(run)
        .iter()
        .zip(state(reference))
        .map(|(a, b)| (a - b).abs() / (1.0 + b.abs()))
        .fold(0.0, f64::max)
}
