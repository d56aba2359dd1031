//! The command line as people and programs use it: exit statuses, help, files, JSON, pipes, interruption, determinism.
#![allow(clippy::expect_used, reason = "test code fails where it stands")]

use chetaev_tests::places::{gallery, root, scratch};
use chetaev_tests::program::{command, finish, ok, run, run_in, text};
use serde_json::Value;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

const COMMANDS: &[&str] = &[
    "study",
    "derive",
    "principles",
    "simulate",
    "plot",
    "film",
    "sweep",
    "check",
    "explain",
    "verify",
    "new",
    "import",
    "gallery",
    "completions",
];
const SKATE: &str = "gallery/skate-incline/model.toml";

/// A model below a scratch folder.
fn model(folder: &Path, name: &str, content: &str) -> PathBuf {
    let path = folder.join(format!("{name}.toml"));
    std::fs::write(&path, content).expect("a scratch file");
    path
}

/// A particle whose motion ends at t = 1, where the root becomes singular, with more text below.
fn falling_apart(name: &str, rest: &str) -> String {
    format!(
        "name = \"{name}\"\ncoordinates = [\"x\"]\n[lagrangian]\nT = \"1/2 x'^2\"\nV = \"-sqrt(1 - x)\"\n[initial]\nx = 0\n\"x'\" = 2\n[simulation]\nt_end = 5\n{rest}"
    )
}

#[test]
fn exit_statuses_are_documented_and_kept() {
    let help = ok(&["--help"]).out;
    for line in [
        "0  done",
        "1  a claim",
        "2  the input is wrong",
        "3  the run stopped",
    ] {
        assert!(help.contains(line), "{line} is not in\n{help}");
    }
    assert!(help.contains("highest of 2, 3, 1"), "{help}");

    let folder = scratch("exit");
    let status = |name: &str, content: &str| {
        let path = model(&folder, name, content);
        let out = folder.join(format!("out-{name}"));
        let finished = run(&["study", text(&path), "--out", text(&out)]);
        assert!(!finished.panicked(), "{}", finished.both());
        (finished.status, finished)
    };
    let good = "name = \"good\"\ncoordinates = [\"x\"]\nlagrangian = \"x'^2/2\"\n[initial]\n\"x'\" = 1\n[simulation]\nt_end = 1\n";
    let unmet = "[expect]\n\"energy.integral\" = \"refuted\"\n";
    let cases = [
        ("done", good.to_owned(), 0),
        ("unmet", format!("{good}{unmet}"), 1),
        ("input", format!("{good}[expect]\nnobody = 1\n"), 2),
        ("stopped", falling_apart("stopped", ""), 3),
        // 3 wins over 1.
        (
            "stopped-and-unmet",
            falling_apart("stopped-and-unmet", unmet),
            3,
        ),
        (
            "expected-stop",
            falling_apart("expected-stop", "[expect]\nstop = true\n"),
            0,
        ),
        (
            "other-stop",
            falling_apart("other-stop", "[expect]\nstop = { at = 4 }\n"),
            3,
        ),
        ("no-stop", format!("{good}[expect]\nstop = true\n"), 1),
    ];
    for (name, content, expected) in cases {
        let (found, finished) = status(name, &content);
        assert_eq!(found, Some(expected), "{name}: {}", finished.both());
    }
}

#[test]
fn an_expectation_about_a_claim_that_does_not_exist_is_not_met_silently() {
    let folder = scratch("unknown-claim");
    let content = "name = \"typo\"\ncoordinates = [\"x\"]\nlagrangian = \"x'^2/2\"\n[simulation]\nt_end = 1\n[expect]\n\"energy.integrl\" = \"proved\"\n";
    let path = model(&folder, "typo", content);
    let finished = run(&["study", text(&path), "--out", text(&folder.join("out"))]);
    assert!(
        matches!(finished.status, Some(1 | 2)),
        "{}",
        finished.both()
    );
    assert!(
        finished.both().contains("energy.integrl"),
        "{}",
        finished.both()
    );
}

#[test]
fn usage_errors_exit_with_2() {
    let cases: [&[&str]; 15] = [
        &[],
        &["study"],
        &["fly"],
        &["study", "nowhere.toml"],
        &["study", "gallery/skate-incline"],
        &["study", SKATE, "--claims", "weather"],
        &["study", SKATE, "--set", "nobody=1"],
        &["study", SKATE, "--set", "W"],
        &["study", SKATE, "--method", "magic"],
        &["simulate", SKATE, "--formulation", "magic"],
        &["derive", SKATE, "--formulation", "magic"],
        &["explain", "energy.intgral"],
        &["study", SKATE, "--budget", "nan"],
        &["principles", SKATE, "--budget", "-1"],
        &["principles", SKATE, "--out", "elsewhere"],
    ];
    let folder = scratch("usage");
    std::fs::create_dir_all(folder.join("gallery/skate-incline")).expect("a folder");
    std::fs::copy(root().join(SKATE), folder.join(SKATE)).expect("a copy");
    for arguments in cases {
        let finished = run_in(&folder, arguments);
        assert_eq!(
            finished.status,
            Some(2),
            "{arguments:?}: {}",
            finished.both()
        );
        assert!(
            !finished.err.is_empty() && !finished.panicked(),
            "{arguments:?}: {}",
            finished.both()
        );
    }
    assert!(
        !folder.join("out").exists(),
        "a refused command writes nothing"
    );
}

#[test]
fn every_command_has_help_with_examples() {
    for name in COMMANDS {
        for flag in ["--help", "-h"] {
            let help = ok(&[name, flag]).out;
            let (_, examples) = help
                .split_once("Example")
                .unwrap_or_else(|| panic!("{name} {flag} has no examples"));
            assert!(examples.contains(&format!("\n  chetaev {name}")), "{help}");
        }
        assert!(
            ok(&["--help"]).out.contains(&format!("\n  {name} ")),
            "{name} is not listed"
        );
    }
    assert!(ok(&["--version"]).out.starts_with("chetaev 0."));
}

#[test]
fn shells_get_completions() {
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let script = ok(&["completions", shell]).out;
        for name in COMMANDS {
            assert!(script.contains(name), "{shell} does not complete {name}");
        }
        assert!(
            script.contains("tolerance"),
            "{shell} does not complete options"
        );
    }
}

#[test]
fn what_a_program_reads_is_json() {
    let out = scratch("json");
    let out = text(&out);
    let study = ok(&["study", SKATE, "--out", out, "--json"]).json();
    let written = std::fs::read_to_string(Path::new(out).join("study.json")).expect("study.json");
    assert_eq!(
        serde_json::from_str::<Value>(&written).expect("JSON"),
        study
    );
    let simulated = ok(&["simulate", SKATE, "--out", out, "--json"]).json();
    assert_eq!(simulated["finished"], true);
    assert_eq!(
        ok(&["check", SKATE, "--json"]).json(),
        serde_json::json!([])
    );
    let record = format!("{out}/study.json");
    assert!(ok(&["verify", &record, "--json"])
        .json()
        .as_array()
        .is_some_and(|l| l.len() > 10));
    let derived = ok(&["derive", SKATE, "--as", "json"]).json();
    let names: Vec<&Value> = derived
        .as_array()
        .expect("a list")
        .iter()
        .map(|d| &d["formulation"])
        .collect();
    assert_eq!(names, ["routh", "maggi"]);
    let claims = ok(&["explain", "--json"]).json();
    let listed = ok(&["explain"]).out;
    let claims = claims.as_array().expect("a list");
    assert!(claims.len() >= 15);
    for claim in claims {
        let id = claim["id"].as_str().expect("an id");
        assert!(listed.contains(&format!("  {id} ")), "{id}");
        assert!(claim["explanation"].as_str().is_some_and(|e| e.len() > 40));
        assert!(claim["requires"].is_array() && claim["title"].is_string());
    }
    let maggi = ok(&["explain", "formulation.equivalent#maggi", "--json"]).json();
    assert_eq!(maggi["id"], "formulation.equivalent");
    assert_eq!(maggi["group"], "formulations");
    let models = ok(&["gallery", "list", "--json"]).json();
    assert_eq!(models, ok(&["gallery", "--json"]).json());
    let names = models.as_array().expect("a list").iter();
    let of_kind = |kind: &str, is_grouped: bool| {
        let own = names.clone().filter(|model| {
            let name = model["name"].as_str().expect("a name");
            model["kind"] == kind && name.contains('/') == is_grouped
        });
        own.count()
    };
    assert_eq!(of_kind("motion", false), gallery().len());
    let entries = |folder: &str| {
        let entries = std::fs::read_dir(root().join("gallery").join(folder)).expect(folder);
        entries.map(|entry| entry.expect("an entry").path())
    };
    let has_model = |folder: &std::path::PathBuf| folder.join("model.toml").is_file();
    let rows = entries("elasticity").filter(has_model).count();
    let classical = entries("fields").filter(has_model).count();
    // The 26 multi-level principles; classical functionals, Noether's, Jacobi's and Ritz's.
    assert_eq!(rows, 26);
    assert_eq!(of_kind("functional", true), rows + classical);
    assert_eq!(of_kind("motion", true), entries("bodies").count());
    let described = ok(&["gallery", "describe", "trailer", "--json"]).json();
    assert_eq!(
        described["files"],
        serde_json::json!(["README.md", "model-8.toml", "model.toml"])
    );
    assert_eq!(
        described["description"].as_str(),
        Some(ok(&["gallery", "describe", "trailer"]).out.as_str())
    );
}

#[test]
fn misspelt_claims_and_models_are_guessed() {
    for (arguments, meant) in [
        (
            vec!["explain", "energy.integrl"],
            "did you mean energy.integral?",
        ),
        (
            vec!["explain", "motion.equivalent"],
            "formulation.equivalent",
        ),
        (
            vec!["explain", "integrable"],
            "model.constraints-integrable",
        ),
        (
            vec!["study", SKATE, "--claims", "enrgy.integral"],
            "did you mean energy.integral?",
        ),
        (
            vec!["gallery", "copy", "snakebord"],
            "did you mean snakeboard?",
        ),
    ] {
        let finished = run(&arguments);
        assert_eq!(finished.status, Some(2), "{}", finished.both());
        assert!(finished.err.contains(meant), "{}", finished.both());
    }
    let hopeless = run(&["explain", "quantum.entanglement"]);
    assert!(hopeless.err.contains("lists them"), "{}", hopeless.err);
}

/// 2π and π/400 as the file takes them; what is no number is shown at its place.
#[test]
fn times_on_the_command_line_are_exact_expressions() {
    let out = scratch("expressions");
    let content = "coordinates = [\"x\", \"phi\"]\nlagrangian = \"(x'^2 + phi'^2 - x^2)/2\"\n[initial]\nx = 1\n";
    let path = model(&out, "model", content);
    let run_to = |t_end: &str, step: &str| {
        let method = ["--method", "rk4", "--step", step, "--t-end", t_end];
        let common = ["simulate", text(&path), "--json", "--out", text(&out)];
        run(&[&common[..], &method[..]].concat())
    };
    let finished = run_to("2 pi", "pi/400");
    assert_eq!(finished.status, Some(0), "{}", finished.both());
    let record = finished.json();
    assert_eq!(record["t_end"].as_f64(), Some(std::f64::consts::TAU));
    assert_eq!(record["steps"].as_u64(), Some(800));
    assert_eq!(run_to("1/2", "0.01").json()["t_end"].as_f64(), Some(0.5));
    for (t_end, step, words) in [
        ("2 pii", "0.1", ["`pii`", "--> --t-end:1:3"]),
        ("x", "0.1", ["`x` has no value", "--> --t-end:1:1"]),
        ("1", "phi'", ["`phi'` has no value", "--> --step:1:1"]),
        ("1", "sqrt(-1)", ["--step", "^"]),
        ("soon", "late", ["`soon`", "`late`"]),
    ] {
        let finished = run_to(t_end, step);
        assert_eq!(finished.status, Some(2), "{}", finished.both());
        for word in words {
            assert!(finished.err.contains(word), "{word}: {}", finished.err);
        }
    }
}

/// A terminal of its own, by `script` of util-linux.
#[cfg(target_os = "linux")]
#[test]
fn every_long_command_shows_its_progress_on_a_terminal() {
    let out = scratch("terminal");
    let trailer = "gallery/trailer/model.toml";
    let study = ["study", trailer, "--t-end", "1", "--out", text(&out)];
    let cases = [
        (&["derive", trailer, "--all"][..], "deriving "),
        (&study[..], "writing the report"),
    ];
    let program = text(chetaev_tests::program::path());
    let shown = |arguments: &[&str], links: usize| {
        let line = format!("{program} {} --set n={links}", arguments.join(" "));
        let shown = std::process::Command::new("script")
            .args(["--quiet", "--return", "--command", &line, "/dev/null"])
            .current_dir(root())
            .stdin(std::process::Stdio::null())
            .output();
        let shown = shown.ok()?.stdout;
        Some(String::from_utf8_lossy(&shown).into_owned())
    };
    for (arguments, words) in cases {
        let (mut states, mut is_shown) = (Vec::new(), false);
        // A stage is shown that lasts longer than a second: how many links that takes depends on the machine.
        for links in [8, 12, 18] {
            let Some(shown) = shown(arguments, links) else {
                return; // no such tool on this machine
            };
            states.push(shown.matches("\r\u{1b}[2K").count());
            is_shown = shown.contains(words);
            if is_shown {
                break;
            }
        }
        let repainted = states.last().is_some_and(|&last| last > 0);
        assert!(
            repainted && is_shown,
            "{states:?} states of the line, no `{words}`"
        );
    }
}

#[test]
fn results_go_where_they_are_asked_for() {
    let folder = scratch("folders");
    let skate = root().join(SKATE).canonicalize().expect("a path");
    let finished = run_in(&folder, &["study", text(&skate), "--t-end", "1"]);
    assert_eq!(finished.status, Some(0), "{}", finished.both());
    let mut names: Vec<String> = std::fs::read_dir(folder.join("out/skate-incline"))
        .expect("out/NAME")
        .map(|e| {
            e.expect("an entry")
                .file_name()
                .to_string_lossy()
                .into_owned()
        })
        .collect();
    names.sort();
    assert_eq!(
        names,
        [
            "report.html",
            "study.json",
            "trajectory.csv",
            "trajectory.npz"
        ]
    );
    let finished = run_in(
        &folder,
        &["study", text(&skate), "--t-end", "1", "--out", "a/b c/ü"],
    );
    assert_eq!(finished.status, Some(0), "{}", finished.both());
    assert!(folder.join("a/b c/ü/report.html").is_file());
    assert!(
        finished.out.contains("a/b c/ü/report.html"),
        "{}",
        finished.out
    );
}

#[test]
fn a_folder_that_cannot_be_written_is_an_error() {
    let folder = scratch("unwritable");
    let file = folder.join("file");
    std::fs::write(&file, "not a folder").expect("a file");
    for name in ["study", "simulate"] {
        let finished = run(&[name, SKATE, "--t-end", "1", "--out", text(&file)]);
        assert_eq!(finished.status, Some(2), "{}", finished.both());
        assert!(
            finished.err.contains("cannot be written") && finished.err.contains("unwritable"),
            "{}",
            finished.err
        );
        assert!(!finished.panicked());
    }
    assert_eq!(
        std::fs::read_to_string(&file).expect("the file"),
        "not a folder"
    );
}

#[test]
fn set_replaces_a_parameter_exactly() {
    let out = scratch("set");
    let record = ok(&[
        "study",
        "gallery/chaplygin-sleigh/model.toml",
        "--set",
        "a=0.3",
        "--out",
        text(&out),
        "--json",
    ])
    .json();
    assert_eq!(
        record["model"]["overrides"],
        serde_json::json!([{"name": "a", "value": "0.3"}])
    );
    // Of the final speed W sqrt((J + m a²)/m), with m = 3/2, J = 2/5, W = 21/10, a = 3/10.
    let last = record["trajectory"]["final"].as_array().expect("a state");
    let value = |name: &str| {
        last.iter()
            .find(|v| v["name"] == name)
            .and_then(|v| v["value"].as_f64())
            .expect("a value")
    };
    let speed = value("x'").hypot(value("y'"));
    assert!(
        (speed - 2.1 * ((0.4 + 1.5 * 0.09) / 1.5_f64).sqrt()).abs() < 1e-8,
        "{speed}"
    );
}

#[test]
fn a_closed_pipe_is_no_panic() {
    for arguments in [
        vec!["explain"],
        vec!["derive", "gallery/roller-racer/model.toml"],
        vec!["study", SKATE, "--t-end", "1", "--out", "SCRATCH", "--json"],
        vec!["gallery", "describe", "trailer"],
        vec!["completions", "zsh"],
    ] {
        let out = scratch("pipe");
        let arguments: Vec<&str> = arguments
            .into_iter()
            .map(|a| if a == "SCRATCH" { text(&out) } else { a })
            .collect();
        let mut child = command(&root(), &arguments)
            .spawn()
            .expect("the program starts");
        drop(child.stdout.take());
        let finished = finish(child, &arguments);
        assert!(!finished.panicked(), "{arguments:?}: {}", finished.both());
        assert_eq!(finished.err, "", "{arguments:?}");
    }
}

/// Waits until the program says on standard error that it is integrating, and returns what it said.
fn until_integrating(stream: &mut impl Read) -> String {
    let began = Instant::now();
    let mut said = String::new();
    let mut buffer = [0_u8; 256];
    while !said.contains("integrating") && began.elapsed() < Duration::from_secs(60) {
        match stream.read(&mut buffer) {
            Ok(0) | Err(_) => break,
            Ok(count) => said.push_str(&String::from_utf8_lossy(&buffer[..count])),
        }
    }
    said
}

#[cfg(unix)]
#[test]
fn an_interrupted_run_keeps_what_it_has() {
    let out = scratch("interrupt");
    // Without its limit of steps the run lasts longer than any machine needs to say that it has begun.
    let gallery = std::fs::read_to_string(root().join("gallery/double-pendulum/model.toml"));
    let endless = gallery.expect("the model").replacen(
        "[simulation]",
        "[simulation]\nmax_steps = 1000000000000",
        1,
    );
    assert!(endless.contains("max_steps"));
    let model = scratch("interrupt-model").join("model.toml");
    std::fs::write(&model, endless).expect("the model is written");
    let arguments = [
        "study",
        text(&model),
        "--t-end",
        "1000000000",
        "--out",
        text(&out),
    ];
    let mut child = command(&root(), &arguments)
        .spawn()
        .expect("the program starts");
    let mut err = child.stderr.take().expect("a pipe");
    let said = until_integrating(&mut err);
    assert!(said.contains("integrating"), "no progress is shown: {said}");
    let interrupted = std::process::Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status();
    assert!(interrupted.expect("kill runs").success());
    let drain = std::thread::spawn(move || {
        let mut rest = String::new();
        let _ = err.read_to_string(&mut rest);
        rest
    });
    let finished = finish(child, &arguments);
    let rest = drain.join().expect("standard error");
    assert_eq!(finished.status, Some(3), "{}{rest}", finished.both());
    let record: Value =
        serde_json::from_str(&std::fs::read_to_string(out.join("study.json")).expect("study.json"))
            .expect("whole JSON");
    let trajectory = &record["trajectory"];
    assert_eq!(trajectory["finished"], false);
    let reached = trajectory["t"].as_f64().expect("a time");
    assert!(reached > 0.0 && reached < 1e9, "{reached}");
    assert!(
        trajectory["reason"]
            .as_str()
            .is_some_and(|r| r.contains("interrupt")),
        "{trajectory}"
    );
    // There is little time for the page: it is whole, or not there.
    if let Ok(report) = std::fs::read_to_string(out.join("report.html")) {
        assert!(report.trim_end().ends_with("</html>"));
    }
    let (_, rows) = csv(&out.join("trajectory.csv"));
    assert_eq!(Some(rows.len() as u64), trajectory["rows"].as_u64());
    assert!(!std::fs::read_dir(&out).expect("the folder").any(|e| e
        .expect("an entry")
        .path()
        .extension()
        .is_some_and(|e| e == "partial")));
}

#[test]
fn every_claim_is_explained() {
    let listed = ok(&["explain"]).out;
    let ids: Vec<&str> = listed
        .lines()
        .filter_map(|l| l.strip_prefix("  ")?.split_whitespace().next())
        .collect();
    assert!(ids.len() >= 15, "{listed}");
    for id in ids {
        let explained = ok(&["explain", id]).out;
        assert!(
            explained.starts_with(&format!("{id}\n")) && explained.lines().count() > 3,
            "{explained}"
        );
    }
    assert!(ok(&["explain", "formulation.equivalent#maggi"])
        .out
        .contains("model."));
}

/// Header and rows.
fn csv(path: &Path) -> (Vec<String>, Vec<Vec<f64>>) {
    let content = std::fs::read_to_string(path).expect("the trajectory");
    let mut lines = content.lines();
    let names = lines
        .next()
        .expect("a header")
        .split(',')
        .map(str::to_owned)
        .collect();
    let number = |cell: &str| cell.parse::<f64>().expect("a number");
    (
        names,
        lines
            .map(|line| line.split(',').map(number).collect())
            .collect(),
    )
}

#[test]
fn csv_and_npz_hold_the_same_numbers_in_the_columns_documented() {
    let out = scratch("trajectory");
    ok(&["simulate", SKATE, "--out", text(&out)]);
    let (names, rows) = csv(&out.join("trajectory.csv"));
    let expected = "t,x,y,phi,x',y',phi',x'',y'',phi'',lambda_blade,energy,integral_yaw_rate,integral_speed_of_fall";
    assert_eq!(names.join(","), expected);
    assert_eq!(rows.len(), 501);
    let bytes = std::fs::read(out.join("trajectory.npz")).expect("the archive");
    let mut archive = zip::ZipArchive::new(std::io::Cursor::new(bytes)).expect("an archive");
    let arrays: Vec<String> = archive
        .file_names()
        .map(|name| name.expect("a name").into_owned())
        .collect();
    assert_eq!(arrays.len(), names.len());
    for (i, name) in names.iter().enumerate() {
        let primes = name.matches('\'').count();
        let array = match primes {
            0 => name.clone(),
            _ => format!("{}_{}", name.trim_end_matches('\''), "d".repeat(primes)),
        };
        let stored = archive
            .by_name(&format!("{array}.npy"))
            .unwrap_or_else(|e| panic!("{array} in {arrays:?}: {e}"));
        let stored = npyz::NpyFile::new(stored).expect("an array");
        assert_eq!(stored.shape(), &[rows.len() as u64]);
        let values: Vec<f64> = stored.into_vec().expect("double precision");
        let column: Vec<f64> = rows.iter().map(|row| row[i]).collect();
        assert_eq!(values, column, "{name}");
    }
    // x = gs/(2 W²) sin²(W t), at t = 4.
    let at_4 = rows
        .iter()
        .find(|row| row[0] == 4.0)
        .expect("a row at t = 4");
    assert!((at_4[1] - 0.923_659_323_921_437).abs() < 1e-8);
}

/// Every number that is a time spent, set to zero.
fn without_seconds(mut record: Value) -> Value {
    for verdict in record["verdicts"].as_array_mut().expect("verdicts") {
        verdict["seconds"] = serde_json::json!(0);
    }
    // The report shows the seconds too.
    let files = record["files"].as_array_mut().expect("files");
    files.retain(|file| file["name"] != "report.html");
    record
}

#[test]
fn two_studies_are_equal_but_for_the_time_they_took() {
    let folder = scratch("twice");
    for file in [
        "falling-rolling-disc/model.toml",
        "redundant-constraints/model.toml",
    ] {
        let study = |out: &str| {
            let out = folder.join(out);
            let record = ok(&[
                "study",
                &format!("gallery/{file}"),
                "--out",
                text(&out),
                "--json",
            ])
            .json();
            let read = |name: &str| std::fs::read(out.join(name)).expect("a file");
            (
                without_seconds(record),
                read("trajectory.csv"),
                read("trajectory.npz"),
            )
        };
        let first = study("one");
        // The clock of an archive's entries ticks every two seconds.
        std::thread::sleep(Duration::from_millis(2100));
        assert!(
            first == study("two"),
            "{file} is studied differently the second time"
        );
        let derive = || ok(&["derive", &format!("gallery/{file}")]).out;
        assert_eq!(derive(), derive());
    }
}

#[test]
fn progress_is_on_standard_error_and_a_summary_on_standard_output() {
    let out = scratch("summary");
    let finished = ok(&[
        "study",
        "gallery/chaplygin-sleigh/model.toml",
        "--out",
        text(&out),
    ]);
    for part in [
        "chaplygin-sleigh",
        "u' = a w^2",
        "nonholonomic",
        "conserved",
        "forms of the equations of motion proved equal",
        "largest change",
        "report.html",
        "--all",
    ] {
        assert!(
            finished.out.contains(part),
            "{part} is not in\n{}",
            finished.out
        );
    }
    assert!(!finished.out.contains('\u{1b}'), "no colours in a pipe");
}

#[test]
fn the_card_of_a_formulation_is_found_by_its_name() {
    for (name, words) in [
        (
            "routh",
            "Principle: d'Alembert–Lagrange with Chetaev's condition",
        ),
        ("vakonomic", "multipliers κ"),
    ] {
        let finished = run(&["explain", name]);
        assert_eq!(finished.status, Some(0), "{}", finished.both());
        assert!(finished.out.contains(words), "{}", finished.out);
    }
}

/// A full disk under the standard output: nothing that was asked for is there whole, and the command says so.
#[test]
#[cfg(target_os = "linux")]
fn a_full_disk_under_the_output_is_an_error() {
    let asked: [&[&str]; 4] = [
        &["derive", SKATE, "--as", "c"],
        &["check", SKATE, "--json"],
        &["explain", "energy.integral"],
        &["completions", "bash"],
    ];
    for arguments in asked {
        let full = std::fs::OpenOptions::new()
            .write(true)
            .open("/dev/full")
            .expect("the device that is always full");
        let output = command(&root(), arguments)
            .stdout(full)
            .output()
            .expect("the program runs");
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {said}");
        assert!(
            said.contains("standard output could not be written"),
            "{said}"
        );
    }
}
