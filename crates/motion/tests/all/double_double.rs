//! Motions in double-double arithmetic against closed forms, evaluated in the same arithmetic.
#![allow(clippy::unwrap_used, reason = "test code fails where it stands")]

use crate::common::with_data;
use chetaev_integrate::{Direction, IntegrateError};
use chetaev_mechanics::{formulation, System, SystemParts};
use chetaev_motion::double_double::{along, number};
use chetaev_motion::{
    DoubleDouble, EventWatched, InitialData, Precise, PreciseRows, Run, RunError, RunSettings,
    Subject, Watcher,
};
use chetaev_symbolic::{rational, Expr, Graph};
use std::sync::Arc;

const ZERO: DoubleDouble = DoubleDouble::ZERO;

/// Reads `x'` as the first derivative of x.
fn s(g: &Graph, name: &str) -> Expr {
    let order = name.chars().filter(|&c| c == '\'').count() as u32;
    g.symbol(name.trim_end_matches('\''), order)
}

fn ratio(g: &Graph, above: i64, below: i64) -> Expr {
    g.number(rational::ratio(above, below).unwrap())
}

fn part(above: i64, below: i64) -> DoubleDouble {
    DoubleDouble::from(above as f64) / DoubleDouble::from(below as f64)
}

/// 1/2 Σ m v²
fn kinetic(g: &Graph, terms: &[(&str, &str)]) -> Expr {
    let term = |(m, v): &(&str, &str)| g.mul(&[ratio(g, 1, 2), s(g, m), g.powi(s(g, v), 2)]);
    g.add(&terms.iter().map(term).collect::<Vec<_>>())
}

/// A skate on an incline: m = 6/5, J = 3/10, gs = 4 (Neimark, Fufaev 1972, ch. II).
fn skate(g: &Graph) -> SystemParts {
    let potential = g.mul(&[s(g, "m"), s(g, "gs"), s(g, "x")]);
    let along = g.mul(&[s(g, "x'"), g.sin(s(g, "phi"))]);
    let across = g.mul(&[s(g, "y'"), g.cos(s(g, "phi"))]);
    SystemParts {
        coordinates: ["x", "y", "phi"].map(String::from).to_vec(),
        parameters: vec![
            ("m".into(), Some(ratio(g, 6, 5))),
            ("J".into(), Some(ratio(g, 3, 10))),
            ("gs".into(), Some(ratio(g, 4, 1))),
        ],
        lagrangian: Some(g.add(&[
            kinetic(g, &[("m", "x'"), ("m", "y'"), ("J", "phi'")]),
            potential,
        ])),
        constraints: vec![("blade".into(), g.sub(along, across))],
        ..SystemParts::default()
    }
}

/// x'' = −k x with k = 1/10.
fn oscillator(g: &Graph) -> SystemParts {
    let potential = g.mul(&[ratio(g, -1, 2), s(g, "k"), g.powi(s(g, "x"), 2)]);
    SystemParts {
        coordinates: vec!["x".into()],
        parameters: vec![
            ("m".into(), Some(ratio(g, 1, 1))),
            ("k".into(), Some(ratio(g, 1, 10))),
        ],
        lagrangian: Some(g.add(&[kinetic(g, &[("m", "x'")]), potential])),
        ..SystemParts::default()
    }
}

/// A pendulum of length 1 in Cartesian coordinates, the gravity −1 along y.
fn pendulum(g: &Graph) -> SystemParts {
    let square = |name: &str| g.powi(s(g, name), 2);
    SystemParts {
        coordinates: ["x", "y"].map(String::from).to_vec(),
        parameters: vec![("m".into(), Some(g.one()))],
        lagrangian: Some(g.sub(
            kinetic(g, &[("m", "x'"), ("m", "y'")]),
            g.mul(&[s(g, "m"), s(g, "y")]),
        )),
        constraints: vec![(
            "rod".into(),
            g.sub(g.add(&[square("x"), square("y")]), g.one()),
        )],
        ..SystemParts::default()
    }
}

/// A point that runs straight after one that moves along x = 0 with speed 1.
fn pursuit(g: &Graph) -> SystemParts {
    let aim = g.sub(s(g, "t"), s(g, "y"));
    let f = g.add(&[g.mul(&[s(g, "x'"), aim]), g.mul(&[s(g, "y'"), s(g, "x")])]);
    SystemParts {
        coordinates: ["x", "y"].map(String::from).to_vec(),
        parameters: vec![("m".into(), Some(g.one()))],
        lagrangian: Some(kinetic(g, &[("m", "x'"), ("m", "y'")])),
        constraints: vec![("aim".into(), f)],
        ..SystemParts::default()
    }
}

/// What is asked of a run.
struct Asked {
    q: Vec<Option<DoubleDouble>>,
    v: Vec<Option<DoubleDouble>>,
    /// First guesses in doubles of what is not given.
    near: (Vec<f64>, Vec<f64>),
    span: (DoubleDouble, DoubleDouble),
}

impl Asked {
    fn given(q: &[DoubleDouble], v: &[DoubleDouble], end: DoubleDouble) -> Asked {
        let doubles = |x: &[DoubleDouble]| x.iter().map(|x| x.high()).collect::<Vec<_>>();
        let exact = |x: &[DoubleDouble]| x.iter().copied().map(Some).collect::<Vec<_>>();
        Asked {
            q: exact(q),
            v: exact(v),
            near: (doubles(q), doubles(v)),
            span: (ZERO, end),
        }
    }
}

type Parts = fn(&Graph) -> SystemParts;

/// What `work` makes of a system at a start.
fn with_subject<R>(
    parts: Parts,
    asked: &Asked,
    work: impl FnOnce(&Subject<'_>, RunSettings, Vec<DoubleDouble>) -> R,
) -> R {
    let g = Arc::new(Graph::new());
    let system = System::new(g.clone(), parts(&g)).unwrap();
    let data = InitialData {
        t: asked.span.0.high(),
        q: asked.near.0.clone(),
        v: asked.near.1.clone(),
        q_fixed: asked.q.iter().map(Option::is_some).collect(),
        v_fixed: asked.v.iter().map(Option::is_some).collect(),
        project: false,
    };
    let parameters = system.parameters.iter();
    let parameters = parameters
        .map(|p| number(&g, p.value.unwrap()).unwrap())
        .collect();
    let (from, to) = (asked.span.0.high(), asked.span.1.high());
    let settings = RunSettings {
        method: "taylor".into(),
        times: vec![from, to],
        follow: vec![system.energy()],
        ..RunSettings::new(from, to)
    };
    with_data(&system, &data, |subject| {
        work(subject, settings, parameters)
    })
}

/// The settings in double-double.
fn precise(
    asked: &Asked,
    tolerance: f64,
    settings: RunSettings,
    parameters: Vec<DoubleDouble>,
) -> RunSettings {
    let numbers = Precise {
        parameters,
        t_start: asked.span.0,
        t_end: asked.span.1,
        times: vec![asked.span.0, asked.span.1],
        q: asked.q.clone(),
        v: asked.v.clone(),
    };
    RunSettings {
        tolerance,
        absolute_tolerance: tolerance,
        precise: Some(Arc::new(numbers)),
        ..settings
    }
}

fn by_routh(subject: &Subject<'_>, settings: &RunSettings) -> Result<Run, RunError> {
    subject.by(
        formulation("routh").unwrap(),
        settings,
        &mut Watcher::default(),
    )
}

fn run(parts: Parts, asked: &Asked, tolerance: f64) -> Run {
    with_subject(parts, asked, |subject, settings, parameters| {
        by_routh(subject, &precise(asked, tolerance, settings, parameters)).unwrap()
    })
}

fn rows(run: &Run) -> &PreciseRows {
    run.precise.as_ref().unwrap()
}

/// The last row.
fn last(run: &Run) -> &[DoubleDouble] {
    let all = &rows(run).rows;
    &all[all.len() - run.layout.len()..]
}

fn gap(a: DoubleDouble, b: DoubleDouble) -> f64 {
    (a - b).abs().high()
}

/// The skate that starts at rest with yaw rate 13/10: x, y, λ at t.
fn cycloid(t: DoubleDouble) -> [DoubleDouble; 3] {
    let (w, gs) = (part(13, 10), DoubleDouble::from(4.0));
    let size = gs / (w * w * 2.0);
    let (sin, cos) = (w * t).sin_cos();
    [
        size * sin * sin,
        size * (w * t - sin * cos),
        -(part(12, 5) * gs * sin),
    ]
}

fn spinning() -> Asked {
    Asked::given(
        &[ZERO; 3],
        &[ZERO, ZERO, part(13, 10)],
        DoubleDouble::from(10.0),
    )
}

#[test]
fn the_skate_draws_its_cycloid_to_26_digits() {
    let asked = spinning();
    for tolerance in [1e-18, 1e-22, 1e-28] {
        let motion = run(skate, &asked, tolerance);
        assert!(motion.ending.finished, "{:?}", motion.ending);
        let (row, [x, y, lambda]) = (last(&motion), cycloid(asked.span.1));
        let allowed = (1e3 * tolerance).max(1e-26);
        let errors = [
            gap(row[0], x),
            gap(row[1], y),
            gap(row[2], DoubleDouble::from(13.0)),
            gap(row[motion.layout.lambda().start], lambda) / 10.0,
        ];
        assert!(
            errors.iter().all(|&e| e < allowed),
            "{tolerance:e}: {errors:?}"
        );
        let energy = motion.followed[0].drift.value;
        assert!(energy < allowed, "{tolerance:e}: {energy:e}");
        let drift = motion.drift.as_ref().unwrap().largest();
        assert!(drift < allowed, "{tolerance:e}: {drift:e}");
    }
}

#[test]
fn the_skate_comes_back() {
    let there = run(skate, &spinning(), 1e-28);
    let row = last(&there);
    let back = Asked {
        span: (DoubleDouble::from(10.0), ZERO),
        ..Asked::given(&row[..3], &row[3..6], ZERO)
    };
    let motion = run(skate, &back, 1e-28);
    let row = last(&motion);
    let start = [ZERO, ZERO, ZERO, ZERO, ZERO, part(13, 10)];
    for (found, expected) in row.iter().zip(start) {
        assert!(gap(*found, expected) < 1e-26, "{row:?}");
    }
}

#[test]
fn doubles_agree_to_their_digits() {
    let asked = spinning();
    let exact = run(skate, &asked, 1e-25);
    let plain = with_subject(skate, &asked, |subject, settings, _| {
        let settings = RunSettings {
            tolerance: 1e-15,
            absolute_tolerance: 1e-15,
            ..settings
        };
        by_routh(subject, &settings).unwrap()
    });
    let (a, b) = (exact.row(1), plain.row(1));
    for (a, b) in a.iter().zip(b) {
        assert!((a - b).abs() < 1e-12 * (1.0 + a.abs()), "{a} {b}");
    }
    assert!(exact.layout == plain.layout && plain.precise.is_none());
}

#[test]
fn a_tenth_is_a_tenth() {
    // x(t) = cos(√k t).
    let end = DoubleDouble::from(20.0);
    let asked = Asked::given(&[DoubleDouble::ONE], &[ZERO], end);
    let expected = (part(1, 10).sqrt() * end).cos();
    let motion = run(oscillator, &asked, 1e-28);
    let error = gap(last(&motion)[0], expected);
    assert!(error < 1e-27, "{error:e}");
    // With the nearest double the error is that of √k t: t δk/(2 √k) sin(√k t), δk = 5.55e-18.
    let rounded = with_subject(oscillator, &asked, |subject, settings, mut parameters| {
        assert_eq!(parameters[1].high(), 0.1);
        parameters[1] = DoubleDouble::from(0.1);
        by_routh(subject, &precise(&asked, 1e-28, settings, parameters)).unwrap()
    });
    let error = gap(last(&rounded)[0], expected);
    let slope = (20.0 * 0.1f64.sqrt()).sin() * 20.0 / (2.0 * 0.1f64.sqrt());
    let caused = 5.551115123125783e-18 * slope.abs();
    assert!((error / caused - 1.0).abs() < 1e-6, "{error:e} {caused:e}");
}

/// The period 2π/M(1, cos(θ₀/2)) of a pendulum of amplitude θ₀ (Gauss; DLMF 19.8.5).
fn period(amplitude: DoubleDouble) -> DoubleDouble {
    let (mut a, mut b) = (DoubleDouble::ONE, amplitude.scaled(0.5).cos());
    for _ in 0..10 {
        (a, b) = ((a + b).scaled(0.5), (a * b).sqrt());
    }
    DoubleDouble::PI * 2.0 / a
}

#[test]
fn a_pendulum_returns_after_its_period() {
    // From rest at the angle 2 to the vertical.
    let (sin, cos) = DoubleDouble::from(2.0).sin_cos();
    let end = period(DoubleDouble::from(2.0));
    let asked = Asked::given(&[sin, -cos], &[ZERO; 2], end);
    let motion = run(pendulum, &asked, 1e-28);
    assert!(motion.ending.finished, "{:?}", motion.ending);
    for (found, expected) in last(&motion).iter().zip([sin, -cos, ZERO, ZERO]) {
        let error = gap(*found, expected);
        assert!(error < 1e-26, "{error:e}");
    }
    let drift = motion.drift.as_ref().unwrap();
    assert!(drift.largest() < 1e-27, "{:?}", drift.largest());
    assert!(drift.steps == motion.statistics.steps && drift.position.len() == 1);
    assert!(motion.followed[0].drift.value < 1e-27);
}

#[test]
fn what_is_not_given_is_completed_to_all_digits() {
    // Only the yaw rate and the heading 3/10 are exact; the velocities are led to the blade's direction.
    let asked = Asked {
        q: vec![Some(ZERO), Some(ZERO), Some(part(3, 10))],
        v: vec![Some(DoubleDouble::ONE), None, Some(part(1, 2))],
        near: (vec![0.0, 0.0, 0.3], vec![1.0, 0.0, 0.5]),
        span: (ZERO, DoubleDouble::ONE),
    };
    let motion = run(skate, &asked, 1e-25);
    let first = &rows(&motion).rows[..6];
    let (sin, cos) = part(3, 10).sin_cos();
    assert!(gap(first[4], sin / cos) < 1e-30, "{first:?}");
    assert_eq!(first[3], DoubleDouble::ONE);
    assert_eq!(first[2], part(3, 10));
    assert_eq!(first[5], part(1, 2));
}

#[test]
fn events_are_located_to_rounding() {
    // x' = 0 on its way down where the skate has come furthest: W t = π/2, 3π/2, …
    let asked = spinning();
    let motion = with_subject(skate, &asked, |subject, settings, parameters| {
        let settings = RunSettings {
            events: vec![EventWatched {
                name: "furthest".into(),
                value: s(&subject.system.graph, "x'"),
                direction: Direction::Down,
                stops: false,
            }],
            ..precise(&asked, 1e-27, settings, parameters)
        };
        by_routh(subject, &settings).unwrap()
    });
    let met = &rows(&motion).events;
    assert_eq!(met.len(), 4);
    assert_eq!(motion.events.len(), 4);
    for (k, (t, row)) in met.iter().enumerate() {
        let expected = DoubleDouble::PI * (k as f64 + 0.5) / part(13, 10);
        assert!(gap(*t, expected) < 1e-25, "{t:?}");
        assert!(row[3].abs().high() < 1e-25);
    }
}

#[test]
fn capture_ends_a_pursuit() {
    // Speeds 2 and 1 at the distance 10, with a start square to the other's way: capture after 10·2/(2² − 1) = 20/3.
    let asked = Asked::given(
        &[DoubleDouble::from(10.0), ZERO],
        &[DoubleDouble::from(-2.0), ZERO],
        DoubleDouble::from(8.0),
    );
    let motion = run(pursuit, &asked, 1e-20);
    assert!(!motion.ending.finished, "{:?}", motion.ending);
    let error = (motion.ending.t - 20.0 / 3.0).abs();
    assert!(error < 1e-3, "{:?}", motion.ending);
}

#[test]
fn expressions_are_followed_with_all_digits() {
    let asked = spinning();
    with_subject(skate, &asked, |subject, settings, parameters| {
        let motion = by_routh(subject, &precise(&asked, 1e-28, settings, parameters)).unwrap();
        let of = (subject.system, subject.terms, subject.binding);
        let blade = subject.system.constraints[0].stated;
        let found = along(of, &motion, &[blade, subject.system.energy()])
            .unwrap()
            .unwrap();
        assert!(found[0].iter().all(|f| f.abs().high() < 1e-27));
        assert!(gap(found[1][1], found[1][0]) < 1e-26);
    });
}

#[test]
fn what_is_done_in_doubles_only_is_refused() {
    let asked = spinning();
    with_subject(skate, &asked, |subject, settings, parameters| {
        let settings = precise(&asked, 1e-25, settings, parameters);
        let ask = |settings: &RunSettings, name: &str| {
            let form = formulation(name).unwrap();
            subject
                .by(form, settings, &mut Watcher::default())
                .unwrap_err()
        };
        let maggi = ask(&settings, "maggi").to_string();
        assert!(
            maggi.contains("`maggi`") && maggi.contains("leave"),
            "{maggi}"
        );
        let other = RunSettings {
            method: "dormand-prince-853".into(),
            ..settings.clone()
        };
        let method = ask(&other, "routh").to_string();
        assert!(method.contains("take the method `taylor`"), "{method}");
        let sharp = RunSettings {
            tolerance: 1e-30,
            ..settings.clone()
        };
        let refused = IntegrateError::PreciseToleranceTooSmall { requested: 1e-30 };
        assert_eq!(ask(&sharp, "routh"), RunError::Integrate(refused));
        let kept = RunSettings {
            keep: vec![subject.system.energy()],
            ..settings
        };
        assert!(matches!(ask(&kept, "routh"), RunError::NotPrecise { .. }));
    });
}
