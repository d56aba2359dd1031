//! Curves of steady motions of mechanical systems, and what happens on them.
#![allow(
    clippy::unwrap_used,
    clippy::excessive_precision,
    reason = "test code fails where it stands, and has the digits of its sources"
)]

use crate::common::{flow, is_close};
use crate::points;
use chetaev_orbits::branch::{Branch, End, Kind};
use chetaev_orbits::continuation::{follow, Pace};
use chetaev_orbits::equilibria::Equilibria;
use chetaev_orbits::hopf::{first_lyapunov, WithoutLyapunov};
use chetaev_orbits::solution::solution;
use chetaev_orbits::units::Units;
use chetaev_orbits::{Flow, OrbitError};

/// The steady motions of a flow from one near a state, over a range of a parameter.
fn curve(
    flow: &Flow,
    parameter: &str,
    start: (&[f64], f64),
    range: (f64, f64),
    pace: Pace,
) -> Branch {
    let parameter = flow.graph.intern_symbol(parameter, 0);
    let mut equations = Equilibria::new(flow, Some(parameter)).unwrap();
    follow(&mut equations, start, range, pace).unwrap()
}

/// Watt's governor hunts below ε = 2 α β^(3/2), and the orbits that are born are stable: l₁ < 0 (Sotomayor, Mello and Braga 2007; value by
/// harmonic balance).
#[test]
fn watts_governor() {
    let (flow, _) = flow(
        r#"
coordinates = ["x", "s"]
parameters = { alpha = 0.5, beta = 0.6, eps = 0.6 }
[lagrangian]
T = "1/2 x'^2 + 1/2 s'^2"
[forces]
x = "s'^2 sin(x) cos(x) - sin(x) - eps x'"
s = "alpha (cos(x) - beta)"
"#,
        &[("x", 0.9), ("x'", 0.0), ("s'", 1.3)],
    );
    assert_eq!(flow.names, ["x", "x'", "s'"]);
    let found = curve(
        &flow,
        "eps",
        (&[0.9, 0.0, 1.3], 0.6),
        (0.1, 1.0),
        points(300),
    );
    assert_eq!(found.special.len(), 1, "{:?}", found.special);
    let special = &found.special[0];
    is_close(special.point.parameter, 0.464_758_001_544_890_03, 1e-12);
    is_close(special.point.unknowns[2], 1.290_994_448_735_805_6, 1e-12);
    match special.kind {
        Kind::Hopf {
            frequency,
            first_lyapunov,
        } => {
            is_close(frequency, 1.032_795_558_988_644_5, 1e-12);
            is_close(first_lyapunov.unwrap(), -0.081_153_947_931_242_15, 1e-9);
        }
        other => panic!("{other:?}"),
    }
}

/// A sleigh runs straight on at any speed: with the mass centre at a distance a from the edge the family has dimension 1, and it is cut. The
/// eigenvalue that is left is −m a u/(I + m a²), which passes zero at a = 0 (Neimark and Fufaev 1972).
#[test]
fn a_sleigh_across_its_family() {
    let (flow, _) = flow(
        r#"
coordinates = ["x", "y", "phi"]
parameters = { m = 2, I = 0.5, a = 0.3 }
[lagrangian]
T = "1/2 m ((x' - a sin(phi) phi')^2 + (y' + a cos(phi) phi')^2) + 1/2 I phi'^2"
[constraints]
edge = "-x' sin(phi) + y' cos(phi) = 0"
[quasi_velocities]
u = "x' cos(phi) + y' sin(phi)"
w = "phi'"
"#,
        &[
            ("x", 0.0),
            ("y", 0.0),
            ("phi", 0.0),
            ("x'", 1.5),
            ("y'", 0.0),
            ("phi'", 0.0),
        ],
    );
    assert_eq!(flow.names, ["u", "w"]);
    let found = curve(&flow, "a", (&[1.5, 0.0], 0.3), (-0.5, 0.5), points(300));
    assert_eq!(found.family, 1);
    for own in &found.points {
        let at = own.parameter;
        is_close(own.unknowns[0], 1.5, 1e-12);
        assert_eq!(own.spectrum.trivial, ["the family of steady motions"]);
        is_close(
            own.spectrum.values[0].re,
            -2.0 * at * 1.5 / (0.5 + 2.0 * at * at),
            1e-10,
        );
    }
    assert_eq!(found.special.len(), 1, "{:?}", found.special);
    assert_eq!(found.special[0].kind, Kind::BranchPoint);
    is_close(found.special[0].point.parameter, 0.0, 1e-10);
}

/// A conical pendulum at any speed: of its family of dimension 1 the eigenvalues are 0 and ±i φ' √(1 + 3 cos²θ) (Whittaker 1937, § 55), where
/// φ'² cos θ = g/l, so that it is nowhere unstable. Velocities that vanish do so to rounding, and the matrices are nearly of lower rank.
#[test]
fn a_conical_pendulum_is_stable() {
    let (flow, _) = flow(
        r#"
coordinates = ["theta", "phi"]
parameters = { g = 9 }
[lagrangian]
T = "1/2 (theta'^2 + sin(theta)^2 phi'^2)"
V = "-g cos(theta)"
"#,
        &[("theta", 1.0), ("phi", 0.0), ("theta'", 0.0), ("phi'", 4.0)],
    );
    let start = [1.0, 0.0, 4.0];
    let pace = Pace {
        step: 0.01,
        ..points(500)
    };
    let found = curve(&flow, "g", (&start, 9.0), (1.0, 20.0), pace);
    assert_eq!(found.special.len(), 0, "{:?}", found.special);
    assert!(found.points.len() > 80);
    for own in &found.points {
        let place = |name: &str| flow.names.iter().position(|own| own == name).unwrap();
        let (theta, rate) = (own.unknowns[place("theta")], own.unknowns[place("phi'")]);
        is_close(rate * rate * theta.cos(), own.parameter, 1e-12);
        let frequency = rate * (1.0 + 3.0 * theta.cos().powi(2)).sqrt();
        assert_eq!(own.spectrum.values.len(), 2);
        for (value, sign) in own.spectrum.values.iter().zip([-1.0, 1.0]) {
            is_close(value.re, 0.0, 1e-12);
            is_close(value.im, sign * frequency, 1e-12);
        }
    }
}

/// A charge on a hill in a magnetic field, x'' = B y' + x, y'' = −B x' + y, with the eigenvalues ±√(1 − B²/4) ± i B/2 for |B| < 2: the double shifts of
/// the QR method go round without end there.
#[test]
fn a_charge_on_a_hill_is_followed_to_the_ends() {
    let (flow, _) = flow(
        r#"
coordinates = ["x", "y"]
parameters = { p = 1.5 }
[lagrangian]
T = "1/2 (x'^2 + y'^2)"
V = "-1/2 (x^2 + y^2)"
[forces]
x = "p y'"
y = "-p x'"
"#,
        &[("x", 0.0), ("y", 0.0), ("x'", 0.0), ("y'", 0.0)],
    );
    let found = curve(&flow, "p", (&[0.0; 4], 1.5), (-1.0, 1.9), points(500));
    assert_eq!(found.ends, [End::Range; 2]);
    for own in &found.points {
        let half = 0.5 * own.parameter;
        for value in &own.spectrum.values {
            is_close(value.re.abs(), (1.0 - half * half).sqrt(), 1e-12);
            is_close(value.im.abs(), half.abs(), 1e-12);
        }
    }
}

/// Zeros of conservative systems, where λ² passes zero: a spring of stiffness p, a bead on a hoop at W² = g/R, and the fold of x'' = p − x². What
/// exists at the stated value alone is a branch that crosses, and no family: with V = (p − 1) x²/2 + y²/2, at p = 1 every x is one of rest.
#[test]
fn zeros_of_conservative_systems() {
    let model = |coordinates: &str, value: f64, energy: &str| {
        format!(
            "coordinates = [{coordinates}]\nparameters = {{ p = {value} }}\n[lagrangian]\nL = \"{energy}\"\n"
        )
    };
    let rest = [("x", 0.0), ("x'", 0.0)];
    let spring = model("\"x\"", 2.0, "1/2 x'^2 - 1/2 p x^2");
    let found = happens(&spring, &rest, (-1.0, 2.0));
    assert_eq!(found.len(), 1, "{found:?}");
    assert_eq!(found[0].0, Kind::BranchPoint);
    is_close(found[0].1, 0.0, 1e-14);
    let bead = model("\"x\"", 5.0, "1/2 x'^2 + 1/2 p^2 sin(x)^2 + 9 cos(x)");
    let found = happens(&bead, &rest, (0.0, 5.0));
    assert_eq!(found.len(), 1, "{found:?}");
    assert_eq!(found[0].0, Kind::BranchPoint);
    is_close(found[0].1, 3.0, 1e-14);
    let fold = model("\"x\"", 4.0, "1/2 x'^2 - 1/3 x^3 + p x");
    let found = happens(&fold, &[("x", 2.0), ("x'", 0.0)], (-1.0, 4.0));
    assert_eq!(found.len(), 1, "{found:?}");
    assert_eq!(found[0].0, Kind::Fold);
    is_close(found[0].1, 0.0, 1e-14);
    let state = [("x", 0.0), ("y", 0.0), ("x'", 0.0), ("y'", 0.0)];
    let plane = "1/2 (x'^2 + y'^2) - 1/2 (p - 1) x^2 - 1/2 y^2";
    let (flow, _) = flow(&model("\"x\", \"y\"", 1.0, plane), &state);
    let found = curve(&flow, "p", (&[0.0; 4], 1.0), (0.0, 3.0), points(300));
    assert_eq!(found.family, 0);
    assert_eq!(found.special.len(), 1, "{:?}", found.special);
    assert_eq!(found.special[0].kind, Kind::BranchPoint);
    is_close(found.special[0].point.parameter, 1.0, 1e-14);
}

/// x'' = −1 − x² has no state of rest: where the force is smallest, at x = 0, none is found.
#[test]
fn the_smallest_residual_is_no_solution() {
    let (flow, _) = flow(
        "coordinates = [\"x\"]\n[lagrangian]\nL = \"1/2 x'^2 - x - x^3/3\"\n",
        &[("x", 0.3), ("x'", 0.0)],
    );
    let mut equations = Equilibria::new(&flow, None).unwrap();
    let found = solution(&mut equations, &[0.3, 0.0], 0.0);
    assert!(
        matches!(found, Err(OrbitError::NotConverged { .. })),
        "{found:?}"
    );
}

/// Ziegler's column with equal damping d = 1/10 of both joints flutters from P = 2057/1400 on: Hurwitz's last determinant vanishes there.
#[test]
fn a_column_flutters_to_rounding() {
    let text = r#"
coordinates = ["a", "b"]
parameters = { p = 1, d = 0.1 }
[lagrangian]
T = "1/2 (3 a'^2 + b'^2 + 2 a' b' cos(a - b))"
V = "1/2 (a^2 + (b - a)^2)"
[forces]
a = "p sin(a - b) - d (2 a' - b')"
b = "-d (b' - a')"
"#;
    let found = happens(
        text,
        &[("a", 0.0), ("b", 0.0), ("a'", 0.0), ("b'", 0.0)],
        (0.0, 3.0),
    );
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(matches!(found[0].0, Kind::Hopf { .. }), "{found:?}");
    is_close(found[0].1, 2057.0 / 1400.0, 1e-14);
}

/// A bead on a turning hoop: at ω² = g/R the lowest position gives its stability to two others (a pitchfork); the branch through the side
/// position turns at the same point.
#[test]
fn a_bead_on_a_hoop() {
    let (flow, _) = flow(
        r#"
coordinates = ["theta"]
parameters = { R = 0.5, g = 9.81, W = 6 }
[lagrangian]
T = "1/2 R^2 theta'^2 + 1/2 R^2 W^2 sin(theta)^2"
V = "-g R cos(theta)"
[forces]
theta = "-0.1 theta'"
"#,
        &[("theta", 1.0), ("theta'", 0.0)],
    );
    let lowest = curve(&flow, "W", (&[0.0, 0.0], 3.0), (2.0, 8.0), points(300));
    assert_eq!(lowest.special.len(), 1, "{:?}", lowest.special);
    assert_eq!(lowest.special[0].kind, Kind::BranchPoint);
    let critical = (9.81_f64 / 0.5).sqrt();
    is_close(lowest.special[0].point.parameter, critical, 1e-12);
    let side = curve(&flow, "W", (&[1.0, 0.0], 6.0), (2.0, 8.0), points(300));
    let turn = side.special.iter().find(|own| own.kind == Kind::Pitchfork);
    is_close(turn.unwrap().point.parameter, critical, 1e-12);
    for own in &side.points {
        let expected = 9.81 / (0.5 * own.parameter * own.parameter);
        is_close(own.unknowns[0].cos(), expected, 1e-10);
    }
}

/// What happens along the motions from a state at the end of a range of p, with the values of p.
fn happens(text: &str, state: &[(&str, f64)], range: (f64, f64)) -> Vec<(Kind, f64)> {
    let (flow, _) = flow(text, state);
    let start: Vec<f64> = state.iter().map(|own| own.1).collect();
    let found = curve(&flow, "p", (&start, range.1), range, points(300));
    let special = found.special.into_iter();
    special.map(|own| (own.kind, own.point.parameter)).collect()
}

/// Two oscillators of frequencies 1 and √2 with the damping −p, and two of stiffness p: both pairs, and both zeros, pass at p = 0, where no
/// product of them changes its sign.
#[test]
fn what_passes_together_is_seen() {
    let model = |energy: &str, force: [&str; 2]| {
        let [x, y] = force;
        format!(
            r#"
coordinates = ["x", "y"]
parameters = {{ p = 0.1 }}
[lagrangian]
T = "1/2 (x'^2 + y'^2)"
V = "{energy}"
[forces]
x = "{x}"
y = "{y}"
"#
        )
    };
    let state = [("x", 0.0), ("y", 0.0), ("x'", 0.0), ("y'", 0.0)];
    let pairs = model("1/2 x^2 + y^2", ["p x' - x^2 x'", "p y' - y^2 y'"]);
    let mut frequencies = Vec::new();
    for (kind, at) in happens(&pairs, &state, (-0.31, 0.4)) {
        is_close(at, 0.0, 1e-6);
        let Kind::Hopf { frequency, .. } = kind else {
            panic!("{kind:?}");
        };
        frequencies.push(frequency);
    }
    frequencies.sort_by(f64::total_cmp);
    assert_eq!(frequencies.len(), 2);
    is_close(frequencies[0], 1.0, 1e-9);
    is_close(frequencies[1], 2.0_f64.sqrt(), 1e-9);
    let zeros = model("1/2 p x^2 + 1/2 p y^2", ["-x'", "-y'"]);
    let found = happens(&zeros, &state, (-0.31, 0.4));
    assert_eq!(found.len(), 1, "{found:?}");
    assert_eq!(found[0].0, Kind::BranchPoint);
    is_close(found[0].1, 0.0, 1e-6);
}

/// x'' = −x' − x/(p − 0.3): the eigenvalues go to infinity at p = 0.3, and none passes zero.
#[test]
fn an_eigenvalue_goes_to_infinity() {
    let text = r#"
coordinates = ["x"]
parameters = { p = 0.1 }
[lagrangian]
T = "1/2 x'^2"
V = "1/2 x^2/(p - 0.3)"
[forces]
x = "-x'"
"#;
    let found = happens(text, &[("x", 0.0), ("x'", 0.0)], (-0.31, 0.9));
    assert_eq!(found.len(), 1, "{found:?}");
    assert_eq!(found[0].0, Kind::Infinity);
    is_close(found[0].1, 0.3, 1e-6);
}

/// Two free particles beside an oscillator with the damping c: the family of steady motions has two dimensions, and the oscillator a Hopf point at
/// c = 0.
#[test]
fn families_of_two_dimensions_are_followed() {
    let (flow, _) = flow(
        r#"
coordinates = ["x", "y", "s"]
parameters = { c = 0.1 }
[lagrangian]
T = "1/2 x'^2 + 1/2 y'^2 + 1/2 s'^2"
V = "s^2"
[forces]
s = "-c s'"
"#,
        &[
            ("x", 0.0),
            ("y", 0.0),
            ("s", 0.0),
            ("x'", 1.0),
            ("y'", 2.0),
            ("s'", 0.0),
        ],
    );
    let start: Vec<f64> = flow
        .names
        .iter()
        .map(|name| match name.as_str() {
            "x'" => 1.0,
            "y'" => 2.0,
            _ => 0.0,
        })
        .collect();
    let found = curve(&flow, "c", (&start, 0.1), (-0.3, 0.3), points(300));
    assert_eq!(found.family, 2);
    let ends: Vec<f64> = [found.points.first(), found.points.last()]
        .map(|own| own.unwrap().parameter)
        .to_vec();
    assert!(
        (ends[0] + 0.3).abs() < 1e-9 && (ends[1] - 0.3).abs() < 1e-9,
        "{ends:?}"
    );
    let [hopf] = &found.special[..] else {
        panic!("{:?}", found.special);
    };
    assert!(hopf.point.parameter.abs() < 1e-9, "{hopf:?}");
}

/// x'' = −x' + f(x) with f(0) = 0: the origin is alone, and its eigenvalue 0, or one that is nearly so, is no zero of a family.
#[test]
fn isolated_zeros_belong_to_no_family() {
    for (force, expected) in [("x^3", 0.0), ("x^2", 0.0), ("1e-9 x", 1e-9)] {
        let (flow, _) = flow(
            &format!(
                "coordinates = [\"x\"]\nparameters = {{ c = 1 }}\n[lagrangian]\nT = \"1/2 x'^2\"\n[forces]\nx = \"-c x' + {force}\"\n"
            ),
            &[("x", 0.0), ("x'", 0.0)],
        );
        let c = flow.graph.intern_symbol("c", 0);
        let mut equations = Equilibria::new(&flow, Some(c)).unwrap();
        let (point, family) = solution(&mut equations, &[0.0, 0.0], 1.0).unwrap();
        assert_eq!(family, 0, "{force}");
        let values: Vec<f64> = point.spectrum.values.iter().map(|own| own.re).collect();
        assert_eq!(values.len(), 2, "{force}: {values:?}");
        assert!((values[0] + 1.0).abs() < 1e-8, "{force}: {values:?}");
        assert!((values[1] - expected).abs() < 1e-15, "{force}: {values:?}");
    }
}

/// Two oscillators lose their damping one after the other, at p = 0 and p = d, however near, and at d = 0 at once.
#[test]
fn two_pairs_pass_one_after_the_other_or_at_once() {
    let (flow, _) = flow(
        r#"
coordinates = ["x", "y"]
parameters = { p = -0.5, d = 0 }
[lagrangian]
L = "1/2 x'^2 - 1/2 x^2 + 1/2 y'^2 - y^2"
[forces]
x = "(p - x^2) x'"
y = "(p - d + y^2) y'"
"#,
        &[("x", 0.0), ("y", 0.0), ("x'", 0.0), ("y'", 0.0)],
    );
    let place = flow.place(flow.graph.intern_symbol("d", 0)).unwrap();
    for d in [0.0, 1e-7, 1e-4, 1e-2] {
        let mut flow = flow.clone();
        flow.parameters[place].1 = d;
        let start = (&[0.0; 4][..], -0.5);
        let found = curve(&flow, "p", start, (-1.0, 1.0), Pace::default());
        let mut all: Vec<(f64, f64, Option<f64>)> = found
            .special
            .iter()
            .map(|own| match own.kind {
                Kind::Hopf {
                    frequency,
                    first_lyapunov,
                } => (frequency, own.point.parameter, first_lyapunov.ok()),
                other => panic!("{other:?}"),
            })
            .collect();
        all.sort_by(|a, b| a.0.total_cmp(&b.0));
        assert_eq!(all.len(), 2, "{d}: {all:?}");
        let is_apart = d > 0.0;
        // With x = r cos t the mean of x² x'·x' is r⁴/8, and that of y with its own frequency of the other sign.
        for (own, at, sign) in [(all[0], 0.0, -1.0), (all[1], d, 1.0)] {
            is_close(own.1, at, 1e-10);
            assert_eq!(own.2.is_some(), is_apart, "{d}: {all:?}");
            assert!(own.2.is_none_or(|l| l * sign > 0.0));
        }
    }
}

/// x² = 1 − p² is a circle: the curve comes back to its start after two folds.
#[test]
fn a_closed_curve_is_followed_once() {
    let (flow, _) = flow(
        "coordinates = [\"x\"]\nparameters = { p = 0 }\n[lagrangian]\nL = \"1/2 x'^2 - x^3/3 + x - p^2 x\"\n",
        &[("x", 1.0), ("x'", 0.0)],
    );
    let pace = Pace::default();
    let found = curve(&flow, "p", (&[1.0, 0.0], 0.0), (-2.0, 2.0), pace);
    assert_eq!(found.ends, [End::Closed; 2]);
    let folds: Vec<f64> = found
        .special
        .iter()
        .map(|own| own.point.parameter)
        .collect();
    assert_eq!(folds.len(), 2, "{folds:?}");
    for (own, expected) in folds.iter().zip([-1.0_f64, 1.0]) {
        is_close(own.abs(), expected.abs(), 1e-12);
    }
    assert!(folds[0] * folds[1] < 0.0);
    assert!(found.special.iter().all(|own| own.kind == Kind::Fold));
    let [first, last] = [&found.points[0], &found.points[found.points.len() - 1]];
    assert_eq!(first.unknowns, last.unknowns);
}

/// x³ − e x = p has two folds at p = ± 2 (e/3)^(3/2), however near to each other they are.
#[test]
fn two_folds_within_one_step() {
    let (flow, _) = flow(
        "coordinates = [\"x\"]\nparameters = { p = 0.5, e = 1e-3 }\n[lagrangian]\nL = \"1/2 x'^2 - x^4/4 + e x^2/2 + p x\"\n[forces]\nx = \"-x'\"\n",
        &[("x", 0.8), ("x'", 0.0)],
    );
    let place = flow.place(flow.graph.intern_symbol("e", 0)).unwrap();
    for e in [1e-2, 1e-3, 1e-5_f64] {
        let mut flow = flow.clone();
        flow.parameters[place].1 = e;
        let start = (&[0.8, 0.0][..], 0.5);
        let found = curve(&flow, "p", start, (-0.6, 0.6), Pace::default());
        assert_eq!(found.special.len(), 2, "{e}: {:?}", found.special);
        for own in &found.special {
            assert_eq!(own.kind, Kind::Fold, "{e}");
            let at = own.point.parameter.abs();
            assert!(
                (at / (2.0 * (e / 3.0).powf(1.5)) - 1.0).abs() < 1e-5,
                "{e}: {at}"
            );
        }
    }
}

/// The flow of a model in its own units near a state, with the state in them.
fn in_units(flow: &Flow, state: &[f64]) -> (Flow, Vec<f64>, Units) {
    let units = flow.units_near(state);
    (flow.in_units(&units), units.packed(state), units)
}

/// x'' = −k² x + k p x' − k x² x' is x'' = −x + p x' − x² x' in the time k t: with the eigenvector (1, i k)/√(1 + k²) its coefficient is −1/2/(1 + k²),
/// from atoms to planets, beside a motion that dies away slowly too.
#[test]
fn the_first_lyapunov_coefficient_at_all_rates() {
    for k in [1e-15, 1e-7, 1e-4, 1.0, 1e5, 1e6, 1e15_f64] {
        let (flow, _) = flow(
            &format!(
                "coordinates = [\"x\", \"y\"]\nparameters = {{ k = {k:e} }}\n[lagrangian]\nT = \"1/2 (x'^2 + y'^2)\"\n[forces]\n\
                 x = \"-k^2 x - k x^2 x'\"\ny = \"-k y' - k^2 y/10^4\"\n"
            ),
            &[("x", 0.0), ("y", 0.0), ("x'", 0.0), ("y'", 0.0)],
        );
        let (flow, state, units) = in_units(&flow, &[0.0; 4]);
        let parameters: Vec<f64> = flow.parameters.iter().map(|own| own.1).collect();
        let slopes = flow.slopes(&state, &parameters).unwrap();
        let found = first_lyapunov(&flow, (&state, &parameters), (&slopes, 0)).unwrap();
        is_close(found.frequency * units.rate / k, 1.0, 1e-12);
        is_close(found.coefficient * (1.0 + k * k), -0.5, 1e-9);
    }
}

/// A zero eigenvalue beside the pair belongs to no family: y' = −y² stands still at y = 0 alone.
#[test]
fn a_zero_beside_a_pair_is_no_family_by_itself() {
    let (flow, _) = flow(
        "coordinates = [\"x\", \"y\"]\n[lagrangian]\nT = \"1/2 (x'^2 + y'^2)\"\n[forces]\nx = \"-x - x^2 x'\"\ny = \"-y' - y^2\"\n",
        &[("x", 0.0), ("y", 0.0), ("x'", 0.0), ("y'", 0.0)],
    );
    let slopes = flow.slopes(&[0.0; 4], &[]).unwrap();
    let found = first_lyapunov(&flow, (&[0.0; 4], &[]), (&slopes, 0));
    assert_eq!(
        found,
        Err(WithoutLyapunov::Zeros {
            zeros: 1,
            levels: 0
        })
    );
}

/// x'' = p − (x/l)² − x' stands still at x = ± l √p, and the curve turns at p = 0 alone.
#[test]
fn a_fold_at_all_lengths() {
    for l in [1e-10, 1.0, 1e9_f64] {
        let (flow, _) = flow(
            &format!(
                "coordinates = [\"x\"]\nparameters = {{ p = 1, l = {l:e} }}\n[lagrangian]\nT = \"1/2 x'^2\"\n[forces]\nx = \"p - x^2/l^2 - x'\"\n"
            ),
            &[("x", l), ("x'", 0.0)],
        );
        let (own, state, units) = in_units(&flow, &[l, 0.0]);
        let found = curve(&own, "p", (&state, 1.0), (-1.0, 2.0), Pace::default());
        let found = found.restored(&units, false);
        assert_eq!(found.special.len(), 1, "{l}: {:?}", found.special);
        assert_eq!(found.special[0].kind, Kind::Fold);
        assert!(found.special[0].point.parameter.abs() < 1e-9);
        for point in &found.points {
            let (p, x) = (point.parameter, point.unknowns[0]);
            is_close(x * x / (l * l), p, 1e-9);
            // λ² + λ + 2 x/l² = 0.
            let sum: f64 = point.spectrum.values.iter().map(|l| l.re).sum();
            is_close(sum, -1.0, 1e-9);
        }
    }
}

/// What is zero at every value of the parameter passes nothing there. Two masses 1 and 2 with a spring k = p between them move freely together:
/// λ² (2 λ² + 3 c λ + 3 p) has the double zero of a chain, and its others are zero at p = 0 alone; x'' = −p x' + x³ has the zero of a motion that is
/// no member of a family. Beside the chain an oscillator of stiffness p passes zero at p = 0, from either side and at the start itself.
#[test]
fn zeros_along_the_whole_curve_pass_nothing() {
    let free = |c: f64, more: &str| {
        format!(
            "coordinates = [\"x\", \"y\", \"s\"]\nparameters = {{ p = 1 }}\n[lagrangian]\nL = \"1/2 x'^2 + y'^2 + 1/2 s'^2 - {more}\"\n[forces]\nx = \"-{c} (x' - y')\"\ny = \"-{c} (y' - x')\"\ns = \"-s'\"\n"
        )
    };
    let state = [
        ("x", 0.0),
        ("y", 0.0),
        ("s", 0.0),
        ("x'", 0.0),
        ("y'", 0.0),
        ("s'", 0.0),
    ];
    for c in [0.0, 0.1] {
        let spring = free(c, "1/2 p (y - x)^2 - 1/2 s^2");
        assert_eq!(happens(&spring, &state, (1.0, 2.0)), [], "c = {c}");
        let beside = free(c, "1/2 (y - x)^2 - 1/2 p s^2");
        for range in [(-1.0, 2.0), (-1.0, 0.0), (-0.7, 0.1)] {
            let found = happens(&beside, &state, range);
            if range.1 == 0.0 {
                assert!(found.len() <= 1, "{found:?}");
                continue;
            }
            assert_eq!(found.len(), 1, "c = {c}: {found:?}");
            assert_eq!(found[0].0, Kind::BranchPoint);
            is_close(found[0].1, 0.0, 1e-12);
        }
    }
    // They are among the eigenvalues, beside a pair on the axis.
    let (flow, _) = flow(&free(0.0, "1/2 p (y - x)^2 - 1/2 s^2"), &state);
    let found = curve(&flow, "p", (&[0.0; 6], 1.0), (1.0, 2.0), points(300));
    for point in &found.points {
        let values = &point.spectrum.values;
        let zeros = values.iter().filter(|l| l.norm() == 0.0).count();
        assert_eq!((values.len(), zeros, found.family), (5, 1, 1), "{values:?}");
    }
    let alone = "coordinates = [\"x\"]\nparameters = { p = 1 }\n[lagrangian]\nT = \"1/2 x'^2\"\n[forces]\nx = \"-p x' + x^3\"\n";
    let found = happens(alone, &[("x", 0.0), ("x'", 0.0)], (0.5, 1.5));
    assert_eq!(found, []);
}
