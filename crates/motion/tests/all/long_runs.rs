//! Long runs by series: rounding is all that the energy loses, also where an angle grows without bound.

#![allow(clippy::unwrap_used, reason = "test code fails where it stands")]

use crate::common::with_subject;
use chetaev_mechanics::{System, SystemParts};
use chetaev_motion::{Run, RunSettings, Watcher};
use chetaev_symbolic::rational::ratio;
use chetaev_symbolic::{Expr, Graph};
use std::sync::Arc;

fn number(g: &Graph, a: i64, b: i64) -> Expr {
    g.number(ratio(a, b).unwrap())
}

/// A thin disc of unit mass and radius that rolls without slipping and may lean, with its heading φ, lean θ and angle rolled ψ.
fn disc(g: &Graph) -> (SystemParts, Expr) {
    let s = |name: &str| g.symbol(name, 0);
    let v = |name: &str| g.symbol(name, 1);
    let (phi, theta) = (s("phi"), s("theta"));
    let (sin, cos) = (g.sin(theta), g.cos(theta));
    let center = [
        g.add(&[s("x"), g.mul(&[g.sin(phi), sin])]),
        g.sub(s("y"), g.mul(&[g.cos(phi), sin])),
        cos,
    ];
    let rate = |e: Expr| g.total_derivative(e, &|_| false);
    let axle = g.add(&[v("psi"), g.mul(&[v("phi"), sin])]);
    let mut terms: Vec<Expr> = center
        .iter()
        .map(|&e| g.mul(&[number(g, 1, 2), g.powi(rate(e), 2)]))
        .collect();
    terms.push(g.mul(&[number(g, 1, 8), g.powi(v("theta"), 2)]));
    terms.push(g.mul(&[number(g, 1, 8), g.powi(g.mul(&[v("phi"), cos]), 2)]));
    terms.push(g.mul(&[number(g, 1, 4), g.powi(axle, 2)]));
    let kinetic = g.add(&terms);
    let roll = |name: &str, direction: Expr| g.sub(v(name), g.mul(&[v("psi"), direction]));
    let parts = SystemParts {
        coordinates: ["x", "y", "phi", "theta", "psi"].map(String::from).to_vec(),
        lagrangian: Some(g.sub(kinetic, cos)),
        constraints: vec![
            ("roll_x".into(), roll("x", g.cos(phi))),
            ("roll_y".into(), roll("y", g.sin(phi))),
        ],
        ..SystemParts::default()
    };
    (parts, g.add(&[kinetic, cos]))
}

/// A rod that turns over and over in a field.
fn rotor(g: &Graph) -> (SystemParts, Expr) {
    let (x, v) = (g.symbol("x", 0), g.symbol("x", 1));
    let kinetic = g.mul(&[number(g, 1, 2), g.powi(v, 2)]);
    let parts = SystemParts {
        coordinates: vec!["x".into()],
        lagrangian: Some(g.add(&[kinetic, g.cos(x)])),
        ..SystemParts::default()
    };
    (parts, g.sub(kinetic, g.cos(x)))
}

fn run(parts: impl Fn(&Graph) -> (SystemParts, Expr), (q, v): (&[f64], &[f64]), t_end: f64) -> Run {
    let g = Arc::new(Graph::new());
    let (parts, energy) = parts(&g);
    let system = System::new(g.clone(), parts).unwrap();
    let settings = RunSettings {
        method: "taylor".into(),
        tolerance: 1e-15,
        absolute_tolerance: 1e-15,
        times: vec![t_end],
        follow: vec![energy],
        ..RunSettings::new(0.0, t_end)
    };
    with_subject(&system, (q, v), |subject| {
        subject.routh(&settings, &mut Watcher::default()).unwrap()
    })
}

/// Rounding to N steps of a random walk, of a unit in the last place each.
fn walk(run: &Run) -> f64 {
    f64::EPSILON * (run.statistics.steps as f64).sqrt()
}

#[test]
fn an_angle_of_many_turns() {
    let run = run(rotor, (&[0.0], &[3.0]), 10_000.0);
    assert!(run.ending.finished && run.statistics.steps > 10_000);
    let angle = run.row(0)[0];
    assert!(angle > 20_000.0);
    let energy = run.followed[0].drift.value;
    // The energy is evaluated where the angle is rounded, half a unit in its last place away.
    let seen = f64::EPSILON / 2.0 * angle;
    let scale = run.followed[0].scale;
    assert!(
        energy < seen + 4.0 * walk(&run) * scale,
        "{energy:e} in {} steps",
        run.statistics.steps
    );
}

#[test]
fn a_rolling_disc() {
    let (sin, cos) = 0.5f64.sin_cos();
    let v = [2.0 * cos, 2.0 * sin, 0.6, 0.3, 2.0];
    let run = run(disc, (&[0.0, 0.0, 0.5, 0.25, 0.0], &v), 1_000.0);
    assert!(run.ending.finished && run.statistics.steps > 1_000);
    let energy = run.followed[0].drift.value / 5.0;
    assert!(
        energy < 8.0 * walk(&run),
        "{energy:e} in {} steps",
        run.statistics.steps
    );
    // The constraints are kept, to rounding.
    for own in &run.followed[1..] {
        assert!(own.drift.value < 8.0 * walk(&run), "{:e}", own.drift.value);
    }
}
