//! Borders of stability over a parameter: where they lie, what passes there, and of which values a verdict speaks.
#![allow(
    clippy::unwrap_used,
    clippy::excessive_precision,
    reason = "test code fails where it stands; values have the digits of their source"
)]

use crate::common::Case;
use chetaev_symbolic::Verdict;

/// Watt's governor hunts below ε = 2 α β^(3/2) (Pontryagin 1962).
#[test]
fn watts_governor() {
    let case = Case::new(
        r#"
coordinates = ["x", "s"]
parameters = { alpha = 0.5, beta = 0.36, eps = 0.3 }
[lagrangian]
T = "1/2 x'^2 + 1/2 s'^2"
[forces]
x = "s'^2 sin(x) cos(x) - sin(x) - eps x'"
s = "alpha (cos(x) - beta)"
[steady.running]
x = "acos(beta)"
"x'" = 0
"s'" = "beta^(-1/2)"
"#,
    );
    assert_eq!(case.said("stability.nonlinear", "running"), "proved");
    let linear = case.linear(&case.system.steady[0], "eps").unwrap();
    let found = case.ranges(&linear, "eps", 0, 2);
    assert_eq!(found.boundaries.len(), 1, "{found:?}");
    assert_eq!(
        found.boundaries[0].crossing,
        chetaev_stability::hurwitz::Crossing::Pair
    );
    // 2 · 0.5 · 0.36^(3/2) = 0.216.
    let expected = chetaev_symbolic::Rational::from_parts(216.into(), 1000_u32.into());
    let root = &found.boundaries[0].root;
    assert!(root.low <= expected && expected <= root.high);
    let stable: Vec<bool> = found.regions.iter().map(|r| r.is_left).collect();
    assert_eq!(stable, [false, true]);
}

/// Where two oscillators lose their damping at p = 0, both pairs are named, whether their equations are apart or coupled; one alone is one.
#[test]
fn two_pairs_on_the_axis_at_once() {
    use chetaev_stability::hurwitz::{Boundary, Crossing};
    for (coupling, d, expected) in [
        ("0", 0, Crossing::Pairs),
        // The zeros at p = 0 are ± i and ± √2 i.
        ("p x", 0, Crossing::Pairs),
        ("0", 1, Crossing::Pair),
    ] {
        let case = Case::new(&format!(
            r#"
coordinates = ["x", "y"]
parameters = {{ p = -0.5 }}
[lagrangian]
L = "1/2 (x'^2 - x^2 + y'^2 - 2 y^2)"
[forces]
x = "p x' + p^2 y"
y = "(p - {d}) y' + {coupling}"
[steady.rest]
x = 0
y = 0
"#
        ));
        let linear = case.linear(&case.system.steady[0], "p").unwrap();
        let found = case.ranges(&linear, "p", -2, 2);
        let is_at_zero = |own: &&Boundary| own.root.low.is_zero() && own.root.high.is_zero();
        let own = found.boundaries.iter().find(is_at_zero);
        assert_eq!(own.map(|own| own.crossing), Some(expected), "{found:?}");
    }
}

/// A parameter of the equations over which a motion is judged: Watt's governor over its friction, which is positive.
#[test]
fn a_motion_is_judged_over_the_parameter_that_it_names() {
    let text = |over: &str, assumed: &str| {
        format!(
            r#"
coordinates = ["x", "s"]
parameters = {{ alpha = 0.5, beta = 0.36, eps = 0.3 }}
assumptions = ["{assumed}"]
[lagrangian]
T = "1/2 x'^2 + 1/2 s'^2"
[forces]
x = "s'^2 sin(x) cos(x) - sin(x) - eps x'"
s = "alpha (cos(x) - beta)"
[steady.running]
x = "acos(beta)"
"x'" = 0
"s'" = "beta^(-1/2)"
over = "{over}"
"#
        )
    };
    let case = Case::new(&text("eps", "eps > 0"));
    let said = |claim: &str| case.said(claim, "running");
    assert_eq!(said("stability.asymptotic"), "eps > 0.216");
    assert_eq!(said("stability.spectral"), "eps >= 0.216");
    let Verdict::Proved(proof) = case.verdict("stability.critical", "eps") else {
        panic!("{}", case.said("stability.critical", "eps"));
    };
    assert!(
        proof.detail.contains("changes at eps = 27/125 ("),
        "{proof:?}"
    );

    // With ε = 0.3 it is stable where α < 0.3/(2 · 0.216).
    let of_valve = Case::new(&text("alpha", "alpha > 0"));
    let found = of_valve.said("stability.asymptotic", "running");
    assert_eq!(found, "0 < alpha < 25/36");

    // Beyond what is assumed nothing fails, and nothing changes.
    let damped = Case::new(&text("eps", "eps > 1/4"));
    assert_eq!(damped.said("stability.asymptotic", "running"), "proved");
    let Verdict::Proved(proof) = damped.verdict("stability.critical", "eps") else {
        panic!("{}", damped.said("stability.critical", "eps"));
    };
    assert!(proof.detail.contains("is the same"), "{proof:?}");
    let hunting = Case::new(&text("eps", "eps < 1/5").replace("eps = 0.3", "eps = 0.1"));
    assert_eq!(hunting.said("stability.spectral", "running"), "refuted");
}

/// A sleigh that is assumed to go forward is stable: going backward is no counterexample.
#[test]
fn only_values_that_are_assumed_are_spoken_of() {
    let with = |assumed: &str| {
        let stated = r#"assumptions = ["m > 0", "J > 0"]"#;
        let all = format!(r#"assumptions = ["m > 0", "J > 0", "{assumed}"]"#);
        Case::gallery_with("chaplygin-sleigh", stated, &all)
            .said("stability.asymptotic", "straight")
    };
    assert_eq!(with("ahead > 0"), "proved");
    assert_eq!(with("ahead >= 0"), "ahead > 0");
    assert_eq!(with("ahead != 0"), "ahead > 0");
    assert_eq!(with("ahead > -1"), "ahead > 0");
    assert_eq!(with("ahead^2 < 4"), "0 < ahead < 2");
    assert_eq!(with("m ahead > 1"), "proved");
    assert_eq!(with("x' > 0"), "proved");
}

/// A refutation speaks of the value stated, and where there is no motion nothing fails.
#[test]
fn what_is_said_is_of_the_values_stated() {
    // x'' = w² x: unstable for every w but 0, and the model has w = 3.
    let repelled = r#"
coordinates = ["x", "s"]
parameters = { w = 3 }
lagrangian = "1/2 x'^2 + 1/2 s'^2 + 1/2 s'^2 x^2"
[steady.ahead]
x = 0
"x'" = 0
"s'" = "w"
"#;
    let case = Case::new(repelled);
    let Verdict::Conditional {
        condition,
        counterexample: Some(own),
        ..
    } = case.verdict("stability.spectral", "ahead")
    else {
        panic!(
            "conditional: {:?}",
            case.verdict("stability.spectral", "ahead")
        );
    };
    assert_eq!(condition, "w = 0");
    let value = own.point[0].exact.as_ref().map(ToString::to_string);
    assert_eq!(value.as_deref(), Some("3"));
    assert!(own.residual.0.starts_with('3'), "{own:?}");
    // x'' = −x whatever s' is; the motion is stated by 1/w.
    let stated = repelled
        .replace("+ 1/2 s'^2 x^2", "- 1/2 x^2")
        .replace("\"w\"", "\"1/w\"");
    let case = Case::new(&stated);
    assert_eq!(case.said("stability.spectral", "ahead"), "proved");
    assert_eq!(case.said("stability.asymptotic", "ahead"), "refuted");
}

/// Where J = 0 the mass matrix is singular, and no eigenvalue of x'' = −2 x − x' depends on J.
#[test]
fn a_singular_mass_without_an_eigenvalue_at_infinity() {
    use chetaev_stability::hurwitz::Crossing;
    let of = |kinetic: &str| {
        let case = Case::new(&format!(
            r#"
coordinates = ["x", "s"]
parameters = {{ J = 1 }}
[lagrangian]
T = "{kinetic}"
[forces]
x = "-2 x - x'"
[steady.o]
x = 0
"x'" = 0
"s'" = 1
"#
        ));
        let linear = case.linear(&case.system.steady[0], "J").unwrap();
        let found = case.ranges(&linear, "J", -2, 3);
        let own = found.boundaries.iter().map(|own| own.crossing);
        own.collect::<Vec<_>>()
    };
    assert_eq!(of("1/2 (x'^2 + (J + x^2) s'^2)"), [Crossing::Singular]);
    // With J for the mass of x λ = −2 and one at infinity are left.
    assert_eq!(
        of("1/2 (J x'^2 + (1 + x^2) s'^2)")[..1],
        [Crossing::Infinity]
    );
}

/// A border that belongs to what is assumed is a value like all others. x'' = −x − (c − 1) x' grows below c = 1 and is periodic there; with the damping
/// c it falls above c = 0 and is periodic there; with c (c − 1) it grows between both. x'' = −k x − 4 x³ has λ² = −k, and at k = 0 a double zero. What
/// is assumed without the border has no change.
#[test]
fn the_border_of_an_assumption_may_be_critical() {
    let axis = "with all eigenvalues on the axis or left of it there alone";
    let cases = [
        (
            "c",
            "c <= 1",
            "-x - (c - 1) x'",
            vec![format!("c = 1 ({axis}, unstable below)")],
        ),
        ("c", "c < 1", "-x - (c - 1) x'", vec![]),
        (
            "c",
            "c >= 0",
            "-x - c x'",
            vec![format!("c = 0 ({axis}, asymptotically stable above)")],
        ),
        ("c", "c > 0", "-x - c x'", vec![]),
        (
            "c",
            "0 <= c <= 1",
            "-x - c (c - 1) x'",
            vec![
                format!("c = 0 ({axis}, unstable above)"),
                format!("c = 1 ({axis}, unstable below)"),
            ],
        ),
        (
            "k",
            "k <= 0",
            "-k x - 4 x^3",
            vec![format!("k = 0 ({axis}, unstable below)")],
        ),
        ("k", "k <= -1", "-k x - 4 x^3", vec![]),
    ];
    for (name, assumed, force, expected) in cases {
        let value = if name == "c" { "0.5" } else { "-2" };
        let case = Case::new(&format!(
            "coordinates = [\"x\"]\nassumptions = [\"{assumed}\"]\nparameters = {{ {name} = {value} }}\nlagrangian = \"1/2 x'^2\"\nforces = {{ x = \"{force}\" }}\n[steady.rest]\nx = 0\n\"x'\" = 0\nover = \"{name}\"\n"
        ));
        let Verdict::Proved(proof) = case.verdict("stability.critical", name) else {
            panic!("{}", case.said("stability.critical", name));
        };
        let detail = proof.detail;
        assert_eq!(
            detail.contains("is the same"),
            expected.is_empty(),
            "{detail}"
        );
        for own in expected {
            assert!(detail.contains(&own), "{assumed}, {force}: {detail}");
        }
    }
}

/// A weight that falls, in polar coordinates: at r = 0, phi = π/2 both equations hold with all rates zero, and it falls with g all the same.
#[test]
fn the_centre_of_polar_coordinates_is_no_motion() {
    let case = Case::new(
        r#"
coordinates = ["r", "phi"]
[lagrangian]
L = "1/2 (r'^2 + r^2 phi'^2) - r cos(phi)"
[steady.centre]
r = 0
phi = "pi/2"
"r'" = 0
"phi'" = 0
"#,
    );
    for claim in ["steady.stated", "stability.spectral"] {
        let found = case.verdict(claim, "centre");
        assert!(matches!(found, Verdict::Undecided { .. }), "{found:?}");
        assert!(
            found.detail().contains("mass matrix is singular"),
            "{found:?}"
        );
    }
}

/// x = −1 is where x'' = −(x + 1) rests, and the model assumes x > 0.
#[test]
fn a_motion_outside_of_what_is_assumed_is_none() {
    let case = Case::new(
        r#"
coordinates = ["x"]
assumptions = ["x > 0"]
[lagrangian]
T = "1/2 x'^2"
V = "1/2 (x + 1)^2"
[steady.m]
x = -1
"#,
    );
    let found = case.verdict("steady.stated", "m");
    assert!(matches!(found, Verdict::Refuted(_)), "{found:?}");
    assert!(
        found.detail().contains("`x > 0` does not hold"),
        "{found:?}"
    );
    let found = case.verdict("stability.linear", "m");
    assert!(!matches!(found, Verdict::Proved(_)), "{found:?}");
}
