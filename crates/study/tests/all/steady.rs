//! Steady motions in numbers, where their equations are not solved exactly.
#![allow(clippy::unwrap_used, reason = "test code fails where it stands")]

use chetaev_model::load;
use chetaev_study::steady::{steady, Motions, Search, Singular};
use std::collections::BTreeMap;

/// What is found of a model from its starts.
fn found(text: &str) -> Box<Search> {
    let loaded = load("near.toml", text, &BTreeMap::new(), &[]);
    let model = loaded.model.unwrap();
    match steady(&model, false).unwrap().motions {
        Motions::Near(found) => found,
        Motions::All(found) => panic!("all were found: {found:?}"),
    }
}

/// The zero of a function between two places of different sign, by halving.
fn zero(f: impl Fn(f64) -> f64, mut a: f64, mut b: f64) -> f64 {
    let sign = f(a).signum();
    for _ in 0..200 {
        let middle = 0.5 * (a + b);
        if f(middle).signum() == sign {
            a = middle;
        } else {
            b = middle;
        }
    }
    0.5 * (a + b)
}

/// An inverted pendulum on a torsion spring is buckled: m g l sin θ = k θ has three zeros, of which the upright one is unstable.
#[test]
fn a_buckled_pendulum_has_three_states_of_rest() {
    let found = found(
        r#"
name = "buckled"
coordinates = ["th"]
parameters = { k = 5 }
[lagrangian]
L = "1/2 th'^2 - 981/100 cos(th) - 1/2 k th^2"
[initial]
th = 0.1
"th'" = 0
"#,
    );
    let aside = zero(|x| 9.81 * x.sin() - 5.0 * x, 1.0, 3.0);
    let mut places: Vec<f64> = found
        .found
        .iter()
        .map(|own| own.point.unknowns[0])
        .collect();
    places.sort_by(f64::total_cmp);
    assert_eq!(places.len(), 3, "{places:?}");
    for (place, expected) in places.iter().zip([-aside, 0.0, aside]) {
        assert!((place - expected).abs() < 1e-12, "{place} {expected}");
    }
    let upright = found
        .found
        .iter()
        .find(|own| own.point.unknowns[0].abs() < 1e-9);
    let upright = &upright.unwrap().point.spectrum.values;
    let rate = upright.iter().map(|l| l.re).fold(0.0, f64::max);
    assert!((rate - (9.81_f64 - 5.0).sqrt()).abs() < 1e-9, "{rate}");
    assert!(found.found.iter().all(|own| own.family == 0));
}

/// A mass of 10²⁰ on which forces of 10⁻⁶ act rests where one of 1 does on which those of 1 act, and at no other place, in its own time.
#[test]
fn units_make_no_steady_motions() {
    let of = |m: f64, k: f64| {
        let mut found: Vec<(f64, f64)> = found(&format!(
            r#"
name = "slow"
coordinates = ["x", "y"]
parameters = {{ m = {m:e}, k = {k:e} }}
[lagrangian]
T = "1/2 m (x'^2 + y'^2)"
V = "k (exp(x) - 2 x + cosh(y - x))"
[initial]
x = 3
y = -5
"#
        ))
        .found
        .iter()
        .map(|own| {
            let rates = own.point.spectrum.values.iter().map(|l| l.im);
            (own.point.unknowns[0], rates.fold(0.0, f64::max))
        })
        .collect();
        found.sort_by(|a, b| a.0.total_cmp(&b.0));
        found
    };
    let (usual, slow) = (of(1.0, 1.0), of(1e20, 1e-6));
    assert_eq!(usual.len(), 1, "{usual:?}");
    assert_eq!(slow.len(), 1, "{slow:?}");
    // The stiffness at x = y = ln 2 is [[3, −1], [−1, 1]].
    let rate = (2.0 + 2_f64.sqrt()).sqrt();
    for (own, unit) in [(usual[0], 1.0), (slow[0], 1e-13)] {
        assert!((own.0 - 2_f64.ln()).abs() < 1e-12, "{own:?}");
        assert!((own.1 - rate * unit).abs() < 1e-9 * rate * unit, "{own:?}");
    }
}

/// A guess that the model names is a start, and a family is told with its dimension: a blade that goes straight on through a drag that holds a
/// speed, u eˣᵘ = const has one zero for each heading.
#[test]
fn what_a_model_guesses_is_a_start() {
    let found = found(
        r#"
name = "driven"
coordinates = ["x", "y", "phi"]
parameters = { F = 2 }
[lagrangian]
L = "1/2 (x'^2 + y'^2 + phi'^2)"
[forces]
x = "(F - exp(x' cos(phi) + y' sin(phi))) cos(phi)"
y = "(F - exp(x' cos(phi) + y' sin(phi))) sin(phi)"
phi = "-phi'"
[constraints]
blade = "x' sin(phi) = y' cos(phi)"
[quasi_velocities]
u = "x' cos(phi) + y' sin(phi)"
w = "phi'"
[initial]
x = 0
y = 0
phi = 0
"x'" = 1
"phi'" = 0
[steady.straight]
phi = 0
"x'" = { guess = 0.5 }
"phi'" = 0
"#,
    );
    assert_eq!(found.found.len(), 1, "{:?}", found.found);
    let own = &found.found[0];
    assert_eq!(own.from.as_deref(), Some("straight"));
    let speed = found.variables.iter().position(|name| name == "u").unwrap();
    assert!((own.point.unknowns[speed] - 2.0_f64.ln()).abs() < 1e-12);
    assert_eq!(found.ignorable, ["x", "y", "phi"]);
}

/// A double spherical pendulum in angles hangs and stands where these are no coordinates: no stability is told of it there. A point on the axis y = 0
/// of the cross x y = 0 rests at x = 1; on the axis x = 0 it would rest at y = 0 alone, where the axes meet.
#[test]
fn singular_places_have_no_stability() {
    let found = found(
        r#"
name = "double spherical pendulum"
coordinates = ["a", "b", "p", "r"]
[define]
x1 = "sin(a) cos(p)"
y1 = "sin(a) sin(p)"
z1 = "-cos(a)"
x2 = "x1 + sin(b) cos(p + r)"
y2 = "y1 + sin(b) sin(p + r)"
z2 = "z1 - cos(b)"
[lagrangian]
T = "1/2 (x1'^2 + y1'^2 + z1'^2 + x2'^2 + y2'^2 + z2'^2)"
V = "z1 + z2"
"#,
    );
    assert!(!found.found.is_empty());
    for own in &found.found {
        let vertical = own.point.unknowns[..2].iter().map(|x| x.sin().abs());
        let is_vertical = vertical.fold(f64::INFINITY, f64::min) < 1e-6;
        assert_eq!(own.singular == Some(Singular::Mass), is_vertical, "{own:?}");
    }
    let cross = self::found(
        r#"
name = "cross"
coordinates = ["x", "y"]
[lagrangian]
T = "1/2 (x'^2 + y'^2)"
V = "1/2 (x - 1)^2 + y^2"
[constraints]
cross = "x y = 0"
[initial]
x = 1
"#,
    );
    for own in &cross.found {
        let (x, y) = (own.point.unknowns[0], own.point.unknowns[1]);
        let is_at_rest = (x - 1.0).abs() < 1e-9 && y.abs() < 1e-9;
        let is_meeting = x.abs().max(y.abs()) < 1e-3;
        assert!(is_at_rest || is_meeting, "{own:?}");
        assert_eq!(own.singular.is_some(), is_meeting, "{own:?}");
    }
}

/// All steady motions that are found exactly, by the values of their variables.
fn all(text: &str) -> Vec<Vec<f64>> {
    let loaded = load("all.toml", text, &BTreeMap::new(), &[]);
    let Motions::All(set) = steady(&loaded.model.unwrap(), false).unwrap().motions else {
        panic!("not all were found");
    };
    let value = |own: &chetaev_stability::steady_set::Value| match own {
        chetaev_stability::steady_set::Value::Number { ball, .. } => ball.to_f64(),
        other => panic!("{other:?}"),
    };
    let values = set.found.iter();
    values
        .map(|own| own.values.iter().map(value).collect())
        .collect()
}

/// Roots are those of numbers that are not negative: x^(1/3) = x/4 at 0 and 8, and not at −8; x^(1/3) = −2 nowhere.
#[test]
fn roots_of_negative_numbers_are_no_states_of_rest() {
    let of = |force: &str| {
        format!(
            "coordinates = [\"x\"]\n[lagrangian]\nT = \"1/2 x'^2\"\n[forces]\nx = \"{force}\"\n"
        )
    };
    let found = all(&of("x^(1/3) - x/4"));
    let at: Vec<f64> = found.iter().map(|own| own[0]).collect();
    assert_eq!(at, [0.0, 8.0]);
    assert!(all(&of("x^(1/3) + 2")).is_empty());
}

/// What is found in numbers keeps to what is assumed, and motions in small units are told apart: x = 1e-10, 2e-10 and 3e-10 times what makes
/// (y − 1)(y − 2)(y − 3) = 0 in y = 10¹⁰ x, of which two are assumed.
#[test]
fn assumptions_and_units_of_motions_in_numbers() {
    let text = r#"
coordinates = ["x"]
assumptions = ["x < 2.5e-10"]
parameters = { a = 1e-10 }
[lagrangian]
T = "1/2 x'^2"
[forces]
x = "-a (exp(x/a) - exp(1)) (x/a - 2) (x/a - 3)"
[initial]
x = 1.2e-10
"#;
    let found = found(text);
    let mut at: Vec<f64> = found
        .found
        .iter()
        .map(|own| own.point.unknowns[0] * 1e10)
        .collect();
    at.sort_by(f64::total_cmp);
    assert_eq!(at.len(), 2, "{at:?}");
    assert!(
        (at[0] - 1.0).abs() < 1e-8 && (at[1] - 2.0).abs() < 1e-8,
        "{at:?}"
    );
}
