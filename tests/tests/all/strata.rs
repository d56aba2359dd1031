//! One record speaks of one thing: components of constraints, values that a model states for parameters, and sides are looked at by
//! themselves, and every claim says of them together what is true. Right verdicts by hand.
#![allow(
    clippy::panic,
    clippy::unwrap_used,
    reason = "test code fails where it stands"
)]

use chetaev::symbolic::Verdict;
use chetaev_tests::runs::{ended_text, Ask, Ended};

/// A free particle of unit mass in space, V given, under one constraint.
fn particle(potential: &str, parameters: &str, constraint: &str) -> String {
    format!(
        "name = \"particle\"\ncoordinates = [\"x\", \"y\", \"z\"]\nassumptions = []\n[parameters]\n{parameters}\n[lagrangian]\n\
         T = \"1/2 (x'^2 + y'^2 + z'^2)\"\nV = \"{potential}\"\n[constraints]\nc = \"{constraint}\"\n"
    )
}

fn decided(text: &str) -> Ended {
    let ask = Ask {
        claims: vec!["model", "formulations", "principles", "integrals"],
        ..Ask::default()
    };
    ended_text(text, &ask)
}

/// The word, with the condition where there is one.
fn said(ended: &Ended, claim: &str) -> String {
    match ended.verdict(claim) {
        Verdict::Conditional { condition, .. } => condition.clone(),
        other => other.word().to_owned(),
    }
}

fn check(text: &str, expected: &[(&str, &str)]) {
    let ended = decided(text);
    for (claim, right) in expected {
        let detail = ended.verdict(claim).detail().to_owned();
        assert_eq!(&said(&ended, claim), right, "{claim}: {detail}");
    }
}

/// Under z' = y x' + k x y' Frobenius' condition is (1 - k) = 0. With V = 0 the reaction is λ = (1 + k) x' y'/(1 + y² + k² x²), and the
/// action is stationary where (k² - 1) x' y'² vanishes; the two mixed derivatives of ln N differ by a multiple of k (k² - 1).
const PARTICULAR: &str = "z' = y x' + k x y'";

#[test]
fn a_stated_value_that_is_exceptional_is_so_for_every_claim() {
    check(
        &particle("0", "k = 1", PARTICULAR),
        &[
            ("model.constraints-integrable#weak", "k = 1"),
            ("model.constraints-integrable#strong", "k = 1"),
            ("distribution.growth", "k ≠ 1"),
            ("formulation.vakonomic-coincides#system", "k = 1"),
            ("hamilton.stationary", "k = 1, or x' = 0 or y' = 0"),
            ("hamilton.kerner", "proved"),
            ("variation.suslov", "proved"),
            ("chaplygin.multiplier", "k = 1, or k = -1, or k = 0"),
            ("measure.invariant", "k = 1"),
        ],
    );
}

#[test]
fn what_both_say_is_said_of_both() {
    let ended = decided(&particle("0", "k = 1", PARTICULAR));
    for claim in ["hamilton.kerner", "variation.suslov"] {
        let detail = ended.verdict(claim).detail();
        let (stated, general) = detail
            .split_once("for general values of the parameters: ")
            .unwrap();
        assert!(
            stated.starts_with("for k = 1, as the model states: "),
            "{detail}"
        );
        assert!(
            stated.contains("A = 0") && general.contains("A ≠ 0"),
            "{detail}"
        );
    }
}

/// At k = -1, stated, the reaction vanishes: the action is stationary and N exists, but the constraint is not integrable.
#[test]
fn another_value_is_exceptional_for_other_claims() {
    check(
        &particle("0", "k = -1", PARTICULAR),
        &[
            ("model.constraints-integrable#weak", "refuted"),
            ("distribution.growth", "proved"),
            ("formulation.vakonomic-coincides#system", "refuted"),
            (
                "formulation.vakonomic-coincides#inclusion",
                "k = -1, or k = 1",
            ),
            (
                "hamilton.stationary",
                "k = -1, or k = 1, or x' = 0 or y' = 0",
            ),
            ("chaplygin.multiplier", "k = -1, or k = 1, or k = 0"),
        ],
    );
}

/// At k = 2 nothing is particular: what is refuted is refuted at a state with k = 2.
#[test]
fn counterexamples_have_the_values_that_are_stated() {
    let ended = decided(&particle("0", "k = 2", PARTICULAR));
    for claim in [
        "chaplygin.multiplier",
        "formulation.vakonomic-coincides#inclusion",
    ] {
        let Verdict::Refuted(found) = ended.verdict(claim) else {
            panic!("{claim}: {}", ended.verdict(claim).detail())
        };
        let k = found.point.iter().find(|value| value.name == "k").unwrap();
        assert_eq!(k.exact.as_ref().unwrap().to_string(), "2", "{claim}");
    }
}

/// z' = a y x' + b x y' is integrable exactly where a = b, whatever the values are; with V = 0 the action is stationary where
/// (a² - b²) x' y'² vanishes. Where a sum is exceptional, this is said of the sum.
#[test]
fn values_that_are_exceptional_together() {
    check(
        &particle("0", "a = 3\nb = 3", "z' = a y x' + b x y'"),
        &[
            ("model.constraints-integrable#weak", "a = b"),
            ("model.constraints-integrable#strong", "a = b"),
            ("distribution.growth", "a ≠ b"),
            ("hamilton.stationary", "a = b, or x' = 0 or y' = 0"),
        ],
    );
    check(
        &particle("0", "a = 3\nb = 4", "z' = a y x' + b x y'"),
        &[
            ("model.constraints-integrable#weak", "refuted"),
            ("distribution.growth", "proved"),
        ],
    );
    check(
        &particle("0", "a = 5\nb = 2\nc = 3", "z' = a y x' + (b + c) x y'"),
        &[("model.constraints-integrable#weak", "a = b + c")],
    );
}

/// A parameter that is stated to be zero is zero for the claims about the functions, too: z' = y x' + b with b = 0 is homogeneous.
#[test]
fn what_is_stated_to_be_zero_is_zero_for_all() {
    let text = |b: u32| particle("0", &format!("b = {b}"), "z' = y x' + b");
    let expected = |homogeneous| {
        [
            ("model.constraints-homogeneous", homogeneous),
            ("energy.integral", homogeneous),
        ]
    };
    check(&text(0), &expected("proved"));
    check(&text(2), &expected("refuted"));
}

/// z'² = y² x'² is z' = y x' or z' = -y x', of which the same is true; (z' - x')(z' - y x') = 0 is integrable on one component alone.
#[test]
fn components_are_told_together() {
    check(
        &particle("0", "", "z'^2 = y^2 x'^2"),
        &[
            ("hamilton.hoelder", "proved"),
            ("hamilton.kerner", "proved"),
            ("energy.integral", "proved"),
            ("hamilton.stationary", "x' = 0 or y' = 0"),
            ("chaplygin.multiplier", "proved"),
            ("second-kind.identity", "proved"),
        ],
    );
    check(
        &particle("0", "", "(z' - x') (z' - y x') = 0"),
        &[
            ("hamilton.hoelder", "proved"),
            ("hamilton.stationary", "x' - z' = 0, or x' = 0 or y' = 0"),
            ("formulation.vakonomic-coincides#inclusion", "x' - z' = 0"),
            ("formulation.vakonomic-coincides#system", "x' - z' = 0"),
        ],
    );
}

/// Two planes, (z - x)(z + 2 x) = 0 with V = z: on both the energy and y' are kept, of x' + t/2 and 5 x' - 2 t one on each.
#[test]
fn integrals_on_planes_that_cross() {
    let text = particle("z", "", "(z - x) (z + 2 x) = 0")
        + "[integrals]\nu = \"2 x' + t\"\nw = \"y'\"\nv = \"5 x' - 2 t\"\n";
    let ended = decided(&text);
    for (claim, right) in [
        ("energy.integral", "proved"),
        ("hamilton.stationary", "proved"),
        ("noether.inverse#w", "proved"),
    ] {
        assert_eq!(said(&ended, claim), right, "{claim}");
    }
    for (name, component) in [("u", "x - z = 0"), ("v", "2 x + z = 0")] {
        let own = said(&ended, &format!("noether.inverse#{name}"));
        assert_eq!(own, component, "{name}");
    }
}

/// Three lines through one point, x y (x - y) = 0: each motion keeps the energy and both components of its velocity.
#[test]
fn three_lines_that_cross() {
    let text = "name = \"lines\"\ncoordinates = [\"x\", \"y\"]\n[lagrangian]\nT = \"1/2 (x'^2 + y'^2)\"\nV = \"0\"\n\
        [constraints]\nc = \"x y (x - y) = 0\"\n[integrals]\na = \"x'\"\nb = \"y'\"\n";
    let expected = [
        ("hamilton.stationary", "proved"),
        ("hamilton.kerner", "proved"),
        ("energy.integral", "proved"),
        ("noether.inverse#a", "proved"),
        ("noether.inverse#b", "proved"),
        ("noether.embedded", "proved"),
    ];
    check(text, &expected);
}

/// log z' = log x' + log y is z' = y x' where all three are positive: y' = 0, as x' = 0 is excluded.
#[test]
fn logarithms_of_velocities_are_products() {
    let text = particle("0", "", "log(z') = log(x') + log(y)");
    let text = text.replace("assumptions = []", "assumptions = [\"y > 0\"]");
    let expected = [
        ("hamilton.stationary", "y' = 0"),
        ("hamilton.kerner", "proved"),
        ("hamilton.endpoints", "proved"),
        ("measure.invariant", "proved"),
        ("liouville.integrable", "proved"),
        ("formulation.vakonomic-coincides#inclusion", "refuted"),
    ];
    check(&text, &expected);
}

/// On the cone z'² = x'² + x' y' + y'² with V = z, along x' = y' and x' = -y'. The speeds of constant kinetic energy in the field
/// 2 x, 1 satisfy Suslov's condition nowhere, as the straight fall with x' = 0 is where the dependent velocity has a pole.
#[test]
fn conditions_are_short_and_not_empty() {
    let cone = particle("z", "", "z'^2 = x'^2 + x' y' + y'^2");
    check(&cone, &[("hamilton.stationary", "y' = x' or y' = -x'")]);
    let thermostat = "name = \"thermostat\"\ncoordinates = [\"x\", \"y\"]\n[lagrangian]\nT = \"1/2 (x'^2 + y'^2)\"\nV = \"x^2 + y\"\n\
        [constraints]\nc = \"x'^2 + y'^2 = 4\"\n";
    check(thermostat, &[("hamilton.stationary-suslov", "refuted")]);
}

/// L = x'²/2 + y'²/2 + x'³/6 with y' = x x': the form is (1 + x' + x²) δx², negative at x = 0, x' = -2.
#[test]
fn a_form_that_is_negative_at_fast_states() {
    let text = "name = \"cubic\"\ncoordinates = [\"x\", \"y\"]\n[lagrangian]\nL = \"x'^2/2 + y'^2/2 + x'^3/6\"\n\
        [constraints]\nc = \"y' = x x'\"\n";
    check(text, &[("formulation.gauss-least", "refuted")]);
}

/// cos y z' = sin y y' is z + log cos y = const: the speed u_y = y'/cos y by which it is looked at carries its definition, and the method
/// of Hamilton and Jacobi applies.
#[test]
fn a_speed_of_our_own_is_what_it_is_defined_to_be() {
    let text = "name = \"curve\"\ncoordinates = [\"y\", \"z\"]\n[lagrangian]\nT = \"1/2 (y'^2 + z'^2)\"\nV = \"z\"\n\
        [constraints]\nc = \"cos(y) z' = sin(y) y'\"\n";
    check(
        text,
        &[
            ("hamilton.stationary", "proved"),
            ("hamilton-jacobi.applicable", "proved"),
        ],
    );
}
