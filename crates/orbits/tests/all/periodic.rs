//! Periodic orbits of mechanical systems and their multipliers.
#![allow(
    clippy::unwrap_used,
    clippy::excessive_precision,
    reason = "test code fails where it stands, and has the digits of its sources"
)]

use crate::common::{flow, is_close, system};
use crate::points;
use chetaev_integrate::Output;
use chetaev_orbits::along::along;
use chetaev_orbits::branch::{End, Kind};
use chetaev_orbits::continuation::follow;
use chetaev_orbits::flow::Coordinates;
use chetaev_orbits::periodic::{period_guess, Shooting};
use chetaev_orbits::solution::solution;
use chetaev_orbits::{Flow, OrbitError};
use nalgebra::DMatrix;

/// Kapitza's pendulum upright: its pivot is shaken as a cos Ωt.
fn kapitza(a: &str, rate: &str) -> String {
    format!(
        r#"
coordinates = ["theta"]
parameters = {{ l = 0.2, a = {a}, g = 9.81, Omega = {rate} }}
[lagrangian]
T = "1/2 l^2 theta'^2 + l a Omega sin(Omega t) sin(theta) theta'"
V = "g l cos(theta)"
"#
    )
}

/// Kapitza's pendulum stands upright above Ω = 99.260834704…, where the leading order says √(2 g l)/a = 99.0454 (−4 g/(l Ω²) = a₀(2 a/l), McLachlan
/// 1947): a multiplier passes 1 there.
#[test]
fn kapitza_from_a_rate_on() {
    let (flow, read) = flow(&kapitza("0.02", "90"), &[("theta", 0.0), ("theta'", 0.0)]);
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

/// Shaken with half its length Kapitza's pendulum stands between two rates: −4 g/(l Ω²) from a₀(1) = −0.4551386… to b₁(1) = −0.1102488… of Mathieu's
/// equation with q = 2 a/l = 1 (McLachlan 1947), where a multiplier passes 1 and −1. With a = 0.02 there is no upper rate: b₁(0.2) = 0.795… is positive.
#[test]
fn kapitza_between_two_rates() {
    let (flow, read) = flow(&kapitza("0.1", "30"), &[("theta", 0.0), ("theta'", 0.0)]);
    let omega = flow.graph.intern_symbol("Omega", 0);
    let mut orbits = Shooting::new(&flow, Some(omega), Some(read("2 pi/Omega"))).unwrap();
    let found = follow(&mut orbits, (&[0.0, 0.0], 30.0), (15.0, 60.0), points(500)).unwrap();
    let rate = |characteristic: f64| (4.0 * 9.81 / (0.2 * characteristic)).sqrt();
    let expected = [
        (rate(0.455_138_604_107_413_548), Kind::BranchPoint),
        (rate(0.110_248_816_992_095_17), Kind::PeriodDoubling),
    ];
    assert_eq!(found.special.len(), 2, "{:?}", found.special);
    for (own, (at, kind)) in found.special.iter().zip(expected) {
        is_close(own.point.parameter, at, 1e-9);
        assert_eq!(own.kind, kind);
    }
    // The characteristic value itself, in the equation with q = 0.2.
    let (flow, read) = mathieus("a = 0.6, q = 0.2");
    let a = flow.graph.intern_symbol("a", 0);
    let mut orbits = Shooting::new(&flow, Some(a), Some(read("pi"))).unwrap();
    let found = follow(&mut orbits, (&[0.0, 0.0], 0.6), (0.3, 1.0), points(500)).unwrap();
    assert_eq!(found.special.len(), 1, "{:?}", found.special);
    is_close(
        found.special[0].point.parameter,
        0.795_123_868_083_863_287,
        2e-12,
    );
    assert_eq!(found.special[0].kind, Kind::PeriodDoubling);
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
        solution(&mut orbits, &[0.0, 0.0], 0.0)
    };
    let Err(OrbitError::NotRepeated { own, .. }) = orbit("3") else {
        panic!("an orbit of another period than the force");
    };
    assert_eq!(own.len(), 1);
    is_close(own[0], 2.0 * std::f64::consts::PI / 1.2, 1e-15);
    assert!(orbit("2 pi/w").is_ok());
    assert!(orbit("4 pi/w").is_ok());
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
    let (orbit, family) = solution(&mut orbits, &start, 0.0).unwrap();
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
    let (orbit, _) = solution(&mut orbits, &start, 0.0).unwrap();
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

/// Mathieu's equation with these parameters.
fn mathieus(parameters: &str) -> (Flow, impl Fn(&str) -> chetaev_symbolic::Expr) {
    let head = format!("coordinates = [\"x\"]\nparameters = {{ {parameters} }}\n");
    let energies = "[lagrangian]\nT = \"1/2 x'^2\"\nV = \"1/2 (a - 2 q cos(2 t)) x^2\"\n";
    let at_rest = [("x", 0.0), ("x'", 0.0)];
    flow(&format!("{head}{energies}"), &at_rest)
}

/// The same boundary of Mathieu's equation from a model.
#[test]
fn mathieu_from_a_model() {
    let (flow, read) = mathieus("a = 0.3, q = 0.5");
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

/// x'' = −4 x − x³ from rest at x = 1 has the period 4 K(1/10)/√5 (Byrd and Friedman 1971, 213), and the guess is as good.
#[test]
fn the_period_of_a_start_on_an_orbit() {
    let (flow, _) = flow(
        "coordinates = [\"x\"]\n[lagrangian]\nL = \"1/2 x'^2 - 2 x^2 - x^4/4\"\n",
        &[("x", 1.0), ("x'", 0.0)],
    );
    let found = period_guess(&flow, &[1.0, 0.0], 20.0).unwrap();
    is_close(found, 4.0 * 1.612_441_348_720_219_4 / 5.0_f64.sqrt(), 1e-12);
}

/// Orbits of (mu − x²) x' end at mu = 0 where they shrink to rest; beyond it the same orbits would come again, half a period later.
#[test]
fn orbits_shrink_to_rest() {
    let (flow, _) = flow(
        "coordinates = [\"x\"]\nparameters = { mu = 0.5 }\n[lagrangian]\nL = \"1/2 x'^2 - 1/2 x^2\"\n[forces]\nx = \"(mu - x^2) x'\"\n",
        &[("x", 1.4), ("x'", 0.0)],
    );
    let mu = flow.graph.intern_symbol("mu", 0);
    let mut orbits = Shooting::new(&flow, Some(mu), None).unwrap();
    let start = orbits.unknowns(&[1.4, 0.0], 6.4);
    let found = follow(&mut orbits, (&start, 0.5), (-0.2, 0.6), points(200)).unwrap();
    assert_eq!(found.ends, [End::Steady, End::Range]);
    assert!(found.special.is_empty(), "{:?}", found.special);
    let first = &found.points[0];
    assert!(first.parameter.abs() < 1e-6 && first.unknowns[0].abs() < 1e-2);
    assert!(found.points.iter().all(|own| own.unknowns[0] > 0.0));
}

/// The orbit of van der Pol at μ = 1 has the period 6.663286859… (Urabe 1958) over the rate k, and one multiplier, 8.596951e-4, at every rate and length.
#[test]
fn one_orbit_at_all_rates_and_lengths() {
    for (k, l) in [
        (1.0, 1.0),
        (1e-7, 1.0),
        (1e6, 1.0),
        (1e-7, 1e11),
        (1e13, 1e-10_f64),
    ] {
        let (flow, _) = flow(
            &format!(
                "coordinates = [\"x\"]\nparameters = {{ k = {k:e}, l = {l:e} }}\n[lagrangian]\nT = \"1/2 x'^2\"\n[forces]\nx = \"-k^2 x + k (1 - x^2/l^2) x'\"\n"
            ),
            &[("x", 2.0 * l), ("x'", 0.0)],
        );
        let start = [2.0 * l, 0.0];
        let units = flow.units_near(&start);
        let (flow, start) = (flow.in_units(&units), units.packed(&start));
        let mut orbits = Shooting::new(&flow, None, None).unwrap();
        let period = period_guess(&flow, &start, 20.0 / k * units.rate).unwrap();
        let unknowns = orbits.unknowns(&start, period);
        let (found, _) = solution(&mut orbits, &unknowns, 0.0).unwrap();
        is_close(found.unknowns[2] / units.rate * k, 6.663_286_859_323, 1e-9);
        is_close(found.spectrum.values[0].re / 8.596_951e-4, 1.0, 1e-6);
    }
}

/// The exponents of a pendulum in Cartesian coordinates are those of admissible neighbours: two, as in the angle.
#[test]
fn exponents_are_those_of_admissible_motions() {
    let (system, prepared) = system(
        "coordinates = [\"x\", \"y\"]\n[lagrangian]\nL = \"1/2 (x'^2 + y'^2) - 9.81 y\"\n[constraints]\nrod = \"x^2 + y^2 = 1\"\n",
    );
    let (terms, selection) = (&prepared.terms, &prepared.selection);
    let flow = Flow::in_all_velocities(&system, terms, selection, Coordinates::All).unwrap();
    let (sin, cos) = 0.4_f64.sin_cos();
    let rows = along(&flow, &[sin, -cos, 0.0, 0.0], (0.0, 1.5), Output::End).unwrap();
    let exponents = rows.last().unwrap().exponents(0.0).unwrap();
    assert_eq!(exponents.len(), 2);
    // A flow that keeps areas: the exponents add up to zero but for the lengths of the vectors of both ends, that of the end with its rate.
    let of_angle = {
        let (flow, _) = crate::common::flow(
            "coordinates = [\"th\"]\n[lagrangian]\nL = \"1/2 th'^2 + 9.81 cos(th)\"\n",
            &[("th", 0.4), ("th'", 0.0)],
        );
        along(&flow, &[0.4, 0.0], (0.0, 1.5), Output::End).unwrap()
    };
    // (x, y, x', y') from (θ, θ'): columns of length (1 + θ'²)^½ and 1, not orthogonal where θ' ≠ 0.
    let (end, rate) = (of_angle.last().unwrap(), of_angle.last().unwrap().state[1]);
    let lift = |th: f64, v: f64| {
        let (s, c) = th.sin_cos();
        DMatrix::from_row_slice(4, 2, &[c, 0.0, s, 0.0, -s * v, c, c * v, s])
    };
    let image = lift(end.state[0], rate) * &end.transition;
    let gram = image.tr_mul(&image).symmetric_eigenvalues();
    let mut expected: Vec<f64> = gram.iter().map(|l| l.ln() / 2.0 / 1.5).collect();
    expected.sort_by(|a, b| b.total_cmp(a));
    for (own, wanted) in exponents.iter().zip(expected) {
        is_close(*own, wanted, 1e-9);
    }
}
