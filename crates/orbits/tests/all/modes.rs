//! Linear equations along motions, and their modes.
#![allow(
    clippy::unwrap_used,
    clippy::excessive_precision,
    reason = "test code fails where it stands, and has the digits of its sources"
)]

use crate::common::{flow, is_close};
use chetaev_integrate::Output;
use chetaev_mechanics::{Prepared, System};
use chetaev_model::load;
use chetaev_orbits::along::along;
use chetaev_orbits::mode::{Deviation, LinearMotion};
use chetaev_stability::eigenvalues::{eigenvalues, modes, Complex};
use chetaev_stability::linearization::linearize;
use chetaev_symbolic::Expr;
use std::collections::BTreeMap;

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
        let vector = modes(&left, &right, (l, 1)).unwrap().remove(0);
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
