//! The functions of native code against enclosures at high precision: their greatest errors are those stated.
#![cfg(all(unix, target_arch = "x86_64"))]
#![allow(clippy::unwrap_used, clippy::print_stdout)] // A failure here is a failed test; the errors measured are shown.

use chetaev_compile::{BlockEvaluator, Evaluator, Lanes, Lowering, Native, Vectors, LANES};
use chetaev_symbolic::number::ball::{Ball, Precision};
use chetaev_symbolic::{Expr, Function, Graph};

/// One function, or two of one angle, as native code; `None` where there is none.
fn native(of: impl Fn(&Graph, Expr) -> Vec<Expr>) -> Option<Native> {
    let g = Graph::new();
    let x = g.symbol("x", 0);
    let program = Lowering::new(&g)
        .variables(&[g.as_symbol(x).unwrap()])
        .output("f", &of(&g, x))
        .lower()
        .unwrap();
    Native::new(program).unwrap()
}

fn function(function: Function) -> Option<Native> {
    native(|g, x| vec![g.apply(function, &[x])])
}

/// The values at every argument, by blocks and one by one, with all vectors that this machine has; all are the same.
fn values(native: &Native, arguments: &[f64]) -> Vec<Vec<f64>> {
    let program = native.program();
    let of = |vectors| Native::with_vectors(program.clone(), vectors).unwrap();
    let all = [Vectors::Avx2, Vectors::Avx512].into_iter().filter_map(of);
    let found: Vec<_> = all.map(|native| values_of(&native, arguments)).collect();
    let bits = |values: &[Vec<f64>]| -> Vec<u64> {
        values.iter().flatten().map(|x| x.to_bits()).collect()
    };
    for other in &found[1..] {
        assert_eq!(bits(&found[0]), bits(other));
    }
    found[0].clone()
}

/// The values at every argument, by blocks and one by one; both are the same.
fn values_of(native: &Native, arguments: &[f64]) -> Vec<Vec<f64>> {
    let count = native.program().output_count();
    let mut block = native.block_workspace();
    let mut single = native.workspace();
    native.prepare_block(&[], &mut block).unwrap();
    native.prepare(&[], &mut single).unwrap();
    let mut values = Vec::with_capacity(arguments.len());
    for chunk in arguments.chunks(LANES) {
        let x = Lanes::from_fn(|l| chunk[l % chunk.len()]);
        let mut outputs = vec![Lanes::default(); count];
        native
            .evaluate_block(1, &[x], &mut block, &mut outputs)
            .unwrap();
        for (l, &x) in chunk.iter().enumerate() {
            let mut alone = vec![0.0; count];
            native.evaluate(&[x], &mut single, &mut alone).unwrap();
            let together: Vec<f64> = outputs.iter().map(|o| o.as_slice()[l]).collect();
            let bits = |v: &[f64]| v.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
            assert_eq!(bits(&alone), bits(&together), "{x:e}");
            values.push(alone);
        }
    }
    values
}

/// The distance between doubles around a value: 2^(e − 52), not below that of subnormal numbers.
fn ulp(value: f64) -> Ball {
    let exponent = (value.abs().to_bits() >> 52) as i64;
    Ball::integer(1).shift(exponent.max(1) - 1075)
}

/// The error of `found` in units in the last place of the exact value.
fn error(precision: &Precision, found: f64, exact: &Ball) -> f64 {
    let found = Ball::from_f64(found).unwrap();
    let difference = precision.sub(&found, exact).unwrap();
    let unit = ulp(exact.to_f64());
    precision.div(&difference, &unit).unwrap().to_f64().abs()
}

/// Log-uniform magnitudes from 2^`least` to 2^`largest` with both signs, from a linear congruential generator
/// (Knuth 1997, 3.3.4, MMIX).
fn spread(count: usize, least: f64, largest: f64) -> Vec<f64> {
    let mut state = 12_345_u64;
    let mut unit = || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    (0..count)
        .map(|i| {
            let size = (least + (largest - least) * unit()).exp2();
            if i % 2 == 0 {
                size
            } else {
                -size
            }
        })
        .collect()
}

/// Doubles around multiples of π/2, where cancellation is worst, and around those of π/4, where polynomials end.
fn near_multiples() -> Vec<f64> {
    let mut arguments = Vec::new();
    let multiples = (1..200).chain((1..26).flat_map(|e| [(1 << e) - 1, 1 << e, (1 << e) + 1]));
    for n in multiples.chain([3_390_121, 24_806_577, 60_919_113, 67_108_864, 93_000_001]) {
        for unit in [std::f64::consts::FRAC_PI_2, std::f64::consts::FRAC_PI_4] {
            let x: f64 = unit * f64::from(n);
            for step in -2_i64..=2 {
                arguments.push(f64::from_bits((x.to_bits() as i64 + step) as u64));
            }
        }
    }
    arguments
}

fn assert_errors(
    name: &str,
    bound: f64,
    arguments: &[f64],
    found: &[Vec<f64>],
    precision: &Precision,
    exact: impl Fn(&Ball) -> Vec<Ball>,
) {
    let mut worst = (0.0, 0.0);
    for (&x, found) in arguments.iter().zip(found) {
        let exact = exact(&Ball::from_f64(x).unwrap());
        for (found, exact) in found.iter().zip(&exact) {
            let error = error(precision, *found, exact);
            if error > worst.0 {
                worst = (error, x);
            }
        }
    }
    println!("{name}: at most {:.3} ulp, at {:e}", worst.0, worst.1);
    assert!(worst.0 <= bound, "{name}: {} ulp at {:e}", worst.0, worst.1);
}

#[test]
fn sine_and_cosine_are_accurate_for_every_angle() {
    let Some(both) = native(|g, x| vec![g.sin(x), g.cos(x)]) else {
        return;
    };
    let ordinary = [
        spread(12_000, -8.0, 10.0),
        spread(2_000, -60.0, 27.0),
        near_multiples(),
    ]
    .concat();
    // π to the bits that reduce the largest doubles, and the digits left after worst cancellation.
    for (arguments, bits) in [(ordinary, 220), (spread(200, 26.0, 1023.9), 1400)] {
        let precision = Precision::new(bits);
        let found = values(&both, &arguments);
        let exact = |x: &Ball| {
            let (sin, cos) = precision.sin_cos(x).unwrap();
            vec![sin, cos]
        };
        assert_errors("sine, cosine", 0.71, &arguments, &found, &precision, exact);
    }
}

#[test]
fn a_sine_or_a_cosine_alone_is_that_of_both() {
    let both = native(|g, x| vec![g.sin(x), g.cos(x)]);
    let alone = (function(Function::Sin), function(Function::Cos));
    let (Some(both), (Some(sin), Some(cos))) = (both, alone) else {
        return;
    };
    let arguments = [spread(500, -10.0, 40.0), vec![f64::NAN, f64::INFINITY]].concat();
    let (both, sin, cos) = (
        values(&both, &arguments),
        values(&sin, &arguments),
        values(&cos, &arguments),
    );
    for i in 0..arguments.len() {
        let bits = |x: f64| if x.is_nan() { 0 } else { x.to_bits() };
        assert_eq!(bits(both[i][0]), bits(sin[i][0]), "{}", arguments[i]);
        assert_eq!(bits(both[i][1]), bits(cos[i][0]), "{}", arguments[i]);
    }
}

#[test]
fn the_exponential_is_accurate_from_zero_to_infinity() {
    let Some(exp) = function(Function::Exp) else {
        return;
    };
    let mut arguments = [spread(8_000, -6.0, 9.46), spread(500, -60.0, -6.0)].concat();
    // Results below the normal numbers, and the last ones that are finite or not zero.
    arguments.extend((0..400).map(|i| -708.0 - 0.0925 * f64::from(i)));
    arguments.extend([709.782_712_893_384, -745.133_219_101_941_1]);
    let precision = Precision::new(160);
    let found = values(&exp, &arguments);
    let exact = |x: &Ball| vec![precision.exp(x).unwrap()];
    assert_errors("exponential", 0.62, &arguments, &found, &precision, exact);
}

#[test]
fn the_logarithm_is_accurate_from_the_least_to_the_largest_number() {
    let Some(log) = function(Function::Log) else {
        return;
    };
    let positive = |list: Vec<f64>| list.into_iter().map(f64::abs).collect::<Vec<f64>>();
    let mut arguments = [
        positive(spread(4_000, -1.0, 1.0)),
        positive(spread(3_000, -1074.0, 1023.9)),
    ]
    .concat();
    arguments.extend(spread(3_000, -50.0, -1.5).iter().map(|f| 1.0 + f));
    arguments.retain(|&x| x != 1.0);
    let precision = Precision::new(200);
    let found = values(&log, &arguments);
    let exact = |x: &Ball| vec![precision.log(x).unwrap()];
    assert_errors("logarithm", 0.76, &arguments, &found, &precision, exact);
}

#[test]
fn the_square_root_is_correctly_rounded() {
    let Some(root) = native(|g, x| vec![g.sqrt(x)]) else {
        return;
    };
    let arguments: Vec<f64> = spread(2_000, -1070.0, 1023.9)
        .iter()
        .map(|x| x.abs())
        .collect();
    for (x, found) in arguments.iter().zip(values(&root, &arguments)) {
        assert_eq!(found[0], x.sqrt());
    }
}

#[test]
fn what_is_not_finite_is_as_in_the_library() {
    let special = [
        0.0,
        -0.0,
        f64::NAN,
        f64::INFINITY,
        f64::NEG_INFINITY,
        f64::MIN_POSITIVE,
        -f64::MIN_POSITIVE,
        5e-324,
        -5e-324,
        1.0,
        -1.0,
        f64::MAX,
        f64::MIN,
        1e300,
        -746.5,
        709.9,
    ];
    let compare = |name: &str, native: Option<Native>, expected: &dyn Fn(f64) -> f64| {
        let Some(native) = native else { return };
        for (&x, found) in special.iter().zip(values(&native, &special)) {
            let expected = expected(x);
            let agree = if expected.is_nan() {
                found[0].is_nan()
            } else if expected == 0.0 || !expected.is_finite() {
                found[0].to_bits() == expected.to_bits()
            } else {
                found[0].to_bits().abs_diff(expected.to_bits()) <= 1
            };
            assert!(agree, "{name} of {x:e}: {:e}, not {expected:e}", found[0]);
        }
    };
    compare("sin", function(Function::Sin), &f64::sin);
    compare("cos", function(Function::Cos), &f64::cos);
    compare("exp", function(Function::Exp), &f64::exp);
    compare("log", function(Function::Log), &f64::ln);
    compare("abs", function(Function::Abs), &f64::abs);
    compare("atan", function(Function::Atan), &f64::atan);
    compare("tanh", function(Function::Tanh), &f64::tanh);
    compare("sqrt", native(|g, x| vec![g.sqrt(x)]), &f64::sqrt);
    let sign = |x: f64| {
        if x > 0.0 {
            1.0
        } else if x < 0.0 {
            -1.0
        } else {
            0.0
        }
    };
    compare("sign", function(Function::Sign), &sign);
}

#[test]
fn functions_of_the_library_are_called_with_everything_else_kept() {
    let g = Graph::new();
    let symbols: Vec<Expr> = (0..20).map(|i| g.symbol(&format!("x_{i}"), 0)).collect();
    let calls = [
        Function::Asin,
        Function::Acos,
        Function::Atan,
        Function::Sinh,
        Function::Cosh,
        Function::Tanh,
        Function::Asinh,
        Function::Acosh,
        Function::Atanh,
    ];
    // Products that are alive across all calls.
    let mut outputs: Vec<Expr> = symbols.iter().map(|&x| g.mul(&[x, g.sin(x)])).collect();
    for (i, &function) in calls.iter().enumerate() {
        let argument = g.mul(&[outputs[i], outputs[i + 1], g.integer(1)]);
        outputs.push(g.apply(function, &[argument]));
    }
    outputs.push(g.apply(Function::Atan2, &[outputs[3], outputs[4]]));
    outputs.push(g.pow(outputs[5], outputs[6]));
    outputs.push(g.add(&outputs));
    let names: Vec<_> = symbols.iter().map(|&x| g.as_symbol(x).unwrap()).collect();
    let program = Lowering::new(&g)
        .variables(&names)
        .output("all", &outputs)
        .lower()
        .unwrap();
    let Some(native) = Native::new(program).unwrap() else {
        return;
    };
    let point: Vec<f64> = (0..20).map(|i| 0.4 + 0.1 * f64::from(i)).collect();
    let expected = g
        .evaluate_f64(&outputs, &|s| {
            names.iter().position(|&name| name == s).map(|i| point[i])
        })
        .unwrap();
    let mut workspace = native.workspace();
    native.prepare(&[], &mut workspace).unwrap();
    let mut found = vec![0.0; outputs.len()];
    native.evaluate(&point, &mut workspace, &mut found).unwrap();
    for (i, (e, f)) in expected.iter().zip(&found).enumerate() {
        let agree = (e - f).abs() <= 1e-14 * e.abs().max(1.0) || (e.is_nan() && f.is_nan());
        assert!(agree, "output {i}: {e} {f}");
    }
}

#[test]
fn angles_of_one_state_do_not_disturb_each_other() {
    let count = 7;
    let g = Graph::new();
    let angles: Vec<Expr> = (0..count).map(|i| g.symbol(&format!("x_{i}"), 0)).collect();
    let names: Vec<_> = angles.iter().map(|&x| g.as_symbol(x).unwrap()).collect();
    // Differences need an instruction before they are known; the last sine is needed for another angle.
    let mut all = angles.clone();
    all.push(g.sub(angles[0], angles[1]));
    all.push(g.add(&[g.sin(angles[6]), angles[2]]));
    let outputs: Vec<Expr> = all.iter().flat_map(|&x| [g.sin(x), g.cos(x)]).collect();
    let program = Lowering::new(&g)
        .variables(&names)
        .output("all", &outputs)
        .lower()
        .unwrap();
    let alone = native(|g, x| vec![g.sin(x), g.cos(x)]);
    let (Some(together), Some(alone)) = (Native::new(program).unwrap(), alone) else {
        return;
    };
    let mut workspace = together.workspace();
    together.prepare(&[], &mut workspace).unwrap();
    let special = [
        0.5,
        1e300,
        f64::NAN,
        std::f64::consts::PI,
        -0.0,
        3e5,
        -7.25,
        f64::INFINITY,
    ];
    for shift in 0..special.len() {
        let mut point: Vec<f64> = (0..count).map(|i| special[(i + shift) % 8]).collect();
        let mut found = vec![0.0; outputs.len()];
        together
            .evaluate(&point, &mut workspace, &mut found)
            .unwrap();
        point.push(point[0] - point[1]);
        point.push(found[12] + point[2]);
        let expected = values(&alone, &point).concat();
        let bits = |v: &[f64]| -> Vec<u64> {
            let canonical = |x: &f64| if x.is_nan() { 0 } else { x.to_bits() };
            v.iter().map(canonical).collect()
        };
        assert_eq!(bits(&found), bits(&expected), "{point:?}");
    }
}
