//! Constraints that are products, component by component, and ranks that depend on the signs of related roots; expected values are worked out by
//! hand.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "test code fails where it stands"
)]

use crate::common::{finding, system};
use chetaev_mechanics::System;
use chetaev_symbolic::Verdict;

const WEAK: &str = "model.constraints-integrable#weak";
const GROWTH: &str = "distribution.growth";

fn in_plane(constraints: &[(&str, &str)]) -> System {
    system("x y", "(x'^2 + y'^2)/2", constraints)
}

fn in_space(constraints: &[(&str, &str)]) -> System {
    system("x y z", "(x'^2 + y'^2 + z'^2)/2", constraints)
}

fn in_four(constraints: &[(&str, &str)]) -> System {
    system("x y z w", "(x'^2 + y'^2 + z'^2 + w'^2)/2", constraints)
}

fn verdict(own: &System, claim: &str) -> (&'static str, String) {
    let found = finding(own, claim);
    (found.verdict.word(), found.verdict.detail().to_owned())
}

/// Where no one velocity is determined on all components each is looked at by itself: x' y' = 0 keeps x on one and y on the other.
#[test]
fn each_component_is_decided() {
    let integrable = [
        in_plane(&[("a", "x'*y'")]),
        in_space(&[("a", "y'*(x' - 1)")]),
        in_space(&[("a", "(x' - y')*z'")]),
        in_space(&[("a", "x'*(z' - x*y')"), ("b", "x' + y' + z'")]),
    ];
    for own in integrable {
        let (word, detail) = verdict(&own, WEAK);
        assert_eq!(word, "proved", "{detail}");
    }
    let (_, detail) = verdict(&in_plane(&[("a", "x'*y'")]), WEAK);
    for said in ["on the component x' = 0: x", "on the component y' = 0: y"] {
        assert!(detail.contains(said), "{detail}");
    }
    let none = in_four(&[("a", "(x' - y*z')*(z' - y*w')")]);
    assert_eq!(verdict(&none, WEAK).0, "refuted");
}

/// The plane z' = 3x' + 4y' is integrable, the cone is not; written as a product or expanded, where no factor of degree one stands in
/// the first or the last coefficient. A cone times a cone is integrable nowhere.
#[test]
fn quadrics_and_planes_come_apart() {
    let cone = "(x'^2 + y'^2 - z'^2)*(z' - 3*x' - 4*y')";
    let expanded = "x'^2*z' - 3*x'^3 - 4*x'^2*y' + y'^2*z' - 3*x'*y'^2 - 4*y'^3 - z'^3 + 3*x'*z'^2 + 4*y'*z'^2";
    for f in [cone, expanded] {
        let found = finding(&in_space(&[("a", f)]), WEAK);
        let Verdict::Conditional { condition, .. } = &found.verdict else {
            panic!("{} {}", found.verdict.word(), found.verdict.detail());
        };
        assert!(condition.contains("3 x' + 4 y' - z' = 0"), "{condition}");
        assert!(!condition.contains("z'^2"), "{condition}");
        let detail = found.verdict.detail();
        assert!(detail.contains("z - 3 x - 4 y"), "{detail}");
    }
    let cones = "(x'^2 + y'^2 - z'^2)*(x'^2 + 2*y'^2 - z'^2)";
    let (word, detail) = verdict(&in_space(&[("a", cones)]), WEAK);
    assert_eq!(word, "refuted", "{detail}");
}

/// x' = 0 is integrable, z' = y w' is not: the product is so on the first component.
#[test]
fn integrable_on_one_component() {
    for own in [
        in_four(&[("a", "x'*(z' - y*w')")]),
        in_space(&[("a", "x'*(z' - x*y')")]),
    ] {
        let found = finding(&own, WEAK);
        match &found.verdict {
            Verdict::Conditional {
                condition,
                counterexample,
                ..
            } => {
                assert_eq!(condition, "x' = 0");
                assert!(counterexample.is_some());
            }
            other => panic!("{other:?}"),
        }
        let (word, detail) = verdict(&own, GROWTH);
        assert_eq!(word, "not-applicable", "{detail}");
        assert!(detail.contains("every configuration nearby"), "{detail}");
    }
}

/// With x' + y' = 0 the product (x' + y')(z' + 1) says nothing more, and (x' + y' + 1)(z' + 1) = 0 is z' = -1.
#[test]
fn what_is_no_component() {
    let within = in_space(&[("a", "x' + y'"), ("b", "(x' + y')*(z' + 1)")]);
    let (word, detail) = verdict(&within, WEAK);
    assert_eq!(word, "proved", "{detail}");
    assert!(!detail.contains("t + z"), "{detail}");
    let empty = in_space(&[("a", "x' + y'"), ("b", "(x' + y' + 1)*(z' + 1)")]);
    let (word, detail) = verdict(&empty, WEAK);
    assert_eq!(word, "proved", "{detail}");
    assert!(detail.contains("x + y, t + z"), "{detail}");
    assert!(!detail.contains("x' + y' + 1"), "{detail}");
}

/// √(3 - 2√2) = √2 - 1, √(x + 1 + 2√x) = √x + 1: what they multiply vanishes, and z - x is kept. Where it does not, everything is reached.
#[test]
fn roots_with_relations_prove_nothing_false() {
    for (factor, rest) in [
        ("sqrt(3 - 2*sqrt(2)) - sqrt(2) + 1", "x*y'"),
        ("sqrt(5 + 2*sqrt(6)) - sqrt(2) - sqrt(3)", "x*y'"),
        ("sqrt(x + 1 + 2*sqrt(x)) - sqrt(x) - 1", "y'"),
    ] {
        let own = in_space(&[("a", &format!("z' - ({factor})*{rest} - x'"))]);
        let (word, detail) = verdict(&own, GROWTH);
        assert_ne!(word, "proved", "{factor}: {detail}");
    }
    for factor in ["sqrt(3 - 2*sqrt(2)) - sqrt(2)", "sqrt(2) + sqrt(3)"] {
        let own = in_space(&[("a", &format!("z' - ({factor})*x*y' - x'"))]);
        let (word, detail) = verdict(&own, GROWTH);
        assert_eq!(word, "proved", "{factor}: {detail}");
    }
}

/// 1 + x'² vanishes nowhere: what is left is z' = y x', which is nonholonomic.
#[test]
fn factors_without_real_zeros_do_not_count() {
    let (word, detail) = verdict(&in_space(&[("a", "(z' - y*x')*(1 + x'^2)")]), WEAK);
    assert_eq!(word, "refuted", "{detail}");
    assert!(detail.contains("y x' - z' = 0"), "{detail}");
}
