//! Known digits, inclusion against higher precision, and the edges of the domains.

use super::*;
use crate::number::random::Random;

fn rational(text: &str) -> RBig {
    match text.split_once('.') {
        Some((whole, fraction)) => {
            let digits = IBig::from_str_radix(&format!("{whole}{fraction}"), 10).unwrap();
            RBig::from_parts_signed(digits, IBig::from(10).pow(fraction.len()))
        }
        None => RBig::from(IBig::from_str_radix(text, 10).unwrap()),
    }
}

/// The ball meets the printed digits to within one unit of the last, and is no wider than 2^(−160).
fn agrees(ball: &Ball, digits: &str) {
    let (_, fraction) = digits.split_once('.').unwrap();
    let value = rational(digits);
    let unit = RBig::from_parts_signed(IBig::from(1), IBig::from(10).pow(fraction.len()));
    let low = ball.lower().to_rational().unwrap();
    let high = ball.upper().to_rational().unwrap();
    assert!(
        low <= &value + &unit && high >= &value - &unit,
        "{ball} against {digits}"
    );
    assert!(
        ball.radius().log2_ceil().unwrap() < -160,
        "{ball} is too wide"
    );
}

#[test]
fn known_digits() {
    let precision = Precision::new(192);
    let number = |text: &str| precision.rational(&rational(text));
    // OEIS A000796, A002162, A001113, A002193, A049469, A049470, A002391, A073742.
    agrees(
        &precision.pi().unwrap(),
        "3.141592653589793238462643383279502884197169399375",
    );
    agrees(
        &precision.ln2().unwrap(),
        "0.693147180559945309417232121458176568075500134360",
    );
    agrees(
        &precision.exp(&number("1")).unwrap(),
        "2.718281828459045235360287471352662497757247093699",
    );
    agrees(
        &precision.sqrt(&number("2")).unwrap(),
        "1.414213562373095048801688724209698078569671875376",
    );
    agrees(
        &precision.sin(&number("1")).unwrap(),
        "0.841470984807896506652502321630298999622563060798",
    );
    agrees(
        &precision.cos(&number("1")).unwrap(),
        "0.540302305868139717400936607442976603732310420617",
    );
    agrees(
        &precision.log(&number("3")).unwrap(),
        "1.098612288668109691395245236922525704647490557822",
    );
    agrees(
        &precision.sinh(&number("1")).unwrap(),
        "1.175201193643801456882381850595600815155717981334",
    );
}

#[test]
fn wide_range_of_arguments_against_functional_equations() {
    let precision = Precision::new(128);
    let mut random = Random::new(8);
    for _ in 0..60 {
        let numerator = IBig::from(random.between(-1_000_000, 1_000_000));
        let denominator = IBig::from(10).pow(random.below(9) as usize);
        let x = precision.rational(&RBig::from_parts_signed(numerator, denominator));
        let (sine, cosine) = precision.sin_cos(&x).unwrap();
        let square = precision.add(
            &precision.mul(&sine, &sine).unwrap(),
            &precision.mul(&cosine, &cosine).unwrap(),
        );
        assert!(square.unwrap().contains(&Ball::integer(1)));
        let angle = precision.atan(&x).unwrap();
        let back = precision.tan(&angle).unwrap();
        assert!(back.overlaps(&x), "tan atan {x} = {back}");
        if x.magnitude() < Magnitude::power_of_two(10) && x.excludes_zero() {
            let back = precision.log(&precision.exp(&x).unwrap()).unwrap();
            assert!(
                back.overlaps(&x) && back.radius() < Magnitude::power_of_two(-80),
                "log exp {x} = {back}"
            );
            let back = precision.asinh(&precision.sinh(&x).unwrap()).unwrap();
            assert!(back.overlaps(&x), "asinh sinh {x} = {back}");
        }
    }
}

/// Every function at low precision must enclose its value at high precision, also for balls of positive radius.
#[test]
fn low_precision_encloses_high_precision() {
    type Function = fn(&Precision, &Ball) -> BallResult;
    let functions: [(&str, Function); 15] = [
        ("exp", Precision::exp),
        ("log", Precision::log),
        ("sin", Precision::sin),
        ("cos", Precision::cos),
        ("tan", Precision::tan),
        ("asin", Precision::asin),
        ("acos", Precision::acos),
        ("atan", Precision::atan),
        ("sinh", Precision::sinh),
        ("cosh", Precision::cosh),
        ("tanh", Precision::tanh),
        ("asinh", Precision::asinh),
        ("acosh", Precision::acosh),
        ("atanh", Precision::atanh),
        ("sqrt", Precision::sqrt),
    ];
    let (low, high) = (Precision::new(40), Precision::new(300));
    let mut random = Random::new(21);
    let mut compared = 0;
    for round in 0..200 {
        let size = random.between(-12, 6);
        let point = Ball::dyadic(IBig::from(random.between(-1 << 30, 1 << 30)), size - 30);
        let radius = if round % 2 == 0 {
            Magnitude::ZERO
        } else {
            Magnitude::power_of_two(size - 20)
        };
        let wide = point.clone().widened(radius);
        for inside in [wide.lower(), point.clone(), wide.upper()] {
            for (name, function) in functions {
                match (function(&low, &wide), function(&high, &inside)) {
                    (Ok(enclosure), Ok(value)) => {
                        compared += 1;
                        assert!(
                            enclosure.contains(&value),
                            "{name} of {wide}: {enclosure} misses {value}"
                        );
                    }
                    (Err(BallError::Undefined(_)), Ok(value)) => {
                        panic!("{name}({inside}) = {value} was called undefined")
                    }
                    (Ok(enclosure), Err(error)) => {
                        panic!("{name}({wide}) = {enclosure}, but {error} at {inside}")
                    }
                    _ => {}
                }
            }
        }
    }
    assert!(compared > 4000);
}

#[test]
fn arithmetic_encloses_the_exact_rational_result() {
    let precision = Precision::new(24);
    let mut random = Random::new(17);
    for _ in 0..300 {
        let mut draw = || {
            let bottom = random.between(1, 1 << 40);
            RBig::from_parts_signed(
                IBig::from(random.between(-1 << 40, 1 << 40)),
                IBig::from(bottom),
            )
        };
        let (a, b) = (draw(), draw());
        let (x, y) = (precision.rational(&a), precision.rational(&b));
        assert!(x.contains_rational(&a));
        assert!(precision.add(&x, &y).unwrap().contains_rational(&(&a + &b)));
        assert!(precision.sub(&x, &y).unwrap().contains_rational(&(&a - &b)));
        assert!(precision.mul(&x, &y).unwrap().contains_rational(&(&a * &b)));
        assert!(precision
            .powi(&x, &IBig::from(5))
            .unwrap()
            .contains_rational(&(&a * &a * &a * &a * &a)));
        if !b.is_zero() {
            assert!(precision.div(&x, &y).unwrap().contains_rational(&(&a / &b)));
        }
    }
}

#[test]
fn edges_of_domains_are_typed() {
    let p = Precision::new(64);
    let touching = Ball::zero().widened(Magnitude::power_of_two(-10));
    let minus = Ball::integer(-2);
    assert!(matches!(p.log(&minus), Err(BallError::Undefined(_))));
    assert!(matches!(p.log(&Ball::zero()), Err(BallError::Undefined(_))));
    assert!(matches!(p.log(&touching), Err(BallError::Uncertain(_))));
    assert!(matches!(p.sqrt(&minus), Err(BallError::Undefined(_))));
    assert!(matches!(p.sqrt(&touching), Err(BallError::Uncertain(_))));
    assert_eq!(p.sqrt(&Ball::zero()), Ok(Ball::zero()));
    assert!(matches!(
        p.div(&minus, &Ball::zero()),
        Err(BallError::Undefined(_))
    ));
    assert!(matches!(
        p.div(&minus, &touching),
        Err(BallError::Uncertain(_))
    ));
    assert!(matches!(p.asin(&minus), Err(BallError::Undefined(_))));
    assert!(p
        .asin(&Ball::integer(-1))
        .unwrap()
        .overlaps(&p.pi().unwrap().shift(-1).neg()));
    assert!(matches!(
        p.acosh(&Ball::zero()),
        Err(BallError::Undefined(_))
    ));
    assert!(matches!(
        p.atanh(&Ball::integer(1)),
        Err(BallError::Undefined(_))
    ));
    assert!(matches!(
        p.atan2(&Ball::zero(), &Ball::zero()),
        Err(BallError::Undefined(_))
    ));
    assert!(matches!(
        p.atan2(&touching, &minus),
        Err(BallError::Uncertain(_))
    ));
    assert!(matches!(p.signum(&touching), Err(BallError::Uncertain(_))));
    assert!(matches!(
        p.pow_rational(&minus, &rational("0.3")),
        Err(BallError::Undefined(_))
    ));
    assert!(matches!(
        p.exp(&Ball::dyadic(IBig::from(1), 60)),
        Err(BallError::TooLarge(_))
    ));
    assert!(matches!(
        p.sin(&Ball::dyadic(IBig::from(1), 1 << 30)),
        Err(BallError::TooLarge(_))
    ));
    assert!(matches!(
        p.powi(&Ball::integer(3), &(IBig::from(1) << 45)),
        Err(BallError::TooLarge(_))
    ));
    assert_eq!(
        p.powi(&touching, &IBig::from(2)).unwrap().lower().sign(),
        Some(Ordering::Equal)
    );
}

#[test]
fn quadrants_of_atan2() {
    let p = Precision::new(100);
    let quarter = p.pi().unwrap().shift(-2);
    for (y, x, eighths) in [
        (1, 1, 1),
        (1, -1, 3),
        (-1, -1, -3),
        (-1, 1, -1),
        (0, -1, 4),
        (1, 0, 2),
        (-1, 0, -2),
    ] {
        let angle = p.atan2(&Ball::integer(y), &Ball::integer(x)).unwrap();
        let expected = p.mul(&quarter, &Ball::integer(eighths)).unwrap();
        assert!(
            angle.overlaps(&expected) && angle.radius() < Magnitude::power_of_two(-90),
            "atan2({y}, {x}) = {angle}"
        );
    }
}

#[test]
fn rational_powers() {
    let p = Precision::new(128);
    let cube_root = p
        .pow_rational(
            &Ball::integer(2),
            &RBig::from_parts_signed(IBig::from(1), IBig::from(3)),
        )
        .unwrap();
    assert!(p
        .powi(&cube_root, &IBig::from(3))
        .unwrap()
        .contains(&Ball::integer(2)));
    let power = p
        .pow_rational(
            &Ball::integer(4),
            &RBig::from_parts_signed(IBig::from(-3), IBig::from(2)),
        )
        .unwrap();
    assert!(power.is_exact() && power.contains(&Ball::dyadic(IBig::from(1), -3)));
}

#[test]
fn hilbert_matrix_is_solved_and_a_singular_one_is_not() {
    // H x = b with x = (1, …, 1); the condition number of H₈ is 1.5·10^10.
    let size = 8;
    let p = Precision::new(160);
    let entry =
        |i: usize, j: usize| RBig::from_parts_signed(IBig::from(1), IBig::from((i + j + 1) as u64));
    let matrix = (0..size * size)
        .map(|k| p.rational(&entry(k / size, k % size)))
        .collect();
    let rhs = (0..size)
        .map(|i| p.rational(&(0..size).fold(RBig::ZERO, |sum, j| sum + entry(i, j))))
        .collect::<Vec<_>>();
    let solution = solve(&p, size, matrix, std::slice::from_ref(&rhs))
        .unwrap()
        .remove(0);
    for x in &solution {
        assert!(
            x.contains(&Ball::integer(1)) && x.radius() < Magnitude::power_of_two(-60),
            "{x}"
        );
    }
    let singular = vec![
        Ball::integer(1),
        Ball::integer(2),
        Ball::integer(2),
        Ball::integer(4),
    ];
    assert!(matches!(
        solve(&p, 2, singular, &[rhs[..2].to_vec()]),
        Err(BallError::Uncertain(_))
    ));
}

#[test]
fn decimal_intervals_are_rounded_outwards() {
    let p = Precision::new(200);
    assert_eq!(
        p.pi().unwrap().to_decimal_interval(5),
        ("3.1415".to_owned(), "3.1416".to_owned())
    );
    let third = p.rational(&RBig::from_parts_signed(IBig::from(-1), IBig::from(3000)));
    assert_eq!(
        third.to_decimal_interval(3),
        ("-3.34e-4".to_owned(), "-3.33e-4".to_owned())
    );
    assert_eq!(
        Ball::integer(1500).to_decimal_interval(4),
        ("1.5e3".to_owned(), "1.5e3".to_owned())
    );
    let almost = p.rational(&rational("0.99999"));
    assert_eq!(almost.to_decimal_interval(2).1, "1");
    assert_eq!(Ball::zero().to_string(), "[0, 0]");
}

#[test]
fn numbers_of_very_different_size_stay_cheap() {
    let p = Precision::new(64);
    let tiny = Ball::dyadic(IBig::from(1), -(1 << 38));
    let sum = p.add(&Ball::integer(1), &tiny).unwrap();
    assert!(sum.excludes_zero() && sum.radius() < Magnitude::power_of_two(-60));
    assert!(tiny.excludes_zero());
    assert_eq!(sum.lower().sign(), Some(Ordering::Greater));
    let wide = tiny.clone().widened(Magnitude::power_of_two(10));
    assert_eq!(wide.sign(), None);
    assert_eq!(wide.lower().sign(), Some(Ordering::Less));
}

#[test]
fn conversions_with_f64() {
    for value in [0.0, 1.5, -0.1, 5e-324, 1.7e308, -2.3e-300] {
        assert_eq!(Ball::from_f64(value).unwrap().to_f64(), value);
    }
    assert!(Ball::from_f64(f64::NAN).is_none());
    assert!((Precision::new(200).pi().unwrap().to_f64() - std::f64::consts::PI).abs() < 1e-15);
}
