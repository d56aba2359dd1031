//! `verify` catches a record whose statements were altered by hand; that it confirms what is right is asked of the gallery.
#![allow(clippy::expect_used, reason = "test code fails where it stands")]

use chetaev_tests::places::scratch;
use chetaev_tests::program::{run, text, Finished};
use chetaev_tests::studied::{full_id, verdicts};
use chetaev_tests::words::{in_parallel, none};
use serde_json::{json, Value};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::OnceLock;

/// A study with every kind of verdict that a linear system has, and a drift that is not at round-off.
fn original() -> &'static Value {
    static ORIGINAL: OnceLock<Value> = OnceLock::new();
    ORIGINAL.get_or_init(|| {
        let out = scratch("verify-original");
        let model = "gallery/moving-knife-edge/model.toml";
        let finished = run(&[
            "study",
            model,
            "--tolerance",
            "1e-7",
            "--out",
            text(&out),
            "--json",
        ]);
        assert_eq!(finished.status, Some(0), "{}", finished.both());
        finished.json()
    })
}

fn folder() -> &'static Path {
    static FOLDER: OnceLock<PathBuf> = OnceLock::new();
    FOLDER.get_or_init(|| scratch("verify-altered"))
}

/// `verify` on a text, in a file of its own.
fn verified(content: &str) -> Finished {
    static COUNT: AtomicUsize = AtomicUsize::new(0);
    let number = COUNT.fetch_add(1, Ordering::Relaxed);
    let path = folder().join(format!("record-{number}.json"));
    std::fs::write(&path, content).expect("a scratch file");
    run(&["verify", text(&path)])
}

/// A change of a record, and the line of `verify` that has to say so.
struct Change {
    name: String,
    line: String,
    record: Value,
}

impl Change {
    fn of(name: &str, line: &str, change: impl FnOnce(&mut Value)) -> Change {
        let mut record = original().clone();
        change(&mut record);
        assert_ne!(&record, original(), "{name} changes nothing");
        Change {
            name: name.into(),
            line: line.into(),
            record,
        }
    }

    /// Exit status 1 and a line that names the claim.
    fn unnoticed(&self) -> Option<String> {
        let finished = verified(&self.record.to_string());
        let named = finished
            .out
            .lines()
            .any(|l| l.starts_with("DISAGREES") && l.split_whitespace().nth(1) == Some(&self.line));
        let caught = finished.status == Some(1) && named && !finished.panicked();
        (!caught).then(|| format!("{}: {}", self.name, finished.both()))
    }
}

fn caught(changes: Vec<Change>) {
    none(
        in_parallel(&changes, Change::unnoticed)
            .into_iter()
            .flatten()
            .collect(),
    );
}

fn position(claim: &str) -> usize {
    let position = verdicts(original())
        .iter()
        .position(|v| full_id(v) == claim);
    position.unwrap_or_else(|| panic!("{claim} is not in the record"))
}

/// A verdict as another word with the evidence that the word needs.
fn forge(verdict: &mut Value, word: &str) {
    let empty = [
        "method",
        "on",
        "error_bound",
        "samples",
        "seed",
        "residual",
        "counterexample",
        "condition",
    ];
    for field in empty {
        verdict[field] = Value::Null;
    }
    verdict["verdict"] = json!(word);
    match word {
        "proved" => {
            verdict["method"] = json!("exact");
            verdict["on"] = json!("everywhere");
        }
        "refuted" => {
            verdict["counterexample"] = json!({
                "point": [{"name": "x'", "exact": "1", "enclosure": null}],
                "quantity": "x'", "residual": ["1", "1"]
            });
        }
        _ => {
            verdict["residual"] = json!(1e-12);
            verdict["samples"] = json!(100);
            verdict["on"] = json!("the rows");
        }
    }
}

/// How many verdicts of a record are changed at once: each must be named, and no other.
const AT_ONCE: usize = 8;

/// Verdicts, by their places, with the words they are changed to.
type Forged = Vec<(usize, &'static str)>;

/// `verify --json` of the record with those verdicts changed: its status, and the claims that have each result.
fn of_forged(forged: &Forged) -> (Option<i32>, Vec<(String, String)>) {
    let name = forged.iter().map(|(i, word)| format!("-{i}{}", &word[..1]));
    remarks(&format!("forged{}", name.collect::<String>()), |record| {
        for &(i, word) in forged {
            forge(&mut record["verdicts"][i], word);
        }
    })
}

#[test]
fn a_changed_verdict_is_caught_for_every_claim() {
    let list = verdicts(original());
    let (mut forged, mut open): (Vec<Forged>, Forged) = (Vec::new(), Vec::new());
    for (i, verdict) in list.iter().enumerate() {
        let others: &[&str] = match verdict["verdict"].as_str() {
            Some("proved") => &["refuted"],
            Some("refuted") => &["proved", "numerical"],
            Some("numerical") => &["proved", "refuted"],
            Some("undecided") => {
                open.push((i, "proved"));
                continue;
            }
            _ => &["proved"],
        };
        forged.resize_with(forged.len().max(others.len()), Vec::new);
        for (turn, word) in others.iter().enumerate() {
            forged[turn].push((i, word));
        }
    }
    assert!(forged.concat().len() > 20);
    let groups: Vec<Forged> = forged
        .iter()
        .flat_map(|turn| turn.chunks(AT_ONCE).map(<[_]>::to_vec))
        .collect();
    let wrong = in_parallel(&groups, |group| {
        let (status, mut found) = of_forged(group);
        let of = |(i, _): &(usize, &str)| (full_id(&list[*i]), "DISAGREES".to_owned());
        let mut expected: Vec<(String, String)> = group.iter().map(of).collect();
        found.sort();
        expected.sort();
        let right = status == Some(1) && found == expected;
        (!right).then(|| format!("{expected:?} changed, found {found:?}"))
    });
    none(wrong.into_iter().flatten().collect());
    // What a replay cannot decide it does not confirm.
    let (_, found) = of_forged(&open);
    for (i, _) in open {
        let claim = full_id(&list[i]);
        assert!(
            found.contains(&(claim.clone(), "open".into())),
            "{claim}: {found:?}"
        );
    }
}

#[test]
fn changed_residuals_are_caught() {
    let drifts = [
        "motion.formulations-agree",
        "motion.integral-drift#moving_energy",
    ];
    let mut changes = Vec::new();
    for claim in drifts {
        let i = position(claim);
        let residual = original()["verdicts"][i]["residual"]
            .as_f64()
            .expect("a residual");
        assert!(residual > 1e-12, "{claim} is at round-off: {residual}");
        for factor in [1e-4, 1e4] {
            changes.push(Change::of(
                &format!("{claim} times {factor}"),
                claim,
                |record| {
                    record["verdicts"][i]["residual"] = json!(residual * factor);
                },
            ));
        }
    }
    caught(changes);
}

#[test]
fn changed_counterexamples_are_caught() {
    let mut changes = Vec::new();
    for claim in [
        "model.constraints-homogeneous",
        "model.constraints-integrable#weak",
        "energy.integral",
    ] {
        let i = position(claim);
        let points = original()["verdicts"][i]["counterexample"]["point"]
            .as_array()
            .map_or(0, Vec::len);
        assert!(points > 0, "{claim} has a point");
        let alter = |name: &str, change: &dyn Fn(&mut Value)| {
            Change::of(&format!("{claim}: {name}"), claim, |record| {
                change(&mut record["verdicts"][i]["counterexample"]);
            })
        };
        // Both sides of a residual that excludes zero, but not that of the point stated.
        changes.push(alter("residual", &|c| {
            c["residual"] = json!(["12345.5", "12345.6"])
        }));
        changes.push(alter("no point", &|c| c["point"] = json!([])));
        changes.push(alter("no residual", &|c| {
            c["residual"] = json!(["-1", "1"])
        }));
        // Every coordinate of the point somewhere else.
        changes.push(alter("point", &|c| {
            for datum in c["point"].as_array_mut().expect("a list") {
                if datum["exact"].is_string() {
                    datum["exact"] = json!("1234567/891");
                }
            }
        }));
    }
    caught(changes);
}

#[test]
fn a_changed_trajectory_is_caught() {
    let trajectory = &original()["trajectory"];
    let value = |list: &str, j: usize| trajectory[list][j]["value"].as_f64().expect("a value");
    let change = |name: &str, field: &dyn Fn(&mut Value)| {
        Change::of(name, "trajectory", |record| {
            field(&mut record["trajectory"])
        })
    };
    let drift = trajectory["drifts"].as_array().expect("drifts").len() - 1;
    caught(vec![
        change("final state", &|t| {
            t["final"][1]["value"] = json!(value("final", 1) + 1e-2)
        }),
        change("final name", &|t| t["final"][1]["name"] = json!("z")),
        change("final value gone", &|t| {
            t["final"][1]["value"] = Value::Null
        }),
        change("initial state", &|t| {
            t["initial"][2]["value"] = json!(value("initial", 2) + 1e-2)
        }),
        change("a state less", &|t| {
            t["final"].as_array_mut().expect("a list").pop();
        }),
        change("not finished", &|t| t["finished"] = json!(false)),
        change("last time", &|t| t["t"] = json!(5.0)),
        change("asked end", &|t| t["t_end"] = json!(11.0)),
        change("formulation", &|t| t["formulation"] = json!("maggi")),
        change("rows", &|t| t["rows"] = json!(7)),
        change("drift", &|t| {
            t["drifts"][drift]["value"] = json!(value("drifts", drift) * 1e-4)
        }),
        change("global error", &|t| t["global_error"] = json!(1e-15)),
        change("reason", &|t| t["reason"] = json!("somebody was tired")),
        change("steps", &|t| t["steps"] = json!(count("steps") * 2)),
        change("rejected", &|t| {
            t["rejected"] = json!(count("rejected") + 50)
        }),
        change("evaluations", &|t| {
            t["evaluations"] = json!(count("evaluations") * 3)
        }),
        change("charts", &|t| {
            t["chart_switches"] = json!(count("chart_switches") + 7)
        }),
    ]);
}

/// What lies beside a record; a record that was changed and lies elsewhere has none of it.
const FILES: [&str; 4] = [
    "trajectory.csv",
    "trajectory.npz",
    "events.csv",
    "report.html",
];

fn count(field: &str) -> u64 {
    let count = original()["trajectory"][field].as_u64();
    count.expect("a count")
}

/// The lines of `verify --json` that are not confirmed, and the exit status.
fn remarks(name: &str, change: impl FnOnce(&mut Value)) -> (Option<i32>, Vec<(String, String)>) {
    let mut record = original().clone();
    change(&mut record);
    let path = folder().join(format!("{name}.json"));
    std::fs::write(&path, record.to_string()).expect("a scratch file");
    let finished = run(&["verify", text(&path), "--json"]);
    let lines = finished.json();
    let word = |line: &Value, field: &str| line[field].as_str().expect("a text").to_owned();
    let list = lines
        .as_array()
        .expect("a list")
        .iter()
        .filter(|line| line["result"] != "confirmed")
        .map(|line| (word(line, "claim"), word(line, "result")))
        .filter(|(claim, _)| !FILES.contains(&claim.as_str()))
        .collect();
    (finished.status, list)
}

/// What another machine may find is neither confirmed nor denied.
#[test]
fn a_step_more_or_less_is_remarked() {
    let remark = |claim: &str| vec![(claim.to_owned(), "remark".to_owned())];
    let one_more = |record: &mut Value| {
        record["trajectory"]["steps"] = json!(count("steps") + 1);
    };
    assert_eq!(remarks("a-step", one_more), (Some(0), remark("trajectory")));
    let other_version = |record: &mut Value| {
        record["chetaev"] = json!("0.0.1");
        record["trajectory"]["steps"] = json!(count("steps") * 2);
    };
    assert_eq!(
        remarks("version", other_version),
        (Some(0), remark("trajectory"))
    );
}

#[test]
fn changed_notices_are_caught() {
    let model = "gallery/redundant-constraints/model.toml";
    let out = scratch("verify-notices");
    let claims = ["--claims", "motion.constraint-drift"];
    let arguments = ["study", model, "--json", "--out", text(&out)];
    let record = run(&[&arguments[..], &claims[..]].concat()).json();
    let stated = record["notices"].as_array().expect("a list").clone();
    assert!(!stated.is_empty(), "redundant constraints are noted");
    let verified = |notices: Vec<Value>| {
        let mut record = record.clone();
        record["notices"] = json!(notices);
        let finished = verified(&record.to_string());
        let line = finished.out.lines().find(|l| l.contains(" notices "));
        let word = line.and_then(|l| l.split_whitespace().next());
        (finished.status, word.unwrap_or("").to_owned())
    };
    let caught = (Some(1), "DISAGREES".to_owned());
    assert_eq!(verified(stated.clone()), (Some(0), "confirmed".to_owned()));
    assert_eq!(verified(Vec::new()), caught);
    assert_eq!(
        verified([&stated[..], &[json!("an expert has seen this")]].concat()),
        caught
    );
    let first = stated[0].as_str().expect("a text");
    let mut other = stated.clone();
    other[0] = json!(first.replacen("redundant", "necessary", 1));
    assert_ne!(other, stated);
    assert_eq!(verified(other), caught);
}

#[test]
fn claims_left_out_or_made_up_are_caught() {
    let claim = "energy.integral";
    let left_out = Change::of("left out", claim, |record| {
        record["verdicts"]
            .as_array_mut()
            .expect("a list")
            .remove(position(claim));
    });
    let made_up = Change::of("made up", "motion.perpetual", |record| {
        let mut verdict = original()["verdicts"][0].clone();
        verdict["claim"] = json!("motion.perpetual");
        record["verdicts"]
            .as_array_mut()
            .expect("a list")
            .push(verdict);
    });
    let twice = Change::of("a second verdict", claim, |record| {
        let mut verdict = original()["verdicts"][position(claim)].clone();
        forge(&mut verdict, "proved");
        record["verdicts"]
            .as_array_mut()
            .expect("a list")
            .push(verdict);
    });
    let subject = Change::of(
        "another subject",
        "formulation.equivalent#newton",
        |record| {
            record["verdicts"][position("formulation.equivalent#maggi")]["subject"] =
                json!("newton");
        },
    );
    caught(vec![left_out, made_up, twice, subject]);
}

#[test]
fn another_model_in_the_record_is_caught() {
    let swap = |name: &str, line: &str, from: &str, to: &str| {
        Change::of(name, line, |record| {
            let model = record["model"]["text"].as_str().expect("a text");
            assert!(model.contains(from));
            record["model"]["text"] = json!(model.replacen(from, to, 1));
        })
    };
    caught(vec![
        swap(
            "yaw rate",
            "trajectory",
            "W = { value = 1.3",
            "W = { value = 1.4",
        ),
        swap(
            "a force in V",
            "motion.integral-drift#moving_energy",
            "\"-m gs x\"",
            "\"-m gs x + m gs y\"",
        ),
        swap("the sign of V", "trajectory", "\"-m gs x\"", "\"m gs x\""),
    ]);
}

/// Exit status 2 with a message and without a panic.
fn refused(name: &str, finished: &Finished) -> Option<String> {
    let good =
        finished.status == Some(2) && finished.err.starts_with("error") && !finished.panicked();
    (!good).then(|| format!("{name}: {}", finished.both()))
}

#[test]
fn what_is_no_record_is_refused() {
    let whole = original().to_string();
    let cut = |part: usize| {
        let mut end = whole.len() * part / 10;
        while !whole.is_char_boundary(end) {
            end -= 1;
        }
        whole[..end].to_owned()
    };
    let mut texts: Vec<(String, String)> = (0..10)
        .map(|part| (format!("cut-{part}"), cut(part)))
        .collect();
    let deep = "[".repeat(100_000);
    for (name, text) in [
        ("null", "null"),
        ("list", "[]"),
        ("object", "{}"),
        ("deep", deep.as_str()),
        ("words", "no JSON at all"),
        ("schema-only", "{\"schema\": \"chetaev-study-1\"}"),
    ] {
        texts.push((name.into(), text.into()));
    }
    none(
        in_parallel(&texts, |(name, text)| refused(name, &verified(text)))
            .into_iter()
            .flatten()
            .collect(),
    );
}

#[test]
fn records_that_cannot_be_replayed_are_refused_with_the_reason() {
    let changes: Vec<(&str, &str, Value, &str)> = vec![
        (
            "schema",
            "/schema",
            json!("chetaev-study-9"),
            "chetaev-study-9",
        ),
        ("no-text", "/schema", json!(7), "schema"),
        ("verdicts", "/verdicts", json!("none"), "verdicts|sequence"),
        ("claim", "/verdicts/0/claim", json!(3), "string"),
        ("empty-model", "/model/text", json!(""), "coordinates"),
        (
            "broken-model",
            "/model/text",
            json!("coordinates = ["),
            "toml-syntax",
        ),
        (
            "override",
            "/model/overrides",
            json!([{"name": "nobody", "value": "1"}]),
            "nobody",
        ),
        ("method", "/options/method", json!("magic"), "magic"),
        (
            "formulation",
            "/options/formulation",
            json!("magic"),
            "magic",
        ),
        ("tolerance", "/options/tolerance", json!(-1.0), "tolerance"),
    ];
    none(
        in_parallel(&changes, |(name, place, value, word)| {
            let mut record = original().clone();
            *record.pointer_mut(place).expect("the place") = value.clone();
            let finished = verified(&record.to_string());
            let said = word
                .split('|')
                .any(|w| finished.err.to_lowercase().contains(w));
            refused(name, &finished)
                .or_else(|| (!said).then(|| format!("{name}: {}", finished.both())))
        })
        .into_iter()
        .flatten()
        .collect(),
    );
}

#[test]
fn a_record_that_is_not_there_is_refused() {
    let missing = folder().join("nowhere.json");
    assert_eq!(refused("missing", &run(&["verify", text(&missing)])), None);
    assert_eq!(refused("a folder", &run(&["verify", text(folder())])), None);
    let bytes = folder().join("bytes.json");
    std::fs::write(&bytes, [0xff, 0xfe, 0x00, 0x80]).expect("a scratch file");
    assert_eq!(refused("bytes", &run(&["verify", text(&bytes)])), None);
}
