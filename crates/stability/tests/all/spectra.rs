//! Eigenvalues to all digits of double precision against computations by others with 40 digits, of the systems of the literature that the other
//! tests speak of.
#![allow(
    clippy::unwrap_used,
    clippy::excessive_precision,
    reason = "test code fails where it stands; values have the digits of their source"
)]

use crate::common::{are_eigenvalues, disc, Case};
use crate::reference::{spinning, tippe_top, CASTER};
use crate::verdicts::{gyroscopic, stone, triangular, TOP};

/// Rounding beside the largest eigenvalue.
const ROUNDING: f64 = 1e-13;

/// Complex numbers with their conjugates.
fn pairs(list: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let both = |&(re, im): &(f64, f64)| [(re, im), (re, -im)];
    list.iter().flat_map(both).collect()
}

/// (A λ² − m g l)² + C² n² λ² (Klein and Sommerfeld 1898): two pairs off the axis below the critical spin 60.277…, on it above.
#[test]
fn lagranges_sleeping_top() {
    for (n, expected) in [
        (
            "50",
            pairs(&[
                (6.059_702_963_017_246_77, 9.0),
                (-6.059_702_963_017_246_77, 9.0),
            ]),
        ),
        (
            "60.3",
            pairs(&[
                (0.0, 11.152_857_825_729_894_5),
                (0.0, 10.555_142_174_270_105_5),
            ]),
        ),
        (
            "80",
            pairs(&[(0.0, 23.867_840_302_835_7), (0.0, 4.932_159_697_164_299_97)]),
        ),
    ] {
        let case = Case::new(&TOP.replace("n = 80", &format!("n = {n}")));
        are_eigenvalues(&case.spectrum(case.named("sleeping")), &expected, ROUNDING);
    }
}

/// The two regular precessions at θ = 0.8 with their nutations (Routh 1905).
#[test]
fn precession_and_nutation() {
    let root = "sqrt(C^2 n^2 - 4 A w cos(0.8))";
    for (sign, precession, nutation) in [
        ("-", 3.972_706_918_185_527_91, 27.015_113_623_778_339_7),
        ("+", 42.531_797_151_195_041_6, 40.651_960_864_347_710_7),
    ] {
        let rate = format!("(C n {sign} {root})/(2 A cos(0.8))");
        let case = Case::new(&format!(
            r#"
coordinates = ["phi", "theta", "psi"]
parameters = {{ A = 0.0025, C = 0.0009, w = 0.2943, n = 90 }}
[lagrangian]
T = "1/2 A (theta'^2 + phi'^2 sin(theta)^2) + 1/2 C (psi' + phi' cos(theta))^2"
V = "w cos(theta)"
[steady.precession]
theta = 0.8
"theta'" = 0
"phi'" = "{rate}"
"psi'" = "n - cos(0.8) {rate}"
"#
        ));
        let motion = case.named("precession");
        let values = case.system.parameter_values();
        let rate = case
            .system
            .graph
            .substitute(motion.velocities[0].unwrap(), &values);
        assert!((case.number(rate, &[]) / precession - 1.0).abs() < 1e-14);
        are_eigenvalues(&case.spectrum(motion), &pairs(&[(0.0, nutation)]), ROUNDING);
    }
}

/// Two stones, spun in both directions (Bondi 1986 for the polynomial).
#[test]
fn rattlebacks() {
    let long = [
        "0.2", "0.03", "0.02", "0.01", "0.0002", "0.0016", "0.0017", "-0.00002",
    ];
    let short = [
        "0.1",
        "0.06",
        "0.05",
        "0.005",
        "0.00061",
        "0.00125",
        "0.001292",
        "-0.000064",
    ];
    for (stated, spin, expected) in [
        (
            long,
            5,
            [
                (-2.120_692_397_891_901, 109.392_322_837_931_827),
                (0.202_521_283_292_214_969, 34.143_691_665_867_587_1),
            ],
        ),
        (
            long,
            50,
            [
                (-19.555_335_466_058_110_4, 241.763_095_829_113_736),
                (0.373_624_320_061_250_102, 59.800_803_639_512_803_6),
            ],
        ),
        (
            short,
            10,
            [
                (-0.248_525_523_871_294_582, 24.610_967_897_333_010_4),
                (0.034_834_282_441_348_662_5, 13.072_422_972_630_117_7),
            ],
        ),
        (
            short,
            30,
            [
                (-0.586_403_721_748_901_029, 40.462_462_940_384_190_3),
                (-0.054_670_002_540_936_730_7, 28.831_151_609_910_780_5),
            ],
        ),
    ] {
        for sign in [1, -1] {
            let n = (sign * spin).to_string();
            let [a, b, c, d, e, f, g, h] = stated;
            let case = stone([a, b, c, d, e, f, g, h, &n]);
            let expected = expected.map(|(re, im)| (f64::from(sign) * re, im));
            let found = case.spectrum(case.named("spinning"));
            are_eigenvalues(&found, &pairs(&expected), ROUNDING);
        }
    }
}

/// A ball with an eccentric mass centre that rolls without slipping: oscillations at all spins with the mass centre below, from 18.8679003211113095
/// on with it above.
#[test]
fn tippe_tops_that_roll() {
    let rolling = "[constraints]\nalong = \"vx = 0\"\nacross = \"vy = 0\"\n";
    for (place, n, fast, slow) in [
        (
            "0.003",
            "60",
            73.505_880_890_279_594_7,
            1.711_009_095_407_799_83,
        ),
        (
            "0.003",
            "200",
            239.840_626_001_123_31,
            0.524_386_684_883_993_426,
        ),
        (
            "-0.003",
            "60",
            52.263_011_200_369_713_9,
            1.360_177_205_427_387_5,
        ),
        (
            "-0.003",
            "200",
            178.345_369_807_508_035,
            0.398_591_545_148_970_228,
        ),
    ] {
        let case = tippe_top(place, rolling);
        let motion = case.motion(&[
            ("al", "0"),
            ("be", "0"),
            ("al'", "0"),
            ("be'", "0"),
            ("ga'", n),
            ("x'", "0"),
            ("y'", "0"),
        ]);
        let expected = pairs(&[(0.0, fast), (0.0, slow)]);
        are_eigenvalues(&case.spectrum(&motion), &expected, ROUNDING);
    }
    let case = tippe_top("-0.003", rolling);
    let linear = case.linear(&spinning(&case), "n").unwrap();
    let found = case.ranges(&linear, "n", 1, 100);
    let root = &found.boundaries.last().unwrap().root;
    assert!((root.low.to_f64().value() - 18.867_900_321_111_309_5).abs() < 1e-14);
    let stable: Vec<bool> = found.regions.iter().map(|r| r.is_left).collect();
    assert_eq!((stable.first(), stable.last()), (Some(&false), Some(&true)));
    // With the mass centre below there is no critical spin.
    let case = tippe_top("0.003", rolling);
    let linear = case.linear(&spinning(&case), "n").unwrap();
    let found = case.ranges(&linear, "n", 1, 100);
    assert!(found.regions.iter().all(|r| r.is_left), "{found:?}");
}

/// The caster with an elastic pivot, (J + m (e − b)²) s³ + (c + m (e − b) v) s² + e² k s + e k v, on both sides of its critical speed.
#[test]
fn shimmy() {
    for (v, real, pair) in [
        (
            "1",
            -10.842_825_868_183_839_3,
            (-8.483_912_509_695_062_62, 45.944_618_420_509_525_5),
        ),
        (
            "4",
            -40.095_737_856_063_037_8,
            (-0.070_474_267_234_753_296_9, 48.592_257_646_808_466_7),
        ),
        (
            "10",
            -75.358_729_264_561_300_3,
            (5.134_985_934_055_798_06, 55.807_059_180_234_318_4),
        ),
    ] {
        let case = Case::new(&CASTER.replace("v = 1,", &format!("v = {v},")));
        let found = case.spectrum(&case.motion(&[
            ("y", "0"),
            ("theta", "0"),
            ("theta'", "0"),
            ("y'", "0"),
            ("X'", v),
        ]));
        are_eigenvalues(
            &found,
            &[pairs(&[pair]), vec![(real, 0.0)]].concat(),
            ROUNDING,
        );
    }
}

/// λ⁴ + λ² + (27/4) μ (1 − μ) (Gascheau 1843), below Routh's ratio (1 − √69/9)/2 = 0.0385208965045513971… and above it; 2·10⁻¹⁷ below it double
/// precision would see two equal pairs.
#[test]
fn triangular_points() {
    for (mu, expected) in [
        (
            "0.01215",
            [
                (0.0, 0.954_503_314_114_590_688),
                (0.0, 0.298_200_307_418_122_931),
            ],
        ),
        (
            "0.05",
            [
                (0.181_985_689_884_268_41, 0.730_149_841_691_863_351),
                (-0.181_985_689_884_268_41, 0.730_149_841_691_863_351),
            ],
        ),
    ] {
        let case = triangular(mu);
        are_eigenvalues(
            &case.spectrum(case.named("L4")),
            &pairs(&expected),
            ROUNDING,
        );
    }
    for (mu, expected) in [
        ("0.0385208965045513718", "proved"),
        ("0.0385208965045514", "refuted"),
    ] {
        assert_eq!(
            triangular(mu).said("stability.linear", "L4"),
            expected,
            "{mu}"
        );
    }
}

/// x'' − g y' + d x' − x = 0, y'' + g x' + d y' − 2 y = 0: on the axis for g > 1 + √2 without damping only (Thomson and Tait 1879).
#[test]
fn gyroscopic_pairs() {
    for (damping, gyro, expected) in [
        (
            "0",
            "2",
            [
                (0.676_096_724_726_978_34, 0.978_318_343_478_515_956),
                (-0.676_096_724_726_978_34, 0.978_318_343_478_515_956),
            ],
        ),
        (
            "0.1",
            "2",
            [
                (-0.732_068_953_345_574_429, 1.053_247_739_079_377_44),
                (0.632_068_953_345_574_429, 0.903_385_473_848_254_007),
            ],
        ),
        (
            "0",
            "3",
            [
                (0.0, 2.376_078_978_288_514_42),
                (0.0, 0.595_187_944_212_086_179),
            ],
        ),
        (
            "0.1",
            "3",
            [
                (-0.134_791_573_696_419_566, 2.378_708_719_883_080_9),
                (0.034_791_573_696_419_565_6, 0.592_557_210_648_917_213),
            ],
        ),
    ] {
        let case = gyroscopic(damping, gyro);
        are_eigenvalues(
            &case.spectrum(case.named("up")),
            &pairs(&expected),
            ROUNDING,
        );
    }
}

/// The rolling disc leans by 0.3 and turns with 2 rad/s on a circle: its spin is −3.02135751832756922 by the equation of the family, and the lean swings
/// with the square of the frequency 2.16485678188832674.
#[test]
fn a_disc_on_a_circle() {
    let spin = "(-m g r sin(0.3) + A W^2 sin(0.3) cos(0.3))/((Cc + m r^2) W cos(0.3)) - W sin(0.3)";
    let motion = format!(
        r#"[steady.circle]
theta = 0.3
"theta'" = 0
"phi'" = "W"
"psi'" = "{spin}"
"#
    );
    let case = Case::new(&disc("W = 2", &motion));
    let motion = case.named("circle");
    let values = case.system.parameter_values();
    let own = case
        .system
        .graph
        .substitute(motion.velocities[4].unwrap(), &values);
    assert!((case.number(own, &[]) + 3.021_357_518_327_569_22).abs() < 1e-14);
    let expected = pairs(&[(0.0, 2.164_856_781_888_326_74_f64.sqrt())]);
    are_eigenvalues(&case.spectrum(motion), &expected, ROUNDING);
}
