//! Runs that are ended, files that are in the way, texts that are made to harm: exit statuses, what is kept, how long it takes.
#![allow(clippy::expect_used, reason = "test code fails where it stands")]

use chetaev_tests::places::{root, scratch};
use chetaev_tests::program::{command, finish, run, run_in, text, Finished};
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::Child;
use std::time::{Duration, Instant};

fn written(folder: &Path, name: &str, content: &str) -> PathBuf {
    let path = folder.join(name);
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder).expect("a folder");
    }
    std::fs::write(&path, content).expect("a scratch file");
    path
}

fn signal(child: &Child, name: &str) {
    let sent = std::process::Command::new("kill")
        .args([name, &child.id().to_string()])
        .status();
    assert!(sent.expect("kill runs").success());
}

/// The program interrupted after some milliseconds, and how long it went on.
fn interrupted(arguments: &[&str], after: u64) -> (Finished, Duration) {
    let child = command(&root(), arguments)
        .spawn()
        .expect("the program starts");
    std::thread::sleep(Duration::from_millis(after));
    signal(&child, "-INT");
    let began = Instant::now();
    (finish(child, arguments), began.elapsed())
}

fn record(folder: &Path) -> Value {
    let text = std::fs::read_to_string(folder.join("study.json")).expect("study.json");
    serde_json::from_str(&text).expect("whole JSON")
}

/// On a machine where other tests run, and in a build for tests: three times what a person waits for at most.
const SOON: Duration = Duration::from_millis(900);

#[test]
fn an_interruption_ends_claims_and_derivations_at_once() {
    let out = scratch("interrupt-claims");
    // Many trailers: every phase lasts long.
    let arguments = [
        "study",
        "gallery/trailer/model.toml",
        "--set",
        "n=12",
        "--t-end",
        "1",
        "--out",
        text(&out),
    ];
    for after in [300, 900, 2000, 4000] {
        let (finished, waited) = interrupted(&arguments, after);
        assert_eq!(
            finished.status,
            Some(3),
            "after {after} ms: {}",
            finished.both()
        );
        assert!(!finished.panicked(), "{}", finished.both());
        assert!(waited < SOON, "after {after} ms: went on for {waited:?}");
        assert!(
            finished.both().contains("interrupted"),
            "{}",
            finished.both()
        );
    }
    for arguments in [
        &[
            "derive",
            "gallery/trailer/model.toml",
            "--set",
            "n=40",
            "--all",
        ][..],
        &["check", "gallery/trailer/model.toml", "--set", "n=60"][..],
    ] {
        let (finished, waited) = interrupted(arguments, 400);
        // One that had ended before is none that was interrupted.
        if finished.status != Some(0) {
            assert_eq!(
                finished.status,
                Some(3),
                "{arguments:?}: {}",
                finished.both()
            );
        }
        assert!(waited < SOON, "{arguments:?}: went on for {waited:?}");
    }
}

#[test]
fn what_was_decided_before_an_interruption_is_kept() {
    let out = scratch("interrupt-kept");
    let arguments = [
        "study",
        "gallery/whipple-bicycle/model.toml",
        "--t-end",
        "0.1",
        "--out",
        text(&out),
    ];
    let (finished, _) = interrupted(&arguments, 6000);
    if finished.status == Some(0) {
        return;
    }
    assert_eq!(finished.status, Some(3), "{}", finished.both());
    let record = record(&out);
    let notices = record["notices"].to_string();
    assert!(notices.contains("interrupted"), "{notices}");
    let verdicts = record["verdicts"].as_array().expect("verdicts");
    let of = |word: &str| verdicts.iter().filter(|v| v["verdict"] == word).count();
    assert!(of("undecided") > 0, "{record}");
}

#[test]
fn the_budget_is_work_and_holds_at_any_size() {
    let study = |name: &str, budget: &str| {
        let out = scratch(name);
        let began = Instant::now();
        let finished = run(&[
            "study",
            "gallery/trailer/model.toml",
            "--set",
            "n=20",
            "--t-end",
            "0.01",
            "--claims",
            "model,formulations,integrals",
            "--budget",
            budget,
            "--out",
            text(&out),
        ]);
        assert!(!finished.panicked(), "{}", finished.both());
        let words: Vec<(String, String)> = record(&out)["verdicts"]
            .as_array()
            .expect("verdicts")
            .iter()
            .map(|v| {
                let detail = v["detail"].as_str().unwrap_or_default();
                // On a machine that does other work too the clock may come before the count.
                let word = if detail.starts_with("time: ") {
                    "undecided (time)".to_owned()
                } else {
                    v["verdict"].to_string()
                };
                (format!("{}#{}", v["claim"], v["subject"]), word)
            })
            .collect();
        (words, began.elapsed())
    };
    let (first, took) = study("budget-1", "1");
    let (second, _) = study("budget-2", "1");
    // Twice the budget by the clock, the derivation and the page; other tests run beside.
    assert!(took < Duration::from_secs(40), "{took:?}");
    for (claim, word) in &first {
        let Some((_, other)) = second.iter().find(|(own, _)| own == claim) else {
            continue;
        };
        if ![word, other].iter().any(|word| word.contains("(time)")) {
            assert_eq!(word, other, "{claim}");
        }
    }
    assert!(
        first.iter().any(|(_, word)| word.contains("undecided")),
        "{first:?}"
    );
}

const PENDULUM: &str = "name = \"p\"\ncoordinates = [\"x\"]\nlagrangian = { T = \"1/2 x'^2\", V = \"1/2 x^2\" }\n[initial]\nx = 1\n[simulation]\nt_end = 1\n";

#[test]
fn two_processes_write_whole_files_beside_each_other() {
    let folder = scratch("two-writers");
    let out = folder.join("out");
    let model = written(&folder, "p.toml", PENDULUM);
    let children: Vec<(Child, Vec<String>)> = ["1", "2", "3", "1"]
        .iter()
        .map(|end| {
            let arguments = [
                "study",
                text(&model),
                "--claims",
                "model,motion",
                "--t-end",
                end,
                "--out",
                text(&out),
            ];
            let child = command(&root(), &arguments)
                .spawn()
                .expect("the program starts");
            (child, arguments.iter().map(|a| (*a).to_owned()).collect())
        })
        .collect();
    for (child, arguments) in children {
        let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
        let finished = finish(child, &arguments);
        assert_eq!(finished.status, Some(0), "{}", finished.both());
    }
    // Every file is whole, and no other name is left.
    let left = std::fs::read_dir(&out).expect("the folder");
    let mut names: Vec<String> = left
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
    assert_eq!(record(&out)["schema"], "chetaev-study-1");
}

#[test]
fn files_that_do_not_belong_to_a_record_are_seen() {
    let folder = scratch("mixed");
    let out = folder.join("out");
    let model = written(&folder, "p.toml", PENDULUM);
    let study = |end: &str| {
        run(&[
            "study",
            text(&model),
            "--t-end",
            end,
            "--claims",
            "model,motion",
            "--out",
            text(&out),
        ])
    };
    assert_eq!(study("1").status, Some(0));
    let json = out.join("study.json");
    let verified = run(&["verify", text(&json)]);
    assert_eq!(verified.status, Some(0), "{}", verified.both());
    assert!(verified.out.contains("trajectory.csv"), "{}", verified.out);
    let kept = std::fs::read(out.join("trajectory.csv")).expect("the rows");
    assert_eq!(study("2").status, Some(0));
    std::fs::write(out.join("trajectory.csv"), kept).expect("written");
    let verified = run(&["verify", text(&json)]);
    assert_eq!(verified.status, Some(1), "{}", verified.both());
    assert!(
        verified
            .out
            .contains("not what was written with this record"),
        "{}",
        verified.out
    );
}

#[cfg(unix)]
#[test]
fn planted_links_are_replaced_and_not_followed() {
    let folder = scratch("links");
    let out = folder.join("out");
    std::fs::create_dir_all(&out).expect("a folder");
    let model = written(&folder, "p.toml", PENDULUM);
    let treasure = written(&folder, "treasure", "mine");
    for name in [
        "study.json",
        "report.html",
        "trajectory.csv",
        "trajectory.csv.partial",
    ] {
        let _ = std::fs::remove_file(out.join(name));
        std::os::unix::fs::symlink(&treasure, out.join(name)).expect("a link");
    }
    let finished = run(&[
        "study",
        text(&model),
        "--claims",
        "model,motion",
        "--out",
        text(&out),
    ]);
    assert_eq!(finished.status, Some(0), "{}", finished.both());
    assert_eq!(
        std::fs::read_to_string(&treasure).expect("the file"),
        "mine"
    );
    let is_link = |name: &str| {
        std::fs::symlink_metadata(out.join(name))
            .expect("it is there")
            .is_symlink()
    };
    assert!(!is_link("study.json") && !is_link("trajectory.csv"));
    // A sweep opens its files for more than one writing, and refuses a link.
    let sweep = folder.join("sweep");
    std::fs::create_dir_all(&sweep).expect("a folder");
    std::os::unix::fs::symlink(&treasure, sweep.join("sweep.data")).expect("a link");
    let finished = run(&[
        "sweep",
        text(&model),
        "--initial",
        "x=0.5:1:2",
        "--out",
        text(&sweep),
    ]);
    assert_eq!(finished.status, Some(2), "{}", finished.both());
    assert_eq!(
        std::fs::read_to_string(&treasure).expect("the file"),
        "mine"
    );
}

/// A shell that limits the size of files, in blocks of 512 bytes, as a full disk does.
#[cfg(unix)]
#[test]
fn a_full_disk_leaves_whole_files_only() {
    let folder = scratch("full");
    let out = folder.join("out");
    let model = written(&folder, "p.toml", PENDULUM);
    assert_eq!(
        run(&[
            "study",
            text(&model),
            "--claims",
            "model,motion",
            "--out",
            text(&out)
        ])
        .status,
        Some(0)
    );
    let before = std::fs::read(out.join("study.json")).expect("study.json");
    let program = chetaev_tests::program::path();
    let line = format!(
        "trap '' XFSZ; ulimit -f 8; exec '{}' study '{}' --claims model,motion --t-end 3 --out '{}'",
        program.display(),
        model.display(),
        out.display()
    );
    let ended = std::process::Command::new("sh")
        .args(["-c", &line])
        .output()
        .expect("sh runs");
    assert_eq!(
        ended.status.code(),
        Some(2),
        "{}",
        String::from_utf8_lossy(&ended.stderr)
    );
    assert!(String::from_utf8_lossy(&ended.stderr).contains("cannot be written"));
    assert_eq!(
        std::fs::read(out.join("study.json")).expect("study.json"),
        before
    );
    let partial = |e: std::io::Result<std::fs::DirEntry>| {
        e.expect("an entry")
            .path()
            .extension()
            .is_some_and(|e| e == "partial")
    };
    assert!(!std::fs::read_dir(&out).expect("the folder").any(partial));
}

#[cfg(unix)]
#[test]
fn a_killed_study_leaves_whole_files_only() {
    let folder = scratch("killed");
    let out = folder.join("out");
    let model = written(&folder, "p.toml", PENDULUM);
    for after in [5, 20, 60, 150, 400] {
        let arguments = ["study", text(&model), "--out", text(&out)];
        let child = command(&root(), &arguments)
            .spawn()
            .expect("the program starts");
        std::thread::sleep(Duration::from_millis(after));
        signal(&child, "-KILL");
        let _ = finish(child, &arguments);
        if let Ok(text) = std::fs::read_to_string(out.join("study.json")) {
            let _: Value = serde_json::from_str(&text).expect("whole JSON");
        }
    }
    assert_eq!(
        run(&[
            "study",
            text(&model),
            "--claims",
            "model,motion",
            "--out",
            text(&out)
        ])
        .status,
        Some(0)
    );
}

#[test]
fn a_finished_sweep_is_believed_by_its_checksums() {
    let folder = scratch("sweep-sums");
    let out = folder.join("out");
    let model = written(&folder, "p.toml", PENDULUM);
    let arguments = [
        "sweep",
        text(&model),
        "--initial",
        "x=0.5:1:3",
        "--out",
        text(&out),
    ];
    let first = run(&arguments);
    assert_eq!(first.status, Some(0), "{}", first.both());
    let again = run(&arguments);
    assert_eq!(again.status, Some(0), "{}", again.both());
    assert!(again.both().contains("is complete"), "{}", again.both());
    let archive = out.join("sweep.npz");
    let mut bytes = std::fs::read(&archive).expect("the archive");
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    std::fs::write(&archive, bytes).expect("written");
    let replaced = run(&arguments);
    assert_eq!(replaced.status, Some(2), "{}", replaced.both());
    assert!(
        replaced.err.contains("not what a sweep wrote"),
        "{}",
        replaced.err
    );
}

#[test]
fn nothing_that_a_model_says_reaches_the_terminal_as_a_command() {
    let folder = scratch("escapes");
    let obeyed = |finished: &Finished| {
        finished
            .both()
            .chars()
            .any(|c| c.is_control() && !matches!(c, '\n' | '\t'))
    };
    let name = PENDULUM.replace("\"p\"", "\"A\\u001b]0;x\\u0007\\u001b[2J\"");
    let model = written(&folder, "escape.toml", &name);
    let checked = run(&["check", text(&model)]);
    assert_eq!(checked.status, Some(2), "{}", checked.both());
    assert!(checked.err.contains("U+001B"), "{}", checked.err);
    assert!(!obeyed(&checked), "{:?}", checked.both());
    // In the name of the file, and in a line that is shown.
    let model = written(
        &folder,
        "a\u{1b}[2J.toml",
        "coordinates = [\"x\"]\nlagrangian = \"1/2 x'^2 + \u{85}y\"\n",
    );
    let checked = run(&["check", text(&model)]);
    assert_eq!(checked.status, Some(2), "{}", checked.both());
    assert!(!obeyed(&checked), "{:?}", checked.both());
}

#[test]
fn includes_stay_below_their_folder_and_end() {
    let folder = scratch("includes");
    let refused = |model: &Path, words: &str| {
        let began = Instant::now();
        let checked = run(&["check", text(model)]);
        assert_eq!(checked.status, Some(2), "{}", checked.both());
        assert!(checked.err.contains(words), "`{words}` in\n{}", checked.err);
        assert!(
            began.elapsed() < Duration::from_secs(10),
            "{:?}",
            began.elapsed()
        );
    };
    let with = |name: &str, include: &str| {
        written(
            &folder,
            name,
            &format!("include = \"{include}\"\n{PENDULUM}"),
        )
    };
    written(&folder, "outside.toml", "description = \"o\"\n");
    refused(&with("a/up.toml", "../outside.toml"), "outside of");
    refused(&with("a/zero.toml", "/dev/zero"), "outside of");
    // With a project above both it may be read.
    written(&folder, "project/chetaev.toml", "");
    written(&folder, "project/common/base.toml", "description = \"b\"\n");
    let inside = with("project/models/m.toml", "../common/base.toml");
    let checked = run(&["check", text(&inside)]);
    assert_eq!(checked.status, Some(0), "{}", checked.both());
    refused(
        &with("project/models/far.toml", "../../outside.toml"),
        "outside of",
    );
    // Each of twenty files includes the one before twice.
    written(&folder, "double/l0.toml", "description = \"l\"\n");
    for k in 1..=20 {
        let below = k - 1;
        written(
            &folder,
            &format!("double/l{k}.toml"),
            &format!("include = [\"l{below}.toml\", \"l{below}.toml\"]\n"),
        );
    }
    refused(&with("double/m.toml", "l20.toml"), "100 files at most");
    #[cfg(unix)]
    {
        let pipe = folder.join("a/pipe");
        let made = std::process::Command::new("mkfifo").arg(&pipe).status();
        assert!(made.expect("mkfifo runs").success());
        refused(&with("a/fifo.toml", "pipe"), "not a regular file");
        std::os::unix::fs::symlink("/etc/hosts", folder.join("a/link.toml")).expect("a link");
        refused(&with("a/linked.toml", "link.toml"), "outside of");
    }
}

#[test]
fn many_wrong_things_are_reported_in_time_in_proportion() {
    let folder = scratch("many");
    let keys: String = (0..40_000).map(|k| format!("wrong_{k} = 1\n")).collect();
    let model = written(&folder, "keys.toml", &format!("{keys}{PENDULUM}"));
    let began = Instant::now();
    let checked = run(&["check", text(&model)]);
    assert_eq!(checked.status, Some(2));
    assert!(
        began.elapsed() < Duration::from_secs(8),
        "{:?}",
        began.elapsed()
    );
    let names: String = (0..5_000)
        .map(|k| format!("a{k} = \"zz{k} + 1\"\n"))
        .collect();
    let model = written(
        &folder,
        "names.toml",
        &format!("{PENDULUM}[define]\n{names}"),
    );
    let began = Instant::now();
    assert_eq!(run(&["check", text(&model)]).status, Some(2));
    assert!(
        began.elapsed() < Duration::from_secs(8),
        "{:?}",
        began.elapsed()
    );
    // Quotients of quotients, and functions of functions.
    let took = |depth: usize| {
        let quotient = (0..depth).fold("x".to_owned(), |inner, k| {
            format!("({k} + 1)/(2 + {inner})")
        });
        let model = written(
            &folder,
            &format!("deep{depth}.toml"),
            &PENDULUM.replace("1/2 x^2", &quotient),
        );
        let began = Instant::now();
        let _ = run(&["check", text(&model)]);
        began.elapsed().as_secs_f64()
    };
    let (short, long) = (took(200), took(800));
    assert!(long < 12.0 * short + 2.0, "{short} {long}");
}

#[test]
fn a_record_cannot_make_its_verifier_work_for_ever() {
    let folder = scratch("endless-record");
    let out = folder.join("out");
    let model = written(&folder, "p.toml", PENDULUM);
    assert_eq!(
        run(&[
            "study",
            text(&model),
            "--claims",
            "model,integrals",
            "--out",
            text(&out)
        ])
        .status,
        Some(0)
    );
    let mut record = record(&out);
    record["options"]["budget"] = serde_json::json!(1e308);
    let json = written(&folder, "out/study.json", &record.to_string());
    let began = Instant::now();
    let verified = run_in(&folder, &["verify", text(&json), "--budget", "5"]);
    assert!(!verified.panicked(), "{}", verified.both());
    assert!(
        began.elapsed() < Duration::from_secs(60),
        "{:?}",
        began.elapsed()
    );
}

/// What is offered is read, and means what is said.
#[test]
fn advice_that_is_given_can_be_followed() {
    let folder = scratch("advice");
    let check = |v: &str| {
        let text_of = format!("coordinates = [\"x\", \"y\"]\nparameters = [\"a\", \"b\"]\nlagrangian = {{ T = \"1/2 (x'^2 + y'^2)\", V = \"{v}\" }}\n");
        run(&["check", text(&written(&folder, "m.toml", &text_of))]).err
    };
    for (v, wanted, unwanted) in [
        (
            "(a + b)/(a - b) x",
            "write `(a + b)/((a - b) x)`",
            "a + b/(a",
        ),
        ("a/b x", "write `a/(b x)`", "help: write `a/b"),
        ("min(1, x)", "not available", "sin(1"),
        ("(dx/dt)^2", "write `x'`", "(x/dt)"),
        ("a xdot^2", "write `x'`", "did you mean"),
        ("a diff(x, t)", "primes", "stray-comma"),
        ("if(x > 0, 1, 2)", "tanh", "unexpected-relation"),
        ("m x", "state a constant under [parameters]", "did you mean"),
        ("sinn(x)", "did you mean the function `sin`?", "sinn("),
    ] {
        let said = check(v);
        assert!(said.contains(wanted), "{v}: `{wanted}` is not in\n{said}");
        let said = said.replace(&format!("V = \"{v}\""), "");
        assert!(!said.contains(unwanted), "{v}: `{unwanted}` is in\n{said}");
    }
    // Degrees are numbers.
    let said = check("a cos(30 deg)");
    assert!(!said.contains("error["), "{said}");
    let feedback = "coordinates = [\"x\"]\nparameters = { m = 1, K = 2 }\nlagrangian = { T = \"1/2 m x'^2\" }\n[controls]\nu = \"-K x\"\n[forces]\nx = \"u\"\n";
    let said = run(&["check", text(&written(&folder, "feedback.toml", feedback))]).err;
    assert!(
        said.contains("state feedback belongs to [forces]"),
        "{said}"
    );
    assert!(!said.contains("which is constant"), "{said}");
    let unused = "coordinates = [\"a\"]\nassumptions = [\"J > 0\"]\n[parameters]\nm = 1\nJ = 0.2\n[define]\nw = \"a' + 1\"\n[lagrangian]\nT = \"1/2 m a'^2\"\n";
    let checked = run(&["check", text(&written(&folder, "unused.toml", unused))]);
    assert_eq!(checked.status, Some(0), "{}", checked.both());
    for what in [
        "the parameter `J` occurs nowhere",
        "the definition `w` occurs nowhere",
    ] {
        assert!(checked.err.contains(what), "{}", checked.err);
    }
    assert!(
        !checked.err.contains("`m` occurs nowhere"),
        "{}",
        checked.err
    );
}
