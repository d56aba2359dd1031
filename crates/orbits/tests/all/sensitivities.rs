//! Sensitivities of motions to parameters and initial values.
#![allow(
    clippy::unwrap_used,
    clippy::excessive_precision,
    reason = "test code fails where it stands, and has the digits of its sources"
)]

use crate::common::{is_close, system};
use chetaev_integrate::Output;
use chetaev_orbits::beginning::Beginning;
use chetaev_orbits::sensitivity::sensitivities;
use chetaev_orbits::variational::Order;
use chetaev_orbits::OrbitError;
use std::collections::BTreeMap;

/// `x = x₀ cos ωt + (v₀/ω) sin ωt` with ω = √k: derivatives by the stiffness and by a speed that is given as the double of a parameter.
#[test]
fn an_oscillator_by_stiffness_and_start() {
    let (system, prepared) = system(
        r#"
coordinates = ["x"]
parameters = { k = 4, s = 0.25 }
[lagrangian]
T = "1/2 x'^2"
V = "1/2 k x^2"
[initial]
x = 1
"x'" = "2 s"
"#,
    );
    let symbol = |name: &str, order| system.graph.intern_symbol(name, order);
    let beginning = Beginning {
        t: 0.0,
        point: vec![(symbol("x", 0), 1.0), (symbol("x", 1), 0.5)],
        given: system.start.clone(),
        guessed: Vec::new(),
        project: false,
    };
    let by = ["k".to_owned(), "s".to_owned(), "x".to_owned()];
    let found = sensitivities(
        &system,
        (&prepared.terms, &prepared.selection),
        &beginning,
        (&by, Order::Second),
        (1.3, Output::Every(0.65)),
    )
    .unwrap();
    assert_eq!(found.columns()[..4], ["x", "x'", "d x/d k", "d x'/d k"]);
    let (t, row) = found.rows.last().unwrap();
    let at = |name: &str| row[found.columns().iter().position(|own| own == name).unwrap()];
    let (w, k, v) = (2.0_f64, 4.0_f64, 0.5);
    let (sin, cos) = (w * t).sin_cos();
    is_close(at("x"), cos + v / w * sin, 1e-14);
    // dω/dk = 1/(2 ω).
    let by_omega = -t * sin - v / k * sin + v / w * t * cos;
    is_close(at("d x/d k"), by_omega / (2.0 * w), 1e-14);
    is_close(at("d x/d s"), 2.0 / w * sin, 1e-14);
    is_close(at("d x/d x"), cos, 1e-14);
    is_close(at("d x'/d x"), -w * sin, 1e-14);
    let mixed = -t * sin / (2.0 * w);
    is_close(at("d2 x/d k d x"), mixed, 1e-14);
    is_close(at("d2 x/d s d x"), 0.0, 1e-14);
    let second =
        -t * t * cos + 2.0 * v / w.powi(3) * sin - 2.0 * v / k * t * cos - v / w * t * t * sin;
    is_close(
        at("d2 x/d k d k"),
        second / (4.0 * k) - by_omega / (4.0 * w.powi(3)),
        1e-13,
    );
}

/// The last row of the sensitivities of a model from rest to th0 and g, by names.
fn by_start_and_gravity(text: &str, point: &[(&str, f64)], end: f64) -> BTreeMap<String, f64> {
    let (system, prepared) = system(text);
    let symbol = |name: &str| {
        let order = u32::from(name.ends_with('\''));
        system
            .graph
            .intern_symbol(name.trim_end_matches('\''), order)
    };
    let beginning = Beginning {
        t: 0.0,
        point: point.iter().map(|&(name, x)| (symbol(name), x)).collect(),
        given: system.start.clone(),
        guessed: Vec::new(),
        project: false,
    };
    let by = ["th0".to_owned(), "g".to_owned()];
    let of = (&prepared.terms, &prepared.selection);
    let to = (end, Output::End);
    let found = sensitivities(&system, of, &beginning, (&by, Order::First), to).unwrap();
    let row = found.rows.last().unwrap().1.clone();
    found.columns().into_iter().zip(row).collect()
}

/// A pendulum in Cartesian coordinates passes its lowest place, where one velocity does not determine the other, and its turning points: its
/// sensitivities are those in the angle, x = sin θ and y = −cos θ.
#[test]
fn a_pendulum_passes_where_a_velocity_is_not_determined() {
    let angle = by_start_and_gravity(
        "coordinates = [\"th\"]\nparameters = { g = 9.81, th0 = 0.4 }\n[lagrangian]\nL = \"1/2 th'^2 + g cos(th)\"\n[initial]\nth = \"th0\"\n\"th'\" = 0\n",
        &[("th", 0.4), ("th'", 0.0)],
        2.0,
    );
    let (sin, cos) = 0.4_f64.sin_cos();
    let plane = by_start_and_gravity(
        "coordinates = [\"x\", \"y\"]\nparameters = { g = 9.81, th0 = 0.4 }\n[lagrangian]\nL = \"1/2 (x'^2 + y'^2) - g y\"\n[constraints]\nrod = \"x^2 + y^2 = 1\"\n[initial]\nx = \"sin(th0)\"\ny = \"-cos(th0)\"\n\"x'\" = 0\n",
        &[("x", sin), ("y", -cos), ("x'", 0.0), ("y'", 0.0)],
        2.0,
    );
    let (sin, cos) = angle["th"].sin_cos();
    is_close(plane["x"], sin, 1e-12);
    is_close(plane["y"], -cos, 1e-12);
    is_close(plane["x'"], cos * angle["th'"], 1e-12);
    for by in ["th0", "g"] {
        let (turn, rate) = (
            angle[&format!("d th/d {by}")],
            angle[&format!("d th'/d {by}")],
        );
        is_close(plane[&format!("d x/d {by}")], cos * turn, 1e-11);
        is_close(plane[&format!("d y/d {by}")], sin * turn, 1e-11);
        let of_velocity = cos * rate - sin * turn * angle["th'"];
        is_close(plane[&format!("d x'/d {by}")], of_velocity, 1e-11);
    }
}

/// A skate on a horizontal plane that turns uniformly runs on a circle of radius u/w: `x = (u/w) sin(w t)`, `y = (u/w)(1 − cos(w t))`. Its velocity
/// y' follows from the constraint.
#[test]
fn a_skate_by_its_rates() {
    let (system, prepared) = system(
        r#"
coordinates = ["x", "y", "phi"]
parameters = { u = 1.5, w = 0.8 }
[lagrangian]
T = "1/2 (x'^2 + y'^2 + phi'^2)"
[constraints]
edge = "-x' sin(phi) + y' cos(phi) = 0"
[initial]
x = 0
y = 0
phi = 0
"x'" = "u"
"phi'" = "w"
"#,
    );
    let symbol = |name: &str, order| system.graph.intern_symbol(name, order);
    let names = ["x", "y", "phi"];
    let positions = names.map(|name| (symbol(name, 0), 0.0));
    let speeds = [
        (symbol("x", 1), 1.5),
        (symbol("y", 1), 0.0),
        (symbol("phi", 1), 0.8),
    ];
    let beginning = Beginning {
        t: 0.0,
        point: [positions, speeds].concat(),
        given: system.start.clone(),
        guessed: Vec::new(),
        project: false,
    };
    let by = ["u".to_owned(), "w".to_owned(), "phi".to_owned()];
    let found = sensitivities(
        &system,
        (&prepared.terms, &prepared.selection),
        &beginning,
        (&by, Order::Second),
        (1.7, Output::End),
    )
    .unwrap();
    let (t, row) = found.rows.last().unwrap();
    let at = |name: &str| row[found.columns().iter().position(|own| own == name).unwrap()];
    let (u, w) = (1.5, 0.8_f64);
    let (sin, cos) = (w * t).sin_cos();
    is_close(at("x"), u / w * sin, 1e-14);
    is_close(at("d x/d u"), sin / w, 1e-13);
    is_close(
        at("d y/d w"),
        u * (t * sin / w - (1.0 - cos) / (w * w)),
        1e-13,
    );
    is_close(
        at("d2 y/d u d w"),
        t * sin / w - (1.0 - cos) / (w * w),
        1e-13,
    );
    // x' stays u, so that along the edge the speed is u/cos φ₀: to the first order all turns about the origin.
    is_close(at("d x/d phi"), -at("y"), 1e-13);
    is_close(at("d y/d phi"), at("x"), 1e-13);
    // To the second, u/cos φ₀ = u (1 + φ₀²/2): x(φ₀) = Re((1 + φ₀²/2) e^{iφ₀} z), whose second derivative at 0 vanishes.
    is_close(at("d2 x/d phi d phi"), 0.0, 1e-12);
    is_close(at("d2 y/d phi d phi"), 0.0, 1e-12);
}

/// The sensitivities of a motion that begins at the nearest admissible state, by names.
fn from_nearest(
    text: &str,
    (point, project): (&[(&str, f64)], bool),
    by: &[&str],
    end: f64,
) -> Result<BTreeMap<String, f64>, OrbitError> {
    let (system, prepared) = system(text);
    let symbol = |name: &str| {
        let order = u32::from(name.ends_with('\''));
        let name = name.trim_end_matches('\'');
        system.graph.intern_symbol(name, order)
    };
    let beginning = Beginning {
        t: 0.0,
        point: point.iter().map(|&(name, x)| (symbol(name), x)).collect(),
        given: system.start.clone(),
        guessed: Vec::new(),
        project,
    };
    let by: Vec<String> = by.iter().map(|name| (*name).to_owned()).collect();
    let of = (&prepared.terms, &prepared.selection);
    let to = (end, Output::Times(vec![end]));
    let found = sensitivities(&system, of, &beginning, (&by, Order::Second), to)?;
    let row = found.rows.last().unwrap().1.clone();
    Ok(found.columns().into_iter().zip(row).collect())
}

/// A point on a circle is the nearest one to (a, b), and its velocity the nearest one to (u, w): then it turns at the rate `(a w − b u)/r` from the
/// angle of (a, b). In units of atoms and of planets too.
#[test]
fn the_nearest_state_on_a_circle_and_its_curvature() {
    let (a, b, u, w, t) = (1.2_f64, 0.9_f64, 0.3, 0.7, 0.8);
    let r = a.hypot(b);
    let momentum = a * w - b * u;
    let (angle, rate) = (b.atan2(a), momentum / r);
    for (mass, length) in [(1.0, 1.0), (1.7e-27, 1e-10), (6e24, 1.5e11)] {
        let text = format!(
            r#"
coordinates = ["x", "y"]
parameters = {{ a = {a}, b = {b}, w = {w}, l = {length:?}, m = {mass:?} }}
[lagrangian]
T = "1/2 m (x'^2 + y'^2)"
[constraints]
rod = "x^2 + y^2 = l^2"
[initial]
x = "a l"
y = "b l"
"x'" = "{u} l"
"y'" = "w l"
"#
        );
        let (sin, cos) = angle.sin_cos();
        let point = [
            ("x", length * cos),
            ("y", length * sin),
            ("x'", -length * sin * rate),
            ("y'", length * cos * rate),
        ];
        let found = from_nearest(&text, (&point, true), &["a", "w"], t).unwrap();
        let at = |name: &str| found[name] / length;
        let (sin, cos) = (angle + rate * t).sin_cos();
        // The derivatives of the angle and of the rate by a, and by w.
        let (r2, r3) = (r * r, r.powi(3));
        let angle_a = -b / r2;
        let rate_a = w / r - momentum * a / r3;
        let angle_aa = 2.0 * a * b / (r2 * r2);
        let rate_aa = -(2.0 * w * a + momentum) / r3 + 3.0 * momentum * a * a / (r3 * r2);
        let (rate_w, rate_aw) = (a / r, 1.0 / r - a * a / r3);
        let turn = angle_a + t * rate_a;
        is_close(at("x"), cos, 1e-12);
        is_close(at("d x/d a"), -sin * turn, 1e-11);
        is_close(at("d y/d a"), cos * turn, 1e-11);
        is_close(at("d y/d w"), cos * t * rate_w, 1e-11);
        let second = angle_aa + t * rate_aa;
        let expected = -cos * turn * turn - sin * second;
        is_close(at("d2 x/d a d a"), expected, 1e-10);
        let expected = -cos * turn * t * rate_w - sin * t * rate_aw;
        is_close(at("d2 x/d a d w"), expected, 1e-10);
    }
}

/// Two masses on a line share what is wanting by the inverse of their masses; so do velocities that are given and contradict the constraint.
#[test]
fn the_nearest_state_is_one_in_the_kinetic_metric() {
    let text = r#"
coordinates = ["x", "y"]
parameters = { m = 2, c = 3 }
[lagrangian]
T = "1/2 (m x'^2 + 5 y'^2)"
[constraints]
sum = "x + y = c"
[initial]
x = 1
y = 1
"x'" = "c"
"y'" = "2 m"
"#;
    let (m, c) = (2.0, 3.0);
    let share = 5.0 / (m + 5.0);
    let by_mass = -5.0 / (m + 5.0_f64).powi(2);
    let (lack, rest) = (c - 2.0, -c - 2.0 * m);
    let (x, v) = (1.0 + lack * share, c + rest * share);
    let point = [("x", x), ("y", c - x), ("x'", v), ("y'", -v)];
    let found = from_nearest(text, (&point, true), &["m", "c"], 0.0).unwrap();
    is_close(found["d x/d m"], lack * by_mass, 1e-14);
    is_close(found["d x/d c"], share, 1e-14);
    is_close(found["d y/d c"], 1.0 - share, 1e-14);
    is_close(found["d x'/d m"], rest * by_mass - 2.0 * share, 1e-14);
    is_close(found["d x'/d c"], 1.0 - share, 1e-14);
    let second = -2.0 * by_mass / (m + 5.0);
    is_close(found["d2 x/d m d m"], lack * second, 1e-13);
    is_close(found["d2 x'/d m d m"], rest * second - 4.0 * by_mass, 1e-13);
    is_close(found["d2 x/d m d c"], by_mass, 1e-13);
}

/// Data that fulfil a constraint for one length alone are varied by no length.
#[test]
fn data_that_hold_for_one_value_alone_are_not_varied() {
    let text = r#"
coordinates = ["x", "y"]
parameters = { l = 1 }
[lagrangian]
T = "1/2 (x'^2 + y'^2)"
[constraints]
rod = "x^2 + y^2 = l^2"
[initial]
x = 0.6
y = 0.8
"x'" = 0
"#;
    let point = [("x", 0.6), ("y", 0.8), ("x'", 0.0), ("y'", 0.0)];
    let refused = from_nearest(text, (&point, false), &["l"], 1.0).unwrap_err();
    assert!(matches!(refused, OrbitError::GivenForValuesAlone));
    let moved = from_nearest(text, (&point, true), &["l"], 1.0).unwrap();
    is_close(moved["d x/d l"], 0.6, 1e-13);
    is_close(moved["d y/d l"], 0.8, 1e-13);
}
