//! Motions with variable mass against closed forms, where they stop, and what a user is told.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    reason = "test code fails where it stands"
)]

use chetaev_tests::runs::{ended_text, Ask, Ended};

/// The last value of a column.
#[track_caller]
fn last(ended: &Ended, name: &str) -> f64 {
    let study = ended
        .study
        .as_ref()
        .unwrap_or_else(|| panic!("{}", ended.text));
    let motion = study.motion.as_ref().expect("a motion");
    let table = chetaev::study::table::Table::new(study, motion);
    let at = table.names.iter().position(|n| n == name);
    let at = at.unwrap_or_else(|| panic!("no {name} among {:?}", table.names));
    *table.columns[at].last().expect("rows")
}

#[track_caller]
fn near(found: f64, expected: f64, tolerance: f64) {
    assert!(
        (found - expected).abs() <= tolerance,
        "{found} is not {expected}"
    );
}

const ALL_FORMS: &[&str] = &[
    "routh",
    "maggi",
    "volterra-first-cartesian",
    "volterra-second",
    "nielsen",
    "gibbs-appell",
    "kane",
    "canonical",
    "state-space",
    "parametric",
    "lagrange-vector-field",
];

fn ask(formulation: &'static str) -> Ask {
    Ask {
        claims: vec!["motion"],
        formulation: Some(formulation),
        tolerance: Some(1e-12),
        ..Ask::default()
    }
}

/// E1 of T2: P1(1) = 3 − 5 + (20/√2) ln 2.
fn rocket(mass: &str, masses: &str) -> String {
    format!(
        r#"
coordinates = ["x", "y", "z"]
{masses}
[particles.rocket]
mass = "{mass}"
position = ["x", "y", "z"]
force = [0, 0, "-10 ({mass})"]
thrust = {{ exhaust_speed = 20 }}
[constraints]
cone = "z' = sqrt(x'^2 + y'^2)"
[initial]
"x'" = "9/5"
"y'" = "12/5"
[simulation]
t_end = 1
"#
    )
}

#[test]
fn the_speed_of_the_rocket_in_every_form() {
    let expected = 3.0 - 5.0 + 20.0 / 2f64.sqrt() * 2f64.ln();
    near(expected, 7.8025814, 1e-7);
    let own = "masses = { M = { rate = \"-1\", initial = 2 } }";
    for (mass, masses) in [("2 - t", ""), ("M", own)] {
        for formulation in ALL_FORMS {
            let ended = ended_text(&rocket(mass, masses), &ask(formulation));
            let speed = last(&ended, "x'").hypot(last(&ended, "y'"));
            near(speed, expected, 1e-9);
            near(last(&ended, "y'") / last(&ended, "x'"), 4.0 / 3.0, 1e-10);
            if !masses.is_empty() {
                near(last(&ended, "M"), 1.0, 1e-12);
            }
        }
        // λ = μ g/(1 + a²).
        let ended = ended_text(&rocket(mass, masses), &ask("routh"));
        near(last(&ended, "lambda_cone"), 5.0, 1e-9);
    }
}

/// (1a), (1b), (1c) and (1d) of T2 §1.
#[test]
fn closed_forms_of_the_point_law() {
    let line = |mass: &str, force: &str, thrust: &str, t_end: &str| {
        let text = format!(
            "coordinates = [\"x\"]\n[particles.p]\nmass = \"{mass}\"\nposition = [\"x\"]\nforce = [\"{force}\"]\nthrust = {thrust}\n\
             [initial]\n\"x'\" = 2\n[simulation]\nt_end = {t_end}\n"
        );
        last(&ended_text(&text, &ask("routh")), "x'")
    };
    let burning = "(5 exp(-t/3))";
    let upwards = line(
        burning,
        &format!("-10 {burning}"),
        "{ relative_velocity = [-7] }",
        "2",
    );
    near(upwards, 2.0 - 20.0 + 7.0 * 2.0 / 3.0, 1e-10);
    let picked_up = line(
        "3 + t/2",
        "-10 (3 + t/2)",
        "{ absolute_velocity = [0] }",
        "2",
    );
    near(
        picked_up,
        (3.0 * 2.0 - 10.0 * (3.0 * 2.0 + 1.0)) / 4.0,
        1e-10,
    );
    let isotropic = line(burning, &format!("-10 {burning}"), "\"isotropic\"", "2");
    near(isotropic, -18.0, 1e-10);
    // (μ0 + β v²/2 + c β v) v' = X with μ0 = 1, β = 3/10, c = 2, X = 1: the time by the speed is a cubic.
    let growing = line("1 + 3 x'^2/20", "1", "{ relative_velocity = [-2] }", "3");
    let time = |v: f64| v + v.powi(3) / 20.0 + 0.3 * v * v;
    near(time(growing) - time(2.0), 3.0, 1e-9);
}

/// A drop that sweeps up mist in proportion to its mass and speed, M' = k M v: v' = −g + k v² while it falls.
#[test]
fn a_law_that_depends_on_the_speed() {
    let text = r#"
coordinates = ["x"]
masses = { M = { rate = "M x'/2", initial = 3 } }
[particles.drop]
mass = "M"
position = ["x"]
force = ["9 M"]
thrust = { absolute_velocity = [0] }
[initial]
"x'" = 1
[simulation]
t_end = 1
"#;
    for formulation in [
        "routh",
        "maggi",
        "nielsen",
        "canonical",
        "parametric",
        "kane",
    ] {
        let ended = ended_text(text, &ask(formulation));
        // v' = 9 − v²/2, hence v = w tanh(w t/2 + atanh(1/w)) with w² = 18, and ln(M/3) = x/2.
        let w = 18f64.sqrt();
        near(
            last(&ended, "x'"),
            w * (w / 2.0 + (1.0 / w).atanh()).tanh(),
            1e-9,
        );
        near(
            last(&ended, "M"),
            3.0 * (last(&ended, "x") / 2.0).exp(),
            1e-9,
        );
    }
}

/// Masses that contain velocities have a matrix of inertia that is not symmetric: the motion by three forms, and a constraint.
#[test]
fn a_matrix_that_is_not_symmetric() {
    let text = r#"
coordinates = ["x", "y", "z"]
[particles.p]
mass = "2 + x'^2/3 + x y'"
position = ["x", "y", "z"]
force = [1, "-x", "y"]
thrust = { relative_velocity = ["-1/2", "y", "1/3"] }
[constraints]
rolling = "z' = y x'"
[initial]
x = 0.3
"x'" = 1
"y'" = 0.5
[simulation]
t_end = 1
"#;
    let of = |name| {
        let ended = ended_text(text, &ask(name));
        ["x", "y", "z", "x'", "y'", "lambda_rolling"].map(|column| last(&ended, column))
    };
    let routh = of("routh");
    for name in ["maggi", "lagrange-dalembert"] {
        for (a, b) in of(name).into_iter().zip(routh) {
            near(a, b, 1e-9);
        }
    }
    let refused = ended_text(text, &ask("canonical"));
    assert_eq!(refused.exit, 2);
    assert!(
        refused.text.contains("model.masses-free-of-velocity"),
        "{}",
        refused.text
    );
    assert!(
        refused.text.contains("the mass of `p` contains x'"),
        "{}",
        refused.text
    );
}

fn falling(mass: &str, masses: &str, thrust: &str, velocity: &str) -> String {
    format!(
        "coordinates = [\"x\"]\n{masses}\n[particles.p]\nmass = \"{mass}\"\nposition = [\"x\"]\nforce = [\"-{mass}\"]\nthrust = {thrust}\n\
         [initial]\n\"x'\" = {velocity}\n[simulation]\nt_end = 5\n"
    )
}

#[test]
fn a_mass_that_reaches_zero_stops_the_run() {
    let jet = "{ relative_velocity = [-1] }";
    let own = "masses = { M = { rate = \"-M^(1/3)\", initial = 1 } }";
    let cases = [
        ("(1 - t/2)", "", jet, "p"),
        ("(1 - t/2)", "", "\"isotropic\"", "p"),
        ("(1 - t/2)", "", "{ absolute_velocity = [2] }", "p"),
        // (M^(2/3))' = -2/3: zero at 3/2.
        ("M", own, jet, "M"),
    ];
    for (mass, masses, thrust, name) in cases {
        for formulation in ["routh", "maggi", "canonical"] {
            let ended = ended_text(&falling(mass, masses, thrust, "1"), &ask(formulation));
            let words = format!("the mass of `{name}` reaches zero at t = ");
            assert!(
                ended.text.contains(&words),
                "{mass} {thrust} {formulation}: {}",
                ended.text
            );
            assert_eq!(ended.exit, 3);
            let motion = ended.study.as_ref().unwrap().motion.as_ref().unwrap();
            let expected = if masses.is_empty() { 2.0 } else { 1.5 };
            near(motion.evidence.run.ending.t, expected, 1e-3);
        }
    }
}

#[test]
fn thrust_against_a_velocity_that_vanishes() {
    let thrust = "{ exhaust_speed = 1 }";
    // At rest there is no direction.
    let at_rest = ended_text(&falling("(9 - t)", "", thrust, "0"), &ask("routh"));
    assert_eq!(at_rest.exit, 2);
    assert!(
        at_rest.text.contains("the initial state is singular"),
        "{}",
        at_rest.text
    );
    // Thrown up against its jet it comes to rest.
    let thrown = ended_text(&falling("(9 - t)", "", thrust, "\"1/4\""), &ask("routh"));
    assert!(
        thrown.text.contains("the velocity of `p` vanishes at t = "),
        "{}",
        thrown.text
    );
    assert_eq!(thrown.exit, 3);
}

/// Bad models are told what is wrong, and with T stated what is meant must be clear.
#[test]
fn what_is_not_clear_is_refused() {
    let stated = |mass: &str, lagrangian: &str| {
        let text = format!(
            "coordinates = [\"x\"]\nmasses = {{ M = \"{mass}\" }}\nlagrangian = {lagrangian}\n"
        );
        ended_text(&text, &Ask::default())
    };
    let velocity = stated("1 + x'^2", "{ T = \"1/2 M x'^2\" }");
    assert!(
        velocity.text.contains("the mass `M` contains `x'`")
            && velocity.text.contains("[particles]"),
        "{}",
        velocity.text
    );
    let whole = stated("1 + x^2", "\"1/2 M x'^2\"");
    assert!(whole.text.contains("state T and V apart"), "{}", whole.text);
    assert_eq!((velocity.exit, whole.exit), (2, 2));
    let apart = stated("1 + x^2", "{ T = \"1/2 M x'^2\" }");
    assert_eq!(apart.exit, 0, "{}", apart.text);
    assert!(apart.text.contains("isotropically"), "{}", apart.text);
}

/// A mass that begins below zero is said, whichever way it is stated; one that begins above is not.
#[test]
fn a_negative_mass_at_the_start_is_said() {
    for (mass, masses, said) in [
        ("(t - 2)", "", "the mass of `p` = -2"),
        ("S", "masses = { S = \"x - 1/2\" }", "`S` = -0.5"),
    ] {
        let ended = ended_text(&falling(mass, masses, "\"isotropic\"", "1"), &ask("routh"));
        assert!(
            ended.text.contains("negative at the start") && ended.text.contains(said),
            "{mass}: {}",
            ended.text
        );
    }
    let positive = ended_text(&falling("(9 - t)", "", "\"isotropic\"", "1"), &ask("routh"));
    assert!(!positive.text.contains("negative"), "{}", positive.text);
}

/// A mass that is named and stands in a stated kinetic energy ends the run as that of a particle does, whatever the order of
/// the constraint and also where the constraint leaves the velocities an inertia.
#[test]
fn a_named_mass_that_reaches_zero_stops_the_run() {
    for constraint in ["", "f = \"x' = 2*y' + t\"", "f = \"x'' = 2*y'' + t\""] {
        let text = format!(
            "coordinates = [\"x\", \"y\"]\nmasses = {{ M = \"1 - t\" }}\n\
             lagrangian = {{ T = \"1/2 M x'^2 + 2 y'^2\", V = \"3 x\" }}\n[constraints]\n{constraint}\n\
             [initial]\n\"x'\" = 1\n[simulation]\nt_end = 1.3\n"
        );
        let ended = ended_text(&text, &ask("routh"));
        let words = "the mass of `M` reaches zero at t = 1:";
        assert!(ended.text.contains(words), "{constraint}: {}", ended.text);
        assert_eq!(ended.exit, 3);
    }
}
