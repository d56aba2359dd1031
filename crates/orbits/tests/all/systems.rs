//! Mechanical systems.
#![allow(
    clippy::unwrap_used,
    clippy::excessive_precision,
    reason = "test code fails where it stands, and has the digits of its sources"
)]

use crate::points;
use chetaev_integrate::Output;
use chetaev_mechanics::{Prepared, System};
use chetaev_model::load;
use chetaev_orbits::along::along;
use chetaev_orbits::branch::{follow, solution, End, Kind, Pace};
use chetaev_orbits::equilibria::Equilibria;
use chetaev_orbits::flow::Coordinates;
use chetaev_orbits::mode::{Deviation, LinearMotion};
use chetaev_orbits::periodic::Shooting;
use chetaev_orbits::sensitivity::{sensitivities, Beginning};
use chetaev_orbits::variational::Order;
use chetaev_orbits::{Flow, OrbitError};
use chetaev_stability::eigenvalues::{eigenvalues, mode, Complex};
use chetaev_stability::linearization::linearize;
use chetaev_symbolic::{Expr, Symbol};
use std::collections::BTreeMap;

/// The flow of a model at a state, and the reading of its expressions.
fn flow(text: &str, state: &[(&str, f64)]) -> (Flow, impl Fn(&str) -> Expr) {
    let text = format!("name = \"case\"\n{text}");
    let loaded = load("case.toml", &text, &BTreeMap::new(), &[]);
    let model = loaded
        .model
        .unwrap_or_else(|| panic!("{}", loaded.diagnostics));
    let system = System::from_model(&model).unwrap();
    let prepared = Prepared::new(&system).unwrap();
    let symbol = |name: &str| {
        let order = name.chars().filter(|c| *c == '\'').count();
        system
            .graph
            .intern_symbol(name.trim_end_matches('\''), order as u32)
    };
    let mut point: Vec<(Symbol, f64)> = state.iter().map(|(name, x)| (symbol(name), *x)).collect();
    let values = system.parameters.iter().filter_map(|p| {
        let value = system.graph.evaluate_f64(&[p.value?], &|_| None).ok()?[0];
        Some((system.graph.as_symbol(p.expr)?, value))
    });
    point.extend(values);
    let (terms, selection) = (&prepared.terms, &prepared.selection);
    let which = (Coordinates::NotIgnorable, &point[..]);
    let flow = Flow::of_system(&system, terms, selection, which).unwrap();
    (flow, move |text: &str| model.expression(text).unwrap())
}

fn is_close(found: f64, expected: f64, tolerance: f64) {
    let error = (found - expected).abs() / (1.0 + expected.abs());
    assert!(
        error <= tolerance,
        "{found} instead of {expected}: {error:e}"
    );
}

/// Kapitza's pendulum stands upright above Ω = 99.260834704…, where the leading order says √(2 g l)/a = 99.0454 (−4 g/(l Ω²) = a₀(2 a/l), McLachlan
/// 1947): a multiplier passes 1 there.
#[test]
fn kapitza() {
    let (flow, read) = flow(
        r#"
coordinates = ["theta"]
parameters = { l = 0.2, a = 0.02, g = 9.81, Omega = 90 }
[lagrangian]
T = "1/2 l^2 theta'^2 + l a Omega sin(Omega t) sin(theta) theta'"
V = "g l cos(theta)"
"#,
        &[("theta", 0.0), ("theta'", 0.0)],
    );
    assert_eq!(flow.is_turning, [true, false]);
    let omega = flow.graph.intern_symbol("Omega", 0);
    let period = read("2 pi/Omega");
    let mut orbits = Shooting::new(&flow, Some(omega), Some(period)).unwrap();
    for (at, trace) in [
        (90.0, 2.043_533_501_022_299),
        (100.0, 1.997_047_941_829_981_9),
        (200.0, 1.850_751_692_323_900_4),
    ] {
        is_close(
            orbits.monodromy(&[0.0, 0.0], at).unwrap().trace(),
            trace,
            1e-12,
        );
    }
    let found = follow(&mut orbits, (&[0.0, 0.0], 90.0), (90.0, 110.0), points(500)).unwrap();
    assert_eq!(found.special.len(), 1, "{:?}", found.special);
    assert_eq!(found.special[0].kind, Kind::BranchPoint);
    is_close(
        found.special[0].point.parameter,
        99.260_834_704_054_84,
        1e-10,
    );
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
    let eps = flow.graph.intern_symbol("eps", 0);
    let mut equations = Equilibria::new(&flow, Some(eps)).unwrap();
    let found = follow(
        &mut equations,
        (&[0.9, 0.0, 1.3], 0.6),
        (0.1, 1.0),
        points(300),
    )
    .unwrap();
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
    let a = flow.graph.intern_symbol("a", 0);
    let mut equations = Equilibria::new(&flow, Some(a)).unwrap();
    let found = follow(&mut equations, (&[1.5, 0.0], 0.3), (-0.5, 0.5), points(300)).unwrap();
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
    let g = flow.graph.intern_symbol("g", 0);
    let mut equations = Equilibria::new(&flow, Some(g)).unwrap();
    let start = [1.0, 0.0, 4.0];
    let pace = Pace {
        step: 0.01,
        ..points(500)
    };
    let found = follow(&mut equations, (&start, 9.0), (1.0, 20.0), pace).unwrap();
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
    let parameter = flow.graph.intern_symbol("p", 0);
    let mut equations = Equilibria::new(&flow, Some(parameter)).unwrap();
    let found = follow(&mut equations, (&[0.0; 4], 1.5), (-1.0, 1.9), points(500)).unwrap();
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
    let parameter = flow.graph.intern_symbol("p", 0);
    let mut equations = Equilibria::new(&flow, Some(parameter)).unwrap();
    let found = follow(&mut equations, (&[0.0; 4], 1.0), (0.0, 3.0), points(300)).unwrap();
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
    let found = chetaev_orbits::branch::solution(&mut equations, &[0.3, 0.0], 0.0);
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

/// A force cos(1.2 t) repeats after 2π/1.2 and its multiples: what closes after another time is no periodic orbit.
#[test]
fn a_period_is_one_of_the_force() {
    let (flow, read) = flow(
        r#"
coordinates = ["x"]
parameters = { w = 1.2, F = 0.3 }
[lagrangian]
L = "1/2 x'^2 - 1/2 x^2 - 1/4 x^4"
[forces]
x = "-0.1 x' + F cos(w t)"
"#,
        &[("x", 0.0), ("x'", 0.0)],
    );
    let orbit = |period: &str| {
        let mut orbits = Shooting::new(&flow, None, Some(read(period))).unwrap();
        chetaev_orbits::branch::solution(&mut orbits, &[0.0, 0.0], 0.0)
    };
    let Err(OrbitError::NotRepeated { own, .. }) = orbit("3") else {
        panic!("an orbit of another period than the force");
    };
    assert_eq!(own.len(), 1);
    is_close(own[0], 2.0 * std::f64::consts::PI / 1.2, 1e-15);
    assert!(orbit("2 pi/w").is_ok());
    assert!(orbit("4 pi/w").is_ok());
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
    let rate = flow.graph.intern_symbol("W", 0);
    let mut equations = Equilibria::new(&flow, Some(rate)).unwrap();
    let lowest = follow(&mut equations, (&[0.0, 0.0], 3.0), (2.0, 8.0), points(300)).unwrap();
    assert_eq!(lowest.special.len(), 1, "{:?}", lowest.special);
    assert_eq!(lowest.special[0].kind, Kind::BranchPoint);
    let critical = (9.81_f64 / 0.5).sqrt();
    is_close(lowest.special[0].point.parameter, critical, 1e-12);
    let side = follow(&mut equations, (&[1.0, 0.0], 6.0), (2.0, 8.0), points(300)).unwrap();
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
    let parameter = flow.graph.intern_symbol("p", 0);
    let mut equations = Equilibria::new(&flow, Some(parameter)).unwrap();
    let start: Vec<f64> = state.iter().map(|own| own.1).collect();
    let found = follow(&mut equations, (&start, range.1), range, points(300)).unwrap();
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

/// A pendulum on a large orbit: its period is 4 K(sin(α/2)) √(l/g), and both multipliers are 1, of the energy and along the orbit.
#[test]
fn a_pendulum() {
    let (flow, _) = flow(
        r#"
coordinates = ["theta"]
parameters = { l = 1, g = 1 }
[lagrangian]
T = "1/2 l^2 theta'^2"
V = "-g l cos(theta)"
"#,
        &[("theta", 2.0), ("theta'", 0.0)],
    );
    let mut orbits = Shooting::new(&flow, None, None).unwrap();
    let guess = chetaev_orbits::periodic::period_guess(&flow, &[2.0, 0.0], 30.0).unwrap();
    let start = orbits.unknowns(&[2.0, 0.0], guess);
    let (orbit, family) = chetaev_orbits::branch::solution(&mut orbits, &start, 0.0).unwrap();
    assert_eq!(family, 1, "{guess} {orbit:?}");
    assert_eq!(
        orbit.spectrum.trivial,
        ["the direction along the orbit", "the energy"]
    );
    assert!(orbit.spectrum.values.is_empty());
    // The amplitude by the energy; K by the arithmetic-geometric mean (Gauss).
    let energy = 0.5 * orbit.unknowns[1].powi(2) - orbit.unknowns[0].cos();
    let k = ((1.0 + energy) / 2.0).sqrt();
    let (mut a, mut b) = (1.0, (1.0 - k * k).sqrt());
    for _ in 0..8 {
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    is_close(orbit.unknowns[2], 2.0 * std::f64::consts::PI / a, 1e-12);
}

/// The model of a text, as a system.
fn system(text: &str) -> (System, Prepared) {
    let text = format!("name = \"case\"\n{text}");
    let loaded = load("case.toml", &text, &BTreeMap::new(), &[]);
    let model = loaded
        .model
        .unwrap_or_else(|| panic!("{}", loaded.diagnostics));
    let system = System::from_model(&model).unwrap();
    let prepared = Prepared::new(&system).unwrap();
    (system, prepared)
}

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

/// A pendulum in Cartesian coordinates and all velocities: its period is 4 K(sin(α/2)) √(l/g), and of its four multipliers, all 1, two are of the
/// constraint and its rate, one of the energy, which is constant on these alone, and one along the orbit.
#[test]
fn an_orbit_in_all_velocities() {
    let (system, prepared) = system(
        "coordinates = [\"x\", \"y\"]\n[lagrangian]\nL = \"1/2 (x'^2 + y'^2) - y\"\n[constraints]\nrod = \"x^2 + y^2 = 1\"\n",
    );
    let (terms, selection) = (&prepared.terms, &prepared.selection);
    let flow =
        Flow::in_all_velocities(&system, terms, selection, Coordinates::NotIgnorable).unwrap();
    assert_eq!(flow.names, ["x", "y", "x'", "y'"]);
    let (sin, cos) = 1.0_f64.sin_cos();
    let mut orbits = Shooting::new(&flow, None, None).unwrap();
    let start = orbits.unknowns(&[sin, -cos, 0.0, 0.0], 6.7);
    let (orbit, _) = chetaev_orbits::branch::solution(&mut orbits, &start, 0.0).unwrap();
    let own = &orbit.unknowns;
    let energy = 0.5 * (own[2] * own[2] + own[3] * own[3]) + own[1];
    let k = ((1.0 + energy) / 2.0).sqrt();
    let (mut a, mut b) = (1.0, (1.0 - k * k).sqrt());
    for _ in 0..8 {
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    is_close(own[4], 2.0 * std::f64::consts::PI / a, 1e-10);
    assert!(orbit.spectrum.values.is_empty(), "{:?}", orbit.spectrum);
    let finite = "a finite constraint";
    assert_eq!(
        orbit.spectrum.trivial,
        [
            "the direction along the orbit",
            finite,
            finite,
            "the energy"
        ]
    );
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

/// Along a uniform motion A does not change, and the transition matrix is e^{A t}; the exponents of an oscillator vanish.
#[test]
fn linear_equations_along_a_motion() {
    let (flow, _) = flow(
        r#"
coordinates = ["x"]
parameters = { k = 4 }
[lagrangian]
T = "1/2 x'^2"
V = "1/2 k x^2"
"#,
        &[("x", 1.0), ("x'", 0.0)],
    );
    let rows = along(&flow, &[1.0, 0.0], (0.0, 100.0), Output::Every(0.5)).unwrap();
    for own in &rows {
        assert_eq!(own.matrix.as_slice(), [0.0, -4.0, 1.0, 0.0]);
        let (sin, cos) = (2.0 * own.t).sin_cos();
        for (found, expected) in own.transition.iter().zip([cos, -2.0 * sin, 0.5 * sin, cos]) {
            is_close(*found, expected, 1e-12);
        }
    }
    let exponents = rows.last().unwrap().exponents(0.0).unwrap();
    assert!(exponents.iter().all(|l| l.abs() < 0.01), "{exponents:?}");
}

/// An eigenvalue with its vector.
type ModeOf = (Complex<f64>, Vec<(f64, f64)>);

/// The motions beside the steady motion that a model states, and the modes.
fn linear(text: &str) -> (LinearMotion, Vec<ModeOf>) {
    let loaded = load("case.toml", text, &BTreeMap::new(), &[]);
    let model = loaded
        .model
        .unwrap_or_else(|| panic!("{}", loaded.diagnostics));
    let system = System::from_model(&model).unwrap();
    let prepared = Prepared::new(&system).unwrap();
    let (terms, selection) = (&prepared.terms, &prepared.selection);
    let motion = &system.steady[0];
    let values = system.parameter_values();
    let own = linearize(&system, terms, selection, motion, &values).unwrap();
    let numbers = |rows: &[Vec<Expr>]| -> Vec<Vec<f64>> {
        let g = &system.graph;
        let row = |row: &Vec<Expr>| g.evaluate_f64(row, &|_| None).unwrap();
        rows.iter().map(row).collect()
    };
    let (left, right) = (numbers(&own.left), numbers(&own.right));
    let modes = eigenvalues(&left, &right).unwrap().into_iter().map(|l| {
        let vector = mode(&left, &right, l).unwrap();
        (l, vector.iter().map(|z| (z.re, z.im)).collect())
    });
    let modes = modes.collect();
    (
        LinearMotion::new(&system, terms, selection, (motion, &own)).unwrap(),
        modes,
    )
}

/// Two equal pendulums one below the other: ω² = (2 ∓ √2) g/l, with the angles as 1 : ±√2 (Landau and Lifshitz, Mechanics, § 23).
#[test]
fn modes_of_a_double_pendulum() {
    let (mut motions, modes) = linear(
        "name = \"double\"\ncoordinates = [\"a\", \"b\"]\n[lagrangian]\nL = \"a'^2 + 1/2 b'^2 + a' b' cos(a - b) + 2 cos(a) + cos(b)\"\n[steady.hanging]\na = 0\nb = 0\n\"a'\" = 0\n\"b'\" = 0\n",
    );
    let root = std::f64::consts::SQRT_2;
    let mut seen = 0;
    for (eigenvalue, vector) in modes.into_iter().filter(|(l, _)| l.im > 0.0) {
        let is_slow = eigenvalue.im < 1.0;
        let omega = if is_slow { 2.0 - root } else { 2.0 + root }.sqrt();
        is_close(eigenvalue.im, omega, 1e-12);
        let own = Deviation {
            eigenvalue: (0.0, eigenvalue.im),
            vector,
            size: 0.3,
            from: 0.0,
        };
        let times: Vec<f64> = (0..=20).map(|i| 0.1 * f64::from(i)).collect();
        let rows = motions.rows(&times, Some(&own)).unwrap();
        let start = &rows[0];
        let ratio = if is_slow { root } else { -root };
        for (t, row) in times.iter().zip(&rows) {
            is_close(row[1], ratio * row[0], 1e-12);
            // Of a mode at rest in the beginning or with a phase: both coordinates in step.
            let expected = start[0] * (omega * t).cos() + start[2] / omega * (omega * t).sin();
            is_close(row[0], expected, 1e-12);
        }
        assert!(motions.is_angle(0) && motions.is_angle(1));
        seen += 1;
    }
    assert_eq!(seen, 2);
}

/// Chaplygin's sleigh with m = a = J + m a² = 1 at speed 1: the turning dies as e^{-t}, and the heading and the place follow from it exactly,
/// `phi = W (1 − e^{-t})`, `x' = cos(phi)`; at rest in its variables it runs straight on.
#[test]
fn a_mode_of_a_sleigh_leads_elsewhere() {
    let (mut motions, modes) = linear(
        "name = \"sleigh\"\ncoordinates = [\"x\", \"y\", \"phi\"]\n[lagrangian]\nL = \"1/2 ((x' - phi' sin(phi))^2 + (y' + phi' cos(phi))^2)\"\n[constraints]\nblade = \"x' sin(phi) = y' cos(phi)\"\n[steady.straight]\nphi = 0\n\"x'\" = 1\n\"phi'\" = 0\n",
    );
    let (eigenvalue, vector) = modes.into_iter().next().unwrap();
    is_close(eigenvalue.re, -1.0, 1e-12);
    let times = [0.0, 0.5, 1.0, 3.0];
    for row in motions.rows(&times, None).unwrap().iter().zip(times) {
        let (row, t) = row;
        is_close(row[0], t, 1e-8);
        is_close(row[2], 0.0, 1e-8);
    }
    let own = Deviation {
        eigenvalue: (-1.0, 0.0),
        vector,
        size: 0.4,
        from: 0.0,
    };
    let rows = motions.rows(&times, Some(&own)).unwrap();
    let turning = rows[0][5];
    assert!((turning.abs() - 0.4).abs() < 1e-9, "{turning}");
    for (row, t) in rows.iter().zip(times) {
        is_close(row[5], turning * (-t).exp(), 1e-8);
        is_close(row[2], turning * (1.0 - (-t).exp()), 1e-7);
        is_close(row[3], row[2].cos(), 1e-7);
        is_close(row[4], row[2].sin(), 1e-7);
    }
    // Simpson's rule over x' = cos(phi(t)).
    let slope = |t: f64| (turning * (1.0 - (-t).exp())).cos();
    let steps = 3000;
    let h = 3.0 / f64::from(steps);
    let weight = |i: i32| {
        if i == 0 || i == steps {
            1.0
        } else if i % 2 == 1 {
            4.0
        } else {
            2.0
        }
    };
    let integral: f64 = (0..=steps)
        .map(|i| weight(i) * slope(h * f64::from(i)))
        .sum();
    is_close(rows[3][0], integral * h / 3.0, 1e-7);
}

/// The same boundary of Mathieu's equation from a model.
#[test]
fn mathieu_from_a_model() {
    let (flow, read) = flow(
        r#"
coordinates = ["x"]
parameters = { a = 0.3, q = 0.5 }
[lagrangian]
T = "1/2 x'^2"
V = "1/2 (a - 2 q cos(2 t)) x^2"
"#,
        &[("x", 0.0), ("x'", 0.0)],
    );
    let a = flow.graph.intern_symbol("a", 0);
    let mut orbits =
        chetaev_orbits::periodic::Shooting::new(&flow, Some(a), Some(read("pi"))).unwrap();
    let found = follow(&mut orbits, (&[0.0, 0.0], 0.3), (-1.0, 5.0), points(500)).unwrap();
    is_close(
        found.special[0].point.parameter,
        -0.121_765_544_941_082_72,
        2e-12,
    );
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
    let c = flow.graph.intern_symbol("c", 0);
    let mut equations = Equilibria::new(&flow, Some(c)).unwrap();
    let start: Vec<f64> = flow
        .names
        .iter()
        .map(|name| match name.as_str() {
            "x'" => 1.0,
            "y'" => 2.0,
            _ => 0.0,
        })
        .collect();
    let found = follow(&mut equations, (&start, 0.1), (-0.3, 0.3), points(300)).unwrap();
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
