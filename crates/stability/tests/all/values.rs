//! Verdicts over all values of a parameter where single values, large ones, or those without a motion make the difference; the expected values are
//! read off equations of one or two oscillators.
#![allow(clippy::unwrap_used, reason = "test code fails where it stands")]

use crate::common::Case;
use chetaev_stability::eigenvalues::{eigenvalues, unreached, Unreached};
use chetaev_stability::real_roots::real_roots;
use chetaev_symbolic::{Rational, Verdict};

/// One oscillator at rest at x = 0, over p.
fn oscillator(value: &str, energy: &str, force: &str) -> Case {
    Case::new(&format!(
        r#"
coordinates = ["x"]
parameters = {{ p = {value} }}
[lagrangian]
{energy}
[forces]
x = "{force}"
[steady.s]
x = 0
"x'" = 0
over = "p"
"#
    ))
}

/// x'' = p² x' − x − x'⁵ + x² x'³ is unstable for all p but zero, where nothing here says what it is; with −x'⁵ the energy falls there.
#[test]
fn a_single_value_is_not_swept_away() {
    let damped = oscillator("0.5", "L = \"1/2 x'^2 - 1/2 x^2\"", "p^2 x' - x'^5");
    assert_eq!(damped.said("stability.nonlinear", "s"), "p = 0");
    let case = oscillator(
        "0.5",
        "L = \"1/2 x'^2 - 1/2 x^2\"",
        "p^2 x' - x'^5 + x^2 x'^3",
    );
    let verdict = case.verdict("stability.nonlinear", "s");
    assert_eq!(verdict.word(), "refuted");
    let said = verdict.detail();
    assert!(
        said.ends_with("false for p < 0 or p > 0, and not decided at p = 0"),
        "{said}"
    );
    assert_eq!(case.said("stability.linear", "s"), "p = 0");
}

/// x'' = −x' − (p − 10³⁰)(p − 1) x: stable outside of the interval from 1 to 10³⁰, and at its ends, where all x are at rest.
#[test]
fn values_far_apart_are_all_found() {
    let case = oscillator("2", "L = \"1/2 x'^2 - 1/2 (p - 1e30) (p - 1) x^2\"", "-x'");
    let said = case.said("stability.asymptotic", "s");
    let values: Vec<f64> = said
        .split_whitespace()
        .filter_map(|word| word.parse().ok())
        .collect();
    assert_eq!(values.len(), 2, "{said}");
    assert!((values[0] - 1.0).abs() < 1e-15 && (values[1] / 1e30 - 1.0).abs() < 1e-15);
    assert!(said.starts_with("p <= 1 or p > "), "{said}");
    // Beyond a single critical value too.
    let far = oscillator("2e30", "L = \"1/2 x'^2 - 1/2 (p - 1e30) x^2\"", "0");
    let said = far.said("stability.linear", "s");
    assert!(said.starts_with("p > 1"), "{said}");
}

/// x'' = −(p − 1)(p − 1 − 10⁻²⁵) x' − x is unstable between two values that are close to each other.
#[test]
fn values_close_together_are_told_apart() {
    let case = oscillator(
        "1",
        "L = \"1/2 x'^2 - 1/2 x^2\"",
        "-(p - 1) (p - 1 - 1e-25) x'",
    );
    let Verdict::Conditional {
        counterexample: Some(own),
        ..
    } = case.verdict("stability.spectral", "s")
    else {
        panic!("{:?}", case.verdict("stability.critical", "p"));
    };
    let at = own.point[0].exact.clone().unwrap();
    let beyond = at - chetaev_symbolic::Rational::ONE;
    let place = beyond.to_f64().value();
    assert!(0.0 < place && place < 1e-25, "{place}");
    let said = case.said("stability.spectral", "s");
    assert!(said.contains("p >= 1.0000000000000000000000001"), "{said}");
    let critical = case.verdict("stability.critical", "p");
    assert_eq!(critical.detail().matches("a pair passes").count(), 2);
}

/// With x'' = −x' − p x³ the eigenvalues are 0 and −1 for all p, and the motion is stable for p ≥ 0 only: what is the same is told.
#[test]
fn critical_values_are_those_of_the_spectrum() {
    let case = oscillator("1", "L = \"1/2 x'^2\"", "-x' - p x^3");
    assert_eq!(case.said("stability.nonlinear", "s"), "p >= 0");
    assert_eq!(
        case.verdict("stability.critical", "p").detail(),
        "the spectral stability of s is the same for all p"
    );
}

/// Two oscillators of which one stands upside down: an eigenvalue of the other passes zero at p = 1, and the motion is unstable there and on
/// both sides.
#[test]
fn what_happens_without_a_change_is_no_change() {
    let case = Case::new(
        r#"
coordinates = ["x", "y"]
parameters = { p = 3 }
[lagrangian]
L = "1/2 (x'^2 + y'^2) + 1/2 x^2 - 1/2 (p - 1) y^2"
[forces]
x = "-x'"
y = "-y'"
[steady.s]
x = 0
y = 0
"x'" = 0
"y'" = 0
over = "p"
"#,
    );
    let verdict = case.verdict("stability.critical", "p");
    let said = verdict.detail();
    assert!(
        said.starts_with("the spectral stability of s is the same for all p; without a change of stability an eigenvalue passes through zero, unstable on both sides and there, at p = 1"),
        "{said}"
    );
}

/// Two oscillators of the same frequency, of which z drives x by the function c(p): x'' = −x + c(p) z, z'' = −z. Where c vanishes the linear
/// motions stay bounded, and grow like t elsewhere. The same with two that have no frequency, x'' = c(p) z', z'' = −x' c(p)², where c = 0
/// leaves two uniform motions and what is beside it a rotation with a uniform motion.
#[test]
fn single_values_at_which_eigenvalues_have_all_their_vectors_are_told() {
    let driven = |drive: &str| {
        Case::new(&format!(
            r#"
coordinates = ["x", "z"]
parameters = {{ p = 3 }}
[lagrangian]
L = "1/2 (x'^2 + z'^2) - 1/2 (x^2 + z^2)"
[forces]
x = "{drive}"
[steady.s]
x = 0
z = 0
"x'" = 0
"z'" = 0
over = "p"
"#
        ))
    };
    let said = |drive: &str| driven(drive).said("stability.linear", "s");
    assert_eq!(said("p z"), "p = 0");
    assert_eq!(said("p (p - 2) z"), "p = 0 or p = 2");
    let roots = said("(p^2 - 2) z");
    assert_eq!(roots, "p = -sqrt(2) or p = sqrt(2)");
    assert_eq!(
        driven("(p^2 + 1) z")
            .verdict("stability.linear", "s")
            .word(),
        "refuted"
    );
    // At p = 0 z drives x, and x is driven itself: two vanish at different values, and no value leaves all bounded.
    let both = driven("p (x'^2 - z^2) + (p - 1) z");
    assert_eq!(both.said("stability.linear", "s"), "p = 1");
}

/// A bead on a hoop that turns: it stands aside at cos θ = 1/W², where W² ≥ 1.
#[test]
fn there_is_no_motion_where_it_is_not_real() {
    let bead = |value: &str| {
        Case::new(&format!(
            r#"
coordinates = ["th"]
parameters = {{ W = {value} }}
[lagrangian]
L = "1/2 (th'^2 + W^2 sin(th)^2) + cos(th)"
[steady.aside]
th = "acos(1/W^2)"
"th'" = 0
over = "W"
"#
        ))
    };
    let turning = bead("2");
    assert_eq!(turning.said("steady.stated", "aside"), "W <= -1 or W >= 1");
    // Where it is bent from the lowest place the potential energy is θ⁴/8, so that it is stable, and its linear motions grow like t.
    assert_eq!(turning.said("stability.nonlinear", "aside"), "proved");
    let found = turning.said("stability.linear", "aside");
    assert_eq!(found, "W < -1 or W > 1");
    let slow = bead("0.5");
    for claim in ["steady.stated", "stability.nonlinear"] {
        let said = slow.said(claim, "aside");
        assert!(
            said.starts_with("undecided: there is no motion `aside`: acos(4)"),
            "{said}"
        );
    }
}

/// At tan θ = 200/981 gravity and a horizontal force balance: 981/100 sin θ = 2 cos θ.
#[test]
fn a_rate_that_vanishes_is_seen_to() {
    let case = Case::new(
        r#"
coordinates = ["th"]
parameters = { g = 9.81, a = 2 }
[lagrangian]
L = "1/2 th'^2 - g cos(th) - a sin(th)"
[steady.tilt]
th = "atan(a/g)"
"th'" = 0
"#,
    );
    assert_eq!(case.said("steady.stated", "tilt"), "proved");
}

/// With sin p in the place of the stiffness the values at which it vanishes are not enumerated: only the value that is stated is spoken of, and that
/// others make it false is not said.
#[test]
fn what_is_decided_for_one_value_says_so() {
    let case = oscillator("1", "L = \"1/2 x'^2 - 1/2 sin(p) x^2\"", "-x'");
    match case.verdict("stability.asymptotic", "s") {
        Verdict::Proved(proof) => assert!(proof.on.ends_with("that are stated, p = 1")),
        other => panic!("{other:?}"),
    }
}

/// A border that is a fraction belongs to where the statement fails, and is written as one: at p = 1/3 the eigenvalues are ± i.
#[test]
fn fractions_are_borders_as_they_are() {
    let case = oscillator("\"1/3\"", "L = \"1/2 x'^2 - 1/2 x^2\"", "-(p - 1/3) x'");
    assert_eq!(case.said("stability.asymptotic", "s"), "p > 1/3");
}

/// m y'' = −2 y − y' has one eigenvalue only where m = 0, and no acceleration.
#[test]
fn singular_masses_are_left_out() {
    let case = oscillator("0.5", "L = \"1/2 p x'^2 - x^2\"", "-x'");
    assert_eq!(case.said("stability.nonlinear", "s"), "p > 0");
    let massless = oscillator("0", "L = \"1/2 p x'^2 - x^2\"", "-x'");
    assert!(massless.said("stability.asymptotic", "s") == "p > 0");
}

/// Three unit masses in a chain with unit springs and dashpots: s M + D = T with K = T, T tridiagonal with 2 on the diagonal but 1 at its end, so
/// that det(s² + (s + 1) T) has the coefficients 1, 5, 11, 13, 9, 3, 1; it is damped in all motions (Kelvin and Tait 1879).
#[test]
fn a_chain_of_three_masses() {
    let case = Case::new(
        r#"
coordinates = ["x", "y", "z"]
[lagrangian]
L = "1/2 (x'^2 + y'^2 + z'^2) - 1/2 (x^2 + (y - x)^2 + (z - y)^2)"
[forces]
x = "-x' + (y' - x')"
y = "-(y' - x') + (z' - y')"
z = "-(z' - y')"
[steady.rest]
x = 0
y = 0
z = 0
"x'" = 0
"y'" = 0
"z'" = 0
"#,
    );
    let motion = case.system.steady[0].clone();
    let linear = case.linear(&motion, "").unwrap();
    let g = &case.system.graph;
    let polynomial = chetaev_stability::characteristic::Characteristic::of(g, &linear).unwrap();
    let own: Vec<String> = polynomial.coefficients.iter().map(|&e| g.text(e)).collect();
    // T has the characteristic polynomial t³ − 5 t² + 6 t − 1; with t = −s²/(s + 1): s⁶ + 5 s⁴ (s + 1) + 6 s² (s + 1)² + (s + 1)³.
    assert_eq!(own, ["1", "3", "9", "13", "11", "5", "1"]);
    assert_eq!(case.said("stability.asymptotic", "rest"), "proved");
}

/// Two oscillators in units that are 10⁸ times apart have the eigenvalues of the same in one unit: λ² + λ/10 + 1 twice, coupled by 1/5.
#[test]
fn eigenvalues_do_not_depend_on_units() {
    let matrix = |unit: f64| {
        vec![
            vec![0.0, 0.0, 1.0, 0.0],
            vec![0.0, 0.0, 0.0, 1.0],
            vec![-1.0, -0.2 * unit, -0.1, 0.0],
            vec![-0.2 / unit, -1.0, 0.0, -0.1],
        ]
    };
    let one: Vec<Vec<f64>> = (0..4)
        .map(|r| (0..4).map(|c| f64::from(u8::from(r == c))).collect())
        .collect();
    // λ² + λ/10 + 1 ± 1/5 = 0.
    let expected = [1.2_f64, 1.2, 0.8, 0.8].map(|own| (own - 0.0025).sqrt());
    for unit in [1.0, 1e8, 1e-12] {
        let found = eigenvalues(&one, &matrix(unit)).unwrap();
        let mut sizes: Vec<f64> = found.iter().map(|l| l.im.abs()).collect();
        sizes.sort_by(|a, b| b.total_cmp(a));
        for (a, b) in sizes.iter().zip(expected) {
            assert!((a - b).abs() < 1e-13, "{unit}: {found:?}");
        }
        assert!(
            found.iter().all(|l| (l.re + 0.05).abs() < 1e-13),
            "{found:?}"
        );
    }
}

/// Two oscillators x'' = −x + u and y'' = −4 y: the input reaches the first only, in any units.
#[test]
fn modes_that_no_input_reaches() {
    for unit in [1.0, 1e6] {
        let a = [
            [0.0, 0.0, unit, 0.0],
            [0.0, 0.0, 0.0, 1.0],
            [-1.0 / unit, 0.0, 0.0, 0.0],
            [0.0, -4.0, 0.0, 0.0],
        ];
        let a: Vec<Vec<f64>> = a.iter().map(|row| row.to_vec()).collect();
        let input = |on_second: f64| -> Vec<Vec<f64>> {
            let column = [0.0, 0.0, 1.0, on_second];
            column.iter().map(|x| vec![*x]).collect()
        };
        let found = unreached(&a, &input(0.0)).unwrap();
        assert_eq!(found.len(), 1, "{found:?}");
        let Unreached {
            eigenvalue,
            count,
            modes,
        } = found[0];
        assert!(eigenvalue.re.abs() < 1e-14 && (eigenvalue.im - 2.0).abs() < 1e-14);
        assert_eq!((count, modes), (1, 1));
        assert!(unreached(&a, &input(1.0)).unwrap().is_empty());
    }
}

/// At x = 1/(a − 1) there is no motion for a = 1.
#[test]
fn a_pole_is_no_motion() {
    let case = Case::new(
        r#"
coordinates = ["x"]
parameters = { a = 2 }
[lagrangian]
L = "1/2 x'^2"
[forces]
x = "1 - (a - 1) x - x'"
[steady.s]
x = "1/(a - 1)"
"x'" = 0
over = "a"
"#,
    );
    assert_eq!(case.said("stability.asymptotic", "s"), "a > 1");
    assert_eq!(case.said("stability.nonlinear", "s"), "a > 1");
}

/// x'' = −a x − x' is assumed for a² ≥ 1 alone: between −1 and 1, which are left out, its stability becomes another.
#[test]
fn what_changes_across_values_that_are_left_out_is_told() {
    let case = Case::new(
        r#"
assumptions = ["a^2 >= 1"]
coordinates = ["x"]
parameters = { a = 2 }
[lagrangian]
L = "1/2 x'^2 - 1/2 a x^2"
[forces]
x = "-x'"
[steady.s]
x = 0
"x'" = 0
over = "a"
"#,
    );
    let found = case.verdict("stability.critical", "a");
    let said = found.detail();
    assert!(
        said.contains(
            "changes at a = -1, beyond which it is asymptotically stable, unstable before"
        ),
        "{said}"
    );
}

/// Several finite constraints tie the others by a coordinate on which nothing depends: on both spheres x = 1/2, and y² = 3/4 where z = 0.
#[test]
fn constraints_that_share_an_ignorable_coordinate_are_kept() {
    let case = Case::new(
        r#"
coordinates = ["x", "y", "z"]
[lagrangian]
L = "1/2 (x'^2 + y'^2 + z'^2) - y"
[constraints]
one = "x^2 + y^2 + z^2 = 1"
other = "(x - 1)^2 + y^2 + z^2 = 1"
"#,
    );
    let found = case.verdict_of_all("equilibrium.states");
    let said = found.detail();
    assert!(said.contains("2 states of rest: x = 1/2"), "{said}");
}

/// Two oscillators with dissipation at rest in the origin, over p with what is assumed of it.
fn damped(assumed: &str, potential: &str, forces: [&str; 2]) -> Case {
    Case::new(&format!(
        "coordinates = [\"x\", \"y\"]\nassumptions = [{assumed}]\nparameters = {{ p = 0.5 }}\n[lagrangian]\nT = \"1/2 (x'^2 + y'^2)\"\nV = \"{potential}\"\n\
         [forces]\nx = \"{}\"\ny = \"{}\"\n[steady.s]\nx = 0\ny = 0\nover = \"p\"\n",
        forces[0], forces[1]
    ))
}

/// What ends the admitted values of a parameter changes no eigenvalue, and a zero of a family that is there for one value alone is none of others.
#[test]
fn ends_and_single_values_belong_to_what_holds_there() {
    let stiff = "1/2 (1 + p) (x^2 + y^2)";
    let verdict = damped("\"p >= 0\"", stiff, ["-x'", "-y'"]).verdict("stability.asymptotic", "s");
    assert_eq!(verdict.word(), "proved", "{}", verdict.detail());
    // For p = 0 all y are at rest, and the eigenvalue −1 is left beside 0.
    let family = damped("", "1/2 x^2 + 1/2 p y^2", ["-x'", "-y'"]);
    assert_eq!(family.said("stability.asymptotic", "s"), "p >= 0");
    // A charge in a magnetic field moves on circles, and without one it rests anywhere.
    let free = damped("", "0", ["p y' - x'", "-p x' - y'"]);
    let verdict = free.verdict("stability.asymptotic", "s");
    assert_eq!(verdict.word(), "proved", "{}", verdict.detail());
    // P = 0 of a follower force is asymptotically stable where the whole interval below its threshold is.
    let turned = damped("\"p >= 0\"", "1/2 (x^2 + y^2)", ["-x' + p y", "-y' - p x"]);
    assert_eq!(turned.said("stability.asymptotic", "s"), "0 <= p < 1");
}

/// Roots of the parameter have no slope at zero, and the borders are found from there on all the same: √p = 1, p^(3/2) = 2, p^(1/3) = 1/2.
#[test]
fn borders_of_roots_of_the_parameter() {
    for (root, border) in [
        ("sqrt(p) - 1", 1.0),
        ("p^(3/2) - 2", 2.0_f64.powf(2.0 / 3.0)),
        ("p^(1/3) - 1/2", 0.125),
    ] {
        let case = oscillator("1", "L = \"1/2 x'^2 - 1/2 x^2\"", &format!("-({root}) x'"));
        let linear = case.linear(&case.system.steady[0], "p").unwrap();
        let found = case.ranges(&linear, "p", 0, 2);
        assert_eq!(found.boundaries.len(), 1, "{root}: {found:?}");
        let at = &found.boundaries[0].root;
        let [low, high] = [&at.low, &at.high].map(|end| end.to_f64().value());
        assert!(
            (low - border).abs() < 1e-15 && (high - border).abs() < 1e-15,
            "{root}: {low} {high}"
        );
        let stable: Vec<bool> = found.regions.iter().map(|own| own.is_left).collect();
        assert_eq!(stable, [false, true], "{root}");
    }
}

/// What holds for general values of a parameter without a value says so. x'' = −x, y'' = −y + q x has a Jordan block for q ≠ 0, and bounded motions for
/// q = 0; x'' = −x' − q² x stands still at 0 alone for q ≠ 0, and everywhere for q = 0.
#[test]
fn what_general_values_say_is_not_said_of_all() {
    let of = |force: &str| {
        Case::new(&format!(
            "coordinates = [\"x\", \"y\"]\nparameters = {{ q = {{}} }}\nlagrangian = \"1/2 x'^2 + 1/2 y'^2\"\nforces = {{ {force} }}\n[steady.rest]\nx = 0\ny = 0\n\"x'\" = 0\n\"y'\" = 0\n"
        ))
    };
    let general = "for general values of q";
    let Verdict::Refuted(found) =
        of("x = \"-x\", y = \"-y + q x\"").verdict("stability.linear", "rest")
    else {
        panic!("a Jordan block");
    };
    assert!(found.detail.contains(general), "{found:?}");
    for claim in ["steady.motions", "equilibrium.states"] {
        let Verdict::Proved(found) =
            of("x = \"-x' - q^2 x\", y = \"-y' - y\"").verdict_of_all(claim)
        else {
            panic!("{claim}");
        };
        assert!(found.on.contains(general), "{found:?}");
        assert!(found.detail.contains(general), "{found:?}");
    }
}

/// A double zero of the constant coefficient is touched: x'' = −x' − (k − 1)² x has the eigenvalues −(k − 1)² and −1 near k = 1. With (k − 1)³ one passes.
/// The damping (c² − 2)² (c − 1) is zero at c = ±√2 and at c = 1, above which no eigenvalue lies right of the axis: alone c = −√2 is added, exactly.
#[test]
fn an_eigenvalue_that_touches_zero_does_not_pass() {
    let of = |name: &str, force: &str| {
        Case::new(&format!(
            "coordinates = [\"x\"]\nparameters = {{ {name} = 2 }}\nlagrangian = \"1/2 x'^2\"\nforces = {{ x = \"{force}\" }}\n[steady.rest]\nx = 0\n\"x'\" = 0\nover = \"{name}\"\n"
        ))
    };
    let touching = of("k", "-x' - (k - 1)^2 x").verdict("stability.critical", "k");
    let said = touching.detail();
    assert!(said.contains("an eigenvalue is zero"), "{said}");
    assert!(!said.contains("passes"), "{said}");
    let passing = of("k", "-x' - (k - 1)^3 x").verdict("stability.critical", "k");
    let said = passing.detail();
    assert!(said.contains("passes through zero"), "{said}");
    let alone = of("c", "-x - (c^2 - 2)^2 (c - 1) x'").said("stability.linear", "rest");
    assert_eq!(alone, "c >= 1 or c = -sqrt(2)");
}

/// A stiffness 1/(p − 1) has no value at p = 1, and is left as it is for other values of p.
#[test]
fn what_is_divided_by_zero_is_refused() {
    let energy = "L = \"1/2 x'^2 - x^2/(2 (p - 1))\"";
    let case = oscillator("1", energy, "-x'");
    let said = case.linear(case.named("s"), "").unwrap_err().to_string();
    assert!(said.contains("divided by p - 1, which is zero"), "{said}");
    assert!(case.linear(case.named("s"), "p").is_ok());
    assert_eq!(case.said("stability.asymptotic", "s"), "p > 1");
    let other = oscillator("2", energy, "-x'");
    assert!(other.linear(other.named("s"), "").is_ok());
}

/// Of L = (x'² + (1 + x²) s'²)/2 − x² at x = 0, s' = w the deviations have x'' = (w² − 2) x: pairs on the axis for |w| < √2, an eigenvalue right of it
/// for |w| > √2. No w is asymptotically stable, and each reason is said of its own values.
#[test]
fn a_reason_is_said_of_its_own_values() {
    let case = Case::new(
        r#"
coordinates = ["x", "s"]
parameters = { w = 2 }
lagrangian = "1/2 x'^2 + 1/2 (1 + x^2) s'^2 - x^2"
[steady.o]
x = 0
"s'" = "w"
"#,
    );
    let verdict = case.verdict("stability.asymptotic", "o");
    assert_eq!(verdict.word(), "refuted");
    let said = verdict.detail();
    assert!(said.starts_with("at w = "), "{said}");
    assert!(said.contains("false for w < -1.41"), "{said}");
}

/// √(1 − p²) ends at its zeros; p − √(2 − p²) vanishes at 1, and its conjugate at −1; √(p + √(p + 2)) at −1; 2 + √(4 − p²) nowhere; and
/// √(1 − p²) (1/2 + p − p²) at ±1 and at (1 − √3)/2.
#[test]
fn functions_with_square_roots_vanish_where_they_do() {
    let case = oscillator("1", "L = \"1/2 p x'^2 - x^2\"", "-x'");
    let g = &case.system.graph;
    let symbol = g.intern_symbol("p", 0);
    let bounds = [-10, 10].map(Rational::from);
    let zeros = |text: &str| -> Vec<f64> {
        let found = real_roots(g, case.read(text), symbol, &bounds[0], &bounds[1]);
        let found = found.unwrap_or_else(|| panic!("{text}"));
        found.iter().map(|own| own.low.to_f64().value()).collect()
    };
    let near = |text: &str, expected: &[f64]| {
        let found = zeros(text);
        assert_eq!(found.len(), expected.len(), "{text}: {found:?}");
        for (a, b) in found.iter().zip(expected) {
            assert!((a - b).abs() < 1e-15, "{text}: {found:?}");
        }
    };
    let (two, three) = (2_f64.sqrt(), 3_f64.sqrt());
    near("sqrt(1 - p^2)", &[-1.0, 1.0]);
    near("sqrt(2 - p^2)", &[-two, two]);
    near("p - sqrt(2 - p^2)", &[1.0]);
    near("sqrt(p + sqrt(p + 2))", &[-1.0]);
    near("2 + sqrt(4 - p^2) - p/10", &[]);
    near(
        "(1 - p^2)^(3/2) + (1 - p^2)^(1/2)*(p - 1/2)",
        &[-1.0, 0.5 - three / 2.0, 1.0],
    );
}

/// A pendulum under a constant torque p: it stands at asin p up to p = 1, where both equilibria meet.
#[test]
fn a_motion_that_ends_at_a_root() {
    let case = Case::new(
        r#"
coordinates = ["x"]
[parameters]
p = 0.5
[lagrangian]
L = "1/2 x'^2 + cos(x) + p x"
[forces]
x = "-x'"
[steady.s]
x = "asin(p)"
"x'" = 0
over = "p"
"#,
    );
    assert_eq!(case.said("stability.asymptotic", "s"), "-1 < p < 1");
}

/// Where the interval of a root ends the motion is one all the same, and what holds inside need not hold there: x'' = −x' − √p x + x², x'' = −√p x + x³ and
/// x'' = −x − √p x' + x² x' are unstable at p = 0, x'' = −x − √p x' is not damped there, and x'' = −x', y'' = … of `(2 − √p)` resonates.
#[test]
fn the_end_of_a_root_is_a_value_like_others() {
    let still = "-y' - y";
    let of = |assumed: &str, force: &str| damped(assumed, "0", [force, still]);
    let case = of("\"p >= 0\"", "-x' - sqrt(p) x + x^2");
    assert_eq!(case.said("stability.asymptotic", "s"), "p > 0");
    assert_eq!(case.said("stability.nonlinear", "s"), "p > 0");
    let case = of("\"p >= 0\"", "-sqrt(p) x + x^3");
    assert_eq!(case.said("stability.linear", "s"), "p > 0");
    assert_ne!(case.said("stability.nonlinear", "s"), "proved");
    let case = of("\"p >= 0\"", "-x + x' x^2 - sqrt(p) x'");
    assert_eq!(case.said("stability.asymptotic", "s"), "p > 0");
    assert_eq!(case.said("stability.nonlinear", "s"), "p > 0");
    // Values at the other end of an interval are not lost.
    let case = of("\"p >= 0\", \"p <= 1\"", "-x - (2 - sqrt(1 - p)) x'");
    assert_eq!(case.said("stability.asymptotic", "s"), "proved");
    let case = of(
        "\"p >= 0\", \"p <= 1\"",
        "-x - (2 p - 1 + sqrt(1 - p)/1000) x'",
    );
    let said = case.said("stability.asymptotic", "s");
    assert!(said.ends_with("< p <= 1"), "{said}");
}

/// x'' = −(1 + p) x, y'' = −y − 3 (2 − √p) x has a Jordan block at p = 0 alone.
#[test]
fn a_resonance_at_the_end_of_a_root() {
    let case = damped("\"p >= 0\"", "0", ["-(1 + p) x", "-y - 3 (2 - sqrt(p)) x"]);
    assert_eq!(case.said("stability.linear", "s"), "p > 0");
}

/// At a corner of the forces along the motion nothing is said, and the verdict names it: x'' = −x' − |x − p| x at x = 0.
#[test]
fn at_a_corner_nothing_is_said() {
    let case = damped("", "0", ["-x' - (1 + abs(x - p)) x", "-y' - y"]);
    let verdict = case.verdict("stability.asymptotic", "s");
    assert_eq!(verdict.word(), "conditional", "{}", verdict.detail());
    assert!(
        verdict.detail().contains("nothing is said at p = 0"),
        "{}",
        verdict.detail()
    );
}

/// λ² + √p λ + 2 and λ² + 1 − √p: a pair on the axis for p < 1, whose factor is found though the root stands in both.
#[test]
fn pairs_on_the_axis_are_found_beside_roots_of_the_parameter() {
    type OfValue = fn(f64) -> f64;
    let roots: [(&str, OfValue); 4] = [
        ("sqrt(p)", f64::sqrt),
        ("abs(p)", f64::abs),
        ("sqrt(1 + p)", |p| (1.0 + p).sqrt()),
        ("sqrt(1 + cos(p))", |p| (1.0 + p.cos()).sqrt()),
    ];
    for (root, value) in roots {
        let force = format!("-{root} x' - 2 x");
        let other = format!("-(1 - {root}) y");
        let case = damped("\"p >= 0\"", "0", [&force, &other]);
        let linear = case.linear(&case.system.steady[0], "p").unwrap();
        let found = case.ranges(&linear, "p", 0, 3);
        for own in &found.regions {
            assert!(own.is_decided, "{root}: {own:?}");
            let is_left = value(own.sample.to_f64().value()) < 1.0;
            assert_eq!(own.is_left, is_left, "{root}: {own:?}");
        }
    }
}
