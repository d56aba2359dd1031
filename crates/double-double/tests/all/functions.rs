//! Precision against exact rationals, functions against balls of 256 bits.
#![allow(clippy::unwrap_used, reason = "test code fails where it stands")]

use chetaev_double_double::DoubleDouble;
use chetaev_symbolic::number::ball::{Ball, BallResult, Precision};
use chetaev_symbolic::number::random::Random;
use chetaev_symbolic::{rational, Rational};

fn exact(x: DoubleDouble) -> Rational {
    let part = |value: f64| Rational::try_from(value).unwrap();
    part(x.high()) + part(x.low())
}

/// A number of 106 bits of any sign with a binary exponent in the range.
fn draw(random: &mut Random, (least, most): (i64, i64)) -> DoubleDouble {
    let mut unit = || random.below(1 << 53) as f64 / (1u64 << 53) as f64;
    let (high, low) = (1.0 + unit(), unit() - 0.5);
    let sign = if unit() < 0.5 { -1.0 } else { 1.0 };
    let exponent = random.between(least, most) as i32;
    DoubleDouble::new(sign * high, low * 2f64.powi(-53)).scaled(2f64.powi(exponent))
}

/// |found − expected| over the size of expected, in units of 2⁻¹⁰⁴.
fn units(found: DoubleDouble, expected: &Rational) -> f64 {
    let error = exact(found) - expected.clone();
    if error.is_zero() {
        return 0.0;
    }
    let ratio = rational::abs(&(error / expected.clone()));
    rational::to_f64(&(ratio * rational::powi(&rational::integer(2), 104).unwrap()))
}

#[test]
fn operations_are_exact_to_a_unit() {
    let mut random = Random::new(7);
    let mut worst = [0.0f64; 5];
    for _ in 0..2000 {
        let (a, b) = (draw(&mut random, (-60, 60)), draw(&mut random, (-60, 60)));
        let (x, y) = (exact(a), exact(b));
        // Of numbers next to each other the difference has no error at all.
        let near = a + draw(&mut random, (-70, -50)).scaled(a.high());
        assert_eq!(exact(a - near), x.clone() - exact(near));
        let found = [
            units(a + b, &(x.clone() + y.clone())),
            units(a - b, &(x.clone() - y.clone())),
            units(a * b, &(x.clone() * y.clone())),
            units(a / b, &(x.clone() / y)),
            {
                let root = a.abs().sqrt();
                // Of the square, twice that of the root.
                units(
                    root,
                    &((exact(root) + rational::abs(&x) / exact(root)) / rational::integer(2)),
                )
            },
        ];
        for (worst, found) in worst.iter_mut().zip(found) {
            *worst = worst.max(found);
        }
    }
    assert!(worst.iter().all(|&w| w <= 1.0), "{worst:?}");
    assert!(
        worst.iter().all(|&w| w > 0.01),
        "nothing was looked at: {worst:?}"
    );
}

type Ours = fn(DoubleDouble) -> DoubleDouble;
type Theirs = fn(&Precision, &Ball) -> BallResult;

type Case = (&'static str, Ours, Theirs, (i64, i64), f64);

/// Functions with the binary exponents of their arguments and the units allowed.
const FUNCTIONS: &[Case] = &[
    ("exp", DoubleDouble::exp, |a, x| a.exp(x), (-40, 2), 8.0),
    ("sinh", DoubleDouble::sinh, |a, x| a.sinh(x), (-40, 3), 16.0),
    ("cosh", DoubleDouble::cosh, |a, x| a.cosh(x), (-40, 3), 16.0),
    ("tanh", DoubleDouble::tanh, |a, x| a.tanh(x), (-40, 4), 16.0),
    (
        "asinh",
        DoubleDouble::asinh,
        |a, x| a.asinh(x),
        (-40, 60),
        16.0,
    ),
    ("atan", DoubleDouble::atan, |a, x| a.atan(x), (-40, 60), 8.0),
    ("asin", DoubleDouble::asin, |a, x| a.asin(x), (-40, -2), 8.0),
    ("acos", DoubleDouble::acos, |a, x| a.acos(x), (-40, -2), 8.0),
    (
        "atanh",
        DoubleDouble::atanh,
        |a, x| a.atanh(x),
        (-40, -2),
        16.0,
    ),
    (
        "log",
        |x| x.abs().ln(),
        |a, x| a.log(&a.abs(x)),
        (-300, 300),
        8.0,
    ),
    (
        "log next to 1",
        |x| (DoubleDouble::ONE + x).ln(),
        |a, x| a.log(&a.add(&Ball::integer(1), x)?),
        (-30, -2),
        // 1 + x is rounded by 2⁻¹⁰⁴, which is much of a small logarithm.
        2_147_483_648.0,
    ),
    (
        "acosh",
        |x| (DoubleDouble::ONE + x.abs()).acosh(),
        |a, x| a.acosh(&a.add(&Ball::integer(1), &a.abs(x))?),
        (-2, 60),
        16.0,
    ),
];

fn ball(arithmetic: &Precision, x: DoubleDouble) -> Ball {
    arithmetic.rational(&exact(x))
}

fn middle(ball: &Ball) -> Rational {
    ball.midpoint().to_rational().unwrap()
}

#[test]
fn functions_agree_with_balls() {
    let arithmetic = Precision::new(400);
    for &(name, ours, theirs, range, allowed) in FUNCTIONS {
        let mut random = Random::new(11);
        let mut worst = 0.0f64;
        for _ in 0..200 {
            let x = draw(&mut random, range);
            let expected = middle(&theirs(&arithmetic, &ball(&arithmetic, x)).unwrap());
            worst = worst.max(units(ours(x), &expected));
        }
        assert!(worst <= allowed, "{name}: {worst} units");
        assert!(worst > 0.0, "{name}: nothing was looked at");
    }
}

#[test]
fn sines_of_large_angles_are_exact_absolutely() {
    let arithmetic = Precision::new(400);
    let mut random = Random::new(13);
    let one = rational::integer(1);
    for _ in 0..500 {
        let x = draw(&mut random, (-20, 48));
        let (sin, cos) = x.sin_cos();
        let (s, c) = arithmetic.sin_cos(&ball(&arithmetic, x)).unwrap();
        for (found, expected) in [(sin, s), (cos, c)] {
            let error = exact(found) - middle(&expected);
            let shifted =
                DoubleDouble::from(1.0) + DoubleDouble::new(rational::to_f64(&error), 0.0);
            let units = units(shifted, &one);
            assert!(units <= 8.0, "{x:?}: {units}");
        }
    }
    // Next to a multiple of π only the digits of π tell the sine.
    let pi = middle(&arithmetic.pi().unwrap());
    let sine = DoubleDouble::PI.sin();
    let expected = pi - exact(DoubleDouble::PI);
    assert!(
        rational::abs(&(exact(sine) - expected.clone()))
            < rational::abs(&expected) / rational::integer(1 << 20)
    );
    assert!(!DoubleDouble::from(1e300).sin().is_finite());
}

#[test]
fn angles_of_points_in_all_quadrants() {
    let arithmetic = Precision::new(400);
    let mut random = Random::new(17);
    for _ in 0..300 {
        let (y, x) = (draw(&mut random, (-30, 30)), draw(&mut random, (-30, 30)));
        let (b, a) = (ball(&arithmetic, y), ball(&arithmetic, x));
        let expected = middle(&arithmetic.atan2(&b, &a).unwrap());
        let found = units(y.atan2(x), &expected);
        assert!(found <= 8.0, "{y:?} {x:?}: {found}");
    }
    let zero = DoubleDouble::ZERO;
    assert_eq!(zero.atan2(zero), zero);
    assert_eq!(
        zero.atan2(DoubleDouble::from(-1.0)).high(),
        std::f64::consts::PI
    );
    let tiny = DoubleDouble::from(1e-300);
    assert_eq!(tiny.atan2(tiny).high(), std::f64::consts::FRAC_PI_4);
}

#[test]
fn powers_and_what_has_no_value() {
    let two = DoubleDouble::from(2.0);
    let third = DoubleDouble::ONE / DoubleDouble::from(3.0);
    let root = two.powf(third);
    let error = (root * root * root - two).abs().high();
    assert!(error < 64.0 * DoubleDouble::EPSILON, "{error:e}");
    let whole = (-two).powf(DoubleDouble::from(3.0)) + DoubleDouble::from(8.0);
    assert!(whole.abs().high() < 64.0 * DoubleDouble::EPSILON);
    assert_eq!(two.powi(-3), DoubleDouble::from(0.125));
    for none in [
        (-two).sqrt(),
        (-two).ln(),
        DoubleDouble::ZERO.ln(),
        (-two).powf(third),
        two.asin(),
        two.atanh(),
        third.acosh(),
        DoubleDouble::from(800.0).exp(),
        two / DoubleDouble::ZERO,
    ] {
        assert!(!none.is_finite(), "{none:?}");
    }
    assert_eq!(DoubleDouble::from(-800.0).exp(), DoubleDouble::ZERO);
}
