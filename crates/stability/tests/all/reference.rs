//! Linearizations and ranges of stability against published values: Meijaard, Papadopoulos, Ruina, Schwab 2007 for the bicycle, Routh
//! 1905 for the disc, Neimark and Fufaev 1972 for the sleigh, textbooks for the rest.
#![allow(
    clippy::unwrap_used,
    clippy::excessive_precision,
    reason = "test code fails where it stands; values have the digits of their source"
)]

use crate::common::{disc, Case};
use chetaev_stability::characteristic::Characteristic;
use chetaev_stability::eigenvalues::eigenvalues;
use chetaev_stability::expansion::Expansion;
use chetaev_stability::hurwitz::Crossing;
use chetaev_stability::linearization::{LinearizationError, Variable};
use chetaev_stability::reduction::Speeds;
use chetaev_symbolic::factors::coefficients;
use chetaev_symbolic::number::ball::{Ball, Precision};
use chetaev_symbolic::{Expr, Rational};

fn decimal(text: &str) -> Rational {
    let (whole, part) = text.split_once('.').unwrap();
    let digits: dashu_int::IBig = format!("{whole}{part}").parse().unwrap();
    let power = dashu_int::UBig::from(10_u8).pow(part.len());
    Rational::from_parts(digits, power)
}

#[test]
fn the_bicycle_is_stable_between_the_weave_speed_and_the_capsize_speed() {
    let case = Case::gallery("whipple-bicycle");
    let motion = case.motion(&[
        ("phi", "0"),
        ("theta", "0"),
        ("delta", "0"),
        ("phi'", "0"),
        ("delta'", "0"),
        ("thR'", "v/rR"),
    ]);
    let linear = case.linear(&motion, "v").unwrap();
    assert_eq!(linear.names, ["phi", "delta", "phi'", "delta'", "thR'"]);
    assert_eq!(linear.ignorable, ["x", "y", "psi", "thR", "thF"]);
    assert_eq!(linear.dependent.len(), 1);
    assert_eq!(linear.family, 1);
    // M, and what multiplies deviations and velocities at two speeds, against the sixteen coefficients.
    let m = [
        [80.81722, 2.319_413_322_087_091_35],
        [2.319_413_322_087_091_35, 0.297_841_881_996_855_53],
    ];
    let c1 = [
        [0.0, 33.866_413_914_924_943_9],
        [-0.850_356_414_569_784_37, 1.685_403_973_975_596_74],
    ];
    let k0 = [
        [-80.95, -2.599_516_852_498_716_41],
        [-2.599_516_852_498_716_41, -0.803_294_884_586_176_881],
    ];
    let k2 = [
        [0.0, 76.597_345_895_732_221_5],
        [0.0, 2.654_315_237_946_040_25],
    ];
    for v in [0.0, 1.0, 3.7, 9.25] {
        let left = case.numbers(&linear.left, &[("v", v)]);
        let right = case.numbers(&linear.right, &[("v", v)]);
        for i in 0..2 {
            for j in 0..2 {
                let close = |own: f64, expected: f64| {
                    let scale = expected.abs().max(1e-3);
                    assert!(
                        (own - expected).abs() <= 1e-13 * scale,
                        "v = {v}, [{i}][{j}]: {own} {expected}"
                    );
                };
                close(left[2 + i][2 + j], m[i][j]);
                close(-right[2 + i][2 + j], v * c1[i][j]);
                close(-right[2 + i][j], 9.81 * k0[i][j] + v * v * k2[i][j]);
            }
        }
    }
    // They are polynomials in v, constant in M, of first degree in C₁ and of second in K.
    let g = &case.system.graph;
    let v = g.intern_symbol("v", 0);
    let degree = |e: Expr| coefficients(g, e, v).unwrap().len() - 1;
    for i in 2..4 {
        for j in 0..2 {
            assert_eq!(degree(linear.left[i][2 + j]), 0);
            assert!(degree(linear.right[i][2 + j]) <= 1);
            assert!(degree(linear.right[i][j]) <= 2);
        }
    }
    let found = case.ranges(&linear, "v", 0, 10);
    let stable: Vec<_> = found.regions.iter().filter(|r| r.is_left).collect();
    assert_eq!(stable.len(), 1);
    // At rest the eigenvalues are real and opposite: no pair passes the axis there, where the range begins.
    let at_rest = found
        .boundaries
        .iter()
        .filter(|b| b.root.low <= Rational::from(0));
    for boundary in at_rest {
        assert_eq!(boundary.crossing, Crossing::Touching);
    }
    let inside = [
        ("4.292382536341103959", Crossing::Pair),
        ("6.024262015388358890", Crossing::Zero),
    ];
    let ends = [&stable[0].low, &stable[0].high];
    for ((text, crossing), end) in inside.into_iter().zip(ends) {
        let boundary = found
            .boundaries
            .iter()
            .find(|b| b.root.low == *end || b.root.high == *end)
            .unwrap();
        let (low, high) = (&boundary.root.low, &boundary.root.high);
        let half = decimal("0.0000000000000000005");
        let expected = decimal(text);
        assert!(
            *low <= &expected + &half && &expected - &half <= *high,
            "{text}"
        );
        assert!(high - low < decimal("0.0000000000000001"));
        assert_eq!(boundary.crossing, crossing);
    }
}

/// The characteristic polynomial of the bicycle is one and the same, exactly, in whatever order the model names its coordinates and whichever
/// velocities are independent: at the heading zero these are those of lean and steer and one of x, thR, thF.
#[test]
fn the_polynomial_of_the_bicycle_knows_no_order_and_no_choice() {
    let as_stated = Case::gallery("whipple-bicycle");
    // The lines of the coordinates in the opposite order.
    let path = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../gallery/whipple-bicycle/model.toml"
    );
    let text = std::fs::read_to_string(path).unwrap();
    let lines = text.split("[coordinates]\n").nth(1).unwrap();
    let lines = lines.split("\n\n").next().unwrap();
    let in_order = |order: &[usize]| {
        let all: Vec<&str> = lines.lines().collect();
        let turned: Vec<&str> = order.iter().map(|&at| all[at]).collect();
        Case::gallery_with("whipple-bicycle", lines, &turned.join("\n"))
    };
    let turned = in_order(&[7, 6, 5, 4, 3, 2, 1, 0]);
    assert_eq!(turned.system.coordinates[0].name, "thF");
    let rotated = in_order(&[3, 4, 5, 6, 7, 0, 1, 2]);
    let mixed = in_order(&[5, 0, 7, 2, 4, 6, 1, 3]);
    let expected = monic(&as_stated, None);
    for case in [&as_stated, &turned, &rotated, &mixed] {
        for third in ["x", "thR", "thF"] {
            let found = monic(case, Some(["phi", "delta", third]));
            assert_eq!(found.len(), expected.len(), "{third}");
            for (own, expected) in found.iter().zip(&expected) {
                assert_eq!(own, expected, "{third}");
            }
        }
    }
}

/// The coefficients of the characteristic polynomial of the upright bicycle without the zeros of its family, divided by the first, at v = 5, to
/// thirty digits of their enclosures.
fn monic(case: &Case, independent: Option<[&str; 3]>) -> Vec<String> {
    let (system, g) = (&case.system, &case.system.graph);
    let mut selection = case.prepared.selection.clone();
    if let Some(names) = independent {
        let all = system.coordinates.iter().enumerate();
        let others = all.filter(|(_, c)| !names.contains(&c.name.as_str()));
        selection.dependent = others.map(|(at, _)| at).collect();
    }
    let motion = case.motion(&[
        ("psi", "0"),
        ("phi", "0"),
        ("theta", "0"),
        ("delta", "0"),
        ("phi'", "0"),
        ("delta'", "0"),
        ("x'", "v"),
    ]);
    let speeds = match independent {
        Some(_) => Speeds::Independent,
        None => Speeds::Suitable,
    };
    let values = case.values("");
    let (terms, about) = (&case.prepared.terms, (&values[..], speeds));
    let about = Expansion::in_speeds(system, terms, &selection, &motion, about).unwrap();
    let polynomial = Characteristic::of(g, &about.linear()).unwrap();
    let leading = *polynomial.coefficients.last().unwrap();
    let ratios = polynomial.coefficients.iter().map(|&e| g.div(e, leading));
    let ratios: Vec<Expr> = ratios.collect();
    let balls = g.enclose(&ratios, &Precision::new(256), &|_| None).unwrap();
    let text = |ball: &Ball| format!("{:?}", ball.to_decimal_interval(30));
    balls.iter().map(text).collect()
}

#[test]
fn eigenvalues_of_the_bicycle() {
    let case = Case::gallery("whipple-bicycle");
    let motion = case.motion(&[
        ("phi", "0"),
        ("theta", "0"),
        ("delta", "0"),
        ("phi'", "0"),
        ("delta'", "0"),
        ("thR'", "v/rR"),
    ]);
    let linear = case.linear(&motion, "v").unwrap();
    let free = [("v", 2.0)];
    let found = eigenvalues(
        &case.numbers(&linear.left, &free),
        &case.numbers(&linear.right, &free),
    )
    .unwrap();
    let expected = [
        (-8.673_879_848_317_371_63, 0.0),
        (-3.071_586_456_415_142_51, 0.0),
        (0.0, 0.0),
        (2.682_345_175_127_453_45, -1.680_662_965_906_757_76),
        (2.682_345_175_127_453_45, 1.680_662_965_906_757_76),
    ];
    for (own, (re, im)) in found.iter().zip(expected) {
        assert!(
            (own.re - re).abs() < 1e-11 && (own.im - im).abs() < 1e-11,
            "{own} {re} {im}"
        );
    }
}

const OF_DISC: &str = "v = 2, Om = 6";

/// λ² (λ² + W), W = (C (C + m r²) v²/r² − A m g r)/(A (A + m r²)) rolling straight, Ω² − m g r/(A + m r²) spinning upright (Routh 1905). Two
/// zeros belong to the family of both.
#[test]
fn the_disc_that_rolls_or_spins_upright() {
    let case = Case::new(&disc(OF_DISC, ""));
    let cases = [
        ("psi'", "v/r", "phi'", "v", 40.38),
        ("phi'", "Om", "psi'", "Om", 16.38),
    ];
    for (moving, rate, still, free, expected) in cases {
        let motion = case.motion(&[
            ("theta", "0"),
            ("theta'", "0"),
            (moving, rate),
            (still, "0"),
        ]);
        let linear = case.linear(&motion, free).unwrap();
        assert_eq!(linear.names[0], "theta");
        assert_eq!(linear.family, 2, "{moving}");
        let polynomial = Characteristic::of(&case.system.graph, &linear).unwrap();
        assert_eq!(
            (
                polynomial.zeros,
                polynomial.further_zeros,
                polynomial.degree()
            ),
            (2, 0, 2)
        );
        let at = [("v", 2.0), ("Om", 6.0)];
        let values: Vec<f64> = polynomial
            .coefficients
            .iter()
            .map(|&e| case.number(e, &at))
            .collect();
        assert!((values[0] / values[2] - expected).abs() < 1e-12 * expected);
        assert_eq!(values[1], 0.0);
    }
}

/// A steady circle: the lean is constant, heading and spin run on; the contact moves on a circle, so that neither x' nor y' is constant.
#[test]
fn the_disc_on_a_circle_is_steady() {
    let case = Case::new(&disc(OF_DISC, ""));
    // With theta = lean, b = 0 is one equation between phi' and psi'; sin and cos of the lean are rational here.
    let lean = "asin(3/5)";
    let unsteady = case.motion(&[
        ("theta", lean),
        ("theta'", "0"),
        ("phi'", "1"),
        ("psi'", "1"),
    ]);
    let refused = case.linear(&unsteady, "").unwrap_err();
    assert!(
        matches!(&refused, LinearizationError::NotSteady { quantity, .. } if quantity == "theta'"),
        "{refused}"
    );
}

/// u' = a ω², ω' = −m a u ω/(J + m a²): the zero of the line ω = 0, and −m a u/(J + m a²).
#[test]
fn the_sleigh_is_stable_with_its_mass_ahead() {
    let case = Case::new(
        r#"
coordinates = ["x", "y", "phi"]
parameters = { m = 2, J = 0.3, a = 0.25, u = 1.2 }
[define]
cx = "x + a cos(phi)"
cy = "y + a sin(phi)"
[lagrangian]
T = "1/2 m (cx'^2 + cy'^2) + 1/2 J phi'^2"
[constraints]
blade = "x' sin(phi) = y' cos(phi)"
"#,
    );
    let motion = case.motion(&[("phi", "0"), ("x'", "u"), ("phi'", "0")]);
    let linear = case.linear(&motion, "u").unwrap();
    assert_eq!(linear.ignorable, ["x", "y", "phi"]);
    assert_eq!(linear.family, 1);
    let polynomial = Characteristic::of(&case.system.graph, &linear).unwrap();
    let values: Vec<f64> = polynomial
        .coefficients
        .iter()
        .map(|&e| case.number(e, &[("u", 1.2)]))
        .collect();
    assert!((values[0] / values[1] - 1.411_764_705_882_352_94).abs() < 1e-15);
    let found = case.ranges(&linear, "u", -3, 3);
    let stable: Vec<bool> = found.regions.iter().map(|r| r.is_left).collect();
    assert_eq!(stable, [false, true]);
    assert_eq!(found.boundaries.len(), 1);
    assert_eq!(found.boundaries[0].root.low, Rational::from(0));
}

/// Hanging, and upside down: the frequencies of the double pendulum.
#[test]
fn the_double_pendulum() {
    let case = Case::new(
        r#"
coordinates = ["a", "b"]
parameters = { m1 = 1, m2 = 1, l1 = 0.5, l2 = 0.5, g = 9.81 }
[define]
x1 = "l1 sin(a)"
y1 = "-l1 cos(a)"
x2 = "x1 + l2 sin(b)"
y2 = "y1 - l2 cos(b)"
[lagrangian]
T = "1/2 m1 (x1'^2 + y1'^2) + 1/2 m2 (x2'^2 + y2'^2)"
V = "m1 g y1 + m2 g y2"
"#,
    );
    let of = |a: &str, b: &str| {
        let linear = case
            .linear(
                &case.motion(&[("a", a), ("b", b), ("a'", "0"), ("b'", "0")]),
                "",
            )
            .unwrap();
        eigenvalues(
            &case.numbers(&linear.left, &[]),
            &case.numbers(&linear.right, &[]),
        )
        .unwrap()
    };
    let hanging = of("0", "0");
    let mut frequencies: Vec<f64> = hanging.iter().map(|l| l.im).collect();
    frequencies.sort_by(f64::total_cmp);
    for (own, expected) in frequencies[2..]
        .iter()
        .zip([3.390_151_900_172_007_8, 8.184_550_695_900_180_25])
    {
        assert!((own - expected).abs() < 1e-12 * expected);
    }
    let folded = of("0", "pi");
    assert!((folded[3].re - 5.267_529_790_495_742_88).abs() < 1e-12);
    let outside = case.motion(&[("a", "1"), ("b", "0"), ("a'", "0"), ("b'", "0")]);
    assert!(matches!(
        case.linear(&outside, ""),
        Err(LinearizationError::NotSteady { .. })
    ));
}

/// A caster that trails behind a pivot on a spring.
pub(crate) const CASTER: &str = r#"
coordinates = ["X", "y", "theta"]
parameters = { m = 5, J = 0.06, b = 0.03, e = 0.1, k = 20000, c = 2, v = 1, M = 1 }
[define]
cx = "X - b cos(theta)"
cy = "y - b sin(theta)"
[lagrangian]
T = "1/2 m (cx'^2 + cy'^2) + 1/2 J theta'^2"
V = "1/2 k y^2"
[forces]
theta = "-c theta'"
[constraints]
drive = "X' = v"
wheel = "-X' sin(theta) + y' cos(theta) - e theta' = 0"
"#;

/// The caster with an elastic pivot: stable exactly below v = e c/(J − m b (e − b)) (Den Hartog 1940; Stépán 1991 for the class).
#[test]
fn shimmy_of_a_caster() {
    let case = Case::new(CASTER);
    let motion = case.motion(&[
        ("y", "0"),
        ("theta", "0"),
        ("theta'", "0"),
        ("y'", "0"),
        ("X'", "v"),
    ]);
    let linear = case.linear(&motion, "v").unwrap();
    let found = case.ranges(&linear, "v", 1, 10);
    assert_eq!(found.boundaries.len(), 1, "{found:?}");
    assert_eq!(found.boundaries[0].crossing, Crossing::Pair);
    // 0.2/0.0495 = 400/99.
    let expected = Rational::from_parts(400.into(), 99_u32.into());
    let root = &found.boundaries[0].root;
    assert!(root.low <= expected && expected <= root.high);
    let stable: Vec<bool> = found.regions.iter().map(|r| r.is_left).collect();
    assert_eq!(stable, [true, false]);
}

#[test]
fn what_is_not_admissible_or_depends_on_the_time_is_refused() {
    let case = Case::gallery("whipple-bicycle");
    let lifted = case.motion(&[
        ("phi", "0"),
        ("theta", "1/10"),
        ("delta", "0"),
        ("phi'", "0"),
        ("delta'", "0"),
        ("thR'", "v/rR"),
    ]);
    let refused = case.linear(&lifted, "v").unwrap_err();
    assert!(
        matches!(&refused, LinearizationError::NotAdmissible { constraint, .. } if constraint == "front_contact"),
        "{refused}"
    );
    let missing = case.motion(&[
        ("phi", "0"),
        ("theta", "0"),
        ("phi'", "0"),
        ("delta'", "0"),
        ("thR'", "v/rR"),
    ]);
    assert!(
        matches!(case.linear(&missing, "v"), Err(LinearizationError::PositionMissing { coordinate, .. }) if coordinate == "delta")
    );
    let driven = Case::new(
        "coordinates = [\"x\"]\nlagrangian = { L = \"1/2 x'^2 - 1/2 x^2 (1 + cos(t))\" }\n",
    );
    let rest = driven.motion(&[("x", "0"), ("x'", "0")]);
    assert_eq!(
        driven.linear(&rest, "").unwrap_err(),
        LinearizationError::NotAutonomous
    );
}

/// Variables are named by what they are.
#[test]
fn variables_know_what_they_are() {
    let case = Case::new("coordinates = [\"x\"]\nlagrangian = { L = \"1/2 x'^2 - 1/2 x^2\" }\n");
    let linear = case
        .linear(&case.motion(&[("x", "0"), ("x'", "0")]), "")
        .unwrap();
    assert_eq!(
        linear.variables,
        [Variable::Coordinate(0), Variable::Speed(0)]
    );
}

/// A ball whose mass centre lies a below its middle, or above it for negative a: tilts al and be of its axis in axes that do not spin.
const TIPPE_TOP: &str = r#"
coordinates = ["x", "y", "al", "be", "ga"]
parameters = { m = 0.02, R = 0.015, a = 0.003, A = 0.0000018, C = 0.000002, g = 9.81, mu = 0.05, n = 60 }
[define]
z = "R - a cos(al) cos(be)"
w1 = "al' + ga' sin(be)"
w2 = "be' cos(al) - ga' sin(al) cos(be)"
w3 = "be' sin(al) + ga' cos(al) cos(be)"
vx = "x' + w2 (a cos(al) cos(be) - R) + w3 a sin(al) cos(be)"
vy = "y' + w3 a sin(be) - w1 (a cos(al) cos(be) - R)"
[lagrangian]
T = "1/2 m (x'^2 + y'^2 + z'^2) + 1/2 A (al'^2 cos(be)^2 + be'^2) + 1/2 C (ga' + al' sin(be))^2"
V = "m g z"
"#;

/// The ball with this place of the mass centre and these further sections, spinning about the vertical at n.
pub(crate) fn tippe_top(a: &str, further: &str) -> Case {
    let text = TIPPE_TOP.replace("a = 0.003", &format!("a = {a}"));
    Case::new(&format!("{text}{further}"))
}

pub(crate) fn spinning(case: &Case) -> chetaev_mechanics::SteadyMotion {
    case.motion(&[
        ("al", "0"),
        ("be", "0"),
        ("al'", "0"),
        ("be'", "0"),
        ("ga'", "n"),
        ("x'", "0"),
        ("y'", "0"),
    ])
}

/// Where it slides with viscous friction the tippe top turns over: the energy at a given value of Jellett's integral,
/// `m g (R − a cos θ) + k²/(2 (A R² sin² θ + C (R cos θ − a)²))`, has a minimum at the spin with the mass centre below for
/// `n² < m g a (R − a)²/(R (A R − C (R − a)))`, and above for `n² > m g a (R + a)²/(R (C (R + a) − A R))` (Karapetyan and Kuleshov 2002 for the
/// method).
#[test]
fn the_tippe_top_turns_over_where_it_slides() {
    let sliding = "[forces]\nrayleigh = \"1/2 mu (vx^2 + vy^2)\"\n";
    // m g a = 5.886e-4; the squares are 1883.52 and 1412.64.
    for (a, square, is_stable_below) in [("0.003", 188_352, true), ("-0.003", 141_264, false)] {
        let case = tippe_top(a, sliding);
        let linear = case.linear(&spinning(&case), "n").unwrap();
        let found = case.ranges(&linear, "n", 1, 100).joined(&|_| true);
        assert_eq!(found.boundaries.len(), 1, "{a}: {found:?}");
        let root = &found.boundaries[0].root;
        let expected = Rational::from_parts(square.into(), 100_u32.into());
        assert!(&root.low * &root.low <= expected, "{a}: {root:?}");
        assert!(expected <= &root.high * &root.high, "{a}: {root:?}");
        let stable: Vec<bool> = found.regions.iter().map(|r| r.is_left).collect();
        assert_eq!(stable, [is_stable_below, !is_stable_below], "{a}");
    }
}

/// Where it rolls it does not: with the mass centre below the spin is linearly stable at any rate, and above for fast spins; the polynomials are
/// those of the reference (Routh 1905).
#[test]
fn the_tippe_top_that_rolls_does_not_turn_over() {
    let rolling = "[constraints]\nalong = \"vx = 0\"\nacross = \"vy = 0\"\n";
    for (a, n, middle, last) in [
        ("0.003", 60.0, 5_406.042_077_580_539, 15_817.899_408_284_024),
        (
            "0.003",
            200.0,
            57_523.800_862_005_99,
            15_817.899_408_284_024,
        ),
        (
            "-0.003",
            60.0,
            2_733.272_421_760_134_4,
            5_053.355_387_523_629,
        ),
        (
            "-0.003",
            200.0,
            31_807.229_806_996_66,
            5_053.355_387_523_629,
        ),
    ] {
        let case = tippe_top(a, rolling);
        let linear = case.linear(&spinning(&case), "n").unwrap();
        let polynomial = Characteristic::of(&case.system.graph, &linear).unwrap();
        let list: Vec<f64> = polynomial
            .coefficients
            .iter()
            .map(|&e| case.number(e, &[("n", n)]))
            .collect();
        assert_eq!(list.len(), 5, "{list:?}");
        for (own, expected) in list.iter().zip([last, 0.0, middle, 0.0, 1.0]) {
            let error = (own / list[4] - expected).abs();
            assert!(error <= 1e-12 * expected.max(1.0), "{a} {n}: {list:?}");
        }
    }
}

/// Without a damper the condition of the caster, `m b (e − b) > J`, does not contain the speed.
#[test]
fn a_caster_without_damper_has_no_critical_speed() {
    for (inertia, is_stable) in [("0.06", false), ("0.005", true)] {
        let case = Case::new(&format!(
            r#"
coordinates = ["X", "y", "theta"]
parameters = {{ m = 5, J = {inertia}, b = 0.03, e = 0.1, k = 20000, v = 1 }}
[define]
cx = "X - b cos(theta)"
cy = "y - b sin(theta)"
[lagrangian]
T = "1/2 m (cx'^2 + cy'^2) + 1/2 J theta'^2"
V = "1/2 k y^2"
[constraints]
drive = "X' = v"
wheel = "-X' sin(theta) + y' cos(theta) - e theta' = 0"
"#
        ));
        let motion = case.motion(&[
            ("y", "0"),
            ("theta", "0"),
            ("theta'", "0"),
            ("y'", "0"),
            ("X'", "v"),
        ]);
        let linear = case.linear(&motion, "v").unwrap();
        let found = case.ranges(&linear, "v", 1, 100);
        assert!(found.boundaries.is_empty(), "{found:?}");
        assert_eq!(found.regions[0].is_left, is_stable);
    }
}

/// All of the circle x² + y² = 1, where an energy (x² + y² − 1)⁴ and all its slopes vanish, is at rest, at any speed of the ignorable z. Of x² y² (1 + z²)
/// rest is where x = 0 or where y = 0, at any z: two planes through the origin, where all three directions have no stiffness.
#[test]
fn families_where_slopes_vanish_or_not_all_directions_are_steady() {
    for (energy, at, count) in [
        ("(x^2 + y^2 - 1)^4", ["3/5", "4/5"], 2),
        ("(x^2 + y^2 - 1)^2 (2 + cos(x))", ["3/5", "-4/5"], 2),
        ("x^2 y^2 (1 + z^2)", ["0", "0"], 2),
        ("x^2 y^2 (1 + z^2)", ["1/3", "0"], 2),
        ("x^2 + y^2 + z^4", ["0", "0"], 0),
    ] {
        let case = Case::new(&format!(
            r#"
coordinates = ["x", "y", "z"]
lagrangian = "(x'^2 + y'^2 + z'^2)/2 - {energy}"
"#
        ));
        let motion = case.motion(&[
            ("x", at[0]),
            ("y", at[1]),
            ("z", "0"),
            ("x'", "0"),
            ("y'", "0"),
            ("z'", "0"),
        ]);
        let linear = case.linear(&motion, "").unwrap();
        assert_eq!(linear.family, count, "{energy}");
    }
}
