//! Parameters that a model states to be zero are zero for the claims on the principles, and controls have the laws that it states; all
//! other parameters are arbitrary.

#![allow(clippy::unwrap_used)] // a panic is how a test fails

use crate::common::expr;
use chetaev_mechanics::claims::strata::{Grounds, Strata};
use chetaev_mechanics::claims::Finding;
use chetaev_mechanics::{Prepared, Prover, Registry, System, SystemParts};
use chetaev_symbolic::{Graph, Verdict};
use std::sync::Arc;

/// A system in x, y and a third coordinate with one constraint and one parameter with its value.
fn stated(third: &str, lagrangian: &str, f: &str, parameter: (&str, i64)) -> System {
    let graph = Arc::new(Graph::new());
    let parts = SystemParts {
        name: "test".into(),
        coordinates: ["x", "y", third].map(String::from).to_vec(),
        lagrangian: Some(expr(&graph, lagrangian)),
        constraints: vec![("c".into(), expr(&graph, f))],
        parameters: vec![(parameter.0.into(), Some(graph.integer(parameter.1)))],
        ..SystemParts::default()
    };
    System::new(graph, parts).unwrap()
}

fn finding(system: &System, id: &str) -> Finding {
    let registry = Registry::new(&[
        chetaev_mechanics::claims::CLAIMS,
        chetaev_principles::CLAIMS,
    ]);
    let prepared = Prepared::new(system).unwrap();
    let grounds = Grounds::new(system, &prepared, &|_, _| None);
    let strata = Strata::new(&grounds, &registry, Prover::default, |cx| cx);
    strata.finding(registry.find(id).unwrap(), None)
}

/// z' = y x' + b: D H = b λ, and H is kept for b = 0 alone (T1 §5.1).
#[test]
fn the_energy_of_a_drift_that_is_switched_off() {
    let particle = |b| stated("z", "1/2 (x'^2 + y'^2 + z'^2)", "z' - y x' - b", ("b", b));
    let kept = finding(&particle(0), "energy.integral");
    assert_eq!(kept.verdict.word(), "proved");
    let detail = kept.verdict.detail();
    assert!(
        detail.contains("for b = 0, as the model states it"),
        "{detail}"
    );
    let lost = finding(&particle(1), "energy.integral");
    assert_eq!(lost.verdict.word(), "refuted");
    assert!(!lost.verdict.detail().contains("as the model states it"));
}

/// S1 on a plane (T1 §4.3): straight glide or pure spin where it is level, along the line of fall where it is not.
#[test]
fn a_skate_on_a_plane_without_slope() {
    let skate = |slope| {
        let lagrangian = "1/2 (x'^2 + y'^2 + phi'^2) + G x";
        stated("phi", lagrangian, "x' sin(phi) - y' cos(phi)", ("G", slope))
    };
    for (slope, condition) in [
        (0, "u_y = 0 or phi' = 0"),
        (
            1,
            "phi' = 0 and sin(phi) = 0, or u_y = 0, phi' = 0 and cos(phi) = 0",
        ),
    ] {
        let found = finding(&skate(slope), "hamilton.stationary");
        let Verdict::Conditional {
            condition: stated, ..
        } = &found.verdict
        else {
            panic!("{}", found.verdict.detail())
        };
        assert!(stated.starts_with(condition), "{stated}");
    }
}

/// z' = u x': integrable and stationary for u = 2, z = 2 x, and for no other law but constants; z' = u y x' with u = 2 is z' = 2 y x'. A weight −u x with
/// u = 0 does no work, although u x' is the power of most.
#[test]
fn controls_have_the_laws_stated() {
    let controlled = |lagrangian: &str, f: &str, law: &str| {
        let graph = Arc::new(Graph::new());
        let parts = SystemParts {
            name: "test".into(),
            coordinates: ["x", "y", "z"].map(String::from).to_vec(),
            lagrangian: Some(expr(&graph, lagrangian)),
            constraints: vec![("c".into(), expr(&graph, f))],
            controls: vec![("u".into(), Some(expr(&graph, law)))],
            ..SystemParts::default()
        };
        System::new(graph, parts).unwrap()
    };
    let particle = "1/2 (x'^2 + y'^2 + z'^2)";
    let weight = "1/2 (x'^2 + y'^2 + z'^2) - u x";
    for (system, id, word, says) in [
        (
            controlled(particle, "z' - u x'", "2"),
            "hamilton.stationary",
            "proved",
            "for u = 2, as",
        ),
        (
            controlled(particle, "z' - u x'", "2"),
            "variation.hoelder",
            "proved",
            "for u = 2, as",
        ),
        (
            controlled(particle, "z' - u x'", "t"),
            "variation.hoelder",
            "conditional",
            "for u = t, as",
        ),
        (
            controlled(particle, "z' - u y x'", "2"),
            "hamilton.stationary",
            "conditional",
            "only where x' = 0 or y' = 0",
        ),
        (
            controlled(particle, "z' - u' y x'", "2 t"),
            "hamilton.stationary",
            "conditional",
            "only where x' = 0 or y' = 0",
        ),
        (
            controlled(weight, "z' - y x'", "0"),
            "energy.integral",
            "proved",
            "for u = 0, as",
        ),
        (
            controlled(weight, "z' - y x'", "t"),
            "energy.integral",
            "refuted",
            "for u = t, as",
        ),
    ] {
        let found = finding(&system, id);
        let detail = found.verdict.detail();
        assert_eq!(found.verdict.word(), word, "{id}: {detail}");
        assert!(detail.contains(says), "{id}: {detail}");
    }
}
