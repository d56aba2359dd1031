//! The equations of motion that are printed without anybody naming quasi-velocities, held against those that people write.
#![allow(
    clippy::expect_used,
    clippy::unwrap_used,
    reason = "test code fails where it stands"
)]

use chetaev::symbolic::print::{Document, Options};
use chetaev::symbolic::Expr;
use chetaev_tests::places::scratch;
use chetaev_tests::program::{run, text};
use chetaev_tests::studied::loaded;
use std::path::PathBuf;
use std::process::Command;

/// A system as its text, and its equations by hand.
struct Hand {
    name: &'static str,
    model: &'static str,
    /// Names in the hand form beside those of the model.
    names: &'static [&'static str],
    /// Left and right sides: rates of the state.
    equations: &'static [(&'static str, &'static str)],
}

/// Neimark, Fufaev (1972): the skate, the sleigh, the disc that rolls upright; Ostrowski, Burdick, Lewis, Murray
/// (1995): the snakeboard with J + J_r + 2 J_w = m l²; Lagrange's top in Landau, Lifshitz, § 35; a cart with two driven wheels from
/// the balances of force and moment.
const HANDS: [Hand; 6] = [
    Hand {
        name: "skate",
        model: r#"
coordinates = ["x", "y", "phi"]
parameters = { m = 1, J = 1, k = 2 }
assumptions = ["m > 0", "J > 0"]
lagrangian = "1/2 m (x'^2 + y'^2) + 1/2 J phi'^2 + m k x"
constraints = { blade = "x' sin(phi) = y' cos(phi)" }
"#,
        names: &["u", "w"],
        equations: &[
            ("x'", "u cos(phi)"),
            ("y'", "u sin(phi)"),
            ("phi'", "w"),
            ("u'", "k cos(phi)"),
            ("w'", "0"),
        ],
    },
    Hand {
        name: "sleigh",
        model: r#"
coordinates = ["x", "y", "phi"]
parameters = { m = 1.5, J = 0.4, a = 0.25 }
assumptions = ["m > 0", "J > 0"]
lagrangian = "1/2 m ((x' - a phi' sin(phi))^2 + (y' + a phi' cos(phi))^2) + 1/2 J phi'^2"
constraints = { blade = "x' sin(phi) = y' cos(phi)" }
"#,
        names: &["u", "w"],
        equations: &[
            ("x'", "u cos(phi)"),
            ("y'", "u sin(phi)"),
            ("phi'", "w"),
            ("u'", "a w^2"),
            ("w'", "-m a u w/(J + m a^2)"),
        ],
    },
    Hand {
        name: "vertical-disc",
        model: r#"
coordinates = ["x", "y", "theta", "phi"]
parameters = { m = 2, R = 0.5, I = 0.25, J = 0.1 }
assumptions = ["m > 0", "R > 0", "I > 0", "J > 0"]
lagrangian = "1/2 m (x'^2 + y'^2) + 1/2 I theta'^2 + 1/2 J phi'^2"
constraints = { along = "x' = R cos(phi) theta'", across = "y' = R sin(phi) theta'" }
"#,
        names: &["s", "w"],
        equations: &[
            ("x'", "R s cos(phi)"),
            ("y'", "R s sin(phi)"),
            ("theta'", "s"),
            ("phi'", "w"),
            ("s'", "0"),
            ("w'", "0"),
        ],
    },
    Hand {
        name: "snakeboard",
        model: r#"
coordinates = ["x", "y", "theta", "psi", "phi"]
parameters = { m = 4, l = 0.3, Jr = 0.05, Jw = 0.01 }
assumptions = ["m > 0", "l > 0", "Jr > 0", "Jw > 0", "Jr < m l^2"]
lagrangian = "1/2 m (x'^2 + y'^2) + 1/2 m l^2 theta'^2 + 1/2 Jr psi'^2 + Jr psi' theta' + Jw phi'^2"
initial = { phi = 0.1 }
[constraints]
front = "cos(theta + phi) y' + l cos(phi) theta' = sin(theta + phi) x'"
back = "cos(theta - phi) y' - l cos(phi) theta' = sin(theta - phi) x'"
"#,
        names: &["u", "w", "s"],
        equations: &[
            ("x'", "u cos(theta)"),
            ("y'", "u sin(theta)"),
            ("theta'", "u tan(phi)/l"),
            ("psi'", "w"),
            ("phi'", "s"),
            ("s'", "0"),
            ("u'", "-(m l^2 - Jr) u s tan(phi)/(m l^2 - Jr sin(phi)^2)"),
            ("w'", "-(u' tan(phi) + u s/cos(phi)^2)/l"),
        ],
    },
    Hand {
        name: "heavy-top",
        model: r#"
coordinates = ["phi", "theta", "psi"]
parameters = { A = 0.3, C = 0.1, k = 1.2 }
assumptions = ["A > 0", "C > 0", "k > 0", "0 < theta < pi"]
lagrangian = "1/2 A (theta'^2 + phi'^2 sin(theta)^2) + 1/2 C (psi' + phi' cos(theta))^2 - k cos(theta)"
initial = { theta = "pi/3" }
"#,
        names: &["n"],
        equations: &[
            ("psi'", "n - phi' cos(theta)"),
            ("n'", "0"),
            (
                "A theta''",
                "A phi'^2 sin(theta) cos(theta) - C n phi' sin(theta) + k sin(theta)",
            ),
            (
                "A phi'' sin(theta)",
                "C n theta' - 2 A phi' theta' cos(theta)",
            ),
        ],
    },
    Hand {
        name: "drive",
        model: r#"
coordinates = ["x", "y", "phi", "right", "left"]
parameters = { m = 6, J = 0.3, Jw = 0.01, r = 0.1, b = 0.2, f = 0.3, h = 0.2 }
assumptions = ["m > 0", "J > 0", "Jw > 0", "r > 0", "b > 0"]
lagrangian = "1/2 m (x'^2 + y'^2) + 1/2 J phi'^2 + 1/2 Jw (right'^2 + left'^2)"
forces = { right = "f", left = "h" }
[constraints]
axle = "x' sin(phi) = y' cos(phi)"
right_wheel = "x' cos(phi) + y' sin(phi) + b phi' = r right'"
left_wheel = "x' cos(phi) + y' sin(phi) - b phi' = r left'"
"#,
        names: &["u", "w"],
        equations: &[
            ("x'", "u cos(phi)"),
            ("y'", "u sin(phi)"),
            ("phi'", "w"),
            ("right'", "(u + b w)/r"),
            ("left'", "(u - b w)/r"),
            ("(m + 2 Jw/r^2) u'", "(f + h)/r"),
            ("(J + 2 Jw b^2/r^2) w'", "b (f - h)/r"),
        ],
    },
];

/// The operations of the hand form as the same printer prints it.
fn by_hand(hand: &Hand) -> usize {
    let names = hand.names.join("\", \"");
    let model = hand.model.replacen(
        "coordinates = [",
        &format!("coordinates = [\"{names}\", "),
        1,
    );
    let path = written(&format!("{}-by-hand", hand.name), &model);
    let model = loaded(&path, &[]).model.expect("a model");
    let read = |side: &str| -> Expr { model.expression(side).expect("an expression of the model") };
    let pairs: Vec<(Expr, Expr)> = (hand.equations.iter())
        .map(|(left, right)| (read(left), read(right)))
        .collect();
    Document::equations(&model.graph, &pairs, &Options::default())
        .operations()
        .total()
}

fn written(name: &str, model: &str) -> PathBuf {
    let path = scratch(&format!("short-equations-{name}")).join(format!("{name}.toml"));
    std::fs::write(&path, format!("name = \"{name}\"\n{model}")).expect("the scratch folder");
    path
}

/// What `derive --count` says.
fn counted(path: &std::path::Path) -> usize {
    let finished = run(&["derive", text(path), "--count"]);
    assert_eq!(finished.status, Some(0), "{}", finished.both());
    let number = finished.out.split_whitespace().nth(1).expect("a number");
    number.parse().expect("a number")
}

#[test]
fn equations_are_as_short_as_those_of_people() {
    let mut longer = Vec::new();
    for hand in &HANDS {
        let own = counted(&written(hand.name, hand.model));
        let theirs = by_hand(hand);
        println!("{}: {own} operations, by hand {theirs}", hand.name);
        if 10 * own > 12 * theirs {
            longer.push(format!("{}: {own} and {theirs}", hand.name));
        }
    }
    assert!(longer.is_empty(), "{longer:?}");
}

/// The sleigh's function in Python, at a state and with values at which `u' = a w²` and `w' = −m a u w/(J + m a²)` are known. A
/// stand-in for NumPy gives what the function uses of it, so that Python alone runs the test.
#[test]
fn the_function_for_numpy_computes_the_motion() {
    let sleigh = HANDS.iter().find(|hand| hand.name == "sleigh").unwrap();
    let path = written("sleigh-in-python", sleigh.model);
    let finished = run(&["derive", text(&path), "--as", "python"]);
    assert_eq!(finished.status, Some(0), "{}", finished.both());
    let folder = path.parent().expect("a folder");
    std::fs::write(folder.join("sleigh_rhs.py"), &finished.out).expect("the scratch folder");
    let stand_in =
        "from math import *\nfrom math import nan\ndef array(x, dtype=None): return list(x)\n";
    std::fs::write(folder.join("numpy.py"), stand_in).expect("the scratch folder");
    let script = "import sleigh_rhs as s\nprint(*s.parameters)\nprint(*s.rhs(0.0, [1.0, 2.0, 0.5, 3.0, 0.7], s.parameters))";
    let ran = Command::new("python3")
        .current_dir(folder)
        .args(["-c", script])
        .output()
        .expect("python3 runs");
    let errors = String::from_utf8_lossy(&ran.stderr);
    assert!(ran.status.success(), "{errors}\n{}", finished.out);
    let lines = String::from_utf8_lossy(&ran.stdout);
    let numbers: Vec<f64> = (lines.split_whitespace())
        .map(|x| x.parse().expect("a number"))
        .collect();
    let (m, moment, a) = (1.5, 0.4, 0.25);
    let (phi, u, w) = (0.5_f64, 3.0, 0.7);
    let turning = -m * a * u * w / (moment + m * a * a);
    let (along, across) = (u * phi.cos(), u * phi.sin());
    let expected = [m, moment, a, along, across, w, a * w * w, turning];
    assert_eq!(numbers.len(), expected.len());
    for (found, known) in numbers.iter().zip(expected) {
        assert!((found - known).abs() < 1e-14, "{found} and {known}");
    }
}
