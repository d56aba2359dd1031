//! A drawing for models that state none: their particles, points whose coordinates are named so, or a phase portrait.

use crate::study::Study;
use chetaev_mechanics::System;
use chetaev_model::drawing::{Drawing, Element, Point, Shape};
use chetaev_model::Model;
use chetaev_symbolic::Expr;

/// The colors of points one after another.
const COLORS: [&str; 5] = ["blue", "red", "green", "amber", "violet"];

/// More points than these are not told apart.
const POINTS: usize = 12;

/// A drawing of particles, else of points, else of the first coordinate and its velocity; `None` without coordinates.
pub(super) fn drawn_by_itself(study: &Study) -> Option<Drawing> {
    let particles = particles(&study.model);
    let points = if particles.is_empty() {
        points(&study.system)
    } else {
        particles
    };
    if points.is_empty() {
        return phase_portrait(&study.system);
    }
    let spatial = points.iter().any(|(_, at)| at.len() == 3);
    let zero = study.system.graph.zero();
    let mut elements = Vec::new();
    for (place, (name, mut at)) in points.into_iter().take(POINTS).enumerate() {
        at.resize(if spatial { 3 } else { 2 }, zero);
        elements.extend(point(name, at, COLORS[place % COLORS.len()]));
    }
    Some(Drawing {
        spatial,
        ground: spatial,
        description: "Points of the system and the paths on which they run.".into(),
        elements,
        ..Drawing::default()
    })
}

/// A point and its path.
fn point(name: String, at: Point, color: &str) -> [Element; 2] {
    let element = |name: String, shape: Shape| Element {
        name,
        color: color.into(),
        shape,
    };
    [
        element(String::new(), Shape::Trail { at: at.clone() }),
        element(name, Shape::Point { at }),
    ]
}

/// The particles that a model states, where their positions are of the coordinates alone.
fn particles(model: &Model) -> Vec<(String, Point)> {
    let particles = model.particles.iter();
    let particles = particles.filter(|p| !p.position.is_empty());
    particles
        .map(|p| (p.name.clone(), p.position.clone()))
        .collect()
}

/// Points from coordinates named x, y and perhaps z, with the same ending: x_1, y_1 are one point.
fn points(system: &System) -> Vec<(String, Point)> {
    let of = |name: &str| -> Option<Expr> {
        let found = system.coordinates.iter().find(|c| c.name == name);
        found.map(|c| c.q)
    };
    let firsts = system.coordinates.iter();
    let endings = firsts.filter_map(|c| c.name.strip_prefix('x'));
    endings
        .filter_map(|ending| {
            let mut at = vec![of(&format!("x{ending}"))?, of(&format!("y{ending}"))?];
            at.extend(of(&format!("z{ending}")));
            let name = ending.trim_start_matches('_');
            Some((name.to_owned(), at))
        })
        .collect()
}

/// The first coordinate against its velocity.
fn phase_portrait(system: &System) -> Option<Drawing> {
    let first = system.coordinates.first()?;
    let name = format!("{0}, {0}'", first.name);
    Some(Drawing {
        description: format!(
            "The phase portrait of the first coordinate: {0} to the right, {0}' upwards.",
            first.name
        ),
        elements: point(name, vec![first.q, first.v], COLORS[0]).into(),
        ..Drawing::default()
    })
}
