//! Momenta along moving directions and moments of momentum about moving axes, searched (T3 §8.3).

#![allow(clippy::unwrap_used, clippy::panic)] // a panic is how a test fails

use crate::common::{expr, finding, with_context, with_motion};
use chetaev_geometry::noether::moving::{axes, directions, Kept, Searched};
use chetaev_mechanics::system::{Parameter, Particle, Thrust};
use chetaev_mechanics::{System, SystemParts};
use chetaev_symbolic::{Expr, Graph, Verdict};
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

/// One particle of mass m in the plane or in space, with the force that a function of the position gives.
fn one(names: &[&str], force_function: &str, constraints: &[(&str, &str)]) -> System {
    let squares: Vec<String> = names.iter().map(|x| format!("{x}'^2")).collect();
    let lagrangian = format!("m ({})/2 + {force_function}", squares.join(" + "));
    particles(
        &names.join(" "),
        &lagrangian,
        &[("a", "m", names)],
        constraints,
        &[],
    )
}

/// What is kept, as directions and points in words with the value.
fn listed(system: &System, search: Search) -> Vec<(String, Option<String>, String)> {
    with_context(system, |cx| {
        let kept = search(cx).unwrap().kept;
        let own = kept.into_iter();
        own.map(|k| (k.direction, k.point, system.graph.text(k.shown)))
            .collect()
    })
}

type Search = fn(&chetaev_mechanics::Context<'_>) -> Result<Searched, String>;

fn is_proved(system: &System, claim: &str) {
    let verdict = &finding(system, claim).verdict;
    assert!(matches!(verdict, Verdict::Proved(_)), "{verdict:?}");
}

/// A force (3 k, 4 k) has no part along (4, -3); one along (1, -1) has none along (1, 1); on a slope of the angle s gravity has none
/// along (cos s, sin s) where it is (-m g sin s, m g cos s).
#[test]
fn oblique_directions_in_the_plane() {
    for (force, direction, momentum) in [
        ("3 k x + 4 k y", "(4, -3)", "m (4 x' - 3 y')"),
        ("-k (x - y)^2/2", "(1, 1)", "m (x' + y')"),
        (
            "m g (y cos(s) - x sin(s))",
            "(cos(s), sin(s))",
            "m (x' cos(s) + y' sin(s))",
        ),
        ("p x + q y", "(q, -p)", "m (q x' - p y')"),
    ] {
        let system = one(&["x", "y"], force, &[]);
        let kept = only_momentum(&system, momentum);
        assert_eq!(kept.direction, direction);
    }
}

/// Without forces the axes are what a person names, and nothing is listed beside them.
#[test]
fn axes_are_listed_once() {
    let free = one(&["x", "y", "z"], "0", &[]);
    let names = |search: Search| -> Vec<String> {
        let all = listed(&free, search).into_iter();
        all.map(|(direction, _, _)| direction).collect()
    };
    let all = ["the x axis", "the y axis", "the z axis"];
    assert_eq!(names(directions), all);
    assert_eq!(names(axes), all);
}

/// The force of V = k (x + y + z)²/2 is -k (x + y + z) (1, 1, 1): it has no part along (1, -1, 0) and (0, 1, -1) and no moment about
/// the axis (1, 1, 1) through the origin.
#[test]
fn oblique_directions_and_axes_in_space() {
    let system = one(&["x", "y", "z"], "-k (x + y + z)^2/2", &[]);
    let found = listed(&system, directions);
    let names: Vec<&str> = found.iter().map(|(e, _, _)| &e[..]).collect();
    assert_eq!(names, ["(1, -1, 0)", "(0, 1, -1)"]);
    let [(direction, point, _)] = &listed(&system, axes)[..] else {
        panic!("one axis");
    };
    assert_eq!(direction, "(1, 1, 1)");
    assert_eq!(point.as_deref(), Some("the origin"));
    for claim in ["direction#1", "direction#2", "axis#1"] {
        is_proved(&system, &format!("noether.moving-{claim}"));
    }
}

/// The line through the origin along (1, 1, 0) has the distance of which ((x - y)² + 2 z²)/2 is the square, and its functions do not change
/// in turns about it; moved by c along x it goes through (c, 0, 0), and its point nearest to the origin is (c/2, -c/2, 0). Along
/// (1, 1, 0) the momentum is kept.
#[test]
fn an_oblique_axis_off_the_origin() {
    let system = one(&["x", "y", "z"], "-k ((x - c - y)^2 + 2 z^2)^2", &[]);
    let found = listed(&system, axes);
    let [(direction, point, _)] = &found[..] else {
        panic!("{found:?}");
    };
    assert_eq!(direction, "(1, 1, 0)");
    assert_eq!(point.as_deref(), Some("the point (c/2, -c/2, 0)"));
    is_proved(&system, "noether.moving-axis#1");
    let found = listed(&system, directions);
    let names: Vec<&str> = found.iter().map(|(e, _, _)| &e[..]).collect();
    assert_eq!(names, ["(1, 1, 0)"]);
}

/// V = k (x cos(z/h) + y sin(z/h)) = k ρ cos(φ - z/h) does not change in a screw of h along z for a radian about z:
/// m (x y' - y x') + m h z' is kept, neither part by itself.
#[test]
fn screws() {
    let system = one(&["x", "y", "z"], "-k (x cos(z/h) + y sin(z/h))", &[]);
    let found = listed(&system, axes);
    let [(direction, point, _)] = &found[..] else {
        panic!("{found:?}");
    };
    assert_eq!(direction, "the z axis");
    assert_eq!(
        point.as_deref(),
        Some("the origin with h times the momentum along it (a screw)")
    );
    with_motion(&system, |cx, _| {
        let g = &system.graph;
        let value = axes(cx).unwrap().kept[0].value;
        let difference = g.sub(value, expr(g, "m (x y' - y x' + h z')"));
        let same = cx
            .prover
            .identity(&system, &[difference], &Default::default(), "");
        assert!(matches!(same, Verdict::Proved(_)), "{same:?}");
    });
    is_proved(&system, "noether.moving-axis#1");
    assert!(listed(&system, directions).is_empty());
}

/// A force to the point (a, b) keeps the moment about it, written without a minus in front of its terms.
#[test]
fn moments_are_written_with_arms() {
    let system = one(&["x", "y"], "-k ((x - a)^2 + (y - b)^2)^2", &[]);
    let [(direction, point, value)] = &listed(&system, axes)[..] else {
        panic!("one axis");
    };
    assert_eq!(direction, "the axis across the plane");
    assert_eq!(point.as_deref(), Some("the point (a, b)"));
    assert_eq!(value, "m ((b - y) x' + (x - a) y')");
    let detail = finding(&system, "noether.moving-axis#1");
    let detail = detail.verdict.detail().to_owned();
    assert!(detail.contains("m ((b - y) x' + (x - a) y')"), "{detail}");
}

/// x' = v leaves m v of the momentum along x, x y' - y x' = h leaves m h of the moment about the origin, and phi' = w leaves 2 m l² w of
/// that about the centre of mass.
#[test]
fn what_constraints_make_constant_is_named() {
    let falling = one(&["x", "y"], "-m g y", &[("c", "x' - v")]);
    let turning = one(&["x", "y"], "0", &[("c", "x y' - y x' - h")]);
    let skate = particles(
        "x y phi",
        "m (x'^2 + y'^2 + l^2 phi'^2)",
        &[
            ("a", "m", &["x + l cos(phi)", "y + l sin(phi)"]),
            ("b", "m", &["x - l cos(phi)", "y - l sin(phi)"]),
        ],
        &[("blade", "y' cos(phi) - x' sin(phi)"), ("turn", "phi' - w")],
        &[],
    );
    for (system, claim, what) in [
        (&falling, "direction", "along the x axis (m v)"),
        (&turning, "axis", "through the origin (m h)"),
        (&skate, "axis", "through the centre of mass"),
        (&skate, "axis", "(2 m l^2 w)"),
    ] {
        let verdict = finding(system, &format!("noether.moving-{claim}"));
        let detail = verdict.verdict.detail();
        assert!(detail.contains(what), "{detail}");
        assert!(detail.contains("trivial"), "{detail}");
    }
}

/// Each claim speaks of what it tried.
#[test]
fn each_claim_speaks_of_its_own_candidates() {
    let wind = one(&["x", "y"], "x^3 - x y^4", &[]);
    let said = |claim: &str| finding(&wind, claim).verdict.detail().to_owned();
    let (along, about) = (
        said("noether.moving-direction"),
        said("noether.moving-axis"),
    );
    assert!(along.contains("none of 2 candidates"), "{along}");
    assert!(
        !along.contains("point") && !along.contains("centre"),
        "{along}"
    );
    assert!(along.contains("any other fixed direction"), "{along}");
    assert!(about.contains("none of 2 candidates"), "{about}");
    assert!(
        about.contains("the origin") && !about.contains("from particle to"),
        "{about}"
    );
    assert!(about.contains("any other fixed point"), "{about}");
}
