//! Densities of invariant measures: where they are smooth, and what is said of them; expected values are worked out by hand.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "test code fails where it stands"
)]

use crate::common::{expr, finding, framed, system};
use chetaev_mechanics::System;

fn counted(system: &System) -> (&'static str, String) {
    let finding = finding(system, "liouville.integrable");
    (finding.verdict.word(), finding.verdict.detail().to_owned())
}

fn told(system: &System) -> (&'static str, String) {
    let finding = finding(system, "measure.invariant");
    (finding.verdict.word(), finding.verdict.detail().to_owned())
}

/// The mass matrix is `(1 + |x|)` times one: Liouville's density is the square of that, which vanishes nowhere.
#[test]
fn a_density_with_a_corner() {
    let own = system("x y", "(1 + abs(x))*(x'^2 + y'^2)/2", &[]);
    let (word, detail) = told(&own);
    assert_eq!(word, "proved", "{detail}");
    assert!(detail.contains("N = (1 + abs(x))^2;"), "{detail}");
    assert!(!detail.contains("do not determine"), "{detail}");
}

/// Where a density vanishes is said whatever the sign of what vanishes in the states sampled. These densities are the determinants of
/// the mass matrices, so the variables end there; 2 + cos x and 2 + x² have no zeros.
#[test]
fn all_zeros_of_a_density_are_told() {
    for (lagrangian, zeros) in [
        ("(x'^2 + cos(x)^2*y'^2)/2", &["cos(x)"][..]),
        ("(x'^2 + sin(x)^2*y'^2)/2", &["sin(x)"]),
        ("(x'^2 + (x - 1)^2*y'^2)/2", &["x - 1"]),
        ("(x'^2 + (x + 1)^2*y'^2)/2", &["1 + x"]),
        ("(x'^2 + (x^2 - 1)^2*y'^2)/2", &["1 + x", "x - 1"]),
        ("(x'^2 - y'^2 + x^2*y'^2)/2", &["1 + x", "x - 1"]),
        ("(1 + x)*x'^2/2", &["1 + x"]),
        ("(x'^2 + (x^2 - 2)^2*y'^2)/2", &["x^2 - 2"]),
        ("(1 - t)*x'^2/2", &["t - 1"]),
        ("(x'^2 + (1 + 2*cos(x))^2*y'^2)/2", &["1 + 2 cos(x)"]),
        ("(x'^2 + (2 + cos(x))^2*y'^2)/2", &[]),
        ("(x'^2 + (2 + x^2)^2*y'^2)/2", &[]),
    ] {
        let names = if lagrangian.contains('y') { "x y" } else { "x" };
        let (word, detail) = told(&system(names, lagrangian, &[]));
        assert_eq!(word, "proved", "{lagrangian}: {detail}");
        let equations: Vec<String> = zeros.iter().map(|e| format!("{e} = 0")).collect();
        let sentence = format!("; where {} these variables do not", equations.join(" or "));
        match zeros.is_empty() {
            true => assert!(!detail.contains(" = 0"), "{lagrangian}: {detail}"),
            false => assert!(detail.contains(&sentence), "{lagrangian}: {detail}"),
        }
    }
}

/// With a mass that vanishes somewhere and N = 1: nothing is zero or infinite of the density there.
#[test]
fn where_masses_vanish_a_density_does_not() {
    // m = 1 - x, as a force that takes back what the mass matrix adds: x'' = 0.
    let own = framed("x", "(1 - x)*x'^2/2", &[], &[], &[("x", "-x'^2/2")]);
    let (word, detail) = told(&own);
    assert_eq!(word, "proved", "{detail}");
    assert!(detail.contains("N = 1;"), "{detail}");
    assert!(!detail.contains("N is zero or infinite"), "{detail}");
    assert!(
        detail.contains("where x - 1 = 0 the mass matrices are singular"),
        "{detail}"
    );
}

/// `x'' = -x'^2/(2 + cos x)` keeps exp(2 F), with F' = 1/(2 + cos x), F = 2 atan(tan(x/2)/√3)/√3: on each branch of the tangent alone, at
/// the ends of which this formula jumps.
#[test]
fn formulas_that_jump_end_there() {
    let mut own = framed("x", "x'^2/2", &[], &[], &[("x", "-x'^2/(2 + cos(x))")]);
    own.search_functions
        .push(expr(&own.graph, "atan(tan(x/2)/sqrt(3))"));
    let (word, detail) = told(&own);
    assert_eq!(word, "proved", "{detail}");
    assert!(
        detail.contains("not where cos(x/2) = 0, as a function in N"),
        "{detail}"
    );
}

/// Where all velocities follow from the constraints there is no η; and what contains the time is a density beside dt.
#[test]
fn no_velocities_and_the_time_are_named() {
    let (word, detail) = told(&system(
        "x y",
        "(x'^2 + y'^2)/2",
        &[("a", "x' - 1"), ("b", "y' - y")],
    ));
    assert_eq!(word, "proved", "{detail}");
    assert!(
        detail.starts_with("N dq, where no velocities are independent, is"),
        "{detail}"
    );
    let own = framed("x", "x'^2/2 - x^2", &[], &[], &[("x", "cos(2*t) - c*x'")]);
    let (word, detail) = told(&own);
    assert_eq!(word, "proved", "{detail}");
    assert!(
        detail.starts_with("N dt dq dη,") && detail.contains("N = exp(c t)"),
        "{detail}"
    );
    assert!(detail.contains("N changes with the time only"), "{detail}");
}

/// A wheel on which a drag acts: `x = R a`, `m x'' = -c x'^2`. exp(2 c R a/m), up to the rolling inertia, does not return after a turn of the
/// wheel; exp(2 c x/m) is the same function along each motion, and returns.
#[test]
fn the_way_of_a_wheel_stands_for_its_angle() {
    let force = [("x", "-c*x'^2")];
    let mut wheel = framed("a x", "m*x'^2/2", &[("roll", "x' - R*a'")], &[], &force);
    wheel.angles.push("a".into());
    let (word, detail) = told(&wheel);
    assert_eq!(word, "proved", "{detail}");
    assert!(detail.contains("exp(2 c x/m)"), "{detail}");
}

/// An oscillator with the drag `x'^3` or `|x'| x'` ends at rest, with a negative one it leaves it: nothing is kept near rest. Without the
/// spring rest is anywhere, and 1/(1 - x x')^3 is kept near x = 0 where `x'' = -x'^3`; along `x'' = -x - x x'` the energy changes both ways.
#[test]
fn drag_of_any_power_leaves_no_density_at_rest() {
    for (lagrangian, force, word) in [
        ("x'^2/2 - x^2/2", "-x'^3", "refuted"),
        ("x'^2/2 - x^2/2", "x'^3", "refuted"),
        ("x'^2/2 + cos(x)", "-x'^5", "refuted"),
        ("x'^2/2 - x^2/2", "-abs(x')*x'", "refuted"),
        ("x'^2/2 - x^2/2", "-x^2*x'^3", "refuted"),
        ("x'^2/2", "-x'^3", "undecided"),
        ("x'^2/2 + x^2/2", "-x'^3", "undecided"),
        ("x'^2/2 - x^2/2", "-x*x'^3", "undecided"),
    ] {
        let own = framed("x", lagrangian, &[], &[], &[("x", force)]);
        let (found, detail) = told(&own);
        assert_eq!(found, word, "{lagrangian}, {force}: {detail}");
    }
}

/// `(x'^2 + y'^2)/2 - (x^2 + x y + y^2)` with a drag on x' alone: X̄E = -x'^4 vanishes on x' = 0, and only there.
#[test]
fn drag_on_one_velocity_suffices() {
    let lagrangian = "(x'^2 + y'^2)/2 - x^2 - x*y - y^2";
    let own = framed("x y", lagrangian, &[], &[], &[("x", "-x'^3")]);
    let (word, detail) = told(&own);
    assert_eq!(word, "refuted", "{detail}");
    assert!(detail.contains("strict minimum at rest"), "{detail}");
}

/// Liouville's density ∂²L/∂x'² of a relativistic point in one dimension, `(1 - x'²/c²)^(-3/2)`.
#[test]
fn one_base_is_written_once() {
    let (word, detail) = told(&system("x", "-c^2*sqrt(1 - x'^2/c^2) - x^2", &[]));
    assert_eq!(word, "proved", "{detail}");
    assert!(
        detail.contains("(-x'^2/c^2 + 1)^(-3/2)") || detail.contains("1/(-x'^2/c^2 + 1)^(3/2)"),
        "{detail}"
    );
}

/// The class of the constraints, where it is established, with the sources of the condition: the sleigh is a left-invariant system on the
/// plane's motions in velocities of the body, and one of Chaplygin's in those of space.
#[test]
fn classes_are_named_with_their_sources() {
    let kinetic = "((x' - a*phi'*sin(phi))^2 + (y' + a*phi'*cos(phi))^2 + phi'^2)/2";
    let blade = [("blade", "y'*cos(phi) - x'*sin(phi)")];
    let own = [("u", "x'*cos(phi) + y'*sin(phi)"), ("w", "phi'")];
    for (speeds, source) in [(&own[..], "Kozlov (1988)"), (&[], "Stanchenko (1989)")] {
        let (word, detail) = told(&framed("x y phi", kinetic, &blade, speeds, &[]));
        assert_eq!(word, "refuted", "{detail}");
        assert!(detail.contains(source), "{detail}");
    }
    let (_, detail) = told(&framed("x", "x'^2/2 - x^2", &[], &[], &[("x", "-x'")]));
    assert!(
        !detail.contains("Kozlov") && !detail.contains("Stanchenko"),
        "{detail}"
    );
}

/// The sleigh with its mass centre before the blade has the variables u, φ' of its body, and the energy: five less the three dimensions
/// of the motions of the plane. In x', y' the rates contain φ, and what is counted is the same. On a slope nothing turns, and a force
/// along x' turns with the velocities: the speed alone is left.
#[test]
fn turns_are_left_out_whatever_the_velocities() {
    let kinetic = "((x' - a*phi'*sin(phi))^2 + (y' + a*phi'*cos(phi))^2 + phi'^2)/2";
    let blade = [("blade", "y'*cos(phi) - x'*sin(phi)")];
    let (word, detail) = counted(&system("x y phi", kinetic, &blade));
    assert_eq!(word, "proved", "{detail}");
    let says = "2 variables after x, y and the turns of (x, y) with phi, under which the motion is symmetric, are left out, with 1 integral";
    assert!(detail.contains(says), "{detail}");
    let slope = format!("{kinetic} - g*x");
    let (_, detail) = counted(&system("x y phi", &slope, &blade));
    assert!(!detail.contains("turns"), "{detail}");
    let drag = "1 + x'^2 + y'^2 + exp(x'^2 + y'^2)";
    let forces = [
        ("x", format!("-x'*({drag})")),
        ("y", format!("-y'*({drag})")),
    ];
    let forces = forces.each_ref().map(|(q, force)| (*q, force.as_str()));
    let point = framed("x y", "(x'^2 + y'^2)/2", &[], &[], &forces);
    let (word, detail) = counted(&point);
    assert_eq!(word, "proved", "{detail}");
}

/// Two wheels on an axle of half length b with the mass centre before it: the same two variables, with the angles of the wheels left out.
#[test]
fn a_cart_on_two_wheels_has_two_variables() {
    let kinetic = "(m*((x' - a*phi'*sin(phi))^2 + (y' + a*phi'*cos(phi))^2) + J*phi'^2 + I*(p1'^2 + p2'^2))/2";
    let cart = system(
        "x y phi p1 p2",
        kinetic,
        &[
            ("blade", "y'*cos(phi) - x'*sin(phi)"),
            ("first", "x'*cos(phi) + y'*sin(phi) + b*phi' - R*p1'"),
            ("second", "x'*cos(phi) + y'*sin(phi) - b*phi' - R*p2'"),
        ],
    );
    let (word, detail) = counted(&cart);
    assert_eq!(word, "proved", "{detail}");
    assert!(
        detail.contains("2 variables after") && detail.contains("with phi"),
        "{detail}"
    );
}
