//! Systems that are given by their rates.
#![allow(
    clippy::unwrap_used,
    clippy::excessive_precision,
    reason = "test code fails where it stands, and has the digits of its sources"
)]

use crate::points;
use chetaev_integrate::Output;
use chetaev_orbits::branch::{Equations, Kind};
use chetaev_orbits::continuation::{follow, Pace};
use chetaev_orbits::equilibria::Equilibria;
use chetaev_orbits::periodic::{period_guess, Shooting};
use chetaev_orbits::solution::solution;
use chetaev_orbits::variational::{Column, Extended, Order, Variational};
use chetaev_orbits::{Flow, OrbitError};
use chetaev_symbolic::{Expr, Graph, Symbol};
use std::sync::Arc;

struct Plain {
    g: Arc<Graph>,
}

impl Plain {
    fn new() -> Plain {
        Plain {
            g: Arc::new(Graph::new()),
        }
    }

    fn s(&self, name: &str) -> (Symbol, Expr) {
        (self.g.intern_symbol(name, 0), self.g.symbol(name, 0))
    }
}

/// Close, in parts of 1 + size.
fn is_close(found: f64, expected: f64, tolerance: f64) {
    let error = (found - expected).abs() / (1.0 + expected.abs());
    assert!(
        error <= tolerance,
        "{found} instead of {expected}: {error:e}"
    );
}

/// Lorenz 1963 at σ = 10, b = 8/3, with the symbol of r.
fn lorenz_flow() -> (Flow, Symbol) {
    let own = Plain::new();
    let g = &own.g;
    let [(xs, x), (ys, y), (zs, z), (rs, r)] = ["x", "y", "z", "r"].map(|name| own.s(name));
    let ten = g.integer(10);
    let b = g.div(g.integer(8), g.integer(3));
    let rates = vec![
        g.mul(&[ten, g.sub(y, x)]),
        g.sub(g.sub(g.mul(&[r, x]), y), g.mul(&[x, z])),
        g.sub(g.mul(&[x, y]), g.mul(&[b, z])),
    ];
    let flow = Flow::of_rates(own.g.clone(), vec![xs, ys, zs], rates, vec![(rs, 20.0)]);
    (flow, rs)
}

/// Steps of a thousandth of the range make a thousand points, each a solution: x = y = √(b (r − 1)), z = r − 1.
#[test]
fn a_thousand_points() {
    let (flow, rs) = lorenz_flow();
    let mut equations = Equilibria::new(&flow, Some(rs)).unwrap();
    let pace = Pace {
        points: 5000,
        step: 0.001,
    };
    let found = follow(
        &mut equations,
        (&[7.0, 7.0, 19.0], 20.0),
        (10.0, 30.0),
        pace,
    )
    .unwrap();
    assert!(found.points.len() >= 1000, "{}", found.points.len());
    for own in &found.points {
        let x = (8.0_f64 / 3.0 * (own.parameter - 1.0)).sqrt();
        let expected = [x, x, own.parameter - 1.0];
        for (found, expected) in own.unknowns.iter().zip(expected) {
            is_close(*found, expected, 1e-12);
        }
    }
    let gaps = found.points.windows(2);
    let longest = gaps.map(|two| two[1].parameter - two[0].parameter);
    let longest = longest.fold(0.0, f64::max);
    assert!(longest <= 0.001 * 20.0, "{longest}");
}

/// Lorenz 1963 at σ = 10, b = 8/3: a Hopf point at r = 470/19, ω² = 2 σ b (σ + 1)/(σ − b − 1), l₁ > 0 (Marsden and McCracken 1976).
#[test]
fn lorenz() {
    let (flow, rs) = lorenz_flow();
    let mut equations = Equilibria::new(&flow, Some(rs)).unwrap();
    let found = follow(
        &mut equations,
        (&[7.0, 7.0, 19.0], 20.0),
        (0.5, 30.0),
        points(500),
    )
    .unwrap();
    assert_eq!(found.family, 0);
    let hopf = found.special.iter().find_map(|own| match own.kind {
        Kind::Hopf {
            frequency,
            first_lyapunov,
        } => Some((own.point.parameter, frequency, first_lyapunov.unwrap())),
        _ => None,
    });
    let (at, frequency, coefficient) = hopf.unwrap();
    is_close(at, 470.0 / 19.0, 1e-12);
    is_close(frequency, 9.624_530_063_715_756, 1e-12);
    is_close(coefficient / 2.655_189_725_836_714e-4, 1.0, 1e-8);
    // Down the branch the two equilibria meet in the one at rest, at r = 1, where the curve turns back.
    let fold = found.special.iter().find(|own| own.kind == Kind::Pitchfork);
    let fold = &fold.unwrap().point;
    is_close(fold.parameter, 1.0, 1e-7);
    let ends: Vec<f64> = [found.points.first(), found.points.last()]
        .map(|own| own.unwrap().unknowns[0])
        .to_vec();
    // Symmetric: x = ±√(b (r − 1)) at r = 30.
    is_close(ends[0], -(8.0_f64 / 3.0 * 29.0).sqrt(), 1e-12);
    is_close(ends[1], (8.0_f64 / 3.0 * 29.0).sqrt(), 1e-12);
}

/// x' = y, y' = a y − x − y³ has its Hopf point at a = 0, also where a step ends there: from starts on either side, with steps that are parts of the way.
#[test]
fn a_step_that_ends_on_a_special_point_does_not_hide_it() {
    let own = Plain::new();
    let g = &own.g;
    let [(xs, x), (ys, y), (a_s, a)] = ["x", "y", "a"].map(|name| own.s(name));
    let damped = g.sub(g.mul(&[a, y]), g.powi(y, 3));
    let rates = vec![y, g.sub(damped, x)];
    let flow = Flow::of_rates(own.g.clone(), vec![xs, ys], rates, vec![(a_s, 0.1)]);
    for start in [0.1, -0.1, 0.5, 0.05] {
        for step in [0.05, 0.025, 0.01, 0.005] {
            let mut equations = Equilibria::new(&flow, Some(a_s)).unwrap();
            let pace = Pace { points: 5000, step };
            let found = follow(&mut equations, (&[0.0, 0.0], start), (-1.0, 1.0), pace).unwrap();
            let is_hopf = |kind: &Kind| matches!(kind, Kind::Hopf { .. });
            let special: Vec<_> = found
                .special
                .iter()
                .filter(|own| is_hopf(&own.kind))
                .collect();
            assert_eq!(special.len(), 1, "from {start} by {step}");
            is_close(special[0].point.parameter, 0.0, 1e-9);
        }
    }
}

/// The Brusselator: B = 1 + A², ω = A, l₁ < 0 (Hassard, Kazarinoff and Wan 1981); the orbit that is born, and its multipliers, which multiply to
/// exp ∮ div f.
#[test]
fn brusselator() {
    let own = Plain::new();
    let g = &own.g;
    let [(xs, x), (ys, y), (bs, b)] = ["x", "y", "B"].map(|name| own.s(name));
    let a = g.div(g.integer(13), g.integer(10));
    let square = g.mul(&[x, x, y]);
    let rates = vec![
        g.add(&[a, g.neg(g.mul(&[g.add(&[b, g.one()]), x])), square]),
        g.sub(g.mul(&[b, x]), square),
    ];
    let flow = Flow::of_rates(own.g.clone(), vec![xs, ys], rates, vec![(bs, 2.0)]);
    let mut equations = Equilibria::new(&flow, Some(bs)).unwrap();
    let found = follow(&mut equations, (&[1.2, 1.4], 2.0), (1.5, 3.5), points(500)).unwrap();
    assert_eq!(found.special.len(), 1, "{:?}", found.special);
    is_close(found.special[0].point.parameter, 2.69, 1e-13);
    match found.special[0].kind {
        Kind::Hopf {
            frequency,
            first_lyapunov,
        } => {
            is_close(frequency, 1.3, 1e-13);
            is_close(first_lyapunov.unwrap(), -0.324_025_289_778_714_44, 1e-9);
        }
        other => panic!("{other:?}"),
    }
    // An orbit at B = 3, from a start near it.
    let mut at_three = flow.clone();
    at_three.parameters[0].1 = 3.0;
    let guess = period_guess(&at_three, &[1.0, 2.6], 40.0).unwrap();
    let mut orbits = Shooting::new(&at_three, Some(bs), None).unwrap();
    let start = orbits.unknowns(&[1.0, 2.6], guess);
    let (orbit, family) = solution(&mut orbits, &start, 3.0).unwrap();
    assert_eq!(family, 0);
    assert_eq!(orbit.spectrum.trivial, ["the direction along the orbit"]);
    let multiplier = orbit.spectrum.values[0].re;
    assert!(multiplier > 0.0 && multiplier < 1.0, "{multiplier}");
    // Liouville: the trapezoidal rule converges exponentially on a closed orbit.
    let rows = orbits.rows(&orbit.unknowns, 3.0, 400).unwrap();
    let divergence = |z: &[f64]| -4.0 + 2.0 * z[0] * z[1] - z[0] * z[0];
    let period = orbit.unknowns[2];
    let mean: f64 = rows[..400].iter().map(|(_, z)| divergence(z)).sum::<f64>() / 400.0;
    is_close(multiplier, (mean * period).exp(), 1e-10);
    // Down to where it is born the orbit shrinks like the root of B − 1 − A².
    let shrinking = follow(&mut orbits, (&orbit.unknowns, 3.0), (2.7, 3.0), points(300)).unwrap();
    let first = shrinking.points.first().unwrap();
    is_close(first.parameter, 2.7, 1e-12);
    is_close(first.unknowns[2], std::f64::consts::TAU / 1.3, 1e-2);
    // The equilibrium is no orbit.
    let at_rest = orbits.unknowns(&[1.3, 3.0 / 1.3], 4.8);
    let mut orbits = Shooting::new(&at_three, Some(bs), None).unwrap();
    let found = solution(&mut orbits, &at_rest, 3.0);
    assert!(matches!(found, Err(OrbitError::Steady)), "{found:?}");
}

/// x'' + (a − 2 q cos 2t) x = 0: the boundaries of stability are the characteristic values (McLachlan 1947; Abramowitz and Stegun 1964, ch. 20).
#[test]
fn mathieu() {
    let own = Plain::new();
    let g = &own.g;
    let [(xs, x), (vs, v), (a_s, a), (qs, q), (_, t)] =
        ["x", "v", "a", "q", "t"].map(|name| own.s(name));
    let cos = g.cos(g.mul(&[g.integer(2), t]));
    let rates = vec![
        v,
        g.neg(g.mul(&[g.sub(a, g.mul(&[g.integer(2), q, cos])), x])),
    ];
    {
        let parameters = vec![(a_s, 0.3), (qs, 0.5)];
        let flow = Flow::of_rates(own.g.clone(), vec![xs, vs], rates.clone(), parameters);
        let mut orbits = Shooting::new(&flow, Some(a_s), Some(g.pi())).unwrap();
        let found = follow(&mut orbits, (&[0.0, 0.0], 0.3), (-1.0, 5.0), points(2000)).unwrap();
        // The least zero of the continued fraction a = 2 q²/(a − 4 − q²/(a − 16 − …)).
        is_close(
            found.special[0].point.parameter,
            -0.121_765_544_941_082_72,
            2e-12,
        );
    }
    type Passed<'a> = &'a [(f64, &'a str)];
    let cases: [(f64, (f64, f64), Passed<'_>); 3] = [
        (
            1.0,
            (-6.0, 12.0),
            &[
                (-0.455_138_604_107_413_55, "1"),
                (-0.110_248_816_992_095_17, "-1"),
                (1.859_108_072_514_363_5, "-1"),
                (3.917_024_772_998_471, "1"),
                (4.371_300_982_735_086, "1"),
                (9.047_739_259_809_375, "-1"),
                (9.078_368_847_203_102, "-1"),
            ],
        ),
        (
            5.0,
            (-6.0, 12.0),
            &[
                (-5.800_046_020_851_508, "1"),
                (-5.790_080_598_637_771, "-1"),
                (1.858_187_541_547_751, "-1"),
                (2.099_460_445_486_665_4, "1"),
                (7.449_109_739_529_178, "1"),
                (9.236_327_713_693_701, "-1"),
                (11.548_832_036_343_401, "-1"),
            ],
        ),
        (
            10.0,
            (-3.0, 22.0),
            &[
                (-2.399_142_400_036_264_11, "-1"),
                (-2.382_158_235_956_955_72, "1"),
                (7.717_369_849_779_622_64, "1"),
                (7.986_069_144_681_660_44, "-1"),
                (15.502_784_369_732_575_6, "-1"),
                (17.381_380_678_623_043, "1"),
                (21.104_633_708_657_791_7, "1"),
            ],
        ),
    ];
    for (value, range, expected) in cases {
        let parameters = vec![(a_s, 0.5), (qs, value)];
        let flow = Flow::of_rates(own.g.clone(), vec![xs, vs], rates.clone(), parameters);
        let mut orbits = Shooting::new(&flow, Some(a_s), Some(g.pi())).unwrap();
        let found = follow(&mut orbits, (&[0.0, 0.0], 0.5), range, points(2000)).unwrap();
        let all: Vec<(f64, &str)> = found
            .special
            .iter()
            .map(|own| {
                let passed = match own.kind {
                    Kind::BranchPoint => "1",
                    Kind::PeriodDoubling => "-1",
                    other => panic!("{other:?}"),
                };
                (own.point.parameter, passed)
            })
            .collect();
        assert_eq!(all.len(), expected.len(), "{all:?}");
        for ((found, passed), (at, expected)) in all.iter().zip(expected) {
            is_close(*found, *at, 2e-12);
            assert_eq!(passed, expected);
        }
    }
}

/// Hénon and Heiles's orbit on the line x = 0 at E = 1/12: its period and its transversal multipliers (Churchill, Pecelli and Rod 1979; numbers by
/// Hill's equation and an elliptic integral), with the 1 of the energy and the 1 along the orbit named.
#[test]
fn henon_heiles() {
    let own = Plain::new();
    let g = &own.g;
    let [(xs, x), (ys, y), (us, u), (vs, v)] = ["x", "y", "u", "v"].map(|name| own.s(name));
    let two = g.integer(2);
    let rates = vec![
        u,
        v,
        g.neg(g.add(&[x, g.mul(&[two, x, y])])),
        g.sub(g.powi(y, 2), g.add(&[y, g.powi(x, 2)])),
    ];
    let mut flow = Flow::of_rates(own.g.clone(), vec![xs, ys, us, vs], rates, Vec::new());
    let half = g.div(g.one(), two);
    let squares = g.add(&[g.powi(x, 2), g.powi(y, 2), g.powi(u, 2), g.powi(v, 2)]);
    let cubic = g.sub(g.mul(&[g.powi(x, 2), y]), g.div(g.powi(y, 3), g.integer(3)));
    let energy = g.add(&[g.mul(&[half, squares]), cubic]);
    flow.conserved = vec![("the energy".into(), energy)];
    let mut orbits = Shooting::new(&flow, None, None).unwrap();
    // At y = 1/2, at rest, the energy is 1/8 − 1/24 = 1/12.
    let guess = orbits.unknowns(&[0.0, 0.5, 0.0, 0.0], 6.9);
    let (orbit, family) = solution(&mut orbits, &guess, 0.0).unwrap();
    assert_eq!(family, 1);
    assert_eq!(
        orbit.spectrum.trivial,
        ["the direction along the orbit", "the energy"]
    );
    // Of the family the orbit next to the guess is taken; its own energy says what to expect.
    let (y0, v0) = (orbit.unknowns[1], orbit.unknowns[3]);
    let energy = 0.5 * (y0 * y0 + v0 * v0) - y0.powi(3) / 3.0;
    assert!((energy - 1.0 / 12.0).abs() < 1e-3);
    // From there to E = 1/12, to the first order in the difference, the trace changes little.
    let trace = orbit.spectrum.values.iter().map(|l| l.re).sum::<f64>();
    assert!((trace - 1.322_086_765_878_084).abs() < 1e-2, "{trace}");
    let exact = orbits.unknowns(&[0.0, 0.5, 0.0, 0.0], 6.901_643_615_339_256);
    let spectrum = orbits.spectrum(&exact, 0.0, 1).unwrap();
    assert_eq!(spectrum.values.len(), 2);
    is_close(spectrum.values[0].re, 0.661_043_382_939_042_2, 1e-11);
    is_close(spectrum.values[1].im, 0.750_347_683_325_874_5, 1e-11);
    let closed = orbits.evaluate(&exact, 0.0).unwrap().residual.amax();
    assert!(closed < 1e-12, "{closed:e}");
    // The same line at E = 0.16, close to where it escapes.
    let start = [0.0, 0.879_596_545_135_010_466, 0.0, 0.0];
    let exact = orbits.unknowns(&start, 9.310_458_304_601_897_07);
    let spectrum = orbits.spectrum(&exact, 0.0, 1).unwrap();
    assert_eq!(spectrum.values.len(), 2);
    is_close(spectrum.values[0].re, 0.515_743_986_588_223_943, 1e-10);
    is_close(spectrum.values[1].im, 0.856_742_750_362_141_017, 1e-10);
    let closed = orbits.evaluate(&exact, 0.0).unwrap().residual.amax();
    assert!(closed < 1e-11, "{closed:e}");
}

/// Sensitivities of first and second order of `x = x₀ e^{a t} / (1 + x₀ (e^{a t} − 1))` (logistic growth), in closed form.
#[test]
fn logistic_growth() {
    let own = Plain::new();
    let g = &own.g;
    let [(xs, x), (a_s, a)] = ["x", "a"].map(|name| own.s(name));
    let rates = vec![g.mul(&[a, x, g.sub(g.one(), x)])];
    let flow = Flow::of_rates(own.g.clone(), vec![xs], rates, vec![(a_s, 0.7)]);
    let columns = vec![Column::Initial(0), Column::Parameter(a_s)];
    let mut motion = Variational::new(&flow, columns, Order::Second).unwrap();
    assert_eq!(motion.pairs, [(0, 0), (0, 1), (1, 1)]);
    let start = Extended::start(&[0.2], &motion);
    let rows = motion.run((0.0, 3.0), &start, Output::Every(1.5)).unwrap();
    let (t, last) = rows.last().unwrap();
    assert_eq!(*t, 3.0);
    let e = (0.7_f64 * 3.0).exp();
    let below = 1.0 + 0.2 * (e - 1.0);
    is_close(last.state[0], 0.2 * e / below, 1e-15);
    is_close(last.first[(0, 0)], e / below.powi(2), 1e-14);
    let rate = 3.0 * 0.2 * 0.8 * e;
    is_close(last.first[(0, 1)], rate / below.powi(2), 1e-14);
    is_close(
        last.second[(0, 0)],
        -2.0 * e * (e - 1.0) / below.powi(3),
        1e-14,
    );
    let mixed = 3.0 * e * (0.8 - 0.2 * e) / below.powi(3);
    is_close(last.second[(0, 1)], mixed, 1e-14);
    let twice = 9.0 * 0.2 * 0.8 * e * (0.8 - 0.2 * e) / below.powi(3);
    is_close(last.second[(0, 2)], twice, 1e-14);
}
