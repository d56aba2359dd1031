//! Stationary action: the table of theory 1 §4.3, with κ and the subsets of motions in closed form.

#![allow(clippy::unwrap_used)] // a panic is how a test fails

mod common;

use chetaev_mechanics::claims::formulation::manifold;
use chetaev_symbolic::Verdict;
use common::worked::{text, CONE, DISC, INTEGRABLE, LEVEL_SKATE, PARTICLE, SKATE};
use common::{expr, finding, system, with_context, Text};

/// The condition of a conditional verdict, and that every case was followed.
#[track_caller]
fn assert_condition(stated: &Text, id: &str, expected: &str) {
    let found = finding(&system(stated), id);
    let Verdict::Conditional {
        condition,
        counterexample,
        ..
    } = &found.verdict
    else {
        panic!("{}: {}", found.verdict.word(), found.verdict.detail())
    };
    assert_eq!(condition, expected);
    assert!(counterexample.is_some());
    assert!(
        found.verdict.detail().contains("only where"),
        "{}",
        found.verdict.detail()
    );
}

const STATIONARY: &str = "hamilton.stationary";
const SUSLOV: &str = "hamilton.stationary-suslov";

/// S1: straight glide or pure spin on a level plane; on an incline along the line of fall, or at rest across it. Speeds without poles are made up,
/// as x' sin φ = y' cos φ gives x' or y' as the other one over a sine or cosine.
#[test]
fn skates() {
    let with = " (with x' = u_y cos(phi), y' = u_y sin(phi))";
    let level = format!("u_y = 0 or phi' = 0{with}");
    assert_condition(&LEVEL_SKATE, STATIONARY, &level);
    let incline = format!("phi' = 0 and sin(phi) = 0, or u_y = 0, phi' = 0 and cos(phi) = 0{with}");
    assert_condition(&SKATE, STATIONARY, &incline);
}

/// S4: x' = 0 or y' = 0; θ A = y x' (y', −x').
#[test]
fn particle() {
    assert_condition(&PARTICLE, STATIONARY, "x' = 0 or y' = 0");
    assert_condition(&PARTICLE, SUSLOV, "y' = 0 and y = 0, or x' = 0");
}

/// With a shift of the constraint, z' = y x' + b: λ = x'y'/(1 + y²) as before, and κ = 0 for the same motions.
#[test]
fn affine_particle() {
    let affine = text(
        "x y z",
        "1/2 (x'^2 + y'^2 + z'^2)",
        &[("c", "z' - y x' - b")],
    );
    assert_condition(&affine, STATIONARY, "x' = 0 or y' = 0");
}

/// y' = t x' with L = (x'² + y'²)/2: E[f]·δq = −δx x-component … = δx only, so κ = 0, and λ = x'/(1 + t²) = 0 leaves rest.
#[test]
fn rheonomic_constraint() {
    let moving = text("x y", "1/2 (x'^2 + y'^2)", &[("c", "y' - t x'")]);
    let found = finding(&system(&moving), STATIONARY);
    let detail = found.verdict.detail();
    assert_eq!(found.verdict.word(), "refuted", "{detail}");
    assert!(detail.contains("except rest where x' = 0"), "{detail}");
}

/// κ by name, in closed form.
#[track_caller]
fn assert_kappa(stated: &Text, expected: &[(&str, &str)], says: &str) {
    let system = system(stated);
    let found = finding(&system, STATIONARY);
    let detail = found.verdict.detail();
    assert_eq!(found.verdict.word(), "proved", "{detail}");
    assert!(detail.contains(says), "{detail}");
    let g = &system.graph;
    for (name, value) in expected {
        let symbol = g.symbol(name, 0);
        let shown = found
            .formulas
            .iter()
            .find(|f| f.left == Some(symbol))
            .unwrap();
        let difference = [g.sub(shown.right, expr(g, value))];
        let verdict = with_context(&system, |cx| {
            cx.prover.identity(&system, &difference, &manifold(cx), "")
        });
        assert_eq!(verdict.word(), "proved", "{name} = {}", g.text(shown.right));
    }
}

#[test]
fn multipliers_in_closed_form() {
    let disc = [("kappa_rolling_x", "-m x'"), ("kappa_rolling_y", "-m y'")];
    assert_kappa(&DISC, &disc, "κ is unique");
    let cone = [("kappa_cone", "m sqrt(x'^2 + y'^2)/a + const_cone")];
    assert_kappa(&CONE, &cone, "every κ(0) serves");
    // κ' = −λ with D(κ + m z') = −m g.
    let integrable = [("kappa_c", "-m z' - m g t + const_c")];
    assert_kappa(&INTEGRABLE, &integrable, "every κ(0) serves");
}

/// θ A vanishes identically for S2, on the motions of S3, not for S1.
#[test]
fn suslovs_condition() {
    for (stated, word, says) in [
        (&DISC, "proved", "identically"),
        (&CONE, "proved", "on every motion"),
        (&INTEGRABLE, "proved", "identically"),
    ] {
        let found = finding(&system(stated), SUSLOV);
        let detail = found.verdict.detail();
        assert_eq!(found.verdict.word(), word, "{detail}");
        assert!(detail.contains(says), "{detail}");
    }
    let found = finding(&system(&LEVEL_SKATE), SUSLOV);
    assert_eq!(found.verdict.word(), "conditional");
}

/// Without an action, and without constraints.
#[test]
fn hypotheses() {
    let pushed = Text {
        forces: &[("x", "-x'")],
        ..PARTICLE
    };
    for id in [STATIONARY, SUSLOV] {
        let found = finding(&system(&pushed), id);
        let Verdict::NotApplicable { hypothesis, .. } = &found.verdict else {
            panic!("{:?}", found.verdict)
        };
        assert_eq!(hypothesis, "model.forces-absent");
    }
    let found = finding(&system(&text("x", "x'^2 - x^2", &[])), STATIONARY);
    assert_eq!(found.verdict.word(), "proved");
}

/// The constraint written with a factor, with the sides exchanged, or redundantly: the same motions.
#[test]
fn rewritten_constraints() {
    let particle = "1/2 (x'^2 + y'^2 + z'^2)";
    for constraints in [
        &[("c", "(1 + x^2) (y x' - z')")][..],
        &[("c", "z' - y x'"), ("twice", "2 z' - 2 y x'")][..],
    ] {
        let rewritten = Text {
            constraints,
            ..text("x y z", particle, &[])
        };
        assert_condition(&rewritten, STATIONARY, "x' = 0 or y' = 0");
    }
}

/// κ belongs to each subset: zero on both of S4.
#[test]
fn multipliers_on_subsets() {
    let system = system(&PARTICLE);
    let found = finding(&system, STATIONARY);
    assert_eq!(found.formulas.len(), 2);
    assert!(found.formulas.iter().all(|f| system.graph.is_zero(f.right)));
}
