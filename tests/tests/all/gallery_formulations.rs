//! The systems of the gallery that were chosen for the formulations move as the published cases, closed forms and other
//! statements of the same systems say.
#![allow(
    clippy::expect_used,
    clippy::unwrap_used,
    reason = "test code fails where it stands"
)]

use chetaev::study::Study;
use chetaev_tests::cases::{Case, Check, Event, Expected, Published, Sample, Scalar};
use chetaev_tests::runs::{again, along, ended, ended_text, Ask};
use chetaev_tests::studied::{gallery_path, loaded};
use chetaev_tests::words::{in_parallel, none};

/// A name of a case and the expression that stands for it in the gallery.
type Renamed = (&'static str, &'static str);

/// Published cases, the file of the gallery that states the same system, and what an expression of the case is called there.
const CASES: &[(&str, &str, &[Renamed])] = &[
    (
        "rattleback-kane-levinson",
        "rattleback/model.toml",
        &[("vG", "vz")],
    ),
    ("chaplygin-ball", "chaplygin-sphere/model.toml", &[]),
    ("suslov", "suslov/model.toml", &[]),
    ("euler-poinsot", "rigid-body/model.toml", &[]),
    (
        "whipple-bicycle-nonlinear",
        "whipple-bicycle/general.toml",
        &[("T", "(TR + TB + TH + TF)"), ("V", "(g height)")],
    ),
    ("isokinetic-gravity", "isokinetic-particle/model.toml", &[]),
    (
        "ball-in-vertical-cylinder",
        "ball-in-cylinder/model.toml",
        &[],
    ),
    (
        "pendulum-as-position-constraint",
        "pendulum-particle/cartesian.toml",
        &[],
    ),
    ("double-pendulum", "pendulum-particle/model.toml", &[]),
];

/// Checks of those cases that need what no run gives: a linearization.
const NEEDS_LINEARIZATION: usize = 4;

/// A file of the gallery with parameters changed, moved to `t_end` at a tolerance below all those of the tests.
fn moved(file: &str, overrides: &[(&str, &str)], t_end: Option<f64>) -> Study {
    let ask = Ask {
        claims: vec!["motion.constraint-drift"],
        t_end,
        tolerance: Some(1e-12),
        ..Ask::default()
    };
    let ended = ended(loaded(&gallery_path(file), overrides), &ask);
    let study = ended
        .study
        .unwrap_or_else(|| panic!("{file}: {}", ended.text));
    assert!(study.motion.is_some(), "{file} does not move");
    study
}

/// The largest absolute value along the run of a study; infinite where there is none.
fn largest(study: &Study, expression: &str) -> f64 {
    let run = &study.motion.as_ref().unwrap().evidence.run;
    let values = along(study, run, expression).unwrap_or_else(|e| panic!("{e}"));
    assert!(values.len() > 100, "a whole run");
    values.into_iter().fold(0.0, |m: f64, x| {
        if x.is_nan() {
            f64::INFINITY
        } else {
            m.max(x.abs())
        }
    })
}

/// Values of an expression at increasing times.
fn at(study: &Study, times: &[f64], expression: &str) -> Vec<f64> {
    let first = usize::from(times[0] > 0.0);
    let mut all = vec![0.0; first];
    all.extend(times);
    if all.len() == 1 {
        all.push(0.01);
    }
    let run = again(study, all).expect("the motion again");
    let values = along(study, &run, expression).unwrap_or_else(|e| panic!("{e}"));
    values[first..first + times.len()].to_vec()
}

fn same(left: &str, right: &str) -> String {
    format!("({left}) - ({right})")
}

#[test]
fn the_gallery_moves_as_the_published_cases() {
    let published = Published::read();
    let found = in_parallel(CASES, |&(id, file, names)| {
        let case = published.cases.iter().find(|c| c.statement.id == id);
        differences(case.expect("the case is published"), file, names)
    });
    let (failures, left): (Vec<_>, Vec<_>) = found.into_iter().unzip();
    none(failures.concat());
    assert_eq!(left.iter().sum::<usize>(), NEEDS_LINEARIZATION);
}

/// What differs from a published case, and the number of its checks that were left out.
fn differences(case: &Case, file: &str, names: &[(&str, &str)]) -> (Vec<String>, usize) {
    let end = case.statement.t_end.parse().expect("a number");
    let study = moved(file, &[], Some(end));
    let mut left = 0;
    let mut failures = Vec::new();
    for check in &case.checks {
        if check.needs.iter().any(|need| need == "linearization") {
            left += 1;
        } else if let Err(found) = compare(&study, check, names) {
            failures.push(format!("{file}: {}: {found}", check.title));
        }
    }
    (failures, left)
}

fn compare(study: &Study, check: &Check, names: &[(&str, &str)]) -> Result<(), String> {
    let close = |difference: f64| match difference.abs() <= check.tol_abs {
        true => Ok(()),
        false => Err(format!("off by {difference:e}")),
    };
    let named = |expr: &str| renamed(expr, names);
    match &check.expected {
        Expected::ClosedForm {
            expr,
            at: rows,
            formula,
        } => {
            if let Some(formula) = formula {
                close(largest(study, &same(&named(expr), formula)))?;
            }
            close(worst(study, &named(expr), rows))
        }
        Expected::Value { expr, at: rows, .. } => close(worst(study, &named(expr), rows)),
        Expected::Invariant { expr, value, .. } => {
            close(largest(study, &same(&named(expr), value)))
        }
        Expected::Identity { expr } => close(largest(study, &named(expr))),
        Expected::Scalar(Scalar::EventTime { event, expected }) => crosses(
            study,
            event,
            expected.parse().expect("a number"),
            check.tol_abs,
        ),
        other => Err(format!("not compared: {other:?}")),
    }
}

/// The expression with names of the gallery for those of the case.
fn renamed(expr: &str, names: &[(&str, &str)]) -> String {
    let mut text = expr.to_owned();
    for (name, here) in names {
        let whole = name.len() == 1;
        text = match whole {
            true => replaced_letter(&text, name, here),
            false => text.replace(name, here),
        };
    }
    text
}

/// Replaces a name of one letter where it is not part of a longer name.
fn replaced_letter(text: &str, letter: &str, here: &str) -> String {
    let part = |c: Option<char>| c.is_some_and(|c| c.is_alphanumeric() || c == '_');
    let mut result = String::new();
    let mut before = None;
    let mut rest = text.chars().peekable();
    while let Some(c) = rest.next() {
        if letter.starts_with(c) && !part(before) && !part(rest.peek().copied()) {
            result.push_str(here);
        } else {
            result.push(c);
        }
        before = Some(c);
    }
    result
}

fn worst(study: &Study, expr: &str, rows: &[Sample]) -> f64 {
    let number = |text: &String| text.parse::<f64>().expect("a number");
    let times: Vec<f64> = rows.iter().map(|(t, _)| number(t)).collect();
    let values = at(study, &times, expr);
    let differences = values
        .iter()
        .zip(rows)
        .map(|(v, (_, x))| (v - number(x)).abs());
    differences.fold(0.0, |m: f64, d| if d.is_nan() { d } else { m.max(d) })
}

/// The expression rises through zero within `tolerance` of the time, and not before.
fn crosses(study: &Study, event: &Event, time: f64, tolerance: f64) -> Result<(), String> {
    assert_eq!((event.direction.as_str(), event.occurrence), ("up", 1));
    let mut times: Vec<f64> = (1..200).map(|i| time * f64::from(i) / 200.0).collect();
    times.extend([time - tolerance, time + tolerance]);
    let values = at(study, &times, &event.expr);
    let rises = |pair: &[f64]| pair[0] < 0.0 && pair[1] >= 0.0;
    let first = values.windows(2).position(rises);
    match first == Some(values.len() - 2) {
        true => Ok(()),
        false => Err(format!("rises at row {first:?} of {}", values.len())),
    }
}

/// Meijaard and others 2007, tables 1 and 2: M q'' + v C1 q' + (g K0 + v² K2) q = 0 for small q = (lean, steer).
#[test]
fn the_upright_bicycle_obeys_the_published_linear_equations() {
    let lean = "80.81722 phi'' + 2.3194133220870913477 delta'' + 33.866413914924943883 v delta' \
                - 794.1195 phi + (76.597345895732221519 v^2 - 25.501260323012407956) delta";
    let steer = "2.3194133220870913477 phi'' + 0.29784188199685552999 delta'' - 0.85035641456978437036 v phi' \
                 + 1.6854039739755967411 v delta' - 25.501260323012407956 phi \
                 + (2.6543152379460402523 v^2 - 7.8803228177903952008) delta";
    for v in ["3", "4.6", "7"] {
        let file = "whipple-bicycle/model.toml";
        let study = moved(file, &[("v", v), ("kick", "1/10000")], Some(1.0));
        // The model is symmetric, so the next terms are cubic in the disturbance.
        for (equation, stiffness) in [(lean, "794 phi"), (steer, "25.5 phi")] {
            let (rest, size) = (largest(&study, equation), largest(&study, stiffness));
            assert!(
                rest < 1e-6 * size && size > 1e-4,
                "v = {v}: {rest:e} of {size:e}"
            );
        }
    }
}

/// Landau and Lifshitz 1975, sec. 22.
#[test]
fn a_charged_particle_circles_and_drifts() {
    let file = "charged-particle/model.toml";
    let study = moved(file, &[], None);
    let x = "(vx sin(wc t) + (vy + vd) (1 - cos(wc t)))/wc";
    let y = "((vy + vd) sin(wc t) - vx (1 - cos(wc t)))/wc - vd t";
    for (coordinate, formula) in [("x", x), ("y", y), ("z", "vz t")] {
        let worst = largest(&study, &same(coordinate, formula));
        assert!(worst < 1e-10, "{coordinate}: {worst:e}");
    }
    let study = moved(file, &[("E", "0")], None);
    let circle = "(x - vy/wc)^2 + (y + vx/wc)^2 - (vx^2 + vy^2)/wc^2";
    assert!(largest(&study, circle) < 1e-10);
    assert!(largest(&study, "x") > 0.1);
}

/// m x'' = q B y' - λ h y, m y'' = -q B x', m z'' = λ, and z' = h y x'.
#[test]
fn a_charged_particle_under_a_constraint_gains_along_it_what_its_place_says() {
    let study = moved("charged-particle/constrained.toml", &[], None);
    let gained = "m x' sqrt(1 + h^2 y^2) - m vx sqrt(1 + h^2 y0^2)";
    let driven = same(gained, "q B (asinh(h y) - asinh(h y0))/h");
    assert!(largest(&study, gained) > 0.1);
    for law in [
        driven.as_str(),
        "m y'' + q B x'",
        "m z'' - lambda_rolling",
        "z' - h y x'",
    ] {
        let worst = largest(&study, law);
        assert!(worst < 1e-9, "{law}: {worst:e}");
    }
}

/// The momentum along the constraint is constant, that along the force grows uniformly, and the energy gives y.
#[test]
fn a_relativistic_particle_moves_on_its_hyperbola() {
    let file = "relativistic-particle/model.toml";
    let study = moved(file, &[], None);
    let square = |p: &str| format!("sqrt(m^2 c^4 + c^2 (P^2 + ({p})^2))");
    let y = format!("y0 + ({} - {})/F", square("p0 + F t"), square("p0"));
    let forms = [
        same("y", &y),
        "gam m x' sqrt(1 + y^2) - P".to_owned(),
        "gam m y' - p0 - F t".to_owned(),
        "z' - y x'".to_owned(),
    ];
    for form in forms {
        let worst = largest(&study, &form);
        assert!(worst < 1e-8, "{form}: {worst:e}");
    }
    // With the velocity of light far away the particle is Newton's, whom these initial data would carry past c = 1.
    let slow = moved(file, &[("c", "1000")], None);
    let falling = same("y", "y0 + uy t + F t^2/(2 m)");
    assert!(largest(&slow, &falling) < 1e-4);
    assert!(largest(&study, &falling) > 1.0);
}

/// In the frame of the platform: p' = u + w q, q' = -w p, u' = Om² p.
#[test]
fn the_skate_on_the_platform_oscillates_along_its_blade() {
    let study = moved("moving-frame/model.toml", &[], None);
    let forms = [
        same("psi", "w t"),
        same("ahead", "x0 cos(nu t) + u0/nu sin(nu t)"),
        same("u", "u0 + Om^2 (x0 sin(nu t) + u0/nu (1 - cos(nu t)))/nu"),
        "s".to_owned(),
        same("r", "w"),
    ];
    for form in forms {
        let worst = largest(&study, &form);
        assert!(worst < 1e-8, "{form}: {worst:e}");
    }
}

/// The same skate in coordinates of the platform: the frame is in the Lagrangian, and no frame of fields is stated.
const ON_THE_PLATFORM: &str = r#"
coordinates = ["X", "Y", "psi"]
parameters = { m = 1.2, J = 0.05, Om = 1 }
[lagrangian]
L = "1/2 m ((X' - Om Y)^2 + (Y' + Om X)^2) + 1/2 J (psi' + Om)^2"
[constraints]
blade = "Y' cos(psi) = X' sin(psi)"
[initial]
X = 0.8
Y = 0
psi = 0
"X'" = 0.5
"Y'" = 0
"psi'" = 1.6
[simulation]
t_end = 20
tolerance = 1e-12
"#;

#[test]
fn the_skate_moves_in_the_moving_frame_as_in_coordinates_of_the_platform() {
    let ask = Ask {
        claims: vec!["motion.constraint-drift"],
        ..Ask::default()
    };
    let platform = ended_text(ON_THE_PLATFORM, &ask);
    let platform = platform
        .study
        .unwrap_or_else(|| panic!("{}", platform.text));
    let space = moved("moving-frame/model.toml", &[], None);
    let times = [1.0, 5.0, 12.0, 20.0];
    let pairs = [
        ("X cos(Om t) - Y sin(Om t)", "x"),
        ("X sin(Om t) + Y cos(Om t)", "y"),
        ("X' cos(psi) + Y' sin(psi)", "u"),
        ("lambda_blade", "lambda_blade"),
    ];
    for (there, here) in pairs {
        for (a, b) in at(&platform, &times, there)
            .into_iter()
            .zip(at(&space, &times, here))
        {
            assert!(
                (a - b).abs() < 1e-8,
                "{here}: {a} on the platform, {b} in space"
            );
        }
    }
}

#[test]
fn a_pendulum_of_particles_moves_as_the_one_of_energies() {
    let particles = moved("pendulum-particle/model.toml", &[], None);
    let energies = moved("double-pendulum/model.toml", &[], None);
    let times = [0.5, 3.0, 7.0, 10.0];
    for expression in ["a", "b", "a'", "b'", "a''"] {
        let (left, right) = (
            at(&particles, &times, expression),
            at(&energies, &times, expression),
        );
        for (a, b) in left.into_iter().zip(right) {
            assert!((a - b).abs() < 1e-8, "{expression}: {a} and {b}");
        }
    }
}

/// Landau and Lifshitz 1976, sec. 37: from its largest value w2 = b sn(la t + K, kk) falls to zero in a quarter of its period.
#[test]
fn the_body_turns_over_when_the_elliptic_integral_says() {
    let study = moved("rigid-body/tumbling.toml", &[], None);
    let (i1, i2, i3) = (1.0, 2.0, 3.0);
    let (w1, w2) = (0.01_f64, 2.0_f64);
    let twice_energy = i1 * w1 * w1 + i2 * w2 * w2;
    let momentum = (i1 * w1).powi(2) + (i2 * w2).powi(2);
    // The momentum is below 2 E I2, so the first axis takes the part of the third in the book.
    let rate = ((i2 - i1) * (twice_energy * i3 - momentum) / (i1 * i2 * i3)).sqrt();
    let below_one = (i2 - i1) * (twice_energy * i3 - momentum);
    let complementary = (below_one - (i3 - i2) * (momentum - twice_energy * i1)) / below_one;
    let (mut mean, mut root) = (1.0, complementary.sqrt());
    for _ in 0..40 {
        (mean, root) = ((mean + root) / 2.0, (mean * root).sqrt());
    }
    let quarter = std::f64::consts::FRAC_PI_2 / mean / rate;
    let fall = at(
        &study,
        &[quarter - 1e-6, quarter + 1e-6, 2.0 * quarter],
        "w2",
    );
    assert!(fall[0] > 0.0 && fall[1] < 0.0, "{quarter}: {fall:?}");
    assert!((fall[2] + w2).abs() < 1e-6, "{fall:?}");
}
