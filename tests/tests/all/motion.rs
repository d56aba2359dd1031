//! Claims about computed motions, on systems made up for the ways in which they could go wrong.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    reason = "test code fails where it stands"
)]

use chetaev::model::{load, NoFiles};
use chetaev::study::{Hooks, StudyOptions};
use chetaev_tests::runs::{ended_text, Ask, Ended};

fn study(text: &str, claims: &[&'static str]) -> Ended {
    let ask = Ask {
        claims: claims.to_vec(),
        ..Ask::default()
    };
    ended_text(text, &ask)
}

/// The word and the sentence of a verdict.
fn verdict(ended: &Ended, claim: &str) -> (&'static str, String) {
    let verdict = ended.verdict(claim);
    (verdict.word(), verdict.detail().to_owned())
}

/// Coordinates, Lagrangian, and the rest of the file.
const ANALYTIC: [(&str, &str, &str); 22] = [
    ("x", "x'^2/2 + cos(x) + x sin(t)", "[initial]\nx = 1"),
    (
        "x, y, z",
        "(x'^2 + y'^2 + z'^2)/2 + x y' - y x' + t z'",
        "constraints = [\"z' = y x'\"]\n[initial]\ny = 1\n\"x'\" = 1",
    ),
    ("x", "x'^2/2 + cos(x)", "[initial]\nx = 1"),
    ("x", "x'^2/2 + cos(x)", "[initial]\nx = 3\n\"x'\" = 0.5"),
    (
        "x",
        "x'^2/2 - x^4/4 + x^2/2 + x cos(2 t)",
        "[initial]\nx = 0.5",
    ),
    (
        "x, y",
        "(x'^2 + y'^2)/2 + 1/sqrt(x^2 + y^2)",
        "[initial]\nx = 0.5\n\"y'\" = 1.7",
    ),
    (
        "x, y",
        "(x'^2 + y'^2)/2 - (x^2 + y^2)/2 - x^2 y + y^3/3",
        "[initial]\nx = 0.1\ny = 0.2\n\"x'\" = 0.3",
    ),
    (
        "x, y",
        "(x'^2 + y'^2)/2 + x y' - y x' - (x^2 + 2 y^2)/2",
        "[initial]\nx = 1\n\"y'\" = 1",
    ),
    (
        "x, y, z",
        "(x'^2 + y'^2 + z'^2)/2",
        "constraints = [\"z' = y x'\"]\n[initial]\ny = 1\n\"x'\" = 1\n\"y'\" = 1",
    ),
    (
        "x, y, p",
        "(x'^2 + y'^2 + p'^2)/2 + x",
        "constraints = [\"x' sin(p) = y' cos(p)\"]\n[initial]\n\"p'\" = 1.3",
    ),
    (
        "a, b",
        "a'^2 + b'^2/2 + a' b' cos(a - b) + 2 cos(a) + cos(b)",
        "[initial]\na = 2\nb = 1",
    ),
    ("x", "x'^2/2 - (1 - exp(-x))^2", "[initial]\nx = 1"),
    (
        "x, y, z",
        "(x'^2 + y'^2 + z'^2)/2 - z",
        "constraints = [\"z' = sqrt(x'^2 + y'^2)\"]\n[initial]\n\"x'\" = 1\n\"y'\" = 0.5",
    ),
    (
        "x, y",
        "(x'^2 + y'^2)/2 - y",
        "constraints = [\"x^2 + y^2 = 1\"]\n[initial]\nx = 1",
    ),
    (
        "a, b, c",
        "(a'^2 + b'^2 sin(a)^2)/2 + (c' + b' cos(a))^2/2 - cos(a)",
        "[initial]\na = 1\n\"b'\" = 0.3\n\"c'\" = 3",
    ),
    ("x", "x'^2/2 - x^2/2", "[initial]\nx = 1"),
    ("x", "x'^2/2 - x", "[initial]\n\"x'\" = 1"),
    (
        "x, y",
        "(x'^2 + y'^2)/2 - y",
        "constraints = [\"y' = x cos(t)\"]\n[initial]\nx = 1\n\"x'\" = 1",
    ),
    ("x", "-sqrt(1 - x'^2) - x^2/2", "[initial]\nx = 1"),
    ("x", "x'^2/2 - 50 x^2 + x sin(10 t)", "[initial]\nx = 1"),
    (
        "x",
        "x'^2/2 - x^2/2",
        "[initial]\nx = 2\n[forces]\nx = \"(1 - x^2) x'\"",
    ),
    (
        "x, y",
        "(x'^2 + y'^2)/2 (2 + sin(x)) - cos(x + y)",
        "[initial]\nx = 2\n\"y'\" = 1",
    ),
];

/// Motions that are polynomials of a degree which the methods integrate without error show no order.
const POLYNOMIAL: [usize; 2] = [12, 16];

fn file(coordinates: &str, lagrangian: &str, rest: &str) -> String {
    let names: Vec<String> = coordinates
        .split(", ")
        .map(|c| format!("\"{c}\""))
        .collect();
    format!(
        "coordinates = [{}]\nlagrangian = \"{lagrangian}\"\n{rest}\n",
        names.join(", ")
    )
}

/// The order of a Runge–Kutta method on analytic equations is its nominal one (Hairer, Nørsett, Wanner 1993, II.3).
#[test]
fn the_order_of_a_method_is_never_refuted_on_analytic_equations() {
    for method in ["dop853", "tsit5", "rk4"] {
        let step = if method == "rk4" { "step = 0.02\n" } else { "" };
        for (i, (coordinates, lagrangian, rest)) in ANALYTIC.iter().enumerate() {
            let text = file(coordinates, lagrangian, rest);
            let text = format!("{text}[simulation]\nmethod = \"{method}\"\n{step}");
            let (word, detail) = verdict(
                &study(&text, &["motion.method-order"]),
                "motion.method-order",
            );
            let allowed: &[&str] = match POLYNOMIAL.contains(&i) {
                true => &["undecided"],
                false => &["numerical"],
            };
            assert!(
                allowed.contains(&word),
                "{method}, {lagrangian}: {word}, {detail}"
            );
        }
    }
}

/// Across a corner of the force the error of a step is of order 3 at best, whatever the method, and the claim says where.
#[test]
fn a_corner_that_is_crossed_refutes_the_order() {
    let claim = "motion.method-order";
    let body = |force: &str| {
        let text = file("x", "x'^2/2 - x^2/2", "[initial]\nx = 1\n[forces]\n");
        format!("{text}x = \"{force}\"\n")
    };
    // x'' = -x - |x| from rest at 1 reaches 0 at t = pi/(2 sqrt(2)).
    let (word, detail) = verdict(&study(&body("-abs(x)"), &[claim]), claim);
    assert_eq!(word, "refuted", "{detail}");
    assert!(
        detail.contains("abs(x)") && detail.contains("t = 1.1107"),
        "{detail}"
    );
    // Where x > -9 that is x'' = -2 x, an oscillation between -1 and 1, which never comes to the corner.
    let (word, detail) = verdict(&study(&body("-abs(x + 9) + 9"), &[claim]), claim);
    assert_eq!(word, "numerical", "{detail}");
}

/// The velocity or coordinate at a row of the run.
fn value(ended: &Ended, row: usize, column: usize) -> f64 {
    let study = ended
        .study
        .as_ref()
        .unwrap_or_else(|| panic!("{}", ended.text));
    study.motion.as_ref().unwrap().evidence.run.row(row)[column]
}

/// What does not occur in the constraints starts from 0; of x y = 1 the points nearest to the origin are (1, 1) and (-1, -1).
#[test]
fn completing_the_start_changes_least() {
    let claims = &["model.initial-state-admissible"];
    let cubes = "coordinates = [\"x\", \"y\", \"z\"]\nlagrangian = \"(x'^2 + y'^2 + z'^2)/2\"\n\
        constraints = [\"x'^3 = y'^3\"]\n[initial]\n\"x'\" = 1\n";
    let claims_of_motion = &["motion.constraint-drift", claims[0]];
    let ended = study(cubes, claims_of_motion);
    let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-9, "{a} {b}");
    close(value(&ended, 0, 3), 1.0);
    close(value(&ended, 0, 4), 1.0);
    assert_eq!(value(&ended, 0, 5), 0.0);
    let hyperbola = "coordinates = [\"x\", \"y\", \"z\", \"w\"]\nlagrangian = \"(x'^2 + y'^2 + z'^2 + w'^2)/2\"\n\
        constraints = [\"x y = 1\"]\n";
    let ended = study(hyperbola, claims_of_motion);
    close(value(&ended, 0, 0).abs(), 1.0);
    close(value(&ended, 0, 0) - value(&ended, 0, 1), 0.0);
    assert_eq!((value(&ended, 0, 2), value(&ended, 0, 3)), (0.0, 0.0));
}

/// With |v| = const and the heading z of the velocity, the angle atan2 ends at z = pi; z starts at 0 with z' = 1. There
/// is no force along z but that of the constraint, whose reaction is across the velocity.
#[test]
fn a_motion_stops_where_the_branch_of_an_angle_ends() {
    for formulation in ["routh", "maggi"] {
        let text = "coordinates = [\"x\", \"y\", \"z\"]\nlagrangian = \"(x'^2 + y'^2 + z'^2)/2\"\n\
            constraints = [\"atan2(y', x') = z\"]\n[initial]\n\"x'\" = 1\n\"z'\" = 1\n";
        let model = load("motion.toml", text, &NoFiles, &[])
            .into_result()
            .unwrap()
            .0;
        let options = StudyOptions {
            formulation: Some(formulation.into()),
            ..StudyOptions::default()
        };
        let mut hooks = Hooks {
            clock: &|| 0.0,
            interrupt: None,
            progress: &mut |_, _| {},
        };
        let found = chetaev::study::study(model, options, &mut hooks).unwrap();
        let run = &found.motion.as_ref().unwrap().evidence.run;
        assert!(
            run.ending.reason.contains("left the constraint"),
            "{:?}",
            run.ending
        );
        let last = run.row(run.len() - 1);
        assert!(
            (last[2] - std::f64::consts::PI).abs() < 1e-6,
            "{formulation} {last:?}"
        );
        for claim in ["motion.constraint-drift", "motion.energy-drift"] {
            let decided = found
                .verdicts
                .iter()
                .find(|d| d.full_id() == claim)
                .unwrap();
            assert_eq!(
                decided.finding.verdict.word(),
                "numerical",
                "{formulation} {claim}"
            );
        }
    }
}

/// The inertia e^x' + 2 x^2 along y' = x x' vanishes where x = 0 and x' grows without bound, since the energy keeps x x'
/// finite; the constraint can be solved for y' everywhere.
#[test]
fn a_vanishing_inertia_is_not_blamed_on_the_constraints() {
    let text = "coordinates = [\"x\", \"y\"]\nlagrangian = \"exp(x') + y'^2 - y\"\n\
        constraints = [\"y' = x x'\"]\n[initial]\nx = 1\n\"x'\" = 1\n";
    let ended = study(text, &["motion.energy-drift"]);
    assert_eq!(ended.exit, 3, "{}", ended.text);
    assert!(
        !ended.text.contains("cannot be solved from the constraints"),
        "{}",
        ended.text
    );
    assert!(
        ended.text.contains("x'") || ended.text.contains("mass matrix"),
        "{}",
        ended.text
    );
}

/// A residual of the size of what it measures is no constraint kept, whatever the tolerance.
#[test]
fn a_loose_tolerance_does_not_excuse_a_large_drift() {
    let text = "coordinates = [\"x\", \"y\"]\nlagrangian = \"x'^2/2 + y'^2/2 - y\"\nconstraints = [\"x^2 + y^2 = 1\"]\n\
        [initial]\nx = 1\n[simulation]\ntolerance = 0.1\nt_end = 500\n";
    let ended = study(text, &["motion.constraint-drift", "motion.energy-drift"]);
    let evidence = &ended
        .study
        .as_ref()
        .unwrap()
        .motion
        .as_ref()
        .unwrap()
        .evidence;
    // The radius is 1; the run is bad enough for the test to say something.
    let drift = evidence.run.drift.as_ref().unwrap().largest();
    assert!(drift > 0.1, "{drift}");
    assert_eq!(verdict(&ended, "motion.constraint-drift").0, "refuted");
}

/// On the branch y' = t the energy t^2/2 + 1/2 grows; it is an integral on y' = 1 only.
#[test]
fn nothing_is_to_be_kept_off_the_branch_where_the_energy_is_an_integral() {
    let file = |start: &str| {
        format!(
            "coordinates = [\"x\", \"y\"]\nlagrangian = \"(x'^2 + y'^2)/2\"\n\
            constraints = [\"(y' - 1)(y' - t) = 0\"]\n[initial]\n\"x'\" = -1\n\"y'\" = {start}\n[simulation]\nt_end = 0.9\n"
        )
    };
    let claims = &["energy.integral", "motion.energy-drift"];
    let (word, detail) = verdict(&study(&file("0"), claims), "motion.energy-drift");
    assert_eq!(word, "not-applicable", "{detail}");
    let (word, detail) = verdict(&study(&file("1"), claims), "motion.energy-drift");
    assert_eq!(word, "numerical", "{detail}");
}

/// A run that is cut short keeps the state it has reached, and drifts are those of all steps, however sparse the rows.
#[test]
fn an_early_end_keeps_the_last_state() {
    // x'' = x^2 grows without bound in a time of the order of 1 from x = 6, x' = 12: x = 6/(1 - t)^2 solves it.
    let text =
        "coordinates = [\"x\"]\nlagrangian = \"x'^2/2 + x^3/3\"\n[initial]\nx = 6\n\"x'\" = 12\n\
        [simulation]\nt_end = 1000\n";
    let ended = study(text, &["motion.energy-drift"]);
    assert_eq!(ended.exit, 3, "{}", ended.text);
    let study = ended.study.as_ref().unwrap();
    let evidence = &study.motion.as_ref().unwrap().evidence;
    let run = &evidence.run;
    assert_eq!(run.times.len(), 2);
    assert!(
        run.times[1] > 0.99 && run.times[1] < 1.0 + 1e-6,
        "{:?}",
        run.times
    );
    // The energy is 0, so that x'^2/2 = x^3/3; the state itself is ill-conditioned so near to the singularity.
    let (x, v) = (run.row(1)[0], run.row(1)[1]);
    assert!(x > 1e6, "{x}");
    assert!(
        (v / (x.powi(3) * 2.0 / 3.0).sqrt() - 1.0).abs() < 1e-6,
        "{x} {v}"
    );
}

/// A pendulum at a loose tolerance, with rows at the ends alone: its energy is 1 at first, and the drift is seen where it
/// is largest, not only where it is written down.
#[test]
fn drifts_are_measured_between_the_rows() {
    let text = "coordinates = [\"x\"]\nlagrangian = \"x'^2/2 + cos(x)\"\n[initial]\nx = 3\n\
        [simulation]\nt_end = 50\ntolerance = 1e-4\noutput = { points = POINTS }\n";
    let drift = |points: &str| {
        let ended = study(&text.replace("POINTS", points), &["motion.energy-drift"]);
        let study = ended.study.as_ref().unwrap();
        study.motion.as_ref().unwrap().evidence.energy.drift
    };
    let (sparse, dense) = (drift("1"), drift("2000"));
    assert!(sparse.value > 0.0 && dense.value > 0.0);
    // The rows between the steps add the error of the interpolation, which is of the size of that of the steps.
    assert!(sparse.value > dense.value / 30.0, "{sparse:?} {dense:?}");
    assert!(sparse.t > 0.0);
}

/// Rates keep the values of the constraints where nothing brings a motion back to them: what rounding leaves of these does not grow.
/// In a chain of links on blades rates that are right at admissible states alone would let it grow by orders of magnitude.
#[test]
fn without_projection_violations_do_not_grow() {
    let chain = |simulation: &str| {
        format!(
            r#"
coordinates = ["x", "y", "th_1", "th_2", "th_3", "th_4"]
[define]
x_2 = "x - 3 cos(th_1)/20 - cos(th_2)/4"
y_2 = "y - 3 sin(th_1)/20 - sin(th_2)/4"
x_3 = "x_2 - 3 cos(th_2)/20 - cos(th_3)/4"
y_3 = "y_2 - 3 sin(th_2)/20 - sin(th_3)/4"
x_4 = "x_3 - 3 cos(th_3)/20 - cos(th_4)/4"
y_4 = "y_3 - 3 sin(th_3)/20 - sin(th_4)/4"
[lagrangian]
T = "1/4 (x'^2 + y'^2 + x_2'^2 + y_2'^2 + x_3'^2 + y_3'^2 + x_4'^2 + y_4'^2) + 1/200 (th_1'^2 + th_2'^2 + th_3'^2 + th_4'^2)"
V = "3/20 ((th_1 - th_2)^2 + (th_2 - th_3)^2 + (th_3 - th_4)^2)"
[constraints]
b_1 = "x' sin(th_1) = y' cos(th_1)"
b_2 = "x_2' sin(th_2) = y_2' cos(th_2)"
b_3 = "x_3' sin(th_3) = y_3' cos(th_3)"
b_4 = "x_4' sin(th_4) = y_4' cos(th_4)"
[velocities]
independent = ["x'", "th_1'"]
[initial]
"x'" = 0.9
"th_1'" = 0.3
th_1 = 0.13
th_2 = 0.2
th_3 = 0.17
th_4 = 0.07
[simulation]
t_end = 20
{simulation}
"#
        )
    };
    let mut ends: Vec<Vec<f64>> = Vec::new();
    for simulation in [
        "method = \"taylor\"\ntolerance = 1e-15",
        "method = \"taylor\"\ntolerance = 1e-12\nproject = false",
        "method = \"dop853\"\ntolerance = 1e-13\nproject = false",
    ] {
        let ended = study(&chain(simulation), &["motion.constraint-drift"]);
        let motion = ended.study.as_ref().unwrap().motion.as_ref().unwrap();
        let run = &motion.evidence.run;
        assert_eq!(run.t, 20.0, "{simulation}: {}", ended.text);
        let drift = run.drift.as_ref().unwrap();
        let largest = drift.velocity.iter().fold(0.0_f64, |m, x| m.max(x.value));
        assert!(largest < 1e-11, "{simulation}: {largest}");
        ends.push(run.row(run.len() - 1)[..6].to_vec());
    }
    for other in &ends[1..] {
        for (a, b) in ends[0].iter().zip(other) {
            assert!((a - b).abs() < 1e-9, "{ends:?}");
        }
    }
}
