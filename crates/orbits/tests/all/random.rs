//! Laws of linear equations on random systems that rest at the origin: with variable masses of the coordinates, gyroscopic and dissipative forces,
//! and in two thirds of them a nonholonomic constraint.
#![allow(
    clippy::unwrap_used,
    clippy::needless_range_loop,
    reason = "test code fails where it stands, and runs over columns"
)]

use chetaev_compile::{Lowering, PreciseTaylor};
use chetaev_double_double::DoubleDouble;
use chetaev_integrate::double_double::{integrate, PreciseOptions, PreciseSystem};
use chetaev_integrate::{EvaluationFailure, Stop};
use chetaev_mechanics::claims::{Context, Registry};
use chetaev_mechanics::prover::Prover;
use chetaev_mechanics::{Prepared, System};
use chetaev_model::load;
use chetaev_motion::double_double::number;
use chetaev_orbits::flow::Coordinates;
use chetaev_orbits::multipliers::eigenvalues;
use chetaev_orbits::variational::{Extended, Order, Variational};
use chetaev_orbits::Flow;
use chetaev_stability::claims::CLAIMS;
use chetaev_stability::expansion::Expansion;
use chetaev_symbolic::{Expr, Symbol};
use std::collections::BTreeMap;

/// Steele, Lea and Flood's generator (2014).
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A fraction of these ends with the denominator 20.
    fn fraction(&mut self, low: i64, high: i64) -> String {
        let width = u64::try_from(20 * (high - low) + 1).unwrap();
        let own = 20 * low + i64::try_from(self.next() % width).unwrap();
        format!("({own}/20)")
    }

    fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// A random system by its number.
fn system(seed: u64) -> (System, Prepared) {
    let mut r = Random(seed);
    let mut any = |low, high| r.fraction(low, high);
    let (low, high) = if seed.is_multiple_of(4) {
        (-4, -1)
    } else {
        (1, 4)
    };
    let damping = if seed.is_multiple_of(3) { 0 } else { 1 };
    let kinetic = format!(
        "1/2 ({} x'^2 + {} y'^2 + {} z'^2) + {} y x' y' + {} sin(x) y' z'",
        any(1, 3),
        any(1, 3),
        any(1, 3),
        any(-1, 1),
        any(-1, 1)
    );
    let potential = format!(
        "1/2 ({} x^2 + {} y^2 + {} z^2) + {} x y^2 + {} (1 - cos(x + z)) + {} x^2 z",
        any(low, high),
        any(1, 4),
        any(1, 4),
        any(-1, 1),
        any(0, 1),
        any(-1, 1)
    );
    let (turn, d) = (any(-2, 2), any(0, 2));
    let forces = format!(
        "x = \"{turn} y' - {damping} ({d} + 1/10) x'\"\ny = \"-{turn} x' - {damping} ({d} + 1/10) y'\"\nz = \"-{damping} ({d} + 1/10) z'\""
    );
    let constraint = match seed % 3 {
        0 => String::new(),
        _ => format!(
            "[constraints]\nlink = \"z' = ({} y + {} z) x' + {} sin(x) y' + {} y'\"",
            any(-2, 2),
            any(-1, 1),
            any(-2, 2),
            any(-1, 1)
        ),
    };
    let text = format!(
        "name = \"random\"\ncoordinates = [\"x\", \"y\", \"z\"]\n[lagrangian]\nT = \"{kinetic}\"\nV = \"{potential}\"\n[forces]\n{forces}\n{constraint}\n[steady.rest]\nx = 0\ny = 0\nz = 0\n\"x'\" = 0\n\"y'\" = 0\n\"z'\" = 0\n"
    );
    let loaded = load("random.toml", &text, &BTreeMap::new(), &[]);
    let model = loaded
        .model
        .unwrap_or_else(|| panic!("{}\n{text}", loaded.diagnostics));
    let system = System::from_model(&model).unwrap();
    let prepared = Prepared::new(&system).unwrap();
    (system, prepared)
}

fn flow(system: &System, prepared: &Prepared) -> Flow {
    let symbols = [system.coordinate_symbols(), system.velocity_symbols()].concat();
    let point: Vec<(Symbol, f64)> = symbols.into_iter().map(|s| (s, 0.0)).collect();
    let (terms, selection) = (&prepared.terms, &prepared.selection);
    let which = (Coordinates::NotIgnorable, &point[..]);
    Flow::of_system(system, terms, selection, which).unwrap()
}

/// A by the exact linear equations.
fn matrix(system: &System, prepared: &Prepared) -> Vec<Vec<Expr>> {
    let motion = &system.steady[0];
    let (terms, selection) = (&prepared.terms, &prepared.selection);
    let about = Expansion::new(system, terms, selection, motion, &[]).unwrap();
    about.state_space(&about.linear(), &[]).unwrap().a
}

/// The flow in double-double arithmetic.
struct Precise {
    taylor: PreciseTaylor,
    n: usize,
}

impl Precise {
    fn new(flow: &Flow) -> Precise {
        let variables = [vec![flow.time()], flow.variables.clone()].concat();
        let lowering = Lowering::new(&flow.graph).variables(&variables);
        let program = lowering.output("rates", &flow.rates).lower().unwrap();
        let mut taylor = PreciseTaylor::new(&program).unwrap();
        taylor.prepare(&[]).unwrap();
        Precise {
            taylor,
            n: flow.n(),
        }
    }

    fn end(&mut self, start: &[DoubleDouble], t: f64) -> Vec<DoubleDouble> {
        let span = (DoubleDouble::ZERO, DoubleDouble::from(t));
        let run = integrate(self, span, start, &[], PreciseOptions::tolerance(1e-28)).unwrap();
        assert_eq!(run.stop, Stop::Finished);
        run.state
    }

    /// The derivative of the flow by the initial value of one variable: central differences at steps h, h/2, h/4, and Richardson's extrapolation
    /// twice.
    fn derivative(&mut self, column: usize, t: f64) -> Vec<DoubleDouble> {
        let quotient = |own: &mut Precise, h: f64| -> Vec<DoubleDouble> {
            let mut start = vec![DoubleDouble::ZERO; own.n];
            start[column] = DoubleDouble::from(h);
            let above = own.end(&start, t);
            start[column] = DoubleDouble::from(-h);
            let below = own.end(&start, t);
            let pairs = above.into_iter().zip(below);
            pairs
                .map(|(a, b)| (a - b) / DoubleDouble::from(2.0 * h))
                .collect()
        };
        let h = 2.0_f64.powi(-12);
        let [a, b, c] = [h, 0.5 * h, 0.25 * h].map(|h| quotient(self, h));
        (0..self.n)
            .map(|i| {
                let (first, second) = (
                    (b[i] * 4.0 - a[i]) / DoubleDouble::from(3.0),
                    (c[i] * 4.0 - b[i]) / DoubleDouble::from(3.0),
                );
                (second * 16.0 - first) / DoubleDouble::from(15.0)
            })
            .collect()
    }
}

impl PreciseSystem for Precise {
    fn dimension(&self) -> usize {
        self.n
    }

    fn expand(
        &mut self,
        t: DoubleDouble,
        y: &[DoubleDouble],
        order: usize,
        coefficients: &mut [DoubleDouble],
    ) -> Result<(), EvaluationFailure> {
        let state = [&[t], y].concat();
        let made = self.taylor.expand(&state, order, coefficients);
        made.map_err(|_| EvaluationFailure::NoSeries)
    }
}

/// e^{A t} by its series.
fn exponential(a: &[Vec<DoubleDouble>], t: f64) -> Vec<Vec<DoubleDouble>> {
    let n = a.len();
    let unit = |r: usize, c: usize| DoubleDouble::from(f64::from(u8::from(r == c)));
    let square = |f: &dyn Fn(usize, usize) -> DoubleDouble| -> Vec<Vec<DoubleDouble>> {
        (0..n).map(|r| (0..n).map(|c| f(r, c)).collect()).collect()
    };
    let (mut sum, mut term) = (square(&unit), square(&unit));
    for k in 1..80 {
        let factor = DoubleDouble::from(t) / DoubleDouble::from(f64::from(k));
        let before = term.clone();
        term = square(&|r, c| {
            let products = (0..n).map(|i| before[r][i] * a[i][c]);
            products.fold(DoubleDouble::ZERO, |x, y| x + y) * factor
        });
        for (sum, term) in sum.iter_mut().flatten().zip(term.iter().flatten()) {
            *sum += *term;
        }
    }
    sum
}

/// The largest difference between e^{A t} and the derivative of the flow, in parts of the largest entry.
fn difference(a: &[Vec<DoubleDouble>], flow: &mut Precise, t: f64) -> f64 {
    let expected = exponential(a, t);
    let size = expected
        .iter()
        .flatten()
        .map(|x| x.abs().high())
        .fold(0.0, f64::max);
    let mut worst: f64 = 0.0;
    for column in 0..a.len() {
        let found = flow.derivative(column, t);
        for (row, own) in found.iter().enumerate() {
            let exact = expected[row][column];
            worst = worst.max((*own - exact).abs().high() / size);
        }
    }
    worst
}

/// e^{A t} is the derivative of the flow, to 1e-18 in double-double arithmetic at the time of the fastest mode; a term that is wrong by 1e-14 is seen.
#[test]
fn the_exponential_of_the_matrix_is_the_derivative_of_the_flow() {
    for seed in 0..24 {
        let (system, prepared) = system(seed);
        let flow = flow(&system, &prepared);
        let exact = matrix(&system, &prepared);
        let g = &system.graph;
        let value = |e: &Expr| number(g, *e).unwrap();
        let mut a: Vec<Vec<DoubleDouble>> = exact
            .iter()
            .map(|row| row.iter().map(value).collect())
            .collect();
        assert_eq!(a.len(), flow.n(), "{seed}");
        let slopes = flow.slopes(&vec![0.0; flow.n()], &[]).unwrap();
        let fastest = eigenvalues(&slopes).unwrap().into_iter().map(|l| l.norm());
        let t = 1.0 / fastest.fold(0.1, f64::max);
        let mut precise = Precise::new(&flow);
        let own = difference(&a, &mut precise, t);
        assert!(own < 1e-18, "{seed}: {own:e}");
        let last = a.len() - 1;
        a[last][0] += DoubleDouble::from(1e-14);
        let wrong = difference(&a, &mut precise, t);
        assert!(wrong > 1e-16, "{seed}: {wrong:e}");
    }
}

/// What is proved stable stays near when it is pushed a little, and what is refuted goes away.
#[test]
fn proved_stability_does_not_contradict_perturbed_runs() {
    let registry = Registry::new(&[CLAIMS]);
    let claim = registry.find("stability.nonlinear").unwrap();
    let mut counts = BTreeMap::new();
    for seed in 0..60 {
        let (system, prepared) = system(seed);
        let (terms, selection) = (&prepared.terms, &prepared.selection);
        let cx = Context::new(&system, terms, selection, &registry, Prover::default());
        let verdict = claim.decide(&cx, Some("rest")).verdict;
        *counts.entry(verdict.word()).or_insert(0) += 1;
        let flow = flow(&system, &prepared);
        let slopes = flow.slopes(&vec![0.0; flow.n()], &[]).unwrap();
        let growth = eigenvalues(&slopes).unwrap().into_iter().map(|l| l.re);
        let growth = growth.fold(f64::NEG_INFINITY, f64::max);
        let mut random = Random(1000 + seed);
        let start: Vec<f64> = (0..flow.n())
            .map(|_| 1e-5 * (random.unit() - 0.5))
            .collect();
        let mut motion = Variational::new(&flow, Vec::new(), Order::Motion).unwrap();
        let from = Extended::start(&start, &motion);
        let size = |z: &[f64]| z.iter().fold(0.0_f64, |a, x| a.max(x.abs()));
        match verdict.word() {
            "proved" => {
                let end = motion.end((0.0, 100.0), &from).unwrap();
                assert!(size(&end.state) < 1e-3, "{seed}: {end:?}");
            }
            "refuted" => {
                assert!(growth > 0.0, "{seed}");
                let time = (8.0 / growth).min(1000.0);
                let end = motion.end((0.0, time), &from);
                let is_away = end.map_or(true, |end| size(&end.state) > 10.0 * size(&start));
                assert!(is_away, "{seed}: {growth}");
            }
            _ => {}
        }
    }
    // All kinds occur, so that the law says something.
    assert!(
        counts["proved"] >= 20 && counts["refuted"] >= 5,
        "{counts:?}"
    );
}
