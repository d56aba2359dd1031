//! Trajectories against closed forms from the literature (reference-cases: skate-inclined-dalembert, chaplygin-sleigh,
//! appell-hamel, pursuit).

#![allow(clippy::unwrap_used, reason = "test code fails where it stands")]

use crate::common::{last_row, with_subject};
use chetaev_mechanics::{formulation, System, SystemParts};
use chetaev_motion::{Run, RunSettings, StateKind, Watcher};
use chetaev_symbolic::{Expr, Graph};
use std::sync::Arc;

/// Reads `x'` as the first derivative of x.
fn s(g: &Graph, name: &str) -> Expr {
    let order = name.chars().filter(|&c| c == '\'').count() as u32;
    g.symbol(name.trim_end_matches('\''), order)
}

fn number(g: &Graph, text: &str) -> Expr {
    let value: f64 = text.parse().unwrap();
    let scaled = (value * 1e6).round() as i64;
    g.number(chetaev_symbolic::rational::ratio(scaled, 1_000_000).unwrap())
}

fn kinetic(g: &Graph, terms: &[(&str, &str)]) -> Vec<Expr> {
    terms
        .iter()
        .map(|(m, v)| g.mul(&[number(g, "0.5"), s(g, m), g.powi(s(g, v), 2)]))
        .collect()
}

fn skate(g: &Graph) -> SystemParts {
    let mut l = kinetic(g, &[("m", "x'"), ("m", "y'"), ("J", "phi'")]);
    l.push(g.mul(&[s(g, "m"), s(g, "gs"), s(g, "x")]));
    let f = g.sub(
        g.mul(&[s(g, "x'"), g.sin(s(g, "phi"))]),
        g.mul(&[s(g, "y'"), g.cos(s(g, "phi"))]),
    );
    SystemParts {
        coordinates: ["x", "y", "phi"].map(String::from).to_vec(),
        parameters: [("m", "1.2"), ("J", "0.3"), ("gs", "4")]
            .map(|(n, v)| (n.to_string(), Some(number(g, v))))
            .to_vec(),
        lagrangian: Some(g.add(&l)),
        constraints: vec![("blade".into(), f)],
        ..SystemParts::default()
    }
}

fn system(parts: impl Fn(&Graph) -> SystemParts) -> System {
    let g = Arc::new(Graph::new());
    System::new(g.clone(), parts(&g)).unwrap()
}

fn run(
    parts: impl Fn(&Graph) -> SystemParts,
    q: &[f64],
    v: &[f64],
    settings: RunSettings,
) -> (Run, Run) {
    with_subject(&system(parts), (q, v), |subject| {
        let routh = subject.routh(&settings, &mut Watcher::default()).unwrap();
        let maggi = formulation("maggi").unwrap();
        let maggi = subject
            .by(maggi, &settings, &mut Watcher::default())
            .unwrap();
        (routh, maggi)
    })
}

#[test]
fn the_skate_crosses_four_singular_charts_on_its_cycloid() {
    for state in [StateKind::Full, StateKind::Reduced] {
        let settings = RunSettings {
            state: Some(state),
            ..RunSettings::new(0.0, 10.0)
        };
        let (routh, maggi) = run(skate, &[0.0; 3], &[0.0, 0.0, 1.3], settings);
        for motion in [&routh, &maggi] {
            assert!(motion.ending.finished, "{:?}", motion.ending);
            let last = motion.row(motion.len() - 1);
            let (g, w, t) = (4.0, 1.3, 10.0f64);
            let x = g / (2.0 * w * w) * (w * t).sin().powi(2);
            let y = g / (2.0 * w * w) * (w * t - (2.0 * w * t).sin() / 2.0);
            assert!(
                (last[0] - x).abs() < 1e-8 && (last[1] - y).abs() < 1e-8,
                "{} {last:?}",
                motion.formulation
            );
            assert!((last[2] - 13.0).abs() < 1e-9);
        }
        // lambda = -2 m gs sin(W t) for this start (T1 S1).
        let lambda = routh.row(routh.len() - 1)[routh.layout.lambda()][0];
        assert!(
            (lambda + 2.0 * 1.2 * 4.0 * 13f64.sin()).abs() < 1e-6,
            "{lambda}"
        );
        assert!(routh.statistics.chart_switches >= 4);
    }
}

/// A tether of a tenth of a metre fixed at seven thousand kilometres, where the coordinate is known to a nanometre: its end goes around with
/// ten radians in the unit of time.
#[test]
fn a_place_that_is_given_has_its_gradient_however_far_away() {
    let tether = |g: &Graph| {
        let aside = g.sub(s(g, "x"), g.integer(7_000_000));
        let squares = [g.powi(aside, 2), g.powi(s(g, "y"), 2)];
        SystemParts {
            coordinates: ["x", "y"].map(String::from).to_vec(),
            parameters: vec![("m".into(), Some(g.one()))],
            lagrangian: Some(g.add(&kinetic(g, &[("m", "x'"), ("m", "y'")]))),
            constraints: vec![("tether".into(), g.sub(g.add(&squares), number(g, "0.01")))],
            ..SystemParts::default()
        }
    };
    let (routh, maggi) = run(
        tether,
        &[7_000_000.1, 0.0],
        &[0.0, 1.0],
        RunSettings::new(0.0, 0.5),
    );
    for run in [routh, maggi] {
        assert!(run.ending.finished, "{}", run.ending.reason);
        let last = last_row(&run);
        assert!((last[1] - 0.1 * 5.0_f64.sin()).abs() < 1e-6, "{last:?}");
    }
}

fn appell_hamel(g: &Graph) -> SystemParts {
    let mut l = kinetic(g, &[("m", "x'"), ("m", "y'"), ("m", "z'")]);
    l.push(g.neg(g.mul(&[s(g, "m"), s(g, "g"), s(g, "z")])));
    let speed = g.sqrt(g.add(&[g.powi(s(g, "x'"), 2), g.powi(s(g, "y'"), 2)]));
    SystemParts {
        coordinates: ["x", "y", "z"].map(String::from).to_vec(),
        parameters: [("m", "1.3"), ("rho", "0.7"), ("g", "9.81")]
            .map(|(n, v)| (n.to_string(), Some(number(g, v))))
            .to_vec(),
        lagrangian: Some(g.add(&l)),
        constraints: vec![(
            "cone".into(),
            g.sub(s(g, "z'"), g.mul(&[s(g, "rho"), speed])),
        )],
        ..SystemParts::default()
    }
}

#[test]
fn appell_hamel_moves_straight_and_stops_where_the_constraint_is_not_smooth() {
    let (s0, al, rho, grav) = (6.0f64, 0.5f64, 0.7f64, 9.81f64);
    let v = [s0 * al.cos(), s0 * al.sin(), rho * s0];
    let (routh, maggi) = run(appell_hamel, &[0.0; 3], &v, RunSettings::new(0.0, 1.0));
    for motion in [&routh, &maggi] {
        assert!(motion.ending.finished, "{:?}", motion.ending);
        let path = s0 - grav * rho / (1.0 + rho * rho) / 2.0;
        let last = motion.row(motion.len() - 1);
        assert!(
            (last[0] - al.cos() * path).abs() < 1e-8,
            "{} {last:?}",
            motion.formulation
        );
        assert!((last[2] - rho * path).abs() < 1e-8);
    }
    let stop = s0 * (1.0 + rho * rho) / (grav * rho);
    let (routh, maggi) = run(appell_hamel, &[0.0; 3], &v, RunSettings::new(0.0, 1.5));
    for motion in [&routh, &maggi] {
        assert!(!motion.ending.finished);
        assert!(
            (motion.ending.t - stop).abs() < 1e-4,
            "{:?} against {stop}",
            motion.ending
        );
    }
}

fn pursuit(g: &Graph) -> SystemParts {
    let l = kinetic(g, &[("m", "x'"), ("m", "y'")]);
    let aim = g.sub(g.mul(&[s(g, "u"), s(g, "t")]), s(g, "y"));
    let f = g.add(&[g.mul(&[s(g, "x'"), aim]), g.mul(&[s(g, "y'"), s(g, "x")])]);
    SystemParts {
        coordinates: ["x", "y"].map(String::from).to_vec(),
        parameters: [("m", "1"), ("u", "1")]
            .map(|(n, v)| (n.to_string(), Some(number(g, v))))
            .to_vec(),
        lagrangian: Some(g.add(&l)),
        constraints: vec![("aim".into(), f)],
        ..SystemParts::default()
    }
}

#[test]
fn pursuit_stops_at_capture_where_the_gradient_vanishes() {
    let (routh, _) = run(
        pursuit,
        &[10.0, 0.0],
        &[-2.0, 0.0],
        RunSettings::new(0.0, 6.0),
    );
    assert!(routh.ending.finished);
    assert!((routh.row(routh.len() - 1)[0] - 0.175713403123657).abs() < 1e-7);
    let (routh, _) = run(
        pursuit,
        &[10.0, 0.0],
        &[-2.0, 0.0],
        RunSettings::new(0.0, 8.0),
    );
    assert!(!routh.ending.finished, "{:?}", routh.ending);
    assert!(
        (routh.ending.t - 20.0 / 3.0).abs() < 1e-3,
        "{:?}",
        routh.ending
    );
    assert!(routh.ending.reason.contains("aim"));
}

/// (y' − 1)(y' − t) = 0: the branches meet at t = 1, where ∂f/∂v vanishes although the motion on one branch is smooth.
#[test]
fn branches_that_meet_stop_the_run() {
    let system = |g: &Graph| {
        let one = number(g, "1");
        let f = g.mul(&[g.sub(s(g, "y'"), one), g.sub(s(g, "y'"), s(g, "t"))]);
        SystemParts {
            coordinates: ["x", "y", "z"].map(String::from).to_vec(),
            parameters: vec![("m".into(), Some(one))],
            lagrangian: Some(g.add(&kinetic(g, &[("m", "x'"), ("m", "y'"), ("m", "z'")]))),
            constraints: vec![("branches".into(), f)],
            ..SystemParts::default()
        }
    };
    for end in [1.7, 3.0, 10.0] {
        let (routh, _) = run(
            system,
            &[0.0; 3],
            &[-1.0, 0.0, 0.0],
            RunSettings::new(0.0, end),
        );
        assert!(!routh.ending.finished, "{end}: {}", routh.ending.reason);
        assert!(
            (routh.ending.t - 1.0).abs() < 1e-5,
            "{end}: {}",
            routh.ending.reason
        );
    }
}

/// Chaplygin's equations of a skate on an incline have y as the dependent coordinate, and y' = tan(phi) x' says nothing where
/// the skate stands across the slope: such a start is refused, not replaced by another one.
#[test]
fn a_start_that_the_variables_do_not_give_back_is_refused() {
    let by = |name: &str| {
        let (q, v) = ([0.0, 0.0, std::f64::consts::FRAC_PI_2], [0.0, 0.5, 1.0]);
        with_subject(&system(skate), (&q, &v), |subject| {
            subject.by(
                formulation(name).unwrap(),
                &RunSettings::new(0.0, 1.0),
                &mut Watcher::default(),
            )
        })
    };
    let refused = by("chaplygin").unwrap_err().to_string();
    assert!(
        refused.contains("singular") && refused.contains("y'"),
        "{refused}"
    );
    let end = |run: Run| run.row(run.len() - 1).to_vec();
    let (routh, voronets) = (end(by("routh").unwrap()), end(by("voronets").unwrap()));
    for (a, b) in routh.iter().zip(&voronets).take(6) {
        assert!((a - b).abs() < 1e-8, "{routh:?} {voronets:?}");
    }
}

fn by_series(t_end: f64) -> RunSettings {
    RunSettings {
        method: "taylor".into(),
        tolerance: 1e-15,
        absolute_tolerance: 1e-15,
        ..RunSettings::new(0.0, t_end)
    }
}

/// The skate of the first test at every row, by several formulations, in charts that change on the way.
#[test]
fn series_follow_the_cycloid_to_rounding() {
    let (g, w) = (4.0, 1.3);
    let names = ["routh", "maggi", "voronets", "gibbs-appell", "canonical"];
    for name in names {
        for state in [StateKind::Full, StateKind::Reduced] {
            let settings = RunSettings {
                state: Some(state),
                project: true,
                ..by_series(10.0)
            };
            let motion = with_subject(&system(skate), (&[0.0; 3], &[0.0, 0.0, w]), |subject| {
                let own = formulation(name).unwrap();
                subject.by(own, &settings, &mut Watcher::default()).unwrap()
            });
            assert!(motion.ending.finished, "{name}: {:?}", motion.ending);
            assert!(
                motion.statistics.steps < 60,
                "{name}: {:?}",
                motion.statistics
            );
            for j in 0..motion.len() {
                let (t, row) = (motion.times[j], motion.row(j));
                let x = g / (2.0 * w * w) * (w * t).sin().powi(2);
                let y = g / (2.0 * w * w) * (w * t - (2.0 * w * t).sin() / 2.0);
                for (found, exact) in row.iter().zip([x, y, w * t]) {
                    let error = (found - exact).abs() / (1.0 + exact.abs());
                    assert!(error < 1e-12, "{name} at {t}: {error:e}");
                }
            }
        }
    }
}

#[test]
fn series_through_nonlinear_and_moving_constraints() {
    let (s0, al, rho, grav) = (6.0f64, 0.5f64, 0.7f64, 9.81f64);
    let v = [s0 * al.cos(), s0 * al.sin(), rho * s0];
    let (routh, maggi) = run(appell_hamel, &[0.0; 3], &v, by_series(1.0));
    let path = s0 - grav * rho / (1.0 + rho * rho) / 2.0;
    for motion in [&routh, &maggi] {
        let last = motion.row(motion.len() - 1);
        assert!((last[0] - al.cos() * path).abs() < 1e-12, "{last:?}");
        assert!((last[2] - rho * path).abs() < 1e-12, "{last:?}");
    }
    let stop = s0 * (1.0 + rho * rho) / (grav * rho);
    let (routh, maggi) = run(appell_hamel, &[0.0; 3], &v, by_series(1.5));
    for motion in [&routh, &maggi] {
        assert!(!motion.ending.finished);
        assert!((motion.ending.t - stop).abs() < 1e-4, "{:?}", motion.ending);
    }
    // The digits of the reference case.
    let (routh, maggi) = run(pursuit, &[10.0, 0.0], &[-2.0, 0.0], by_series(6.0));
    for motion in [&routh, &maggi] {
        let last = motion.row(motion.len() - 1);
        assert!((last[0] - 0.175713403123657).abs() < 1e-13, "{last:?}");
    }
}

/// The skate passes the places where its charts are singular; what a step loses there is measured in all velocities. In
/// independent ones it may be larger by the inverse of the least pivot that a step may have.
#[test]
fn errors_follow_the_tolerance_past_singular_places_of_charts() {
    let (t_end, start) = (100.0, [0.0, 0.0, 1.3]);
    let drift = |method: &str, name: &str, state, tolerance: f64| {
        with_subject(&system(skate), (&[0.0; 3], &start), |subject| {
            let settings = RunSettings {
                method: method.into(),
                tolerance,
                absolute_tolerance: tolerance,
                state,
                follow: vec![subject.system.energy()],
                ..RunSettings::new(0.0, t_end)
            };
            let own = formulation(name).unwrap();
            let run = subject.by(own, &settings, &mut Watcher::default());
            let run = run.unwrap();
            assert!(run.ending.finished, "{method}, {name}: {:?}", run.ending);
            run.followed.iter().map(|own| own.drift.value).collect()
        })
    };
    let runs = [
        ("dormand-prince-853", "routh", None, 200.0),
        ("tsitouras-5", "routh", None, 200.0),
        ("taylor", "routh", None, 200.0),
        (
            "dormand-prince-853",
            "routh",
            Some(StateKind::Reduced),
            2000.0,
        ),
        ("dormand-prince-853", "voronets", None, 2000.0),
        ("taylor", "voronets", None, 2000.0),
    ];
    for (method, name, state, factor) in runs {
        for tolerance in [1e-4, 1e-6, 1e-8, 1e-10, 1e-12] {
            let drifts: Vec<f64> = drift(method, name, state, tolerance);
            let worst = drifts.iter().fold(0.0, |m: f64, x| m.max(*x));
            assert!(
                worst < factor * tolerance,
                "{method}, {name}, {state:?} at {tolerance:e}: {drifts:?}"
            );
        }
    }
}

/// The heading of the skate grows without bound; the energy drifts by rounding only.
#[test]
fn series_keep_the_energy_of_a_long_run() {
    let start = [0.0, 0.0, 1.3];
    let followed = |settings: &RunSettings| {
        with_subject(&system(skate), (&[0.0; 3], &start), |subject| {
            let energy = subject.system.energy();
            let settings = RunSettings {
                follow: vec![energy],
                ..settings.clone()
            };
            subject.routh(&settings, &mut Watcher::default()).unwrap()
        })
    };
    // In all velocities: a change of chart divides by a pivot, and the rounding of the heading with it.
    let run = followed(&RunSettings {
        state: Some(StateKind::Full),
        ..by_series(400.0)
    });
    assert!(run.ending.finished, "{:?}", run.ending);
    let drift = run.followed[0].drift.value;
    // Every step rounds x, x' and y', whose terms the energy contains: these three walk at random together, √3 of one, and the
    // largest deviation of such a walk is rarely beyond four times its usual end. At tolerances from 2.3e-16 to 1e-13, by two
    // ways of computing the accelerations, 1.9e-13 to 4.0e-13 were measured; projecting on rounded headings gave 4e-12.
    let walk = f64::EPSILON * run.followed[0].scale * (run.statistics.steps as f64).sqrt();
    assert!(
        drift < 4.0 * 3f64.sqrt() * walk,
        "{drift:e} after {} steps, of which rounding explains {walk:e}",
        run.statistics.steps
    );
}
