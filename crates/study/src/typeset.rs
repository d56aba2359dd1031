//! Formulas for people: simplified, collected and printed in the notations of the outputs.

use chetaev_mechanics::equations::{Equation, Equations};
use chetaev_mechanics::{Manifold, Prover, System};
use chetaev_report::data::{Definition, Equation as Printed, Formula};
use chetaev_symbolic::print::{Document, Format, Options};
use chetaev_symbolic::simplify;
use chetaev_symbolic::{Expr, Graph, Verdict};

/// Printing options of a system: its coordinates and parameters in the order of the model.
pub fn print_options(system: &System) -> Options {
    Options {
        coordinates: system.coordinates.iter().map(|c| c.name.clone()).collect(),
        parameters: system.parameters.iter().map(|p| p.name.clone()).collect(),
        ..Options::default()
    }
}

/// Accelerations first, then velocities: the groups by which equations of motion are collected.
fn groups(system: &System, equations: Option<&Equations>) -> (Vec<Expr>, Vec<Expr>) {
    let mut rates: Vec<Expr> = system.coordinates.iter().map(|c| c.a).collect();
    let mut velocities: Vec<Expr> = system.coordinates.iter().map(|c| c.v).collect();
    if let Some(characteristics) = equations.and_then(|e| e.characteristics.as_ref()) {
        for p in &characteristics.parameters {
            // Independent velocities are coordinates' velocities; quasi-velocities are new names.
            if !rates.contains(&p.rate) {
                rates.push(p.rate);
                velocities.push(p.value);
            }
        }
    }
    (rates, velocities)
}

/// Both sides of equations simplified and collected by accelerations. What is printed is proved equal to what was derived;
/// where that fails, what was derived is printed as it is.
pub fn readable(system: &System, derived: &Equations, equations: &[Equation]) -> Vec<(Expr, Expr)> {
    let g = &system.graph;
    let options = simplify::Options::default();
    let (rates, velocities) = groups(system, Some(derived));
    equations
        .iter()
        .map(|e| {
            let left = simplify::collect(g, e.left, &[&rates, &velocities], &options);
            let right = simplify::simplify(g, e.right, &options);
            (
                faithful(system, e.left, left),
                faithful(system, e.right, right),
            )
        })
        .collect()
}

/// Expressions simplified for people, each proved equal to the original or left as it was.
pub fn simplified(system: &System, es: &[Expr]) -> Vec<Expr> {
    let short = simplify::simplify_all(&system.graph, es, &simplify::Options::default());
    es.iter()
        .zip(short)
        .map(|(&e, short)| faithful(system, e, short))
        .collect()
}

fn faithful(system: &System, original: Expr, readable: Expr) -> Expr {
    let g = &system.graph;
    if original == readable {
        return readable;
    }
    let difference = g.sub(original, readable);
    let verdict = Prover::default().identity(system, &[difference], &Manifold::default(), "");
    match verdict {
        Verdict::Proved(_) => readable,
        _ => original,
    }
}

/// More signs than these in one formula are no longer read.
const LEGIBLE: u64 = 4_000;

/// Whether a formula is short enough for a page.
pub fn is_legible(g: &Graph, e: Expr) -> bool {
    simplify::length(g, e) <= LEGIBLE
}

/// What stands on a page in place of a formula that nobody would read.
fn too_long(signs: u64) -> Printed {
    let text = format!("an expression of about {signs} signs; `chetaev derive` prints it");
    Printed {
        formula: Formula {
            text,
            ..Formula::default()
        },
        ..Printed::default()
    }
}

/// One equation in every notation, with the definitions of names it needs; one that is too long to read is only announced.
pub fn equation(g: &Graph, left: Expr, right: Expr, options: &Options) -> Printed {
    let signs = simplify::length(g, left).saturating_add(simplify::length(g, right));
    if signs > LEGIBLE {
        return too_long(signs);
    }
    printed(&Document::equations(g, &[(left, right)], options))
}

/// One expression in every notation.
pub fn expression(g: &Graph, e: Expr, options: &Options) -> Printed {
    let signs = simplify::length(g, e);
    if signs > LEGIBLE {
        return too_long(signs);
    }
    printed(&Document::expressions(g, &[e], options))
}

fn printed(document: &Document) -> Printed {
    let [mathml, latex, text] =
        [Format::Mathml, Format::Latex, Format::Text].map(|f| document.parts(f));
    let formula = |i: usize, of: fn(&chetaev_symbolic::print::Parts) -> &Vec<String>| Formula {
        mathml: of(&mathml).get(i).cloned(),
        text: of(&text).get(i).cloned().unwrap_or_default(),
        latex: of(&latex).get(i).cloned(),
    };
    Printed {
        formula: formula(0, |p| &p.statements),
        definitions: (0..document.definition_count())
            .map(|i| Definition {
                formula: formula(i, |p| &p.definitions),
                text: None,
            })
            .collect(),
        ..Printed::default()
    }
}
