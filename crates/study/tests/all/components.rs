//! Motions of constraints that are products: as those of the factor on which they start, in studies, sweeps and their derivatives.
#![allow(clippy::unwrap_used)] // a panic is how a test fails

use chetaev_model::{load, Model, NoFiles};
use chetaev_orbits::variational::Order;
use chetaev_study::sensitivity::sensitivity;
use chetaev_study::{study, ClaimSelection, Hooks, Study, StudyOptions};
use chetaev_symbolic::Verdict;

fn model(constraint: &str, more: &str) -> Model {
    let text = format!(
        "name = \"bead\"\ncoordinates = [\"x\", \"y\"]\nlagrangian = \"1/2 (x'^2 + y'^2) - y\"\n[constraints]\na = \"{constraint} = 0\"\n\
         [initial]\n{more}"
    );
    load("model.toml", &text, &NoFiles, &[])
        .into_result()
        .unwrap()
        .0
}

fn studied(model: Model) -> Study {
    let options = StudyOptions {
        claims: ClaimSelection {
            words: vec!["motion".into()],
        },
        ..StudyOptions::default()
    };
    let mut hooks = Hooks {
        clock: &|| 0.0,
        interrupt: None,
        progress: &mut |_, _| (),
    };
    study(model, options, &mut hooks).unwrap()
}

const ON_PARABOLA: &str =
    "x = \"1/3\"\ny = \"1/9\"\n\"x'\" = -3\n[simulation]\nt_end = 3\noutput = 30\n";

/// A bead on a parabola that a line crosses moves as on the parabola alone, and so do motions next to it.
#[test]
fn a_motion_and_its_derivatives_are_those_of_the_factor() {
    let product = model("(y - x^2)*(y + x)", ON_PARABOLA);
    let alone = model("y - x^2", ON_PARABOLA);
    let times: Vec<f64> = (0..=30).map(|k| f64::from(k) / 10.0).collect();
    let [own, expected] = [&product, &alone].map(|model| {
        sensitivity(model, "x'", Order::Second, &times, &StudyOptions::default()).unwrap()
    });
    assert_eq!(own.columns(), expected.columns());
    for ((_, row), (t, wanted)) in own.rows.iter().zip(&expected.rows) {
        for (x, y) in row.iter().zip(wanted) {
            assert!((x - y).abs() <= 1e-7 * (1.0 + y.abs()), "{t}: {x} {y}");
        }
    }
    let [own, expected] = [product, alone].map(studied);
    let [own, expected] =
        [&own, &expected].map(|study| &study.motion.as_ref().unwrap().evidence.run);
    assert_eq!(own.times, expected.times);
    // The parabola y = x² and the line y = -x meet at x = 0 and at x = -1.
    assert!(own.crossings.len() >= 2, "{:?}", own.crossings);
    let places = own.layout.positions().chain(own.layout.v());
    for j in 0..own.len() {
        for i in places.clone() {
            let (x, y) = (own.row(j)[i], expected.row(j)[i]);
            assert!((x - y).abs() < 1e-8, "{}: {x} {y}", own.times[j]);
        }
    }
}

/// Along the component on which a motion goes on the constraint as stated is measured, and nothing is refuted.
#[test]
fn what_is_measured_is_the_constraint_where_the_motion_changes_its_component() {
    let thrown = |crossings: &str| {
        let more = format!("\"x'\" = 1\n\"y'\" = 1\n[simulation]\nt_end = 4\n{crossings}\n");
        studied(model("(y' - x')*(y' + x')", &more))
    };
    let ended = thrown("");
    assert!(!ended.motion.as_ref().unwrap().evidence.run.ending.finished);
    let study = thrown("crossings = [\"y' = -x'\", \"y' = x'\"]");
    let motion = study.motion.as_ref().unwrap();
    assert!(motion.evidence.run.ending.finished);
    let refuted = study.verdicts.iter();
    let refuted: Vec<String> = refuted
        .filter(|d| matches!(d.finding.verdict, Verdict::Refuted(_)))
        .map(|d| d.full_id())
        .collect();
    assert!(refuted.is_empty(), "{refuted:?}");
    let said = |words: &str| study.notices.iter().any(|notice| notice.contains(words));
    assert!(said("goes on along y' = -x'"), "{:?}", study.notices);
    assert!(
        said("`y' = x'` of `crossings` was not needed"),
        "{:?}",
        study.notices
    );
    assert!(thrown("crossings = [\"y = 0\"]")
        .motion
        .unwrap()
        .evidence
        .run
        .ending
        .reason
        .contains("none of the two"));
}

/// Of the factors z' − x' and z' − y x' a start chooses by itself, at speeds of a walk and of atoms alike.
#[test]
fn the_component_of_a_start_at_any_speed() {
    for speed in ["1", "1e-10", "1e-25", "1e12"] {
        let text = format!(
            "name = \"two components\"\ncoordinates = [\"x\", \"y\", \"z\"]\nlagrangian = \"1/2 (x'^2 + y'^2 + z'^2)\"\n[constraints]\n\
             c = \"(z' - x') (z' - y x') = 0\"\n[initial]\ny = 2\n\"x'\" = {speed}\n\"z'\" = \"2*{speed}\"\n\"y'\" = {speed}\n\
             [simulation]\nt_end = \"1/{speed}\"\n"
        );
        let loaded = load("model.toml", &text, &NoFiles, &[]).into_result();
        let model = loaded.unwrap().0;
        let options = StudyOptions {
            claims: ClaimSelection {
                words: vec!["witness.stationary".into()],
            },
            ..StudyOptions::default()
        };
        let mut hooks = Hooks {
            clock: &|| 0.0,
            interrupt: None,
            progress: &mut |_, _| (),
        };
        let study = study(model, options, &mut hooks).unwrap();
        let own = study
            .verdicts
            .iter()
            .find(|own| own.claim == "witness.stationary");
        let detail = own.unwrap().finding.verdict.detail();
        assert!(
            detail.starts_with("on the component y x' - z' = 0"),
            "{speed}: {detail}"
        );
    }
}
