//! A random system as the text of a model file, so that a failure can be studied like any other model.

use chetaev_mechanics::system::{FrameFields, Particle, Thrust};
use chetaev_mechanics::SystemParts;
use chetaev_symbolic::print::{Document, Format, Options};
use chetaev_symbolic::{Expr, Graph};
use std::fmt::Write;

/// The model file of `parts`.
pub(super) fn model(g: &Graph, parts: &SystemParts) -> String {
    let quoted = |names: &[String]| -> String {
        let quoted: Vec<String> = names.iter().map(|name| format!("\"{name}\"")).collect();
        quoted.join(", ")
    };
    let assumptions: Vec<String> = parts.assumptions.iter().map(|a| a.text.clone()).collect();
    let mut text = format!("name = \"{}\"\n", parts.name);
    if !assumptions.is_empty() {
        line(
            &mut text,
            &format!("assumptions = [{}]", quoted(&assumptions)),
        );
    }
    line(
        &mut text,
        &format!("coordinates = [{}]", quoted(&parts.coordinates)),
    );
    if !parts.parameters.is_empty() {
        line(&mut text, "\n[parameters]");
        for (name, value) in &parts.parameters {
            let value = value.map_or(String::new(), |value| whole(g, value));
            line(&mut text, &format!("{name} = \"{value}\""));
        }
    }
    line(&mut text, "\n[lagrangian]");
    if let Some(lagrangian) = parts.lagrangian {
        line(&mut text, &format!("L = \"{}\"", whole(g, lagrangian)));
    }
    if !parts.forces.is_empty() {
        line(&mut text, "\n[forces]");
        for (name, force) in &parts.forces {
            line(&mut text, &format!("{name} = \"{}\"", whole(g, *force)));
        }
    }
    line(&mut text, "\n[constraints]");
    for (name, f) in &parts.constraints {
        line(&mut text, &format!("{name} = \"{} = 0\"", whole(g, *f)));
    }
    match &parts.frame {
        Some(frame) => fields(&mut text, g, parts, frame),
        None => forms(&mut text, g, parts),
    }
    masses(&mut text, g, parts);
    if !parts.integrals.is_empty() {
        line(&mut text, "\n[integrals]");
    }
    for (name, value) in &parts.integrals {
        line(&mut text, &format!("{name} = \"{}\"", whole(g, *value)));
    }
    for particle in &parts.particles {
        particle_table(&mut text, g, particle);
    }
    text
}

fn forms(text: &mut String, g: &Graph, parts: &SystemParts) {
    if parts.quasi_velocities.is_empty() {
        return;
    }
    line(text, "\n[quasi_velocities]");
    for (name, definition) in &parts.quasi_velocities {
        line(text, &format!("{name} = \"{}\"", whole(g, *definition)));
    }
}

fn fields(text: &mut String, g: &Graph, parts: &SystemParts, frame: &FrameFields) {
    let components = |field: &[Expr]| {
        let stated: Vec<String> = parts
            .coordinates
            .iter()
            .zip(field)
            .filter(|(_, component)| !g.is_zero(**component))
            .map(|(name, component)| format!("{name} = \"{}\"", whole(g, *component)))
            .collect();
        format!("{{ {} }}", stated.join(", "))
    };
    line(text, "\n[moving_frame]");
    if frame.drift.iter().any(|component| !g.is_zero(*component)) {
        line(text, &format!("drift = {}", components(&frame.drift)));
    }
    line(text, "\n[moving_frame.fields]");
    for ((name, _), field) in parts.quasi_velocities.iter().zip(&frame.fields) {
        line(text, &format!("{name} = {}", components(field)));
    }
}

fn particle_table(text: &mut String, g: &Graph, particle: &Particle) {
    let list = |components: &[Expr]| {
        let quoted: Vec<String> = components
            .iter()
            .map(|component| format!("\"{}\"", whole(g, *component)))
            .collect();
        quoted.join(", ")
    };
    line(text, &format!("\n[particles.{}]", particle.name));
    line(text, &format!("mass = \"{}\"", whole(g, particle.mass)));
    line(text, &format!("position = [{}]", list(&particle.position)));
    if particle
        .force
        .iter()
        .any(|component| !g.is_zero(*component))
    {
        line(text, &format!("force = [{}]", list(&particle.force)));
    }
    let mode = match &particle.thrust {
        Thrust::Isotropic => return,
        Thrust::RelativeVelocity(u) => format!("relative_velocity = [{}]", list(u)),
        Thrust::ExhaustSpeed(c) => format!("exhaust_speed = \"{}\"", whole(g, *c)),
        Thrust::AbsoluteVelocity(w) => format!("absolute_velocity = [{}]", list(w)),
        Thrust::Force(force) => format!("force = [{}]", list(force)),
    };
    line(text, &format!("thrust = {{ {mode} }}"));
}

/// Masses with a law of their own, all of which begin with 1.
fn masses(text: &mut String, g: &Graph, parts: &SystemParts) {
    if parts.masses.is_empty() {
        return;
    }
    line(text, "\n[masses]");
    for (name, rate) in &parts.masses {
        let rate = whole(g, *rate);
        line(
            text,
            &format!("{name} = {{ rate = \"{rate}\", initial = 1 }}"),
        );
    }
}

fn line(text: &mut String, line: &str) {
    // Writing to a string cannot fail.
    let _ = writeln!(text, "{line}");
}

/// In one piece, whatever its size.
fn whole(g: &Graph, e: Expr) -> String {
    let options = Options {
        max_nodes: u64::MAX,
        ..Options::default()
    };
    Document::expressions(g, &[e], &options).render(Format::Text)
}
