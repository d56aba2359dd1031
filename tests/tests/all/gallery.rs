//! Every model of the gallery goes through the whole main job, has every claim of the catalogue, and moves as the literature says.
#![allow(clippy::expect_used, reason = "test code fails where it stands")]

mod undecided;

use self::undecided::UNDECIDED;
use chetaev_tests::extent::Extent;
use chetaev_tests::literature::{CLOSED_FORMS, NUMBERS};
use chetaev_tests::places::{root, scratch};
use chetaev_tests::program::{run, text};
use chetaev_tests::runs::{again, along, ended, Ask};
use chetaev_tests::schema::Schema;
use chetaev_tests::studied::{full_id, gallery_path, loaded, study_gallery, verdicts, Studied};
use chetaev_tests::words::{in_parallel, none};
use serde_json::Value;
use std::collections::BTreeSet;
use std::sync::OnceLock;

/// The folders that must be there at least.
const NAMES: &[&str] = &[
    "appell-hamel",
    "ball-in-cylinder",
    "chaplygin-sleigh",
    "chaplygin-sphere",
    "charged-particle",
    "double-pendulum",
    "falling-rolling-disc",
    "fixed-acceleration",
    "fixed-jerk",
    "heavy-top",
    "isokinetic-particle",
    "kapitza-pendulum",
    "knife-edge-order-2",
    "knife-edge-order-3",
    "leaking-pendulum",
    "moving-frame",
    "moving-knife-edge",
    "particle-y-dx",
    "pendulum-particle",
    "raindrop",
    "prescribed-curvature",
    "radial-acceleration",
    "radial-acceleration-polar",
    "rattleback",
    "redundant-constraints",
    "relativistic-particle",
    "rigid-body",
    "rocket-on-appells-constraint",
    "roller-racer",
    "sand-cart",
    "skate-incline",
    "skate-level",
    "snakeboard",
    "sphere-on-turntable",
    "suslov",
    "third-order-linear",
    "tippe-top",
    "trailer",
    "vertical-rolling-disc",
    "watt-governor",
    "whipple-bicycle",
];

/// Claims that every study states, whatever the system: the model, the equivalence, the energy, the motion, steady motions.
const CLAIMS: &[&str] = &[
    "model.hessian-regular",
    "model.constraints-independent",
    "model.accelerations-unique",
    "model.constraints-linear",
    "model.constraints-homogeneous",
    "model.constraints-scleronomic",
    "model.constraints-integrable#weak",
    "model.constraints-integrable#strong",
    "model.chaplygin",
    "model.initial-state-admissible",
    "formulation.equivalent#maggi",
    "energy.integral",
    "motion.constraint-drift",
    "motion.energy-drift",
    "motion.formulations-agree",
    "motion.method-order",
    "equilibrium.states",
    "steady.motions",
];

/// Claims on the variational principles (catalogue of claims, §3 and §4) that every study of a system of first order states, with constraints
/// or without.
const PRINCIPLES: &[&str] = &[
    "variation.hoelder",
    "variation.suslov",
    "hamilton.hoelder",
    "hamilton.voronets",
    "hamilton.suslov",
    "hamilton.helmholtz-poincare",
    "hamilton.central-identity",
    "hamilton.constants",
    "hamilton.forms-equivalent",
    "hamilton.stationary",
    "hamilton.stationary-suslov",
    "hamilton.kerner",
    "hamilton.endpoints",
    "energy.integral",
    "action.identity",
    "action.lagrange",
    "action.jacobi",
    "action.parametric",
    "hamilton-jacobi.applicable",
    "chaplygin.multiplier",
    "second-kind.differential",
    "second-kind.differential-newton",
    "second-kind.identity",
    "second-kind.integral#free",
    "second-kind.integral#half-fixed",
    "second-kind.integral#fixed",
    "second-kind.canonical#free",
    "second-kind.canonical#half-fixed",
    "second-kind.canonical#fixed",
    "universal-relation#zero",
    "universal-relation#hoelder",
    "universal-relation#suslov",
    "universal-relation#vujanovic",
];

/// Models with constraints on accelerations and higher derivatives.
const HIGHER: &[&str] = &[
    "fixed-",
    "knife-edge-order-",
    "prescribed-curvature",
    "radial-acceleration",
    "third-order-linear",
];

fn studies() -> &'static [Studied] {
    static STUDIES: OnceLock<Vec<Studied>> = OnceLock::new();
    STUDIES.get_or_init(|| study_gallery("gallery"))
}

#[test]
fn the_names_are_there_with_history_and_source() {
    let bibliography =
        std::fs::read_to_string(root().join("docs/references.bib")).expect("a bibliography");
    let keys: BTreeSet<&str> = bibliography
        .lines()
        .filter_map(|line| line.strip_prefix('@')?.split_once('{')?.1.strip_suffix(','))
        .collect();
    for name in NAMES {
        let readme = std::fs::read_to_string(root().join("gallery").join(name).join("README.md"))
            .unwrap_or_else(|e| panic!("{name}: {e}"));
        assert!(readme.starts_with("# "), "{name} has a title");
        assert!(readme.contains("\n**History.** "), "{name} has a history");
        let sources = readme
            .split_once("\n**Sources.** ")
            .and_then(|(_, rest)| rest.split("\n\n").next())
            .unwrap_or_else(|| panic!("{name} has no sources"));
        let cited: Vec<&str> = sources.split('`').skip(1).step_by(2).collect();
        assert!(!cited.is_empty(), "{name} cites nothing");
        for key in cited {
            assert!(
                keys.contains(key),
                "{name} cites `{key}`, which the bibliography lacks"
            );
        }
    }
}

#[test]
fn every_model_is_studied_with_exit_status_0_and_writes_all_files() {
    let mut failures = Vec::new();
    for study in studies() {
        if study.finished.status != Some(0) {
            failures.push(format!("{}: {}", study.file, study.finished.both()));
        }
        for file in [
            "report.html",
            "study.json",
            "trajectory.csv",
            "trajectory.npz",
        ] {
            let size = std::fs::metadata(study.folder.join(file)).map_or(0, |m| m.len());
            if size < 1000 {
                failures.push(format!("{}: {file} has {size} bytes", study.file));
            }
        }
    }
    none(failures);
}

/// Lines that a study may print, and their characters: a screen.
const LINES: usize = 44;
const WIDTH: usize = 100;

/// What a person sees fits on a screen: the equations of motion, what was found, the motion, and where all is.
#[test]
fn what_a_study_prints_fits_on_a_screen() {
    let mut failures = Vec::new();
    let mut counts = Vec::new();
    for study in studies() {
        let printed = &study.finished.out;
        let count = printed.lines().count();
        counts.push(count);
        if count > LINES {
            failures.push(format!("{}: {count} lines", study.file));
        }
        let is_path = |line: &str| line.starts_with("report: ");
        for line in printed.lines().filter(|line| !is_path(line)) {
            if line.chars().count() > WIDTH {
                failures.push(format!("{}: {line}", study.file));
            }
        }
        for part in [
            "\nEquations of motion\n",
            "\nWhat was found\n",
            "\nMotion\n",
            "\nreport: ",
            "--all",
        ] {
            if !printed.contains(part) {
                failures.push(format!("{}: no {part:?} in\n{printed}", study.file));
            }
        }
    }
    none(failures);
    counts.sort_unstable();
    let usual = counts[counts.len() / 2];
    assert!(
        usual <= 30,
        "half of the studies print more than {usual} lines"
    );
}

#[test]
fn every_record_follows_the_schema() {
    let schema = Schema::read();
    let problem = |study: &Studied| {
        let problem = schema.problem(&study.record())?;
        Some(format!("{}: {problem}", study.file))
    };
    none(studies().iter().filter_map(problem).collect());
}

/// A replay takes as long as a study: a fifth of the gallery in one run (`chetaev_tests::extent`).
/// What a replay of a study says against it.
struct Replayed {
    /// What disagrees, is left open, or was not replayed.
    failures: Vec<String>,
    /// Whether the clock stopped a claim, as it may while other work takes the processor: `undecided (time)` is the only verdict that
    /// depends on the machine.
    late: bool,
}

fn replayed(study: &Studied, extent: Extent) -> Replayed {
    let finished = run(&["verify", text(&study.folder.join("study.json")), "--json"]);
    let mut failures = Vec::new();
    if finished.status != Some(0) {
        failures.push(format!("{extent:?}, {}: {}", study.file, finished.both()));
    }
    let lines = finished.json();
    let lines = lines.as_array().expect("a list");
    if lines.len() < verdicts(&study.record()).len() {
        failures.push(format!("{}: a verdict was not replayed", study.file));
    }
    let unconfirmed: Vec<_> = lines
        .iter()
        .filter(|l| l["result"] != "confirmed")
        .collect();
    failures.extend(unconfirmed.iter().map(|l| format!("{}: {l}", study.file)));
    let late = unconfirmed.iter().any(|l| {
        l["detail"]
            .as_str()
            .is_some_and(|d| d.starts_with("time: "))
    });
    Replayed { failures, late }
}

#[test]
fn studies_are_confirmed_when_they_are_replayed() {
    let extent = Extent::of_run(&root());
    let studies = extent.of(studies());
    let first = in_parallel(&studies, |study| replayed(study, extent));
    let failures = studies
        .iter()
        .zip(first)
        .flat_map(|(study, first)| {
            if first.late {
                // Once more by itself: another that is late is a claim that takes too long.
                replayed(study, extent).failures
            } else {
                first.failures
            }
        })
        .collect();
    none(failures);
}

/// Claims of a model that are about its own integrals.
fn integral_claims(file: &str) -> Vec<String> {
    let model = loaded(&gallery_path(file), &[])
        .model
        .expect("the model is right");
    model
        .integrals
        .iter()
        .map(|i| format!("motion.integral-drift#{}", i.name))
        .collect()
}

#[test]
fn every_claim_of_the_catalogue_has_a_verdict_in_every_study() {
    let mut failures = Vec::new();
    for study in studies() {
        let record = study.record();
        let stated: Vec<String> = verdicts(&record).iter().map(full_id).collect();
        let distinct: BTreeSet<&String> = stated.iter().collect();
        if distinct.len() != stated.len() {
            failures.push(format!("{}: a claim is stated twice", study.file));
        }
        let higher = HIGHER.iter().any(|name| study.file.starts_with(name));
        let principles: &[&str] = if higher { &[] } else { PRINCIPLES };
        let wanted = CLAIMS
            .iter()
            .chain(principles)
            .map(|&c| c.to_owned())
            .chain(integral_claims(&study.file));
        for claim in wanted.filter(|c| !distinct.contains(c)) {
            failures.push(format!("{}: {claim} is missing", study.file));
        }
    }
    none(failures);
}

#[test]
fn expectations_are_met_and_about_claims_that_exist() {
    let mut failures = Vec::new();
    for study in studies() {
        let record = study.record();
        let model = loaded(&gallery_path(&study.file), &[])
            .model
            .expect("the model is right");
        for expected in &model.expect.verdicts {
            let of_claim: Vec<&Value> = verdicts(&record)
                .iter()
                .filter(|v| v["claim"] == expected.claim.as_str())
                .filter(|v| {
                    expected.subject.is_none()
                        || v["subject"].as_str() == expected.subject.as_deref()
                })
                .collect();
            if of_claim.is_empty() {
                failures.push(format!(
                    "{}: nothing is said of {}",
                    study.file, expected.claim
                ));
            }
            for verdict in of_claim {
                let word = verdict["verdict"].as_str().unwrap_or("");
                if !expected.verdicts.iter().any(|v| v == word) {
                    failures.push(format!("{}: {} is {word}", study.file, full_id(verdict)));
                }
            }
        }
    }
    none(failures);
}

#[test]
fn nothing_is_undecided_without_a_reason_known_here() {
    let mut found = Vec::new();
    for study in studies() {
        let record = study.record();
        for verdict in verdicts(&record)
            .iter()
            .filter(|v| v["verdict"] == "undecided")
        {
            let claim = full_id(verdict);
            let detail = verdict["detail"].as_str().unwrap_or("");
            let known = UNDECIDED
                .iter()
                .any(|&(file, id, why)| file == study.file && id == claim && detail.contains(why));
            if !known {
                found.push(format!("{}: {claim}: {detail}", study.file));
            }
        }
    }
    none(found);
}

/// What the catalogue of claims demands of each verdict ("Verdicts").
#[test]
fn every_verdict_carries_what_it_must() {
    let mut failures = Vec::new();
    for study in studies() {
        let record = study.record();
        for v in verdicts(&record) {
            let word = v["verdict"].as_str().unwrap_or("");
            let complete = match (word, v["method"].as_str()) {
                ("proved", Some("exact" | "structural")) => {
                    v["on"].is_string() && v["error_bound"].is_null()
                }
                ("proved", Some("modular")) => v["on"].is_string() && small(&v["error_bound"]),
                ("numerical", None) => {
                    v["samples"].is_u64() && v["residual"].is_f64() && v["on"].is_string()
                }
                ("refuted", None) => excludes_zero(v),
                ("conditional", _) => v["condition"].as_str().is_some_and(|c| !c.is_empty()),
                ("not-applicable", None) => hypothesis_fails(&record, v),
                ("undecided", None) => true,
                _ => false,
            };
            if !complete || v["detail"].as_str().is_none_or(str::is_empty) {
                failures.push(format!("{}: {}: {v}", study.file, full_id(v)));
            }
        }
    }
    none(failures);
}

/// A bound `2^-n` with n at least 100.
fn small(bound: &Value) -> bool {
    let exponent = bound
        .as_str()
        .and_then(|b| b.strip_prefix("2^-")?.parse::<u32>().ok());
    exponent.is_some_and(|n| n >= 100)
}

/// Refuted by the form of the model alone or by ranks at every state, so that no single point is the counterexample.
const REFUTED_EVERYWHERE: &[&str] = &[
    "model.constraints-independent",
    "model.restricted-hessian-regular",
    "model.cartesian-coordinates",
    "model.constraints-first-order",
    "model.masses-free-of-velocity",
    "model.masses-of-time",
    "distribution.growth",
];

/// Drifts are refuted by the run itself; everything else by a point, with exact independent data and a residual away from zero.
fn excludes_zero(verdict: &Value) -> bool {
    let counterexample = &verdict["counterexample"];
    let bounds: Vec<f64> = counterexample["residual"]
        .as_array()
        .into_iter()
        .flatten()
        .filter_map(|b| b.as_str()?.parse().ok())
        .collect();
    let point = counterexample["point"].as_array().map_or(0, Vec::len);
    let everywhere = REFUTED_EVERYWHERE.iter().any(|id| verdict["claim"] == *id);
    everywhere || point > 0 && bounds.len() == 2 && bounds[0] * bounds[1] > 0.0
}

/// The condition is a claim of the same study with a verdict that is not `proved`.
fn hypothesis_fails(record: &Value, verdict: &Value) -> bool {
    verdicts(record)
        .iter()
        .any(|v| verdict["condition"].as_str() == Some(&full_id(v)) && v["verdict"] != "proved")
}

#[test]
fn motions_are_those_of_the_literature() {
    let mut files: Vec<&str> = CLOSED_FORMS
        .iter()
        .map(|f| f.file)
        .chain(NUMBERS.iter().map(|n| n.file))
        .collect();
    files.sort_unstable();
    files.dedup();
    none(in_parallel(&files, |file| differences(file)).concat());
}

/// What differs from the literature along one motion.
fn differences(file: &str) -> Vec<String> {
    let ask = Ask {
        claims: vec!["motion.constraint-drift"],
        ..Ask::default()
    };
    let ended = ended(loaded(&gallery_path(file), &[]), &ask);
    let Some(study) = ended.study else {
        return vec![format!("{file}: {}", ended.text)];
    };
    let mut failures = Vec::new();
    let main = &study.motion.as_ref().expect("a motion").evidence.run;
    for form in CLOSED_FORMS.iter().filter(|f| f.file == file) {
        let residual = format!("({}) - ({})", form.expression, form.formula);
        let values = along(&study, main, &residual).unwrap_or_else(|e| panic!("{file}: {e}"));
        let worst = values.iter().fold(0.0, |m: f64, x| {
            if x.is_nan() {
                f64::INFINITY
            } else {
                m.max(x.abs())
            }
        });
        if worst > form.tolerance {
            failures.push(format!(
                "{file}: {} differs from {} by {worst:e}",
                form.expression, form.formula
            ));
        }
    }
    for number in NUMBERS.iter().filter(|n| n.file == file) {
        let times = if number.t > 0.0 {
            vec![0.0, number.t]
        } else {
            vec![0.0, 1.0]
        };
        let run = again(&study, times).expect("the motion again");
        let values =
            along(&study, &run, number.expression).unwrap_or_else(|e| panic!("{file}: {e}"));
        let found = if number.t > 0.0 { values[1] } else { values[0] };
        let value: f64 = number.value.parse().expect("a number");
        if found.is_nan() || (found - value).abs() > number.tolerance {
            failures.push(format!(
                "{file}: {} is {found} at t = {}, not {value}",
                number.expression, number.t
            ));
        }
    }
    failures
}

#[test]
fn readmes_give_the_numbers_that_are_tested() {
    let mut failures = Vec::new();
    for number in NUMBERS {
        let name = number.file.split('/').next().unwrap_or("");
        let readme =
            std::fs::read_to_string(gallery_path(name).join("README.md")).expect("a README");
        if !readme.contains(number.value) {
            failures.push(format!("{name}: {} is not in the README", number.value));
        }
    }
    none(failures);
}

fn record_of(file: &str) -> Value {
    let study = studies().iter().find(|s| s.file == file);
    study.expect("the model is in the gallery").record()
}

#[test]
fn the_weight_of_appell_and_hamel_stops_at_the_tip_of_the_cone_and_that_is_no_failure() {
    let trajectory = &record_of("appell-hamel/to-rest.toml")["trajectory"];
    assert_eq!(trajectory["finished"], false);
    let t = trajectory["stop_time"].as_f64().expect("a time");
    // s0 (1 + rho²)/(g rho), from the README.
    assert!((t - 1.301_878_549_584_97).abs() < 1e-4, "{t}");
    assert!(
        trajectory["reason"]
            .as_str()
            .is_some_and(|r| r.contains("cone")),
        "{trajectory}"
    );
}

#[test]
fn the_axis_of_the_top_sinks_to_the_root_of_its_cubic() {
    let ask = Ask {
        claims: vec!["motion.constraint-drift"],
        ..Ask::default()
    };
    let study = ended(loaded(&gallery_path("heavy-top/model.toml"), &[]), &ask)
        .study
        .expect("a study");
    let run = &study.motion.as_ref().expect("a motion").evidence.run;
    let lowest = along(&study, run, "theta")
        .expect("theta")
        .into_iter()
        .fold(0.0, f64::max);
    // Rows are 0.01 apart, and theta'' is below 2: the largest row is within 1e-4 of the maximum, and never above it.
    assert!(
        (-1e-4..1e-9).contains(&(lowest - 1.318_116_071_652_82)),
        "{lowest}"
    );
}

#[test]
fn trailers_settle_on_circles_with_the_radii_of_the_readme() {
    let ask = Ask {
        claims: vec!["motion.constraint-drift"],
        times: vec![0.0, 60.0],
        t_end: Some(60.0),
        ..Ask::default()
    };
    let study = ended(loaded(&gallery_path("trailer/model.toml"), &[]), &ask)
        .study
        .expect("a study");
    let run = &study.motion.as_ref().expect("a motion").evidence.run;
    for i in 1..=3 {
        // R_i² = v_i²/W², against R² - d_1² - … - d_i².
        let residual = format!("(x_{i}'^2 + y_{i}'^2)/W^2 - ((x'^2 + y'^2)/W^2 - {i} d_1^2)");
        let values = along(&study, run, &residual).expect("a value");
        assert!(
            values[0].abs() > 0.1 && values[1].abs() < 1e-6,
            "trailer {i}: {values:?}"
        );
    }
}

#[test]
fn the_number_of_trailers_is_given_on_the_command_line() {
    let out = scratch("trailer-8");
    let model = "gallery/trailer/model.toml";
    let finished = run(&[
        "study",
        model,
        "--set",
        "n=8",
        "--out",
        text(&out),
        "--json",
    ]);
    assert_eq!(finished.status, Some(0), "{}", finished.both());
    let set = finished.json();
    let include = record_of("trailer/model-8.toml");
    let words = |record: &Value| -> Vec<(String, String)> {
        verdicts(record)
            .iter()
            .map(|v| (full_id(v), v["verdict"].to_string()))
            .collect()
    };
    assert_eq!(words(&set), words(&include));
    assert_eq!(set["trajectory"]["final"], include["trajectory"]["final"]);
    let last = set["trajectory"]["final"].as_array().expect("a state");
    assert!(last.iter().any(|v| v["name"] == "theta_8'"), "{last:?}");
    assert_eq!(last.len(), 2 * (8 + 3));
}

#[test]
fn redundant_constraints_are_named() {
    let record = record_of("redundant-constraints/model.toml");
    let independent = verdicts(&record)
        .iter()
        .find(|v| v["claim"] == "model.constraints-independent")
        .expect("the claim");
    assert_eq!(independent["verdict"], "refuted");
    let detail = independent["detail"].as_str().unwrap_or("");
    assert!(
        detail.contains("`forward`") && detail.contains("`sideways`"),
        "{detail}"
    );
}
