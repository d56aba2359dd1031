//! Principles of the second, first and intermediate kind: the checks of T1 §7, exact.

#![allow(clippy::unwrap_used)] // a panic is how a test fails

use crate::common::worked::{text, CONE, DISC, INTEGRABLE, PARTICLE, SKATE};
use crate::common::{expr, finding, system, with_context, Text};
use chetaev_mechanics::system::VariationOperator;
use chetaev_mechanics::{System, SystemParts};
use chetaev_principles::second_kind::{Ends, StateCurve};
use chetaev_principles::universal_relation::{bare_principle, operator, Operator};
use chetaev_symbolic::{Graph, Verdict};
use std::sync::Arc;

const CLAIMS: [&str; 12] = [
    "second-kind.differential",
    "second-kind.identity",
    "second-kind.integral#free",
    "second-kind.integral#half-fixed",
    "second-kind.integral#fixed",
    "second-kind.canonical#free",
    "second-kind.canonical#half-fixed",
    "second-kind.canonical#fixed",
    "universal-relation#zero",
    "universal-relation#hoelder",
    "universal-relation#suslov",
    "universal-relation#vujanovic",
];

#[track_caller]
fn assert_all(stated: &Text) {
    let system = system(stated);
    for id in CLAIMS {
        let found = finding(&system, id);
        assert_eq!(
            found.verdict.word(),
            "proved",
            "{id}: {}",
            found.verdict.detail()
        );
    }
}

#[test]
fn every_principle_gives_the_motion() {
    for stated in [&SKATE, &DISC, &CONE, &PARTICLE, &INTEGRABLE] {
        assert_all(stated);
    }
    let particle = "m/2 (x'^2 + y'^2 + z'^2) - m g z";
    for stated in [
        text("x y z", particle, &[("c", "z' - y x' - b")]),
        text("x y z", particle, &[("c", "z' - y x' - t y'")]),
        text("x y z", particle, &[("c", "z'^3 + z' - x' y'")]),
        text("q", "m/2 q'^2 - V cos(q) t", &[]),
        text("r s", "1/2 (r'^2 + r^2 s'^2) + r s'", &[]),
    ] {
        assert_all(&stated);
    }
    let forced = Text {
        forces: &[("x", "-k x'"), ("z", "t y")],
        ..PARTICLE
    };
    assert_all(&forced);
}

/// L = (2 v₁² + 2 v₁ v₂ + v₂²)/2, f = v₂ − q₁ v₁: ∂²H/∂p∂p is no multiple of the identity.
#[test]
fn chetaevs_condition_in_momenta() {
    let coupled = text("a b", "(2 a'^2 + 2 a' b' + b'^2)/2", &[("c", "b' - a a'")]);
    assert_all(&coupled);
}

/// Singular Hessians: what of Dq = v follows.
#[test]
fn kinematics_that_does_not_follow() {
    let sum = text("a b", "(a' + b')^2/2", &[("c", "a' - b'")]);
    let found = finding(&system(&sum), "second-kind.differential");
    let Verdict::NotApplicable { hypothesis, detail } = &found.verdict else {
        panic!("{:?}", found.verdict)
    };
    assert_eq!(hypothesis, "model.hessian-regular");
    assert!(
        detail.contains("only") && detail.contains("Dq_a + Dq_b = a' + b'"),
        "{detail}"
    );
}

/// The end term of free ends cannot be left out: p δq remains. With fixed ends nothing does.
#[test]
fn wrong_end_conditions() {
    let system = system(&PARTICLE);
    with_context(&system, |cx| {
        let curve = StateCurve::new(cx);
        let varied = curve.vary(cx, curve.density(cx));
        let word = |subtracted| {
            let left = curve.end_terms(cx, &varied, Ends::Free, subtracted);
            cx.prover
                .identity(&system, &left, &Default::default(), "")
                .word()
        };
        assert_eq!(word(true), "proved");
        assert_eq!(word(false), "refuted");
        assert!(curve
            .end_terms(cx, &varied, Ends::HalfFixed, false)
            .is_empty());
        assert!(curve.end_terms(cx, &varied, Ends::Fixed, false).is_empty());
    });
}

/// A wrong density, L + Σ (Dq − 2 v) ∂L/∂v, does not give Dq = v.
#[test]
fn a_wrong_density() {
    let system = system(&PARTICLE);
    with_context(&system, |cx| {
        let g = &system.graph;
        let curve = StateCurve::new(cx);
        let wrong = g.sub(curve.density(cx), expr(g, "x'^2 + y'^2 + z'^2"));
        let varied = curve.vary(cx, wrong);
        let pairs = varied.by_velocities.iter().zip(curve.kinematic(cx));
        let differences: Vec<_> = pairs.map(|(&a, b)| g.sub(a, b)).collect();
        let verdict = cx
            .prover
            .identity(&system, &differences, &Default::default(), "");
        assert_eq!(verdict.word(), "refuted");
    });
}

/// Damped oscillator: Vujanović's operator is δv = D(δq) − (g/m) δq, and ∫δL dt = 0 gives m q'' + g q' + c q = 0; Hölder's
/// does not. It fails at turning points.
#[test]
fn damped_oscillator() {
    let damped = Text {
        forces: &[("q", "-g q'")],
        ..text("q", "(m q'^2 - c q^2)/2", &[])
    };
    let system = system(&damped);
    let found = finding(&system, "universal-relation#vujanovic");
    let detail = found.verdict.detail();
    assert!(detail.contains("fails where q' = 0"), "{detail}");
    assert!(detail.contains("∫δL dt = 0 although Q ≠ 0"), "{detail}");
    let expected = expr(&system.graph, "delta_q' - g/m delta_q");
    assert_eq!(found.formulas[0].right, expected);
    with_context(&system, |cx| {
        for (name, word) in [
            ("vujanovic", "proved"),
            ("hoelder", "refuted"),
            ("zero", "refuted"),
        ] {
            let operator = operator(cx, name).unwrap().unwrap();
            let verdict = bare_principle(cx, &operator).unwrap();
            assert_eq!(verdict.word(), word, "{name}: {}", verdict.detail());
        }
    });
}

/// ∫δL dt = 0 by Suslov's rule is wrong for S4, as θ A ≠ 0, and right for S2.
#[test]
fn suslovs_rule_alone() {
    for (stated, word) in [(&PARTICLE, "refuted"), (&DISC, "proved")] {
        let system = system(stated);
        with_context(&system, |cx| {
            let operator = operator(cx, "suslov").unwrap().unwrap();
            let verdict = bare_principle(cx, &operator).unwrap();
            assert_eq!(verdict.word(), word, "{}", verdict.detail());
        });
    }
}

/// A force in the direction of a coordinate without inertia: the operator divides by zero everywhere.
#[test]
fn vujanovics_operator_without_momentum() {
    let massless = Text {
        forces: &[("y", "-k y'")],
        ..text("x y", "x'^2/2", &[("c", "y' - x x'")])
    };
    let found = finding(&system(&massless), "universal-relation#vujanovic");
    assert_eq!(
        found.verdict.word(),
        "not-applicable",
        "{}",
        found.verdict.detail()
    );
    assert!(found.verdict.detail().contains("∂L/∂y'"));
}

/// An operator with symbolic coefficients, of the second order, on one of two velocities: it cancels all the same.
#[test]
fn operators_of_a_user() {
    let graph = Arc::new(Graph::new());
    let g = &graph;
    let stated = "a x' delta_x + b y delta_y' + c t delta_x'' + sin(x) delta_y'''";
    let parts = SystemParts {
        name: "test".into(),
        coordinates: vec!["x".into(), "y".into()],
        lagrangian: Some(expr(g, "1/2 (x'^2 + (1 + x^2) y'^2) - V x y + x y'")),
        forces: vec![("x".into(), expr(g, "-k x' y"))],
        variations: vec![VariationOperator {
            name: "odd".into(),
            relations: vec![(1, expr(g, stated))],
        }],
        ..SystemParts::default()
    };
    let system = System::new(graph.clone(), parts).unwrap();
    let found = finding(&system, "universal-relation#odd");
    let detail = found.verdict.detail();
    assert_eq!(found.verdict.word(), "proved", "{detail}");
    assert!(detail.contains("intermediate kind, δx' free"), "{detail}");
    // The same operator without the sum that makes it cancel is no principle.
    with_context(&system, |cx| {
        let all = Operator {
            relations: vec![Some(expr(g, "delta_x'")), Some(expr(g, "2 delta_y'"))],
            manifold: Default::default(),
            poles: Vec::new(),
        };
        assert_eq!(bare_principle(cx, &all).unwrap().word(), "refuted");
    });
}
