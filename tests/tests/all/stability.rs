//! `chetaev linearize` and `chetaev stability` as a person uses them, and the claims on steady motions in a study.
#![allow(clippy::expect_used, reason = "test code fails where it stands")]

use chetaev_tests::places::root;
use chetaev_tests::program::{run, text};
use serde_json::Value;
use std::path::PathBuf;

fn model(name: &str) -> PathBuf {
    root().join(format!("gallery/{name}/model.toml"))
}

fn json(arguments: &[&str]) -> Value {
    let finished = run(arguments);
    assert_eq!(finished.status, Some(0), "{}", finished.both());
    serde_json::from_str(&finished.out).expect("JSON")
}

/// The critical speeds of Meijaard, Papadopoulos, Ruina and Schwab 2007, with more digits than their print has.
#[test]
fn the_bicycle_from_the_command_line() {
    let path = model("whipple-bicycle");
    let found = json(&["stability", text(&path), "--over", "v=0:10", "--json"]);
    let critical: Vec<(&str, f64)> = (found["critical"].as_array().expect("a list").iter())
        .map(|c| {
            (
                c["kind"].as_str().expect("a kind"),
                c["value"].as_f64().expect("a value"),
            )
        })
        .filter(|(kind, _)| *kind != "touching")
        .collect();
    for (kind, expected) in [
        ("pair", 4.292_382_536_341_104),
        ("zero", 6.024_262_015_388_359),
    ] {
        assert!(
            critical
                .iter()
                .any(|(own, value)| *own == kind && (value - expected).abs() < 1e-14),
            "{critical:?}"
        );
    }
    let stable: Vec<&Value> = (found["regions"].as_array().expect("a list").iter())
        .filter(|r| r["stability"] == "asymptotic")
        .collect();
    assert_eq!(stable.len(), 1);
    let printed = run(&["stability", text(&path), "--over", "v=0:10"]);
    assert!(
        printed
            .out
            .contains("4.292382536341104 < v < 6.024262015388359: stable"),
        "{}",
        printed.out
    );
    let linear = run(&["linearize", text(&path)]);
    assert!(
        linear.out.contains("z = (phi, delta, phi', delta', thR')"),
        "{}",
        linear.out
    );
}

/// What a study states of the motions that gallery models name.
#[test]
fn claims_on_steady_motions() {
    let claims = [
        (
            "whipple-bicycle",
            "stability.asymptotic",
            "upright",
            "conditional",
            "4.292382536341104 < v < 6.024262015388359",
        ),
        ("whipple-bicycle", "steady.stated", "upright", "proved", ""),
        (
            "chaplygin-sleigh",
            "stability.asymptotic",
            "straight",
            "conditional",
            "ahead > 0",
        ),
        (
            "double-pendulum",
            "stability.spectral",
            "hanging",
            "proved",
            "",
        ),
        (
            "double-pendulum",
            "stability.asymptotic",
            "hanging",
            "refuted",
            "",
        ),
        (
            "double-pendulum",
            "stability.spectral",
            "inverted",
            "refuted",
            "",
        ),
    ];
    for (name, claim, subject, verdict, condition) in claims {
        let path = model(name);
        let out =
            std::env::temp_dir().join(format!("chetaev-stability-{name}-{}", std::process::id()));
        let found = json(&[
            "study",
            text(&path),
            "--claims",
            "stability",
            "--json",
            "--out",
            text(&out),
        ]);
        let _ = std::fs::remove_dir_all(&out);
        let own = (found["verdicts"].as_array().expect("verdicts").iter())
            .find(|v| v["claim"] == claim && v["subject"] == subject)
            .unwrap_or_else(|| panic!("{name}: {claim}#{subject} is missing"));
        assert_eq!(own["verdict"], verdict, "{name}: {own}");
        assert_eq!(
            own["condition"].as_str().unwrap_or_default(),
            condition,
            "{name}: {own}"
        );
    }
}

/// A thin disc rolls upright without falling where ω² > g/(3 r), and spins on the spot where Ω² > 4 g/(5 r) (Routh 1905).
#[test]
fn the_disc_stands_above_its_critical_rates() {
    let path = model("falling-rolling-disc");
    for (about, squared) in [
        ("rolling", 9.81 / (3.0 * 0.3)),
        ("spinning", 4.0 * 9.81 / (5.0 * 0.3)),
    ] {
        let found = json(&[
            "stability",
            text(&path),
            "--about",
            about,
            "--over",
            "spin=0:12",
            "--json",
        ]);
        let regions = found["regions"].as_array().expect("a list");
        let last = regions.last().expect("a region");
        assert_eq!(last["stability"], "spectral");
        let from = last["from"].as_f64().expect("a number");
        assert!(
            (from * from - squared).abs() < 1e-12 * squared,
            "{about}: {from}"
        );
        assert!(regions[..regions.len() - 1]
            .iter()
            .all(|r| r["stability"] == "unstable"));
    }
}

/// What is written for other programs: a file in the format of its end, or a word that there is none.
#[test]
fn linear_equations_for_other_programs() {
    let path = model("whipple-bicycle");
    let folder = std::env::temp_dir().join(format!("chetaev-linear-{}", std::process::id()));
    let begins: [(&str, &[u8]); 4] = [
        ("npz", b"PK"),
        ("mat", &[0, 0, 0, 0, 5, 0, 0, 0, 5, 0, 0, 0]),
        ("py", b"# whipple-bicycle"),
        ("tex", b"\\[ E ="),
    ];
    for (end, begin) in begins {
        let file = folder.join(format!("linear.{end}"));
        let finished = run(&["linearize", text(&path), "--save", text(&file)]);
        assert_eq!(finished.status, Some(0), "{}", finished.both());
        let content = std::fs::read(&file).expect("a file");
        assert!(content.starts_with(begin), "{end}");
    }
    let refused = run(&["linearize", text(&path), "--save", "linear.doc"]);
    assert_eq!(refused.status, Some(2));
    assert!(
        refused.both().contains(".npz (NumPy)"),
        "{}",
        refused.both()
    );
    let _ = std::fs::remove_dir_all(&folder);
    let few = run(&["linearize", text(&path), "--speeds", "phi'"]);
    assert!(few.both().contains("name 3 speeds"), "{}", few.both());
}

#[test]
fn slips_are_named() {
    let path = model("whipple-bicycle");
    let cases: [(&[&str], &str); 5] = [
        (&["--over", "v=5:1"], "is no range"),
        (&["--over", "speed=0:1"], "is no parameter of the model"),
        (&["--over", "v"], "is no range"),
        (
            &["--about", "sideways"],
            "names no steady motion `sideways`",
        ),
        (&["--about", "start"], "is not steady"),
    ];
    for (arguments, expected) in cases {
        let all = [&["stability", text(&path)], arguments].concat();
        let finished = run(&all);
        assert_eq!(finished.status, Some(2), "{arguments:?}");
        assert!(
            finished.both().contains(expected),
            "{arguments:?}: {}",
            finished.both()
        );
    }
}
