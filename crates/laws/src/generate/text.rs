//! A random system as the text of a model file, so that a failure can be studied like any other model.

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
    text
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
