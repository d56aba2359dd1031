//! First integrals and densities of Darboux polynomials, and forms with unknowns that are solved for.
#![allow(clippy::unwrap_used, reason = "test code fails where it stands")]

mod common;

use chetaev_mechanics::system::{IntegralForm, Unknown};
use chetaev_mechanics::System;
use chetaev_symbolic::Verdict;
use common::{expr, finding, framed, system, with_context};

/// A limit cycle: `u' = u - v - u Q`, `v' = u + v - v Q` with Q = u² + v².
fn limit_cycle() -> System {
    framed(
        "x y",
        "(x'^2 + y'^2)/2",
        &[],
        &[],
        &[
            ("x", "x' - y' - x'^3 - x' y'^2"),
            ("y", "x' + y' - x'^2 y' - y'^3"),
        ],
    )
}

/// The same of the speed u along a blade and its rate of turning w.
fn driven_blade() -> System {
    let speed = "(x' cos(phi) + y' sin(phi))";
    let along = format!("({speed} (1 - {speed}^2 - phi'^2) - phi')");
    framed(
        "x y phi",
        "(x'^2 + y'^2 + phi'^2)/2",
        &[("blade", "x' sin(phi) - y' cos(phi)")],
        &[("u", "x' cos(phi) + y' sin(phi)"), ("w", "phi'")],
        &[
            ("x", &format!("cos(phi) {along}")),
            ("y", &format!("sin(phi) {along}")),
            ("phi", &format!("phi' (1 - {speed}^2 - phi'^2) + {speed}")),
        ],
    )
}

fn texts(system: &System, id: &str) -> Vec<String> {
    let finding = finding(system, id);
    println!(
        "{id}: {} {}",
        finding.verdict.word(),
        finding.verdict.detail()
    );
    let formulas = finding.formulas.iter();
    formulas.map(|f| system.graph.text(f.right)).collect()
}

#[test]
fn look() {
    let own = limit_cycle();
    println!("{:?}", texts(&own, "noether.family"));
    let own = driven_blade();
    println!("{:?}", texts(&own, "noether.family"));
    println!("{:?}", texts(&own, "measure.invariant"));
    println!("{:?}", texts(&own, "liouville.integrable"));
}

fn with_form(mut own: System, value: &str, unknowns: &[(&str, &[&str])]) -> System {
    let g = own.graph.clone();
    let unknowns = unknowns.iter().map(|(name, arguments)| Unknown {
        symbol: g.symbol(name, 0),
        arguments: arguments.iter().map(|a| g.symbol(a, 0)).collect(),
    });
    let form = IntegralForm {
        name: "G".into(),
        value: expr(&g, value),
        unknowns: unknowns.collect(),
    };
    own.integral_forms.push(form);
    own
}

#[test]
fn unknowns() {
    let own = system("x y", "(m x'^2 + m y'^2)/2 - k x^2/2 - x^4", &[]);
    let own = with_form(
        own,
        "a x'^2 + b y'^2 + h",
        &[("a", &[]), ("b", &[]), ("h", &["x"])],
    );
    println!("{:?}", texts(&own, "noether.form#G"));
}
