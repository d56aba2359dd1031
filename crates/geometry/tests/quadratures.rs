//! Quadratures, growth and measures where the form of the equations misleads; expected values are worked out by hand.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "test code fails where it stands"
)]

mod common;

use chetaev_mechanics::System;
use common::{finding, framed, system};

fn word(system: &System, claim: &str) -> (&'static str, String) {
    let finding = finding(system, claim);
    (finding.verdict.word(), finding.verdict.detail().to_owned())
}

/// `y' = y² + x` with x'' determined by it: Riccati's equation is no quadrature.
#[test]
fn riccati_is_no_quadrature() {
    for (lagrangian, constraint) in [
        ("(x'^2 + y'^2)/2", "y' - y^2 - x"),
        ("x'^2/2", "y' - (y^2 + x)*x'"),
    ] {
        let own = system("x y", lagrangian, &[("f", constraint)]);
        let (found, detail) = word(&own, "liouville.integrable");
        assert_ne!(found, "proved", "{constraint}: {detail}");
    }
}

/// Three sheets that attract each other: which way they are pulled depends on where they are, although the derivative of that
/// vanishes almost everywhere.
#[test]
fn what_jumps_depends_on_what_it_jumps_with() {
    let sheets = system(
        "x1 x2 x3",
        "(x1'^2 + x2'^2 + x3'^2)/2 - abs(x1 - x2) - abs(x1 - x3) - abs(x2 - x3)",
        &[],
    );
    let (found, detail) = word(&sheets, "liouville.integrable");
    assert_ne!(found, "proved", "{detail}");
    let one = system("x", "x'^2/2 - abs(x)", &[]);
    let (found, detail) = word(&one, "liouville.integrable");
    // The energy, and no coordinate is left out.
    assert_eq!(found, "proved", "{detail}");
    assert!(detail.contains("2 variables"), "{detail}");
}

/// `exp(c t)` cancels in the motion, of three variables; and a velocity that keeps its value is an integral.
#[test]
fn variables_are_those_of_the_motion() {
    let damped = system("x", "exp(c*t)*(x'^2/2 + cos(x))", &[]);
    let (_, detail) = word(&damped, "liouville.integrable");
    assert!(detail.contains("2 variables"), "{detail}");
    let falling = system(
        "x y z",
        "(x'^2 + y'^2 + z'^2)/2 - z",
        &[("f", "x'*y - y'*x")],
    );
    let (found, detail) = word(&falling, "liouville.integrable");
    assert_eq!(found, "proved", "{detail}");
}

/// `y' = t x'`: at each time one direction, but ∫u and ∫t u are independent; `z' = x` drifts with x. `y' = 1` keeps y - t.
#[test]
fn drift_adds_directions() {
    for (constraint, expected) in [
        ("y' - t*x'", "proved"),
        ("y' - x", "proved"),
        ("y' - 1", "refuted"),
        ("y' - 2*x'", "refuted"),
        ("y' - t", "refuted"),
    ] {
        let own = system("x y", "(x'^2 + y'^2)/2", &[("f", constraint)]);
        let (found, detail) = word(&own, "distribution.growth");
        assert_eq!(found, expected, "{constraint}: {detail}");
    }
}

/// `x'' = -a x'² cos² x` keeps exp(a (x + sin x cos x)) dx dx', which does not return after a turn of an angle x.
#[test]
fn densities_return_after_a_turn() {
    let damped = || framed("x", "x'^2/2", &[], &[], &[("x", "-a*x'^2*cos(x)^2")]);
    let mut turning = damped();
    turning.angles.push("x".into());
    let (found, detail) = word(&turning, "measure.invariant");
    assert_eq!(found, "refuted", "{detail}");
    assert!(detail.contains("does not return after a turn"), "{detail}");
    // dx'/dx = -a x' cos² x is solved by a quadrature all the same.
    let (found, detail) = word(&turning, "liouville.integrable");
    assert_eq!(found, "proved", "{detail}");
    let (found, detail) = word(&damped(), "measure.invariant");
    assert_eq!(found, "proved", "{detail}");
    // cos x has no mean: exp(a sin x) returns.
    let mut returning = framed("x", "x'^2/2", &[], &[], &[("x", "-a*x'^2*cos(x)")]);
    returning.angles.push("x".into());
    let (found, detail) = word(&returning, "measure.invariant");
    assert_ne!(found, "refuted", "{detail}");
}

/// A damped oscillator beside a free coordinate y: with the time the variables x, x', y', t keep exp(c t) dt dx dx' dy', y' and
/// exp(c t) (x'² + c x x' + x²), two of the four less two; without it a single integral is left and no measure.
#[test]
fn densities_that_change_with_the_time_serve_where_the_time_is_a_variable() {
    let damped = system("x y", "exp(c*t)*(x'^2 - x^2)/2 + y'^2/2", &[]);
    let (found, detail) = word(&damped, "liouville.integrable");
    assert_eq!(found, "proved", "{detail}");
    assert!(detail.contains("N dt dq dη"), "{detail}");
}
