//! Events stated in a model: where they are found, by which method, what a run does at them, and what is said of mistakes.
#![allow(clippy::unwrap_used, reason = "test code fails where it stands")]

use chetaev::integrate::EventKind;
use chetaev::model::{load, NoFiles, Style};
use chetaev_tests::runs::{ended_text, Ask, Ended};
use chetaev_tests::{places, program};

fn study(text: &str) -> Ended {
    let ask = Ask {
        claims: vec!["motion.energy-drift"],
        ..Ask::default()
    };
    ended_text(text, &ask)
}

/// Events met: number, how the function passed zero, time.
fn met(ended: &Ended) -> Vec<(usize, EventKind, f64)> {
    let study = ended
        .study
        .as_ref()
        .unwrap_or_else(|| panic!("{}", ended.text));
    let events = &study.motion.as_ref().unwrap().evidence.run.events;
    events.iter().map(|e| (e.event, e.kind, e.t)).collect()
}

/// The pendulum of reference case pendulum-large-swing; its period is 2.38442745896814.
fn pendulum(method: &str, events: &str) -> String {
    format!(
        r#"
coordinates = ["theta"]
lagrangian = "theta'^2/2 + (981/80) cos(theta)"
[initial]
theta = 2
[simulation]
t_end = 10
{method}
{events}"#
    )
}

#[test]
fn the_period_of_a_pendulum_by_every_method() {
    let swing = "[events.swing]\nwhen = \"theta'\"\ndirection = \"falling\"\naction = \"stop\"";
    for method in [
        "method = \"taylor\"\ntolerance = 1e-15",
        "method = \"dop853\"\ntolerance = 1e-12",
        "method = \"tsit5\"\ntolerance = 1e-12",
    ] {
        let ended = study(&pendulum(method, swing));
        let found = met(&ended);
        assert_eq!(found.len(), 1, "{method}: {found:?}");
        assert!(
            (found[0].2 - 2.38442745896814).abs() < 1e-10,
            "{method}: {found:?}"
        );
        assert_eq!(found[0].1, EventKind::Down);
        // A run that ends where it was told to is no failure.
        assert_eq!(ended.exit, 0, "{}", ended.text);
        assert!(ended.text.contains("event `swing`"), "{}", ended.text);
        let run = &ended
            .study
            .as_ref()
            .unwrap()
            .motion
            .as_ref()
            .unwrap()
            .evidence
            .run;
        assert_eq!(run.t, found[0].2);
        assert!((run.row(run.len() - 1)[0] - 2.0).abs() < 1e-10);
    }
}

#[test]
fn recorded_events_do_not_change_the_motion() {
    let method = "method = \"taylor\"\ntolerance = 1e-15";
    let recorded =
        "[events.rest]\nwhen = \"theta'\"\n[events.up]\nwhen = \"theta\"\ndirection = \"rising\"";
    let (with, without) = (
        study(&pendulum(method, recorded)),
        study(&pendulum(method, "")),
    );
    let run = |ended: &Ended| {
        let motion = ended.study.as_ref().unwrap().motion.as_ref().unwrap();
        motion.evidence.run.rows.clone()
    };
    assert_eq!(run(&with), run(&without));
    let period = 2.38442745896814;
    let mut expected: Vec<(usize, f64)> =
        (1..9).map(|j| (0, 0.5 * f64::from(j) * period)).collect();
    expected.extend((0..4).map(|j| (1, (0.75 + f64::from(j)) * period)));
    expected.sort_by(|a, b| a.1.total_cmp(&b.1));
    let found = met(&with);
    assert_eq!(found.len(), expected.len(), "{found:?}");
    for (found, expected) in found.iter().zip(expected) {
        assert!(found.0 == expected.0 && (found.2 - expected.1).abs() < 1e-11);
    }
}

/// A throw, whose series is a polynomial: one long step with everything in it.
#[test]
fn what_happens_within_one_step_and_at_its_ends() {
    let ended = study(
        r#"
coordinates = ["z"]
parameters = { g = 10 }
lagrangian = "z'^2/2 - g z"
[initial]
"z'" = 10
[simulation]
t_end = 1.5
method = "taylor"
tolerance = 1e-15
output = { times = [0, "3/2"] }
[events.start]
when = "z"
[events.end]
when = "t - 3/2"
[events.top]
when = "z'"
[events.close]
when = "(t - 0.7) (t - 0.701)"
[events.touch]
when = "(t - 3/10)^2 (t + 1)"
[events.saddle]
when = "(t - 9/10)^3"
direction = "rising"
[events.unmet]
when = "z - 5.1"
"#,
    );
    let found = met(&ended);
    let expected = [
        (4, EventKind::Grazing, 0.3, 1e-7),
        (3, EventKind::Down, 0.7, 1e-14),
        (3, EventKind::Up, 0.701, 1e-14),
        (5, EventKind::Up, 0.9, 1e-14),
        (2, EventKind::Down, 1.0, 1e-15),
        (1, EventKind::Up, 1.5, 0.0),
    ];
    assert_eq!(found.len(), expected.len(), "{found:?}");
    for (found, (event, kind, t, accuracy)) in found.iter().zip(expected) {
        assert_eq!((found.0, found.1), (event, kind));
        assert!((found.2 - t).abs() <= accuracy, "{found:?}");
    }
    let run = &ended
        .study
        .as_ref()
        .unwrap()
        .motion
        .as_ref()
        .unwrap()
        .evidence
        .run;
    assert_eq!(run.statistics.steps, 1);
}

/// A bead slides off a circle where the reaction vanishes: from the top with speed v it leaves at the height
/// (v² + 2 g r)/(3 g).
#[test]
fn contact_is_lost_where_the_multiplier_vanishes() {
    for formulation in ["routh", "lagrange-dalembert"] {
        for method in ["taylor", "dop853"] {
            let text = format!(
                r#"
coordinates = ["x", "y"]
parameters = {{ g = 9.81 }}
lagrangian = "(x'^2 + y'^2)/2 - g y"
constraints = [{{ name = "circle", equation = "x^2 + y^2 = 1" }}]
[initial]
y = 1
"x'" = 0.4
[simulation]
t_end = 5
method = "{method}"
tolerance = 1e-13
[events.lost]
when = "lambda_circle"
action = "stop"
"#
            );
            let ask = Ask {
                claims: vec!["motion.energy-drift"],
                formulation: Some(formulation),
                ..Ask::default()
            };
            let ended = ended_text(&text, &ask);
            let found = met(&ended);
            assert_eq!(found.len(), 1, "{formulation} {method}: {}", ended.text);
            let study = ended.study.as_ref().unwrap();
            let run = &study.motion.as_ref().unwrap().evidence.run;
            let height = (0.16 + 2.0 * 9.81) / (3.0 * 9.81);
            let y = run.row(run.len() - 1)[1];
            assert!(
                (y - height).abs() < 1e-11,
                "{formulation} {method}: {y} {height}"
            );
        }
    }
}

#[test]
fn events_are_written_everywhere() {
    let folder = places::scratch("events");
    let events = "[events.rest]\nwhen = \"theta'\"\ndescription = \"at rest\"";
    let text = pendulum("method = \"taylor\"\ntolerance = 1e-14", events);
    std::fs::write(folder.join("model.toml"), text).unwrap();
    let arguments = [
        "study",
        "model.toml",
        "--claims",
        "motion.energy-drift",
        "--out",
        "out",
    ];
    let said = program::run_in(&folder, &arguments);
    let words = said.both();
    assert!(
        words.contains("event `rest`: rising at t = 1.192213729"),
        "{words}"
    );
    assert!(words.contains("8 in all"), "{words}");
    let record = std::fs::read_to_string(folder.join("out/study.json")).unwrap();
    let record: serde_json::Value = serde_json::from_str(&record).unwrap();
    let recorded = record["trajectory"]["events"].as_array().unwrap();
    assert_eq!(recorded.len(), 8);
    assert_eq!(recorded[0]["event"], "rest");
    assert_eq!(recorded[0]["zero"], "rising");
    let theta = recorded[0]["state"][0]["value"].as_f64().unwrap();
    assert!((theta + 2.0).abs() < 1e-12, "{theta}");
    let table = std::fs::read_to_string(folder.join("out/events.csv")).unwrap();
    let mut lines = table.lines();
    assert_eq!(lines.next(), Some("event,zero,t,theta,theta',theta''"));
    assert!(lines
        .next()
        .is_some_and(|line| line.starts_with("rest,rising,1.19221372")));
    assert_eq!(lines.count(), 7);
    let report = std::fs::read_to_string(folder.join("out/report.html")).unwrap();
    assert!(report.contains("rises through zero") && report.contains("<h3>Events</h3>"));
    let verified = program::run_in(&folder, &["verify", "out/study.json"]);
    assert!(
        !verified.both().contains("DISAGREES"),
        "{}",
        verified.both()
    );
    // An event that never happened is found missing.
    let changed = serde_json::to_string(&record)
        .unwrap()
        .replace("\"zero\":\"rising\"", "\"zero\":\"falling\"");
    std::fs::write(folder.join("changed.json"), changed).unwrap();
    let refused = program::run_in(&folder, &["verify", "changed.json"]);
    assert!(refused.both().contains("`events`"), "{}", refused.both());
}

#[test]
fn mistakes_are_shown_at_their_places() {
    for (events, place, words) in [
        ("[events.a]\ndirection = \"rising\"", "9:9", "needs `when`"),
        ("[events.a]\nwhen = \"thete\"", "10:9", "did you mean"),
        ("[events.a]\nwhen = \"theta'''\"", "10:9", "may not occur"),
        (
            "[events.a]\nwhen = \"lambda_rod\"",
            "10:8",
            "no constraint `rod`",
        ),
        (
            "[events.a]\nwhen = \"theta\"\ndirection = \"up\"",
            "11:13",
            "no value of `direction`",
        ),
        (
            "[events.a]\nwhen = \"theta\"\naction = \"stopp\"",
            "11:10",
            "did you mean \"stop\"",
        ),
        ("[events.a]\nwhen = \"2 - 2\"", "10:8", "never or always"),
        ("[events]\na = \"theta\"", "10:5", "a table with `when"),
        (
            "[events.a]\nif = \"theta\"\nwhen = \"theta\"",
            "10:1",
            "`if`",
        ),
    ] {
        let text = pendulum("tolerance = 1e-9", events);
        let refused = load("model.toml", &text, &NoFiles, &[]).into_result();
        let said = refused
            .err()
            .map(|d| d.render(Style::Plain))
            .unwrap_or_default();
        assert!(said.contains(words), "{events}: {said}");
        assert!(
            said.contains(&format!("model.toml:{place}")),
            "{events}: {said}"
        );
    }
}

#[test]
fn series_go_down_to_the_rounding_and_others_do_not() {
    let refused = |method: &str| {
        let text = pendulum(method, "");
        let refused = load("model.toml", &text, &NoFiles, &[]).into_result();
        refused
            .err()
            .map(|d| d.render(Style::Plain))
            .unwrap_or_default()
    };
    assert_eq!(refused("tolerance = 1e-15\nmethod = \"taylor\""), "");
    let said = refused("tolerance = 1e-15\nmethod = \"dop853\"");
    assert!(
        said.contains("out of range") && said.contains("taylor"),
        "{said}"
    );
    assert!(refused("tolerance = 1e-17\nmethod = \"taylor\"").contains("2.3e-16"));
}

/// A free particle is at x = t, and a step may be as long as the run: zeros between all places of a sampling are found, by the
/// series of the functions, at the times that are seen by hand; touches are called so. The sleigh's reaction vanishes where x' ω
/// does, and twice near a place at which it nearly does.
#[test]
fn zeros_close_together_are_not_missed() {
    let model = |method: &str, when: &str| {
        format!(
            r#"
coordinates = ["x", "y"]
lagrangian = "(x'^2 + y'^2)/2"
constraints = {{ straight = "y' = 0" }}
[initial]
"x'" = 1
[simulation]
t_end = 10
{method}
[events.narrow]
when = "{when}"
"#
        )
    };
    let near = |center: f64, apart: f64| vec![center - apart, center + apart];
    let every = |w: f64| (1..).map(move |k| f64::from(k) * std::f64::consts::PI / w);
    let cases: Vec<(&str, Vec<f64>, f64)> = vec![
        ("(x - 3.1234)^2 - 1e-6", near(3.1234, 1e-3), 1e-12),
        ("(x - 3.1234)^2 - 1e-10", near(3.1234, 1e-5), 1e-10),
        (
            "(x - 3)*(x - 3.001)*(x - 3.002)*(x^2 + 1)",
            vec![3.0, 3.001, 3.002],
            1e-11,
        ),
        (
            "1/(1 + 100*(x - 4)^2) - 0.9999",
            near(4.0, (1.0 / 0.9999 - 1.0_f64).sqrt() / 10.0),
            1e-10,
        ),
        (
            "sin(30*x)",
            every(30.0).take_while(|&t| t < 10.0).collect(),
            1e-12,
        ),
        ("(x - 3.1234)^2 + 1e-6", vec![], 0.0),
        ("x'' + lambda_straight + x - 7", vec![7.0], 1e-12),
    ];
    for method in ["taylor", "dop853"] {
        for (when, expected, close) in &cases {
            let text = model(&format!("method = \"{method}\""), when);
            let found = met(&study(&text));
            assert_eq!(found.len(), expected.len(), "{method} {when}: {found:?}");
            for ((_, kind, t), expected) in found.iter().zip(expected) {
                assert_ne!(*kind, EventKind::Grazing, "{method} {when}: {found:?}");
                assert!(
                    (t - expected).abs() < *close,
                    "{method} {when}: {t} {expected}"
                );
            }
        }
        let touch = met(&study(&model(
            &format!("method = \"{method}\""),
            "(x - 3.1234)^2",
        )));
        assert!(
            matches!(touch[..], [(0, EventKind::Grazing, t)] if (t - 3.1234).abs() < 1e-5),
            "{method}: {touch:?}"
        );
    }
}
