//! Parametric constraints f(q, v, t, u) = 0 with controls u(t), held in every variation (δu = 0): T1 §1 and capability C3 with
//! Rumyantsev's parametric constraints. Expected values are worked out by hand in the comments.

#![allow(clippy::unwrap_used)] // a panic is how a test fails

use crate::common::{expr, finding, with_context};
use chetaev_mechanics::{System, SystemParts};
use chetaev_principles::variations::Displacements;
use chetaev_symbolic::{Expr, Graph, Verdict};
use std::sync::Arc;

/// A particle with one constraint, which contains controls; `None` as a law leaves u(t) any function.
fn controlled(constraint: &str, controls: &[(&str, Option<&str>)]) -> System {
    let graph = Arc::new(Graph::new());
    let parts = SystemParts {
        name: "controlled".into(),
        coordinates: ["x", "y", "z"].map(String::from).to_vec(),
        lagrangian: Some(expr(&graph, "1/2 (x'^2 + y'^2 + z'^2)")),
        constraints: vec![("c".into(), expr(&graph, constraint))],
        controls: controls
            .iter()
            .map(|(name, law)| (name.to_string(), law.map(|law| expr(&graph, law))))
            .collect(),
        ..SystemParts::default()
    };
    System::new(graph, parts).unwrap()
}

#[track_caller]
fn word(system: &System, id: &str, expected: &str) -> String {
    let found = finding(system, id);
    let detail = found.verdict.detail().to_string();
    assert_eq!(found.verdict.word(), expected, "{id}: {detail}");
    detail
}

#[track_caller]
fn equal(system: &System, found: Expr, expected: &str) {
    let g = &system.graph;
    let difference = [g.sub(found, expr(g, expected))];
    with_context(system, |cx| {
        let free = Default::default();
        let verdict = cx.prover.identity(system, &difference, &free, "");
        assert_eq!(verdict.word(), "proved", "{} is {expected}", g.text(found));
    });
}

/// z' = u y x' with any u(t): A_x = D(u y) = u' y + u y', A_y = −u x'; u is not varied, but D moves it.
#[test]
fn curvature_with_the_control_held() {
    let system = controlled("z' - u y x'", &[("u", None)]);
    with_context(&system, |cx| {
        let d = Displacements::new(cx).unwrap();
        let names: Vec<&str> = d
            .chart
            .independent
            .iter()
            .map(|&i| cx.system.coordinates[i].name.as_str())
            .collect();
        assert_eq!(names, ["x", "y"]);
        let curvature = d.curvature();
        equal(&system, curvature[0][0], "u' y + u y'");
        equal(&system, curvature[0][1], "-u x'");
        // Hölder's rule: δf = Σ A δq, with no term in δu.
        let varied = d.of_constraints(cx);
        equal(&system, varied[0][0], "u' y + u y'");
        equal(&system, varied[0][1], "-u x'");
    });
    word(&system, "variation.hoelder", "conditional");
    word(&system, "variation.suslov", "proved");
}

/// Every Hölder form holds with a control, whether its law is stated or not, and constraints that are affine by it.
#[test]
fn the_forms_hold_with_controls() {
    let rate = |law| controlled("z' - u y x' - w", &[("u", law), ("w", Some("cos(3 t)"))]);
    for system in [rate(None), rate(Some("1 + t^2")), rate(Some("sin(t)"))] {
        for id in [
            "hamilton.hoelder",
            "hamilton.voronets",
            "hamilton.suslov",
            "hamilton.helmholtz-poincare",
            "hamilton.central-identity",
            "hamilton.forms-equivalent",
            "action.identity",
            "second-kind.integral#half-fixed",
            "universal-relation#suslov",
        ] {
            word(&system, id, "proved");
        }
    }
}

/// H changes by the control alone where f is affine by it: D H = w λ, with (1 + u² y²) λ = (u' y + u y') x' + w'; a homogeneous f
/// with a control keeps H, as v·f_v = 0 (T1 (17) allows explicit time).
#[test]
fn energy_with_controls() {
    let homogeneous = controlled("z' - u y x'", &[("u", None)]);
    word(&homogeneous, "energy.integral", "proved");
    let moved = controlled("z' - u y x' - w", &[("u", None), ("w", None)]);
    let found = finding(&moved, "energy.integral");
    assert_eq!(
        found.verdict.word(),
        "refuted",
        "{}",
        found.verdict.detail()
    );
    with_context(&moved, |cx| {
        let routh = chetaev_mechanics::claims::formulation::derive(cx, "routh").unwrap();
        let rate = chetaev_principles::energy::energy_rate(&moved, &routh.accelerations);
        let g = &moved.graph;
        let on_set = [(expr(g, "z'"), expr(g, "u y x' + w"))];
        let expected = "w ((u' y + u y') x' + w')/(1 + u^2 y^2)";
        equal(&moved, g.substitute(rate, &on_set), expected);
    });
}

/// T1 (12), (13): κ (u' y + u y') = 0 and κ u x' = 0, so κ = 0 and λ = 0 is demanded: (u' y + u y') x' = 0. With any u(t) that leaves
/// x' = 0, which the motion keeps (x'' = −λ u y), or y = 0 with y' = 0. With u constant y' = 0 serves for every y: a control is no constant.
#[test]
fn stationary_motions_with_a_control() {
    let any = controlled("z' - u y x'", &[("u", None)]);
    let detail = word(&any, "hamilton.stationary", "conditional");
    assert!(
        detail.contains("only where x' = 0, or y' = 0 and y = 0"),
        "{detail}"
    );
    let constant = controlled("z' - 2 y x'", &[]);
    let detail = word(&constant, "hamilton.stationary", "conditional");
    assert!(detail.contains("only where x' = 0 or y' = 0"), "{detail}");
    // Integrable for every u: z' = u (x y' + y x') is not, as u' (x y) is left; u(t) beside an exact form of the time is.
    let held = controlled("z' - u' x - u x'", &[("u", None)]);
    word(&held, "variation.hoelder", "proved");
    word(&held, "hamilton.stationary", "proved");
    let turning = controlled("z' - u (x y' + y x')", &[("u", None)]);
    word(&turning, "variation.hoelder", "conditional");
}

/// z' = u x' is integrable for u' = 0 and stationary then, and for no other u(t): what is said to be all there is, is so for general u(t).
/// z' = y x' + u has y'' = 0 for x' = 0 with every u, and more motions for u = 0, which is S4: x' = 0, or y' = 0.
#[test]
fn particular_functions_may_admit_more() {
    const GENERAL: &str = "for general u(t) (particular ones";
    let turning = controlled("z' - u x'", &[("u", None)]);
    for (id, expected) in [
        ("hamilton.stationary", "conditional"),
        ("hamilton.kerner", "proved"),
        ("variation.hoelder", "conditional"),
    ] {
        let detail = word(&turning, id, expected);
        assert!(detail.contains(GENERAL), "{id}: {detail}");
    }
    let drifting = controlled("z' - y x' - u", &[("u", None)]);
    let found = finding(&drifting, "hamilton.stationary");
    let Verdict::Conditional { condition, .. } = &found.verdict else {
        panic!("{}", found.verdict.detail())
    };
    assert!(condition.contains(GENERAL), "{condition}");
    // What holds with every u(t) is not restricted, nor what is said of a system without controls.
    let held = controlled("z' - u' x - u x'", &[("u", None)]);
    let detail = word(&held, "hamilton.stationary", "proved");
    assert!(!detail.contains("general"), "{detail}");
    let detail = word(
        &controlled("z' - y x'", &[]),
        "hamilton.stationary",
        "conditional",
    );
    assert!(!detail.contains("general u"), "{detail}");
}
