//! Constraints that are repeated, hidden, transcendental or definite, and what must be said of them.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    reason = "test code fails where it stands"
)]

use chetaev_tests::runs::{ended_text, Ask, Ended};

fn study(constraints: &[&str], rest: &str) -> Ended {
    let text = format!(
        "coordinates = [\"x\", \"y\", \"z\"]\nlagrangian = \"(x'^2 + y'^2 + z'^2)/2\"\nconstraints = {constraints:?}\n{rest}"
    );
    ended_text(&text, &Ask::default())
}

fn verdict(ended: &Ended, claim: &str) -> &'static str {
    ended.verdict(claim).word()
}

fn refused(ended: &Ended, words: &[&str]) {
    assert!(ended.study.is_none(), "accepted");
    for word in words {
        assert!(ended.text.contains(word), "no `{word}` in: {}", ended.text);
    }
}

/// Where z' = y x' the gradient of the whole vanishes: nothing could be claimed on that component.
#[test]
fn a_repeated_factor_is_refused() {
    for (constraint, power) in [
        ("(z' - y x')^2 (x' - y') = 0", "square"),
        ("(z' - y x')^3 (x' - y') = 0", "cube"),
        ("a (z' - y x')^2 = 0", "square"),
        ("(x - y)^2 = 0", "square"),
        // Functions at their largest or least values: 1 - cos u = 2 sin^2(u/2), cosh u - 1 = 2 sinh^2(u/2).
        ("cosh(z' - y x') = 1", "square of sinh"),
        ("exp(cos(z' - y x') - 1) = 1", "square of sin"),
        ("2 cos(z' - y x') = -2", "square of cos"),
        ("sin(x - y) = 1", "square of sin"),
        ("exp((z' - y x')^2) = 1", "square of"),
    ] {
        let ended = study(&[constraint], "parameters = [\"a\"]\n");
        refused(&ended, &[power, "gradient"]);
    }
    // Different factors, and a square beside another term, are no repetition.
    for constraint in [
        "(z' - y x') (z' + y x') = 0",
        "(z' - y x')^2 = x'^2 + y'^2",
        "2 cos(z' - y x') = 1",
    ] {
        let ended = study(&[constraint], "parameters = [\"a\"]\n");
        let found = verdict(&ended, "model.constraints-independent");
        assert_eq!(found, "proved", "{constraint}");
    }
}

/// The only real velocities of a definite form are zero, and so is its gradient there, though not at complex ones: what has the same states is
/// x' = 0, y' = 0.
#[test]
fn a_definite_form_leaves_no_regular_velocity() {
    let forms = [
        ("a (x'^2 + y'^2) = 0", "parameters = [\"a\"]\n"),
        ("exp(x'^2 + y'^2) = 1", ""),
    ];
    for (form, rest) in forms {
        let ended = study(&[form], rest);
        assert_eq!(verdict(&ended, "model.constraints-independent"), "refuted");
        assert_eq!(
            verdict(&ended, "formulation.equivalent#maggi"),
            "not-applicable"
        );
        assert!(ended.text.contains("x' = 0, y' = 0"), "{}", ended.text);
    }
}

/// x' = y and x = t demand y = 1, which nobody stated: simpler constraints say so, and multipliers determine no motion.
#[test]
fn a_hidden_condition_is_no_redundancy() {
    let start = "[initial]\ny = 1\n\"y'\" = 1\n";
    let ended = study(&["x' = y", "x = t"], start);
    assert_eq!(verdict(&ended, "model.constraints-independent"), "refuted");
    assert_eq!(
        verdict(&ended, "formulation.equivalent#maggi"),
        "not-applicable"
    );
    assert!(ended.text.contains("y - 1 = 0"), "{}", ended.text);
    let start = "[initial]\nx = 1\ny = 0\n";
    let ended = study(&["x' = y", "y' = x", "x^2 + y^2 = 1"], start);
    refused(&ended, &["`3`"]);
    // The same condition stated twice is one.
    let ended = study(&["x' = y", "2 x' = 2 y"], start);
    assert_eq!(verdict(&ended, "model.constraints-independent"), "refuted");
    assert_eq!(verdict(&ended, "motion.constraint-drift"), "numerical");
}

/// z = t contains the time although its derivative z' = 1 does not.
#[test]
fn a_holonomic_constraint_contains_the_time_that_it_states() {
    let ended = study(&["z = t"], "");
    let found = verdict(&ended, "model.constraints-scleronomic");
    assert_eq!(found, "refuted");
    let ended = study(&["z = x"], "");
    let found = verdict(&ended, "model.constraints-scleronomic");
    assert_eq!(found, "proved");
}

/// Linearity is asked where the function is defined, which need not be at rest.
#[test]
fn linearity_of_what_has_no_value_at_rest() {
    let start = "[initial]\nz = 1\n\"y'\" = 1\n";
    for constraint in [
        "x'/y' = z",
        "z' = x'^2/y' + y'",
        "atan2(y', x') = z",
        "(x' - z y')/sqrt(x'^2 + y'^2) = 0",
    ] {
        let found = verdict(&study(&[constraint], start), "model.constraints-linear");
        assert_eq!(found, "refuted", "{constraint}");
    }
    // (x'² − y'²)/(x' + y') is x' − y'.
    let ended = study(
        &["(x'^2 - y'^2)/(x' + y') = z"],
        "[initial]\nz = 1\n\"y'\" = 1\n",
    );
    assert_eq!(verdict(&ended, "model.constraints-linear"), "proved");
}

/// No point of a prime field satisfies a transcendental constraint; a real one decides.
#[test]
fn transcendental_constraints_are_independent() {
    for constraint in [
        "exp(x' - y') = 1",
        "sin(z' - y x') = 0",
        "z' = exp(y x') - 1",
    ] {
        let ended = study(&[constraint], "");
        for claim in [
            "model.constraints-independent",
            "model.accelerations-unique",
        ] {
            assert_eq!(verdict(&ended, claim), "proved", "{constraint} {claim}");
        }
    }
}

/// Of any order: linear in the highest derivatives, with or without the time.
#[test]
fn constraints_of_higher_order_are_classified() {
    for (constraint, linear, scleronomic) in [
        ("x'' = -y'^2", "proved", "proved"),
        ("x''^2 + y''^2 = 1", "refuted", "proved"),
        ("x''' = t y''^2", "proved", "refuted"),
    ] {
        let ended = study(&[constraint], "");
        assert_eq!(verdict(&ended, "model.constraints-linear"), linear);
        let found = verdict(&ended, "model.constraints-scleronomic");
        assert_eq!(found, scleronomic, "{constraint}");
    }
}

/// A constraint that vanishes as one term, such as sin(u) = 0, is judged by what its argument is made of.
#[test]
fn the_drift_of_composed_constraints_has_a_size() {
    let start = "[initial]\nx = 1\n\"x'\" = 1\n\"y'\" = 1\n";
    for constraint in [
        "log(x'/y') = 0",
        "sin(z' - y x') = 0",
        "atan(z' - y x') = 0",
        "x + y + z = 3",
    ] {
        let ended = study(&[constraint], start);
        assert_eq!(
            verdict(&ended, "motion.constraint-drift"),
            "numerical",
            "{constraint}"
        );
    }
}

/// A velocity that nobody gave is searched for where the constraint has no slope, or no value, with zero in its place.
#[test]
fn velocities_are_completed_where_zero_is_singular() {
    let start = "[initial]\ny = 2\n\"x'\" = 1\n\"y'\" = 1\n[simulation]\nt_end = 0.1\n";
    for (constraint, expected) in [
        ("sqrt(z') = y x'", 4.0),
        ("x'/z' = y", 0.5),
        ("log(z') = y - 2", 1.0),
    ] {
        let ended = study(&[constraint], start);
        let (_, found) = ended.text.split_once("z' = ").expect(&ended.text);
        let found: f64 = found.lines().next().unwrap().parse().unwrap();
        let error: f64 = found - expected;
        assert!(error.abs() < 1e-12, "{constraint}: {}", ended.text);
        assert_eq!(verdict(&ended, "motion.constraint-drift"), "numerical");
    }
    // What is singular whatever it is remains an error.
    refused(&study(&["sqrt(x) z' = x'"], start), &["singular"]);
    let rest = format!("{start}[expect]\n").replace("y = 2\n", "y = 2\n\"z'\" = 0\n");
    refused(&study(&["sqrt(z') = y x'"], &rest), &["singular"]);
}
