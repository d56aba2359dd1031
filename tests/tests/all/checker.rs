//! The checker of the folder `checker`, which shares nothing with the program: it confirms what records say and rejects every record
//! that was made false. Where there is no Python 3.11 the tests say so and ask nothing.
#![allow(clippy::expect_used, reason = "test code fails where it stands")]

use chetaev_tests::places::{root, scratch};
use chetaev_tests::program::{ok, run, text};
use std::path::PathBuf;
use std::process::Command;
use std::sync::OnceLock;

const GROUPS: &str = "model,formulations,principles,integrals";

#[allow(clippy::print_stdout, reason = "a check that was not made is said")]
fn has_python() -> bool {
    let asked = Command::new("python3")
        .args(["-c", "import sys; sys.exit(sys.version_info < (3, 11))"])
        .status();
    let found = asked.is_ok_and(|status| status.success());
    if !found {
        println!("no Python 3.11: the checker was not run");
    }
    found
}

/// The records of a few fast models.
fn records() -> &'static [PathBuf] {
    static RECORDS: OnceLock<Vec<PathBuf>> = OnceLock::new();
    RECORDS.get_or_init(|| {
        let models = [
            "skate-level",
            "appell-hamel",
            "vertical-rolling-disc",
            "moving-knife-edge",
        ];
        let study = |name: &str| {
            let folder = scratch(&format!("checker-{name}"));
            let model = format!("gallery/{name}/model.toml");
            ok(&["study", &model, "--claims", GROUPS, "--out", text(&folder)]);
            folder.join("study.json")
        };
        models.into_iter().map(study).collect()
    })
}

#[test]
fn what_the_program_proves_and_refutes_is_confirmed() {
    if !has_python() {
        return;
    }
    for record in records() {
        let finished = run(&["verify", text(record), "--independent", "--json"]);
        assert_eq!(finished.status, Some(0), "{}", finished.both());
        let lines = finished.json();
        let lines = lines.as_array().expect("an array");
        let known =
            |v: &&serde_json::Value| matches!(v["verdict"].as_str(), Some("proved" | "refuted"));
        let decided = lines.iter().filter(known).count();
        let confirmed = |v: &&serde_json::Value| v["outcome"] == "confirmed";
        let confirmed = lines.iter().filter(known).filter(confirmed).count();
        assert!(
            10 * confirmed >= 8 * decided,
            "{confirmed} of {decided}: {}",
            record.display()
        );
    }
}

/// `z' = y x' + k x y'` is integrable for k = 1 alone, which the model states: a condition that the values stated satisfy is no contradiction.
#[test]
fn conditions_on_parameters_are_read() {
    if !has_python() {
        return;
    }
    let folder = scratch("checker-parameters");
    let model = folder.join("model.toml");
    let stated = "name = \"special\"\ncoordinates = [\"x\", \"y\", \"z\"]\n[parameters]\nk = 1\n[lagrangian]\nT = \"1/2 (x'^2 + y'^2 + z'^2)\"\n\
        [constraints]\nc = \"z' = y x' + k x y'\"\n";
    std::fs::write(&model, stated).expect("a model");
    ok(&[
        "study",
        text(&model),
        "--claims",
        GROUPS,
        "--out",
        text(&folder),
    ]);
    let record = folder.join("study.json");
    let finished = run(&["verify", text(&record), "--independent", "--json"]);
    assert_eq!(finished.status, Some(0), "{}", finished.both());
    let outcome = |of: &std::process::Output| String::from_utf8_lossy(&of.stdout).into_owned();
    let check = |changed: &str| {
        let other = folder.join("other.json");
        std::fs::write(&other, changed).expect("a record");
        let asked = Command::new("python3")
            .args([
                "-B",
                "checker/check_study.py",
                text(&other),
                "--only",
                "integrable#weak",
            ])
            .current_dir(root())
            .output();
        outcome(&asked.expect("Python runs"))
    };
    let own = std::fs::read_to_string(&record).expect("a record");
    let said = check(&own);
    assert!(
        said.starts_with("confirmed") && said.contains("conditional"),
        "{said}"
    );
    let said = check(&own.replace("\"condition\": \"k = 1\"", "\"condition\": \"k = 2\""));
    assert!(said.starts_with("rejected"), "{said}");
}

#[test]
fn tampered_records_are_rejected() {
    if !has_python() {
        return;
    }
    let finished = Command::new("python3")
        .args(["-B", "checker/tamper.py"])
        .arg(&records()[0])
        .current_dir(root())
        .output()
        .expect("Python runs");
    let said = String::from_utf8_lossy(&finished.stdout);
    assert!(
        finished.status.success(),
        "{said}{}",
        String::from_utf8_lossy(&finished.stderr)
    );
    let counts: Vec<u32> = said
        .split_whitespace()
        .filter_map(|w| w.parse().ok())
        .collect();
    assert!(counts[0] >= 300 && counts[0] == counts[1], "{said}");
}

/// Records of functionals: of the theory's table, in two dimensions and of the bar, and classical ones.
fn functionals() -> &'static [PathBuf] {
    static RECORDS: OnceLock<Vec<PathBuf>> = OnceLock::new();
    RECORDS.get_or_init(|| {
        let plane: &[&str] = &["--set", "d=2"];
        let bar: &[&str] = &["--set", "d=1", "--set", "nonlinear=0"];
        let models = [
            ("elasticity/p4p", plane),
            ("elasticity/p3pb", plane),
            ("elasticity/p2p0", plane),
            ("elasticity/p2pb", bar),
            ("elasticity/pc", bar),
            ("fields/plate", &[]),
            ("fields/minimal-surface", &[]),
            ("fields/elastic-plane", &[]),
            ("fields/crack", &[]),
        ];
        let study = |(name, set): (&str, &[&str])| {
            let folder = scratch(&format!("checker-{}", name.replace('/', "-")));
            let model = format!("gallery/{name}/model.toml");
            ok(&[&["study", &model, "--out", text(&folder)], set].concat());
            folder.join("study.json")
        };
        models.into_iter().map(study).collect()
    })
}

/// E2 of the theory, §5: the strain is not determined by its deviator, and equations of the pressure and the volume need each other. With
/// it a body under a force, of which no translation is a symmetry.
const PROJECTOR: &str = r#"
kind = "functional"
name = "projector"
density = "K2/2 e_ii e_jj - 1/2 e_ii s_jj - (s_ij s_ij - 1/2 s_ii s_jj)/(4 G) + D_ij s_ij - F_k u_k"
yields = ["pressure", "volume", "shear", "equilibrium"]
symmetries = ["translations"]
[sizes]
d = 2
[domain]
coordinates = "x_i"
boundary = ["S"]
[parameters]
K2 = {}
G = {}
[data]
F = "vector"
[fields]
e = "symmetric"
s = "symmetric"
u = "vector"
[define]
D_ij = "1/2 (u_i,j + u_j,i)"
[boundary]
S = { fixed = ["u"] }
[equations]
pressure = "s_ii = 2 K2 e_ii"
volume = "e_ii = D_ii"
shear = "s_ij - 1/2 s_kk delta_ij = 2 G (D_ij - 1/2 D_kk delta_ij)"
equilibrium = "s_ij,i + F_j = 0"
"#;

#[test]
fn equations_that_need_each_other_are_solved_together() {
    if !has_python() {
        return;
    }
    let folder = scratch("checker-projector");
    let model = folder.join("model.toml");
    std::fs::write(&model, PROJECTOR).expect("a scratch file");
    run(&["study", text(&model), "--out", text(&folder)]);
    let record = folder.join("study.json");
    let finished = run(&["verify", text(&record), "--independent", "--json"]);
    assert_eq!(finished.status, Some(0), "{}", finished.both());
    let lines = finished.json();
    let find = |id: &str| {
        let all = lines.as_array().expect("an array");
        let own = all.iter().find(|line| line["claim"] == id);
        own.expect(id).clone()
    };
    let euler = find("functional.euler#projector");
    assert_eq!(
        (&euler["verdict"], &euler["outcome"]),
        (&"proved".into(), &"confirmed".into())
    );
    let moved = find("functional.noether#translation-x_1");
    assert_eq!(
        (&moved["verdict"], &moved["outcome"]),
        (&"refuted".into(), &"confirmed".into())
    );
}

/// Each kind of claim is one short file that a person reads at once.
#[test]
fn checks_are_short_files_of_one_kind() {
    for entry in std::fs::read_dir(root().join("checker/claims")).expect("the folder") {
        let path = entry.expect("an entry").path();
        if path.extension().is_some_and(|own| own == "py") {
            let lines = std::fs::read_to_string(&path).expect("a file");
            assert!(lines.lines().count() <= 100, "{}", path.display());
        }
    }
}

/// What a record holds may be more than this program reads: it says so, and does not end with a trace of its own lines.
#[test]
fn nothing_in_a_record_makes_the_checker_fail() {
    if !has_python() {
        return;
    }
    let whole = std::fs::read_to_string(&functionals()[6]).expect("a record");
    let folder = scratch("checker-odd");
    let record = folder.join("study.json");
    let deep = format!("{}u{}", "(".repeat(30_000), ")".repeat(30_000));
    let long = "7".repeat(100_000);
    for density in [
        "u/0",
        "2^(2^(2^100)) u",
        "log(0) u",
        "u^(1/0)",
        "((",
        deep.as_str(),
        long.as_str(),
    ] {
        let mut own: serde_json::Value = serde_json::from_str(&whole).expect("JSON");
        let flat = own["model"]["flat"].as_str().expect("a text");
        let line = flat.lines().find(|line| line.starts_with("density = "));
        let flat = flat.replacen(
            line.expect("a density"),
            &format!("density = \"{density}\""),
            1,
        );
        own["model"]["flat"] = flat.into();
        std::fs::write(&record, own.to_string()).expect("a scratch file");
        let finished = run(&["verify", text(&record), "--independent"]);
        let said = finished.both();
        assert!(!said.contains("Traceback"), "{said}");
        assert!(matches!(finished.status, Some(0..=2)), "{said}");
    }
}

#[test]
fn what_is_proved_of_functionals_is_confirmed() {
    if !has_python() {
        return;
    }
    let mut confirmed = 0;
    for record in functionals() {
        let finished = run(&["verify", text(record), "--independent", "--json"]);
        assert_eq!(finished.status, Some(0), "{}", finished.both());
        for line in finished.json().as_array().expect("an array") {
            let claim = line["claim"].as_str().expect("an id");
            let is_known = !claim.starts_with("functional.multipliers");
            if is_known && line["verdict"] == "proved" {
                assert_eq!(line["outcome"], "confirmed", "{}: {line}", record.display());
                confirmed += 1;
            }
        }
    }
    assert!(confirmed >= 20, "{confirmed}");
}

#[test]
fn tampered_records_of_functionals_are_rejected() {
    if !has_python() {
        return;
    }
    let finished = Command::new("python3")
        .args(["-B", "checker/tamper.py"])
        .args(functionals())
        .current_dir(root())
        .output()
        .expect("Python runs");
    let said = String::from_utf8_lossy(&finished.stdout);
    assert!(finished.status.success(), "{said}");
    let counts: Vec<u32> = said
        .split_whitespace()
        .filter_map(|w| w.parse().ok())
        .collect();
    assert!(counts[0] >= 70 && counts[0] == counts[1], "{said}");
}

#[test]
fn the_program_carries_every_file_of_the_checker() {
    let carried: Vec<&str> = chetaev::checker::FILES.iter().map(|own| own.0).collect();
    let mut names: Vec<String> = Vec::new();
    for (folder, prefix) in [("checker", ""), ("checker/claims", "claims/")] {
        for entry in std::fs::read_dir(root().join(folder)).expect("the folder") {
            let name = entry
                .expect("an entry")
                .file_name()
                .into_string()
                .expect("a name");
            if name.ends_with(".py") && !["tamper.py", "ledger.py"].contains(&name.as_str()) {
                names.push(format!("{prefix}{name}"));
            }
        }
    }
    assert!(names.len() > 15);
    let missing: Vec<_> = names
        .iter()
        .filter(|name| !carried.contains(&name.as_str()))
        .collect();
    assert!(missing.is_empty(), "{missing:?}");
}

#[test]
fn a_record_without_a_lowered_model_or_of_another_kind_is_no_confirmation() {
    if !has_python() {
        return;
    }
    let folder = scratch("checker-broken");
    let broken = folder.join("study.json");
    std::fs::write(&broken, "{\"model\": 3}").expect("a scratch file");
    let finished = run(&["verify", text(&broken), "--independent"]);
    assert_eq!(finished.status, Some(2), "{}", finished.both());
    assert!(
        finished.err.contains("cannot be read"),
        "{}",
        finished.both()
    );
}
