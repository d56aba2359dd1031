//! Motions through places where the rank of the constraints falls, against closed forms: one branch for all methods, tolerances,
//! variables and formulations, no velocity jumps, and where no single branch contains the velocity the run ends.

#![allow(clippy::unwrap_used, reason = "test code fails where it stands")]

use crate::common::with_subject;
use chetaev_integrate::Direction;
use chetaev_mechanics::{formulation, System, SystemParts};
use chetaev_motion::{Component, EventWatched, Run, RunSettings, StateKind, Watcher};
use chetaev_symbolic::{Expr, Graph};
use std::sync::Arc;

/// Numerator and denominator of a coefficient, and symbols with their powers.
type Term<'t> = (i64, i64, &'t [(&'t str, i64)]);

/// A sum of products: coefficients with powers of named symbols; `x'` is the first derivative of x.
fn sum(g: &Graph, terms: &[Term<'_>]) -> Expr {
    let product = |&(p, q, factors): &Term<'_>| {
        let mut all = vec![g.number(chetaev_symbolic::rational::ratio(p, q).unwrap())];
        all.extend(factors.iter().map(|&(name, power)| {
            let order = name.chars().filter(|&c| c == '\'').count() as u32;
            g.powi(g.symbol(name.trim_end_matches('\''), order), power)
        }));
        g.mul(&all)
    };
    g.add(&terms.iter().map(product).collect::<Vec<_>>())
}

/// A particle of unit mass for every coordinate, with these potentials and constraints.
fn parts(
    g: &Graph,
    coordinates: &[&str],
    potential: Expr,
    constraints: Vec<(&str, Expr)>,
) -> SystemParts {
    let squares = coordinates.iter().map(|c| {
        let half = g.number(chetaev_symbolic::rational::ratio(1, 2).unwrap());
        g.mul(&[half, g.powi(g.symbol(c, 1), 2)])
    });
    let kinetic = g.add(&squares.collect::<Vec<_>>());
    SystemParts {
        coordinates: coordinates.iter().map(|c| (*c).to_string()).collect(),
        lagrangian: Some(g.sub(kinetic, potential)),
        constraints: constraints
            .into_iter()
            .map(|(name, f)| (name.to_string(), f))
            .collect(),
        ..SystemParts::default()
    }
}

fn run(
    parts: impl Fn(&Graph) -> SystemParts,
    (q, v): (&[f64], &[f64]),
    form: &str,
    settings: &RunSettings,
) -> Run {
    let g = Arc::new(Graph::new());
    let system = System::new(g.clone(), parts(&g)).unwrap();
    let form = formulation(form).unwrap();
    with_subject(&system, (q, v), |subject| {
        subject.by(form, settings, &mut Watcher::default()).unwrap()
    })
}

/// Ways to compute one motion, with the error allowed at the end.
fn ways(t_end: f64) -> Vec<(&'static str, RunSettings, f64)> {
    let with = |method: &str, tolerance: f64| RunSettings {
        method: method.into(),
        tolerance,
        absolute_tolerance: tolerance,
        ..RunSettings::new(0.0, t_end)
    };
    let reduced = RunSettings {
        state: Some(StateKind::Reduced),
        ..with("dormand-prince-853", 1e-10)
    };
    let fixed = RunSettings {
        step: Some(1e-3),
        ..with("runge-kutta-4", 1e-10)
    };
    vec![
        ("routh", with("dormand-prince-853", 1e-6), 1e-2),
        ("routh", with("dormand-prince-853", 1e-8), 1e-4),
        ("routh", with("dormand-prince-853", 1e-10), 1e-6),
        ("routh", with("dormand-prince-853", 1e-12), 1e-8),
        ("routh", with("tsitouras-5", 1e-9), 1e-4),
        ("routh", with("taylor", 1e-12), 1e-8),
        ("routh", reduced, 1e-6),
        ("routh", fixed, 1e-5),
        ("maggi", with("dormand-prince-853", 1e-10), 1e-6),
        ("kane", with("dormand-prince-853", 1e-10), 1e-6),
        ("gibbs-appell", with("tsitouras-5", 1e-9), 1e-4),
    ]
}

/// Velocities of neighbouring rows differ by what accelerations of usual size explain.
fn is_continuous(run: &Run, most: f64, what: &str) {
    let v = run.layout.v();
    for j in 1..run.len() {
        let h = run.times[j] - run.times[j - 1];
        for i in v.clone() {
            let jump = (run.row(j)[i] - run.row(j - 1)[i]).abs();
            assert!(
                jump <= most * h + 1e-9,
                "{what}: velocity {i} jumps by {jump} between {} and {}",
                run.times[j - 1],
                run.times[j]
            );
        }
    }
}

fn agrees(
    system: impl Fn(&Graph) -> SystemParts + Copy,
    start: (&[f64], &[f64]),
    t_end: f64,
    (expected, crossings, acceleration): (&dyn Fn(f64) -> Vec<f64>, usize, f64),
) {
    for (form, settings, tolerance) in ways(t_end) {
        let run = run(system, start, form, &settings);
        let what = format!("{form} {} {:e}", settings.method, settings.tolerance);
        assert!(run.ending.finished, "{what}: {}", run.ending.reason);
        assert_eq!(
            run.crossings.len(),
            crossings,
            "{what}: {:?}",
            run.crossings
        );
        is_continuous(&run, acceleration, &what);
        for j in (0..run.len()).step_by(10).chain([run.len() - 1]) {
            let (t, row) = (run.times[j], run.row(j));
            for (i, x) in expected(t).into_iter().enumerate() {
                assert!(
                    (row[i] - x).abs() < tolerance,
                    "{what}: coordinate {i} at {t}: {} instead of {x}",
                    row[i]
                );
            }
        }
    }
}

/// θ'' = g sin θ from the upper position, by small steps of Runge and Kutta's method.
fn falling_angle(t_end: f64) -> f64 {
    let steps = (t_end / 1e-3).ceil().max(1.0);
    let h = t_end / steps;
    let f = |(x, v): (f64, f64)| (v, 9.81 * x.sin());
    let (mut x, mut v) = (0.0, 1.0);
    for _ in 0..steps as u64 {
        let a = f((x, v));
        let b = f((x + 0.5 * h * a.0, v + 0.5 * h * a.1));
        let c = f((x + 0.5 * h * b.0, v + 0.5 * h * b.1));
        let d = f((x + h * c.0, v + h * c.1));
        x += h / 6.0 * (a.0 + 2.0 * b.0 + 2.0 * c.0 + d.0);
        v += h / 6.0 * (a.1 + 2.0 * b.1 + 2.0 * c.1 + d.1);
    }
    x
}

fn parallelogram(g: &Graph) -> SystemParts {
    let potential = sum(g, &[(981, 100, &[("y", 1)]), (981, 100, &[("v", 1)])]);
    let left = sum(g, &[(1, 1, &[("x", 2)]), (1, 1, &[("y", 2)]), (-1, 1, &[])]);
    let right = sum(
        g,
        &[
            (1, 1, &[("u", 2)]),
            (-2, 1, &[("u", 1)]),
            (1, 1, &[("v", 2)]),
        ],
    );
    let rod = sum(
        g,
        &[
            (1, 1, &[("u", 2)]),
            (-2, 1, &[("u", 1), ("x", 1)]),
            (1, 1, &[("x", 2)]),
            (1, 1, &[("v", 2)]),
            (-2, 1, &[("v", 1), ("y", 1)]),
            (1, 1, &[("y", 2)]),
            (-1, 1, &[]),
        ],
    );
    let constraints = vec![("left", left), ("right", right), ("rod", rod)];
    parts(g, &["x", "y", "u", "v"], potential, constraints)
}

/// The flat positions are passed eleven times in ten seconds; the rods stay parallel.
#[test]
fn a_parallelogram_stays_one() {
    let start = (&[0.0, 1.0, 1.0, 1.0][..], &[1.0, 0.0, 1.0, 0.0][..]);
    let expected = |t: f64| {
        let (s, c) = falling_angle(t).sin_cos();
        vec![s, c, s + 1.0, c]
    };
    let turns = falling_angle(5.0);
    let flat = ((turns / std::f64::consts::PI) - 0.5).floor() as usize + 1;
    agrees(parallelogram, start, 5.0, (&expected, flat, 60.0));
}

/// Viviani's window, the curve in which a sphere meets a cylinder that touches it from inside: x = cos² u, y = cos u sin u, z = sin u
/// has a node where u is a multiple of π. A free bead has constant speed, u'² (1 + cos² u) = const.
#[test]
fn a_bead_on_vivianis_window_passes_the_node_straight() {
    let window = |g: &Graph| {
        let sphere = sum(
            g,
            &[
                (1, 1, &[("x", 2)]),
                (1, 1, &[("y", 2)]),
                (1, 1, &[("z", 2)]),
                (-1, 1, &[]),
            ],
        );
        let cylinder = sum(
            g,
            &[
                (1, 1, &[("x", 2)]),
                (-1, 1, &[("x", 1)]),
                (1, 1, &[("y", 2)]),
            ],
        );
        let constraints = vec![("sphere", sphere), ("cylinder", cylinder)];
        parts(g, &["x", "y", "z"], g.zero(), constraints)
    };
    let u0: f64 = 1.1;
    let speed: f64 = -(1.0 + u0.cos().powi(2)).sqrt();
    let angle = |t: f64| {
        let f = |u: f64| speed / (1.0 + u.cos().powi(2)).sqrt();
        let steps = (t / 1e-3).ceil().max(1.0);
        let h = t / steps;
        (0..steps as u64).fold(u0, |u, _| {
            let a = f(u);
            let b = f(u + 0.5 * h * a);
            let c = f(u + 0.5 * h * b);
            let d = f(u + h * c);
            u + h / 6.0 * (a + 2.0 * b + 2.0 * c + d)
        })
    };
    let (s, c) = u0.sin_cos();
    let start = [c * c, c * s, s];
    let velocity = [2.0 * c * s, -(c * c - s * s), -c];
    let expected = |t: f64| {
        let (s, c) = angle(t).sin_cos();
        vec![c * c, c * s, s]
    };
    let passed = (-angle(4.0) / std::f64::consts::PI).floor() as usize + 1;
    agrees(window, (&start, &velocity), 4.0, (&expected, passed, 8.0));
}

/// x⁴ = x² − y², x = sin s, y = sin s cos s: a bead on a figure of eight.
#[test]
fn a_bead_on_a_figure_of_eight_takes_the_other_loop() {
    let eight = |g: &Graph| {
        let f = sum(
            g,
            &[
                (1, 1, &[("x", 4)]),
                (-1, 1, &[("x", 2)]),
                (1, 1, &[("y", 2)]),
            ],
        );
        parts(g, &["x", "y"], g.zero(), vec![("eight", f)])
    };
    let s0: f64 = 1.0;
    let size = |s: f64| (s.cos().powi(2) + (2.0 * s).cos().powi(2)).sqrt();
    let along = |t: f64| {
        let f = |s: f64| -size(s0) / size(s);
        let steps = (t / 1e-3).ceil().max(1.0);
        let h = t / steps;
        (0..steps as u64).fold(s0, |s, _| {
            let a = f(s);
            let b = f(s + 0.5 * h * a);
            let c = f(s + 0.5 * h * b);
            let d = f(s + h * c);
            s + h / 6.0 * (a + 2.0 * b + 2.0 * c + d)
        })
    };
    let point = |s: f64| vec![s.sin(), s.sin() * s.cos()];
    let velocity = [-s0.cos(), -(2.0 * s0).cos()];
    let expected = |t: f64| point(along(t));
    let passed = (-along(6.0) / std::f64::consts::PI).floor() as usize + 1;
    agrees(
        eight,
        (&point(s0), &velocity),
        6.0,
        (&expected, passed, 30.0),
    );
}

/// On y² = x⁴ two parabolas touch, and on y² = x³ a curve turns back: no branch contains the velocity simply.
#[test]
fn where_branches_touch_and_in_a_cusp_the_run_ends() {
    let touching = |g: &Graph| {
        let f = sum(g, &[(1, 1, &[("y", 2)]), (-1, 1, &[("x", 4)])]);
        parts(g, &["x", "y"], g.zero(), vec![("parabolas", f)])
    };
    let cusp = |g: &Graph| {
        let f = sum(g, &[(1, 1, &[("y", 2)]), (-1, 1, &[("x", 3)])]);
        parts(g, &["x", "y"], g.zero(), vec![("cusp", f)])
    };
    for (form, settings, _) in ways(3.0) {
        let what = format!("{form} {} {:e}", settings.method, settings.tolerance);
        let found = run(touching, (&[-1.0, 1.0], &[1.0, -2.0]), form, &settings);
        assert!(
            !found.ending.finished && found.crossings.is_empty(),
            "{what}"
        );
        // The length of the parabola from −1 to 0 over the speed √5.
        let length = 0.5 * 5.0_f64.sqrt() + 0.25 * 2.0_f64.asinh();
        let t = length / 5.0_f64.sqrt();
        assert!(
            (found.ending.t - t).abs() < 1e-3,
            "{what}: {} {t}",
            found.ending.reason
        );
        let found = run(cusp, (&[1.0, 1.0], &[-2.0, -3.0]), form, &settings);
        assert!(
            !found.ending.finished && found.crossings.is_empty(),
            "{what}: {:?}",
            found.crossings
        );
        // The length of the semicubical parabola from 0 to 1, (13^(3/2) − 8)/27 (Neile), over √13.
        let t = (13.0_f64.powf(1.5) - 8.0) / 27.0 / 13.0_f64.sqrt();
        assert!(
            (found.ending.t - t).abs() < 1e-2,
            "{what}: {} {t}",
            found.ending.reason
        );
    }
}

/// A rhombus of four bars, hinged to the ground in one corner: two freedoms. Folded flat it might turn about one corner alone. It stays
/// a rhombus, B = A + C, and its angles follow from T = α'² + γ'² + cos(α − γ) α' γ'.
#[test]
fn a_rhombus_stays_one() {
    let rhombus = |g: &Graph| {
        let bar = |x: &str, y: &str| sum(g, &[(1, 1, &[(x, 2)]), (1, 1, &[(y, 2)]), (-1, 1, &[])]);
        let between = |x: &str, y: &str, u: &str, v: &str| {
            let squares = [
                (1, 1, &[(x, 2)][..]),
                (1, 1, &[(y, 2)]),
                (1, 1, &[(u, 2)]),
                (1, 1, &[(v, 2)]),
            ];
            let mixed = [
                (-2, 1, &[(x, 1), (u, 1)][..]),
                (-2, 1, &[(y, 1), (v, 1)]),
                (-1, 1, &[]),
            ];
            g.add(&[sum(g, &squares), sum(g, &mixed)])
        };
        let constraints = vec![
            ("oa", bar("ax", "ay")),
            ("oc", bar("cx", "cy")),
            ("ab", between("ax", "ay", "bx", "by")),
            ("cb", between("cx", "cy", "bx", "by")),
        ];
        parts(
            g,
            &["ax", "ay", "bx", "by", "cx", "cy"],
            g.zero(),
            constraints,
        )
    };
    let place = |[a, c]: [f64; 2]| {
        vec![
            a.cos(),
            a.sin(),
            a.cos() + c.cos(),
            a.sin() + c.sin(),
            c.cos(),
            c.sin(),
        ]
    };
    let rates = |[a, c, p, r]: [f64; 4]| {
        let (s, k) = (a - c).sin_cos();
        // 2 α'' + cos δ γ'' = −sin δ γ'², cos δ α'' + 2 γ'' = sin δ α'².
        let (e, f, d) = (-s * r * r, s * p * p, 4.0 - k * k);
        [p, r, (2.0 * e - k * f) / d, (2.0 * f - k * e) / d]
    };
    let along = |t: f64| {
        let steps = (t / 1e-3).ceil().max(1.0);
        let h = t / steps;
        let moved = |y: [f64; 4], f: [f64; 4], h: f64| [0, 1, 2, 3].map(|i| y[i] + h * f[i]);
        (0..steps as u64).fold([0.7, -0.7, -0.6, 0.9], |y, _| {
            let a = rates(y);
            let b = rates(moved(y, a, 0.5 * h));
            let c = rates(moved(y, b, 0.5 * h));
            let d = rates(moved(y, c, h));
            [0, 1, 2, 3].map(|i| y[i] + h / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]))
        })
    };
    let (v, at) = (0.7_f64.sin_cos(), place([0.7, -0.7]));
    let (s, c) = v;
    let (a, r) = ([0.6 * s, -0.6 * c], [0.9 * s, 0.9 * c]);
    let velocity = [a[0], a[1], a[0] + r[0], a[1] + r[1], r[0], r[1]];
    let expected = |t: f64| {
        let y = along(t);
        place([y[0], y[1]])
    };
    let y = along(6.0);
    let folded = ((y[1] - y[0]) / std::f64::consts::PI).floor() as usize + 1;
    agrees(rhombus, (&at, &velocity), 6.0, (&expected, folded, 30.0));
}

/// The same on the component on which it starts.
fn run_on_component(
    parts: impl Fn(&Graph) -> SystemParts,
    (q, v): (&[f64], &[f64]),
    form: &str,
    settings: &RunSettings,
) -> Run {
    let g = Arc::new(Graph::new());
    let system = System::new(g.clone(), parts(&g)).unwrap();
    on_component(&system, (q, v), form, settings)
}

fn on_component(
    system: &System,
    start: (&[f64], &[f64]),
    form: &str,
    settings: &RunSettings,
) -> Run {
    let form = formulation(form).unwrap();
    with_subject(system, start, |subject| {
        let component = Component::of_start(subject).unwrap();
        let on = component.subject(subject.binding);
        on.by(form, settings, &mut Watcher::default()).unwrap()
    })
}

/// (y − x²)(y + x) = 0: a parabola that a line crosses at (0, 0) and at (−1, 1).
fn parabola_and_line(g: &Graph) -> SystemParts {
    let parabola = sum(g, &[(1, 1, &[("y", 1)]), (-1, 1, &[("x", 2)])]);
    let line = sum(g, &[(1, 1, &[("y", 1)]), (1, 1, &[("x", 1)])]);
    parts(
        g,
        &["x", "y"],
        g.zero(),
        vec![("a", g.mul(&[parabola, line]))],
    )
}

/// From (1, 1) with the speed √5: the arc from 1 to 0 has the length √5/2 + asinh(2)/4.
#[test]
fn a_bead_stays_on_its_curve_where_a_line_crosses_it() {
    let length = 0.5 * 5.0_f64.sqrt() + 0.25 * 2.0_f64.asinh();
    let first = length / 5.0_f64.sqrt();
    for (form, settings, tolerance) in ways(4.0) {
        let what = format!("{form} {} {:e}", settings.method, settings.tolerance);
        let start = (&[1.0, 1.0][..], &[-1.0, -2.0][..]);
        let run = run_on_component(parabola_and_line, start, form, &settings);
        assert!(run.ending.finished, "{what}: {}", run.ending.reason);
        let times: Vec<f64> = run.crossings.iter().map(|c| c.t).collect();
        assert_eq!(times.len(), 2, "{what}: {times:?}");
        for (t, expected) in times.iter().zip([first, 2.0 * first]) {
            assert!((t - expected).abs() < tolerance, "{what}: {t} {expected}");
        }
        is_continuous(&run, 10.0, &what);
        let lambda = run.layout.lambda().start;
        for j in 0..run.len() {
            let row = run.row(j);
            let (x, y) = (row[0], row[1]);
            assert!((y - x * x).abs() < tolerance, "{what}: {x} {y}");
            // y'' = λ ∂f/∂y with f the product.
            let (pull, a) = (row[lambda] * (x + y), row[run.layout.a().start + 1]);
            assert!((pull - a).abs() < 10.0 * tolerance, "{what}: {pull} {a}");
        }
    }
    // Events speak of the multiplier of the product.
    let start = (&[1.0, 1.0][..], &[-1.0, -2.0][..]);
    let g = Arc::new(Graph::new());
    let system = System::new(g.clone(), parabola_and_line(&g)).unwrap();
    let event = EventWatched {
        name: "one".into(),
        value: g.sub(g.symbol("lambda_a", 0), g.one()),
        direction: Direction::Both,
        stops: true,
    };
    let settings = RunSettings {
        events: vec![event],
        ..RunSettings::new(0.0, 4.0)
    };
    let run = on_component(&system, start, "routh", &settings);
    assert_eq!(run.events.len(), 1);
    let row = &run.events[0].row;
    assert!((row[run.layout.lambda().start] - 1.0).abs() < 1e-9);
    let a = row[run.layout.a().start + 1];
    assert!((a - (row[0] + row[1])).abs() < 1e-8);
}

/// y (y − x²) = 0 and y (y − x³) = 0: on y = 0 the velocity at 0 lies on both components, and the motion is not determined beyond.
#[test]
fn where_components_touch_the_run_ends() {
    for power in [2, 3] {
        let touching = |g: &Graph| {
            let curve = sum(g, &[(1, 1, &[("y", 1)]), (-1, 1, &[("x", power)])]);
            let line = g.symbol("y", 0);
            parts(g, &["x", "y"], g.zero(), vec![("a", g.mul(&[curve, line]))])
        };
        for (form, settings, _) in ways(3.0) {
            let what = format!(
                "{power} {form} {} {:e}",
                settings.method, settings.tolerance
            );
            let start = (&[1.0, 0.0][..], &[-1.0, 0.0][..]);
            let found = run_on_component(touching, start, form, &settings);
            assert!(!found.ending.finished, "{what}");
            assert!(found.crossings.is_empty(), "{what}");
            assert!(
                (found.ending.t - 1.0).abs() < 1e-4,
                "{what}: {}",
                found.ending.reason
            );
            assert!(
                (found.times.last().unwrap() - found.ending.t).abs() < 1e-12,
                "{what}"
            );
        }
    }
}

/// y'² = x'² under gravity: thrown up along y = x, the particle comes to rest at t = 2, and both lines contain the velocity zero.
#[test]
fn where_components_of_velocities_meet_the_run_ends() {
    let lines = |g: &Graph| {
        let f = sum(g, &[(1, 1, &[("y'", 2)]), (-1, 1, &[("x'", 2)])]);
        parts(
            g,
            &["x", "y"],
            sum(g, &[(1, 1, &[("y", 1)])]),
            vec![("a", f)],
        )
    };
    for (form, settings, _) in ways(4.0) {
        let what = format!("{form} {} {:e}", settings.method, settings.tolerance);
        let start = (&[0.0, 0.0][..], &[1.0, 1.0][..]);
        let found = run_on_component(lines, start, form, &settings);
        assert!(!found.ending.finished, "{what}");
        assert!(
            (found.ending.t - 2.0).abs() < 1e-6,
            "{what}: {}",
            found.ending.reason
        );
    }
}

/// The same, where the model says along which line the particle falls back.
#[test]
fn where_components_meet_the_motion_goes_on_as_asked() {
    let lines = |g: &Graph| {
        let f = sum(g, &[(1, 1, &[("y'", 2)]), (-1, 1, &[("x'", 2)])]);
        parts(
            g,
            &["x", "y"],
            sum(g, &[(1, 1, &[("y", 1)])]),
            vec![("a", f)],
        )
    };
    // Up along y = x with y'' = −1/2, and down from (1, 1) along the line asked for.
    let expected = |t: f64, side: f64| {
        let fallen = (t - 2.0) * (t - 2.0) / 4.0;
        let x = if t < 2.0 {
            1.0 - fallen
        } else {
            1.0 - side * fallen
        };
        (x, 1.0 - fallen)
    };
    for (text, sign, side) in [("y' = x'", -1, 1.0), ("x' = -y'", 1, -1.0)] {
        for (form, settings, tolerance) in ways(4.0) {
            let what = format!("{text} {form} {} {:e}", settings.method, settings.tolerance);
            let g = Arc::new(Graph::new());
            let system = System::new(g.clone(), lines(&g)).unwrap();
            let choice = sum(&g, &[(1, 1, &[("y'", 1)]), (sign, 1, &[("x'", 1)])]);
            let settings = RunSettings {
                crossings: vec![(text.into(), choice)],
                ..settings
            };
            let start = (&[0.0, 0.0][..], &[1.0, 1.0][..]);
            let run = on_component(&system, start, form, &settings);
            assert!(run.ending.finished, "{what}: {}", run.ending.reason);
            assert_eq!(run.crossings.len(), 1, "{what}");
            assert_eq!(run.times, settings.times, "{what}");
            assert_eq!(run.rows.len(), run.times.len() * run.layout.len(), "{what}");
            is_continuous(&run, 2.0, &what);
            for (j, t) in run.times.iter().enumerate() {
                let (x, y) = expected(*t, side);
                let row = run.row(j);
                let error = (row[0] - x).abs().max((row[1] - y).abs());
                assert!(error < tolerance, "{what}: {t} {row:?}");
            }
        }
    }
}

/// y' (x' − (t − 1)³) = 0 at rest under a force along y: at t = 1 the velocity zero lies on both, which meet in a point of third order.
#[test]
fn components_that_meet_to_third_order_are_met() {
    let own = |g: &Graph| {
        let t = g.sub(g.symbol("t", 0), g.one());
        let other = g.sub(g.symbol("x", 1), g.powi(t, 3));
        let a = g.mul(&[g.symbol("y", 1), other]);
        parts(
            g,
            &["x", "y"],
            sum(g, &[(-1, 1, &[("y", 1)])]),
            vec![("a", a)],
        )
    };
    for (form, settings, _) in ways(3.0) {
        let what = format!("{form} {} {:e}", settings.method, settings.tolerance);
        let start = (&[0.0, 0.0][..], &[0.0, 0.0][..]);
        let found = run_on_component(own, start, form, &settings);
        assert!(!found.ending.finished, "{what}");
        assert!(
            (found.ending.t - 1.0).abs() < 1e-3,
            "{what}: {}",
            found.ending.reason
        );
    }
}
