//! Forces that jump with a sign: where both sides drive back the motion sticks (A. F. Filippov), at a time known in closed form, whatever the
//! method, tolerance and formulation.

#![allow(clippy::unwrap_used, reason = "test code fails where it stands")]

use crate::common::{last_row, with_subject};
use chetaev_mechanics::{formulation, System, SystemParts};
use chetaev_motion::{Run, RunSettings, Watcher};
use chetaev_symbolic::{rational, Expr, Function, Graph};
use std::sync::Arc;

fn fraction(g: &Graph, p: i64, q: i64) -> Expr {
    g.number(rational::ratio(p, q).unwrap())
}

fn sign(g: &Graph, e: Expr) -> Expr {
    g.apply(Function::Sign, &[e])
}

/// Masses on a line with a force on each.
fn run(
    masses: &[(&str, i64)],
    forces: impl Fn(&Graph) -> Vec<Expr>,
    (q, v): (&[f64], &[f64]),
    form: &str,
    settings: &RunSettings,
) -> Run {
    let g = Arc::new(Graph::new());
    let energies = masses
        .iter()
        .map(|&(name, m)| g.mul(&[fraction(&g, m, 2), g.powi(g.symbol(name, 1), 2)]));
    let kinetic = g.add(&energies.collect::<Vec<_>>());
    let names = masses.iter().map(|(name, _)| (*name).to_string());
    let parts = SystemParts {
        coordinates: names.clone().collect(),
        lagrangian: Some(kinetic),
        forces: names.zip(forces(&g)).collect(),
        ..SystemParts::default()
    };
    let system = System::new(g.clone(), parts).unwrap();
    let form = formulation(form).unwrap();
    with_subject(&system, (q, v), |subject| {
        subject.by(form, settings, &mut Watcher::default()).unwrap()
    })
}

fn settings(method: &str, tolerance: f64, t_end: f64) -> RunSettings {
    RunSettings {
        method: method.into(),
        tolerance,
        absolute_tolerance: tolerance,
        ..RunSettings::new(0.0, t_end)
    }
}

const WAYS: [(&str, &str, f64); 7] = [
    ("routh", "dormand-prince-853", 1e-6),
    ("routh", "dormand-prince-853", 1e-8),
    ("routh", "dormand-prince-853", 1e-10),
    ("routh", "dormand-prince-853", 1e-12),
    ("routh", "tsitouras-5", 1e-9),
    ("routh", "taylor", 1e-12),
    ("maggi", "dormand-prince-853", 1e-10),
];

/// The motion sticks at this time, after some hundred steps, to fifty times the tolerance of a step for every jump of the forces that is met: a jump inside of
/// a step is seen by the estimate of its error alone, and these errors add up.
#[track_caller]
fn sticks_at(
    t: f64,
    masses: &[(&str, i64)],
    forces: impl Fn(&Graph) -> Vec<Expr>,
    start: (&[f64], &[f64]),
    jumps: f64,
) {
    for (form, method, tolerance) in WAYS {
        let with = settings(method, tolerance, 2.0 * t + 1.0);
        let found = run(masses, &forces, start, form, &with);
        let reason = &found.ending.reason;
        assert!(
            reason.contains("sticks"),
            "{form} {method} {tolerance:e}: {reason}"
        );
        let error = (found.t - t).abs();
        assert!(
            error <= 50.0 * jumps * tolerance,
            "{form} {method} {tolerance:e}: {:.12}, off by {error:e}",
            found.t
        );
        assert!(found.statistics.steps < 1_000, "{}", found.statistics.steps);
    }
}

/// x'' = -x - μ sgn x' with μ = 3/10 from a state of x = 3/10 + 1/2 cos t: half a period about 3/10 ends at x = -1/5, where the spring is weaker
/// than friction. From x = 2 amplitudes about ±3/10 fall by 6/10 each half period: 1.7, 1.1, 0.5.
#[test]
fn a_spring_with_dry_friction_stops_after_half_a_period() {
    let forces = |g: &Graph| {
        let friction = g.mul(&[fraction(g, -3, 10), sign(g, g.symbol("x", 1))]);
        vec![g.sub(friction, g.symbol("x", 0))]
    };
    for (amplitude, halves) in [(0.5, 1.0), (1.7, 3.0)] {
        let (q, v) = (0.3 + amplitude * 0.5_f64.cos(), -amplitude * 0.5_f64.sin());
        let t = halves * std::f64::consts::PI - 0.5;
        sticks_at(t, &[("x", 1)], forces, (&[q], &[v]), halves);
    }
}

/// Masses 2 and 1 that rub with force 1 and differ by the speed 3, which falls by 3/2 in the unit of time.
#[test]
fn blocks_that_rub_go_on_together() {
    let forces = |g: &Graph| {
        let own = sign(g, g.sub(g.symbol("x", 1), g.symbol("y", 1)));
        vec![g.neg(own), own]
    };
    sticks_at(
        2.0,
        &[("x", 2), ("y", 1)],
        forces,
        (&[0.0, 0.0], &[3.0, 0.0]),
        1.0,
    );
}

/// x'' = -sgn(x + x') from x = 1 at rest: x = 1 - t²/2 until x + x' = 0 at t = √3 - 1, where |x'| < 1, so that both sides lead back.
#[test]
fn a_relay_slides() {
    let forces = |g: &Graph| vec![g.neg(sign(g, g.add(&[g.symbol("x", 0), g.symbol("x", 1)])))];
    sticks_at(
        3.0_f64.sqrt() - 1.0,
        &[("x", 1)],
        forces,
        (&[1.0], &[0.0]),
        1.0,
    );
}

/// A block at rest on a slope of less than the angle of friction stays there. By Taylor's method nothing starts where a sign has no series.
#[test]
fn what_rests_by_friction_sticks_at_once() {
    let forces = |g: &Graph| vec![g.sub(fraction(g, 1, 2), sign(g, g.symbol("x", 1)))];
    for (form, method, tolerance) in WAYS.into_iter().filter(|own| own.1 != "taylor") {
        let with = settings(method, tolerance, 3.0);
        let found = run(&[("x", 1)], forces, (&[0.0], &[0.0]), form, &with);
        let reason = &found.ending.reason;
        assert!(
            reason.contains("sticks"),
            "{form} {method} {tolerance:e}: {reason}"
        );
        assert!(found.t < 1e-3, "{form} {method} {tolerance:e}: {}", found.t);
    }
}

/// x'' = -sgn(x') x'² has the speed 1/(1 + t), which comes near zero and has no jump there; x'' = -sgn(x) crosses x = 0 for ever, with the period 4√2 of
/// an amplitude 1.
#[test]
fn what_is_continuous_or_crosses_does_not_stick() {
    let drag = |g: &Graph| {
        let v = g.symbol("x", 1);
        vec![g.neg(g.mul(&[sign(g, v), g.powi(v, 2)]))]
    };
    for (form, method, tolerance) in WAYS {
        let with = settings(method, tolerance, 1e5);
        let found = run(&[("x", 1)], drag, (&[0.0], &[1.0]), form, &with);
        assert!(
            found.ending.finished,
            "{form} {method}: {}",
            found.ending.reason
        );
    }
    let relay = |g: &Graph| vec![g.neg(sign(g, g.symbol("x", 0)))];
    let with = settings("dormand-prince-853", 1e-9, 8.0 * 2.0_f64.sqrt());
    let found = run(&[("x", 1)], relay, (&[1.0], &[0.0]), "routh", &with);
    assert!(found.ending.finished, "{}", found.ending.reason);
    let last = last_row(&found);
    assert!((last[0] - 1.0).abs() < 1e-6, "{last:?}");
}
