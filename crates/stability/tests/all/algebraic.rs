//! Motions whose coordinates are zeros of polynomials without a closed form: exact as algebraic numbers.
#![allow(
    clippy::unwrap_used,
    clippy::excessive_precision,
    reason = "test code fails where it stands; values have the digits of their source"
)]

use crate::common::{are_eigenvalues, Case};
use chetaev_stability::characteristic::Characteristic;
use chetaev_stability::real_roots::sign_of;
use std::cmp::Ordering;

/// A quintic force x + 1 − x⁵: rest at the zero 1.1673… of x⁵ − x − 1 (OEIS A160155), which has no closed form (its group is the symmetric one).
const QUINTIC: &str = r#"
coordinates = ["x"]
[lagrangian]
L = "1/2 x'^2 - x^6/6 + x^2/2 + x"
[forces]
x = "-c x'"
[parameters]
c = 1
[steady.right]
x = { guess = 1 }
"x'" = 0
"#;

#[test]
fn rest_on_a_quintic_force_is_stable() {
    let case = Case::new(QUINTIC);
    let stiffness: f64 = 5.0 * 1.167_303_978_261_418_684_256_f64.powi(4) - 1.0;
    let pair = (stiffness - 0.25).sqrt();
    let found = case.spectrum(case.named("right"));
    are_eigenvalues(&found, &[(-0.5, pair), (-0.5, -pair)], 1e-13);
    for claim in ["asymptotic", "spectral", "linear", "nonlinear"] {
        let said = case.said(&format!("stability.{claim}"), "right");
        assert_eq!(said, "proved", "{claim}");
    }
}

/// Pushed instead of damped it is unstable; with neither its energy has a minimum there (Lagrange and Dirichlet).
#[test]
fn damping_decides() {
    let pushed = Case::new(&QUINTIC.replace("c = 1", "c = -1"));
    for claim in ["asymptotic", "spectral", "linear", "nonlinear"] {
        let said = pushed.said(&format!("stability.{claim}"), "right");
        assert_eq!(said, "refuted", "{claim}");
    }
    let free = Case::new(&QUINTIC.replace("c = 1", "c = 0"));
    for (claim, expected) in [
        ("asymptotic", "refuted"),
        ("spectral", "proved"),
        ("linear", "proved"),
        ("nonlinear", "proved"),
    ] {
        let said = free.said(&format!("stability.{claim}"), "right");
        assert_eq!(said, expected, "{claim}");
    }
}

/// Two coordinates, V = x⁴/4 − x²/2 − x + (x³ − x − 1) y²/2: at the zero of x³ − x − 1, the plastic number, the stiffness across vanishes exactly,
/// which no enclosure tells. The eigenvalue zero is double with one vector.
#[test]
fn what_vanishes_there_vanishes_exactly() {
    let case = Case::new(
        r#"
coordinates = ["x", "y"]
[lagrangian]
T = "1/2 x'^2 + 1/2 y'^2"
V = "x^4/4 - x^2/2 - x + (x^3 - x - 1) y^2/2"
[steady.rest]
x = { guess = 1.3 }
y = 0
"x'" = 0
"y'" = 0
"#,
    );
    let plastic: f64 = 1.324_717_957_244_746_025_96;
    let pair = (3.0 * plastic * plastic - 1.0).sqrt();
    are_eigenvalues(
        &case.spectrum(case.named("rest")),
        &[(0.0, pair), (0.0, -pair)],
        1e-13,
    );
    let linear = case.linear(case.named("rest"), "").unwrap();
    let polynomial = Characteristic::of(&case.system.graph, &linear).unwrap();
    assert_eq!(polynomial.zeros + polynomial.further_zeros, 2);
    assert_eq!(case.said("stability.spectral", "rest"), "proved");
    assert_eq!(case.said("stability.linear", "rest"), "refuted");
}

/// The restricted three-body problem, Earth and Moon: the collinear points are zeros of quintics (Szebehely 1967, sec. 4.2); L1 at μ = 0.01215 with
/// its eigenvalues to 18 digits, from an independent computation with 40 digits.
const THREE_BODIES: &str = r#"
coordinates = ["x", "y"]
parameters = { mu = 0.01215 }
[lagrangian]
L = "1/2 (x'^2 + y'^2) + x y' - y x' + (x^2 + y^2)/2 + (1 - mu)/sqrt((x + mu)^2 + y^2) + mu/sqrt((x - 1 + mu)^2 + y^2)"
[steady.L1]
x = { guess = 0.84 }
y = 0
"x'" = 0
"y'" = 0
"#;

#[test]
fn the_collinear_point_between_two_bodies_is_unstable() {
    let case = Case::new(THREE_BODIES);
    are_eigenvalues(
        &case.spectrum(case.named("L1")),
        &[
            (-2.932_048_682_295_981_68, 0.0),
            (2.932_048_682_295_981_68, 0.0),
            (0.0, -2.334_381_315_836_003_37),
            (0.0, 2.334_381_315_836_003_37),
        ],
        1e-13,
    );
    for claim in ["asymptotic", "spectral", "linear", "nonlinear"] {
        let said = case.said(&format!("stability.{claim}"), "L1");
        assert_eq!(said, "refuted", "{claim}");
    }
}

/// The place itself, 0.836918007316930406, and the sign of the distance to the smaller body there.
#[test]
fn the_place_of_the_collinear_point_is_a_number() {
    let case = Case::new(THREE_BODIES);
    let (terms, selection) = (&case.prepared.terms, &case.prepared.selection);
    let values = case.system.parameter_values();
    let motion = &case.system.steady[0];
    let found = chetaev_stability::guess::near(&case.system, terms, selection, (motion, &values));
    let x = found.unwrap().positions[0].unwrap();
    let g = &case.system.graph;
    assert!((case.number(x, &[]) - 0.836_918_007_316_930_406).abs() < 1e-15);
    let distance = g.sub(x, case.read("0.98785"));
    assert_eq!(sign_of(g, distance), Some(Ordering::Less));
    let size = g.sqrt(g.powi(distance, 2));
    assert_eq!(sign_of(g, g.add(&[distance, size])), Some(Ordering::Equal));
}

/// x = 1.167… with y = 0.748…, a zero over a zero, is nearer to the guess than the origin, and has no exact form.
#[test]
fn a_guess_is_not_answered_for_a_motion_that_is_farther() {
    let case = Case::new(
        r#"
coordinates = ["x", "y"]
[lagrangian]
L = "1/2 (x'^2 + y'^2)"
[forces]
x = "x (x^5 - x - 1) - x'"
y = "x - y^3 - y - y'"
[steady.right]
x = { guess = 1.167 }
y = { guess = 0.75 }
"x'" = 0
"y'" = 0
[steady.origin]
x = { guess = 0.1 }
y = { guess = 0.1 }
"x'" = 0
"y'" = 0
"#,
    );
    for (motion, expected) in [("right", "undecided"), ("origin", "proved")] {
        let said = case.said("stability.asymptotic", motion);
        assert!(said.starts_with(expected), "{motion}: {said}");
    }
}

/// V' = sin θ − 2 cos 2θ vanishes at θ = 0.6348… with cos θ algebraic, where sin(acos(…)) is not seen to cancel: that is not decided, and no rate.
#[test]
fn a_rate_that_is_not_seen_to_vanish_is_open() {
    let case = Case::new(
        r#"
coordinates = ["th"]
[lagrangian]
L = "1/2 th'^2 + cos(th) + sin(2 th)"
[steady.a]
th = { guess = 0.7 }
"th'" = 0
"#,
    );
    let said = case.said("stability.spectral", "a");
    assert!(!said.contains("is not steady"), "{said}");
}

/// The energy y² + 3 x⁴ + (√(5 + 2√6) − √2 − √3) x²/2 has no quadratic term in x, as both numbers are the same: rest is proved stable by the term of
/// order 4, and no eigenvalue is right of the axis.
#[test]
fn a_stiffness_that_is_zero_by_no_form_is_zero() {
    let case = Case::new(
        r#"
coordinates = ["x", "y"]
lagrangian = "(x'^2 + y'^2)/2 - (sqrt(5 + 2 sqrt(6)) - sqrt(2) - sqrt(3)) x^2/2 - y^2 - 3 x^4"
[steady.s]
x = 0
y = 0
"x'" = 0
"y'" = 0
"#,
    );
    assert_eq!(case.said("stability.spectral", "s"), "proved");
    assert_eq!(case.said("stability.nonlinear", "s"), "proved");
    assert!(case.said("stability.linear", "s").starts_with("refuted"));
}
