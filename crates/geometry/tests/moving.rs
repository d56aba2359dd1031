//! Momenta along moving directions and moments of momentum about moving axes, searched (T3 §8.3).

#![allow(clippy::unwrap_used, clippy::panic)] // a panic is how a test fails

mod common;

use chetaev_geometry::noether::moving::{axes, directions, Kept};
use chetaev_mechanics::system::{Parameter, Particle, Thrust};
use chetaev_mechanics::{System, SystemParts};
use chetaev_symbolic::{Expr, Graph, Verdict};
use common::{expr, finding, with_context, with_motion};
use std::sync::Arc;

/// Particles as (name, mass, position) with their kinetic energy, and constraints as (name, f).
fn particles(
    coordinates: &str,
    kinetic: &str,
    all: &[(&str, &str, &[&str])],
    constraints: &[(&str, &str)],
    controls: &[&str],
) -> System {
    let graph = Arc::new(Graph::new());
    let list = |texts: &[&str]| -> Vec<Expr> { texts.iter().map(|t| expr(&graph, t)).collect() };
    let particles = all.iter().map(|(name, mass, position)| Particle {
        name: name.to_string(),
        mass: expr(&graph, mass),
        position: list(position),
        force: vec![graph.zero(); position.len()],
        thrust: Thrust::default(),
    });
    let constraints = constraints.iter();
    let parts = SystemParts {
        name: "test".into(),
        coordinates: coordinates.split_whitespace().map(String::from).collect(),
        lagrangian: Some(expr(&graph, kinetic)),
        particles: particles.collect(),
        controls: controls.iter().map(|u| (u.to_string(), None)).collect(),
        constraints: constraints
            .map(|(name, f)| (name.to_string(), expr(&graph, f)))
            .collect(),
        ..SystemParts::default()
    };
    System::new(graph, parts).unwrap()
}

/// The one momentum that is kept, and what it is on the constraints.
fn only_momentum(system: &System, value: &str) -> Kept {
    with_motion(system, |cx, motion| {
        let kept = directions(cx).unwrap().kept;
        let names: Vec<&str> = kept.iter().map(|k| &k.direction[..]).collect();
        assert_eq!(kept.len(), 1, "{names:?}");
        let g = &system.graph;
        let difference = g.sub(kept[0].value, expr(g, value));
        let on = &motion.manifold;
        let same = cx.prover.identity(system, &[difference], on, "");
        assert!(matches!(same, Verdict::Proved(_)), "{same:?}");
        let verdict = &cx.finding("noether.moving-direction#1").verdict;
        assert!(matches!(verdict, Verdict::Proved(_)), "{verdict:?}");
        kept[0].clone()
    })
}

/// A blade that is turned at a given rate, or by a control: the reaction is across it, and K·e' = m θ' (y' cos θ - x' sin θ) = 0, so by
/// (18a) the momentum along it is kept.
#[test]
fn blades_that_are_turned() {
    for (angle, controls) in [("w t", &[][..]), ("al", &["al"][..])] {
        let blade = format!("y' cos({angle}) - x' sin({angle})");
        let turned = particles(
            "x y",
            "m (x'^2 + y'^2)/2",
            &[("a", "m", &["x", "y"])],
            &[("blade", &blade)],
            controls,
        );
        let kept = only_momentum(&turned, &format!("m (x' cos({angle}) + y' sin({angle}))"));
        assert_eq!(kept.direction, format!("(cos({angle}), sin({angle}))"));
    }
}

/// Between two free particles on a line the direction is a unit vector, not their distance, along which nothing would be kept.
#[test]
fn directions_between_particles_are_unit_vectors() {
    let two = particles(
        "x y",
        "(m x'^2 + n y'^2)/2",
        &[("a", "m", &["x"]), ("b", "n", &["y"])],
        &[],
        &[],
    );
    let kept = only_momentum(&two, "m x' + n y'");
    assert_eq!(kept.direction, "the x axis");
    assert_eq!(kept.also, [("the line from a to b".to_owned(), None)]);
}

/// Two particles on a rod with a blade below its middle, on a floor: the same momentum along the blade and the rod is one integral, as the
/// moment of momentum about the vertical through all points of the rod is; about the axis across the rod through the origin the moment of
/// momentum vanishes where z = 0.
#[test]
fn what_is_the_same_is_named_once() {
    let rod = particles(
        "x y z phi",
        "m (x'^2 + y'^2 + z'^2 + l^2 phi'^2)",
        &[
            ("a", "m", &["x + l cos(phi)", "y + l sin(phi)", "z"]),
            ("b", "m", &["x - l cos(phi)", "y - l sin(phi)", "z"]),
        ],
        &[("blade", "y' cos(phi) - x' sin(phi)"), ("floor", "z")],
        &[],
    );
    let kept = only_momentum(&rod, "2 m (x' cos(phi) + y' sin(phi))");
    assert_eq!(kept.also, [("the line from a to b".to_owned(), None)]);
    let found = with_context(&rod, |cx| axes(cx).unwrap().kept);
    let vertical: Vec<&Kept> = found
        .iter()
        .filter(|k| k.direction == "the z axis")
        .collect();
    assert_eq!(vertical.len(), 1);
    // The one that is written shortest stands first: 2 m l² φ'.
    assert_eq!(vertical[0].point.as_deref(), Some("the centre of mass"));
    let also = vertical[0].also.iter();
    let points: Vec<&str> = also.filter_map(|(_, point)| point.as_deref()).collect();
    assert_eq!(points, ["b", "a", "the point (x, y, z)"]);
    for (j, kept) in found.iter().enumerate() {
        let detail = finding(&rod, &format!("noether.moving-axis#{}", j + 1));
        let is_trivial = detail.verdict.detail().contains("trivial");
        assert_eq!(
            is_trivial,
            kept.direction != "the z axis",
            "{}",
            kept.direction
        );
    }
}

/// Two particles whose velocities add up to one along the line between them, with forces along that line: the momentum along it,
/// (M p' + m q')·e, changes as the sum of momenta across it times the turning of e; for M = m that sum vanishes by the constraint.
#[test]
fn momenta_that_equal_masses_keep() {
    let mut two = particles(
        "x y u v",
        "(M (x'^2 + y'^2) + m (u'^2 + v'^2))/2 - k ((x - u)^2 + (y - v)^2)^2",
        &[("p", "M", &["x", "y"]), ("q", "m", &["u", "v"])],
        &[("c", "(x' + u') (y - v) - (y' + v') (x - u)")],
        &[],
    );
    let g = Arc::clone(&two.graph);
    let of = |system: &System| {
        let found = with_context(system, |cx| directions(cx).unwrap().kept);
        let line = found
            .into_iter()
            .find(|k| k.direction == "the line from p to q");
        line.map(|k| k.as_stated)
    };
    assert_eq!(of(&two), None);
    for (name, value) in [("M", "1"), ("m", "1")] {
        two.parameters.push(Parameter {
            name: name.into(),
            expr: expr(&g, name),
            value: Some(expr(&g, value)),
        });
    }
    assert_eq!(of(&two), Some(true));
    let found = finding(&two, "noether.moving-direction#1");
    let Verdict::Conditional { condition, .. } = &found.verdict else {
        panic!("{:?}", found.verdict);
    };
    assert_eq!(condition, "m = M");
}
