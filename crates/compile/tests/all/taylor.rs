//! Taylor coefficients against repeated symbolic differentiation with exact rationals, and linear systems solved as a
//! whole against the same systems eliminated symbolically.
#![allow(clippy::unwrap_used)] // A failure here is a failed test.

use chetaev_compile::{EvaluateFailure, Lowering, Taylor};
use chetaev_symbolic::rational::{integer, ratio, to_f64};
use chetaev_symbolic::{Expr, Function, Graph, Rational, Symbol};

/// A linear congruential generator (Knuth 1997, 3.3.4, MMIX), so that a failing seed can be repeated.
struct Random(u64);

impl Random {
    fn below(&mut self, n: usize) -> usize {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 33) as usize) % n
    }
}

/// Variables that move as polynomials of t, so that every coefficient of an expression in them is known exactly.
struct Path {
    g: Graph,
    t: Symbol,
    symbols: Vec<Symbol>,
    /// By variable: its coefficients.
    coefficients: Vec<Vec<Rational>>,
}

impl Path {
    fn new() -> Path {
        let g = Graph::new();
        let r = |a, b| ratio(a, b).unwrap();
        Path {
            t: g.intern_symbol("t", 0),
            symbols: ["x", "y", "z"]
                .map(|name| g.intern_symbol(name, 0))
                .to_vec(),
            coefficients: vec![
                vec![r(1, 2), r(1, 1), r(-1, 3)],
                vec![r(-1, 3), r(2, 3), r(0, 1), r(1, 2)],
                vec![r(3, 2), r(-1, 2), r(1, 5), r(1, 7), r(-1, 4)],
            ],
            g,
        }
    }

    /// The expression as a function of t.
    fn along(&self, e: Expr) -> Expr {
        let g = &self.g;
        let t = g.symbol_expr(self.t);
        let pairs: Vec<(Expr, Expr)> = self
            .symbols
            .iter()
            .zip(&self.coefficients)
            .map(|(&s, c)| {
                let terms = c.iter().enumerate();
                let terms: Vec<Expr> = terms
                    .map(|(j, c)| g.scale(c, g.powi(t, j as i64)))
                    .collect();
                (g.symbol_expr(s), g.add(&terms))
            })
            .collect();
        g.substitute(e, &pairs)
    }

    /// The value at t = 0, where it is rational.
    fn at_zero(&self, along: Expr) -> Option<Rational> {
        let g = &self.g;
        let value = g.substitute(along, &[(g.symbol_expr(self.t), g.zero())]);
        g.as_number(value).cloned()
    }

    /// Normalized coefficients by repeated differentiation; where order 0 is irrational it is left out as `None`.
    fn exact(&self, e: Expr, orders: usize) -> Vec<Option<Rational>> {
        let mut derivative = self.along(e);
        let mut factorial = integer(1);
        let mut found = Vec::new();
        for j in 0..=orders {
            if j > 0 {
                derivative = self.g.diff(derivative, self.t);
                factorial *= integer(j as i64);
            }
            found.push(self.at_zero(derivative).map(|value| value / &factorial));
        }
        found
    }

    /// The same by the recurrences, for several expressions at once.
    fn series(&self, expressions: &[Expr], orders: usize) -> Vec<Vec<f64>> {
        let lowering = Lowering::new(&self.g).variables(&self.symbols);
        let program = lowering.output("values", expressions).lower().unwrap();
        let found = self.by(&Taylor::new(&program).unwrap(), orders);
        let interpreted = self.by(&Taylor::interpreter(&program).unwrap(), orders);
        for (found, interpreted) in found.iter().zip(&interpreted) {
            // Where terms of size one cancel, their rounding is left.
            let mut scale: f64 = 1e-2;
            for (j, (a, b)) in found.iter().zip(interpreted).enumerate() {
                scale = scale.max(b.abs());
                assert!((a - b).abs() <= 1e-13 * scale, "order {j}: {a:e} and {b:e}");
            }
        }
        found
    }

    /// The series that one back end finds.
    fn by(&self, taylor: &Taylor, orders: usize) -> Vec<Vec<f64>> {
        let mut workspace = taylor.workspace(orders);
        taylor.prepare(&[], &mut workspace).unwrap();
        let mut found = vec![Vec::new(); taylor.output_count()];
        for j in 0..=orders {
            let inputs: Vec<f64> = self
                .coefficients
                .iter()
                .map(|c| c.get(j).map_or(0.0, to_f64))
                .collect();
            match j {
                0 => taylor.start(&inputs, &mut workspace).unwrap(),
                _ => taylor.advance(&inputs, &mut workspace).unwrap(),
            }
            for (k, found) in found.iter_mut().enumerate() {
                found.push(taylor.output(k, &workspace));
            }
        }
        found
    }

    fn compare(&self, e: Expr, orders: usize, what: &str) {
        let exact = self.exact(e, orders);
        let found = &self.series(&[e], orders)[0];
        let mut scale: f64 = 1e-3;
        for (j, (exact, found)) in exact.iter().zip(found).enumerate() {
            let Some(exact) = exact.as_ref().map(to_f64) else {
                assert_eq!(j, 0, "{what}: order {j} is not rational");
                continue;
            };
            scale = scale.max(exact.abs());
            assert!(
                (found - exact).abs() <= 2e-13 * scale,
                "{what}, order {j}: {found:e} instead of {exact:e}"
            );
        }
    }
}

/// Functions with a place at which all derivatives are rational; the last ones have an irrational value there.
const PLACES: [(Function, i64, i64); 20] = [
    (Function::Sin, 0, 1),
    (Function::Cos, 0, 1),
    (Function::Tan, 0, 1),
    (Function::Sec, 0, 1),
    (Function::Exp, 0, 1),
    (Function::Log, 1, 1),
    (Function::Sinh, 0, 1),
    (Function::Cosh, 0, 1),
    (Function::Tanh, 0, 1),
    (Function::Asin, 0, 1),
    (Function::Atan, 0, 1),
    (Function::Asinh, 0, 1),
    (Function::Atanh, 0, 1),
    (Function::Abs, -2, 3),
    (Function::Acos, 3, 5),
    (Function::Asin, 3, 5),
    (Function::Acosh, 5, 4),
    (Function::Acosh, 13, 12),
    (Function::Atan, 2, 3),
    (Function::Atanh, 1, 3),
];

/// How many of them have a rational value.
const RATIONAL: usize = 14;

/// `function(argument)`, the argument moved so that at t = 0 it is at the place.
fn placed(path: &Path, (function, a, b): (Function, i64, i64), argument: Expr) -> Option<Expr> {
    let g = &path.g;
    let now = path.at_zero(path.along(argument))?;
    let shift = ratio(a, b).unwrap() - now;
    Some(g.apply(function, &[g.add(&[argument, g.number(shift)])]))
}

#[test]
fn every_function_and_operation() {
    let path = Path::new();
    let g = &path.g;
    let [x, y, z] = [0, 1, 2].map(|i| g.symbol_expr(path.symbols[i]));
    let inner = g.add(&[x, g.mul(&[y, z])]);
    for place in PLACES {
        let e = placed(&path, place, inner).unwrap();
        path.compare(e, 10, place.0.name());
    }
    let number = |a, b| g.number(ratio(a, b).unwrap());
    // z = 3/2, so that z + 3/4 = 9/4 has a rational root; x + 1/2 = 1 has every power.
    let square = g.add(&[z, number(3, 4)]);
    let one = g.add(&[x, number(1, 2)]);
    let angle = g.apply(Function::Atan2, &[inner, square]);
    for (e, what) in [
        (g.sqrt(square), "sqrt"),
        (g.powi(square, -3), "reciprocal power"),
        (g.pow(square, number(-3, 2)), "half-integer power"),
        (g.pow(one, number(7, 3)), "power"),
        (g.pow(one, number(-1, 5)), "negative power"),
        (g.powi(one, 70), "large power"),
        (g.pow(one, inner), "moving exponent"),
        (g.div(inner, square), "quotient"),
        (g.div(number(2, 3), square), "reciprocal"),
        (g.powi(inner, 2), "square"),
        (g.sub(number(1, 7), inner), "difference"),
        (g.mul(&[x, y, z, inner]), "product"),
        (angle, "atan2"),
        (number(5, 2), "number"),
        (y, "variable"),
    ] {
        path.compare(e, 10, what);
    }
}

#[test]
fn sine_and_cosine_of_one_angle_alone_and_together() {
    let path = Path::new();
    let g = &path.g;
    let angle = g.sub(
        g.symbol_expr(path.symbols[0]),
        g.number(ratio(1, 2).unwrap()),
    );
    let (sin, cos) = (g.sin(angle), g.cos(angle));
    path.compare(g.mul(&[sin, cos]), 10, "both");
    let together = path.series(&[sin, cos], 12);
    assert_eq!(together[0], path.series(&[sin], 12)[0]);
    assert_eq!(together[1], path.series(&[cos], 12)[0]);
}

fn grow(path: &Path, random: &mut Random, pool: &[Expr]) -> Option<Expr> {
    let g = &path.g;
    let pick = |random: &mut Random| pool[random.below(pool.len())];
    let number = |random: &mut Random| {
        let numerator = 1 + random.below(4) as i64;
        g.number(ratio(numerator, 1 + random.below(3) as i64).unwrap())
    };
    let (a, b, c) = (pick(random), pick(random), pick(random));
    Some(match random.below(8) {
        0 => g.add(&[a, b, number(random)]),
        1 => g.sub(g.mul(&[a, b]), c),
        2 => g.mul(&[a, b, number(random)]),
        3 => {
            let now = path.at_zero(path.along(b))?;
            // The divisor at least 1 away from zero.
            let shift = integer(2) - now;
            g.div(a, g.add(&[b, g.number(shift)]))
        }
        4 => g.powi(a, 2 + random.below(3) as i64),
        5 => {
            let now = path.at_zero(path.along(a))?;
            g.sqrt(g.add(&[a, g.number(ratio(9, 4)? - now)]))
        }
        _ => placed(path, PLACES[random.below(RATIONAL)], a)?,
    })
}

#[test]
fn random_expressions_agree_with_their_derivatives() {
    let mut compared = 0;
    for seed in 0..60 {
        let path = Path::new();
        let mut random = Random(seed);
        let mut pool: Vec<Expr> = path
            .symbols
            .iter()
            .map(|&s| path.g.symbol_expr(s))
            .collect();
        for _ in 0..3 {
            let grown = grow(&path, &mut random, &pool);
            pool.extend(grown);
        }
        let e = *pool.last().unwrap();
        if path.exact(e, 0)[0].is_some() {
            path.compare(e, 8, &format!("seed {seed}: {}", path.g.text(e)));
            compared += 1;
        }
    }
    assert!(compared > 40, "{compared}");
}

/// x = A⁻¹ b by elimination without pivoting, in the graph.
fn eliminated(g: &Graph, n: usize, a: &[Expr], b: &[Expr]) -> Vec<Expr> {
    let (mut a, mut b) = (a.to_vec(), b.to_vec());
    for k in 0..n {
        for i in k + 1..n {
            let factor = g.div(a[i * n + k], a[k * n + k]);
            for j in k..n {
                a[i * n + j] = g.sub(a[i * n + j], g.mul(&[factor, a[k * n + j]]));
            }
            b[i] = g.sub(b[i], g.mul(&[factor, b[k]]));
        }
    }
    for i in (0..n).rev() {
        for j in i + 1..n {
            b[i] = g.sub(b[i], g.mul(&[a[i * n + j], b[j]]));
        }
        b[i] = g.div(b[i], a[i * n + i]);
    }
    b
}

#[test]
fn a_linear_system_as_a_whole_and_eliminated() {
    for (n, seed) in [(2, 1), (3, 2), (4, 3), (5, 4)] {
        let path = Path::new();
        let g = &path.g;
        let mut random = Random(seed);
        let pool: Vec<Expr> = path.symbols.iter().map(|&s| g.symbol_expr(s)).collect();
        let mut entry = |i: usize, j: usize| {
            let a = pool[random.below(3)];
            let value = match random.below(5) {
                0 => g.zero(),
                1 => g.number(ratio(1, 3).unwrap()),
                2 => g.sin(a),
                3 => g.mul(&[a, pool[random.below(3)]]),
                _ => a,
            };
            match i == j {
                true => g.add(&[value, g.number(integer(4))]),
                false => value,
            }
        };
        let a: Vec<Expr> = (0..n * n).map(|k| entry(k / n, k % n)).collect();
        let b: Vec<Expr> = (0..n).map(|i| entry(i, i + 1)).collect();
        let whole = path.series(&g.solve(&a, &b).unwrap(), 20);
        let unrolled = path.series(&eliminated(g, n, &a, &b), 20);
        for (whole, unrolled) in whole.iter().zip(&unrolled) {
            let mut scale: f64 = 1e-3;
            for (j, (a, b)) in whole.iter().zip(unrolled).enumerate() {
                scale = scale.max(b.abs());
                assert!(
                    (a - b).abs() <= 1e-13 * scale,
                    "n = {n}, order {j}: {a:e} {b:e}"
                );
            }
        }
    }
}

#[test]
fn two_right_hand_sides_and_a_constant_matrix() {
    let path = Path::new();
    let g = &path.g;
    let [x, y] = [0, 1].map(|i| g.symbol_expr(path.symbols[i]));
    let n = |a, b| g.number(ratio(a, b).unwrap());
    // A constant matrix: every order is solved by itself.
    let a = [n(2, 1), n(1, 1), n(-1, 1), n(3, 1)];
    let constant = g.solve(&a, &[x, g.mul(&[x, y])]).unwrap();
    let moving = [n(2, 1), y, x, n(3, 1)];
    let first = g.solve(&moving, &[x, y]).unwrap();
    let second = g.solve(&moving, &[g.sin(y), n(1, 1)]).unwrap();
    let by_hand = [
        g.div(g.sub(g.scale(&integer(3), x), g.mul(&[x, y])), n(7, 1)),
        g.div(g.add(&[x, g.scale(&integer(2), g.mul(&[x, y]))]), n(7, 1)),
    ];
    let determinant = g.sub(n(6, 1), g.mul(&[x, y]));
    let unrolled = [
        g.div(g.sub(g.scale(&integer(3), x), g.powi(y, 2)), determinant),
        g.div(g.sub(n(2, 1), g.mul(&[x, g.sin(y)])), determinant),
    ];
    let found = path.series(&[constant[0], constant[1], first[0], second[1]], 15);
    let expected = path.series(&[by_hand[0], by_hand[1], unrolled[0], unrolled[1]], 15);
    for (found, expected) in found.iter().zip(&expected) {
        for (a, b) in found.iter().zip(expected) {
            assert!((a - b).abs() <= 1e-14 * (1.0 + b.abs()), "{a:e} {b:e}");
        }
    }
}

#[test]
fn where_there_is_no_series() {
    let g = Graph::new();
    let symbol = g.intern_symbol("x", 0);
    let x = g.symbol_expr(symbol);
    for (e, operation) in [
        (g.sqrt(x), "sqrt"),
        (g.apply(Function::Log, &[x]), "log"),
        (g.powi(x, -1), "division"),
        (g.apply(Function::Abs, &[x]), "abs"),
        (g.apply(Function::Sign, &[x]), "sign"),
        (g.apply(Function::Atan2, &[x, g.powi(x, 2)]), "atan2"),
        (
            g.pow(x, g.number(ratio(1, 3).unwrap())),
            "a power with this exponent",
        ),
    ] {
        let lowering = Lowering::new(&g).variables(&[symbol]);
        let taylor = Taylor::new(&lowering.output("e", &[e]).lower().unwrap()).unwrap();
        let mut workspace = taylor.workspace(3);
        let unprepared = taylor.start(&[1.0], &mut workspace);
        assert_eq!(unprepared, Err(EvaluateFailure::NotPrepared));
        taylor.prepare(&[], &mut workspace).unwrap();
        let expected = EvaluateFailure::NotAnalytic {
            operation,
            argument: 0.0,
        };
        assert_eq!(taylor.start(&[0.0], &mut workspace), Err(expected));
        let not_started = taylor.advance(&[1.0], &mut workspace);
        assert_eq!(not_started, Err(EvaluateFailure::NotPrepared));
        taylor.start(&[1.0], &mut workspace).unwrap();
        for _ in 0..3 {
            taylor.advance(&[0.5], &mut workspace).unwrap();
        }
        let beyond = taylor.advance(&[0.5], &mut workspace);
        assert_eq!(beyond, Err(EvaluateFailure::NotPrepared));
    }
}

#[test]
fn parameters_cost_no_convolutions() {
    let g = Graph::new();
    let [x, m, k] = ["x", "m", "k"].map(|name| g.intern_symbol(name, 0));
    let [a, b, c] = [x, m, k].map(|s| g.symbol_expr(s));
    // m k² x + sin(k)/m: a multiple of x and a constant.
    let e = g.add(&[g.mul(&[b, g.powi(c, 2), a]), g.div(g.sin(c), b)]);
    let lowering = Lowering::new(&g).variables(&[x]).parameters(&[m, k]);
    let taylor = Taylor::new(&lowering.output("e", &[e, c]).lower().unwrap()).unwrap();
    assert_eq!(taylor.counts().0, 0);
    let mut workspace = taylor.workspace(4);
    taylor.prepare(&[2.0, 3.0], &mut workspace).unwrap();
    taylor.start(&[0.5], &mut workspace).unwrap();
    assert_eq!(taylor.output(0, &workspace), 9.0 + 3f64.sin() / 2.0);
    assert_eq!(taylor.output(1, &workspace), 3.0);
    taylor.advance(&[0.25], &mut workspace).unwrap();
    assert_eq!(taylor.output(0, &workspace), 4.5);
    assert_eq!(taylor.output(1, &workspace), 0.0);
}

/// Normalized coefficients of functions of 1 + t or t whose series are known in closed form, to the highest order.
#[test]
fn series_in_closed_form_to_high_orders() {
    const ORDER: usize = 40;
    let g = Graph::new();
    let symbol = g.intern_symbol("x", 0);
    let x = g.symbol_expr(symbol);
    let above = g.add(&[x, g.one()]);
    let half = g.number(ratio(1, 2).unwrap());
    let factorial = |n: usize| (1..=n).map(|i| i as f64).product::<f64>();
    // C(c, j) by its product, exact in rationals.
    let binomial = |a: i64, b: i64, j: usize| {
        let mut product = integer(1);
        for i in 0..j as i64 {
            product = product * (ratio(a, b).unwrap() - integer(i)) / integer(i + 1);
        }
        to_f64(&product)
    };
    let alternating = |j: usize| if j.is_multiple_of(2) { 1.0 } else { -1.0 };
    let odd = |j: usize, value: f64| if j % 2 == 1 { value } else { 0.0 };
    let even = |j: usize, value: f64| if j.is_multiple_of(2) { value } else { 0.0 };
    type Closed<'c> = (Expr, Box<dyn Fn(usize) -> f64 + 'c>);
    let cases: Vec<Closed<'_>> = vec![
        (g.exp(x), Box::new(|j| 1.0 / factorial(j))),
        (
            g.sin(x),
            Box::new(|j| odd(j, alternating(j / 2) / factorial(j))),
        ),
        (
            g.cos(x),
            Box::new(|j| even(j, alternating(j / 2) / factorial(j))),
        ),
        (
            g.apply(Function::Sinh, &[x]),
            Box::new(|j| odd(j, 1.0 / factorial(j))),
        ),
        (
            g.apply(Function::Cosh, &[x]),
            Box::new(|j| even(j, 1.0 / factorial(j))),
        ),
        (
            g.apply(Function::Log, &[above]),
            Box::new(|j| {
                if j == 0 {
                    0.0
                } else {
                    -alternating(j) / j as f64
                }
            }),
        ),
        (
            g.apply(Function::Atan, &[x]),
            Box::new(|j| odd(j, alternating(j / 2) / j as f64)),
        ),
        (
            g.apply(Function::Atanh, &[x]),
            Box::new(|j| odd(j, 1.0 / j as f64)),
        ),
        (
            g.apply(Function::Asin, &[x]),
            Box::new(|j| odd(j, alternating(j / 2) * binomial(-1, 2, j / 2) / j as f64)),
        ),
        (
            g.apply(Function::Asinh, &[x]),
            Box::new(|j| odd(j, binomial(-1, 2, j / 2) / j as f64)),
        ),
        (g.sqrt(above), Box::new(|j| binomial(1, 2, j))),
        (
            g.pow(above, g.number(ratio(-7, 3).unwrap())),
            Box::new(|j| binomial(-7, 3, j)),
        ),
        (g.powi(above, -1), Box::new(alternating)),
        (g.powi(above, 5), Box::new(|j| binomial(5, 1, j))),
        (
            g.div(half, g.sub(g.one(), g.mul(&[half, x]))),
            Box::new(|j| 0.5f64.powi(j as i32 + 1)),
        ),
        (
            g.apply(Function::Atan2, &[x, g.one()]),
            Box::new(|j| odd(j, alternating(j / 2) / j as f64)),
        ),
    ];
    let expressions: Vec<Expr> = cases.iter().map(|case| case.0).collect();
    let lowering = Lowering::new(&g).variables(&[symbol]);
    let program = lowering.output("all", &expressions).lower().unwrap();
    for taylor in [Taylor::new(&program), Taylor::interpreter(&program)] {
        let taylor = taylor.unwrap();
        let mut workspace = taylor.workspace(ORDER);
        taylor.prepare(&[], &mut workspace).unwrap();
        for j in 0..=ORDER {
            match j {
                0 => taylor.start(&[0.0], &mut workspace).unwrap(),
                1 => taylor.advance(&[1.0], &mut workspace).unwrap(),
                _ => taylor.advance(&[0.0], &mut workspace).unwrap(),
            }
            for (k, (e, closed)) in cases.iter().enumerate() {
                let (found, exact) = (taylor.output(k, &workspace), closed(j));
                let scale = exact.abs().max(1e-3 * 0.5f64.powi(j as i32));
                let what = g.text(*e);
                assert!(
                    (found - exact).abs() <= 1e-14 * scale * (j + 1) as f64,
                    "{what}, order {j}: {found:e} instead of {exact:e}"
                );
            }
        }
    }
}

/// The series of a motion: orders of the variables follow from the outputs, whichever back end runs.
#[test]
fn the_series_of_a_motion() {
    // A pendulum of equation x'' = −sin x, and z' = 1/(1 + t), from the regular recurrences of any order.
    let g = Graph::new();
    let symbols = ["t", "x", "v", "z"].map(|name| g.intern_symbol(name, 0));
    let [t, x, v, _] = symbols.map(|s| g.symbol_expr(s));
    let rates = [v, g.neg(g.sin(x)), g.powi(g.add(&[t, g.one()]), -1)];
    let lowering = Lowering::new(&g).variables(&symbols);
    let program = lowering.output("rates", &rates).lower().unwrap();
    for taylor in [Taylor::new(&program), Taylor::interpreter(&program)] {
        let taylor = taylor.unwrap();
        let mut workspace = taylor.workspace(20);
        taylor.prepare(&[], &mut workspace).unwrap();
        let mut c = vec![0.0; 21 * 3];
        // Twice, and between them from elsewhere: nothing is left of what was before.
        for start in [
            [0.0, 1.0, 0.5, 0.0],
            [0.0, f64::MAX, 1e300, 0.0],
            [0.0, 1.0, 0.5, 0.0],
        ] {
            taylor.expand(&start, 20, &mut workspace, &mut c).unwrap();
        }
        let (sin, cos) = 1f64.sin_cos();
        // x'' = −sin x, x''' = −cos x x', x'''' = sin x x'² + cos x sin x.
        let expected = [
            1.0,
            0.5,
            -sin / 2.0,
            -0.5 * cos / 6.0,
            (0.25 * sin + cos * sin) / 24.0,
        ];
        for (j, expected) in expected.into_iter().enumerate() {
            assert!(
                (c[3 * j] - expected).abs() < 1e-15,
                "order {j}: {}",
                c[3 * j]
            );
        }
        for j in 1..=20 {
            let closed = if j % 2 == 1 { 1.0 } else { -1.0 } / j as f64;
            assert!(
                (c[3 * j + 2] - closed).abs() < 1e-14,
                "order {j}: {}",
                c[3 * j + 2]
            );
        }
        // Energy: (v² /2 − cos x) has no coefficient above order 0, so v v' + sin x x' = 0 at another place too.
        let at = |k: usize, h: f64| (0..=20).rev().fold(0.0, |sum, j| c[3 * j + k] + h * sum);
        let energy = |h: f64| at(1, h).powi(2) / 2.0 - at(0, h).cos();
        assert!((energy(0.3) - energy(0.0)).abs() < 1e-14);
        let wrong = taylor.expand(&[0.0; 4], 20, &mut workspace, &mut c[1..]);
        assert!(matches!(wrong, Err(EvaluateFailure::Length { .. })));
        let beyond = taylor.expand(&[0.0; 4], 21, &mut workspace, &mut [0.0; 66]);
        assert_eq!(beyond, Err(EvaluateFailure::NotPrepared));
    }
}
