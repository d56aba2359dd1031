//! What a model asks for and does not get is said: velocities that cannot be independent, initial data without a use,
//! expectations about nothing.
#![allow(clippy::expect_used, reason = "test code fails where it stands")]

use chetaev_tests::places::scratch;
use chetaev_tests::program::{command, finish, ok, run, text, Finished};

/// A command on a model.
fn on(command: &str, name: &str, body: &str) -> Finished {
    let folder = scratch(&format!("messages-{command}-{name}"));
    let path = folder.join("model.toml");
    std::fs::write(&path, body).expect("a scratch file");
    let mut arguments = vec![command, text(&path)];
    let out = folder.join("out");
    if command == "study" {
        arguments.extend(["--json", "--out", text(&out)]);
    }
    run(&arguments)
}

fn skate(rest: &str) -> String {
    format!(
        "coordinates = [\"x\", \"y\", \"phi\"]\nlagrangian = \"(x'^2 + y'^2 + phi'^2)/2\"\n{rest}\n[simulation]\nt_end = 1\n"
    )
}

const BLADE: &str = "[constraints]\nblade = \"y' cos(phi) = x' sin(phi)\"";

/// In the notices of a study and on standard error of `derive`.
fn said(name: &str, body: &str, words: &[&str]) {
    let study = on("study", name, body);
    assert_eq!(study.status, Some(0), "{}", study.both());
    let notices = study.json()["notices"].to_string();
    let derive = on("derive", name, body);
    assert_eq!(derive.status, Some(0), "{}", derive.both());
    for word in words {
        assert!(notices.contains(word), "{name}: {word}: {notices}");
        assert!(derive.err.contains(word), "{name}: {word}: {}", derive.err);
    }
}

/// Neither of them says anything about velocities.
fn unsaid(name: &str, body: &str) {
    let study = on("study", name, body);
    assert_eq!(study.status, Some(0), "{}", study.both());
    let notices = study.json()["notices"].to_string();
    assert!(!notices.contains("independent"), "{name}: {notices}");
    let derive = on("derive", name, body);
    assert_eq!(derive.err, "", "{name}");
}

#[test]
fn independent_velocities_that_cannot_be_so_are_named() {
    let asked = |list: &str, constraint: &str| {
        skate(&format!(
            "[velocities]\nindependent = [{list}]\n{constraint}"
        ))
    };
    said(
        "determined",
        &asked("\"x'\"", "[constraints]\nstill = \"x' = 0\""),
        &["`x'`", "determine", "`y'`, `phi'`"],
    );
    said(
        "dependent",
        &asked("\"x'\", \"y'\"", BLADE),
        &["not used", "depend on", "`phi'`"],
    );
    said(
        "too-many",
        &asked("\"x'\", \"y'\", \"phi'\"", BLADE),
        &["3 are asked for", "leave 2"],
    );
    said(
        "too-few",
        &asked("\"x'\"", BLADE),
        &["2 independent", "`phi'`", "`x'`"],
    );
    unsaid("used", &asked("\"x'\", \"phi'\"", BLADE));
}

#[test]
fn quasi_velocities_that_cannot_be_used_are_named() {
    let asked =
        |list: &str, constraint: &str| skate(&format!("[quasi_velocities]\n{list}\n{constraint}"));
    let forward = "u = \"x' cos(phi) + y' sin(phi)\"";
    said(
        "quasi-dependent",
        &asked(&format!("{forward}\nw = \"2 u\""), BLADE),
        &[
            "`u`, `w`",
            "not used",
            "depend on each other",
            "`x'`, `phi'`",
        ],
    );
    said(
        "quasi-few",
        &asked(forward, BLADE),
        &["`u`", "states 1", "2 independent"],
    );
    said(
        "quasi-nonlinear",
        &asked(&format!("{forward}\nw = \"phi'^2\""), BLADE),
        &["`w` is not linear"],
    );
    // Constraints need not be linear: a dependent velocity completes the quasi-velocities.
    unsaid(
        "quasi-constraint",
        &asked(
            &format!("{forward}\nw = \"phi'\""),
            "[constraints]\ncone = \"x'^2 + y'^2 = phi'^2\"\n[initial]\n\"x'\" = 1\n\"phi'\" = 1",
        ),
    );
    unsaid(
        "quasi-used",
        &asked(&format!("{forward}\nw = \"phi'\""), BLADE),
    );
}

#[test]
fn accelerations_as_initial_data_are_refused_at_their_place() {
    for body in [
        skate(&format!("{BLADE}\n[initial]\nx = 1\n\"x''\" = 2")),
        // Not even where no motion can be computed.
        skate("[initial]\nx = 1\n\"x''\" = 2\n[parameters]\nk = {}"),
    ] {
        let line = 1 + body
            .lines()
            .position(|l| l.contains("x''"))
            .expect("the line");
        let finished = on("check", "acceleration", &body);
        assert_eq!(finished.status, Some(2), "{}", finished.both());
        assert!(
            finished.err.contains("`x''` is not used")
                && finished.err.contains(&format!(":{line}:1")),
            "{}",
            finished.err
        );
    }
}

#[test]
fn initial_values_of_multipliers_are_not_passed_over() {
    let body = skate(&format!("{BLADE}\n[initial]\nlambda_blade = 2"));
    let notices = on("study", "multiplier", &body).json()["notices"].to_string();
    assert!(notices.contains("`lambda_blade`"), "{notices}");
}

#[test]
fn all_unknown_claims_are_reported_with_their_places() {
    let body = skate(
        "[expect]\n\"energy.integrl\" = \"proved\"\nenergy.integral = \"proved\"\n\"model.constraints-lineer\" = \"proved\"\n\"quantum.entanglement\" = \"proved\"",
    );
    for command in ["check", "study"] {
        let finished = on(command, "claims", &body);
        assert_eq!(finished.status, Some(2), "{}", finished.both());
        for words in [
            "model.toml:4:1",
            "did you mean `energy.integral`?",
            "model.toml:6:1",
            "did you mean `model.constraints-linear`?",
            "model.toml:7:1",
            "3 errors",
        ] {
            assert!(finished.err.contains(words), "{words}: {}", finished.err);
        }
    }
}

#[test]
fn letters_of_other_scripts_are_told_which_are_read() {
    for letter in ["é", "名", "ж", "ß"] {
        let body = format!("coordinates = [\"x\"]\nlagrangian = \"x'^2/2 + {letter} x\"\n");
        let finished = on("check", "letters", &body);
        assert_eq!(finished.status, Some(2));
        assert!(
            finished.err.contains(&format!("`{letter}`"))
                && finished.err.contains("Latin and Greek letters"),
            "{}",
            finished.err
        );
        let key = format!("coordinates = [\"{letter}\"]\nlagrangian = \"x'^2/2\"\n");
        let finished = on("check", "letters", &key);
        assert!(finished.err.contains("Latin"), "{}", finished.err);
    }
}

const FALL: &str = "coordinates = [\"x\"]\nlagrangian = \"x'^2/2 - x\"\n[initial]\nx = 1\n\"x'\" = 0\n[simulation]\nt_end = 1\nmethod = \"taylor\"\ntolerance = 1e-15\n";

fn scratch_model(name: &str, body: &str) -> std::path::PathBuf {
    let path = scratch(name).join("model.toml");
    std::fs::write(&path, body).expect("a scratch file");
    path
}

/// The tolerance of the file is out of range for the method of the command line: at its own line, not at the initial data.
#[test]
fn what_simulation_states_is_refused_at_its_place() {
    let path = scratch_model("messages-places", FALL);
    let found = |rest: &[&str]| {
        let finished = run(&[&["simulate", text(&path)], rest].concat());
        assert_eq!(finished.status, Some(2), "{}", finished.both());
        finished.err
    };
    let message = found(&["--method", "dop853"]);
    assert!(message.contains("model.toml:9:13"), "{message}");
    assert!(message.contains("tolerance = 1e-15"), "{message}");
    let message = found(&["--method", "dop853", "--tolerance", "1e-16"]);
    assert!(message.contains("--tolerance"), "{message}");
    assert!(!message.contains("model.toml"), "{message}");
}

/// A tolerance is said as it was asked for.
#[test]
fn tolerances_are_said_with_all_their_digits() {
    let path = scratch_model("messages-digits", FALL);
    let folder = scratch("messages-digits-out");
    for (tolerance, typeset) in [
        ("2.3e-16", "2.3 × 10⁻¹⁶"),
        ("1e-15", "10⁻¹⁵"),
        ("4.25e-10", "4.25 × 10⁻¹⁰"),
    ] {
        let ended = ok(&[
            "study",
            text(&path),
            "--claims",
            "motion",
            "--tolerance",
            tolerance,
            "--out",
            text(&folder),
        ]);
        let page = std::fs::read_to_string(folder.join("report.html")).expect("the report");
        assert!(
            ended
                .both()
                .contains(&format!("taylor at tolerance {tolerance}:")),
            "{}",
            ended.both()
        );
        assert!(
            page.contains(&format!("tolerance asked {typeset},")),
            "{tolerance} on the page"
        );
    }
}

/// A back end that does not exist is not passed over.
#[test]
fn back_ends_that_do_not_exist_are_refused() {
    let path = scratch_model("messages-backend", FALL);
    let folder = path.parent().expect("a folder");
    let by = |value: &str| {
        let arguments = ["simulate", text(&path)];
        let child = command(folder, &arguments)
            .env("CHETAEV_BACKEND", value)
            .spawn();
        finish(child.expect("the program starts"), &arguments)
    };
    let refused = by("foo");
    assert_eq!(refused.status, Some(2), "{}", refused.both());
    for word in ["CHETAEV_BACKEND=foo", "`interpreter`", "`avx2`"] {
        assert!(refused.err.contains(word), "{word}: {}", refused.err);
    }
    assert!(!folder.join("out").exists());
    for value in ["", "interpreter", "avx2"] {
        assert_eq!(by(value).status, Some(0), "{value}");
    }
}

/// What cannot be written whole leaves nothing behind: here a folder has the name of the result.
#[test]
fn results_that_cannot_be_written_leave_no_pieces() {
    let path = scratch_model("messages-written", FALL);
    let folder = path.parent().expect("a folder");
    let out = folder.join("out");
    std::fs::create_dir_all(out.join("trajectory.npz").join("taken")).expect("a folder");
    let refused = run(&["simulate", text(&path), "--out", text(&out)]);
    assert_eq!(refused.status, Some(2), "{}", refused.both());
    assert!(refused.err.contains("cannot be written"), "{}", refused.err);
    let left: Vec<_> = std::fs::read_dir(&out)
        .expect("the folder")
        .map(|e| e.expect("an entry").file_name())
        .collect();
    assert_eq!(left, ["trajectory.npz"]);
}

/// Of a system whose equations nobody can read, here since a potential doubles its length twenty times, the page says where other
/// formulations are to be had, and does not derive them.
#[test]
fn formulations_of_endless_equations_are_announced() {
    let doubled: String = (1..=20)
        .map(|i| format!("d{i} = \"sin(d{}) + d{}^2\"\n", i - 1, i - 1))
        .collect();
    let body = |potential: &str| {
        format!(
            "coordinates = [\"x\", \"y\", \"phi\"]\n[define]\nd0 = \"x + y\"\n{doubled}[lagrangian]\nT = \"(x'^2 + y'^2 + phi'^2)/2\"\nV = \"{potential}\"\n{BLADE}\n"
        )
    };
    let announced = "`chetaev derive MODEL --formulation voronets` derives and prints them";
    for (name, potential, expected) in [("long", "d20", true), ("short", "d1", false)] {
        let path = scratch_model(&format!("messages-endless-{name}"), &body(potential));
        let out = scratch(&format!("messages-endless-{name}-out"));
        ok(&[
            "study",
            text(&path),
            "--claims",
            "model.constraints-linear",
            "--out",
            text(&out),
        ]);
        let page = std::fs::read_to_string(out.join("report.html")).expect("the report");
        let page = page.replace("<code>", "`").replace("</code>", "`");
        assert_eq!(page.contains(announced), expected, "{name}");
        assert!(page.contains("Voronets"), "{name}");
    }
}
