//! Formulas for people: simplified, collected and printed in the notations of the outputs.

use chetaev_mechanics::equations::{Equation, Equations};
use chetaev_mechanics::System;
use chetaev_report::data::{Definition, Equation as Printed, Formula};
use chetaev_symbolic::print::{Document, Format, Options};
use chetaev_symbolic::simplify;
use chetaev_symbolic::{Expr, Graph};

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
        rates.extend(characteristics.parameters.iter().map(|p| p.rate));
        velocities.extend(characteristics.parameters.iter().map(|p| p.value));
    }
    (rates, velocities)
}

/// Both sides of equations simplified and collected by accelerations.
pub fn readable(system: &System, derived: &Equations, equations: &[Equation]) -> Vec<(Expr, Expr)> {
    let g = &system.graph;
    let options = simplify::Options::default();
    let (rates, velocities) = groups(system, Some(derived));
    let left: Vec<Expr> = equations.iter().map(|e| e.left).collect();
    let left = simplify::collect_all(g, &left, &[&rates, &velocities], &options);
    left.into_iter()
        .zip(equations)
        .map(|(left, e)| (left, simplify::simplify(g, e.right, &options)))
        .collect()
}

/// One equation in every notation, with the definitions of names it needs.
pub fn equation(g: &Graph, left: Expr, right: Expr, options: &Options) -> Printed {
    printed(&Document::equations(g, &[(left, right)], options))
}

/// One expression in every notation.
pub fn expression(g: &Graph, e: Expr, options: &Options) -> Printed {
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
